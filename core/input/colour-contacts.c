/* Where strokes of different colours meet, and which parts go on at the other side.
 *
 * A piece of one colour (colour-pieces.c) ends where another one lies above it.  The places where it is next to other
 * paint are its contacts.  Two contacts of like colour face each other if their arms lie in one line, with paint all
 * the way between: there one stroke passes under another, or through it where both are translucent.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "input/arrow-colours.h"
#include "input/arrows.h"
#include "input/trail.h"

#include <math.h>

#define ALONG      0.8  /* length of the mean direction of an arm's pixels: less is no arm, */
#define ACROSS     0.5  /* and less than this a stroke that goes on both ways */
#define MOST_TURN  0.76 /* cosine of the turn that a stroke may take where it is hidden: 0.7 radians */
#define ASIDE      0.5  /* of an arm's width, that the other one may lie off its line, */
#define AWAY       0.25 /* and of the distance */
#define MOST_RATIO 2.2  /* of the widths of both arms */
#define FARTHEST   8    /* widths of the thicker stroke, and a few pixels, that a stroke is hidden at most */

static bool
touches_other (const CeldPieces *s, size_t pixel)
{
  for (int k = 0; k < 9; k++)
    {
      uint32_t other = celd_pieces_near (s, pixel, k % 3 - 1, k / 3 - 1);

      if (other && s->piece[other - 1] != s->piece[pixel])
        return true;
    }
  return false;
}

/* Gathers pixels at other paint; *many is true if there are too many contacts. */
static CeldStatus
find_contacts (CeldJoints *j, bool *many)
{
  const CeldPieces *s = &j->pieces;
  uint32_t         *parent = celd_alloc (s->n_pixels + 1, sizeof *parent);
  CeldStatus        status = CELD_OK;

  j->contact_of = celd_alloc0 (s->n_pixels, sizeof *j->contact_of);
  j->contact    = celd_alloc0 (CELD_MOST_CONTACTS, sizeof *j->contact);
  if (!parent || !j->contact_of || !j->contact)
    {
      celd_free (parent);
      return CELD_NO_MEMORY;
    }
  for (size_t i = 0; i < s->n_pixels; i++)
    j->contact_of[i] = s->piece[i] && touches_other (s, i);
  celd_roots (parent, s->n_pixels + 1);
  for (uint32_t i = 0; i < s->n_pixels; i++)
    for (int k = 0; k < CELD_SQUARE * CELD_SQUARE && j->contact_of[i]; k++)
      {
        uint32_t other = celd_pieces_near (s, i, k % CELD_SQUARE - CELD_GATHERED, k / CELD_SQUARE - CELD_GATHERED);

        if (other && j->contact_of[other - 1] && s->piece[other - 1] == s->piece[i])
          celd_join (parent, i, other - 1);
      }
  for (uint32_t i = 0; i < s->n_pixels && !*many; i++) /* roots come first */
    {
      uint32_t root = celd_root (parent, i);

      if (!j->contact_of[i])
        continue;
      if (root == i && j->n_contacts == CELD_MOST_CONTACTS)
        {
          *many = true;
          break;
        }
      j->contact_of[i] = root == i ? (uint32_t) ++j->n_contacts : j->contact_of[root];
      j->contact[j->contact_of[i] - 1].piece = s->piece[i];
      j->contact[j->contact_of[i] - 1].n++;
      j->contact[j->contact_of[i] - 1].at.x += celd_pieces_middle (s, i).x;
      j->contact[j->contact_of[i] - 1].at.y += celd_pieces_middle (s, i).y;
    }
  for (size_t k = 0; k < j->n_contacts; k++)
    j->contact[k] = (CeldContact) {
      .at = { j->contact[k].at.x / (double) j->contact[k].n, j->contact[k].at.y / (double) j->contact[k].n },
      .piece = j->contact[k].piece, .n = j->contact[k].n, .mate = CELD_NO_INDEX,
    };
  celd_free (parent);
  return status;
}

/* How far a contact reaches from its middle, along a way or at all. */
static double
reach_along (const CeldJoints *j, const CeldContact *c, uint32_t index, const CeldPoint *way)
{
  double most = 0;

  for (size_t i = 0; i < j->pieces.n_pixels; i++)
    if (j->contact_of[i] == index + 1)
      {
        CeldPoint p = celd_pieces_middle (&j->pieces, i);
        double    dx = p.x - c->at.x, dy = p.y - c->at.y;

        most = fmax (most, way ? fabs (dx * way->x + dy * way->y) : hypot (dx, dy));
      }
  return most;
}

