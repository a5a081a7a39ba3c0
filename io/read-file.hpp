// Pictures in files, decoded in the reading process.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_READ_FILE_HPP
#define CELDEPTH_READ_FILE_HPP

#include "celdepth-io.hpp"

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

struct Part
{
  OIIO::ImageSpec spec;
  std::string     name;
  CeldIoPart      info;   // without the name
  bool            covers; // whether it covers the canvas
};

struct PictureFile
{
  std::unique_ptr<OIIO::ImageInput> input;
  std::vector<Part>                 parts;
  int                               width, height; // of the canvas
  uint64_t                          size;          // of the file, in bytes
};

// Opens a file.  Throws an IoFailure if it cannot be read.
void open_picture (const std::string &path, PictureFile &file);

// The most bytes that OpenImageIO should need to decode the part; with a damaged file it may ask for more.
uint64_t decoding_memory (const PictureFile &file, size_t part);

// The ICC profile of a part; empty if there is none.
std::string profile_of (const PictureFile &file, size_t part);

// The rectangle of the canvas that the part covers; width and height are 0 if it lies outside.  Throws an IoFailure if
// the part cannot be used.
CeldRect part_on_canvas (const PictureFile &file, size_t part);

// Receives rows of that rectangle, from top to bottom.
using TakeRows = std::function<void (const float *rows, int count)>;

// Read each pixel of part_on_canvas: R, G, B, A, straight alpha; or values, as celd_io_read_values.
void read_colours (PictureFile &file, size_t part, const TakeRows &take);
void read_values (PictureFile &file, size_t part, const TakeRows &take);

#endif
