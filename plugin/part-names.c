/* Names of parts in models, the same in all front ends.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "part-names.h"

#include <glib.h>

char *
celd_part_name (const CeldPalette *palette, uint32_t label)
{
  const uint8_t *c = palette->item[label - 1].colour;

  return c[3] ? g_strdup_printf ("%02x%02x%02x-%u", c[0], c[1], c[2], label) : g_strdup ("background");
}
