/* The rectangles that a session reports with its results: all of a picture of a new size, nothing after no edit, and
 * every pixel that differs after others.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "base/base.h"

#define MOST_PIXELS (60 * 44)

enum { INK, LABELS, UNEXPANDED, OWNERSHIP, LEVELS, PREVIEW, DEPTH, NORMALS, SHADING, EXACT, RESULTS };

/* One result as the host last got it. */
typedef struct { int width, height; size_t bytes; uint8_t pixel[16 * MOST_PIXELS]; CeldRect changed; } Result;

static const uint8_t red[3] = { 230, 0, 0 }, blue[3] = { 0, 0, 230 };

static void
copy_pixels (Result *to, int width, int height, size_t bytes, const void *data)
{
  to->width  = width;
  to->height = height;
  to->bytes  = bytes;
  memcpy (to->pixel, data, (size_t) width * (size_t) height * bytes);
}

static void
get (CeldSession *s, int which, Result *r)
{
  static CeldStatus (*const plane_of[RESULTS]) (CeldSession *, const CeldHost *, CeldPlane *, CeldRect *) = {
    [INK] = celd_session_ink, [UNEXPANDED] = celd_session_unexpanded_levels, [LEVELS] = celd_session_levels,
    [PREVIEW] = celd_session_depth_preview, [DEPTH] = celd_session_depth, [SHADING] = celd_session_shading,
    [EXACT] = celd_session_exact,
  };
  CeldPlane     plane;
  CeldLabels    labels;
  CeldOwnership own;
  CeldVectors   normals;

  if (which == LABELS)
    {
      CHECK (celd_session_labels (s, NULL, &labels, &r->changed) == CELD_OK);
      copy_pixels (r, labels.width, labels.height, sizeof *labels.data, labels.data);
    }
  else if (which == OWNERSHIP)
    {
      CHECK (celd_session_ownership (s, NULL, &own, &r->changed) == CELD_OK);
      copy_pixels (r, own.owner.width, own.owner.height, sizeof *own.owner.data, own.owner.data);
    }
  else if (which == NORMALS)
    {
      CHECK (celd_session_normals (s, NULL, &normals, &r->changed) == CELD_OK);
      copy_pixels (r, normals.width, normals.height, 3 * sizeof *normals.data, normals.data);
    }
  else
    {
      CHECK (plane_of[which](s, NULL, &plane, &r->changed) == CELD_OK);
      copy_pixels (r, plane.width, plane.height, sizeof *plane.data, plane.data);
    }
}

static bool
is_all (const Result *r)
{
  return r->changed.x == 0 && r->changed.y == 0 && r->changed.width == r->width && r->changed.height == r->height;
}

/* Whether two results of one size are equal outside the rectangle reported with the new one. */
static bool
differs_only_inside (const Result *old, const Result *new)
{
  const CeldRect *c = &new->changed;

  for (int y = 0; y < new->height; y++)
    for (int x = 0; x < new->width; x++)
      {
        size_t at = ((size_t) y * (size_t) new->width + (size_t) x) * new->bytes;
        bool   inside = x >= c->x && x < c->x + c->width && y >= c->y && y < c->y + c->height;

        if (!inside && memcmp (old->pixel + at, new->pixel + at, new->bytes))
          return false;
      }
  return true;
}

/* Two overlapping sheets, outlined two pixels wide, the right one in front. */
static void
set_drawing (CeldSession *s, int width, int height)
{
  static float luma[MOST_PIXELS];
  CeldDrawing  drawing = { .luma = { width, height, (size_t) width, luma } };

  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        bool left = x >= 4 && x < 22 && y >= 4 && y < 20, left_paper = x >= 6 && x < 20 && y >= 6 && y < 18;
        bool right = x >= 14 && x < 36 && y >= 10 && y < 28, right_paper = x >= 16 && x < 34 && y >= 12 && y < 26;

        luma[y * width + x] = right ? right_paper : left ? left_paper : 1;
      }
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
}

/* One scribble in each sheet, from x on in the right one. */
static void
set_scribbles (CeldSession *s, int width, int height, int x)
{
  static uint8_t rgba[4 * MOST_PIXELS];
  CeldPaint      paint = { width, height, (size_t) width, rgba };

  memset (rgba, 0, sizeof rgba);
  for (int i = 0; i < 12; i++)
    {
      const uint8_t *colour = i % 2 ? red : blue;
      uint8_t       *pixel = i % 2 ? CELD_RGBA (&paint, 8 + i / 2, 8) : CELD_RGBA (&paint, x + i / 2, 20);

      memcpy (pixel, colour, 3);
      pixel[3] = 255;
    }
  CHECK (celd_session_set_scribbles (s, &paint) == CELD_OK);
}

