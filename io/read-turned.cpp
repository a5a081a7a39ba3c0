// A photograph that was taken with the camera turned: its pixels are stored as the sensor has them, and how they are to
// be shown is noted beside them (the tag Orientation of Exif 2.3, section 4.6.4: 1 to 8).
//
// Every viewer and editor turns them, so that layers painted over such a picture have its size when turned.
//
// Cost: the memory of the whole picture, as floats, while it is read.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-file.hpp"

#include <algorithm>
#include <utility>

namespace
{

class TurnedFile : public PictureFile
{
public:
  TurnedFile (std::unique_ptr<PictureFile> stored_file, int noted)
      : stored (std::move (stored_file)), orientation (noted)
  {
    parts  = stored->parts;
    size   = stored->size;
    width  = orientation > 4 ? stored->height : stored->width;
    height = orientation > 4 ? stored->width : stored->height;
  }

  uint64_t
  decoding_memory (size_t part) const override
  {
    return stored->decoding_memory (part) + uint64_t (width) * uint64_t (height) * 4 * sizeof (float);
  }

  std::string profile (size_t part) const override { return stored->profile (part); }

  CeldRect
  place (size_t part) const override
  {
    const CeldRect r = stored->place (part);

    if (r.width != stored->width || r.height != stored->height)
      throw IoFailure ("it is turned, and covers its page in part only.");
    return { 0, 0, width, height };
  }

  void
  read_colours (size_t part, const TakeRows &take) override
  {
    read (part, 4, take, &PictureFile::read_colours);
  }

  void
  read_values (size_t part, const TakeRows &take) override
  {
    read (part, 1, take, &PictureFile::read_values);
  }

private:
  std::unique_ptr<PictureFile> stored;
  int                          orientation;

  // The stored pixel that is shown at (x,y).
  size_t
  stored_pixel (int x, int y) const
  {
    const int  across = orientation > 4 ? y : x, down = orientation > 4 ? x : y;
    const bool right_to_left = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    const bool bottom_to_top = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    const int  u = right_to_left ? stored->width - 1 - across : across;
    const int  v = bottom_to_top ? stored->height - 1 - down : down;

    return size_t (v) * size_t (stored->width) + size_t (u);
  }

  void
  read (size_t part, size_t floats, const TakeRows &take, void (PictureFile::*read_rows) (size_t, const TakeRows &))
  {
    std::vector<float> picture, row (size_t (width) * floats);

    place (part);
    picture.reserve (size_t (width) * size_t (height) * floats);
    (stored.get ()->*read_rows) (part, [&] (const float *rows, int count) {
      picture.insert (picture.end (), rows, rows + size_t (count) * size_t (stored->width) * floats);
    });
    for (int y = 0; y < height; y++)
      {
        for (int x = 0; x < width; x++)
          std::copy_n (picture.data () + stored_pixel (x, y) * floats, floats, row.data () + size_t (x) * floats);
        take (row.data (), 1);
      }
  }
};

}

std::unique_ptr<PictureFile>
turned (std::unique_ptr<PictureFile> file, int orientation)
{
  if (orientation < 2 || orientation > 8)
    return file;
  return std::make_unique<TurnedFile> (std::move (file), orientation);
}
