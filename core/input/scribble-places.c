/* Which pixels of scribbles each label has.
 *
 * A label has the pixels of its own colours that are solid or touch solid ones; every other pixel is assigned to the
 * neighbouring label whose colour is nearest.  A line on opaque paper that is too thin to have a pixel of its full
 * colour is assigned by its strongest pixel, and a stroke on transparency whose colours are no labels, as filters that
 * made it smaller may leave one, by its commonest.
 *
 * Cost: O(pixels); 8 bytes for each pixel whose label comes from a neighbour.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"

#include <limits.h>

/* Distances of colours in steps of 1/255; chosen. */
#define TINT_ERROR    12        /* between a thin line and its label's colour mixed with paper, at most; measured: with
                                 * 30 half as many colours again of thin strokes were lost */
#define LINE_CONTRAST 60        /* between a line and paper, at least */
#define LEAST_MIXTURE 0.3       /* part of its label's colour in a thin line; chosen */

/* ------------------------------------------------------------------ labels from neighbours */

/* The label of a pixel's own colour; CELD_UNDECIDED if its colour is no label's. */
static uint32_t
own_label (const CeldScribbleLayer *r, size_t i)
{
  uint32_t k = r->id[i] ? r->colour[r->id[i]].cluster : 0;

  return k == 0 || (k != CELD_NO_CLUSTER && r->cluster[k].is_label) ? k : CELD_UNDECIDED;
}

/* Does a solid pixel of the label touch the pixel (x,y)? */
static bool
is_rim (const CeldScribbleLayer *r, int x, int y, uint32_t label)
{
  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < r->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < r->width; u++)
      {
        size_t i = (size_t) v * (size_t) r->width + (size_t) u;

        if (r->kind[i] != CELD_FRINGE && own_label (r, i) == label)
          return true;
      }
  return false;
}

static void
place_row (void *data, int y)
{
  CeldScribbleLayer *r = data;
  uint32_t          *label = r->label + (size_t) y * (size_t) r->width;

  for (int x = 0; x < r->width; x++)
    {
      size_t i = (size_t) y * (size_t) r->width + (size_t) x;

      label[x] = own_label (r, i);
      if (label[x] && label[x] != CELD_UNDECIDED && r->kind[i] == CELD_FRINGE && !is_rim (r, x, y, label[x]))
        label[x] = CELD_UNDECIDED;
    }
}

/* Of the labels that touch the pixel, the one with the nearest colour; 0 if paper is nearer. */
static uint32_t
nearest_neighbour (const CeldScribbleLayer *r, size_t i)
{
  const int *c = r->colour[r->id[i]].channel;
  int        x = (int) (i % (size_t) r->width), y = (int) (i / (size_t) r->width);
  int        least = r->paper ? celd_colour_distance (c, r->colour[r->paper].channel) : INT_MAX;
  uint32_t   found = 0;

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < r->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < r->width; u++)
      {
        uint32_t label = r->label[(size_t) v * (size_t) r->width + (size_t) u];
        int      d;

        if (!label || label >= CELD_QUEUED)
          continue;
        d = celd_colour_distance (c, r->cluster[label].channel);
        if (d < least || (d == least && label < found))
          {
            least = d;
            found = label;
          }
      }
  return found;
}

/* Queues the undecided pixels that touch pixel i. */
static size_t
queue_neighbours (CeldScribbleLayer *r, size_t i, uint32_t *queue, size_t n)
{
  int x = (int) (i % (size_t) r->width), y = (int) (i / (size_t) r->width);

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < r->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < r->width; u++)
      {
        size_t j = (size_t) v * (size_t) r->width + (size_t) u;

        if (r->label[j] == CELD_UNDECIDED)
          {
            r->label[j] = CELD_QUEUED;
            queue[n++] = (uint32_t) j;
          }
      }
  return n;
}

/* Gives undecided pixels labels of their neighbours, ring by ring outwards; those that are not reached, so many, stay
 * undecided. */
static CeldStatus
place_rest (CeldScribbleLayer *r, const CeldHost *host, size_t *unreached)
{
  size_t     undecided = 0, ring = 0, end = 0, decided;
  uint32_t  *queue, *taken;
  CeldStatus status = CELD_NO_MEMORY;

  for (size_t i = 0; i < r->pixels; i++)
    undecided += r->label[i] == CELD_UNDECIDED;
  queue = celd_alloc (undecided, sizeof *queue);
  taken = celd_alloc (undecided, sizeof *taken);
  if (!queue || !taken)
    goto done;

  for (size_t i = 0; i < r->pixels && end < undecided; i++)
    if (r->label[i] && r->label[i] < CELD_QUEUED)
      end = queue_neighbours (r, i, queue, end);
  while (ring < end)
    {
      status = celd_progress (host, 0.8 + 0.2 * (double) ring / (double) undecided);
      if (status != CELD_OK)
        goto done;
      for (size_t i = ring; i < end; i++)
        taken[i] = nearest_neighbour (r, queue[i]);
      for (size_t i = ring; i < end; i++)
        r->label[queue[i]] = taken[i];
      decided = end;
      for (size_t i = ring; i < decided; i++)
        if (taken[i])
          end = queue_neighbours (r, queue[i], queue, end);
      ring = decided;
    }
  *unreached = undecided - end;
  status = CELD_OK;

done:
  celd_free (taken);
  celd_free (queue);
  return status;
}

/* ------------------------------------------------------------------ lines too thin to have a colour of their own */

/* How well a colour shows what a line was painted with: its squared contrast with paper, or how common it is. */
static int
strength_of (const CeldScribbleLayer *r, uint32_t id)
{
  return r->paper ? celd_colour_distance (r->colour[id].channel, r->colour[r->paper].channel)
                  : (int) r->colour[id].pixels;
}

