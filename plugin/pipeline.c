/* The route of a session: reads the layers, and makes pictures.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "pipeline-parts.h"

#include <string.h>

#include "buffers.h"

G_DEFINE_QUARK (celd-pipeline-error, celd_pipeline_error)

/* ------------------------------------------------------------------ errors and memory */

gboolean
celd_pipeline_fail (GError **error, const char *format, ...)
{
  va_list arguments;

  va_start (arguments, format);
  if (error)
    *error = g_error_new_valist (CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED, format, arguments);
  va_end (arguments);
  return FALSE;
}

gboolean
celd_pipeline_try (CeldStatus status, GError **error)
{
  if (status != CELD_OK)
    g_set_error_literal (error, CELD_PIPELINE_ERROR,
                         status == CELD_CANCELLED ? CELD_PIPELINE_CANCELLED : CELD_PIPELINE_FAILED,
                         _ (celd_status_text (status)));
  return status == CELD_OK;
}

gpointer
celd_pipeline_new_picture (const CeldPipeline *p, gsize components, gsize size)
{
  return g_try_malloc_n ((gsize) p->width * (gsize) p->height, components * size);
}

CeldPlane
celd_pipeline_new_plane (const CeldPipeline *p)
{
  return (CeldPlane) { p->width, p->height, (size_t) p->width, celd_pipeline_new_picture (p, 1, sizeof (float)) };
}

CeldPaint
celd_pipeline_new_paint (const CeldPipeline *p)
{
  return (CeldPaint) { p->width, p->height, (size_t) p->width, celd_pipeline_new_picture (p, 4, 1) };
}

CeldColours
celd_pipeline_new_colours (const CeldPipeline *p)
{
  return (CeldColours) { p->width, p->height, (size_t) p->width, celd_pipeline_new_picture (p, 4, sizeof (float)) };
}

/* ------------------------------------------------------------------ input */

GeglRectangle
celd_pipeline_rectangle (const CeldPipelineLayer *layer, int width, int height)
{
  return (GeglRectangle) { -layer->x, -layer->y, width, height };
}

/* In the language of the host: "Scribbles". */
static const char *
name_of (int role)
{
  return _ (celd_layer_role_name ((CeldLayerRole) role));
}

static gboolean
check_input (const CeldPipelineInput *input, GError **error)
{
  if (input->width < 1 || input->height < 1 || input->width > CELD_MAX_SIDE || input->height > CELD_MAX_SIDE)
    return celd_pipeline_fail (error, _ ("The image has %d x %d pixels; the limit is %d pixels a side. Scale it "
                                         "down first."), input->width, input->height, CELD_MAX_SIDE);
  if (!input->layer[CELD_LAYER_DRAWING].buffer)
    return celd_pipeline_fail (error, _ ("There is no drawing. Choose its layer."));
  for (int role = 0; role < CELD_N_LAYERS; role++)
    {
      const CeldPipelineLayer *layer = &input->layer[role];
      const GeglRectangle     *r = layer->buffer ? gegl_buffer_get_extent (layer->buffer) : NULL;
      GeglRectangle            image = celd_pipeline_rectangle (layer, input->width, input->height);

      if (r && !gegl_rectangle_intersect (NULL, r, &image))
        return celd_pipeline_fail (error, _ ("The layer with '%s' lies outside the image. Move it over the image."),
                                   name_of (role));
      for (int other = 0; r && other < role; other++)
        if (layer->id && layer->id == input->layer[other].id)
          return celd_pipeline_fail (error, _ ("The same layer is chosen as '%s' and as '%s'. Give each a layer of its "
                                               "own."),
                                     name_of (other), name_of (role));
    }
  return TRUE;
}

static CeldStatus
set_layer (CeldPipeline *p, const CeldPipelineLayer *layer,
           CeldStatus (*set) (CeldSession *session, const CeldPaint *paint))
{
  GeglRectangle rect = celd_pipeline_rectangle (layer, p->width, p->height);
  CeldPaint     paint = celd_pipeline_new_paint (p);
  CeldStatus    status = CELD_NO_MEMORY;

  if (paint.data)
    {
      celd_buffer_read_paint (layer->buffer, &rect, &paint);
      status = set (p->session, &paint);
    }
  g_free (paint.data);
  return status;
}

