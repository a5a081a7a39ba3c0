/* Random states of a session, edited step by step.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef RANDOM_SESSION_H
#define RANDOM_SESSION_H

#include "session/session.h"
#include "check.h"

#define W 56
#define H 40
#define STROKES 6

/* The input of a session, at random. */
typedef struct
{
  float        luma[W * H];
  uint8_t      scribbles[4 * W * H], contours[4 * W * H];
  bool         has_scribbles, has_contours, relation;
  const char  *text;
  CeldSettings settings;
  struct { uint32_t id; CeldRect box; uint8_t colour; } stroke[STROKES];
  uint32_t     n_strokes;
} State;

static const uint8_t colours[6][3] = {
  { 230, 0, 0 }, { 0, 0, 230 }, { 0, 160, 0 }, { 200, 200, 0 }, { 160, 0, 160 }, { 231, 1, 0 } /* nearly the first */
};

static const char *const texts[] = { "", "#e60000 > #0000e6", "10,10 > 40,30; 2,2 < 30,20", "12,34 > 50,6 = 20,20" };

static inline uint32_t
pick (uint32_t *state, uint32_t n)
{
  return check_random (state, n);
}

static inline CeldRect
random_box (uint32_t *r, int least, int most)
{
  int w = least + (int) pick (r, (uint32_t) (most - least)), h = least + (int) pick (r, (uint32_t) (most - least));

  return (CeldRect) { (int) pick (r, (uint32_t) (W - w)), (int) pick (r, (uint32_t) (H - h)), w, h };
}

static inline void
paint_box (uint8_t *paint, CeldRect box, const uint8_t colour[3])
{
  for (int y = box.y; y < box.y + box.height; y++)
    for (int x = box.x; x < box.x + box.width; x++)
      {
        memcpy (paint + 4 * (y * W + x), colour, 3);
        paint[4 * (y * W + x) + 3] = 255;
      }
}

/* Frames with gaps, one over the other, some of them in grey ink. */
static inline void
draw_frame (float *luma, CeldRect box, int gap)
{
  float grey = box.width % 3 ? 0 : 0.4f;

  for (int y = box.y; y < box.y + box.height; y++)
    for (int x = box.x; x < box.x + box.width; x++)
      {
        bool rim = x < box.x + 2 || y < box.y + 2 || x >= box.x + box.width - 2 || y >= box.y + box.height - 2;

        luma[y * W + x] = rim && !(y >= box.y + 4 && y < box.y + 4 + gap && x < box.x + 2) ? grey : 1.f;
      }
}

static inline void
new_drawing (State *s, uint32_t *r)
{
  for (int i = 0; i < W * H; i++)
    s->luma[i] = 1;
  for (int i = 0; i < 3; i++)
    draw_frame (s->luma, random_box (r, 12, 30), (int) pick (r, 5));
}

static inline void
new_scribbles (State *s, uint32_t *r)
{
  memset (s->scribbles, 0, sizeof s->scribbles);
  for (uint32_t i = 0, n = 1 + pick (r, 4); i < n; i++)
    paint_box (s->scribbles, random_box (r, 3, 9), colours[pick (r, 4)]);
}

static inline void
change_stroke (State *s, uint32_t *r)
{
  uint32_t i = pick (r, STROKES);

  if (i < s->n_strokes && pick (r, 3) == 0)
    {
      memmove (&s->stroke[i], &s->stroke[i + 1], (s->n_strokes - i - 1) * sizeof s->stroke[0]);
      s->n_strokes--;
      return;
    }
  if (i >= s->n_strokes)
    {
      uint32_t id = 1;

      for (uint32_t k = 0; k < s->n_strokes; k++)
        id = s->stroke[k].id >= id ? s->stroke[k].id + 1 : id;
      s->stroke[i = s->n_strokes++].id = id;
    }
  s->stroke[i].box    = random_box (r, 2, 10);
  s->stroke[i].colour = (uint8_t) pick (r, 6);
}

