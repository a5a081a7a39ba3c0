/* What the exact program keeps between edits: weights, nodes, bases and stiffness.
 *
 * Another drawing invalidates everything; for other scribbles the solver starts from the present bases; a relation with
 * a new end off every scribble takes one solution; all other edits take none.  Ends that no relation uses any more stay
 * nodes, without effect on depth, in case they are used again, until there are more than MOST_SPARE of them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "image/image.h"

#define MOST_ADDED 8 /* new points at once; for more it takes no longer to solve for all nodes, CELD_LANES at a time */
#define MOST_SPARE 8 /* points that no relation uses (chosen) */

CeldProgram *
celd_program_new (void)
{
  return celd_alloc0 (1, sizeof (CeldProgram));
}

/* Frees everything but the weights. */
static void
forget_nodes (CeldProgram *p)
{
  celd_bases_clear (&p->bases);
  celd_free (p->nodes.data);
  celd_palette_clear (&p->palette);
  celd_free (p->label);
  p->nodes = (CeldLabels) { 0 };
  p->label = NULL;
}

static void
forget_ink (CeldProgram *p)
{
  forget_nodes (p);
  celd_free (p->east);
  celd_free (p->south);
  celd_free (p->held);
  p->ink    = NULL;
  p->east   = p->south = NULL;
  p->held   = NULL;
  p->n_held = 0;
}

void
celd_program_free (CeldProgram *program)
{
  if (!program)
    return;
  forget_ink (program);
  celd_free (program);
}

/* ------------------------------------------------------------------ drawing and scribbles */

CeldStatus
celd_program_set_ink (CeldProgram *program, const CeldPlane *ink, const CeldSettings *settings, const CeldHost *host)
{
  CeldProgram *p = program;
  size_t       pixels = (size_t) ink->width * (size_t) ink->height;
  CeldStatus   status;

  forget_ink (p);
  p->east  = celd_alloc (pixels, sizeof *p->east);
  p->south = celd_alloc (pixels, sizeof *p->south);
  status   = p->east && p->south ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_affinities (ink, settings->contrast, settings->weight_floor, host, p->east, p->south, &p->sigma);
  if (status != CELD_OK)
    {
      forget_ink (p);
      return status;
    }
  p->sigma *= (double) settings->contrast;
  p->ink    = ink;
  p->stroke = -1;
  p->bases  = (CeldHarmonicBases) { .width = ink->width, .height = ink->height, .east = p->east, .south = p->south };
  return CELD_OK;
}

/* A tight copy; numbers that are no labels become 0. */
static CeldStatus
copy_seeds (const CeldLabels *seeds, size_t n_labels, CeldLabels *nodes)
{
  CeldStatus status = celd_labels_new (seeds->width, seeds->height, nodes);

  for (int y = 0; status == CELD_OK && y < seeds->height; y++)
    for (int x = 0; x < seeds->width; x++)
      CELD_AT (nodes, x, y) = CELD_AT (seeds, x, y) <= n_labels ? CELD_AT (seeds, x, y) : 0;
  return status;
}

CeldStatus
celd_program_set_seeds (CeldProgram *program, const CeldLabels *seeds, const CeldPalette *palette,
                        CeldSameColour same_colour, const CeldHost *host)
{
  CeldProgram *p = program;
  CeldLabels   nodes = { 0 };
  CeldPalette  made = { 0 };
  uint32_t    *label = NULL;
  size_t       bytes = (size_t) seeds->width * (size_t) seeds->height * sizeof *nodes.data;
  CeldStatus   status = copy_seeds (seeds, palette->n, &nodes);

  if (status == CELD_OK)
    status = celd_palette_copy (palette, &made);
  if (status == CELD_OK)
    status = same_colour == CELD_SAME_COLOUR_SEPARATE ? celd_separate (host, &nodes, &made)
                                                      : celd_palette_measure (&nodes, NULL, host, &made);
  if (status == CELD_OK && !(label = celd_alloc (made.n, sizeof *label)))
    status = CELD_NO_MEMORY;
  if (status != CELD_OK)
    {
      celd_free (nodes.data);
      celd_palette_clear (&made);
      return status;
    }
  for (size_t k = 0; k < made.n; k++)
    label[k] = k < palette->n ? (uint32_t) k + 1 : CELD_AT (seeds, made.item[k].x, made.item[k].y);
  p->stale = p->stale || !p->nodes.data || p->palette.n != made.n || memcmp (p->nodes.data, nodes.data, bytes);
  celd_free (p->nodes.data);
  celd_palette_clear (&p->palette);
  celd_free (p->label);
  p->nodes   = nodes;
  p->palette = made;
  p->label   = label;
  return CELD_OK;
}

