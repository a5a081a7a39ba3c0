/* Mixtures of two strokes, and colours that only look like one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "reading.h"
#include "input/input.h"

/* Is colour C still a label?  A and B must be.  Each colour is a cluster of its own, but for the paper, colour D. */
static bool
is_label (const char *const *art, int (*rgb)[3], bool on_paper, int opacity)
{
  CeldScribbleLayer r = reading_new (art, rgb, 4);
  bool              label;

  r.kind = malloc (r.pixels);
  memset (r.kind, CELD_SOLID, r.pixels);
  r.paper = on_paper ? 4 : 0;
  r.n_clusters = 4;
  r.cluster = calloc (r.n_clusters, sizeof *r.cluster);
  for (uint32_t k = 1; k < 4; k++)
    {
      memcpy (r.cluster[k].channel, r.colour[k].channel, sizeof r.colour[k].channel);
      r.colour[k].cluster = k;
      r.cluster[k].is_label = true;
      r.cluster[k].pixels = r.colour[k].pixels;
      r.cluster[k].opacity = r.colour[k].pixels * (uint64_t) (on_paper ? 255 : k == 3 ? opacity : 128);
    }
  CHECK (celd_scribble_overlaps (&r) == CELD_OK);
  CHECK (r.cluster[1].is_label && r.cluster[2].is_label);
  label = r.cluster[3].is_label;
  free (r.kind);
  reading_clear (&r);
  return label;
}

/* A runs across, B down, C is where they cross. */
static const char *const crossing_on_paper[] = {
  "DDDDBBBBDDDD", "DDDDBBBBDDDD", "DDDDBBBBDDDD", "AAAACCCCAAAA", "AAAACCCCAAAA", "AAAACCCCAAAA", "AAAACCCCAAAA",
  "DDDDBBBBDDDD", "DDDDBBBBDDDD", "DDDDBBBBDDDD", NULL
};
static const char *const crossing[] = {
  "....BBBB....", "....BBBB....", "....BBBB....", "AAAACCCCAAAA", "AAAACCCCAAAA", "AAAACCCCAAAA", "AAAACCCCAAAA",
  "....BBBB....", "....BBBB....", "....BBBB....", NULL
};

/* Half opaque red and blue on white. */
static void
a_mixture_on_paper_is_no_label (void)
{
  int mixed[4][3] = { { 255, 128, 128 }, { 128, 128, 255 }, { 192, 64, 128 }, { 255, 255, 255 } };
  int green[4][3] = { { 255, 128, 128 }, { 128, 128, 255 }, { 64, 192, 64 }, { 255, 255, 255 } };
  int between[4][3] = { { 255, 128, 128 }, { 128, 128, 255 }, { 192, 128, 192 }, { 255, 255, 255 } };

  CHECK (!is_label (crossing_on_paper, mixed, true, 255));
  CHECK (is_label (crossing_on_paper, green, true, 255));
  CHECK (is_label (crossing_on_paper, between, true, 255));
}

static void
a_mixture_without_paper_is_more_opaque (void)
{
  int mixed[4][3] = { { 255, 0, 0 }, { 0, 0, 255 }, { 170, 0, 85 }, { 0, 0, 0 } };

  CHECK (!is_label (crossing, mixed, false, 192));
  CHECK (is_label (crossing, mixed, false, 128));
}

static void
a_mixture_that_touches_one_stroke_is_a_label (void)
{
  static const char *const apart[] = {
    "BBBBDDDDDDDD", "BBBBDDDDDDDD", "DDDDDDDDDDDD", "DDDDDDDDDDDD", "DDDDDDDDDDDD", "AAAACCCCDDDD", "AAAACCCCDDDD", NULL
  };
  int mixed[4][3] = { { 255, 128, 128 }, { 128, 128, 255 }, { 192, 64, 128 }, { 255, 255, 255 } };

  CHECK (is_label (apart, mixed, true, 255));
}

/* C only adjoins A and B, and is on paper for the most part: a stroke of its own, whatever its colour. */
static void
a_mixture_that_lies_on_paper_is_a_label (void)
{
  static const char *const beside[] = {
    "AAAADDDDDDDDDDDDDDDDDDDDDDDDDDDDBBBB",
    "AAAADDDDDDDDDDDDDDDDDDDDDDDDDDDDBBBB",
    "AAAADDDDDDDDDDDDDDDDDDDDDDDDDDDDBBBB",
    "AAAACCCCCCCCCCCCCCCCCCCCCCCCCCCCBBBB",
    "AAAACCCCCCCCCCCCCCCCCCCCCCCCCCCCBBBB",
    "AAAACCCCCCCCCCCCCCCCCCCCCCCCCCCCBBBB",
    "AAAADDDDDDDDDDDDDDDDDDDDDDDDDDDDBBBB",
    "AAAADDDDDDDDDDDDDDDDDDDDDDDDDDDDBBBB",
    "AAAADDDDDDDDDDDDDDDDDDDDDDDDDDDDBBBB",
    NULL
  };
  int mixed[4][3] = { { 255, 128, 128 }, { 128, 128, 255 }, { 192, 64, 128 }, { 255, 255, 255 } };

  CHECK (is_label (beside, mixed, true, 255));
}

