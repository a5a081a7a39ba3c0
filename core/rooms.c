/* The pieces of paper that a drawing's contours enclose, and its rooms: the same with small gaps in contours closed.
 *
 * Paper farther from ink than one stroke width is open.  Connected open paper takes in the paper within that distance
 * again, and what is left over are bays.  So passages narrower than two stroke widths part these basins.  But not every
 * such passage is a gap: from the widest on, passages join basins again unless both are clearly wider than the passage.
 * A passage along the frame is none: the page goes on behind the frame.  So acute corners and narrow corridors stay
 * with their room, and a small region behind a gap stays by itself.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WIDER 1.25 /* times as wide as a passage, and a pixel more */

/* Where two basins touch: the squared distance to ink there. */
typedef struct { uint32_t a, b; int32_t squared; } Passage;

/* Basins joined so far: each one's parent, itself for the first of a room, and its largest squared distance to ink. */
typedef struct { uint32_t parent; int32_t widest; } Basin;

typedef struct
{
  CeldCanvas *canvas;
  CeldLabels  mask;      /* what is looked for, 0 or 1 */
  CeldLabels  found;     /* components of it */
  int32_t    *to_ink;    /* squared distance to ink */
  int32_t    *to_open, *nearest;
  uint8_t    *inside;
  Passage    *passage;
  size_t      n_passages, n_basins;
} Work;

static bool
is_paper (const CeldCanvas *canvas, size_t p)
{
  return celd_is_paper (CELD_AT (canvas->ink, p % (size_t) canvas->width, p / (size_t) canvas->width));
}

static CeldStatus
work_new (CeldCanvas *canvas, Work *work)
{
  CeldStatus status;

  *work = (Work) {
    .canvas  = canvas,
    .to_ink  = celd_alloc (canvas->n, sizeof *work->to_ink),
    .to_open = celd_alloc (canvas->n, sizeof *work->to_open),
    .nearest = celd_alloc (canvas->n, sizeof *work->nearest),
    .inside  = celd_alloc (canvas->n, 1),
  };
  status = work->to_ink && work->to_open && work->nearest && work->inside ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_labels_new (canvas->width, canvas->height, &work->mask);
  if (status == CELD_OK)
    status = celd_labels_new (canvas->width, canvas->height, &work->found);
  return status;
}

static void
work_clear (Work *work)
{
  celd_free (work->mask.data);
  celd_free (work->found.data);
  celd_free (work->to_ink);
  celd_free (work->to_open);
  celd_free (work->nearest);
  celd_free (work->inside);
  celd_free (work->passage);
}

static CeldStatus
count_components (Work *work, const CeldRun *run, size_t *n)
{
  CeldComponent *list = NULL;
  CeldStatus     status = celd_components (&work->mask, 0, false, run, &work->found, &list, n);

  celd_free (list);
  return status;
}

static CeldStatus
find_pieces (Work *work, const CeldRun *run)
{
  CeldCanvas *canvas = work->canvas;
  CeldStatus  status;

  for (size_t p = 0; p < canvas->n; p++)
    work->mask.data[p] = is_paper (canvas, p);
  status = count_components (work, run, &canvas->n_pieces);
  memcpy (canvas->pieces.data, work->found.data, canvas->n * sizeof *canvas->pieces.data);
  return status;
}

/* The basin of the open paper closest to p; 0 if that is too far away, or behind a thin line. */
static uint32_t
open_near (const Work *work, size_t p, int32_t reach)
{
  const uint32_t *piece = work->canvas->pieces.data;
  int32_t         q = work->nearest[p];

  return q >= 0 && work->to_open[p] <= reach / 4 && piece[p] == piece[q] ? work->found.data[q] : 0;
}

/* Open paper, and the paper close to it. */
static CeldStatus
find_open (Work *work, const CeldRun *run)
{
  CeldCanvas *canvas = work->canvas;
  int32_t     radius = canvas->stroke, reach = (2 * radius + 3) * (2 * radius + 3); /* (2 x (radius + 3/2))^2 */
  CeldStatus  status;

  for (size_t p = 0; p < canvas->n; p++)
    work->inside[p] = !is_paper (canvas, p);
  status = celd_distance (canvas->width, canvas->height, work->inside, run, work->to_ink);
  if (status != CELD_OK)
    return status;
  for (size_t p = 0; p < canvas->n; p++)
    work->mask.data[p] = work->inside[p] = is_paper (canvas, p) && work->to_ink[p] > radius * radius;
  status = count_components (work, run, &work->n_basins);
  if (status == CELD_OK)
    status = celd_nearest (canvas->width, canvas->height, work->inside, run, work->to_open, work->nearest);
  if (status != CELD_OK)
    return status;
  for (size_t p = 0; p < canvas->n; p++)
    canvas->rooms.data[p] = is_paper (canvas, p) ? open_near (work, p, reach) : 0;
  return CELD_OK;
}

