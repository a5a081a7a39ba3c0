/* Heads and dots where lines of paint meet.
 *
 * The paint of the lines is explained.  A barb of a head is a straight piece of other paint that leaves the tip at an
 * angle to the line, with nothing on its outer side; the edge of a filled head looks alike.  Both barbs are looked for
 * at places round the one where the lines meet.  A dot is a place where the paint is wider than lines that meet.
 *
 * Cost: some hundred thousand samples for each end of a line.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/joined-arrows.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define BARB_NEAR   0.5  /* from the tip to where a barb begins, ... */
#define BARB_FAR    3    /* ... to where it may end */
#define LEAST_BARB  0.3  /* radians between the line and a barb, ... */
#define MOST_BARB   0.95
#define BARB_STEP   0.1  /* ... that are tried */
#define BESIDE      1.1  /* from a barb to what must be bare on its outer side */
#define LEAST_SEEN  0.35 /* part of a barb that belongs to no line */
#define OWN_ANGLE   0.55 /* radians up to which the line itself may hide a barb */
#define HALF_SEEN   0.5  /* score of a barb, if others might be hidden */
#define ONE_SIDE    0.7  /* weight of a head of which one barb is to be seen */
#define BETTER_SIDE 0.3  /* weight of the better barb beside that of the other */
#define HEAD_FROM   0.6  /* score of a head, ... */
#define BARE_TO     0.3  /* ... and of an end without one */
#define TIP_ALONG   2    /* how far the tip is looked for along the line, ... */
#define TIP_ASIDE   1.5  /* ... and beside it, ... */
#define TIP_STEP    0.5
#define TIP_OFF     0.05 /* ... and what the square of that distance costs */
#define AS_GOOD     0.05 /* scores below the best that are as good */
#define DOT_LEAST   0.95 /* radius of a dot */
#define NO_DOT      0.8  /* radius of the paint where there is none */
#define DOT_FREE    3    /* from a free end to the middle of its dot, at most, ... */
#define DOT_HUB     1.5  /* ... and from where lines meet */
#define DOT_HIDDEN  2    /* from an end without a dot to where paint of other colours may hide one */
#define MOST_HIDDEN 0.5  /* part of a dot; of one of which more is hidden, ... */
#define LEAST_RING  1.0  /* ... so many square widths beside its line are seen */

double
celd_joined_hidden_share (const CeldJoinedLines *s, CeldPoint c, double r)
{
  double hidden = 0, n = 0;

  if (!s->hidden)
    return 0;
  for (double y = c.y - r; y <= c.y + r; y++)
    for (double x = c.x - r; x <= c.x + r; x++)
      if (hypot (x - c.x, y - c.y) <= r)
        {
          CeldPoint p = { x, y };

          hidden += celd_joined_inside (s, p) && s->hidden[celd_joined_pixel (s, p)];
          n++;
        }
  return hidden / n;
}

/* ------------------------------------------------------------------ heads */

/* How well a barb agrees with the paint: the painted part of it, less the painted part of what is beside it on its
 * outer side.  -1 if most of it is explained. */
static double
barb_score (const CeldJoinedLines *s, CeldPoint tip, CeldPoint d, double outer)
{
  double w = s->graph.width, on = 0, n_on = 0, off = 0, n_off = 0, all = 0;

  for (double r = BARB_NEAR * w; r <= BARB_FAR * w; r += 0.5, all++)
    {
      CeldPoint p = celd_moved (tip, d, r);
      int       at = celd_joined_paint_at (s, p);
      CeldPoint outside = { p.x - outer * BESIDE * w * d.y, p.y + outer * BESIDE * w * d.x };
      int       beside = celd_joined_paint_at (s, outside);

      on    += at > 0;
      n_on  += at >= 0;
      off   += beside > 0;
      n_off += beside >= 0;
    }
  return n_on < LEAST_SEEN * all ? -1 : fmax (0, on / n_on - (n_off > 0 ? off / n_off : 0));
}

/* A direction turned by an angle. */
static CeldPoint
turned (CeldPoint d, double angle)
{
  return (CeldPoint) { d.x * cos (angle) - d.y * sin (angle), d.x * sin (angle) + d.y * cos (angle) };
}

void
celd_joined_find_barbs (const CeldJoinedLines *s, CeldJoinedEnd *e)
{
  double least, most;

  for (int side = 0; side < 2; side++)
    {
      bool hidden = false;

      e->barb_score[side] = -1;
      for (double angle = LEAST_BARB; angle <= MOST_BARB; angle += BARB_STEP)
        {
          CeldPoint d = turned (e->way, side ? angle : -angle);
          double    score = barb_score (s, e->tip, d, side ? 1 : -1);

          hidden |= score < 0 && angle > OWN_ANGLE;
          if (score > e->barb_score[side])
            {
              e->barb_score[side] = score;
              e->barb[side] = d;
            }
        }
      if (hidden && e->barb_score[side] < HALF_SEEN)
        e->barb_score[side] = -1; /* the barb may be where other paint lies */
    }
  least    = fmin (e->barb_score[0], e->barb_score[1]);
  most     = fmax (e->barb_score[0], e->barb_score[1]);
  e->score = least < 0 ? ONE_SIDE * most : least + BETTER_SIDE * most;
}

