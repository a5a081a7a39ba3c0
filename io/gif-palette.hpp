// The palette of all frames of an animation, and the nearest entry of each colour.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_GIF_PALETTE_HPP
#define CELDEPTH_GIF_PALETTE_HPP

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

// Colours of 8 bits as 0xRRGGBB.
using Colour = uint32_t;

inline int
channel_of (Colour colour, int channel)
{
  return int (colour >> (16 - 8 * channel) & 255);
}

// A number for each of the 2^24 colours, first 0.  Pages of memory are taken only where colours are used.
template <typename Number>
class ColourTable
{
public:
  ColourTable () : number (static_cast<Number *> (std::calloc (size_t (1) << 24, sizeof (Number))))
  {
    if (!number)
      throw std::bad_alloc ();
  }

  Number &operator[] (Colour colour) { return number.get ()[colour]; }

private:
  struct Free
  {
    void operator() (Number *memory) const { std::free (memory); }
  };

  std::unique_ptr<Number, Free> number;
};

class GifPalette
{
public:
  static constexpr size_t most = 256;

  // Counts the colours of a frame.
  void count (const std::vector<Colour> &frame);
  // Chooses the entries, when all frames have been counted.
  void choose ();

  const std::vector<Colour> &entries () const { return entry; }
  // Index of the nearest entry.
  int nearest (Colour colour);

private:
  struct Use
  {
    Colour colour;
    double pixels;                 // of all frames
    double share;                  // of the page, in the frame that has most of it
  };
  struct Box;

  std::vector<Use> keep_flat (const std::vector<Use> &uses);
  void             cut (std::vector<Use> rest);

  ColourTable<uint32_t>  in_frame; // pixels
  ColourTable<uint32_t>  use_of;   // 1 + index into `used`
  ColourTable<uint16_t>  index_of; // 1 + the nearest entry, as far as it is known
  std::vector<Use>       used;
  std::vector<Colour>    entry;
};

#endif
