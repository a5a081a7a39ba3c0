/* The route of a session, from buffers to buffers.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "pipeline.h"

#include <string.h>

#include "buffers.h"
#include "problems.h"

struct CeldPipeline
{
  CeldSession     *session;
  CeldSettings     settings;
  int              width, height;
  CeldColours      art;               /* the drawing in linear light */
  CeldColours      lit, enhanced;     /* data NULL: not made */
  const CeldOrder *order;             /* of the session; NULL: not made */
};

static const char *const layer_names[CELD_N_LAYERS] = {
  [CELD_LAYER_DRAWING]  = "drawing",  [CELD_LAYER_SCRIBBLES]   = "scribbles",   [CELD_LAYER_ARROWS] = "arrows",
  [CELD_LAYER_CONTOURS] = "contours", [CELD_LAYER_CORRECTIONS] = "corrections", [CELD_LAYER_HIDDEN] = "hidden",
};

G_DEFINE_QUARK (celd-pipeline-error, celd_pipeline_error)

/* ------------------------------------------------------------------ errors and memory */

static gboolean
fail (GError **error, const char *format, ...)
{
  va_list arguments;

  va_start (arguments, format);
  if (error)
    *error = g_error_new_valist (CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED, format, arguments);
  va_end (arguments);
  return FALSE;
}

static gboolean
try (CeldStatus status, GError **error)
{
  if (status != CELD_OK)
    g_set_error_literal (error, CELD_PIPELINE_ERROR,
                         status == CELD_CANCELLED ? CELD_PIPELINE_CANCELLED : CELD_PIPELINE_FAILED,
                         celd_status_text (status));
  return status == CELD_OK;
}

/* Memory for so many components a pixel, `size` bytes each; NULL if there is none. */
static gpointer
new_picture (const CeldPipeline *p, gsize components, gsize size)
{
  return g_try_malloc_n ((gsize) p->width * (gsize) p->height, components * size);
}

static CeldPlane
new_plane (const CeldPipeline *p)
{
  return (CeldPlane) { p->width, p->height, (size_t) p->width, new_picture (p, 1, sizeof (float)) };
}

static CeldPaint
new_paint (const CeldPipeline *p)
{
  return (CeldPaint) { p->width, p->height, (size_t) p->width, new_picture (p, 4, 1) };
}

static CeldColours
new_colours (const CeldPipeline *p)
{
  return (CeldColours) { p->width, p->height, (size_t) p->width, new_picture (p, 4, sizeof (float)) };
}

/* ------------------------------------------------------------------ input */

/* The image in coordinates of the layer's buffer. */
static GeglRectangle
image_rectangle (const CeldPipeline *p, const CeldPipelineLayer *layer)
{
  return (GeglRectangle) { -layer->x, -layer->y, p->width, p->height };
}

static gboolean
check_input (const CeldPipelineInput *input, GError **error)
{
  if (input->width < 1 || input->height < 1 || input->width > CELD_MAX_SIDE || input->height > CELD_MAX_SIDE)
    return fail (error, "The image has %d x %d pixels; the limit is %d pixels a side. Scale it down first.",
                 input->width, input->height, CELD_MAX_SIDE);
  if (!input->layer[CELD_LAYER_DRAWING].buffer)
    return fail (error, "There is no drawing. Choose its layer.");
  for (int role = 0; role < CELD_N_LAYERS; role++)
    {
      const CeldPipelineLayer *layer = &input->layer[role];
      const GeglRectangle     *r = layer->buffer ? gegl_buffer_get_extent (layer->buffer) : NULL;

      if (r && !gegl_rectangle_intersect (NULL, r, GEGL_RECTANGLE (-layer->x, -layer->y, input->width, input->height)))
        return fail (error, "The layer with the %s lies outside the image. Move it over the image.", layer_names[role]);
      for (int other = 0; r && other < role; other++)
        if (layer->buffer == input->layer[other].buffer)
          return fail (error, "The same layer is chosen as %s and as %s. Give each a layer of its own.",
                       layer_names[other], layer_names[role]);
    }
  return TRUE;
}

static CeldStatus
set_drawing (CeldPipeline *p, const CeldPipelineLayer *layer)
{
  GeglRectangle rect = image_rectangle (p, layer);
  gboolean      alpha = celd_buffer_has_alpha (layer->buffer);
  CeldHost      host = { NULL, celd_gegl_each, NULL };
  CeldDrawing   drawing = { .luma = new_plane (p) };
  CeldStatus    status = CELD_NO_MEMORY;

  if (alpha)
    drawing.alpha = new_plane (p);
  p->art = new_colours (p);
  if (drawing.luma.data && (!alpha || drawing.alpha.data) && p->art.data)
    status = celd_buffer_read_drawing (layer->buffer, &rect, p->settings.ink, &host, &drawing);
  if (status == CELD_OK)
    {
      celd_buffer_read_colours (layer->buffer, &rect, &p->art);
      status = celd_session_set_drawing (p->session, &drawing);
    }
  g_free (drawing.luma.data);
  g_free (drawing.alpha.data);
  return status;
}

