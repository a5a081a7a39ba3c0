/* The smoothness cost of two neighbouring pixels in LazyBrush [SDC09b]: V_pq = 1 + K g (I), K = 2 (width + height), so
 * that one step through paper costs more than any boundary inside ink could.  The paper leaves open:
 *
 * - I of a pair is the darker of its two pixels: a line one pixel wide closes a region even if it is antialiased.
 * - g is 0 up to ink_threshold and from there the cube of I stretched to [0,1]: grey left over by contrast
 *   normalisation costs nothing, half ink 1/27, and paper grain little.
 * - Ink costs less the farther it is from paper, so that boundaries run along the middle of a line, not along its
 *   shorter side (LazyBrush filters the drawing with a LoG for this); with ragged pencil lines both sides stay clean.
 * - Pages are often cropped to the drawing.  Pairs of paper along the frame cost as if some of the margin were left, so
 *   that the background holds together where a figure nearly touches the frame.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"

#include <math.h>

#define MOST_DISCOUNT 10 /* cost units: a pair far from paper costs at most this much less (chosen) */
#define THIN_LINE     1024 /* weakness of a pair in the thinnest line; falls with the cube of the thickness (chosen) */
#define PAGE_MARGIN   16 /* of half the perimeter: the margin that a cropped page is assumed to have had (chosen) */
#define DEAREST       (INT32_MAX / 4) /* that a pair may cost, as a flow and what it returns are added up */

void
celd_smoothness_costs_new (int width, int height, float threshold, CeldSmoothnessCosts *costs)
{
  int32_t dearest;

  costs->width  = width;
  costs->height = height;
  costs->paper_cost  = 2.0 * (width + height);
  for (int i = 0; i <= CELD_INK_STEPS; i++)
    {
      double g = fmax (0, ((double) i / CELD_INK_STEPS - (double) threshold) / (1 - (double) threshold));

      costs->by_ink[i] = (int32_t) (CELD_COST_UNIT * (1 + costs->paper_cost * g * g * g));
    }
  dearest       = DEAREST / costs->by_ink[CELD_INK_STEPS];
  costs->margin = 1 + (width + height) / PAGE_MARGIN;
  costs->margin = costs->margin < dearest ? costs->margin : dearest;
  costs->discount[0] = 0;
  for (int i = 1; i <= CELD_MOST_TO_PAPER; i++)
    costs->discount[i] = (int32_t) (MOST_DISCOUNT * (1 - 1 / sqrt (i)));
  for (int i = 0; i <= CELD_MOST_TO_PAPER; i++)
    costs->weakness[i] = (int32_t) (THIN_LINE / pow (i > 1 ? i : 1, 1.5));
}

static int
ink_step (float ink)
{
  return ink > 0 && ink < 1 ? (int) (ink * CELD_INK_STEPS) : ink <= 0 ? 0 : CELD_INK_STEPS; /* NaN counts as paper */
}

int32_t
celd_smoothness_cost (const CeldSmoothnessCosts *costs, float ink, float other_ink, int32_t to_paper,
                      int32_t other_to_paper, bool along_frame)
{
  int     i = ink_step (ink), j = ink_step (other_ink);
  int32_t d = to_paper < other_to_paper ? to_paper : other_to_paper;

  i = i < j ? i : j;
  if (along_frame && 2 * i >= CELD_INK_STEPS)
    return costs->by_ink[i] * costs->margin;
  return costs->by_ink[i] - (d < 1 ? 0 : costs->discount[d < CELD_MOST_TO_PAPER ? d : CELD_MOST_TO_PAPER]);
}

CeldStatus
celd_distance_to_paper (const CeldPlane *ink, const CeldHost *host, int32_t *to_paper)
{
  size_t     w = (size_t) ink->width, n = w * (size_t) ink->height;
  uint8_t   *paper = celd_alloc (n, 1);
  CeldStatus status = CELD_NO_MEMORY;

  if (!paper)
    return status;
  for (size_t p = 0; p < n; p++)
    paper[p] = celd_is_paper (CELD_AT (ink, p % w, p / w));
  status = celd_distance (ink->width, ink->height, paper, host, to_paper);
  celd_free (paper);
  return status;
}

int32_t
celd_squared_to_paper (const CeldPlane *ink, int x, int y, int32_t most)
{
  for (int r = 1; r * r < most; r++) /* nearer columns and rows have been searched */
    for (int i = -r; i <= r; i++)
      {
        const int at[4][2] = { { x + i, y - r }, { x + i, y + r }, { x - r, y + i }, { x + r, y + i } };

        for (int k = 0; k < 4 && i * i + r * r < most; k++)
          if (at[k][0] >= 0 && at[k][0] < ink->width && at[k][1] >= 0 && at[k][1] < ink->height
              && celd_is_paper (CELD_AT (ink, at[k][0], at[k][1])))
            most = i * i + r * r;
      }
  return most;
}
