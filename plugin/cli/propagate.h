/* What the files of celdepth propagate share.
 *
 *   propagate.c   the command: keys, chains of frames, outputs
 *   clip-keys.c   what keys say: palette, relations, order
 *   clip-frame.c  one frame: labels, levels, depth
 *   clip-blend.c  a frame between two keys
 *   clip-notes.c  what a person should know of a frame
 *   clip-doubt.c  regions of a frame that may be wrong
 *   clip-state.c  what is kept of a frame on the disk
 *   review.c      frames that a person should look at
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CLI_PROPAGATE_H
#define CLI_PROPAGATE_H

#include "outputs.h"
#include "sequence.h"

/* ------------------------------------------------------------------ clip-keys.c */

typedef struct
{
  size_t     frame;         /* index in the sequence */
  char      *scribbles, *arrows;
  bool       bare;          /* relations of the options have no meaning in it */
  CeldLabels labels;        /* of the clip's palette */
  CeldPlane  ink;
  char      *fingerprint;   /* of all that its results are made from */
} CliKey;

/* What holds in the whole clip. */
typedef struct
{
  const CliOptions *options;
  CliSequence       frames;
  CliKey           *key;           /* by frames */
  size_t            n_keys;
  CeldPalette       palette;       /* of all keys */
  uint32_t          background;    /* its label; 0: none */
  char             *relations;     /* of all keys, between colours */
  CeldRelations     list;          /* the same, each with the place where a key has it */
  CeldOrder         order;
  int               width, height;
} CliMotion;

/* Reads the keys and makes their labels and the order of the clip.  False with a message. */
bool cli_keys_read (CliMotion *motion, CliRun *run);
void cli_keys_clear (CliMotion *motion);

/* ------------------------------------------------------------------ clip-frame.c */

/* A frame, or a side of one between two keys: what one of these says of it. */
typedef struct
{
  size_t        frame;
  const CliKey *side;            /* that key; NULL: the frame itself */
  CeldPlane     ink;
  CeldLabels    labels;
  CeldPlane     pixel_certainty; /* of celd_propagate; none if the frame was read */
  double        certainty;       /* of this frame, or of an earlier one of the chain if that is less; 1 for a key */
  GArray       *notes;           /* CeldRegionNote */
  double       *sure;            /* of each label, the least since the key, for a review; may be NULL */
  char         *fingerprint;
} CliFrameState;

void  cli_frame_clear (CliFrameState *state);
/* Makes the state of a key, from which a chain begins, for sides of frames or for frames (NULL). */
bool  cli_frame_of_key (const CliMotion *motion, const CliKey *key, const CliKey *side, CliFrameState *state);
/* Carries the labels of a frame to another one, whose ink is given; the caller provides both pictures. */
CeldStatus cli_frame_carry (const CliMotion *motion, const CeldHost *host, const CeldPlane *ink, const CeldLabels *from,
                            const CeldPlane *next, CeldLabels *labels, CeldPlane *certainty);
/* Reads a frame, and makes its ink; false with a message. */
bool  cli_frame_ink (const CliMotion *motion, const CeldHost *host, size_t frame, CeldPlane *ink);
/* Replaces the state of a frame by that of the next one in the chain, from its files if they are what would be made,
 * and else by propagation.  *made says which. */
bool  cli_frame_next (const CliMotion *motion, const CeldHost *host, size_t frame, CliFrameState *state, bool *made);
/* Writes the results of a frame or side, its state last. */
bool  cli_frame_write (const CliMotion *motion, const CeldHost *host, const CliFrameState *state);

/* ------------------------------------------------------------------ clip-blend.c */

/* Makes and writes a frame between a key and the one after it from its two sides, which have been written, unless its
 * files are what would be made. */
bool cli_frame_blend (const CliMotion *motion, const CeldHost *host, size_t frame, const CliKey *key);

/* ------------------------------------------------------------------ clip-notes.c */

GArray *cli_notes_new (void);
/* Notes what of the labels is unsure, vanishes or appears, beside those before, and lowers the certainty.  The state
 * has the frame's ink.  False with a message. */
bool cli_frame_take_notes (const CliMotion *motion, const CeldLabels *before, const CeldLabels *labels,
                           const CeldPlane *certainty, CliFrameState *state);

/* Prints which frames have no lines, if there are such. */
void cli_say_blank (const CliMotion *motion);

/* ------------------------------------------------------------------ clip-state.c */

/* The file of a result of a frame, "labels", "levels", "depth", "state", or of a side of it: "labels", "certainty",
 * "state"; free with g_free. */
char *cli_frame_path (const CliMotion *motion, const char *result, size_t frame, const CliKey *side);
/* Removes what a run that was killed left of a frame or side; no other chain writes there. */
void  cli_frame_remove_unfinished (const CliMotion *motion, size_t frame, const CliKey *side);
/* Notes that the results of a frame are written; false with a message if one is read, too. */
bool  cli_frame_touches (const CliMotion *motion, size_t frame, CliTouched *touched);
/* Whether all files of a frame or side are there. */
bool  cli_frame_is_complete (const CliMotion *motion, size_t frame, const CliKey *side);
/* Reads certainty and notes of the frame or side that the state names, if it was written with this fingerprint (NULL:
 * any, which the state gets).  The state has an empty array of notes. */
bool  cli_frame_read_state (const CliMotion *motion, size_t frame, const char *fingerprint, CliFrameState *state);
bool  cli_frame_write_state (const CliMotion *motion, const CliFrameState *state);
bool  cli_frame_read_labels (const CliMotion *motion, size_t frame, const CliKey *side, CeldLabels *labels);
bool  cli_frame_read_certainty (const CliMotion *motion, size_t frame, const CliKey *side, CeldPlane *certainty);
bool  cli_frame_write_certainty (const CliMotion *motion, const CliFrameState *state);

/* ------------------------------------------------------------------ clip-doubt.c */

/* Finds how sure each region of a frame is that was carried from the one before. */
bool cli_frame_doubt (const CliMotion *motion, const CeldHost *host, const CliFrameState *before, CliFrameState *next);

/* ------------------------------------------------------------------ review.c */

/* The name of the picture of a review: that of its JSON file with another ending; free with g_free. */
char *cli_review_sheet_name (const char *path);
/* Writes the frames and regions to look at as JSON, and beside it a picture of them. */
bool cli_review_write (const char *path, const CliMotion *motion);

#endif
