/* Leads each pixel of a band of rows to a maximum, or to the first pixel outside the band.
 *
 * The steps of all pixels are computed row by row from the relief.  Sweeps down and up the band then copy leads along
 * the steps; the few pixels left, whose paths turn back and forth, are followed one by one.  Neighbouring pixels mostly
 * lead to the same place or to neighbouring places, and are stored as such stretches.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "segment/basin-steps.h"
#include "segment/basins.h"

#define UNKNOWN UINT32_MAX

/* The step of a pixel: three upwards, three downwards, and from STEP_NONE on those within its row.  STEP_KEEP: the
 * pixel keeps its old basin. */
enum { STEP_NORTH_WEST, STEP_NORTH, STEP_NORTH_EAST, STEP_SOUTH_WEST, STEP_SOUTH, STEP_SOUTH_EAST, STEP_NONE = 0x80,
       STEP_EAST, STEP_WEST, STEP_KEEP };

/* ------------------------------------------------------------------ steps */

/* Computes row y of the relief, with the lowest value at both sides and outside the picture. */
CELD_CLONES static void
raise_row (const CeldWatershed *a, int y, int32_t *restrict relief)
{
  bool           inside = y >= 0 && y < a->height;
  const int32_t *squared = a->extent->squared + (inside ? (size_t) y * a->extent->stride : 0);
  int32_t        core = a->core;

  relief[0] = relief[a->width + 1] = INT32_MIN;
  for (int x = 0; x < a->width && !inside; x++)
    relief[x + 1] = INT32_MIN;
  for (int x = 0; x < a->width && inside; x++)
    relief[x + 1] = squared[x] < -core ? -squared[x] - 2 * core : squared[x];
}

/* Finds the steps of a row; the rows of the relief start one pixel further left. */
CELD_CLONES static void
find_steps (int width, const int32_t *restrict above, const int32_t *restrict here, const int32_t *restrict below,
            uint8_t *restrict step)
{
  for (int x = 0; x < width; x++)
    {
      int32_t best = here[x + 1];
      int     to = STEP_NONE;

#define TRY(height, is_higher, where) \
  to = (height) is_higher best ? where : to; \
  best = (height) is_higher best ? (height) : best
      TRY (below[x + 1], >=, STEP_SOUTH);
      TRY (here[x + 2], >=, STEP_EAST);
      TRY (here[x], >, STEP_WEST);
      TRY (above[x + 1], >, STEP_NORTH);
      TRY (above[x], >, STEP_NORTH_WEST);
      TRY (above[x + 2], >, STEP_NORTH_EAST);
      TRY (below[x], >, STEP_SOUTH_WEST);
      TRY (below[x + 2], >, STEP_SOUTH_EAST);
#undef TRY
      step[x] = (uint8_t) to;
    }
}

/* ------------------------------------------------------------------ leads within a band */

/* Copies known leads from the row above or below along the steps first, first + 1, first + 2 (left, straight, right).
 */
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

/* Copies known leads along the row. */
static void
go_sideways (int width, const uint8_t *step, uint32_t *lead)
{
  for (int x = celd_next_marked (width, step, 0), end; x < width; x = celd_next_marked (width, step, end))
    {
      for (end = x + 1; end < width && step[end] == step[x]; end++)
        ;
      if (step[x] != STEP_NONE && lead[x] == UNKNOWN)
        {
          uint32_t to = lead[step[x] == STEP_EAST ? end : x - 1];

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
    case STEP_EAST:
      return 1;
    case STEP_WEST:
      return -1;
    default:
      return step < STEP_SOUTH_WEST ? step - STEP_NORTH - row_size : step - STEP_SOUTH + row_size;
    }
}

/* Follows the steps from a pixel whose lead is unknown, and sets the leads of all pixels on the way. */
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

/* Sets the leads of n rows: to maxima, or to the rows above and below, whose leads are set. */
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

        take_over (width, step + (size_t) y * w, down ? STEP_NORTH_WEST : STEP_SOUTH_WEST,
                   down ? row - row_size : row + row_size, row);
        go_sideways (width, step + (size_t) y * w, row);
      }
  for (int y = 0; y < n; y++)
    if (has_unknown (width, lead + (size_t) y * row_size))
      for (int x = 0; x < width; x++)
        if (lead[(size_t) y * row_size + (size_t) x] == UNKNOWN)
          follow (width, step + (size_t) y * w + x, lead + (size_t) y * row_size + x);
}

