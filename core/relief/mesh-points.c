/* The corners of pixels as points of a surface.
 *
 * Pixels round a corner that hang together there share a point, at their mean height; a piece that ends in front of
 * another one has its outline there.  Points that are equally high are one.  Where two pieces touch at a corner, with
 * two others lower beside them, the higher of these is lifted to them: a body would have an edge there which four faces
 * share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief/mesh.h"

/* A corner and the pixels round it; -1: beyond the frame. */
typedef struct
{
  ptrdiff_t pixel[4];
  bool      joined[4];          /* each with the next one, clockwise */
  bool      nearer[4];          /* where they are not: is it in front of the next one? */
  int       piece[4];           /* of each pixel */
  int       pieces;
  float     z[4];               /* of each piece */
} Corner;

/* ------------------------------------------------------------------ pieces */

static void
look_round (const CeldRelief *r, int x, int y, Corner *c)
{
  static const int dx[4] = { -1, 0, 0, -1 }, dy[4] = { -1, -1, 0, 0 };
  /* Which of the two pixels has the edge, and which edge that is. */
  static const int owner[4] = { CELD_NORTH_WEST, CELD_NORTH_EAST, CELD_SOUTH_WEST, CELD_NORTH_WEST };

  for (int k = 0; k < 4; k++)
    {
      int u = x + dx[k], v = y + dy[k];

      c->pixel[k] = u < 0 || v < 0 || u >= r->width || v >= r->height ? -1 : (ptrdiff_t) v * r->width + u;
    }
  for (int k = 0; k < 4; k++)
    {
      uint8_t cut, near;

      c->joined[k] = c->nearer[k] = false;
      if (c->pixel[k] < 0 || c->pixel[(k + 1) % 4] < 0)
        continue;
      cut  = r->cut[c->pixel[owner[k]]] & (k % 2 ? CELD_CUT_BELOW : CELD_CUT_RIGHT);
      near = r->cut[c->pixel[owner[k]]] & (k % 2 ? CELD_NEAR_BELOW : CELD_NEAR_RIGHT);
      c->joined[k] = !cut;
      c->nearer[k] = (near != 0) == (owner[k] == k);
    }
}

/* Numbers what hangs together, clockwise. */
static void
find_pieces (Corner *c)
{
  int place[4] = { -1, -1, -1, -1 };

  for (int k = 0; k < 4; k++)
    c->piece[k] = k;
  for (int k = 0; k < 4; k++)
    if (c->joined[k])
      for (int i = 0, from = c->piece[(k + 1) % 4]; i < 4; i++)
        if (c->piece[i] == from)
          c->piece[i] = c->piece[k];
  c->pieces = 0;
  for (int k = 0; k < 4; k++)
    if (c->pixel[k] >= 0)
      {
        if (place[c->piece[k]] < 0)
          place[c->piece[k]] = c->pieces++;
        c->piece[k] = place[c->piece[k]];
      }
    else
      c->piece[k] = 0;
}

/* Is the piece in front of another one here? */
static bool
ends_here (const Corner *c, int piece)
{
  for (int k = 0; k < 4; k++)
    {
      int next = (k + 1) % 4;

      if (c->pixel[k] >= 0 && c->pixel[next] >= 0 && c->piece[k] != c->piece[next] &&
          c->piece[c->nearer[k] ? k : next] == piece)
        return true;
    }
  return false;
}

static void
find_heights (const CeldRelief *r, Corner *c)
{
  for (int piece = 0; piece < c->pieces; piece++)
    {
      const float *z = ends_here (c, piece) ? r->outline : r->z;
      double       sum = 0;
      int          n = 0;

      for (int k = 0; k < 4; k++)
        if (c->pixel[k] >= 0 && c->piece[k] == piece)
          {
            sum += (double) z[c->pixel[k]];
            n++;
          }
      c->z[piece] = (float) (sum / n);
    }
}

/* ------------------------------------------------------------------ what a body cannot have */

/* Of four pieces, lifts the higher one of a and the one opposite to the lower one of the two beside them, if both of
 * these are higher than both of those. */
static void
lift (float *z, int a)
{
  float *low = z[a] > z[a + 2] ? &z[a] : &z[a + 2];
  float  beside = z[1 - a] < z[3 - a] ? z[1 - a] : z[3 - a];

  if (*low < beside)
    *low = beside;
}

/* Pieces of the same height become one. */
static void
merge_pieces (Corner *c)
{
  int place[4], n = 0;

  for (int i = 0; i < c->pieces; i++)
    {
      int same = 0;

      while (same < n && c->z[same] != c->z[i])
        same++;
      place[i]   = same;
      c->z[same] = c->z[i];
      n += same == n;
    }
  for (int k = 0; k < 4; k++)
    c->piece[k] = place[c->piece[k]];
  c->pieces = n;
}

/* ------------------------------------------------------------------ */

static bool
is_cracked (const Corner *c)
{
  for (int k = 0; k < 4; k++)
    if (!c->joined[k] && c->pixel[k] >= 0 && c->pixel[(k + 1) % 4] >= 0)
      return true;
  return false;
}

static CeldStatus
add_corner (CeldCorners *corners, size_t place, const Corner *c)
{
  uint8_t piece = 0;
  float  *z;

  corners->first[place]   = (uint32_t) corners->n;
  corners->cracked[place] = is_cracked (c);
  for (int k = 0; k < 4; k++)
    piece = (uint8_t) (piece | c->piece[k] << 2 * k);
  corners->piece[place] = piece;
  for (int i = 0; i < c->pieces; i++)
    {
      z = celd_grow (corners->z, corners->n + 1, sizeof *z);
      if (!z)
        return CELD_NO_MEMORY;
      z[corners->n++] = c->z[i];
      corners->z      = z;
    }
  return CELD_OK;
}

CeldStatus
celd_corners_new (const CeldRelief *r, const CeldHost *host, CeldCorners *corners)
{
  size_t     n = ((size_t) r->width + 1) * ((size_t) r->height + 1), place = 0;
  CeldStatus status = CELD_OK;

  *corners         = (CeldCorners) { .width = r->width, .height = r->height };
  corners->first   = celd_alloc (n + 1, sizeof *corners->first);
  corners->piece   = celd_alloc (n, 1);
  corners->cracked = celd_alloc (n, 1);
  if (!corners->first || !corners->piece || !corners->cracked)
    return CELD_NO_MEMORY;
  for (int y = 0; y <= r->height && status == CELD_OK; y++)
    {
      if (y % 16 == 0)
        status = celd_progress (host, (double) y / r->height);
      for (int x = 0; x <= r->width && status == CELD_OK; x++, place++)
        {
          Corner c;

          look_round (r, x, y, &c);
          find_pieces (&c);
          find_heights (r, &c);
          if (c.pieces == 4)
            {
              lift (c.z, 0);
              lift (c.z, 1);
            }
          merge_pieces (&c);
          status = add_corner (corners, place, &c);
        }
    }
  corners->first[n] = (uint32_t) corners->n;
  return status;
}

void
celd_corners_clear (CeldCorners *corners)
{
  celd_free (corners->first);
  celd_free (corners->piece);
  celd_free (corners->cracked);
  celd_free (corners->z);
  *corners = (CeldCorners) { .width = 0 };
}
