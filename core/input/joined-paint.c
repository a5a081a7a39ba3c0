/* Which paint belongs to which of several arrows that are joined: that nearest to their lines.
 *
 * Cost: a distance transform of the paint's box.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "input/joined-arrows.h"

/* Marks the points of lines whose arrow is told of, and whose they are. */
static void
mark_lines (const CeldJoinedLines *s, const CeldLineArrow *arrows, const bool *told, uint8_t *marked, uint32_t *arrow)
{
  for (size_t k = 0; k < s->graph.n_lines; k++)
    for (size_t i = 0; i < s->graph.line[k].n && told[arrows[k].first]; i++)
      {
        CeldPoint p = s->graph.line[k].at[i];

        if (!celd_joined_inside (s, p))
          continue;
        marked[celd_joined_pixel (s, p)] = 1;
        arrow[celd_joined_pixel (s, p)]  = (uint32_t) arrows[k].first;
      }
}

CeldStatus
celd_joined_paint_divide (const CeldJoinedLines *s, const CeldLineArrow *arrows, const bool *told, uint32_t *owner)
{
  size_t     n = (size_t) s->mask.width * (size_t) s->mask.height;
  uint8_t   *marked = celd_alloc0 (n, sizeof *marked);
  uint32_t  *arrow = celd_alloc (n, sizeof *arrow);
  int32_t   *squared = celd_alloc (n, sizeof *squared), *nearest = celd_alloc (n, sizeof *nearest);
  CeldStatus status = marked && arrow && squared && nearest ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      mark_lines (s, arrows, told, marked, arrow);
      status = celd_nearest (s->mask.width, s->mask.height, marked, NULL, squared, nearest);
    }
  for (size_t i = 0; i < s->stroke->n && status == CELD_OK; i++)
    {
      CeldPoint p = celd_joined_in_mask (s, celd_stroke_point (s->stroke, s->stroke->pixel[i]));
      int32_t   from = nearest[celd_joined_pixel (s, p)];

      owner[i] = from < 0 ? UINT32_MAX : arrow[from];
    }
  celd_free (marked);
  celd_free (arrow);
  celd_free (squared);
  celd_free (nearest);
  return status;
}
