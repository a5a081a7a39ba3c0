/* How the surface of one pixel reflects the light (section 5, Figure 1f), in linear light.
 *
 * With n the normal, l the direction to the light, v = (0,0,1) that to the viewer and h halfway between them:
 *   Lambert        max (0, n . l)
 *   half Lambert   (1/2 + 1/2 n . l)^2                  [MFE07]
 *   toon           Lambert in equal steps, with edges one pixel wide
 *   gloss          s max (0, n . h)^e where n . l > 0 [Bli77], and r (1 - n_z)^g along rims; in toon shading both
 *                  are either on or off
 *
 * Art shows surfaces that face the viewer, so they keep its colours: the light is exposed for them.  The tone of a
 * surface is its light divided by that on one that faces the viewer, and highlights are what is brighter than there.
 * Steps of toon shading lie around the light of that surface, so that slight bends do not change its step.
 *
 *   [Bli77]  J. F. Blinn: Models of Light Reflection for Computer Synthesized Pictures.  SIGGRAPH 1977.
 *   [MFE07]  J. Mitchell, M. Francke, D. Eng: Illustrative Rendering in Team Fortress 2.  NPAR 2007.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "light/light.h"

#define STEEP         1e-6 /* change of brightness between pixels that counts as none (chosen) */
#define DIMMEST_STEPS 0.5  /* light of a facing surface below which steps do not get narrower (chosen) */
#define DULLEST       0.1  /* of the light of a highlight, how much it must be brighter than a facing surface to be
                            * as bright as the settings say (chosen) */

/* ------------------------------------------------------------------ position of the light */

static CeldVector
unit (CeldVector v)
{
  double length = sqrt (v.x * v.x + v.y * v.y + v.z * v.z);

  return length > 0 ? (CeldVector) { v.x / length, v.y / length, v.z / length } : (CeldVector) { 0, 0, 1 };
}

static CeldVector
halfway (CeldVector light)
{
  return unit ((CeldVector) { light.x, light.y, light.z + 1 });
}

static CeldLamp
lamp_at_place (const CeldVectors *normals, const CeldSettings *s)
{
  double   azimuth = (double) s->light_azimuth * CELD_RADIANS, elevation = (double) s->light_elevation * CELD_RADIANS;
  double   w = normals->width, h = normals->height;
  CeldLamp lamp = { .normals = normals, .settings = s };

  lamp.light = (CeldVector) { cos (elevation) * cos (azimuth), cos (elevation) * sin (azimuth), sin (elevation) };
  lamp.half  = halfway (lamp.light);
  lamp.place = (CeldVector) { (double) s->light_x * w, (double) s->light_y * h,
                              (double) s->light_height * hypot (w, h) };
  return lamp;
}

static CeldVector
light_at (const CeldLamp *lamp, int x, int y)
{
  if (lamp->settings->light == CELD_LIGHT_DIRECTION)
    return lamp->light;
  return unit ((CeldVector) { lamp->place.x - x - 0.5, y + 0.5 - lamp->place.y, lamp->place.z });
}

static CeldVector
half_at (const CeldLamp *lamp, int x, int y)
{
  return lamp->settings->light == CELD_LIGHT_DIRECTION ? lamp->half : halfway (light_at (lamp, x, y));
}

/* ------------------------------------------------------------------ light on one pixel */

/* The normal of what faces the viewer. */
static const float facing[3] = { 0, 0, 1 };

static double
along (const float *normal, CeldVector v)
{
  return (double) normal[0] * v.x + (double) normal[1] * v.y + (double) normal[2] * v.z;
}

/* In [0,1]; a NaN normal is unlit. */
static double
lambert (const CeldLamp *lamp, const float *normal, int x, int y)
{
  double lit = along (normal, light_at (lamp, x, y));

  return lit > 0 ? fmin (lit, 1) : 0;
}

static double
half_lambert (const CeldLamp *lamp, const float *normal, int x, int y)
{
  double lit = 0.5 + 0.5 * along (normal, light_at (lamp, x, y));

  return lit > 0 ? fmin (lit * lit, 1) : 0;
}

static double
mirrored (const CeldLamp *lamp, const float *normal, int x, int y)
{
  double lit = along (normal, half_at (lamp, x, y));

  return lit > 0 && lambert (lamp, normal, x, y) > 0 ? pow (fmin (lit, 1), (double) lamp->settings->shininess) : 0;
}

/* 0 on a surface that faces the viewer, at most 1. */
static double
highlight (const CeldLamp *lamp, const float *normal, int x, int y)
{
  double dull = lamp->settings->light == CELD_LIGHT_DIRECTION ? lamp->dull : mirrored (lamp, facing, x, y);

  return fmax (0, mirrored (lamp, normal, x, y) - dull) / fmax (1 - dull, DULLEST);
}

