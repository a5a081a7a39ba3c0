/* What the pose of a rigid part costs.
 *
 * A part fits where its outline lies on ink (half a truncated chamfer distance, [BTBW77]) and where it covers the same
 * pixels as some closed shapes of the target, those that it covers by more than half (half of 1 - intersection over
 * union).  Neither asks what the part looks like inside, since ink there may change.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/rigid-parts.h"

#include <math.h>

#define OUTLINE_OFF_INK 8.f /* pixels of a drawing of CELD_MOTION_SIDE: an outline farther off is not worse; chosen */

void
celd_pose_move (const CeldRigidPart *part, const CeldPose *pose, float x, float y, float place[2])
{
  float c = cosf (pose->angle), s = sinf (pose->angle), dx = x - part->x, dy = y - part->y;

  place[0] = c * dx - s * dy + part->x + pose->x;
  place[1] = s * dx + c * dy + part->y + pose->y;
}

/* ------------------------------------------------------------------ samples of a turned part */

static void
turn_samples (const CeldOffset *from, size_t n, float angle, CeldOffset *to)
{
  float c = cosf (angle), s = sinf (angle);

  for (size_t i = 0; i < n; i++)
    to[i] = (CeldOffset) { c * from[i].x - s * from[i].y, s * from[i].x + c * from[i].y };
}

void
celd_part_turn (const CeldRigidPart *part, float angle, CeldTurnedPart *turned)
{
  turned->part = part;
  turn_samples (part->inside, part->n_inside, angle, turned->inside);
  turn_samples (part->outline, part->n_outline, angle, turned->outline);
}

/* The pixels of the target that samples come to lie on; -1 outside it. */
static void
find_pixels (const CeldTargetShapes *target, const CeldOffset *at, size_t n, float x, float y, int *pixel)
{
  float right = (float) target->width, bottom = (float) target->height;

  for (size_t i = 0; i < n; i++)
    {
      float px = at[i].x + x, py = at[i].y + y;
      bool  there = (px >= 0) & (py >= 0) & (px < right) & (py < bottom);

      pixel[i] = there ? (int) py * target->width + (int) px : -1;
    }
}

/* ------------------------------------------------------------------ the misfit */

float
celd_outline_misfit (const CeldTurnedPart *turned, const CeldTargetShapes *target, float x, float y)
{
  int    longer = target->width > target->height ? target->width : target->height, pixel[CELD_OUTLINE_SAMPLES];
  float  most = OUTLINE_OFF_INK * ((float) longer / CELD_MOTION_SIDE), sum = 0;
  size_t n = turned->part->n_outline;

  find_pixels (target, turned->outline, n, x, y, pixel);
  for (size_t i = 0; i < n; i++)
    {
      float distance = pixel[i] < 0 ? most : target->distance[pixel[i]];

      sum += distance < most ? distance : most;
    }
  return n ? sum / (most * (float) n) : 1;
}

/* Lists the shapes that a part comes to lie on, counting its samples there.  Samples follow each other in rows, so most
 * have the shape of the one before. */
static size_t
count_shapes (const CeldTurnedPart *turned, const CeldTargetShapes *target, float x, float y, uint32_t *shape,
              uint32_t *count)
{
  int    pixel[CELD_INSIDE_SAMPLES];
  size_t n = turned->part->n_inside, n_shapes = 0;

  find_pixels (target, turned->inside, n, x, y, pixel);
  for (size_t i = 0, end; i < n; i = end)
    {
      uint32_t k = pixel[i] < 0 ? 0 : target->shape[pixel[i]];

      for (end = i + 1; end < n && (pixel[end] < 0 ? 0 : target->shape[pixel[end]]) == k; end++)
        ;
      if (k && !count[k])
        shape[n_shapes++] = k;
      count[k] += k ? (uint32_t) (end - i) : 0;
    }
  return n_shapes;
}

float
celd_cover_misfit (const CeldTurnedPart *turned, const CeldTargetShapes *target, float x, float y, uint32_t *count)
{
  const CeldRigidPart *part = turned->part;
  float    unit = (float) part->area / (float) (part->n_inside ? part->n_inside : 1), common = 0;
  float    all = (float) part->area;
  uint32_t shape[CELD_INSIDE_SAMPLES];
  size_t   n = count_shapes (turned, target, x, y, shape, count);

  for (size_t i = 0; i < n; i++)
    {
      float size = (float) target->size[shape[i]], covered = fminf (size, unit * (float) count[shape[i]]);

      count[shape[i]] = 0;
      if (covered <= size / 2)
        continue;
      common += covered;
      all    += size - covered;
    }
  return fmaxf (0, 1 - common / all);
}

float
celd_pose_misfit (const CeldRigidPart *part, const CeldTargetShapes *target, const CeldPose *pose, uint32_t *count)
{
  CeldTurnedPart turned;
  float          x = part->x + pose->x, y = part->y + pose->y;

  celd_part_turn (part, pose->angle, &turned);
  return 0.5f * celd_outline_misfit (&turned, target, x, y) + 0.5f * celd_cover_misfit (&turned, target, x, y, count);
}
