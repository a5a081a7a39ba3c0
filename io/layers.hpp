// What the formats of layers share: a layer's pixels, and PNG in memory.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_LAYERS_HPP
#define CELDEPTH_LAYERS_HPP

#include "celdepth-io.hpp"

#include <vector>

using Bytes = std::vector<unsigned char>;

// Thrown when the host gives up: there is nothing to say.
struct IoGivenUp
{
};

// The box of a layer; of an empty one a pixel.
CeldRect layer_box (const CeldIoLayer &layer);

// R, G, B, A of that box, straight alpha.
std::vector<float> layer_pixels (const CeldIoStack &stack, size_t layer);

// 8 bits, sRGB.
Bytes encode_png (int width, int height, const float *rgba);
void write_png (const std::string &path, int width, int height, const float *rgba);

// layers from back to front
void write_open_raster (const std::string &path, const CeldIoStack &stack);

#endif
