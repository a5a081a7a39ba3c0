/* What is painted when labels change: known pictures, and the rectangle of changes, pixel for pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "segment/basins.h"
#include "segment/task.h"

/* Two basins side by side and one below, and a picture of labels over them. */
static CeldBasin    three[] = { { 1, 0, 4, false, 8 }, { 6, 1, 9, false, 8 }, { 3, 3, 1, true, 16 } };
static CeldBasinRun runs[] = { { 0, 0 }, { 4, 1 }, { 0, 0 }, { 4, 1 }, { 0, 2 }, { 0, 2 } };
static size_t       rows[] = { 0, 2, 4, 5, 6 };

static const CeldBasins basins = { .width = 8, .height = 4, .n = 3, .basin = three, .run = runs, .row = rows };

typedef struct { CeldLabelling labelling; CeldLabels labels; } Picture;

static void
picture_open (Picture *p)
{
  *p = (Picture) { 0 };
  CHECK (celd_labels_new (8, 4, &p->labels) == CELD_OK);
  CHECK (celd_labelling_reset (&p->labelling, &basins) == CELD_OK);
}

static void
picture_close (Picture *p)
{
  celd_labelling_clear (&p->labelling);
  celd_free (p->labels.data);
}

static void
paint (Picture *p, uint32_t a, uint32_t b, uint32_t c, CeldPatch *patch, size_t n)
{
  uint32_t     *label = celd_alloc (3, sizeof *label);
  CeldPatches   patches = { patch, n, 0 };
  CeldLabelling old;

  label[0] = a, label[1] = b, label[2] = c;
  p->labelling.changed = (CeldRect) { 0 };
  celd_labelling_begin (&p->labelling, &basins, label, &p->labels, &old);
  CHECK (celd_labelling_add (&p->labelling, &patches, &p->labels) == CELD_OK);
  CHECK (celd_labelling_end (&p->labelling, &basins, &old, &p->labels) == CELD_OK);
  celd_labelling_clear (&old);
}

static void
looks_like (const Picture *p, const char *const *art)
{
  CeldLabels wanted = art_labels (art);

  CHECK (memcmp (wanted.data, p->labels.data, 32 * sizeof (uint32_t)) == 0);
  free (wanted.data);
}

static void
changed_is (const Picture *p, int x, int y, int width, int height)
{
  const CeldRect *c = &p->labelling.changed;

  CHECK (c->width == width && (!width || (c->x == x && c->y == y && c->height == height)));
}

static void
only_basins_with_a_new_label_are_painted (void)
{
  static const char *const first[] = { "11112222", "11112222", "33333333", "33333333", NULL };
  static const char *const second[] = { "11114444", "11114444", "33333333", "33333333", NULL };
  Picture                  p;

  picture_open (&p);
  paint (&p, 1, 2, 3, NULL, 0);
  looks_like (&p, first);
  changed_is (&p, 0, 0, 8, 4);
  paint (&p, 1, 4, 3, NULL, 0);
  looks_like (&p, second);
  changed_is (&p, 4, 0, 4, 2);
  paint (&p, 1, 4, 3, NULL, 0);
  changed_is (&p, 0, 0, 0, 0);
  picture_close (&p);
}

static void
patches_that_are_gone_show_their_basins_again (void)
{
  static const char *const patched[] = { "11555222", "11112222", "33333333", "33333333", NULL };
  static const char *const moved[] = { "11112222", "11112222", "33663333", "33333333", NULL };
  CeldPatch                over[] = { { 0, 2, 5, 5 } }, below[] = { { 2, 2, 4, 6 } };
  Picture                  p;

  picture_open (&p);
  paint (&p, 1, 2, 3, NULL, 0);
  paint (&p, 1, 2, 3, over, 1);
  looks_like (&p, patched);
  changed_is (&p, 2, 0, 3, 1);
  paint (&p, 1, 2, 3, over, 1);
  changed_is (&p, 0, 0, 0, 0);
  paint (&p, 1, 2, 3, below, 1);
  looks_like (&p, moved);
  changed_is (&p, 2, 0, 3, 3);
  picture_close (&p);
}

