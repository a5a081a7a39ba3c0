// Decodes pictures with OpenImageIO, in the reading process (read-server.cpp).
//
// Pixels are read in strips, so that a layer needs the memory of a strip beside that of OpenImageIO.  Straight alpha
// is kept as it is in the file; premultiplied colours (EXR, some TIFF) are divided by alpha.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-file.hpp"

#include "read-layered.hpp"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include <fcntl.h>
#include <unistd.h>

using OIIO::ImageSpec;
using OIIO::Strutil::iequals;

// A file that is open.
struct Descriptor
{
  int number;

  explicit Descriptor (const std::string &path)
      : number (open (path.c_str (), O_RDONLY | O_CLOEXEC))
  {
    if (number < 0)
      throw IoFailure ("it cannot be opened: " + system_reason (errno));
  }
  ~Descriptor () { close (number); }
  Descriptor (const Descriptor &) = delete;
  Descriptor &operator= (const Descriptor &) = delete;

  // A name without a question mark, from which OpenImageIO reads options for its decoders.
  std::string plain_name () const { return "/proc/self/fd/" + std::to_string (number); }
};

// A file that OpenImageIO decodes.
class DecodedFile : public PictureFile
{
public:
  std::unique_ptr<Descriptor>       descriptor; // if its name is odd
  std::unique_ptr<OIIO::ImageInput> input;
  std::vector<ImageSpec>            specs; // of each part

  uint64_t    decoding_memory (size_t part) const override;
  std::string profile (size_t part) const override;
  CeldRect    place (size_t part) const override;
  void        read_colours (size_t part, const TakeRows &take) override;
  void        read_values (size_t part, const TakeRows &take) override;

private:
  void check_part (size_t part) const;
  void decode_rows (size_t part, int y, int end, float *pixels);
  template <typename Convert> void read_rows (size_t part, int floats, const TakeRows &take, Convert convert);
};

// ------------------------------------------------------------------ channels

// The channel of that name, alone or as the last part of a longer name ("N.X"); -1 if there is none.
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

