/* Depth enhancement: shadows as a Gaussian over all pixels makes them, where they fall, and unsharp masking.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"

enum { W = 96, H = 64 };

static float levels[W * H], change[W * H];
static CeldPlane level_plane = { W, H, W, levels }, change_plane = { W, H, W, change };

static double
diagonal (void)
{
  return hypot (W, H);
}

/* Settings with a blur of so many pixels. */
static CeldSettings
blur_of (double deviation, CeldEnhance way)
{
  CeldSettings s = celd_settings ();

  s.enhance         = way;
  s.shadow_strength = 0.5f;
  s.shadow_size     = (float) (deviation / diagonal ());
  return s;
}

/* Random discs, each of a level of its own. */
static void
draw_discs (uint32_t seed, int n)
{
  memset (levels, 0, sizeof levels);
  for (int k = 1; k <= n; k++)
    {
      double x = check_random (&seed, W), y = check_random (&seed, H), r = 4 + check_random (&seed, 18);

      for (int i = 0; i < W * H; i++)
        if (hypot (i % W - x, i / W - y) < r)
          levels[i] = (float) k / (float) n;
    }
}

/* The Gaussian mean of "is at this level" round (x,y), pixel by pixel, the picture mirrored at its edges. */
static double
matte_at (float level, double x, double y, double deviation)
{
  double sum = 0, all = 0;
  int    reach = (int) ceil (4 * deviation) + 1;

  for (int v = (int) floor (y) - reach; v <= (int) floor (y) + reach; v++)
    for (int u = (int) floor (x) - reach; u <= (int) floor (x) + reach; u++)
      {
        double weight = exp (-0.5 * ((u - x) * (u - x) + (v - y) * (v - y)) / (deviation * deviation));
        int    cu = u < 0 ? -1 - u : u < W ? u : 2 * W - 1 - u, cv = v < 0 ? -1 - v : v < H ? v : 2 * H - 1 - v;

        all += weight;
        sum += levels[cv * W + cu] == level ? weight : 0;
      }
  return sum / all;
}

/* Stacking by definition: what is left of the light of (x,y). */
static double
light_at (int x, int y, int n, double deviation, const CeldSettings *s)
{
  double own = (double) levels[y * W + x], light = 1, angle = (double) s->light_azimuth * acos (-1) / 180;
  double far = (double) s->shadow_offset * diagonal ();

  for (int k = 1; k <= n; k++)
    {
      float  level = (float) k / (float) n;
      double before = (double) level - own, share = s->shadow_range > 0 ? before / (double) s->shadow_range : 1;

      if (before > 0)
        light *= 1 - (double) s->shadow_strength * fmin (share, 1)
                     * matte_at (level, x + far * cos (angle), y - far * sin (angle), deviation);
    }
  return light;
}

static void
compare_stack (int n, double deviation, const CeldSettings *s)
{
  double worst = 0;

  CHECK (celd_enhance (&level_plane, s, NULL, &change_plane) == CELD_OK);
  for (int y = 0; y < H; y += 3)
    for (int x = 0; x < W; x += 3)
      worst = fmax (worst, fabs ((double) change[y * W + x] + 1 - light_at (x, y, n, deviation, s)));
  NEAR (worst, 0, 0.025);
}

static void
shadows_are_those_of_a_gaussian (void)
{
  for (uint32_t seed = 1; seed <= 4; seed++)
    for (int n = 1; n <= 7; n += 3)
      for (int d = 0; d < 3; d++)
        {
          double       deviation = (double[]) { 1.5, 4, 8.5 }[d];
          CeldSettings s = blur_of (deviation, CELD_ENHANCE_STACK);

          draw_discs (seed, n);
          compare_stack (n, deviation, &s);
        }
}

static void
shadows_lie_away_from_the_light (void)
{
  CeldSettings s = blur_of (4, CELD_ENHANCE_STACK);

  draw_discs (9, 4);
  s.shadow_offset = 0.07f;
  s.shadow_range  = 0.6f;
  for (int azimuth = -90; azimuth <= 200; azimuth += 58)
    {
      s.light_azimuth = (float) azimuth;
      compare_stack (4, 4, &s);
    }
}