/* The later of two patches lies above; one that says what the basin says is none. */
static void
patches_end_up_sorted_and_without_overlaps (void)
{
  static const char *const art[] = { "17882222", "11112222", "33333333", "33333333", NULL };
  CeldPatch                patches[] = { { 3, 0, 8, 3 }, { 0, 1, 4, 7 }, { 0, 2, 4, 8 } };
  Picture                  p;

  picture_open (&p);
  paint (&p, 1, 2, 3, patches, 3);
  looks_like (&p, art);
  CHECK (p.labelling.patches.n == 2);
  CHECK (p.labelling.patches.item[0].label == 7 && p.labelling.patches.item[0].x == 1 &&
         p.labelling.patches.item[0].end == 2);
  CHECK (p.labelling.patches.item[1].label == 8 && p.labelling.patches.item[1].x == 2 &&
         p.labelling.patches.item[1].end == 4);
  picture_close (&p);
}

/* A basin that takes the label which a patch over it had: those pixels stay what they are. */
static void
a_basin_may_take_over_its_patch (void)
{
  CeldPatch whole[] = { { 0, 4, 8, 5 }, { 1, 4, 8, 5 } }, edge[] = { { 0, 0, 1, 9 } };
  Picture   p;

  picture_open (&p);
  paint (&p, 1, 2, 3, whole, 2);
  paint (&p, 1, 2, 3, edge, 1);
  changed_is (&p, 0, 0, 8, 2);
  picture_close (&p);
}

static void
labels_have_their_area_and_their_place_farthest_from_ink (void)
{
  CeldRegion  item[5] = { { .area = 77 } };
  CeldPalette palette = { item, 5 };
  CeldPatch   patches[] = { { 0, 2, 6, 4 }, { 1, 1, 2, 4 } };
  Picture     p;

  picture_open (&p);
  paint (&p, 1, 2, 3, patches, 2);
  CHECK (celd_labelling_measure (&p.labelling, &basins, &p.labels, &palette) == CELD_OK);
  CHECK (item[0].area == 5 && item[1].area == 6 && item[2].area == 16 && item[3].area == 5 && item[4].area == 0);
  CHECK (item[0].x == 1 && item[0].y == 0 && item[1].x == 6 && item[1].y == 1 && item[2].x == 3 && item[2].y == 3);
  CHECK (item[3].x == 4 && item[3].y == 0 && item[4].x == -1 && item[4].y == -1);
  picture_close (&p);
}

static void
a_whole_picture_replaces_the_labels (void)
{
  static const char *const art[] = { "11112222", "11192222", "33333333", "33333333", NULL };
  CeldLabels               whole = art_labels (art);
  Picture                  p;

  picture_open (&p);
  paint (&p, 1, 2, 3, NULL, 0);
  p.labelling.changed = (CeldRect) { 0 };
  CHECK (celd_labelling_replace (&p.labelling, &basins, &whole, &p.labels) == CELD_OK);
  looks_like (&p, art);
  changed_is (&p, 3, 1, 1, 1);
  paint (&p, 1, 2, 3, NULL, 0);
  CHECK (CELD_AT (&p.labels, 3, 1) == 1);
  picture_close (&p);
  free (whole.data);
}

/* ------------------------------------------------------------------ patches */

static void
runs_that_continue_one_another_are_one (void)
{
  CeldPatches patches = { 0 };

  for (int k = 0; k < 30; k++)
    for (int x = 0; x < 4; x++)
      CHECK (celd_patch_add (&patches, (CeldPatch) { k, x, x + 1, x < 3 ? 1 : 2 }) == CELD_OK);
  NEAR (patches.n, 60, 0);
  for (int k = 0; k < 30 && patches.n == 60; k++)
    {
      CeldPatch three = patches.item[2 * k], one = patches.item[2 * k + 1];

      CHECK (three.y == k && three.x == 0 && three.end == 3 && three.label == 1);
      CHECK (one.y == k && one.x == 3 && one.end == 4 && one.label == 2);
    }
  celd_patches_clear (&patches);
  CHECK (!patches.item && !patches.n);
  celd_patches_clear (&patches);
}

/* The same row, label or end alone makes no neighbour. */
static void
runs_of_other_labels_or_rows_stay_apart (void)
{
  CeldPatches patches = { 0 };

  CHECK (celd_patch_add (&patches, (CeldPatch) { 3, 0, 2, 1 }) == CELD_OK);
  CHECK (celd_patch_add (&patches, (CeldPatch) { 3, 3, 5, 1 }) == CELD_OK);
  CHECK (celd_patch_add (&patches, (CeldPatch) { 4, 5, 6, 1 }) == CELD_OK);
  CHECK (celd_patch_add (&patches, (CeldPatch) { 4, 6, 7, 2 }) == CELD_OK);
  NEAR (patches.n, 4, 0);
  celd_patches_clear (&patches);
}

