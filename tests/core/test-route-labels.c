/* A session that is edited step by step against one that is set to the same state at once; and what an edit redoes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "session.h"

#define W 56
#define H 40
#define STROKES 6

/* ------------------------------------------------------------------ a state, and sessions of it */

/* Everything that a host can set, drawn at random. */
typedef struct
{
  float        luma[W * H];
  uint8_t      scribbles[4 * W * H], contours[4 * W * H];
  bool         has_scribbles, has_contours, relation;
  const char  *text;
  CeldSettings settings;
  struct { uint32_t id; CeldRect box; uint8_t colour; } stroke[STROKES];
  uint32_t     n_strokes;
} State;

static const uint8_t colours[6][3] = {
  { 230, 0, 0 }, { 0, 0, 230 }, { 0, 160, 0 }, { 200, 200, 0 }, { 160, 0, 160 }, { 231, 1, 0 } /* nearly the first */
};

static const char *const texts[] = { "", "#e60000 > #0000e6", "10,10 > 40,30; 2,2 < 30,20", "12,34 > 50,6 = 20,20" };

static uint32_t
pick (uint32_t *state, uint32_t n)
{
  return check_random (state, n);
}

static CeldRect
random_box (uint32_t *r, int least, int most)
{
  int w = least + (int) pick (r, (uint32_t) (most - least)), h = least + (int) pick (r, (uint32_t) (most - least));

  return (CeldRect) { (int) pick (r, (uint32_t) (W - w)), (int) pick (r, (uint32_t) (H - h)), w, h };
}

static void
paint_box (uint8_t *paint, CeldRect box, const uint8_t colour[3])
{
  for (int y = box.y; y < box.y + box.height; y++)
    for (int x = box.x; x < box.x + box.width; x++)
      {
        memcpy (paint + 4 * (y * W + x), colour, 3);
        paint[4 * (y * W + x) + 3] = 255;
      }
}

/* Frames with gaps, one over the other, some of them in grey ink. */
static void
draw_frame (float *luma, CeldRect box, int gap)
{
  float grey = box.width % 3 ? 0 : 0.4f;

  for (int y = box.y; y < box.y + box.height; y++)
    for (int x = box.x; x < box.x + box.width; x++)
      {
        bool rim = x < box.x + 2 || y < box.y + 2 || x >= box.x + box.width - 2 || y >= box.y + box.height - 2;

        luma[y * W + x] = rim && !(y >= box.y + 4 && y < box.y + 4 + gap && x < box.x + 2) ? grey : 1.f;
      }
}

static void
new_drawing (State *s, uint32_t *r)
{
  for (int i = 0; i < W * H; i++)
    s->luma[i] = 1;
  for (int i = 0; i < 3; i++)
    draw_frame (s->luma, random_box (r, 12, 30), (int) pick (r, 5));
}

static void
new_scribbles (State *s, uint32_t *r)
{
  memset (s->scribbles, 0, sizeof s->scribbles);
  for (uint32_t i = 0, n = 1 + pick (r, 4); i < n; i++)
    paint_box (s->scribbles, random_box (r, 3, 9), colours[pick (r, 4)]);
}

static void
change_stroke (State *s, uint32_t *r)
{
  uint32_t i = pick (r, STROKES);

  if (i < s->n_strokes && pick (r, 3) == 0)
    {
      memmove (&s->stroke[i], &s->stroke[i + 1], (s->n_strokes - i - 1) * sizeof s->stroke[0]);
      s->n_strokes--;
      return;
    }
  if (i >= s->n_strokes)
    {
      uint32_t id = 1;

      for (uint32_t k = 0; k < s->n_strokes; k++)
        id = s->stroke[k].id >= id ? s->stroke[k].id + 1 : id;
      s->stroke[i = s->n_strokes++].id = id;
    }
  s->stroke[i].box    = random_box (r, 2, 10);
  s->stroke[i].colour = (uint8_t) pick (r, 6);
}

