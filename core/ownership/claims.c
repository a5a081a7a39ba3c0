/* Assignment of ink to pens: each point of an edge claims the pixels that its pen covers; the nearest region's claim
 * wins.
 *
 * A claim is a band along the edge, as wide as the pen.  A pixel that no pen covers goes to the pen that is nearest to
 * it; pixels beyond the reach of all claims are left to claim-remainder.c.
 *
 * Lines also continue straight where their edge ends.  Where an edge passes to another owner, its line runs on below
 * that one as long as there is ink; this claim is tentative and yields to all others.  At a convex corner of an outline
 * both sides are extended to the point where their centre lines meet, where the pen leaves a round tip.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "ownership/ownership.h"

#include <limits.h>
#include <math.h>

#define RAY_STEP           0.5f  /* pixels between the samples of a ray; chosen: no pixel is missed */
#define MAX_RAY_DISTANCE   0.7f  /* pixels between neighbouring rays, at most; chosen: less than a pixel's diagonal */
#define MAX_BAND_WIDTHS    3     /* pen widths; longest band: the tip of a sharp turn is about so far away; chosen */
#define TENTATIVE_EXCESS   1e-3f /* pixels; excess of a tentative claim inside its pen: below that of any pen that
                                  * misses the pixel */
#define RAY_CHUNK          32    /* samples of a ray computed at a time, for vectorisation */
#define LINE_WIDTHS        2.f   /* pen widths, besides 3 pixels, over which a line's direction is measured; chosen */
#define END_WIDTHS         0.25f /* the same for the direction in which a side of a corner ends; chosen */
#define MIN_TANGENT        2.f   /* pixels; shorter pieces have no reliable direction; chosen */
#define MAX_ROUNDED_POINTS 12    /* points; a rounded corner is at most so long; chosen */
#define MAX_LINE_WIDTHS    8.f   /* pen widths; longest continuation of a line; chosen */
#define MIN_CORNER_SINE    0.3f  /* sine of the least turn of a corner with a tip; chosen */

/* Claims the pixel (x,y), `excess` pixels beyond the pen.  The best claim is independent of the order: of claims
 * that cover the pixel, and of tentative ones that do, the one of the nearest region; otherwise the one with the
 * least excess.  Branch-free, because outcomes are unpredictable. */
static inline void
claim_pixel (const CeldClaimMap *c, const CeldClaim *claim, uint32_t rank, int x, int y, float excess)
{
  uint32_t *owner, other;
  float    *best;
  bool      wins, contested;

  if ((unsigned) x >= (unsigned) c->ink->width || (unsigned) y >= (unsigned) c->ink->height)
    return;
  owner = &CELD_AT (c->owner, x, y);
  best  = &CELD_AT (c->excess, x, y);
  if (*best == -INFINITY)
    return;
  other  = c->pens->level[*owner - (*owner > 0)];
  contested  = (((excess <= 0) & (*best <= 0)) | ((excess == TENTATIVE_EXCESS) & (*best == TENTATIVE_EXCESS)))
               & (*owner > 0) & (rank != other);
  wins   = contested ? rank > other : (excess < *best) | ((excess == *best) & (claim->label < *owner));
  *owner = wins ? claim->label : *owner;
  *best  = wins ? excess : *best;
}

/* ------------------------------------------------------------------ rays */

/* Pixels and depths below the edge of consecutive samples of a ray. */
typedef struct { int x[RAY_CHUNK + 1], y[RAY_CHUNK + 1]; float depth[RAY_CHUNK]; } RayPixels;

static CELD_CLONES void
follow_claim_ray (const CeldRay *from, int k, int n, RayPixels *at)
{
  for (int i = 0; i < n; i++)
    {
      float s = RAY_STEP / 2 + RAY_STEP * (float) (k + i), x = from->x + s * from->nx, y = from->y + s * from->ny;

      at->x[i]     = celd_floor (x);
      at->y[i]     = celd_floor (y);
      at->depth[i] = ((float) at->x[i] + 0.5f - from->x) * from->nx + ((float) at->y[i] + 0.5f - from->y) * from->ny;
    }
}

