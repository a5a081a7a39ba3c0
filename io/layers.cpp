// Writes the layers of a picture as OpenRaster (open-raster.cpp), as a PSD (psd.cpp), as an EXR of several parts, or as
// PNG files with a description (layers-json.cpp).
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "layers.hpp"
#include "write-parts.hpp"

#include <OpenImageIO/filesystem.h>

#include <cctype>
#include <cstdio>
#include <fstream>
#include <memory>

using OIIO::ImageSpec;

// ------------------------------------------------------------------ pixels

CeldRect
layer_box (const CeldIoLayer &layer)
{
  return layer.box.width ? layer.box : CeldRect { 0, 0, 1, 1 };
}

std::vector<float>
layer_pixels (const CeldIoStack &stack, size_t layer)
{
  const CeldRect     box = layer_box (stack.layer[layer]);
  std::vector<float> rgba (4 * size_t (box.width) * size_t (box.height));

  if (!stack.paint (stack.host, layer, rgba.data ()))
    throw IoStopped ();
  return rgba;
}

static ImageSpec
make_spec (int width, int height, OIIO::TypeDesc sample)
{
  ImageSpec spec (width, height, 4, sample);

  spec.channelnames  = { "R", "G", "B", "A" };
  spec.alpha_channel = 3;
  spec.attribute ("DateTime", ""); // else the present one, and equal layers would be other files each time
  return spec;
}

Bytes
encode_png (int width, int height, const float *rgba)
{
  ImageSpec                        spec = make_spec (width, height, OIIO::TypeUInt8);
  OIIO::Filesystem::IOVecOutput    memory;
  OIIO::Filesystem::IOProxy       *proxy = &memory;
  std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create ("png");

  if (!output)
    throw IoFailure (OIIO::geterror ());
  spec.attribute ("oiio:UnassociatedAlpha", 1);
  spec.attribute ("oiio:ColorSpace", "sRGB");
  spec.attribute ("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  if (!output->open ("layer.png", spec) || !output->write_image (OIIO::TypeFloat, rgba) || !output->close ())
    throw IoFailure (output->geterror ());
  return Bytes (memory.buffer ());
}

void
write_bytes (const std::string &path, const void *bytes, size_t size)
{
  std::ofstream file (path, std::ios::binary);

  file.write (static_cast<const char *> (bytes), std::streamsize (size));
  file.close ();
  if (!file)
    throw IoFailure ("there is not enough space for it.");
}

void
write_png (const std::string &path, int width, int height, const float *rgba)
{
  const Bytes bytes = encode_png (width, height, rgba);

  write_bytes (path, bytes.data (), bytes.size ());
}

// ------------------------------------------------------------------ EXR

static void
write_exr (const std::string &path, const CeldIoStack &stack)
{
  std::vector<ImageSpec> specs;

  for (size_t i = 0; i < stack.layers; i++)
    {
      const CeldRect box = layer_box (stack.layer[i]);
      ImageSpec      spec = make_spec (box.width, box.height, OIIO::TypeFloat);

      spec.x           = box.x;
      spec.y           = box.y;
      spec.full_width  = stack.width;
      spec.full_height = stack.height;
      spec.attribute ("oiio:subimagename", stack.layer[i].name);
      specs.push_back (spec);
    }
  write_parts (path, "openexr", specs, [&] (OIIO::ImageOutput &output, size_t i) {
    std::vector<float> rgba = layer_pixels (stack, i);

    for (size_t p = 0; p < rgba.size (); p += 4)
      for (size_t c = 0; c < 3; c++)
        rgba[p + c] *= rgba[p + 3];
    if (!output.write_image (OIIO::TypeFloat, rgba.data ()))
      throw IoFailure (output.geterror ());
  });
}

// ------------------------------------------------------------------ a folder

// The name of a layer's file, such as "07-ff0000.png"; characters other than letters and digits become hyphens.
static std::string
file_name (const CeldIoStack &stack, size_t layer)
{
  const size_t digits = std::max (std::to_string (stack.layers - 1).size (), size_t (2));
  std::string  number = std::to_string (layer), name;

  for (const char *c = stack.layer[layer].name; *c && name.size () < 64; c++)
    if (std::isalnum (static_cast<unsigned char> (*c)) && static_cast<unsigned char> (*c) < 0x80)
      name += *c;
    else if (!name.empty () && name.back () != '-')
      name += '-';
  while (!name.empty () && name.back () == '-')
    name.pop_back ();
  return std::string (digits - number.size (), '0') + number + (name.empty () ? "" : "-" + name) + ".png";
}

static void
write_folder (const std::string &path, const CeldIoStack &stack)
{
  NewFile                  folder (path, true);
  const size_t             row = 4 * size_t (stack.width);
  std::vector<float>       canvas (row * size_t (stack.height));
  std::vector<std::string> file;
  std::string              json;

  for (size_t i = 0; i < stack.layers; i++)
    {
      const CeldRect           box = layer_box (stack.layer[i]);
      const std::vector<float> rgba = layer_pixels (stack, i);
      const size_t             part = 4 * size_t (box.width);

      std::fill (canvas.begin (), canvas.end (), 0.f);
      for (int y = 0; y < box.height; y++)
        std::copy_n (&rgba[size_t (y) * part], part, &canvas[size_t (y + box.y) * row + 4 * size_t (box.x)]);
      file.push_back (file_name (stack, i));
      write_png (folder.name () + "/" + file[i], stack.width, stack.height, canvas.data ());
    }
  json = layers_json (stack, file);
  write_bytes (folder.name () + "/layers.json", json.data (), json.size ());
  folder.commit ();
}

// ------------------------------------------------------------------ the C functions

bool
celd_io_write_layers (const char *path, const CeldIoStack *stack, CeldIoError *error)
{
  return guarded_write (path, error, [&] {
    switch (celd_io_stack_kind (path))
      {
      case CELD_IO_OPEN_RASTER: write_open_raster (path, *stack); break;
#ifdef CELD_PSD
      case CELD_IO_PSD:         write_psd (path, *stack); break;
#else
      case CELD_IO_PSD:
        throw IoFailure ("this build of celdepth has no ImageMagick, which writes PSD files.");
#endif
      case CELD_IO_EXR_PARTS:   write_exr (path, *stack); break;
      case CELD_IO_FOLDER:      write_folder (path, *stack); break;
      case CELD_IO_NO_STACK:
        throw IoFailure ("its name must end in .ora, .psd or .exr; without an ending it is a folder.");
      }
  });
}
