/* Pictures that are something else than they were connected for: one message says so, and the output is the input.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "listen.h"
#include "page.h"

static float result[4 * PIXELS], wanted[4 * PIXELS];

/* The operations that find regions of a drawing by scribbles. */
static const char *const finders[] = { "celdepth:popup", "celdepth:lazybrush-segment", "celdepth:depth-exact" };

static GeglBuffer *
surface (bool coloured)
{
  static float pixels[3 * PIXELS];

  for (int i = 0; i < 3 * PIXELS; i++)
    pixels[i] = surface_at (i / 3, coloured ? i % 3 : 0);
  return page_buffer ("R'G'B' u8", "R'G'B' float", pixels);
}

static GeglBuffer *
blank (void)
{
  static float pixels[PIXELS];

  for (int i = 0; i < PIXELS; i++)
    pixels[i] = 1;
  return page_buffer ("Y' u8", "Y' float", pixels);
}

/* Whether the operation has said this in one message, and its output is its input. */
static bool
refuses (const char *operation, Pads pads, const char *says)
{
  be_quiet ();
  operate (operation, pads, "RGBA float", result, NULL);
  gegl_buffer_get (pads.pad[0], NULL, 1, babl_format ("RGBA float"), wanted, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  return times_said == 1 && warnings == 0 && SAYS (says) && difference (result, wanted, 4 * PIXELS) < 1e-6;
}

static void
photographs_are_no_drawings (void)
{
  GeglBuffer *photograph = surface (false);

  for (size_t i = 0; i < G_N_ELEMENTS (finders); i++)
    CHECK (refuses (finders[i], (Pads) { { photograph, scribbles } }, "The drawing looks like a photograph"));
  be_quiet (); /* who says what the lines are is believed */
  operate ("celdepth:popup", (Pads) { { photograph, scribbles, arrows } }, "RGBA float", result, "ink", CELD_INK_DARK,
           NULL);
  CHECK (!SAYS ("photograph"));
  g_object_unref (photograph);
}

/* What may be a photograph is used, with a warning. */
static void
unclear_lines_are_told (void)
{
  static float faint[PIXELS];
  GeglBuffer  *page;

  for (int i = 0; i < PIXELS; i++)
    faint[i] = faint_at (i);
  page = page_buffer ("Y' u8", "Y' float", faint);
  for (size_t i = 0; i < G_N_ELEMENTS (finders); i++)
    {
      be_quiet ();
      operate (finders[i], (Pads) { { page, scribbles, arrows } }, "RGBA float", result, NULL);
      CHECK (times_said == 1 && warnings == 0 && SAYS ("hardly has clear lines"));
      gegl_buffer_get (page, NULL, 1, babl_format ("RGBA float"), wanted, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
      CHECK (difference (result, wanted, 4 * PIXELS) > 0.01);
    }
  be_quiet (); /* both drawings are, which is told once */
  operate ("celdepth:arap-register", (Pads) { { page, page } }, "RGBA float", result, NULL);
  CHECK (SAYS ("hardly has clear lines") && !strstr (strstr (said->str, "hardly has") + 1, "hardly has"));
  g_object_unref (page);
}

/* Also for single steps, which have an answer for a blank page; art may be a photograph. */
static void
photographs_have_no_steps (void)
{
  static const char *const steps[] = { "celdepth:depth-smooth", "celdepth:depth-expand", "celdepth:lumo-shade",
                                       "celdepth:relief", "celdepth:arap-register" };
  GeglBuffer              *photograph = surface (false), *page = blank ();

  for (size_t i = 0; i < G_N_ELEMENTS (steps); i++)
    CHECK (refuses (steps[i], (Pads) { { page, photograph } }, "The drawing looks like a photograph"));
  CHECK (refuses ("celdepth:stereo", (Pads) { { drawing, page, NULL, photograph } },
                  "The drawing looks like a photograph"));
  be_quiet ();
  operate ("celdepth:depth-smooth", (Pads) { { page, photograph } }, "Y float", result, "ink", CELD_INK_DARK, NULL);
  operate ("celdepth:depth-smooth", (Pads) { { page, page } }, "Y float", result, NULL);
  operate ("celdepth:stereo", (Pads) { { photograph, page } }, "RGBA float", result, NULL);
  CHECK (!SAYS ("photograph"));
  g_object_unref (photograph);
  g_object_unref (page);
}

static void
photographs_are_no_scribbles (void)
{
  GeglBuffer *photograph = surface (true);

  for (size_t i = 0; i < G_N_ELEMENTS (finders); i++)
    CHECK (refuses (finders[i], (Pads) { { drawing, photograph } }, "The scribbles look like a photograph"));
  g_object_unref (photograph);
}

static void
levels_are_no_drawings_and_no_scribbles (void)
{
  static float pixels[PIXELS];
  GeglBuffer  *levels;

  for (int i = 0; i < PIXELS; i++)
    pixels[i] = level_at (i);
  levels = page_buffer ("Y' u8", "Y' float", pixels);
  for (size_t i = 0; i < G_N_ELEMENTS (finders); i++)
    {
      CHECK (refuses (finders[i], (Pads) { { levels, scribbles } }, "The drawing looks like levels or depth"));
      CHECK (refuses (finders[i], (Pads) { { drawing, levels } }, "The scribbles look like levels or depth"));
    }
  be_quiet (); /* who says what the lines are is believed */
  operate ("celdepth:popup", (Pads) { { levels, scribbles, arrows } }, "RGBA float", result, "ink", CELD_INK_DARK, NULL);
  CHECK (!SAYS ("levels or depth"));
  g_object_unref (levels);
}

/* A page parted into squares. */
static GeglBuffer *
squares (void)
{
  static float pixels[PIXELS];

  for (int i = 0; i < PIXELS; i++)
    pixels[i] = i % WIDTH % 24 < 2 || i / WIDTH % 24 < 2 ? 0 : 1;
  return page_buffer ("Y' u8", "Y' float", pixels);
}

static void
exchanged_layers_are_noticed (void)
{
  GeglBuffer *other = squares ();

  for (size_t i = 0; i < G_N_ELEMENTS (finders); i++)
    {
      CHECK (refuses (finders[i], (Pads) { { scribbles, drawing } }, "Exchange them"));
      CHECK (refuses (finders[i], (Pads) { { drawing, drawing } }, "The scribbles are the same picture"));
      CHECK (refuses (finders[i], (Pads) { { drawing, other } }, "The scribbles look like a drawing"));
    }
  g_object_unref (other);
}

static void
drawings_are_no_strokes (void)
{
  for (size_t i = 0; i < G_N_ELEMENTS (finders); i++)
    CHECK (refuses (finders[i], (Pads) { { drawing, scribbles, drawing } }, "(pad aux2) has the lines of the drawing"));
  CHECK (refuses ("celdepth:popup", (Pads) { { drawing, scribbles, arrows, drawing } }, "(pad aux3) has the lines"));
}

/* Fills do not make scribbles of a drawing, nor a drawing of what has the same colours. */
static void
coloured_drawings_are_no_scribbles (void)
{
  static float pixels[3 * PIXELS];
  GeglBuffer  *coloured;

  colour_page (pixels);
  coloured = page_buffer ("R'G'B' u8", "R'G'B' float", pixels);
  for (size_t i = 0; i < G_N_ELEMENTS (finders); i++)
    {
      CHECK (refuses (finders[i], (Pads) { { scribbles, coloured } }, "Exchange them"));
      CHECK (refuses (finders[i], (Pads) { { coloured, coloured } }, "The scribbles are the same picture"));
      be_quiet ();
      operate (finders[i], (Pads) { { coloured, scribbles, arrows } }, "RGBA float", result, NULL);
      CHECK (times_said == 0 && warnings == 0);
    }
  g_object_unref (coloured);
}

static void
blank_pages_have_no_depth (void)
{
  GeglBuffer *page = blank ();

  for (size_t i = 0; i < G_N_ELEMENTS (finders); i++)
    CHECK (refuses (finders[i], (Pads) { { page, scribbles, arrows } }, "The drawing has no lines"));
  g_object_unref (page);
}

/* Flats are a colouring without lines, or with them. */
static void
flats_need_no_lines (void)
{
  GeglBuffer *page = blank ();

  be_quiet ();
  operate ("celdepth:lazybrush-segment", (Pads) { { page, scribbles } }, "RGBA float", result, "flats", TRUE, NULL);
  CHECK (times_said == 0 && warnings == 0);
  g_object_unref (page);
}

/* Depth and levels are grey; the message names the pad. */
static void
colours_are_no_depth (void)
{
  CHECK (refuses ("celdepth:stereo", (Pads) { { drawing, scribbles } }, "'Depth' (pad aux) is in colour"));
  CHECK (refuses ("celdepth:depth-enhance", (Pads) { { drawing, scribbles } }, "'Levels' (pad aux) is in colour"));
  CHECK (refuses ("celdepth:depth-smooth", (Pads) { { scribbles, drawing } }, "(pad input) is in colour"));
}

/* A page that is 1 everywhere but at one pixel. */
static GeglBuffer *
odd (float value)
{
  static float pixels[PIXELS];

  for (int i = 0; i < PIXELS; i++)
    pixels[i] = i == PIXELS / 2 ? value : 1;
  return page_buffer ("Y float", "Y float", pixels);
}

/* Values that are infinite or no number are no levels, depth or scribbles; in a drawing they are paper. */
static void
only_numbers_are_depth (void)
{
  static const float value[] = { NAN, INFINITY, -INFINITY };

  for (size_t i = 0; i < G_N_ELEMENTS (value); i++)
    {
      GeglBuffer *page = odd (value[i]);

      CHECK (refuses ("celdepth:stereo", (Pads) { { drawing, page } }, "'Depth' (pad aux) has values that are infinite"));
      CHECK (refuses ("celdepth:depth-enhance", (Pads) { { drawing, page } }, "(pad aux) has values that are infinite"));
      be_quiet ();
      operate ("celdepth:lumo-shade", (Pads) { { page, drawing } }, "RGBA float", result, NULL);
      CHECK (times_said == 1 && SAYS ("(pad input) has values that are infinite"));
      for (size_t k = 0; k < G_N_ELEMENTS (finders); k++)
        CHECK (refuses (finders[k], (Pads) { { drawing, page } }, "(pad aux) has values that are infinite"));
      g_object_unref (page);
    }
}

typedef struct { GeglNode *graph, *source[2], *node; } Effect;

static Effect
new_effect (const char *operation)
{
  Effect e = { gegl_node_new (), { NULL, NULL }, NULL };

  e.node = gegl_node_new_child (e.graph, "operation", operation, NULL);
  for (int i = 0; i < 2; i++)
    {
      e.source[i] = gegl_node_new_child (e.graph, "operation", "gegl:buffer-source", NULL);
      join (e.source[i], e.node, i ? "scribbles" : "input");
    }
  return e;
}

static bool
says (Effect *e, GeglBuffer *page, GeglBuffer *strokes, const char *text)
{
  be_quiet ();
  gegl_node_set (e->source[0], "buffer", page, NULL);
  gegl_node_set (e->source[1], "buffer", strokes, NULL);
  gegl_node_blit (e->node, 1, GEGL_RECTANGLE (0, 0, WIDTH, HEIGHT), babl_format ("RGBA float"), result,
                  GEGL_AUTO_ROWSTRIDE, GEGL_BLIT_DEFAULT);
  return text ? times_said == 1 && SAYS (text) : times_said == 0;
}

/* An effect remembers which drawing was good, but for as long as it stays the same; of a blank page, on which the
 * artist is about to draw, it says nothing. */
static void
effects_look_again_when_the_drawing_changes (void)
{
  Effect      e = new_effect ("celdepth:live-popup");
  GeglBuffer *page = blank (), *photograph = surface (false);

  CHECK (says (&e, page, scribbles, NULL));
  CHECK (says (&e, drawing, scribbles, NULL));
  CHECK (says (&e, photograph, scribbles, "photograph"));
  CHECK (says (&e, photograph, scribbles, NULL)); /* the same again */
  CHECK (says (&e, drawing, scribbles, NULL));
  CHECK (says (&e, photograph, scribbles, "photograph"));
  g_object_unref (e.graph);
  g_object_unref (page);
  g_object_unref (photograph);
}

int
main (int argc, char **argv)
{
  int failed;

  gegl_init (&argc, &argv);
  make_page ();
  start_to_listen ();
  RUN (photographs_are_no_drawings);
  RUN (unclear_lines_are_told);
  RUN (photographs_have_no_steps);
  RUN (photographs_are_no_scribbles);
  RUN (levels_are_no_drawings_and_no_scribbles);
  RUN (exchanged_layers_are_noticed);
  RUN (coloured_drawings_are_no_scribbles);
  RUN (drawings_are_no_strokes);
  RUN (blank_pages_have_no_depth);
  RUN (flats_need_no_lines);
  RUN (colours_are_no_depth);
  RUN (only_numbers_are_depth);
  RUN (effects_look_again_when_the_drawing_changes);
  failed = DONE;
  stop_to_listen ();
  drop_page ();
  gegl_exit ();
  return failed;
}
