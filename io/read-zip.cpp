// Reads entries of zip files by libzip.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-zip.hpp"

#include "celdepth-io.hpp"

#include <cstring>
#include <fstream>

bool
is_zip (const std::string &path)
{
  char first[4] = {};

  std::ifstream (path, std::ios::binary).read (first, sizeof first);
  return !std::memcmp (first, "PK\3\4", sizeof first);
}

// ------------------------------------------------------------------ the file

ZipFile::ZipFile (const std::string &path)
{
  int code = 0;

  zip = zip_open (path.c_str (), ZIP_RDONLY, &code);
  if (!zip)
    throw IoFailure (code == ZIP_ER_MEMORY ? "there is not enough memory." : "it is a damaged or truncated zip file.");
}

ZipFile::~ZipFile ()
{
  zip_discard (zip);
}

bool
ZipFile::has (const std::string &entry) const
{
  return zip_name_locate (zip, entry.c_str (), 0) >= 0;
}

std::string
ZipFile::bytes (const std::string &entry, size_t longest) const
{
  ZipStream   stream (*this, entry);
  std::string bytes;

  if (stream.size () > longest)
    throw IoFailure ("its " + entry + " is too large.");
  bytes.resize (stream.size ());
  if (stream.read (bytes.data (), bytes.size ()) < bytes.size ())
    throw IoFailure ("its " + entry + " is damaged.");
  return bytes;
}

// ------------------------------------------------------------------ an entry

ZipStream::ZipStream (const ZipFile &file, const std::string &name)
    : IOProxy (name, Read), zip (file.zip)
{
  const zip_int64_t found = zip_name_locate (zip, name.c_str (), 0);
  zip_stat_t        about;

  if (found < 0)
    throw IoFailure ("it has no " + name + ".");
  index = zip_uint64_t (found);
  entry = zip_fopen_index (zip, index, 0);
  if (!entry)
    throw IoFailure ("its " + name + " cannot be read: it is damaged, encrypted, or compressed in an unusual way.");
  length = zip_stat_index (zip, index, 0, &about) || !(about.valid & ZIP_STAT_SIZE) ? 0 : size_t (about.size);
}

ZipStream::~ZipStream ()
{
  if (entry)
    zip_fclose (entry);
}

bool
ZipStream::seek (int64_t offset)
{
  char skipped[4096];

  if (offset < m_pos)
    {
      if (entry)
        zip_fclose (entry);
      entry = zip_fopen_index (zip, index, 0);
      m_pos = 0;
    }
  while (m_pos < offset)
    if (!read (skipped, size_t (std::min<int64_t> (offset - m_pos, sizeof skipped))))
      return false;
  return entry != nullptr;
}

size_t
ZipStream::read (void *bytes, size_t count)
{
  size_t done = 0;

  while (entry && done < count)
    {
      const zip_int64_t got = zip_fread (entry, static_cast<char *> (bytes) + done, count - done);

      if (got <= 0)
        break;
      done += size_t (got);
      m_pos += got;
    }
  return done;
}

size_t
ZipStream::pread (void *bytes, size_t count, int64_t offset)
{
  const int64_t before = m_pos;
  const size_t  got    = seek (offset) ? read (bytes, count) : 0;

  seek (before);
  return got;
}
