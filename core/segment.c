/* LazyBrush [SDC09b] (section 3.2): every pixel gets the label of a scribble, borders run through ink.
 *
 * The energy is that of multiway.c with V_pq = 1 + K g (I), K = 2 (width + height), so that one step through paper
 * costs more than any border inside ink could.  The paper leaves open:
 *   I   of an edge is the darker of its two pixels: a line one pixel wide closes a region even if it is antialiased.
 *   g   is 0 up to ink_threshold and from there the cube of I stretched to [0,1]: grey that contrast normalisation left
 *       behind costs nothing, half ink 1/27, and paper grain little.
 *   ink  costs less the deeper it is, so that borders run along the middle of a line, not along its shorter side
 *       (LazyBrush filters the drawing with a LoG to that end); with ragged pencil lines this keeps both sides clean.
 *   votes  A painted pixel costs hardness K in LazyBrush, so that a stroke closes gaps up to hardness x its area, and
 *       the same stroke with a thicker brush closes wider ones until it wraps itself.  Here that is divided by the mean
 *       width of all strokes, in units of 20 pixels: at 0.05 a stroke closes gaps up to its own length, whatever the
 *       brush and the resolution, and to wrap it costs twice that, so that a majority of paint wins.
 *   frame  A page is often cropped to its drawing.  Edges of paper along the frame cost as if some of the margin were
 *       left, so that the background holds together where a figure nearly touches the frame.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define UNIT        16             /* cost of an edge inside ink: energies are integers */
#define DEEP        10             /* an edge deep inside ink costs this much less than one at its rim */
#define MARGIN      64             /* of half the perimeter: the margin that a cropped page is taken to have had */
#define MOST_VOTE   (1 << 28)
#define BRUSH       20.0           /* pixels; at this width votes are hardness K */
#define INK_STEPS   1024           /* of the table of g */

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

static double
perimeter (const CeldCanvas *canvas)
{
  return 2.0 * (canvas->width + canvas->height);
}

typedef struct
{
  int32_t  by_ink[INK_STEPS + 1]; /* V in steps from ink to paper */
  int32_t *depth;                 /* of each pixel in ink: squared distance to paper */
  int32_t  margin;                /* edges of paper along the frame stand for so many */
} Costs;

static int
ink_step (float ink)
{
  return ink > 0 && ink < 1 ? (int) (ink * INK_STEPS) : ink <= 0 ? 0 : INK_STEPS; /* NaN is paper */
}

static CeldStatus
costs_new (const CeldCanvas *canvas, const CeldRun *run, Costs *costs)
{
  double     threshold = (double) canvas->settings->ink_threshold;
  uint8_t   *paper = celd_alloc (canvas->n, 1);
  CeldStatus status = CELD_NO_MEMORY;

  costs->margin = 1 + (canvas->width + canvas->height) / MARGIN;
  for (int i = 0; i <= INK_STEPS; i++)
    {
      double g = fmax (0, ((double) i / INK_STEPS - threshold) / (1 - threshold));

      costs->by_ink[i] = (int32_t) (UNIT * (1 + perimeter (canvas) * g * g * g));
    }
  costs->depth = celd_alloc (canvas->n, sizeof *costs->depth);
  if (paper && costs->depth)
    {
      for (size_t p = 0; p < canvas->n; p++)
        paper[p] = canvas->pieces.data[p] != 0;
      status = celd_distance (canvas->width, canvas->height, paper, run, costs->depth);
    }
  celd_free (paper);
  return status;
}

/* V between the pixel p = (x,y) and its neighbour q at (x + dx, y + dy); 0 beyond the frame. */
static int32_t
edge_cost (const CeldCanvas *canvas, const Costs *costs, int x, int y, int dx, int dy)
{
  size_t  p = (size_t) y * (size_t) canvas->width + (size_t) x, q = p + (size_t) (dx ? 1 : canvas->width);
  int     ink, other;
  int32_t depth;
  bool    along_frame = dx ? y == 0 || y + 1 == canvas->height : x == 0 || x + 1 == canvas->width;

  if (x + dx >= canvas->width || y + dy >= canvas->height)
    return 0;
  ink   = ink_step (CELD_AT (canvas->ink, x, y));
  other = ink_step (CELD_AT (canvas->ink, x + dx, y + dy));
  ink   = ink < other ? ink : other;
  depth = costs->depth[p] < costs->depth[q] ? costs->depth[p] : costs->depth[q];
  if (along_frame && 2 * ink >= INK_STEPS)
    return costs->by_ink[ink] * costs->margin;
  return costs->by_ink[ink] - (depth > 1 ? (int32_t) (DEEP * (1 - 1 / sqrt (depth))) : 0);
}

static CeldStatus
weigh_edges (CeldCanvas *canvas, const CeldRun *run)
{
  Costs      costs = { .depth = NULL };
  size_t     p = 0;
  CeldStatus status;

  canvas->east  = celd_alloc (canvas->n, sizeof *canvas->east);
  canvas->south = celd_alloc (canvas->n, sizeof *canvas->south);
  status = canvas->east && canvas->south ? costs_new (canvas, run, &costs) : CELD_NO_MEMORY;
  for (int y = 0; y < canvas->height && status == CELD_OK; y++)
    for (int x = 0; x < canvas->width; x++, p++)
      {
        canvas->east[p]  = edge_cost (canvas, &costs, x, y, 1, 0);
        canvas->south[p] = edge_cost (canvas, &costs, x, y, 0, 1);
      }
  celd_free (costs.depth);
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
  double vote = UNIT * perimeter (canvas) * (double) canvas->settings->hardness * BRUSH / brush_width (canvas);

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
