/* Operations keep basins between calls while the drawing does not change, and share nothing with other operations; and
 * the pictures of closures and problems.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "listen.h"
#include "page.h"
#include "properties.h"
#include "session/session.h"

#define SEGMENT "celdepth:lazybrush-segment"

static uint8_t result[4 * PIXELS], wanted[4 * PIXELS];

/* The drawing with a gap in the left disc's outline, and scribbles in other places. */
static float   open_luma[PIXELS];
static uint8_t other_scribbles[4 * PIXELS];

static GeglBuffer *open_drawing, *other;

static void
make_others (void)
{
  memcpy (open_luma, page_luma, sizeof open_luma);
  for (int y = 35; y < 45; y++)
    for (int x = 18; x < 26; x++)
      open_luma[y * WIDTH + x] = 1;
  paint_line (other_scribbles, 40, 28, 50, 30, 3, 0x00ff00);
  paint_line (other_scribbles, 85, 30, 88, 50, 3, 0xff00ff);
  paint_line (other_scribbles, 10, 74, 80, 74, 3, 0xff0000);
  open_drawing = page_buffer ("Y' u8", "Y' float", open_luma);
  other        = page_buffer ("R'G'B'A u8", "R'G'B'A u8", other_scribbles);
}

/* A node whose layers can be exchanged. */
typedef struct { GeglNode *graph, *node, *drawing, *scribbles; } Kept;

static Kept
keep (GeglBuffer *input, GeglBuffer *aux)
{
  Kept k = { .graph = gegl_node_new () };

  k.node      = gegl_node_new_child (k.graph, "operation", SEGMENT, NULL);
  k.drawing   = gegl_node_new_child (k.graph, "operation", "gegl:buffer-source", "buffer", input, NULL);
  k.scribbles = gegl_node_new_child (k.graph, "operation", "gegl:buffer-source", "buffer", aux, NULL);
  join (k.drawing, k.node, "input");
  join (k.scribbles, k.node, "aux");
  return k;
}

static const CeldSession *
session_of (Kept k)
{
  return ((CeldOperation *) gegl_node_get_gegl_operation (k.node))->session;
}

/* Whether the node's output equals that of a new node. */
static bool
is_fresh (Kept k, GeglBuffer *input, GeglBuffer *aux)
{
  get_output (k.node, "R'G'B'A u8", result);
  operate (SEGMENT, (Pads) { { input, aux } }, "R'G'B'A u8", wanted, NULL);
  return !memcmp (result, wanted, sizeof result);
}

/* The segmenter keeps the basins of the ink that it was told of last, and is told when the ink differs: as long as it
 * has the same picture, nothing was built. */
static void
new_scribbles_keep_the_basins (void)
{
  Kept         k = keep (drawing, scribbles);
  const float *ink;
  uint8_t      first[4];

  CHECK (is_fresh (k, drawing, scribbles));
  CHECK (session_of (k) != NULL);
  ink = session_of (k)->segmenter_ink.data;
  CHECK (ink != NULL);
  memcpy (first, result + 4 * (40 * WIDTH + 45), 4);
  gegl_node_set (k.scribbles, "buffer", other, NULL);
  CHECK (is_fresh (k, drawing, other));
  CHECK (memcmp (first, result + 4 * (40 * WIDTH + 45), 4) != 0);
  CHECK (session_of (k)->segmenter_ink.data == ink);
  gegl_node_set (k.node, "hardness", 1.0, NULL);
  get_output (k.node, "R'G'B'A u8", result);
  CHECK (session_of (k)->segmenter_ink.data == ink);
  g_object_unref (k.graph);
}

