/* Is the end of an arrow hidden by arrows of other colours?
 *
 * An arrow that is read by its colour ends where its paint does, if a head or dot is seen there.  Else, if most of the
 * paint there is hidden, or other paint goes on in its direction, or nearly so, its end may lie elsewhere.  Its place is
 * known all the same if another arrow ends there too, or at a place to which it leads below other paint, or if two
 * hidden ones lead to one place, or if the other paint is short.  It is known, too, if others end about where that
 * paint hides all the width of the arrow, which it does for a few widths only.  Ends that are in sight tell first; two
 * that are hidden tell nothing of each other if they are of one stroke, since both were found in one reading of that.
 *
 * Cost: two passes over the paint of the arrow.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>

/* All chosen; widths are those of the shaft. */
#define MOST_BEYOND      100 /* pixels of paint of an arrow beyond its end; heads are shorter */
#define HIDING           0.8 /* widths of other paint in front of an end, at least, and ... */
#define HIDING_LEAST     3   /* ... as many pixels more, that may hide it */
#define MOST_OTHERS      1.2 /* of the paint of an end: all paint there */
#define SHORT_COVER      1.2 /* widths of other paint in front, and as many pixels more, below which an end is near */
#define ABOUT_COVER      2.2 /* widths, and HIDING_LEAST pixels, for which other paint hides all the width of an arrow
                              * whose end is about there, at most, ... */
#define ABOUT_HALF       0.35 /* ... where all of it is so many widths to either side, ... */
#define ABOUT_REACH      2   /* ... and widths, and NEIGHBOUR_LEAST pixels, from there to where others end */
#define NEIGHBOUR        2.5 /* widths between an end that is near and another one that tells where it is, and ... */
#define NEIGHBOUR_LEAST  3   /* ... as many pixels */
#define FAINTER          0.6 /* of the opacity of an end: what is fainter hides nothing of it */
#define BEHIND           3   /* widths from an end up to which the direction of its arrow is measured, and ... */
#define BEHIND_LEAST     10  /* ... as many pixels at least; ... */
#define OWN_COSINE       0.5 /* ... of the angle between its ends and the paint beside that, which may be another one's */
#define THINNEST_ARROW   1.5 /* pixels, of an arrow */
#define ASIDE            0.4 /* radians on either side of the direction in which the arrow may go on */
#define RAYS             5   /* in that range, along which paint is looked for */
#define SAME_PLACE       0.7 /* widths between the ends of two arrows that end at one place, and ... */
#define SAME_PLACE_LEAST 2   /* ... as many pixels */
#define SIDE_BY_SIDE     0.7 /* cosine of the angle between arrows that another one may hide at one place */
#define MEETING_SINE     0.7 /* of the angle between hidden arrows that meet farther on, at least */
#define LEADING          5   /* widths that an arrow may lead below others, at most, and ... */
#define LEADING_LEAST    3   /* ... as many pixels */
#define ASTRAY           0.15 /* of that distance, by which its end may lie aside */
#define BREAK_COSINE     0.8 /* of the angle by which an arrow that others hide may turn there, at least */

/* The direction in which the paint of an arrow from or to `other` that is seen reaches its end. */
static CeldPoint
direction_at (const CeldArrowStroke *stroke, const bool *seen, CeldPoint at, CeldPoint other, double width)
{
  CeldPoint sum = { 0, 0 };
  double    length;

  for (size_t i = 0; i < stroke->n; i++)
    {
      CeldPoint p = celd_stroke_point (stroke, stroke->pixel[i]);
      double    dx = p.x - at.x, dy = p.y - at.y, d = hypot (dx, dy);

      if (!seen[i] || d > fmax (BEHIND_LEAST, BEHIND * width) ||
          dx * (other.x - at.x) + dy * (other.y - at.y) < OWN_COSINE * d * hypot (other.x - at.x, other.y - at.y))
        continue;
      sum.x += at.x - p.x;
      sum.y += at.y - p.y;
    }
  length = hypot (sum.x, sum.y);
  return length > 0 ? (CeldPoint) { sum.x / length, sum.y / length } : (CeldPoint) { 0, 0 };
}

/* How far the paint of an arrow that is seen goes on beyond its end in a direction, without a break; *width: its width
 * there. */
