/* A picture as a surface with cuts: the surface is cut at depth discontinuities, where the nearer side ends and the
 * farther side continues behind it.
 *
 * Discontinuities come from celd_depth_weights; gaps in the ink hold, as for smooth depth.  Where a virtual contour
 * runs into the ink of another contour there are such edges, too, but the surface continues round them; so an edge is
 * cut only if there is no short path round it.  A region that is only behind others and ends nowhere stays flat, and so
 * does a connected surface without any cut: the paper.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "depth/depth.h"
#include "image/image.h"
#include "relief/relief.h"

/* ------------------------------------------------------------------ regions */

/* Connected components of one level, and which of them the surface connects. */
typedef struct
{
  CeldLabels region;
  uint32_t  *parent;            /* of each region */
  uint8_t   *front, *behind;    /* does it end in front of another region, is it behind one? */
  size_t     n;                 /* number of regions; they start from 1 */
} Regions;

static void
regions_clear (Regions *r)
{
  celd_free (r->region.data);
  celd_free (r->parent);
  celd_free (r->front);
  celd_free (r->behind);
}

/* Joins regions that the surface connects. */
static void
join_regions (const CeldSurface *s, Regions *r)
{
  size_t          n = (size_t) s->width * (size_t) s->height, w = (size_t) s->width;
  const uint32_t *region = r->region.data;

  for (size_t p = 0; p < n; p++)
    {
      if (s->east[p] > 0 && region[p] != region[p + 1])
        celd_join (r->parent, region[p], region[p + 1]);
      if (s->south[p] > 0 && region[p] != region[p + w])
        celd_join (r->parent, region[p], region[p + w]);
    }
}

/* Regions are the connected components of pixels of one level, whose bits are their label. */
static CeldStatus
regions_new (const CeldSurface *s, const CeldHost *host, Regions *r)
{
  CeldComponent *list = NULL;
  CeldStatus     status = celd_labels_new (s->width, s->height, &r->region);

  if (status == CELD_OK)
    {
      memcpy (r->region.data, s->level, (size_t) s->width * (size_t) s->height * sizeof *s->level);
      status = celd_components (&r->region, UINT32_MAX, false, host, &r->region, &list, &r->n);
    }
  celd_free (list);
  if (status != CELD_OK)
    return status;
  r->parent = celd_alloc (r->n + 1, sizeof *r->parent);
  r->front  = celd_alloc0 (r->n + 1, 1);
  r->behind = celd_alloc0 (r->n + 1, 1);
  if (!r->parent || !r->front || !r->behind)
    return CELD_NO_MEMORY;
  celd_roots (r->parent, r->n + 1);
  join_regions (s, r);
  return CELD_OK;
}

/* ------------------------------------------------------------------ */

/* Makes the weights of depth. */
static CeldStatus
weigh (const CeldPlane *ink, const CeldPlane *borders, const CeldSettings *settings, const CeldHost *host,
       CeldSurface *s)
{
  CeldHostPart   part[2];
  CeldHost       holding = celd_host_part (&part[0], host, 0, 0.5), rest = celd_host_part (&part[1], host, 0.5, 1);
  int            stroke = celd_stroke_width (ink);
  CeldDepthEdges edges;
  uint8_t       *cut;
  CeldStatus     status = celd_depth_edges (ink, borders, s->level, stroke, settings, &holding, &edges, &cut);

  if (status == CELD_OK)
    status = celd_depth_weights (&edges, s->level, &rest, s->east, s->south);
  celd_free (cut);
  return status;
}

/* Sets positive weights to 1. */
static void
binarize (float *weight, size_t n)
{
  for (size_t p = 0; p < n; p++)
    weight[p] = weight[p] > 0 ? 1.f : 0.f;
}

/* Is the cut to the right of (x,y), or below it, near the end of a virtual contour?  Then both sides are connected. */
static bool
is_cut_end (const CeldSurface *s, const CeldPixelLinks *joined, Regions *r, int x, int y, bool down)
{
  const uint32_t *region = &CELD_AT (&r->region, x, y);

  return celd_root (r->parent, region[0]) == celd_root (r->parent, region[down ? s->width : 1]) &&
         celd_has_detour (joined, x, y, down);
}

