// Layered documents that are a zip: OpenRaster and Krita's.
//
//   read-layered.cpp      their layers as parts of a PictureFile
//   read-open-raster.cpp  the stack of an OpenRaster file
//   read-krita.cpp        the layers of a Krita document
//   krita-tiles.cpp       the pixels of one of Krita's paint layers
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_READ_LAYERED_HPP
#define CELDEPTH_READ_LAYERED_HPP

#include "read-file.hpp"
#include "read-zip.hpp"

// Most bytes of a description: a layer takes some hundred (chosen).
constexpr size_t longest_xml = size_t (1) << 22;

// Text of a small entry of a zip, such as mimetype.
constexpr size_t longest_word = 256;

// How the pixels of a layer are stored.
enum class Store { none, group, png, krita_tiles };

struct Layer
{
  std::string        name;
  Store              store = Store::none;
  std::string        entry;              // of the zip
  std::string        problem;            // why its pixels cannot be read, a sentence; "": they can
  int                x = 0, y = 0;       // of its pixels on the canvas
  float              opacity = 1;
  bool               visible = true, multiplies = false;
  std::vector<Layer> children;           // of a group, from back to front
};

struct LayeredPage
{
  int         width = 0, height = 0;
  Layer       root;                      // a group
  std::string merged;                    // the entry of the composite, a PNG
};

// Read the description.  Throw an IoFailure.
LayeredPage read_open_raster (const ZipFile &zip);
LayeredPage read_krita (const ZipFile &zip);

// A place as a whole number; far outside if it is absurd.
int place_number (double number);

// A paint layer of Krita, of 8 bits RGBA, on a canvas.
std::unique_ptr<PictureFile> open_krita_tiles (const ZipFile &zip, const Layer &layer, int width, int height);

std::unique_ptr<PictureFile> open_layered (const std::string &path);

#endif
