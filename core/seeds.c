/* Arrows as strokes: the expert gesture of section 4 ("generate scribbles with a newly added depth inequality")
 * and Figure 2, which has two arrows and nothing else.
 *
 * An end in a room (rooms.c) that nothing reaches makes that room a label.  Where both ends of an inequality end up in
 * one region, it is split between them: the end that is nearer, within the region, to the seeds that the region has
 * keeps its label, the other becomes a new one; only the region is cut again.  Equalities never split, and their ends
 * share one label.
 *
 * A seed of one pixel would collapse: to wrap it is cheaper than any cut across.  So an end is seeded with discs that
 * touch the contours beside it, first where it lies and then where climbing the distance to ink leads, all of them
 * nearer to it than half the way to the other end; a cut between the ends is then cheaper across a gap than round a
 * disc.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define REACH      0.45          /* of the way between both ends, for the discs of each */
#define WIDEST     8             /* discs are at most 1/8 of the shorter side */
#define HARD_PULL  ((1 << 30) - 1) /* what celd_maxflow takes */

/* An end of a relation on the drawing: the nearest paper to its point. */
typedef struct { bool there; int x, y; size_t p; } End;

typedef struct { double x, y, radius; } Disc;

/* ------------------------------------------------------------------ ends and discs */

static End
find_end (const CeldCanvas *canvas, const CeldTerm *term)
{
  End end = { 0 };

  if (term->by_colour || !(term->x >= 0 && term->y >= 0 && term->x < canvas->width && term->y < canvas->height))
    return end;
  end.x     = (int) term->x;
  end.y     = (int) term->y;
  end.there = celd_paper_near (canvas->ink, canvas->stroke, &end.x, &end.y);
  end.p     = (size_t) end.y * (size_t) canvas->width + (size_t) end.x;
  return end;
}

static double
distance (End a, End b)
{
  return hypot (a.x - b.x, a.y - b.y);
}

/* Squared distance to ink of every pixel. */
static CeldStatus
distance_to_ink (const CeldCanvas *canvas, const CeldRun *run, int32_t **squared)
{
  uint8_t   *inked = celd_alloc (canvas->n, 1);
  CeldStatus status = CELD_NO_MEMORY;

  *squared = celd_alloc (canvas->n, sizeof **squared);
  if (inked && *squared)
    {
      for (size_t p = 0; p < canvas->n; p++)
        inked[p] = !canvas->pieces.data[p];
      status = celd_distance (canvas->width, canvas->height, inked, run, *squared);
    }
  celd_free (inked);
  return status;
}

/* The largest disc round (x,y) without ink and no farther than `reach` from the end. */
static Disc
disc_at (const CeldCanvas *canvas, const int32_t *squared, End end, double reach, int x, int y)
{
  int    side = canvas->width < canvas->height ? canvas->width : canvas->height;
  double radius = sqrt (squared[(size_t) y * (size_t) canvas->width + (size_t) x]) - 0.5;

  radius = fmin (radius, fmin (fmax (1, (double) side / WIDEST), reach - hypot (x - end.x, y - end.y)));
  return (Disc) { x, y, fmax (0, radius) };
}

/* One step to where the disc is larger; false on a summit. */
static bool
climb (const CeldCanvas *canvas, const int32_t *squared, End end, double reach, Disc *disc)
{
  Disc best = *disc;
  int  cx = (int) disc->x, cy = (int) disc->y;

  for (int y = cy > 0 ? cy - 1 : 0; y <= cy + 1 && y < canvas->height; y++)
    for (int x = cx > 0 ? cx - 1 : 0; x <= cx + 1 && x < canvas->width; x++)
      {
        Disc other = disc_at (canvas, squared, end, reach, x, y);

        if (other.radius > best.radius + 1e-9)
          best = other;
      }
  if (best.radius <= disc->radius)
    return false;
  *disc = best;
  return true;
}

/* Calls `paint` for the pixels of a disc, its centre always. */
static void
stamp (CeldCanvas *canvas, Disc disc, void (*paint) (CeldCanvas *canvas, size_t p, void *data), void *data)
{
  int r = (int) disc.radius, cx = (int) disc.x, cy = (int) disc.y;

  for (int y = cy - r < 0 ? 0 : cy - r; y <= cy + r && y < canvas->height; y++)
    for (int x = cx - r < 0 ? 0 : cx - r; x <= cx + r && x < canvas->width; x++)
      if ((x - cx) * (x - cx) + (y - cy) * (y - cy) <= disc.radius * disc.radius)
        paint (canvas, (size_t) y * (size_t) canvas->width + (size_t) x, data);
}

