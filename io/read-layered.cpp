// Layers of OpenRaster files and Krita documents as parts of a PictureFile.
//
// Part 0 is the merged picture, as in a PSD; then come layers and groups from back to front, a group before what is
// in it.  A part has the pixels that were painted, whatever the layer's own opacity, visibility and mode are, since
// artists hide their scribbles; a group has the composite of what is visible in it.  Modes other than multiply count as
// normal there.  The composite of all layers is only made if the file has no merged picture.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-layered.hpp"

#include <algorithm>

constexpr int farthest = 1 << 25; // pixels from the canvas: farther than any layer may be (read-file.cpp)

int
place_number (double number)
{
  return int (std::clamp (number, -double (farthest), double (farthest)));
}

// ------------------------------------------------------------------ composites

// Premultiplied colours of the whole canvas, encoded as sRGB, in which OpenRaster composites.
class Composite
{
public:
  Composite (int w, int h)
      : width (size_t (w)), height (size_t (h)), rgba (4 * width * height)
  {
  }

  // Puts a pixel with straight alpha over what is there; W3C, Compositing and Blending Level 1, section 10.1.
  void
  put (size_t pixel, const float *straight, float opacity, bool multiplies)
  {
    float      *to    = &rgba[4 * pixel];
    const float alpha = straight[3] * opacity, below = to[3];

    for (int c = 0; c < 3; c++)
      {
        const float alone = straight[c] * alpha * (1 - below), kept = to[c] * (1 - alpha);

        to[c] = kept + alone + straight[c] * alpha * (multiplies ? to[c] : below);
      }
    to[3] = alpha + below * (1 - alpha);
  }

  void
  straight (size_t pixel, float *to) const
  {
    const float *from = &rgba[4 * pixel];

    for (int c = 0; c < 3; c++)
      to[c] = from[3] > 0 ? from[c] / from[3] : 0;
    to[3] = from[3];
  }

  const size_t width, height;

private:
  std::vector<float> rgba;
};

// ------------------------------------------------------------------ the file

class LayeredFile : public PictureFile
{
public:
  explicit LayeredFile (const std::string &path);

  uint64_t    decoding_memory (size_t part) const override;
  std::string profile (size_t part) const override;
  CeldRect    place (size_t part) const override;
  void        read_colours (size_t part, const TakeRows &take) override;
  void        read_values (size_t part, const TakeRows &take) override;

private:
  // An open layer that is no group, with its stream.
  struct Source
  {
    std::unique_ptr<ZipStream>   stream;
    std::unique_ptr<PictureFile> file;
  };

  Source open_layer (const Layer &layer) const;
  void   list_layers (const Layer &group);
  void   add_part (const Layer &layer);
  const Layer &
  layer_of (size_t part) const
  {
    return *layers.at (part);
  }
  void draw_group (const Layer &group, Composite &composite) const;
  void draw_layer (const Layer &layer, Composite &composite) const;
  void draw_children (const Layer &group, Composite &composite) const;
  void take_composite (size_t part, size_t floats, const TakeRows &take) const;

  ZipFile                    zip;
  LayeredPage                page;
  Layer                      merged;
  std::vector<const Layer *> layers; // of the parts
  std::vector<std::string>   profiles;
};

// Does the work; a failure names the layer.
template <typename Work>
static auto
named (const Layer &layer, Work work)
{
  try
    {
      return work ();
    }
  catch (const IoFailure &why)
    {
      throw IoFailure (layer.name.empty () ? why.what () : "its layer \"" + layer.name + "\": " + why.what ());
    }
}

LayeredFile::Source
LayeredFile::open_layer (const Layer &layer) const
{
  Source source;

  if (!layer.problem.empty ())
    throw IoFailure (layer.problem);
  if (layer.store == Store::krita_tiles)
    source.file = open_krita_tiles (zip, layer, width, height);
  else
    {
      source.stream = std::make_unique<ZipStream> (zip, layer.entry);
      source.file   = open_png (*source.stream, { -layer.x, -layer.y, width, height });
    }
  return source;
}

// Appends a part.  A layer that cannot be read is only described: it may not be wanted.
void
LayeredFile::add_part (const Layer &layer)
{
  Part        part = { layer.name, { nullptr, true, false, false, 8, false } };
  std::string icc, why;

  if (layer.store != Store::group)
    succeeds (why, [&] {
      const Source source = open_layer (layer);

      part.info = source.file->parts[0].info;
      icc       = source.file->profile (0);
    });
  layers.push_back (&layer);
  parts.push_back (part);
  profiles.push_back (icc);
}

