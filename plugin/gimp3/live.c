/* Live: a window that shows regions, depth and light while the artist paints with GIMP's own brushes.
 *
 * The plug-in stays open, and GIMP goes on: a tick reads the layers, the solver's thread makes pictures of what has
 * changed, and these are shown when they come.  The window has a process of its own, for the reason that live-send.c
 * gives.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "live.h"

#ifdef G_OS_UNIX
#include <sys/resource.h>
#endif

#define NICE      5   /* above GIMP's: GIMP comes first where processors are scarce; chosen */
#define TICK      40  /* milliseconds between ticks at least; chosen */
#define REST      8   /* times as long as a tick took until the next one, so that GIMP has time to paint; chosen */
#define MOST_REST 1000 /* milliseconds until the next one: a tick that waits for a busy GIMP takes seconds; chosen */
#define IDLE_TICK 120 /* milliseconds between ticks when nothing has changed for IDLE_AFTER microseconds; chosen */
#define IDLE_AFTER 3000000
#define SEARCHES  8   /* for a layer in vain, until it has gone; chosen */

typedef struct
{
  GimpImage        *image;
  const char       *sender;                     /* a procedure of the process that waits for the window to be closed */
  GMainLoop        *loop;
  CeldLiveFollower *follower;
  CeldLiveSolver   *solver;
  CeldLiveView     *view;
  CeldLiveMessages *messages;
  GtkWidget        *window, *choice, *write, *spinner;
  int               relief_width, relief_height; /* that the solver was asked for last */
  gboolean          ask;                        /* whether the solver has to be asked, whatever is changed */
  gboolean          waiting;                    /* for the last answer to what it was asked */
  const Babl       *format[CELD_N_PICTURES];    /* of pictures that are written into layers; NULL: not written */
  guint             layers;                     /* pictures that have had a layer since `write` was ticked, as bits */
  GeglBuffer       *written[CELD_N_PICTURES];   /* last into their layers; NULL: not yet */
  int               turn;                       /* the picture that was last written again */
  gint64            changed;                    /* when */
} Live;

/* Labels are those of front-end.c. */
static const CeldLivePictures views[] = {
  { N_ ("Regions and depth"), 2, { CELD_PICTURE_REGIONS, CELD_PICTURE_DEPTH }, FALSE },
  { N_ ("Regions"), 1, { CELD_PICTURE_REGIONS }, FALSE },
  { N_ ("Levels"), 1, { CELD_PICTURE_LEVELS }, FALSE },
  { N_ ("Depth"), 1, { CELD_PICTURE_DEPTH }, FALSE },
  { N_ ("Shading"), 1, { CELD_PICTURE_SHADING }, FALSE },
  { N_ ("Lit drawing"), 1, { CELD_PICTURE_LIT }, FALSE },
  { N_ ("Drawing with shadows"), 1, { CELD_PICTURE_ENHANCED }, FALSE },
  { N_ ("Stereo"), 1, { CELD_LIVE_STEREO }, FALSE },
  { N_ ("Wiggle"), 2, { CELD_LIVE_LEFT, CELD_LIVE_RIGHT }, TRUE },
  { N_ ("Turning relief"), 1, { CELD_LIVE_RELIEF }, FALSE },
};

static const CeldLivePictures *
chosen_view (const Live *live)
{
  return &views[MAX (gtk_combo_box_get_active (GTK_COMBO_BOX (live->choice)), 0)];
}

/* ------------------------------------------------------------------ answers */

static void
add_message (GArray *list, char *text)
{
  g_array_append_val (list, ((CeldPipelineProblem) { text, -1, -1 }));
}

/* Shows one sentence alone. */
static void
show_sentence (Live *live, const char *text)
{
  GArray *list = g_array_new (FALSE, FALSE, sizeof (CeldPipelineProblem));

  add_message (list, (char *) text);
  celd_live_messages_set (live->messages, list);
  g_array_unref (list);
}

