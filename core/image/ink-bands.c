/* Bands of paper between two lines side by side that blur or grain has made as dark as the edge of a line.
 *
 * Such paper is a valley of ink: it is lighter than the lines on both sides of it, as in Haralick's topographic primal
 * sketch (1983), though less than half as light as paper.  A line of even darkness has no valley.  Grain within a broad
 * stroke has short ones, which stay ink.
 *
 * Cost: the pixels that are grey ink; 8 bytes a pixel if there are bands.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/ink-steps.h"

#include <string.h>

#define JUST_PAPER   0.5f  /* the darkest ink value that is paper */
#define DIP          0.25f /* how much lighter than both lines the paper is, at least; chosen */
#define BAND_REACH   4     /* pixels from such paper to the cores of both lines, at most; chosen */
#define LEAST_BAND   12    /* pixels from end to end: light spots of chalk within a stroke are shorter; chosen */

/* Does a darker line begin at the pixel in direction (dx,dy)?  It ends where ink is lighter than the pixel. */
static bool
is_beside_line (const CeldPlane *ink, int x, int y, int dx, int dy)
{
  float value = CELD_AT (ink, x, y);

  for (int k = 1; k <= BAND_REACH; k++)
    {
      int u = x + k * dx, v = y + k * dy;

      if (u < 0 || v < 0 || u >= ink->width || v >= ink->height || CELD_AT (ink, u, v) > value)
        return false;
      if (CELD_AT (ink, u, v) <= value - DIP)
        return true;
    }
  return false;
}

static bool
is_between_lines (const CeldPlane *ink, int x, int y)
{
  static const int step[4][2] = { { 1, 0 }, { 0, 1 }, { 1, 1 }, { 1, -1 } };

  for (int k = 0; k < 4; k++)
    if (is_beside_line (ink, x, y, step[k][0], step[k][1]) && is_beside_line (ink, x, y, -step[k][0], -step[k][1]))
      return true;
  return false;
}

CELD_CLONES static bool
any_ink (const float *ink, int n)
{
  int any = 0;

  for (int i = 0; i < n; i++)
    any |= ink[i] < JUST_PAPER;
  return any;
}

/* Marks the pixels of row y that lie between lines; returns whether there are any. */
static bool
mark_row (const CeldPlane *ink, int y, uint8_t *between)
{
  bool any = false;

  for (int left = 0; left < ink->width; left += CELD_PIECE)
    {
      int end = left + celd_piece_at (left, ink->width);

      if (any_ink (&CELD_AT (ink, left, y), end - left)) /* few have */
        for (int x = left; x < end; x++)
          {
            float value = CELD_AT (ink, x, y);

            between[x] = value >= DIP && value < JUST_PAPER && is_between_lines (ink, x, y);
            any = any || between[x];
          }
    }
  return any;
}

/* Makes paper of the connected marked pixels that are as long as a band. */
static CeldStatus
open_bands (const CeldMask *between, CeldPlane *ink)
{
  CeldLabels     band = { 0 };
  CeldComponent *list = NULL;
  size_t         n = 0;
  CeldStatus     status = celd_labels_new (ink->width, ink->height, &band);

  for (int y = 0; y < ink->height && status == CELD_OK; y++)
    for (int x = 0; x < ink->width; x++)
      CELD_AT (&band, x, y) = CELD_AT (between, x, y);
  if (status == CELD_OK)
    status = celd_components (&band, 0, true, NULL, &band, &list, &n);
  for (int y = 0; y < ink->height && status == CELD_OK; y++)
    for (int x = 0; x < ink->width; x++)
      if (CELD_AT (&band, x, y))
        {
          const CeldComponent *c = &list[CELD_AT (&band, x, y) - 1];

          if (c->right - c->left >= LEAST_BAND || c->bottom - c->top >= LEAST_BAND)
            CELD_AT (ink, x, y) = JUST_PAPER;
        }
  celd_free (band.data);
  celd_free (list);
  return status;
}

CeldStatus
celd_ink_part_lines (CeldPlane *ink, CeldMask *between)
{
  bool any = false;

  memset (between->data, 0, between->stride * (size_t) between->height);
  for (int y = 0; y < ink->height; y++)
    any = mark_row (ink, y, &CELD_AT (between, 0, y)) || any;
  return any ? open_bands (between, ink) : CELD_OK;
}
