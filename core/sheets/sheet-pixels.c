/* The hidden pixels of a sheet: where its likelihood, interpolated by quadratic B-splines, is above one half, with
 * antialiased coverage, and a margin round what is visible; and exactly what the artist painted, without what was
 * erased.  Only nearer sheets may lie above them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "sheets/sheets.h"

#define SURE_REACH 0.1  /* of the picture's diagonal: there confidence is 1/e of that beside visible evidence; chosen */
#define EMPTY      0.05f /* cells whose neighbours are all below this have no pixels */
#define STEEP_SHARE 4     /* change of a cell's share with its likelihood; chosen */
#define FULL       0.95f

typedef struct
{
  const CeldSheetView *view;
  const CeldDiffusion *d;
  const uint32_t      *rank;
  double               margin;   /* in pixels */
  float               *share;    /* of each cell: how much of it is inside, smoothed */
  uint8_t             *content;  /* of each cell */
  uint8_t             *confidence;
  CeldSheet           *sheet;
  size_t               run_capacity, pixel_capacity, confidence_capacity;
} Pixels;

/* ------------------------------------------------------------------ B-splines */

/* Weights of three neighbours and their derivatives, at a distance of t in [-1/2,1/2] cells from the middle one. */
typedef struct { float weight[3], slope[3]; int middle; } Spline;

static Spline
spline_at (int pixel, int cell)
{
  float u = ((float) pixel + 0.5f) / (float) cell - 0.5f;
  int   middle = pixel / cell;
  float t = u - (float) middle;

  return (Spline) { { 0.5f * (0.5f - t) * (0.5f - t), 0.75f - t * t, 0.5f * (0.5f + t) * (0.5f + t) },
                    { t - 0.5f, -2 * t, t + 0.5f }, middle };
}

static int
clamp (int i, int n)
{
  return i < 0 ? 0 : i < n ? i : n - 1;
}

/* Coverage of a pixel by what is above one half, from the value there and its slope. */
static float
coverage_at (const Pixels *p, const Spline *sx, const Spline *sy)
{
  const CeldDiffusion *d = p->d;
  float                value = 0, dx = 0, dy = 0, slope;

  for (int j = 0; j < 3; j++)
    {
      const float *row = p->share + (size_t) clamp (sy->middle + j - 1, d->down) * (size_t) d->across;

      for (int i = 0; i < 3; i++)
        {
          float inside = row[clamp (sx->middle + i - 1, d->across)];

          value += sx->weight[i] * sy->weight[j] * inside;
          dx    += sx->slope[i] * sy->weight[j] * inside;
          dy    += sx->weight[i] * sy->slope[j] * inside;
        }
    }
  slope = fmaxf (sqrtf (dx * dx + dy * dy) / (float) d->cell, 1e-6f);
  return fminf (fmaxf (0.5f + (value - 0.5f) / slope, 0), 1);
}

/* Do all of the nine cells round a cell lie above or below a value? */
static bool
all_beyond (const Pixels *p, int x, int y, float value, bool above)
{
  const CeldDiffusion *d = p->d;

  for (int v = y - 1; v <= y + 1; v++)
    for (int u = x - 1; u <= x + 1; u++)
      if ((p->share[(size_t) clamp (v, d->down) * (size_t) d->across + (size_t) clamp (u, d->across)] > value)
          != above)
        return false;
  return true;
}

/* ------------------------------------------------------------------ cells */

/* What a cell has of the silhouette: nothing, a part that the spline tells, or all of it; and whether any of it lies in
 * the margin: distances are those of middles, and both cells reach half a cell beyond. */
enum { CELL_NOTHING, CELL_PART, CELL_ALL, CELL_SHARE = 3, CELL_MARGIN = 4 };

static uint8_t
content_of (const Pixels *p, int x, int y)
{
  const CeldDiffusion *d = p->d;
  int32_t              distance = d->distance[(size_t) y * (size_t) d->across + (size_t) x];
  double               nearest = (sqrt ((double) distance) - 1) * d->cell;
  int                  margin = p->margin > 0 && distance >= 0 && nearest <= p->margin ? CELL_MARGIN : 0;

  if (all_beyond (p, x, y, EMPTY, false))
    return (uint8_t) (CELL_NOTHING | margin);
  return (uint8_t) ((all_beyond (p, x, y, FULL, true) ? CELL_ALL : CELL_PART) | margin);
}

/* Confidence in a cell, in 1/255: how clear the decision is, and how close it is to what is visible. */
static uint8_t
confidence_of (const Pixels *p, size_t cell)
{
  double reach = SURE_REACH * hypot (p->view->own->owner.width, p->view->own->owner.height);
  double distance = p->d->distance[cell] < 0 ? INFINITY : sqrt ((double) p->d->distance[cell]) * p->d->cell;

  return (uint8_t) (255 * (double) fabsf (2 * p->d->inside[cell] - 1) * exp (-distance / reach) + 0.5);
}

