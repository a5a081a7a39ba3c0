/* What holds of the sheets of any picture: nothing of them would be seen, their order follows all relations, and
 * their records are sound.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "sheets/sheets.h"

#define MOST_LABELS 7
#define MOST_LINKS  6
#define MOST_ENDS   (2 * MOST_LINKS * MOST_LABELS)

typedef struct
{
  CeldPlane     ink;
  CeldOwnership own;
  CeldOrder     order;
  CeldSettings  settings;
  uint32_t      background, level[MOST_LABELS], end[MOST_ENDS];
  size_t        first[2 * MOST_LINKS + 1];
  bool          equal[MOST_LINKS];
} Scene;

static CeldSheets *
sheets_of (const Scene *s, const CeldHost *host)
{
  CeldSheets *sheets = NULL;

  CHECK (celd_sheets (&s->ink, &s->own, NULL, &s->order, s->background, &s->settings, host, &sheets) == CELD_OK);
  return sheets;
}

/* ------------------------------------------------------------------ pictures */

/* Paper of label 1 alone. */
static void
open_scene (int width, int height, size_t n, Scene *s)
{
  *s = (Scene) { .settings = celd_settings (), .order = { .level = s->level, .n = n } };
  CHECK (celd_plane_new (width, height, &s->ink) == CELD_OK);
  CHECK (celd_labels_new (width, height, &s->own.owner) == CELD_OK);
  CHECK (celd_labels_new (width, height, &s->own.under) == CELD_OK);
  CHECK (celd_plane_new (width, height, &s->own.coverage) == CELD_OK);
  for (int i = 0; i < width * height; i++)
    {
      s->own.owner.data[i] = s->own.under.data[i] = 1;
      s->ink.data[i] = s->own.coverage.data[i] = 1;
    }
  s->order.links = (CeldOrderLinks) { 0, s->first, s->end, s->equal };
}

static void
close_scene (Scene *s)
{
  free (s->ink.data);
  free (s->own.owner.data);
  free (s->own.under.data);
  free (s->own.coverage.data);
}

static bool
is_nearer (const Scene *s, uint32_t a, uint32_t b)
{
  return s->level[a - 1] > s->level[b - 1];
}

/* A shape over what is there, antialiased with the label that it meets; the nearer one of both is the owner. */
static void
paint (Scene *s, uint32_t label, double x0, double y0, double x1, double y1, bool round)
{
  for (int y = 0; y < s->own.owner.height; y++)
    for (int x = 0; x < s->own.owner.width; x++)
      {
        double    u = x + 0.5, v = y + 0.5;
        double    box = fmin (fmin (u - x0, x1 - u), fmin (v - y0, y1 - v));
        double    disc = (x1 - x0) / 2 - hypot (u - (x0 + x1) / 2, v - (y0 + y1) / 2);
        double    share = fmin (fmax ((round ? disc : box) + 0.5, 0), 1);
        uint32_t *owner = &CELD_AT (&s->own.owner, x, y), *under = &CELD_AT (&s->own.under, x, y);
        float    *coverage = &CELD_AT (&s->own.coverage, x, y);
        uint32_t  behind = *coverage < 0.5f ? *under : *owner;

        if (!(share > 0))
          continue;
        *owner = is_nearer (s, behind, label) ? behind : label;
        *under = share < 1 ? *owner == label ? behind : label : label;
        *owner = share < 1 ? *owner : label;
        *coverage = *owner == *under ? 1 : (float) (*owner == label ? share : 1 - share);
      }
}

static void
add_link (uint32_t *state, Scene *s, size_t *ends)
{
  size_t   i = s->order.links.n, from = *ends, middle;
  uint32_t low = check_random (state, 3), high = low + check_random (state, 2);

  for (uint32_t l = 0; l < s->order.n; l++)
    if (s->level[l] == low && check_random (state, 2))
      s->end[(*ends)++] = l;
  middle = *ends;
  for (uint32_t l = 0; l < s->order.n; l++)
    if (s->level[l] == high && check_random (state, 2))
      s->end[(*ends)++] = l;
  if (middle == from || *ends == middle)
    {
      *ends = from;
      return;
    }
  s->first[2 * i] = from;
  s->first[2 * i + 1] = middle;
  s->first[2 * i + 2] = *ends;
  s->equal[i] = low == high;
  s->order.links.n++;
}