static void
show_problems (Live *live, GArray *problems)
{
  int left_out = celd_live_follower_left_out (live->follower);

  if (left_out)
    add_message (problems, celd_paths_left_out_text (left_out));
  celd_live_messages_set (live->messages, problems);
}

/* A layer that has gone is not made again, or it would come back at once. */
static void
write_picture (Live *live, CeldPicture picture, GeglBuffer *buffer)
{
  CeldLiveTarget target = { live->image, celd_live_follower_image (live->follower), live->sender };

  celd_live_write (&target, picture, buffer, !(live->layers & 1u << picture));
  live->layers |= 1u << picture;
  gimp_displays_flush ();
}

/* A CeldLiveAnswered. */
static void
answered (CeldLiveAnswer *answer, gpointer data)
{
  Live *live = data;

  if (answer->pixels)
    celd_live_view_put (live->view, answer);
  if (answer->buffer && live->format[answer->picture] && gimp_image_is_valid (live->image))
    {
      write_picture (live, (CeldPicture) answer->picture, answer->buffer);
      g_set_object (&live->written[answer->picture], answer->buffer);
    }
  if (answer->problems)
    show_problems (live, answer->problems);
  if (answer->error)
    show_sentence (live, answer->error);
  if (answer->last)
    {
      live->waiting = FALSE;
      gtk_spinner_stop (GTK_SPINNER (live->spinner));
    }
}

/* ------------------------------------------------------------------ what is written */

/* Whether there is no layer of a picture.  GIMP answers for one layer at a time, so that one which is being replaced
 * may not be found; but not so many times. */
static gboolean
has_gone (GimpImage *image, int picture)
{
  for (int search = 0; search < SEARCHES; search++)
    if (celd_results_find (image, celd_pictures[picture].argument))
      return FALSE;
  return TRUE;
}

/* Looks for the layers that are written: those that the group has, and those of what is shown.  A layer that has gone
 * was removed, or its making undone: then nothing is written any more. */
static void
look_for_layers (Live *live)
{
  const CeldLivePictures *view = chosen_view (live);
  const Babl             *format[CELD_N_PICTURES] = { NULL };
  gboolean                gone = FALSE;

  for (int picture = 0; picture < CELD_POPUP_PICTURES; picture++)
    {
      format[picture] = celd_live_write_format (live->image, (CeldPicture) picture);
      gone            = gone || (live->layers & 1u << picture && !format[picture] && has_gone (live->image, picture));
      live->layers   |= format[picture] ? 1u << picture : 0;
    }
  for (int i = 0; i < view->n; i++)
    if (view->picture[i] < CELD_POPUP_PICTURES && !format[view->picture[i]])
      format[view->picture[i]] = celd_live_write_new_format (live->image, (CeldPicture) view->picture[i]);
  for (int picture = 0; picture < CELD_N_PICTURES; picture++)
    {
      live->ask            = live->ask || format[picture] != live->format[picture];
      live->format[picture] = format[picture];
      if (!format[picture])
        g_clear_object (&live->written[picture]);
    }
  if (gone)
    gtk_toggle_button_set_active (GTK_TOGGLE_BUTTON (live->write), FALSE);
}

static void
forget_pictures (Live *live)
{
  live->layers = 0;
  for (int picture = 0; picture < CELD_N_PICTURES; picture++)
    {
      live->format[picture] = NULL;
      g_clear_object (&live->written[picture]);
    }
}

static void
write_toggled (GtkToggleButton *button, gpointer data)
{
  Live *live = data;

  forget_pictures (live);
  if (gtk_toggle_button_get_active (button))
    look_for_layers (live);
}

/* Writes one of the pictures again.  A layer that was replaced, resized, locked or painted on, by the artist or by
 * another plug-in, may not have what was written: that may have gone into the one before, or been lost since.  Nothing
 * but its pixels tells.  A layer that has the picture is only read. */
