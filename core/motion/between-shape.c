/* The lattices between two keys, as rigid as possible [ACOL00].
 *
 * Each cell of the first key's lattice turns by a share of its turn, and is stretched by a share of its stretch.
 * Places of vertices make the sides of all cells so in the sense of least squares; vertices of two parts that lie
 * together in both keys are held together, and what turns least leads the way of all that hangs together.  So an arm
 * swings round its shoulder, and keeps its length.  The second key's lattice is carried by the first one's cells, so
 * that both are in one place at any time.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/inbetween.h"

#define JOINT_WEIGHT  2.f   /* of vertices that lie together in both keys, against a side of a cell; chosen */
#define LEAST_WEIGHT  0.01f /* of a joint that counts; chosen */
#define LEAD          1e-3f /* weight of the way of a cell's vertex that does not turn; chosen */
#define LEAD_TURN     0.2f  /* radians: with so much turn it is half of that; chosen */
#define SMOOTH_SWEEPS 4     /* chosen */
#define SMOOTH_PULL   0.5f  /* of where a vertex is carried, against a cell; chosen */
#define MOST_STEPS    1000  /* of conjugate gradients; chosen */
#define RESIDUAL      1e-4  /* pixels: the mean of the residuals in the end; chosen */

/* Two vertices that hold together, and how far the second is from the first one in the second key. */
typedef struct { uint32_t vertex[2]; float weight, apart[2]; } Joint;

struct CeldShaping
{
  CeldAffine *motion;          /* of each cell: from its rest pose to its end */
  CeldAffine *carry;           /* of each cell: from its end to where it is now */
  float      *turn;            /* of each cell, radians; neighbours turn the same way round */
  bool       *active;          /* of each cell: are the ends of its vertices known? */
  float      *lead;            /* weight of each vertex */
  Joint      *joint;
  size_t      n_joints;
  float      *missed;          /* of each vertex: from where least squares put it in the end to its end */
  double     *work;            /* 4 vectors of two numbers for each vertex */
  CeldPull   *pull;            /* of each vertex of the second key's lattice */
  float      *scratch;         /* 3 numbers for each of these */
};

/* ------------------------------------------------------------------ turns */

/* Gives neighbours turns of the same way round, beginning with one cell of each connected part. */
static CeldStatus
unwrap_turns (const CeldLattice *lattice, CeldShaping *s)
{
  float *near = celd_alloc (lattice->n_vertices, sizeof *near); /* the turn of a cell at each vertex */
  bool  *done = celd_alloc0 (lattice->n_cells, sizeof *done);
  bool   good = near && done;

  for (size_t v = 0; v < lattice->n_vertices && good; v++)
    near[v] = NAN;
  for (size_t seed = 0; seed < lattice->n_cells && good; seed++)
    for (bool changed = !done[seed], first = true; changed; first = false)
      {
        changed = false;
        for (size_t c = seed; c < lattice->n_cells; c++)
          {
            const uint32_t *corner = lattice->corner + 4 * c;
            int             k = 0;

            while (k < 4 && isnan (near[corner[k]]))
              k++;
            if (done[c] || (k == 4 && !(first && c == seed)))
              continue;
            if (k < 4)
              s->turn[c] = near[corner[k]] + remainderf (s->turn[c] - near[corner[k]], 2 * (float) CELD_PI);
            for (k = 0; k < 4; k++)
              near[corner[k]] = s->turn[c];
            done[c] = changed = true;
          }
      }
  celd_free (near);
  celd_free (done);
  return good ? CELD_OK : CELD_NO_MEMORY;
}

/* Takes full turns off pieces that turn by more than half a turn. */
static CeldStatus
centre_turns (const CeldLattice *lattice, CeldShaping *s)
{
  double *sum = celd_alloc0 (lattice->n_pieces, 2 * sizeof *sum);

  if (!sum)
    return CELD_NO_MEMORY;
  for (size_t c = 0; c < lattice->n_cells; c++)
    if (s->active[c])
      {
        sum[2 * lattice->piece[c]] += (double) s->turn[c];
        sum[2 * lattice->piece[c] + 1]++;
      }
  for (size_t c = 0; c < lattice->n_cells; c++)
    if (s->active[c])
      {
        double mean = sum[2 * lattice->piece[c]] / sum[2 * lattice->piece[c] + 1];

        s->turn[c] += (float) (remainder (mean, 2 * CELD_PI) - mean);
      }
  celd_free (sum);
  return CELD_OK;
}

