/* Windows: where the labels of basins are not enough, and a graph of the pixels in a window.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_WINDOWS_H
#define CELD_WINDOWS_H

#include "segment/basins.h"
#include "segment/pixel-graph.h"
#include "segment/task.h"

/* ------------------------------------------------------------------ window-search.c */

/* The pixels left .. right, top .. bottom (inclusive), in which the pixels of these basins are labelled again. */
typedef struct { int left, top, right, bottom; uint32_t group; size_t first, n; } CeldWindow;
typedef struct { CeldWindow *item; size_t n; uint32_t *basin; } CeldWindows; /* basins first .. first + n - 1 */

/* Finds windows where paint lies in basins of another label.  Windows of a group of basins do not overlap; groups have
 * no basin in common.  Makes the record. */
CeldStatus celd_windows_find (const CeldSegmentTask *task, const uint32_t *label, const CeldHost *host,
                              CeldWindows *windows);
void       celd_windows_clear (CeldWindows *windows);        /* accepts a zeroed record */

/* The index of the run of basins that contains (x,y).  The search starts near *hint, 0 at first, which is updated for
 * pixels nearby in the same row or the next. */
size_t celd_basin_run_at (const CeldBasins *basins, int y, int x, size_t *hint);

/* ------------------------------------------------------------------ window-graph.c */

/* The labels that pixels have before a window is cut: those of a picture, whose celd_distance_to_paper is known; or of
 * their basins, where pixels of basins with free[basin] != id are fixed. */
typedef struct
{
  const CeldLabels *picture;
  const int32_t    *to_paper;
  const uint32_t   *label, *free;
  uint32_t          id;
} CeldPresentLabels;

/* The graph of a window in square blocks of side 1 << shift; shift 0: of pixels.  The values of its nodes are their
 * present labels.  The window's outermost pixels are fixed, except along the frame of the picture.  Clear it also after
 * a failure. */
CeldStatus celd_window_graph_new (const CeldSegmentTask *task, const CeldPresentLabels *present, CeldRect box, int shift,
                                  CeldPixelGraph *graph);

/* Divides the blocks that have a node with crossed[node], and fixes all other pixels to their labels.  label[node]
 * becomes the present label. */
CeldStatus celd_window_graph_refine (CeldPixelGraph *graph, const uint32_t *label, const bool *crossed);

/* Workspace for cuts of windows. */
typedef struct
{
  const CeldSegmentTask *task;
  const CeldHost        *host;
  uint32_t              *order;  /* all labels in the order of cuts */
  uint32_t              *local;  /* of each label, from 1: its number in this window, or 0 */
  uint32_t              *global; /* of each such number, from 0: the label */
  int64_t               *votes;  /* of each label, from 1: the sum of its data costs here */
} CeldWindowCutter;

CeldStatus celd_window_cutter_new (const CeldSegmentTask *task, const CeldHost *host, CeldWindowCutter *cutter);
void       celd_window_cutter_clear (CeldWindowCutter *cutter);     /* also after a failure */

/* Finds the labels of the nodes: the present ones, unless others cost less (*better).  A label that no node has now
 * must have data costs of at least `least` > 0 together.  The caller frees *label; the labels of the graph's data costs
 * are not valid afterwards. */
CeldStatus celd_window_cut (CeldWindowCutter *cutter, CeldPixelGraph *graph, int64_t least, uint32_t **label,
                            bool *better);

#endif
