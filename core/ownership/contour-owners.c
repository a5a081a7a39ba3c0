/* Owners of contours: each region of a cartoon is outlined with a pen of its own, drawn over whatever lies behind it.
 *
 * Of two regions with ink between them, the nearer one drew it.  Ink that is thicker than this region's pen
 * (pen-width.c) contains other lines, too.  Then the line next to the paper has the owner of the nearest point along
 * the edge whose owner is certain, up to a corner; or, round the corner, an owner between both labels in depth, or the
 * paper's own label if a nearer region lies on its outline and the rest of the thickness fits its pen, or a line inside
 * the paper's label touches that region's outline; else the nearer label.
 *
 * Where an outline ends, its owner has the tip beyond only if the region's paper has a corner there: both sides of the
 * outline meet behind it.  Where the paper goes on straight, a line of another owner leaves the outline.  Inside one
 * region whose pen is thinner than the ink it cannot: there the outline runs out into a solid tip.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ownership/ownership.h"

#include <math.h>

#define PLAIN_THICKNESS     1.04f /* ratio to the pen's width above which ink contains other lines; chosen */
#define THICKNESS_TOLERANCE 0.5f  /* pixels by which thickness may be off; chosen */
#define MAX_SLANT           1.5f  /* pen widths that a normal may run through a line at a slant; chosen */
#define TIP_WIDTHS          6.f   /* pen widths that the two sides of an outline run on to their common tip; chosen */
#define FACING_POINTS       4     /* points before an outline ends that may face the corner of its paper; chosen */
#define SPECK_POINTS        8     /* the edge of a speck of paper has at most so many points, */
#define SPECK_STROKES       4     /* and less than so many times the drawing's line width; chosen */

/* The width of the line that ink shows beside the outline of its front label along all of the contact, in pixels;
 * <= 0 if there is none. */
static float
second_line_width (const CeldContourPens *pens, const CeldEdgePoint *p, const CeldEdgePen *pen)
{
  uint32_t front = celd_pen_front (pens, pen);

  return pen->thickened ? p->thickness - pens->max_width[front - 1] : 0;
}

/* Is that line the outline of the farther label, no wider than its pen? */
static bool
shows_back_line (const CeldContourPens *pens, const CeldEdgePoint *p, const CeldEdgePen *pen)
{
  uint32_t front = celd_pen_front (pens, pen), back = front == pen->near ? pen->far : pen->near;
  float    line = second_line_width (pens, p, pen), width = pen->thickened ? pens->typical_width[back - 1] : 0;

  return width > 0 && line <= PLAIN_THICKNESS * width + THICKNESS_TOLERANCE;
}

/* The owner of a point as far as its own thickness shows; 0 if the ink contains other lines. */
static uint32_t
local_owner (const CeldContourPens *pens, const CeldEdgePoint *p, const CeldEdgePen *pen)
{
  uint32_t front = celd_pen_front (pens, pen);

  if (!pen->near || pen->near == pen->far)
    return 0;
  if (front && pen->thickened)
    return front == pen->near && shows_back_line (pens, p, pen) ? front : 0;
  if (front)
    return p->thickness <= PLAIN_THICKNESS * pen->width + THICKNESS_TOLERANCE ? front : 0;
  return pen->far && p->thickness > 2 * pen->width + THICKNESS_TOLERANCE ? 0 : pen->near; /* equal levels, or ink
                                                                                           * that leaves the picture */
}

/* Does the ink between a region and a nearer one that lies on its outline show a line of the region's own? */
static bool
shows_own_line (const CeldContourPens *pens, const CeldEdgePoint *p, const CeldEdgePen *pen)
{
  return celd_pen_front (pens, pen) != pen->near && second_line_width (pens, p, pen) > THICKNESS_TOLERANCE &&
         shows_back_line (pens, p, pen);
}

/* Does a label lie behind the front label, or is it that? */
static bool
is_behind_front (const CeldContourPens *pens, const CeldEdgePen *pen, uint32_t label)
{
  uint32_t front = celd_pen_front (pens, pen);

  return front && pens->level[label - 1] <= pens->level[front - 1];
}

