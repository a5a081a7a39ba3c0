/* The error of a mesh: the least one for which it does not have too many vertices.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief/relief.h"

/* The error grows by this factor while there are too many vertices, until it is more than that ratio times the requested
 * one; chosen. */
#define ERROR_GROWTH 1.5
#define MAX_RATIO    1e4

CeldStatus
celd_mesh_least_error (const CeldSettings *settings, const CeldHost *host,
                       CeldStatus (*attempt) (void *data, double error, const CeldHost *host, size_t *n), void *data)
{
  double       wanted = (double) settings->mesh_error, error = wanted;
  CeldHostPart part;
  CeldHost     end = celd_host_part (&part, host, 1, 1);
  size_t       n = 0;
  CeldStatus   status = attempt (data, error, host, &n);

  while (status == CELD_OK && (double) n > (double) settings->most_vertices)
    {
      if (error > MAX_RATIO * wanted)
        return CELD_BAD_VALUE;
      error *= ERROR_GROWTH;
      status = attempt (data, error, &end, &n);
    }
  return status;
}
