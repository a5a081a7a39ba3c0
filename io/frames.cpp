// Writes several pictures of one size: an animated GIF (gif.cpp), views in one MPO file, or PNG files in a folder.
//
// An MPO file (CIPA DC-007, Multi-Picture Format) is a sequence of JPEG files.  Each has a segment APP2 with a
// directory like that of TIFF; the first one also has the places of all others.  This file writes the directories
// itself.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "frames.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <fstream>
#include <memory>

using OIIO::ImageSpec;

// ------------------------------------------------------------------ pixels

// A table of sRGB codes of linear light, precise enough for 8 bits.
static const std::vector<float> &
srgb_table ()
{
  static const std::vector<float> table = [] {
    std::vector<float> codes (1 << 16);

    for (size_t i = 0; i < codes.size (); i++)
      codes[i] = encode_srgb (float (i) / float (codes.size () - 1));
    return codes;
  }();

  return table;
}

// A frame, encoded as sRGB, with straight alpha.
static std::vector<float>
frame_pixels (const CeldIoFrames &frames, size_t frame)
{
  const std::vector<float> &code = srgb_table ();
  std::vector<float> rgba (4 * size_t (frames.width) * size_t (frames.height));

  if (!frames.paint (frames.host, frame, rgba.data ()))
    throw IoStopped ();
  for (size_t i = 0; i < rgba.size (); i++)
    {
      const float value = rgba[i] > 0 ? std::min (rgba[i], 1.f) : 0; // NaN is 0

      rgba[i] = i % 4 < 3 ? code[size_t (value * float (code.size () - 1) + 0.5f)] : value;
    }
  return rgba;
}

std::vector<float>
frame_on_paper (const CeldIoFrames &frames, size_t frame)
{
  const std::vector<float> rgba = frame_pixels (frames, frame);
  std::vector<float>       rgb;

  rgb.reserve (rgba.size () / 4 * 3);
  for (size_t i = 0; i < rgba.size (); i += 4)
    for (size_t c = 0; c < 3; c++)
      rgb.push_back (rgba[i + 3] * rgba[i + c] + (1 - rgba[i + 3]));
  return rgb;
}

static ImageSpec
make_spec (const CeldIoFrames &frames)
{
  ImageSpec spec (frames.width, frames.height, 3, OIIO::TypeUInt8);

  spec.attribute ("oiio:ColorSpace", "sRGB");
  return spec;
}

static std::unique_ptr<OIIO::ImageOutput>
make_output (const char *format)
{
  auto output = OIIO::ImageOutput::create (format);

  if (!output)
    throw IoFailure (OIIO::geterror ());
  return output;
}

// ------------------------------------------------------------------ MPO

static Bytes
encode_jpeg (const CeldIoFrames &frames, size_t frame)
{
  ImageSpec                     spec = make_spec (frames);
  OIIO::Filesystem::IOVecOutput memory;
  OIIO::Filesystem::IOProxy    *proxy = &memory;
  auto                          output = make_output ("jpeg");

  spec.attribute ("CompressionQuality", 95);
  spec.attribute ("jpeg:subsampling", "4:4:4"); // colours of thin lines
  spec.attribute ("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  if (!output->open ("view.jpg", spec) ||
      !output->write_image (OIIO::TypeFloat, frame_on_paper (frames, frame).data ()) || !output->close ())
    throw IoFailure (output->geterror ());
  return Bytes (memory.buffer ());
}

// The place of the segment: after APP0 and APP1, which must come first.
static size_t
segment_place (const Bytes &jpeg)
{
  size_t place = 2;

  while (place + 4 < jpeg.size () && jpeg[place] == 0xff && (jpeg[place + 1] == 0xe0 || jpeg[place + 1] == 0xe1))
    place += 2 + (size_t (jpeg[place + 2]) << 8) + jpeg[place + 3];
  if (place + 4 >= jpeg.size ())
    throw IoFailure ("a view could not be encoded as JPEG.");
  return place;
}

static void
put (Bytes &to, uint32_t value, int bytes)
{
  for (int i = 0; i < bytes; i++)
    to.push_back (static_cast<unsigned char> (value >> 8 * i)); // low byte first, as "II" says
}

// A field of a directory; `value` is its value, or the offset of a value of more than four bytes.
static void
put_field (Bytes &to, uint32_t tag, uint32_t type, uint32_t count, uint32_t value)
{
  put (to, tag, 2);
  put (to, type, 2);
  put (to, count, 4);
  put (to, value, 4);
}

constexpr uint32_t type_long = 4, type_ratio = 5, type_undefined = 7, type_signed_ratio = 10;
constexpr uint32_t mp_version = 0x30303130;              // "0100"
constexpr uint32_t disparity_view = 0x020002, representative = 0x20000000;
constexpr uint32_t unknown = 0xffffffff;
constexpr uint32_t first_directory = 8;                  // bytes from the header
constexpr uint32_t index_size = 2 + 3 * 12 + 4;          // bytes of a directory of three fields
constexpr uint32_t entry_size = 16;                      // bytes of a view in the index

