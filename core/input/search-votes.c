/* Places where several lines meet, and tips of heads: each pair of lines that are led on straight, and each head that
 * fits along one, votes for a place; arrows may end where most votes are.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define BARB          2.5   /* length of a line that shows where others meet */
#define VOTE_MOST_LED 6     /* by which lines are led on to where they meet */
#define LEAST_TURN    0.3   /* sine of the angle at which lines meet, at least */
#define CLUSTER       0.8   /* radius of places that are one */
#define LEAST_VOTES   0.6   /* of a place where lines meet */
#define HEAD_STEP     1.4   /* between places on lines led on where tips of heads are looked for */
#define HEAD_COST     0.7   /* of a head that fits */
#define HEAD_VOTES    1.5   /* of one that costs nothing */
#define MOST_MEET     40000 /* places where they meet */

typedef struct { CeldPoint at; double weight, votes; } Meeting;

typedef struct
{
  const CeldArrowSearch *s;
  Meeting               *meeting;
  size_t                 n_meetings, meeting_capacity;
} VoteCount;

static CeldStatus
add_meeting (VoteCount *v, CeldPoint at, double weight)
{
  return v->n_meetings < MOST_MEET ? celd_append (v->meeting, v->n_meetings, v->meeting_capacity,
                                                  ((Meeting) { at, weight, 0 })) : CELD_OK;
}

/* Where two lines meet that are led on. */
static CeldStatus
meet (VoteCount *v, const CeldStrokeArm *p, const CeldStrokeArm *q)
{
  double    w = v->s->width, cross = p->way.x * q->way.y - p->way.y * q->way.x, along[2];
  CeldPoint off = { q->at.x - p->at.x, q->at.y - p->at.y }, at;

  if (fmin (p->length, q->length) < BARB * w || fmax (p->length, q->length) < CELD_ARM_LONG * w ||
      fabs (cross) < LEAST_TURN || (p->line == q->line && p->length < 8 * w) || hypot (off.x, off.y) > 10 * w)
    return CELD_OK;
  along[0] = (off.x * q->way.y - off.y * q->way.x) / cross;
  along[1] = (off.x * p->way.y - off.y * p->way.x) / cross;
  at       = celd_moved (p->at, p->way, along[0]);
  if (fmin (along[0], along[1]) < -CELD_ARM_BEGIN * w || fmax (along[0], along[1]) > VOTE_MOST_LED * w ||
      celd_search_room (v->s, at) < 0.2 * w)
    return CELD_OK;
  return add_meeting (v, at, fabs (cross) * (p->length > 6 * w ? 1 : 0.5) * (q->length > 6 * w ? 1 : 0.5));
}

/* The tips of heads that fit where a line is led on. */
static CeldStatus
find_tips (VoteCount *v, const CeldStrokeArm *arm)
{
  double     w = v->s->width;
  CeldStatus status = CELD_OK;

  for (double d = 0; d < CELD_ARM_LED * w && status == CELD_OK; d += HEAD_STEP * w)
    {
      CeldPoint p = celd_moved (arm->at, arm->way, d);

      if (celd_search_room (v->s, p) <= 0 && d > 2 * w)
        break;
      for (int kind = CELD_OUTLINE_OPEN; kind <= CELD_OUTLINE_FILLED && status == CELD_OK; kind++)
        {
          CeldHeadOutline head[CELD_MOST_HEADS];

          celd_search_heads_fit (v->s, (CeldOutlineKind) kind, p, arm->way, NULL, head);
          if (head[0].cost < HEAD_COST)
            status = add_meeting (v, head[0].tip, HEAD_VOTES * (1 - head[0].cost));
        }
    }
  return status;
}

static double
share (const VoteCount *v, const Meeting *one, const Meeting *other)
{
  return other->weight * fmax (0, 1 - celd_points_apart (one->at, other->at) / (CLUSTER * v->s->width));
}

/* Lists the places where most lines meet, from the most on. */
static CeldStatus
list_places (VoteCount *v, CeldPoint **place, size_t *n)
{
  CeldStatus status = CELD_OK;
  size_t     capacity = 0;

  for (size_t i = 0; i < v->n_meetings; i++)
    for (size_t k = 0; k < v->n_meetings; k++)
      v->meeting[i].votes += share (v, &v->meeting[i], &v->meeting[k]);
  while (status == CELD_OK)
    {
      const Meeting *best = NULL;
      CeldPoint      mean = { 0, 0 }, centre;
      double         sum = 0;

      for (size_t i = 0; i < v->n_meetings; i++)
        if (v->meeting[i].votes >= (best ? best->votes : LEAST_VOTES) && (!best || v->meeting[i].votes > best->votes))
          best = &v->meeting[i];
      if (!best)
        break;
      centre = best->at;
      for (size_t i = 0; i < v->n_meetings; i++)
        {
          double weight = share (v, best, &v->meeting[i]);

          sum    += weight;
          mean.x += weight * v->meeting[i].at.x;
          mean.y += weight * v->meeting[i].at.y;
        }
      status = celd_append (*place, *n, capacity, ((CeldPoint) { mean.x / sum, mean.y / sum }));
      for (size_t i = 0; i < v->n_meetings; i++)
        if (celd_points_apart (v->meeting[i].at, centre) < CLUSTER * v->s->width)
          v->meeting[i].votes = 0;
    }
  return status;
}

CeldStatus
celd_search_votes_count (const CeldArrowSearch *search, const CeldStrokeArm *arm, size_t n_arms, CeldPoint **place,
                         size_t *n)
{
  VoteCount  v = { .s = search };
  CeldStatus status = CELD_OK;

  *place = NULL;
  *n     = 0;
  for (size_t i = 0; i < n_arms; i++)
    for (size_t k = i + 1; k < n_arms && status == CELD_OK; k++)
      status = meet (&v, &arm[i], &arm[k]);
  for (size_t i = 0; i < n_arms && status == CELD_OK && search->style == CELD_ARROW_HEAD; i++)
    if (arm[i].length > 4 * search->width)
      status = find_tips (&v, &arm[i]);
  if (status == CELD_OK)
    status = list_places (&v, place, n);
  celd_free (v.meeting);
  return status;
}
