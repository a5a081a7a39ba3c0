/* Makes every allocation of every step fail once, and cancels every step at each of its reports of progress.
 *
 * A step then answers CELD_NO_MEMORY or CELD_CANCELLED (or succeeds all the same, with the same result), leaves its
 * results as they were, and gives back all it has taken.  A session delivers when it is asked again.
 * The program is linked with --wrap, so that the four functions below stand before those of the C library.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "faults.h"
#include "sheets/sheets.h"

/* ------------------------------------------------------------------ memory that fails */

static size_t allocations, failing; /* number so far; number of the one that fails, from 1, or 0 for none */
static long   live;                 /* blocks that are not freed */

void *__real_malloc (size_t size);
void *__real_calloc (size_t count, size_t size);
void *__real_realloc (void *memory, size_t size);
void  __real_free (void *memory);
void *__wrap_malloc (size_t size);
void *__wrap_calloc (size_t count, size_t size);
void *__wrap_realloc (void *memory, size_t size);
void  __wrap_free (void *memory);

static void *
counted (void *memory)
{
  live += memory != NULL;
  return memory;
}

void *
__wrap_malloc (size_t size)
{
  return ++allocations == failing ? NULL : counted (__real_malloc (size));
}

void *
__wrap_calloc (size_t count, size_t size)
{
  return ++allocations == failing ? NULL : counted (__real_calloc (count, size));
}

void *
__wrap_realloc (void *memory, size_t size)
{
  if (++allocations == failing)
    return NULL;
  return memory ? __real_realloc (memory, size) : counted (__real_realloc (NULL, size));
}

void
__wrap_free (void *memory)
{
  live -= memory != NULL;
  __real_free (memory);
}

/* ------------------------------------------------------------------ a host that cancels */

typedef struct { int calls, last; double done; } Watch; /* reports so far; the last one that does not cancel */

static bool
report (void *data, double done)
{
  Watch *watch = data;

  CHECK (done >= watch->done && done <= 1);
  watch->done = done;
  return ++watch->calls <= watch->last;
}

/* ------------------------------------------------------------------ results before and after */

static Pixels result_pixels;

static void
start_results (const Step *step, Results *r)
{
  *r = (Results) { .pixels = &result_pixels };
  memset (&result_pixels, 0x3e, sizeof result_pixels);
  memcpy (result_pixels.labels, label_pixels.labels, sizeof label_pixels.labels);
  if (step->palette)
    {
      r->palette.item = malloc (step->palette->n * sizeof *r->palette.item);
      r->palette.n = step->palette->n;
      memcpy (r->palette.item, step->palette->item, step->palette->n * sizeof *r->palette.item);
    }
}

static void
clear_results (Results *r)
{
  celd_palette_clear (&r->palette);
  celd_relations_clear (&r->relations);
  celd_problems_clear (&r->problems);
  celd_order_clear (&r->order);
}

static uint64_t
add_bytes (uint64_t print, const void *data, size_t size)
{
  const uint8_t *byte = data;

  for (size_t i = 0; i < size; i++)
    print = (print ^ byte[i]) * 1099511628211u; /* FNV-1a */
  return print;
}

/* A hash of results: pixels, colours, areas, relations, levels, and their numbers. */
static uint64_t
fingerprint (const Results *r)
{
  size_t   count[] = { r->palette.n, r->relations.n, r->problems.n, r->order.n, r->order.n_cycles };
  uint64_t print = add_bytes (14695981039346656037u, count, sizeof count);

  print = add_bytes (print, r->pixels, sizeof *r->pixels);
  for (size_t k = 0; k < r->palette.n; k++)
    {
      print = add_bytes (print, r->palette.item[k].colour, 4);
      print = add_bytes (print, &r->palette.item[k].area, sizeof r->palette.item[k].area);
      print = print * 2 + r->palette.item[k].background;
    }
  for (size_t k = 0; k < r->relations.n; k++)
    print = add_bytes (print, &r->relations.item[k].nearer.x, sizeof (double));
  return r->order.n ? add_bytes (print, r->order.level, r->order.n * sizeof *r->order.level) : print;
}