/* Several samples lie in one pixel and give the same claim: only the last of them makes it. */
static void
claim_ray (const CeldClaimMap *c, const CeldClaim *claim, const CeldRay *from, float length)
{
  uint32_t  rank = c->pens->level[claim->label - 1];
  int       n = length > RAY_STEP / 2 ? (int) ceilf ((length - RAY_STEP / 2) / RAY_STEP) : 0;
  RayPixels at;

  for (int k = 0; k < n; k += RAY_CHUNK)
    {
      int here = n - k < RAY_CHUNK ? n - k : RAY_CHUNK, pixels = 0, pixel[RAY_CHUNK];

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
          float excess = at.depth[i] - claim->width;

          if (claim->tentative)
            excess = excess <= 0 ? TENTATIVE_EXCESS : excess + 1;
          claim_pixel (c, claim, rank, at.x[i], at.y[i], excess);
        }
    }
}

/* ------------------------------------------------------------------ shapes */

/* The band between one point and the next. */
static void
claim_band (const CeldClaimMap *c, const CeldClaim *claim)
{
  const CeldRay *a = &claim->from, *b = &claim->to;
  float          length = claim->length;
  float apart = hypotf (b->x + length * b->nx - a->x - length * a->nx, b->y + length * b->ny - a->y - length * a->ny);
  int   rays = (int) (apart / MAX_RAY_DISTANCE) + 1;

  for (int k = 0; k < rays; k++)
    {
      float   t = (float) k / (float) rays, nx = a->nx + t * (b->nx - a->nx), ny = a->ny + t * (b->ny - a->ny);
      float   norm = hypotf (nx, ny);
      CeldRay p = { a->x + t * (b->x - a->x), a->y + t * (b->y - a->y), nx / norm, ny / norm };

      if (norm > 0.1f) /* skips rays between opposite normals */
        claim_ray (c, claim, &p, length);
    }
}

static bool
is_ink (const CeldPlane *ink, float x, float y)
{
  int u = celd_floor (x), v = celd_floor (y);

  return u >= 0 && v >= 0 && u < ink->width && v < ink->height && !celd_is_paper (CELD_AT (ink, u, v));
}

float
celd_claim_line_length (const CeldPlane *ink, const CeldClaim *line)
{
  for (float s = 0; s < line->length && line->tentative; s += MAX_RAY_DISTANCE)
    {
      CeldRay at = celd_claim_line_at (line, s);

      if (!is_ink (ink, at.x + at.nx * line->width / 2, at.y + at.ny * line->width / 2))
        return s;
    }
  return line->length;
}

static void
claim_line (const CeldClaimMap *c, const CeldClaim *claim)
{
  float reach = celd_claim_line_length (c->ink, claim);

  for (float s = 0; s < reach; s += MAX_RAY_DISTANCE)
    {
      CeldRay at = celd_claim_line_at (claim, s);

      claim_ray (c, claim, &at, claim->width);
    }
}

static void
claim_disc (const CeldClaimMap *c, const CeldClaim *claim)
{
  float x = claim->from.x, y = claim->from.y, radius = claim->width;

  for (int v = celd_floor (y - radius); v <= celd_floor (y + radius); v++)
    for (int u = celd_floor (x - radius); u <= celd_floor (x + radius); u++)
      {
        float away = hypotf ((float) u + 0.5f - x, (float) v + 0.5f - y);

        if (away <= radius)
          claim_pixel (c, claim, c->pens->level[claim->label - 1], u, v, away - radius);
      }
}

void
celd_claim_apply (const CeldClaimMap *c, const CeldClaim *claim)
{
  switch (claim->shape)
    {
    case CELD_CLAIM_BAND: claim_band (c, claim); break;
    case CELD_CLAIM_LINE: claim_line (c, claim); break;
    case CELD_CLAIM_DISC: claim_disc (c, claim); break;
    }
}

/* The next point along the loop (1) or against it (-1). */
static size_t
next_point (const CeldEdgeLoop *loop, size_t i, int direction)
{
  return direction > 0 ? (i + 1) % loop->n : (i + loop->n - 1) % loop->n;
}

/* Fits a straight line to the points that lead to point i in `direction`, over so many pen widths: point i and the
 * normal.  False if too few of them have the same owner. */
