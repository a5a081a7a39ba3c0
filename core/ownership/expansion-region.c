/* Depth expansion (section 3.3) of one region: the ink that it drew, by the local thickness of the contour.
 *
 * D1 is the distance from the region's paper, D2 the distance from the paper of all farther regions.  The medial axis
 * of the contour lies where D1 - D2 changes sign; the thickness t there is D1 + D2 (the paper has 2 D1, which differs
 * for pixels whose centres lie beside the axis).  Laplace's equation, with insulated boundaries, propagates t to the
 * other contour pixels.  The region takes the contour pixels with D1 < t that are connected to it, and the small gaps
 * that remain.
 *
 * Beyond the paper: only contour connected to the region counts.  An axis pixel has a thickness only if its two nearest
 * points lie opposite each other; where another contour branches off they do not, and t would be too large.  A
 * connected component of contour without an axis has no farther region on its other side (a detail of the region); its
 * thickness is the largest of the axis, and without any axis it is taken as a whole.  A gap is filled if it touches no
 * farther region.
 *
 * All of this happens in a window round the region whose margin is the thickness of the contours there, so that the
 * cost is proportional to the region's bounding box.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "ownership/ownership.h"
#include "solve/laplace.h"

#include <math.h>

#define MIN_GAP               16     /* pixels; gaps smaller than this, or than 2 w^2 for line width w, are filled;
                                      * chosen */
#define OPPOSITE_COSINE       (-0.9) /* cosine; two directions with a larger one are not opposite; chosen */
#define PROPAGATION_TOLERANCE 0.01   /* of the propagated thickness, relative to its range; chosen */
#define TIE_DISTANCE          0.02   /* pixels; D1 has to be below t by this much, so that rounding has no influence;
                                      * chosen */

/* A part of the picture; planes without padding, masks are 0 or 1. */
typedef struct
{
  CeldExpansionState *state;
  uint32_t            k;             /* the level being expanded */
  int                 left, top, width, height;
  size_t              pixels;
  uint8_t            *front;         /* the region's paper */
  uint8_t            *farther;       /* the paper of all farther regions */
  uint8_t            *open;          /* where the next flood fill may go */
  uint8_t            *contour;       /* free ink connected to the region */
  uint8_t            *axis;          /* its medial axis */
  uint8_t            *taken;         /* what the region takes of the contour */
  int32_t            *d1, *d2;       /* D1 and D2, squared */
  int32_t            *near1, *near2; /* the nearest pixels, at distance D1 and D2 */
  float              *t;             /* thickness t of the contour */
  float              *east, *south;  /* Laplace's equation for t */
  int32_t            *stack;
  double              mean, most;    /* of t on the axis; infinite without an axis */
} ExpansionWindow;

/* The first pixel of row y of the window in the picture. */
static inline uint32_t *
state_row (const ExpansionWindow *w, int y)
{
  return w->state->level + (size_t) (w->top + y) * (size_t) w->state->width + (size_t) w->left;
}

/* ------------------------------------------------------------------ the window */

/* Sets the window to the region's box with `margin` pixels round it, clipped to the picture. */
static void
place_window (ExpansionWindow *w, int margin)
{
  const CeldExpansionState *state = w->state;
  CeldRect                  box = state->box[w->k - 1];
  int                       right = box.x + box.width + margin, bottom = box.y + box.height + margin;

  w->left = box.x > margin ? box.x - margin : 0;
  w->top = box.y > margin ? box.y - margin : 0;
  w->width = (right < state->width ? right : state->width) - w->left;
  w->height = (bottom < state->height ? bottom : state->height) - w->top;
  w->pixels = (size_t) w->width * (size_t) w->height;
}

/* Upper bound of the thickness of free ink in the window; 0 if there is none. */
static int
thickest_ink (const ExpansionWindow *w)
{
  const CeldExpansionState *state = w->state;
  int32_t                   deepest = 0;

  for (int y = 0; y < w->height; y++)
    {
      const uint32_t *level = state_row (w, y);
      const int32_t  *distance = state->distance_in_ink + (level - state->level);

      for (int x = 0; x < w->width; x++)
        if (!level[x] && distance[x] > deepest)
          deepest = distance[x];
    }
  return deepest ? (int) (2 * sqrt (deepest)) + 1 : 0;
}

/* Finds a margin that is as wide as the ink within it is thick.  False if there is no ink. */
static bool
find_window (ExpansionWindow *w)
{
  int margin = 1, thickest;

  place_window (w, margin);
  while ((thickest = thickest_ink (w)) > margin)
    {
      margin = thickest;
      place_window (w, margin);
    }
  return thickest > 0;
}