static void
change_settings (CeldSettings *s, uint32_t *r)
{
  switch (pick (r, 9))
    {
    case 0: s->hardness = pick (r, 2) ? 1 : 0.05f; break;
    case 1: s->close_gaps = !s->close_gaps; break;
    case 2: s->keep_necks = !s->keep_necks; break;
    case 3: s->background = pick (r, 2) ? CELD_BACKGROUND_AUTO : CELD_BACKGROUND_NONE; break;
    case 4: s->same_colour = pick (r, 2) ? CELD_SAME_COLOUR_ONE : CELD_SAME_COLOUR_SEPARATE; break;
    case 5: s->ink_threshold = pick (r, 2) ? 0.25f : 0.6f; break;
    case 6: s->method = pick (r, 4) ? CELD_METHOD_BASINS : CELD_METHOD_EXACT; break;
    case 7: s->flats = !pick (r, 4); break;
    case 8: s->seeds = pick (r, 2) ? CELD_SEEDS_AUTO : CELD_SEEDS_SCRIBBLES; break;
    }
}

static void
change_contours (State *s, uint32_t *r)
{
  static const uint8_t of_contours[3][3] = { { 255, 0, 0 }, { 0, 0, 255 }, { 0, 255, 0 } };
  CeldRect             line = random_box (r, 2, 20);

  s->has_contours = pick (r, 3) != 0;
  memset (s->contours, 0, sizeof s->contours);
  line.width = pick (r, 2) ? 2 : line.width;
  line.height = line.width == 2 ? line.height : 2;
  paint_box (s->contours, line, of_contours[pick (r, 3)]);
}

static void
edit (State *s, uint32_t *r)
{
  switch (pick (r, 12))
    {
    default: change_stroke (s, r); break;
    case 0: new_scribbles (s, r); break;
    case 1: s->has_scribbles = !s->has_scribbles; break;
    case 2: draw_frame (s->luma, random_box (r, 9, 14), (int) pick (r, 4)); break;
    case 3: change_contours (s, r); break;
    case 4: s->text = texts[pick (r, 4)]; break;
    case 5: s->relation = !s->relation; break;
    case 6: change_settings (&s->settings, r); break;
    case 7: pick (r, 4) ? change_settings (&s->settings, r) : new_drawing (s, r); break;
    }
}

/* The strokes that a session has become those of the state. */
static void
apply_strokes (CeldSession *session, const State *s)
{
  for (size_t i = session->n_strokes; i-- > 0; )
    {
      uint32_t id = session->stroke[i].id, k = 0;

      while (k < s->n_strokes && s->stroke[k].id != id)
        k++;
      if (k == s->n_strokes)
        CHECK (celd_session_remove_stroke (session, id) == CELD_OK);
    }
  for (uint32_t i = 0; i < s->n_strokes; i++)
    {
      static uint8_t on[W * H];
      CeldRect       box = s->stroke[i].box;
      CeldMask       mask = { box.width, box.height, (size_t) box.width, on };

      memset (on, 1, sizeof on);
      CHECK (celd_session_put_stroke (session, s->stroke[i].id, box.x, box.y, &mask, colours[s->stroke[i].colour]) ==
             CELD_OK);
    }
}

static void
apply (CeldSession *session, const State *state)
{
  State      *s = (State *) state; /* views are not const */
  CeldDrawing drawing = { .luma = { W, H, W, s->luma } };
  CeldPaint   scribbles = { W, H, W, s->scribbles }, contours = { W, H, W, s->contours };

  CHECK (celd_session_set_settings (session, &s->settings) == CELD_OK);
  CHECK (celd_session_set_drawing (session, &drawing) == CELD_OK);
  CHECK (celd_session_set_scribbles (session, s->has_scribbles ? &scribbles : NULL) == CELD_OK);
  CHECK (celd_session_set_contours (session, s->has_contours ? &contours : NULL) == CELD_OK);
  CHECK (celd_session_set_relations (session, s->text, NULL) == CELD_OK);
  if (s->relation)
    CHECK (celd_session_put_relation (session, 5, "6,6 > 50,35", NULL) == CELD_OK);
  else
    celd_session_remove_relation (session, 5);
  apply_strokes (session, s);
}

