/* The lines of a sprite: pixel art in a few exact colours, without antialiasing.
 *
 * Every pixel has the colour that the artist gave it, so that lines are found by colours, however narrow the fills
 * between them are: nearly all that a line's colour touches is lighter, and about half of its pixels at most have
 * neighbours of this colour alone.  Areas in the colour of lines remain fills.
 *
 * Cost: O(pixels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/coloured-steps.h"

#include <string.h>

#define SPRITE_SIDE    256  /* pixels, the longer side of the largest sprite; chosen */
#define SPRITE_COLOURS 32   /* chosen */
#define LIGHTER        16   /* of 255: luma of a lighter colour above that of a darker one, at least; chosen */
#define COLOURFUL      32   /* of 255: between the largest and the least channel of a fill with a hue; chosen */
#define AREA_RADIUS    2    /* pixels, of the smallest square that is an area, not a line; chosen */

/* An exact colour. */
typedef struct
{
  uint8_t  channel[3];
  int      luma;
  uint32_t pixels;
  uint32_t inner;            /* pixels all of whose four neighbours have the colour */
  uint32_t ramps;            /* pixels with a darker neighbour on one side and a lighter one on the other */
  uint32_t edges, lighter;   /* pairs of neighbours, one of which has another colour; a lighter one */
} SpriteColour;

typedef struct { SpriteColour colour[SPRITE_COLOURS]; int n; } SpriteColours;

/* ------------------------------------------------------------------ colours */

/* The index of a colour, which is added if it is new; -1 if there are too many. */
static int
index_of (SpriteColours *s, const uint8_t channel[3])
{
  for (int i = 0; i < s->n; i++)
    if (!memcmp (s->colour[i].channel, channel, 3))
      return i;
  if (s->n == SPRITE_COLOURS)
    return -1;
  s->colour[s->n] = (SpriteColour) { { channel[0], channel[1], channel[2] },
                                     .luma = (77 * channel[0] + 150 * channel[1] + 29 * channel[2] + 128) >> 8 };
  return s->n++;
}

/* Fills in index; false if there are too many colours. */
static bool
count_colours (const CeldMask channel[3], CeldMask *index, SpriteColours *s)
{
  for (int y = 0; y < index->height; y++)
    for (int x = 0; x < index->width; x++)
      {
        int i = index_of (s, (uint8_t[3]) { CELD_AT (&channel[0], x, y), CELD_AT (&channel[1], x, y),
                                            CELD_AT (&channel[2], x, y) });

        if (i < 0)
          return false;
        CELD_AT (index, x, y) = (uint8_t) i;
        s->colour[i].pixels++;
      }
  return true;
}

/* The colour next to a pixel, or that of the pixel itself at the border of the picture. */
static const SpriteColour *
neighbour (const CeldMask *index, const SpriteColours *s, int x, int y, int dx, int dy)
{
  bool inside = x + dx >= 0 && y + dy >= 0 && x + dx < index->width && y + dy < index->height;

  return &s->colour[inside ? CELD_AT (index, x + dx, y + dy) : CELD_AT (index, x, y)];
}

static bool
is_lighter (const SpriteColour *a, const SpriteColour *b)
{
  return a->luma >= b->luma + LIGHTER;
}

static void
count_neighbours (const CeldMask *index, SpriteColours *s)
{
  for (int y = 0; y < index->height; y++)
    for (int x = 0; x < index->width; x++)
      {
        SpriteColour *c = &s->colour[CELD_AT (index, x, y)];
        uint32_t      edges = c->edges;
        bool          ramp = false;

        for (int i = 0; i < 2; i++)
          {
            const SpriteColour *a = neighbour (index, s, x, y, i ? -1 : 0, i ? 0 : -1);
            const SpriteColour *b = neighbour (index, s, x, y, i ? 1 : 0, i ? 0 : 1);

            c->edges += (uint32_t) (a != c) + (uint32_t) (b != c);
            c->lighter += (uint32_t) is_lighter (a, c) + (uint32_t) is_lighter (b, c);
            ramp = ramp || (a->luma < c->luma && c->luma < b->luma) || (b->luma < c->luma && c->luma < a->luma);
          }
        c->inner += c->edges == edges;
        c->ramps += ramp;
      }
}

/* ------------------------------------------------------------------ what kind of drawing it is, and which lines */

/* Are a quarter of the pixels at edges of colours that lie between those on both sides? */
static bool
is_antialiased (const SpriteColours *s)
{
  size_t between = 0, edge = 0;

  for (int i = 0; i < s->n; i++)
    {
      edge += s->colour[i].pixels - s->colour[i].inner;
      between += 2 * s->colour[i].ramps > s->colour[i].pixels ? s->colour[i].pixels : 0;
    }
  return 4 * between > edge;
}

static bool
is_line (const SpriteColour *c)
{
  size_t edges = c->edges, lighter = c->lighter, inner = c->inner, pixels = c->pixels;

  return edges && 4 * lighter >= 3 * edges && 20 * inner < 11 * pixels; /* half of a line of four pixels is inner */
}

/* Has a fiftieth of the picture hues, and is not paper, the commonest colour? */
static bool
has_hues (const SpriteColours *s, size_t all)
{
  size_t hued = 0, paper = 0, paper_hued = 0;

  for (int i = 0; i < s->n; i++)
    {
      const uint8_t *c = s->colour[i].channel;
      int            most = c[0] > c[1] ? c[0] : c[1], least = c[0] < c[1] ? c[0] : c[1];
      size_t         here;

      most = c[2] > most ? c[2] : most;
      least = c[2] < least ? c[2] : least;
      here = most - least >= COLOURFUL && !is_line (&s->colour[i]) ? s->colour[i].pixels : 0;
      hued += here;
      if (s->colour[i].pixels > paper)
        {
          paper = s->colour[i].pixels;
          paper_hued = here;
        }
    }
  return 50 * (hued - paper_hued) > all;
}

bool
celd_sprite_lines (const CeldMask channel[3], bool only_coloured, void *work, CeldMask *spare, CeldMask *lines)
{
  SpriteColours s = { .n = 0 };
  size_t        n = (size_t) lines->width * (size_t) lines->height, n_lines = 0;
  bool          line[SPRITE_COLOURS];

  if (lines->width > SPRITE_SIDE || lines->height > SPRITE_SIDE || !count_colours (channel, lines, &s) || s.n < 3)
    return false;
  count_neighbours (lines, &s);
  for (int i = 0; i < s.n; i++)
    {
      line[i] = is_line (&s.colour[i]);
      n_lines += line[i] ? s.colour[i].pixels : 0;
    }
  if (!n_lines || is_antialiased (&s) || (only_coloured && !has_hues (&s, n)))
    return false;
  for (size_t i = 0; i < n; i++)
    lines->data[i] = spare->data[i] = line[lines->data[i]];
  celd_erode_bytes (spare, AREA_RADIUS, work);
  celd_dilate_bytes (spare, AREA_RADIUS, work);
  for (size_t i = 0; i < n; i++)
    lines->data[i] = lines->data[i] && !spare->data[i] ? 255 : 0;
  return true;
}
