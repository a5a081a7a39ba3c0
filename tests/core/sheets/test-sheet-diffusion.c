/* Shapes that go on behind others as one would expect: holes close, limbs join, discs are round, stems and strips go on
 * under their neighbours, and nothing goes on where nothing hides it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layer-scene.h"
#include "sheets/sheets.h"

static const float black[3] = { 0, 0, 0 };
static double      scale = 1; /* of all shapes: in large pictures a cell is several pixels */

static double
share_of (double depth)
{
  return fmin (fmax (scale * depth + 0.5, 0), 1);
}

static double
disc (double x, double y, double mx, double my, double radius)
{
  return share_of (radius - hypot (x / scale - mx, y / scale - my));
}

static double
box (double x, double y, double left, double top, double right, double bottom)
{
  x /= scale;
  y /= scale;
  return share_of (fmin (fmin (x - left, right - x), fmin (y - top, bottom - y)));
}

static LayerScene
scene (int width, int height)
{
  return layer_scene ((int) (scale * width), (int) (scale * height));
}

/* Coverage of the whole picture by the sheet of a label, by levels or by the links of an order. */
static float *
sheet_of (const LayerScene *s, size_t n, const CeldOrderLinks *links, uint32_t label)
{
  float       *cover = malloc ((size_t) s->width * (size_t) s->height * sizeof *cover);
  CeldSheets  *sheets = NULL;
  CeldOrder    order = { .level = (uint32_t *) s->level, .n = n };
  CeldSettings settings = celd_settings ();

  if (links)
    order.links = *links;
  CHECK (celd_sheets (&s->ink, &s->own, NULL, &order, 1, &settings, NULL, &sheets) == CELD_OK);
  celd_sheet_coverage (sheets, &s->own, sheets->of_label[label - 1], (CeldRect) { 0, 0, s->width, s->height }, cover);
  celd_sheets_free (sheets);
  return cover;
}

/* What both shapes have in common, as a share of what either has. */
static double
overlap (const LayerScene *s, const float *cover, LayerShare shape)
{
  double both = 0, either = 0;

  for (int y = 0; y < s->height; y++)
    for (int x = 0; x < s->width; x++)
      {
        double a = (double) cover[y * s->width + x], b = shape (x + 0.5, y + 0.5);

        both   += fmin (a, b);
        either += fmax (a, b);
      }
  return both / either;
}

static double
area (const LayerScene *s, const float *cover)
{
  double sum = 0;

  for (int i = 0; i < s->width * s->height; i++)
    sum += (double) cover[i];
  return sum;
}

/* Is all that lies this far inside the shape covered wholly? */
static bool
has_no_hole (const LayerScene *s, const float *cover, LayerShare inner_shape)
{
  for (int y = 0; y < s->height; y++)
    for (int x = 0; x < s->width; x++)
      if (inner_shape (x + 0.5, y + 0.5) >= 1 && !(cover[y * s->width + x] >= 1))
        return false;
  return true;
}

/* ------------------------------------------------------------------ parts inside of others */

static double face (double x, double y) { return disc (x, y, 60, 60, 50); }
static double eye (double x, double y) { return disc (x, y, 70, 50, 20); }
static double iris (double x, double y) { return disc (x, y, 73, 50, 12); }
static double pupil (double x, double y) { return disc (x, y, 74, 49, 6); }

static void
nothing_makes_a_hole_in_what_it_lies_on (void)
{
  static const LayerShare shape[4] = { face, eye, iris, pupil };
  uint32_t                end[8] = { 0, 1, 1, 2, 2, 3, 3, 4 };
  size_t                  first[9] = { 0, 1, 2, 3, 4, 5, 6, 7, 8 };
  bool                    equal[4] = { false };
  CeldOrderLinks          chain = { 4, first, end, equal };

  for (scale = 1; scale < 6; scale += 4)
    {
      LayerScene s = scene (120, 120);

      for (uint32_t k = 0; k < 4; k++)
        layer_scene_paint (&s, k + 2, black, shape[k], NULL);
      for (uint32_t k = 0; k < 4; k++)
        {
          float *by_level = sheet_of (&s, 5, NULL, k + 2), *by_links = sheet_of (&s, 5, &chain, k + 2);

          CHECK (overlap (&s, by_level, shape[k]) > 0.995);
          CHECK (has_no_hole (&s, by_level, shape[k]));
          CHECK (!memcmp (by_level, by_links, (size_t) (s.width * s.height) * sizeof *by_level));
          free (by_level);
          free (by_links);
        }
      layer_scene_close (&s);
    }
  scale = 1;
}

