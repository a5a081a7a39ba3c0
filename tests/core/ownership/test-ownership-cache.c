/* The cache of contour ownership: after any edit it equals a computation from scratch, and reports where it changed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "blobs.h"
#include "random-session.h"
#include "ownership/ownership.h"
#include "session/session.h"

enum { WIDTH = 300, HEIGHT = 230, LABELS = 12, EDITS = 45, BLACK_X = 20, BLACK_Y = 130, BLACK_END_X = 190,
       BLACK_END_Y = 200 };

/* What an edit may change. */
typedef struct
{
  Blobs      blobs;
  CeldPaint  colours;
  CeldLabels corrections;
  bool       tinted, corrected;
  uint32_t   level[LABELS];
  size_t     n;
} Page;

static void
page_new (uint32_t *seed, bool tinted, Page *page)
{
  blobs_new (WIDTH, HEIGHT, &page->blobs);
  for (int k = 0; k < 7; k++)
    {
      double pen = 1 + check_random (seed, 16);

      blobs_add (&page->blobs, seed, pen, 0.01 * check_random (seed, 30));
    }
  for (int y = BLACK_Y; y < BLACK_END_Y; y++) /* an area of ink that no pen explains */
    for (int x = BLACK_X; x < BLACK_END_X; x++)
      CELD_AT (&page->blobs.ink, x, y) = 0;
  for (int y = 0; y < 60; y++) /* grey paper, of which neighbours have a part */
    for (int x = 220; x < WIDTH; x++)
      CELD_AT (&page->blobs.ink, x, y) = 0.6f + 0.1f * (float) check_random (seed, 4);
  page->tinted  = tinted;
  page->colours = blobs_paint (&page->blobs, blobs_fill, blobs_shade);
  CHECK (celd_labels_new (WIDTH, HEIGHT, &page->corrections) == CELD_OK);
  page->corrected = false;
  page->n         = page->blobs.n + 1; /* one label has no pixels */
  memcpy (page->level, page->blobs.level, page->blobs.n * sizeof *page->level);
  page->level[page->n - 1] = 3;
}

static void
page_free (Page *page)
{
  blobs_free (&page->blobs);
  celd_free (page->colours.data);
  celd_free (page->corrections.data);
}

static CeldRect
any_rect (uint32_t *seed, int side)
{
  int w = 1 + (int) check_random (seed, (uint32_t) side), h = 1 + (int) check_random (seed, (uint32_t) side);

  return (CeldRect) { (int) check_random (seed, (uint32_t) (WIDTH - w)),
                      (int) check_random (seed, (uint32_t) (HEIGHT - h)), w, h };
}

static uint32_t
any_label (uint32_t *seed, const Page *page)
{
  return 1 + check_random (seed, (uint32_t) page->n);
}

/* Replaces a label by another within a rectangle or everywhere; returns the rectangle. */
static CeldRect
change_labels (uint32_t *seed, Page *page)
{
  CeldRect r = any_rect (seed, check_random (seed, 3) ? 60 : 200);
  uint32_t from = any_label (seed, page), to = any_label (seed, page);
  bool     all = !check_random (seed, 4);

  for (int y = r.y; y < r.y + r.height; y++)
    for (int x = r.x; x < r.x + r.width; x++)
      if (all || CELD_AT (&page->blobs.labels, x, y) == from)
        CELD_AT (&page->blobs.labels, x, y) = to;
  return r;
}

static CeldRect
fill (Page *page, int x, int y, int end_x, int end_y, uint32_t label)
{
  for (int v = y; v < end_y; v++)
    for (int u = x; u < end_x; u++)
      CELD_AT (&page->blobs.labels, u, v) = label;
  return (CeldRect) { x, y, end_x - x, end_y - y };
}

/* A label that is wholly ink, up to tile boundaries, or was before, with paper far away. */
static CeldRect
change_black (uint32_t *seed, Page *page)
{
  int x = CELD_TILE * (1 + (int) check_random (seed, 4)), end = x + CELD_TILE * (1 + (int) check_random (seed, 2));

  if (check_random (seed, 2))
    return fill (page, 0, 0, 90, 40, check_random (seed, 2) ? (uint32_t) page->n : 1);
  return fill (page, x, BLACK_Y, end < BLACK_END_X ? end : BLACK_END_X, BLACK_END_Y, (uint32_t) page->n);
}

