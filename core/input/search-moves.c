/* The choice of arrows that costs least, by changing a choice step by step.
 *
 * A change takes some arrows away, bans them and what is like them, adds what then pays most, and is kept if all
 * costs less.  It begins once with nothing, and once with arrows between all places that are next to each other, which
 * are too many: it is easier to find that two arrows are one than that one is two.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

/* All chosen; lengths are widths of the paint. */
#define MOVE_ROUNDS     20 /* of changes, at most */
#define TOUCH_ENDS      4  /* between ends of arrows that touch, at most, ... */
#define TOUCH_LINES     2  /* ... and between their lines */
#define MOVE_SAME_PLACE 2  /* between places that are one */
#define MOVE_SMALLER    1e-6

/* What is banned with an option: itself, all along its shaft, or all between the places of its ends. */
typedef enum { BAN_OPTION, BAN_SHAFT, BAN_LIKE } Ban;

bool
celd_options_alike (const CeldArrowSearch *s, size_t a, size_t b)
{
  const CeldArrowOption *o = &s->option[a], *q = &s->option[b];
  double                 most = CELD_NEAR_ENDS * s->width + 1;

  return celd_points_apart (celd_option_place (s, o, true), celd_option_place (s, q, true)) < most &&
         celd_points_apart (celd_option_place (s, o, false), celd_option_place (s, q, false)) < most;
}

/* The same in either direction. */
static bool
between_same (const CeldArrowSearch *s, size_t a, size_t b)
{
  const CeldArrowOption *o = &s->option[a], *q = &s->option[b];
  double                 most = CELD_NEAR_ENDS * s->width + 1;

  return celd_options_alike (s, a, b) ||
         (celd_points_apart (celd_option_place (s, o, true), celd_option_place (s, q, false)) < most &&
          celd_points_apart (celd_option_place (s, o, false), celd_option_place (s, q, true)) < most);
}

static void
ban (CeldArrowSearch *s, size_t option, Ban kind, bool on)
{
  for (size_t k = 0; k < s->n_options; k++)
    if (kind == BAN_OPTION ? k == option
        : kind == BAN_SHAFT ? s->option[k].shaft == s->option[option].shaft : between_same (s, k, option))
      s->banned[k] = (uint16_t) (s->banned[k] + (on ? 1 : -1));
}

static bool
touch (const CeldArrowSearch *s, size_t a, size_t b)
{
  const CeldShaft *p = &s->shaft[s->option[a].shaft], *q = &s->shaft[s->option[b].shaft];

  for (int i = 0; i < 4; i++)
    if (celd_points_apart (s->place[p->place[i / 2]], s->place[q->place[i % 2]]) < TOUCH_ENDS * s->width)
      return true;
  for (size_t i = 0; i < p->n; i++)
    for (size_t k = 0; k < q->n; k++)
      if (celd_points_apart (p->at[i], q->at[k]) < TOUCH_LINES * s->width)
        return true;
  return false;
}

/* Keeps the choice if it costs less than one before. */
static bool
keep_if_less (CeldArrowSearch *s, const CeldArrowChoice *before)
{
  if (s->choice.cost < before->cost - MOVE_SMALLER)
    return true;
  celd_search_restore (s, before);
  return false;
}

/* Takes one or two options away, and adds up to `most` others. */
static bool
replace (CeldArrowSearch *s, const size_t *option, int n, Ban kind, size_t most)
{
  CeldArrowChoice before = s->choice;

  for (int i = 0; i < n; i++)
    celd_search_leave (s, option[i]);
  for (int i = 0; i < n; i++)
    ban (s, option[i], kind, true);
  celd_search_add (s, most);
  for (int i = 0; i < n; i++)
    ban (s, option[i], kind, false);
  celd_search_add (s, 1);
  return keep_if_less (s, &before);
}

/* Does an option end at a place, or pass it? */
static bool
is_concerned (const CeldArrowSearch *s, size_t option, size_t place, bool drop)
{
  const CeldShaft *shaft = &s->shaft[s->option[option].shaft];
  double           most = MOVE_SAME_PLACE * s->width;

  return drop ? celd_points_apart (s->place[shaft->place[0]], s->place[place]) < most ||
                celd_points_apart (s->place[shaft->place[1]], s->place[place]) < most
              : celd_shaft_passes (s, s->option[option].shaft, place);
}

