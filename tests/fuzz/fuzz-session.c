/* A session that is edited at random gives what a new one gives that is told the same, and says what has changed.
 *
 * Ink, labels, levels and ownership are equal pixel by pixel; what is solved (depth, normals, shading, exact depth)
 * within the error that is asked for.  A picture has changed nowhere but in the rectangle that the session returns, and
 * everywhere after a drawing of another size.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "fuzz.h"

#define MOST_SIDE  40
#define PIXELS     (MOST_SIDE * MOST_SIDE)
#define STROKES    3
#define RELATIONS  2
#define MOST_EDITS 24
#define CLOSE      0.02f /* of the range of solved results, whose error is at most 1e-4 as the solver measures it */

typedef enum { SCRIBBLES, ARROWS, CONTOURS, CORRECTIONS, HIDDEN, LAYERS } Layer;

/* What a host has told a session. */
typedef struct
{
  int          width, height;
  float        luma[PIXELS], alpha[PIXELS], hint[PIXELS];
  bool         has_alpha, has_hint, has[LAYERS];
  uint8_t      layer[LAYERS][4 * PIXELS];
  const char  *text, *path, *relation[RELATIONS];
  struct { bool on; int x, y, width, height; uint8_t colour[3]; } stroke[STROKES];
  uint32_t     latest[STROKES]; /* strokes by when they were painted first */
  uint32_t     newest;          /* relation, by when it was put last: of equally heavy ones a later one gives way */
  CeldSettings settings;
} Host;

/* A result as the host had it last. */
typedef struct { int width, height; size_t pixel; uint8_t *data; } Seen;

enum { INK, LABELS, UNEXPANDED, LEVELS, OWNER, DEPTH, PREVIEW, NORMALS, SHADING, EXACT, RESULTS };

static const uint8_t colours[8][3] = {
  { 230, 0, 0 }, { 0, 0, 230 }, { 0, 160, 0 }, { 200, 200, 0 }, { 255, 0, 0 }, { 0, 0, 255 }, { 0, 255, 0 },
  { 255, 128, 0 },
};

static const char *const texts[] = {
  "", "#e60000 > #0000e6", "10,10 > 30,30; 2,2 < 30,20", "12,30 > 30,6 = 20,20", "5,5 > 20,20; 20,20 > 5,5 @2",
  "#0000e6 > #00a000 +2.5", "1,1 > 99,99",
};
static const char *const paths[] = { "", "M 5,5 L 30,30", "M2 2 l20 0 M 30 30 L 4 30" };

/* ------------------------------------------------------------------ edits */

static void
draw_box (Host *h, FuzzInput *input)
{
  int   x0 = fuzz_below (input, h->width), y0 = fuzz_below (input, h->height), w = 4 + fuzz_below (input, 24);
  int   tall = 4 + fuzz_below (input, 24), gap = fuzz_below (input, 5);
  float grey = fuzz_below (input, 4) ? 0 : 0.4f;

  for (int y = y0; y < y0 + tall && y < h->height; y++)
    for (int x = x0; x < x0 + w && x < h->width; x++)
      {
        bool rim = x < x0 + 2 || y < y0 + 2 || x >= x0 + w - 2 || y >= y0 + tall - 2;

        h->luma[y * h->width + x] = rim && !(x < x0 + 2 && y >= y0 + 4 && y < y0 + 4 + gap) ? grey : 1;
      }
}

static void
paint_line (Host *h, Layer layer, FuzzInput *input)
{
  const uint8_t *ink = colours[fuzz_below (input, 8)];
  int            x = fuzz_below (input, h->width), y = fuzz_below (input, h->height);
  int            dx = fuzz_below (input, 31) - 15, dy = fuzz_below (input, 31) - 15;
  int            steps = abs (dx) > abs (dy) ? abs (dx) : abs (dy);

  for (int s = 0; s <= steps; s++)
    for (int k = 0; k < 4; k++)
      {
        int u = x + (steps ? s * dx / steps : 0) + k % 2, v = y + (steps ? s * dy / steps : 0) + k / 2;

        if (u < 0 || v < 0 || u >= h->width || v >= h->height)
          continue;
        memcpy (h->layer[layer] + 4 * (v * h->width + u), ink, 3);
        h->layer[layer][4 * (v * h->width + u) + 3] = 255;
      }
}

