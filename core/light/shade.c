/* Shading by light on normals (section 5, Figure 1f), in linear light: a factor for the art, and gloss on top of it.
 *
 * With n the normal, l the direction to the light, v = (0,0,1) that to the viewer and h halfway between them:
 *   Lambert        max (0, n . l)
 *   half Lambert   (1/2 + 1/2 n . l)^2                  [MFE07]
 *   toon           Lambert in equal steps, with edges one pixel wide
 *   matcap         the picture of a lit ball, read where the ball has this normal
 *   gloss          s max (0, n . h)^e where n . l > 0 [Bli77], and r (1 - n_z)^g along rims; in toon shading both
 *                  are either on or off
 *
 *   [Bli77]  J. F. Blinn: Models of Light Reflection for Computer Synthesized Pictures.  SIGGRAPH 1977.
 *   [MFE07]  J. Mitchell, M. Francke, D. Eng: Illustrative Rendering in Team Fortress 2.  NPAR 2007.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"

#include <math.h>

#define STEEP   1e-6 /* change of brightness between pixels that counts as none (chosen) */

typedef struct { double x, y, z; } Vector;

typedef struct
{
  const CeldVectors  *normals;
  const CeldPlane    *ink;         /* NULL: none */
  const CeldColours  *matcap;
  const CeldSettings *settings;
  Vector              light, half; /* unit vectors, of a distant light */
  Vector              place;       /* of a near light, in pixels */
  CeldColours        *tone;
  CeldPlane          *gloss;
} Scene;

/* ------------------------------------------------------------------ position of the light */

static Vector
unit (Vector v)
{
  double length = sqrt (v.x * v.x + v.y * v.y + v.z * v.z);

  return length > 0 ? (Vector) { v.x / length, v.y / length, v.z / length } : (Vector) { 0, 0, 1 };
}

static Vector
halfway (Vector light)
{
  return unit ((Vector) { light.x, light.y, light.z + 1 });
}

static Scene
scene (const CeldVectors *normals, const CeldSettings *s)
{
  double azimuth = (double) s->light_azimuth * CELD_RADIANS, elevation = (double) s->light_elevation * CELD_RADIANS;
  double w = normals->width, h = normals->height;
  Scene  made = { .normals = normals, .settings = s };

  made.light = (Vector) { cos (elevation) * cos (azimuth), cos (elevation) * sin (azimuth), sin (elevation) };
  made.half  = halfway (made.light);
  made.place = (Vector) { (double) s->light_x * w, (double) s->light_y * h, (double) s->light_height * hypot (w, h) };
  return made;
}

static Vector
light_at (const Scene *s, int x, int y)
{
  if (s->settings->light == CELD_LIGHT_DIRECTION)
    return s->light;
  return unit ((Vector) { s->place.x - x - 0.5, y + 0.5 - s->place.y, s->place.z });
}

/* ------------------------------------------------------------------ light on one pixel */

typedef double (*Measure) (const Scene *s, int x, int y);

/* In [0,1]; a NaN normal is unlit. */
static double
lambert (const Scene *s, int x, int y)
{
  const float *n = CELD_XYZ (s->normals, x, y);
  Vector       l = light_at (s, x, y);
  double       lit = (double) n[0] * l.x + (double) n[1] * l.y + (double) n[2] * l.z;

  return lit > 0 ? fmin (lit, 1) : 0;
}

static double
highlight (const Scene *s, int x, int y)
{
  const float *n = CELD_XYZ (s->normals, x, y);
  Vector       h = s->settings->light == CELD_LIGHT_DIRECTION ? s->half : halfway (light_at (s, x, y));
  double       lit = (double) n[0] * h.x + (double) n[1] * h.y + (double) n[2] * h.z;

  return lit > 0 && lambert (s, x, y) > 0 ? pow (fmin (lit, 1), (double) s->settings->shininess) : 0;
}

static double
rim (const Scene *s, int x, int y)
{
  double turned = 1 - (double) CELD_XYZ (s->normals, x, y)[2];

  return turned > 0 ? pow (fmin (turned, 1), (double) s->settings->rim_power) : 0;
}

