/* Stroke widths, and the paper beside a stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"

static void
stroke_widths (void)
{
  const char *const thick[] = { ".......###......", ".......###......", ".......###......", ".......###......", NULL };
  const char *const none[] = { "....", NULL };
  CeldPlane a = art_plane (thick), b = art_plane (none);

  CHECK (celd_stroke_width (&a) >= 3 && celd_stroke_width (&a) <= 4);
  CHECK (celd_stroke_width (&b) == 0);
  free (a.data), free (b.data);
}

/* The median of all runs, counted pixel by pixel. */
static int
count_all (const CeldPlane *ink)
{
  static size_t runs[257];
  size_t        all = 0, below = 0;
  int           width = 0;

  memset (runs, 0, sizeof runs);
  for (int along = 0; along < 2; along++)
    for (int i = 0; i < (along ? ink->height : ink->width); i++)
      for (int j = 0, run = 0, n = along ? ink->width : ink->height; j <= n; j++)
        if (j < n && !celd_is_paper (along ? CELD_AT (ink, j, i) : CELD_AT (ink, i, j)))
          run++;
        else if (run)
          {
            runs[run < 256 ? run : 256]++;
            all++;
            run = 0;
          }
  while (width < 256 && 2 * below < all)
    below += runs[++width];
  return width;
}

/* From one long run to many short ones; pictures wider than what is gone through at once. */
static void
random_drawings (void)
{
  static const int size[][2] = { { 1, 1 }, { 1, 400 }, { 400, 1 }, { 30, 20 }, { 13, 300 }, { 9000, 3 }, { 4096, 2 },
                                 { 4097, 4 } };
  uint32_t         state = 3;

  for (size_t k = 0; k < sizeof size / sizeof *size; k++)
    for (int round = 0; round < 12; round++)
      {
        int       w = size[k][0], h = size[k][1];
        CeldPlane ink = { w, h, (size_t) w + 1, malloc (((size_t) w + 1) * (size_t) h * sizeof (float)) };

        for (int y = 0; y < h; y++)
          for (int x = 0, left = 0, inked = 0; x <= w; x++, left--)
            {
              if (left <= 0)
                {
                  inked = !inked || round == 0;
                  left = 1 + (int) check_random (&state, 1u << round);
                }
              CELD_AT (&ink, x, y) = inked ? 0.3f : x & 1 ? NAN : 1;
            }
        NEAR (celd_stroke_width (&ink), count_all (&ink), 0);
        free (ink.data);
      }
}

static void
the_nearest_paper (void)
{
  const char *const rows[] = {
    "#####..",
    "#####..",
    "#####..",
    ".####..", NULL };
  CeldPlane ink = art_plane (rows);
  int       x = 6, y = 1;

  CHECK (celd_paper_near (&ink, 0, &x, &y) && x == 6 && y == 1); /* is paper */
  x = 3;
  CHECK (!celd_paper_near (&ink, 1, &x, &y) && x == 3 && y == 1);
  CHECK (celd_paper_near (&ink, 2, &x, &y) && x == 5 && y == 1);
  x = 1, y = 2;
  CHECK (!celd_paper_near (&ink, 1, &x, &y));                    /* a diagonal step is longer than 1 */
  CHECK (celd_paper_near (&ink, 2, &x, &y) && x == 0 && y == 3);
  x = y = 0;
  CHECK (celd_paper_near (&ink, 256, &x, &y) && x == 0 && y == 3); /* farther than the picture is large */
  CELD_AT (&ink, 2, 2) = NAN;
  x = y = 2;
  CHECK (celd_paper_near (&ink, 9, &x, &y) && x == 2 && y == 2); /* NaN is paper */
  free (ink.data);
}

int
main (void)
{
  RUN (stroke_widths);
  RUN (random_drawings);
  RUN (the_nearest_paper);
  return DONE;
}
