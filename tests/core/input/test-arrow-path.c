/* Arrows as path data: every command, every spelling of numbers, places of errors.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

#include <locale.h>

typedef struct { double x0, y0, x1, y1; } Ends;

/* Does the text say these arrows, n of them? */
static bool
says (const char *text, size_t n, const Ends *ends)
{
  CeldRelations r = { 0 };
  bool          good = celd_arrow_path_parse (text, &r, NULL) == CELD_OK && r.n == n;

  for (size_t i = 0; good && i < n; i++)
    {
      const CeldRelation *p = &r.item[i];

      good = fabs (p->nearer.x - ends[i].x0) < 1e-9 && fabs (p->nearer.y - ends[i].y0) < 1e-9 &&
             fabs (p->farther.x - ends[i].x1) < 1e-9 && fabs (p->farther.y - ends[i].y1) < 1e-9 &&
             !p->equal && !p->crack && !p->anchor && !p->nearer.by_colour && !p->farther.by_colour &&
             p->source == CELD_SOURCE_PATH && p->weight == 1 && p->gap == 1;
    }
  if (!good)
    printf ("read otherwise: %s\n", text);
  celd_relations_clear (&r);
  return good;
}

#define SAYS(text, ...) \
  CHECK (says (text, sizeof (Ends[]) { __VA_ARGS__ } / sizeof (Ends), (Ends[]) { __VA_ARGS__ }))

static void
commands (void)
{
  SAYS ("M 120,80 L 300,95", { 120, 80, 300, 95 });
  SAYS ("M120 80 300 95", { 120, 80, 300, 95 });                     /* more points of M are lines */
  SAYS ("m 1,2 3,4 5,6", { 1, 2, 9, 12 });
  SAYS ("M 10,10 l 5,0 l 0,5", { 10, 10, 15, 15 });
  SAYS ("M 1,2 H 9 V 7 h -3 v 1", { 1, 2, 6, 8 });
  SAYS ("M 0,0 C 1,1 2,2 30,40", { 0, 0, 30, 40 });
  SAYS ("M 5,5 c 1,1 2,2 3,4 1,1 2,2 3,4", { 5, 5, 11, 13 });        /* each from the end of the one before */
  SAYS ("M 5,5 S 1,1 8,9", { 5, 5, 8, 9 });
  SAYS ("M 5,5 q 1,1 8,9 t 1,1", { 5, 5, 14, 15 });
  SAYS ("M 5,5 a 25,26 -30 0 1 50,-25", { 5, 5, 55, -20 });
  SAYS ("M 5,5 A25 26-30 0150-25", { 5, 5, 50, -25 });               /* flags need no separator */
}

static void
several_arrows (void)
{
  SAYS ("M 1,2 3,4 M 5,6 7,8", { 1, 2, 3, 4 }, { 5, 6, 7, 8 });
  SAYS ("m 1,2 3,4 m 5,6 7,8", { 1, 2, 4, 6 }, { 9, 12, 16, 20 });   /* from where the last one ended */
  SAYS ("M 1,2 9,9 Z m 5,6 7,8", { 1, 2, 9, 9 }, { 6, 8, 13, 16 });  /* from where it began, if it was closed */
  SAYS ("M 1,2 9,9 z L 3,4", { 1, 2, 9, 9 }, { 1, 2, 3, 4 });
  SAYS ("M 1,2 L 9,9 z", { 1, 2, 9, 9 });
  CHECK (says ("", 0, NULL) && says (" \t\r\n ", 0, NULL));
}

static void
numbers (void)
{
  SAYS ("M.5.5-1-2", { 0.5, 0.5, -1, -2 });
  SAYS ("M1e1+2E+1L3e-1,4.e0", { 10, 20, 0.3, 4 });
  SAYS ("M 0.001e3 1e-3 2 .3e1", { 1, 0.001, 2, 3 });
  SAYS ("M-1.5,-.5,+7,8.", { -1.5, -0.5, 7, 8 });
  SAYS ("M\n1\n,\r\n2\tL\f3 , 4 ", { 1, 2, 3, 4 });
  SAYS ("M1,1e-999 2,3", { 1, 0, 2, 3 });
}

/* What stands between the parts and how they are written changes nothing. */
static void
random_spellings (void)
{
  static const char *const gaps[] = { " ", ",", " , ", "\n", "\t,\r\n" };
  static const char *const formats[] = { "%.3f", "%+.4f", "%.6e" };
  uint32_t state = 5;

  for (int i = 0; i < 2000; i++)
    {
      char   text[400] = "M", *end = text + 1;
      double v[8];
      int    n = 2 + (int) check_random (&state, 3);

      for (int k = 0; k < 2 * n; k++)
        {
          v[k] = (check_random (&state, 2000001) - 1e6) / 1000;
          if (k)
            end += sprintf (end, "%s", gaps[check_random (&state, 5)]);
          end += sprintf (end, formats[check_random (&state, 3)], v[k]);
        }
      if (fabs (v[0] - v[2 * n - 2]) > 1e-9)
        SAYS (text, { v[0], v[1], v[2 * n - 2], v[2 * n - 1] });
    }
}