// The attributes of a view: its number from the left, and unknown positions of cameras.
static void
put_attributes (Bytes &to, uint32_t offset, size_t view, bool with_version)
{
  const uint32_t fields = with_version ? 5 : 4, values = offset + 2 + fields * 12 + 4;

  put (to, fields, 2);
  if (with_version)
    put_field (to, 0xb000, type_undefined, 4, mp_version);
  put_field (to, 0xb101, type_long, 1, uint32_t (view + 1));
  put_field (to, 0xb204, type_long, 1, 1); // the base viewpoint is the leftmost
  put_field (to, 0xb205, type_signed_ratio, 1, values);
  put_field (to, 0xb206, type_ratio, 1, values + 8);
  put (to, 0, 4);
  for (int i = 0; i < 4; i++)
    put (to, unknown, 4);
}

// The index of all views; places count from the header of its segment.  They are 0 while only its size is wanted.
static void
put_index (Bytes &to, const std::vector<std::pair<uint32_t, uint32_t>> &place_and_size)
{
  const uint32_t n = uint32_t (place_and_size.size ());
  const uint32_t entries = first_directory + index_size;

  put (to, 3, 2);
  put_field (to, 0xb000, type_undefined, 4, mp_version);
  put_field (to, 0xb001, type_long, 1, n);
  put_field (to, 0xb002, type_undefined, entry_size * n, entries);
  put (to, entries + entry_size * n, 4); // the attributes come next
  for (uint32_t i = 0; i < n; i++)
    {
      put (to, disparity_view | (i ? 0 : representative), 4);
      put (to, place_and_size[i].second, 4);
      put (to, place_and_size[i].first, 4);
      put (to, 0, 4); // no dependent images
    }
}

// The segment APP2 of a view; that of the first one has the index.
static Bytes
make_segment (size_t view, const std::vector<std::pair<uint32_t, uint32_t>> &place_and_size)
{
  constexpr size_t marker = 2, header = 8; // bytes before the length, and before the zero of offsets
  Bytes            segment = { 0xff, 0xe2, 0, 0, 'M', 'P', 'F', 0, 'I', 'I', 42, 0 };

  put (segment, first_directory, 4);
  if (view == 0)
    put_index (segment, place_and_size);
  put_attributes (segment, uint32_t (segment.size () - header), view, view > 0);
  segment[2] = static_cast<unsigned char> ((segment.size () - marker) >> 8);
  segment[3] = static_cast<unsigned char> (segment.size () - marker);
  return segment;
}

static void
write_mpo (const std::string &path, const CeldIoFrames &frames)
{
  constexpr size_t   most = 4000; // views; more entries of 16 bytes do not fit a segment of 64 KB
  std::vector<Bytes> views;
  NewFile            file (path);

  if (frames.frames > most)
    throw IoFailure ("MPO files can have at most 4000 views.");
  for (size_t i = 0; i < frames.frames; i++)
    views.push_back (encode_jpeg (frames, i));

  std::vector<std::pair<uint32_t, uint32_t>> where (views.size ());
  std::vector<size_t>                        place;
  size_t                                     begin = 0;

  for (size_t i = 0; i < views.size (); i++)
    {
      const size_t size = views[i].size () + make_segment (i, where).size ();

      place.push_back (segment_place (views[i]));
      // Places count from the header, which is 8 bytes after the beginning of the first view's segment.
      where[i] = { i ? uint32_t (begin - place[0] - 8) : 0, uint32_t (size) };
      begin += size;
      if (begin > UINT32_MAX)
        throw IoFailure ("it would be larger than 4 GB. Write fewer or smaller views.");
    }

  std::ofstream stream (file.name (), std::ios::binary);

  for (size_t i = 0; i < views.size (); i++)
    {
      const Bytes segment = make_segment (i, where);
      const auto  split = views[i].begin () + std::ptrdiff_t (place[i]);

      views[i].insert (split, segment.begin (), segment.end ());
      stream.write (reinterpret_cast<const char *> (views[i].data ()), std::streamsize (views[i].size ()));
    }
  stream.close ();
  if (!stream)
    throw IoFailure ("there is not enough space for it.");
  file.commit ();
}

// ------------------------------------------------------------------ a folder

static void
write_folder (const std::string &path, const CeldIoFrames &frames)
{
  NewFile      folder (path, true);
  const size_t digits = std::max (std::to_string (frames.frames - 1).size (), size_t (3));

  for (size_t i = 0; i < frames.frames; i++)
    {
      const std::string number = std::to_string (i);
      const std::string name = folder.name () + "/" + std::string (digits - number.size (), '0') + number + ".png";

      write_png (name, frames.width, frames.height, frame_pixels (frames, i).data ());
    }
  folder.commit ();
}

// ------------------------------------------------------------------ the C functions

bool
celd_io_write_frames (const char *path, const CeldIoFrames *frames, CeldIoError *error)
{
  return guarded_write (path, error, [&] {
    if (!frames->frames)
      throw IoFailure ("there are no frames.");
    switch (celd_io_frames_kind (path))
      {
#ifdef CELD_GIF
      case CELD_IO_GIF:        write_gif (path, *frames); break;
#else
      case CELD_IO_GIF:        throw IoFailure ("this build of celdepth has no giflib.");
#endif
      case CELD_IO_MPO:        write_mpo (path, *frames); break;
      case CELD_IO_PNG_FRAMES: write_folder (path, *frames); break;
      case CELD_IO_NO_FRAMES:
        throw IoFailure ("its name must end in .gif or .mpo; without an ending it is a folder.");
      }
  });
}
