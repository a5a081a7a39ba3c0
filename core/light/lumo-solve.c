/* The normals between outlines: n_x and n_y are harmonic, each by itself.
 *
 * An outline runs on edges of pixels, half a pixel from the centres that it holds, hence the coupling 2.  What hangs
 * together and is held somewhere is solved in boxes, the rest of a box masked; everything else faces the viewer.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "light/lumo.h"
#include "solve/laplace.h"

#define COUPLING  2.f   /* of a pixel with its outline, 1 / distance */
#define FLAT      1.f   /* coupling of a pixel that shall face the viewer */
#define TOLERANCE 2e-3  /* largest error as a share of the range: less than a step of 8 bits */

typedef struct
{
  CeldLumo *lumo;
  CeldParts parts;              /* what the weights join */
  uint32_t *group;              /* of each part: which box it is solved in */
} Work;

/* The planes of one box; b and x hold n_x, then n_y. */
typedef struct { CeldRect box; uint32_t group; size_t n; float *east, *south, *diagonal, *b, *x; } Box;

#define EACH_STRETCH(parts, from, end, y, s) \
  for (int y = (from); y < (end); y++) \
    for (const CeldStretch *s = (parts)->stretch + (parts)->row[y], *end_ = (parts)->stretch + (parts)->row[y + 1]; \
         s < end_; s++)

#define EACH_OF_BOX(work, in, y, s) \
  EACH_STRETCH (&(work)->parts, (in)->box.y, (in)->box.y + (in)->box.height, y, s) \
    if ((work)->group[s->part] == (in)->group)

static size_t
in_box (const Box *box, int x, int y)
{
  return (size_t) (y - box->box.y) * (size_t) box->box.width + (size_t) (x - box->box.x);
}

static bool
covers (const CeldRect *box, int x, int y)
{
  return x >= box->x && y >= box->y && x < box->x + box->width && y < box->y + box->height;
}

static uint32_t
part_of (const CeldParts *parts, int x, int y)
{
  size_t low = parts->row[y], high = parts->row[y + 1];

  while (high - low > 1)
    {
      size_t middle = low + (high - low) / 2;

      if (parts->stretch[middle].x <= x)
        low = middle;
      else
        high = middle;
    }
  return parts->stretch[low].part;
}

/* ------------------------------------------------------------------ one box */

static void
write_weights (const Work *work, const Box *box)
{
  const CeldLumo *l = work->lumo;

  EACH_OF_BOX (work, box, y, s)
    {
      size_t p = celd_lumo_pixel (l, s->x, y), i = in_box (box, s->x, y), n = (size_t) (s->end - s->x);

      memcpy (box->east + i, l->east + p, n * sizeof *l->east);
      memcpy (box->south + i, l->south + p, n * sizeof *l->south);
    }
}

/* What is masked has no edge there: only pixels of the box's parts count. */
static void
write_holds (const Work *work, const Box *box)
{
  const CeldLumo *l = work->lumo;

  EACH_STRETCH (&l->regions, box->box.y, box->box.y + box->box.height, y, s)
    if (l->flat[s->part])
      for (int x = s->x > box->box.x ? s->x : box->box.x; x < s->end && x < box->box.x + box->box.width; x++)
        box->diagonal[in_box (box, x, y)] = FLAT;
  for (size_t k = 0; k < l->n_holds; k++)
    {
      int    x = (int) (l->hold[k].pixel % (size_t) l->width), y = (int) (l->hold[k].pixel / (size_t) l->width);
      size_t i;

      if (!covers (&box->box, x, y))
        continue;
      i = in_box (box, x, y);
      box->diagonal[i]   += COUPLING;
      box->b[i]          += COUPLING * l->hold[k].x;
      box->b[box->n + i] += COUPLING * l->hold[k].y;
    }
}

static void
read_box (const Work *work, const Box *box)
{
  EACH_OF_BOX (work, box, y, s)
    {
      float *tilt = work->lumo->tilt + 2 * celd_lumo_pixel (work->lumo, s->x, y);
      size_t i = in_box (box, s->x, y);

      for (int x = s->x; x < s->end; x++, i++)
        {
          *tilt++ = box->x[i];
          *tilt++ = box->x[box->n + i];
        }
    }
}

