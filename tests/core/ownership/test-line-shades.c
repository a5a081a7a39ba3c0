/* Lines that are darker shades of the parts that they outline show whose they are; lines of other colours do not.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "blobs.h"
#include "celdepth.h"
#include "ownership/ownership.h"

enum { SIDE = 260 };

static void
brown (uint32_t label, double colour[3])
{
  (void) label;
  colour[0] = 70; /* of the red part's hue */
  colour[1] = 28;
  colour[2] = 26;
}

static void
black (uint32_t label, double colour[3])
{
  (void) label;
  colour[0] = colour[1] = colour[2] = 4;
}

static void
grey (uint32_t label, double colour[3])
{
  colour[0] = colour[1] = colour[2] = 250 - 25 * (double) label;
}

static void
dark_grey (uint32_t label, double colour[3])
{
  colour[0] = colour[1] = colour[2] = 90 - 10 * (double) label;
}

static void
red (uint32_t label, double colour[3])
{
  blobs_fill (2, colour);
  for (int c = 0; c < 3; c++)
    colour[c] *= 1 - 0.08 * (double) label;
}

static void
dark_red (uint32_t label, double colour[3])
{
  red (label, colour);
  for (int c = 0; c < 3; c++)
    colour[c] *= 0.4;
}

/* The share of ink that gets its owner with levels that are those of the page, or the other way round. */
static double
score (const Blobs *b, const CeldPaint *colours, bool reversed)
{
  CeldOwnership own;
  uint32_t      level[BLOB_MOST + 1];
  double        share;

  for (size_t k = 0; k < b->n; k++)
    level[k] = reversed ? (uint32_t) (b->n - k) : b->level[k];
  CHECK (celd_ownership_new (b->ink.width, b->ink.height, &own) == CELD_OK);
  CHECK (celd_own (&b->ink, colours, &b->labels, level, b->n, NULL, CELD_EXPANSION_OUTLINES, NULL, &own) == CELD_OK);
  share = blobs_score (b, &own);
  celd_ownership_clear (&own);
  return share;
}

static void
some_blobs (uint32_t seed, double pen, Blobs *b)
{
  blobs_new (SIDE, SIDE, b);
  for (int k = 0; k < 5; k++)
    blobs_add (b, &seed, pen, 0);
}

/* Parts drawn over each other, whose levels say the opposite: by them alone most outlines go to the wrong part. */
static void
shades_show_the_owner (void)
{
  for (uint32_t seed = 1; seed <= 5; seed++)
    {
      Blobs     b;
      CeldPaint art;

      some_blobs (seed, 6, &b);
      art = blobs_paint (&b, blobs_fill, blobs_shade);
      CHECK (score (&b, NULL, true) < 0.5);
      CHECK (score (&b, &art, true) > 0.9);
      CHECK (score (&b, &art, false) >= score (&b, NULL, false) - 0.001);
      celd_free (art.data);
      blobs_free (&b);
    }
}

/* Whether colours change anything. */
static bool
matter (void (*fill_of) (uint32_t label, double colour[3]), void (*line_of) (uint32_t label, double colour[3]),
        double pen)
{
  bool differ = false;

  for (uint32_t seed = 1; seed <= 3; seed++)
    {
      Blobs     b;
      CeldPaint art;

      some_blobs (seed, pen, &b);
      art = blobs_paint (&b, fill_of, line_of);
      differ |= score (&b, &art, false) != score (&b, NULL, false) || score (&b, &art, true) != score (&b, NULL, true);
      celd_free (art.data);
      blobs_free (&b);
    }
  return differ;
}

static void
other_colours_tell_nothing (void)
{
  CHECK (matter (blobs_fill, blobs_shade, 6));
  CHECK (!matter (blobs_fill, brown, 6));
  CHECK (!matter (blobs_fill, black, 6));
  CHECK (!matter (grey, dark_grey, 6));
  CHECK (!matter (red, dark_red, 6));
  CHECK (!matter (blobs_fill, blobs_shade, 1)); /* antialiased throughout */
}

static void
box (Blobs *b, double left, double top, double right, double bottom, double pen)
{
  Blob blob;

  for (int i = 0; i < BLOB_CORNERS; i++)
    {
      double along = 4.0 * i / BLOB_CORNERS, part = along - floor (along);
      int    side = (int) along;

      blob.x[i] = side == 0 ? left + part * (right - left) : side == 1 ? right : side == 2 ? right - part * (right - left)
                                                                              : left;
      blob.y[i] = side == 0 ? top : side == 1 ? top + part * (bottom - top) : side == 2 ? bottom
                                                                            : bottom - part * (bottom - top);
      blob.width[i] = pen;
    }
  blobs_draw (b, &blob);
}

/* The outline of a frame lies between that of a pane in it and the page's other part, without paper of its own beside it
 * on the right. */
