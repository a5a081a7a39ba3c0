/* How likely a hidden place is inside a region: Laplace's equation between what is visible of the region (1) and what
 * is behind it (0), on all places that may hide the region.  [SBv05] and [Syk14] guess hidden shapes in this way.
 *
 * Diffusion alone rounds off whatever goes on behind something.  Therefore it is guided by the ends of the visible
 * outline: along the smooth continuation of each, an arc that becomes a straight line, nothing flows across at first,
 * and more and more with the distance from the end.
 *
 * Where the artist painted the region it is 1, and where erased, 0.  Hardly anything flows out of strokes: what is
 * added is what was painted, not what would be as likely.
 *
 * It is solved on cells of a size by that of the region, and read by quadratic B-splines (sheet-pixels.c).
 *
 *   [SBv05]  D. Sykora, J. Burianek, J. Zara: Sketching Cartoons by Example.  SBM 2005.
 *   [Syk14]  D. Sykora et al.: Ink-and-Ray: Bas-Relief Meshes for Adding Global Illumination Effects to Hand-Drawn
 *            Characters.  ACM Transactions on Graphics 33 (2), 2014.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "sheets/sheets.h"
#include "solve/laplace.h"

#define REACH       1.0  /* the window reaches beyond the visible part by so many of its sizes; chosen */
#define MOST_CELLS  160  /* along a window; chosen: finer ones change shapes by less than the width of a line */
#define TOLERANCE   5e-3
#define GUIDE       1.5  /* length of a guide, in lengths of the gap that it closes; chosen with FITTED */
#define LEAST_GUIDE 0.01 /* of the picture's diagonal */
#define STRAIGHTENS 0.5  /* share of a guide's length on which its curvature fades out; chosen */
#define GUIDE_STEP  0.5  /* cells */
#define GUIDE_START 1.5  /* cells before the end of the outline, so that nothing flows round */
#define LEAST_FLOW  1e-3 /* across a guide, and out of strokes */

enum { OUTSIDE, INSIDE, OPEN, PAINTED, THIN };

typedef struct
{
  const CeldSheetView *view;
  CeldDiffusion       *d;
  uint8_t             *kind;          /* of each cell */
  float               *east, *south;  /* flow to the next cell */
} DiffusionWork;

static size_t
cell_at (const CeldDiffusion *d, int x, int y)
{
  return (size_t) y * (size_t) d->across + (size_t) x;
}

/* ------------------------------------------------------------------ cells */

static void
choose_window (const CeldSheetView *view, CeldDiffusion *d)
{
  CeldRect seen = view->seen;
  int      size = seen.width > seen.height ? seen.width : seen.height, reach = (int) (REACH * size) + 2;
  int      width = view->own->owner.width, height = view->own->owner.height;
  int      left = seen.x > reach ? seen.x - reach : 0, top = seen.y > reach ? seen.y - reach : 0;
  int      right = seen.x + seen.width + reach, bottom = seen.y + seen.height + reach, longer;

  right  = right < width ? right : width;
  bottom = bottom < height ? bottom : height;
  d->window = celd_hidden_strokes_window (view, (CeldRect) { left, top, right - left, bottom - top });
  longer    = d->window.width > d->window.height ? d->window.width : d->window.height;
  d->cell   = (longer + MOST_CELLS - 1) / MOST_CELLS;
  d->across = (d->window.width + d->cell - 1) / d->cell;
  d->down   = (d->window.height + d->cell - 1) / d->cell;
}

/* Beside the window, but for the frame of the picture, is the outside. */
static bool
is_at_side (const DiffusionWork *w, int x, int y)
{
  const CeldDiffusion *d = w->d;
  CeldRect             box = d->window;

  return (x == 0 && box.x > 0) || (y == 0 && box.y > 0) ||
         (x == d->across - 1 && box.x + box.width < w->view->own->owner.width) ||
         (y == d->down - 1 && box.y + box.height < w->view->own->owner.height);
}

