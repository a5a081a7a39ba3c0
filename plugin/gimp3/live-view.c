/* The pictures of Live, side by side or above each other, fitted to the window, and the place of a message on them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "live.h"

#include <math.h>

#define GAP        6    /* pixels between pictures; chosen */
#define RING       12   /* pixels, the radius of the ring round a place; chosen */
#define LEAST_SIZE 240  /* pixels of the area; chosen */
#define TURN       300  /* milliseconds for which each of pictures in turn is seen; chosen */
#define FRAME      40   /* the same of the relief; chosen */

struct CeldLiveView
{
  GtkWidget              *area;
  const CeldLivePictures *shown, *chosen;                  /* `chosen` is shown as soon as there is one of it */
  cairo_surface_t        *surface[CELD_LIVE_N_PICTURES];   /* NULL: there is none */
  double                  scale[CELD_LIVE_N_PICTURES];     /* pixels of the image that one of the surface is wide */
  int                     mark_x, mark_y;                  /* in the image; x < 0: none */
  int                     turn;                            /* the picture that is seen, of those in turn */
  CeldLiveTurn           *relief;
  guint                   timer;                           /* for the next one of what moves; 0: nothing does */
  gboolean                covered;                         /* is the area, by other windows? */
};

/* What is shown before there is anything else. */
static const CeldLivePictures at_first = { NULL, 1, { CELD_PICTURE_REGIONS }, FALSE };

/* ------------------------------------------------------------------ drawing */

static cairo_surface_t *
surface_of (const CeldLiveView *view, int i)
{
  int picture = view->shown->picture[i];

  return picture == CELD_LIVE_RELIEF ? celd_live_turn_surface (view->relief) : view->surface[picture];
}

/* The size of a picture in pixels of the image. */
static void
get_size (const CeldLiveView *view, int i, double *width, double *height)
{
  double           scale = view->scale[view->shown->picture[i]];
  cairo_surface_t *surface = surface_of (view, i);

  *width  = scale * cairo_image_surface_get_width (surface);
  *height = scale * cairo_image_surface_get_height (surface);
}

/* How much pictures of this size are to be enlarged to fit into a row, or a column, of n. */
static double
fit (double width, double height, int n, gboolean row, double room_x, double room_y)
{
  double gap = GAP * (n - 1);

  if (row)
    return MIN ((room_x - gap) / (n * width), room_y / height);
  return MIN (room_x / width, (room_y - gap) / (n * height));
}

static void
draw_mark (const CeldLiveView *view, cairo_t *cr, double zoom)
{
  double x = (view->mark_x + 0.5) * zoom, y = (view->mark_y + 0.5) * zoom;

  for (int outline = 1; outline >= 0; outline--)
    {
      cairo_set_line_width (cr, outline ? 5 : 2.5);
      cairo_set_source_rgb (cr, 1, outline, outline);
      cairo_new_sub_path (cr);
      cairo_arc (cr, x, y, RING, 0, 2 * G_PI);
      cairo_move_to (cr, x, y);
      cairo_line_to (cr, x, y);
      cairo_set_line_cap (cr, CAIRO_LINE_CAP_ROUND);
      cairo_stroke (cr);
    }
}

/* At the origin; transparent pixels are grey.  Enlarged pixels stay sharp. */
static void
draw_picture (const CeldLiveView *view, cairo_t *cr, int i, double zoom)
{
  double width, height, scale = zoom * view->scale[view->shown->picture[i]];

  get_size (view, i, &width, &height);
  if (fabs (scale - 1) * width < view->scale[view->shown->picture[i]])
    scale = 1; /* made in this size */
  cairo_rectangle (cr, 0, 0, width * zoom, height * zoom);
  cairo_set_source_rgb (cr, 0.6, 0.6, 0.6);
  cairo_fill (cr);
  cairo_save (cr);
  cairo_scale (cr, scale, scale);
  cairo_set_source_surface (cr, surface_of (view, i), 0, 0);
  cairo_pattern_set_filter (cairo_get_source (cr), scale < 1 ? CAIRO_FILTER_GOOD : CAIRO_FILTER_NEAREST);
  cairo_paint (cr);
  cairo_restore (cr);
  if (view->mark_x >= 0 && view->shown->picture[i] < CELD_LIVE_STEREO)
    draw_mark (view, cr, zoom);
}

