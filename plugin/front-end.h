/* What plug-ins offer to artists, whichever editor they are for: layers, pictures, and the settings that matter most.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_FRONT_END_H
#define CELD_FRONT_END_H

#include <glib.h>

#include "pipeline.h"
#include "presets.h"

/* The name of the argument for the layer of a role, "scribbles", and what is on that layer. */
extern const char *const celd_layer_arguments[CELD_N_LAYERS];
extern const char *const celd_layer_help[CELD_N_LAYERS];

/* The pictures before this one can be chosen in Pop-up. */
#define CELD_POPUP_PICTURES CELD_PICTURE_SUGGESTIONS

typedef struct
{
  const char *argument;     /* of a procedure, "lit" */
  const char *option;       /* of `celdepth popup`, "shaded" */
  const char *label, *help; /* in a dialog; _ is before the mnemonic */
  const char *layer;        /* the name of its layer */
  gboolean    alpha;        /* pictures that show numbers or light alone have none */
  gboolean    usual;        /* made by default */
} CeldPictureInfo;

extern const CeldPictureInfo celd_pictures[CELD_POPUP_PICTURES];

/* The pictures as their layers lie in the group of results, from the top to the bottom. */
extern const CeldPicture celd_pictures_stacked[CELD_POPUP_PICTURES];

/* Pictures as the text of a script, "lit,depth", as bits.  An empty text, or NULL, changes nothing.  FALSE and *error
 * if there is no such picture. */
gboolean celd_pictures_read (const char *text, guint *wanted, GError **error);

#define CELD_GROUP_NAME "Cartoon Depth"

/* The settings of core that a short dialog shows, under headings; `choices` is the number of choices, 0: all. */
typedef struct { const char *name, *heading; int choices; } CeldMainSetting;

#define CELD_N_MAIN_SETTINGS 18
extern const CeldMainSetting celd_main_settings[CELD_N_MAIN_SETTINGS];

/* How dialogs show a number: multiplied by this, with so many digits after the point, and this unit; NULL: it has
 * none. */
typedef struct { double factor; int digits; const char *unit; } CeldShownNumber;

/* Fractions are percentages, angles whole degrees. */
CeldShownNumber celd_shown_number (const CeldSettingInfo *row);

/* Sets a setting of any name from a text: a number, a choice, or yes, no, true or false.  FALSE and *error if that
 * makes no sense; then nothing is changed. */
gboolean celd_setting_read (const char *name, const char *value, CeldSettings *settings, GError **error);

/* Sets settings as the text of a script, "light-azimuth=90 bulge=0.5", or "preset=cel".  NULL is an empty text. */
gboolean celd_settings_read (const char *text, CeldSettings *settings, GError **error);

#endif
