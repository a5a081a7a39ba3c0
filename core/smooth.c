/* Smooth depth, eq. (3): minimize  sum v_pq (d_p - d_q)^2  with d = level at the anchors (the paper's U_o).
 *
 * The paper takes v_pq = I_p where levels differ.  On antialiased ink that leaks along the whole contour, more so once
 * ink belongs to its owner and the border runs along the ink's edge; so v_pq is the least ink around p and q, as far as
 * half a stroke is wide, and exactly 0 where that is full ink.  A closed contour then cuts, whether levels are expanded
 * or not, a nick no wider than the stroke does not open it at any resolution, and a gap or a virtual contour gives
 * a smooth transition.
 *
 * Without anchors given, each connected region of one level is held in its inner core: the pixels that lie at least
 * half as deep inside it as its deepest pixel.  (Distances count from the region's border, not from the frame.)
 * Specks are not held: they would stand out as spikes.  Beside given anchors, the core is for regions that have none:
 * one pixel of a gap in its contour would give the whole of such a region its neighbour's depth.  What no anchor
 * reaches keeps its level, the mean over its area if it has several.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "private.h"

#include <math.h>
#include <string.h>

#define MOST_REACH 12 /* pixels: half a stroke at most, for solid areas are none */
#define SPECK 16 /* regions of fewer pixels have no core, as in celd_separate */

/* ------------------------------------------------------------------ weights of edges */

/* Where levels differ. */
typedef struct { const CeldPlane *ink; float threshold; int reach; } Border;

/* Least ink of the pixels x0 .. x1, y0 .. y1 that lie in the picture, or any at or below the threshold; NaN reads as
 * paper. */
static float
least_ink (const Border *b, int x0, int y0, int x1, int y1)
{
  float least = 1;

  for (int y = y0 > 0 ? y0 : 0; y <= y1 && y < b->ink->height && least > b->threshold; y++)
    for (int x = x0 > 0 ? x0 : 0; x <= x1 && x < b->ink->width; x++)
      if (CELD_AT (b->ink, x, y) < least)
        least = CELD_AT (b->ink, x, y);
  return least;
}

/* v_pq of the pixel (x,y) and the one `right` and `down` of it. */
static float
weight (const Border *b, const float *level, int x, int y, int right, int down)
{
  size_t i = (size_t) y * (size_t) b->ink->width + (size_t) x, j = i + (right ? 1 : (size_t) b->ink->width);

  if (x + right >= b->ink->width || y + down >= b->ink->height)
    return 0;
  if (level[i] == level[j])
    return 1;

  float least = least_ink (b, x - b->reach, y - b->reach, x + right + b->reach, y + down + b->reach);

  return least <= b->threshold ? 0 : least;
}

CeldStatus
celd_depth_weights (const CeldPlane *ink, const float *level, float threshold, const CeldRun *run,
                    float *east, float *south)
{
  Border b = { ink, threshold, (celd_stroke_width (ink) + 1) / 2 };
  size_t i = 0;

  b.reach = b.reach < 1 ? 1 : b.reach > MOST_REACH ? MOST_REACH : b.reach;
  for (int y = 0; y < ink->height; y++)
    {
      if (y % 64 == 0 && celd_step (run, (double) y / ink->height) != CELD_OK)
        return CELD_CANCELLED;
      for (int x = 0; x < ink->width; x++, i++)
        {
          east[i]  = weight (&b, level, x, y, 1, 0);
          south[i] = weight (&b, level, x, y, 0, 1);
        }
    }
  return CELD_OK;
}

/* ------------------------------------------------------------------ levels */

void
celd_depth_levels (const CeldPlane *levels, float *level)
{
  float least = INFINITY;

  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      if (isfinite (CELD_AT (levels, x, y)) && CELD_AT (levels, x, y) < least)
        least = CELD_AT (levels, x, y);
  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        float d = CELD_AT (levels, x, y);

        *level++ = isfinite (d) ? d + 0.f : isfinite (least) ? least : 0; /* + 0 makes -0 the same level as 0 */
      }
}

CeldStatus
celd_depth_regions (int width, int height, const float *level, const CeldRun *run, CeldLabels *regions,
                    CeldComponent **list, size_t *n)
{
  CeldLabels bits; /* every distinct level as a label */
  CeldStatus status = celd_labels_new (width, height, &bits);

  if (status == CELD_OK)
    {
      memcpy (bits.data, level, (size_t) width * (size_t) height * sizeof *level);
      status = celd_components (&bits, UINT32_MAX, false, run, regions, list, n);
    }
  celd_free (bits.data);
  return status;
}

/* ------------------------------------------------------------------ anchors */

/* Pixels beside another region. */
static void
mark_borders (const CeldLabels *regions, uint8_t *border)
{
  size_t w = (size_t) regions->width, n = w * (size_t) regions->height;

  memset (border, 0, n);
  for (size_t i = 0; i < n; i++)
    {
      if (i % w + 1 < w && regions->data[i] != regions->data[i + 1])
        border[i] = border[i + 1] = 1;
      if (i + w < n && regions->data[i] != regions->data[i + w])
        border[i] = border[i + w] = 1;
    }
}

static void
read_anchors (const CeldMask *anchors, uint8_t *fixed)
{
  for (int y = 0; y < anchors->height; y++)
    for (int x = 0; x < anchors->width; x++)
      *fixed++ = CELD_AT (anchors, x, y) != 0;
}

/* Which regions have no anchor and are no speck; how many. */
static size_t
find_unheld (const CeldLabels *regions, const CeldComponent *list, size_t count, const uint8_t *fixed, uint8_t *unheld)
{
  size_t left = 0;

  for (size_t k = 1; k <= count; k++)
    unheld[k] = list[k - 1].area >= SPECK;
  for (size_t i = 0; i < (size_t) regions->width * (size_t) regions->height; i++)
    if (fixed[i])
      unheld[regions->data[i]] = 0;
  for (size_t k = 1; k <= count; k++)
    left += unheld[k];
  return left;
}

