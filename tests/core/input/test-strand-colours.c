/* Strokes told apart by colour: what crosses in two colours is two, and what is one stroke is never torn.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "draw-arrows.h"
#include "input/arrow-colours.h"
#include "input/arrows.h"
#include "input/trail.h"

#define SIZE 200

static const uint8_t ORANGE[3] = { 230, 90, 0 }, MAGENTA[3] = { 200, 0, 120 }, BLACK[3] = { 0, 0, 0 };

/* Lays an arrow over a picture, as painting programs do. */
static void
lay (CeldPaint *paint, const Arrow *a, const uint8_t colour[3])
{
  CeldPaint one = blank (paint->width, paint->height);

  draw_arrow (&one, a, colour);
  for (size_t i = 0; i < one.stride * (size_t) one.height; i++)
    {
      uint8_t *above = one.data + 4 * i, *c = paint->data + 4 * i;
      double   share = above[3] / 255., below = c[3] / 255. * (1 - share), all = share + below;

      for (int k = 0; k < 3 && all > 0; k++)
        c[k] = (uint8_t) ((share * above[k] + below * c[k]) / all + 0.5);
      c[3] = (uint8_t) (255 * all + 0.5);
    }
  free (one.data);
}

/* On white, without alpha. */
static void
flatten (CeldPaint *paint)
{
  for (size_t i = 0; i < paint->stride * (size_t) paint->height; i++)
    {
      uint8_t *c = paint->data + 4 * i;

      for (int k = 0; k < 3; k++)
        c[k] = (uint8_t) ((c[k] * c[3] + 255 * (255 - c[3]) + 127) / 255);
      c[3] = 255;
    }
}

/* Chroma averaged over cells of 2 x 2 pixels, and noise in every channel, as codecs and rough paper make it. */
static void
spoil (CeldPaint *paint, double noise, uint32_t *state)
{
  for (int y = 0; y + 1 < paint->height; y += 2)
    for (int x = 0; x + 1 < paint->width; x += 2)
      {
        uint8_t *c[4];
        double   mean[3] = { 0 }, grey[4];

        for (int i = 0; i < 4; i++)
          {
            c[i]    = paint->data + 4 * ((size_t) (y + i / 2) * paint->stride + (size_t) (x + i % 2));
            grey[i] = 0.3 * c[i][0] + 0.6 * c[i][1] + 0.1 * c[i][2];
            for (int k = 0; k < 3; k++)
              mean[k] += (c[i][k] - grey[i]) / 4;
          }
        for (int i = 0; i < 4; i++)
          for (int k = 0; k < 3; k++)
            c[i][k] = (uint8_t) fmax (0, fmin (255, grey[i] + mean[k] + random_between (state, -noise, noise)));
      }
}

/* All pixels of alpha 128 and more as one component, told apart; in a layer without alpha, what is not white. */
static CeldColourStrands
tell_apart (const CeldPaint *paint, bool opaque)
{
  CeldArrowLayer    layer = { .paint = paint, .opaque = opaque, .paper = { 255, 255, 255 } };
  CeldColourStrands found = { 0 };
  uint32_t         *pixel = malloc (sizeof *pixel * (size_t) paint->width * (size_t) paint->height);
  CeldTrail         trail = { .width = paint->width, .height = paint->height, .pixel = pixel };

  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      if (celd_arrow_opacity (&layer, x, y) >= (opaque ? CELD_PAPER_CONTRAST : 128))
        pixel[trail.n++] = (uint32_t) ((y + 1) * (paint->width + 2) + x + 1);
  CHECK (celd_strand_colours_find (&trail, &layer, &found) == CELD_OK);
  free (pixel);
  return found;
}

static size_t
count_strands (const CeldPaint *paint, bool opaque)
{
  CeldColourStrands found = tell_apart (paint, opaque);
  size_t            n = found.strands.n;

  celd_strand_colours_clear (&found);
  return n;
}

