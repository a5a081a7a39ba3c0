/* Poses of rigid parts: a search over a grid of turns and shifts, and refinement.
 *
 * A pose costs at least what its outline does, which is cheap to find: what it covers is counted only if it can still
 * be among the best.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/rigid-parts.h"

#include <math.h>

/* Lengths are in pixels of a drawing of CELD_MOTION_SIDE.  All chosen. */
#define GRID_REACH      109.f /* of shifts, from the expected one */
#define GRID_MOST_STEP  12.f  /* between shifts; smaller for small parts */
#define GRID_LEAST_STEP 3.f
#define GRID_TURNS      4     /* to either side */
#define GRID_TURN_STEP  (10 * (float) CELD_RADIANS)
#define UNEXPECTED      0.15f /* cost of a shift by GRID_REACH, and of the largest turn twice */
#define BEST            24    /* poses of the grid that are kept */
#define JOIN_TURN       (15 * (float) CELD_RADIANS)
#define JOIN_STEP       4.f   /* of the refinement of poses that keep two parts together */
#define DESCENTS        40    /* steps of a refinement at most */

#define RATED 0x80000000u

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

/* A pose of the grid.  Until it is rated, the cost is a lower bound.  order: its place in the grid, and RATED. */
typedef struct { float cost; uint32_t order; } Candidate;

/* A part with what its poses are compared with. */
typedef struct
{
  const CeldRigidPart    *part;
  const CeldTargetShapes *target;
  const CeldPose         *expected;
  float                   scale;
  uint32_t               *count;    /* see celd_cover_misfit */
} Fit;

/* The poses around the expected one: for each turn, rows of shifts. */
typedef struct
{
  const Fit      *fit;
  float           step;
  int             shifts, side; /* to either side, and in a row */
  CeldTurnedPart *turned;       /* for each turn */
  Candidate      *heap;         /* a binary heap */
  uint8_t        *taken;        /* of each pose: it is, or it is near to one that is */
  size_t          n;
} PoseGrid;

static float
scale_of (const CeldTargetShapes *target)
{
  return (float) (target->width > target->height ? target->width : target->height) / CELD_MOTION_SIDE;
}

/* ------------------------------------------------------------------ the cost of a pose */

/* What a pose costs by its outline, and by how far it is from the expected one. */
static float
bound_of (const Fit *fit, const CeldTurnedPart *turned, const CeldPose *pose)
{
  float x = pose->x - fit->expected->x, y = pose->y - fit->expected->y;
  float away = sqrtf (x * x + y * y) / (GRID_REACH * fit->scale);
  float turn = fabsf (pose->angle - fit->expected->angle) / (GRID_TURNS * GRID_TURN_STEP);

  return 0.5f * celd_outline_misfit (turned, fit->target, fit->part->x + pose->x, fit->part->y + pose->y) +
         UNEXPECTED * (away + 0.5f * turn);
}

/* What a pose costs beyond that. */
static float
rest_of (const Fit *fit, const CeldTurnedPart *turned, const CeldPose *pose)
{
  return 0.5f * celd_cover_misfit (turned, fit->target, fit->part->x + pose->x, fit->part->y + pose->y, fit->count);
}

/* What a pose costs, or a lower bound of that which is `most` at least. */
static float
cost_below (const Fit *fit, const CeldTurnedPart *turned, const CeldPose *pose, float most)
{
  float bound = bound_of (fit, turned, pose);

  return bound >= most ? bound : bound + rest_of (fit, turned, pose);
}

static float
cost_of (const Fit *fit, const CeldPose *pose)
{
  CeldTurnedPart turned;

  celd_part_turn (fit->part, pose->angle, &turned);
  return cost_below (fit, &turned, pose, INFINITY);
}

/* ------------------------------------------------------------------ refinement */

