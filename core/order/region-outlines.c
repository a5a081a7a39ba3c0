/* The outlines of all regions' surfaces: where paper ends and ink begins.
 *
 * Labels meet somewhere inside the ink, but a viewer sees the edge of the ink.  It is followed between pixels, with the
 * surface on the right and diagonal neighbours connected, and each point is moved to where the ink is one half.
 *
 * Cost: one pass over the picture, and time proportional to the length of the outlines; 4 bytes a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "order/order.h"

#include <math.h>

#define EDGE_FOLLOWED  UINT32_C (0x80000000) /* flag in `surface`: the pixel's upper edge has been followed */
#define SOLID_DIVISOR  10                    /* less than a tenth of a solid region is paper; chosen */
#define DEFAULT_STROKE 3                     /* pixels, for pictures without ink; chosen */
#define MOST_INK       3                     /* stroke widths of ink between an outline and what it faces; chosen */

typedef struct
{
  const CeldLabels   *labels;
  const CeldPlane    *ink;      /* may be NULL */
  size_t              n_labels;
  CeldRegionOutlines *outlines;
} Tracer;

static uint32_t
label_at (const Tracer *t, int x, int y)
{
  uint32_t label = CELD_AT (t->labels, x, y);

  return label <= t->n_labels ? label : 0;
}

static bool
paper_at (const Tracer *t, int x, int y)
{
  return !t->ink || celd_is_paper (CELD_AT (t->ink, x, y));
}

/* Allocates and fills outlines->surface. */
static CeldStatus
read_surfaces (Tracer *t)
{
  CeldRegionOutlines *r = t->outlines;
  size_t             *all = celd_alloc0 (t->n_labels + 1, sizeof *all);
  size_t             *paper = celd_alloc0 (t->n_labels + 1, sizeof *paper);

  r->stride  = (size_t) r->width + 2;
  r->surface = celd_alloc0 ((size_t) r->height + 2, r->stride * sizeof *r->surface);
  if (all && paper && r->surface)
    {
      for (int y = 0; y < r->height; y++)
        for (int x = 0; x < r->width; x++)
          {
            all[label_at (t, x, y)]++;
            paper[label_at (t, x, y)] += paper_at (t, x, y);
          }
      for (int y = 0; y < r->height; y++)
        {
          uint32_t *row = r->surface + (size_t) (y + 1) * r->stride + 1;

          for (int x = 0; x < r->width; x++)
            {
              uint32_t label = label_at (t, x, y);

              row[x] = paper_at (t, x, y) || SOLID_DIVISOR * paper[label] < all[label] ? label : 0;
            }
        }
    }
  celd_free (all);
  celd_free (paper);
  return all && paper && r->surface ? CELD_OK : CELD_NO_MEMORY;
}

static uint32_t *
surface_of (const CeldRegionOutlines *r, int x, int y)
{
  return &r->surface[(size_t) (y + 1) * r->stride + (size_t) (x + 1)];
}

/* What the outline of `label` faces in direction (dx,dy), where pixel (x,y) is the first beyond it: as in
 * CeldOutlinePoint. */
static uint32_t
faced_label (const Tracer *t, uint32_t label, int x, int y, int dx, int dy)
{
  int most = MOST_INK * t->outlines->stroke + 2;

  for (int k = 0; k <= most; k++, x += dx, y += dy)
    {
      uint32_t there;

      if (x < 0 || y < 0 || x >= t->outlines->width || y >= t->outlines->height)
        return CELD_FACES_FRAME;
      there = label_at (t, x, y);
      if (there && there != label)
        return there;
      if (there && k && (*surface_of (t->outlines, x, y) & ~EDGE_FOLLOWED) == label)
        return 0;
    }
  return 0;
}

/* The point of the outline between the surface's pixel (x,y) and its neighbour in direction (dx,dy). */
static CeldOutlinePoint
outline_point (const Tracer *t, uint32_t label, int x, int y, int dx, int dy)
{
  int    u = x + dx, v = y + dy;
  double along = 0.5;

  if (t->ink && u >= 0 && v >= 0 && u < t->outlines->width && v < t->outlines->height && paper_at (t, x, y) &&
      !paper_at (t, u, v))
    {
      double in = (double) CELD_AT (t->ink, x, y), out = (double) CELD_AT (t->ink, u, v);

      along = in < 1 ? (in - 0.5) / (in - out) : 0.5 / (1 - out); /* NaN, and more than paper, are paper */
    }
  return (CeldOutlinePoint) { (float) (x + 0.5 + along * dx), (float) (y + 0.5 + along * dy),
                              faced_label (t, label, u, v, dx, dy) };
}

