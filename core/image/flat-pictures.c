/* Pictures that were given as labels, levels or depth, and are photographs or drawings.
 *
 * Labels and levels are flat: a label has many pixels, and most neighbours have one level, or nearly so.  Depth that
 * was made smooth, or painted with a soft brush, changes from pixel to pixel, but its slope changes at edges alone, and
 * a photograph has grain and texture.  Of 22 photographs in four sizes 21 change their slope in 0.25 of all pixels at
 * least; levels of 28 drawings, hard, soft, dithered, and as JPEG, that change in as many pixels, in 0.17 at most, from
 * 256 pixels a side on.  On smaller pages edges take a larger share.
 *
 * A drawing, also a shaded or coloured one, is told by its lines, which are dark between lighter sides.  In levels a
 * line belongs to one of its sides: of the pixels of lines at most 0.27 are lower than both sides in levels of these
 * drawings, and in drawings that were given as levels at least 0.74.
 *
 * Where the drawing is not known, lines tell one, too: without what is narrow, dark or light, hardly anything of a
 * drawing changes from pixel to pixel.  In levels of 257 drawings 0.19 of all variation is left at least, where parts
 * are as narrow as lines; of 257 drawings 227 leave 0.1 at most, and half of them 0.002.
 *
 * Where levels and drawing were exchanged, the levels have more lines than the drawing, dark or light: of a drawing, grey
 * or coloured, they take 1.7 times as much as of its levels at least, where narrow parts look like lines.  And levels are
 * the flatter picture: each step is one edge, each line two.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <math.h>
#include <stdlib.h>

#define FEW_LABELS   1000 /* fewer may have any size; chosen */
#define LABEL_AREA   20   /* pixels of a label, more on average; chosen */
#define MANY_LABELS  64   /* of as many most neighbours are of one, ... (chosen) */
#define LEAST_EQUAL  0.45 /* this share of pixels and those right of and below them (measured: 0.43 in photographs) */
#define SMALL_PAGE   32   /* pixels; smaller pages may have a label for each few pixels; chosen */
#define STEPS        300  /* of the range of levels; neighbours that differ by more than one are a change; chosen */
#define MANY_CHANGES 0.3  /* of pixels, in photographs at least (measured: 0.31) */
#define BENDS        80   /* of the range of levels; a slope that changes by more than one is a bend, which dithering to
                           * 8 bits is not; chosen */
#define BEND_REACH   400  /* the diagonal divided by the distance over which slopes are taken; chosen */
#define MANY_BENDS   0.24 /* of pixels, in photographs at least (measured, see above) ... */
#define LARGE_SIDE   256  /* ... of so many pixels along the longer side; on smaller pages more in proportion; chosen */
#define ANY_BENDS    0.9  /* more are too many on any page; chosen */
#define LINE_SHARE   60   /* the diagonal divided by half the width of the broadest lines; chosen */
#define LEAST_HALF   3    /* pixels: half that width, at least; chosen */
#define LINE         64   /* of 255: by how much a line is darker than its sides (chosen), ... */
#define LOWER        26   /* ... and lower in levels of which it is a part; chosen */
#define FEW_LINES    1000 /* the page divided by the least area of lines that tell anything; chosen */
#define MANY_LINES   100  /* the page divided by the least area of lines of a drawing that was given as levels; chosen */
#define LITTLE_LEFT  0.1  /* of the variation of a drawing without its lines, at most (measured, see above) */
#define MORE_LINES   1.3  /* times as much as in its levels, at least (measured, see above) */
#define MOST_LOWER   0.5  /* of the pixels of lines are lower than both sides, in levels (measured, see above) */

/* ------------------------------------------------------------------ photographs */

/* The share of pixels that have the label of those to the right and below. */
static double
flat_share (const CeldLabels *labels)
{
  size_t flat = 0;

  for (int y = 0; y + 1 < labels->height; y++)
    for (int x = 0; x + 1 < labels->width; x++)
      {
        uint32_t label = CELD_AT (labels, x, y);

        flat += label == CELD_AT (labels, x + 1, y) && label == CELD_AT (labels, x, y + 1);
      }
  return (double) flat / fmax (1, (labels->width - 1.0) * (labels->height - 1.0));
}

bool
celd_are_labels (const CeldLabels *labels, const CeldPalette *palette)
{
  bool small = labels->width < SMALL_PAGE || labels->height < SMALL_PAGE;

  if (palette->n >= MANY_LABELS && !small && flat_share (labels) < LEAST_EQUAL)
    return false;
  return palette->n < FEW_LABELS || LABEL_AREA * palette->n < (size_t) labels->width * (size_t) labels->height;
}

