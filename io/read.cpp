// Reading of pictures: every part comes as large as the canvas and with straight alpha.
//
// Pixels are read in strips, so that a layer costs its own floats and little more.  OpenImageIO is asked to leave
// straight alpha alone; files that hold premultiplied alpha (EXR, some TIFF) are divided here.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "celdepth-io.hpp"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <vector>

using OIIO::ImageSpec;
using OIIO::Strutil::iequals;

struct Part
{
  ImageSpec   spec;
  std::string name;
  CeldIoPart  face;
  bool        covers; // the whole canvas
};

struct CeldIoFile
{
  std::string                       path;
  std::unique_ptr<OIIO::ImageInput> input;
  std::vector<Part>                 parts;
  int                               width, height;
};

// ------------------------------------------------------------------ channels

// The channel of that name, either bare or as the last word of a longer name ("N.X"); -1 if there is none.
static int
find_channel (const ImageSpec &spec, const std::string &name)
{
  const auto &names = spec.channelnames;

  for (size_t i = 0; i < names.size (); i++)
    if (iequals (names[i], name))
      return int (i);
  for (size_t i = 0; i < names.size (); i++)
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

static void
open_file (CeldIoFile &file)
{
  std::filesystem::file_status status = std::filesystem::status (file.path);
  ImageSpec                    wishes;

  if (!std::filesystem::exists (status))
    throw IoFailure ("there is no such file.");
  if (std::filesystem::is_directory (status))
    throw IoFailure ("it is a folder.");
  wishes.attribute ("oiio:UnassociatedAlpha", 1);
  file.input = OIIO::ImageInput::open (file.path, &wishes);
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
    for (Part &part : file.parts)
      place_layer (part.spec, file.parts[0].spec);
  for (Part &part : file.parts)
    describe (part, file.width, file.height, file.input->format_name ());
  for (Part &part : file.parts)
    part.face.name = part.name.c_str ();
}

// ------------------------------------------------------------------ pixels

// Layers may stick out of the canvas, but not without end: sums of places stay within int.
constexpr int64_t farthest_place = 1 << 24;

static void
check_part (const CeldIoFile &file, size_t index)
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

// Calls take (pixel of the part, place on the canvas) for each pixel of the part that lies on the canvas.
template <typename Take>
static void
read_pixels (CeldIoFile &file, size_t index, Take take)
{
  const ImageSpec   &spec = file.parts[index].spec;
  const int          left = spec.x - spec.full_x, top = spec.y - spec.full_y, n = spec.nchannels, part = int (index);
  const size_t       row = size_t (spec.width) * size_t (n);
  const int          unit = std::max (spec.tile_height, 1);
  const int          rows = int (std::min<size_t> ((size_t (1) << 22) / std::max<size_t> (row, 1), 256));
  const int          strip = std::max (rows / unit, 1) * unit;
  std::vector<float> pixels (row * size_t (std::min (strip, std::max (spec.height, 0))));

  for (int y = 0; spec.width > 0 && y < spec.height; y += strip)
    {
      int  end = std::min (y + strip, spec.height);
      bool good = spec.tile_width
                    ? file.input->read_tiles (part, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end, spec.z,
                                              spec.z + 1, 0, n, OIIO::TypeFloat, pixels.data ())
                    : file.input->read_scanlines (part, 0, spec.y + y, spec.y + end, spec.z, 0, n, OIIO::TypeFloat,
                                                  pixels.data ());

      // Of a TIFF that is cut short the error is kept, but reading counts as good.
      if (!good || file.input->has_error ())
        throw IoFailure ("it is damaged or cut short (" + file.input->geterror () + ").");
      for (int j = std::max (y, -top); j < std::min (end, file.height - top); j++)
        for (int i = std::max (0, -left); i < std::min (spec.width, file.width - left); i++)
          take (pixels.data () + size_t (j - y) * row + size_t (i) * size_t (n),
                size_t (j + top) * size_t (file.width) + size_t (i + left));
    }
}

static void
read_colours (CeldIoFile &file, size_t index, float *rgba)
{
  const ImageSpec &spec = file.parts.at (index).spec;
  const Channels   c = colour_channels (spec);
  const bool       premultiplied = c.alpha >= 0 && !spec.get_int_attribute ("oiio:UnassociatedAlpha");

  check_part (file, index);
  // Not where it is overwritten: a damaged file of 20000 x 20000 pixels must not cost the memory that it asks for.
  if (!file.parts[index].covers)
    std::fill (rgba, rgba + 4 * size_t (file.width) * size_t (file.height), 0.f);
  read_pixels (file, index, [=] (const float *pixel, size_t place) {
    float *out = rgba + 4 * place;
    float  alpha = c.alpha >= 0 ? pixel[c.alpha] : 1.f;
    float  divisor = premultiplied && alpha > 0 ? alpha : 1.f;

    out[0] = pixel[c.red] / divisor;
    out[1] = pixel[c.green] / divisor;
    out[2] = pixel[c.blue] / divisor;
    out[3] = alpha;
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

static void
read_values (CeldIoFile &file, size_t index, float *values)
{
  const Scale scale = value_scale (file.parts.at (index).spec);

  check_part (file, index);
  if (!file.parts[index].covers)
    std::fill (values, values + size_t (file.width) * size_t (file.height), 0.f);
  read_pixels (file, index, [=] (const float *pixel, size_t place) {
    values[place] = scale.offset + scale.factor * pixel[scale.channel];
  });
}

// ------------------------------------------------------------------ the C face

CeldIoFile *
celd_io_open (const char *path, CeldIoError *error)
{
  CeldIoFile *file = nullptr;

  if (guarded ("read", path, error, [&] {
        file = new CeldIoFile ();
        file->path = path;
        open_file (*file);
      }))
    return file;
  delete file;
  return nullptr;
}

void
celd_io_close (CeldIoFile *file)
{
  delete file;
}

int
celd_io_width (const CeldIoFile *file)
{
  return file->width;
}

int
celd_io_height (const CeldIoFile *file)
{
  return file->height;
}

size_t
celd_io_parts (const CeldIoFile *file)
{
  return file->parts.size ();
}

const CeldIoPart *
celd_io_part (const CeldIoFile *file, size_t part)
{
  return &file->parts[part].face;
}

size_t
celd_io_find (const CeldIoFile *file, const char *name)
{
  for (size_t i = 0; i < file->parts.size (); i++)
    if (iequals (file->parts[i].name, name))
      return i;
  return CELD_NO_INDEX;
}

const char *
celd_io_profile (const CeldIoFile *file, size_t part, size_t *size)
{
  // The layers of a PSD share the profile of the file, which OpenImageIO hangs on some parts only.
  for (size_t i : { part, size_t (0) })
    if (const auto *profile = file->parts[i].spec.find_attribute ("ICCProfile"))
      {
        *size = size_t (profile->datasize ());
        return static_cast<const char *> (profile->data ());
      }
  *size = 0;
  return nullptr;
}

bool
celd_io_read_colours (CeldIoFile *file, size_t part, float *rgba, CeldIoError *error)
{
  return guarded ("read", file->path, error, [&] { read_colours (*file, part, rgba); });
}

bool
celd_io_read_values (CeldIoFile *file, size_t part, float *values, CeldIoError *error)
{
  return guarded ("read", file->path, error, [&] { read_values (*file, part, values); });
}