/* The rectangle round all pixels in which two pictures differ; empty where they do not. */
static CeldRect
box_of_differences (const uint32_t *a, const uint32_t *b)
{
  CeldRect box = { 0 };

  for (int p = 0; p < 32; p++)
    if (a[p] != b[p])
      box = celd_rect_union (box, (CeldRect) { p % 8, p / 8, 1, 1 });
  return box;
}

/* Random patches over basins that keep their labels: each pixel has the label of the last patch over it, or of its
 * basin; the rectangle is exactly that of what differs; and each label has as many pixels as are counted. */
static void
random_patches_are_painted_over_one_another (void)
{
  static const uint32_t basin_of[32] = { 1, 1, 1, 1, 2, 2, 2, 2, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 3,
                                         3, 3, 3, 3, 3, 3, 3, 3 };
  uint32_t seed = 5;
  Picture  p;

  picture_open (&p);
  paint (&p, 1, 2, 3, NULL, 0);
  for (int trial = 0; trial < 3000; trial++)
    {
      CeldPatch   patch[6];
      size_t      n = check_random (&seed, 7), count[6] = { 0 };
      uint32_t    wanted[32], before[32];
      CeldRegion  item[5] = { { .area = 7 } };
      CeldPalette palette = { item, 5 };
      CeldRect    box;

      memcpy (wanted, basin_of, sizeof wanted);
      memcpy (before, p.labels.data, sizeof before);
      for (size_t i = 0; i < n; i++)
        {
          int x = (int) check_random (&seed, 8), end = x + 1 + (int) check_random (&seed, (uint32_t) (8 - x));

          patch[i] = (CeldPatch) { (int) check_random (&seed, 4), x, end, 1 + check_random (&seed, 5) };
          for (int k = x; k < end; k++)
            wanted[8 * patch[i].y + k] = patch[i].label;
        }
      paint (&p, 1, 2, 3, patch, n);
      CHECK (!memcmp (wanted, p.labels.data, sizeof wanted));
      box = box_of_differences (before, wanted);
      changed_is (&p, box.x, box.y, box.width, box.height);
      for (size_t i = 0; i < p.labelling.patches.n; i++)
        CHECK (p.labelling.patches.item[i].x < p.labelling.patches.item[i].end);
      CHECK (celd_labelling_measure (&p.labelling, &basins, &p.labels, &palette) == CELD_OK);
      for (int k = 0; k < 32; k++)
        count[wanted[k]]++;
      for (uint32_t label = 1; label <= 5; label++)
        {
          const CeldRegion *region = &item[label - 1];

          CHECK (region->area == count[label]);
          CHECK (count[label] ? wanted[8 * region->y + region->x] == label : region->x == -1);
        }
    }
  picture_close (&p);
}

/* A picture that replaces another at random: the rectangle is that of what differs. */
static void
random_whole_pictures_replace_the_labels (void)
{
  uint32_t seed = 6;
  Picture  p;

  picture_open (&p);
  for (int trial = 0; trial < 500; trial++)
    {
      uint32_t   data[32];
      CeldLabels whole = { 8, 4, 8, data };
      CeldRect   box;

      memcpy (data, p.labels.data, sizeof data);
      for (uint32_t n = check_random (&seed, 5); n > 0; n--)
        data[check_random (&seed, 32)] = 1 + check_random (&seed, 4);
      box = box_of_differences (p.labels.data, data);
      p.labelling.changed = (CeldRect) { 0 };
      CHECK (celd_labelling_replace (&p.labelling, &basins, &whole, &p.labels) == CELD_OK);
      CHECK (!memcmp (data, p.labels.data, sizeof data));
      changed_is (&p, box.x, box.y, box.width, box.height);
    }
  picture_close (&p);
}

int
main (void)
{
  RUN (only_basins_with_a_new_label_are_painted);
  RUN (patches_that_are_gone_show_their_basins_again);
  RUN (patches_end_up_sorted_and_without_overlaps);
  RUN (a_basin_may_take_over_its_patch);
  RUN (labels_have_their_area_and_their_place_farthest_from_ink);
  RUN (a_whole_picture_replaces_the_labels);
  RUN (runs_that_continue_one_another_are_one);
  RUN (runs_of_other_labels_or_rows_stay_apart);
  RUN (random_patches_are_painted_over_one_another);
  RUN (random_whole_pictures_replace_the_labels);
  return DONE;
}
