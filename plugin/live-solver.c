/* The thread that solves while an artist paints.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "live-solver.h"
#include "translate.h"

#define PREVIEW_FROM 200000 /* microseconds that depth takes, from which on a preview of it is shown; chosen */

struct CeldLiveSolver
{
  CeldLiveAnswered answered;
  gpointer         data;
  GThread         *thread;

  /* shared, under the mutex */
  GMutex           mutex;
  GCond            asked;
  CeldLiveRequest *newest;      /* that has not been begun; NULL: none */
  GQueue           answers;     /* CeldLiveAnswer that have not been delivered */
  guint            delivery;    /* the source that delivers them; 0: none */
  gboolean         stop;

  /* of the thread alone */
  CeldLiveRequest *request;     /* that the pipeline has, or that it gets; NULL: none */
  CeldPipeline    *pipeline;    /* NULL: none */
  gboolean         may_give_up; /* what is being made, when there is a newer request */
  gboolean         gave_up;     /* the request before */
  gboolean         has_shown;   /* any picture */
  gboolean         has_views;   /* of this request */
  gint64           depth_took;  /* microseconds, the last time */
};

/* ------------------------------------------------------------------ requests */

CeldLiveRequest *
celd_live_request_new (void)
{
  return g_new0 (CeldLiveRequest, 1);
}

CeldLiveRequest *
celd_live_request_copy (const CeldLiveRequest *request)
{
  CeldLiveRequest *copy = g_memdup2 (request, sizeof *request);

  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (copy->input.layer[role].buffer)
      g_object_ref (copy->input.layer[role].buffer);
  copy->input.relations  = g_strdup (request->input.relations);
  copy->input.arrow_path = g_strdup (request->input.arrow_path);
  return copy;
}

void
celd_live_request_free (CeldLiveRequest *request)
{
  if (!request)
    return;
  for (int role = 0; role < CELD_N_LAYERS; role++)
    g_clear_object (&request->input.layer[role].buffer);
  g_free ((char *) request->input.relations);
  g_free ((char *) request->input.arrow_path);
  g_free (request);
}

/* ------------------------------------------------------------------ answers */

static void
free_answer (gpointer data)
{
  CeldLiveAnswer *answer = data;

  g_free (answer->pixels);
  g_clear_object (&answer->buffer);
  g_clear_pointer (&answer->problems, g_array_unref);
  g_free (answer->error);
  g_free (answer);
}

static gboolean
deliver (gpointer data)
{
  CeldLiveSolver *s = data;
  GQueue          answers;
  CeldLiveAnswer *answer;

  g_mutex_lock (&s->mutex);
  answers     = s->answers;
  s->delivery = 0;
  g_queue_init (&s->answers);
  g_mutex_unlock (&s->mutex);
  while ((answer = g_queue_pop_head (&answers)))
    {
      s->answered (answer, s->data);
      free_answer (answer);
    }
  return G_SOURCE_REMOVE;
}

/* Takes what the answer owns.  An answer is not the last one if a newer request has come in. */
static void
send (CeldLiveSolver *s, CeldLiveAnswer answer)
{
  g_mutex_lock (&s->mutex);
  answer.last = answer.last && !s->newest;
  g_queue_push_tail (&s->answers, g_memdup2 (&answer, sizeof answer));
  if (!s->delivery)
    s->delivery = g_idle_add_full (G_PRIORITY_DEFAULT, deliver, s, NULL);
  g_mutex_unlock (&s->mutex);
}

/* ------------------------------------------------------------------ giving up */

/* A CeldPipelineProgress. */
static gboolean
go_on (gpointer data, double done, const char *step)
{
  CeldLiveSolver *s = data;
  gboolean        on;

  (void) done;
  (void) step;
  g_mutex_lock (&s->mutex);
  on = !s->stop && !(s->newest && s->may_give_up);
  g_mutex_unlock (&s->mutex);
  return on;
}

/* ------------------------------------------------------------------ making */

/* The layers that differ between two requests, as bits. */
static guint
changed_layers (const CeldLiveRequest *a, const CeldLiveRequest *b)
{
  guint changed = 0;

  for (int role = 0; role < CELD_N_LAYERS; role++)
    {
      const CeldPipelineLayer *p = &a->input.layer[role], *q = &b->input.layer[role];

      if (p->buffer != q->buffer || p->x != q->x || p->y != q->y)
        changed |= 1u << role;
    }
  return changed;
}

