/* Rigid parts: the connected visible parts of a drawing's regions, which move almost rigidly from one frame to the
 * next.
 *
 *   target-shapes.c    the closed shapes of the next frame
 *   rigid-parts.c      the parts of a frame, and where they touch
 *   pose-misfit.c      how well poses of a part fit the next frame
 *   rigid-poses.c      the best poses of each part
 *   rigid-choice.c     one pose for each part, such that parts stay together
 *   shape-labels.c     labels of the closed shapes that parts come to lie on
 *   propagate.c        the step
 *   blend.c            a frame that two keys were propagated to
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_RIGID_PARTS_H
#define CELD_RIGID_PARTS_H

#include "segment/segment.h"

/* Lengths of these files are made for drawings whose longer side has so many pixels, and scale with it. */
#define CELD_MOTION_SIDE 640.f

/* ------------------------------------------------------------------ target-shapes.c */

/* The closed shapes of a drawing: paper that ink encloses, gaps closed. */
typedef struct
{
  int       width, height;
  uint32_t *shape;             /* of each pixel: 1 .. n; 0 on ink and solid areas */
  uint32_t *size;              /* of shape k: pixels of paper, size[k] */
  uint32_t *component;         /* of shape k: the connected paper that it is part of, 1 .. n_components */
  bool     *page;              /* of component c: it touches the frame */
  size_t    n, n_components;
  float    *distance;          /* of each pixel to the nearest ink, in pixels */
} CeldTargetShapes;

CeldStatus celd_target_shapes_new   (const CeldPlane *ink, const CeldHost *host, CeldTargetShapes *target);
void       celd_target_shapes_clear (CeldTargetShapes *target);   /* accepts a zeroed record */

/* ------------------------------------------------------------------ rigid-parts.c */

/* Turned by an angle in radians about the part's centre, clockwise as seen, and then moved by (x,y). */
typedef struct { float angle, x, y; } CeldPose;

/* A place relative to a part's centre. */
typedef struct { float x, y; } CeldOffset;

#define CELD_INSIDE_SAMPLES  150 /* chosen */
#define CELD_OUTLINE_SAMPLES 80  /* chosen */

typedef struct
{
  uint32_t   label;
  CeldRect   box;
  float      x, y;             /* its centre: the mean of its paper */
  size_t     area, length;     /* pixels of paper, and of its outline */
  CeldOffset inside[CELD_INSIDE_SAMPLES], outline[CELD_OUTLINE_SAMPLES];
  size_t     n_inside, n_outline;
} CeldRigidPart;

/* Two parts a < b that touch, and the middle of their contact.  weight: up to 1, which is a contact along a quarter of
 * the shorter outline. */
typedef struct { uint32_t a, b; float x, y, weight; } CeldContact;

typedef struct
{
  int            width, height;
  uint32_t      *part;         /* of each pixel: index + 1; 0: what does not move */
  CeldRigidPart *item;
  size_t         n;
  CeldContact   *contact;
  size_t         n_contacts;
} CeldRigidParts;

/* Finds the parts of a labelled frame.  What touches the frame of the picture does not move if it is of the label
 * `background` (0: none). */
CeldStatus celd_rigid_parts_new   (const CeldPlane *ink, const CeldLabels *labels, const uint32_t *level,
                                   uint32_t background, const CeldHost *host, CeldRigidParts *parts);
void       celd_rigid_parts_clear (CeldRigidParts *parts);        /* accepts a zeroed record */

/* ------------------------------------------------------------------ pose-misfit.c */

/* Where a pose takes a place of the drawing. */
void  celd_pose_move (const CeldRigidPart *part, const CeldPose *pose, float x, float y, float place[2]);

/* The samples of a part, turned about its centre: relative to that. */
typedef struct
{
  const CeldRigidPart *part;
  CeldOffset           inside[CELD_INSIDE_SAMPLES], outline[CELD_OUTLINE_SAMPLES];
} CeldTurnedPart;

void  celd_part_turn (const CeldRigidPart *part, float angle, CeldTurnedPart *turned);

/* The mean distance of a part's outline to ink, with the part's centre at (x,y): truncated, and divided by the largest
 * distance that counts, so 0 .. 1. */
float celd_outline_misfit (const CeldTurnedPart *turned, const CeldTargetShapes *target, float x, float y);

/* 1 - intersection over union of the part and the shapes that it covers by more than half: 0 .. 1.  `count` is work
 * space for target->n + 1 numbers, all 0, and is left so. */
float celd_cover_misfit (const CeldTurnedPart *turned, const CeldTargetShapes *target, float x, float y,
                         uint32_t *count);

/* How badly a part fits the target in a pose: the mean of both misfits. */
float celd_pose_misfit (const CeldRigidPart *part, const CeldTargetShapes *target, const CeldPose *pose,
                        uint32_t *count);

/* ------------------------------------------------------------------ rigid-poses.c */

#define CELD_MOST_POSES 96

/* Poses that may be right for a part, and what each costs: 0 for a perfect fit of the expected pose. */
typedef struct { CeldPose pose[CELD_MOST_POSES]; float cost[CELD_MOST_POSES]; size_t n; } CeldPoseList;

/* Fills the list of each part with poses around the one that is expected for it, which is the first in the list. */
CeldStatus celd_poses_find (const CeldRigidParts *parts, const CeldTargetShapes *target, const CeldPose *expected,
                            const CeldHost *host, CeldPoseList *list);

/* Adds to the lists of parts that touch poses that keep them together, for the chosen pose of one of both. */
CeldStatus celd_poses_join (const CeldRigidParts *parts, const CeldTargetShapes *target, const CeldPose *expected,
                            const size_t *choice, const CeldHost *host, CeldPoseList *list);

/* ------------------------------------------------------------------ rigid-choice.c */

/* Chooses a pose of each list, such that parts that touch stay together as far as they fit: choice[k] is its index. */
CeldStatus celd_poses_choose (const CeldRigidParts *parts, const CeldPoseList *list, size_t *choice);

/* ------------------------------------------------------------------ shape-labels.c */

/* Labels the shapes of the target that parts come to lie on by their poses: label[k] of shape k, and certainty[k], how
 * far parts and labels agree there, [0,1].  Shapes that no part covers by more than half get the label `background`;
 * so do label[0] and certainty[0]. */
CeldStatus celd_shape_labels (const CeldRigidParts *parts, const CeldPose *pose, const CeldTargetShapes *target,
                              uint32_t background, uint32_t *label, float *certainty);

#endif
