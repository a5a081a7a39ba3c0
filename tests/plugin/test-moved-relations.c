/* Places in relations are moved, and nothing else.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "moved-relations.h"

#include <glib.h>
#include <locale.h>
#include <string.h>

#include "celdepth.h"

#define MOVED(text, dx, dy, wanted) \
  do { char *moved = celd_relations_moved (text, dx, dy); CHECK (!strcmp (moved, wanted)); g_free (moved); } while (0)

static void
places_are_moved (void)
{
  MOVED ("120,80 > 300,95", 10, -20, "130,60 > 310,75");
  MOVED ("1.5 ,\t2 = -3,.25", 1, 1, "2.5,3 = -2,1.25");
  MOVED ("0.1,0.2", -100, 1000, "-99.9,1000.2");
  MOVED ("1000000,2000000<3.00001,4", 0, 0, "1000000,2000000<3,4");
}

static void
all_else_stays (void)
{
  static const char *const same[] = { "", "\n;\n", "#123456 > #00ff00 @2.5 +3 !crack !anchor", "nonsense, 5", "5,", "-," };

  for (size_t i = 0; i < G_N_ELEMENTS (same); i++)
    MOVED (same[i], 7, 7, same[i]);
  MOVED ("#ff0000 > 1,2 > 3,4 @0.5 +2\r\n 5,6 = #00ff00;7,8<9,9!crack", 1, 2,
         "#ff0000 > 2,4 > 4,6 @0.5 +2\r\n 6,8 = #00ff00;8,10<10,11!crack");
}

/* What core reads of it, in a locale with decimal commas, too. */
static void
the_grammar_is_kept (void)
{
  CeldRelations relations = { 0 };
  char         *moved = celd_relations_moved ("12.25,80 > 300,95.5 = #ff0000 @ 2; 1,1 < 50.00001,2", -50, 0.5);

  CHECK (celd_relations_parse (moved, &relations, NULL) == CELD_OK);
  NEAR (relations.n, 3, 0);
  NEAR (relations.item[0].nearer.x, -37.75, 1e-9);
  NEAR (relations.item[0].nearer.y, 80.5, 1e-9);
  NEAR (relations.item[1].nearer.y, 96, 1e-9);
  CHECK (relations.item[1].equal && relations.item[1].farther.by_colour);
  NEAR (relations.item[1].weight, 2, 0);
  NEAR (relations.item[2].nearer.x, 0, 1e-4);
  NEAR (relations.item[2].farther.x, -49, 1e-9);
  celd_relations_clear (&relations);
  g_free (moved);
}

int
main (void)
{
  setlocale (LC_ALL, "de_DE.UTF-8");
  RUN (places_are_moved);
  RUN (all_else_stays);
  RUN (the_grammar_is_kept);
  return DONE;
}
