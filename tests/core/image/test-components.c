/* Components against a flood fill, and small known pictures.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"

/* Writes k to all pixels connected to (x,y) that have its label; returns how many, and their box. */
static size_t
flood (const CeldLabels *labels, bool diagonal, int x, int y, uint32_t k, uint32_t *filled, CeldComponent *found)
{
  int    w = labels->width, h = labels->height, *stack = malloc ((size_t) (w * h) * sizeof *stack), n = 0;
  size_t area = 0;

  *found = (CeldComponent) { CELD_AT (labels, x, y), x, y, x, y, x, y, 0 };
  filled[y * w + x] = k;
  stack[n++] = y * w + x;
  while (n)
    {
      int p = stack[--n], px = p % w, py = p / w;

      area++;
      found->left = px < found->left ? px : found->left;
      found->right = px > found->right ? px : found->right;
      found->top = py < found->top ? py : found->top;
      found->bottom = py > found->bottom ? py : found->bottom;
      for (int qy = py - 1; qy <= py + 1; qy++)
        for (int qx = px - 1; qx <= px + 1; qx++)
          if (qx >= 0 && qy >= 0 && qx < w && qy < h && (diagonal || qx == px || qy == py) && !filled[qy * w + qx] &&
              CELD_AT (labels, qx, qy) == found->label)
            {
              filled[qy * w + qx] = k;
              stack[n++] = qy * w + qx;
            }
    }
  free (stack);
  return area;
}

/* celd_components must number and measure as the flood fill does. */
static void
compare (const CeldLabels *labels, uint32_t none, bool diagonal)
{
  int            w = labels->width, h = labels->height, wrong = 0;
  uint32_t      *filled = calloc ((size_t) (w * h), sizeof *filled), k = 0;
  CeldLabels     components = { w, h, (size_t) w, malloc ((size_t) (w * h) * sizeof (uint32_t)) };
  CeldComponent *list = NULL;
  size_t         n = 0;

  CHECK (celd_components (labels, none, diagonal, NULL, &components, &list, &n) == CELD_OK);
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      if (CELD_AT (labels, x, y) != none && !filled[y * w + x])
        {
          CeldComponent wanted;

          wanted.area = flood (labels, diagonal, x, y, ++k, filled, &wanted);
          CHECK (k <= n);
          if (k > n)
            continue;
          wrong += list[k - 1].label != wanted.label || list[k - 1].x != x || list[k - 1].y != y ||
                   list[k - 1].left != wanted.left || list[k - 1].right != wanted.right ||
                   list[k - 1].top != wanted.top || list[k - 1].bottom != wanted.bottom ||
                   list[k - 1].area != wanted.area;
        }
  CHECK (n == k);
  CHECK (wrong == 0);
  CHECK (memcmp (components.data, filled, (size_t) (w * h) * sizeof *filled) == 0);
  free (list);
  free (components.data);
  free (filled);
}

static void
random_labels (void)
{
  static const int size[][2] = { { 1, 1 }, { 1, 30 }, { 30, 1 }, { 2, 2 }, { 13, 21 }, { 60, 50 } };
  static uint32_t  data[64 * 50];
  uint32_t         state = 3;

  for (size_t s = 0; s < sizeof size / sizeof *size; s++)
    for (uint32_t labels = 1; labels <= 5; labels++)
      for (int round = 0; round < 8; round++)
        {
          CeldLabels l = { size[s][0], size[s][1], (size_t) size[s][0] + 3, data };

          for (size_t p = 0; p < l.stride * (size_t) l.height; p++)
            data[p] = check_random (&state, labels);
          compare (&l, UINT32_MAX, round & 1);
          compare (&l, 0, round & 1);
        }
}

/* Arms that meet late are one component; the diagonal step at the end counts only if asked for. */
static void
comb_and_spiral (void)
{
  static const char *const comb[] = { "A.A.A", "A.A.A", "AAAA.", "....A", NULL };
  static const char *const spiral[] = { "AAAAAAA", "......A", "AAAAA.A", "A...A.A", "A.AAA.A", "A.....A", "AAAAAAA",
                                        NULL };
  CeldLabels     l = art_labels (comb), c = art_labels (comb);
  CeldComponent *list;
  size_t         n;

  CHECK (celd_components (&l, 0, false, NULL, &c, &list, &n) == CELD_OK);
  CHECK (n == 3 && list[0].area == 8 && list[0].bottom == 2 && list[0].right == 3);
  free (list);
  CHECK (celd_components (&l, 0, true, NULL, &c, &list, &n) == CELD_OK);
  CHECK (n == 1 && list[0].area == 11 && list[0].label == 1);
  free (list);
  free (l.data);
  free (c.data);

  l = art_labels (spiral);
  CHECK (celd_components (&l, 0, false, NULL, &l, &list, &n) == CELD_OK); /* in place */
  CHECK (n == 1 && l.data[6] == 1 && l.data[4 * 7 + 2] == 1 && l.data[7] == 0);
  free (list);
  free (l.data);
}

static void
nothing_but_none (void)
{
  static uint32_t data[6] = { 4, 4, 4, 4, 4, 4 }, result[6] = { 9, 9, 9, 9, 9, 9 };
  CeldLabels      l = { 3, 2, 3, data }, c = { 3, 2, 3, result };
  CeldComponent  *list = NULL;
  size_t          n = 5;

  CHECK (celd_components (&l, 4, true, NULL, &c, &list, &n) == CELD_OK);
  CHECK (n == 0 && result[0] == 0 && result[5] == 0);
  free (list);
}

static void
failure_leaves_results_alone (void)
{
  uint32_t       data[2] = { 1, 2 }, result[2] = { 7, 7 };
  CeldLabels     l = { 2, 1, 2, data }, c = { 2, 1, 2, result }, tall = { 1, 2, 1, result };
  CeldHost       stop = { check_refuse, NULL, NULL };
  CeldComponent *list = NULL;
  size_t         n = 5;

  CHECK (celd_components (&l, 0, false, NULL, &tall, &list, &n) == CELD_BAD_SIZE);
  CHECK (celd_components (&l, 0, false, &stop, &c, &list, &n) == CELD_CANCELLED);
  CHECK (n == 5 && list == NULL && result[0] == 7 && result[1] == 7);
}

int
main (void)
{
  RUN (random_labels);
  RUN (comb_and_spiral);
  RUN (nothing_but_none);
  RUN (failure_leaves_results_alone);
  return DONE;
}
