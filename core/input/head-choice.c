/* The choice of heads or dots for all lines together that costs least, and how much worse every other one is.
 *
 * A choice costs what it leaves unexplained at nodes, lines without a head or with two, and arrows that turn where they
 * pass a node.  From no heads at all, one or two lines that meet are changed at a time as long as that costs less.  For
 * the margin of a line, everything that it may have instead is held, and those that it meets are changed in the same
 * way, and those that meet what was changed.
 *
 * Cost: for each line, some hundred choices of the lines that it meets, each as long as the number of lines.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>
#include <string.h>

/* All chosen; costs are square widths of paint. */
#define NO_MARK       3    /* cost of an arrow without a head, ... */
#define NO_ARROW      0.5  /* ... of a free line without one that may be a barb, ... */
#define BARB_LINE     8    /* ... which is no longer than so many widths, ... */
#define MORE_MARKS    1.1  /* ... and of each head more than one */
#define HUB_PASS      0.5  /* cost of an arrow that passes a node, for each line but one that ends there */
#define IMPOSSIBLE    100  /* cost of a head where an arrow passes, and of two arrows of one end */
#define SMALLER       1e-6 /* costs that differ by less are equal */
#define MOST_RESTARTS 20   /* after a better choice was found while margins are measured */

#define HOLD_NONE SIZE_MAX

/* ------------------------------------------------------------------ what a choice costs */

unsigned
celd_head_choice_at (const CeldHeadChoice *s, int node)
{
  const CeldNodeMarks *at = &s->node[node];
  unsigned             set = 0;

  for (int e = 0; e < at->n; e++)
    set |= s->marked[at->end[e]] ? 1u << e : 0;
  return set;
}

/* Finds the lines that belong to one arrow, because it passes where they meet. */
static void
find_chains (CeldHeadChoice *s)
{
  for (size_t k = 0; k < s->lines->graph.n_lines; k++)
    s->chain[k] = k;
  for (bool again = true; again;)
    {
      again = false;
      for (size_t i = 0; i < s->n_on; i++)
        {
          size_t *a = &s->chain[s->pass[s->on[i]].end[0] / 2], *b = &s->chain[s->pass[s->on[i]].end[1] / 2];

          if (*a == *b)
            continue;
          *a = *b = *a < *b ? *a : *b;
          again = true;
        }
    }
}

/* What a pass costs for the lines that end at its node: where many do, arrows hardly pass. */
static double
cost_of_hub (const CeldHeadChoice *s, const CeldArrowPass *pass)
{
  int node = celd_joined_node (s->lines, pass->end[0]), ends = s->node[node].n;

  for (size_t i = 0; i < s->n_on; i++)
    ends -= celd_joined_node (s->lines, s->pass[s->on[i]].end[0]) == node ? 2 : 0;
  return ends > 1 ? HUB_PASS * (ends - 1) : 0;
}

/* What the passes that are on cost; lists them. */
static double
cost_of_passes (CeldHeadChoice *s)
{
  double cost = 0;

  memset (s->passed, 0, 2 * s->lines->graph.n_lines);
  s->n_on = 0;
  for (size_t i = 0; i < s->n_passes; i++)
    if (s->pass[i].on)
      {
        cost += s->pass[i].cost;
        s->on[s->n_on++] = i;
        for (int side = 0; side < 2; side++)
          {
            size_t end = s->pass[i].end[side];

            cost += s->marked[end] || s->passed[end] ? IMPOSSIBLE : 0;
            s->passed[end] = true;
          }
      }
  for (size_t i = 0; i < s->n_on; i++)
    cost += cost_of_hub (s, &s->pass[s->on[i]]);
  return cost;
}

/* Is a line with a free end no longer than a barb? */
static bool
may_be_barb (const CeldJoinedLines *lines, size_t k)
{
  return celd_stroke_line_length (&lines->graph.line[k]) < BARB_LINE * lines->graph.width &&
         (celd_joined_is_free (lines, 2 * k) || celd_joined_is_free (lines, 2 * k + 1));
}

