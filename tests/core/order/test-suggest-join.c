/* Suggestions beside the artist's relations: those are never left out.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ask-order.h"
#include "order/order.h"

/* Relations between the regions of PARTS, each a letter, a sign and a letter; suggestions with falling weight. */
static CeldRelations
read_pairs (const char *pairs, CeldSource source, double weight)
{
  CeldRelations relations = { 0 };

  for (size_t i = 0; pairs[i]; i += 3 + (pairs[i + 3] == ' '))
    {
      CeldRelation *grown = realloc (relations.item, (relations.n + 1) * sizeof *grown);
      bool          less = pairs[i + 1] == '<';

      relations.item = grown;
      grown[relations.n] = (CeldRelation) {
        .nearer = { .x = 2 * (pairs[less ? i + 2 : i] - 'A') }, .farther = { .x = 2 * (pairs[less ? i : i + 2] - 'A') },
        .equal = pairs[i + 1] == '=', .weight = weight - 0.01 * (double) relations.n, .gap = 1, .source = source,
      };
      relations.n++;
    }
  return relations;
}

/* Which suggestions are left, as text. */
static void
expect (const char *own, double weight, const char *suggested, CeldSuggest suggest, const char *wanted)
{
  CeldRelations relations = read_pairs (own, CELD_SOURCE_TEXT, weight);
  CeldRelations ideas = read_pairs (suggested, CELD_SOURCE_SUGGESTION, 0.9), both = { 0 };
  CeldPalette   palette = palette_of (6, true);
  CeldLabels    labels = art_labels (PARTS);
  CeldSettings  settings = celd_settings ();
  char          text[200], *end = text;

  settings.suggest = suggest;
  CHECK (celd_suggestions_join (&labels, &palette, &relations, &ideas, &settings, NULL, NULL, &both) == CELD_OK);
  CHECK (both.n >= relations.n);
  for (size_t i = 0; i < both.n; i++)
    {
      const CeldRelation *r = &both.item[i];

      if (i < relations.n)
        CHECK (!memcmp (r, &relations.item[i], sizeof *r));
      else
        {
          CHECK (r->source == CELD_SOURCE_SUGGESTION && r->weight > 0);
          for (size_t k = 0; k < relations.n; k++)
            CHECK (r->weight < relations.item[k].weight);
          end += sprintf (end, "%s%c>%c", end > text ? " " : "", 'A' + (int) r->nearer.x / 2,
                          'A' + (int) r->farther.x / 2);
        }
    }
  *end = 0;
  CHECK (!strcmp (text, wanted));
  celd_relations_clear (&both);
  free (relations.item);
  free (ideas.item);
  free (labels.data);
  free (palette.item);
}

static void
nothing_to_join (void)
{
  expect ("", 1, "", CELD_SUGGEST_ALL, "");
  expect ("A>B", 1, "", CELD_SUGGEST_ALL, "");
  expect ("A>B", 1, "B>C", CELD_SUGGEST_OFF, "");
}

static void
artist_wins (void)
{
  expect ("A>B", 1, "B>A", CELD_SUGGEST_ALL, "");
  expect ("A>B B>C", 1, "C>A C>D", CELD_SUGGEST_ALL, "C>D");
  expect ("A=B", 1, "A>B B>C", CELD_SUGGEST_ALL, "B>C");
  expect ("A>B", 0.001, "B>A C>A", CELD_SUGGEST_ALL, "C>A"); /* however light */
  expect ("F>A", 1, "A>F", CELD_SUGGEST_ALL, "");            /* even about the background */
}

static void
gaps_only (void)
{
  expect ("A>B B>C", 1, "A>B A>C C>D B>D", CELD_SUGGEST_ALL, "A>B A>C C>D B>D");
  expect ("A>B B>C", 1, "A>B A>C C>D B>D", CELD_SUGGEST_FILL_GAPS, "C>D B>D");
  expect ("A>B B=C C>D", 1, "A>D C>A D>E", CELD_SUGGEST_FILL_GAPS, "D>E");
}

