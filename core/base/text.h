/* Reading the languages in which relations are written: where the reader is, and what it finds there.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_TEXT_H
#define CELD_TEXT_H

#include "base/base.h"

typedef struct
{
  const char    *at;           /* next byte */
  int            line, column; /* of that byte, from 1 */
  CeldTextError *error;        /* may be NULL */
} CeldReader;

/* Past one character of a grammar.  They are all ASCII: reading ends at any other, so columns count characters. */
void celd_text_advance (CeldReader *r);

bool celd_text_at_line_end (const CeldReader *r);
void celd_text_skip_line_end (CeldReader *r); /* \n, \r\n or \r */

/* Says what should stand at `r` instead of what does: CELD_BAD_RELATION. */
CeldStatus celd_text_refuse (const CeldReader *r, const char *expected);

bool celd_text_is_digit (char c);

/* [ "-" ] digits [ "." digits ]; either digits may be missing, not both.  With `svg` also a "+" in front and an
 * exponent behind, as in SVG.  Refused from 1e9 on, which is far outside of any drawing. */
CeldStatus celd_text_number (CeldReader *r, bool svg, const char *expected, double *number);

#endif
