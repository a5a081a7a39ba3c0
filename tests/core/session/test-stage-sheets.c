/* Sheets in a session: after edits they are those of a new session, and what no edit concerns is not made again.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "random-session.h"
#include "sheets/sheets.h"

static bool
same_sheet (const CeldSheet *a, const CeldSheet *b)
{
  bool same = a->label == b->label && a->level == b->level && a->page == b->page && a->n_runs == b->n_runs &&
              a->n_hidden == b->n_hidden && !memcmp (&a->seen, &b->seen, sizeof a->seen) &&
              !memcmp (&a->box, &b->box, sizeof a->box);

  if (same && a->n_hidden)
    same = !memcmp (a->coverage, b->coverage, a->n_hidden) && !memcmp (a->confidence, b->confidence, a->n_hidden);
  for (size_t i = 0; i < a->n_runs && same; i++)
    same = a->run[i].x == b->run[i].x && a->run[i].y == b->run[i].y && a->run[i].n == b->run[i].n &&
           a->run[i].first == b->run[i].first;
  return same;
}

/* What is said of sheets and of hidden strokes. */
static bool
same_problems (const CeldProblems *a, const CeldProblems *b)
{
  bool same = a->n == b->n;

  for (size_t i = 0; i < a->n && same; i++)
    same = (a->item[i].kind == CELD_PROBLEM_HIDDEN_UNSURE || a->item[i].kind == CELD_PROBLEM_STROKE_UNMATCHED) &&
           b->item[i].kind == a->item[i].kind &&
           a->item[i].label == b->item[i].label && a->item[i].x == b->item[i].x && a->item[i].y == b->item[i].y;
  return same;
}

/* The layer `hidden`, beside a state. */
typedef struct { bool there; uint8_t paint[4 * W * H]; } Hidden;

static void
set_hidden (CeldSession *s, Hidden *hidden)
{
  CeldPaint paint = { W, H, W, hidden->paint };

  CHECK (celd_session_set_hidden (s, hidden->there ? &paint : NULL) == CELD_OK);
}

/* Adds a stroke of a region's colour, or an eraser, or nothing; or takes all away. */
static void
edit_hidden (Hidden *hidden, uint32_t *r)
{
  static const uint8_t black[3] = { 0, 0, 0 };
  uint32_t             what = pick (r, 8);

  if (what < 6)
    paint_box (hidden->paint, random_box (r, 3, 20), what < 5 ? colours[what] : black);
  if (what == 6)
    memset (hidden->paint, 0, sizeof hidden->paint);
  hidden->there = what < 7;
}

/* Whether the edited session has the sheets and their problems, or the error, of a new one; counts hidden pixels and
 * problems. */
static void
agree (CeldSession *edited, const State *state, Hidden *strokes, size_t *hidden, size_t *unsure)
{
  CeldSession      *fresh = celd_session_new ();
  const CeldSheets *one, *other;
  CeldStatus        status;

  apply (fresh, state);
  set_hidden (fresh, strokes);
  status = celd_session_sheets (fresh, NULL, &other);
  CHECK (celd_session_sheets (edited, NULL, &one) == status);
  if (status == CELD_OK && !check_bad)
    {
      CHECK (one->n == other->n);
      for (size_t k = 0; k < one->n && !check_bad; k++)
        {
          CHECK (same_sheet (&one->item[k], &other->item[k]));
          *hidden += one->item[k].n_hidden;
        }
      CHECK (same_problems (&edited->problems[STAGE_SHEETS], &fresh->problems[STAGE_SHEETS]));
      *unsure += edited->problems[STAGE_SHEETS].n;
    }
  celd_session_free (fresh);
}

static void
an_edited_session_has_the_sheets_of_a_new_one (void)
{
  size_t hidden = 0, unsure = 0;

  for (uint32_t seed = 1; seed <= 12 && !check_bad; seed++)
    {
      State        state;
      Hidden       strokes = { 0 };
      CeldSession *edited = celd_session_new ();
      uint32_t     r = 977 * seed;

      start (&state, &r);
      state.text = texts[1 + seed % 3];
      apply (edited, &state);
      for (int step = 0; step < 25 && !check_bad; step++)
        {
          agree (edited, &state, &strokes, &hidden, &unsure);
          if (check_bad)
            fprintf (stderr, "  seed %u, step %d\n", (unsigned) seed, step);
          edit (&state, &r);
          if (pick (&r, 6) == 0)
            state.settings.margin = pick (&r, 2) ? 0.05f : 0.1f;
          apply (edited, &state);
          if (pick (&r, 3) == 0)
            edit_hidden (&strokes, &r);
          set_hidden (edited, &strokes);
          if (pick (&r, 3) == 0)
            {
              int               left = (int) pick (&r, 60);
              CeldHost          host = { check_count_down, NULL, &left };
              const CeldSheets *sheets;

              celd_session_sheets (edited, &host, &sheets);
            }
        }
      celd_session_free (edited);
    }
  CHECK (hidden > 1000 && unsure > 10);
}

/* The first sheet with hidden pixels in the right half of a page 400 wide. */
static const CeldSheet *
far_sheet (const CeldSheets *sheets)
{
  for (size_t k = 0; k < sheets->n; k++)
    if (sheets->item[k].seen.x >= 300 && sheets->item[k].n_hidden && !sheets->item[k].page)
      return &sheets->item[k];
  return NULL;
}