/* The head that agrees best with the paint near an end.  Its tip is the middle of the places that are as good. */
static void
find_head (const CeldJoinedLines *s, CeldJoinedEnd *e)
{
  double        w = s->graph.width, best = -1, n = 0;
  CeldPoint     start = e->tip, sum = { 0, 0 };
  CeldJoinedEnd found = *e;

  for (int round = 0; round < 2; round++)
    for (double along = -TIP_ALONG; along <= TIP_ALONG; along += TIP_STEP)
      for (double aside = -TIP_ASIDE; aside <= TIP_ASIDE; aside += TIP_STEP)
        {
          CeldJoinedEnd one = *e;

          one.tip = celd_moved (celd_moved (start, e->way, along * w), turned (e->way, CELD_PI / 2), aside * w);
          celd_joined_find_barbs (s, &one);
          one.score -= TIP_OFF * (along * along + aside * aside);
          if (!round && one.score > best)
            {
              best  = one.score;
              found = one;
            }
          if (round && one.score >= best - AS_GOOD)
            {
              sum = celd_moved (sum, one.tip, 1);
              n++;
            }
        }
  *e      = found;
  e->mark = best > HEAD_FROM ? CELD_END_MARKED : best >= 0 && best < BARE_TO ? CELD_END_BARE
            : best < 0 && s->hidden ? CELD_END_HIDDEN : CELD_END_UNKNOWN;
  e->tip  = e->mark == CELD_END_MARKED ? (CeldPoint) { sum.x / n, sum.y / n } : start;
}

/* Sum of the scores of n heads with their tips at one place, less what its distance from `start` costs. */
static double
score_together (const CeldJoinedLines *s, const size_t *head, size_t n, CeldPoint start, double x, double y)
{
  double sum = -TIP_OFF * (x * x + y * y);

  for (size_t i = 0; i < n; i++)
    {
      CeldJoinedEnd one = s->end[head[i]];

      one.tip = (CeldPoint) { start.x + x * s->graph.width, start.y + y * s->graph.width };
      celd_joined_find_barbs (s, &one);
      sum += one.score;
    }
  return sum;
}

CeldPoint
celd_joined_common_tip (const CeldJoinedLines *s, const size_t *head, size_t n, CeldPoint start)
{
  double best = -INFINITY, sum_x = 0, sum_y = 0, found = 0, w = s->graph.width;

  for (int round = 0; round < 2; round++)
    for (double x = -TIP_ALONG; x <= TIP_ALONG; x += TIP_STEP)
      for (double y = -TIP_ALONG; y <= TIP_ALONG; y += TIP_STEP)
        {
          double score = score_together (s, head, n, start, x, y);

          if (!round)
            best = fmax (best, score);
          else if (score >= best - AS_GOOD)
            {
              sum_x += x;
              sum_y += y;
              found++;
            }
        }
  return (CeldPoint) { start.x + w * sum_x / found, start.y + w * sum_y / found };
}

/* ------------------------------------------------------------------ dots */

/* Looks for the widest place of the paint near an end: a dot has its middle there. */
static void
find_dot (const CeldJoinedLines *s, CeldJoinedEnd *e, double reach)
{
  CeldPoint middle = e->tip;
  double    most = 0, w = s->graph.width;

  for (double y = e->tip.y - reach; y <= e->tip.y + reach; y++)
    for (double x = e->tip.x - reach; x <= e->tip.x + reach; x++)
      {
        CeldPoint p = { x, y };
        double    r = celd_joined_inside (s, p) ? sqrt (s->mask.squared[celd_joined_pixel (s, p)]) - 0.5 : 0;

        if (r > most && hypot (x - e->tip.x, y - e->tip.y) <= reach)
          {
            most   = r;
            middle = p;
          }
      }
  e->mark = most >= DOT_LEAST * w ? CELD_END_MARKED : most < NO_DOT * w ? CELD_END_BARE : CELD_END_UNKNOWN;
  if (e->mark == CELD_END_MARKED ? celd_joined_hidden_share (s, middle, most) > MOST_HIDDEN
                                 : celd_joined_hidden_share (s, e->tip, DOT_HIDDEN * w) > 0)
    e->mark = celd_joined_rest (s, e->tip, DOT_FREE) >= LEAST_RING ? CELD_END_MARKED : CELD_END_HIDDEN;
  if (e->mark == CELD_END_MARKED)
    e->tip = middle;
}

void
celd_joined_find_mark (const CeldJoinedLines *s, CeldJoinedEnd *e, bool is_free)
{
  if (s->style == CELD_ARROW_DOT)
    find_dot (s, e, (is_free ? DOT_FREE : DOT_HUB) * s->graph.width);
  else
    find_head (s, e);
}
