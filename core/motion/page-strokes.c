/* Strokes on the page that belong to parts, although they bound no region.
 *
 * A stroke, a connected piece of the page's own ink, hangs on a part if it touches ink of the part's layer.  What hangs
 * on one part goes with it: an antenna, the tip of a thorn.  What hangs on several parts or reaches the frame stays, as
 * a stand or the ground does; but if it is no longer than a few lines are wide, it goes with the part that it touches
 * most.  Below a stroke that goes is the paper of the page; its own colour is that of the pixel without this paper.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "motion/page-strokes.h"

#include <math.h>
#include <stdlib.h>

#define STROKE_INK  0.9f   /* what is darker belongs to a stroke; chosen */
#define FRINGE_INK  0.998f /* what is darker goes with a stroke beside it: antialiasing */
#define FRINGE      2      /* pixels around a stroke */
#define SHORT       4      /* line widths: the sides of what goes in any case; chosen */

/* Neighbouring pixels of a stroke and of the layer of a part; both numbers count from 1. */
typedef struct { uint32_t stroke, layer; } Touch;

typedef struct
{
  const CeldLayers *layers;
  uint32_t          page;
  const CeldPlane  *ink;
  CeldPageStrokes  *strokes;
} StrokeSearch;

/* The front layer of a pixel. */
static uint32_t
front_of (const CeldLayers *layers, size_t pixel)
{
  uint32_t place = layers->place[pixel];

  return place < layers->n ? place : layers->blend[place - layers->n].layer[0];
}

/* ------------------------------------------------------------------ what a stroke hangs on */

/* Whether a pixel is the page's own, with less than this ink. */
static bool
is_of_page (const StrokeSearch *f, size_t pixel, float ink)
{
  size_t w = (size_t) f->layers->width;

  return front_of (f->layers, pixel) == f->page && CELD_AT (f->ink, (int) (pixel % w), (int) (pixel / w)) < ink;
}

/* Appends the layer at (x,y) to what a stroke touches, if there is ink of a part. */
static CeldStatus
note_touch (const StrokeSearch *f, uint32_t stroke, int x, int y, Touch **touch, size_t *n, size_t *capacity)
{
  uint32_t layer;

  if (x < 0 || y < 0 || x >= f->layers->width || y >= f->layers->height || CELD_AT (f->ink, x, y) >= STROKE_INK)
    return CELD_OK;
  layer = front_of (f->layers, (size_t) y * (size_t) f->layers->width + (size_t) x);
  return layer == f->page ? CELD_OK : celd_append (*touch, *n, *capacity, (Touch) { stroke, layer + 1 });
}

static int
compare_touches (const void *a, const void *b)
{
  const Touch *p = a, *q = b;

  if (p->stroke != q->stroke)
    return p->stroke < q->stroke ? -1 : 1;
  return p->layer < q->layer ? -1 : p->layer > q->layer;
}

static bool
is_short (const CeldComponent *c, int line)
{
  return c->right - c->left < SHORT * line && c->bottom - c->top < SHORT * line;
}

/* Whether a stroke does not reach the frame. */
static bool
is_free (const StrokeSearch *f, const CeldComponent *c)
{
  return c->left > 0 && c->top > 0 && c->right < f->layers->width - 1 && c->bottom < f->layers->height - 1;
}

/* Finds the layer that each stroke goes with from sorted touches: of those that it touches most, the farthest. */
static void
choose_layers (const StrokeSearch *f, const Touch *touch, size_t n, const CeldComponent *list, bool several)
{
  CeldPageStrokes *strokes = f->strokes;
  int              line = celd_stroke_width (f->ink);

  for (size_t i = 0, end; i < n; i = end)
    {
      const CeldComponent *c = &list[touch[i].stroke - 1];
      size_t               parts = 0, most = 0;

      for (end = i; end < n && touch[end].stroke == touch[i].stroke;)
        {
          size_t first = end;

          while (end < n && !compare_touches (&touch[first], &touch[end]))
            end++;
          parts++;
          if (end - first > most)
            {
              most = end - first;
              strokes->layer[touch[i].stroke - 1] = touch[first].layer;
            }
        }
      if (!is_short (c, line) && ((parts > 1 && !several) || !is_free (f, c)))
        strokes->layer[touch[i].stroke - 1] = 0;
    }
}

static CeldStatus
find_touches (const StrokeSearch *f, Touch **touch, size_t *n)
{
  const CeldLabels *component = &f->strokes->component;
  size_t            capacity = 0;
  CeldStatus        status = CELD_OK;

  for (int y = 0; y < component->height; y++)
    for (int x = 0; x < component->width && status == CELD_OK; x++)
      for (int k = 0; k < 9 && CELD_AT (component, x, y) && status == CELD_OK; k++)
        status = note_touch (f, CELD_AT (component, x, y), x + k % 3 - 1, y + k / 3 - 1, touch, n, &capacity);
  return status;
}

/* Gives strokes their antialiasing. */
static CeldStatus
add_fringes (const StrokeSearch *f)
{
  size_t    w = (size_t) f->layers->width, n = w * (size_t) f->layers->height;
  uint32_t *before = celd_alloc (n, sizeof *before), *after = f->strokes->component.data;

  for (int step = 0; step < FRINGE && before; step++)
    {
      memcpy (before, after, n * sizeof *before);
      for (size_t p = 0; p < n; p++)
        if (!before[p] && is_of_page (f, p, FRINGE_INK))
          {
            uint32_t left = p % w ? before[p - 1] : 0, right = (p + 1) % w ? before[p + 1] : 0;
            uint32_t above = p >= w ? before[p - w] : 0, below = p + w < n ? before[p + w] : 0;

            after[p] = left ? left : right ? right : above ? above : below;
          }
    }
  celd_free (before);
  return before ? CELD_OK : CELD_NO_MEMORY;
}

