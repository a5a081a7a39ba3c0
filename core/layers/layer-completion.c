/* Colours of what is hidden of layers, where sheets (core/sheets) go on.
 *
 * Colours come from the region's own paper (layer-paper.c).  Along the hidden outline goes the region's own line, as
 * wide as along the visible one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "layers/layers.h"

#include <math.h>

#define LINE_INK  0.25f /* ink below this has the colour of the line; chosen */
#define LEAST_PEN 0.7   /* pixels; a thinner line does not count as one; chosen */

typedef struct
{
  CeldLayers      *layers;
  size_t           layer;
  const CeldPlane *ink;
  const CeldSheet *sheet;
  const CeldSheets *sheets;
  CeldHiddenPaper  paper;       /* its box has all that is visible or hidden of the layer */
  float            line[4];     /* colour of the line */
  float           *cover;       /* of each pixel of the box by the sheet; NULL: no line */
  int32_t         *depth;       /* squared distance of each pixel to the outside of the sheet */
} Fill;

static size_t
index_in (const Fill *f, int x, int y)
{
  return (size_t) (y - f->paper.box.y) * (size_t) f->paper.box.width + (size_t) (x - f->paper.box.x);
}

static const float *
art_at (const Fill *f, int x, int y)
{
  return f->layers->art + 4 * ((size_t) y * (size_t) f->layers->width + (size_t) x);
}

/* ------------------------------------------------------------------ the line */

/* The mean colour of the layer's ink; false if it has none. */
static bool
colour_of_line (Fill *f)
{
  double   sum[4] = { 0 };
  size_t   n = 0;
  CeldRect seen = f->sheet->seen;

  for (int y = seen.y; y < seen.y + seen.height; y++)
    for (int x = seen.x; x < seen.x + seen.width; x++)
      if (CELD_AT (f->ink, x, y) < LINE_INK
          && f->layers->place[(size_t) y * (size_t) f->layers->width + (size_t) x] == f->layer)
        {
          const float *art = art_at (f, x, y);

          n++;
          for (int c = 0; c < 4; c++)
            sum[c] += (double) art[c];
        }
  for (int c = 0; c < 4 && n; c++)
    f->line[c] = (float) (sum[c] / (double) n);
  return n > 0;
}

static CeldStatus
measure_depth (Fill *f, const CeldOwnership *own, const CeldHost *host)
{
  size_t   n = (size_t) f->paper.box.width * (size_t) f->paper.box.height;
  uint8_t *outside;
  CeldStatus status;

  if (f->sheet->page || f->sheet->pen < LEAST_PEN || !colour_of_line (f))
    return CELD_OK;
  outside  = celd_alloc (n, 1);
  f->cover = celd_alloc (n, sizeof *f->cover);
  f->depth = celd_alloc (n, sizeof *f->depth);
  if (!outside || !f->cover || !f->depth)
    {
      celd_free (outside);
      return CELD_NO_MEMORY;
    }
  celd_sheet_coverage (f->sheets, own, f->layer, f->paper.box, f->cover);
  for (size_t i = 0; i < n; i++)
    outside[i] = f->cover[i] < 0.5f;
  status = celd_distance (f->paper.box.width, f->paper.box.height, outside, host, f->depth);
  celd_free (outside);
  return status;
}

/* The share of a pixel that the line covers. */
static float
line_at (const Fill *f, size_t i)
{
  double inside;

  if (!f->depth || f->depth[i] == INT32_MAX)
    return 0;
  inside = sqrt ((double) f->depth[i]) - 0.5;
  return (float) fmin (fmax (f->sheet->pen - inside + 0.5, 0), 1);
}

/* ------------------------------------------------------------------ parts */

static void
write_pixel (const Fill *f, int x, int y, float coverage, bool margin, uint16_t *to)
{
  size_t       i = index_in (f, x, y);
  const float *colour = f->paper.value ? f->paper.value + 4 * i : f->paper.flat;
  float        line = margin ? 0 : line_at (f, i), mixed[4];

  for (int c = 0; c < 4; c++)
    mixed[c] = colour[c] + line * (f->line[c] - colour[c]);
  mixed[3] *= margin ? 1 : coverage;
  for (int c = 0; c < 4; c++)
    to[c] = (uint16_t) (fminf (fmaxf (mixed[c], 0), 1) * 65535 + 0.5f);
}

/* What lies over a hidden pixel has to be opaque, or else the pixel would be seen. */
static bool
is_covered (const Fill *f, int x, int y)
{
  const CeldLayers *layers = f->layers;
  size_t            place = layers->place[(size_t) y * (size_t) layers->width + (size_t) x];

  return (place < layers->n ? art_at (f, x, y) : layers->blend[place - layers->n].colour[1])[3] >= 1;
}

/* Adds a pixel to a part that has room for it. */
static CeldStatus
add_pixel (const Fill *f, int x, int y, float coverage, bool margin, size_t *capacity, CeldHiddenPart *part)
{
  CeldStatus status = celd_sheet_run_add (&part->run, &part->n_runs, capacity, x, y, part->n_pixels);

  if (status == CELD_OK)
    write_pixel (f, x, y, coverage, margin, part->colour + 4 * part->n_pixels++);
  return status;
}

