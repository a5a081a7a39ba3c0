/* Layers that were mixed up: the drawing exchanged with its scribbles, or it, or a copy of it, given as a layer.
 *
 * The lines of a drawing part its page into rooms, while strokes leave it in one piece.  Lines are what is dark in the
 * lightest channel, as black, brown and dark shades are; strokes of clear colours are as light there as paper.  On a
 * dark page they are what is light.  In the other layer, which may be drawn with a red pencil, all that is narrow
 * counts as a line.  Of 156 drawings, grey and coloured, 155 have at least three rooms, and their scribbles, hard,
 * soft, and whole fills, nearly all one or two.  Scribbles without colours that have many rooms are another drawing,
 * such as that of the next frame.
 *
 * A page is looked at in cells, each as dark as its darkest pixel, so that thin lines stay whole: what this takes does
 * not depend on the size of the page.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "input/input.h"

#include <stdlib.h>
#include <string.h>

#define LONGER_SIDE   256  /* cells along the longer side of a page, at most (chosen) */
#define CELL_SAMPLES  4    /* pixels looked at along each side of a large cell (chosen) */
#define LINE_RADIUS   3    /* cells: half the width of the broadest lines that tell exchanged layers (chosen) ... */
#define BROAD_RADIUS  8    /* ... and of those of a layer that is compared with the drawing line by line, which knows
                            * lines as broad (chosen) */
#define CELL_CONTRAST 48   /* of 255: of a line with what is on both sides; chosen */
#define ROOM_SHARE    2000 /* a room is at least 1 / this of the page (chosen) */
#define ROOM_SIDE     64   /* pixels; smaller pages have no rooms that tell anything (chosen) */
#define LEAST_ROOMS   3    /* of a drawing that was given as scribbles (measured, see above), */
#define MORE_ROOMS    3    /* and how many times as many as there are in the other layer (measured) */
#define MANY_ROOMS    6    /* of another drawing that was given as scribbles (measured: of 1225 layers of scribbles, as
                            * black strokes, none has more than three; half of the drawings have as many) */
#define STORED        48   /* of 255: how much a channel changes when a picture is stored with loss, at most; chosen */
#define SAME_SHARE    1000 /* of the cells of a copy at most 1 / this differ by more (chosen), */
#define SAME_DRAWN    10   /* and of those where something is drawn at most 1 / this (chosen) */
#define FLAT_DRAWN    5    /* the same of strokes and a flat copy (measured: 1 / 7 in a JPEG of quality 50) */

/* ------------------------------------------------------------------ cells */

/* How light a pixel is on white paper: by its lightest channel, or by the darkest one. */
static uint8_t
lightness (const uint8_t *p, bool dark_page, bool darkest)
{
  uint8_t most = p[0] > p[1] ? p[0] : p[1], least = p[0] < p[1] ? p[0] : p[1];

  most  = p[2] > most ? p[2] : most;
  least = p[2] < least ? p[2] : least;
  return (uint8_t) (255 - p[3] * (255 - (dark_page ? 255 - most : darkest ? least : most)) / 255);
}

static bool
is_dark_page (const CeldPaint *paint, int step)
{
  size_t dark = 0, all = 0;

  for (int y = 0; y < paint->height; y += step)
    for (int x = 0; x < paint->width; x += step, all++)
      dark += lightness (CELD_RGBA (paint, x, y), false, false) < 128;
  return 2 * dark > all;
}

/* Makes the cells of a page. */
static CeldStatus
cells_new (const CeldPaint *paint, bool darkest, CeldMask *cells)
{
  int  longer = paint->width > paint->height ? paint->width : paint->height;
  int  side = (longer + LONGER_SIDE - 1) / LONGER_SIDE, step = side > CELL_SAMPLES ? side / CELL_SAMPLES : 1;
  bool dark_page = is_dark_page (paint, step);

  *cells = (CeldMask) { .width = (paint->width + side - 1) / side, .height = (paint->height + side - 1) / side };
  cells->stride = (size_t) cells->width;
  cells->data = celd_alloc (cells->stride * (size_t) cells->height, 1);
  if (!cells->data)
    return CELD_NO_MEMORY;
  memset (cells->data, 255, cells->stride * (size_t) cells->height);
  for (int y = 0; y < paint->height; y += step)
    for (int x = 0; x < paint->width; x += step)
      {
        uint8_t  value = lightness (CELD_RGBA (paint, x, y), dark_page, darkest);
        uint8_t *cell = &CELD_AT (cells, x / side, y / side);

        *cell = value < *cell ? value : *cell;
      }
  return CELD_OK;
}

