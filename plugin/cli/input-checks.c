/* Input that is something else than it was given for: a picture given twice, drawing and scribbles exchanged, a drawing
 * in place of a layer, a page without lines.  Each is refused, with a message that says what to do.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <glib/gi18n.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BLANK_STEP 32 /* of 255: what differs by less in a blank layer is grain, or loss in a file; chosen */

/* ------------------------------------------------------------------ the same file twice */

static bool
has_layer (const char *path, const char *role)
{
  CeldIoError error;
  CeldIoFile *file = celd_io_open (path, &error);
  bool        found = file && cli_find_part (file, role) != CELD_NO_INDEX;

  celd_io_close (file);
  return found;
}

bool
cli_check_different_files (const CliOptions *options)
{
  bool of_regions = options->step == CLI_ORDER, of_levels = options->drawing && !of_regions;

  const struct { const char *name, *role, *path; } layer[] = {
    { "the drawing", "drawing", of_regions || of_levels ? options->drawing : options->input },
    { of_regions ? "the regions" : "the levels", "levels", of_regions || of_levels ? options->input : NULL },
    { "--scribbles", "scribbles", options->scribbles }, { "--arrows", "arrows", options->arrows },
    { "--contours", "contours", options->contours }, { "--corrections", "corrections", options->corrections },
    { "--hidden", "hidden", options->hidden }, { "--hints", "hints", options->hints },
    { "--matcap", "matcap", options->matcap }, { "--handles-layer", "handles", options->handles_layer },
    { "--source-levels", "levels", options->source_levels }, { "the second drawing", "drawing", options->target },
  };

  for (size_t i = 0; i < G_N_ELEMENTS (layer); i++)
    for (size_t k = 0; k < i; k++)
      if (layer[i].path && layer[k].path && cli_same_file (layer[i].path, layer[k].path) &&
          !(layer[i].path == options->target && !k) /* the first drawing: nothing moves */ &&
          !(options->settings.flats && layer[i].path == options->scribbles) && !has_layer (layer[i].path, layer[i].role))
        return cli_error ("\"%s\" is given as %s and as %s: give each its own file.", layer[i].path, layer[k].name,
                          layer[i].name);
  return true;
}

/* ------------------------------------------------------------------ drawing and scribbles mixed up */

CeldPaint
cli_paint_of (const CeldColours *picture)
{
  size_t    n = 4 * picture->stride * (size_t) picture->height;
  CeldPaint paint = { picture->width, picture->height, picture->stride, g_try_malloc (n) };

  for (size_t i = 0; paint.data && i < n; i++)
    paint.data[i] = (uint8_t) (255 * CLAMP (picture->data[i], 0, 1) + 0.5f);
  return paint;
}

/* Compares the scribbles with the drawing. */
static bool
find_mix_up (const CliOptions *options, CliLayers *layers, CeldMixUp *mix_up)
{
  CeldColours picture = { 0 };
  CeldPaint   paint = { 0 };
  bool        good = cli_art_read (options, options->input, NULL, false, layers, &picture);

  if (good)
    {
      paint = cli_paint_of (&picture);
      good = cli_check (paint.data ? celd_mix_up (&paint, &layers->scribbles, mix_up) : CELD_NO_MEMORY);
    }
  g_free (picture.data);
  g_free (paint.data);
  return good;
}

/* Refuses a drawing that is nothing but the scribbles. */
static bool
check_not_scribbles (const CliOptions *options, const CliLayers *layers)
{
  bool flattened = false;

  return (!layers->colours.data ||
          cli_check (celd_is_flattened (&layers->colours, &layers->scribbles, &flattened))) &&
         (!flattened || cli_error (_ ("\"%s\" has the strokes of the scribbles \"%s\", and no lines: give the lines "
                                      "as the drawing."), options->input, options->scribbles));
}

/* A small figure in clear colours looks like strokes, too, but has lines that part the page. */
bool
cli_find_scribbles (const CliLayers *layers, bool *are)
{
  bool drawn = true, coloured = layers->colours.data && celd_is_coloured_strokes (&layers->colours);
  bool good = !coloured || cli_check (celd_may_be_drawing (&layers->colours, &drawn));

  *are = coloured && !drawn;
  return good;
}

bool
cli_check_alike (const CliOptions *options, const CliLayers *first, const CliLayers *second)
{
  bool one, other;

  if (!cli_find_scribbles (first, &one) || !cli_find_scribbles (second, &other))
    return false;
  return one == other || cli_error (_ ("\"%s\" looks like scribbles and \"%s\" like a drawing: give two drawings."),
                                    one ? options->input : options->target, one ? options->target : options->input);
}

