/* What a person should know of the regions of a frame: which are unsure, vanish or appear.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <math.h>

#define NOTED      0.75 /* a region below this certainty is noted; chosen */
#define NOTED_AREA 5e-4 /* of the page: smaller regions are not noted; chosen */
#define NOTED_PART 0.25 /* of the paper of a region, at least, that is unsure; chosen */
#define REGION_SURE 0.7 /* a region below this certainty is to be looked at; chosen on clips with ground truth */
#define FRAME_SURE  0.9 /* a frame below this one is, whatever its regions; chosen on them, too */

/* Sums over the pixels of a label; x, y: of those that are unsure, or of all without certainty. */
typedef struct { size_t n, paper, unsure; double certainty, x, y; } LabelSums;

/* Both frames, and the sums over each. */
typedef struct { const CeldLabels *labels[2]; LabelSums *sums[2]; } Frames;

/* Sums over the pixels of all labels.  Certainty counts on paper alone; NULL for a frame that has none. */
static void
sum_labels (const CeldPlane *ink, const CeldLabels *labels, const CeldPlane *certainty, LabelSums *sums)
{
  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      {
        LabelSums *s = &sums[CELD_AT (labels, x, y)];
        double     sure = certainty ? (double) CELD_AT (certainty, x, y) : 1;
        bool       paper = !ink || celd_is_paper (CELD_AT (ink, x, y));

        s->n++;
        s->paper     += paper;
        s->certainty += sure;
        if (certainty && (!paper || sure >= NOTED))
          continue;
        s->unsure++;
        s->x += x;
        s->y += y;
      }
}

/* Sets the place of a note: the pixel of its label nearest to another place. */
static void
place_near (const CeldLabels *labels, double to_x, double to_y, CeldRegionNote *note)
{
  double nearest = INFINITY;

  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      {
        double distance;

        if (CELD_AT (labels, x, y) != note->label || (distance = hypot (x - to_x, y - to_y)) >= nearest)
          continue;
        nearest = distance;
        note->x = x;
        note->y = y;
      }
}

/* Where to look: where the region was, if it is gone or sure as a whole, else where it is unsure. */
static void
place_note (const Frames *f, CeldRegionNote *note)
{
  const LabelSums *old = &f->sums[0][note->label], *new = &f->sums[1][note->label];

  if (old->n && (!new->n || !new->unsure))
    place_near (f->labels[new->n ? 1 : 0], old->x / (double) old->n, old->y / (double) old->n, note);
  else if (new->unsure)
    place_near (f->labels[1], new->x / (double) new->unsure, new->y / (double) new->unsure, note);
}

/* Is a label to be noted?  `least`: pixels of a region that counts. */
static bool
note_label (const Frames *f, double least, bool background, double sure, CeldRegionNote *note)
{
  const LabelSums *old = &f->sums[0][note->label], *new = &f->sums[1][note->label];
  bool             gone = !new->n && (double) old->n >= least, appears = !old->n && (double) new->n >= least;
  bool             many = (double) new->unsure >= least, doubtful = !background && sure < REGION_SURE;

  note->change    = !new->n ? CELD_REGION_GONE : appears ? CELD_REGION_NEW : CELD_REGION_UNSURE;
  note->certainty = fmin (new->paper ? new->certainty / (double) new->paper : 0, doubtful ? sure : 1);
  note->x = note->y = -1;
  return gone || appears || doubtful ||
         (many && (background || (double) new->unsure > NOTED_PART * (double) new->paper));
}

CeldStatus
celd_note_regions (const CeldPlane *ink, const CeldLabels *before, const CeldLabels *after, const CeldPlane *certainty,
                   size_t n, uint32_t background, const double *sure, CeldRegionNote *item, size_t *n_items,
                   double *mean)
{
  Frames f = { .labels = { before, after } };
  double all = 0, area = 0;

  *n_items = 0;
  if (!CELD_SAME_SIZE (before, after) || !CELD_SAME_SIZE (ink, after) ||
      !CELD_SAME_SIZE (certainty, after))
    return CELD_BAD_SIZE;
  if (celd_labels_beyond (before, n) || celd_labels_beyond (after, n))
    return CELD_BAD_VALUE;
  f.sums[0] = celd_alloc0 (2 * (n + 1), sizeof *f.sums[0]);
  if (!f.sums[0])
    return CELD_NO_MEMORY;
  f.sums[1] = f.sums[0] + n + 1;
  sum_labels (NULL, before, NULL, f.sums[0]);
  sum_labels (ink, after, certainty, f.sums[1]);
  for (uint32_t l = 1; l <= n; l++)
    {
      CeldRegionNote one = { .label = l };

      all  += f.sums[1][l].certainty;
      area += (double) f.sums[1][l].n;
      if (!note_label (&f, NOTED_AREA * after->width * after->height, l == background, sure ? sure[l] : 1, &one))
        continue;
      place_note (&f, &one);
      item[(*n_items)++] = one;
    }
  *mean = area > 0 ? all / area : 0;
  celd_free (f.sums[0]);
  return CELD_OK;
}

bool
celd_wants_review (const CeldRegionNote *note, size_t n, double certainty)
{
  for (size_t i = 0; i < n; i++)
    if (note[i].certainty < REGION_SURE)
      return true;
  return certainty < FRAME_SURE;
}
