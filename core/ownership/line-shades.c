/* Of what fills lines are shades: of a coloured drawing, of which each line may be darker in the hue of the part that it
 * outlines.
 *
 * Through the ink at each point of an edge, colours are compared with the paper on both sides.  The shades of a colour
 * lie on the line from it to black.  Ink that begins with a shade of the paper on this side is that paper's outline; ink
 * that is a shade of the paper on the other side throughout is the other's.  Where both papers have nearly the same hue,
 * or the line is nearly black, colours tell nothing; nor do they in thin lines, where all are mixed with those beside.
 *
 * By chance lines in one colour are shades of some fill, as brown lines are of skin.  So all of this counts only if
 * the lines of a drawing have several hues, and most of those that can be compared are shades of a fill beside them.
 *
 * Cost: the length of the edges times the thickness of the ink.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "ownership/ownership.h"

#include <math.h>

#define BESIDE_EDGE   2.5f  /* pixels from the edge of ink to where paper is not antialiased; chosen */
#define THINNEST_LINE 2.5f  /* pixels, to have colours of its own; chosen */
#define SHADE_STEP    0.5f  /* pixels between the samples through a line; chosen */
#define MOST_THICK    64.f  /* pixels; thicker ink is no line; chosen */
#define LEAST_SAMPLES 2     /* of a line beside another one, at least; chosen */
#define HUES_APART    8.f   /* of 255: by how much shades of both papers must differ; chosen */
#define NEAR_SHADE    0.3f  /* how far a colour may be from a shade of one paper, as a share of that; chosen */
#define LEAST_POINTS  64    /* to tell how lines are coloured; chosen: some edges of 16 pixels */
#define LEAST_SHADES  0.6f  /* share of points with a shade, at least; measured in 60 drawings: .71 and more with such lines
                             * of 3 pixels and more, .47 and less with lines of one colour */
#define MOST_ALIKE    0.85f /* share of these where lines have the same hue, at most; chosen */

typedef struct { float red, green, blue; } Colour;

typedef struct
{
  const CeldPaint *colours;
  const CeldPlane *ink;
  size_t           compared, shades;                 /* points that can be compared; that have a shade */
  CeldHueCounts    of_hue;                           /* these, by the line's hue */
} ShadeReader;

/* ------------------------------------------------------------------ colours */

static float
dot (Colour a, Colour b)
{
  return a.red * b.red + a.green * b.green + a.blue * b.blue;
}

/* A colour's distance from the shades of a hue. */
static float
distance_from_shades (Colour colour, Colour hue)
{
  float shade = dot (colour, hue);

  return sqrtf (celd_most (dot (colour, colour) - shade * shade, 0));
}

/* The unit vector of a colour; of black that of grey. */
static Colour
hue_of (Colour colour)
{
  float length = sqrtf (dot (colour, colour));

  return length > 0 ? (Colour) { colour.red / length, colour.green / length, colour.blue / length }
                    : (Colour) { sqrtf (1.f / 3), sqrtf (1.f / 3), sqrtf (1.f / 3) };
}

/* The colour on white, 0 .. 255, of the pixel that a point in the picture lies in. */
static Colour
colour_at (const ShadeReader *s, float x, float y)
{
  const uint8_t *p = CELD_RGBA (s->colours, celd_floor (x), celd_floor (y));
  float          alpha = p[3] / 255.0f, white = 255 * (1 - alpha);

  return (Colour) { white + alpha * p[0], white + alpha * p[1], white + alpha * p[2] };
}

/* The hue of the paper that far along the normal; false if there is none. */
static bool
paper_hue (const ShadeReader *s, const CeldEdgePoint *p, float along, Colour *hue)
{
  float x = p->x + along * p->nx, y = p->y + along * p->ny;

  if (!(x >= 0 && y >= 0 && x < (float) s->ink->width && y < (float) s->ink->height) ||
      !celd_is_paper (CELD_AT (s->ink, (int) x, (int) y)))
    return false;
  *hue = hue_of (colour_at (s, x, y));
  return true;
}

/* ------------------------------------------------------------------ one point */

