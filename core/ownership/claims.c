/* Ink goes to the pens: each edge claims the ink that its pen covers from there, and the nearest region's claim wins.
 *
 * A claim is a band along the edge, as wide as the pen.  Ink that no pen covers goes to the pen that misses it by
 * least; what is beyond all is in claim-remainder.c.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "ownership/contours.h"

#include <limits.h>
#include <math.h>

#define STEP   0.5f     /* pixels between the places of a ray */
#define APART  0.7f     /* and between rays at most */
#define BEYOND 3        /* pen widths that a band may reach: where a line turns sharply, its tip is so far away */
#define GUESS  1e-3f    /* by how much a guess misses what it covers: less than any pen that does miss it */
#define CHUNK   32      /* places of a ray at a time */

/* The pixel at (x,y), with so much of the pen left round it.  Whose claim is best does not depend on their order: of
 * those that cover the pixel the nearest region's, as of those that guess so, else that which misses it by least.
 * Without branches, since nobody can foretell them. */
static inline void
claim_pixel (const CeldClaims *c, const CeldClaim *claim, uint32_t rank, int x, int y, float over)
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
claim_ray (const CeldClaims *c, const CeldClaim *claim, const CeldRay *from, float length)
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
claim_band (const CeldClaims *c, const CeldClaim *claim)
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
is_ink (const CeldPlane *ink, float x, float y)
{
  int u = celd_round_down (x), v = celd_round_down (y);

  return u >= 0 && v >= 0 && u < ink->width && v < ink->height && !celd_is_paper (CELD_AT (ink, u, v));
}

float
celd_claim_reach (const CeldPlane *ink, const CeldClaim *line)
{
  for (float s = 0; s < line->length && line->guess; s += APART)
    {
      CeldRay at = celd_claim_place (line, s);

      if (!is_ink (ink, at.x + at.nx * line->width / 2, at.y + at.ny * line->width / 2))
        return s;
    }
  return line->length;
}

static void
claim_line (const CeldClaims *c, const CeldClaim *claim)
{
  float reach = celd_claim_reach (c->ink, claim);

  for (float s = 0; s < reach; s += APART)
    {
      CeldRay at = celd_claim_place (claim, s);

      claim_ray (c, claim, &at, claim->width);
    }
}

static void
claim_disc (const CeldClaims *c, const CeldClaim *claim)
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

void
celd_claim_make (const CeldClaims *c, const CeldClaim *claim)
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
      (pen[i].width + pen[next].width) / 2,
      fmaxf (length_of (&point[i], &pen[i]), length_of (&point[next], &pen[next])), 1, 0
    };
  return n + celd_line_claims (pens, loop, i, claim + n);
}

CeldStatus
celd_pens_claim (const CeldPens *pens, const CeldPlane *ink, const CeldLabels *labels, const bool *solid,
                 const CeldHost *host, CeldLabels *owner, CeldPlane *over)
{
  const CeldInkEdges *edges = pens->edges;
  CeldClaims          c = { pens, ink, owner, over };
  CeldStatus          status = CELD_OK;

  celd_claims_begin (&c, labels, solid, (CeldRect) { 0, 0, ink->width, ink->height });
  for (size_t k = 0; k < edges->n_loops && status == CELD_OK; k++)
    {
      for (size_t i = 0; i < edges->loop[k].n; i++)
        {
          CeldClaim claim[CELD_CLAIMS];
          size_t    n = celd_pen_claims (pens, &edges->loop[k], i, claim);

          for (size_t j = 0; j < n; j++)
            celd_claim_make (&c, &claim[j]);
        }
      status = celd_progress (host, (double) (edges->loop[k].first + edges->loop[k].n) / (double) edges->n_points);
    }
  return status == CELD_OK ? celd_claims_end (&c) : status;
}

#define TANGENT 2.f   /* pen widths that the direction of a line is taken over */
#define LEAST   2.f   /* pixels; shorter pieces have no direction */
#define ROUNDED 12    /* places that a corner may be rounded over */
#define LONGEST 8.f   /* pen widths that a line runs on at most */
#define CONVEX  0.3f  /* sine of the turn at a corner that has a tip */

/* Along the loop (1) or against it (-1). */
static size_t
next_place (const CeldEdgeLoop *loop, size_t i, int way)
{
  return way > 0 ? (i + 1) % loop->n : (i + loop->n - 1) % loop->n;
}

/* The straight line on which the places up to place i lie, coming that way: place i, and the normal.  False if there
 * are too few of one owner. */
