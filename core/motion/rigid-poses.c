/* Poses of rigid parts: what a pose costs, a search over a grid of turns and shifts, and refinement.
 *
 * A part fits where its outline lies on ink (half a truncated chamfer distance, [BTBW77]) and where it covers the same
 * pixels as some closed shapes of the target, those that it covers by more than half (half of 1 - intersection over
 * union).  Neither asks what the part looks like inside, since ink there may change.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/rigid-parts.h"

#include <math.h>
#include <stdlib.h>

/* Lengths are in pixels of a drawing of CELD_MOTION_SIDE.  All chosen. */
#define GRID_REACH      109.f /* of shifts, from the expected one */
#define GRID_MOST_STEP  12.f  /* between shifts; smaller for small parts */
#define GRID_LEAST_STEP 3.f
#define GRID_TURN       (40 * (float) CELD_RADIANS) /* to either side */
#define GRID_TURN_STEP  (10 * (float) CELD_RADIANS)
#define OUTLINE_OFF_INK 8.f   /* an outline farther from ink is not worse */
#define UNEXPECTED      0.15f /* cost of a shift by GRID_REACH, and of a turn by twice GRID_TURN */
#define BEST            24    /* poses of the grid that are kept */
#define JOIN_TURN       (15 * (float) CELD_RADIANS)
#define JOIN_STEP       4.f   /* of the refinement of poses that keep two parts together */
#define DESCENTS        40    /* steps of a refinement at most */

/* A search for poses of all parts. */
typedef struct
{
  const CeldRigidParts   *parts;
  const CeldTargetShapes *target;
  const CeldPose         *expected;
  const size_t           *choice;   /* NULL: over the grid */
  CeldPoseList           *list;
  float                   scale;
  CeldStatus             *status;   /* of each part */
  int                     first;    /* of the round */
} PoseSearch;

typedef struct { float cost; CeldPose pose; } Candidate;

/* A part with what its poses are compared with. */
typedef struct
{
  const CeldRigidPart    *part;
  const CeldTargetShapes *target;
  const CeldPose         *expected;
  float                   scale;
  float                  *count;    /* see celd_pose_misfit */
} Fit;

static float
scale_of (const CeldTargetShapes *target)
{
  return (float) (target->width > target->height ? target->width : target->height) / CELD_MOTION_SIDE;
}

/* ------------------------------------------------------------------ the cost of a pose */

void
celd_pose_move (const CeldRigidPart *part, const CeldPose *pose, float x, float y, float place[2])
{
  float c = cosf (pose->angle), s = sinf (pose->angle), dx = x - part->x, dy = y - part->y;

  place[0] = c * dx - s * dy + part->x + pose->x;
  place[1] = s * dx + c * dy + part->y + pose->y;
}

/* The pixel that a pose takes an offset to; SIZE_MAX outside the picture. */
static inline size_t
pixel_of (const CeldTargetShapes *target, CeldOffset at, float c, float s, float x, float y)
{
  float px = c * at.x - s * at.y + x, py = s * at.x + c * at.y + y;

  if (!(px >= 0 && py >= 0 && px < (float) target->width && py < (float) target->height))
    return SIZE_MAX;
  return (size_t) (int) py * (size_t) target->width + (size_t) (int) px;
}

/* The mean distance of the outline to ink, truncated, as a fraction of the largest one. */
static float
outline_misfit (const CeldRigidPart *part, const CeldTargetShapes *target, float c, float s, float x, float y)
{
  float most = OUTLINE_OFF_INK * scale_of (target), sum = 0;

  for (size_t i = 0; i < part->n_outline; i++)
    {
      size_t at = pixel_of (target, part->outline[i], c, s, x, y);
      float  distance = at == SIZE_MAX ? most : target->distance[at];

      sum += distance < most ? distance : most;
    }
  return part->n_outline ? sum / (most * (float) part->n_outline) : 1;
}

/* 1 - intersection over union of the part and the shapes that it covers by more than half. */
static float
cover_misfit (const CeldRigidPart *part, const CeldTargetShapes *target, float c, float s, float x, float y,
              float *count)
{
  float    unit = (float) part->area / (float) (part->n_inside ? part->n_inside : 1), common = 0;
  float    all = (float) part->area;
  uint32_t shape[CELD_INSIDE_SAMPLES];
  size_t   n = 0;

  for (size_t i = 0; i < part->n_inside; i++)
    {
      size_t   at = pixel_of (target, part->inside[i], c, s, x, y);
      uint32_t k = at == SIZE_MAX ? 0 : target->shape[at];

      if (k && count[k] <= 0)
        shape[n++] = k;
      count[k] += (float) (k > 0);
    }
  for (size_t i = 0; i < n; i++)
    {
      float size = (float) target->size[shape[i]], covered = fminf (size, unit * count[shape[i]]);

      count[shape[i]] = 0;
      if (covered <= size / 2)
        continue;
      common += covered;
      all    += size - covered;
    }
  return 1 - common / all;
}

