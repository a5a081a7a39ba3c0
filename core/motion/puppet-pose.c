/* Poses of a puppet, as rigid as possible between its handles [WXXC08; section 5 of the paper].
 *
 *   1. what each handle holds, and which pieces go with which
 *   2. a first guess of where everything goes (puppet-guess.c)
 *   3. cells made rigid (puppet-settle.c)
 *   4. depth
 *   5. what the artist should know of it (puppet-report.c)
 *
 * Every pose starts from rest.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/puppet.h"

#include <float.h>

#define MOST_NUMBER 1e6 /* of a handle; chosen */

/* ------------------------------------------------------------------ what handles hold */

/* Finds the pixel nearest to (x,y) whose front layer moves.  False if there is none. */
static bool
nearest_part (const CeldPuppet *puppet, double x, double y, int *px, int *py)
{
  double least = DBL_MAX;

  for (int v = 0; v < puppet->height; v++)
    for (int u = 0; u < puppet->width; u++)
      {
        double dx = u + 0.5 - x, dy = v + 0.5 - y, d = dx * dx + dy * dy;

        if (d < least && celd_puppet_front_cell (puppet, u, v))
          {
            least = d;
            *px   = u;
            *py   = v;
          }
      }
  return least < DBL_MAX;
}

/* Finds what a handle holds, moving it as a whole if it lies outside all parts. */
static bool
hold (const CeldPuppet *puppet, const CeldHandle *handle, CeldHeld *held, CeldPoseReport *report)
{
  int    x = (int) floor (handle->x), y = (int) floor (handle->y);
  double dx = 0, dy = 0;

  if (x < 0 || y < 0 || x >= puppet->width || y >= puppet->height || !celd_puppet_front_cell (puppet, x, y))
    {
      if (!nearest_part (puppet, handle->x, handle->y, &x, &y))
        return false;
      dx = x + 0.5 - handle->x;
      dy = y + 0.5 - handle->y;
      if (!report->outside++)
        {
          report->outside_x = handle->x;
          report->outside_y = handle->y;
        }
    }
  *held = (CeldHeld) { celd_puppet_front_cell (puppet, x, y) - 1, (float) (handle->x + dx), (float) (handle->y + dy),
                       (float) (handle->to_x + dx), (float) (handle->to_y + dy), (float) handle->depth };
  return true;
}

/* Lets pieces without a handle go with others, longer contacts first: a tie holds unless handles hold what has come to
 * hang on either side. */
static CeldStatus
choose_ties (CeldPuppetPose *p)
{
  const CeldPuppet *puppet = p->puppet;
  CeldLattice      *lattice = &p->puppet->lattice;
  uint32_t         *set = celd_alloc (lattice->n_pieces, sizeof *set);
  bool              holds = false;

  if (!set)
    return CELD_NO_MEMORY;
  celd_roots (set, lattice->n_pieces);
  lattice->n_seams = 0;
  for (size_t i = 0; i < puppet->n_ties; i++)
    {
      const CeldPuppetTie *tie = &puppet->tie[i];

      if (!i || tie->contact != tie[-1].contact)
        {
          uint32_t a = celd_root (set, puppet->piece[tie->vertex[0]]);
          uint32_t b = celd_root (set, puppet->piece[tie->vertex[1]]);

          holds = !p->holds[a] || !p->holds[b];
          if (holds)
            {
              celd_join (set, a, b);
              p->holds[celd_root (set, a)] = p->holds[a] || p->holds[b];
            }
        }
      if (holds)
        memcpy (lattice->seam + 2 * lattice->n_seams++, tie->vertex, sizeof tie->vertex);
    }
  celd_free (set);
  return CELD_OK;
}

/* ------------------------------------------------------------------ the pose */

static bool
is_usable (const CeldHandle *h)
{
  return fabs (h->x) <= MOST_NUMBER && fabs (h->y) <= MOST_NUMBER && fabs (h->to_x) <= MOST_NUMBER &&
         fabs (h->to_y) <= MOST_NUMBER && fabs (h->depth) <= MOST_NUMBER;
}

static CeldStatus
pose (CeldPuppetPose *p, const CeldHost *host)
{
  CeldStatus status;

  for (size_t i = 0; i < p->n; i++)
    p->holds[p->puppet->lattice.piece[p->held[i].cell]] = true;
  status = choose_ties (p);
  if (status != CELD_OK)
    return status;
  celd_pose_guess (p);
  status = celd_pose_settle (p, host);
  if (status == CELD_OK)
    celd_pose_move_forward (p);
  return status;
}

CeldStatus
celd_puppet_pose (CeldPuppet *puppet, const CeldHandle *handle, size_t n, const CeldHost *host, CeldPoseReport *report)
{
  CeldLattice   *lattice = &puppet->lattice;
  CeldPoseReport found = { 0 };
  CeldPuppetPose p = { .puppet = puppet };
  CeldStatus     status = CELD_OK;

  for (size_t i = 0; i < n; i++)
    if (!is_usable (&handle[i]))
      return CELD_BAD_VALUE;
  p.held     = celd_alloc (n, sizeof *p.held);
  p.holds    = celd_alloc0 (lattice->n_pieces, sizeof *p.holds);
  p.distance = n <= SIZE_MAX / (lattice->n_vertices + 1) ? celd_alloc (n * lattice->n_vertices, sizeof *p.distance)
                                                          : NULL;
  p.scratch  = celd_alloc (lattice->n_vertices, 3 * sizeof *p.scratch);
  p.before   = celd_alloc (lattice->n_vertices, 2 * sizeof *p.before);
  p.start    = celd_alloc (lattice->n_vertices, 2 * sizeof *p.start);
  if (!p.held || !p.holds || !p.distance || !p.scratch || !p.before || !p.start)
    status = CELD_NO_MEMORY;
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    p.n += hold (puppet, &handle[i], &p.held[p.n], &found);
  if (status == CELD_OK)
    status = pose (&p, host);
  if (status == CELD_OK)
    celd_pose_describe (lattice, &found);
  if (status == CELD_OK && report)
    *report = found;
  celd_free (p.held);
  celd_free (p.holds);
  celd_free (p.distance);
  celd_free (p.scratch);
  celd_free (p.before);
  celd_free (p.start);
  return status;
}
