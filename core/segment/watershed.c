/* Basins by steepest ascent: a watershed transform in which every pixel leads to its highest neighbour, and at last to
 * a maximum.
 *
 * The relief is the signed squared distance, but deeper in ink than T it rises again: d^2 - 2 T^2.  Ties are broken by
 * the order of pixels, so there are no plateaus: among 4-neighbours of equal height the later one in reading order
 * counts as higher.  Diagonal neighbours must be higher by the relief alone: a diagonal line one pixel wide has paper
 * at distance 1 on both sides, which must not lead across it.
 *
 * Bands of rows lead their pixels to maxima, or out of the band (watershed-bands.c).  Then the first and last rows of
 * all bands are led to their maxima, and with them all other pixels, as runs.
 *
 * Cost: O(pixels) time; workspace for a band, and half a byte a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "segment/basin-steps.h"
#include "segment/basins.h"

/* ------------------------------------------------------------------ basins */

/* Numbers the maxima of all bands, and makes their basins. */
static CeldStatus
make_basins (const CeldWatershed *a)
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
        int32_t  squared = a->extent->squared[y * a->extent->stride + x];

        basins->basin[a->band[i].first + j] = (CeldBasin) {
          .x = a->extent->box.x + (int32_t) x, .y = a->extent->box.y + (int32_t) y,
          .squared = squared > 0 ? squared : -squared, .solid = squared < 0,
        };
      }
  return CELD_OK;
}

/* The basin of a lead with CELD_LEAD_MAXIMUM. */
static inline uint32_t
basin_of (const CeldWatershedBand *band, uint32_t lead)
{
  uint32_t number = (lead & (CELD_OLD_BASIN - 1)) / 2;

  return lead & CELD_OLD_BASIN ? CELD_OLD_BASIN | number : (uint32_t) band->first + number;
}

/* Replaces the leads of the first and last rows of all bands by basins. */
static void
lead_edges (const CeldWatershed *a)
{
  uint32_t *edge = a->edge, w = (uint32_t) a->width, n = 2 * w * (uint32_t) a->n_bands;

  for (uint32_t p = 0; p < n; p++)
    if (edge[p] & CELD_LEAD_MAXIMUM)
      edge[p] = CELD_LEAD_MAXIMUM | basin_of (&a->band[p / (2 * w)], edge[p]);
  for (uint32_t p = 0; p < n; p++)
    {
      uint32_t to = edge[p];

      while (!(to & CELD_LEAD_MAXIMUM))
        to = edge[to];
      for (uint32_t q = p, next; !(edge[q] & CELD_LEAD_MAXIMUM); q = next)
        {
          next = edge[q];
          edge[q] = to;
        }
    }
  for (uint32_t p = n; p-- > 0;)
    {
      edge[p] &= ~CELD_LEAD_MAXIMUM;
      a->until[p] = (p + 1) % w && edge[p + 1] == edge[p] ? a->until[p + 1] : p + 1;
    }
}

/* Adds a run of a basin that starts at x, unless it continues the last one of the row. */
static bool
add_run (CeldWatershedBand *band, size_t row, int x, uint32_t basin)
{
  if (band->n_runs > row && band->run[band->n_runs - 1].basin == basin)
    return true;
  return celd_append (band->run, band->n_runs, band->run_capacity, (CeldBasinRun) { x, basin }) == CELD_OK;
}