/* ------------------------------------------------------------------ a band */

/* Sets the leads of the pixels of row y that keep their old basins. */
static void
keep_row (const CeldWatershed *a, int y, uint8_t *step, uint32_t *lead)
{
  const CeldBasins   *old = a->extent->old;
  const uint8_t      *rebuilt = a->extent->rebuilt + (size_t) y * (size_t) a->width;
  int                 left = a->extent->box.x;
  const CeldBasinRun *run = old->run + old->row[a->extent->box.y + y];
  const CeldBasinRun *end = old->run + old->row[a->extent->box.y + y + 1];

  for (int x = 0; x < a->width; x++)
    {
      while (run + 1 < end && run[1].x <= left + x)
        run++;
      if (rebuilt[x])
        continue;
      step[x] = STEP_KEEP;
      lead[x] = CELD_LEAD_MAXIMUM | CELD_OLD_BASIN | 2 * run->basin;
    }
}

/* Starts a row: maxima lead to themselves, the rest is unknown. */
static bool
start_row (const CeldWatershed *a, int y, uint8_t *step, CeldWatershedBand *band, uint32_t *lead)
{
  memset (lead, 0xff, (size_t) a->width * sizeof *lead);
  if (a->extent->rebuilt)
    keep_row (a, y, step, lead);
  for (int x = celd_next_marked (a->width, step, 0); x < a->width; x = celd_next_marked (a->width, step, x + 1))
    if (step[x] == STEP_NONE)
      {
        lead[x] = CELD_LEAD_MAXIMUM | (uint32_t) (2 * band->n);
        if (celd_append (band->maximum, band->n, band->maximum_capacity, (uint32_t) (y * a->width + x)) != CELD_OK)
          return false;
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
note_stretches (int width, const uint32_t *lead, uint8_t *begins, CeldWatershedBand *band, int row)
{
  size_t n = band->row[row];

  mark_stretches (width, lead, begins);
  for (int x = 0; x < width; x = celd_next_marked (width, begins, x + 1))
    {
      bool varies = x + 1 < width && !begins[x + 1] && lead[x + 1] != lead[x];

      if (celd_append (band->stretch, n, band->stretch_capacity, (CeldLeadStretch) { x, varies, lead[x] }) != CELD_OK)
        return false;
    }
  band->row[row + 1] = n;
  return true;
}

void
celd_watershed_lead_band (void *data, int job)
{
  const CeldWatershed        *a = data;
  const CeldWatershedScratch *scratch = &a->scratch[job];
  int                         w = a->width, at = a->first + job, top = celd_watershed_band_top (at);
  int                         n = celd_watershed_band_end (a, at) - top;
  size_t                      row_size = (size_t) w + 2;
  uint32_t                   *lead = scratch->lead + row_size + 1, place = (uint32_t) (2 * at * w);
  CeldWatershedBand          *band = &a->band[at];

  raise_row (a, top - 1, scratch->relief);
  raise_row (a, top, scratch->relief + row_size);
  for (int i = 0; i < n && !band->failed; i++)
    {
      uint8_t *step = scratch->step + (size_t) i * (size_t) w;

      raise_row (a, top + i + 1, scratch->relief + (size_t) (i + 2) % 3 * row_size);
      find_steps (w, scratch->relief + (size_t) i % 3 * row_size, scratch->relief + (size_t) (i + 1) % 3 * row_size,
                  scratch->relief + (size_t) (i + 2) % 3 * row_size, step);
      band->failed = !start_row (a, top + i, step, band, lead + (size_t) i * row_size);
    }
  for (int x = 0; x < w; x++)
    {
      scratch->lead[x + 1] = place - (uint32_t) w + (uint32_t) x;
      lead[(size_t) n * row_size + (size_t) x] = place + 2 * (uint32_t) w + (uint32_t) x;
    }
  if (!band->failed)
    lead_rows (w, n, scratch->step, lead);
  for (int i = 0; i < n && !band->failed; i++)
    band->failed = !note_stretches (w, lead + (size_t) i * row_size, scratch->begins, band, i);
  memcpy (a->edge + place, lead, (size_t) w * sizeof *lead);
  memcpy (a->edge + place + w, lead + (size_t) (n - 1) * row_size, (size_t) w * sizeof *lead);
}
