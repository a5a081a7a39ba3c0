/* Normals between outlines: n_x and n_y are harmonic on each body.
 *
 * Bodies may lie over each other.  Large ones are systems of their own; small ones, which are many, are laid out side
 * by side on shelves, and solved as one system.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "light/light.h"
#include "solve/laplace.h"

#include <stdlib.h>

#define NORMAL_AT_OUTLINE 2.f  /* weight between a pixel and its outline: 1 / distance, half a pixel */
#define FLAT_WEIGHT       1.f  /* weight that draws a pixel of the background towards the viewer (chosen) */
#define NORMALS_TOLERANCE 2e-3 /* largest error of n_x and n_y as a share of their range: less than a step of 8 bits */

#define LARGE             4000 /* pixels of a box that is solved alone: a system costs about as much (chosen) */

/* A body, and its place on the table. */
typedef struct { size_t number; int width, height, x, y; } Placed;

typedef struct
{
  CeldLumo             *lumo;
  size_t                n_creases;    /* the first constraints are those of creases */
  int                   width, height;
  size_t                n;            /* pixels of the table */
  uint8_t              *kind;
  float                *east, *south, *flat;
  float                *b, *x;        /* n_x, and behind it n_y */
  bool                  any;          /* whether anything bends */
  CeldNormalConstraints hidden;       /* of one body */
} Table;

/* ------------------------------------------------------------------ shelves */

static bool
is_large (const Placed *p)
{
  return (int64_t) p->width * p->height >= LARGE;
}

static int
compare_placed (const void *a, const void *b)
{
  const Placed *one = a, *other = b;

  if (is_large (one) != is_large (other))
    return is_large (one) ? -1 : 1;
  if (one->height != other->height)
    return one->height > other->height ? -1 : 1;
  return (one->number > other->number) - (one->number < other->number);
}

/* Lists the bodies that may bend: large ones, and then small ones, the highest first. */
static CeldStatus
list_bodies (const CeldLumo *l, Placed **list, size_t *n)
{
  *n    = 0;
  *list = celd_alloc (l->bodies.n, sizeof **list);
  if (!*list)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < l->bodies.n; k++)
    if (l->bodies.bends[k])
      (*list)[(*n)++] = (Placed) { .number = k, .width = l->bodies.box[k].width, .height = l->bodies.box[k].height };
  qsort (*list, *n, sizeof **list, compare_placed);
  return CELD_OK;
}

/* Places a large body on a table, or as many small ones as fit on a table of the size of the picture, from the first
 * one on; returns their number. */
static size_t
fill_table (const CeldLumo *l, Placed *list, size_t n, Table *t)
{
  int    x = 0, y = 0, height = 0;
  size_t k;

  t->width  = list->width;
  t->height = list->height;
  if (is_large (list))
    return 1;
  for (k = 0; k < n; k++)
    {
      if (x + list[k].width > l->width)
        {
          x  = 0;
          y += height;
        }
      height = x ? height : list[k].height;
      if (y + list[k].height > l->height)
        break;
      list[k].x = x;
      list[k].y = y;
      x += list[k].width;
      t->width  = x > t->width ? x : t->width;
      t->height = y + height;
    }
  return k;
}

/* ------------------------------------------------------------------ the system */

/* Loops over every run `s` of the components of the body of this number. */
#define EACH_SEEN_RUN(l, number, y, s) \
  CELD_EACH_RUN (&(l)->components, (l)->bodies.box[number].y, \
                 (l)->bodies.box[number].y + (l)->bodies.box[number].height, y, s) \
    if ((l)->bodies.of_component[s->component] == (number))

/* The index of a pixel of the picture in the planes of a body. */
static size_t
body_pixel (const CeldBody *body, int x, int y)
{
  return (size_t) (y - body->box.y) * body->stride + (size_t) (x - body->box.x);
}

/* Kinds and weights are freed once the system is set up. */
static CeldBody
body_on_table (const Table *t, const Placed *placed)
{
  size_t corner = (size_t) placed->y * (size_t) t->width + (size_t) placed->x;

  return (CeldBody) { .lumo = t->lumo, .box = t->lumo->bodies.box[placed->number], .stride = (size_t) t->width,
                      .kind = t->kind ? t->kind + corner : NULL, .east = t->east ? t->east + corner : NULL,
                      .south = t->south ? t->south + corner : NULL };
}

