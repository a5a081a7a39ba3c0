/* Inflation of a part on its whole silhouette.
 *
 * Solves  laplacian f = -4  with f = 0 on the outline, which lies between pixels [Gibou et al.: A second-order-accurate
 * symmetric discretization of the Poisson equation on irregular domains, 2002], and insulated where the surface goes
 * on.  The height is sqrt f: a disc becomes a hemisphere and an ellipse an ellipsoid.
 *
 * That surface is vertical at its outline, where from the side a line would be many times as thick as it was drawn.  So
 * the part has a brim as wide as its line, with a gentle slope, and f begins at its inner side.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "relief/parts.h"
#include "solve/laplace.h"

#include <math.h>

#define LEAST_DISTANCE      0.05f /* of a pixel from the outline; chosen, as a bound of weights */
#define BRIM_SLOPE          0.5f  /* for bulge 1; chosen */
#define WIDEST_BRIM         1.25  /* in stroke widths of the drawing; chosen */

/* ------------------------------------------------------------------ distances from the outline */

/* The number of sides of a pixel at which the part ends. */
static int
ends_at (const CeldPart *part, int x, int y)
{
  int n = 0;

  for (int k = 0; k < 4 && celd_part_has (part, x, y); k++)
    {
      int to_x = x, to_y = y;

      celd_step (k, &to_x, &to_y);
      n += !celd_part_has (part, to_x, to_y) && !(part->open[celd_part_at (part, x, y)] & 1 << k);
    }
  return n;
}

/* Marks the pixels outside at which the part ends. */
static void
mark_outline (const CeldPart *part, uint8_t *outline)
{
  for (int y = 1; y < part->box.height - 1; y++)
    for (int x = 1; x < part->box.width - 1; x++)
      for (int k = 0; k < 4 && ends_at (part, x, y); k++)
        {
          int to_x = x, to_y = y;

          celd_step (k, &to_x, &to_y);
          if (!celd_part_has (part, to_x, to_y) && !(part->open[celd_part_at (part, x, y)] & 1 << k))
            outline[celd_part_at (part, to_x, to_y)] = 1;
        }
}

/* Makes `distance` that of each pixel's centre from the outline, negative outside. */
static CeldStatus
find_distances (const CeldPart *part, const CeldHost *host, float *distance)
{
  size_t     n = (size_t) part->box.width * (size_t) part->box.height;
  uint8_t   *outline = celd_alloc0 (n, 1);
  int32_t   *squared = celd_alloc (n, sizeof *squared), *nearest = celd_alloc (n, sizeof *nearest);
  CeldStatus status = outline && squared && nearest ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      mark_outline (part, outline);
      status = celd_nearest (part->box.width, part->box.height, outline, host, squared, nearest);
    }
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    if (part->coverage[i] > CELD_COVERED)
      distance[i] = nearest[i] < 0 ? INFINITY
                                   : sqrtf ((float) squared[i]) - (CELD_COVERED - part->coverage[nearest[i]]);
    else
      distance[i] = part->coverage[i] - CELD_COVERED;
  celd_free (outline);
  celd_free (squared);
  celd_free (nearest);
  return status;
}

/* The mean width of the visible line along the outline, in pixels. */
static float
line_width (const CeldParts *parts, size_t k, const float *distance, int stroke)
{
  const CeldPart *part = &parts->item[k];
  double          sum = 0, sides = 0;

  for (int y = 1; y < part->box.height - 1; y++)
    for (int x = 1; x < part->box.width - 1; x++)
      {
        size_t i = celd_part_at (part, x, y);
        int    u = part->box.x + x, v = part->box.y + y;

        if (distance[i] > 0 && (double) distance[i] < WIDEST_BRIM * stroke &&
            celd_part_seen (parts, u, v) == k)
          {
            sum += fmin (fmax (1 - (double) CELD_AT (parts->ink, u, v), 0), 1); /* also where ink is not a number */
            sides += ends_at (part, x, y);
          }
      }
  return sides > 0 ? (float) fmin (sum / (sides * CELD_PI / 4), WIDEST_BRIM * stroke) : 0; /* sides are too long by 4 /
                                                                                            * pi in the mean */
}

/* ------------------------------------------------------------------ the system */

typedef struct { float *east, *south, *diagonal, *b, *distance, brim; uint8_t *fixed; uint32_t *root; } System;

static CeldStatus
system_new (size_t n, System *s)
{
  s->east     = celd_alloc0 (n, sizeof *s->east);
  s->south    = celd_alloc0 (n, sizeof *s->south);
  s->diagonal = celd_alloc0 (n, sizeof *s->diagonal);
  s->b        = celd_alloc0 (n, sizeof *s->b);
  s->distance = celd_alloc (n, sizeof *s->distance);
  s->fixed    = celd_alloc (n, 1);
  s->root     = celd_alloc (n, sizeof *s->root);
  return s->east && s->south && s->diagonal && s->b && s->distance && s->fixed && s->root ? CELD_OK : CELD_NO_MEMORY;
}

