/* What a drawing was made with, and the level of its paper.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/ink-steps.h"


enum { SIDE = 192 };

static float luma_of[SIDE * SIDE], alpha_of[SIDE * SIDE], value_of[SIDE * SIDE], paper_of[SIDE * SIDE];

static CeldPlane
square (float *data)
{
  return (CeldPlane) { SIDE, SIDE, SIDE, data };
}

/* Lines of `breadth` pixels every 32. */
static bool
on_line (int i, int breadth)
{
  return i % SIDE % 32 < breadth || i / SIDE % 32 < breadth;
}

static bool
in_disc (int i, float radius)
{
  return hypotf ((float) (i % SIDE) - 95.5f, (float) (i / SIDE) - 95.5f) < radius;
}

static CeldInkMode
mode_of (bool with_alpha)
{
  CeldDrawing drawing = { .luma = square (luma_of) };

  if (with_alpha)
    drawing.alpha = square (alpha_of);
  return celd_ink_mode (&drawing, CELD_INK_AUTO);
}

static void
opaque_drawings (void)
{
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = on_line (i, 3) ? 0.1f : 0.9f;
  CHECK (mode_of (false) == CELD_INK_DARK);
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = 1 - luma_of[i];
  CHECK (mode_of (false) == CELD_INK_LIGHT);

  /* grey boards: what is on them decides */
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = on_line (i, 3) ? 0.8f : 0.4f;
  CHECK (mode_of (false) == CELD_INK_LIGHT);
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = on_line (i, 3) ? 0.1f : 0.4f;
  CHECK (mode_of (false) == CELD_INK_DARK);

  /* lines so broad that a little more than half is black, as in a part cut out of an icon; chalk as broad as lines can be */
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = on_line (i, 9) || (i % SIDE % 32 == 9) ? 0 : 1;
  CHECK (mode_of (false) == CELD_INK_DARK);
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = on_line (i + 16 + 16 * SIDE, 7) ? 1 : 0;
  CHECK (mode_of (false) == CELD_INK_LIGHT);

  /* more black than white, but paper has the frame; black frame, but more white than black */
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = in_disc (i, 85) ? 0 : 1;
  CHECK (mode_of (false) == CELD_INK_DARK);
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = i % SIDE < 8 || i % SIDE >= SIDE - 8 || i / SIDE < 8 || i / SIDE >= SIDE - 8 ? 0 : 1;
  CHECK (mode_of (false) == CELD_INK_DARK);
}

static void
layers (void)
{
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      luma_of[i] = (float) (i % SIDE / 32) / 6; /* lines of many colours */
      alpha_of[i] = on_line (i, 2) ? 1 : 0;
    }
  CHECK (mode_of (true) == CELD_INK_ALPHA);
  for (int i = 0; i < SIDE * SIDE; i++)
    alpha_of[i] = 1;
  CHECK (mode_of (true) != CELD_INK_ALPHA);
  CHECK (celd_ink_mode (&(CeldDrawing) { square (luma_of), square (alpha_of) }, CELD_INK_ALPHA) != CELD_INK_ALPHA);

  /* a sprite with an outline and a fill; a flat sprite without outline */
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      alpha_of[i] = in_disc (i, 60) ? 1 : 0;
      luma_of[i] = in_disc (i, 57) ? 0.8f : 0;
    }
  CHECK (mode_of (true) == CELD_INK_DARK);
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = 0.6f;
  CHECK (mode_of (true) == CELD_INK_DARK);
}

/* Compositing: black on white paper, white on black paper, in encoded values. */
static void
values (void)
{
  CeldDrawing drawing = { square (luma_of), square (alpha_of) };
  CeldPlane   value = square (value_of);

  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = alpha_of[i] = 0.5f;
  luma_of[1] = NAN;
  alpha_of[2] = NAN;
  celd_ink_values (&drawing, CELD_INK_DARK, &value);
  CHECK (value_of[0] == 0.75f && value_of[1] == 1 && value_of[2] == 1);
  celd_ink_values (&drawing, CELD_INK_LIGHT, &value);
  CHECK (value_of[0] == 0.75f && value_of[1] == 1 && value_of[2] == 1);
  celd_ink_values (&drawing, CELD_INK_ALPHA, &value);
  CHECK (value_of[0] == 0.5f && value_of[1] == 1 && value_of[2] == 1);
}

/* White paper is 1 to the last bit, also where solid ink covers many tiles. */
static void
white_paper (void)
{
  CeldPlane value = square (value_of), paper = square (paper_of);

  for (int i = 0; i < SIDE * SIDE; i++)
    value_of[i] = in_disc (i, 80) || on_line (i, 3) ? 0 : 1;
  CHECK (celd_paper_levels (&value, &paper) == CELD_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    CHECK (paper_of[i] == 1);
}

/* Paper that darkens in one direction is followed up to the frame, through lines and solid ink. */
static void
uneven_paper (void)
{
  CeldPlane value = square (value_of), paper = square (paper_of);

  for (int i = 0; i < SIDE * SIDE; i++)
    value_of[i] = in_disc (i, 25) || on_line (i, 3) ? 0.05f : 0.95f - 0.4f * (float) (i % SIDE) / SIDE;
  CHECK (celd_paper_levels (&value, &paper) == CELD_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    NEAR (paper_of[i], 0.95 - 0.4 * (i % SIDE) / SIDE, 0.035);
}

/* Contrast is that against the levels, and nothing is lighter than paper. */
static void
contrast_against_paper (void)
{
  CeldPlane value = square (value_of), paper = square (paper_of);

  for (int i = 0; i < SIDE * SIDE; i++)
    value_of[i] = on_line (i, 3) ? 0.05f : 0.95f - 0.4f * (float) (i % SIDE) / SIDE + 0.01f * (float) (i % 3);
  CHECK (celd_paper_levels (&value, &paper) == CELD_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    paper_of[i] = fmaxf (1 - value_of[i] / paper_of[i], 0);
  CHECK (celd_paper_contrast (&value) == CELD_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    NEAR (value_of[i], paper_of[i], 1e-6);
}

int
main (void)
{
  RUN (opaque_drawings);
  RUN (layers);
  RUN (values);
  RUN (white_paper);
  RUN (uneven_paper);
  RUN (contrast_against_paper);
  return DONE;
}
