/* Arrows as SVG path data (SVG 1.1, 8.3): each sub-path is an arrow, its first point is nearer.
 *
 *   path     = { command }                           the first one is M or m
 *   command  = letter { numbers }                    a letter's numbers may come again without it; after M that means L
 *   numbers  = M, L, T: x y   H: x   V: y   C: x1 y1 x2 y2 x y   S, Q: x1 y1 x y   A: rx ry angle flag flag x y
 *
 * Small letters count from the current point.  Numbers may touch where that is clear ("-1-2", ".5.5"); blanks or one
 * comma stand between them.  Only the ends of an arrow matter, so curves need not be flattened: their last point does.
 * Z closes a sub-path back to its first point in SVG; that line is no part of the arrow.  An arrow without two
 * different ends is refused, because it relates nothing.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"

#include <math.h>

/* The numbers of each command, and which of these are x and y. */
typedef struct { char letter; int n, x, y; } Command; /* x, y: -1 = it has none */

static const Command commands[] = {
  { 'M', 2, 0, 1 }, { 'L', 2, 0, 1 }, { 'H', 1, 0, -1 }, { 'V', 1, -1, 0 }, { 'C', 6, 4, 5 },
  { 'S', 4, 2, 3 }, { 'Q', 4, 2, 3 }, { 'T', 2, 0, 1 }, { 'A', 7, 5, 6 }, { 'Z', 0, -1, -1 },
};

#define MOST_NUMBERS 7
#define N_COMMANDS   (sizeof commands / sizeof *commands)

typedef struct
{
  CeldReader     r, start;       /* where the arrow begins in the text */
  double         x, y;           /* current point */
  double         first_x, first_y;
  bool           begun, drawn;   /* has the arrow a first point, and a further one? */
  CeldRelations *relations;
} Path;

static void
skip_blanks (CeldReader *r)
{
  for (;;)
    if (celd_text_at_line_end (r))
      celd_text_skip_line_end (r);
    else if (*r->at == ' ' || *r->at == '\t' || *r->at == '\f')
      celd_text_advance (r);
    else
      return;
}

/* What may stand between two numbers. */
static void
skip_comma (CeldReader *r)
{
  skip_blanks (r);
  if (*r->at == ',')
    celd_text_advance (r);
  skip_blanks (r);
}

/* Do the numbers of a command come again?  Behind a comma they must. */
static bool
goes_on (CeldReader *r)
{
  skip_blanks (r);
  if (*r->at == ',')
    {
      skip_comma (r);
      return true;
    }
  return celd_text_is_digit (*r->at) || *r->at == '.' || *r->at == '-' || *r->at == '+';
}

/* A letter, small or not; NULL if it is none of them. */
static const Command *
find_command (char letter)
{
  for (size_t i = 0; i < N_COMMANDS; i++)
    if (letter == commands[i].letter || letter == commands[i].letter - 'A' + 'a')
      return &commands[i];
  return NULL;
}

/* Flags of arcs are one digit, and the next number may touch it. */
static CeldStatus
read_flag (CeldReader *r, double *flag)
{
  if (*r->at != '0' && *r->at != '1')
    return celd_text_refuse (r, N_ ("a flag of an arc: 0 or 1"));
  *flag = *r->at - '0';
  celd_text_advance (r);
  return CELD_OK;
}

/* The numbers of a command, once. */
static CeldStatus
read_numbers (CeldReader *r, const Command *command, double *number)
{
  CeldStatus status = CELD_OK;

  for (int i = 0; i < command->n && status == CELD_OK; i++)
    {
      bool flag = command->letter == 'A' && (i == 3 || i == 4);

      if (i)
        skip_comma (r);
      status = flag ? read_flag (r, &number[i])
                    : celd_text_number (r, true, i == command->x ? N_ ("a number for x") :
                                                 i == command->y ? N_ ("a number for y") : N_ ("a number"), &number[i]);
    }
  return status;
}

