/* The sheets of all regions.
 *
 *   1. of each region, how likely it goes on at each place where others may hide it (sheet-diffusion.c)
 *   2. the order of the sheets: regions that nobody compared lie so that as much as possible of that is hidden
 *      (hiding.c)
 *   3. of each region, its hidden pixels under the sheets that are now in front of it (sheet-pixels.c)
 *
 * An update takes over shapes in whose window nothing has changed, and their pixels if the same sheets are in front.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "sheets/sheets.h"

#define AT_ONCE 64 /* regions of one round between reports of progress */

typedef struct
{
  const CeldPlane     *ink;
  const CeldOwnership *own;
  const CeldLabels    *hints;        /* NULL: none */
  const CeldSettings  *settings;
  uint32_t             background;
  CeldHiding           hiding;
  size_t               n;            /* labels */
  CeldSheetShape      *shape;        /* of each label */
  uint32_t            *rank;
  int                  first;        /* of the round */
  CeldSheets          *old;          /* to be updated; NULL: none */
  CeldRect             changed;      /* where the ownership or hints have changed since it was made */
} SheetsWork;

static bool
needs_pixels (const SheetsWork *w, size_t k)
{
  return w->shape[k].seen.width && k + 1 != w->background;
}

static bool
overlap (CeldRect a, CeldRect b)
{
  return a.width && b.width && a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
         b.y < a.y + a.height;
}

/* FNV-1a, of a number. */
static uint64_t
hash (uint64_t sum, uint64_t number)
{
  return (sum ^ number) * 0x100000001b3u;
}

