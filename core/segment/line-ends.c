/* Finds the free ends of a drawing's lines.
 *
 * The outlines of all ink are followed, ink on the right, diagonal neighbours connected.  At the end of a line the
 * outline turns back: two places a few stroke widths before and after are close to each other, with ink between.  Such
 * places are then examined like the ends of closures (line-end-fit.c).  That is done at several scales, the finest first:
 * hairlines beside broad strokes have ends of their own.
 *
 * Before that, corners where a broad line was cut off are sought (line-cuts.c).
 *
 * Cost: one pass over the picture, and the length of the outlines; temporarily a byte a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/bridges.h"
#include "segment/closures.h"
#include "segment/tip-set.h"

#include <math.h>
#include <string.h>

#define ARM_LENGTH   1.25 /* stroke widths along the outline to either side */
#define SHORTEST_ARM 6    /* pixels of such an arm, at least */
#define SCALES       9    /* lengths of arms that are tried */
#define SCALE_FACTOR 1.4  /* each is so many times the one before it */
#define FINE_LINE    0.28 /* stroke widths: fits for the strokes have fewer than two samples across such a line */
#define MOST_FINER   16   /* scales for such lines: a drawing may have pens of 50 and of 2 pixels */
#define ARM_STEPS    8    /* along an arm: places that are tried */
#define LEAST_OUTLINE 3.5 /* arms: on a shorter outline, as that of a dot, the ends of both arms are near each other
                            * everywhere */
#define SHARP_TURN   0.6  /* distance of both arms' ends, relative to the arms' lengths: a right angle has 0.71 */
#define CERTAIN_TIP  0.42 /* the largest such value for a line whose direction cannot be fitted */
#define LEAST_INKED  0.75 /* of the way from side to side of a line that ends (chosen) */
#define LINE_ARMS    5    /* arms behind the end a line is as wide as near it (chosen) */
#define MOST_WIDENING 1.3  /* times, plus a pixel (chosen): lines that meet at 10 degrees are 1.7 times as wide */
#define FARTHEST_INK 3    /* pixels behind a corner of the outline, at an edge that is aslant (chosen) */
#define SAME_END     0.75 /* line widths: ends closer than this are the same */
#define BROAD_LINE   12   /* pixels: finer lines have no corners, but steps of pixels (chosen) */
#define FIT_AGREES   0.96 /* cosine of the angle between a fit and the sides of a line that was cut off: 16 degrees */
#define BESIDE_CUT   1.25 /* line widths: so near to such an end is no other one */

#define PIXEL_INK   1 /* a pixel of ink */
#define PIXEL_FOLLOWED 2 /* its upper edge has been followed */

/* Arms of one length.  stroke: the width of strokes whose ends they find; end: for fitting them. */
typedef struct { size_t arm; double stroke; CeldLineEnd *end; } Scale;

typedef struct
{
  const CeldPlane *ink;
  int              stroke, width, height;
  uint8_t         *mask;        /* PIXEL_INK or PIXEL_FOLLOWED; with a margin of a pixel, and of 8 at the right */
  size_t           stride;
  CeldCorner      *corner;      /* of the current outline */
  size_t           n;
  uint32_t         outline;     /* its number */
  Scale            scale[MOST_FINER + SCALES]; /* the finest first */
  int              n_scales;
  CeldLineEnd      end[MOST_FINER + 1]; /* for fitting: [0] the strokes, [1] .. finer lines */
  CeldTipSet       found;
  size_t           first_cut, end_cuts;         /* of what is found: those at which the current outline was cut off */
  size_t           corner_capacity;
} LineEndSearch;

/* ------------------------------------------------------------------ outlines */

static CeldStatus
read_mask (LineEndSearch *s)
{
  s->stride = (size_t) s->width + 16;
  s->mask   = celd_alloc0 ((size_t) s->height + 2, s->stride);
  if (!s->mask)
    return CELD_NO_MEMORY;
  for (int y = 0; y < s->height; y++)
    {
      const float *ink = &CELD_AT (s->ink, 0, y);
      uint8_t     *mask = s->mask + (size_t) (y + 1) * s->stride + 1;

      for (int x = 0; x < s->width; x++)
        mask[x] = !celd_is_paper (ink[x]);
    }
  return CELD_OK;
}