static void
new_drawing (Host *h, FuzzInput *input, bool resized)
{
  if (resized)
    {
      h->width = 1 + fuzz_below (input, MOST_SIDE);
      h->height = 1 + fuzz_below (input, MOST_SIDE);
    }
  for (int p = 0; p < PIXELS; p++)
    {
      h->luma[p] = 1;
      h->alpha[p] = p % 3 ? 1 : 0.5f;
    }
  h->has_alpha = fuzz_below (input, 4) == 0;
  for (int boxes = fuzz_below (input, 4); boxes > 0; boxes--)
    draw_box (h, input);
}

static void
change_settings (CeldSettings *s, FuzzInput *input)
{
  switch (fuzz_below (input, 25))
    {
    case 0: s->ink = (CeldInkMode) fuzz_below (input, 4); break;
    case 1: s->ink_threshold = fuzz_between (input, 0, 0.9f); break;
    case 2: s->method = (CeldMethod) fuzz_below (input, 3); break;
    case 3: s->close_gaps = !s->close_gaps; break;
    case 4: s->keep_necks = !s->keep_necks; break;
    case 5: s->hardness = fuzz_between (input, 0.01f, 1); break;
    case 6: s->flats = !s->flats; break;
    case 7: s->background = (CeldBackground) fuzz_below (input, 3); break;
    case 8: s->seeds = (CeldSeeds) fuzz_below (input, 2); break;
    case 9: s->same_colour = (CeldSameColour) fuzz_below (input, 2); break;
    case 10: s->suggest = (CeldSuggest) fuzz_below (input, 3); break;
    case 11: s->on_cycle = (CeldOnCycle) fuzz_below (input, 3); break;
    case 12: s->arrow_style = (CeldArrowStyle) fuzz_below (input, 4); break;
    case 13: s->encoding = (CeldEncoding) fuzz_below (input, 3); break;
    case 14: s->expansion = (CeldExpansion) fuzz_below (input, 2); break;
    case 15: s->anchors = (CeldAnchors) fuzz_below (input, 4); break;
    case 16: s->hold_rest = !s->hold_rest; break;
    case 17: s->contrast = fuzz_between (input, 0.1f, 10); break;
    case 18: s->bulge = fuzz_between (input, 0, 4); break;
    case 19: s->bevel = fuzz_between (input, 0, 0.5f); break;
    case 20: s->frame_outline = !s->frame_outline; break;
    case 21: s->light_azimuth = fuzz_between (input, -360, 360); break;
    case 22: s->near_level = fuzz_between (input, 1, 9); break;
    case 23: s->hold_gaps = !s->hold_gaps; break;
    case 24: memcpy (s->background_colour, colours[fuzz_below (input, 8)], 3); break;
    }
}

/* ------------------------------------------------------------------ telling a session */

static void
tell_drawing (CeldSession *session, Host *h)
{
  size_t      w = (size_t) h->width;
  CeldDrawing drawing = { { h->width, h->height, w, h->luma },
                          { h->width, h->height, w, h->has_alpha ? h->alpha : NULL } };

  FUZZ_CHECK (celd_session_set_drawing (session, &drawing) == CELD_OK);
}

static void
tell_layer (CeldSession *session, Host *h, Layer layer)
{
  static CeldStatus (*const set[LAYERS]) (CeldSession *, const CeldPaint *) = {
    celd_session_set_scribbles, celd_session_set_arrows, celd_session_set_contours, celd_session_set_corrections,
    celd_session_set_hidden,
  };
  CeldPaint paint = { h->width, h->height, (size_t) h->width, h->layer[layer] };

  FUZZ_CHECK (set[layer] (session, h->has[layer] ? &paint : NULL) == CELD_OK);
}

static void
tell_hint (CeldSession *session, Host *h)
{
  CeldPlane hint = { h->width, h->height, (size_t) h->width, h->hint };

  FUZZ_CHECK (celd_session_set_depth_hint (session, h->has_hint ? &hint : NULL) == CELD_OK);
}