// Numbers of channels; alpha is -1 if there is none.
struct Channels
{
  int red, green, blue, alpha;
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

// Corrects what OpenImageIO says about a layer of a PSD: the canvas is not the layer's size but that of the merged
// picture, and alpha is straight in all layers, not only in the last one.
static void
place_layer (ImageSpec &spec, const ImageSpec &merged)
{
  spec.full_x = spec.full_y = 0;
  spec.full_width = merged.full_width;
  spec.full_height = merged.full_height;
  spec.attribute ("oiio:UnassociatedAlpha", 1);
}

static Part
describe (const ImageSpec &spec, int width, int height, const char *format)
{
  Part       part = {};
  Channels   c = colour_channels (spec);
  int64_t    left = int64_t (spec.x) - spec.full_x, top = int64_t (spec.y) - spec.full_y;
  const bool covers = left <= 0 && top <= 0 && left + spec.width >= width && top + spec.height >= height;

  part.name = spec.get_string_attribute ("oiio:subimagename");
  if (part.name.empty ())
    part.name = spec.get_string_attribute ("tiff:PageName");
  part.info.alpha = c.alpha >= 0 || !covers;
  part.info.grey = c.red == c.green && c.red == c.blue;
  part.info.linear = is_linear (spec, format);
  part.info.bits = int (8 * spec.format.basesize ());
  return part;
}

// Throws if the file is too small for its size in pixels: the merged picture of a PSD is stored uncompressed, or as
// runs of at most 128 bytes in 2.
static void
check_psd_size (const DecodedFile &file)
{
  const ImageSpec &spec = file.specs[0];
  const uint64_t   bytes = uint64_t (file.width) * uint64_t (file.height) * uint64_t (std::max (spec.nchannels, 1)) *
                         spec.format.basesize ();

  if (bytes / 64 > file.size)
    throw IoFailure ("it is truncated.");
}

void
check_canvas (int64_t width, int64_t height)
{
  if (width < 1 || height < 1 || width > CELD_MAX_SIDE || height > CELD_MAX_SIDE)
    throw IoFailure ("it has " + std::to_string (width) + " x " + std::to_string (height) +
                     " pixels; width and height must be from 1 to " + std::to_string (CELD_MAX_SIDE) + ".");
}

// OpenImageIO has the merged picture as part 0, then the layers.
static void
name_layers (DecodedFile &file, const std::vector<std::string> &names)
{
  for (size_t i = 0; i < names.size () && names.size () + 1 == file.parts.size (); i++)
    if (!names[i].empty ())
      file.parts[i + 1].name = names[i];
}

static int
orientation_of (const DecodedFile &file, const std::string &path)
{
  if (!file.specs[0].find_attribute ("Orientation") && iequals (file.input->format_name (), "webp"))
    return webp_orientation (path);
  return file.specs[0].get_int_attribute ("Orientation", 1);
}

// Whether the file has several pictures of a size that follow each other, of which OpenImageIO tells in some formats.
static bool
has_frames (const DecodedFile &file, const std::string &path)
{
  const char      *format = file.input->format_name ();
  const ImageSpec &first = file.specs[0], &last = file.specs.back ();

  if (iequals (format, "png"))
    return png_is_animated (path);
  if (iequals (format, "webp"))
    return first.get_int_attribute ("oiio:Movie");
  return file.specs.size () > 1 && (iequals (format, "gif") || iequals (format, "tiff")) && first.width == last.width &&
         first.height == last.height;
}

static std::unique_ptr<PictureFile>
open_decoded (const std::string &path, std::unique_ptr<Descriptor> descriptor)
{
  const bool                   odd = path.find ('?') != std::string::npos;
  std::unique_ptr<DecodedFile> file = std::make_unique<DecodedFile> ();
  ImageSpec                    wishes;

  file->size = std::filesystem::file_size (path);
  wishes.attribute ("oiio:UnassociatedAlpha", 1);
  file->input = OIIO::ImageInput::open (odd ? descriptor->plain_name () : path, &wishes);
  if (odd)
    file->descriptor = std::move (descriptor);
  if (!file->input && psd_has_zip (path))
    throw IoFailure ("its layers are compressed by ZIP, which cannot be read; save it with RLE or without compression, "
                     "or as ORA.");
  if (!file->input)
    throw IoFailure (unreadable_reason (path));
  // OpenImageIO does not find the way back in a WebP, not even from the search for a second picture.
  const int most = iequals (file->input->format_name (), "webp") ? 1 : std::numeric_limits<int>::max ();
  for (int i = 0; i < most && file->input->seek_subimage (i, 0); i++)
    file->specs.push_back (file->input->spec (i, 0));
  file->input->geterror (); // discards the error of the search for a part after the last one
  if (file->specs.empty ())
    throw IoFailure ("it contains no picture.");
  file->width = file->specs[0].full_width;
  file->height = file->specs[0].full_height;
  check_canvas (file->width, file->height);
  if (iequals (file->input->format_name (), "psd"))
    {
      check_psd_size (*file);
      for (ImageSpec &spec : file->specs)
        place_layer (spec, file->specs[0]);
    }
  for (const ImageSpec &spec : file->specs)
    file->parts.push_back (describe (spec, file->width, file->height, file->input->format_name ()));
  if (iequals (file->input->format_name (), "psd"))
    name_layers (*file, psd_layer_names (path));
  file->parts[0].info.frame = has_frames (*file, path);
  if (file->specs.size () > 1)
    return file;

  const int orientation = orientation_of (*file, path);

  return turned (std::move (file), orientation);
}

std::unique_ptr<PictureFile>
open_png (OIIO::Filesystem::IOProxy &stream, const CeldRect &canvas)
{
  std::unique_ptr<DecodedFile> file = std::make_unique<DecodedFile> ();
  ImageSpec                    wishes, spec;

  wishes.attribute ("oiio:UnassociatedAlpha", 1);
  file->input = OIIO::ImageInput::create ("png");
  if (!file->input || !file->input->set_ioproxy (&stream) || !file->input->open ("layer.png", spec, wishes))
    throw IoFailure ("it is damaged, or no PNG.");
  file->size   = stream.size ();
  file->width  = canvas.width;
  file->height = canvas.height;
  spec.full_x = spec.x + canvas.x;
  spec.full_y = spec.y + canvas.y;
  spec.full_width = file->width, spec.full_height = file->height;
  file->specs.push_back (spec);
  file->parts.push_back (describe (spec, file->width, file->height, "png"));
  return file;
}

std::unique_ptr<PictureFile>
open_picture (const std::string &path)
{
  std::filesystem::file_status status = std::filesystem::status (path);

  if (!std::filesystem::exists (status))
    throw IoFailure ("there is no such file.");
  if (std::filesystem::is_directory (status))
    throw IoFailure ("it is a folder.");
  if (!std::filesystem::is_regular_file (status))
    throw IoFailure ("it is not an ordinary file.");

  auto descriptor = std::make_unique<Descriptor> (path);

  return is_zip (path) ? open_layered (path) : open_decoded (path, std::move (descriptor));
}

// Twice the size of the pixels, since interlaced and animated pictures are decoded as a whole, some with a copy.
uint64_t
DecodedFile::decoding_memory (size_t index) const
{
  const ImageSpec &spec = specs.at (index);
  const uint64_t   canvas = uint64_t (width) * uint64_t (height);
  const uint64_t   part = uint64_t (std::max (spec.width, 0)) * uint64_t (std::max (spec.height, 0));

  return 2 * std::max (canvas, part) * uint64_t (std::clamp (spec.nchannels, 4, 64)) * spec.format.basesize ();
}

std::string
DecodedFile::profile (size_t part) const
{
  // The profile of a PSD is for all its layers, but OpenImageIO gives it to some parts only.
  for (size_t i : { part, size_t (0) })
    if (const auto *profile = specs.at (i).find_attribute ("ICCProfile"))
      return std::string (static_cast<const char *> (profile->data ()), size_t (profile->datasize ()));
  return "";
}

// ------------------------------------------------------------------ pixels

// Pixels from the canvas to the farthest place of a layer (chosen: sums of places fit an int).
constexpr int64_t farthest_place = 1 << 24;

// Throws if the part cannot be used.
void
DecodedFile::check_part (size_t index) const
{
  const ImageSpec &spec = specs.at (index);

  if (spec.full_width != width || spec.full_height != height)
    throw IoFailure ("its part " + std::to_string (index) + " does not have the size of its first part.");
  if (spec.deep || spec.depth > 1)
    throw IoFailure ("it is a deep picture or a volume, which cannot be read.");
  if (spec.width > 2 * CELD_MAX_SIDE || spec.height > 2 * CELD_MAX_SIDE || spec.nchannels < 1 ||
      std::abs (int64_t (spec.x) - spec.full_x) > farthest_place ||
      std::abs (int64_t (spec.y) - spec.full_y) > farthest_place)
    throw IoFailure ((specs.size () > 1 ? "its part " + std::to_string (index) : "it") +
                     " is too large or too far outside.");
}

CeldRect
DecodedFile::place (size_t index) const
{
  const ImageSpec &spec = specs.at (index);

  check_part (index);
  const int left = spec.x - spec.full_x, top = spec.y - spec.full_y;
  const int x = std::clamp (left, 0, width), right = std::clamp (left + spec.width, x, width);
  const int y = std::clamp (top, 0, height), bottom = std::clamp (top + spec.height, y, height);

  return { x, y, right - x, bottom - y };
}

// Decodes rows y .. end - 1 of a part, all columns and channels.
void
DecodedFile::decode_rows (size_t index, int y, int end, float *pixels)
{
  const ImageSpec &spec = specs[index];
  const int        part = int (index), n = spec.nchannels;
  bool             good = spec.tile_width
                            ? input->read_tiles (part, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end, spec.z,
                                                 spec.z + 1, 0, n, OIIO::TypeFloat, pixels)
                            : input->read_scanlines (part, 0, spec.y + y, spec.y + end, spec.z, 0, n, OIIO::TypeFloat,
                                                     pixels);

  // For a truncated TIFF OpenImageIO keeps an error, but returns true.
  if (!good || input->has_error ())
    throw IoFailure ("it is damaged or truncated.");
}

// Reads a part in strips; convert (from, to) makes `floats` numbers of each pixel on the canvas.
template <typename Convert>
void
DecodedFile::read_rows (size_t index, int floats, const TakeRows &take, Convert convert)
{
  const CeldRect     visible = place (index);
  const ImageSpec   &spec = specs[index];
  const int          left = spec.x - spec.full_x, top = spec.y - spec.full_y;
  const size_t       n = size_t (spec.nchannels), row = size_t (std::max (spec.width, 0)) * n;
  const size_t       visible_row = size_t (visible.width) * size_t (floats);
  const int          unit = std::max (spec.tile_height, 1);
  const int          rows = int (std::min<size_t> ((size_t (1) << 22) / std::max<size_t> (row, 1), 256));
  const int          strip = std::max (rows / unit, 1) * unit;
  std::vector<float> pixels (row * size_t (std::min (strip, std::max (spec.height, 0)))), visible_pixels;

  for (int y = 0; spec.width > 0 && y < spec.height; y += strip)
    {
      const int end = std::min (y + strip, spec.height);
      const int first = std::max (y, visible.y - top), last = std::min (end, visible.y + visible.height - top);

      decode_rows (index, y, end, pixels.data ());
      if (first >= last || !visible.width)
        continue;
      visible_pixels.resize (visible_row * size_t (last - first));
      for (int j = first; j < last; j++)
        for (int i = 0; i < visible.width; i++)
          convert (pixels.data () + size_t (j - y) * row + size_t (visible.x - left + i) * n,
                   visible_pixels.data () + size_t (j - first) * visible_row + size_t (i) * size_t (floats));
      take (visible_pixels.data (), last - first);
    }
}

void
DecodedFile::read_colours (size_t index, const TakeRows &take)
{
  const ImageSpec &spec = specs.at (index);
  const Channels   c = colour_channels (spec);
  const bool       premultiplied = c.alpha >= 0 && !spec.get_int_attribute ("oiio:UnassociatedAlpha");

  read_rows (index, 4, take, [=] (const float *pixel, float *rgba) {
    float alpha = c.alpha >= 0 ? pixel[c.alpha] : 1.f;
    float divisor = premultiplied && alpha > 0 ? alpha : 1.f;

    rgba[0] = pixel[c.red] / divisor;
    rgba[1] = pixel[c.green] / divisor;
    rgba[2] = pixel[c.blue] / divisor;
    rgba[3] = alpha;
  });
}

// How values are computed from a channel: offset + factor * stored.
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
DecodedFile::read_values (size_t index, const TakeRows &take)
{
  const Scale scale = value_scale (specs.at (index));

  read_rows (index, 1, take, [=] (const float *pixel, float *value) {
    *value = scale.offset + scale.factor * pixel[scale.channel];
  });
}
