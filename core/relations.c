/* Relations as text: the one grammar of operations, command line, files, plug-ins and tests (docs/relations.md).
 *
 *   relations = relation { (";" | newline) relation }
 *   relation  = term { (">" | "<" | "=") term } { flag }
 *   term      = x "," y | "#" rrggbb
 *   flag      = "@" number | "+" number | "!crack" | "!anchor"
 *
 * Read by recursive descent, one function a rule, in one pass.  Where the grammar is silent: empty relations (blank
 * lines, a final ";") say nothing; a lone term is an error, because it relates nothing; a flag given twice counts as
 * given last; numbers are plain decimals without exponent, read without the C library, whose decimal point depends on
 * the locale.  A line ends with \n, \r\n or \r; a byte order mark is skipped.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "private.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#define LARGEST 1e9 /* numbers stay below; far outside of any drawing */

typedef struct
{
  const char    *at;           /* next byte */
  int            line, column; /* of that byte, from 1 */
  CeldTextError *error;
} Reader;

/* A term, and where it stands. */
typedef struct { CeldTerm term; int line, column; } PlacedTerm;

/* Past one character of the grammar.  They are all ASCII: reading ends at any other, so columns count characters. */
static void
advance (Reader *r)
{
  r->at++;
  if (r->column < INT_MAX)
    r->column++;
}

static void
skip_blanks (Reader *r)
{
  while (*r->at == ' ' || *r->at == '\t' || *r->at == '\v' || *r->at == '\f')
    advance (r);
}

static bool
at_line_end (const Reader *r)
{
  return *r->at == '\n' || *r->at == '\r';
}

static void
skip_line_end (Reader *r)
{
  if (r->at[0] == '\r' && r->at[1] == '\n')
    r->at++;
  r->at++;
  r->column = 1;
  if (r->line < INT_MAX)
    r->line++;
}

/* Bytes of the character at `text`, 0 where it is not well-formed UTF-8. */
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

/* Says what should stand at `r` instead of what does. */
static CeldStatus
refuse (const Reader *r, const char *expected)
{
  CeldTextError *error  = r->error;
  size_t         length = character_length (r->at);

  if (!error)
    return CELD_BAD_RELATION;
  error->line   = r->line;
  error->column = r->column;
  snprintf (error->expected, sizeof error->expected, "%s", expected);
  if (!*r->at)
    snprintf (error->found, sizeof error->found, "the end of the text");
  else if (at_line_end (r))
    snprintf (error->found, sizeof error->found, "the end of the line");
  else if (length == 0 || (unsigned char) *r->at < ' ' || *r->at == 127)
    snprintf (error->found, sizeof error->found, "byte 0x%02x", (unsigned) (unsigned char) *r->at);
  else
    snprintf (error->found, sizeof error->found, "\"%.*s\"", (int) length, r->at);
  return CELD_BAD_RELATION;
}

static bool
is_digit (char c)
{
  return c >= '0' && c <= '9';
}

/* [ "-" ] digits [ "." digits ]; either digits may be missing, not both. */
static CeldStatus
read_number (Reader *r, const char *expected, double *number)
{
  Reader start    = *r;
  bool   negative = *r->at == '-', any = false;
  double mantissa = 0, divisor = 1; /* both exact, so that their quotient is correctly rounded */

  if (negative)
    advance (r);
  for (; is_digit (*r->at); advance (r), any = true)
    if ((mantissa = mantissa * 10 + (*r->at - '0')) >= LARGEST)
      return refuse (&start, "a smaller number");
  if (*r->at == '.')
    for (advance (r); is_digit (*r->at); advance (r), any = true)
      if (mantissa < LARGEST * 1e5 && divisor < 1e15) /* later decimals are below the precision of the result */
        {
          mantissa = mantissa * 10 + (*r->at - '0');
          divisor *= 10;
        }
  if (!any)
    return refuse (&start, expected);
  *number = negative ? -mantissa / divisor : mantissa / divisor;
  return CELD_OK;
}

/* What stands behind "@" and "+". */
static CeldStatus
read_positive (Reader *r, double *number)
{
  const char *expected = "a number above 0";
  Reader      start;
  CeldStatus  status;

  advance (r);
  skip_blanks (r);
  start  = *r;
  status = read_number (r, expected, number);
  return status == CELD_OK && !(*number > 0) ? refuse (&start, expected) : status;
}

