/* Pictures of discs in front of each other, and their normals, for the tests of Lumo.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef DISCS_H
#define DISCS_H

#include "check.h"
#include "base/base.h"

/* Paper with discs of level 1, 2, ... drawn over it one after the other, each in its contour of `width` pixels. */
typedef struct { double x, y, radius; } Disc;

typedef struct { CeldPlane ink, levels; CeldVectors normals; } Picture;

static inline Picture
picture (int w, int h)
{
  size_t  n = (size_t) w * (size_t) h;
  Picture p = { { w, h, (size_t) w, malloc (n * sizeof (float)) }, { w, h, (size_t) w, calloc (n, sizeof (float)) },
                { w, h, (size_t) w, calloc (n, 3 * sizeof (float)) } };

  for (size_t i = 0; i < n; i++)
    p.ink.data[i] = 1;
  return p;
}

static inline void
picture_free (Picture *p)
{
  free (p->ink.data);
  free (p->levels.data);
  free (p->normals.data);
}

/* The contour lies inside the radius, and belongs to the disc. */
static inline void
put_disc (Picture *p, Disc d, double width, float level)
{
  for (int y = 0; y < p->ink.height; y++)
    for (int x = 0; x < p->ink.width; x++)
      {
        double r = hypot (x + 0.5 - d.x, y + 0.5 - d.y) - d.radius;
        size_t i = (size_t) y * p->ink.stride + (size_t) x;

        if (r < 0)
          {
            p->levels.data[i] = level;
            p->ink.data[i]    = (float) fmin (1, fmax (0, -r - width));
          }
        else if (r < 1)
          p->ink.data[i] = fminf (p->ink.data[i], (float) r);
      }
}

static inline void
make (Picture *p, float bulge)
{
  CeldSettings settings = celd_settings ();

  settings.bulge = bulge;
  CHECK (celd_normals (&p->ink, &p->levels, &settings, NULL, &p->normals) == CELD_OK);
}

/* Angle in degrees between the normal of a pixel and (x,y,z). */
static inline double
angle (const Picture *p, int px, int py, double x, double y, double z)
{
  const float *n = CELD_XYZ (&p->normals, px, py);

  return acos (fmax (-1, fmin (1, (double) n[0] * x + (double) n[1] * y + (double) n[2] * z))) * 57.29577951;
}

/* Mean and largest angle between the normals of a disc and the hemisphere's, up to 1.5 pixels from its edge. */
static inline double
compare_disc (const Picture *p, Disc d, double *largest)
{
  double sum = 0, count = 0;

  *largest = 0;
  for (int y = 0; y < p->ink.height; y++)
    for (int x = 0; x < p->ink.width; x++)
      {
        double u = (x + 0.5 - d.x) / d.radius, v = (d.y - y - 0.5) / d.radius, r = hypot (u, v);

        if (r >= 1)
          continue;

        double error = angle (p, x, y, u, v, sqrt (1 - r * r));

        sum += error;
        count++;
        if ((1 - r) * d.radius > 1.5)
          *largest = fmax (*largest, error);
      }
  return sum / count;
}

#endif
