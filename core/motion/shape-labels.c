/* Labels of closed shapes: each takes that of the part that explains it best.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/rigid-parts.h"

#include <math.h>

#define PART_FOUND 0.3f /* share of a part's paper: with less of it under its label the part is lost; and a closed shape
                         * that has so much of a lost part may be it; chosen */
#define UNCLAIMED  0.9f /* share of a closed shape that no part has claimed, for one that is free for a lost part;
                         * chosen */

/* How many pixels of paper of a shape a part covers. */
typedef struct { uint32_t shape, part, pixels; } Cover;

typedef struct
{
  const CeldRigidParts   *parts;
  const CeldPose         *pose;
  const CeldTargetShapes *target;
  uint32_t                background;
  uint32_t               *count;     /* of each shape or component: pixels; 0 between uses */
  Cover                  *cover;     /* by parts */
  size_t                  n, capacity;
  uint32_t               *label;     /* of each shape */
} Labelling;

/* ------------------------------------------------------------------ what parts cover */

/* The box of the target that a part comes to lie in. */
static CeldRect
box_of (const Labelling *l, size_t k)
{
  const CeldRigidPart *part = &l->parts->item[k];
  float                left = INFINITY, top = INFINITY, right = -INFINITY, bottom = -INFINITY;
  int                  x, y, end_x, end_y;

  for (int i = 0; i < 4; i++)
    {
      float at[2];

      celd_pose_move (part, &l->pose[k], (float) (part->box.x + i % 2 * part->box.width),
                      (float) (part->box.y + i / 2 * part->box.height), at);
      left   = fminf (left, at[0]);
      right  = fmaxf (right, at[0]);
      top    = fminf (top, at[1]);
      bottom = fmaxf (bottom, at[1]);
    }
  x     = (int) fmaxf (0, floorf (left));
  y     = (int) fmaxf (0, floorf (top));
  end_x = (int) fminf ((float) l->target->width, ceilf (right));
  end_y = (int) fminf ((float) l->target->height, ceilf (bottom));
  return end_x > x && end_y > y ? (CeldRect) { x, y, end_x - x, end_y - y } : (CeldRect) { 0 };
}

/* Whether a part, where its pose takes it, covers the middle of a pixel. */
static bool
covers (const Labelling *l, size_t k, float c, float s, int x, int y)
{
  const CeldRigidPart *part = &l->parts->item[k];
  float                dx = (float) x + 0.5f - part->x - l->pose[k].x, dy = (float) y + 0.5f - part->y - l->pose[k].y;
  int                  px = (int) floorf (c * dx + s * dy + part->x), py = (int) floorf (c * dy - s * dx + part->y);

  return px >= 0 && py >= 0 && px < l->parts->width && py < l->parts->height &&
         l->parts->part[(size_t) py * (size_t) l->parts->width + (size_t) px] == k + 1;
}

static CeldStatus
find_covers (Labelling *l, size_t k)
{
  CeldRect   box = box_of (l, k);
  float      c = cosf (l->pose[k].angle), s = sinf (l->pose[k].angle);
  size_t     first = l->n;
  CeldStatus status = CELD_OK;

  for (int y = box.y; y < box.y + box.height; y++)
    for (int x = box.x; x < box.x + box.width && status == CELD_OK; x++)
      {
        uint32_t shape = l->target->shape[(size_t) y * (size_t) l->target->width + (size_t) x];

        if (!shape || !covers (l, k, c, s, x, y))
          continue;
        if (!l->count[shape]++)
          status = celd_append (l->cover, l->n, l->capacity, (Cover) { shape, (uint32_t) k, 0 });
      }
  for (size_t i = first; i < l->n; i++)
    {
      l->cover[i].pixels = l->count[l->cover[i].shape];
      l->count[l->cover[i].shape] = 0;
    }
  return status;
}

/* ------------------------------------------------------------------ labels */

/* How well a part and a shape explain each other. */
static float
score_of (const Labelling *l, const Cover *cover, const float *misfit, const float *covered)
{
  float pixels = (float) cover->pixels, size = (float) l->target->size[cover->shape];

  return fmaxf (pixels / size * (1 - 0.5f * misfit[cover->part]), 2 * pixels / (size + covered[cover->part]));
}

/* Gives each shape the label of the part with the highest score, if that covers more than half of it. */
static void
label_shapes (Labelling *l, const float *misfit, const float *covered, float *score)
{
  for (size_t i = 0; i < l->n; i++)
    {
      const Cover *cover = &l->cover[i];
      float        now = score_of (l, cover, misfit, covered);

      if (now <= score[cover->shape])
        continue;
      score[cover->shape]    = now;
      l->label[cover->shape] = 2 * cover->pixels > l->target->size[cover->shape] ? l->parts->item[cover->part].label
                                                                                    : l->background;
    }
}

/* ------------------------------------------------------------------ lost parts */

/* Marks connected paper, off the frame, of which hardly anything was given to a part. */
static void
mark_free (const Labelling *l, size_t *paper, size_t *unclaimed, bool *is_free)
{
  for (size_t k = 1; k <= l->target->n; k++)
    {
      paper[l->target->component[k]] += l->target->size[k];
      if (l->label[k] == l->background)
        unclaimed[l->target->component[k]] += l->target->size[k];
    }
  for (size_t c = 1; c <= l->target->n_components; c++)
    is_free[c] = !l->target->page[c] && (float) unclaimed[c] > UNCLAIMED * (float) paper[c];
}