/* Goes to the best of the poses around, with smaller and smaller steps down to a pixel. */
static CeldPose
refine (const Fit *fit, CeldPose pose, float step, float turn)
{
  float best = cost_of (fit, &pose);

  for (int i = 0; i < DESCENTS && step >= 1; i++)
    {
      CeldPose       centre = pose;
      CeldTurnedPart turned;

      for (int k = 0; k < 27; k++)
        {
          CeldPose next = { centre.angle + (float) (k / 9 - 1) * turn, centre.x + (float) (k / 3 % 3 - 1) * step,
                            centre.y + (float) (k % 3 - 1) * step };
          float    cost;

          if (k % 9 == 0)
            celd_part_turn (fit->part, next.angle, &turned);
          cost = k == 13 ? best : cost_below (fit, &turned, &next, best - 1e-6f);
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
  list->cost[list->n] = cost_of (fit, &pose);
  list->n++;
}

/* ------------------------------------------------------------------ the grid */

/* Whether a candidate comes before another one: of equal costs first those that may still grow. */
static bool
is_before (Candidate a, Candidate b)
{
  return a.cost < b.cost || (a.cost <= b.cost && a.order < b.order);
}

/* Moves candidate i of the heap down to where it belongs. */
static void
sink (Candidate *heap, size_t n, size_t i)
{
  Candidate moved = heap[i];

  for (size_t child; (child = 2 * i + 1) < n; i = child)
    {
      child += child + 1 < n && is_before (heap[child + 1], heap[child]);
      if (!is_before (heap[child], moved))
        break;
      heap[i] = heap[child];
    }
  heap[i] = moved;
}

static CeldPose
pose_at (const PoseGrid *grid, int turn, int v, int u)
{
  const CeldPose *expected = grid->fit->expected;

  return (CeldPose) { expected->angle + (float) (turn - GRID_TURNS) * GRID_TURN_STEP,
                      expected->x + (float) (u - grid->shifts) * grid->step,
                      expected->y + (float) (v - grid->shifts) * grid->step };
}

/* Finds the bounds of all poses. */
static void
bound_grid (PoseGrid *grid)
{
  int r = grid->shifts;

  for (int turn = 0; turn <= 2 * GRID_TURNS; turn++)
    {
      celd_part_turn (grid->fit->part, pose_at (grid, turn, 0, 0).angle, &grid->turned[turn]);
      for (int v = 0; v < grid->side; v++)
        for (int u = 0; u < grid->side; u++)
          if ((u - r) * (u - r) + (v - r) * (v - r) <= r * r)
            {
              CeldPose pose = pose_at (grid, turn, v, u);

              grid->heap[grid->n++] = (Candidate) { bound_of (grid->fit, &grid->turned[turn], &pose),
                                                    (uint32_t) ((turn * grid->side + v) * grid->side + u) };
            }
    }
  for (size_t i = grid->n / 2; i--;)
    sink (grid->heap, grid->n, i);
}

/* Takes a pose, so that those next to it are not. */
static void
take (PoseGrid *grid, int turn, int v, int u)
{
  for (int a = turn > 0 ? turn - 1 : 0; a <= turn + 1 && a <= 2 * GRID_TURNS; a++)
    for (int y = v > 0 ? v - 1 : 0; y <= v + 1 && y < grid->side; y++)
      for (int x = u > 0 ? u - 1 : 0; x <= u + 1 && x < grid->side; x++)
        grid->taken[(a * grid->side + y) * grid->side + x] = 1;
}

/* Takes the best poses that are not next to better ones. */
static size_t
take_best (PoseGrid *grid, CeldPose best[BEST])
{
  Candidate *first = &grid->heap[0];
  size_t     n = 0;

  while (grid->n && n < BEST)
    {
      int      place = (int) (first->order & ~RATED), u = place % grid->side, v = place / grid->side % grid->side;
      int      turn = place / grid->side / grid->side;
      CeldPose pose = pose_at (grid, turn, v, u);

      if (!grid->taken[place] && !(first->order & RATED))
        {
          first->cost  += rest_of (grid->fit, &grid->turned[turn], &pose);
          first->order |= RATED;
        }
      else
        {
          if (!grid->taken[place])
            {
              best[n++] = pose;
              take (grid, turn, v, u);
            }
          *first = grid->heap[--grid->n];
        }
      sink (grid->heap, grid->n, 0);
    }
  return n;
}

static CeldStatus
search_grid (const Fit *fit, CeldPoseList *list)
{
  float      wanted = sqrtf ((float) fit->part->area) / 5, least = GRID_LEAST_STEP * fit->scale;
  float      step = fminf (GRID_MOST_STEP * fit->scale, wanted > least ? wanted : least);
  int        shifts = (int) (GRID_REACH * fit->scale / step), side = 2 * shifts + 1, turns = 2 * GRID_TURNS + 1;
  size_t     most = (size_t) side * (size_t) side * (size_t) turns, n = 0;
  PoseGrid   grid = { fit, step, shifts, side, celd_alloc ((size_t) turns, sizeof *grid.turned),
                      celd_alloc (most, sizeof *grid.heap), celd_alloc0 (most, 1), 0 };
  bool       good = grid.turned && grid.heap && grid.taken;
  CeldPose   best[BEST];

  list->n = 0;
  add (fit, *fit->expected, list);
  if (good)
    {
      bound_grid (&grid);
      n = take_best (&grid, best);
    }
  for (size_t k = 0; k < n; k++)
    add (fit, refine (fit, best[k], step / 2, GRID_TURN_STEP / 2), list);
  celd_free (grid.turned);
  celd_free (grid.heap);
  celd_free (grid.taken);
  return good ? CELD_OK : CELD_NO_MEMORY;
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