static CeldStatus
solve_box (const Work *work, Box *box, const CeldHost *host)
{
  int          w = box->box.width, h = box->box.height;
  CeldLaplace *laplace = NULL;
  CeldHostPart     part[2];
  CeldHost     setting_up = celd_host_part (&part[0], host, 0, 0.2), solving = celd_host_part (&part[1], host, 0.2, 1);
  CeldStatus   status;

  box->n        = (size_t) w * (size_t) h;
  box->east     = celd_alloc0 (box->n, sizeof *box->east);
  box->south    = celd_alloc0 (box->n, sizeof *box->south);
  box->diagonal = celd_alloc0 (box->n, sizeof *box->diagonal);
  box->b        = celd_alloc0 (box->n, 2 * sizeof *box->b);
  box->x        = celd_alloc0 (box->n, 2 * sizeof *box->x);
  status = box->east && box->south && box->diagonal && box->b && box->x ? CELD_OK : CELD_NO_MEMORY;
  if (status != CELD_OK)
    goto done;
  write_weights (work, box);
  write_holds (work, box);
  status = celd_lap_setup (w, h, box->east, box->south, box->diagonal, NULL, &setting_up, &laplace);
  celd_free (box->east);
  celd_free (box->south);
  celd_free (box->diagonal);
  box->east = box->south = box->diagonal = NULL;
  if (status == CELD_OK)
    status = celd_lap_solve (laplace, 2, box->b, box->x, TOLERANCE, &solving, NULL);
  if (status == CELD_OK)
    read_box (work, box);

done:
  celd_lap_free (laplace);
  celd_free (box->east);
  celd_free (box->south);
  celd_free (box->diagonal);
  celd_free (box->b);
  celd_free (box->x);
  return status;
}

/* ------------------------------------------------------------------ all of them */

/* The box of each part that anything holds; width 0 for the others. */
static void
find_boxes (const Work *work, uint8_t *held, CeldRect *box)
{
  const CeldLumo *l = work->lumo;

  for (size_t k = 0; k < l->n_holds; k++)
    held[part_of (&work->parts, (int) (l->hold[k].pixel % (size_t) l->width),
                  (int) (l->hold[k].pixel / (size_t) l->width))] = 1;
  EACH_STRETCH (&work->parts, 0, l->height, y, s)
    if (held[s->part])
      celd_box_add (&box[s->part], s, y);
}

static CeldStatus
solve_parts (Work *work, const CeldHost *host)
{
  CeldRect   bounds[CELD_MOST_GROUPS], *box = celd_alloc0 (work->parts.n, sizeof *box);
  uint8_t   *held = celd_alloc0 (work->parts.n, 1);
  size_t     groups = 0;
  CeldStatus status;

  work->group = celd_alloc (work->parts.n, sizeof *work->group);
  status      = box && held && work->group ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      find_boxes (work, held, box);
      groups = celd_boxes_group (box, work->parts.n, work->group, bounds);
    }
  for (size_t g = 0; g < groups && status == CELD_OK; g++)
    {
      CeldHostPart part;
      CeldHost share = celd_host_part (&part, host, (double) g / (double) groups, (double) (g + 1) / (double) groups);
      Box      one = { .box = bounds[g], .group = (uint32_t) g };

      status = solve_box (work, &one, &share);
    }
  celd_free (box);
  celd_free (held);
  return status;
}

CeldStatus
celd_lumo_solve (CeldLumo *l, const CeldHost *host)
{
  Work       work = { .lumo = l };
  CeldHostPart   part[2];
  CeldHost   finding = celd_host_part (&part[0], host, 0, 0.1), solving = celd_host_part (&part[1], host, 0.1, 1);
  CeldStatus status = celd_parts_find (l->width, l->height, l->level, NULL, &l->edges, &finding, &work.parts);

  if (status != CELD_OK)
    return status;
  l->tilt = celd_alloc0 ((size_t) l->width * (size_t) l->height, 2 * sizeof *l->tilt);
  status  = l->tilt ? solve_parts (&work, &solving) : CELD_NO_MEMORY;
  celd_parts_clear (&work.parts);
  celd_free (work.group);
  return status;
}
