/* Writes docs/settings.md, the reference of all settings, from their table.
 *
 *   write-settings FILE           writes it
 *   write-settings --check FILE   fails if it is out of date
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "celdepth.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST 65536 /* bytes of the file */

static const char introduction[] =
  "# Settings\n\n"
  "<!-- Made from core/base/settings-table.c by `ninja -C build settings-reference`. -->\n\n"
  "Settings are properties of the GEGL operations (`hardness=0.5`) and options of the command (`--hardness 0.5`).\n"
  "`gegl --info celdepth:popup` and `celdepth popup --help` list those of one operation or command. Each has the same\n"
  "name and meaning everywhere. In the command the values of switches are `yes` (or `true`) and `no` (or `false`); a switch\n"
  "without a value is on. The default of `disparity` is 0.05 in `celdepth wiggle`.\n";

typedef struct { char text[MOST]; size_t used; } Page;

static void
add (Page *page, const char *text)
{
  size_t size = strlen (text);

  if (page->used + size >= MOST)
    abort ();
  memcpy (page->text + page->used, text, size + 1);
  page->used += size;
}

/* A number without an exponent, as --help has it. */
static void
write_number (double value, char *text, size_t size)
{
  size_t n = (size_t) snprintf (text, size, "%.7f", value);

  while (text[n - 1] == '0')
    text[--n] = 0;
  if (text[n - 1] == '.')
    text[n - 1] = 0;
}

static void
add_value (Page *page, const CeldSettingInfo *row, double value)
{
  char text[64];

  switch (row->type)
    {
    case CELD_SETTING_CHOICE: snprintf (text, sizeof text, "`%s`", row->choice[(int) value].nick); break;
    case CELD_SETTING_SWITCH: snprintf (text, sizeof text, "%s", value != 0 ? "yes" : "no"); break;
    case CELD_SETTING_COLOUR: snprintf (text, sizeof text, "`#%06x`", (unsigned) value); break;
    default:                  write_number (value, text, sizeof text);
    }
  add (page, text);
}

static void
add_values (Page *page, const CeldSettingInfo *row)
{
  if (row->type == CELD_SETTING_COLOUR)
    add (page, "a colour");
  else if (row->type == CELD_SETTING_NUMBER || row->type == CELD_SETTING_INTEGER)
    {
      add_value (page, row, row->least);
      add (page, " to ");
      add_value (page, row, row->most);
    }
  else
    for (int value = 0; value <= (int) row->most; value++)
      {
        add (page, value ? ", " : "");
        add_value (page, row, value);
      }
}

/* "light {point}" as `light=point`. */
static void
add_condition (Page *page, const char *when)
{
  char name[32], nick[32], text[128];

  if (when && sscanf (when, "%31s {%31[^}]}", name, nick) == 2)
    {
      snprintf (text, sizeof text, " Counts only with `%s=%s`.", name, nick);
      add (page, text);
    }
}

static void
add_row (Page *page, const CeldSettingInfo *row)
{
  if (row->theme)
    {
      add (page, "\n## ");
      add (page, row->theme);
      add (page, "\n\n| setting | values | default | |\n|---|---|---|---|\n");
    }
  add (page, "| `");
  add (page, row->name);
  add (page, "` | ");
  add_values (page, row);
  add (page, " | ");
  add_value (page, row, row->usual);
  add (page, " | ");
  add (page, row->help);
  add (page, ".");
  add_condition (page, row->when);
  add (page, " |\n");
}

static bool
is_in (const char *path, const Page *page)
{
  static char text[MOST];
  FILE       *file = fopen (path, "r");
  size_t      size = file ? fread (text, 1, MOST, file) : 0;

  if (file)
    fclose (file);
  return size == page->used && !memcmp (text, page->text, size);
}

static bool
write_to (const char *path, const Page *page)
{
  FILE *file = fopen (path, "w");
  bool  good = file && fwrite (page->text, 1, page->used, file) == page->used;

  return file && !fclose (file) && good;
}

int
main (int argc, char **argv)
{
  static Page            page;
  size_t                 n;
  const CeldSettingInfo *row = celd_setting_infos (&n);
  bool                   check = argc == 3 && !strcmp (argv[1], "--check");

  if (argc != 2 && !check)
    return EXIT_FAILURE;
  add (&page, introduction);
  for (size_t i = 0; i < n; i++)
    add_row (&page, &row[i]);
  if (!check)
    return write_to (argv[1], &page) ? EXIT_SUCCESS : EXIT_FAILURE;
  if (is_in (argv[2], &page))
    return EXIT_SUCCESS;
  fprintf (stderr, "%s is not what the table of settings says: run `ninja settings-reference`.\n", argv[2]);
  return EXIT_FAILURE;
}
