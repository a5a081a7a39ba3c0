/* The seat of a part: the surface that its outline lies on, so that an eye sits on a face.
 *
 * Along its outline a part should lie just in front of what is behind it, and where its surface goes on into another
 * part, at that part's height.  The seat u minimizes over cells
 *
 *     sum over neighbours  (u_a - u_b)^2  +  sum over cells with an outline  w_c (u_c - t_c)^2
 *
 * with targets t and weights that are large where the seat would be behind what it has to be in front of, and small
 * where it is farther in front than needed.  So it is a membrane that follows what it lies on: a linear slope exactly,
 * and rough ground smoothly.  In front of the page alone a part stays at the height of its level.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief/parts.h"
#include "solve/laplace.h"

#include <math.h>

#define CELLS_ACROSS   96    /* most cells along the longer side of a box; chosen */
#define ROUNDS         5     /* in which weights follow the solution; chosen */
#define IN_FRONT       0.3f /* weights, as a share of that of an outline behind its target: on another part, */
#define OVER_PAGE      1e-3f /* over the page, */
#define NOWHERE        1e-4f /* and of cells without outline; all chosen */
#define MOST_GAP       0.25  /* of a part before the one behind it, as a share of its own height; chosen */
#define LEAST_GAP      0.5   /* pixels; chosen */
#define SEAT_TOLERANCE 1e-4

/* What the outline in a cell asks for: a height and the number of its pixels. */
typedef struct { float z, n; } Target;

typedef struct
{
  CeldPartSeat *seat;
  double        level_z;        /* the height of the part's level */
  size_t        n;
  Target       *on, *over;      /* of each cell: on another part, and over the page */
  Target       *joined;         /* sum of heights */
  bool          sits;           /* is there a cell on another part? */
  float        *east, *south, *diagonal, *b;
  uint8_t      *empty;
} Seat;

static CeldStatus
seat_new (CeldPart *part, double level_z, Seat *s)
{
  CeldPartSeat *seat = &part->seat;
  int           longer = part->box.width > part->box.height ? part->box.width : part->box.height;

  seat->side   = (longer + CELLS_ACROSS - 1) / CELLS_ACROSS;
  seat->width  = (part->box.width + seat->side - 1) / seat->side;
  seat->height = (part->box.height + seat->side - 1) / seat->side;
  *s           = (Seat) { .seat = seat, .level_z = level_z,
                          .n = (size_t) seat->width * (size_t) seat->height };
  seat->z      = celd_alloc0 (s->n, sizeof *seat->z);
  s->on        = celd_alloc0 (s->n, sizeof *s->on);
  s->over      = celd_alloc0 (s->n, sizeof *s->over);
  s->joined    = celd_alloc0 (s->n, sizeof *s->joined);
  s->east      = celd_alloc0 (s->n, sizeof *s->east);
  s->south     = celd_alloc0 (s->n, sizeof *s->south);
  s->diagonal  = celd_alloc0 (s->n, sizeof *s->diagonal);
  s->b         = celd_alloc0 (s->n, sizeof *s->b);
  s->empty     = celd_alloc (s->n, 1);
  return seat->z && s->on && s->over && s->joined && s->east && s->south && s->diagonal && s->b && s->empty
           ? CELD_OK : CELD_NO_MEMORY;
}

static void
seat_clear (Seat *s)
{
  celd_free (s->on);
  celd_free (s->over);
  celd_free (s->joined);
  celd_free (s->east);
  celd_free (s->south);
  celd_free (s->diagonal);
  celd_free (s->b);
  celd_free (s->empty);
}

/* ------------------------------------------------------------------ targets */

static size_t
cell_of (const CeldPartSeat *seat, int x, int y)
{
  return (size_t) (y / seat->side) * (size_t) seat->width + (size_t) (x / seat->side);
}

/* How far in front of part `other` (from 1; 0: the page) the part should lie. */
static double
gap_before (const CeldParts *parts, size_t k, uint32_t other, double rise)
{
  const CeldSheet *sheet = parts->sheets->item;
  uint32_t         level = sheet[k].level, behind = other ? sheet[other - 1].level : 0;
  double           gap = level > behind ? CELD_PART_STEP * rise * (level - behind) : 0;

  return fmax (LEAST_GAP, fmin (gap, MOST_GAP * parts->item[k].size));
}

static void
ask (Target *target, double z)
{
  target->z = target->n > 0 ? fmaxf (target->z, (float) z) : (float) z;
  target->n += 1;
}

/* Collects what the outline asks for at one side of a pixel inside. */
static void
ask_at (Seat *s, const CeldParts *parts, size_t k, const CeldBehind *behind, double rise, int x, int y, int direction)
{
  const CeldPart *part = &parts->item[k];
  size_t          c = cell_of (s->seat, x, y), w = (size_t) parts->width;
  size_t          p = (size_t) (part->box.y + y) * w + (size_t) (part->box.x + x);
  int             to_x = part->box.x + x, to_y = part->box.y + y;
  uint32_t        top = behind->top[p];

  celd_step (direction, &to_x, &to_y);
  if (part->open[celd_part_at (part, x, y)] & 1 << direction)
    {
      size_t q = (size_t) to_y * w + (size_t) to_x;

      if (to_x < 0 || to_y < 0 || to_x >= parts->width || to_y >= parts->height || !behind->top[q] ||
          behind->top[q] - 1 != celd_part_seen (parts, to_x, to_y))
        return;
      s->joined[c].z += behind->z[q] - part->z[celd_part_at (part, x, y)];
      s->joined[c].n += 1;
      s->sits = true;
      return;
    }
  if (top)
    ask (&s->on[c], (double) behind->z[p] + gap_before (parts, k, top, rise));
  else
    s->over[c].n += 1;
  s->sits = s->sits || top;
}