static uint8_t *
mask_at (const LineEndSearch *s, int x, int y)
{
  return s->mask + (size_t) (y + 1) * s->stride + (size_t) (x + 1);
}

/* Follows the outline along the upper edge of pixel (x,y). */
static CeldStatus
follow (LineEndSearch *s, int x, int y)
{
  CeldCorner at = { x, y };
  int        heading = 0;

  s->n = 0;
  do
    {
      if (celd_append (s->corner, s->n, s->corner_capacity, at) != CELD_OK)
        return CELD_NO_MEMORY;
      if (heading == 0)
        *mask_at (s, at.x, at.y) |= PIXEL_FOLLOWED;
      at.x += celd_step_x[heading];
      at.y += celd_step_y[heading];
      if (*mask_at (s, at.x + celd_left_x[heading], at.y + celd_left_y[heading]))
        heading = (heading + 3) & 3;
      else if (!*mask_at (s, at.x + celd_right_x[heading], at.y + celd_right_y[heading]))
        heading = (heading + 1) & 3;
    }
  while (at.x != x || at.y != y || heading != 0);
  return CELD_OK;
}

/* ------------------------------------------------------------------ where outlines turn back */

/* The distance of both arms' ends at corner i relative to the arms' lengths; *span: that distance; *middle is between
 * them. */
static double
sharpness (const LineEndSearch *s, size_t i, size_t arm, CeldPlace *middle, double *span)
{
  CeldCorner p = s->corner[i], a = s->corner[(i + s->n - arm) % s->n], b = s->corner[(i + arm) % s->n];
  double     length = hypot (a.x - p.x, a.y - p.y) + hypot (b.x - p.x, b.y - p.y);

  *middle = (CeldPlace) { 0.5 * (a.x + b.x), 0.5 * (a.y + b.y) };
  *span = hypot (a.x - b.x, a.y - b.y);
  return length > 0 ? *span / length : 1;
}

/* Does the outline only turn round an end that was cut off? */
static bool
is_beside_cut (const LineEndSearch *s, CeldCorner corner)
{
  for (size_t k = s->first_cut; k < s->end_cuts; k++)
    if (hypot (corner.x - s->found.tip[k].x, corner.y - s->found.tip[k].y) < BESIDE_CUT * s->found.tip[k].width)
      return true;
  return false;
}

/* Is there mostly ink between the ends of arms of that length?  Between the sides of a limb that is only outlined,
 * there is paper. */
static bool
is_inked (const LineEndSearch *s, size_t i, size_t arm)
{
  CeldCorner a = s->corner[(i + s->n - arm) % s->n], b = s->corner[(i + arm) % s->n];
  int        steps = (int) ceil (2 * hypot (b.x - a.x, b.y - a.y)) + 1, ink = 0;

  for (int k = 0; k < steps; k++)
    {
      double t = (k + 0.5) / steps;

      ink += *mask_at (s, (int) floor (a.x + t * (b.x - a.x)), (int) floor (a.y + t * (b.y - a.y))) != 0;
    }
  return ink >= LEAST_INKED * steps;
}

/* The width of the line that ends at corner i, one arm behind it if `arms` is 1: from one side to the nearest place of
 * the other, which is not quite opposite where a line is bent. */
static double
width_behind (const LineEndSearch *s, size_t i, size_t arm, size_t arms)
{
  CeldCorner a = s->corner[(i + s->n - arms * arm) % s->n];
  double     least = INFINITY;

  for (size_t k = (arms - 1) * arm; k <= (arms + 1) * arm; k++)
    {
      CeldCorner b = s->corner[(i + k) % s->n];

      least = fmin (least, hypot (b.x - a.x, b.y - a.y));
    }
  return least;
}

/* The width of what ends at corner i; 0 if it is not one line of even width, but the corner of two. */
static double
line_width (const LineEndSearch *s, size_t i, size_t arm)
{
  double width = width_behind (s, i, arm, 1);

  if (s->n <= 2 * (LINE_ARMS + 1) * arm || width_behind (s, i, arm, LINE_ARMS) > MOST_WIDENING * width + 1)
    return 0;
  return width;
}

