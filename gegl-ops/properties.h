/* Properties that are no settings of core: the kinds of output, and those that several operations share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PROPERTIES_H
#define CELD_PROPERTIES_H

#include "op.h"

typedef enum
{
  CELD_LUMO_ART, CELD_LUMO_SHADING, CELD_LUMO_NORMALS, CELD_LUMO_TONE, CELD_LUMO_RIM, CELD_LUMO_OCCLUSION
} CeldLumoResult;
typedef enum { CELD_ENHANCED_ART, CELD_ENHANCED_LAYER, CELD_ENHANCED_VIEW } CeldEnhanceResult;
typedef enum { CELD_COMPOSED_ART, CELD_COMPOSED_LEVELS } CeldComposeResult;
typedef enum { CELD_DEFORMED_ART, CELD_DEFORMED_LEVELS } CeldDeformResult;
typedef enum { CELD_RELIEF_RELATIVE, CELD_RELIEF_PIXELS } CeldReliefUnit;
typedef enum { CELD_REGISTER_DISPLACEMENT, CELD_REGISTER_WARPED, CELD_REGISTER_CONFIDENCE } CeldRegisterResult;
typedef enum
{
  CELD_PROPAGATED_LABELS, CELD_PROPAGATED_SCRIBBLES, CELD_PROPAGATED_LEVELS, CELD_PROPAGATED_DEPTH,
  CELD_PROPAGATED_CONFIDENCE
} CeldPropagateResult;
typedef enum { CELD_EXPAND_LEVELS, CELD_EXPAND_LAYER, CELD_EXPAND_MATTE } CeldExpandResult;
typedef enum { CELD_SEGMENT_LABELS, CELD_SEGMENT_CLOSURES, CELD_SEGMENT_PROBLEMS } CeldSegmentResult;
typedef enum
{
  CELD_POPUP_LABELS, CELD_POPUP_ORDER, CELD_POPUP_LEVELS, CELD_POPUP_DEPTH, CELD_POPUP_NORMALS, CELD_POPUP_SHADING,
  CELD_POPUP_PROBLEMS, CELD_POPUP_SUGGESTIONS
} CeldPopupResult;

/* Members of a row for the int `member` of CeldOwnValues, an enumeration with a list of choices. */
#define CELD_OWN_CHOICE(member, enumeration, list) \
  .type = CELD_SETTING_CHOICE, .offset = offsetof (CeldOwnValues, member), .choice_type = #enumeration, \
  .choice = (list), .choices = G_N_ELEMENTS (list), .most = G_N_ELEMENTS (list) - 1

/* The row of "relations", "arrow-path", "directx" or "more"; NULL for other names. */
const CeldSettingInfo *celd_shared_property (const char *name);

#endif
