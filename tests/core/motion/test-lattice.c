/* Lattices: cells and vertices on pictures written as text, cracks, silhouettes, and shapes that are as rigid as
 * possible.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 * /
 */
#include "check.h"
#include "motion/motion.h"

#define MOST 64

/* ------------------------------------------------------------------ lattices of label pictures */

/* Labels 1 .. n have these levels; cells have a side of 8. */
static CeldStatus
embed (const CeldLabels *labels, const uint32_t *level, size_t n, uint32_t background, const CeldCrack *crack,
       size_t n_cracks, CeldLattice **lattice)
{
  static float    paper[MOST * MOST];
  CeldPlane       ink = { labels->width, labels->height, (size_t) labels->width, paper };
  CeldMovingParts parts = { labels, level, n, background, crack, n_cracks };
  CeldSettings    settings = celd_settings ();

  settings.cell_size = 8;
  return celd_lattice_new (&ink, &parts, &settings, NULL, lattice);
}

/* A picture of size x size pixels that is label 1 left of column `border`, label 2 right of it. */
static CeldLabels
two_parts (int size, int border)
{
  static uint32_t data[MOST * MOST];
  CeldLabels      labels = { size, size, (size_t) size, data };

  for (int p = 0; p < size * size; p++)
    data[p] = p % size < border ? 1 : 2;
  return labels;
}

static void
whole_squares_share_vertices (void)
{
  static const uint32_t equal[2] = { 3, 3 };
  CeldLabels            labels = two_parts (32, 13);
  CeldLattice          *lattice = NULL;

  CHECK (embed (&labels, equal, 2, 0, NULL, 0, &lattice) == CELD_OK);
  CHECK (lattice->n_cells == 16 && lattice->n_vertices == 25 && lattice->n_seams == 0 && lattice->n_pieces == 1);
  for (int y = 0; y < 32; y++)
    for (int x = 0; x < 32; x++)
      {
        uint32_t c = celd_lattice_cell (lattice, x, y);
        float    at[2];

        CHECK (c > 0);
        celd_cell_map (lattice, c - 1, (float) x + 0.3f, (float) y + 0.7f, at);
        NEAR (at[0], x + 0.3, 1e-4);
        NEAR (at[1], y + 0.7, 1e-4);
      }
  celd_lattice_free (lattice);
}

/* Levels that differ tear; a crack inside squares makes two cells of each. */
static void
cracks_make_vertices_of_their_own (void)
{
  static const uint32_t level[2] = { 0, 1 };
  static const struct { int border; size_t cells, vertices; } KNOWN[] = { { 16, 16, 15 + 15 }, { 13, 20, 15 + 20 } };

  for (size_t i = 0; i < 2; i++)
    {
      CeldLabels   labels = two_parts (32, KNOWN[i].border);
      CeldLattice *lattice = NULL;

      CHECK (embed (&labels, level, 2, 0, NULL, 0, &lattice) == CELD_OK);
      CHECK (lattice->n_cells == KNOWN[i].cells && lattice->n_vertices == KNOWN[i].vertices);
      CHECK (lattice->n_pieces == 2 && lattice->n_seams == (i ? 10 : 5));
      for (size_t s = 0; s < 2 * lattice->n_seams; s += 2)
        CHECK (!memcmp (lattice->rest + 2 * lattice->seam[s], lattice->rest + 2 * lattice->seam[s + 1],
                        2 * sizeof (float)));
      for (size_t c = 0; c < lattice->n_cells; c++)
        CHECK (lattice->level[c] == level[lattice->label[c] - 1]);
      CHECK (lattice->label[celd_lattice_cell (lattice, 12, 20) - 1] == 1);
      CHECK (lattice->label[celd_lattice_cell (lattice, 16, 20) - 1] == 2);
      celd_lattice_free (lattice);
    }
}

