/* Exact Euclidean distance transform, and the nearest pixel.
 *
 * After Meijster, Roerdink and Hesselink, "A general algorithm for computing distance transforms in linear time", 2000:
 * a vertical pass gives each pixel the distance g to the nearest inside pixel of its own column; then in each row the
 * squared distance at x is the lower envelope of the parabolas (x - i)^2 + g(i)^2, found with integers alone.  The
 * vertical pass runs along rows for the cache's sake.  In a row nothing beyond an inside pixel can be nearer than that
 * pixel, so each gap between inside pixels has its own envelope, and inside pixels cost almost nothing.
 *
 * Squares stay below 2 * CELD_MAX_SIDE^2 = 8e8 and are exact in int32_t.  O(pixels) time; three rows of work space per
 * job.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#define NO_SITE (1 << 20)   /* a column distance from here on means that the column has no inside pixel */
#define COLUMNS_PER_JOB 256        /* columns a job of the vertical pass */
#define ROWS_PER_JOB 16          /* rows a job of the horizontal pass */
#define JOBS_PER_ROUND 16          /* jobs between two reports of progress */

typedef struct { int site, from; } EnvelopeArc; /* the parabola of column `site` is lowest from column `from` on */

typedef struct
{
  int            width, height;
  const uint8_t *inside;
  int32_t       *squared;   /* g after the vertical pass, squared distances in the end */
  int32_t       *nearest;   /* NULL if not asked for */
  int32_t       *column;    /* for each job a copy of a row of g */
  EnvelopeArc   *envelope;  /* for each job the lower envelope of a gap */
  int            first;     /* the first strip or band of this round of jobs */
} Transform;

/* Computes g for one strip of columns: down the picture, then up again. */
static void
measure_columns (void *data, int job)
{
  const Transform *t = data;
  int              left = (t->first + job) * COLUMNS_PER_JOB, beyond = left + COLUMNS_PER_JOB;
  int              right = beyond < t->width ? beyond : t->width;
  size_t           w = (size_t) t->width;

  for (int y = 0; y < t->height; y++)
    {
      const uint8_t *inside = t->inside + (size_t) y * w;
      int32_t       *g = t->squared + (size_t) y * w;

      if (y == 0)
        for (int x = left; x < right; x++)
          g[x] = inside[x] ? 0 : NO_SITE;
      else
        for (int x = left; x < right; x++)
          g[x] = inside[x] ? 0 : g[x - (ptrdiff_t) w] + 1;
    }
  for (int y = t->height - 2; y >= 0; y--)
    {
      int32_t *g = t->squared + (size_t) y * w;

      for (int x = left; x < right; x++)
        g[x] = g[x] < g[x + (ptrdiff_t) w] + 1 ? g[x] : g[x + (ptrdiff_t) w] + 1;
    }
}

static inline int32_t
parabola (const int32_t *g, int site, int x)
{
  return (x - site) * (x - site) + g[site] * g[site];
}

/* Finds the lower envelope over the columns from .. to; returns the number of arcs. */
static int
find_envelope (const int32_t *g, int from, int to, EnvelopeArc *arc)
{
  int n = 0;

  for (int u = from; u <= to; u++)
    {
      int begin = from;

      if (g[u] >= NO_SITE)
        continue;
      while (n > 0 && parabola (g, arc[n - 1].site, arc[n - 1].from) > parabola (g, u, arc[n - 1].from))
        n--;
      if (n > 0)
        {
          int i = arc[n - 1].site; /* the last column where i is not higher than u; never negative here */

          begin = 1 + ((u - i) * (u + i) + g[u] * g[u] - g[i] * g[i]) / (2 * (u - i));
        }
      if (begin <= to)
        arc[n++] = (EnvelopeArc) { u, begin };
    }
  return n;
}