/* How many samples through the ink there are, how many of the first are shades of the paper on this side, and how many of
 * the last of that on the other side. */
typedef struct { size_t n, near, far; } ShadeRuns;

/* False if colours tell nothing. */
static bool
read_runs (const ShadeReader *s, const CeldEdgePoint *p, ShadeRuns *runs)
{
  float  apart = 0, hues_apart;
  bool   near_goes_on = true;
  Colour near, far;

  if (p->skewed || p->across < 0 || p->thickness < THINNEST_LINE || p->thickness > MOST_THICK ||
      !paper_hue (s, p, -BESIDE_EDGE, &near) || !paper_hue (s, p, p->thickness + BESIDE_EDGE, &far))
    return false;
  hues_apart = distance_from_shades (near, far);
  *runs = (ShadeRuns) { 0, 0, 0 };
  for (float along = CELD_INK_FADES; along <= p->thickness - CELD_INK_FADES; along += SHADE_STEP, runs->n++)
    {
      Colour c = colour_at (s, p->x + along * p->nx, p->y + along * p->ny);
      float  here = hues_apart * sqrtf (dot (c, c));

      near_goes_on = near_goes_on && distance_from_shades (c, near) <= NEAR_SHADE * here;
      runs->near += near_goes_on;
      runs->far = distance_from_shades (c, far) <= NEAR_SHADE * here ? runs->far + 1 : 0;
      apart += here;
    }
  return runs->n && apart >= HUES_APART * (float) runs->n;
}

/* Counts the hue of the line whose shade is known. */
static void
count_hue (ShadeReader *s, const CeldContourEdges *edges, const CeldEdgePoint *p)
{
  uint32_t pixel = celd_shade_pixel (edges, p), width = (uint32_t) edges->width;
  Colour   c = colour_at (s, (float) (pixel % width), (float) (pixel / width));

  (*celd_hue_count (s->of_hue, c.red, c.green, c.blue))++;
}

static void
read_shade (ShadeReader *s, const CeldContourEdges *edges, CeldEdgePoint *p)
{
  ShadeRuns runs;

  p->shade = CELD_SHADE_UNKNOWN;
  if (!read_runs (s, p, &runs))
    return;
  s->compared++;
  if (runs.near == runs.n || runs.near >= LEAST_SAMPLES)
    p->shade = CELD_SHADE_NEAR;
  else if (runs.far == runs.n)
    p->shade = CELD_SHADE_FAR;
  else
    return;
  s->shades++;
  count_hue (s, edges, p);
}

/* ------------------------------------------------------------------ all points */

/* How many points have the commonest hue of lines, or one next to it. */
static size_t
count_commonest_hue (const ShadeReader *s)
{
  size_t most = 0;

  for (int r = 1; r < CELD_HUE_SHARES - 1; r++)
    for (int g = 1; g < CELD_HUE_SHARES - 1; g++)
      {
        size_t sum = 0;

        for (int v = r - 1; v <= r + 1; v++)
          for (int u = g - 1; u <= g + 1; u++)
            sum += s->of_hue[v][u];
        most = sum > most ? sum : most;
      }
  return most;
}

/* Are the lines of the drawing shades of fills, and not by chance? */
static bool
lines_are_shades (const ShadeReader *s)
{
  return s->compared >= LEAST_POINTS && (float) s->shades >= LEAST_SHADES * (float) s->compared &&
         (float) count_commonest_hue (s) <= MOST_ALIKE * (float) s->shades;
}

CeldStatus
celd_line_shades_read (const CeldPaint *colours, const CeldPlane *ink, CeldContourEdges *edges)
{
  ShadeReader *s = celd_alloc0 (1, sizeof *s);
  CeldStatus   status = CELD_OK;

  if (!s)
    return CELD_NO_MEMORY;
  s->colours = colours;
  s->ink     = ink;
  for (size_t i = 0; i < edges->n_points; i++)
    read_shade (s, edges, &edges->point[i]);
  if (lines_are_shades (s))
    status = celd_line_pieces_find (colours, ink, edges);
  celd_free (s);
  return status;
}
