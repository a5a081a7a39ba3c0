/* In-betweens: a limb that crosses a body, parts that appear and vanish, an order that changes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "layer-scene.h"

#define SIDE     220
#define SHOULDER 100, 60  /* x, y */
#define SWING    50.0     /* degrees from hanging down, to the left in the first key and to the right in the second */
#define LENGTH   85.0     /* of the limb from the shoulder */
#define HALF     12.0     /* of its width */
#define MARGIN   5.0      /* pixels that a limb may be off its place */

static const float BODY[3] = { 1, 0.6f, 0.6f }, LIMB[3] = { 0.6f, 0.6f, 1 }, HAND[3] = { 0.6f, 0.9f, 0.6f };

/* ------------------------------------------------------------------ shapes */

static double angle; /* of the limb, degrees to the right from hanging down */

/* A place, along the limb from the shoulder and across it. */
static void
along_limb (double x, double y, double at[2])
{
  const double shoulder[2] = { SHOULDER }, a = angle * 3.14159265358979 / 180;

  at[0] = (x - shoulder[0]) * sin (a) + (y - shoulder[1]) * cos (a);
  at[1] = (x - shoulder[0]) * cos (a) - (y - shoulder[1]) * sin (a);
}

static double
share (double distance)
{
  return fmin (fmax (0.5 - distance, 0), 1);
}

/* Signed distances, negative inside. */
static double
to_box (double x, double y, double left, double top, double right, double bottom)
{
  return fmax (fmax (left - x, x - right), fmax (top - y, y - bottom));
}

static double to_body (double x, double y) { return to_box (x, y, 60, 30, 140, 190); }

static double
to_limb (double x, double y)
{
  double at[2];

  along_limb (x, y, at);
  return to_box (at[0], at[1], -HALF, -HALF, LENGTH, HALF);
}

static double
to_hand (double x, double y)
{
  double at[2];

  along_limb (x, y, at);
  return hypot (at[0] - LENGTH - 8, at[1]) - 14;
}

static double to_bag (double x, double y) { return to_box (x, y, 30, 100, 80, 140); }

static double body (double x, double y) { return share (to_body (x, y)); }
static double body_line (double x, double y) { return share (-to_body (x, y) - 3); }
static double limb (double x, double y) { return share (to_limb (x, y)); }
static double limb_line (double x, double y) { return share (-to_limb (x, y) - 3); }
static double hand (double x, double y) { return share (to_hand (x, y)); }
static double hand_line (double x, double y) { return share (-to_hand (x, y) - 3); }
static double bag (double x, double y) { return share (to_bag (x, y)); }
static double bag_line (double x, double y) { return share (-to_bag (x, y) - 3); }

/* ------------------------------------------------------------------ keys */

typedef struct { LayerScene scene; CeldLayers *layers; } Key;

/* A body, and a limb of that angle in front of it or behind it; labels 1 page, 2 body, 3 limb, 4 hand, 5 bag behind the
 * body. */
static Key
key_of (double degrees, bool front, bool with_hand, bool with_bag)
{
  Key k = { layer_scene (SIDE, SIDE), NULL };

  angle = degrees;
  k.scene.level[0] = 0;
  k.scene.level[1] = 2;
  k.scene.level[2] = front ? 3 : 1;
  k.scene.level[3] = 4;
  k.scene.level[4] = 1;
  if (with_bag)
    layer_scene_paint (&k.scene, 5, HAND, bag, bag_line);
  if (!front)
    layer_scene_paint (&k.scene, 3, LIMB, limb, limb_line);
  layer_scene_paint (&k.scene, 2, BODY, body, body_line);
  if (front)
    layer_scene_paint (&k.scene, 3, LIMB, limb, limb_line);
  if (with_hand)
    layer_scene_paint (&k.scene, 4, HAND, hand, hand_line);
  k.layers = layer_scene_cut (&k.scene, 5, CELD_STORE_FLOAT, true);
  return k;
}

static void
key_close (Key *k)
{
  celd_layers_free (k->layers);
  layer_scene_close (&k->scene);
}

static CeldInbetween *
between_of (const Key *a, const Key *b, const CeldHost *host)
{
  CeldKey        key[2] = { { a->layers, &a->scene.ink, 1 }, { b->layers, &b->scene.ink, 1 } };
  CeldSettings   settings = celd_settings ();
  CeldInbetween *between = NULL;

  CHECK (celd_inbetween_new (key, &settings, host, &between) == CELD_OK);
  return between;
}

static float       canvas_data[4 * SIDE * SIDE];
static CeldColours canvas = { SIDE, SIDE, SIDE, canvas_data };

