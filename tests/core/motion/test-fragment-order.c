/* The order of the regions of several drawings: their own orders, relations between them, and wishes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "fragments.h"

static const char *const names[] = { "man", "rope", "hat" };

/* A body (B) with an arm (C) in front of it; a rope (B) across. */
static const char *const man_rows[] = { "AAAAAAA", "ABBCBBA", "ABBCBBA", "ABBCBBA", "AAAAAAA", NULL };
static const char *const rope_rows[] = { "AAAAAAA", "AAAAAAA", "BBBBBBB", "AAAAAAA", "AAAAAAA", NULL };

static CeldRelations
between (const char *text)
{
  CeldRelations relations = { 0 };

  CHECK (celd_fragment_relations_parse (text, names, 3, &relations, NULL) == CELD_OK);
  return relations;
}

/* Puts the rope over the man. */
static CeldComposition *
compose_rope (const Drawn drawing[2], const CeldRelations *relations, CeldProblems *problems)
{
  CeldFragment     fragment[2] = { drawn_at (&drawing[0], 0, 0), drawn_at (&drawing[1], 0, 0) };
  CeldComposition *made = NULL;

  CHECK (celd_compose (fragment, 2, relations, 7, 5, NULL, problems, &made) == CELD_OK);
  return made;
}

/* Row 2 of the composition. */
static void
shows (const char *relations, const char *wanted, size_t contradictions, size_t problems_wanted)
{
  Drawn            drawing[2] = { drawn_text (0, man_rows, 3, "3.5,2.5 > 1.5,2.5"), drawn_text (1, rope_rows, 2, "") };
  CeldRelations    read = between (relations);
  CeldProblems     problems = { 0 };
  CeldComposition *made = compose_rope (drawing, &read, &problems);
  char             text[36];
  size_t           cycles;

  shown (made, 7, 5, text);
  CHECK (!strncmp (text, "aaaaaaa" "abbcbba", 14));
  CHECK (!strncmp (text + 14, wanted, 7));
  CHECK (celd_composition_cycles (made, &cycles) || !cycles);
  CHECK (cycles == contradictions);
  CHECK (problems.n == problems_wanted);
  celd_composition_free (made);
  celd_problems_clear (&problems);
  celd_relations_clear (&read);
  drawn_clear (&drawing[0]);
  drawn_clear (&drawing[1]);
}

static void
the_later_drawing_is_in_front (void)
{
  shows ("", "BBBBBBB", 0, 0);
}

static void
a_rope_goes_behind_the_arm_and_before_the_body (void)
{
  shows ("man:3.5,2.5 > rope:0.5,2.5; rope:0.5,2.5 > man:1.5,2.5", "BBBcBBB", 0, 0);
  shows ("man:3.5,1.5 > rope:*", "BBBcBBB", 0, 0); /* of the body nothing is said: the rope is later */
  shows ("man:#14a01e > rope:#3cbe14", "BBBcBBB", 0, 0);
}

/* A region in front of the rope brings along what is in front of itself, and nothing else. */
static void
relations_follow_from_others (void)
{
  shows ("man:1.5,2.5 > rope:*", "BbbcbbB", 0, 0);
  shows ("man:* > rope:*", "BbbcbbB", 0, 0);
  shows ("man:0.5,0.5 > rope:*", "abbcbba", 0, 0); /* the page, and all that is before it */
}

/* The body before the rope and the rope before the arm, which is before the body. */
static void
contradictions_are_reported (void)
{
  shows ("man:1.5,2.5 > rope:*; rope:* > man:3.5,2.5", "BbbcbbB", 1, 1);
  shows ("man:1.5,2.5 > rope:*; rope:* > man:3.5,2.5 @2", "BBBBBBB", 1, 1);
  shows ("man:1.5,2.5 > man:3.5,2.5", "BBBBBBB", 1, 1);
}

static void
a_cycle_names_the_relations_between_drawings (void)
{
  Drawn            drawing[2] = { drawn_text (0, man_rows, 3, "3.5,2.5 > 1.5,2.5"), drawn_text (1, rope_rows, 2, "") };
  CeldRelations    read = between ("rope:* > man:0.5,0.5; man:1.5,2.5 > rope:*; rope:* > man:3.5,2.5");
  CeldProblems     problems = { 0 };
  CeldComposition *made = compose_rope (drawing, &read, &problems);
  size_t           n;
  const CeldCycle *cycle = celd_composition_cycles (made, &n);

  CHECK (n == 1 && cycle->n == 2 && cycle->item[0] == 2 && cycle->item[1] == 1);
  CHECK (problems.n == 1 && problems.item[0].kind == CELD_PROBLEM_CONTRADICTION && problems.item[0].relation == 2);
  celd_composition_free (made);
  celd_problems_clear (&problems);
  celd_relations_clear (&read);
  drawn_clear (&drawing[0]);
  drawn_clear (&drawing[1]);
}