static double
rim (const CeldLamp *lamp, const float *normal, int x, int y)
{
  double turned = 1 - (double) normal[2];

  (void) x, (void) y;
  return turned > 0 ? pow (fmin (turned, 1), (double) lamp->settings->rim_power) : 0;
}

/* ------------------------------------------------------------------ toon steps */

typedef double (*Measure) (const CeldLamp *lamp, const float *normal, int x, int y);

static double
measure_at (const CeldLamp *lamp, Measure measure, int x, int y)
{
  return measure (lamp, CELD_XYZ (lamp->normals, x, y), x, y);
}

/* The smaller of the changes to the two neighbours along (dx,dy): on one side there may be another surface. */
static double
change_along (const CeldLamp *lamp, Measure measure, double here, int x, int y, int dx, int dy)
{
  int    w = lamp->normals->width, h = lamp->normals->height;
  bool   back = x - dx >= 0 && y - dy >= 0, on = x + dx < w && y + dy < h;
  double before = back ? fabs (here - measure_at (lamp, measure, x - dx, y - dy)) : INFINITY;
  double after = on ? fabs (here - measure_at (lamp, measure, x + dx, y + dy)) : INFINITY;

  return back || on ? fmin (before, after) : 0;
}

static double
change_at (const CeldLamp *lamp, Measure measure, double here, int x, int y)
{
  return hypot (change_along (lamp, measure, here, x, y, 1, 0), change_along (lamp, measure, here, x, y, 0, 1));
}

/* Rises from 0 to 1 where `value` passes `edge`, over the width of a pixel. */
static double
soft_step (double value, double edge, double change)
{
  return fmax (0, fmin (1, (value - edge) / fmax (change, STEEP) + 0.5));
}

/* The light in equal steps, one of which is the light of a facing surface; so many of them, with that one, from there
 * down to darkness. */
static double
step_of (const CeldLamp *lamp, const float *normal, int x, int y)
{
  double here = lambert (lamp, normal, x, y), base = lambert (lamp, facing, x, y);
  double height = fmax (base, DIMMEST_STEPS) / (lamp->settings->toon_steps - 1), sum = 0;
  double change = fmin (change_at (lamp, lambert, here, x, y), height); /* else it could reach a facing surface */

  for (double edge = height / 2; edge < 1; edge += height)
    sum += soft_step (here - base, edge, change) - soft_step (base - here, edge, change);
  return fmax (0, fmin (1, base + height * sum));
}

/* Either 0 or 1. */
static double
shine_of (const CeldLamp *lamp, Measure measure, const float *normal, int x, int y)
{
  double here = measure (lamp, normal, x, y);

  if (lamp->settings->light_model != CELD_MODEL_TOON)
    return here;
  return soft_step (here, 0.5, fmin (change_at (lamp, measure, here, x, y), 1));
}

/* ------------------------------------------------------------------ */

static double
light_on (const CeldLamp *lamp, const float *normal, int x, int y)
{
  double ambient = (double) lamp->settings->ambient, lit;

  switch (lamp->settings->light_model)
    {
    case CELD_MODEL_HALF_LAMBERT: lit = half_lambert (lamp, normal, x, y); break;
    case CELD_MODEL_TOON:         lit = step_of (lamp, normal, x, y); break;
    default:                        lit = lambert (lamp, normal, x, y);
    }
  return ambient + (1 - ambient) * lit;
}

CeldLamp
celd_lamp (const CeldVectors *normals, const CeldSettings *settings)
{
  CeldLamp lamp = lamp_at_place (normals, settings);

  if (settings->light == CELD_LIGHT_DIRECTION)
    {
      lamp.dull = mirrored (&lamp, facing, 0, 0);
      lamp.base = light_on (&lamp, facing, 0, 0);
    }
  return lamp;
}

double
celd_light_at (const CeldLamp *lamp, int x, int y)
{
  return light_on (lamp, CELD_XYZ (lamp->normals, x, y), x, y);
}

/* What is added where the facing surface is dim keeps the quotient at or below CELD_MOST_TONE. */
double
celd_tone_at (const CeldLamp *lamp, int x, int y)
{
  bool   distant = lamp->settings->light == CELD_LIGHT_DIRECTION;
  double base = distant ? lamp->base : light_on (lamp, facing, x, y);
  double added = fmax (0, (1 - CELD_MOST_TONE * base) / (CELD_MOST_TONE - 1));

  return (celd_light_at (lamp, x, y) + added) / (base + added);
}

double
celd_gloss_at (const CeldLamp *lamp, int x, int y)
{
  const CeldSettings *s = lamp->settings;
  const float        *normal = CELD_XYZ (lamp->normals, x, y);
  double              sum = 0;

  if (s->specular > 0)
    sum += (double) s->specular * shine_of (lamp, highlight, normal, x, y);
  if (s->rim_light > 0)
    sum += (double) s->rim_light * shine_of (lamp, rim, normal, x, y);
  return fmin (sum, 1);
}