static void
start (State *s, uint32_t *r)
{
  *s = (State) { .has_scribbles = true, .text = "", .settings = celd_settings () };
  new_drawing (s, r);
  new_scribbles (s, r);
}

/* ------------------------------------------------------------------ comparing */

static bool
same_region (const CeldRegion *a, const CeldRegion *b)
{
  return !memcmp (a->colour, b->colour, 4) && a->origin == b->origin && a->background == b->background &&
         a->hard == b->hard && a->x == b->x && a->y == b->y && a->seeds == b->seeds && a->area == b->area;
}

static bool
same_palette (const CeldPalette *a, const CeldPalette *b)
{
  for (size_t k = 0; k < a->n && a->n == b->n; k++)
    if (!same_region (&a->item[k], &b->item[k]))
      return false;
  return a->n == b->n;
}

static bool
same_problems (const CeldProblems *a, const CeldProblems *b)
{
  for (size_t i = 0; i < a->n && a->n == b->n; i++)
    {
      const CeldProblem *p = &a->item[i], *q = &b->item[i];

      if (p->kind != q->kind || p->x != q->x || p->y != q->y || p->label != q->label || p->other != q->other ||
          p->relation != q->relation)
        return false;
    }
  return a->n == b->n;
}

static bool
same_closures (const CeldClosures *a, const CeldClosures *b)
{
  for (size_t i = 0; i < a->n && a->n == b->n; i++)
    if (a->item[i].n != b->item[i].n || a->item[i].label != b->item[i].label || a->item[i].other != b->item[i].other ||
        memcmp (a->item[i].place, b->item[i].place, a->item[i].n * sizeof *a->item[i].place))
      return false;
  return a->n == b->n;
}

static bool
same_rect (CeldRect a, CeldRect b)
{
  return a.width == b.width && (!a.width || (a.x == b.x && a.y == b.y && a.height == b.height));
}

/* ------------------------------------------------------------------ random edits */

/* Asks both; `seen` is the picture that the host has, brought up to date by the changed rectangle alone. */
static bool
agree (CeldSession *edited, const State *state, uint32_t *seen)
{
  CeldSession        *fresh = celd_session_new ();
  CeldLabels          labels, wanted;
  CeldRect            changed, all;
  const CeldClosures *closures, *wanted_closures;
  CeldStatus          status, wanted_status;
  size_t              bytes = W * H * sizeof *seen;

  apply (fresh, state);
  wanted_status = celd_session_labels (fresh, NULL, &wanted, &all);
  status = celd_session_labels (edited, NULL, &labels, &changed);
  CHECK (status == wanted_status);
  CHECK (status == CELD_OK || status == CELD_NOTHING_TO_GO_BY);
  if (status == CELD_OK && wanted_status == CELD_OK)
    {
      CHECK (!memcmp (labels.data, wanted.data, bytes));
      CHECK (same_palette (celd_session_palette (edited), celd_session_palette (fresh)));
      CHECK (same_problems (celd_session_problems (edited), celd_session_problems (fresh)));
      CHECK (same_rect (all, (CeldRect) { 0, 0, W, H }));
      for (int y = changed.y; y < changed.y + changed.height; y++)
        memcpy (seen + y * W + changed.x, &CELD_AT (&labels, changed.x, y), (size_t) changed.width * sizeof *seen);
      CHECK (!memcmp (labels.data, seen, bytes));
      CHECK (celd_session_closures (edited, NULL, &closures) == CELD_OK);
      CHECK (celd_session_closures (fresh, NULL, &wanted_closures) == CELD_OK);
      CHECK (same_closures (closures, wanted_closures));
    }
  celd_session_free (fresh);
  return !check_bad;
}

