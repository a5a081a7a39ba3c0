/* Arrows as strokes: the expert gesture of section 4 ("generate scribbles with a newly added depth inequality")
 * and Figure 2, which has two arrows and nothing else.
 *
 * An end in a room that nothing reaches makes that room a label.  Equalities never part their ends: both share one
 * label.  What this costs goes by the seeds and the size of the discs, not by the picture.  Where both ends of an
 * inequality end up in one region, split.c goes on.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/canvas.h"
#include "segment/seeds.h"

#include <math.h>

#define ON_BASINS 12 /* pixels: the radius of discs where no cut could run round one, as it would take in its basin */

/* ------------------------------------------------------------------ what seeds reach */

static bool
has_paper (const CeldPlane *ink, int y, int x, int end)
{
  for (; x < end; x++)
    if (celd_is_paper (CELD_AT (ink, x, y)))
      return true;
  return false;
}

/* The rooms on whose paper the seeds of row y lie; both are runs from left to right. */
static void
reach_along (const CeldCanvas *canvas, int y)
{
  const CeldBasins  *basins = canvas->basins;
  const CeldSeedRow *row = &canvas->seeds.row[y];
  size_t             k = basins->row[y], last = basins->row[y + 1] - 1;

  for (size_t i = 0; i < row->n; i++)
    for (int x = row->run[i].x, end; x < row->run[i].end; x = end)
      {
        uint32_t room;

        while (k < last && basins->run[k + 1].x <= x)
          k++;
        end  = k < last && basins->run[k + 1].x < row->run[i].end ? basins->run[k + 1].x : row->run[i].end;
        room = basins->room[basins->run[k].basin];
        if (!canvas->reached[room])
          canvas->reached[room] = has_paper (canvas->ink, y, x, end);
      }
}

/* ------------------------------------------------------------------ planting */

/* Paints those pixels x .. end - 1 of row y that lie in the room and have no seed. */
static CeldStatus
paint_in_room (CeldCanvas *canvas, int y, int x, int end, uint32_t room, uint32_t label)
{
  const CeldBasins *basins = canvas->basins;
  CeldStatus        status = CELD_OK;

  x   = x < 0 ? 0 : x;
  end = end > basins->width ? basins->width : end;
  for (size_t k = celd_basin_run (basins, x, y); x < end && status == CELD_OK; k++)
    {
      int next = celd_basin_run_end (basins, k, y);

      next = next < end ? next : end;
      if (basins->room[basins->run[k].basin] == room)
        status = celd_seed_rows_paint (&canvas->seeds, y, x, next, label);
      x = next;
    }
  return status;
}

/* A room that nothing reaches has no seed on its paper, and a disc holds no ink: there is nothing to spare. */
static CeldStatus
plant_disc (CeldCanvas *canvas, const CeldDisc *disc, uint32_t room, uint32_t label)
{
  int        r = (int) disc->radius, top = disc->y - r, bottom = disc->y + r, x, end;
  CeldStatus status = CELD_OK;

  bottom = bottom < canvas->basins->height ? bottom : canvas->basins->height - 1;
  for (int y = top < 0 ? 0 : top; y <= bottom && status == CELD_OK; y++)
    if (celd_disc_row (disc, y, &x, &end))
      status = paint_in_room (canvas, y, x, end, room, label);
  return status;
}

static uint32_t
room_of (const CeldBasins *basins, CeldRelationEnd end)
{
  return end.there ? basins->room[celd_basin_at (basins, end.x, end.y)] : 0;
}

static CeldStatus
plant_relation (const CeldRelation *relation, CeldCanvas *canvas)
{
  CeldRelationEnd    end[2] = { celd_end_find (canvas, &relation->nearer), celd_end_find (canvas, &relation->farther) };
  uint32_t   room[2] = { room_of (canvas->basins, end[0]), room_of (canvas->basins, end[1]) }, label = 0;
  double     widest = canvas->settings->method != CELD_METHOD_BASINS ? INFINITY : ON_BASINS;
  double     reach = room[0] == room[1] ? CELD_REACH * celd_ends_apart (end[0], end[1]) : INFINITY;
  CeldStatus status = CELD_OK;

  for (int i = 0; i < 2 && status == CELD_OK; i++)
    {
      CeldDiscs discs;

      if (!room[i] || canvas->reached[room[i]])
        continue;
      if (!label || !relation->equal)
        status = celd_hue_add (canvas, &label);
      discs = celd_discs_find (canvas, end[i], reach, widest);
      for (int k = 0; k < 2 && status == CELD_OK; k++)
        status = plant_disc (canvas, &discs.disc[k], room[i], label);
      canvas->reached[room[i]] = true;
    }
  return status;
}

bool
celd_seeds_wanted (const CeldCanvas *canvas, const CeldRelation *relation)
{
  uint32_t room[2] = { room_of (canvas->basins, celd_end_find (canvas, &relation->nearer)),
                       room_of (canvas->basins, celd_end_find (canvas, &relation->farther)) };

  return (room[0] && !canvas->reached[room[0]]) || (room[1] && !canvas->reached[room[1]]);
}

CeldStatus
celd_seeds_plant (const CeldRelations *relations, const CeldHost *host, CeldCanvas *canvas)
{
  CeldStatus status = CELD_OK;

  if (!relations->n)
    return CELD_OK;
  canvas->reached = celd_alloc0 (canvas->basins->n_rooms + 1, sizeof *canvas->reached);
  if (!canvas->reached)
    return CELD_NO_MEMORY;
  for (int y = 0; y < canvas->basins->height; y++)
    reach_along (canvas, y);
  for (size_t i = 0; i < relations->n && status == CELD_OK; i++)
    {
      if (celd_seeds_wanted (canvas, &relations->item[i]))
        {
          canvas->acting = i + 1;
          status = plant_relation (&relations->item[i], canvas);
        }
      if (status == CELD_OK && i % 256 == 0)
        status = celd_progress (host, (double) i / (double) relations->n);
    }
  return status;
}
