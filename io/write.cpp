// Writes pictures in EXR, PNG and TIFF files.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "file-kinds.h"
#include "write-parts.hpp"

#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <cmath>
#include <cstring>

using OIIO::ImageSpec;

// Distances of the nearest and of the farthest point from the viewer in EXR files (chosen: depth has no unit).
constexpr float near_distance = 1, far_distance = 2;

constexpr const char *convention =
  "Z = far - d (far - near) is the distance to the viewer; depth.V = d is 1 at near, 0 at far";

static const char *
format_name (CeldIoFormat format)
{
  return format == CELD_IO_EXR ? "openexr" : format == CELD_IO_PNG ? "png" : "tiff";
}

// ------------------------------------------------------------------ one part

static ImageSpec
make_spec (const CeldIoPicture &picture, CeldIoFormat format, const CeldIoNote *notes, size_t n_notes)
{
  OIIO::TypeDesc sample = picture.sample == CELD_IO_8_BIT ? OIIO::TypeUInt8 :
                          picture.sample == CELD_IO_16_BIT ? OIIO::TypeUInt16 : OIIO::TypeFloat;
  ImageSpec      spec (picture.width, picture.height, picture.channels,
                       format == CELD_IO_EXR ? OIIO::TypeFloat : sample);

  spec.channelnames.clear ();
  for (int i = 0; i < picture.channels; i++)
    spec.channelnames.push_back (picture.channel[i].name);
  spec.alpha_channel = -1;
  for (int i = 0; i < picture.channels; i++)
    if (spec.channelnames[size_t (i)] == "A")
      spec.alpha_channel = i;
  if (format != CELD_IO_EXR)
    spec.attribute ("oiio:UnassociatedAlpha", 1);
  if (picture.srgb && format != CELD_IO_EXR)
    spec.attribute ("oiio:ColorSpace", "sRGB");
  if (picture.name)
    spec.attribute ("oiio:subimagename", picture.name);
  spec.attribute ("DateTime", ""); // else the present one, and the same picture would be another file each time
  // PNG has text attributes only.
  for (size_t i = 0; i < n_notes; i++)
    if (notes[i].text)
      spec.attribute (notes[i].name, notes[i].text);
    else if (format == CELD_IO_EXR)
      spec.attribute (notes[i].name, notes[i].number);
    else
      spec.attribute (notes[i].name, OIIO::Strutil::fmt::format ("{}", notes[i].number));
  return spec;
}

// Interleaves the channels of a row, with colours multiplied by channel `alpha` if that is not -1.
static void
gather_row (const CeldIoPicture &picture, int y, int alpha, float *row)
{
  for (int i = 0; i < picture.channels; i++)
    {
      const CeldIoChannel &channel = picture.channel[i];

      for (int x = 0; x < picture.width; x++)
        row[x * picture.channels + i] = channel.data[size_t (y) * channel.row + size_t (x) * channel.column];
    }
  for (int i = 0; alpha >= 0 && i < picture.channels; i++)
    if (std::strchr ("RGBY", picture.channel[i].name[0]) && !picture.channel[i].name[1])
      for (int x = 0; x < picture.width; x++)
        row[x * picture.channels + i] *= row[x * picture.channels + alpha];
}

static void
write_pixels (OIIO::ImageOutput &output, const CeldIoPicture &picture, int premultiply)
{
  constexpr int      strip = 64;
  const size_t       row = size_t (picture.width) * size_t (picture.channels);
  std::vector<float> rows (row * size_t (std::min (strip, picture.height)));

  for (int y = 0; y < picture.height; y += strip)
    {
      int end = std::min (y + strip, picture.height);

      for (int j = y; j < end; j++)
        gather_row (picture, j, premultiply, rows.data () + size_t (j - y) * row);
      if (!output.write_scanlines (y, end, 0, OIIO::TypeFloat, rows.data ()))
        throw IoFailure (output.geterror ());
    }
}

// ------------------------------------------------------------------ all parts

static void
write_file (const std::string &path, const CeldIoPicture *parts, size_t n, const CeldIoNote *notes, size_t n_notes)
{
  const CeldIoFormat     format = celd_io_format (path.c_str ());
  std::vector<ImageSpec> specs;

  if (format == CELD_IO_NO_FORMAT)
    throw IoFailure ("its name must end in .exr, .png or .tif.");
  if (n < 1 || (n > 1 && format != CELD_IO_EXR))
    throw IoFailure ("only EXR files can have several parts.");
  for (size_t i = 0; i < n; i++)
    specs.push_back (make_spec (parts[i], format, notes, n_notes));
  write_parts (path, format_name (format), specs, [&] (OIIO::ImageOutput &output, size_t i) {
    write_pixels (output, parts[i], format == CELD_IO_EXR ? specs[i].alpha_channel : -1);
  });
}

