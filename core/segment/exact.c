/* LazyBrush [SDC09b] (section 3.2) on all pixels: the energy of multiway.c with the costs of costs.c.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/canvas.h"
#include "segment/costs.h"
#include "solve/maxflow.h"

#include <string.h>

/* ------------------------------------------------------------------ the energy */

/* Squared distances to paper. */
static CeldStatus
measure_depth (const CeldPlane *ink, const CeldHost *host, int32_t **depth)
{
  size_t     w = (size_t) ink->width, n = w * (size_t) ink->height;
  uint8_t   *paper = celd_alloc (n, 1);
  CeldStatus status = CELD_NO_MEMORY;

  *depth = celd_alloc (n, sizeof **depth);
  if (paper && *depth)
    {
      for (size_t p = 0; p < n; p++)
        paper[p] = celd_is_paper (CELD_AT (ink, p % w, p / w));
      status = celd_distance (ink->width, ink->height, paper, host, *depth);
    }
  celd_free (paper);
  return status;
}

/* V_pq of all edges, as celd_multiway wants them. */
static CeldStatus
weigh_edges (const CeldCanvas *canvas, const CeldHost *host, int32_t *east, int32_t *south)
{
  const CeldPlane *ink = canvas->ink;
  const CeldCosts *costs = &canvas->basins->costs;
  int              w = ink->width, h = ink->height;
  int32_t         *depth = NULL;
  size_t           p = 0;
  CeldStatus       status = measure_depth (ink, host, &depth);

  for (int y = 0; y < h && status == CELD_OK; y++)
    for (int x = 0; x < w; x++, p++)
      {
        float here = CELD_AT (ink, x, y);

        east[p] = south[p] = 0;
        if (x + 1 < w)
          east[p] = celd_cost (costs, here, CELD_AT (ink, x + 1, y), depth[p], depth[p + 1], y == 0 || y + 1 == h);
        if (y + 1 < h)
          south[p] = celd_cost (costs, here, CELD_AT (ink, x, y + 1), depth[p], depth[p + (size_t) w],
                                x == 0 || x + 1 == w);
      }
  celd_free (depth);
  return status;
}

/* ------------------------------------------------------------------ the cuts */

CeldStatus
celd_exact_solve (const CeldCanvas *canvas, const CeldHost *host, CeldLabels *labels)
{
  size_t     n = (size_t) labels->width * (size_t) labels->height, n_labels = canvas->palette.n;
  int32_t   *east = celd_alloc (n, sizeof *east), *south = celd_alloc (n, sizeof *south);
  int32_t   *vote = celd_alloc (n_labels, sizeof *vote);
  uint32_t  *order = celd_alloc (n_labels, sizeof *order);
  CeldLabels seeds = { 0 };
  CeldHostPart   part[2];
  CeldHost   weigh = celd_host_part (&part[0], host, 0, 0), cut = celd_host_part (&part[1], host, 0.1, 1);
  CeldStatus status = east && south && vote && order ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_labels_new (labels->width, labels->height, &seeds);
  if (status == CELD_OK)
    status = weigh_edges (canvas, &weigh, east, south);
  if (status == CELD_OK)
    status = celd_canvas_order (canvas, order);
  if (status == CELD_OK)
    {
      CeldMultiway m = { labels->width, labels->height, east, south, seeds.data, vote, order, n_labels };

      celd_seed_rows_write (&canvas->seeds, &seeds);
      for (size_t k = 0; k < n_labels; k++)
        vote[k] = celd_canvas_vote (canvas, (uint32_t) k + 1);
      memset (labels->data, 0, n * sizeof *labels->data);
      status = celd_multiway (&m, &cut, labels->data);
    }
  celd_free (east);
  celd_free (south);
  celd_free (vote);
  celd_free (order);
  celd_free (seeds.data);
  return status;
}