/* A mole that touches the face's outline from within, and one that reaches beyond it. */
static double mole_x;
static double mole (double x, double y) { return disc (x, y, mole_x, 60, 12); }

static void
parts_at_the_outline_leave_no_bite (void)
{
  for (scale = 1; scale < 6; scale += 4)
    for (mole_x = 96; mole_x < 113; mole_x += 4)
      {
        LayerScene s = scene (140, 120);
        float     *cover;

        layer_scene_paint (&s, 2, black, face, NULL);
        layer_scene_paint (&s, 3, black, mole, NULL);
        cover = sheet_of (&s, 3, NULL, 2);
        CHECK (overlap (&s, cover, face) > 0.985);
        free (cover);
        layer_scene_close (&s);
      }
  scale = 1;
}

/* ------------------------------------------------------------------ open sides */

static double limb (double x, double y) { return box (x, y, 10, 40, 150, 56); }
static double post (double x, double y) { return box (x, y, 60, 10, 95, 90); }
static double board (double x, double y) { return box (x, y, 62, -5, 120, 62); }

/* Both pieces are joined, by straight sides. */
static void
a_limb_goes_on_behind_a_post (void)
{
  for (scale = 1; scale < 6; scale += 4)
    {
      LayerScene s = scene (160, 100);
      float     *cover;

      layer_scene_paint (&s, 2, black, limb, NULL);
      layer_scene_paint (&s, 3, black, post, NULL);
      cover = sheet_of (&s, 3, NULL, 2);
      CHECK (overlap (&s, cover, limb) > 0.98);
      for (int x = (int) (60 * scale); x < (int) (95 * scale); x++)
        {
          CHECK (cover[(int) (44 * scale) * s.width + x] >= 1 && cover[(int) (52 * scale) * s.width + x] >= 1);
          CHECK (cover[(int) (37 * scale) * s.width + x] <= 0 && cover[(int) (59 * scale) * s.width + x] <= 0);
        }
      free (cover);
      layer_scene_close (&s);
    }
  scale = 1;
}

/* A panel on a thick line leaves a rim of the line beyond it, thinner than a cell: what is behind the panel is whole.
 * */
static double window (double x, double y) { return box (x, y, 20, 20, 140, 80); }
static double panel  (double x, double y) { return box (x, y, 20.4, 20.4, 60, 79.6); }

static void
a_thin_rim_beyond_a_panel_counts (void)
{
  for (scale = 3; scale < 6; scale++)
    {
      LayerScene s = scene (160, 100);
      float     *cover;

      layer_scene_paint (&s, 2, black, window, NULL);
      layer_scene_paint (&s, 3, black, panel, NULL);
      cover = sheet_of (&s, 3, NULL, 2);
      CHECK (overlap (&s, cover, window) > 0.98);
      free (cover);
      layer_scene_close (&s);
    }
  scale = 1;
}

/* Also behind what is four times as wide as it is. */
static double thick, gap;
static double thin_limb (double x, double y) { return box (x, y, 20, 60 - thick / 2, 280, 60 + thick / 2); }
static double wide_post (double x, double y) { return box (x, y, 150 - gap / 2, 8, 150 + gap / 2, 112); }

