/* Many labels on a 4-connected grid: the Potts energy of LazyBrush [SDC09b],
 *   E(c) = sum over neighbours p, q with c_p != c_q of V_pq  +  sum over painted p with c_p != seed_p of vote (seed_p),
 * lowered by exact binary cuts.  The multiway cut of more than two labels is NP-hard, so they are separated one after
 * the other: the first label of a connected component from all others in it, and so on with the connected components of
 * what is left.  Components that one label alone reaches need no cut, and a cut takes the bounding box of its component
 * alone. Many labels (a flat colouring has hundreds) are first separated in halves.
 *
 * partition-greedy.c does the same on a graph; on all pixels its general network takes 2.4 to 13 times as long and 2.5
 * times the memory (drawings of 1 megapixel).
 *
 * Cost: a minimum cut (maxflow.c) for each component and label; 8 bytes a pixel beside the cut's.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "solve/maxflow.h"
#include "solve/partition.h"

#define MAX_CAPACITY         ((1 << 30) - 1)  /* what celd_maxflow takes */

/* A connected component of undecided pixels: those with component[p] == id.  Labels of rank from .. to - 1 may get it;
 * the next cut is between those below mid and the others. */
typedef struct { uint32_t id; size_t from, mid, to; int left, top, right, bottom; } PixelComponent;

typedef struct
{
  const CeldMultiway *problem;
  const CeldHost     *host;
  uint32_t           *label;
  uint32_t           *component; /* 0: decided */
  uint32_t           *queue;     /* pixels of the component that is being filled */
  size_t             *rank;      /* of label l: rank[l - 1] */
  uint32_t           *seen;      /* by rank: the last component that this label reaches */
  uint32_t            last_id;
  PixelComponent     *todo;
  size_t              n_todo;
  size_t              decided, total;
  size_t              todo_capacity;
} Solver;

/* The label whose hard seed p is, or 0. */
static uint32_t
hard_label (const Solver *s, size_t p)
{
  uint32_t seed = s->problem->seed[p];

  return seed && s->problem->vote[seed - 1] == CELD_HARD && s->label[p] == seed ? seed : 0;
}

#define NEIGHBOURS 4

/* Lists the neighbours q of pixel p, and the capacities of the edges to them; returns how many there are. */
static size_t
neighbours (const CeldMultiway *m, size_t p, size_t q[NEIGHBOURS], int32_t capacity[NEIGHBOURS])
{
  size_t w = (size_t) m->width, x = p % w, n = 0;

  if (x + 1 < w)
    q[n] = p + 1, capacity[n++] = m->east[p];
  if (x > 0)
    q[n] = p - 1, capacity[n++] = m->east[p - 1];
  if (p + w < w * (size_t) m->height)
    q[n] = p + w, capacity[n++] = m->south[p];
  if (p >= w)
    q[n] = p - w, capacity[n++] = m->south[p - w];
  return n;
}

/* ------------------------------------------------------------------ components */

static void
see (Solver *s, PixelComponent *component, uint32_t label, size_t *reached)
{
  size_t rank;

  if (!label)
    return;
  rank = s->rank[label - 1];
  if (rank < component->from || rank >= component->to || s->seen[rank] == component->id)
    return;
  s->seen[rank] = component->id;
  ++*reached;
}

/* Makes the pixels that are connected with `start` and are of component `old` the new component, with its box and the
 * number of labels that reach it.  Returns the number of its pixels, which lie in the queue. */
static size_t
fill (Solver *s, size_t start, uint32_t old, PixelComponent *component, size_t *reached)
{
  size_t w = (size_t) s->problem->width, n = 0;

  *reached = 0;
  component->left = component->top = INT32_MAX;
  component->right = component->bottom = 0;
  s->component[start] = component->id;
  s->queue[n++]   = (uint32_t) start;
  for (size_t i = 0; i < n; i++)
    {
      size_t  p = s->queue[i], q[NEIGHBOURS];
      int32_t capacity[NEIGHBOURS];
      size_t  m = neighbours (s->problem, p, q, capacity);
      int     x = (int) (p % w), y = (int) (p / w);

      component->left   = x < component->left ? x : component->left;
      component->right  = x > component->right ? x : component->right;
      component->top    = y < component->top ? y : component->top;
      component->bottom = y > component->bottom ? y : component->bottom;
      see (s, component, s->problem->seed[p], reached);
      for (size_t k = 0; k < m; k++)
        if (s->component[q[k]] == old)
          {
            s->component[q[k]] = component->id;
            s->queue[n++]  = (uint32_t) q[k];
          }
        else if (!s->component[q[k]])
          see (s, component, hard_label (s, q[k]), reached);
    }
  return n;
}

