/* Shading: a factor for art, and gloss on top of it.
 *
 * An antialiased pixel shows paper of one region and ink, which may be another's.  Ink is dark, so that light matters
 * on paper alone: the pixel takes the light on the paper beside it.  Hence no pixel of an outline becomes brighter than
 * what is beside it.  The background, the paper that figures are drawn on, takes no light.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "light/light.h"

typedef struct { double tone[3], gloss; } Light;

typedef struct
{
  CeldLamp         lamp;
  const CeldPlane *ink;         /* NULL: none */
  const CeldPlane *levels;      /* NULL: none */
  bool             unlit;       /* whether there is a background that takes no light */
  float            background;  /* its level */
  CeldColours     *tone;
  CeldPlane       *gloss;
} Scene;

/* ------------------------------------------------------------------ the background */

/* The background is the farthest of several levels, if it has half of the frame or more. */
static void
find_background (Scene *s)
{
  const CeldPlane *l = s->levels;
  float            nearest;
  int              count = 0;

  celd_level_range (l, &s->background, &nearest);
  for (int x = 0; x < l->width; x++)
    count += (celd_level_at (l, x, 0) <= s->background) + (celd_level_at (l, x, l->height - 1) <= s->background);
  for (int y = 0; y < l->height; y++)
    count += (celd_level_at (l, 0, y) <= s->background) + (celd_level_at (l, l->width - 1, y) <= s->background);
  s->unlit = s->background < nearest && count >= l->width + l->height;
}

/* ------------------------------------------------------------------ light on one pixel */

/* How much of a pixel is paper; NaN reads as paper. */
static double
paper_at (const Scene *s, int x, int y)
{
  double ink = s->ink ? (double) CELD_AT (s->ink, x, y) : 1;

  return ink < 1 ? fmax (ink, 0) : 1;
}

/* The light on the surface whose normal the pixel has. */
static Light
light_at (const Scene *s, int x, int y)
{
  Light light = { { 1, 1, 1 }, 0 };

  if (s->unlit && celd_level_at (s->levels, x, y) <= s->background)
    return light;
  if (s->lamp.settings->light_model == CELD_MODEL_MATCAP)
    celd_matcap_at (&s->lamp, x, y, light.tone, &light.gloss);
  else
    light.tone[0] = light.tone[1] = light.tone[2] = celd_tone_at (&s->lamp, x, y);
  light.gloss = fmin (1, light.gloss + celd_gloss_at (&s->lamp, x, y));
  return light;
}

/* The level of the brightest of the 3 x 3 pixels round (x,y); ties: the first in reading order, but (x,y) itself before
 * all others. */
static float
level_of_paper (const Scene *s, int x, int y)
{
  float level = celd_level_at (s->levels, x, y), best = CELD_AT (s->ink, x, y);

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < s->ink->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < s->ink->width; u++)
      if (CELD_AT (s->ink, u, v) > best)
        {
          best  = CELD_AT (s->ink, u, v);
          level = celd_level_at (s->levels, u, v);
        }
  return level;
}

/* The mean light of those of the 3 x 3 pixels round (x,y) that have this level and more paper, weighted by that.  If
 * there are none, as in the tip between two lines, the light on (x,y), without gloss: no paper beside it might be as
 * bright. */
static Light
light_beside (const Scene *s, float level, int x, int y)
{
  Light  mean = { { 0, 0, 0 }, 0 };
  double sum = 0, least = paper_at (s, x, y);

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < s->levels->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < s->levels->width; u++)
      {
        float  there = celd_level_at (s->levels, u, v);
        double weight = paper_at (s, u, v);

        if (there < level || there > level || weight <= least)
          continue;

        Light light = light_at (s, u, v);

        sum += weight;
        for (int c = 0; c < 3; c++)
          mean.tone[c] += weight * light.tone[c];
        mean.gloss += weight * light.gloss;
      }
  if (!(sum > 0))
    {
      mean = light_at (s, x, y);
      mean.gloss = 0;
      return mean;
    }
  for (int c = 0; c < 3; c++)
    mean.tone[c] /= sum;
  mean.gloss /= sum;
  return mean;
}

