/* The connected components of a picture as runs of pixels.
 *
 * A picture has few runs, so what is done once per run costs next to nothing.  One pass over the pixels finds the runs;
 * runs of neighbouring rows are joined where they overlap, which is mostly decided by looking at one pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "base/vector.h"
#include "depth/depth.h"

/* ------------------------------------------------------------------ runs of a row */

typedef struct { const float *level; const uint8_t *fixed; const CeldDepthEdges *edges; } Joins;

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
add_run (CeldRunComponents *components, size_t *n, int x, int end)
{
  return celd_append (components->run, *n, components->run_capacity, (CeldPixelRun) { x, end, 0 });
}

/* Ends a run where fixed pixels begin, and where a border is cut. */
static CeldStatus
find_row_runs (const Joins *j, CeldRunComponents *components, int y, uint8_t *mark, size_t *n)
{
  int        w = components->width;
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
        status = add_run (components, n, x, end);
    }
  return status;
}

/* ------------------------------------------------------------------ rows */

/* Whether any of the pixels x .. end - 1 of row y is connected to the one above it. */
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
join_row (const Joins *j, const CeldRunComponents *components, int y, uint32_t *parent)
{
  const CeldPixelRun *s = components->run;
  size_t              a = components->row[y - 1], b = components->row[y];

  while (a < components->row[y] && b < components->row[y + 1])
    {
      int x = s[a].x > s[b].x ? s[a].x : s[b].x, end = s[a].end < s[b].end ? s[a].end : s[b].end;

      if (x < end && celd_root (parent, (uint32_t) a) != celd_root (parent, (uint32_t) b) &&
          meet (j, components->width, y, x, end))
        celd_join (parent, (uint32_t) a, (uint32_t) b);
      if (s[a].end < s[b].end)
        a++;
      else
        b++;
    }
}

/* In the order of the runs: a root comes before its members. */
static void
number_components (CeldRunComponents *components, uint32_t *parent)
{
  for (size_t i = 0; i < components->row[components->height]; i++)
    {
      uint32_t root = celd_root (parent, (uint32_t) i);

      components->run[i].component = root == i ? (uint32_t) components->n++ : components->run[root].component;
    }
}

CeldStatus
celd_run_components_find (int width, int height, const float *level, const uint8_t *fixed, const CeldDepthEdges *edges,
                 const CeldHost *host, CeldRunComponents *components)
{
  Joins             j = { level, fixed, edges };
  CeldRunComponents found = {
    .width = width, .height = height, .row = celd_alloc0 ((size_t) height + 1, sizeof (size_t))
  };
  uint8_t          *mark = celd_alloc ((size_t) width, 1);
  uint32_t         *parent = NULL;
  size_t            n = 0;
  CeldStatus        status;

  /* A pointer even where all pixels are fixed. */
  status = celd_reserve (&found.run, 1, &found.run_capacity, sizeof *found.run) && found.row && mark ? CELD_OK
                                                                                                      : CELD_NO_MEMORY;
  for (int y = 0; y < height && status == CELD_OK; y++)
    {
      status = y % 64 ? CELD_OK : celd_progress (host, (double) y / height);
      if (status == CELD_OK)
        status = find_row_runs (&j, &found, y, mark, &n);
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
      number_components (&found, parent);
      *components = found;
    }
  else
    celd_run_components_clear (&found);
  celd_free (mark);
  celd_free (parent);
  return status;
}

void
celd_run_components_clear (CeldRunComponents *components)
{
  celd_free (components->row);
  celd_free (components->run);
  *components = (CeldRunComponents) { 0 };
}

uint32_t
celd_run_component_at (const CeldRunComponents *components, int x, int y)
{
  size_t low = components->row[y], high = components->row[y + 1];

  while (high - low > 1)
    {
      size_t middle = low + (high - low) / 2;

      if (components->run[middle].x <= x)
        low = middle;
      else
        high = middle;
    }
  return components->run[low].component;
}

bool
celd_run_marked (const CeldRunComponents *components, const CeldPixelRun *run, int y, const uint8_t *mark)
{
  return memchr (mark + (size_t) y * (size_t) components->width + (size_t) run->x, 1,
                 (size_t) (run->end - run->x)) != NULL;
}
