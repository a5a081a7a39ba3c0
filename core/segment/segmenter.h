/* The inside of CeldSegmenter: what segmenter.c keeps, and redundant-relations.c looks at.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SEGMENTER_H
#define CELD_SEGMENTER_H

#include "segment/basins.h"
#include "segment/bridges.h"
#include "segment/segment.h"
#include "segment/task.h"

struct CeldSegmenter
{
  CeldPlane     ink;               /* borrowed */
  CeldBridges   bridges;
  uint32_t     *bridged_component; /* of each basin: its component with bridges as lines; NULL: no bridges */
  CeldBasins    basins;
  float         threshold;         /* ink_threshold of the basins */
  bool          bridged;           /* were they made with bridges? */
  CeldLabelling labelling;
  CeldStrokes   strokes;           /* of the last solve's seeds */
  CeldClosures  closures;
  CeldPatches   redrawn;           /* pixels changed by closing gaps or refining boundaries in the last solve */
  bool         *seeded;            /* of the last solve, as in CeldSegmentTask; NULL: without arrows */
  size_t        n_effective;
  uint32_t      background;        /* label of the last solve's background, and its region; 0: none */
  CeldRegion    background_region;
};

#endif
