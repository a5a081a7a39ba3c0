/* Pictures given as regions, levels or depth that are something else: colours, photographs, drawings, blank pages.
 * Each is refused, or warned about where it may be meant, with a message that says what to do.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <math.h>
#include <stdlib.h>

#define EDGE       48   /* of 255: by how much colours or alpha differ at an edge; chosen */
#define FEW        0.4  /* of the steps of levels at lines: the drawing is another one (measured: 0.34; own 0.85) */
#define HARDLY_ANY 0.15 /* the same at strokes of scribbles (measured: 0.05) */

bool
cli_check_grey (const char *path)
{
  CeldPaint   picture = { 0 };
  CeldIoError error;
  CeldIoFile *file = cli_is_npy (path) ? NULL : celd_io_open (path, &error);
  bool        colours = file && !celd_io_part (file, 0)->grey;
  bool        good = !colours || cli_read_paint (file, 0, path, &picture);

  celd_io_close (file);
  if (good && picture.data && celd_paint_is_coloured (&picture))
    good = cli_error ("\"%s\" is coloured, but depth and levels are grey, as popup writes them with --levels or "
                      "--depth.", path);
  g_free (picture.data);
  return good;
}

bool
cli_check_regions (const char *path, const CeldLabels *regions, const CeldPalette *palette)
{
  return celd_are_labels (regions, palette) ||
         cli_error ("\"%s\" looks like a photograph: regions are flat colours, as segment writes them with "
                    "--labels.", path);
}

bool
cli_check_levels (const char *path, const CeldPlane *levels)
{
  return celd_are_levels (levels) ||
         cli_error ("\"%s\" looks like a photograph: levels have one value for each part, as popup writes them with "
                    "--levels.", path);
}

bool
cli_check_depth (const char *path, const CeldPlane *depth)
{
  return celd_are_levels (depth) ||
         cli_error ("\"%s\" looks like a photograph: depth is flat or smooth in each part, as popup writes it with "
                    "--depth.", path);
}

static bool
is_flat (const CeldPlane *levels)
{
  size_t n = (size_t) levels->width * (size_t) levels->height, i = 1;

  while (i < n && !(fabsf (levels->data[i] - levels->data[0]) > 0))
    i++;
  return i == n;
}

void
cli_warn_if_flat (const char *path, const CeldPlane *levels)
{
  if (is_flat (levels))
    cli_say ("\"%s\" has the same value everywhere, so that nothing lies in front of anything.", path);
}

/* ------------------------------------------------------------------ drawings */

bool
cli_check_not_drawn (const char *path, const CeldPlane *levels)
{
  bool are = false;

  return cli_check (celd_levels_are_drawing (levels, &are)) &&
         (!are || cli_error ("\"%s\" looks like a drawing: levels and depth have the values of parts, also where lines "
                             "are, as popup writes them with --levels and --depth.", path));
}

bool
cli_check_no_lines (const char *path, const CeldPlane *levels, const char *drawing, const CeldPlane *ink)
{
  bool have = false;

  if (!cli_check (celd_levels_have_lines (levels, ink, &have)))
    return false;
  return have ? cli_error ("\"%s\" has the lines of \"%s\": levels and depth have the values of parts, also where lines "
                           "are, as popup writes them with --levels and --depth.", path, drawing)
              : cli_check_not_drawn (path, levels);
}

bool
cli_warn_of_lines (const char *path, const CeldPlane *levels, const char *drawing, const CeldPlane *ink)
{
  bool have = false;

  if (!cli_check (celd_levels_have_lines (levels, ink, &have)))
    return false;
  if (have)
    cli_say ("\"%s\" has the lines of \"%s\", as if it were a drawing: levels and depth have the values of parts, also "
             "where lines are.", path, drawing);
  return true;
}

/* ------------------------------------------------------------------ of another page */

static bool
differ (const uint8_t *p, const uint8_t *q)
{
  int most = 0;

  for (int k = 0; k < 4; k++)
    most = MAX (most, abs (p[k] - q[k]));
  return most >= EDGE;
}

/* Whether colours or alpha change from a pixel to another one. */
static bool
is_edge (const CliLayers *layers, size_t p, size_t q)
{
  const float *alpha = layers->drawing.alpha.data;

  return layers->colours.data ? differ (layers->colours.data + 4 * p, layers->colours.data + 4 * q)
                              : alpha && 255 * fabsf (alpha[p] - alpha[q]) >= EDGE;
}

/* The lines of a drawing, and edges of its colours, since a sprite may have no outlines. */
static void
find_edges (const CliLayers *layers, const CeldPlane *ink, CeldPlane *lines)
{
  size_t width = (size_t) ink->width, n = width * (size_t) ink->height;

  for (size_t p = 0; p < n; p++)
    {
      bool right = p % width + 1 < width && is_edge (layers, p, p + 1);
      bool below = p + width < n && is_edge (layers, p, p + width);

      lines->data[p] = right || below ? 0 : ink->data[p];
    }
}

