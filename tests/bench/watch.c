/* Measures steps within core: the program is linked with --wrap, which calls the functions below instead of core's.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"
#include "solve/maxflow.h"
#include "solve/partition.h"

#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ the exact cuts */

CeldStatus __real_celd_multiway (const CeldMultiway *m, const CeldHost *host, uint32_t *label);
CeldStatus __wrap_celd_multiway (const CeldMultiway *m, const CeldHost *host, uint32_t *label);
CeldStatus __real_celd_maxflow (int width, int height, const int32_t *east, const int32_t *south,
                                const int32_t *terminal, const CeldHost *host, uint8_t *side, int64_t *flow);
CeldStatus __wrap_celd_maxflow (int width, int height, const int32_t *east, const int32_t *south,
                                const int32_t *terminal, const CeldHost *host, uint8_t *side, int64_t *flow);

bool    keep_problem, use_boost;
Problem problem;

void
problem_clear (void)
{
  free (problem.east);
  free (problem.south);
  free (problem.vote);
  free (problem.seed);
  free (problem.order);
  problem = (Problem) { 0 };
}

static void *
copy (const void *from, size_t count, size_t size)
{
  void *to = malloc (count * size);

  if (!to)
    abort ();
  return memcpy (to, from, count * size);
}

CeldStatus
__wrap_celd_multiway (const CeldMultiway *m, const CeldHost *host, uint32_t *label)
{
  size_t n = (size_t) m->width * (size_t) m->height;

  if (keep_problem)
    {
      problem_clear ();
      problem = (Problem) {
        m->width, m->height, copy (m->east, n, sizeof *m->east), copy (m->south, n, sizeof *m->south),
        copy (m->vote, m->n_labels, sizeof *m->vote), copy (m->seed, n, sizeof *m->seed),
        copy (m->order, m->n_labels, sizeof *m->order), m->n_labels
      };
    }
  return __real_celd_multiway (m, host, label);
}

CeldStatus
__wrap_celd_maxflow (int width, int height, const int32_t *east, const int32_t *south, const int32_t *terminal,
                     const CeldHost *host, uint8_t *side, int64_t *flow)
{
  return use_boost ? boost_maxflow (width, height, east, south, terminal, side, flow)
                   : __real_celd_maxflow (width, height, east, south, terminal, host, side, flow);
}

/* ------------------------------------------------------------------ steps of the engine */

const char *const part_name[N_PARTS] = {
  "read", "build", "spills", "background", "graph", "partition", "windows", "closures", "painting", "report"
};
double part_seconds[N_PARTS];

void
parts_reset (void)
{
  memset (part_seconds, 0, sizeof part_seconds);
}

#define STEP(part, name, parameters, arguments) \
  CeldStatus __real_##name parameters; \
  CeldStatus __wrap_##name parameters; \
  CeldStatus \
  __wrap_##name parameters \
  { \
    double start = seconds (); \
    CeldStatus status = __real_##name arguments; \
 \
    part_seconds[part] += seconds () - start; \
    return status; \
  }

STEP (PART_READ, celd_scribbles_read,
      (const CeldPaint *scribbles, const CeldSettings *settings, const CeldHost *host, CeldLabels *seeds,
       CeldPalette *palette),
      (scribbles, settings, host, seeds, palette))
STEP (PART_BUILD, celd_basins_new,
      (const CeldPlane *ink, float threshold, const CeldHost *host, CeldBasins *basins), (ink, threshold, host, basins))
STEP (PART_SPILLS, celd_spills_remove, (const CeldHost *host, CeldSegmentTask *task), (host, task))
STEP (PART_BACKGROUND, celd_background_seed,
      (const CeldRelations *relations, const CeldHost *host, CeldSegmentTask *task), (relations, host, task))
STEP (PART_GRAPH, celd_basin_graph_solve, (const CeldSegmentTask *task, const CeldHost *host, uint32_t *label),
      (task, host, label))
STEP (PART_PARTITION, celd_partition,
      (const CeldPartition *m, const CeldHost *host, uint32_t *label, int64_t *energy, int64_t *greedy),
      (m, host, label, energy, greedy))
STEP (PART_WINDOWS, celd_windows_solve,
      (const CeldSegmentTask *task, const uint32_t *label, const CeldHost *host, CeldPatches *patches),
      (task, label, host, patches))
STEP (PART_CLOSURES, celd_closures_find,
      (const CeldSegmentTask *task, const uint32_t *label, const CeldLabels *labels, const CeldPatches *windows,
       const CeldHost *host, CeldClosures *closures, CeldPatches *patches),
      (task, label, labels, windows, host, closures, patches))
STEP (PART_PAINTING, celd_labelling_end,
      (CeldLabelling *labelling, const CeldBasins *basins, const CeldLabelling *old, const CeldLabels *labels),
      (labelling, basins, old, labels))
STEP (PART_PAINTING, celd_labelling_measure,
      (const CeldLabelling *labelling, const CeldBasins *basins, const CeldLabels *labels, CeldPalette *palette),
      (labelling, basins, labels, palette))
STEP (PART_REPORT, celd_segment_report,
      (const CeldSegmentTask *task, const CeldSeedRows *seeds, const CeldLabelling *labelling, const CeldLabels *labels,
       const CeldHost *host, CeldProblems *problems),
      (task, seeds, labelling, labels, host, problems))
