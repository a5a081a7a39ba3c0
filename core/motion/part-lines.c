/* The lines of a part in a key: the outline of its layer, what is hidden of it included, and the ink that is seen on
 * it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/inbetween.h"

#define HIDDEN_LINE 0.3f  /* weight of a line that is hidden, and so a guess; chosen */
#define HALF        0.5f  /* a pixel belongs to a layer that covers so much of it */

/* Whether a pixel of a layer lies on its outline; the frame of the drawing is none. */
static bool
on_outline (const CeldPuppet *puppet, const CeldPuppetLayer *layer, int x, int y)
{
  return (x > 0 && celd_puppet_alpha (layer, x - 1, y) < HALF) ||
         (y > 0 && celd_puppet_alpha (layer, x, y - 1) < HALF) ||
         (x + 1 < puppet->width && celd_puppet_alpha (layer, x + 1, y) < HALF) ||
         (y + 1 < puppet->height && celd_puppet_alpha (layer, x, y + 1) < HALF);
}

/* Marks lines, and measures the part. */
static void
mark_lines (const CeldPuppet *puppet, size_t k, const CeldPlane *ink, CeldPartLines *lines)
{
  const CeldPuppetLayer *layer = &puppet->layer[k];
  CeldRect               window = lines->window;
  double                 x_sum = 0, y_sum = 0, n = 0;
  int                    left = INT32_MAX, top = INT32_MAX, right = 0, bottom = 0;

  for (int v = 0; v < window.height; v++)
    for (int u = 0; u < window.width; u++)
      {
        int      x = window.x + u, y = window.y + v;
        size_t   at = (size_t) v * (size_t) window.width + (size_t) u;
        uint32_t front = puppet->front[(size_t) y * (size_t) puppet->width + (size_t) x];
        bool     inside = celd_puppet_alpha (layer, x, y) >= HALF;
        bool     line = inside && (on_outline (puppet, layer, x, y) ||
                                   (front == k && !celd_is_paper (CELD_AT (ink, x, y))));

        lines->hidden[at] = front > k;
        lines->all[at]    = line;
        lines->seen[at]   = line && front == k;
        lines->n_all  += line;
        lines->n_seen += lines->seen[at];
        if (!inside)
          continue;
        x_sum += u + 0.5;
        y_sum += v + 0.5;
        n++;
        left   = u < left ? u : left;
        top    = v < top ? v : top;
        right  = u > right ? u : right;
        bottom = v > bottom ? v : bottom;
      }
  lines->centre[0] = n > 0 ? (float) (x_sum / n) : 0;
  lines->centre[1] = n > 0 ? (float) (y_sum / n) : 0;
  lines->extent    = n > 0 ? (float) (right - left > bottom - top ? right - left : bottom - top) + 1 : 1;
}

/* Takes evenly spread points of the lines. */
static void
take_points (CeldPartLines *lines)
{
  size_t seen = 0, most = CELD_LINE_POINTS;

  for (int v = 0; v < lines->window.height; v++)
    for (int u = 0; u < lines->window.width; u++)
      {
        size_t at = (size_t) v * (size_t) lines->window.width + (size_t) u;

        if (!lines->all[at])
          continue;
        if (celd_is_sample (seen, lines->n_all, most))
          lines->point[lines->n_points++] = (CeldLinePoint) { (float) u + 0.5f, (float) v + 0.5f,
                                                              lines->seen[at] ? 1 : HIDDEN_LINE };
        seen++;
      }
}

CeldStatus
celd_part_lines_new (const CeldPuppet *puppet, size_t layer, const CeldPlane *ink, CeldRect window,
                     const CeldHost *host, CeldPartLines *lines)
{
  size_t n = (size_t) window.width * (size_t) window.height;

  *lines = (CeldPartLines) { .window = window };
  lines->seen    = celd_alloc (n, 1);
  lines->all     = celd_alloc (n, 1);
  lines->hidden  = celd_alloc (n, 1);
  lines->squared = celd_alloc (n, sizeof *lines->squared);
  if (!lines->seen || !lines->all || !lines->hidden || !lines->squared)
    return CELD_NO_MEMORY;
  mark_lines (puppet, layer, ink, lines);
  take_points (lines);
  return celd_distance (window.width, window.height, lines->all, host, lines->squared);
}

void
celd_part_lines_clear (CeldPartLines *lines)
{
  celd_free (lines->seen);
  celd_free (lines->all);
  celd_free (lines->hidden);
  celd_free (lines->squared);
  *lines = (CeldPartLines) { 0 };
}
