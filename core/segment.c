/* LazyBrush [SDC09b] (section 3.2): every pixel gets the label of a scribble, borders run through ink.
 *
 * The energy is that of multiway.c with the costs of costs.c.  The paper leaves open:
 *   votes  A painted pixel costs hardness K in LazyBrush, so that a stroke closes gaps up to hardness x its area, and
 *       the same stroke with a thicker brush closes wider ones until it wraps itself.  Here that is divided by the mean
 *       width of all strokes, in units of 20 pixels: at 0.05 a stroke closes gaps up to its own length, whatever the
 *       brush and the resolution, and to wrap it costs twice that, so that a majority of paint wins.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "costs.h"
#include "segment.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST_VOTE   (1 << 28)
#define BRUSH       20.0           /* pixels; at this width votes are hardness K */

/* ------------------------------------------------------------------ the canvas */

CeldStatus
celd_canvas_add (CeldCanvas *canvas, CeldRegion region, uint32_t *label)
{
  CeldRegion *item = celd_grow (canvas->palette.item, canvas->palette.n + 1, sizeof *item);

  if (!item)
    return CELD_NO_MEMORY;
  canvas->palette.item = item;
  item[canvas->palette.n++] = region;
  *label = (uint32_t) canvas->palette.n;
  return CELD_OK;
}

static void
canvas_clear (CeldCanvas *canvas)
{
  celd_free (canvas->seeds.data);
  celd_free (canvas->labels.data);
  celd_free (canvas->pieces.data);
  celd_free (canvas->rooms.data);
  celd_free (canvas->east);
  celd_free (canvas->south);
  celd_palette_clear (&canvas->palette);
}

/* Copies the palette and those seeds that it knows; `seeds` counts them. */
static CeldStatus
copy_seeds (const CeldLabels *seeds, const CeldPalette *palette, CeldCanvas *canvas)
{
  for (size_t k = 0; k < palette->n; k++)
    {
      CeldRegion region = palette->item[k];
      uint32_t   label;

      region.seeds      = 0;
      region.background = false;
      if (celd_canvas_add (canvas, region, &label) != CELD_OK)
        return CELD_NO_MEMORY;
    }
  for (int y = 0; y < canvas->height; y++)
    for (int x = 0; x < canvas->width; x++)
      {
        uint32_t l = CELD_AT (seeds, x, y);

        if (l < 1 || l > palette->n)
          continue;
        CELD_AT (&canvas->seeds, x, y) = l;
        canvas->palette.item[l - 1].seeds++;
      }
  return CELD_OK;
}

static CeldStatus
canvas_new (const CeldPlane *ink, const CeldLabels *seeds, const CeldPalette *palette, const CeldSettings *settings,
            const CeldRun *run, CeldCanvas *canvas)
{
  int        w = ink->width, h = ink->height;
  CeldStatus status;

  *canvas = (CeldCanvas) { .settings = settings, .ink = ink, .width = w, .height = h, .n = (size_t) w * (size_t) h };
  canvas->stroke = celd_stroke_width (ink);
  status = celd_labels_new (w, h, &canvas->seeds);
  if (status == CELD_OK)
    status = celd_labels_new (w, h, &canvas->labels);
  if (status == CELD_OK)
    status = celd_labels_new (w, h, &canvas->pieces);
  if (status == CELD_OK)
    status = celd_labels_new (w, h, &canvas->rooms);
  if (status == CELD_OK)
    status = copy_seeds (seeds, palette, canvas);
  if (status == CELD_OK)
    status = celd_rooms (run, canvas);
  return status;
}

static bool
has_seeds (const CeldCanvas *canvas)
{
  for (size_t p = 0; p < canvas->n; p++)
    if (canvas->seeds.data[p])
      return true;
  return false;
}

/* In a flat colouring the ink lines may be painted too: on ink, paint says nothing, unless it is a whole dark area. */
static CeldStatus
keep_flats_on_paper (CeldCanvas *canvas)
{
  size_t  n = canvas->palette.n, w = (size_t) canvas->width;
  size_t *count = celd_alloc0 (3 * (n + 1), sizeof *count), *on_paper, *sides;

  if (!count)
    return CELD_NO_MEMORY;
  on_paper = count + n + 1;
  sides    = on_paper + n + 1;
  for (size_t p = 0; p < canvas->n; p++)
    {
      uint32_t l = canvas->seeds.data[p];

      count[l]++;
      on_paper[l] += canvas->pieces.data[p] != 0;
      sides[l]    += p % w == 0 || canvas->seeds.data[p - 1] != l;
    }
  for (size_t p = 0; p < canvas->n; p++)
    {
      uint32_t l = canvas->seeds.data[p];
      bool     dark_area = 20 * on_paper[l] < count[l] && count[l] > 3 * (size_t) canvas->stroke * sides[l];

      if (!canvas->pieces.data[p] && !dark_area)
        canvas->seeds.data[p] = 0;
    }
  celd_free (count);
  return CELD_OK;
}

