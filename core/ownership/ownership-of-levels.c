/* Contour ownership and depth expansion from a picture of levels in any encoding, for callers that have neither labels
 * nor an order, like operations of a GEGL graph.
 *
 * Each level is a label; with regions, each region of a level.  Labels are numbered from the farthest on.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ownership/ownership.h"

/* Replaces NaN and -0 by 0. */
static float
clean_level (float level)
{
  return level == level ? level + 0.f : 0;
}

/* Maps a float to an integer with the same order. */
static uint32_t
rank_of_level (float level)
{
  float    clean = clean_level (level);
  uint32_t bits;

  memcpy (&bits, &clean, sizeof bits);
  return bits & UINT32_C (0x80000000) ? ~bits : bits | UINT32_C (0x80000000);
}

/* ------------------------------------------------------------------ levels and regions as labels */

/* Splits the levels, whose numbers are in `label`, by regions. */
static CeldStatus
split_levels_by_region (const CeldLabels *regions, CeldLabels *label, CeldLabels *scratch, size_t *n)
{
  size_t     pixels = (size_t) label->width * (size_t) label->height, n_regions = 0;
  CeldStatus status;

  for (int y = 0; y < label->height; y++)
    memcpy (&CELD_AT (scratch, 0, y), &CELD_AT (regions, 0, y), (size_t) label->width * sizeof (uint32_t));
  status = celd_number_ranks (scratch, NULL, &n_regions);
  if (status == CELD_OK && *n > UINT32_MAX / n_regions)
    status = CELD_NO_MEMORY;
  for (size_t p = 0; p < pixels && status == CELD_OK; p++)
    label->data[p] = (uint32_t) ((label->data[p] - 1) * n_regions) + scratch->data[p];
  return status != CELD_OK ? status : celd_number_ranks (label, NULL, n);
}

/* Records level, region and order of each label. */
static CeldStatus
describe_labels (const CeldPlane *levels, const CeldLabels *regions, CeldLevelOwnership *made)
{
  const CeldLabels *label = &made->own.owner;

  made->order  = celd_alloc (made->n, sizeof *made->order);
  made->level  = celd_alloc (made->n, sizeof *made->level);
  made->region = celd_alloc (made->n, sizeof *made->region);
  if (!made->order || !made->level || !made->region)
    return CELD_NO_MEMORY;
  for (int y = 0; y < label->height; y++)
    for (int x = 0; x < label->width; x++)
      {
        size_t k = CELD_AT (label, x, y) - 1;

        made->level[k]  = clean_level (CELD_AT (levels, x, y));
        made->region[k] = regions ? CELD_AT (regions, x, y) : 0;
      }
  for (size_t k = 0; k < made->n; k++)
    made->order[k] = k ? made->order[k - 1] + (made->level[k] > made->level[k - 1]) : 0;
  return CELD_OK;
}

static CeldStatus
number_labels (const CeldPlane *levels, const CeldLabels *regions, CeldLevelOwnership *made)
{
  CeldLabels *label = &made->own.owner;
  CeldStatus  status;

  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      CELD_AT (label, x, y) = rank_of_level (CELD_AT (levels, x, y));
  status = celd_number_ranks (label, NULL, &made->n);
  if (status == CELD_OK && regions)
    status = split_levels_by_region (regions, label, &made->own.under, &made->n);
  return status != CELD_OK ? status : describe_labels (levels, regions, made);
}

/* ------------------------------------------------------------------ corrections */

/* The largest label of a region; 0 if there is none. */
static uint32_t
find_region (const CeldLevelOwnership *made, const size_t *area, uint32_t region)
{
  uint32_t found = 0;

  for (size_t k = 0; k < made->n; k++)
    if (made->region[k] == region && (!found || area[k] > area[found - 1]))
      found = (uint32_t) k + 1;
  return found;
}

/* Translates corrections from regions to labels. */
static CeldStatus
number_corrections (const CeldLevelOwnership *made, const CeldLabels *corrections, CeldLabels *numbered)
{
  const CeldLabels *label = &made->own.owner;
  size_t           *area = celd_alloc0 (made->n, sizeof *area);
  CeldStatus        status = area ? celd_labels_new (label->width, label->height, numbered) : CELD_NO_MEMORY;

  for (size_t p = 0; p < (size_t) label->width * (size_t) label->height && status == CELD_OK; p++)
    area[label->data[p] - 1]++;
  for (int y = 0; y < label->height && status == CELD_OK; y++)
    for (int x = 0; x < label->width; x++)
      {
        const uint32_t *stroke = &CELD_AT (corrections, x, y);

        if (*stroke)
          CELD_AT (numbered, x, y) = x && stroke[-1] == *stroke ? CELD_AT (numbered, x - 1, y)
                                                                : find_region (made, area, *stroke);
      }
  celd_free (area);
  return status;
}

