/* Single strokes of the host over the scribbles layer: an artist's last strokes, which come and go one by one.
 *
 * A stroke is kept as spans, so that all of them can be painted anew, over a copy of the layer's seeds, after every
 * edit: O(runs of seeds), and the result depends on what there is now, not on how it came about.  A stroke has the
 * label of the layer whose colour it has; other colours follow in the order in which they first appear.  A label of
 * which no pixel is left does not count.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/vector.h"
#include "image/image.h"
#include "session/session.h"

#include <string.h>

/* ------------------------------------------------------------------ setting */

/* The painted pixels of a mask. */
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

/* A new one lies above the others; one of the same id takes the old one's place among them. */
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
  celd_session_forget (session, STAGE_SEEDS);
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
  celd_session_forget (session, STAGE_SEEDS);
  return CELD_OK;
}

/* ------------------------------------------------------------------ composing */

/* The label of a colour, a new one if the palette has none. */
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

/* A stroke may lie anywhere, so places are counted in 64 bits until they are cut to the picture. */
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

/* Counts each label's pixels; (x,y) is the middle of its longest run, whose length goes to area for the time being. */
static void
survey (const CeldSeedRows *seeds, CeldPalette *palette)
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

/* Labels without a seed go; the others close up. */
static CeldStatus
drop_covered (CeldSeedRows *seeds, CeldPalette *palette)
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
  survey (seeds, palette);
  return drop_covered (seeds, palette);
}