/* ------------------------------------------------------------------ the energy */

/* V of all edges.  Ink is what is no piece of paper. */
static CeldStatus
weigh_edges (CeldCanvas *canvas, const CeldRun *run)
{
  CeldCosts  costs;
  size_t     p = 0, w = (size_t) canvas->width;
  int32_t   *depth = celd_alloc (canvas->n, sizeof *depth);
  uint8_t   *paper = celd_alloc (canvas->n, 1);
  CeldStatus status = CELD_NO_MEMORY;

  celd_costs_new (canvas->width, canvas->height, canvas->settings->ink_threshold, &costs);
  canvas->east  = celd_alloc0 (canvas->n, sizeof *canvas->east);
  canvas->south = celd_alloc0 (canvas->n, sizeof *canvas->south);
  if (depth && paper && canvas->east && canvas->south)
    {
      for (p = 0; p < canvas->n; p++)
        paper[p] = canvas->pieces.data[p] != 0;
      status = celd_distance (canvas->width, canvas->height, paper, run, depth);
    }
  p = 0;
  for (int y = 0; y < canvas->height && status == CELD_OK; y++)
    for (int x = 0; x < canvas->width; x++, p++)
      {
        float ink = CELD_AT (canvas->ink, x, y);

        if (x + 1 < canvas->width)
          canvas->east[p] = celd_cost (&costs, ink, CELD_AT (canvas->ink, x + 1, y), depth[p], depth[p + 1],
                                       y == 0 || y + 1 == canvas->height);
        if (y + 1 < canvas->height)
          canvas->south[p] = celd_cost (&costs, ink, CELD_AT (canvas->ink, x, y + 1), depth[p], depth[p + w],
                                        x == 0 || x + 1 == canvas->width);
      }
  celd_free (depth);
  celd_free (paper);
  return status;
}

/* Mean width of the artist's strokes: twice their area over the length of their outline. */
static double
brush_width (const CeldCanvas *canvas)
{
  size_t w = (size_t) canvas->width, area = 0, outline = 0;

  for (size_t p = 0; p < canvas->n; p++)
    {
      uint32_t l = canvas->seeds.data[p];

      area += l != 0;
      if (p % w + 1 < w)
        outline += l != canvas->seeds.data[p + 1];
      if (p + w < canvas->n)
        outline += l != canvas->seeds.data[p + w];
    }
  return outline ? fmax (1, 2.0 * (double) area / (double) outline) : BRUSH;
}

static void
weigh_strokes (CeldCanvas *canvas)
{
  double white = 2.0 * (canvas->width + canvas->height); /* K of costs.c */
  double vote = CELD_COST_UNIT * white * (double) canvas->settings->hardness * BRUSH / brush_width (canvas);

  canvas->soft_vote = (int32_t) fmax (1, fmin (vote, MOST_VOTE));
}

int32_t
celd_canvas_vote (const CeldCanvas *canvas, uint32_t label)
{
  bool all_hard = celd_canvas_obeys (canvas);

  return all_hard || canvas->palette.item[label - 1].hard ? CELD_HARD : canvas->soft_vote;
}

/* ------------------------------------------------------------------ the cuts */

typedef struct { uint32_t label; size_t seeds; } Turn;

static int
compare_turns (const void *a, const void *b)
{
  const Turn *p = a, *q = b;

  if (p->seeds != q->seeds)
    return p->seeds > q->seeds ? -1 : 1;
  return p->label < q->label ? -1 : 1;
}

/* Labels by falling paint: most of the picture is decided first, and later cuts are small. */
static CeldStatus
order_labels (const CeldCanvas *canvas, uint32_t *order)
{
  Turn *turn = celd_alloc0 (canvas->palette.n, sizeof *turn);

  if (!turn)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < canvas->palette.n; k++)
    turn[k].label = (uint32_t) k + 1;
  for (size_t p = 0; p < canvas->n; p++)
    if (canvas->seeds.data[p])
      turn[canvas->seeds.data[p] - 1].seeds++;
  qsort (turn, canvas->palette.n, sizeof *turn, compare_turns);
  for (size_t k = 0; k < canvas->palette.n; k++)
    order[k] = turn[k].label;
  celd_free (turn);
  return CELD_OK;
}