static void
collect_targets (Seat *s, const CeldParts *parts, size_t k, const CeldBehind *behind, double rise)
{
  const CeldPart *part = &parts->item[k];

  memset (s->empty, 1, s->n);
  for (int y = 1; y < part->box.height - 1; y++)
    for (int x = 1; x < part->box.width - 1; x++)
      if (celd_part_has (part, x, y))
        {
          s->empty[cell_of (s->seat, x, y)] = 0;
          for (int i = 0; i < 4; i++)
            {
              int to_x = x, to_y = y;

              celd_step (i, &to_x, &to_y);
              if (!celd_part_has (part, to_x, to_y))
                ask_at (s, parts, k, behind, rise, x, y, i);
            }
        }
  for (size_t c = 0; c < s->n; c++) /* a part on another one need only be in front of the page, not at its level */
    s->over[c].z = (float) (s->sits ? fmin (s->level_z, LEAST_GAP) : s->level_z);
}

/* ------------------------------------------------------------------ the membrane */

static void
link_cells (Seat *s)
{
  int w = s->seat->width, h = s->seat->height;

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        size_t c = (size_t) y * (size_t) w + (size_t) x;

        if (x + 1 < w && !s->empty[c] && !s->empty[c + 1])
          s->east[c] = 1;
        if (y + 1 < h && !s->empty[c] && !s->empty[c + (size_t) w])
          s->south[c] = 1;
      }
}

static void
pull (Seat *s, size_t c, Target target, float weight)
{
  weight *= target.n / (float) s->seat->side;
  s->diagonal[c] += weight;
  s->b[c] += weight * target.z;
}

/* Sets the weights by the last solution; in the first round all targets on parts count. */
static void
weigh (Seat *s, bool first)
{
  for (size_t c = 0; c < s->n; c++)
    {
      float z = s->seat->z[c];

      s->diagonal[c] = NOWHERE * !s->empty[c];
      s->b[c]        = s->diagonal[c] * s->over[c].z;
      if (s->joined[c].n > 0)
        pull (s, c, (Target) { s->joined[c].z / s->joined[c].n, s->joined[c].n }, 1);
      pull (s, c, s->on[c], first || z < s->on[c].z ? 1 : IN_FRONT);
      pull (s, c, s->over[c], !first && z < s->over[c].z ? 1 : OVER_PAGE);
    }
}

static CeldStatus
settle (Seat *s, bool first, const CeldHost *host)
{
  CeldLaplace *laplace = NULL;
  CeldStatus   status;

  weigh (s, first);
  status = celd_lap_setup (s->seat->width, s->seat->height, s->east, s->south, s->diagonal, s->empty, host, &laplace);
  if (status == CELD_OK)
    status = celd_lap_solve (laplace, 1, s->b, s->seat->z, SEAT_TOLERANCE, host, NULL);
  celd_lap_free (laplace);
  return status;
}

/* Gives empty cells the mean of their neighbours, for interpolation beside the outline. */
static void
extend (Seat *s)
{
  int w = s->seat->width, h = s->seat->height;

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        float sum = 0, n = 0;

        for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < h; v++)
          for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < w; u++)
            if (!s->empty[v * w + u])
              {
                sum += s->seat->z[v * w + u];
                n += 1;
              }
        if (s->empty[y * w + x] && n > 0)
          s->seat->z[y * w + x] = sum / n;
      }
}

CeldStatus
celd_part_sit (const CeldParts *parts, size_t k, const CeldBehind *behind, double rise, const CeldHost *host)
{
  CeldPart    *part = &parts->item[k];
  CeldHostPart share;
  CeldHost     quiet = celd_host_part (&share, host, 0, 0);
  Seat         s;
  CeldStatus   status = seat_new (part, rise * parts->sheets->item[k].level, &s);

  if (status == CELD_OK)
    {
      collect_targets (&s, parts, k, behind, rise);
      link_cells (&s);
    }
  for (int i = 0; i < ROUNDS && status == CELD_OK; i++)
    status = settle (&s, i == 0, &quiet);
  if (status == CELD_OK)
    extend (&s);
  seat_clear (&s);
  return status;
}

float
celd_part_seat_at (const CeldPart *part, double x, double y)
{
  const CeldPartSeat *seat = &part->seat;
  double              u = fmin (fmax ((x + 0.5) / seat->side - 0.5, 0), seat->width - 1);
  double              v = fmin (fmax ((y + 0.5) / seat->side - 0.5, 0), seat->height - 1);
  int                 left = (int) u, top = (int) v;
  int                 right = left + 1 < seat->width ? left + 1 : left, below = top + 1 < seat->height ? top + 1 : top;
  const float        *a = seat->z + (size_t) top * (size_t) seat->width;
  const float        *b = seat->z + (size_t) below * (size_t) seat->width;
  double              across = u - left, down = v - top;

  return (float) ((1 - down) * ((1 - across) * (double) a[left] + across * (double) a[right]) +
                  down * ((1 - across) * (double) b[left] + across * (double) b[right]));
}
