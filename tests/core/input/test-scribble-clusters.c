/* Which colours of a counted layer are labels, and which belong together.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "reading.h"
#include "input/input.h"

static const char *const apart[] = { "AAAA....BBB", "AAAA....BBB", NULL };

static void
cluster (CeldScribbleLayer *r, size_t wanted)
{
  CHECK (celd_scribble_clusters (r, NULL) == CELD_OK);
  NEAR (r->n_clusters, wanted + 1, 0); /* 0 is none */
}

/* Each takes in what lies within the radius, 3; the larger one gives the cluster its colour. */
static void
colours_within_the_radius_are_one (void)
{
  int     near[2][3] = { { 100, 100, 100 }, { 103, 100, 100 } }, far[2][3] = { { 100, 100, 100 }, { 100, 104, 100 } };
  CeldScribbleLayer r = reading_new (apart, near, 2);

  cluster (&r, 1);
  CHECK (r.colour[1].cluster == 1 && r.colour[2].cluster == 1);
  CHECK (r.cluster[1].colour == 1 && r.cluster[1].is_label);
  NEAR (r.cluster[1].pixels, 14, 0);
  reading_clear (&r);

  r = reading_new (apart, far, 2);
  cluster (&r, 2);
  CHECK (r.colour[1].cluster != r.colour[2].cluster);
  CHECK (r.cluster[1].is_label && r.cluster[2].is_label);
  reading_clear (&r);
}

/* On paper and with loss also four interior ones. */
static void
a_label_needs_four_solid_pixels (void)
{
  static const struct { uint32_t solid, interior; bool lossy, paper, label; } given[] = {
    { 4, 0, false, true, true }, { 3, 0, false, true, false }, { 4, 4, true, true, true }, { 4, 3, true, true, false },
    { 4, 0, true, false, true },
  };
  int rgb[3][3] = { { 200, 0, 0 }, { 0, 0, 200 }, { 255, 255, 255 } };

  for (size_t i = 0; i < sizeof given / sizeof *given; i++)
    {
      CeldScribbleLayer r = reading_new (apart, rgb, 3);

      r.paper = given[i].paper ? 3 : 0;
      r.colour[2].solid = given[i].solid;
      r.colour[2].interior = given[i].interior;
      r.lossy = given[i].lossy;
      cluster (&r, 2);
      CHECK (r.cluster[r.colour[2].cluster].is_label == given[i].label);
      CHECK (r.cluster[r.colour[1].cluster].is_label);
      reading_clear (&r);
    }
}

/* Where nothing is antialiased, a dot of one pixel will do, but not one that may be a fringe, or noise. */
static void
one_pixel_is_a_label_in_pixel_art (void)
{
  static const char *const alone[] = { "AAAA.....", "AAAA....B", NULL };
  static const char *const beside[] = { "AAAA.....", "AAAA.....", "....B....", NULL };
  static const struct { const char *const *art; bool pixel_art, lossy, label; } given[] = {
    { alone, true, false, true }, { alone, false, false, false }, { alone, true, true, false },
    { beside, true, false, false },
  };
  int rgb[2][3] = { { 200, 0, 0 }, { 0, 0, 200 } };

  for (size_t i = 0; i < sizeof given / sizeof *given; i++)
    {
      CeldScribbleLayer r = reading_new (given[i].art, rgb, 2);

      r.pixel_art  = given[i].pixel_art;
      r.lossy = given[i].lossy;
      r.colour[1].interior = 4;
      cluster (&r, 2);
      CHECK (r.cluster[r.colour[2].cluster].is_label == given[i].label);
      CHECK (r.cluster[r.colour[1].cluster].is_label);
      reading_clear (&r);
    }
}

/* A label whose colour fringes have, too, needs a third of its pixels solid. */
static void
fringes_of_others_do_not_count (void)
{
  static const struct { uint32_t solid, interior; bool label; } given[] = {
    { 44, 0, true }, { 43, 0, false }, { 43, 43, false },
  };
  int rgb[2][3] = { { 200, 0, 0 }, { 0, 0, 200 } };

  for (size_t i = 0; i < sizeof given / sizeof *given; i++)
    {
      CeldScribbleLayer r = reading_new (apart, rgb, 2);

      r.colour[2].pixels = 132;
      r.colour[2].solid = given[i].solid;
      r.colour[2].interior = given[i].interior;
      cluster (&r, 2);
      CHECK (r.cluster[r.colour[2].cluster].is_label == given[i].label);
      reading_clear (&r);
    }
}