/* Whether the normal is exactly that of what faces the viewer. */
static bool
faces_viewer (const float *normal)
{
  return !(normal[0] < 0 || normal[0] > 0 || normal[1] < 0 || normal[1] > 0) && normal[2] >= 1;
}

/* Whether any of the 3 x 3 pixels round (x,y) is mostly ink. */
static bool
is_beside_ink (const Scene *s, int x, int y)
{
  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < s->ink->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < s->ink->width; u++)
      if (paper_at (s, u, v) < 0.5)
        return true;
  return false;
}

/* The light on the paper that a pixel shows: if that is mixed with ink, the light beside it, on a farther level if the
 * pixel is mostly ink.  What faces the viewer keeps its colour in any case. */
static Light
light_on_paper (const Scene *s, int x, int y)
{
  double paper = paper_at (s, x, y);
  float  here, level;

  if (!s->levels || !(paper > 0 && paper < 1) || faces_viewer (CELD_XYZ (s->lamp.normals, x, y)) ||
      !is_beside_ink (s, x, y))
    return light_at (s, x, y);
  here  = celd_level_at (s->levels, x, y);
  level = paper < 0.5 ? level_of_paper (s, x, y) : here;
  return light_beside (s, level < here ? level : here, x, y);
}

/* Ink has no gloss, so that lines stay visible. */
static void
light_row (void *data, int y)
{
  const Scene *s = data;

  for (int x = 0; x < s->tone->width; x++)
    {
      Light  light = light_on_paper (s, x, y);
      float *tone = CELD_RGBA (s->tone, x, y);

      for (int c = 0; c < 3; c++)
        tone[c] = (float) light.tone[c];
      tone[3] = 1;
      CELD_AT (s->gloss, x, y) = (float) (paper_at (s, x, y) * light.gloss);
    }
}

/* ------------------------------------------------------------------ */

CeldStatus
celd_light (const CeldVectors *normals, const CeldPlane *ink, const CeldPlane *levels, const CeldColours *matcap,
            const CeldSettings *settings, const CeldHost *host, CeldColours *tone, CeldPlane *gloss)
{
  if (!CELD_SAME_SIZE (normals, tone) || !CELD_SAME_SIZE (normals, gloss) || (ink && !CELD_SAME_SIZE (normals, ink)) ||
      (levels && !CELD_SAME_SIZE (normals, levels)))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;
  if (settings->light_model == CELD_MODEL_MATCAP && (!matcap || !CELD_SAME_SIZE (matcap, matcap)))
    return CELD_BAD_VALUE;

  Scene s = { .lamp = celd_lamp (normals, settings), .ink = ink, .levels = levels, .tone = tone, .gloss = gloss };

  s.lamp.matcap = matcap;
  if (levels && !settings->light_background)
    find_background (&s);
  celd_parallel_for (host, normals->height, light_row, &s);
  return CELD_OK;
}

/* With tone t and gloss g each colour c becomes  (1 - g) c t + g,  and where t > 1
 *   (1 - g) (c + (t - 1) c (1 - c)) + g,
 * which is nearly c t of dark colours, and never more than white. */
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
          {
            float room = rgba[c] > 0 && rgba[c] < 1 ? 1 - rgba[c] : rgba[c] < 1;

            rgba[c] = (1 - g) * rgba[c] * (t[c] > 1 ? 1 + (t[c] - 1) * room : t[c]) + g;
          }
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

  CeldLamp lamp = celd_lamp (normals, settings);

  for (int y = 0; y < shading->height; y++)
    for (int x = 0; x < shading->width; x++)
      {
        double gloss = celd_gloss_at (&lamp, x, y);

        CELD_AT (shading, x, y) = (float) ((1 - gloss) * celd_light_at (&lamp, x, y) + gloss);
      }
  return CELD_OK;
}
