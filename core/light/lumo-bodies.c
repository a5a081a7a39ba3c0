/* Bodies: what is solved as one surface.
 *
 * Components of visible pixels are connected by the weights of depth.  A part of a sheet that nearer ones hide connects
 * the components of its label on all sides of what hides it, and makes a body of them.  Where a sheet shares an
 * antialiased pixel with a nearer one that covers most of it, that pixel is hidden, too.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "light/light.h"

#include <stdlib.h>

#define COVERED 128 /* of 255: sheets reach to where they cover half of a pixel */

typedef struct
{
  CeldLumo      *lumo;
  CeldHiddenRun *run;           /* `body` has the label at first, and then the root */
  size_t         n, capacity;
  uint32_t      *parent;        /* of components, and of runs behind them */
  uint32_t      *plane;         /* of the box of a sheet: the run of each pixel, from 1 */
} Joining;

/* ------------------------------------------------------------------ hidden pixels */

static CeldStatus
add_run (Joining *w, int x, int y, int end, uint32_t label)
{
  return celd_append (w->run, w->n, w->capacity, (CeldHiddenRun) { x, y, end, label });
}

static CeldStatus
add_sheet (Joining *w, const CeldSheet *sheet)
{
  CeldStatus status = CELD_OK;

  for (size_t r = 0; r < sheet->n_runs && status == CELD_OK; r++)
    {
      const CeldSheetRun *run = &sheet->run[r];
      const uint8_t      *coverage = sheet->coverage + run->first;

      for (int i = 0, end; i < run->n && status == CELD_OK; i = end + 1)
        {
          for (end = i; end < run->n && coverage[end] >= COVERED;)
            end++;
          if (end > i)
            status = add_run (w, run->x + i, run->y, run->x + end, sheet->label);
        }
    }
  return status;
}

static CeldStatus
add_shared (Joining *w)
{
  const CeldLumo      *l = w->lumo;
  const CeldOwnership *own = l->own;
  CeldStatus           status = CELD_OK;

  for (int y = 0; y < l->height && status == CELD_OK; y++)
    for (int x = 0; x < l->width && status == CELD_OK; x++)
      {
        uint32_t under = CELD_AT (&own->under, x, y);
        float    coverage = CELD_AT (&own->coverage, x, y);

        if (under != CELD_AT (&own->owner, x, y) && coverage >= 0.5f && coverage < 1 && under != l->page)
          status = add_run (w, x, y, x + 1, under);
      }
  return status;
}

static int
compare_runs (const void *a, const void *b)
{
  const CeldHiddenRun *one = a, *other = b;

  if (one->body != other->body)
    return one->body < other->body ? -1 : 1;
  if (one->y != other->y)
    return one->y < other->y ? -1 : 1;
  return (one->x > other->x) - (one->x < other->x);
}

/* ------------------------------------------------------------------ connections */

static CeldRect
box_of (const CeldHiddenRun *run, size_t n)
{
  CeldRect box = { 0 };

  for (size_t i = 0; i < n; i++)
    box = celd_rect_union (box, (CeldRect) { run[i].x, run[i].y, run[i].end - run[i].x, 1 });
  return box;
}

/* Joins a run with what is at (x,y), if that is of the same label. */
static void
join_with (Joining *w, size_t run, CeldRect box, uint32_t label, int x, int y)
{
  const CeldLumo *l = w->lumo;
  size_t          n = l->components.n;
  uint32_t        other = 0;

  if (x < 0 || y < 0 || x >= l->width || y >= l->height)
    return;
  if (x >= box.x && y >= box.y && x < box.x + box.width && y < box.y + box.height)
    other = w->plane[(size_t) (y - box.y) * (size_t) box.width + (size_t) (x - box.x)];
  if (other)
    celd_join (w->parent, (uint32_t) (n + run), (uint32_t) n + other - 1);
  else if (celd_larger_label (l->own, x, y) == label)
    celd_join (w->parent, (uint32_t) (n + run), celd_run_component_at (&l->components, x, y));
}

/* Joins the runs first .. end - 1, which are all those of a label. */
static CeldStatus
join_label (Joining *w, size_t first, size_t end)
{
  CeldRect box = box_of (w->run + first, end - first);

  w->plane = celd_alloc0 ((size_t) box.width * (size_t) box.height, sizeof *w->plane);
  if (!w->plane)
    return CELD_NO_MEMORY;
  for (size_t r = first; r < end; r++)
    for (int x = w->run[r].x; x < w->run[r].end; x++)
      w->plane[(size_t) (w->run[r].y - box.y) * (size_t) box.width + (size_t) (x - box.x)] = (uint32_t) r + 1;
  for (size_t r = first; r < end; r++)
    {
      const CeldHiddenRun *run = &w->run[r];

      join_with (w, r, box, run->body, run->x - 1, run->y);
      join_with (w, r, box, run->body, run->end, run->y);
      for (int x = run->x; x < run->end; x++)
        {
          join_with (w, r, box, run->body, x, run->y - 1);
          join_with (w, r, box, run->body, x, run->y + 1);
        }
    }
  celd_free (w->plane);
  return CELD_OK;
}