/* Allocates the planes, all 0. */
static CeldStatus
open_window (ExpansionWindow *w)
{
  uint8_t **mask[] = { &w->front, &w->farther, &w->open, &w->contour, &w->axis, &w->taken };
  int32_t **number[] = { &w->d1, &w->d2, &w->near1, &w->near2, &w->stack };
  float   **value[] = { &w->t, &w->east, &w->south };
  bool      good = true;

  for (size_t k = 0; k < sizeof mask / sizeof *mask; k++)
    good = (*mask[k] = celd_alloc0 (w->pixels, 1)) && good;
  for (size_t k = 0; k < sizeof number / sizeof *number; k++)
    good = (*number[k] = celd_alloc0 (w->pixels, sizeof **number[k])) && good;
  for (size_t k = 0; k < sizeof value / sizeof *value; k++)
    good = (*value[k] = celd_alloc0 (w->pixels, sizeof **value[k])) && good;
  return good ? CELD_OK : CELD_NO_MEMORY;
}

static void
close_window (ExpansionWindow *w)
{
  void *plane[] = { w->front, w->farther, w->open, w->contour, w->axis, w->taken, w->d1, w->d2, w->near1, w->near2,
                    w->t, w->east, w->south, w->stack };

  for (size_t k = 0; k < sizeof plane / sizeof *plane; k++)
    celd_free (plane[k]);
}

/* Sets the masks; nearer regions, which are expanded already, are in none of them. */
static void
read_window (ExpansionWindow *w)
{
  for (int y = 0; y < w->height; y++)
    {
      const uint32_t *level = state_row (w, y);
      size_t          p = (size_t) y * (size_t) w->width;

      for (int x = 0; x < w->width; x++, p++)
        {
          w->front[p] = level[x] == w->k;
          w->farther[p] = level[x] && level[x] < w->k;
          w->open[p] = !level[x];
        }
    }
}

/* ------------------------------------------------------------------ the contour and its thickness */

/* Flood fill from the region: marks the open pixels that are connected to it in `reached`. */
static void
flood (const ExpansionWindow *w, uint8_t *reached)
{
  size_t n = 0;

  for (size_t p = 0; p < w->pixels; p++)
    if (w->front[p])
      w->stack[n++] = (int32_t) p;
  while (n)
    {
      int p = w->stack[--n], x = p % w->width, y = p / w->width;
      int next[4] = { x > 0 ? p - 1 : p, x + 1 < w->width ? p + 1 : p,
                      y > 0 ? p - w->width : p, y + 1 < w->height ? p + w->width : p };

      for (int i = 0; i < 4; i++)
        if (w->open[next[i]] && !reached[next[i]])
          {
            reached[next[i]] = 1;
            w->stack[n++] = next[i];
          }
    }
}

/* The sign of D1 - D2. */
static inline int
side (const ExpansionWindow *w, size_t p)
{
  return (w->d1[p] > w->d2[p]) - (w->d1[p] < w->d2[p]);
}

/* Is D1 - D2 zero at the contour pixel p, or does it change sign between p and one of its 8 neighbours? */
static bool
on_axis (const ExpansionWindow *w, int x, int y, size_t p)
{
  if (side (w, p) == 0)
    return true;
  for (int dy = -1; dy <= 1; dy++)
    for (int dx = -1; dx <= 1; dx++)
      {
        size_t q = p + (size_t) (dy * w->width + dx);

        if (x + dx >= 0 && x + dx < w->width && y + dy >= 0 && y + dy < w->height &&
            w->contour[q] && side (w, q) == -side (w, p))
          return true;
      }
  return false;
}

/* Do the nearest points of the region and of farther regions lie on opposite sides of (x,y)? */
static bool
between_opposites (const ExpansionWindow *w, int x, int y, size_t p)
{
  double x1 = w->near1[p] % w->width - x, y1 = w->near1[p] / w->width - y;
  double x2 = w->near2[p] % w->width - x, y2 = w->near2[p] / w->width - y;

  return x1 * x2 + y1 * y2 <= OPPOSITE_COSINE * sqrt ((double) w->d1[p] * (double) w->d2[p]);
}

/* Finds the axis, and t = D1 + D2 on it. */
static void
find_axis (ExpansionWindow *w)
{
  double sum = 0;
  size_t n = 0, p = 0;

  for (int y = 0; y < w->height; y++)
    for (int x = 0; x < w->width; x++, p++)
      if (w->contour[p] && w->d2[p] < INT32_MAX && on_axis (w, x, y, p) && between_opposites (w, x, y, p))
        {
          double t = sqrt (w->d1[p]) + sqrt (w->d2[p]);

          w->axis[p] = 1;
          w->t[p] = (float) t;
          w->most = n && w->most > t ? w->most : t;
          sum += t;
          n++;
        }
  w->mean = n ? sum / (double) n : INFINITY;
  w->most = n ? w->most : INFINITY;
}

/* Removes contour that is farther from the region than any contour is thick, since it cannot be taken. */
static void
trim_contour (ExpansionWindow *w)
{
  double most = w->most * w->most;

  for (size_t p = 0; p < w->pixels; p++)
    if (w->d1[p] >= most)
      w->contour[p] = 0;
}