/* Heals such cuts, judging all of them by the original cuts. */
static CeldStatus
heal_cut_ends (CeldSurface *s, Regions *r, const CeldHost *host)
{
  CeldPixelLinks joined;
  CeldStatus     status = celd_pixel_links_new (s->width, s->height, s->east, s->south, &joined);
  size_t         p = 0;

  for (int y = 0; y < s->height && status == CELD_OK; y++)
    {
      status = y % 64 ? CELD_OK : celd_progress (host, (double) y / s->height);
      for (int x = 0; x < s->width && status == CELD_OK; x++, p++)
        {
          if (x + 1 < s->width && s->east[p] == 0 && is_cut_end (s, &joined, r, x, y, false))
            s->east[p] = 1;
          if (y + 1 < s->height && s->south[p] == 0 && is_cut_end (s, &joined, r, x, y, true))
            s->south[p] = 1;
        }
    }
  celd_pixel_links_clear (&joined);
  return status;
}

void
celd_surface_cuts (const CeldSurface *s, CeldCutBody body, void *data)
{
  size_t w = (size_t) s->width, p = 0;

  for (int y = 0; y < s->height; y++)
    for (int x = 0; x < s->width; x++, p++)
      for (int right = 0; right < 2; right++)
        {
          size_t q = right ? p + 1 : p + w;

          if ((right ? s->east : s->south)[p] > 0 || (right ? x + 1 == s->width : y + 1 == s->height))
            continue;
          body (data, s->level[p] > s->level[q] ? p : q, s->level[p] > s->level[q] ? q : p, right);
        }
}

static void
mark_sides (void *data, size_t near, size_t far, bool right)
{
  const Regions *r = data;

  (void) right;
  r->front[r->region.data[near]] = 1;
  r->behind[r->region.data[far]] = 1;
}

/* Marks flat pixels: those of regions that are only behind others, and of connected surfaces without a cut. */
static CeldStatus
find_flat (CeldSurface *s, Regions *r)
{
  size_t   n = (size_t) s->width * (size_t) s->height;
  uint8_t *bordered = celd_alloc0 (r->n + 1, 1); /* of the root of each region */

  if (!bordered)
    return CELD_NO_MEMORY;
  celd_surface_cuts (s, mark_sides, r);
  for (uint32_t k = 1; k <= r->n; k++)
    if (r->front[k] || r->behind[k])
      bordered[celd_root (r->parent, k)] = 1;
  for (size_t p = 0; p < n; p++)
    {
      uint32_t k = r->region.data[p];

      s->flat[p] = (r->behind[k] && !r->front[k]) || !bordered[celd_root (r->parent, k)];
    }
  celd_free (bordered);
  return CELD_OK;
}

CeldStatus
celd_surface_new (const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels,
                  const CeldSettings *settings, const CeldHost *host, CeldSurface *s)
{
  size_t       n = (size_t) ink->width * (size_t) ink->height;
  Regions      r = { .n = 0 };
  CeldHostPart part[3];
  CeldHost     weighing = celd_host_part (&part[0], host, 0, 0.5), finding = celd_host_part (&part[1], host, 0.5, 0.8);
  CeldHost     joining = celd_host_part (&part[2], host, 0.8, 1);
  CeldStatus   status;

  *s = (CeldSurface) { .width = ink->width, .height = ink->height };
  s->level = celd_alloc (n, sizeof *s->level);
  s->east  = celd_alloc (n, sizeof *s->east);
  s->south = celd_alloc (n, sizeof *s->south);
  s->flat  = celd_alloc (n, 1);
  if (!s->level || !s->east || !s->south || !s->flat)
    return CELD_NO_MEMORY;
  celd_depth_levels (levels, s->level);
  status = weigh (ink, borders, settings, &weighing, s);
  binarize (s->east, n);
  binarize (s->south, n);
  if (status == CELD_OK)
    status = regions_new (s, &finding, &r);
  if (status == CELD_OK)
    status = heal_cut_ends (s, &r, &joining);
  if (status == CELD_OK)
    status = find_flat (s, &r);
  regions_clear (&r);
  return status;
}

void
celd_surface_clear (CeldSurface *s)
{
  celd_free (s->level);
  celd_free (s->east);
  celd_free (s->south);
  celd_free (s->flat);
  *s = (CeldSurface) { .width = 0 };
}