/* Two bars, 7 and 5 wide: each strand is its whole bar in its own colour, also where the other one hides it. */
static void
strands_are_whole (void)
{
  for (int degrees = 25; degrees <= 155; degrees += 10)
    {
      Arrow     a = through ((Point) { 100, 100 }, 0.2, 150, 0.5, 7, CELD_ARROW_HEAD, false);
      Arrow     b = through ((Point) { 100, 100 }, 0.2 + degrees * 0.0174532925, 130, 0.5, 5, CELD_ARROW_HEAD, false);
      CeldPaint paint = blank (SIZE, SIZE), alone = blank (SIZE, SIZE);
      size_t    n[2] = { 0 }, all = 0, same = 0, mixed = 0;
      CeldColourStrands found;

      a.head = b.head = BARE;
      lay (&paint, &a, ORANGE);
      lay (&alone, &a, ORANGE);
      lay (&paint, &b, MAGENTA);
      found = tell_apart (&paint, false);
      CHECK (found.strands.n == 2);
      for (size_t k = 0; k < found.strands.n; k++)
        for (size_t i = found.strands.first[k]; i < found.strands.first[k + 1]; i++)
          {
            const uint8_t *c = found.rgba + 4 * i;
            bool           orange = c[1] > 45;

            n[orange]++;
            mixed += hypot (c[0] - (orange ? 230 : 200), hypot (c[1] - (orange ? 90 : 0), c[2] - (orange ? 0 : 120))) >
                     20;
            CHECK (c[3] >= 128);
          }
      for (int y = 0; y < SIZE; y++) /* hidden pixels of the orange bar are in its strand */
        for (int x = 0; x < SIZE; x++)
          if (alone.data[4 * ((size_t) y * alone.stride + (size_t) x) + 3] >= 128)
            {
              uint32_t number = (uint32_t) ((y + 1) * (SIZE + 2) + x + 1);
              bool     in = false;

              for (size_t i = 0; found.strands.n && i < found.strands.first[found.strands.n]; i++)
                in |= found.strands.pixel[i] == number && found.rgba[4 * i + 1] > 45;
              all++;
              same += in;
            }
      CHECK (20 * same >= 19 * all);
      CHECK (50 * mixed <= all);
      NEAR (n[1], all, 0.06 * (double) all);
      NEAR (n[0], 130 * 5, 60);
      celd_strand_colours_clear (&found);
      free (paint.data);
      free (alone.data);
    }
}

/* In every style, at angles from 20 degrees on, with alpha, on paper, and on paper that is spoiled: most are read, and
 * none wrongly. */
static void
two_that_cross (void)
{
  uint32_t state = 5;
  int      all = 0;

  for (size_t s = 0; s < 4; s++)
    for (int paper = 0; paper < 3; paper++)
      {
        int right = 0, n = 10;

        for (int i = 0; i < n; i++)
          {
            double    angle = random_between (&state, 0, 6.28), turn = random_between (&state, 0.35, 2.8);
            double    share = random_between (&state, 0.4, 0.6), w = random_between (&state, 3.5, 7);
            Arrow     a = through ((Point) { 100, 100 }, angle, 150, share, w, STYLES[s], false);
            Arrow     b = through ((Point) { 100, 100 }, angle + turn, 150, share, w, STYLES[s], false);
            CeldPaint paint = blank (SIZE, SIZE);
            Answer    answer;
            int       found;

            lay (&paint, &a, i % 2 ? ORANGE : BLACK);
            lay (&paint, &b, i % 3 ? BLUE : MAGENTA);
            if (paper)
              flatten (&paint);
            if (paper == 2)
              spoil (&paint, 8, &state);
            answer = read_paint (&paint, STYLES[s]);
            found  = is_read (&answer, &a, STYLES[s]) + is_read (&answer, &b, STYLES[s]);
            CHECK (answer.relations.n == (size_t) found); /* no other */
            right += found;
            forget (&answer);
            free (paint.data);
          }
        if (right < 1.7 * n)
          printf ("style %d, paper %d: %d of %d read\n", (int) STYLES[s], paper, right, 2 * n);
        CHECK (right >= 1.7 * n);
        all += right;
      }
  CHECK (all >= 0.95 * 240);
}