static void
locales_change_nothing (void)
{
  const char *known[] = { "de_DE.UTF-8", "fr_FR.UTF-8", "de_DE.utf8" };

  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    if (setlocale (LC_NUMERIC, known[i]))
      SAYS ("M1.5,2.25 1e-1 4", { 1.5, 2.25, 0.1, 4 });
  setlocale (LC_NUMERIC, "C");
}

static void
places (void)
{
  CeldRelations r = { 0 };

  CHECK (celd_arrow_path_parse (" M 1,1 2,2\n  m 3,3 4,4 z l 1,1", &r, NULL) == CELD_OK && r.n == 3);
  CHECK (r.item[0].line == 1 && r.item[0].column == 2);
  CHECK (r.item[1].line == 2 && r.item[1].column == 3);
  CHECK (r.item[2].line == 2 && r.item[2].column == 15);
  celd_relations_clear (&r);
}

static void
errors (void)
{
  static const struct { const char *text; int line, column; const char *expected, *found; } known[] = {
    { "L 1,2", 1, 1, "M or m", "\"L\"" },
    { "12,13 14,15", 1, 1, "M or m", "\"1\"" },
    { "M 1,2", 1, 6, "farther end", "end of the text" },
    { "M 1,2 M 3,4 5,6", 1, 7, "farther end", "\"M\"" },
    { "M 1,2 Z", 1, 7, "farther end", "\"Z\"" },
    { "M 1,2 L 3", 1, 10, "for y", "end of the text" },
    { "M 1,2\nL 3 x", 2, 5, "for y", "\"x\"" },
    { "M 1,2 L 3,4,", 1, 13, "for x", "end of the text" },
    { "M 1,2 L 3,,4", 1, 11, "for y", "\",\"" },
    { "M 1,2 L 3,4 K", 1, 13, "letter", "\"K\"" },
    { "M 1,2 L 3,4 \xc3\xa9", 1, 13, "letter", "\"\xc3\xa9\"" },
    { "M 1,2 L 3,4\x01", 1, 12, "letter", "byte 0x01" },
    { "M 1,2 A 1 1 0 2 1 5,5", 1, 15, "flag", "\"2\"" },
    { "M 1,2 C 1,1 3,3 4", 1, 18, "for y", "end of the text" },
    { "M 1,2 L 3,4e9", 1, 11, "smaller", "\"4\"" },
    { "M 1,2 L 3,- 4", 1, 11, "for y", "\"-\"" },
    { "M 1,2 L 3,4 5,6 1,2", 1, 1, "two different ends", "\"M\"" },
    { "M 1,2 Z 5", 1, 7, "farther end", "\"Z\"" },
    { "M 1,2 3,4 Z 5,6", 1, 13, "letter", "\"5\"" },
  };

  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    {
      CeldRelations r = { 0 };
      CeldTextError error = { 0 };

      CHECK (celd_relations_parse ("8,8 > 9,9", &r, NULL) == CELD_OK);
      CHECK (celd_arrow_path_parse (known[i].text, &r, NULL) == CELD_BAD_RELATION);
      CHECK (celd_arrow_path_parse (known[i].text, &r, &error) == CELD_BAD_RELATION);
      CHECK (r.n == 1 && r.item[0].nearer.x == 8);
      if (error.line != known[i].line || error.column != known[i].column ||
          !strstr (error.expected, known[i].expected) || !strstr (error.found, known[i].found))
        printf ("%s: %d:%d expected %s, found %s\n", known[i].text, error.line, error.column, error.expected,
                error.found);
      CHECK (error.line == known[i].line && error.column == known[i].column);
      CHECK (strstr (error.expected, known[i].expected) && strstr (error.found, known[i].found));
      celd_relations_clear (&r);
    }
}

/* Random bytes are read or refused, and nothing else. */
static void
random_text (void)
{
  static const char bytes[] = "MmLlHhVvCcSsQqTtAaZz0123456789.,-+eE \n\x80x";
  uint32_t          state = 77;

  for (int i = 0; i < 20000; i++)
    {
      char          text[40] = "M1 1";
      int           n = 4 + (int) check_random (&state, 30);
      CeldRelations r = { 0 };
      CeldTextError error = { 0 };
      CeldStatus    status;

      for (int k = 4; k < n; k++)
        text[k] = bytes[check_random (&state, sizeof bytes - 1)];
      status = celd_arrow_path_parse (text, &r, &error);
      CHECK (status == CELD_OK || (status == CELD_BAD_RELATION && r.n == 0 && error.line >= 1 && error.column >= 1));
      for (size_t k = 0; k < r.n; k++)
        CHECK (isfinite (r.item[k].farther.x) && isfinite (r.item[k].farther.y));
      celd_relations_clear (&r);
    }
}

int
main (void)
{
  RUN (commands);
  RUN (several_arrows);
  RUN (numbers);
  RUN (random_spellings);
  RUN (locales_change_nothing);
  RUN (places);
  RUN (errors);
  RUN (random_text);
  return DONE;
}
