/* Meshes of reliefs: their error, that they cover the picture once, and that solids are closed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"

enum { W = 45, H = 37, N = W * H };

static float   z[N], outline[N];
static uint8_t cut[N];

static const CeldRelief relief = { W, H, z, outline, cut };

static CeldSettings
settings_of (CeldMeshKind kind, double error)
{
  CeldSettings s = celd_settings ();

  s.mesh_kind       = kind;
  s.mesh_size  = W; /* a millimetre is a pixel */
  s.mesh_error = (float) error;
  return s;
}

static CeldReliefMesh
make (const CeldSettings *s)
{
  CeldReliefMesh mesh = { 0 };

  CHECK (celd_relief_mesh (&relief, s, NULL, &mesh) == CELD_OK);
  return mesh;
}

/* Hills without a cut. */
static void
draw_hills (uint32_t seed)
{
  double a = 0.05 + 0.01 * check_random (&seed, 20), b = 0.05 + 0.01 * check_random (&seed, 20);

  for (int i = 0; i < N; i++)
    {
      z[i]   = (float) (9 * sin (a * (i % W)) * cos (b * (i / W)) + 0.01 * check_random (&seed, 3));
      cut[i] = 0;
    }
}

/* Cuts everywhere, with so few heights that many are equal. */
static void
draw_shards (uint32_t seed, uint32_t heights, uint32_t share)
{
  for (int i = 0; i < N; i++)
    {
      z[i]       = (float) check_random (&seed, heights);
      outline[i] = z[i] - (float) check_random (&seed, 2);
      cut[i]     = 0;
      if (i % W + 1 < W && check_random (&seed, 100) < share)
        cut[i] |= CELD_CUT_RIGHT | (check_random (&seed, 2) ? CELD_NEAR_RIGHT : 0);
      if (i / W + 1 < H && check_random (&seed, 100) < share)
        cut[i] |= CELD_CUT_BELOW | (check_random (&seed, 2) ? CELD_NEAR_BELOW : 0);
    }
}

/* Height of the surface at the corner (x,y) where there are no cuts. */
static double
corner_height (int x, int y)
{
  double sum = 0;
  int    n = 0;

  for (int v = y - 1; v <= y; v++)
    for (int u = x - 1; u <= x; u++)
      if (u >= 0 && v >= 0 && u < W && v < H)
        {
          sum += (double) z[v * W + u];
          n++;
        }
  return sum / n;
}

/* Twice the area of the triangle of (x,y) and two vertices, as seen from the viewer. */
static double
area (const float *a, const float *b, double x, double y)
{
  return ((double) a[0] - x) * ((double) b[1] - y) - ((double) b[0] - x) * ((double) a[1] - y);
}

/* Distance of triangle i to the corners of pixels that it covers; its area is added up. */
static double
look_at (const CeldReliefMesh *m, size_t i, double *sum)
{
  const float *p[3];
  double       whole, worst = 0;

  for (int k = 0; k < 3; k++)
    p[k] = m->place + 3 * m->corner[3 * i + (size_t) k];
  whole = area (p[1], p[2], (double) p[0][0], (double) p[0][1]);
  CHECK (whole > 0);
  *sum += whole / 2;
  for (int y = 0; y <= H; y++)
    for (int x = 0; x <= W; x++)
      {
        double u = x - W / 2., v = H / 2. - y, height = 0, least = 1;

        for (int k = 0; k < 3; k++)
          {
            double share = area (p[(k + 1) % 3], p[(k + 2) % 3], u, v) / whole;

            height += share * (double) p[k][2];
            least   = fmin (least, share);
          }
        if (least >= -1e-9)
          worst = fmax (worst, fabs (height - corner_height (x, y)));
      }
  return worst;
}

static void
surfaces_are_as_near_as_asked_for (void)
{
  size_t last = SIZE_MAX;

  for (int k = 0; k < 5; k++)
    {
      double         error = 0.02 * pow (3, k), worst = 0, sum = 0;
      CeldSettings   s = settings_of (CELD_MESH_SURFACE, error);
      CeldReliefMesh m;

      draw_hills (7);
      m = make (&s);
      for (size_t i = 0; i < m.triangles; i++)
        worst = fmax (worst, look_at (&m, i, &sum));
      CHECK (worst <= error + 1e-4);
      NEAR (sum, W * H, 1e-6 * W * H);
      CHECK (m.vertices <= last);
      last = m.vertices;
      celd_relief_mesh_clear (&m);
    }
  CHECK (last < (W + 1) * (H + 1) / 4);
}

