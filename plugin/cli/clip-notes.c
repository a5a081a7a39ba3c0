/* What a person should know of the regions of a frame: which are unsure, vanish or appear.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "propagate.h"

#include <math.h>

#define NOTED      0.75 /* a region below this certainty is named; chosen */
#define PAPER      0.5f /* ink above this is paper; chosen */
#define NOTED_AREA 5e-4 /* of the page: smaller regions are not named; chosen */

GArray *
cli_notes_new (void)
{
  return g_array_new (FALSE, FALSE, sizeof (CliRegionNote));
}

/* Sums over the pixels of a label, which are certain on paper alone. */
typedef struct { size_t n, paper, unsure; double certainty, x, y; } LabelSums;

static LabelSums *
sum_labels (const CliMotion *motion, const CeldPlane *ink, const CeldLabels *labels, const CeldPlane *certainty)
{
  LabelSums *sums = g_new0 (LabelSums, motion->palette.n + 1);

  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      {
        size_t     at = (size_t) y * labels->stride + (size_t) x;
        LabelSums *s = &sums[labels->data[at]];
        double     sure = certainty ? (double) certainty->data[at] : 1;
        bool       paper = !ink || ink->data[(size_t) y * ink->stride + (size_t) x] > PAPER;

        s->n++;
        s->paper     += paper;
        s->certainty += sure;
        if (certainty && (!paper || sure >= NOTED))
          continue;
        s->unsure++;
        s->x += x;
        s->y += y;
      }
  return sums;
}

/* The pixel of a label nearest to a place. */
static void
nearest_of (const CeldLabels *labels, uint32_t label, double to_x, double to_y, CliRegionNote *note)
{
  double nearest = INFINITY;

  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      {
        double distance;

        if (labels->data[(size_t) y * labels->stride + (size_t) x] != label ||
            (distance = hypot (x - to_x, y - to_y)) >= nearest)
          continue;
        nearest = distance;
        note->x = x;
        note->y = y;
      }
}

void
cli_frame_take_notes (const CliMotion *motion, const CeldLabels *before, const CeldLabels *labels,
                      const CeldPlane *certainty, CliFrameState *state)
{
  LabelSums *old = sum_labels (motion, NULL, before, NULL), *new = sum_labels (motion, &state->ink, labels, certainty);
  double     least = NOTED_AREA * motion->width * motion->height, sum = 0, area = 0;

  for (uint32_t l = 1; l <= motion->palette.n; l++)
    {
      CliRegionNote note = { l, CLI_REGION_UNSURE, new[l].paper ? new[l].certainty / (double) new[l].paper : 0, -1,
                             -1 };
      bool          gone = !new[l].n && (double) old[l].n >= least, appears = !old[l].n && (double) new[l].n >= least;
      bool          unsure = (double) new[l].unsure >= least && new[l].unsure > new[l].paper / 4;
      bool          doubtful = state->sure && l != motion->background && state->sure[l] < CLI_REGION_SURE;

      sum  += new[l].certainty;
      area += (double) new[l].n;
      if (!gone && !appears && !unsure && !doubtful &&
          !(l == motion->background && (double) new[l].unsure >= least))
        continue;
      note.change = !new[l].n ? CLI_REGION_GONE : appears ? CLI_REGION_NEW : CLI_REGION_UNSURE;
      note.certainty = MIN (note.certainty, doubtful ? state->sure[l] : 1);
      if (old[l].n && (!new[l].n || !new[l].unsure))
        nearest_of (new[l].n ? labels : before, l, old[l].x / (double) old[l].n, old[l].y / (double) old[l].n, &note);
      else if (new[l].unsure)
        nearest_of (labels, l, new[l].x / (double) new[l].unsure, new[l].y / (double) new[l].unsure, &note);
      g_array_append_val (state->notes, note);
    }
  state->certainty = MIN (state->certainty, area > 0 ? sum / area : 0);
  g_free (old);
  g_free (new);
}
