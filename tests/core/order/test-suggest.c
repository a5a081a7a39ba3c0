/* Orders suggested from drawings whose order is known.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "shapes.h"
#include "base/base.h"

#define PI 3.14159265358979323846

static const double lines[] = { 2, 3.5, 6, 10 };

static CeldRelations
suggest (const Scene *s)
{
  CeldRelations suggested = { 0 };

  CHECK (celd_suggest (&s->labels, &s->palette, &s->ink, NULL, NULL, &suggested) == CELD_OK);
  return suggested;
}

/* Opens a scene, and says whether each of these pairs, nearer and farther, gets its direction with this confidence. */
static void
expect (const Shape *shape, size_t n, double line, const uint32_t (*pair)[2], size_t n_pairs, double least)
{
  Scene         s;
  CeldRelations suggested;

  scene_open (200, 190, shape, n, line, &s);
  suggested = suggest (&s);
  for (size_t i = 0; i < n_pairs; i++)
    {
      double confidence = scene_confidence (&s, &suggested, pair[i][0], pair[i][1]);

      CHECK (confidence >= least);
      if (confidence < least)
        fprintf (stderr, "  pair %u > %u, line %g: %g\n", pair[i][0], pair[i][1], line, confidence);
    }
  celd_relations_clear (&suggested);
  scene_close (&s);
}

/* ------------------------------------------------------------------ what is known of each scene */

static void
overlapping_discs (void)
{
  static const uint32_t pairs[][2] = { { 3, 2 }, { 2, 1 }, { 3, 1 } };

  for (size_t l = 0; l < 4; l++)
    for (int k = 0; k < 24; k++)
      {
        double      u = cos (k * PI / 12), v = sin (k * PI / 12), x = 100.3, y = 95.4;
        const Shape shape[] = {
          page, { x - 30 * u, y - 30 * v, x - 30 * u, y - 30 * v, 45 }, { x + 30 * u, y + 30 * v, x + 30 * u,
          y + 30 * v, 45 }
        };

        expect (shape, 3, lines[l], pairs, 3, 0.5);
      }
}

static void
nested_discs (void)
{
  static const uint32_t pairs[][2] = { { 4, 3 }, { 3, 2 }, { 2, 1 } };
  const Shape           shape[] = {
    page, { 100, 95, 100, 95, 85 }, { 96, 99, 96, 99, 60 }, { 103, 92, 103, 92, 30 }
  };

  for (size_t l = 0; l < 4; l++)
    expect (shape, 4, lines[l], pairs, 3, 0.5);
}

/* In front of the body and behind it. */
static void
limb_and_body (void)
{
  static const uint32_t over[][2] = { { 3, 2 } }, under[][2] = { { 3, 2 } };

  for (size_t l = 0; l < 4; l++)
    for (int k = 0; k < 16; k++)
      {
        double      u = cos (k * PI / 8 + 0.1), v = sin (k * PI / 8 + 0.1);
        const Shape body = { 100, 95, 100, 95, 50 };
        const Shape limb = { 100 + 15 * u, 95 + 15 * v, 100 + 78 * u, 95 + 78 * v, 15 };

        expect ((const Shape[]) { page, body, limb }, 3, lines[l], over, 1, 0.5);
        expect ((const Shape[]) { page, limb, body }, 3, lines[l], under, 1, 0.5);
      }
}

/* Straight contours only: the T alone tells. */
static void
bar_of_a_t (void)
{
  static const uint32_t pairs[][2] = { { 3, 2 }, { 3, 1 } };

  for (size_t l = 0; l < 4; l++)
    for (int k = 0; k < 36; k++)
      for (int lean = -1; lean <= 1; lean++)
        {
          double        a = k * PI / 18, b = a + PI / 2 + lean * 0.5, far = 4000;
          double        stem_x = 100 + far * cos (b), stem_y = 95 + far * sin (b);
          double        bar_x = 100 + far * cos (a), bar_y = 95 + far * sin (a);
          const Shape   stem = { stem_x, stem_y, stem_x, stem_y, far }, bar = { bar_x, bar_y, bar_x, bar_y, far };
          Scene         s;
          CeldRelations suggested;

          scene_open (200, 190, (const Shape[]) { page, stem, bar }, 3, lines[l], &s);
          s.region[0].background = false;
          suggested = suggest (&s);
          for (int i = 0; i < 2; i++)
            CHECK (scene_confidence (&s, &suggested, pairs[i][0], pairs[i][1]) > 0);
          celd_relations_clear (&suggested);
          scene_close (&s);
        }
}