static int
hexadecimal (char c)
{
  return is_digit (c) ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

static CeldStatus
read_colour (Reader *r, CeldTerm *term)
{
  term->by_colour = true;
  advance (r);
  for (int i = 0; i < 6; i++, advance (r))
    {
      int digit = hexadecimal (*r->at);

      if (digit < 0)
        return refuse (r, "a hexadecimal digit of \"#rrggbb\"");
      term->colour[i / 2] = (uint8_t) (term->colour[i / 2] * 16 + digit);
    }
  return CELD_OK;
}

static CeldStatus
read_point (Reader *r, CeldTerm *term)
{
  CeldStatus status = read_number (r, "a point \"x,y\" or a colour \"#rrggbb\"", &term->x);

  if (status != CELD_OK)
    return status;
  skip_blanks (r);
  if (*r->at != ',')
    return refuse (r, "a comma between x and y");
  advance (r);
  skip_blanks (r);
  return read_number (r, "a number for y", &term->y);
}

static CeldStatus
read_term (Reader *r, PlacedTerm *placed)
{
  CeldStatus status;

  skip_blanks (r);
  *placed = (PlacedTerm) { .line = r->line, .column = r->column };
  status  = *r->at == '#' ? read_colour (r, &placed->term) : read_point (r, &placed->term);
  skip_blanks (r);
  return status;
}

/* "!crack" or "!anchor". */
static CeldStatus
read_mark (Reader *r, CeldRelation *flags)
{
  bool   crack  = strncmp (r->at, "!crack", 6) == 0, anchor = strncmp (r->at, "!anchor", 7) == 0;
  Reader behind = *r;

  if (!crack && !anchor)
    {
      advance (r);
      return refuse (r, "\"crack\" or \"anchor\"");
    }
  for (int i = 0; i < (crack ? 6 : 7); i++)
    advance (&behind);
  flags->crack  |= crack;
  flags->anchor |= anchor;
  *r = behind;
  return CELD_OK;
}

static CeldStatus
read_flags (Reader *r, CeldRelation *flags)
{
  CeldStatus status = CELD_OK;

  for (; status == CELD_OK; skip_blanks (r))
    switch (*r->at)
      {
      case '@': status = read_positive (r, &flags->weight); break;
      case '+': status = read_positive (r, &flags->gap); break;
      case '!': status = read_mark (r, flags); break;
      default:  return CELD_OK;
      }
  return status;
}

static CeldStatus
append (CeldRelations *relations, const PlacedTerm *left, char sign, const PlacedTerm *right)
{
  return celd_relation_add (relations, (CeldRelation) {
    .nearer = sign == '<' ? right->term : left->term, .farther = sign == '<' ? left->term : right->term,
    .equal = sign == '=', .source = CELD_SOURCE_TEXT, .line = left->line, .column = left->column,
  });
}

/* One chain; its flags count for every relation of it. */
static CeldStatus
read_relation (Reader *r, CeldRelations *relations)
{
  PlacedTerm   left, right;
  size_t       first  = relations->n;
  CeldRelation flags  = { .weight = 1, .gap = 1 };
  CeldStatus   status = read_term (r, &left);

  if (status == CELD_OK && (!*r->at || !strchr ("<>=", *r->at)))
    return refuse (r, "\">\", \"<\" or \"=\"");
  while (status == CELD_OK && *r->at && strchr ("<>=", *r->at))
    {
      char sign = *r->at;

      advance (r);
      if ((status = read_term (r, &right)) == CELD_OK)
        status = append (relations, &left, sign, &right);
      left = right;
    }
  if (status == CELD_OK)
    status = read_flags (r, &flags);
  for (size_t i = first; i < relations->n; i++)
    {
      relations->item[i].weight = flags.weight;
      relations->item[i].gap    = flags.gap;
      relations->item[i].crack  = flags.crack;
      relations->item[i].anchor = flags.anchor;
    }
  return status;
}

CeldStatus
celd_relations_parse (const char *text, CeldRelations *relations, CeldTextError *error)
{
  Reader     r      = { text, 1, 1, error };
  size_t     before = relations->n;
  CeldStatus status = CELD_OK;

  if (strncmp (text, "\xef\xbb\xbf", 3) == 0) /* a byte order mark */
    r.at += 3;
  for (skip_blanks (&r); *r.at && status == CELD_OK; skip_blanks (&r))
    if (at_line_end (&r))
      skip_line_end (&r);
    else if (*r.at == ';')
      advance (&r);
    else
      {
        status = read_relation (&r, relations);
        if (status == CELD_OK && *r.at && *r.at != ';' && !at_line_end (&r))
          status = refuse (&r, "\";\", a new line or a flag (@, +, !)");
      }
  if (status != CELD_OK)
    relations->n = before;
  return status;
}