static CeldStatus
set_drawing (CeldPipeline *p, const CeldPipelineLayer *layer)
{
  GeglRectangle rect = celd_pipeline_rectangle (layer, p->width, p->height);
  gboolean      alpha = celd_buffer_has_alpha (layer->buffer);
  CeldHost      host = { NULL, celd_gegl_each, NULL };
  CeldDrawing   drawing = { .luma = celd_pipeline_new_plane (p) };
  CeldStatus    status = CELD_NO_MEMORY;

  if (alpha)
    drawing.alpha = celd_pipeline_new_plane (p);
  g_free (p->art.data);
  p->art = celd_pipeline_new_colours (p);
  if (drawing.luma.data && (!alpha || drawing.alpha.data) && p->art.data)
    status = celd_buffer_read_drawing (layer->buffer, &rect, p->settings.ink, &host, &drawing);
  if (status == CELD_OK)
    {
      celd_buffer_read_colours (layer->buffer, &rect, &p->art);
      status = celd_session_set_drawing (p->session, &drawing);
    }
  if (status == CELD_OK)
    status = set_layer (p, layer, celd_session_set_colours);
  g_free (drawing.luma.data);
  g_free (drawing.alpha.data);
  return status;
}

/* Those of the layers, as bits.  With `flats` a coloured drawing has its regions itself. */
static CeldStatus
set_layers (CeldPipeline *p, const CeldPipelineInput *input, guint layers)
{
  static CeldStatus (*const set[CELD_N_LAYERS]) (CeldSession *session, const CeldPaint *paint) = {
    [CELD_LAYER_SCRIBBLES]   = celd_session_set_scribbles,   [CELD_LAYER_ARROWS] = celd_session_set_arrows,
    [CELD_LAYER_CONTOURS]    = celd_session_set_contours,
    [CELD_LAYER_CORRECTIONS] = celd_session_set_corrections, [CELD_LAYER_HIDDEN] = celd_session_set_hidden,
  };
  CeldStatus status = CELD_OK;

  if (layers & 1u << CELD_LAYER_DRAWING)
    status = set_drawing (p, &input->layer[CELD_LAYER_DRAWING]);
  for (int role = CELD_LAYER_SCRIBBLES; role < CELD_N_LAYERS && status == CELD_OK; role++)
    if (role == CELD_LAYER_SCRIBBLES && !input->layer[role].buffer && p->settings.flats)
      status = set_layer (p, &input->layer[CELD_LAYER_DRAWING], set[role]);
    else if (layers & 1u << role)
      status = input->layer[role].buffer ? set_layer (p, &input->layer[role], set[role]) : set[role] (p->session, NULL);
  return status;
}

static gboolean
set_relations (CeldPipeline *p, const char *relations, GError **error)
{
  CeldTextError place = { 0 };
  CeldStatus    status = celd_session_set_relations (p->session, relations, &place);

  if (status != CELD_BAD_RELATION)
    return celd_pipeline_try (status, error);
  return celd_pipeline_fail (error, _ ("The relations cannot be read: line %d, column %d has %s where %s was "
                                       "expected. An example of a relation is: 120,80 > 300,95"),
                             place.line, place.column, _ (place.found), _ (place.expected));
}

/* The host makes the path of its own items, so that what is wrong with it cannot be pointed at. */
static gboolean
set_arrow_path (CeldPipeline *p, const char *path, GError **error)
{
  CeldTextError place = { 0 };
  CeldStatus    status = celd_session_set_arrow_path (p->session, path, &place);

  if (status != CELD_BAD_RELATION)
    return celd_pipeline_try (status, error);
  return celd_pipeline_fail (error, _ ("The path with arrows cannot be read: it has %s where %s was expected."),
                             _ (place.found), _ (place.expected));
}

/* Levels are in [0,1] whatever their encoding says. */
static CeldStatus
set_settings (CeldPipeline *p, const CeldSettings *settings)
{
  CeldSettings usual = celd_settings ();

  p->settings            = *settings;
  p->settings.encoding   = usual.encoding;
  p->settings.near_level = usual.near_level;
  p->settings.far_level  = usual.far_level;
  return celd_session_set_settings (p->session, &p->settings);
}

/* How a drawing is read depends on the settings.  What a note says is of views or a mesh of the old state. */
gboolean
celd_pipeline_update (CeldPipeline *p, const CeldPipelineInput *input, guint layers, GError **error)
{
  g_clear_pointer (&p->note, g_free);
  if (input->settings.ink != p->settings.ink)
    layers |= 1u << CELD_LAYER_DRAWING;
  if (input->settings.flats != p->settings.flats) /* with flats neither is checked */
    layers |= 1u << CELD_LAYER_DRAWING | 1u << CELD_LAYER_SCRIBBLES;
  return check_input (input, error) &&
         celd_pipeline_try (input->width == p->width && input->height == p->height ? CELD_OK : CELD_BAD_SIZE, error) &&
         celd_pipeline_try (set_settings (p, &input->settings), error) &&
         celd_pipeline_check_layers (p, input, layers, error) &&
         celd_pipeline_try (set_layers (p, input, layers), error) &&
         set_relations (p, input->relations, error) &&
         set_arrow_path (p, input->arrow_path, error) &&
         celd_pipeline_check_lines (p, input, layers, error);
}

