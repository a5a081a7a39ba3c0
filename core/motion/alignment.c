/* Rigid alignment of all that moves, before registration: without it motion could be followed only as far as blocks
 * reach.
 *
 * All shifts and a number of turns are tried on a coarse picture: a few hundred pixels of ink of the source vote for
 * each by the nearness to ink of the target where they come to lie.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/motion.h"

#define ALIGN_TURNS 9    /* to either side; chosen */
#define ALIGN_TURN  5.0  /* degrees; chosen */
#define ALIGN_INK   400  /* pixels that vote; chosen */
#define ALIGN_REST  0.05 /* what no motion counts more than one across the whole picture or by a right angle; chosen */

typedef struct
{
  const CeldMatchImages *images;
  CeldInkPlace          *ink;     /* from the centre, in pixels of the scale */
  size_t                 n;
  float                  centre[2];
  float                 *score;   /* of each turn */
  int                  (*shift)[2];
} Alignment;

/* Refers the places of ink to their centre. */
static void
centre_ink (Alignment *a)
{
  double x = 0, y = 0;

  for (size_t i = 0; i < a->n; i++)
    {
      x += (double) a->ink[i].x;
      y += (double) a->ink[i].y;
    }
  a->centre[0] = (float) (x / (double) a->n);
  a->centre[1] = (float) (y / (double) a->n);
  for (size_t i = 0; i < a->n; i++)
    {
      a->ink[i].x -= a->centre[0];
      a->ink[i].y -= a->centre[1];
    }
}

/* ------------------------------------------------------------------ votes */

static double
radians (int turn)
{
  return (turn - ALIGN_TURNS) * ALIGN_TURN * CELD_RADIANS;
}

/* The best shift of one turn. */
static void
try_turn (void *data, int turn)
{
  Alignment             *a = data;
  const CeldMatchImages *i = a->images;
  int                    w = i->width, h = i->height, stride = w + 2 * i->pad;
  float                  c = (float) cos (radians (turn)), s = (float) sin (radians (turn));
  double                 largest = hypot (w, h);

  a->score[turn] = -1;
  for (int dy = -h / 2; dy <= h / 2; dy++)
    for (int dx = -w / 2; dx <= w / 2; dx++)
      {
        float sum = 0, score;

        for (size_t k = 0; k < a->n; k++)
          {
            int x = (int) (a->centre[0] + c * a->ink[k].x - s * a->ink[k].y + 0.5f) + dx;
            int y = (int) (a->centre[1] + s * a->ink[k].x + c * a->ink[k].y + 0.5f) + dy;

            if (x >= 0 && y >= 0 && x < w && y < h)
              sum += i->target[(y + i->pad) * stride + x + i->pad];
          }
        score = sum / (float) a->n -
                (float) (ALIGN_REST * (hypot (dx, dy) / largest + fabs (radians (turn)) / (CELD_PI / 2)));
        if (score > a->score[turn])
          {
            a->score[turn]    = score;
            a->shift[turn][0] = dx;
            a->shift[turn][1] = dy;
          }
      }
}

static void
move (CeldLattice *lattice, const Alignment *a, int turn)
{
  float f = (float) a->images->factor, c = (float) cos (radians (turn)), s = (float) sin (radians (turn));
  float x0 = (a->centre[0] + 0.5f) * f, y0 = (a->centre[1] + 0.5f) * f;

  for (size_t v = 0; v < lattice->n_vertices; v++)
    {
      float *p = lattice->place + 2 * v, x = p[0] - x0, y = p[1] - y0;

      p[0] = x0 + c * x - s * y + f * (float) a->shift[turn][0];
      p[1] = y0 + s * x + c * y + f * (float) a->shift[turn][1];
    }
}

CeldStatus
celd_align (CeldLattice *lattice, const CeldMatchImages *images, CeldMatcher *matcher, const CeldHost *host)
{
  float     score[2 * ALIGN_TURNS + 1];
  int       shift[2 * ALIGN_TURNS + 1][2] = { { 0 } }, best = ALIGN_TURNS;
  Alignment a = { .images = images, .ink = celd_alloc (ALIGN_INK, sizeof *a.ink), .score = score, .shift = shift };

  if (!a.ink)
    return CELD_NO_MEMORY;
  a.n = celd_matcher_ink (matcher, ALIGN_INK, a.ink);
  if (a.n)
    {
      centre_ink (&a);
      celd_parallel_for (host, 2 * ALIGN_TURNS + 1, try_turn, &a);
      for (int t = 0; t <= 2 * ALIGN_TURNS; t++)
        if (score[t] > score[best])
          best = t;
      move (lattice, &a, best);
    }
  celd_free (a.ink);
  return CELD_OK;
}
