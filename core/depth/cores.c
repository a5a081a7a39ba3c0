/* Cores: what keeps a region without an anchor at its level.
 *
 * The core of a region are the pixels at least half as far from its boundary as its innermost pixel is.  The edge of
 * the picture does not count as boundary.  Without a core a gap of one pixel in its contour would give such a region
 * the depth of its neighbour.  Specks get none, since they would stand out as spikes.
 *
 * A core depends only on its region's own pixels: the boundary pixels of the region are nearer than any of another
 * region.  So regions can be measured in any box that contains them, and only those that changed have to be.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "image/image.h"

typedef struct
{
  int               width, height;
  const float      *level;
  CeldRunComponents regions;
  CeldRect         *box;             /* of each region whose core is to be found; width 0 for the others */
  int32_t          *deepest;         /* of each region: squared distance of its innermost pixel */
  uint32_t         *group;
  uint8_t          *fixed;
} Cores;

/* ------------------------------------------------------------------ which regions */

/* A region: whether it has an anchor (held), a changed pixel, a core before. */
typedef struct { size_t area; bool held, changed, had_core; } Region;

static void
look_at_regions (const Cores *c, const uint8_t *changed, const uint8_t *last, Region *region)
{
  for (int y = 0; y < c->height; y++)
    for (size_t i = c->regions.row[y]; i < c->regions.row[y + 1]; i++)
      {
        const CeldPixelRun *s = &c->regions.run[i];
        Region             *r = &region[s->component];
        const size_t        first = (size_t) y * (size_t) c->width + (size_t) s->x, n = (size_t) (s->end - s->x);

        r->area    += n;
        r->held     = r->held || memchr (c->fixed + first, CELD_ANCHOR, n);
        r->changed  = r->changed || !changed || celd_run_marked (&c->regions, s, y, changed);
        r->had_core = r->had_core || (changed && memchr (last + first, CELD_CORE, n));
      }
}

/* Copies cores that cannot have changed; finds the boxes of the regions whose cores are to be found. */
static void
take_over (const Cores *c, const Region *region, size_t speck, const uint8_t *last)
{
  for (int y = 0; y < c->height; y++)
    for (size_t i = c->regions.row[y]; i < c->regions.row[y + 1]; i++)
      {
        const CeldPixelRun *s = &c->regions.run[i];
        const Region       *r = &region[s->component];
        const size_t        first = (size_t) y * (size_t) c->width;

        if (r->held || r->area < speck)
          continue;
        if (r->changed || !r->had_core)
          celd_box_add_run (&c->box[s->component], s, y);
        else
          memcpy (c->fixed + first + s->x, last + first + s->x, (size_t) (s->end - s->x));
      }
}

/* ------------------------------------------------------------------ distances in a box */

/* Whether the pixel (x,y) is beside another region. */
static bool
on_boundary (const Cores *c, int x, int y)
{
  const float *here = c->level + (size_t) y * (size_t) c->width + (size_t) x;

  return (x > 0 && here[-1] != here[0]) || (x + 1 < c->width && here[1] != here[0]) ||
         (y > 0 && here[-c->width] != here[0]) || (y + 1 < c->height && here[c->width] != here[0]);
}

/* Loops over every run of the group's regions. */
#define EACH_GROUP_RUN(c, bounds, g, y, s) \
  CELD_EACH_RUN (&(c)->regions, (bounds).y, (bounds).y + (bounds).height, y, s) \
    if ((c)->group[s->component] == (g))

/* Finds the cores of one group's regions. */
static CeldStatus
measure (const Cores *c, uint32_t g, CeldRect box, const CeldHost *host)
{
  size_t     n = (size_t) box.width * (size_t) box.height;
  uint8_t   *boundary = celd_alloc0 (n, 1);
  int32_t   *squared = celd_alloc (n, sizeof *squared);
  CeldStatus status = boundary && squared ? CELD_OK : CELD_NO_MEMORY;

#define IN_BOX(x, y) ((size_t) ((y) - box.y) * (size_t) box.width + (size_t) ((x) - box.x))
  if (status == CELD_OK)
    {
      EACH_GROUP_RUN (c, box, g, y, s)
        for (int x = s->x; x < s->end; x++)
          boundary[IN_BOX (x, y)] = on_boundary (c, x, y);
      status = celd_distance (box.width, box.height, boundary, host, squared);
    }
  if (status == CELD_OK)
    {
      EACH_GROUP_RUN (c, box, g, y, s)
        for (int x = s->x; x < s->end; x++)
          if (squared[IN_BOX (x, y)] > c->deepest[s->component])
            c->deepest[s->component] = squared[IN_BOX (x, y)];
      EACH_GROUP_RUN (c, box, g, y, s)
        for (int x = s->x; x < s->end; x++)
          if (squared[IN_BOX (x, y)] >= c->deepest[s->component] / 4)
            c->fixed[(size_t) y * (size_t) c->width + (size_t) x] = CELD_CORE;
    }
#undef IN_BOX
  celd_free (boundary);
  celd_free (squared);
  return status;
}

/* ------------------------------------------------------------------ all of them */

static CeldStatus
mark_cores (Cores *c, size_t speck, const uint8_t *changed, const uint8_t *last, const CeldHost *host)
{
  CeldRect   bounds[CELD_MOST_GROUPS];
  size_t     groups = 0;
  Region    *region = celd_alloc0 (c->regions.n, sizeof *region);
  CeldStatus status;

  c->box     = celd_alloc0 (c->regions.n, sizeof *c->box);
  c->deepest = celd_alloc0 (c->regions.n, sizeof *c->deepest);
  c->group   = celd_alloc (c->regions.n, sizeof *c->group);
  status     = region && c->box && c->deepest && c->group ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      look_at_regions (c, changed, last, region);
      take_over (c, region, speck, last);
      groups = celd_boxes_group (c->box, c->regions.n, c->group, bounds);
    }
  for (size_t g = 0; g < groups && status == CELD_OK; g++)
    {
      CeldHostPart part;
      double       from = (double) g / (double) groups, to = (double) (g + 1) / (double) groups;
      CeldHost     share = celd_host_part (&part, host, from, to);

      status = measure (c, (uint32_t) g, bounds[g], &share);
    }
  celd_free (region);
  celd_free (c->box);
  celd_free (c->deepest);
  celd_free (c->group);
  return status;
}

CeldStatus
celd_cores_mark (int width, int height, const float *level, size_t speck, const uint8_t *changed, const uint8_t *last,
                 const CeldHost *host, uint8_t *fixed)
{
  Cores        c = { .width = width, .height = height, .level = level, .fixed = fixed };
  CeldHostPart part[2];
  CeldHost     finding = celd_host_part (&part[0], host, 0, 0.3), measuring = celd_host_part (&part[1], host, 0.3, 1);
  CeldStatus   status  = celd_run_components_find (width, height, level, NULL, NULL, &finding, &c.regions);

  if (status == CELD_OK)
    status = mark_cores (&c, speck, changed, last, &measuring);
  celd_run_components_clear (&c.regions);
  return status;
}