static gboolean
read_request (CeldLiveSolver *s, CeldLiveRequest *request, GError **error)
{
  CeldLiveRequest *old = s->request;
  gboolean         good = TRUE;

  s->request = request;
  if (s->pipeline &&
      (old->input.width != request->input.width || old->input.height != request->input.height))
    g_clear_pointer (&s->pipeline, celd_pipeline_free);
  if (s->pipeline)
    good = celd_pipeline_update (s->pipeline, &request->input, changed_layers (old, request), error);
  else
    s->pipeline = celd_pipeline_new (&request->input, error);
  if (!good)
    g_clear_pointer (&s->pipeline, celd_pipeline_free);
  celd_live_request_free (old);
  return s->pipeline != NULL;
}

/* How the views are arranged in a picture. */
static CeldStereo
arrangement (const CeldLiveSolver *s, int picture)
{
  if (picture == CELD_LIVE_STEREO)
    return s->request->input.settings.stereo;
  return picture == CELD_LIVE_LEFT ? CELD_STEREO_LEFT : CELD_STEREO_RIGHT;
}

static gboolean
write (CeldLiveSolver *s, const CeldLiveAnswer *answer, gboolean preview, GeglBuffer *buffer, GError **error)
{
  if (preview)
    return celd_pipeline_write_preview (s->pipeline, go_on, s, buffer, error);
  if (answer->picture == CELD_LIVE_RELIEF)
    return celd_pipeline_write_turned (s->pipeline, answer->frame, CELD_LIVE_FRAMES, go_on, s, buffer, error);
  if (answer->picture >= CELD_LIVE_STEREO)
    return celd_pipeline_write_views (s->pipeline, arrangement (s, answer->picture), buffer, error);
  return celd_pipeline_write (s->pipeline, (CeldPicture) answer->picture, buffer, error);
}

static void
set_size (const CeldLiveSolver *s, gboolean preview, CeldLiveAnswer *answer)
{
  const CeldLiveRequest *r = s->request;

  answer->scale  = 1;
  answer->width  = r->input.width;
  answer->height = r->input.height;
  if (preview)
    {
      answer->scale  = 4;
      answer->width  = (answer->width + 3) / 4;
      answer->height = (answer->height + 3) / 4;
    }
  else if (answer->picture == CELD_LIVE_RELIEF)
    {
      answer->scale  = (double) r->input.width / r->relief_width;
      answer->width  = r->relief_width;
      answer->height = r->relief_height;
    }
  else if (answer->picture >= CELD_LIVE_STEREO)
    celd_stereo_size (arrangement (s, answer->picture), &answer->width, &answer->height);
}

static gboolean
show_frame (CeldLiveSolver *s, int picture, int frame, gboolean preview, GError **error)
{
  CeldLiveAnswer answer = { .picture = picture, .frame = frame };
  GeglBuffer    *buffer;
  gboolean       good;

  set_size (s, preview, &answer);
  answer.pixels = g_try_malloc_n ((gsize) answer.width * (gsize) answer.height, 4);
  if (!answer.pixels)
    {
      g_set_error_literal (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED, _ (celd_status_text (CELD_NO_MEMORY)));
      return FALSE;
    }
  buffer = gegl_buffer_linear_new_from_data (answer.pixels, babl_format ("cairo-ARGB32"),
                                             GEGL_RECTANGLE (0, 0, answer.width, answer.height), GEGL_AUTO_ROWSTRIDE,
                                             NULL, NULL);
  good = write (s, &answer, preview, buffer, error);
  g_object_unref (buffer);
  if (good)
    send (s, answer);
  else
    g_free (answer.pixels);
  s->has_shown = s->has_shown || good;
  return good;
}

static gboolean
show (CeldLiveSolver *s, int picture, gboolean preview, GError **error)
{
  return show_frame (s, picture, 0, preview, error);
}

static gboolean
show_relief (CeldLiveSolver *s, GError **error)
{
  gboolean good = show_frame (s, CELD_LIVE_RELIEF, CELD_LIVE_MIDDLE, FALSE, error);

  for (int step = CELD_LIVE_MIDDLE; step; step /= 2)
    for (int frame = step == CELD_LIVE_MIDDLE ? 0 : step; frame < CELD_LIVE_FRAMES && good; frame += 2 * step)
      good = show_frame (s, CELD_LIVE_RELIEF, frame, FALSE, error);
  return good;
}

static gboolean
make_views (CeldLiveSolver *s, GError **error)
{
  if (!s->has_views)
    s->has_views = celd_pipeline_view (s->pipeline, go_on, s, error);
  return s->has_views;
}

static gboolean
make (CeldLiveSolver *s, int picture, GError **error)
{
  gint64   begin = g_get_monotonic_time ();
  gboolean good;

  if (picture == CELD_LIVE_RELIEF)
    good = celd_pipeline_make_relief (s->pipeline, go_on, s, error);
  else if (picture >= CELD_LIVE_STEREO)
    good = make_views (s, error);
  else
    good = celd_pipeline_make (s->pipeline, 1u << picture, go_on, s, error);
  if (picture == CELD_PICTURE_DEPTH)
    s->depth_took = g_get_monotonic_time () - begin;
  return good;
}

