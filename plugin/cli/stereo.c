/* celdepth stereo: views for two eyes, or more views, from completed layers and smooth depth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <string.h>

/* ------------------------------------------------------------------ two views */

/* Two views, and the picture that both are joined to.  They take its memory: for two views side by side or over each
 * other each is a half of it, else the left one becomes it. */
typedef struct { CeldColours joined, view[2]; float *right; } ViewPair;

static bool
pair_new (const CliScene *s, CeldStereo format, ViewPair *pair)
{
  int         w = s->depth.width, h = s->depth.height, width = w, height = h;
  CeldColours one = { w, h, 0, NULL };

  celd_stereo_size (format, &width, &height);
  if (!cli_colours_new (width, height, &pair->joined))
    return false;
  one.stride = pair->joined.stride;
  one.data   = pair->joined.data;
  pair->view[0] = pair->view[1] = one;
  if (width > w)
    pair->view[format == CELD_STEREO_SIDE_BY_SIDE].data += 4 * w;
  else if (height > h)
    pair->view[1].data += 4 * pair->joined.stride * (size_t) h;
  else if (cli_colours_new (w, h, &pair->view[1]))
    pair->right = pair->view[1].data;
  else
    return false;
  return true;
}

static bool
draw_pair (const CliScene *s, CeldColours view[2])
{
  CeldStatus status = CELD_OK;

  for (int i = 0; i < 2 && status == CELD_OK; i++)
    {
      cli_run_stage (s->run, i ? "right" : "left");
      status = celd_scene_view (s->scene, celd_camera_eye (i ? 1 : -1), s->settings, &s->run->host, &view[i]);
    }
  if (status == CELD_OK && s->settings->floating_window)
    status = celd_stereo_window (&s->depth, s->settings, &view[0], &view[1]);
  return cli_run_finish (s->run, status);
}

/* Paints one of the two views for celd_io_write_frames. */
static bool
paint_view (void *host, size_t frame, float *rgba)
{
  const CeldColours *view = (const CeldColours *) host + frame;

  for (int y = 0; y < view->height; y++)
    memcpy (rgba + 4 * (size_t) y * (size_t) view->width, view->data + 4 * (size_t) y * view->stride,
            4 * sizeof *rgba * (size_t) view->width);
  return true;
}

static bool
write_both (const char *path, CeldColours view[2])
{
  CeldIoFrames frames = { view[0].width, view[0].height, 2, 1, 0, paint_view, view };
  CeldIoError  error;

  return celd_io_write_frames (path, &frames, &error) || cli_error ("%s", error.text);
}

static bool
write_joined (const CliOptions *options, ViewPair *pair)
{
  if (celd_io_frames_kind (options->stereo) == CELD_IO_MPO)
    return write_both (options->stereo, pair->view);
  return (!pair->right || cli_check (celd_stereo_join (&pair->view[0], &pair->view[1], options->settings.stereo,
                                                       &pair->joined))) &&
         cli_write_colours (options->stereo, &pair->joined);
}

static bool
is_pair_wanted (const CliOptions *options)
{
  return options->left || options->right || options->stereo;
}

/* Frees the scene if nothing else is made of it, because writing takes memory. */
static bool
write_pair (const CliOptions *options, CliScene *s)
{
  ViewPair pair = { 0 };
  bool     good = pair_new (s, options->settings.stereo, &pair) && draw_pair (s, pair.view);

  if (!options->quilt && !options->sequence && !options->wiggle)
    cli_scene_release (s);
  good = good && (!options->left || cli_write_colours (options->left, &pair.view[0])) &&
         (!options->right || cli_write_colours (options->right, &pair.view[1])) &&
         (!options->stereo || write_joined (options, &pair));

  g_free (pair.joined.data);
  g_free (pair.right);
  return good;
}

/* ------------------------------------------------------------------ many views */

/* Views are evenly spaced from the left eye to the right eye. */
static CeldCamera
camera (const CliScene *s, int view)
{
  return celd_camera_eye (2.0 * view / (s->frames - 1) - 1);
}

