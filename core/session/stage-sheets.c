/* The sheets of all regions in a session.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"
#include "session/session.h"
#include "sheets/sheets.h"

/* The label of the background if it is at the farthest level; 0 if there is none, or if relations put something behind
 * it. */
static uint32_t
background_label (const CeldSession *s)
{
  for (size_t k = 0; k < s->palette.n; k++)
    if (s->palette.item[k].background)
      return s->order.level[k] == 0 ? (uint32_t) k + 1 : 0;
  return 0;
}

/* Reads the layer `hidden`; hints->data stays NULL without it. */
static CeldStatus
read_hints (const CeldSession *s, CeldLabels *hints)
{
  CeldStatus status;

  if (!s->hidden.data)
    return CELD_OK;
  status = celd_labels_new (s->hidden.width, s->hidden.height, hints);
  return status == CELD_OK ? celd_hidden_read (&s->hidden, &s->palette, hints) : status;
}

/* Where two layers of hints, of which one may be missing, differ. */
static CeldRect
changed_hints (const CeldLabels *old, const CeldLabels *new)
{
  const CeldLabels *one = new->data ? new : old;
  CeldRect          box = { 0 };

  if (old->data && new->data)
    return celd_changed_rect (old->data, new->data, new->width, new->height, sizeof *new->data);
  for (int y = 0; y < one->height; y++)
    for (int x = 0; x < one->width; x++)
      if (CELD_AT (one, x, y))
        box = celd_rect_union (box, (CeldRect) { x, y, 1, 1 });
  return box;
}

CeldStatus
celd_make_sheets (CeldSession *s, const CeldHost *host)
{
  CeldLabels   hints = { 0 };
  CeldProblems problems = { 0 };
  CeldStatus   status = read_hints (s, &hints);

  if (status == CELD_OK)
    {
      CeldRect changed = celd_rect_union (s->changed_sheets, changed_hints (&s->sheet_hints, &hints));

      status = celd_sheets_update (celd_session_depth_ink (s), &s->ownership, hints.data ? &hints : NULL, changed,
                                   &s->order, background_label (s), &s->settings, host, &s->sheets);
    }
  if (status == CELD_OK && hints.data)
    status = celd_unmatched_strokes_find (&s->hidden, &hints, &problems);
  if (status == CELD_OK)
    status = celd_sheet_problems (s->sheets, &problems);
  if (status == CELD_OK)
    {
      celd_free (s->sheet_hints.data);
      s->sheet_hints    = hints;
      s->changed_sheets = (CeldRect) { 0 };
      hints             = (CeldLabels) { 0 };
      celd_problems_clear (&s->problems[STAGE_SHEETS]);
      s->problems[STAGE_SHEETS] = problems;
      problems                  = (CeldProblems) { 0 };
    }
  celd_problems_clear (&problems);
  celd_free (hints.data);
  return status;
}
