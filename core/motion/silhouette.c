/* The silhouette of a drawing: what of it moves.
 *
 * With parts it is all of them but the background.  Otherwise it is what is left when the paper around is flooded from
 * the frame by a disc wider than gaps between lines, so that open outlines keep their inside.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/motion.h"

#define OUTLINE_GAP  1.5 /* strokes: radius of the disc that floods the paper around; chosen */
#define OUTLINE_CELL 0.5 /* cells: its least radius; chosen */

static CeldStatus
copy_parts (const CeldMovingParts *parts, CeldLabels *label)
{
  for (int y = 0; y < label->height; y++)
    for (int x = 0; x < label->width; x++)
      {
        uint32_t k = CELD_AT (parts->labels, x, y);

        if (k > parts->n)
          return CELD_BAD_VALUE;
        CELD_AT (label, x, y) = k == parts->background ? 0 : k;
      }
  return CELD_OK;
}

/* Keeps, of the pixels marked 1, those that are connected with the frame. */
static CeldStatus
keep_from_frame (const CeldHost *host, CeldLabels *open, uint8_t *reached)
{
  int            w = open->width, h = open->height;
  CeldComponent *list = NULL;
  size_t         n = 0;
  CeldStatus     status = celd_components (open, 0, false, host, open, &list, &n);

  for (size_t p = 0; p < (size_t) w * (size_t) h && status == CELD_OK; p++)
    {
      const CeldComponent *c = open->data[p] ? &list[open->data[p] - 1] : NULL;

      reached[p] = c && (!c->left || !c->top || c->right == w - 1 || c->bottom == h - 1);
    }
  celd_free (list);
  return status;
}

static CeldStatus
flood_around (const CeldPlane *ink, int side, const CeldHost *host, CeldLabels *label)
{
  size_t       n = (size_t) ink->width * (size_t) ink->height;
  double       radius = fmax (1 + OUTLINE_GAP * celd_stroke_width (ink), OUTLINE_CELL * side);
  uint8_t     *mark = celd_alloc (n, 1);
  int32_t     *squared = celd_alloc (n, sizeof *squared);
  CeldHostPart part;
  CeldHost     quiet = celd_host_part (&part, host, 0, 0);
  CeldStatus   status = mark && squared ? CELD_OK : CELD_NO_MEMORY;

  for (int y = 0; y < ink->height && status == CELD_OK; y++)
    for (int x = 0; x < ink->width; x++)
      mark[(size_t) y * (size_t) ink->width + (size_t) x] = !celd_is_paper (CELD_AT (ink, x, y));
  if (status == CELD_OK)
    status = celd_distance (ink->width, ink->height, mark, &quiet, squared);
  for (size_t p = 0; p < n && status == CELD_OK; p++)
    label->data[p] = squared[p] > radius * radius;
  if (status == CELD_OK)
    status = keep_from_frame (&quiet, label, mark);
  if (status == CELD_OK)
    status = celd_distance (ink->width, ink->height, mark, &quiet, squared);
  for (size_t p = 0; p < n && status == CELD_OK; p++)
    label->data[p] = squared[p] > radius * radius;
  celd_free (mark);
  celd_free (squared);
  return status;
}

CeldStatus
celd_silhouette (const CeldPlane *ink, const CeldMovingParts *parts, int side, const CeldHost *host, CeldLabels *label)
{
  size_t     n = (size_t) ink->width * (size_t) ink->height, inside = 0;
  CeldStatus status = celd_labels_new (ink->width, ink->height, label);

  if (status == CELD_OK)
    status = parts ? copy_parts (parts, label) : flood_around (ink, side, host, label);
  for (size_t p = 0; p < n && status == CELD_OK; p++)
    inside += label->data[p] != 0;
  if (status == CELD_OK && !inside)
    status = CELD_NOTHING_TO_GO_BY;
  if (status != CELD_OK)
    {
      celd_free (label->data);
      label->data = NULL;
    }
  return status;
}
