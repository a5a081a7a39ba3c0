/* Poses of parts that move far: limbs swing by more than blocks reach.
 *
 * On a coarse picture each piece of the lattice, largest first, tries turns and shifts of all of it, and takes the pose
 * of highest score: its ink lies on ink of the target, most of all on ink that no other piece explains, its paper does
 * not, it stays attached to some neighbour of the drawing, and it moves no farther than need be.  Where nearer pieces
 * hide it nothing counts for it or against it.  So two legs do not end up as one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/swing.h"

#define POSE_TURNS       12    /* to either side; chosen */
#define POSE_TURN        7.5   /* degrees; chosen */
#define POSE_REACH       0.15  /* of the longer side: shifts are tried up to here; chosen */
#define POSE_STEP        2     /* pixels of the scale between shifts; chosen */
#define POSE_ROUNDS      2     /* chosen */
#define POSE_MARKS       64    /* of ink, and of paper, that a piece is judged by; chosen */
#define POSE_INK         8     /* pixels of ink of the scale that a piece must have to be moved; chosen */
#define SHARED_INK       0.3f  /* what ink counts that another piece explains; chosen */
#define UNSEEN_INK       0.4f  /* what hidden ink counts; chosen */
#define PAPER_ON_INK     0.5f  /* what paper on ink counts, likewise; chosen */
#define POSE_PAPER_REACH 2.f   /* pixels of the scale; chosen */
#define ATTACHED         0.15f /* for one neighbour that a piece stays with; chosen */
#define ALL_ATTACHED     0.1f  /* for all of them; chosen */
#define APART            2.f   /* cells: from here on a piece is torn off its neighbour; chosen */
#define POSE_MOTION      0.1f  /* against the largest turn, and the largest shift; chosen */
#define POSE_GAIN        0.02f /* least gain of a new pose; chosen */

typedef struct { float x, y; } PoseSpot;                           /* in the target, in pixels of the scale */
typedef struct { float score; int turn; float x, y; } Pose;

typedef struct
{
  CeldLattice           *lattice;
  const CeldMatchImages *images;
  CeldPieces             pieces;
  uint8_t               *hidden, *inside;
  int32_t               *squared;
  float                 *ink, *paper; /* what ink, and what paper, counts in each pixel */
  /* the piece that is tried */
  const CeldPiece       *now;
  PoseSpot               spot[2 * POSE_MARKS]; /* of ink, then of paper */
  size_t                 n_spots, n_ink;
  float                  centre[2];
  Pose                   best[2 * POSE_TURNS + 1];
} Swing;

/* ------------------------------------------------------------------ what ink and paper count */

/* The pixel of the scale where a mark lies; false outside the frame. */
static bool
find_spot (const Swing *s, const CeldPieceMark *mark, int *x, int *y)
{
  const CeldMatchImages *i = s->images;
  float                  at[2], f = (float) i->factor;

  celd_cell_map (s->lattice, mark->cell, mark->x, mark->y, at);
  if (!(at[0] >= 0 && at[1] >= 0 && at[0] < f * (float) i->width && at[1] < f * (float) i->height))
    return false;
  *x = (int) (at[0] / f);
  *y = (int) (at[1] / f);
  return true;
}

/* Sets a pixel and its neighbours. */
static void
stamp (const CeldMatchImages *i, int x, int y, uint8_t value, uint8_t *mask)
{
  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < i->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < i->width; u++)
      mask[v * i->width + u] = value;
}

static float
target_at (const CeldMatchImages *i, int x, int y)
{
  return i->target[(y + i->pad) * (i->width + 2 * i->pad) + x + i->pad];
}

/* Finds what nearer pieces hide, and which ink of the target no other piece explains. */
static void
look_at_others (Swing *s, const CeldPiece *piece)
{
  const CeldMatchImages *i = s->images;
  int                    x, y;

  memset (s->hidden, 0, (size_t) (i->width * i->height));
  for (y = 0; y < i->height; y++)
    for (x = 0; x < i->width; x++)
      s->inside[y * i->width + x] = target_at (i, x, y) > CELD_ON_INK;
  for (size_t k = 0; k < s->lattice->n_pieces; k++)
    {
      const CeldPiece *other = &s->pieces.piece[k];
      bool             nearer = other->level > piece->level;

      for (size_t m = other->mark; m < other->mark + other->n && other != piece; m++)
        {
          const CeldPieceMark *mark = &s->pieces.mark[m];

          if (!(mark->ink || nearer) || !find_spot (s, mark, &x, &y))
            continue;
          if (mark->ink && target_at (i, x, y) > 0)
            stamp (i, x, y, 0, s->inside);
          if (nearer)
            stamp (i, x, y, 1, s->hidden);
        }
    }
}

