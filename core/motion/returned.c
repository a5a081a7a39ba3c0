/* Which labels of a frame may be wrong: those that do not come back.
 *
 * A region that was carried to the right place comes back from there: its labels, propagated back to the frame before,
 * lie where they were.  One that was lost, or whose place another took, does not.  Its visible area hardly changes from
 * frame to frame, either.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <math.h>

/* Pixels of a label: in the frame before, in this one; and where labels came back, of both or of either. */
typedef struct { size_t before, after, both, either; } Agreement;

static void
count_pixels (const CeldLabels *before, const CeldLabels *after, const CeldLabels *back, Agreement *agreement)
{
  for (int y = 0; y < before->height; y++)
    for (int x = 0; x < before->width; x++)
      {
        uint32_t was = CELD_AT (before, x, y), returned = CELD_AT (back, x, y);

        agreement[was].before++;
        agreement[CELD_AT (after, x, y)].after++;
        if (!returned) /* on ink, or close to it */
          continue;
        agreement[was].either++;
        agreement[returned].either += returned != was;
        agreement[returned].both += returned == was;
      }
}

static double
rate (const Agreement *a)
{
  double overlap = a->either ? (double) a->both / (double) a->either : 1;
  double least = fmin ((double) a->before, (double) a->after), most = fmax ((double) a->before, (double) a->after);

  return most > 0 ? fmin (overlap, least / most) : 1;
}

CeldStatus
celd_rate_returned (const CeldLabels *before, const CeldLabels *after, const CeldLabels *back, size_t n, double *sure)
{
  Agreement *agreement;

  if (!CELD_SAME_SIZE (before, after) || !CELD_SAME_SIZE (before, back))
    return CELD_BAD_SIZE;
  if (celd_labels_beyond (before, n) || celd_labels_beyond (after, n) || celd_labels_beyond (back, n))
    return CELD_BAD_VALUE;
  agreement = celd_alloc0 (n + 1, sizeof *agreement);
  if (!agreement)
    return CELD_NO_MEMORY;
  count_pixels (before, after, back, agreement);
  for (size_t l = 1; l <= n; l++)
    sure[l] = rate (&agreement[l]);
  celd_free (agreement);
  return CELD_OK;
}
