/* Which way each of several lines that meet fades or tapers, and their arrows.
 *
 * The values of a line, opacity or width, give its direction (line-profiles.c); a line in which two arrows meet is
 * divided there.  An arrow is a chain of lines that pass nodes (joined-passes.c), if its ends are in no doubt and have
 * a place (joined-places.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>
#include <stdlib.h>

/* All chosen; values are parts of the largest one of the connected paint. */
#define SIGNAL     0.25 /* by which values fall along an arrow, as a part of its strong end, at least */
#define MOST_TIP   0.4  /* of a tip, if other colours hide some of the paint: a stronger one may go on below them */
#define LIKE_MOST  0.95 /* part of the values of connected paint that are not larger than `most` */
#define ROUGH_TIP  1.5  /* widths of a line with a free end that is a rough edge, at most */
#define MOST_PARTS 100  /* that are divided; more are a drawing, or hatching */

static int
compare (const void *a, const void *b)
{
  const double *x = a, *y = b;

  return (*x > *y) - (*x < *y);
}

/* The largest value, but for few. */
static CeldStatus
find_most (CeldProfileReading *r)
{
  const CeldStrokeGraph *g = &r->lines->graph;
  size_t                 n = 0, all = 0;
  double                *value;

  for (size_t k = 0; k < g->n_lines; k++)
    all += g->line[k].n;
  value = celd_alloc (all, sizeof *value);
  if (!value)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < g->n_lines; k++)
    for (size_t i = 0; i < g->line[k].n; i++)
      {
        double x = celd_line_value (r->lines, r->layer, k, i);

        if (!isnan (x))
          value[n++] = x;
      }
  qsort (value, n, sizeof *value, compare);
  r->most = n ? fmax (1, value[(size_t) (LIKE_MOST * (double) (n - 1))]) : 1;
  celd_free (value);
  return CELD_OK;
}

/* Removes lines that lead on from where two or more meet to a free end, and are too short for an arrow. */
static void
remove_tips (CeldJoinedLines *s)
{
  CeldStrokeGraph *g = &s->graph;

  for (size_t k = g->n_lines; k-- > 0;)
    {
      size_t free_end = 2 * k + !celd_joined_is_free (s, 2 * k), end = free_end ^ 1;
      double length = celd_stroke_line_length (&g->line[k]) / g->width;
      bool   shared = celd_joined_part_from (s, end);

      if (!celd_joined_is_free (s, free_end) || celd_joined_lines_at (s, end) < 3 ||
          length > (shared ? CELD_LEAST_LINE : ROUGH_TIP))
        continue;
      if (shared)
        {
          g->node[celd_joined_node (s, end)].at  = g->node[celd_joined_node (s, free_end)].at;
          g->node[celd_joined_node (s, end)].tip = true;
        }
      celd_free (g->line[k].at);
      g->line[k] = g->line[--g->n_lines];
    }
}

/* Divides lines where two arrows meet. */
static CeldStatus
divide_at_turns (CeldProfileReading *r)
{
  CeldStrokeGraph *g = &r->lines->graph;
  CeldStatus       status = CELD_OK;

  for (size_t k = 0; k < g->n_lines && g->n_lines < MOST_PARTS && status == CELD_OK; k++)
    {
      CeldLineProfile p;

      status = celd_line_profile_find (r->lines, r->layer, k, r->most, &p);
      for (size_t i = p.n_turns; i-- > 0 && status == CELD_OK;)
        {
          status = celd_stroke_graph_divide (g, k, p.turn[i].at);
          g->node[g->n_nodes - 1].vague = p.turn[i].vague;
        }
    }
  return status;
}

/* ------------------------------------------------------------------ arrows */

/* The end at the other end of the lines that an end passes to. */
static size_t
far_end (const CeldProfileReading *r, size_t end)
{
  for (end ^= 1; r->next[end] != CELD_NO_END; end = r->next[end] ^ 1)
    ;
  return end;
}

/* Are all lines from an end on of one clear arrow?  *direction: 1 if it is its nearer end, -1 if it is its farther one,
 * 0 if that is not known. */
static bool
is_one_arrow (const CeldProfileReading *r, size_t end, int *direction)
{
  bool            clear = r->profile[end / 2].known;
  double          value = celd_value_at (r, end);
  CeldPaintColour colour = r->profile[end / 2].colour[end % 2];

  for (*direction = 0;; end = r->next[end])
    {
      const CeldLineProfile *p = &r->profile[end / 2];
      int                    here = celd_is_tail (r, end) ? 1 : celd_is_tip (r, end) ? -1 : 0;

      clear &= r->alone[end / 2] && !(here && *direction == -here);
      *direction = here ? here : *direction;
      if (p->known)
        {
          clear &= fabs (value - celd_value_at (r, end)) <= CELD_SAME_VALUE;
          value = celd_value_at (r, end ^ 1);
        }
      for (size_t i = 0; i < 2; i++)
        if (celd_paint_colour_known (p->colour[i ^ (end % 2)]))
          {
            clear &= !celd_paint_colour_known (colour) || celd_same_paint (r->layer, colour, p->colour[i ^ (end % 2)]);
            colour = p->colour[i ^ (end % 2)];
          }
      end ^= 1;
      if (r->next[end] == CELD_NO_END)
        return clear && p->known;
      clear &= !r->doubt[end] && !r->doubt[r->next[end]];
    }
}