/* ------------------------------------------------------------------ public functions */

CeldStatus
celd_level_ownership_new (const CeldPlane *ink, const CeldPaint *colours, const CeldPlane *levels,
                          const CeldLabels *regions, const CeldLabels *corrections, CeldExpansion method,
                          const CeldHost *host, CeldLevelOwnership *made)
{
  CeldLabels numbered = { 0 };
  CeldStatus status;

  *made = (CeldLevelOwnership) { 0 };
  if (!CELD_SAME_SIZE (ink, levels) || (regions && !CELD_SAME_SIZE (ink, regions)) ||
      (corrections && !CELD_SAME_SIZE (ink, corrections)))
    return CELD_BAD_SIZE;
  if (corrections && !regions)
    return CELD_BAD_VALUE;
  status = celd_ownership_new (levels->width, levels->height, &made->own);
  if (status == CELD_OK)
    status = number_labels (levels, regions, made);
  if (status == CELD_OK && corrections)
    status = number_corrections (made, corrections, &numbered);
  if (status == CELD_OK)
    status = celd_own (ink, colours, &made->own.owner, made->order, made->n, corrections ? &numbered : NULL, method,
                       host, &made->own);
  celd_free (numbered.data);
  return status;
}

CeldStatus
celd_expanded_ownership_new (const CeldPlane *ink, const CeldPlane *levels, CeldLevelOwnership *made)
{
  CeldLabels larger = { 0 };
  CeldRect   all = { 0, 0, levels->width, levels->height };
  CeldStatus status;

  *made  = (CeldLevelOwnership) { 0 };
  status = celd_ownership_new (levels->width, levels->height, &made->own);
  if (status == CELD_OK)
    status = number_labels (levels, NULL, made);
  if (status == CELD_OK)
    status = celd_labels_new (levels->width, levels->height, &larger);
  if (status == CELD_OK)
    {
      memcpy (larger.data, made->own.owner.data, (size_t) all.width * (size_t) all.height * sizeof *larger.data);
      celd_ownership_coverage (ink, &larger, made->order, all, false, &made->own);
    }
  celd_free (larger.data);
  return status;
}

void
celd_level_ownership_clear (CeldLevelOwnership *made)
{
  celd_ownership_clear (&made->own);
  celd_free (made->order);
  celd_free (made->level);
  celd_free (made->region);
}

/* The level of the label that covers most of each pixel. */
static void
write_levels (const CeldLevelOwnership *made, CeldPlane *expanded)
{
  for (int y = 0; y < expanded->height; y++)
    for (int x = 0; x < expanded->width; x++)
      CELD_AT (expanded, x, y) = made->level[celd_larger_label (&made->own, x, y) - 1];
}

CeldStatus
celd_expand_levels (const CeldPlane *ink, const CeldPaint *colours, const CeldPlane *levels,
                    const CeldLabels *regions, const CeldLabels *corrections, CeldExpansion method,
                    const CeldHost *host, CeldPlane *expanded)
{
  CeldLevelOwnership made;
  CeldStatus         status;

  if (!CELD_SAME_SIZE (levels, expanded))
    return CELD_BAD_SIZE;
  status = celd_level_ownership_new (ink, colours, levels, regions, corrections, method, host, &made);
  if (status == CELD_OK)
    write_levels (&made, expanded);
  celd_level_ownership_clear (&made);
  return status;
}

CeldStatus
celd_matte_of_levels (const CeldPlane *ink, const CeldPaint *colours, const CeldPlane *levels,
                      const CeldLabels *regions, const CeldLabels *corrections, CeldExpansion method,
                      const CeldHost *host, CeldPlane *level, CeldLabels *region, CeldPlane *coverage)
{
  CeldLevelOwnership made;
  CeldStatus         status;

  if (!CELD_SAME_SIZE (levels, level) || !CELD_SAME_SIZE (levels, coverage) ||
      (region && !CELD_SAME_SIZE (levels, region)))
    return CELD_BAD_SIZE;
  status = celd_level_ownership_new (ink, colours, levels, regions, corrections, method, host, &made);
  for (int y = 0; y < levels->height && status == CELD_OK; y++)
    for (int x = 0; x < levels->width; x++)
      {
        uint32_t owner = CELD_AT (&made.own.owner, x, y);

        CELD_AT (coverage, x, y) = CELD_AT (&made.own.coverage, x, y);
        CELD_AT (level, x, y) = made.level[owner - 1];
        if (region)
          CELD_AT (region, x, y) = made.region[owner - 1];
      }
  celd_level_ownership_clear (&made);
  return status;
}
