/* The pieces of paper that a drawing's contours enclose, and its rooms: the same with small gaps in the contours closed.
 *
 * Paper farther from ink than one stroke width is open; connected open paper is a room, and takes in the paper within
 * that distance again.  So passages narrower than two stroke widths part rooms.  Of what is left over, corners of a room
 * too acute for that disc belong to it; but a bay that is wider inside than at its mouth is a small region behind a gap,
 * a room of its own, as is what touches no open paper at all.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment.h"

#include <math.h>
#include <string.h>

#define BAY 1.25 /* times as wide inside as at its mouth, and a pixel more */

typedef struct
{
  CeldCanvas *canvas;
  CeldLabels  mask;      /* what is looked for, 0 or 1 */
  CeldLabels  found;     /* components of it */
  int32_t    *to_ink;    /* squared distance to ink */
  int32_t    *to_open, *nearest;
  uint8_t    *inside;
} Work;

/* What is known of a bay: squared distances to ink, the largest inside and at its mouth, and the room there. */
typedef struct { int32_t inside, mouth; uint32_t room; } Bay;

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

/* Open paper, and the paper close to it. */
static CeldStatus
find_open (Work *work, const CeldRun *run)
{
  CeldCanvas *canvas = work->canvas;
  int32_t     radius = canvas->stroke, reach = (2 * radius + 3) * (2 * radius + 3); /* (2 x (radius + 3/2))^2 */
  size_t      n;
  CeldStatus  status;

  for (size_t p = 0; p < canvas->n; p++)
    work->inside[p] = !is_paper (canvas, p);
  status = celd_distance (canvas->width, canvas->height, work->inside, run, work->to_ink);
  for (size_t p = 0; p < canvas->n; p++)
    work->mask.data[p] = work->inside[p] = is_paper (canvas, p) && work->to_ink[p] > radius * radius;
  if (status == CELD_OK)
    status = count_components (work, run, &n);
  if (status == CELD_OK)
    status = celd_nearest (canvas->width, canvas->height, work->inside, run, work->to_open, work->nearest);
  if (status != CELD_OK)
    return status;
  canvas->n_rooms = n;
  for (size_t p = 0; p < canvas->n; p++)
    canvas->rooms.data[p] = is_paper (canvas, p) && work->to_open[p] <= reach / 4 && work->nearest[p] >= 0
                             ? work->found.data[work->nearest[p]] : 0;
  return CELD_OK;
}

static void
look_out (const Work *work, Bay *bay, size_t p, size_t q)
{
  if (!work->canvas->rooms.data[q] || work->to_ink[p] <= bay->mouth)
    return;
  bay->mouth = work->to_ink[p];
  bay->room = work->canvas->rooms.data[q];
}

static void
measure_bays (const Work *work, Bay *bay)
{
  size_t w = (size_t) work->canvas->width;

  for (size_t p = 0; p < work->canvas->n; p++)
    {
      Bay *b = &bay[work->found.data[p]];

      if (!work->found.data[p])
        continue;
      b->inside = work->to_ink[p] > b->inside ? work->to_ink[p] : b->inside;
      if (p % w > 0)
        look_out (work, b, p, p - 1);
      if (p % w + 1 < w)
        look_out (work, b, p, p + 1);
      if (p >= w)
        look_out (work, b, p, p - w);
      if (p + w < work->canvas->n)
        look_out (work, b, p, p + w);
    }
}

/* Paper that is in no room so far. */
static CeldStatus
find_bays (Work *work, const CeldRun *run)
{
  CeldCanvas *canvas = work->canvas;
  Bay        *bay;
  size_t      n = 0;
  CeldStatus  status;

  for (size_t p = 0; p < canvas->n; p++)
    work->mask.data[p] = is_paper (canvas, p) && !canvas->rooms.data[p];
  status = count_components (work, run, &n);
  if (status != CELD_OK)
    return status;
  bay = celd_alloc0 (n + 1, sizeof *bay);
  if (!bay)
    return CELD_NO_MEMORY;
  measure_bays (work, bay);
  for (size_t k = 1; k <= n; k++)
    if (!bay[k].room || sqrt (bay[k].inside) > BAY * sqrt (bay[k].mouth) + 1)
      bay[k].room = (uint32_t) ++canvas->n_rooms;
  for (size_t p = 0; p < canvas->n; p++)
    if (work->found.data[p])
      canvas->rooms.data[p] = bay[work->found.data[p]].room;
  celd_free (bay);
  return CELD_OK;
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
  work_clear (&work);
  return status;
}
