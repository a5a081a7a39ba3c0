/* Contour ownership: a label for every pixel, ink included; where two labels meet in a pixel, both and the coverage of
 * the nearer one.
 *
 * Coverage: ink fades into paper over one or two pixels.  A pixel in between shows the label of the darkest neighbour
 * with the coverage 1 - ink and that of the brightest neighbour with the rest.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "ownership/ownership.h"

/* ------------------------------------------------------------------ coverage */

/* Rows y - 1, y and y + 1 of the labels that cover most of each pixel; outside the picture NULL. */
typedef struct { const uint32_t *row[3]; } LargerRows;

/* The label of the brightest, or darkest, pixel of the 3 x 3 round (x,y); ties: the first in reading order. */
static uint32_t
extreme_label (const CeldPlane *ink, const LargerRows *larger, int x, int y, bool brightest)
{
  uint32_t found = larger->row[1][x];
  float    best = CELD_AT (ink, x, y);

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < ink->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < ink->width; u++)
      if (brightest ? CELD_AT (ink, u, v) > best : CELD_AT (ink, u, v) < best)
        {
          best  = CELD_AT (ink, u, v);
          found = larger->row[v - y + 1][u];
        }
  return found;
}

/* The labels of a pixel and the coverage of the first. */
typedef struct { uint32_t owner, under; float coverage; } Mixture;

static Mixture
mixture_at (const CeldPlane *ink, const LargerRows *larger, int x, int y)
{
  float   value = CELD_AT (ink, x, y), fraction = celd_is_paper (value) ? value : 1 - value;
  Mixture s = { larger->row[1][x], larger->row[1][x], 1 };

  if (fraction < 1)
    s.under = extreme_label (ink, larger, x, y, !celd_is_paper (value));
  if (s.under != s.owner)
    s.coverage = fraction;
  return s;
}

/* The mixture that the record has. */
static Mixture
recorded_mixture (const CeldOwnership *own, const LargerRows *larger, int x, int y)
{
  Mixture s = { CELD_AT (&own->owner, x, y), CELD_AT (&own->under, x, y), CELD_AT (&own->coverage, x, y) };

  return s.owner == larger->row[1][x] ? s : (Mixture) { s.under, s.owner, 1 - s.coverage };
}

/* Stores it with the nearer label as owner; true if that is a change. */
static bool
put_mixture (Mixture s, const uint32_t *level, int x, int y, CeldOwnership *own)
{
  uint32_t *owner = &CELD_AT (&own->owner, x, y), *under = &CELD_AT (&own->under, x, y);
  float    *coverage = &CELD_AT (&own->coverage, x, y);
  bool      new;

  if (s.owner != s.under && level[s.under - 1] > level[s.owner - 1])
    s = (Mixture) { s.under, s.owner, 1 - s.coverage };
  new    = *owner != s.owner || *under != s.under || *coverage != s.coverage;
  *owner = s.owner;
  *under = s.under;
  *coverage = s.coverage;
  return new;
}

/* Covers the pixels x .. end - 1 of row y; returns those that change. */
static CeldRect
cover_row (const CeldPlane *ink, const LargerRows *larger, const uint32_t *level, int x, int end, int y,
           bool levels_only, CeldOwnership *own)
{
  int first = end, last = x - 1;

  for (; x < end; x++)
    {
      bool one = levels_only && CELD_AT (&own->owner, x, y) == CELD_AT (&own->under, x, y);

      if (one || !put_mixture (levels_only ? recorded_mixture (own, larger, x, y) : mixture_at (ink, larger, x, y),
                               level, x, y, own))
        continue;
      first = x < first ? x : first;
      last  = x;
    }
  return first <= last ? (CeldRect) { first, y, last + 1 - first, 1 } : (CeldRect) { 0 };
}

CeldRect
celd_ownership_coverage (const CeldPlane *ink, const CeldLabels *larger, const uint32_t *level, CeldRect rect,
                         bool levels_only, CeldOwnership *own)
{
  CeldRect changed = { 0 };

  for (int y = rect.y; y < rect.y + rect.height; y++)
    {
      LargerRows rows = { { y > 0 ? &CELD_AT (larger, 0, y - 1) : NULL, &CELD_AT (larger, 0, y),
                            y + 1 < larger->height ? &CELD_AT (larger, 0, y + 1) : NULL } };

      changed = celd_rect_union (changed, cover_row (ink, &rows, level, rect.x, rect.x + rect.width, y, levels_only,
                                                     own));
    }
  return changed;
}

/* ------------------------------------------------------------------ by the thickness of contours */

