/* A scene from a picture and a depth map alone, for example a painted or an estimated one.
 *
 * A row is cut at depth discontinuities, where depth changes by more than may be stretched.  There the farther span
 * continues under the nearer one, as far as any view can uncover it, in the colour of its paper near the cut: the mean
 * of some pixels without ink, so that no line smears.  Pixels of the farther span that show the antialiased edge of the
 * nearer one's ink are treated as that ink over paper; otherwise a ghost of the line would stay behind.
 *
 * Spans are ordered by their mean depth, in steps of half a discontinuity.  A long slope that begins behind something
 * and ends in front of it may be ordered wrongly; scenes from layers (scene.c) do not have this limitation.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "stereo/scene.h"

#define MAX_STRETCH    0.25  /* pixels of disparity; a larger step is a discontinuity; chosen */
#define MAX_GROUPS     256   /* groups of depth, at most; chosen */
#define MAX_SOFT_EDGE  6     /* pixels of an antialiased edge along a row, at most; chosen */
#define PAPER_SEARCH   24    /* pixels searched for paper beside a discontinuity; chosen */
#define PAPER_SAMPLES  4     /* pixels of paper that are averaged; chosen */
#define FILL_OVERLAP   2     /* pixels by which filling overlaps the visible part; chosen */
#define PAPER_INK      0.98f /* ink above this is paper; chosen */
#define GREY_PAPER_INK 0.8f  /* ink above this is paper where it changes by less than MAX_PAPER_STEP: paper need not
                              * be white; chosen */
#define MAX_PAPER_STEP 0.02f

typedef struct
{
  const CeldColours *art;
  const CeldPlane   *ink;
  CeldScene         *scene;
  float             *depths;         /* of a row */
  float              cut;            /* difference of depth that is a discontinuity */
  double             shift;          /* largest shift in pixels for each unit of depth */
  double             steps;          /* groups for each unit of depth */
  size_t            *spans, *pixels; /* of each part, while spans are counted; then NULL */
  int                y;
} SceneBuilder;

/* ------------------------------------------------------------------ soft edges and paper */

static bool
is_cut (const SceneBuilder *m, int x, int other)
{
  return fabsf (m->depths[x] - m->depths[other]) > m->cut;
}

/* The number of pixels beyond x, the last pixel of the nearer span, with the antialiased edge of its ink. */
static int
soft_edge (const SceneBuilder *m, int x, int direction)
{
  float last = CELD_AT (m->ink, x, m->y);

  if (!(last < 0.5f))
    return 0;
  for (int k = 1; k <= MAX_SOFT_EDGE; k++)
    {
      int   at = x + k * direction;
      float ink;

      if (at < 0 || at >= m->scene->width || (k > 1 && is_cut (m, at, at - direction)))
        return 0; /* the farther span ends here */
      ink = CELD_AT (m->ink, at, m->y);
      if (ink < last)
        return 0; /* a line of the farther span */
      if (ink > PAPER_INK || (ink > GREY_PAPER_INK && ink - last < MAX_PAPER_STEP))
        return k - 1;
      last = ink;
    }
  return 0;
}

static void
premultiplied (const SceneBuilder *m, int x, float colour[4])
{
  const float *rgba = CELD_RGBA (m->art, x, m->y);

  colour[3] = rgba[3] > 0 ? fminf (rgba[3], 1) : 0;
  for (int c = 0; c < 3; c++)
    colour[c] = fabsf (rgba[c]) <= FLT_MAX ? rgba[c] * colour[3] : 0;
}

/* The mean colour of paper from x on; if there is only a line, beyond it, as long as depth is at most `most`.
 * Returns false, with the brightest pixel's colour, if there is no paper. */
static bool
average_paper (const SceneBuilder *m, int x, int direction, float most, float colour[4])
{
  float lightest = -1, sum[4] = { 0 }, one[4];
  int   n = 0;

  for (int k = 0; k < PAPER_SEARCH && n < PAPER_SAMPLES; k++)
    {
      int   at = x + k * direction;
      float ink;

      if (at < 0 || at >= m->scene->width || m->depths[at] > most || (n && is_cut (m, at, at - direction)))
        break;
      ink = CELD_AT (m->ink, at, m->y);
      premultiplied (m, at, one);
      if (ink > lightest)
        memcpy (colour, one, sizeof one);
      lightest = fmaxf (lightest, ink);
      for (int c = 0; c < 4 && ink > GREY_PAPER_INK; c++)
        sum[c] += one[c];
      n += ink > GREY_PAPER_INK;
    }
  for (int c = 0; c < 4 && n; c++)
    colour[c] = sum[c] / (float) n;
  return n > 0;
}