/* Shapes of random labels, mostly smooth, of a random order: levels, or relations that agree with these. */
static void
random_scene (uint32_t *state, int most_side, Scene *s)
{
  int    w = 1 + (int) check_random (state, (uint32_t) most_side), h = 1 + (int) check_random (state, (uint32_t) most_side);
  size_t ends = 0;

  open_scene (w, h, 1 + check_random (state, MOST_LABELS), s);
  s->settings.margin = (float) check_random (state, 21) / 100;
  s->background = check_random (state, 3) ? 1 + check_random (state, (uint32_t) s->order.n) : 0;
  for (size_t l = 0; l < s->order.n; l++)
    s->level[l] = check_random (state, 4);
  for (int links = (int) check_random (state, MOST_LINKS); links > 0; links--)
    add_link (state, s, &ends);
  for (int shapes = (int) check_random (state, 12); shapes > 0; shapes--)
    {
      double x = check_random (state, 1000) / 1000.0 * w, y = check_random (state, 1000) / 1000.0 * h;
      double size = check_random (state, 1000) / 1200.0 * w, flat = 0.2 + check_random (state, 1000) / 500.0;
      bool   round = check_random (state, 2);

      paint (s, 1 + check_random (state, (uint32_t) s->order.n), x, y, x + size, y + size * (round ? 1 : flat), round);
    }
  for (int i = 0; i < w * h; i++)
    s->ink.data[i] = (float) check_random (state, 4) / 3;
  for (int odd = (int) check_random (state, 10); odd > 0; odd--)
    {
      size_t i = check_random (state, (uint32_t) (w * h));

      s->own.owner.data[i] = 1 + check_random (state, (uint32_t) s->order.n);
      s->own.under.data[i] = 1 + check_random (state, (uint32_t) s->order.n);
      s->own.coverage.data[i] = (float) check_random (state, 11) / 10;
    }
}

/* ------------------------------------------------------------------ what holds of all */

static bool
is_visible (const Scene *s, uint32_t label, int x, int y)
{
  return CELD_AT (&s->own.owner, x, y) == label ||
         (CELD_AT (&s->own.under, x, y) == label && CELD_AT (&s->own.coverage, x, y) < 1);
}

/* The sheets are those of the labels that have pixels, each once. */
static void
check_list (const Scene *s, const CeldSheets *sheets)
{
  CHECK (sheets->width == s->ink.width && sheets->height == s->ink.height && sheets->n_labels == s->order.n);
  for (size_t k = 0; k < sheets->n; k++)
    {
      const CeldSheet *sheet = &sheets->item[k];

      CHECK (sheet->label && sheet->label <= s->order.n && sheets->of_label[sheet->label - 1] == k);
      CHECK (sheet->level == s->level[sheet->label - 1] && sheet->page == (sheet->label == s->background));
    }
  for (uint32_t l = 1; l <= s->order.n; l++)
    {
      bool any = false;

      for (int i = 0; i < s->ink.width * s->ink.height; i++)
        any |= s->own.owner.data[i] == l || s->own.under.data[i] == l;
      CHECK (any == (sheets->of_label[l - 1] != CELD_NO_SHEET));
    }
}

static void
check_order (const Scene *s, const CeldSheets *sheets)
{
  const CeldOrderLinks *links = &s->order.links;

  for (size_t i = 0; i < links->n; i++)
    for (size_t a = links->first[2 * i]; a < links->first[2 * i + 1] && !links->equal[i]; a++)
      for (size_t b = links->first[2 * i + 1]; b < links->first[2 * i + 2]; b++)
        {
          uint32_t far = sheets->of_label[links->end[a]], near = sheets->of_label[links->end[b]];

          CHECK (far == CELD_NO_SHEET || near == CELD_NO_SHEET || far < near);
        }
  for (size_t k = 1; k < sheets->n && !links->n; k++)
    CHECK (sheets->item[k - 1].level <= sheets->item[k].level);
}

/* Reading order, no pixel twice, and the box of all. */
static void
check_runs (const CeldSheets *sheets, const CeldSheet *sheet)
{
  size_t n = 0;
  CeldRect box = sheet->seen;

  for (size_t i = 0; i < sheet->n_runs; i++)
    {
      const CeldSheetRun *run = &sheet->run[i], *last = i ? run - 1 : NULL;

      CHECK (run->n > 0 && run->x >= 0 && run->y >= 0 && run->x + run->n <= sheets->width && run->y < sheets->height);
      CHECK (!last || run->y > last->y || (run->y == last->y && run->x >= last->x + last->n));
      CHECK (run->first == n);
      n  += (size_t) run->n;
      box = celd_rect_union (box, (CeldRect) { run->x, run->y, run->n, 1 });
    }
  CHECK (n == sheet->n_hidden && (!sheet->page || !n));
  if (sheet->page)
    box = (CeldRect) { 0, 0, sheets->width, sheets->height };
  CHECK (!memcmp (&box, &sheet->box, sizeof box));
}

