/* The shifts of tiles that keep what is nearer in front: minimizes over u
 *
 *     sum over links  edges/side (u_a - u_b)^2  +  sum over pixels  u^2 / reach^2, or u^2 where it shall stay flat,
 *       +  STIFF sum over cuts  edges max (0, least - (u_a - u_b))^2,
 *
 * which is convex and has no kinks.  By Newton's method: each step solves the quadratic of the cuts that are not kept,
 * by conjugate gradients, and goes as far along it as the true sum falls.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief/relief.h"

#include <math.h>

#define STIFF       4.0   /* of a cut for each of its edges; the surface has 1 a pixel */
#define MOST_STEPS  40
#define MOST_ROUNDS 60    /* of conjugate gradients, in a step */
#define INNER       0.05  /* of the residual, to which a step is solved */
#define DONE        3e-4  /* of the first gradient */

typedef struct
{
  const CeldReliefTiles    *tiles;
  const CeldTilePair *cut;
  size_t              cuts;
  double              hold;     /* of a pixel at its place, unless it shall stay flat */
  uint8_t            *active;   /* of each cut */
  double             *u, *gradient, *step, *r, *p, *q, *diagonal;
} Shift;

static double
lack (const Shift *s, const double *u, size_t i)
{
  return (double) s->cut[i].least - (u[s->cut[i].a] - u[s->cut[i].b]);
}

/* How strongly a tile is held at its place. */
static double
hold_of (const Shift *s, uint32_t k)
{
  return s->hold * (double) s->tiles->area[k] + (double) s->tiles->flat[k];
}

static double
dot (const double *a, const double *b, size_t n)
{
  double sum = 0;

  for (size_t i = 0; i < n; i++)
    sum += a[i] * b[i];
  return sum;
}

/* to = A v, of links and places; with `with_cuts` also of the active cuts. */
static void
apply (const Shift *s, const double *v, bool with_cuts, double *to)
{
  const CeldReliefTiles *c = s->tiles;

  for (uint32_t k = 0; k < c->n; k++)
    to[k] = hold_of (s, k) * v[k];
  for (size_t i = 0; i < c->links; i++)
    {
      double flow = (double) c->link[i].edges / c->side * (v[c->link[i].a] - v[c->link[i].b]);

      to[c->link[i].a] += flow;
      to[c->link[i].b] -= flow;
    }
  for (size_t i = 0; i < s->cuts && with_cuts; i++)
    if (s->active[i])
      {
        double flow = STIFF * (double) s->cut[i].edges * (v[s->cut[i].a] - v[s->cut[i].b]);

        to[s->cut[i].a] += flow;
        to[s->cut[i].b] -= flow;
      }
}

/* The gradient at u, the cuts that are active there, and the diagonal with them. */
static void
look (Shift *s)
{
  const CeldReliefTiles *c = s->tiles;

  apply (s, s->u, false, s->gradient);
  for (uint32_t k = 0; k < c->n; k++)
    s->diagonal[k] = hold_of (s, k);
  for (size_t i = 0; i < c->links; i++)
    {
      s->diagonal[c->link[i].a] += (double) c->link[i].edges / c->side;
      s->diagonal[c->link[i].b] += (double) c->link[i].edges / c->side;
    }
  for (size_t i = 0; i < s->cuts; i++)
    {
      double lacking = lack (s, s->u, i), stiff = STIFF * (double) s->cut[i].edges;

      s->active[i] = lacking > 0;
      if (lacking <= 0)
        continue;
      s->gradient[s->cut[i].a] -= stiff * lacking;
      s->gradient[s->cut[i].b] += stiff * lacking;
      s->diagonal[s->cut[i].a] += stiff;
      s->diagonal[s->cut[i].b] += stiff;
    }
}

/* The step that takes the gradient away, about. */
static void
find_step (Shift *s)
{
  size_t n = s->tiles->n;
  double left = 0, first;

  for (size_t k = 0; k < n; k++)
    {
      s->step[k] = 0;
      s->r[k]    = -s->gradient[k];
      s->p[k]    = s->r[k] / s->diagonal[k];
      left      += s->r[k] * s->p[k];
    }
  first = left;
  for (int round = 0; round < MOST_ROUNDS && left > INNER * INNER * first; round++)
    {
      double alpha, next = 0;

      apply (s, s->p, true, s->q);
      alpha = left / dot (s->p, s->q, n);
      for (size_t k = 0; k < n; k++)
        {
          s->step[k] += alpha * s->p[k];
          s->r[k]    -= alpha * s->q[k];
          next       += s->r[k] * s->r[k] / s->diagonal[k];
        }
      for (size_t k = 0; k < n; k++)
        s->p[k] = s->r[k] / s->diagonal[k] + next / left * s->p[k];
      left = next;
    }
}

/* How the sum changes at u + t step along the step; rising in t. */
static double
change_at (const Shift *s, double t, double slope, double bend)
{
  double sum = slope + t * bend;

  for (size_t i = 0; i < s->cuts; i++)
    {
      double away = s->step[s->cut[i].a] - s->step[s->cut[i].b], lacking = lack (s, s->u, i) - t * away;

      if (lacking > 0)
        sum -= STIFF * (double) s->cut[i].edges * lacking * away;
    }
  return sum;
}

/* How far to go: where the sum is least. */
static double
find_length (Shift *s)
{
  size_t n = s->tiles->n;
  double low = 0, high = 1, slope, bend;

  apply (s, s->u, false, s->q);
  slope = dot (s->q, s->step, n);
  apply (s, s->step, false, s->q);
  bend = dot (s->q, s->step, n);
  while (high < 64 && change_at (s, high, slope, bend) < 0)
    {
      low   = high;
      high *= 2;
    }
  for (int i = 0; i < 12; i++)
    {
      double middle = (low + high) / 2;

      if (change_at (s, middle, slope, bend) < 0)
        low = middle;
      else
        high = middle;
    }
  return low;
}

static CeldStatus
descend (Shift *s, const CeldHost *host)
{
  size_t n = s->tiles->n;
  double first = 0;

  for (int i = 0; i < MOST_STEPS; i++)
    {
      double size, length;

      if (celd_progress (host, (double) i / MOST_STEPS) != CELD_OK)
        return CELD_CANCELLED;
      look (s);
      size  = sqrt (dot (s->gradient, s->gradient, n));
      first = i ? first : size;
      if (size <= DONE * first)
        break;
      find_step (s);
      length = find_length (s);
      if (length <= 0)
        break;
      for (size_t k = 0; k < n; k++)
        s->u[k] += length * s->step[k];
    }
  return CELD_OK;
}

CeldStatus
celd_shift_tiles (const CeldReliefTiles *tiles, const CeldTilePair *cut, size_t cuts, double reach, const CeldHost *host,
                  double *shift)
{
  size_t     n = tiles->n;
  double    *space = celd_alloc0 (n, 6 * sizeof *space);
  Shift      s = { .tiles = tiles, .cut = cut, .cuts = cuts, .hold = 1 / (reach * reach), .u = shift };
  CeldStatus status = CELD_NO_MEMORY;

  s.active = celd_alloc0 (cuts, 1);
  if (!space || !s.active)
    goto done;
  s.gradient = space, s.step = space + n, s.r = space + 2 * n;
  s.p = space + 3 * n, s.q = space + 4 * n, s.diagonal = space + 5 * n;
  for (size_t k = 0; k < n; k++)
    shift[k] = 0;
  status = descend (&s, host);

done:
  celd_free (space);
  celd_free (s.active);
  return status;
}
