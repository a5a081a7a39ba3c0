/* Where traced lines have round ends or corners: arrows that share ends may begin or end there.
 *
 * The paint is round at ends of lines, be they short behind a line that they cross, and at sharp corners.  Along lines,
 * and in the corners of filled heads, its edge is near on two sides that are apart.  Of arrows that fade or taper only
 * corners with long sides are taken: with more places no more of them were read (measured).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define TURN_APART    0.9  /* from a round end to where another one may be */
#define ROUND_WAYS    16   /* directions from a point to the edge of the paint: at a round end ... */
#define ROUND_LEAST   7    /* ... so many side by side, at least, ... */
#define ROUND_MOST    1.45 /* ... are no longer than the shortest one by this factor, ... */
#define ROUND_ROOM    0.25 /* ... which is so long, at least */
#define PLACE_CORNER  0.45 /* radians by which a line turns at a corner, ... */
#define CORNER_SIDE   2.5  /* ... over so long sides, or more over shorter ones, ... */
#define CORNER_LEAST  1.2  /* ... of which each is so long */

typedef struct { CeldPoint *at; size_t n, capacity; } PointList;

static CeldStatus
append (PointList *list, CeldPoint p)
{
  return celd_append (list->at, list->n, list->capacity, p);
}

/* ------------------------------------------------------------------ round ends */

/* In how many directions side by side the paint ends about as near to a point as it does in any. */
static int
round_part (const CeldArrowSearch *s, CeldPoint p)
{
  double reach = ROUND_MOST * (celd_search_room (s, p) + 0.5);
  int    most = 0, run = 0;

  for (int k = 0; k < 2 * ROUND_WAYS && run < ROUND_WAYS; k++)
    {
      double    angle = 2 * CELD_PI * k / ROUND_WAYS;
      CeldPoint way = { cos (angle), sin (angle) };

      run  = celd_search_room (s, celd_moved (p, way, reach)) <= 0 ? run + 1 : 0;
      most = run > most ? run : most;
    }
  return most;
}

static CeldStatus
list_round (const CeldArrowSearch *s, const CeldStrokeLine *line, PointList *list)
{
  double     w = s->width;
  size_t     best = 0;
  int        most = 0;
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < line->n && status == CELD_OK; i++)
    {
      int part = celd_search_room (s, line->at[i]) < ROUND_ROOM * w ? 0 : round_part (s, line->at[i]);

      if (part >= ROUND_LEAST && part > most)
        {
          most = part;
          best = i;
        }
      if (most && ((double) (i - best) > TURN_APART * w || i + 1 == line->n))
        {
          status = append (list, line->at[best]);
          most   = 0;
        }
    }
  return status;
}

/* ------------------------------------------------------------------ corners */

static double
turn_at (const CeldStrokeLine *line, size_t i, size_t reach)
{
  CeldPoint a = line->at[i - reach], p = line->at[i], c = line->at[i + reach];
  CeldPoint u = { p.x - a.x, p.y - a.y }, v = { c.x - p.x, c.y - p.y };

  return fabs (atan2 (u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y));
}

/* Where the sides of a corner meet. */
static CeldPoint
corner_of (const CeldArrowSearch *s, const CeldStrokeLine *line, size_t i, size_t reach)
{
  CeldLineSums sums = { 0 };
  CeldPoint    place;

  for (int side = 0; side < 2; side++)
    {
      CeldPoint from = line->at[side ? i + reach : i - reach], to = line->at[side ? i + reach / 4 : i - reach / 4];
      double    d = celd_points_apart (from, to);

      if (d > 0)
        celd_line_sums_add (&sums, from, (CeldPoint) { (to.x - from.x) / d, (to.y - from.y) / d }, 1);
    }
  place = celd_line_sums_point (&sums, line->at[i]);
  return celd_points_apart (place, line->at[i]) > 1.5 * s->width ? line->at[i] : place;
}

/* The length of the sides of a corner at a point, in pixels: the usual one, or less where the line ends before. */
static size_t
reach_at (const CeldStrokeLine *line, size_t i, size_t usual)
{
  size_t end = i < line->n - 1 - i ? i : line->n - 1 - i;

  return end < usual ? end : usual;
}

static CeldStatus
list_corners (const CeldArrowSearch *s, const CeldStrokeLine *line, PointList *list)
{
  size_t     usual = (size_t) (CORNER_SIDE * s->width + 2), best = 0;
  size_t     least = celd_search_has_profiles (s) ? usual : (size_t) (CORNER_LEAST * s->width + 2);
  double     most = PLACE_CORNER;
  CeldStatus status = CELD_OK;

  for (size_t i = least; i + least < line->n && status == CELD_OK; i++)
    {
      size_t reach = reach_at (line, i, usual);
      double turn = turn_at (line, i, reach);

      if (turn > most && turn * (double) reach > PLACE_CORNER * (double) usual)
        {
          most = turn;
          best = i;
        }
      if (best && (i > best + usual || i + least + 1 == line->n))
        {
          status = append (list, corner_of (s, line, best, reach_at (line, best, usual)));
          most   = PLACE_CORNER;
          best   = 0;
          i     += usual / 2;
        }
    }
  return status;
}

/* ------------------------------------------------------------------ both */

CeldStatus
celd_search_turns_list (const CeldArrowSearch *search, const CeldStrokeLine *line, CeldTurnKind kind, CeldPoint **place,
                        size_t *n)
{
  PointList  list = { 0 };
  CeldStatus status = kind == CELD_TURN_ROUND ? list_round (search, line, &list) : list_corners (search, line, &list);

  *place = list.at;
  *n     = list.n;
  return status;
}
