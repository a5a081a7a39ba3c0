/* The colours of what is hidden of a layer, from the layer's own paper.
 *
 * Flat paper, of one or a few colours, stays flat: a hidden pixel takes the nearest of them.  Other paper goes on
 * smoothly.
 *
 *   [BM91]  R. S. Boyer, J S. Moore: MJRTY - A Fast Majority Vote Algorithm.  Automated Reasoning, 1991.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "layers/layers.h"

#define SURE_PAPER  0.97f /* ink above this is certainly paper; chosen */
#define COLOURS     4096  /* slots of a table of colours; paper with half as many is not flat; chosen */
#define LEAST_SHARE 0.02  /* of the paper, that a colour of flat paper has; chosen */
#define FLAT_SHARE  0.97  /* of the paper, that these colours have together; chosen */

/* A colour in 8 bits a component, how often it occurs, and a pixel of the exact colour that most of these have, if most
 * of them have one: the only one with votes left when others vote against it [BM91]. */
typedef struct { uint32_t code; size_t n, pixel, votes; } PaperColour;

typedef struct
{
  const CeldLayers *layers;
  size_t            layer;
  const CeldPlane  *ink;
  CeldRect          seen;      /* of what is visible of the layer */
  CeldHiddenPaper  *paper;
  uint8_t          *known;     /* of each pixel of paper->box: does it give colour? */
} PaperSearch;

static const float *
art_at (const PaperSearch *f, int x, int y)
{
  return f->layers->art + 4 * ((size_t) y * (size_t) f->layers->width + (size_t) x);
}

/* ------------------------------------------------------------------ flat paper */

/* Marks the layer's own paper, or with `ink_too` all of its pixels; false if there is none. */
static bool
mark_known (PaperSearch *f, bool ink_too)
{
  const CeldLayers *layers = f->layers;
  CeldRect          seen = f->seen, box = f->paper->box;
  bool              any = false;

  for (int y = seen.y; y < seen.y + seen.height; y++)
    for (int x = seen.x; x < seen.x + seen.width; x++)
      {
        bool known = layers->place[(size_t) y * (size_t) layers->width + (size_t) x] == f->layer &&
                     (ink_too || !(CELD_AT (f->ink, x, y) < SURE_PAPER));

        f->known[(size_t) (y - box.y) * (size_t) box.width + (size_t) (x - box.x)] = known;
        any |= known;
      }
  return any;
}

static uint32_t
code_of (const float *art)
{
  uint32_t code = 0;

  for (int c = 0; c < 4; c++)
    code = code << 8 | (uint32_t) (255 * art[c] + 0.5f);
  return code;
}

/* The slot of a colour in the table, whose unused slots have n = 0. */
static PaperColour *
slot_of (PaperColour *table, uint32_t code)
{
  uint32_t at = code * 2654435761u >> 20;

  while (table[at].n && table[at].code != code)
    at = (at + 1) % COLOURS;
  return &table[at];
}

static void
vote (const float *art, size_t pixel, PaperColour *colour)
{
  if (!colour->votes)
    colour->pixel = pixel;
  if (memcmp (art + 4 * pixel, art + 4 * colour->pixel, 4 * sizeof *art))
    colour->votes--;
  else
    colour->votes++;
}

/* Counts the colours of known pixels; false if there are too many for flat paper. */
static bool
count_colours (const PaperSearch *f, PaperColour *table, size_t *total)
{
  size_t colours = 0;

  *total = 0;
  for (int y = 0; y < f->paper->box.height; y++)
    for (int x = 0; x < f->paper->box.width; x++)
      {
        const float *art = art_at (f, f->paper->box.x + x, f->paper->box.y + y);
        PaperColour *colour;

        if (!f->known[(size_t) y * (size_t) f->paper->box.width + (size_t) x])
          continue;
        colour = slot_of (table, code_of (art));
        if (!colour->n && ++colours > COLOURS / 2)
          return false;
        colour->code = code_of (art);
        vote (f->layers->art, (size_t) (art - f->layers->art) / 4, colour);
        colour->n++;
        ++*total;
      }
  return true;
}

/* Decides whether the paper is flat; if so, pixels of rare colours are no longer known.  Returns the number of colours
 * of flat paper, 0 if it is not. */
