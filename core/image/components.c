/* Connected components of equal labels.
 *
 * Two passes after Rosenfeld and Pfaltz, "Sequential operations in digital picture processing", 1966: pixels take the
 * number of a neighbour above or to the left, and numbers that meet are joined (union-find; the smaller number becomes
 * the root, so components are in the reading order of their first pixels); then numbers are resolved.  Practically
 * linear time; one number per pixel of work space.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"

#define NUMBERED_ROWS 64 /* rows between two reports of progress */

typedef struct
{
  uint32_t *parent;  /* of number k: parent[k] <= k; k itself for a root; number 0 is "no component" */
  size_t    n;       /* numbers given so far, with number 0 */
  size_t    capacity;
} Numbers;

/* A new number; 0 if there is no memory, but also the very first time. */
static uint32_t
new_number (Numbers *numbers)
{
  uint32_t number = (uint32_t) numbers->n;

  return celd_append (numbers->parent, numbers->n, numbers->capacity, number) == CELD_OK ? number : 0;
}

/* First pass: numbers the pixels of row y; `above` has the numbers of the row above (NULL in the first row). */
static CeldStatus
number_row (const CeldLabels *labels, uint32_t none, bool diagonal, int y, const uint32_t *above, uint32_t *row,
            Numbers *numbers)
{
  const uint32_t *label = &CELD_AT (labels, 0, y), *upper = above ? label - labels->stride : NULL;
  int             w = labels->width;

  for (int x = 0; x < w; x++)
    {
      uint32_t l = label[x];
      bool     west = x > 0 && label[x - 1] == l;
      bool     north = upper && upper[x] == l;
      bool     north_west = upper && x > 0 && upper[x - 1] == l;
      bool     north_east = diagonal && upper && x + 1 < w && upper[x + 1] == l;

      if (l == none)
        {
          row[x] = 0;
          continue;
        }
      row[x] = west ? row[x - 1] : north ? above[x] : diagonal && north_west ? above[x - 1] : north_east ? above[x + 1]
             : 0;
      if (!row[x] && !(row[x] = new_number (numbers)))
        return CELD_NO_MEMORY;
      /* Numbers that are neighbours in the row above have been joined there. */
      if (west && north && !north_west)
        celd_join (numbers->parent, row[x], above[x]);
      if (north_east && !north && (west || north_west))
        celd_join (numbers->parent, row[x], above[x + 1]);
    }
  return CELD_OK;
}

static CeldStatus
number_pixels (const CeldLabels *labels, uint32_t none, bool diagonal, const CeldHost *host, uint32_t *number,
               Numbers *numbers)
{
  size_t     w = (size_t) labels->width;
  CeldStatus status = new_number (numbers) == 0 && numbers->n ? CELD_OK : CELD_NO_MEMORY;

  for (int y = 0; y < labels->height && status == CELD_OK; y++)
    {
      uint32_t *row = number + (size_t) y * w;

      status = number_row (labels, none, diagonal, y, y ? row - w : NULL, row, numbers);
      if (status == CELD_OK && y % NUMBERED_ROWS == 0)
        status = celd_progress (host, 0.6 * y / labels->height);
    }
  return status;
}

/* Turns parents into consecutive component numbers 1 .. n; returns n. */
static size_t
resolve_numbers (Numbers *numbers)
{
  uint32_t *parent = numbers->parent, n = 0;

  for (size_t k = 1; k < numbers->n; k++)
    parent[k] = parent[k] == k ? ++n : parent[parent[k]]; /* smaller numbers are resolved already */
  return n;
}

static inline void
add_pixel (CeldComponent *c, uint32_t label, int x, int y)
{
  if (c->area++ == 0)
    *c = (CeldComponent) { label, x, y, x, y, x, y, 1 };
  if (x < c->left)
    c->left = x;
  if (x > c->right)
    c->right = x;
  c->bottom = y;
}

/* Second pass.  It cannot fail, so `components` may alias the labels. */
static void
write_components (const CeldLabels *labels, const uint32_t *number, const Numbers *numbers,
                  CeldLabels *components, CeldComponent *list)
{
  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      {
        uint32_t label = CELD_AT (labels, x, y), k = numbers->parent[*number++];

        if (k)
          add_pixel (&list[k - 1], label, x, y);
        CELD_AT (components, x, y) = k;
      }
}

CeldStatus
celd_components (const CeldLabels *labels, uint32_t none, bool diagonal, const CeldHost *host,
                 CeldLabels *components, CeldComponent **list, size_t *n)
{
  Numbers        numbers = { 0 };
  uint32_t      *number = NULL;
  CeldComponent *found = NULL;
  size_t         count;
  CeldStatus     status;

  if (!CELD_SAME_SIZE (labels, components))
    return CELD_BAD_SIZE;
  status = CELD_NO_MEMORY;
  number = celd_alloc ((size_t) labels->width * (size_t) labels->height, sizeof *number);
  if (!number)
    goto done;
  status = number_pixels (labels, none, diagonal, host, number, &numbers);
  if (status != CELD_OK)
    goto done;
  count = resolve_numbers (&numbers);
  found = celd_alloc0 (count, sizeof *found);
  status = found ? celd_progress (host, 0.7) : CELD_NO_MEMORY;
  if (status != CELD_OK)
    goto done;
  write_components (labels, number, &numbers, components, found);
  *list = found;
  *n = count;
  found = NULL;
done:
  celd_free (number);
  celd_free (numbers.parent);
  celd_free (found);
  return status;
}