static CeldStatus
cut_labels (CeldCanvas *canvas, const CeldRun *run)
{
  uint32_t    *order = celd_alloc (canvas->palette.n, sizeof *order);
  int32_t     *vote = celd_alloc (canvas->palette.n, sizeof *vote);
  CeldMultiway m = {
    canvas->width, canvas->height, canvas->east, canvas->south, canvas->seeds.data, vote, order, canvas->palette.n
  };
  CeldStatus   status = order && vote ? order_labels (canvas, order) : CELD_NO_MEMORY;

  memset (canvas->labels.data, 0, canvas->n * sizeof *canvas->labels.data);
  for (size_t k = 0; k < canvas->palette.n && status == CELD_OK; k++)
    vote[k] = celd_canvas_vote (canvas, (uint32_t) k + 1);
  if (status == CELD_OK)
    status = celd_multiway (&m, run, canvas->labels.data);
  celd_free (order);
  celd_free (vote);
  return status;
}

/* ------------------------------------------------------------------ the whole */

static void
count_arrow_seeds (CeldCanvas *canvas)
{
  for (size_t p = 0; p < canvas->n; p++)
    {
      uint32_t l = canvas->seeds.data[p];

      if (l && canvas->palette.item[l - 1].origin == CELD_FROM_ARROW)
        canvas->palette.item[l - 1].seeds++;
    }
}

static CeldStatus
solve (CeldCanvas *canvas, const CeldRelations *relations, const CeldRun *run)
{
  CeldPart   part[3];
  CeldRun    first = celd_run_part (&part[0], run, 0, 0); /* short steps: no progress, but cancel and threads */
  CeldRun    cuts = celd_run_part (&part[1], run, 0.1, 0.9), splits = celd_run_part (&part[2], run, 0.9, 1);
  bool       arrows = relations && canvas->settings->seeds == CELD_SEEDS_AUTO;
  CeldStatus status;

  weigh_strokes (canvas); /* before anything else adds seeds */
  status = arrows ? celd_seeds_plant (relations, &first, canvas) : CELD_OK;
  if (status == CELD_OK && !has_seeds (canvas))
    status = CELD_NOTHING_TO_GO_BY;
  if (status == CELD_OK && canvas->settings->flats)
    status = keep_flats_on_paper (canvas);
  if (status == CELD_OK)
    status = celd_stains_remove (&first, canvas);
  if (status == CELD_OK)
    status = celd_background_seed (&first, canvas);
  if (status == CELD_OK)
    status = weigh_edges (canvas, &first);
  if (status == CELD_OK)
    status = celd_step (run, 0.1);
  if (status == CELD_OK)
    status = cut_labels (canvas, &cuts);
  if (status == CELD_OK && arrows)
    status = celd_seeds_split (relations, &splits, canvas);
  return status;
}

CeldStatus
celd_segment (const CeldPlane *ink, const CeldLabels *seeds, const CeldRelations *relations,
              const CeldSettings *settings, const CeldRun *run,
              CeldLabels *labels, CeldPalette *palette, CeldProblems *problems)
{
  CeldCanvas   canvas = { 0 };
  CeldProblems found = { 0 };
  size_t       before = problems ? problems->n : 0;
  CeldPart     part[3];
  CeldRun      begin = celd_run_part (&part[0], run, 0, 0), solving = celd_run_part (&part[1], run, 0.05, 0.95);
  CeldRun      end = celd_run_part (&part[2], run, 0.95, 0.95);
  CeldStatus   status;

  if (!CELD_SAME_SIZE (ink, seeds) || !CELD_SAME_SIZE (ink, labels))
    return CELD_BAD_SIZE;
  status = celd_settings_check (settings);
  if (status == CELD_OK)
    status = canvas_new (ink, seeds, palette, settings, &begin, &canvas);
  if (status == CELD_OK)
    status = solve (&canvas, relations, &solving);
  if (status == CELD_OK)
    status = celd_palette_measure (&canvas.labels, ink, &end, &canvas.palette);
  if (status == CELD_OK)
    count_arrow_seeds (&canvas);
  if (status == CELD_OK)
    status = celd_segment_report (&canvas, seeds, &end, &found);
  if (status == CELD_OK)
    status = celd_step (run, 1);
  for (size_t i = 0; i < found.n && status == CELD_OK; i++)
    status = celd_problem_add (problems, found.item[i]);
  if (status != CELD_OK)
    {
      if (problems)
        problems->n = before;
      goto done;
    }
  for (int y = 0; y < canvas.height; y++)
    memcpy (&CELD_AT (labels, 0, y), &CELD_AT (&canvas.labels, 0, y), (size_t) canvas.width * sizeof *labels->data);
  celd_palette_clear (palette);
  *palette       = canvas.palette;
  canvas.palette = (CeldPalette) { 0 };

done:
  celd_problems_clear (&found);
  canvas_clear (&canvas);
  return status;
}