bool
celd_search_force (CeldArrowSearch *s, size_t place, bool drop)
{
  size_t n = s->choice.n;

  for (size_t i = n; i-- > 0;)
    if (is_concerned (s, s->choice.item[i], place, drop))
      celd_search_leave (s, s->choice.item[i]);
  if (s->choice.n == n)
    return false;
  for (int on = 1; on >= 0; on--)
    {
      for (size_t k = 0; k < s->n_options; k++)
        if (is_concerned (s, k, place, drop))
          s->banned[k] = (uint16_t) (s->banned[k] + (on ? 1 : -1));
      celd_search_add (s, on ? 12 : 2);
    }
  return true;
}

/* ------------------------------------------------------------------ rounds of changes */

static bool
improve_one (CeldArrowSearch *s, size_t option)
{
  bool better = false;

  for (int kind = BAN_OPTION; kind <= BAN_LIKE && s->chosen[option]; kind++)
    better |= replace (s, &option, 1, (Ban) kind, kind == BAN_OPTION ? 2 : 4);
  return better;
}

static void
improve_two (CeldArrowSearch *s, size_t a, size_t b)
{
  for (int kind = BAN_OPTION; kind <= BAN_LIKE && s->chosen[a] && s->chosen[b]; kind += BAN_LIKE)
    replace (s, (size_t[]) { a, b }, 2, (Ban) kind, 5);
}

static void
improve_place (CeldArrowSearch *s, size_t place)
{
  for (int drop = 0; drop < 2; drop++)
    {
      CeldArrowChoice before = s->choice;

      if ((!drop || s->arrows_at[place]) && celd_search_force (s, place, drop))
        keep_if_less (s, &before);
    }
}

/* Does an option touch one that is in just one of two choices? */
static bool
touches_change (const CeldArrowSearch *s, size_t option, const CeldArrowChoice *a, const CeldArrowChoice *b)
{
  for (int side = 0; side < 2; side++)
    {
      const CeldArrowChoice *one = side ? b : a, *other = side ? a : b;

      for (size_t i = 0; i < one->n; i++)
        {
          bool both = false;

          for (size_t k = 0; k < other->n && !both; k++)
            both = one->item[i] == other->item[k];
          if (!both && touch (s, one->item[i], option))
            return true;
        }
    }
  return false;
}

/* Is a place near an option that is tried? */
static bool
is_near_tried (const CeldArrowSearch *s, size_t place, const CeldArrowChoice *list, const bool *tried)
{
  for (size_t i = 0; i < list->n; i++)
    {
      const CeldShaft *shaft = &s->shaft[s->option[list->item[i]].shaft];

      if (tried[i] && (celd_shaft_passes (s, s->option[list->item[i]].shaft, place) ||
                       celd_points_apart (s->place[shaft->place[0]], s->place[place]) < TOUCH_ENDS * s->width ||
                       celd_points_apart (s->place[shaft->place[1]], s->place[place]) < TOUCH_ENDS * s->width))
        return true;
    }
  return false;
}

/* One round of changes of the options of a list that are tried. */
static void
improve_all (CeldArrowSearch *s, const CeldArrowChoice *list, const bool *tried)
{
  for (size_t i = 0; i < list->n; i++)
    if (tried[i] && s->chosen[list->item[i]])
      improve_one (s, list->item[i]);
  for (size_t i = 0; i < list->n; i++)
    for (size_t k = 0; k < i; k++)
      if ((tried[i] || tried[k]) && s->chosen[list->item[i]] && s->chosen[list->item[k]] &&
          touch (s, list->item[i], list->item[k]))
        improve_two (s, list->item[i], list->item[k]);
  for (size_t p = 0; p < s->n_undivided; p++)
    if (is_near_tried (s, p, list, tried))
      improve_place (s, p);
}

/* After the first round only what is near changes is tried again. */
static void
improve (CeldArrowSearch *s)
{
  CeldArrowChoice before = { .n = 0 };
  bool            tried[CELD_MOST_CHOSEN], any = true;

  for (int round = 0; round < MOVE_ROUNDS && any; round++)
    {
      CeldArrowChoice list = s->choice;

      any = false;
      for (size_t i = 0; i < list.n; i++)
        {
          tried[i] = !round || touches_change (s, list.item[i], &before, &list);
          any |= tried[i];
        }
      improve_all (s, &list, tried);
      before = list;
    }
}

void
celd_search_improve_near (CeldArrowSearch *s, size_t option)
{
  bool better = true;

  for (int round = 0; round < MOVE_ROUNDS && better; round++)
    {
      CeldArrowChoice list = s->choice;

      better = false;
      for (size_t i = 0; i < list.n; i++)
        better |= s->chosen[list.item[i]] && touch (s, list.item[i], option) && improve_one (s, list.item[i]);
    }
}