/* The kind of a cell by its middle, and by the strokes that touch it. */
static uint8_t
kind_of (const DiffusionWork *w, int x, int y)
{
  const CeldSheetView *v = w->view;
  const CeldDiffusion *d = w->d;
  int                  px = d->window.x + x * d->cell + d->cell / 2, py = d->window.y + y * d->cell + d->cell / 2;
  uint32_t             label, hint;

  px    = px < v->own->owner.width ? px : v->own->owner.width - 1;
  py    = py < v->own->owner.height ? py : v->own->owner.height - 1;
  label = celd_larger_label (v->own, px, py);
  if (label == v->label)
    return INSIDE;
  if (v->standing[label - 1] != CELD_HIDING)
    return OUTSIDE;
  hint = celd_hidden_stroke_at (v, d, x, y);
  return hint == v->label ? PAINTED : !hint && !is_at_side (w, x, y) ? OPEN : OUTSIDE;
}

/* Whether some pixel of a cell belongs to the region, if only in part. */
static bool
is_touched (const DiffusionWork *w, int x, int y)
{
  const CeldOwnership *own = w->view->own;
  uint32_t             label = w->view->label;
  const CeldDiffusion *d = w->d;
  int                  left = d->window.x + x * d->cell, top = d->window.y + y * d->cell;

  for (int py = top; py < top + d->cell && py < own->owner.height; py++)
    for (int px = left; px < left + d->cell && px < own->owner.width; px++)
      if (CELD_AT (&own->owner, px, py) == label ||
          (CELD_AT (&own->under, px, py) == label && CELD_AT (&own->coverage, px, py) < 1))
        return true;
  return false;
}

/* Whether a cell or one of its eight neighbours has its middle in the region. */
static bool
is_at_region (const DiffusionWork *w, int x, int y)
{
  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < w->d->down; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < w->d->across; u++)
      if (w->kind[cell_at (w->d, u, v)] == INSIDE)
        return true;
  return false;
}

/* What is thinner than a cell may have the middle of none, such as a thin region, or the rim of a thick line beyond a
 * nearer region: then it has all that it touches. */
static void
mark_thin (const DiffusionWork *w)
{
  const CeldDiffusion *d = w->d;
  CeldRect             seen = w->view->seen;
  size_t               cells = (size_t) d->across * (size_t) d->down;

  for (int y = (seen.y - d->window.y) / d->cell; y <= (seen.y + seen.height - 1 - d->window.y) / d->cell; y++)
    for (int x = (seen.x - d->window.x) / d->cell; x <= (seen.x + seen.width - 1 - d->window.x) / d->cell; x++)
      if (!is_at_region (w, x, y) && is_touched (w, x, y))
        w->kind[cell_at (d, x, y)] = THIN;
  for (size_t c = 0; c < cells; c++)
    if (w->kind[c] == THIN)
      w->kind[c] = INSIDE;
}

/* Spreads the mark `wanted` from inside and painted cells over neighbouring open ones; the others become outside. */
static CeldStatus
keep_connected (DiffusionWork *w)
{
  const CeldDiffusion *d = w->d;
  size_t               cells = (size_t) d->across * (size_t) d->down, n = 0;
  uint32_t            *queue = celd_alloc (cells, sizeof *queue);
  uint8_t             *wanted = celd_alloc0 (cells, 1);

  if (!queue || !wanted)
    {
      celd_free (queue);
      celd_free (wanted);
      return CELD_NO_MEMORY;
    }
  for (size_t c = 0; c < cells; c++)
    if (w->kind[c] == INSIDE || w->kind[c] == PAINTED)
      {
        wanted[c]  = 1;
        queue[n++] = (uint32_t) c;
      }
  for (size_t i = 0; i < n; i++)
    {
      size_t across = (size_t) d->across, c = queue[i], x = c % across;
      size_t near[4] = { x ? c - 1 : c, x + 1 < across ? c + 1 : c, c >= across ? c - across : c,
                         c + across < cells ? c + across : c };

      for (int k = 0; k < 4; k++)
        if (w->kind[near[k]] == OPEN && !wanted[near[k]])
          {
            wanted[near[k]] = 1;
            queue[n++] = (uint32_t) near[k];
          }
    }
  for (size_t c = 0; c < cells; c++)
    if (!wanted[c])
      w->kind[c] = OUTSIDE;
  celd_free (queue);
  celd_free (wanted);
  return CELD_OK;
}

/* ------------------------------------------------------------------ guides */

static void
limit (float *flow, double most)
{
  *flow = fminf (*flow, (float) most);
}

