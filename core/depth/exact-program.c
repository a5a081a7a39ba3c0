/* The exact program, eq. (1) and (2): the depth of least energy that satisfies all equalities and inequalities.
 *
 * The paper abandons this quadratic program because an active-set method takes tens of seconds on small pictures.  But
 * all pixels follow harmonically from those that relations name, so it can be reduced to a program with one variable
 * for each node: a scribble, or an end of a relation off every scribble.  Harmonic bases (exact-bases.c) and their
 * stiffness matrix (exact-stiffness.c) are made once; then a dense dual active-set method (solve/quadratic.c) takes
 * microseconds, and depth is a sum of bases.  Equalities merge nodes.
 *
 * The program is infeasible only if inequalities form a cycle between the same nodes.  Cycles are found on the graph of
 * nodes, and reported, as for the depth order (order/).  A cycle between regions, through different points of them, is
 * feasible: depth varies within the regions.
 *
 * Beyond the paper: the gap of a relation is a factor of the paper's epsilon; the background lies weakly behind every
 * other scribble.  Points keep their place: an end of a relation on the background is not in front of it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "depth/depth.h"
#include "image/image.h"
#include "order/order.h"
#include "solve/quadratic.h"

#include <math.h>

#define LEAST_RELATION_GAP   1e-6 /* of one relation, as a factor of epsilon (chosen) */
#define LARGEST_RELATION_GAP 1000

/* The relations between nodes. */
typedef struct
{
  CeldRelations   relations;    /* points on ink are moved beside it */
  size_t         *point;        /* pixels off every scribble */
  size_t          n_points;
  CeldPalette     palette;      /* of all nodes; points have no colour */
  CeldGraph       graph;
  CeldOrder       order;        /* only its cycles are used */
  uint32_t       *class;        /* of each node: nodes of equal depth, from 0 */
  size_t          n_classes;
  CeldInequality *inequality;   /* between classes */
  size_t          n;
  double         *stiffness;    /* between classes */
  double         *value, *u;    /* depths of classes and of nodes */
  CeldCertificate certificate;
  size_t          point_capacity, inequality_capacity;
} Problem;

static void
problem_clear (Problem *q)
{
  celd_relations_clear (&q->relations);
  celd_free (q->point);
  celd_palette_clear (&q->palette);
  celd_graph_clear (&q->graph);
  celd_order_clear (&q->order);
  celd_free (q->class);
  celd_free (q->inequality);
  celd_free (q->stiffness);
  celd_free (q->value);
  celd_free (q->u);
}

/* ------------------------------------------------------------------ nodes */

/* Whether a relation's end names a node or a pixel that can become one.  Moves it off the ink. */
static bool
find_term (CeldProgram *p, CeldTerm *term, size_t *pixel)
{
  size_t w = (size_t) p->ink->width;

  if (term->by_colour)
    return celd_palette_find (&p->palette, term->colour) != 0;
  if (!celd_program_find (p, term->x, term->y, pixel))
    return false;
  term->x = (double) (*pixel % w) + 0.5;
  term->y = (double) (*pixel / w) + 0.5;
  return true;
}

static CeldStatus
add_point (const CeldProgram *p, size_t pixel, Problem *q)
{
  if (p->nodes.data[pixel])
    return CELD_OK;
  for (size_t i = 0; i < q->n_points; i++)
    if (q->point[i] == pixel)
      return CELD_OK;
  return celd_append (q->point, q->n_points, q->point_capacity, pixel);
}

/* Copies the relations, with ends moved off the ink, and lists the ends that are off every scribble. */
static CeldStatus
find_points (CeldProgram *p, const CeldRelations *relations, Problem *q)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < relations->n && status == CELD_OK; i++)
    {
      CeldRelation r = relations->item[i];
      size_t       near = 0, far = 0;
      bool         good = find_term (p, &r.nearer, &near);

      good = find_term (p, &r.farther, &far) && good;
      status = celd_relation_add (&q->relations, r);
      if (status == CELD_OK && good && !r.nearer.by_colour)
        status = add_point (p, near, q);
      if (status == CELD_OK && good && !r.farther.by_colour)
        status = add_point (p, far, q);
    }
  return status;
}

