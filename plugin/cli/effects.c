/* Options that would have no effect, since the result or the choice that they are about is missing: wrong usage.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <string.h>

bool
cli_effects_check (const CliOptions *o)
{
  bool popup = o->step == CLI_POPUP;

  const struct { bool given; const char *option; bool effect; const char *needed; } rows[] = {
    { o->directx, "directx", o->maps || o->normals, "--maps or --normals" },
    { o->padding_text, "padding", o->maps, "--maps" },
    { popup && o->compositing, "compositing", o->layers, "--layers" },
    { o->views, "views", o->quilt || o->sequence, "--quilt or --sequence" },
    { o->columns, "columns", o->quilt, "--quilt" },
    { popup && o->frames, "frames", o->wiggle, "--wiggle" },
    { popup && o->fps, "fps", o->wiggle || o->sequence, "--wiggle or --sequence" },
    { popup && o->size, "size", o->wiggle || o->sequence, "--wiggle or --sequence" },
    { o->step == CLI_STEREO && o->fps, "fps", o->sequence, "--sequence" },
    { o->step == CLI_STEREO && o->size, "size", o->sequence, "--sequence" },
    { popup && o->jobs, "jobs", o->output_dir, "--output-dir" },
  };

  for (size_t i = 0; i < G_N_ELEMENTS (rows); i++)
    if (rows[i].given && !rows[i].effect)
      return cli_error ("--%s has no effect without %s.", rows[i].option, rows[i].needed);
  return true;
}

/* Other settings may be given in vain: front ends keep theirs while the artist tries one model of light after
 * another. */
bool
cli_setting_effects_check (const CliOptions *o)
{
  bool fixed = o->settings.encoding == CELD_ENCODING_FIXED, point = o->settings.light == CELD_LIGHT_POINT;

  const struct { const char *option; bool effect; const char *needed; } rows[] = {
    { "near-level", fixed, "--encoding fixed" }, { "far-level", fixed, "--encoding fixed" },
    { "light-x", point, "--light point" }, { "light-y", point, "--light point" },
    { "light-height", point, "--light point" },
  };

  for (size_t i = 0; i < G_N_ELEMENTS (rows); i++)
    if (!rows[i].effect && cli_setting_given (o, rows[i].option))
      return cli_error ("--%s has no effect without %s.", rows[i].option, rows[i].needed);
  return true;
}
