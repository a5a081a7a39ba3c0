/* Defaults are legal, every range is kept, and every text for artists says what and where.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

static void
defaults_are_legal (void)
{
  CeldSettings s = celd_settings ();

  CHECK (celd_settings_check (&s) == CELD_OK);
}

/* Each number of the settings, with one value inside and two outside its range. */
static void
ranges_are_kept (void)
{
  CeldSettings s = celd_settings ();
  const struct { float *member, inside, below, above; } range[] = {
    { &s.ink_threshold, 0, -0.01f, 1 },
    { &s.hardness, 1, 0, 1.01f },
    { &s.tolerance, 0.1f, 0, 0.2f },
    { &s.bulge, 4, -0.1f, 5 },
    { &s.bevel, 0.5f, -0.1f, 0.6f },
    { &s.quilt, 1, -0.1f, 1.1f },
    { &s.light_x, -10, -11, 11 },
    { &s.light_y, 10, -11, 11 },
    { &s.light_height, 10, 0, 11 },
    { &s.specular, 1, -0.1f, 1.1f },
    { &s.shininess, 1000, 0, 1001 },
    { &s.rim_light, 1, -0.1f, 1.1f },
    { &s.rim_power, 20, 0, 21 },
    { &s.light_azimuth, -360, -361, 361 },
    { &s.light_elevation, 90, -91, 91 },
    { &s.ambient, 1, -0.1f, 1.1f },
    { &s.shadow_size, 0.2f, 0, 0.3f },
    { &s.shadow_strength, 1, -0.1f, 1.1f },
    { &s.shadow_offset, 0.2f, -0.1f, 0.3f },
    { &s.shadow_range, 1, -0.1f, 1.1f },
    { &s.disparity, 0.2f, -0.1f, 0.3f },
    { &s.convergence, 1, -0.1f, 1.1f },
  };

  for (size_t i = 0; i < sizeof range / sizeof *range; i++)
    {
      float usual = *range[i].member;

      *range[i].member = range[i].inside;
      CHECK (celd_settings_check (&s) == CELD_OK);
      *range[i].member = range[i].below;
      CHECK (celd_settings_check (&s) == CELD_BAD_VALUE);
      *range[i].member = range[i].above;
      CHECK (celd_settings_check (&s) == CELD_BAD_VALUE);
      *range[i].member = NAN;
      CHECK (celd_settings_check (&s) == CELD_BAD_VALUE);
      *range[i].member = usual;
    }
}

static void
toon_has_two_to_five_steps (void)
{
  CeldSettings s = celd_settings ();

  for (s.toon_steps = 0; s.toon_steps < 8; s.toon_steps++)
    CHECK ((celd_settings_check (&s) == CELD_OK) == (s.toon_steps >= 2 && s.toon_steps <= 5));
}

static void
fixed_levels_need_a_span (void)
{
  CeldSettings s = celd_settings ();

  s.near_level = s.far_level = 3;
  CHECK (celd_settings_check (&s) == CELD_OK); /* not used */
  s.encoding = CELD_ENCODING_FIXED;
  CHECK (celd_settings_check (&s) == CELD_BAD_VALUE);
  s.near_level = 4;
  CHECK (celd_settings_check (&s) == CELD_OK);
}

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
  CeldProblem   overruled = { CELD_PROBLEM_STROKE_OVERRULED, 12, 34, 1, 2, CELD_NO_INDEX };
  CeldProblem   outside = { CELD_PROBLEM_OUTSIDE, -1, -1, 0, 0, 0 };
  char          text[400], small[8] = "xxxxxxx";

  celd_problem_text (&overruled, &palette, &relations, text, sizeof text);
  CHECK (strstr (text, "#ff0010") && strstr (text, "(12, 34)") && strstr (text, "the background"));
  celd_problem_text (&overruled, NULL, NULL, text, sizeof text); /* without names it still says where */
  CHECK (!strchr (text, '#') && strstr (text, "(12, 34)"));
  celd_problem_text (&outside, &palette, &relations, text, sizeof text);
  CHECK (strstr (text, "line 3, column 9"));
  celd_problem_text (&outside, &palette, &relations, small, sizeof small);
  CHECK (strlen (small) == sizeof small - 1); /* cut, and ended */
  relation.source = CELD_SOURCE_ARROW;
  relation.nearer.x = 5;
  celd_problem_text (&outside, &palette, &relations, text, sizeof text);
  CHECK (strstr (text, "The arrow from (5, 0)"));
}

static void
partners_of_a_contradiction (void)
{
  CeldRelation  relation[3] = {
    { .line = 1, .column = 1 }, { .id = 8 }, { .source = CELD_SOURCE_ARROW, .farther = { .y = 7 } }
  };
  CeldRelations relations = { relation, 3 };
  size_t        item[] = { 1, 0, 2 };
  CeldCycle     cycle = { .item = item, .n = 3 };
  char          text[300], small[40];

  celd_cycle_text (&cycle, &relations, text, sizeof text);
  CHECK (strstr (text, "line 1, column 1, the arrow from (0, 0) to (0, 7)."));
  CHECK (!strstr (text, "relation 8")); /* it is the one that the sentence before is about */
  celd_cycle_text (&cycle, &relations, small, sizeof small);
  CHECK (strlen (small) == sizeof small - 1);
  cycle.label = 2;
  cycle.x[0]  = 17;
  celd_cycle_text (&cycle, &relations, text, sizeof text);
  CHECK (strstr (text, "#000000") && strstr (text, "(17, 0)") && strstr (text, "same-colour=separate"));
}

int
main (void)
{
  RUN (defaults_are_legal);
  RUN (ranges_are_kept);
  RUN (toon_has_two_to_five_steps);
  RUN (fixed_levels_need_a_span);
  RUN (every_status_has_a_text);
  RUN (problems_say_what_and_where);
  RUN (partners_of_a_contradiction);
  return DONE;
}