static void
change_levels (uint32_t *seed, Page *page)
{
  uint32_t a = any_label (seed, page) - 1, b = any_label (seed, page) - 1, level = page->level[a];

  switch (check_random (seed, 3))
    {
    case 0: page->level[a] = page->level[b]; break;
    case 1: page->level[a] = page->level[b]; page->level[b] = level; break;
    case 2: /* nothing but other numbers */
      for (size_t k = 0; k < page->n; k++)
        page->level[k] = 2 * page->level[k] + 1;
      for (size_t k = 0; k < page->n && page->level[k] > 1000; k++)
        page->level[k] %= 7;
    }
}

static void
change_corrections (uint32_t *seed, Page *page)
{
  CeldRect r = any_rect (seed, 12);
  uint32_t label = check_random (seed, 3) ? any_label (seed, page) : 0;

  page->corrected = check_random (seed, 4) != 0;
  for (int y = r.y; y < r.y + r.height; y++)
    for (int x = r.x; x < r.x + r.width; x++)
      CELD_AT (&page->corrections, x, y) = label;
}

/* Adds or removes a label; strokes in its colour go with it.  Returns where labels change. */
static CeldRect
change_number (uint32_t *seed, Page *page)
{
  CeldRect whole = { 0, 0, WIDTH, HEIGHT };

  if (page->n < LABELS && check_random (seed, 2))
    {
      page->level[page->n++] = check_random (seed, 8);
      return change_labels (seed, page);
    }
  page->n -= page->n > 2;
  for (int p = 0; p < WIDTH * HEIGHT; p++)
    {
      if (page->blobs.labels.data[p] > page->n)
        page->blobs.labels.data[p] = 1;
      if (page->corrections.data[p] > page->n)
        page->corrections.data[p] = 0;
    }
  return whole;
}

static CeldOwnershipInput
input_of (const Page *page)
{
  return (CeldOwnershipInput) { &page->blobs.ink, page->tinted ? &page->colours : NULL, &page->blobs.labels,
                                page->corrected ? &page->corrections : NULL, page->level, page->n };
}

static bool
same_pixel (const CeldOwnership *a, const CeldOwnership *b, int p)
{
  return a->owner.data[p] == b->owner.data[p] && a->under.data[p] == b->under.data[p] &&
         a->coverage.data[p] == b->coverage.data[p];
}

/* The record equals that of celd_own, and differs from the old one within `changed` only, tightly. */
static void
check_record (const Page *page, const CeldOwnership *own, const CeldOwnership *old, CeldRect changed)
{
  CeldOwnershipInput in = input_of (page);
  CeldOwnership      whole;
  CeldRect           seen = { 0 };
  int                wrong = 0;

  CHECK (celd_ownership_new (WIDTH, HEIGHT, &whole) == CELD_OK);
  CHECK (celd_own (in.ink, in.colours, in.labels, in.level, in.n, in.corrections, CELD_EXPANSION_OUTLINES, NULL, &whole) ==
         CELD_OK);
  for (int p = 0; p < WIDTH * HEIGHT; p++)
    {
      wrong += !same_pixel (own, &whole, p);
      if (!same_pixel (own, old, p))
        seen = celd_rect_union (seen, (CeldRect) { p % WIDTH, p / WIDTH, 1, 1 });
    }
  CHECK (wrong == 0);
  CHECK (seen.width == changed.width && (!seen.width || !memcmp (&seen, &changed, sizeof seen)));
  celd_ownership_clear (&whole);
}

static void
copy_record (const CeldOwnership *from, CeldOwnership *to)
{
  memcpy (to->owner.data, from->owner.data, WIDTH * HEIGHT * sizeof (uint32_t));
  memcpy (to->under.data, from->under.data, WIDTH * HEIGHT * sizeof (uint32_t));
  memcpy (to->coverage.data, from->coverage.data, WIDTH * HEIGHT * sizeof (float));
}

