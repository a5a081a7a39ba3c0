/* The exact distance transform against the textbook one, in milliseconds a megapixel of processor time, and whether
 * both give the same: to the ink of a drawing, which is near everywhere, and to one pixel, which is far.
 *
 * The textbook is P. Felzenszwalb and D. Huttenlocher, "Distance Transforms of Sampled Functions", 2004 and 2012: lower
 * envelopes of parabolas, along columns, then along rows, in float.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"
#include "image/image.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define MOST_RUNS 99
#define FAR       1e20f         /* of a place that is not inside */

/* One row or column: d[q] = min over p of (q - p)^2 + f[p].  v, z: workspace of n and n + 1. */
static void
transform_line (const float *f, int n, float *d, int *v, float *z)
{
  int k = 0;

  v[0] = 0;
  z[0] = -INFINITY;
  z[1] = INFINITY;
  for (int q = 1; q < n; q++)
    {
      float s;

      do
        {
          int p = v[k];

          s = ((f[q] + (float) (q * q)) - (f[p] + (float) (p * p))) / (float) (2 * q - 2 * p);
        }
      while (s <= z[k] && k-- > 0);
      k++;
      v[k]     = q;
      z[k]     = s;
      z[k + 1] = INFINITY;
    }
  k = 0;
  for (int q = 0; q < n; q++)
    {
      while (z[k + 1] < (float) q)
        k++;
      d[q] = (float) ((q - v[k]) * (q - v[k])) + f[v[k]];
    }
}

static void
transform_as_published (int w, int h, const uint8_t *inside, float *squared)
{
  int    longest = w > h ? w : h;
  float *f = malloc ((size_t) longest * sizeof *f), *d = malloc ((size_t) longest * sizeof *d);
  float *z = malloc (((size_t) longest + 1) * sizeof *z);
  int   *v = malloc ((size_t) longest * sizeof *v);

  if (!f || !d || !z || !v)
    exit (1);
  for (int i = 0; i < w * h; i++)
    squared[i] = inside[i] ? 0 : FAR;
  for (int x = 0; x < w; x++)
    {
      for (int y = 0; y < h; y++)
        f[y] = squared[y * w + x];
      transform_line (f, h, d, v, z);
      for (int y = 0; y < h; y++)
        squared[y * w + x] = d[y];
    }
  for (int y = 0; y < h; y++)
    {
      for (int x = 0; x < w; x++)
        f[x] = squared[y * w + x];
      transform_line (f, w, squared + (size_t) y * (size_t) w, v, z);
    }
  free (f);
  free (d);
  free (z);
  free (v);
}

static void
measure (const char *what, int w, int h, const uint8_t *inside, int runs)
{
  size_t   n = (size_t) w * (size_t) h, different = 0;
  int32_t *ours = malloc (n * sizeof *ours);
  float   *textbook = malloc (n * sizeof *textbook);
  double   time[2][MOST_RUNS], start;
  char     name[80];

  if (!ours || !textbook)
    exit (1);
  for (int run = 0; run < runs; run++)
    {
      start = seconds ();
      must (celd_distance (w, h, inside, NULL, ours));
      time[0][run] = seconds () - start;
      start        = seconds ();
      transform_as_published (w, h, inside, textbook);
      time[1][run] = seconds () - start;
    }
  for (size_t i = 0; i < n; i++)
    different += (float) ours[i] < textbook[i] || (float) ours[i] > textbook[i];
  snprintf (name, sizeof name, "%s, ours", what);
  print_number (name, 1e9 * median (time[0], runs) / (double) n);
  snprintf (name, sizeof name, "%s, textbook", what);
  print_number (name, 1e9 * median (time[1], runs) / (double) n);
  snprintf (name, sizeof name, "%s, different pixels", what);
  print_number (name, (double) different);
  free (ours);
  free (textbook);
}

int
main (int argc, char **argv)
{
  if (argc != 3)
    {
      fprintf (stderr, "usage: bench-distance DRAWING RUNS\n");
      return 2;
    }

  CeldPlane drawing = read_grey (argv[1]);
  int       w = drawing.width, h = drawing.height, runs = atoi (argv[2]) < 1 ? 1 : atoi (argv[2]);
  size_t    n = (size_t) w * (size_t) h;
  uint8_t  *inside = malloc (n);

  if (!inside)
    return 1;
  runs = runs > MOST_RUNS ? MOST_RUNS : runs;
  printf ("{\n  \"pixels\": %zu", n);
  for (size_t i = 0; i < n; i++)
    inside[i] = !celd_is_paper (drawing.data[i]);
  measure ("near", w, h, inside, runs);
  memset (inside, 0, n);
  inside[n / 3] = 1;
  measure ("far", w, h, inside, runs);
  printf ("\n}\n");
  free (inside);
  celd_free (drawing.data);
  return 0;
}