/* Solves Laplace's equation for t over the contour.  Components without an axis keep the initial value. */
static CeldStatus
propagate_thickness (ExpansionWindow *w, const CeldHost *host)
{
  CeldLaplace *laplace = NULL;
  CeldHostPart part[2];
  CeldHost     set_up = celd_host_part (&part[0], host, 0, 0.3), solve = celd_host_part (&part[1], host, 0.3, 1);
  CeldStatus   status;

  for (size_t p = 0; p < w->pixels; p++)
    if (!w->axis[p])
      w->t[p] = (float) w->most;
  if (isinf (w->most))
    return celd_progress (host, 1);
  for (size_t p = 0; p < w->pixels; p++)
    if (w->contour[p])
      {
        w->east[p] = p % (size_t) w->width + 1 < (size_t) w->width && w->contour[p + 1];
        w->south[p] = p + (size_t) w->width < w->pixels && w->contour[p + (size_t) w->width];
      }
  status = celd_lap_setup (w->width, w->height, w->east, w->south, NULL, w->axis, &set_up, &laplace);
  if (status == CELD_OK)
    status = celd_lap_solve (laplace, 1, NULL, w->t, PROPAGATION_TOLERANCE, &solve, NULL);
  celd_lap_free (laplace);
  return status;
}

/* ------------------------------------------------------------------ what the region takes */

static void
take_contour (ExpansionWindow *w)
{
  for (size_t p = 0; p < w->pixels; p++)
    w->open[p] = w->contour[p] && sqrt (w->d1[p]) < w->t[p] - TIE_DISTANCE;
  flood (w, w->taken);
}

/* Does pixel (x,y) touch a farther region, or the boundary of the window inside the picture, beyond which one may be?
 * */
static bool
touches_others (const ExpansionWindow *w, int x, int y)
{
  size_t p = (size_t) y * (size_t) w->width + (size_t) x;

  if ((x == 0 && w->left > 0) || (x + 1 == w->width && w->left + w->width < w->state->width) ||
      (y == 0 && w->top > 0) || (y + 1 == w->height && w->top + w->height < w->state->height))
    return true;
  return (x > 0 && w->farther[p - 1]) || (x + 1 < w->width && w->farther[p + 1]) ||
         (y > 0 && w->farther[p - (size_t) w->width]) || (y + 1 < w->height && w->farther[p + (size_t) w->width]);
}

/* Takes the small remaining components of contour that touch no farther region. */
static CeldStatus
fill_gaps (ExpansionWindow *w, const CeldHost *host)
{
  CeldLabels     gaps = { 0 };
  CeldComponent *list = NULL;
  double         stroke = w->mean - 1, limit = fmax (MIN_GAP, 2 * stroke * stroke);
  size_t         n = 0, p = 0;
  CeldStatus     status = celd_labels_new (w->width, w->height, &gaps);

  for (p = 0; p < w->pixels && status == CELD_OK; p++)
    gaps.data[p] = w->contour[p] && !w->taken[p];
  if (status == CELD_OK)
    status = celd_components (&gaps, 0, false, host, &gaps, &list, &n);
  if (status != CELD_OK)
    goto done;
  for (int y = 0; y < w->height; y++)
    for (int x = 0; x < w->width; x++)
      if (CELD_AT (&gaps, x, y) && touches_others (w, x, y))
        list[CELD_AT (&gaps, x, y) - 1].label = 0; /* not to be filled */
  for (p = 0; p < w->pixels; p++)
    if (gaps.data[p] && list[gaps.data[p] - 1].label && (double) list[gaps.data[p] - 1].area < limit)
      w->taken[p] = 1;
done:
  celd_free (gaps.data);
  celd_free (list);
  return status;
}

static void
write_window (const ExpansionWindow *w)
{
  const uint8_t *taken = w->taken;

  for (int y = 0; y < w->height; y++)
    for (int x = 0; x < w->width; x++)
      if (*taken++)
        state_row (w, y)[x] = w->k;
}

CeldStatus
celd_expand_region (CeldExpansionState *state, uint32_t k, const CeldHost *host)
{
  ExpansionWindow w = { .state = state, .k = k };
  CeldHostPart    part[4];
  CeldHost        first = celd_host_part (&part[0], host, 0, 0.2), second = celd_host_part (&part[1], host, 0.2, 0.4);
  CeldHost        third = celd_host_part (&part[2], host, 0.4, 0.9), fourth = celd_host_part (&part[3], host, 0.9, 1);
  CeldStatus      status;

  if (!state->box[k - 1].width || !find_window (&w))
    return celd_progress (host, 1);
  status = open_window (&w);
  if (status != CELD_OK)
    goto done;
  read_window (&w);
  status = celd_nearest (w.width, w.height, w.front, &first, w.d1, w.near1);
  if (status == CELD_OK)
    status = celd_nearest (w.width, w.height, w.farther, &second, w.d2, w.near2);
  if (status != CELD_OK)
    goto done;
  flood (&w, w.contour);
  find_axis (&w);
  trim_contour (&w);
  status = propagate_thickness (&w, &third);
  if (status != CELD_OK)
    goto done;
  take_contour (&w);
  status = fill_gaps (&w, &fourth);
  if (status == CELD_OK)
    write_window (&w);
done:
  close_window (&w);
  return status;
}
