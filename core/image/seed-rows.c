/* Seeds as runs by row.  Touching runs of one label are joined, so equal seeds are equal records, whatever order they
 * were painted in.
 *
 * Cost: painting takes the number of runs in the row; everything else the number of all runs and of rows.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"

#include <string.h>

CeldStatus
celd_seed_rows_new (int width, int height, CeldSeedRows *seeds)
{
  CeldSeedRow *row = celd_alloc0 ((size_t) height, sizeof *row);

  if (!row)
    return CELD_NO_MEMORY;
  *seeds = (CeldSeedRows) { width, height, row };
  return CELD_OK;
}

void
celd_seed_rows_clear (CeldSeedRows *seeds)
{
  for (int y = 0; y < seeds->height; y++)
    celd_free (seeds->row[y].run);
  celd_free (seeds->row);
  *seeds = (CeldSeedRows) { 0 };
}

/* ------------------------------------------------------------------ from and to pixels */

static CeldStatus
append (CeldSeedRow *row, CeldSeedRun run)
{
  return celd_append (row->run, row->n, row->run_capacity, run);
}

static CeldStatus
read_row (const uint32_t *label, int width, CeldSeedRow *row)
{
  CeldStatus status = CELD_OK;

  for (int x = 0, end; x < width && status == CELD_OK; x = end)
    {
      for (end = x + 1; end < width && label[end] == label[x]; end++)
        ;
      if (label[x])
        status = append (row, (CeldSeedRun) { x, end, label[x] });
    }
  return status;
}

CeldStatus
celd_seed_rows_read (const CeldLabels *labels, CeldSeedRows *seeds)
{
  CeldSeedRows made = { 0 };
  CeldStatus   status = celd_seed_rows_new (labels->width, labels->height, &made);

  for (int y = 0; y < made.height && status == CELD_OK; y++)
    status = read_row (&CELD_AT (labels, 0, y), made.width, &made.row[y]);
  if (status == CELD_OK)
    *seeds = made;
  else
    celd_seed_rows_clear (&made);
  return status;
}

CeldStatus
celd_seed_rows_copy (const CeldSeedRows *from, CeldSeedRows *seeds)
{
  CeldSeedRows made = { 0 };
  CeldStatus   status = celd_seed_rows_new (from->width, from->height, &made);

  for (int y = 0; y < made.height && status == CELD_OK; y++)
    {
      const CeldSeedRow *row = &from->row[y];

      if (!row->n)
        continue;
      made.row[y].run = celd_alloc (row->n, sizeof *row->run);
      if (!made.row[y].run)
        status = CELD_NO_MEMORY;
      else
        memcpy (made.row[y].run, row->run, row->n * sizeof *row->run);
      made.row[y].n = made.row[y].run ? row->n : 0;
    }
  if (status == CELD_OK)
    *seeds = made;
  else
    celd_seed_rows_clear (&made);
  return status;
}

void
celd_seed_rows_write (const CeldSeedRows *seeds, CeldLabels *labels)
{
  for (int y = 0; y < seeds->height; y++)
    {
      const CeldSeedRow *row = &seeds->row[y];
      uint32_t          *label = &CELD_AT (labels, 0, y);

      memset (label, 0, (size_t) seeds->width * sizeof *label);
      for (size_t i = 0; i < row->n; i++)
        for (int x = row->run[i].x; x < row->run[i].end; x++)
          label[x] = row->run[i].label;
    }
}

/* ------------------------------------------------------------------ single runs */

/* The index of the first run of a row that ends after x; row->n: none. */
static size_t
first_behind (const CeldSeedRow *row, int x)
{
  size_t low = 0, high = row->n;

  while (low < high)
    {
      size_t middle = (low + high) / 2;

      if (row->run[middle].end > x)
        high = middle;
      else
        low = middle + 1;
    }
  return low;
}

/* Appends a run to the n pieces to its left, or extends the last of them; returns their number. */
static size_t
join (CeldSeedRun *piece, size_t n, CeldSeedRun run)
{
  if (run.x >= run.end || !run.label)
    return n;
  if (n && piece[n - 1].end == run.x && piece[n - 1].label == run.label)
    piece[n - 1].end = run.end;
  else
    piece[n++] = run;
  return n;
}

/* Replaces run[first] .. run[last - 1] by `pieces` runs, at most two more. */
static CeldStatus
replace (CeldSeedRow *row, size_t first, size_t last, const CeldSeedRun *piece, size_t pieces)
{
  size_t n = row->n - (last - first) + pieces;

  if (n > row->n && !celd_reserve (&row->run, n, &row->run_capacity, sizeof *row->run))
    return CELD_NO_MEMORY;
  if (row->n > last)
    memmove (row->run + first + pieces, row->run + last, (row->n - last) * sizeof *piece);
  if (pieces)
    memcpy (row->run + first, piece, pieces * sizeof *piece);
  row->n = n;
  return CELD_OK;
}

CeldStatus
celd_seed_rows_paint (CeldSeedRows *seeds, int y, int x, int end, uint32_t label)
{
  CeldSeedRow *row;
  CeldSeedRun  piece[3];
  size_t       first, last, n = 0;

  x   = x < 0 ? 0 : x;
  end = end > seeds->width ? seeds->width : end;
  if (y < 0 || y >= seeds->height || x >= end)
    return CELD_OK;
  row   = &seeds->row[y];
  first = first_behind (row, x - 1); /* a run that only touches may be joined */
  for (last = first; last < row->n && row->run[last].x <= end; last++)
    ;
  if (first < last)
    {
      CeldSeedRun left = row->run[first];

      left.end = left.end < x ? left.end : x;
      n = join (piece, n, left);
    }
  n = join (piece, n, (CeldSeedRun) { x, end, label });
  if (first < last)
    {
      CeldSeedRun right = row->run[last - 1];

      right.x = right.x > end ? right.x : end;
      n = join (piece, n, right);
    }
  return replace (row, first, last, piece, n);
}

uint32_t
celd_seed_rows_at (const CeldSeedRows *seeds, int x, int y)
{
  const CeldSeedRow *row = &seeds->row[y];
  size_t             i = first_behind (row, x);

  return i < row->n && row->run[i].x <= x ? row->run[i].label : 0;
}
