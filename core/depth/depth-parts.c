/* The connected parts of a picture by stretches of rows, and boxes of parts that are gone through together.
 *
 * A picture has few stretches: what is done by stretch costs next to nothing.  One pass over the pixels finds them;
 * rows are joined by looking at where their stretches meet, mostly at one pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "depth/depth.h"

#define SLACK 4096 /* pixels that two boxes may waste together: setting up a box costs about as much */

/* ------------------------------------------------------------------ stretches */

typedef struct { const float *level; const uint8_t *fixed; const CeldEdges *edges; } Joins;

CELD_CLONES static void
mark_levels (const float *restrict level, int n, uint8_t *restrict mark)
{
  for (int x = 1; x < n; x++)
    mark[x] = level[x] == level[x - 1] ? 0 : 0x80;
}

CELD_CLONES static void
mark_fixed (const uint8_t *restrict fixed, int n, uint8_t *restrict mark)
{
  for (int x = 1; x < n; x++)
    mark[x] = (uint8_t) (mark[x] | (!fixed[x] == !fixed[x - 1] ? 0 : 0x80));
}

static bool
is_free (const Joins *j, size_t pixel)
{
  return !j->fixed || !j->fixed[pixel];
}

static CeldStatus
add_stretch (CeldParts *parts, size_t *n, int x, int end)
{
  CeldStretch *stretch = celd_grow (parts->stretch, *n + 1, sizeof *stretch);

  if (!stretch)
    return CELD_NO_MEMORY;
  stretch[(*n)++] = (CeldStretch) { x, end, 0 };
  parts->stretch  = stretch;
  return CELD_OK;
}

/* Ends a stretch where fixed pixels begin, and where a border is cut. */
static CeldStatus
stretch_row (const Joins *j, CeldParts *parts, int y, uint8_t *mark, size_t *n)
{
  int        w = parts->width;
  size_t     first = (size_t) y * (size_t) w;
  CeldStatus status = CELD_OK;

  mark[0] = 0;
  mark_levels (j->level + first, w, mark);
  if (j->fixed)
    mark_fixed (j->fixed + first, w, mark);
  for (int x = 0, end; x < w && status == CELD_OK; x = end)
    {
      bool open = is_free (j, first + (size_t) x);

      end = celd_next_marked (w, mark, x + 1);
      while (open && j->edges && end < w && is_free (j, first + (size_t) end) &&
             celd_edge_weight (j->edges, j->level, end - 1, y, 1, 0) > 0)
        end = celd_next_marked (w, mark, end + 1);
      if (open)
        status = add_stretch (parts, n, x, end);
    }
  return status;
}

/* ------------------------------------------------------------------ rows */

/* Is a pixel x .. end - 1 of row y joined to the one above? */
static bool
meet (const Joins *j, int width, int y, int x, int end)
{
  const float *here = j->level + (size_t) y * (size_t) width, *above = here - width;

  for (int u = x; u < end; u++)
    if (here[u] == above[u] || (j->edges && celd_edge_weight (j->edges, j->level, u, y - 1, 0, 1) > 0))
      return true;
  return false;
}

static void
join_row (const Joins *j, const CeldParts *parts, int y, uint32_t *parent)
{
  const CeldStretch *s = parts->stretch;
  size_t             a = parts->row[y - 1], b = parts->row[y];

  while (a < parts->row[y] && b < parts->row[y + 1])
    {
      int x = s[a].x > s[b].x ? s[a].x : s[b].x, end = s[a].end < s[b].end ? s[a].end : s[b].end;

      if (x < end && celd_root (parent, (uint32_t) a) != celd_root (parent, (uint32_t) b) &&
          meet (j, parts->width, y, x, end))
        celd_join (parent, (uint32_t) a, (uint32_t) b);
      if (s[a].end < s[b].end)
        a++;
      else
        b++;
    }
}

/* A root comes before its members. */
static void
number_parts (CeldParts *parts, uint32_t *parent)
{
  for (size_t i = 0; i < parts->row[parts->height]; i++)
    {
      uint32_t root = celd_root (parent, (uint32_t) i);

      parts->stretch[i].part = root == i ? (uint32_t) parts->n++ : parts->stretch[root].part;
    }
}