/* The share of each cell that is inside: 0 or 1 but near one half, averaged with the neighbours by binomial weights,
 * since outlines along guides are steps from cell to cell. */
static CeldStatus
find_shares (Pixels *p)
{
  const CeldDiffusion *d = p->d;
  size_t               across = (size_t) d->across, n = across * (size_t) d->down;
  float               *once = celd_alloc (n, sizeof *once);

  p->share = celd_alloc (n, sizeof *p->share);
  if (!once || !p->share)
    {
      celd_free (once);
      return CELD_NO_MEMORY;
    }
  for (size_t c = 0; c < n; c++)
    p->share[c] = fminf (fmaxf (0.5f + STEEP_SHARE * (d->inside[c] - 0.5f), 0), 1);
  for (size_t c = 0; c < n; c++)
    once[c] = 0.5f * p->share[c] + 0.25f * (p->share[c % across ? c - 1 : c] + p->share[(c + 1) % across ? c + 1 : c]);
  for (size_t c = 0; c < n; c++)
    p->share[c] = 0.5f * once[c] + 0.25f * (once[c < across ? c : c - across] + once[c + across < n ? c + across : c]);
  celd_free (once);
  return CELD_OK;
}

static CeldStatus
find_contents (Pixels *p)
{
  size_t n = (size_t) p->d->across * (size_t) p->d->down;

  p->content    = celd_alloc (n, 1);
  p->confidence = celd_alloc (n, 1);
  if (!p->content || !p->confidence)
    return CELD_NO_MEMORY;
  for (size_t c = 0; c < n; c++)
    {
      int x = (int) (c % (size_t) p->d->across), y = (int) (c / (size_t) p->d->across);

      p->content[c] = content_of (p, x, y);
      if (!(p->content[c] & CELL_SHARE) && celd_hidden_stroke_at (p->view, p->d, x, y) == p->view->label)
        p->content[c] |= CELL_PART;
      p->confidence[c] = p->content[c] ? confidence_of (p, c) : 0;
    }
  return CELD_OK;
}

/* ------------------------------------------------------------------ pixels */

static bool
is_hidden (const Pixels *p, uint32_t owner, uint32_t under, float share)
{
  uint32_t rank = p->rank[p->view->label - 1];

  return p->rank[owner - 1] > rank && (p->rank[under - 1] > rank || !(share < 1));
}

static CeldStatus
add_pixel (Pixels *p, int x, int y, uint8_t coverage, uint8_t confidence)
{
  CeldSheet *sheet = p->sheet;
  size_t     n = sheet->n_hidden;

  if (!celd_reserve_one (sheet->coverage, n, p->pixel_capacity) ||
      !celd_reserve_one (sheet->confidence, n, p->confidence_capacity) ||
      celd_sheet_run_add (&sheet->run, &sheet->n_runs, &p->run_capacity, x, y, n) != CELD_OK)
    return CELD_NO_MEMORY;
  sheet->coverage[n]   = coverage;
  sheet->confidence[n] = confidence;
  sheet->n_hidden++;
  return CELD_OK;
}

/* What the artist says of a pixel; 0: nothing. */
static uint32_t
hint_at (const Pixels *p, int x, int y)
{
  return p->view->hints ? CELD_AT (p->view->hints, x, y) : 0;
}

/* Adds the pixels of one row within a cell; the row counts in the window. */
static CeldStatus
add_pixels (Pixels *p, size_t cell, int y, const Spline *sy)
{
  const CeldDiffusion *d = p->d;
  const CeldOwnership *own = p->view->own;
  int                  share = p->content[cell] & CELL_SHARE, first = (int) (cell % (size_t) d->across) * d->cell;
  int                  end = first + d->cell < d->window.width ? first + d->cell : d->window.width;
  bool                 margin = p->content[cell] & CELL_MARGIN;
  CeldStatus           status = CELD_OK;

  for (int x = first; x < end && status == CELD_OK; x++)
    {
      int      px = d->window.x + x, py = d->window.y + y;
      uint32_t owner = CELD_AT (&own->owner, px, py), hint = hint_at (p, px, py);
      float    coverage = share == CELL_ALL;
      uint8_t  code;

      if (owner == p->view->label || hint == CELD_HIDDEN_ERASE ||
          !is_hidden (p, owner, CELD_AT (&own->under, px, py), CELD_AT (&own->coverage, px, py)))
        continue;
      if (share == CELL_PART)
        {
          Spline sx = spline_at (x, d->cell);

          coverage = coverage_at (p, &sx, sy);
        }
      code = (uint8_t) (255 * coverage + 0.5f);
      if (hint == p->view->label)
        status = add_pixel (p, px, py, 255, 255);
      else if (code || margin)
        status = add_pixel (p, px, py, code, p->confidence[cell]);
    }
  return status;
}

