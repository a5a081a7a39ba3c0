/* One frame of a clip: labels carried from the frame before, levels and depth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "fingerprint.h"
#include "propagate.h"

#include <string.h>

void
cli_frame_clear (CliFrameState *state)
{
  g_free (state->ink.data);
  g_free (state->labels.data);
  g_free (state->pixel_certainty.data);
  g_free (state->fingerprint);
  g_free (state->sure);
  if (state->notes)
    g_array_free (state->notes, TRUE);
  *state = (CliFrameState) { 0 };
}

/* ------------------------------------------------------------------ ink */

bool
cli_frame_ink (const CliMotion *motion, const CeldHost *host, size_t frame, CeldPlane *ink)
{
  CliOptions none = { .settings.ink = motion->options->settings.ink };
  CliLayers  layers = { .width = motion->width, .height = motion->height };
  bool       good = cli_layers_read (motion->frames.frame[frame].path, &none, 0, &layers) &&
                    cli_plane_new (motion->width, motion->height, ink) &&
                    cli_check (celd_ink (&layers.drawing, motion->options->settings.ink, host, ink));

  if (good && !celd_ink_has_lines (ink))
    g_atomic_int_set (&motion->frames.frame[frame].blank, 1); /* other chains may read it, too */
  cli_layers_clear (&layers);
  return good;
}

/* ------------------------------------------------------------------ propagation */

CeldStatus
cli_frame_carry (const CliMotion *motion, const CeldHost *host, const CeldPlane *ink, const CeldLabels *from,
                 const CeldPlane *next, CeldLabels *labels, CeldPlane *certainty)
{
  CeldSettings settings = motion->options->settings;
  CeldPalette  palette = { g_memdup2 (motion->palette.item, motion->palette.n * sizeof (CeldRegion)),
                           motion->palette.n };
  CeldStatus   status = celd_propagate (ink, from, motion->order.level, motion->background, next, host, labels,
                                        certainty);

  settings.background = CELD_BACKGROUND_NONE; /* it has a label already */
  settings.same_colour = CELD_SAME_COLOUR_ONE;
  if (status == CELD_OK)
    status = celd_segment (next, labels, NULL, &settings, host, labels, &palette, NULL);
  celd_palette_clear (&palette);
  return status;
}

static bool
propagate (const CliMotion *motion, const CeldHost *host, size_t frame, char *fingerprint, CliFrameState *state)
{
  CliFrameState next = { .frame = frame, .side = state->side, .certainty = state->certainty,
                         .fingerprint = fingerprint, .notes = cli_notes_new () };
  bool          good = cli_frame_ink (motion, host, frame, &next.ink) &&
                       cli_labels_new (motion->width, motion->height, &next.labels) &&
                       cli_plane_new (motion->width, motion->height, &next.pixel_certainty) &&
                       cli_check (cli_frame_carry (motion, host, &state->ink, &state->labels, &next.ink, &next.labels,
                                                  &next.pixel_certainty)) &&
                       (!motion->options->review || cli_frame_doubt (motion, host, state, &next));

  good = good && cli_frame_take_notes (motion, &state->labels, &next.labels, &next.pixel_certainty, &next);
  cli_frame_clear (state);
  *state = next;
  return good;
}

/* The fingerprint of a frame that is made from one with another fingerprint; NULL with a message. */
static char *
fingerprint_of (const CliMotion *motion, const char *before, size_t frame)
{
  GChecksum *sum = g_checksum_new (G_CHECKSUM_SHA256);

  g_checksum_update (sum, (const guchar *) before, -1);
  return cli_fingerprint_end (sum, cli_fingerprint_add_file (sum, motion->frames.frame[frame].path));
}

bool
cli_frame_next (const CliMotion *motion, const CeldHost *host, size_t frame, CliFrameState *state, bool *made)
{
  char         *fingerprint = fingerprint_of (motion, state->fingerprint, frame);
  CliFrameState kept = { .frame = frame, .side = state->side, .certainty = 1, .fingerprint = fingerprint,
                         .notes = cli_notes_new () };

  *made = true;
  if (!fingerprint)
    {
      cli_frame_clear (&kept);
      return false;
    }
  if (!cli_frame_read_state (motion, frame, fingerprint, &kept) ||
      !cli_frame_is_complete (motion, frame, state->side) ||
      !cli_frame_read_labels (motion, frame, state->side, &kept.labels))
    {
      kept.fingerprint = NULL;
      cli_frame_clear (&kept);
      return propagate (motion, host, frame, fingerprint, state);
    }
  *made = false;
  cli_frame_clear (state);
  *state = kept;
  return cli_frame_ink (motion, host, frame, &state->ink);
}

bool
cli_frame_of_key (const CliMotion *motion, const CliKey *key, const CliKey *side, CliFrameState *state)
{
  size_t n = (size_t) motion->width * (size_t) motion->height;

  *state = (CliFrameState) { .frame = key->frame, .side = side, .certainty = 1,
                             .fingerprint = g_strdup (key->fingerprint), .notes = cli_notes_new () };
  if (!cli_plane_new (motion->width, motion->height, &state->ink) ||
      !cli_labels_new (motion->width, motion->height, &state->labels))
    return false;
  memcpy (state->ink.data, key->ink.data, n * sizeof *key->ink.data);
  memcpy (state->labels.data, key->labels.data, n * sizeof *key->labels.data);
  state->sure = motion->options->review ? g_new0 (double, motion->palette.n + 1) : NULL;
  for (size_t l = 1; l <= motion->palette.n && state->sure; l++)
    state->sure[l] = 1;
  return true;
}

/* ------------------------------------------------------------------ results */

static bool
write_levels_and_depth (const CliMotion *motion, const CeldHost *host, const CliFrameState *state)
{
  const CeldSettings *settings = &motion->options->settings;
  const CeldOrder    *order = &motion->order;
  CeldPlane           levels = { 0 };
  char               *path = cli_frame_path (motion, "levels", state->frame, NULL), *depth;
  float               nearest = celd_order_value (order, order->levels - 1, settings);
  bool                good = cli_plane_new (motion->width, motion->height, &levels);

  for (size_t i = 0; good && i < (size_t) motion->width * (size_t) motion->height; i++)
    levels.data[i] = celd_order_value (order, order->level[state->labels.data[i] - 1], settings);
  good = good && cli_check (celd_expand_levels (&state->ink, NULL, &levels, &state->labels, NULL, settings->expansion, host,
                                                &levels)) &&
         cli_write_depth (path, &levels, nearest);
  g_free (path);
  if (good && motion->options->depth_dir)
    {
      depth = cli_frame_path (motion, "depth", state->frame, NULL);
      good  = cli_check (celd_smooth (&state->ink, NULL, &levels, NULL, settings, host, &levels, NULL)) &&
              cli_write_depth (depth, &levels, nearest);
      g_free (depth);
    }
  g_free (levels.data);
  return good;
}

bool
cli_frame_write (const CliMotion *motion, const CeldHost *host, const CliFrameState *state)
{
  char *path = cli_frame_path (motion, "labels", state->frame, state->side);
  bool  good = cli_write_labels (path, &state->labels, &motion->palette) &&
               (state->side ? cli_frame_write_certainty (motion, state)
                            : write_levels_and_depth (motion, host, state)) &&
               cli_frame_write_state (motion, state);

  g_free (path);
  return good;
}