/* One page after another edit. */
static void
edit_page (uint32_t seed, bool tinted)
{
  Page               page;
  CeldOwnershipCache kept = { 0 };
  CeldOwnership      own, old;
  CeldOwnershipInput in;

  page_new (&seed, tinted, &page);
  CHECK (celd_ownership_new (WIDTH, HEIGHT, &own) == CELD_OK && celd_ownership_new (WIDTH, HEIGHT, &old) == CELD_OK);
  in = input_of (&page);
  CHECK (celd_ownership_cache_make (&in, NULL, &kept, &own) == CELD_OK);
  for (int i = 0; i < EDITS && !check_bad; i++)
    {
      CeldRect new_labels = { 0 }, changed;

      copy_record (&own, &old);
      switch (check_random (&seed, 12))
        {
        default: new_labels = change_labels (&seed, &page); break;
        case 0: case 1: change_levels (&seed, &page); break;
        case 2: case 3: change_corrections (&seed, &page); break;
        case 4: change_levels (&seed, &page); new_labels = change_labels (&seed, &page); break;
        case 5: new_labels = change_number (&seed, &page); break;
        case 6: case 7: new_labels = change_black (&seed, &page); break;
        }
      in = input_of (&page);
      CHECK (celd_ownership_cache_update (&in, new_labels, NULL, &kept, &own, &changed) == CELD_OK);
      check_record (&page, &own, &old, changed);
    }
  celd_ownership_cache_clear (&kept);
  celd_ownership_clear (&own);
  celd_ownership_clear (&old);
  page_free (&page);
}

static void
updates_equal_computation_from_scratch (void)
{
  /* Every other one with coloured lines.  14, 86: the pen of a label behind changes its width with levels, with labels;
   * 15: a line comes round a corner. */
  static const uint32_t seeds[] = { 1, 2, 14, 3, 86, 4, 15 };

  for (size_t i = 0; i < sizeof seeds / sizeof *seeds && !check_bad; i++)
    edit_page (seeds[i] * 7919, i % 2);
}

/* ------------------------------------------------------------------ a label that is gone */

/* Edits a page with an upright line of label 1, and behind it another label, whose paper begins with a tile.  The list
 * of levels has no room for more than n labels. */
static void
update_beside_line (uint32_t other, size_t n, CeldOwnershipCache *kept, CeldOwnership *own)
{
  int                side = 6 * CELD_TILE;
  CeldPlane          ink;
  CeldLabels         labels;
  CeldRect           changed, all = { 0, 0, side, side };
  uint32_t          *level = celd_alloc0 (n, sizeof *level);
  CeldOwnershipInput in = { .ink = &ink, .labels = &labels, .level = level, .n = n };

  CHECK (celd_plane_new (side, side, &ink) == CELD_OK && celd_labels_new (side, side, &labels) == CELD_OK && level);
  level[0] = 1;
  for (int p = 0; p < side * side; p++)
    {
      int left = p % side - 3 * CELD_TILE; /* antialiased in the last column of a tile */

      ink.data[p]    = left == -1 ? 0.3f : left < -1 && left > -5 ? 0 : 1;
      labels.data[p] = left < -3 ? 1 : other;
    }
  CHECK ((kept->level ? celd_ownership_cache_update (&in, all, NULL, kept, own, &changed)
                      : celd_ownership_cache_make (&in, NULL, kept, own)) == CELD_OK);
  celd_free (ink.data);
  celd_free (labels.data);
  celd_free (level);
}

/* Nothing asks for the level of a label that an edit has removed; the address sanitizer sees it. */
static void
removed_labels_have_no_level (void)
{
  int                side = 6 * CELD_TILE, x = 3 * CELD_TILE - 1, y = side / 2;
  CeldOwnershipCache kept = { 0 };
  CeldOwnership      own;

  CHECK (celd_ownership_new (side, side, &own) == CELD_OK);
  update_beside_line (3, 3, &kept, &own);
  CHECK (CELD_AT (&own.owner, x, y) == 1 && CELD_AT (&own.under, x, y) == 3);
  update_beside_line (2, 2, &kept, &own);
  CHECK (CELD_AT (&own.owner, x, y) == 1 && CELD_AT (&own.under, x, y) == 2);
  celd_ownership_cache_clear (&kept);
  celd_ownership_clear (&own);
}

/* ------------------------------------------------------------------ in a session */

/* A dot of a colour somewhere, or nothing at all. */
static void
new_corrections (uint32_t *r, uint8_t *paint)
{
  memset (paint, 0, 4 * W * H);
  if (pick (r, 3))
    paint_box (paint, random_box (r, 2, 8), colours[pick (r, 4)]);
}

static CeldStatus
ask_session (CeldSession *session, const State *state, uint8_t *corrections, bool thickness, CeldOwnership *own,
             CeldRect *changed)
{
  CeldPaint    paint = { W, H, W, corrections };
  CeldSettings settings;

  apply (session, state);
  settings           = session->settings;
  settings.expansion = thickness ? CELD_EXPANSION_THICKNESS : CELD_EXPANSION_OUTLINES;
  CHECK (celd_session_set_settings (session, &settings) == CELD_OK);
  CHECK (celd_session_set_corrections (session, &paint) == CELD_OK);
  return celd_session_ownership (session, NULL, own, changed);
}

