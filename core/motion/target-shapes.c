/* The closed shapes of a drawing, with their sizes, and the distances of all pixels to ink.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/rigid-parts.h"
#include "image/image.h"

#include <math.h>

#define LEAST_SHAPE 6 /* pixels of paper; chosen */

/* ------------------------------------------------------------------ shapes */

static uint32_t
largest (const CeldLabels *labels)
{
  uint32_t most = 0;

  for (size_t i = 0; i < (size_t) labels->width * (size_t) labels->height; i++)
    most = labels->data[i] > most ? labels->data[i] : most;
  return most;
}

/* Counts pixels, and renumbers the shapes that have enough; number[k] of shape k is 0 for the others. */
static void
number_shapes (const CeldLabels *shape, const CeldLabels *component, uint32_t most, uint32_t *number,
               CeldTargetShapes *target)
{
  size_t n = (size_t) shape->width * (size_t) shape->height;

  for (size_t i = 0; i < n; i++)
    number[shape->data[i]]++;
  number[0] = 0;
  for (uint32_t k = 1; k <= most; k++)
    {
      uint32_t pixels = number[k];

      number[k] = pixels < LEAST_SHAPE ? 0 : (uint32_t) ++target->n;
      if (number[k])
        target->size[number[k]] = pixels;
    }
  for (size_t i = 0; i < n; i++)
    {
      int x = (int) (i % (size_t) shape->width), y = (int) (i / (size_t) shape->width);

      shape->data[i] = number[shape->data[i]];
      if (shape->data[i])
        target->component[shape->data[i]] = component->data[i];
      if (component->data[i])
        target->page[component->data[i]] |= !x || !y || x == shape->width - 1 || y == shape->height - 1;
    }
}

static CeldStatus
find_shapes (const CeldPlane *ink, const CeldHost *host, CeldTargetShapes *target)
{
  CeldSettings settings = celd_settings ();
  CeldLabels   shape = { 0 }, component = { 0 };
  uint32_t    *number = NULL, most;
  CeldStatus   status = celd_labels_new (ink->width, ink->height, &shape);

  if (status == CELD_OK)
    status = celd_labels_new (ink->width, ink->height, &component);
  if (status == CELD_OK)
    status = celd_closed_shapes (ink, (float) settings.ink_threshold, host, &shape, &component);
  target->shape = shape.data;
  if (status == CELD_OK)
    {
      most                 = largest (&shape);
      target->n_components = largest (&component);
      target->size         = celd_alloc0 (most + 1, sizeof *target->size);
      target->component    = celd_alloc0 (most + 1, sizeof *target->component);
      target->page         = celd_alloc0 (target->n_components + 1, sizeof *target->page);
      number               = celd_alloc0 (most + 1, sizeof *number);
      if (number && target->size && target->component && target->page)
        number_shapes (&shape, &component, most, number, target);
      else
        status = CELD_NO_MEMORY;
    }
  celd_free (component.data);
  celd_free (number);
  return status;
}

/* ------------------------------------------------------------------ distances */

/* Distances to ink; the diagonal where there is no ink. */
static CeldStatus
measure_distance (const CeldPlane *ink, const CeldHost *host, CeldTargetShapes *target)
{
  size_t     n = (size_t) ink->width * (size_t) ink->height;
  int32_t   *squared = celd_alloc (n, sizeof *squared);
  float      most = hypotf ((float) ink->width, (float) ink->height);
  CeldStatus status = CELD_NO_MEMORY;

  target->distance = celd_alloc (n, sizeof *target->distance);
  if (squared && target->distance)
    status = celd_signed_distance (ink, host, squared);
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    target->distance[i] = squared[i] <= 0 ? 0 : fminf (most, sqrtf ((float) squared[i]));
  celd_free (squared);
  return status;
}

/* ------------------------------------------------------------------ */

CeldStatus
celd_target_shapes_new (const CeldPlane *ink, const CeldHost *host, CeldTargetShapes *target)
{
  CeldHostPart part[2];
  CeldHost     first = celd_host_part (&part[0], host, 0, 0.7), second = celd_host_part (&part[1], host, 0.7, 1);
  CeldStatus   status;

  *target = (CeldTargetShapes) { .width = ink->width, .height = ink->height };
  status  = find_shapes (ink, &first, target);
  return status == CELD_OK ? measure_distance (ink, &second, target) : status;
}

void
celd_target_shapes_clear (CeldTargetShapes *target)
{
  celd_free (target->shape);
  celd_free (target->size);
  celd_free (target->component);
  celd_free (target->page);
  celd_free (target->distance);
  *target = (CeldTargetShapes) { 0 };
}
