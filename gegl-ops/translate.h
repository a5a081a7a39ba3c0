/* Texts in the language of the host, for operations and what plug-ins share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_TRANSLATE_H
#define CELD_TRANSLATE_H

#include <glib.h>

#define CELD_DOMAIN "celdepth"

#define _(text) g_dgettext (CELD_DOMAIN, text)
#define N_(text) text /* for xgettext: it is translated when it is shown */

#endif