/* Of suggestions that contradict each other the lightest goes. */
static void
among_themselves (void)
{
  expect ("", 1, "A>B B>C C>A", CELD_SUGGEST_ALL, "A>B B>C");
  expect ("C>A", 1, "A>B B>C", CELD_SUGGEST_ALL, "A>B");
}

/* The artist's own contradictions stay, to be reported; many suggestions do not outweigh one of the artist's arrows. */
static void
own_contradictions (CeldOnCycle on_cycle)
{
  CeldRelations own = read_pairs ("A>B B>C C>A", CELD_SOURCE_TEXT, 1), both = { 0 };
  CeldRelations ideas = read_pairs ("C>B D>A", CELD_SOURCE_SUGGESTION, 0.9);
  CeldPalette   palette = palette_of (6, true);
  CeldLabels    labels = art_labels (PARTS);
  CeldOrder     order = { 0 };
  CeldSettings  settings = celd_settings ();

  settings.suggest  = CELD_SUGGEST_ALL;
  settings.on_cycle = on_cycle;
  CHECK (celd_suggestions_join (&labels, &palette, &own, &ideas, &settings, NULL, NULL, &both) == CELD_OK);
  CHECK (both.n == 4);
  CHECK (celd_order (&labels, &palette, &both, NULL, &settings, NULL, &order, NULL) == CELD_OK && order.n_cycles == 1);
  for (size_t i = 0; order.n_cycles && i < order.cycle[0].n; i++)
    CHECK (order.cycle[0].item[i] < own.n);
  celd_order_clear (&order);
  celd_relations_clear (&both);
  free (own.item);
  free (ideas.item);
  free (labels.data);
  free (palette.item);
}

static void
own_contradictions_reported (void)
{
  own_contradictions (CELD_ON_CYCLE_REPORT);
}

static void
own_contradictions_dropped (void)
{
  own_contradictions (CELD_ON_CYCLE_DROP_WEAKEST);
}

/* The order is made of A > B and, as far as the settings ask for it, of the suggestion B > C. */
static void
order_of_both (void)
{
  static const struct { CeldSuggest suggest; size_t joined; uint32_t levels; } wanted[] = {
    { CELD_SUGGEST_OFF, 1, 3 }, { CELD_SUGGEST_FILL_GAPS, 2, 4 }, { CELD_SUGGEST_ALL, 2, 4 },
  };

  for (int k = 0; k < 3; k++)
    {
      CeldRelations relations = read_pairs ("A>B", CELD_SOURCE_TEXT, 1);
      CeldRelations ideas = read_pairs ("B>C", CELD_SOURCE_SUGGESTION, 0.9);
      CeldPalette   palette = palette_of (6, true); /* F is the background, behind all others */
      CeldLabels    labels = art_labels (PARTS);
      CeldOrder     order = { 0 };
      CeldSettings  settings = celd_settings ();

      settings.suggest = wanted[k].suggest;
      CHECK (celd_order_suggested (&labels, &palette, &relations, &ideas, NULL, &settings, NULL, &relations, &order,
                                   NULL) == CELD_OK);
      CHECK (relations.n == wanted[k].joined && order.levels == wanted[k].levels);
      CHECK (order.level[0] > order.level[1] && (k == 0 || order.level[1] > order.level[2]));
      celd_order_clear (&order);
      celd_relations_clear (&relations);
      free (ideas.item);
      free (labels.data);
      free (palette.item);
    }
}

static void
bad_size (void)
{
  CeldPalette   palette = palette_of (6, true);
  CeldLabels    labels = art_labels (PARTS);
  CeldPlane     ink = { 3, 3, 3, (float[9]) { 0 } };
  CeldRelations none = { 0 }, both = { 0 };
  CeldSettings  settings = celd_settings ();

  CHECK (celd_suggestions_join (&labels, &palette, &none, &none, &settings, &ink, NULL, &both) == CELD_BAD_SIZE);
  free (labels.data);
  free (palette.item);
}

int
main (void)
{
  RUN (nothing_to_join);
  RUN (artist_wins);
  RUN (gaps_only);
  RUN (among_themselves);
  RUN (own_contradictions_reported);
  RUN (own_contradictions_dropped);
  RUN (order_of_both);
  RUN (bad_size);
  return DONE;
}
