// What OpenImageIO passes over in the chunks of a file: the orientation of a WebP, and that a PNG is animated.
//
// Sources: RFC 9649, section 2.3 (a chunk of a WebP is a name, its size, and so many bytes, or one more to an even
// number); W3C, PNG, third edition, section 5.3 (size, name, so many bytes, a checksum) and 11.3.1 (acTL).
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-file.hpp"

#include <OpenImageIO/tiffutils.h>

#include <algorithm>
#include <cstring>
#include <fstream>

constexpr uint32_t most_exif = 1 << 16; // bytes; as many as a JPEG can have

static bool
read_head (std::ifstream &file, unsigned char (&head)[8])
{
  return bool (file.read (reinterpret_cast<char *> (head), sizeof head));
}

int
webp_orientation (const std::string &path)
{
  std::ifstream   file (path, std::ios::binary);
  unsigned char   head[8];
  OIIO::ImageSpec notes;

  file.seekg (12);
  while (read_head (file, head))
    {
      const uint32_t size = head[4] | uint32_t (head[5]) << 8 | uint32_t (head[6]) << 16 | uint32_t (head[7]) << 24;
      std::string    exif;

      if (std::memcmp (head, "EXIF", 4))
        {
          file.seekg (std::streamoff (size) + size % 2, std::ios::cur);
          continue;
        }
      exif.resize (std::min (size, most_exif));
      if (file.read (exif.data (), std::streamsize (exif.size ())))
        OIIO::decode_exif (exif, notes);
      break;
    }
  return notes.get_int_attribute ("Orientation", 1);
}

bool
png_is_animated (const std::string &path)
{
  std::ifstream file (path, std::ios::binary);
  unsigned char head[8];

  file.seekg (8);
  while (read_head (file, head) && std::memcmp (head + 4, "IDAT", 4))
    {
      const uint32_t size = uint32_t (head[0]) << 24 | uint32_t (head[1]) << 16 | uint32_t (head[2]) << 8 | head[3];

      if (!std::memcmp (head + 4, "acTL", 4))
        return true;
      file.seekg (std::streamoff (size) + 4, std::ios::cur);
    }
  return false;
}