void
LayeredFile::list_layers (const Layer &group)
{
  for (const Layer &layer : group.children)
    {
      add_part (layer);
      list_layers (layer);
    }
}

static LayeredPage
read_page (const ZipFile &zip)
{
  const std::string kind = zip.has ("mimetype") ? zip.bytes ("mimetype", longest_word) : "";

  if (zip.has ("stack.xml") && kind.rfind ("application/x-krita", 0) != 0)
    return read_open_raster (zip);
  if (zip.has ("maindoc.xml"))
    return read_krita (zip);
  throw IoFailure ("it is a zip file, but neither OpenRaster (ORA) nor a document of Krita (KRA).");
}

LayeredFile::LayeredFile (const std::string &path)
    : zip (path), page (read_page (zip))
{
  width        = page.width;
  height       = page.height;
  size         = std::filesystem::file_size (path);
  merged.entry = page.merged;
  merged.store = Store::png;
  add_part (zip.has (page.merged) ? merged : page.root);
  parts[0].name = "";
  list_layers (page.root);
}

// ------------------------------------------------------------------ parts

uint64_t
LayeredFile::decoding_memory (size_t part) const
{
  const uint64_t canvas = uint64_t (width) * uint64_t (height);

  // A composite, one more for each group in it, and the layer that is decoded; or a layer of up to 16 bits, twice.
  return layer_of (part).store == Store::group ? 64 * canvas : 16 * canvas;
}

std::string
LayeredFile::profile (size_t part) const
{
  return profiles.at (part);
}

CeldRect
LayeredFile::place (size_t part) const
{
  const Layer &layer = layer_of (part);

  if (layer.store == Store::group)
    return { 0, 0, width, height };
  return named (layer, [&] { return open_layer (layer).file->place (0); });
}

void
LayeredFile::read_colours (size_t part, const TakeRows &take)
{
  const Layer &layer = layer_of (part);

  if (layer.store == Store::group)
    take_composite (part, 4, take);
  else
    named (layer, [&] { open_layer (layer).file->read_colours (0, take); });
}

void
LayeredFile::read_values (size_t part, const TakeRows &take)
{
  const Layer &layer = layer_of (part);

  if (layer.store == Store::group)
    take_composite (part, 1, take);
  else
    named (layer, [&] { open_layer (layer).file->read_values (0, take); });
}

// ------------------------------------------------------------------ groups

void
LayeredFile::draw_group (const Layer &group, Composite &composite) const
{
  Composite inner (width, height);
  float     pixel[4];

  draw_children (group, inner);
  for (size_t i = 0; i < inner.width * inner.height; i++)
    {
      inner.straight (i, pixel);
      composite.put (i, pixel, group.opacity, group.multiplies);
    }
}

void
LayeredFile::draw_layer (const Layer &layer, Composite &composite) const
{
  const Source   source = open_layer (layer);
  const CeldRect box    = source.file->place (0);
  size_t         y      = size_t (box.y);

  source.file->read_colours (0, [&] (const float *rows, int count) {
    for (int j = 0; j < count; j++, y++)
      for (size_t i = 0; i < size_t (box.width); i++, rows += 4)
        composite.put (y * composite.width + size_t (box.x) + i, rows, layer.opacity, layer.multiplies);
  });
}

void
LayeredFile::draw_children (const Layer &group, Composite &composite) const
{
  for (const Layer &layer : group.children)
    if (layer.visible && layer.store == Store::group)
      draw_group (layer, composite);
    else if (layer.visible)
      named (layer, [&] { draw_layer (layer, composite); });
}

// Hands on the first `floats` channels of a group's composite.
void
LayeredFile::take_composite (size_t part, size_t floats, const TakeRows &take) const
{
  Composite          composite (width, height);
  std::vector<float> row (floats * composite.width);
  float              pixel[4];

  draw_children (layer_of (part), composite);
  for (size_t y = 0; y < composite.height; y++)
    {
      for (size_t x = 0; x < composite.width; x++)
        {
          composite.straight (y * composite.width + x, pixel);
          std::copy_n (pixel, floats, &row[floats * x]);
        }
      take (row.data (), 1);
    }
}

std::unique_ptr<PictureFile>
open_layered (const std::string &path)
{
  return std::make_unique<LayeredFile> (path);
}