/* The palette of scribbles and points. */
static CeldStatus
name_nodes (const CeldProgram *p, Problem *q)
{
  size_t     n = p->bases.n;
  CeldStatus status = celd_palette_copy (&p->palette, &q->palette);

  while (status == CELD_OK && q->palette.n < n)
    {
      size_t      pixel = p->bases.pixel[q->palette.n - p->bases.n_sets], w = (size_t) p->ink->width;

      if (celd_append_uncounted (q->palette.item, q->palette.n,
                                 (CeldRegion) { .x = (int) (pixel % w), .y = (int) (pixel / w), .area = 1 }) != CELD_OK)
        return CELD_NO_MEMORY;
    }
  return status;
}

/* ------------------------------------------------------------------ relations between nodes */

/* Replaces numbers of nodes in problems by labels; points have none. */
static void
rename_labels (const CeldProgram *p, size_t first, CeldProblems *problems)
{
  for (size_t i = first; problems && i < problems->n; i++)
    if (problems->item[i].label)
      problems->item[i].label = problems->item[i].label <= p->palette.n ? p->label[problems->item[i].label - 1] : 0;
}

static CeldStatus
report_cycles (const CeldLabels *nodes, const Problem *q, CeldProblems *problems)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < q->order.n_cycles && status == CELD_OK; i++)
    {
      size_t      left    = q->order.cycle[i].item[0];
      CeldProblem problem = { .kind = CELD_PROBLEM_CONTRADICTION, .other = (uint32_t) i, .relation = left };

      celd_relation_place (nodes, &q->palette, &q->relations.item[left], &problem.x, &problem.y);
      status = celd_problem_add (problems, problem);
    }
  return status;
}

/* Chooses the relations that can hold together; reports cycles. */
static CeldStatus
settle_relations (const CeldProgram *p, const CeldSettings *settings, const CeldHost *host, Problem *q,
                  CeldProblems *problems)
{
  const CeldHarmonicBases *b = &p->bases;
  CeldLabels               nodes = { b->width, b->height, (size_t) b->width, b->node };
  size_t                   before = problems ? problems->n : 0;
  CeldStatus               status = celd_graph_new (&nodes, &q->palette, &q->relations, NULL, &q->graph, problems);

  if (status != CELD_OK)
    return status;
  rename_labels (p, before, problems);
  status = celd_graph_resolve (&q->graph, settings->on_cycle, host, &q->order);
  return status == CELD_OK ? report_cycles (&nodes, q, problems) : status;
}

/* Numbers the classes of nodes that equalities merge. */
static CeldStatus
merge_nodes (const CeldProgram *p, Problem *q)
{
  const CeldGraph *g = &q->graph;
  uint32_t        *parent = celd_alloc (p->bases.n, sizeof *parent);

  q->class = celd_alloc (p->bases.n, sizeof *q->class);
  if (!parent || !q->class)
    {
      celd_free (parent);
      return CELD_NO_MEMORY;
    }
  celd_roots (parent, p->bases.n);
  for (size_t i = 0; i < g->n_links; i++)
    if (g->kept[i] && celd_graph_equal (g, i))
      for (size_t e = g->first[2 * i] + 1; e < g->first[2 * i + 2]; e++)
        celd_join (parent, g->end[e - 1], g->end[e]);
  for (uint32_t k = 0; k < p->bases.n; k++)
    q->class[k] = parent[k] == k ? (uint32_t) q->n_classes++ : q->class[celd_root (parent, k)];
  celd_free (parent);
  return CELD_OK;
}

