/* Strokes of different colours that cross: each on its own.
 *
 * A piece of one colour (colour-pieces.c) ends where another one lies above it.  The places where it is next to other
 * paint are its contacts.  Two contacts of like colour that face each other, with their arms in one line and paint all
 * the way between, are where one stroke passes under another, or through it where both are translucent: the straight
 * band between is part of both strokes, and gets what its ends have.  Where a contact faces none and the stroke does
 * not pass by, part of it may be hidden: it is cut.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "arrow-colours.h"
#include "unions.h"

#include <math.h>

#define MOST_CONTACTS 128  /* more are no arrows */
#define GATHERED      2    /* pixels of one contact are no farther apart */
#define SQUARE        (2 * GATHERED + 1)
#define ALONG         0.8  /* length of the mean direction of an arm's pixels: less is no arm, */
#define ACROSS        0.5  /* and less than this a stroke that goes on both ways */
#define MOST_TURN     0.76 /* cosine of the turn that a stroke may take where it is hidden: 0.7 radians */
#define ASIDE         0.5  /* of an arm's width, that the other one may lie off its line, */
#define AWAY          0.25 /* and of the distance */
#define MOST_RATIO    2.2  /* of the widths of both arms */
#define FARTHEST      8    /* widths of the thicker stroke, and a few pixels, that a stroke is hidden at most */
#define COVERED       0.8  /* share of a piece in bands of others that makes it a place where they overlap */
#define LEAST_JOINED  0.9  /* of a strand's pixels are connected */

/* Where a strand is next to other paint, and the arm that ends there. */
typedef struct
{
  CeldPoint at, back;      /* middles of the contact, and of the arm some way behind it */
  CeldPoint way;           /* of length 1, out of the arm */
  double    width, reach;  /* of the arm; of the contact along it, from its middle */
  bool      is_arm, passes; /* does an arm end here, or does the stroke go on both ways? */
  CeldTint  tint;
  uint32_t  piece;
  size_t    n, mate;       /* pixels; the contact that it faces */
} Contact;

typedef struct
{
  const CeldArrowLayer *layer;
  CeldPieces            pieces;
  uint32_t             *contact;  /* of each pixel: from 1; 0 = none */
  Contact              *item;
  size_t                n;
  uint32_t             *parent;   /* of pieces: union-find of strands */
  bool                 *dropped;  /* strands that are only where others overlap */
} Joints;

static void
joints_end (Joints *j)
{
  celd_colour_pieces_clear (&j->pieces);
  celd_free (j->contact);
  celd_free (j->item);
  celd_free (j->parent);
  celd_free (j->dropped);
}

/* The middle of a pixel, in the cutting. */
static CeldPoint
middle_of (const CeldPieces *s, size_t pixel)
{
  size_t width = (size_t) s->cutting.width;

  return (CeldPoint) { (double) (s->place[pixel] % width) + 0.5, (double) (s->place[pixel] / width) + 0.5 };
}

/* The pixel at an offset, counted from 1; 0 if there is none. */
static uint32_t
pixel_near (const CeldPieces *s, size_t pixel, int dx, int dy)
{
  int x = (int) (s->place[pixel] % (size_t) s->cutting.width) + dx;
  int y = (int) (s->place[pixel] / (size_t) s->cutting.width) + dy;

  if (x < 0 || y < 0 || x >= s->cutting.width || y >= s->cutting.height)
    return 0;
  return s->number[(size_t) y * (size_t) s->cutting.width + (size_t) x];
}

/* ------------------------------------------------------------------ contacts */

static bool
touches_other (const CeldPieces *s, size_t pixel)
{
  for (int k = 0; k < 9; k++)
    {
      uint32_t other = pixel_near (s, pixel, k % 3 - 1, k / 3 - 1);

      if (other && s->piece[other - 1] != s->piece[pixel])
        return true;
    }
  return false;
}

