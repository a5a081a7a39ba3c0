/* Properties that several operations share and that are no settings of core.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#include <string.h>

static const CeldSettingInfo shared[] = {
  { .name = "relations", .label = "Relations", .type = CELD_SETTING_TEXT, .offset = offsetof (CeldOwnValues, relations),
    .help = "Relations between parts: '120,80 > 300,95' says that the part at the first point is nearer than the part "
            "at the second, '#ff0000 > #00ff00' compares the parts of two colours, and '=' means equal depth. Write "
            "one relation per line, or separate them by ';'" },

  { .name = "arrow-path", .label = "Arrow path", .type = CELD_SETTING_TEXT,
    .offset = offsetof (CeldOwnValues, arrow_path),
    .help = "Arrows as SVG path data, each from the nearer to the farther part, such as 'M 120,80 L 300,95'" },

  { .name = "directx", .label = "DirectX normals", .type = CELD_SETTING_SWITCH, .most = 1,
    .offset = offsetof (CeldOwnValues, directx), .when = "result {normals}",
    .help = "Green points down, as in DirectX, instead of up, as in OpenGL" },

  { .name = "more", .label = "More settings", .type = CELD_SETTING_SWITCH, .most = 1,
    .offset = offsetof (CeldOwnValues, more),
    .help = "Shows settings that are rarely needed. The result stays the same" },
};

const CeldSettingInfo *
celd_shared_property (const char *name)
{
  for (gsize i = 0; i < G_N_ELEMENTS (shared); i++)
    if (!strcmp (shared[i].name, name))
      return &shared[i];
  return NULL;
}
