/* Operations of drawings that move have the results of core, bit by bit; and pass them on from one to the next.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "core-page.h"
#include "op.h"

#include <locale.h>

/* The page and two that follow it, each moved by four pixels to the right. */
#define STEP 4

static float     later_luma[3][PIXELS];
static CeldPlane later_ink[3] = { { WIDTH, HEIGHT, WIDTH, (float[PIXELS]) { 0 } },
                                  { WIDTH, HEIGHT, WIDTH, (float[PIXELS]) { 0 } },
                                  { WIDTH, HEIGHT, WIDTH, (float[PIXELS]) { 0 } } };
static GeglBuffer *later[3];

static void
make_later_pages (void)
{
  for (int k = 0; k < 3; k++)
    {
      CeldDrawing page = { .luma = { WIDTH, HEIGHT, WIDTH, later_luma[k] } };

      for (int i = 0; i < PIXELS; i++)
        later_luma[k][i] = roundf (255 * page_luma[i % WIDTH >= k * STEP ? i - k * STEP : i]) / 255;
      later[k] = page_buffer ("Y' u8", "Y' float", later_luma[k]);
      CHECK (celd_ink (&page, CELD_INK_AUTO, NULL, &later_ink[k]) == CELD_OK);
    }
}

/* ------------------------------------------------------------------ registration */

