/* Models of parts: known shapes, joined parts, the order of depth.  There is no ink here but where it is said.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "relief/parts.h"

#include <math.h>
#include <stdlib.h>

typedef struct
{
  int                width, height;
  float             *ink, *art, *level;
  uint32_t          *region;
  CeldLevelOwnership made;
  CeldSheets        *sheets;
  CeldParts          parts;
} Page;

static Page
page_new (int width, int height)
{
  size_t n = (size_t) width * (size_t) height;
  Page   p = { width, height, malloc (n * sizeof (float)), calloc (4 * n, sizeof (float)), calloc (n, sizeof (float)),
               malloc (n * sizeof (uint32_t)), { .n = 0 }, NULL, { 0 } };

  for (size_t i = 0; i < n; i++)
    {
      p.ink[i]         = 1;
      p.art[4 * i + 3] = 1;
      p.region[i]      = 1;
    }
  return p;
}

static void
page_free (Page *p)
{
  celd_parts_clear (&p->parts);
  celd_sheets_free (p->sheets);
  celd_level_ownership_clear (&p->made);
  free (p->ink);
  free (p->art);
  free (p->level);
  free (p->region);
}

static void
put_disc (Page *p, double x0, double y0, double r, float level, uint32_t region)
{
  for (int y = 0; y < p->height; y++)
    for (int x = 0; x < p->width; x++)
      if (hypot (x + 0.5 - x0, y + 0.5 - y0) < r)
        {
          p->level[y * p->width + x]  = level;
          p->region[y * p->width + x] = region;
        }
}

static CeldPlane
plane_of (Page *p, float *data)
{
  return (CeldPlane) { p->width, p->height, (size_t) p->width, data };
}

static void
make (Page *p, const CeldSettings *s)
{
  CeldPlane  ink = plane_of (p, p->ink), levels = plane_of (p, p->level);
  CeldLabels regions = { p->width, p->height, (size_t) p->width, p->region };

  CHECK (celd_level_ownership_new (&ink, NULL, &levels, &regions, NULL, s->expansion, NULL, &p->made) == CELD_OK);
  CHECK (celd_level_sheets (&p->made, &ink, s, NULL, &p->sheets) == CELD_OK);
  CHECK (celd_parts_new (p->sheets, &p->made.own, &ink, NULL, s, NULL, &p->parts) == CELD_OK);
}

static CeldStatus
make_model (Page *p, const CeldSettings *s, CeldModel *model)
{
  CeldPlane   ink = plane_of (p, p->ink), levels = plane_of (p, p->level);
  CeldLabels  regions = { p->width, p->height, (size_t) p->width, p->region };
  CeldColours art = { p->width, p->height, (size_t) p->width, p->art };

  return celd_model_of_levels (&ink, NULL, &levels, &regions, &art, s, NULL, model);
}

/* The height of part k at a pixel of the picture. */
static double
z_at (const Page *p, size_t k, int x, int y)
{
  const CeldPart *part = &p->parts.item[k];

  return (double) part->z[celd_part_at (part, x - part->box.x, y - part->box.y)];
}

static CeldSettings
round_settings (void)
{
  CeldSettings s = celd_settings ();

  s.relief_bulge = 1;
  return s;
}

/* Compares part k with a ball; `above` is what it stands on. */
static void
compare_ball (const Page *p, size_t k, double x0, double y0, double r, double above, double error)
{
  const CeldPart *part = &p->parts.item[k];
  double          sum = 0, n = 0;

  for (int y = 1; y < part->box.height - 1; y++)
    for (int x = 1; x < part->box.width - 1; x++)
      if (celd_part_has (part, x, y))
        {
          double d = hypot (part->box.x + x + 0.5 - x0, part->box.y + y + 0.5 - y0);

          sum += fabs (z_at (p, k, part->box.x + x, part->box.y + y) - above - sqrt (fmax (0, r * r - d * d)));
          n   += 1;
        }
  NEAR (sum / n / r, 0, error);
}