static void
thin_limbs_join_behind_wide_posts (void)
{
  for (thick = 6; thick < 25; thick += 6)
    for (gap = thick; gap <= 4 * thick; gap += thick)
      {
        LayerScene s = scene (300, 120);
        float     *cover;
        double     hidden = 0;

        layer_scene_paint (&s, 2, black, thin_limb, NULL);
        layer_scene_paint (&s, 3, black, wide_post, NULL);
        cover = sheet_of (&s, 3, NULL, 2);
        for (int y = 0; y < s.height; y++)
          for (int x = (int) (150 - gap / 2); x < 150 + gap / 2; x++)
            hidden += (double) cover[y * s.width + x];
        CHECK (hidden > 0.75 * thick * gap && hidden < 1.1 * thick * gap);
        CHECK (cover[60 * s.width + 150] >= 1);
        free (cover);
        layer_scene_close (&s);
      }
}

static void
a_disc_goes_on_behind_a_board (void)
{
  for (scale = 1; scale < 6; scale += 4)
    {
      LayerScene s = scene (140, 130);
      float     *cover;

      layer_scene_paint (&s, 2, black, face, NULL);
      layer_scene_paint (&s, 3, black, board, NULL);
      cover = sheet_of (&s, 3, NULL, 2);
      CHECK (overlap (&s, cover, face) > 0.95);
      free (cover);
      layer_scene_close (&s);
    }
  scale = 1;
}

/* A stem that ends behind a pot is as wide there as outside for half of its width, and ends within it. */
static double stem (double x, double y) { return box (x, y, 70, 10, 90, 60); }
static double pot (double x, double y) { return box (x, y, 30, 50, 130, 140); }

static void
a_stem_keeps_its_width_for_a_while (void)
{
  for (scale = 1; scale < 6; scale += 4)
    {
      LayerScene s = scene (160, 150);
      float     *cover;
      double     width = 0;

      layer_scene_paint (&s, 2, black, stem, NULL);
      layer_scene_paint (&s, 3, black, pot, NULL);
      cover = sheet_of (&s, 3, NULL, 2);
      for (int x = 0; x < s.width; x++)
        {
          width += (double) cover[(int) (60 * scale) * s.width + x] / scale;
          CHECK (cover[(int) (145 * scale) * s.width + x] <= 0);
        }
      CHECK (width > 0.75 * 20 && width < 1.25 * 20);
      free (cover);
      layer_scene_close (&s);
    }
  scale = 1;
}

/* ------------------------------------------------------------------ no outline of its own */

static double strip_left, strip_right;
static double strip (double x, double y) { (void) y; return box (x, 0, strip_left, -9, strip_right, 9); }
static double left_curtain (double x, double y) { (void) y; return box (x, 0, 20, -9, strip_left, 9); }
static double right_curtain (double x, double y) { (void) y; return box (x, 0, strip_right, -9, 180, 9); }

/* It goes on by the margin on both sides, where its sheet or its margin has pixels. */
static void
a_strip_goes_on_under_its_curtains (void)
{
  for (scale = 1; scale < 6; scale += 4)
    for (double wide = 1.2; wide < 70; wide += 12)
      {
        LayerScene   s;
        CeldSettings settings = celd_settings ();
        CeldOrder    order = { .n = 4 };
        CeldSheets  *sheets = NULL;
        size_t       missing = 0;
        double       margin;
        bool        *hidden;

        strip_left  = 100 - wide / 2;
        strip_right = 100 + wide / 2;
        s           = scene (200, 120);
        order.level = s.level;
        settings.margin = 0.3f; /* more than where it would end of itself */
        margin      = (double) settings.margin * s.width;
        hidden      = calloc ((size_t) (s.width * s.height), 1);
        layer_scene_paint (&s, 2, black, strip, NULL);
        layer_scene_paint (&s, 3, black, left_curtain, NULL);
        layer_scene_paint (&s, 4, black, right_curtain, NULL);
        CHECK (celd_sheets (&s.ink, &s.own, NULL, &order, 1, &settings, NULL, &sheets) == CELD_OK);
        for (size_t r = 0; r < sheets->item[1].n_runs; r++)
          memset (hidden + sheets->item[1].run[r].y * s.width + sheets->item[1].run[r].x, 1,
                  (size_t) sheets->item[1].run[r].n);
        for (int y = 0; y < s.height; y++)
          for (int x = 0; x < s.width; x++)
            {
              double beyond = fmax (strip_left * scale - (x + 0.5), x + 0.5 - strip_right * scale);

              if (x > 20 * scale && x < 180 * scale)
                missing += beyond > 1 && beyond < margin - 2 && !hidden[y * s.width + x];
            }
        CHECK (missing == 0);
        celd_sheets_free (sheets);
        free (hidden);
        layer_scene_close (&s);
      }
  scale = 1;
}

