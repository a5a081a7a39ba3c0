/* Propagation: carries the labels of a frame to the next one (section 3.4 of the paper).
 *
 *   1. the closed shapes of the next frame, and the rigid parts of this one
 *   2. poses of each part: where its outline lies on ink and it covers whole shapes
 *   3. the best pose of each, such that parts that touch stay together; twice, the second time also with poses for
 *      which they do exactly
 *   4. each shape takes the label of the part that explains it
 *
 * The paper moves scribbles with a lattice that is registered as rigidly as possible.  Here parts move rigidly, one by
 * one, which follows limbs that swing far between frames; closed shapes of the next frame then have the exact outlines.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/rigid-parts.h"
#include "image/image.h"

#include <math.h>

#define SHIFT_SIDE  96    /* pixels of the longer side of the picture that all of the drawing is shifted in; chosen */
#define SHIFT_REACH 0.15f /* of the longer side; chosen */
#define SEEDS_OFF_INK     3.f   /* pixels of a drawing of CELD_MOTION_SIDE that scribbles keep off the ink; chosen */

/* ------------------------------------------------------------------ the shift of all */

/* How much ink is in each block of pixels: a picture without detail. */
static float *
ink_of_blocks (const CeldPlane *ink, int side, int across, int down)
{
  float *sum = celd_alloc0 ((size_t) across * (size_t) down, sizeof *sum);

  for (int y = 0; sum && y < ink->height; y++)
    for (int x = 0; x < ink->width; x++)
      sum[y / side * across + x / side] += (float) !celd_is_paper (CELD_AT (ink, x, y));
  return sum;
}

static double
overlap (const float *one, const float *other, int across, int down, int dx, int dy)
{
  double sum = 0;

  for (int y = dy < 0 ? -dy : 0; y < down && y + dy < down; y++)
    for (int x = dx < 0 ? -dx : 0; x < across && x + dx < across; x++)
      sum += (double) (one[y * across + x] * other[(y + dy) * across + x + dx]);
  return sum;
}

/* The shift for which most ink lies on ink, to a block. */
static CeldStatus
find_shift (const CeldPlane *source, const CeldPlane *target, CeldPose *pose)
{
  int        longer = source->width > source->height ? source->width : source->height;
  int        side = (longer + SHIFT_SIDE - 1) / SHIFT_SIDE, reach = (int) (SHIFT_REACH * (float) longer) / side;
  int        across = (source->width + side - 1) / side, down = (source->height + side - 1) / side;
  float     *one = ink_of_blocks (source, side, across, down), *other = ink_of_blocks (target, side, across, down);
  double     most = 0;
  CeldStatus status = one && other ? CELD_OK : CELD_NO_MEMORY;

  *pose = (CeldPose) { 0 };
  for (int dy = -reach; dy <= reach && status == CELD_OK; dy++)
    for (int dx = -reach; dx <= reach; dx++)
      {
        double now = overlap (one, other, across, down, dx, dy);

        if (now <= most)
          continue;
        most    = now;
        pose->x = (float) (dx * side);
        pose->y = (float) (dy * side);
      }
  celd_free (one);
  celd_free (other);
  return status;
}

/* ------------------------------------------------------------------ the poses of all parts */

/* Steps 2 and 3. */
static CeldStatus
find_poses (const CeldRigidParts *parts, const CeldTargetShapes *target, const CeldPose *expected,
            const CeldHost *host, CeldPose *pose)
{
  CeldHostPart  part[2];
  CeldHost      first = celd_host_part (&part[0], host, 0, 0.7), second = celd_host_part (&part[1], host, 0.7, 1);
  CeldPoseList *list = celd_alloc0 (parts->n, sizeof *list);
  size_t       *choice = celd_alloc0 (parts->n, sizeof *choice);
  CeldStatus    status = list && choice ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_poses_find (parts, target, expected, &first, list);
  if (status == CELD_OK)
    status = celd_poses_choose (parts, list, choice);
  if (status == CELD_OK)
    status = celd_poses_join (parts, target, expected, choice, &second, list);
  if (status == CELD_OK)
    status = celd_poses_choose (parts, list, choice);
  for (size_t k = 0; k < parts->n && status == CELD_OK; k++)
    pose[k] = list[k].pose[choice[k]];
  celd_free (list);
  celd_free (choice);
  return status;
}

