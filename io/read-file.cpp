// Decodes pictures by OpenImageIO, in the process that reads (read-server.cpp).
//
// Pixels are read in strips, so that a layer costs the memory of a strip and what OpenImageIO needs.  OpenImageIO is
// asked to leave straight alpha alone; files that hold premultiplied alpha (EXR, some TIFF) are divided here.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-file.hpp"

#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

using OIIO::ImageSpec;
using OIIO::Strutil::iequals;

// ------------------------------------------------------------------ channels

// The channel of that name, either bare or as the last word of a longer name ("N.X"); -1 if there is none.
static int
find_channel (const ImageSpec &spec, const std::string &name)
{
  const auto  &names = spec.channelnames;
  const size_t n = std::min (names.size (), size_t (std::max (spec.nchannels, 0)));

  for (size_t i = 0; i < n; i++)
    if (iequals (names[i], name))
      return int (i);
  for (size_t i = 0; i < n; i++)
    if (OIIO::Strutil::iends_with (names[i], "." + name))
      return int (i);
  return -1;
}

struct Channels
{
  int red, green, blue, alpha; // alpha -1: none
};

static Channels
colour_channels (const ImageSpec &spec)
{
  Channels c = { find_channel (spec, "R"), find_channel (spec, "G"), find_channel (spec, "B"),
                 find_channel (spec, "A") };

  if (c.red < 0 || c.green < 0 || c.blue < 0)
    c.red = find_channel (spec, "N.X"), c.green = find_channel (spec, "N.Y"), c.blue = find_channel (spec, "N.Z");
  if (c.red < 0 || c.green < 0 || c.blue < 0)
    c.red = c.green = c.blue = std::max (find_channel (spec, "Y"), 0);
  return c;
}

// ------------------------------------------------------------------ opening

static bool
is_linear (const ImageSpec &spec, const char *format)
{
  return iequals (format, "openexr") ||
         OIIO::Strutil::istarts_with (spec.get_string_attribute ("oiio:ColorSpace"), "lin");
}

// OpenImageIO tells where the layer of a PSD lies, but calls the layer's own size the full one, and says of the last
// layer only that alpha is straight, which it is in all.
static void
place_layer (ImageSpec &spec, const ImageSpec &merged)
{
  spec.full_x = spec.full_y = 0;
  spec.full_width = merged.full_width;
  spec.full_height = merged.full_height;
  spec.attribute ("oiio:UnassociatedAlpha", 1);
}

static void
describe (Part &part, int width, int height, const char *format)
{
  const ImageSpec &spec = part.spec;
  Channels         c = colour_channels (spec);
  int64_t          left = int64_t (spec.x) - spec.full_x, top = int64_t (spec.y) - spec.full_y;

  part.covers = left <= 0 && top <= 0 && left + spec.width >= width && top + spec.height >= height;
  part.name = spec.get_string_attribute ("oiio:subimagename");
  if (part.name.empty ())
    part.name = spec.get_string_attribute ("tiff:PageName");
  part.face.alpha = c.alpha >= 0 || !part.covers;
  part.face.grey = c.red == c.green && c.red == c.blue;
  part.face.linear = is_linear (spec, format);
  part.face.bits = int (8 * spec.format.basesize ());
}

// The merged picture of a PSD is stored as it is or run-length coded, at most 128 bytes in 2.
static void
check_psd_size (const PictureFile &file)
{
  const ImageSpec &spec = file.parts[0].spec;
  const uint64_t   bytes = uint64_t (file.width) * uint64_t (file.height) * uint64_t (std::max (spec.nchannels, 1)) *
                         spec.format.basesize ();

  if (bytes / 64 > file.size)
    throw IoFailure ("it is cut short.");
}