// ------------------------------------------------------------------ depth, normals, colours, light

static void
write_depth (const std::string &path, const CeldPlane &depth, float farthest, float nearest)
{
  const CeldIoFormat format = celd_io_format (path.c_str ());
  const size_t       width = size_t (depth.width), n = width * size_t (depth.height);
  std::vector<float> shown (format == CELD_IO_TIFF ? 0 : n), distance (format == CELD_IO_EXR ? n : 0);

  for (size_t i = 0; i < shown.size (); i++)
    {
      float value = depth.data[i / width * depth.stride + i % width];

      shown[i] = (value - farthest) / (nearest > farthest ? nearest - farthest : 1);
      if (format == CELD_IO_EXR)
        distance[i] = far_distance - shown[i] * (far_distance - near_distance);
    }

  const CeldIoChannel exr[] = { { "Z", distance.data (), 1, width }, { "depth.V", shown.data (), 1, width } };
  const CeldIoChannel grey = { "Y", format == CELD_IO_TIFF ? depth.data : shown.data (), 1,
                               format == CELD_IO_TIFF ? depth.stride : width };
  const CeldIoNote    notes[] = { { note_farthest, nullptr, farthest }, { note_nearest, nullptr, nearest },
                                  { "near", nullptr, near_distance }, { "far", nullptr, far_distance },
                                  { "celdepth:convention", convention, 0 } };
  CeldIoPicture       picture = { nullptr, depth.width, depth.height, CELD_IO_FLOAT, false, &grey, 1 };

  if (format == CELD_IO_EXR)
    picture.channel = exr, picture.channels = 2;
  else if (format == CELD_IO_PNG)
    picture.sample = CELD_IO_16_BIT;
  write_file (path, &picture, 1, notes, format == CELD_IO_EXR ? 5 : format == CELD_IO_PNG ? 2 : 0);
}

static void
write_normals (const std::string &path, const CeldVectors &normals)
{
  const bool         exr = celd_io_format (path.c_str ()) == CELD_IO_EXR;
  const size_t       row = 3 * size_t (normals.width);
  std::vector<float> packed (exr ? 0 : row * size_t (normals.height));
  const float       *data = exr ? normals.data : packed.data ();
  const size_t       stride = exr ? 3 * normals.stride : row;

  for (size_t i = 0; i < packed.size (); i++)
    packed[i] = 0.5f + 0.5f * normals.data[i / row * 3 * normals.stride + i % row];

  const CeldIoChannel channels[] = { { exr ? "N.X" : "R", data, 3, stride }, { exr ? "N.Y" : "G", data + 1, 3, stride },
                                     { exr ? "N.Z" : "B", data + 2, 3, stride } };
  const CeldIoPicture picture = { nullptr, normals.width, normals.height, CELD_IO_16_BIT, false, channels, 3 };

  write_file (path, &picture, 1, nullptr, 0);
}

// The inverse of encode_srgb.
static float
decode_srgb (float v)
{
  return v <= 0.04045f ? v / 12.92f : std::pow ((v + 0.055f) / 1.055f, 2.4f);
}

float
encode_srgb (float v)
{
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow (v, 1 / 2.4f) - 0.055f;
}

static void
write_paint (const std::string &path, const CeldPaint &paint)
{
  const bool         exr = celd_io_format (path.c_str ()) == CELD_IO_EXR;
  const size_t       row = 4 * size_t (paint.width);
  std::vector<float> colours (row * size_t (paint.height));
  float              table[2][256];

  for (int i = 0; i < 256; i++)
    {
      table[1][i] = float (i) / 255;
      table[0][i] = exr ? decode_srgb (table[1][i]) : table[1][i];
    }
  for (size_t i = 0; i < colours.size (); i++)
    colours[i] = table[i % 4 == 3][paint.data[i / row * 4 * paint.stride + i % row]];

  const CeldIoChannel channels[] = { { "R", colours.data (), 4, row }, { "G", colours.data () + 1, 4, row },
                                     { "B", colours.data () + 2, 4, row }, { "A", colours.data () + 3, 4, row } };
  const CeldIoPicture picture = { nullptr, paint.width, paint.height, CELD_IO_8_BIT, true, channels, 4 };

  write_file (path, &picture, 1, nullptr, 0);
}

