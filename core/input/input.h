/* Reading what the artist paints: scribbles, virtual contours, and what a layer can be at all.
 *
 *   faint-strokes.c      strokes that are too faint to be read
 *   scribble-opacity.c   which pixels are opaque enough to be paint
 *   scribble-colours.c   counts the colours of a layer, and cleans them where it was stored with loss
 *   scribble-noise.c     whether a layer was stored with loss
 *   scribble-loss.c      restores thin strokes whose chroma a codec has smeared
 *   scribble-pieces.c    finds these strokes by luma, block by block
 *   scribble-unmix.c     what colours these strokes had
 *   scribble-tints.c     soft strokes on paper, each made flat in one colour
 *   scribble-clusters.c  which colours are labels
 *   scribble-overlaps.c  which are only mixtures of two strokes that cross
 *   scribble-places.c    which pixels each label has
 *   scribbles.c          all steps of reading scribbles: fringes, and the palette
 *   paint-kinds.c        what a layer can be by its colours
 *   mix-ups.c            drawing and scribbles exchanged, or a copy of one given as the other
 *   unmatched-strokes.c  corrections and hidden strokes in colours that no region has
 *   contours.c           virtual contours painted into a drawing
 *   contour-ends.c       joins their open ends to what is near
 *
 * What reads arrows is in arrows.h; other themes include this header for both.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_INPUT_H
#define CELD_INPUT_H

#include "image/image.h"
#include "input/arrows.h"

/* ------------------------------------------------------------------ scribbles */

#define CELD_CLEAR_HUE 64 /* of 255: difference of the channels of a clear colour; chosen */

/* paint-kinds.c: the difference of the largest and the least channel of a pixel. */
int celd_hue_of (const uint8_t *p);
/* Whether a picture is transparent nowhere. */
bool celd_paint_is_opaque (const CeldPaint *paint);
/* Whether a picture that is not empty is grey, as inks are. */
bool celd_is_grey (const CeldPaint *paint);
/* Whether something in clear colours is painted, be it a few thin strokes. */
bool celd_paint_has_colours (const CeldPaint *paint);

#define CELD_LEAST_DOT  4       /* solid pixels that make a label: a dot of 2 x 2; chosen */
#define CELD_HARD_COLOURS 32    /* colours that a layer of hard strokes has at most; chosen */
#define CELD_PIXEL_ART  256     /* pixels, the longer side of the largest; chosen */
#define CELD_THIN       3       /* pixels: a run of a colour at most this long can be a fringe; chosen */
#define CELD_NO_CLUSTER UINT32_MAX

/* In place of a cluster, as the label of a pixel. */
#define CELD_UNDECIDED UINT32_MAX
#define CELD_QUEUED    (UINT32_MAX - 1)

/* CELD_FRINGE: the pixel's colour lies between those of its neighbours; CELD_INTERIOR: all four neighbours have its
 * colour; CELD_SOLID: any other. */
typedef enum { CELD_FRINGE, CELD_SOLID, CELD_INTERIOR } CeldPixelKind;

/* One exact colour of the layer. */
typedef struct
{
  int      channel[3];
  uint32_t pixels, solid, interior;     /* how many pixels it has, and of those kinds; interior ones are solid, too */
  uint64_t opacity;                     /* sum of its pixels' alpha, 0 .. 255 each */
  uint32_t cluster;
  bool     is_soft;                     /* soft strokes on paper have it, which show paler tints of it, too */
} CeldScribbleColour;

/* Colours that mean one label; cluster 0 means no label. */
typedef struct
{
  int      channel[3];
  uint32_t colour;                      /* the colour of most solid pixels */
  uint32_t next;                        /* in the same cell of colour space */
  uint32_t pixels, solid, interior;
  uint32_t commonest;                   /* interior pixels of the colour that has most of them */
  uint64_t opacity;
  bool     apart;                       /* in pixel art: no pixel of another cluster touches its pixels */
  bool     is_label;
} CeldScribbleCluster;

typedef struct
{
  const CeldPaint     *paint;
  int                  width, height;
  size_t               pixels;
  uint32_t            *id;         /* of each pixel: index into colour; 0 = transparent */
  uint8_t             *kind;       /* CeldPixelKind of each pixel */
  uint32_t            *label;      /* of each pixel: its cluster; from CELD_QUEUED on: none */
  CeldScribbleColour  *colour;
  size_t               n;
  uint32_t            *slot;       /* hash table of colour indices; 0 = free */
  size_t               slots;      /* a power of two */
  uint32_t             paper;      /* the colour that means no label in a picture without alpha; 0 = transparent does */
  int                  radius;     /* colours at most this far apart are equal */
  bool                 lossy;      /* there was noise to be filtered */
  bool                 hard;       /* each pixel is transparent or opaque, and of few colours */
  bool                 pixel_art;  /* it is small, and each pixel is transparent or opaque */
  CeldScribbleCluster *cluster;
  size_t               n_clusters;
  int                  tint2;      /* squared distance from paper of the tints that loss leaves on it, at most */
  uint32_t            *head;       /* first cluster in each cell of colour space */
  size_t               colour_capacity, cluster_capacity;
} CeldScribbleLayer;

