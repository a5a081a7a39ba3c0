/* Basins by steepest ascent: every pixel leads to the neighbour where the relief is greatest, and at last to a maximum.
 *
 * The relief is the signed squared distance, but deeper in ink than T it rises again: d^2 - 2 T^2.  Ties are broken by
 * the order of the pixels, so that no plateau is left: among 4-neighbours an equal one that comes later in reading order
 * is higher.  Diagonal neighbours must be higher by relief alone: a diagonal line one pixel wide has paper at distance 1
 * on both sides, which thus never leads across.
 *
 * Bands of rows: each pixel is led up to a maximum or to the first pixel outside its band, by sweeps down and up the
 * band.  Beside each other, pixels mostly lead to the same place or to places beside each other, and are kept as such
 * stretches.  Then the outermost rows of all bands are led to their maxima, and with them everything else, as runs.
 * O(pixels) time; a band and half a byte a pixel of workspace.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "basin-steps.h"

#define BAND    32          /* rows a job */
#define JOBS    8           /* jobs at once, with threads */
#define UNKNOWN UINT32_MAX
#define MAXIMUM (1u << 31)  /* the rest is twice the number of a maximum in its band, or with CELD_KEPT of an old basin;
                             * else it is a place in `edge` */

/* Where a pixel leads: three steps up, three down, and from STAY on those that stay in their row.  KEEP: as before. */
enum { NORTH_WEST, NORTH, NORTH_EAST, SOUTH_WEST, SOUTH, SOUTH_EAST, STAY = 0x80, EAST, WEST, KEEP };

/* Pixels of a row, up to the next stretch: all lead to the same, or each to the place after the last one's. */
typedef struct { int32_t x; bool moves; uint32_t lead; } Stretch;

/* What a band finds. */
typedef struct
{
  uint32_t     *maximum;    /* pixels in reading order */
  size_t        n;
  size_t        first;      /* basin of its first maximum */
  Stretch      *stretch;
  size_t        row[BAND + 1];
  CeldBasinRun *run;
  size_t        n_runs;
  bool          failed;     /* no memory */
} Band;

/* What a job works with. */
typedef struct
{
  int32_t  *relief;         /* 3 rows with a pixel more at both ends */
  uint32_t *lead;           /* of the band and a row above and below it, likewise */
  uint8_t  *step;
  uint8_t  *begins;         /* a row */
} Desk;

typedef struct
{
  const CeldPlot *plot;
  int            width, height;
  int32_t        core;      /* of ink that is deeper the relief rises again */
  uint32_t      *edge;      /* the first and the last row of each band: where they lead, then their basins */
  uint32_t      *until;     /* of a place in edge: the next one that has another basin, or is another row's */
  Desk           desk[JOBS];
  int            n_desks;
  Band          *band;
  int            n_bands;
  int            first;     /* the first band of this round of jobs */
  CeldBasins    *basins;
} Ascent;

static inline int
band_top (int band)
{
  return band * BAND;
}

static inline int
band_end (const Ascent *a, int band)
{
  return (band + 1) * BAND < a->height ? (band + 1) * BAND : a->height;
}

/* ------------------------------------------------------------------ steps */

/* Row y of the relief, with low ground on both sides; all low outside the picture. */
CELD_CLONES static void
raise_row (const Ascent *a, int y, int32_t *restrict relief)
{
  bool           inside = y >= 0 && y < a->height;
  const int32_t *squared = a->plot->squared + (inside ? (size_t) y * a->plot->stride : 0);
  int32_t        core = a->core;

  relief[0] = relief[a->width + 1] = INT32_MIN;
  for (int x = 0; x < a->width && !inside; x++)
    relief[x + 1] = INT32_MIN;
  for (int x = 0; x < a->width && inside; x++)
    relief[x + 1] = squared[x] < -core ? -squared[x] - 2 * core : squared[x];
}

