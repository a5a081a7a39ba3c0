/* Basins, boundaries and components against their definition, pixel by pixel, on random drawings.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "basin-drawings.h"
#include "image/image.h"
#include "segment/basins.h"

/* ------------------------------------------------------------------ the definition, slowly */

typedef struct
{
  int       w, h;
  CeldPlane ink;
  int32_t  *squared;   /* to ink; of ink minus that to paper */
  int64_t  *relief;
  int      *basin;     /* number of the maximum in reading order */
} Slow;

static bool
slow_paper (const Slow *s, int p)
{
  return celd_is_paper (CELD_AT (&s->ink, p % s->w, p / s->w));
}

static int32_t
slow_distance (const Slow *s, int p)
{
  int32_t least = INT32_MAX;

  for (int q = 0; q < s->w * s->h; q++)
    if (slow_paper (s, p) != slow_paper (s, q))
      {
        int dx = p % s->w - q % s->w, dy = p / s->w - q / s->w;

        least = dx * dx + dy * dy < least ? dx * dx + dy * dy : least;
      }
  return slow_paper (s, p) ? least : -least;
}

/* Where p ascends to: itself at a maximum. */
static int
slow_step (const Slow *s, int p)
{
  int     to = p, x = p % s->w, y = p / s->w;
  int64_t best = s->relief[p];

  static const int order[8][2] = {
    { 0, 1 }, { 1, 0 }, { -1, 0 }, { 0, -1 }, { -1, -1 }, { 1, -1 }, { -1, 1 }, { 1, 1 }
  };

  for (int k = 0; k < 8; k++)
    {
      int u = x + order[k][0], v = y + order[k][1], q = v * s->w + u;

      if (u < 0 || v < 0 || u >= s->w || v >= s->h)
        continue;
      if (s->relief[q] > best || (s->relief[q] == best && k < 2))
        {
          best = s->relief[q];
          to = q;
        }
    }
  return to;
}

static void
slow_new (const CeldPlane *ink, int stroke, Slow *s)
{
  int n = ink->width * ink->height, t = stroke > 2 ? stroke : 2, found = 0;

  *s = (Slow) { ink->width, ink->height, *ink, malloc ((size_t) n * sizeof (int32_t)),
                malloc ((size_t) n * sizeof (int64_t)), malloc ((size_t) n * sizeof (int)) };
  for (int p = 0; p < n; p++)
    {
      s->squared[p] = slow_distance (s, p);
      s->relief[p] = s->squared[p] < -t * t ? -(int64_t) s->squared[p] - 2 * t * t : s->squared[p];
    }
  for (int p = 0; p < n; p++)
    s->basin[p] = slow_step (s, p) == p ? found++ : -1;
  for (int p = 0; p < n; p++)
    if (slow_step (s, p) != p)
      {
        int q = p;

        while (slow_step (s, q) != q)
          q = slow_step (s, q);
        s->basin[p] = s->basin[q];
      }
}

static void
slow_clear (Slow *s)
{
  free (s->squared);
  free (s->relief);
  free (s->basin);
}

static bool
outermost (const Slow *s, int p)
{
  return p % s->w == 0 || p % s->w == s->w - 1 || p < s->w || p >= s->w * (s->h - 1);
}

/* The boundary of two basins by definition; `pairs` 0 if they do not touch. */
static CeldBasinBoundary
slow_boundary (const Slow *s, const CeldBasins *basins, int a, int b, int *pairs)
{
  CeldBasinBoundary boundary = { .a = (uint32_t) a, .b = (uint32_t) b, .saddle = -1 };

  *pairs = 0;
  for (int p = 0; p < s->w * s->h; p++)
    for (int south = 0; south < 2; south++)
      {
        int     x = p % s->w, y = p / s->w, u = x + !south, v = y + south, q = v * s->w + u;
        int32_t dp = s->squared[p], dq, least = 0;
        bool    along;

        if (u >= s->w || v >= s->h ||
            !((s->basin[p] == a && s->basin[q] == b) || (s->basin[p] == b && s->basin[q] == a)))
          continue;
        dq = s->squared[q];
        along = south ? x == 0 || x == s->w - 1 : y == 0 || y == s->h - 1;
        ++*pairs;
        boundary.cost += celd_smoothness_cost (&basins->costs, CELD_AT (&s->ink, x, y), CELD_AT (&s->ink, u, v), -dp,
                                               -dq, along);
        if (dp > 0 && dq > 0)
          {
            boundary.opening++;
            boundary.frame = boundary.frame || (outermost (s, p) && outermost (s, q));
            least = dp < dq ? dp : dq;
          }
        else if (basins->basin[a].solid && basins->basin[b].solid)
          least = -(dp > dq ? dp : dq);
        if (least > boundary.saddle)
          {
            boundary.saddle = least;
            boundary.x = x;
            boundary.y = y;
            boundary.south = south;
          }
      }
  return boundary;
}

/* ------------------------------------------------------------------ comparisons */

