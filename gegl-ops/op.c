/* The base class of every operation: pads, regions, the frame round render, and what the artist is told.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op.h"

#include <string.h>

#define MOST_PROBLEMS 8 /* in one message */

G_DEFINE_DYNAMIC_TYPE_EXTENDED (CeldOperation, celd_operation, GEGL_TYPE_OPERATION, G_TYPE_FLAG_ABSTRACT, {})

#define GET_CLASS(operation) G_TYPE_INSTANCE_GET_CLASS (operation, CELD_TYPE_OPERATION, CeldOperationClass)

/* ------------------------------------------------------------------ pads and regions */

static void
create_pad (GeglOperation *operation, const char *name, const char *label, const char *description, GParamFlags access,
            GeglPadType type)
{
  GParamFlags flags = (GParamFlags) ((guint) access | (guint) type);
  GParamSpec *pad = g_param_spec_object (name, label, description, GEGL_TYPE_BUFFER, flags);

  gegl_operation_create_pad (operation, pad);
  g_param_spec_sink (pad);
}

/* In the order in which GIMP shows them (GEGL's own list has the newest first). */
static void
attach (GeglOperation *operation)
{
  for (const CeldPad *pad = GET_CLASS (operation)->pads; pad->name; pad++)
    create_pad (operation, pad->name, pad->label, pad->description, G_PARAM_READWRITE, GEGL_PARAM_PAD_INPUT);
  create_pad (operation, "output", "Output", "The result", G_PARAM_READABLE, GEGL_PARAM_PAD_OUTPUT);
}

/* The whole input, whatever the host asks for: every result depends on every pixel. */
static GeglRectangle
whole_picture (GeglOperation *operation)
{
  const GeglRectangle *input = gegl_operation_source_get_bounding_box (operation, "input");

  return input ? *input : (GeglRectangle) { 0, 0, 0, 0 };
}

/* The whole input, or of an endless one no more than is asked for: render refuses it. */
static GeglRectangle
finite_picture (GeglOperation *operation, const GeglRectangle *asked)
{
  GeglRectangle whole = whole_picture (operation);

  return gegl_rectangle_is_infinite_plane (&whole) ? *asked : whole;
}

static GeglRectangle
get_cached_region (GeglOperation *operation, const GeglRectangle *roi)
{
  return finite_picture (operation, roi);
}

/* A sample is needed wherever it lies. */
static GeglRectangle
get_required_for_output (GeglOperation *operation, const gchar *name, const GeglRectangle *roi)
{
  for (const CeldPad *pad = GET_CLASS (operation)->pads; pad->name; pad++)
    if (pad->required == CELD_PAD_SAMPLE && !strcmp (pad->name, name))
      {
        const GeglRectangle *whole = gegl_operation_source_get_bounding_box (operation, name);

        return whole && !gegl_rectangle_is_infinite_plane (whole) ? *whole : *roi;
      }
  return finite_picture (operation, roi);
}

static GeglRectangle
get_invalidated_by_change (GeglOperation *operation, const gchar *pad, const GeglRectangle *changed)
{
  return finite_picture (operation, changed);
}

/* ------------------------------------------------------------------ what the artist is told */

static void
add_to_message (CeldOp *op, const char *text)
{
  if (op->message->len)
    g_string_append_c (op->message, '\n');
  g_string_append (op->message, text);
}

gboolean
celd_op_fail (CeldOp *op, const char *format, ...)
{
  va_list arguments;
  char   *text;

  va_start (arguments, format);
  text = g_strdup_vprintf (format, arguments);
  va_end (arguments);
  add_to_message (op, text);
  g_free (text);
  return FALSE;
}

/* While the artist is still choosing layers, that there is nothing to go by is no news. */
gboolean
celd_op_try (CeldOp *op, CeldStatus status)
{
  if (status == CELD_NOTHING_TO_GO_BY && op->choosing)
    return FALSE;
  return status == CELD_OK || celd_op_fail (op, "%s", celd_status_text (status));
}

/* Says where a text cannot be read, and what it may look like. */
static gboolean
try_text (CeldOp *op, CeldStatus status, const CeldTextError *error, const char *what, const char *example)
{
  if (status != CELD_BAD_RELATION)
    return celd_op_try (op, status);
  return celd_op_fail (op, "The %s cannot be read: line %d, column %d has %s, where %s was expected. An example of %s",
                       what, error->line, error->column, error->found, error->expected, example);
}

gboolean
celd_op_try_text (CeldOp *op, CeldStatus status, const CeldTextError *error)
{
  return try_text (op, status, error, "relations", "a relation is: 120,80 > 300,95");
}

gboolean
celd_op_try_path (CeldOp *op, CeldStatus status, const CeldTextError *error)
{
  return try_text (op, status, error, "arrow path", "an arrow is: M 120,80 L 300,95");
}