void
open_picture (const std::string &path, PictureFile &file)
{
  std::filesystem::file_status status = std::filesystem::status (path);
  ImageSpec                    wishes;

  if (!std::filesystem::exists (status))
    throw IoFailure ("there is no such file.");
  if (std::filesystem::is_directory (status))
    throw IoFailure ("it is a folder.");
  if (!std::filesystem::is_regular_file (status))
    throw IoFailure ("it is not an ordinary file.");
  file.size = std::filesystem::file_size (path);
  wishes.attribute ("oiio:UnassociatedAlpha", 1);
  file.input = OIIO::ImageInput::open (path, &wishes);
  if (!file.input)
    throw IoFailure ("it is damaged, or of a kind that cannot be read (PNG, TIFF, EXR, PSD and JPEG can; "
                     "save XCF, ORA and KRA as PSD). " + OIIO::geterror ());
  for (int i = 0; file.input->seek_subimage (i, 0); i++)
    file.parts.push_back ({ file.input->spec (i, 0), "", {}, false });
  file.input->geterror (); // of the search beyond the last part
  if (file.parts.empty ())
    throw IoFailure ("it holds no picture.");
  file.width = file.parts[0].spec.full_width;
  file.height = file.parts[0].spec.full_height;
  if (file.width < 1 || file.height < 1 || file.width > CELD_MAX_SIDE || file.height > CELD_MAX_SIDE)
    throw IoFailure ("its size of " + std::to_string (file.width) + " x " + std::to_string (file.height) +
                     " pixels is outside 1 to " + std::to_string (CELD_MAX_SIDE) + ".");
  if (iequals (file.input->format_name (), "psd"))
    {
      check_psd_size (file);
      for (Part &part : file.parts)
        place_layer (part.spec, file.parts[0].spec);
    }
  for (Part &part : file.parts)
    describe (part, file.width, file.height, file.input->format_name ());
}

// Interlaced and moving pictures are decoded as a whole, some into a second copy.
uint64_t
decoding_memory (const PictureFile &file, size_t index)
{
  const ImageSpec &spec = file.parts.at (index).spec;
  const uint64_t   canvas = uint64_t (file.width) * uint64_t (file.height);
  const uint64_t   part = uint64_t (std::max (spec.width, 0)) * uint64_t (std::max (spec.height, 0));

  return 2 * std::max (canvas, part) * uint64_t (std::clamp (spec.nchannels, 4, 64)) * spec.format.basesize ();
}

std::string
profile_of (const PictureFile &file, size_t part)
{
  // The layers of a PSD share the profile of the file, which OpenImageIO hangs on some parts only.
  for (size_t i : { part, size_t (0) })
    if (const auto *profile = file.parts.at (i).spec.find_attribute ("ICCProfile"))
      return std::string (static_cast<const char *> (profile->data ()), size_t (profile->datasize ()));
  return "";
}

// ------------------------------------------------------------------ pixels

// Layers may stick out of the canvas, but not without end: sums of places stay within int.
constexpr int64_t farthest_place = 1 << 24;

static void
check_part (const PictureFile &file, size_t index)
{
  const ImageSpec &spec = file.parts.at (index).spec;

  if (spec.full_width != file.width || spec.full_height != file.height)
    throw IoFailure ("its part " + std::to_string (index) + " has another size than its first.");
  if (spec.deep || spec.depth > 1)
    throw IoFailure ("deep and volume pictures cannot be used.");
  if (spec.width > 2 * CELD_MAX_SIDE || spec.height > 2 * CELD_MAX_SIDE || spec.nchannels < 1 ||
      std::abs (int64_t (spec.x) - spec.full_x) > farthest_place ||
      std::abs (int64_t (spec.y) - spec.full_y) > farthest_place)
    throw IoFailure ("its part " + std::to_string (index) + " is too large or too far outside.");
}

CeldRect
part_on_canvas (const PictureFile &file, size_t index)
{
  const ImageSpec &spec = file.parts.at (index).spec;

  check_part (file, index);
  const int left = spec.x - spec.full_x, top = spec.y - spec.full_y;
  const int x = std::clamp (left, 0, file.width), right = std::clamp (left + spec.width, x, file.width);
  const int y = std::clamp (top, 0, file.height), bottom = std::clamp (top + spec.height, y, file.height);

  return { x, y, right - x, bottom - y };
}