static inline void
change_settings (CeldSettings *s, uint32_t *r)
{
  switch (pick (r, 9))
    {
    case 0: s->hardness = pick (r, 2) ? 1 : 0.05f; break;
    case 1: s->close_gaps = !s->close_gaps; break;
    case 2: s->keep_necks = !s->keep_necks; break;
    case 3: s->background = pick (r, 2) ? CELD_BACKGROUND_AUTO : CELD_BACKGROUND_NONE; break;
    case 4: s->same_colour = pick (r, 2) ? CELD_SAME_COLOUR_ONE : CELD_SAME_COLOUR_SEPARATE; break;
    case 5: s->ink_threshold = pick (r, 2) ? 0.25f : 0.6f; break;
    case 6: s->method = pick (r, 4) ? CELD_METHOD_BASINS : CELD_METHOD_EXACT; break;
    case 7: s->flats = !pick (r, 4); break;
    case 8: s->seeds = pick (r, 2) ? CELD_SEEDS_AUTO : CELD_SEEDS_SCRIBBLES; break;
    }
}

static inline void
change_contours (State *s, uint32_t *r)
{
  static const uint8_t of_contours[3][3] = { { 255, 0, 0 }, { 0, 0, 255 }, { 0, 255, 0 } };
  CeldRect             line = random_box (r, 2, 20);

  s->has_contours = pick (r, 3) != 0;
  memset (s->contours, 0, sizeof s->contours);
  line.width = pick (r, 2) ? 2 : line.width;
  line.height = line.width == 2 ? line.height : 2;
  paint_box (s->contours, line, of_contours[pick (r, 3)]);
}

static inline void
edit (State *s, uint32_t *r)
{
  switch (pick (r, 12))
    {
    default: change_stroke (s, r); break;
    case 0: new_scribbles (s, r); break;
    case 1: s->has_scribbles = !s->has_scribbles; break;
    case 2: draw_frame (s->luma, random_box (r, 9, 14), (int) pick (r, 4)); break;
    case 3: change_contours (s, r); break;
    case 4: s->text = texts[pick (r, 4)]; break;
    case 5: s->relation = !s->relation; break;
    case 6: change_settings (&s->settings, r); break;
    case 7: pick (r, 4) ? change_settings (&s->settings, r) : new_drawing (s, r); break;
    }
}

/* Changes the session's strokes to those of the state. */
static inline void
apply_strokes (CeldSession *session, const State *s)
{
  for (size_t i = session->n_strokes; i-- > 0; )
    {
      uint32_t id = session->stroke[i].id, k = 0;

      while (k < s->n_strokes && s->stroke[k].id != id)
        k++;
      if (k == s->n_strokes)
        CHECK (celd_session_remove_stroke (session, id) == CELD_OK);
    }
  for (uint32_t i = 0; i < s->n_strokes; i++)
    {
      static uint8_t on[W * H];
      CeldRect       box = s->stroke[i].box;
      CeldMask       mask = { box.width, box.height, (size_t) box.width, on };

      memset (on, 1, sizeof on);
      CHECK (celd_session_put_stroke (session, s->stroke[i].id, box.x, box.y, &mask, colours[s->stroke[i].colour]) ==
             CELD_OK);
    }
}

static inline void
apply (CeldSession *session, const State *state)
{
  State      *s = (State *) state; /* views are not const */
  CeldDrawing drawing = { .luma = { W, H, W, s->luma } };
  CeldPaint   scribbles = { W, H, W, s->scribbles }, contours = { W, H, W, s->contours };

  CHECK (celd_session_set_settings (session, &s->settings) == CELD_OK);
  CHECK (celd_session_set_drawing (session, &drawing) == CELD_OK);
  CHECK (celd_session_set_scribbles (session, s->has_scribbles ? &scribbles : NULL) == CELD_OK);
  CHECK (celd_session_set_contours (session, s->has_contours ? &contours : NULL) == CELD_OK);
  CHECK (celd_session_set_relations (session, s->text, NULL) == CELD_OK);
  if (s->relation)
    CHECK (celd_session_put_relation (session, 5, "6,6 > 50,35", NULL) == CELD_OK);
  else
    celd_session_remove_relation (session, 5);
  apply_strokes (session, s);
}

static inline void
start (State *s, uint32_t *r)
{
  *s = (State) { .has_scribbles = true, .text = "", .settings = celd_settings () };
  new_drawing (s, r);
  new_scribbles (s, r);
}

#endif
