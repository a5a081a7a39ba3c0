/* What the artist should know of a segmentation: strokes overruled, regions that no stroke reaches, colours lost.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment.h"

#define SMALLEST_SHARE 2000 /* regions below 1/2000 of the picture are not worth a word */
#define SMALLEST_WIDTH 3    /* nor are those below the square of so many stroke widths */

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
    if (2 * fate[i + 1].overruled > stroke[i].area && stroke[i].label <= canvas->palette.n)
      status = celd_problem_add (problems, (CeldProblem) {
        CELD_PROBLEM_STROKE_OVERRULED, fate[i + 1].x, fate[i + 1].y, stroke[i].label, fate[i + 1].other, CELD_NO_INDEX });

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

/* Pieces of paper of a sensible size without a seed, as `unreached` of piece k at [k]. */
static bool
find_unreached (const CeldCanvas *canvas, bool *unreached)
{
  size_t side = (size_t) (SMALLEST_WIDTH * canvas->stroke), n = 0;

  for (size_t k = 1; k <= canvas->n_pieces; k++)
    unreached[k] = canvas->piece[k - 1].area >= side * side && canvas->piece[k - 1].area >= canvas->n / SMALLEST_SHARE;
  for (size_t p = 0; p < canvas->n; p++)
    if (canvas->seeds.data[p])
      unreached[canvas->pieces.data[p]] = false;
  for (size_t k = 1; k <= canvas->n_pieces; k++)
    n += unreached[k];
  return n > 0;
}

static CeldStatus
report_unreached (const CeldCanvas *canvas, const CeldRun *run, CeldProblems *problems)
{
  bool       *unreached = celd_alloc0 (canvas->n_pieces + 1, sizeof *unreached);
  CeldPalette place = { celd_alloc0 (canvas->n_pieces, sizeof (CeldRegion)), canvas->n_pieces };
  CeldStatus  status = unreached && place.item ? CELD_OK : CELD_NO_MEMORY;

  if (status != CELD_OK || !find_unreached (canvas, unreached))
    goto done;
  status = celd_palette_measure (&canvas->pieces, NULL, run, &place);
  for (size_t k = 1; k <= canvas->n_pieces && status == CELD_OK; k++)
    if (unreached[k])
      status = celd_problem_add (problems, (CeldProblem) {
        CELD_PROBLEM_REGION_UNREACHED, place.item[k - 1].x, place.item[k - 1].y,
        CELD_AT (&canvas->labels, place.item[k - 1].x, place.item[k - 1].y), 0, CELD_NO_INDEX });

done:
  celd_free (unreached);
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
