/* Poses of a square, whose misfits are known, and the search for them, which has to find what an exhaustive one finds.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "motion/rigid-parts.h"

#include <math.h>
#include <stdlib.h>

#define SIDE   640
#define SQUARE 182  /* its line included */
#define PIXELS (SIDE * SIDE)

enum { PAGE = 1, PART };

typedef struct
{
  CeldPlane        ink;
  CeldLabels       labels;
  CeldRigidParts   parts;
  CeldTargetShapes target;
  uint32_t        *count;
} Scene;

/* Draws a square with a line of two pixels, turned about its middle. */
static void
draw (float angle, float x, float y, float *ink, uint32_t *labels)
{
  for (int i = 0; i < PIXELS; i++)
    {
      float dx = (float) (i % SIDE) + 0.5f - x, dy = (float) (i / SIDE) + 0.5f - y;
      float u = fabsf (cosf (angle) * dx + sinf (angle) * dy), v = fabsf (cosf (angle) * dy - sinf (angle) * dx);
      float off = fmaxf (u, v) - SQUARE / 2.f;

      ink[i] = off < 0 && off >= -2 ? 0 : 1;
      if (labels)
        labels[i] = off < 0 ? PART : PAGE;
    }
}

/* The part of a straight square in the middle, and a target with the square at another place. */
static Scene
make_scene (float angle, float x, float y)
{
  Scene     s = { .ink = { SIDE, SIDE, SIDE, malloc (PIXELS * sizeof (float)) },
                  .labels = { SIDE, SIDE, SIDE, malloc (PIXELS * sizeof (uint32_t)) } };
  CeldPlane next = { SIDE, SIDE, SIDE, malloc (PIXELS * sizeof (float)) };

  draw (0, SIDE / 2, SIDE / 2, s.ink.data, s.labels.data);
  draw (angle, SIDE / 2 + x, SIDE / 2 + y, next.data, NULL);
  CHECK (celd_rigid_parts_new (&s.ink, &s.labels, NULL, PAGE, NULL, &s.parts) == CELD_OK);
  CHECK (celd_target_shapes_new (&next, NULL, &s.target) == CELD_OK);
  CHECK (s.parts.n == 1);
  s.count = calloc (s.target.n + 1, sizeof *s.count);
  free (next.data);
  return s;
}

static void
drop (Scene *s)
{
  celd_rigid_parts_clear (&s->parts);
  celd_target_shapes_clear (&s->target);
  free (s->ink.data);
  free (s->labels.data);
  free (s->count);
}

static float
cover_at (Scene *s, float angle, float x, float y)
{
  CeldTurnedPart turned;
  float          misfit;

  celd_part_turn (&s->parts.item[0], angle, &turned);
  misfit = celd_cover_misfit (&turned, &s->target, s->parts.item[0].x + x, s->parts.item[0].y + y, s->count);
  for (size_t k = 0; k <= s->target.n; k++)
    CHECK (!s->count[k]);
  return misfit;
}

static float
outline_at (Scene *s, float angle, float x, float y)
{
  CeldTurnedPart turned;

  celd_part_turn (&s->parts.item[0], angle, &turned);
  return celd_outline_misfit (&turned, &s->target, s->parts.item[0].x + x, s->parts.item[0].y + y);
}

/* Paper of 178 x 178 pixels: a shift by a quarter of that leaves 3/4 in common of 5/4; with less than half in common,
 * and off the picture, nothing is. */
static void
misfits_of_shifts_are_known (void)
{
  Scene s = make_scene (0, 20, -10);

  NEAR (cover_at (&s, 0, 20, -10), 0, 1e-5);
  NEAR (cover_at (&s, (float) CELD_PI / 2, 20, -10), 0, 0.02);
  NEAR (cover_at (&s, 0, 20 + 178 / 4.f, -10), 1 - 0.75 / 1.25, 0.04);
  NEAR (cover_at (&s, 0, 20, 90), 1, 1e-5);
  NEAR (cover_at (&s, 0, 1000, 0), 1, 1e-5);
  NEAR (outline_at (&s, 0, 20, -10), 0, 1e-5);
  NEAR (outline_at (&s, 0, 1000, 0), 1, 1e-5);
  NEAR (celd_pose_misfit (&s.parts.item[0], &s.target, &(CeldPose) { 0, 34, -10 }, s.count),
        0.5f * outline_at (&s, 0, 34, -10) + 0.5f * cover_at (&s, 0, 34, -10), 1e-6);
  drop (&s);
}

/* The best pose is where the square went, and no pose of a fine grid around fits clearly better. */
static void
search_finds_the_best_pose (void)
{
  static const CeldPose to[] = { { 0.3f, 54, -27 }, { -0.4f, -75, 36 }, { 0, 90, 15 } };

  for (size_t i = 0; i < sizeof to / sizeof *to; i++)
    {
      Scene         s = make_scene (to[i].angle, to[i].x, to[i].y);
      CeldPose      expected = { 0, 0, 0 };
      CeldPoseList *list = malloc (sizeof *list);
      size_t        best = 0;
      float         found, least = INFINITY;

      CHECK (celd_poses_find (&s.parts, &s.target, &expected, NULL, list) == CELD_OK);
      NEAR (list->pose[0].x, 0, 0);
      for (size_t k = 1; k < list->n; k++)
        best = list->cost[k] < list->cost[best] ? k : best;
      NEAR (list->pose[best].x, to[i].x, 2);
      NEAR (list->pose[best].y, to[i].y, 2);
      NEAR (list->pose[best].angle, to[i].angle, 0.05);
      found = celd_pose_misfit (&s.parts.item[0], &s.target, &list->pose[best], s.count);
      for (float angle = -0.6f; angle <= 0.6f; angle += 0.1f)
        for (float y = -99; y <= 99; y += 9)
          for (float x = -99; x <= 99; x += 9)
            least = fminf (least, celd_pose_misfit (&s.parts.item[0], &s.target, &(CeldPose) { angle, x, y }, s.count));
      CHECK (found <= least + 0.05f); /* a pixel or two off */
      free (list);
      drop (&s);
    }
}

/* Whether a pose is next to another one: a turn and a shift of the grid away, or less. */
static bool
is_next (const CeldPose *a, const CeldPose *b, float step)
{
  return fabsf (a->x - b->x) <= step && fabsf (a->y - b->y) <= step && fabsf (a->angle - b->angle) <= 0.18f;
}

/* All poses of the list are within reach, and as good as the expected one where nothing moves. */
static void
still_parts_stay (void)
{
  Scene         s = make_scene (0, 0, 0);
  CeldPose      expected = { 0, 0, 0 };
  CeldPoseList *list = malloc (sizeof *list);
  size_t        close = 0;

  CHECK (celd_poses_find (&s.parts, &s.target, &expected, NULL, list) == CELD_OK);
  NEAR (list->cost[0], 0, 1e-5);
  CHECK (list->n > 10 && list->n <= CELD_MOST_POSES);
  for (size_t k = 1; k < list->n; k++)
    {
      CHECK (list->cost[k] >= list->cost[0] - 1e-6f);
      close += is_next (&list->pose[k], &expected, 2);
    }
  CHECK (close >= 1);
  drop (&s);
  free (list);
}

int
main (void)
{
  RUN (misfits_of_shifts_are_known);
  RUN (search_finds_the_best_pose);
  RUN (still_parts_stay);
  return DONE;
}
