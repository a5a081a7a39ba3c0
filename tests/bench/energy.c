/* The energy of a labelling, summed over pixels, independently of the solvers:
 *   E(c) = sum over neighbours p, q with c_p != c_q of V_pq  +  sum over soft seeds p with c_p != seed_p of their vote.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"
#include "image/image.h"
#include "segment/basins.h"
#include "solve/maxflow.h"

#include <stdlib.h>

Costs
costs_of (const CeldPlane *ink, float threshold)
{
  int                 w = ink->width, h = ink->height;
  size_t              n = (size_t) w * (size_t) h, p = 0;
  CeldSmoothnessCosts table;
  uint8_t            *paper = malloc (n);
  int32_t            *depth = malloc (n * sizeof *depth);
  Costs               costs = { calloc (n, sizeof *costs.east), calloc (n, sizeof *costs.south) };

  if (!paper || !depth || !costs.east || !costs.south)
    abort ();
  for (p = 0; p < n; p++)
    paper[p] = celd_is_paper (ink->data[p]);
  if (celd_distance (w, h, paper, NULL, depth) != CELD_OK)
    abort ();
  celd_smoothness_costs_new (w, h, threshold, &table);
  p = 0;
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++, p++)
      {
        size_t below = p + (size_t) w;

        if (x + 1 < w)
          costs.east[p] = celd_smoothness_cost (&table, ink->data[p], ink->data[p + 1], depth[p], depth[p + 1],
                                                y == 0 || y + 1 == h);
        if (y + 1 < h)
          costs.south[p] = celd_smoothness_cost (&table, ink->data[p], ink->data[below], depth[p], depth[below],
                                                 x == 0 || x + 1 == w);
      }
  free (paper);
  free (depth);
  return costs;
}

int64_t
energy_of (const Costs *costs, const Problem *m, const uint32_t *label, size_t *disobeyed)
{
  size_t  w = (size_t) m->width, n = w * (size_t) m->height;
  int64_t energy = 0;

  *disobeyed = 0;
  for (size_t p = 0; p < n; p++)
    {
      if (p % w + 1 < w && label[p] != label[p + 1])
        energy += costs->east[p];
      if (p + w < n && label[p] != label[p + w])
        energy += costs->south[p];
      if (!m->seed[p] || m->seed[p] == label[p])
        continue;
      if (m->vote[m->seed[p] - 1] == CELD_HARD)
        ++*disobeyed;
      else
        energy += m->vote[m->seed[p] - 1];
    }
  return energy;
}