/* Finds the strokes and the layer that each goes with. */
static CeldStatus
find_strokes (const StrokeSearch *f, bool several, const CeldHost *host)
{
  CeldPageStrokes *strokes = f->strokes;
  CeldComponent   *list = NULL;
  Touch           *touch = NULL;
  size_t           n = 0;
  CeldStatus       status = celd_labels_new (f->layers->width, f->layers->height, &strokes->component);

  for (size_t p = 0; p < (size_t) f->layers->width * (size_t) f->layers->height && status == CELD_OK; p++)
    strokes->component.data[p] = is_of_page (f, p, STROKE_INK);
  if (status == CELD_OK)
    status = celd_components (&strokes->component, 0, false, host, &strokes->component, &list, &strokes->n);
  if (status == CELD_OK)
    {
      strokes->layer = celd_alloc0 (strokes->n, sizeof *strokes->layer);
      status = strokes->layer ? find_touches (f, &touch, &n) : CELD_NO_MEMORY;
    }
  if (status == CELD_OK)
    {
      if (n)
        qsort (touch, n, sizeof *touch, compare_touches);
      choose_layers (f, touch, n, list, several);
      status = add_fringes (f);
    }
  celd_free (list);
  celd_free (touch);
  return status;
}

/* ------------------------------------------------------------------ their colours */

/* The least opacity of a colour that gives `art` on paper; both have straight alpha. */
static float
least_opacity (const float art[4], const float paper[4])
{
  float most = 0;

  if (!(paper[3] > 0))
    return art[3];
  for (int c = 0; c < 3; c++)
    {
      float room = art[c] < paper[c] ? paper[c] : 1 - paper[c];

      most = fmaxf (most, room > 0 ? fabsf (art[c] - paper[c]) / room : 0);
    }
  return fminf (most, 1);
}

/* The colour of a pixel of a stroke, with straight alpha.  `opacity` is that of the whole stroke. */
static void
take_paper_off (const float art[4], const float paper[4], float opacity, float *colour)
{
  float share = opacity > 0 ? fminf (least_opacity (art, paper) / opacity, 1) : 0;

  for (int c = 0; c < 3; c++)
    colour[c] = paper[3] > 0 && share > 0 ? fminf (fmaxf ((art[c] - (1 - share) * paper[c]) / share, 0), 1) : art[c];
  colour[3] = paper[3] > 0 ? share : art[3];
}

/* Finds the colours of all that go.  `opacity` has an item for each stroke, 0. */
static void
find_colours (const StrokeSearch *f, const CeldHiddenPaper *paper, float *opacity)
{
  for (int pass = 0; pass < 2; pass++)
    for (size_t p = 0; p < (size_t) f->layers->width * (size_t) f->layers->height; p++)
      {
        uint32_t     stroke = f->strokes->component.data[p];
        const float *art = f->layers->art + 4 * p, *below = paper->value ? paper->value + 4 * p : paper->flat;

        if (!stroke || !f->strokes->layer[stroke - 1])
          continue;
        if (!pass)
          opacity[stroke - 1] = fmaxf (opacity[stroke - 1], least_opacity (art, below));
        else
          {
            take_paper_off (art, below, opacity[stroke - 1], f->strokes->colour + 4 * p);
            memcpy (f->strokes->paper + 4 * p, below, 4 * sizeof *below);
          }
      }
}

static CeldStatus
colour_strokes (const StrokeSearch *f, const CeldHost *host)
{
  CeldRect        all = { 0, 0, f->layers->width, f->layers->height };
  CeldHiddenPaper paper = { .box = all };
  size_t          pixels = (size_t) all.width * (size_t) all.height;
  float          *opacity = celd_alloc0 (f->strokes->n, sizeof *opacity);
  CeldStatus      status;

  f->strokes->colour = celd_alloc0 (pixels, 4 * sizeof *f->strokes->colour);
  f->strokes->paper  = celd_alloc0 (pixels, 4 * sizeof *f->strokes->paper);
  status = opacity && f->strokes->colour && f->strokes->paper ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_hidden_paper (f->layers, f->page, f->ink, all, host, &paper);
  if (status == CELD_OK && paper.any)
    find_colours (f, &paper, opacity);
  celd_free (paper.value);
  celd_free (opacity);
  return status;
}

/* ------------------------------------------------------------------ the strokes */

void
celd_page_strokes_clear (CeldPageStrokes *strokes)
{
  celd_free (strokes->component.data);
  celd_free (strokes->layer);
  celd_free (strokes->colour);
  celd_free (strokes->paper);
  *strokes = (CeldPageStrokes) { 0 };
}

CeldStatus
celd_page_strokes_find (const CeldLayers *layers, uint32_t page, const CeldPlane *ink, bool several,
                        const CeldHost *host, CeldPageStrokes *strokes)
{
  StrokeSearch f = { layers, page, ink, strokes };
  CeldStatus   status = find_strokes (&f, several, host);

  if (status == CELD_OK)
    status = colour_strokes (&f, host);
  if (status != CELD_OK)
    celd_page_strokes_clear (strokes);
  return status;
}