/* From each pixel to the next one in reading order, how many are larger than this. */
static size_t
count_changes (const CeldPlane *levels, float largest)
{
  size_t changes = 0;
  float  before = CELD_AT (levels, 0, 0);

  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        changes += fabsf (CELD_AT (levels, x, y) - before) > largest;
        before = CELD_AT (levels, x, y);
      }
  return changes;
}

static float
range_of (const CeldPlane *plane)
{
  float least, most;

  celd_level_range (plane, &least, &most);
  return most - least;
}

/* Of how many pixels in a row the slope to the left differs from that to the right. */
static double
bend_share (const CeldPlane *levels, float largest)
{
  int    reach = (int) (hypot (levels->width, levels->height) / BEND_REACH);
  size_t bends = 0;

  reach = reach > 1 ? reach : 1;
  for (int y = 0; y < levels->height; y++)
    for (int x = reach; x + reach < levels->width; x++)
      bends += fabsf (CELD_AT (levels, x - reach, y) - 2 * CELD_AT (levels, x, y) + CELD_AT (levels, x + reach, y)) >
               largest;
  return (double) bends / fmax (1, (double) levels->height * (levels->width - 2.0 * reach));
}

bool
celd_are_levels (const CeldPlane *levels)
{
  double n = (double) levels->width * levels->height, longer = fmax (levels->width, levels->height);
  double most = fmin (ANY_BENDS, MANY_BENDS * fmax (1, LARGE_SIDE / longer));
  float  range = range_of (levels);

  return (double) count_changes (levels, range / STEPS) < MANY_CHANGES * n || bend_share (levels, range / BENDS) < most;
}

/* ------------------------------------------------------------------ drawings */

static uint8_t
byte_of (float value)
{
  return (uint8_t) lrintf (255 * fmaxf (0, fminf (1, value)));
}

/* Finds by how much values are lower than those on both sides, in 255ths of a range from `least` on. */
static CeldStatus
find_valleys (const CeldPlane *plane, float least, float range, CeldMask *valleys)
{
  int        radius = (int) (hypot (plane->width, plane->height) / LINE_SHARE);
  size_t     n = valleys->stride * (size_t) valleys->height;
  void      *work;
  uint8_t   *values = celd_alloc (n, 1);
  CeldMask   bytes = *valleys;
  CeldStatus status = CELD_NO_MEMORY;

  radius     = radius > LEAST_HALF ? radius : LEAST_HALF;
  work       = celd_alloc (celd_erosion_work (plane->width, radius), 1);
  bytes.data = values;
  if (work && values)
    {
      for (int y = 0; y < plane->height; y++)
        for (int x = 0; x < plane->width; x++)
          CELD_AT (&bytes, x, y) = byte_of ((CELD_AT (plane, x, y) - least) / range);
      celd_close_bytes (&bytes, radius, work, valleys);
      for (size_t i = 0; i < n; i++)
        valleys->data[i] = (uint8_t) (valleys->data[i] - values[i]);
      status = CELD_OK;
    }
  celd_free (work);
  celd_free (values);
  return status;
}

CeldStatus
celd_find_lines (const CeldPlane *plane, float least, float range, const CeldPlane *drawing, bool *have)
{
  size_t     n = (size_t) plane->width * (size_t) plane->height, lines = 0, lower = 0;
  CeldMask   drawn = { plane->width, plane->height, (size_t) plane->width, NULL }, valleys = drawn;
  CeldStatus status = CELD_NO_MEMORY;

  if (!CELD_SAME_SIZE (plane, drawing))
    return CELD_BAD_SIZE;
  drawn.data   = celd_alloc (n, 1);
  valleys.data = celd_alloc (n, 1);
  if (drawn.data && valleys.data)
    status = find_valleys (drawing, 0, 1, &drawn);
  if (status == CELD_OK)
    status = find_valleys (plane, least, range, &valleys);
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    if (drawn.data[i] > LINE)
      {
        lines++;
        lower += valleys.data[i] > LOWER;
      }
  if (status == CELD_OK)
    *have = FEW_LINES * lines >= n && (double) lower > MOST_LOWER * (double) lines;
  celd_free (drawn.data);
  celd_free (valleys.data);
  return status;
}

CeldStatus
celd_levels_have_lines (const CeldPlane *levels, const CeldPlane *drawing, bool *have)
{
  float least, most;

  if (!CELD_SAME_SIZE (levels, drawing))
    return CELD_BAD_SIZE;
  celd_level_range (levels, &least, &most);
  if (most > least)
    return celd_find_lines (levels, least, most - least, drawing, have);
  *have = false;
  return CELD_OK;
}

