/* No colour of the scribbles layer is lost in silence: each has a region, or a message names it and its place.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "random-session.h"

typedef struct { size_t painted; bool has_region, is_reported; } Colour;

static const uint8_t bright[7][3] = { { 255, 0, 0 },   { 0, 255, 0 },   { 0, 0, 255 }, { 255, 255, 0 },
                                      { 255, 0, 255 }, { 0, 255, 255 }, { 0, 0, 0 } };

/* A random page: lines that close rooms or nearly, and strokes that may touch, cover and cross each other and lines. */
static void
draw_page (State *s, uint32_t *r)
{
  memset (s, 0, sizeof *s);
  s->settings = celd_settings ();
  for (int i = 0; i < W * H; i++)
    s->luma[i] = 1;
  for (uint32_t k = 1 + pick (r, 3); k > 0; k--)
    draw_frame (s->luma, random_box (r, 5, 30), (int) pick (r, 3) * 3);
  for (uint32_t k = 1 + pick (r, 7); k > 0; k--)
    {
      CeldRect box = random_box (r, 1, pick (r, 3) ? 6 : 16);

      if (pick (r, 2))
        box.height = 1 + (int) pick (r, 3);
      paint_box (s->scribbles, box, bright[pick (r, 7)]);
    }
}

static size_t
index_of (const uint8_t colour[4])
{
  size_t k = 0;

  while (k < 7 && memcmp (colour, bright[k], 3))
    k++;
  return k;
}

static void
read_results (CeldSession *session, Colour colour[8])
{
  const CeldPalette  *palette = celd_session_palette (session);
  const CeldProblems *problems = celd_session_problems (session);

  for (size_t k = 0; k < palette->n; k++)
    if (palette->item[k].area)
      colour[index_of (palette->item[k].colour)].has_region = true;
  for (size_t i = 0; i < problems->n; i++)
    if (problems->item[i].label && problems->item[i].label <= palette->n)
      colour[index_of (palette->item[problems->item[i].label - 1].colour)].is_reported = true;
}

static void
every_colour_has_a_region_or_is_reported (void)
{
  int lost = 0, kept = 0, silent = 0;

  for (uint32_t seed = 1; seed <= 600; seed++)
    {
      static State state;
      CeldSession *session = celd_session_new ();
      CeldDrawing  drawing = { .luma = { W, H, W, state.luma } };
      CeldPaint    paint = { W, H, W, state.scribbles };
      CeldLabels   labels;
      Colour       colour[8] = { 0 };
      uint32_t     r = 77 * seed;
      CeldStatus   status;

      draw_page (&state, &r);
      for (int i = 0; i < W * H; i++)
        if (state.scribbles[4 * i + 3])
          colour[index_of (state.scribbles + 4 * i)].painted++;
      CHECK (celd_session_set_drawing (session, &drawing) == CELD_OK);
      CHECK (celd_session_set_scribbles (session, &paint) == CELD_OK);
      status = celd_session_labels (session, NULL, &labels, NULL);
      if (status == CELD_OK)
        read_results (session, colour);
      for (int k = 0; k < 7; k++)
        if (colour[k].painted)
          {
            kept += colour[k].has_region;
            lost += !colour[k].has_region;
            if (!colour[k].has_region && !colour[k].is_reported)
              silent++;
          }
      celd_session_free (session);
    }
  CHECK (silent == 0);
  CHECK (kept > 500 && lost > 5);
}

int
main (void)
{
  RUN (every_colour_has_a_region_or_is_reported);
  return DONE;
}
