/* Problems of painted arrows: why one is unclear, and its paint, so that it can be shown again.
 *
 * Paint is kept as runs of pixels.  What other colours hide of a stroke is no paint of it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrows.h"

/* Is a pixel of a stroke seen?  *k goes on along the pixels of its colour, which are in reading order, too. */
static bool
is_seen (const CeldStrokeCover *cover, uint32_t pixel, size_t *k)
{
  while (cover && *k < cover->n && cover->pixel[*k] < pixel)
    ++*k;
  return !cover || (*k < cover->n && cover->pixel[*k] == pixel && cover->seen[*k]);
}

/* Fills in the runs of a stroke, whose pixels are in reading order; NULL: only their number is wanted. */
static size_t
find_runs (const CeldArrowStroke *stroke, const CeldStrokeCover *cover, CeldPaintRun *run)
{
  uint32_t next = 0; /* rows have a border, so that no run goes on in the next row */
  size_t   n = 0, k = 0;

  for (size_t i = 0; i < stroke->n; i++)
    {
      uint32_t p = stroke->pixel[i];

      if (!is_seen (cover, p, &k))
        continue;
      if (run && p != next)
        run[n] = (CeldPaintRun) { celd_stroke_x (stroke, p), celd_stroke_y (stroke, p), 0 };
      n += p != next;
      if (run)
        run[n - 1].n++;
      next = p + 1;
    }
  return n;
}

CeldStatus
celd_arrow_problem_add (CeldProblems *problems, CeldArrowReason reason, CeldPoint at, const CeldArrowStroke *stroke,
                        const CeldStrokeCover *cover)
{
  CeldProblem problem = {
    .kind = CELD_PROBLEM_ARROW_UNCLEAR, .x = (int) at.x, .y = (int) at.y, .relation = CELD_NO_INDEX, .reason = reason,
  };
  CeldStatus status;

  if (!problems)
    return CELD_OK;
  problem.first = problems->n_runs;
  problem.runs  = find_runs (stroke, cover, NULL);
  if (!celd_reserve (&problems->run, problem.first + problem.runs, &(size_t) { 0 }, sizeof *problems->run))
    return CELD_NO_MEMORY;
  status = celd_problem_add (problems, problem);
  if (status == CELD_OK)
    problems->n_runs += find_runs (stroke, cover, problems->run + problem.first);
  return status;
}

CeldPoint
celd_stroke_middle (const CeldArrowStroke *stroke)
{
  return celd_stroke_point (stroke, stroke->pixel[stroke->n / 2]);
}