static CeldStatus
value_pixels (Swing *s, const CeldPiece *piece)
{
  const CeldMatchImages *i = s->images;
  CeldStatus             status;

  look_at_others (s, piece);
  status = celd_distance (i->width, i->height, s->inside, NULL, s->squared);
  for (int y = 0; y < i->height && status == CELD_OK; y++)
    for (int x = 0; x < i->width; x++)
      {
        int   p = y * i->width + x;
        float all = target_at (i, x, y), reach = (float) CELD_NEARNESS, d = (1 - all) * reach;
        float own = s->squared[p] < 1000 ? celd_most (0, 1 - sqrtf ((float) s->squared[p]) / reach) : 0;

        s->ink[p]   = s->hidden[p] ? UNSEEN_INK : celd_most (own, SHARED_INK * all);
        s->paper[p] = s->hidden[p] ? 0 : celd_most (0, 1 - d / POSE_PAPER_REACH);
      }
  return status;
}

/* ------------------------------------------------------------------ poses */

/* Where the marks of a piece are now: at most POSE_MARKS of ink, then at most POSE_MARKS of paper. */
static void
place_marks (Swing *s, const CeldPiece *piece)
{
  double x = 0, y = 0;

  s->n_spots = 0;
  for (int ink = 1; ink >= 0; ink--)
    {
      size_t all = ink ? piece->ink : piece->n - piece->ink, seen = 0;

      for (size_t m = piece->mark; m < piece->mark + piece->n; m++)
        if (s->pieces.mark[m].ink == ink && seen++ % (all / POSE_MARKS + 1) == 0)
          {
            float at[2];

            celd_cell_map (s->lattice, s->pieces.mark[m].cell, s->pieces.mark[m].x, s->pieces.mark[m].y, at);
            s->spot[s->n_spots++] = (PoseSpot) { at[0] / (float) s->images->factor, at[1] / (float) s->images->factor };
          }
      if (ink)
        s->n_ink = s->n_spots;
    }
  for (size_t k = 0; k < s->n_ink; k++)
    {
      x += (double) s->spot[k].x;
      y += (double) s->spot[k].y;
    }
  s->centre[0] = (float) (x / (double) s->n_ink);
  s->centre[1] = (float) (y / (double) s->n_ink);
}

/* How well ink and paper of the piece lie. */
static float
score_marks (const Swing *s, float cosine, float sine, float dx, float dy)
{
  float sum[2] = { 0, 0 };
  int   w = s->images->width, h = s->images->height;

  for (size_t k = 0; k < s->n_spots; k++)
    {
      float x = s->spot[k].x - s->centre[0], y = s->spot[k].y - s->centre[1];
      float u = s->centre[0] + cosine * x - sine * y + dx, v = s->centre[1] + sine * x + cosine * y + dy;
      bool  there = u >= 0 && v >= 0 && u < (float) w && v < (float) h, ink = k < s->n_ink;

      sum[ink] += there ? (ink ? s->ink : s->paper)[(int) v * w + (int) u] : ink ? UNSEEN_INK : 0;
    }
  return sum[1] / (float) s->n_ink -
         (s->n_spots > s->n_ink ? PAPER_ON_INK * sum[0] / (float) (s->n_spots - s->n_ink) : 0);
}

/* How well it stays with its neighbours: with the best one, and all. */
static float
score_bonds (const Swing *s, float cosine, float sine, float dx, float dy)
{
  const CeldPieceBond *bond = s->pieces.bond + s->now->bond;
  float       f = (float) s->images->factor, apart = APART * (float) s->lattice->side, best = 0, sum = 0, n = 0;

  for (size_t b = 0, end; b < s->now->n_bonds; b = end)
    {
      float held = 0;

      for (end = b; end < s->now->n_bonds && bond[end].piece == bond[b].piece; end++)
        {
          const float *p = s->lattice->place + 2 * (size_t) bond[end].own;
          const float *q = s->lattice->place + 2 * (size_t) bond[end].other;
          float        x = p[0] - f * s->centre[0], y = p[1] - f * s->centre[1];
          float        u = f * (s->centre[0] + dx) + cosine * x - sine * y - q[0];
          float        v = f * (s->centre[1] + dy) + sine * x + cosine * y - q[1];

          held = celd_most (held, 1 - sqrtf (u * u + v * v) / apart);
        }
      best = celd_most (best, held);
      sum += held;
      n++;
    }
  return n > 0 ? ATTACHED * best + ALL_ATTACHED * sum / n : 0;
}

