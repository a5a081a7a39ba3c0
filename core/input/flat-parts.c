/* Pictures of flat parts without lines, such as regions, levels and depth, where a drawing or strokes were wanted.
 *
 * Along rows and columns, a line is a short stretch between two changes of colour, and so is each of its soft edges;
 * parts are longer, but for their tips and narrow places.  Of regions, levels and depth of 28 drawings at most 0.42 of
 * all stretches are short, of drawings, grey and coloured, 0.67 at least, where lines are one pixel wide and hard.
 *
 * Levels and depth are grey, and black where the page is: no drawing on paper has that, and chalk on black has lines.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"

#include <math.h>
#include <stdlib.h>

#define SHORT_SHARE   40  /* the diagonal divided by the longest stretches that are short (measured, see above) */
#define LEAST_SHORT   6   /* pixels: the longest short stretches, at least; chosen */
#define MOST_SHORT    0.5 /* of the stretches of parts (measured, see above) */
#define MOST_SAMPLED  512 /* rows, and columns, that are looked at, spread evenly; chosen */
#define COLOUR_CHANGE 3   /* of 255: by how much colours differ at least at a change: not at slopes of depth; chosen */
#define MOST_SLOPED   0.1 /* of neighbours, in smooth depth with 8 bits; chosen */
#define PART_SHARE    500 /* the page divided by the least area of a part's colour; chosen */
#define FEW_PARTS     3   /* fewer may be a silhouette, which is a drawing; chosen */
#define PAGE_BLACK    16  /* of 255: the page of levels is darker (chosen), */
#define MOST_FRAME    0.5 /* along more than this share of the frame (chosen) */

/* What is transparent has one colour. */
static int
difference (const uint8_t *p, const uint8_t *q)
{
  int most = 0;

  if (p[3] < 128 || q[3] < 128)
    return p[3] < 128 && q[3] < 128 ? 0 : 255;
  for (int k = 0; k < 3; k++)
    most = abs (p[k] - q[k]) > most ? abs (p[k] - q[k]) : most;
  return most;
}

/* ------------------------------------------------------------------ stretches */

/* How many stretches lie between two changes, how many of them are short; and how many neighbours differ a little. */
typedef struct { size_t all, brief, sloped; } Stretches;

/* Adds those of a row or column of n pixels. */
static void
add_stretches (const uint8_t *p, size_t step, int n, int longest, Stretches *found)
{
  int last = -1;

  for (int i = 1; i < n; i++)
    {
      const uint8_t *q = p + (size_t) i * step;
      int            change = difference (q - step, q);

      found->sloped += change > 0 && change < COLOUR_CHANGE;
      if (change < COLOUR_CHANGE)
        continue;
      found->all += last >= 0;
      found->brief += last >= 0 && i - last <= longest;
      last = i;
    }
}

/* Whether a picture has hardly any lines, but enough changes to tell, and no grain. */
static bool
is_without_lines (const CeldPaint *paint)
{
  int       width = paint->width, height = paint->height;
  int       across = 1 + (width - 1) / MOST_SAMPLED, down = 1 + (height - 1) / MOST_SAMPLED;
  int       longest = (int) (hypot (width, height) / SHORT_SHARE);
  size_t    lines = 0, pixels = 0;
  Stretches found = { 0 };

  longest = longest > LEAST_SHORT ? longest : LEAST_SHORT;
  for (int y = 0; y < height; y += down, lines++, pixels += (size_t) width)
    add_stretches (CELD_RGBA (paint, 0, y), 4, width, longest, &found);
  for (int x = 0; x < width; x += across, lines++, pixels += (size_t) height)
    add_stretches (CELD_RGBA (paint, x, 0), 4 * paint->stride, height, longest, &found);
  return 2 * found.all > lines && (double) found.brief < MOST_SHORT * (double) found.all &&
         (double) found.sloped < MOST_SLOPED * (double) pixels;
}

/* ------------------------------------------------------------------ parts */

/* How many colours, of 8 steps a channel, have the area of a part; and the commonest one.  Transparent is a colour. */
typedef struct { int n; size_t most; bool clear; } Colours;

static Colours
find_colours (const CeldPaint *paint)
{
  size_t  count[513] = { 0 };
  Colours found = { 0 };

  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      {
        const uint8_t *p = CELD_RGBA (paint, x, y);
        size_t        *of = &count[p[3] < 128 ? 512 : (p[0] >> 5) << 6 | (p[1] >> 5) << 3 | p[2] >> 5];

        if (++*of > found.most)
          found = (Colours) { 0, *of, p[3] >= 128 && celd_hue_of (p) >= CELD_CLEAR_HUE };
      }
  for (int i = 0; i < 513; i++)
    found.n += PART_SHARE * count[i] >= (size_t) paint->width * (size_t) paint->height;
  return found;
}

static bool
is_black (const uint8_t *p)
{
  return p[3] == 255 && p[0] < PAGE_BLACK && p[1] < PAGE_BLACK && p[2] < PAGE_BLACK;
}

/* Whether most of the frame is black. */
static bool
has_black_page (const CeldPaint *paint)
{
  int width = paint->width, height = paint->height, black = 0;

  for (int x = 0; x < width; x++)
    black += is_black (CELD_RGBA (paint, x, 0)) + is_black (CELD_RGBA (paint, x, height - 1));
  for (int y = 0; y < height; y++)
    black += is_black (CELD_RGBA (paint, 0, y)) + is_black (CELD_RGBA (paint, width - 1, y));
  return black > MOST_FRAME * 2 * (width + height);
}

static bool
are_parts (const CeldPaint *paint)
{
  return is_without_lines (paint) && find_colours (paint).n >= FEW_PARTS;
}

/* The frame tells most other pictures at once. */
bool
celd_looks_like_levels (const CeldPaint *paint)
{
  return has_black_page (paint) && celd_is_grey (paint) && are_parts (paint);
}

CeldFlatParts
celd_flat_parts (const CeldPaint *paint)
{
  return celd_looks_like_levels (paint) ? CELD_PARTS_LEVELS : are_parts (paint) ? CELD_PARTS_COLOURED : CELD_PARTS_NONE;
}

bool
celd_is_painted_over (const CeldPaint *paint)
{
  CeldFlatParts parts = celd_flat_parts (paint);
  Colours       found;

  if (parts != CELD_PARTS_COLOURED || !celd_paint_is_opaque (paint))
    return parts == CELD_PARTS_LEVELS;
  found = find_colours (paint);
  return found.clear || 2 * found.most < (size_t) paint->width * (size_t) paint->height;
}