/* May a point take the owner of another one at that distance along the edge?  A line inside a region, or a nearer line
 * that covers the ink between two regions, ends where both sides of its outline meet; between two regions it cannot
 * be where their own lines are seen. */
static bool
accepts_owner (const CeldContourPens *pens, const CeldEdgePoint *p, const CeldEdgePen *pen, const CeldEdgePen *from,
               float distance)
{
  return is_behind_front (pens, pen, from->owner) ||
         (distance < TIP_WIDTHS * from->width && !shows_own_line (pens, p, pen));
}

/* May a point behind a corner take that label: is it the paper's own, whose line is seen, or does it lie between the
 * paper and the front label in depth? */
static bool
accepts_owner_round_corner (const CeldContourPens *pens, const CeldEdgePoint *p, const CeldEdgePen *pen,
                            uint32_t label)
{
  uint32_t front = celd_pen_front (pens, pen);

  if (label == pen->near)
    return shows_own_line (pens, p, pen);
  return front && front != pen->near && pens->level[label - 1] < pens->level[front - 1] &&
         pens->level[label - 1] > pens->level[pen->near - 1];
}

/* From where owners spread along an edge: from where they are certain, up to a corner or also round corners; or from a
 * line inside a region, both of whose sides are that region's, to where it touches an outline. */
typedef enum { UP_TO_CORNERS, ROUND_CORNERS, FROM_INSIDE } OwnerSpread;

/* Is the ink no thicker than that line and the outline of the front label beside it, across both or at a slant? */
static bool
fits_both (const CeldContourPens *pens, const CeldEdgePoint *p, const CeldEdgePen *line, const CeldEdgePen *pen)
{
  float    width = line->near == line->far ? 2 * line->width : line->width;
  uint32_t front = celd_pen_front (pens, pen);

  return front && p->thickness <= MAX_SLANT * pens->typical_width[front - 1] + width + THICKNESS_TOLERANCE;
}

/* Is the ink inside a region too thick to be a line of its own? */
static bool
is_solid_inside (const CeldContourPens *pens, const CeldEdgePoint *p, const CeldEdgePen *pen)
{
  float own = pens->typical_width[pen->near - 1];

  return pen->near == pen->far && (own <= 0 || p->thickness > PLAIN_THICKNESS * own + THICKNESS_TOLERANCE);
}

/* Does the outline of a's owner end between neighbours a and b, so that the line at b, p, would be its tip, or may be
 * that of another owner?  Not at the picture's frame. */
static bool
leaves_outline (const CeldContourPens *pens, const CeldEdgePoint *p, const CeldEdgePen *a, const CeldEdgePen *b)
{
  return celd_pen_front (pens, a) == a->owner && !is_behind_front (pens, b, a->owner) && b->near && b->far &&
         !is_solid_inside (pens, p, b);
}

/* Does the other side of the ink turn sharply just before b, as it does where both sides of an outline meet? */
static bool
faces_corner (const CeldEdgeLoop *loop, const CeldEdgePoint *point, size_t a, size_t b)
{
  size_t back = b == (a + 1) % loop->n ? loop->n - 1 : 1;

  for (size_t k = 0; k <= FACING_POINTS; k++)
    if (point[(a + k * back) % loop->n].faces_corner)
      return true;
  return false;
}

/* Does point b take the owner of its neighbour a, `distance` from the point that a has it from? */
static bool
takes_owner (const CeldContourPens *pens, const CeldEdgeLoop *loop, size_t a, size_t b, OwnerSpread spread,
             float distance)
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first];
  const CeldEdgePen   *pen = &pens->pen[loop->first];

  if (spread == ROUND_CORNERS)
    return accepts_owner_round_corner (pens, &point[b], &pen[b], pen[a].owner);
  if (point[a].corner)
    return false;
  if (spread == FROM_INSIDE)
    return pen[a].owner == pen[b].near && fits_both (pens, &point[b], &pen[a], &pen[b]);
  if (leaves_outline (pens, &point[b], &pen[a], &pen[b]) && !faces_corner (loop, point, a, b))
    return false;
  return accepts_owner (pens, &point[b], &pen[b], &pen[a], distance);
}

/* Points without an owner take that of the nearest point along the edge that has one.  `distance` gets the distance to
 * that point. */
