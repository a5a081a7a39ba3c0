/* Stereo comfort: cameras, limits of disparity, and the floating window.
 *
 * A point of depth d has the disparity  B (d - d_0)  in front of the screen, where B is a fraction of the width for
 * each unit of depth, and points of depth d_0, the convergence, are on the screen.  Behind the screen the disparity
 * must not exceed the distance of the eyes, or these diverge.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "stereo/scene.h"

#include <stdio.h>

#define CIRCLE_RATIO 0.6 /* height to width of the camera's path, because eyes lie side by side; chosen */

/* ------------------------------------------------------------------ cameras */

CeldCamera
celd_camera_eye (double eye)
{
  return (CeldCamera) { eye, 0, 1 };
}

CeldCamera
celd_camera_on_path (CeldPath path, int frame, int frames)
{
  double angle = frames > 0 ? 2 * CELD_PI * (frame % frames) / frames : 0;
  double side = sin (CELD_TURNTABLE_ANGLE * CELD_PI / 180), turn = sin (angle) * CELD_TURNTABLE_ANGLE * CELD_PI / 180;

  switch (path)
    {
    case CELD_PATH_CIRCLE:    return (CeldCamera) { sin (angle), -CIRCLE_RATIO * cos (angle), 1 };
    case CELD_PATH_TURNTABLE: return (CeldCamera) { fmax (-1, fmin (sin (turn) / side, 1)), 0, cos (turn) };
    default:                  return (CeldCamera) { sin (angle), 0, 1 };
    }
}

/* ------------------------------------------------------------------ comfort */

typedef struct { double least, most, screen; } ComfortRange;

static ComfortRange
range_of (const CeldPlane *depth, const CeldSettings *settings)
{
  ComfortRange range;

  celd_depth_range (depth, &range.least, &range.most);
  range.screen = range.least + (double) settings->convergence * (range.most - range.least);
  return range;
}

/* Distance in depth by which the nearest pixel of a column is in front of the screen. */
static double
column_front (const CeldPlane *depth, int x, double screen)
{
  double most = screen;

  for (int y = 0; y < depth->height; y++)
    if (fabsf (CELD_AT (depth, x, y)) <= FLT_MAX)
      most = fmax (most, (double) celd_scene_depth (CELD_AT (depth, x, y)));
  return most - screen;
}

CeldStatus
celd_stereo_comfort (const CeldPlane *depth, const CeldSettings *settings, CeldComfort *comfort)
{
  ComfortRange range;
  double       disparity = (double) settings->disparity;

  if (!CELD_SAME_SIZE (depth, depth))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;
  range    = range_of (depth, settings);
  *comfort = (CeldComfort) {
    .front     = disparity * (range.most - range.screen),
    .behind    = disparity * (range.screen - range.least),
    .cut_left  = disparity * depth->width * column_front (depth, 0, range.screen) > 1,
    .cut_right = disparity * depth->width * column_front (depth, depth->width - 1, range.screen) > 1,
  };
  comfort->diverges = comfort->behind * (double) settings->screen_width > CELD_EYE_DISTANCE;
  return CELD_OK;
}

/* Where the frame cuts what is in front of the screen. */
static const char *
cut_sides (const CeldComfort *comfort)
{
  if (comfort->cut_left && comfort->cut_right)
    return N_ ("at the left and the right");
  return comfort->cut_left ? N_ ("at the left") : N_ ("at the right");
}

/* Suggested values are rounded down, so that they suffice. */
void
celd_comfort_text (const CeldComfort *comfort, const CeldSettings *settings, CeldTranslate translate, char *text,
                   size_t size)
{
  double whole = comfort->front + comfort->behind, disparity = (double) settings->disparity;
  double behind = comfort->behind * (double) settings->screen_width; /* mm */
  size_t used = 0;

  if (size)
    text[0] = 0;
  if (whole > CELD_STEREO_COMFORT)
    used += (size_t) snprintf (text, size,
                               celd_in (translate, N_ ("From front to back there is %.1f %% of the width, which "
                                                       "strains the eyes: try a disparity of %.3f.\n")),
                               100 * whole, floor (1000 * disparity * CELD_STEREO_COMFORT / whole) / 1000);
  if (comfort->diverges && used < size)
    used += (size_t) snprintf (text + used, size - used,
                               celd_in (translate, N_ ("On a screen of %.0f mm what is farthest lies %.0f mm apart, "
                                                       "more than the eyes do (%.0f mm), which would have to look "
                                                       "apart: try a disparity of %.3f, or a convergence nearer to "
                                                       "0.\n")),
                               (double) settings->screen_width, behind, CELD_EYE_DISTANCE,
                               floor (1000 * disparity * CELD_EYE_DISTANCE / behind) / 1000);
  if ((comfort->cut_left || comfort->cut_right) && !settings->floating_window && used < size)
    used += (size_t) snprintf (text + used, size - used,
                               celd_in (translate, N_ ("Parts in front of the screen are cut by the frame %s: try a "
                                                       "convergence of 1, or the floating window.\n")),
                               celd_in (translate, cut_sides (comfort)));
  if (used && used < size)
    text[used - 1] = 0;
}

/* ------------------------------------------------------------------ floating window */

/* Covers a fraction of a pixel with black. */
static void
darken (float *rgba, double share)
{
  double alpha = share + (1 - share) * (double) rgba[3];

  for (int c = 0; c < 3 && alpha > 0; c++)
    rgba[c] = (float) ((1 - share) * (double) rgba[3] * (double) rgba[c] / alpha);
  rgba[3] = (float) alpha;
}

/* Draws a black bar at one side, `wide` pixels wide. */
static void
draw_bar (CeldColours *view, bool right, double wide)
{
  for (int k = 0; k < wide && k < view->width; k++)
    for (int y = 0; y < view->height; y++)
      darken (CELD_RGBA (view, right ? view->width - 1 - k : k, y), fmin (wide - k, 1));
}

CeldStatus
celd_stereo_window (const CeldPlane *depth, const CeldSettings *settings, CeldColours *left, CeldColours *right)
{
  double pixels = (double) settings->disparity * depth->width, screen;

  if (!CELD_SAME_SIZE (depth, left) || !CELD_SAME_SIZE (depth, right))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;
  screen = range_of (depth, settings).screen;
  draw_bar (left, false, pixels * column_front (depth, 0, screen));
  draw_bar (right, true, pixels * column_front (depth, depth->width - 1, screen));
  return CELD_OK;
}
