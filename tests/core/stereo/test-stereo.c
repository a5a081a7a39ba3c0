/* Stereo comfort, the floating window, camera paths, and frame packing.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "base/base.h"

#include <math.h>

enum { W = 80, H = 30 };

static CeldColours
new_colours (int width, int height)
{
  size_t n = 4 * (size_t) width * (size_t) height;

  return (CeldColours) { width, height, (size_t) width, calloc (n, sizeof (float)) };
}

/* A board of depth 1 from x = 30 to 49 in front of paper of depth 0. */
static CeldPlane
board_depth (void)
{
  CeldPlane depth;

  CHECK (celd_plane_new (W, H, &depth) == CELD_OK);
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      CELD_AT (&depth, x, y) = x >= 30 && x < 50 && y >= 6 && y < 24;
  return depth;
}

static void
comfort_is_told (void)
{
  CeldPlane    depth = board_depth ();
  CeldSettings settings = celd_settings ();
  CeldComfort  comfort;

  settings.disparity   = 0.1f;
  settings.convergence = 0.25f;
  CHECK (celd_stereo_comfort (&depth, &settings, &comfort) == CELD_OK);
  NEAR (comfort.front, 0.075, 1e-6);
  NEAR (comfort.behind, 0.025, 1e-6);
  CHECK (!comfort.cut_left && !comfort.cut_right);
  CELD_AT (&depth, W - 1, 3) = 1;
  CHECK (celd_stereo_comfort (&depth, &settings, &comfort) == CELD_OK);
  CHECK (!comfort.cut_left && comfort.cut_right);
  settings.convergence = 1; /* nothing is in front of the screen */
  CHECK (celd_stereo_comfort (&depth, &settings, &comfort) == CELD_OK);
  CHECK (!comfort.cut_left && !comfort.cut_right);
  NEAR (comfort.front, 0, 1e-9);
  CHECK (!comfort.diverges);
  settings.screen_width = 649; /* a tenth of it is behind the screen */
  CHECK (celd_stereo_comfort (&depth, &settings, &comfort) == CELD_OK);
  CHECK (!comfort.diverges);
  settings.screen_width = 651;
  CHECK (celd_stereo_comfort (&depth, &settings, &comfort) == CELD_OK);
  CHECK (comfort.diverges);
  settings.screen_width = -1;
  CHECK (celd_stereo_comfort (&depth, &settings, &comfort) == CELD_BAD_VALUE);
  settings.screen_width = 0;
  settings.convergence = 2;
  CHECK (celd_stereo_comfort (&depth, &settings, &comfort) == CELD_BAD_VALUE);
  free (depth.data);
}

/* Every warning says what to do, within the room there is. */
static void
comfort_is_put_in_words (void)
{
  CeldComfort  all = { .front = 0.06, .behind = 0.04, .cut_left = true, .cut_right = true, .diverges = true };
  CeldSettings settings = celd_settings ();
  char         text[800], little[20];

  settings.disparity    = 0.1f;
  settings.screen_width = 2000;
  celd_comfort_text (&(CeldComfort) { .front = 0.02 }, &settings, NULL, text, sizeof text);
  CHECK (!text[0]);
  celd_comfort_text (&all, &settings, NULL, text, sizeof text);
  CHECK (strstr (text, "10.0 %") && strstr (text, "disparity of 0.033"));
  CHECK (strstr (text, "2000 mm") && strstr (text, "80 mm apart") && strstr (text, "disparity of 0.081"));
  CHECK (strstr (text, "left and the right") && text[strlen (text) - 1] == '.');
  settings.floating_window = true;
  celd_comfort_text (&all, &settings, NULL, text, sizeof text);
  CHECK (!strstr (text, "frame"));
  celd_comfort_text (&all, &settings, NULL, little, sizeof little);
  CHECK (strlen (little) == sizeof little - 1);
}

/* Bars appear only where something is cut off, as wide as its disparity: at the left of the left view and at the
 * right of the right one; the last pixel is partly covered. */