static void
draw (CeldInbetween *between, double t)
{
  CHECK (celd_inbetween_draw (between, t, NULL, &canvas) == CELD_OK);
}

static bool
has_colour (int x, int y, const float colour[3])
{
  const float *c = CELD_RGBA (&canvas, x, y);

  return fabsf (c[0] - colour[0]) + fabsf (c[1] - colour[1]) + fabsf (c[2] - colour[2]) < 0.02f && c[3] > 0.99f;
}

/* Pixels in the picture that have a colour, and those that should have it: deep in a shape. */
static size_t
count_colour (const float colour[3])
{
  size_t n = 0;

  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      n += has_colour (x, y, colour);
  return n;
}

/* Runs of ink across the limb, at a distance from the shoulder. */
static int
count_lines (double distance)
{
  const double shoulder[2] = { SHOULDER }, a = angle * 3.14159265358979 / 180;
  int          lines = 0;
  bool         dark = false;

  for (double s = -HALF - 4; s <= HALF + 4; s += 0.25)
    {
      int  x = (int) (shoulder[0] + distance * sin (a) + s * cos (a));
      int  y = (int) (shoulder[1] + distance * cos (a) - s * sin (a));
      bool here = CELD_RGBA (&canvas, x, y)[2] < 0.3f;

      lines += here && !dark;
      dark = here;
    }
  return lines;
}

/* ------------------------------------------------------------------ tests */

static double
difference (const LayerScene *s)
{
  double most = 0;

  for (size_t i = 0; i < 4 * SIDE * SIDE; i++)
    most = fmax (most, fabs ((double) (canvas_data[i] - s->art.data[i])));
  return most;
}

static void
the_keys_come_back (void)
{
  Key            a = key_of (-SWING, true, true, true), b = key_of (SWING, true, true, false);
  CeldInbetween *between = between_of (&a, &b, NULL);

  draw (between, 0.3);
  draw (between, 0);
  NEAR (difference (&a.scene), 0, 1 / 255.0);
  draw (between, 1);
  NEAR (difference (&b.scene), 0, 1 / 255.0);
  celd_inbetween_free (between);
  key_close (&a);
  key_close (&b);
}

/* The limb swings round the shoulder, at the angle that is due, in front of the body in every frame, with the two lines
 * that it has in the keys; its hand goes on its arc. */
static void
a_limb_crosses_the_body (void)
{
  Key            a = key_of (-SWING, true, true, false), b = key_of (SWING, true, true, false);
  CeldInbetween *between = between_of (&a, &b, NULL);

  for (int frame = 0; frame <= 8; frame++)
    {
      size_t wrong = 0;

      angle = -SWING + frame / 8.0 * 2 * SWING;
      draw (between, frame / 8.0);
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          {
            double u = x + 0.5, v = y + 0.5;

            if (to_hand (u, v) < -3 - MARGIN)
              wrong += !has_colour (x, y, HAND);
            else if (to_hand (u, v) > MARGIN && to_limb (u, v) < -3 - MARGIN)
              wrong += !has_colour (x, y, LIMB);
            else if (to_hand (u, v) > MARGIN && to_limb (u, v) > MARGIN && to_body (u, v) < -3 - MARGIN)
              wrong += !has_colour (x, y, BODY);
            else if (to_hand (u, v) > MARGIN && to_limb (u, v) > MARGIN && to_body (u, v) > MARGIN)
              wrong += !has_colour (x, y, (float[3]) { 1, 1, 1 });
          }
      NEAR (wrong, 0, 0);
      for (double distance = 0; distance <= 25; distance += 5)
        NEAR (count_lines (distance), 2, 0);
    }
  celd_inbetween_free (between);
  key_close (&a);
  key_close (&b);
}

/* Of a limb behind the body nothing shows there in any frame, whatever is hidden of it. */
static void
a_limb_passes_behind_the_body (void)
{
  Key            a = key_of (-SWING, false, false, false), b = key_of (SWING, false, false, false);
  CeldInbetween *between = between_of (&a, &b, NULL);

  for (int frame = 0; frame <= 6; frame++)
    {
      size_t wrong = 0;

      draw (between, frame / 6.0);
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          wrong += to_body (x + 0.5, y + 0.5) < -5 && !has_colour (x, y, BODY);
      NEAR (wrong, 0, 0);
    }
  celd_inbetween_free (between);
  key_close (&a);
  key_close (&b);
}