/* Finds the runs of a band; basins->row gets their places within the band. */
static void
find_runs (void *data, int job)
{
  const CeldWatershed *a = data;
  int                  at = a->first + job, top = celd_watershed_band_top (at);
  int                  n = celd_watershed_band_end (a, at) - top;
  CeldWatershedBand   *band = &a->band[at];
  bool                 good = true;

  for (int i = 0; i < n; i++)
    {
      size_t row = a->basins->row[top + i] = band->n_runs;

      for (size_t k = band->row[i]; k < band->row[i + 1] && good; k++)
        {
          CeldLeadStretch s = band->stretch[k];
          int             end = k + 1 < band->row[i + 1] ? band->stretch[k + 1].x : a->width;
          uint32_t        to = s.lead;

          if (to & CELD_LEAD_MAXIMUM)
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

/* Joins the runs of all bands to one list. */
static CeldStatus
gather_runs (const CeldWatershed *a)
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
      for (int y = celd_watershed_band_top (i); y < celd_watershed_band_end (a, i); y++)
        basins->row[y] += n;
      n += a->band[i].n_runs;
    }
  basins->row[a->height] = n;
  return CELD_OK;
}

/* ------------------------------------------------------------------ the whole */

static CeldStatus
run_bands (CeldWatershed *a, void (*body) (void *data, int job), const CeldHost *host, double from, double to)
{
  CeldStatus status = celd_parallel_rounds (host, a->n_bands, a->n_jobs, body, a, &a->first, from, to);

  for (int i = 0; i < a->n_bands && status == CELD_OK; i++)
    status = a->band[i].failed ? CELD_NO_MEMORY : CELD_OK;
  return status;
}

static CeldStatus
ascent_new (const CeldBasinExtent *extent, const CeldHost *host, CeldBasins *basins, CeldWatershed *a)
{
  size_t w = (size_t) extent->box.width, h = (size_t) extent->box.height;
  size_t n_bands = (h + CELD_WATERSHED_BAND - 1) / CELD_WATERSHED_BAND;
  bool   good;

  *a = (CeldWatershed) {
    .extent    = extent, .width = extent->box.width, .height = extent->box.height,
    .core    = extent->stroke > 2 ? extent->stroke * extent->stroke : 4,
    .edge    = celd_alloc (n_bands * w, 2 * sizeof *a->edge),
    .until   = celd_alloc (n_bands * w, 2 * sizeof *a->until),
    .band    = celd_alloc0 (n_bands, sizeof *a->band),
    .n_bands = (int) n_bands, .n_jobs = host && host->each ? CELD_WATERSHED_JOBS : 1, .basins = basins,
  };
  basins->row = celd_alloc (h + 1, sizeof *basins->row);
  good = a->edge && a->until && a->band && basins->row;
  for (int i = 0; i < a->n_jobs; i++)
    {
      a->scratch[i] = (CeldWatershedScratch) {
        .relief = celd_alloc (w + 2, 3 * sizeof *a->scratch->relief),
        .lead   = celd_alloc0 (w + 2, (CELD_WATERSHED_BAND + 2) * sizeof *a->scratch->lead),
        .step   = celd_alloc (w, CELD_WATERSHED_BAND * sizeof *a->scratch->step),
        .begins = celd_alloc (w, sizeof *a->scratch->begins),
      };
      good = good && a->scratch[i].relief && a->scratch[i].lead && a->scratch[i].step && a->scratch[i].begins;
    }
  return good ? CELD_OK : CELD_NO_MEMORY;
}

static void
ascent_clear (CeldWatershed *a)
{
  for (int i = 0; i < a->n_jobs; i++)
    {
      celd_free (a->scratch[i].relief);
      celd_free (a->scratch[i].lead);
      celd_free (a->scratch[i].step);
      celd_free (a->scratch[i].begins);
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
celd_basins_ascend (const CeldBasinExtent *extent, const CeldHost *host, CeldBasins *basins)
{
  CeldWatershed a;
  CeldStatus    status = ascent_new (extent, host, basins, &a);

  if (status == CELD_OK)
    status = run_bands (&a, celd_watershed_lead_band, host, 0, 0.8);
  if (status == CELD_OK)
    status = make_basins (&a);
  if (status == CELD_OK)
    {
      lead_edges (&a);
      status = run_bands (&a, find_runs, host, 0.8, 1);
    }
  if (status == CELD_OK)
    status = gather_runs (&a);
  ascent_clear (&a);
  return status;
}