static void
edits_make_what_a_fresh_session_makes (void)
{
  for (uint32_t seed = 1; seed <= 12 && !check_bad; seed++)
    {
      static uint32_t seen[W * H];
      State           state;
      CeldSession    *edited = celd_session_new ();
      uint32_t        r = 77 * seed;

      start (&state, &r);
      apply (edited, &state);
      for (int step = 0; step < 40 && !check_bad; step++)
        {
          if (!agree (edited, &state, seen))
            fprintf (stderr, "  seed %u, step %d\n", (unsigned) seed, step);
          for (uint32_t i = 0, n = 1 + pick (&r, 2); i < n; i++)
            edit (&state, &r);
          apply (edited, &state);
        }
      celd_session_free (edited);
    }
}

/* ------------------------------------------------------------------ cancelled edits */

/* An edit is cancelled at each of its reports; then another one follows, and all is as if nothing had happened. */
static void
cancelled_edits_do_no_harm (void)
{
  for (uint32_t seed = 1; seed <= 6 && !check_bad; seed++)
    {
      static uint32_t seen[W * H];
      State           state;
      CeldSession    *edited = celd_session_new ();
      uint32_t        r = 991 * seed;

      start (&state, &r);
      apply (edited, &state);
      for (int step = 0; step < 30 && !check_bad; step++)
        {
          int        left = (int) pick (&r, 12);
          CeldRun    run = { check_count_down, NULL, &left };
          CeldLabels labels;
          CeldRect   changed = { -1, -1, -1, -1 };
          CeldStatus status = celd_session_labels (edited, &run, &labels, &changed);

          CHECK (status == CELD_OK || status == CELD_CANCELLED || status == CELD_NOTHING_TO_GO_BY);
          if (status == CELD_OK)
            for (int y = changed.y; y < changed.y + changed.height; y++)
              memcpy (seen + y * W + changed.x, &CELD_AT (&labels, changed.x, y),
                      (size_t) changed.width * sizeof *seen);
          else
            CHECK (changed.width == -1);
          if (pick (&r, 2) && !agree (edited, &state, seen))
            fprintf (stderr, "  seed %u, step %d\n", (unsigned) seed, step);
          edit (&state, &r);
          apply (edited, &state);
        }
      celd_session_free (edited);
    }
}

/* ------------------------------------------------------------------ what an edit redoes */

/* A session that has made everything, of a drawing with a box, scribbled inside and outside. */
static CeldSession *
finished (State *s)
{
  CeldSession *session = celd_session_new ();
  CeldPlane    plane;

  *s = (State) { .has_scribbles = true, .text = "#e60000 > #0000e6", .settings = celd_settings () };
  for (int i = 0; i < W * H; i++)
    s->luma[i] = 1;
  draw_frame (s->luma, (CeldRect) { 14, 10, 26, 20 }, 0);
  paint_box (s->scribbles, (CeldRect) { 20, 16, 8, 3 }, colours[0]);
  paint_box (s->scribbles, (CeldRect) { 4, 3, 40, 2 }, colours[1]);
  apply (session, s);
  CHECK (celd_session_flat (session, NULL, &plane, NULL) == CELD_OK);
  CHECK (celd_session_depth (session, NULL, &plane, NULL) == CELD_OK);
  CHECK (celd_session_shading (session, NULL, &plane, NULL) == CELD_OK);
  return session;
}

#define ALL ((1u << N_STAGES) - 1)
#define STAGE(name) (1u << STAGE_##name)
#define FROM_ORDER  (STAGE (ORDER) | STAGE (FLAT) | STAGE (LEVELS) | STAGE (DEPTH) | STAGE (NORMALS) | STAGE (SHADING))
#define FROM_LABELS (STAGE (LABELS) | FROM_ORDER)

static unsigned
still_made (const CeldSession *s)
{
  unsigned made = 0;

  for (int i = 0; i < N_STAGES; i++)
    made |= s->valid[i] ? 1u << i : 0;
  return made;
}

/* After the setting has changed, the stages that read it are missing, and what is made from them; no other. */
#define REDOES(change, stages) \
  do { \
    State        state_; \
    CeldSession *s_ = finished (&state_); \
    CeldSettings settings = state_.settings; \
    CHECK (still_made (s_) == ALL); \
    change; \
    CHECK (celd_session_set_settings (s_, &settings) == CELD_OK); \
    CHECK (still_made (s_) == (ALL & ~(unsigned) (stages))); \
    celd_session_free (s_); \
  } while (0)