/* ------------------------------------------------------------------ ends of relations */

bool
celd_program_find (CeldProgram *program, double x, double y, size_t *pixel)
{
  CeldProgram *p = program;
  int          px, py;

  if (!(x >= 0 && y >= 0 && x < p->ink->width && y < p->ink->height)) /* false for NaN */
    return false;
  px = (int) x;
  py = (int) y;
  if (!CELD_AT (&p->nodes, px, py) && !celd_is_paper (CELD_AT (p->ink, px, py)))
    {
      if (p->stroke < 0)
        p->stroke = celd_stroke_width (p->ink);
      celd_paper_near (p->ink, p->stroke, &px, &py);
    }
  *pixel = (size_t) py * (size_t) p->ink->width + (size_t) px;
  return true;
}

/* Makes all bases: for the scribbles, and for the points that are on none. */
static CeldStatus
make_all (CeldProgram *p, const size_t *point, size_t n_points, double tolerance, const CeldHost *host)
{
  size_t    *free_point = celd_alloc (n_points, sizeof *free_point), n = 0;
  CeldStatus status;

  if (!free_point)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < n_points; i++)
    if (!p->nodes.data[point[i]])
      free_point[n++] = point[i];
  p->stale = true;
  status   = celd_bases_make (&p->bases, p->nodes.data, (uint32_t) p->palette.n, free_point, n, tolerance,
                              host, &p->solve);
  if (status == CELD_OK)
    {
      p->stale     = false;
      p->tolerance = tolerance;
    }
  celd_free (free_point);
  return status;
}

/* Removes the oldest unused points if there are too many. */
static CeldStatus
drop_spare (CeldProgram *p, const size_t *point, size_t n_points)
{
  CeldHarmonicBases *b = &p->bases;
  bool              *wanted = celd_alloc0 ((size_t) b->n + 1, sizeof *wanted);
  size_t             spare = 0;

  if (!wanted)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < n_points; i++)
    wanted[b->node[point[i]]] = true;
  for (uint32_t k = b->n_sets + 1; k <= b->n; k++)
    spare += !wanted[k];
  for (uint32_t k = b->n_sets + 1; k <= b->n && spare > MOST_SPARE; k++)
    while (k > 1 && k <= b->n && !wanted[k] && spare > MOST_SPARE)
      {
        wanted[k] = wanted[b->n];
        celd_bases_drop (b, k);
        spare--;
      }
  celd_free (wanted);
  return CELD_OK;
}

/* Adds bases for new points. */
static CeldStatus
add_points (CeldProgram *p, const size_t *point, size_t n_points, double tolerance, const CeldHost *host)
{
  size_t    *fresh = celd_alloc (n_points, sizeof *fresh), n = 0;
  CeldSolve  solve = { .converged = true };
  CeldStatus status = fresh ? drop_spare (p, point, n_points) : CELD_NO_MEMORY;

  for (size_t i = 0; i < n_points && status == CELD_OK; i++)
    if (!p->bases.node[point[i]])
      fresh[n++] = point[i];
  if (status == CELD_OK)
    status = celd_bases_add (&p->bases, fresh, n, tolerance, host, &solve);
  p->solve.converged = p->solve.converged && solve.converged;
  celd_free (fresh);
  return status;
}

CeldStatus
celd_program_place (CeldProgram *program, const size_t *point, size_t n_points, double tolerance, const CeldHost *host)
{
  CeldProgram *p = program;
  size_t       fresh = 0;

  for (size_t i = 0; p->bases.n && i < n_points; i++)
    fresh += !p->bases.node[point[i]];
  if (!p->bases.n || p->stale || fresh > MOST_ADDED || tolerance < p->tolerance)
    return make_all (p, point, n_points, tolerance, host);
  return fresh ? add_points (p, point, n_points, tolerance, host) : CELD_OK;
}
