/* Thins paint to lines of one pixel.
 *
 * Pixels on the edge are removed from two sides in turn, unless that would end or divide a line (Zhang and Suen 1984,
 * "A fast parallel algorithm for thinning digital patterns").  Those with two neighbours stay, because diagonal lines
 * of two pixels would shrink from their ends (Lü and Wang 1986, "A comment on 'A fast parallel algorithm for thinning
 * digital patterns'").  Then pixels in the corners of steps are removed, so that a pixel of a line has two neighbours,
 * and others are ends or branchings.
 *
 * Cost: as many passes over the paint as half its largest width.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

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

/* Removes pixels in the corners of steps, so that lines have two neighbours at each pixel. */
static void
remove_steps (uint8_t *on, size_t width, const uint32_t *list, size_t n)
{
  for (size_t i = 0; i < n; i++)
    {
      bool a[8];

      celd_thin_neighbours (on, width, list[i], a);
      for (int k = 0; k < 8; k += 2)
        if (a[k] && a[(k + 2) % 8] && !a[(k + 4) % 8] && !a[(k + 5) % 8] && !a[(k + 6) % 8])
          on[list[i]] = 0;
    }
}

CeldStatus
celd_thin (uint8_t *on, int width, int height)
{
  size_t    n = 0, most = 1, all = (size_t) width * (size_t) height, n_gone;
  uint32_t *list, *gone;

  for (size_t p = 0; p < all; p++)
    most += on[p];
  list = celd_alloc (most, sizeof *list);
  gone = celd_alloc (most, sizeof *gone);
  for (size_t p = 0; list && p < all; p++)
    if (on[p])
      list[n++] = (uint32_t) p;
  for (int half = 0, idle = 0; list && gone && idle < 2; half = !half)
    {
      size_t kept = 0;

      n_gone = 0;
      for (size_t i = 0; i < n; i++)
        if (is_removable (on, (size_t) width, list[i], half))
          gone[n_gone++] = list[i];
        else
          list[kept++] = list[i];
      for (size_t i = 0; i < n_gone; i++)
        on[gone[i]] = 0;
      n    = kept;
      idle = n_gone ? 0 : idle + 1;
    }
  if (list && gone)
    remove_steps (on, (size_t) width, list, n);
  celd_free (list);
  celd_free (gone);
  return list && gone ? CELD_OK : CELD_NO_MEMORY;
}

