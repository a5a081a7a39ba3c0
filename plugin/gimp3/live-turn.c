/* The relief of Live that turns to and fro, or as the mouse drags it: a picture for each of its positions, made by the
 * solver's thread, so that turning itself only shows one after the other.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "live.h"

struct CeldLiveTurn
{
  cairo_surface_t *frame[CELD_LIVE_FRAMES];  /* NULL: it has not come yet */
  int              at;                       /* the position that is seen */
  int              direction;                /* 1 or -1, of turning by itself */
  gboolean         dragged;
  double           drag_x;                   /* where the mouse was at position `drag_at`, in pixels of the area */
  int              drag_at;
};

/* ------------------------------------------------------------------ pictures */

void
celd_live_turn_clear (CeldLiveTurn *turn)
{
  for (int i = 0; i < CELD_LIVE_FRAMES; i++)
    g_clear_pointer (&turn->frame[i], cairo_surface_destroy);
}

/* With the first picture of an edit those of the one before have become old. */
void
celd_live_turn_put (CeldLiveTurn *turn, int frame, cairo_surface_t *surface)
{
  if (frame == CELD_LIVE_MIDDLE)
    celd_live_turn_clear (turn);
  g_clear_pointer (&turn->frame[frame], cairo_surface_destroy);
  turn->frame[frame] = surface;
}

cairo_surface_t *
celd_live_turn_surface (const CeldLiveTurn *turn)
{
  for (int away = 0; away < CELD_LIVE_FRAMES; away++)
    for (int side = -1; side <= 1; side += 2)
      {
        int i = turn->at + side * away;

        if (i >= 0 && i < CELD_LIVE_FRAMES && turn->frame[i])
          return turn->frame[i];
      }
  return NULL;
}

/* ------------------------------------------------------------------ turning */

void
celd_live_turn_step (CeldLiveTurn *turn)
{
  if (turn->dragged)
    return;
  if (turn->at == 0 || turn->at == CELD_LIVE_FRAMES - 1)
    turn->direction = turn->at ? -1 : 1;
  turn->at += turn->direction;
}

static gboolean
button_pressed (GtkWidget *area, const GdkEventButton *event, gpointer data)
{
  CeldLiveTurn *turn = data;

  (void) area;
  if (event->button != GDK_BUTTON_PRIMARY || !celd_live_turn_surface (turn))
    return FALSE;
  turn->dragged = TRUE;
  turn->drag_x  = event->x;
  turn->drag_at = turn->at;
  return TRUE;
}

/* What is near follows the mouse; half of the area turns from one end to the other. */
static gboolean
mouse_moved (GtkWidget *area, const GdkEventMotion *event, gpointer data)
{
  CeldLiveTurn *turn = data;
  double        moved = 2 * (event->x - turn->drag_x) / gtk_widget_get_allocated_width (area);

  if (!turn->dragged)
    return FALSE;
  turn->at = CLAMP (turn->drag_at - (int) (moved * (CELD_LIVE_FRAMES - 1)), 0, CELD_LIVE_FRAMES - 1);
  gtk_widget_queue_draw (area);
  return TRUE;
}

static gboolean
button_released (GtkWidget *area, const GdkEventButton *event, gpointer data)
{
  CeldLiveTurn *turn = data;

  (void) area;
  if (event->button == GDK_BUTTON_PRIMARY)
    turn->dragged = FALSE;
  return FALSE;
}

CeldLiveTurn *
celd_live_turn_new (GtkWidget *area)
{
  CeldLiveTurn *turn = g_new0 (CeldLiveTurn, 1);

  turn->at        = CELD_LIVE_MIDDLE;
  turn->direction = 1;
  gtk_widget_add_events (area, GDK_BUTTON_PRESS_MASK | GDK_BUTTON_RELEASE_MASK | GDK_BUTTON1_MOTION_MASK);
  g_signal_connect (area, "button-press-event", G_CALLBACK (button_pressed), turn);
  g_signal_connect (area, "motion-notify-event", G_CALLBACK (mouse_moved), turn);
  g_signal_connect (area, "button-release-event", G_CALLBACK (button_released), turn);
  return turn;
}

void
celd_live_turn_free (CeldLiveTurn *turn)
{
  celd_live_turn_clear (turn);
  g_free (turn);
}
