/* Which regions the ends of a relation name: points, points on ink, colours, separate regions of a colour.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ask-order.h"

static bool
only_problem (const Answer *a, CeldProblemKind kind, size_t relation)
{
  return a->problems.n == 1 && a->problems.item[0].kind == kind && a->problems.item[0].relation == relation &&
         a->order.n_cycles == 0;
}

static void
terms_that_join_nothing (void)
{
  CeldPalette palette = palette_of (6, false);
  Answer      a       = ask (PARTS, &palette, "B>A; -1,0 > A", NULL);

  CHECK (only_problem (&a, CELD_PROBLEM_OUTSIDE, 1) && levels_are (&a, "010000"));
  CHECK (a.problems.item[0].x == 0 && a.problems.item[0].y == 0);
  forget (&a);
  a = ask (PARTS, &palette, "12,0 > 0,2", NULL);
  CHECK (only_problem (&a, CELD_PROBLEM_OUTSIDE, 0) && a.problems.item[0].x == -1);
  forget (&a);
  a = ask (PARTS, &palette, "A > #123456", NULL);
  CHECK (only_problem (&a, CELD_PROBLEM_UNKNOWN_COLOUR, 0) && levels_are (&a, "000000"));
  forget (&a);
  a = ask (PARTS, &palette, "A > #220000", NULL); /* #1e0000 is nearest */
  CHECK (only_problem (&a, CELD_PROBLEM_UNKNOWN_COLOUR, 0) && a.problems.item[0].label == 3);
  forget (&a);
  a = ask (PARTS, &palette, "B>A; #140000 > 3,1", NULL);
  CHECK (only_problem (&a, CELD_PROBLEM_SAME_REGION, 1) && a.problems.item[0].label == 2);
  forget (&a);
  celd_palette_clear (&palette);
}

static void
colours_within_two (void)
{
  CeldPalette palette = palette_of (6, false);
  Answer      a       = ask (PARTS, &palette, "#0a0000 > #160200", NULL); /* #160200 is #140000, 2 off */

  CHECK (a.problems.n == 0 && levels_are (&a, "100000"));
  forget (&a);
  palette.item[2].colour[0] = 11; /* #0b0000 beside #0a0000: the nearest one counts */
  a = ask (PARTS, &palette, "#0b0000 > #0a0000", NULL);
  CHECK (a.problems.n == 0 && levels_are (&a, "001000"));
  forget (&a);
  palette.item[0].colour[3] = 0;
  a = ask (PARTS, &palette, "#0a0000 > #0b0000", NULL); /* a transparent label has no colour */
  CHECK (only_problem (&a, CELD_PROBLEM_SAME_REGION, 0));
  forget (&a);
  celd_palette_clear (&palette);
}

/* Three regions of one colour, told apart by same-colour=separate: a colour names all of them. */
static void
separate_regions_of_a_colour (void)
{
  CeldPalette palette = palette_of (6, false);
  Answer      a;

  memcpy (palette.item[2].colour, palette.item[0].colour, 4);
  memcpy (palette.item[4].colour, palette.item[0].colour, 4);
  a = ask (PARTS, &palette, "#0a0000 > B; C > A; D > E", NULL);
  CHECK (a.problems.n == 0 && levels_are (&a, "102210"));
  forget (&a);
  a = ask (PARTS, &palette, "B = #0a0000; C > A; F > D", NULL); /* equal to one another too */
  CHECK (a.order.n_cycles == 1 && levels_are (&a, "000001"));
  CHECK (cycle_is (&a, 0, 2, (size_t[]) { 1, 0 }));
  forget (&a);
  a = ask (PARTS, &palette, "A > #0a0000", NULL);
  CHECK (only_problem (&a, CELD_PROBLEM_SAME_REGION, 0));
  forget (&a);
  celd_palette_clear (&palette);
}

