/* Relations painted as arrows are read back as what they were.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

#define W 160
#define H 140

static uint8_t pixels[4 * W * H];

static CeldPaint
blank (void)
{
  memset (pixels, 0, sizeof pixels);
  return (CeldPaint) { W, H, W, pixels };
}

static CeldRelation
arrow (double x0, double y0, double x1, double y1, double weight)
{
  return (CeldRelation) {
    .nearer = { .x = x0, .y = y0 }, .farther = { .x = x1, .y = y1 }, .weight = weight, .gap = 1
  };
}

static double
between (const CeldTerm *end, double x, double y)
{
  return hypot (end->x - x, end->y - y);
}

static CeldRelations
read_back (const CeldPaint *paint, size_t *unclear)
{
  CeldRelations relations = { 0 };
  CeldProblems  problems = { 0 };

  CHECK (celd_arrows_read (paint, CELD_ARROW_HEAD, NULL, &relations, &problems) == CELD_OK);
  *unclear = problems.n;
  celd_problems_clear (&problems);
  return relations;
}

/* In every direction, from as long as can be seen; both ends within the width of the line. */
static void
every_direction (void)
{
  for (int k = 0; k < 72; k++)
    for (double length = 16; length < 120; length *= 1.7)
      for (double width = 2; width < 9; width += 3)
        {
          double        u = cos (k * 0.0873), v = sin (k * 0.0873);
          CeldRelation  item = arrow (80 - u * length / 2, 70 - v * length / 2, 80 + u * length / 2,
                                      70 + v * length / 2, 0.7);
          CeldRelations one = { &item, 1 }, back;
          CeldPaint     paint = blank ();
          size_t        unclear;

          CHECK (celd_relations_paint (&one, width, &paint) == CELD_OK);
          back = read_back (&paint, &unclear);
          CHECK (back.n == 1 && unclear == 0);
          if (back.n == 1)
            {
              CHECK (between (&back.item[0].nearer, item.nearer.x, item.nearer.y) < width + 3);
              CHECK (between (&back.item[0].farther, item.farther.x, item.farther.y) < width + 3);
            }
          celd_relations_clear (&back);
        }
}

/* Of two that touch the heavier is painted, whatever their order. */
static void
crossing (void)
{
  for (int k = 0; k < 2; k++)
    {
      CeldRelation  item[] = { arrow (20, 70, 140, 70, k ? 0.9 : 0.3), arrow (80, 20, 80, 120, k ? 0.3 : 0.9),
                               arrow (20, 20, 50, 30, 0.1) };
      CeldRelations all = { item, 3 }, back;
      CeldPaint     paint = blank ();
      size_t        unclear;

      CHECK (celd_relations_paint (&all, 4, &paint) == CELD_OK);
      back = read_back (&paint, &unclear);
      CHECK (back.n == 2 && unclear == 0);
      CHECK (back.n == 2 && fmin (between (&back.item[0].nearer, k ? 20 : 80, k ? 70 : 20),
                                  between (&back.item[1].nearer, k ? 20 : 80, k ? 70 : 20)) < 4);
      celd_relations_clear (&back);
    }
}

static void
no_arrows (void)
{
  CeldRelation  item[] = { arrow (20, 70, 140, 70, 1), arrow (20, 70, 140, 70, 1), arrow (9, 9, 9, 9, 1),
                           arrow (NAN, 9, 9, 9, 1), arrow (1e300, 9, 9, 9, 1) };
  CeldRelations all = { item, 5 }, none = { 0 };
  CeldPaint     paint = blank ();
  int           painted = 0;

  item[0].equal = true;
  item[1].farther.by_colour = true;
  CHECK (celd_relations_paint (&all, 4, &paint) == CELD_OK);
  CHECK (celd_relations_paint (&none, 4, &paint) == CELD_OK);
  for (int p = 0; p < 4 * W * H; p++)
    painted += pixels[p];
  CHECK (painted == 0);
}

int
main (void)
{
  RUN (every_direction);
  RUN (crossing);
  RUN (no_arrows);
  return DONE;
}
