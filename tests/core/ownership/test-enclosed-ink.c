/* Pieces of ink without paper of their owner, drawn as letters: which of them go to the label round them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "base/base.h"
#include "ownership/ownership.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

#define MOST 12

/* Rows of letters, each a label: capitals are paper. */
static void
joins (const char *const *before, const char *const *after)
{
  static uint32_t label[MOST * MOST];
  static float    excess_at[MOST * MOST];
  CeldReassigned  reassigned = { 0 };
  CeldLabels      owner = { (int) strlen (before[0]), 0, MOST, label };
  CeldPlane       excess = { 0 };
  size_t          changed = 0;

  while (before[owner.height])
    owner.height++;
  excess = (CeldPlane) { owner.width, owner.height, MOST, excess_at };
  for (int y = 0; y < owner.height; y++)
    for (int x = 0; x < owner.width; x++)
      {
        CELD_AT (&owner, x, y) = (uint32_t) toupper (before[y][x]);
        CELD_AT (&excess, x, y) = isupper (before[y][x]) ? -INFINITY : x % 2 ? INFINITY : -0.5f;
        changed += toupper (before[y][x]) != toupper (after[y][x]);
      }
  CHECK (celd_enclosed_ink_join (&excess, &owner, &reassigned) == CELD_OK);
  CHECK (reassigned.n == changed);
  for (int y = 0; y < owner.height; y++)
    for (int x = 0; x < owner.width; x++)
      CHECK (CELD_AT (&owner, x, y) == (uint32_t) toupper (after[y][x]));
  for (size_t i = reassigned.n; i-- > 0;)
    CELD_AT (&owner, reassigned.item[i].pixel % owner.width, reassigned.item[i].pixel / owner.width) =
      reassigned.item[i].owner;
  for (int y = 0; y < owner.height; y++)
    for (int x = 0; x < owner.width; x++)
      CHECK (CELD_AT (&owner, x, y) == (uint32_t) toupper (before[y][x]));
  celd_reassigned_clear (&reassigned);
}

/* The end of a line that sticks out of A into B. */
static void
free_ends_go_to_what_is_round_them (void)
{
  joins ((const char *[]) { "BBBBBBBB", "AabbbbaB", "AabbbbaB", "BBBBBBBB", NULL },
         (const char *[]) { "BBBBBBBB", "AabbbbbB", "AabbbbbB", "BBBBBBBB", NULL });
  joins ((const char *[]) { "BBaa", "BBBa", NULL }, (const char *[]) { "BBbb", "BBBb", NULL }); /* at the frame */
}

static void
ink_at_its_paper_stays (void)
{
  static const char *const straight[] = { "BBBBBB", "AaaaaB", "BBBBBB", NULL };
  static const char *const diagonal[] = { "BBBBBB", "ABaaaB", "BaBBBB", NULL };

  joins (straight, straight);
  joins (diagonal, diagonal);
}

/* An outline without paper may be a part by itself; what is within it goes to it. */
static void
ink_beside_two_labels_stays (void)
{
  static const char *const between[] = { "BBBBB", "BaaaB", "CCCCC", NULL };
  static const char *const nested[] = { "CCCCCCC", "CbbbbbC", "CbbabbC", "CbbbbbC", "CCCCCCC", NULL };

  joins (between, between);
  joins (nested, (const char *[]) { "CCCCCCC", "CbbbbbC", "CbbbbbC", "CbbbbbC", "CCCCCCC", NULL });
}

static void
a_picture_of_ink_stays (void)
{
  static const char *const all[] = { "aaa", "aaa", NULL }, *const one[] = { "a", NULL };

  joins (all, all);
  joins (one, one);
}

int
main (void)
{
  RUN (free_ends_go_to_what_is_round_them);
  RUN (ink_at_its_paper_stays);
  RUN (ink_beside_two_labels_stays);
  RUN (a_picture_of_ink_stays);
  return DONE;
}