static void
system_clear (System *s)
{
  celd_free (s->east);
  celd_free (s->south);
  celd_free (s->diagonal);
  celd_free (s->b);
  celd_free (s->distance);
  celd_free (s->fixed);
  celd_free (s->root);
}

/* How far it is from pixel p to where f begins, on the way to its neighbour q. */
static float
way_to_end (const CeldPart *part, const System *s, size_t p, size_t q)
{
  if (s->brim > 0)
    return fminf ((s->distance[p] - s->brim) / (s->distance[p] - s->distance[q]), 1);
  return celd_part_crossing (part, p, q);
}

/* Links a pixel within the brim with its neighbour in a direction, or with the end of f before it. */
static void
link_pixel (const CeldPart *part, System *s, int x, int y, int direction)
{
  size_t p = celd_part_at (part, x, y), q;
  bool   inside;

  celd_step (direction, &x, &y);
  q      = celd_part_at (part, x, y);
  inside = celd_part_has (part, x, y);
  if (inside && s->distance[q] > s->brim)
    {
      if (direction != CELD_EAST && direction != CELD_SOUTH)
        return;
      (direction == CELD_EAST ? s->east : s->south)[p] = 1;
      celd_join (s->root, (uint32_t) p, (uint32_t) q);
    }
  else if (inside || !(part->open[p] & 1 << direction))
    s->diagonal[p] += 1 / fmaxf (way_to_end (part, s, p, q), LEAST_DISTANCE);
}

/* Components that end nowhere stay flat. */
static void
fix_pixels (const CeldPart *part, System *s)
{
  size_t n = (size_t) part->box.width * (size_t) part->box.height;

  memset (s->fixed, 1, n);
  for (size_t p = 0; p < n; p++)
    if (s->diagonal[p] > 0)
      s->fixed[celd_root (s->root, (uint32_t) p)] = 0;
  for (size_t p = 0; p < n; p++)
    {
      s->fixed[p] = s->fixed[celd_root (s->root, (uint32_t) p)];
      s->b[p]     = s->fixed[p] ? 0 : 4;
    }
}

static CeldStatus
solve (const CeldPart *part, System *s, double tolerance, const CeldHost *host, float *f)
{
  CeldLaplace *laplace = NULL;
  CeldHostPart shares[2];
  CeldHost     setting_up = celd_host_part (&shares[0], host, 0, 0.3);
  CeldHost     solving = celd_host_part (&shares[1], host, 0.3, 1);
  CeldStatus   status;

  celd_roots (s->root, (size_t) part->box.width * (size_t) part->box.height);
  for (int y = 1; y < part->box.height - 1; y++)
    for (int x = 1; x < part->box.width - 1; x++)
      for (int k = 0; k < 4 && s->distance[celd_part_at (part, x, y)] > s->brim; k++)
        link_pixel (part, s, x, y, k);
  fix_pixels (part, s);
  status = celd_lap_setup (part->box.width, part->box.height, s->east, s->south, s->diagonal, s->fixed, &setting_up,
                           &laplace);
  if (status == CELD_OK)
    status = celd_lap_solve (laplace, 1, s->b, f, fmin (tolerance, CELD_INFLATION_TOLERANCE), &solving, NULL);
  celd_lap_free (laplace);
  return status;
}

CeldStatus
celd_part_inflate (const CeldParts *parts, size_t k, int stroke, double tolerance, const CeldHost *host)
{
  CeldPart    *part = &parts->item[k];
  size_t       n = (size_t) part->box.width * (size_t) part->box.height;
  System       s = { 0 };
  CeldHostPart shares[2];
  CeldHost     measuring = celd_host_part (&shares[0], host, 0, 0.2);
  CeldHost     solving = celd_host_part (&shares[1], host, 0.2, 1);
  CeldStatus   status = system_new (n, &s);

  if (status == CELD_OK)
    status = find_distances (part, &measuring, s.distance);
  if (status == CELD_OK)
    {
      memset (part->z, 0, n * sizeof *part->z);
      s.brim = line_width (parts, k, s.distance, stroke);
      status = solve (part, &s, tolerance, &solving, part->z);
    }
  part->size = 0;
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    {
      part->z[i] = sqrtf (fmaxf (part->z[i], 0)) + BRIM_SLOPE * fminf (fmaxf (s.distance[i], 0), s.brim);
      part->size = fmax (part->size, (double) part->z[i]);
    }
  system_clear (&s);
  return status;
}