static void
a_flat_picture_is_a_few_triangles (void)
{
  CeldSettings   s = settings_of (CELD_MESH_SURFACE, 0.5);
  CeldReliefMesh m;

  memset (z, 0, sizeof z);
  memset (cut, 0, sizeof cut);
  m = make (&s);
  CHECK (m.vertices < 4 * (W + H)); /* the frame is no power of two */
  for (size_t i = 0; i < m.vertices; i++)
    {
      NEAR (m.normal[3 * i + 2], 1, 1e-6);
      NEAR (m.art[2 * i] * W - W / 2.f, m.place[3 * i], 1e-4);
      NEAR (H / 2.f - m.art[2 * i + 1] * H, m.place[3 * i + 1], 1e-4);
    }
  celd_relief_mesh_clear (&m);
}

static void
cracks_have_two_sides (void)
{
  CeldSettings   s = settings_of (CELD_MESH_SURFACE, 0.5);
  CeldReliefMesh m;
  size_t         low = 0, high = 0;

  for (int i = 0; i < N; i++)
    {
      z[i] = outline[i] = i % W < 20 ? 0.f : 5.f;
      cut[i] = i % W == 19 ? CELD_CUT_RIGHT : 0;
    }
  m = make (&s);
  for (size_t i = 0; i < m.vertices; i++)
    if (fabsf (m.place[3 * i] - (20 - W / 2.f)) < 1e-4f)
      {
        low  += m.place[3 * i + 2] == 0;
        high += m.place[3 * i + 2] == 5;
      }
  CHECK (low == H + 1 && high == H + 1);
  celd_relief_mesh_clear (&m);
}

/* ------------------------------------------------------------------ solids */

typedef struct { uint32_t from, to; } Way;

static int
compare_ways (const void *first, const void *second)
{
  const Way *a = first, *b = second;

  if (a->from != b->from)
    return a->from < b->from ? -1 : 1;
  return (a->to > b->to) - (a->to < b->to);
}

/* Gives vertices at the same place the same number, as in an STL file. */
static void
number_places (const CeldReliefMesh *m, uint32_t *number)
{
  for (size_t i = 0; i < m->vertices; i++)
    {
      size_t j = 0;

      while (memcmp (m->place + 3 * j, m->place + 3 * i, 3 * sizeof *m->place))
        j++;
      number[i] = (uint32_t) j;
    }
}

/* Does every edge occur exactly once in each direction? */
static bool
is_closed (const CeldReliefMesh *m, const uint32_t *number)
{
  size_t n = 3 * m->triangles;
  Way   *way = malloc (n * sizeof *way);
  bool   good = true;

  for (size_t i = 0; i < n; i++)
    way[i] = (Way) { number[m->corner[i]], number[m->corner[i % 3 == 2 ? i - 2 : i + 1]] };
  qsort (way, n, sizeof *way, compare_ways);
  for (size_t i = 0; i < n && good; i++)
    {
      Way back = { way[i].to, way[i].from };

      good = way[i].from != way[i].to && (!i || compare_ways (&way[i - 1], &way[i])) &&
             bsearch (&back, way, n, sizeof back, compare_ways);
    }
  free (way);
  return good;
}

static double
volume (const CeldReliefMesh *m)
{
  double sum = 0;

  for (size_t i = 0; i < m->triangles; i++)
    {
      const float *a = m->place + 3 * m->corner[3 * i], *b = m->place + 3 * m->corner[3 * i + 1];
      const float *c = m->place + 3 * m->corner[3 * i + 2];

      for (int k = 0; k < 3; k++)
        {
          int u = (k + 1) % 3, v = (k + 2) % 3;

          sum += (double) a[k] * ((double) b[u] * (double) c[v] - (double) b[v] * (double) c[u]);
        }
    }
  return sum / 6;
}