/* ------------------------------------------------------------------ rooms */

/* Labels what is no line 1, and lines 0; `labels` is tight. */
static CeldStatus
find_lines (const CeldMask *cells, int radius, CeldLabels *labels)
{
  CeldMask   closed = *cells;
  void      *work = celd_alloc (celd_erosion_work (cells->width, radius), 1);
  size_t     n = cells->stride * (size_t) cells->height;
  CeldStatus status = CELD_NO_MEMORY;

  closed.data = celd_alloc (n, 1);
  if (work && closed.data)
    {
      celd_close_bytes (cells, radius, work, &closed);
      for (size_t i = 0; i < n; i++)
        labels->data[i] = closed.data[i] - cells->data[i] <= CELL_CONTRAST;
      status = CELD_OK;
    }
  celd_free (work);
  celd_free (closed.data);
  return status;
}

static CeldStatus
count_rooms (const CeldPaint *paint, bool darkest, int radius, size_t *n_rooms)
{
  CeldMask       cells = { 0 };
  CeldLabels     labels = { 0 };
  CeldComponent *part = NULL;
  size_t         n = 0;
  CeldStatus     status = CELD_OK;

  *n_rooms = 0;
  if (paint->width < ROOM_SIDE || paint->height < ROOM_SIDE)
    return CELD_OK;
  status = cells_new (paint, darkest, &cells);
  if (status == CELD_OK)
    status = celd_labels_new (cells.width, cells.height, &labels);
  if (status == CELD_OK)
    status = find_lines (&cells, radius, &labels);
  if (status == CELD_OK)
    status = celd_components (&labels, 0, false, NULL, &labels, &part, &n);
  for (size_t k = 0; k < n && status == CELD_OK; k++)
    *n_rooms += ROOM_SHARE * part[k].area >= cells.stride * (size_t) cells.height;
  celd_free (part);
  celd_free (labels.data);
  celd_free (cells.data);
  return status;
}

/* ------------------------------------------------------------------ copies */

/* How many cells there are, how many have something drawn in either picture, and how many differ. */
typedef struct { size_t n, drawn, differing; } Likeness;

static CeldStatus
compare (const CeldPaint *a, const CeldPaint *b, bool darkest, Likeness *found)
{
  CeldMask   of_a = { 0 }, of_b = { 0 };
  CeldStatus status = cells_new (a, darkest, &of_a);

  *found = (Likeness) { 0 };
  if (status == CELD_OK)
    status = cells_new (b, darkest, &of_b);
  if (status == CELD_OK)
    found->n = of_a.stride * (size_t) of_a.height;
  for (size_t i = 0; i < found->n; i++)
    {
      found->differing += abs (of_a.data[i] - of_b.data[i]) > STORED;
      found->drawn += of_a.data[i] < 255 - STORED || of_b.data[i] < 255 - STORED;
    }
  celd_free (of_a.data);
  celd_free (of_b.data);
  return status;
}

static bool
are_same (const Likeness *found)
{
  return SAME_SHARE * found->differing <= found->n && SAME_DRAWN * found->differing <= found->drawn;
}

CeldStatus
celd_is_copy (const CeldPaint *a, const CeldPaint *b, bool *same)
{
  Likeness light = { 0 }, dark = { 0 };
  CeldStatus status = CELD_OK;

  *same = false;
  if (a->width != b->width || a->height != b->height)
    return CELD_OK;
  status = compare (a, b, false, &light);
  if (status == CELD_OK && are_same (&light))
    {
      status = compare (a, b, true, &dark);
      *same  = are_same (&dark) && dark.drawn;
    }
  return status;
}

CeldStatus
celd_is_flattened (const CeldPaint *drawing, const CeldPaint *strokes, bool *flattened)
{
  Likeness found = { 0 };
  CeldStatus status = CELD_SAME_SIZE (drawing, strokes) ? compare (drawing, strokes, true, &found) : CELD_BAD_SIZE;

  if (status == CELD_OK)
    *flattened = found.drawn && 2 * found.drawn < found.n && FLAT_DRAWN * found.differing <= found.drawn;
  return status;
}

