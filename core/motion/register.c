/* As-rigid-as-possible registration of a drawing to another one [SDC09a] (section 3.4): moves the lattice of the source
 * so that its lines lie on those of the target.
 *
 * All of it is aligned rigidly; then, from coarse to fine, two phases alternate: each vertex is pushed to where the
 * block around it fits best, and all cells are made as rigid as possible.  At each scale the state that fitted best is
 * kept.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 * /
 */
#include "motion/motion.h"

#define PUSH_SIDE     48    /* pixels: the longer side of the coarsest scale is less than twice this; chosen */
#define POSE_SIDE     96    /* pixels: likewise of the scale on which poses are found; chosen */
#define PUSH_STEPS    40    /* at each scale; chosen */
#define PUSH_PATIENCE 5     /* steps without a better fit; chosen */
#define PUSH_GAIN     0.99  /* of the misfit so far; chosen */
#define PUSH_STILL    0.01  /* cells: mean motion that ends a scale; chosen */
#define SEAM_PULL     0.02f /* weight of the attraction across cracks, in multiples of the pull of a cell; chosen */
#define BLOCK_PULL    1.f   /* of a block with ink, likewise; chosen */

typedef struct
{
  CeldLattice        *lattice;
  const CeldSettings *settings;
  int32_t            *source, *target; /* squared distances to ink */
  int32_t            *nearest; /* ink of the source */
  const uint8_t      *hidden[2];
  CeldPull           *pull;
  float              *scratch, *best;
} Registration;

/* ------------------------------------------------------------------ one scale */

static double
mean_motion (const Registration *r, const float *before)
{
  double sum = 0;

  for (size_t v = 0; v < r->lattice->n_vertices; v++)
    sum += hypot ((double) (r->lattice->place[2 * v] - before[2 * v]),
                  (double) (r->lattice->place[2 * v + 1] - before[2 * v + 1]));
  return sum / (double) r->lattice->n_vertices;
}

static CeldStatus
register_scale (Registration *r, CeldMatcher *matcher, const CeldHost *host)
{
  CeldLattice *lattice = r->lattice;
  size_t       bytes = 2 * lattice->n_vertices * sizeof (float);
  float       *before = r->scratch + 3 * lattice->n_vertices;
  double       misfit, least = INFINITY;
  int          since = 0;
  CeldStatus   status = CELD_OK;

  for (int step = 0; step < PUSH_STEPS && since < PUSH_PATIENCE && status == CELD_OK; step++)
    {
      celd_matcher_push (matcher, host, r->pull, &misfit);
      since = misfit < PUSH_GAIN * least ? 0 : since + 1;
      if (misfit < least)
        {
          least = misfit;
          memcpy (r->best, lattice->place, bytes);
        }
      for (size_t v = 0; v < lattice->n_vertices; v++)
        r->pull[v].weight *= BLOCK_PULL;
      memcpy (before, lattice->place, bytes);
      celd_lattice_relax (lattice, r->settings->stiffness, r->pull, SEAM_PULL, r->scratch);
      if (mean_motion (r, before) < PUSH_STILL * lattice->side)
        break;
      status = celd_progress (host, (double) step / PUSH_STEPS);
    }
  celd_matcher_push (matcher, host, r->pull, &misfit);
  if (misfit >= least)
    memcpy (lattice->place, r->best, bytes);
  return status;
}

/* ------------------------------------------------------------------ the step */

/* The factor of the scale at which the longer side is at least `least` pixels, and less than twice that. */
static int
factor_for (const CeldLattice *lattice, int least)
{
  int side = lattice->width > lattice->height ? lattice->width : lattice->height, factor = 1;

  while (side / factor >= 2 * least)
    factor *= 2;
  return factor;
}

/* Aligns all, then each part, on a picture whose longer side is about POSE_SIDE pixels. */
static CeldStatus
find_poses (Registration *r, const CeldHost *host)
{
  CeldLattice    *lattice = r->lattice;
  CeldMatchImages images = { .factor = 0 };
  CeldMatcher    *matcher = NULL;
  CeldStatus      status = celd_match_images_new (lattice->width, lattice->height, r->source, r->nearest, r->target,
                                                  factor_for (lattice, POSE_SIDE), CELD_MATCH_REACH, &images);

  if (status == CELD_OK)
    status = celd_matcher_new (lattice, &images, &matcher);
  if (status == CELD_OK)
    status = celd_align (lattice, &images, matcher, host);
  if (status == CELD_OK)
    status = celd_swing (lattice, &images, host);
  celd_matcher_free (matcher);
  celd_match_images_clear (&images);
  return status;
}

