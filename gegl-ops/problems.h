/* Problems as a message to the artist, for operations and plug-ins.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PROBLEMS_H
#define CELD_PROBLEMS_H

#include <glib.h>

#include "celdepth.h"

/* A text of core in the language of the host: a CeldTranslate. */
const char *celd_in_language (const char *text);

/* What is wrong, where and what to do, of a contradiction also with what else is in it; to be freed.  `order` has the
 * cycles of contradictions; it, the palette and the relations may be NULL. */
char *celd_problem_line (const CeldProblem *problem, const CeldPalette *palette, const CeldRelations *relations,
                         const CeldOrder *order);

/* Appends a line for each of the first problems, and how many more there are. */
void celd_problems_append (GString *message, const CeldProblems *problems, const CeldPalette *palette,
                           const CeldRelations *relations, const CeldOrder *order);

/* What the artist should know of a drawing with CELD_LINES_UNSURE. */
const char *celd_unsure_lines_text (void);

#endif