static void
a_disc_is_half_a_ball_at_its_level (void)
{
  CeldSettings s = round_settings ();

  for (int i = 0; i < 3; i++)
    {
      double r = 25 + 40 * i;
      int    side = (int) (2 * r) + 40;
      Page   p = page_new (side, side);

      put_disc (&p, r + 20.3, r + 19.6, r, 1, 2);
      make (&p, &s);
      CHECK (p.parts.n == 2);
      CHECK (p.parts.item[0].page);
      CHECK (!p.parts.item[1].page);
      compare_ball (&p, 1, r + 20.3, r + 19.6, r, (double) s.relief_depth * hypot (side, side), 0.015);
      page_free (&p);
    }
}

/* Two pieces that meet without a line join: as one ball where they are halves. */
static void
pieces_without_a_line_between_join (void)
{
  for (int middle = 80; middle <= 100; middle += 20)
    {
      CeldSettings s = round_settings ();
      Page         p = page_new (200, 200);
      double       above = (double) s.relief_depth * hypot (200, 200);

      put_disc (&p, 100, 100, 70, 1, 2);
      for (int i = 0; i < 200 * 200; i++)
        if (p.region[i] == 2 && i % 200 >= middle)
          p.region[i] = 3;
      make (&p, &s);
      CHECK (p.parts.n == 3);
      for (int y = 45; y < 155; y++)
        NEAR (z_at (&p, 1, middle - 1, y), z_at (&p, 2, middle, y), 3);
      if (middle == 100)
        {
          compare_ball (&p, 1, 100, 100, 70, above, 0.03);
          compare_ball (&p, 2, 100, 100, 70, above, 0.03);
        }
      page_free (&p);
    }
}

/* With a line between them each half is round by itself. */
static void
a_line_separates (void)
{
  CeldSettings s = round_settings ();
  Page         p = page_new (200, 200);

  put_disc (&p, 100.5, 100, 70, 1, 2);
  for (int i = 0; i < 200 * 200; i++)
    if (p.region[i] == 2 && i % 200 >= 100)
      p.region[i] = 3;
  for (int i = 0; i < 200 * 200; i++)
    if (p.region[i] > 1 && i % 200 >= 98 && i % 200 < 102)
      p.ink[i] = 0;
  make (&p, &s);
  CHECK (p.parts.n == 3);
  CHECK (z_at (&p, 1, 70, 100) > z_at (&p, 1, 96, 100) + 15);
  CHECK (z_at (&p, 2, 130, 100) > z_at (&p, 2, 104, 100) + 15);
  page_free (&p);
}

/* Two halves of different levels with a line between them, which may be broken. */
static Page
halves (const CeldSettings *s, bool broken)
{
  Page p = page_new (200, 200);

  put_disc (&p, 100.5, 100, 70, 1, 2);
  for (int i = 0; i < 200 * 200; i++)
    if (p.region[i] == 2)
      {
        int x = i % 200, y = i / 200;

        p.region[i] = x >= 100 ? 3 : 2;
        p.level[i]  = x >= 100 ? 2 : 1;
        p.ink[i]    = x < 98 || x >= 102 || (broken && y >= 90 && y < 110);
      }
  make (&p, s);
  CHECK (p.parts.n == 3);
  return p;
}

/* If gaps hold, the halves are as round as with a whole line. */
static void
a_gap_that_holds_separates (void)
{
  for (int hold = 0; hold < 2; hold++)
    {
      CeldSettings s = round_settings ();
      double       most = 0;

      s.hold_gaps = hold;

      Page whole = halves (&s, false), gap = halves (&s, true);

      for (int y = 90; y < 110; y++)
        for (int x = 60; x < 140; x++)
          if (abs (x - 100) > 6) /* nearer to the line its width tells */
            most = fmax (most, fabs (z_at (&gap, 1 + (x >= 100), x, y) - z_at (&whole, 1 + (x >= 100), x, y)));
      CHECK (hold ? most < 3 : most > 6);
      page_free (&whole);
      page_free (&gap);
    }
}