/* Soft, fading, pale at its rims, on rough paper, or spoiled: a stroke of one colour is one. */
static void
one_colour_is_one (void)
{
  uint32_t state = 11;
  int      right = 0;

  for (int i = 0; i < 72; i++)
    {
      double    w = random_between (&state, 3, 12), angle = random_between (&state, 0, 6.28);
      Arrow     a = through ((Point) { 100, 100 }, angle, 120, 0.5, w, STYLES[i % 4], false);
      CeldPaint paint = blank (SIZE, SIZE);
      Answer    answer;
      bool      good;

      lay (&paint, &a, i % 3 ? ORANGE : MAGENTA);
      if (i / 4 % 3 == 0 && STYLES[i % 4] != CELD_ARROW_FADE)
        /* rims as pale as they are thin: resampled with the white that lies under transparency */
        for (size_t k = 0; k < paint.stride * (size_t) paint.height; k++)
          for (int c = 0; c < 3; c++)
            paint.data[4 * k + (size_t) c] =
              (uint8_t) (255 - (255 - paint.data[4 * k + (size_t) c]) * paint.data[4 * k + 3] / 255);
      else if (i / 4 % 3 > 0)
        flatten (&paint);
      if (i / 4 % 3 == 2)
        spoil (&paint, random_between (&state, 0, 14), &state);
      if (i / 4 % 3 > 0) /* where all is rim, as at a thin end, rims may be another colour, */
        CHECK (count_strands (&paint, true) == 0);
      answer = read_paint (&paint, STYLES[i % 4]);
      good   = is_read (&answer, &a, STYLES[i % 4]);
      CHECK (answer.relations.n == (size_t) good);
      right += good; /* but then it is still one */
      forget (&answer);
      free (paint.data);
    }
  if (right < 70)
    printf ("%d of 72 read\n", right);
  CHECK (right >= 70);
}

/* A brush that changes its colour on the way, smoothly, in stripes along it, or all at once: an arrow by its form is
 * one arrow or unclear, never two. */
static void
many_colours_may_be_one (void)
{
  uint32_t state = 13;
  int      read[3] = { 0 };

  for (int i = 0; i < 72; i++)
    {
      double    w = random_between (&state, 4, 12), angle = random_between (&state, 0, 6.28);
      CeldArrowStyle style = STYLES[i % 4];
      Arrow     a = through ((Point) { 100, 100 }, angle, 150, 0.5, w, style, false);
      CeldPaint paint = blank (SIZE, SIZE);
      Answer    answer;

      lay (&paint, &a, ORANGE);
      for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++)
          {
            uint8_t *c = paint.data + 4 * ((size_t) y * paint.stride + (size_t) x);
            double   along = ((x - 100) * cos (angle) + (y - 100) * sin (angle)) / 150 + 0.5;
            double   aside = ((y - 100) * cos (angle) - (x - 100) * sin (angle)) / w;
            double   t = i % 3 == 0 ? along : i % 3 == 1 ? aside > 0 : along > 0.45;

            t = fmax (0, fmin (1, t));
            for (int k = 0; k < 3; k++)
              c[k] = (uint8_t) (ORANGE[k] + t * (BLUE[k] - ORANGE[k]));
          }
      if (i % 3 == 0)
        CHECK (count_strands (&paint, false) == 0);
      answer = read_paint (&paint, style);
      CHECK (answer.relations.n == (size_t) is_read (&answer, &a, style));
      CHECK (answer.relations.n + answer.problems.n >= 1);
      read[i % 3] += answer.relations.n == 1;
      forget (&answer);
      free (paint.data);
    }
  CHECK (read[0] >= 11 && read[1] >= 11); /* heads and dots */
}

/* Between 40 and 60 steps of 255 it is not clear whether colours are one: nothing is read from one to the other. */
static void
close_colours_stay_together (void)
{
  for (int i = 0; i < 60; i += 3)
    {
      uint8_t   close[3] = { (uint8_t) (ORANGE[0] - i), ORANGE[1], (uint8_t) (ORANGE[2] + i / 2) };
      CeldArrowStyle style = STYLES[i % 4];
      Arrow     a = through ((Point) { 100, 100 }, 0.3, 160, 0.4, 5, style, false);
      Arrow     b = through ((Point) { 100, 100 }, 1.2, 160, 0.4, 5, style, false);
      CeldPaint paint = blank (SIZE, SIZE);
      Answer    answer;

      lay (&paint, &a, ORANGE);
      lay (&paint, &b, close);
      if (hypot (close[0] - ORANGE[0], close[2] - ORANGE[2]) < 58)
        CHECK (count_strands (&paint, false) == 0);
      answer = read_paint (&paint, style);
      CHECK (answer.relations.n == (size_t) is_read (&answer, &a, style) + is_read (&answer, &b, style));
      CHECK (answer.relations.n + answer.problems.n >= 1);
      forget (&answer);
      free (paint.data);
    }
}

