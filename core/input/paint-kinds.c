/* Layers that are something else than they were given for: a photograph in place of scribbles, drawing and scribbles
 * exchanged, colours in place of levels.
 *
 * Scribbles are told by their flat colours: neighbours that are equal are 0.88 of all pixels at least, in a photograph
 * less than 0.42; or if they are scanned by their blank page.  A grey picture of which most is dark, such as the sky at
 * night, is none.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"

#include <string.h>

#define TELLING_SIDE 64   /* pixels; smaller layers tell too little, but for opaque ones; chosen */
#define SMALL_SIDE   32   /* pixels; smaller pictures tell too little (measured: soft strokes are half of them) */
#define LEAST_FLAT  0.5  /* the share of equal neighbours in scribbles, at least (measured, see above) */
#define LEAST_BLANK 0.6  /* the share of the commonest colour in scribbles on scanned paper, at least; chosen */
#define SMALL_BLANK 0.5  /* the same in small pictures (measured: 0.58) */
#define LIGHT_STEP  6    /* of 8 steps of a channel: paper is as light; chosen */
#define FAINT_HUE   12   /* of 255: of what is not grey, more than JPEG makes; chosen */
#define FEW_CLEAR   20000 /* the page divided by the least area of clear colours: a short hairline of a large page; chosen */
#define WHITE       230  /* of 255: channels of paper are larger; chosen */

/* ------------------------------------------------------------------ a photograph */

/* Whether two pixels R,G,B,A look alike. */
static bool
are_equal (const uint8_t *p, const uint8_t *q)
{
  return (!p[3] && !q[3]) || !memcmp (p, q, 4);
}

/* The share of pixels that equal those to the right and below. */
static double
flat_share (const CeldPaint *paint)
{
  size_t flat = 0;

  for (int y = 0; y + 1 < paint->height; y++)
    for (int x = 0; x + 1 < paint->width; x++)
      {
        const uint8_t *p = CELD_RGBA (paint, x, y);

        flat += are_equal (p, p + 4) && are_equal (p, p + 4 * paint->stride);
      }
  return (double) flat / ((double) (paint->width - 1) * (paint->height - 1));
}

/* The share of the commonest colour, of 8 steps a channel; and whether that is transparent, or light as paper. */
static double
blank_share (const CeldPaint *paint, bool *light)
{
  size_t count[512] = { 0 }, most = 0;

  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      {
        const uint8_t *p = CELD_RGBA (paint, x, y);
        size_t        *of = &count[p[3] ? (p[0] >> 5) << 6 | (p[1] >> 5) << 3 | p[2] >> 5 : 511];

        if (++*of > most)
          {
            most   = *of;
            *light = of == &count[511] || p[1] >> 5 >= LIGHT_STEP;
          }
      }
  return (double) most / ((double) paint->width * paint->height);
}

bool
celd_paint_is_opaque (const CeldPaint *paint)
{
  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      if (CELD_RGBA (paint, x, y)[3] < 255)
        return false;
  return true;
}

bool
celd_are_scribbles (const CeldPaint *paint)
{
  int    side = paint->width < paint->height ? paint->width : paint->height;
  bool   small = side < TELLING_SIDE, light;
  double blank;

  if (side < SMALL_SIDE || flat_share (paint) >= LEAST_FLAT || (small && !celd_paint_is_opaque (paint)))
    return true;
  blank = blank_share (paint, &light);
  return blank >= (small ? SMALL_BLANK : LEAST_BLANK) && (light || !celd_is_grey (paint));
}

/* ------------------------------------------------------------------ grey or coloured */

int
celd_hue_of (const uint8_t *p)
{
  int most = p[0] > p[1] ? p[0] : p[1], least = p[0] < p[1] ? p[0] : p[1];

  most = p[2] > most ? p[2] : most;
  least = p[2] < least ? p[2] : least;
  return most - least;
}

bool
celd_is_grey (const CeldPaint *paint)
{
  bool painted = false;

  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      if (CELD_RGBA (paint, x, y)[3])
        {
          painted = true;
          if (celd_hue_of (CELD_RGBA (paint, x, y)) > FAINT_HUE)
            return false;
        }
  return painted;
}

bool
celd_paint_is_coloured (const CeldPaint *paint)
{
  size_t hued = 0;

  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      hued += CELD_RGBA (paint, x, y)[3] && celd_hue_of (CELD_RGBA (paint, x, y)) > FAINT_HUE;
  return 100 * hued > (size_t) paint->width * (size_t) paint->height;
}

bool
celd_paint_has_colours (const CeldPaint *paint)
{
  size_t clear = 0;

  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      clear += CELD_RGBA (paint, x, y)[3] >= 128 && celd_hue_of (CELD_RGBA (paint, x, y)) >= CELD_CLEAR_HUE;
  return FEW_CLEAR * clear >= (size_t) paint->width * (size_t) paint->height;
}

bool
celd_is_coloured_strokes (const CeldPaint *paint)
{
  size_t painted = 0, clear = 0, of[6] = { 0 };
  size_t all = (size_t) paint->width * (size_t) paint->height;
  int    hues = 0;

  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      {
        const uint8_t *p = CELD_RGBA (paint, x, y);

        if (p[3] < 128 || (p[0] > WHITE && p[1] > WHITE && p[2] > WHITE))
          continue;
        painted++;
        if (celd_hue_of (p) < CELD_CLEAR_HUE)
          continue;
        clear++;
        of[(p[0] >= p[1]) + (p[1] >= p[2]) + 3 * (p[0] >= p[2])]++;
      }
  for (int i = 0; i < 6; i++)
    hues += 20 * of[i] > painted;
  return painted && 2 * painted < all && 10 * clear > 9 * painted && hues > 1;
}