/* The first pixel of ink on the way from a corner of the outline to the middle of the line.  At an aslant edge it need
 * not be the first pixel of all. */
static bool
find_ink (const LineEndSearch *s, CeldCorner corner, CeldPlace middle, CeldCorner *pixel)
{
  double length = hypot (middle.x - corner.x, middle.y - corner.y);

  for (double t = 1; t <= fmin (length, FARTHEST_INK); t += 0.5)
    {
      pixel->x = (int32_t) floor (corner.x + t / length * (middle.x - corner.x));
      pixel->y = (int32_t) floor (corner.y + t / length * (middle.y - corner.y));
      if (pixel->x >= 0 && pixel->y >= 0 && pixel->x < s->width && pixel->y < s->height &&
          *mask_at (s, pixel->x, pixel->y))
        return true;
    }
  return false;
}

/* Adds the corner if a line ends there.  A very sharp tip (CERTAIN_TIP) counts even if its line is too short or too
 * curved to fit a direction.  At finer scales only lines of even width count: all else is a corner or a ragged edge. */
static CeldStatus
try_corner (LineEndSearch *s, size_t i, const Scale *scale, CeldPlace middle, double sharp)
{
  CeldCorner   corner = s->corner[i];
  CeldLineEnd *fit = scale->end;
  double       back = hypot (middle.x - corner.x, middle.y - corner.y), width = line_width (s, i, scale->arm);
  double       estimated = 2 * sharp * back; /* the width of the line, whether even or not */
  bool         is_finer = scale->stroke < s->stroke;
  CeldCorner   inside;
  CeldTip      end = { .outline = s->outline, .width = width, .stroke = scale->stroke };

  if (!*mask_at (s, (int) floor (middle.x), (int) floor (middle.y)) || back < 1 ||
      (is_finer && (width == 0 || width > FINE_LINE * s->stroke)) || !find_ink (s, corner, middle, &inside))
    return CELD_OK;
  celd_line_end_fit (s->ink, inside, fit);
  end.x  = fit->tip ? fit->at.x : corner.x;
  end.y  = fit->tip ? fit->at.y : corner.y;
  end.dx = fit->tip ? fit->dx : (corner.x - middle.x) / back;
  end.dy = fit->tip ? fit->dy : (corner.y - middle.y) / back;
  if ((!fit->tip && sharp > CERTAIN_TIP) || celd_tip_set_has (&s->found, end, SAME_END * estimated + 1))
    return CELD_OK;
  return celd_tip_set_add (&s->found, end);
}

/* Examines one corner of each turn of the outline: where both sides of the line are nearest.  That is in the middle of
 * its end even if the end is hollow, with sharper corners at both sides. */
static CeldStatus
search_outline (LineEndSearch *s, const Scale *scale)
{
  size_t     arm = scale->arm, step = arm / ARM_STEPS ? arm / ARM_STEPS : 1;
  CeldStatus status = CELD_OK;

  if ((double) s->n < LEAST_OUTLINE * (double) arm)
    return CELD_OK;
  for (size_t i = 0; i < s->n && status == CELD_OK; i += step)
    {
      CeldPlace middle, other;
      double    span, least_span, least = sharpness (s, i, arm, &middle, &least_span);
      size_t    best = i;

      if (least > SHARP_TURN)
        continue;
      for (; i < s->n; i += step) /* to the end of the turn */
        {
          double sharp = sharpness (s, i, arm, &other, &span);

          if (sharp > SHARP_TURN)
            break;
          least = fmin (least, sharp);
          if (span < least_span)
            {
              least_span = span;
              best       = i;
              middle     = other;
            }
        }
      if (!is_beside_cut (s, s->corner[best]) && is_inked (s, best, arm) && is_inked (s, best, arm / 2))
        status = try_corner (s, best, scale, middle, least);
    }
  return status;
}

/* A fit knows better than the last piece of both sides how a line bends, if it does not contradict. */
static void
refine_cut (LineEndSearch *s, CeldTip *end)
{
  CeldLineEnd *fit = &s->end[0];

  celd_line_end_fit (s->ink, (CeldCorner) { (int32_t) floor (end->x), (int32_t) floor (end->y) }, fit);
  if (!fit->tip || fit->dx * end->dx + fit->dy * end->dy < FIT_AGREES)
    return;
  end->x  = fit->at.x;
  end->y  = fit->at.y;
  end->dx = fit->dx;
  end->dy = fit->dy;
}