/* A stroke that ends on another may go on below: it is unclear.  The other one is read. */
static void
hidden_ends_are_unclear (void)
{
  for (int degrees = 40; degrees <= 140; degrees += 10)
    for (size_t s = 0; s < 4; s++)
      {
        double    turn = degrees * 0.0174532925;
        Arrow     a = through ((Point) { 100, 100 }, 0.3, 160, 0.5, 7, STYLES[s], false);
        Arrow     b = through ((Point) { 100, 100 }, 0.3 + turn, 80, 0, 5, STYLES[s], false);
        CeldPaint paint = blank (SIZE, SIZE);
        Answer    answer;

        lay (&paint, &b, BLUE);
        lay (&paint, &a, ORANGE);
        answer = read_paint (&paint, STYLES[s]);
        CHECK (answer.relations.n == 1 && is_read (&answer, &a, STYLES[s]));
        CHECK (answer.problems.n == 1);
        forget (&answer);
        free (paint.data);
      }
}

/* End to end in two colours they may be one arrow, or two: nothing is guessed. */
static void
arrows_end_to_end (void)
{
  for (int turn = -4; turn <= 4; turn++)
    for (size_t s = 0; s < 4; s++)
      {
        Point     middle = { 100, 100 };
        Arrow     a = through (middle, 0.3, 80, 0, 6, STYLES[s], false);
        Arrow     b = through (middle, 3.44 + 0.1 * turn, 50, 0, 4, STYLES[s], false);
        CeldPaint paint = blank (SIZE, SIZE);
        Answer    answer;

        lay (&paint, &b, BLUE);
        lay (&paint, &a, ORANGE);
        answer = read_paint (&paint, STYLES[s]);
        CHECK (answer.relations.n == (size_t) is_read (&answer, &a, STYLES[s]) + is_read (&answer, &b, STYLES[s]));
        CHECK (answer.relations.n + answer.problems.n >= 1);
        forget (&answer);
        free (paint.data);
      }
}

/* Colours of strokes that cross stay with them, hidden or not. */
static void
cracks_that_are_crossed (void)
{
  for (int below = 0; below < 2; below++)
    {
      Arrow     a = through ((Point) { 100, 100 }, 0.3, 150, 0.5, 5, CELD_ARROW_HEAD, false);
      Arrow     b = through ((Point) { 100, 100 }, 1.7, 150, 0.5, 5, CELD_ARROW_HEAD, false);
      CeldPaint paint = blank (SIZE, SIZE);
      Answer    answer;

      lay (&paint, below ? &a : &b, below ? BLUE : ORANGE);
      lay (&paint, below ? &b : &a, below ? ORANGE : BLUE);
      answer = read_paint (&paint, CELD_ARROW_HEAD);
      CHECK (answer.relations.n == 2 && answer.problems.n == 0);
      for (size_t i = 0; i < answer.relations.n; i++)
        CHECK (answer.relations.item[i].crack == (hypot (answer.relations.item[i].farther.x - a.tip.x,
                                                         answer.relations.item[i].farther.y - a.tip.y) < 6));
      forget (&answer);
      free (paint.data);
    }
}

/* Confetti: more colours and contacts than any arrows have. */
static void
confetti (void)
{
  CeldPaint paint = blank (SIZE, SIZE);
  uint32_t  state = 3;
  Answer    answer;

  for (int y = 0; y < SIZE; y += 10)
    for (int x = 0; x < SIZE; x += 10)
      {
        uint8_t c[3] = { (uint8_t) check_random (&state, 256), (uint8_t) check_random (&state, 256),
                         (uint8_t) check_random (&state, 256) };

        for (int i = 0; i < 100; i++)
          {
            uint8_t *p = paint.data + 4 * ((size_t) (y + i / 10) * paint.stride + (size_t) (x + i % 10));

            memcpy (p, c, 3);
            p[3] = 255;
          }
      }
  paint.data[3] = 0;
  CHECK (count_strands (&paint, false) == 0);
  answer = read_paint (&paint, CELD_ARROW_TAPER);
  CHECK (answer.relations.n == 0 && answer.problems.n >= 1);
  forget (&answer);
  free (paint.data);
}

int
main (void)
{
  RUN (strands_are_whole);
  RUN (two_that_cross);
  RUN (one_colour_is_one);
  RUN (many_colours_may_be_one);
  RUN (close_colours_stay_together);
  RUN (hidden_ends_are_unclear);
  RUN (arrows_end_to_end);
  RUN (cracks_that_are_crossed);
  RUN (confetti);
  return DONE;
}
