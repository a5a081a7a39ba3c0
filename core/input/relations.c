/* Relations as text: the one grammar of operations, command line, files, plug-ins and tests (docs/relations.md).
 *
 *   relations = relation { (";" | newline) relation }
 *   relation  = term { (">" | "<" | "=") term } { flag }
 *   term      = x "," y | "#" rrggbb
 *   flag      = "@" number | "+" number | "!crack" | "!anchor"
 *
 * Between several drawings a term is  name ":" (term | "*").
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

/* The names of drawings; n 0: terms have none. */
typedef struct { const char *const *name; size_t n; } Names;

/* What stands behind "@" and "+". */
static CeldStatus
read_positive (CeldReader *r, double *number)
{
  const char *expected = "a number above 0";
  CeldReader  start;
  CeldStatus  status;

  celd_text_advance (r);
  celd_text_skip_blanks (r);
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
        return celd_text_refuse (r, N_ ("a hexadecimal digit of \"#rrggbb\""));
      term->colour[i / 2] = (uint8_t) (term->colour[i / 2] * 16 + digit);
    }
  return CELD_OK;
}

static CeldStatus
read_point (CeldReader *r, CeldTerm *term)
{
  CeldStatus status = celd_text_number (r, false, N_ ("a point \"x,y\" or a colour \"#rrggbb\""), &term->x);

  if (status != CELD_OK)
    return status;
  celd_text_skip_blanks (r);
  if (*r->at != ',')
    return celd_text_refuse (r, N_ ("a comma between x and y"));
  celd_text_advance (r);
  celd_text_skip_blanks (r);
  return celd_text_number (r, false, N_ ("a number for y"), &term->y);
}

static bool
is_of_name (char c)
{
  return celd_text_is_digit (c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c && strchr ("-_.", c));
}

/* The name of a drawing and a colon. */
static CeldStatus
read_name (CeldReader *r, const Names *names, CeldTerm *term)
{
  const CeldReader start = *r;
  size_t           n;

  while (is_of_name (*r->at))
    celd_text_advance (r);
  n = (size_t) (r->at - start.at);
  celd_text_skip_blanks (r);
  if (!n || *r->at != ':')
    return celd_text_refuse (&start, N_ ("the name of a drawing and \":\""));
  celd_text_advance (r);
  celd_text_skip_blanks (r);
  for (size_t i = 0; i < names->n; i++)
    if (strlen (names->name[i]) == n && !strncmp (names->name[i], start.at, n))
      {
        term->fragment = i;
        return CELD_OK;
      }
  return celd_text_refuse (&start, N_ ("the name of one of the drawings"));
}

static CeldStatus
read_term (CeldReader *r, const Names *names, PlacedTerm *placed)
{
  CeldStatus status;

  celd_text_skip_blanks (r);
  *placed = (PlacedTerm) { .line = r->line, .column = r->column };
  status  = names->n ? read_name (r, names, &placed->term) : CELD_OK;
  if (status != CELD_OK)
    return status;
  if (names->n && *r->at == '*')
    {
      placed->term.whole = true;
      celd_text_advance (r);
    }
  else
    status = *r->at == '#' ? read_colour (r, &placed->term) : read_point (r, &placed->term);
  celd_text_skip_blanks (r);
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
      return celd_text_refuse (r, N_ ("\"crack\" or \"anchor\""));
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

  for (; status == CELD_OK; celd_text_skip_blanks (r))
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

/* What is read, and the names that ends may have. */
typedef struct { const Names *names; CeldRelations *relations; } Reading;

/* One chain; its flags count for every relation of it. */
static CeldStatus
read_relation (void *data, CeldReader *r)
{
  const Names   *names = ((Reading *) data)->names;
  CeldRelations *relations = ((Reading *) data)->relations;
  PlacedTerm     left, right;
  size_t         first  = relations->n;
  CeldRelation   flags  = { .weight = 1, .gap = 1 };
  CeldStatus     status = read_term (r, names, &left);

  if (status == CELD_OK && (!*r->at || !strchr ("<>=", *r->at)))
    return celd_text_refuse (r, N_ ("\">\", \"<\" or \"=\""));
  while (status == CELD_OK && *r->at && strchr ("<>=", *r->at))
    {
      char sign = *r->at;

      celd_text_advance (r);
      if ((status = read_term (r, names, &right)) == CELD_OK)
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

static CeldStatus
read_relations (const char *text, const Names *names, CeldRelations *relations, CeldTextError *error)
{
  size_t     before = relations->n;
  CeldStatus status = celd_text_items (text, read_relation, &(Reading) { names, relations },
                                       "\";\", a new line or a flag (@, +, !)", error);

  if (status != CELD_OK)
    relations->n = before;
  return status;
}

CeldStatus
celd_relations_parse (const char *text, CeldRelations *relations, CeldTextError *error)
{
  return read_relations (text, &(Names) { NULL, 0 }, relations, error);
}

CeldStatus
celd_fragment_relations_parse (const char *text, const char *const *name, size_t n, CeldRelations *relations,
                               CeldTextError *error)
{
  return n ? read_relations (text, &(Names) { name, n }, relations, error) : CELD_NOTHING_TO_GO_BY;
}
