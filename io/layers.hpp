// Shared by the formats of layers: the pixels of a layer, and PNG in memory.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_LAYERS_HPP
#define CELDEPTH_LAYERS_HPP

#include "celdepth-io.hpp"

#include <vector>

using Bytes = std::vector<unsigned char>;

// Thrown when the host stops the writing, which is no error.
struct IoStopped
{
};

// Writes a file; false, with a sentence, if that throws, and with an empty one if the host stops it.
template <typename Work>
bool
guarded_write (const char *path, CeldIoError *error, Work work)
{
  bool stopped = false;
  bool good = guarded ("write", path, error, [&] {
    try
      {
        work ();
      }
    catch (const IoStopped &)
      {
        stopped = true;
      }
  });

  if (stopped)
    error->text[0] = 0;
  return good && !stopped;
}

// The box of a layer; one pixel if the layer is empty.
CeldRect layer_box (const CeldIoLayer &layer);

// R, G, B, A of the box of a layer, straight alpha.  Throws IoStopped.
std::vector<float> layer_pixels (const CeldIoStack &stack, size_t layer);

// R, G, B, A of sRGB, straight alpha, as a PNG of 8 bits.
Bytes encode_png (int width, int height, const float *rgba);
void write_png (const std::string &path, int width, int height, const float *rgba);

void write_bytes (const std::string &path, const void *bytes, size_t size);

void write_open_raster (const std::string &path, const CeldIoStack &stack);

// Only in builds with ImageMagick.
void write_psd (const std::string &path, const CeldIoStack &stack);

// The text of a folder's layers.json; `file` has the name of each layer's file.
std::string layers_json (const CeldIoStack &stack, const std::vector<std::string> &file);

#endif