/* A line in the left part that ends at the border with the right one. */
static void
line_that_ends (void)
{
  static const char *const parts[] = { "AB", NULL };
  CeldLabels    half = art_labels (parts);
  Scene         s;
  CeldRelations suggested;

  for (int side = 0; side < 2; side++)
    {
      scene_open (120, 80, &page, 1, 4, &s);
      s.palette.n = 2;
      s.region[0].background = false;
      s.region[0].area = s.region[1].area = 4800;
      for (int y = 0; y < 80; y++)
        for (int x = 0; x < 120; x++)
          {
            CELD_AT (&s.labels, x, y) = half.data[x / 60];
            if ((x >= 58 && x < 62) || (y >= 38 && y < 42 && (side ? x >= 60 && x < 95 : x >= 25 && x < 60)))
              CELD_AT (&s.ink, x, y) = 0;
          }
      suggested = suggest (&s);
      CHECK (suggested.n == 1 && scene_at (&s, &suggested.item[0].nearer) == (side ? 1u : 2u));
      celd_relations_clear (&suggested);
      scene_close (&s);
    }
  free (half.data);
}

/* The page shows through a ring: what lies in it is not in front. */
static void
hole_of_a_ring (void)
{
  const Shape   shape[] = { page, { 100, 95, 100, 95, 80 }, { 100, 95, 100, 95, 45 } };
  Scene         s;
  CeldRelations suggested;

  scene_open (200, 190, shape, 3, 4, &s);
  for (int p = 0; p < 200 * 190; p++)
    s.labels.data[p] = s.labels.data[p] == 3 ? 1 : s.labels.data[p];
  suggested = suggest (&s);
  CHECK (suggested.n == 1 && scene_confidence (&s, &suggested, 2, 1) > 0.9);
  celd_relations_clear (&suggested);
  scene_close (&s);
}

/* ------------------------------------------------------------------ whatever the scene */

static void
random_scene (uint32_t *state, Scene *s)
{
  Shape  shape[10] = { page };
  size_t n = 2 + check_random (state, 8);
  double line = 2 + check_random (state, 60) / 10.0;

  for (size_t k = 1; k < n; k++)
    {
      double x = check_random (state, 200), y = check_random (state, 160), far = check_random (state, 3) ? 0 : 60;

      shape[k] = (Shape) { x, y, x + far * cos (x), y + far * sin (x), 10 + check_random (state, far > 0 ? 15 : 40) };
    }
  scene_open (200, 160, shape, n, line, s);
}

/* No way leads back to where it began. */
static bool
is_consistent (const Scene *s, const CeldRelations *suggested)
{
  bool before[MOST_SHAPES][MOST_SHAPES] = { { false } };

  for (size_t i = 0; i < suggested->n; i++)
    before[scene_at (s, &suggested->item[i].nearer)][scene_at (s, &suggested->item[i].farther)] = true;
  for (int k = 0; k < MOST_SHAPES; k++)
    for (int i = 0; i < MOST_SHAPES; i++)
      for (int j = 0; j < MOST_SHAPES; j++)
        before[i][j] |= before[i][k] && before[k][j];
  for (int k = 0; k < MOST_SHAPES; k++)
    if (before[k][k])
      return false;
  return true;
}

static void
random_scenes (void)
{
  uint32_t state = 5;
  int      given = 0, right = 0;

  for (int k = 0; k < 150; k++)
    {
      Scene         s;
      CeldRelations suggested;

      random_scene (&state, &s);
      suggested = suggest (&s);
      CHECK (is_consistent (&s, &suggested));
      for (size_t i = 0; i < suggested.n; i++)
        {
          const CeldRelation *r = &suggested.item[i];
          uint32_t            nearer = scene_at (&s, &r->nearer), farther = scene_at (&s, &r->farther);

          CHECK (r->weight > 0 && r->weight < 1 && r->source == CELD_SOURCE_SUGGESTION && !r->equal);
          CHECK (nearer != farther);
          CHECK (CELD_AT (&s.ink, (int) r->nearer.x, (int) r->nearer.y) >= 0.5f);
          CHECK (CELD_AT (&s.ink, (int) r->farther.x, (int) r->farther.y) >= 0.5f);
          CHECK (i == 0 || r->weight <= suggested.item[i - 1].weight);
          for (size_t j = 0; j < i; j++)
            CHECK (scene_at (&s, &suggested.item[j].nearer) != nearer ||
                   scene_at (&s, &suggested.item[j].farther) != farther);
          given += r->weight >= 0.5;
          right += r->weight >= 0.5 && nearer > farther;
        }
      celd_relations_clear (&suggested);
      scene_close (&s);
    }
  CHECK (given > 400 && 10 * right >= 9 * given);
}