static double
reach_beyond (const CeldArrowStroke *stroke, const bool *seen, CeldPoint at, CeldPoint way, double *width)
{
  bool   painted[MOST_BEYOND + 1] = { false };
  int    most = 0;
  double n = 0, near = fmax (6, 2 * *width);

  for (size_t i = 0; i < stroke->n; i++)
    {
      CeldPoint p  = celd_stroke_point (stroke, stroke->pixel[i]);
      double    dx = p.x - at.x, dy = p.y - at.y, along = dx * way.x + dy * way.y;

      n += hypot (dx, dy) <= near;
      if (seen[i] && fabs (dx * way.y - dy * way.x) <= 1 && along >= 0 && along < MOST_BEYOND)
        painted[(int) along] = true;
    }
  *width = fmin (*width, n / near);
  while (painted[most] || (most < MOST_BEYOND && painted[most + 1]))
    most++;
  return most;
}

static bool
is_painted (const CeldStrokeMask *c, CeldPoint p)
{
  double x = p.x - c->left, y = p.y - c->top;

  return x >= 0 && y >= 0 && x < c->width && y < c->height && c->painted[(size_t) y * (size_t) c->width + (size_t) x];
}

/* The opacity of the paint of an arrow that is seen at its end. */
static double
opacity_at (const CeldColouredPaint *paint, const CeldArrowStroke *stroke, const bool *seen, CeldPoint at, double width)
{
  double sum = 0, n = 0;

  for (size_t i = 0; i < stroke->n; i++)
    {
      int x = celd_stroke_x (stroke, stroke->pixel[i]), y = celd_stroke_y (stroke, stroke->pixel[i]);

      if (!seen[i] || hypot (x + 0.5 - at.x, y + 0.5 - at.y) > width)
        continue;
      sum += celd_arrow_opacity (paint->layer, x, y);
      n++;
    }
  return n > 0 ? sum / n : 0;
}

/* May the paint at a point hide paint of an opacity?  What is much fainter would let it be seen; 0 = any may. */
static bool
may_hide (const CeldColouredPaint *paint, CeldPoint p, double opacity)
{
  return is_painted (paint->component, p) &&
         celd_arrow_opacity (paint->layer, (int) p.x, (int) p.y) >= FAINTER * opacity;
}

/* The paint near a place, in pixels: of all arrows of a component. */
static double
paint_near (const CeldStrokeMask *component, CeldPoint at, double reach)
{
  double n = 0;

  for (double y = floor (at.y - reach) + 0.5; y <= at.y + reach; y++)
    for (double x = floor (at.x - reach) + 0.5; x <= at.x + reach; x++)
      n += hypot (x - at.x, y - at.y) <= reach && is_painted (component, (CeldPoint) { x, y });
  return n;
}

/* Is most of the paint of an arrow at its end seen?  Where others may hide a side of it, there must be none of them. */
static bool
is_seen (const CeldStrokeMask *component, const CeldArrowStroke *stroke, const bool *seen, bool covered, CeldPoint at,
         double width)
{
  size_t near = 0, hidden = 0;

  for (size_t i = 0; i < stroke->n; i++)
    {
      CeldPoint p = celd_stroke_point (stroke, stroke->pixel[i]);

      if (hypot (p.x - at.x, p.y - at.y) > width)
        continue;
      near++;
      hidden += !seen[i];
    }
  return 2 * hidden < near &&
         (!covered || paint_near (component, at, width) <= MOST_OTHERS * (double) (near - hidden));
}

/* Looks for paint of the same colour in front of an end of stroke k, so close that it may be more of it. */
static void
find_beyond (const CeldArrowStroke *stroke, const CeldColourStrokes *colours, size_t k, CeldArrowEnd *end)
{
  const CeldCrossingStrokes *all = &colours->strokes;

  for (size_t j = 0; j < all->n; j++)
    for (size_t i = all->first[j]; i < all->first[j + 1] && j != k && colours->colour[j] == colours->colour[k]; i++)
      {
        CeldPoint p = celd_stroke_point (stroke, all->pixel[i]);
        double    dx = p.x - end->at.x, dy = p.y - end->at.y, d = hypot (dx, dy);

        if (d > CELD_MOST_BREAK || dx * end->way.x + dy * end->way.y <= BREAK_COSINE * d)
          continue;
        end->beyond = end->broken ? SIZE_MAX : j;
        end->broken = true;
        break;
      }
}

/* Does other paint hide all the width of an arrow that goes on beyond an end, at a distance in a direction? */
static bool
is_all_hidden (const CeldColouredPaint *paint, const CeldArrowEnd *end, CeldPoint way, double d, double width,
               double opacity)
{
  CeldPoint side = { -way.y, way.x }, ahead = celd_moved (end->at, way, d);

  for (int k = -1; k <= 1; k++)
    if (!may_hide (paint, celd_moved (ahead, side, k * ABOUT_HALF * width), opacity))
      return false;
  return true;
}

/* Looks for other paint ahead of an end, in its direction and on either side of that.  strong: no paint of the arrow is
 * more opaque than that of the end. */