/* What the piece is like some way behind a contact: on a ring round it, where an arm lies on one side only. */
static void
measure_arm (const CeldJoints *j, CeldContact *c, uint32_t index)
{
  const CeldPieces *s = &j->pieces;
  double            wide = s->widths[c->piece], near = fmax (0.75 * wide, reach_along (j, c, index, NULL)) + 2;
  double            far = near + wide + 6, n = 0, all = 0, weights = 0, squares = 0, sum[3] = { 0 }, length;
  CeldPoint         way = { 0, 0 }, back = { 0, 0 };

  for (size_t i = 0; i < s->n_pixels; i++)
    {
      CeldPoint p = celd_pieces_middle (s, i);
      double    d = hypot (p.x - c->at.x, p.y - c->at.y);
      CeldTint  t;

      if (s->piece[i] != c->piece || d < near || d >= far)
        continue;
      t = celd_pieces_tint (s, j->layer, i);
      for (int k = 0; k < 3; k++) /* the other stroke's colour comes near */
        sum[k] += (double) s->tint[s->like[i]].c[k] * t.strength * (d - near + 0.1);
      all     += t.strength * (d - near + 0.1);
      weights += t.strength;
      squares += (double) t.strength * t.strength;
      way.x += (c->at.x - p.x) / d;
      way.y += (c->at.y - p.y) / d;
      back.x += p.x;
      back.y += p.y;
      n++;
    }
  if (!(weights > 0))
    return;
  for (int k = 0; k < 3; k++)
    c->tint.c[k] = (float) (sum[k] / all);
  c->tint.strength = (float) (squares / weights);
  length    = hypot (way.x, way.y);
  c->is_arm = length >= ALONG * n;
  c->passes = length < ACROSS * n;
  if (!c->is_arm)
    return;
  c->way   = (CeldPoint) { way.x / length, way.y / length };
  c->back  = (CeldPoint) { back.x / n, back.y / n };
  c->width = n / (far - near);
  c->reach = reach_along (j, c, index, &c->way);
}

/* ------------------------------------------------------------------ which contacts face each other */

static bool
is_painted_between (const CeldCutting *c, CeldPoint a, CeldPoint b)
{
  double length = hypot (b.x - a.x, b.y - a.y);

  for (double s = 0; s < length; s += 0.5)
    if (!c->painted[(size_t) (a.y + (b.y - a.y) * s / length) * (size_t) c->width +
                    (size_t) (a.x + (b.x - a.x) * s / length)])
      return false;
  return true;
}

/* How far a place lies off the line of an arm, and whether that is a little, and ahead. */
static bool
lies_ahead (const CeldContact *c, CeldPoint p, double *off)
{
  double dx = p.x - c->at.x, dy = p.y - c->at.y, ahead = dx * c->way.x + dy * c->way.y;

  *off = fabs (dx * c->way.y - dy * c->way.x);
  return ahead > -c->reach - 1 && *off <= ASIDE * c->width + 1 + AWAY * hypot (dx, dy);
}

/* Do two contacts face each other?  If so, how much does the stroke turn: 0 is straight. */
static bool
face (const CeldJoints *j, const CeldContact *a, const CeldContact *b, double *turn)
{
  double off[2], cosine = -(a->way.x * b->way.x + a->way.y * b->way.y), widest = fmax (a->width, b->width);
  double far = hypot (b->at.x - a->at.x, b->at.y - a->at.y);

  if (!a->is_arm || !b->is_arm || cosine < MOST_TURN || widest > MOST_RATIO * fmin (a->width, b->width) + 1 ||
      far > FARTHEST * fmax (widest, j->pieces.width) + 12 ||
      !lies_ahead (a, b->at, &off[0]) || !lies_ahead (b, a->at, &off[1]) ||
      celd_tints_differ (j->layer, &a->tint, &b->tint, CELD_LESS_NOISE) >= CELD_ALIKE ||
      !is_painted_between (&j->pieces.cutting, a->at, b->at))
    return false;
  *turn = 1 - cosine + (off[0] + off[1]) / (far + widest);
  return true;
}

/* The straightest ones first. */
static void
match_contacts (CeldJoints *j)
{
  for (;;)
    {
      double best = INFINITY;
      size_t one = 0, two = 0;

      for (size_t a = 0; a < j->n_contacts; a++)
        for (size_t b = a + 1; b < j->n_contacts; b++)
          {
            double turn;

            if (j->contact[a].mate == CELD_NO_INDEX && j->contact[b].mate == CELD_NO_INDEX &&
                face (j, &j->contact[a], &j->contact[b], &turn) && turn < best)
              {
                best = turn;
                one  = a;
                two  = b;
              }
          }
      if (best == INFINITY)
        return;
      j->contact[one].mate = two;
      j->contact[two].mate = one;
      celd_join (j->parent, j->contact[one].piece, j->contact[two].piece);
    }
}

CeldStatus
celd_colour_contacts_find (CeldJoints *j, bool *many)
{
  CeldStatus status = find_contacts (j, many);

  if (status != CELD_OK || *many)
    return status;
  for (uint32_t k = 0; k < j->n_contacts; k++)
    measure_arm (j, &j->contact[k], k);
  match_contacts (j);
  return CELD_OK;
}
