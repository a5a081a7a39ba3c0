/* Gradients of a flat colouring: each becomes one colour.
 *
 * Neighbouring pixels belong together if their colours are almost equal, or if they are on a slope: three steps in a
 * row of similar length and direction.  An antialiased edge is too short for that; along a slanting edge its pixels are
 * a slope, but they belong to neither side of it.  What is left over beside lines and where slopes end joins the piece
 * from which it differs by one such step; other specks have no label if the picture is antialiased.  The colour of a
 * piece is the one nearest to its mean; a fill without a gradient keeps its own.
 *
 * Cost: O(pixels); 40 bytes a piece.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "input/input.h"

#include <stdlib.h>
#include <string.h>

/* Distances between channels of neighbouring pixels, in steps of 1/255; all chosen. */
#define EQUAL_STEP 2  /* at most: slow gradients, and rounding */
#define SLOPE_STEP 12 /* at most, on a slope */
#define ROUGHNESS  2  /* by which steps of a slope may differ, beside a factor of two */

typedef struct { uint64_t sum[3]; uint32_t n, id; int distance; } FlatPiece;

typedef struct { int channel[3], most; } ColourStep;

static ColourStep
step_between (const CeldScribbleLayer *r, size_t p, size_t q)
{
  const int *a = r->colour[r->id[p]].channel, *b = r->colour[r->id[q]].channel;
  ColourStep step = { .most = 0 };

  for (int c = 0; c < 3; c++)
    {
      step.channel[c] = b[c] - a[c];
      step.most = abs (step.channel[c]) > step.most ? abs (step.channel[c]) : step.most;
    }
  return step;
}

static bool
alike (ColourStep a, ColourStep b)
{
  int dot = 0;

  for (int c = 0; c < 3; c++)
    dot += a.channel[c] * b.channel[c];
  return dot > 0 && a.most <= 2 * b.most + ROUGHNESS && b.most <= 2 * a.most + ROUGHNESS;
}

/* A pixel, and a direction: the next pixel is `next` further; there are `before` pixels before it, `after` after it. */
typedef struct { size_t pixel, next; int before, after; } PixelWay;

static PixelWay
along_row (const CeldScribbleLayer *r, int x, int y)
{
  return (PixelWay) { (size_t) y * (size_t) r->width + (size_t) x, 1, x, r->width - 1 - x };
}

static PixelWay
along_column (const CeldScribbleLayer *r, int x, int y)
{
  return (PixelWay) { (size_t) y * (size_t) r->width + (size_t) x, (size_t) r->width, y, r->height - 1 - y };
}

/* Whether the colours of a pixel and the next one are almost equal or on a slope. */
static bool
goes_on (const CeldScribbleLayer *r, PixelWay a)
{
  size_t     p = a.pixel, next = a.next;
  ColourStep step;

  if (!r->id[p] || !r->id[p + next])
    return false;
  step = step_between (r, p, p + next);
  if (step.most <= EQUAL_STEP)
    return true;
  return step.most <= SLOPE_STEP && a.before > 0 && a.after > 1 && r->id[p - next] && r->id[p + 2 * next] &&
         alike (step, step_between (r, p - next, p)) && alike (step, step_between (r, p + next, p + 2 * next));
}

/* Whether the pixel belongs to neither side, in a direction. */
static bool
is_between (const CeldScribbleLayer *r, PixelWay a)
{
  PixelWay before = { a.pixel - a.next, a.next, a.before - 1, a.after + 1 };

  return a.before > 0 && a.after > 0 && !goes_on (r, before) && !goes_on (r, a);
}

/* Whether a pixel and the next one belong together; `across` has the other direction at each of them. */
static bool
belong_together (const CeldScribbleLayer *r, PixelWay a, const PixelWay across[2])
{
  if (a.after < 1)
    return false;
  if (r->id[a.pixel] == r->id[a.pixel + a.next])
    return r->id[a.pixel];
  return goes_on (r, a) && !is_between (r, across[0]) && !is_between (r, across[1]);
}

/* ------------------------------------------------------------------ pieces: union-find in r->label */

static void
find_pieces (CeldScribbleLayer *r)
{
  celd_roots (r->label, r->pixels);
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      {
        PixelWay row = along_row (r, x, y), column = along_column (r, x, y);

        if (belong_together (r, row, (PixelWay[]) { column, along_column (r, x + 1, y) }))
          celd_join (r->label, (uint32_t) row.pixel, (uint32_t) (row.pixel + row.next));
        if (belong_together (r, column, (PixelWay[]) { row, along_row (r, x, y + 1) }))
          celd_join (r->label, (uint32_t) column.pixel, (uint32_t) (column.pixel + column.next));
      }
}

