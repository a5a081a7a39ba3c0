/* Pieces of paper and rooms of small drawings: which openings part rooms, and which do not.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "canvas.h"

/* Pieces and rooms of a drawing, from the ink alone. */
static void
find (Sketch *s, const char *const *drawing, int stroke)
{
  sketch_open (s, drawing, drawing, 9);
  memset (s->canvas.pieces.data, 0, s->canvas.n * sizeof (uint32_t));
  memset (s->canvas.rooms.data, 0, s->canvas.n * sizeof (uint32_t));
  s->canvas.n_pieces = s->canvas.n_rooms = 0;
  s->canvas.stroke = stroke;
  CHECK (celd_rooms (NULL, &s->canvas) == CELD_OK);
}

/* The numbers of pieces and rooms must be these. */
static void
count (const char *const *drawing, int stroke, size_t pieces, size_t rooms)
{
  Sketch s;

  find (&s, drawing, stroke);
  NEAR (s.canvas.n_pieces, pieces, 0);
  NEAR (s.canvas.n_rooms, rooms, 0);
  sketch_close (&s);
}

static void
a_wall_parts_pieces_and_a_gap_parts_rooms (void)
{
  static const char *const walled[] = {
    "1111111#2222222", "1111111#2222222", "1111111#2222222", "1111111#2222222", "1111111#2222222", NULL
  };
  static const char *const gap[] = {
    "1111111#1111111", "1111111#1111111", "111111111111111", "1111111#1111111", "1111111#1111111", NULL
  };
  static const char *const door[] = {
    "1111111#1111111", "111111111111111", "111111111111111", "111111111111111", "1111111#1111111", NULL
  };
  static const char *const gap_at_frame[] = {
    "111111111111111", "1111111#1111111", "1111111#1111111", "1111111#1111111", "1111111#1111111", NULL
  };
  Sketch s;

  find (&s, walled, 1);
  CHECK (differing (&s.canvas.pieces, walled) == 0 && differing (&s.canvas.rooms, walled) == 0);
  sketch_close (&s);
  count (gap, 1, 1, 2);
  count (gap_at_frame, 1, 1, 1);
  count (door, 1, 1, 1);
  count (door, 3, 1, 2);
}

/* Nothing is wider there than the passage that leads to it. */
static void
a_corridor_and_a_corner_stay_with_their_room (void)
{
  static const char *const corridor[] = {
    "##################", "#11111111##########", "#11111111##########", "#11111111##########", "#1111111111111111#",
    "#1111111111111111#", "#11111111##########", "#11111111##########", "##################", NULL
  };
  static const char *const corner[] = {
    "1111111111111111##", "11111111111111####", "111111111111######", "1111111111########", NULL
  };

  count (corridor, 1, 1, 1);
  count (corner, 1, 1, 1);
}

/* On random drawings: all paper is in a room, no room reaches through ink, numbers leave none out. */
static void
rooms_part_pieces (void)
{
  uint32_t state = 7;

  for (int round = 0; round < 300; round++)
    {
      char        row[24][25] = { { 0 } };
      const char *drawing[25] = { NULL };
      uint32_t    piece_of[24 * 24 + 1] = { 0 };
      size_t      wrong = 0, used = 0;
      Sketch      s;

      for (int y = 0; y < 24; y++)
        {
          memset (row[y], '1', 24);
          drawing[y] = row[y];
        }
      for (int line = 0; line < 6; line++)
        {
          int x = (int) check_random (&state, 24), y = (int) check_random (&state, 24);
          int dx = (int) check_random (&state, 3) - 1, dy = (int) check_random (&state, 3) - 1;

          for (; (dx || dy) && x >= 0 && y >= 0 && x < 24 && y < 24; x += dx, y += dy)
            row[y][x] = '#';
        }
      find (&s, drawing, 1 + round % 3);
      for (size_t p = 0; p < s.canvas.n; p++)
        {
          uint32_t piece = s.canvas.pieces.data[p], room = s.canvas.rooms.data[p];

          wrong += (piece != 0) != (row[p / 24][p % 24] == '1') || (room != 0) != (piece != 0);
          wrong += room > s.canvas.n_rooms || (piece_of[room] && piece_of[room] != piece);
          used += room && !piece_of[room];
          piece_of[room] = piece;
        }
      NEAR (wrong, 0, 0);
      NEAR (used, s.canvas.n_rooms, 0);
      sketch_close (&s);
    }
}

static void
pictures_without_paper_or_without_ink (void)
{
  static const char *const black[] = { "##", "##", NULL };
  static const char *const white[] = { "11", "11", NULL };
  static const char *const dot[] = { "1", NULL };

  count (black, 1, 0, 0);
  count (white, 0, 1, 1);
  count (dot, 1, 1, 1);
}

int
main (void)
{
  RUN (a_wall_parts_pieces_and_a_gap_parts_rooms);
  RUN (a_corridor_and_a_corner_stay_with_their_room);
  RUN (rooms_part_pieces);
  RUN (pictures_without_paper_or_without_ink);
  return DONE;
}
