/* What every function takes: answers, progress, pictures.
 *
 * Part of celdepth.h, which says what values and who owns what.
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

#define CELD_MAX_SIDE 20000 /* squared distances stay exact in int32_t up to here */

/* ------------------------------------------------------------------ answers, progress, threads */

typedef enum
{
  CELD_OK = 0,
  CELD_CANCELLED,         /* CeldHost.progress returned false */
  CELD_NO_MEMORY,         /* an allocation failed, or a size would overflow */
  CELD_BAD_SIZE,          /* a picture is empty, too large, or sizes differ */
  CELD_BAD_VALUE,         /* a setting is outside its range */
  CELD_BAD_RELATION,      /* relations text or path data cannot be read: see CeldTextError */
  CELD_NOTHING_TO_GO_BY   /* neither a scribble nor an arrow */
} CeldStatus;

/* One plain English sentence for a status; static storage. */
CELD_API const char *celd_status_text (CeldStatus status);

/* What the host lends to a long call: progress, a way to cancel, and threads.  NULL instead of a CeldHost, or NULL
 * members: no progress, not to be cancelled, one thread.  Results do not depend on `each`. */
typedef struct
{
  bool (*progress) (void *data, double done);      /* done in [0,1], never falling; false cancels */
  void (*each) (void *data, int n, void (*body) (void *body_data, int i), void *body_data); /* body for 0 .. n-1 in any
                                                                                             * order, all before it returns */
  void *data;                                      /* for the two functions */
} CeldHost;

/* ------------------------------------------------------------------ borrowed pictures; the stride counts pixels */

typedef struct { int width, height; size_t stride; float    *data; } CeldPlane;   /* one float a pixel */
typedef struct { int width, height; size_t stride; uint32_t *data; } CeldLabels;  /* one label or rank a pixel */
typedef struct { int width, height; size_t stride; uint8_t  *data; } CeldMask;    /* one byte a pixel, 0 = no */
typedef struct { int width, height; size_t stride; uint8_t  *data; } CeldPaint;   /* R'G'B'A, straight alpha */
typedef struct { int width, height; size_t stride; float    *data; } CeldVectors; /* x,y,z a pixel */
typedef struct { int width, height; size_t stride; float    *data; } CeldColours; /* R,G,B,A, straight alpha */

typedef struct { int x, y, width, height; } CeldRect;

/* A drawing: luma, and alpha where it has one (data NULL = opaque).  NaN reads as paper. */
typedef struct { CeldPlane luma, alpha; } CeldDrawing;

typedef enum { CELD_FOR_SEGMENTATION, CELD_FOR_DEPTH } CeldPurpose;

#ifdef __cplusplus
}
#endif

#endif
