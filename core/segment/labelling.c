/* Labels on a picture: only pixels whose label changes are written, and the bounding box of all changes is kept.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "segment/basins.h"
#include "segment/task.h"

#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ patches: a list that grows */

CeldStatus
celd_patch_add (CeldPatches *patches, CeldPatch patch)
{
  CeldPatch *item = patches->n ? &patches->item[patches->n - 1] : NULL;

  if (item && item->y == patch.y && item->end == patch.x && item->label == patch.label)
    {
      item->end = patch.end; /* extends the last patch */
      return CELD_OK;
    }
  return celd_append (patches->item, patches->n, patches->item_capacity, patch);
}

void
celd_patches_clear (CeldPatches *patches)
{
  celd_free (patches->item);
  *patches = (CeldPatches) { 0 };
}

/* ------------------------------------------------------------------ the record */

void
celd_labelling_clear (CeldLabelling *labelling)
{
  celd_free (labelling->label);
  celd_patches_clear (&labelling->patches);
  *labelling = (CeldLabelling) { 0 };
}

CeldStatus
celd_labelling_reset (CeldLabelling *labelling, const CeldBasins *basins)
{
  uint32_t *label = celd_alloc0 (basins->n, sizeof *label);

  if (!label)
    return CELD_NO_MEMORY;
  celd_free (labelling->label);
  celd_patches_clear (&labelling->patches);
  labelling->label = label;
  return CELD_OK;
}

void
celd_labelling_invalidate (CeldLabelling *labelling, const CeldBasins *basins)
{
  memset (labelling->label, 0, basins->n * sizeof *labelling->label);
  celd_patches_clear (&labelling->patches);
  labelling->changed = (CeldRect) { 0, 0, basins->width, basins->height };
}

/* ------------------------------------------------------------------ runs of pixels */

static void
add_changed (CeldLabelling *labelling, int y, int left, int right)
{
  labelling->changed = celd_rect_union (labelling->changed, (CeldRect) { left, y, right - left, 1 });
}

static void
fill (uint32_t *row, int n, uint32_t label)
{
  for (int i = 0; i < n; i++)
    row[i] = label;
}

/* Copies the basins' labels in pixels x .. end - 1 of row y to `row`. */
static void
read_basins (const CeldBasins *basins, const uint32_t *label, int y, int x, int end, uint32_t *row)
{
  for (size_t i = celd_basin_run (basins, x, y); x < end; i++)
    {
      int stop = celd_basin_run_end (basins, i, y);

      stop = stop < end ? stop : end;
      fill (row, stop - x, label[basins->run[i].basin]);
      row += stop - x;
      x = stop;
    }
}

/* ------------------------------------------------------------------ a new labelling */

static void
paint_basins (CeldLabelling *labelling, const CeldBasins *basins, const uint32_t *old, CeldLabels *labels)
{
  for (int y = 0; y < basins->height; y++)
    for (size_t i = basins->row[y]; i < basins->row[y + 1]; i++)
      {
        int      x = basins->run[i].x, end = celd_basin_run_end (basins, i, y);
        uint32_t label = labelling->label[basins->run[i].basin];

        if (label == old[basins->run[i].basin])
          continue;
        add_changed (labelling, y, x, end);
        fill (&CELD_AT (labels, x, y), end - x, label);
      }
}

void
celd_labelling_begin (CeldLabelling *labelling, const CeldBasins *basins, uint32_t *label, CeldLabels *labels,
                      CeldLabelling *old)
{
  *old = *labelling;
  labelling->label   = label;
  labelling->patches = (CeldPatches) { 0 };
  paint_basins (labelling, basins, old->label, labels);
  for (size_t i = 0; i < old->patches.n; i++)
    {
      const CeldPatch *patch = &old->patches.item[i];

      read_basins (basins, label, patch->y, patch->x, patch->end, &CELD_AT (labels, patch->x, patch->y));
    }
}

CeldStatus
celd_labelling_add (CeldLabelling *labelling, const CeldPatches *patches, CeldLabels *labels)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < patches->n && status == CELD_OK; i++)
    {
      const CeldPatch *patch = &patches->item[i];

      status = celd_patch_add (&labelling->patches, *patch);
      if (status == CELD_OK)
        fill (&CELD_AT (labels, patch->x, patch->y), patch->end - patch->x, patch->label);
    }
  return status;
}

/* ------------------------------------------------------------------ tidying */