/* The sum of the differences of neighbours. */
static double
variation (const CeldMask *picture)
{
  double sum = 0;

  for (int y = 0; y < picture->height; y++)
    for (int x = 0; x < picture->width; x++)
      {
        int value = CELD_AT (picture, x, y);

        sum += x ? abs (value - CELD_AT (picture, x - 1, y)) : 0;
        sum += y ? abs (value - CELD_AT (picture, x, y - 1)) : 0;
      }
  return sum;
}

/* The share of the variation that is left without lines, dark or light, whichever is less.  Neither range nor sign of
 * the values matter. */
static CeldStatus
share_left (const CeldPlane *plane, float least, float most, CeldMask *valleys, CeldMask *picture, double *share)
{
  CeldStatus status = CELD_OK;

  *share = 1;
  for (int light = 0; light < 2 && status == CELD_OK; light++)
    {
      float  from = light ? most : least, range = light ? least - most : most - least;
      double all;

      status = find_valleys (plane, from, range, valleys);
      if (status != CELD_OK)
        break;
      for (int y = 0; y < plane->height; y++)
        for (int x = 0; x < plane->width; x++)
          CELD_AT (picture, x, y) = byte_of ((CELD_AT (plane, x, y) - from) / range);
      all = variation (picture);
      for (size_t i = 0; i < picture->stride * (size_t) picture->height; i++)
        picture->data[i] = (uint8_t) (picture->data[i] + valleys->data[i]);
      *share = fmin (*share, variation (picture) / fmax (1, all));
    }
  return status;
}

/* ------------------------------------------------------------------ levels and drawing exchanged */

/* The share of pixels in lines, dark or light, whichever are more. */
static CeldStatus
line_share (const CeldPlane *plane, CeldMask *valleys, double *share)
{
  float      least, most;
  double     n = (double) plane->width * plane->height;
  CeldStatus status = CELD_OK;

  *share = 0;
  celd_level_range (plane, &least, &most);
  for (int light = 0; light < 2 && most > least && status == CELD_OK; light++)
    {
      size_t lines = 0;

      status = find_valleys (plane, light ? most : least, light ? least - most : most - least, valleys);
      for (size_t i = 0; i < valleys->stride * (size_t) valleys->height && status == CELD_OK; i++)
        lines += valleys->data[i] > LINE;
      *share = fmax (*share, (double) lines / n);
    }
  return status;
}

/* How many pixels differ from those to the right or below. */
static size_t
count_edges (const CeldPlane *plane)
{
  size_t edges = 0;

  for (int y = 0; y + 1 < plane->height; y++)
    for (int x = 0; x + 1 < plane->width; x++)
      {
        float value = CELD_AT (plane, x, y);

        edges += fabsf (CELD_AT (plane, x + 1, y) - value) > 0 || fabsf (CELD_AT (plane, x, y + 1) - value) > 0;
      }
  return edges;
}

CeldStatus
celd_levels_are_drawing (const CeldPlane *levels, bool *are)
{
  CeldMask   valleys = { levels->width, levels->height, (size_t) levels->width, NULL }, picture = valleys;
  size_t     n = valleys.stride * (size_t) valleys.height;
  double     lines = 0, left = 1;
  float      least, most;
  CeldStatus status = CELD_NO_MEMORY;

  celd_level_range (levels, &least, &most);
  valleys.data = celd_alloc (n, 1);
  picture.data = celd_alloc (n, 1);
  if (valleys.data && picture.data)
    status = line_share (levels, &valleys, &lines);
  if (status == CELD_OK && most > least)
    status = share_left (levels, least, most, &valleys, &picture, &left);
  if (status == CELD_OK)
    *are = MANY_LINES * lines >= 1 && left < LITTLE_LEFT;
  celd_free (valleys.data);
  celd_free (picture.data);
  return status;
}

CeldStatus
celd_levels_are_exchanged (const CeldPlane *levels, const CeldPlane *drawing, bool *exchanged)
{
  CeldMask   valleys = { levels->width, levels->height, (size_t) levels->width, NULL };
  double     of_levels = 0, of_drawing = 0;
  CeldStatus status = CELD_NO_MEMORY;

  if (!CELD_SAME_SIZE (levels, drawing))
    return CELD_BAD_SIZE;
  valleys.data = celd_alloc (valleys.stride * (size_t) valleys.height, 1);
  if (valleys.data)
    status = line_share (levels, &valleys, &of_levels);
  if (status == CELD_OK)
    status = line_share (drawing, &valleys, &of_drawing);
  if (status == CELD_OK)
    *exchanged = MANY_LINES * of_levels >= 1 && of_levels > MORE_LINES * of_drawing &&
                 count_edges (levels) > count_edges (drawing);
  celd_free (valleys.data);
  return status;
}