/* How the pictures lie: by a row or a column of so many, each width x height pixels of the window large. */
typedef struct { gboolean row; double zoom, width, height; } Layout;

/* Not enlarged: pixels are seen as GIMP shows them at 100 %. */
static Layout
arrange (const CeldLiveView *view, int n, double room_x, double room_y)
{
  double width, height, row, column, zoom;

  get_size (view, 0, &width, &height);
  row    = fit (width, height, n, TRUE, room_x, room_y);
  column = fit (width, height, n, FALSE, room_x, room_y);
  zoom   = MIN (MAX (row, column), 1);
  return (Layout) { row >= column, zoom, width * zoom, height * zoom };
}

/* What is left of n items of this size, and gaps between them, on each side; whole pixels keep pictures sharp. */
static double
margin (double room, int n, double size)
{
  return floor (MAX (room - n * size - (n - 1) * GAP, 0) / 2);
}

static gboolean
draw (GtkWidget *area, cairo_t *cr, gpointer data)
{
  const CeldLiveView *view = data;
  double              room_x = gtk_widget_get_allocated_width (area), room_y = gtk_widget_get_allocated_height (area);
  int                 n = view->shown->in_turn ? 1 : view->shown->n, first = view->shown->in_turn ? view->turn : 0;
  Layout              l;

  if (!surface_of (view, 0))
    return FALSE;
  l = arrange (view, n, room_x, room_y);
  cairo_translate (cr, margin (room_x, l.row ? n : 1, l.width), margin (room_y, l.row ? 1 : n, l.height));
  for (int i = first; i < first + n && surface_of (view, i); i++)
    {
      draw_picture (view, cr, i, l.zoom);
      cairo_translate (cr, l.row ? ceil (l.width) + GAP : 0, l.row ? 0 : ceil (l.height) + GAP);
    }
  return FALSE;
}

/* ------------------------------------------------------------------ what is shown */

static gboolean
has (const CeldLivePictures *pictures, int picture)
{
  for (int i = 0; i < pictures->n; i++)
    if (pictures->picture[i] == picture)
      return TRUE;
  return FALSE;
}

static gboolean
is_relief (const CeldLivePictures *pictures)
{
  return has (pictures, CELD_LIVE_RELIEF);
}

static gboolean
is_seen (const CeldLiveView *view)
{
  GdkWindow *window = gtk_widget_get_window (gtk_widget_get_toplevel (view->area));

  return window && gtk_widget_get_mapped (view->area) && !view->covered &&
         !(gdk_window_get_state (window) & (GDK_WINDOW_STATE_ICONIFIED | GDK_WINDOW_STATE_WITHDRAWN));
}

static gboolean
take_turn (gpointer data)
{
  CeldLiveView *view = data;

  view->turn = (view->turn + 1) % view->shown->n;
  celd_live_turn_step (view->relief);
  gtk_widget_queue_draw (view->area);
  return G_SOURCE_CONTINUE;
}

void
celd_live_view_tick (CeldLiveView *view)
{
  gboolean moves = is_relief (view->shown) || view->shown->in_turn;

  if (!moves || !is_seen (view))
    g_clear_handle_id (&view->timer, g_source_remove);
  else if (!view->timer)
    view->timer = g_timeout_add (is_relief (view->shown) ? FRAME : TURN, take_turn, view);
}