static void
check_seen (const Scene *s, const CeldSheet *sheet)
{
  CeldRect seen = { 0 };

  for (int y = 0; y < s->ink.height; y++)
    for (int x = 0; x < s->ink.width; x++)
      if (CELD_AT (&s->own.owner, x, y) == sheet->label || CELD_AT (&s->own.under, x, y) == sheet->label)
        seen = celd_rect_union (seen, (CeldRect) { x, y, 1, 1 });
  CHECK (!memcmp (&seen, &sheet->seen, sizeof seen));
}

/* Only what lies in front of the sheet covers a hidden pixel. */
static void
check_hidden (const Scene *s, const CeldSheets *sheets, size_t k, const uint8_t *standing)
{
  const CeldSheet *sheet = &sheets->item[k];
  int              reach = (sheet->seen.width > sheet->seen.height ? sheet->seen.width : sheet->seen.height) + 2;

  CHECK (sheet->box.width <= sheet->seen.width + 2 * reach || sheet->page);
  CHECK (sheet->box.height <= sheet->seen.height + 2 * reach || sheet->page);
  for (size_t i = 0; i < sheet->n_runs; i++)
    for (int x = sheet->run[i].x; x < sheet->run[i].x + sheet->run[i].n; x++)
      {
        int      y = sheet->run[i].y;
        uint32_t owner = CELD_AT (&s->own.owner, x, y), under = CELD_AT (&s->own.under, x, y);

        CHECK (sheets->of_label[owner - 1] > k && standing[owner - 1] == CELD_HIDING);
        if (CELD_AT (&s->own.coverage, x, y) < 1)
          CHECK (sheets->of_label[under - 1] > k && standing[under - 1] == CELD_HIDING);
      }
}

/* Of the coverage: all of what is visible alone, all of the page, and in antialiased pixels the nearer one its
 * share. */
static void
check_coverage (const Scene *s, const CeldSheets *sheets, size_t k)
{
  int              w = s->ink.width, h = s->ink.height;
  const CeldSheet *sheet = &sheets->item[k];
  float           *cover = malloc ((size_t) (w * h) * sizeof *cover), part;

  celd_sheet_coverage (sheets, &s->own, k, (CeldRect) { 0, 0, w, h }, cover);
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        uint32_t owner = CELD_AT (&s->own.owner, x, y), under = CELD_AT (&s->own.under, x, y);
        bool     whole = CELD_AT (&s->own.coverage, x, y) >= 1;
        bool     in_front = sheets->of_label[owner - 1] >= k && (whole || sheets->of_label[under - 1] >= k);
        float    value = cover[y * w + x];

        CHECK (value >= 0 && value <= 1);
        if (owner == sheet->label && under == owner)
          CHECK (value == 1);
        if (owner == sheet->label && sheets->of_label[under - 1] < k)
          CHECK (value == CELD_AT (&s->own.coverage, x, y));
        if (sheet->page && in_front)
          CHECK (value == 1);
        if (is_visible (s, sheet->label, x, y) && in_front)
          CHECK (value == 1);
        if (!is_visible (s, sheet->label, x, y) && !in_front)
          CHECK (value == 0);
        celd_sheet_coverage (sheets, &s->own, k, (CeldRect) { x, y, 1, 1 }, &part);
        CHECK (part == value);
      }
  free (cover);
}

/* Every hidden pixel is connected with what is visible: marks spread from there. */
static void
check_connected (const Scene *s, const CeldSheet *sheet)
{
  int      w = sheet->box.x + sheet->box.width + 2, h = sheet->box.y + sheet->box.height + 2;
  uint8_t *mark = calloc ((size_t) (w * h), 1); /* of pixel (x,y) at (y + 1) w + x + 1; 1 hidden, 2 reached */
  bool     more = true;

  for (size_t i = 0; i < sheet->n_runs; i++)
    for (int k = 0; k < sheet->run[i].n; k++)
      mark[(sheet->run[i].y + 1) * w + sheet->run[i].x + k + 1] = 1;
  for (int y = 0; y < h - 2; y++)
    for (int x = 0; x < w - 2; x++)
      if (is_visible (s, sheet->label, x, y))
        mark[(y + 1) * w + x + 1] = 2;
  while (more)
    {
      more = false;
      for (int i = w; i < w * (h - 1); i++)
        if (mark[i] == 1 && (mark[i - 1] == 2 || mark[i + 1] == 2 || mark[i - w] == 2 || mark[i + w] == 2))
          {
            mark[i] = 2;
            more    = true;
          }
    }
  for (int i = 0; i < w * h; i++)
    CHECK (mark[i] != 1);
  free (mark);
}

