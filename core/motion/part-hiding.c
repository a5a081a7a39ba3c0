/* Parts that are seen in one key alone: they come out from behind others, or go behind them.
 *
 * Such parts, together with all that are attached to them and not seen either, move with the part that they are
 * attached to.  In the other key they have to be hidden by parts that are in front of them: they move there by the
 * shortest way, if there is such a place near them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/inbetween.h"

#define PART_SPOTS    300   /* places of a part that have to be hidden; chosen */
#define ENOUGH_HIDDEN 0.98f /* share of them that is enough; chosen */
#define AWAY_STEP     6.f   /* pixels of a drawing of CELD_KEY_SIDE; chosen */
#define AWAY_REACH    0.25f /* of the longer side; chosen */
#define AWAY_TURNS    24    /* directions of the longest way; chosen */

/* A place of a layer, in the other key. */
typedef struct { float at[2]; size_t layer; } Spot;

/* The parts of key s alone. */
typedef struct
{
  CeldInbetween    *between;
  int               s;
  const CeldPuppet *own, *other;
  const CeldJoint  *joint;     /* of each layer of key s */
  Spot             *spot;
  size_t            n, capacity;
} Hiding;

/* ------------------------------------------------------------------ motion */

/* The rigid motion of a part of key s alone, whose lattice has these places, at a share of the way to the other key. */
static CeldAffine
follow (const CeldInbetween *between, const CeldBetweenPart *part, int s, const float *place, float share)
{
  const CeldLattice *lattice = &between->key[s]->lattice;
  float              x = part->joint[0], y = part->joint[1];
  CeldAffine         motion = { { x, y }, { x, y }, { 1, 0, 0, 1 } };
  float              a = 0, b = 0, length, to[2] = { 0, 0 };

  for (int i = 0; i < CELD_CARRIERS && part->follows; i++)
    {
      CeldAffine one = celd_cell_motion (lattice, part->carriers.cell[i], lattice->rest, place);
      float      at[2], weight = part->carriers.share[i];

      celd_affine_map (&one, x, y, at);
      to[0] += weight * at[0];
      to[1] += weight * at[1];
      a     += weight * (one.matrix[0] + one.matrix[3]);
      b     += weight * (one.matrix[2] - one.matrix[1]);
    }
  length = hypotf (a, b);
  if (part->follows && length > 1e-6f)
    {
      memcpy (motion.to, to, sizeof to);
      memcpy (motion.matrix, (float[4]) { a / length, -b / length, b / length, a / length }, sizeof motion.matrix);
    }
  for (int i = 0; i < 2; i++)
    motion.to[i] += share * (motion.matrix[2 * i] * part->away[0] + motion.matrix[2 * i + 1] * part->away[1]);
  return motion;
}

/* Finds what a group of parts of key s moves with: cells of a layer near a joint. */
static CeldStatus
attach (const CeldPuppet *puppet, const CeldPuppetLayer *layer, const CeldJoint *joint, CeldBetweenPart *part)
{
  const CeldLattice *lattice = &puppet->lattice;
  CeldAffine        *still = celd_alloc (layer->n_cells, sizeof *still);

  if (!still)
    return CELD_NO_MEMORY;
  for (size_t c = 0; c < layer->n_cells; c++)
    still[c] = celd_cell_motion (lattice, layer->first + c, lattice->rest, lattice->rest);
  part->joint[0] = (float) joint->x;
  part->joint[1] = (float) joint->y;
  part->carriers = celd_carriers_at (still, layer->n_cells, (float) lattice->side, part->joint[0], part->joint[1]);
  for (int i = 0; i < CELD_CARRIERS; i++)
    part->carriers.cell[i] += (uint32_t) layer->first;
  part->follows = layer->n_cells > 0;
  celd_free (still);
  return CELD_OK;
}

/* The first part of a group that is attached to each other, none of them seen in the other key: the one that is
 * attached to another part, or to nothing. */
static CeldBetweenPart *
leader_of (const Hiding *h, CeldBetweenPart *part)
{
  for (size_t parent; (parent = h->joint[part->layer[h->s]].parent) != CELD_NO_INDEX;)
    {
      CeldBetweenPart *next = h->between->of_layer[h->s][parent];

      if (next->layer[!h->s] != CELD_NO_INDEX)
        break;
      part = next;
    }
  return part;
}

/* ------------------------------------------------------------------ where it is hidden */

/* Takes places of a part, where it would be in the other key; at most PART_SPOTS of its pixels. */
static CeldStatus
take_spots (Hiding *h, size_t k, const CeldAffine *motion)
{
  const CeldPuppetLayer *layer = &h->own->layer[k];
  size_t                 pixels = 0, seen = 0;
  CeldStatus             status = CELD_OK;

  for (int pass = 0; pass < 2; pass++)
    for (int y = layer->box.y; y < layer->box.y + layer->box.height; y++)
      for (int x = layer->box.x; x < layer->box.x + layer->box.width && status == CELD_OK; x++)
        {
          Spot spot = { { 0, 0 }, k };

          if (celd_puppet_alpha (layer, x, y) < 0.5f)
            continue;
          pixels += (size_t) !pass;
          if (pass && celd_is_sample (seen, pixels, PART_SPOTS))
            {
              celd_affine_map (motion, (float) x + 0.5f, (float) y + 0.5f, spot.at);
              status = celd_append (h->spot, h->n, h->capacity, spot);
            }
          seen += (size_t) pass;
        }
  return status;
}

