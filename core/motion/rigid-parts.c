/* The rigid parts of a labelled frame: the connected components of its labels, with samples of their paper and of their
 * outlines, and the places where they touch.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/motion.h"
#include "motion/rigid-parts.h"

#include <stdlib.h>

#define LEAST_PAPER   24    /* pixels of a part; chosen */
#define LEAST_OWN     8     /* with less than this part of its outline visible, all of it counts; chosen */
#define LEAST_CONTACT 4     /* pairs of neighbours; chosen */
#define FULL_CONTACT  0.25f /* of the shorter outline: longer contacts hold no better; chosen */

/* PartSums over the pixels of a component; then the number of the part that it becomes. */
typedef struct { size_t area; double x, y; bool frame; uint32_t part; } PartSums;

typedef struct { uint32_t a, b; float x, y; } PartPair;

/* ------------------------------------------------------------------ parts */

static void
sum_up (const CeldPlane *ink, const CeldLabels *component, PartSums *sums)
{
  for (int y = 0; y < ink->height; y++)
    for (int x = 0; x < ink->width; x++)
      {
        PartSums *s = &sums[CELD_AT (component, x, y)];

        s->frame |= !x || !y || x == ink->width - 1 || y == ink->height - 1;
        if (!celd_is_paper (CELD_AT (ink, x, y)))
          continue;
        s->area++;
        s->x += x + 0.5;
        s->y += y + 0.5;
      }
}

/* Makes a part of each component that is large enough and moves. */
static CeldStatus
list_parts (const CeldComponent *component, size_t n, uint32_t background, PartSums *sums, CeldRigidParts *parts)
{
  parts->item = celd_alloc0 (n, sizeof *parts->item);
  if (!parts->item)
    return CELD_NO_MEMORY;
  for (size_t c = 0; c < n; c++)
    {
      PartSums *s = &sums[c + 1];

      if (s->area < LEAST_PAPER || (component[c].label == background && s->frame))
        continue;
      parts->item[parts->n] = (CeldRigidPart) {
        .label = component[c].label, .area = s->area,
        .x = (float) (s->x / (double) s->area), .y = (float) (s->y / (double) s->area),
        .box = { component[c].left, component[c].top, component[c].right - component[c].left + 1,
                 component[c].bottom - component[c].top + 1 },
      };
      s->part = (uint32_t) ++parts->n;
    }
  return CELD_OK;
}

/* ------------------------------------------------------------------ samples */

/* The number of the part at a pixel; 0 outside the picture. */
static uint32_t
part_at (const CeldRigidParts *parts, int x, int y)
{
  return x < 0 || y < 0 || x >= parts->width || y >= parts->height ? 0
         : parts->part[(size_t) y * (size_t) parts->width + (size_t) x];
}

static bool
on_outline (const CeldRigidParts *parts, int x, int y, uint32_t number)
{
  return part_at (parts, x - 1, y) != number || part_at (parts, x + 1, y) != number ||
         part_at (parts, x, y - 1) != number || part_at (parts, x, y + 1) != number;
}

/* Whether a nearer label hides the part at this pixel of its outline: the line there is not its own. */
static bool
is_covered (const CeldLabels *labels, const uint32_t *level, int x, int y)
{
  uint32_t own = level[CELD_AT (labels, x, y) - 1];

  return (x > 0 && level[CELD_AT (labels, x - 1, y) - 1] > own) ||
         (y > 0 && level[CELD_AT (labels, x, y - 1) - 1] > own) ||
         (x + 1 < labels->width && level[CELD_AT (labels, x + 1, y) - 1] > own) ||
         (y + 1 < labels->height && level[CELD_AT (labels, x, y + 1) - 1] > own);
}

static void
take_samples (const CeldPlane *ink, const CeldLabels *labels, const uint32_t *level, const CeldRigidParts *parts,
              CeldRigidPart *part, uint32_t number)
{
  size_t inside = 0, outline = 0, own = 0;

  for (int y = part->box.y; y < part->box.y + part->box.height; y++)
    for (int x = part->box.x; x < part->box.x + part->box.width; x++)
      if (part_at (parts, x, y) == number && on_outline (parts, x, y, number))
        {
          part->length++;
          own += level && !is_covered (labels, level, x, y);
        }
  if (own < part->length / LEAST_OWN)
    level = NULL;
  own = level ? own : part->length;
  for (int y = part->box.y; y < part->box.y + part->box.height; y++)
    for (int x = part->box.x; x < part->box.x + part->box.width; x++)
      {
        CeldOffset at = { (float) x + 0.5f - part->x, (float) y + 0.5f - part->y };

        if (part_at (parts, x, y) != number)
          continue;
        if (celd_is_paper (CELD_AT (ink, x, y)) && celd_is_sample (inside++, part->area, CELD_INSIDE_SAMPLES))
          part->inside[part->n_inside++] = at;
        if (on_outline (parts, x, y, number) && !(level && is_covered (labels, level, x, y)) &&
            celd_is_sample (outline++, own, CELD_OUTLINE_SAMPLES))
          part->outline[part->n_outline++] = at;
      }
}

