/* Where a line with a head at either end is divided: two arrows begin at one place and lead away from it in a line.
 *
 * A hand bends each stroke by itself, and sets pens down lightly.  So where two strokes begin there is a kink in a line
 * that is smooth else, or a waist.  Both are fitted to the middle and the width of the paint along the line, which its
 * opacity gives to a fraction of a pixel.  Nothing is found if neither is plain: someone may have painted one stroke
 * and two heads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* All chosen; lengths are widths of the paint. */
#define SLICE_STEP    0.25 /* between slices of a line, ... */
#define SLICE_REACH   1.1  /* ... to either side, ... */
#define SLICE_EDGE    0.9  /* ... beside the paint from here on, ... */
#define SLICE_BLANK   60   /* ... where the opacity is less than this, ... */
#define SLICE_OFF     0.5  /* ... and from the line to the middle of the paint, at most */
#define SLICE_APART   0.75 /* from slices with other paint to those that count, ... */
#define HEAD_LONG     4    /* ... and from the ends of a line, where heads are */
#define FIT_REACH     6    /* to either side of a division, up to where lines are fitted, ... */
#define FIT_LEAST     3.5  /* ... or at least so far */
#define MOST_FIT      52   /* slices of a fit, at most */
#define USUAL_KINK    0.15 /* radians of a kink, ... */
#define USUAL_WAIST   0.07 /* ... and depth of a waist: what stands out by this ... */
#define PLAIN_DIVISION 7    /* ... counts 1 as a square, and is plain from this sum on, ... */
#define LESS_PLAIN    0.5  /* ... unless so much of it is found elsewhere, ... */
#define ELSEWHERE     1.5  /* ... that is so far away: thin beginnings may be long */
#define WAIST_REACH   1    /* of a waist to either side */
#define DIVIDED_APART 0.9  /* between places, at least */
#define MOST_BARE     1.2  /* cost of the head at either end, at most */

/* A slice across a line: the middle and width of its paint; along: the distance from the beginning of the line. */
typedef struct { CeldPoint middle; double width, along; bool beside, clean; } Slice;

/* The slices round one, in widths: where they are along the line (x) and across it (y).  basis: orthogonal polynomials
 * of x. */
typedef struct { double x[MOST_FIT], y[MOST_FIT], width[MOST_FIT], basis[3][MOST_FIT]; int n; } DivisionFit;

/* ------------------------------------------------------------------ slices */

/* The opacity between pixels, 0 .. 255. */
static double
opacity_at (const CeldArrowSearch *s, CeldPoint p)
{
  const CeldPaint *paint = s->layer->paint;
  double           x = p.x + s->mask->left - 0.5, y = p.y + s->mask->top - 0.5, sum = 0;
  int              left = (int) floor (x), top = (int) floor (y);

  for (int k = 0; k < 4; k++)
    {
      int u = left + k % 2, v = top + k / 2;

      if (u >= 0 && v >= 0 && u < paint->width && v < paint->height)
        sum += (1 - fabs (x - u)) * (1 - fabs (y - v)) * celd_arrow_opacity (s->layer, u, v);
    }
  return sum;
}

static Slice
slice_at (const CeldArrowSearch *s, CeldPoint p, CeldPoint way, double along)
{
  double    sum = 0, moment = 0, blank = 0, w = s->width;
  CeldPoint across = { -way.y, way.x };
  int       reach = (int) ceil (2 * SLICE_REACH * w);

  for (int k = -reach; k <= reach; k++)
    {
      double opacity = opacity_at (s, celd_moved (p, across, 0.5 * k));

      sum    += 0.5 * opacity;
      moment += 0.25 * k * opacity;
      if (abs (k) > 2 * SLICE_EDGE * w)
        blank = fmax (blank, opacity);
    }
  if (sum <= 0)
    return (Slice) { .middle = p, .along = along, .beside = true };
  return (Slice) {
    .middle = celd_moved (p, across, moment / sum),
    .width  = sum / 255,
    .along  = along,
    .beside = blank >= SLICE_BLANK || fabs (moment / sum) >= SLICE_OFF * w,
    .clean  = true,
  };
}

/* Leaves out what is near other paint, or in heads. */
static void
leave_out (const CeldArrowSearch *s, Slice *slice, size_t n, double length)
{
  for (int back = 0; back < 2; back++)
    {
      double from = HEAD_LONG * s->width;

      for (size_t i = 0; i < n; i++)
        {
          Slice *here = &slice[back ? n - 1 - i : i];
          double along = back ? length - here->along : here->along;

          if (here->beside)
            from = fmax (from, along + SLICE_APART * s->width);
          here->clean &= along > from;
        }
    }
}