static inline int
celd_colour_distance (const int *a, const int *b)
{
  int d0 = a[0] - b[0], d1 = a[1] - b[1], d2 = a[2] - b[2];

  return d0 * d0 + d1 * d1 + d2 * d2;
}

/* The same from the line through paper and paint, on which their mixtures lie; *ahead: paint is on that side of paper. */
static inline double
celd_distance_to_mixtures (const int *paper, const int *paint, const int *colour, bool *ahead)
{
  double along = 0;

  for (int i = 0; i < 3; i++)
    along += (colour[i] - paper[i]) * (paint[i] - paper[i]);
  *ahead = along > 0;
  return celd_colour_distance (colour, paper) - along * along / celd_colour_distance (paint, paper);
}

/* faint-strokes.c: appends CELD_PROBLEM_STROKE_FAINT for each stroke of a layer with alpha that has some, but is nowhere
 * as opaque as `least`, from which on paint is read. */
CeldStatus celd_faint_strokes_find (const CeldPaint *layer, int least, CeldProblems *problems);

/* unmatched-strokes.c: appends CELD_PROBLEM_STROKE_UNMATCHED if a layer of corrections or of what is hidden has paint,
 * and hardly any of it was read. */
CeldStatus celd_unmatched_strokes_find (const CeldPaint *layer, const CeldLabels *read, CeldProblems *problems);

/* The same: is a pixel visible, but neither opaque nor at the rim of opaque paint? */
bool celd_paint_is_faint (const CeldPaint *layer, int visible, int opaque, int x, int y);

/* Of 255; all chosen. */
#define CELD_CONNECTED_ALPHA 16 /* fainter paint connects nothing */
#define CELD_VISIBLE_ALPHA   26 /* less is what an eraser leaves */
#define CELD_SCRIBBLE_ALPHA  51 /* the strongest pixel of a scribble, at least */

/* scribble-opacity.c: sets kind to 1 where the layer is opaque enough to be paint, else to 0; label is used as work
 * space. */
CeldStatus celd_scribble_paint (CeldScribbleLayer *r);

#define CELD_SIMILAR 36 /* of 255: between colours of one stroke in a lossy picture, at most; chosen */

/* scribble-noise.c: sets the radius to the noise of strokes and a margin; whether the layer was stored with loss. */
bool celd_scribble_noise (CeldScribbleLayer *r);

/* scribble-colours.c: fills in id, colour, paper, radius and lossy; label and kind are used as work space. */
CeldStatus celd_scribble_colours (CeldScribbleLayer *r, bool flats, const CeldHost *host);

/* scribble-loss.c: are strokes on white paper so thin that smeared chroma leaves little of their colour? */
bool celd_scribble_thin (const CeldScribbleLayer *r);

/* scribble-loss.c: paints the strokes of a picture with smeared chroma flat, in the colours that they had, on flat
 * paper. */
CeldStatus celd_scribble_restore (CeldScribbleLayer *r, const CeldHost *host, CeldPaint *out);

/* scribble-tints.c: makes soft strokes on paper flat; overwrites label and kind. */
CeldStatus celd_scribble_tints (CeldScribbleLayer *r);

/* scribble-clusters.c: fills in cluster, from colours whose solid and interior pixels are counted. */
CeldStatus celd_scribble_clusters (CeldScribbleLayer *r, const CeldHost *host);

/* gradients.c: makes each gradient of a flat colouring one colour; needs the colours, and overwrites label and kind. */
CeldStatus celd_scribble_gradients (CeldScribbleLayer *r);

/* scribble-overlaps.c: clusters that are mostly mixtures of two strokes that cross or touch are labels no longer. */
CeldStatus celd_scribble_overlaps (CeldScribbleLayer *r);

/* scribble-clusters.c: appends a cluster of one colour. */
CeldStatus celd_scribble_cluster_add (CeldScribbleLayer *r, uint32_t colour);

/* scribble-places.c: fills in label; adds clusters for lines that are too thin to have a pixel of their full colour. */
CeldStatus celd_scribble_places (CeldScribbleLayer *r, const CeldHost *host);

/* ------------------------------------------------------------------ scribbles stored with loss */