/* A border down the middle: left is behind. */
static void
draw_halves (void)
{
  for (int i = 0; i < W * H; i++)
    levels[i] = i % W >= W / 2;
}

static void
a_straight_border_casts_an_error_function (void)
{
  CeldSettings s = blur_of (6, CELD_ENHANCE_STACK);

  draw_halves ();
  CHECK (celd_enhance (&level_plane, &s, NULL, &change_plane) == CELD_OK);
  for (int x = 0; x < W; x++)
    {
      double beyond = W / 2 - (x + 0.5);

      NEAR (change[20 * W + x], x < W / 2 ? -0.25 * erfc (beyond / 6 / sqrt (2)) : 0, 0.01);
    }
}

static void
unsharp_masking_darkens_behind_a_boundary_and_lightens_in_front (void)
{
  CeldSettings s = blur_of (6, CELD_ENHANCE_CONTRAST);

  draw_halves ();
  CHECK (celd_enhance (&level_plane, &s, NULL, &change_plane) == CELD_OK);
  for (int x = 0; x < W / 2; x++)
    {
      NEAR (change[20 * W + x], -0.25 * erfc ((W / 2 - (x + 0.5)) / 6 / sqrt (2)), 0.01);
      NEAR (change[20 * W + x], -change[20 * W + W - 1 - x], 1e-5);
    }
  s.enhance = CELD_ENHANCE_DARKEN;
  CHECK (celd_enhance (&level_plane, &s, NULL, &change_plane) == CELD_OK);
  for (int x = W / 2; x < W; x++)
    NEAR (change[20 * W + x], 0, 1e-6);
  CHECK (change[20 * W + W / 2 - 1] < -0.2f);
}

static void
the_scale_of_levels_does_not_matter (void)
{
  static float first[W * H];

  for (int way = CELD_ENHANCE_STACK; way <= (int) CELD_ENHANCE_CONTRAST; way++)
    {
      CeldSettings s = blur_of (3, (CeldEnhance) way);

      s.shadow_range = 0.5f;
      draw_discs (3, 5);
      CHECK (celd_enhance (&level_plane, &s, NULL, &change_plane) == CELD_OK);
      memcpy (first, change, sizeof first);
      for (int i = 0; i < W * H; i++)
        levels[i] = levels[i] * 5 + 2;
      CHECK (celd_enhance (&level_plane, &s, NULL, &change_plane) == CELD_OK);
      for (int i = 0; i < W * H; i++)
        NEAR (change[i], first[i], 1e-5);
    }
}

static void
one_level_changes_nothing (void)
{
  for (int way = CELD_ENHANCE_STACK; way <= (int) CELD_ENHANCE_CONTRAST; way++)
    {
      CeldSettings s = blur_of (8, (CeldEnhance) way);

      for (int i = 0; i < W * H; i++)
        levels[i] = 0.37f;
      CHECK (celd_enhance (&level_plane, &s, NULL, &change_plane) == CELD_OK);
      for (int i = 0; i < W * H; i++)
        NEAR (change[i], 0, 1e-6);
    }
}

/* More levels than are told apart, and values that are no numbers. */
static void
any_values_give_shares_of_light (void)
{
  uint32_t seed = 5;

  for (int way = CELD_ENHANCE_STACK; way <= (int) CELD_ENHANCE_CONTRAST; way++)
    for (int round = 0; round < 6; round++)
      {
        CeldSettings s = blur_of (0.3 + 4 * round, (CeldEnhance) way);

        for (int i = 0; i < W * H; i++)
          levels[i] = round % 2 ? (float) check_random (&seed, 100000) * 1e30f : (float) (i / 7);
        levels[11] = NAN, levels[W + 5] = INFINITY, levels[77] = -INFINITY;
        CHECK (celd_enhance (&level_plane, &s, NULL, &change_plane) == CELD_OK);
        for (int i = 0; i < W * H; i++)
          CHECK (change[i] >= -1 && change[i] <= (way == (int) CELD_ENHANCE_CONTRAST ? 1 : 0));
      }
}

