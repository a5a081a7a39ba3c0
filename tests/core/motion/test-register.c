/* Registration of drawn figures whose motion is known: their outlines are moved exactly, then drawn again.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "motion/motion.h"

#define SIDE  300
#define PIXELS (SIDE * SIDE)
#define MOST  400
#define PEN   1.3

/* ------------------------------------------------------------------ figures */

typedef struct { double x, y; } DrawnSpot;

/* A polygon, filled with paper over what is behind it. */
typedef struct { DrawnSpot spot[MOST]; int n; bool open; } DrawnShape;

typedef struct { float ink[PIXELS]; uint32_t label[PIXELS]; } Picture;

/* A blob whose radius varies, and with it its outline. */
static DrawnShape
blob (double x, double y, double radius, uint32_t seed)
{
  DrawnShape shape = { .n = 90 };

  for (int i = 0; i < shape.n; i++)
    {
      double   a = 2 * CELD_PI * i / shape.n, r = radius;
      uint32_t state = seed;

      for (int k = 2; k < 6; k++)
        r += radius * 0.12 / (k - 1) * cos (k * a + check_random (&state, 628) / 100.0);
      shape.spot[i] = (DrawnSpot) { x + r * cos (a), y + 0.8 * r * sin (a) };
    }
  return shape;
}

/* A rounded stick between two places. */
static DrawnShape
stick (double x0, double y0, double x1, double y1, double radius)
{
  DrawnShape  shape = { .n = 60 };
  double along = atan2 (y1 - y0, x1 - x0);

  for (int i = 0; i < shape.n; i++)
    {
      double a = along + CELD_PI / 2 + CELD_PI * (i % 30) / 29 + (i < 30 ? 0 : CELD_PI);

      shape.spot[i] = (DrawnSpot) { (i < 30 ? x0 : x1) + radius * cos (a), (i < 30 ? y0 : y1) + radius * sin (a) };
    }
  return shape;
}

static DrawnShape
stroke (double x0, double y0, double x1, double y1)
{
  return (DrawnShape) { .n = 2, .open = true, .spot = { { x0, y0 }, { x1, y1 } } };
}

