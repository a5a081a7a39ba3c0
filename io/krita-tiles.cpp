// The pixels of a paint layer of Krita, as its files have them: a header of text, then tiles of 64 x 64 pixels, each
// after a line "x,y,LZF,bytes".  The first byte of a tile is 0 if its pixels follow as they are, B,G,R,A, or 1 if they
// are compressed by LZF, first all B, then all G, R, and A.  Elsewhere the layer has the colour of FILE.defaultpixel.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-layered.hpp"
#include "read-wire.hpp"

#include <algorithm>
#include <cstdio>

constexpr int    side = 64; // of a tile, in pixels
constexpr size_t area = size_t (side) * side, tile_bytes = 4 * area;
constexpr size_t longest_line = 64;      // of the header (chosen)
constexpr int    most_tiles   = 1 << 20; // chosen: more than the largest canvas has
constexpr int    strip        = 64;      // rows that are handed on together (chosen)

using Pixels = std::vector<unsigned char>;

[[noreturn]] static void
fail ()
{
  throw IoFailure ("it is damaged or truncated.");
}

// ------------------------------------------------------------------ one tile

// Decompresses LZF: a byte below 32 is followed by one more literal byte than it says; others begin a copy of 3 or more
// bytes from up to 8192 bytes back.
static void
decompress (const Pixels &from, size_t size, Pixels &to)
{
  size_t in = 1, out = 0;

  while (in < size)
    {
      const size_t control = from[in++];

      if (control < 32)
        {
          if (in + control + 1 > size || out + control + 1 > to.size ())
            fail ();
          std::copy_n (from.begin () + std::ptrdiff_t (in), control + 1, to.begin () + std::ptrdiff_t (out));
          in += control + 1, out += control + 1;
          continue;
        }

      size_t length = control >> 5, back = (control & 31) << 8;

      if (length == 7 && in < size)
        length += from[in++];
      if (in >= size)
        fail ();
      back += size_t (from[in++]) + 1;
      if (back > out || out + length + 2 > to.size ())
        fail ();
      for (size_t end = out + length + 2; out < end; out++)
        to[out] = to[out - back];
    }
  if (out != to.size ())
    fail ();
}

// Reads a line of text without its end.
static std::string
read_line (ZipStream &stream)
{
  std::string line;
  char        c;

  while (line.size () < longest_line && stream.read (&c, 1) == 1)
    {
      if (c == '\n')
        return line;
      line += c;
    }
  fail ();
}

// Reads the bytes of a tile as R,G,B,A.
static void
read_tile (ZipStream &stream, size_t size, Pixels &packed, Pixels &planes, Pixels &rgba)
{
  if (size < 2 || size > tile_bytes + 1 || stream.read (packed.data (), size) != size)
    fail ();

  const bool compressed = packed[0] != 0;

  if (compressed)
    decompress (packed, size, planes);
  else if (size != tile_bytes + 1)
    fail ();
  for (size_t i = 0; i < area; i++)
    for (size_t c = 0; c < 4; c++)
      {
        const size_t stored = c < 3 ? 2 - c : 3;

        rgba[4 * i + c] = compressed ? planes[stored * area + i] : packed[1 + 4 * i + stored];
      }
}

// ------------------------------------------------------------------ the layer

class KritaLayer : public PictureFile
{
public:
  KritaLayer (const ZipFile &from, const Layer &of, int canvas_width, int canvas_height)
      : zip (from), layer (of)
  {
    width  = canvas_width;
    height = canvas_height;
    parts.push_back ({ layer.name, { nullptr, true, false, false, 8, false } });
  }

  uint64_t
  decoding_memory (size_t) const override
  {
    return 4 * uint64_t (width) * uint64_t (height);
  }
  CeldRect
  place (size_t) const override
  {
    return { 0, 0, width, height };
  }

  std::string
  profile (size_t) const override
  {
    const std::string entry = layer.entry + ".icc";

    return zip.has (entry) ? zip.bytes (entry, longest_profile) : "";
  }

  void
  read_colours (size_t, const TakeRows &take) override
  {
    read (4, take);
  }
  void
  read_values (size_t, const TakeRows &take) override
  {
    read (1, take);
  }

private:
  Pixels
  default_pixel () const
  {
    const std::string entry = layer.entry + ".defaultpixel";
    const std::string bgra  = zip.has (entry) ? zip.bytes (entry, longest_word) : "";
    Pixels            rgba (4);

    for (size_t c = 0; c < 4 && bgra.size () == 4; c++)
      rgba[c] = static_cast<unsigned char> (bgra[c < 3 ? 2 - c : 3]);
    return rgba;
  }

  // Copies what of a tile lies on the canvas; a tile beside it has no pixel that could be pointed to.
  void
  put_tile (const Pixels &tile, int64_t left, int64_t top, Pixels &canvas) const
  {
    const int64_t x = std::clamp<int64_t> (left, 0, width), right = std::clamp<int64_t> (left + side, x, width);

    for (int64_t y = std::max<int64_t> (top, 0); x < right && y < std::min<int64_t> (top + side, height); y++)
      std::copy_n (tile.begin () + 4 * ((y - top) * side + x - left), 4 * (right - x),
                   canvas.begin () + 4 * (y * width + x));
  }

  Pixels
  decode () const
  {
    ZipStream    stream (zip, layer.entry);
    const Pixels usual = default_pixel ();
    Pixels       canvas (4 * size_t (width) * size_t (height)), packed (tile_bytes + 1), planes (tile_bytes),
        tile (tile_bytes);
    int tiles = 0;

    for (size_t i = 0; usual != Pixels (4) && i < canvas.size (); i++)
      canvas[i] = usual[i % 4];
    for (const char *wanted : { "VERSION 2", "TILEWIDTH 64", "TILEHEIGHT 64", "PIXELSIZE 4" })
      if (read_line (stream) != wanted)
        throw IoFailure ("it is stored in an unknown way; save the page as ORA or PSD.");
    if (std::sscanf (read_line (stream).c_str (), "DATA %d", &tiles) != 1 || tiles < 0 || tiles > most_tiles)
      fail ();
    for (int i = 0; i < tiles; i++)
      {
        int    x, y;
        size_t bytes;

        if (std::sscanf (read_line (stream).c_str (), "%d,%d,LZF,%zu", &x, &y, &bytes) != 3)
          fail ();
        read_tile (stream, bytes, packed, planes, tile);
        put_tile (tile, int64_t (x) + layer.x, int64_t (y) + layer.y, canvas);
      }
    return canvas;
  }

  // Hands on the first `floats` channels.
  void
  read (size_t floats, const TakeRows &take) const
  {
    const Pixels       canvas = decode ();
    std::vector<float> rows;

    for (int y = 0; y < height; y += strip)
      {
        const size_t first = size_t (y) * size_t (width), n = size_t (std::min (strip, height - y)) * size_t (width);

        rows.resize (floats * n);
        for (size_t i = 0; i < n; i++)
          for (size_t c = 0; c < floats; c++)
            rows[floats * i + c] = float (canvas[4 * (first + i) + c]) / 255.f;
        take (rows.data (), int (n / size_t (width)));
      }
  }

  const ZipFile &zip;
  const Layer   &layer;
};

std::unique_ptr<PictureFile>
open_krita_tiles (const ZipFile &zip, const Layer &layer, int width, int height)
{
  return std::make_unique<KritaLayer> (zip, layer, width, height);
}
