// Shared by reading and writing: errors as sentences, exceptions caught before they reach C, files complete or not
// there.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_IO_HPP
#define CELDEPTH_IO_HPP

#include "celdepth-io.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <strings.h>
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

// What the system says of an error, as a sentence.
inline std::string
system_reason (int code)
{
  return std::string (std::strerror (code)) + ".";
}

// Whether a file could not grow.  Libraries that write say that in many ways, and repeat the name.
inline bool
is_full (int code)
{
  return code == ENOSPC || code == EDQUOT || code == EFBIG;
}

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
  catch (const std::filesystem::filesystem_error &failure)
    {
      why = system_reason (failure.code ().value ());
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

  errno = 0;
  if (succeeds (why, work))
    return true;
  if (is_full (errno))
    why = system_reason (errno);
  std::snprintf (error->text, sizeof error->text, "%s%s", what.c_str (), why.c_str ());
  error->reason = std::min (what.size (), std::strlen (error->text));
  return false;
}

extern const CeldIoKeeper *celd_io_keeper; // NULL: none

// A file or folder that is being written, under a temporary name that commit () changes to the final one, or
// the keeper later.  Without
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
    if (std::filesystem::exists (final) && folder && !std::filesystem::is_empty (final) &&
        !(celd_io_keeper && celd_io_keeper->owns (final.c_str ())))
      throw IoFailure ("it is a folder that is not empty.");
    if (std::filesystem::exists (final) && !folder && !std::filesystem::is_regular_file (final))
      throw IoFailure (N_ ("it is not an ordinary file."));
    temporary = final;
    temporary += ".new-" + std::to_string (getpid ());
    if (folder)
      std::filesystem::create_directory (temporary);
    else
      make_file ();
  }

  ~NewFile ()
  {
    const int       reason = errno; // why writing has failed
    std::error_code ignored;

    if (!committed)
      std::filesystem::remove_all (temporary, ignored);
    errno = reason;
  }

  NewFile (const NewFile &) = delete;
  NewFile &operator= (const NewFile &) = delete;

  std::string name () const { return temporary.string (); }
  void
  commit ()
  {
    if (is_full (errno) || is_cut_png ()) // libraries do not always notice that the last bytes were not written
      throw IoFailure (N_ ("there is not enough space for it."));
    if (!celd_io_keeper)
      std::filesystem::rename (temporary, final);
    else if (!celd_io_keeper->complete (temporary.c_str (), final.c_str ()))
      throw IoFailure (system_reason (errno));
    committed = true;
  }

private:
  // Whether the end of a PNG is missing.
  bool
  is_cut_png () const
  {
    constexpr char end[] = "IEND\xae\x42\x60\x82";
    char           last[8] = "";
    std::ifstream  file;

    if (strcasecmp (final.extension ().c_str (), ".png") || std::filesystem::is_directory (temporary))
      return false;
    file.open (temporary, std::ios::binary);
    file.seekg (-std::streamoff (sizeof last), std::ios::end);
    file.read (last, sizeof last);
    return !file || std::memcmp (last, end, sizeof last);
  }

  // So that what the system refuses is said in its words, whatever library writes the file.
  void
  make_file () const
  {
    const int descriptor = open (temporary.c_str (), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);

    if (descriptor < 0)
      throw IoFailure (system_reason (errno));
    ::close (descriptor);
  }

  std::filesystem::path final, temporary;
  bool                  committed = false;
};

#endif