static CeldStatus
find_turns (const CeldInbetween *between, CeldShaping *s)
{
  const CeldLattice *lattice = &between->key[0]->lattice;
  CeldStatus         status;

  for (size_t c = 0; c < lattice->n_cells; c++)
    {
      const float *m = s->motion[c].matrix;

      s->active[c] = true;
      for (int k = 0; k < 4; k++)
        s->active[c] &= between->known[0][lattice->corner[4 * c + (size_t) k]];
      s->motion[c] = celd_cell_motion (lattice, c, lattice->rest, between->end[0]);
      s->turn[c]   = atan2f (m[2] - m[1], m[0] + m[3]);
    }
  status = unwrap_turns (lattice, s);
  return status == CELD_OK ? centre_turns (lattice, s) : status;
}

/* ------------------------------------------------------------------ what holds together */

/* Adds a joint if two vertices of different pieces lie together in the second key, too. */
static CeldStatus
add_joint (const CeldInbetween *between, const uint32_t *piece, uint32_t a, uint32_t b, CeldShaping *s,
           size_t *capacity)
{
  const float *p = between->end[0] + 2 * (size_t) a, *q = between->end[0] + 2 * (size_t) b;
  float        x = (q[0] - p[0]) / (float) between->key[0]->lattice.side;
  float        y = (q[1] - p[1]) / (float) between->key[0]->lattice.side, weight = JOINT_WEIGHT * expf (-x * x - y * y);

  if (piece[a] == piece[b] || !between->known[0][a] || !between->known[0][b] || weight < LEAST_WEIGHT)
    return CELD_OK;
  return celd_append (s->joint, s->n_joints, *capacity, (Joint) { { a, b }, weight, { q[0] - p[0], q[1] - p[1] } });
}

static CeldStatus
find_joints (const CeldInbetween *between, CeldShaping *s)
{
  const CeldRestVertex *rest = between->rest;
  size_t                capacity = 0;
  CeldStatus            status = CELD_OK;

  for (size_t i = 0, end; i < between->n_rest; i = end)
    {
      for (end = i; end < between->n_rest && rest[end].x == rest[i].x && rest[end].y == rest[i].y;)
        end++;
      for (size_t a = i; a < end; a++)
        for (size_t b = a + 1; b < end && status == CELD_OK; b++)
          status = add_joint (between, between->key[0]->piece, rest[a].vertex, rest[b].vertex, s, &capacity);
    }
  return status;
}

/* What turns less leads more. */
static void
find_leads (const CeldInbetween *between, CeldShaping *s)
{
  const CeldLattice *lattice = &between->key[0]->lattice;

  for (size_t c = 0; c < lattice->n_cells; c++)
    for (size_t k = 0; k < 4 && s->active[c]; k++)
      {
        float turn = s->turn[c] / LEAD_TURN;

        s->lead[lattice->corner[4 * c + k]] += LEAD / (1 + turn * turn);
      }
}

/* ------------------------------------------------------------------ least squares */

static const int sides[4][2] = { { 0, 1 }, { 2, 3 }, { 0, 2 }, { 1, 3 } };