/* Where a loop faces nothing on a short stretch and the same label before and after it, it is taken to face that label
 * there, too: in that direction slanting ink may be too wide, or a speck of ink in the way.  Longer stretches are lines
 * inside the surface. */
static void
fill_short_gaps (const CeldRegionOutlines *r, const CeldOutlineLoop *loop)
{
  CeldOutlinePoint *p = &r->point[loop->first];
  size_t            most = (size_t) (CELD_SHORTEST_MARK * r->stroke), start = 0;

  while (start < loop->n && !p[start].faces)
    start++;
  for (size_t i = 1, gap = 0; i <= loop->n && start < loop->n; i++)
    {
      size_t at = (start + i) % loop->n, before = (start + i + loop->n - gap - 1) % loop->n;

      if (!p[at].faces)
        gap++;
      else
        {
          for (size_t k = 1; k <= gap && gap < most && p[before].faces == p[at].faces; k++)
            p[(before + k) % loop->n].faces = p[at].faces;
          gap = 0;
        }
    }
}

/* Follows the outline that has the upper edge of pixel (x,y), and appends it. */
static CeldStatus
follow (Tracer *t, uint32_t label, int x, int y)
{
  CeldRegionOutlines *r = t->outlines;
  CeldOutlineLoop     loop = { .first = r->n_points, .label = label };
  int                 at_x = x, at_y = y, heading = 0;
  CeldOutlinePoint    last;

  do
    {
      int in_x = at_x + celd_right_x[heading], in_y = at_y + celd_right_y[heading];
      int out_x = at_x + celd_left_x[heading], out_y = at_y + celd_left_y[heading];

      last = outline_point (t, label, in_x, in_y, out_x - in_x, out_y - in_y);
      if (celd_append (r->point, r->n_points, r->point_capacity, last) != CELD_OK)
        return CELD_NO_MEMORY;
      if (heading == 0)
        *surface_of (r, in_x, in_y) |= EDGE_FOLLOWED;
      at_x += celd_step_x[heading];
      at_y += celd_step_y[heading];
      if ((*surface_of (r, at_x + celd_left_x[heading], at_y + celd_left_y[heading]) & ~EDGE_FOLLOWED) == label)
        heading = (heading + 3) & 3;
      else if ((*surface_of (r, at_x + celd_right_x[heading], at_y + celd_right_y[heading]) & ~EDGE_FOLLOWED) != label)
        heading = (heading + 1) & 3;
    }
  while (at_x != x || at_y != y || heading != 0);
  loop.n = r->n_points - loop.first;
  for (size_t i = loop.first; i < r->n_points; last = r->point[i++])
    loop.length += hypot ((double) (r->point[i].x - last.x), (double) (r->point[i].y - last.y));
  fill_short_gaps (r, &loop);
  return celd_append (r->loop, r->n_loops, r->loop_capacity, loop);
}

static CeldStatus
follow_all (Tracer *t, const CeldHost *host)
{
  CeldRegionOutlines *r = t->outlines;
  CeldStatus          status = CELD_OK;

  for (int y = 0; y < r->height && status == CELD_OK; y++)
    {
      const uint32_t *row = surface_of (r, 0, y), *above = row - r->stride;

      for (int x = 0; x < r->width && status == CELD_OK; x++)
        if (row[x] && !(row[x] & EDGE_FOLLOWED) && (above[x] & ~EDGE_FOLLOWED) != row[x])
          status = follow (t, row[x], x, y);
      if (status == CELD_OK && (y & 255) == 255)
        status = celd_progress (host, (double) y / r->height);
    }
  for (size_t p = 0; p < r->stride * ((size_t) r->height + 2); p++)
    r->surface[p] &= ~EDGE_FOLLOWED;
  return status;
}

CeldStatus
celd_region_outlines_new (const CeldLabels *labels, size_t n_labels, const CeldPlane *ink, const CeldHost *host,
                          CeldRegionOutlines *outlines)
{
  CeldRegionOutlines made = { .width = labels->width, .height = labels->height };
  Tracer             t = { labels, ink, n_labels, &made };
  CeldStatus         status;

  made.stroke = ink ? celd_stroke_width (ink) : 0;
  made.stroke = made.stroke ? made.stroke : DEFAULT_STROKE;
  status = read_surfaces (&t);
  if (status == CELD_OK)
    status = follow_all (&t, host);
  if (status == CELD_OK)
    *outlines = made;
  else
    celd_region_outlines_clear (&made);
  return status;
}

void
celd_region_outlines_clear (CeldRegionOutlines *outlines)
{
  celd_free (outlines->surface);
  celd_free (outlines->point);
  celd_free (outlines->loop);
  *outlines = (CeldRegionOutlines) { 0 };
}
