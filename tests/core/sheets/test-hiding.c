/* Which regions may hide which, and their ranks, against the closure of all relations by brute force.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "sheets/sheets.h"

#define MOST_LABELS 9
#define MOST_LINKS  8
#define MOST_ENDS   (2 * MOST_LINKS * MOST_LABELS)
#define MOST_WISHES 30

/* A consistent order: labels of one height may be equal, and those of a lower one behind. The last item of first[]
 * counts the ends so far. */
typedef struct
{
  CeldOrder order;
  uint32_t  level[MOST_LABELS], end[MOST_ENDS];
  size_t    first[2 * MOST_LINKS + 1];
  bool      equal[MOST_LINKS];
} Scene;

/* not_before[a][b]: a is behind b or level with it; behind[a][b]: a is behind b. */
typedef struct { size_t n; bool not_before[MOST_LABELS][MOST_LABELS], behind[MOST_LABELS][MOST_LABELS]; } Closure;

static void
add_ends (uint32_t *state, Scene *s, uint32_t height)
{
  for (uint32_t l = 0; l < s->order.n; l++)
    if (s->level[l] == height && check_random (state, 2))
      s->end[s->first[2 * MOST_LINKS]++] = l;
}

/* One link: some labels of one height behind some of higher ones, or level with others of theirs. */
static void
add_link (uint32_t *state, Scene *s, uint32_t heights)
{
  size_t   i = s->order.links.n;
  size_t  *count = &s->first[2 * MOST_LINKS], from = *count, middle;
  uint32_t low = check_random (state, heights), high = check_random (state, heights);

  if (low > high)
    {
      uint32_t swap = low;

      low = high;
      high = swap;
    }
  add_ends (state, s, low);
  middle = *count;
  add_ends (state, s, high);
  if (middle == from || *count == middle)
    {
      *count = from;
      return;
    }
  s->first[2 * i] = from;
  s->first[2 * i + 1] = middle;
  s->equal[i] = low == high;
  s->order.links.n++;
}

static void
make_scene (uint32_t *state, Scene *s)
{
  uint32_t heights = 1 + check_random (state, 6);
  int      tries = (int) check_random (state, MOST_LINKS);

  *s = (Scene) { .order = { .level = s->level, .n = 1 + check_random (state, MOST_LABELS) } };
  s->order.links = (CeldOrderLinks) { 0, s->first, s->end, s->equal };
  for (size_t l = 0; l < s->order.n; l++)
    s->level[l] = check_random (state, heights);
  while (tries-- > 0)
    add_link (state, s, heights);
  s->first[2 * s->order.links.n] = s->first[2 * MOST_LINKS];
}

static void
put_behind (Closure *c, size_t a, size_t b, bool strictly)
{
  c->not_before[a][b] = true;
  c->behind[a][b] |= strictly;
}

static void
close_paths (Closure *c)
{
  for (size_t k = 0; k < c->n; k++)
    for (size_t a = 0; a < c->n; a++)
      for (size_t b = 0; b < c->n; b++)
        if (c->not_before[a][k] && c->not_before[k][b])
          put_behind (c, a, b, c->behind[a][k] || c->behind[k][b]);
}

static Closure
closure_of (const CeldOrder *order)
{
  const CeldOrderLinks *links = &order->links;
  Closure               c = { .n = order->n };

  for (size_t l = 0; l < order->n; l++)
    c.not_before[l][l] = true;
  for (size_t i = 0; i < links->n; i++)
    for (size_t a = links->first[2 * i]; a < links->first[2 * i + (links->equal[i] ? 2 : 1)]; a++)
      for (size_t b = links->first[2 * i + !links->equal[i]]; b < links->first[2 * i + 2]; b++)
        put_behind (&c, links->end[a], links->end[b], !links->equal[i]);
  for (size_t a = 0; a < order->n && !links->n; a++)
    for (size_t b = 0; b < order->n; b++)
      if (order->level[a] <= order->level[b])
        put_behind (&c, a, b, order->level[a] < order->level[b]);
  close_paths (&c);
  return c;
}

/* ------------------------------------------------------------------ who may hide whom */

static void
standings_follow_from_relations (void)
{
  static Scene s;
  uint32_t     state = 1;

  for (int round = 0; round < 5000; round++)
    {
      CeldHiding hiding;
      Closure    c;

      make_scene (&state, &s);
      c = closure_of (&s.order);
      CHECK (celd_hiding_new (&s.order, &hiding) == CELD_OK);
      for (size_t l = 0; l < s.order.n; l++)
        {
          uint8_t  standing[MOST_LABELS];
          uint32_t queue[MOST_LABELS];

          celd_hiding_of (&hiding, (uint32_t) l + 1, standing, queue);
          for (size_t o = 0; o < s.order.n; o++)
            if (c.behind[o][l])
              CHECK (standing[o] == CELD_BEHIND);
            else if (c.not_before[o][l] && c.not_before[l][o])
              CHECK (standing[o] == CELD_LEVEL);
            else
              CHECK (standing[o] == CELD_HIDING);
        }
      celd_hiding_clear (&hiding);
    }
}