static void
check_all (const Scene *s, const CeldSheets *sheets)
{
  CeldHiding hiding;
  uint8_t    standing[MOST_LABELS];
  uint32_t   queue[MOST_LABELS];

  CHECK (celd_hiding_new (&s->order, &hiding) == CELD_OK);
  check_list (s, sheets);
  check_order (s, sheets);
  for (size_t k = 0; k < sheets->n; k++)
    {
      celd_hiding_of (&hiding, sheets->item[k].label, standing, queue);
      check_runs (sheets, &sheets->item[k]);
      check_seen (s, &sheets->item[k]);
      check_hidden (s, sheets, k, standing);
      check_coverage (s, sheets, k);
      check_connected (s, &sheets->item[k]);
    }
  celd_hiding_clear (&hiding);
}

/* In small pictures a cell is a pixel; in larger ones it is several. */
static void
sheets_of_any_picture (void)
{
  uint32_t state = 5;

  for (int round = 0; round < 500; round++)
    {
      Scene       s;
      CeldSheets *sheets;

      random_scene (&state, round % 50 ? 40 : 400, &s);
      sheets = sheets_of (&s, NULL);
      check_all (&s, sheets);
      celd_sheets_free (sheets);
      close_scene (&s);
    }
}

static void
check_same (const CeldSheets *one, const CeldSheets *other)
{
  CHECK (one->n == other->n);
  for (size_t k = 0; k < one->n && k < other->n; k++)
    {
      const CeldSheet *a = &one->item[k], *b = &other->item[k];

      CHECK (a->label == b->label && a->level == b->level && a->page == b->page);
      CHECK (a->n_hidden == b->n_hidden && a->n_runs == b->n_runs);
      if (a->n_hidden)
        CHECK (!memcmp (a->coverage, b->coverage, a->n_hidden) && !memcmp (a->confidence, b->confidence, a->n_hidden));
      for (size_t i = 0; i < a->n_runs; i++)
        CHECK (a->run[i].x == b->run[i].x && a->run[i].y == b->run[i].y && a->run[i].n == b->run[i].n);
    }
}

static void
threads_make_no_difference (void)
{
  uint32_t state = 6;
  CeldHost backwards = { .each = check_backwards };

  for (int round = 0; round < 100; round++)
    {
      Scene       s;
      CeldSheets *one, *other;

      random_scene (&state, 40, &s);
      one = sheets_of (&s, NULL);
      other = sheets_of (&s, &backwards);
      check_same (one, other);
      celd_sheets_free (one);
      celd_sheets_free (other);
      close_scene (&s);
    }
}

/* Replaces the sheets by those of the scene, which differs from theirs within `changed`. */
static CeldStatus
update (const Scene *s, CeldRect changed, const CeldHost *host, CeldSheets **sheets)
{
  return celd_sheets_update (&s->ink, &s->own, NULL, changed, &s->order, s->background, &s->settings, host, sheets);
}

/* Whatever was taken over before it was cancelled. */
static void
an_update_that_fails_leaves_the_old_sheets (void)
{
  uint32_t state = 7;

  for (int round = 0; round < 60; round++)
    {
      Scene       s;
      CeldSheets *sheets = NULL, *was, *before, *after;
      CeldStatus  status = CELD_CANCELLED;
      double      x, y;

      random_scene (&state, 40, &s);
      x = check_random (&state, (uint32_t) s.ink.width);
      y = check_random (&state, (uint32_t) s.ink.height);
      CHECK (update (&s, (CeldRect) { 0 }, NULL, &sheets) == CELD_OK);
      before = sheets_of (&s, NULL);
      paint (&s, 1 + check_random (&state, (uint32_t) s.order.n), x, y, x + 2, y + 2, false);
      was = sheets;
      for (int reports = 0; status != CELD_OK && reports < 9; reports++)
        {
          int      left = reports;
          CeldHost host = { .progress = check_count_down, .data = &left };

          status = update (&s, (CeldRect) { (int) x - 1, (int) y - 1, 4, 4 }, &host, &sheets);
          CHECK (status == CELD_OK || (status == CELD_CANCELLED && sheets == was));
          if (status != CELD_OK && sheets)
            check_same (sheets, before);
        }
      CHECK (status == CELD_OK);
      after = sheets_of (&s, NULL);
      check_same (sheets, after);
      celd_sheets_free (before);
      celd_sheets_free (after);
      celd_sheets_free (sheets);
      close_scene (&s);
    }
}