/* The slices of a shaft.  *slice is to be freed by the caller. */
static CeldStatus
slices_new (const CeldArrowSearch *s, const CeldShaft *shaft, Slice **slice, size_t *n)
{
  double step = SLICE_STEP * s->width, along = 0, next = 0;
  size_t capacity = 0;

  *slice = NULL;
  *n     = 0;
  for (size_t i = 1; i < shaft->n; i++)
    {
      CeldPoint  a = shaft->at[i - 1], b = shaft->at[i];
      double     d = celd_points_apart (a, b);
      CeldPoint  way = { (b.x - a.x) / d, (b.y - a.y) / d };
      CeldStatus status = CELD_OK;

      for (; next < along + d && status == CELD_OK; next += step)
        status = celd_append (*slice, *n, capacity, slice_at (s, celd_moved (a, way, next - along), way, next));
      if (status != CELD_OK)
        return status;
      along += d;
    }
  leave_out (s, *slice, *n, along);
  return CELD_OK;
}

/* ------------------------------------------------------------------ kinks and waists */

/* Takes from values what the first functions of a basis are of them. */
static void
take_away (double *value, double basis[][MOST_FIT], int n_basis, int n)
{
  for (int b = 0; b < n_basis; b++)
    {
      double product = 0, square = 1e-12;

      for (int i = 0; i < n; i++)
        {
          product += value[i] * basis[b][i];
          square  += basis[b][i] * basis[b][i];
        }
      for (int i = 0; i < n; i++)
        value[i] -= product / square * basis[b][i];
    }
}

/* How much of a shape there is in values that may be a polynomial of a degree, too; *stands: the part of what else is in
 * them that it explains. */
static double
fit_shape (DivisionFit *f, const double *values, double *shape, int degree, double *stands)
{
  double value[MOST_FIT], product = 0, square = 1e-9, all = 1e-4;

  memcpy (value, values, (size_t) f->n * sizeof *value);
  take_away (value, f->basis, degree + 1, f->n);
  take_away (shape, f->basis, degree + 1, f->n);
  for (int i = 0; i < f->n; i++)
    {
      product += value[i] * shape[i];
      square  += shape[i] * shape[i];
      all     += value[i] * value[i];
    }
  *stands = product * product / square / all;
  return product / square;
}

/* The slices round slice k; false if there are too few on one side. */
static bool
fit_new (const CeldArrowSearch *s, const Slice *slice, size_t n, size_t k, DivisionFit *f)
{
  size_t    first = k, last = k;
  double    w = s->width, d;
  CeldPoint way;

  for (size_t i = k; i-- > 0 && slice[k].along - slice[i].along <= FIT_REACH * w;)
    first = slice[i].clean ? i : first;
  for (size_t i = k + 1; i < n && slice[i].along - slice[k].along <= FIT_REACH * w; i++)
    last = slice[i].clean ? i : last;
  if (slice[k].along - slice[first].along < FIT_LEAST * w || slice[last].along - slice[k].along < FIT_LEAST * w)
    return false;
  d   = celd_points_apart (slice[first].middle, slice[last].middle);
  way = (CeldPoint) { (slice[last].middle.x - slice[first].middle.x) / d,
                      (slice[last].middle.y - slice[first].middle.y) / d };
  f->n = 0;
  for (size_t i = first; i <= last && f->n < MOST_FIT; i++)
    if (slice[i].clean)
      {
        double x = (slice[i].middle.x - slice[k].middle.x) / w, y = (slice[i].middle.y - slice[k].middle.y) / w;

        f->x[f->n]     = x * way.x + y * way.y;
        f->y[f->n]     = y * way.x - x * way.y;
        f->width[f->n] = slice[i].width / w;
        f->n++;
      }
  for (int b = 0; b < 3; b++)
    {
      for (int i = 0; i < f->n; i++)
        f->basis[b][i] = b ? b > 1 ? f->x[i] * f->x[i] : f->x[i] : 1;
      take_away (f->basis[b], f->basis, b, f->n);
    }
  return true;
}

/* How plain the kink is in a line that may bend. */
static double
kink_of (DivisionFit *f)
{
  double shape[MOST_FIT], stands, kink;

  for (int i = 0; i < f->n; i++)
    shape[i] = fabs (f->x[i]);
  kink = 2 * fit_shape (f, f->y, shape, 2, &stands) / USUAL_KINK;
  return kink * kink * stands;
}

/* How plain the waist is of a line that may get narrower on its way. */
static double
waist_of (DivisionFit *f)
{
  double shape[MOST_FIT], stands, waist;

  for (int i = 0; i < f->n; i++)
    shape[i] = -fmax (0, 1 - fabs (f->x[i]) / WAIST_REACH);
  waist = fmax (0, fit_shape (f, f->width, shape, 1, &stands)) / USUAL_WAIST;
  return waist * waist * stands;
}

