/* An edited session compared with a new one in the same state; and the stages that an edit invalidates.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "random-session.h"
#include "image/image.h"
#include "session/session.h"

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
          p->relation != q->relation || p->reason != q->reason || p->runs != q->runs)
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

/* Compares both; `seen` is the host's picture, updated only within reported rectangles. */
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
an_edited_session_equals_a_new_one (void)
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

/* ------------------------------------------------------------------ relations come and go */

#define MOST_SINGLE 24

typedef struct { uint32_t id; char text[64]; } Single;

static bool
same_cycles (const CeldOrder *a, const CeldOrder *b)
{
  for (size_t k = 0; k < a->n_cycles && a->n_cycles == b->n_cycles; k++)
    if (a->cycle[k].n != b->cycle[k].n || a->cycle[k].label != b->cycle[k].label ||
        memcmp (a->cycle[k].item, b->cycle[k].item, a->cycle[k].n * sizeof *a->cycle[k].item))
      return false;
  return a->n_cycles == b->n_cycles && a->n_sccs == b->n_sccs;
}

static bool
same_order (const CeldOrder *a, const CeldOrder *b)
{
  return a->n == b->n && a->levels == b->levels && !memcmp (a->level, b->level, a->n * sizeof *a->level) &&
         !a->height == !b->height && (!a->height || !memcmp (a->height, b->height, a->levels * sizeof *a->height)) &&
         same_cycles (a, b);
}

/* Puts a relation between random points in, in place of that with the same id, or takes one out; the list says which
 * there are, in the order in which they count. */
static void
change_relation (CeldSession *session, Single *list, size_t *n, uint32_t *r)
{
  static const char *const flags[] = { "", "", "", "", "", "@2", "+2", "+0.5" };
  uint32_t                 id = 1 + pick (r, MOST_SINGLE);
  bool                     there = false, take_out = pick (r, 6) == 0;
  size_t                   k = 0;

  for (k = 0; k < *n && list[k].id != id; k++)
    ;
  there = k < *n;
  if (there)
    memmove (&list[k], &list[k + 1], (--*n - k) * sizeof *list);
  if (take_out)
    {
      CHECK ((celd_session_remove_relation (session, id) == CELD_OK) == there);
      return;
    }
  list[*n].id = id;
  snprintf (list[*n].text, sizeof list[*n].text, "%u,%u %s %u,%u %s", (unsigned) pick (r, W), (unsigned) pick (r, H),
            pick (r, 8) ? ">" : "=", (unsigned) pick (r, W), (unsigned) pick (r, H), flags[pick (r, 8)]);
  CHECK (celd_session_put_relation (session, id, list[(*n)++].text, NULL) == CELD_OK);
}

static void
compare_orders (CeldSession *edited, const State *state, const Single *list, size_t n)
{
  CeldSession     *fresh = celd_session_new ();
  const CeldOrder *order, *wanted;
  CeldLabels       labels, wanted_labels;

  apply (fresh, state);
  for (size_t k = 0; k < n; k++)
    CHECK (celd_session_put_relation (fresh, list[k].id, list[k].text, NULL) == CELD_OK);
  CHECK (celd_session_order (fresh, NULL, &wanted) == CELD_OK && celd_session_order (edited, NULL, &order) == CELD_OK);
  CHECK (celd_session_labels (fresh, NULL, &wanted_labels, NULL) == CELD_OK);
  CHECK (celd_session_labels (edited, NULL, &labels, NULL) == CELD_OK);
  if (check_bad)
    return;
  CHECK (!memcmp (labels.data, wanted_labels.data, W * H * sizeof *labels.data));
  CHECK (same_palette (celd_session_palette (edited), celd_session_palette (fresh)));
  CHECK (same_order (order, wanted));
  CHECK (same_problems (celd_session_problems (edited), celd_session_problems (fresh)));
  celd_session_free (fresh);
}