/* Gathers pixels at other paint; *many is true if there are too many contacts. */
static CeldStatus
find_contacts (Joints *j, bool *many)
{
  const CeldPieces *s = &j->pieces;
  uint32_t         *parent = celd_alloc (s->n_pixels + 1, sizeof *parent);
  CeldStatus        status = CELD_OK;

  j->contact = celd_alloc0 (s->n_pixels, sizeof *j->contact);
  j->item    = celd_alloc0 (MOST_CONTACTS, sizeof *j->item);
  if (!parent || !j->contact || !j->item)
    {
      celd_free (parent);
      return CELD_NO_MEMORY;
    }
  for (size_t i = 0; i < s->n_pixels; i++)
    j->contact[i] = s->piece[i] && touches_other (s, i);
  celd_roots (parent, s->n_pixels + 1);
  for (uint32_t i = 0; i < s->n_pixels; i++)
    for (int k = 0; k < SQUARE * SQUARE && j->contact[i]; k++)
      {
        uint32_t other = pixel_near (s, i, k % SQUARE - GATHERED, k / SQUARE - GATHERED);

        if (other && j->contact[other - 1] && s->piece[other - 1] == s->piece[i])
          celd_join (parent, i, other - 1);
      }
  for (uint32_t i = 0; i < s->n_pixels && !*many; i++) /* roots come first */
    {
      uint32_t root = celd_root (parent, i);

      if (!j->contact[i])
        continue;
      if (root == i && j->n == MOST_CONTACTS)
        {
          *many = true;
          break;
        }
      j->contact[i] = root == i ? (uint32_t) ++j->n : j->contact[root];
      j->item[j->contact[i] - 1].piece = s->piece[i];
      j->item[j->contact[i] - 1].n++;
      j->item[j->contact[i] - 1].at.x += middle_of (s, i).x;
      j->item[j->contact[i] - 1].at.y += middle_of (s, i).y;
    }
  for (size_t k = 0; k < j->n; k++)
    j->item[k] = (Contact) {
      .at = { j->item[k].at.x / (double) j->item[k].n, j->item[k].at.y / (double) j->item[k].n },
      .piece = j->item[k].piece, .n = j->item[k].n, .mate = CELD_NO_INDEX,
    };
  celd_free (parent);
  return status;
}

/* How far a contact reaches from its middle, along a way or at all. */
static double
reach_along (const Joints *j, const Contact *c, uint32_t index, const CeldPoint *way)
{
  double most = 0;

  for (size_t i = 0; i < j->pieces.n_pixels; i++)
    if (j->contact[i] == index + 1)
      {
        CeldPoint p = middle_of (&j->pieces, i);
        double    dx = p.x - c->at.x, dy = p.y - c->at.y;

        most = fmax (most, way ? fabs (dx * way->x + dy * way->y) : hypot (dx, dy));
      }
  return most;
}