/* Is the pixel paint, clearly unlike paper, without a label? */
static bool
is_lost (const CeldScribbleLayer *r, size_t i)
{
  return (r->label[i] == 0 || r->label[i] == CELD_UNDECIDED) && r->id[i] && r->id[i] != r->paper &&
         (!r->paper || strength_of (r, r->id[i]) > LINE_CONTRAST * LINE_CONTRAST);
}

/* Lists the lost pixels connected to pixel i, marks them CELD_QUEUED, and finds their strongest colour; 0 if a label
 * touches them, because they belong to its rim then. */
static size_t
gather_line (CeldScribbleLayer *r, uint32_t i, uint32_t *line, uint32_t *strongest)
{
  size_t n = 0;
  bool   rim = false;

  *strongest = r->id[i];
  r->label[i] = CELD_QUEUED;
  line[n++] = i;
  for (size_t k = 0; k < n; k++)
    {
      int x = (int) (line[k] % (size_t) r->width), y = (int) (line[k] / (size_t) r->width);

      if (strength_of (r, r->id[line[k]]) > strength_of (r, *strongest))
        *strongest = r->id[line[k]];
      for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < r->height; v++)
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < r->width; u++)
          {
            size_t j = (size_t) v * (size_t) r->width + (size_t) u;

            rim = rim || (r->label[j] && r->label[j] < CELD_QUEUED);
            if (!is_lost (r, j))
              continue;
            r->label[j] = CELD_QUEUED;
            line[n++] = (uint32_t) j;
          }
    }
  if (rim)
    *strongest = 0;
  return n;
}

/* Is the lost line broader than CELD_THIN around a pixel?  Then its strongest pixels are hardly mixed with paper. */
static bool
is_broad (const CeldScribbleLayer *r, uint32_t i)
{
  int x = (int) (i % (size_t) r->width), y = (int) (i / (size_t) r->width), radius = CELD_THIN / 2 + 1;

  for (int v = y - radius; v <= y + radius; v++)
    for (int u = x - radius; u <= x + radius; u++)
      if (u < 0 || v < 0 || u >= r->width || v >= r->height ||
          r->label[(size_t) v * (size_t) r->width + (size_t) u] != CELD_QUEUED)
        return false;
  return true;
}

/* The strongest colour among the pixels where a gathered line is broad; 0 if it is broad nowhere. */
static uint32_t
strongest_of_broad (const CeldScribbleLayer *r, const uint32_t *line, size_t n)
{
  uint32_t strongest = 0;

  for (size_t k = 0; k < n; k++)
    if (is_broad (r, line[k]) && (!strongest || strength_of (r, r->id[line[k]]) > strength_of (r, strongest)))
      strongest = r->id[line[k]];
  return strongest;
}

/* The label whose colour comes nearest to a colour, or with `mixed` whose colour mixed with paper does; 0 if none is
 * near. */
static uint32_t
label_of_colour (const CeldScribbleLayer *r, uint32_t id, bool mixed)
{
  const int *paper = r->colour[r->paper].channel, *c = r->colour[id].channel;
  uint32_t   found = 0;
  int        least = r->paper ? TINT_ERROR * TINT_ERROR : 4 * r->radius * r->radius;

  for (uint32_t k = 1; k < r->n_clusters; k++)
    {
      const int *full = r->cluster[k].channel;
      double     length = 0, along = 0, share = 1;
      int        tint[3], d;

      for (int i = 0; i < 3 && mixed; i++)
        {
          length += (full[i] - paper[i]) * (full[i] - paper[i]);
          along += (full[i] - paper[i]) * (c[i] - paper[i]);
        }
      if (mixed)
        share = length > 0 ? along / length : 0;
      for (int i = 0; i < 3; i++)
        tint[i] = (int) (paper[i] + share * (full[i] - paper[i]));
      d = celd_colour_distance (tint, c);
      if (r->cluster[k].is_label && share > LEAST_MIXTURE && d < least)
        {
          least = d;
          found = k;
        }
    }
  return found;
}

/* Assigns lost lines to the label of their colour, or makes a label for them. */
static CeldStatus
assign_lost_lines (CeldScribbleLayer *r)
{
  size_t     lost = 0;
  uint32_t  *line;
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < r->pixels; i++)
    lost += is_lost (r, i);
  line = celd_alloc (lost, sizeof *line);
  if (!line)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < r->pixels && status == CELD_OK; i++)
    {
      uint32_t strongest, broad, k;
      size_t   n;

      if (!is_lost (r, i))
        continue;
      n = gather_line (r, (uint32_t) i, line, &strongest);
      if (!strongest || n < CELD_LEAST_DOT)
        continue;
      broad = r->paper ? strongest_of_broad (r, line, n) : strongest;
      k = label_of_colour (r, broad ? broad : strongest, !broad);
      if (!k)
        {
          status = celd_scribble_cluster_add (r, broad ? broad : strongest);
          k = (uint32_t) r->n_clusters - 1;
          r->cluster[k].is_label = true;
        }
      for (size_t j = 0; j < n && status == CELD_OK; j++)
        r->label[line[j]] = k;
    }
  celd_free (line);
  return status;
}

/* ------------------------------------------------------------------ all pixels */

CeldStatus
celd_scribble_places (CeldScribbleLayer *r, const CeldHost *host)
{
  size_t     unreached = 0;
  CeldStatus status;

  celd_parallel_for (host, r->height, place_row, r);
  status = celd_progress (host, 0.8);
  if (status == CELD_OK)
    status = place_rest (r, host, &unreached);
  if (status == CELD_OK && (r->paper || unreached))
    status = assign_lost_lines (r);
  return status;
}
