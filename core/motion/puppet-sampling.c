/* One square of a deformed layer, pixel by pixel.
 *
 * A square is two triangles, in each of which the map is affine.  A pixel of the picture belongs to the square whose
 * pixel of the layer its centre comes from; so squares leave no gaps, and nothing is drawn twice.  Squares at the edge
 * of a layer are extended by the pixels around that go with them, which carry its antialiasing; these come after all
 * squares, so that they don't take the place of other squares where the layer is bent.  Colours are interpolated
 * bilinearly, premultiplied, at multiples of 1/256 pixel: a layer that is moved by whole pixels is copied exactly.
 *
 * Lines keep their width where a square is stretched across them: what is beside the middle of a line is taken farther
 * from it.  Lines that are squeezed are not made wider again, since that would pull in what lies beside them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/puppet.h"

#define NEAR_SOURCE 3     /* pixels: what comes from nearer pixels of a layer is drawn once; chosen */
#define RIGID       0.02  /* by which lengths change in a square whose lines are drawn as they are; chosen */
#define MOST_CHANGE 1.6f  /* of the distance from the middle of a line, which keeps it out of other lines; chosen */
#define LEAST_AREA  1e-6  /* square pixels, twice the area of a triangle that is drawn */

/* A row of pixels from (x,y) on, in a triangle of a cell, and where they come from in the layer, in 1/256 pixel. */
typedef struct
{
  const CeldPuppetCanvas *canvas;
  const CeldPuppetLayer  *layer;
  uint32_t                cell, mark;  /* the cell + 1 */
  float                   level;
  int                     least[2], most[2]; /* pixels of the layer that the triangle takes its own from */
  int                     x, y, n;
  double                  at[2], step[2];
  bool                    rigid;       /* are lengths kept? */
  float                   map[2][2];   /* in pixels of the layer: the step to the right, and that down */
} Span;

/* Draws a premultiplied colour over another one. */
static inline void
draw_over (const float colour[4], float to[4])
{
  float rest = 1 - colour[3];

  for (int c = 0; c < 4; c++)
    to[c] = colour[c] + rest * to[c];
}

/* ------------------------------------------------------------------ layers at rest */

void
celd_puppet_draw_rest (const CeldPuppetCanvas *canvas, const CeldPuppetLayer *layer)
{
  int top = layer->box.y > canvas->top ? layer->box.y : canvas->top;
  int end = layer->box.y + layer->box.height, bottom = end < canvas->bottom ? end : canvas->bottom;

  for (int y = top; y < bottom; y++)
    {
      const float *from = layer->rgba + 4 * celd_puppet_pixel (layer, layer->box.x, y);
      float       *to = CELD_RGBA (canvas->picture, layer->box.x, y);

      for (int x = 0; x < layer->box.width; x++, from += 4, to += 4)
        if (from[3] > 0)
          {
            draw_over (from, to);
            if (canvas->levels && from[3] >= 0.5f)
              CELD_AT (canvas->levels, layer->box.x + x, y) = (float) layer->level;
          }
    }
}

/* ------------------------------------------------------------------ rows */

/* Whether this pixel was drawn in this layer already, from the same place; notes it if not. */
static inline bool
is_repeated (uint32_t drawn[2], uint32_t mark, int u, int v)
{
  int du = (int) (drawn[1] & 0xffff) - (u & 0xffff), dv = (int) (drawn[1] >> 16) - (v & 0xffff);

  if (drawn[0] == mark && du <= NEAR_SOURCE && du >= -NEAR_SOURCE && dv <= NEAR_SOURCE && dv >= -NEAR_SOURCE)
    return true;
  drawn[0] = mark;
  drawn[1] = (uint32_t) (u & 0xffff) | (uint32_t) (v & 0xffff) << 16;
  return false;
}