static void
windows_float_before_what_they_cut (void)
{
  CeldPlane    depth = board_depth ();
  CeldColours  view[2] = { new_colours (W, H), new_colours (W, H) };
  CeldSettings settings = celd_settings ();

  settings.disparity   = 0.1f; /* 8 pixels */
  settings.convergence = 0.25f;
  CELD_AT (&depth, 0, 3) = 0.7f;
  CELD_AT (&depth, W - 1, 9) = 1;
  for (int i = 0; i < 4 * W * H; i++)
    view[0].data[i] = view[1].data[i] = i % 4 == 3 ? 1 : 0.5f;
  CHECK (celd_stereo_window (&depth, &settings, &view[0], &view[1]) == CELD_OK);
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        double left = fmax (0, fmin (8 * 0.45 - x, 1)), right = fmax (0, fmin (8 * 0.75 - (W - 1 - x), 1));

        NEAR (CELD_RGBA (&view[0], x, y)[1], 0.5 * (1 - left), 1e-5);
        NEAR (CELD_RGBA (&view[1], x, y)[1], 0.5 * (1 - right), 1e-5);
        NEAR (CELD_RGBA (&view[0], x, y)[3], 1, 0);
      }
  depth.width--;
  CHECK (celd_stereo_window (&depth, &settings, &view[0], &view[1]) == CELD_BAD_SIZE);
  free (depth.data);
  free (view[0].data);
  free (view[1].data);
}

/* Every path is closed, moves in small steps, and extends as far as both eyes. */
static void
paths_are_closed (void)
{
  for (int path = CELD_PATH_SWAY; path <= (int) CELD_PATH_TURNTABLE; path++)
    for (int frames = 4; frames <= 400; frames *= 10)
      {
        CeldCamera first = celd_camera_on_path ((CeldPath) path, 0, frames), before = first;
        double     least = 0, most = 0;

        for (int k = 1; k <= frames; k++)
          {
            CeldCamera next = celd_camera_on_path ((CeldPath) path, k, frames);

            CHECK (hypot (next.x - before.x, next.y - before.y) < 7.0 / frames);
            CHECK (next.squeeze > 0.9 && next.squeeze <= 1);
            CHECK (fabs (next.x) <= 1 && fabs (next.y) <= 1);
            least  = fmin (least, next.x);
            most   = fmax (most, next.x);
            before = next;
          }
        NEAR (before.x, first.x, 1e-9);
        NEAR (before.y, first.y, 1e-9);
        NEAR (least, -1, 1e-6);
        NEAR (most, 1, 1e-6);
      }
}

/* ------------------------------------------------------------------ frame packing */

/* White and greys are preserved by anaglyphs; each glass shows its own eye's view. */
static void
glasses_keep_white_and_greys (void)
{
  for (int format = CELD_STEREO_GREY; format <= (int) CELD_STEREO_DUBOIS; format++)
    for (int k = 0; k <= 10; k++)
      {
        float       grey[4] = { (float) k / 10, (float) k / 10, (float) k / 10, 1 }, to[4];
        CeldColours view = { 1, 1, 1, grey }, joined = { 1, 1, 1, to };

        CHECK (celd_stereo_join (&view, &view, (CeldStereo) format, &joined) == CELD_OK);
        for (int c = 0; c < 3; c++)
          NEAR (to[c], grey[c], 0.002);
        NEAR (to[3], 1, 0);
      }
}

static void
the_left_view_is_red (void)
{
  for (int format = CELD_STEREO_GREY; format <= (int) CELD_STEREO_DUBOIS; format++)
    {
      float       white[4] = { 1, 1, 1, 1 }, black[4] = { 0, 0, 0, 1 }, to[4];
      CeldColours one = { 1, 1, 1, white }, other = { 1, 1, 1, black }, joined = { 1, 1, 1, to };

      CHECK (celd_stereo_join (&one, &other, (CeldStereo) format, &joined) == CELD_OK);
      CHECK (to[0] > 0.95f && to[1] < 0.05f && to[2] < 0.05f);
      CHECK (celd_stereo_join (&other, &one, (CeldStereo) format, &joined) == CELD_OK);
      CHECK (to[0] < 0.05f && to[1] > 0.95f && to[2] > 0.95f);
    }
}