/* Marks the pixels of these regions that lie at least half as deep inside as their region's deepest pixel. */
static CeldStatus
mark_cores (const CeldLabels *regions, size_t count, const uint8_t *unheld, const CeldRun *run, uint8_t *fixed)
{
  size_t     n       = (size_t) regions->width * (size_t) regions->height;
  uint8_t   *border  = celd_alloc (n, sizeof *border);
  int32_t   *squared = celd_alloc (n, sizeof *squared), *deepest = celd_alloc0 (count + 1, sizeof *deepest);
  CeldStatus status  = border && squared && deepest ? CELD_OK : CELD_NO_MEMORY;

  if (status != CELD_OK)
    goto done;
  mark_borders (regions, border);
  status = celd_distance (regions->width, regions->height, border, run, squared);
  if (status != CELD_OK)
    goto done;
  for (size_t i = 0; i < n; i++)
    if (squared[i] > deepest[regions->data[i]])
      deepest[regions->data[i]] = squared[i];
  for (size_t i = 0; i < n; i++)
    if (unheld[regions->data[i]] && squared[i] >= deepest[regions->data[i]] / 4)
      fixed[i] = 1;

done:
  celd_free (border);
  celd_free (squared);
  celd_free (deepest);
  return status;
}

/* Marks the core of each region that has nothing marked yet. */
static CeldStatus
hold_rest (int width, int height, const float *level, const CeldRun *run, uint8_t *fixed)
{
  size_t         count = 0;
  CeldLabels     regions;
  CeldComponent *list   = NULL;
  uint8_t       *unheld = NULL;
  CeldPart       first, second;
  CeldRun        finding = celd_run_part (&first, run, 0, 0.5), measuring = celd_run_part (&second, run, 0.5, 1);
  CeldStatus     status  = celd_labels_new (width, height, &regions);

  if (status == CELD_OK)
    status = celd_depth_regions (width, height, level, &finding, &regions, &list, &count);
  if (status == CELD_OK)
    {
      unheld = celd_alloc0 (count + 1, sizeof *unheld);
      status = unheld ? CELD_OK : CELD_NO_MEMORY;
    }
  if (status == CELD_OK && find_unheld (&regions, list, count, fixed, unheld) > 0)
    status = mark_cores (&regions, count, unheld, &measuring, fixed);
  celd_free (regions.data);
  celd_free (list);
  celd_free (unheld);
  return status;
}

/* ------------------------------------------------------------------ the step */

/* The result, kept within the levels: the solver's error must not carry it beyond. */
static void
deliver (const float *solved, const CeldPlane *levels, CeldPlane *depth)
{
  float low = INFINITY, high = -INFINITY;

  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      if (isfinite (CELD_AT (levels, x, y)))
        {
          low  = fminf (low, CELD_AT (levels, x, y));
          high = fmaxf (high, CELD_AT (levels, x, y));
        }
  for (int y = 0; y < depth->height; y++)
    for (int x = 0; x < depth->width; x++, solved++)
      CELD_AT (depth, x, y) = low <= high ? fminf (fmaxf (*solved, low), high) : 0;
}

CeldStatus
celd_smooth (const CeldPlane *ink, const CeldPlane *levels, const CeldMask *anchors, const CeldSettings *settings,
             const CeldRun *run, CeldPlane *depth, CeldSolve *solve)
{
  if (!CELD_SAME_SIZE (ink, levels) || !CELD_SAME_SIZE (ink, depth) || (anchors && !CELD_SAME_SIZE (ink, anchors)))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;

  int          w = ink->width, h = ink->height;
  size_t       n = (size_t) w * (size_t) h;
  float       *east = celd_alloc (n, sizeof *east), *south = celd_alloc (n, sizeof *south);
  float       *diagonal = celd_alloc0 (n, sizeof *diagonal), *b = celd_alloc0 (n, sizeof *b);
  float       *x = celd_alloc (n, sizeof *x);
  uint8_t     *fixed = celd_alloc0 (n, sizeof *fixed);
  CeldLaplace *laplace = NULL;
  CeldPart     part[4];
  CeldRun      anchoring = celd_run_part (&part[0], run, 0, 0.1), weighing = celd_run_part (&part[1], run, 0.1, 0.15);
  CeldRun      setting_up = celd_run_part (&part[2], run, 0.15, 0.3), solving = celd_run_part (&part[3], run, 0.3, 1);
  CeldStatus   status = east && south && diagonal && b && x && fixed ? CELD_OK : CELD_NO_MEMORY;

  if (status != CELD_OK)
    goto done;
  celd_depth_levels (levels, x);
  if (anchors)
    read_anchors (anchors, fixed);
  if (!anchors || settings->hold_rest)
    status = hold_rest (w, h, x, &anchoring, fixed);
  if (status == CELD_OK)
    status = celd_depth_weights (ink, x, settings->ink_threshold, &weighing, east, south);
  if (status != CELD_OK)
    goto done;
  celd_lap_pin (w, h, fixed, 1, x, east, south, diagonal, b);
  status = celd_lap_setup (w, h, east, south, diagonal, NULL, &setting_up, &laplace);
  if (status == CELD_OK)
    status = celd_lap_solve (laplace, 1, b, x, (double) settings->tolerance, &solving, solve);
  if (status == CELD_OK)
    deliver (x, levels, depth);

done:
  celd_lap_free (laplace);
  celd_free (east);
  celd_free (south);
  celd_free (diagonal);
  celd_free (b);
  celd_free (x);
  celd_free (fixed);
  return status;
}
