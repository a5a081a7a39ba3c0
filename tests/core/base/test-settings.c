/* Defaults are legal, every range is kept, and the table of settings is whole.
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
values_outside_their_range_are_refused (void)
{
  CeldSettings s = celd_settings ();
  const struct { float *member, inside, below, above; } range[] = {
    { &s.ink_threshold, 0, -0.01f, 1 },
    { &s.hardness, 1, 0, 1.01f },
    { &s.tolerance, 0.1f, 0, 0.2f },
    { &s.bulge, 4, -0.1f, 5 },
    { &s.bevel, 0.5f, -0.1f, 0.6f },
    { &s.creases, 1, -0.1f, 1.1f },
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

/* ------------------------------------------------------------------ the table */

static void
rows_are_complete (void)
{
  size_t                 n;
  const CeldSettingInfo *info = celd_setting_infos (&n);

  CHECK (n > 0 && info[0].theme);
  for (size_t i = 0; i < n; i++)
    {
      const CeldSettingInfo *row = &info[i];

      CHECK (celd_setting_find (row->name) == row); /* so no name is there twice */
      CHECK (row->label && *row->label && row->help && *row->help);
      CHECK (row->help[strlen (row->help) - 1] != '.');
      CHECK (celd_setting_allows (row, row->usual));
      CHECK (row->least < row->most && !celd_setting_allows (row, NAN));
      if (row->type == CELD_SETTING_NUMBER || row->type == CELD_SETTING_INTEGER)
        {
          CHECK (row->least <= row->shown.least && row->shown.most <= row->most);
          CHECK (row->shown.least < row->shown.most && row->shown.step > 0 && row->shown.page >= row->shown.step);
        }
      if (row->type == CELD_SETTING_CHOICE)
        for (size_t k = 0; k < row->choices; k++)
          CHECK (row->choice[k].nick && *row->choice[k].nick && row->choice[k].label && *row->choice[k].label);
    }
  CHECK (!celd_setting_find ("no-such-setting"));
}

/* "light {point}" names a setting and one of its choices. */
static void
conditions_name_choices (void)
{
  size_t                 n;
  const CeldSettingInfo *info = celd_setting_infos (&n);

  for (size_t i = 0; i < n; i++)
    {
      char                   name[32], nick[32];
      const CeldSettingInfo *other;
      bool                   found = false;

      if (!info[i].when)
        continue;
      CHECK (sscanf (info[i].when, "%31s {%31[^}]}", name, nick) == 2);
      other = celd_setting_find (name);
      CHECK (other && other->type == CELD_SETTING_CHOICE);
      for (size_t k = 0; other && k < other->choices; k++)
        found = found || !strcmp (other->choice[k].nick, nick);
      CHECK (found);
    }
}

static size_t
size_of (const CeldSettingInfo *row)
{
  return row->type == CELD_SETTING_SWITCH ? sizeof (bool) : row->type == CELD_SETTING_COLOUR ? 3 : sizeof (int);
}

/* Whatever a row does not cover is less than a number: padding. */
static void
every_member_has_a_row (void)
{
  uint8_t                covered[sizeof (CeldSettings)] = { 0 };
  size_t                 n, gap = 0;
  const CeldSettingInfo *info = celd_setting_infos (&n);

  for (size_t i = 0; i < n; i++)
    for (size_t byte = 0; byte < size_of (&info[i]); byte++)
      CHECK (!covered[info[i].offset + byte]++);
  for (size_t byte = 0; byte < sizeof covered; byte++)
    {
      gap = covered[byte] ? 0 : gap + 1;
      CHECK (gap < sizeof (int));
    }
}

static void
values_come_back_as_they_were_set (void)
{
  size_t                 n;
  const CeldSettingInfo *info = celd_setting_infos (&n);

  for (size_t i = 0; i < n; i++)
    {
      CeldSettings s = celd_settings (), usual = s;

      for (int end = 0; end < 2; end++)
        {
          double value = end ? info[i].most : info[i].least;

          celd_setting_set (&info[i], value, &s);
          NEAR (celd_setting_get (&info[i], &s), value, 1e-6 * fabs (value));
        }
      for (size_t k = 0; k < n; k++)
        CHECK (k == i || celd_setting_get (&info[k], &s) == celd_setting_get (&info[k], &usual));
    }
}

/* What artists are told in README.md and the manual. */
static void
known_defaults (void)
{
  CeldSettings s = celd_settings ();

  CHECK (s.stereo == CELD_STEREO_DUBOIS && s.close_gaps && s.keep_necks && s.hold_rest && s.hold_gaps && !s.flats && !s.complete);
  CHECK (s.background_colour[0] == 255 && s.background_colour[1] == 255 && s.background_colour[2] == 255);
  CHECK (s.toon_steps == 3 && s.near_level == 1 && s.far_level == 0);
}

int
main (void)
{
  RUN (defaults_are_legal);
  RUN (values_outside_their_range_are_refused);
  RUN (toon_has_two_to_five_steps);
  RUN (fixed_levels_need_a_span);
  RUN (rows_are_complete);
  RUN (conditions_name_choices);
  RUN (every_member_has_a_row);
  RUN (values_come_back_as_they_were_set);
  RUN (known_defaults);
  return DONE;
}
