/* What the files that read scribbles share: scribble-colours.c counts and cleans the colours of a layer,
 * scribble-loss.c and scribble-unmix.c bring back colours that loss has smeared, scribble-clusters.c and
 * scribble-overlaps.c say which of them are labels, scribble-places.c hands out the pixels, and scribbles.c tells
 * fringes and makes the palette.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SCRIBBLES_H
#define CELD_SCRIBBLES_H

#include "base/base.h"

#define CELD_LEAST_DOT 4        /* solid pixels that make a label: a dot of 2 x 2 */
#define CELD_NO_CLUSTER UINT32_MAX
#define CELD_THIN 3             /* pixels: a run of a colour at most this long can be a fringe */

/* Instead of a cluster, as the label of a pixel. */
#define CELD_UNDECIDED UINT32_MAX
#define CELD_QUEUED (UINT32_MAX - 1)

/* CELD_FRINGE: of a colour between its neighbours'; CELD_INTERIOR: all four neighbours are of its colour; CELD_SOLID: any other. */
typedef enum { CELD_FRINGE, CELD_SOLID, CELD_INTERIOR } CeldPixelKind;

/* One exact colour of the layer. */
typedef struct
{
  int      channel[3];
  uint32_t pixels, solid, core;        /* how many pixels it has, and of those kinds (core ones are solid too) */
  uint64_t opacity;                     /* sum of its pixels' alpha, 0 .. 255 each */
  uint32_t cluster;
} CeldScribbleColour;

/* Colours that mean one label; cluster 0 is none. */
typedef struct
{
  int      channel[3];
  uint32_t colour;                      /* the colour of most solid pixels */
  uint32_t next;                        /* in the same cell of colour space */
  uint32_t pixels, solid, core;
  uint64_t opacity;
  bool     is_label;
} CeldScribbleCluster;

typedef struct
{
  const CeldPaint *paint;
  int              width, height;
  size_t           pixels;
  uint32_t        *id;          /* of each pixel: index into colour; 0 = transparent */
  uint8_t         *kind;        /* CeldPixelKind of each pixel */
  uint32_t        *label;       /* of each pixel: its cluster; from CELD_QUEUED on: none */
  CeldScribbleColour          *colour;
  size_t           n;
  uint32_t        *slot;        /* hash table of colour indices; 0 = free */
  size_t           slots;       /* a power of two */
  uint32_t         paper;       /* the colour that means none in a picture without alpha; 0 = transparent does */
  int              radius;      /* colours as near as this are equal */
  bool             lossy;       /* there was noise to be filtered */
  CeldScribbleCluster         *cluster;
  size_t           n_clusters;
  uint32_t        *head;        /* first cluster in each cell of colour space */
  size_t           colour_capacity, cluster_capacity;
} CeldScribbleLayer;

static inline int
celd_colour_distance (const int *a, const int *b)
{
  int d0 = a[0] - b[0], d1 = a[1] - b[1], d2 = a[2] - b[2];

  return d0 * d0 + d1 * d1 + d2 * d2;
}

/* Fills in id, colour, paper, radius and lossy; label and kind are lent for work. */
CeldStatus celd_scribble_colours (CeldScribbleLayer *r, bool flats, const CeldHost *host);

/* Does much of the chroma of strokes on white paper lie beside them? */
bool celd_scribble_smeared (const CeldScribbleLayer *r);

/* Paints the strokes of a smeared picture flat, in the colours that they had, on flat paper. */
CeldStatus celd_scribble_restore (CeldScribbleLayer *r, const CeldHost *host, CeldPaint *out);

/* Fills in cluster, from colours whose solid and core pixels are counted. */
CeldStatus celd_scribble_clusters (CeldScribbleLayer *r, const CeldHost *host);

/* Takes the label from clusters that are only where two translucent strokes overlap. */
CeldStatus celd_scribble_overlaps (CeldScribbleLayer *r);

/* Fills in label; clusters that only lines have which are too thin are added. */
CeldStatus celd_scribble_places (CeldScribbleLayer *r, const CeldHost *host);

/* One more cluster, round a colour. */
CeldStatus celd_scribble_cluster_add (CeldScribbleLayer *r, uint32_t colour);

#endif
