/* Handles as text and as paint.
 *
 *   handles = handle { (";" | newline) handle }
 *   handle  = x "," y [ "->" x "," y ] [ "^" number ]
 *
 * A line ends as in relations, and a byte order mark is skipped.  In paint a stroke that fills its own bounding box
 * like a disc is a dot, a pin; all others are arrows.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"
#include "motion/motion.h"

#define DOT_FILL   0.6  /* of its bounding box that a dot covers at least: a disc covers 0.79 (chosen) */
#define DOT_ASPECT 1.6  /* the longer side of a dot's bounding box by the shorter one at most; chosen */

void
celd_handles_clear (CeldHandles *handles)
{
  celd_free (handles->item);
  *handles = (CeldHandles) { 0 };
}

/* ------------------------------------------------------------------ text */

static CeldStatus
read_place (CeldReader *r, double *x, double *y)
{
  CeldStatus status;

  celd_text_skip_blanks (r);
  status = celd_text_number (r, false, N_ ("a place \"x,y\""), x);
  celd_text_skip_blanks (r);
  if (status == CELD_OK && *r->at != ',')
    return celd_text_refuse (r, N_ ("a comma between x and y"));
  if (status != CELD_OK)
    return status;
  celd_text_advance (r);
  celd_text_skip_blanks (r);
  status = celd_text_number (r, false, N_ ("a number for y"), y);
  celd_text_skip_blanks (r);
  return status;
}

/* Reads one handle into the CeldHandles. */
static CeldStatus
read_handle (void *data, CeldReader *r)
{
  CeldHandles *handles = data;
  CeldHandle   h = { 0 };
  CeldStatus   status = read_place (r, &h.x, &h.y);

  h.to_x = h.x;
  h.to_y = h.y;
  if (status == CELD_OK && *r->at == '-')
    {
      celd_text_advance (r);
      if (*r->at != '>')
        return celd_text_refuse (r, N_ ("\"->\""));
      celd_text_advance (r);
      status = read_place (r, &h.to_x, &h.to_y);
    }
  if (status == CELD_OK && *r->at == '^')
    {
      celd_text_advance (r);
      celd_text_skip_blanks (r);
      status = celd_text_number (r, false, N_ ("a number of levels"), &h.depth);
      celd_text_skip_blanks (r);
    }
  if (status == CELD_OK)
    status = celd_append_uncounted (handles->item, handles->n, h);
  return status;
}

CeldStatus
celd_handles_parse (const char *text, CeldHandles *handles, CeldTextError *error)
{
  size_t     before = handles->n;
  CeldStatus status = celd_text_items (text, read_handle, handles, "\"->\", \"^\", \";\" or a new line", error);

  if (status != CELD_OK)
    handles->n = before;
  return status;
}

/* ------------------------------------------------------------------ paint */

static bool
is_dot (const CeldComponent *c)
{
  double w = c->right - c->left + 1, h = c->bottom - c->top + 1;

  return (double) c->area >= DOT_FILL * w * h && fmax (w, h) <= DOT_ASPECT * fmin (w, h);
}

/* Appends a pin for each dot, and erases dots from `rest`, a copy of the paint; and the paper of an opaque layer. */
static CeldStatus
take_dots (const CeldLabels *component, const CeldComponent *list, size_t n, bool opaque, CeldPaint *rest,
           CeldHandles *handles)
{
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < n && status == CELD_OK; k++)
    if (list[k].label && is_dot (&list[k]))
      {
        double x = 0.5 * (list[k].left + list[k].right + 1), y = 0.5 * (list[k].top + list[k].bottom + 1);

        status = celd_append_uncounted (handles->item, handles->n, ((CeldHandle) { x, y, x, y, 0 }));
      }
  for (int y = 0; y < rest->height; y++)
    for (int x = 0; x < rest->width; x++)
      {
        const CeldComponent *c = &list[CELD_AT (component, x, y) - 1];

        if (c->label ? is_dot (c) : opaque)
          memset (CELD_RGBA (rest, x, y), 0, 4);
      }
  return status;
}

/* Appends a handle for each arrow of what is left of the paint. */
static CeldStatus
take_arrows (const CeldPaint *rest, CeldArrowStyle style, const CeldHost *host, CeldHandles *handles,
             CeldProblems *problems)
{
  CeldRelations arrows = { 0 };
  CeldStatus    status = celd_arrows_read (rest, style, host, &arrows, problems);

  for (size_t i = 0; i < arrows.n && status == CELD_OK; i++)
    {
      const CeldTerm *from = &arrows.item[i].nearer, *to = &arrows.item[i].farther;

      status = celd_append_uncounted (handles->item, handles->n, ((CeldHandle) { from->x, from->y, to->x, to->y, 0 }));
    }
  celd_relations_clear (&arrows);
  return status;
}

CeldStatus
celd_handles_read (const CeldPaint *paint, CeldArrowStyle style, const CeldHost *host, CeldHandles *handles,
                   CeldProblems *problems)
{
  CeldArrowLayer layer;
  CeldLabels     mark = { 0 };
  CeldPaint      rest = { paint->width, paint->height, (size_t) paint->width, NULL };
  CeldComponent *list = NULL;
  size_t         n = 0, before = handles->n;
  CeldStatus     status;

  if (!CELD_SAME_SIZE (paint, paint))
    return CELD_BAD_SIZE;
  status    = celd_labels_new (paint->width, paint->height, &mark);
  rest.data = celd_alloc ((size_t) paint->width * (size_t) paint->height, 4);
  if (status == CELD_OK)
    status = rest.data ? celd_arrow_layer_new (paint, &layer) : CELD_NO_MEMORY;
  for (int y = 0; y < paint->height && status == CELD_OK; y++)
    {
      memcpy (CELD_RGBA (&rest, 0, y), CELD_RGBA (paint, 0, y), 4 * (size_t) paint->width);
      for (int x = 0; x < paint->width; x++)
        CELD_AT (&mark, x, y) = celd_arrow_opacity (&layer, x, y) >= CELD_PAPER_CONTRAST;
    }
  if (status == CELD_OK)
    status = celd_components (&mark, UINT32_MAX, true, host, &mark, &list, &n);
  if (status == CELD_OK)
    status = take_dots (&mark, list, n, layer.opaque, &rest, handles);
  if (status == CELD_OK)
    status = take_arrows (&rest, style, host, handles, problems);
  if (status != CELD_OK)
    handles->n = before;
  celd_free (list);
  celd_free (mark.data);
  celd_free (rest.data);
  return status;
}