static int
find_flat (PaperSearch *f, PaperColour *table)
{
  size_t total, most = 0, frequent = 0;
  int    n = 0;

  if (!count_colours (f, table, &total))
    return 0;
  for (int i = 0; i < COLOURS; i++)
    if ((double) table[i].n >= LEAST_SHARE * (double) total)
      {
        frequent += table[i].n;
        n++;
        if (table[i].n > most)
          memcpy (f->paper->flat, f->layers->art + 4 * table[i].pixel, sizeof f->paper->flat);
        most = table[i].n > most ? table[i].n : most;
      }
  if ((double) frequent < FLAT_SHARE * (double) total)
    return 0;
  for (int y = 0; y < f->paper->box.height && n > 1; y++)
    for (int x = 0; x < f->paper->box.width; x++)
      {
        uint8_t *known = &f->known[(size_t) y * (size_t) f->paper->box.width + (size_t) x];

        *known = *known && (double) slot_of (table, code_of (art_at (f, f->paper->box.x + x, f->paper->box.y + y)))->n
                             >= LEAST_SHARE * (double) total;
      }
  return n;
}

/* ------------------------------------------------------------------ colours of hidden pixels */

static CeldStatus
take_nearest (PaperSearch *f, PaperColour *table, const CeldHost *host)
{
  size_t     n = (size_t) f->paper->box.width * (size_t) f->paper->box.height;
  int32_t   *squared = celd_alloc (n, sizeof *squared), *nearest = celd_alloc (n, sizeof *nearest);
  CeldStatus status = CELD_NO_MEMORY;

  if (squared && nearest)
    status = celd_nearest (f->paper->box.width, f->paper->box.height, f->known, host, squared, nearest);
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    {
      CeldRect     box = f->paper->box;
      const float *art = art_at (f, box.x + nearest[i] % box.width, box.y + nearest[i] / box.width);

      memcpy (f->paper->value + 4 * i, f->layers->art + 4 * slot_of (table, code_of (art))->pixel, 4 * sizeof (float));
    }
  celd_free (squared);
  celd_free (nearest);
  return status;
}

/* Colours are extended premultiplied. */
static CeldStatus
extend (PaperSearch *f)
{
  CeldStatus status;

  for (int y = 0; y < f->paper->box.height; y++)
    for (int x = 0; x < f->paper->box.width; x++)
      {
        size_t       i = (size_t) y * (size_t) f->paper->box.width + (size_t) x;
        const float *art = art_at (f, f->paper->box.x + x, f->paper->box.y + y);

        for (size_t c = 0; c < 4 && f->known[i]; c++)
          f->paper->value[4 * i + c] = c < 3 ? art[c] * art[3] : art[3];
      }
  status = celd_extend (f->paper->box.width, f->paper->box.height, 4, f->known, f->paper->value);
  for (size_t i = 0; i < (size_t) f->paper->box.width * (size_t) f->paper->box.height && status == CELD_OK; i++)
    for (size_t c = 0; c < 3 && f->paper->value[4 * i + 3] > 0; c++)
      f->paper->value[4 * i + c] /= f->paper->value[4 * i + 3];
  return status;
}

static CeldStatus
find_colours (PaperSearch *f, const CeldHost *host)
{
  size_t       n = (size_t) f->paper->box.width * (size_t) f->paper->box.height;
  PaperColour *table = celd_alloc0 (COLOURS, sizeof *table);
  int          colours = table ? find_flat (f, table) : 0;
  CeldStatus   status = table ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK && colours != 1)
    {
      f->paper->value = celd_alloc (n, 4 * sizeof *f->paper->value);
      status = !f->paper->value ? CELD_NO_MEMORY : colours ? take_nearest (f, table, host) : extend (f);
    }
  celd_free (table);
  return status;
}

CeldStatus
celd_hidden_paper (const CeldLayers *layers, size_t layer, const CeldPlane *ink, CeldRect seen, const CeldHost *host,
                   CeldHiddenPaper *paper)
{
  PaperSearch f = { .layers = layers, .layer = layer, .ink = ink, .seen = seen, .paper = paper };
  CeldStatus  status = CELD_OK;

  f.known = celd_alloc0 ((size_t) paper->box.width * (size_t) paper->box.height, 1);
  if (!f.known)
    return CELD_NO_MEMORY;
  paper->any = mark_known (&f, false) || mark_known (&f, true);
  if (paper->any)
    status = find_colours (&f, host);
  celd_free (f.known);
  return status;
}