/* What the piece is like some way behind a contact: on a ring round it, where an arm lies on one side only. */
static void
measure_arm (const Joints *j, Contact *c, uint32_t index)
{
  const CeldPieces *s = &j->pieces;
  double            wide = s->widths[c->piece], near = fmax (0.75 * wide, reach_along (j, c, index, NULL)) + 2;
  double            far = near + wide + 6, n = 0, all = 0, weights = 0, squares = 0, sum[3] = { 0 }, length;
  CeldPoint         way = { 0, 0 }, back = { 0, 0 };

  for (size_t i = 0; i < s->n_pixels; i++)
    {
      CeldPoint p = middle_of (s, i);
      double    d = hypot (p.x - c->at.x, p.y - c->at.y);
      CeldTint  t;

      if (s->piece[i] != c->piece || d < near || d >= far)
        continue;
      t = celd_tint_at (j->layer, s->cutting.left + (int) p.x, s->cutting.top + (int) p.y);
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
lies_ahead (const Contact *c, CeldPoint p, double *off)
{
  double dx = p.x - c->at.x, dy = p.y - c->at.y, ahead = dx * c->way.x + dy * c->way.y;

  *off = fabs (dx * c->way.y - dy * c->way.x);
  return ahead > -c->reach - 1 && *off <= ASIDE * c->width + 1 + AWAY * hypot (dx, dy);
}

/* Do two contacts face each other?  If so, how much does the stroke turn: 0 is straight. */
static bool
face (const Joints *j, const Contact *a, const Contact *b, double *turn)
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
match_contacts (Joints *j)
{
  for (;;)
    {
      double best = INFINITY;
      size_t one = 0, two = 0;

      for (size_t a = 0; a < j->n; a++)
        for (size_t b = a + 1; b < j->n; b++)
          {
            double turn;

            if (j->item[a].mate == CELD_NO_INDEX && j->item[b].mate == CELD_NO_INDEX &&
                face (j, &j->item[a], &j->item[b], &turn) && turn < best)
              {
                best = turn;
                one  = a;
                two  = b;
              }
          }
      if (best == INFINITY)
        return;
      j->item[one].mate = two;
      j->item[two].mate = one;
      celd_join (j->parent, j->item[one].piece, j->item[two].piece);
    }
}

/* ------------------------------------------------------------------ bands */

/* Is a place in the band between two contacts?  *t is how far it is from the arm of `a` to that of `b`. */
static bool
in_band (const Contact *a, const Contact *b, CeldPoint p, double *t)
{
  double dx = b->back.x - a->back.x, dy = b->back.y - a->back.y, square = dx * dx + dy * dy;
  double length = sqrt (square), from, to, along, half;

  if (!(length > 0))
    return false;
  along = ((p.x - a->back.x) * dx + (p.y - a->back.y) * dy) / length;
  from  = ((a->at.x - a->back.x) * dx + (a->at.y - a->back.y) * dy) / length - a->reach - 3;
  to    = ((b->at.x - a->back.x) * dx + (b->at.y - a->back.y) * dy) / length + b->reach + 3;
  *t    = fmax (0, fmin (1, along / length));
  half  = 0.5 * (a->width + *t * (b->width - a->width)) + 0.25;
  return along >= from && along <= to && fabs ((p.x - a->back.x) * dy - (p.y - a->back.y) * dx) <= half * length;
}

/* Is a place in a band of a strand, or else of any other one?  Then *tint is what that has there. */
static bool
in_bands (const Joints *j, uint32_t strand, bool other, CeldPoint p, CeldTint *tint)
{
  for (size_t k = 0; k < j->n; k++)
    {
      const Contact *a = &j->item[k], *b;
      double         t;

      if (a->mate == CELD_NO_INDEX || a->mate < k || (celd_root (j->parent, a->piece) != strand) != other)
        continue;
      b = &j->item[a->mate];
      if (in_band (a, b, p, &t))
        {
          *tint = celd_tint_between (&a->tint, &b->tint, t);
          return true;
        }
    }
  return false;
}

/* Drops strands that lie in bands of others: they are what two translucent strokes have in common. */
static CeldStatus
drop_overlaps (Joints *j)
{
  const CeldPieces *s = &j->pieces;
  size_t           *all = celd_alloc0 (s->n + 1, sizeof *all), *covered = celd_alloc0 (s->n + 1, sizeof *covered);
  CeldStatus        status = all && covered ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < s->n_pixels && status == CELD_OK; i++)
    {
      uint32_t strand = celd_root (j->parent, s->piece[i]);
      CeldTint tint;

      all[strand]++;
      covered[strand] += in_bands (j, strand, true, middle_of (s, i), &tint);
    }
  for (size_t k = 1; k <= s->n && status == CELD_OK; k++)
    j->dropped[k] = (double) covered[k] >= COVERED * (double) all[k];
  celd_free (all);
  celd_free (covered);
  return status;
}

/* Are two contacts of different strands clearly of different colours?  Such as are not next to each other may be alike:
 * two strokes of one colour may cross a third. */
static bool
is_clear (const Joints *j, const Contact *a, const Contact *b, bool next)
{
  uint32_t s = celd_root (j->parent, a->piece), u = celd_root (j->parent, b->piece);
  double   differ;

  if (s == u || j->dropped[s] || j->dropped[u] || !(a->tint.strength > 0 && b->tint.strength > 0))
    return true;
  differ = celd_tints_differ (j->layer, &a->tint, &b->tint, CELD_LESS_NOISE);
  return differ >= CELD_UNLIKE || (!next && differ < CELD_ALIKE);
}

/* Are strands that meet clearly of different colours? */
static bool
colours_are_clear (const Joints *j)
{
  double near = FARTHEST * j->pieces.width + 12;

  for (size_t a = 0; a < j->n; a++)
    for (size_t b = a + 1; b < j->n; b++)
      if (hypot (j->item[a].at.x - j->item[b].at.x, j->item[a].at.y - j->item[b].at.y) <= near &&
          !is_clear (j, &j->item[a], &j->item[b], false))
        return false;
  for (size_t i = 0; i < j->pieces.n_pixels; i++)
    for (int k = 0; k < SQUARE * SQUARE && j->contact[i]; k++)
      {
        uint32_t other = pixel_near (&j->pieces, i, k % SQUARE - GATHERED, k / SQUARE - GATHERED);

        if (other && j->contact[other - 1] &&
            !is_clear (j, &j->item[j->contact[i] - 1], &j->item[j->contact[other - 1] - 1], true))
          return false;
      }
  return true;
}

/* ------------------------------------------------------------------ strands */

/* The strand that a pixel of no clear colour, at the rim of some, is most like; 0 if there is none. */
static uint32_t
rim_of (const Joints *j, size_t pixel)
{
  const CeldPieces *s = &j->pieces;
  CeldPoint         p = middle_of (s, pixel);
  CeldTint          t = celd_tint_at (j->layer, s->cutting.left + (int) p.x, s->cutting.top + (int) p.y);
  double            least = INFINITY;
  uint32_t          strand = 0;

  for (int k = 0; k < 9; k++)
    {
      uint32_t other = pixel_near (s, pixel, k % 3 - 1, k / 3 - 1);
      double   differ;

      if (!other || !s->piece[other - 1])
        continue;
      differ = celd_tints_differ (j->layer, &t, &s->tint[s->like[other - 1]], CELD_LESS_NOISE);
      if (differ < least)
        {
          least  = differ;
          strand = celd_root (j->parent, s->piece[other - 1]);
        }
    }
  return strand;
}

/* The largest connected part of what is marked with 1 stays. */
static CeldStatus
keep_largest (CeldLabels *marks, bool *most_of_it)
{
  CeldComponent *list = NULL;
  size_t         n = 0, all = 0, largest = 0;
  CeldStatus     status = celd_components (marks, 0, true, NULL, marks, &list, &n);

  if (status != CELD_OK)
    return status;
  for (size_t k = 0; k < n; k++)
    {
      all += list[k].area;
      largest = list[k].area > list[largest].area ? k : largest;
    }
  *most_of_it = n && (double) list[largest].area >= LEAST_JOINED * (double) all;
  for (size_t p = 0; p < marks->stride * (size_t) marks->height; p++)
    marks->data[p] = marks->data[p] == largest + 1;
  celd_free (list);
  return CELD_OK;
}

/* Appends the marked pixels, in the strand's own colours, and where others touch it. */
static CeldStatus
append (const Joints *j, const CeldTrail *trail, uint32_t strand, const CeldLabels *marks, CeldColourStrands *to)
{
  const CeldPieces  *s = &j->pieces;
  const CeldCutting *c = &s->cutting;
  CeldStrands       *all = &to->strands;
  size_t             n = all->first[all->n], n_touch = to->first_touch[all->n], row = (size_t) trail->width + 2;

  for (size_t i = 0; i < s->n_pixels; i++)
    {
      CeldPoint p = middle_of (s, i);
      int       x = c->left + (int) p.x, y = c->top + (int) p.y;
      CeldTint  tint;
      uint32_t *pixel;
      uint8_t  *rgba;

      if (!marks->data[s->place[i]])
        continue;
      pixel        = celd_grow (all->pixel, n + 1, sizeof *pixel);
      all->pixel   = pixel ? pixel : all->pixel;
      rgba         = pixel ? celd_grow (to->rgba, n + 1, 4) : NULL;
      to->rgba     = rgba ? rgba : to->rgba;
      if (!rgba)
        return CELD_NO_MEMORY;
      pixel[n] = (uint32_t) ((size_t) (y + 1) * row + (size_t) x + 1);
      if (in_bands (j, strand, false, p, &tint))
        celd_tint_paint (j->layer, &tint, rgba + 4 * n);
      else
        memcpy (rgba + 4 * n, celd_arrow_pixel (j->layer, x, y), 4);
      n++;
      if (j->contact[i] && celd_root (j->parent, s->piece[i]) == strand &&
          j->item[j->contact[i] - 1].mate == CELD_NO_INDEX)
        {
          CeldPoint *touch = celd_grow (to->touch, n_touch + 1, sizeof *touch);

          if (!touch)
            return CELD_NO_MEMORY;
          to->is_cut[all->n] |= !j->item[j->contact[i] - 1].passes;
          to->touch        = touch;
          touch[n_touch++] = (CeldPoint) { x + 0.5, y + 0.5 };
        }
    }
  all->first[++all->n]      = n;
  to->first_touch[all->n] = n_touch;
  return CELD_OK;
}

static CeldStatus
add_strand (Joints *j, const CeldTrail *trail, uint32_t strand, CeldColourStrands *to, bool *clear)
{
  const CeldPieces *s = &j->pieces;
  CeldLabels        marks = { 0 };
  CeldStatus        status = celd_labels_new (s->cutting.width, s->cutting.height, &marks);

  for (size_t i = 0; i < s->n_pixels && status == CELD_OK; i++)
    {
      uint32_t own = s->piece[i] ? celd_root (j->parent, s->piece[i]) : rim_of (j, i);
      CeldTint tint;

      marks.data[s->place[i]] = own == strand || in_bands (j, strand, false, middle_of (s, i), &tint);
    }
  if (status == CELD_OK)
    status = keep_largest (&marks, clear);
  if (status == CELD_OK && *clear)
    status = append (j, trail, strand, &marks, to);
  celd_free (marks.data);
  return status;
}

static CeldStatus
add_strands (Joints *j, const CeldTrail *trail, CeldColourStrands *to)
{
  bool       clear = true;
  CeldStatus status = CELD_OK;

  to->strands.first = celd_alloc0 (j->pieces.n + 1, sizeof *to->strands.first);
  to->first_touch   = celd_alloc0 (j->pieces.n + 1, sizeof *to->first_touch);
  to->is_cut          = celd_alloc0 (j->pieces.n + 1, sizeof *to->is_cut);
  if (!to->strands.first || !to->first_touch || !to->is_cut)
    return CELD_NO_MEMORY;
  for (uint32_t k = 1; k <= j->pieces.n && status == CELD_OK && clear; k++)
    if (celd_root (j->parent, k) == k && !j->dropped[k])
      status = add_strand (j, trail, k, to, &clear);
  if (!clear || to->strands.n < 2)
    to->strands.n = 0;
  return status;
}

CeldStatus
celd_strand_colours_find (const CeldTrail *trail, const CeldArrowLayer *layer, CeldColourStrands *found)
{
  Joints            j = { .layer = layer };
  CeldColourStrands made = { 0 };
  bool              many = false;
  CeldStatus        status = celd_colour_pieces_find (trail, layer, &j.pieces);

  if (status != CELD_OK || j.pieces.n < 2)
    goto done;
  j.parent  = celd_alloc (j.pieces.n + 1, sizeof *j.parent);
  j.dropped = celd_alloc0 (j.pieces.n + 1, sizeof *j.dropped);
  if (!j.parent || !j.dropped)
    {
      status = CELD_NO_MEMORY;
      goto done;
    }
  celd_roots (j.parent, j.pieces.n + 1);
  status = find_contacts (&j, &many);
  if (status != CELD_OK || many)
    goto done;
  for (uint32_t k = 0; k < j.n; k++)
    measure_arm (&j, &j.item[k], k);
  match_contacts (&j);
  status = drop_overlaps (&j);
  if (status == CELD_OK && colours_are_clear (&j))
    status = add_strands (&j, trail, &made);

done:
  joints_end (&j);
  if (status == CELD_OK)
    *found = made;
  else
    celd_strand_colours_clear (&made);
  return status;
}

void
celd_strand_colours_clear (CeldColourStrands *found)
{
  celd_strands_clear (&found->strands);
  celd_free (found->rgba);
  celd_free (found->touch);
  celd_free (found->first_touch);
  celd_free (found->is_cut);
  *found = (CeldColourStrands) { 0 };
}
