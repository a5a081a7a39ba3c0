/* A small scene for the tests of faults-*.c, with input for each step.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "faults.h"

#include <string.h>

/* ------------------------------------------------------------------ the scene */

Pixels drawing_pixels, scribble_pixels, arrow_pixels, contour_pixels, label_pixels, lossy_pixels, crossing_pixels;
Pixels colour_pixels, ink_pixels, seed_pixels, level_pixels, expanded_pixels, normal_pixels;

CeldPalette   seed_palette, label_palette;
CeldRelations scene_relations;
CeldSettings  scene_settings;

static void
fill_box (Pixels *p, int left, int top, int right, int bottom, float luma, uint32_t rgba)
{
  for (int y = top; y < bottom; y++)
    for (int x = left; x < right; x++)
      {
        p->plane[y * W + x] = luma;
        for (int c = 0; c < 4; c++)
          p->paint[4 * (y * W + x) + c] = (uint8_t) (rgba >> (24 - 8 * c));
      }
}

/* Two overlapping sheets with outlines; a stroke in each and behind them; an arrow; a virtual contour of each kind;
 * arrows that cross in one colour, and in two; a pale, uneven stroke in a tinted block of white paper, as loss leaves
 * it. */
static void
draw_scene (void)
{
  Pixels *d = &drawing_pixels, *s = &scribble_pixels, *a = &arrow_pixels, *c = &contour_pixels;
  Pixels *l = &lossy_pixels;

  for (int p = 0; p < W * H; p++)
    d->plane[p] = d->alpha[p] = 1;
  fill_box (d, 6, 6, 34, 36, 0, 0);
  fill_box (d, 9, 9, 31, 33, 1, 0);
  fill_box (d, 24, 16, 58, 42, 0, 0);
  fill_box (d, 27, 19, 55, 39, 1, 0);
  fill_box (d, 40, 24, 41, 30, 0, 0);
  fill_box (s, 12, 12, 20, 16, 0, 0xe02020ff);
  fill_box (s, 32, 22, 50, 26, 0, 0x2040e0ff);
  fill_box (s, 2, 1, 60, 4, 0, 0x20c040ff);
  fill_box (a, 14, 24, 36, 26, 0, 0x202020ff);
  for (int k = 0; k < 6; k++)
    fill_box (a, 36 - k, 24 - k, 37 - k, 26 + k, 0, 0x202020ff);
  fill_box (&crossing_pixels, 4, 20, 50, 22, 0, 0x202020ff);
  fill_box (&crossing_pixels, 20, 4, 22, 40, 0, 0x202020ff);
  for (int k = 0; k < 6; k++)
    {
      fill_box (&crossing_pixels, 52 - k, 20 - k, 53 - k, 22 + k, 0, 0x202020ff);
      fill_box (&crossing_pixels, 20 - k, 42 - k, 22 + k, 43 - k, 0, 0x202020ff);
    }
  fill_box (&colour_pixels, 4, 12, 56, 16, 0, 0x202020ff); /* this one begins where a bar ends */
  fill_box (&colour_pixels, 2, 6, 6, 36, 0, 0xe02020ff); /* no arrow: read as lines that meet, too */
  fill_box (&colour_pixels, 28, 0, 31, 38, 0, 0xe08020ff);
  for (int k = 0; k < 8; k++)
    {
      fill_box (&colour_pixels, 60 - k, 14 - k, 61 - k, 14 + k, 0, 0x202020ff);
      fill_box (&colour_pixels, 29 - k, 41 - k, 30 + k, 42 - k, 0, 0xe08020ff);
    }
  fill_box (l, 0, 0, W, H, 0, 0xffffffff);
  fill_box (l, 0, 16, 32, 32, 0, 0xfff0f0ff);
  fill_box (l, 2, 20, 30, 24, 0, 0xd07080ff);
  for (int x = 4; x < 30; x += 4)
    fill_box (l, x, 20, x + 2, 24, 0, 0xe08090ff);
  fill_box (c, 20, 28, 23, 33, 0, 0xff0000ff);
  fill_box (c, 44, 33, 48, 36, 0, 0x0000ffff);
  fill_box (c, 40, 24, 42, 30, 0, 0x00ff00ff);
}

/* ------------------------------------------------------------------ the steps */

const Step *
step_at (size_t i)
{
  static const Step *const subject[] = { region_steps, depth_steps, use_steps, motion_steps, solver_steps };

  for (size_t k = 0; k < sizeof subject / sizeof *subject; k++)
    for (const Step *step = subject[k]; step->name; step++)
      if (!i--)
        return step;
  return NULL;
}

/* ------------------------------------------------------------------ inputs of later steps */

/* Does the step of that name. */
static bool
take (const char *name, Results *r)
{
  const Step *step;

  for (size_t i = 0; (step = step_at (i)) != NULL; i++)
    if (!strcmp (step->name, name))
      return step->go (NULL, r) == CELD_OK;
  return false;
}

bool
make_inputs (void)
{
  Results ink = { .pixels = &ink_pixels }, seeds = { .pixels = &seed_pixels }, all = { .pixels = &label_pixels };
  Results expanded = { .pixels = &expanded_pixels }, normals = { .pixels = &normal_pixels };
  bool    good;

  scene_settings = celd_settings ();
  draw_scene ();
  good = take ("ink", &ink) && take ("scribbles", &seeds) && seeds.palette.n == 3 && take ("scribbles", &all) &&
         take ("arrows", &all) && all.relations.n == 1 &&
         celd_relations_parse ("#e02020 < #2040e0; #e02020 > 1,1", &all.relations, NULL) == CELD_OK; /* a circle */
  seed_palette = seeds.palette;
  scene_relations = all.relations;
  good = good && take ("segment", &all) && take ("expand", &expanded);
  label_palette = all.palette;
  celd_problems_clear (&all.problems);
  for (int p = 0; p < W * H; p++)
    {
      level_pixels.plane[p] = (float) label_pixels.labels[p];
      expanded_pixels.plane[p] = (float) expanded_pixels.labels[p];
    }
  return good && take ("normals", &normals);
}

void
free_inputs (void)
{
  celd_palette_clear (&seed_palette);
  celd_palette_clear (&label_palette);
  celd_relations_clear (&scene_relations);
}
