/* Which line ends may be joined, the closest and straightest pair first.
 *
 * No gap is too wide, so in principle every end is compared with every other.  But a pair costs at least half its
 * distance, and a joined pair leaves no other pair for its ends.  So ends are compared within a distance that doubles
 * from round to round: pairs cheaper than the closest pair of the next round can be returned first, and ends taken by
 * then are not compared again.  From FAR_END on lines must continue nearly straight: there only ends in cells ahead are
 * visited, and of these only those that point back.
 *
 * Cost: n log n for n ends of which few stay single; n^2 comparisons at worst, if no end finds another.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "segment/bridges.h"

#include <math.h>
#include <stdlib.h>

#define NEAR_END          6     /* stroke widths: up to here a line may turn sharply to meet another */
#define FAR_END           12    /* stroke widths: from here on it must continue nearly straight */
#define NEAR_COSINE       -0.34 /* cosines of the angle by which it may turn: 110, 60 and 20 degrees */
#define MIDDLE_COSINE      0.5
#define FAR_COSINE        0.94
#define SHARP_BEND_COST   2     /* times the square of 1 - cosine of the sharper turn, added to the cost (chosen) */
#define OWN_OUTLINE       0.5   /* factor of the cost between two ends of one outline: closing it is preferred */
#define BOW_COSINE        0.8   /* if both cosines are less, both ends must turn to the same side */
#define ROUND_OFF         1e-6  /* margin by which quick tests are less strict than the exact one */

#define SECTORS 16 /* of directions (chosen) */
#define BACK    2  /* sectors: two ends that turn by at most 20 degrees each face each other within 40 */

struct CeldTipPairs
{
  const CeldTip *tip;
  int            stroke;
  bool           last;                     /* the largest distance has been reached */
  double         from, most;               /* distances of this round: from < distance <= most */
  double         left, top, width, height; /* the box of all ends */

  uint32_t *free;                         /* ends that were free when the round began */
  size_t    n_free;
  double    side;                         /* of a cell, in pixels */
  int       columns, rows;
  size_t   *first;                        /* of each cell and sector: its first end in `sorted`; one more */
  uint32_t *sorted;                       /* the free ends by cells and sectors */
  CeldTip  *sorted_tip;

  CeldTipPair *pair;                      /* by cost */
  size_t       n, next, ready;            /* those before `ready` cost less than any pair of a later round */
  size_t       pair_capacity;
};

/* ------------------------------------------------------------------ a pair */

/* How differently wide two lines are: 1 or more; a pixel does not count. */
static double
width_ratio (const CeldTip *p, const CeldTip *q)
{
  double narrow = fmin (p->width, q->width) + 1, wide = fmax (p->width, q->width);

  return p->width > 0 && q->width > 0 ? fmax (1, wide / narrow) : 1;
}

/* May two ends be joined?  The cost is their distance, more where one of the lines has to turn or they are not equally
 * wide, and less if that closes an outline. */
static bool
may_join (const CeldTipPairs *s, const CeldTip *p, const CeldTip *q, double *cost)
{
  double x = q->x - p->x, y = q->y - p->y, length = hypot (x, y), stroke = celd_finer_stroke (p, q), least;
  double turn = (x * p->dx + y * p->dy) / length, other = -(x * q->dx + y * q->dy) / length;
  double side = x * p->dy - y * p->dx, other_side = x * q->dy - y * q->dx, bend = 1 - fmin (turn, other);

  if (length < 1 || length <= s->from || length > s->most)
    return false;
  least = length <= NEAR_END * stroke ? NEAR_COSINE : length <= FAR_END * stroke ? MIDDLE_COSINE : FAR_COSINE;
  if (turn < least || other < least || (turn < BOW_COSINE && other < BOW_COSINE && side * other_side < 0))
    return false;
  *cost = length * (1 + bend + SHARP_BEND_COST * bend * bend) * width_ratio (p, q) *
          (p->outline == q->outline ? OWN_OUTLINE : 1);
  return true;
}

static int
compare_pairs (const void *a, const void *b)
{
  const CeldTipPair *p = a, *q = b;

  if (p->cost != q->cost)
    return p->cost < q->cost ? -1 : 1;
  if (p->a != q->a)
    return p->a < q->a ? -1 : 1;
  return p->b < q->b ? -1 : p->b > q->b;
}

/* ------------------------------------------------------------------ cells */

static int
cell_along (double distance, double side, int n)
{
  int k = (int) (distance / side);

  return k < 0 ? 0 : k < n ? k : n - 1;
}

static int
sector_of (double dx, double dy)
{
  return cell_along (atan2 (dy, dx) + CELD_PI, 2 * CELD_PI / SECTORS, SECTORS);
}

