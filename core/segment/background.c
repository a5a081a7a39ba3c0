/* Which label is the background, and how much of the paper along the frame it gets.
 *
 * Paper along the frame belongs to the label that owns most of it.  The owner of an enclosure is the label with most
 * paint in it, counting only strokes that are at home there: those that have at least half of their paint in it.  In
 * a component, which is many enclosures behind gaps, that must be a fair share of all paint: the mean of its labels.  A
 * stroke that is at home nowhere but has half of its paint along the frame runs over hatching, and counts in every
 * enclosure along the frame.  A stroke of which a fair part lies along the frame, and that was led there without
 * running over a line, counts there, too; or with one, if no other label has paint in that part and it does not have a
 * quarter of the frame: the frame has cut it off the figure, else it is the page.  A stroke in a figure whose outline
 * has a gap as wide as the paper beside it lies in one enclosure with the page.  So if no label owns a quarter of the
 * frame in rooms, which bridges close, the page is not painted: an enclosure that has a quarter of the frame has no
 * owner where its room has none.
 *
 * Enclosures along the frame without an owner get seeds of the main owner.  If no label owns a quarter of the frame or
 * runs over hatching, and more of the frame has no owner, they get a transparent label of their own: parts of a figure
 * that are cut off by the frame own a little of it, but are not the background.  Nor is a label that the artist's
 * relations put in front of something: in a close-up a figure may own most of the frame.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/splits.h"
#include "segment/task.h"

#define MAIN_SHARE 4 /* 1 / this: a quarter of the frame is the main part of it (chosen) */
#define FAIR_PART  8 /* 1 / this of a stroke is not where it was led by chance (chosen) */

/* The parts of the drawing of one kind: how many frame pixels lie in each, and its owner. */
typedef struct
{
  const uint32_t *of_basin;
  size_t         *along;
  uint32_t       *owner;
} Parts;

typedef struct
{
  size_t   *pixel;    /* indices of paper pixels along the frame */
  uint32_t *basin;    /* the basin of each */
  uint32_t *owner;    /* its owner, a label; 0: none */
  size_t    n;
  size_t   *owned;    /* pixels of the frame that label l owns; owned[0]: without an owner */
  bool     *across;   /* has label l a stroke along the frame that is at home nowhere? */
  bool     *in_front; /* is label l in front of something? */
  Parts     enclosures, rooms; /* rooms: components with bridges as lines */
  bool      painted;  /* does a label own the main part in rooms? */
} Frame;

static void
parts_clear (Parts *parts)
{
  celd_free (parts->along);
  celd_free (parts->owner);
}

/* Lists the frame, without specks of paper in solid ink. */
static CeldStatus
frame_new (const CeldSegmentTask *task, Frame *frame)
{
  int        w = task->ink->width, h = task->ink->height;
  size_t     n = 0;
  CeldStatus status = celd_frame (task->ink, w, h, task->basins->stroke, &frame->pixel, &frame->n);

  if (status != CELD_OK)
    return status;
  frame->basin  = celd_alloc (frame->n, sizeof *frame->basin);
  frame->owner = celd_alloc (frame->n, sizeof *frame->owner);
  frame->owned   = celd_alloc0 (task->palette.n + 1, sizeof *frame->owned);
  frame->across = celd_alloc0 (task->palette.n + 1, sizeof *frame->across);
  frame->in_front = celd_alloc0 (task->palette.n + 1, sizeof *frame->in_front);
  if (!frame->basin || !frame->owner || !frame->owned || !frame->across || !frame->in_front)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < frame->n; i++)
    {
      size_t   p = frame->pixel[i];
      uint32_t basin = celd_basin_at (task->basins, (int) (p % (size_t) w), (int) (p / (size_t) w));

      if (!task->basins->enclosure[basin])
        continue;
      frame->pixel[n]   = p;
      frame->basin[n++] = basin;
    }
  frame->n = n;
  return CELD_OK;
}

static void
frame_clear (Frame *frame)
{
  celd_free (frame->pixel);
  celd_free (frame->basin);
  celd_free (frame->owner);
  celd_free (frame->owned);
  celd_free (frame->across);
  celd_free (frame->in_front);
  parts_clear (&frame->enclosures);
  parts_clear (&frame->rooms);
}

/* ------------------------------------------------------------------ owners of the frame */

/* Which strokes count in which part. */
typedef struct
{
  const CeldStrokes *strokes;
  const size_t      *along;     /* of each part: its frame pixels */
  size_t             n_frame;   /* frame pixels in all */
  bool               all_count;
  size_t            *scattered; /* of stroke k: its pixels along the frame, if it is at home nowhere; else 0 */
  bool              *crosses;   /* of stroke k: lies it on ink, too?  NULL until it is needed, which is seldom */
  CeldStatus         status;
} Counting;