/* out = A x. */
static void
multiply (const CeldInbetween *between, const double *x, double *out)
{
  const CeldLattice *lattice = &between->key[0]->lattice;
  const CeldShaping *s = between->shaping;

  for (size_t i = 0; i < 2 * lattice->n_vertices; i++)
    out[i] = (double) s->lead[i / 2] * x[i];
  for (size_t c = 0; c < lattice->n_cells; c++)
    for (int k = 0; k < 4 && s->active[c]; k++)
      for (size_t i = 0; i < 2; i++)
        {
          size_t a = 2 * (size_t) lattice->corner[4 * c + (size_t) sides[k][0]] + i;
          size_t b = 2 * (size_t) lattice->corner[4 * c + (size_t) sides[k][1]] + i;

          out[a] += x[a] - x[b];
          out[b] += x[b] - x[a];
        }
  for (size_t j = 0; j < s->n_joints; j++)
    for (size_t i = 0; i < 2; i++)
      {
        size_t a = 2 * (size_t) s->joint[j].vertex[0] + i, b = 2 * (size_t) s->joint[j].vertex[1] + i;

        out[a] += (double) s->joint[j].weight * (x[a] - x[b]);
        out[b] += (double) s->joint[j].weight * (x[b] - x[a]);
      }
}

/* The right-hand side for a share of the way: sides of cells as they are to be, offsets of joints, the straight way. */
static void
fill_right (const CeldInbetween *between, float t, double *right)
{
  const CeldLattice *lattice = &between->key[0]->lattice;
  const CeldShaping *s = between->shaping;

  for (size_t i = 0; i < 2 * lattice->n_vertices; i++)
    right[i] = (double) (s->lead[i / 2] * ((1 - t) * lattice->rest[i] + t * between->end[0][i]));
  for (size_t c = 0; c < lattice->n_cells; c++)
    {
      const float *m = s->motion[c].matrix;
      float        full = s->turn[c], u = cosf (full), w = sinf (full);
      float        cosine = cosf (t * full), sine = sinf (t * full);
      float        xx = 1 - t + t * (u * m[0] + w * m[2]), xy = t * (u * m[1] + w * m[3]);
      float        yx = t * (u * m[2] - w * m[0]), yy = 1 - t + t * (u * m[3] - w * m[1]);

      for (int k = 0; k < 4 && s->active[c]; k++)
        {
          size_t a = 2 * (size_t) lattice->corner[4 * c + (size_t) sides[k][0]];
          size_t b = 2 * (size_t) lattice->corner[4 * c + (size_t) sides[k][1]];
          float  x = lattice->rest[b] - lattice->rest[a], y = lattice->rest[b + 1] - lattice->rest[a + 1];
          float  by[2] = { xx * x + xy * y, yx * x + yy * y };
          double side[2] = { (double) (cosine * by[0] - sine * by[1]), (double) (sine * by[0] + cosine * by[1]) };

          for (size_t i = 0; i < 2; i++)
            {
              right[a + i] -= side[i];
              right[b + i] += side[i];
            }
        }
    }
  for (size_t j = 0; j < s->n_joints; j++)
    for (size_t i = 0; i < 2; i++)
      {
        double pull = (double) (s->joint[j].weight * t * s->joint[j].apart[i]);

        right[2 * (size_t) s->joint[j].vertex[0] + i] -= pull;
        right[2 * (size_t) s->joint[j].vertex[1] + i] += pull;
      }
}

/* Finds the places for a share of the way by conjugate gradients, starting from the straight way; x is the result. */
static const double *
solve (const CeldInbetween *between, float t)
{
  const CeldLattice *lattice = &between->key[0]->lattice;
  size_t             n = 2 * lattice->n_vertices;
  double            *x = between->shaping->work, *r = x + n, *d = r + n, *q = d + n, square;

  for (size_t i = 0; i < n; i++)
    x[i] = (double) ((1 - t) * lattice->rest[i] + t * between->end[0][i]);
  fill_right (between, t, r);
  multiply (between, x, q);
  for (size_t i = 0; i < n; i++)
    d[i] = r[i] -= q[i];
  square = celd_dot (r, r, n);
  for (int step = 0; step < MOST_STEPS && square > RESIDUAL * RESIDUAL * LEAD * LEAD * (double) n; step++)
    {
      double curve, length, next;

      multiply (between, d, q);
      curve = celd_dot (d, q, n);
      if (!(curve > 0))
        break;
      length = square / curve;
      for (size_t i = 0; i < n; i++)
        {
          x[i] += length * d[i];
          r[i] -= length * q[i];
        }
      next = celd_dot (r, r, n);
      for (size_t i = 0; i < n; i++)
        d[i] = r[i] + next / square * d[i];
      square = next;
    }
  return x;
}