static void
another_drawing_is_noticed (void)
{
  Kept         k = keep (drawing, scribbles);
  GeglBuffer  *painted = gegl_buffer_dup (drawing), *wide = gegl_buffer_new (GEGL_RECTANGLE (0, 0, 64, 64),
                                                                             babl_format ("Y' u8"));
  const float *ink;

  CHECK (is_fresh (k, drawing, scribbles));
  ink = session_of (k)->segmenter_ink.data;
  gegl_node_set (k.drawing, "buffer", open_drawing, NULL);
  CHECK (is_fresh (k, open_drawing, scribbles));
  CHECK (session_of (k)->segmenter_ink.data != ink);

  gegl_node_set (k.drawing, "buffer", painted, NULL);
  CHECK (is_fresh (k, painted, scribbles));
  gegl_buffer_set (painted, NULL, 0, babl_format ("Y' float"), open_luma, GEGL_AUTO_ROWSTRIDE); /* the artist draws */
  CHECK (is_fresh (k, painted, scribbles));

  gegl_buffer_copy (drawing, GEGL_RECTANGLE (0, 0, 64, 64), GEGL_ABYSS_NONE, wide, NULL);
  gegl_node_set (k.drawing, "buffer", wide, NULL);
  CHECK (is_fresh (k, wide, scribbles));
  g_object_unref (k.graph);
  g_object_unref (painted);
  g_object_unref (wide);
}

/* An operation that failed keeps what it can, and works again. */
static void
a_call_after_a_failed_one_works (void)
{
  Kept k = keep (drawing, scribbles);

  CHECK (is_fresh (k, drawing, scribbles));
  be_quiet ();
  gegl_node_set (k.node, "relations", "1,1 >", NULL);
  get_output (k.node, "R'G'B'A u8", result);
  CHECK (times_said == 1 && SAYS ("line 1"));
  gegl_node_set (k.node, "relations", "", NULL);
  CHECK (is_fresh (k, drawing, scribbles));
  g_object_unref (k.graph);
}

/* ------------------------------------------------------------------ threads */

typedef struct { GeglBuffer *drawing, *scribbles; uint8_t wanted[4 * PIXELS]; int different; } Worker;

static gpointer
work (gpointer data)
{
  Worker  *worker = data;
  Kept     k = keep (worker->drawing, worker->scribbles);
  uint8_t *made = g_malloc (4 * PIXELS);

  for (int i = 0; i < 6; i++)
    {
      gegl_node_set (k.scribbles, "buffer", i % 2 ? scribbles : other, NULL);
      get_output (k.node, "R'G'B'A u8", made);
      gegl_node_set (k.scribbles, "buffer", worker->scribbles, NULL);
      get_output (k.node, "R'G'B'A u8", made);
      worker->different += memcmp (made, worker->wanted, 4 * PIXELS) != 0;
    }
  g_object_unref (k.graph);
  g_free (made);
  return NULL;
}

static void
operations_in_threads_share_nothing (void)
{
  static Worker worker[4];
  GThread      *thread[4];

  for (int i = 0; i < 4; i++)
    {
      worker[i].drawing   = i % 2 ? drawing : open_drawing;
      worker[i].scribbles = i / 2 ? scribbles : other;
      operate (SEGMENT, (Pads) { { worker[i].drawing, worker[i].scribbles } }, "R'G'B'A u8", worker[i].wanted, NULL);
    }
  for (int i = 0; i < 4; i++)
    thread[i] = g_thread_new ("artist", work, &worker[i]);
  for (int i = 0; i < 4; i++)
    {
      g_thread_join (thread[i]);
      CHECK (worker[i].different == 0);
    }
}

/* ------------------------------------------------------------------ pictures for the artist */

/* A red line over the gap, and nothing elsewhere. */
static void
closures_are_red_lines_over_gaps (void)
{
  int inside = 0, outside = 0, pale = 0;

  operate (SEGMENT, (Pads) { { open_drawing, scribbles } }, "R'G'B'A u8", result,
           "result", CELD_SEGMENT_CLOSURES, NULL);
  for (int i = 0; i < PIXELS; i++)
    if (result[4 * i + 3])
      {
        int x = i % WIDTH, y = i / WIDTH;

        pale += result[4 * i] < 200 || result[4 * i + 1] > 60 || result[4 * i + 2] > 60;
        if (x >= 15 && x < 30 && y >= 31 && y < 49)
          inside++;
        else
          outside++;
      }
  CHECK (inside >= 10 && outside == 0 && pale == 0);
  operate (SEGMENT, (Pads) { { open_drawing, scribbles } }, "R'G'B'A u8", result, "result", CELD_SEGMENT_CLOSURES,
           "method", CELD_METHOD_EXACT, NULL);
  for (int i = 0; i < PIXELS; i++)
    CHECK (!result[4 * i + 3]);
}