static void
a_setting_redoes_what_reads_it (void)
{
  REDOES ((void) 0, 0);
  REDOES (settings.ink = CELD_INK_DARK, STAGE (INK) | FROM_LABELS);
  REDOES (settings.flats = true, STAGE (SCRIBBLES) | STAGE (SEEDS) | FROM_LABELS);
  REDOES (settings.method = CELD_METHOD_EXACT, FROM_LABELS);
  REDOES (settings.close_gaps = false, FROM_LABELS);
  REDOES (settings.keep_necks = false, FROM_LABELS);
  REDOES (settings.hardness = 1, FROM_LABELS);
  REDOES (settings.ink_threshold = 0.5f, FROM_LABELS);
  REDOES (settings.arrow_style = CELD_ARROW_DOT, STAGE (RELATIONS) | FROM_LABELS);
  REDOES (settings.encoding = CELD_ENCODING_RANK, FROM_ORDER & ~STAGE (ORDER));
  REDOES (settings.near_level = 3, FROM_ORDER & ~STAGE (ORDER));
  REDOES (settings.tolerance = 1e-3f, STAGE (DEPTH) | STAGE (NORMALS) | STAGE (SHADING));
  REDOES (settings.anchors = CELD_ANCHORS_CORE, STAGE (DEPTH));
  REDOES (settings.bulge = 2, STAGE (NORMALS) | STAGE (SHADING));
  REDOES (settings.ambient = 0.5f, STAGE (SHADING));
}

static void
layers_redo_what_is_made_of_them (void)
{
  State        state;
  CeldSession *s = finished (&state);
  uint8_t      on[4] = { 1, 1, 1, 1 };
  CeldPaint    scribbles = { W, H, W, state.scribbles };

  CHECK (celd_session_put_stroke (s, 1, 30, 25, &(CeldMask) { 2, 2, 2, on }, colours[0]) == CELD_OK);
  CHECK (still_made (s) == (ALL & ~(STAGE (SEEDS) | FROM_LABELS)));
  paint_box (state.scribbles, (CeldRect) { 22, 22, 4, 4 }, colours[0]);
  CHECK (celd_session_set_scribbles (s, &scribbles) == CELD_OK);
  CHECK (still_made (s) == (ALL & ~(STAGE (SCRIBBLES) | STAGE (SEEDS) | FROM_LABELS)));
  celd_session_free (s);
}

