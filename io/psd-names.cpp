// The names of layers of a PSD in Unicode ("luni"), which OpenImageIO leaves out.  What it has are names of one byte a
// character, in which Krita writes "?" for letters that Latin 1 does not have.
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

std::vector<std::string>
psd_layer_names (const std::string &path)
{
  PsdStream                psd (path);
  std::vector<std::string> names;

  if (!psd.has ("8BPS"))
    return names;
  const int wide = psd.number (2) == 2 ? 8 : 4; // bytes of some lengths: a PSB has longer ones
  psd.go_to (26);
  psd.skip (psd.number (4)); // colours
  psd.skip (psd.number (4)); // resources
  psd.number (wide);
  psd.number (wide);
  const int count = std::abs (int (int16_t (psd.number (2))));
  for (int i = 0; i < count && psd.good (); i++)
    {
      psd.skip (16);                                   // the place of the layer
      psd.skip (psd.number (2) * uint64_t (2 + wide)); // channels
      psd.skip (12);                                   // mode, opacity and flags
      const uint64_t length = psd.number (4), end = psd.place () + length;

      names.push_back (find_name (psd, end));
      psd.go_to (end);
    }
  return psd.good () ? names : std::vector<std::string> ();
}