static size_t
place_of (const CeldTipPairs *s, const CeldTip *tip)
{
  size_t row = (size_t) cell_along (tip->y - s->top, s->side, s->rows);
  size_t column = (size_t) cell_along (tip->x - s->left, s->side, s->columns);

  return (row * (size_t) s->columns + column) * SECTORS + (size_t) sector_of (tip->dx, tip->dy);
}

/* Sorts the free ends into cells: no more cells than ends, and small enough to find what lies ahead. */
static CeldStatus
sort_into_cells (CeldTipPairs *s)
{
  size_t places, sum = 0;

  s->side    = fmax (s->most / 8, sqrt ((s->width + 1) * (s->height + 1) / (double) s->n_free));
  s->columns = (int) (s->width / s->side) + 1;
  s->rows    = (int) (s->height / s->side) + 1;
  places     = (size_t) s->columns * (size_t) s->rows * SECTORS;
  celd_free (s->first);
  s->first = celd_alloc0 (places + 1, sizeof *s->first);
  if (!s->first)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < s->n_free; i++)
    s->first[place_of (s, &s->tip[s->free[i]])]++;
  for (size_t k = 0; k <= places; k++)
    s->first[k] = sum += s->first[k];
  for (size_t i = s->n_free; i--;)
    {
      size_t k = --s->first[place_of (s, &s->tip[s->free[i]])];

      s->sorted[k]     = s->free[i];
      s->sorted_tip[k] = s->tip[s->free[i]];
    }
  return CELD_OK;
}

/* ------------------------------------------------------------------ rounds */

/* May an end within `radius` of this place, relative to the tip, be nearly straight ahead? */
static bool
lies_ahead (const CeldTip *tip, double x, double y, double radius)
{
  static const double cosine = FAR_COSINE, sine = 0.342; /* rounded up from sqrt (1 - cosine^2) */
  double              along = x * tip->dx + y * tip->dy, across = fabs (x * tip->dy - y * tip->dx);

  return across * cosine - along * sine <= radius + ROUND_OFF;
}

static CeldStatus
add_pair (CeldTipPairs *s, CeldTipPair pair)
{
  return celd_append (s->pair, s->n, s->pair_capacity, pair);
}

/* A quick test: may two ends of a far round be a pair? */
static bool
may_face (const CeldTip *p, const CeldTip *q)
{
  double x = q->x - p->x, y = q->y - p->y;
  double least = (1 - ROUND_OFF) * FAR_COSINE * FAR_COSINE * (x * x + y * y);
  double turn = x * p->dx + y * p->dy, other = -(x * q->dx + y * q->dy);

  return turn > 0 && other > 0 && turn * turn >= least && other * other >= least;
}

/* Adds the pairs of end i with sorted ends from .. to - 1 of higher number. */
static CeldStatus
search_ends (CeldTipPairs *s, uint32_t i, bool far, size_t from, size_t to)
{
  CeldStatus status = CELD_OK;

  for (size_t k = from; k < to && status == CELD_OK; k++)
    {
      CeldTipPair pair = { 0, i, s->sorted[k] };

      if (pair.b > i && (!far || may_face (&s->tip[i], &s->sorted_tip[k])) &&
          may_join (s, &s->tip[i], &s->sorted_tip[k], &pair.cost))
        status = add_pair (s, pair);
    }
  return status;
}

/* Searches the ends of a cell that point back, in a far round. */
static CeldStatus
search_back (CeldTipPairs *s, uint32_t i, size_t cell)
{
  const CeldTip *tip = &s->tip[i];
  CeldStatus     status = CELD_OK;

  if (s->first[cell * SECTORS] == s->first[(cell + 1) * SECTORS])
    return CELD_OK;
  for (int off = -BACK, sector = sector_of (-tip->dx, -tip->dy); off <= BACK && status == CELD_OK; off++)
    {
      size_t place = cell * SECTORS + (size_t) ((sector + off + SECTORS) % SECTORS);

      status = search_ends (s, i, true, s->first[place], s->first[place + 1]);
    }
  return status;
}