/* The steps of a row; the rows of the relief start one pixel to the left. */
CELD_CLONES static void
find_steps (int width, const int32_t *restrict above, const int32_t *restrict here, const int32_t *restrict below,
            uint8_t *restrict step)
{
  for (int x = 0; x < width; x++)
    {
      int32_t best = here[x + 1];
      int     to = STAY;

#define TRY(height, is_higher, where) \
  to = (height) is_higher best ? where : to; \
  best = (height) is_higher best ? (height) : best
      TRY (below[x + 1], >=, SOUTH);
      TRY (here[x + 2], >=, EAST);
      TRY (here[x], >, WEST);
      TRY (above[x + 1], >, NORTH);
      TRY (above[x], >, NORTH_WEST);
      TRY (above[x + 2], >, NORTH_EAST);
      TRY (below[x], >, SOUTH_WEST);
      TRY (below[x + 2], >, SOUTH_EAST);
#undef TRY
      step[x] = (uint8_t) to;
    }
}

/* ------------------------------------------------------------------ leads within a band */

/* Takes over what is known in the row that the steps from first, first + 1, first + 2 (to the left, straight, to the
 * right) lead to. */
CELD_CLONES static void
take_over (int width, const uint8_t *restrict step, int first, const uint32_t *restrict next, uint32_t *restrict lead)
{
  for (int x = 0; x < width; x++)
    {
      uint32_t left = next[x - 1], straight = next[x], right = next[x + 1], to = lead[x];

      to = step[x] == first ? left : to;
      to = step[x] == first + 1 ? straight : to;
      to = step[x] == first + 2 ? right : to;
      lead[x] = to;
    }
}

/* Takes over what is known beside a pixel. */
static void
go_sideways (int width, const uint8_t *step, uint32_t *lead)
{
  for (int x = celd_next_marked (width, step, 0), end; x < width; x = celd_next_marked (width, step, end))
    {
      for (end = x + 1; end < width && step[end] == step[x]; end++)
        ;
      if (step[x] != STAY && lead[x] == UNKNOWN)
        {
          uint32_t to = lead[step[x] == EAST ? end : x - 1];

          for (int u = x; u < end; u++)
            lead[u] = to;
        }
    }
}

static inline ptrdiff_t
step_offset (uint8_t step, ptrdiff_t row_size)
{
  switch (step)
    {
    case EAST:
      return 1;
    case WEST:
      return -1;
    default:
      return step < SOUTH_WEST ? step - NORTH - row_size : step - SOUTH + row_size;
    }
}

/* Follows the steps from a pixel whose lead is unknown, and tells all pixels on the way. */
static void
follow (int width, const uint8_t *step, uint32_t *lead)
{
  uint32_t      *p = lead, to;
  const uint8_t *s = step;

  while (*p == UNKNOWN)
    {
      p += step_offset (*s, width + 2);
      s += step_offset (*s, width);
    }
  to = *p;
  for (p = lead, s = step; *p == UNKNOWN;)
    {
      *p = to;
      p += step_offset (*s, width + 2);
      s += step_offset (*s, width);
    }
}

CELD_CLONES static bool
has_unknown (int width, const uint32_t *lead)
{
  uint32_t most = 0;

  for (int x = 0; x < width; x++)
    most = lead[x] > most ? lead[x] : most;
  return most == UNKNOWN;
}

/* Leads n rows to maxima, or to the rows above and below them, whose leads are known. */
static void
lead_rows (int width, int n, const uint8_t *step, uint32_t *lead)
{
  size_t row_size = (size_t) width + 2, w = (size_t) width;

  for (int sweep = 0; sweep < 3; sweep++)
    for (int i = 0; i < n; i++)
      {
        bool      down = sweep != 1;
        int       y = down ? i : n - 1 - i;
        uint32_t *row = lead + (size_t) y * row_size;

        take_over (width, step + (size_t) y * w, down ? NORTH_WEST : SOUTH_WEST, down ? row - row_size : row + row_size,
                   row);
        go_sideways (width, step + (size_t) y * w, row);
      }
  for (int y = 0; y < n; y++)
    if (has_unknown (width, lead + (size_t) y * row_size))
      for (int x = 0; x < width; x++)
        if (lead[(size_t) y * row_size + (size_t) x] == UNKNOWN)
          follow (width, step + (size_t) y * w + x, lead + (size_t) y * row_size + x);
}

/* ------------------------------------------------------------------ a band */

