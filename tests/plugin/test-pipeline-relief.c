/* The relief that turns, of a disc in front of paper: its views have the parallax that its heights demand.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "pipeline.h"

#define WIDTH  160
#define HEIGHT 120
#define PIXELS (WIDTH * HEIGHT)
#define RADIUS 40.f   /* of the disc's outline, in pixels, which is 3 pixels wide */
#define FRAMES 5
#define MIDDLE 2

static GeglBuffer *drawing, *scribbles;

/* Ink: the outline, a dot in the middle of the disc, and a dot on the paper. */
static float
value (int x, int y)
{
  float px = (float) x + 0.5f, py = (float) y + 0.5f;
  float line = fabsf (hypotf (px - 80, py - 60) - RADIUS) - 1, dot = hypotf (px - 80, py - 60) - 2;
  float other = hypotf (px - 80, py - 112) - 2;

  return CLAMP (MIN (line, MIN (dot, other)), 0, 1);
}

static void
make_page (void)
{
  static float   luma[PIXELS];
  static guint32 paint[PIXELS];

  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++)
      {
        luma[y * WIDTH + x] = value (x, y);
        if (abs (x - 80) < 15 && abs (y - 50) < 2)
          paint[y * WIDTH + x] = GUINT32_TO_LE (0xff0000ff); /* red */
      }
  drawing   = gegl_buffer_new (GEGL_RECTANGLE (0, 0, WIDTH, HEIGHT), babl_format ("Y' float"));
  scribbles = gegl_buffer_new (GEGL_RECTANGLE (0, 0, WIDTH, HEIGHT), babl_format ("R'G'B'A u8"));
  gegl_buffer_set (drawing, NULL, 0, babl_format ("Y' float"), luma, GEGL_AUTO_ROWSTRIDE);
  gegl_buffer_set (scribbles, NULL, 0, babl_format ("R'G'B'A u8"), paint, GEGL_AUTO_ROWSTRIDE);
}

static CeldPipeline *
page_pipeline (void)
{
  CeldPipelineInput input = { WIDTH, HEIGHT, { { NULL, 0, 0, 0 } }, celd_settings (), "80,50 > 8,8", NULL };

  input.layer[CELD_LAYER_DRAWING].buffer   = drawing;
  input.layer[CELD_LAYER_SCRIBBLES].buffer = scribbles;
  return celd_pipeline_new (&input, NULL);
}