/* The margin begins with the antialiased pixels of the silhouette, since a crack would be seen through these. */
static CeldStatus
add_sheet (const Fill *f, CeldHiddenPart *hidden, CeldHiddenPart *margin)
{
  const CeldSheet *sheet = f->sheet;
  size_t           capacity[2] = { 0, 0 }, inside = 0, in_margin = 0;
  CeldStatus       status = CELD_OK;

  for (size_t i = 0; i < sheet->n_hidden; i++)
    {
      inside    += sheet->coverage[i] > 0;
      in_margin += sheet->coverage[i] < 255;
    }
  hidden->colour = celd_alloc (inside, 4 * sizeof *hidden->colour);
  margin->colour = celd_alloc (in_margin, 4 * sizeof *margin->colour);
  if (!hidden->colour || !margin->colour)
    return CELD_NO_MEMORY;
  for (size_t r = 0; r < sheet->n_runs && status == CELD_OK; r++)
    for (int k = 0; k < sheet->run[r].n && status == CELD_OK; k++)
      {
        uint8_t coverage = sheet->coverage[sheet->run[r].first + (size_t) k];
        int     x = sheet->run[r].x + k, y = sheet->run[r].y;

        if (!is_covered (f, x, y))
          continue;
        if (coverage > 0)
          status = add_pixel (f, x, y, coverage / 255.f, false, &capacity[0], hidden);
        if (coverage < 255 && status == CELD_OK)
          status = add_pixel (f, x, y, 1, true, &capacity[1], margin);
      }
  return status;
}

/* Is a pixel not the page's, and only nearer layers' that cover it? */
static bool
hides_page (const Fill *f, int x, int y)
{
  const CeldLayers *layers = f->layers;
  size_t            place = layers->place[(size_t) y * (size_t) layers->width + (size_t) x];

  if (place >= layers->n)
    place = layers->blend[place - layers->n].layer[1];
  return place > f->layer && is_covered (f, x, y);
}

/* The page goes on everywhere under nearer layers. */
static CeldStatus
add_page (const Fill *f, CeldHiddenPart *hidden)
{
  size_t     n = 0, capacity = 0;
  CeldStatus status = CELD_OK;

  for (int y = 0; y < f->paper.box.height; y++)
    for (int x = 0; x < f->paper.box.width; x++)
      n += hides_page (f, x, y);
  hidden->colour = celd_alloc (n, 4 * sizeof *hidden->colour);
  if (!hidden->colour)
    return CELD_NO_MEMORY;
  for (int y = 0; y < f->paper.box.height; y++)
    for (int x = 0; x < f->paper.box.width && status == CELD_OK; x++)
      if (hides_page (f, x, y))
        status = add_pixel (f, x, y, 1, false, &capacity, hidden);
  return status;
}

static void
fill_clear (Fill *f)
{
  celd_free (f->paper.value);
  celd_free (f->cover);
  celd_free (f->depth);
}

static CeldStatus
complete_one (CeldLayers *layers, size_t k, const CeldPlane *ink, const CeldOwnership *own, const CeldSheets *sheets,
              const CeldHost *host)
{
  Fill         f = { .layers = layers, .layer = k, .ink = ink, .sheets = sheets, .sheet = &sheets->item[k] };
  CeldHostPart part[2];
  CeldHost     first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldStatus   status;

  f.paper.box = f.sheet->box;
  if (!f.sheet->page && !f.sheet->n_hidden)
    return CELD_OK;
  status = celd_hidden_paper (layers, k, ink, f.sheet->seen, &first, &f.paper);
  if (status == CELD_OK && f.paper.any) /* otherwise no pixel is its own, and nothing is completed */
    {
      status = measure_depth (&f, own, &second);
      if (status == CELD_OK)
        status = f.sheet->page ? add_page (&f, &layers->hidden[k])
                               : add_sheet (&f, &layers->hidden[k], &layers->margin[k]);
      if (!f.paper.value)
        {
          memcpy (layers->hidden[k].paper, f.paper.flat, sizeof f.paper.flat);
          memcpy (layers->margin[k].paper, f.paper.flat, sizeof f.paper.flat);
        }
    }
  fill_clear (&f);
  return status;
}

CeldStatus
celd_layers_complete (CeldLayers *layers, const CeldPlane *ink, const CeldOwnership *own, const CeldSheets *sheets,
                      const CeldHost *host)
{
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < layers->n && status == CELD_OK; k++)
    {
      CeldHostPart part;
      double       turns = (double) layers->n;
      CeldHost     turn = celd_host_part (&part, host, (double) k / turns, (double) (k + 1) / turns);

      status = complete_one (layers, k, ink, own, sheets, &turn);
      if (status == CELD_OK)
        status = celd_progress (&turn, 1);
    }
  return status;
}

float
celd_hidden_colour (const CeldHiddenPart *part, size_t pixel, float colour[4])
{
  for (size_t c = 0; c < 4; c++)
    colour[c] = (float) part->colour[4 * pixel + c] / 65535;
  for (size_t c = 0; c < 3; c++)
    if (part->colour[4 * pixel + c] == (uint16_t) (part->paper[c] * 65535 + 0.5f))
      colour[c] = part->paper[c];
  return colour[3];
}
