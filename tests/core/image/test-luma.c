/* Luma of encoded colours.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

static void
weights_of_rec_709 (void)
{
  const float rgba[5][4] = {
    { 1, 0, 0, 1 }, { 0, 1, 0, 0.5f }, { 0, 0, 1, 0 }, { 1, 1, 1, 1 }, { 0.5f, 0.5f, 0.5f, 1 }
  };
  float       luma[6] = { 0 }, alpha[6] = { 0 }, alone[5];

  luma[5] = alpha[5] = -1;
  celd_luma (rgba[0], 5, luma, alpha);
  NEAR (luma[0], 0.2126, 1e-6);
  NEAR (luma[1], 0.7152, 1e-6);
  NEAR (luma[2], 0.0722, 1e-6);
  NEAR (luma[3], 1, 1e-6);
  NEAR (luma[4], 0.5, 1e-6); /* of encoded values: grey stays as it is */
  CHECK (alpha[0] == 1 && alpha[1] == 0.5f && alpha[2] == 0);
  CHECK (luma[5] == -1 && alpha[5] == -1); /* n pixels and no more */
  celd_luma (rgba[0], 5, alone, NULL);
  CHECK (!memcmp (alone, luma, sizeof alone));
}

int
main (void)
{
  RUN (weights_of_rec_709);
  return DONE;
}
