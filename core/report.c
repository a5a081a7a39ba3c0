/* What the artist should know of a segmentation: strokes overruled, regions that no stroke reaches, colours lost.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment.h"

#define SMALLEST_SHARE 2000 /* regions below 1/2000 of the picture are not worth a word */
#define SMALLEST_WIDTH 3    /* nor are those below the square of so many stroke widths */
#define SCRAP          8    /* nor 1/8 of a colour's paint, which another stroke has cut off */

/* How a connected stroke fared.  `other` is the label that most of its overruled pixels have, found by majority vote:
 * `lead` is how far it leads. */
typedef struct { size_t overruled, lead; uint32_t other; int x, y; } Fate;

/* ------------------------------------------------------------------ strokes */

static void
follow_strokes (const CeldCanvas *canvas, const CeldLabels *strokes, const CeldLabels *seeds, Fate *fate)
{
  for (int y = 0; y < canvas->height; y++)
    for (int x = 0; x < canvas->width; x++)
      {
        uint32_t stroke = CELD_AT (strokes, x, y), l = CELD_AT (&canvas->labels, x, y);
        Fate    *f = &fate[stroke];

        if (!stroke || l == CELD_AT (seeds, x, y))
          continue;
        if (!f->overruled++)
          {
            f->x = x;
            f->y = y;
          }
        if (!f->lead)
          f->other = l;
        f->lead = l == f->other ? f->lead + 1 : f->lead - 1;
      }
}

static CeldStatus
report_overruled (const CeldCanvas *canvas, const CeldLabels *seeds, const CeldRun *run, CeldProblems *problems)
{
  CeldLabels     strokes = { 0 };
  CeldComponent *stroke = NULL;
  Fate          *fate = NULL;
  size_t         n = 0;
  CeldStatus     status = celd_labels_new (canvas->width, canvas->height, &strokes);

  if (status == CELD_OK)
    status = celd_components (seeds, 0, true, run, &strokes, &stroke, &n);
  if (status != CELD_OK)
    goto done;
  fate   = celd_alloc0 (n + 1, sizeof *fate);
  status = fate ? CELD_OK : CELD_NO_MEMORY;
  if (status != CELD_OK)
    goto done;
  follow_strokes (canvas, &strokes, seeds, fate);
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    if (stroke[i].label <= canvas->palette.n && 2 * fate[i + 1].overruled > stroke[i].area &&
        SCRAP * stroke[i].area >= canvas->palette.item[stroke[i].label - 1].seeds)
      status = celd_problem_add (problems, (CeldProblem) {
        CELD_PROBLEM_STROKE_OVERRULED, fate[i + 1].x, fate[i + 1].y, stroke[i].label, fate[i + 1].other,
        CELD_NO_INDEX });

done:
  celd_free (strokes.data);
  celd_free (stroke);
  celd_free (fate);
  return status;
}

static CeldStatus
report_lost (const CeldCanvas *canvas, const CeldLabels *seeds, CeldProblems *problems)
{
  CeldStatus status = CELD_OK;
  bool      *told = celd_alloc0 (canvas->palette.n + 1, sizeof *told);

  if (!told)
    return CELD_NO_MEMORY;
  for (int y = 0; y < canvas->height; y++)
    for (int x = 0; x < canvas->width && status == CELD_OK; x++)
      {
        uint32_t l = CELD_AT (seeds, x, y);

        if (l < 1 || l > canvas->palette.n || canvas->palette.item[l - 1].area || told[l])
          continue;
        told[l] = true;
        status  = celd_problem_add (problems, (CeldProblem) { CELD_PROBLEM_COLOUR_LOST, x, y, l, 0, CELD_NO_INDEX });
      }
  celd_free (told);
  return status;
}

/* ------------------------------------------------------------------ regions */

/* Numbers pieces of a sensible size without a seed from 1, others 0; returns how many.  Pieces, not rooms: a stroke
 * reaches through a gap. */
static size_t
number_unreached (const CeldCanvas *canvas, size_t *area, uint32_t *number)
{
  size_t side = (size_t) (SMALLEST_WIDTH * canvas->stroke), n = 0;

  for (size_t p = 0; p < canvas->n; p++)
    area[canvas->pieces.data[p]]++;
  for (size_t p = 0; p < canvas->n; p++)
    if (canvas->seeds.data[p])
      area[canvas->pieces.data[p]] = 0;
  for (size_t k = 1; k <= canvas->n_pieces; k++)
    if (area[k] >= side * side && area[k] > canvas->n / SMALLEST_SHARE)
      number[k] = (uint32_t) ++n;
  return n;
}

static CeldStatus
report_unreached (const CeldCanvas *canvas, const CeldRun *run, CeldProblems *problems)
{
  size_t     *area = celd_alloc0 (canvas->n_pieces + 1, sizeof *area);
  uint32_t   *number = celd_alloc0 (canvas->n_pieces + 1, sizeof *number);
  CeldLabels  numbers = { 0 };
  CeldPalette place = { 0 };
  CeldStatus  status = area && number ? CELD_OK : CELD_NO_MEMORY;

  if (status != CELD_OK || !(place.n = number_unreached (canvas, area, number)))
    goto done;
  place.item = celd_alloc0 (place.n, sizeof *place.item);
  status = place.item ? celd_labels_new (canvas->width, canvas->height, &numbers) : CELD_NO_MEMORY;
  if (status != CELD_OK)
    goto done;
  for (size_t p = 0; p < canvas->n; p++)
    numbers.data[p] = number[canvas->pieces.data[p]];
  status = celd_palette_measure (&numbers, NULL, run, &place);
  for (size_t k = 0; k < place.n && status == CELD_OK; k++)
    status = celd_problem_add (problems, (CeldProblem) {
      CELD_PROBLEM_REGION_UNREACHED, place.item[k].x, place.item[k].y,
      CELD_AT (&canvas->labels, place.item[k].x, place.item[k].y), 0, CELD_NO_INDEX });

done:
  celd_free (area);
  celd_free (number);
  celd_free (numbers.data);
  celd_free (place.item);
  return status;
}

CeldStatus
celd_segment_report (const CeldCanvas *canvas, const CeldLabels *seeds, const CeldRun *run, CeldProblems *problems)
{
  CeldStatus status = canvas->settings->flats ? CELD_OK : report_overruled (canvas, seeds, run, problems);

  if (status == CELD_OK)
    status = report_lost (canvas, seeds, problems);
  if (status == CELD_OK && !canvas->settings->flats)
    status = report_unreached (canvas, run, problems);
  return status;
}
