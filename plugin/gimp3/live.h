/* Live: what its files share.
 *
 *   live.c            the procedure: the window, and a tick that ties all of it together
 *   live-follow.c     reads the layers again and again, and notices what has changed
 *   live-view.c       shows pictures, and the place of a message
 *   live-turn.c       the relief that turns
 *   live-messages.c   the list of messages below it
 *   live-write.c      writes pictures into the group of results, without steps of undo
 *   live-send.c       the procedure that brings their pixels into a layer, in another process
 *
 * What takes time is done by the thread of live-solver.h.  GIMP is called in the main thread alone.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_GIMP3_LIVE_H
#define CELD_GIMP3_LIVE_H

#include <libgimp/gimpui.h>

#include "gimp3.h"
#include "live-solver.h"

/* ------------------------------------------------------------------ live-follow.c */

typedef struct CeldLiveFollower CeldLiveFollower;

typedef enum
{
  CELD_LIVE_SAME,
  CELD_LIVE_CHANGED,
  CELD_LIVE_REFUSED,      /* nothing can be made of the image as it is */
  CELD_LIVE_CLOSED        /* there is no image any more */
} CeldLiveNews;

CeldLiveFollower *celd_live_follower_new  (GimpImage *image, GimpProcedureConfig *config); /* both borrowed */
void              celd_live_follower_free (CeldLiveFollower *follower);

/* Looks at the image.  Layers that are selected are read every time, others in turn; names of layers, settings and
 * paths, several times a second at most.  *error, a sentence for the artist, is set if it is refused.  *looked: whether
 * names were looked at. */
CeldLiveNews celd_live_follow (CeldLiveFollower *follower, gboolean *looked, GError **error);

/* The layers and settings as they were read last, to be freed; nothing is wanted yet. */
CeldLiveRequest *celd_live_follower_request (const CeldLiveFollower *follower);

/* Where copies of layers belong: an image without a display that nobody else knows.  Borrowed; NULL: none yet. */
GimpImage *celd_live_follower_image (const CeldLiveFollower *follower);

/* The strokes of paths that are no arrows. */
int celd_live_follower_left_out (const CeldLiveFollower *follower);

/* ------------------------------------------------------------------ live-view.c */

#define CELD_LIVE_MOST_SHOWN 2

/* The pictures of a view, CeldPicture or CELD_LIVE_..., side by side, or one at a time. */
typedef struct { const char *label; int n, picture[CELD_LIVE_MOST_SHOWN]; gboolean in_turn; } CeldLivePictures;

typedef struct CeldLiveView CeldLiveView;

CeldLiveView *celd_live_view_new    (void);  /* freed with its widget */
GtkWidget    *celd_live_view_widget (CeldLiveView *view);

/* Lets move what moves by itself, or rest while nobody sees it; to be called at each tick. */
void celd_live_view_tick (CeldLiveView *view);

/* The size in which the relief of an image is seen; 0: it has not been chosen, or nobody sees it. */
void celd_live_view_relief_size (const CeldLiveView *view, int image_width, int image_height, int *width, int *height);

/* Shows other pictures, as soon as the first of them is there. */
void celd_live_view_choose (CeldLiveView *view, const CeldLivePictures *pictures);

/* Takes the pixels of an answer; those of pictures that are not chosen are dropped, but regions while there is nothing
 * else. */
void celd_live_view_put (CeldLiveView *view, CeldLiveAnswer *answer);

/* Marks a place of the image; x < 0: none. */
void celd_live_view_mark (CeldLiveView *view, int x, int y);

/* ------------------------------------------------------------------ live-turn.c */

typedef struct CeldLiveTurn CeldLiveTurn;

CeldLiveTurn *celd_live_turn_new  (GtkWidget *area); /* where the mouse turns it */
void          celd_live_turn_free (CeldLiveTurn *turn);

/* Takes one of its CELD_LIVE_FRAMES pictures; or forgets all of them. */
void celd_live_turn_put   (CeldLiveTurn *turn, int frame, cairo_surface_t *surface);
void celd_live_turn_clear (CeldLiveTurn *turn);

/* Turns on by one picture, unless it is being dragged. */
void celd_live_turn_step (CeldLiveTurn *turn);

/* The picture that is to be seen, or the nearest one that has come; borrowed.  NULL: there is none. */
cairo_surface_t *celd_live_turn_surface (const CeldLiveTurn *turn);

/* ------------------------------------------------------------------ live-messages.c */

typedef struct CeldLiveMessages CeldLiveMessages;

/* `view` gets the place of the message that is selected. */
CeldLiveMessages *celd_live_messages_new    (CeldLiveView *view);  /* freed with its widget */
GtkWidget        *celd_live_messages_widget (CeldLiveMessages *messages);

/* Replaces the list by problems (NULL: none); the one that is selected stays so if it is among them.  Without any the
 * list hides. */
void celd_live_messages_set (CeldLiveMessages *messages, const GArray *problems);

/* ------------------------------------------------------------------ live-write.c */

/* The format of the layer of a picture that can be written to, NULL: there is none. */
const Babl *celd_live_write_format (GimpImage *image, CeldPicture picture);

/* The format for the layer of a picture that is still to be made. */
const Babl *celd_live_write_new_format (GimpImage *image, CeldPicture picture);

/* The image that is written to, where copies of its layers belong, and the procedure that brings pixels into one. */
typedef struct { GimpImage *image, *own; const char *sender; } CeldLiveTarget;

/* Writes a picture into its layer where that differs, without a step of undo; if there is none, the group or the layer
 * is made, with one step, if `make` says so.  A layer whose pixels are locked stays as it is. */
void celd_live_write (const CeldLiveTarget *target, CeldPicture picture, GeglBuffer *buffer, gboolean make);

#endif