/* Limits the flow between painted cells and others. */
static void
cut_round_strokes (const DiffusionWork *w)
{
  const CeldDiffusion *d = w->d;

  for (int y = 0; y < d->down; y++)
    for (int x = 0; x < d->across; x++)
      {
        size_t c = cell_at (d, x, y);

        if (x + 1 < d->across && (w->kind[c] == PAINTED) != (w->kind[c + 1] == PAINTED))
          limit (&w->east[c], LEAST_FLOW);
        if (y + 1 < d->down && (w->kind[c] == PAINTED) != (w->kind[c + (size_t) d->across] == PAINTED))
          limit (&w->south[c], LEAST_FLOW);
      }
}

/* Limits the flow between cells whose centres lie on both sides of the step from (x,y) to (to_x,to_y), in cells. */
static void
cut (const DiffusionWork *w, double x, double y, double to_x, double to_y, double flow)
{
  const CeldDiffusion *d = w->d;
  double               column = floor (x - 0.5), row = floor (y - 0.5);
  double               to_column = floor (to_x - 0.5), to_row = floor (to_y - 0.5);

  if (to_row > row || to_row < row)
    {
      double line = fmax (row, to_row) + 0.5, across = x + (to_x - x) * (line - y) / (to_y - y);
      int    cx = (int) floor (across - 0.5), cy = (int) line;

      if (cy >= 0 && cy < d->down && cx >= 0 && cx + 1 < d->across)
        limit (&w->east[cell_at (d, cx, cy)], flow);
    }
  if (to_column > column || to_column < column)
    {
      double line = fmax (column, to_column) + 0.5, along = y + (to_y - y) * (line - x) / (to_x - x);
      int    cx = (int) line, cy = (int) floor (along - 0.5);

      if (cx >= 0 && cx < d->across && cy >= 0 && cy + 1 < d->down)
        limit (&w->south[cell_at (d, cx, cy)], flow);
    }
}

/* Draws the continuation of an end of the outline. */
static void
guide (const DiffusionWork *w, const CeldOutlineEnd *end)
{
  const CeldDiffusion *d = w->d;
  double               diagonal = hypot (w->view->own->owner.width, w->view->own->owner.height);
  double               length = fmax (GUIDE * end->gap, LEAST_GUIDE * diagonal) / d->cell;
  double               direction = end->direction;
  double               x = (end->x - d->window.x) / d->cell - GUIDE_START * cos (direction);
  double               y = (end->y - d->window.y) / d->cell - GUIDE_START * sin (direction);

  for (double s = -GUIDE_START; s < length; s += GUIDE_STEP)
    {
      double along = fmax (s, 0) / length, curved = fmax (0, 1 - along / STRAIGHTENS), to_x, to_y;

      direction += end->curvature * d->cell * curved * GUIDE_STEP;
      to_x = x + GUIDE_STEP * cos (direction);
      to_y = y + GUIDE_STEP * sin (direction);
      cut (w, x, y, to_x, to_y, fmax (along * along * along, LEAST_FLOW));
      x = to_x;
      y = to_y;
    }
}

/* ------------------------------------------------------------------ */

static CeldStatus
prepare (DiffusionWork *w)
{
  CeldDiffusion  *d = w->d;
  CeldOutlineEnds ends = { 0 };
  size_t          cells = (size_t) d->across * (size_t) d->down;
  CeldStatus      status;

  d->inside = celd_alloc0 (cells, sizeof *d->inside);
  w->kind   = celd_alloc (cells, 1);
  w->east   = celd_alloc (cells, sizeof *w->east);
  w->south  = celd_alloc (cells, sizeof *w->south);
  if (!d->inside || !w->kind || !w->east || !w->south)
    return CELD_NO_MEMORY;
  for (int y = 0; y < d->down; y++)
    for (int x = 0; x < d->across; x++)
      w->kind[cell_at (d, x, y)] = kind_of (w, x, y);
  for (size_t c = 0; c < cells; c++)
    w->east[c] = w->south[c] = 1;
  mark_thin (w);
  cut_round_strokes (w);
  status = keep_connected (w);
  if (status == CELD_OK)
    status = celd_outline_ends_find (w->view, &ends, &d->pen);
  for (size_t i = 0; i < ends.n && status == CELD_OK; i++)
    guide (w, &ends.item[i]);
  celd_free (ends.item);
  return status;
}

