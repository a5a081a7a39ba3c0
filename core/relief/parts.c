/* All parts of a drawing, each inflated on its whole silhouette and in front of those that it hides.
 *
 * From back to front each part gets a seat on those behind it; then from front to back what another part hides is
 * pushed behind it, where it bulges more.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "relief/parts.h"

#include <math.h>

#define CLEARANCE 0.2 /* pixels between hidden and hiding meshes, beyond their errors; chosen */

static CeldStatus
behind_new (const CeldParts *parts, CeldBehind *behind)
{
  size_t n = (size_t) parts->width * (size_t) parts->height;

  behind->z   = celd_alloc0 (n, sizeof *behind->z);
  behind->top = celd_alloc0 (n, sizeof *behind->top);
  return behind->z && behind->top ? CELD_OK : CELD_NO_MEMORY;
}

static void
behind_clear (CeldBehind *behind)
{
  celd_free (behind->z);
  celd_free (behind->top);
}

/* ------------------------------------------------------------------ one part */

/* Puts a part whose seat is known in front of all before it. */
static void
put_in_front (const CeldParts *parts, size_t k, CeldBehind *behind)
{
  CeldPart *part = &parts->item[k];

  for (int y = 1; y < part->box.height - 1; y++)
    for (int x = 1; x < part->box.width - 1; x++)
      if (celd_part_has (part, x, y))
        {
          size_t i = celd_part_at (part, x, y);
          size_t p = (size_t) (part->box.y + y) * (size_t) parts->width + (size_t) (part->box.x + x);

          part->z[i]    += celd_part_seat_at (part, x, y);
          behind->z[p]   = part->z[i];
          behind->top[p] = (uint32_t) k + 1;
        }
}

static CeldStatus
make_part (const CeldParts *parts, size_t k, int stroke, const CeldSettings *settings, double rise,
           const CeldHost *host, CeldBehind *behind)
{
  CeldPart    *part = &parts->item[k];
  CeldHostPart share[2];
  CeldHost     inflating = celd_host_part (&share[0], host, 0, 0.9), seating = celd_host_part (&share[1], host, 0.9, 1);
  CeldStatus   status = celd_part_shape (parts, k, settings->ink_threshold);

  if (status != CELD_OK || part->page)
    return status;
  part->z = celd_alloc ((size_t) part->box.width * (size_t) part->box.height, sizeof *part->z);
  status  = part->z ? celd_part_inflate (parts, k, stroke, (double) settings->tolerance, &inflating)
                    : CELD_NO_MEMORY;
  for (size_t i = 0; i < (size_t) part->box.width * (size_t) part->box.height && status == CELD_OK; i++)
    part->z[i] *= settings->relief_bulge;
  part->size *= (double) settings->relief_bulge;
  if (status == CELD_OK)
    status = celd_part_sit (parts, k, behind, rise, &seating);
  if (status == CELD_OK)
    put_in_front (parts, k, behind);
  return status;
}

/* ------------------------------------------------------------------ cuts */

/* Finds where depth is cut between the levels of the parts that are seen. */
static CeldStatus
find_cuts (const CeldPlane *borders, int stroke, const CeldSettings *settings, const CeldHost *host,
           CeldParts *parts)
{
  size_t         n = (size_t) parts->width * (size_t) parts->height;
  float         *level = celd_alloc (n, sizeof *level), *east = celd_alloc (n, sizeof *east);
  float         *south = celd_alloc (n, sizeof *south), *next = level;
  uint8_t       *cut = NULL;
  CeldHostPart   share[2];
  CeldHost       holding = celd_host_part (&share[0], host, 0, 0.5), rest = celd_host_part (&share[1], host, 0.5, 1);
  CeldDepthEdges edges;
  CeldStatus     status = level && east && south ? CELD_OK : CELD_NO_MEMORY;

  for (int y = 0; y < parts->height && status == CELD_OK; y++)
    for (int x = 0; x < parts->width; x++)
      *next++ = (float) parts->sheets->item[celd_part_seen (parts, x, y)].level;
  if (status == CELD_OK)
    status = celd_depth_edges (parts->ink, borders, level, stroke, settings, &holding, &edges, &cut);
  if (status == CELD_OK)
    status = celd_depth_weights (&edges, level, &rest, east, south);
  if (status == CELD_OK)
    status = celd_pixel_links_new (parts->width, parts->height, east, south, &parts->links);
  celd_free (level);
  celd_free (east);
  celd_free (south);
  celd_free (cut);
  return status;
}