static void
look_ahead (const CeldColouredPaint *paint, const CeldArrowStroke *stroke, const bool *seen, bool strong,
            CeldArrowEnd *end)
{
  double opacity = strong ? opacity_at (paint, stroke, seen, end->at, end->width) : 0;

  end->is_near = end->is_about = true;
  for (int ray = 0; ray < RAYS; ray++)
    {
      double    width = end->width, a = ASIDE * (2. * ray / (RAYS - 1) - 1), start, d, all, most;
      CeldPoint way = { end->way.x * cos (a) - end->way.y * sin (a), end->way.x * sin (a) + end->way.y * cos (a) };

      d = all = start = reach_beyond (stroke, seen, end->at, way, &width) + 1;
      while (d - start <= SHORT_COVER * width + HIDING_LEAST &&
             may_hide (paint, (CeldPoint) { end->at.x + d * way.x, end->at.y + d * way.y }, opacity))
        d += 0.5;
      end->visible &= d - start <= HIDING * width + HIDING_LEAST;
      end->is_near &= d - start <= SHORT_COVER * width + HIDING_LEAST;
      most = ABOUT_COVER * width + HIDING_LEAST;
      while (all <= most && is_all_hidden (paint, end, way, all, width, opacity))
        all += 0.5;
      end->is_about &= all <= most;
      if (ray == RAYS / 2)
        {
          end->middle = celd_moved (end->at, way, d / 2);
          end->about  = celd_moved (end->at, way, all / 2);
          end->lean   = width;
        }
    }
}

CeldArrowEnd
celd_arrow_end (const CeldColouredPaint *paint, const CeldArrowStroke *stroke, size_t k, CeldPoint at, CeldPoint other,
                double width, CeldEndSight sight)
{
  const bool  *seen = &paint->colours->seen[paint->colours->strokes.first[k]];
  CeldArrowEnd end = { .stroke = k, .at = at, .place = at, .width = fmax (THINNEST_ARROW, width) };

  end.way     = direction_at (stroke, seen, at, other, end.width);
  end.visible = is_seen (paint->component, stroke, seen, paint->colours->covered[k], at, end.width);
  if (sight != CELD_SIGHT_MARKED || !end.visible)
    look_ahead (paint, stroke, seen, sight == CELD_SIGHT_STRONG, &end);
  if (!end.visible)
    find_beyond (stroke, paint->colours, k, &end);
  return end;
}

/* Is all of the straight line between two points painted? */
static bool
is_joined (const CeldStrokeMask *c, CeldPoint a, CeldPoint b)
{
  double length = hypot (b.x - a.x, b.y - a.y);

  for (double d = 0; d < length; d += 0.5)
    if (!is_painted (c, (CeldPoint) { a.x + d * (b.x - a.x) / length, a.y + d * (b.y - a.y) / length }))
      return false;
  return true;
}

/* Does an arrow whose end is hidden lead below other paint to a place? */
static bool
leads_to (const CeldStrokeMask *component, const CeldArrowEnd *end, CeldPoint p)
{
  double dx = p.x - end->at.x, dy = p.y - end->at.y, ahead = dx * end->way.x + dy * end->way.y;
  double aside = fabs (dx * end->way.y - dy * end->way.x);

  return hypot (end->way.x, end->way.y) > 0 && ahead > -end->width && ahead <= LEADING * end->width + LEADING_LEAST &&
         aside <= SAME_PLACE * end->width + ASTRAY * ahead && is_joined (component, end->at, p);
}

/* Where the arrows of two ends end, if they end at one place: false if they do not.  Without `lead` that must be where
 * their paint ends. */
static bool
find_common_place (const CeldStrokeMask *component, const CeldArrowEnd *end, const CeldArrowEnd *other, bool lead,
                   CeldPoint *place)
{
  double dx = other->at.x - end->at.x, dy = other->at.y - end->at.y, along;
  double sine = end->way.x * other->way.y - end->way.y * other->way.x;
  bool   same = hypot (dx, dy) <= SAME_PLACE * fmin (end->width, other->width) + SAME_PLACE_LEAST;

  *place = !lead ? end->at : other->known ? other->place : other->at;
  if (same)
    return other->visible || end->way.x * other->way.x + end->way.y * other->way.y < SIDE_BY_SIDE;
  if (!lead)
    return false;
  if (other->visible)
    return leads_to (component, end, *place);
  if (fabs (sine) < MEETING_SINE)
    return false;
  along  = (dx * other->way.y - dy * other->way.x) / sine;
  *place = (CeldPoint) { end->at.x + along * end->way.x, end->at.y + along * end->way.y };
  return leads_to (component, end, *place) && leads_to (component, other, *place);
}

