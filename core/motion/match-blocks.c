/* The push phase of registration [SDC09a, section 3.3]: block matching of the cells around each vertex.
 *
 * A block is what the cells at a vertex show of the source, as the lattice lies: warped with it, and without what
 * nearer cells hide.  So parts that pass behind others are not pulled towards the lines of these.  Squared differences
 * are summed for each cell and shift once, and added up at vertices.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 * /
 */
#include "motion/motion.h"

#define PUSH_REACH    CELD_MATCH_REACH
#define PUSH_SHIFTS   (2 * PUSH_REACH + 1)
#define PUSH_SEEN 0.25f /* of a block's pixels have to be visible; chosen */
#define PUSH_INK  0.02f /* mean squared nearness to ink from which a block pulls with full weight; chosen */
#define PUSH_REST 0.004 /* cost of a shift by PUSH_REACH, so that equal fits shift least; chosen */

typedef struct { float x, y, value; } BlockSample; /* a place in the drawing, and nearness to ink there */

/* Where a sample lies in the target: a pixel of the scale, and how far from the place that the pixel stands for. */
typedef struct { int x, y; float off[2]; bool visible; } BlockSpot;

typedef struct { uint32_t seen; float ink, off[2]; float cost[PUSH_SHIFTS * PUSH_SHIFTS]; } CellCost;

struct CeldMatcher
{
  const CeldLattice     *lattice;
  const CeldMatchImages *images;
  BlockSample                *sample;
  BlockSpot                  *spot;   /* of each sample */
  size_t                *first;  /* sample of each cell */
  uint32_t              *nearest; /* level + 1 of the nearest sample in each pixel of the target */
  CellCost              *cell;
  CellCost              *vertex; /* sums of cells */
  uint32_t              *most;   /* samples around each vertex */
};

/* ------------------------------------------------------------------ samples */

/* Calls for the samples of a scale in the square of a cell; counts them, or stores them if `sample` is not NULL. */
static size_t
take_samples (const CeldLattice *lattice, const CeldMatchImages *images, size_t cell, BlockSample *sample)
{
  const float *rest = lattice->rest + 2 * (size_t) lattice->corner[4 * cell];
  int          step = images->factor > 1 ? images->factor : 2, left = (int) rest[0], top = (int) rest[1];
  size_t       n = 0;

  for (int y = (top + step - 1) / step * step; y < top + lattice->side; y += step)
    for (int x = (left + step - 1) / step * step; x < left + lattice->side; x += step)
      {
        int px = x + images->factor / 2, py = y + images->factor / 2;

        px = px < lattice->width ? px : lattice->width - 1;
        py = py < lattice->height ? py : lattice->height - 1;
        if (x >= lattice->width || y >= lattice->height ||
            (celd_lattice_cell (lattice, px, py) != cell + 1 && celd_lattice_cell (lattice, x, y) != cell + 1))
          continue;
        if (!celd_match_own (images, lattice, cell, px, py) ||
            (images->hidden[0] && images->hidden[0][(size_t) py * (size_t) lattice->width + (size_t) px]))
          continue;
        if (sample)
          sample[n] = (BlockSample) { (float) px + 0.5f, (float) py + 0.5f,
                                 images->source[(size_t) (y / images->factor) * (size_t) images->width +
                                                (size_t) (x / images->factor)] };
        n++;
      }
  return n;
}

CeldStatus
celd_matcher_new (const CeldLattice *lattice, const CeldMatchImages *images, CeldMatcher **result)
{
  CeldMatcher *m = celd_alloc0 (1, sizeof *m);
  size_t       n = 0;

  if (!m)
    return CELD_NO_MEMORY;
  m->lattice = lattice;
  m->images  = images;
  m->first   = celd_alloc (lattice->n_cells + 1, sizeof *m->first);
  for (size_t c = 0; c < lattice->n_cells && m->first; c++)
    {
      m->first[c] = n;
      n += take_samples (lattice, images, c, NULL);
    }
  m->sample  = celd_alloc (n ? n : 1, sizeof *m->sample);
  m->spot    = celd_alloc (n ? n : 1, sizeof *m->spot);
  m->nearest = celd_alloc ((size_t) images->width * (size_t) images->height, sizeof *m->nearest);
  m->cell    = celd_alloc (lattice->n_cells, sizeof *m->cell);
  m->vertex  = celd_alloc (lattice->n_vertices, sizeof *m->vertex);
  m->most    = celd_alloc0 (lattice->n_vertices, sizeof *m->most);
  if (!m->first || !m->sample || !m->spot || !m->nearest || !m->cell || !m->vertex || !m->most)
    {
      celd_matcher_free (m);
      return CELD_NO_MEMORY;
    }
  m->first[lattice->n_cells] = n;
  for (size_t c = 0; c < lattice->n_cells; c++)
    {
      size_t taken = take_samples (lattice, images, c, m->sample + m->first[c]);

      for (size_t k = 0; k < 4; k++)
        m->most[lattice->corner[4 * c + k]] += (uint32_t) taken;
    }
  *result = m;
  return CELD_OK;
}

