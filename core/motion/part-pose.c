/* The rigid motion of a part from one key to the other.
 *
 * A pose fits where the lines of each key lie on lines of the other one (truncated chamfer distance, both ways
 * [BTBW77]), where the part stays attached to those that it touches, and where it does not turn more than need be.
 * A grid of turns and shifts is tried, and the best poses are refined.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/inbetween.h"

#define TURNS         24    /* of the grid, over the full circle; chosen */
#define SHIFTS        5     /* of the grid, to either side; chosen */
#define PLACE_REACH   0.5f  /* of the part's extent; chosen */
#define REFINEMENTS   40    /* steps of one; chosen */
#define LEAST_STEP    0.25f /* pixels; chosen */
#define OFF_LINES     16.f  /* pixels of a drawing of CELD_KEY_SIDE: farther from lines is not worse; chosen */
#define HIDDEN_MISFIT 0.4f  /* the most that a line counts which comes to lie behind other parts; chosen */
#define TURN_COST     0.12f /* of half a turn; chosen */
#define SHIFT_COST    0.05f /* of a motion across the window; chosen */
#define BEST_BOND     0.15f /* for one part that it stays with; chosen */
#define ALL_BONDS     0.1f  /* for all of them; chosen */
#define BOND_APART    24.f  /* pixels of a drawing of CELD_KEY_SIDE: from here on parts are off each other; chosen */

typedef struct
{
  const CeldPartLines *lines;   /* of both keys */
  const CeldPartBond  *bond;
  size_t               n_bonds;
  float                scale;   /* of the drawing, against CELD_KEY_SIDE */
} PartFit;

typedef struct { float cost; CeldPartPose pose; } RatedPose;

typedef struct { PartFit fit; RatedPose best[TURNS + 1]; } PartSearch;

/* ------------------------------------------------------------------ maps */

void
celd_part_pose_map (const CeldPartPose *pose, float x, float y, float place[2])
{
  float c = cosf (pose->angle), s = sinf (pose->angle), dx = x - pose->x, dy = y - pose->y;

  place[0] = pose->to_x + c * dx - s * dy;
  place[1] = pose->to_y + s * dx + c * dy;
}

CeldPartPose
celd_part_pose_back (const CeldPartPose *pose)
{
  return (CeldPartPose) { -pose->angle, pose->to_x, pose->to_y, pose->x, pose->y };
}

/* ------------------------------------------------------------------ the cost of a pose */

/* How far one key's lines are off those of the other, 0 .. 1. */
static float
lines_misfit (const PartFit *fit, int from, CeldPartPose pose)
{
  const CeldPartLines *source = &fit->lines[from], *target = &fit->lines[!from];
  float                most = OFF_LINES * fit->scale, sum = 0, all = 0, c = cosf (pose.angle), s = sinf (pose.angle);

  for (size_t i = 0; i < source->n_points; i++)
    {
      const CeldLinePoint *p = &source->point[i];
      float                x = pose.to_x + c * (p->x - pose.x) - s * (p->y - pose.y);
      float                y = pose.to_y + s * (p->x - pose.x) + c * (p->y - pose.y), misfit = 1;

      if (x >= 0 && y >= 0 && x < (float) target->window.width && y < (float) target->window.height)
        {
          size_t at = (size_t) (int) y * (size_t) target->window.width + (size_t) (int) x;

          misfit = fminf (1, sqrtf ((float) target->squared[at]) / most);
          if (target->hidden[at])
            misfit = fminf (misfit, HIDDEN_MISFIT);
        }
      sum += p->weight * misfit;
      all += p->weight;
    }
  return all > 0 ? sum / all : 1;
}