/* Where a body hides itself, what is seen counts. */
static void
mark_pixels (const CeldLumo *l, size_t number, CeldBody *body)
{
  for (size_t r = l->bodies.first[number]; r < l->bodies.first[number + 1]; r++)
    {
      const CeldHiddenRun *run = &l->bodies.hidden[r];

      memset (body->kind + body_pixel (body, run->x, run->y), CELD_HIDDEN_PART, (size_t) (run->end - run->x));
    }
  EACH_SEEN_RUN (l, number, y, s)
    memset (body->kind + body_pixel (body, s->x, y), CELD_SEEN, (size_t) (s->end - s->x));
}

/* Adds the constraints first .. end - 1 of a list to the system. */
static void
draw (Table *t, const Placed *placed, const CeldBody *body, const CeldNormalConstraints *list, size_t first, size_t end,
      CeldBodyKind kind)
{
  for (size_t k = first; k < end; k++)
    {
      const CeldNormalConstraint *c = &list->item[k];
      size_t                      w = (size_t) t->lumo->width, i;
      int                         x = (int) (c->pixel % w), y = (int) (c->pixel / w);

      if (celd_body_kind (body, x, y) != kind)
        continue;
      i = (size_t) placed->y * (size_t) t->width + (size_t) placed->x + body_pixel (body, x, y);
      t->flat[i]     += NORMAL_AT_OUTLINE;
      t->b[i]        += NORMAL_AT_OUTLINE * c->x;
      t->b[t->n + i] += NORMAL_AT_OUTLINE * c->y;
      t->any          = true;
    }
}

/* The background is drawn to the viewer, unless hints bend it. */
static void
flatten_page (Table *t, const Placed *placed, const CeldBody *body)
{
  const CeldLumo *l = t->lumo;

  if (!l->page || body->page_bends)
    return;
  EACH_SEEN_RUN (l, placed->number, y, s)
    for (int x = s->x; x < s->end; x++)
      if (celd_larger_label (l->own, x, y) == l->page)
        t->flat[(size_t) placed->y * (size_t) t->width + (size_t) placed->x + body_pixel (body, x, y)] = FLAT_WEIGHT;
}

static CeldStatus
write_body (Table *t, const Placed *placed)
{
  CeldNormalConstraints *seen = &t->lumo->constraints;
  CeldBody               body = body_on_table (t, placed);
  size_t                 first = seen->n;
  CeldStatus             status;

  mark_pixels (t->lumo, placed->number, &body);
  t->hidden.n = 0;
  status      = celd_body_outlines (&body, seen, &t->hidden);
  if (status != CELD_OK)
    return status;
  flatten_page (t, placed, &body);
  draw (t, placed, &body, seen, 0, t->n_creases, CELD_SEEN);
  draw (t, placed, &body, seen, first, seen->n, CELD_SEEN);
  draw (t, placed, &body, &t->hidden, 0, t->hidden.n, CELD_HIDDEN_PART);
  return CELD_OK;
}

static void
read_body (const Table *t, const Placed *placed)
{
  const CeldLumo *l = t->lumo;
  CeldBody        body = body_on_table (t, placed);

  EACH_SEEN_RUN (l, placed->number, y, s)
    {
      float *tilt = l->tilt + 2 * celd_lumo_pixel (l, s->x, y);
      size_t i = (size_t) placed->y * (size_t) t->width + (size_t) placed->x + body_pixel (&body, s->x, y);

      for (int x = s->x; x < s->end; x++, i++)
        {
          *tilt++ = t->x[i];
          *tilt++ = t->x[t->n + i];
        }
    }
}

/* ------------------------------------------------------------------ tables */

static void
free_weights (Table *t)
{
  celd_free (t->kind);
  celd_free (t->east);
  celd_free (t->south);
  celd_free (t->flat);
  t->kind = NULL;
  t->east = t->south = t->flat = NULL;
}

static void
table_clear (Table *t)
{
  free_weights (t);
  celd_free (t->b);
  celd_free (t->x);
  t->b = t->x = NULL;
}

