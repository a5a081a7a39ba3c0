/* Which label is the background, and what of the paper along the frame it gets.
 *
 * Paper along the frame belongs to the label that holds most of it: the label with most paint in a piece of paper holds
 * that piece, where strokes that are at home elsewhere do not count.  Pieces along the frame that nobody holds are seeded
 * for that label; or, if no label holds a quarter of the frame and more of it is nobody's, for a transparent label of
 * their own.  (Parts of a figure that the frame cuts off hold a little of it; they are not the background.)
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment.h"

typedef struct
{
  size_t   *pixel;     /* paper along the frame */
  size_t    n;
  uint32_t *holder;    /* of piece k: the label that holds it, holder[k]; 0 = nobody */
  size_t   *held;      /* of label l: frame pixels, held[l]; held[0]: nobody's */
} Frame;

/* The label with most paint in each piece.  With soft strokes only those that leave at least half of their paint there. */
static void
find_holders (const CeldCanvas *canvas, const CeldSpread *spread, uint32_t *holder)
{
  bool all_count = canvas->settings->flats || canvas->settings->hardness >= 1;

  for (size_t i = 0; i < spread->n;)
    {
      uint32_t piece = spread->share[i].piece;
      size_t   most = 0;

      while (i < spread->n && spread->share[i].piece == piece)
        {
          uint32_t label = spread->share[i].label;
          size_t   paint = 0;

          for (; i < spread->n && spread->share[i].piece == piece && spread->share[i].label == label; i++)
            if (all_count || 2 * spread->share[i].pixels >= spread->total[spread->share[i].stroke])
              paint += spread->share[i].pixels;
          if (paint > most)
            {
              most          = paint;
              holder[piece] = label;
            }
        }
    }
}

/* Label 0 if the frame is nobody's. */
static uint32_t
main_holder (const Frame *frame, size_t n_labels)
{
  uint32_t best = 0;

  for (uint32_t l = 1; l <= n_labels; l++)
    if (frame->held[l] && (!best || frame->held[l] > frame->held[best]))
      best = l;
  if (best && 4 * frame->held[best] < frame->n && frame->held[0] > frame->held[best])
    return 0;
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

/* Pieces along the frame that nobody holds get the background's seeds there, and lose the stains in them. */
static void
seed (CeldCanvas *canvas, const Frame *frame, uint32_t label, bool *along)
{
  for (size_t i = 0; i < frame->n; i++)
    along[canvas->pieces.data[frame->pixel[i]]] = true;
  for (size_t p = 0; p < canvas->n; p++)
    if (along[canvas->pieces.data[p]] && !frame->holder[canvas->pieces.data[p]])
      canvas->seeds.data[p] = 0;
  for (size_t i = 0; i < frame->n; i++)
    if (!frame->holder[canvas->pieces.data[frame->pixel[i]]])
      canvas->seeds.data[frame->pixel[i]] = label;
}

CeldStatus
celd_background_seed (const CeldRun *run, CeldCanvas *canvas)
{
  Frame      frame = { 0 };
  CeldSpread spread = { 0 };
  bool      *along = NULL;
  uint32_t   label = 0;
  CeldStatus status;

  if (canvas->settings->background == CELD_BACKGROUND_NONE)
    return CELD_OK;
  status = celd_frame (canvas->ink, canvas->width, canvas->height, &frame.pixel, &frame.n);
  if (status == CELD_OK)
    status = celd_spread_new (canvas, run, &spread);
  if (status != CELD_OK)
    goto done;
  status = CELD_NO_MEMORY;
  frame.holder = celd_alloc0 (canvas->n_pieces + 1, sizeof *frame.holder);
  frame.held   = celd_alloc0 (canvas->palette.n + 1, sizeof *frame.held);
  along        = celd_alloc0 (canvas->n_pieces + 1, sizeof *along);
  if (!frame.holder || !frame.held || !along)
    goto done;
  find_holders (canvas, &spread, frame.holder);
  for (size_t i = 0; i < frame.n; i++)
    frame.held[frame.holder[canvas->pieces.data[frame.pixel[i]]]]++;
  status = choose (canvas, &frame, &label);
  if (status != CELD_OK || !label)
    goto done;
  canvas->palette.item[label - 1].background = true;
  seed (canvas, &frame, label, along);

done:
  celd_spread_clear (&spread);
  celd_free (frame.pixel);
  celd_free (frame.holder);
  celd_free (frame.held);
  celd_free (along);
  return status;
}
