/* Grey morphology with square windows, of floats and of bytes: erosion along rows and then along columns (least.h).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <math.h>
#include <string.h>

#define LEAST_VALUE         float
#define LEAST_PLANE         CeldPlane
#define LEAST_BEYOND        INFINITY
#define LEAST_ALONG_ROWS    least_along_rows
#define LEAST_ALONG_COLUMNS least_along_columns
#include "image/least.h"

#define LEAST_VALUE         uint8_t
#define LEAST_PLANE         CeldMask
#define LEAST_BEYOND        UINT8_MAX
#define LEAST_ALONG_ROWS    least_byte_along_rows
#define LEAST_ALONG_COLUMNS least_byte_along_columns
#include "image/least.h"

size_t
celd_erosion_work (int width, int height, int radius)
{
  int longer = width < height ? height : width;

  return 64 * ((size_t) longer + 2 * (size_t) radius);
}

void
celd_erode (CeldPlane *plane, int radius, void *work)
{
  least_along_rows (plane, radius, work);
  least_along_columns (plane, radius, work);
}

void
celd_erode_bytes (CeldMask *mask, int radius, void *work)
{
  least_byte_along_rows (mask, radius, work);
  least_byte_along_columns (mask, radius, work);
}

void
celd_invert_bytes (CeldMask *mask)
{
  size_t   n = (size_t) mask->width * (size_t) mask->height;
  uint8_t *value = mask->data; /* not read anew for each byte, which could have changed it */

  for (size_t i = 0; i < n; i++)
    value[i] = (uint8_t) ~value[i];
}

void
celd_dilate_bytes (CeldMask *mask, int radius, void *work)
{
  celd_invert_bytes (mask);
  celd_erode_bytes (mask, radius, work);
  celd_invert_bytes (mask);
}

void
celd_close_bytes (const CeldMask *mask, int radius, void *work, CeldMask *closed)
{
  memcpy (closed->data, mask->data, (size_t) mask->width * (size_t) mask->height);
  celd_dilate_bytes (closed, radius, work);
  celd_erode_bytes (closed, radius, work);
}
