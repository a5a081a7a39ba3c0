/* Normals of a blobby surface, Lumo [Joh02], with depth discontinuities (section 5).
 *
 * At a depth discontinuity the nearer side ends: there its normal lies in the picture and points outward.  The farther
 * side goes on behind and gets nothing.  n_x and n_y are harmonic in between, each by itself, and n_z follows from unit
 * length; on a disc that is exactly a hemisphere.  Virtual borders neither cut nor give normals; nor do their ends,
 * where they run into the ink of another contour: both sides of an outline must be apart all around.  The frame of the
 * picture gives none.  What has no outline of its own faces the viewer: the paper stays flat behind a figure, also
 * where a gap in the figure's contour joins both.
 *
 * The outline runs on edges of pixels, half a pixel from the centres that it holds, hence the coupling 2.  Its
 * direction comes from the first moment of the matte "at least as near" under a Gaussian round the edge's middle:
 * steps of pixels average out, and the outline goes on straight where something nearer hides it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "private.h"

#include <math.h>
#include <stdlib.h>

#define REACH    7      /* pixels round an edge that tell its direction */
#define SPREAD   2.75   /* deviation of the Gaussian in pixels */
#define COUPLING 2.f    /* of a pixel with its outline, 1 / distance */

#define FLAT     1.f    /* coupling of a pixel that shall face the viewer */

/* What the outline of the picture's parts is made of. */
typedef struct
{
  int          width, height;
  const float *level, *east, *south;
  CeldLabels   region;          /* connected regions of one level */
  uint8_t     *front, *behind;  /* of each region: has it an outline, is it behind one? */
  double       gauss[2 * REACH + 2][2 * REACH + 2]; /* by half pixels: [i] is at i/2 */
} Outline;

static void
outline_init (Outline *o)
{
  for (int i = 0; i < 2 * REACH + 2; i++)
    for (int j = 0; j < 2 * REACH + 2; j++)
      o->gauss[i][j] = exp (-0.125 * (i * i + j * j) / (SPREAD * SPREAD));
}

static int
clamp (int x, int size)
{
  return x < 0 ? 0 : x < size ? x : size - 1;
}

/* Outward normal, y down, of the part of level `near` at the edge from (x,y) to (x+east,y+south). */
static void
outward (const Outline *o, float near, int x, int y, int east, int south, double *nx, double *ny)
{
  double mx = 0, my = 0, length;

  for (int v = y - REACH + south; v <= y + REACH; v++)
    for (int u = x - REACH + east; u <= x + REACH; u++)
      if (o->level[(size_t) clamp (v, o->height) * (size_t) o->width + (size_t) clamp (u, o->width)] >= near)
        {
          int    du = 2 * (u - x) - east, dv = 2 * (v - y) - south; /* half pixels from the edge's middle */
          double weight = o->gauss[abs (du)][abs (dv)];

          mx += weight * du;
          my += weight * dv;
        }
  length = hypot (mx, my);
  *nx    = length > 0 ? -mx / length : 0;
  *ny    = length > 0 ? -my / length : 0;
}

/* The edge from pixel (x,y) to its right or lower neighbour as outline of its nearer side. */
static void
hold_edge (const Outline *o, int x, int y, int east, int south, float *diagonal, float *b)
{
  size_t n = (size_t) o->width * (size_t) o->height;
  size_t p = (size_t) y * (size_t) o->width + (size_t) x, q = p + (size_t) east + (size_t) south * (size_t) o->width;
  size_t near = o->level[p] > o->level[q] ? p : q;
  double nx, ny;

  if (celd_way_round (o->width, o->height, o->east, o->south, x, y, east))
    return;
  o->front[o->region.data[near]]                = 1;
  o->behind[o->region.data[near == p ? q : p]] = 1;
  outward (o, o->level[near], x, y, east, south, &nx, &ny);
  diagonal[near] += COUPLING;
  b[near]        += COUPLING * (float) nx;
  b[n + near]    -= COUPLING * (float) ny; /* y up */
}

/* Every edge that the weights cut holds the normal of its nearer side. */
static CeldStatus
hold_edges (const Outline *o, const CeldRun *run, float *diagonal, float *b)
{
  size_t i = 0;

  for (int y = 0; y < o->height; y++)
    {
      if (y % 16 == 0 && celd_step (run, (double) y / o->height) != CELD_OK)
        return CELD_CANCELLED;
      for (int x = 0; x < o->width; x++, i++)
        {
          if (x + 1 < o->width && o->east[i] <= 0)
            hold_edge (o, x, y, 1, 0, diagonal, b);
          if (y + 1 < o->height && o->south[i] <= 0)
            hold_edge (o, x, y, 0, 1, diagonal, b);
        }
    }
  return CELD_OK;
}