void
celd_matcher_free (CeldMatcher *m)
{
  if (!m)
    return;
  celd_free (m->sample);
  celd_free (m->spot);
  celd_free (m->first);
  celd_free (m->nearest);
  celd_free (m->cell);
  celd_free (m->vertex);
  celd_free (m->most);
  celd_free (m);
}

/* ------------------------------------------------------------------ what is visible */

/* Finds where each sample lies, and what is nearest in each pixel. */
static void
place_samples (CeldMatcher *m)
{
  const CeldLattice     *lattice = m->lattice;
  const CeldMatchImages *i = m->images;

  memset (m->nearest, 0, (size_t) i->width * (size_t) i->height * sizeof *m->nearest);
  for (size_t c = 0; c < lattice->n_cells; c++)
    for (size_t s = m->first[c]; s < m->first[c + 1]; s++)
      {
        float     at[2], f = (float) i->factor, middle = (float) (i->factor / 2) + 0.5f;
        uint32_t *nearest;
        BlockSpot     *spot = &m->spot[s];

        celd_cell_map (lattice, c, m->sample[s].x, m->sample[s].y, at);
        *spot = (BlockSpot) { .visible = at[0] >= 0 && at[1] >= 0 && at[0] < f * (float) i->width &&
                                    at[1] < f * (float) i->height };
        if (spot->visible && i->hidden[1] && at[0] < (float) lattice->width && at[1] < (float) lattice->height)
          spot->visible = !i->hidden[1][(size_t) (int) at[1] * (size_t) lattice->width + (size_t) (int) at[0]];
        if (!spot->visible)
          continue;
        spot->x = (int) (at[0] / f);
        spot->y = (int) (at[1] / f);
        spot->off[0] = at[0] - f * (float) spot->x - middle;
        spot->off[1] = at[1] - f * (float) spot->y - middle;
        nearest = &m->nearest[(size_t) spot->y * (size_t) i->width + (size_t) spot->x];
        if (*nearest <= lattice->level[c])
          *nearest = lattice->level[c] + 1;
      }
  for (size_t c = 0; c < lattice->n_cells; c++)
    for (size_t s = m->first[c]; s < m->first[c + 1]; s++)
      if (m->spot[s].visible)
        m->spot[s].visible = m->nearest[(size_t) m->spot[s].y * (size_t) i->width + (size_t) m->spot[s].x]
                               == lattice->level[c] + 1;
}

/* ------------------------------------------------------------------ costs */

static void
cell_costs (void *data, int job)
{
  CeldMatcher           *m = data;
  const CeldMatchImages *i = m->images;
  size_t                 c = (size_t) job, stride = (size_t) (i->width + 2 * i->pad);
  CellCost              *cost = &m->cell[c];

  memset (cost, 0, sizeof *cost);
  for (size_t s = m->first[c]; s < m->first[c + 1]; s++)
    {
      const BlockSpot *spot = &m->spot[s];
      float       value = m->sample[s].value;

      if (!spot->visible)
        continue;
      cost->seen++;
      cost->ink    += value * value;
      cost->off[0] += spot->off[0];
      cost->off[1] += spot->off[1];
      for (int y = 0; y < PUSH_SHIFTS; y++)
        {
          const float *target = i->target + (size_t) (spot->y + y - PUSH_REACH + i->pad) * stride +
                                (size_t) (spot->x - PUSH_REACH + i->pad);
          float       *to = cost->cost + y * PUSH_SHIFTS;

          for (int x = 0; x < PUSH_SHIFTS; x++)
            to[x] += (target[x] - value) * (target[x] - value);
        }
    }
}

static void
add_costs (CeldMatcher *m)
{
  const CeldLattice *lattice = m->lattice;

  memset (m->vertex, 0, lattice->n_vertices * sizeof *m->vertex);
  for (size_t k = 0; k < 4 * lattice->n_cells; k++)
    {
      const CellCost *from = &m->cell[k / 4];
      CellCost       *to = &m->vertex[lattice->corner[k]];

      to->seen += from->seen;
      to->ink  += from->ink;
      to->off[0] += from->off[0];
      to->off[1] += from->off[1];
      for (int i = 0; i < PUSH_SHIFTS * PUSH_SHIFTS; i++)
        to->cost[i] += from->cost[i];
    }
}

/* Where the parabola through three neighbouring values is least, as far as half a step from the middle one, which is
 * about the least of them. */
static float
refine (float before, float least, float after)
{
  float bend = before + after - 2 * least, at = bend > 1e-9f ? 0.5f * (before - after) / bend : 0;

  return celd_most (-0.5f, celd_least (0.5f, at));
}

