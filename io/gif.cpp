// Writes an animated GIF that repeats, with one palette for all frames, by giflib.
//
// Flat colours are drawn as they are.  Where colours change smoothly, errors of the palette are diffused [FS76], but only
// among such pixels: dots on flat art or along antialiased lines would be seen, and flicker.
//
//   [FS76]  R. Floyd, L. Steinberg: An Adaptive Algorithm for Spatial Grey Scale.  Proceedings of the SID 17(2), 1976.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "frames.hpp"
#include "gif-palette.hpp"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gif_lib.h>

#include <cmath>
#include <cstdlib>
#include <fcntl.h>
#include <unistd.h>

constexpr int most_smooth = 8; // steps of 1/255 between neighbours where colours change smoothly; chosen

namespace {

// ------------------------------------------------------------------ frames

// Frames in 8 bits.  They wait in a temporary file for the palette, which needs all of them: in memory two dozen would
// take 70 bytes a pixel.
class StoredFrames
{
public:
  StoredFrames (int wide, int high) : width (wide), height (high), file (std::tmpfile ())
  {
    if (!file)
      throw IoFailure ("there is no place for temporary files.");
  }
  ~StoredFrames () { std::fclose (file); }
  StoredFrames (const StoredFrames &) = delete;
  StoredFrames &operator= (const StoredFrames &) = delete;

  void add (const std::vector<Colour> &frame)
  {
    if (std::fwrite (frame.data (), sizeof (Colour), frame.size (), file) != frame.size ())
      throw IoFailure ("there is not enough space for temporary files.");
  }
  void rewind () { std::rewind (file); }
  std::vector<Colour> next ()
  {
    std::vector<Colour> frame (size_t (width) * size_t (height));

    if (std::fread (frame.data (), sizeof (Colour), frame.size (), file) != frame.size ())
      throw IoFailure ("a temporary file cannot be read.");
    return frame;
  }

  const int width, height;

private:
  std::FILE *file;
};

// A frame on paper, scaled down to the size of the file.
std::vector<float>
scaled_frame (const CeldIoFrames &frames, size_t frame, int width, int height)
{
  using OIIO::ImageSpec;

  std::vector<float> rgb = frame_on_paper (frames, frame), small;
  OIIO::ImageBuf     whole (ImageSpec (frames.width, frames.height, 3, OIIO::TypeFloat), rgb.data ()), part;

  if (width == frames.width && height == frames.height)
    return rgb;
  small.resize (3 * size_t (width) * size_t (height));
  if (!OIIO::ImageBufAlgo::resize (part, whole, "", 0, OIIO::ROI (0, width, 0, height, 0, 1, 0, 3), 1) ||
      !part.get_pixels (part.roi (), OIIO::TypeFloat, small.data ()))
    throw IoFailure ("its frames cannot be scaled down.");
  return small;
}

std::vector<Colour>
codes_of (const std::vector<float> &rgb)
{
  std::vector<Colour> codes (rgb.size () / 3);

  for (size_t i = 0; i < rgb.size (); i++)
    codes[i / 3] = codes[i / 3] << 8 | Colour (std::lround (255 * std::clamp (rgb[i], 0.f, 1.f)));
  return codes;
}

// ------------------------------------------------------------------ palette and dither

// The largest difference of a channel from the pixels above, below and beside.
int
largest_step (const std::vector<Colour> &frame, int width, int height, int x, int y)
{
  const int    step[4][2] = { { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } };
  const Colour here = frame[size_t (y) * size_t (width) + size_t (x)];
  int          largest = 0;

  for (const auto &to : step)
    {
      const int    at = std::clamp (x + to[0], 0, width - 1), row = std::clamp (y + to[1], 0, height - 1);
      const Colour there = frame[size_t (row) * size_t (width) + size_t (at)];

      for (int c = 0; c < 3; c++)
        largest = std::max (largest, std::abs (channel_of (here, c) - channel_of (there, c)));
    }
  return largest;
}

// Turns a frame into indices row by row, with the errors that are diffused to this row and the next one.
class Ditherer
{
public:
  Ditherer (GifPalette &chosen, const std::vector<Colour> &colours, int wide, int high)
    : palette (chosen), frame (colours), width (wide), height (high), error (3 * size_t (wide + 2)), below (error)
  {
  }

  void row (int y, GifPixelType *index)
  {
    error.swap (below);
    std::fill (below.begin (), below.end (), 0.f);
    for (int x = 0; x < width; x++)
      index[x] = pixel (x, y);
  }

private:
  // A colour that is an entry stays, and passes errors on.
  GifPixelType pixel (int x, int y)
  {
    const Colour colour = frame[size_t (y) * size_t (width) + size_t (x)];
    const int    step = largest_step (frame, width, height, x, y);
    int          index = palette.nearest (colour);
    const bool   exact = palette.entries ()[size_t (index)] == colour;

    if ((exact && step == 0) || step > most_smooth)
      return GifPixelType (index);

    float  wanted[3];
    Colour moved = 0;

    for (int c = 0; c < 3; c++)
      {
        wanted[c] = float (channel_of (colour, c)) + error[3 * size_t (x + 1) + size_t (c)];
        moved     = moved << 8 | Colour (std::lround (std::clamp (wanted[c], 0.f, 255.f)));
      }
    if (!exact)
      index = palette.nearest (moved);
    for (int c = 0; c < 3; c++)
      diffuse (x, c, (wanted[c] - float (channel_of (palette.entries ()[size_t (index)], c))) / 16);
    return GifPixelType (index);
  }

