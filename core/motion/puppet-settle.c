/* Makes a puppet as rigid as possible between its handles [WXXC08].
 *
 * Sweeps of the lattice make cells rigid, and after each one the cells of handles are moved to where these are to be.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/puppet.h"

#include <float.h>

#define POSE_SWEEPS    300    /* chosen */
#define PROGRESS_EVERY 16     /* sweeps; chosen */
#define AT_REST        0.002f /* pixels: how far a sweep moves any vertex at most in the end; chosen */
#define TIE_WEIGHT     1.f    /* of the pull of a cell; chosen */

/* Moves the cell of each handle so that it takes its place to where it is to be. */
static void
put_handles (CeldPuppetPose *p)
{
  CeldLattice *lattice = &p->puppet->lattice;

  for (size_t i = 0; i < p->n; i++)
    {
      const CeldHeld *h = &p->held[i];
      float       at[2];

      celd_cell_map (lattice, h->cell, h->x, h->y, at);
      for (size_t k = 0; k < 4; k++)
        {
          float *place = lattice->place + 2 * (size_t) lattice->corner[4 * h->cell + k];

          place[0] += h->to_x - at[0];
          place[1] += h->to_y - at[1];
        }
    }
}

/* Moves vertices further in the direction of their last motion, by this share of it. */
static void
carry_on (CeldPuppetPose *p, float share)
{
  float *place = p->puppet->lattice.place;

  for (size_t i = 0; i < 2 * p->puppet->lattice.n_vertices; i++)
    {
      float at = place[i];

      place[i]     = p->start[i] = at + share * (at - p->before[i]);
      p->before[i] = at;
    }
}

/* Takes the mean of a sweep's start and end.  Vertices that are tied to several others would swing past each other, and
 * momentum make that worse from sweep to sweep. */
static void
damp (CeldPuppetPose *p)
{
  float *place = p->puppet->lattice.place;

  for (size_t i = 0; i < 2 * p->puppet->lattice.n_vertices; i++)
    place[i] = 0.5f * (place[i] + p->start[i]);
}

/* The longest motion since carry_on; *back says whether the sweep has turned the motion round. */
static float
measure_motion (const CeldPuppetPose *p, bool *back)
{
  const float *place = p->puppet->lattice.place;
  float        most = 0;
  double       sum = 0;

  for (size_t i = 0; i < 2 * p->puppet->lattice.n_vertices; i++)
    {
      float moved = place[i] - p->before[i];

      most = fmaxf (most, fabsf (moved));
      sum += (double) (p->start[i] - place[i]) * (double) moved;
    }
  *back = sum > 0;
  return most;
}

/* Sweeps until the lattice is at rest.  They are accelerated by momentum [Nesterov 1983], which begins anew whenever it
 * goes against them [O'Donoghue and Candes 2015]: what took two thousand sweeps takes a hundred. */
CeldStatus
celd_pose_settle (CeldPuppetPose *p, const CeldHost *host)
{
  CeldLattice *lattice = &p->puppet->lattice;
  float        moved = FLT_MAX;
  int          going = 0;
  CeldStatus   status = CELD_OK;

  put_handles (p);
  memcpy (p->before, lattice->place, 2 * lattice->n_vertices * sizeof *lattice->place);
  for (int sweep = 0; sweep < POSE_SWEEPS && moved > AT_REST && status == CELD_OK; sweep++)
    {
      bool back;

      carry_on (p, (float) going / (float) (going + 3));
      celd_lattice_relax (lattice, 1, NULL, TIE_WEIGHT, p->scratch);
      if (lattice->n_seams)
        damp (p);
      put_handles (p);
      moved  = measure_motion (p, &back);
      going  = back ? 0 : going + 1;
      status = sweep % PROGRESS_EVERY ? CELD_OK : celd_progress (host, (double) sweep / POSE_SWEEPS);
    }
  return status;
}
