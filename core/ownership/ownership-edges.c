/* Antialiased edges of ink: how much of a pixel is the label's that drew the ink, and what is seen beside it.
 *
 * Ink fades into paper over one or two pixels.  A pixel between the two has ink of the darkest pixel around it and
 * paper of the brightest: the ink's value says how much of each.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "ownership/ownership.h"

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
  const float    *value = &CELD_AT (ink, 0, y);
  const uint32_t *owner = &CELD_AT (&own->owner, 0, y);
  uint32_t       *under = &CELD_AT (&own->under, 0, y);
  float          *share = &CELD_AT (&own->share, 0, y);

  memcpy (under, owner, (size_t) ink->width * sizeof *under);
  for (int x = 0; x < ink->width; x++)
    {
      float part = celd_is_paper (value[x]) ? value[x] : 1 - value[x];

      share[x] = 1;
      if (!(part < 1))
        continue;
      under[x] = look_around (ink, &own->owner, x, y, !celd_is_paper (value[x]));
      if (under[x] != owner[x])
        share[x] = part;
    }
}

/* The nearer label as owner. */
static void
sort_row (const uint32_t *level, int y, CeldOwnership *own)
{
  uint32_t *owner = &CELD_AT (&own->owner, 0, y), *under = &CELD_AT (&own->under, 0, y);
  float    *share = &CELD_AT (&own->share, 0, y);

  for (int x = 0; x < own->owner.width; x++)
    if (owner[x] != under[x] && level[under[x] - 1] > level[owner[x] - 1])
      {
        uint32_t larger = owner[x];

        owner[x] = under[x];
        under[x] = larger;
        share[x] = 1 - share[x];
      }
}

void
celd_share_edges (const CeldPlane *ink, const uint32_t *level, CeldOwnership *own)
{
  for (int y = 0; y < ink->height; y++)
    {
      share_row (ink, y, own);
      if (y > 0)
        sort_row (level, y - 1, own); /* a row looks around in the next one */
    }
  sort_row (level, ink->height - 1, own);
}

/* ------------------------------------------------------------------ a part of the picture, again */

/* A pixel's part of the record. */
typedef struct { uint32_t owner, under; float share; } Share;

static Share
share_at (const CeldPlane *ink, const CeldLabels *larger, int x, int y)
{
  float value = CELD_AT (ink, x, y), part = celd_is_paper (value) ? value : 1 - value;
  Share s = { CELD_AT (larger, x, y), CELD_AT (larger, x, y), 1 };

  if (part < 1)
    s.under = look_around (ink, larger, x, y, !celd_is_paper (value));
  if (s.under != s.owner)
    s.share = part;
  return s;
}

/* Puts it into the record, the nearer label as owner.  Is that something new? */
static bool
put_share (Share s, const uint32_t *level, int x, int y, CeldOwnership *own)
{
  uint32_t *owner = &CELD_AT (&own->owner, x, y), *under = &CELD_AT (&own->under, x, y);
  float    *share = &CELD_AT (&own->share, x, y);
  bool      new;

  if (s.owner != s.under && level[s.under - 1] > level[s.owner - 1])
    s = (Share) { s.under, s.owner, 1 - s.share };
  new    = *owner != s.owner || *under != s.under || *share != s.share;
  *owner = s.owner;
  *under = s.under;
  *share = s.share;
  return new;
}

CeldRect
celd_share_again (const CeldPlane *ink, const CeldLabels *larger, const uint32_t *level, CeldRect rect,
                  CeldOwnership *own)
{
  CeldRect changed = { 0 };

  for (int y = rect.y; y < rect.y + rect.height; y++)
    for (int x = rect.x; x < rect.x + rect.width; x++)
      if (put_share (share_at (ink, larger, x, y), level, x, y, own))
        changed = celd_rect_union (changed, (CeldRect) { x, y, 1, 1 });
  return changed;
}

CeldRect
celd_sort_again (const CeldLabels *larger, const uint32_t *level, CeldRect rect, CeldOwnership *own)
{
  CeldRect changed = { 0 };

  for (int y = rect.y; y < rect.y + rect.height; y++)
    for (int x = rect.x; x < rect.x + rect.width; x++)
      {
        uint32_t *owner = &CELD_AT (&own->owner, x, y), *under = &CELD_AT (&own->under, x, y);
        uint32_t  first = *owner, more, less;

        if (first == *under)
          continue;
        more = CELD_AT (larger, x, y);
        less = first == more ? *under : first;
        if (first == (level[less - 1] > level[more - 1] ? less : more))
          continue;
        *owner = *under;
        *under = first;
        CELD_AT (&own->share, x, y) = 1 - CELD_AT (&own->share, x, y);
        changed = celd_rect_union (changed, (CeldRect) { x, y, 1, 1 });
      }
  return changed;
}