static bool
same_rect (CeldRect a, CeldRect b)
{
  return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

/* ------------------------------------------------------------------ 1. shapes */

static CeldStatus
find_seen (SheetsWork *w)
{
  const CeldOwnership *own = w->own;

  for (int y = 0; y < own->owner.height; y++)
    for (int x = 0, end; x < own->owner.width; x = end)
      {
        uint32_t  owner = CELD_AT (&own->owner, x, y), under = CELD_AT (&own->under, x, y);
        CeldRect *seen;

        if (owner - 1 >= w->n || under - 1 >= w->n)
          return CELD_BAD_VALUE;
        for (end = x + 1; end < own->owner.width && CELD_AT (&own->owner, end, y) == owner &&
                          CELD_AT (&own->under, end, y) == under;)
          end++;
        seen  = &w->shape[owner - 1].seen;
        *seen = celd_rect_union (*seen, (CeldRect) { x, y, end - x, 1 });
        seen  = &w->shape[under - 1].seen;
        *seen = celd_rect_union (*seen, (CeldRect) { x, y, end - x, 1 });
      }
  return CELD_OK;
}

/* A region, without how the others stand to it. */
static CeldSheetView
view_of (const SheetsWork *w, size_t k)
{
  return (CeldSheetView) { w->ink, w->own, w->hints, (uint32_t) k + 1, w->shape[k].seen, w->shape[k].painted, NULL };
}

/* Lists the labels that a region may lie under, and how much of it. */
static CeldStatus
list_wishes (const SheetsWork *w, size_t k, const uint8_t *standing, double *area)
{
  CeldSheetShape      *shape = &w->shape[k];
  const CeldDiffusion *d = &shape->diffusion;
  double               cell = (double) d->cell * d->cell;
  size_t               capacity = 0;
  CeldStatus           status = CELD_OK;

  for (int y = 0; y < d->down; y++)
    for (int x = 0; x < d->across; x++)
      {
        size_t   c = (size_t) y * (size_t) d->across + (size_t) x;
        int      px = d->window.x + x * d->cell + d->cell / 2, py = d->window.y + y * d->cell + d->cell / 2;
        uint32_t label;

        if (d->inside[c] <= 0.5f || d->distance[c] <= 0 || px >= w->own->owner.width || py >= w->own->owner.height)
          continue;
        label = celd_larger_label (w->own, px, py);
        if (standing[label - 1] == CELD_HIDING)
          area[label - 1] += cell;
      }
  for (size_t l = 0; l < w->n && status == CELD_OK; l++)
    if (area[l] > 0)
      status = celd_append (shape->wish, shape->n_wishes, capacity,
                            (CeldHidden) { (uint32_t) l + 1, (uint32_t) k + 1, area[l] });
  return status;
}

/* The shape of a label in what is updated, if nothing in its window has changed but maybe how others stand to it. */
static CeldSheetShape *
old_shape (const SheetsWork *w, size_t k)
{
  CeldSheetShape *old = w->old && w->old->shape && k < w->old->n_labels ? &w->old->shape[k] : NULL;

  return old && old->diffusion.inside && same_rect (old->seen, w->shape[k].seen) &&
         same_rect (old->painted, w->shape[k].painted) && !overlap (old->diffusion.window, w->changed) ? old : NULL;
}

/* A hash of how all labels that may have pixels in a window stand. */
static uint64_t
hash_standing (const SheetsWork *w, CeldRect window, const uint8_t *standing)
{
  uint64_t sum = 0xcbf29ce484222325u;

  for (size_t l = 0; l < w->n; l++)
    if (overlap (w->shape[l].seen, window))
      sum = hash (sum, l << 2 | standing[l]);
  return sum;
}

static CeldStatus
diffuse (SheetsWork *w, size_t k, const CeldSheetView *view, double *area)
{
  CeldSheetShape *shape = &w->shape[k], *old = old_shape (w, k);
  CeldStatus      status = CELD_OK;

  if (old && old->standing == hash_standing (w, old->diffusion.window, view->standing))
    {
      shape->diffusion = old->diffusion;
      shape->wish      = old->wish;
      shape->n_wishes  = old->n_wishes;
      shape->standing  = old->standing;
      shape->kept      = true;
      return CELD_OK;
    }
  status = celd_diffusion_new (view, NULL, &shape->diffusion);
  if (status == CELD_OK)
    status = list_wishes (w, k, view->standing, area);
  shape->standing = hash_standing (w, shape->diffusion.window, view->standing);
  return status;
}

static void
make_shape (void *data, int i)
{
  SheetsWork   *w = data;
  size_t        k = (size_t) (w->first + i);
  CeldStatus   *status = &w->shape[k].status;
  uint8_t      *standing;
  uint32_t     *queue;
  double       *area;
  CeldSheetView view = view_of (w, k);

  *status = CELD_OK;
  if (!needs_pixels (w, k))
    return;
  view.standing = standing = celd_alloc (w->n, 1);
  queue   = celd_alloc (w->n, sizeof *queue);
  area    = celd_alloc0 (w->n, sizeof *area);
  *status = standing && queue && area ? CELD_OK : CELD_NO_MEMORY;
  if (*status == CELD_OK)
    {
      celd_hiding_of (&w->hiding, view.label, standing, queue);
      *status = diffuse (w, k, &view, area);
    }
  celd_free (standing);
  celd_free (queue);
  celd_free (area);
}

/* ------------------------------------------------------------------ 2. order */

static CeldStatus
rank_all (SheetsWork *w)
{
  CeldHidden *wish;
  size_t      n = 0;
  CeldStatus  status;

  for (size_t k = 0; k < w->n; k++)
    n += w->shape[k].n_wishes;
  wish = celd_alloc (n, sizeof *wish);
  if (!wish)
    return CELD_NO_MEMORY;
  n = 0;
  for (size_t k = 0; k < w->n; k++)
    for (size_t i = 0; i < w->shape[k].n_wishes; i++)
      wish[n++] = w->shape[k].wish[i];
  status = celd_hiding_rank (&w->hiding, wish, n, w->rank);
  celd_free (wish);
  return status;
}

/* ------------------------------------------------------------------ 3. pixels */

/* A hash of which labels that may have pixels in a window are in front of label k + 1. */
static uint64_t
hash_front (const SheetsWork *w, size_t k)
{
  CeldRect window = w->shape[k].diffusion.window;
  uint64_t sum = 0xcbf29ce484222325u;

  for (size_t l = 0; l < w->n; l++)
    if (overlap (w->shape[l].seen, window))
      sum = hash (sum, l << 1 | (w->rank[l] > w->rank[k]));
  return sum;
}

/* Lists the pixels, or takes them over if nothing has changed for them. */
static CeldStatus
find_pixels (SheetsWork *w, size_t k, CeldSheet *sheet)
{
  CeldSheetShape *shape = &w->shape[k], *old = shape->kept ? &w->old->shape[k] : NULL;
  CeldSheetView   view = view_of (w, k);
  float           margin = w->settings->margin;

  shape->front = hash_front (w, k);
  if (!old || old->front != shape->front || w->old->margin < margin || w->old->margin > margin)
    return celd_sheet_pixels (&view, &shape->diffusion, w->rank, (double) margin * w->own->owner.width, sheet);
  *sheet = w->old->item[w->old->of_label[k]];
  shape->kept_pixels = true;
  return CELD_OK;
}

static void
make_pixels (void *data, int i)
{
  SheetsWork     *w = data;
  size_t          k = (size_t) (w->first + i);
  CeldSheetShape *shape = &w->shape[k];
  CeldSheet      *sheet = &shape->sheet;

  shape->status = CELD_OK;
  sheet->seen   = sheet->box = shape->seen;
  if (needs_pixels (w, k))
    shape->status = find_pixels (w, k, sheet);
  sheet->label = (uint32_t) k + 1;
  sheet->level = w->hiding.order->level[k];
  sheet->page  = sheet->label == w->background;
  sheet->pen   = shape->diffusion.pen;
  if (sheet->page)
    sheet->box = (CeldRect) { 0, 0, w->own->owner.width, w->own->owner.height };
}

/* ------------------------------------------------------------------ */

static CeldStatus
for_all (SheetsWork *w, const CeldHost *host, void (*body) (void *data, int i), double from, double to)
{
  CeldStatus status = celd_parallel_rounds (host, (int) w->n, AT_ONCE, body, w, &w->first, from, to);

  for (size_t k = 0; k < w->n && status == CELD_OK; k++)
    status = w->shape[k].status;
  return status;
}

static void
sheet_clear (CeldSheet *sheet)
{
  celd_free (sheet->run);
  celd_free (sheet->coverage);
  celd_free (sheet->confidence);
}

static void
shapes_free (CeldSheetShape *shape, size_t n)
{
  for (size_t k = 0; shape && k < n; k++)
    {
      celd_diffusion_clear (&shape[k].diffusion);
      celd_free (shape[k].wish);
      sheet_clear (&shape[k].sheet);
    }
  celd_free (shape);
}

/* Moves the sheets of labels that have pixels to the result, by their ranks. */
static CeldStatus
collect (SheetsWork *w, CeldSheets **result)
{
  CeldSheets *sheets = celd_alloc0 (1, sizeof *sheets);
  uint32_t   *label = celd_alloc (w->n, sizeof *label);

  if (!sheets || !label || !(sheets->item = celd_alloc (w->n, sizeof *sheets->item)) ||
      !(sheets->of_label = celd_alloc (w->n, sizeof *sheets->of_label)))
    {
      celd_free (label);
      celd_sheets_free (sheets);
      return CELD_NO_MEMORY;
    }
  sheets->width    = w->own->owner.width;
  sheets->height   = w->own->owner.height;
  sheets->n_labels = w->n;
  sheets->margin   = w->settings->margin;
  memset (label, 0xff, w->n * sizeof *label);
  for (size_t k = 0, at; k < w->n; k++)
    {
      for (at = w->rank[k]; label[at] != UINT32_MAX;)
        at++;
      label[at] = (uint32_t) k;
    }
  for (size_t i = 0; i < w->n; i++)
    {
      CeldSheetShape *shape = &w->shape[label[i]];

      sheets->of_label[label[i]] = shape->seen.width ? (uint32_t) sheets->n : CELD_NO_SHEET;
      if (!shape->seen.width)
        continue;
      sheets->item[sheets->n++] = shape->sheet;
      shape->sheet              = (CeldSheet) { 0 };
    }
  celd_free (label);
  *result = sheets;
  return CELD_OK;
}

static CeldStatus
make_sheets (SheetsWork *w, const CeldOrder *order, const CeldHost *host, CeldSheets **sheets)
{
  CeldStatus status;

  if (!CELD_SAME_SIZE (w->ink, &w->own->owner) || !CELD_SAME_SIZE (w->ink, &w->own->under) ||
      !CELD_SAME_SIZE (w->ink, &w->own->coverage) || (w->hints && !CELD_SAME_SIZE (w->ink, w->hints)))
    return CELD_BAD_SIZE;
  if (!order->n)
    return CELD_NOTHING_TO_GO_BY;
  if (w->background > order->n || celd_settings_check (w->settings) != CELD_OK)
    return CELD_BAD_VALUE;
  w->n     = order->n;
  w->shape = celd_alloc0 (w->n, sizeof *w->shape);
  w->rank  = celd_alloc0 (w->n, sizeof *w->rank);
  status   = w->shape && w->rank ? find_seen (w) : CELD_NO_MEMORY;
  if (status == CELD_OK && w->hints)
    status = celd_hidden_strokes_find (w->hints, w->n, w->shape);
  if (status == CELD_OK)
    status = celd_hiding_new (order, &w->hiding);
  if (status == CELD_OK)
    status = for_all (w, host, make_shape, 0, 0.6);
  if (status == CELD_OK)
    status = rank_all (w);
  if (status == CELD_OK)
    status = for_all (w, host, make_pixels, 0.6, 1);
  if (status == CELD_OK)
    status = collect (w, sheets);
  celd_hiding_clear (&w->hiding);
  celd_free (w->rank);
  return status;
}

CeldStatus
celd_sheets (const CeldPlane *ink, const CeldOwnership *own, const CeldLabels *hints, const CeldOrder *order,
             uint32_t background, const CeldSettings *settings, const CeldHost *host, CeldSheets **sheets)
{
  SheetsWork w = { .ink = ink, .own = own, .hints = hints, .settings = settings, .background = background };
  CeldStatus status = make_sheets (&w, order, host, sheets);

  shapes_free (w.shape, w.n);
  return status;
}

static void
let_go (CeldSheetShape *shape)
{
  shape->diffusion = (CeldDiffusion) { 0 };
  shape->wish      = NULL;
}

/* What was taken over belongs to the new sheets if they were made, and otherwise still to the old ones. */
static void
settle (SheetsWork *w, bool made)
{
  for (size_t k = 0; w->shape && k < w->n; k++)
    {
      CeldSheetShape *shape = &w->shape[k];

      if (shape->kept)
        let_go (made ? &w->old->shape[k] : shape);
      if (shape->kept_pixels)
        *(made ? &w->old->item[w->old->of_label[k]] : &shape->sheet) = (CeldSheet) { 0 };
    }
}

CeldStatus
celd_sheets_update (const CeldPlane *ink, const CeldOwnership *own, const CeldLabels *hints, CeldRect changed,
                    const CeldOrder *order, uint32_t background, const CeldSettings *settings, const CeldHost *host,
                    CeldSheets **sheets)
{
  SheetsWork  w = { .ink = ink, .own = own, .hints = hints, .settings = settings, .background = background,
                    .changed = changed };
  CeldSheets *made = NULL;
  CeldStatus  status;

  if (*sheets && (*sheets)->width == ink->width && (*sheets)->height == ink->height)
    w.old = *sheets;
  status = make_sheets (&w, order, host, &made);
  settle (&w, status == CELD_OK);
  if (status != CELD_OK)
    {
      shapes_free (w.shape, w.n);
      return status;
    }
  made->shape = w.shape;
  celd_sheets_free (*sheets);
  *sheets = made;
  return CELD_OK;
}

void
celd_sheets_free (CeldSheets *sheets)
{
  if (!sheets)
    return;
  for (size_t k = 0; k < sheets->n; k++)
    sheet_clear (&sheets->item[k]);
  shapes_free (sheets->shape, sheets->n_labels);
  celd_free (sheets->item);
  celd_free (sheets->of_label);
  celd_free (sheets);
}