/* A session whose relations change one by one has the labels of one that gets all of them at once. */
static void
relations_may_be_added_one_by_one (void)
{
  for (uint32_t seed = 1; seed <= 60 && !check_bad; seed++)
    {
      Single       list[MOST_SINGLE + 1];
      size_t       n = 0;
      State        state;
      CeldSession *edited = celd_session_new ();
      uint32_t     r = 577 * seed;

      start (&state, &r);
      new_drawing (&state, &r);
      for (int i = 0; i < 3; i++)
        draw_frame (state.luma, random_box (&r, 9, 20), 0);
      new_scribbles (&state, &r);
      state.has_scribbles = true;
      state.relation = false;
      state.settings.seeds = seed % 3 ? CELD_SEEDS_SCRIBBLES : CELD_SEEDS_AUTO;
      state.settings.same_colour = seed % 2 ? CELD_SAME_COLOUR_SEPARATE : CELD_SAME_COLOUR_ONE;
      state.settings.on_cycle = (CeldOnCycle) (seed % 4 ? CELD_ON_CYCLE_REPORT
                                                        : pick (&r, 2) ? CELD_ON_CYCLE_SPLIT
                                                                       : CELD_ON_CYCLE_DROP_WEAKEST);
      apply (edited, &state);
      for (int step = 0; step < 40 && !check_bad; step++)
        {
          change_relation (edited, list, &n, &r);
          if (pick (&r, 4))
            compare_orders (edited, &state, list, n);
          if (check_bad)
            fprintf (stderr, "  seed %u, step %d\n", (unsigned) seed, step);
        }
      celd_session_free (edited);
    }
}

/* ------------------------------------------------------------------ cancelled edits */

/* Cancels an edit at each of its reports; after another edit the session equals a new one. */
static void
an_edit_after_a_cancelled_one_equals_a_new_session (void)
{
  int cancelled = 0, finished = 0;

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
          int        left = (int) pick (&r, 60);
          CeldHost   host = { check_count_down, NULL, &left };
          CeldLabels labels;
          CeldRect   changed = { -1, -1, -1, -1 };
          CeldStatus status = celd_session_labels (edited, &host, &labels, &changed);

          CHECK (status == CELD_OK || status == CELD_CANCELLED || status == CELD_NOTHING_TO_GO_BY);
          cancelled += status == CELD_CANCELLED;
          finished += status == CELD_OK;
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
  CHECK (cancelled >= 20 && finished >= 20); /* of 180 */
}

/* ------------------------------------------------------------------ stages that an edit invalidates */

/* A session that has made everything, of a drawing with a box, scribbled inside and outside. */
static CeldSession *
finished (State *s)
{
  CeldSession         *session = celd_session_new ();
  CeldPlane            plane;
  const CeldRelations *suggested;
  const CeldSheets    *sheets;

  *s = (State) { .has_scribbles = true, .text = "#e60000 > #0000e6", .settings = celd_settings () };
  for (int i = 0; i < W * H; i++)
    s->luma[i] = 1;
  draw_frame (s->luma, (CeldRect) { 14, 10, 26, 20 }, 0);
  paint_box (s->scribbles, (CeldRect) { 20, 16, 8, 3 }, colours[0]);
  paint_box (s->scribbles, (CeldRect) { 4, 3, 40, 2 }, colours[1]);
  apply (session, s);
  CHECK (celd_session_suggestions (session, NULL, &suggested) == CELD_OK);
  CHECK (celd_session_unexpanded_levels (session, NULL, &plane, NULL) == CELD_OK);
  CHECK (celd_session_depth_preview (session, NULL, &plane, NULL) == CELD_OK);
  CHECK (celd_session_depth (session, NULL, &plane, NULL) == CELD_OK);
  CHECK (celd_session_shading (session, NULL, &plane, NULL) == CELD_OK);
  CHECK (celd_session_sheets (session, NULL, &sheets) == CELD_OK);
  CHECK (celd_session_exact (session, NULL, &plane, NULL) == CELD_OK);
  return session;
}

