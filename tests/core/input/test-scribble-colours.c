/* Exact colours of painted layers: counting, paper, and whether a layer was stored with loss.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "input/input.h"

enum { W = 64, H = 48 };

typedef struct { uint8_t rgba[H][W][4]; CeldPaint paint; CeldScribbleLayer reading; } Layer;

static Layer *
layer_new (uint8_t red, uint8_t green, uint8_t blue, uint8_t alpha)
{
  Layer *l = calloc (1, sizeof *l);

  l->paint = (CeldPaint) { W, H, W, &l->rgba[0][0][0] };
  l->reading = (CeldScribbleLayer) { .paint = &l->paint, .width = W, .height = H, .pixels = W * H,
                           .id = calloc (W * H, sizeof (uint32_t)), .label = calloc (W * H, sizeof (uint32_t)),
                           .kind = calloc (W * H, 1) };
  for (int i = 0; i < W * H; i++)
    memcpy (l->rgba[i / W][i % W], (uint8_t[4]) { red, green, blue, alpha }, 4);
  return l;
}

static void
layer_read (Layer *l, bool flats)
{
  CHECK (celd_scribble_colours (&l->reading, flats, NULL) == CELD_OK);
}

static const int *
colour_at (const Layer *l, int x, int y)
{
  return l->reading.colour[l->reading.id[y * W + x]].channel;
}

static void
layer_free (Layer *l)
{
  free (l->reading.id);
  free (l->reading.label);
  free (l->reading.kind);
  celd_free (l->reading.colour);
  celd_free (l->reading.slot);
  free (l);
}

/* More colours than the table has slots at first. */
static void
every_exact_colour_is_told_apart (void)
{
  Layer *l = layer_new (0, 0, 0, 255);
  int    wrong = 0;

  for (int i = 0; i < W * H; i++)
    memcpy (l->rgba[i / W][i % W], (uint8_t[2]) { (uint8_t) (i / W * 5), (uint8_t) (i % W * 4) }, 2);
  l->rgba[40][40][3] = 127;
  memcpy (l->rgba[30][30], l->rgba[2][2], 4);
  layer_read (l, true);
  NEAR (l->reading.n, 1 + W * H - 2, 0);
  for (int i = 0; i < W * H; i++)
    for (int k = 0; k < 3 && i != 40 * W + 40; k++)
      wrong += colour_at (l, i % W, i / W)[k] != l->rgba[i / W][i % W][k];
  NEAR (wrong, 0, 0);
  NEAR (l->reading.id[40 * W + 40], 0, 0);
  NEAR (l->reading.colour[l->reading.id[2 * W + 2]].pixels, 2, 0);
  NEAR (l->reading.colour[l->reading.id[2 * W + 2]].opacity, 510, 0);
  layer_free (l);
}

/* One stroke on white; one transparent pixel makes white a colour like any other, as a flat colouring does. */
static void
the_commonest_colour_of_an_opaque_layer_is_paper (void)
{
  for (int i = 0; i < 3; i++)
    {
      Layer *l = layer_new (255, 255, 255, 255);

      for (int x = 10; x < 50; x++)
        memcpy (l->rgba[20][x], (uint8_t[3]) { 200, 30, 30 }, 3);
      l->rgba[0][0][3] = i == 1 ? 0 : 255;
      layer_read (l, i == 2);
      NEAR (l->reading.paper, i ? 0 : l->reading.id[5 * W + 5], 0);
      CHECK (!l->reading.lossy);
      layer_free (l);
    }
}

/* Noise of up to 10 of 255 is loss, and is filtered; a ramp is no noise. */
static void
noise_is_loss_and_is_filtered (void)
{
  uint32_t state = 3;
  Layer   *noisy = layer_new (0, 0, 0, 255), *ramp = layer_new (0, 0, 0, 255);
  int      most = 0;

  for (int i = 0; i < W * H; i++)
    for (int k = 0; k < 3; k++)
      {
        noisy->rgba[i / W][i % W][k] = (uint8_t) (100 + check_random (&state, 21) - 10);
        ramp->rgba[i / W][i % W][k] = (uint8_t) (i % W * 4);
      }
  layer_read (noisy, true);
  layer_read (ramp, true);
  CHECK (noisy->reading.lossy && !ramp->reading.lossy);
  CHECK (noisy->reading.radius > ramp->reading.radius);
  for (int i = 0; i < W * H; i++)
    for (int k = 0; k < 3; k++)
      most = (int) fmax (most, abs (colour_at (noisy, i % W, i / W)[k] - 100));
  CHECK (most < 5);
  CHECK (noisy->rgba[0][0][0] != 100 || noisy->rgba[0][1][0] != 100); /* the layer itself is not touched */
  layer_free (noisy);
  layer_free (ramp);
}

int
main (void)
{
  RUN (every_exact_colour_is_told_apart);
  RUN (the_commonest_colour_of_an_opaque_layer_is_paper);
  RUN (noise_is_loss_and_is_filtered);
  return DONE;
}
