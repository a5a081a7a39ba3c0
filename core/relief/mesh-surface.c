/* The surface that a mesh approximates: its points at the corners of pixels, and the squares in which few triangles do.
 *
 * Pixels round a corner that are connected there share a point at their mean height; a part that ends in front of
 * another has its outline there.  Points of equal height are merged.  Where two diagonal pixels touch at a corner, with
 * two lower parts beside them, the higher of these is lifted to them: otherwise a solid would have an edge there which
 * four faces share.
 *
 * Squares are simplified by a quadtree, built from single pixels upwards: four are merged if there is no cut inside and
 * the four triangles between the corners and the centre of the merged square deviate by at most the error at every
 * corner of a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "relief/relief.h"

#include <math.h>

/* A corner and the four pixels round it; pixel -1 is outside the picture. */
typedef struct
{
  ptrdiff_t pixel[4];
  bool      joined[4];          /* is each connected with the next one, clockwise? */
  bool      nearer[4];          /* if not: is it in front of the next one? */
  int       part[4];            /* of each pixel */
  int       parts;
  float     z[4];               /* of each part */
} Corner;

/* ------------------------------------------------------------------ points: parts at a corner */

static void
read_neighbours (const CeldRelief *r, int x, int y, Corner *c)
{
  static const int dx[4] = { -1, 0, 0, -1 }, dy[4] = { -1, -1, 0, 0 };
  /* The pixel that stores each edge. */
  static const int owner[4] = { CELD_NORTH_WEST, CELD_NORTH_EAST, CELD_SOUTH_WEST, CELD_NORTH_WEST };

  for (int k = 0; k < 4; k++)
    {
      int u = x + dx[k], v = y + dy[k];

      c->pixel[k] = u < 0 || v < 0 || u >= r->width || v >= r->height ? -1 : (ptrdiff_t) v * r->width + u;
    }
  for (int k = 0; k < 4; k++)
    {
      uint8_t cut, near;

      c->joined[k] = c->nearer[k] = false;
      if (c->pixel[k] < 0 || c->pixel[(k + 1) % 4] < 0)
        continue;
      cut  = r->cut[c->pixel[owner[k]]] & (k % 2 ? CELD_CUT_BELOW : CELD_CUT_RIGHT);
      near = r->cut[c->pixel[owner[k]]] & (k % 2 ? CELD_NEAR_BELOW : CELD_NEAR_RIGHT);
      c->joined[k] = !cut;
      c->nearer[k] = (near != 0) == (owner[k] == k);
    }
}

/* Numbers the connected parts, clockwise. */
static void
find_parts (Corner *c)
{
  int place[4] = { -1, -1, -1, -1 };

  for (int k = 0; k < 4; k++)
    c->part[k] = k;
  for (int k = 0; k < 4; k++)
    if (c->joined[k])
      for (int i = 0, from = c->part[(k + 1) % 4]; i < 4; i++)
        if (c->part[i] == from)
          c->part[i] = c->part[k];
  c->parts = 0;
  for (int k = 0; k < 4; k++)
    if (c->pixel[k] >= 0)
      {
        if (place[c->part[k]] < 0)
          place[c->part[k]] = c->parts++;
        c->part[k] = place[c->part[k]];
      }
    else
      c->part[k] = 0;
}

/* Is the part in front of another one here? */
static bool
ends_here (const Corner *c, int part)
{
  for (int k = 0; k < 4; k++)
    {
      int next = (k + 1) % 4;

      if (c->pixel[k] >= 0 && c->pixel[next] >= 0 && c->part[k] != c->part[next] &&
          c->part[c->nearer[k] ? k : next] == part)
        return true;
    }
  return false;
}

static void
find_heights (const CeldRelief *r, Corner *c)
{
  for (int part = 0; part < c->parts; part++)
    {
      const float *z = ends_here (c, part) ? r->outline : r->z;
      double       sum = 0;
      int          n = 0;

      for (int k = 0; k < 4; k++)
        if (c->pixel[k] >= 0 && c->part[k] == part)
          {
            sum += (double) z[c->pixel[k]];
            n++;
          }
      c->z[part] = (float) (sum / n);
    }
}

