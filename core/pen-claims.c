/* Ink goes to the pens: each edge claims the ink that its pen covers from there, and the nearest region's claim wins.
 *
 * A claim is a band along the edge, as wide as the pen.  Ink that no pen covers goes to the pen that misses it by
 * least, and what is beyond all, like areas filled with black, to the nearest ink that is claimed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "pens.h"

#include <limits.h>
#include <math.h>

#define STEP   0.5f     /* pixels between the places of a ray */
#define APART  0.7f     /* and between rays at most */
#define BEYOND 3        /* pen widths that a band may reach: where a line turns sharply, its tip is so far away */
#define SOLID  10       /* a label is ink throughout if less than a tenth of it is paper */
#define GUESS  1e-3f    /* by how much a guess misses what it covers: less than any pen that does miss it */
#define CHUNK   32      /* places of a ray at a time */

/* Who has claimed which ink. */
typedef struct
{
  const CeldPens  *pens;
  const CeldPlane *ink;
  CeldLabels      *owner;       /* 0 = ink that nobody has claimed */
  CeldPlane       *over;        /* of ink: by how much its owner's pen misses it, <= 0 not at all; of paper -INFINITY */
} Claims;

/* The pixel at (x,y), with so much of the pen left round it.  Whose claim is best does not depend on their order: of
 * those that cover the pixel the nearest region's, as of those that guess so, else that which misses it by least.
 * Without branches, since nobody can foretell them. */
static inline void
claim_pixel (const Claims *c, const CeldClaim *claim, uint32_t rank, int x, int y, float over)
{
  uint32_t *owner, other;
  float    *best;
  bool      wins, depth;

  if ((unsigned) x >= (unsigned) c->ink->width || (unsigned) y >= (unsigned) c->ink->height)
    return;
  owner = &CELD_AT (c->owner, x, y);
  best  = &CELD_AT (c->over, x, y);
  if (*best == -INFINITY)
    return;
  other  = c->pens->level[*owner - (*owner > 0)];
  depth  = (((over <= 0) & (*best <= 0)) | ((over == GUESS) & (*best == GUESS))) & (*owner > 0) & (rank != other);
  wins   = depth ? rank > other : (over < *best) | ((over == *best) & (claim->label < *owner));
  *owner = wins ? claim->label : *owner;
  *best  = wins ? over : *best;
}

/* ------------------------------------------------------------------ rays */

/* Places of a ray, from number k on. */
typedef struct { int x[CHUNK + 1], y[CHUNK + 1]; float depth[CHUNK]; } Places;

static CELD_CLONES void
follow_claim_ray (const CeldRay *from, int k, int n, Places *at)
{
  for (int i = 0; i < n; i++)
    {
      float s = STEP / 2 + STEP * (float) (k + i), x = from->x + s * from->nx, y = from->y + s * from->ny;

      at->x[i]     = celd_round_down (x);
      at->y[i]     = celd_round_down (y);
      at->depth[i] = ((float) at->x[i] + 0.5f - from->x) * from->nx + ((float) at->y[i] + 0.5f - from->y) * from->ny;
    }
}

/* Two or three places lie in a pixel, to which they say the same: the last of them does it. */
static void
claim_ray (const Claims *c, const CeldClaim *claim, const CeldRay *from, float length)
{
  uint32_t rank = c->pens->level[claim->label - 1];
  int      n = length > STEP / 2 ? (int) ceilf ((length - STEP / 2) / STEP) : 0;
  Places   at;

  for (int k = 0; k < n; k += CHUNK)
    {
      int here = n - k < CHUNK ? n - k : CHUNK, pixels = 0, pixel[CHUNK];

      follow_claim_ray (from, k, here, &at);
      at.x[here] = at.y[here] = INT_MIN;
      for (int i = 0; i < here; i++)
        {
          pixel[pixels] = i;
          pixels += (at.x[i] != at.x[i + 1]) | (at.y[i] != at.y[i + 1]);
        }
      for (int j = 0; j < pixels; j++)
        {
          int   i = pixel[j];
          float over = at.depth[i] - claim->width;

          if (claim->guess)
            over = over <= 0 ? GUESS : over + 1;
          claim_pixel (c, claim, rank, at.x[i], at.y[i], over);
        }
    }
}

/* ------------------------------------------------------------------ shapes */

