/* Solves in a thread of its own while an artist paints: requests in, pictures out, as soon as each is made.
 *
 * A request is a snapshot of all layers; only what differs from the one before is read and made again.  The newest
 * request counts: those that have come in between are left out, and what is being made for an older one is given up
 * after its regions, but never two times in a row, so that pictures also appear while the layers change all the time.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LIVE_SOLVER_H
#define CELD_LIVE_SOLVER_H

#include "pipeline.h"

/* Beside the pictures of the pipeline: both views, arranged as settings.stereo says; each of them; and the relief, of
 * which there are CELD_LIVE_FRAMES pictures. */
enum { CELD_LIVE_STEREO = CELD_N_PICTURES, CELD_LIVE_LEFT, CELD_LIVE_RIGHT, CELD_LIVE_RELIEF, CELD_LIVE_N_PICTURES };

/* Of the relief, from one side to the other.  The one in the middle is made first, then every 16th, 8th and so on. */
#define CELD_LIVE_FRAMES 33
#define CELD_LIVE_MIDDLE (CELD_LIVE_FRAMES / 2)

/* Owns its buffers, which must not change any more, and its texts. */
typedef struct
{
  CeldPipelineInput input;
  guint             shown;                      /* pictures to be shown, as bits */
  int               relief_width, relief_height; /* of its pictures, not larger than the image */
  const Babl       *format[CELD_N_PICTURES];    /* formats of pictures that are wanted as buffers, too; else NULL */
} CeldLiveRequest;

CeldLiveRequest *celd_live_request_new  (void);
CeldLiveRequest *celd_live_request_copy (const CeldLiveRequest *request); /* with the same buffers */
void             celd_live_request_free (CeldLiveRequest *request);       /* accepts NULL */

/* A part of the answer to a request; owns what it points to. */
typedef struct
{
  int         picture;           /* that the pixels or the buffer are of */
  guint8     *pixels;            /* "cairo-ARGB32", without gaps between rows; NULL: none */
  int         width, height;     /* of the pixels */
  double      scale;             /* each is so many pixels of the image wide: more than 1 in a preview */
  int         frame;             /* of the relief: which of its pictures */
  GeglBuffer *buffer;            /* NULL: none */
  GArray     *problems;          /* CeldPipelineProblem; NULL: they are not known yet */
  char       *error;             /* why there is no more, a sentence for the artist; NULL: nothing failed */
  gboolean    last;              /* of its request, and there is no newer one */
} CeldLiveAnswer;

/* Is called in the main thread; may take pixels, buffer and problems, and set them to NULL. */
typedef void (*CeldLiveAnswered) (CeldLiveAnswer *answer, gpointer data);

typedef struct CeldLiveSolver CeldLiveSolver;

CeldLiveSolver *celd_live_solver_new  (CeldLiveAnswered answered, gpointer data);
void            celd_live_solver_ask  (CeldLiveSolver *solver, CeldLiveRequest *request); /* takes the request */
void            celd_live_solver_free (CeldLiveSolver *solver);                           /* waits for the thread */

#endif
