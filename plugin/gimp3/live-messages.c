/* The list of messages of Live.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "live.h"

#define HEIGHT 110 /* pixels of the list; chosen */

struct CeldLiveMessages
{
  GtkWidget    *scrolled, *list;
  CeldLiveView *view;
  GArray       *shown;           /* CeldPipelineProblem; the places of the rows */
};

static void
mark_selected (GtkListBox *list, GtkListBoxRow *row, gpointer data)
{
  CeldLiveMessages          *m = data;
  int                        index = row ? gtk_list_box_row_get_index (row) : -1;
  const CeldPipelineProblem *problem = index < 0 ? NULL : &g_array_index (m->shown, CeldPipelineProblem, index);

  (void) list;
  celd_live_view_mark (m->view, problem ? problem->x : -1, problem ? problem->y : -1);
}

static gboolean
same (const GArray *a, const GArray *b)
{
  for (guint i = 0; i < a->len && a->len == b->len; i++)
    {
      const CeldPipelineProblem *p = &g_array_index (a, CeldPipelineProblem, i);
      const CeldPipelineProblem *q = &g_array_index (b, CeldPipelineProblem, i);

      if (p->x != q->x || p->y != q->y || g_strcmp0 (p->text, q->text))
        return FALSE;
    }
  return a->len == b->len;
}

static void
clear_problem (gpointer problem)
{
  g_free (((CeldPipelineProblem *) problem)->text);
}

static GArray *
copy (const GArray *problems)
{
  GArray *copied = g_array_new (FALSE, FALSE, sizeof (CeldPipelineProblem));

  g_array_set_clear_func (copied, clear_problem);
  for (guint i = 0; problems && i < problems->len; i++)
    {
      CeldPipelineProblem problem = g_array_index (problems, CeldPipelineProblem, i);

      problem.text = g_strdup (problem.text);
      g_array_append_val (copied, problem);
    }
  return copied;
}

static void
add_row (CeldLiveMessages *m, const CeldPipelineProblem *problem)
{
  GtkWidget *label = gtk_label_new (problem->text);

  gtk_label_set_xalign (GTK_LABEL (label), 0);
  gtk_label_set_line_wrap (GTK_LABEL (label), TRUE);
  gtk_widget_set_margin_start (label, 6);
  gtk_widget_set_margin_end (label, 6);
  gtk_container_add (GTK_CONTAINER (m->list), label);
}

/* The text of the selected message, to be freed; NULL: none is. */
static char *
selected_text (const CeldLiveMessages *m)
{
  GtkListBoxRow *row = gtk_list_box_get_selected_row (GTK_LIST_BOX (m->list));

  return row ? g_strdup (g_array_index (m->shown, CeldPipelineProblem, gtk_list_box_row_get_index (row)).text) : NULL;
}

static void
replace_rows (CeldLiveMessages *m, GArray *problems)
{
  char  *selected = selected_text (m);
  GList *rows = gtk_container_get_children (GTK_CONTAINER (m->list));

  gtk_list_box_unselect_all (GTK_LIST_BOX (m->list));
  g_list_free_full (rows, (GDestroyNotify) gtk_widget_destroy);
  g_array_unref (m->shown);
  m->shown = problems;
  for (guint i = 0; i < problems->len; i++)
    add_row (m, &g_array_index (problems, CeldPipelineProblem, i));
  gtk_widget_show_all (m->list);
  for (guint i = 0; selected && i < problems->len; i++)
    if (!g_strcmp0 (selected, g_array_index (problems, CeldPipelineProblem, i).text))
      gtk_list_box_select_row (GTK_LIST_BOX (m->list), gtk_list_box_get_row_at_index (GTK_LIST_BOX (m->list), (int) i));
  g_free (selected);
}

void
celd_live_messages_set (CeldLiveMessages *m, const GArray *problems)
{
  GArray *shown = copy (problems);

  if (same (shown, m->shown))
    g_array_unref (shown);
  else
    replace_rows (m, shown);
  gtk_widget_set_visible (m->scrolled, m->shown->len > 0);
}

static void
destroy (gpointer data)
{
  CeldLiveMessages *m = data;

  g_array_unref (m->shown);
  g_free (m);
}

CeldLiveMessages *
celd_live_messages_new (CeldLiveView *view)
{
  CeldLiveMessages *m = g_new0 (CeldLiveMessages, 1);

  m->view     = view;
  m->shown    = copy (NULL);
  m->list     = gtk_list_box_new ();
  m->scrolled = gtk_scrolled_window_new (NULL, NULL);
  gtk_scrolled_window_set_policy (GTK_SCROLLED_WINDOW (m->scrolled), GTK_POLICY_NEVER, GTK_POLICY_AUTOMATIC);
  gtk_scrolled_window_set_min_content_height (GTK_SCROLLED_WINDOW (m->scrolled), HEIGHT);
  gtk_scrolled_window_set_shadow_type (GTK_SCROLLED_WINDOW (m->scrolled), GTK_SHADOW_IN);
  gtk_container_add (GTK_CONTAINER (m->scrolled), m->list);
  gtk_widget_set_no_show_all (m->scrolled, TRUE);
  g_signal_connect (m->list, "row-selected", G_CALLBACK (mark_selected), m);
  g_object_set_data_full (G_OBJECT (m->scrolled), "messages", m, destroy);
  return m;
}

GtkWidget *
celd_live_messages_widget (CeldLiveMessages *m)
{
  return m->scrolled;
}