/* What the segmenter has is the same picture until the ink differs: then it hears of it once. */
static void
the_segmenter_hears_of_new_ink_alone (void)
{
  static uint8_t blank[4 * W * H];
  State          state;
  CeldSession   *s = finished (&state);
  CeldDrawing    drawing = { .luma = { W, H, W, state.luma } };
  const float   *known = s->known_ink.data;
  uint8_t        on[4] = { 1, 1, 1, 1 };
  CeldSettings   settings = state.settings;
  CeldLabels     labels;
  CeldPlane      ink;
  CeldRect       changed;

  CHECK (known && known == s->ink.data);
  CHECK (celd_session_put_stroke (s, 1, 30, 25, &(CeldMask) { 2, 2, 2, on }, colours[2]) == CELD_OK);
  settings.hardness = 1;
  settings.ink = CELD_INK_DARK; /* which it is */
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
  CHECK (celd_session_set_contours (s, &(CeldPaint) { W, H, W, blank }) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  CHECK (s->known_ink.data == known && s->ink.data == known);

  draw_frame (state.luma, (CeldRect) { 44, 20, 9, 9 }, 0);
  CHECK (celd_session_ink (s, NULL, &ink, &changed) == CELD_OK);
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  CHECK (celd_session_ink (s, NULL, &ink, &changed) == CELD_OK);
  CHECK (changed.x >= 43 && changed.y >= 19 && changed.x + changed.width <= 54 && changed.y + changed.height <= 30);
  CHECK (s->known_ink.data == known && s->ink.data != known); /* it has not been asked yet */
  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  CHECK (s->known_ink.data == s->ink.data && s->ink.data != known);
  celd_session_free (s);
}

/* A stroke that changes one region says so, and one that changes nothing too. */
static void
a_stroke_changes_its_region_alone (void)
{
  State        state;
  CeldSession *s = finished (&state);
  uint8_t      on[24];
  CeldMask     mask = { 8, 3, 8, on };
  CeldLabels   labels;
  CeldRect     changed;

  memset (on, 1, sizeof on);
  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  CHECK (celd_session_put_stroke (s, 1, 26, 24, &mask, colours[0]) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, &changed) == CELD_OK && changed.width == 0);
  CHECK (celd_session_put_stroke (s, 2, 20, 16, &mask, colours[2]) == CELD_OK); /* over the layer's only red */
  CHECK (celd_session_put_stroke (s, 1, 26, 24, &mask, colours[2]) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, &changed) == CELD_OK);
  CHECK (celd_session_palette (s)->n == 2 && celd_palette_find (celd_session_palette (s), colours[2]) == 2);
  CHECK (celd_session_put_stroke (s, 1, 26, 24, &mask, colours[3]) == CELD_OK);
  CHECK (celd_session_put_stroke (s, 2, 20, 16, &mask, colours[3]) == CELD_OK); /* the same number, another colour */
  CHECK (celd_session_labels (s, NULL, &labels, &changed) == CELD_OK && changed.width == 0);
  CHECK (celd_palette_find (celd_session_palette (s), colours[3]) == 2);
  CHECK (celd_session_put_stroke (s, 1, 26, 24, &mask, colours[1]) == CELD_OK);
  CHECK (celd_session_put_stroke (s, 2, 20, 16, &mask, colours[1]) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, &changed) == CELD_OK && celd_session_palette (s)->n == 1);
  CHECK (changed.x >= 13 && changed.y >= 9 && changed.x + changed.width <= 41 && changed.y + changed.height <= 31);
  CHECK (changed.width >= 22 && changed.height >= 16);
  celd_session_free (s);
}

/* The rectangle of the labels is not lost when the closures are asked for first. */
static void
closures_leave_the_labels_to_be_seen (void)
{
  State               state;
  CeldSession        *s = finished (&state);
  const CeldClosures *closures;
  uint8_t             on[4] = { 1, 1, 1, 1 };
  CeldLabels          labels;
  CeldRect            changed;

  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  CHECK (celd_session_remove_stroke (s, 1) == CELD_BAD_VALUE);
  CHECK (celd_session_set_scribbles (s, NULL) == CELD_OK);
  CHECK (celd_session_closures (s, NULL, &closures) == CELD_NOTHING_TO_GO_BY);
  CHECK (celd_session_put_stroke (s, 1, 30, 25, &(CeldMask) { 2, 2, 2, on }, colours[0]) == CELD_OK);
  CHECK (celd_session_put_stroke (s, 2, 1, 1, &(CeldMask) { 2, 2, 2, on }, colours[2]) == CELD_OK);
  CHECK (celd_session_put_stroke (s, 3, 20, 20, &(CeldMask) { 2, 2, 2, on }, colours[1]) == CELD_OK);
  CHECK (celd_session_closures (s, NULL, &closures) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, &changed) == CELD_OK && changed.width > 0);
  CHECK (celd_session_labels (s, NULL, &labels, &changed) == CELD_OK && changed.width == 0);
  celd_session_free (s);
  s = celd_session_new ();
  CHECK (celd_session_closures (s, NULL, &closures) == CELD_BAD_SIZE); /* no drawing yet */
  celd_session_free (s);
}

int
main (void)
{
  RUN (edits_make_what_a_fresh_session_makes);
  RUN (cancelled_edits_do_no_harm);
  RUN (a_setting_redoes_what_reads_it);
  RUN (layers_redo_what_is_made_of_them);
  RUN (the_segmenter_hears_of_new_ink_alone);
  RUN (a_stroke_changes_its_region_alone);
  RUN (closures_leave_the_labels_to_be_seen);
  return DONE;
}