static void
paper_of (const SceneBuilder *m, int x, int direction, float colour[4])
{
  if (!average_paper (m, x, direction, m->depths[x] + m->cut, colour))
    average_paper (m, x, direction, FLT_MAX, colour);
}

/* ------------------------------------------------------------------ spans */

/* Counts a span, or adds it; returns NULL while spans are counted.  The product can be rounded up to a step beyond the
 * last one. */
static CeldSceneSpan *
add_span (SceneBuilder *m, int x, int n, double depth, bool filling)
{
  double above = fmin (fmax (depth, m->scene->least), m->scene->most) - m->scene->least;
  size_t step = (size_t) (above * m->steps), last = m->scene->n_parts / 2 - 1;
  size_t group = 2 * (step < last ? step : last) + !filling;

  if (!m->spans)
    return celd_scene_spans_add (&m->scene->part[group], x, m->y, n, (uint32_t) group);
  m->spans[group]++;
  m->pixels[group] += (size_t) n;
  return NULL;
}

static double
mean_depth (const SceneBuilder *m, int first, int end)
{
  double sum = 0;

  for (int x = first; x < end; x++)
    sum += (double) m->depths[x];
  return sum / (end - first);
}

/* Adds the pixels that views may uncover beside the end x of a farther span, whose other pixels lie in `direction`;
 * the first `soft` of them show the antialiased edge of the nearer span. */
static void
fill_behind (SceneBuilder *m, int x, int direction, int soft, int length, double group_depth)
{
  float          depth = m->depths[x], paper[4] = { 0 };
  int            most = (int) (m->shift * (m->scene->most - (double) depth)) + 3, hidden = 0;
  int            shown = soft + FILL_OVERLAP < length ? soft + FILL_OVERLAP : length;
  int            first, n;
  CeldSceneSpan *s;

  while (hidden < most && x - (hidden + 1) * direction >= 0 && x - (hidden + 1) * direction < m->scene->width &&
         m->depths[x - (hidden + 1) * direction] > depth + m->cut / 2)
    hidden++;
  n     = hidden + shown;
  first = direction > 0 ? x - hidden : x - shown + 1;
  s     = add_span (m, first, n, group_depth, true);
  if (!s)
    return;
  paper_of (m, soft + 1 < length ? x + (soft + 1) * direction : x, direction, paper); /* the next pixel may be
                                                                                       * antialiased, too */
  for (int k = 0; k < n; k++)
    {
      int inside = (first + k - x) * direction; /* pixels into the span */

      if (inside >= soft)
        premultiplied (m, first + k, s->colour + 4 * k);
      else
        memcpy (s->colour + 4 * k, paper, sizeof paper);
      s->depths[k] = inside > 0 ? m->depths[first + k] : depth;
    }
  celd_scene_span_pad (s, m->scene->width);
}

/* The ink of a soft edge over the paper beyond, so that both together give the art. */
static void
soft_pixel (const SceneBuilder *m, int x, const float paper[4], float colour[4])
{
  float alpha = 1 - CELD_AT (m->ink, x, m->y);

  premultiplied (m, x, colour);
  alpha = alpha > 0 ? fminf (alpha, 1) : 0;
  for (int c = 3; c >= 0; c--)
    colour[c] = fmaxf (0, fminf (colour[c] - (1 - alpha) * paper[c], c < 3 ? colour[3] : 1));
}

/* Adds the art from `first` to before `end`, with soft[0] and soft[1] pixels of antialiased ink beyond its ends. */
static void
add_visible_span (SceneBuilder *m, int first, int end, const int soft[2], double group_depth)
{
  CeldSceneSpan *s = add_span (m, first - soft[0], end - first + soft[0] + soft[1], group_depth, false);
  float          paper[2][4] = { { 0 } };

  if (!s)
    return;
  if (soft[0])
    paper_of (m, first - soft[0] > 1 ? first - soft[0] - 2 : 0, -1, paper[0]);
  if (soft[1])
    paper_of (m, end + soft[1] + 1 < m->scene->width ? end + soft[1] + 1 : end + soft[1], 1, paper[1]);
  for (int k = 0; k < s->n; k++)
    {
      int x = s->x + k;

      if (x < first || x >= end)
        soft_pixel (m, x, paper[x >= end], s->colour + 4 * k);
      else
        premultiplied (m, x, s->colour + 4 * k);
      s->depths[k] = m->depths[x < first ? first : x < end ? x : end - 1];
    }
  celd_scene_span_pad (s, m->scene->width);
}

/* Handles the pixels from `first` to before `end`, between two discontinuities: a nearer end gets a soft edge, a
 * farther one is continued. */
