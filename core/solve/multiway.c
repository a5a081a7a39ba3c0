/* Many labels on a 4-connected grid: the Potts energy of LazyBrush [SDC09b],
 *   E(c) = sum over neighbours p, q with c_p != c_q of V_pq  +  sum over painted p with c_p != seed_p of vote (seed_p),
 * lowered by exact binary cuts.  More than two labels are NP-hard to do at once, so they are told apart in turn: the
 * first label of a connected piece from all the others in it, what is left in connected pieces again, and so on.
 *
 * Two shortcuts that change nothing: a piece that only one label reaches is that label's without a cut, and a cut looks
 * at the bounding box of its piece alone.  Many labels (a flat colouring has hundreds) are first told apart in halves.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/maxflow.h"

#define MANY_LABELS  24               /* from here on a piece is cut between two halves of its labels */
#define MOST         ((1 << 30) - 1)  /* what celd_maxflow takes */

/* A connected piece of undecided pixels: those with piece[p] == id.  Labels of rank from .. to - 1 may get it;
 * the next cut is between those below mid and the others. */
typedef struct { uint32_t id; size_t from, mid, to; int left, top, right, bottom; } Piece;

typedef struct
{
  const CeldMultiway *problem;
  const CeldHost     *host;
  uint32_t *label;
  uint32_t *piece;               /* 0: decided */
  uint32_t *queue;               /* pixels of the piece that is being filled */
  size_t   *rank;                /* of label l: rank[l - 1] */
  uint32_t *seen;                /* by rank: the last piece that this label reaches */
  uint32_t  last_id;
  Piece    *todo;
  size_t    n_todo;
  size_t    decided, total;
} Solver;

/* The label whose hard seed p is, or 0. */
static uint32_t
hard_label (const Solver *s, size_t p)
{
  uint32_t seed = s->problem->seed[p];

  return seed && s->problem->vote[seed - 1] == CELD_HARD && s->label[p] == seed ? seed : 0;
}

/* Calls out the four neighbours of p = (x,y) that exist: q, and the capacity of the edge to it. */
#define NEIGHBOURS 4

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

/* ------------------------------------------------------------------ pieces */

static void
see (Solver *s, Piece *piece, uint32_t label, size_t *reached)
{
  size_t rank;

  if (!label)
    return;
  rank = s->rank[label - 1];
  if (rank < piece->from || rank >= piece->to || s->seen[rank] == piece->id)
    return;
  s->seen[rank] = piece->id;
  ++*reached;
}

/* Makes the pixels that hang together with `start` and are of piece `old` the new piece, with its box and the number
 * of labels that reach it.  Returns the number of its pixels, which lie in the queue. */
static size_t
fill (Solver *s, size_t start, uint32_t old, Piece *piece, size_t *reached)
{
  size_t w = (size_t) s->problem->width, n = 0;

  *reached = 0;
  piece->left = piece->top = INT32_MAX;
  piece->right = piece->bottom = 0;
  s->piece[start] = piece->id;
  s->queue[n++]   = (uint32_t) start;
  for (size_t i = 0; i < n; i++)
    {
      size_t  p = s->queue[i], q[NEIGHBOURS];
      int32_t capacity[NEIGHBOURS];
      size_t  m = neighbours (s->problem, p, q, capacity);
      int     x = (int) (p % w), y = (int) (p / w);

      piece->left   = x < piece->left ? x : piece->left;
      piece->right  = x > piece->right ? x : piece->right;
      piece->top    = y < piece->top ? y : piece->top;
      piece->bottom = y > piece->bottom ? y : piece->bottom;
      see (s, piece, s->problem->seed[p], reached);
      for (size_t k = 0; k < m; k++)
        if (s->piece[q[k]] == old)
          {
            s->piece[q[k]] = piece->id;
            s->queue[n++]  = (uint32_t) q[k];
          }
        else if (!s->piece[q[k]])
          see (s, piece, hard_label (s, q[k]), reached);
    }
  return n;
}

/* Gives the n pixels in the queue to the first label that reaches their piece. */
static void
decide (Solver *s, const Piece *piece, size_t n)
{
  size_t rank = piece->from;

  while (rank < piece->to && s->seen[rank] != piece->id)
    rank++;
  if (rank == piece->to)
    rank = piece->from;
  for (size_t i = 0; i < n; i++)
    {
      s->label[s->queue[i]] = s->problem->order[rank];
      s->piece[s->queue[i]] = 0;
    }
  s->decided += n;
}

/* The first label against the others; or the first half of them if they are many. */
static size_t
middle_rank (const Solver *s, const Piece *piece, size_t reached)
{
  size_t left = reached < MANY_LABELS ? 1 : reached / 2;
  size_t rank = piece->from;

  for (; left; rank++)
    left -= s->seen[rank] == piece->id;
  return rank;
}

/* Finds the connected pieces among the pixels of piece `old` in its box.  Those that one label reaches are decided,
 * the others noted. */
static CeldStatus
find_pieces (Solver *s, const Piece *old)
{
  for (int y = old->top; y <= old->bottom; y++)
    for (int x = old->left; x <= old->right; x++)
      {
        size_t p = (size_t) y * (size_t) s->problem->width + (size_t) x, n, reached;
        Piece  piece = *old, *todo;

        if (s->piece[p] != old->id)
          continue;
        piece.id = ++s->last_id;
        n = fill (s, p, old->id, &piece, &reached);
        if (reached < 2)
          {
            decide (s, &piece, n);
            continue;
          }
        piece.mid = middle_rank (s, &piece, reached);
        todo = celd_grow (s->todo, s->n_todo + 1, sizeof *todo);
        if (!todo)
          return CELD_NO_MEMORY;
        s->todo = todo;
        todo[s->n_todo++] = piece;
      }
  return CELD_OK;
}