static void
a_line_between_others_goes_on (void)
{
  Blobs     b;
  CeldPaint art;

  blobs_new (SIDE, SIDE, &b);
  box (&b, 30, 30, 230, 230, 4);
  box (&b, 60, 60, 190, 200, 12);
  box (&b, 110, 70, 186, 190, 8);
  art = blobs_paint (&b, blobs_fill, blobs_shade);
  CHECK (score (&b, &art, true) > 0.97);
  celd_free (art.data);
  blobs_free (&b);
}

/* ------------------------------------------------------------------ in a session */

/* A session of a page with flat scribbles in each part, and relations that say the opposite of what was drawn. */
static CeldSession *
open_session (const Blobs *b)
{
  CeldDrawing  drawing = { .luma = b->ink };
  CeldPaint    flats = blobs_paint (b, blobs_fill, blobs_fill);
  CeldSession *s = celd_session_new ();
  char         text[BLOB_MOST * 24] = "";

  for (int p = 0; p < SIDE * SIDE; p++)
    flats.data[4 * p + 3] = b->ink.data[p] >= 1 ? 255 : 0;
  for (uint32_t k = 1; k < b->n; k++)
    {
      double nearer[3], farther[3];

      blobs_fill (k, nearer);
      blobs_fill (k + 1, farther);
      snprintf (text + strlen (text), 24, "#%02x%02x%02x > #%02x%02x%02x\n", (unsigned) nearer[0], (unsigned) nearer[1],
                (unsigned) nearer[2], (unsigned) farther[0], (unsigned) farther[1], (unsigned) farther[2]);
    }
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK && celd_session_set_scribbles (s, &flats) == CELD_OK);
  CHECK (celd_session_set_relations (s, text, NULL) == CELD_OK);
  celd_free (flats.data);
  return s;
}

/* The share of ink that gets its owner. */
static double
session_score (CeldSession *s, const Blobs *b, CeldRect *changed)
{
  const CeldPalette *palette;
  CeldOwnership      own;
  size_t             ink = 0, right = 0;

  CHECK (celd_session_ownership (s, NULL, &own, changed) == CELD_OK);
  palette = celd_session_palette (s);
  for (int p = 0; p < SIDE * SIDE; p++)
    if (b->ink.data[p] < 0.5f)
      {
        const uint8_t *colour = palette->item[(own.coverage.data[p] < 0.5f ? own.under : own.owner).data[p] - 1].colour;
        double         wanted[3];

        blobs_fill (b->owner.data[p], wanted);
        ink++;
        right += colour[0] == wanted[0] && colour[1] == wanted[1] && colour[2] == wanted[2];
      }
  return (double) right / (double) ink;
}

static void
a_session_knows_colours (void)
{
  Blobs        b;
  CeldPaint    art, none, small;
  CeldSession *s;
  CeldRect     changed;

  some_blobs (2, 6, &b);
  art = blobs_paint (&b, blobs_fill, blobs_shade);
  none = blobs_paint (&b, grey, dark_grey);
  small = art;
  small.width--;
  s = open_session (&b);
  CHECK (session_score (s, &b, &changed) < 0.5);
  CHECK (celd_session_set_colours (s, &small) == CELD_BAD_SIZE);
  CHECK (celd_session_set_colours (s, &none) == CELD_OK);
  CHECK (session_score (s, &b, &changed) < 0.5 && !changed.width);
  CHECK (celd_session_set_colours (s, &art) == CELD_OK);
  CHECK (session_score (s, &b, &changed) > 0.9 && changed.width);
  CHECK (celd_session_set_colours (s, &art) == CELD_OK);
  CHECK (session_score (s, &b, &changed) > 0.9 && !changed.width);
  CHECK (celd_session_set_colours (s, NULL) == CELD_OK);
  CHECK (session_score (s, &b, &changed) < 0.5 && changed.width);
  celd_session_free (s);
  celd_free (art.data);
  celd_free (none.data);
  blobs_free (&b);
}

static void
bad_input (void)
{
  Blobs         b;
  CeldPaint     art;
  CeldOwnership own;

  some_blobs (1, 6, &b);
  art = blobs_paint (&b, blobs_fill, blobs_shade);
  art.height--;
  CHECK (celd_ownership_new (SIDE, SIDE, &own) == CELD_OK);
  CHECK (celd_own (&b.ink, &art, &b.labels, b.level, b.n, NULL, CELD_EXPANSION_OUTLINES, NULL, &own) == CELD_BAD_SIZE);
  celd_ownership_clear (&own);
  celd_free (art.data);
  blobs_free (&b);
}

int
main (void)
{
  RUN (shades_show_the_owner);
  RUN (other_colours_tell_nothing);
  RUN (a_line_between_others_goes_on);
  RUN (a_session_knows_colours);
  RUN (bad_input);
  return DONE;
}
