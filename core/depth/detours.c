/* Whether a short detour leads around a cut.  A cut that ends nearby separates nothing.
 *
 * Flood fill in a small window, with one bit for each pixel, so that a whole row is filled at once.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"

#define DETOUR_RADIUS 7 /* pixels that a detour may leave the cut (chosen) */
#define WINDOW        (2 * DETOUR_RADIUS + 1)

/* ------------------------------------------------------------------ bits */

static void
set_bits (const float *weight, int n, uint64_t *bits)
{
  for (int x = 0; x < n; x += 64)
    {
      uint64_t word = 0;

      for (int k = 0; k < 64 && x + k < n; k++)
        word |= (uint64_t) (weight[x + k] > 0) << k;
      bits[x / 64] = word;
    }
}

CeldStatus
celd_pixel_links_new (int width, int height, const float *east, const float *south, CeldPixelLinks *joined)
{
  size_t w = (size_t) width, words = (w + 63) / 64;

  *joined = (CeldPixelLinks) {
    height, words, celd_alloc0 ((size_t) height * words, sizeof *joined->east),
    celd_alloc0 ((size_t) height * words, sizeof *joined->south),
  };
  if (!joined->east || !joined->south)
    return CELD_NO_MEMORY;
  for (size_t y = 0; y < (size_t) height; y++)
    {
      set_bits (east + y * w, width - 1, joined->east + y * words);
      set_bits (south + y * w, y + 1 < (size_t) height ? width : 0, joined->south + y * words);
    }
  return CELD_OK;
}

void
celd_pixel_links_clear (CeldPixelLinks *joined)
{
  celd_free (joined->east);
  celd_free (joined->south);
}

/* ------------------------------------------------------------------ detours */

/* The bits of pixels x - DETOUR_RADIUS .. x + DETOUR_RADIUS of row y; 0 outside the picture. */
static inline uint32_t
window_row (const CeldPixelLinks *g, const uint64_t *bits, int x, int y)
{
  const uint64_t *row = bits + (size_t) y * g->words;
  int             from = x - DETOUR_RADIUS, word = from >= 0 ? from / 64 : -1, shift = from - 64 * word;
  uint64_t        low = word >= 0 ? row[word] : 0, high = (size_t) (word + 1) < g->words ? row[word + 1] : 0;

  return (uint32_t) ((low >> shift) | (shift ? high << (64 - shift) : 0)) & ((1u << WINDOW) - 1);
}

/* Extends the filled pixels of a row along its links. */
static inline uint32_t
spread (uint32_t seen, uint32_t east)
{
  for (uint32_t before = 0; before != seen;)
    {
      before = seen;
      seen |= (seen & east) << 1;
      seen |= (seen >> 1) & east;
    }
  return seen & ((1u << WINDOW) - 1);
}

bool
celd_has_detour (const CeldPixelLinks *g, int x, int y, bool down)
{
  uint32_t east[WINDOW], south[WINDOW], seen[WINDOW] = { 0 };
  bool     grown = true;

  for (int r = 0; r < WINDOW; r++)
    {
      int  v = y + r - DETOUR_RADIUS;
      bool inside = v >= 0 && v < g->height;

      east[r]  = inside ? window_row (g, g->east, x, v) & ((1u << (WINDOW - 1)) - 1) : 0;
      south[r] = inside && r + 1 < WINDOW ? window_row (g, g->south, x, v) : 0;
    }
  seen[DETOUR_RADIUS] = 1u << DETOUR_RADIUS;
  while (grown)
    {
      grown = false;
      for (int k = 0; k < 2 * WINDOW; k++)
        {
          int      r = k < WINDOW ? k : 2 * WINDOW - 1 - k;
          uint32_t now = seen[r];

          now |= r > 0 ? seen[r - 1] & south[r - 1] : 0;
          now |= r + 1 < WINDOW ? seen[r + 1] & south[r] : 0;
          now   = now == seen[r] && r != DETOUR_RADIUS ? now : spread (now, east[r]);
          grown = grown || now != seen[r];
          seen[r] = now;
        }
      if (down ? seen[DETOUR_RADIUS + 1] >> DETOUR_RADIUS & 1 : seen[DETOUR_RADIUS] >> (DETOUR_RADIUS + 1) & 1)
        return true;
    }
  return false;
}
