/* Reading text: relations (input/relations.c) and SVG paths (input/arrow-path.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_TEXT_H
#define CELD_TEXT_H

#include "base/base.h"

/* The state of a reader. */
typedef struct
{
  const char    *at;           /* next byte of a text that ends with 0 */
  int            line, column; /* of that byte, both from 1 */
  CeldTextError *error;        /* may be NULL */
} CeldReader;

/* Steps over one byte, which must be ASCII and no line end.  Grammars are ASCII and reading stops at anything else, so
 * columns count characters. */
void celd_text_advance (CeldReader *r);

/* Line ends are \n, \r\n or \r.  The second function steps over one, which must be there. */
bool celd_text_at_line_end (const CeldReader *r);
void celd_text_skip_line_end (CeldReader *r);

/* Fills in *r->error, if not NULL, with the place, what was expected there and what stands there instead.  Returns
 * CELD_BAD_RELATION. */
CeldStatus celd_text_refuse (const CeldReader *r, const char *expected);

bool celd_text_is_digit (char c);

/* Reads the number  [ "-" ] digits [ "." digits ],  where either group of digits may be missing but not both; with
 * `svg` also a "+" in front and an exponent behind, as in SVG path data.  The decimal point is "." in every locale.
 * CELD_BAD_RELATION, with `expected` in the error, if there is no number or its absolute value is 1e9 or more. */
CeldStatus celd_text_number (CeldReader *r, bool svg, const char *expected, double *number);

#endif