static void
write_again (Live *live)
{
  for (int i = 0; i < CELD_N_PICTURES; i++)
    {
      live->turn = (live->turn + 1) % CELD_N_PICTURES;
      if (live->written[live->turn])
        {
          write_picture (live, (CeldPicture) live->turn, live->written[live->turn]);
          return;
        }
    }
}

/* ------------------------------------------------------------------ the tick */

static void
ask (Live *live)
{
  CeldLiveRequest        *request = celd_live_follower_request (live->follower);
  const CeldLivePictures *view = chosen_view (live);

  for (int i = 0; i < view->n; i++)
    if (view->picture[i] != CELD_LIVE_RELIEF || live->relief_width)
      request->shown |= 1u << view->picture[i];
  request->relief_width  = live->relief_width;
  request->relief_height = live->relief_height;
  for (int picture = 0; picture < CELD_N_PICTURES; picture++)
    request->format[picture] = live->format[picture];
  celd_live_solver_ask (live->solver, request);
  gtk_spinner_start (GTK_SPINNER (live->spinner));
  live->ask     = FALSE;
  live->waiting = TRUE;
}

/* Nothing of the relief is made while nobody sees it, and it is made as large as it is seen. */
static void
look_at_view (Live *live)
{
  int width, height;

  celd_live_view_tick (live->view);
  celd_live_view_relief_size (live->view, gimp_image_get_width (live->image), gimp_image_get_height (live->image),
                              &width, &height);
  live->ask           = live->ask || width != live->relief_width || height != live->relief_height;
  live->relief_width  = width;
  live->relief_height = height;
}

/* FALSE: the image has been closed. */
static gboolean
follow (Live *live)
{
  GError      *error = NULL;
  gboolean     looked;
  CeldLiveNews news = celd_live_follow (live->follower, &looked, &error);

  if (news == CELD_LIVE_CLOSED)
    return FALSE;
  if (news == CELD_LIVE_REFUSED)
    {
      show_sentence (live, error->message);
      g_clear_error (&error);
      live->ask = TRUE; /* as soon as it is not */
      return TRUE;
    }
  if (looked && gtk_toggle_button_get_active (GTK_TOGGLE_BUTTON (live->write)))
    look_for_layers (live);
  if (news == CELD_LIVE_CHANGED)
    live->changed = g_get_monotonic_time ();
  look_at_view (live);
  if (news == CELD_LIVE_CHANGED || live->ask)
    ask (live);
  else if (looked && !live->waiting)
    write_again (live);
  return TRUE;
}

static gboolean
tick (gpointer data)
{
  Live  *live = data;
  gint64 begin = g_get_monotonic_time (), end, rest;

  if (!follow (live))
    {
      g_main_loop_quit (live->loop);
      return G_SOURCE_REMOVE;
    }
  end  = g_get_monotonic_time ();
  rest = MIN (REST * (end - begin) / 1000, MOST_REST);
  g_timeout_add ((guint) MAX (end - live->changed > IDLE_AFTER ? IDLE_TICK : TICK, rest), tick, live);
  return G_SOURCE_REMOVE;
}

/* ------------------------------------------------------------------ the window */

static void
view_chosen (GtkComboBox *choice, gpointer data)
{
  Live *live = data;

  (void) choice;
  celd_live_view_choose (live->view, chosen_view (live));
  if (gtk_toggle_button_get_active (GTK_TOGGLE_BUTTON (live->write)))
    look_for_layers (live);
  live->ask = TRUE;
}