static double
half_lambert (const Scene *s, int x, int y)
{
  const float *n = CELD_XYZ (s->normals, x, y);
  Vector       l = light_at (s, x, y);
  double       lit = 0.5 + 0.5 * ((double) n[0] * l.x + (double) n[1] * l.y + (double) n[2] * l.z);

  return lit > 0 ? fmin (lit * lit, 1) : 0;
}

/* ------------------------------------------------------------------ toon steps */

/* The smaller of the changes to the two neighbours along (dx,dy): on one side there may be another surface. */
static double
change_along (const Scene *s, Measure measure, double here, int x, int y, int dx, int dy)
{
  int    w = s->normals->width, h = s->normals->height;
  bool   back = x - dx >= 0 && y - dy >= 0, on = x + dx < w && y + dy < h;
  double before = back ? fabs (here - measure (s, x - dx, y - dy)) : INFINITY;
  double after = on ? fabs (here - measure (s, x + dx, y + dy)) : INFINITY;

  return back || on ? fmin (before, after) : 0;
}

/* `measure` quantised to so many steps from 0 to 1, with edges as wide as a pixel. */
static double
bands (const Scene *s, Measure measure, int steps, int x, int y)
{
  double here = measure (s, x, y), sum = 0;
  double change = hypot (change_along (s, measure, here, x, y, 1, 0), change_along (s, measure, here, x, y, 0, 1));

  for (int k = 1; k < steps; k++)
    sum += fmax (0, fmin (1, (here - (double) k / steps) / fmax (change, STEEP) + 0.5));
  return sum / (steps - 1);
}

static double
lit_at (const Scene *s, int x, int y)
{
  switch (s->settings->light_model)
    {
    case CELD_MODEL_HALF_LAMBERT: return half_lambert (s, x, y);
    case CELD_MODEL_TOON:         return bands (s, lambert, s->settings->toon_steps, x, y);
    default:                        return lambert (s, x, y);
    }
}

static double
gloss_at (const Scene *s, int x, int y)
{
  bool   toon = s->settings->light_model == CELD_MODEL_TOON;
  double sum = 0;

  if (s->settings->specular > 0)
    sum += (double) s->settings->specular * (toon ? bands (s, highlight, 2, x, y) : highlight (s, x, y));
  if (s->settings->rim_light > 0)
    sum += (double) s->settings->rim_light * (toon ? bands (s, rim, 2, x, y) : rim (s, x, y));
  return fmin (sum, 1);
}

/* ------------------------------------------------------------------ matcap */

/* Bilinear interpolation, weighted by alpha; black where all is transparent. */
static void
sample (const CeldColours *picture, double u, double v, float rgb[3])
{
  double x = fmax (0, fmin (u * picture->width - 0.5, picture->width - 1));
  double y = fmax (0, fmin (v * picture->height - 0.5, picture->height - 1));
  int    left = (int) x, top = (int) y;
  double sum = 0, colour[3] = { 0, 0, 0 };

  for (int k = 0; k < 4; k++)
    {
      int          px = left + (k & 1 && left + 1 < picture->width), py = top + (k & 2 && top + 1 < picture->height);
      const float *rgba = CELD_RGBA (picture, px, py);
      double       weight = (k & 1 ? x - left : 1 - x + left) * (k & 2 ? y - top : 1 - y + top) * (double) rgba[3];

      if (!(weight > 0))
        continue;
      sum += weight;
      for (int c = 0; c < 3; c++)
        colour[c] += weight * (double) rgba[c];
    }
  for (int c = 0; c < 3; c++)
    rgb[c] = sum > 0 ? (float) (colour[c] / sum) : 0;
}

/* A NaN normal counts as facing the viewer. */
static void
matcap_at (const Scene *s, int x, int y, float rgb[3])
{
  const float *n = CELD_XYZ (s->normals, x, y);
  double       nx = n[0] >= -1 && n[0] <= 1 ? (double) n[0] : 0, ny = n[1] >= -1 && n[1] <= 1 ? (double) n[1] : 0;

  sample (s->matcap, 0.5 + 0.5 * nx, 0.5 - 0.5 * ny, rgb);
}

