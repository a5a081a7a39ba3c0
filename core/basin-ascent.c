/* Basins by steepest ascent: every pixel leads to the neighbour where the relief is greatest, and at last to a maximum.
 *
 * The relief is the signed squared distance, but deeper in ink than T it rises again: d^2 - 2 T^2.  Ties are broken by
 * the order of the pixels, so that no plateau is left: among 4-neighbours an equal one that comes later in reading order
 * is higher.  Diagonal neighbours must be higher by relief alone: a diagonal line one pixel wide has paper at distance 1
 * on both sides, which thus never leads across.
 *
 * Bands of rows: each pixel is led up to a maximum or to the first pixel outside its band, by sweeps down and up the
 * band.  Then the outermost rows of all bands are led to their maxima, and with them everything else, as runs.
 * O(pixels) time; one number a pixel, and some rows a job, of workspace.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "basin-steps.h"

#include <string.h>

#define BAND    32          /* rows a job */
#define JOBS    16          /* jobs between two reports of progress */
#define SWEEPS  4           /* down and up; what is left then is followed pixel by pixel */
#define UNKNOWN UINT32_MAX
#define NUMBER  (1u << 31)  /* the rest is a basin, not a pixel */

/* Where a pixel leads: not at all, three steps up, three down, two sideways. */
enum { STAY, NORTH_WEST, NORTH, NORTH_EAST, SOUTH_WEST, SOUTH, SOUTH_EAST, EAST = 0x80, WEST };

/* What a band finds. */
typedef struct
{
  uint32_t     *maximum;    /* pixels in reading order */
  size_t        n;
  CeldBasinRun *run;
  size_t        n_runs;
  bool          failed;     /* no memory */
} Band;

