/* Which label is the background, and what of the paper along the frame it gets.
 *
 * Paper along the frame belongs to the label that holds most of it: the label with most paint in a room
 * (basin-unions.c) holds that room, where strokes that are at home elsewhere do not count.  A stroke is at home where
 * it leaves at least half of its paint.  One that is at home nowhere, but leaves half along the frame, runs on over
 * hatching: it counts in every room there.  Rooms along the frame that nobody holds are seeded for that label; or, if
 * no label holds a quarter of the frame or runs on over hatching, and more of it is nobody's, for a transparent label
 * of their own.  (Parts of a figure that the frame cuts off hold a little of it; they are not the background.)
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/canvas.h"

#define MAIN_SHARE 4 /* a quarter of the frame is the main part of it */

typedef struct
{
  size_t   *pixel;     /* paper along the frame */
  uint32_t *basin;     /* of each of these */
  uint32_t *holder;    /* the label that holds it; 0 = nobody */
  size_t    n;
  size_t   *held;      /* of label l: frame pixels, held[l]; held[0]: nobody's */
  bool     *across;    /* does a stroke of label l run on along the frame, through rooms where it is not at home? */
} Frame;

/* Without flecks of paper in solid ink, which are in no room. */
static CeldStatus
frame_new (const CeldCanvas *canvas, Frame *frame)
{
  int        w = canvas->ink->width, h = canvas->ink->height;
  size_t     n = 0;
  CeldStatus status = celd_frame (canvas->ink, w, h, canvas->basins->stroke, &frame->pixel, &frame->n);

  if (status != CELD_OK)
    return status;
  frame->basin  = celd_alloc (frame->n, sizeof *frame->basin);
  frame->holder = celd_alloc (frame->n, sizeof *frame->holder);
  frame->held   = celd_alloc0 (canvas->palette.n + 1, sizeof *frame->held);
  frame->across = celd_alloc0 (canvas->palette.n + 1, sizeof *frame->across);
  if (!frame->basin || !frame->holder || !frame->held || !frame->across)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < frame->n; i++)
    {
      size_t   p = frame->pixel[i];
      uint32_t basin = celd_basin_at (canvas->basins, (int) (p % (size_t) w), (int) (p / (size_t) w));

      if (!canvas->basins->room[basin])
        continue;
      frame->pixel[n]   = p;
      frame->basin[n++] = basin;
    }
  frame->n = n;
  return CELD_OK;
}

static void
frame_clear (Frame *frame)
{
  celd_free (frame->pixel);
  celd_free (frame->basin);
  celd_free (frame->holder);
  celd_free (frame->held);
  celd_free (frame->across);
}

/* ------------------------------------------------------------------ who holds the frame */

/* scattered[k]: of stroke k, which is at home nowhere, the paint in parts along the frame; 0 of all others. */
static void
find_scattered (const CeldSpread *spread, const size_t *along, size_t *scattered)
{
  for (size_t i = 0; i < spread->n; i++)
    if (along[spread->share[i].part])
      scattered[spread->share[i].stroke] += spread->share[i].pixels;
  for (size_t i = 0; i < spread->n; i++)
    if (2 * spread->share[i].pixels >= spread->total[spread->share[i].stroke])
      scattered[spread->share[i].stroke] = 0;
}

/* holder[k]: the label with most paint in part k, 0 if there is none.  Soft strokes count only where they are at home,
 * and along the frame those that are scattered there.  along[k]: pixels of the frame in part k. */
static CeldStatus
find_holders (const CeldSpread *spread, bool all_count, const size_t *along, bool *across, uint32_t *holder)
{
  size_t *scattered = celd_alloc0 (spread->n_strokes, sizeof *scattered);

  if (!scattered)
    return CELD_NO_MEMORY;
  find_scattered (spread, along, scattered);
  for (size_t i = 0; i < spread->n;)
    {
      uint32_t part = spread->share[i].part;
      size_t   most = 0;

      while (i < spread->n && spread->share[i].part == part)
        {
          uint32_t label = spread->share[i].label;
          size_t   paint = 0;

          for (; i < spread->n && spread->share[i].part == part && spread->share[i].label == label; i++)
            {
              const CeldShare *share = &spread->share[i];
              size_t           total = spread->total[share->stroke];
              bool             runs_on = along[part] && 2 * scattered[share->stroke] >= total;

              across[label] |= runs_on;
              paint += all_count || runs_on || 2 * share->pixels >= total ? share->pixels : 0;
            }
          if (paint > most)
            {
              most         = paint;
              holder[part] = label;
            }
        }
    }
  celd_free (scattered);
  return CELD_OK;
}

/* Who holds each part of the drawing. */
static CeldStatus
hold_parts (const CeldCanvas *canvas, Frame *frame, const uint32_t *part, CeldSpread *spread, size_t *along,
            uint32_t *holder)
{
  CeldStatus status = celd_spread_share (canvas->basins, part, spread);

  for (size_t i = 0; i < frame->n; i++)
    along[part[frame->basin[i]]]++;
  if (status == CELD_OK)
    status = find_holders (spread, celd_canvas_obeys (canvas), along, frame->across, holder);
  return status;
}

/* Who holds each pixel of the frame: who holds its room; behind a small gap in a contour, where its room is not most of
 * the frame, also who holds its piece. */