/* ------------------------------------------------------------------ */

/* How much a pixel can shine: ink does not, so that lines stay visible; NaN reads as paper. */
static double
paper_at (const Scene *s, int x, int y)
{
  double ink = s->ink ? (double) CELD_AT (s->ink, x, y) : 1;

  return ink < 1 ? fmax (ink, 0) : 1;
}

static void
light_row (void *data, int y)
{
  const Scene *s = data;
  double       ambient = (double) s->settings->ambient;

  for (int x = 0; x < s->normals->width; x++)
    {
      float *tone = CELD_RGBA (s->tone, x, y);

      if (s->settings->light_model == CELD_MODEL_MATCAP)
        matcap_at (s, x, y, tone);
      else
        tone[0] = tone[1] = tone[2] = (float) (ambient + (1 - ambient) * lit_at (s, x, y));
      tone[3] = 1;
      CELD_AT (s->gloss, x, y) = (float) (paper_at (s, x, y) * gloss_at (s, x, y));
    }
}

CeldStatus
celd_light (const CeldVectors *normals, const CeldPlane *ink, const CeldColours *matcap, const CeldSettings *settings,
            const CeldHost *host, CeldColours *tone, CeldPlane *gloss)
{
  if (!CELD_SAME_SIZE (normals, tone) || !CELD_SAME_SIZE (normals, gloss) || (ink && !CELD_SAME_SIZE (normals, ink)))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;
  if (settings->light_model == CELD_MODEL_MATCAP && (!matcap || !CELD_SAME_SIZE (matcap, matcap)))
    return CELD_BAD_VALUE;

  Scene s = scene (normals, settings);

  s.ink    = ink;
  s.matcap = matcap;
  s.tone   = tone;
  s.gloss  = gloss;
  celd_parallel_for (host, normals->height, light_row, &s);
  return CELD_OK;
}

/* Replaces each colour c by  (1 - g) c t + g  with tone t and gloss g. */
CeldStatus
celd_light_colours (const CeldColours *tone, const CeldPlane *gloss, CeldColours *colours)
{
  if (!CELD_SAME_SIZE (tone, colours) || !CELD_SAME_SIZE (gloss, colours))
    return CELD_BAD_SIZE;
  for (int y = 0; y < colours->height; y++)
    for (int x = 0; x < colours->width; x++)
      {
        float        g = CELD_AT (gloss, x, y), *rgba = CELD_RGBA (colours, x, y);
        const float *t = CELD_RGBA (tone, x, y);

        for (int c = 0; c < 3; c++)
          rgba[c] = (1 - g) * rgba[c] * t[c] + g;
      }
  return CELD_OK;
}

CeldStatus
celd_light_layer (const CeldPlane *gloss, CeldColours *layer)
{
  if (!CELD_SAME_SIZE (gloss, layer))
    return CELD_BAD_SIZE;
  for (int y = 0; y < layer->height; y++)
    for (int x = 0; x < layer->width; x++)
      {
        float *rgba = CELD_RGBA (layer, x, y);

        rgba[0] = rgba[1] = rgba[2] = 1;
        rgba[3] = CELD_AT (gloss, x, y);
      }
  return CELD_OK;
}

CeldStatus
celd_shade (const CeldVectors *normals, const CeldSettings *settings, CeldPlane *shading)
{
  if (!CELD_SAME_SIZE (normals, shading))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK || settings->light_model == CELD_MODEL_MATCAP)
    return CELD_BAD_VALUE;

  Scene  s = scene (normals, settings);
  double ambient = (double) settings->ambient;

  for (int y = 0; y < shading->height; y++)
    for (int x = 0; x < shading->width; x++)
      {
        double gloss = gloss_at (&s, x, y);

        CELD_AT (shading, x, y) = (float) ((1 - gloss) * (ambient + (1 - ambient) * lit_at (&s, x, y)) + gloss);
      }
  return CELD_OK;
}