/* Adds the ends of broad lines that were cut off, from lines as wide as the strokes down to details. */
static CeldStatus
search_cuts (LineEndSearch *s)
{
  CeldOutline outline = { s->corner, s->n };
  CeldTip     end;
  CeldStatus  status = CELD_OK;

  s->first_cut = s->end_cuts = s->found.n;
  for (int stroke = s->stroke; stroke >= BROAD_LINE && status == CELD_OK; stroke /= 2)
    for (size_t from = 0; status == CELD_OK && celd_line_cut_next (s->ink, &outline, stroke, &from, &end);)
      {
        end.outline = s->outline;
        if (stroke == s->stroke)
          refine_cut (s, &end);
        if (!celd_tip_set_has (&s->found, end, SAME_END * end.width + 1))
          status = celd_tip_set_add (&s->found, end);
      }
  s->end_cuts = s->found.n;
  return status;
}

static CeldStatus
search_from (LineEndSearch *s, int x, int y)
{
  CeldStatus status = follow (s, x, y);

  s->outline++;
  if (status == CELD_OK)
    status = search_cuts (s);
  for (int k = 0; k < s->n_scales && status == CELD_OK; k++)
    status = search_outline (s, &s->scale[k]);
  return status;
}

/* ------------------------------------------------------------------ the whole */

/* Chooses the scales, and makes room for fitting the ends of lines. */
static CeldStatus
make_scales (LineEndSearch *s)
{
  double     arm = SHORTEST_ARM, most = ARM_LENGTH * FINE_LINE * s->stroke;
  CeldStatus status = celd_line_end_new (s->stroke, &s->end[0]);

  for (int k = 1; k <= MOST_FINER && arm <= most && status == CELD_OK; k++, arm *= SCALE_FACTOR)
    {
      s->scale[s->n_scales++] = (Scale) { (size_t) arm, arm / ARM_LENGTH, &s->end[k] };
      status                  = celd_line_end_new ((int) (arm / ARM_LENGTH), &s->end[k]);
    }
  arm = fmax (SHORTEST_ARM, ARM_LENGTH * s->stroke);
  for (int k = 0; k < SCALES; k++, arm *= SCALE_FACTOR)
    s->scale[s->n_scales++] = (Scale) { (size_t) arm, s->stroke, &s->end[0] };
  return status;
}

CeldStatus
celd_line_ends_find (const CeldPlane *ink, int stroke, const CeldHost *host, CeldTip **tip, size_t *n)
{
  LineEndSearch s = { .ink = ink, .stroke = stroke, .width = ink->width, .height = ink->height };
  CeldStatus    status = read_mask (&s);

  if (status == CELD_OK)
    status = celd_tip_set_open (s.width, s.height, &s.found);
  if (status == CELD_OK)
    status = make_scales (&s);
  for (int y = 0; y < s.height && status == CELD_OK; y++)
    {
      const uint8_t *row = mask_at (&s, 0, y), *above = row - s.stride;

      for (int x = 0; x < s.width && status == CELD_OK; x += 8)
        {
          uint64_t here, over, edges;

          memcpy (&here, row + x, 8);
          memcpy (&over, above + x, 8);
          edges = here & ~over & 0x0101010101010101u; /* candidates: PIXEL_FOLLOWED may be set meanwhile */
          for (int k = 0; k < 8 && edges && status == CELD_OK; k++)
            if (row[x + k] == PIXEL_INK && !above[x + k])
              status = search_from (&s, x + k, y);
        }
      if (status == CELD_OK && (y & 255) == 255)
        status = celd_progress (host, (double) y / s.height);
    }
  for (int k = 0; k <= MOST_FINER; k++)
    celd_line_end_clear (&s.end[k]);
  celd_free (s.mask);
  celd_free (s.corner);
  if (status == CELD_OK)
    {
      *tip        = s.found.tip;
      *n          = s.found.n;
      s.found.tip = NULL;
    }
  celd_tip_set_close (&s.found);
  return status;
}