/* May end i tell where end k is, which is hidden?  Not if it is of the same stroke and hidden, too.  What fades or
 * tapers is strongest at its nearer end: it does not lead below others there, and one that goes straight on from it may
 * hide more of it.  No arrow leads to an end along the whole of the other arrow. */
static bool
may_tell (const CeldArrowEnd *ends, size_t k, size_t i, bool graded)
{
  bool straight_on = ends[k].way.x * ends[i].way.x + ends[k].way.y * ends[i].way.y < -SIDE_BY_SIDE;

  return i / 2 != k / 2 && (ends[i].visible || ends[i].stroke != ends[k].stroke) &&
         !(graded && k % 2 == 0 && straight_on) &&
         celd_points_apart (ends[i].at, ends[k].at) <= celd_points_apart (ends[i ^ 1].at, ends[k].at);
}

/* The place of end k, which is hidden, by those of others that end there: the nearest of these that are in sight, or of
 * those that are not. */
static void
find_by_others (const CeldStrokeMask *component, bool graded, bool in_sight, CeldArrowEnd *ends, size_t n, size_t k)
{
  double nearest = INFINITY;

  for (size_t i = 0; i < n; i++)
    {
      CeldPoint place;
      double    d;

      if (ends[i].visible != in_sight || !may_tell (ends, k, i, graded) ||
          !find_common_place (component, &ends[k], &ends[i], !graded || k % 2, &place))
        continue;
      d = celd_points_apart (place, ends[k].at);
      if (d >= nearest)
        continue;
      nearest       = d;
      ends[k].known = true;
      ends[k].place = place;
    }
}

/* The place of end k, which is near the middle of what hides it: that of another one in sight which is near, too. */
static void
find_beside (CeldArrowEnd *ends, size_t n, size_t k)
{
  double nearest = NEIGHBOUR * ends[k].lean + NEIGHBOUR_LEAST;

  for (size_t i = 0; i < n; i++)
    {
      double d = celd_points_apart (ends[i].at, ends[k].middle);

      if (i / 2 == k / 2 || !ends[i].visible || d > nearest)
        continue;
      nearest       = d;
      ends[k].known = true;
      ends[k].place = ends[i].at;
    }
}

/* The place of end k, which is about where arrows of other strokes end: that of the nearest one, if it is known. */
static void
find_about (CeldArrowEnd *ends, size_t n, size_t k)
{
  double nearest = ABOUT_REACH * ends[k].lean + NEIGHBOUR_LEAST;

  for (size_t i = 0; i < n; i++)
    {
      CeldPoint p = ends[i].known ? ends[i].place : ends[i].is_about ? ends[i].about : ends[i].at;
      double    d = celd_points_apart (p, ends[k].about);

      if (ends[i].stroke == ends[k].stroke || d > nearest)
        continue;
      nearest       = d;
      ends[k].known = true;
      ends[k].place = ends[i].known ? p : ends[k].about;
    }
}

/* Is the paint beyond end k, which is of its colour, another arrow that ends next to it?  No arrow has two heads or
 * dots.  What cuts a line may leave what looks like a head: one with a head counts only if it ends there in sight. */
static bool
is_other_beyond (const CeldArrowEnd *ends, size_t n, size_t k)
{
  for (size_t i = 0; i < n && ends[k].bare; i++)
    if (ends[i].stroke == ends[k].beyond && (ends[i].visible || ends[i].dotted) &&
        celd_points_apart (ends[i].at, ends[k].at) <= CELD_MOST_BREAK)
      return true;
  return false;
}

void
celd_arrow_ends_find (const CeldStrokeMask *component, bool graded, CeldArrowEnd *ends, size_t n)
{
  for (size_t k = 0; k < n; k++)
    {
      ends[k].known   = ends[k].visible;
      ends[k].broken &= !is_other_beyond (ends, n, k);
      if (ends[k].visible || ends[k].broken)
        continue;
      find_by_others (component, graded, true, ends, n, k);
      if (!ends[k].known && ends[k].is_near)
        find_beside (ends, n, k);
    }
  for (size_t k = 0; k < n; k++)
    {
      if (ends[k].known || ends[k].broken)
        continue;
      find_by_others (component, graded, false, ends, n, k);
      if (!ends[k].known && ends[k].is_near)
        {
          ends[k].known = true;
          ends[k].place = ends[k].middle;
        }
    }
  for (size_t k = 0; k < n; k++)
    if (!ends[k].known && !ends[k].broken && ends[k].is_about)
      find_about (ends, n, k);
}