/* ------------------------------------------------------------------ hidden parts */

/* Pushes what the parts in front of this one hide behind them; `ceiling` is the lowest of these. */
static void
push_behind (const CeldParts *parts, CeldPart *part, float clearance, float *ceiling)
{
  for (int y = 1; y < part->box.height - 1 && !part->page; y++)
    for (int x = 1; x < part->box.width - 1; x++)
      if (celd_part_has (part, x, y))
        {
          float *z = &part->z[celd_part_at (part, x, y)];
          float *least = &ceiling[(size_t) (part->box.y + y) * (size_t) parts->width + (size_t) (part->box.x + x)];

          *z     = fminf (*z, *least - clearance);
          *least = *z;
        }
}

/* ------------------------------------------------------------------ */

CeldStatus
celd_parts_new (const CeldSheets *sheets, const CeldOwnership *own, const CeldPlane *ink, const CeldPlane *borders,
                const CeldSettings *settings, const CeldHost *host, CeldParts *parts)
{
  size_t       pixels = (size_t) sheets->width * (size_t) sheets->height;
  double       most = 1, rise;
  int          stroke = celd_stroke_width (ink);
  float       *ceiling = celd_alloc (pixels, sizeof *ceiling);
  CeldBehind   behind = { 0 };
  CeldHostPart half[2];
  CeldHost     cutting = celd_host_part (&half[0], host, 0, 0.1), making = celd_host_part (&half[1], host, 0.1, 1);
  CeldStatus   status;

  *parts = (CeldParts) { .width = sheets->width, .height = sheets->height, .sheets = sheets, .own = own, .ink = ink };
  parts->item = celd_alloc0 (sheets->n, sizeof *parts->item);
  status = ceiling && parts->item ? behind_new (parts, &behind) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = find_cuts (borders, stroke, settings, &cutting, parts);
  for (size_t k = 0; k < sheets->n; k++)
    most = fmax (most, sheets->item[k].level);
  rise = (double) settings->relief_depth * hypot (sheets->width, sheets->height) / most;
  for (; parts->n < sheets->n && status == CELD_OK; parts->n++)
    {
      CeldHostPart share;
      CeldHost     turn = celd_host_part (&share, &making, (double) parts->n / (double) sheets->n,
                                          (double) (parts->n + 1) / (double) sheets->n);

      status = make_part (parts, parts->n, stroke, settings, rise, &turn, &behind);
    }
  for (size_t p = 0; p < pixels && status == CELD_OK; p++)
    ceiling[p] = INFINITY;
  for (size_t k = parts->n; k-- > 0 && status == CELD_OK;)
    push_behind (parts, &parts->item[k], (float) (2 * (double) settings->mesh_error + CLEARANCE), ceiling);
  behind_clear (&behind);
  celd_free (ceiling);
  return status;
}

void
celd_parts_clear (CeldParts *parts)
{
  for (size_t k = 0; k < parts->n; k++)
    {
      celd_free (parts->item[k].coverage);
      celd_free (parts->item[k].open);
      celd_free (parts->item[k].z);
      celd_free (parts->item[k].seat.z);
    }
  celd_free (parts->item);
  celd_pixel_links_clear (&parts->links);
  *parts = (CeldParts) { .width = 0 };
}