CeldStatus
celd_parts_find (int width, int height, const float *level, const uint8_t *fixed, const CeldEdges *edges,
                 const CeldHost *host, CeldParts *parts)
{
  Joins      j = { level, fixed, edges };
  CeldParts  found = { .width = width, .height = height, .row = celd_alloc0 ((size_t) height + 1, sizeof (size_t)) };
  uint8_t   *mark = celd_alloc ((size_t) width, 1);
  uint32_t  *parent = NULL;
  size_t     n = 0;
  CeldStatus status = found.row && mark ? CELD_OK : CELD_NO_MEMORY;

  for (int y = 0; y < height && status == CELD_OK; y++)
    {
      status = y % 64 ? CELD_OK : celd_progress (host, (double) y / height);
      if (status == CELD_OK)
        status = stretch_row (&j, &found, y, mark, &n);
      found.row[y + 1] = n;
    }
  if (status == CELD_OK)
    {
      parent = celd_alloc (n + 1, sizeof *parent);
      status = parent && n < UINT32_MAX ? CELD_OK : CELD_NO_MEMORY;
    }
  if (status == CELD_OK)
    {
      celd_roots (parent, n);
      for (int y = 1; y < height; y++)
        join_row (&j, &found, y, parent);
      number_parts (&found, parent);
      *parts = found;
    }
  else
    celd_parts_clear (&found);
  celd_free (mark);
  celd_free (parent);
  return status;
}

void
celd_parts_clear (CeldParts *parts)
{
  celd_free (parts->row);
  celd_free (parts->stretch);
  *parts = (CeldParts) { 0 };
}

bool
celd_stretch_marked (const CeldParts *parts, const CeldStretch *stretch, int y, const uint8_t *mark)
{
  return memchr (mark + (size_t) y * (size_t) parts->width + (size_t) stretch->x, 1,
                 (size_t) (stretch->end - stretch->x)) != NULL;
}

/* ------------------------------------------------------------------ boxes */

void
celd_box_add (CeldRect *box, const CeldStretch *stretch, int y)
{
  *box = celd_rect_union (*box, (CeldRect) { stretch->x, y, stretch->end - stretch->x, 1 });
}

static int64_t
area (CeldRect box)
{
  return (int64_t) box.width * box.height;
}

/* Pixels that are gone through in vain when these two go together; negative where they overlap. */
static int64_t
waste (CeldRect a, CeldRect b)
{
  return area (celd_rect_union (a, b)) - area (a) - area (b);
}

/* Makes one of two groups that have come to overlap or lie close; were there such? */
static bool
merge_groups (size_t n_boxes, uint32_t *group, CeldRect *bounds, size_t *n)
{
  for (size_t a = 0; a < *n; a++)
    for (size_t b = a + 1; b < *n; b++)
      if (waste (bounds[a], bounds[b]) <= SLACK)
        {
          bounds[a] = celd_rect_union (bounds[a], bounds[b]);
          bounds[b] = bounds[--*n];
          for (size_t k = 0; k < n_boxes; k++)
            group[k] = group[k] == b ? (uint32_t) a : group[k] == *n ? (uint32_t) b : group[k];
          return true;
        }
  return false;
}

size_t
celd_boxes_group (const CeldRect *box, size_t n, uint32_t *group, CeldRect bounds[CELD_MOST_GROUPS])
{
  size_t groups = 0;

  for (size_t k = 0; k < n; k++)
    {
      size_t best = 0;

      group[k] = CELD_NO_GROUP;
      if (!box[k].width)
        continue;
      for (size_t g = 1; g < groups; g++)
        if (waste (bounds[g], box[k]) < waste (bounds[best], box[k]))
          best = g;
      if (groups < CELD_MOST_GROUPS && (!groups || waste (bounds[best], box[k]) > SLACK))
        bounds[best = groups++] = box[k];
      bounds[best] = celd_rect_union (bounds[best], box[k]);
      group[k]     = (uint32_t) best;
    }
  while (merge_groups (n, group, bounds, &groups))
    ;
  return groups;
}