/* Both discs of an end: where it lies, and on the summit above, whose squared distance to ink is returned. */
static int32_t
stamp_end (CeldCanvas *canvas, const int32_t *squared, End end, double reach,
           void (*paint) (CeldCanvas *canvas, size_t p, void *data), void *data)
{
  Disc disc = disc_at (canvas, squared, end, reach, end.x, end.y);

  stamp (canvas, disc, paint, data);
  while (climb (canvas, squared, end, reach, &disc))
    ;
  stamp (canvas, disc, paint, data);
  return squared[(size_t) disc.y * (size_t) canvas->width + (size_t) disc.x];
}

/* ------------------------------------------------------------------ colours of new labels */

static void
from_hue (double hue, double saturation, double value, uint8_t colour[4])
{
  for (int i = 0; i < 3; i++)
    {
      double t = fmod (hue + (3 - i) / 3.0, 1) * 6; /* 0 at this channel's own hue */
      double distance = fmin (t, 6 - t);            /* 0 .. 3 */
      double share = fmax (0, fmin (1, 2 - distance));

      colour[i] = (uint8_t) lround (255 * value * (1 - saturation + saturation * share));
    }
  colour[3] = 255;
}

static int
colour_distance (const uint8_t a[4], const uint8_t b[4])
{
  return abs (a[0] - b[0]) + abs (a[1] - b[1]) + abs (a[2] - b[2]);
}

/* The first of a fixed row of colours that is far from all labels; the farther, the fewer labels there are. */
static void
new_colour (const CeldPalette *palette, uint8_t colour[4])
{
  for (int least = 150; ; least = least * 2 / 3)
    for (int i = 0; i < 360; i++)
      {
        bool far = true;

        from_hue (fmod (0.33 + i * 0.6180339887, 1), i % 3 == 1 ? 0.55 : 0.8, i % 3 == 2 ? 0.65 : 0.95, colour);
        for (size_t k = 0; k < palette->n && far; k++)
          far = !palette->item[k].colour[3] || colour_distance (palette->item[k].colour, colour) >= least;
        if (far)
          return;
      }
}

static CeldStatus
new_label (CeldCanvas *canvas, uint32_t *label)
{
  CeldRegion region = { .origin = CELD_FROM_ARROW, .hard = true };

  new_colour (&canvas->palette, region.colour);
  return celd_canvas_add (canvas, region, label);
}

/* ------------------------------------------------------------------ ends that nothing reaches */

typedef struct { uint32_t label, room; } Planting;

static void
paint_room (CeldCanvas *canvas, size_t p, void *data)
{
  const Planting *planting = data;

  if (canvas->rooms.data[p] == planting->room && !canvas->seeds.data[p])
    canvas->seeds.data[p] = planting->label;
}

static CeldStatus
plant_relation (const CeldRelation *relation, const int32_t *squared, bool *reached, CeldCanvas *canvas)
{
  End        end[2] = { find_end (canvas, &relation->nearer), find_end (canvas, &relation->farther) };
  Planting   planting = { 0, 0 };
  double     reach = INFINITY;
  CeldStatus status = CELD_OK;

  if (end[0].there && end[1].there && canvas->rooms.data[end[0].p] == canvas->rooms.data[end[1].p])
    reach = REACH * distance (end[0], end[1]);
  for (int i = 0; i < 2 && status == CELD_OK; i++)
    {
      planting.room = end[i].there ? canvas->rooms.data[end[i].p] : 0;
      if (!planting.room || reached[planting.room])
        continue;
      if (!planting.label || !relation->equal)
        status = new_label (canvas, &planting.label);
      if (status == CELD_OK)
        stamp_end (canvas, squared, end[i], reach, paint_room, &planting);
      reached[planting.room] = true;
    }
  return status;
}

CeldStatus
celd_seeds_plant (const CeldRelations *relations, const CeldRun *run, CeldCanvas *canvas)
{
  bool      *reached = celd_alloc0 (canvas->n_rooms + 1, sizeof *reached);
  int32_t   *squared = NULL;
  CeldStatus status = reached ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK && relations->n)
    status = distance_to_ink (canvas, run, &squared);
  for (size_t p = 0; p < canvas->n && status == CELD_OK; p++)
    if (canvas->seeds.data[p])
      reached[canvas->rooms.data[p]] = true;
  for (size_t i = 0; i < relations->n && status == CELD_OK; i++)
    status = plant_relation (&relations->item[i], squared, reached, canvas);
  celd_free (squared);
  celd_free (reached);
  return status;
}