/* A rim without an inside is a part of the stroke that it touches, if it has nearly its colour. */
static void
a_rim_belongs_to_its_stroke (void)
{
  static const char *const touching[] = { "AAAAAA", "AAAAAA", "BBBBBB", NULL };
  static const char *const apart_too[] = { "AAAAAA", "AAAAAA", "......", "BBBBBB", NULL };
  int near[2][3] = { { 200, 0, 0 }, { 180, 20, 0 } }, far[2][3] = { { 200, 0, 0 }, { 160, 20, 0 } };

  for (int i = 0; i < 4; i++)
    {
      CeldScribbleLayer r = reading_new (i == 1 ? apart_too : touching, i == 2 ? far : near, 2);

      r.colour[2].interior = i == 3 ? 6 : 0;
      cluster (&r, 2);
      CHECK ((r.colour[2].cluster == r.colour[1].cluster) == (i == 0));
      CHECK (r.cluster[2].is_label == (i > 0));
      reading_clear (&r);
    }
}

/* An inside of many colours is no paint of its own: loss shakes the colours of a layer whose alpha is kept. */
static void
a_rim_with_a_varied_inside_belongs_to_its_stroke (void)
{
  static const char *const art[] = { "AAAAAAAAAA", "AAAAAAAAAA", "BBBBBBBBCC", NULL };
  int                      rgb[3][3] = { { 200, 0, 0 }, { 180, 20, 0 }, { 181, 21, 0 } };

  for (uint32_t varied = 2; varied <= 3; varied++)
    {
      CeldScribbleLayer r = reading_new (art, rgb, 3);

      r.colour[2].interior = 8;
      r.colour[3].interior = varied;
      cluster (&r, 2);
      CHECK ((r.colour[2].cluster == r.colour[1].cluster) == (varied == 3));
      CHECK (r.colour[3].cluster == r.colour[2].cluster);
      reading_clear (&r);
    }
}

/* C is as near to A's colour as to B's, and nearer to that of D: but B is what it touches. */
static void
a_rim_belongs_to_what_it_touches (void)
{
  static const char *const art[] = {
    "AAAAAADDDDDDD", "AAAAAADDDDDDD", "...........D.", "BBBBBBBB.....", "BBBBBBBB.....", "CCCCCC.......", NULL
  };
  int               rgb[4][3] = { { 200, 0, 0 }, { 160, 20, 0 }, { 180, 10, 0 }, { 180, 20, 0 } };
  CeldScribbleLayer r = reading_new (art, rgb, 4);

  r.colour[3].interior = 0;
  cluster (&r, 4);
  CHECK (r.colour[3].cluster == r.colour[2].cluster);
  reading_clear (&r);
}

/* Paper is what equals its colour, even where the first step of a soft edge is nearer. */
static void
what_equals_paper_is_paper (void)
{
  static const char *const art[] = { "AAAAAAAAAA", "AAAAAAAAAA", "CCCCCCCCCC", "BBBBBBBBBB", NULL };
  int               rgb[3][3] = { { 255, 255, 255 }, { 255, 251, 255 }, { 255, 253, 255 } };
  CeldScribbleLayer r = reading_new (art, rgb, 3);

  r.paper = 1;
  cluster (&r, 1);
  CHECK (r.colour[3].cluster == 0);
  reading_clear (&r);
}

int
main (void)
{
  RUN (colours_within_the_radius_are_one);
  RUN (a_label_needs_four_solid_pixels);
  RUN (one_pixel_is_a_label_in_pixel_art);
  RUN (fringes_of_others_do_not_count);
  RUN (a_rim_belongs_to_its_stroke);
  RUN (a_rim_with_a_varied_inside_belongs_to_its_stroke);
  RUN (a_rim_belongs_to_what_it_touches);
  RUN (what_equals_paper_is_paper);
  return DONE;
}