float
celd_pose_misfit (const CeldRigidPart *part, const CeldTargetShapes *target, const CeldPose *pose, float *count)
{
  float c = cosf (pose->angle), s = sinf (pose->angle), x = part->x + pose->x, y = part->y + pose->y;

  return 0.5f * outline_misfit (part, target, c, s, x, y) + 0.5f * cover_misfit (part, target, c, s, x, y, count);
}

static float
cost_of (const Fit *fit, CeldPose pose)
{
  float away = hypotf (pose.x - fit->expected->x, pose.y - fit->expected->y) / (GRID_REACH * fit->scale);
  float turn = fabsf (pose.angle - fit->expected->angle) / GRID_TURN;

  return celd_pose_misfit (fit->part, fit->target, &pose, fit->count) + UNEXPECTED * (away + 0.5f * turn);
}

/* ------------------------------------------------------------------ refinement */

/* Goes to the best of the poses around, with smaller and smaller steps down to a pixel. */
static CeldPose
refine (const Fit *fit, CeldPose pose, float step, float turn)
{
  float best = cost_of (fit, pose);

  for (int i = 0; i < DESCENTS && step >= 1; i++)
    {
      CeldPose centre = pose;

      for (int k = 0; k < 27; k++)
        {
          CeldPose next = { centre.angle + (float) (k / 9 - 1) * turn, centre.x + (float) (k / 3 % 3 - 1) * step,
                            centre.y + (float) (k % 3 - 1) * step };
          float    cost = k == 13 ? best : cost_of (fit, next);

          if (cost < best - 1e-6f)
            {
              best = cost;
              pose = next;
            }
        }
      if (pose.angle == centre.angle && pose.x == centre.x && pose.y == centre.y)
        {
          step /= 2;
          turn /= 2;
        }
    }
  return pose;
}

static void
add (const Fit *fit, CeldPose pose, CeldPoseList *list)
{
  if (list->n == CELD_MOST_POSES)
    return;
  list->pose[list->n] = pose;
  list->cost[list->n] = cost_of (fit, pose);
  list->n++;
}

/* ------------------------------------------------------------------ the grid */

static int
compare_costs (const void *a, const void *b)
{
  const Candidate *one = a, *other = b;

  if (one->cost < other->cost || one->cost > other->cost)
    return one->cost < other->cost ? -1 : 1;
  if (one->pose.angle < other->pose.angle || one->pose.angle > other->pose.angle)
    return one->pose.angle < other->pose.angle ? -1 : 1;
  if (one->pose.y < other->pose.y || one->pose.y > other->pose.y)
    return one->pose.y < other->pose.y ? -1 : 1;
  return (one->pose.x > other->pose.x) - (one->pose.x < other->pose.x);
}

static bool
is_near (const CeldPose *a, const CeldPose *b, float step)
{
  return hypotf (a->x - b->x, a->y - b->y) <= 1.5f * step && fabsf (a->angle - b->angle) <= 1.5f * GRID_TURN_STEP;
}

/* Rates all poses of the grid, the best first. */
static CeldStatus
rate_grid (const Fit *fit, float step, Candidate **candidate, size_t *n)
{
  int    shifts = (int) (GRID_REACH * fit->scale / step), turns = (int) (GRID_TURN / GRID_TURN_STEP + 0.5f);
  size_t most = (size_t) (2 * shifts + 1) * (size_t) (2 * shifts + 1) * (size_t) (2 * turns + 1);

  *candidate = celd_alloc (most, sizeof **candidate);
  if (!*candidate)
    return CELD_NO_MEMORY;
  for (int a = -turns; a <= turns; a++)
    for (int v = -shifts; v <= shifts; v++)
      for (int u = -shifts; u <= shifts; u++)
        {
          CeldPose pose = { fit->expected->angle + (float) a * GRID_TURN_STEP, fit->expected->x + (float) u * step,
                            fit->expected->y + (float) v * step };

          if (u * u + v * v <= shifts * shifts)
            (*candidate)[(*n)++] = (Candidate) { cost_of (fit, pose), pose };
        }
  qsort (*candidate, *n, sizeof **candidate, compare_costs);
  return CELD_OK;
}