static int
compare_patches (const void *a, const void *b)
{
  const CeldPatch *p = a, *q = b;

  if (p->y != q->y)
    return p->y < q->y ? -1 : 1;
  return p->x < q->x ? -1 : p->x > q->x;
}

/* Adds patches for pixels x .. end - 1 of row y that differ from their basins' labels. */
static CeldStatus
patch_row (const CeldLabelling *labelling, const CeldBasins *basins, const CeldLabels *labels, int y, int x, int end,
           uint32_t *row, CeldPatches *patches)
{
  CeldStatus status = CELD_OK;

  read_basins (basins, labelling->label, y, x, end, row);
  for (int i = x; i < end && status == CELD_OK; i++)
    {
      uint32_t label = CELD_AT (labels, i, y);

      if (label != row[i - x])
        status = celd_patch_add (patches, (CeldPatch) { y, i, i + 1, label });
    }
  return status;
}

/* Replaces patches painted in any order by patches in reading order without overlaps. */
static CeldStatus
tidy_patches (CeldLabelling *labelling, const CeldBasins *basins, const CeldLabels *labels, uint32_t *row)
{
  CeldPatch  *item = labelling->patches.item;
  size_t      n = labelling->patches.n;
  CeldPatches tidy = { 0 };
  CeldStatus  status = CELD_OK;

  if (n)
    qsort (item, n, sizeof *item, compare_patches);
  for (size_t i = 0, j; i < n && status == CELD_OK; i = j)
    {
      int end = item[i].end;

      for (j = i + 1; j < n && item[j].y == item[i].y && item[j].x <= end; j++)
        end = item[j].end > end ? item[j].end : end;
      status = patch_row (labelling, basins, labels, item[i].y, item[i].x, end, row, &tidy);
    }
  if (status != CELD_OK)
    {
      celd_patches_clear (&tidy);
      return status;
    }
  celd_patches_clear (&labelling->patches);
  labelling->patches = tidy;
  return CELD_OK;
}

/* Adds to `changed` the pixels under old patches that have another label now. */
static void
compare_old (CeldLabelling *labelling, const CeldPatches *old, const CeldLabels *labels)
{
  for (size_t i = 0; i < old->n; i++)
    {
      int x = old->item[i].x, end = old->item[i].end, y = old->item[i].y;

      while (x < end && CELD_AT (labels, x, y) == old->item[i].label)
        x++;
      while (end > x && CELD_AT (labels, end - 1, y) == old->item[i].label)
        end--;
      if (x < end)
        add_changed (labelling, y, x, end);
    }
}

/* Adds to `changed` the pixels of patches that had another label before, by basins or old patches. */
static void
compare_new (CeldLabelling *labelling, const CeldBasins *basins, const CeldLabelling *old, uint32_t *row)
{
  const CeldPatches *before = &old->patches;
  size_t             j = 0;

  for (size_t i = 0; i < labelling->patches.n; i++)
    {
      const CeldPatch *new = &labelling->patches.item[i];
      int              n = new->end - new->x, from = 0;

      read_basins (basins, old->label, new->y, new->x, new->end, row);
      while (j < before->n && (before->item[j].y < new->y ||
                               (before->item[j].y == new->y && before->item[j].end <= new->x)))
        j++;
      for (size_t k = j; k < before->n && before->item[k].y == new->y && before->item[k].x < new->end; k++)
        for (int x = before->item[k].x > new->x ? before->item[k].x : new->x;
             x < before->item[k].end && x < new->end; x++)
          row[x - new->x] = before->item[k].label;
      while (from < n && row[from] == new->label)
        from++;
      while (n > from && row[n - 1] == new->label)
        n--;
      if (from < n)
        add_changed (labelling, new->y, new->x + from, new->x + n);
    }
}

CeldStatus
celd_labelling_end (CeldLabelling *labelling, const CeldBasins *basins, const CeldLabelling *old,
                    const CeldLabels *labels)
{
  uint32_t  *row = celd_alloc ((size_t) basins->width, sizeof *row);
  CeldStatus status = row ? tidy_patches (labelling, basins, labels, row) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      compare_old (labelling, &old->patches, labels);
      compare_new (labelling, basins, old, row);
    }
  celd_free (row);
  return status;
}

