/* Whose each pixel is, with its ink: a label for every pixel, and where two meet in one, how much of it is whose.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ownership/ink-edges.h"
#include "ownership/ownership.h"
#include "ownership/pens.h"

/* ------------------------------------------------------------------ by the thickness of contours */

/* The pixels that have the level of their label hand it on to pixels of that level, whose label has another. */
static CeldStatus
spread_labels (const CeldLabels *labels, const uint32_t *level, const CeldLabels *levels, CeldLabels *owner)
{
  int        w = labels->width, h = labels->height;
  size_t     n = 0, pixels = (size_t) w * (size_t) h;
  int32_t   *queue = celd_alloc (pixels, sizeof *queue);

  if (!queue)
    return CELD_NO_MEMORY;
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        uint32_t label = CELD_AT (labels, x, y);
        bool     settled = level[label - 1] == CELD_AT (levels, x, y);

        CELD_AT (owner, x, y) = settled ? label : 0;
        if (settled)
          queue[n++] = (int32_t) (y * w + x);
      }
  for (size_t i = 0; i < n; i++)
    {
      static const int step[4][2] = { { 0, -1 }, { -1, 0 }, { 1, 0 }, { 0, 1 } };
      int              x = queue[i] % w, y = queue[i] / w;

      for (int k = 0; k < 4; k++)
        {
          int u = x + step[k][0], v = y + step[k][1];

          if (u >= 0 && v >= 0 && u < w && v < h && !CELD_AT (owner, u, v) &&
              CELD_AT (levels, u, v) == CELD_AT (levels, x, y))
            {
              CELD_AT (owner, u, v) = CELD_AT (owner, x, y);
              queue[n++] = (int32_t) (v * w + u);
            }
        }
    }
  celd_free (queue);
  return CELD_OK;
}

/* Expansion spreads a level from its own pixels, so that hardly anything stays without a label. */
static CeldStatus
own_by_thickness (const CeldPlane *ink, const CeldLabels *labels, const uint32_t *level, const CeldHost *host,
                  CeldLabels *owner)
{
  CeldLabels levels = { 0 }, found = { 0 };
  CeldStatus status = celd_labels_new (labels->width, labels->height, &levels);

  if (status)
    return status;
  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      CELD_AT (&levels, x, y) = level[CELD_AT (labels, x, y) - 1];
  status = celd_expand (ink, &levels, host, &levels);
  if (!status)
    status = celd_labels_new (labels->width, labels->height, &found);
  if (!status)
    status = spread_labels (labels, level, &levels, &found);
  for (int y = 0; y < labels->height && !status; y++)
    for (int x = 0; x < labels->width; x++)
      CELD_AT (owner, x, y) = CELD_AT (&found, x, y) ? CELD_AT (&found, x, y) : CELD_AT (labels, x, y);
  celd_free (levels.data);
  celd_free (found.data);
  return status;
}

/* ------------------------------------------------------------------ by outlines */

static CeldStatus
own_by_outlines (const CeldPens *pens, const CeldPlane *ink, const CeldLabels *labels, const CeldHost *host,
                 CeldOwnership *own)
{
  bool      *solid = celd_alloc (pens->n, sizeof *solid);
  CeldStatus status = solid ? celd_solid_find (pens, ink, labels, solid) : CELD_NO_MEMORY;

  if (!status)
    status = celd_pens_claim (pens, ink, labels, solid, host, &own->owner, &own->share);
  celd_free (solid);
  return status;
}

/* Either method, and then the corrections, which go by pieces of line.  The thickness has no use for pens by itself. */
static CeldStatus
own_ink (const CeldPlane *ink, const CeldLabels *labels, const uint32_t *level, size_t n, const CeldLabels *corrections,
         CeldExpansion method, const CeldHost *host, CeldOwnership *own)
{
  CeldInkEdges edges = { 0 };
  CeldPens     pens = { 0 };
  CeldGiven    given = { 0 };
  CeldHostPart     part[2];
  CeldHost     first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldStatus   status = CELD_OK;

  if (method == CELD_EXPANSION_OUTLINES || corrections)
    {
      status = celd_ink_edges_new (ink, &first, &edges);
      if (!status)
        status = celd_pens_new (&edges, labels, level, n, &pens);
    }
  if (!status && method == CELD_EXPANSION_OUTLINES)
    status = own_by_outlines (&pens, ink, labels, &second, own);
  else if (!status)
    status = own_by_thickness (ink, labels, level, &second, &own->owner);
  if (!status && corrections)
    status = celd_pens_correct (&pens, ink, corrections, &own->owner, &given);
  celd_given_clear (&given);
  celd_pens_clear (&pens);
  celd_ink_edges_clear (&edges);
  return status;
}

/* Does the record fit the labels? */
static CeldStatus
check (const CeldPlane *ink, const CeldLabels *labels, size_t n, const CeldLabels *corrections,
       const CeldOwnership *own)
{
  if (!CELD_SAME_SIZE (ink, labels) || !CELD_SAME_SIZE (labels, &own->owner) || !CELD_SAME_SIZE (labels, &own->under) ||
      !CELD_SAME_SIZE (labels, &own->share) || (corrections && !CELD_SAME_SIZE (labels, corrections)))
    return CELD_BAD_SIZE;
  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      if (CELD_AT (labels, x, y) < 1 || CELD_AT (labels, x, y) > n ||
          (corrections && CELD_AT (corrections, x, y) > n))
        return CELD_BAD_VALUE;
  return CELD_OK;
}

CeldStatus
celd_own (const CeldPlane *ink, const CeldLabels *labels, const uint32_t *level, size_t n,
          const CeldLabels *corrections, CeldExpansion method, const CeldHost *host, CeldOwnership *ownership)
{
  CeldStatus status = check (ink, labels, n, corrections, ownership);

  if (!status)
    status = own_ink (ink, labels, level, n, corrections, method, host, ownership);
  if (!status)
    celd_share_edges (ink, level, ownership);
  return status;
}
