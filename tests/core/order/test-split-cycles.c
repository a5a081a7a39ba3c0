/* Contradictions that splits resolve: where the cut runs, that an order is left, and that the sheet bends.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "order/order.h"

#define W 64
#define H 48

typedef struct
{
  uint32_t      pixel[W * H];
  float         luma[W * H];
  CeldLabels    labels;
  CeldPlane     ink;
  CeldPalette   palette;
  CeldRelations relations;
  CeldSplits    splits;
} Page;

static void
page_new (Page *p, size_t n_labels)
{
  *p = (Page) { .labels = { W, H, W, p->pixel }, .ink = { W, H, W, p->luma },
                .palette = { calloc (16, sizeof (CeldRegion)), n_labels } /* as if grown one by one */ };
  for (size_t k = 0; k < n_labels; k++)
    p->palette.item[k] = (CeldRegion) { .colour = { (uint8_t) (20 * k + 10), 0, 0, 255 } };
  for (size_t i = 0; i < W * H; i++)
    p->luma[i] = 1;
}

static void
page_clear (Page *p)
{
  celd_palette_clear (&p->palette);
  celd_relations_clear (&p->relations);
  celd_free (p->splits.item);
}

static void
fill (Page *p, int left, int top, int right, int bottom, uint32_t label, float ink)
{
  for (int y = top; y < bottom; y++)
    for (int x = left; x < right; x++)
      {
        p->pixel[y * W + x] = label;
        p->luma[y * W + x]  = ink;
      }
}

static void
count (Page *p)
{
  for (size_t k = 0; k < p->palette.n; k++)
    p->palette.item[k].area = 0;
  for (size_t i = 0; i < W * H; i++)
    {
      CeldRegion *region = &p->palette.item[p->pixel[i] - 1];

      if (!region->area++)
        {
          region->x = (int) (i % W);
          region->y = (int) (i / W);
        }
    }
}

static void
split (Page *p)
{
  CeldSettings s = celd_settings ();

  CHECK (celd_cycles_split (&p->relations, &p->ink, &s, NULL, &p->labels, &p->palette, &p->splits) == CELD_OK);
}

/* Three bars, each before the next: the first one is over the second at its left end and under the third at its right
 * end. */
static void
bars (Page *p)
{
  page_new (p, 4);
  fill (p, 0, 0, W, H, 4, 1);
  fill (p, 4, 4, 60, 12, 1, 1);
  fill (p, 4, 18, 20, 26, 2, 1);
  fill (p, 44, 18, 60, 26, 3, 1);
  p->palette.item[3].background = true;
  count (p);
  CHECK (celd_relations_parse ("8,8 > 8,22; 16,22 > 48,22; 56,22 > 56,8", &p->relations, NULL) == CELD_OK);
}

static void
one_bar_bends (void)
{
  Page         p;
  CeldSettings s = celd_settings ();
  CeldOrder    order = { 0 };
  size_t       first = 0, other = 0;

  bars (&p);
  split (&p);
  CHECK (p.splits.n == 1 && p.palette.n == 5);
  CHECK (!memcmp (p.palette.item[4].colour, p.palette.item[p.splits.item[0].label - 1].colour, 4));
  for (size_t i = 0; i < W * H; i++)
    {
      first += p.pixel[i] == p.splits.item[0].label;
      other += p.pixel[i] == 5;
    }
  CHECK (first == p.palette.item[p.splits.item[0].label - 1].area && other == p.palette.item[4].area && other > 0);
  s.on_cycle = CELD_ON_CYCLE_SPLIT;
  CHECK (celd_order (&p.labels, &p.palette, &p.relations, &p.ink, &s, NULL, &order, NULL) == CELD_OK);
  CHECK (order.n_cycles == 0);
  celd_order_clear (&order);
  page_clear (&p);
}

/* A line of ink across the first bar is where cutting it costs least. */
static void
the_cheapest_cut_is_made (void)
{
  Page p;

  bars (&p);
  fill (&p, 30, 4, 32, 12, 1, 0);
  split (&p);
  CHECK (p.splits.n == 1 && p.splits.item[0].label == 1);
  for (int y = 4; y < 12; y++)
    CHECK (p.pixel[y * W + 29] != p.pixel[y * W + 32]);
  celd_splits_erase (&p.splits, &p.labels, 2, &p.ink);
  for (int y = 6; y < 10; y++)
    CHECK (p.luma[y * W + 30] >= 1 && p.luma[y * W + 31] >= 1);
  page_clear (&p);
}

/* What shows of the first bar beyond a fourth thing goes with the half that is nearer to it. */
static void
parts_beyond_go_along (void)
{
  Page p;

  bars (&p);
  fill (&p, 60, 2, 61, 14, 3, 1);
  fill (&p, 61, 4, 64, 12, 1, 1);
  count (&p);
  fill (&p, 30, 4, 32, 12, 1, 0);
  split (&p);
  CHECK (p.splits.n == 1 && p.splits.item[0].label == 1);
  CHECK (p.pixel[8 * W + 62] == p.pixel[8 * W + 56] && p.pixel[8 * W + 62] != p.pixel[8 * W + 8]);
  page_clear (&p);
}

