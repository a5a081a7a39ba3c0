/* Status, progress, threads and pictures.
 *
 * Part of celdepth.h, which states the conventions of values, ownership and errors.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_VALUES_H
#define CELDEPTH_VALUES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined __GNUC__
#define CELD_API __attribute__ ((visibility ("default")))
#else
#define CELD_API
#endif

#define CELD_MAX_SIDE 20000 /* pixels; squared distances within such a picture fit int32_t */

/* ------------------------------------------------------------------ status, progress, threads */

typedef enum
{
  CELD_OK = 0,
  CELD_CANCELLED,         /* CeldHost.progress returned false */
  CELD_NO_MEMORY,         /* an allocation failed, or a size would overflow */
  CELD_BAD_SIZE,          /* a picture is empty, too large, or sizes differ */
  CELD_BAD_VALUE,         /* a setting or another argument is outside its range */
  CELD_BAD_RELATION,      /* relations text or path data cannot be read: see CeldTextError */
  CELD_NOTHING_TO_GO_BY   /* there is neither a scribble nor an arrow */
} CeldStatus;

/* An English sentence for a status, in static storage. */
CELD_API const char *celd_status_text (CeldStatus status);

/* Gives a text of core, which may be a format, in another language, with the same conversions, in storage that stays:
 * the host's gettext.  NULL: texts are in English. */
typedef const char *(*CeldTranslate) (const char *text);

/* What the calling program lends to a long call: progress with a way to cancel, and threads.  Without a CeldHost
 * (NULL), or with NULL members, there are no reports, no cancel, and one thread.  Results do not depend on `each`. */
typedef struct
{
  /* Receives the fraction that is done, in [0,1], which never decreases; returns false to cancel. */
  bool (*progress) (void *data, double done);
  /* Calls body (body_data, i) for i = 0 .. n-1, in any order and on any threads; returns when all calls have. */
  void (*each) (void *data, int n, void (*body) (void *body_data, int i), void *body_data);
  void *data;                                      /* passed to both functions */
} CeldHost;

/* ------------------------------------------------------------------ pictures
 *
 * Views: the caller owns the data.  Pixel (x,y) is element y * stride + x, times the components of a pixel; the stride
 * counts pixels and is at least the width. */

typedef struct { int width, height; size_t stride; float    *data; } CeldPlane;   /* a number per pixel */
typedef struct { int width, height; size_t stride; uint32_t *data; } CeldLabels;  /* a label or level per pixel */
typedef struct { int width, height; size_t stride; uint8_t  *data; } CeldMask;    /* a byte per pixel, 0 = no */
typedef struct { int width, height; size_t stride; uint8_t  *data; } CeldPaint;   /* R'G'B'A of sRGB, straight alpha */
typedef struct { int width, height; size_t stride; float    *data; } CeldVectors; /* x, y, z */
typedef struct { int width, height; size_t stride; float    *data; } CeldShifts;  /* x, y in pixels */
typedef struct { int width, height; size_t stride; float    *data; } CeldColours; /* R, G, B, A, straight alpha */

/* A rectangle of pixels; empty if its width is 0. */
typedef struct { int x, y, width, height; } CeldRect;

/* A drawing: luma, and alpha where it has one (data NULL = opaque).  NaN reads as paper. */
typedef struct { CeldPlane luma, alpha; } CeldDrawing;

/* What ink is for: blue virtual contours count for segmentation only (section 4). */
typedef enum { CELD_FOR_SEGMENTATION, CELD_FOR_DEPTH } CeldPurpose;

#ifdef __cplusplus
}
#endif

#endif