static CeldStatus
set_layer (CeldPipeline *p, const CeldPipelineLayer *layer,
           CeldStatus (*set) (CeldSession *session, const CeldPaint *paint))
{
  GeglRectangle rect = image_rectangle (p, layer);
  CeldPaint     paint = new_paint (p);
  CeldStatus    status = CELD_NO_MEMORY;

  if (paint.data)
    {
      celd_buffer_read_paint (layer->buffer, &rect, &paint);
      status = set (p->session, &paint);
    }
  g_free (paint.data);
  return status;
}

/* With `flats` a coloured drawing has its regions itself. */
static CeldStatus
set_layers (CeldPipeline *p, const CeldPipelineInput *input)
{
  static CeldStatus (*const set[CELD_N_LAYERS]) (CeldSession *session, const CeldPaint *paint) = {
    [CELD_LAYER_SCRIBBLES]   = celd_session_set_scribbles,   [CELD_LAYER_ARROWS] = celd_session_set_arrows,
    [CELD_LAYER_CONTOURS]    = celd_session_set_contours,
    [CELD_LAYER_CORRECTIONS] = celd_session_set_corrections, [CELD_LAYER_HIDDEN] = celd_session_set_hidden,
  };
  CeldStatus status = set_drawing (p, &input->layer[CELD_LAYER_DRAWING]);

  for (int role = CELD_LAYER_SCRIBBLES; role < CELD_N_LAYERS && status == CELD_OK; role++)
    if (input->layer[role].buffer)
      status = set_layer (p, &input->layer[role], set[role]);
    else if (role == CELD_LAYER_SCRIBBLES && p->settings.flats)
      status = set_layer (p, &input->layer[CELD_LAYER_DRAWING], set[role]);
  return status;
}

static gboolean
set_relations (CeldPipeline *p, const char *relations, GError **error)
{
  CeldTextError place = { 0 };
  CeldStatus    status = celd_session_set_relations (p->session, relations, &place);

  if (status != CELD_BAD_RELATION)
    return try (status, error);
  return fail (error, "The relations cannot be read: line %d, column %d has %s where %s was expected. An example of a "
               "relation is: 120,80 > 300,95", place.line, place.column, place.found, place.expected);
}

static gboolean
check_lines (CeldPipeline *p, GError **error)
{
  CeldHost  host = { NULL, celd_gegl_each, NULL };
  CeldPlane ink;

  if (p->settings.flats)
    return TRUE;
  return try (celd_session_ink (p->session, &host, &ink, NULL), error) &&
         (celd_ink_has_lines (&ink) ||
          fail (error, "The layer with the drawing has no lines: it is blank, or its lines are too faint. Choose "
                "another layer, or another setting of 'Ink'."));
}

CeldPipeline *
celd_pipeline_new (const CeldPipelineInput *input, GError **error)
{
  CeldSettings  usual = celd_settings ();
  CeldPipeline *p;

  if (!check_input (input, error))
    return NULL;
  p = g_new0 (CeldPipeline, 1);
  p->session  = celd_session_new ();
  p->settings = input->settings;
  p->width    = input->width;
  p->height   = input->height;
  p->settings.encoding   = usual.encoding;
  p->settings.near_level = usual.near_level;
  p->settings.far_level  = usual.far_level;
  if (try (p->session ? CELD_OK : CELD_NO_MEMORY, error) &&
      try (celd_session_set_settings (p->session, &p->settings), error) &&
      try (set_layers (p, input), error) &&
      set_relations (p, input->relations, error) &&
      check_lines (p, error))
    return p;
  celd_pipeline_free (p);
  return NULL;
}

void
celd_pipeline_free (CeldPipeline *p)
{
  if (!p)
    return;
  celd_session_free (p->session);
  g_free (p->art.data);
  g_free (p->lit.data);
  g_free (p->enhanced.data);
  g_free (p);
}

/* ------------------------------------------------------------------ making pictures */

static CeldStatus
make_labels (CeldPipeline *p, const CeldHost *host)
{
  CeldLabels labels;

  return celd_session_labels (p->session, host, &labels, NULL);
}

static CeldStatus
make_suggestions (CeldPipeline *p, const CeldHost *host)
{
  const CeldRelations *suggestions;

  return celd_session_suggestions (p->session, host, &suggestions);
}

