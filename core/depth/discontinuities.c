/* Depth discontinuities: the weights v_pq of eq. (3), and which cuts separate anything.
 *
 * The paper sets v_pq = I_p where levels differ.  With antialiased ink depth then leaks along whole contours, even more
 * after expansion, when the boundary runs along the edge of the ink.  So here v_pq is the least ink within half a
 * stroke width of p and q, and exactly 0 where that is full ink.  Then a closed contour is a discontinuity whether
 * levels are expanded or not, a nick no wider than the stroke does not open it at any resolution, and a gap that does
 * not hold depth (held-gaps.c) or a virtual contour gives a smooth transition.
 *
 * A line of about a pixel is full ink nowhere, where it lies between two rows of pixels: it is found by the ink across
 * it, which adds up to its width.
 *
 * A cut that ends nearby separates nothing: then a short detour leads around it.  That is found by flood fill in a
 * small window, with one bit for each pixel, so that a whole row is filled at once.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "image/image.h"

#define LARGEST_RADIUS 12 /* pixels: half the width of the widest stroke; wider ink is an area (chosen) */
#define THICKEST       3    /* pixels of a thin line across that may be half as dark as its darkest (chosen) */
#define THINNEST       0.5f /* pixels: width of the thinnest line that is a discontinuity (chosen) */
#define DETOUR_RADIUS  7  /* pixels that a detour may leave the cut (chosen) */
#define WINDOW         (2 * DETOUR_RADIUS + 1)

int
celd_edge_radius (int stroke)
{
  int radius = (stroke + 1) / 2;

  return radius < 1 ? 1 : radius > LARGEST_RADIUS ? LARGEST_RADIUS : radius;
}

/* The least ink of the pixels x0 .. x1, y0 .. y1 in the picture, or any value at or below the threshold if there is
 * one; NaN reads as paper. */
static float
least_ink (const CeldDepthEdges *b, int x0, int y0, int x1, int y1)
{
  float least = 1;

  for (int y = y0 > 0 ? y0 : 0; y <= y1 && y < b->ink->height && least > b->threshold; y++)
    for (int x = x0 > 0 ? x0 : 0; x <= x1 && x < b->ink->width; x++)
      if (CELD_AT (b->ink, x, y) < least)
        least = CELD_AT (b->ink, x, y);
  return least;
}

/* The width in pixels of a thin line that is crossed by n pixels from (x,y) on in steps of (dx,dy): how much darker
 * they are than the darker one of both ends, added up, which is not above 0 along a line; 0 if the line is not thin. */
static float
line_across (const CeldDepthEdges *b, int x, int y, int dx, int dy, int n)
{
  float dark[2 * CELD_THIN_LINE_REACH + 2] = { 0 }, sum = 0, ends, most = 0;
  int   half = 0;

  for (int i = 0; i < n; i++, x += dx, y += dy)
    {
      bool inside = x >= 0 && y >= 0 && x < b->ink->width && y < b->ink->height;

      dark[i] = inside ? celd_most (1 - CELD_AT (b->ink, x, y), 0) : 0;
      most    = celd_most (most, dark[i]);
      sum    += dark[i];
    }
  for (int i = 0; i < n; i++)
    half += dark[i] > most / 2;
  ends = celd_most (dark[0], dark[n - 1]);
  return half <= THICKEST ? sum - (float) n * ends : 0;
}

/* Whether a line runs along the edge that is so thin that it need not be full ink in any pixel: between two rows of
 * pixels each has half of it. */
static bool
is_thin_line (const CeldDepthEdges *b, int x, int y, int right, int down)
{
  float width = celd_least (1 - b->threshold, THINNEST);
  int   r = CELD_THIN_LINE_REACH, u = r * right, v = r * down;

  return b->radius > 0 &&
         (line_across (b, x - u, y - v, right, down, 2 * r + 2) >= width ||
          line_across (b, x - v, y - u, down, right, 2 * r + 1) >= width ||
          line_across (b, x + right - v, y + down - u, down, right, 2 * r + 1) >= width);
}

float
celd_discontinuity_weight (const CeldDepthEdges *b, int x, int y, int right, int down)
{
  float least;

  if (b->cut && b->cut[(size_t) y * (size_t) b->ink->width + (size_t) x] & CELD_CUT (down))
    return 0;
  least = least_ink (b, x, y, x + right, y + down); /* usually decides on closed contours */
  if (least > b->threshold)
    least = least_ink (b, x - b->radius, y - b->radius, x + right + b->radius, y + down + b->radius);
  return least <= b->threshold || is_thin_line (b, x, y, right, down) ? 0 : least;
}

/* Sets weights to 1 where two rows of levels are equal, and marks the others. */
CELD_CLONES static void
compare_levels (const float *restrict a, const float *restrict b, int n, float *restrict weight,
                uint8_t *restrict differs)
{
  for (int x = 0; x < n; x++)
    {
      weight[x]  = a[x] == b[x] ? 1.f : 0.f;
      differs[x] = a[x] == b[x] ? 0 : 0x80;
    }
}

static void
weigh_row (const CeldDepthEdges *b, const float *level, int n, int y, int right, float *weight, uint8_t *differs)
{
  compare_levels (level, level + (right ? 1 : b->ink->width), n, weight, differs);
  for (int x = celd_next_marked (n, differs, 0); x < n; x = celd_next_marked (n, differs, x + 1))
    weight[x] = celd_discontinuity_weight (b, x, y, right, !right);
}

CeldStatus
celd_depth_weights (const CeldDepthEdges *b, const float *level, const CeldHost *host, float *east, float *south)
{
  const CeldPlane *ink = b->ink;
  size_t           w = (size_t) ink->width;
  uint8_t         *differs = celd_alloc (w, 1);
  CeldStatus       status = differs ? CELD_OK : CELD_NO_MEMORY;

  for (int y = 0; y < ink->height && status == CELD_OK; y++, level += w, east += w, south += w)
    {
      weigh_row (b, level, ink->width - 1, y, 1, east, differs);
      east[w - 1] = 0;
      if (y + 1 < ink->height)
        weigh_row (b, level, ink->width, y, 0, south, differs);
      else
        memset (south, 0, w * sizeof *south);
      if (y % 64 == 0)
        status = celd_progress (host, (double) y / ink->height);
    }
  celd_free (differs);
  return status;
}

/* ------------------------------------------------------------------ detours: bits */

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

/* ------------------------------------------------------------------ detours: search */

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