/* The arrow that was begun is complete; one that was not drawn on after Z never began. */
static CeldStatus
end_arrow (Path *path)
{
  CeldRelation relation = {
    .nearer = { .x = path->first_x, .y = path->first_y }, .farther = { .x = path->x, .y = path->y },
    .weight = 1, .gap = 1, .source = CELD_SOURCE_PATH, .line = path->start.line, .column = path->start.column,
  };

  if (!path->begun)
    return CELD_OK;
  path->begun = false;
  if (!path->drawn)
    return celd_text_refuse (&path->r, N_ ("a line to the arrow's farther end"));
  if (fabs (path->x - path->first_x) <= 0 && fabs (path->y - path->first_y) <= 0)
    return celd_text_refuse (&path->start, N_ ("an arrow with two different ends"));
  return celd_relation_add (path->relations, relation);
}

/* The arrow begins at the current point. */
static void
begin_arrow (Path *path, const CeldReader *start)
{
  path->begun   = true;
  path->drawn   = false;
  path->start   = *start;
  path->first_x = path->x;
  path->first_y = path->y;
}

static void
move (Path *path, const Command *command, bool relative, const double *number)
{
  if (command->x >= 0)
    path->x = relative ? path->x + number[command->x] : number[command->x];
  if (command->y >= 0)
    path->y = relative ? path->y + number[command->y] : number[command->y];
}

/* A line or curve, or several; behind Z it begins an arrow where the one before began. */
static CeldStatus
read_lines (Path *path, const Command *command, bool relative, const CeldReader *start)
{
  double     number[MOST_NUMBERS] = { 0 };
  CeldStatus status;

  if (!path->begun)
    begin_arrow (path, start);
  do
    {
      status = read_numbers (&path->r, command, number);
      if (status != CELD_OK)
        return status;
      move (path, command, relative, number);
      path->drawn = true;
    }
  while (goes_on (&path->r));
  return CELD_OK;
}

static CeldStatus
read_start (Path *path, const Command *command, bool relative, const CeldReader *start)
{
  double     number[MOST_NUMBERS] = { 0 };
  CeldStatus status = read_numbers (&path->r, command, number);

  if (status != CELD_OK)
    return status;
  move (path, command, relative, number);
  begin_arrow (path, start);
  return goes_on (&path->r) ? read_lines (path, find_command ('L'), relative, start) : CELD_OK;
}

static CeldStatus
read_command (Path *path)
{
  CeldReader     start = path->r;
  const Command *command = find_command (*start.at);
  bool           relative = *start.at >= 'a';
  CeldStatus     status = CELD_OK;

  if (!command)
    return celd_text_refuse (&start, N_ ("a letter of path data such as L"));
  if (command->letter == 'M' || command->letter == 'Z')
    status = end_arrow (path);
  if (status != CELD_OK)
    return status;
  celd_text_advance (&path->r);
  skip_blanks (&path->r);
  if (command->letter == 'M')
    return read_start (path, command, relative, &start);
  if (command->letter != 'Z')
    return read_lines (path, command, relative, &start);
  path->x = path->first_x;
  path->y = path->first_y;
  return CELD_OK;
}

CeldStatus
celd_arrow_path_parse (const char *text, CeldRelations *relations, CeldTextError *error)
{
  Path       path   = { .r = { text, 1, 1, error }, .relations = relations };
  size_t     before = relations->n;
  CeldStatus status = CELD_OK;

  skip_blanks (&path.r);
  if (*path.r.at && *path.r.at != 'M' && *path.r.at != 'm')
    status = celd_text_refuse (&path.r, N_ ("M or m, with which path data begin"));
  while (*path.r.at && status == CELD_OK)
    status = read_command (&path);
  if (status == CELD_OK)
    status = end_arrow (&path);
  if (status != CELD_OK)
    relations->n = before;
  return status;
}