/* Twice the picture says the same. */
static void
any_size (void)
{
  const Shape   small[] = { page, { 40, 40, 40, 40, 25 }, { 60, 45, 85, 60, 14 } };
  const Shape   large[] = { page, { 120, 120, 120, 120, 75 }, { 180, 135, 255, 180, 42 } };
  Scene         s, l;
  CeldRelations one, other;

  scene_open (110, 90, small, 3, 3, &s);
  scene_open (330, 270, large, 3, 9, &l);
  one   = suggest (&s);
  other = suggest (&l);
  CHECK (one.n == 3 && other.n == 3);
  for (uint32_t b = 1; b <= 2; b++)
    NEAR (scene_confidence (&s, &one, 3, b), scene_confidence (&l, &other, 3, b), 0.05);
  celd_relations_clear (&one);
  celd_relations_clear (&other);
  scene_close (&s);
  scene_close (&l);
}

/* ------------------------------------------------------------------ what is no drawing */

static void
odd_input (void)
{
  const Shape   shape[] = { page, { 20, 20, 20, 20, 12 } };
  Scene         s;
  CeldRelations suggested;
  CeldPalette   none = { 0 };

  scene_open (40, 40, shape, 2, 2, &s);
  suggested = (CeldRelations) { 0 };
  CHECK (celd_suggest (&s.labels, &none, &s.ink, NULL, NULL, &suggested) == CELD_OK && suggested.n == 0);
  CHECK (celd_suggest (&s.labels, &s.palette, NULL, NULL, NULL, &suggested) == CELD_OK && suggested.n == 1);
  for (int p = 0; p < 1600; p++)
    s.ink.data[p] = p % 3 ? NAN : 0;
  CHECK (celd_suggest (&s.labels, &s.palette, &s.ink, NULL, NULL, &suggested) == CELD_OK);
  for (int p = 0; p < 1600; p++)
    s.ink.data[p] = 0;
  CHECK (celd_suggest (&s.labels, &s.palette, &s.ink, NULL, NULL, &suggested) == CELD_OK);
  for (int p = 0; p < 1600; p += 7)
    s.labels.data[p] = p % 2 ? 0 : 4000000000u;
  CHECK (celd_suggest (&s.labels, &s.palette, &s.ink, NULL, NULL, &suggested) == CELD_OK);
  celd_relations_clear (&suggested);
  s.ink.width--;
  CHECK (celd_suggest (&s.labels, &s.palette, &s.ink, NULL, NULL, &suggested) == CELD_BAD_SIZE && !suggested.n);
  s.ink.width = s.ink.height = s.labels.width = s.labels.height = 1;
  CHECK (celd_suggest (&s.labels, &s.palette, &s.ink, NULL, NULL, &suggested) == CELD_OK && !suggested.n);
  s.labels.data[0] = 1;
  CHECK (celd_suggest (&s.labels, &s.palette, NULL, NULL, NULL, &suggested) == CELD_OK && !suggested.n);
  celd_relations_clear (&suggested);
  scene_close (&s);
}

static void
stops_when_asked (void)
{
  const Shape    shape[] = { page, { 20, 20, 20, 20, 12 } };
  const CeldHost host = { .progress = check_refuse };
  CeldRelations  suggested = { 0 };
  Scene          s;

  scene_open (40, 300, shape, 2, 2, &s);
  CHECK (celd_suggest (&s.labels, &s.palette, &s.ink, NULL, &host, &suggested) == CELD_CANCELLED && !suggested.n);
  celd_relations_clear (&suggested);
  scene_close (&s);
}

int
main (void)
{
  RUN (overlapping_discs);
  RUN (nested_discs);
  RUN (limb_and_body);
  RUN (bar_of_a_t);
  RUN (line_that_ends);
  RUN (hole_of_a_ring);
  RUN (random_scenes);
  RUN (any_size);
  RUN (odd_input);
  RUN (stops_when_asked);
  return DONE;
}