static CeldStatus
search_grid (const Fit *fit, CeldPoseList *list)
{
  float      wanted = sqrtf ((float) fit->part->area) / 5, least = GRID_LEAST_STEP * fit->scale;
  float      step = fminf (GRID_MOST_STEP * fit->scale, wanted > least ? wanted : least);
  Candidate *candidate = NULL;
  CeldPose   kept[BEST];
  size_t     n = 0, n_kept = 0;
  CeldStatus status = rate_grid (fit, step, &candidate, &n);

  list->n = 0;
  add (fit, *fit->expected, list);
  for (size_t i = 0; i < n && n_kept < BEST; i++)
    {
      bool near = false;

      for (size_t k = 0; k < n_kept && !near; k++)
        near = is_near (&candidate[i].pose, &kept[k], step);
      if (near)
        continue;
      kept[n_kept++] = candidate[i].pose;
      add (fit, refine (fit, candidate[i].pose, step / 2, GRID_TURN_STEP / 2), list);
    }
  celd_free (candidate);
  return status;
}

/* ------------------------------------------------------------------ poses that keep parts together */

/* Adds poses of a part for which its contact stays where the chosen pose of the other part takes it. */
static void
join_to (const Fit *fit, const CeldContact *contact, const CeldRigidPart *other, const CeldPose *chosen,
         CeldPoseList *list)
{
  float where[2];

  celd_pose_move (other, chosen, contact->x, contact->y, where);
  for (int i = -1; i <= 4; i++)
    {
      CeldPose pose = { i < 0 ? chosen->angle : (float) (i - 2) * JOIN_TURN, 0, 0 };
      float    at[2];

      celd_pose_move (fit->part, &pose, contact->x, contact->y, at);
      pose.x = where[0] - at[0];
      pose.y = where[1] - at[1];
      add (fit, refine (fit, pose, JOIN_STEP * fit->scale, GRID_TURN_STEP / 2), list);
    }
}

static void
search_joints (const PoseSearch *s, const Fit *fit, uint32_t k, CeldPoseList *list)
{
  for (size_t i = 0; i < s->parts->n_contacts; i++)
    {
      const CeldContact *contact = &s->parts->contact[i];
      uint32_t           other = contact->a == k ? contact->b : contact->a;

      if (contact->a == k || contact->b == k)
        join_to (fit, contact, &s->parts->item[other], &s->list[other].pose[s->choice[other]], list);
    }
}

/* ------------------------------------------------------------------ all parts */

static void
search_part (void *data, int i)
{
  PoseSearch       *s = data;
  size_t        k = (size_t) (s->first + i);
  Fit           fit = { &s->parts->item[k], s->target, &s->expected[k], s->scale,
                        celd_alloc0 (s->target->n + 1, sizeof *fit.count) };

  s->status[k] = CELD_NO_MEMORY;
  if (!fit.count)
    return;
  s->status[k] = CELD_OK;
  if (s->choice)
    search_joints (s, &fit, (uint32_t) k, &s->list[k]);
  else
    s->status[k] = search_grid (&fit, &s->list[k]);
  celd_free (fit.count);
}

static CeldStatus
search_all (PoseSearch *s, const CeldHost *host)
{
  CeldStatus status;

  s->scale  = scale_of (s->target);
  s->status = celd_alloc0 (s->parts->n, sizeof *s->status);
  if (!s->status)
    return CELD_NO_MEMORY;
  status = celd_parallel_rounds (host, (int) s->parts->n, 8, search_part, s, &s->first, 0, 1);
  for (size_t k = 0; k < s->parts->n && status == CELD_OK; k++)
    status = s->status[k];
  celd_free (s->status);
  return status;
}

CeldStatus
celd_poses_find (const CeldRigidParts *parts, const CeldTargetShapes *target, const CeldPose *expected,
                 const CeldHost *host, CeldPoseList *list)
{
  return search_all (&(PoseSearch) { .parts = parts, .target = target, .expected = expected, .list = list }, host);
}

CeldStatus
celd_poses_join (const CeldRigidParts *parts, const CeldTargetShapes *target, const CeldPose *expected,
                 const size_t *choice, const CeldHost *host, CeldPoseList *list)
{
  return search_all (&(PoseSearch) { .parts = parts, .target = target, .expected = expected, .choice = choice,
                                 .list = list }, host);
}
