/* The paper along the frame of a picture, against a list made side by side.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"

enum { MOST = 14 };

/* Adds the first paper of n pixels from `start` on, a step apart. */
static size_t
first_paper (const bool *paper, int start, int step, int n, size_t *list, size_t listed)
{
  for (int k = 0; k < n; k++)
    if (paper[start + k * step])
      {
        list[listed] = (size_t) (start + k * step);
        return listed + 1;
      }
  return listed;
}

/* From top, bottom, left and right, looking at most `reach` pixels beyond the outermost. */
static size_t
wanted_frame (const bool *paper, int w, int h, int reach, size_t *list)
{
  int    down = reach + 1 < h ? reach + 1 : h, right = reach + 1 < w ? reach + 1 : w;
  size_t n = 0;

  for (int x = 0; x < w; x++)
    n = first_paper (paper, x, w, down, list, n);
  for (int x = 0; x < w; x++)
    n = first_paper (paper, (h - 1) * w + x, -w, down, list, n);
  for (int y = 0; y < h; y++)
    n = first_paper (paper, y * w, 1, right, list, n);
  for (int y = 0; y < h; y++)
    n = first_paper (paper, y * w + w - 1, -1, right, list, n);
  return n;
}

static void
check_frame (const float *ink, int w, int h, int stroke, int reach)
{
  CeldPlane plane = { w, h, (size_t) w, (float *) ink };
  bool      paper[MOST * MOST];
  size_t    wanted[4 * MOST], *found = NULL, n = 0;

  for (int p = 0; p < w * h; p++)
    paper[p] = celd_is_paper (ink[p]);
  CHECK (celd_frame (&plane, w, h, stroke, &found, &n) == CELD_OK);
  CHECK (n == wanted_frame (paper, w, h, reach, wanted) && !memcmp (found, wanted, n * sizeof *found));
  celd_free (found);
}

/* With paper at the edge nothing is looked for inside. */
static void
outermost_paper (void)
{
  uint32_t seed = 3;

  for (int trial = 0; trial < 300; trial++)
    {
      int   w = 1 + (int) check_random (&seed, MOST), h = 1 + (int) check_random (&seed, MOST);
      float ink[MOST * MOST];

      for (int p = 0; p < w * h; p++)
        ink[p] = check_random (&seed, 2) ? 1 : 0;
      for (int p = 0; p < w; p++)
        ink[p] = 1;
      check_frame (ink, w, h, 1 + (int) check_random (&seed, 3), 0);
    }
}

/* Behind a frame of ink, as far as four strokes and two pixels from the outermost ones. */
static void
paper_behind_a_drawn_frame (void)
{
  for (int thick = 1; thick <= 7; thick++)
    for (int side = 2 * thick; side <= MOST; side++)
      {
        float ink[MOST * MOST];

        for (int y = 0; y < side; y++)
          for (int x = 0; x < side; x++)
            ink[y * side + x] = x >= thick && y >= thick && x < side - thick && y < side - thick;
        check_frame (ink, side, side, 1, 6);
      }
}

/* A tenth of the outermost pixels is enough to be the frame: 4 of 40, but not 3. */
static void
a_tenth_decides (void)
{
  for (int gaps = 3; gaps <= 4; gaps++)
    {
      float ink[100];

      for (int p = 0; p < 100; p++)
        ink[p] = p / 10 > 0 && p / 10 < 9 && p % 10 > 0 && p % 10 < 9;
      for (int x = 0; x < gaps; x++)
        ink[3 + x] = 1;
      check_frame (ink, 10, 10, 1, gaps == 4 ? 0 : 6);
    }
}

/* Without ink all is paper; each outermost pixel counts for each of its sides. */
static void
without_ink (void)
{
  size_t *found = NULL, n = 0;

  CHECK (celd_frame (NULL, 3, 2, 0, &found, &n) == CELD_OK && n == 10);
  CHECK (found[0] == 0 && found[2] == 2 && found[3] == 3 && found[5] == 5 && found[6] == 0 && found[7] == 3 &&
         found[8] == 2 && found[9] == 5);
  celd_free (found);
}

int
main (void)
{
  RUN (outermost_paper);
  RUN (paper_behind_a_drawn_frame);
  RUN (a_tenth_decides);
  RUN (without_ink);
  return DONE;
}
