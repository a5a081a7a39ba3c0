/* What keys of a clip have in common: a palette, and relations that name colours.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

enum { W = 4, H = 2 };

static const CeldRegion RED = { .colour = { 255, 0, 0, 255 } }, BLUE = { .colour = { 0, 0, 255, 255 } };
static const CeldRegion GREEN = { .colour = { 0, 255, 0, 255 } };
static const CeldRegion PAGE = { .colour = { 255, 255, 255, 255 }, .background = true };
static const CeldRegion NO_PAGE = { .colour = { 0, 0, 255, 0 }, .background = true };

/* Labels of a picture as digits. */
static CeldLabels
labels_of (const char *text, uint32_t label[W * H])
{
  for (int i = 0; i < W * H; i++)
    label[i] = (uint32_t) (text[i] - '0');
  return (CeldLabels) { W, H, W, label };
}

/* Joins the labels of a key, in place. */
static void
join (const char *text, CeldRegion *region, size_t n, CeldPalette *all, const char *expected)
{
  uint32_t    label[W * H];
  CeldLabels  labels = labels_of (text, label);
  CeldPalette palette = { region, n };

  CHECK (celd_join_labels (&labels, &palette, all, &labels) == CELD_OK);
  for (int i = 0; i < W * H; i++)
    CHECK (label[i] == (uint32_t) (expected[i] - '0'));
}

static void
regions_of_one_colour_are_one (void)
{
  CeldRegion  first[] = { RED, BLUE }, second[] = { GREEN, BLUE, RED };
  CeldPalette all = { 0 };

  join ("11220122", first, 2, &all, "11220122");
  CHECK (all.n == 2);
  join ("11223301", second, 3, &all, "33221103");
  CHECK (all.n == 3 && !memcmp (&all.item[0], &RED, sizeof RED) && !memcmp (&all.item[2], &GREEN, sizeof GREEN));
  celd_palette_clear (&all);
}

/* Whether it is scribbled or not, and whatever colour a transparent one happens to have. */
static void
all_backgrounds_are_one (void)
{
  CeldRegion  first[] = { RED, NO_PAGE }, second[] = { PAGE, BLUE, RED }, third[] = { NO_PAGE };
  CeldPalette all = { 0 };

  join ("11222222", first, 2, &all, "11222222");
  join ("11112233", second, 3, &all, "22223311");
  join ("11111111", third, 1, &all, "22222222");
  CHECK (all.n == 3 && all.item[1].background && !all.item[2].background);
  celd_palette_clear (&all);
}

static void
bad_labels_are_refused (void)
{
  uint32_t    label[W * H], other[W * H];
  CeldRegion  region[] = { RED };
  CeldPalette palette = { region, 1 }, all = { 0 };
  CeldLabels  labels = labels_of ("11111112", label), joined = { W, H - 1, W, other };

  CHECK (celd_join_labels (&labels, &palette, &all, &joined) == CELD_BAD_SIZE);
  joined.height = H;
  CHECK (celd_join_labels (&labels, &palette, &all, &joined) == CELD_BAD_VALUE && !all.n);
}

static void
relations_get_colours (void)
{
  uint32_t     label[W * H];
  CeldRegion   region[] = { RED, BLUE, NO_PAGE };
  CeldPalette  palette = { region, 3 };
  CeldLabels   labels = labels_of ("11223333", label);
  CeldRelation r = { .nearer = { .x = 1.5, .y = 0.5 }, .farther = { .x = 3.9, .y = 0 }, .weight = 2, .gap = 3 };

  CHECK (celd_relation_by_colour (&labels, &palette, &r));
  CHECK (r.nearer.by_colour && !memcmp (r.nearer.colour, RED.colour, 3));
  CHECK (r.farther.by_colour && !memcmp (r.farther.colour, BLUE.colour, 3));
  CHECK (r.weight == 2 && r.gap == 3);
  /* A colour stays, also one that this key does not have. */
  r = (CeldRelation) { .nearer = { .by_colour = true, .colour = { 1, 2, 3 } }, .farther = { .x = 0, .y = 0 } };
  CHECK (celd_relation_by_colour (&labels, &palette, &r) && r.nearer.colour[1] == 2 && r.farther.colour[0] == 255);
}

static void
what_has_no_colour_stays_as_it_was (void)
{
  static const double places[][4] = {
    { 0, 0, 1, 0 },    /* both red */
    { 0, 0, 2, 1.5 },  /* the transparent background */
    { 0, 0, 4, 0 },    { 0, 0, 0, 2 }, { -0.5, 0, 2, 0 }, { 0, NAN, 2, 0 }, /* outside */
    { 3, 1, 2, 0 },    /* no label */
  };
  uint32_t    label[W * H];
  CeldRegion  region[] = { RED, BLUE, NO_PAGE };
  CeldPalette palette = { region, 3 };
  CeldLabels  labels = labels_of ("11223330", label);

  for (size_t i = 0; i < sizeof places / sizeof *places; i++)
    {
      CeldRelation r = { .nearer = { .x = places[i][0], .y = places[i][1] },
                         .farther = { .x = places[i][2], .y = places[i][3] } };

      CHECK (!celd_relation_by_colour (&labels, &palette, &r));
      CHECK (!r.nearer.by_colour && !r.farther.by_colour);
    }
}

int
main (void)
{
  RUN (regions_of_one_colour_are_one);
  RUN (all_backgrounds_are_one);
  RUN (bad_labels_are_refused);
  RUN (relations_get_colours);
  RUN (what_has_no_colour_stays_as_it_was);
  return DONE;
}