/* Propagates the labels of pixels that have the level of their label to connected pixels of the same level. */
static CeldStatus
spread_labels (const CeldLabels *labels, const uint32_t *level, const CeldLabels *levels, CeldLabels *owner)
{
  int      w = labels->width, h = labels->height;
  size_t   n = 0, pixels = (size_t) w * (size_t) h;
  int32_t *queue = celd_alloc (pixels, sizeof *queue);

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

/* Expansion grows each level from its own pixels, so that propagation reaches nearly all pixels. */
static CeldStatus
own_by_thickness (const CeldPlane *ink, const CeldLabels *labels, const uint32_t *level, const CeldHost *host,
                  CeldLabels *owner)
{
  CeldLabels levels = { 0 }, found = { 0 };
  CeldStatus status = celd_labels_new (labels->width, labels->height, &levels);

  if (status != CELD_OK)
    return status;
  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      CELD_AT (&levels, x, y) = level[CELD_AT (labels, x, y) - 1];
  status = celd_expand (ink, &levels, host, &levels);
  if (status == CELD_OK)
    status = celd_labels_new (labels->width, labels->height, &found);
  if (status == CELD_OK)
    status = spread_labels (labels, level, &levels, &found);
  for (int y = 0; y < labels->height && status == CELD_OK; y++)
    for (int x = 0; x < labels->width; x++)
      CELD_AT (owner, x, y) = CELD_AT (&found, x, y) ? CELD_AT (&found, x, y) : CELD_AT (labels, x, y);
  celd_free (levels.data);
  celd_free (found.data);
  return status;
}

/* ------------------------------------------------------------------ by outlines */

static CeldStatus
own_by_outlines (const CeldContourPens *pens, const CeldPlane *ink, const CeldLabels *labels, const CeldHost *host,
                 CeldOwnership *own, CeldReassigned *reassigned)
{
  bool      *solid = celd_alloc (pens->n, sizeof *solid);
  CeldStatus status = solid ? celd_solid_labels_find (pens, ink, labels, solid) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_claims_assign (pens, ink, labels, solid, host, &own->owner, &own->coverage);
  if (status == CELD_OK)
    status = celd_enclosed_ink_join (&own->coverage, &own->owner, reassigned);
  if (status == CELD_OK)
    status = celd_line_pieces_give (pens, &own->coverage, &own->owner, reassigned);
  celd_free (solid);
  return status;
}

/* Applies the method, and then the corrections, which need contour edges also for the method `thickness`. */
static CeldStatus
own_ink (const CeldPlane *ink, const CeldPaint *colours, const CeldLabels *labels, const uint32_t *level, size_t n,
         const CeldLabels *corrections, CeldExpansion method, const CeldHost *host, CeldOwnership *own)
{
  CeldContourEdges edges = { 0 };
  CeldContourPens  pens = { 0 };
  CeldReassigned   reassigned = { 0 };
  CeldHostPart     fraction[2];
  CeldHost     first = celd_host_part (&fraction[0], host, 0, 0.5), second = celd_host_part (&fraction[1], host, 0.5,
                                                                                             1);
  CeldStatus   status = CELD_OK;

  if (method == CELD_EXPANSION_OUTLINES || corrections)
    {
      status = celd_contour_edges_new (ink, &first, &edges);
      if (status == CELD_OK && colours && method == CELD_EXPANSION_OUTLINES)
        status = celd_line_shades_read (colours, ink, &edges);
      if (status == CELD_OK)
        status = celd_contour_pens_new (&edges, labels, level, n, &pens);
    }
  if (status == CELD_OK && method == CELD_EXPANSION_OUTLINES)
    status = own_by_outlines (&pens, ink, labels, &second, own, &reassigned);
  else if (status == CELD_OK)
    status = own_by_thickness (ink, labels, level, &second, &own->owner);
  if (status == CELD_OK && corrections)
    status = celd_corrections_apply (&pens, ink, corrections, &own->owner, &reassigned);
  celd_reassigned_clear (&reassigned);
  celd_contour_pens_clear (&pens);
  celd_contour_edges_clear (&edges);
  return status;
}

/* ------------------------------------------------------------------ the step */

/* Checks that sizes agree and labels are within 1 .. n. */
static CeldStatus
check (const CeldPlane *ink, const CeldPaint *colours, const CeldLabels *labels, size_t n,
       const CeldLabels *corrections, const CeldOwnership *own)
{
  if (!CELD_SAME_SIZE (ink, labels) || (colours && !CELD_SAME_SIZE (ink, colours)) || !CELD_SAME_SIZE (labels, &own->owner) || !CELD_SAME_SIZE (labels, &own->under) ||
      !CELD_SAME_SIZE (labels, &own->coverage) || (corrections && !CELD_SAME_SIZE (labels, corrections)))
    return CELD_BAD_SIZE;
  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      if (CELD_AT (labels, x, y) < 1 || CELD_AT (labels, x, y) > n ||
          (corrections && CELD_AT (corrections, x, y) > n))
        return CELD_BAD_VALUE;
  return CELD_OK;
}

/* Completes a record whose `owner` has the label that covers most of each pixel.  As these are overwritten, the two
 * rows that are still needed are copied. */
static CeldStatus
complete (const CeldPlane *ink, const uint32_t *level, CeldOwnership *own)
{
  size_t    w = (size_t) ink->width;
  uint32_t *rows = celd_alloc (w, 2 * sizeof *rows);

  if (!rows)
    return CELD_NO_MEMORY;
  for (int y = 0; y < ink->height; y++)
    {
      uint32_t  *here = rows + (y & 1 ? w : 0), *above = rows + (y & 1 ? 0 : w);
      LargerRows larger = { { above, here, y + 1 < ink->height ? &CELD_AT (&own->owner, 0, y + 1) : NULL } };

      memcpy (here, &CELD_AT (&own->owner, 0, y), w * sizeof *here);
      cover_row (ink, &larger, level, 0, ink->width, y, false, own);
    }
  celd_free (rows);
  return CELD_OK;
}

CeldStatus
celd_own (const CeldPlane *ink, const CeldPaint *colours, const CeldLabels *labels, const uint32_t *level, size_t n,
          const CeldLabels *corrections, CeldExpansion method, const CeldHost *host, CeldOwnership *ownership)
{
  CeldStatus status = check (ink, colours, labels, n, corrections, ownership);

  if (status == CELD_OK)
    status = own_ink (ink, colours, labels, level, n, corrections, method, host, ownership);
  return status == CELD_OK ? complete (ink, level, ownership) : status;
}