/* Marked cracks are the only ones; and the part that both sides hang on to keeps all in one piece. */
static void
marked_cracks_are_the_only_ones (void)
{
  static const uint32_t  level[3] = { 0, 1, 2 };
  static const CeldCrack crack[1] = { { 2, 1 } };
  CeldLabels             labels = two_parts (32, 16);
  CeldLattice           *lattice = NULL;

  for (int p = 0; p < 32 * 8; p++)
    labels.data[p] = 3;
  CHECK (embed (&labels, level, 3, 0, crack, 1, &lattice) == CELD_OK);
  CHECK (lattice->n_cells == 16 && lattice->n_pieces == 1);
  CHECK (lattice->n_vertices == 25 + 3); /* the crack ends in the row below label 3, where all are joined */
  CHECK (lattice->n_seams == 3);
  celd_lattice_free (lattice);
  CHECK (embed (&labels, level, 3, 0, NULL, 0, &lattice) == CELD_OK);
  CHECK (lattice->n_pieces == 3);
  celd_lattice_free (lattice);
}

static void
background_has_no_cells (void)
{
  static const uint32_t level[2] = { 0, 1 };
  CeldLabels            labels = two_parts (32, 16);
  CeldLattice          *lattice = NULL;

  labels.data[31 * 32 + 31] = 0;
  CHECK (embed (&labels, level, 2, 1, NULL, 0, &lattice) == CELD_OK);
  CHECK (lattice->n_cells == 8 && celd_lattice_cell (lattice, 15, 3) == 0 && celd_lattice_cell (lattice, 31, 31) == 0);
  celd_lattice_free (lattice);
}

/* A few pixels of another level are no cell of their own. */
static void
specks_belong_to_their_square (void)
{
  static const uint32_t level[2] = { 0, 1 };
  CeldLabels            labels = two_parts (32, 32);
  CeldLattice          *lattice = NULL;

  labels.data[12 * 32 + 12] = labels.data[12 * 32 + 13] = labels.data[4 * 32 + 31] = 2;
  CHECK (embed (&labels, level, 2, 0, NULL, 0, &lattice) == CELD_OK);
  CHECK (lattice->n_cells == 16 && lattice->n_vertices == 25 && lattice->n_pieces == 1);
  CHECK (celd_lattice_cell (lattice, 12, 12) == celd_lattice_cell (lattice, 11, 12));
  celd_lattice_free (lattice);
}

static void
bad_input_is_refused (void)
{
  static const uint32_t level[2] = { 0, 1 };
  CeldLabels            labels = two_parts (32, 16);
  CeldLattice          *lattice = NULL;
  static float          paper[MOST * MOST];
  CeldPlane             ink = { 31, 32, 31, paper };
  CeldMovingParts       parts = { &labels, level, 2, 0, NULL, 0 };
  CeldSettings          settings = celd_settings ();

  CHECK (embed (&labels, level, 1, 0, NULL, 0, &lattice) == CELD_BAD_VALUE);
  CHECK (celd_lattice_new (&ink, &parts, &settings, NULL, &lattice) == CELD_BAD_SIZE);
  for (int p = 0; p < 32 * 32; p++)
    labels.data[p] = 0;
  CHECK (embed (&labels, level, 2, 0, NULL, 0, &lattice) == CELD_NOTHING_TO_GO_BY);
  for (int p = 0; p < MOST * MOST; p++)
    paper[p] = p % 2 ? NAN : 1;
  CHECK (celd_lattice_new (&ink, NULL, &settings, NULL, &lattice) == CELD_NOTHING_TO_GO_BY);
  CHECK (!lattice);
}

/* ------------------------------------------------------------------ silhouettes */

/* Without parts an outline with a gap has an inside, and what is around it does not move. */
static void
open_outlines_have_an_inside (void)
{
  static float data[MOST * MOST];
  CeldPlane    ink = { MOST, MOST, MOST, data };
  CeldLabels   label = { 0 };

  for (int y = 0; y < MOST; y++)
    for (int x = 0; x < MOST; x++)
      {
        double d = fabs (hypot (x - 31.5, y - 31.5) - 20);

        data[y * MOST + x] = d < 1.2 && !(x > 31 && abs (y - 31) < 3) ? 0.f : 1.f;
      }
  CHECK (celd_silhouette (&ink, NULL, 8, NULL, &label) == CELD_OK);
  CHECK (label.data[31 * MOST + 31] == 1 && label.data[31 * MOST + 45] == 1);
  for (int p = 0; p < MOST * MOST && label.data; p++)
    {
      double r = hypot (p % MOST - 31.5, p / MOST - 31.5);

      CHECK (r > 17 || label.data[p] == 1);
      CHECK (r < 22 || label.data[p] == 0);
    }
  celd_free (label.data);
}