/* What cannot be cut: ends too near, ends of colours, equalities; labels stay as they are. */
static void
refused (void)
{
  static const char *const text[] = {
    "8,8 > 8,22; 8,22 > 48,22; 48,22 > 9,8",
    "#0a0000 > #1e0000; #1e0000 > #320000; #320000 > #0a0000",
    "8,8 = 8,22; 8,22 > 48,22; 48,22 = 56,8",
    "8,8 > 8,22; 16,22 > 48,22",
  };

  for (size_t i = 0; i < sizeof text / sizeof *text; i++)
    {
      Page p;

      bars (&p);
      celd_relations_clear (&p.relations);
      CHECK (celd_relations_parse (text[i], &p.relations, NULL) == CELD_OK);
      split (&p);
      CHECK (p.splits.n == 0 && p.palette.n == 4);
      page_clear (&p);
    }
}

/* Random rectangles over each other, and random arrows between points of them: an order is left that keeps all but
 * what is named, and every circle that is left passes no region that could be cut. */
static void
random_scenes (void)
{
  uint32_t state = 9;
  size_t   n_splits = 0, n_left = 0;

  for (int round = 0; round < 1000; round++)
    {
      Page         p;
      CeldSettings s = celd_settings ();
      CeldOrder    order = { 0 };
      size_t       n = 3 + check_random (&state, 6);
      bool         kept[32];

      page_new (&p, n);
      fill (&p, 0, 0, W, H, 1, 1);
      for (uint32_t k = 2; k <= n; k++)
        {
          int x = (int) check_random (&state, W - 16), y = (int) check_random (&state, H - 16);

          fill (&p, x, y, x + 12 + (int) check_random (&state, (uint32_t) (W - x - 11)),
                y + 8 + (int) check_random (&state, (uint32_t) (H - y - 7)), k, check_random (&state, 4) ? 1 : 0.3f);
        }
      p.palette.item[0].background = check_random (&state, 2);
      count (&p);
      for (size_t i = 3 + check_random (&state, 10); i > 0; i--)
        {
          CeldRelation r = { .nearer = { .x = check_random (&state, W) + 0.5, .y = check_random (&state, H) + 0.5 },
                             .farther = { .x = check_random (&state, W) + 0.5, .y = check_random (&state, H) + 0.5 },
                             .weight = 1 + check_random (&state, 3), .gap = 1 };

          CHECK (celd_relation_add (&p.relations, r) == CELD_OK);
        }
      split (&p);
      n_splits += p.splits.n;
      s.on_cycle = CELD_ON_CYCLE_SPLIT;
      CHECK (celd_order (&p.labels, &p.palette, &p.relations, NULL, &s, NULL, &order, NULL) == CELD_OK);
      n_left += order.n_cycles;
      for (size_t i = 0; i < p.relations.n; i++)
        kept[i] = true;
      for (size_t i = 0; i < order.n_cycles; i++)
        kept[order.cycle[i].item[0]] = false;
      for (size_t i = 0; i < p.relations.n; i++)
        {
          const CeldRelation *r = &p.relations.item[i];
          uint32_t            a = p.pixel[(int) r->nearer.y * W + (int) r->nearer.x];
          uint32_t            b = p.pixel[(int) r->farther.y * W + (int) r->farther.x];

          if (kept[i] && a != b)
            CHECK (order.level[a - 1] > order.level[b - 1]);
        }
      celd_order_clear (&order);
      page_clear (&p);
    }
  CHECK (n_splits > 300);
  CHECK (n_left < n_splits);
}

/* ------------------------------------------------------------------ in a session */

static const char *const CIRCLE[] = { "8,8 > 8,22", "16,22 > 48,22", "56,22 > 56,8" };

static void
outline (float *luma, int left, int top, int right, int bottom)
{
  for (int y = top; y < bottom; y++)
    for (int x = left; x < right; x++)
      luma[y * W + x] = x < left + 2 || y < top + 2 || x >= right - 2 || y >= bottom - 2 ? 0.f : 1.f;
}

static void
paint (CeldSession *s, uint32_t id, int left, int top, int right, int bottom)
{
  uint8_t  on[W * H], colour[3] = { (uint8_t) (60 * id), 20, 200 };
  CeldMask mask = { right - left, bottom - top, (size_t) (right - left), on };

  memset (on, 1, sizeof on);
  CHECK (celd_session_put_stroke (s, id, left, top, &mask, colour) == CELD_OK);
}

