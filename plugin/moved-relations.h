/* Relations as text for a part of a picture that counts places from a corner of its own.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_MOVED_RELATIONS_H
#define CELD_MOVED_RELATIONS_H

/* The same text with all places moved by dx, dy pixels; to be freed. */
char *celd_relations_moved (const char *text, double dx, double dy);

#endif
