/* Places where arrows that share ends may begin or end.
 *
 * The ends of traced lines are led on straight: where several meet, and at the tips of heads that fit there, arrows
 * may end (search-votes.c).  Others may at free ends of the paint and where else it is round, at corners
 * (search-turns.c), behind wide places, and where there is a dot; those that fade or taper also where lines get
 * stronger at once, and where they are divided.  Too many places do no harm but take time; of places near each other
 * the first is kept.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define PLACE_APART   0.9  /* between places, at least */
#define PLACE_ROUGH   1.2  /* length of a rough edge, and a pixel */
#define STUB          1.8  /* length of a line that has a direction */
#define PLACE_FAR_END 4.5  /* from the end of a line to where its direction is measured, at most */
#define FAT           0.6  /* distance from the edge of the paint inside a filled head */
#define PLACE_WIDE    0.75 /* distance from the edge at a wide place, ... */
#define NARROW        0.5  /* ... and behind it */
#define PLACE_BLOB    0.66 /* distance from the edge in the middle of a dot */
#define JUMP          0.3  /* by which strength changes at once, ... */
#define JUMP_FROM     0.5  /* ... from so far on one side to the other, ... */
#define JUMP_TO       1.5  /* ... where that is the mean from there up to here */
#define MOST_ARMS     600  /* ends of lines that are led on: more are a drawing */

typedef struct
{
  CeldArrowSearch *s;
  CeldStrokeGraph  raw;
  int             *degree; /* of each node */
  CeldStrokeArm   *arm;
  size_t           n_arms, arm_capacity;
} PlaceBuild;

static CeldStatus
add_place (PlaceBuild *b, CeldPoint p)
{
  CeldArrowSearch *s = b->s;

  if (!(p.x >= 0 && p.y >= 0 && p.x < s->mask->width && p.y < s->mask->height))
    return CELD_OK;
  for (size_t i = 0; i < s->n_places; i++)
    if (celd_points_apart (s->place[i], p) < PLACE_APART * s->width)
      return CELD_OK;
  return celd_append (s->place, s->n_places, s->place_capacity, p);
}

/* ------------------------------------------------------------------ ends of lines */

static CeldPoint
point_from (const CeldStrokeLine *line, int end, size_t i)
{
  return line->at[end ? line->n - 1 - i : i];
}

static CeldStatus
find_arms (PlaceBuild *b)
{
  double     w = b->s->width;
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < 2 * b->raw.n_lines && b->n_arms < MOST_ARMS && status == CELD_OK; i++)
    {
      const CeldStrokeLine *line = &b->raw.line[i / 2];
      int                   end = (int) (i % 2);
      double                length = celd_stroke_line_length (line), d;
      CeldPoint             p, q;

      b->degree[line->node[end]]++;
      if (length < STUB * w)
        continue;
      p = point_from (line, end, (size_t) fmin (CELD_ARM_BEGIN * w, 0.25 * (double) line->n));
      q = point_from (line, end, (size_t) fmin (PLACE_FAR_END * w + 2, 0.8 * (double) line->n));
      d = celd_points_apart (p, q);
      if (d >= 0.7 * w)
        status = celd_append (b->arm, b->n_arms, b->arm_capacity,
                              ((CeldStrokeArm) { p, { (p.x - q.x) / d, (p.y - q.y) / d }, length, i / 2, end }));
    }
  return status;
}

/* The only line but rough edges that ends where an end of line k is, too; SIZE_MAX = there is none, or there are
 * several.  *free: is there nothing but rough edges? */
static size_t
line_beyond (const PlaceBuild *b, size_t k, int end, bool *free)
{
  int    node = b->raw.line[k].node[end];
  size_t other = SIZE_MAX;
  int    n = 0;

  for (size_t i = 0; i < 2 * b->raw.n_lines; i++)
    {
      const CeldStrokeLine *line = &b->raw.line[i / 2];

      if (i / 2 == k || line->node[i % 2] != node ||
          (celd_stroke_line_length (line) <= PLACE_ROUGH * b->s->width + 1 && b->degree[line->node[1 - i % 2]] == 1))
        continue;
      other = i / 2;
      n++;
    }
  *free = !n;
  return n == 1 ? other : SIZE_MAX;
}