/* ------------------------------------------------------------------ places */

/* Makes the cells of the second key's lattice rigid, without moving them far. */
static void
smooth_second (CeldInbetween *between)
{
  CeldLattice *lattice = &between->key[1]->lattice;
  CeldPull    *pull = between->shaping->pull;

  for (size_t v = 0; v < lattice->n_vertices; v++)
    pull[v] = (CeldPull) { lattice->place[2 * v], lattice->place[2 * v + 1], SMOOTH_PULL };
  celd_lattice_relax (lattice, SMOOTH_SWEEPS, pull, 0, between->shaping->scratch);
}

void
celd_between_shape (CeldInbetween *between, double t)
{
  CeldLattice  *first = &between->key[0]->lattice, *second = &between->key[1]->lattice;
  CeldShaping  *s = between->shaping;
  const double *x = solve (between, (float) t);

  for (size_t i = 0; i < 2 * first->n_vertices; i++)
    first->place[i] = between->known[0][i / 2] ? (float) (x[i] + t * (double) s->missed[i]) : first->rest[i];
  for (size_t c = 0; c < first->n_cells; c++)
    s->carry[c] = celd_cell_motion (first, c, between->end[0], first->place);
  for (size_t v = 0; v < second->n_vertices; v++)
    if (between->known[1][v])
      celd_carry (&between->carrier[v], s->carry, second->rest[2 * v], second->rest[2 * v + 1],
                  second->place + 2 * v);
  smooth_second (between);
  celd_parts_follow (between, 0, (float) t);
  celd_parts_follow (between, 1, (float) (1 - t));
}

/* ------------------------------------------------------------------ */

CeldStatus
celd_shaping_new (CeldInbetween *between)
{
  const CeldLattice *lattice = &between->key[0]->lattice;
  CeldShaping       *s = between->shaping = celd_alloc0 (1, sizeof *s);
  const double      *x;
  CeldStatus         status;

  if (!s)
    return CELD_NO_MEMORY;
  s->motion = celd_alloc (lattice->n_cells, sizeof *s->motion);
  s->carry  = celd_alloc (lattice->n_cells, sizeof *s->carry);
  s->turn   = celd_alloc (lattice->n_cells, sizeof *s->turn);
  s->active = celd_alloc (lattice->n_cells, sizeof *s->active);
  s->lead   = celd_alloc0 (lattice->n_vertices, sizeof *s->lead);
  s->missed = celd_alloc0 (lattice->n_vertices, 2 * sizeof *s->missed);
  s->work   = celd_alloc (lattice->n_vertices, 8 * sizeof *s->work);
  s->pull   = celd_alloc (between->key[1]->lattice.n_vertices, sizeof *s->pull);
  s->scratch = celd_alloc (between->key[1]->lattice.n_vertices, 3 * sizeof *s->scratch);
  if (!s->pull || !s->scratch || !s->motion || !s->carry || !s->turn || !s->active || !s->lead || !s->missed ||
      !s->work)
    return CELD_NO_MEMORY;
  status = find_turns (between, s);
  if (status == CELD_OK)
    status = find_joints (between, s);
  if (status != CELD_OK)
    return status;
  find_leads (between, s);
  x = solve (between, 1);
  for (size_t i = 0; i < 2 * lattice->n_vertices; i++)
    s->missed[i] = between->end[0][i] - (float) x[i];
  return CELD_OK;
}

void
celd_shaping_free (CeldShaping *s)
{
  if (!s)
    return;
  celd_free (s->motion);
  celd_free (s->carry);
  celd_free (s->turn);
  celd_free (s->active);
  celd_free (s->lead);
  celd_free (s->joint);
  celd_free (s->missed);
  celd_free (s->work);
  celd_free (s->pull);
  celd_free (s->scratch);
  celd_free (s);
}
