/* The levels of labels that have them already, in a picture that another step made.
 *
 * Levels are expanded, so that labels and levels may disagree on ink: most of a label's pixels decide.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"

#include <stdlib.h>

typedef struct { uint32_t label; float level; } LabelledLevel;

static int
compare_floats (const void *a, const void *b)
{
  const float *p = a, *q = b;

  return (*p > *q) - (*p < *q);
}

static int
compare_pixels (const void *a, const void *b)
{
  const LabelledLevel *p = a, *q = b;

  return p->label != q->label ? (p->label < q->label ? -1 : 1) : compare_floats (&p->level, &q->level);
}

/* Lists the pixels by label and level. */
static CeldStatus
sort_pixels (const CeldLabels *labels, size_t n, const CeldPlane *levels, LabelledLevel **sorted)
{
  size_t         pixels = (size_t) labels->width * (size_t) labels->height;
  LabelledLevel *pixel = celd_alloc (pixels, sizeof *pixel), *to = pixel;

  if (!pixel)
    return CELD_NO_MEMORY;
  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++, to++)
      {
        float level = CELD_AT (levels, x, y);

        *to = (LabelledLevel) { CELD_AT (labels, x, y), level == level ? level : 0 };
        if (to->label > n)
          {
            celd_free (pixel);
            return CELD_BAD_VALUE;
          }
      }
  qsort (pixel, pixels, sizeof *pixel, compare_pixels);
  *sorted = pixel;
  return CELD_OK;
}

/* Takes the level of the longest run of each label, of a label without pixels the least of all. */
static void
choose_levels (const LabelledLevel *pixel, size_t pixels, size_t n, float *value)
{
  size_t longest = 0;
  float  least = pixel[0].level;

  for (size_t i = 1; i < pixels; i++)
    least = pixel[i].level < least ? pixel[i].level : least;
  for (size_t k = 0; k < n; k++)
    value[k] = least;
  for (size_t first = 0, end; first < pixels; first = end)
    {
      for (end = first; end < pixels && !compare_pixels (&pixel[end], &pixel[first]); end++)
        ;
      if (!first || pixel[first].label != pixel[first - 1].label)
        longest = 0;
      if (pixel[first].label && end - first > longest)
        {
          longest = end - first;
          value[pixel[first].label - 1] = pixel[first].level;
        }
    }
}

/* The number of distinct values below each one. */
static void
rank_levels (const float *value, size_t n, float *distinct, uint32_t *level)
{
  size_t left = 0;

  memcpy (distinct, value, n * sizeof *distinct);
  qsort (distinct, n, sizeof *distinct, compare_floats);
  for (size_t k = 0; k < n; k++)
    if (!left || distinct[k] > distinct[left - 1])
      distinct[left++] = distinct[k];
  for (size_t k = 0; k < n; k++)
    level[k] = (uint32_t) ((float *) bsearch (&value[k], distinct, left, sizeof *distinct, compare_floats) - distinct);
}

CeldStatus
celd_label_levels (const CeldLabels *labels, size_t n, const CeldPlane *levels, float *value, uint32_t *level)
{
  LabelledLevel *pixel = NULL;
  float         *distinct;
  CeldStatus     status;

  if (!CELD_SAME_SIZE (labels, labels) || !CELD_SAME_SIZE (labels, levels))
    return CELD_BAD_SIZE;
  status   = sort_pixels (labels, n, levels, &pixel);
  distinct = celd_alloc (n, sizeof *distinct);
  if (status == CELD_OK && !distinct)
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      choose_levels (pixel, (size_t) labels->width * (size_t) labels->height, n, value);
      rank_levels (value, n, distinct, level);
    }
  celd_free (pixel);
  celd_free (distinct);
  return status;
}
