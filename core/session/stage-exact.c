/* The exact program, eq. (1) and (2), as stages of a session: weights of the drawing, nodes of the scribbles, depth.
 *
 * A segmentation by the scribbles alone finds the background scribble; if there is none, the paper along the frame
 * becomes a node of its own behind all others.  Nodes so do not depend on relations, and a new relation costs only the
 * quadratic program and a sum of harmonic bases.
 *
 * The preview is exact depth at half the width and height: a quarter of the work.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "depth/depth.h"
#include "image/image.h"
#include "session/session.h"

#include <string.h>

/* ------------------------------------------------------------------ the background */

/* Makes seeds of label `to` of the paper along the frame that has label `from` and no seed. */
static CeldStatus
seed_frame (const CeldPlane *ink, const CeldLabels *labels, uint32_t from, uint32_t to, CeldLabels *seeds)
{
  size_t    *pixel = NULL, n = 0;
  CeldStatus status = celd_frame (ink, ink->width, ink->height, 0, &pixel, &n);

  for (size_t i = 0; i < n && status == CELD_OK; i++)
    if (labels->data[pixel[i]] == from && !seeds->data[pixel[i]])
      seeds->data[pixel[i]] = to;
  celd_free (pixel);
  return status;
}

/* Makes regions of the scribbles alone, with a copy of their palette in which the background is marked. */
static CeldStatus
segment_scribbles (const CeldPlane *ink, const CeldLabels *seeds, const CeldPalette *palette,
                   const CeldSettings *settings, const CeldHost *host, CeldLabels *labels, CeldPalette *found)
{
  CeldSettings plain = *settings;
  CeldStatus   status = celd_labels_new (ink->width, ink->height, labels);

  plain.method = CELD_METHOD_BASINS;
  if (status == CELD_OK)
    status = celd_palette_copy (palette, found);
  return status == CELD_OK ? celd_segment (ink, seeds, NULL, &plain, host, labels, found, NULL) : status;
}

/* Marks the background scribble in the palette, or adds a background to palette and seeds (tight). */
static CeldStatus
add_background (const CeldPlane *ink, const CeldLabels *labels, const CeldPalette *regions, CeldLabels *seeds,
                CeldPalette *palette)
{
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < palette->n && status == CELD_OK; k++)
    palette->item[k].background = regions->item[k].background;
  for (size_t k = palette->n; k < regions->n && status == CELD_OK; k++)
    if (regions->item[k].background)
      {
        status = celd_append_uncounted (palette->item, palette->n, regions->item[k]);
        if (status == CELD_OK)
          status = seed_frame (ink, labels, (uint32_t) k + 1, (uint32_t) palette->n, seeds);
      }
  return status;
}

/* ------------------------------------------------------------------ the stages */

CeldStatus
celd_make_weights (CeldSession *s, const CeldHost *host)
{
  if (!s->program)
    s->program = celd_program_new ();
  if (!s->program)
    return CELD_NO_MEMORY;
  return celd_program_set_ink (s->program, celd_session_depth_ink (s), &s->settings, host);
}

/* Adds the background to seeds and palette, gives both to the program, and lets gaps hold depth.  `borders` is as for
 * celd_gaps_hold. */
static CeldStatus
set_nodes (const CeldPlane *ink, const CeldPlane *borders, const CeldSettings *settings, const CeldHost *host,
           CeldLabels *seeds, CeldPalette *palette, CeldProgram *program)
{
  CeldHostPart part[3];
  CeldHost     finding = celd_host_part (&part[0], host, 0, 0.6), setting = celd_host_part (&part[1], host, 0.6, 0.9);
  CeldHost     holding = celd_host_part (&part[2], host, 0.9, 1);
  bool         background = settings->background != CELD_BACKGROUND_NONE;
  CeldLabels   labels = { 0 };
  CeldPalette  regions = { 0 };
  CeldStatus   status = CELD_OK;

  if (palette->n && (background || settings->hold_gaps))
    status = segment_scribbles (ink, seeds, palette, settings, &finding, &labels, &regions);
  if (status == CELD_OK && background)
    status = add_background (ink, &labels, &regions, seeds, palette);
  if (status == CELD_OK)
    status = celd_program_set_seeds (program, seeds, palette, settings->same_colour, &setting);
  if (status == CELD_OK)
    status = celd_program_hold_gaps (program, labels.data && settings->hold_gaps ? &labels : NULL, borders, settings,
                                     &holding);
  for (size_t k = 0; k < palette->n && status == CELD_OK; k++)
    palette->item[k] = program->palette.item[k];
  celd_free (labels.data);
  celd_palette_clear (&regions);
  return status;
}

CeldStatus
celd_make_nodes (CeldSession *s, const CeldHost *host)
{
  CeldLabels  seeds = { 0 };
  CeldPalette palette = { 0 };
  CeldStatus  status = celd_labels_new (s->ink.width, s->ink.height, &seeds);

  if (status == CELD_OK)
    status = celd_palette_copy (&s->seed_palette, &palette);
  if (status == CELD_OK)
    {
      celd_seed_rows_write (&s->seeds, &seeds);
      status = set_nodes (&s->ink, s->depth_ink.data ? &s->ink : NULL, &s->settings, host, &seeds, &palette,
                          s->program);
    }
  celd_free (seeds.data);
  if (status != CELD_OK)
    {
      celd_palette_clear (&palette);
      return status;
    }
  celd_palette_clear (&s->exact_palette);
  s->exact_palette = palette;
  return CELD_OK;
}

