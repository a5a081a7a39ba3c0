/* The shape of a part: coverage, where it ends, and where its surface goes on into another part.
 *
 * A surface goes on where a part ends without a line: at the frame, and where neither side of the border has ink near
 * it.  At the page it always ends.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief/parts.h"

#include <math.h>

#define LEAST_CROSSING 0.02f /* of an outline from a pixel's centre: vertices stay apart, also in STL; chosen */

float
celd_part_crossing (const CeldPart *part, size_t inside, size_t outside)
{
  float in = part->coverage[inside], out = part->coverage[outside];

  return fminf (fmaxf ((in - CELD_COVERED) / (in - out), LEAST_CROSSING), 1 - LEAST_CROSSING);
}

/* ------------------------------------------------------------------ coverage */

/* Reads the coverage of the box without its margin. */
static CeldStatus
read_coverage (const CeldParts *parts, size_t k, CeldPart *part)
{
  CeldRect box = { part->box.x + 1, part->box.y + 1, part->box.width - 2, part->box.height - 2 };
  float   *coverage = celd_alloc ((size_t) box.width * (size_t) box.height, sizeof *coverage);

  if (!coverage)
    return CELD_NO_MEMORY;
  celd_sheet_coverage (parts->sheets, parts->own, k, box, coverage);
  for (int y = 0; y < box.height; y++)
    memcpy (&part->coverage[celd_part_at (part, 1, y + 1)], coverage + (size_t) y * (size_t) box.width,
            (size_t) box.width * sizeof *coverage);
  celd_free (coverage);
  return CELD_OK;
}

/* Joins neighbouring pixels outside the part. */
static void
join_outside (const CeldPart *part, uint32_t *root)
{
  int w = part->box.width, h = part->box.height;

  celd_roots (root, (size_t) w * (size_t) h);
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        uint32_t i = (uint32_t) celd_part_at (part, x, y);

        if (celd_part_has (part, x, y))
          continue;
        if (x + 1 < w && !celd_part_has (part, x + 1, y))
          celd_join (root, i, i + 1);
        if (y + 1 < h && !celd_part_has (part, x, y + 1))
          celd_join (root, i, i + (uint32_t) w);
      }
}

/* Closes holes in which only nearer parts are seen, such as pockets between two lines. */
static CeldStatus
close_holes (const CeldParts *parts, size_t k, CeldPart *part)
{
  int       w = part->box.width, h = part->box.height;
  size_t    n = (size_t) w * (size_t) h;
  uint32_t *root = celd_alloc (n, sizeof *root);
  uint8_t  *stays = celd_alloc0 (n, 1); /* of each root */

  if (!root || !stays)
    {
      celd_free (root);
      celd_free (stays);
      return CELD_NO_MEMORY;
    }
  join_outside (part, root);
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      if (x == 0 || y == 0 || x == w - 1 || y == h - 1 ||
          celd_part_seen (parts, part->box.x + x, part->box.y + y) <= k)
        stays[celd_root (root, (uint32_t) celd_part_at (part, x, y))] = 1;
  for (size_t i = 0; i < n; i++)
    if (!(part->coverage[i] > CELD_COVERED) && !stays[celd_root (root, (uint32_t) i)])
      part->coverage[i] = 1;
  celd_free (root);
  celd_free (stays);
  return CELD_OK;
}

/* Sets a pixel of the margin beyond the frame such that the outline lies half-way to its neighbour in the picture. */
static void
set_beyond (CeldPart *part, int x, int y, int from_x, int from_y)
{
  float inside = part->coverage[celd_part_at (part, from_x, from_y)];

  part->coverage[celd_part_at (part, x, y)] = inside > CELD_COVERED ? 1 - inside : 0;
}

static void
end_at_frame (const CeldParts *parts, CeldPart *part)
{
  int w = part->box.width, h = part->box.height;

  for (int y = 0; y < h; y++)
    {
      if (part->box.x < 0)
        set_beyond (part, 0, y, 1, y);
      if (part->box.x + w > parts->width)
        set_beyond (part, w - 1, y, w - 2, y);
    }
  for (int x = 0; x < w; x++)
    {
      if (part->box.y < 0)
        set_beyond (part, x, 0, x, 1);
      if (part->box.y + h > parts->height)
        set_beyond (part, x, h - 1, x, h - 2);
    }
}

/* ------------------------------------------------------------------ open edges */

/* Is there no ink at a pixel of the picture and round it? */
static bool
is_paper (const CeldPlane *ink, float threshold, int x, int y)
{
  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < ink->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < ink->width; u++)
      if (CELD_AT (ink, u, v) <= threshold)
        return false;
  return true;
}

/* Whether depth is not cut between two neighbouring pixels of the picture, or only near the end of a cut. */
static bool
is_joined (const CeldParts *parts, int x, int y, int to_x, int to_y)
{
  int left = x < to_x ? x : to_x, top = y < to_y ? y : to_y;

  return celd_are_linked (&parts->links, left, top, x == to_x) ||
         celd_has_detour (&parts->links, left, top, x == to_x);
}

/* Does the surface of part k go on from pixel (x,y) of the picture to one where the part is not? */
static bool
goes_on (const CeldParts *parts, size_t k, float threshold, int x, int y, int to_x, int to_y)
{
  size_t other;

  if (to_x < 0 || to_y < 0 || to_x >= parts->width || to_y >= parts->height)
    return true;
  other = celd_part_seen (parts, to_x, to_y);
  return celd_part_seen (parts, x, y) == k && other != k && !parts->sheets->item[other].page &&
         is_paper (parts->ink, threshold, x, y) && is_paper (parts->ink, threshold, to_x, to_y) &&
         is_joined (parts, x, y, to_x, to_y);
}

static void
find_open (const CeldParts *parts, size_t k, float threshold, CeldPart *part)
{
  for (int y = 1; y < part->box.height - 1; y++)
    for (int x = 1; x < part->box.width - 1; x++)
      for (int i = 0; i < 4 && celd_part_has (part, x, y); i++)
        {
          int to_x = x, to_y = y;

          celd_step (i, &to_x, &to_y);
          if (!celd_part_has (part, to_x, to_y) &&
              goes_on (parts, k, threshold, part->box.x + x, part->box.y + y, part->box.x + to_x, part->box.y + to_y))
            part->open[celd_part_at (part, x, y)] |= (uint8_t) (1 << i);
        }
}

/* ------------------------------------------------------------------ */

CeldStatus
celd_part_shape (const CeldParts *parts, size_t k, float threshold)
{
  const CeldSheet *sheet = &parts->sheets->item[k];
  CeldPart        *part = &parts->item[k];
  size_t           n;
  CeldStatus       status;

  part->page = sheet->page;
  part->box  = (CeldRect) { sheet->box.x - 1, sheet->box.y - 1, sheet->box.width + 2, sheet->box.height + 2 };
  if (part->page)
    return CELD_OK;
  n              = (size_t) part->box.width * (size_t) part->box.height;
  part->coverage = celd_alloc0 (n, sizeof *part->coverage);
  part->open     = celd_alloc0 (n, 1);
  status         = part->coverage && part->open ? read_coverage (parts, k, part) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = close_holes (parts, k, part);
  if (status != CELD_OK)
    return status;
  end_at_frame (parts, part);
  find_open (parts, k, threshold, part);
  return CELD_OK;
}