/* B ends upon A and lies along it, so that most of C sees B neither across nor near by. */
static void
a_mixture_of_strokes_that_lie_along_each_other_is_no_label (void)
{
  static const char *const along[] = {
    "DDDDDDDAAAAAAAAAAAAAAAAAAAAAA", "DDDDDDDAAAAAAAAAAAAAAAAAAAAAA", "BBBBBBBCCCCCCCCCCCCCCCCCCAAAA",
    "BBBBBBBCCCCCCCCCCCCCCCCCCAAAA", "BBBBBBBCCCCCCCCCCCCCCCCCCAAAA", NULL
  };
  static const char *const along_without_paper[] = {
    ".......AAAAAAAAAAAAAAAAAAAAAA", ".......AAAAAAAAAAAAAAAAAAAAAA", "BBBBBBBCCCCCCCCCCCCCCCCCCAAAA",
    "BBBBBBBCCCCCCCCCCCCCCCCCCAAAA", "BBBBBBBCCCCCCCCCCCCCCCCCCAAAA", NULL
  };
  int on_white[4][3] = { { 255, 128, 128 }, { 128, 128, 255 }, { 192, 64, 128 }, { 255, 255, 255 } };
  int pure[4][3] = { { 255, 0, 0 }, { 0, 0, 255 }, { 170, 0, 85 }, { 0, 0, 0 } };

  CHECK (!is_label (along, on_white, true, 255));
  CHECK (!is_label (along_without_paper, pure, false, 192));
  CHECK (is_label (along_without_paper, pure, false, 128));
}

/* C is where A, of an opacity of .4, crosses itself; and a red that A, of a paint that would have to be darker than
 * black, cannot show. */
static void
a_stroke_that_crosses_itself_is_one_label (void)
{
  static const char *const itself[] = {
    "BBDDDDDDAAAADDDD", "BBDDDDDDAAAADDDD", "BBDDDDDDAAAADDDD", "BBDDAAAACCCCAAAA", "BBDDAAAACCCCAAAA",
    "BBDDAAAACCCCAAAA",
    "BBDDAAAACCCCAAAA", "BBDDDDDDAAAADDDD", "BBDDDDDDAAAADDDD", NULL
  };
  int once[4][3] = { { 255, 153, 153 }, { 128, 128, 255 }, { 255, 92, 92 }, { 255, 255, 255 } };
  int dark[4][3] = { { 255, 153, 153 }, { 128, 128, 255 }, { 255, 61, 61 }, { 255, 255, 255 } };
  int other[4][3] = { { 255, 153, 153 }, { 128, 128, 255 }, { 255, 92, 110 }, { 255, 255, 255 } };

  CHECK (!is_label (itself, once, true, 255));
  CHECK (is_label (itself, dark, true, 255));
  CHECK (is_label (itself, other, true, 255));
}

/* C only adjoins A: a stroke of its own, also in a colour that A would show where it crosses itself. */
static void
a_tint_beside_a_stroke_is_a_label (void)
{
  static const char *const beside[] = {
    "BBDDDDDDDDDD", "BBDDAAAACCCC", "BBDDAAAACCCC", "BBDDAAAACCCC", "BBDDAAAACCCC", "BBDDDDDDDDDD", NULL
  };
  int once[4][3] = { { 255, 153, 153 }, { 128, 128, 255 }, { 255, 92, 92 }, { 255, 255, 255 } };

  CHECK (is_label (beside, once, true, 255));
}

int
main (void)
{
  RUN (a_mixture_on_paper_is_no_label);
  RUN (a_mixture_without_paper_is_more_opaque);
  RUN (a_mixture_that_touches_one_stroke_is_a_label);
  RUN (a_mixture_that_lies_on_paper_is_a_label);
  RUN (a_mixture_of_strokes_that_lie_along_each_other_is_no_label);
  RUN (a_stroke_that_crosses_itself_is_one_label);
  RUN (a_tint_beside_a_stroke_is_a_label);
  return DONE;
}
