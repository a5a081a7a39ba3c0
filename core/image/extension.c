/* Extends values from some pixels of a picture smoothly over all others, by a pyramid: each level has the means of
 * 2 x 2 pixels of the one below that are known, and unknown pixels are interpolated from the level above [GGS96], then
 * smoothed towards Laplace's equation.  Linear time, and one colour stays exactly that colour.
 *
 *   [GGS96]  S. J. Gortler, R. Grzeszczuk, R. Szeliski, M. F. Cohen: The Lumigraph.  SIGGRAPH 1996, section 3.4.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#define MOST_LANES 4
#define SWEEPS     4 /* chosen: a ramp goes on as a ramp to within two hundredths of its range */

/* One level; known[] has 0 for unknown pixels. */
typedef struct { int width, height; uint8_t *known; float *value; } Level;

/* The pixel above: the mean of those of its four pixels that are known, as the first of them and a difference, so that
 * equal values keep every bit. */
static void
reduce (const Level *fine, int lanes, Level *coarse)
{
  for (int y = 0; y < coarse->height; y++)
    for (int x = 0; x < coarse->width; x++)
      {
        float        sum[MOST_LANES] = { 0 };
        const float *first = NULL;
        size_t       to = (size_t) y * (size_t) coarse->width + (size_t) x;
        int          n = 0;

        for (int k = 0; k < 4; k++)
          {
            int    u = 2 * x + (k & 1), v = 2 * y + (k >> 1);
            size_t from = (size_t) v * (size_t) fine->width + (size_t) u;

            if (u >= fine->width || v >= fine->height || !fine->known[from])
              continue;
            n++;
            first = first ? first : fine->value + from * (size_t) lanes;
            for (int c = 0; c < lanes; c++)
              sum[c] += fine->value[from * (size_t) lanes + (size_t) c] - first[c];
          }
        coarse->known[to] = n > 0;
        for (int c = 0; c < lanes && n; c++)
          coarse->value[to * (size_t) lanes + (size_t) c] = first[c] + sum[c] / (float) n;
      }
}

/* Bilinear interpolation: a fine pixel lies a quarter of a coarse one off that one's middle. */
static void
interpolate (const Level *coarse, int lanes, Level *fine)
{
  for (int y = 0; y < fine->height; y++)
    for (int x = 0; x < fine->width; x++)
      {
        size_t to = (size_t) y * (size_t) fine->width + (size_t) x;
        int    u = x / 2, v = y / 2, nu = u + (x % 2 ? 1 : -1), nv = v + (y % 2 ? 1 : -1);
        size_t at[4];

        if (fine->known[to])
          continue;
        nu = nu < 0 || nu >= coarse->width ? u : nu;
        nv = nv < 0 || nv >= coarse->height ? v : nv;
        at[0] = (size_t) v * (size_t) coarse->width + (size_t) u;
        at[1] = (size_t) v * (size_t) coarse->width + (size_t) nu;
        at[2] = (size_t) nv * (size_t) coarse->width + (size_t) u;
        at[3] = (size_t) nv * (size_t) coarse->width + (size_t) nu;
        for (size_t c = 0; c < (size_t) lanes; c++)
          {
            const float *value = coarse->value + c;
            size_t       n = (size_t) lanes;
            float        near = value[at[0] * n], across = value[at[1] * n], down = value[at[2] * n];

            fine->value[to * n + c] = near + 0.25f * ((across - near) + (down - near))
                                    + 0.0625f * ((near - across) + (value[at[3] * n] - down));
          }
      }
}

/* Some sweeps of Gauss and Seidel over the unknown pixels, towards the mean of their neighbours. */
static void
relax (int lanes, const Level *level)
{
  size_t w = (size_t) level->width, n = (size_t) lanes;

  for (int sweep = 0; sweep < SWEEPS; sweep++)
    for (int y = 0; y < level->height; y++)
      for (int x = 0; x < level->width; x++)
        {
          size_t p = (size_t) y * w + (size_t) x, left = x ? p - 1 : p, right = x + 1 < level->width ? p + 1 : p;
          size_t up = y ? p - w : p, down = y + 1 < level->height ? p + w : p;

          for (size_t c = 0; c < n && !level->known[p]; c++)
            level->value[p * n + c] = 0.25f * ((level->value[left * n + c] + level->value[right * n + c])
                                               + (level->value[up * n + c] + level->value[down * n + c]));
        }
}

static CeldStatus
new_level (const Level *fine, int lanes, Level *coarse)
{
  size_t n;

  *coarse = (Level) { (fine->width + 1) / 2, (fine->height + 1) / 2, NULL, NULL };
  n = (size_t) coarse->width * (size_t) coarse->height;
  coarse->known = celd_alloc (n, 1);
  coarse->value = celd_alloc0 (n * (size_t) lanes, sizeof *coarse->value);
  return coarse->known && coarse->value ? CELD_OK : CELD_NO_MEMORY;
}

CeldStatus
celd_extend (int width, int height, int lanes, uint8_t *known, float *value)
{
  Level      level[32] = { { width, height, known, value } };
  int        top = 0;
  CeldStatus status = CELD_OK;

  while ((level[top].width > 1 || level[top].height > 1) && status == CELD_OK)
    {
      status = new_level (&level[top], lanes, &level[top + 1]);
      top++;
      if (status == CELD_OK)
        reduce (&level[top - 1], lanes, &level[top]);
    }
  for (int c = 0; c < lanes && status == CELD_OK && !*level[top].known; c++)
    level[top].value[c] = 0;
  for (int k = top; k > 0; k--)
    {
      if (status == CELD_OK)
        {
          interpolate (&level[k], lanes, &level[k - 1]);
          relax (lanes, &level[k - 1]);
        }
      celd_free (level[k].known);
      celd_free (level[k].value);
    }
  return status;
}