/* Gives the n pixels in the queue to the first label that reaches their component. */
static void
decide (Solver *s, const PixelComponent *component, size_t n)
{
  size_t rank = component->from;

  while (rank < component->to && s->seen[rank] != component->id)
    rank++;
  if (rank == component->to)
    rank = component->from;
  for (size_t i = 0; i < n; i++)
    {
      s->label[s->queue[i]] = s->problem->order[rank];
      s->component[s->queue[i]] = 0;
    }
  s->decided += n;
}

/* The first label against the others; or the first half of them if they are many. */
static size_t
middle_rank (const Solver *s, const PixelComponent *component, size_t reached)
{
  size_t left = reached < CELD_MANY_LABELS ? 1 : reached / 2;
  size_t rank = component->from;

  for (; left; rank++)
    left -= s->seen[rank] == component->id;
  return rank;
}

/* Finds the connected components among the pixels of component `old` in its box.  Those that one label reaches are
 * decided, the others noted. */
static CeldStatus
find_components (Solver *s, const PixelComponent *old)
{
  for (int y = old->top; y <= old->bottom; y++)
    for (int x = old->left; x <= old->right; x++)
      {
        size_t         p = (size_t) y * (size_t) s->problem->width + (size_t) x, n, reached;
        PixelComponent component = *old;

        if (s->component[p] != old->id)
          continue;
        component.id = ++s->last_id;
        n = fill (s, p, old->id, &component, &reached);
        if (reached < 2)
          {
            decide (s, &component, n);
            continue;
          }
        component.mid = middle_rank (s, &component, reached);
        if (celd_append (s->todo, s->n_todo, s->todo_capacity, component) != CELD_OK)
          return CELD_NO_MEMORY;
      }
  return CELD_OK;
}

/* ------------------------------------------------------------------ one cut */

/* The terminal capacity of a pixel, to the labels below mid (> 0) or to the others (< 0): its own paint, and hard
 * pixels beside it. */
static int32_t
terminal_capacity (const Solver *s, const PixelComponent *component, size_t p)
{
  const CeldMultiway *m = s->problem;
  size_t              q[NEIGHBOURS], n;
  int32_t             capacity[NEIGHBOURS];
  uint32_t            label[NEIGHBOURS + 1] = { m->seed[p] };
  int64_t             sum = 0;

  n = neighbours (m, p, q, capacity);
  for (size_t k = 0; k < n; k++)
    label[k + 1] = s->component[q[k]] ? 0 : hard_label (s, q[k]);
  for (size_t k = 0; k <= n; k++)
    {
      size_t  rank;
      int32_t vote;

      if (!label[k])
        continue;
      rank = s->rank[label[k] - 1];
      vote = k ? capacity[k - 1] : m->vote[label[k] - 1];
      if (rank >= component->from && rank < component->to)
        sum += rank < component->mid ? vote : -(int64_t) vote;
    }
  return (int32_t) (sum > MAX_CAPACITY ? MAX_CAPACITY : sum < -MAX_CAPACITY ? -MAX_CAPACITY : sum);
}