static CeldStatus
register_scales (Registration *r, bool posed, const CeldHost *host, float *fit)
{
  CeldLattice *lattice = r->lattice;
  double       done = posed ? 0 : 0.4;
  CeldHostPart first;
  CeldHost     posing = celd_host_part (&first, host, 0, done);
  CeldStatus   status = posed ? CELD_OK : find_poses (r, &posing);

  for (int factor = factor_for (lattice, PUSH_SIDE); factor && status == CELD_OK; factor /= 2)
    {
      CeldMatchImages images = { .factor = 0 };
      CeldMatcher    *matcher = NULL;
      double          next = factor > 1 ? done + (1 - done) / 2 : 1;
      CeldHostPart    part;
      CeldHost        scale = celd_host_part (&part, host, done, next);

      status = celd_match_images_new (lattice->width, lattice->height, r->source, r->nearest, r->target, factor,
                                      CELD_MATCH_REACH, &images);
      memcpy (images.hidden, r->hidden, sizeof images.hidden);
      if (status == CELD_OK)
        status = celd_matcher_new (lattice, &images, &matcher);
      if (status == CELD_OK)
        status = register_scale (r, matcher, &scale);
      if (status == CELD_OK && factor == 1)
        celd_matcher_fit (matcher, fit);
      celd_matcher_free (matcher);
      celd_match_images_clear (&images);
      done = next;
    }
  return status;
}

/* ------------------------------------------------------------------ lines */

CeldStatus
celd_register_lines (CeldLineMarks source, CeldLineMarks target, bool posed, const CeldSettings *settings,
                     const CeldHost *host, CeldLattice *lattice, float *fit)
{
  size_t       n = (size_t) lattice->width * (size_t) lattice->height, vertices = lattice->n_vertices;
  Registration r = { .lattice = lattice, .settings = settings, .hidden = { source.hidden, target.hidden } };
  float       *start = celd_alloc (2 * vertices, sizeof *start);
  CeldHostPart part[2];
  CeldHost     measuring = celd_host_part (&part[0], host, 0, 0), registering = celd_host_part (&part[1], host, 0.1, 1);
  CeldStatus   status;

  r.source  = celd_alloc (n, sizeof *r.source);
  r.target  = celd_alloc (n, sizeof *r.target);
  r.nearest = celd_alloc (n, sizeof *r.nearest);
  r.pull    = celd_alloc (vertices, sizeof *r.pull);
  r.scratch = celd_alloc (5 * vertices, sizeof *r.scratch);
  r.best    = celd_alloc (2 * vertices, sizeof *r.best);
  status = r.source && r.target && r.nearest && r.pull && r.scratch && r.best && start ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      memcpy (start, lattice->place, 2 * vertices * sizeof *start);
      status = celd_distance (lattice->width, lattice->height, target.line, &measuring, r.target);
    }
  if (status == CELD_OK)
    status = celd_nearest (lattice->width, lattice->height, source.line, &measuring, r.source, r.nearest);
  if (status == CELD_OK && (r.source[0] == INT32_MAX || r.target[0] == INT32_MAX))
    status = CELD_NOTHING_TO_GO_BY;
  if (status == CELD_OK)
    {
      status = register_scales (&r, posed, &registering, fit);
      if (status != CELD_OK)
        memcpy (lattice->place, start, 2 * vertices * sizeof *start);
    }
  celd_free (r.source);
  celd_free (r.target);
  celd_free (r.nearest);
  celd_free (r.pull);
  celd_free (r.scratch);
  celd_free (r.best);
  celd_free (start);
  return status;
}

/* ------------------------------------------------------------------ drawings */

/* Spreads what is known of vertices over the others, and interpolates it in pixels; 0 outside and in folded cells. */
static void
paint_confidence (const CeldLattice *lattice, const float *fit, CeldPlane *confidence)
{
  for (int y = 0; y < confidence->height; y++)
    for (int x = 0; x < confidence->width; x++)
      {
        uint32_t c = celd_lattice_cell (lattice, x, y);
        float    sum = 0, n = 0;

        for (size_t k = 0; k < 4 && c; k++)
          {
            float f = fit[lattice->corner[4 * (c - 1) + k]];

            sum += f >= 0 ? f : 0;
            n   += f >= 0;
          }
        CELD_AT (confidence, x, y) = n > 0 && celd_cell_area (lattice, c - 1) > 0 ? sum / n : 0;
      }
}

static void
mark_ink (const CeldPlane *ink, uint8_t *mark)
{
  for (int y = 0; y < ink->height; y++)
    for (int x = 0; x < ink->width; x++)
      mark[(size_t) y * (size_t) ink->width + (size_t) x] = !celd_is_paper (CELD_AT (ink, x, y));
}

CeldStatus
celd_register (const CeldPlane *source, const CeldPlane *target, const CeldSettings *settings, const CeldHost *host,
               CeldLattice *lattice, CeldPlane *confidence)
{
  if (!CELD_SAME_SIZE (source, target) || source->width != lattice->width || source->height != lattice->height ||
      (confidence && !CELD_SAME_SIZE (source, confidence)))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;

  size_t     n = (size_t) source->width * (size_t) source->height;
  uint8_t   *mark = celd_alloc (n, 2);
  float     *fit = celd_alloc (lattice->n_vertices, sizeof *fit);
  CeldStatus status = mark && fit ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      mark_ink (source, mark);
      mark_ink (target, mark + n);
      status = celd_register_lines ((CeldLineMarks) { mark, NULL }, (CeldLineMarks) { mark + n, NULL }, false, settings,
                                    host, lattice, fit);
    }
  if (status == CELD_OK && confidence)
    paint_confidence (lattice, fit, confidence);
  celd_free (mark);
  celd_free (fit);
  return status;
}