static CeldStatus
find_scattered (Counting *c)
{
  const CeldStrokes *strokes = c->strokes;

  c->scattered = celd_alloc0 (strokes->n_strokes, sizeof *c->scattered);
  if (!c->scattered)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < strokes->n; i++)
    if (c->along[strokes->overlap[i].part])
      c->scattered[strokes->overlap[i].stroke] += strokes->overlap[i].pixels;
  for (size_t i = 0; i < strokes->n; i++)
    if (2 * strokes->overlap[i].pixels >= strokes->total[strokes->overlap[i].stroke])
      c->scattered[strokes->overlap[i].stroke] = 0;
  return CELD_OK;
}

static bool
crosses_ink (Counting *c, uint32_t stroke)
{
  const CeldStrokes *strokes = c->strokes;

  if (!c->crosses)
    {
      c->crosses = celd_alloc0 (strokes->n_strokes, sizeof *c->crosses);
      for (size_t i = 0; c->crosses && i < strokes->n_pieces; i++)
        {
          const CeldStrokePiece *piece = &strokes->piece[i];

          c->crosses[piece->stroke] |= piece->paper < (uint32_t) (piece->end - piece->x);
        }
    }
  if (!c->crosses)
    c->status = CELD_NO_MEMORY;
  return !c->crosses || c->crosses[stroke];
}

/* Does a stroke count where it overlaps a part?  alone: no other label has paint there.  *across: because it runs on
 * along the frame. */
static bool
counts (Counting *c, const CeldStrokeOverlap *overlap, bool alone, bool *across)
{
  size_t total = c->strokes->total[overlap->stroke], along = c->along[overlap->part];
  bool   runs_on = along && 2 * c->scattered[overlap->stroke] >= total;

  *across |= runs_on;
  if (c->all_count || runs_on || 2 * overlap->pixels >= total)
    return true;
  return along && FAIR_PART * overlap->pixels >= total &&
         ((alone && MAIN_SHARE * along < c->n_frame) || !crosses_ink (c, overlap->stroke));
}

/* The end of the overlaps from i on that are in the same part. */
static size_t
part_end (const CeldStrokes *strokes, size_t i)
{
  uint32_t part = strokes->overlap[i].part;

  while (i < strokes->n && strokes->overlap[i].part == part)
    i++;
  return i;
}

/* owner[k] becomes the label with most paint in part k, 0 without any or, if `fair`, with less than a fair share of it.
 * Soft strokes count only where they are at home, or along the frame if they are scattered, led there or alone there.
 * along[k]: frame pixels in part k. */
static CeldStatus
find_owners (const CeldStrokes *strokes, bool all_count, bool fair, const size_t *along, Frame *frame, uint32_t *owner)
{
  Counting c = { .strokes = strokes, .along = along, .n_frame = frame->n, .all_count = all_count };

  c.status = find_scattered (&c);
  for (size_t i = 0; i < strokes->n && c.status == CELD_OK;)
    {
      uint32_t part = strokes->overlap[i].part;
      size_t   end = part_end (strokes, i), most = 0, all = 0, labels = 0;
      bool     alone = strokes->overlap[i].label == strokes->overlap[end - 1].label;

      while (i < end)
        {
          uint32_t label = strokes->overlap[i].label;
          size_t   paint = 0;

          labels++;
          for (; i < end && strokes->overlap[i].label == label; i++)
            {
              all += strokes->overlap[i].pixels;
              paint += counts (&c, &strokes->overlap[i], alone, &frame->across[label]) ? strokes->overlap[i].pixels : 0;
            }
          if (paint > most)
            {
              most        = paint;
              owner[part] = label;
            }
        }
      if (fair && labels * most < all)
        owner[part] = 0;
    }
  celd_free (c.scattered);
  celd_free (c.crosses);
  return c.status;
}

/* Makes the record, and finds the owner of each part; n is the largest number of a part. */
static CeldStatus
parts_new (const CeldSegmentTask *task, Frame *frame, const uint32_t *of_basin, size_t n, bool fair,
           CeldStrokes *strokes, Parts *parts)
{
  CeldStatus status;

  *parts = (Parts) { of_basin, celd_alloc0 (n + 1, sizeof *parts->along), celd_alloc0 (n + 1, sizeof *parts->owner) };
  if (!parts->along || !parts->owner)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < frame->n; i++)
    parts->along[of_basin[frame->basin[i]]]++;
  status = celd_strokes_overlap (task->basins, of_basin, strokes);
  if (status == CELD_OK)
    status = find_owners (strokes, celd_task_all_hard (task), fair, parts->along, frame, parts->owner);
  return status;
}