/* The number of hidden pixels that are covered wholly: not in the margin. */
static size_t
covered (const CeldSheet *sheet)
{
  size_t n = 0;

  for (size_t i = 0; i < sheet->n_hidden; i++)
    n += sheet->coverage[i] == 255;
  return n;
}

/* Strokes on the layer `hidden` add to the sheet of their colour, and change nothing before the sheets. */
static void
hide_more (CeldSession *s, CeldPaint *hidden, const uint8_t colour[4])
{
  const CeldSheets *sheets;
  const uint8_t    *coverage;
  CeldPlane         levels;
  CeldRect          changed;
  size_t            n = 0, more = 0;
  uint32_t          label;
  CeldPaint         small = *hidden;

  CHECK (celd_session_levels (s, NULL, &levels, NULL) == CELD_OK);
  CHECK (celd_session_sheets (s, NULL, &sheets) == CELD_OK);
  label    = celd_palette_find (celd_session_palette (s), colour);
  coverage = far_sheet (sheets)->coverage;
  n        = covered (&sheets->item[sheets->of_label[label - 1]]);
  small.width--;
  CHECK (celd_session_set_hidden (s, &small) == CELD_BAD_SIZE);
  for (int x = 62; x < 72; x++)
    memcpy (CELD_RGBA (hidden, x, 38), colour, 4);
  CHECK (celd_session_set_hidden (s, hidden) == CELD_OK);
  CHECK (celd_session_levels (s, NULL, &levels, &changed) == CELD_OK && !changed.width);
  CHECK (celd_session_sheets (s, NULL, &sheets) == CELD_OK);
  more = covered (&sheets->item[sheets->of_label[label - 1]]);
  CHECK (more > n);
  CHECK (far_sheet (sheets)->coverage == coverage);
  memset (hidden->data, 0, 4 * (size_t) hidden->width * (size_t) hidden->height);
  memcpy (CELD_RGBA (hidden, 62, 38), (uint8_t[4]) { 12, 250, 12, 255 }, 4);
  CHECK (celd_session_set_hidden (s, hidden) == CELD_OK); /* a colour that no region has */
  CHECK (celd_session_sheets (s, NULL, &sheets) == CELD_OK);
  CHECK (covered (&sheets->item[sheets->of_label[label - 1]]) == n);
}

/* Two pairs of boxes, each with one box on the other, in the two halves of a wide page. */
static void
a_stroke_keeps_the_sheets_far_from_it (void)
{
  enum { WIDE = 400, HIGH = 60 };
  static float      luma[WIDE * HIGH];
  static uint8_t    paint[4 * WIDE * HIGH], hidden[4 * WIDE * HIGH];
  CeldSession      *s = celd_session_new ();
  CeldDrawing       drawing = { { WIDE, HIGH, WIDE, luma }, { 0 } };
  CeldPaint         scribbles = { WIDE, HIGH, WIDE, paint }, hints = { WIDE, HIGH, WIDE, hidden };
  CeldRect          box[4] = { { 20, 10, 40, 40 }, { 35, 20, 40, 20 }, { 320, 10, 40, 40 }, { 335, 20, 40, 20 } };
  uint8_t           on[4] = { 1, 1, 1, 1 };
  const CeldSheets *sheets;
  const uint8_t    *far_coverage = NULL, first[4] = { 40, 0, 200, 255 };

  for (int i = 0; i < WIDE * HIGH; i++)
    luma[i] = 1;
  for (int i = 0; i < 4; i++)
    {
      CeldRect b = box[i];

      for (int y = b.y; y < b.y + b.height; y++)
        for (int x = b.x; x < b.x + b.width; x++)
          luma[y * WIDE + x] = x < b.x + 2 || y < b.y + 2 || x >= b.x + b.width - 2 || y >= b.y + b.height - 2 ? 0 : 1;
      for (int x = b.x + (i % 2 ? 25 : 5); x < b.x + (i % 2 ? 35 : 12); x++)
        memcpy (paint + 4 * ((b.y + 10) * WIDE + x), (uint8_t[4]) { (uint8_t) (60 * i + 40), 0, 200, 255 }, 4);
    }
  for (int x = 100; x < 300; x++)
    memcpy (paint + 4 * (5 * WIDE + x), (uint8_t[4]) { 0, 255, 0, 255 }, 4);
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  CHECK (celd_session_set_scribbles (s, &scribbles) == CELD_OK);
  CHECK (celd_session_set_relations (s, "70,30 > 25,30\n370,30 > 325,30\n", NULL) == CELD_OK);
  CHECK (celd_session_sheets (s, NULL, &sheets) == CELD_OK);
  CHECK (far_sheet (sheets));
  far_coverage = far_sheet (sheets)->coverage;
  CHECK (celd_session_put_stroke (s, 1, 45, 12, &(CeldMask) { 2, 2, 2, on }, (const uint8_t[3]) { 100, 0, 200 }) ==
         CELD_OK);
  CHECK (celd_session_sheets (s, NULL, &sheets) == CELD_OK);
  CHECK (far_sheet (sheets)->coverage == far_coverage);
  hide_more (s, &hints, first);
  celd_session_free (s);
}

int
main (void)
{
  RUN (an_edited_session_has_the_sheets_of_a_new_one);
  RUN (a_stroke_keeps_the_sheets_far_from_it);
  return DONE;
}