CeldStatus
celd_labelling_replace (CeldLabelling *labelling, const CeldBasins *basins, const CeldLabels *from, CeldLabels *labels)
{
  CeldStatus status = celd_labelling_reset (labelling, basins);

  for (int y = 0; y < labels->height && status == CELD_OK; y++)
    {
      uint32_t *old = &CELD_AT (labels, 0, y), *new = &CELD_AT (from, 0, y);
      int       left = 0, right = labels->width;

      while (left < right && old[left] == new[left])
        left++;
      while (right > left && old[right - 1] == new[right - 1])
        right--;
      if (left == right)
        continue;
      add_changed (labelling, y, left, right);
      memcpy (old + left, new + left, (size_t) (right - left) * sizeof *old);
    }
  return status;
}

/* ------------------------------------------------------------------ measures of the labels */

/* How good a label's place is so far. */
typedef struct { int32_t squared; int length; } LabelPlace;

/* The maximum of a basin is its pixel farthest from ink. */
static void
place_basins (const CeldBasins *basins, const CeldLabels *labels, LabelPlace *place, CeldPalette *palette)
{
  for (size_t k = 0; k < basins->n; k++)
    {
      const CeldBasin *basin = &basins->basin[k];
      uint32_t         l = CELD_AT (labels, basin->x, basin->y) - 1;
      int32_t          squared = basin->solid ? 0 : basin->squared;

      if (palette->item[l].x >= 0 && squared <= place[l].squared)
        continue;
      place[l].squared   = squared;
      palette->item[l].x = basin->x;
      palette->item[l].y = basin->y;
    }
}

/* For labels without a maximum: the middle of their longest patch. */
static void
place_patches (const CeldPatches *patches, LabelPlace *place, CeldPalette *palette)
{
  for (size_t i = 0; i < patches->n; i++)
    {
      const CeldPatch *patch = &patches->item[i];
      uint32_t         l = patch->label - 1;
      int              length = patch->end - patch->x;

      if ((palette->item[l].x >= 0 && !place[l].length) || length <= place[l].length)
        continue;
      place[l].length    = length;
      palette->item[l].x = patch->x + length / 2;
      palette->item[l].y = patch->y;
    }
}

/* For labels whose maxima are all under patches: their first pixel. */
static void
place_rest (const CeldLabelling *labelling, const CeldBasins *basins, const CeldLabels *labels, CeldPalette *palette)
{
  size_t missing = 0;

  for (size_t k = 0; k < palette->n; k++)
    missing += palette->item[k].area && palette->item[k].x < 0;
  for (int y = 0; y < basins->height && missing; y++)
    for (size_t i = basins->row[y]; i < basins->row[y + 1] && missing; i++)
      {
        uint32_t    label = labelling->label[basins->run[i].basin];
        CeldRegion *region = &palette->item[label - 1];
        int         x = basins->run[i].x, end = celd_basin_run_end (basins, i, y);

        while (region->x < 0 && x < end && CELD_AT (labels, x, y) != label)
          x++;
        if (region->x >= 0 || x == end)
          continue;
        region->x = x;
        region->y = y;
        missing--;
      }
}

CeldStatus
celd_labelling_measure (const CeldLabelling *labelling, const CeldBasins *basins, const CeldLabels *labels,
                        CeldPalette *palette)
{
  uint32_t   *row = celd_alloc ((size_t) basins->width, sizeof *row);
  LabelPlace *place = celd_alloc0 (palette->n, sizeof *place);
  CeldStatus  status = row && place ? CELD_OK : CELD_NO_MEMORY;

  if (status != CELD_OK)
    goto done;
  for (size_t k = 0; k < palette->n; k++)
    {
      palette->item[k].area = 0;
      palette->item[k].x = palette->item[k].y = -1;
    }
  for (size_t k = 0; k < basins->n; k++)
    palette->item[labelling->label[k] - 1].area += basins->basin[k].area;
  for (size_t i = 0; i < labelling->patches.n; i++)
    {
      const CeldPatch *patch = &labelling->patches.item[i];

      read_basins (basins, labelling->label, patch->y, patch->x, patch->end, row);
      for (int k = 0; k < patch->end - patch->x; k++)
        palette->item[row[k] - 1].area--;
      palette->item[patch->label - 1].area += (size_t) (patch->end - patch->x);
    }
  place_basins (basins, labels, place, palette);
  place_patches (&labelling->patches, place, palette);
  place_rest (labelling, basins, labels, palette);

done:
  celd_free (row);
  celd_free (place);
  return status;
}