static void
ends_without_a_region_are_reported (void)
{
  shows ("man:#123456 > rope:*", "BBBBBBB", 0, 1);
  shows ("man:70,2 > rope:*", "BBBBBBB", 0, 1);
  shows ("man:* > man:1.5,2.5", "BBBBBBB", 0, 1);
}

/* Equal depth: the later drawing is in front, and what is in front of one is in front of both. */
static void
equal_regions_share_their_depth (void)
{
  shows ("man:1.5,2.5 = rope:*", "BBBcBBB", 0, 0);
}

/* ------------------------------------------------------------------ any relations at all */

/* Random regions, so that all drawings overlap with most of their regions. */
static CeldLabels
random_labels (uint32_t *state, uint32_t n)
{
  CeldLabels labels = { 0 };

  CHECK (celd_labels_new (12, 12, &labels) == CELD_OK);
  for (int p = 0; p < 144; p++)
    labels.data[p] = 1 + check_random (state, n);
  return labels;
}

static void
random_text (uint32_t *state, int relations, bool named, uint32_t n, char *text)
{
  for (int i = 0; i < relations; i++)
    for (int side = 0; side < 2; side++)
      {
        int     drawing = named ? (int) check_random (state, 3) : 0;
        uint8_t colour[4];

        drawn_colour (drawing, 2 + check_random (state, n - 1), colour);
        text += sprintf (text, "%s%s#%02x%02x%02x%s", named ? names[drawing] : "", named ? ":" : "", colour[0],
                         colour[1], colour[2], side ? "; " : " > ");
      }
}

/* The position of a region from the back. */
static size_t
position (const CeldComposition *c, size_t fragment, uint32_t label)
{
  for (size_t i = 0; i < celd_composition_count (c); i++)
    if (celd_composition_item (c, i)->fragment == fragment && celd_composition_item (c, i)->label == label)
      return i;
  return CELD_NO_INDEX;
}

#define REGIONS 5

/* reach[a][b]: is a in front of b by a chain of relations that hold? */
typedef struct { bool reach[3 * REGIONS][3 * REGIONS]; } Chains;

static void
close_chains (Chains *chains)
{
  for (int k = 0; k < 3 * REGIONS; k++)
    for (int a = 0; a < 3 * REGIONS; a++)
      for (int b = 0; b < 3 * REGIONS; b++)
        chains->reach[a][b] |= chains->reach[a][k] && chains->reach[k][b];
}

static uint32_t
label_of_end (const Drawn *drawing, const CeldTerm *term)
{
  for (uint32_t l = 1; l <= REGIONS; l++)
    if (!memcmp (drawing[term->fragment].palette.item[l - 1].colour, term->colour, 3))
      return l;
  return 0;
}

static int
end_of (const Drawn *drawing, const CeldTerm *term)
{
  return (int) term->fragment * REGIONS + (int) label_of_end (drawing, term) - 1;
}

static bool
is_left_out (const CeldProblems *problems, size_t relation)
{
  for (size_t i = 0; i < problems->n; i++)
    if (problems->item[i].relation == relation)
      return true;
  return false;
}

/* Own relations and those between drawings hold or are reported, these contradict the others, and of two regions that
 * no chain of relations and wishes compares the one of the later drawing is in front. */
static void
check_composition (const CeldComposition *c, const Drawn drawing[3], const CeldRelations *relations,
                   const CeldProblems *problems)
{
  Chains chains = { 0 };

  for (int f = 0; f < 3; f++)
    for (size_t i = 0; i < drawing[f].order.links.n; i++)
      {
        const CeldOrderLinks *l = &drawing[f].order.links;

        for (size_t a = l->first[2 * i]; a < l->first[2 * i + 1]; a++)
          for (size_t b = l->first[2 * i + 1]; b < l->first[2 * i + 2]; b++)
            chains.reach[f * REGIONS + (int) l->end[b]][f * REGIONS + (int) l->end[a]] = true;
      }
  for (size_t i = 0; i < relations->n; i++)
    if (!is_left_out (problems, i))
      chains.reach[end_of (drawing, &relations->item[i].nearer)][end_of (drawing, &relations->item[i].farther)] = true;
  close_chains (&chains);
  for (int a = 0; a < 3 * REGIONS; a++)
    for (int b = 0; b < 3 * REGIONS; b++)
      {
        size_t front = position (c, (size_t) (a / REGIONS), (uint32_t) (a % REGIONS) + 1);
        size_t back = position (c, (size_t) (b / REGIONS), (uint32_t) (b % REGIONS) + 1);

        CHECK (a != b || !chains.reach[a][b]);
        if (front == CELD_NO_INDEX || back == CELD_NO_INDEX || !chains.reach[a][b])
          continue;
        CHECK (front > back);
        CHECK (celd_composition_item (c, front)->level > celd_composition_item (c, back)->level);
      }
  for (size_t i = 0; i < problems->n; i++)
    if (problems->item[i].kind == CELD_PROBLEM_CONTRADICTION)
      {
        const CeldRelation *left_out = &relations->item[problems->item[i].relation];

        CHECK (chains.reach[end_of (drawing, &left_out->farther)][end_of (drawing, &left_out->nearer)]);
      }
}

