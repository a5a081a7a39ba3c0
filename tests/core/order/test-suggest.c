/* Orders suggested from drawings whose order is known.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "sheets.h"
#include "base/base.h"

#define PI 3.14159265358979323846

static const double lines[] = { 2, 3.5, 6, 10 };

static CeldRelations
suggest (const Sheets *s)
{
  CeldRelations suggested = { 0 };

  CHECK (celd_suggest (&s->labels, &s->palette, &s->ink, NULL, NULL, &suggested) == CELD_OK);
  return suggested;
}

/* Opens a scene, and says whether each of these pairs, nearer and farther, gets its direction with this confidence. */
static void
expect (const Sheet *sheet, size_t n, double line, const uint32_t (*pair)[2], size_t n_pairs, double least)
{
  Sheets        s;
  CeldRelations suggested;

  sheets_open (200, 190, sheet, n, line, &s);
  suggested = suggest (&s);
  for (size_t i = 0; i < n_pairs; i++)
    {
      double confidence = sheets_confidence (&s, &suggested, pair[i][0], pair[i][1]);

      CHECK (confidence >= least);
      if (confidence < least)
        fprintf (stderr, "  pair %u > %u, line %g: %g\n", pair[i][0], pair[i][1], line, confidence);
    }
  celd_relations_clear (&suggested);
  sheets_close (&s);
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
        const Sheet sheet[] = {
          page, { x - 30 * u, y - 30 * v, x - 30 * u, y - 30 * v, 45 }, { x + 30 * u, y + 30 * v, x + 30 * u,
          y + 30 * v, 45 }
        };

        expect (sheet, 3, lines[l], pairs, 3, 0.5);
      }
}

static void
nested_discs (void)
{
  static const uint32_t pairs[][2] = { { 4, 3 }, { 3, 2 }, { 2, 1 } };
  const Sheet           sheet[] = {
    page, { 100, 95, 100, 95, 85 }, { 96, 99, 96, 99, 60 }, { 103, 92, 103, 92, 30 }
  };

  for (size_t l = 0; l < 4; l++)
    expect (sheet, 4, lines[l], pairs, 3, 0.5);
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
        const Sheet body = { 100, 95, 100, 95, 50 };
        const Sheet limb = { 100 + 15 * u, 95 + 15 * v, 100 + 78 * u, 95 + 78 * v, 15 };

        expect ((const Sheet[]) { page, body, limb }, 3, lines[l], over, 1, 0.5);
        expect ((const Sheet[]) { page, limb, body }, 3, lines[l], under, 1, 0.5);
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
          double      a = k * PI / 18, b = a + PI / 2 + lean * 0.5, far = 4000;
          const Sheet stem = { 100 + far * cos (b), 95 + far * sin (b), 100 + far * cos (b), 95 + far * sin (b), far };
          const Sheet bar = { 100 + far * cos (a), 95 + far * sin (a), 100 + far * cos (a), 95 + far * sin (a), far };
          Sheets        s;
          CeldRelations suggested;

          sheets_open (200, 190, (const Sheet[]) { page, stem, bar }, 3, lines[l], &s);
          s.region[0].background = false;
          suggested = suggest (&s);
          for (int i = 0; i < 2; i++)
            CHECK (sheets_confidence (&s, &suggested, pairs[i][0], pairs[i][1]) > 0);
          celd_relations_clear (&suggested);
          sheets_close (&s);
        }
}

/* A line in the left part that ends at the border with the right one. */
static void
line_that_ends (void)
{
  static const char *const parts[] = { "AB", NULL };
  CeldLabels    half = art_labels (parts);
  Sheets        s;
  CeldRelations suggested;

  for (int side = 0; side < 2; side++)
    {
      sheets_open (120, 80, &page, 1, 4, &s);
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
      CHECK (suggested.n == 1 && sheets_at (&s, &suggested.item[0].nearer) == (side ? 1u : 2u));
      celd_relations_clear (&suggested);
      sheets_close (&s);
    }
  free (half.data);
}

/* The page shows through a ring: what lies in it is not in front. */
static void
hole_of_a_ring (void)
{
  const Sheet   sheet[] = { page, { 100, 95, 100, 95, 80 }, { 100, 95, 100, 95, 45 } };
  Sheets        s;
  CeldRelations suggested;

  sheets_open (200, 190, sheet, 3, 4, &s);
  for (int p = 0; p < 200 * 190; p++)
    s.labels.data[p] = s.labels.data[p] == 3 ? 1 : s.labels.data[p];
  suggested = suggest (&s);
  CHECK (suggested.n == 1 && sheets_confidence (&s, &suggested, 2, 1) > 0.9);
  celd_relations_clear (&suggested);
  sheets_close (&s);
}

