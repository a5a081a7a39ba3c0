/* Reading numbers and reporting errors, for the readers of relations and paths.
 *
 * Numbers are read without the C library, whose decimal point depends on the locale.  Digits are collected in an exact
 * mantissa that is scaled once, so that plain decimals are correctly rounded.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>

#define LARGEST_NUMBER 1e9 /* and more is refused: far outside any drawing */
#define MOST_EXPONENT  400 /* a larger one makes any number 0 or too large */

void
celd_text_advance (CeldReader *r)
{
  r->at++;
  if (r->column < INT_MAX)
    r->column++;
}

bool
celd_text_at_line_end (const CeldReader *r)
{
  return *r->at == '\n' || *r->at == '\r';
}

void
celd_text_skip_line_end (CeldReader *r)
{
  if (r->at[0] == '\r' && r->at[1] == '\n')
    r->at++;
  r->at++;
  r->column = 1;
  if (r->line < INT_MAX)
    r->line++;
}

/* The number of bytes of the UTF-8 character at `text`; 0 if it is malformed. */
static size_t
character_length (const char *text)
{
  const unsigned char *c = (const unsigned char *) text;
  size_t n = c[0] < 0x80 ? 1 : c[0] < 0xc2 ? 0 : c[0] < 0xe0 ? 2 : c[0] < 0xf0 ? 3 : c[0] < 0xf5 ? 4 : 0;

  for (size_t i = 1; i < n; i++)
    if ((c[i] & 0xc0) != 0x80)
      return 0;
  return n;
}

CeldStatus
celd_text_refuse (const CeldReader *r, const char *expected)
{
  CeldTextError *error  = r->error;
  size_t         length = character_length (r->at);

  if (!error)
    return CELD_BAD_RELATION;
  error->line   = r->line;
  error->column = r->column;
  snprintf (error->expected, sizeof error->expected, "%s", expected);
  if (!*r->at)
    snprintf (error->found, sizeof error->found, N_ ("the end of the text"));
  else if (celd_text_at_line_end (r))
    snprintf (error->found, sizeof error->found, N_ ("the end of the line"));
  else if (length == 0 || (unsigned char) *r->at < ' ' || *r->at == 127)
    snprintf (error->found, sizeof error->found, "byte 0x%02x", (unsigned) (unsigned char) *r->at);
  else
    snprintf (error->found, sizeof error->found, "\"%.*s\"", (int) length, r->at);
  return CELD_BAD_RELATION;
}

bool
celd_text_is_digit (char c)
{
  return c >= '0' && c <= '9';
}

void
celd_text_skip_blanks (CeldReader *r)
{
  while (*r->at == ' ' || *r->at == '\t' || *r->at == '\v' || *r->at == '\f')
    celd_text_advance (r);
}

/* Reads "e" and an exponent; returns 0 and reads nothing if there is none. */
static int
read_exponent (CeldReader *r)
{
  CeldReader digits = *r;
  bool       negative;
  int        exponent = 0;

  if (*digits.at != 'e' && *digits.at != 'E')
    return 0;
  celd_text_advance (&digits);
  negative = *digits.at == '-';
  if (negative || *digits.at == '+')
    celd_text_advance (&digits);
  if (!celd_text_is_digit (*digits.at))
    return 0;
  for (; celd_text_is_digit (*digits.at); celd_text_advance (&digits))
    if (exponent < MOST_EXPONENT)
      exponent = exponent * 10 + (*digits.at - '0');
  *r = digits;
  return negative ? -exponent : exponent;
}

CeldStatus
celd_text_number (CeldReader *r, bool svg, const char *expected, double *number)
{
  CeldReader start    = *r;
  bool       negative = *r->at == '-', any = false;
  double     mantissa = 0, divisor = 1; /* both exact, so that their quotient is correctly rounded */
  int        exponent;

  if (negative || (svg && *r->at == '+'))
    celd_text_advance (r);
  for (; celd_text_is_digit (*r->at); celd_text_advance (r), any = true)
    if ((mantissa = mantissa * 10 + (*r->at - '0')) >= LARGEST_NUMBER)
      return celd_text_refuse (&start, N_ ("a smaller number"));
  if (*r->at == '.')
    for (celd_text_advance (r); celd_text_is_digit (*r->at); celd_text_advance (r), any = true)
      if (mantissa < LARGEST_NUMBER * 1e5 && divisor < 1e15) /* later decimals are below the precision of the result */
        {
          mantissa = mantissa * 10 + (*r->at - '0');
          divisor *= 10;
        }
  if (!any)
    return celd_text_refuse (&start, expected);
  *number  = negative ? -mantissa / divisor : mantissa / divisor;
  exponent = svg ? read_exponent (r) : 0;
  if (exponent)
    *number *= pow (10, exponent);
  if (!(fabs (*number) < LARGEST_NUMBER)) /* also refuses 0 * infinity */
    return celd_text_refuse (&start, N_ ("a smaller number"));
  return CELD_OK;
}

CeldStatus
celd_text_items (const char *text, CeldStatus (*read_item) (void *data, CeldReader *r), void *data,
                 const char *expected, CeldTextError *error)
{
  CeldReader r = { text, 1, 1, error };
  CeldStatus status = CELD_OK;

  if (strncmp (text, "\xef\xbb\xbf", 3) == 0) /* a byte order mark */
    r.at += 3;
  for (celd_text_skip_blanks (&r); *r.at && status == CELD_OK; celd_text_skip_blanks (&r))
    if (celd_text_at_line_end (&r))
      celd_text_skip_line_end (&r);
    else if (*r.at == ';')
      celd_text_advance (&r);
    else
      {
        status = read_item (data, &r);
        if (status == CELD_OK && *r.at && *r.at != ';' && !celd_text_at_line_end (&r))
          status = celd_text_refuse (&r, expected);
      }
  return status;
}