/* ------------------------------------------------------------------ lines in a layer */

/* How light a pixel is on white paper, as lines go: clear colours are none. */
static float
lightness_of_line (const uint8_t *p)
{
  int most = p[0] > p[1] ? p[0] : p[1], least = p[0] < p[1] ? p[0] : p[1];

  most  = p[2] > most ? p[2] : most;
  least = p[2] < least ? p[2] : least;
  return p[3] < 128 || most - least >= CELD_CLEAR_HUE ? 1 : (float) most / 255;
}

CeldStatus
celd_layer_lines (const CeldPaint *layer, const CeldPlane *ink, CeldLayerLines *lines)
{
  CeldPlane  plane = { 0 };
  bool       drawn = false;
  CeldStatus status;

  if (!CELD_SAME_SIZE (layer, ink))
    return CELD_BAD_SIZE;
  status = celd_may_be_drawing (layer, &drawn);
  if (status == CELD_OK && drawn)
    status = celd_plane_new (layer->width, layer->height, &plane);
  for (int y = 0; plane.data && y < layer->height; y++)
    for (int x = 0; x < layer->width; x++)
      CELD_AT (&plane, x, y) = lightness_of_line (CELD_RGBA (layer, x, y));
  if (status == CELD_OK && drawn)
    status = celd_find_lines (&plane, 0, 1, ink, &drawn);
  if (status == CELD_OK)
    *lines = !drawn ? CELD_LAYER_WITHOUT_LINES
           : celd_paint_has_colours (layer) || celd_paint_is_coloured (layer) ? CELD_LAYER_COLOURED
                                                                              : CELD_LAYER_OF_LINES;
  celd_free (plane.data);
  return status;
}

/* ------------------------------------------------------------------ what was mixed up */

CeldStatus
celd_may_be_drawing (const CeldPaint *scribbles, bool *may_be)
{
  size_t     rooms = 0;
  bool       grey = celd_is_grey (scribbles);
  CeldStatus status = grey ? CELD_OK : count_rooms (scribbles, false, BROAD_RADIUS, &rooms);

  *may_be = grey || rooms > 1;
  return status;
}

/* Whether grey scribbles are parted as only a drawing is.  On a dark page fills with gaps between may look so. */
static CeldStatus
look_for_rooms (const CeldPaint *scribbles, bool *drawn)
{
  size_t     rooms = 0;
  CeldStatus status = CELD_OK;

  if (celd_is_grey (scribbles) && !is_dark_page (scribbles, 1))
    status = count_rooms (scribbles, false, LINE_RADIUS, &rooms);
  *drawn = rooms >= MANY_ROOMS;
  return status;
}

/* Whether the drawing is in colour and parted less than the scribbles: far less, unless it is plainly strokes, and the
 * scribbles are in grey. */
static CeldStatus
compare_rooms (const CeldPaint *drawing, const CeldPaint *scribbles, bool *exchanged)
{
  bool       plain = celd_is_grey (scribbles) && celd_is_coloured_strokes (drawing);
  size_t     rooms = 0, dark = 0, narrow = 0;
  CeldStatus status = count_rooms (scribbles, false, LINE_RADIUS, &rooms);

  if (status == CELD_OK)
    status = count_rooms (drawing, false, LINE_RADIUS, &dark);
  if (status == CELD_OK)
    status = count_rooms (drawing, true, LINE_RADIUS, &narrow);
  *exchanged = plain ? dark <= rooms
                     : rooms >= LEAST_ROOMS && MORE_ROOMS * (dark > narrow ? dark : narrow) <= rooms;
  return status;
}

CeldStatus
celd_mix_up (const CeldPaint *drawing, const CeldPaint *scribbles, CeldMixUp *mix_up)
{
  bool       same = false, exchanged = false, drawn = false;
  CeldStatus status = celd_is_copy (drawing, scribbles, &same);

  if (status == CELD_OK && !same && !celd_is_grey (drawing))
    status = compare_rooms (drawing, scribbles, &exchanged);
  if (status == CELD_OK && !same && !exchanged)
    status = look_for_rooms (scribbles, &drawn);
  if (status == CELD_OK)
    *mix_up = same ? CELD_LAYERS_SAME
            : exchanged ? CELD_LAYERS_EXCHANGED : drawn ? CELD_LAYERS_DRAWN : CELD_LAYERS_APART;
  return status;
}