/* ------------------------------------------------------------------ whatever the scene */

static void
random_scene (uint32_t *state, Sheets *s)
{
  Sheet  sheet[10] = { page };
  size_t n = 2 + check_random (state, 8);
  double line = 2 + check_random (state, 60) / 10.0;

  for (size_t k = 1; k < n; k++)
    {
      double x = check_random (state, 200), y = check_random (state, 160), far = check_random (state, 3) ? 0 : 60;

      sheet[k] = (Sheet) { x, y, x + far * cos (x), y + far * sin (x), 10 + check_random (state, far > 0 ? 15 : 40) };
    }
  sheets_open (200, 160, sheet, n, line, s);
}

/* No way leads back to where it began. */
static bool
is_consistent (const Sheets *s, const CeldRelations *suggested)
{
  bool before[MOST_SHEETS][MOST_SHEETS] = { { false } };

  for (size_t i = 0; i < suggested->n; i++)
    before[sheets_at (s, &suggested->item[i].nearer)][sheets_at (s, &suggested->item[i].farther)] = true;
  for (int k = 0; k < MOST_SHEETS; k++)
    for (int i = 0; i < MOST_SHEETS; i++)
      for (int j = 0; j < MOST_SHEETS; j++)
        before[i][j] |= before[i][k] && before[k][j];
  for (int k = 0; k < MOST_SHEETS; k++)
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
      Sheets        s;
      CeldRelations suggested;

      random_scene (&state, &s);
      suggested = suggest (&s);
      CHECK (is_consistent (&s, &suggested));
      for (size_t i = 0; i < suggested.n; i++)
        {
          const CeldRelation *r = &suggested.item[i];
          uint32_t            nearer = sheets_at (&s, &r->nearer), farther = sheets_at (&s, &r->farther);

          CHECK (r->weight > 0 && r->weight < 1 && r->source == CELD_SOURCE_SUGGESTION && !r->equal);
          CHECK (nearer != farther);
          CHECK (CELD_AT (&s.ink, (int) r->nearer.x, (int) r->nearer.y) >= 0.5f);
          CHECK (CELD_AT (&s.ink, (int) r->farther.x, (int) r->farther.y) >= 0.5f);
          CHECK (i == 0 || r->weight <= suggested.item[i - 1].weight);
          for (size_t j = 0; j < i; j++)
            CHECK (sheets_at (&s, &suggested.item[j].nearer) != nearer ||
                   sheets_at (&s, &suggested.item[j].farther) != farther);
          given += r->weight >= 0.5;
          right += r->weight >= 0.5 && nearer > farther;
        }
      celd_relations_clear (&suggested);
      sheets_close (&s);
    }
  CHECK (given > 400 && 10 * right >= 9 * given);
}

/* Twice the picture says the same. */
static void
any_size (void)
{
  const Sheet   small[] = { page, { 40, 40, 40, 40, 25 }, { 60, 45, 85, 60, 14 } };
  const Sheet   large[] = { page, { 120, 120, 120, 120, 75 }, { 180, 135, 255, 180, 42 } };
  Sheets        s, l;
  CeldRelations one, other;

  sheets_open (110, 90, small, 3, 3, &s);
  sheets_open (330, 270, large, 3, 9, &l);
  one   = suggest (&s);
  other = suggest (&l);
  CHECK (one.n == 3 && other.n == 3);
  for (uint32_t b = 1; b <= 2; b++)
    NEAR (sheets_confidence (&s, &one, 3, b), sheets_confidence (&l, &other, 3, b), 0.05);
  celd_relations_clear (&one);
  celd_relations_clear (&other);
  sheets_close (&s);
  sheets_close (&l);
}

/* ------------------------------------------------------------------ what is no drawing */

static void
odd_input (void)
{
  const Sheet   sheet[] = { page, { 20, 20, 20, 20, 12 } };
  Sheets        s;
  CeldRelations suggested;
  CeldPalette   none = { 0 };

  sheets_open (40, 40, sheet, 2, 2, &s);
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
  sheets_close (&s);
}

static void
stops_when_asked (void)
{
  const Sheet    sheet[] = { page, { 20, 20, 20, 20, 12 } };
  const CeldHost host = { .progress = check_refuse };
  CeldRelations  suggested = { 0 };
  Sheets         s;

  sheets_open (40, 300, sheet, 2, 2, &s);
  CHECK (celd_suggest (&s.labels, &s.palette, &s.ink, NULL, &host, &suggested) == CELD_CANCELLED && !suggested.n);
  celd_relations_clear (&suggested);
  sheets_close (&s);
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
