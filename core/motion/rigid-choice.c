/* The choice of one pose for each rigid part: min-sum belief propagation over the graph of contacts [FH05], then
 * iterated conditional modes, which can only improve it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/rigid-parts.h"

#include <math.h>

#define TOGETHER       0.35f /* cost of two parts that come off each other, for a full contact; chosen */
#define COME_APART     19.f  /* pixels of a drawing of CELD_MOTION_SIDE from which on they are off; chosen */
#define MESSAGE_SWEEPS 12    /* chosen */
#define MESSAGE_KEPT   0.5f  /* share of the last message that is kept; chosen */
#define CORRECTIONS    10    /* sweeps of iterated conditional modes; chosen */

/* Messages along a contact: [0] from part a to the poses of b, [1] from b to those of a. */
typedef struct { float to[2][CELD_MOST_POSES]; } Message;

typedef struct
{
  const CeldRigidParts *parts;
  const CeldPoseList   *list;
  float               (*pair)[CELD_MOST_POSES][CELD_MOST_POSES]; /* cost of poses of a and b, of each contact */
  Message              *old, *new;
  float               (*belief)[CELD_MOST_POSES];                /* of each part: cost of its poses and messages */
} Choice;

static void
fill_pairs (Choice *c)
{
  float longer = (float) (c->parts->width > c->parts->height ? c->parts->width : c->parts->height);
  float apart = COME_APART * longer / CELD_MOTION_SIDE;

  for (size_t e = 0; e < c->parts->n_contacts; e++)
    {
      const CeldContact  *contact = &c->parts->contact[e];
      const CeldPoseList *a = &c->list[contact->a], *b = &c->list[contact->b];
      float               place[CELD_MOST_POSES][2];

      for (size_t j = 0; j < b->n; j++)
        celd_pose_move (&c->parts->item[contact->b], &b->pose[j], contact->x, contact->y, place[j]);
      for (size_t i = 0; i < a->n; i++)
        {
          float here[2];

          celd_pose_move (&c->parts->item[contact->a], &a->pose[i], contact->x, contact->y, here);
          for (size_t j = 0; j < b->n; j++)
            {
              float x = place[j][0] - here[0], y = place[j][1] - here[1];

              c->pair[e][i][j] = TOGETHER * contact->weight * fminf (1, sqrtf (x * x + y * y) / apart);
            }
        }
    }
}

static void
update_beliefs (Choice *c)
{
  for (size_t k = 0; k < c->parts->n; k++)
    memcpy (c->belief[k], c->list[k].cost, c->list[k].n * sizeof (float));
  for (size_t e = 0; e < c->parts->n_contacts; e++)
    {
      const CeldContact *contact = &c->parts->contact[e];

      for (size_t j = 0; j < c->list[contact->b].n; j++)
        c->belief[contact->b][j] += c->old[e].to[0][j];
      for (size_t i = 0; i < c->list[contact->a].n; i++)
        c->belief[contact->a][i] += c->old[e].to[1][i];
    }
}

/* The message along a contact to part b (way 0) or a (way 1). */
static void
send (Choice *c, size_t e, int way)
{
  const CeldContact *contact = &c->parts->contact[e];
  uint32_t           from = way ? contact->b : contact->a, to = way ? contact->a : contact->b;
  float             *message = c->new[e].to[way], least = INFINITY;

  for (size_t j = 0; j < c->list[to].n; j++)
    {
      message[j] = INFINITY;
      for (size_t i = 0; i < c->list[from].n; i++)
        {
          float cost = c->belief[from][i] - c->old[e].to[!way][i] + (way ? c->pair[e][j][i] : c->pair[e][i][j]);

          message[j] = fminf (message[j], cost);
        }
      least = fminf (least, message[j]);
    }
  for (size_t j = 0; j < c->list[to].n; j++)
    message[j] = MESSAGE_KEPT * c->old[e].to[way][j] + (1 - MESSAGE_KEPT) * (message[j] - least);
}

static size_t
least_of (const float *cost, size_t n)
{
  size_t best = 0;

  for (size_t i = 1; i < n; i++)
    if (cost[i] < cost[best])
      best = i;
  return best;
}

/* The pose of a part that is best for the chosen ones of its neighbours. */
static size_t
best_beside (const Choice *c, uint32_t k, const size_t *choice)
{
  float cost[CELD_MOST_POSES];

  memcpy (cost, c->list[k].cost, c->list[k].n * sizeof *cost);
  for (size_t e = 0; e < c->parts->n_contacts; e++)
    {
      const CeldContact *contact = &c->parts->contact[e];

      for (size_t i = 0; i < c->list[k].n && (contact->a == k || contact->b == k); i++)
        cost[i] += contact->a == k ? c->pair[e][i][choice[contact->b]] : c->pair[e][choice[contact->a]][i];
    }
  return least_of (cost, c->list[k].n);
}

static void
choose (Choice *c, size_t *choice)
{
  bool changed = true;

  fill_pairs (c);
  for (int sweep = 0; sweep < MESSAGE_SWEEPS; sweep++)
    {
      Message *last = c->old;

      update_beliefs (c);
      for (size_t e = 0; e < c->parts->n_contacts; e++)
        for (int way = 0; way < 2; way++)
          send (c, e, way);
      c->old = c->new;
      c->new = last;
    }
  update_beliefs (c);
  for (size_t k = 0; k < c->parts->n; k++)
    choice[k] = least_of (c->belief[k], c->list[k].n);
  for (int sweep = 0; sweep < CORRECTIONS && changed; sweep++)
    {
      changed = false;
      for (size_t k = 0; k < c->parts->n; k++)
        {
          size_t best = best_beside (c, (uint32_t) k, choice);

          changed |= best != choice[k];
          choice[k] = best;
        }
    }
}

CeldStatus
celd_poses_choose (const CeldRigidParts *parts, const CeldPoseList *list, size_t *choice)
{
  size_t n = parts->n_contacts;
  Choice c = { .parts = parts, .list = list, .pair = celd_alloc (n, sizeof *c.pair),
               .old = celd_alloc0 (n, sizeof *c.old), .new = celd_alloc0 (n, sizeof *c.new),
               .belief = celd_alloc (parts->n, sizeof *c.belief) };
  bool   good = c.pair && c.old && c.new && c.belief;

  if (good)
    choose (&c, choice);
  celd_free (c.pair);
  celd_free (c.old);
  celd_free (c.new);
  celd_free (c.belief);
  return good ? CELD_OK : CELD_NO_MEMORY;
}