/* Interpolates the colour at (u,v), in 1/256 pixel from the first one stored. */
static inline void
sample (const float *rgba, size_t stride, int u, int v, float colour[4])
{
  const float *p = rgba + 4 * ((size_t) (v >> 8) * stride + (size_t) (u >> 8)), *q = p + 4 * stride;
  float        a = (float) (u & 255) / 256, b = (float) (v & 255) / 256;
  float        w[4] = { (1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b };

  for (int c = 0; c < 4; c++)
    colour[c] = w[0] * p[c] + w[1] * p[c + 4] + w[2] * q[c] + w[3] * q[c + 4];
}

/* ------------------------------------------------------------------ lines */

/* The offset of (u,v), in 1/256 pixel from the first one stored, from the middle of the line near it; bilinear. */
static void
offset_from_line (const Span *s, int u, int v, float offset[2])
{
  const CeldPuppet *puppet = s->canvas->puppet;
  int               x = ((u - 128) >> 8) + s->layer->box.x - CELD_PUPPET_PAD;
  int               y = ((v - 128) >> 8) + s->layer->box.y - CELD_PUPPET_PAD;
  float             a = (float) ((u - 128) & 255) / 256, b = (float) ((v - 128) & 255) / 256;
  const float      *p, *q;

  offset[0] = offset[1] = 0;
  if (x < 0 || y < 0 || x + 1 >= puppet->width || y + 1 >= puppet->height)
    return;
  p = puppet->line + 2 * ((size_t) y * (size_t) puppet->width + (size_t) x);
  q = p + 2 * puppet->width;
  for (int c = 0; c < 2; c++)
    offset[c] = (1 - b) * ((1 - a) * p[c] + a * p[c + 2]) + b * ((1 - a) * q[c] + a * q[c + 2]);
}

/* Takes (u,v) farther from the middle of a line by what the triangle is stretched across it. */
static void
keep_width (const Span *s, int *u, int *v)
{
  const CeldPuppetLayer *layer = s->layer;
  int                    most_u = (int) (celd_puppet_stride (layer) - 1) * 256 - 1;
  int                    most_v = (layer->box.height + 2 * CELD_PUPPET_PAD - 1) * 256 - 1;
  float                  offset[2], length, across[2], change;

  offset_from_line (s, *u, *v, offset);
  length = hypotf (offset[0], offset[1]);
  if (!(length > 0))
    return;
  for (int i = 0; i < 2; i++)
    across[i] = (s->map[i][0] * offset[0] + s->map[i][1] * offset[1]) / length;
  change = fminf (1 / hypotf (across[0], across[1]), MOST_CHANGE) - 1;
  if (change <= 0)
    return;
  *u += (int) lroundf (256 * change * offset[0]);
  *v += (int) lroundf (256 * change * offset[1]);
  *u = *u < 256 ? 256 : *u > most_u ? most_u : *u;
  *v = *v < 256 ? 256 : *v > most_v ? most_v : *v;
}

/* Whether an affine map, from steps of the picture to those of the layer, keeps lengths. */
static bool
is_rigid (float map[2][2])
{
  const float *a = map[0], *b = map[1];

  return fabsf (a[0] * a[0] + a[1] * a[1] - 1) < 2 * RIGID && fabsf (b[0] * b[0] + b[1] * b[1] - 1) < 2 * RIGID &&
         fabsf (a[0] * b[0] + a[1] * b[1]) < RIGID;
}

CELD_CLONES static void
draw_puppet_span (const Span *s)
{
  const CeldPuppetLayer *layer = s->layer;
  size_t                 stride = celd_puppet_stride (layer);
  int                    left = layer->box.x - CELD_PUPPET_PAD, top = layer->box.y - CELD_PUPPET_PAD;
  int                    w = (int) stride, h = layer->box.height + 2 * CELD_PUPPET_PAD;
  float                 *to = CELD_RGBA (s->canvas->picture, s->x, s->y);
  uint32_t              *drawn = s->canvas->puppet->drawn +
                                 2 * ((size_t) s->y * (size_t) s->canvas->puppet->width + (size_t) s->x);

  for (int i = 0; i < s->n; i++)
    {
      int   u = (int) (s->at[0] + i * s->step[0] + 0.5 - 256 * left);
      int   v = (int) (s->at[1] + i * s->step[1] + 0.5 - 256 * top), iu = u >> 8, iv = v >> 8;
      float colour[4];

      /* What rounding takes across the side of a square still belongs to it. */
      iu = iu < s->least[0] ? s->least[0] : iu > s->most[0] ? s->most[0] : iu;
      iv = iv < s->least[1] ? s->least[1] : iv > s->most[1] ? s->most[1] : iv;
      if (iu < 1 || iv < 1 || iu >= w - 1 || iv >= h - 1 ||
          layer->cell[(size_t) iv * stride + (size_t) iu] != s->cell)
        continue;
      if (!s->rigid)
        keep_width (s, &u, &v);
      sample (layer->rgba, stride, u - 128, v - 128, colour);
      if (!(colour[3] > 0) || is_repeated (drawn + 2 * i, s->mark, iu, iv))
        continue;
      draw_over (colour, to + 4 * i);
      if (s->canvas->levels && colour[3] >= 0.5f)
        CELD_AT (s->canvas->levels, s->x + i, s->y) = s->level;
    }
}

/* ------------------------------------------------------------------ triangles */

/* Where the line between two points is at height y; both orders of the points give the same number. */
static double
cross (const double p[2], const double q[2], double y)
{
  const double *a = p[1] < q[1] ? p : q, *b = p[1] < q[1] ? q : p;

  return a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]);
}