/* Finds out whether a label owns the main part of the frame in rooms. */
static CeldStatus
find_painted (size_t n_labels, Frame *frame)
{
  size_t *owned = celd_alloc0 (n_labels + 1, sizeof *owned);

  for (size_t i = 0; i < frame->n && owned; i++)
    {
      uint32_t owner = frame->rooms.owner[frame->rooms.of_basin[frame->basin[i]]];

      owned[owner]++;
      frame->painted |= owner && MAIN_SHARE * owned[owner] >= frame->n;
    }
  celd_free (owned);
  return owned ? CELD_OK : CELD_NO_MEMORY;
}

/* Is it in a room without an owner, on a page that is not painted? */
static bool
is_unpainted_room (const Frame *frame, uint32_t basin)
{
  return !frame->painted && !frame->rooms.owner[frame->rooms.of_basin[basin]];
}

/* Finds the owner of each frame pixel: that of its enclosure.  Behind a small gap in a contour, in an enclosure that
 * does not have most of the frame, the owner of its component counts, too.  In one that has, an unpainted page has no
 * owner. */
static void
find_pixel_owners (const Parts *components, Frame *frame)
{
  const Parts *enclosures = &frame->enclosures;

  for (size_t i = 0; i < frame->n; i++)
    {
      uint32_t basin = frame->basin[i], enclosure = enclosures->of_basin[basin], owner = enclosures->owner[enclosure];
      bool     is_main = MAIN_SHARE * enclosures->along[enclosure] >= frame->n;

      if (is_main && is_unpainted_room (frame, basin))
        owner = 0;
      else if (!is_main && !owner)
        owner = components->owner[components->of_basin[basin]];
      frame->owner[i] = owner;
      frame->owned[owner]++;
    }
}

static CeldStatus
find_frame_owners (const CeldSegmentTask *task, CeldStrokes *strokes, Frame *frame)
{
  const CeldBasins *b = task->basins;
  const uint32_t   *room = task->bridged_component ? task->bridged_component : b->component;
  Parts             components = { 0 };
  CeldStatus        status = parts_new (task, frame, b->enclosure, b->n_enclosures, false, strokes, &frame->enclosures);

  if (status == CELD_OK)
    status = parts_new (task, frame, b->component, b->n_components, true, strokes, &components);
  if (status == CELD_OK)
    status = parts_new (task, frame, room, b->n, true, strokes, &frame->rooms);
  if (status == CELD_OK)
    status = find_painted (task->palette.n, frame);
  if (status == CELD_OK)
    find_pixel_owners (&components, frame);
  parts_clear (&components);
  return status;
}

/* ------------------------------------------------------------------ labels in front of something */

/* The label that an end of a relation means; 0: none yet. */
static uint32_t
label_of (const CeldSegmentTask *task, const Frame *frame, const CeldTerm *term)
{
  CeldRelationEnd end;
  uint32_t        label;

  if (term->by_colour)
    return celd_palette_find (&task->palette, term->colour);
  end = celd_relation_end_find (task, term);
  if (!end.there)
    return 0;
  label = celd_seed_rows_at (&task->seeds, end.x, end.y);
  return label ? label : frame->enclosures.owner[task->basins->enclosure[celd_basin_at (task->basins, end.x, end.y)]];
}

static void
mark_in_front (const CeldRelations *relations, const CeldSegmentTask *task, Frame *frame)
{
  for (size_t i = 0; i < relations->n; i++)
    if (!relations->item[i].equal)
      frame->in_front[label_of (task, frame, &relations->item[i].nearer)] = true;
}

/* Relations that rule out a label which owns more of the frame than the background, or than none (0), matter. */
static void
count_effective (const CeldRelations *relations, const Frame *frame, uint32_t background, CeldSegmentTask *task)
{
  for (size_t i = task->n_effective; i < relations->n; i++)
    {
      uint32_t label = relations->item[i].equal ? 0 : label_of (task, frame, &relations->item[i].nearer);

      if (label && frame->owned[label] > (background ? frame->owned[background] : 0))
        task->n_effective = i + 1;
    }
}

/* ------------------------------------------------------------------ what it gets */

/* The label that owns most of the frame, or most among those with a stroke along it, of those that are in front of
 * nothing; 0: none. */
static uint32_t
most_owned (const Frame *frame, size_t n_labels, bool across)
{
  uint32_t best = 0;

  for (uint32_t l = 1; l <= n_labels; l++)
    if ((frame->across[l] || !across) && !frame->in_front[l] && frame->owned[l] &&
        (!best || frame->owned[l] > frame->owned[best]))
      best = l;
  return best;
}