static CeldStatus
table_new (Table *t)
{
  t->n     = (size_t) t->width * (size_t) t->height;
  t->any   = false;
  t->kind  = celd_alloc0 (t->n, 1);
  t->east  = celd_alloc0 (t->n, sizeof *t->east);
  t->south = celd_alloc0 (t->n, sizeof *t->south);
  t->flat  = celd_alloc0 (t->n, sizeof *t->flat);
  t->b     = celd_alloc0 (t->n, 2 * sizeof *t->b);
  t->x     = celd_alloc0 (t->n, 2 * sizeof *t->x);
  return t->kind && t->east && t->south && t->flat && t->b && t->x ? CELD_OK : CELD_NO_MEMORY;
}

/* Solves the n bodies of a table. */
static CeldStatus
solve_table (Table *t, const Placed *list, size_t n, const CeldHost *host)
{
  CeldLaplace *laplace = NULL;
  CeldHostPart part[2];
  CeldHost     setting_up = celd_host_part (&part[0], host, 0, 0.3), solving = celd_host_part (&part[1], host, 0.3, 1);
  CeldStatus   status = table_new (t);

  for (size_t k = 0; k < n && status == CELD_OK; k++)
    status = write_body (t, &list[k]);
  if (status == CELD_OK && t->any)
    {
      status = celd_lap_setup (t->width, t->height, t->east, t->south, t->flat, NULL, &setting_up, &laplace);
      free_weights (t); /* before the solution, which needs memory of its own */
    }
  if (status == CELD_OK && t->any)
    status = celd_lap_solve (laplace, 2, t->b, t->x, NORMALS_TOLERANCE, &solving, NULL);
  for (size_t k = 0; k < n && status == CELD_OK && t->any; k++)
    read_body (t, &list[k]);
  celd_lap_free (laplace);
  table_clear (t);
  return status;
}

static CeldStatus
solve_tables (CeldLumo *l, Placed *list, size_t n, const CeldHost *host)
{
  Table      t = { .lumo = l, .n_creases = l->constraints.n };
  CeldStatus status = CELD_OK;

  for (size_t first = 0; first < n && status == CELD_OK;)
    {
      CeldHostPart part;
      size_t       count = fill_table (l, list + first, n - first, &t);
      CeldHost     turn = celd_host_part (&part, host, (double) first / (double) n,
                                          (double) (first + count) / (double) n);

      status = solve_table (&t, list + first, count, &turn);
      first += count;
    }
  celd_free (t.hidden.item);
  return status;
}

/* ------------------------------------------------------------------ */

/* Constrains both sides of creases, but not of the background, unless they are painted. */
static CeldStatus
constrain_creases (CeldLumo *l)
{
  CeldNormalConstraints *list = &l->constraints;
  CeldStatus             status = CELD_OK;

  for (size_t i = 0; i < l->n_creases && status == CELD_OK; i++)
    {
      const CeldCrease *crease = &l->crease[i];
      size_t            p = crease->pixel, q = p + (crease->down ? (size_t) l->width : 1);
      int               x = (int) (p % (size_t) l->width), y = (int) (p / (size_t) l->width);

      if ((!crease->painted && celd_larger_label (l->own, x, y) == l->page) ||
          celd_has_detour (&l->links, x, y, crease->down))
        continue;
      for (int side = 0; side < 2 && status == CELD_OK; side++)
        {
          float s = side ? -crease->strength[1] : crease->strength[0];

          if (crease->strength[side] > 0)
            status = celd_append (list->item, list->n, list->capacity,
                                  (CeldNormalConstraint) { side ? q : p, s * crease->x, -s * crease->y });
        }
    }
  return status;
}

/* Bodies without a constraint face the viewer. */
CeldStatus
celd_lumo_solve (CeldLumo *l, const CeldHost *host)
{
  Placed    *list = NULL;
  size_t     n = 0;
  CeldStatus status = celd_pixel_links_new (l->width, l->height, l->east, l->south, &l->links);

  l->tilt = celd_alloc0 ((size_t) l->width * (size_t) l->height, 2 * sizeof *l->tilt);
  if (status == CELD_OK && !l->tilt)
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = constrain_creases (l);
  if (status == CELD_OK)
    status = list_bodies (l, &list, &n);
  if (status == CELD_OK)
    status = solve_tables (l, list, n, host);
  celd_free (list);
  return status;
}