/* The levels after it, and where they differ from the old ones, which are replaced. */
static void
compare_levels (CeldSession *edited, CeldSession *fresh, float *old)
{
  CeldPlane a, b;
  CeldRect  changed, seen = { 0 };

  CHECK (celd_session_levels (edited, NULL, &a, &changed) == CELD_OK);
  CHECK (celd_session_levels (fresh, NULL, &b, NULL) == CELD_OK);
  CHECK (!memcmp (a.data, b.data, W * H * sizeof (float)));
  for (int p = 0; p < W * H; p++)
    if (a.data[p] != old[p])
      seen = celd_rect_union (seen, (CeldRect) { p % W, p / W, 1, 1 });
  CHECK (celd_rect_union (seen, changed).width == changed.width);
  CHECK (celd_rect_union (seen, changed).height == changed.height);
  memcpy (old, a.data, W * H * sizeof (float));
}

/* An edited session equals a new one. */
static void
sessions_equal_computation_from_scratch (void)
{
  static uint8_t corrections[4 * W * H];
  static float   old[W * H];
  uint32_t       r = 99;
  State          state;
  CeldSession   *edited = celd_session_new ();

  for (int p = 0; p < W * H; p++)
    old[p] = -1;
  start (&state, &r);
  for (int i = 0; i < 200 && !check_bad; i++)
    {
      CeldSession  *fresh = celd_session_new ();
      CeldOwnership a, b;
      CeldStatus    status;
      bool          thickness = !pick (&r, 12);

      edit (&state, &r);
      if (!pick (&r, 4))
        new_corrections (&r, corrections);
      status = ask_session (edited, &state, corrections, thickness, &a, NULL);
      CHECK (ask_session (fresh, &state, corrections, thickness, &b, NULL) == status);
      if (status == CELD_OK)
        {
          CHECK (!memcmp (a.owner.data, b.owner.data, W * H * sizeof (uint32_t)));
          CHECK (!memcmp (a.under.data, b.under.data, W * H * sizeof (uint32_t)));
          CHECK (!memcmp (a.coverage.data, b.coverage.data, W * H * sizeof (float)));
        }
      if (status == CELD_OK && pick (&r, 3))
        compare_levels (edited, fresh, old);
      celd_session_free (fresh);
    }
  celd_session_free (edited);
}

/* ------------------------------------------------------------------ failures */

static bool
refuse (void *host, double done)
{
  (void) host;
  return done < 0.4;
}

/* Cancelling leaves the record unchanged, and the next update starts from scratch. */
static void
cancelled_edits_do_no_harm (void)
{
  uint32_t           seed = 5;
  Page               page;
  CeldHost           host = { .progress = refuse };
  CeldOwnershipCache kept = { 0 };
  CeldOwnership      own, old;
  CeldOwnershipInput in;
  CeldRect           changed;

  page_new (&seed, false, &page);
  CHECK (celd_ownership_new (WIDTH, HEIGHT, &own) == CELD_OK && celd_ownership_new (WIDTH, HEIGHT, &old) == CELD_OK);
  in = input_of (&page);
  CHECK (celd_ownership_cache_make (&in, NULL, &kept, &own) == CELD_OK);
  copy_record (&own, &old);
  page.level[1] = 9;
  CHECK (celd_ownership_cache_update (&in, (CeldRect) { 0 }, &host, &kept, &own, &changed) == CELD_CANCELLED);
  CHECK (!kept.level && !memcmp (own.owner.data, old.owner.data, WIDTH * HEIGHT * sizeof (uint32_t)));
  CHECK (celd_ownership_cache_make (&in, &host, &kept, &own) == CELD_CANCELLED && !kept.level);
  CHECK (!memcmp (own.owner.data, old.owner.data, WIDTH * HEIGHT * sizeof (uint32_t)));
  celd_ownership_cache_clear (&kept);
  celd_ownership_clear (&own);
  celd_ownership_clear (&old);
  page_free (&page);
}

int
main (void)
{
  RUN (updates_equal_computation_from_scratch);
  RUN (removed_labels_have_no_level);
  RUN (sessions_equal_computation_from_scratch);
  RUN (cancelled_edits_do_no_harm);
  return DONE;
}