gboolean
celd_op_tell (CeldOp *op, const CeldProblems *problems, const CeldPalette *palette, const CeldRelations *relations,
              const CeldOrder *order)
{
  for (size_t i = 0; problems && i < MIN (problems->n, MOST_PROBLEMS); i++)
    {
      const CeldProblem *problem = &problems->item[i];
      char               text[400];

      celd_problem_text (problem, palette, relations, text, sizeof text);
      add_to_message (op, text);
      if (problem->kind == CELD_PROBLEM_CONTRADICTION && order && problem->other < order->n_cycles)
        {
          celd_cycle_text (&order->cycle[problem->other], relations, text, sizeof text);
          g_string_append_printf (op->message, " %s", text);
        }
    }
  if (problems && problems->n > MOST_PROBLEMS)
    g_string_append_printf (op->message, "\nThere are %zu more remarks.", problems->n - MOST_PROBLEMS);
  return TRUE;
}

gboolean
celd_op_remark (CeldOp *op, const char *text)
{
  add_to_message (op, text);
  return TRUE;
}

gboolean
celd_op_tell_solve (CeldOp *op, const CeldSolve *solve)
{
  CeldProblem  problem = { .kind = CELD_PROBLEM_NOT_CONVERGED, .x = -1, .y = -1, .relation = CELD_NO_INDEX };
  CeldProblems problems = { &problem, 1 };

  return solve->converged || celd_op_tell (op, &problems, NULL, NULL, NULL);
}

/* Says the message of this call, unless the last call said the same. */
static void
speak (CeldOp *op)
{
  CeldOperation *self = op->operation;
  const char    *text = op->message->len ? op->message->str : NULL;

  if (text && g_strcmp0 (text, self->said))
    g_message ("%s: %s", gegl_operation_class_get_key (GEGL_OPERATION_GET_CLASS (self), "title"), text);
  g_free (self->said);
  self->said = g_strdup (text);
}

/* ------------------------------------------------------------------ what the host lends */

static bool
report_progress (void *host, double done)
{
  CeldOp *op = host;

  if (done >= op->progress + 0.01)
    {
      op->progress = done;
      gegl_operation_progress (GEGL_OPERATION (op->operation), done, (gchar *) "");
    }
  return true; /* GEGL knows no cancel */
}

typedef struct { void (*body) (void *data, int i); void *data; } Work;

static void
work_range (gsize first, gsize n, gpointer user_data)
{
  const Work *work = user_data;

  for (gsize i = first; i < first + n; i++)
    work->body (work->data, (int) i);
}

static void
distribute (void *host, int n, void (*body) (void *data, int i), void *data)
{
  Work work = { body, data };

  gegl_parallel_distribute_range ((gsize) n, 1.0, work_range, &work);
}

gpointer
celd_op_alloc (CeldOp *op, gsize size)
{
  gpointer memory = g_try_malloc (size);

  if (memory)
    g_ptr_array_add (op->scratch, memory);
  else
    celd_op_try (op, CELD_NO_MEMORY);
  return memory;
}

/* ------------------------------------------------------------------ the frame round render */

/* A layer picker in which nothing is chosen yet: GIMP connects a source without a buffer. */
static gboolean
is_open_picker (CeldOp *op, const char *pad)
{
  GeglNode   *producer = gegl_node_get_producer (GEGL_OPERATION (op->operation)->node, pad, NULL);
  GeglBuffer *buffer = NULL;

  if (!producer || g_strcmp0 (gegl_node_get_operation (producer), "gegl:buffer-source"))
    return FALSE;
  gegl_node_get (producer, "buffer", &buffer, NULL);
  if (!buffer)
    return TRUE;
  g_object_unref (buffer);
  return FALSE;
}

gboolean
celd_op_has (CeldOp *op, const char *pad)
{
  return gegl_operation_context_get_object (op->context, pad) != NULL && !is_open_picker (op, pad);
}

/* A layer of another size is taken as it lies, but the artist should know: GIMP loses the offsets of layers. */
static void
tell_size (CeldOp *op, const CeldPad *pad, const GeglRectangle *r)
{
  const GeglRectangle *p = &op->picture;
  char                 text[300];

  if (gegl_rectangle_equal (r, p) || gegl_rectangle_is_infinite_plane (r))
    return;
  g_snprintf (text, sizeof text,
              "'%s' has %d x %d pixels at %d, %d, the picture %d x %d at %d, %d: what sticks out is cut off, the rest "
              "counts as empty. If it looks shifted, give the layer the picture's size.",
              pad->label, r->width, r->height, r->x, r->y, p->width, p->height, p->x, p->y);
  add_to_message (op, text);
}

/* A picture that is no layer. */
static gboolean
check_sample (CeldOp *op, const CeldPad *pad, const GeglRectangle *r)
{
  if (gegl_rectangle_is_infinite_plane (r) || r->width > CELD_MAX_SIDE || r->height > CELD_MAX_SIDE)
    return celd_op_fail (op, "The picture for '%s' (pad %s) is too large. Scale it down, or crop it.", pad->label,
                         pad->name);
  return TRUE;
}

