/* Order: hand-made situations with known levels, and contradictions named relation by relation.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ask-order.h"

/* One situation: relations in, levels out, so many contradictions. */
static void
situation (const char *relations, bool background, const char *levels, size_t contradictions)
{
  CeldPalette palette = palette_of (6, background);
  Answer      a       = ask (PARTS, &palette, relations, NULL);

  CHECK (levels_are (&a, levels));
  CHECK (a.order.n_cycles == contradictions && a.problems.n == contradictions);
  for (size_t i = 0; i < a.problems.n && i < a.order.n_cycles; i++)
    CHECK (a.problems.item[i].kind == CELD_PROBLEM_CONTRADICTION && a.problems.item[i].other == i &&
           a.problems.item[i].relation == a.order.cycle[i].item[0] && a.problems.item[i].x >= 0);
  forget (&a);
  celd_palette_clear (&palette);
}

static void
known_levels (void)
{
  situation ("", false, "000000", 0);
  situation ("", true, "111110", 0);
  situation ("A>B>C>D>E>F", true, "543210", 0);
  situation ("F>E>D>C>B>A", false, "012345", 0);
  situation ("A>B>D;A>C>D", false, "211000", 0);         /* diamond */
  situation ("A>B>C>D;A>D", false, "321000", 0);         /* the longest path counts */
  situation ("A>B;A>B;A>B", false, "100000", 0);
  situation ("A>B+2", true, "311110", 0);
  situation ("A=B;B=C;C>D;E=D;F>A", false, "111002", 0); /* classes of equal depth */
  situation ("A=A;B=C;C=B;A>B", false, "100000", 0);
}

static void
background_gives_way (void)
{
  situation ("F>A", true, "022221", 0); /* the others are still in front of it */
  situation ("F>A>B", true, "103332", 0);
  situation ("F=A>B", true, "102221", 0);
  situation ("F=A", true, "011110", 0);
  situation ("A>F;B=F;C>B", true, "101110", 0);
}

static void
contradictions_leave_the_best_order (void)
{
  situation ("A>B;B>C;C>A", false, "210000", 1);
  situation ("A>B@2;B>C;C>A@3", false, "102000", 1);
  situation ("A=B;A>B", false, "000000", 1);
  situation ("A>B;A=B", false, "100000", 1);
  situation ("A>B;B>C;C=A;D>E;E>D", false, "210100", 2);
}

static void
cycles_are_named_in_order (void)
{
  CeldPalette palette = palette_of (6, false);
  Answer      a       = ask (PARTS, &palette, "A>B;D>E;B>C;C>A", NULL);

  CHECK (cycle_is (&a, 0, 3, (size_t[]) { 3, 0, 2 }));
  forget (&a);
  a = ask (PARTS, &palette, "B>C;A=B;C=D;E>F;D>A", NULL); /* D > A = B > C = D: the equalities belong to it */
  CHECK (cycle_is (&a, 0, 4, (size_t[]) { 4, 1, 0, 2 }));
  forget (&a);
  a = ask (PARTS, &palette, "A>B;B=C;D=C;D=A", NULL);     /* an equality across an inequality */
  CHECK (a.order.n_cycles == 1 && a.order.cycle[0].n == 4 && a.order.cycle[0].item[0] == 3);
  forget (&a);
  a = ask (PARTS, &palette, "A>B>C>D>E>F;A>D;F>A", NULL); /* the shortest one: F > A > D > E > F */
  CHECK (cycle_is (&a, 0, 4, (size_t[]) { 6, 5, 3, 4 }));
  forget (&a);
  celd_palette_clear (&palette);
}

static void
lighter_relations_give_way (void)
{
  CeldPalette palette = palette_of (6, false);
  Answer      a       = ask (PARTS, &palette, "A>B@.5;B>C;C>A", NULL);

  CHECK (cycle_is (&a, 0, 3, (size_t[]) { 0, 1, 2 }));
  CHECK (levels_are (&a, "021000"));
  forget (&a);
  celd_palette_clear (&palette);
}

static void
lost_labels_leave_no_hole (void)
{
  static const char *const rows[] = { "AA  CC  EEFF", "AA  CC  EEFF", NULL }; /* B and D have no pixel */
  CeldPalette palette = palette_of (6, false);
  Answer      a       = ask (rows, &palette, "A > #140000 > C > #280000 > E", NULL);

  CHECK (a.problems.n == 0 && levels_are (&a, "211000"));
  forget (&a);
  a = ask (rows, &palette, "A > #140000 > #280000; #280000 > C+3", NULL);
  CHECK (a.order.level[0] > a.order.level[2] && a.order.levels == a.order.level[0] + 1);
  forget (&a);
  a = ask (rows, &palette, "A > #140000", NULL);
  CHECK (levels_are (&a, "000000"));
  forget (&a);
  celd_palette_clear (&palette);
}