/* Adds the inequalities of a link: each of its nearer nodes in front of each farther one. */
static CeldStatus
add_inequalities (const CeldProgram *p, size_t link, Problem *q)
{
  const CeldGraph *g = &q->graph;
  const size_t    *f = &g->first[2 * link];
  bool             weak = link == g->relations->n;
  double           gap  = weak ? 1 : g->relations->item[link].gap;

  gap = gap > 0 ? fmin (fmax (gap, LEAST_RELATION_GAP), LARGEST_RELATION_GAP) : 1; /* NaN: 1 */
  for (size_t near = f[1]; near < f[2]; near++)
    for (size_t far = f[0]; far < f[1] && !(weak && g->end[near] >= p->palette.n); far++)
      {
        if (celd_append (q->inequality, q->n, q->inequality_capacity,
                         (CeldInequality) { q->class[g->end[near]], q->class[g->end[far]], gap }) != CELD_OK)
          return CELD_NO_MEMORY;
      }
  return CELD_OK;
}

/* ------------------------------------------------------------------ the program */

static CeldStatus
solve_program (const CeldProgram *p, Problem *q)
{
  size_t     n = p->bases.n, m = q->n_classes;
  CeldStatus status;

  q->stiffness = celd_alloc0 (m, m * sizeof *q->stiffness);
  q->value     = celd_alloc (m, sizeof *q->value);
  q->u         = celd_alloc (n, sizeof *q->u);
  if (!q->stiffness || !q->value || !q->u)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < n; j++)
      q->stiffness[q->class[i] * m + q->class[j]] += p->bases.stiffness[i * n + j];
  status = celd_quadratic (m, q->stiffness, q->n, q->inequality, q->value, NULL, &q->certificate);
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    q->u[i] = q->value[q->class[i]];
  return status;
}

/* Shifts depths such that the least is 0; *range becomes the largest.  Nodes hidden by other paint are ignored. */
static void
shift_depths (size_t n, const CeldPalette *palette, double *u, double *range)
{
  double low = INFINITY, high = -INFINITY;

  for (size_t k = 0; k < n; k++)
    if (palette->item[k].area)
      {
        low  = fmin (low, u[k]);
        high = fmax (high, u[k]);
      }
  for (size_t k = 0; k < n; k++)
    u[k] = fmax (u[k] - low, 0);
  *range = high - low;
}

/* Depth in the encoding of the settings. */
static double
encode (double depth, double range, const CeldSettings *s)
{
  switch (s->encoding)
    {
    case CELD_ENCODING_RANK:  return depth;
    case CELD_ENCODING_FIXED: return (depth - (double) s->far_level) / ((double) s->near_level - (double) s->far_level);
    default:                  return range > 0 ? depth / range : 0;
    }
}

static double
worst_violation (const Problem *q)
{
  double worst = 0;

  for (size_t i = 0; i < q->n; i++)
    worst = fmax (worst, q->inequality[i].gap - (q->value[q->inequality[i].a] - q->value[q->inequality[i].b]));
  return worst;
}

/* Fills in the report; moves the cycles there. */
static CeldStatus
write_report (const CeldProgram *p, Problem *q, CeldExact *exact)
{
  size_t    n = p->bases.n;
  CeldNode *node = celd_alloc (n, sizeof *node);

  if (!node)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < n; k++)
    node[k] = (CeldNode) { k < p->palette.n ? p->label[k] : 0, q->palette.item[k].x, q->palette.item[k].y, q->u[k] };
  *exact = (CeldExact) {
    .node = node, .n = n, .sigma = p->sigma, .energy = q->certificate.energy, .gap = q->certificate.gap,
    .violation = worst_violation (q), .inequalities = q->n, .active = q->certificate.active,
    .steps = q->certificate.steps, .solve = p->solve, .cycle = q->order.cycle, .n_cycles = q->order.n_cycles,
    .scc = q->order.scc, .n_sccs = q->order.n_sccs,
  };
  q->order = (CeldOrder) { 0 };
  return CELD_OK;
}