#define ALL ((1u << N_STAGES) - 1)
#define STAGE(name) (1u << STAGE_##name)
#define DEPTHS      (STAGE (PREVIEW) | STAGE (DEPTH))
#define FROM_LEVELS (STAGE (LEVELS) | DEPTHS | STAGE (NORMALS) | STAGE (SHADING))
#define FROM_ORDER  (STAGE (ORDER) | STAGE (UNEXPANDED) | STAGE (OWNERSHIP) | STAGE (SHEETS) | FROM_LEVELS)
#define FROM_LABELS (STAGE (LABELS) | STAGE (SUGGESTIONS) | FROM_ORDER)
#define FROM_NODES  (STAGE (NODES) | STAGE (EXACT))
#define FROM_INK    (STAGE (INK) | FROM_LABELS | STAGE (WEIGHTS) | FROM_NODES)
#define FROM_SEEDS  (STAGE (SEEDS) | FROM_LABELS | FROM_NODES)

static unsigned
still_made (const CeldSession *s)
{
  unsigned made = 0;

  for (int i = 0; i < N_STAGES; i++)
    made |= s->valid[i] ? 1u << i : 0;
  return made;
}

/* After a change of the setting the stages that read it are invalid, with those made from them, and no others. */
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
a_setting_invalidates_the_stages_that_read_it (void)
{
  REDOES ((void) 0, 0);
  REDOES (settings.ink = CELD_INK_DARK, FROM_INK);
  REDOES (settings.flats = true, STAGE (SCRIBBLES) | FROM_SEEDS);
  REDOES (settings.method = CELD_METHOD_EXACT, FROM_LABELS);
  REDOES (settings.close_gaps = false, FROM_LABELS | FROM_NODES);
  REDOES (settings.keep_necks = false, FROM_LABELS | FROM_NODES);
  REDOES (settings.hardness = 1, FROM_LABELS | FROM_NODES);
  REDOES (settings.ink_threshold = 0.5f, FROM_LABELS | FROM_NODES);
  REDOES (settings.arrow_style = CELD_ARROW_DOT, STAGE (RELATIONS) | FROM_ORDER | STAGE (EXACT));
  REDOES (settings.encoding = CELD_ENCODING_RANK, STAGE (UNEXPANDED) | FROM_LEVELS | STAGE (EXACT));
  REDOES (settings.near_level = 3, STAGE (UNEXPANDED) | FROM_LEVELS | STAGE (EXACT));
  REDOES (settings.tolerance = 1e-3f, DEPTHS | STAGE (EXACT));
  REDOES (settings.anchors = CELD_ANCHORS_CORE, DEPTHS);
  REDOES (settings.bulge = 2, STAGE (NORMALS) | STAGE (SHADING));
  REDOES (settings.contrast = 2, STAGE (WEIGHTS) | FROM_NODES);
  REDOES (settings.weight_floor = 1e-3f, STAGE (WEIGHTS) | FROM_NODES);
  REDOES (settings.same_colour = CELD_SAME_COLOUR_SEPARATE, FROM_LABELS | FROM_NODES);
  REDOES (settings.background = CELD_BACKGROUND_NONE, FROM_LABELS | FROM_NODES);
  REDOES (settings.bevel = 0.1f, STAGE (NORMALS) | STAGE (SHADING));
  REDOES (settings.creases = 1, STAGE (NORMALS) | STAGE (SHADING));
  REDOES (settings.frame_outline = true, STAGE (NORMALS) | STAGE (SHADING));
  REDOES (settings.ambient = 0.5f, STAGE (SHADING));
  REDOES (settings.light_model = CELD_MODEL_TOON, STAGE (SHADING));
  REDOES (settings.toon_steps = 5, STAGE (SHADING));
  REDOES (settings.light = CELD_LIGHT_POINT, STAGE (SHADING));
  REDOES (settings.light_x = 0.5f, STAGE (SHADING));
  REDOES (settings.light_y = 0.5f, STAGE (SHADING));
  REDOES (settings.light_height = 0.5f, STAGE (SHADING));
  REDOES (settings.specular = 0.5f, STAGE (SHADING));
  REDOES (settings.shininess = 5, STAGE (SHADING));
  REDOES (settings.rim_light = 0.5f, STAGE (SHADING));
  REDOES (settings.rim_power = 5, STAGE (SHADING));
  REDOES (settings.margin = 0.1f, STAGE (SHEETS) | STAGE (NORMALS) | STAGE (SHADING));
}