/* Settings that take different ways through the stages. */
static void
set_way (CeldSession *s, int way)
{
  CeldSettings settings = celd_settings ();

  settings.method      = way == 1 ? CELD_METHOD_EXACT : way == 2 ? CELD_METHOD_WALKER : CELD_METHOD_BASINS;
  settings.same_colour = way == 3 ? CELD_SAME_COLOUR_SEPARATE : CELD_SAME_COLOUR_ONE;
  settings.on_cycle    = way == 4 ? CELD_ON_CYCLE_SPLIT : CELD_ON_CYCLE_REPORT;
  settings.expansion   = way == 5 ? CELD_EXPANSION_THICKNESS : CELD_EXPANSION_OUTLINES;
  settings.suggest     = way == 6 ? CELD_SUGGEST_ALL : CELD_SUGGEST_OFF;
  settings.encoding    = way == 7 ? CELD_ENCODING_FIXED : CELD_ENCODING_NORMALIZED;
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
}

#define WAYS 8

static CeldSession *
new_session (int way)
{
  CeldSession *s = celd_session_new ();

  set_way (s, way);
  set_drawing (s, 48, 36);
  set_scribbles (s, 48, 36, 20);
  CHECK (celd_session_set_relations (s, "#0000e6 > #e60000; 8,10 > 30,14 @0.5", NULL) == CELD_OK);
  return s;
}

/* Whichever results were made before, and edited, and whichever is asked for first. */
static void
another_size_changes_everything (void)
{
  static Result    r;
  static const int size[4][2] = { { 60, 36 }, { 48, 44 }, { 40, 30 }, { 48, 36 } };

  for (int way = 0; way < WAYS; way++)
    for (int made = 0; made <= RESULTS; made++) /* RESULTS: all */
      {
        CeldSession *s = new_session (way);

        for (int n = 0; n < 4; n++)
          {
            for (int edits = 0; edits < 2; edits++)
              {
                if (edits)
                  set_scribbles (s, n ? size[n - 1][0] : 48, n ? size[n - 1][1] : 36, 24);
                for (int which = 0; which < RESULTS; which++)
                  if (made == RESULTS || which == made)
                    get (s, which, &r);
              }
            set_drawing (s, size[n][0], size[n][1]);
            set_scribbles (s, size[n][0], size[n][1], 20);
            for (int i = 0; i < RESULTS; i++)
              {
                get (s, n % 2 ? RESULTS - 1 - i : i, &r);
                CHECK (is_all (&r) && r.width > 0);
              }
          }
        celd_session_free (s);
      }
}

static void
the_same_drawing_again_changes_nothing (void)
{
  static Result r;

  for (int way = 0; way < WAYS; way++)
    {
      CeldSession *s = new_session (way);

      for (int which = 0; which < RESULTS; which++)
        get (s, which, &r);
      set_drawing (s, 48, 36);
      set_scribbles (s, 48, 36, 20);
      for (int which = 0; which < RESULTS; which++)
        {
          get (s, which, &r);
          CHECK (r.changed.width == 0);
        }
      celd_session_free (s);
    }
}

/* Gets all results and compares them with those before, which they replace. */
static void
check_changes (CeldSession *s, Result *old)
{
  static Result new;

  for (int which = 0; which < RESULTS; which++)
    {
      get (s, which, &new);
      CHECK (new.width == old[which].width && new.height == old[which].height);
      CHECK (differs_only_inside (&old[which], &new));
      old[which] = new;
    }
}

static void
scribbles_and_settings_change_only_the_rectangle (void)
{
  static Result old[RESULTS];

  for (int way = 0; way < WAYS; way++)
    {
      CeldSession *s = new_session (way);

      for (int which = 0; which < RESULTS; which++)
        get (s, which, &old[which]);
      for (int edit = 0; edit < 6; edit++)
        {
          if (edit % 2)
            set_way (s, (way + edit) % WAYS);
          else
            set_scribbles (s, 48, 36, edit == 2 ? 38 : 24); /* 38: outside of the right sheet */
          check_changes (s, old);
        }
      celd_session_free (s);
    }
}

int
main (void)
{
  RUN (another_size_changes_everything);
  RUN (the_same_drawing_again_changes_nothing);
  RUN (scribbles_and_settings_change_only_the_rectangle);
  return DONE;
}
