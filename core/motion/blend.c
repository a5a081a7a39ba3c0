/* A frame between two keys: labels that were propagated to it from both sides become one picture.
 *
 * Where both say the same it is right.  Each connected area where they say different things takes the label with the
 * higher confidence: certainty of celd_propagate, summed over the area, times how near the key is.  So the nearer key
 * decides, unless what it says there is unexplained: it does not know a part that appears later, or lost one on the
 * way, and the other key has it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"

#define SAME UINT32_MAX /* not an area where labels differ */

/* Confidence of both sides in each area, from 1 on. */
typedef struct { double side[2]; } Confidence;

static uint32_t
most_of (const CeldLabels *labels)
{
  uint32_t most = 0;

  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      most = CELD_AT (labels, x, y) > most ? CELD_AT (labels, x, y) : most;
  return most;
}

/* Numbers the pairs of labels where they differ. */
static CeldStatus
pair_labels (const CeldPropagated side[2], CeldLabels *pair)
{
  uint32_t one = most_of (side[0].labels), other = most_of (side[1].labels);

  if (((uint64_t) one + 1) * ((uint64_t) other + 1) >= SAME)
    return CELD_BAD_VALUE;
  for (int y = 0; y < pair->height; y++)
    for (int x = 0; x < pair->width; x++)
      {
        uint32_t a = CELD_AT (side[0].labels, x, y), b = CELD_AT (side[1].labels, x, y);

        CELD_AT (pair, x, y) = a == b ? SAME : a * (other + 1) + b;
      }
  return CELD_OK;
}

/* Ink has no certainty and does not count. */
static void
sum_confidence (const CeldPropagated side[2], const CeldLabels *area, Confidence *confidence)
{
  for (int y = 0; y < area->height; y++)
    for (int x = 0; x < area->width; x++)
      for (int k = 0; k < 2; k++)
        confidence[CELD_AT (area, x, y)].side[k] += side[k].nearness * (double) CELD_AT (side[k].certainty, x, y);
}

/* The side with the higher confidence; the nearer one, or the first, if both have the same. */
static int
better_side (const CeldPropagated side[2], const Confidence *confidence)
{
  if (confidence->side[0] != confidence->side[1])
    return confidence->side[1] > confidence->side[0];
  return side[1].nearness > side[0].nearness;
}

static void
take_better (const CeldPropagated side[2], const CeldLabels *area, const Confidence *confidence, CeldLabels *labels,
             CeldPlane *certainty)
{
  for (int y = 0; y < area->height; y++)
    for (int x = 0; x < area->width; x++)
      {
        const Confidence *here = &confidence[CELD_AT (area, x, y)];
        float             sure[2] = { CELD_AT (side[0].certainty, x, y), CELD_AT (side[1].certainty, x, y) };
        double            sum = here->side[0] + here->side[1];
        int               k = better_side (side, here);

        if (!CELD_AT (area, x, y))
          k = sure[1] > sure[0];
        else
          sure[k] *= sum > 0 ? (float) (here->side[k] / sum) : 0;
        CELD_AT (labels, x, y)    = CELD_AT (side[k].labels, x, y);
        CELD_AT (certainty, x, y) = sure[k];
      }
}

CeldStatus
celd_blend_propagated (const CeldPropagated side[2], const CeldHost *host, CeldLabels *labels, CeldPlane *certainty)
{
  const CeldLabels *one = side[0].labels;
  CeldLabels        area = { one->width, one->height, (size_t) one->width, NULL };
  CeldComponent    *list = NULL;
  Confidence       *confidence = NULL;
  size_t            n = 0;
  CeldStatus        status;

  for (int k = 0; k < 2; k++)
    if (!CELD_SAME_SIZE (side[k].labels, labels) || !CELD_SAME_SIZE (side[k].certainty, labels))
      return CELD_BAD_SIZE;
  if (!CELD_SAME_SIZE (labels, certainty))
    return CELD_BAD_SIZE;
  area.data = celd_alloc ((size_t) area.width * (size_t) area.height, sizeof *area.data);
  status = area.data ? pair_labels (side, &area) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_components (&area, SAME, false, host, &area, &list, &n);
  if (status == CELD_OK && !(confidence = celd_alloc0 (n + 1, sizeof *confidence)))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      sum_confidence (side, &area, confidence);
      take_better (side, &area, confidence, labels, certainty);
    }
  celd_free (area.data);
  celd_free (list);
  celd_free (confidence);
  return status;
}
