// What reading and writing share: errors as sentences, and no exception that leaves for C.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_IO_HPP
#define CELDEPTH_IO_HPP

#include "celdepth-io.h"

#include <algorithm>
#include <cstdio>
#include <new>
#include <stdexcept>
#include <string>

// Header notes that turn stored numbers back into the values that were given.
constexpr const char *note_farthest = "celdepth:farthest";
constexpr const char *note_nearest  = "celdepth:nearest";

// What is wrong; the sentence round it names the file.
struct IoFailure : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

// Does the work; turns whatever it throws into the sentence "Cannot read "page.psd": ...".
template <typename Work>
bool
guarded (const char *verb, const std::string &path, CeldIoError *error, Work work)
{
  std::string why;

  try
    {
      work ();
      return true;
    }
  catch (const std::bad_alloc &)
    {
      why = "there is not enough memory.";
    }
  catch (const std::exception &exception)
    {
      why = exception.what ();
    }
  catch (...)
    {
      why = "an unknown error happened.";
    }
  while (!why.empty () && (why.back () == '\n' || why.back () == ' '))
    why.pop_back ();
  std::replace (why.begin (), why.end (), '\n', ' ');
  std::snprintf (error->text, sizeof error->text, "Cannot %s \"%s\": %s", verb, path.c_str (), why.c_str ());
  return false;
}

#endif
