/* Which regions of a frame may be wrong.
 *
 * A region that was carried to the right place comes back from there: its labels, propagated back to the frame before,
 * lie where they were.  One that was lost, or whose place another took, does not.  Its visible area hardly changes from
 * frame to frame, either.  A region that is wrong once stays so up to the next key.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "propagate.h"

/* Pixels of a label: in the frame before, in this one; and where labels came back, of both or of either. */
typedef struct { size_t before, after, both, either; } Agreement;

static void
count_pixels (const CeldLabels *before, const CeldLabels *after, const CeldLabels *back, Agreement *agreement)
{
  for (int y = 0; y < before->height; y++)
    for (int x = 0; x < before->width; x++)
      {
        uint32_t was = before->data[(size_t) y * before->stride + (size_t) x];
        uint32_t returned = back->data[(size_t) y * back->stride + (size_t) x];

        agreement[was].before++;
        agreement[after->data[(size_t) y * after->stride + (size_t) x]].after++;
        if (!returned) /* on ink, or close to it */
          continue;
        agreement[was].either++;
        agreement[returned].either += returned != was;
        agreement[returned].both += returned == was;
      }
}

/* From 0, nothing agrees, to 1; also 1 for a region that neither frame has. */
static double
rate (const Agreement *a)
{
  double overlap = a->either ? (double) a->both / (double) a->either : 1;
  double most = (double) MAX (a->before, a->after);

  return most > 0 ? MIN (overlap, (double) MIN (a->before, a->after) / most) : 1;
}

bool
cli_frame_doubt (const CliMotion *motion, const CeldHost *host, const CliFrameState *before, CliFrameState *next)
{
  Agreement *agreement = g_new0 (Agreement, motion->palette.n + 1);
  CeldLabels back = { 0 };
  CeldPlane  certainty = { 0 };
  bool       good = cli_labels_new (motion->width, motion->height, &back) &&
                    cli_plane_new (motion->width, motion->height, &certainty) &&
                    cli_check (celd_propagate (&next->ink, &next->labels, motion->order.level, motion->background,
                                               &before->ink, host, &back, &certainty));

  if (good)
    count_pixels (&before->labels, &next->labels, &back, agreement);
  next->sure = g_new0 (double, motion->palette.n + 1);
  for (size_t l = 1; l <= motion->palette.n && good; l++)
    next->sure[l] = MIN (before->sure[l], rate (&agreement[l]));
  g_free (agreement);
  g_free (back.data);
  g_free (certainty.data);
  return good;
}