// Rows of the part from y to end, all channels of all its columns.
static void
decode_rows (OIIO::ImageInput &input, const ImageSpec &spec, int part, int y, int end, float *pixels)
{
  const int n = spec.nchannels;
  bool      good = spec.tile_width
                     ? input.read_tiles (part, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end, spec.z,
                                         spec.z + 1, 0, n, OIIO::TypeFloat, pixels)
                     : input.read_scanlines (part, 0, spec.y + y, spec.y + end, spec.z, 0, n, OIIO::TypeFloat, pixels);

  // Of a TIFF that is cut short the error is kept, but reading counts as good.
  if (!good || input.has_error ())
    throw IoFailure ("it is damaged or cut short (" + input.geterror () + ").");
}

// Convert (from, to) makes `floats` numbers of each pixel that lies on the canvas.
template <typename Convert>
static void
read_rows (PictureFile &file, size_t index, int floats, const TakeRows &take, Convert convert)
{
  const CeldRect     seen = part_on_canvas (file, index);
  const ImageSpec   &spec = file.parts[index].spec;
  const int          left = spec.x - spec.full_x, top = spec.y - spec.full_y;
  const size_t       n = size_t (spec.nchannels), row = size_t (std::max (spec.width, 0)) * n;
  const size_t       seen_row = size_t (seen.width) * size_t (floats);
  const int          unit = std::max (spec.tile_height, 1);
  const int          rows = int (std::min<size_t> ((size_t (1) << 22) / std::max<size_t> (row, 1), 256));
  const int          strip = std::max (rows / unit, 1) * unit;
  std::vector<float> pixels (row * size_t (std::min (strip, std::max (spec.height, 0)))), seen_pixels;

  for (int y = 0; spec.width > 0 && y < spec.height; y += strip)
    {
      const int end = std::min (y + strip, spec.height);
      const int first = std::max (y, seen.y - top), last = std::min (end, seen.y + seen.height - top);

      decode_rows (*file.input, spec, int (index), y, end, pixels.data ());
      if (first >= last || !seen.width)
        continue;
      seen_pixels.resize (seen_row * size_t (last - first));
      for (int j = first; j < last; j++)
        for (int i = 0; i < seen.width; i++)
          convert (pixels.data () + size_t (j - y) * row + size_t (seen.x - left + i) * n,
                   seen_pixels.data () + size_t (j - first) * seen_row + size_t (i) * size_t (floats));
      take (seen_pixels.data (), last - first);
    }
}

void
read_colours (PictureFile &file, size_t index, const TakeRows &take)
{
  const ImageSpec &spec = file.parts.at (index).spec;
  const Channels   c = colour_channels (spec);
  const bool       premultiplied = c.alpha >= 0 && !spec.get_int_attribute ("oiio:UnassociatedAlpha");

  read_rows (file, index, 4, take, [=] (const float *pixel, float *rgba) {
    float alpha = c.alpha >= 0 ? pixel[c.alpha] : 1.f;
    float divisor = premultiplied && alpha > 0 ? alpha : 1.f;

    rgba[0] = pixel[c.red] / divisor;
    rgba[1] = pixel[c.green] / divisor;
    rgba[2] = pixel[c.blue] / divisor;
    rgba[3] = alpha;
  });
}

// value = offset + factor * stored.
struct Scale
{
  int   channel;
  float offset, factor;
};

static Scale
value_scale (const ImageSpec &spec)
{
  const float farthest = spec.get_float_attribute (note_farthest, 0.f);
  const float range    = spec.get_float_attribute (note_nearest, 1.f) - farthest;
  const float near     = spec.get_float_attribute ("near", 1.f);
  const float far      = spec.get_float_attribute ("far", 2.f);
  const int   v = find_channel (spec, "depth.V"), z = find_channel (spec, "Z");

  if (v < 0 && z >= 0 && find_channel (spec, "X") < 0 && far > near)
    return { z, farthest + range * far / (far - near), -range / (far - near) };
  return { v >= 0 ? v : colour_channels (spec).red, farthest, range };
}

void
read_values (PictureFile &file, size_t index, const TakeRows &take)
{
  const Scale scale = value_scale (file.parts.at (index).spec);

  read_rows (file, index, 1, take, [=] (const float *pixel, float *value) {
    *value = scale.offset + scale.factor * pixel[scale.channel];
  });
}