CeldStatus
celd_make_exact (CeldSession *s, const CeldHost *host)
{
  CeldPlane    depth = { 0 };
  CeldExact    exact = { 0 };
  CeldProblems problems = { 0 };
  CeldStatus   status = celd_plane_new (s->ink.width, s->ink.height, &depth);

  if (status == CELD_OK)
    status = celd_program_solve (s->program, &s->relations, &s->settings, host, &depth, &exact, &problems);
  if (status != CELD_OK)
    {
      celd_free (depth.data);
      celd_problems_clear (&problems);
      return status;
    }
  celd_exact_clear (&s->exact);
  celd_problems_clear (&s->problems[STAGE_EXACT]);
  s->exact = exact;
  s->problems[STAGE_EXACT] = problems;
  celd_session_replace_plane (s, STAGE_EXACT, &s->exact_depth, &depth);
  celd_free (depth.data);
  return CELD_OK;
}

/* ------------------------------------------------------------------ preview */

/* The mean of 2 x 2 pixels, or of as many as there are. */
static void
halve_ink (const CeldPlane *ink, CeldPlane *half)
{
  for (int y = 0; y < half->height; y++)
    for (int x = 0; x < half->width; x++)
      {
        int   right = 2 * x + 1 < ink->width ? 2 * x + 1 : 2 * x, down = 2 * y + 1 < ink->height ? 2 * y + 1 : 2 * y;
        float sum = CELD_AT (ink, 2 * x, 2 * y) + CELD_AT (ink, right, 2 * y) + CELD_AT (ink, 2 * x, down) +
                    CELD_AT (ink, right, down);

        CELD_AT (half, x, y) = sum / 4;
      }
}

static void
halve_seeds (const CeldSeedRows *seeds, CeldLabels *half)
{
  for (int y = 0; y < seeds->height; y++)
    for (size_t i = 0; i < seeds->row[y].n; i++)
      for (int x = seeds->row[y].run[i].x; x < seeds->row[y].run[i].end; x++)
        CELD_AT (half, x / 2, y / 2) = seeds->row[y].run[i].label;
}

static CeldStatus
halve_relations (const CeldRelations *relations, CeldRelations *half)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < relations->n && status == CELD_OK; i++)
    {
      CeldRelation r = relations->item[i];

      r.nearer.x /= 2;
      r.nearer.y /= 2;
      r.farther.x /= 2;
      r.farther.y /= 2;
      status = celd_relation_add (half, r);
    }
  return status;
}

/* Exact depth at half the width and height, that of the planes.  `ink` is overwritten, and `borders` if there are
 * virtual contours. */
static CeldStatus
solve_half (const CeldSession *s, const CeldHost *host, CeldPlane *ink, CeldPlane *borders, CeldPlane *depth)
{
  CeldSettings  settings = s->settings;
  CeldLabels    seeds = { 0 };
  CeldPalette   palette = { 0 };
  CeldRelations relations = { 0 };
  CeldProgram  *program = celd_program_new ();
  CeldHostPart  part[2];
  CeldHost      nodes = celd_host_part (&part[0], host, 0, 0.1), solving = celd_host_part (&part[1], host, 0.1, 1);
  CeldStatus    status = program ? celd_labels_new (ink->width, ink->height, &seeds) : CELD_NO_MEMORY;

  settings.tolerance = settings.tolerance < CELD_PREVIEW_TOLERANCE ? CELD_PREVIEW_TOLERANCE : settings.tolerance;
  if (status == CELD_OK)
    status = celd_palette_copy (&s->seed_palette, &palette);
  if (status == CELD_OK)
    status = halve_relations (&s->relations, &relations);
  if (status == CELD_OK)
    {
      halve_ink (celd_session_depth_ink (s), ink);
      if (s->depth_ink.data)
        halve_ink (&s->ink, borders);
      halve_seeds (&s->seeds, &seeds);
      status = celd_program_set_ink (program, ink, &settings, NULL);
    }
  if (status == CELD_OK)
    status = set_nodes (ink, s->depth_ink.data ? borders : NULL, &settings, &nodes, &seeds, &palette, program);
  if (status == CELD_OK)
    status = celd_program_solve (program, &relations, &settings, &solving, depth, NULL, NULL);
  celd_program_free (program);
  celd_free (seeds.data);
  celd_palette_clear (&palette);
  celd_relations_clear (&relations);
  return status;
}

CeldStatus
celd_make_exact_preview (CeldSession *s, const CeldHost *host)
{
  CeldPlane  ink = { 0 }, borders = { 0 }, depth = { 0 };
  CeldStatus status = celd_plane_new ((s->ink.width + 1) / 2, (s->ink.height + 1) / 2, &ink);

  if (status == CELD_OK)
    status = celd_plane_new (ink.width, ink.height, &depth);
  if (status == CELD_OK)
    status = celd_plane_new (ink.width, ink.height, &borders);
  if (status == CELD_OK)
    status = solve_half (s, host, &ink, &borders, &depth);
  celd_free (ink.data);
  celd_free (borders.data);
  if (status != CELD_OK)
    {
      celd_free (depth.data);
      return status;
    }
  celd_free (s->exact_preview.data);
  s->exact_preview = depth;
  return CELD_OK;
}