/* Numbers the pieces, in r->label; returns how many there are. */
static size_t
number_pieces (CeldScribbleLayer *r)
{
  size_t n = 0;

  for (size_t p = 0; p < r->pixels; p++)
    r->label[p] = celd_root (r->label, (uint32_t) p);
  for (size_t p = 0; p < r->pixels; p++) /* a root comes before all others of its piece */
    r->label[p] = r->label[p] == p ? (uint32_t) n++ : r->label[r->label[p]];
  return n;
}

/* ------------------------------------------------------------------ colours of pieces */

static void
find_means (const CeldScribbleLayer *r, FlatPiece *piece)
{
  for (size_t p = 0; p < r->pixels; p++)
    {
      FlatPiece *own = &piece[r->label[p]];

      for (int c = 0; c < 3; c++)
        own->sum[c] += (uint64_t) r->colour[r->id[p]].channel[c];
      own->n++;
      own->distance = INT32_MAX;
    }
}

static void
find_nearest (const CeldScribbleLayer *r, FlatPiece *piece)
{
  for (size_t p = 0; p < r->pixels; p++)
    {
      FlatPiece *own = &piece[r->label[p]];
      int    mean[3], distance;

      for (int c = 0; c < 3; c++)
        mean[c] = (int) ((own->sum[c] + own->n / 2) / own->n);
      distance = celd_colour_distance (mean, r->colour[r->id[p]].channel);
      if (distance >= own->distance)
        continue;
      own->distance = distance;
      own->id = r->id[p];
    }
}

/* The piece that a pixel of a small one joins: the large one beside it from which it differs least.  Pixels that have
 * joined one, marked in r->kind, do not count. */
static uint32_t
piece_beside (const CeldScribbleLayer *r, const FlatPiece *piece, int x, int y)
{
  static const struct { int x, y; } beside[] = { { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } };
  size_t   p = (size_t) y * (size_t) r->width + (size_t) x;
  uint32_t found = r->label[p];
  int      least = SLOPE_STEP + 1;

  for (int i = 0; i < 4; i++)
    {
      int    u = x + beside[i].x, v = y + beside[i].y, most;
      size_t q = (size_t) v * (size_t) r->width + (size_t) u;

      if (u < 0 || v < 0 || u >= r->width || v >= r->height || !r->id[q] || r->kind[q] ||
          piece[r->label[q]].n < CELD_SPECK)
        continue;
      most = step_between (r, p, q).most;
      if (most >= least)
        continue;
      least = most;
      found = r->label[q];
    }
  return found;
}

static void
join_rest (CeldScribbleLayer *r, const FlatPiece *piece)
{
  memset (r->kind, 0, r->pixels);
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      {
        size_t   p = (size_t) y * (size_t) r->width + (size_t) x;
        uint32_t own = r->label[p];

        if (!r->id[p] || piece[own].n >= CELD_SPECK)
          continue;
        r->label[p] = piece_beside (r, piece, x, y);
        r->kind[p] = r->label[p] != own;
      }
}

/* Whether most pieces are single pixels, as at antialiased edges; labels that a program wrote have none. */
static bool
is_antialiased (const FlatPiece *piece, size_t n)
{
  size_t single = 0;

  for (size_t i = 0; i < n; i++)
    single += piece[i].n == 1;
  return 2 * single > n;
}

/* Gives each pixel the colour of its piece, those of pieces smaller than `least` none, and counts colours again. */
static void
write_colours (CeldScribbleLayer *r, const FlatPiece *piece, uint32_t least)
{
  for (size_t i = 0; i < r->n; i++)
    r->colour[i].opacity = r->colour[i].pixels = 0;
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      {
        size_t              p = (size_t) y * (size_t) r->width + (size_t) x;
        CeldScribbleColour *colour;

        if (r->id[p])
          r->id[p] = piece[r->label[p]].n < least ? 0 : piece[r->label[p]].id;
        colour = &r->colour[r->id[p]];
        colour->pixels++;
        colour->opacity += CELD_RGBA (r->paint, x, y)[3];
      }
}

CeldStatus
celd_scribble_gradients (CeldScribbleLayer *r)
{
  FlatPiece *piece;
  size_t n;

  find_pieces (r);
  n = number_pieces (r);
  piece = celd_alloc0 (n, sizeof *piece);
  if (!piece)
    return CELD_NO_MEMORY;
  find_means (r, piece);
  find_nearest (r, piece);
  join_rest (r, piece);
  write_colours (r, piece, is_antialiased (piece, n) ? CELD_SPECK : 0);
  celd_free (piece);
  return CELD_OK;
}
