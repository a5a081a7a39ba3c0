/* The stiffness matrix: energies of pairs of bases, which make the program one on nodes instead of pixels.
 *
 * With d = sum of u_k h_k the energy of eq. (2) is 1/2 u'Ku, K_kl = h_k' L h_l.  K is summed over the edges (Ritz), not
 * over the flux at the nodes: then it is exactly the energy of the bases as they were solved, and their error raises
 * the result only to second order.  Row 1, whose basis is not stored, follows from the others, as all bases add up to
 * 1.
 *
 * Cost: for each edge the square of the number of bases, in blocks of CELD_LANES x CELD_LANES; a group of bases that is
 * constant along a piece of a row costs nothing there.  Sums are by fixed bands of rows, so the result does not depend
 * on the number of threads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "solve/laplace.h"

#define BANDS  8   /* of rows */
#define PIECE  64  /* pixels of a row that are processed at once */
#define SQUARE (CELD_LANES * CELD_LANES)

typedef struct
{
  const CeldHarmonicBases *bases;
  double                  *sum;     /* of each band: its n_groups x n_groups blocks of SQUARE */
  double                  *work;    /* of each band: differences of a piece, plain and weighted, of each group */
  bool                    *steep;   /* of each band and group: whether it is not constant along the piece */
} StiffnessSums;

/* block_ij += sum over edges of a_i b_j. */
CELD_CLONES static void
add_products (int n, const double *restrict a, const double *restrict b, double *restrict block)
{
  for (int i = 0; i < CELD_LANES; i += 4)
    {
      double s[4][CELD_LANES] = { { 0 } };

      for (int e = 0; e < n; e++)
        for (int k = 0; k < 4; k++)
          for (int j = 0; j < CELD_LANES; j++)
            s[k][j] += a[e * CELD_LANES + i + k] * b[e * CELD_LANES + j];
      for (int k = 0; k < 4; k++)
        for (int j = 0; j < CELD_LANES; j++)
          block[(i + k) * CELD_LANES + j] += s[k][j];
    }
}

/* Differences of the bases of a group over n edges to the pixels `next` further on; returns whether any is not 0. */
CELD_CLONES static bool
take_differences (int n, size_t next, const float *restrict h, const float *restrict weight, double *restrict plain,
                  double *restrict weighted)
{
  double any = 0;

  for (int e = 0; e < n; e++)
    for (int k = 0; k < CELD_LANES; k++)
      {
        size_t i = (size_t) e * CELD_LANES + (size_t) k;
        double d = (double) h[i + next * CELD_LANES] - (double) h[i];

        plain[i]    = d;
        weighted[i] = d * (double) weight[e];
        any        += d * d;
      }
  return any > 0;
}

/* Adds the edges of a piece of a row in one direction. */
static void
add_piece (StiffnessSums *s, int band, size_t p, int n, size_t next, const float *weight)
{
  const CeldHarmonicBases *b      = s->bases;
  size_t                   groups = b->n_groups, piece = PIECE * CELD_LANES;
  double                  *work = s->work + (size_t) band * groups * 2 * piece;
  double                  *sum = s->sum + (size_t) band * groups * groups * SQUARE;
  bool                    *steep = s->steep + (size_t) band * groups;

  for (size_t g = 0; g < groups; g++)
    {
      double *plain = work + g * 2 * piece;

      steep[g] = take_differences (n, next, b->group[g] + p * CELD_LANES, weight + p, plain, plain + piece);
      for (size_t f = 0; f <= g && steep[g]; f++)
        if (steep[f])
          add_products (n, plain, work + f * 2 * piece + piece, sum + (g * groups + f) * SQUARE);
    }
}

static void
add_band (void *data, int band)
{
  StiffnessSums           *s = data;
  const CeldHarmonicBases *b = s->bases;
  int64_t                  h = b->height;
  int                      first = (int) (h * band / BANDS), end = (int) (h * (band + 1) / BANDS), w = b->width;

  for (int y = first; y < end; y++)
    for (int x = 0; x < w; x += PIECE)
      {
        size_t p    = (size_t) y * (size_t) w + (size_t) x;
        int    n    = w - x < PIECE ? w - x : PIECE;
        int    east = x + n < w ? n : n - 1;

        if (east > 0)
          add_piece (s, band, p, east, 1, b->east);
        if (y + 1 < b->height)
          add_piece (s, band, p, n, (size_t) w, b->south);
      }
}