static void
same_runs (const Slow *s, const CeldBasins *basins)
{
  int     wrong = 0, found = 0;
  size_t  area = 0;
  int32_t last;

  CHECK (basins->width == s->w && basins->height == s->h && basins->row[0] == 0);
  for (int p = 0; p < s->w * s->h; p++)
    {
      uint32_t         k = celd_basin_at (basins, p % s->w, p / s->w);
      const CeldBasin *basin = &basins->basin[k];

      wrong += k != (uint32_t) s->basin[p];
      if (slow_step (s, p) != p)
        continue;
      found++;
      wrong += basin->x != p % s->w || basin->y != p / s->w || basin->squared != abs (s->squared[p]) ||
               basin->solid != (s->squared[p] < 0);
    }
  CHECK (basins->n == (size_t) found);
  for (size_t k = 0; k < basins->n; k++)
    area += basins->basin[k].area;
  CHECK (area == (size_t) (s->w * s->h));
  for (int y = 0; y < s->h; y++, last = -1)
    {
      last = -1;
      wrong += basins->run[basins->row[y]].x != 0;
      for (size_t i = basins->row[y]; i < basins->row[y + 1]; i++)
        {
          wrong += basins->run[i].x <= last;
          wrong += last >= 0 && basins->run[i].basin == basins->run[i - 1].basin;
          last = basins->run[i].x;
        }
    }
  CHECK (wrong == 0);
}

static void
same_boundaries (const Slow *s, const CeldBasins *basins)
{
  size_t n = 0;

  for (int a = 0; a < (int) basins->n; a++)
    for (int b = a + 1; b < (int) basins->n; b++)
      {
        int                      pairs;
        CeldBasinBoundary        wanted = slow_boundary (s, basins, a, b, &pairs);
        const CeldBasinBoundary *boundary = &basins->boundary[n];

        if (!pairs)
          continue;
        CHECK (n < basins->n_boundaries);
        if (n++ >= basins->n_boundaries)
          return;
        CHECK (boundary->a == wanted.a && boundary->b == wanted.b && boundary->opening == wanted.opening);
        CHECK (boundary->saddle == wanted.saddle && boundary->frame == wanted.frame && boundary->cost == wanted.cost);
        CHECK (boundary->x == wanted.x && boundary->y == wanted.y && boundary->south == wanted.south);
      }
  CHECK (n == basins->n_boundaries);
}

/* Components are connected paper; enclosures divide them, and merged basins divide enclosures; every number occurs. */
static void
right_unions (const Slow *s, const CeldBasins *basins)
{
  size_t         n = (size_t) (s->w * s->h), n_components = 0;
  CeldLabels     paper = { s->w, s->h, (size_t) s->w, malloc (n * sizeof (uint32_t)) };
  CeldComponent *list = NULL;
  uint32_t      *room_of = calloc (basins->n_merged + 1, sizeof *room_of), least = 0;
  uint32_t      *piece_of = calloc (basins->n_enclosures + 1, sizeof *piece_of);
  int            wrong = 0;

  for (size_t p = 0; p < n; p++)
    paper.data[p] = slow_paper (s, (int) p);
  CHECK (celd_components (&paper, 0, false, NULL, &paper, &list, &n_components) == CELD_OK);
  CHECK (basins->n_components == n_components);
  piece_of[0] = 0;
  for (size_t p = 0; p < n; p++) /* the same partition of paper: one number for another */
    {
      uint32_t component = basins->component[s->basin[p]];

      if (!paper.data[p] || !n_components)
        continue;
      wrong += component == 0;
      for (size_t q = p; q-- > 0 && q + (size_t) s->w >= p;)
        if (paper.data[q])
          wrong += (paper.data[q] == paper.data[p]) != (basins->component[s->basin[q]] == component);
    }
  for (size_t k = 0; k < basins->n; k++)
    {
      uint32_t merged = basins->merged[k], enclosure = basins->enclosure[k], component = basins->component[k];
      bool     solid = basins->basin[k].solid;

      wrong += merged < 1 || merged > basins->n_merged || enclosure > basins->n_enclosures ||
      component > basins->n_components;
      wrong += (enclosure == 0) != solid || (component == 0) != solid;
      wrong += merged > least + 1;
      least = merged > least ? merged : least;
      wrong += room_of[merged] && room_of[merged] != enclosure + 1;
      room_of[merged] = enclosure + 1;
      wrong += enclosure && piece_of[enclosure] && piece_of[enclosure] != component;
      piece_of[enclosure] = component;
    }
  CHECK (wrong == 0);
  CHECK (least == basins->n_merged);
  free (paper.data);
  free (room_of);
  free (piece_of);
  celd_free (list);
}

static void
compare (const CeldPlane *ink)
{
  CeldBasins basins = { 0 };
  Slow       slow;

  CHECK (celd_basins_new (ink, THRESHOLD, NULL, &basins) == CELD_OK);
  CHECK (basins.stroke == celd_stroke_width (ink));
  slow_new (ink, basins.stroke, &slow);
  same_runs (&slow, &basins);
  same_boundaries (&slow, &basins);
  right_unions (&slow, &basins);
  slow_clear (&slow);
  celd_basins_clear (&basins);
  CHECK (!basins.basin && !basins.run && !basins.n);
}

static void
basins_of_random_drawings_are_those_of_single_ascents (void)
{
  static const int size[][2] = { { 1, 1 }, { 1, 30 }, { 30, 1 }, { 2, 2 }, { 3, 7 }, { 17, 13 }, { 31, 40 }, { 20, 70 },
                                 { 70, 34 } };
  uint32_t         state = 11;

  for (size_t i = 0; i < sizeof size / sizeof *size; i++)
    for (int round = 0; round < 25; round++)
      {
        int       w = size[i][0], h = size[i][1];
        size_t    stride = (size_t) w + check_random (&state, 4);
        CeldPlane ink = { w, h, stride, calloc (stride * (size_t) h, sizeof (float)) };

        draw (&state, round % 6, &ink);
        if (round % 5 == 0)
          CELD_AT (&ink, check_random (&state, (uint32_t) w), check_random (&state, (uint32_t) h)) = NAN;
        compare (&ink);
        free (ink.data);
      }
}

int
main (void)
{
  RUN (basins_of_random_drawings_are_those_of_single_ascents);
  return DONE;
}
