/* The kept program: after any edits it answers as a new one does.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "exact-scene.h"
#include "depth/depth.h"
#include "solve/laplace.h"

static const char *const rows[] = {
  ".....#............#....",
  ".AAA.#...BBB......#.C..",
  ".....#............#....",
  ".....#####..#######....",
  ".......................",
  "...........DDDD........",
  NULL
};

/* The answer of a new program. */
static void
check_fresh (Scene *s, const CeldExact *kept, const CeldPlane *depth)
{
  CHECK (scene_solve (s, NULL) == CELD_OK);
  NEAR (kept->energy, s->exact.energy, 1e-6 * s->exact.energy);
  CHECK (kept->inequalities == s->exact.inequalities && kept->n_cycles == s->exact.n_cycles);
  for (int i = 0; i < depth->width * depth->height; i++)
    NEAR (depth->data[i], s->depth.data[i], 2e-5);
}

/* Some pixels take another label. */
static void
paint (Scene *s, uint32_t *seed)
{
  int i = (int) check_random (seed, 6 * 23 - 2);

  for (int k = 0; k < 3; k++)
    s->seeds.data[i + k] = check_random (seed, 5);
}

static void
relate (Scene *s, uint32_t *seed)
{
  char text[400] = "#010000 > #040000";

  for (uint32_t k = check_random (seed, 5); k > 0; k--)
    snprintf (text + strlen (text), 80, "; %u,%u %c %u,%u", check_random (seed, 23), check_random (seed, 6),
              ">>>="[check_random (seed, 4)], check_random (seed, 23), check_random (seed, 6));
  scene_relate (s, text);
}

static void
edits_answer_as_a_new_program (void)
{
  Scene        s = scene_new (rows, "");
  float        value[6 * 23];
  CeldPlane    depth = { 23, 6, 23, value };
  CeldProgram *p = celd_program_new ();
  CeldExact    exact = { 0 };
  uint32_t     seed = 4;

  CHECK (celd_program_set_ink (p, &s.ink, &s.settings, NULL) == CELD_OK);
  CHECK (celd_program_set_seeds (p, &s.seeds, &s.palette, s.settings.same_colour, NULL) == CELD_OK);
  for (int edit = 0; edit < 150 && !check_bad; edit++)
    {
      if (edit % 5 == 4)
        {
          paint (&s, &seed);
          s.settings.same_colour = check_random (&seed, 2) ? CELD_SAME_COLOUR_ONE : CELD_SAME_COLOUR_SEPARATE;
          CHECK (celd_program_set_seeds (p, &s.seeds, &s.palette, s.settings.same_colour, NULL) == CELD_OK);
        }
      else
        relate (&s, &seed);
      CHECK (celd_program_solve (p, &s.relations, &s.settings, NULL, &depth, &exact, NULL) == CELD_OK);
      CHECK (p->bases.n <= p->palette.n + 8 + 8);
      check_fresh (&s, &exact, &depth);
    }
  celd_exact_clear (&exact);
  celd_program_free (p);
  scene_free (&s);
}

/* A relation between scribbles, or between points that are known, needs no new basis. */
static void
relations_change_no_basis (void)
{
  Scene        s = scene_new (rows, "#010000 > #040000; 10,4 > 20,4");
  CeldProgram *p = celd_program_new ();
  float       *before;
  size_t       bytes = 6 * 23 * CELD_LANES * sizeof (float);

  CHECK (celd_program_set_ink (p, &s.ink, &s.settings, NULL) == CELD_OK);
  CHECK (celd_program_set_seeds (p, &s.seeds, &s.palette, s.settings.same_colour, NULL) == CELD_OK);
  CHECK (celd_program_solve (p, &s.relations, &s.settings, NULL, &s.depth, NULL, NULL) == CELD_OK);
  before = malloc (bytes);
  memcpy (before, p->bases.group[0], bytes);
  scene_relate (&s, "#010000 = #020000; #030000 > #020000 +2.5; 20,4 > #040000");
  CHECK (celd_program_solve (p, &s.relations, &s.settings, NULL, &s.depth, NULL, NULL) == CELD_OK);
  CHECK (celd_program_set_seeds (p, &s.seeds, &s.palette, s.settings.same_colour, NULL) == CELD_OK);
  CHECK (celd_program_solve (p, &s.relations, &s.settings, NULL, &s.depth, NULL, NULL) == CELD_OK);
  CHECK (!memcmp (before, p->bases.group[0], bytes));
  free (before);
  celd_program_free (p);
  scene_free (&s);
}

static void
a_tighter_tolerance_is_kept (void)
{
  Scene        s = scene_new (rows, "#010000 > #040000");
  CeldProgram *p = celd_program_new ();

  s.settings.tolerance = 0.01f;
  CHECK (celd_program_set_ink (p, &s.ink, &s.settings, NULL) == CELD_OK);
  CHECK (celd_program_set_seeds (p, &s.seeds, &s.palette, s.settings.same_colour, NULL) == CELD_OK);
  CHECK (celd_program_solve (p, &s.relations, &s.settings, NULL, &s.depth, NULL, NULL) == CELD_OK);
  s.settings.tolerance = 1e-6f;
  CHECK (celd_program_solve (p, &s.relations, &s.settings, NULL, &s.depth, &s.exact, NULL) == CELD_OK);
  CHECK (s.exact.solve.converged && s.exact.solve.error <= 1e-6);
  celd_program_free (p);
  scene_free (&s);
}

static void
a_cancelled_edit_can_be_made_again (void)
{
  Scene        s = scene_new (rows, "#010000 > #040000");
  float        value[6 * 23];
  CeldPlane    depth = { 23, 6, 23, value };
  CeldProgram *p = celd_program_new ();
  CeldExact    exact = { 0 };
  int          left = 0, reports = 0;
  CeldHost     host = { check_count_down, NULL, &left };

  CHECK (celd_program_set_ink (p, &s.ink, &s.settings, NULL) == CELD_OK);
  CHECK (celd_program_set_seeds (p, &s.seeds, &s.palette, s.settings.same_colour, NULL) == CELD_OK);
  CHECK (celd_program_solve (p, &s.relations, &s.settings, NULL, &depth, &exact, NULL) == CELD_OK);
  scene_relate (&s, "#010000 > #040000; 0,5 > 3,3; 22,0 > 22,5; 8,0 > #020000");
  while (celd_program_solve (p, &s.relations, &s.settings, &host, &depth, &exact, NULL) == CELD_CANCELLED)
    left = ++reports;
  CHECK (reports > 1);
  check_fresh (&s, &exact, &depth);
  celd_exact_clear (&exact);
  celd_program_free (p);
  scene_free (&s);
}

int
main (void)
{
  RUN (edits_answer_as_a_new_program);
  RUN (relations_change_no_basis);
  RUN (a_tighter_tolerance_is_kept);
  RUN (a_cancelled_edit_can_be_made_again);
  return DONE;
}