/* The index of the inside pixel at the distance g above or below (x,y). */
static int32_t
column_end (const Transform *t, int x, int y, int g)
{
  bool above = y >= g && t->inside[(size_t) (y - g) * (size_t) t->width + (size_t) x];

  return (int32_t) (above ? y - g : y + g) * t->width + x;
}

/* Computes the distances in row y of the columns from .. to, from the column distances there. */
static void
measure_gap (const Transform *t, int y, const int32_t *g, int from, int to, EnvelopeArc *arc)
{
  int      n = find_envelope (g, from, to, arc);
  int32_t *squared = t->squared + (size_t) y * (size_t) t->width;
  int32_t *nearest = t->nearest ? t->nearest + (size_t) y * (size_t) t->width : NULL;

  for (int x = from; n == 0 && x <= to; x++)
    {
      squared[x] = INT32_MAX;
      if (nearest)
        nearest[x] = -1;
    }
  for (int k = 0; k < n; k++)
    {
      int site = arc[k].site, end = k + 1 < n ? arc[k + 1].from : to + 1;
      int pixel = nearest ? column_end (t, site, y, g[site]) : 0;

      for (int x = arc[k].from; x < end; x++)
        {
          squared[x] = parabola (g, site, x);
          if (nearest)
            nearest[x] = pixel;
        }
    }
}

static void
measure_row (const Transform *t, int y, int32_t *g, EnvelopeArc *arc)
{
  int w = t->width, last = 0; /* the last inside pixel, or the first column */

  for (int x = 0; x < w; x++)
    g[x] = t->squared[(size_t) y * (size_t) w + (size_t) x];
  for (int x = 0; x < w; x++)
    if (g[x] == 0 || x == w - 1)
      {
        if (g[x] || g[last] || x - last > 1)
          measure_gap (t, y, g, last, x, arc);
        else if (t->nearest)
          t->nearest[y * w + x] = y * w + x;
        last = x;
      }
}

static void
measure_rows (void *data, int job)
{
  const Transform *t = data;
  int              top = (t->first + job) * ROWS_PER_JOB, beyond = top + ROWS_PER_JOB;
  int              end = beyond < t->height ? beyond : t->height;

  for (int y = top; y < end; y++)
    measure_row (t, y, t->column + (size_t) job * (size_t) t->width, t->envelope + (size_t) job * (size_t) t->width);
}

static CeldStatus
transform (int width, int height, const uint8_t *inside, const CeldHost *host, int32_t *squared, int32_t *nearest)
{
  Transform  t = { width, height, inside, squared, nearest, NULL, NULL, 0 };
  CeldStatus status = CELD_NO_MEMORY;

  if (width < 1 || height < 1 || width > CELD_MAX_SIDE || height > CELD_MAX_SIDE)
    return CELD_BAD_SIZE;
  t.column = celd_alloc ((size_t) width * JOBS_PER_ROUND, sizeof *t.column);
  t.envelope = celd_alloc ((size_t) width * JOBS_PER_ROUND, sizeof *t.envelope);
  if (!t.column || !t.envelope)
    goto done;
  status = celd_parallel_rounds (host, (width + COLUMNS_PER_JOB - 1) / COLUMNS_PER_JOB, JOBS_PER_ROUND, measure_columns,
                                 &t, &t.first, 0, 0.4);
  if (status == CELD_OK)
    status = celd_parallel_rounds (host, (height + ROWS_PER_JOB - 1) / ROWS_PER_JOB, JOBS_PER_ROUND, measure_rows,
                                   &t, &t.first, 0.4, 1);
done:
  celd_free (t.column);
  celd_free (t.envelope);
  return status;
}

CeldStatus
celd_distance (int width, int height, const uint8_t *inside, const CeldHost *host, int32_t *squared)
{
  return transform (width, height, inside, host, squared, NULL);
}

CeldStatus
celd_nearest (int width, int height, const uint8_t *inside, const CeldHost *host, int32_t *squared, int32_t *nearest)
{
  return transform (width, height, inside, host, squared, nearest);
}
