/* Thins paint to lines of one pixel.
 *
 * Pixels on the edge are removed from two sides in turn, unless that would end or divide a line (Zhang and Suen 1984,
 * "A fast parallel algorithm for thinning digital patterns").  Those with two neighbours stay, because diagonal lines
 * of two pixels would shrink from their ends (Lü and Wang 1986, "A comment on 'A fast parallel algorithm for thinning
 * digital patterns'").  Then pixels in the corners of steps are removed, so that a pixel of a line has two neighbours,
 * and others are ends or branchings.
 *
 * Only pixels on the edge can be removed, so each pass looks at these alone.
 *
 * Cost: a pass over the paint, and half its largest width times the pixels on its edge; up to 9 bytes a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrows.h"

void
celd_thin_neighbours (const uint8_t *on, size_t width, size_t p, bool around[8])
{
  size_t at[8] = { p - width, p - width + 1, p + 1, p + width + 1, p + width, p + width - 1, p - 1, p - width - 1 };

  for (int i = 0; i < 8; i++)
    around[i] = on[at[i]];
}

/* May a pixel be removed in one of the two halves of a pass? */
static bool
is_removable (const uint8_t *on, size_t width, size_t p, bool second)
{
  bool a[8];
  int  n = 0, starts = 0;

  celd_thin_neighbours (on, width, p, a);
  for (int i = 0; i < 8; i++)
    {
      n += a[i];
      starts += !a[i] && a[(i + 1) % 8];
    }
  if (n < 3 || n > 6 || starts != 1)
    return false;
  return second ? !(a[0] && a[2] && a[6]) && !(a[0] && a[4] && a[6])
                : !(a[0] && a[2] && a[4]) && !(a[2] && a[4] && a[6]);
}

#define LISTED 2 /* value of a pixel of the edge, instead of 1 */

typedef struct { uint32_t *pixel; size_t n; } Frontier;

/* Adds a pixel of the paint, unless the edge has it. */
static void
add (uint8_t *on, size_t p, Frontier *edge)
{
  if (on[p] != 1)
    return;
  on[p] = LISTED;
  edge->pixel[edge->n++] = (uint32_t) p;
}

/* Adds the paint round pixels that were removed. */
static void
add_around (uint8_t *on, size_t width, size_t p, Frontier *edge)
{
  for (int dy = -1; dy <= 1; dy++)
    for (int dx = -1; dx <= 1; dx++)
      add (on, (size_t) ((ptrdiff_t) p + dy * (ptrdiff_t) width + dx), edge);
}

static void
find_edge (uint8_t *on, size_t width, size_t all, Frontier *edge)
{
  for (size_t p = 0; p < all; p++)
    if (on[p])
      {
        bool a[8];

        celd_thin_neighbours (on, width, p, a);
        for (int i = 0; i < 8; i++)
          if (!a[i])
            add (on, p, edge);
      }
}

/* Removes what can be removed in half a pass; returns how much.  `gone` has room for it. */
static size_t
remove_edge (uint8_t *on, size_t width, bool second, Frontier *edge, uint32_t *gone)
{
  size_t kept = 0, n_gone = 0;

  for (size_t i = 0; i < edge->n; i++)
    if (is_removable (on, width, edge->pixel[i], second))
      gone[n_gone++] = edge->pixel[i];
    else
      edge->pixel[kept++] = edge->pixel[i];
  edge->n = kept;
  for (size_t i = 0; i < n_gone; i++)
    on[gone[i]] = 0;
  for (size_t i = 0; i < n_gone; i++)
    add_around (on, width, gone[i], edge);
  return n_gone;
}

/* Removes pixels in the corners of steps, so that lines have two neighbours at each pixel. */
static void
remove_steps (uint8_t *on, size_t width, size_t all)
{
  for (size_t p = 0; p < all; p++)
    if (on[p])
      {
        bool a[8];

        on[p] = 1;
        celd_thin_neighbours (on, width, p, a);
        for (int k = 0; k < 8; k += 2)
          if (a[k] && a[(k + 2) % 8] && !a[(k + 4) % 8] && !a[(k + 5) % 8] && !a[(k + 6) % 8])
            on[p] = 0;
      }
}

CeldStatus
celd_thin (uint8_t *on, int width, int height)
{
  size_t    w = (size_t) width, all = w * (size_t) height, most = 1;
  Frontier  edge = { NULL, 0 };
  uint32_t *gone;
  bool      ready;

  for (size_t p = 0; p < all; p++)
    most += on[p];
  edge.pixel = celd_alloc (most, sizeof *edge.pixel);
  gone = celd_alloc (most, sizeof *gone);
  ready = edge.pixel && gone;
  if (ready)
    {
      find_edge (on, w, all, &edge);
      for (int half = 0, idle = 0; idle < 2; half = !half)
        idle = remove_edge (on, w, half, &edge, gone) ? 0 : idle + 1;
      remove_steps (on, w, all);
    }
  celd_free (edge.pixel);
  celd_free (gone);
  return ready ? CELD_OK : CELD_NO_MEMORY;
}
