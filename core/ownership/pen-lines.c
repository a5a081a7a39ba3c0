/* Where outlines run on straight: below nearer ones, and to the tips of their corners.
 *
 * Where an edge passes to another owner, its line runs on below that one: the band goes on straight as long as there
 * is ink.  That is a guess, which gives way to all that is known.  Where an outline turns round a corner of its region,
 * its middle has a corner, too: both sides run on to it, and the pen is round there.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ownership/ink-edges.h"
#include "ownership/pens.h"

#include <math.h>

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