#define CELD_BLOCK          16  /* pixels, side of the blocks of chroma at half size; JPEG */
#define CELD_FAINT_CONTRAST 12  /* steps of 1/255; paper has no more; chosen */

/* The connected component of a stroke within one block.  Colours are deficits: by how much each channel is below that
 * of paper. */
typedef struct
{
  double   core[3];     /* where the component is darkest: right in luma, too low in chroma */
  double   full[3];     /* what it would be without smear, by the sums of blocks */
  double   colour[3];   /* from these two */
  double   luma;        /* of the core */
  double   coverage;    /* painted pixels, those at edges in part */
  double   all;         /* coverage of the whole stroke, if this is its first piece */
  uint32_t block;
  uint32_t stroke;      /* union-find: a piece of the same stroke */
} CeldLossPiece;

/* Pieces that touch, and how far apart their colours are. */
typedef struct { uint32_t a, b; float distance; } CeldLossContact;

/* The deficit of a block: sum over its pixels, and what its strokes would give it. */
typedef struct { double sum[3], expected[3]; } CeldLossBlock;

typedef struct
{
  CeldScribbleLayer *r;         /* label: 1 + the piece of each pixel, 0 = paper; kind: its contrast, 0 .. 255 */
  int                columns;   /* blocks in a row */
  size_t             n_blocks;
  CeldLossBlock     *block;
  CeldLossPiece     *piece;
  size_t             n;
  CeldLossContact   *contact;
  size_t             n_contacts;
  size_t             piece_capacity, contact_capacity;
} CeldLossStrokes;

/* Luma of a colour or a deficit. */
static inline double
celd_deficit_luma (const double *d)
{
  return 0.299 * d[0] + 0.587 * d[1] + 0.114 * d[2];
}

/* By how much each channel of a pixel is below that of paper. */
static inline void
celd_loss_deficit (const CeldScribbleLayer *r, int x, int y, int *d)
{
  const uint8_t *p = CELD_RGBA (r->paint, x, y);

  for (int i = 0; i < 3; i++)
    d[i] = r->colour[r->paper].channel[i] - p[i];
}

static inline int
celd_loss_luma (const int *d)
{
  return (77 * d[0] + 150 * d[1] + 29 * d[2] + 128) >> 8;
}

/* scribble-pieces.c: fills in piece, with its block, contact, and label and kind of the layer. */
CeldStatus celd_scribble_pieces (CeldLossStrokes *s, const CeldHost *host);

/* scribble-pieces.c: does none of the eight neighbours have clearly more contrast? */
bool celd_loss_is_core (const CeldScribbleLayer *r, int x, int y);

/* scribble-unmix.c: fills in stroke and colour of the pieces, whose core, coverage and block are known. */
CeldStatus celd_scribble_unmix (CeldLossStrokes *s, const CeldHost *host);

/* ------------------------------------------------------------------ virtual contours */

/* Hard strokes become ink, soft ones ink for segmentation only; erasing ones turn ink into paper. */
typedef enum { CELD_CONTOUR_NONE, CELD_CONTOUR_HARD, CELD_CONTOUR_SOFT, CELD_CONTOUR_ERASE } CeldContourKind;

typedef struct
{
  int            width, height;
  size_t         pixels;
  CeldPlane      ink;           /* of the drawing, by celd_ink */
  CeldPlane      value;         /* of the drawing, by celd_ink_values */
  CeldPlane      paper;         /* of the drawing, by celd_paper_levels */
  float          dark;          /* the value that ink of this drawing has */
  CeldMask       kind;          /* CeldContourKind of each pixel */
  CeldMask       opacity;       /* of the stroke at each pixel */
  CeldMask       wall;          /* 1 = becomes ink */
  CeldLabels     mark;          /* the pixels of strokes, whose connected components are found */
  CeldLabels     component;     /* of these: the strokes */
  CeldComponent *list;          /* of strokes */
  size_t         n;
  float         *breadth;       /* of stroke k at k, in pixels; at 0 for ink */
} CeldContourBake;

/* Sets the walls of 2 x 2 pixels from (x,y) on, as far as they lie in the picture. */
static inline void
celd_contour_stamp (CeldMask *wall, int x, int y, uint8_t value)
{
  for (int v = y > 0 ? y : 0; v <= y + 1 && v < wall->height; v++)
    for (int u = x > 0 ? x : 0; u <= x + 1 && u < wall->width; u++)
      CELD_AT (wall, u, v) |= value;
}

/* contour-ends.c: joins open ends of strokes to the nearest ink, other stroke or edge of the picture, at most 5 pixels
 * plus 1/256 of the shorter side away. */
CeldStatus celd_contour_join (CeldContourBake *b, const CeldHost *host);

#endif
