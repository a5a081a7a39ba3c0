/* Relations text: the grammar rule by rule, places of errors, generated texts read back, random bytes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

#include <locale.h>

/* Reads `text`, which must be good; ends with celd_relations_clear. */
static CeldRelations
good (const char *text)
{
  CeldRelations relations = { 0 };
  CeldTextError error     = { 0 };

  CHECK (celd_relations_parse (text, &relations, &error) == CELD_OK);
  CHECK (error.line == 0);
  return relations;
}

static void
bad (const char *text, int line, int column, const char *expected, const char *found)
{
  CeldRelations relations = { 0 };
  CeldTextError error     = { 0 };

  CHECK (celd_relations_parse (text, &relations, &error) == CELD_BAD_RELATION);
  CHECK (relations.n == 0);
  CHECK (error.line == line && error.column == column);
  CHECK (strstr (error.expected, expected) && strcmp (error.found, found) == 0);
  CHECK (celd_relations_parse (text, &relations, NULL) == CELD_BAD_RELATION);
  celd_relations_clear (&relations);
}

static void
one_relation (void)
{
  CeldRelations r = good ("10,20.5 > 30 , -4");

  CHECK (r.n == 1);
  CHECK (!r.item[0].nearer.by_colour && r.item[0].nearer.x == 10 && r.item[0].nearer.y == 20.5);
  CHECK (r.item[0].farther.x == 30 && r.item[0].farther.y == -4);
  CHECK (!r.item[0].equal && !r.item[0].crack && !r.item[0].anchor);
  CHECK (r.item[0].weight == 1 && r.item[0].gap == 1 && r.item[0].id == 0);
  CHECK (r.item[0].source == CELD_SOURCE_TEXT && r.item[0].line == 1 && r.item[0].column == 1);
  celd_relations_clear (&r);
}

static void
colours (void)
{
  CeldRelations r = good ("#ff8000=#0a0B0c");

  CHECK (r.n == 1 && r.item[0].equal && r.item[0].nearer.by_colour && r.item[0].farther.by_colour);
  CHECK (memcmp (r.item[0].nearer.colour, "\xff\x80\x00", 3) == 0);
  CHECK (memcmp (r.item[0].farther.colour, "\x0a\x0b\x0c", 3) == 0);
  celd_relations_clear (&r);
}

static void
bad_between (const char *text, int column, const char *expected)
{
  static const char *const names[] = { "man", "man-2" };
  CeldRelations            relations = { 0 };
  CeldTextError            error = { 0 };

  CHECK (celd_fragment_relations_parse (text, names, 2, &relations, &error) == CELD_BAD_RELATION);
  CHECK (relations.n == 0 && error.line == 1 && error.column == column && strstr (error.expected, expected));
}

static void
terms_of_several_drawings (void)
{
  static const char *const names[] = { "man", "man-2" };
  CeldRelations            r = { 0 };

  CHECK (celd_fragment_relations_parse ("man-2:#ff0000 > man : 3,4 = man:* @2", names, 2, &r, NULL) == CELD_OK);
  CHECK (r.n == 2 && r.item[1].equal && r.item[0].weight == 2);
  CHECK (r.item[0].nearer.fragment == 1 && r.item[0].nearer.by_colour && !r.item[0].nearer.whole);
  CHECK (r.item[0].farther.fragment == 0 && r.item[0].farther.x == 3 && r.item[0].farther.y == 4);
  CHECK (r.item[1].farther.fragment == 0 && r.item[1].farther.whole);
  celd_relations_clear (&r);
  bad_between ("man:1,1 > 2,2", 11, "name of a drawing");
  bad_between ("#ff0000 > man:2,2", 1, "name of a drawing");
  bad_between ("man:1,1 > ma:2,2", 11, "one of the drawings");
  bad_between ("man:1,1 > man-3:2,2", 11, "one of the drawings");
  bad_between ("man:1,1 > man-2:", 17, "a point");
  bad_between ("man:1,1 > man-2", 11, "name of a drawing");
  bad ("*>1,2", 1, 1, "a point", "\"*\"");
  CHECK (celd_fragment_relations_parse ("", names, 0, &r, NULL) == CELD_NOTHING_TO_GO_BY);
}

static void
smaller_is_stored_the_other_way_round (void)
{
  CeldRelations r = good ("1,2 < 3,4");

  CHECK (r.n == 1 && r.item[0].nearer.x == 3 && r.item[0].farther.x == 1 && r.item[0].column == 1);
  celd_relations_clear (&r);
}

