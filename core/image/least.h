/* The least of the values in a window, along rows or columns, for one type of values.
 *
 * A template: the file that includes it defines LEAST_VALUE, the type of a value, LEAST_PLANE, the type of a picture of
 * them, LEAST_BEYOND, a value above all others for what lies outside of the picture, and the names of the functions.
 * The least of windows of 1, 2, 4, ... values is taken in turn, and that of any other window is the lesser of two of
 * these that overlap.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */

CELD_CLONES static void
LEAST_ALONG_ROWS (LEAST_PLANE *plane, int radius, LEAST_VALUE *line)
{
  size_t width = (size_t) plane->width, edge = (size_t) radius, n = width + 2 * edge, window = 2 * edge + 1, span;

  for (int y = 0; y < plane->height; y++)
    {
      LEAST_VALUE *row = &CELD_AT (plane, 0, y);

      for (size_t i = 0; i < edge; i++)
        line[i] = line[n - 1 - i] = LEAST_BEYOND;
      memcpy (line + edge, row, width * sizeof *row);
      for (span = 1; 2 * span <= window; span *= 2)
        for (size_t i = 0; i < n - span; i++)
          line[i] = line[i] < line[i + span] ? line[i] : line[i + span];
      for (size_t x = 0; x < width; x++)
        row[x] = line[x] < line[x + window - span] ? line[x] : line[x + window - span];
    }
}

CELD_CLONES static void
LEAST_ALONG_COLUMNS (LEAST_PLANE *plane, int radius, LEAST_VALUE *lines)
{
  size_t window = 2 * (size_t) radius + 1, cache_line = 64 / sizeof (LEAST_VALUE), span;

  for (size_t left = 0; left < (size_t) plane->width; left += cache_line)
    {
      size_t rest = (size_t) plane->width - left, breadth = rest < cache_line ? rest : cache_line;
      size_t edge = (size_t) radius * breadth, n = (size_t) plane->height * breadth + 2 * edge;

      for (size_t i = 0; i < edge; i++)
        lines[i] = lines[n - 1 - i] = LEAST_BEYOND;
      for (int y = 0; y < plane->height; y++)
        memcpy (lines + edge + (size_t) y * breadth, &CELD_AT (plane, left, y), breadth * sizeof *lines);
      for (span = 1; 2 * span <= window; span *= 2)
        for (size_t i = 0, step = span * breadth; i < n - step; i++)
          lines[i] = lines[i] < lines[i + step] ? lines[i] : lines[i + step];
      for (int y = 0; y < plane->height; y++)
        {
          LEAST_VALUE       *row = &CELD_AT (plane, left, y);
          const LEAST_VALUE *first = lines + (size_t) y * breadth, *second = first + (window - span) * breadth;

          for (size_t x = 0; x < breadth; x++)
            row[x] = first[x] < second[x] ? first[x] : second[x];
        }
    }
}

#undef LEAST_VALUE
#undef LEAST_PLANE
#undef LEAST_BEYOND
#undef LEAST_ALONG_ROWS
#undef LEAST_ALONG_COLUMNS
