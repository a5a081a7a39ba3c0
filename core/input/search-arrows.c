/* Reads arrows with heads or dots that share ends: the choice of shafts and heads that explains their paint best.
 *
 * Places where arrows may begin or end (search-places.c) are joined by shafts inside the paint (search-shafts.c),
 * each with heads that fit at either end (search-heads.c); a line with two heads may be two arrows that begin on it
 * (search-divisions.c).  Of these arrows those are chosen that together leave least paint unexplained
 * (search-cover.c, search-choice.c, search-moves.c).  Of those the clear ones are read (search-clear.c).
 *
 * Cost: for a page of 1000 x 1000 pixels with 20 arrows a fraction of a second.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>

#define MOST_PLACES   120  /* of connected paint; more are a drawing; ... */
#define MOST_SHAFTS   1200 /* ... so are more of these: the search would take seconds; chosen */
#define LED_FROM      4.5  /* widths from the end of a line from where it is led on straight to others, ... */
#define LED_TO        1.5  /* ... through the point so far from there; chosen */
#define LED_REACH     2    /* widths between ends of lines that are led on to one place; chosen */
#define LED_NEAR      0.5  /* widths up to which that place is a better one for arrows with heads, ... */
#define LED_APART     1    /* ... and beyond which nobody can tell which of both is right; measured */
#define MOST_LED_FROM 0.6  /* of the length of a line; chosen */

static void
search_clear (CeldArrowSearch *s)
{
  for (size_t k = 0; k < s->n_shafts; k++)
    celd_free (s->shaft[k].at);
  for (size_t k = 0; k < s->n_pieces; k++)
    celd_free (s->piece[k].cell);
  celd_free (s->room);
  celd_free (s->place);
  celd_free (s->shaft);
  celd_free (s->painted);
  celd_free (s->covers);
  celd_free (s->stamp);
  celd_free (s->first);
  celd_free (s->piece_at);
  celd_free (s->piece);
  celd_free (s->bare);
  celd_free (s->option);
  celd_free (s->chosen);
  celd_free (s->banned);
  celd_free (s->passes);
  celd_free (s->arrows_at);
  celd_free (s->place_cost);
  celd_free (s->passed);
  celd_free (s->uses);
}

static CeldStatus
find_room (CeldArrowSearch *s)
{
  size_t n = (size_t) s->mask->width * (size_t) s->mask->height;

  s->room = celd_alloc (n, sizeof *s->room);
  for (size_t i = 0; i < n && s->room; i++)
    s->room[i] = s->mask->painted[i] ? (float) (sqrt (s->mask->squared[i]) - 0.5) : 0;
  return s->room ? CELD_OK : CELD_NO_MEMORY;
}

/* Finds places and shafts; *many: there are too many for a search. */
static CeldStatus
find_shafts (CeldArrowSearch *s, bool *many)
{
  CeldStatus status = find_room (s);

  if (status == CELD_OK)
    status = celd_search_cells_new (s);
  if (status == CELD_OK)
    status = celd_search_places_find (s);
  *many = s->n_places > MOST_PLACES;
  if (status == CELD_OK && !*many)
    status = celd_search_shafts_find (s);
  *many = *many || s->n_shafts > MOST_SHAFTS;
  return status;
}

static CeldStatus
find_choice (CeldArrowSearch *s, double *margin)
{
  CeldStatus status = celd_search_options_new (s);

  if (status == CELD_OK && s->style == CELD_ARROW_HEAD)
    status = celd_search_divisions_add (s);
  if (status == CELD_OK)
    status = celd_search_pieces_index (s);
  if (status == CELD_OK)
    status = celd_search_choice_new (s);
  if (status == CELD_OK)
    status = celd_search_best (s);
  if (status == CELD_OK)
    celd_search_margins_find (s, margin);
  return status;
}

/* ------------------------------------------------------------------ arrows as lines */

/* Makes the line of a shaft, point by point. */
static CeldStatus
line_of (const CeldShaft *shaft, CeldStrokeLine *line)
{
  CeldStatus status = celd_stroke_line_append (line, shaft->at[0]);

  for (size_t i = 1; i < shaft->n && status == CELD_OK; i++)
    status = celd_stroke_line_append (line, shaft->at[i]);
  return status;
}