void
celd_live_view_relief_size (const CeldLiveView *view, int image_width, int image_height, int *width, int *height)
{
  double room_x = gtk_widget_get_allocated_width (view->area), room_y = gtk_widget_get_allocated_height (view->area);
  double zoom = MIN (fit (image_width, image_height, 1, TRUE, room_x, room_y), 1);
  gboolean wanted = is_relief (view->chosen) && is_seen (view);

  *width  = wanted ? MAX ((int) (image_width * zoom), 1) : 0;
  *height = wanted ? MAX ((int) (image_height * zoom), 1) : 0;
}

/* Pictures that are not shown are freed: they would be old when they are shown again. */
static void
set_shown (CeldLiveView *view, const CeldLivePictures *pictures)
{
  view->shown = pictures;
  view->turn  = 0;
  g_clear_handle_id (&view->timer, g_source_remove); /* the next tick sets the one of these pictures */
  celd_live_turn_clear (view->relief);
  for (int picture = 0; picture < CELD_LIVE_N_PICTURES; picture++)
    if (!has (pictures, picture))
      g_clear_pointer (&view->surface[picture], cairo_surface_destroy);
}

void
celd_live_view_choose (CeldLiveView *view, const CeldLivePictures *pictures)
{
  view->chosen = pictures;
}

void
celd_live_view_put (CeldLiveView *view, CeldLiveAnswer *answer)
{
  static const cairo_user_data_key_t pixels;
  int                                picture = answer->picture;
  cairo_surface_t                   *surface;

  if (has (view->chosen, picture) && view->shown != view->chosen)
    set_shown (view, view->chosen);
  if (!has (view->shown, picture))
    return;
  surface = cairo_image_surface_create_for_data (answer->pixels, CAIRO_FORMAT_ARGB32, answer->width, answer->height,
                                                 4 * answer->width);
  cairo_surface_set_user_data (surface, &pixels, answer->pixels, g_free);
  answer->pixels = NULL;
  g_clear_pointer (&view->surface[picture], cairo_surface_destroy);
  if (picture == CELD_LIVE_RELIEF)
    celd_live_turn_put (view->relief, answer->frame, surface);
  else
    view->surface[picture] = surface;
  view->scale[picture] = answer->scale;
  gtk_widget_queue_draw (view->area);
}

void
celd_live_view_mark (CeldLiveView *view, int x, int y)
{
  view->mark_x = x;
  view->mark_y = y;
  gtk_widget_queue_draw (view->area);
}

/* ------------------------------------------------------------------ the widget */

static gboolean
visibility_changed (GtkWidget *area, const GdkEventVisibility *event, gpointer data)
{
  CeldLiveView *view = data;

  (void) area;
  view->covered = event->state == GDK_VISIBILITY_FULLY_OBSCURED;
  return FALSE;
}

static void
destroy (gpointer data)
{
  CeldLiveView *view = data;

  g_clear_handle_id (&view->timer, g_source_remove);
  for (int picture = 0; picture < CELD_LIVE_N_PICTURES; picture++)
    g_clear_pointer (&view->surface[picture], cairo_surface_destroy);
  celd_live_turn_free (view->relief);
  g_free (view);
}

CeldLiveView *
celd_live_view_new (void)
{
  CeldLiveView *view = g_new0 (CeldLiveView, 1);

  view->shown  = &at_first;
  view->chosen = &at_first;
  view->mark_x = -1;
  view->area   = gtk_drawing_area_new ();
  view->relief = celd_live_turn_new (view->area);
  gtk_widget_set_size_request (view->area, LEAST_SIZE, LEAST_SIZE);
  gtk_widget_add_events (view->area, GDK_VISIBILITY_NOTIFY_MASK);
  g_signal_connect (view->area, "visibility-notify-event", G_CALLBACK (visibility_changed), view);
  g_signal_connect (view->area, "draw", G_CALLBACK (draw), view);
  g_object_set_data_full (G_OBJECT (view->area), "view", view, destroy);
  return view;
}

GtkWidget *
celd_live_view_widget (CeldLiveView *view)
{
  return view->area;
}