/* Writes all views as tiles of one picture, for light field displays: the first at the left of the lowest row. */
static bool
write_quilt (const CliOptions *options, const CliScene *s)
{
  int         columns = MIN (options->columns, s->frames), rows = (s->frames + columns - 1) / columns;
  int         w = s->depth.width, h = s->depth.height;
  CeldColours quilt = { 0 };
  CeldStatus  status = CELD_OK;
  bool        good = (gint64) w * columns <= G_MAXUINT16 && (gint64) h * rows <= G_MAXUINT16
                       ? cli_colours_new (w * columns, h * rows, &quilt)
                       : cli_error ("The quilt would have %" G_GINT64_FORMAT " x %" G_GINT64_FORMAT " pixels, which "
                                    "is too large. Make fewer views, or scale the drawing down.",
                                    (gint64) w * columns, (gint64) h * rows);

  if (good)
    memset (quilt.data, 0, 4 * sizeof *quilt.data * quilt.stride * (size_t) quilt.height);
  cli_run_stage (s->run, "views");
  for (int i = 0; good && i < s->frames && status == CELD_OK; i++)
    {
      CeldHost    quiet = { NULL, s->run->host.each, s->run->host.data };
      size_t      first = (size_t) ((rows - 1 - i / columns) * h) * quilt.stride + (size_t) (i % columns * w);
      CeldColours tile = { w, h, quilt.stride, quilt.data + 4 * first };

      status = s->run->host.progress (s->run->host.data, (double) i / s->frames)
                 ? celd_scene_view (s->scene, camera (s, i), s->settings, &quiet, &tile) : CELD_CANCELLED;
    }
  cli_run_stage (s->run, NULL);
  good = good && cli_check (status) && cli_write_colours (options->quilt, &quilt);
  g_free (quilt.data);
  return good;
}

bool
cli_views_wanted (const CliOptions *options)
{
  return is_pair_wanted (options) || options->quilt || options->sequence;
}

char *
cli_views_stages (const CliOptions *o)
{
  int many = (o->quilt ? o->views : 0) + (o->sequence ? o->views : 0) + (o->wiggle ? o->frames : 0);

  return g_strdup_printf ("%s views*%d", is_pair_wanted (o) ? " left right" : "", many);
}

bool
cli_views_write (const CliOptions *options, CliScene *s)
{
  s->frames = options->views;
  return (!is_pair_wanted (options) || write_pair (options, s)) && (!options->quilt || write_quilt (options, s)) &&
         (!options->sequence || cli_scene_write (options->sequence, s, camera, options->views, options));
}

/* ------------------------------------------------------------------ the command */

/* Prints what strains the eyes. */
static void
say_comfort (const CliScene *s)
{
  CeldComfort comfort;
  char        text[1200];

  if (celd_stereo_comfort (&s->depth, s->settings, &comfort) != CELD_OK)
    return;
  celd_comfort_text (&comfort, s->settings, cli_in_language, text, sizeof text);
  for (char *line = strtok (text, "\n"); line; line = strtok (NULL, "\n"))
    cli_say ("%s", line);
}

static int
run_stereo (const CliOptions *options)
{
  CliScene s;
  CliRun   run;
  int      code = CLI_FAILED;
  char    *views = cli_views_stages (options);
  char    *stages = g_strconcat ("reading labels order depth layers scene", views, NULL);

  cli_run_begin (&run, options, stages);
  if (cli_scene_new (options, &run, &s))
    {
      if (cli_views_write (options, &s))
        code = cli_scene_finish (options, "stereo", &s);
      if (code != CLI_FAILED && !options->quiet)
        say_comfort (&s);
    }
  cli_scene_clear (&s);
  cli_run_end (&run);
  g_free (views);
  g_free (stages);
  return code;
}

const CliCommand cli_stereo_command = {
  .name     = "stereo",
  .step     = CLI_STEREO,
  .input    = "DRAWING|LAYERED",
  .summary  = "Makes a stereo picture of a drawing, from its layers and their depth.",
  .examples = "  celdepth stereo bee.png --scribbles strokes.png --arrows arrows.png --joined glasses.png \\\n"
              "      --stereo dubois\n"
              "  celdepth stereo bee.png --scribbles strokes.png --colours art.png --left left.png \\\n"
              "      --right right.png --disparity 0.03\n"
              "  celdepth stereo page.psd --joined page.mpo\n"
              "  celdepth stereo page.psd --views 45 --columns 5 --quilt page_qs5x9a0.75.png",
  .settings = CLI_SETTINGS_OF_LABELS CLI_SETTINGS_OF_SCENES
              " stereo disparity convergence floating-window screen-width",
  .output   = "joined",
  .run      = run_stereo,
};