/* ------------------------------------------------------------------ both ends in one region */

/* The region round an end, as a walk over its pixels in steps finds it. */
typedef struct
{
  uint8_t  *mark;      /* INSIDE, and WALKED by the second walk; 0 elsewhere; one byte a pixel of the picture */
  uint32_t *queue;
  uint32_t  label;
  int       left, top, right, bottom;
} Region;

enum { OUTSIDE, INSIDE, WALKED, NEW_DISC, KEPT_DISC };

static void
visit (Region *region, size_t p, uint8_t from, uint8_t to, size_t *n)
{
  if (region->mark[p] != from)
    return;
  region->mark[p] = to;
  region->queue[(*n)++] = (uint32_t) p;
}

/* Walks over the pixels of the region's label that are marked `from`, marks them `to`, widens the box round them.
 * Returns the steps to the nearest seed of the label; SIZE_MAX if there is none. */
static size_t
walk (const CeldCanvas *canvas, size_t start, uint8_t from, uint8_t to, Region *region)
{
  size_t w = (size_t) canvas->width, n = 0, steps = 0, nearest = SIZE_MAX;

  visit (region, start, from, to, &n);
  for (size_t i = 0, level = n; i < n; i++)
    {
      size_t p = region->queue[i];
      int    x = (int) (p % w), y = (int) (p / w);

      if (i == level)
        {
          level = n;
          steps++;
        }
      if (nearest == SIZE_MAX && canvas->seeds.data[p] == region->label)
        nearest = steps;
      region->left   = x < region->left ? x : region->left;
      region->right  = x > region->right ? x : region->right;
      region->top    = y < region->top ? y : region->top;
      region->bottom = y > region->bottom ? y : region->bottom;
      if (x > 0 && canvas->labels.data[p - 1] == region->label)
        visit (region, p - 1, from, to, &n);
      if (x + 1 < canvas->width && canvas->labels.data[p + 1] == region->label)
        visit (region, p + 1, from, to, &n);
      if (y > 0 && canvas->labels.data[p - w] == region->label)
        visit (region, p - w, from, to, &n);
      if (y + 1 < canvas->height && canvas->labels.data[p + w] == region->label)
        visit (region, p + w, from, to, &n);
    }
  return nearest;
}

typedef struct { Region *region; uint8_t mark; } Marking;

static void
paint_mark (CeldCanvas *canvas, size_t p, void *data)
{
  const Marking *marking = data;

  if (marking->region->mark[p] && canvas->pieces.data[p])
    marking->region->mark[p] = marking->mark;
}

/* A cut of the region's box between the end that has more room round it, the source, and the other. */
typedef struct { int width, height; int32_t *east, *south, *terminal; uint8_t *side; } Local;

static void
local_clear (Local *local)
{
  celd_free (local->east);
  celd_free (local->south);
  celd_free (local->terminal);
  celd_free (local->side);
}

/* What a pixel of the region pulls to the new label (> 0) or to the old one (< 0). */
static int32_t
pull (const CeldCanvas *canvas, const Region *region, size_t p)
{
  if (region->mark[p] == NEW_DISC)
    return HARD_PULL;
  if (region->mark[p] == KEPT_DISC)
    return -HARD_PULL;
  if (canvas->seeds.data[p] != region->label)
    return 0;
  return celd_canvas_vote (canvas, region->label) == CELD_HARD ? -HARD_PULL : -canvas->soft_vote;
}

/* Copies what the cut needs from the region's box; no edge leaves the region. */
static CeldStatus
local_new (const CeldCanvas *canvas, const Region *region, bool new_is_source, Local *local)
{
  int    w = region->right - region->left + 1, h = region->bottom - region->top + 1;
  size_t n = (size_t) w * (size_t) h, i = 0, stride = (size_t) canvas->width;

  *local = (Local) {
    w, h, celd_alloc0 (n, sizeof *local->east), celd_alloc0 (n, sizeof *local->south),
    celd_alloc0 (n, sizeof *local->terminal), celd_alloc0 (n, 1)
  };
  if (!local->east || !local->south || !local->terminal || !local->side)
    return CELD_NO_MEMORY;
  for (int y = region->top; y <= region->bottom; y++)
    for (int x = region->left; x <= region->right; x++, i++)
      {
        size_t p = (size_t) y * stride + (size_t) x;

        if (region->mark[p] == OUTSIDE)
          continue;
        if (x < region->right && region->mark[p + 1])
          local->east[i] = canvas->east[p];
        if (y < region->bottom && region->mark[p + stride])
          local->south[i] = canvas->south[p];
        local->terminal[i] = new_is_source ? pull (canvas, region, p) : -pull (canvas, region, p);
      }
  return CELD_OK;
}