bool
cli_check_steps (const char *path, const CeldPlane *levels, const CliOptions *options, const CliLayers *layers,
                 const char *drawing, const CeldPlane *ink)
{
  CeldPlane lines = { 0 };
  double    share = 1;
  bool      scribbles = false;

  if (!cli_plane_new (ink->width, ink->height, &lines))
    return false;
  find_edges (layers, ink, &lines);
  share = celd_steps_on_lines (levels, &lines);
  g_free (lines.data);
  if (share < HARDLY_ANY && !cli_find_scribbles (layers, &scribbles))
    return false;
  if (scribbles)
    return cli_error ("\"%s\" looks like scribbles: give the line drawing.", drawing);
  if (share < FEW && !options->quiet)
    cli_say ("The parts of \"%s\" do not end at the lines of \"%s\": give both of the same page.", path,
             drawing);
  return true;
}

bool
cli_check_region_steps (const char *path, const CeldLabels *regions, const CliOptions *options, const CliLayers *layers,
                        const char *drawing, const CeldPlane *ink)
{
  CeldPlane numbers = { 0 };
  bool      good = cli_plane_new (regions->width, regions->height, &numbers);

  for (size_t i = 0; good && i < (size_t) numbers.width * (size_t) numbers.height; i++)
    numbers.data[i] = (float) regions->data[i];
  good = good && cli_check_steps (path, &numbers, options, layers, drawing, ink);
  g_free (numbers.data);
  return good;
}

/* ------------------------------------------------------------------ regions */

/* Flat colours that were filled into a drawing are regions and lines, of which something can be made. */
bool
cli_check_regions_of (const char *path, const CeldLabels *regions, const CeldPalette *palette, const char *drawing,
                      const CeldPlane *ink, bool quiet)
{
  size_t         n = (size_t) regions->width * (size_t) regions->height;
  CeldPaint      paint = { regions->width, regions->height, (size_t) regions->width, g_try_malloc (4 * n) };
  CeldLayerLines lines = CELD_LAYER_WITHOUT_LINES;
  bool           good = cli_check (paint.data ? CELD_OK : CELD_NO_MEMORY);

  good = good && cli_check (celd_labels_paint (regions, palette, &paint)) &&
         cli_check (celd_layer_lines (&paint, ink, &lines));
  g_free (paint.data);
  if (lines == CELD_LAYER_OF_LINES)
    return cli_error ("\"%s\" has the lines of \"%s\", and no colours: regions are flat colours, as segment writes "
                      "them with --labels.", path, drawing);
  if (lines == CELD_LAYER_COLOURED && !quiet)
    cli_say ("\"%s\" has the lines of \"%s\", too, which then are regions of their own: fill regions up to the middle "
             "of lines, as segment does.", path, drawing);
  return good;
}

/* Reads the first part of a file. */
static bool
read_picture (const char *path, CeldPaint *picture)
{
  CeldIoError error;
  CeldIoFile *file = celd_io_open (path, &error);
  bool        good = file ? cli_read_paint (file, 0, path, picture) : cli_error ("%s", error.text);

  celd_io_close (file);
  return good;
}

/* Whether a picture is one colour all over. */
static bool
is_one_colour (const CeldLabels *regions)
{
  size_t n = (size_t) regions->width * (size_t) regions->height, i = 1;

  while (i < n && regions->data[i] == regions->data[0])
    i++;
  return i == n;
}

/* Whether a picture is lines or strokes on white, by its brightness.  Regions that are small numbers, with a large one
 * where there is none, are like light lines on black. */
static bool
is_drawn (const CeldPaint *picture, bool *drawn)
{
  CeldPlane brightness = { 0 };
  size_t    n = (size_t) picture->width * (size_t) picture->height, light = 0;
  bool      good = cli_plane_new (picture->width, picture->height, &brightness);

  for (size_t i = 0; good && i < n; i++)
    {
      const uint8_t *p = picture->data + 4 * i;

      brightness.data[i] = 1 - (float) p[3] / 255 * (1 - (float) (p[0] + p[1] + p[2]) / 765);
      light += brightness.data[i] > 0.5f;
    }
  good = good && cli_check (celd_levels_are_drawing (&brightness, drawn));
  *drawn &= 2 * light > n;
  g_free (brightness.data);
  return good;
}