/* ------------------------------------------------------------------ one cut */

/* One pixel's pull to the labels below mid (> 0) or to the others (< 0): its own paint, and hard pixels beside it. */
static int32_t
pull (const Solver *s, const Piece *piece, size_t p)
{
  const CeldMultiway *m = s->problem;
  size_t   q[NEIGHBOURS], n;
  int32_t  capacity[NEIGHBOURS];
  uint32_t label[NEIGHBOURS + 1] = { m->seed[p] };
  int64_t  sum = 0;

  n = neighbours (m, p, q, capacity);
  for (size_t k = 0; k < n; k++)
    label[k + 1] = s->piece[q[k]] ? 0 : hard_label (s, q[k]);
  for (size_t k = 0; k <= n; k++)
    {
      size_t  rank;
      int32_t vote;

      if (!label[k])
        continue;
      rank = s->rank[label[k] - 1];
      vote = k ? capacity[k - 1] : m->vote[label[k] - 1];
      if (rank >= piece->from && rank < piece->to)
        sum += rank < piece->mid ? vote : -(int64_t) vote;
    }
  return (int32_t) (sum > MOST ? MOST : sum < -MOST ? -MOST : sum);
}

/* Edges only within the piece. */
static void
lay_out (const Solver *s, const Piece *piece, int32_t *east, int32_t *south, int32_t *terminal)
{
  const CeldMultiway *m = s->problem;
  size_t              w = (size_t) m->width, i = 0;

  for (int y = piece->top; y <= piece->bottom; y++)
    for (int x = piece->left; x <= piece->right; x++, i++)
      {
        size_t p = (size_t) y * w + (size_t) x;
        bool   inside = s->piece[p] == piece->id;

        east[i]     = inside && x < piece->right && s->piece[p + 1] == piece->id ? m->east[p] : 0;
        south[i]    = inside && y < piece->bottom && s->piece[p + w] == piece->id ? m->south[p] : 0;
        terminal[i] = inside ? pull (s, piece, p) : 0;
      }
}

/* Pixels on the source side become a piece of their own, for which only the labels below mid are left. */
static void
take_side (Solver *s, const Piece *piece, const uint8_t *side, uint32_t id)
{
  size_t i = 0;

  for (int y = piece->top; y <= piece->bottom; y++)
    for (int x = piece->left; x <= piece->right; x++, i++)
      {
        size_t p = (size_t) y * (size_t) s->problem->width + (size_t) x;

        if (s->piece[p] == piece->id && side[i])
          s->piece[p] = id;
      }
}

static CeldStatus
cut (Solver *s, const Piece *piece)
{
  int        w = piece->right - piece->left + 1, h = piece->bottom - piece->top + 1;
  size_t     n = (size_t) w * (size_t) h;
  int32_t   *east = celd_alloc (n, sizeof *east), *south = celd_alloc (n, sizeof *south);
  int32_t   *terminal = celd_alloc (n, sizeof *terminal);
  uint8_t   *side = celd_alloc (n, 1);
  Piece      first = *piece, others = *piece;
  double     done = (double) s->decided / (double) s->total;
  CeldHostPart   part;
  CeldHost   host = celd_host_part (&part, s->host, done, done);
  CeldStatus status = CELD_NO_MEMORY;

  if (!east || !south || !terminal || !side)
    goto done;
  lay_out (s, piece, east, south, terminal);
  status = celd_maxflow (w, h, east, south, terminal, &host, side, NULL);
  if (status != CELD_OK)
    goto done;
  first.id = ++s->last_id;
  first.to = others.from = piece->mid;
  take_side (s, piece, side, first.id);
  status = find_pieces (s, &first);
  if (status == CELD_OK)
    status = find_pieces (s, &others);

done:
  celd_free (east);
  celd_free (south);
  celd_free (terminal);
  celd_free (side);
  return status;
}

/* ------------------------------------------------------------------ the whole */

/* Hard seeds are decided from the start; everything else is one piece. */
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
      s->piece[p] = !s->label[p];
      s->total += !s->label[p];
    }
  s->last_id = 1;
}

CeldStatus
celd_multiway (const CeldMultiway *problem, const CeldHost *host, uint32_t *label)
{
  size_t     n = (size_t) problem->width * (size_t) problem->height;
  Piece      all = { 1, 0, 0, problem->n_labels, 0, 0, problem->width - 1, problem->height - 1 };
  Solver     s = { .problem = problem, .host = host, .label = label };
  CeldStatus status = CELD_NO_MEMORY;

  s.piece = celd_alloc (n, sizeof *s.piece);
  s.queue = celd_alloc (n, sizeof *s.queue);
  s.rank  = celd_alloc (problem->n_labels, sizeof *s.rank);
  s.seen  = celd_alloc0 (problem->n_labels, sizeof *s.seen);
  if (!s.piece || !s.queue || !s.rank || !s.seen)
    goto done;
  begin (&s);
  status = find_pieces (&s, &all);
  while (status == CELD_OK && s.n_todo)
    {
      Piece piece = s.todo[--s.n_todo];

      status = cut (&s, &piece);
    }

done:
  celd_free (s.piece);
  celd_free (s.queue);
  celd_free (s.rank);
  celd_free (s.seen);
  celd_free (s.todo);
  return status;
}