/* Paper that is in no basin so far. */
static CeldStatus
find_bays (Work *work, const CeldRun *run)
{
  CeldCanvas *canvas = work->canvas;
  size_t      n = 0;
  CeldStatus  status;

  for (size_t p = 0; p < canvas->n; p++)
    work->mask.data[p] = is_paper (canvas, p) && !canvas->rooms.data[p];
  status = count_components (work, run, &n);
  if (status != CELD_OK)
    return status;
  for (size_t p = 0; p < canvas->n; p++)
    if (work->found.data[p])
      canvas->rooms.data[p] = (uint32_t) work->n_basins + work->found.data[p];
  work->n_basins += n;
  return CELD_OK;
}

/* ------------------------------------------------------------------ joining basins */

static bool
on_frame (const CeldCanvas *canvas, size_t p)
{
  size_t w = (size_t) canvas->width;

  return p < w || p >= canvas->n - w || p % w == 0 || p % w == w - 1;
}

static CeldStatus
note_passage (Work *work, size_t p, size_t q)
{
  uint32_t a = work->canvas->rooms.data[p], b = work->canvas->rooms.data[q];
  int32_t  squared = work->to_ink[p] < work->to_ink[q] ? work->to_ink[p] : work->to_ink[q];
  Passage *passage;

  if (!a || !b || a == b)
    return CELD_OK;
  passage = celd_grow (work->passage, work->n_passages + 1, sizeof *passage);
  if (!passage)
    return CELD_NO_MEMORY;
  work->passage = passage;
  if (on_frame (work->canvas, p) && on_frame (work->canvas, q))
    squared = INT32_MAX;
  passage[work->n_passages++] = (Passage) { a, b, squared };
  return CELD_OK;
}

static CeldStatus
find_passages (Work *work)
{
  size_t     w = (size_t) work->canvas->width;
  CeldStatus status = CELD_OK;

  for (size_t p = 0; p < work->canvas->n && status == CELD_OK; p++)
    {
      if (p % w + 1 < w)
        status = note_passage (work, p, p + 1);
      if (p + w < work->canvas->n && status == CELD_OK)
        status = note_passage (work, p, p + w);
    }
  return status;
}

/* The widest first; ties in a fixed order. */
static int
compare_passages (const void *a, const void *b)
{
  const Passage *p = a, *q = b;

  if (p->squared != q->squared)
    return p->squared > q->squared ? -1 : 1;
  if (p->a != q->a)
    return p->a < q->a ? -1 : 1;
  return p->b < q->b ? -1 : p->b > q->b;
}

static uint32_t
first_basin (Basin *basin, uint32_t k)
{
  while (basin[k].parent != k)
    k = basin[k].parent = basin[basin[k].parent].parent;
  return k;
}

static void
pass (Basin *basin, const Passage *passage)
{
  uint32_t a = first_basin (basin, passage->a), b = first_basin (basin, passage->b);
  int32_t  narrower = basin[a].widest < basin[b].widest ? basin[a].widest : basin[b].widest;

  if (a == b || sqrt (narrower) > WIDER * sqrt (passage->squared) + 1)
    return;
  if (basin[b].widest > basin[a].widest)
    basin[a].widest = basin[b].widest;
  basin[b].parent = a;
}

/* Joins basins and numbers what they make, the rooms. */
static CeldStatus
join_basins (Work *work)
{
  CeldCanvas *canvas = work->canvas;
  Basin      *basin = celd_alloc0 (work->n_basins + 1, sizeof *basin);
  uint32_t   *room = celd_alloc0 (work->n_basins + 1, sizeof *room);
  CeldStatus  status = basin && room ? find_passages (work) : CELD_NO_MEMORY;

  if (status != CELD_OK)
    goto done;
  for (uint32_t k = 0; k <= work->n_basins; k++)
    basin[k].parent = k;
  for (size_t p = 0; p < canvas->n; p++)
    if (work->to_ink[p] > basin[canvas->rooms.data[p]].widest)
      basin[canvas->rooms.data[p]].widest = work->to_ink[p];
  if (work->n_passages)
    qsort (work->passage, work->n_passages, sizeof *work->passage, compare_passages);
  for (size_t i = 0; i < work->n_passages; i++)
    pass (basin, &work->passage[i]);
  for (uint32_t k = 1; k <= work->n_basins; k++)
    if (basin[k].parent == k)
      room[k] = (uint32_t) ++canvas->n_rooms;
  for (size_t p = 0; p < canvas->n; p++)
    canvas->rooms.data[p] = room[first_basin (basin, canvas->rooms.data[p])];

done:
  celd_free (basin);
  celd_free (room);
  return status;
}

CeldStatus
celd_rooms (const CeldRun *run, CeldCanvas *canvas)
{
  Work       work;
  CeldStatus status = work_new (canvas, &work);

  if (status == CELD_OK)
    status = find_pieces (&work, run);
  if (status == CELD_OK)
    status = find_open (&work, run);
  if (status == CELD_OK)
    status = find_bays (&work, run);
  if (status == CELD_OK)
    status = join_basins (&work);
  work_clear (&work);
  return status;
}
