/* Suggestions from a depth picture.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "shapes.h"
#include "base/base.h"

static const Shape shape[] = { { 0, 0, 0, 0, INFINITY }, { 40, 45, 40, 45, 25 }, { 75, 45, 75, 45, 25 } };

/* Opens three shapes and gives each this depth, with noise of this size. */
static CeldPlane
open_depth (const float depth[3], float noise, Scene *s)
{
  CeldPlane plane;
  uint32_t  state = 3;

  scene_open (120, 90, shape, 3, 3, s);
  s->region[0].background = false;
  CHECK (celd_plane_new (120, 90, &plane) == CELD_OK);
  for (int p = 0; p < 120 * 90; p++)
    plane.data[p] = depth[s->labels.data[p] - 1] + noise * ((float) check_random (&state, 2001) / 1000 - 1);
  return plane;
}

/* The confidence with which one is in front of the other by the depth picture alone. */
static double
compare (const Scene *s, const CeldPlane *depth, uint32_t a, uint32_t b)
{
  CeldRelations drawn = { 0 }, suggested = { 0 }, added;
  double        confidence;

  CHECK (celd_suggest (&s->labels, &s->palette, &s->ink, NULL, NULL, &drawn) == CELD_OK);
  CHECK (celd_suggest (&s->labels, &s->palette, &s->ink, depth, NULL, &suggested) == CELD_OK);
  CHECK (suggested.n >= drawn.n);
  for (size_t i = 0; i < drawn.n; i++) /* those of the drawing come first, unchanged */
    CHECK (!memcmp (&suggested.item[i], &drawn.item[i], sizeof drawn.item[i]));
  added      = (CeldRelations) { suggested.item + drawn.n, suggested.n - drawn.n };
  confidence = scene_confidence (s, &added, a, b);
  celd_relations_clear (&drawn);
  celd_relations_clear (&suggested);
  return confidence;
}

/* Whatever the unit; against what the lines say, too. */
static void
larger_is_nearer (void)
{
  static const float units[] = { 1, 100, 1e-4f };

  for (int k = 0; k < 3; k++)
    {
      const float depth[3] = { 1 * units[k], 5 * units[k], 3 * units[k] };
      Scene       s;
      CeldPlane   plane = open_depth (depth, 0, &s);

      CHECK (compare (&s, &plane, 2, 3) > 0.5 && compare (&s, &plane, 2, 1) > 0.5 && compare (&s, &plane, 3, 1) > 0.5);
      free (plane.data);
      scene_close (&s);
    }
}

/* A difference as large as both spreads together is worth one half; more of it more, but never certain. */
static void
margin_and_spread (void)
{
  double last = 0;

  for (int k = 1; k <= 6; k++)
    {
      const float depth[3] = { 0, 0.5f * (float) k, 0 };
      Scene       s;
      CeldPlane   plane = open_depth (depth, 1, &s); /* even noise from -1 to 1 lies half within 0.5 of its middle */
      double      confidence = compare (&s, &plane, 2, 3);

      CHECK (confidence > last && confidence < 0.9);
      if (k == 2)
        NEAR (confidence, 0.5, 0.03);
      last = k < 4 ? confidence : 0;
      free (plane.data);
      scene_close (&s);
    }
}

static void
unknown_depth (void)
{
  const float depth[3] = { 1, 2, 3 };
  Scene       s;
  CeldPlane   plane = open_depth (depth, 0, &s);

  for (int p = 0; p < 120 * 90; p++)
    if (s.labels.data[p] == 2 || p % 5 == 0)
      plane.data[p] = p % 2 ? NAN : INFINITY;
  CHECK (compare (&s, &plane, 2, 3) == 0 && compare (&s, &plane, 3, 1) > 0.5);
  for (int p = 0; p < 120 * 90; p++)
    plane.data[p] = 7;
  CHECK (compare (&s, &plane, 2, 3) == 0 && compare (&s, &plane, 3, 1) == 0);
  free (plane.data);
  scene_close (&s);
}

static void
bad_size (void)
{
  const float   depth[3] = { 1, 2, 3 };
  CeldRelations suggested = { 0 };
  Scene         s;
  CeldPlane     plane = open_depth (depth, 0, &s);

  plane.height--;
  CHECK (celd_suggest (&s.labels, &s.palette, &s.ink, &plane, NULL, &suggested) == CELD_BAD_SIZE && !suggested.n);
  free (plane.data);
  scene_close (&s);
}

int
main (void)
{
  RUN (larger_is_nearer);
  RUN (margin_and_spread);
  RUN (unknown_depth);
  RUN (bad_size);
  return DONE;
}