static CeldStatus
make_order (CeldPipeline *p, const CeldHost *host)
{
  return celd_session_order (p->session, host, &p->order);
}

static CeldStatus
make_levels (CeldPipeline *p, const CeldHost *host)
{
  CeldPlane levels;

  return celd_session_levels (p->session, host, &levels, NULL);
}

static CeldStatus
make_depth (CeldPipeline *p, const CeldHost *host)
{
  CeldPlane depth;

  return celd_session_depth (p->session, host, &depth, NULL);
}

static CeldStatus
make_normals (CeldPipeline *p, const CeldHost *host)
{
  CeldVectors normals;

  return celd_session_normals (p->session, host, &normals, NULL);
}

static CeldStatus
make_shading (CeldPipeline *p, const CeldHost *host)
{
  CeldPlane shading;

  return celd_session_shading (p->session, host, &shading, NULL);
}

/* A copy of the art. */
static CeldStatus
copy_art (const CeldPipeline *p, CeldColours *copy)
{
  g_free (copy->data);
  *copy = new_colours (p);
  if (!copy->data)
    return CELD_NO_MEMORY;
  memcpy (copy->data, p->art.data, 4 * sizeof (float) * (gsize) p->width * (gsize) p->height);
  return CELD_OK;
}

static CeldStatus
make_lit (CeldPipeline *p, const CeldHost *host)
{
  CeldPlane   ink, levels, gloss = new_plane (p);
  CeldColours tone = new_colours (p);
  CeldVectors normals;
  CeldStatus  status = tone.data && gloss.data ? copy_art (p, &p->lit) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_session_ink (p->session, NULL, &ink, NULL);
  if (status == CELD_OK)
    status = celd_session_levels (p->session, NULL, &levels, NULL);
  if (status == CELD_OK)
    status = celd_session_normals (p->session, NULL, &normals, NULL);
  if (status == CELD_OK)
    status = celd_light (&normals, &ink, &levels, NULL, &p->settings, host, &tone, &gloss);
  if (status == CELD_OK)
    status = celd_light_colours (&tone, &gloss, &p->lit);
  g_free (tone.data);
  g_free (gloss.data);
  return status;
}

static CeldStatus
make_enhanced (CeldPipeline *p, const CeldHost *host)
{
  CeldPlane  levels, change = new_plane (p);
  CeldStatus status = change.data ? copy_art (p, &p->enhanced) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_session_levels (p->session, NULL, &levels, NULL);
  if (status == CELD_OK)
    status = celd_enhance (&levels, &p->settings, host, &change);
  if (status == CELD_OK)
    status = celd_enhance_colours (&change, &p->enhanced);
  g_free (change.data);
  return status;
}

#define OF(picture) (1u << CELD_PICTURE_##picture)
#define NEED_LIGHT (OF (NORMALS) | OF (SHADING) | OF (LIT))
#define NEED_LEVELS (OF (LEVELS) | OF (DEPTH) | OF (ENHANCED) | NEED_LIGHT)

/* The steps in their order, the pictures that need each, and its part of the time (measured, in percent of all). */
static const struct
{
  const char *name;
  guint       pictures;
  double      time;
  CeldStatus (*make) (CeldPipeline *p, const CeldHost *host);
} steps[] = {
  { "Finding the regions",   ~0u,              45, make_labels },
  { "Suggesting an order",   OF (SUGGESTIONS),  5, make_suggestions },
  { "Ordering the regions",  NEED_LEVELS,       1, make_order },
  { "Giving lines to parts", NEED_LEVELS,      10, make_levels },
  { "Making depth smooth",   OF (DEPTH),       15, make_depth },
  { "Rounding the parts",    NEED_LIGHT,       20, make_normals },
  { "Lighting the parts",    OF (SHADING),      2, make_shading },
  { "Lighting the drawing",  OF (LIT),          4, make_lit },
  { "Casting shadows",       OF (ENHANCED),     3, make_enhanced },
};

/* Progress of one step as that of all. */
typedef struct { CeldPipelineProgress progress; gpointer data; const char *name; double from, part; } Report;

static bool
report (void *data, double done)
{
  const Report *r = data;

  return !r->progress || r->progress (r->data, MIN (r->from + r->part * done, 1), r->name);
}

gboolean
celd_pipeline_make (CeldPipeline *p, guint wanted, CeldPipelineProgress progress, gpointer data, GError **error)
{
  Report     r = { .progress = progress, .data = data };
  CeldHost   host = { report, celd_gegl_each, &r };
  double     all = 0;
  CeldStatus status = CELD_OK;

  for (gsize i = 0; i < G_N_ELEMENTS (steps); i++)
    if (wanted & steps[i].pictures)
      all += steps[i].time;
  for (gsize i = 0; i < G_N_ELEMENTS (steps) && status == CELD_OK; i++)
    if (wanted & steps[i].pictures)
      {
        r.name = steps[i].name;
        r.part = steps[i].time / all;
        status = report (&r, 0) ? steps[i].make (p, &host) : CELD_CANCELLED;
        r.from += r.part;
      }
  return try (status, error);
}