static double
total (CeldHeadChoice *s)
{
  const CeldStrokeGraph *g = &s->lines->graph;
  double                 cost = cost_of_passes (s);

  for (size_t k = 0; k < g->n_nodes; k++)
    if (s->node[k].cost)
      cost += s->node[k].cost[celd_head_choice_at (s, (int) k)];
  find_chains (s);
  memset (s->heads, 0, g->n_lines * sizeof *s->heads);
  for (size_t k = 0; k < g->n_lines; k++)
    s->heads[s->chain[k]] += s->marked[2 * k] + s->marked[2 * k + 1];
  for (size_t k = 0; k < g->n_lines; k++)
    if (s->chain[k] == k)
      cost += s->heads[k] ? MORE_MARKS * (s->heads[k] - 1) : s->short_line[k] ? NO_ARROW : NO_MARK;
  return cost;
}

/* ------------------------------------------------------------------ changes */

/* The heads of a line: 1 = at its first end, 2 = at its last one, and both. */
static unsigned
heads_of (const CeldHeadChoice *s, size_t k)
{
  return (unsigned) s->marked[2 * k] + 2 * (unsigned) s->marked[2 * k + 1];
}

static void
set_heads (CeldHeadChoice *s, size_t k, unsigned heads)
{
  s->marked[2 * k]     = heads & 1;
  s->marked[2 * k + 1] = heads >> 1 & 1;
}

static bool
meet (const CeldHeadChoice *s, size_t a, size_t b)
{
  const int *u = s->lines->graph.line[a].node, *v = s->lines->graph.line[b].node;

  return u[0] == v[0] || u[0] == v[1] || u[1] == v[0] || u[1] == v[1];
}

/* Lets all lines be tried again whose cost depends on the heads of a line: those of its arrow, and those that meet
 * them. */
static void
try_round (CeldHeadChoice *s, size_t k)
{
  size_t n = s->lines->graph.n_lines;

  total (s); /* finds its arrow */
  for (size_t a = 0; a < n; a++)
    for (size_t b = 0; s->chain[a] == s->chain[k] && b < n; b++)
      s->tried_next[b] |= meet (s, a, b);
}

/* Tries all heads of two lines, or of one if they are the same, with `pass` the other way if it is given; keeps what
 * costs least.  The line `held` keeps its heads. */
static bool
improve (CeldHeadChoice *s, size_t a, size_t b, CeldArrowPass *pass, size_t held, double *least)
{
  unsigned before[2] = { heads_of (s, a), heads_of (s, b) }, best[2] = { before[0], before[1] };
  bool     better = false;

  if (pass)
    pass->on = !pass->on;
  for (unsigned i = 0; i < 4; i++)
    for (unsigned k = 0; k < 4; k++)
      {
        double cost;

        if ((a == held && i != before[0]) || (b == held && k != before[1]) || (a == b && i != k))
          continue;
        set_heads (s, a, i);
        set_heads (s, b, k);
        cost = total (s);
        if (cost < *least - SMALLER)
          {
            *least  = cost;
            best[0] = i;
            best[1] = k;
            better  = true;
          }
      }
  set_heads (s, a, best[0]);
  set_heads (s, b, best[1]);
  if (pass && !better)
    pass->on = !pass->on;
  if (better)
    {
      try_round (s, a);
      try_round (s, b);
    }
  return better;
}

/* Is one of two lines to be tried? */
static bool
is_tried (const CeldHeadChoice *s, size_t a, size_t b)
{
  return s->tried[a] || s->tried[b] || s->tried_next[a] || s->tried_next[b];
}

/* Changes lines and passes until nothing costs less; a line or pass that is held stays.  Only lines of `tried_next` and
 * what then changes round them are tried.  Returns the cost. */
static double
descend (CeldHeadChoice *s, size_t held_line, size_t held_pass)
{
  size_t n = s->lines->graph.n_lines;
  double least = total (s);

  for (bool again = true; again;)
    {
      again = false;
      memcpy (s->tried, s->tried_next, n * sizeof *s->tried);
      memset (s->tried_next, 0, n * sizeof *s->tried_next);
      for (size_t a = 0; a < n; a++)
        for (size_t b = a; b < n; b++)
          if (meet (s, a, b) && is_tried (s, a, b) && improve (s, a, b, NULL, held_line, &least))
            again = true;
      for (size_t i = 0; i < s->n_passes; i++)
        {
          size_t a = s->pass[i].end[0] / 2, b = s->pass[i].end[1] / 2;

          if (i != held_pass && is_tried (s, a, b) && improve (s, a, b, &s->pass[i], held_line, &least))
            again = true;
        }
    }
  return least;
}