static CeldStatus
add_rows (Pixels *p)
{
  const CeldDiffusion *d = p->d;
  CeldStatus           status = CELD_OK;

  for (int y = 0; y < d->window.height && status == CELD_OK; y++)
    {
      size_t row = (size_t) (y / d->cell) * (size_t) d->across;
      Spline sy = spline_at (y, d->cell);

      for (size_t c = row; c < row + (size_t) d->across && status == CELD_OK; c++)
        if (p->content[c])
          status = add_pixels (p, c, y, &sy);
    }
  return status;
}

/* ------------------------------------------------------------------ islands */

static bool
is_visible (const Pixels *p, int x, int y)
{
  const CeldOwnership *own = p->view->own;
  uint32_t             label = p->view->label;

  if (x < 0 || y < 0 || x >= own->owner.width || y >= own->owner.height)
    return false;
  return CELD_AT (&own->owner, x, y) == label ||
         (CELD_AT (&own->under, x, y) == label && CELD_AT (&own->coverage, x, y) < 1);
}

static bool
touches_visible (const Pixels *p, const CeldSheetRun *run)
{
  if (is_visible (p, run->x - 1, run->y) || is_visible (p, run->x + run->n, run->y))
    return true;
  for (int x = run->x; x < run->x + run->n; x++)
    if (is_visible (p, x, run->y - 1) || is_visible (p, x, run->y + 1))
      return true;
  return false;
}

static bool
is_painted (const Pixels *p, const CeldSheetRun *run)
{
  for (int x = run->x; x < run->x + run->n; x++)
    if (hint_at (p, x, run->y) == p->view->label)
      return true;
  return false;
}

/* Joins the runs of neighbouring rows that overlap. */
static void
join_runs (const CeldSheet *sheet, uint32_t *parent)
{
  size_t above = 0;

  celd_roots (parent, sheet->n_runs);
  for (size_t i = 0; i < sheet->n_runs; i++)
    {
      const CeldSheetRun *run = &sheet->run[i];

      while (sheet->run[above].y < run->y - 1 ||
             (sheet->run[above].y == run->y - 1 && sheet->run[above].x + sheet->run[above].n <= run->x))
        above++;
      for (size_t k = above; sheet->run[k].y == run->y - 1 && sheet->run[k].x < run->x + run->n; k++)
        celd_join (parent, (uint32_t) k, (uint32_t) i);
    }
}

/* Drops hidden pixels that are connected neither with what is visible nor with strokes: nearer sheets can cut them
 * off. */
static CeldStatus
drop_islands (Pixels *p)
{
  CeldSheet *sheet = p->sheet;
  uint32_t  *parent = celd_alloc (sheet->n_runs, sizeof *parent);
  uint8_t   *kept = celd_alloc0 (sheet->n_runs, 1);
  bool       room = parent && kept;
  size_t     n = 0, runs = 0;

  if (room)
    {
      join_runs (sheet, parent);
      for (size_t i = 0; i < sheet->n_runs; i++)
        if (!kept[celd_root (parent, (uint32_t) i)] &&
            (touches_visible (p, &sheet->run[i]) || is_painted (p, &sheet->run[i])))
          kept[celd_root (parent, (uint32_t) i)] = 1;
      for (size_t i = 0; i < sheet->n_runs; i++)
        if (kept[celd_root (parent, (uint32_t) i)])
          {
            CeldSheetRun run = sheet->run[i];

            memmove (sheet->coverage + n, sheet->coverage + run.first, (size_t) run.n);
            memmove (sheet->confidence + n, sheet->confidence + run.first, (size_t) run.n);
            run.first = n;
            n += (size_t) run.n;
            sheet->run[runs++] = run;
          }
      sheet->n_runs   = runs;
      sheet->n_hidden = n;
    }
  celd_free (parent);
  celd_free (kept);
  return room ? CELD_OK : CELD_NO_MEMORY;
}

CeldStatus
celd_sheet_pixels (const CeldSheetView *view, const CeldDiffusion *d, const uint32_t *rank, double margin,
                   CeldSheet *sheet)
{
  Pixels     p = { .view = view, .d = d, .rank = rank, .margin = margin, .sheet = sheet };
  CeldStatus status = find_shares (&p);

  if (status == CELD_OK)
    status = find_contents (&p);
  if (status == CELD_OK)
    status = add_rows (&p);
  if (status == CELD_OK && sheet->n_runs)
    status = drop_islands (&p);
  sheet->box = sheet->seen;
  for (size_t i = 0; i < sheet->n_runs; i++)
    sheet->box = celd_rect_union (sheet->box, (CeldRect) { sheet->run[i].x, sheet->run[i].y, sheet->run[i].n, 1 });
  celd_free (p.share);
  celd_free (p.content);
  celd_free (p.confidence);
  return status;
}