static void
a_layer_invalidates_the_stages_that_read_it (void)
{
  State        state;
  CeldSession *s = finished (&state);
  uint8_t      on[4] = { 1, 1, 1, 1 };
  CeldPaint    scribbles = { W, H, W, state.scribbles };

  CHECK (celd_session_put_stroke (s, 1, 30, 25, &(CeldMask) { 2, 2, 2, on }, colours[0]) == CELD_OK);
  CHECK (still_made (s) == (ALL & ~FROM_SEEDS));
  paint_box (state.scribbles, (CeldRect) { 22, 22, 4, 4 }, colours[0]);
  CHECK (celd_session_set_scribbles (s, &scribbles) == CELD_OK);
  CHECK (still_made (s) == (ALL & ~(STAGE (SCRIBBLES) | FROM_SEEDS)));
  celd_session_free (s);
}

/* The segmenter keeps its ink until the ink differs, and then gets it once. */
static void
the_segmenter_gets_ink_only_if_it_differs (void)
{
  static uint8_t blank[4 * W * H];
  State          state;
  CeldSession   *s = finished (&state);
  CeldDrawing    drawing = { .luma = { W, H, W, state.luma } };
  const float   *known = s->segmenter_ink.data;
  uint8_t        on[4] = { 1, 1, 1, 1 };
  CeldSettings   settings = state.settings;
  CeldLabels     labels;
  CeldPlane      ink;
  CeldRect       changed;

  CHECK (known && known == s->ink.data);
  CHECK (celd_session_put_stroke (s, 1, 30, 25, &(CeldMask) { 2, 2, 2, on }, colours[2]) == CELD_OK);
  settings.hardness = 1;
  settings.ink = CELD_INK_DARK; /* as the automatic mode has found */
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
  CHECK (celd_session_set_contours (s, &(CeldPaint) { W, H, W, blank }) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  CHECK (s->segmenter_ink.data == known && s->ink.data == known);

  draw_frame (state.luma, (CeldRect) { 44, 20, 9, 9 }, 0);
  CHECK (celd_session_ink (s, NULL, &ink, &changed) == CELD_OK);
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  CHECK (celd_session_ink (s, NULL, &ink, &changed) == CELD_OK);
  CHECK (changed.x >= 43 && changed.y >= 19 && changed.x + changed.width <= 54 && changed.y + changed.height <= 30);
  CHECK (s->segmenter_ink.data == known && s->ink.data != known); /* labels have not been made yet */
  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  CHECK (s->segmenter_ink.data == s->ink.data && s->ink.data != known);
  celd_session_free (s);
}

/* The reported rectangle is that of the region that a stroke changes, or empty if it changes none. */
static void
a_stroke_reports_only_its_region (void)
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

/* The rectangle of the labels is still reported after celd_session_closures. */
static void
closures_do_not_consume_changes_of_labels (void)
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
  RUN (an_edited_session_equals_a_new_one);
  RUN (relations_may_be_added_one_by_one);
  RUN (an_edit_after_a_cancelled_one_equals_a_new_session);
  RUN (a_setting_invalidates_the_stages_that_read_it);
  RUN (a_layer_invalidates_the_stages_that_read_it);
  RUN (the_segmenter_gets_ink_only_if_it_differs);
  RUN (a_stroke_reports_only_its_region);
  RUN (closures_do_not_consume_changes_of_labels);
  return DONE;
}