  void diffuse (int x, int c, float sixteenth)
  {
    const size_t at = 3 * size_t (x + 1) + size_t (c);

    error[at + 3] += 7 * sixteenth;
    below[at - 3] += 3 * sixteenth;
    below[at]     += 5 * sixteenth;
    below[at + 3] += sixteenth;
  }

  GifPalette                &palette;
  const std::vector<Colour> &frame;
  const int                  width, height;
  std::vector<float>         error, below; // R, G, B of a row, and of one pixel beyond either end
};

// ------------------------------------------------------------------ the file

constexpr const char *refused = "it cannot be written as a GIF.";

// giflib's file; its functions return GIF_OK or GIF_ERROR.
class GifFile
{
public:
  explicit GifFile (const std::string &path)
  {
    int error = 0;
    int descriptor = open (path.c_str (), O_WRONLY | O_CREAT | O_TRUNC, 0666); // giflib would let only the owner read it

    if (descriptor < 0)
      throw IoFailure (system_reason (errno));
    file = EGifOpenFileHandle (descriptor, &error);
    if (!file)
      {
        ::close (descriptor);
        throw IoFailure (refused);
      }
  }
  ~GifFile () { close (); }
  GifFile (const GifFile &) = delete;
  GifFile &operator= (const GifFile &) = delete;

  void try_to (int result)
  {
    if (result != GIF_OK)
      throw IoFailure (refused);
  }
  bool close ()
  {
    const bool good = !file || EGifCloseFile (file, nullptr) == GIF_OK;

    file = nullptr;
    return good;
  }

  GifFileType *file;
};

// The size of the file, its palette, and that it repeats for ever: Netscape's extension.
void
put_header (GifFile &gif, const StoredFrames &frames, const GifPalette &palette)
{
  const unsigned char repeat[3] = { 1, 0, 0 };
  const auto         &entry = palette.entries ();
  ColorMapObject     *map = GifMakeMapObject (1 << GifBitSize (int (std::max<size_t> (entry.size (), 2))), nullptr);

  if (!map)
    throw std::bad_alloc ();
  for (size_t i = 0; i < entry.size (); i++)
    map->Colors[i] = { GifByteType (channel_of (entry[i], 0)), GifByteType (channel_of (entry[i], 1)),
                       GifByteType (channel_of (entry[i], 2)) };
  EGifSetGifVersion (gif.file, true);

  const int result = EGifPutScreenDesc (gif.file, frames.width, frames.height, 8, 0, map);

  GifFreeMapObject (map);
  gif.try_to (result);
  gif.try_to (EGifPutExtensionLeader (gif.file, APPLICATION_EXT_FUNC_CODE));
  gif.try_to (EGifPutExtensionBlock (gif.file, 11, "NETSCAPE2.0"));
  gif.try_to (EGifPutExtensionBlock (gif.file, sizeof repeat, repeat));
  gif.try_to (EGifPutExtensionTrailer (gif.file));
}

void
put_frame (GifFile &gif, StoredFrames &frames, GifPalette &palette, int delay)
{
  const std::vector<Colour>  frame = frames.next ();
  std::vector<GifPixelType>  row (size_t (frames.width));
  Ditherer                   ditherer (palette, frame, frames.width, frames.height);
  const GraphicsControlBlock control = { DISPOSE_DO_NOT, false, delay, NO_TRANSPARENT_COLOR };
  GifByteType                extension[4];

  EGifGCBToExtension (&control, extension);
  gif.try_to (EGifPutExtension (gif.file, GRAPHICS_EXT_FUNC_CODE, sizeof extension, extension));
  gif.try_to (EGifPutImageDesc (gif.file, 0, 0, frames.width, frames.height, false, nullptr));
  for (int y = 0; y < frames.height; y++)
    {
      ditherer.row (y, row.data ());
      gif.try_to (EGifPutLine (gif.file, row.data (), frames.width));
    }
}

// A side of the file, scaled down.
int
scaled (int side, const CeldIoFrames &frames)
{
  const double scale = double (frames.most_side) / std::max (frames.width, frames.height);

  return frames.most_side > 0 && scale < 1 ? std::max (1, int (std::lround (side * scale))) : side;
}

}

void
write_gif (const std::string &path, const CeldIoFrames &frames)
{
  const int    delay = int (std::lround (100 / frames.per_second)); // hundredths of a second
  NewFile      file (path);
  StoredFrames stored (scaled (frames.width, frames), scaled (frames.height, frames));
  GifPalette   palette;

  if (stored.width > UINT16_MAX || stored.height > UINT16_MAX)
    throw IoFailure ("a GIF has 65535 pixels a side at most.");
  for (size_t i = 0; i < frames.frames; i++)
    {
      const std::vector<Colour> frame = codes_of (scaled_frame (frames, i, stored.width, stored.height));

      palette.count (frame);
      stored.add (frame);
    }
  palette.choose ();
  stored.rewind ();

  GifFile gif (file.name ());

  put_header (gif, stored, palette);
  for (size_t i = 0; i < frames.frames; i++)
    put_frame (gif, stored, palette, delay);
  if (!gif.close ())
    throw IoFailure ("there is not enough space for it.");
  file.commit ();
}