/* Closures that are used as virtual contours, unchanged, leave labels nearly as they are. */
static void
closures_are_virtual_contours (void)
{
  GeglBuffer *accepted, *closed;
  int         different = 0;

  operate (SEGMENT, (Pads) { { open_drawing, scribbles } }, "R'G'B'A u8", result,
           "result", CELD_SEGMENT_CLOSURES, NULL);
  accepted = page_buffer ("R'G'B'A u8", "R'G'B'A u8", result);
  operate ("celdepth:virtual-contours", (Pads) { { open_drawing, accepted } }, "R'G'B'A u8", result, NULL);
  closed = page_buffer ("R'G'B'A u8", "R'G'B'A u8", result);
  operate (SEGMENT, (Pads) { { open_drawing, scribbles } }, "R'G'B'A u8", wanted, NULL);
  operate (SEGMENT, (Pads) { { closed, scribbles } }, "R'G'B'A u8", result, NULL);
  for (int i = 0; i < PIXELS; i++)
    different += memcmp (result + 4 * i, wanted + 4 * i, 4) != 0;
  CHECK (different <= 20);
  operate (SEGMENT, (Pads) { { closed, scribbles } }, "R'G'B'A u8", result, "result", CELD_SEGMENT_CLOSURES, NULL);
  for (int i = 0; i < PIXELS; i++)
    CHECK (!result[4 * i + 3]); /* nothing is open any more */
  g_object_unref (accepted);
  g_object_unref (closed);
}

/* A closed region without a stroke is marked where it is, over the drawing as it is. */
static void
problems_are_marked_over_the_drawing (void)
{
  static uint8_t two[4 * PIXELS], before[4 * PIXELS];
  GeglBuffer    *few;
  int            inside = 0, elsewhere = 0;

  paint_line (two, 35, 40, 55, 40, 3, 0xff0000);
  paint_line (two, 5, 5, 110, 5, 3, 0x0000ff);
  few = page_buffer ("R'G'B'A u8", "R'G'B'A u8", two);
  gegl_buffer_get (drawing, NULL, 1.0, babl_format ("R'G'B'A u8"), before, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  for (int popup = 0; popup < 2; popup++)
    {
      be_quiet ();
      operate (popup ? "celdepth:popup" : SEGMENT, (Pads) { { drawing, few } }, "R'G'B'A u8", result, "result",
               popup ? (int) CELD_POPUP_PROBLEMS : (int) CELD_SEGMENT_PROBLEMS, NULL);
      CHECK (times_said == 1 && SAYS ("No stroke reaches"));
      inside = elsewhere = 0;
      for (int i = 0; i < PIXELS; i++)
        if (memcmp (result + 4 * i, before + 4 * i, 4))
          {
            if (hypot (i % WIDTH - 85, i / WIDTH - 40) < 22)
              inside++;
            else
              elsewhere++;
          }
      CHECK (inside > 40 && elsewhere == 0);
    }
  operate (SEGMENT, (Pads) { { drawing, scribbles } }, "R'G'B'A u8", result, "result", CELD_SEGMENT_PROBLEMS, NULL);
  CHECK (!memcmp (result, before, sizeof result)); /* all is well */
  g_object_unref (few);
}

int
main (int argc, char **argv)
{
  int failed;

  gegl_init (&argc, &argv);
  make_page ();
  make_others ();
  start_to_listen ();
  RUN (new_scribbles_keep_the_basins);
  RUN (another_drawing_is_noticed);
  RUN (a_call_after_a_failed_one_works);
  RUN (operations_in_threads_share_nothing);
  RUN (closures_are_red_lines_over_gaps);
  RUN (closures_are_virtual_contours);
  RUN (problems_are_marked_over_the_drawing);
  failed = DONE;
  stop_to_listen ();
  g_object_unref (open_drawing);
  g_object_unref (other);
  drop_page ();
  gegl_exit ();
  return failed;
}