/* ------------------------------------------------------------------ points: solids */

/* Of four parts, lifts the higher one of a and its opposite to the lower one of the two others, if both of these are
 * higher than both of those. */
static void
lift (float *z, int a)
{
  float *low = z[a] > z[a + 2] ? &z[a] : &z[a + 2];
  float  beside = z[1 - a] < z[3 - a] ? z[1 - a] : z[3 - a];

  if (*low < beside)
    *low = beside;
}

/* Merges parts of equal height. */
static void
merge_parts (Corner *c)
{
  int place[4], n = 0;

  for (int i = 0; i < c->parts; i++)
    {
      int same = 0;

      while (same < n && c->z[same] != c->z[i])
        same++;
      place[i]   = same;
      c->z[same] = c->z[i];
      n += same == n;
    }
  for (int k = 0; k < 4; k++)
    c->part[k] = place[c->part[k]];
  c->parts = n;
}

/* ------------------------------------------------------------------ points: all corners */

static bool
is_cracked (const Corner *c)
{
  for (int k = 0; k < 4; k++)
    if (!c->joined[k] && c->pixel[k] >= 0 && c->pixel[(k + 1) % 4] >= 0)
      return true;
  return false;
}

static CeldStatus
add_corner (CeldMeshPoints *points, size_t place, const Corner *c)
{
  uint8_t    part = 0;
  CeldStatus status = CELD_OK;

  points->first[place]   = (uint32_t) points->n;
  points->cracked[place] = is_cracked (c);
  for (int k = 0; k < 4; k++)
    part = (uint8_t) (part | c->part[k] << 2 * k);
  points->part[place] = part;
  for (int i = 0; i < c->parts && status == CELD_OK; i++)
    status = celd_append (points->z, points->n, points->capacity, c->z[i]);
  return status;
}

CeldStatus
celd_mesh_points_new (const CeldRelief *r, const CeldHost *host, CeldMeshPoints *points)
{
  size_t     n = ((size_t) r->width + 1) * ((size_t) r->height + 1), place = 0;
  CeldStatus status = CELD_OK;

  *points         = (CeldMeshPoints) { .width = r->width, .height = r->height };
  points->first   = celd_alloc (n + 1, sizeof *points->first);
  points->part   = celd_alloc (n, 1);
  points->cracked = celd_alloc (n, 1);
  if (!points->first || !points->part || !points->cracked)
    return CELD_NO_MEMORY;
  for (int y = 0; y <= r->height && status == CELD_OK; y++)
    {
      if (y % 16 == 0)
        status = celd_progress (host, (double) y / r->height);
      for (int x = 0; x <= r->width && status == CELD_OK; x++, place++)
        {
          Corner c;

          read_neighbours (r, x, y, &c);
          find_parts (&c);
          find_heights (r, &c);
          if (c.parts == 4)
            {
              lift (c.z, 0);
              lift (c.z, 1);
            }
          merge_parts (&c);
          status = add_corner (points, place, &c);
        }
    }
  points->first[n] = (uint32_t) points->n;
  return status;
}

void
celd_mesh_points_clear (CeldMeshPoints *points)
{
  celd_free (points->first);
  celd_free (points->part);
  celd_free (points->cracked);
  celd_free (points->z);
  *points = (CeldMeshPoints) { .width = 0 };
}

/* ------------------------------------------------------------------ mesh simplification */

typedef struct { const CeldMeshPoints *points; const CeldRelief *relief; double error; } Surface;

/* Height of the surface at the corner (x,y), seen from inside the square that ends at (end_x,end_y). */
static double
height_at (const CeldMeshPoints *c, int x, int y, int end_x, int end_y)
{
  int direction = x < end_x ? (y < end_y ? CELD_SOUTH_EAST : CELD_NORTH_EAST)
                            : (y < end_y ? CELD_SOUTH_WEST : CELD_NORTH_WEST);

  return (double) c->z[celd_mesh_point_at (c, x, y, direction)];
}

