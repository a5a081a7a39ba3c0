/* Relations as text: the one grammar of operations, command line, files, plug-ins and tests (docs/relations.md).
 *
 *   relations = relation { (";" | newline) relation }
 *   relation  = term { (">" | "<" | "=") term } { flag }
 *   term      = x "," y | "#" rrggbb
 *   flag      = "@" number | "+" number | "!crack" | "!anchor"
 *
 * Read by recursive descent, one function a rule, in one pass.  Where the grammar is silent: empty relations (blank
 * lines, a final ";") say nothing; a lone term is an error, because it relates nothing; a flag given twice counts as
 * given last; numbers are plain decimals without exponent.  A line ends with \n, \r\n or \r; a byte order mark is
 * skipped.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"

/* A term, and where it stands. */
typedef struct { CeldTerm term; int line, column; } PlacedTerm;

static void
skip_blanks (CeldReader *r)
{
  while (*r->at == ' ' || *r->at == '\t' || *r->at == '\v' || *r->at == '\f')
    celd_text_advance (r);
}

/* What stands behind "@" and "+". */
static CeldStatus
read_positive (CeldReader *r, double *number)
{
  const char *expected = "a number above 0";
  CeldReader  start;
  CeldStatus  status;

  celd_text_advance (r);
  skip_blanks (r);
  start  = *r;
  status = celd_text_number (r, false, expected, number);
  return status == CELD_OK && !(*number > 0) ? celd_text_refuse (&start, expected) : status;
}

static int
hexadecimal (char c)
{
  if (celd_text_is_digit (c))
    return c - '0';
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

static CeldStatus
read_colour (CeldReader *r, CeldTerm *term)
{
  term->by_colour = true;
  celd_text_advance (r);
  for (int i = 0; i < 6; i++, celd_text_advance (r))
    {
      int digit = hexadecimal (*r->at);

      if (digit < 0)
        return celd_text_refuse (r, "a hexadecimal digit of \"#rrggbb\"");
      term->colour[i / 2] = (uint8_t) (term->colour[i / 2] * 16 + digit);
    }
  return CELD_OK;
}

static CeldStatus
read_point (CeldReader *r, CeldTerm *term)
{
  CeldStatus status = celd_text_number (r, false, "a point \"x,y\" or a colour \"#rrggbb\"", &term->x);

  if (status != CELD_OK)
    return status;
  skip_blanks (r);
  if (*r->at != ',')
    return celd_text_refuse (r, "a comma between x and y");
  celd_text_advance (r);
  skip_blanks (r);
  return celd_text_number (r, false, "a number for y", &term->y);
}

static CeldStatus
read_term (CeldReader *r, PlacedTerm *placed)
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
read_mark (CeldReader *r, CeldRelation *flags)
{
  bool       crack  = strncmp (r->at, "!crack", 6) == 0, anchor = strncmp (r->at, "!anchor", 7) == 0;
  CeldReader behind = *r;

  if (!crack && !anchor)
    {
      celd_text_advance (r);
      return celd_text_refuse (r, "\"crack\" or \"anchor\"");
    }
  for (int i = 0; i < (crack ? 6 : 7); i++)
    celd_text_advance (&behind);
  flags->crack  |= crack;
  flags->anchor |= anchor;
  *r = behind;
  return CELD_OK;
}

static CeldStatus
read_flags (CeldReader *r, CeldRelation *flags)
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
read_relation (CeldReader *r, CeldRelations *relations)
{
  PlacedTerm   left, right;
  size_t       first  = relations->n;
  CeldRelation flags  = { .weight = 1, .gap = 1 };
  CeldStatus   status = read_term (r, &left);

  if (status == CELD_OK && (!*r->at || !strchr ("<>=", *r->at)))
    return celd_text_refuse (r, "\">\", \"<\" or \"=\"");
  while (status == CELD_OK && *r->at && strchr ("<>=", *r->at))
    {
      char sign = *r->at;

      celd_text_advance (r);
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
  CeldReader r      = { text, 1, 1, error };
  size_t     before = relations->n;
  CeldStatus status = CELD_OK;

  if (strncmp (text, "\xef\xbb\xbf", 3) == 0) /* a byte order mark */
    r.at += 3;
  for (skip_blanks (&r); *r.at && status == CELD_OK; skip_blanks (&r))
    if (celd_text_at_line_end (&r))
      celd_text_skip_line_end (&r);
    else if (*r.at == ';')
      celd_text_advance (&r);
    else
      {
        status = read_relation (&r, relations);
        if (status == CELD_OK && *r.at && *r.at != ';' && !celd_text_at_line_end (&r))
          status = celd_text_refuse (&r, "\";\", a new line or a flag (@, +, !)");
      }
  if (status != CELD_OK)
    relations->n = before;
  return status;
}