/* ------------------------------------------------------------------ contacts */

static int
compare_pairs (const void *a, const void *b)
{
  const PartPair *one = a, *other = b;

  if (one->a != other->a)
    return one->a < other->a ? -1 : 1;
  if (one->b != other->b)
    return one->b < other->b ? -1 : 1;
  return 0;
}

/* All pairs of neighbouring pixels of two parts, a < b. */
static CeldStatus
list_pairs (const CeldRigidParts *parts, PartPair **pair, size_t *n)
{
  size_t     capacity = 0;
  CeldStatus status = CELD_OK;

  for (int y = 0; y < parts->height; y++)
    for (int x = 0; x < parts->width; x++)
      for (int down = 0; down < 2 && status == CELD_OK; down++)
        {
          uint32_t a = part_at (parts, x, y), b = part_at (parts, x + !down, y + down);

          if (a && b && a != b)
            status = celd_append (*pair, *n, capacity,
                                  (PartPair) { (a < b ? a : b) - 1, (a < b ? b : a) - 1,
                                           (float) x + (down ? 0.5f : 1), (float) y + (down ? 1 : 0.5f) });
        }
  return status;
}

static CeldStatus
find_contacts (CeldRigidParts *parts)
{
  PartPair      *pair = NULL;
  size_t     n = 0, capacity = 0;
  CeldStatus status = list_pairs (parts, &pair, &n);

  if (n)
    qsort (pair, n, sizeof *pair, compare_pairs);
  for (size_t i = 0, end; i < n && status == CELD_OK; i = end)
    {
      double x = 0, y = 0;
      size_t shorter = parts->item[pair[i].a].length, other = parts->item[pair[i].b].length;
      float  full = FULL_CONTACT * (float) (shorter < other ? shorter : other);

      for (end = i; end < n && !compare_pairs (&pair[i], &pair[end]); end++)
        {
          x += (double) pair[end].x;
          y += (double) pair[end].y;
        }
      if (end - i >= LEAST_CONTACT)
        status = celd_append (parts->contact, parts->n_contacts, capacity, (CeldContact) {
          pair[i].a, pair[i].b, (float) (x / (double) (end - i)), (float) (y / (double) (end - i)),
          (float) (end - i) < full ? (float) (end - i) / full : 1 });
    }
  celd_free (pair);
  return status;
}

/* ------------------------------------------------------------------ */

CeldStatus
celd_rigid_parts_new (const CeldPlane *ink, const CeldLabels *labels, const uint32_t *level, uint32_t background,
                      const CeldHost *host, CeldRigidParts *parts)
{
  size_t         pixels = (size_t) ink->width * (size_t) ink->height, n = 0;
  CeldLabels     component = { 0 };
  CeldComponent *list = NULL;
  PartSums          *sums = NULL;
  CeldStatus     status = celd_labels_new (ink->width, ink->height, &component);

  *parts = (CeldRigidParts) { .width = ink->width, .height = ink->height };
  if (status == CELD_OK)
    status = celd_components (labels, 0, true, host, &component, &list, &n);
  if (status == CELD_OK && (!(sums = celd_alloc0 (n + 1, sizeof *sums)) ||
                            !(parts->part = celd_alloc (pixels, sizeof *parts->part))))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      sum_up (ink, &component, sums);
      status = list_parts (list, n, background, sums, parts);
    }
  for (size_t i = 0; i < pixels && status == CELD_OK; i++)
    parts->part[i] = component.data[i] ? sums[component.data[i]].part : 0;
  for (size_t k = 0; k < parts->n && status == CELD_OK; k++)
    take_samples (ink, labels, level, parts, &parts->item[k], (uint32_t) k + 1);
  if (status == CELD_OK)
    status = find_contacts (parts);
  celd_free (component.data);
  celd_free (list);
  celd_free (sums);
  return status;
}

void
celd_rigid_parts_clear (CeldRigidParts *parts)
{
  celd_free (parts->part);
  celd_free (parts->item);
  celd_free (parts->contact);
  *parts = (CeldRigidParts) { 0 };
}