/* ------------------------------------------------------------------ margins */

/* Saved choices: the marks of all ends, and whether each pass is on. */
static void
save (const CeldHeadChoice *s, bool *to)
{
  memcpy (to, s->marked, 2 * s->lines->graph.n_lines);
  for (size_t i = 0; i < s->n_passes; i++)
    to[2 * s->lines->graph.n_lines + i] = s->pass[i].on;
}

static void
restore (CeldHeadChoice *s, const bool *from)
{
  memcpy (s->marked, from, 2 * s->lines->graph.n_lines);
  for (size_t i = 0; i < s->n_passes; i++)
    s->pass[i].on = from[2 * s->lines->graph.n_lines + i];
}

static void
keep_least (const CeldHeadChoice *s, double cost, double *least, bool *to)
{
  if (cost >= *least)
    return;
  *least = cost;
  save (s, to);
}

/* The cost of the best choice in which a line has other heads than in `best`; saved in `other` if it costs less than
 * `least`. */
static double
cost_of_other_heads (CeldHeadChoice *s, size_t k, const bool *best, double *least, bool *other)
{
  double lowest = INFINITY;

  for (unsigned heads = 0; heads < 4; heads++)
    {
      double cost;

      restore (s, best);
      if (heads_of (s, k) == heads)
        continue;
      set_heads (s, k, heads);
      try_round (s, k);
      cost   = descend (s, k, HOLD_NONE);
      lowest = fmin (lowest, cost);
      keep_least (s, cost, least, other);
    }
  return lowest;
}

/* The same if one of its passes is the other way. */
static double
cost_of_other_passes (CeldHeadChoice *s, size_t k, const bool *best, double *least, bool *other)
{
  double lowest = INFINITY;

  for (size_t i = 0; i < s->n_passes; i++)
    if (s->pass[i].end[0] / 2 == k || s->pass[i].end[1] / 2 == k)
      {
        double cost;

        restore (s, best);
        s->pass[i].on = !s->pass[i].on;
        try_round (s, s->pass[i].end[0] / 2);
        try_round (s, s->pass[i].end[1] / 2);
        cost   = descend (s, HOLD_NONE, i);
        lowest = fmin (lowest, cost);
        keep_least (s, cost, least, other);
      }
  return lowest;
}

/* Finds the best choice, and the margins of all lines; `saved` is memory for two choices. */
static void
find_best (CeldHeadChoice *s, bool *saved)
{
  size_t n = s->lines->graph.n_lines, size = 2 * n + s->n_passes;
  bool  *best = saved, *other = saved + size;
  double least;
  int    restarts = 0;

  memset (s->tried_next, true, n * sizeof *s->tried_next);
  least = descend (s, HOLD_NONE, HOLD_NONE);
  save (s, best);
  for (size_t k = 0; k < n;)
    {
      double others = INFINITY;

      s->margin[k]      = cost_of_other_heads (s, k, best, &others, other) - least;
      s->pass_margin[k] = cost_of_other_passes (s, k, best, &others, other) - least;
      k++;
      if (others < least - SMALLER && restarts++ < MOST_RESTARTS)
        {
          memcpy (best, other, size);
          least = others;
          k     = 0;
        }
    }
  restore (s, best);
  total (s); /* finds its chains and heads */
}

CeldStatus
celd_head_choice_find (CeldHeadChoice *s)
{
  size_t n = s->lines->graph.n_lines;
  bool  *saved = celd_alloc (2 * n + s->n_passes, 2), enough;

  s->on    = celd_alloc (s->n_passes, sizeof *s->on);
  s->tried = celd_alloc0 (n, 2 * sizeof *s->tried);
  enough   = saved && s->on && s->tried;
  if (enough)
    {
      s->tried_next = s->tried + n;
      for (size_t k = 0; k < n; k++)
        s->short_line[k] = may_be_barb (s->lines, k);
      find_best (s, saved);
    }
  celd_free (saved);
  celd_free (s->on);
  celd_free (s->tried);
  s->on    = NULL;
  s->tried = s->tried_next = NULL;
  return enough ? CELD_OK : CELD_NO_MEMORY;
}