/* The point of a shaft at a distance from one of its ends. */
static CeldPoint
point_of (const CeldShaft *shaft, int end, double distance)
{
  double i = fmin (distance / shaft->length, MOST_LED_FROM) * (double) (shaft->n - 1);
  double at = end ? (double) (shaft->n - 1) - i : i;
  size_t k = (size_t) at;

  return celd_search_between (shaft->at[k], shaft->at[k + 1 < shaft->n ? k + 1 : k], at - (double) k);
}

/* The place where lines meet that end at a place or next to it, led on straight; the place itself if that is far, or,
 * where heads may hide how lines go on, not near.  *apart: widths between both; 0 = they are too far from each other. */
static CeldPoint
meeting_at (const CeldArrowSearch *s, CeldPoint place, double *apart)
{
  CeldLineSums sums = { 0 };
  CeldPoint    meeting;

  for (size_t k = 0; k < s->choice.n; k++)
    for (int end = 0; end < 2; end++)
      {
        const CeldShaft *shaft = celd_chosen_shaft (s, k);

        if (celd_points_apart (s->place[shaft->place[end]], place) < LED_REACH * s->width)
          {
            CeldPoint p = point_of (shaft, end, LED_TO * s->width), q = point_of (shaft, end, LED_FROM * s->width);
            double    d = celd_points_apart (p, q);

            celd_line_sums_add (&sums, p, (CeldPoint) { (p.x - q.x) / d, (p.y - q.y) / d }, 1);
          }
      }
  meeting = celd_line_sums_point (&sums, place);
  *apart  = celd_points_apart (meeting, place) / s->width;
  if (*apart >= LED_REACH)
    *apart = 0;
  return *apart > 0 && *apart < (s->style == CELD_ARROW_HEAD ? LED_NEAR : LED_REACH) ? meeting : place;
}

/* Makes the chosen arrows the lines of a graph. */
static CeldStatus
make_lines (const CeldArrowSearch *s, const CeldArrowReason *unclear, CeldStrokeGraph *graph, CeldLineArrow *arrows)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < s->choice.n && status == CELD_OK; i++)
    {
      const CeldArrowOption *o = &s->option[s->choice.item[i]];
      const size_t          *place = s->shaft[o->shaft].place;
      CeldStrokeLine         line = { .node = { (int) place[0], (int) place[1] } };
      double                 nearer_apart, farther_apart;

      status = line_of (&s->shaft[o->shaft], &line);
      if (status == CELD_OK)
        status = celd_append (graph->line, graph->n_lines, graph->capacity, line);
      if (status != CELD_OK)
        celd_free (line.at);
      arrows[i] = (CeldLineArrow) {
        .nearer  = meeting_at (s, celd_option_place (s, o, s->style == CELD_ARROW_DOT), &nearer_apart),
        .farther = meeting_at (s, celd_option_place (s, o, s->style != CELD_ARROW_DOT), &farther_apart),
        .unclear = unclear[i], .first = i,
      };
      if (!arrows[i].unclear && s->style == CELD_ARROW_HEAD && fmax (nearer_apart, farther_apart) > LED_APART)
        arrows[i].unclear = CELD_REASON_MEETING;
    }
  return status;
}

/* Reads the arrows of shafts. */
static CeldStatus
read_choice (CeldArrowSearch *s, const CeldJoinedLines *lines, CeldLineArrow *other, CeldStrokeGraph *graph,
             CeldLineArrow *arrows)
{
  double          margin[CELD_MOST_CHOSEN];
  CeldArrowReason unclear[CELD_MOST_CHOSEN];
  CeldStatus      status = find_choice (s, margin);

  if (status == CELD_OK)
    status = celd_search_clear_find (s, lines, other, margin, unclear);
  return status == CELD_OK ? make_lines (s, unclear, graph, arrows) : status;
}

CeldStatus
celd_search_arrows_read (const CeldJoinedLines *lines, const CeldArrowLayer *layer, CeldLineArrow *other,
                         CeldStrokeGraph *graph, CeldLineArrow **arrows)
{
  CeldArrowSearch s = {
    .lines = lines,
    .layer = layer,
    .mask  = &lines->mask,
    .width = lines->graph.width,
    .style = lines->style,
  };
  bool            many = false;
  CeldStatus      status = find_shafts (&s, &many);

  *arrows = NULL;
  *graph  = (CeldStrokeGraph) { .width = lines->graph.width };
  if (status == CELD_OK && !many)
    {
      *arrows = celd_alloc0 (CELD_MOST_CHOSEN, sizeof **arrows);
      status  = *arrows ? read_choice (&s, lines, other, graph, *arrows) : CELD_NO_MEMORY;
    }
  search_clear (&s);
  return status;
}