/* Sums the blocks of all bands into the matrix. */
static void
collect (const StiffnessSums *s, double *k)
{
  size_t n = s->bases->n, groups = s->bases->n_groups;

  for (size_t i = 1; i < n; i++)
    for (size_t j = 1; j <= i; j++)
      {
        size_t a = i - 1, c = j - 1;
        double sum = 0;

        for (size_t band = 0; band < BANDS; band++)
          sum += s->sum[((band * groups + a / CELD_LANES) * groups + c / CELD_LANES) * SQUARE +
                        a % CELD_LANES * CELD_LANES + c % CELD_LANES];
        k[i * n + j] = k[j * n + i] = sum;
      }
}

/* Fills in row and column 1, such that constants have no energy. */
static void
complete (size_t n, double *k)
{
  k[0] = 0;
  for (size_t i = 1; i < n; i++)
    {
      double sum = 0;

      for (size_t j = 1; j < n; j++)
        sum += k[i * n + j];
      k[i * n] = k[i] = -sum;
      k[0] += sum;
    }
}

CeldStatus
celd_stiffness (CeldHarmonicBases *bases, const CeldHost *host)
{
  size_t        groups = bases->n_groups;
  StiffnessSums s = {
    bases, celd_alloc0 (BANDS * groups * groups, SQUARE * sizeof (double)),
    celd_alloc (BANDS * groups, 2 * PIECE * CELD_LANES * sizeof (double)), celd_alloc (BANDS * groups, sizeof (bool)),
  };
  double       *k = celd_alloc (bases->n, bases->n * sizeof *k);
  CeldStatus    status = s.sum && s.work && s.steep && k ? celd_progress (host, 0) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      celd_parallel_for (host, BANDS, add_band, &s);
      collect (&s, k);
      complete (bases->n, k);
      celd_free (bases->stiffness);
      bases->stiffness = k;
      k = NULL;
    }
  celd_free (s.sum);
  celd_free (s.work);
  celd_free (s.steep);
  celd_free (k);
  return status;
}

/* ------------------------------------------------------------------ one more basis */

/* `sum` has a number for each lane, and one more, of each band. */
typedef struct { const CeldHarmonicBases *bases; const float *basis; double *sum; } Products;

static void
add_edge (const Products *s, size_t p, size_t q, double weight, double *sum)
{
  size_t groups = s->bases->n_groups;
  double d      = (double) s->basis[q] - (double) s->basis[p];

  if (d == 0)
    return;
  for (size_t g = 0; g < groups; g++)
    for (size_t k = 0; k < CELD_LANES; k++)
      sum[g * CELD_LANES + k] += weight * d * ((double) s->bases->group[g][q * CELD_LANES + k] -
                                               (double) s->bases->group[g][p * CELD_LANES + k]);
  sum[groups * CELD_LANES] += weight * d * d;
}

static void
multiply_band (void *data, int band)
{
  const Products          *s = data;
  const CeldHarmonicBases *b = s->bases;
  size_t                   w = (size_t) b->width, h = (size_t) b->height, from = (size_t) band;
  size_t                   p = w * (h * from / BANDS), end = w * (h * (from + 1) / BANDS);
  double                  *sum = s->sum + (size_t) band * (b->n_groups * CELD_LANES + 1);

  for (; p < end; p++)
    {
      if ((p + 1) % w)
        add_edge (s, p, p + 1, (double) b->east[p], sum);
      if (p + w < w * h)
        add_edge (s, p, p + w, (double) b->south[p], sum);
    }
}

size_t
celd_stiffness_room (size_t n)
{
  return BANDS * (n + CELD_LANES);
}

void
celd_stiffness_of (const CeldHarmonicBases *bases, const float *basis, const CeldHost *host, double *room, double *with,
                   double *own)
{
  size_t   lanes = bases->n_groups * CELD_LANES;
  Products s = { bases, basis, room };

  memset (room, 0, BANDS * (lanes + 1) * sizeof *room);
  celd_parallel_for (host, BANDS, multiply_band, &s);
  for (size_t band = 1; band < BANDS; band++)
    for (size_t i = 0; i <= lanes; i++)
      s.sum[i] += s.sum[band * (lanes + 1) + i];
  with[0] = 0;
  for (size_t k = 1; k < bases->n; k++)
    {
      with[k]  = s.sum[k - 1];
      with[0] -= with[k];
    }
  *own = s.sum[lanes];
}