static CeldStatus
hold_frame (const CeldCanvas *canvas, CeldSpread *spread, Frame *frame)
{
  const CeldBasins *b = canvas->basins;
  uint32_t         *of_piece = celd_alloc0 (b->n_pieces + 1, sizeof *of_piece);
  uint32_t         *of_room = celd_alloc0 (b->n_rooms + 1, sizeof *of_room);
  size_t           *piece_along = celd_alloc0 (b->n_pieces + 1, sizeof *piece_along);
  size_t           *room_along = celd_alloc0 (b->n_rooms + 1, sizeof *room_along);
  CeldStatus        status = of_piece && of_room && piece_along && room_along ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = hold_parts (canvas, frame, b->room, spread, room_along, of_room);
  if (status == CELD_OK)
    status = hold_parts (canvas, frame, b->piece, spread, piece_along, of_piece);
  for (size_t i = 0; i < frame->n && status == CELD_OK; i++)
    {
      uint32_t room = b->room[frame->basin[i]];

      frame->holder[i] = of_room[room] || MAIN_SHARE * room_along[room] >= frame->n
                         ? of_room[room] : of_piece[b->piece[frame->basin[i]]];
      frame->held[frame->holder[i]]++;
    }
  celd_free (of_piece);
  celd_free (of_room);
  celd_free (piece_along);
  celd_free (room_along);
  return status;
}

/* ------------------------------------------------------------------ what it gets */

/* The label that holds most of the frame, or most of those that run on along it; 0 if there is none. */
static uint32_t
most_held (const Frame *frame, size_t n_labels, bool across)
{
  uint32_t best = 0;

  for (uint32_t l = 1; l <= n_labels; l++)
    if ((frame->across[l] || !across) && frame->held[l] && (!best || frame->held[l] > frame->held[best]))
      best = l;
  return best;
}

/* Label 0 if the frame is nobody's. */
static uint32_t
main_holder (const Frame *frame, size_t n_labels)
{
  uint32_t best = most_held (frame, n_labels, false);

  if (best && MAIN_SHARE * frame->held[best] < frame->n && frame->held[0] > frame->held[best])
    return most_held (frame, n_labels, true);
  return best;
}

/* The background's label as the settings want it, made if need be; 0 if there is none. */
static CeldStatus
choose (CeldCanvas *canvas, const Frame *frame, uint32_t *label)
{
  const CeldSettings *s = canvas->settings;
  bool                by_colour = s->background == CELD_BACKGROUND_COLOUR;
  const uint8_t      *c = s->background_colour;
  CeldRegion          made = { .origin = CELD_FROM_BACKGROUND, .hard = true };

  *label = by_colour ? celd_palette_find (&canvas->palette, c) : main_holder (frame, canvas->palette.n);
  if (*label || !frame->held[0])
    return CELD_OK;
  if (by_colour)
    made = (CeldRegion) { .colour = { c[0], c[1], c[2], 255 }, .origin = CELD_FROM_BACKGROUND, .hard = true };
  return celd_canvas_add (canvas, made, label);
}

/* Rooms along the frame that nobody holds get the background's seeds there, and lose the stains in them.  A stroke that
 * must be obeyed may lie there where a bridge hides the paper: it stays. */
static CeldStatus
seed (CeldCanvas *canvas, const CeldSpread *spread, Frame *frame, uint32_t label)
{
  size_t          w = (size_t) canvas->ink->width;
  const uint32_t *room = canvas->basins->room;
  bool           *nobodys = celd_alloc0 (canvas->basins->n_rooms + 1, sizeof *nobodys);
  CeldStatus      status = nobodys ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < frame->n && status == CELD_OK; i++)
    if (!frame->holder[i])
      nobodys[room[frame->basin[i]]] = true;
  for (size_t i = 0; i < spread->n_dabs && status == CELD_OK && !celd_canvas_obeys (canvas); i++)
    if (nobodys[room[spread->dab[i].basin]])
      status = celd_dab_remove (canvas, &spread->dab[i]);
  for (size_t i = 0; i < frame->n; i++)
    if (!frame->holder[i])
      frame->holder[i] = celd_seed_rows_at (&canvas->seeds, (int) (frame->pixel[i] % w), (int) (frame->pixel[i] / w));
  for (size_t i = 0, next; i < frame->n && status == CELD_OK; i = next)
    {
      size_t p = frame->pixel[i];

      next = i + 1;
      if (frame->holder[i])
        continue;
      while (next < frame->n && !frame->holder[next] && frame->pixel[next] == p + next - i && (p + next - i) % w)
        next++;
      status = celd_seed_rows_paint (&canvas->seeds, (int) (p / w), (int) (p % w), (int) (p % w + next - i), label);
    }
  celd_free (nobodys);
  return status;
}

CeldStatus
celd_background_seed (const CeldHost *host, CeldCanvas *canvas)
{
  Frame      frame = { 0 };
  CeldSpread own = { 0 }, *spread = canvas->painted.dab && !canvas->stained ? &canvas->painted : &own;
  uint32_t   label = 0;
  CeldStatus status;

  if (canvas->settings->background == CELD_BACKGROUND_NONE)
    return CELD_OK;
  status = frame_new (canvas, &frame);
  if (status == CELD_OK && spread == &own)
    status = celd_spread_new (canvas, NULL, spread);
  if (status == CELD_OK)
    status = hold_frame (canvas, spread, &frame);
  if (status == CELD_OK)
    status = choose (canvas, &frame, &label);
  if (status == CELD_OK && label)
    {
      canvas->palette.item[label - 1].background = true;
      status = seed (canvas, spread, &frame, label);
    }
  celd_spread_clear (&own);
  frame_clear (&frame);
  return status == CELD_OK ? celd_progress (host, 1) : status;
}