/* Is the pad there as it must be?  Layers may be smaller than the drawing, but must lie over it. */
static gboolean
check_pad (CeldOp *op, const CeldPad *pad)
{
  const GeglRectangle *p = &op->picture;
  const GeglRectangle *r = gegl_operation_source_get_bounding_box (GEGL_OPERATION (op->operation), pad->name);

  if (is_open_picker (op, pad->name))
    {
      op->choosing = TRUE;
      return pad->required != TRUE;
    }
  if (!r)
    return pad->required != TRUE ||
           celd_op_fail (op, "There is no picture for '%s' (pad %s). Choose the layer.", pad->label, pad->name);
  if (!r->width || !r->height)
    return celd_op_fail (op, "The picture for '%s' (pad %s) is empty. Choose another layer, or see whether its "
                             "file can be read.",
                         pad->label, pad->name);
  if (pad->required == CELD_PAD_SAMPLE)
    return check_sample (op, pad, r);
  if (!gegl_rectangle_intersect (NULL, r, p))
    return celd_op_fail (op, "'%s' (%d x %d pixels at %d, %d) lies outside the picture (%d x %d at %d, %d). "
                         "Move it over the picture, or give it the picture's size.",
                         pad->label, r->width, r->height, r->x, r->y, p->width, p->height, p->x, p->y);
  tell_size (op, pad, r);
  return TRUE;
}

static gboolean
check_pads (CeldOp *op)
{
  const GeglRectangle *p = &op->picture;

  if (gegl_rectangle_is_infinite_plane (p))
    return celd_op_fail (op, "The input has no size. Crop it first.");
  if (p->width > CELD_MAX_SIDE || p->height > CELD_MAX_SIDE)
    return celd_op_fail (op, "The picture is %d x %d pixels large; at most %d a side can be worked on. Scale it "
                             "down first.",
                         p->width, p->height, CELD_MAX_SIDE);
  for (const CeldPad *pad = GET_CLASS (op->operation)->pads; pad->name; pad++)
    if (!check_pad (op, pad))
      return FALSE;
  return TRUE;
}

static void
pass_through (GeglOperationContext *context)
{
  GObject *input = gegl_operation_context_dup_object (context, "input");

  if (input)
    gegl_operation_context_take_object (context, "output", input);
  else
    gegl_operation_context_get_target (context, "output");
}

static void
render_or_pass (CeldOperation *self, GeglOperationContext *context)
{
  CeldOp op = {
    .operation = self,
    .context   = context,
    .picture   = whole_picture (GEGL_OPERATION (self)),
    .scratch   = g_ptr_array_new_with_free_func (g_free),
    .message   = g_string_new (NULL),
  };

  op.host   = (CeldHost) { report_progress, distribute, &op };
  op.quiet = (CeldHost) { NULL, distribute, &op };
  if (check_pads (&op) && GET_CLASS (self)->render (&op))
    report_progress (&op, 1);
  else
    pass_through (context);
  speak (&op);
  celd_palette_clear (&op.palette);
  celd_relations_clear (&op.relations);
  celd_problems_clear (&op.problems);
  celd_order_clear (&op.order);
  g_ptr_array_unref (op.scratch);
  g_string_free (op.message, TRUE);
}

/* A host that draws its windows while it shows progress may ask again from within: it gets the input. */
static gboolean
process (GeglOperation *operation, GeglOperationContext *context, const gchar *output_pad,
         const GeglRectangle *roi, gint level)
{
  CeldOperation *self = (CeldOperation *) operation;

  g_rec_mutex_lock (&self->busy);
  if (self->rendering)
    pass_through (context);
  else
    {
      self->rendering = TRUE;
      render_or_pass (self, context);
      self->rendering = FALSE;
    }
  g_rec_mutex_unlock (&self->busy);
  return TRUE;
}

/* ------------------------------------------------------------------ the class */

static void
finalize (GObject *object)
{
  CeldOperation *self = (CeldOperation *) object;

  celd_session_free (self->session);
  g_free (self->said);
  g_rec_mutex_clear (&self->busy);
  G_OBJECT_CLASS (celd_operation_parent_class)->finalize (object);
}

static void
celd_operation_init (CeldOperation *self)
{
  g_rec_mutex_init (&self->busy);
}

static void
celd_operation_class_init (CeldOperationClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  G_OBJECT_CLASS (klass)->finalize           = finalize;
  operation_class->attach                    = attach;
  operation_class->get_bounding_box          = whole_picture;
  operation_class->get_cached_region         = get_cached_region;
  operation_class->get_required_for_output   = get_required_for_output;
  operation_class->get_invalidated_by_change = get_invalidated_by_change;
  operation_class->process                   = process;
  operation_class->threaded                  = FALSE;
}

static void
celd_operation_class_finalize (CeldOperationClass *klass)
{
}

void
celd_operation_register (GTypeModule *module)
{
  celd_operation_register_type (module);
}