/* Does a line end freely, but for rough edges?  *length: of it and of the line beyond, if just one is there. */
static bool
is_free (const PlaceBuild *b, const CeldStrokeArm *arm, double *length)
{
  bool   free, free_beyond;
  size_t beyond;

  line_beyond (b, arm->line, arm->end, &free);
  beyond  = line_beyond (b, arm->line, 1 - arm->end, &free_beyond);
  *length = arm->length + (beyond == SIZE_MAX ? 0 : celd_stroke_line_length (&b->raw.line[beyond]));
  return free;
}

/* How far a line that is led on is painted, in steps from a distance on, up to a most. */
static double
painted_up_to (const CeldArrowSearch *s, const CeldStrokeArm *arm, double from, double step, double most)
{
  double d = from;

  while (d < most && celd_search_room (s, celd_moved (arm->at, arm->way, d)) > 0)
    d += step;
  return d;
}

/* Does the paint of a short line go on straight beyond its other end?  Then it crosses something there. */
static bool
goes_on (const PlaceBuild *b, const CeldStrokeArm *arm)
{
  double w = b->s->width;

  if (b->degree[b->raw.line[arm->line].node[1 - arm->end]] == 1)
    return true;
  for (size_t i = 0; i < b->n_arms; i++)
    if (b->arm[i].line == arm->line && b->arm[i].end != arm->end)
      return painted_up_to (b->s, &b->arm[i], 0, 0.5 * w, 4 * w) >= 4 * w;
  return false;
}

static CeldStatus
add_free_ends (PlaceBuild *b)
{
  double     w = b->s->width;
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < b->n_arms && status == CELD_OK; i++)
    {
      const CeldStrokeArm *arm = &b->arm[i];
      CeldPoint            node = b->raw.node[b->raw.line[arm->line].node[arm->end]].at;
      bool                 fat = b->s->style == CELD_ARROW_HEAD && celd_search_room (b->s, node) > FAT * w;
      double               length, last;

      if (!is_free (b, arm, &length) || (length < CELD_ARM_LONG * w && !fat && !goes_on (b, arm)))
        continue;
      last   = painted_up_to (b->s, arm, 1, 1, INFINITY) - 1;
      status = add_place (b, celd_moved (arm->at, arm->way, fmax (0, last - 0.5 * w)));
    }
  return status;
}

static CeldStatus
add_meetings (PlaceBuild *b)
{
  CeldPoint *place;
  size_t     n;
  CeldStatus status = celd_search_votes_count (b->s, b->arm, b->n_arms, &place, &n);

  for (size_t i = 0; i < n && status == CELD_OK; i++)
    status = add_place (b, place[i]);
  celd_free (place);
  return status;
}

/* The round ends, or the corners, of all lines. */
static CeldStatus
add_turns (PlaceBuild *b, CeldTurnKind kind)
{
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < b->raw.n_lines && status == CELD_OK; k++)
    {
      CeldPoint *place;
      size_t     n;

      status = celd_search_turns_list (b->s, &b->raw.line[k], kind, &place, &n);
      for (size_t i = 0; i < n && status == CELD_OK; i++)
        status = add_place (b, place[i]);
      celd_free (place);
    }
  return status;
}

/* ------------------------------------------------------------------ along lines */

/* Behind the wide places that lines lead to: the tips of filled heads from which others go on. */
static CeldStatus
add_narrows (PlaceBuild *b)
{
  double     w = b->s->width;
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < b->n_arms && status == CELD_OK; i++)
    {
      const CeldStrokeArm *arm = &b->arm[i];
      CeldPoint            across = { -0.25 * arm->way.y, 0.25 * arm->way.x };
      double               most = 0;

      for (double d = 0; d < CELD_ARM_LED * w && arm->length > 4.5 * w; d += 0.1 * w)
        {
          CeldPoint p = celd_moved (arm->at, arm->way, d);
          double    room = 0;

          for (int k = -2; k <= 2; k++)
            room = fmax (room, celd_search_room (b->s, celd_moved (p, across, k * w)));
          most = fmax (most, room);
          if (most > PLACE_WIDE * w && room <= NARROW * w)
            status = add_place (b, p);
          if ((most > PLACE_WIDE * w && room <= NARROW * w) || room <= 0)
            break;
        }
    }
  return status;
}