static float
score_pose (const Swing *s, double radians, float dx, float dy)
{
  float c = (float) cos (radians), d = (float) sin (radians);
  float reach = (float) (POSE_REACH * fmax (s->images->width, s->images->height));

  return score_marks (s, c, d, dx, dy) + score_bonds (s, c, d, dx, dy) -
         POSE_MOTION * ((float) (fabs (radians) / (POSE_TURNS * POSE_TURN * CELD_RADIANS)) + hypotf (dx, dy) / reach);
}

static double
turn_of (int turn)
{
  return (turn - POSE_TURNS) * POSE_TURN * CELD_RADIANS;
}

/* The best shift for one turn. */
static void
try_shifts (void *data, int turn)
{
  Swing *s = data;
  int    reach = (int) (POSE_REACH * fmax (s->images->width, s->images->height)) / POSE_STEP;
  Pose   best = { .score = -INFINITY };

  for (int dy = -reach; dy <= reach; dy++)
    for (int dx = -reach; dx <= reach; dx++)
      {
        Pose pose = { 0, turn, (float) (dx * POSE_STEP), (float) (dy * POSE_STEP) };

        pose.score = score_pose (s, turn_of (turn), pose.x, pose.y);
        if (pose.score > best.score)
          best = pose;
      }
  s->best[turn] = best;
}

static void
move_piece (Swing *s, const CeldPiece *piece, const Pose *pose)
{
  float f = (float) s->images->factor, c = (float) cos (turn_of (pose->turn)), d = (float) sin (turn_of (pose->turn));

  for (size_t v = 0; v < s->lattice->n_vertices; v++)
    if (&s->pieces.piece[s->pieces.piece_of[v]] == piece)
      {
        float *p = s->lattice->place + 2 * v, x = p[0] - f * s->centre[0], y = p[1] - f * s->centre[1];

        p[0] = f * (s->centre[0] + pose->x) + c * x - d * y;
        p[1] = f * (s->centre[1] + pose->y) + d * x + c * y;
      }
}

static CeldStatus
swing_piece (Swing *s, const CeldPiece *piece, const CeldHost *host)
{
  Pose       best;
  CeldStatus status = value_pixels (s, piece);

  if (status != CELD_OK)
    return status;
  s->now = piece;
  place_marks (s, piece);
  celd_parallel_for (host, 2 * POSE_TURNS + 1, try_shifts, s);
  best = (Pose) { score_pose (s, 0, 0, 0) + POSE_GAIN, POSE_TURNS, 0, 0 };
  for (int t = 0; t <= 2 * POSE_TURNS; t++)
    if (s->best[t].score > best.score)
      best = s->best[t];
  move_piece (s, piece, &best);
  return CELD_OK;
}

CeldStatus
celd_swing (CeldLattice *lattice, const CeldMatchImages *images, const CeldHost *host)
{
  size_t     pixels = (size_t) images->width * (size_t) images->height;
  Swing     *s;
  CeldStatus status;

  if (lattice->n_pieces < 2)
    return CELD_OK;
  s = celd_alloc0 (1, sizeof *s);
  if (!s)
    return CELD_NO_MEMORY;
  s->lattice  = lattice;
  s->images   = images;
  s->hidden   = celd_alloc (pixels, 1);
  s->inside   = celd_alloc (pixels, 1);
  s->squared  = celd_alloc (pixels, sizeof *s->squared);
  s->ink      = celd_alloc (pixels, sizeof *s->ink);
  s->paper    = celd_alloc (pixels, sizeof *s->paper);
  status = s->hidden && s->inside && s->squared && s->ink && s->paper ? celd_pieces_new (lattice, images, &s->pieces)
                                                                      : CELD_NO_MEMORY;
  for (size_t k = 0; k < POSE_ROUNDS * lattice->n_pieces && status == CELD_OK; k++)
    {
      const CeldPiece *piece = &s->pieces.piece[s->pieces.order[k % lattice->n_pieces]];

      if (piece->ink >= POSE_INK)
        status = swing_piece (s, piece, host);
      if (status == CELD_OK)
        status = celd_progress (host, (double) k / (double) (POSE_ROUNDS * lattice->n_pieces));
    }
  celd_pieces_clear (&s->pieces);
  celd_free (s->hidden);
  celd_free (s->inside);
  celd_free (s->squared);
  celd_free (s->ink);
  celd_free (s->paper);
  celd_free (s);
  return status;
}
