/* The thread that solves while an artist paints, on the page of the operations' tests: its pictures are those of a new
 * pipeline, whatever came before; the newest request counts; and it neither starves nor ends at input without sense.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "live-solver.h"
#include "page.h"

#define BIT(picture) (1u << CELD_PICTURE_##picture)
#define PATIENCE     60000000 /* microseconds until a test fails */

/* What has been answered. */
typedef struct
{
  CeldLiveSolver *solver;
  GString        *order;                            /* a letter for each answer */
  guint8         *pixels[CELD_LIVE_N_PICTURES];     /* the last full ones of each picture */
  int             width[CELD_LIVE_N_PICTURES];
  GeglBuffer     *buffer[CELD_LIVE_N_PICTURES];
  GArray         *problems;
  char           *error;
  int             n_last, more;                     /* requests that are still to be made, at each picture of regions */
} Seen;

static CeldLiveRequest *
page_request (guint shown)
{
  CeldLiveRequest *request = celd_live_request_new ();

  request->input.width    = WIDTH;
  request->input.height   = HEIGHT;
  request->input.settings = celd_settings ();
  request->shown          = shown;
  request->input.layer[CELD_LAYER_DRAWING].buffer   = g_object_ref (drawing);
  request->input.layer[CELD_LAYER_SCRIBBLES].buffer = g_object_ref (scribbles);
  request->input.layer[CELD_LAYER_ARROWS].buffer    = g_object_ref (arrows);
  return request;
}

/* The scribbles with a stroke more, from x on. */
static void
add_stroke (CeldLiveRequest *request, int x, guint32 rgb)
{
  static uint8_t painted[4 * PIXELS];

  memcpy (painted, page_scribbles, sizeof painted);
  paint_line (painted, x, 60, x + 12, 60, 3, rgb);
  g_object_unref (request->input.layer[CELD_LAYER_SCRIBBLES].buffer);
  request->input.layer[CELD_LAYER_SCRIBBLES].buffer = page_buffer ("R'G'B'A u8", "R'G'B'A u8", painted);
}

static void
answered (CeldLiveAnswer *answer, gpointer data)
{
  Seen *seen = data;

  if (answer->pixels && answer->scale == 1)
    {
      g_free (seen->pixels[answer->picture]);
      seen->pixels[answer->picture] = g_steal_pointer (&answer->pixels);
      seen->width[answer->picture]  = answer->width;
      g_string_append_c (seen->order, (char) ('A' + answer->picture));
    }
  else if (answer->pixels)
    g_string_append_c (seen->order, 'p');
  if (answer->buffer)
    {
      g_clear_object (&seen->buffer[answer->picture]);
      seen->buffer[answer->picture] = g_steal_pointer (&answer->buffer);
      g_string_append_c (seen->order, (char) ('a' + answer->picture));
    }
  if (answer->problems)
    {
      g_clear_pointer (&seen->problems, g_array_unref);
      seen->problems = g_steal_pointer (&answer->problems);
    }
  if (answer->last)
    {
      g_free (seen->error);
      seen->error = g_steal_pointer (&answer->error);
      seen->n_last++;
    }
  if (answer->picture == CELD_PICTURE_REGIONS && seen->pixels[CELD_PICTURE_REGIONS] && seen->more > 0 && !answer->last)
    {
      CeldLiveRequest *request = page_request (BIT (REGIONS) | BIT (DEPTH));

      add_stroke (request, 10 + seen->more-- % 40, 0xff00ff);
      celd_live_solver_ask (seen->solver, request);
    }
}

static Seen
begin (void)
{
  return (Seen) { .order = g_string_new (NULL) };
}

static void
end (Seen *seen)
{
  celd_live_solver_free (seen->solver);
  for (int i = 0; i < CELD_LIVE_N_PICTURES; i++)
    {
      g_free (seen->pixels[i]);
      g_clear_object (&seen->buffer[i]);
    }
  g_clear_pointer (&seen->problems, g_array_unref);
  g_string_free (seen->order, TRUE);
  g_free (seen->error);
}

/* Asks, and waits for the last answer. */
static bool
ask (Seen *seen, CeldLiveRequest *request)
{
  gint64 until = g_get_monotonic_time () + PATIENCE;
  int    n = seen->n_last;

  celd_live_solver_ask (seen->solver, request);
  while (seen->n_last == n && g_get_monotonic_time () < until)
    g_main_context_iteration (NULL, TRUE);
  return seen->n_last > n;
}

