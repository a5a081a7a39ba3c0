/* A system as rivals want it: unknowns only.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "rivals.h"
#include "base/base.h"

#include <stdlib.h>

#define NONE UINT32_MAX

/* Which pixels does a fixed one reach? */
static uint8_t *
find_reached (const System *s)
{
  uint32_t *parent  = celd_alloc (s->n, sizeof *parent);
  uint8_t  *reached = celd_alloc0 (s->n, 1);
  size_t    w = (size_t) s->width;

  if (!parent || !reached)
    must (CELD_NO_MEMORY);
  for (uint32_t p = 0; p < s->n; p++)
    parent[p] = p;
  for (uint32_t p = 0; p < s->n; p++)
    {
      if ((p + 1) % w && s->east[p] > 0)
        celd_join (parent, p, p + 1);
      if (p + w < s->n && s->south[p] > 0)
        celd_join (parent, p, p + (uint32_t) w);
    }
  for (uint32_t p = 0; p < s->n; p++)
    if (s->fixed[p])
      reached[celd_root (parent, p)] = 1;
  for (uint32_t p = 0; p < s->n; p++)
    reached[p] = reached[celd_root (parent, p)];
  celd_free (parent);
  return reached;
}

/* One edge between the pixels p and q. */
static void
add_edge (const System *s, Matrix *m, size_t p, size_t q, float weight, uint32_t *neighbour, float *to_neighbour)
{
  uint32_t i = m->unknown[p], j = m->unknown[q];

  if (!(weight > 0))
    return;
  if (i != NONE)
    m->diagonal[i] += (double) weight;
  if (j != NONE)
    m->diagonal[j] += (double) weight;
  if (i != NONE && j != NONE)
    {
      neighbour[i]    = j;
      to_neighbour[i] = weight;
    }
  else if (i != NONE)
    m->b[i] += (double) weight * (double) s->value[q];
  else if (j != NONE)
    m->b[j] += (double) weight * (double) s->value[p];
}

Matrix
matrix_of (const System *s)
{
  uint8_t *reached = find_reached (s);
  size_t   w = (size_t) s->width;
  Matrix   m = { .unknown = celd_alloc (s->n, sizeof *m.unknown), .pixel = celd_alloc (s->n, sizeof *m.pixel) };

  if (!m.unknown || !m.pixel)
    must (CELD_NO_MEMORY);
  for (size_t p = 0; p < s->n; p++)
    {
      m.unknown[p] = reached[p] && !s->fixed[p] ? (uint32_t) m.n : NONE;
      if (m.unknown[p] != NONE)
        m.pixel[m.n++] = p;
    }
  m.right    = celd_alloc (m.n, sizeof *m.right);
  m.below    = celd_alloc (m.n, sizeof *m.below);
  m.to_right = celd_alloc0 (m.n, sizeof *m.to_right);
  m.to_below = celd_alloc0 (m.n, sizeof *m.to_below);
  m.diagonal = celd_alloc0 (m.n, sizeof *m.diagonal);
  m.b        = celd_alloc0 (m.n, sizeof *m.b);
  if (!m.right || !m.below || !m.to_right || !m.to_below || !m.diagonal || !m.b)
    must (CELD_NO_MEMORY);
  for (size_t i = 0; i < m.n; i++)
    m.right[i] = m.below[i] = NONE;
  for (size_t p = 0; p < s->n; p++)
    {
      if ((p + 1) % w)
        add_edge (s, &m, p, p + 1, s->east[p], m.right, m.to_right);
      if (p + w < s->n)
        add_edge (s, &m, p, p + w, s->south[p], m.below, m.to_below);
    }
  celd_free (reached);
  return m;
}

void
matrix_clear (Matrix *m)
{
  celd_free (m->pixel);
  celd_free (m->unknown);
  celd_free (m->right);
  celd_free (m->below);
  celd_free (m->to_right);
  celd_free (m->to_below);
  celd_free (m->diagonal);
  celd_free (m->b);
  *m = (Matrix) { 0 };
}

void
matrix_residual (const Matrix *m, const double *x, double *r)
{
  for (size_t i = 0; i < m->n; i++)
    r[i] = m->b[i] - m->diagonal[i] * x[i];
  for (size_t i = 0; i < m->n; i++)
    {
      if (m->right[i] != NONE)
        {
          r[i] += (double) m->to_right[i] * x[m->right[i]];
          r[m->right[i]] += (double) m->to_right[i] * x[i];
        }
      if (m->below[i] != NONE)
        {
          r[i] += (double) m->to_below[i] * x[m->below[i]];
          r[m->below[i]] += (double) m->to_below[i] * x[i];
        }
    }
}