bool
cli_warn_of_regions (const char *path, const CeldLabels *regions)
{
  CeldPaint picture = { 0 };
  bool      drawn = false, strokes = false, good = true;

  if (is_one_colour (regions))
    cli_say ("\"%s\" is blank, or of one colour, so that nothing lies in front of anything.", path);
  else if (!cli_is_npy (path))
    good = read_picture (path, &picture) && is_drawn (&picture, &drawn);
  strokes = drawn && celd_is_coloured_strokes (&picture);
  /* Coloured regions may have lines between them that are left blank. */
  if (good && drawn && (strokes || !celd_paint_is_coloured (&picture)))
    cli_say ("\"%s\" looks like %s: regions are flat colours, as segment writes them with --labels.", path,
             strokes ? "scribbles" : "a drawing");
  else if (good && picture.data && celd_looks_like_levels (&picture))
    cli_say ("\"%s\" looks like levels or depth: regions are flat colours, as segment writes them with --labels.",
             path);
  g_free (picture.data);
  return good;
}

bool
cli_check_not_art (const char *path, const char *art)
{
  CeldPaint picture = { 0 }, other = { 0 };
  bool      same = cli_same_file (path, art), good = true;

  if (!same && !cli_is_npy (path))
    good = read_picture (path, &picture) && read_picture (art, &other) &&
           cli_check (celd_is_copy (&picture, &other, &same));
  if (good && same)
    good = cli_error ("\"%s\" is the same picture as \"%s\": give levels as popup writes them with --levels, and the "
                      "art with --colours.", path, art);
  g_free (picture.data);
  g_free (other.data);
  return good;
}

/* Whether the drawing is no levels, unless it is said what its lines are. */
static bool
check_parts (const CliOptions *options, const CeldColours *drawing)
{
  CeldPaint paint = cli_paint_of (drawing);
  bool      good = cli_check (paint.data ? CELD_OK : CELD_NO_MEMORY) &&
                   cli_check_parts (options->drawing, &paint, true);

  g_free (paint.data);
  return good;
}

/* Levels are grey and opaque, so that any other drawing is none. */
bool
cli_check_not_exchanged (const CliOptions *options, const CeldPlane *levels, CliLayers *layers)
{
  CeldColours picture = { 0 };
  CeldPlane   brightness = { 0 };
  bool        exchanged = false, good;

  if (layers->colours.data || layers->drawing.alpha.data)
    return true;
  good = cli_art_read (options, options->drawing, NULL, false, layers, &picture) &&
         cli_plane_new (picture.width, picture.height, &brightness);
  for (size_t i = 0; good && i < (size_t) picture.width * (size_t) picture.height; i++)
    brightness.data[i] = picture.data[4 * i];
  good = good && cli_check (celd_levels_are_exchanged (levels, &brightness, &exchanged));
  /* A blank page may be levels, of one part, but only beside a drawing: narrow parts are not enough. */
  if (good && exchanged && is_flat (&brightness))
    good = cli_check (celd_levels_are_drawing (levels, &exchanged));
  if (good && exchanged)
    good = cli_error ("\"%s\" looks like a drawing and \"%s\" like levels: exchange them.", options->input,
                      options->drawing);
  else if (good && options->settings.ink == CELD_INK_AUTO)
    good = check_parts (options, &picture);
  g_free (picture.data);
  g_free (brightness.data);
  return good;
}

/* ------------------------------------------------------------------ hints of depth */

/* Whether a picture has a pixel that can be seen. */
static bool
is_seen (const char *path, bool *seen)
{
  CeldPaint   picture = { 0 };
  CeldIoError error;
  CeldIoFile *file = cli_is_npy (path) ? NULL : celd_io_open (path, &error);
  bool        good = !file || !celd_io_part (file, 0)->alpha || cli_read_paint (file, 0, path, &picture);

  celd_io_close (file);
  *seen = !picture.data;
  for (size_t i = 0; i < (size_t) picture.width * (size_t) picture.height && !*seen; i++)
    *seen = picture.data[4 * i + 3] > 0;
  g_free (picture.data);
  return good;
}

bool
cli_check_hint (const char *path, const CeldPlane *depth, bool quiet)
{
  float least = depth->data[0], most = least;
  bool  seen = true;

  for (size_t i = 0; i < (size_t) depth->width * (size_t) depth->height; i++)
    {
      least = MIN (least, depth->data[i]);
      most  = MAX (most, depth->data[i]);
    }
  if (most > least && !is_seen (path, &seen))
    return false;
  if (!seen || !(most > least))
    return cli_error ("\"%s\" is blank, so that it says nothing about depth: give another picture, or none, as "
                      "--depth-hint.", path);
  if (!quiet && !celd_are_levels (depth))
    cli_say ("\"%s\" looks like a photograph: a hint of depth is flat or smooth in each part, nearer is brighter.",
             path);
  return true;
}