static void
make_segment (SceneBuilder *m, int first, int end)
{
  int    soft[2] = { 0, 0 }, lost[2] = { 0, 0 };
  double depth = mean_depth (m, first, end);
  bool   below[2] = { first > 0 && m->depths[first - 1] > m->depths[first],
                      end < m->scene->width && m->depths[end] > m->depths[end - 1] };

  if (below[0])
    lost[0] = soft_edge (m, first - 1, 1);
  else if (first > 0)
    soft[0] = soft_edge (m, first, -1);
  if (below[1])
    lost[1] = soft_edge (m, end, -1);
  else if (end < m->scene->width)
    soft[1] = soft_edge (m, end - 1, 1);
  if (below[0])
    fill_behind (m, first, 1, lost[0], end - first, depth);
  if (below[1])
    fill_behind (m, end - 1, -1, lost[1], end - first, depth);
  if (first + lost[0] < end - lost[1])
    add_visible_span (m, first + lost[0], end - lost[1], soft, depth);
}

static void
make_row (SceneBuilder *m, const CeldPlane *depth, int y)
{
  int first = 0;

  m->y = y;
  for (int x = 0; x < depth->width; x++)
    {
      float value = CELD_AT (depth, x, y);

      m->depths[x] = fabsf (value) <= FLT_MAX ? celd_scene_depth (value) : (float) m->scene->least;
    }
  for (int x = 1; x <= depth->width; x++)
    if (x == depth->width || is_cut (m, x, x - 1))
      {
        make_segment (m, first, x);
        first = x;
      }
}

/* ------------------------------------------------------------------ */

static bool
is_opaque (const CeldColours *art)
{
  for (int y = 0; y < art->height; y++)
    for (int x = 0; x < art->width; x++)
      if (!(CELD_RGBA (art, x, y)[3] >= 1))
        return false;
  return true;
}

static CeldStatus
make_rows (SceneBuilder *m, const CeldPlane *depth, const CeldHost *host, double from)
{
  CeldStatus status = CELD_OK;

  for (int y = 0; y < depth->height && status == CELD_OK; y++)
    {
      make_row (m, depth, y);
      if (y % 64 == 63)
        status = celd_progress (host, from + 0.5 * y / depth->height);
    }
  return status;
}

/* Counts all spans, allocates them, and makes them. */
static CeldStatus
make_scene (SceneBuilder *m, const CeldPlane *depth, const CeldHost *host)
{
  size_t     groups = m->scene->n_parts;
  CeldStatus status = make_rows (m, depth, host, 0);

  for (size_t k = 0; k < groups && status == CELD_OK; k++)
    status = celd_scene_spans_new (m->spans[k], m->pixels[k], &m->scene->part[k]);
  celd_free (m->spans);
  m->spans = NULL;
  return status != CELD_OK ? status : make_rows (m, depth, host, 0.5);
}

CeldStatus
celd_scene_of_depth (const CeldColours *art, const CeldPlane *ink, const CeldPlane *depth, const CeldSettings *settings,
                     const CeldHost *host, CeldScene **result)
{
  SceneBuilder m = { .art = art, .ink = ink };
  double       least, most, steps;
  CeldStatus   status;

  if (!CELD_SAME_SIZE (art, depth) || !CELD_SAME_SIZE (ink, depth))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;
  celd_depth_range (depth, &least, &most);
  m.shift = (double) settings->disparity * depth->width / 2;
  m.cut   = (float) fmin (MAX_STRETCH / fmax (m.shift, 1e-9), 1e6);
  steps   = fmin (fmax (2 * (most - least) / (double) m.cut, 1), MAX_GROUPS);
  m.steps = most > least ? steps / (most - least) : 0;
  status  = celd_scene_new (depth->width, depth->height, 2 * ((size_t) steps + 1), &m.scene);
  if (status == CELD_OK)
    {
      m.scene->least = least;
      m.scene->most  = most;
      m.scene->separate = true;
      m.scene->opaque   = is_opaque (art);
      m.depths = celd_alloc ((size_t) depth->width, sizeof *m.depths);
      m.spans  = celd_alloc0 (m.scene->n_parts, sizeof *m.spans);
      m.pixels = celd_alloc0 (m.scene->n_parts, sizeof *m.pixels);
      status = m.depths && m.spans && m.pixels ? make_scene (&m, depth, host) : CELD_NO_MEMORY;
    }
  if (status == CELD_OK)
    status = celd_scene_sort (m.scene);
  celd_free (m.depths);
  celd_free (m.spans);
  celd_free (m.pixels);
  if (status != CELD_OK)
    celd_scene_free (m.scene);
  else
    *result = m.scene;
  return status;
}
