/* Where outlines run on straight: below nearer ones, and to the tips of their corners.
 *
 * Where an edge passes to another owner, its line runs on below that one: the band goes on straight as long as there
 * is ink.  That is a guess, which gives way to all that is known.  Where an outline turns round a corner of its region,
 * its middle has a corner, too: both sides run on to it, and the pen is round there.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "pens.h"

#include <math.h>

#define TANGENT 2.f   /* pen widths that the direction of a line is taken over */
#define LEAST   2.f   /* pixels; shorter pieces have no direction */
#define ROUNDED 12    /* places that a corner may be rounded over */
#define LONGEST 8.f   /* pen widths that a line runs on at most */
#define CONVEX  0.3f  /* sine of the turn at a corner that has a tip */
#define STEP    0.7f  /* pixels between the rays of a band */

/* Along the loop (1) or against it (-1). */
static size_t
next_place (const CeldEdgeLoop *loop, size_t i, int way)
{
  return way > 0 ? (i + 1) % loop->n : (i + loop->n - 1) % loop->n;
}

/* The straight line on which the places up to place i lie, coming that way: place i, and the normal.  False if there
 * are too few of one owner. */
static bool
find_line (const CeldPens *pens, const CeldEdgeLoop *loop, size_t i, int way, CeldEdgePoint *line)
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first], *p = &point[i], *q = p;
  const CeldPen       *pen = &pens->pen[loop->first];
  float                along = 0, x, y, norm;
  size_t               k = i;

  while (along < TANGENT * pen[i].width + 3)
    {
      size_t back = next_place (loop, k, -way);

      if (pen[back].owner != pen[i].owner || pen[back].corner || back == i)
        break;
      along += celd_edge_distance (&point[back], &point[k]);
      k      = back;
      q      = &point[k];
    }
  x    = (p->x - q->x) * (float) way;
  y    = (p->y - q->y) * (float) way;
  norm = hypotf (x, y);
  if (norm < LEAST)
    return false;
  *line = (CeldEdgePoint) { .x = p->x, .y = p->y, .nx = y / norm, .ny = -x / norm };
  return true;
}

/* The place so far on along a line. */
static CeldEdgePoint
place_on (const CeldEdgePoint *line, int way, float along)
{
  CeldEdgePoint at = *line;

  at.x -= (float) way * along * line->ny;
  at.y += (float) way * along * line->nx;
  return at;
}

static bool
is_ink (const CeldClaims *c, float x, float y)
{
  int u = (int) floorf (x), v = (int) floorf (y);

  return u >= 0 && v >= 0 && u < c->ink->width && v < c->ink->height && !celd_is_paper (CELD_AT (c->ink, u, v));
}

/* A band along a line, from its place on; a guess goes on only as long as its middle is ink. */
static void
claim_line (const CeldClaims *c, uint32_t label, const CeldEdgePoint *line, int way, float width, float length,
            bool guess)
{
  for (float s = 0; s < length; s += STEP)
    {
      CeldEdgePoint at = place_on (line, way, s);

      if (guess && !is_ink (c, at.x + at.nx * width / 2, at.y + at.ny * width / 2))
        break;
      celd_claim_ray (c, label, &at, width, width, guess);
    }
}

/* ------------------------------------------------------------------ tips */

static void
claim_disc (const CeldClaims *c, uint32_t label, float x, float y, float radius)
{
  for (int v = (int) floorf (y - radius); v <= (int) floorf (y + radius); v++)
    for (int u = (int) floorf (x - radius); u <= (int) floorf (x + radius); u++)
      {
        float away = hypotf ((float) u + 0.5f - x, (float) v + 0.5f - y);

        if (away <= radius)
          celd_claim_pixel (c, label, u, v, away - radius, false);
      }
}

/* The corner between the places before and after it.  Its tip is where the middles of both sides meet:
 * in + half n + s t = out + half n' - u t', with the tangents t and t' along the loop. */
static void
claim_tip (const CeldClaims *c, const CeldEdgeLoop *loop, size_t before, size_t after)
{
  const CeldPen *pen = &c->pens->pen[loop->first];
  uint32_t       owner = pen[before].owner;
  float          width = (pen[before].width + pen[after].width) / 2, half = width / 2, cross, x, y, s, u;
  CeldEdgePoint  in, out, tip;

  if (!owner || owner != pen[after].owner || !find_line (c->pens, loop, before, 1, &in) ||
      !find_line (c->pens, loop, after, -1, &out))
    return;
  cross = in.nx * out.ny - in.ny * out.nx;
  if (!(cross > CONVEX))
    return;
  x = out.x + half * out.nx - in.x - half * in.nx;
  y = out.y + half * out.ny - in.y - half * in.ny;
  s = (x * out.nx + y * out.ny) / cross;
  u = -(x * in.nx + y * in.ny) / cross;
  if (!(s >= 0 && u >= 0 && s < LONGEST * width && u < LONGEST * width))
    return;
  claim_line (c, owner, &in, 1, width, s, false);
  claim_line (c, owner, &out, -1, width, u, false);
  tip = place_on (&in, 1, s);
  claim_disc (c, owner, tip.x + half * tip.nx, tip.y + half * tip.ny, half);
}

/* Corners are several places long. */
static void
claim_tips (const CeldClaims *c, const CeldEdgeLoop *loop)
{
  const CeldPen *pen = &c->pens->pen[loop->first];

  for (size_t i = 0; i < loop->n; i++)
    if (pen[i].corner && !pen[next_place (loop, i, -1)].corner)
      {
        size_t last = i;

        while (pen[next_place (loop, last, 1)].corner)
          last = next_place (loop, last, 1);
        claim_tip (c, loop, next_place (loop, i, -1), next_place (loop, last, 1));
      }
}

/* ------------------------------------------------------------------ lines that run on */

/* Lines inside a region end where they end. */
static bool
is_outline (const CeldPen *pen)
{
  return pen->owner && (pen->near != pen->far || pen->owner != pen->near);
}

/* From place i on, the last one of its owner that way. */
static void
run_on (const CeldClaims *c, const CeldEdgeLoop *loop, size_t i, int way)
{
  const CeldPen *pen = &c->pens->pen[loop->first];
  uint32_t       owner = pen[i].owner;
  CeldEdgePoint  line;

  if (!is_outline (&pen[i]))
    return;
  for (int k = 0; k < ROUNDED && pen[i].corner; k++)
    i = next_place (loop, i, -way);
  if (pen[i].owner == owner && find_line (c->pens, loop, i, way, &line))
    claim_line (c, owner, &line, way, pen[i].width, LONGEST * pen[i].width, true);
}

void
celd_claim_lines (const CeldClaims *c, const CeldEdgeLoop *loop)
{
  const CeldPen *pen = &c->pens->pen[loop->first];

  claim_tips (c, loop);
  for (size_t i = 0; i < loop->n; i++)
    {
      size_t next = next_place (loop, i, 1);

      if (pen[i].owner != pen[next].owner)
        {
          run_on (c, loop, i, 1);
          run_on (c, loop, next, -1);
        }
    }
}