static void
write_colours (const std::string &path, const CeldColours &colours)
{
  const bool         png = celd_io_format (path.c_str ()) == CELD_IO_PNG;
  const size_t       row = 4 * size_t (colours.width);
  std::vector<float> encoded (png ? row * size_t (colours.height) : 0);
  const float       *data = png ? encoded.data () : colours.data;
  const size_t       stride = png ? row : 4 * colours.stride;

  for (size_t i = 0; i < encoded.size (); i++)
    {
      float value = colours.data[i / row * 4 * colours.stride + i % row];

      encoded[i] = i % 4 == 3 ? value : encode_srgb (value);
    }

  const CeldIoChannel channels[] = { { "R", data, 4, stride }, { "G", data + 1, 4, stride },
                                     { "B", data + 2, 4, stride }, { "A", data + 3, 4, stride } };
  const CeldIoPicture picture = { nullptr, colours.width, colours.height, png ? CELD_IO_16_BIT : CELD_IO_FLOAT, png,
                                  channels, 4 };

  write_file (path, &picture, 1, nullptr, 0);
}

static void
write_light (const std::string &path, const CeldPlane &light)
{
  const bool         png = celd_io_format (path.c_str ()) == CELD_IO_PNG;
  const size_t       width = size_t (light.width);
  std::vector<float> encoded (png ? width * size_t (light.height) : 0);

  for (size_t i = 0; i < encoded.size (); i++)
    encoded[i] = encode_srgb (light.data[i / width * light.stride + i % width]);

  const CeldIoChannel grey = { "Y", png ? encoded.data () : light.data, 1, png ? width : light.stride };
  const CeldIoPicture picture = { nullptr, light.width, light.height, png ? CELD_IO_16_BIT : CELD_IO_FLOAT, png,
                                  &grey, 1 };

  write_file (path, &picture, 1, nullptr, 0);
}

static void
write_heights (const std::string &path, const CeldPlane &heights)
{
  const bool         png = celd_io_format (path.c_str ()) == CELD_IO_PNG;
  const size_t       width = size_t (heights.width), n = width * size_t (heights.height);
  std::vector<float> shown (png ? n : 0);
  float              low = heights.data[0], high = low;

  for (size_t i = 0; i < n; i++)
    {
      float value = heights.data[i / width * heights.stride + i % width];

      low  = std::min (low, value);
      high = std::max (high, value);
    }
  for (size_t i = 0; i < shown.size (); i++)
    shown[i] = (heights.data[i / width * heights.stride + i % width] - low) / (high > low ? high - low : 1);

  const CeldIoChannel channel = { "Y", png ? shown.data () : heights.data, 1,
                                  png ? width : heights.stride };
  const CeldIoNote    notes[] = { { note_farthest, nullptr, low }, { note_nearest, nullptr, high } };
  const CeldIoPicture picture = { nullptr, heights.width, heights.height, png ? CELD_IO_16_BIT : CELD_IO_FLOAT, false,
                                  &channel, 1 };

  write_file (path, &picture, 1, notes, png ? 2 : 0);
}

// ------------------------------------------------------------------ the C functions

const CeldIoKeeper *celd_io_keeper;

void
celd_io_set_keeper (const CeldIoKeeper *keeper)
{
  celd_io_keeper = keeper;
}

bool
celd_io_write (const char *path, const CeldIoPicture *parts, size_t n_parts, const CeldIoNote *notes, size_t n_notes,
               CeldIoError *error)
{
  return guarded ("write", path, error, [&] { write_file (path, parts, n_parts, notes, n_notes); });
}

bool
celd_io_write_depth (const char *path, const CeldPlane *depth, float farthest, float nearest, CeldIoError *error)
{
  return guarded ("write", path, error, [&] { write_depth (path, *depth, farthest, nearest); });
}

bool
celd_io_write_heights (const char *path, const CeldPlane *heights, CeldIoError *error)
{
  return guarded ("write", path, error, [&] { write_heights (path, *heights); });
}

bool
celd_io_write_normals (const char *path, const CeldVectors *normals, CeldIoError *error)
{
  return guarded ("write", path, error, [&] { write_normals (path, *normals); });
}

bool
celd_io_write_paint (const char *path, const CeldPaint *paint, CeldIoError *error)
{
  return guarded ("write", path, error, [&] { write_paint (path, *paint); });
}

bool
celd_io_write_colours (const char *path, const CeldColours *colours, CeldIoError *error)
{
  return guarded ("write", path, error, [&] { write_colours (path, *colours); });
}

bool
celd_io_write_light (const char *path, const CeldPlane *light, CeldIoError *error)
{
  return guarded ("write", path, error, [&] { write_light (path, *light); });
}
