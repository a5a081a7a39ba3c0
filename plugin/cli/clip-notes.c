/* What a person should know of the regions of a frame, kept with its state.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "propagate.h"

GArray *
cli_notes_new (void)
{
  return g_array_new (FALSE, FALSE, sizeof (CeldRegionNote));
}

bool
cli_frame_take_notes (const CliMotion *motion, const CeldLabels *before, const CeldLabels *labels,
                      const CeldPlane *certainty, CliFrameState *state)
{
  CeldRegionNote *note = g_new (CeldRegionNote, motion->palette.n + 1);
  size_t          n;
  double          mean;
  bool            good = cli_check (celd_note_regions (&state->ink, before, labels, certainty, motion->palette.n,
                                                       motion->background, state->sure, note, &n, &mean));

  if (good)
    {
      g_array_append_vals (state->notes, note, (guint) n);
      state->certainty = MIN (state->certainty, mean);
    }
  g_free (note);
  return good;
}

void
cli_say_blank (const CliMotion *motion)
{
  GString *numbers = g_string_new (NULL);
  size_t   n = 0;

  for (size_t i = 0; i < motion->frames.n; i++)
    if (motion->frames.frame[i].blank)
      g_string_append_printf (numbers, "%s%d", n++ ? ", " : "", motion->frames.frame[i].number);
  if (n)
    cli_say ("Frame%s %s: there are no lines, so that all is background, and so is what comes after it from the same "
             "key. Give the next drawing scribbles and a --key of its own.", n > 1 ? "s" : "", numbers->str);
  g_string_free (numbers, TRUE);
}
