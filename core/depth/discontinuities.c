/* Depth discontinuities: the weights v_pq of eq. (3).
 *
 * The paper sets v_pq = I_p where levels differ.  With antialiased ink depth then leaks along whole contours, even more
 * after expansion, when the boundary runs along the edge of the ink.  So here v_pq is the least ink within half a
 * stroke width of p and q, and exactly 0 where that is full ink.  Then a closed contour is a discontinuity whether
 * levels are expanded or not, a nick no wider than the stroke does not open it at any resolution, and a gap or a
 * virtual contour gives a smooth transition.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "image/image.h"

#define LARGEST_RADIUS 12 /* pixels: half the width of the widest stroke; wider ink is an area (chosen) */

int
celd_edge_radius (int stroke)
{
  int reach = (stroke + 1) / 2;

  return reach < 1 ? 1 : reach > LARGEST_RADIUS ? LARGEST_RADIUS : reach;
}

/* The least ink of the pixels x0 .. x1, y0 .. y1 in the picture, or any value at or below the threshold if there is
 * one; NaN reads as paper. */
static float
least_ink (const CeldDepthEdges *b, int x0, int y0, int x1, int y1)
{
  float least = 1;

  for (int y = y0 > 0 ? y0 : 0; y <= y1 && y < b->ink->height && least > b->threshold; y++)
    for (int x = x0 > 0 ? x0 : 0; x <= x1 && x < b->ink->width; x++)
      if (CELD_AT (b->ink, x, y) < least)
        least = CELD_AT (b->ink, x, y);
  return least;
}

float
celd_discontinuity_weight (const CeldDepthEdges *b, int x, int y, int right, int down)
{
  float least = least_ink (b, x, y, x + right, y + down); /* usually decides on closed contours */

  if (least > b->threshold)
    least = least_ink (b, x - b->radius, y - b->radius, x + right + b->radius, y + down + b->radius);
  return least <= b->threshold ? 0 : least;
}

/* Sets weights to 1 where two rows of levels are equal, and marks the others. */
CELD_CLONES static void
compare_levels (const float *restrict a, const float *restrict b, int n, float *restrict weight,
                uint8_t *restrict differs)
{
  for (int x = 0; x < n; x++)
    {
      weight[x]  = a[x] == b[x] ? 1.f : 0.f;
      differs[x] = a[x] == b[x] ? 0 : 0x80;
    }
}

static void
weigh_row (const CeldDepthEdges *b, const float *level, int n, int y, int right, float *weight, uint8_t *differs)
{
  compare_levels (level, level + (right ? 1 : b->ink->width), n, weight, differs);
  for (int x = celd_next_marked (n, differs, 0); x < n; x = celd_next_marked (n, differs, x + 1))
    weight[x] = celd_discontinuity_weight (b, x, y, right, !right);
}

CeldStatus
celd_depth_weights (const CeldPlane *ink, const float *level, float threshold, const CeldHost *host,
                    float *east, float *south)
{
  CeldDepthEdges b = { ink, threshold, celd_edge_radius (celd_stroke_width (ink)) };
  size_t         w = (size_t) ink->width;
  uint8_t       *differs = celd_alloc (w, 1);
  CeldStatus     status = differs ? CELD_OK : CELD_NO_MEMORY;

  for (int y = 0; y < ink->height && status == CELD_OK; y++, level += w, east += w, south += w)
    {
      weigh_row (&b, level, ink->width - 1, y, 1, east, differs);
      east[w - 1] = 0;
      if (y + 1 < ink->height)
        weigh_row (&b, level, ink->width, y, 0, south, differs);
      else
        memset (south, 0, w * sizeof *south);
      if (y % 64 == 0)
        status = celd_progress (host, (double) y / ink->height);
    }
  celd_free (differs);
  return status;
}