static void
check_body (double error)
{
  CeldSettings   s = settings_of (CELD_MESH_SOLID, error);
  CeldReliefMesh m = make (&s);
  uint32_t      *number = malloc (m.vertices * sizeof *number);

  for (size_t i = 0; i < m.vertices; i++)
    number[i] = (uint32_t) i;
  CHECK (is_closed (&m, number));
  number_places (&m, number);
  CHECK (is_closed (&m, number));
  CHECK (volume (&m) > W * H * 1.);
  free (number);
  celd_relief_mesh_clear (&m);
}

static void
solids_are_closed (void)
{
  draw_hills (3);
  check_body (0.5);
  for (uint32_t seed = 1; seed <= 10; seed++)
    {
      draw_shards (seed, 3, 10 * seed); /* at the end every edge is cut */
      check_body (0.5);
      draw_shards (seed, 1000, 10 * seed);
      check_body (20);
    }
}

/* Pixels that touch at corners only. */
static void
a_chessboard_is_closed (void)
{
  for (int i = 0; i < N; i++)
    {
      int near = (i % W + i / W) % 2;

      z[i] = outline[i] = near ? 5 : 1;
      cut[i] = (uint8_t) (CELD_CUT_RIGHT | CELD_CUT_BELOW | (near ? CELD_NEAR_RIGHT | CELD_NEAR_BELOW : 0));
    }
  check_body (0.5);
}

static void
a_plate_has_the_volume_of_a_plate (void)
{
  CeldSettings   s = settings_of (CELD_MESH_SOLID, 0.5);
  CeldReliefMesh m;

  memset (cut, 0, sizeof cut);
  for (int i = 0; i < N; i++)
    z[i] = 0;
  s.mesh_plate = 4;
  m = make (&s);
  NEAR (volume (&m), 4. * W * H, 1e-3 * W * H);
  celd_relief_mesh_clear (&m);
}

/* ------------------------------------------------------------------ limits, hosts and bad input */

static void
too_many_vertices_make_it_coarser (void)
{
  CeldSettings   s = settings_of (CELD_MESH_SURFACE, 0.01);
  CeldReliefMesh m = { 0 };
  double         done = 0;
  CeldHost       host = { .progress = check_rising, .data = &done };

  draw_hills (5);
  s.most_vertices = 1000;
  CHECK (celd_relief_mesh (&relief, &s, &host, &m) == CELD_OK);
  CHECK (m.vertices <= 1000);
  CHECK (m.error > 0.01);
  celd_relief_mesh_clear (&m);
  draw_shards (3, 1000, 100);
  CHECK (celd_relief_mesh (&relief, &s, NULL, &m) == CELD_BAD_VALUE);
  CHECK (!m.place);
}

static void
hosts_can_cancel_and_bad_input_is_refused (void)
{
  CeldSettings   s = settings_of (CELD_MESH_SURFACE, 0.5);
  CeldReliefMesh m = { 0 };
  CeldHost       host = { check_refuse, NULL, NULL };
  CeldRelief     none = { 0 };

  draw_hills (5);
  CHECK (celd_relief_mesh (&relief, &s, &host, &m) == CELD_CANCELLED);
  CHECK (celd_relief_mesh (&none, &s, NULL, &m) == CELD_BAD_SIZE);
  for (int k = 0; k < 3; k++)
    {
      const float bad[] = { NAN, INFINITY, -2 * CELD_MOST_HEIGHT };
      float       good = relief.z[17];

      relief.z[17] = bad[k];
      CHECK (celd_relief_mesh (&relief, &s, NULL, &m) == CELD_BAD_VALUE);
      relief.z[17] = good;
    }
  s.mesh_size = 0;
  CHECK (celd_relief_mesh (&relief, &s, NULL, &m) == CELD_BAD_VALUE);
}

int
main (void)
{
  RUN (surfaces_are_as_near_as_asked_for);
  RUN (a_flat_picture_is_a_few_triangles);
  RUN (cracks_have_two_sides);
  RUN (solids_are_closed);
  RUN (a_chessboard_is_closed);
  RUN (a_plate_has_the_volume_of_a_plate);
  RUN (too_many_vertices_make_it_coarser);
  RUN (hosts_can_cancel_and_bad_input_is_refused);
  return DONE;
}