static void
chains_share_their_flags (void)
{
  CeldRelations r = good ("1,1 > 2,2 < 3,3 = 4,4 @.5 +2.25 !crack !anchor; 5,5 > 6,6");

  CHECK (r.n == 4);
  for (size_t i = 0; i < 3; i++)
    CHECK (r.item[i].weight == 0.5 && r.item[i].gap == 2.25 && r.item[i].crack && r.item[i].anchor);
  CHECK (r.item[0].nearer.x == 1 && r.item[0].farther.x == 2);
  CHECK (r.item[1].nearer.x == 3 && r.item[1].farther.x == 2 && r.item[1].column == 7);
  CHECK (r.item[2].equal && r.item[2].nearer.x == 3 && r.item[2].farther.x == 4 && r.item[2].column == 13);
  CHECK (r.item[3].weight == 1 && r.item[3].gap == 1 && !r.item[3].crack && !r.item[3].anchor);
  celd_relations_clear (&r);
}

static void
separators_and_white_space (void)
{
  CeldRelations r = good ("\xef\xbb\xbf 1,1>2,2;\r\n\r\n\t3,3\t>\t4,4 ; ;5,5>6,6@2!anchor!crack\r7,7>8,8\n\n");

  CHECK (r.n == 4);
  CHECK (r.item[0].line == 1 && r.item[0].column == 2);
  CHECK (r.item[1].line == 3 && r.item[1].column == 2);
  CHECK (r.item[2].line == 3 && r.item[2].column == 15 && r.item[2].weight == 2 && r.item[2].crack);
  CHECK (r.item[3].line == 4 && r.item[3].column == 1);
  celd_relations_clear (&r);
}

static void
nothing_is_no_relation (void)
{
  const char *text[] = { "", " ", "\n", ";", "\xef\xbb\xbf", "\r\n ; \t;\n" };

  for (size_t i = 0; i < sizeof text / sizeof *text; i++)
    {
      CeldRelations r = good (text[i]);

      CHECK (r.n == 0);
      celd_relations_clear (&r);
    }
}

static void
errors_say_where (void)
{
  bad ("1,2", 1, 4, "\">\"", "the end of the text");
  bad ("1,2 > 3,4\n5,6 >\n7,8", 2, 6, "a point", "the end of the line");
  bad ("1,2 > 3,4\r\n5;6 > 7,8", 2, 2, "comma", "\";\"");
  bad ("1,2 > 3,4 > \xc3\xa9", 1, 13, "a point", "\"\xc3\xa9\"");
  bad ("1,2 > 3,4 \xff", 1, 11, "flag", "byte 0xff");
  bad ("1,2 > 3,4 \x01", 1, 11, "flag", "byte 0x01");
  bad ("#12345 > 3,4", 1, 7, "hexadecimal", "\" \"");
  bad ("#1234567 > 3,4", 1, 8, "\">\"", "\"7\"");
  bad ("1.5,2 > 3,4 @", 1, 14, "above 0", "the end of the text");
  bad ("1,2 > 3,4 @0", 1, 12, "above 0", "\"0\"");
  bad ("1,2 > 3,4 +-1", 1, 12, "above 0", "\"-\"");
  bad ("1,2 > 3,4 !crock", 1, 12, "crack", "\"c\"");
  bad ("1,2 > 3,4 @2 > 5,6", 1, 14, "flag", "\">\"");
  bad ("1,2 >> 3,4", 1, 6, "a point", "\">\"");
  bad ("1,5,2 > 3,4", 1, 4, "\">\"", "\",\"");
  bad ("nan,2 > 3,4", 1, 1, "a point", "\"n\"");
  bad ("1,inf > 3,4", 1, 3, "y", "\"i\"");
  bad ("1,1e3 > 3,4", 1, 4, "\">\"", "\"e\"");
  bad (".,1 > 3,4", 1, 1, "a point", "\".\"");
  bad ("1,99999999999 > 3,4", 1, 3, "smaller", "\"9\"");
  bad ("1,2 > 3,4 # remark", 1, 11, "flag", "\"#\"");
}

static void
numbers_are_exact (void)
{
  CeldRelations r = good ("0.1,1234.0625>999999999.,.3333333333333333333333333333333333333333333333333");

  CHECK (r.n == 1 && r.item[0].nearer.x == 0.1 && r.item[0].nearer.y == 1234.0625);
  CHECK (r.item[0].farther.x == 999999999.);
  NEAR (r.item[0].farther.y, 1. / 3, 1e-14);
  celd_relations_clear (&r);
}

/* Nothing is appended on an error; what was there stays. */
static void
errors_leave_the_result (void)
{
  CeldRelations r = good ("1,1>2,2");

  CHECK (celd_relations_parse ("3,3>4,4;5,5>6,6;7,7>", &r, NULL) == CELD_BAD_RELATION);
  CHECK (r.n == 1 && r.item[0].nearer.x == 1);
  CHECK (celd_relations_parse ("3,3>4,4", &r, NULL) == CELD_OK);
  CHECK (r.n == 2 && r.item[1].nearer.x == 3);
  celd_relations_clear (&r);
}