/* Pixels of row y that keep their old basins lead there. */
static void
keep_row (const Ascent *a, int y, uint8_t *step, uint32_t *lead)
{
  const CeldBasins   *old = a->plot->old;
  const uint8_t      *anew = a->plot->anew + (size_t) y * (size_t) a->width;
  int                 left = a->plot->box.x;
  const CeldBasinRun *run = old->run + old->row[a->plot->box.y + y], *end = old->run + old->row[a->plot->box.y + y + 1];

  for (int x = 0; x < a->width; x++)
    {
      while (run + 1 < end && run[1].x <= left + x)
        run++;
      if (anew[x])
        continue;
      step[x] = KEEP;
      lead[x] = MAXIMUM | CELD_KEPT | 2 * run->basin;
    }
}

/* Maxima lead to themselves; what else does is not known. */
static bool
start_row (const Ascent *a, int y, uint8_t *step, Band *band, uint32_t *lead)
{
  memset (lead, 0xff, (size_t) a->width * sizeof *lead);
  if (a->plot->anew)
    keep_row (a, y, step, lead);
  for (int x = celd_next_marked (a->width, step, 0); x < a->width; x = celd_next_marked (a->width, step, x + 1))
    if (step[x] == STAY)
      {
        uint32_t *maximum = celd_grow (band->maximum, band->n + 1, sizeof *maximum);

        if (!maximum)
          return false;
        band->maximum = maximum;
        lead[x] = MAXIMUM | (uint32_t) (2 * band->n);
        maximum[band->n++] = (uint32_t) (y * a->width + x);
      }
  return true;
}

/* Marks where stretches begin. */
CELD_CLONES static void
mark_stretches (int width, const uint32_t *restrict lead, uint8_t *restrict begins)
{
  begins[0] = 0x80;
  if (width > 1)
    begins[1] = lead[1] - lead[0] > 1 ? 0x80 : 0;
  for (int x = 2; x < width; x++)
    {
      uint32_t step = lead[x] - lead[x - 1], last = lead[x - 1] - lead[x - 2];

      begins[x] = (step > 1) | ((last < 2) & (step != last)) ? 0x80 : 0;
    }
}

static bool
note_stretches (int width, const uint32_t *lead, uint8_t *begins, Band *band, int row)
{
  size_t n = band->row[row];

  mark_stretches (width, lead, begins);
  for (int x = 0; x < width; x = celd_next_marked (width, begins, x + 1))
    {
      Stretch *stretch = celd_grow (band->stretch, n + 1, sizeof *stretch);

      if (!stretch)
        return false;
      band->stretch = stretch;
      stretch[n++] = (Stretch) { x, x + 1 < width && !begins[x + 1] && lead[x + 1] != lead[x], lead[x] };
    }
  band->row[row + 1] = n;
  return true;
}

static void
lead_band (void *data, int job)
{
  const Ascent *a = data;
  const Desk   *desk = &a->desk[job];
  int           w = a->width, at = a->first + job, top = band_top (at), n = band_end (a, at) - top;
  size_t        row_size = (size_t) w + 2;
  uint32_t     *lead = desk->lead + row_size + 1, place = (uint32_t) (2 * at * w);
  Band         *band = &a->band[at];

  raise_row (a, top - 1, desk->relief);
  raise_row (a, top, desk->relief + row_size);
  for (int i = 0; i < n && !band->failed; i++)
    {
      uint8_t *step = desk->step + (size_t) i * (size_t) w;

      raise_row (a, top + i + 1, desk->relief + (size_t) (i + 2) % 3 * row_size);
      find_steps (w, desk->relief + (size_t) i % 3 * row_size, desk->relief + (size_t) (i + 1) % 3 * row_size,
                  desk->relief + (size_t) (i + 2) % 3 * row_size, step);
      band->failed = !start_row (a, top + i, step, band, lead + (size_t) i * row_size);
    }
  for (int x = 0; x < w; x++)
    {
      desk->lead[x + 1] = place - (uint32_t) w + (uint32_t) x;
      lead[(size_t) n * row_size + (size_t) x] = place + 2 * (uint32_t) w + (uint32_t) x;
    }
  if (!band->failed)
    lead_rows (w, n, desk->step, lead);
  for (int i = 0; i < n && !band->failed; i++)
    band->failed = !note_stretches (w, lead + (size_t) i * row_size, desk->begins, band, i);
  memcpy (a->edge + place, lead, (size_t) w * sizeof *lead);
  memcpy (a->edge + place + w, lead + (size_t) (n - 1) * row_size, (size_t) w * sizeof *lead);
}

