// Writes Photoshop documents, by ImageMagick 6 or 7: the layers in 8 bits with names and places, and their composite.
//
// Layers are compressed by runs, which all readers know.  As in Photoshop's own files the composite lies on white; its
// alpha is kept, so that readers can take the white out again.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "layers.hpp"

#if __has_include(<MagickWand/MagickWand.h>)
#include <MagickWand/MagickWand.h>
#else
#include <wand/MagickWand.h>
#endif

#include <cmath>

// ImageMagick for as long as a file is written, and the pictures of the file.
class Wand
{
public:
  Wand ()
  {
    MagickWandGenesis ();
    wand = NewMagickWand ();
    if (wand)
      return;
    MagickWandTerminus ();
    throw std::bad_alloc ();
  }

  ~Wand ()
  {
    DestroyMagickWand (wand);
    MagickWandTerminus ();
  }

  Wand (const Wand &) = delete;
  Wand &operator= (const Wand &) = delete;

  // `channels` are "RGB" or "RGBA".
  void
  add (const CeldIoStack &stack, const CeldRect &box, const char *channels, const char *name, const Bytes &pixels)
  {
    MagickSetLastIterator (wand);
    check (MagickConstituteImage (wand, size_t (box.width), size_t (box.height), channels, CharPixel, pixels.data ()));
    check (MagickSetImagePage (wand, size_t (stack.width), size_t (stack.height), box.x, box.y));
    check (MagickSetImageDepth (wand, 8));
    check (MagickSetImageFormat (wand, "PSD"));
    check (MagickSetImageCompression (wand, RLECompression));
    check (MagickSetImageProperty (wand, "colorspace:auto-grayscale", "false")); // grey pictures are stored as RGB, too
    if (name)
      check (MagickSetImageProperty (wand, "label", name));
  }

  Bytes
  bytes ()
  {
    size_t         size = 0;
    unsigned char *blob;
    Bytes          bytes;

    check (MagickSetFormat (wand, "PSD"));
    check (MagickSetCompression (wand, RLECompression));
    MagickResetIterator (wand);
    blob = MagickGetImagesBlob (wand, &size);
    check (blob ? MagickTrue : MagickFalse);
    bytes.assign (blob, blob + size);
    MagickRelinquishMemory (blob);
    return bytes;
  }

private:
  void
  check (MagickBooleanType good)
  {
    if (!good)
      throw IoFailure ("ImageMagick refuses it.");
  }

  MagickWand *wand;
};

static unsigned char
to_byte (float value)
{
  return static_cast<unsigned char> (std::lround (std::clamp (value, 0.f, 1.f) * 255));
}

static Bytes
layer_bytes (const CeldIoStack &stack, size_t layer)
{
  const std::vector<float> rgba = layer_pixels (stack, layer);
  Bytes                    bytes (rgba.size ());

  std::transform (rgba.begin (), rgba.end (), bytes.begin (), to_byte);
  return bytes;
}

static void
add_composite (Wand &wand, const CeldIoStack &stack)
{
  const size_t n = size_t (stack.width) * size_t (stack.height);
  bool         opaque = true;
  Bytes        bytes;

  for (size_t i = 0; i < n; i++)
    opaque = opaque && stack.merged[4 * i + 3] >= 1;
  bytes.reserve ((opaque ? 3 : 4) * n);
  for (size_t i = 0; i < n; i++)
    {
      const float *from = stack.merged + 4 * i;

      for (int c = 0; c < 3; c++)
        bytes.push_back (to_byte (from[c] * from[3] + 1 - from[3]));
      if (!opaque)
        bytes.push_back (to_byte (from[3]));
    }
  wand.add (stack, { 0, 0, stack.width, stack.height }, opaque ? "RGB" : "RGBA", nullptr, bytes);
}

// ImageMagick ends the program where a picture is larger than its policy allows (policy.xml), instead of telling so.
static void
check_limits (const CeldIoStack &stack)
{
  const size_t widest = MagickGetResourceLimit (WidthResource), highest = MagickGetResourceLimit (HeightResource);

  if (size_t (stack.width) > widest || size_t (stack.height) > highest)
    throw IoFailure ("ImageMagick, which writes PSD files, allows no more than " + std::to_string (widest) + " x " +
                     std::to_string (highest) + " pixels here; write an ORA file, or raise the limits in its policy.xml.");
}

static Bytes
encode_psd (const CeldIoStack &stack)
{
  Wand wand;

  check_limits (stack);
  add_composite (wand, stack);
  for (size_t i = 0; i < stack.layers; i++)
    wand.add (stack, layer_box (stack.layer[i]), "RGBA", stack.layer[i].name, layer_bytes (stack, i));
  return wand.bytes ();
}

// ------------------------------------------------------------------ padding

static size_t
read_number (const Bytes &bytes, size_t at)
{
  size_t number = 0;

  if (at + 4 > bytes.size ())
    throw IoFailure ("ImageMagick wrote a file that is too short.");
  for (size_t i = 0; i < 4; i++)
    number = number << 8 | bytes[at + i];
  return number;
}

static void
write_number (Bytes &bytes, size_t at, size_t number)
{
  for (size_t i = 0; i < 4; i++)
    bytes[at + i] = static_cast<unsigned char> (number >> (24 - 8 * i));
}

// The layers take an even number of bytes.  ImageMagick rounds the number up, but does not write the byte that is then
// missing before the four bytes, all 0, that follow the layers.
static void
pad_layers (Bytes &bytes)
{
  size_t at = 26; // after the header

  for (int section = 0; section < 2; section++) // colour tables, resources
    at += 4 + read_number (bytes, at);

  const size_t size = read_number (bytes, at), layers = read_number (bytes, at + 4);

  if (size != 4 + layers + 4 - 1)
    return;
  bytes.insert (bytes.begin () + std::ptrdiff_t (at + size), 0);
  write_number (bytes, at, size + 1);
}

void
write_psd (const std::string &path, const CeldIoStack &stack)
{
  NewFile file (path);
  Bytes   bytes = encode_psd (stack);

  pad_layers (bytes);
  write_bytes (file.name (), bytes.data (), bytes.size ());
  file.commit ();
}