static void
tell_stroke (CeldSession *session, const Host *h, uint32_t i)
{
  static uint8_t on[256];
  CeldMask       mask = { h->stroke[i].width, h->stroke[i].height, (size_t) h->stroke[i].width, on };

  memset (on, 1, sizeof on);
  if (h->stroke[i].on)
    FUZZ_CHECK (celd_session_put_stroke (session, i + 1, h->stroke[i].x, h->stroke[i].y, &mask,
                                         h->stroke[i].colour) == CELD_OK);
  else
    FUZZ_CHECK (celd_session_remove_stroke (session, i + 1) == CELD_OK);
}

static void
tell_relation (CeldSession *session, const Host *h, uint32_t i)
{
  if (h->relation[i])
    FUZZ_CHECK (celd_session_put_relation (session, i + 1, h->relation[i], NULL) == CELD_OK);
  else
    FUZZ_CHECK (celd_session_remove_relation (session, i + 1) == CELD_OK);
}

/* All of it, to a new session. */
static void
tell_all (CeldSession *session, Host *h)
{
  FUZZ_CHECK (celd_session_set_settings (session, &h->settings) == CELD_OK);
  tell_drawing (session, h);
  for (Layer layer = 0; layer < LAYERS; layer++)
    tell_layer (session, h, layer);
  tell_hint (session, h);
  FUZZ_CHECK (celd_session_set_relations (session, h->text, NULL) == CELD_OK);
  FUZZ_CHECK (celd_session_set_arrow_path (session, h->path, NULL) == CELD_OK);
  for (uint32_t k = STROKES; k-- > 0;)
    if (h->stroke[h->latest[k]].on)
      tell_stroke (session, h, h->latest[k]);
  for (uint32_t k = 1; k <= RELATIONS; k++)
    if (h->relation[(h->newest + k) % RELATIONS])
      tell_relation (session, h, (h->newest + k) % RELATIONS);
}

/* A stroke that comes anew lies above the others; one that is changed stays where it is. */
static void
edit_stroke (CeldSession *session, Host *h, FuzzInput *input)
{
  uint32_t i = (uint32_t) fuzz_below (input, STROKES), k = 0;
  bool     was_on = h->stroke[i].on;

  h->stroke[i].on = fuzz_below (input, 4) != 0;
  h->stroke[i].x = fuzz_below (input, h->width + 8) - 4;
  h->stroke[i].y = fuzz_below (input, h->height + 8) - 4;
  h->stroke[i].width = 1 + fuzz_below (input, 16);
  h->stroke[i].height = 1 + fuzz_below (input, 16);
  memcpy (h->stroke[i].colour, colours[fuzz_below (input, 8)], 3);
  if (!was_on && h->stroke[i].on)
    {
      while (h->latest[k] != i)
        k++;
      memmove (h->latest + 1, h->latest, k * sizeof *h->latest);
      h->latest[0] = i;
    }
  if (was_on || h->stroke[i].on)
    tell_stroke (session, h, i);
}

static void
edit_layer (CeldSession *session, Host *h, Layer layer, FuzzInput *input)
{
  switch (fuzz_below (input, 4))
    {
    case 0: h->has[layer] = !h->has[layer]; break;
    case 1: memset (h->layer[layer], 0, sizeof h->layer[layer]); break;
    }
  paint_line (h, layer, input);
  tell_layer (session, h, layer);
}

/* A drawing of another size takes all layers along; single strokes stay. */
static void
edit_drawing (CeldSession *session, Host *h, FuzzInput *input)
{
  int width = h->width, height = h->height;

  if (fuzz_below (input, 3) == 0)
    new_drawing (h, input, fuzz_below (input, 2));
  else
    draw_box (h, input);
  if (h->width != width || h->height != height)
    {
      h->has_hint = false;
      memset (h->has, 0, sizeof h->has);
      memset (h->layer, 0, sizeof h->layer);
    }
  tell_drawing (session, h);
}

