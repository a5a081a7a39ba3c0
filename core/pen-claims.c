/* Ink goes to the pens: each edge claims the ink that its pen covers from there, and the nearest region's claim wins.
 *
 * A claim is a band along the edge, as wide as the pen.  Ink that no pen covers goes to the pen that misses it by
 * least, and what is beyond all, like areas filled with black, to the nearest ink that is claimed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "pens.h"

#include <math.h>

#define STEP   0.5f     /* pixels between the places of a ray */
#define APART  0.7f     /* and between rays at most */
#define BEYOND 3        /* pen widths that a band may reach: where a line turns sharply, its tip is so far away */
#define SOLID  10       /* a label is ink throughout if less than a tenth of it is paper */
#define GUESS  1e-3f    /* by how much a guess misses what it covers: less than any pen that does miss it */

/* Is a claim of this label, which misses the pixel by `over`, better than the one that there is? */
static bool
wins (const CeldClaims *c, uint32_t label, float over, uint32_t owner, float best)
{
  if (owner && over <= 0 && best <= 0 && c->pens->level[label - 1] != c->pens->level[owner - 1])
    return c->pens->level[label - 1] > c->pens->level[owner - 1];
  return !owner || over < best || (over == best && label < owner);
}

void
celd_claim_pixel (const CeldClaims *c, uint32_t label, int x, int y, float over, bool guess)
{
  uint32_t *owner;
  float    *best;

  if (x < 0 || y < 0 || x >= c->ink->width || y >= c->ink->height || CELD_AT (c->over, x, y) == -INFINITY)
    return;
  if (guess)
    over = over <= 0 ? GUESS / (2 + (float) c->pens->level[label - 1]) : over + 1;
  owner = &CELD_AT (c->owner, x, y);
  best  = &CELD_AT (c->over, x, y);
  if (wins (c, label, over, *owner, *best))
    {
      *owner = label;
      *best  = over;
    }
}

void
celd_claim_ray (const CeldClaims *c, uint32_t label, const CeldEdgePoint *from, float width, float length, bool guess)
{
  for (float s = STEP / 2; s < length; s += STEP)
    {
      int   x = (int) floorf (from->x + s * from->nx), y = (int) floorf (from->y + s * from->ny);
      float depth = ((float) x + 0.5f - from->x) * from->nx + ((float) y + 0.5f - from->y) * from->ny;

      celd_claim_pixel (c, label, x, y, depth - width, guess);
    }
}

/* How far a band goes from a place. */
static float
length_of (const CeldEdgePoint *p, const CeldPen *pen)
{
  return fminf (p->through + 0.5f, BEYOND * pen->width + 2);
}

/* The band from one place to the next. */
static void
claim_between (const CeldClaims *c, const CeldEdgePoint *a, const CeldEdgePoint *b, const CeldPen *from,
               const CeldPen *to)
{
  float length = fmaxf (length_of (a, from), length_of (b, to)), width = (from->width + to->width) / 2;
  float apart = hypotf (b->x + length * b->nx - a->x - length * a->nx, b->y + length * b->ny - a->y - length * a->ny);
  int   rays = (int) (apart / APART) + 1;

  for (int k = 0; k < rays; k++)
    {
      float         t = (float) k / (float) rays, nx = a->nx + t * (b->nx - a->nx), ny = a->ny + t * (b->ny - a->ny);
      float         norm = hypotf (nx, ny);
      CeldEdgePoint p = { .x = a->x + t * (b->x - a->x), .y = a->y + t * (b->y - a->y),
                          .nx = nx / norm, .ny = ny / norm };

      if (norm > 0.1f) /* not between opposite normals */
        celd_claim_ray (c, from->owner, &p, width, length, false);
    }
}

static void
claim_bands (const CeldClaims *c, const CeldEdgeLoop *loop)
{
  const CeldEdgePoint *point = &c->pens->edges->point[loop->first];
  const CeldPen       *pen = &c->pens->pen[loop->first];

  for (size_t i = 0; i < loop->n; i++)
    {
      size_t next = i + 1 < loop->n ? i + 1 : 0;

      if (pen[i].owner && pen[i].owner == pen[next].owner)
        claim_between (c, &point[i], &point[next], &pen[i], &pen[next]);
    }
}

/* ------------------------------------------------------------------ the rest */