/* ------------------------------------------------------------------ the tests of the steps */

/* Runs a step, which must return `failure` and leave everything as before, or succeed with the undisturbed result. */
static void
try_once (const Step *step, size_t fail, int last_report, CeldStatus failure, uint64_t wanted)
{
  Results    r;
  Watch      watch = { 0, last_report, 0 };
  CeldHost   host = { report, NULL, &watch };
  long       taken = live;
  uint64_t   before;
  CeldStatus status;

  start_results (step, &r);
  before = fingerprint (&r);
  allocations = 0;
  failing = fail;
  status = step->go (&host, &r);
  failing = 0;
  if (status)
    CHECK (status == failure);
  CHECK (fingerprint (&r) == (status ? before : wanted));
  CHECK (status || failure != CELD_CANCELLED);
  clear_results (&r);
  CHECK (live == taken);
  if (check_bad)
    fprintf (stderr, "  in step %s: allocation %zu fails, cancelled after %d reports\n", step->name, fail, last_report);
}

/* Runs a step undisturbed, to count its allocations and reports, and to hash its result. */
static uint64_t
try_undisturbed (const Step *step, size_t *n_allocations, int *n_reports)
{
  Results  r;
  Watch    watch = { 0, INT32_MAX, 0 };
  CeldHost host = { report, NULL, &watch };
  long     taken = live;
  uint64_t print;

  start_results (step, &r);
  allocations = 0;
  CHECK (step->go (&host, &r) == CELD_OK);
  *n_allocations = allocations;
  *n_reports = watch.calls;
  print = fingerprint (&r);
  clear_results (&r);
  CHECK (live == taken);
  return print;
}

static void
steps_survive_every_failing_allocation (void)
{
  const Step *step;

  for (size_t i = 0; !check_bad && (step = step_at (i)) != NULL; i++)
    {
      size_t   n;
      int      reports;
      uint64_t print = try_undisturbed (step, &n, &reports);

      for (size_t k = 1; k <= n && !check_bad; k++)
        try_once (step, k, INT32_MAX, CELD_NO_MEMORY, print);
    }
}

static void
steps_can_be_cancelled_at_every_report (void)
{
  const Step *step;

  for (size_t i = 0; !check_bad && (step = step_at (i)) != NULL; i++)
    {
      size_t   n;
      int      reports;
      uint64_t print = try_undisturbed (step, &n, &reports);

      CHECK (!step->reports || reports > 0);
      for (int k = 0; k < reports && !check_bad; k++)
        try_once (step, 0, k, CELD_CANCELLED, print);
    }
}

/* ------------------------------------------------------------------ the session */

/* A stroke, and the drawing with another line. */
static CeldStatus
put_stroke (CeldSession *s)
{
  uint8_t  on[8] = { 1, 1, 0, 1, 1, 1, 0, 1 };
  CeldMask mask = { 4, 2, 4, on };

  return celd_session_put_stroke (s, 3, 36, 30, &mask, (const uint8_t[3]) { 200, 200, 0 });
}

static CeldStatus
draw_line (CeldSession *s)
{
  static Pixels page;
  CeldDrawing   drawing = drawing_of (&page);

  page = drawing_pixels;
  for (int y = 19; y < 39; y++)
    page.plane[y * W + 47] = page.plane[y * W + 48] = 0;
  return celd_session_set_drawing (s, &drawing);
}

static CeldStatus
set_apart (CeldSession *s)
{
  CeldSettings settings = celd_settings ();

  settings.same_colour = CELD_SAME_COLOUR_SEPARATE;
  settings.hardness    = 1;
  return celd_session_set_settings (s, &settings);
}