static void
registration_is_that_of_core (void)
{
  static float sure[PIXELS], shift[2 * PIXELS], wanted[4 * PIXELS];
  CeldPlane    confidence = { WIDTH, HEIGHT, WIDTH, sure };
  CeldShifts   shifts = { WIDTH, HEIGHT, WIDTH, shift };
  CeldColours  art = { WIDTH, HEIGHT, WIDTH, result }, warped = { WIDTH, HEIGHT, WIDTH, wanted };
  CeldSettings settings = celd_settings ();
  CeldLattice *lattice = NULL;
  GeglBuffer  *input = page_buffer ("Y float", "Y float", levels.data);
  float        most = 0;

  for (int with = 0; with < 2; with++)
    {
      Pads pads = { { drawing, later[1], with ? input : NULL } };

      settings.cell_size = 12;
      CHECK ((with ? celd_lattice_of_levels (&ink, &levels, NULL, &settings, NULL, &lattice)
                   : celd_lattice_new (&ink, NULL, &settings, NULL, &lattice)) == CELD_OK);
      CHECK (celd_register (&ink, &later_ink[1], &settings, NULL, lattice, &confidence) == CELD_OK);
      CHECK (celd_lattice_displacement (lattice, &shifts) == CELD_OK);
      for (int i = 0; i < PIXELS; i++)
        {
          memcpy (wanted + 3 * i, (float[]) { shift[2 * i], shift[2 * i + 1], 0 }, 3 * sizeof (float));
          most = fmaxf (most, shift[2 * i]);
        }
      NEAR (most, 4, 1);
      operate ("celdepth:arap-register", pads, "RGB float", result, "cell-size", 12, NULL);
      SAME (wanted, 3);
      operate ("celdepth:arap-register", pads, "Y float", result, "cell-size", 12, "result", 2, NULL);
      SAME (sure, 1);
      gegl_buffer_get (drawing, NULL, 1, babl_format ("RGBA float"), art.data, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
      CHECK (celd_lattice_warp (lattice, &art, &warped) == CELD_OK);
      operate ("celdepth:arap-register", pads, "RGBA float", result, "cell-size", 12, "result", 1, NULL);
      SAME (wanted, 4);
      celd_lattice_free (lattice);
    }
  g_object_unref (input);
}

/* ------------------------------------------------------------------ propagation */

#define PROPAGATE "celdepth:depth-propagate"

enum { LABELS, SCRIBBLES, LEVELS, DEPTH, CONFIDENCE };

/* What core makes of the page for the next one. */
static struct
{
  CeldLabels  seeds, labels;
  CeldPlane   certainty, flat, levels, depth;
  CeldPaint   painted, seeded;
} next;

static CeldPlane
new_plane (void)
{
  return (CeldPlane) { WIDTH, HEIGHT, WIDTH, calloc (PIXELS, sizeof (float)) };
}

static void
make_next (void)
{
  CeldSettings settings = celd_settings ();
  CeldOrder    order = { 0 };
  uint32_t     background = 0;

  next.seeds     = (CeldLabels) { WIDTH, HEIGHT, WIDTH, calloc (PIXELS, sizeof (uint32_t)) };
  next.labels    = (CeldLabels) { WIDTH, HEIGHT, WIDTH, calloc (PIXELS, sizeof (uint32_t)) };
  next.painted   = (CeldPaint) { WIDTH, HEIGHT, WIDTH, calloc (PIXELS, 4) };
  next.seeded    = (CeldPaint) { WIDTH, HEIGHT, WIDTH, calloc (PIXELS, 4) };
  next.certainty = new_plane ();
  next.flat      = new_plane ();
  next.levels    = new_plane ();
  next.depth     = new_plane ();
  for (uint32_t k = 0; k < palette.n; k++)
    if (palette.item[k].background)
      background = k + 1;
  CHECK (celd_order (&labels, &palette, &relations, &ink, &settings, NULL, &order, NULL) == CELD_OK);
  CHECK (celd_propagate (&ink, &labels, order.level, background, &later_ink[1], NULL, &next.seeds, &next.certainty) ==
         CELD_OK);
  CHECK (celd_labels_paint (&next.seeds, &palette, &next.seeded) == CELD_OK);
  settings.background = CELD_BACKGROUND_NONE;
  CHECK (celd_segment (&later_ink[1], &next.seeds, NULL, &settings, NULL, &next.labels, &palette, NULL) == CELD_OK);
  CHECK (celd_labels_paint (&next.labels, &palette, &next.painted) == CELD_OK);
  for (int i = 0; i < PIXELS; i++)
    next.flat.data[i] = celd_order_value (&order, order.level[next.labels.data[i] - 1], &settings);
  CHECK (celd_expand_levels (&later_ink[1], NULL, &next.flat, &next.labels, NULL, settings.expansion, NULL, &next.levels) ==
         CELD_OK);
  CHECK (celd_smooth (&later_ink[1], NULL, &next.levels, NULL, &settings, NULL, &next.depth, NULL) == CELD_OK);
  celd_order_clear (&order);
}

static void
drop_next (void)
{
  free (next.seeds.data);
  free (next.labels.data);
  free (next.painted.data);
  free (next.seeded.data);
  free (next.certainty.data);
  free (next.flat.data);
  free (next.levels.data);
  free (next.depth.data);
}

static void
propagation_is_that_of_core (void)
{
  static uint8_t bytes[4 * PIXELS];
  const float   *wanted[CONFIDENCE + 1];
  Pads           pads = { { later[1], drawing, scribbles, NULL, arrows } };

  make_next ();
  wanted[LEVELS]     = next.levels.data;
  wanted[DEPTH]      = next.depth.data;
  wanted[CONFIDENCE] = next.certainty.data;
  operate (PROPAGATE, pads, "R'G'B'A u8", bytes, NULL);
  CHECK (!memcmp (bytes, next.painted.data, sizeof bytes));
  operate (PROPAGATE, pads, "R'G'B'A u8", bytes, "result", SCRIBBLES, NULL);
  CHECK (!memcmp (bytes, next.seeded.data, sizeof bytes));
  for (int result_of = LEVELS; result_of <= CONFIDENCE; result_of++)
    {
      operate (PROPAGATE, pads, "Y float", result, "result", result_of, NULL);
      SAME (wanted[result_of], 1);
      CHECK (range (wanted[result_of], PIXELS) > 0.5);
    }
  drop_next ();
}

static void
check_colour (const uint8_t *bytes, int x, int y, const char *wanted)
{
  const uint8_t *p = bytes + 4 * (y * WIDTH + x);
  char           colour[10];

  g_snprintf (colour, sizeof colour, "#%02x%02x%02x%02x", p[0], p[1], p[2], p[3]);
  CHECK (!strcmp (colour, wanted));
}

/* Labels of one node are those of the next, and what two nodes make of two frames is right. */
static void
frames_follow_one_another (void)
{
  static uint8_t bytes[4 * PIXELS];
  GeglNode      *graph = gegl_node_new (), *first, *second;

  first  = add_operation (graph, PROPAGATE, (Pads) { { later[1], drawing, scribbles, NULL, arrows } });
  second = add_operation (graph, PROPAGATE, (Pads) { { later[2], later[1] } });
  gegl_node_set (second, "flats", TRUE, "relations", "#ff0000 > #00ff00", NULL);
  join (first, second, "aux2");
  get_output (second, "R'G'B'A u8", bytes);
  check_colour (bytes, 45 + 2 * STEP, 40, "#ff0000ff");
  check_colour (bytes, 85 + 2 * STEP, 40, "#00ff00ff");
  check_colour (bytes, 2, 40, "#0000ffff");
  check_colour (bytes, 72 + 2 * STEP, 40, "#00ff00ff"); /* beside the left disc's outline, which was red before */
  check_colour (bytes, 66, 40, "#ff0000ff");
  gegl_node_set (second, "result", LEVELS, NULL);
  get_output (second, "Y float", result);
  NEAR (result[40 * WIDTH + 45 + 2 * STEP], 1, 0);
  NEAR (result[40 * WIDTH + 85 + 2 * STEP], 0.5, 0);
  NEAR (result[40 * WIDTH + 2], 0, 0);
  g_object_unref (graph);
}

/* Regions keep the levels of a picture of them, whatever these are, and arrows do not count. */
static void
levels_keep_their_numbers (void)
{
  static float odd[PIXELS];
  GeglBuffer  *made;
  int          others = 0;

  for (int i = 0; i < PIXELS; i++)
    odd[i] = levels.data[i] > 0.75f ? 0.125f : levels.data[i] > 0.25f ? 7 : -3;
  made = page_buffer ("Y float", "Y float", odd);
  operate (PROPAGATE, (Pads) { { later[1], drawing, scribbles, made, arrows } }, "Y float", result, "result", LEVELS,
           NULL);
  NEAR (result[40 * WIDTH + 45 + STEP], 0.125, 0);
  NEAR (result[40 * WIDTH + 85 + STEP], 7, 0);
  NEAR (result[40 * WIDTH + 2], -3, 0);
  for (int i = 0; i < PIXELS; i++)
    others += result[i] != 0.125f && result[i] != 7 && result[i] != -3;
  CHECK (!others);
  g_object_unref (made);
}

/* ------------------------------------------------------------------ deformation */

#define DEFORM "celdepth:arap-deform"
#define MOVED "45,40 -> 49,33; 88,40; 80,55 -> 84,60 ^2"

static float art_data[4 * PIXELS], moved_data[4 * PIXELS], moved_levels[PIXELS];

static const CeldColours page_art = { WIDTH, HEIGHT, WIDTH, art_data };

static void
read_art (void)
{
  gegl_buffer_get (drawing, NULL, 1, babl_format ("RGBA float"), art_data, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
}

/* Poses and draws a puppet with handles as text, and frees it. */
static void
draw_puppet (CeldPuppet *puppet, const char *text)
{
  CeldHandles handles = { 0 };
  CeldColours moved = { WIDTH, HEIGHT, WIDTH, moved_data };
  CeldPlane   to = { WIDTH, HEIGHT, WIDTH, moved_levels };

  CHECK (celd_handles_parse (text, &handles, NULL) == CELD_OK);
  CHECK (celd_puppet_pose (puppet, handles.item, handles.n, NULL, NULL) == CELD_OK);
  CHECK (celd_puppet_draw (puppet, NULL, &moved, &to) == CELD_OK);
  CHECK (celd_puppet_draw (puppet, NULL, &moved, NULL) == CELD_OK);
  celd_handles_clear (&handles);
  celd_puppet_free (puppet);
}

static void
deformation_of_levels_is_that_of_core (void)
{
  CeldSettings settings = celd_settings ();
  CeldPuppet  *puppet = NULL;
  GeglBuffer  *input = page_buffer ("Y float", "Y float", levels.data);
  Pads         pads = { { drawing, input } };

  read_art ();
  CHECK (celd_puppet_of_levels (&ink, &levels, &page_art, &settings, NULL, &puppet) == CELD_OK);
  draw_puppet (puppet, MOVED);
  CHECK (difference (art_data, moved_data, 4 * PIXELS) > 0.9);
  operate (DEFORM, pads, "RGBA float", result, "handles", MOVED, NULL);
  SAME (moved_data, 4);
  operate (DEFORM, pads, "Y float", result, "handles", MOVED, "result", 1, NULL);
  SAME (moved_levels, 1);
  CHECK (moved_levels[40 * WIDTH + 45] == 1 && moved_levels[62 * WIDTH + 84] == 1.5f && moved_levels[0] == 0);
  g_object_unref (input);
}

/* Of scribbles and arrows, with coloured art. */
static void
deformation_of_scribbles_is_that_of_core (void)
{
  CeldSettings settings = celd_settings ();
  CeldSession *session = celd_session_new ();
  CeldPuppet  *puppet = NULL;
  GeglBuffer  *art = page_buffer ("R'G'B'A u8", "R'G'B'A u8", colours.data);
  Pads         pads = { { art, NULL, NULL, drawing, scribbles, arrows } };

  gegl_buffer_get (art, NULL, 1, babl_format ("RGBA float"), art_data, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  CHECK (celd_session_set_drawing (session, &page_drawing) == CELD_OK);
  CHECK (celd_session_set_scribbles (session, &scribbles_paint) == CELD_OK);
  CHECK (celd_session_set_arrows (session, &arrows_paint) == CELD_OK);
  CHECK (celd_session_puppet (session, &page_art, NULL, &puppet) == CELD_OK);
  draw_puppet (puppet, MOVED);
  operate (DEFORM, pads, "RGBA float", result, "handles", MOVED, NULL);
  SAME (moved_data, 4);
  for (int i = 0; i < PIXELS; i++)
    moved_levels[i] = celd_encode_level ((double) moved_levels[i], 3, &settings);
  operate (DEFORM, pads, "Y float", result, "handles", MOVED, "result", 1, NULL);
  SAME (moved_levels, 1);
  celd_session_free (session);
  g_object_unref (art);
}

/* Without handles it is the art; dots and an arrow on a layer are handles. */
static void
handles_may_be_painted (void)
{
  static uint8_t painted[4 * PIXELS];
  GeglBuffer    *input = page_buffer ("Y float", "Y float", levels.data), *dots;

  read_art ();
  operate (DEFORM, (Pads) { { drawing, input } }, "RGBA float", result, NULL);
  NEAR (difference (result, art_data, 4 * PIXELS), 0, 1 / 255.0);
  paint_line (painted, 84, 38, 85, 38, 5, 0x000000);
  paint_line (painted, 44, 20, 44, 60, 2, 0x000000);
  paint_line (painted, 38, 54, 44, 60, 2, 0x000000);
  paint_line (painted, 50, 54, 44, 60, 2, 0x000000);
  dots = page_buffer ("R'G'B'A u8", "R'G'B'A u8", painted);
  operate (DEFORM, (Pads) { { drawing, input, dots } }, "Y float", result, "result", 1, NULL);
  CHECK (result[72 * WIDTH + 45] == 1 && result[72 * WIDTH + 85] == 0); /* below the left disc, which goes down by 40 */
  CHECK (result[40 * WIDTH + 90] == 0.5f);
  g_object_unref (dots);
  g_object_unref (input);
}

/* Whether a node gives what a new one gives. */
static bool
is_fresh (GeglNode *node, Pads pads, const char *handles, const char *told)
{
  static float wanted[4 * PIXELS];

  gegl_node_set (node, "handles", handles, "relations", told, NULL);
  get_output (node, "RGBA float", result);
  operate (DEFORM, pads, "RGBA float", wanted, "handles", handles, "relations", told, NULL);
  return difference (wanted, result, 4 * PIXELS) <= 0;
}

/* The puppet stays while handles change, and is made anew when anything else does. */
static void
a_handle_only_poses_anew (void)
{
  Pads           pads = { { drawing, NULL, NULL, NULL, scribbles } };
  GeglNode      *graph = gegl_node_new (), *node = add_operation (graph, DEFORM, pads);
  const CeldKept *kept = &((CeldOperation *) gegl_node_get_gegl_operation (node))->kept;
  gpointer       puppet;
  guint64        input;

  CHECK (is_fresh (node, pads, MOVED, "#ff0000 > #00ff00"));
  puppet = kept->result;
  CHECK (puppet != NULL);
  CHECK (is_fresh (node, pads, "45,40 -> 60,40", "#ff0000 > #00ff00"));
  CHECK (kept->result == puppet);
  input = kept->input;
  CHECK (is_fresh (node, pads, "45,40 -> 60,40", "#ff0000 < #00ff00"));
  CHECK (kept->input != input);
  input = kept->input;
  gegl_node_set (node, "result", 1, NULL);
  get_output (node, "RGBA float", result);
  CHECK (kept->input == input);
  gegl_node_set (node, "result", 0, "cell-size", 20, NULL);
  get_output (node, "RGBA float", result);
  CHECK (kept->input != input);
  g_object_unref (graph);
}

int
main (int argc, char **argv)
{
  setlocale (LC_ALL, "");
  gegl_init (&argc, &argv);
  make_page ();
  make_later_pages ();
  RUN (core_makes_all_results_of_the_page);
  RUN (registration_is_that_of_core);
  RUN (propagation_is_that_of_core);
  RUN (frames_follow_one_another);
  RUN (levels_keep_their_numbers);
  RUN (deformation_of_levels_is_that_of_core);
  RUN (deformation_of_scribbles_is_that_of_core);
  RUN (handles_may_be_painted);
  RUN (a_handle_only_poses_anew);
  celd_palette_clear (&palette);
  celd_relations_clear (&relations);
  for (int k = 0; k < 3; k++)
    g_object_unref (later[k]);
  drop_page ();
  gegl_exit ();
  return DONE;
}