/* ------------------------------------------------------------------ basins */

/* Numbers the maxima. */
static CeldStatus
make_basins (const Ascent *a)
{
  CeldBasins *basins = a->basins;
  size_t      n = 0;

  for (int i = 0; i < a->n_bands; i++)
    {
      a->band[i].first = n;
      n += a->band[i].n;
    }
  basins->n = n;
  basins->basin = celd_alloc (n, sizeof *basins->basin);
  if (!basins->basin)
    return CELD_NO_MEMORY;
  for (int i = 0; i < a->n_bands; i++)
    for (size_t j = 0; j < a->band[i].n; j++)
      {
        uint32_t p = a->band[i].maximum[j];
        uint32_t x = p % (uint32_t) a->width, y = p / (uint32_t) a->width;
        int32_t  squared = a->plot->squared[y * a->plot->stride + x];

        basins->basin[a->band[i].first + j] = (CeldBasin) {
          .x = a->plot->box.x + (int32_t) x, .y = a->plot->box.y + (int32_t) y,
          .squared = squared > 0 ? squared : -squared, .solid = squared < 0,
        };
      }
  return CELD_OK;
}

/* The basin that a lead with MAXIMUM stands for. */
static inline uint32_t
basin_of (const Band *band, uint32_t lead)
{
  return lead & CELD_KEPT ? CELD_KEPT | (lead & (CELD_KEPT - 1)) / 2 : (uint32_t) band->first + (lead & ~MAXIMUM) / 2;
}

/* Leads the outermost rows of all bands to their basins. */
static void
lead_edges (const Ascent *a)
{
  uint32_t *edge = a->edge, w = (uint32_t) a->width, n = 2 * w * (uint32_t) a->n_bands;

  for (uint32_t p = 0; p < n; p++)
    if (edge[p] & MAXIMUM)
      edge[p] = MAXIMUM | basin_of (&a->band[p / (2 * w)], edge[p]);
  for (uint32_t p = 0; p < n; p++)
    {
      uint32_t to = edge[p];

      while (!(to & MAXIMUM))
        to = edge[to];
      for (uint32_t q = p, next; !(edge[q] & MAXIMUM); q = next)
        {
          next = edge[q];
          edge[q] = to;
        }
    }
  for (uint32_t p = n; p-- > 0;)
    {
      edge[p] &= ~MAXIMUM;
      a->until[p] = (p + 1) % w && edge[p + 1] == edge[p] ? a->until[p + 1] : p + 1;
    }
}

/* From x on pixels of the row belong to a basin. */
static bool
add_run (Band *band, size_t row, int x, uint32_t basin)
{
  CeldBasinRun *run;

  if (band->n_runs > row && band->run[band->n_runs - 1].basin == basin)
    return true;
  run = celd_grow (band->run, band->n_runs + 1, sizeof *run);
  if (!run)
    return false;
  band->run = run;
  run[band->n_runs++] = (CeldBasinRun) { x, basin };
  return true;
}

/* The runs of a band: basins->row gets their places within the band. */
static void
find_runs (void *data, int job)
{
  const Ascent *a = data;
  int           at = a->first + job, top = band_top (at), n = band_end (a, at) - top;
  Band         *band = &a->band[at];
  bool          good = true;

  for (int i = 0; i < n; i++)
    {
      size_t row = a->basins->row[top + i] = band->n_runs;

      for (size_t k = band->row[i]; k < band->row[i + 1] && good; k++)
        {
          Stretch  s = band->stretch[k];
          int      end = k + 1 < band->row[i + 1] ? band->stretch[k + 1].x : a->width;
          uint32_t to = s.lead;

          if (to & MAXIMUM)
            good = add_run (band, row, s.x, basin_of (band, to));
          else if (!s.moves)
            good = add_run (band, row, s.x, a->edge[to]);
          else
            for (; s.x < end && good; to = a->until[to])
              {
                good = add_run (band, row, s.x, a->edge[to]);
                s.x += (int32_t) (a->until[to] - to);
              }
        }
    }
  band->failed = !good;
}