/* The middles of wide places of a line. */
static CeldStatus
add_blobs (PlaceBuild *b, const CeldStrokeLine *line)
{
  size_t     reach = (size_t) (1.5 * b->s->width + 1);
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < line->n && status == CELD_OK; i++)
    {
      double room = celd_search_room (b->s, line->at[i]);
      bool   most = room >= PLACE_BLOB * b->s->width;

      for (size_t k = i > reach ? i - reach : 0; k <= i + reach && k < line->n && most; k++)
        {
          double other = celd_search_room (b->s, line->at[k]);

          most = other < room || (other <= room && k >= i);
        }
      if (most)
        status = add_place (b, line->at[i]);
    }
  return status;
}

/* ------------------------------------------------------------------ of arrows that fade or taper */

/* By how much stronger a line is behind a point than before it. */
static double
jump_at (const PlaceBuild *b, const CeldStrokeLine *line, size_t i)
{
  size_t from = (size_t) ceil (JUMP_FROM * b->s->width), to = (size_t) ceil (JUMP_TO * b->s->width);
  double sum = 0;

  for (size_t k = from; k <= to; k++)
    sum += celd_search_strength (b->s, line->at[i + k]) - celd_search_strength (b->s, line->at[i - k]);
  return sum / (double) (to - from + 1);
}

/* Where lines get stronger or weaker at once: half a width from there the stronger arrow ends, whose end is round. */
static CeldStatus
add_jumps (PlaceBuild *b, const CeldStrokeLine *line)
{
  size_t     reach = (size_t) ceil (JUMP_TO * b->s->width), off = (size_t) (0.5 * b->s->width);
  double    *jump = celd_alloc0 (line->n, sizeof *jump);
  CeldStatus status = jump ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = reach; i + reach < line->n && jump; i++)
    jump[i] = jump_at (b, line, i);
  for (size_t i = reach; i + reach < line->n && status == CELD_OK; i++)
    {
      bool most = fabs (jump[i]) > JUMP;

      for (size_t k = i - reach; k <= i + reach && most; k++)
        most = fabs (jump[k]) < fabs (jump[i]) || (fabs (jump[k]) <= fabs (jump[i]) && k >= i);
      if (most)
        status = add_place (b, line->at[jump[i] > 0 ? i + off : i - off]);
    }
  celd_free (jump);
  return status;
}

/* The jumps, and the ends of the lines that are divided where two arrows meet. */
static CeldStatus
add_changes (PlaceBuild *b)
{
  const CeldJoinedLines *lines = b->s->lines;
  CeldStatus             status = CELD_OK;

  for (size_t k = 0; k < b->raw.n_lines && status == CELD_OK; k++)
    status = add_jumps (b, &b->raw.line[k]);
  for (size_t i = 0; i < 2 * lines->graph.n_lines && status == CELD_OK; i++)
    {
      CeldPoint place;

      celd_joined_place (lines, i, &place);
      status = add_place (b, place);
    }
  return status;
}

/* ------------------------------------------------------------------ all places */

static CeldStatus
find_places (PlaceBuild *b)
{
  CeldStatus status = find_arms (b);

  for (size_t k = 0; k < b->raw.n_lines && status == CELD_OK && b->s->style == CELD_ARROW_DOT; k++)
    status = add_blobs (b, &b->raw.line[k]);
  if (status == CELD_OK)
    status = add_meetings (b);
  if (status == CELD_OK)
    status = add_free_ends (b);
  if (status == CELD_OK && !celd_search_has_profiles (b->s))
    status = add_turns (b, CELD_TURN_ROUND);
  if (status == CELD_OK && celd_search_has_profiles (b->s))
    status = add_changes (b);
  if (status == CELD_OK && b->s->style == CELD_ARROW_HEAD)
    status = add_narrows (b);
  if (status == CELD_OK)
    status = add_turns (b, CELD_TURN_CORNER);
  return status;
}

CeldStatus
celd_search_places_find (CeldArrowSearch *search)
{
  PlaceBuild      b = { .s = search };
  CeldStatus status = celd_stroke_trace (search->mask, &b.raw);

  if (status == CELD_OK && !(b.degree = celd_alloc0 (b.raw.n_nodes + 1, sizeof *b.degree)))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = find_places (&b);
  search->n_undivided = search->n_places;
  celd_free (b.degree);
  celd_free (b.arm);
  celd_stroke_graph_clear (&b.raw);
  return status;
}