/* The best shift of a vertex, in pixels of the scale. */
static void
best_shift (const CellCost *v, float *shift_x, float *shift_y)
{
  float least = INFINITY, rest = (float) PUSH_REST * (float) v->seen / (PUSH_REACH * PUSH_REACH);
  int   best = 0;

  for (int i = 0; i < PUSH_SHIFTS * PUSH_SHIFTS; i++)
    {
      int   x = i % PUSH_SHIFTS - PUSH_REACH, y = i / PUSH_SHIFTS - PUSH_REACH;
      float cost = v->cost[i] + rest * (float) (x * x + y * y);

      if (cost < least)
        {
          least = cost;
          best  = i;
        }
    }
  *shift_x = (float) (best % PUSH_SHIFTS - PUSH_REACH);
  *shift_y = (float) (best / PUSH_SHIFTS - PUSH_REACH);
  if (best % PUSH_SHIFTS > 0 && best % PUSH_SHIFTS < PUSH_SHIFTS - 1)
    *shift_x += refine (v->cost[best - 1], v->cost[best], v->cost[best + 1]);
  if (best / PUSH_SHIFTS > 0 && best / PUSH_SHIFTS < PUSH_SHIFTS - 1)
    *shift_y += refine (v->cost[best - PUSH_SHIFTS], v->cost[best], v->cost[best + PUSH_SHIFTS]);
}

void
celd_matcher_push (CeldMatcher *m, const CeldHost *host, CeldPull *pull, double *misfit)
{
  const CeldLattice *lattice = m->lattice;
  double             sum = 0, seen = 0;

  place_samples (m);
  celd_parallel_for (host, (int) lattice->n_cells, cell_costs, m);
  add_costs (m);
  for (size_t c = 0; c < lattice->n_cells; c++)
    {
      sum  += (double) m->cell[c].cost[PUSH_SHIFTS * PUSH_SHIFTS / 2];
      seen += m->cell[c].seen;
    }
  *misfit = seen > 0 ? sum / seen : 1;
  for (size_t i = 0; i < lattice->n_vertices; i++)
    {
      const CellCost *v = &m->vertex[i];
      float           ink = v->seen ? v->ink / (float) v->seen : 0, x, y;

      pull[i] = (CeldPull) { lattice->place[2 * i], lattice->place[2 * i + 1], 0 };
      if ((float) v->seen < PUSH_SEEN * (float) m->most[i] || !(ink > 0))
        continue;
      best_shift (v, &x, &y);
      pull[i].x += x * (float) m->images->factor - v->off[0] / (float) v->seen;
      pull[i].y += y * (float) m->images->factor - v->off[1] / (float) v->seen;
      pull[i].weight = ink < PUSH_INK ? ink / PUSH_INK : 1;
    }
}

size_t
celd_matcher_ink (CeldMatcher *m, size_t most, CeldInkPlace *ink)
{
  const CeldLattice *lattice = m->lattice;
  size_t             all = 0, seen = 0, n = 0;

  place_samples (m);
  for (size_t s = 0; s < m->first[lattice->n_cells]; s++)
    all += m->spot[s].visible && m->sample[s].value > CELD_ON_INK;
  for (size_t c = 0; c < lattice->n_cells; c++)
    for (size_t s = m->first[c]; s < m->first[c + 1]; s++)
      if (m->spot[s].visible && m->sample[s].value > CELD_ON_INK && seen++ % (all / most + 1) == 0)
        ink[n++] = (CeldInkPlace) { (float) m->spot[s].x, (float) m->spot[s].y, (uint32_t) c };
  return n;
}

void
celd_matcher_fit (CeldMatcher *m, float *fit)
{
  const CeldLattice     *lattice = m->lattice;
  const CeldMatchImages *i = m->images;
  size_t                 stride = (size_t) (i->width + 2 * i->pad);

  place_samples (m);
  for (size_t k = 0; k < lattice->n_vertices; k++)
    m->vertex[k] = (CellCost) { .seen = 0 };
  for (size_t c = 0; c < lattice->n_cells; c++)
    {
      float both = 0, any = 0;

      for (size_t s = m->first[c]; s < m->first[c + 1]; s++)
        if (m->spot[s].visible)
          {
            float a = m->sample[s].value;
            float b = i->target[(size_t) (m->spot[s].y + i->pad) * stride + (size_t) (m->spot[s].x + i->pad)];

            both += a < b ? a : b;
            any  += a < b ? b : a;
          }
      for (size_t k = 0; k < 4; k++)
        {
          m->vertex[lattice->corner[4 * c + k]].cost[0] += both;
          m->vertex[lattice->corner[4 * c + k]].cost[1] += any;
        }
    }
  for (size_t k = 0; k < lattice->n_vertices; k++)
    fit[k] = m->vertex[k].cost[1] > 0 ? m->vertex[k].cost[0] / m->vertex[k].cost[1] : -1;
}