static void
the_order_of_jobs_does_not_matter (void)
{
  static float first[W * H];
  CeldHost     host = { NULL, check_backwards, NULL };

  for (int way = CELD_ENHANCE_STACK; way <= (int) CELD_ENHANCE_CONTRAST; way++)
    {
      CeldSettings s = blur_of (3, (CeldEnhance) way);

      draw_discs (7, 6);
      CHECK (celd_enhance (&level_plane, &s, NULL, &change_plane) == CELD_OK);
      memcpy (first, change, sizeof first);
      CHECK (celd_enhance (&level_plane, &s, &host, &change_plane) == CELD_OK);
      CHECK (!memcmp (first, change, sizeof first));
    }
}

static void
hosts_can_cancel_and_bad_input_is_refused (void)
{
  CeldSettings s = blur_of (3, CELD_ENHANCE_STACK);
  CeldPlane    small = { W - 1, H, W, change };
  CeldHost     host = { check_refuse, NULL, NULL };

  draw_discs (7, 6);
  for (int way = CELD_ENHANCE_STACK; way <= (int) CELD_ENHANCE_CONTRAST; way++)
    {
      s.enhance = (CeldEnhance) way;
      CHECK (celd_enhance (&level_plane, &s, &host, &change_plane) == CELD_CANCELLED);
    }
  CHECK (celd_enhance (&level_plane, &s, NULL, &small) == CELD_BAD_SIZE);
  s.shadow_size = 0;
  CHECK (celd_enhance (&level_plane, &s, NULL, &change_plane) == CELD_BAD_VALUE);
}

/* Black, grey and white under a change to darker, none, and to lighter. */
static void
ink_stays_ink_and_white_white (void)
{
  float       to[3] = { -0.25f, 0, 0.5f };
  float       wanted[9] = { 0, 0.375f, 0.75f, 0, 0.5f, 1, 0, 1, 1 };
  float       rgba[12] = { 0, 0.5f, 1, 0.3f, 0, 0.5f, 1, 1, 0, 0.8f, 1, 0 };
  CeldPlane   change3 = { 3, 1, 3, to };
  CeldColours art = { 3, 1, 3, rgba };

  CHECK (celd_enhance_colours (&change3, &art) == CELD_OK);
  for (int i = 0; i < 9; i++)
    NEAR (rgba[i / 3 * 4 + i % 3], wanted[i], 1e-6);
  CHECK (rgba[3] == 0.3f && rgba[7] == 1 && rgba[11] == 0); /* alpha stays */
}

/* Over opaque art in linear light, the layer does what the art got by itself. */
static void
the_layer_laid_over_the_art_is_the_enhanced_art (void)
{
  static float rgba[4 * W * H], cover[4 * W * H];
  CeldSettings s = blur_of (4, CELD_ENHANCE_STACK);
  CeldColours  art = { W, H, W, rgba }, layer = { W, H, W, cover };
  uint32_t     seed = 8;

  draw_discs (2, 5);
  CHECK (celd_enhance (&level_plane, &s, NULL, &change_plane) == CELD_OK);
  CHECK (celd_enhance_layer (&change_plane, &layer) == CELD_OK);
  for (int i = 0; i < 4 * W * H; i++)
    rgba[i] = i % 4 == 3 ? 1 : (float) check_random (&seed, 256) / 255;
  for (int i = 0; i < 4 * W * H; i++)
    cover[i] = i % 4 == 3 ? 1 : cover[i] * cover[i | 3] + rgba[i] * (1 - cover[i | 3]);
  CHECK (celd_enhance_colours (&change_plane, &art) == CELD_OK);
  for (int i = 0; i < 4 * W * H; i++)
    NEAR (rgba[i], cover[i], 1e-6);
}