/* Adds heights of a relief, which takes levels and depth, to those of depth before. */
static CeldStatus
add_relief (CeldSession *s, const CeldHost *host, Pixels *out)
{
  CeldRelief relief = { 0 };
  CeldStatus status = celd_session_relief (s, host, &relief);

  for (int p = 0; !status && p < W * H; p++)
    out->plane[p] += relief.z[p];
  celd_relief_clear (&relief);
  return status;
}

/* The i-th call of a session; false after the last one. */
static bool
call_session (CeldSession *s, int i, const CeldHost *host, Pixels *out, CeldStatus *status)
{
  CeldDrawing drawing = drawing_of (&drawing_pixels);
  CeldPaint   scribbles = paint_of (&scribble_pixels), arrows = paint_of (&arrow_pixels);
  CeldPaint   contours = paint_of (&contour_pixels), closures = paint_of (out);
  CeldLabels  labels = { 0 };
  CeldPlane   plane = { 0 };
  CeldVectors vectors = { 0 };
  CeldRect    changed;
  const CeldSheets *sheets = NULL;

  switch (i)
    {
    case 0: *status = celd_session_set_drawing (s, &drawing); break;
    case 1: *status = celd_session_set_scribbles (s, &scribbles); break;
    case 2: *status = celd_session_set_arrows (s, &arrows); break;
    case 3: *status = celd_session_set_contours (s, &contours); break;
    case 4: *status = celd_session_put_relation (s, 7, "#2040e0 > #20c040", NULL); break;
    case 5: *status = celd_session_set_relations (s, "#e02020 > #20c040", NULL); break;
    case 6: *status = celd_session_labels (s, host, &labels, &changed); break;
    case 7: *status = celd_session_levels (s, host, &plane, &changed); break;
    case 8: *status = celd_session_remove_relation (s, 7); break;
    case 9: *status = celd_session_depth (s, host, &plane, &changed); break;
    case 10: *status = celd_session_normals (s, host, &vectors, &changed); break;
    case 11: *status = celd_session_shading (s, host, &plane, &changed); break;
    case 12: *status = put_stroke (s); break;
    case 13: *status = celd_session_labels (s, host, &labels, &changed); break;
    case 14: *status = draw_line (s); break;
    case 15: *status = celd_session_labels (s, host, &labels, &changed); break;
    case 16: *status = set_apart (s); break;
    case 17: *status = celd_session_labels (s, host, &labels, &changed); break;
    case 18: *status = celd_session_remove_stroke (s, 3); break;
    case 19: *status = celd_session_paint_closures (s, host, &closures); break;
    case 20: *status = celd_session_depth_preview (s, host, &plane, &changed); break;
    case 21: *status = celd_session_depth (s, host, &plane, &changed); break;
    case 22: *status = celd_session_exact (s, host, &plane, &changed); break;
    case 23: *status = celd_session_put_relation (s, 8, "10,30 > 50,35", NULL); break;
    case 24: *status = celd_session_exact (s, host, &plane, &changed); break;
    case 25: *status = celd_session_exact_preview (s, host, &plane); break;
    case 26: *status = celd_session_sheets (s, host, &sheets); break;
    case 27: *status = put_stroke (s); break;
    case 28: *status = celd_session_sheets (s, host, &sheets); break;
    case 29: *status = add_relief (s, host, out); break;
    default: return false;
    }
  if (!*status && i == 24)
    memcpy (out->alpha, plane.data, sizeof out->alpha);
  if (!*status && vectors.data)
    memcpy (out->vectors, vectors.data, sizeof out->vectors);
  if (!*status && (i == 9 || i == 21))
    memcpy (out->plane, plane.data, sizeof out->plane);
  if (!*status && i == 11)
    memcpy (out->alpha, plane.data, sizeof out->alpha);
  for (size_t k = 0; !*status && sheets && k < sheets->n; k++)
    out->labels[k] = 31 * out->labels[k] + (uint32_t) sheets->item[k].n_hidden;
  for (int p = 0; !*status && labels.data && p < W * H; p++)
    out->labels[p] = 31 * out->labels[p] + labels.data[p];
  return true;
}