static CeldStatus
search_round (CeldTipPairs *s, uint32_t i)
{
  const CeldTip *tip = &s->tip[i];
  bool           far = s->from >= FAR_END * s->stroke;
  double         x = tip->x - s->left, y = tip->y - s->top, radius = sqrt (0.5) * s->side;
  int            right = cell_along (x + s->most, s->side, s->columns);
  int            bottom = cell_along (y + s->most, s->side, s->rows);
  CeldStatus     status = CELD_OK;

  for (int row = cell_along (y - s->most, s->side, s->rows); row <= bottom; row++)
    for (int column = cell_along (x - s->most, s->side, s->columns); column <= right && status == CELD_OK; column++)
      {
        size_t cell = (size_t) row * (size_t) s->columns + (size_t) column;

        if (!far)
          status = search_ends (s, i, false, s->first[cell * SECTORS], s->first[(cell + 1) * SECTORS]);
        else if (lies_ahead (tip, (column + 0.5) * s->side - x, (row + 0.5) * s->side - y, radius))
          status = search_back (s, i, cell);
      }
  return status;
}

/* Removes ends that are taken, and pairs that are used up. */
static void
remove_taken (CeldTipPairs *s, const bool *taken)
{
  size_t n = 0;

  for (size_t i = 0; i < s->n_free; i++)
    if (!taken[s->free[i]])
      s->free[n++] = s->free[i];
  s->n_free = n;
  n         = 0;
  for (size_t i = s->next; i < s->n; i++)
    if (!taken[s->pair[i].a] && !taken[s->pair[i].b])
      s->pair[n++] = s->pair[i];
  s->n    = n;
  s->next = 0;
}

static double
progress (const CeldTipPairs *s)
{
  return fmin (1, s->from / (s->width + s->height));
}

/* Starts the next round: adds all pairs up to twice the distance. */
static CeldStatus
start_round (CeldTipPairs *s, const bool *taken, const CeldHost *host)
{
  CeldStatus status;

  remove_taken (s, taken);
  s->from  = s->most;
  s->most = s->most > 0 ? 2 * s->most : fmax (1, NEAR_END * s->stroke);
  s->last  = s->most > s->width + s->height || s->n_free < 2;
  status   = s->n_free ? sort_into_cells (s) : CELD_OK;
  for (size_t i = 0; i < s->n_free && status == CELD_OK; i++)
    {
      status = search_round (s, s->free[i]);
      if (status == CELD_OK && (i & 255) == 255)
        status = celd_progress (host, progress (s));
    }
  if (s->n)
    qsort (s->pair, s->n, sizeof *s->pair, compare_pairs);
  for (s->ready = 0; s->ready < s->n && (s->last || s->pair[s->ready].cost < (1 - ROUND_OFF) * OWN_OUTLINE * s->most);)
    s->ready++;
  return status;
}

/* ------------------------------------------------------------------ all pairs */

void
celd_tip_pairs_free (CeldTipPairs *pairs)
{
  if (!pairs)
    return;
  celd_free (pairs->free);
  celd_free (pairs->sorted);
  celd_free (pairs->sorted_tip);
  celd_free (pairs->first);
  celd_free (pairs->pair);
  celd_free (pairs);
}

CeldTipPairs *
celd_tip_pairs_new (const CeldTip *tip, size_t n, int stroke)
{
  CeldTipPairs *s = celd_alloc0 (1, sizeof *s);
  double        right = 0, bottom = 0;

  if (!s)
    return NULL;
  *s = (CeldTipPairs) { .tip = tip, .stroke = stroke, .n_free = n, .free = celd_alloc (n, sizeof *s->free),
                        .sorted = celd_alloc (n, sizeof *s->sorted),
                        .sorted_tip = celd_alloc (n, sizeof *s->sorted_tip) };
  if (!s->free || !s->sorted || !s->sorted_tip)
    {
      celd_tip_pairs_free (s);
      return NULL;
    }
  for (uint32_t i = 0; i < n; i++)
    {
      s->free[i] = i;
      s->left    = i ? fmin (s->left, tip[i].x) : tip[i].x;
      s->top     = i ? fmin (s->top, tip[i].y) : tip[i].y;
      right      = i ? fmax (right, tip[i].x) : tip[i].x;
      bottom     = i ? fmax (bottom, tip[i].y) : tip[i].y;
    }
  s->width  = right - s->left;
  s->height = bottom - s->top;
  return s;
}

CeldStatus
celd_tip_pairs_next (CeldTipPairs *pairs, const bool *taken, const CeldHost *host, const CeldTipPair **pair)
{
  CeldStatus status = CELD_OK;

  *pair = NULL;
  while (status == CELD_OK && !*pair && (pairs->next < pairs->ready || !pairs->last))
    if (pairs->next == pairs->ready)
      status = start_round (pairs, taken, host);
    else
      {
        const CeldTipPair *first = &pairs->pair[pairs->next++];

        if (!taken[first->a] && !taken[first->b])
          *pair = first;
        if ((pairs->next & 4095) == 0)
          status = celd_progress (host, progress (pairs));
      }
  return status;
}
