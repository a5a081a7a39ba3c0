// Kinds of files that are taken for pictures and cannot be read, by the bytes that they begin with: what to do is said
// of each.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-file.hpp"

#include <algorithm>
#include <fstream>

constexpr size_t most_start = 512; // bytes that are looked at (chosen)

struct OtherKind
{
  const char *start;
  size_t      at; // where it is
  const char *what;
};

// HEIC and AVIF are read where OpenImageIO can.
constexpr OtherKind kinds[] = {
  { "gimp xcf", 0, "it is an XCF, which cannot be read. Save it as ORA or PSD." },
  { "CSFCHUNK", 0, "it is a document of Clip Studio Paint, which cannot be read. Save it as PSD." },
  { "SAI-CANVAS", 0, "it is a document of SAI, which cannot be read. Save it as PSD." },
  { "%PDF", 0, "it is a PDF, which cannot be read. Save it as PNG." },
  { "ftyphei", 4, "it is damaged, or a HEIC, which cannot be read here. Save it as PNG or JPEG." },
  { "ftypmif1", 4, "it is damaged, or a HEIC, which cannot be read here. Save it as PNG or JPEG." },
  { "ftypavif", 4, "it is damaged, or an AVIF, which cannot be read here. Save it as PNG or JPEG." },
};

static bool
is_text (const std::string &start)
{
  return std::all_of (start.begin (), start.end (), [] (unsigned char byte) {
    return byte >= ' ' || byte == '\t' || byte == '\n' || byte == '\r';
  });
}

std::string
unreadable_reason (const std::string &path)
{
  std::string   start (most_start, '\0');
  std::ifstream file (path, std::ios::binary);

  file.read (start.data (), std::streamsize (start.size ()));
  start.resize (size_t (file.gcount ()));
  if (start.empty ())
    return "it is empty.";
  for (const OtherKind &kind : kinds)
    if (start.compare (std::min (kind.at, start.size ()), std::char_traits<char>::length (kind.start), kind.start) == 0)
      return kind.what;
  if (is_text (start))
    return start.find ("<svg") != std::string::npos ? "it is an SVG, which cannot be read. Save it as PNG."
                                                    : "it is a text and no picture.";
  return "it is damaged, or of a format that cannot be read. PNG, JPEG, TIFF, EXR, PSD, ORA, KRA, WebP, GIF and JPEG "
         "2000 can be read; save XCF as ORA or PSD.";
}