static void
locale_does_not_matter (void)
{
  const char   *comma = setlocale (LC_ALL, "de_DE.UTF-8"); /* may be missing on this machine: then the test says less */
  CeldRelations r     = good ("1.5,2.5 > 3.25,4");

  CHECK (r.n == 1 && r.item[0].nearer.x == 1.5 && r.item[0].nearer.y == 2.5 && r.item[0].farther.x == 3.25);
  celd_relations_clear (&r);
  if (comma)
    setlocale (LC_ALL, "C");
}

static int
write_term (const CeldTerm *t, char *text)
{
  return t->by_colour ? sprintf (text, "#%02x%02x%02x", t->colour[0], t->colour[1], t->colour[2])
                      : sprintf (text, "%.3f,%.3f", t->x, t->y);
}

static CeldTerm
random_term (uint32_t *state)
{
  CeldTerm t = { .by_colour = check_random (state, 2) };

  if (t.by_colour)
    for (int i = 0; i < 3; i++)
      t.colour[i] = (uint8_t) check_random (state, 256);
  else
    t = (CeldTerm) { .x = check_random (state, 9000000) / 1000., .y = -(double) check_random (state, 9000000) / 1000. };
  return t;
}

static bool
same_term (const CeldTerm *a, const CeldTerm *b)
{
  return a->by_colour == b->by_colour && memcmp (a->colour, b->colour, 3) == 0 && a->x == b->x && a->y == b->y;
}

static void
written_texts_read_back (void)
{
  uint32_t state = 7;

  for (int round = 0; round < 300; round++)
    {
      CeldRelation  wanted[40];
      char          text[8000], *end = text;
      uint32_t      n = 1 + check_random (&state, 40);
      CeldRelations r;

      for (uint32_t i = 0; i < n; i++)
        {
          wanted[i] = (CeldRelation) { .nearer = random_term (&state), .farther = random_term (&state) };
          wanted[i].equal  = check_random (&state, 2);
          wanted[i].crack  = check_random (&state, 2);
          wanted[i].weight = (1 + check_random (&state, 999)) / 100.;
          end += write_term (&wanted[i].nearer, end);
          end += sprintf (end, "%*s%c ", (int) check_random (&state, 3), "", wanted[i].equal ? '=' : '>');
          end += write_term (&wanted[i].farther, end);
          end += sprintf (end, " @%.2f%s%s", wanted[i].weight, wanted[i].crack ? "!crack" : "", i % 2 ? "\r\n" : ";");
        }
      r = good (text);
      CHECK (r.n == n);
      for (uint32_t i = 0; i < n && i < r.n; i++)
        CHECK (same_term (&r.item[i].nearer, &wanted[i].nearer) && same_term (&r.item[i].farther, &wanted[i].farther) &&
               r.item[i].equal == wanted[i].equal && r.item[i].crack == wanted[i].crack &&
               r.item[i].weight == wanted[i].weight && r.item[i].line == 1 + (int) i / 2);
      celd_relations_clear (&r);
    }
}

/* Whatever the bytes: an answer, values in their range, and an error inside the text. */
static void
random_bytes (void)
{
  static const char likely[] = "0123456789..,,>>>=<;\n\r  ##@+!crackanchor-\xc3\xa9\xef\xbb\xbf";
  uint32_t          state    = 1;

  for (int round = 0; round < 200000; round++)
    {
      char          text[64];
      uint32_t      n         = check_random (&state, sizeof text);
      CeldRelations relations = { 0 };
      CeldTextError error     = { 0 };

      for (uint32_t i = 0; i < n; i++)
        text[i] = check_random (&state, 8) ? likely[check_random (&state, sizeof likely - 1)]
                                           : (char) (1 + check_random (&state, 255));
      text[n] = 0;
      if (celd_relations_parse (text, &relations, &error) != CELD_OK)
        CHECK (relations.n == 0 && error.line >= 1 && error.column >= 1 && error.column <= (int) n + 1 &&
               error.expected[0] && error.found[0]);
      for (size_t i = 0; i < relations.n; i++)
        CHECK (relations.item[i].weight > 0 && relations.item[i].gap > 0 && fabs (relations.item[i].nearer.x) < 1e9);
      celd_relations_clear (&relations);
    }
}

int
main (void)
{
  RUN (one_relation);
  RUN (colours);
  RUN (terms_of_several_drawings);
  RUN (smaller_is_stored_the_other_way_round);
  RUN (chains_share_their_flags);
  RUN (separators_and_white_space);
  RUN (nothing_is_no_relation);
  RUN (errors_say_where);
  RUN (numbers_are_exact);
  RUN (errors_leave_the_result);
  RUN (locale_does_not_matter);
  RUN (written_texts_read_back);
  RUN (random_bytes);
  return DONE;
}