/* From one place to the next. */
static void
claim_band (const Claims *c, const CeldClaim *claim)
{
  const CeldRay *a = &claim->from, *b = &claim->to;
  float          length = claim->length;
  float apart = hypotf (b->x + length * b->nx - a->x - length * a->nx, b->y + length * b->ny - a->y - length * a->ny);
  int   rays = (int) (apart / APART) + 1;

  for (int k = 0; k < rays; k++)
    {
      float   t = (float) k / (float) rays, nx = a->nx + t * (b->nx - a->nx), ny = a->ny + t * (b->ny - a->ny);
      float   norm = hypotf (nx, ny);
      CeldRay p = { a->x + t * (b->x - a->x), a->y + t * (b->y - a->y), nx / norm, ny / norm };

      if (norm > 0.1f) /* not between opposite normals */
        claim_ray (c, claim, &p, length);
    }
}

static bool
is_ink (const Claims *c, float x, float y)
{
  int u = celd_round_down (x), v = celd_round_down (y);

  return u >= 0 && v >= 0 && u < c->ink->width && v < c->ink->height && !celd_is_paper (CELD_AT (c->ink, u, v));
}

/* A guess goes on only as long as its middle is ink. */
static void
claim_line (const Claims *c, const CeldClaim *claim)
{
  for (float s = 0; s < claim->length; s += APART)
    {
      CeldRay at = celd_claim_place (claim, s);

      if (claim->guess && !is_ink (c, at.x + at.nx * claim->width / 2, at.y + at.ny * claim->width / 2))
        break;
      claim_ray (c, claim, &at, claim->width);
    }
}

static void
claim_disc (const Claims *c, const CeldClaim *claim)
{
  float x = claim->from.x, y = claim->from.y, radius = claim->width;

  for (int v = celd_round_down (y - radius); v <= celd_round_down (y + radius); v++)
    for (int u = celd_round_down (x - radius); u <= celd_round_down (x + radius); u++)
      {
        float away = hypotf ((float) u + 0.5f - x, (float) v + 0.5f - y);

        if (away <= radius)
          claim_pixel (c, claim, c->pens->level[claim->label - 1], u, v, away - radius);
      }
}

static void
make_claim (const Claims *c, const CeldClaim *claim)
{
  switch (claim->shape)
    {
    case CELD_CLAIM_BAND: claim_band (c, claim); break;
    case CELD_CLAIM_LINE: claim_line (c, claim); break;
    case CELD_CLAIM_DISC: claim_disc (c, claim); break;
    }
}

/* ------------------------------------------------------------------ what a place claims */

/* How far a band goes from a place. */
static float
length_of (const CeldEdgePoint *p, const CeldPen *pen)
{
  return fminf (p->through + 0.5f, BEYOND * pen->width + 2);
}

static CeldRay
ray_from (const CeldEdgePoint *p)
{
  return (CeldRay) { p->x, p->y, p->nx, p->ny };
}

size_t
celd_pen_claims (const CeldPens *pens, const CeldEdgeLoop *loop, size_t i, CeldClaim claim[CELD_CLAIMS])
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first];
  const CeldPen       *pen = &pens->pen[loop->first];
  size_t               next = i + 1 < loop->n ? i + 1 : 0, n = 0;

  if (pen[i].owner && pen[i].owner == pen[next].owner)
    claim[n++] = (CeldClaim) {
      CELD_CLAIM_BAND, pen[i].owner, ray_from (&point[i]), ray_from (&point[next]),
      (pen[i].width + pen[next].width) / 2, fmaxf (length_of (&point[i], &pen[i]), length_of (&point[next], &pen[next])),
      1, 0
    };
  return n + celd_line_claims (pens, loop, i, claim + n);
}

/* ------------------------------------------------------------------ the rest */

#define WAITING UINT32_MAX /* in place of an owner */

/* Ink that nobody has claimed, and whose it is to be. */
typedef struct { int32_t pixel; uint32_t owner; } Rest;

/* The up to four neighbours of a pixel. */
static int
neighbours (const CeldPlane *ink, int32_t pixel, int near[4][2])
{
  static const int step[4][2] = { { 0, -1 }, { -1, 0 }, { 1, 0 }, { 0, 1 } };
  int              x = pixel % ink->width, y = pixel / ink->width, n = 0;

  for (int k = 0; k < 4; k++)
    {
      int u = x + step[k][0], v = y + step[k][1];

      if (u >= 0 && v >= 0 && u < ink->width && v < ink->height)
        {
          near[n][0]   = u;
          near[n++][1] = v;
        }
    }
  return n;
}

/* The first neighbour that has an owner; 0: none has. */
static uint32_t
owner_beside (const Claims *c, int32_t pixel)
{
  int near[4][2], n = neighbours (c->ink, pixel, near);

  for (int k = 0; k < n; k++)
    {
      uint32_t owner = CELD_AT (c->owner, near[k][0], near[k][1]);

      if (owner && owner != WAITING)
        return owner;
    }
  return 0;
}