/* Gives the new label its side of the cut; discs are seeds from now on. */
static void
take_over (CeldCanvas *canvas, const Region *region, const Local *local, bool new_is_source, uint32_t label)
{
  size_t i = 0;

  for (int y = region->top; y <= region->bottom; y++)
    for (int x = region->left; x <= region->right; x++, i++)
      {
        size_t p = (size_t) y * (size_t) canvas->width + (size_t) x;

        if (region->mark[p] != OUTSIDE && (local->side[i] != 0) == new_is_source)
          canvas->labels.data[p] = label;
        if (region->mark[p] == NEW_DISC || region->mark[p] == KEPT_DISC)
          canvas->seeds.data[p] = region->mark[p] == NEW_DISC ? label : region->label;
      }
}

/* Of all smallest cuts this is the one nearest to the end with more room: a limb reaches to where the body begins. */
static CeldStatus
cut_region (CeldCanvas *canvas, const Region *region, bool new_is_source, const CeldRun *run)
{
  Local      local = { 0 };
  uint32_t   label;
  CeldStatus status = local_new (canvas, region, new_is_source, &local);

  if (status == CELD_OK)
    status = celd_maxflow (local.width, local.height, local.east, local.south, local.terminal, run, local.side, NULL);
  if (status == CELD_OK)
    status = new_label (canvas, &label);
  if (status == CELD_OK)
    take_over (canvas, region, &local, new_is_source, label);
  local_clear (&local);
  return status;
}

/* Marks the discs of both ends, that of the new label last, and cuts between them. */
static CeldStatus
split_region (CeldCanvas *canvas, const int32_t *squared, End kept, End new, Region *region, const CeldRun *run)
{
  double  reach = REACH * distance (kept, new);
  int32_t room[2]; /* how much there is round the ends */
  Marking marking[2] = { { region, KEPT_DISC }, { region, NEW_DISC } };

  room[0] = stamp_end (canvas, squared, kept, reach, paint_mark, &marking[0]);
  room[1] = stamp_end (canvas, squared, new, reach, paint_mark, &marking[1]);
  return cut_region (canvas, region, room[1] > room[0], run);
}

static CeldStatus
split_relation (CeldCanvas *canvas, const CeldRelation *relation, const int32_t *squared, Region *region,
                const CeldRun *run)
{
  End        end[2] = { find_end (canvas, &relation->nearer), find_end (canvas, &relation->farther) };
  CeldStatus status = CELD_OK;
  size_t     steps[2];

  if (relation->equal || !end[0].there || !end[1].there || end[0].p == end[1].p ||
      canvas->labels.data[end[0].p] != canvas->labels.data[end[1].p])
    return CELD_OK;
  region->label = canvas->labels.data[end[0].p];
  region->left  = region->right = end[0].x;
  region->top   = region->bottom = end[0].y;
  steps[0] = walk (canvas, end[0].p, OUTSIDE, INSIDE, region);
  if (region->mark[end[1].p] == INSIDE)
    {
      steps[1] = walk (canvas, end[1].p, INSIDE, WALKED, region);
      status = steps[0] < steps[1] ? split_region (canvas, squared, end[0], end[1], region, run)
                                   : split_region (canvas, squared, end[1], end[0], region, run);
    }
  for (int y = region->top; y <= region->bottom; y++)
    memset (&region->mark[(size_t) y * (size_t) canvas->width + (size_t) region->left], OUTSIDE,
            (size_t) (region->right - region->left + 1));
  return status;
}

CeldStatus
celd_seeds_split (const CeldRelations *relations, const CeldRun *run, CeldCanvas *canvas)
{
  Region     region = { .mark = celd_alloc0 (canvas->n, 1), .queue = celd_alloc (canvas->n, sizeof *region.queue) };
  int32_t   *squared = NULL;
  CeldPart   first;
  CeldRun    measuring = celd_run_part (&first, run, 0, 0);
  CeldStatus status = region.mark && region.queue ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK && relations->n)
    status = distance_to_ink (canvas, &measuring, &squared);
  for (size_t i = 0; i < relations->n && status == CELD_OK; i++)
    {
      CeldPart part;
      double   n = (double) relations->n;
      CeldRun  one = celd_run_part (&part, run, (double) i / n, (double) (i + 1) / n);

      status = split_relation (canvas, &relations->item[i], squared, &region, &one);
    }
  celd_free (region.mark);
  celd_free (region.queue);
  celd_free (squared);
  return status;
}
