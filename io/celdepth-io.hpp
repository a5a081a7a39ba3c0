// Shared by reading and writing: errors as sentences, exceptions caught before they reach C, files complete or not
// there.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_IO_HPP
#define CELDEPTH_IO_HPP

#include "celdepth-io.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

#include <unistd.h>

// Attributes of headers from which the original values of stored numbers are computed.
constexpr const char *note_farthest = "celdepth:farthest";
constexpr const char *note_nearest  = "celdepth:nearest";

#define N_(text) text // one that hosts translate, for xgettext

// Its text is the part of a sentence that follows "Cannot read NAME: ".
struct IoFailure : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

// The transfer function of sRGB, IEC 61966-2-1.
float encode_srgb (float value);

// Does the work; false, with the reason, if it throws.
template <typename Work>
bool
succeeds (std::string &why, Work work)
{
  try
    {
      work ();
      return true;
    }
  catch (const std::bad_alloc &)
    {
      why = N_ ("there is not enough memory.");
    }
  catch (const std::exception &exception)
    {
      why = exception.what ();
    }
  catch (...)
    {
      why = N_ ("an unknown error occurred.");
    }
  while (!why.empty () && (why.back () == '\n' || why.back () == ' '))
    why.pop_back ();
  std::replace (why.begin (), why.end (), '\n', ' ');
  return false;
}

// Does the work; if it throws, false with a sentence like: Cannot read "page.psd": it is damaged.
template <typename Work>
bool
guarded (const char *verb, const std::string &path, CeldIoError *error, Work work)
{
  const std::string what = std::string ("Cannot ") + verb + " \"" + path + "\": ";
  std::string       why;

  if (succeeds (why, work))
    return true;
  std::snprintf (error->text, sizeof error->text, "%s%s", what.c_str (), why.c_str ());
  error->reason = std::min (what.size (), std::strlen (error->text));
  return false;
}

// A file or folder that is being written, under a temporary name that commit () changes to the final one.  Without
// commit () the destructor deletes it.
class NewFile
{
public:
  explicit NewFile (const std::string &path, bool folder = false)
    : final (std::filesystem::weakly_canonical (path))
  {
    if (!final.has_filename ()) // "folder/"
      final = final.parent_path ();
    if (std::filesystem::exists (final) && folder && !std::filesystem::is_directory (final))
      throw IoFailure ("it is not a folder.");
    if (std::filesystem::exists (final) && folder && !std::filesystem::is_empty (final))
      throw IoFailure ("it is a folder that is not empty.");
    if (std::filesystem::exists (final) && !folder && !std::filesystem::is_regular_file (final))
      throw IoFailure (N_ ("it is not an ordinary file."));
    temporary = final;
    temporary += ".new-" + std::to_string (getpid ());
    if (folder)
      std::filesystem::create_directory (temporary);
  }

  ~NewFile ()
  {
    std::error_code ignored;

    std::filesystem::remove_all (temporary, ignored);
  }

  NewFile (const NewFile &) = delete;
  NewFile &operator= (const NewFile &) = delete;

  std::string name () const { return temporary.string (); }
  void        commit () { std::filesystem::rename (temporary, final); }

private:
  std::filesystem::path final, temporary;
};

#endif