/* Nowhere does a part come through one that is listed after it. */
static void
nearer_parts_are_in_front (void)
{
  unsigned state = 7;

  for (int run = 0; run < 6; run++)
    {
      CeldSettings s = celd_settings ();
      Page         p = page_new (180, 140);
      float       *front = calloc (180 * 140, sizeof *front);

      for (uint32_t k = 0; k < 9; k++)
        {
          int n[3];

          for (int i = 0; i < 3; i++)
            n[i] = (int) ((state = state * 1103515245u + 12345u) >> 16 & 0x7fff);
          put_disc (&p, n[0] % 180, n[1] % 140, 10 + n[2] % 45, (float) (k + 1) / 9, k + 2);
        }
      s.relief_bulge = run % 2 ? 0.6f : 3;
      make (&p, &s);
      for (size_t k = p.parts.n; k-- > 1;)
        {
          const CeldPart *part = &p.parts.item[k];

          for (int y = 1; y < part->box.height - 1; y++)
            for (int x = 1; x < part->box.width - 1; x++)
              if (celd_part_has (part, x, y))
                {
                  float *before = &front[(part->box.y + y) * 180 + part->box.x + x];
                  float  z = part->z[celd_part_at (part, x, y)];

                  if (*before > 0 || *before < 0)
                    CHECK (z <= *before - 2 * s.mesh_error);
                  *before = z;
                }
        }
      free (front);
      page_free (&p);
    }
}

/* A small disc off the middle of a large one follows its slope. */
static void
a_part_sits_on_what_is_behind_it (void)
{
  CeldSettings s = celd_settings ();
  Page         p = page_new (300, 300);

  put_disc (&p, 150, 150, 120, 0.5f, 2);
  put_disc (&p, 225, 150, 20, 1, 3);
  make (&p, &s);
  CHECK (p.parts.n == 3);
  for (int i = 0; i < 16; i++)
    {
      double a = 2 * CELD_PI * i / 16, x = 75 + 21 * cos (a), y = 21 * sin (a);
      double ground = 0.6 * sqrt (120 * 120 - x * x - y * y);
      double rim = (double) celd_part_seat_at (&p.parts.item[2], 225 + 20 * cos (a) - p.parts.item[2].box.x - 0.5,
                                               150 + 20 * sin (a) - p.parts.item[2].box.y - 0.5);

      rim -= 0.5 * (double) s.relief_depth * hypot (300, 300);
      CHECK (rim > ground - 3 && rim < ground + 7);
    }
  page_free (&p);
}

static void
solids_are_bodies (void)
{
  CeldSettings s = celd_settings ();
  Page         p = page_new (120, 100);
  CeldModel    model = { 0 };

  put_disc (&p, 50, 50, 30, 0.5f, 2);
  put_disc (&p, 110, 60, 25, 1, 3); /* cut off by the frame */
  s.mesh_kind = CELD_MESH_SOLID;
  CHECK (make_model (&p, &s, &model) == CELD_OK);
  CHECK (model.n == 3);
  for (size_t k = 0; k < model.n; k++)
    {
      const CeldReliefMesh *mesh = &model.part[k].mesh;
      double                volume = 0;

      for (size_t i = 0; i < mesh->triangles; i++)
        {
          const float *v[3];

          for (int j = 0; j < 3; j++)
            v[j] = mesh->place + 3 * mesh->corner[3 * i + (size_t) j];
          for (int j = 0; j < 3; j++)
            volume += (double) (v[0][j] * (v[1][(j + 1) % 3] * v[2][(j + 2) % 3]
                                           - v[1][(j + 2) % 3] * v[2][(j + 1) % 3])) / 6;
        }
      CHECK (volume > 0);
      CHECK (2 * mesh->vertices == mesh->triangles + 4); /* Euler: one body without a tunnel */
    }
  CHECK (model.part[0].page && model.part[0].mesh.vertices == 8);
  celd_model_clear (&model);
  page_free (&p);
}

static void
bad_input_is_refused (void)
{
  CeldSettings s = celd_settings ();
  Page         p = page_new (60, 60);
  CeldModel    model = { 0 };

  put_disc (&p, 30, 30, 20, 1, 2);
  p.height = 59;
  CHECK (make_model (&p, &s, &model) == CELD_OK);
  celd_model_clear (&model);
  p.height       = 60;
  s.relief_bulge = -1;
  CHECK (make_model (&p, &s, &model) == CELD_BAD_VALUE);
  CHECK (!model.part);
  page_free (&p);
}

int
main (void)
{
  RUN (a_disc_is_half_a_ball_at_its_level);
  RUN (pieces_without_a_line_between_join);
  RUN (a_line_separates);
  RUN (a_gap_that_holds_separates);
  RUN (nearer_parts_are_in_front);
  RUN (a_part_sits_on_what_is_behind_it);
  RUN (solids_are_bodies);
  RUN (bad_input_is_refused);
  return DONE;
}