/* Why lines from an end on are no clear arrow, of which one is not. */
static CeldArrowReason
why_not_one (const CeldProfileReading *r, size_t end)
{
  for (;; end = r->next[end])
    {
      if (celd_joined_runs_along_frame (r->lines, end / 2))
        return CELD_REASON_FRAME;
      if (!r->alone[end / 2])
        return CELD_REASON_MEETING;
      if (!r->profile[end / 2].seen)
        return r->lines->hidden ? CELD_REASON_HIDDEN : CELD_REASON_SHORT;
      end ^= 1;
      if (r->next[end] == CELD_NO_END)
        return CELD_REASON_UNEVEN;
      if (r->doubt[end] || r->doubt[r->next[end]])
        return CELD_REASON_MEETING;
    }
}

/* Does nothing show where the arrow of an end ends? */
static bool
is_doubtful (const CeldProfileReading *r, size_t end)
{
  return r->doubt[end] || celd_joined_meets_doubt (r, end);
}

/* Finds the place of an end, or why it is not clear. */
static CeldArrowReason
find_place (const CeldProfileReading *r, size_t end, CeldPoint *place)
{
  if (celd_joined_place (r->lines, end, place))
    return CELD_REASON_NONE;
  return celd_joined_is_free (r->lines, end) && celd_joined_is_at_frame (r->lines, *place) ? CELD_REASON_FRAME
                                                                                            : CELD_REASON_MEETING;
}

/* Finds the ends of the arrow whose lines begin at an end, or why it has none. */
static CeldArrowReason
find_ends (const CeldProfileReading *r, size_t end, CeldPoint *nearer, CeldPoint *farther)
{
  int             direction;
  bool            clear = is_one_arrow (r, end, &direction);
  size_t          far = far_end (r, end), tail = direction > 0 ? end : far, tip = direction > 0 ? far : end;
  CeldArrowReason reason;

  if (!clear)
    return why_not_one (r, end);
  if (!direction)
    return CELD_REASON_ALIKE;
  if (is_doubtful (r, tail) || is_doubtful (r, tip))
    return CELD_REASON_MEETING;
  if (celd_value_at (r, tip) > (1 - SIGNAL) * celd_value_at (r, tail))
    return CELD_REASON_ALIKE;
  if (r->lines->hidden && celd_value_at (r, tip) > MOST_TIP)
    return CELD_REASON_HIDDEN;
  reason = find_place (r, tail, nearer);
  return reason ? reason : find_place (r, tip, farther);
}

/* Each chain of lines that is none of a ring has two ends: its arrow is that of the line of the first one. */
static void
find_arrows (const CeldProfileReading *r, CeldLineArrow *arrows)
{
  for (size_t k = 0; k < r->lines->graph.n_lines; k++)
    arrows[k] = (CeldLineArrow) { .unclear = CELD_REASON_MEETING, .first = k };
  for (size_t i = 0; i < 2 * r->lines->graph.n_lines; i++)
    if (r->next[i] == CELD_NO_END && far_end (r, i) > i)
      {
        for (size_t k = i ^ 1; r->next[k] != CELD_NO_END; k = r->next[k] ^ 1)
          arrows[r->next[k] / 2].first = i / 2;
        arrows[i / 2].unclear = find_ends (r, i, &arrows[i / 2].nearer, &arrows[i / 2].farther);
      }
}

static CeldStatus
reading_new (CeldProfileReading *r)
{
  size_t     n = r->lines->graph.n_lines;
  CeldStatus status;

  r->profile = celd_alloc (n, sizeof *r->profile);
  r->alone   = celd_alloc (n, sizeof *r->alone);
  r->next    = celd_alloc (2 * n, sizeof *r->next);
  r->doubt   = celd_alloc0 (2 * n, sizeof *r->doubt);
  status     = r->profile && r->alone && r->next && r->doubt ? CELD_OK : CELD_NO_MEMORY;
  celd_joined_explain_wide_lines (r->lines);
  for (size_t k = 0; k < n && status == CELD_OK; k++)
    {
      r->alone[k] = celd_joined_is_alone (r->lines, k, 0) && !celd_joined_runs_along_frame (r->lines, k);
      status      = celd_line_profile_find (r->lines, r->layer, k, r->most, &r->profile[k]);
    }
  return status;
}

CeldStatus
celd_joined_profiles_read (CeldJoinedLines *lines, const CeldArrowLayer *layer, CeldLineArrow **arrows)
{
  CeldProfileReading r = { .lines = lines, .layer = layer };
  CeldStatus status = find_most (&r);

  *arrows = NULL;
  remove_tips (lines);
  if (status == CELD_OK)
    status = divide_at_turns (&r);
  if (status == CELD_OK)
    status = reading_new (&r);
  if (status == CELD_OK && !(*arrows = celd_alloc0 (lines->graph.n_lines, sizeof **arrows)))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_joined_passes_find (&r);
  if (status == CELD_OK)
    find_arrows (&r, *arrows);
  celd_free (r.profile);
  celd_free (r.alone);
  celd_free (r.next);
  celd_free (r.doubt);
  return status;
}