static bool
find_line (const CeldContourPens *pens, const CeldEdgeLoop *loop, size_t i, int direction, float widths, CeldRay *line)
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first], *p = &point[i], *q = p;
  const CeldEdgePen   *pen = &pens->pen[loop->first];
  float                along = 0, x, y, norm;
  size_t               k = i;

  while (along < widths * pen[i].width + 3)
    {
      size_t back = next_point (loop, k, -direction);

      if (pen[back].owner != pen[i].owner || point[back].corner || back == i)
        break;
      along += point[direction > 0 ? back : k].step;
      k      = back;
      q      = &point[k];
    }
  x    = (p->x - q->x) * (float) direction;
  y    = (p->y - q->y) * (float) direction;
  norm = hypotf (x, y);
  if (norm < MIN_TANGENT)
    return false;
  *line = (CeldRay) { p->x, p->y, y / norm, -x / norm };
  return true;
}

static CeldClaim
line_claim (uint32_t label, const CeldRay *from, int direction, float width, float length, bool tentative)
{
  return (CeldClaim) { CELD_CLAIM_LINE, label, *from, *from, width, length, direction, tentative };
}

/* ------------------------------------------------------------------ tips */

/* The tip of the corner between the points before and after it, where the centre lines of both sides meet:
 *   in + half n + s t = out + half n' - u t', with the tangents t and t' along the loop, over so many pen widths. */
static size_t
find_tip (const CeldContourPens *pens, const CeldEdgeLoop *loop, size_t before, size_t after, float widths,
          CeldClaim claim[3])
{
  const CeldEdgePen *pen = &pens->pen[loop->first];
  uint32_t           owner = pen[before].owner;
  float              width = (pen[before].width + pen[after].width) / 2, half = width / 2, cross, x, y, s, u;
  CeldRay            in, out, tip;

  if (!owner || owner != pen[after].owner || !find_line (pens, loop, before, 1, widths, &in) ||
      !find_line (pens, loop, after, -1, widths, &out))
    return 0;
  cross = in.nx * out.ny - in.ny * out.nx;
  if (!(cross > MIN_CORNER_SINE))
    return 0;
  x = out.x + half * out.nx - in.x - half * in.nx;
  y = out.y + half * out.ny - in.y - half * in.ny;
  s = (x * out.nx + y * out.ny) / cross;
  u = -(x * in.nx + y * in.ny) / cross;
  if (!(s >= 0 && u >= 0 && s < MAX_LINE_WIDTHS * width && u < MAX_LINE_WIDTHS * width))
    return 0;
  claim[0] = line_claim (owner, &in, 1, width, s, false);
  claim[1] = line_claim (owner, &out, -1, width, u, false);
  tip      = celd_claim_line_at (&claim[0], s);
  tip.x   += half * tip.nx;
  tip.y   += half * tip.ny;
  claim[2] = (CeldClaim) { CELD_CLAIM_DISC, owner, tip, tip, half, 0, 1, 0 };
  return 3;
}

static float
tip_length (const CeldClaim claim[3])
{
  return claim[0].length + claim[1].length;
}

/* The tip to which both sides lead as a whole, or with their ends alone if that is nearer: a line that turns within its
 * own width leaves a sharp corner, too, between sides that are curved. */
static size_t
claim_tip (const CeldContourPens *pens, const CeldEdgeLoop *loop, size_t before, size_t after, CeldClaim *claim)
{
  CeldClaim end[3];

  if (!find_tip (pens, loop, before, after, LINE_WIDTHS, claim))
    return 0;
  if (find_tip (pens, loop, before, after, END_WIDTHS, end) && tip_length (end) < tip_length (claim))
    memcpy (claim, end, sizeof end);
  return 3;
}

/* A corner consists of several points; the first one makes the claims. */
static size_t
claim_corner (const CeldContourPens *pens, const CeldEdgeLoop *loop, size_t i, CeldClaim *claim)
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first];
  size_t               last = i;

  if (!point[i].corner || point[next_point (loop, i, -1)].corner)
    return 0;
  while (point[next_point (loop, last, 1)].corner)
    last = next_point (loop, last, 1);
  return claim_tip (pens, loop, next_point (loop, i, -1), next_point (loop, last, 1), claim);
}