/* Whether the pixels of a picture are those of a new pipeline for this request. */
static bool
is_that_of_a_pipeline (const Seen *seen, const CeldLiveRequest *request, int picture)
{
  CeldPipeline *pipeline = celd_pipeline_new (&request->input, NULL);
  GeglBuffer   *buffer = gegl_buffer_new (GEGL_RECTANGLE (0, 0, WIDTH, HEIGHT), babl_format ("cairo-ARGB32"));
  guint8        wanted[4 * PIXELS];
  bool          good;

  if (picture >= CELD_LIVE_STEREO)
    good = celd_pipeline_view (pipeline, NULL, NULL, NULL) &&
           celd_pipeline_write_views (pipeline, picture == CELD_LIVE_LEFT    ? CELD_STEREO_LEFT
                                                : picture == CELD_LIVE_RIGHT ? CELD_STEREO_RIGHT
                                                                             : request->input.settings.stereo,
                                      buffer, NULL);
  else
    good = celd_pipeline_make (pipeline, 1u << picture, NULL, NULL, NULL) &&
           celd_pipeline_write (pipeline, (CeldPicture) picture, buffer, NULL);
  gegl_buffer_get (buffer, NULL, 1, babl_format ("cairo-ARGB32"), wanted, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  g_object_unref (buffer);
  celd_pipeline_free (pipeline);
  return good && seen->pixels[picture] && seen->width[picture] == WIDTH &&
         !memcmp (wanted, seen->pixels[picture], sizeof wanted);
}

/* ------------------------------------------------------------------ the tests */

static void
regions_come_first_then_a_preview_then_depth (void)
{
  Seen seen = begin ();

  seen.solver = celd_live_solver_new (answered, &seen);
  CHECK (ask (&seen, page_request (BIT (DEPTH))));
  CHECK (!strcmp (seen.order->str, "ApC")); /* regions although they were not asked for: there is nothing else yet */
  CHECK (!seen.error && seen.problems && !seen.problems->len);
  g_string_truncate (seen.order, 0);
  CHECK (ask (&seen, page_request (BIT (DEPTH))));
  CHECK (!strcmp (seen.order->str, "C")); /* depth of this page is fast */
  end (&seen);
}

/* Only what differs is read again, each time from what was there before. */
static void
edits_give_what_a_new_pipeline_gives (void)
{
  static const int pictures[] = { CELD_PICTURE_REGIONS, CELD_PICTURE_LEVELS, CELD_PICTURE_DEPTH, CELD_PICTURE_SHADING,
                                  CELD_PICTURE_LIT, CELD_LIVE_STEREO, CELD_LIVE_LEFT, CELD_LIVE_RIGHT };
  Seen             seen = begin ();
  guint            shown = 0;

  seen.solver = celd_live_solver_new (answered, &seen);
  for (size_t i = 0; i < G_N_ELEMENTS (pictures); i++)
    shown |= 1u << pictures[i];
  for (int edit = 0; edit < 7; edit++)
    {
      CeldLiveRequest *request = page_request (shown), *copy;

      if (edit == 1)
        add_stroke (request, 20, 0xff00ff);
      if (edit == 2)
        g_clear_object (&request->input.layer[CELD_LAYER_ARROWS].buffer);
      if (edit == 3)
        request->input.relations = g_strdup ("90,40 > 45,40");
      if (edit == 4)
        request->input.layer[CELD_LAYER_SCRIBBLES].x = 4;
      if (edit == 5)
        request->input.settings.light_azimuth = 200;
      copy = celd_live_request_copy (request);
      CHECK (ask (&seen, request));
      CHECK (!seen.error);
      for (size_t i = 0; i < G_N_ELEMENTS (pictures); i++)
        CHECK (is_that_of_a_pipeline (&seen, copy, pictures[i]));
      celd_live_request_free (copy);
    }
  end (&seen);
}

static void
the_newest_request_counts (void)
{
  Seen             seen = begin ();
  CeldLiveRequest *last = NULL;

  seen.solver = celd_live_solver_new (answered, &seen);
  for (int i = 0; i < 30; i++)
    {
      CeldLiveRequest *request = page_request (BIT (REGIONS) | BIT (DEPTH));

      add_stroke (request, 10 + i, 0xff00ff);
      celd_live_request_free (last);
      last = celd_live_request_copy (request);
      celd_live_solver_ask (seen.solver, request);
    }
  CHECK (ask (&seen, celd_live_request_copy (last)));
  while (g_main_context_iteration (NULL, FALSE))
    ;
  CHECK (is_that_of_a_pipeline (&seen, last, CELD_PICTURE_REGIONS));
  CHECK (is_that_of_a_pipeline (&seen, last, CELD_PICTURE_DEPTH));
  CHECK (seen.order->len < 30);
  celd_live_request_free (last);
  end (&seen);
}

/* With a newer request after each picture of regions there is still a picture of depth for every other one. */
static void
depth_is_not_starved (void)
{
  Seen seen = begin ();
  int  n = 0, longest = 0;

  seen.solver = celd_live_solver_new (answered, &seen);
  seen.more   = 20;
  CHECK (ask (&seen, page_request (BIT (REGIONS) | BIT (DEPTH))));
  while (seen.more > 0)
    g_main_context_iteration (NULL, TRUE);
  for (const char *c = seen.order->str; *c; c++)
    {
      n       = *c == 'A' ? n + 1 : *c == 'C' ? 0 : n;
      longest = MAX (longest, n);
    }
  CHECK (longest <= 2);
  end (&seen);
}

static void
input_without_sense_is_told_and_then_forgotten (void)
{
  Seen             seen = begin ();
  CeldLiveRequest *request = page_request (BIT (REGIONS)), *good = page_request (BIT (REGIONS));

  seen.solver = celd_live_solver_new (answered, &seen);
  g_clear_object (&request->input.layer[CELD_LAYER_SCRIBBLES].buffer);
  g_clear_object (&request->input.layer[CELD_LAYER_ARROWS].buffer);
  CHECK (ask (&seen, request));
  CHECK (seen.error && strstr (seen.error, "no scribbles and no arrows"));
  request = page_request (BIT (REGIONS));
  g_clear_object (&request->input.layer[CELD_LAYER_DRAWING].buffer);
  CHECK (ask (&seen, request));
  CHECK (seen.error && strstr (seen.error, "no drawing"));
  CHECK (ask (&seen, celd_live_request_copy (good)));
  CHECK (!seen.error);
  CHECK (is_that_of_a_pipeline (&seen, good, CELD_PICTURE_REGIONS));
  celd_live_request_free (good);
  end (&seen);
}

static void
problems_have_places (void)
{
  Seen                       seen = begin ();
  CeldLiveRequest           *request = page_request (BIT (DEPTH));
  const CeldPipelineProblem *problem;

  seen.solver = celd_live_solver_new (answered, &seen);
  request->input.relations = g_strdup ("90,40 > 45,40"); /* contradicts the arrow */
  CHECK (ask (&seen, request));
  CHECK (seen.problems && seen.problems->len == 1);
  problem = &g_array_index (seen.problems, CeldPipelineProblem, 0);
  CHECK (abs (problem->x - 45) <= 2 && abs (problem->y - 48) <= 2); /* where the arrow begins, which is left out */
  CHECK (strstr (problem->text, "arrow") && strstr (problem->text, "line 1, column 1"));
  end (&seen);
}

static void
buffers_have_the_format_that_is_wanted (void)
{
  Seen             seen = begin ();
  CeldLiveRequest *request = page_request (BIT (REGIONS));
  guint8           pixels[4 * PIXELS], wanted[4 * PIXELS];

  seen.solver = celd_live_solver_new (answered, &seen);
  request->format[CELD_PICTURE_LEVELS]  = babl_format ("R'G'B' u16");
  request->format[CELD_PICTURE_REGIONS] = babl_format ("R'G'B'A float");
  CHECK (ask (&seen, request));
  CHECK (!strcmp (seen.order->str, "Aab")); /* what is shown comes before what is only written */
  CHECK (gegl_buffer_get_format (seen.buffer[CELD_PICTURE_LEVELS]) == babl_format ("R'G'B' u16"));
  gegl_buffer_get (seen.buffer[CELD_PICTURE_REGIONS], NULL, 1, babl_format ("cairo-ARGB32"), pixels,
                   GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  memcpy (wanted, seen.pixels[CELD_PICTURE_REGIONS], sizeof wanted);
  CHECK (!memcmp (pixels, wanted, sizeof wanted));
  end (&seen);
}

/* ------------------------------------------------------------------ the relief */

/* What has come of the relief. */
typedef struct { int frame[2 * CELD_LIVE_FRAMES], n; guint8 *last; bool good, done; } Turning;

static void
turned (CeldLiveAnswer *answer, gpointer data)
{
  Turning *t = data;

  if (answer->picture == CELD_LIVE_RELIEF && answer->pixels)
    {
      t->good = t->good && t->n < 2 * CELD_LIVE_FRAMES && answer->width == WIDTH / 2 &&
                answer->height == HEIGHT / 2 && fabs (answer->scale - 2) < 1e-9;
      if (t->good)
        t->frame[t->n++] = answer->frame;
      g_free (t->last);
      t->last = g_steal_pointer (&answer->pixels);
    }
  t->done = t->done || answer->last;
}

/* Whether these are the pixels of a frame that a new pipeline makes. */
static bool
is_frame (const guint8 *pixels, const CeldLiveRequest *request, int frame)
{
  CeldPipeline *pipeline = celd_pipeline_new (&request->input, NULL);
  GeglBuffer   *buffer = gegl_buffer_new (GEGL_RECTANGLE (0, 0, WIDTH / 2, HEIGHT / 2), babl_format ("cairo-ARGB32"));
  guint8        wanted[PIXELS];
  bool          good = celd_pipeline_make_relief (pipeline, NULL, NULL, NULL) &&
                       celd_pipeline_write_turned (pipeline, frame, CELD_LIVE_FRAMES, NULL, NULL, buffer, NULL);

  gegl_buffer_get (buffer, NULL, 1, babl_format ("cairo-ARGB32"), wanted, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  g_object_unref (buffer);
  celd_pipeline_free (pipeline);
  return good && !memcmp (wanted, pixels, sizeof wanted);
}

static CeldLiveRequest *
relief_request (void)
{
  CeldLiveRequest *request = page_request (1u << CELD_LIVE_RELIEF);

  request->relief_width  = WIDTH / 2;
  request->relief_height = HEIGHT / 2;
  return request;
}

/* From coarse to fine: whatever has come so far is spread over all of the turn. */
static void
the_relief_comes_in_all_positions (void)
{
  Turning          t = { .good = true };
  CeldLiveSolver  *solver = celd_live_solver_new (turned, &t);
  CeldLiveRequest *request = relief_request (), *copy = celd_live_request_copy (request);
  gint64           until = g_get_monotonic_time () + PATIENCE;
  int              times[CELD_LIVE_FRAMES] = { 0 };

  celd_live_solver_ask (solver, request);
  while (!t.done && g_get_monotonic_time () < until)
    g_main_context_iteration (NULL, TRUE);
  CHECK (t.good && t.n == CELD_LIVE_FRAMES);
  for (int i = 0; i < t.n; i++)
    times[t.frame[i]]++;
  for (int i = 0; i < CELD_LIVE_FRAMES; i++)
    CHECK (times[i] == 1);
  CHECK (t.frame[0] == CELD_LIVE_MIDDLE);
  CHECK (MIN (t.frame[1], t.frame[2]) == 0 && MAX (t.frame[1], t.frame[2]) == CELD_LIVE_FRAMES - 1);
  CHECK (t.last && is_frame (t.last, copy, t.frame[t.n - 1]));
  celd_live_solver_free (solver);
  celd_live_request_free (copy);
  g_free (t.last);
}

/* Asks for two more reliefs, each at the first frame of the one before: the first relief is given up then, and the
 * second one is made to its end although there is a newer request. */
typedef struct { CeldLiveSolver *solver; int asked, middles, n_early, n_last; } Chain;

static void
ask_at_the_middle (CeldLiveAnswer *answer, gpointer data)
{
  Chain *chain = data;

  if (answer->picture == CELD_LIVE_RELIEF && answer->pixels && answer->frame == CELD_LIVE_MIDDLE)
    chain->middles++;
  if (chain->asked < 3 && chain->middles == chain->asked)
    {
      chain->asked++;
      celd_live_solver_ask (chain->solver, relief_request ());
    }
  chain->n_early += answer->last && chain->middles < 3;
  chain->n_last += answer->last;
}

static void
only_the_newest_request_has_a_last_answer (void)
{
  Chain  chain = { .asked = 1 };
  gint64 until = g_get_monotonic_time () + PATIENCE;

  chain.solver = celd_live_solver_new (ask_at_the_middle, &chain);
  celd_live_solver_ask (chain.solver, relief_request ());
  while (!chain.n_last && g_get_monotonic_time () < until)
    g_main_context_iteration (NULL, TRUE);
  CHECK (chain.n_last && !chain.n_early);
  celd_live_solver_free (chain.solver);
}

/* ------------------------------------------------------------------ the end */

static void
count (CeldLiveAnswer *answer, gpointer data)
{
  int *answers = data;

  (void) answer;
  ++*answers;
}

/* In the middle of its work; nothing is delivered any more, whatever GEGL has left to do. */
static void
it_can_be_stopped_at_any_time (void)
{
  for (int i = 0; i < 20; i++)
    {
      int             answers = 0;
      CeldLiveSolver *solver = celd_live_solver_new (count, &answers);

      celd_live_solver_ask (solver, page_request (BIT (LIT)));
      g_usleep ((gulong) (1000 * i));
      celd_live_solver_free (solver);
      while (g_main_context_iteration (NULL, FALSE))
        ;
      CHECK (!answers);
    }
}

int
main (void)
{
  gegl_init (NULL, NULL);
  make_page ();
  RUN (regions_come_first_then_a_preview_then_depth);
  RUN (edits_give_what_a_new_pipeline_gives);
  RUN (the_newest_request_counts);
  RUN (depth_is_not_starved);
  RUN (input_without_sense_is_told_and_then_forgotten);
  RUN (problems_have_places);
  RUN (buffers_have_the_format_that_is_wanted);
  RUN (the_relief_comes_in_all_positions);
  RUN (only_the_newest_request_has_a_last_answer);
  RUN (it_can_be_stopped_at_any_time);
  drop_page ();
  gegl_exit ();
  return DONE;
}