/* The pixels of a row whose centres lie between two numbers: from *first, returns their number. */
static int
pixels_between (double x0, double x1, int width, int *first)
{
  double from = ceil (fmin (x0, x1) - 0.5), to = ceil (fmax (x0, x1) - 0.5);

  from   = fmax (from, 0);
  to     = fmin (to, width);
  *first = from < to ? (int) from : 0;
  return from < to ? (int) (to - from) : 0;
}

/* Draws a triangle `to` of the picture from the triangle `from` of the layer. */
static void
draw_triangle (Span *s, double from[3][2], double to[3][2])
{
  double area = (to[1][0] - to[0][0]) * (to[2][1] - to[0][1]) - (to[2][0] - to[0][0]) * (to[1][1] - to[0][1]);
  double low = fmin (to[0][1], fmin (to[1][1], to[2][1])), high = fmax (to[0][1], fmax (to[1][1], to[2][1]));
  double map[2][2];
  int    top = (int) fmax (ceil (low - 0.5), s->canvas->top);
  int    bottom = (int) fmin (ceil (high - 0.5), s->canvas->bottom);

  if (!(fabs (area) > LEAST_AREA))
    return;
  for (int c = 0; c < 2; c++)
    {
      double a = from[1][c] - from[0][c], b = from[2][c] - from[0][c];

      map[c][0]  = 256 * (a * (to[2][1] - to[0][1]) - b * (to[1][1] - to[0][1])) / area;
      map[c][1]  = 256 * (b * (to[1][0] - to[0][0]) - a * (to[2][0] - to[0][0])) / area;
      s->step[c] = map[c][0];
      for (int i = 0; i < 2; i++)
        s->map[i][c] = (float) (map[c][i] / 256);
    }
  s->rigid = is_rigid (s->map);
  for (s->y = top; s->y < bottom; s->y++)
    {
      double y = s->y + 0.5, x[3];
      int    n = 0;

      for (int k = 0; k < 3; k++)
        if ((to[k][1] <= y) != (to[(k + 1) % 3][1] <= y))
          x[n++] = cross (to[k], to[(k + 1) % 3], y);
      if (n != 2)
        continue;
      s->n = pixels_between (x[0], x[1], s->canvas->puppet->width, &s->x);
      for (int c = 0; c < 2; c++)
        s->at[c] = 256 * from[0][c] + map[c][0] * (s->x + 0.5 - to[0][0]) + map[c][1] * (y - to[0][1]);
      draw_puppet_span (s);
    }
}

/* Draws the square of a cell, larger by `extent` pixels on each side. */
static void
draw_square (Span *s, size_t cell, int extent)
{
  static const int   corner[2][3] = { { 0, 1, 3 }, { 0, 3, 2 } };
  const CeldLattice *lattice = &s->canvas->puppet->lattice;
  const float       *rest = lattice->rest + 2 * (size_t) lattice->corner[4 * cell];
  double             from[4][2], to[4][2], low = INFINITY, high = -INFINITY;

  for (int c = 0; c < 2; c++)
    {
      s->least[c] = (int) rest[c] - extent - (c ? s->layer->box.y : s->layer->box.x) + CELD_PUPPET_PAD;
      s->most[c]  = s->least[c] + lattice->side + 2 * extent - 1;
    }
  for (int k = 0; k < 4; k++)
    {
      const float *corner_at = lattice->place + 2 * (size_t) lattice->corner[4 * cell + (size_t) k];
      float        x = rest[0] + (float) (k % 2 ? lattice->side + extent : -extent);
      float        y = rest[1] + (float) (k / 2 ? lattice->side + extent : -extent), place[2];

      celd_cell_map (lattice, cell, x, y, place);
      for (int c = 0; c < 2; c++)
        {
          from[k][c] = (double) (c ? y : x);
          to[k][c]   = extent ? (double) place[c] : (double) corner_at[c];
        }
      low  = fmin (low, to[k][1]);
      high = fmax (high, to[k][1]);
    }
  for (int t = 0; t < 2 && low < s->canvas->bottom && high > s->canvas->top; t++)
    {
      double part_from[3][2], part_to[3][2];

      for (int k = 0; k < 3; k++)
        {
          memcpy (part_from[k], from[corner[t][k]], sizeof from[0]);
          memcpy (part_to[k], to[corner[t][k]], sizeof to[0]);
        }
      draw_triangle (s, part_from, part_to);
    }
}

void
celd_puppet_draw_cell (const CeldPuppetCanvas *canvas, const CeldPuppetLayer *layer, size_t cell, float level,
                       uint32_t mark, bool beside)
{
  Span s = { .canvas = canvas, .layer = layer, .cell = (uint32_t) cell + 1, .mark = mark, .level = level };

  if (!beside)
    draw_square (&s, cell, 0);
  else if (canvas->puppet->bleeds[cell])
    draw_square (&s, cell, CELD_PUPPET_BLEED);
}