static CeldStatus
join_all (Joining *w)
{
  size_t     n = w->lumo->components.n;
  CeldStatus status;

  w->parent = celd_alloc (n + w->n, sizeof *w->parent);
  status    = w->parent && n + w->n < UINT32_MAX ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    celd_roots (w->parent, n + w->n);
  for (size_t first = 0, end; first < w->n && status == CELD_OK; first = end)
    {
      for (end = first; end < w->n && w->run[end].body == w->run[first].body;)
        end++;
      status = join_label (w, first, end);
    }
  return status;
}

/* ------------------------------------------------------------------ bodies */

/* Whether a run of a component has anything but background. */
static bool
has_figure (const CeldLumo *l, const CeldPixelRun *run, int y)
{
  for (int x = run->x; x < run->end; x++)
    if (celd_larger_label (l->own, x, y) != l->page)
      return true;
  return false;
}

/* Numbers the bodies by their first components.  A run that touches no component, which a sheet does not have, is
 * a body of its own. */
static CeldStatus
number_bodies (Joining *w)
{
  CeldLumo   *l = w->lumo;
  CeldBodies *b = &l->bodies;
  size_t      n = l->components.n, all = n + w->n;
  uint32_t   *body = celd_alloc (all, sizeof *body);

  b->of_component = celd_alloc (n, sizeof *b->of_component);
  if (!body || !b->of_component)
    {
      celd_free (body);
      return CELD_NO_MEMORY;
    }
  for (size_t i = 0; i < all; i++)
    {
      uint32_t root = celd_root (w->parent, (uint32_t) i);

      body[i] = root == i ? (uint32_t) b->n++ : body[root];
      if (i < n)
        b->of_component[i] = body[i];
      else
        w->run[i - n].body = body[i];
    }
  celd_free (body);
  return CELD_OK;
}

static CeldStatus
describe_bodies (Joining *w)
{
  CeldLumo   *l = w->lumo;
  CeldBodies *b = &l->bodies;
  bool        any = l->hints || l->n_creases; /* what may bend the background */

  b->box   = celd_alloc0 (b->n, sizeof *b->box);
  b->bends = celd_alloc0 (b->n, sizeof *b->bends);
  b->first = celd_alloc0 (b->n + 1, sizeof *b->first);
  if (!b->box || !b->bends || !b->first)
    return CELD_NO_MEMORY;
  CELD_EACH_RUN (&l->components, 0, l->height, y, s)
    {
      uint32_t k = b->of_component[s->component];

      celd_box_add_run (&b->box[k], s, y);
      b->bends[k] = b->bends[k] || any || has_figure (l, s, y);
    }
  if (w->n)
    qsort (w->run, w->n, sizeof *w->run, compare_runs);
  for (size_t r = 0; r < w->n; r++)
    {
      CeldRect *box = &b->box[w->run[r].body];

      *box = celd_rect_union (*box, (CeldRect) { w->run[r].x, w->run[r].y, w->run[r].end - w->run[r].x, 1 });
      b->first[w->run[r].body + 1] = r + 1;
    }
  for (size_t k = 0; k < b->n; k++)
    b->first[k + 1] = b->first[k + 1] > b->first[k] ? b->first[k + 1] : b->first[k];
  b->hidden = w->run;
  w->run    = NULL;
  return CELD_OK;
}

void
celd_lumo_bodies_clear (CeldBodies *b)
{
  celd_free (b->of_component);
  celd_free (b->box);
  celd_free (b->bends);
  celd_free (b->hidden);
  celd_free (b->first);
  *b = (CeldBodies) { 0 };
}

CeldStatus
celd_lumo_bodies (CeldLumo *l, const CeldHost *host)
{
  Joining       w = { .lumo = l };
  CeldStatus status = celd_run_components_find (l->width, l->height, l->level, NULL, &l->edges, host, &l->components);

  for (size_t k = 0; k < l->sheets->n && status == CELD_OK; k++)
    if (!l->sheets->item[k].page)
      status = add_sheet (&w, &l->sheets->item[k]);
  if (status == CELD_OK)
    status = add_shared (&w);
  if (status == CELD_OK && w.n)
    qsort (w.run, w.n, sizeof *w.run, compare_runs);
  if (status == CELD_OK)
    status = join_all (&w);
  if (status == CELD_OK)
    status = number_bodies (&w);
  if (status == CELD_OK)
    status = describe_bodies (&w);
  celd_free (w.run);
  celd_free (w.parent);
  return status;
}