/* Encodes the depths of the nodes, and composes those of all pixels. */
static CeldStatus
compose (const CeldProgram *p, Problem *q, double range, const CeldSettings *settings, const CeldHost *host,
         CeldPlane *depth)
{
  for (size_t k = 0; k < p->bases.n; k++)
    q->u[k] = encode (q->u[k], range, settings);
  return celd_bases_compose (&p->bases, q->u, host, depth);
}

CeldStatus
celd_program_solve (CeldProgram *program, const CeldRelations *relations, const CeldSettings *settings,
                    const CeldHost *host, CeldPlane *depth, CeldExact *exact, CeldProblems *problems)
{
  CeldProgram *p = program;
  Problem      q = { 0 };
  CeldExact    report = { 0 };
  size_t       before = problems ? problems->n : 0, painted = 0;
  double       range = 0;
  CeldHostPart part[2];
  CeldHost     placing = celd_host_part (&part[0], host, 0, 0.97);
  CeldHost     ordering = celd_host_part (&part[1], host, 0.97, 0.98);
  CeldStatus   status = find_points (p, relations, &q);

  for (size_t k = 0; k < p->palette.n; k++)
    painted += p->palette.item[k].area;
  if (status == CELD_OK && !painted && !q.n_points)
    status = CELD_NOTHING_TO_GO_BY;
  if (status == CELD_OK)
    status = celd_program_place (p, q.point, q.n_points, (double) settings->tolerance, &placing);
  if (status == CELD_OK)
    status = name_nodes (p, &q);
  if (status == CELD_OK)
    status = settle_relations (p, settings, &ordering, &q, problems);
  if (status == CELD_OK)
    status = merge_nodes (p, &q);
  for (size_t i = 0; i < q.graph.n_links && status == CELD_OK; i++)
    if (q.graph.kept[i] && !celd_graph_equal (&q.graph, i))
      status = add_inequalities (p, i, &q);
  if (status == CELD_OK)
    status = solve_program (p, &q);
  if (status == CELD_OK)
    {
      shift_depths (p->bases.n, &q.palette, q.u, &range);
      status = write_report (p, &q, &report);
    }
  if (status == CELD_OK && !p->solve.converged)
    status = celd_problem_add (problems, (CeldProblem) {
      .kind = CELD_PROBLEM_NOT_CONVERGED, .x = -1, .y = -1, .relation = CELD_NO_INDEX });
  if (status == CELD_OK)
    status = celd_progress (host, 0.98);
  if (status == CELD_OK)
    status = compose (p, &q, range, settings, host, depth);
  if (status == CELD_OK && exact)
    {
      celd_exact_clear (exact);
      *exact = report;
      report   = (CeldExact) { 0 };
    }
  if (status != CELD_OK && problems)
    problems->n = before;
  celd_exact_clear (&report);
  problem_clear (&q);
  return status;
}

CeldStatus
celd_depth_exact (const CeldPlane *ink, const CeldLabels *seeds, const CeldPalette *palette,
                  const CeldRelations *relations, const CeldSettings *settings, const CeldHost *host, CeldPlane *depth,
                  CeldExact *exact, CeldProblems *problems)
{
  const CeldRelations none = { 0 };
  CeldProgram        *program;
  CeldHostPart        part[3];
  CeldHost            weighing = celd_host_part (&part[0], host, 0, 0.04);
  CeldHost            reading = celd_host_part (&part[1], host, 0.04, 0.05);
  CeldHost            solving  = celd_host_part (&part[2], host, 0.05, 1);
  CeldStatus          status;

  if (!CELD_SAME_SIZE (ink, seeds) || !CELD_SAME_SIZE (ink, depth))
    return CELD_BAD_SIZE;
  status = celd_settings_check (settings);
  if (status != CELD_OK)
    return status;
  program = celd_program_new ();
  status  = program ? celd_program_set_ink (program, ink, settings, &weighing) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_program_set_seeds (program, seeds, palette, settings->same_colour, &reading);
  if (status == CELD_OK)
    status = celd_program_solve (program, relations ? relations : &none, settings, &solving, depth, exact, problems);
  celd_program_free (program);
  return status;
}
