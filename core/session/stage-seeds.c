/* Seeds in a session: of the scribbles layer, which is read once, and of single strokes over it, which a host adds,
 * replaces and removes one by one.
 *
 * After an edit all strokes are painted again over a copy of the layer's seeds, in O(runs of seeds), so that the result
 * does not depend on the order of edits.  A stroke gets the layer's label of its colour; colours that the layer lacks
 * get further labels in the order of their first strokes.  Labels that other strokes cover completely are removed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "input/input.h"
#include "session/session.h"

#include <string.h>

/* ------------------------------------------------------------------ adding and removing */

/* Appends the pixels of a mask that are not 0, as spans. */
static CeldStatus
read_spans (const CeldMask *mask, CeldStroke *stroke)
{
  for (int y = 0; y < mask->height; y++)
    for (int x = 0, end; x < mask->width; x = end + 1)
      {
        while (x < mask->width && !CELD_AT (mask, x, y))
          x++;
        for (end = x; end < mask->width && CELD_AT (mask, end, y); end++)
          ;
        if (x == end)
          break;
        if (celd_append (stroke->span, stroke->n, stroke->span_capacity, (CeldStrokeSpan) { y, x, end }) != CELD_OK)
          return CELD_NO_MEMORY;
      }
  return CELD_OK;
}

static CeldStroke *
find_stroke (CeldSession *s, uint32_t id)
{
  for (size_t i = 0; i < s->n_strokes; i++)
    if (s->stroke[i].id == id)
      return &s->stroke[i];
  return NULL;
}

/* Replaces the stroke of the same id, or adds the new one above all others. */
static CeldStatus
place_stroke (CeldSession *s, const CeldStroke *made)
{
  CeldStroke *stroke = find_stroke (s, made->id);

  if (!stroke)
    {
      if (celd_append (s->stroke, s->n_strokes, s->stroke_capacity, (CeldStroke) { 0 }) != CELD_OK)
        return CELD_NO_MEMORY;
      stroke = &s->stroke[s->n_strokes - 1];
    }
  celd_free (stroke->span);
  *stroke = *made;
  return CELD_OK;
}

CeldStatus
celd_session_put_stroke (CeldSession *session, uint32_t id, int x, int y, const CeldMask *mask, const uint8_t colour[3])
{
  CeldStroke made = { id, x, y, { colour[0], colour[1], colour[2] }, NULL, 0, 0 };
  CeldStatus status;

  if (!id)
    return CELD_BAD_VALUE;
  if (!CELD_SAME_SIZE (mask, mask))
    return CELD_BAD_SIZE;
  status = read_spans (mask, &made);
  if (status == CELD_OK)
    status = place_stroke (session, &made);
  if (status != CELD_OK)
    {
      celd_free (made.span);
      return status;
    }
  celd_session_invalidate (session, STAGE_SEEDS);
  return CELD_OK;
}

CeldStatus
celd_session_remove_stroke (CeldSession *session, uint32_t id)
{
  CeldStroke *stroke = find_stroke (session, id);
  size_t      behind;

  if (!stroke)
    return CELD_BAD_VALUE;
  behind = (size_t) (session->stroke + session->n_strokes - (stroke + 1));
  celd_free (stroke->span);
  memmove (stroke, stroke + 1, behind * sizeof *stroke);
  session->n_strokes--;
  celd_session_invalidate (session, STAGE_SEEDS);
  return CELD_OK;
}

/* ------------------------------------------------------------------ composing */

/* Finds the label of a colour; adds one to the palette if it has none. */
static CeldStatus
find_label (const uint8_t colour[3], CeldPalette *palette, uint32_t *label)
{
  *label = celd_palette_find (palette, colour);
  if (*label)
    return CELD_OK;
  if (celd_append_uncounted (palette->item, palette->n, (CeldRegion) {
    .colour = { colour[0], colour[1], colour[2], 255 }, .origin = CELD_FROM_SCRIBBLE
  }) != CELD_OK)
    return CELD_NO_MEMORY;
  *label = (uint32_t) palette->n;
  return CELD_OK;
}

/* Strokes may extend beyond the picture by any distance: 64 bits until they are clipped, so that nothing overflows. */
static CeldStatus
paint_stroke (const CeldStroke *stroke, uint32_t label, CeldSeedRows *seeds)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < stroke->n && status == CELD_OK; i++)
    {
      int64_t y = (int64_t) stroke->y + stroke->span[i].y, x = (int64_t) stroke->x + stroke->span[i].x;
      int64_t end = (int64_t) stroke->x + stroke->span[i].end;

      if (y < 0 || y >= seeds->height || x >= seeds->width || end <= 0)
        continue;
      x   = x < 0 ? 0 : x;
      end = end > seeds->width ? seeds->width : end;
      status = celd_seed_rows_paint (seeds, (int) y, (int) x, (int) end, label);
    }
  return status;
}

