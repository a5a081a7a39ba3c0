/* Single strokes over the scribbles layer: their labels, and the seeds that remain.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "check.h"
#include "image/image.h"
#include "session/session.h"

#define W 12
#define H 8

static const uint8_t red[3] = { 255, 0, 0 }, nearly_red[3] = { 254, 2, 1 }, green[3] = { 0, 255, 0 },
                     blue[3] = { 0, 0, 255 };

/* Seeds of a layer as text art, with a palette whose label k has the colour (10 k, 0, 0). */
typedef struct { CeldSeedRows seeds; CeldPalette palette; } Layer;

static Layer
layer_of (const char *const *rows)
{
  CeldLabels labels = art_labels (rows);
  Layer      layer = { 0 };
  uint32_t   most = 0;

  for (int i = 0; i < W * H; i++)
    most = labels.data[i] > most ? labels.data[i] : most;
  CHECK (celd_seed_rows_read (&labels, &layer.seeds) == CELD_OK);
  for (uint32_t k = 1; k <= most; k++)
    CHECK (celd_append_uncounted (layer.palette.item, layer.palette.n,
                                  (CeldRegion) { .colour = { (uint8_t) (10 * k), 0, 0, 255 } }) == CELD_OK);
  free (labels.data);
  return layer;
}

static void
clear (Layer *layer)
{
  celd_seed_rows_clear (&layer->seeds);
  celd_palette_clear (&layer->palette);
}

static const char *const nothing[] = {
  "............", "............", "............", "............",
  "............", "............", "............", "............", NULL
};

/* A box of a colour. */
static void
put (CeldSession *s, uint32_t id, int x, int y, int width, int height, const uint8_t colour[3])
{
  uint8_t  on[W * H];
  CeldMask mask = { width, height, (size_t) width, on };

  memset (on, 1, sizeof on);
  CHECK (celd_session_put_stroke (s, id, x, y, &mask, colour) == CELD_OK);
}

static void
strokes_have_labels_of_the_layer_or_new_ones (void)
{
  static const char *const rows[] = {
    "AA..........", "AA..........", "............", "BBB.........",
    "............", "............", "............", "............", NULL
  };
  static const uint8_t     as_b[3] = { 22, 1, 0 };
  CeldSession             *s = celd_session_new ();
  Layer                    layer = layer_of (rows);

  put (s, 1, 6, 0, 2, 2, green);
  put (s, 2, 6, 4, 2, 2, red);
  put (s, 3, 0, 6, 3, 1, as_b);        /* within the tolerance of colour management */
  put (s, 4, 9, 6, 1, 1, nearly_red);
  put (s, 5, 9, 0, 1, 1, green);
  CHECK (celd_strokes_compose (s->stroke, s->n_strokes, &layer.seeds, &layer.palette) == CELD_OK);
  CHECK (layer.palette.n == 4);
  CHECK (celd_seed_rows_at (&layer.seeds, 0, 0) == 1 && celd_seed_rows_at (&layer.seeds, 2, 3) == 2);
  CHECK (celd_seed_rows_at (&layer.seeds, 1, 6) == 2 && layer.palette.item[1].seeds == 6);
  CHECK (celd_seed_rows_at (&layer.seeds, 6, 0) == 3 && celd_seed_rows_at (&layer.seeds, 9, 0) == 3);
  CHECK (celd_seed_rows_at (&layer.seeds, 6, 4) == 4 && celd_seed_rows_at (&layer.seeds, 9, 6) == 4);
  CHECK (!memcmp (layer.palette.item[2].colour, (uint8_t[]) { 0, 255, 0, 255 }, 4));
  CHECK (layer.palette.item[2].origin == CELD_FROM_SCRIBBLE && layer.palette.item[2].seeds == 5);
  clear (&layer);
  celd_session_free (s);
}

static void
later_strokes_cover_earlier_ones (void)
{
  CeldSession *s = celd_session_new ();
  Layer        layer = layer_of (nothing);

  put (s, 1, 0, 0, 6, 2, red);
  put (s, 2, 4, 0, 6, 2, blue);
  put (s, 1, 0, 0, 7, 2, red); /* at its old place in the painting order: blue stays above */
  CHECK (celd_strokes_compose (s->stroke, s->n_strokes, &layer.seeds, &layer.palette) == CELD_OK);
  CHECK (celd_seed_rows_at (&layer.seeds, 3, 0) == 1 && celd_seed_rows_at (&layer.seeds, 4, 0) == 2);
  CHECK (layer.palette.item[0].seeds == 8 && layer.palette.item[1].seeds == 12);
  CHECK (layer.palette.item[1].x >= 4 && layer.palette.item[1].x < 10 && layer.palette.item[1].y < 2);
  clear (&layer);
  celd_session_free (s);
}

