/* The points of a surface, at the corners of pixels.
 *
 * Pixels round a corner that are connected there share a point at their mean height; a part that ends in front of
 * another has its outline there.  Points of equal height are merged.  Where two diagonal pixels touch at a corner, with
 * two lower parts beside them, the higher of these is lifted to them: otherwise a solid would have an edge there which
 * four faces share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/vector.h"
#include "relief/mesh.h"

/* A corner and the four pixels round it; pixel -1 is outside the picture. */
typedef struct
{
  ptrdiff_t pixel[4];
  bool      joined[4];          /* is each connected with the next one, clockwise? */
  bool      nearer[4];          /* if not: is it in front of the next one? */
  int       part[4];           /* of each pixel */
  int       parts;
  float     z[4];               /* of each part */
} Corner;

/* ------------------------------------------------------------------ parts */

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

/* ------------------------------------------------------------------ solids */

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

/* ------------------------------------------------------------------ */

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