/* Where one view is transparent, the other one's is as opaque as before. */
static void
glasses_see_through_what_is_transparent (void)
{
  float       white[4] = { 1, 1, 1, 0.5f }, nothing[4] = { 0.9f, 0.9f, 0.9f, 0 }, to[4];
  CeldColours one = { 1, 1, 1, white }, other = { 1, 1, 1, nothing }, joined = { 1, 1, 1, to };

  CHECK (celd_stereo_join (&one, &other, CELD_STEREO_COLOUR, &joined) == CELD_OK);
  CHECK (to[0] == 1 && to[1] == 0 && to[2] == 0 && to[3] == 0.5f);
  CHECK (celd_stereo_join (&other, &other, CELD_STEREO_DUBOIS, &joined) == CELD_OK);
  CHECK (to[0] == 0 && to[1] == 0 && to[2] == 0 && to[3] == 0);
}

/* Pixels of the left view are 1, 2, 3, ...; those of the right one 101, 102, 103, ... */
static void
views_lie_where_the_format_says (void)
{
  enum { w = 3, h = 2 };
  static const struct { CeldStereo format; int width, height; float pixel[12]; } cases[] = {
    { CELD_STEREO_LEFT, w, h, { 1, 2, 3, 4, 5, 6 } },
    { CELD_STEREO_RIGHT, w, h, { 101, 102, 103, 104, 105, 106 } },
    { CELD_STEREO_SIDE_BY_SIDE, 2 * w, h, { 1, 2, 3, 101, 102, 103, 4, 5, 6, 104, 105, 106 } },
    { CELD_STEREO_CROSSED, 2 * w, h, { 101, 102, 103, 1, 2, 3, 104, 105, 106, 4, 5, 6 } },
    { CELD_STEREO_HALF_SIDE_BY_SIDE, w, h, { 1.5f, 3, 101.5f, 4.5f, 6, 104.5f } },
    { CELD_STEREO_OVER_UNDER, w, 2 * h, { 1, 2, 3, 4, 5, 6, 101, 102, 103, 104, 105, 106 } },
    { CELD_STEREO_HALF_OVER_UNDER, w, h, { 2.5f, 3.5f, 4.5f, 102.5f, 103.5f, 104.5f } },
    { CELD_STEREO_INTERLACED, w, h, { 1, 2, 3, 104, 105, 106 } },
    { CELD_STEREO_COLUMNS, w, h, { 1, 102, 3, 4, 105, 6 } },
  };
  CeldColours left = new_colours (w, h), right = new_colours (w, h);

  for (int i = 0; i < 4 * w * h; i++)
    {
      left.data[i]  = i % 4 == 3 ? 1 : (float) (i / 4 + 1);
      right.data[i] = i % 4 == 3 ? 1 : (float) (i / 4 + 101);
    }
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
    {
      int         width = w, height = h;
      CeldColours joined;

      celd_stereo_size (cases[k].format, &width, &height);
      CHECK (width == cases[k].width && height == cases[k].height);
      joined = new_colours (width, height);
      CHECK (celd_stereo_join (&left, &right, cases[k].format, &joined) == CELD_OK);
      for (int i = 0; i < width * height; i++)
        NEAR (joined.data[4 * i + 1], cases[k].pixel[i], 0);
      if (width == w && height == h) /* in the memory of the left view */
        {
          CeldColours over = new_colours (w, h);

          memcpy (over.data, left.data, 4 * w * h * sizeof *over.data);
          CHECK (celd_stereo_join (&over, &right, cases[k].format, &over) == CELD_OK);
          CHECK (!memcmp (over.data, joined.data, 4 * w * h * sizeof *over.data));
          free (over.data);
        }
      joined.width--;
      CHECK (celd_stereo_join (&left, &right, cases[k].format, &joined) == CELD_BAD_SIZE);
      free (joined.data);
    }
  free (left.data);
  free (right.data);
}

int
main (void)
{
  RUN (comfort_is_told);
  RUN (comfort_is_put_in_words);
  RUN (windows_float_before_what_they_cut);
  RUN (paths_are_closed);
  RUN (glasses_keep_white_and_greys);
  RUN (the_left_view_is_red);
  RUN (glasses_see_through_what_is_transparent);
  RUN (views_lie_where_the_format_says);
  return DONE;
}