/* ------------------------------------------------------------------ writing pictures */

static void
put (const CeldPipeline *p, GeglBuffer *buffer, const Babl *format, const void *pixels, gsize pixel_size)
{
  gegl_buffer_set (buffer, GEGL_RECTANGLE (0, 0, p->width, p->height), 0, format, pixels, p->width * (int) pixel_size);
}

static CeldStatus
write_plane (CeldPipeline *p, CeldStatus (*ask) (CeldSession *, const CeldHost *, CeldPlane *, CeldRect *),
             GeglBuffer *buffer)
{
  CeldPlane  plane;
  CeldStatus status = ask (p->session, NULL, &plane, NULL);

  if (status == CELD_OK)
    put (p, buffer, babl_format ("Y float"), plane.data, sizeof (float));
  return status;
}

static CeldStatus
write_paint (CeldPipeline *p, CeldStatus (*paint_on) (CeldPipeline *p, CeldPaint *paint), GeglBuffer *buffer)
{
  CeldPaint  paint = new_paint (p);
  CeldStatus status = paint.data ? paint_on (p, &paint) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    put (p, buffer, babl_format ("R'G'B'A u8"), paint.data, 4);
  g_free (paint.data);
  return status;
}

static CeldStatus
paint_regions (CeldPipeline *p, CeldPaint *paint)
{
  CeldLabels labels;
  CeldStatus status = celd_session_labels (p->session, NULL, &labels, NULL);

  return status == CELD_OK ? celd_labels_paint (&labels, celd_session_palette (p->session), paint) : status;
}

static CeldStatus
paint_suggestions (CeldPipeline *p, CeldPaint *paint)
{
  return celd_session_paint_suggestions (p->session, NULL, paint);
}

/* In the space of the buffer, so that its pixels are these numbers. */
static CeldStatus
write_normals (CeldPipeline *p, GeglBuffer *buffer)
{
  const Babl *format = gegl_buffer_get_format (buffer);
  gboolean    linear = babl_get_model_flags (babl_format_get_model (format)) & BABL_MODEL_FLAG_LINEAR;
  float      *stored = new_picture (p, 3, sizeof (float));
  CeldVectors normals;
  CeldStatus  status = stored ? celd_session_normals (p->session, NULL, &normals, NULL) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      celd_normals_store (&normals, FALSE, stored);
      put (p, buffer, babl_format_with_space (linear ? "RGB float" : "R'G'B' float", format), stored,
           3 * sizeof (float));
    }
  g_free (stored);
  return status;
}

static CeldStatus
write_art (CeldPipeline *p, const CeldColours *art, GeglBuffer *buffer)
{
  if (!art->data)
    return CELD_BAD_VALUE;
  put (p, buffer, babl_format ("RGBA float"), art->data, 4 * sizeof (float));
  return CELD_OK;
}

static CeldStatus
write_picture (CeldPipeline *p, CeldPicture picture, GeglBuffer *buffer)
{
  switch (picture)
    {
    case CELD_PICTURE_REGIONS:     return write_paint (p, paint_regions, buffer);
    case CELD_PICTURE_LEVELS:      return write_plane (p, celd_session_levels, buffer);
    case CELD_PICTURE_DEPTH:       return write_plane (p, celd_session_depth, buffer);
    case CELD_PICTURE_NORMALS:     return write_normals (p, buffer);
    case CELD_PICTURE_SHADING:     return write_plane (p, celd_session_shading, buffer);
    case CELD_PICTURE_LIT:         return write_art (p, &p->lit, buffer);
    case CELD_PICTURE_ENHANCED:    return write_art (p, &p->enhanced, buffer);
    case CELD_PICTURE_SUGGESTIONS: return write_paint (p, paint_suggestions, buffer);
    case CELD_N_PICTURES:          break;
    }
  return CELD_BAD_VALUE;
}

gboolean
celd_pipeline_write (CeldPipeline *p, CeldPicture picture, GeglBuffer *buffer, GError **error)
{
  return try (write_picture (p, picture, buffer), error);
}

char *
celd_pipeline_problems (CeldPipeline *p)
{
  GString *message = g_string_new (NULL);

  celd_problems_append (message, celd_session_problems (p->session), celd_session_palette (p->session),
                        celd_session_relations (p->session), p->order);
  return g_string_free (message, message->len == 0);
}
