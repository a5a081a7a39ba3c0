/* Signed distances: of paper to ink, positive, and of ink to paper, negative, at once.
 *
 * As distance.c, after Meijster, Roerdink and Hesselink 2000: column distances, here positive on paper and negative in
 * ink, then the lower envelope of the parabolas (x - u)^2 + g(u)^2 along each row.  A run of paper ends at ink and a
 * run of ink at paper, so each run has its own envelope.  All parabolas are equally wide, so the envelope is the lower
 * convex hull of the points (u, u^2 + g(u)^2): most columns are ruled out by comparing each with a few neighbours,
 * which vector instructions do for many at once; the hull of the others is found from left to right (Andrew 1979).
 *
 * O(pixels) time; some rows of work space per job.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <stdlib.h>

#define NO_SIGN_CHANGE    (1 << 20) /* a column distance from here on: there is none */
#define SIGNED_COLUMNS    4096      /* columns a job of the vertical pass */
#define SIGNED_ROWS    16        /* rows a job of the horizontal pass */
#define SIGNED_JOBS    16        /* jobs at once */
#define MARGIN  8         /* columns that may be looked at, or written, beyond both ends of a row */
#define LARGEST_SQUARE    (1 << 25) /* a square that stands for all larger ones when sites are sifted */
#define SIFTED_SQUARE   (1 << 20) /* sites with larger squares are not sifted */

typedef struct { int column; int32_t f; } Site; /* f: squares of the column and of its column distance */

/* The work space of one job, by column. */
typedef struct
{
  int32_t *height;    /* squares of the column distances, LARGEST_SQUARE at most; MARGIN more at both ends */
  int32_t *result;    /* MARGIN more */
  uint8_t *keep;      /* may this be a site? */
  uint8_t *change;    /* 0x80: the next one has another sign */
  Site    *site;      /* two more */
} JobSpace;

typedef struct
{
  const CeldPlane *ink;
  int32_t         *squared;   /* signed column distances, then signed squares */
  JobSpace         space[SIGNED_JOBS];
  int              first;
} Signed;

/* The signed column distance of a pixel, as far as the neighbour that leads to `next` tells. */
static inline int32_t
step_on (bool paper, int32_t next)
{
  return paper ? (next > 0 ? next + 1 : 1) : (next < 0 ? next - 1 : -1);
}

CELD_CLONES static void
step_down (int n, const float *restrict ink, const int32_t *restrict above, int32_t *restrict g)
{
  for (int x = 0; x < n; x++)
    g[x] = step_on (celd_is_paper (ink[x]), above[x]);
}

CELD_CLONES static void
step_up (int n, const int32_t *restrict below, int32_t *restrict g)
{
  for (int x = 0; x < n; x++)
    {
      int32_t next = step_on (g[x] > 0, below[x]);

      g[x] = abs (next) < abs (g[x]) ? next : g[x];
    }
}

/* The vertical pass, as measure_columns in distance.c. */
static void
measure_signed_columns (void *data, int job)
{
  const Signed *t = data;
  int           w = t->ink->width, h = t->ink->height, left = (t->first + job) * SIGNED_COLUMNS;
  int           n = left + SIGNED_COLUMNS < w ? SIGNED_COLUMNS : w - left;
  int32_t      *g = t->squared + left;

  for (int x = 0; x < n; x++)
    g[x] = celd_is_paper (CELD_AT (t->ink, left + x, 0)) ? NO_SIGN_CHANGE : -NO_SIGN_CHANGE;
  for (int y = 1; y < h; y++)
    step_down (n, &CELD_AT (t->ink, left, y), g + (size_t) (y - 1) * (size_t) w, g + (size_t) y * (size_t) w);
  for (int y = h - 2; y >= 0; y--)
    step_up (n, g + (size_t) (y + 1) * (size_t) w, g + (size_t) y * (size_t) w);
}

CELD_CLONES static void
prepare_row (int w, const int32_t *restrict g, int32_t *restrict height, uint8_t *restrict change)
{
  for (int x = 0; x < w; x++)
    height[x] = abs (g[x]) < 5792 ? g[x] * g[x] : LARGEST_SQUARE; /* 5792^2 is just below LARGEST_SQUARE */
  for (int x = 0; x + 1 < w; x++)
    change[x] = (uint8_t) ((g[x] ^ g[x + 1]) < 0 ? 0x80 : 0);
  change[w - 1] = 0x80;
}

/* Whether the parabola of column x is nowhere below both those of x - a and x + b. */
#define HIDDEN(a, b) (b * (height[x - a] - h) + a * (height[x + b] - h) + a * b * (a + b) <= 0)

/* Most parabolas are hidden by two others a few columns away.  (Beyond a change of sign a square is not that of a site,
 * but it is no less, so nothing is ruled out wrongly.) */
CELD_CLONES static void
sift_sites (int w, const int32_t *restrict height, uint8_t *restrict keep)
{
  for (int x = 0; x < w; x++)
    {
      int32_t h = height[x];
      bool    hidden = HIDDEN (1, 1) | HIDDEN (1, 2) | HIDDEN (2, 1) | HIDDEN (1, 4) | HIDDEN (4, 1) | HIDDEN (3, 3) |
                       HIDDEN (1, 8) | HIDDEN (8, 1);

      keep[x] = !(hidden & (h < SIFTED_SQUARE));
    }
}

