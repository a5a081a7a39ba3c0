/* Arrows of one colour that share ends: several from one point, several to one point, or one behind the other.
 *
 * The paint is a graph of lines (stroke-graph.c), of which each may be an arrow: joined-heads.c reads those with heads
 * or dots, joined-profiles.c those that fade or taper.  Two lines that meet and go straight on may be one arrow that
 * passes there.  They are read only if both begin or both end there, or if the head is clear between them.
 *
 * Those with heads or dots are also read by the choice of arrows that explains all their paint best (search-arrows.c).
 * That finds more where many meet, the graph where few do, so what finds more clear arrows counts; where they
 * contradict each other, or the search finds an arrow of the graph unclear, nothing is read.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/arrow-search.h"
#include "input/joined-arrows.h"

#include <math.h>

#define MOST_LINES 100 /* of connected paint; more are a drawing, or hatching; chosen */
#define ENDS_ALIKE 2   /* widths, and two pixels, between the same ends of arrows read in two ways; chosen */

static bool
is_long (const CeldJoinedLines *s, size_t line)
{
  return celd_stroke_line_length (&s->graph.line[line]) >= CELD_LEAST_LINE * s->graph.width;
}

/* A point of the mask as one of the picture: where lines are led on to meet may lie somewhat outside. */
static CeldPoint
in_picture (const CeldJoinedLines *s, CeldPoint p)
{
  return (CeldPoint) { fmin (fmax (p.x + s->mask.left, 0.5), s->stroke->width - 0.5),
                       fmin (fmax (p.y + s->mask.top, 0.5), s->stroke->height - 0.5) };
}

/* Is an arrow of a line no longer than a head, of which it may be a barb if the rest is hidden? */
static bool
is_as_short_as_head (const CeldJoinedLines *s, const CeldLineArrow *arrow)
{
  return !arrow->unclear && celd_points_apart (arrow->nearer, arrow->farther) < CELD_HEAD_REACH * s->graph.width;
}

/* ------------------------------------------------------------------ what is found */

/* While arrows of lines are told of.  Of each line: whether its arrow is; of each pixel of the stroke: the line whose
 * arrow it belongs to; pixel: room for those of one arrow. */
typedef struct { bool *told; uint32_t *owner, *pixel; } Telling;

static CeldStatus
telling_new (const CeldJoinedLines *s, const CeldLineArrow *arrows, Telling *t)
{
  *t = (Telling) {
    .told  = celd_alloc0 (s->graph.n_lines, sizeof *t->told),
    .owner = celd_alloc (s->stroke->n, sizeof *t->owner),
    .pixel = celd_alloc (s->stroke->n, sizeof *t->pixel),
  };
  if (!t->told || !t->owner || !t->pixel)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < s->graph.n_lines; k++)
    if (is_long (s, k) && (arrows[k].first == k || arrows[arrows[k].first].unclear))
      t->told[arrows[k].first] = true;
  return celd_joined_paint_divide (s, arrows, t->told, t->owner);
}

static void
telling_clear (Telling *t)
{
  celd_free (t->told);
  celd_free (t->owner);
  celd_free (t->pixel);
}

/* Appends the arrow of a line as a problem in its middle. */
static CeldStatus
add_problem (const CeldJoinedLines *s, size_t k, CeldArrowReason reason, const Telling *t, CeldProblems *problems)
{
  CeldPoint       middle = s->graph.line[k].at[s->graph.line[k].n / 2];
  CeldPoint       at = { middle.x + s->mask.left, middle.y + s->mask.top };
  CeldArrowStroke paint = *s->stroke;

  paint.pixel = t->pixel;
  paint.n     = 0;
  for (size_t i = 0; i < s->stroke->n; i++)
    if (t->owner[i] == k)
      t->pixel[paint.n++] = s->stroke->pixel[i];
  return celd_arrow_problem_add (problems, reason, at, &paint, s->cover);
}

