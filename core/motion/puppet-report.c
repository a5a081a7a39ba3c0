/* What an artist should know of a pose: where it is stretched and folded, and which handles hold no part.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/puppet.h"

#include <stdio.h>

#define MOST_STRETCH 2.0 /* of what is not worth a message; chosen */

/* The longest side of a cell, relative to its rest pose. */
static double
stretch_of (const CeldLattice *lattice, size_t cell)
{
  static const int side[4][2] = { { 0, 1 }, { 2, 3 }, { 0, 2 }, { 1, 3 } };
  double           most = 0;

  for (int s = 0; s < 4; s++)
    {
      const float *a = lattice->place + 2 * (size_t) lattice->corner[4 * cell + (size_t) side[s][0]];
      const float *b = lattice->place + 2 * (size_t) lattice->corner[4 * cell + (size_t) side[s][1]];

      most = fmax (most, hypot (a[0] - b[0], a[1] - b[1]) / lattice->side);
    }
  return most;
}

void
celd_pose_describe (const CeldLattice *lattice, CeldPoseReport *report)
{
  double least = 0;

  for (size_t c = 0; c < lattice->n_cells; c++)
    {
      const float *corner = lattice->rest + 2 * (size_t) lattice->corner[4 * c];
      double       x = (double) corner[0] + 0.5 * lattice->side, y = (double) corner[1] + 0.5 * lattice->side;
      double       area = (double) celd_cell_area (lattice, c), stretch = stretch_of (lattice, c);

      report->folded += area <= 0;
      if (area <= least)
        {
          least = area;
          report->folded_x = x;
          report->folded_y = y;
        }
      if (stretch > report->stretch)
        {
          report->stretch   = stretch;
          report->stretch_x = x;
          report->stretch_y = y;
        }
    }
}

void
celd_pose_worst (const CeldPoseReport *report, CeldPoseReport *worst)
{
  if (report->outside > worst->outside)
    {
      worst->outside   = report->outside;
      worst->outside_x = report->outside_x;
      worst->outside_y = report->outside_y;
    }
  if (report->folded > worst->folded)
    {
      worst->folded   = report->folded;
      worst->folded_x = report->folded_x;
      worst->folded_y = report->folded_y;
    }
  if (report->stretch > worst->stretch)
    {
      worst->stretch   = report->stretch;
      worst->stretch_x = report->stretch_x;
      worst->stretch_y = report->stretch_y;
    }
}

void
celd_pose_text (const CeldPoseReport *report, CeldTranslate translate, char *text, size_t size)
{
  size_t used = 0;

  if (size)
    text[0] = 0;
  if (report->outside == 1)
    used += (size_t) snprintf (text, size,
                               celd_in (translate, N_ ("1 handle lies outside all parts and holds the nearest part "
                                                       "instead: it is at %.0f,%.0f.\n")),
                               report->outside_x, report->outside_y);
  else if (report->outside)
    used += (size_t) snprintf (text, size,
                               celd_in (translate, N_ ("%zu handles lie outside all parts and hold the nearest part "
                                                       "instead: the first is at %.0f,%.0f.\n")),
                               report->outside, report->outside_x, report->outside_y);
  if (report->folded && used < size)
    used += (size_t) snprintf (text + used, size - used,
                               celd_in (translate, N_ ("The drawing is folded over in %zu squares of its lattice, most "
                                                       "around %.0f,%.0f: move the handles there less far, or lead the "
                                                       "part round with more of them.\n")),
                               report->folded, report->folded_x, report->folded_y);
  if (report->stretch > MOST_STRETCH && used < size)
    used += (size_t) snprintf (text + used, size - used,
                               celd_in (translate, N_ ("The part around %.0f,%.0f is stretched to %.1f times its "
                                                       "length: move the handles that pull at it less far apart, or "
                                                       "leave one out.\n")),
                               report->stretch_x, report->stretch_y, report->stretch);
  if (used && used < size)
    text[used - 1] = 0;
}
