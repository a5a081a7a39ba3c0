// Shared by the formats of several pictures: the pixels of a frame.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_FRAMES_HPP
#define CELDEPTH_FRAMES_HPP

#include "layers.hpp"

// A frame, encoded as sRGB, on white paper: R, G, B.  Throws IoStopped.
std::vector<float> frame_on_paper (const CeldIoFrames &frames, size_t frame);

// Writes an animated GIF.
void write_gif (const std::string &path, const CeldIoFrames &frames);

#endif
