/* The parts of eq. (3) against plain relaxation of the whole picture, and edits against starting anew.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "random-levels.h"
#include "depth/depth.h"

#define THRESHOLD 25 /* percent */
#define REACH     1
#define TOLERANCE 1e-4
#define RANGE     3 /* of the levels of a picture, at most */

/* What a picture says, by definition. */
typedef struct { float weight[N][4]; int component[N], n; } Facts;

static void
find_facts (const Picture *p, Facts *f)
{
  int near[4];

  for (int i = 0; i < N; i++)
    for (int k = 0, n = neighbours (i, near); k < n; k++)
      f->weight[i][k] = plain_weight (p, THRESHOLD, REACH, i, near[k]);
  f->n = flood_parts (p->fixed, f->weight, f->component);
}

/* Successive over-relaxation, until nothing moves; what floats gets the mean of its levels. */
static void
relax (const Picture *p, const Facts *f, double depth[N])
{
  static double sum[N + 1], count[N + 1];
  static bool   held[N + 1];
  double        moved = 1;
  int           near[4];

  memset (sum, 0, sizeof sum);
  memset (count, 0, sizeof count);
  memset (held, 0, sizeof held);
  for (int i = 0; i < N; i++)
    {
      sum[f->component[i]]   += (double) p->level[i];
      count[f->component[i]] += 1;
      for (int k = 0, n = neighbours (i, near); k < n; k++)
        if (p->fixed[near[k]] && f->weight[i][k] > 0)
          held[f->component[i]] = true;
    }
  for (int i = 0; i < N; i++)
    depth[i] = p->fixed[i] || held[f->component[i]] ? (double) p->level[i]
                                                    : sum[f->component[i]] / count[f->component[i]];
  while (moved > 1e-9)
    {
      moved = 0;
      for (int i = 0; i < N; i++)
        if (!p->fixed[i] && held[f->component[i]])
          {
            double weighted = 0, weights = 0;

            for (int k = 0, n = neighbours (i, near); k < n; k++)
              {
                weighted += (double) f->weight[i][k] * depth[near[k]];
                weights  += (double) f->weight[i][k];
              }
            moved     = fmax (moved, fabs (weighted / weights - depth[i]));
            depth[i] += 1.8 * (weighted / weights - depth[i]);
          }
    }
}

static void
solve (Picture *p, float depth[N])
{
  CeldPlane           ink = ink_of (p);
  CeldSmoothEquations system = { W, H, p->level, p->fixed, { &ink, THRESHOLD / 100.f, REACH, NULL }, NULL, NULL,
                                 TOLERANCE, RANGE };
  CeldSolve           how = { 0 };

  CHECK (celd_smooth_equations_solve (&system, NULL, depth, &how) == CELD_OK);
  CHECK (how.converged && how.error <= TOLERANCE);
}

static void
depth_is_what_relaxation_finds (void)
{
  for (uint32_t round = 0, r = 3; round < 40; round++)
    {
      static Picture picture;
      static Facts   facts;
      static double  wanted[N];
      float          depth[N];

      random_picture (&r, &picture);
      if (round == 0)
        memset (picture.fixed, CELD_FREE, N); /* everything floats */
      find_facts (&picture, &facts);
      relax (&picture, &facts, wanted);
      solve (&picture, depth);
      for (int i = 0; i < N; i++)
        NEAR (depth[i], wanted[i], TOLERANCE * RANGE);
    }
}

/* Where fixed pixels of one level reach, that is depth to the last bit. */
static void
one_level_is_met_exactly (void)
{
  static Picture picture;
  float          depth[N];

  for (int i = 0; i < N; i++)
    picture.level[i] = 0.1f;
  picture.fixed[5 * W + 5] = CELD_ANCHOR;
  solve (&picture, depth);
  for (int i = 0; i < N; i++)
    CHECK (depth[i] == 0.1f);
}

/* ------------------------------------------------------------------ edits */

/* Levels of another range would have another tolerance. */
static void
keep_range (Picture *p)
{
  p->level[0]     = 0;
  p->level[N - 1] = RANGE;
}

static void
edit (uint32_t *r, Picture *p, CeldRect *new_ink)
{
  int   box[4], what = (int) check_random (r, 4);
  float level = (float) check_random (r, 4);

  random_box (r, 5, box);
  *new_ink = what == 0 ? (CeldRect) { box[0], box[1], box[2] - box[0], box[3] - box[1] } : (CeldRect) { 0 };
  FOR_BOX (box, x, y)
    if (what == 0)
      p->ink[y * W + x] = check_random (r, 2) ? 0.1f : 1;
    else if (what == 1)
      p->fixed[y * W + x] = p->fixed[y * W + x] ? CELD_FREE : CELD_ANCHOR;
    else
      p->level[y * W + x] = level;
  keep_range (p);
}

