/* Statuses, problems and contradictions as sentences.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

static void
every_status_has_a_text (void)
{
  for (int status = CELD_OK; status <= CELD_NOTHING_TO_GO_BY; status++)
    for (int other = CELD_OK; other < status; other++)
      CHECK (strcmp (celd_status_text ((CeldStatus) status), celd_status_text ((CeldStatus) other)));
}

static void
problems_say_what_and_where (void)
{
  CeldRegion    region[2] = { { .colour = { 255, 0, 16, 255 } }, { .colour = { 0 } } };
  CeldPalette   palette = { region, 2 };
  CeldRelation  relation = { .source = CELD_SOURCE_TEXT, .line = 3, .column = 9 };
  CeldRelations relations = { &relation, 1 };
  CeldProblem   overruled = { .kind = CELD_PROBLEM_STROKE_OVERRULED, .x = 12, .y = 34, .label = 1, .other = 2,
                              .relation = CELD_NO_INDEX };
  CeldProblem   outside = { .kind = CELD_PROBLEM_OUTSIDE, .x = -1, .y = -1 };
  CeldProblem   unsure = { .kind = CELD_PROBLEM_HIDDEN_UNSURE, .x = 56, .y = 78, .label = 1,
                              .relation = CELD_NO_INDEX };
  char          text[400], small[8] = "xxxxxxx";

  celd_problem_text (&overruled, &palette, &relations, NULL, text, sizeof text);
  CHECK (strstr (text, "#ff0010") && strstr (text, "(12, 34)") && strstr (text, "the background"));
  celd_problem_text (&overruled, NULL, NULL, NULL, text, sizeof text); /* without names it still says where */
  CHECK (!strchr (text, '#') && strstr (text, "(12, 34)"));
  celd_problem_text (&outside, &palette, &relations, NULL, text, sizeof text);
  CHECK (strstr (text, "line 3, column 9"));
  celd_problem_text (&unsure, &palette, &relations, NULL, text, sizeof text);
  CHECK (strstr (text, "the region #ff0010 goes on") && strstr (text, "(56, 78)") &&
         strstr (text, "on a layer named Hidden"));
  CHECK (!strstr (text, "--") && !strstr (text, "aux")); /* hosts have no options, and artists see no names of pads */
  celd_problem_text (&outside, &palette, &relations, NULL, small, sizeof small);
  CHECK (strlen (small) == sizeof small - 1); /* cut, and ended */
  relation.source = CELD_SOURCE_ARROW;
  relation.nearer.x = 5;
  celd_problem_text (&outside, &palette, &relations, NULL, text, sizeof text);
  CHECK (strstr (text, "The arrow from (5, 0)"));
}

/* Each has a sentence of its own, with the place, that says what to do: two sentences. */
static void
unclear_arrows_have_reasons (void)
{
  CeldProblem unclear = { .kind = CELD_PROBLEM_ARROW_UNCLEAR, .x = 12, .y = 34, .relation = CELD_NO_INDEX };
  char        text[CELD_REASON_FRAME + 1][400];

  for (int k = CELD_REASON_SHORT; k <= CELD_REASON_FRAME; k++)
    {
      unclear.reason = (CeldArrowReason) k;
      celd_problem_text (&unclear, NULL, NULL, NULL, text[k], sizeof text[k]);
      CHECK (strstr (text[k], "(12, 34)") && strstr (text[k], "left out. ") && text[k][strlen (text[k]) - 1] == '.');
      for (int other = CELD_REASON_SHORT; other < k; other++)
        CHECK (strcmp (text[k], text[other]));
    }
}

/* What a gettext of two texts would give; others stay. */
static const char *
in_german (const char *text)
{
  if (!strcmp (text, "of the background"))
    return "des Hintergrunds";
  return strstr (text, "both ends in the region") ? "In der Fläche%2$s hat beide Enden: %1$s" : text;
}

static void
sentences_are_translated_before_they_are_filled_in (void)
{
  CeldRegion    region[2] = { { .colour = { 255, 0, 16, 255 } }, { .colour = { 0 } } };
  CeldPalette   palette = { region, 2 };
  CeldRelation  relation = { .source = CELD_SOURCE_TEXT, .line = 3, .column = 9 };
  CeldRelations relations = { &relation, 1 };
  CeldProblem   same = { .kind = CELD_PROBLEM_SAME_REGION, .x = -1, .y = -1, .label = 2 };
  char          text[400];

  celd_problem_text (&same, &palette, &relations, NULL, text, sizeof text);
  CHECK (strstr (text, "both ends in the region of the background, so"));
  celd_problem_text (&same, &palette, &relations, in_german, text, sizeof text);
  CHECK (!strcmp (text, "In der Fläche des Hintergrunds hat beide Enden: The relation in line 3, column 9"));
  same.label = 1;
  celd_problem_text (&same, &palette, &relations, in_german, text, sizeof text);
  CHECK (strstr (text, "Fläche #ff0010 hat"));
}

static void
cycles_name_the_other_relations (void)
{
  CeldRelation  relation[3] = {
    { .line = 1, .column = 1 }, { .id = 8 }, { .source = CELD_SOURCE_ARROW, .farther = { .y = 7 } }
  };
  CeldRelations relations = { relation, 3 };
  size_t        item[] = { 1, 0, 2 };
  CeldCycle     cycle = { .item = item, .n = 3 };
  char          text[300], small[40];

  celd_cycle_text (&cycle, &relations, NULL, text, sizeof text);
  CHECK (strstr (text, "line 1, column 1, the arrow from (0, 0) to (0, 7)."));
  CHECK (!strstr (text, "relation 8")); /* it is the one that the sentence before is about */
  celd_cycle_text (&cycle, &relations, NULL, small, sizeof small);
  CHECK (strlen (small) == sizeof small - 1);
  cycle.label = 2;
  cycle.x[0]  = 17;
  celd_cycle_text (&cycle, &relations, NULL, text, sizeof text);
  CHECK (strstr (text, "#000000") && strstr (text, "(17, 0)") && strstr (text, "Same colour: Separate depths"));
}

static void
labels_are_named_by_colours (void)
{
  CeldRegion  region[4] = { { .colour = { 255, 0, 16, 255 } }, { .colour = { 0 } }, { .colour = { 1, 2, 3, 255 } },
                            { .colour = { 1, 2, 3, 255 } } };
  CeldPalette palette = { region, 4 };
  char        name[40], small[4];

  celd_label_name (&palette, 1, name, sizeof name);
  CHECK (!strcmp (name, "#ff0010"));
  celd_label_name (&palette, 2, name, sizeof name);
  CHECK (!strcmp (name, "background"));
  celd_label_name (&palette, 4, name, sizeof name);
  CHECK (!strcmp (name, "#010203 label 4"));
  celd_label_name (&palette, 1, small, sizeof small);
  CHECK (!strcmp (small, "#ff"));
}

int
main (void)
{
  RUN (every_status_has_a_text);
  RUN (problems_say_what_and_where);
  RUN (unclear_arrows_have_reasons);
  RUN (sentences_are_translated_before_they_are_filled_in);
  RUN (cycles_name_the_other_relations);
  RUN (labels_are_named_by_colours);
  return DONE;
}