typedef struct
{
  int            width, height;
  const int32_t *squared;
  int32_t        core;      /* of ink that is deeper the relief rises again */
  uint32_t      *lead;      /* of each pixel: a pixel on its way up, or NUMBER | its basin */
  uint8_t       *step;      /* BAND rows a job */
  int32_t       *relief;    /* 3 rows a job, each with a pixel more at both ends */
  uint32_t      *outside;   /* a row a job, likewise */
  Band          *band;
  size_t         n_bands;
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
static void
raise_row (const Ascent *a, int y, int32_t *restrict relief)
{
  const int32_t *squared = a->squared + (ptrdiff_t) y * a->width;
  int32_t        core = a->core;

  relief[0] = relief[a->width + 1] = INT32_MIN;
  for (int x = 0; x < a->width && (y < 0 || y >= a->height); x++)
    relief[x + 1] = INT32_MIN;
  for (int x = 0; x < a->width && y >= 0 && y < a->height; x++)
    relief[x + 1] = squared[x] < -core ? -squared[x] - 2 * core : squared[x];
}

/* The steps of a row; the rows of the relief start one pixel to the left. */
static void
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

/* Maxima lead to themselves. */
static void
start_row (int width, uint32_t pixel, const uint8_t *restrict step, uint32_t *restrict lead)
{
  for (int x = 0; x < width; x++)
    lead[x] = step[x] == STAY ? pixel + (uint32_t) x : UNKNOWN;
}

/* Takes over what is known in the row that the steps from first, first + 1, first + 2 (to the left, straight, to the
 * right) lead to. */
static void
take_over (int width, const uint8_t *restrict step, int first, const uint32_t *next, uint32_t *restrict lead)
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

static void
go_sideways (int width, const uint8_t *step, uint32_t *lead)
{
  for (int x = 1; x < width; x++)
    if (step[x] == WEST)
      lead[x] = lead[x - 1];
  for (int x = width - 2; x >= 0; x--)
    if (step[x] == EAST)
      lead[x] = lead[x + 1];
}

/* The row outside a band: there every pixel leads to itself, as far as the band is concerned. */
static const uint32_t *
outside_row (const Ascent *a, int job, int y)
{
  uint32_t *row = a->outside + (size_t) job * (size_t) (a->width + 2) + 1;

  for (int x = 0; x < a->width; x++)
    row[x] = (uint32_t) (y * a->width + x);
  return row;
}

static void
sweep (const Ascent *a, int job, const uint8_t *steps, int top, int end)
{
  int w = a->width;

  for (int y = top; y < end; y++)
    {
      const uint8_t *step = steps + (size_t) (y - top) * (size_t) w;
      uint32_t      *lead = a->lead + (size_t) y * (size_t) w;

      take_over (w, step, NORTH_WEST, y > top ? lead - w : outside_row (a, job, y - 1), lead);
      go_sideways (w, step, lead);
    }
  for (int y = end - 1; y >= top; y--)
    {
      const uint8_t *step = steps + (size_t) (y - top) * (size_t) w;
      uint32_t      *lead = a->lead + (size_t) y * (size_t) w;

      take_over (w, step, SOUTH_WEST, y + 1 < end ? lead + w : outside_row (a, job, y + 1), lead);
      go_sideways (w, step, lead);
    }
}

static inline ptrdiff_t
step_offset (uint8_t step, ptrdiff_t w)
{
  switch (step)
    {
    case EAST:
      return 1;
    case WEST:
      return -1;
    default:
      return step < SOUTH_WEST ? step - NORTH - w : step - SOUTH + w;
    }
}

/* Follows the steps of a pixel whose lead is unknown, and tells all pixels on the way. */
static void
follow (const Ascent *a, const uint8_t *steps, size_t first, size_t end, size_t p)
{
  size_t   w = (size_t) a->width, q = p;
  uint32_t to;

  while (q >= first && q < end && a->lead[q] == UNKNOWN)
    q = (size_t) ((ptrdiff_t) q + step_offset (steps[q - first], (ptrdiff_t) w));
  to = q >= first && q < end ? a->lead[q] : (uint32_t) q;
  for (q = p; q >= first && q < end && a->lead[q] == UNKNOWN;)
    {
      a->lead[q] = to;
      q = (size_t) ((ptrdiff_t) q + step_offset (steps[q - first], (ptrdiff_t) w));
    }
}

static void
lead_band (void *data, int job)
{
  const Ascent *a = data;
  int           w = a->width, band = a->first + job, top = band_top (band), end = band_end (a, band);
  size_t        row_size = (size_t) w + 2, first = (size_t) top * (size_t) w, last = (size_t) end * (size_t) w;
  int32_t      *relief = a->relief + (size_t) job * 3 * row_size;
  uint8_t      *steps = a->step + (size_t) job * BAND * (size_t) w;
  Band         *found = &a->band[band];

  raise_row (a, top - 1, relief);
  raise_row (a, top, relief + row_size);
  for (int y = top; y < end; y++)
    {
      size_t   i = (size_t) (y - top);
      uint8_t *step = steps + i * (size_t) w;

      raise_row (a, y + 1, relief + (i + 2) % 3 * row_size);
      find_steps (w, relief + i % 3 * row_size, relief + (i + 1) % 3 * row_size, relief + (i + 2) % 3 * row_size, step);
      start_row (w, (uint32_t) (y * w), step, a->lead + (size_t) y * (size_t) w);
      for (int x = 0; x < w; x++)
        if (step[x] == STAY)
          {
            uint32_t *maximum = celd_grow (found->maximum, found->n + 1, sizeof *maximum);

            if (!maximum)
              {
                found->failed = true;
                return;
              }
            found->maximum = maximum;
            maximum[found->n++] = (uint32_t) (y * w + x);
          }
    }
  for (int i = 0; i < SWEEPS; i++)
    sweep (a, job, steps, top, end);
  for (size_t p = first; p < last; p++)
    if (a->lead[p] == UNKNOWN)
      follow (a, steps, first, last, p);
}

/* ------------------------------------------------------------------ basins */

/* Numbers the maxima. */
static CeldStatus
make_basins (const Ascent *a)
{
  CeldBasins *basins = a->basins;

  basins->n = 0;
  for (size_t i = 0; i < a->n_bands; i++)
    basins->n += a->band[i].n;
  basins->basin = celd_alloc (basins->n, sizeof *basins->basin);
  if (!basins->basin)
    return CELD_NO_MEMORY;
  for (size_t i = 0, k = 0; i < a->n_bands; i++)
    for (size_t j = 0; j < a->band[i].n; j++, k++)
      {
        uint32_t p = a->band[i].maximum[j];
        int32_t  squared = a->squared[p];

        a->lead[p] = NUMBER | (uint32_t) k;
        basins->basin[k] = (CeldBasin) {
          .x = (int32_t) (p % (uint32_t) a->width), .y = (int32_t) (p / (uint32_t) a->width),
          .squared = squared > 0 ? squared : -squared, .solid = squared < 0,
        };
      }
  return CELD_OK;
}

/* Leads the pixels of an outermost row of a band to their basins. */
static void
lead_row (const Ascent *a, int y)
{
  uint32_t *lead = a->lead;

  for (uint32_t p = (uint32_t) (y * a->width); p < (uint32_t) ((y + 1) * a->width); p++)
    {
      uint32_t to = p;

      while (!(lead[to] & NUMBER))
        to = lead[to];
      to = lead[to];
      for (uint32_t q = p, next; !(lead[q] & NUMBER); q = next)
        {
          next = lead[q];
          lead[q] = to;
        }
    }
}

/* The runs of a band: basins->row gets their places within the band. */
static void
find_runs (void *data, int job)
{
  const Ascent *a = data;
  int           band = a->first + job;
  Band         *found = &a->band[band];

  for (int y = band_top (band); y < band_end (a, band); y++)
    {
      const uint32_t *lead = a->lead + (size_t) y * (size_t) a->width;
      uint32_t        last = 0, basin = UNKNOWN;

      a->basins->row[y] = found->n_runs;
      for (int x = 0; x < a->width; x++)
        {
          uint32_t      to = lead[x];
          CeldBasinRun *run;

          if (to == last && x > 0)
            continue;
          last = to;
          to = (to & NUMBER ? to : a->lead[to]) & ~NUMBER;
          if (to == basin)
            continue;
          basin = to;
          run = celd_grow (found->run, found->n_runs + 1, sizeof *run);
          if (!run)
            {
              found->failed = true;
              return;
            }
          found->run = run;
          run[found->n_runs++] = (CeldBasinRun) { x, basin };
        }
    }
}

/* One list of runs of those of the bands. */
static CeldStatus
gather_runs (const Ascent *a)
{
  CeldBasins *basins = a->basins;
  size_t      n = 0;

  for (size_t i = 0; i < a->n_bands; i++)
    n += a->band[i].n_runs;
  basins->run = celd_alloc (n, sizeof *basins->run);
  if (!basins->run)
    return CELD_NO_MEMORY;
  n = 0;
  for (int i = 0; i < (int) a->n_bands; i++)
    {
      memcpy (basins->run + n, a->band[i].run, a->band[i].n_runs * sizeof *basins->run);
      for (int y = band_top (i); y < band_end (a, i); y++)
        basins->row[y] += n;
      n += a->band[i].n_runs;
    }
  basins->row[a->height] = n;
  for (int y = 0; y < a->height; y++)
    for (size_t i = basins->row[y]; i < basins->row[y + 1]; i++)
      basins->basin[basins->run[i].basin].area +=
        (uint32_t) ((i + 1 < basins->row[y + 1] ? basins->run[i + 1].x : a->width) - basins->run[i].x);
  return CELD_OK;
}

/* ------------------------------------------------------------------ all of it */

static CeldStatus
run_bands (Ascent *a, void (*body) (void *data, int job), const CeldRun *run, double from, double to)
{
  int        n = (int) a->n_bands;
  CeldStatus status = CELD_OK;

  for (a->first = 0; a->first < n && status == CELD_OK; a->first += JOBS)
    {
      celd_each (run, n - a->first < JOBS ? n - a->first : JOBS, body, a);
      status = celd_step (run, from + (to - from) * (a->first + JOBS < n ? (double) (a->first + JOBS) / n : 1));
    }
  for (int i = 0; i < n && status == CELD_OK; i++)
    status = a->band[i].failed ? CELD_NO_MEMORY : CELD_OK;
  return status;
}

CeldStatus
celd_basins_ascend (const int32_t *squared, const CeldRun *run, CeldBasins *basins)
{
  size_t     w = (size_t) basins->width, h = (size_t) basins->height;
  uint32_t  *lead = celd_alloc (w * h + 2, sizeof *lead); /* the sweeps look a pixel beyond both ends */
  Ascent     a = {
    .width = basins->width, .height = basins->height, .squared = squared, .core = celd_stroke_core (basins->stroke),
    .step    = celd_alloc (w * BAND * JOBS, sizeof *a.step),
    .relief  = celd_alloc ((w + 2) * 3 * JOBS, sizeof *a.relief),
    .outside = celd_alloc0 ((w + 2) * JOBS, sizeof *a.outside),
    .n_bands = (h + BAND - 1) / BAND, .basins = basins,
  };
  CeldStatus status = CELD_NO_MEMORY;

  a.band = celd_alloc0 (a.n_bands, sizeof *a.band);
  basins->row = celd_alloc (h + 1, sizeof *basins->row);
  if (!lead || !a.step || !a.relief || !a.outside || !a.band || !basins->row)
    goto done;
  lead[0] = lead[w * h + 1] = UNKNOWN;
  a.lead = lead + 1;
  status = run_bands (&a, lead_band, run, 0, 0.6);
  if (status == CELD_OK)
    status = make_basins (&a);
  for (int i = 0; i < (int) a.n_bands && status == CELD_OK; i++)
    {
      lead_row (&a, band_top (i));
      lead_row (&a, band_end (&a, i) - 1);
    }
  if (status == CELD_OK)
    status = run_bands (&a, find_runs, run, 0.6, 1);
  if (status == CELD_OK)
    status = gather_runs (&a);

done:
  for (size_t i = 0; a.band && i < a.n_bands; i++)
    {
      celd_free (a.band[i].maximum);
      celd_free (a.band[i].run);
    }
  celd_free (a.band);
  celd_free (a.outside);
  celd_free (a.relief);
  celd_free (a.step);
  celd_free (lead);
  return status;
}
