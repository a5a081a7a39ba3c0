/* Relations that change nothing of a segmentation: both their ends are seeded, in regions that are separate already, and
 * the background stays the background.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment/segmenter.h"
#include "segment/splits.h"

/* Does the relation put the background in front of something, so that it is none? */
static bool
rules_out_background (const CeldSegmenter *s, const CeldSegmentTask *task, const CeldRelation *relation,
                      const CeldLabels *labels)
{
  CeldPalette     palette = { (CeldRegion *) &s->background_region, 1 };
  CeldRelationEnd end;

  if (relation->equal || !s->background)
    return false;
  if (relation->nearer.by_colour)
    return celd_palette_find (&palette, relation->nearer.colour);
  end = celd_relation_end_find (task, &relation->nearer);
  return end.there && CELD_AT (labels, end.x, end.y) == s->background;
}

/* Boundaries are redrawn after regions are split, so the ends must not lie where that has changed pixels. */
bool
celd_segmenter_is_redundant (const CeldSegmenter *segmenter, const CeldRelation *relation, const CeldSettings *settings,
                             const CeldLabels *labels)
{
  const CeldSegmenter *s = segmenter;
  CeldSegmentTask      task = { .settings = settings, .ink = &s->ink, .basins = &s->basins, .seeded = s->seeded };

  if (settings->seeds != CELD_SEEDS_AUTO)
    return true;
  return s->seeded && !rules_out_background (s, &task, relation, labels) &&
         !celd_arrow_seeds_needed (&task, relation) &&
         celd_regions_are_separate (&task, relation, labels, &s->redrawn);
}