#define MOST_CALLS 32

typedef struct { size_t allocations[MOST_CALLS]; int reports[MOST_CALLS]; } Counts; /* of each call */

/* One call of a session, of which an allocation fails, or which is cancelled; it is repeated then, undisturbed. */
static bool
disturb_call (CeldSession *s, int i, size_t fail, int last_report, Counts *counts)
{
  Watch      watch = { 0, last_report, 0 };
  CeldHost   host = { report, NULL, &watch };
  CeldStatus status;
  bool       more;

  allocations = 0;
  failing = fail;
  more = call_session (s, i, &host, &result_pixels, &status);
  failing = 0;
  if (!more)
    return false;
  counts->allocations[i] = allocations;
  counts->reports[i] = watch.calls;
  CHECK (!status || status == (fail ? CELD_NO_MEMORY : CELD_CANCELLED));
  CHECK (status || watch.calls <= last_report);
  if (status)
    {
      watch = (Watch) { 0, INT32_MAX, 0 };
      call_session (s, i, &host, &result_pixels, &status);
      CHECK (status == CELD_OK);
    }
  return true;
}

/* A hash of all results of a session.  In every call the allocation of that number fails (0: none does), or the host
 * cancels after so many reports: there are far fewer runs than if one call in a run was disturbed. */
static uint64_t
run_session (size_t fail, int last_report, Counts *counts)
{
  long         taken = live;
  CeldSession *s;
  uint64_t     print;

  memset (&result_pixels, 0, sizeof result_pixels);
  s = celd_session_new ();
  CHECK (s != NULL);
  for (int i = 0; s && i < MOST_CALLS && disturb_call (s, i, fail, last_report, counts); i++)
    ;
  print = add_bytes (0, &result_pixels, sizeof result_pixels);
  celd_session_free (s);
  CHECK (live == taken);
  return print;
}

static void
a_session_needs_memory_to_begin (void)
{
  CeldSession *s;
  long         taken = live;

  for (size_t k = 1; ; k++)
    {
      allocations = 0;
      failing = k;
      s = celd_session_new ();
      failing = 0;
      if (s)
        break;
      CHECK (live == taken);
    }
  celd_session_free (s);
  CHECK (live == taken);
}

static void
a_session_works_after_failures (void)
{
  Counts   counts = { 0 }, ignored;
  uint64_t wanted = run_session (0, INT32_MAX, &counts);
  size_t   n = 0;
  int      reports = 0;

  for (int i = 0; i < MOST_CALLS; i++)
    {
      n = counts.allocations[i] > n ? counts.allocations[i] : n;
      reports = counts.reports[i] > reports ? counts.reports[i] : reports;
    }
  CHECK (n > 100 && reports > 10);
  for (size_t k = 1; k <= n && !check_bad; k++)
    {
      CHECK (run_session (k, INT32_MAX, &ignored) == wanted);
      if (check_bad)
        fprintf (stderr, "  allocation %zu of each call of the session fails\n", k);
    }
  for (int k = 0; k < reports && !check_bad; k++)
    {
      CHECK (run_session (0, k, &ignored) == wanted);
      if (check_bad)
        fprintf (stderr, "  each call of the session is cancelled after %d reports\n", k);
    }
}

static void
inputs_of_all_steps_can_be_made (void)
{
  CHECK (make_inputs ());
}

int
main (void)
{
  RUN (inputs_of_all_steps_can_be_made);
  RUN (steps_survive_every_failing_allocation);
  RUN (steps_can_be_cancelled_at_every_report);
  RUN (a_session_needs_memory_to_begin);
  RUN (a_session_works_after_failures);
  free_inputs ();
  return DONE;
}
