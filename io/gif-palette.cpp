// Chooses 256 colours for all frames of an animation, so that nothing flickers.
//
// Flat colours are kept exactly: those that fill a thousandth of the page in any frame.  The other entries are those of
// a median cut [Hec82] over the other colours of all frames, weighted by their pixels; as in [WWP90] a box is divided at
// its mean along the channel that varies most, and the next one to be divided is that with the largest squared error.
//
//   [Hec82]  P. Heckbert: Color Image Quantization for Frame Buffer Display.  SIGGRAPH 1982.
//   [WWP90]  S. Wan, P. Prusinkiewicz, S. Wong: Variance-Based Color Image Quantization for Frame Buffer Display.
//            Color Research and Application 15(1), 1990.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gif-palette.hpp"

#include <algorithm>
#include <cmath>

constexpr double flat_share = 0.001; // of the page: a colour that fills as much is kept exactly
constexpr size_t most_crowded = 128; // entries kept for flat colours where there are too many of them; chosen
constexpr int    near_enough = 12;   // squared error of a colour that needs no entry of its own, 2 in each channel;
                                     // chosen

static int
squared_distance (Colour a, Colour b)
{
  int sum = 0;

  for (int c = 0; c < 3; c++)
    {
      const int step = channel_of (a, c) - channel_of (b, c);

      sum += step * step;
    }
  return sum;
}

// ------------------------------------------------------------------ counting

void
GifPalette::count (const std::vector<Colour> &frame)
{
  std::vector<Colour> seen;

  for (const Colour colour : frame)
    if (!in_frame[colour]++)
      seen.push_back (colour);
  for (const Colour colour : seen)
    {
      uint32_t &number = use_of[colour];

      if (!number)
        {
          used.push_back ({ colour, 0, 0 });
          number = uint32_t (used.size ());
        }

      Use &use = used[number - 1];

      use.pixels += in_frame[colour];
      use.share = std::max (use.share, double (in_frame[colour]) / double (frame.size ()));
      in_frame[colour] = 0;
    }
}

// ------------------------------------------------------------------ entries

// Makes entries of flat colours and returns the others.  Where flat colours are more than all entries, as in an airbrushed
// picture, the larger ones are kept and some entries left for the others.
std::vector<GifPalette::Use>
GifPalette::keep_flat (const std::vector<Use> &uses)
{
  std::vector<Use> rest;
  double           least = flat_share;
  const auto       is_flat = [&] (const Use &use) { return use.share >= least; };

  if (uses.size () <= most)
    least = 0;
  else if (size_t (std::count_if (uses.begin (), uses.end (), is_flat)) > most)
    while (size_t (std::count_if (uses.begin (), uses.end (), is_flat)) > most_crowded)
      least *= 1.25;
  for (const Use &use : uses)
    if (is_flat (use))
      entry.push_back (use.colour);
    else
      rest.push_back (use);
  return rest;
}

// Some colours, and how far they are from their mean.
struct GifPalette::Box
{
  std::vector<Use> uses;
  double           mean[3] = { 0, 0, 0 }, variance[3] = { 0, 0, 0 }; // variances times pixels

  explicit Box (std::vector<Use> some) : uses (std::move (some))
  {
    double pixels = 0;

    for (const Use &use : uses)
      {
        pixels += use.pixels;
        for (int c = 0; c < 3; c++)
          mean[c] += use.pixels * channel_of (use.colour, c);
      }
    for (double &value : mean)
      value /= pixels;
    for (const Use &use : uses)
      for (int c = 0; c < 3; c++)
        variance[c] += use.pixels * std::pow (channel_of (use.colour, c) - mean[c], 2);
  }

  double error () const { return variance[0] + variance[1] + variance[2]; }

  Colour colour () const
  {
    return Colour (std::lround (mean[0])) << 16 | Colour (std::lround (mean[1])) << 8 | Colour (std::lround (mean[2]));
  }

  // Leaves the colours up to the mean in this box and returns those above.
  Box divide ()
  {
    const int  widest = int (std::max_element (variance, variance + 3) - variance);
    const auto above = std::partition (uses.begin (), uses.end (), [&] (const Use &use) {
      return channel_of (use.colour, widest) <= mean[widest];
    });
    Box        other (std::vector<Use> (above, uses.end ()));

    *this = Box (std::vector<Use> (uses.begin (), above));
    return other;
  }
};

// Fills the palette with the means of boxes; colours that an entry is near enough to take no part.
void
GifPalette::cut (std::vector<Use> rest)
{
  std::vector<Box> boxes;
  const auto       smaller = [] (const Box &a, const Box &b) { return a.error () < b.error (); };
  const auto       is_met = [&] (const Use &use) {
    return !entry.empty () && squared_distance (use.colour, entry[size_t (nearest (use.colour))]) <= near_enough;
  };

  rest.erase (std::remove_if (rest.begin (), rest.end (), is_met), rest.end ());
  if (!rest.empty () && entry.size () < most)
    boxes.emplace_back (std::move (rest));
  while (!boxes.empty () && entry.size () + boxes.size () < most)
    {
      Box &worst = *std::max_element (boxes.begin (), boxes.end (), smaller);

      if (worst.error () <= 0)
        break;

      Box other = worst.divide ();

      boxes.push_back (std::move (other));
    }
  for (const Box &box : boxes)
    entry.push_back (box.colour ());
}

void
GifPalette::choose ()
{
  std::sort (used.begin (), used.end (), [] (const Use &a, const Use &b) { return a.colour < b.colour; });

  std::vector<Use> rest = keep_flat (used);

  used = {};
  cut (std::move (rest));
  index_of = {}; // of the flat colours alone
}

int
GifPalette::nearest (Colour colour)
{
  uint16_t &known = index_of[colour];

  if (!known)
    {
      const auto nearer = [&] (Colour a, Colour b) {
        return squared_distance (a, colour) < squared_distance (b, colour);
      };

      known = uint16_t (std::min_element (entry.begin (), entry.end (), nearer) - entry.begin () + 1);
    }
  return known - 1;
}