static void
covered_labels_are_removed (void)
{
  static const char *const rows[] = {
    "AA..........", "AA...BB.....", ".....BB.....", "............",
    "............", "............", "............", "............", NULL
  };
  CeldSession             *s = celd_session_new ();
  Layer                    layer = layer_of (rows);

  put (s, 1, 0, 0, 3, 3, red);
  put (s, 2, 2, 2, 2, 2, green);
  CHECK (celd_strokes_compose (s->stroke, s->n_strokes, &layer.seeds, &layer.palette) == CELD_OK);
  CHECK (layer.palette.n == 3 && layer.palette.item[0].colour[0] == 20);
  CHECK (celd_seed_rows_at (&layer.seeds, 5, 1) == 1 && celd_seed_rows_at (&layer.seeds, 0, 0) == 2);
  CHECK (celd_seed_rows_at (&layer.seeds, 2, 2) == 3);
  clear (&layer);
  celd_session_free (s);
}

static void
strokes_are_clipped_to_the_picture (void)
{
  CeldSession *s = celd_session_new ();
  Layer        layer = layer_of (nothing);

  put (s, 1, -3, -1, 5, 3, red);
  put (s, 2, W - 1, H - 1, 4, 4, blue);
  put (s, 3, INT32_MAX - 1, INT32_MIN, 4, 4, green);
  CHECK (celd_strokes_compose (s->stroke, s->n_strokes, &layer.seeds, &layer.palette) == CELD_OK);
  CHECK (layer.palette.n == 2 && layer.palette.item[0].seeds == 4 && layer.palette.item[1].seeds == 1);
  clear (&layer);
  celd_session_free (s);
}

/* Random masks over a random layer, compared with painting pixel by pixel. */
static void
random_strokes_equal_painting_by_pixels (void)
{
  static const uint8_t colour[5][3] = { { 10, 0, 0 }, { 20, 0, 0 }, { 0, 200, 0 }, { 0, 0, 200 }, { 90, 90, 90 } };
  uint32_t             state = 7;

  for (int round = 0; round < 200; round++)
    {
      CeldSession *s = celd_session_new ();
      char         text[H][W + 1] = { { 0 } };
      const char  *rows[H + 1] = { 0 };
      uint8_t      wanted[W * H], on[W * H]; /* index of the colour + 1 */
      Layer        layer;
      int          different = 0;

      for (int i = 0; i < W * H; i++)
        {
          text[i / W][i % W] = check_random (&state, 5) ? '.' : check_random (&state, 2) ? 'A' : 'B';
          wanted[i] = text[i / W][i % W] == '.' ? 0 : (uint8_t) (text[i / W][i % W] - 'A' + 1);
        }
      for (int y = 0; y < H; y++)
        rows[y] = text[y];
      layer = layer_of (rows);
      for (uint32_t id = 1; id <= 6; id++)
        {
          int      x = (int) check_random (&state, W + 6) - 5, y = (int) check_random (&state, H + 4) - 3;
          int      w = 1 + (int) check_random (&state, W), h = 1 + (int) check_random (&state, H);
          uint32_t c = check_random (&state, 5);
          CeldMask mask = { w, h, (size_t) w, on };

          for (int i = 0; i < w * h; i++)
            {
              int u = x + i % w, v = y + i / w;

              on[i] = (uint8_t) check_random (&state, 2);
              if (on[i] && u >= 0 && v >= 0 && u < W && v < H)
                wanted[v * W + u] = (uint8_t) (c + 1);
            }
          CHECK (celd_session_put_stroke (s, id, x, y, &mask, colour[c]) == CELD_OK);
        }
      CHECK (celd_strokes_compose (s->stroke, s->n_strokes, &layer.seeds, &layer.palette) == CELD_OK);
      for (int i = 0; i < W * H; i++)
        {
          uint32_t label = celd_seed_rows_at (&layer.seeds, i % W, i / W);

          different += !label != !wanted[i] ||
                       (label && memcmp (layer.palette.item[label - 1].colour, colour[wanted[i] - 1], 3));
        }
      CHECK (different == 0);
      clear (&layer);
      celd_session_free (s);
    }
}

int
main (void)
{
  RUN (strokes_have_labels_of_the_layer_or_new_ones);
  RUN (later_strokes_cover_earlier_ones);
  RUN (covered_labels_are_removed);
  RUN (strokes_are_clipped_to_the_picture);
  RUN (random_strokes_equal_painting_by_pixels);
  return DONE;
}