/* Edges only within the component. */
static void
lay_out (const Solver *s, const PixelComponent *component, int32_t *east, int32_t *south, int32_t *terminal)
{
  const CeldMultiway *m = s->problem;
  size_t              w = (size_t) m->width, i = 0;

  for (int y = component->top; y <= component->bottom; y++)
    for (int x = component->left; x <= component->right; x++, i++)
      {
        size_t p = (size_t) y * w + (size_t) x;
        bool   inside = s->component[p] == component->id;

        east[i]     = inside && x < component->right && s->component[p + 1] == component->id ? m->east[p] : 0;
        south[i]    = inside && y < component->bottom && s->component[p + w] == component->id ? m->south[p] : 0;
        terminal[i] = inside ? terminal_capacity (s, component, p) : 0;
      }
}

/* Pixels on the source side become a component of their own, for which only the labels below mid are left. */
static void
take_side (Solver *s, const PixelComponent *component, const uint8_t *side, uint32_t id)
{
  size_t i = 0;

  for (int y = component->top; y <= component->bottom; y++)
    for (int x = component->left; x <= component->right; x++, i++)
      {
        size_t p = (size_t) y * (size_t) s->problem->width + (size_t) x;

        if (s->component[p] == component->id && side[i])
          s->component[p] = id;
      }
}

static CeldStatus
cut (Solver *s, const PixelComponent *component)
{
  int            w = component->right - component->left + 1, h = component->bottom - component->top + 1;
  size_t         n = (size_t) w * (size_t) h;
  int32_t       *east = celd_alloc (n, sizeof *east), *south = celd_alloc (n, sizeof *south);
  int32_t       *terminal = celd_alloc (n, sizeof *terminal);
  uint8_t       *side = celd_alloc (n, 1);
  PixelComponent first = *component, others = *component;
  double         done = (double) s->decided / (double) s->total;
  CeldHostPart   part;
  CeldHost       host = celd_host_part (&part, s->host, done, done);
  CeldStatus     status = CELD_NO_MEMORY;

  if (!east || !south || !terminal || !side)
    goto done;
  lay_out (s, component, east, south, terminal);
  status = celd_maxflow (w, h, east, south, terminal, &host, side, NULL);
  if (status != CELD_OK)
    goto done;
  first.id = ++s->last_id;
  first.to = others.from = component->mid;
  take_side (s, component, side, first.id);
  status = find_components (s, &first);
  if (status == CELD_OK)
    status = find_components (s, &others);

done:
  celd_free (east);
  celd_free (south);
  celd_free (terminal);
  celd_free (side);
  return status;
}

/* ------------------------------------------------------------------ the whole */

/* Hard seeds are decided from the start; everything else is one component. */
static void
begin (Solver *s)
{
  const CeldMultiway *m = s->problem;

  for (size_t i = 0; i < m->n_labels; i++)
    s->rank[m->order[i] - 1] = i;
  for (size_t p = 0; p < (size_t) m->width * (size_t) m->height; p++)
    {
      if (!s->label[p] && m->seed[p] && m->vote[m->seed[p] - 1] == CELD_HARD)
        s->label[p] = m->seed[p];
      s->component[p] = !s->label[p];
      s->total += !s->label[p];
    }
  s->last_id = 1;
}

CeldStatus
celd_multiway (const CeldMultiway *problem, const CeldHost *host, uint32_t *label)
{
  size_t         n = (size_t) problem->width * (size_t) problem->height;
  PixelComponent all = { 1, 0, 0, problem->n_labels, 0, 0, problem->width - 1, problem->height - 1 };
  Solver         s = { .problem = problem, .host = host, .label = label };
  CeldStatus     status = CELD_NO_MEMORY;

  s.component = celd_alloc (n, sizeof *s.component);
  s.queue = celd_alloc (n, sizeof *s.queue);
  s.rank  = celd_alloc (problem->n_labels, sizeof *s.rank);
  s.seen  = celd_alloc0 (problem->n_labels, sizeof *s.seen);
  if (!s.component || !s.queue || !s.rank || !s.seen)
    goto done;
  begin (&s);
  status = find_components (&s, &all);
  while (status == CELD_OK && s.n_todo)
    {
      PixelComponent component = s.todo[--s.n_todo];

      status = cut (&s, &component);
    }

done:
  celd_free (s.component);
  celd_free (s.queue);
  celd_free (s.rank);
  celd_free (s.seen);
  celd_free (s.todo);
  return status;
}