static void
spread_owners (const CeldEdgeLoop *loop, CeldContourPens *pens, OwnerSpread spread, float *distance)
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first];
  CeldEdgePen         *pen = &pens->pen[loop->first];
  size_t               n = loop->n;

  for (size_t i = 0; i < n; i++)
    distance[i] = pen[i].owner ? 0 : INFINITY;
  for (int backwards = 0; backwards < 2; backwards++)
    for (size_t i = 1; i < 2 * n; i++)
      {
        size_t a = (backwards ? 2 * n - i : i - 1) % n, b = (backwards ? 2 * n - i - 1 : i) % n;
        float  total = distance[a] + point[backwards ? b : a].step;

        if (pen[a].owner && total < distance[b] && takes_owner (pens, loop, a, b, spread, total))
          {
            distance[b]  = total;
            pen[b].owner = pen[a].owner;
            pen[b].width = spread == FROM_INSIDE && pen[a].near == pen[a].far ? 2 * pen[a].width : pen[a].width;
          }
      }
}

/* Gives lines inside regions that have a pen to these, where nothing else is known; whether other points are left. */
static bool
own_lines_inside (const CeldEdgeLoop *loop, CeldContourPens *pens)
{
  CeldEdgePen *pen = &pens->pen[loop->first];
  bool         left = false;

  for (size_t i = 0; i < loop->n; i++)
    if (!pen[i].owner && pen[i].near)
      {
        if (pen[i].near == pen[i].far && pens->typical_width[pen[i].near - 1] > 0)
          pen[i].owner = pen[i].near;
        else
          left = true;
      }
  return left;
}

/* Near a corner normals may run along the line, and end at a region that the line does not bound: if both sides have
 * one owner, it owns the corner between them, too. */
static void
join_sides (const CeldEdgeLoop *loop, CeldContourPens *pens)
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first];
  CeldEdgePen         *pen = &pens->pen[loop->first];

  for (size_t i = 0; i < loop->n; i++)
    {
      const CeldEdgePen *before = &pen[(i + loop->n - 1) % loop->n];
      size_t             end = i, n = 0;

      for (; n < loop->n && !pen[end].owner && point[end].skewed; n++)
        end = (end + 1) % loop->n;
      if (before->owner && before->owner == pen[end].owner)
        for (; n > 0; n--, i++)
          {
            pen[i % loop->n].owner = before->owner;
            pen[i % loop->n].width = before->width;
          }
    }
}

/* The owner of a point that nothing along the edge tells about. */
static void
assume_owner (const CeldContourPens *pens, const CeldEdgePoint *p, CeldEdgePen *pen)
{
  bool own = shows_own_line (pens, p, pen);

  pen->owner = own || !celd_pen_front (pens, pen) ? pen->near : celd_pen_front (pens, pen);
  if (own)
    pen->width = pens->typical_width[pen->near - 1];
}

/* Is an edge that of a speck of paper between lines, like what antialiasing leaves in an acute corner?  It has no
 * reliable normals. */
static bool
is_speck (const CeldContourEdges *edges, const CeldEdgeLoop *loop)
{
  return loop->n <= SPECK_POINTS && loop->n < SPECK_STROKES * (size_t) edges->stroke;
}

void
celd_contour_owners_find (const CeldEdgeLoop *loop, CeldContourPens *pens, float *distance)
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first];
  CeldEdgePen         *pen = &pens->pen[loop->first];
  size_t               unknown = 0;

  if (is_speck (pens->edges, loop)) /* leaves its ink to other edges */
    return;
  for (size_t i = 0; i < loop->n; i++)
    pen[i].owner = local_owner (pens, &point[i], &pen[i]);
  spread_owners (loop, pens, UP_TO_CORNERS, distance);
  for (size_t i = 0; i < loop->n; i++)
    unknown += !pen[i].owner;
  if (unknown)
    spread_owners (loop, pens, ROUND_CORNERS, distance);
  if (unknown && own_lines_inside (loop, pens))
    spread_owners (loop, pens, FROM_INSIDE, distance);
  if (unknown)
    join_sides (loop, pens);
  for (size_t i = 0; i < loop->n; i++)
    if (!pen[i].owner)
      assume_owner (pens, &point[i], &pen[i]);
}