/* A bag that only the first key has goes behind the body, which hides it more and more; backwards it comes out. */
static void
parts_vanish_and_appear_behind_others (void)
{
  Key a = key_of (-10, true, false, true), b = key_of (10, true, false, false);

  for (int back = 0; back < 2; back++)
    {
      CeldInbetween *between = back ? between_of (&b, &a, NULL) : between_of (&a, &b, NULL);
      size_t         first = 0, last = SIZE_MAX;

      for (int frame = 0; frame <= 10; frame++)
        {
          size_t seen, wrong = 0;

          draw (between, back ? 1 - frame / 10.0 : frame / 10.0);
          seen = count_colour (HAND);
          CHECK (seen <= last);
          last  = seen;
          first = frame ? first : seen;
          for (int y = 120; y < 180; y++) /* below the limb */
            for (int x = 66; x < 134; x++)
              wrong += !has_colour (x, y, BODY) && y > 160;
          NEAR (wrong, 0, 0);
          if (frame == 5)
            CHECK (seen > first / 4 && seen < first * 3 / 4);
        }
      CHECK (first > 800);
      NEAR (last, 0, 0);
      celd_inbetween_free (between);
    }
  key_close (&a);
  key_close (&b);
}

/* A limb in front of the body in the first key, and behind it in the second, passes through it half way. */
static void
the_order_is_that_of_the_nearer_key (void)
{
  Key            a = key_of (-SWING, true, false, false), b = key_of (SWING, false, false, false);
  CeldInbetween *between = between_of (&a, &b, NULL);

  draw (between, 0.25);
  CHECK (has_colour (90, 80, LIMB));
  draw (between, 0.75);
  CHECK (has_colour (110, 80, BODY) && count_colour (LIMB) < 1500);
  celd_inbetween_free (between);
  key_close (&a);
  key_close (&b);
}

static void
frames_do_not_depend_on_order_or_threads (void)
{
  static float   first[4 * SIDE * SIDE];
  Key            a = key_of (-SWING, true, true, true), b = key_of (SWING, true, true, false);
  CeldHost       host = { .each = check_backwards };
  CeldInbetween *one = between_of (&a, &b, NULL), *other = between_of (&a, &b, &host);

  draw (one, 0.3);
  memcpy (first, canvas_data, sizeof first);
  draw (one, 0.8);
  CHECK (memcmp (first, canvas_data, sizeof first) != 0);
  CHECK (celd_inbetween_draw (other, 0.3, &host, &canvas) == CELD_OK);
  CHECK (memcmp (first, canvas_data, sizeof first) == 0);
  celd_inbetween_free (one);
  celd_inbetween_free (other);
  key_close (&a);
  key_close (&b);
}

static void
bad_input_is_refused (void)
{
  Key            a = key_of (-SWING, true, false, false);
  LayerScene     small = layer_scene (40, 40);
  CeldLayers    *page = layer_scene_cut (&small, 1, CELD_STORE_FLOAT, true);
  CeldKey        key[2] = { { a.layers, &a.scene.ink, 1 }, { page, &small.ink, 1 } };
  CeldSettings   settings = celd_settings ();
  CeldInbetween *between = NULL;

  CHECK (celd_inbetween_new (key, &settings, NULL, &between) == CELD_BAD_SIZE && !between);
  key[1] = key[0];
  settings.cell_size = -1;
  CHECK (celd_inbetween_new (key, &settings, NULL, &between) == CELD_BAD_VALUE && !between);
  between = between_of (&a, &a, NULL);
  CHECK (celd_inbetween_draw (between, -0.1, NULL, &canvas) == CELD_BAD_VALUE);
  CHECK (celd_inbetween_draw (between, 1.1, NULL, &canvas) == CELD_BAD_VALUE);
  CHECK (celd_inbetween_draw (between, (double) NAN, NULL, &canvas) == CELD_BAD_VALUE);
  CHECK (celd_inbetween_draw (between, 0.5, NULL, &(CeldColours) { 40, 40, 40, canvas_data }) == CELD_BAD_SIZE);
  draw (between, 0.5); /* of a key and itself */
  NEAR (difference (&a.scene), 0, 2 / 255.0);
  celd_inbetween_free (between);
  celd_layers_free (page);
  layer_scene_close (&small);
  key_close (&a);
}

int
main (void)
{
  RUN (the_keys_come_back);
  RUN (a_limb_crosses_the_body);
  RUN (a_limb_passes_behind_the_body);
  RUN (parts_vanish_and_appear_behind_others);
  RUN (the_order_is_that_of_the_nearer_key);
  RUN (frames_do_not_depend_on_order_or_threads);
  RUN (bad_input_is_refused);
  return DONE;
}
