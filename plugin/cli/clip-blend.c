/* A frame between two keys: its two sides, what each key says of it, become one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "propagate.h"

#include <string.h>

/* The keys on both sides of a frame, and what they say of it. */
typedef struct { const CliKey *key[2]; CeldLabels labels[2]; CeldPlane certainty[2]; } Sides;

static void
clear (Sides *sides)
{
  for (int k = 0; k < 2; k++)
    {
      g_free (sides->labels[k].data);
      g_free (sides->certainty[k].data);
    }
}

/* Reads both sides of a frame and blends them; labels and certainty are new. */
static bool
blend (const CliMotion *motion, const CeldHost *host, size_t frame, Sides *sides, CeldLabels *labels,
       CeldPlane *certainty)
{
  double         gap = (double) (sides->key[1]->frame - sides->key[0]->frame);
  CeldPropagated side[2];
  bool           good = true;

  for (int k = 0; k < 2 && good; k++)
    {
      good = cli_frame_read_labels (motion, frame, sides->key[k], &sides->labels[k]) &&
             cli_frame_read_certainty (motion, frame, sides->key[k], &sides->certainty[k]);
      side[k] = (CeldPropagated) { &sides->labels[k], &sides->certainty[k],
                                   (double) (k ? frame - sides->key[0]->frame : sides->key[1]->frame - frame) / gap };
    }
  return good && cli_labels_new (motion->width, motion->height, labels) &&
         cli_plane_new (motion->width, motion->height, certainty) &&
         cli_check (celd_blend_propagated (side, host, labels, certainty));
}

/* The labels of the frame before, from which those of this one differ by motion. */
static bool
labels_before (const CliMotion *motion, const CeldHost *host, size_t frame, const CliKey *key, CeldLabels *labels)
{
  Sides     sides = { .key = { key, key + 1 } };
  CeldPlane certainty = { 0 };
  size_t    n = (size_t) motion->width * (size_t) motion->height;
  bool      good;

  if (frame == key->frame)
    {
      good = cli_labels_new (motion->width, motion->height, labels);
      if (good)
        memcpy (labels->data, key->labels.data, n * sizeof *labels->data);
      return good;
    }
  good = blend (motion, host, frame, &sides, labels, &certainty);
  clear (&sides);
  g_free (certainty.data);
  return good;
}

static bool
rate_labels (const CliMotion *motion, const Sides *sides, const CliFrameState kept[2], CliFrameState *state)
{
  const CeldLabels *const labels[2] = { &sides->labels[0], &sides->labels[1] };
  const double *const     sure[2] = { kept[0].sure, kept[1].sure };

  state->sure = g_new0 (double, motion->palette.n + 1);
  return cli_check (celd_rate_blended (labels, sure, &state->labels, motion->palette.n, state->sure));
}

static bool
make (const CliMotion *motion, const CeldHost *host, Sides *sides, const CliFrameState kept[2], CliFrameState *state)
{
  CeldLabels before = { 0 };
  bool       good = cli_frame_ink (motion, host, state->frame, &state->ink) &&
                    blend (motion, host, state->frame, sides, &state->labels, &state->pixel_certainty) &&
                    labels_before (motion, host, state->frame - 1, sides->key[0], &before);

  state->certainty = MAX (kept[0].certainty, kept[1].certainty);
  good = good && (!motion->options->review || rate_labels (motion, sides, kept, state)) &&
         cli_frame_take_notes (motion, &before, &state->labels, &state->pixel_certainty, state);
  g_free (before.data);
  return good && cli_frame_write (motion, host, state);
}

bool
cli_frame_blend (const CliMotion *motion, const CeldHost *host, size_t frame, const CliKey *key)
{
  Sides         sides = { .key = { key, key + 1 } };
  CliFrameState kept[2], state = { .frame = frame, .notes = cli_notes_new () };
  bool          good = true;

  for (int k = 0; k < 2; k++)
    {
      kept[k] = (CliFrameState) { .frame = frame, .side = sides.key[k], .notes = cli_notes_new () };
      good    = good && (cli_frame_read_state (motion, frame, NULL, &kept[k]) ||
                         cli_error ("What was made of frame %d is gone. Run 'celdepth propagate' again.",
                                    motion->frames.frame[frame].number));
    }
  if (good)
    {
      char         *both = g_strconcat (kept[0].fingerprint, kept[1].fingerprint, NULL);
      CliFrameState written = { .frame = frame, .notes = cli_notes_new () };

      state.fingerprint = g_compute_checksum_for_string (G_CHECKSUM_SHA256, both, -1);
      if (!cli_frame_read_state (motion, frame, state.fingerprint, &written) ||
          !cli_frame_is_complete (motion, frame, NULL))
        good = make (motion, host, &sides, kept, &state);
      cli_frame_clear (&written);
      g_free (both);
    }
  clear (&sides);
  cli_frame_clear (&kept[0]);
  cli_frame_clear (&kept[1]);
  cli_frame_clear (&state);
  return good;
}
