/* Presets: settings of light and shadows that go together, the same in all editors and in the command.
 *
 * Presets are about the looks of results alone.  How drawings are read has none: the defaults read pencil, chalk, scans
 * and pixel art as well as any other settings that were tried.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PRESETS_H
#define CELD_PRESETS_H

#include <glib.h>

#include "celdepth.h"

typedef struct { const char *setting; double value; } CeldPresetValue;

typedef struct
{
  const char     *name;        /* for scripts, "cel" */
  const char     *label, *help;
  const char     *picture;     /* the argument of the picture that shows it, "enhanced"; NULL: those made by default do */
  CeldPresetValue value[7];    /* ended by NULL; all other settings of presets have their default */
} CeldPreset;

/* The first one has the defaults. */
#define CELD_N_PRESETS 5
extern const CeldPreset celd_presets[CELD_N_PRESETS];

/* What a dialog shows when the settings are those of no preset. */
#define CELD_OWN_SETTINGS "own"
extern const char *const celd_own_settings_label;

/* NULL: there is no preset of this name. */
const CeldPreset *celd_preset_find (const char *name);

/* Whether a setting is one of some preset. */
gboolean celd_preset_covers (const char *setting);

/* Sets those settings of a preset that have their default: what is set already counts more. */
void celd_preset_fill (const CeldPreset *preset, CeldSettings *settings);

/* Sets all settings of presets as this one has them. */
void celd_preset_choose (const CeldPreset *preset, CeldSettings *settings);

/* The preset that has these settings; NULL: none has. */
const CeldPreset *celd_preset_of (const CeldSettings *settings);

#endif