/* Is any equation of this part not what it was? */
static bool
is_touched (const Picture *now, const Picture *old, const Facts *facts, const Facts *before, int part)
{
  int near[4];

  for (int i = 0; i < N; i++)
    if (facts->component[i] == part)
      {
        if (now->level[i] != old->level[i] || now->fixed[i] != old->fixed[i])
          return true;
        for (int k = 0, n = neighbours (i, near); k < n; k++)
          if (facts->weight[i][k] != before->weight[i][k] || now->fixed[near[k]] != old->fixed[near[k]] ||
              now->level[near[k]] != old->level[near[k]])
            return true;
      }
  return false;
}

static void
again (CeldSmoothState *smoother, Picture *p, const CeldPlane *last, CeldPlane *depth)
{
  CeldSettings    settings = celd_settings ();
  CeldPlane       ink = ink_of (p), levels = { W, H, W, p->level };
  CeldMask        anchors = { W, H, W, p->fixed };
  CeldSmoothInput smoothing = { .ink = &ink, .levels = &levels, .anchors = &anchors, .settings = &settings,
                                .radius = REACH, .speck = CELD_SPECK, .last = last->data };
  CeldSolve       how;

  settings.hold_rest     = false;
  settings.hold_gaps     = false;
  settings.ink_threshold = THRESHOLD / 100.f;
  settings.tolerance     = (float) TOLERANCE;
  CHECK (celd_smooth_update (smoother, &smoothing, NULL, depth, &how) == CELD_OK);
  CHECK (how.converged);
}

static void
an_edit_solves_what_it_touches (void)
{
  static Picture picture, old;
  static Facts   facts, before;
  static double  wanted[N];
  int            kept = 0, solved = 0;

  for (uint32_t round = 0, r = 11; round < 12; round++)
    {
      CeldSmoothState smoother = { 0 };
      CeldPlane       last = { 0 }, depth;
      bool            inked = false;

      random_picture (&r, &picture);
      keep_range (&picture);
      for (int step = 0; step < 12; step++)
        {
          find_facts (&picture, &facts);
          again (&smoother, &picture, &last, &depth);
          relax (&picture, &facts, wanted);
          for (int i = 0; i < N; i++)
            NEAR (depth.data[i], wanted[i], TOLERANCE * RANGE);
          for (int part = 1; part <= facts.n && step > 0; part++)
            {
              bool touched = is_touched (&picture, &old, &facts, &before, part);

              solved += touched;
              kept   += !touched;
              for (int i = 0; i < N && !touched && !inked; i++)
                CHECK (facts.component[i] != part || depth.data[i] == last.data[i]);
            }
          celd_free (last.data);
          last   = depth;
          old    = picture;
          before = facts;
          edit (&r, &picture, &smoother.new_ink);
          inked = smoother.new_ink.width > 0;
        }
      celd_free (last.data);
      celd_smooth_state_clear (&smoother);
    }
  CHECK (kept > 50 && solved > 50);
}

/* Where nothing changed, depth is not solved again: a wrong last depth stays. */
static void
untouched_parts_are_not_solved (void)
{
  static Picture  picture;
  CeldSmoothState smoother = { 0 };
  CeldPlane       none = { 0 }, first, second;

  for (int i = 0; i < N; i++)
    {
      picture.level[i] = i % W < 10 ? 1 : 2;
      picture.ink[i]   = i % W == 20 ? 0 : 1;
      picture.fixed[i] = i % W == 0 || i % W == 20 || i == N - 1;
    }
  again (&smoother, &picture, &none, &first);
  first.data[5] = -1;
  picture.level[N - 2] = 3; /* behind the fixed column */
  again (&smoother, &picture, &first, &second);
  NEAR (second.data[5], -1, 0);
  picture.level[6] = 3;
  celd_free (first.data);
  again (&smoother, &picture, &second, &first);
  CHECK (first.data[5] >= 1);
  celd_free (first.data);
  celd_free (second.data);
  celd_smooth_state_clear (&smoother);
}

/* A picture without any part. */
static void
fixed_pixels_keep_their_levels (void)
{
  uint32_t seed = 9;
  Picture  p = { 0 };
  float    depth[N];

  for (int i = 0; i < N; i++)
    {
      p.level[i] = (float) check_random (&seed, RANGE + 1);
      p.fixed[i] = 1;
    }
  solve (&p, depth);
  CHECK (!memcmp (depth, p.level, sizeof depth));
}

int
main (void)
{
  RUN (fixed_pixels_keep_their_levels);
  RUN (depth_is_what_relaxation_finds);
  RUN (one_level_is_met_exactly);
  RUN (an_edit_solves_what_it_touches);
  RUN (untouched_parts_are_not_solved);
  return DONE;
}