CeldPipeline *
celd_pipeline_new (const CeldPipelineInput *input, GError **error)
{
  CeldPipeline *p = g_new0 (CeldPipeline, 1);

  p->session = celd_session_new ();
  p->width   = input->width;
  p->height  = input->height;
  if (celd_pipeline_try (p->session ? CELD_OK : CELD_NO_MEMORY, error) &&
      celd_pipeline_update (p, input, ~0u, error))
    return p;
  celd_pipeline_free (p);
  return NULL;
}

void
celd_pipeline_free (CeldPipeline *p)
{
  if (!p)
    return;
  celd_pipeline_drop_relief (p);
  celd_layers_free (p->layers);
  celd_session_free (p->session);
  g_free (p->art.data);
  g_free (p->lit.data);
  g_free (p->enhanced.data);
  g_free (p->view[0].data);
  g_free (p->view[1].data);
  g_free (p->note);
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

CeldStatus
celd_pipeline_copy_art (const CeldPipeline *p, CeldColours *copy)
{
  g_free (copy->data);
  *copy = celd_pipeline_new_colours (p);
  if (!copy->data)
    return CELD_NO_MEMORY;
  memcpy (copy->data, p->art.data, 4 * sizeof (float) * (gsize) p->width * (gsize) p->height);
  return CELD_OK;
}

static CeldStatus
make_lit (CeldPipeline *p, const CeldHost *host)
{
  CeldPlane   ink, levels, gloss = celd_pipeline_new_plane (p);
  CeldColours tone = celd_pipeline_new_colours (p);
  CeldVectors normals;
  CeldStatus  status = tone.data && gloss.data ? celd_pipeline_copy_art (p, &p->lit) : CELD_NO_MEMORY;

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
  CeldPlane  levels, change = celd_pipeline_new_plane (p);
  CeldStatus status = change.data ? celd_pipeline_copy_art (p, &p->enhanced) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_session_levels (p->session, NULL, &levels, NULL);
  if (status == CELD_OK)
    status = celd_enhance (&levels, &p->settings, host, &change);
  if (status == CELD_OK)
    status = celd_enhance_colours (&change, &p->enhanced);
  g_free (change.data);
  return status;
}

#define NEED_LIGHT (OF (NORMALS) | OF (SHADING) | OF (LIT))
#define NEED_LEVELS (OF (LEVELS) | OF (DEPTH) | OF (ENHANCED) | NEED_LIGHT)

/* The steps in their order, the pictures that need each, and its part of the time, in percent of all; chosen. */
static const struct
{
  const char *name;
  guint       pictures;
  double      time;
  CeldStatus (*make) (CeldPipeline *p, const CeldHost *host);
} steps[] = {
  { N_ ("Finding the regions"),   ~0u,              45, make_labels },
  { N_ ("Suggesting an order"),   OF (SUGGESTIONS),  5, make_suggestions },
  { N_ ("Ordering the regions"),  NEED_LEVELS,       1, make_order },
  { N_ ("Giving lines to parts"), NEED_LEVELS,      10, make_levels },
  { N_ ("Making depth smooth"),   OF (DEPTH),       15, make_depth },
  { N_ ("Rounding the parts"),    NEED_LIGHT,       20, make_normals },
  { N_ ("Lighting the parts"),    OF (SHADING),      2, make_shading },
  { N_ ("Lighting the drawing"),  OF (LIT),          4, make_lit },
  { N_ ("Casting shadows"),       OF (ENHANCED),     3, make_enhanced },
};

bool
celd_pipeline_report (void *data, double done)
{
  const CeldPipelineReport *r = data;

  return !r->progress || r->progress (r->data, MIN (r->from + r->part * done, 1), _ (r->name));
}

gboolean
celd_pipeline_report_steps (gpointer data, double done, const char *step)
{
  const CeldPipelineReport *r = data;

  return !r->progress || r->progress (r->data, MIN (r->from + r->part * done, 1), step);
}

gboolean
celd_pipeline_make (CeldPipeline *p, guint wanted, CeldPipelineProgress progress, gpointer data, GError **error)
{
  CeldPipelineReport r = { .progress = progress, .data = data };
  CeldHost           host = { celd_pipeline_report, celd_gegl_each, &r };
  double             all = 0;
  CeldStatus         status = CELD_OK;

  for (gsize i = 0; i < G_N_ELEMENTS (steps); i++)
    if (wanted & steps[i].pictures)
      all += steps[i].time;
  for (gsize i = 0; i < G_N_ELEMENTS (steps) && status == CELD_OK; i++)
    if (wanted & steps[i].pictures)
      {
        r.name = steps[i].name;
        r.part = steps[i].time / all;
        status = celd_pipeline_report (&r, 0) ? steps[i].make (p, &host) : CELD_CANCELLED;
        r.from += r.part;
      }
  return celd_pipeline_try (status, error);
}
