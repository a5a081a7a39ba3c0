/* Orders to which relations are added one by one, against orders of all of them at once.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "order/order.h"

#define MOST_LABELS    14
#define MOST_RELATIONS 40

/* One row of pixels, region k at pixel k. */
typedef struct
{
  uint32_t      pixel[MOST_LABELS];
  CeldRegion    region[MOST_LABELS];
  CeldRelation  item[MOST_RELATIONS];
  CeldLabels    labels;
  CeldPalette   palette;
  CeldRelations relations;
  CeldSettings  settings;
} Scene;

static void
make_scene (Scene *s, uint32_t *state)
{
  uint32_t n = 3 + check_random (state, MOST_LABELS - 2);

  *s = (Scene) { .settings = celd_settings () };
  for (uint32_t k = 0; k < n; k++)
    {
      s->pixel[k] = k + 1;
      s->region[k] = (CeldRegion) { .colour = { (uint8_t) (10 * (k < 2 ? 0 : k)), 0, 0, 255 } }; /* two of one colour */
    }
  s->region[n - 1].background = check_random (state, 2);
  s->labels = (CeldLabels) { (int) n, 1, n, s->pixel };
  s->palette = (CeldPalette) { s->region, n };
  s->relations.item = s->item;
  s->settings.on_cycle = check_random (state, 3) ? CELD_ON_CYCLE_REPORT : CELD_ON_CYCLE_DROP_WEAKEST;
}

/* Most follow the numbers of the labels, so that not everything contradicts. */
static CeldRelation
make_relation (const Scene *s, bool fractions, uint32_t *state)
{
  uint32_t     n = (uint32_t) s->palette.n, a = check_random (state, n), b = (a + 1 + check_random (state, n - 1)) % n;
  bool         turn = a < b && check_random (state, 12);
  CeldRelation r = { .weight = 1 + check_random (state, 3), .gap = check_random (state, 4) ? 1 : 2,
                     .equal = check_random (state, 8) == 0 };

  r.nearer.x  = turn ? b : a;
  r.farther.x = turn ? a : b;
  r.nearer.by_colour = check_random (state, 10) == 0;
  memcpy (r.nearer.colour, s->region[(int) r.nearer.x].colour, 3);
  if (fractions && check_random (state, 3) == 0)
    r.gap = 0.25 * (1 + check_random (state, 7));
  return r;
}

static void
compare (const CeldOrder *a, const CeldOrder *b)
{
  CHECK (a->n == b->n && a->levels == b->levels && !a->height == !b->height && a->n_cycles == b->n_cycles &&
         a->n_knots == b->n_knots);
  if (check_bad)
    return;
  for (size_t k = 0; k < a->n_knots; k++)
    CHECK (a->knot[k].n == b->knot[k].n &&
           !memcmp (a->knot[k].item, b->knot[k].item, a->knot[k].n * sizeof *a->knot[k].item));
  CHECK (!memcmp (a->level, b->level, a->n * sizeof *a->level));
  CHECK (!a->height || !memcmp (a->height, b->height, a->levels * sizeof *a->height));
  for (size_t k = 0; k < a->n_cycles; k++)
    CHECK (a->cycle[k].n == b->cycle[k].n &&
           !memcmp (a->cycle[k].item, b->cycle[k].item, a->cycle[k].n * sizeof *a->cycle[k].item));
}

/* What has been added without an order of everything, of that with contradictions, and what was lifted. */
typedef struct { int added, knotted, lifted; } Count;

static void
add_one (Scene *s, bool fractions, uint32_t *state, CeldOrder *order, CeldRanks *ranks, Count *count)
{
  CeldRelation r = make_relation (s, fractions, state);
  CeldOrder    wanted = { 0 };
  uint32_t     near = celd_term_label (&s->labels, &s->palette, NULL, &r.nearer, &ranks->stroke);
  uint32_t     far = celd_term_label (&s->labels, &s->palette, NULL, &r.farther, &ranks->stroke);

  s->item[s->relations.n++] = r;
  CHECK (celd_order (&s->labels, &s->palette, &s->relations, NULL, &s->settings, NULL, &wanted, NULL) == CELD_OK);
  if (near && far && ranks->n && celd_ranks_add (ranks, &r, near, far, order))
    {
      count->added++;
      count->knotted += ranks->knotted;
      count->lifted += ranks->n_list > 0;
    }
  else
    CHECK (celd_order_keep (&s->labels, &s->palette, &s->relations, NULL, &s->settings, NULL, order, NULL, ranks) ==
           CELD_OK);
  compare (order, &wanted);
  celd_order_clear (&wanted);
}

static void
one_by_one (void)
{
  uint32_t state = 11;
  Count    count = { 0 };

  for (int round = 0; round < 400 && !check_bad; round++)
    {
      Scene     s;
      CeldOrder order = { 0 };
      CeldRanks ranks = { 0 };

      make_scene (&s, &state);
      CHECK (celd_order_keep (&s.labels, &s.palette, &s.relations, NULL, &s.settings, NULL, &order, NULL, &ranks) ==
             CELD_OK);
      CHECK (ranks.n == s.palette.n);
      for (int i = 0; i < MOST_RELATIONS && !check_bad; i++)
        add_one (&s, round % 4 == 0, &state, &order, &ranks, &count);
      celd_order_clear (&order);
      celd_ranks_clear (&ranks);
    }
  CHECK (count.added > 4000 && count.knotted > 1000 && count.lifted > 1000); /* else the test would say little */
}

/* A label without a pixel has no level of its own, which one more relation may give it. */
static void
lost_labels_are_not_kept_up (void)
{
  uint32_t      pixel[2] = { 1, 2 };
  CeldRegion    region[3] = { { .colour = { 1, 0, 0, 255 } }, { .colour = { 9, 0, 0, 255 } },
                              { .colour = { 99, 0, 0, 255 } } };
  CeldLabels    labels = { 2, 1, 2, pixel };
  CeldPalette   palette = { region, 3 };
  CeldRelations none = { 0 };
  CeldOrder     order = { 0 };
  CeldRanks     ranks = { 0 };

  CHECK (celd_order_keep (&labels, &palette, &none, NULL, NULL, NULL, &order, NULL, &ranks) == CELD_OK);
  CHECK (order.n == 3 && ranks.n == 0);
  celd_order_clear (&order);
  celd_ranks_clear (&ranks);
}

int
main (void)
{
  RUN (one_by_one);
  RUN (lost_labels_are_not_kept_up);
  return DONE;
}