/* Outlines give their normals; regions that are only behind others are held flat. */
static CeldStatus
hold_outlines (int w, int h, const float *level, const float *east, const float *south, const CeldRun *run,
               float *diagonal, float *b)
{
  Outline        o = { .width = w, .height = h, .level = level, .east = east, .south = south };
  CeldComponent *list = NULL;
  size_t         n = (size_t) w * (size_t) h, count = 0;
  CeldPart       part[2];
  CeldRun        finding = celd_run_part (&part[0], run, 0, 0.5), holding = celd_run_part (&part[1], run, 0.5, 1);
  CeldStatus     status  = celd_labels_new (w, h, &o.region);

  if (status == CELD_OK)
    status = celd_depth_regions (w, h, level, &finding, &o.region, &list, &count);
  if (status != CELD_OK)
    goto done;
  outline_init (&o);
  o.front  = celd_alloc0 (count + 1, sizeof *o.front);
  o.behind = celd_alloc0 (count + 1, sizeof *o.behind);
  status   = o.front && o.behind ? hold_edges (&o, &holding, diagonal, b) : CELD_NO_MEMORY;
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    if (o.behind[o.region.data[i]] && !o.front[o.region.data[i]])
      diagonal[i] += FLAT;

done:
  celd_free (o.region.data);
  celd_free (o.front);
  celd_free (o.behind);
  celd_free (list);
  return status;
}

/* n_z from unit length; the slope n_xy / n_z is scaled by the bulge. */
static void
deliver (const float *nx, const float *ny, double bulge, CeldVectors *normals)
{
  for (int y = 0; y < normals->height; y++)
    for (int x = 0; x < normals->width; x++)
      {
        float *out = CELD_XYZ (normals, x, y);
        double u = (double) *nx++, v = (double) *ny++;
        double z = sqrt (fmax (0, 1 - u * u - v * v)), length;

        u *= bulge;
        v *= bulge;
        length = sqrt (u * u + v * v + z * z);
        out[0] = length > 0 ? (float) (u / length) : 0;
        out[1] = length > 0 ? (float) (v / length) : 0;
        out[2] = length > 0 ? (float) (z / length) : 1;
      }
}

CeldStatus
celd_normals (const CeldPlane *ink, const CeldPlane *levels, const CeldSettings *settings, const CeldRun *run,
              CeldVectors *normals)
{
  if (!CELD_SAME_SIZE (ink, levels) || !CELD_SAME_SIZE (ink, normals))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;

  int          w = ink->width, h = ink->height;
  size_t       n = (size_t) w * (size_t) h;
  float       *level = celd_alloc (n, sizeof *level), *diagonal = celd_alloc0 (n, sizeof *diagonal);
  float       *east = celd_alloc (n, sizeof *east), *south = celd_alloc (n, sizeof *south);
  float       *b = celd_alloc0 (n, 2 * sizeof *b), *nxy = celd_alloc0 (n, 2 * sizeof *nxy);
  CeldLaplace *laplace = NULL;
  CeldPart     part[4];
  CeldRun      weighing = celd_run_part (&part[0], run, 0, 0.1), holding = celd_run_part (&part[1], run, 0.1, 0.2);
  CeldRun      setting_up = celd_run_part (&part[2], run, 0.2, 0.3), solving = celd_run_part (&part[3], run, 0.3, 1);
  CeldStatus   status = level && diagonal && east && south && b && nxy ? CELD_OK : CELD_NO_MEMORY;

  if (status != CELD_OK)
    goto done;
  celd_depth_levels (levels, level);
  status = celd_depth_weights (ink, level, settings->ink_threshold, &weighing, east, south);
  if (status == CELD_OK)
    status = hold_outlines (w, h, level, east, south, &holding, diagonal, b);
  if (status == CELD_OK)
    status = celd_lap_setup (w, h, east, south, diagonal, NULL, &setting_up, &laplace);
  if (status == CELD_OK)
    status = celd_lap_solve (laplace, 2, b, nxy, (double) settings->tolerance, &solving, NULL);
  if (status == CELD_OK)
    deliver (nxy, nxy + n, (double) settings->bulge, normals);

done:
  celd_lap_free (laplace);
  celd_free (level);
  celd_free (diagonal);
  celd_free (east);
  celd_free (south);
  celd_free (b);
  celd_free (nxy);
  return status;
}