static GtkWidget *
make_bar (Live *live)
{
  GtkWidget *bar = gtk_box_new (GTK_ORIENTATION_HORIZONTAL, 12);

  live->choice  = gtk_combo_box_text_new ();
  live->write   = gtk_check_button_new_with_mnemonic (_ ("_Write into layers"));
  live->spinner = gtk_spinner_new ();
  for (gsize i = 0; i < G_N_ELEMENTS (views); i++)
    gtk_combo_box_text_append_text (GTK_COMBO_BOX_TEXT (live->choice), _ (views[i].label));
  gtk_combo_box_set_active (GTK_COMBO_BOX (live->choice), 0);
  gtk_widget_set_tooltip_text (live->choice, _ ("What is shown"));
  gtk_widget_set_tooltip_text (live->write, _ ("Keeps the layers of the group Cartoon Depth, and those of what is "
                                               "shown, up to date. Edit > Undo takes back your own strokes alone"));
  gtk_box_pack_start (GTK_BOX (bar), live->choice, FALSE, FALSE, 0);
  gtk_box_pack_start (GTK_BOX (bar), live->write, FALSE, FALSE, 0);
  gtk_box_pack_end (GTK_BOX (bar), live->spinner, FALSE, FALSE, 0);
  g_signal_connect (live->choice, "changed", G_CALLBACK (view_chosen), live);
  g_signal_connect (live->write, "toggled", G_CALLBACK (write_toggled), live);
  return bar;
}

/* What is in the window is still there. */
static void
window_closed (GtkWidget *window, gpointer data)
{
  Live *live = data;

  (void) window;
  live->window = NULL;
  celd_live_messages_set (live->messages, NULL); /* so that none is unselected when there is no view any more */
  g_main_loop_quit (live->loop);
}

/* Above GIMP's window, which keeps the keyboard. */
static void
open_window (Live *live)
{
  GtkWidget *box = gtk_box_new (GTK_ORIENTATION_VERTICAL, 6);
  char      *name = gimp_image_get_name (live->image), *title = g_strdup_printf (_ ("Live: %s"), name);

  live->window   = gtk_window_new (GTK_WINDOW_TOPLEVEL);
  live->view     = celd_live_view_new ();
  live->messages = celd_live_messages_new (live->view);
  gtk_window_set_title (GTK_WINDOW (live->window), title);
  gtk_window_set_role (GTK_WINDOW (live->window), "celdepth-live");
  gtk_window_set_type_hint (GTK_WINDOW (live->window), GDK_WINDOW_TYPE_HINT_UTILITY);
  gtk_window_set_focus_on_map (GTK_WINDOW (live->window), FALSE);
  gtk_window_set_default_size (GTK_WINDOW (live->window), 640, 420);
  gtk_container_set_border_width (GTK_CONTAINER (live->window), 6);
  gtk_box_pack_start (GTK_BOX (box), make_bar (live), FALSE, FALSE, 0);
  gtk_box_pack_start (GTK_BOX (box), celd_live_view_widget (live->view), TRUE, TRUE, 0);
  gtk_box_pack_start (GTK_BOX (box), celd_live_messages_widget (live->messages), FALSE, FALSE, 0);
  gtk_container_add (GTK_CONTAINER (live->window), box);
  celd_live_view_choose (live->view, chosen_view (live));
  g_signal_connect (live->window, "destroy", G_CALLBACK (window_closed), live);
  gimp_window_set_transient (GTK_WINDOW (live->window));
  gtk_widget_show_all (live->window);
  g_free (title);
  g_free (name);
}

static void
show_window (GimpImage *image, const char *sender, GimpProcedureConfig *config)
{
  Live live = { .image = image, .sender = sender, .loop = g_main_loop_new (NULL, FALSE) };

  gimp_ui_init ("celdepth");
  live.follower = celd_live_follower_new (image, config);
  live.solver   = celd_live_solver_new (answered, &live);
  open_window (&live);
  g_timeout_add (TICK, tick, &live);
  g_main_loop_run (live.loop);
  celd_live_solver_free (live.solver);
  if (live.window)
    gtk_widget_destroy (live.window);
  celd_live_follower_free (live.follower);
  forget_pictures (&live);
  g_main_loop_unref (live.loop);
}

/* ------------------------------------------------------------------ the process of the window */