/* ------------------------------------------------------------------ ranks */

static size_t
make_wishes (uint32_t *state, const Scene *s, CeldHidden *wish)
{
  size_t n = 0;

  for (uint32_t far = 0; far < s->order.n; far++)
    for (uint32_t near = 0; near < s->order.n && n < MOST_WISHES; near++)
      if (near != far && check_random (state, 3) == 0 && (s->order.links.n || s->level[near] > s->level[far]))
        wish[n++] = (CeldHidden) { near + 1, far + 1, 1 + check_random (state, 20) };
  return n;
}

static bool
is_before (const CeldHidden *a, const CeldHidden *b)
{
  if (a->area < b->area || a->area > b->area)
    return a->area > b->area;
  return a->nearer != b->nearer ? a->nearer < b->nearer : a->farther < b->farther;
}

/* Fulfils the wishes one by one where nothing contradicts. */
static void
fulfil (Closure *c, const CeldHidden *wish, size_t n)
{
  bool done[MOST_WISHES] = { false };

  for (size_t i = 0; i < n; i++)
    {
      size_t best = n;

      for (size_t k = 0; k < n; k++)
        if (!done[k] && (best == n || is_before (&wish[k], &wish[best])))
          best = k;
      done[best] = true;
      if (!c->not_before[wish[best].nearer - 1][wish[best].farther - 1])
        {
          put_behind (c, wish[best].farther - 1, wish[best].nearer - 1, true);
          close_paths (c);
        }
    }
}

static void
ranks_fulfil_relations_and_then_wishes (void)
{
  static Scene s;
  uint32_t     state = 2;

  for (int round = 0; round < 5000; round++)
    {
      CeldHiding hiding;
      CeldHidden wish[MOST_WISHES];
      size_t     n;
      Closure    c;
      uint32_t   rank[MOST_LABELS];

      make_scene (&state, &s);
      n = make_wishes (&state, &s, wish);
      c = closure_of (&s.order);
      fulfil (&c, wish, n);
      CHECK (celd_hiding_new (&s.order, &hiding) == CELD_OK);
      CHECK (celd_hiding_rank (&hiding, wish, n, rank) == CELD_OK);
      for (size_t a = 0; a < s.order.n; a++)
        {
          size_t lower = 0;

          for (size_t b = 0; b < s.order.n; b++)
            {
              CHECK (!c.behind[a][b] || rank[a] < rank[b]);
              CHECK ((rank[a] == rank[b]) == (c.not_before[a][b] && c.not_before[b][a]));
              lower += rank[b] < rank[a];
            }
          CHECK (rank[a] == lower);
        }
      celd_hiding_clear (&hiding);
    }
}

/* Without relations and wishes ranks rise with levels, and equal ones share one. */
static void
ranks_of_levels (void)
{
  uint32_t   level[5] = { 3, 0, 3, 1, 0 }, wanted[5] = { 3, 0, 3, 2, 0 }, rank[5];
  CeldOrder  order = { .level = level, .n = 5 };
  CeldHidden none = { 0 };
  CeldHiding hiding;

  CHECK (celd_hiding_new (&order, &hiding) == CELD_OK);
  CHECK (celd_hiding_rank (&hiding, &none, 0, rank) == CELD_OK);
  CHECK (!memcmp (rank, wanted, sizeof rank));
  celd_hiding_clear (&hiding);
}

/* Of two regions that nobody compared the larger wish counts, even against levels. */
static void
the_larger_part_is_hidden (void)
{
  uint32_t   level[3] = { 0, 2, 1 }, end[2] = { 0, 1 }, rank[3];
  size_t     first[3] = { 0, 1, 2 };
  bool       equal[1] = { false };
  CeldOrder  order = { .level = level, .n = 3, .links = { 1, first, end, equal } };
  CeldHidden one[2] = { { 2, 3, 10 }, { 3, 2, 11 } }, other[2] = { { 2, 3, 11 }, { 3, 2, 10 } };
  CeldHiding hiding;

  CHECK (celd_hiding_new (&order, &hiding) == CELD_OK);
  CHECK (celd_hiding_rank (&hiding, one, 2, rank) == CELD_OK);
  CHECK (rank[2] > rank[1] && rank[1] > rank[0]);
  CHECK (celd_hiding_rank (&hiding, other, 2, rank) == CELD_OK);
  CHECK (rank[1] > rank[2] && rank[1] > rank[0]);
  celd_hiding_clear (&hiding);
}

int
main (void)
{
  RUN (standings_follow_from_relations);
  RUN (ranks_fulfil_relations_and_then_wishes);
  RUN (ranks_of_levels);
  RUN (the_larger_part_is_hidden);
  return DONE;
}