/* How well it stays with the parts that it touches. */
static float
attachment (const PartFit *fit, const CeldPartPose *pose)
{
  float apart = BOND_APART * fit->scale, best = 0, sum = 0, n = 0;

  for (size_t b = 0, end; b < fit->n_bonds; b = end)
    {
      float held = 0;

      for (end = b; end < fit->n_bonds && fit->bond[end].layer == fit->bond[b].layer; end++)
        {
          float at[2];

          celd_part_pose_map (pose, fit->bond[end].from[0], fit->bond[end].from[1], at);
          held = fmaxf (held, 1 - hypotf (at[0] - fit->bond[end].to[0], at[1] - fit->bond[end].to[1]) / apart);
        }
      best = fmaxf (best, held);
      sum += held;
      n++;
    }
  return n > 0 ? BEST_BOND * best + ALL_BONDS * sum / n : 0;
}

static float
cost_of (const PartFit *fit, const CeldPartPose *pose)
{
  const CeldRect *window = &fit->lines[0].window;
  float           way = hypotf (pose->to_x - pose->x, pose->to_y - pose->y);
  float           turn = fabsf (remainderf (pose->angle, 2 * (float) CELD_PI)) / (float) CELD_PI;
  float           longer = (float) (window->width > window->height ? window->width : window->height);

  return 0.5f * lines_misfit (fit, 0, *pose) + 0.5f * lines_misfit (fit, 1, celd_part_pose_back (pose)) +
         TURN_COST * turn + SHIFT_COST * way / longer -
         attachment (fit, pose);
}

/* ------------------------------------------------------------------ the search */

/* Goes to the best of the poses around, with smaller and smaller steps. */
static RatedPose
refine_pose (const PartFit *fit, RatedPose best, float step, float turn)
{
  for (int i = 0; i < REFINEMENTS && step >= LEAST_STEP; i++)
    {
      CeldPartPose centre = best.pose;

      for (int k = 0; k < 27; k++)
        {
          RatedPose next = { 0, centre };

          next.pose.angle += (float) (k / 9 - 1) * turn;
          next.pose.to_x  += (float) (k / 3 % 3 - 1) * step;
          next.pose.to_y  += (float) (k % 3 - 1) * step;
          next.cost        = k == 13 ? best.cost : cost_of (fit, &next.pose);
          if (next.cost < best.cost - 1e-6f)
            best = next;
        }
      if (best.pose.angle == centre.angle && best.pose.to_x == centre.to_x && best.pose.to_y == centre.to_y)
        {
          step /= 2;
          turn /= 2;
        }
    }
  return best;
}

/* The best pose near one turn; the last one is that of a part that does not move. */
static void
try_turn (void *data, int turn)
{
  PartSearch          *search = data;
  const PartFit       *fit = &search->fit;
  const CeldPartLines *lines = fit->lines;
  bool                 still = turn == TURNS;
  float                step = fmaxf (1, PLACE_REACH * fmaxf (lines[0].extent, lines[1].extent) / SHIFTS);
  RatedPose            best = { .cost = INFINITY };

  for (int k = 0; k < (still ? 1 : (2 * SHIFTS + 1) * (2 * SHIFTS + 1)); k++)
    {
      RatedPose next = { 0, { still ? 0 : (float) (2 * CELD_PI * turn / TURNS), lines[0].centre[0], lines[0].centre[1],
                              lines[!still].centre[0], lines[!still].centre[1] } };

      next.pose.to_x += still ? 0 : (float) (k % (2 * SHIFTS + 1) - SHIFTS) * step;
      next.pose.to_y += still ? 0 : (float) (k / (2 * SHIFTS + 1) - SHIFTS) * step;
      next.cost       = cost_of (fit, &next.pose);
      if (next.cost < best.cost)
        best = next;
    }
  search->best[turn] = refine_pose (fit, best, step / 2, (float) CELD_PI / TURNS);
}

void
celd_part_pose_find (const CeldPartLines lines[2], float scale, const CeldPartBond *bond, size_t n,
                     const CeldHost *host, CeldPartPose *pose)
{
  PartSearch search = { .fit = { lines, bond, n, scale } };
  int        best = TURNS;

  celd_parallel_for (host, TURNS + 1, try_turn, &search);
  for (int t = 0; t < TURNS; t++)
    if (search.best[t].cost < search.best[best].cost)
      best = t;
  *pose = search.best[best].pose;
  pose->angle = remainderf (pose->angle, 2 * (float) CELD_PI);
}