/* Distance to the outline, negative inside. */
static double
distance (const DrawnShape *shape, double x, double y)
{
  double least = INFINITY;
  bool   inside = false;

  for (int i = shape->open ? 1 : 0, j = shape->open ? 0 : shape->n - 1; i < shape->n; j = i++)
    {
      DrawnSpot   a = shape->spot[j], b = shape->spot[i];
      double dx = b.x - a.x, dy = b.y - a.y, t = ((x - a.x) * dx + (y - a.y) * dy) / fmax (dx * dx + dy * dy, 1e-9);

      t      = fmax (0, fmin (1, t));
      least  = fmin (least, hypot (x - a.x - t * dx, y - a.y - t * dy));
      inside ^= !shape->open && (a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * dx;
    }
  return inside ? -least : least;
}

/* Draws shapes from back to front; each pixel has the number of the shape that it belongs to. */
static void
draw (const DrawnShape *shape, int n, Picture *picture)
{
  for (int p = 0; p < PIXELS; p++)
    {
      picture->ink[p]   = 1;
      picture->label[p] = 0;
    }
  for (int k = 0; k < n; k++)
    for (int p = 0; p < PIXELS; p++)
      {
        double d = distance (&shape[k], p % SIDE + 0.5, p / SIDE + 0.5);

        if (d >= PEN + 0.5)
          continue;
        picture->ink[p] = (float) fmax (0, fmin (1, fabs (d) - PEN + 0.5));
        if (!shape[k].open && d < PEN)
          picture->label[p] = (uint32_t) k + 1;
      }
}

static CeldPlane
ink_of (Picture *picture)
{
  return (CeldPlane) { SIDE, SIDE, SIDE, picture->ink };
}

/* ------------------------------------------------------------------ motions */

typedef struct { double turn, x, y, bend; } Motion;

/* Turns about the centre, shifts, and bends: the turn grows along x. */
static DrawnSpot
moved (const Motion *m, DrawnSpot p)
{
  double x = p.x - SIDE / 2, y = p.y - SIDE / 2, a = m->turn + m->bend * x / SIDE;

  return (DrawnSpot) { SIDE / 2 + cos (a) * x - sin (a) * y + m->x, SIDE / 2 + sin (a) * x + cos (a) * y + m->y };
}

static DrawnShape
moved_shape (const Motion *m, DrawnShape shape)
{
  for (int i = 0; i < shape.n; i++)
    shape.spot[i] = moved (m, shape.spot[i]);
  return shape;
}

/* Whether a label is what a picture shows at a place. */
static bool
shows (const Picture *picture, DrawnSpot at, uint32_t label)
{
  return at.x >= 0 && at.y >= 0 && at.x < SIDE && at.y < SIDE && picture->label[(int) at.y * SIDE + (int) at.x] == label;
}

/* The mean distance between the true places of pixels with a label and those of the lattice; of pixels that are visible
 * in both pictures. */
static double
error_of (const CeldLattice *lattice, const Picture *from, const Picture *to, const Motion *of_label)
{
  double sum = 0, n = 0;

  for (int p = 0; p < PIXELS; p++)
    {
      uint32_t  label = from->label[p], c = lattice->cell[p];
      DrawnSpot at = { p % SIDE + 0.5, p / SIDE + 0.5 }, there = moved (&of_label[label], at);
      float     place[2] = { (float) at.x, (float) at.y };

      if (!label || !shows (to, there, label))
        continue;
      if (c)
        celd_cell_map (lattice, c - 1, place[0], place[1], place);
      sum += hypot ((double) place[0] - there.x, (double) place[1] - there.y);
      n++;
    }
  return sum / n;
}

static CeldLattice *
registered (Picture *from, Picture *to, const uint32_t *level, size_t n, const CeldHost *host)
{
  CeldPlane       source = ink_of (from), target = ink_of (to);
  CeldLabels      labels = { SIDE, SIDE, SIDE, from->label };
  CeldMovingParts parts = { .labels = &labels, .level = level, .n = n };
  CeldSettings    settings = celd_settings ();
  CeldLattice    *lattice = NULL;

  settings.cell_size = 12;
  CHECK (celd_lattice_new (&source, level ? &parts : NULL, &settings, host, &lattice) == CELD_OK);
  CHECK (celd_register (&source, &target, &settings, host, lattice, NULL) == CELD_OK);
  return lattice;
}

/* ------------------------------------------------------------------ tests */

/* A blob with eyes and mouth. */
static int
face (uint32_t seed, DrawnShape *shape)
{
  shape[0] = blob (150, 150, 80, seed);
  shape[1] = stroke (120, 130, 126, 142);
  shape[2] = stroke (170, 128, 168, 142);
  shape[3] = blob (152, 160, 10, seed + 1);
  shape[4] = stroke (125, 185, 175, 180);
  return 5;
}

static void
known_motion_is_found (void)
{
  static Picture from, to;
  uint32_t       state = 3;

  for (uint32_t i = 0; i < 4; i++)
    {
      Motion       m[6];
      DrawnShape        shape[5], other[5];
      CeldLattice *lattice;
      int          n = face (i, shape);

      m[0] = (Motion) { (check_random (&state, 50) - 25.0) * CELD_RADIANS, check_random (&state, 60) - 30.0,
                        check_random (&state, 60) - 30.0, check_random (&state, 15) * CELD_RADIANS };
      for (int k = 0; k < n; k++)
        {
          m[k + 1] = m[0];
          other[k] = moved_shape (&m[0], shape[k]);
        }
      draw (shape, n, &from);
      draw (other, n, &to);
      lattice = registered (&from, &to, NULL, 0, NULL);
      NEAR (error_of (lattice, &from, &to, m), 0, 1.5);
      celd_lattice_free (lattice);
    }
}

static void
identity_is_no_motion (void)
{
  static Picture from;
  DrawnShape          shape[5];
  CeldLattice   *lattice;
  static float   shift[2 * PIXELS];
  CeldShifts     shifts = { SIDE, SIDE, SIDE, shift };
  float          most = 0;

  draw (shape, face (5, shape), &from);
  lattice = registered (&from, &from, NULL, 0, NULL);
  CHECK (celd_lattice_displacement (lattice, &shifts) == CELD_OK);
  for (int i = 0; i < 2 * PIXELS; i++)
    most = fmaxf (most, fabsf (shift[i]));
  NEAR (most, 0, 0.01);
  celd_lattice_free (lattice);
}

/* A face with an arm over it, before and after the arm swings about its shoulder by `degrees`.  Labels: 1 and 4 are the
 * face, 6 is the arm. */
static void
swing (double degrees, Picture *from, Picture *to, Motion of_label[7])
{
  double a = degrees * CELD_RADIANS, x = 80 - SIDE / 2, y = 190 - SIDE / 2;
  Motion m = { a, x - cos (a) * x + sin (a) * y, y - sin (a) * x - cos (a) * y, 0 };
  DrawnShape  shape[6];
  int    n = face (9, shape);

  for (int k = 0; k <= n; k++)
    of_label[k] = (Motion) { 0 };
  of_label[n + 1] = m;
  shape[n] = stick (80, 190, 165, 165, 13);
  draw (shape, n + 1, from);
  shape[n] = moved_shape (&m, shape[n]);
  draw (shape, n + 1, to);
}

/* A limb moves over the face: with levels the mean error is at most half of that without them. */
static void
levels_keep_limbs_apart (void)
{
  static const uint32_t level[6] = { 0, 0, 0, 0, 0, 1 };
  static const double   degrees[3] = { 12, 20, -15 };
  static Picture        from, to;
  Motion                m[7];
  double                sum[2] = { 0, 0 };

  for (int i = 0; i < 3; i++)
    {
      swing (degrees[i], &from, &to, m);
      for (int with = 0; with < 2; with++)
        {
          CeldLattice *lattice = registered (&from, &to, with ? level : NULL, 6, NULL);
          double       error = error_of (lattice, &from, &to, m);

          CHECK (!with || error <= 2);
          sum[with] += error;
          celd_lattice_free (lattice);
        }
    }
  CHECK (sum[1] <= 0.5 * sum[0]);
}

/* Jobs in another order give the same, bit by bit; so do two calls. */
static void
results_do_not_depend_on_threads (void)
{
  static const uint32_t level[6] = { 0, 0, 0, 0, 0, 1 };
  static Picture        from, to;
  Motion                m[7];
  CeldHost              backwards = { .each = check_backwards };
  CeldLattice          *one, *other;

  swing (15, &from, &to, m);
  one   = registered (&from, &to, level, 6, NULL);
  other = registered (&from, &to, level, 6, &backwards);
  CHECK (one->n_vertices == other->n_vertices);
  CHECK (!memcmp (one->place, other->place, 2 * one->n_vertices * sizeof (float)));
  celd_lattice_free (one);
  celd_lattice_free (other);
}

static void
bad_input_is_refused (void)
{
  static const uint32_t level[6] = { 0, 0, 0, 0, 0, 1 };
  static Picture        from, to;
  Motion                m[7];
  CeldLattice          *lattice;
  CeldSettings          settings = celd_settings ();
  CeldPlane             source = ink_of (&from), target = ink_of (&to), narrow = target;
  static float          confidence[PIXELS];
  CeldPlane             sure = { SIDE, SIDE, SIDE, confidence };
  float                *before;

  swing (10, &from, &to, m);
  lattice = registered (&from, &to, level, 6, NULL);
  before  = malloc (2 * lattice->n_vertices * sizeof *before);
  memcpy (before, lattice->place, 2 * lattice->n_vertices * sizeof *before);
  narrow.width--;
  CHECK (celd_register (&source, &narrow, &settings, NULL, lattice, NULL) == CELD_BAD_SIZE);
  CHECK (celd_register (&narrow, &narrow, &settings, NULL, lattice, NULL) == CELD_BAD_SIZE);
  settings.stiffness = 0;
  CHECK (celd_register (&source, &target, &settings, NULL, lattice, NULL) == CELD_BAD_VALUE);
  settings = celd_settings ();
  CHECK (celd_register (&source, &target, &settings, &(CeldHost) { .progress = check_refuse }, lattice, NULL)
           == CELD_CANCELLED);
  CHECK (!memcmp (before, lattice->place, 2 * lattice->n_vertices * sizeof *before));
  for (int p = 0; p < PIXELS; p += 3)
    to.ink[p] = NAN;
  CHECK (celd_register (&source, &target, &settings, NULL, lattice, &sure) == CELD_OK);
  for (int p = 0; p < PIXELS; p++)
    CHECK (confidence[p] >= 0 && confidence[p] <= 1);
  for (size_t v = 0; v < 2 * lattice->n_vertices; v++)
    CHECK (isfinite (lattice->place[v]));
  for (int p = 0; p < PIXELS; p++)
    to.ink[p] = 1;
  CHECK (celd_register (&source, &target, &settings, NULL, lattice, NULL) == CELD_NOTHING_TO_GO_BY);
  free (before);
  celd_lattice_free (lattice);
}

/* Of two blobs, joined by a stick, the target has one: there confidence is high, and low where lines are missing. */
static void
missing_lines_are_not_trusted (void)
{
  static Picture from, to;
  static float   confidence[PIXELS];
  DrawnShape          shape[6];
  CeldPlane      source = ink_of (&from), target = ink_of (&to), sure = { SIDE, SIDE, SIDE, confidence };
  CeldSettings   settings = celd_settings ();
  CeldLattice   *lattice = NULL;

  shape[0] = blob (90, 150, 50, 1);
  shape[1] = blob (215, 150, 50, 2);
  shape[2] = stick (120, 150, 180, 150, 9);
  draw (shape, 3, &from);
  draw (shape, 1, &to);
  CHECK (celd_lattice_new (&source, NULL, &settings, NULL, &lattice) == CELD_OK);
  CHECK (celd_register (&source, &target, &settings, NULL, lattice, &sure) == CELD_OK);
  CHECK (confidence[150 * SIDE + 90 - 48] > 0.8f);
  CHECK (confidence[150 * SIDE + 215 + 42] < 0.4f);
  CHECK (confidence[5 * SIDE + 5] == 0);
  celd_lattice_free (lattice);
}

int
main (void)
{
  RUN (known_motion_is_found);
  RUN (identity_is_no_motion);
  RUN (levels_keep_limbs_apart);
  RUN (results_do_not_depend_on_threads);
  RUN (bad_input_is_refused);
  RUN (missing_lines_are_not_trusted);
  return DONE;
}