static CeldStatus
add_relation (const CeldJoinedLines *s, const CeldLineArrow *arrow, bool crack, CeldRelations *relations)
{
  CeldPoint nearer = in_picture (s, arrow->nearer), farther = in_picture (s, arrow->farther);

  return celd_relation_add (relations, (CeldRelation) {
    .nearer = { .x = nearer.x, .y = nearer.y }, .farther = { .x = farther.x, .y = farther.y },
    .crack  = crack, .weight = 1, .gap = 1, .source = CELD_SOURCE_ARROW,
  });
}

/* Appends the arrow of each long line, or a problem of those that have one. */
static CeldStatus
tell (const CeldJoinedLines *s, const CeldLineArrow *arrows, bool crack, CeldRelations *relations,
      CeldProblems *problems, CeldProblems *doubts)
{
  Telling    t;
  CeldStatus status = telling_new (s, arrows, &t);

  for (size_t k = 0; k < s->graph.n_lines && status == CELD_OK; k++)
    if (t.told[k] && arrows[k].unclear)
      status = add_problem (s, k, arrows[k].unclear, &t, problems);
    else if (t.told[k])
      {
        status = add_relation (s, &arrows[k], crack, relations);
        if (status == CELD_OK)
          status = add_problem (s, k, CELD_REASON_NONE, &t, doubts);
      }
  telling_clear (&t);
  return status;
}

/* How many arrows are clear, and long enough. */
static size_t
count_clear (const CeldJoinedLines *s, const CeldLineArrow *arrows)
{
  size_t n = 0;

  for (size_t k = 0; k < s->graph.n_lines; k++)
    n += is_long (s, k) && arrows[k].first == k && !arrows[k].unclear;
  return n;
}

/* Makes arrows unclear that are clear in one way, and found in the opposite direction in the other.  Of the lines'
 * arrows with heads also those that the search has found unclear: it sees which paint they leave unexplained.  Round
 * dots there is always some. */
static void
leave_contradictions (const CeldJoinedLines *s, CeldLineArrow *one, const CeldJoinedLines *other, CeldLineArrow *found)
{
  double near = ENDS_ALIKE * s->graph.width + 2;
  bool   head = s->style == CELD_ARROW_HEAD;

  for (size_t i = 0; i < s->graph.n_lines; i++)
    for (size_t k = 0; k < other->graph.n_lines && !one[i].unclear; k++)
      if (celd_points_apart (one[i].nearer, found[k].farther) < near &&
          celd_points_apart (one[i].farther, found[k].nearer) < near)
        one[i].unclear = found[k].unclear = CELD_REASON_MEETING;
      else if (head && celd_points_apart (one[i].nearer, found[k].nearer) < near &&
               celd_points_apart (one[i].farther, found[k].farther) < near)
        one[i].unclear = found[k].unclear;
}

/* Reads lines in both ways, unless others hide some of their paint.  The lines become those of the way that finds more
 * clear arrows, or always those of the search if they fade or taper. */
static CeldStatus
read_both_ways (CeldJoinedLines *s, const CeldArrowLayer *layer, CeldLineArrow **arrows)
{
  bool            profiles = s->style == CELD_ARROW_FADE || s->style == CELD_ARROW_TAPER;
  CeldLineArrow  *found = NULL;
  CeldStatus      status = profiles ? celd_joined_profiles_read (s, layer, arrows) : celd_joined_heads_read (s, arrows);
  CeldJoinedLines other = *s;

  if (status != CELD_OK || s->cover)
    return status;
  status = celd_search_arrows_read (s, layer, *arrows, &other.graph, &found);
  if (status == CELD_OK && found)
    leave_contradictions (s, *arrows, &other, found);
  if (status == CELD_OK && found && (profiles || count_clear (&other, found) > count_clear (s, *arrows)))
    {
      CeldStrokeGraph graph = s->graph;
      CeldLineArrow  *before = *arrows;

      celd_free (s->lead); /* of the graph before */
      s->lead     = NULL;
      s->graph    = other.graph;
      *arrows     = found;
      other.graph = graph;
      found       = before;
    }
  celd_stroke_graph_clear (&other.graph);
  celd_free (found);
  return status;
}

/* Reads all lines.  *n: arrows; fewer than two are none, because a single stroke that is unclear stays so, unless some
 * of its paint is hidden. */