/* Is the surface uncut along the lines that divide the square into four? */
static bool
goes_on (const CeldRelief *r, int x, int y, int side)
{
  int middle_x = x + side / 2 - 1, middle_y = y + side / 2 - 1; /* pixels just before the lines */

  for (int i = 0; i < side; i++)
    if (r->cut[(size_t) (y + i) * (size_t) r->width + (size_t) middle_x] & CELD_CUT_RIGHT ||
        r->cut[(size_t) middle_y * (size_t) r->width + (size_t) (x + i)] & CELD_CUT_BELOW)
      return false;
  return true;
}

/* Do the four triangles approximate the surface within the error? */
static bool
is_flat (const Surface *s, int x, int y, int side)
{
  int    end_x = x + side, end_y = y + side;
  double half = 0.5 * side, middle = height_at (s->points, x + side / 2, y + side / 2, end_x, end_y);
  double z[2][2] = { { height_at (s->points, x, y, end_x, end_y), height_at (s->points, end_x, y, end_x, end_y) },
                     { height_at (s->points, x, end_y, end_x, end_y),
                       height_at (s->points, end_x, end_y, end_x, end_y) } };

  for (int j = 0; j <= side; j++)
    for (int i = 0; i <= side; i++)
      {
        double u = i - half, v = j - half, out = fmax (fabs (u), fabs (v)) / half, along, a, b;

        if (fabs (v) >= fabs (u)) /* above or below the centre */
          a = z[v > 0][0], b = z[v > 0][1], along = u;
        else
          a = z[0][u > 0], b = z[1][u > 0], along = v;
        along = out > 0 ? 0.5 + 0.5 * along / (out * half) : 0;
        if (fabs ((1 - out) * middle + out * (a + along * (b - a))
                  - height_at (s->points, x + i, y + j, end_x, end_y)) > s->error)
          return false;
      }
  return true;
}

static bool
is_whole (const CeldQuadtree *b, int k, int x, int y)
{
  return k == 0 || b->whole[k][(size_t) y * (size_t) (b->width >> k) + (size_t) x];
}

/* Merges squares into those of 2^k pixels. */
static CeldStatus
join_squares (const Surface *s, int k, const CeldHost *host, CeldQuadtree *b)
{
  int w = b->width >> k, h = b->height >> k;

  b->whole[k] = celd_alloc ((size_t) w * (size_t) h, 1);
  if (!b->whole[k])
    return CELD_NO_MEMORY;
  for (int y = 0; y < h; y++)
    {
      if (celd_progress (host, (k - 1 + (double) y / h) / CELD_QUADTREE_SIZES) != CELD_OK)
        return CELD_CANCELLED;
      for (int x = 0; x < w; x++)
        b->whole[k][(size_t) y * (size_t) w + (size_t) x] =
          is_whole (b, k - 1, 2 * x, 2 * y) && is_whole (b, k - 1, 2 * x + 1, 2 * y) &&
          is_whole (b, k - 1, 2 * x, 2 * y + 1) && is_whole (b, k - 1, 2 * x + 1, 2 * y + 1) &&
          goes_on (s->relief, x << k, y << k, 1 << k) && is_flat (s, x << k, y << k, 1 << k);
    }
  return CELD_OK;
}

CeldStatus
celd_quadtree_new (const CeldMeshPoints *points, const CeldRelief *relief, double error, const CeldHost *host,
                   CeldQuadtree *quadtree)
{
  Surface    s = { points, relief, error };
  CeldStatus status = CELD_OK;

  *quadtree = (CeldQuadtree) { .width = relief->width, .height = relief->height };
  for (int k = 1; k < CELD_QUADTREE_SIZES && status == CELD_OK; k++)
    status = join_squares (&s, k, host, quadtree);
  return status;
}

bool
celd_quadtree_is_leaf (const CeldQuadtree *b, int k, int x, int y)
{
  if (!is_whole (b, k, x, y))
    return false;
  k++;
  x /= 2;
  y /= 2;
  return k == CELD_QUADTREE_SIZES || x >= b->width >> k || y >= b->height >> k || !is_whole (b, k, x, y);
}

void
celd_quadtree_clear (CeldQuadtree *quadtree)
{
  for (int k = 1; k < CELD_QUADTREE_SIZES; k++)
    celd_free (quadtree->whole[k]);
  *quadtree = (CeldQuadtree) { .width = 0 };
}