/* ------------------------------------------------------------------ shapes */

/* A part bent out of shape at random becomes congruent with its rest pose; one that is only turned stays. */
static void
relaxed_shapes_are_rigid (void)
{
  static const uint32_t level[2] = { 0, 0 };
  CeldLabels            labels = two_parts (48, 24);
  CeldLattice          *lattice = NULL;
  uint32_t              state = 7;
  float                *scratch;

  for (int p = 0; p < 24 * 48; p++)
    if (p % 48 >= 24)
      labels.data[p] = 0;
  CHECK (embed (&labels, level, 2, 0, NULL, 0, &lattice) == CELD_OK);
  scratch = malloc (3 * lattice->n_vertices * sizeof *scratch);
  for (int noise = 0; noise < 2; noise++)
    {
      double worst = 0, moved = 0;

      for (size_t v = 0; v < lattice->n_vertices; v++)
        {
          float x = lattice->rest[2 * v], y = lattice->rest[2 * v + 1];

          lattice->place[2 * v]     = 0.6f * x - 0.8f * y + 5 + (float) (noise * (int) check_random (&state, 9));
          lattice->place[2 * v + 1] = 0.8f * x + 0.6f * y - 3 + (float) (noise * (int) check_random (&state, 9));
        }
      celd_lattice_relax (lattice, 2000, NULL, 0, scratch);
      for (size_t a = 0; a < lattice->n_vertices; a++)
        for (size_t b = 0; b < a; b++)
          {
            const float *r = lattice->rest, *p = lattice->place;

            worst = fmax (worst, fabs (hypot ((double) (p[2 * a] - p[2 * b]), (double) (p[2 * a + 1] - p[2 * b + 1])) -
                                       hypot ((double) (r[2 * a] - r[2 * b]), (double) (r[2 * a + 1] - r[2 * b + 1]))));
          }
      for (size_t v = 0; v < lattice->n_vertices; v++)
        moved = fmax (moved, fabs ((double) (lattice->place[2 * v] - (0.6f * lattice->rest[2 * v] -
                                                                      0.8f * lattice->rest[2 * v + 1] + 5))));
      NEAR (worst, 0, 0.01);
      CHECK (noise || moved < 0.01);
      for (size_t c = 0; c < lattice->n_cells; c++)
        NEAR (celd_cell_area (lattice, c), 1, 1e-3);
    }
  free (scratch);
  celd_lattice_free (lattice);
}

/* One vertex that is pulled takes all of its piece along, and leaves another piece where it was. */
static void
pulls_move_their_piece (void)
{
  static const uint32_t level[2] = { 0, 1 };
  CeldLabels            labels = two_parts (32, 16);
  CeldLattice          *lattice = NULL;
  CeldPull             *pull;
  float                *scratch;
  uint32_t              first;

  CHECK (embed (&labels, level, 2, 0, NULL, 0, &lattice) == CELD_OK);
  scratch = malloc (3 * lattice->n_vertices * sizeof *scratch);
  pull    = calloc (lattice->n_vertices, sizeof *pull);
  first   = lattice->corner[0];
  pull[first] = (CeldPull) { 30, 40, 1 };
  celd_lattice_relax (lattice, 3000, pull, 0, scratch);
  NEAR (lattice->place[2 * first], 30, 0.1);
  NEAR (lattice->place[2 * first + 1], 40, 0.1);
  for (size_t c = 0; c < lattice->n_cells; c++)
    NEAR (celd_cell_area (lattice, c), 1, 0.01);
  for (size_t k = 0; k < 4 * lattice->n_cells; k++)
    {
      size_t v = lattice->corner[k];

      if (lattice->piece[k / 4] != lattice->piece[0])
        NEAR (lattice->place[2 * v], lattice->rest[2 * v], 1e-3);
    }
  free (scratch);
  free (pull);
  celd_lattice_free (lattice);
}

/* ------------------------------------------------------------------ levels, cracks, pictures */