static CeldStatus
read_lines (CeldJoinedLines *s, const CeldArrowLayer *layer, CeldRelations *relations, CeldProblems *problems,
            CeldProblems *doubts, int *n)
{
  bool           crack = celd_arrow_is_blue (s->stroke, layer);
  CeldLineArrow *arrows;
  CeldStatus     status = read_both_ways (s, layer, &arrows);

  for (size_t k = 0; k < s->graph.n_lines && status == CELD_OK && s->hidden; k++)
    if (is_as_short_as_head (s, &arrows[k]))
      arrows[k].unclear = CELD_REASON_SHORT;
  *n = status == CELD_OK ? (int) count_clear (s, arrows) : 0;
  if (*n == 1 && !s->hidden)
    *n = 0;
  if (status == CELD_OK && *n)
    status = tell (s, arrows, crack, relations, problems, doubts);
  celd_free (arrows);
  return status;
}

/* ------------------------------------------------------------------ what is hidden, and where lines meet */

/* Finds the pixels of the mask that have paint of other colours. */
static CeldStatus
find_hidden (CeldJoinedLines *s, const CeldStrokeCover *cover)
{
  const CeldStrokeMask *c = cover->component;

  s->hidden = celd_alloc0 ((size_t) s->mask.width * (size_t) s->mask.height, 1);
  if (!s->hidden)
    return CELD_NO_MEMORY;
  for (int y = 0; y < s->mask.height; y++)
    for (int x = 0; x < s->mask.width; x++)
      {
        int u = x + s->mask.left - c->left, v = y + s->mask.top - c->top;

        s->hidden[(size_t) y * (size_t) s->mask.width + (size_t) x] =
          u >= 0 && v >= 0 && u < c->width && v < c->height && c->painted[(size_t) v * (size_t) c->width + (size_t) u];
      }
  for (size_t i = 0; i < s->stroke->n; i++)
    {
      int x = celd_stroke_x (s->stroke, s->stroke->pixel[i]) - s->mask.left;
      int y = celd_stroke_y (s->stroke, s->stroke->pixel[i]) - s->mask.top;

      s->hidden[(size_t) y * (size_t) s->mask.width + (size_t) x] = !cover->seen[i];
    }
  return CELD_OK;
}

/* Do lines meet, or very many at all, that are no single stroke?  Do some only cross? */
static void
find_branches (const CeldJoinedLines *s, CeldJoinedFound *found)
{
  found->branched = s->graph.n_lines > MOST_LINES;
  for (size_t i = 0; i < 2 * s->graph.n_lines && !found->branched; i++)
    if (celd_joined_lines_at (s, i) > 2)
      {
        bool cross = celd_joined_cross_at (s, i);

        found->crossed |= cross;
        found->branched = !cross;
      }
}

CeldStatus
celd_joined_arrows_read (CeldArrowStroke *stroke, const CeldStrokeCover *cover, const CeldArrowLayer *layer,
                         CeldArrowStyle style, CeldRelations *relations, CeldProblems *problems, CeldProblems *doubts,
                         CeldJoinedFound *found)
{
  CeldJoinedLines s = { .style = style, .stroke = stroke, .cover = cover };
  int             n = 0;
  CeldStatus      status = celd_stroke_mask_new (stroke, &s.mask);

  if (status == CELD_OK)
    status = celd_stroke_graph_new (&s.mask, style == CELD_ARROW_HEAD || style == CELD_ARROW_DOT, &s.graph);
  if (status == CELD_OK && !(s.explained = celd_alloc ((size_t) s.mask.width * (size_t) s.mask.height, 1)))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK && cover)
    status = find_hidden (&s, cover);
  if (status == CELD_OK)
    find_branches (&s, found);
  if (status == CELD_OK && s.graph.n_lines && s.graph.n_lines <= MOST_LINES)
    status = read_lines (&s, layer, relations, problems, doubts, &n);
  found->width = n ? s.graph.width : 0;
  celd_free (s.hidden);
  celd_free (s.explained);
  celd_free (s.lead);
  celd_stroke_graph_clear (&s.graph);
  celd_stroke_mask_clear (&s.mask);
  return status;
}