/* The three bars, outlined, with a line across the first, and so many relations of the circle. */
static CeldSession *
session_of_bars (size_t n)
{
  static float luma[W * H];
  CeldSession *s = celd_session_new ();
  CeldSettings settings = celd_settings ();

  for (size_t i = 0; i < W * H; i++)
    luma[i] = 1;
  outline (luma, 2, 2, 62, 14);
  outline (luma, 2, 16, 22, 28);
  outline (luma, 42, 16, 62, 28);
  for (int y = 4; y < 12; y++)
    luma[y * W + 30] = luma[y * W + 31] = 0;
  settings.on_cycle = CELD_ON_CYCLE_SPLIT;
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
  CHECK (celd_session_set_drawing (s, &(CeldDrawing) { .luma = { W, H, W, luma } }) == CELD_OK);
  paint (s, 1, 10, 7, 54, 9);
  paint (s, 2, 6, 20, 18, 22);
  paint (s, 3, 46, 20, 58, 22);
  paint (s, 4, 4, 36, 60, 40);
  for (size_t i = 0; i < n; i++)
    CHECK (celd_session_put_relation (s, (uint32_t) i + 1, CIRCLE[i], NULL) == CELD_OK);
  return s;
}

static void
check_same (CeldSession *a, CeldSession *b)
{
  CeldLabels labels[2];
  CeldPlane  flat[2], depth[2];

  for (int i = 0; i < 2; i++)
    {
      CHECK (celd_session_labels (i ? b : a, NULL, &labels[i], NULL) == CELD_OK);
      CHECK (celd_session_unexpanded_levels (i ? b : a, NULL, &flat[i], NULL) == CELD_OK);
      CHECK (celd_session_depth (i ? b : a, NULL, &depth[i], NULL) == CELD_OK);
    }
  CHECK (!memcmp (labels[0].data, labels[1].data, W * H * sizeof (uint32_t)));
  CHECK (!memcmp (flat[0].data, flat[1].data, W * H * sizeof (float)));
  for (size_t i = 0; i < W * H; i++)
    CHECK (fabsf (depth[0].data[i] - depth[1].data[i]) < 1e-3f);
}

/* A split is told, with a point of the part that is new; it goes with its cause. */
static void
splits_are_told (void)
{
  CeldSession        *s = session_of_bars (3);
  const CeldProblems *problems;
  CeldLabels          labels;
  char                text[400];

  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  problems = celd_session_problems (s);
  CHECK (problems->n == 1 && problems->item[0].kind == CELD_PROBLEM_REGION_SPLIT);
  CHECK (problems->n && problems->item[0].other == 5 &&
         CELD_AT (&labels, problems->item[0].x, problems->item[0].y) == 5);
  CHECK (problems->n && problems->item[0].label != 5);
  if (problems->n)
    celd_problem_text (&problems->item[0], celd_session_palette (s), celd_session_relations (s), NULL, text,
                       sizeof text);
  CHECK (strstr (text, "split"));
  CHECK (celd_session_remove_relation (s, 3) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK && celd_session_problems (s)->n == 0);
  celd_session_free (s);
}

static void
edits_equal_a_fresh_session (void)
{
  CeldSession *s = session_of_bars (3), *whole = session_of_bars (3), *open = session_of_bars (2);

  check_same (s, whole);
  CHECK (celd_session_palette (s)->n == 5);
  CHECK (celd_session_remove_relation (s, 3) == CELD_OK);
  check_same (s, open);
  CHECK (celd_session_palette (s)->n == 4);
  CHECK (celd_session_put_relation (s, 3, CIRCLE[2], NULL) == CELD_OK);
  check_same (s, whole);
  CHECK (celd_session_palette (s)->n == 5);
  celd_session_free (s);
  celd_session_free (whole);
  celd_session_free (open);
}

/* Depth of the first bar has the levels of both halves at the arrows' ends, and no step between. */
static void
the_sheet_bends (void)
{
  CeldSession     *s = session_of_bars (3);
  CeldPlane        flat, depth;
  const CeldOrder *order;

  CHECK (celd_session_order (s, NULL, &order) == CELD_OK && order->n_cycles == 0);
  CHECK (celd_session_unexpanded_levels (s, NULL, &flat, NULL) == CELD_OK);
  CHECK (celd_session_depth (s, NULL, &depth, NULL) == CELD_OK);
  CHECK (CELD_AT (&flat, 8, 8) > CELD_AT (&flat, 56, 8) + 0.5f);
  NEAR (CELD_AT (&depth, 8, 8), CELD_AT (&flat, 8, 8), 1e-3);
  NEAR (CELD_AT (&depth, 56, 8), CELD_AT (&flat, 56, 8), 1e-3);
  for (int x = 12; x < 52; x++)
    CHECK (fabsf (CELD_AT (&depth, x, 8) - CELD_AT (&depth, x + 1, 8)) < 0.06f);
  celd_session_free (s);
}

int
main (void)
{
  RUN (one_bar_bends);
  RUN (the_cheapest_cut_is_made);
  RUN (parts_beyond_go_along);
  RUN (refused);
  RUN (random_scenes);
  RUN (splits_are_told);
  RUN (edits_equal_a_fresh_session);
  RUN (the_sheet_bends);
  return DONE;
}