static void
edit_relation (CeldSession *session, Host *h, FuzzInput *input)
{
  uint32_t i = (uint32_t) fuzz_below (input, RELATIONS);
  bool     was_there = h->relation[i];

  h->relation[i] = fuzz_below (input, 4) ? texts[1] : NULL;
  if (h->relation[i] && fuzz_below (input, 2))
    h->relation[i] = "3,3 > 20,20";
  if (was_there || h->relation[i])
    tell_relation (session, h, i);
  if (h->relation[i])
    h->newest = i;
}

static void
edit (CeldSession *session, Host *h, FuzzInput *input)
{
  switch (fuzz_below (input, 17))
    {
    default: edit_stroke (session, h, input); break;
    case 16: edit_layer (session, h, HIDDEN, input); break;
    case 0: edit_drawing (session, h, input); break;
    case 1: edit_layer (session, h, SCRIBBLES, input); break;
    case 2: edit_layer (session, h, SCRIBBLES, input); break;
    case 3: edit_layer (session, h, ARROWS, input); break;
    case 4: edit_layer (session, h, CONTOURS, input); break;
    case 5: edit_layer (session, h, CORRECTIONS, input); break;
    case 6:
      h->text = texts[fuzz_below (input, 7)];
      FUZZ_CHECK (celd_session_set_relations (session, h->text, NULL) == CELD_OK);
      break;
    case 7:
      h->path = paths[fuzz_below (input, 3)];
      FUZZ_CHECK (celd_session_set_arrow_path (session, h->path, NULL) == CELD_OK);
      break;
    case 8: edit_relation (session, h, input); break;
    case 9:
    case 10:
      change_settings (&h->settings, input);
      FUZZ_CHECK (celd_session_set_settings (session, &h->settings) == CELD_OK);
      break;
    case 11:
      h->has_hint = !h->has_hint;
      for (int p = 0; p < PIXELS; p++)
        h->hint[p] = (float) (p % 17);
      tell_hint (session, h);
      break;
    }
}

/* ------------------------------------------------------------------ results */

/* A result as tight bytes; those that a failure leaves are NULL. */
static CeldStatus
ask (CeldSession *session, int result, Seen *seen, CeldRect *changed)
{
  CeldPlane     plane = { 0 };
  CeldLabels    labels = { 0 };
  CeldVectors   vectors = { 0 };
  CeldOwnership ownership = { { 0 }, { 0 }, { 0 } };
  CeldStatus    status = CELD_OK;

  switch (result)
    {
    case INK: status = celd_session_ink (session, NULL, &plane, changed); break;
    case LABELS: status = celd_session_labels (session, NULL, &labels, changed); break;
    case UNEXPANDED: status = celd_session_unexpanded_levels (session, NULL, &plane, changed); break;
    case LEVELS: status = celd_session_levels (session, NULL, &plane, changed); break;
    case OWNER: status = celd_session_ownership (session, NULL, &ownership, changed); break;
    case DEPTH: status = celd_session_depth (session, NULL, &plane, changed); break;
    case PREVIEW: status = celd_session_depth_preview (session, NULL, &plane, changed); break;
    case NORMALS: status = celd_session_normals (session, NULL, &vectors, changed); break;
    case SHADING: status = celd_session_shading (session, NULL, &plane, changed); break;
    case EXACT: status = celd_session_exact (session, NULL, &plane, changed); break;
    }
  *seen = (Seen) { .data = NULL };
  if (status != CELD_OK)
    return status;
  if (result == OWNER)
    labels = ownership.owner;
  {
    int         width = plane.data ? plane.width : labels.data ? labels.width : vectors.width;
    int         height = plane.data ? plane.height : labels.data ? labels.height : vectors.height;
    size_t      pixel = vectors.data ? 12 : 4;
    size_t      stride = plane.data ? plane.stride : labels.data ? labels.stride : vectors.stride;
    const void *data = plane.data ? (const void *) plane.data : labels.data ? (const void *) labels.data : vectors.data;

    *seen = (Seen) { width, height, pixel, malloc (pixel * (size_t) width * (size_t) height) };
    for (int y = 0; y < height; y++)
      memcpy (seen->data + pixel * (size_t) width * (size_t) y, (const uint8_t *) data + pixel * stride * (size_t) y,
              pixel * (size_t) width);
  }
  return CELD_OK;
}