static void
bad_input (void)
{
  uint32_t      one[4]   = { 1, 1, 1, 1 };
  CeldLabels    labels   = { 1, 1, 4, one }, none = { 0, 0, 0, one };
  float         paper[2] = { NAN, 1 };
  CeldPlane     ink      = { 2, 1, 2, paper }, nan_ink = { 1, 1, 1, paper };
  CeldRelation  item     = { .nearer = { .x = NAN }, .farther = { .by_colour = true }, .weight = NAN, .gap = NAN };
  CeldRelations r        = { &item, 1 };
  CeldPalette   palette  = palette_of (1, false), empty = { 0 };
  CeldOrder     order    = { 0 };
  CeldProblems  problems = { 0 };

  CHECK (celd_order (&none, &palette, &r, NULL, NULL, NULL, &order, NULL) == CELD_BAD_SIZE);
  CHECK (celd_order (&labels, &palette, &r, &ink, NULL, NULL, &order, NULL) == CELD_BAD_SIZE);
  CHECK (celd_order (&labels, &palette, &r, &nan_ink, NULL, NULL, &order, &problems) == CELD_OK);
  CHECK (order.n == 1 && order.levels == 1 && order.level[0] == 0 && problems.n == 1);
  item.nearer.x = 0;
  item.farther  = (CeldTerm) { .x = 0.5 };
  CHECK (celd_order (&labels, &empty, &r, NULL, NULL, NULL, &order, &problems) == CELD_OK); /* unknown labels */
  CHECK (order.n == 0 && order.levels == 1 && problems.n == 2 && problems.item[1].kind == CELD_PROBLEM_OUTSIDE);
  celd_order_clear (&order);
  celd_problems_clear (&problems);
  celd_palette_clear (&palette);
}

/* Heights of all six labels of a situation with fractional gaps. */
static void
heights (const char *relations, const double wanted[6], uint32_t levels)
{
  CeldPalette  palette = palette_of (6, false);
  CeldSettings s = celd_settings ();
  Answer       a = ask (PARTS, &palette, relations, NULL);
  double       top = 0;

  CHECK (a.order.n_cycles == 0 && a.order.levels == levels);
  s.encoding = CELD_ENCODING_RANK;
  for (size_t k = 0; k < 6; k++)
    {
      NEAR (celd_order_value (&a.order, a.order.level[k], &s), wanted[k], 1e-6);
      top = fmax (top, wanted[k]);
    }
  s.encoding = CELD_ENCODING_NORMALIZED;
  for (size_t k = 0; k < 6; k++)
    NEAR (celd_order_value (&a.order, a.order.level[k], &s), wanted[k] / top, 1e-6);
  forget (&a);
  celd_palette_clear (&palette);
}

static void
fractional_gaps (void)
{
  heights ("A>B+1.5;B>C", (double[]) { 2.5, 1, 0, 0, 0, 0 }, 3);
  heights ("A>B+0.25;C>B", (double[]) { 0.25, 0, 1, 0, 0, 0 }, 3);
  heights ("A>B+0.1;B>C+0.2;D>C+0.3;E=D", (double[]) { 0.3, 0.2, 0, 0.3, 0.3, 0 }, 3); /* but for rounding the same */
  heights ("A>B+0.5;B>C+0.5;A>D+3;D>E", (double[]) { 4, 0.5, 0, 1, 0, 0 }, 4);
  heights ("A>B+2.5;B>C+2.5", (double[]) { 5, 2.5, 0, 0, 0, 0 }, 3);
}

/* A and C of one colour, apart from each other: only that closes the circle. */
static void
one_colour_closes_a_circle (void)
{
  static const char *const rows[] = { "AABBAACCDDDD", "AABBAACCDDDD", NULL };
  CeldPalette palette = palette_of (4, false);
  Answer      a = ask (rows, &palette, "A>B;B>C", NULL);              /* points: C lies in the second part of a */

  CHECK (a.order.n_cycles == 1 && a.order.cycle[0].label == 1 && a.order.cycle[0].colour[0] == 10);
  CHECK (a.order.cycle[0].x[0] + a.order.cycle[0].x[1] == 4);
  forget (&a);
  a = ask (rows, &palette, "#0a0000>B;B>C", NULL);
  CHECK (a.order.n_cycles == 1 && a.order.cycle[0].label == 0); /* a colour means all of its regions */
  forget (&a);
  a = ask (rows, &palette, "A>B;B>D;D>1.5,1.5", NULL);
  CHECK (a.order.n_cycles == 1 && a.order.cycle[0].label == 0);
  forget (&a);
  a = ask (rows, &palette, "A>B;C=D;D<B", NULL);
  CHECK (a.order.n_cycles == 1 && a.order.cycle[0].label == 1);
  forget (&a);
  celd_palette_clear (&palette);
}

static void
encodings (void)
{
  CeldSettings s = celd_settings ();

  NEAR (celd_encode_level (0, 1, &s), 0, 0);
  NEAR (celd_encode_level (1, 5, &s), 0.25, 0);
  NEAR (celd_encode_level (4, 5, &s), 1, 0);
  s.encoding = CELD_ENCODING_RANK;
  NEAR (celd_encode_level (3, 5, &s), 3, 0);
  s.encoding   = CELD_ENCODING_FIXED;
  s.far_level  = -2;
  s.near_level = 8;
  NEAR (celd_encode_level (3, 5, &s), 0.5, 1e-6);
  NEAR (celd_encode_level (3, 50, &s), 0.5, 1e-6); /* a new arrow does not rescale */
}

int
main (void)
{
  RUN (known_levels);
  RUN (background_gives_way);
  RUN (contradictions_leave_the_best_order);
  RUN (cycles_are_named_in_order);
  RUN (lighter_relations_give_way);
  RUN (lost_labels_leave_no_hole);
  RUN (bad_input);
  RUN (fractional_gaps);
  RUN (one_colour_closes_a_circle);
  RUN (encodings);
  return DONE;
}