static void
points_on_ink (void)
{
  static const char *const rows[]  = { "AAAAAAAABBBB", "AAAAAAAABBBB", "AAAAAAAABBBB", "CCCCCCCCCCCC", NULL };
  static const char *const lines[] = { "......##9...", "......##9...", "......##9...", "............", NULL };
  CeldPlane   ink     = art_plane (lines);
  CeldPalette palette = palette_of (3, false);
  Answer      a       = ask (rows, &palette, "7.5,0.5 > 0,0", &ink);              /* A's own ink, B's paper beside it */

  CHECK (a.problems.n == 0 && levels_are (&a, "010"));
  forget (&a);
  a = ask (rows, &palette, "7.5,0.5 > 0,0", NULL);
  CHECK (only_problem (&a, CELD_PROBLEM_SAME_REGION, 0));
  forget (&a);
  a = ask (rows, &palette, "6.5,1 > 11,0", &ink);
  CHECK (a.problems.n == 0 && levels_are (&a, "100"));
  forget (&a);
  celd_palette_clear (&palette);
  free (ink.data);
}

/* Deep inside a black area the pixel's own label counts: it is no stroke. */
static void
points_in_black_areas (void)
{
  static const char *const rows[]  = { "AAAAAAAAAAAAA", "BBBBBBBBBBBBB", "BBBBBBBBBBBBB", "BBBBBBBBBBBBB",
                                       "BBBBBBBBBBBBB", "AAAAAAAAAAAAA", "AAAAAAAAAAAAA", NULL };
  static const char *const lines[] = { ".#.#.#.#.#.#.", "#############", "#############", "#############",
                                       "#############", ".............", ".#.#.#.#.#.#.", NULL };
  CeldPlane   ink     = art_plane (lines);
  CeldPalette palette = palette_of (2, false);
  Answer      a       = ask (rows, &palette, "6,3 > 6,5", &ink);

  CHECK (a.problems.n == 0 && levels_are (&a, "01"));
  forget (&a);
  celd_palette_clear (&palette);
  free (ink.data);
}

/* Only relations marked as cracks count, of colours all their labels, and none that joins nothing. */
static void
cracks_are_pairs_of_labels (void)
{
  static const char *const rows[] = { "AABBCC", "AABBCC", NULL };
  CeldPalette              palette = palette_of (3, false);
  CeldLabels               labels = art_labels (rows);
  CeldRelations            relations = { 0 };
  CeldCracks               cracks = { 0 };

  memcpy (palette.item[2].colour, palette.item[1].colour, 4);
  CHECK (celd_relations_parse ("0,0 > 2,0; 4,1 > 0,1 !crack; 0,0 > #140000 !crack; 0,0 > 1,1 !crack; 9,9 > 0,0 !crack",
                               &relations, NULL) == CELD_OK);
  CHECK (celd_cracks_find (&labels, &palette, &relations, NULL, &cracks) == CELD_OK);
  CHECK (cracks.n == 3);
  CHECK (cracks.n == 3 && cracks.item[0].nearer == 3 && cracks.item[0].farther == 1);
  CHECK (cracks.n == 3 && cracks.item[1].nearer == 1 && cracks.item[1].farther == 2);
  CHECK (cracks.n == 3 && cracks.item[2].nearer == 1 && cracks.item[2].farther == 3);
  labels.width = 0;
  CHECK (celd_cracks_find (&labels, &palette, &relations, NULL, &cracks) == CELD_BAD_SIZE && cracks.n == 3);
  celd_cracks_clear (&cracks);
  celd_relations_clear (&relations);
  celd_palette_clear (&palette);
  free (labels.data);
}

int
main (void)
{
  RUN (terms_that_join_nothing);
  RUN (colours_within_two);
  RUN (separate_regions_of_a_colour);
  RUN (points_on_ink);
  RUN (points_in_black_areas);
  RUN (cracks_are_pairs_of_labels);
  return DONE;
}