/* Levels of any numbers tear where they differ; the farthest, which has the frame, does not move. */
static void
levels_make_a_lattice (void)
{
  static float  ink_data[MOST * MOST], level[MOST * MOST];
  CeldPlane     ink = { MOST, MOST, MOST, ink_data }, levels = { MOST, MOST, MOST, level };
  CeldSettings  settings = celd_settings ();
  CeldLattice  *lattice = NULL;

  settings.cell_size = 8;
  for (int y = 0; y < MOST; y++)
    for (int x = 0; x < MOST; x++)
      {
        bool in = x >= 8 && x < 56 && y >= 8 && y < 56, right = x >= 32;

        ink_data[y * MOST + x] = in && (x == 8 || x == 55 || y == 8 || y == 55 || x == 32) ? 0.f : 1.f;
        level[y * MOST + x]    = !in ? -3.f : right ? 7.5f : 0.25f;
      }
  CHECK (celd_lattice_of_levels (&ink, &levels, NULL, &settings, NULL, &lattice) == CELD_OK);
  CHECK (lattice && lattice->n_pieces == 2 && celd_lattice_cell (lattice, 2, 2) == 0);
  CHECK (lattice && lattice->level[celd_lattice_cell (lattice, 20, 30) - 1] <
                    lattice->level[celd_lattice_cell (lattice, 45, 30) - 1]);
  celd_lattice_free (lattice);
  levels.width--;
  CHECK (celd_lattice_of_levels (&ink, &levels, NULL, &settings, NULL, &lattice) == CELD_BAD_SIZE);
}

/* A turn by a right angle takes each pixel to exactly one other; a nearer part covers a farther one. */
static void
warped_pictures_are_exact_for_whole_pixels (void)
{
  static const uint32_t level[2] = { 0, 1 };
  static float          art_data[4 * 32 * 32], warped_data[4 * 32 * 32];
  CeldColours           art = { 32, 32, 32, art_data }, warped = { 32, 32, 32, warped_data };
  CeldLabels            labels = two_parts (32, 16);
  CeldLattice          *lattice = NULL;
  uint32_t              state = 5;

  for (int i = 0; i < 4 * 32 * 32; i++)
    art_data[i] = i % 4 == 3 ? 1 : (float) check_random (&state, 256) / 255;
  CHECK (embed (&labels, level, 2, 0, NULL, 0, &lattice) == CELD_OK);
  CHECK (celd_lattice_warp (lattice, &art, &warped) == CELD_OK);
  for (int i = 0; i < 4 * 32 * 32; i++)
    NEAR (warped_data[i], art_data[i], 1e-5);
  for (size_t v = 0; v < lattice->n_vertices; v++)
    {
      lattice->place[2 * v]     = 32 - lattice->rest[2 * v + 1];
      lattice->place[2 * v + 1] = lattice->rest[2 * v];
    }
  CHECK (celd_lattice_warp (lattice, &art, &warped) == CELD_OK);
  for (int p = 0; p < 32 * 32; p++)
    for (int c = 0; c < 4; c++)
      NEAR (warped_data[4 * p + c], art_data[4 * ((31 - p % 32) * 32 + p / 32) + c], 1e-4);
  for (size_t k = 0; k < 4 * lattice->n_cells; k++)
    {
      size_t v = lattice->corner[k];

      lattice->place[2 * v]     = lattice->rest[2 * v] - (lattice->label[k / 4] == 2 ? 16 : 0);
      lattice->place[2 * v + 1] = lattice->rest[2 * v + 1];
    }
  CHECK (celd_lattice_warp (lattice, &art, &warped) == CELD_OK);
  for (int p = 0; p < 32 * 32; p++)
    for (int c = 0; c < 4; c++)
      NEAR (warped_data[4 * p + c], p % 32 < 16 ? art_data[4 * (p + 16) + c] : 0, 1e-5);
  warped.width = 31;
  CHECK (celd_lattice_warp (lattice, &art, &warped) == CELD_BAD_SIZE);
  celd_lattice_free (lattice);
}

int
main (void)
{
  RUN (whole_squares_share_vertices);
  RUN (cracks_make_vertices_of_their_own);
  RUN (marked_cracks_are_the_only_ones);
  RUN (background_has_no_cells);
  RUN (specks_belong_to_their_square);
  RUN (bad_input_is_refused);
  RUN (open_outlines_have_an_inside);
  RUN (relaxed_shapes_are_rigid);
  RUN (pulls_move_their_piece);
  RUN (levels_make_a_lattice);
  RUN (warped_pictures_are_exact_for_whole_pixels);
  return DONE;
}
