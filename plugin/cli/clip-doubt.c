/* Which regions of a frame may be wrong: those that do not come back.  A region that is wrong once stays so up to the
 * next key.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "propagate.h"

bool
cli_frame_doubt (const CliMotion *motion, const CeldHost *host, const CliFrameState *before, CliFrameState *next)
{
  size_t     n = motion->palette.n;
  CeldLabels back = { 0 };
  CeldPlane  certainty = { 0 };
  bool       good = cli_labels_new (motion->width, motion->height, &back) &&
                    cli_plane_new (motion->width, motion->height, &certainty) &&
                    cli_check (celd_propagate (&next->ink, &next->labels, motion->order.level, motion->background,
                                               &before->ink, host, &back, &certainty));

  next->sure = g_new0 (double, n + 1);
  good = good && cli_check (celd_rate_returned (&before->labels, &next->labels, &back, n, next->sure));
  for (size_t l = 1; l <= n && good; l++)
    next->sure[l] = MIN (before->sure[l], next->sure[l]);
  g_free (back.data);
  g_free (certainty.data);
  return good;
}