/* Calls for the up to four neighbours of a pixel. */
static int
neighbours (const CeldPlane *ink, int x, int y, int near[4][2])
{
  int n = 0;

  for (int k = 0; k < 4; k++)
    {
      static const int step[4][2] = { { 0, -1 }, { -1, 0 }, { 1, 0 }, { 0, 1 } };
      int              u = x + step[k][0], v = y + step[k][1];

      if (u >= 0 && v >= 0 && u < ink->width && v < ink->height)
        {
          near[n][0]   = u;
          near[n++][1] = v;
        }
    }
  return n;
}

/* The pixels that have an owner, next to those that have none, one entry for each of these.  Returns their number;
 * queue may be NULL. */
static size_t
find_front (const CeldClaims *c, int32_t *queue)
{
  size_t n = 0;

  for (int y = 0; y < c->ink->height; y++)
    for (int x = 0; x < c->ink->width; x++)
      if (!CELD_AT (c->owner, x, y))
        {
          int near[4][2], k = neighbours (c->ink, x, y, near);

          for (int i = 0; i < k; i++)
            if (CELD_AT (c->owner, near[i][0], near[i][1]))
              {
                if (queue)
                  queue[n] = (int32_t) (near[i][1] * c->ink->width + near[i][0]);
                n++;
              }
            else if (!queue)
              n++; /* room for the pixel itself */
        }
  return n;
}

/* Ink that nobody has claimed goes to the nearest pixel that has an owner, from neighbour to neighbour. */
static CeldStatus
settle_rest (const CeldClaims *c)
{
  int      w = c->ink->width;
  int32_t *queue = celd_alloc (2 * find_front (c, NULL) + 1, sizeof *queue);
  size_t   n;

  if (!queue)
    return CELD_NO_MEMORY;
  n = find_front (c, queue);
  for (size_t i = 0; i < n; i++)
    {
      int near[4][2], k = neighbours (c->ink, queue[i] % w, queue[i] / w, near);

      for (int j = 0; j < k; j++)
        if (!CELD_AT (c->owner, near[j][0], near[j][1]))
          {
            CELD_AT (c->owner, near[j][0], near[j][1]) = CELD_AT (c->owner, queue[i] % w, queue[i] / w);
            queue[n++] = (int32_t) (near[j][1] * w + near[j][0]);
          }
    }
  celd_free (queue);
  return CELD_OK;
}

/* ------------------------------------------------------------------ whose the pixels are to begin with */

/* Paper, and all of a label that is hardly anything but ink, like a black shoe with a scribble of its own, is settled;
 * so is everything if there is nothing to go by. */
static CeldStatus
settle_paper (const CeldClaims *c)
{
  size_t *all = celd_alloc0 (c->pens->n, sizeof *all), *paper = celd_alloc0 (c->pens->n, sizeof *paper);

  for (int y = 0; all && paper && y < c->ink->height; y++)
    for (int x = 0; x < c->ink->width; x++)
      {
        all[CELD_AT (c->owner, x, y) - 1]++;
        paper[CELD_AT (c->owner, x, y) - 1] += celd_is_paper (CELD_AT (c->ink, x, y));
      }
  for (int y = 0; all && paper && y < c->ink->height; y++)
    for (int x = 0; x < c->ink->width; x++)
      {
        uint32_t *owner = &CELD_AT (c->owner, x, y);
        bool      settled = celd_is_paper (CELD_AT (c->ink, x, y)) || SOLID * paper[*owner - 1] < all[*owner - 1];

        CELD_AT (c->over, x, y) = settled ? -INFINITY : INFINITY;
        if (!settled)
          *owner = 0;
      }
  celd_free (all);
  celd_free (paper);
  return all && paper ? CELD_OK : CELD_NO_MEMORY;
}

CeldStatus
celd_pens_claim (const CeldPens *pens, const CeldPlane *ink, const CeldRun *run, CeldLabels *owner, CeldPlane *over)
{
  const CeldInkEdges *edges = pens->edges;
  CeldClaims          c = { pens, ink, owner, over };
  CeldStatus          status = settle_paper (&c);

  for (size_t k = 0; k < edges->n_loops && status == CELD_OK; k++)
    {
      claim_bands (&c, &edges->loop[k]);
      celd_claim_lines (&c, &edges->loop[k]);
      status = celd_step (run, (double) (edges->loop[k].first + edges->loop[k].n) / (double) edges->n_points);
    }
  return status == CELD_OK ? settle_rest (&c) : status;
}