static GimpValueArray *
run_window (GimpProcedure *procedure, GimpProcedureConfig *config, gpointer run_data)
{
  GimpImage *image;
  char      *sender;
  int        number;

  (void) run_data;
#ifdef G_OS_UNIX
  setpriority (PRIO_PROCESS, 0, getpriority (PRIO_PROCESS, 0) + NICE); /* also of threads that are made from now on */
#endif
  /* An item may go between any two calls: that is no error which the artist has to hear of. */
  gimp_plug_in_set_pdb_error_handler (gimp_get_plug_in (), GIMP_PDB_ERROR_HANDLER_PLUGIN);
  gegl_init (NULL, NULL);
  g_object_get (config, "image", &number, "sender", &sender, NULL);
  image = gimp_image_get_by_id (number);
  if (image)
    show_window (image, sender, config);
  g_free (sender);
  return gimp_procedure_new_return_values (procedure, GIMP_PDB_SUCCESS, NULL);
}

/* Only Live calls it, and nobody reads its texts but in the Procedure Browser: they are not translated. */
GimpProcedure *
celd_live_window_create (GimpPlugIn *plug_in)
{
  GimpProcedure *procedure = gimp_procedure_new (plug_in, CELD_LIVE_WINDOW, GIMP_PDB_PROC_TYPE_PLUGIN, run_window, NULL,
                                                 NULL);

  gimp_procedure_set_documentation (procedure, "A part of Live: its window", "Returns when the window is closed.",
                                    NULL);
  gimp_procedure_set_attribution (procedure, "The authors of celdepth", "LGPL-3.0-or-later", "2026");
  gimp_procedure_add_int_argument (procedure, "image", "Image", "The number of the image that is followed", 0, G_MAXINT,
                                   0, G_PARAM_READWRITE);
  gimp_procedure_add_string_argument (procedure, "sender", "Sender", "The procedure that brings pixels into a layer",
                                      "", G_PARAM_READWRITE);
  celd_settings_add_arguments (procedure, CELD_FOR_LIVE);
  return procedure;
}

/* ------------------------------------------------------------------ the procedure */

/* This process waits for the window to be closed, and meanwhile writes what that has it write.  GIMP may end it at
 * that, and the window stays.  The image is given by its number: GIMP does not close an image before a call that has it
 * returns. */
static GimpValueArray *
run (GimpProcedure *procedure, GimpRunMode run_mode, GimpImage *image, GimpDrawable **drawables,
     GimpProcedureConfig *config, gpointer run_data)
{
  GimpPlugIn     *plug_in = gimp_get_plug_in ();
  GError         *error = NULL;
  GimpValueArray *values;
  GimpProcedure  *sender, *window;

  (void) drawables;
  (void) config;
  (void) run_data;
  if (run_mode == GIMP_RUN_NONINTERACTIVE)
    {
      g_set_error_literal (&error, CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED,
                           _ ("Live is a window for artists. Scripts use plug-in-celdepth-popup."));
      return gimp_procedure_new_return_values (procedure, GIMP_PDB_CALLING_ERROR, error);
    }
  gimp_plug_in_set_pdb_error_handler (plug_in, GIMP_PDB_ERROR_HANDLER_PLUGIN);
  sender = celd_live_send_create_here (plug_in);
  window = gimp_pdb_lookup_procedure (gimp_get_pdb (), CELD_LIVE_WINDOW);
  values = gimp_procedure_run (window, "image", gimp_image_get_id (image), "sender",
                               gimp_procedure_get_name (sender), NULL);
  gimp_value_array_unref (values);
  g_object_unref (sender);
  return gimp_procedure_new_return_values (procedure, GIMP_PDB_SUCCESS, NULL);
}

const CeldProcedure celd_live_procedure = {
  .name       = "plug-in-celdepth-live",
  .menu_label = N_ ("_Live..."),
  .blurb      = N_ ("Shows regions, depth and light in a window beside the canvas, while you paint"),
  .help       = N_ ("Follows the layers Drawing, Scribbles, Arrows, Contours, Corrections and Hidden in mid-stroke, "
                    "with the settings that are kept with the image. The window closes with the image."),
  .run        = run,
};