/* The pixels without an owner: beside those that have one first, and how many of these there are. */
static CeldStatus
list_rest (const Claims *c, Rest **list, size_t *n, size_t *first)
{
  size_t room = 0;

  *n = *first = 0;
  for (int y = 0; y < c->ink->height; y++)
    for (int x = 0; x < c->ink->width; x++)
      room += !CELD_AT (c->owner, x, y);
  *list = celd_alloc (room, sizeof **list);
  if (!*list)
    return CELD_NO_MEMORY;
  for (int y = 0; y < c->ink->height && *n < room; y++)
    for (int x = 0; x < c->ink->width; x++)
      if (!CELD_AT (c->owner, x, y))
        {
          int32_t pixel = (int32_t) (y * c->ink->width + x);
          Rest    rest = { pixel, owner_beside (c, pixel) };

          (*list)[(*n)++] = rest;
          if (rest.owner)
            {
              (*list)[*n - 1]     = (*list)[*first];
              (*list)[(*first)++] = rest;
            }
        }
  return CELD_OK;
}

/* Ink that nobody has claimed goes to the nearest pixel that has an owner, from neighbour to neighbour; of several the
 * first in reading order, ring by ring. */
static CeldStatus
settle_rest (const Claims *c)
{
  Rest      *rest;
  size_t     n, from = 0, end;
  CeldStatus status = list_rest (c, &rest, &n, &end);

  if (status != CELD_OK)
    return status;
  while (from < end)
    {
      size_t next = end;

      for (size_t i = from; i < end; i++)
        CELD_AT (c->owner, rest[i].pixel % c->ink->width, rest[i].pixel / c->ink->width) = rest[i].owner;
      for (size_t i = from; i < end; i++)
        {
          int near[4][2], k = neighbours (c->ink, rest[i].pixel, near);

          for (int j = 0; j < k; j++)
            if (!CELD_AT (c->owner, near[j][0], near[j][1]))
              {
                CELD_AT (c->owner, near[j][0], near[j][1]) = WAITING;
                rest[next++].pixel = (int32_t) (near[j][1] * c->ink->width + near[j][0]);
              }
        }
      for (size_t i = end; i < next; i++)
        rest[i].owner = owner_beside (c, rest[i].pixel);
      from = end;
      end  = next;
    }
  celd_free (rest);
  return CELD_OK;
}

/* ------------------------------------------------------------------ whose the pixels are to begin with */

/* Paper, and all of a label that is hardly anything but ink, like a black shoe with a scribble of its own, is settled;
 * so is everything if there is nothing to go by. */
static CeldStatus
settle_paper (const Claims *c)
{
  size_t *all = celd_alloc0 (c->pens->n, sizeof *all), *paper = celd_alloc0 (c->pens->n, sizeof *paper);

  for (int y = 0; all && paper && y < c->ink->height; y++)
    for (int x = 0, end; x < c->ink->width; x = end)
      {
        const uint32_t *label = &CELD_AT (c->owner, 0, y);
        const float    *ink = &CELD_AT (c->ink, 0, y);
        size_t          bright = 0;

        for (end = x; end < c->ink->width && label[end] == label[x]; end++)
          bright += celd_is_paper (ink[end]);
        all[label[x] - 1]   += (size_t) (end - x);
        paper[label[x] - 1] += bright;
      }
  for (int y = 0; all && paper && y < c->ink->height; y++)
    for (int x = 0; x < c->ink->width; x++)
      {
        uint32_t *owner = &CELD_AT (c->owner, x, y);
        bool      settled = celd_is_paper (CELD_AT (c->ink, x, y)) || SOLID * paper[*owner - 1] < all[*owner - 1];

        CELD_AT (c->over, x, y) = settled ? -INFINITY : INFINITY;
        if (!settled)
          *owner = 0;
      }
  celd_free (all);
  celd_free (paper);
  return all && paper ? CELD_OK : CELD_NO_MEMORY;
}

CeldStatus
celd_pens_claim (const CeldPens *pens, const CeldPlane *ink, const CeldRun *run, CeldLabels *owner, CeldPlane *over)
{
  const CeldInkEdges *edges = pens->edges;
  Claims              c = { pens, ink, owner, over };
  CeldStatus          status = settle_paper (&c);

  for (size_t k = 0; k < edges->n_loops && status == CELD_OK; k++)
    {
      for (size_t i = 0; i < edges->loop[k].n; i++)
        {
          CeldClaim claim[CELD_CLAIMS];
          size_t    n = celd_pen_claims (pens, &edges->loop[k], i, claim);

          for (size_t j = 0; j < n; j++)
            make_claim (&c, &claim[j]);
        }
      status = celd_step (run, (double) (edges->loop[k].first + edges->loop[k].n) / (double) edges->n_points);
    }
  return status == CELD_OK ? settle_rest (&c) : status;
}