/* ------------------------------------------------------------------ not more than what is plausible */

/* What lies on top of all, or beside what is nearer without a common boundary, has nothing hidden. */
static double far_post (double x, double y) { return box (x, y, 116, 10, 136, 110); }

static void
what_nothing_hides_stays_as_it_is (void)
{
  LayerScene s = scene (140, 120);
  float     *cover;

  layer_scene_paint (&s, 2, black, face, NULL);
  layer_scene_paint (&s, 3, black, far_post, NULL);
  cover = sheet_of (&s, 3, NULL, 2);
  CHECK (overlap (&s, cover, face) > 1 - 1e-6);
  free (cover);
  cover = sheet_of (&s, 3, NULL, 3);
  CHECK (overlap (&s, cover, far_post) > 1 - 1e-6);
  free (cover);
  layer_scene_close (&s);
}

/* A convex shape whose straight end lies along a wall does not bulge under it by more than half of its size. */
static double wall (double x, double y) { return box (x, y, 60, -5, 150, 130); }

static void
half_a_disc_is_completed_once (void)
{
  for (scale = 1; scale < 6; scale += 4)
    {
      LayerScene s = scene (160, 120);
      float     *cover;

      layer_scene_paint (&s, 2, black, face, NULL);
      layer_scene_paint (&s, 3, black, wall, NULL);
      cover = sheet_of (&s, 3, NULL, 2);
      CHECK (overlap (&s, cover, face) > 0.8);
      CHECK (area (&s, cover) < 1.25 * 3.1416 * 50 * 50 * scale * scale);
      for (int y = 0; y < s.height; y++)
        CHECK (cover[y * s.width + (int) (130 * scale)] <= 0);
      free (cover);
      layer_scene_close (&s);
    }
  scale = 1;
}

/* A limb that is hidden in the middle of an arch does not fill the arch: its inside is visible. */
static double arch (double x, double y) { return fmin (disc (x, y, 70, 80, 55), 1 - disc (x, y, 70, 80, 38)); }
static double lintel (double x, double y) { return box (x, y, 55, 15, 85, 60); }

static void
an_arch_goes_on_as_an_arch (void)
{
  for (scale = 1; scale < 6; scale += 4)
    {
      LayerScene s = scene (140, 150);
      float     *cover;

      layer_scene_paint (&s, 2, black, arch, NULL);
      layer_scene_paint (&s, 3, black, lintel, NULL);
      cover = sheet_of (&s, 3, NULL, 2);
      CHECK (overlap (&s, cover, arch) > 0.95);
      free (cover);
      layer_scene_close (&s);
    }
  scale = 1;
}

int
main (void)
{
  RUN (nothing_makes_a_hole_in_what_it_lies_on);
  RUN (parts_at_the_outline_leave_no_bite);
  RUN (a_limb_goes_on_behind_a_post);
  RUN (a_thin_rim_beyond_a_panel_counts);
  RUN (thin_limbs_join_behind_wide_posts);
  RUN (a_disc_goes_on_behind_a_board);
  RUN (a_stem_keeps_its_width_for_a_while);
  RUN (a_strip_goes_on_under_its_curtains);
  RUN (what_nothing_hides_stays_as_it_is);
  RUN (half_a_disc_is_completed_once);
  RUN (an_arch_goes_on_as_an_arch);
  return DONE;
}
