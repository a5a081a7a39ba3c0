// What OpenImageIO does not read of a PSD: the names of layers in Unicode ("luni"), and layers that are compressed by
// ZIP.  It has names of one byte a character, in which Krita writes "?" for letters that Latin 1 does not have.
//
// Source: Adobe, Photoshop File Formats Specification, Layer and Mask Information Section.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-file.hpp"

#include <glib.h>

#include <cstdlib>
#include <cstring>
#include <fstream>

constexpr uint32_t longest_name = 1024; // UTF-16 units; chosen: Photoshop has 255

// Numbers and places in a file; after its end it is no longer good.
class PsdStream
{
public:
  explicit PsdStream (const std::string &path)
      : in (path, std::ios::binary)
  {
  }

  uint64_t
  number (int bytes)
  {
    uint64_t value = 0;

    while (bytes-- > 0)
      value = value << 8 | uint64_t (in.get () & 255);
    return value;
  }

  bool
  has (const char *signature)
  {
    char word[4] = "";

    return in.read (word, 4) && !memcmp (word, signature, 4);
  }

  bool
  good () const
  {
    return in.good ();
  }
  uint64_t
  place ()
  {
    return uint64_t (in.tellg ());
  }
  void
  go_to (uint64_t to)
  {
    in.seekg (std::streamoff (to));
  }
  void
  skip (uint64_t bytes)
  {
    go_to (place () + bytes);
  }

private:
  std::ifstream in;
};

static std::string
read_unicode (PsdStream &psd)
{
  const uint64_t         n = psd.number (4);
  std::vector<gunichar2> units;
  std::string            name;

  for (uint64_t i = 0; i < n && i < longest_name && psd.good (); i++)
    units.push_back (gunichar2 (psd.number (2)));
  if (char *text = g_utf16_to_utf8 (units.data (), glong (units.size ()), nullptr, nullptr, nullptr))
    {
      name = text;
      g_free (text);
    }
  return name;
}

// The Unicode name among what belongs to a layer, up to a place in the file; "" if there is none.
static std::string
find_name (PsdStream &psd, uint64_t end)
{
  psd.skip (psd.number (4));                   // mask
  psd.skip (psd.number (4));                   // blending ranges
  psd.skip ((psd.number (1) + 4) / 4 * 4 - 1); // the name in bytes
  while (psd.good () && psd.place () + 12 <= end && psd.has ("8BIM"))
    {
      const bool     found  = psd.has ("luni");
      const uint64_t length = psd.number (4);

      if (found)
        return read_unicode (psd);
      psd.skip ((length + 1) / 2 * 2);
    }
  return "";
}

// A layer: its name, "" if it has none in Unicode, and how many bytes each of its channels takes.
struct PsdLayer
{
  std::string           name;
  std::vector<uint64_t> channel;
};

// The layers from the lowest to the highest, whose pixels follow in the stream; none if the file is damaged.
static std::vector<PsdLayer>
read_layers (PsdStream &psd)
{
  std::vector<PsdLayer> layers;

  if (!psd.has ("8BPS"))
    return layers;
  const int wide = psd.number (2) == 2 ? 8 : 4; // bytes of some lengths: a PSB has longer ones
  psd.go_to (26);
  psd.skip (psd.number (4)); // colours
  psd.skip (psd.number (4)); // resources
  psd.number (wide);
  psd.number (wide);
  const int count = std::abs (int (int16_t (psd.number (2))));
  for (int i = 0; i < count && psd.good (); i++)
    {
      PsdLayer layer;

      psd.skip (16);                     // the place of the layer
      for (uint64_t n = psd.number (2); n > 0 && psd.good (); n--)
        {
          psd.skip (2);                  // which channel it is
          layer.channel.push_back (psd.number (wide));
        }
      psd.skip (12);                     // mode, opacity and flags
      const uint64_t length = psd.number (4), end = psd.place () + length;

      layer.name = find_name (psd, end);
      layers.push_back (layer);
      psd.go_to (end);
    }
  return psd.good () ? layers : std::vector<PsdLayer> ();
}

std::vector<std::string>
psd_layer_names (const std::string &path)
{
  PsdStream                psd (path);
  std::vector<std::string> names;

  for (const PsdLayer &layer : read_layers (psd))
    names.push_back (layer.name);
  return names;
}

bool
psd_has_zip (const std::string &path)
{
  constexpr uint64_t first_zip = 2; // 0 raw, 1 RLE, 2 ZIP, 3 ZIP of differences
  PsdStream          psd (path);
  bool               found = false;

  for (const PsdLayer &layer : read_layers (psd))
    for (const uint64_t length : layer.channel)
      {
        const uint64_t next = psd.place () + length, kind = psd.number (2);

        found = found || (psd.good () && (kind == first_zip || kind == first_zip + 1));
        psd.go_to (next);
      }
  return found;
}