/* ------------------------------------------------------------------ continuation of lines */

/* Lines inside a region do not continue. */
static bool
is_outline (const CeldEdgePen *pen)
{
  return pen->owner && (pen->near != pen->far || pen->owner != pen->near);
}

/* The continuation of the line that ends at point i, the last one of its owner in `direction`. */
static size_t
extend_line (const CeldContourPens *pens, const CeldEdgeLoop *loop, size_t i, int direction, CeldClaim *claim)
{
  const CeldEdgePen *pen = &pens->pen[loop->first];
  uint32_t           owner = pen[i].owner;
  CeldRay            line;

  if (!is_outline (&pen[i]))
    return 0;
  for (int k = 0; k < MAX_ROUNDED_POINTS && pens->edges->point[loop->first + i].corner; k++)
    i = next_point (loop, i, -direction);
  if (pen[i].owner != owner || !find_line (pens, loop, i, direction, LINE_WIDTHS, &line))
    return 0;
  *claim = line_claim (owner, &line, direction, pen[i].width, MAX_LINE_WIDTHS * pen[i].width, true);
  return 1;
}

static size_t
claim_lines (const CeldContourPens *pens, const CeldEdgeLoop *loop, size_t i, CeldClaim *claim)
{
  const CeldEdgePen *pen = &pens->pen[loop->first];
  size_t             next = next_point (loop, i, 1), n = claim_corner (pens, loop, i, claim);

  if (pen[i].owner == pen[next].owner)
    return n;
  n += extend_line (pens, loop, i, 1, claim + n);
  return n + extend_line (pens, loop, next, -1, claim + n);
}

/* ------------------------------------------------------------------ claims of a point */

/* The length of a point's band behind the edge, in pixels. */
static float
band_length (const CeldEdgePoint *p, const CeldEdgePen *pen)
{
  return fminf (p->thickness + 0.5f, MAX_BAND_WIDTHS * pen->width + 2);
}

static CeldRay
ray_from (const CeldEdgePoint *p)
{
  return (CeldRay) { p->x, p->y, p->nx, p->ny };
}

size_t
celd_claims_at_point (const CeldContourPens *pens, const CeldEdgeLoop *loop, size_t i, CeldClaim claim[CELD_MAX_CLAIMS])
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first];
  const CeldEdgePen   *pen = &pens->pen[loop->first];
  size_t               next = i + 1 < loop->n ? i + 1 : 0, n = 0;

  if (pen[i].owner && pen[i].owner == pen[next].owner)
    claim[n++] = (CeldClaim) {
      CELD_CLAIM_BAND, pen[i].owner, ray_from (&point[i]), ray_from (&point[next]),
      (pen[i].width + pen[next].width) / 2,
      fmaxf (band_length (&point[i], &pen[i]), band_length (&point[next], &pen[next])), 1, 0
    };
  return n + claim_lines (pens, loop, i, claim + n);
}

CeldStatus
celd_claims_assign (const CeldContourPens *pens, const CeldPlane *ink, const CeldLabels *labels, const bool *solid,
                    const CeldHost *host, CeldLabels *owner, CeldPlane *excess)
{
  const CeldContourEdges *edges = pens->edges;
  CeldClaimMap            c = { pens, ink, owner, excess };
  CeldStatus              status = CELD_OK;

  celd_claims_reset (&c, labels, solid, (CeldRect) { 0, 0, ink->width, ink->height });
  for (size_t k = 0; k < edges->n_loops && status == CELD_OK; k++)
    {
      for (size_t i = 0; i < edges->loop[k].n; i++)
        {
          CeldClaim claim[CELD_MAX_CLAIMS];
          size_t    n = celd_claims_at_point (pens, &edges->loop[k], i, claim);

          for (size_t j = 0; j < n; j++)
            celd_claim_apply (&c, &claim[j]);
        }
      status = celd_progress (host, (double) (edges->loop[k].first + edges->loop[k].n) / (double) edges->n_points);
    }
  return status == CELD_OK ? celd_claims_finish (&c) : status;
}