bool
cli_check_not_mixed_up (const CliOptions *options, CliLayers *layers)
{
  CeldMixUp mix_up = CELD_LAYERS_APART;
  bool      drawn = false;

  if (!layers->scribbles.data || !options->scribbles || options->settings.flats)
    return true;
  if (!cli_check (celd_may_be_drawing (&layers->scribbles, &drawn)))
    return false;
  if (!drawn)
    return check_not_scribbles (options, layers);
  if (!find_mix_up (options, layers, &mix_up))
    return false;
  if (mix_up == CELD_LAYERS_DRAWN)
    return cli_error (_ ("\"%s\" looks like a drawing: scribbles are strokes in clear colours, one over each part."),
                      options->scribbles);
  if (mix_up == CELD_LAYERS_SAME)
    return cli_error (_ ("\"%s\" is the same picture as the drawing \"%s\": give a picture of the strokes alone as "
                         "scribbles, or use --flats if each part has a flat colour of its own."),
                      options->scribbles, options->input);
  return mix_up != CELD_LAYERS_EXCHANGED ||
         cli_error (_ ("\"%s\" looks like scribbles and \"%s\" like a drawing: exchange them, or scribble in clear "
                       "colours."), options->input, options->scribbles);
}

/* ------------------------------------------------------------------ a drawing in place of a layer */

static bool
check_scribbles (const CliOptions *options, const CliLayers *layers, const CeldPlane *ink)
{
  const char    *path = options->scribbles ? options->scribbles : options->input;
  CeldLayerLines lines;

  if (!layers->scribbles.data)
    return true;
  if (!cli_check (celd_layer_lines (&layers->scribbles, ink, &lines)))
    return false;
  if (lines == CELD_LAYER_OF_LINES)
    return cli_error (_ ("\"%s\" has the lines of the drawing, and no colours: give a picture of the strokes alone as "
                         "scribbles."), path);
  if (lines == CELD_LAYER_COLOURED && !options->quiet)
    cli_say (_ ("\"%s\" has the lines of the drawing, too: give the strokes alone as scribbles, or use --flats if each "
                "part has a flat colour of its own."), path);
  return true;
}

/* A layer of strokes; data NULL: there is none. */
static bool
check_layer (const char *path, const CeldPaint *paint, const CeldPlane *ink)
{
  CeldLayerLines lines = CELD_LAYER_WITHOUT_LINES;

  return (!paint->data || cli_check (celd_layer_lines (paint, ink, &lines))) &&
         (lines == CELD_LAYER_WITHOUT_LINES ||
          cli_error (_ ("\"%s\" has the lines of the drawing: give a layer with the strokes alone."), path));
}

bool
cli_check_no_drawings (const CliOptions *options, const CliLayers *layers, const CeldPlane *ink)
{
  const struct { const char *path; const CeldPaint *paint; } layer[] = {
    { options->arrows, &layers->arrows }, { options->corrections, &layers->corrections },
    { options->hidden, &layers->hidden },
  };
  bool good = check_scribbles (options, layers, ink);

  for (size_t i = 0; good && i < G_N_ELEMENTS (layer); i++)
    good = check_layer (layer[i].path ? layer[i].path : options->input, layer[i].paint, ink);
  return good;
}

/* ------------------------------------------------------------------ contours in vain */

/* Whether a layer is the same colour all over, or nearly so. */
static bool
is_blank (const CeldPaint *paint)
{
  for (size_t i = 0; i < 4 * paint->stride * (size_t) paint->height; i++)
    if (abs (paint->data[i] - paint->data[i % 4]) >= BLANK_STEP)
      return false;
  return true;
}

/* Whether contours change a drawing; the copy has room for it. */
static bool
bake (const CliLayers *layers, CeldInkMode mode, CeldDrawing *copy, bool *changed)
{
  const CeldDrawing *drawing = &layers->drawing;
  size_t             n = drawing->luma.stride * (size_t) drawing->luma.height * sizeof (float);
  bool               good = cli_check (celd_contours_bake (drawing, &layers->contours, CELD_FOR_SEGMENTATION, mode, NULL,
                                                           copy));

  *changed = good && (memcmp (copy->luma.data, drawing->luma.data, n) != 0 ||
                      (drawing->alpha.data && memcmp (copy->alpha.data, drawing->alpha.data, n) != 0));
  return good;
}

/* Before contours are drawn into the drawing, which may hide its lines.  A page that has none can get some by them. */
static bool
check_contours (const char *path, const CliLayers *layers, CeldInkMode mode)
{
  CeldPlane ink = { 0 };
  bool      good = cli_plane_new (layers->width, layers->height, &ink) &&
                   cli_check (celd_ink (&layers->drawing, mode, NULL, &ink)) &&
                   (!celd_ink_has_lines (&ink) || check_layer (path, &layers->contours, &ink));

  g_free (ink.data);
  return good;
}