static void
the_view_is_brighter_where_it_is_nearer (void)
{
  float     level[4] = { 2, 4, 3, NAN }, none[4] = { 0 }, grey[4];
  CeldPlane four = { 4, 1, 4, level }, no_change = { 4, 1, 4, none }, view = { 4, 1, 4, grey };

  CHECK (celd_enhance_view (&four, &no_change, &view) == CELD_OK);
  NEAR (grey[1], 1, 1e-6);
  CHECK (grey[3] > 0 && grey[3] < grey[0] && grey[0] < grey[2] && grey[2] < 1); /* no number is the farthest here */
}

/* The stack without an offset, whatever method and offset the settings have. */
static void
occlusion_is_what_the_stack_leaves (void)
{
  static float open[W * H];
  CeldPlane    occlusion = { W, H, W, open };
  CeldSettings s = blur_of (3, CELD_ENHANCE_STACK), other = s;

  draw_discs (11, 6);
  other.enhance       = CELD_ENHANCE_CONTRAST;
  other.shadow_offset = 0.1f;
  CHECK (celd_enhance (&level_plane, &s, NULL, &change_plane) == CELD_OK);
  CHECK (celd_occlusion (&level_plane, &other, NULL, &occlusion) == CELD_OK);
  for (int i = 0; i < W * H; i++)
    {
      NEAR (open[i], 1 + change[i], 1e-6);
      CHECK (open[i] > 0 && open[i] <= 1);
    }
  CHECK (celd_occlusion (&level_plane, &s, NULL, &(CeldPlane) { W, H - 1, W, open }) == CELD_BAD_SIZE);
}

static void
one_pixel_will_do (void)
{
  float        level = 3, result = 9;
  CeldPlane    one = { 1, 1, 1, &level }, to = { 1, 1, 1, &result };
  CeldSettings s = celd_settings ();

  for (int way = CELD_ENHANCE_STACK; way <= (int) CELD_ENHANCE_CONTRAST; way++)
    {
      s.enhance       = (CeldEnhance) way;
      s.shadow_offset = 0.2f;
      CHECK (celd_enhance (&one, &s, NULL, &to) == CELD_OK);
      NEAR (result, 0, 0);
    }
}

/* Smooth depth has more values than the stack distinguishes, and here many of the evenly spaced ones have no pixel. */
static void
long_pictures_of_smooth_depth_with_a_gap_have_shadows (void)
{
  enum { LONG = 2000, LOW = 8 };
  static float depth[LONG * LOW], to[LONG * LOW];
  CeldPlane    from = { LONG, LOW, LONG, depth }, result = { LONG, LOW, LONG, to };
  CeldSettings s = celd_settings ();

  for (int i = 0; i < LONG * LOW; i++)
    depth[i] = (i % LONG < LONG / 2 ? 0 : 1) + 0.1f * (float) (i % LONG) / LONG;
  CHECK (celd_enhance (&from, &s, NULL, &result) == CELD_OK);
  CHECK (to[LONG / 2 - 1] < -0.1f);
  NEAR (to[LONG - 1], 0, 0.01);
}

int
main (void)
{
  RUN (shadows_are_those_of_a_gaussian);
  RUN (shadows_lie_away_from_the_light);
  RUN (a_straight_border_casts_an_error_function);
  RUN (unsharp_masking_darkens_behind_a_boundary_and_lightens_in_front);
  RUN (the_scale_of_levels_does_not_matter);
  RUN (one_level_changes_nothing);
  RUN (any_values_give_shares_of_light);
  RUN (the_order_of_jobs_does_not_matter);
  RUN (hosts_can_cancel_and_bad_input_is_refused);
  RUN (ink_stays_ink_and_white_white);
  RUN (the_layer_laid_over_the_art_is_the_enhanced_art);
  RUN (the_view_is_brighter_where_it_is_nearer);
  RUN (occlusion_is_what_the_stack_leaves);
  RUN (one_pixel_will_do);
  RUN (long_pictures_of_smooth_depth_with_a_gap_have_shadows);
  return DONE;
}