/* ------------------------------------------------------------------ */

/* The largest distance of each shape's pixels to ink. */
static void
measure_depths (const CeldTargetShapes *target, float *deepest)
{
  for (size_t i = 0; i < (size_t) target->width * (size_t) target->height; i++)
    deepest[target->shape[i]] = fmaxf (deepest[target->shape[i]], target->distance[i]);
}

/* Labels what is deep enough in each shape: scribbles that keep off the ink, but in thin shapes reach half way. */
static CeldStatus
label_pixels (const CeldTargetShapes *target, const CeldRigidParts *parts, const CeldPose *pose, uint32_t background,
              CeldLabels *labels, CeldPlane *certainty)
{
  int        longer = target->width > target->height ? target->width : target->height;
  float      off = SEEDS_OFF_INK * (float) longer / CELD_MOTION_SIDE;
  uint32_t  *label = celd_alloc (target->n + 1, sizeof *label);
  float     *sure = celd_alloc (target->n + 1, sizeof *sure), *deepest = celd_alloc0 (target->n + 1, sizeof *deepest);
  CeldStatus status = label && sure && deepest ? celd_shape_labels (parts, pose, target, background, label, sure)
                                               : CELD_NO_MEMORY;

  if (status == CELD_OK)
    measure_depths (target, deepest);
  for (int y = 0; y < target->height && status == CELD_OK; y++)
    for (int x = 0; x < target->width; x++)
      {
        size_t   at = (size_t) y * (size_t) target->width + (size_t) x;
        uint32_t shape = target->shape[at];
        bool     deep = shape && target->distance[at] >= fminf (off, deepest[shape] / 2);

        CELD_AT (labels, x, y)    = deep ? label[shape] : 0;
        CELD_AT (certainty, x, y) = shape ? sure[shape] : 0;
      }
  celd_free (label);
  celd_free (sure);
  celd_free (deepest);
  return status;
}

CeldStatus
celd_propagate (const CeldPlane *ink, const CeldLabels *source, const uint32_t *level, uint32_t background,
                const CeldPlane *next, const CeldHost *host, CeldLabels *labels, CeldPlane *certainty)
{
  CeldTargetShapes target = { 0 };
  CeldRigidParts   parts = { 0 };
  CeldPose        *expected = NULL, *pose = NULL;
  CeldHostPart     part[3];
  CeldHost         first = celd_host_part (&part[0], host, 0, 0.15);
  CeldHost         second = celd_host_part (&part[1], host, 0.15, 0.2), third = celd_host_part (&part[2], host, 0.2, 1);
  CeldStatus       status;

  if (!CELD_SAME_SIZE (ink, source) || !CELD_SAME_SIZE (ink, next) || !CELD_SAME_SIZE (ink, labels) ||
      !CELD_SAME_SIZE (ink, certainty))
    return CELD_BAD_SIZE;
  status = celd_target_shapes_new (next, &first, &target);
  if (status == CELD_OK)
    status = celd_rigid_parts_new (ink, source, level, background, &second, &parts);
  if (status == CELD_OK && (!(expected = celd_alloc (parts.n, sizeof *expected)) ||
                            !(pose = celd_alloc (parts.n, sizeof *pose))))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK && parts.n)
    status = find_shift (ink, next, &expected[0]);
  for (size_t k = 1; k < parts.n && status == CELD_OK; k++)
    expected[k] = expected[0];
  if (status == CELD_OK)
    status = find_poses (&parts, &target, expected, &third, pose);
  if (status == CELD_OK)
    status = label_pixels (&target, &parts, pose, background, labels, certainty);
  celd_free (expected);
  celd_free (pose);
  celd_rigid_parts_clear (&parts);
  celd_target_shapes_clear (&target);
  return status;
}