static void
random_relations_hold_or_are_reported (void)
{
  uint32_t state = 5;
  size_t   contradictions = 0, turned = 0;

  for (int round = 0; round < 400; round++)
    {
      char             text[2000] = "";
      Drawn            drawing[3];
      CeldFragment     fragment[3];
      CeldRelations    relations;
      CeldProblems     problems = { 0 };
      CeldComposition *made = NULL;

      for (int f = 0; f < 3; f++)
        {
          random_text (&state, (int) check_random (&state, 5), false, REGIONS, text);
          for (char *at = text; f && (at = strchr (at, '#')); at++)
            memcpy (at + 1, f == 1 ? "3c" : "64", 2); /* the red of its drawing */
          drawing[f] = drawn (f, random_labels (&state, REGIONS), REGIONS, text);
          fragment[f] = drawn_at (&drawing[f], 0, 0);
          text[0] = 0;
        }
      random_text (&state, (int) check_random (&state, 8), true, REGIONS, text);
      relations = between (text);
      CHECK (celd_compose (fragment, 3, &relations, 12, 12, NULL, &problems, &made) == CELD_OK);
      CHECK (celd_composition_count (made) == 3 * REGIONS - 2);
      check_composition (made, drawing, &relations, &problems);
      celd_composition_cycles (made, &contradictions);
      for (size_t i = 1; i < celd_composition_count (made); i++)
        turned += celd_composition_item (made, i)->fragment < celd_composition_item (made, i - 1)->fragment;
      celd_composition_free (made);
      celd_problems_clear (&problems);
      celd_relations_clear (&relations);
      for (int f = 0; f < 3; f++)
        drawn_clear (&drawing[f]);
    }
  CHECK (turned > 100); /* relations have changed many orders */
}

static void
bad_input_is_refused (void)
{
  Drawn            man = drawn_text (0, man_rows, 3, "");
  CeldFragment     fragment = drawn_at (&man, 0, 0);
  CeldComposition *made = NULL;
  const double     bad[] = { NAN, INFINITY, -INFINITY, 1e300 };

  CHECK (celd_compose (&fragment, 0, NULL, 7, 5, NULL, NULL, &made) == CELD_NOTHING_TO_GO_BY);
  CHECK (celd_compose (&fragment, 1, NULL, 0, 5, NULL, NULL, &made) == CELD_BAD_SIZE);
  CHECK (celd_compose (&fragment, 1, NULL, 7, CELD_MAX_SIDE + 1, NULL, NULL, &made) == CELD_BAD_SIZE);
  for (int i = 0; i < 4; i++)
    for (int member = 0; member < 4; member++)
      {
        CeldPlacement *p = &fragment.placement;

        *p = (CeldPlacement) { 0, 0, 1, 0, false };
        *(member == 0 ? &p->x : member == 1 ? &p->y : member == 2 ? &p->scale : &p->turn) = bad[i];
        CHECK (celd_compose (&fragment, 1, NULL, 7, 5, NULL, NULL, &made) == CELD_BAD_VALUE);
      }
  fragment.placement = (CeldPlacement) { 0, 0, 0, 0, false };
  CHECK (celd_compose (&fragment, 1, NULL, 7, 5, NULL, NULL, &made) == CELD_BAD_VALUE);
  CHECK (!made);
  drawn_clear (&man);
}

int
main (void)
{
  RUN (the_later_drawing_is_in_front);
  RUN (a_rope_goes_behind_the_arm_and_before_the_body);
  RUN (relations_follow_from_others);
  RUN (contradictions_are_reported);
  RUN (a_cycle_names_the_relations_between_drawings);
  RUN (ends_without_a_region_are_reported);
  RUN (equal_regions_share_their_depth);
  RUN (random_relations_hold_or_are_reported);
  RUN (bad_input_is_refused);
  return DONE;
}