static bool
find_line (const CeldPens *pens, const CeldEdgeLoop *loop, size_t i, int way, CeldRay *line)
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first], *p = &point[i], *q = p;
  const CeldPen       *pen = &pens->pen[loop->first];
  float                along = 0, x, y, norm;
  size_t               k = i;

  while (along < TANGENT * pen[i].width + 3)
    {
      size_t back = next_place (loop, k, -way);

      if (pen[back].owner != pen[i].owner || point[back].corner || back == i)
        break;
      along += point[way > 0 ? back : k].step;
      k      = back;
      q      = &point[k];
    }
  x    = (p->x - q->x) * (float) way;
  y    = (p->y - q->y) * (float) way;
  norm = hypotf (x, y);
  if (norm < LEAST)
    return false;
  *line = (CeldRay) { p->x, p->y, y / norm, -x / norm };
  return true;
}

static CeldClaim
line_of (uint32_t label, const CeldRay *from, int way, float width, float length, bool guess)
{
  return (CeldClaim) { CELD_CLAIM_LINE, label, *from, *from, width, length, way, guess };
}

/* ------------------------------------------------------------------ tips */

/* The corner between the places before and after it.  Its tip is where the middles of both sides meet:
 * in + half n + s t = out + half n' - u t', with the tangents t and t' along the loop. */
static size_t
claim_tip (const CeldPens *pens, const CeldEdgeLoop *loop, size_t before, size_t after, CeldClaim *claim)
{
  const CeldPen *pen = &pens->pen[loop->first];
  uint32_t       owner = pen[before].owner;
  float          width = (pen[before].width + pen[after].width) / 2, half = width / 2, cross, x, y, s, u;
  CeldRay        in, out, tip;

  if (!owner || owner != pen[after].owner || !find_line (pens, loop, before, 1, &in) ||
      !find_line (pens, loop, after, -1, &out))
    return 0;
  cross = in.nx * out.ny - in.ny * out.nx;
  if (!(cross > CONVEX))
    return 0;
  x = out.x + half * out.nx - in.x - half * in.nx;
  y = out.y + half * out.ny - in.y - half * in.ny;
  s = (x * out.nx + y * out.ny) / cross;
  u = -(x * in.nx + y * in.ny) / cross;
  if (!(s >= 0 && u >= 0 && s < LONGEST * width && u < LONGEST * width))
    return 0;
  claim[0] = line_of (owner, &in, 1, width, s, false);
  claim[1] = line_of (owner, &out, -1, width, u, false);
  tip      = celd_claim_place (&claim[0], s);
  tip.x   += half * tip.nx;
  tip.y   += half * tip.ny;
  claim[2] = (CeldClaim) { CELD_CLAIM_DISC, owner, tip, tip, half, 0, 1, 0 };
  return 3;
}

/* Corners are several places long: the first one has the tip. */
static size_t
claim_corner (const CeldPens *pens, const CeldEdgeLoop *loop, size_t i, CeldClaim *claim)
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first];
  size_t               last = i;

  if (!point[i].corner || point[next_place (loop, i, -1)].corner)
    return 0;
  while (point[next_place (loop, last, 1)].corner)
    last = next_place (loop, last, 1);
  return claim_tip (pens, loop, next_place (loop, i, -1), next_place (loop, last, 1), claim);
}

/* ------------------------------------------------------------------ lines that run on */

/* Lines inside a region end where they end. */
static bool
is_outline (const CeldPen *pen)
{
  return pen->owner && (pen->near != pen->far || pen->owner != pen->near);
}

/* From place i on, the last one of its owner that way. */
static size_t
run_on (const CeldPens *pens, const CeldEdgeLoop *loop, size_t i, int way, CeldClaim *claim)
{
  const CeldPen *pen = &pens->pen[loop->first];
  uint32_t       owner = pen[i].owner;
  CeldRay        line;

  if (!is_outline (&pen[i]))
    return 0;
  for (int k = 0; k < ROUNDED && pens->edges->point[loop->first + i].corner; k++)
    i = next_place (loop, i, -way);
  if (pen[i].owner != owner || !find_line (pens, loop, i, way, &line))
    return 0;
  *claim = line_of (owner, &line, way, pen[i].width, LONGEST * pen[i].width, true);
  return 1;
}

size_t
celd_line_claims (const CeldPens *pens, const CeldEdgeLoop *loop, size_t i, CeldClaim *claim)
{
  const CeldPen *pen = &pens->pen[loop->first];
  size_t         next = next_place (loop, i, 1), n = claim_corner (pens, loop, i, claim);

  if (pen[i].owner == pen[next].owner)
    return n;
  n += run_on (pens, loop, i, 1, claim + n);
  return n + run_on (pens, loop, next, -1, claim + n);
}