/* Whether a layer of the other key is in front of one of this key: by the order of this key, or else by level. */
static bool
is_in_front (const Hiding *h, uint32_t f, size_t layer)
{
  const CeldPuppetLayer *front = &h->other->layer[f];
  size_t                 own = h->between->of_layer[!h->s][f]->layer[h->s];

  return front->cell && (own == CELD_NO_INDEX ? front->level > h->own->layer[layer].level : own > layer);
}

/* Whether enough of the places are hidden if the group is moved by (dx,dy). */
static bool
is_hidden (const Hiding *h, float dx, float dy)
{
  size_t hidden = 0;

  for (size_t i = 0; i < h->n; i++)
    {
      int x = (int) floorf (h->spot[i].at[0] + dx), y = (int) floorf (h->spot[i].at[1] + dy);

      hidden += x >= 0 && y >= 0 && x < h->other->width && y < h->other->height &&
                is_in_front (h, h->other->front[(size_t) y * (size_t) h->other->width + (size_t) x],
                             h->spot[i].layer);
    }
  return (float) hidden >= ENOUGH_HIDDEN * (float) h->n;
}

/* The shortest motion that hides the group; false if there is none. */
static bool
find_way (const Hiding *h, float away[2])
{
  float longer = (float) (h->other->width > h->other->height ? h->other->width : h->other->height);
  float step = AWAY_STEP * longer / CELD_KEY_SIDE;

  away[0] = away[1] = 0;
  if (is_hidden (h, 0, 0))
    return true;
  for (int ring = 1; (float) ring * step <= AWAY_REACH * longer; ring++)
    for (int turn = 0; turn < AWAY_TURNS; turn++)
      {
        away[0] = (float) ring * step * cosf ((float) (2 * CELD_PI * turn / AWAY_TURNS));
        away[1] = (float) ring * step * sinf ((float) (2 * CELD_PI * turn / AWAY_TURNS));
        if (is_hidden (h, away[0], away[1]))
          return true;
      }
  away[0] = away[1] = 0;
  return false;
}

/* Hides a group in the other key, behind what is in front of each of its parts. */
static CeldStatus
hide_group (Hiding *h, CeldBetweenPart *leader)
{
  size_t     parent = h->joint[leader->layer[h->s]].parent;
  CeldAffine motion;
  float      away[2];
  CeldStatus status = CELD_OK;

  if (parent != CELD_NO_INDEX)
    status = attach (h->own, &h->own->layer[parent], &h->joint[leader->layer[h->s]], leader);
  motion = follow (h->between, leader, h->s, h->between->end[h->s], 0);
  h->n   = 0;
  for (size_t p = 0; p < h->between->n && status == CELD_OK; p++)
    {
      CeldBetweenPart *part = &h->between->part[p];

      if (part->layer[!h->s] == CELD_NO_INDEX && leader_of (h, part) == leader)
        status = take_spots (h, part->layer[h->s], &motion);
    }
  leader->hides = find_way (h, away);
  for (int i = 0; i < 2; i++) /* back to the directions of its own key */
    leader->away[i] = motion.matrix[i] * away[0] + motion.matrix[2 + i] * away[1];
  return status;
}

/* Lets the parts of a group move as one. */
static void
follow_leader (const Hiding *h, CeldBetweenPart *part)
{
  CeldBetweenPart *leader = leader_of (h, part);

  part->follows  = leader->follows;
  part->carriers = leader->carriers;
  part->hides    = leader->hides;
  memcpy (part->joint, leader->joint, sizeof part->joint);
  memcpy (part->away, leader->away, sizeof part->away);
}

/* ------------------------------------------------------------------ */

CeldStatus
celd_parts_hide (CeldInbetween *between, const CeldKey key[2], const CeldHost *host)
{
  CeldStatus status = celd_progress (host, 0);

  for (int s = 0; s < 2 && status == CELD_OK; s++)
    {
      CeldJoint *joint = celd_alloc (between->key[s]->n, sizeof *joint);
      Hiding     h = { between, s, between->key[s], between->key[!s], joint, NULL, 0, 0 };

      status = joint ? celd_layers_joints (key[s].layers, key[s].background, joint) : CELD_NO_MEMORY;
      for (size_t p = 0; p < between->n && status == CELD_OK; p++)
        if (between->part[p].layer[!s] == CELD_NO_INDEX && leader_of (&h, &between->part[p]) == &between->part[p])
          status = hide_group (&h, &between->part[p]);
      for (size_t p = 0; p < between->n && status == CELD_OK; p++)
        if (between->part[p].layer[!s] == CELD_NO_INDEX)
          follow_leader (&h, &between->part[p]);
      celd_free (joint);
      celd_free (h.spot);
    }
  return status;
}

void
celd_parts_follow (CeldInbetween *between, int s, float share)
{
  CeldLattice *lattice = &between->key[s]->lattice;

  for (size_t p = 0; p < between->n; p++)
    {
      const CeldBetweenPart *part = &between->part[p];
      const CeldPuppetLayer *layer;
      CeldAffine             motion;

      if (part->layer[!s] != CELD_NO_INDEX)
        continue;
      layer  = &between->key[s]->layer[part->layer[s]];
      motion = follow (between, part, s, lattice->place, share);
      for (size_t i = 4 * layer->first; i < 4 * (layer->first + layer->n_cells); i++)
        {
          size_t v = lattice->corner[i];

          if (!between->known[s][v])
            celd_affine_map (&motion, lattice->rest[2 * v], lattice->rest[2 * v + 1], lattice->place + 2 * v);
        }
    }
}