/* Outside of `changed` the pictures are equal, bit by bit. */
static void
check_changed (const Seen *before, const Seen *now, CeldRect changed)
{
  bool resized = !before->data || before->width != now->width || before->height != now->height;

  FUZZ_CHECK (changed.x >= 0 && changed.y >= 0 && changed.x + changed.width <= now->width);
  FUZZ_CHECK (changed.y + changed.height <= now->height && changed.width >= 0 && changed.height >= 0);
  if (resized)
    FUZZ_CHECK (changed.width == now->width && changed.height == now->height);
  for (int y = 0; y < now->height && !resized; y++)
    for (int x = 0; x < now->width; x++)
      {
        size_t at = now->pixel * ((size_t) y * (size_t) now->width + (size_t) x);
        bool   inside = changed.width && x >= changed.x && y >= changed.y && x < changed.x + changed.width &&
                        y < changed.y + changed.height;

        FUZZ_CHECK (inside || !memcmp (before->data + at, now->data + at, now->pixel));
      }
}

/* Bit by bit, or for what is solved nearly so. */
static void
check_equal (const Seen *edited, const Seen *anew, int result)
{
  size_t n = edited->pixel * (size_t) edited->width * (size_t) edited->height / sizeof (float);
  float  least = INFINITY, most = -INFINITY;

  FUZZ_CHECK (edited->width == anew->width && edited->height == anew->height);
  if (result < DEPTH)
    {
      FUZZ_CHECK (!memcmp (edited->data, anew->data, n * sizeof (float)));
      return;
    }
  for (size_t i = 0; i < n; i++)
    {
      float value;

      memcpy (&value, anew->data + i * sizeof value, sizeof value);
      FUZZ_CHECK (isfinite (value));
      least = fminf (least, value);
      most  = fmaxf (most, value);
    }
  for (size_t i = 0; i < n; i++)
    {
      float a, b;

      memcpy (&a, anew->data + i * sizeof a, sizeof a);
      memcpy (&b, edited->data + i * sizeof b, sizeof b);
      FUZZ_CHECK (fabsf (a - b) <= CLOSE * fmaxf (most - least, 1e-3f));
    }
}

static void
compare (CeldSession *session, Host *h, int result, Seen *seen)
{
  CeldSession *other = celd_session_new ();
  CeldRect     changed = { -1, -1, -1, -1 };
  Seen         now, anew;
  CeldStatus   status = ask (session, result, &now, &changed);

  tell_all (other, h);
  FUZZ_CHECK (ask (other, result, &anew, NULL) == status);
  FUZZ_CHECK (status == CELD_OK || status == CELD_NOTHING_TO_GO_BY);
  if (status == CELD_OK)
    {
      check_changed (seen, &now, changed);
      check_equal (&now, &anew, result);
      free (seen->data);
      *seen = now;
    }
  free (anew.data);
  celd_session_free (other);
}

int
LLVMFuzzerTestOneInput (const uint8_t *data, size_t size)
{
  static Host  h;
  FuzzInput    input = { data, data + size };
  Seen         seen[RESULTS] = { { 0 } };
  CeldSession *session = celd_session_new ();

  h = (Host) { .width = MOST_SIDE, .height = MOST_SIDE, .text = "", .path = "", .latest = { 0, 1, 2 },
               .settings = celd_settings () };
  new_drawing (&h, &input, true);
  tell_all (session, &h);
  for (int edits = 0; edits < MOST_EDITS && input.next < input.end; edits++)
    {
      edit (session, &h, &input);
      if (fuzz_below (&input, 3))
        {
          int result = fuzz_below (&input, RESULTS);

          compare (session, &h, result, &seen[result]);
        }
    }
  for (int result = 0; result < RESULTS; result++)
    {
      compare (session, &h, result, &seen[result]);
      free (seen[result].data);
    }
  celd_session_free (session);
  return 0;
}
