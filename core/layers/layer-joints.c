/* Joints: which layer each layer is most plausibly attached to, and where, as a start for rigging.
 *
 * Layers that touch are joined where they touch most: the joints are a maximum spanning forest of the contacts between
 * them, by Kruskal's method.  The layer of a tree with the most visible pixels is its root, whatever lies in front of
 * it, so that a leg behind a body hangs on the body as an arm in front of it does.  The page is no part of it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layers/layers.h"

#include <stdlib.h>

/* The contact of two layers a < b: how many sides of pixels they share, and the sums of the middles of these sides. */
typedef struct { uint32_t a, b; size_t sides; double x, y; } Contact;

typedef struct { Contact *item; size_t n, capacity; } Contacts;

/* Of a layer: what is visible of it; where it hangs on its parent. */
typedef struct { size_t pixels; double x, y; const Contact *up; } RigPart;

/* ------------------------------------------------------------------ contacts */

/* The layer that covers most of a pixel. */
static uint32_t
layer_at (const CeldLayers *layers, int x, int y)
{
  uint32_t         place = layers->place[(size_t) y * (size_t) layers->width + (size_t) x];
  const CeldBlend *blend = place < layers->n ? NULL : &layers->blend[place - layers->n];

  return !blend ? place : blend->layer[blend->coverage < 0.5f];
}

static int
compare_layers (const void *first, const void *second)
{
  const Contact *one = first, *other = second;

  if (one->a != other->a)
    return one->a < other->a ? -1 : 1;
  return one->b < other->b ? -1 : one->b > other->b;
}

/* Largest contacts first. */
static int
compare_sides (const void *first, const void *second)
{
  const Contact *one = first, *other = second;

  if (one->sides != other->sides)
    return one->sides > other->sides ? -1 : 1;
  return compare_layers (first, second);
}

/* Adds up the contacts of the same two layers. */
static void
merge (Contacts *contacts)
{
  size_t n = 0;

  if (contacts->n)
    qsort (contacts->item, contacts->n, sizeof *contacts->item, compare_layers);
  for (size_t i = 0; i < contacts->n; i++)
    if (n && !compare_layers (&contacts->item[n - 1], &contacts->item[i]))
      {
        contacts->item[n - 1].sides += contacts->item[i].sides;
        contacts->item[n - 1].x += contacts->item[i].x;
        contacts->item[n - 1].y += contacts->item[i].y;
      }
    else
      contacts->item[n++] = contacts->item[i];
  contacts->n = n;
}

static CeldStatus
add_side (Contacts *contacts, uint32_t one, uint32_t other, double x, double y)
{
  Contact side = { one < other ? one : other, one < other ? other : one, 1, x, y };

  if (contacts->n && contacts->n == contacts->capacity)
    {
      merge (contacts);
      if (contacts->n > contacts->capacity / 2 &&
          !celd_reserve (&contacts->item, 2 * contacts->capacity, &contacts->capacity, sizeof *contacts->item))
        return CELD_NO_MEMORY;
    }
  return celd_append (contacts->item, contacts->n, contacts->capacity, side);
}

static CeldStatus
find_contacts (const CeldLayers *layers, size_t page, RigPart *part, Contacts *contacts)
{
  CeldStatus status = CELD_OK;

  for (int y = 0; y < layers->height && status == CELD_OK; y++)
    for (int x = 0; x < layers->width && status == CELD_OK; x++)
      {
        uint32_t here = layer_at (layers, x, y);
        uint32_t right = x + 1 < layers->width ? layer_at (layers, x + 1, y) : here;
        uint32_t below = y + 1 < layers->height ? layer_at (layers, x, y + 1) : here;

        part[here].pixels++;
        part[here].x += x + 0.5;
        part[here].y += y + 0.5;
        if (right != here && here != page && right != page)
          status = add_side (contacts, here, right, x + 1, y + 0.5);
        if (below != here && here != page && below != page && status == CELD_OK)
          status = add_side (contacts, here, below, x + 0.5, y + 1);
      }
  merge (contacts);
  return status;
}

/* ------------------------------------------------------------------ the forest */

static size_t
parent_of (const RigPart *part, size_t k)
{
  return !part[k].up ? CELD_NO_INDEX : part[k].up->a == k ? part[k].up->b : part[k].up->a;
}

static size_t
root_of (const RigPart *part, size_t k)
{
  while (part[k].up)
    k = parent_of (part, k);
  return k;
}

/* Hangs the tree of layer k by k on `up`: the way from k to the old root is turned round. */
static void
hang (RigPart *part, size_t k, const Contact *up)
{
  while (k != CELD_NO_INDEX)
    {
      size_t         next = parent_of (part, k);
      const Contact *old = part[k].up;

      part[k].up = up;
      up = old;
      k = next;
    }
}

static void
join (const Contacts *contacts, RigPart *part)
{
  for (size_t i = 0; i < contacts->n; i++)
    {
      const Contact *contact = &contacts->item[i];
      size_t         one = root_of (part, contact->a), other = root_of (part, contact->b);

      if (one != other)
        hang (part, part[other].pixels > part[one].pixels ? contact->a : contact->b, contact);
    }
}

/* ------------------------------------------------------------------ the joints */

static CeldJoint
make_joint (const CeldLayers *layers, const RigPart *part, size_t k)
{
  const Contact *up = part[k].up;
  CeldRect       box = layers->item[k].box;

  if (up)
    return (CeldJoint) { parent_of (part, k), up->x / (double) up->sides, up->y / (double) up->sides };
  if (part[k].pixels)
    return (CeldJoint) { CELD_NO_INDEX, part[k].x / (double) part[k].pixels, part[k].y / (double) part[k].pixels };
  return (CeldJoint) { CELD_NO_INDEX, box.x + 0.5 * box.width, box.y + 0.5 * box.height };
}

CeldStatus
celd_layers_joints (const CeldLayers *layers, uint32_t page, CeldJoint *joint)
{
  Contacts   contacts = { 0 };
  RigPart      *part = celd_alloc0 (layers->n, sizeof *part);
  size_t     of_page = CELD_NO_INDEX;
  CeldStatus status = CELD_NO_MEMORY;

  for (size_t k = 0; k < layers->n; k++)
    if (layers->item[k].label == page)
      of_page = k;
  if (part)
    status = find_contacts (layers, of_page, part, &contacts);
  if (status == CELD_OK)
    {
      if (contacts.n)
        qsort (contacts.item, contacts.n, sizeof *contacts.item, compare_sides);
      join (&contacts, part);
      for (size_t k = 0; k < layers->n; k++)
        joint[k] = make_joint (layers, part, k);
    }
  celd_free (contacts.item);
  celd_free (part);
  return status;
}