/* A frame in this size, as grey. */
static bool
turn (CeldPipeline *pipeline, int frame, int width, int height, float *grey)
{
  GeglBuffer *buffer = gegl_buffer_new (GEGL_RECTANGLE (0, 0, width, height), babl_format ("R'G'B'A float"));
  bool        good = celd_pipeline_write_turned (pipeline, frame, FRAMES, NULL, NULL, buffer, NULL);

  gegl_buffer_get (buffer, NULL, 1, babl_format ("Y float"), grey, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  g_object_unref (buffer);
  return good;
}

/* The place of a dot of ink in its row, of which it is the only ink in the middle half of the picture. */
static double
dot_at (const float *grey, int y)
{
  double ink = 0, sum = 0;

  for (int x = WIDTH / 4 + 15; x < WIDTH * 3 / 4 - 15; x++)
    {
      double dark = (double) MAX (0.1f - grey[y * WIDTH + x], 0);

      ink += dark;
      sum += dark * (x + 0.5);
    }
  return sum / ink;
}

/* The disc is a part of a ball, as high as settings.relief_bulge says, on top of its depth.  Its outline is 1.5 pixels
 * outside the middle of the line, which is the disc's. */
static void
near_points_move_by_their_height (void)
{
  CeldPipeline *pipeline = page_pipeline ();
  CeldSettings  usual = celd_settings ();
  double        height = (double) (usual.relief_bulge * (RADIUS + 1.5f)) +
                         (double) usual.relief_depth * hypot (WIDTH, HEIGHT);
  double        apart[FRAMES], full = 2 * sin (20 * G_PI / 180) * height;
  static float  grey[PIXELS];

  CHECK (pipeline && celd_pipeline_make_relief (pipeline, NULL, NULL, NULL));
  for (int frame = 0; frame < FRAMES; frame++)
    {
      CHECK (turn (pipeline, frame, WIDTH, HEIGHT, grey));
      apart[frame] = dot_at (grey, 60) - dot_at (grey, 112);
    }
  CHECK (apart[0] > 0); /* seen from the left, what is near lies to the right */
  CHECK (fabs (apart[0] - apart[FRAMES - 1] - full) < 0.02 * full);
  CHECK (fabs (apart[0] + apart[FRAMES - 1]) < 0.1 && fabs (apart[MIDDLE]) < 0.1);
  CHECK (apart[0] > apart[1] && apart[1] > apart[2] && apart[2] > apart[3] && apart[3] > apart[4]);
  celd_pipeline_free (pipeline);
}

static void
from_the_front_it_is_the_lit_drawing (void)
{
  CeldPipeline *pipeline = page_pipeline ();
  GeglBuffer   *lit = gegl_buffer_new (GEGL_RECTANGLE (0, 0, WIDTH, HEIGHT), babl_format ("R'G'B'A float"));
  static float  grey[PIXELS], wanted[PIXELS];
  float         most = 0;

  CHECK (pipeline && celd_pipeline_make_relief (pipeline, NULL, NULL, NULL));
  CHECK (celd_pipeline_write (pipeline, CELD_PICTURE_LIT, lit, NULL));
  CHECK (turn (pipeline, MIDDLE, WIDTH, HEIGHT, grey));
  gegl_buffer_get (lit, NULL, 1, babl_format ("Y float"), wanted, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  for (int i = 0; i < PIXELS; i++)
    most = MAX (most, fabsf (grey[i] - wanted[i]));
  CHECK (most < 0.01f);
  g_object_unref (lit);
  celd_pipeline_free (pipeline);
}

/* A pixel of half the size is the mean of four. */
static void
views_are_scaled_to_the_buffer (void)
{
  CeldPipeline *pipeline = page_pipeline ();
  static float  grey[PIXELS], half[PIXELS / 4];
  float         most = 0;

  CHECK (pipeline && celd_pipeline_make_relief (pipeline, NULL, NULL, NULL));
  CHECK (turn (pipeline, 1, WIDTH, HEIGHT, grey) && turn (pipeline, 1, WIDTH / 2, HEIGHT / 2, half));
  for (int y = 0; y < HEIGHT / 2; y++)
    for (int x = 0; x < WIDTH / 2; x++)
      {
        const float *p = grey + 2 * y * WIDTH + 2 * x;

        most = MAX (most, fabsf (half[y * WIDTH / 2 + x] - (p[0] + p[1] + p[WIDTH] + p[WIDTH + 1]) / 4));
      }
  CHECK (most < 0.02f);
  celd_pipeline_free (pipeline);
}

static gboolean
stop (gpointer data, double done, const char *step)
{
  (void) data;
  (void) done;
  (void) step;
  return FALSE;
}

static void
it_can_be_given_up (void)
{
  CeldPipeline *pipeline = page_pipeline ();
  GError       *error = NULL;
  static float  grey[PIXELS];

  CHECK (!turn (pipeline, 0, WIDTH, HEIGHT, grey)); /* none has been made */
  CHECK (!celd_pipeline_make_relief (pipeline, stop, NULL, &error));
  CHECK (g_error_matches (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_CANCELLED));
  g_clear_error (&error);
  CHECK (!turn (pipeline, 0, WIDTH, HEIGHT, grey));
  CHECK (celd_pipeline_make_relief (pipeline, NULL, NULL, NULL) && turn (pipeline, 0, WIDTH, HEIGHT, grey));
  celd_pipeline_free (pipeline);
}

int
main (void)
{
  gegl_init (NULL, NULL);
  make_page ();
  RUN (near_points_move_by_their_height);
  RUN (from_the_front_it_is_the_lit_drawing);
  RUN (views_are_scaled_to_the_buffer);
  RUN (it_can_be_given_up);
  g_object_unref (drawing);
  g_object_unref (scribbles);
  gegl_exit ();
  return DONE;
}