static gboolean
send_buffer (CeldLiveSolver *s, int picture, GError **error)
{
  GeglRectangle  image = { 0, 0, s->request->input.width, s->request->input.height };
  CeldLiveAnswer answer = { .picture = picture, .buffer = gegl_buffer_new (&image, s->request->format[picture]) };
  gboolean       good = write (s, &answer, FALSE, answer.buffer, error);

  if (good)
    send (s, answer);
  else
    g_object_unref (answer.buffer);
  return good;
}

/* Regions come first, also if they are only to be seen until there is something else. */
static gboolean
make_regions (CeldLiveSolver *s, GError **error)
{
  s->may_give_up = FALSE;
  return make (s, CELD_PICTURE_REGIONS, error) &&
         (!(s->request->shown & 1u << CELD_PICTURE_REGIONS || !s->has_shown) ||
          show (s, CELD_PICTURE_REGIONS, FALSE, error));
}

/* What is shown, and then what is only written.  A preview would flicker where depth itself comes at once. */
static gboolean
make_others (CeldLiveSolver *s, GError **error)
{
  const CeldLiveRequest *r = s->request;
  gboolean               good = TRUE;

  s->may_give_up = !s->gave_up;
  s->has_views   = FALSE;
  if (r->shown & 1u << CELD_PICTURE_DEPTH && s->depth_took >= PREVIEW_FROM)
    good = show (s, CELD_PICTURE_DEPTH, TRUE, error);
  for (int picture = 0; picture < CELD_LIVE_N_PICTURES && good; picture++)
    if (picture != CELD_PICTURE_REGIONS && r->shown & 1u << picture)
      good = make (s, picture, error) &&
             (picture == CELD_LIVE_RELIEF ? show_relief (s, error) : show (s, picture, FALSE, error));
  for (int picture = 0; picture < CELD_N_PICTURES && good; picture++)
    if (r->format[picture])
      good = make (s, picture, error) && send_buffer (s, picture, error);
  return good;
}

/* After a failure the pipeline is still good; the next request may be, too. */
static void
answer_request (CeldLiveSolver *s, CeldLiveRequest *request)
{
  GError        *error = NULL;
  gboolean       good = read_request (s, request, &error) && make_regions (s, &error) && make_others (s, &error);
  CeldLiveAnswer answer = { .last = TRUE };

  s->gave_up = g_error_matches (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_CANCELLED);
  if (good)
    answer.problems = celd_pipeline_problem_list (s->pipeline);
  else if (!s->gave_up)
    answer.error = g_strdup (error->message);
  if (!s->gave_up)
    send (s, answer);
  g_clear_error (&error);
}

/* ------------------------------------------------------------------ the thread */

static gpointer
run (gpointer data)
{
  CeldLiveSolver *s = data;

  g_mutex_lock (&s->mutex);
  while (!s->stop)
    if (s->newest)
      {
        CeldLiveRequest *request = s->newest;

        s->newest = NULL;
        g_mutex_unlock (&s->mutex);
        answer_request (s, request);
        g_mutex_lock (&s->mutex);
      }
    else
      g_cond_wait (&s->asked, &s->mutex);
  g_mutex_unlock (&s->mutex);
  celd_pipeline_free (s->pipeline);
  celd_live_request_free (s->request);
  return NULL;
}

CeldLiveSolver *
celd_live_solver_new (CeldLiveAnswered answered, gpointer data)
{
  CeldLiveSolver *s = g_new0 (CeldLiveSolver, 1);

  s->answered   = answered;
  s->data       = data;
  s->depth_took = PREVIEW_FROM;
  g_mutex_init (&s->mutex);
  g_cond_init (&s->asked);
  g_queue_init (&s->answers);
  s->thread = g_thread_new ("celdepth-live", run, s);
  return s;
}

void
celd_live_solver_ask (CeldLiveSolver *s, CeldLiveRequest *request)
{
  g_mutex_lock (&s->mutex);
  celd_live_request_free (s->newest);
  s->newest = request;
  g_cond_signal (&s->asked);
  g_mutex_unlock (&s->mutex);
}

void
celd_live_solver_free (CeldLiveSolver *s)
{
  g_mutex_lock (&s->mutex);
  s->stop = TRUE;
  g_cond_signal (&s->asked);
  g_mutex_unlock (&s->mutex);
  g_thread_join (s->thread);
  if (s->delivery)
    g_source_remove (s->delivery);
  g_queue_clear_full (&s->answers, free_answer);
  celd_live_request_free (s->newest);
  g_mutex_clear (&s->mutex);
  g_cond_clear (&s->asked);
  g_free (s);
}