/* Counts each label's seeds; (x,y) becomes the middle of its longest run, whose length `area` holds meanwhile. */
static void
measure_labels (const CeldSeedRows *seeds, CeldPalette *palette)
{
  for (size_t k = 0; k < palette->n; k++)
    palette->item[k].seeds = palette->item[k].area = 0;
  for (int y = 0; y < seeds->height; y++)
    for (size_t i = 0; i < seeds->row[y].n; i++)
      {
        const CeldSeedRun *run = &seeds->row[y].run[i];
        CeldRegion        *region = &palette->item[run->label - 1];
        size_t             length = (size_t) (run->end - run->x);

        region->seeds += length;
        if (length > region->area)
          {
            region->area = length;
            region->x = (run->x + run->end - 1) / 2;
            region->y = y;
          }
      }
  for (size_t k = 0; k < palette->n; k++)
    palette->item[k].area = 0;
}

/* Removes labels without a seed, and renumbers the others. */
static CeldStatus
remove_covered (CeldSeedRows *seeds, CeldPalette *palette)
{
  uint32_t *number = celd_alloc0 (palette->n, sizeof *number);
  size_t    kept = 0;

  if (!number)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < palette->n; k++)
    if (palette->item[k].seeds)
      {
        palette->item[kept] = palette->item[k];
        number[k] = (uint32_t) ++kept;
      }
  for (int y = 0; y < seeds->height && kept < palette->n; y++)
    for (size_t i = 0; i < seeds->row[y].n; i++)
      seeds->row[y].run[i].label = number[seeds->row[y].run[i].label - 1];
  palette->n = kept;
  celd_free (number);
  return CELD_OK;
}

CeldStatus
celd_strokes_compose (const CeldStroke *stroke, size_t n, CeldSeedRows *seeds, CeldPalette *palette)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < n && status == CELD_OK; i++)
    {
      uint32_t label;

      status = find_label (stroke[i].colour, palette, &label);
      if (status == CELD_OK)
        status = paint_stroke (&stroke[i], label, seeds);
    }
  if (status != CELD_OK)
    return status;
  measure_labels (seeds, palette);
  return remove_covered (seeds, palette);
}

/* ------------------------------------------------------------------ the stages */

CeldStatus
celd_make_scribbles (CeldSession *s, const CeldHost *host)
{
  int          w = s->drawing.luma.width, h = s->drawing.luma.height;
  CeldLabels   labels = { 0 };
  CeldSeedRows seeds = { 0 };
  CeldPalette  palette = { 0 };
  CeldProblems problems = { 0 };
  CeldStatus   status;

  if (s->scribbles.data)
    {
      status = celd_labels_new (w, h, &labels);
      if (status == CELD_OK)
        status = celd_scribbles_read (&s->scribbles, &s->settings, host, &labels, &palette);
      if (status == CELD_OK)
        status = celd_seed_rows_read (&labels, &seeds);
      if (status == CELD_OK)
        status = celd_faint_strokes_find (&s->scribbles, CELD_SCRIBBLE_ALPHA, &problems);
    }
  else
    status = celd_seed_rows_new (w, h, &seeds);
  celd_free (labels.data);
  if (status != CELD_OK)
    {
      celd_palette_clear (&palette);
      celd_seed_rows_clear (&seeds);
      celd_problems_clear (&problems);
      return status;
    }
  celd_seed_rows_clear (&s->layer_seeds);
  celd_palette_clear (&s->layer_palette);
  celd_problems_clear (&s->problems[STAGE_SCRIBBLES]);
  s->problems[STAGE_SCRIBBLES] = problems;
  s->layer_seeds   = seeds;
  s->layer_palette = palette;
  return CELD_OK;
}

CeldStatus
celd_make_seeds (CeldSession *s, const CeldHost *host)
{
  CeldSeedRows seeds = { 0 };
  CeldPalette  palette = { 0 };
  CeldStatus   status = celd_seed_rows_copy (&s->layer_seeds, &seeds);

  if (status == CELD_OK)
    status = celd_palette_copy (&s->layer_palette, &palette);
  if (status == CELD_OK && s->n_strokes)
    status = celd_strokes_compose (s->stroke, s->n_strokes, &seeds, &palette);
  if (status == CELD_OK)
    status = celd_progress (host, 1);
  if (status != CELD_OK)
    {
      celd_seed_rows_clear (&seeds);
      celd_palette_clear (&palette);
      return status;
    }
  celd_seed_rows_clear (&s->seeds);
  celd_palette_clear (&s->seed_palette);
  s->seeds        = seeds;
  s->seed_palette = palette;
  return CELD_OK;
}