/* The lower envelope of parabolas is the lower convex hull of the points (u, u^2 + g^2): those of the columns
 * left .. end - 1, of the paper or ink that these are, and of the pixels that bound them. */
static int
find_hull (const int32_t *row, int w, const uint8_t *keep, int left, int end, Site *site)
{
  int n = 0, kept = 0;

  if (left > 0)
    site[n++] = (Site) { left - 1, (left - 1) * (left - 1) };
  for (int x = left; x < end; x++)
    {
      site[n].column = x;
      n += keep[x];
    }
  if (end < w)
    site[n++] = (Site) { end, end * end };
  for (int i = 0; i < n; i++)
    {
      int     u = site[i].column;
      int32_t g = u < left || u >= end ? 0 : row[u], f;

      if (abs (g) >= NO_SIGN_CHANGE)
        continue;
      f = u * u + g * g;
      while (kept > 1 && (int64_t) (site[kept - 1].f - site[kept - 2].f) * (u - site[kept - 1].column) >=
                         (int64_t) (f - site[kept - 1].f) * (site[kept - 1].column - site[kept - 2].column))
        kept--;
      site[kept++] = (Site) { u, f };
    }
  return kept;
}

/* The first column where a site's parabola is below that of the one before. */
static inline int
find_begin (const Site *site)
{
  int32_t up = site[0].f - site[-1].f;

  return up < 0 ? 0 : 1 + up / (2 * (site[0].column - site[-1].column));
}

/* Squares in the columns left .. end - 1, and anything in some beyond. */
CELD_CLONES static void
draw_arcs (const Site *site, int n, int left, int end, int32_t *restrict result)
{
  for (int x = left; n == 0 && x < end; x++)
    result[x] = INT32_MAX;
  for (int k = 0, begin = left, stop; k < n && begin < end; k++, begin = stop)
    {
      int u = site[k].column, h = site[k].f - u * u;

      stop = k + 1 < n ? find_begin (site + k + 1) : end;
      stop = stop < begin ? begin : stop > end ? end : stop;
      for (int x = begin; x < stop; x += MARGIN)
        for (int i = 0; i < MARGIN; i++)
          result[x + i] = (x + i - u) * (x + i - u) + h;
    }
}

CELD_CLONES static void
set_signs (int w, const int32_t *restrict result, int32_t *restrict row)
{
  for (int x = 0; x < w; x++)
    row[x] = row[x] > 0 ? result[x] : -result[x];
}

static void
measure_signed_row (int32_t *row, int w, const JobSpace *space)
{
  prepare_row (w, row, space->height + MARGIN, space->change);
  sift_sites (w, space->height + MARGIN, space->keep);
  for (int left = 0, end; left < w; left = end)
    {
      end = celd_next_marked (w, space->change, left) + 1;
      draw_arcs (space->site, find_hull (row, w, space->keep, left, end, space->site), left, end, space->result);
    }
  set_signs (w, space->result, row);
}

static void
measure_signed_rows (void *data, int job)
{
  const Signed *t = data;
  int           h = t->ink->height, top = (t->first + job) * SIGNED_ROWS;
  int           end = top + SIGNED_ROWS < h ? top + SIGNED_ROWS : h;

  for (int y = top; y < end; y++)
    measure_signed_row (t->squared + (size_t) y * (size_t) t->ink->width, t->ink->width, &t->space[job]);
}

/* ------------------------------------------------------------------ all of it */

static bool
space_new (int width, JobSpace *space)
{
  size_t w = (size_t) width;

  *space = (JobSpace) {
    .height = celd_alloc (w + 2 * MARGIN, sizeof *space->height),
    .result = celd_alloc (w + MARGIN, sizeof *space->result),
    .keep   = celd_alloc (w, 1),
    .change = celd_alloc (w, 1),
    .site   = celd_alloc (w + 2, sizeof *space->site),
  };
  for (size_t i = 0; space->height && i < MARGIN; i++)
    space->height[i] = space->height[w + MARGIN + i] = LARGEST_SQUARE;
  return space->height && space->result && space->keep && space->change && space->site;
}

static void
space_clear (JobSpace *space)
{
  celd_free (space->height);
  celd_free (space->result);
  celd_free (space->keep);
  celd_free (space->change);
  celd_free (space->site);
}

CeldStatus
celd_signed_distance (const CeldPlane *ink, const CeldHost *host, int32_t *squared)
{
  Signed     t = { .ink = ink, .squared = squared };
  CeldStatus status = CELD_OK;

  if (!CELD_SAME_SIZE (ink, ink))
    return CELD_BAD_SIZE;
  for (int i = 0; i < SIGNED_JOBS; i++)
    status = space_new (ink->width, &t.space[i]) ? status : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_parallel_rounds (host, (ink->width + SIGNED_COLUMNS - 1) / SIGNED_COLUMNS, SIGNED_JOBS,
                                   measure_signed_columns, &t, &t.first, 0, 0.4);
  if (status == CELD_OK)
    status = celd_parallel_rounds (host, (ink->height + SIGNED_ROWS - 1) / SIGNED_ROWS, SIGNED_JOBS,
                                   measure_signed_rows, &t, &t.first, 0.4, 1);
  for (int i = 0; i < SIGNED_JOBS; i++)
    space_clear (&t.space[i]);
  return status;
}
