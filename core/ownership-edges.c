/* Antialiased edges of ink: how much of a pixel is the label's that drew the ink, and what is seen beside it.
 *
 * Ink fades into paper over one or two pixels.  A pixel between the two has ink of the darkest pixel around it and
 * paper of the brightest: the ink's value says how much of each.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ownership.h"

/* The label of the brightest pixel within one pixel of (x,y), or of the darkest; ties: the first in reading order. */
static uint32_t
look_around (const CeldPlane *ink, const CeldLabels *owner, int x, int y, bool brightest)
{
  uint32_t found = CELD_AT (owner, x, y);
  float    best = CELD_AT (ink, x, y);

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < ink->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < ink->width; u++)
      if (brightest ? CELD_AT (ink, u, v) > best : CELD_AT (ink, u, v) < best)
        {
          best  = CELD_AT (ink, u, v);
          found = CELD_AT (owner, u, v);
        }
  return found;
}

/* The label of the larger part as owner, that of the other as under. */
static void
share_row (const CeldPlane *ink, int y, CeldOwnership *own)
{
  for (int x = 0; x < ink->width; x++)
    {
      float    value = CELD_AT (ink, x, y), part = celd_is_paper (value) ? value : 1 - value;
      uint32_t owner = CELD_AT (&own->owner, x, y), other = owner;

      if (part < 1)
        other = look_around (ink, &own->owner, x, y, !celd_is_paper (value));
      CELD_AT (&own->under, x, y) = other;
      CELD_AT (&own->share, x, y) = other == owner ? 1 : part;
    }
}

void
celd_share_edges (const CeldPlane *ink, const uint32_t *level, CeldOwnership *own)
{
  for (int y = 0; y < ink->height; y++)
    share_row (ink, y, own);
  for (int y = 0; y < ink->height; y++)
    for (int x = 0; x < ink->width; x++)
      {
        uint32_t *owner = &CELD_AT (&own->owner, x, y), *under = &CELD_AT (&own->under, x, y), larger = *owner;

        if (level[*under - 1] <= level[*owner - 1])
          continue;
        *owner = *under;
        *under = larger;
        CELD_AT (&own->share, x, y) = 1 - CELD_AT (&own->share, x, y);
      }
}
