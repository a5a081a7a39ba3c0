/* Failing allocations and cancelling in the solvers, each with a problem of its own.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "faults.h"
#include "solve/partition.h"
#include "solve/quadratic.h"

/* A grid of 8 x 6 nodes with a different label at each corner. */
static size_t
draw_graph (CeldLink *link, CeldVote *vote)
{
  size_t n_links = 0;

  for (uint32_t p = 0; p < 48; p++)
    {
      vote[p] = (CeldVote) { p, 1 + (p % 8 > 3) + 2 * (p > 23), 1 + p * 5 % 7 + 30 * (p % 7 == 0) };
      if (p % 5 == 0)
        vote[p].label = 1 + p % 4;
      if (p % 8 < 7)
        link[n_links++] = (CeldLink) { p, p + 1, 2 + p * 7 % 11 };
      if (p < 40)
        link[n_links++] = (CeldLink) { p, p + 8, 2 + p * 3 % 13 };
    }
  return n_links;
}

static CeldStatus
flow_step (const CeldHost *host, Results *r)
{
  CeldLink link[96];
  CeldVote vote[48];
  size_t   n_links = draw_graph (link, vote);
  int64_t  terminal[48];

  for (size_t p = 0; p < 48; p++)
    terminal[p] = vote[p].label == 1 ? vote[p].cost : -vote[p].cost;
  return celd_flow (48, link, n_links, terminal, host, r->pixels->paint, NULL);
}

static CeldStatus
partition_step (const CeldHost *host, Results *r)
{
  const uint32_t order[4] = { 3, 1, 4, 2 }, fixed[48] = { [20] = 2, [27] = 2 };
  CeldLink       link[96];
  CeldVote       vote[48];
  size_t         n_links = draw_graph (link, vote);
  CeldPartition  problem = { 48, link, n_links, vote, 48, fixed, order, 4 };

  return celd_partition (&problem, host, r->pixels->labels, NULL, NULL);
}

/* Two springs in a row, with gaps longer than at rest, and a free node in front. */
static CeldStatus
quadratic_step (const CeldHost *host, Results *r)
{
  const double         k[16] = { 2, -2, 0, 0, -2, 3, -1, 0, 0, -1, 1, 0, 0, 0, 0, 0 };
  const CeldInequality one[3] = { { 0, 1, 1 }, { 1, 2, 1 }, { 3, 0, 1 } };
  double               u[4] = { 0 };
  CeldCertificate      certificate;
  CeldStatus           status = celd_quadratic (4, k, 3, one, u, NULL, &certificate);

  (void) host;
  for (int i = 0; status == CELD_OK && i < 4; i++)
    r->pixels->plane[i] = (float) u[i];
  return status;
}

const Step solver_steps[] = {
  { "flow", flow_step, NULL, true },
  { "partition", partition_step, NULL, true },
  { "quadratic", quadratic_step, NULL, false },
  { NULL, NULL, NULL, false },
};