/* The label that is in front of nothing and owns most of the frame; 0: none. */
static uint32_t
main_owner (const Frame *frame, size_t n_labels)
{
  uint32_t best = most_owned (frame, n_labels, false);

  if (best && MAIN_SHARE * frame->owned[best] < frame->n && frame->owned[0] > frame->owned[best])
    return most_owned (frame, n_labels, true);
  return best;
}

/* Chooses the background's label by the settings, and adds it if it is new; 0: there is none. */
static CeldStatus
choose (CeldSegmentTask *task, const Frame *frame, uint32_t *label)
{
  const CeldSettings *s = task->settings;
  bool                by_colour = s->background == CELD_BACKGROUND_COLOUR;
  const uint8_t      *c = s->background_colour;
  CeldRegion          made = { .origin = CELD_FROM_BACKGROUND, .hard = true };

  *label = by_colour ? celd_palette_find (&task->palette, c) : main_owner (frame, task->palette.n);
  if (*label || !frame->owned[0])
    return CELD_OK;
  if (by_colour)
    made = (CeldRegion) { .colour = { c[0], c[1], c[2], 255 }, .origin = CELD_FROM_BACKGROUND, .hard = true };
  return celd_task_add_label (task, made, label);
}

/* Adds the background's seeds in enclosures along the frame without an owner, and removes spills there, but for those
 * in rooms with an owner if the page is not painted.  Hard strokes stay: they may lie where a bridge covers the paper.
 * If the background is painted, these enclosures are remembered: the artist may have forgotten them. */
static CeldStatus
seed (CeldSegmentTask *task, const CeldStrokes *strokes, Frame *frame, uint32_t label)
{
  size_t          w = (size_t) task->ink->width;
  const uint32_t *enclosure = task->basins->enclosure;
  bool           *unowned = celd_alloc0 (task->basins->n_enclosures + 1, sizeof *unowned);
  CeldStatus      status = unowned ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < frame->n && status == CELD_OK; i++)
    if (!frame->owner[i])
      unowned[enclosure[frame->basin[i]]] = true;
  for (size_t i = 0; i < strokes->n_pieces && status == CELD_OK && !celd_task_all_hard (task); i++)
    if (unowned[enclosure[strokes->piece[i].basin]] &&
        (frame->painted || is_unpainted_room (frame, strokes->piece[i].basin)))
      status = celd_stroke_piece_remove (task, &strokes->piece[i]);
  for (size_t i = 0; i < frame->n; i++)
    if (!frame->owner[i])
      frame->owner[i] = celd_seed_rows_at (&task->seeds, (int) (frame->pixel[i] % w), (int) (frame->pixel[i] / w));
  for (size_t i = 0, next; i < frame->n && status == CELD_OK; i = next)
    {
      size_t p = frame->pixel[i];

      next = i + 1;
      if (frame->owner[i])
        continue;
      while (next < frame->n && !frame->owner[next] && frame->pixel[next] == p + next - i && (p + next - i) % w)
        next++;
      status = celd_seed_rows_paint (&task->seeds, (int) (p / w), (int) (p % w), (int) (p % w + next - i), label);
    }
  if (task->palette.item[label - 1].origin == CELD_FROM_BACKGROUND)
    celd_free (unowned);
  else
    task->unpainted = unowned;
  return status;
}

CeldStatus
celd_background_seed (const CeldRelations *relations, const CeldHost *host, CeldSegmentTask *task)
{
  Frame       frame = { 0 };
  CeldStrokes own = { 0 }, *strokes = task->painted.piece && !task->spilled ? &task->painted : &own;
  uint32_t    label = 0;
  size_t      n_labels;
  CeldStatus  status;

  if (task->settings->background == CELD_BACKGROUND_NONE)
    return CELD_OK;
  status = frame_new (task, &frame);
  if (status == CELD_OK && strokes == &own)
    status = celd_strokes_new (task, NULL, strokes);
  if (status == CELD_OK && strokes == &own && !celd_task_all_hard (task))
    status = celd_strokes_join_severed (task, strokes);
  if (status == CELD_OK)
    status = find_frame_owners (task, strokes, &frame);
  if (status == CELD_OK && relations && task->settings->background != CELD_BACKGROUND_COLOUR)
    mark_in_front (relations, task, &frame);
  n_labels = task->palette.n;
  if (status == CELD_OK)
    status = choose (task, &frame, &label);
  if (status == CELD_OK && relations && task->settings->background != CELD_BACKGROUND_COLOUR)
    count_effective (relations, &frame, label <= n_labels ? label : 0, task);
  if (status == CELD_OK && label)
    {
      task->palette.item[label - 1].background = true;
      status = seed (task, strokes, &frame, label);
    }
  celd_strokes_clear (&own);
  frame_clear (&frame);
  return status == CELD_OK ? celd_progress (host, 1) : status;
}