/* ------------------------------------------------------------------ odd pictures */

static void
one_label_hides_nothing (void)
{
  for (int side = 1; side < 30; side += 7)
    for (uint32_t background = 0; background < 2; background++)
      {
        Scene       s;
        CeldSheets *sheets;

        open_scene (side, 1 + side / 3, 1, &s);
        s.background = background;
        sheets = sheets_of (&s, NULL);
        CHECK (sheets->n == 1 && !sheets->item[0].n_hidden);
        check_all (&s, sheets);
        celd_sheets_free (sheets);
        close_scene (&s);
      }
}

/* Each pixel is a region of its own, nearer than the one before it. */
static void
many_regions_of_one_pixel (void)
{
  static uint32_t level[300];
  Scene           s;
  CeldSheets     *sheets;

  open_scene (20, 15, 300, &s);
  s.order.level = level;
  for (uint32_t i = 0; i < 300; i++)
    {
      s.own.owner.data[i] = s.own.under.data[i] = i + 1;
      level[i] = i;
    }
  sheets = sheets_of (&s, NULL);
  CHECK (sheets->n == 300);
  for (size_t k = 0; k < 300; k++)
    {
      CHECK (sheets->item[k].label == k + 1);
      check_runs (sheets, &sheets->item[k]);
    }
  CHECK (!sheets->item[299].n_hidden);
  celd_sheets_free (sheets);
  close_scene (&s);
}

/* Coverage that is no number counts as all of the pixel. */
static void
coverage_may_be_no_number (void)
{
  Scene       s;
  CeldSheets *sheets;
  float       cover[30 * 20];

  open_scene (30, 20, 2, &s);
  s.level[1] = 1;
  s.background = 1;
  paint (&s, 2, 8.5, 5.5, 22.5, 15.5, false);
  for (int i = 0; i < 600; i++)
    s.own.coverage.data[i] = NAN;
  sheets = sheets_of (&s, NULL);
  for (size_t k = 0; k < sheets->n; k++)
    {
      check_runs (sheets, &sheets->item[k]);
      celd_sheet_coverage (sheets, &s.own, k, (CeldRect) { 0, 0, 30, 20 }, cover);
      for (int i = 0; i < 600; i++)
        CHECK (cover[i] >= 0 && cover[i] <= 1);
    }
  celd_sheets_free (sheets);
  close_scene (&s);
}

static void
bad_input_is_refused (void)
{
  Scene       s;
  CeldPlane   small;
  CeldHost    refuse = { .progress = check_refuse };
  CeldSheets *sheets = NULL;

  open_scene (6, 5, 1, &s);
  small = s.ink;
  small.width--;
  CHECK (celd_sheets (&small, &s.own, NULL, &s.order, 0, &s.settings, NULL, &sheets) == CELD_BAD_SIZE);
  CHECK (celd_sheets (&s.ink, &s.own, NULL, &s.order, 2, &s.settings, NULL, &sheets) == CELD_BAD_VALUE);
  CHECK (celd_sheets (&s.ink, &s.own, NULL, &s.order, 0, &s.settings, &refuse, &sheets) == CELD_CANCELLED);
  s.order.n = 0;
  CHECK (celd_sheets (&s.ink, &s.own, NULL, &s.order, 0, &s.settings, NULL, &sheets) == CELD_NOTHING_TO_GO_BY);
  s.order.n = 1;
  s.settings.margin = NAN;
  CHECK (celd_sheets (&s.ink, &s.own, NULL, &s.order, 0, &s.settings, NULL, &sheets) == CELD_BAD_VALUE);
  s.settings = celd_settings ();
  s.own.under.data[29] = 2;
  CHECK (celd_sheets (&s.ink, &s.own, NULL, &s.order, 0, &s.settings, NULL, &sheets) == CELD_BAD_VALUE);
  s.own.under.data[29] = 1;
  s.own.owner.data[0] = 0;
  CHECK (celd_sheets (&s.ink, &s.own, NULL, &s.order, 0, &s.settings, NULL, &sheets) == CELD_BAD_VALUE);
  CHECK (!sheets);
  celd_sheets_free (NULL);
  close_scene (&s);
}

int
main (void)
{
  RUN (sheets_of_any_picture);
  RUN (threads_make_no_difference);
  RUN (an_update_that_fails_leaves_the_old_sheets);
  RUN (one_label_hides_nothing);
  RUN (many_regions_of_one_pixel);
  RUN (coverage_may_be_no_number);
  RUN (bad_input_is_refused);
  return DONE;
}
