/* Names the sheets whose hidden part is large and hardly more than a guess, each with a place where a stroke of the
 * artist tells most: the pixel deepest in what is unsure of it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "sheets/sheets.h"

#define LARGE_HIDDEN 0.01 /* of the page, of a hidden part that is worth a message; chosen */
#define UNSURE       0.35 /* mean confidence below which it is named, as 11 of 428 regions of tests/cases are; chosen */

static bool
is_unsure (const CeldSheets *sheets, const CeldSheet *sheet)
{
  uint64_t pixels = 0, coverage = 0, confidence = 0;

  for (size_t i = 0; i < sheet->n_hidden; i++)
    {
      pixels     += sheet->coverage[i] > 0;
      coverage   += sheet->coverage[i];
      confidence += (uint64_t) sheet->coverage[i] * sheet->confidence[i];
    }
  return (double) pixels >= LARGE_HIDDEN * sheets->width * sheets->height &&
         (double) confidence < 255 * UNSURE * (double) coverage;
}

/* Sets sure[p] to 0 for each unsure pixel of the silhouette, in a frame of others round the hidden pixels. */
static void
mark_unsure (const CeldSheet *sheet, CeldRect frame, uint8_t *sure)
{
  memset (sure, 1, (size_t) frame.width * (size_t) frame.height);
  for (size_t i = 0; i < sheet->n_runs; i++)
    {
      const CeldSheetRun *run = &sheet->run[i];
      uint8_t            *row = sure + (size_t) (run->y - frame.y) * (size_t) frame.width + (run->x - frame.x);

      for (int x = 0; x < run->n; x++)
        row[x] = !sheet->coverage[run->first + (size_t) x] ||
                 sheet->confidence[run->first + (size_t) x] >= 255 * UNSURE;
    }
}

/* Finds the unsure pixel farthest from all others. */
static CeldStatus
find_place (const CeldSheet *sheet, int *x, int *y)
{
  CeldRect   frame = { 0 };
  size_t     n, deepest = 0;
  uint8_t   *sure;
  int32_t   *squared;
  CeldStatus status = CELD_NO_MEMORY;

  for (size_t i = 0; i < sheet->n_runs; i++)
    frame = celd_rect_union (frame, (CeldRect) { sheet->run[i].x - 1, sheet->run[i].y - 1, sheet->run[i].n + 2, 3 });
  n       = (size_t) frame.width * (size_t) frame.height;
  sure    = celd_alloc (n, sizeof *sure);
  squared = celd_alloc (n, sizeof *squared);
  if (sure && squared)
    {
      mark_unsure (sheet, frame, sure);
      status = celd_distance (frame.width, frame.height, sure, NULL, squared);
    }
  if (status == CELD_OK)
    {
      for (size_t p = 1; p < n; p++)
        deepest = squared[p] > squared[deepest] ? p : deepest;
      *x = frame.x + (int) (deepest % (size_t) frame.width);
      *y = frame.y + (int) (deepest / (size_t) frame.width);
    }
  celd_free (sure);
  celd_free (squared);
  return status;
}

CeldStatus
celd_sheet_problems (const CeldSheets *sheets, CeldProblems *problems)
{
  size_t     before = problems->n;
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < sheets->n && status == CELD_OK; k++)
    if (is_unsure (sheets, &sheets->item[k]))
      {
        CeldProblem problem = {
          .kind = CELD_PROBLEM_HIDDEN_UNSURE, .label = sheets->item[k].label, .relation = CELD_NO_INDEX };

        status = find_place (&sheets->item[k], &problem.x, &problem.y);
        if (status == CELD_OK)
          status = celd_problem_add (problems, problem);
      }
  if (status != CELD_OK)
    problems->n = before;
  return status;
}
