// Shared by files of one picture or several, as OpenImageIO writes them.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_WRITE_PARTS_HPP
#define CELDEPTH_WRITE_PARTS_HPP

#include "celdepth-io.hpp"

#include <OpenImageIO/imageio.h>

#include <memory>
#include <vector>

// Writes a file whose parts have these headers; several if the format can have them.  write_part (output, i) writes the
// pixels of part i.
template <typename WritePart>
void
write_parts (const std::string &path, const char *format, const std::vector<OIIO::ImageSpec> &specs, WritePart write_part)
{
  NewFile file (path);
  auto    output = OIIO::ImageOutput::create (format);

  if (!output)
    throw IoFailure (OIIO::geterror ());
  for (size_t i = 0; i < specs.size (); i++)
    {
      bool good = i ? output->open (file.name (), specs[i], OIIO::ImageOutput::AppendSubimage) :
                      output->open (file.name (), int (specs.size ()), specs.data ());

      if (!good)
        throw IoFailure (output->geterror ());
      write_part (*output, i);
    }
  if (!output->close ())
    throw IoFailure (output->geterror ());
  output.reset ();
  file.commit ();
}

#endif