/* One list of runs of those of the bands. */
static CeldStatus
gather_runs (const Ascent *a)
{
  CeldBasins *basins = a->basins;
  size_t      n = 0;

  for (int i = 0; i < a->n_bands; i++)
    n += a->band[i].n_runs;
  basins->run = celd_alloc (n, sizeof *basins->run);
  if (!basins->run)
    return CELD_NO_MEMORY;
  n = 0;
  for (int i = 0; i < a->n_bands; i++)
    {
      memcpy (basins->run + n, a->band[i].run, a->band[i].n_runs * sizeof *basins->run);
      for (int y = band_top (i); y < band_end (a, i); y++)
        basins->row[y] += n;
      n += a->band[i].n_runs;
    }
  basins->row[a->height] = n;
  return CELD_OK;
}

/* ------------------------------------------------------------------ all of it */

static CeldStatus
run_bands (Ascent *a, void (*body) (void *data, int job), const CeldRun *run, double from, double to)
{
  int        n = a->n_bands, at_once = a->n_desks;
  CeldStatus status = CELD_OK;

  for (a->first = 0; a->first < n && status == CELD_OK; a->first += at_once)
    {
      celd_each (run, n - a->first < at_once ? n - a->first : at_once, body, a);
      status = celd_step (run, from + (to - from) * (a->first + at_once < n ? (double) (a->first + at_once) / n : 1));
    }
  for (int i = 0; i < n && status == CELD_OK; i++)
    status = a->band[i].failed ? CELD_NO_MEMORY : CELD_OK;
  return status;
}

static CeldStatus
ascent_new (const CeldPlot *plot, const CeldRun *run, CeldBasins *basins, Ascent *a)
{
  size_t w = (size_t) plot->box.width, h = (size_t) plot->box.height, n_bands = (h + BAND - 1) / BAND;
  bool   good;

  *a = (Ascent) {
    .plot    = plot, .width = plot->box.width, .height = plot->box.height,
    .core    = plot->stroke > 2 ? plot->stroke * plot->stroke : 4,
    .edge    = celd_alloc (n_bands * w, 2 * sizeof *a->edge),
    .until   = celd_alloc (n_bands * w, 2 * sizeof *a->until),
    .band    = celd_alloc0 (n_bands, sizeof *a->band),
    .n_bands = (int) n_bands, .n_desks = run && run->each ? JOBS : 1, .basins = basins,
  };
  basins->row = celd_alloc (h + 1, sizeof *basins->row);
  good = a->edge && a->until && a->band && basins->row;
  for (int i = 0; i < a->n_desks; i++)
    {
      a->desk[i] = (Desk) {
        .relief = celd_alloc (w + 2, 3 * sizeof *a->desk->relief),
        .lead   = celd_alloc0 (w + 2, (BAND + 2) * sizeof *a->desk->lead),
        .step   = celd_alloc (w, BAND * sizeof *a->desk->step),
        .begins = celd_alloc (w, sizeof *a->desk->begins),
      };
      good = good && a->desk[i].relief && a->desk[i].lead && a->desk[i].step && a->desk[i].begins;
    }
  return good ? CELD_OK : CELD_NO_MEMORY;
}

static void
ascent_clear (Ascent *a)
{
  for (int i = 0; i < a->n_desks; i++)
    {
      celd_free (a->desk[i].relief);
      celd_free (a->desk[i].lead);
      celd_free (a->desk[i].step);
      celd_free (a->desk[i].begins);
    }
  for (int i = 0; a->band && i < a->n_bands; i++)
    {
      celd_free (a->band[i].maximum);
      celd_free (a->band[i].stretch);
      celd_free (a->band[i].run);
    }
  celd_free (a->band);
  celd_free (a->edge);
  celd_free (a->until);
}

CeldStatus
celd_basins_ascend (const CeldPlot *plot, const CeldRun *run, CeldBasins *basins)
{
  Ascent     a;
  CeldStatus status = ascent_new (plot, run, basins, &a);

  if (status == CELD_OK)
    status = run_bands (&a, lead_band, run, 0, 0.8);
  if (status == CELD_OK)
    status = make_basins (&a);
  if (status == CELD_OK)
    {
      lead_edges (&a);
      status = run_bands (&a, find_runs, run, 0.8, 1);
    }
  if (status == CELD_OK)
    status = gather_runs (&a);
  ascent_clear (&a);
  return status;
}
