// Pictures in files, decoded in the reading process.
//
//   read-file.cpp     what OpenImageIO decodes
//   other-kinds.cpp   what is said of files that cannot be read
//   chunks.cpp        what OpenImageIO passes over in a WebP and a PNG
//   psd-names.cpp     what OpenImageIO does not read of a PSD
//   read-turned.cpp   pictures of a camera that was turned
//   read-layered.cpp  OpenRaster and Krita documents: a zip of layers
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_READ_FILE_HPP
#define CELDEPTH_READ_FILE_HPP

#include "celdepth-io.hpp"

#include <OpenImageIO/filesystem.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

struct Part
{
  std::string name;
  CeldIoPart  info; // without the name
};

// Receives rows of a part's place on the canvas, from top to bottom.
using TakeRows = std::function<void (const float *rows, int count)>;

// An open file.  Functions throw an IoFailure if the part cannot be used.
class PictureFile
{
public:
  std::vector<Part> parts;
  int               width = 0, height = 0; // of the canvas
  uint64_t          size = 0;              // of the file, in bytes

  PictureFile () = default;
  virtual ~PictureFile () = default;
  PictureFile (const PictureFile &) = delete;
  PictureFile &operator= (const PictureFile &) = delete;

  // The most bytes that decoding the part should need; with a damaged file a decoder may ask for more.
  virtual uint64_t decoding_memory (size_t part) const = 0;

  // The ICC profile of a part; empty if there is none.
  virtual std::string profile (size_t part) const = 0;

  // The rectangle of the canvas that the part covers; width and height are 0 if it lies outside.
  virtual CeldRect place (size_t part) const = 0;

  // Read each pixel of that rectangle: R, G, B, A, straight alpha; or values, as celd_io_read_values.
  virtual void read_colours (size_t part, const TakeRows &take) = 0;
  virtual void read_values (size_t part, const TakeRows &take) = 0;
};

// Opens a file.  Throws an IoFailure if it cannot be read.
std::unique_ptr<PictureFile> open_picture (const std::string &path);

// Opens a PNG whose bytes the stream has, which must outlive the file.  The canvas is a rectangle in its coordinates.
// Throws an IoFailure if the bytes are no PNG.
std::unique_ptr<PictureFile> open_png (OIIO::Filesystem::IOProxy &stream, const CeldRect &canvas);

// The file as it is to be shown, by the tag Orientation of Exif (1 = as it is stored; so are values that it cannot have).
std::unique_ptr<PictureFile> turned (std::unique_ptr<PictureFile> file, int orientation);

// The orientation that the Exif chunk of a WebP notes; 1 if there is none.
int webp_orientation (const std::string &path);

// Whether a PNG is animated (APNG).
bool png_is_animated (const std::string &path);

// The names of a PSD's layers in Unicode, from the lowest layer to the highest, "" where one has none; empty if the file
// is damaged.
std::vector<std::string> psd_layer_names (const std::string &path);

// Whether a channel of a layer in a PSD is compressed by ZIP, which OpenImageIO does not know; false if the file is damaged.
bool psd_has_zip (const std::string &path);

// Why OpenImageIO cannot open a file, and what to do, by the kind of the file.
std::string unreadable_reason (const std::string &path);

// Throws if a canvas cannot have that size.
void check_canvas (int64_t width, int64_t height);

#endif