/* Finds where a shaft is plainly divided, and nowhere else about as plainly; SIZE_MAX = nowhere. */
static CeldStatus
plainest (const CeldArrowSearch *s, const Slice *slice, size_t n, size_t *division)
{
  double *plain = celd_alloc0 (n + 1, sizeof *plain), most = PLAIN_DIVISION;

  *division = SIZE_MAX;
  for (size_t i = 0; plain && i < n; i++)
    {
      DivisionFit fit;

      if (slice[i].clean && fit_new (s, slice, n, i, &fit))
        plain[i] = kink_of (&fit) + waist_of (&fit);
      if (plain[i] > most)
        {
          most      = plain[i];
          *division = i;
        }
    }
  for (size_t i = 0, best = *division; plain && best != SIZE_MAX && i < n; i++)
    if (fabs (slice[i].along - slice[best].along) > ELSEWHERE * s->width && plain[i] > LESS_PLAIN * most)
      *division = SIZE_MAX;
  celd_free (plain);
  return plain ? CELD_OK : CELD_NO_MEMORY;
}

/* ------------------------------------------------------------------ two arrows */

/* Finds a place among the divisions, or adds it; SIZE_MAX = there is another place about there already. */
static CeldStatus
add_division (CeldArrowSearch *s, CeldPoint at, size_t *place)
{
  *place = s->n_places;
  for (size_t p = 0; p < s->n_places; p++)
    if (celd_points_apart (s->place[p], at) < DIVIDED_APART * s->width)
      {
        *place = p < s->n_undivided ? SIZE_MAX : p;
        return CELD_OK;
      }
  return celd_append (s->place, s->n_places, s->place_capacity, at);
}

/* How far a shaft is from its chord at most, by the length of that. */
static double
bow_of (const CeldShaft *shaft)
{
  CeldPoint a = shaft->at[0], b = shaft->at[shaft->n - 1];
  double    bow = 0;

  for (size_t i = 1; i + 1 < shaft->n; i++)
    bow = fmax (bow, celd_distance_to_part (shaft->at[i], a, b) / shaft->length);
  return bow;
}

/* Adds the part of shaft k between one of its ends and a division, with the heads of that end.  along: where it is
 * divided; length: of all of it. */
static CeldStatus
add_part (CeldArrowSearch *s, size_t k, int end, size_t place, double along, double length)
{
  const CeldShaft whole = s->shaft[k];
  size_t          n_options = s->n_options, body;
  CeldShaft       part = { .at = celd_alloc (whole.n + 1, sizeof *part.at), .whole = k };
  double          at = 0;
  CeldStatus      status;

  if (!part.at)
    return CELD_NO_MEMORY;
  part.place[end]     = whole.place[end];
  part.place[1 - end] = place;
  if (end)
    part.at[part.n++] = s->place[place];
  for (size_t i = 0; i < whole.n; i++)
    {
      at += i ? celd_points_apart (whole.at[i - 1], whole.at[i]) : 0;
      if (end ? at > along + 0.5 * s->width : at < along - 0.5 * s->width)
        part.at[part.n++] = whole.at[i];
    }
  if (!end)
    part.at[part.n++] = s->place[place];
  part.length = celd_points_apart (part.at[0], part.at[part.n - 1]);
  part.cost   = whole.cost * (end ? length - along : along) / length;
  part.bow    = bow_of (&part);
  status      = celd_append (s->shaft, s->n_shafts, s->shaft_capacity, part);
  if (status != CELD_OK)
    {
      celd_free (part.at);
      return status;
    }
  status = celd_search_shaft_piece (s, &part, &body);
  for (size_t i = 0; i < n_options && status == CELD_OK; i++)
    if (s->option[i].shaft == k && s->option[i].end == end)
      {
        CeldArrowOption option = s->option[i];

        option.shaft = s->n_shafts - 1;
        option.body  = body;
        status       = celd_search_option_add (s, option);
      }
  return status;
}

static CeldStatus
divide (CeldArrowSearch *s, size_t k)
{
  Slice     *slice;
  size_t     n, division = SIZE_MAX, place = SIZE_MAX;
  CeldStatus status = slices_new (s, &s->shaft[k], &slice, &n);

  if (status == CELD_OK)
    status = plainest (s, slice, n, &division);
  if (status == CELD_OK && division != SIZE_MAX)
    status = add_division (s, slice[division].middle, &place);
  for (int end = 0; end < 2 && status == CELD_OK && place != SIZE_MAX; end++)
    status = add_part (s, k, end, place, slice[division].along, slice[n - 1].along);
  celd_free (slice);
  return status;
}

/* Do heads of one kind fit both ends of a shaft? */
static bool
has_two_heads (const CeldArrowSearch *s, size_t k)
{
  bool fits[2][2] = { { false, false }, { false, false } };

  for (size_t i = 0; i < s->n_options; i++)
    if (s->option[i].shaft == k && s->option[i].mark_cost <= MOST_BARE)
      fits[s->option[i].filled][s->option[i].end] = true;
  return (fits[0][0] && fits[0][1]) || (fits[1][0] && fits[1][1]);
}

CeldStatus
celd_search_divisions_add (CeldArrowSearch *s)
{
  size_t     n = s->n_shafts;
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < n && status == CELD_OK; k++)
    if (s->shaft[k].length >= 2 * (HEAD_LONG + FIT_LEAST) * s->width && has_two_heads (s, k))
      status = divide (s, k);
  return status;
}
