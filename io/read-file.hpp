// A picture in a file, as the reading process sees it.
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
  CeldIoPart      face;   // its name is not set
  bool            covers; // the whole canvas
};

struct PictureFile
{
  std::unique_ptr<OIIO::ImageInput> input;
  std::vector<Part>                 parts;
  int                               width, height; // of the canvas
  uint64_t                          size;          // of the file, in bytes
};

// Throws an IoFailure if the file cannot be read.
void open_picture (const std::string &path, PictureFile &file);

// Bytes that OpenImageIO may need to decode the part; a damaged file may ask for any amount.
uint64_t decoding_memory (const PictureFile &file, size_t part);

// The ICC profile of a part; empty if there is none.
std::string profile_of (const PictureFile &file, size_t part);

// Where the part lies on the canvas; width and height are 0 if it lies outside.  Throws an IoFailure if the part cannot
// be used.
CeldRect part_on_canvas (const PictureFile &file, size_t part);

// Takes some rows of that rectangle, from top to bottom.
using TakeRows = std::function<void (const float *rows, int count)>;

// R, G, B, A of each pixel of part_on_canvas, straight alpha; or its values, as celd_io_read_values has them.
void read_colours (PictureFile &file, size_t part, const TakeRows &take);
void read_values (PictureFile &file, size_t part, const TakeRows &take);

#endif