/* Whether less of a part than PART_FOUND lies under its label. */
static bool
is_lost (const Labelling *l, size_t first, size_t end)
{
  const CeldRigidPart *part = &l->parts->item[l->cover[first].part];
  float                found = 0;

  for (size_t i = first; i < end; i++)
    if (l->label[l->cover[i].shape] == part->label)
      found += (float) l->cover[i].pixels;
  return part->label == l->background || found <= PART_FOUND * (float) part->area;
}

/* Finds the part that has most in each free component: bid[c] is the pixels, winner[c] the label. */
static void
bid (Labelling *l, size_t first, size_t end, const bool *is_free, uint32_t *most, uint32_t *winner)
{
  const CeldRigidPart *part = &l->parts->item[l->cover[first].part];

  for (size_t i = first; i < end; i++)
    l->count[l->target->component[l->cover[i].shape]] += l->cover[i].pixels;
  for (size_t i = first; i < end; i++)
    {
      uint32_t c = l->target->component[l->cover[i].shape], pixels = l->count[c];

      l->count[c] = 0;
      if (is_free[c] && (float) pixels > PART_FOUND * (float) part->area && pixels > most[c])
        {
          most[c]   = pixels;
          winner[c] = part->label;
        }
    }
}

/* A part that found no place takes the closed shape that it lies in, if no other has it: a part that changed too much
 * to be recognised is often still where it was. */
static CeldStatus
place_lost (Labelling *l)
{
  size_t    n = l->target->n_components + 1, *paper = celd_alloc0 (2 * n, sizeof *paper);
  uint32_t *most = celd_alloc0 (2 * n, sizeof *most);
  bool     *is_free = celd_alloc0 (n, sizeof *is_free);
  bool      good = paper && most && is_free;

  if (good)
    mark_free (l, paper, paper + n, is_free);
  for (size_t i = 0, end; i < l->n && good; i = end)
    {
      for (end = i; end < l->n && l->cover[end].part == l->cover[i].part;)
        end++;
      if (is_lost (l, i, end))
        bid (l, i, end, is_free, most, most + n);
    }
  for (size_t k = 1; k <= l->target->n && good; k++)
    if (most[l->target->component[k]])
      l->label[k] = most[n + l->target->component[k]];
  celd_free (paper);
  celd_free (most);
  celd_free (is_free);
  return good ? CELD_OK : CELD_NO_MEMORY;
}

/* ------------------------------------------------------------------ certainty */

/* How far parts and labels agree: the share of each shape that parts of its label cover; of background that goes on to
 * the frame, what no other part covers.  So closed shapes that nothing explains, maybe new parts, are uncertain. */
static void
measure_certainty (const Labelling *l, float *certainty)
{
  for (size_t k = 1; k <= l->target->n; k++)
    certainty[k] = l->label[k] == l->background && l->target->page[l->target->component[k]] ? 1 : 0;
  for (size_t i = 0; i < l->n; i++)
    {
      const Cover *cover = &l->cover[i];
      uint32_t     label = l->label[cover->shape];
      float        share = (float) cover->pixels / (float) l->target->size[cover->shape];

      if (label == l->parts->item[cover->part].label)
        certainty[cover->shape] = fminf (1, certainty[cover->shape] + share);
      else if (label == l->background)
        certainty[cover->shape] = fmaxf (0, certainty[cover->shape] - share);
    }
}

/* ------------------------------------------------------------------ */

CeldStatus
celd_shape_labels (const CeldRigidParts *parts, const CeldPose *pose, const CeldTargetShapes *target,
                   uint32_t background, uint32_t *label, float *certainty)
{
  size_t     counts = (target->n > target->n_components ? target->n : target->n_components) + 1;
  Labelling  l = { .parts = parts, .pose = pose, .target = target, .background = background, .label = label,
                   .count = celd_alloc0 (counts, sizeof *l.count) };
  float     *misfit = celd_alloc0 (parts->n, sizeof *misfit), *covered = celd_alloc0 (parts->n, sizeof *covered);
  CeldStatus status = l.count && misfit && covered ? CELD_OK : CELD_NO_MEMORY;

  for (size_t k = 0; k <= target->n; k++)
    {
      label[k]     = background;
      certainty[k] = 0;
    }
  for (size_t k = 0; k < parts->n && status == CELD_OK; k++)
    {
      size_t first = l.n;

      status    = find_covers (&l, k);
      misfit[k] = celd_pose_misfit (&parts->item[k], target, &pose[k], l.count);
      for (size_t i = first; i < l.n; i++)
        covered[k] += (float) l.cover[i].pixels;
    }
  if (status == CELD_OK)
    {
      label_shapes (&l, misfit, covered, certainty);
      status = place_lost (&l);
      measure_certainty (&l, certainty);
    }
  celd_free (l.count);
  celd_free (l.cover);
  celd_free (misfit);
  celd_free (covered);
  return status;
}