/* ------------------------------------------------------------------ the best choice */

/* Chooses arrows only between places that are apart and next to each other, and then improves that. */
static CeldStatus
begin_divided (CeldArrowSearch *s)
{
  bool *apart = celd_alloc0 (s->n_places + 1, sizeof *apart), *far = celd_alloc0 (s->n_options + 1, sizeof *far);

  if (apart && far)
    {
      for (size_t p = 0; p < s->n_undivided; p++)
        {
          apart[p] = true;
          for (size_t q = 0; q < p; q++)
            if (apart[q] && celd_points_apart (s->place[p], s->place[q]) < MOVE_SAME_PLACE * s->width)
              apart[p] = false;
        }
      for (size_t k = 0; k < s->n_options; k++)
        {
          const CeldShaft *shaft = &s->shaft[s->option[k].shaft];

          far[k] = !apart[shaft->place[0]] || !apart[shaft->place[1]];
          for (size_t p = 0; p < s->n_undivided; p++)
            far[k] |= apart[p] && celd_shaft_passes (s, s->option[k].shaft, p);
          s->banned[k] = (uint16_t) (s->banned[k] + far[k]);
        }
      celd_search_add (s, CELD_MOST_CHOSEN);
      for (size_t k = 0; k < s->n_options; k++)
        s->banned[k] = (uint16_t) (s->banned[k] - far[k]);
    }
  celd_free (apart);
  celd_free (far);
  return apart && far ? CELD_OK : CELD_NO_MEMORY;
}

/* The best choice of options that are not banned. */
static CeldStatus
find_best (CeldArrowSearch *s)
{
  CeldArrowChoice nothing = s->choice, first;
  CeldStatus      status;

  celd_search_add (s, CELD_MOST_CHOSEN);
  improve (s);
  first = s->choice;
  celd_search_restore (s, &nothing);
  status = begin_divided (s);
  if (status != CELD_OK)
    return status;
  celd_search_add (s, CELD_MOST_CHOSEN);
  improve (s);
  if (s->choice.cost > first.cost)
    celd_search_restore (s, &first);
  return CELD_OK;
}

/* Bans options with filled or with open heads. */
static void
ban_heads (CeldArrowSearch *s, bool filled, bool on)
{
  for (size_t k = 0; k < s->n_options; k++)
    if (s->option[k].filled == filled)
      s->banned[k] = (uint16_t) (s->banned[k] + (on ? 1 : -1));
}

/* Finds the best choice of arrows with heads of one kind. */
static CeldStatus
find_best_heads (CeldArrowSearch *s)
{
  CeldArrowChoice nothing = s->choice, open;
  CeldStatus      status;

  ban_heads (s, true, true);
  status = find_best (s);
  if (status != CELD_OK)
    return status;
  open = s->choice;
  celd_search_restore (s, &nothing);
  ban_heads (s, true, false);
  ban_heads (s, false, true);
  status = find_best (s);
  if (status != CELD_OK || s->choice.cost <= open.cost)
    return status;
  celd_search_restore (s, &open);
  ban_heads (s, false, false);
  ban_heads (s, true, true);
  return CELD_OK;
}

/* Bans the parts of divided shafts, or lets those be chosen whose whole is. */
static void
ban_parts (CeldArrowSearch *s, bool on)
{
  for (size_t k = 0; k < s->n_options; k++)
    {
      size_t whole = s->shaft[s->option[k].shaft].whole;

      if (whole != CELD_NO_SHAFT && (on || s->uses[whole]))
        s->banned[k] = (uint16_t) (s->banned[k] + (on ? 1 : -1));
    }
}

/* Divides chosen shafts where that costs less. */
static void
divide_chosen (CeldArrowSearch *s)
{
  CeldArrowChoice whole = s->choice;

  ban_parts (s, false);
  for (size_t i = 0; i < whole.n; i++)
    for (size_t k = 0; k < s->n_shafts && s->chosen[whole.item[i]]; k++)
      if (s->shaft[k].whole == s->option[whole.item[i]].shaft)
        {
          celd_search_improve_near (s, whole.item[i]);
          break;
        }
}

CeldStatus
celd_search_best (CeldArrowSearch *s)
{
  CeldStatus status;

  if (s->style != CELD_ARROW_HEAD)
    return find_best (s);
  ban_parts (s, true);
  status = find_best_heads (s);
  if (status == CELD_OK)
    divide_chosen (s);
  return status;
}