/* The box of open cells and their neighbours; width 0 if there are none. */
static CeldRect
box_of_open (const DiffusionWork *w)
{
  const CeldDiffusion *d = w->d;
  CeldRect             box = { 0 };
  int                  right, below;

  for (int y = 0; y < d->down; y++)
    for (int x = 0; x < d->across; x++)
      if (w->kind[cell_at (d, x, y)] == OPEN)
        box = celd_rect_union (box, (CeldRect) { x, y, 1, 1 });
  if (!box.width)
    return box;
  right = box.x + box.width < d->across ? box.x + box.width + 1 : d->across;
  below = box.y + box.height < d->down ? box.y + box.height + 1 : d->down;
  box.x -= box.x > 0;
  box.y -= box.y > 0;
  return (CeldRect) { box.x, box.y, right - box.x, below - box.y };
}

/* The equations of the cells of a box; planes of its size. */
typedef struct { CeldRect box; float *east, *south, *x; uint8_t *fixed; } BoxEquations;

static void
write_equations (const DiffusionWork *w, const BoxEquations *e)
{
  size_t i = 0;

  for (int y = e->box.y; y < e->box.y + e->box.height; y++)
    for (int x = e->box.x; x < e->box.x + e->box.width; x++, i++)
      {
        size_t c = cell_at (w->d, x, y);

        e->east[i]  = w->east[c];
        e->south[i] = w->south[c];
        e->x[i]     = w->d->inside[c];
        e->fixed[i] = w->kind[c] != OPEN;
      }
}

static CeldStatus
solve (const DiffusionWork *w, const CeldHost *host)
{
  const CeldDiffusion *d = w->d;
  BoxEquations         e = { .box = box_of_open (w) };
  CeldLaplace         *laplace = NULL;
  size_t               width = (size_t) e.box.width, n = width * (size_t) e.box.height;
  CeldStatus           status;

  for (size_t c = 0; c < (size_t) d->across * (size_t) d->down; c++)
    d->inside[c] = w->kind[c] == INSIDE || w->kind[c] == PAINTED;
  if (!n)
    return CELD_OK;
  e.east  = celd_alloc (n, sizeof *e.east);
  e.south = celd_alloc (n, sizeof *e.south);
  e.x     = celd_alloc (n, sizeof *e.x);
  e.fixed = celd_alloc (n, 1);
  status  = e.east && e.south && e.x && e.fixed ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      write_equations (w, &e);
      status = celd_lap_setup (e.box.width, e.box.height, e.east, e.south, NULL, e.fixed, host, &laplace);
    }
  if (status == CELD_OK)
    status = celd_lap_solve (laplace, 1, NULL, e.x, TOLERANCE, host, NULL);
  for (int y = 0; y < e.box.height && status == CELD_OK; y++)
    memcpy (d->inside + cell_at (d, e.box.x, e.box.y + y), e.x + (size_t) y * width, width * sizeof *e.x);
  celd_lap_free (laplace);
  celd_free (e.east);
  celd_free (e.south);
  celd_free (e.x);
  celd_free (e.fixed);
  return status;
}

static CeldStatus
measure_distance (const DiffusionWork *w, const CeldHost *host)
{
  CeldDiffusion *d = w->d;
  size_t         cells = (size_t) d->across * (size_t) d->down;
  uint8_t       *inside = celd_alloc (cells, 1);
  CeldStatus     status;

  d->distance = celd_alloc (cells, sizeof *d->distance);
  if (!inside || !d->distance)
    {
      celd_free (inside);
      return CELD_NO_MEMORY;
    }
  for (size_t c = 0; c < cells; c++)
    inside[c] = w->kind[c] == INSIDE;
  status = celd_distance (d->across, d->down, inside, host, d->distance);
  for (size_t c = 0; c < cells && status == CELD_OK; c++)
    if (w->kind[c] == OUTSIDE)
      d->distance[c] = -1;
  celd_free (inside);
  return status;
}

void
celd_diffusion_clear (CeldDiffusion *d)
{
  celd_free (d->inside);
  celd_free (d->distance);
  *d = (CeldDiffusion) { 0 };
}

CeldStatus
celd_diffusion_new (const CeldSheetView *view, const CeldHost *host, CeldDiffusion *d)
{
  DiffusionWork       w = { .view = view, .d = d };
  CeldStatus status;

  *d = (CeldDiffusion) { 0 };
  choose_window (view, d);
  status = prepare (&w);
  if (status == CELD_OK)
    status = solve (&w, host);
  if (status == CELD_OK)
    status = measure_distance (&w, host);
  celd_free (w.kind);
  celd_free (w.east);
  celd_free (w.south);
  if (status != CELD_OK)
    celd_diffusion_clear (d);
  return status;
}