static bool
warn_if_vain (const char *path, const CliLayers *layers, CeldInkMode mode)
{
  int         width = layers->drawing.luma.width, height = layers->drawing.luma.height;
  CeldDrawing copy = { 0 };
  bool        changed = false, good;

  if (is_blank (&layers->contours))
    return true;
  good = cli_plane_new (width, height, &copy.luma) &&
         (!layers->drawing.alpha.data || cli_plane_new (width, height, &copy.alpha)) && bake (layers, mode, &copy, &changed);
  if (good && !changed)
    cli_say (_ ("The contours \"%s\" change nothing: draw them in red or blue, or in green over ink."), path);
  g_free (copy.luma.data);
  g_free (copy.alpha.data);
  return good;
}

void
cli_warn_of_blank_scribbles (const CliOptions *options, const CliLayers *layers)
{
  if (options->scribbles && layers->scribbles.data && layers->arrows.data && is_blank (&layers->scribbles) &&
      !is_blank (&layers->arrows))
    cli_say ("The scribbles \"%s\" are blank, so that only parts with arrows are regions: scribble over the parts, or "
             "leave out --scribbles.", options->scribbles);
}

bool
cli_check_contours (const char *path, const CliOptions *options, const CliLayers *layers)
{
  return (options->settings.flats || check_contours (path, layers, options->settings.ink)) &&
         (options->quiet || warn_if_vain (path, layers, options->settings.ink));
}

/* ------------------------------------------------------------------ art that shows nothing */

/* The picture in encoded bytes; free its data with g_free. */
static bool
encoded_paint (const CeldColours *art, bool linear, CeldPaint *paint)
{
  CeldColours encoded = { 0 };
  bool        good = !linear || cli_colours_new (art->width, art->height, &encoded);

  for (int y = 0; linear && good && y < art->height; y++)
    cli_encode (art->data + 4 * art->stride * (size_t) y, art->width, encoded.data + 4 * encoded.stride * (size_t) y);
  if (good)
    *paint = cli_paint_of (linear ? &encoded : art);
  g_free (encoded.data);
  return good && cli_check (paint->data ? CELD_OK : CELD_NO_MEMORY);
}

bool
cli_warn_of_art (const char *path, const CeldColours *art, bool linear)
{
  CeldPaint paint = { 0 };
  bool      good = encoded_paint (art, linear, &paint);

  if (good && is_blank (&paint))
    cli_say ("\"%s\" is blank, or of one colour: give the drawing in colours, with its lines or without.", path);
  else if (good && celd_looks_like_levels (&paint))
    cli_say ("\"%s\" looks like levels or depth: give the drawing in colours, with its lines or without.", path);
  g_free (paint.data);
  return good;
}

bool
cli_warn_of_matcap (const char *path, const CeldColours *matcap)
{
  CeldPaint paint = { 0 };
  bool      good = encoded_paint (matcap, true, &paint);

  if (good && is_blank (&paint))
    cli_say ("\"%s\" is blank, or of one colour, so that nothing is shaded: give a picture of a lit ball as --matcap.",
             path);
  else if (good && matcap->width != matcap->height)
    cli_say ("\"%s\" has %d x %d pixels, but a matcap is a picture of a lit ball that fills a square: it is read as if "
             "it were stretched to one.", path, matcap->width, matcap->height);
  g_free (paint.data);
  return good;
}

/* ------------------------------------------------------------------ no lines */

bool
cli_check_lines (const char *path, const CeldPlane *ink)
{
  return celd_ink_has_lines (ink) ||
         cli_error (_ ("\"%s\" has no lines: it is blank, or its lines are too faint (--ink says what they are)."),
                    path);
}

/* ------------------------------------------------------------------ values that are no numbers */

/* A division by zero leaves such values in float pictures. */
static bool
refuse_value (const char *path, int x, int y)
{
  return cli_error ("\"%s\" has a pixel at %d, %d whose value is infinite or no number: paint over such pixels, or write "
                    "the file without them.", path, x, y);
}

bool
cli_check_numbers (const char *path, const CeldPlane *values)
{
  for (int y = 0; y < values->height; y++)
    for (int x = 0; x < values->width; x++)
      if (!isfinite (values->data[(size_t) y * values->stride + (size_t) x]))
        return refuse_value (path, x, y);
  return true;
}

bool
cli_check_colours (const char *path, int width, int height, const float *rgba)
{
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++, rgba += 4)
      if (!isfinite (rgba[3]) ||
          (rgba[3] > 0 && !(isfinite (rgba[0]) && isfinite (rgba[1]) && isfinite (rgba[2]))))
        return refuse_value (path, x, y);
  return true;
}
