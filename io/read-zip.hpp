// Entries of a zip file, read as streams.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_READ_ZIP_HPP
#define CELDEPTH_READ_ZIP_HPP

#include <OpenImageIO/filesystem.h>

#include <string>

#include <zip.h>

// Whether the file begins as a zip with an entry does.
bool is_zip (const std::string &path);

class ZipFile
{
public:
  explicit ZipFile (const std::string &path); // throws an IoFailure
  ~ZipFile ();
  ZipFile (const ZipFile &) = delete;
  ZipFile &operator= (const ZipFile &) = delete;

  bool has (const std::string &entry) const;

  // The bytes of a small entry.  Throws an IoFailure if it is missing, damaged, or larger than `longest`.
  std::string bytes (const std::string &entry, size_t longest) const;

private:
  friend class ZipStream;

  zip_t *zip;
};

// The bytes of an entry, which are decompressed as they are read, so that no size in the file makes it need memory.
// Reading backwards begins again.  The zip must outlive the stream.
class ZipStream : public OIIO::Filesystem::IOProxy
{
public:
  ZipStream (const ZipFile &zip, const std::string &entry); // throws an IoFailure
  ~ZipStream () override;
  ZipStream (const ZipStream &) = delete;
  ZipStream &operator= (const ZipStream &) = delete;

  const char *proxytype () const override { return "zip"; }
  bool        seek (int64_t offset) override;
  size_t      read (void *bytes, size_t count) override; // fewer at the end, or where the entry is damaged
  size_t      pread (void *bytes, size_t count, int64_t offset) override;
  size_t      size () const override { return length; }

private:
  zip_t       *zip;
  zip_uint64_t index;
  zip_file_t  *entry;
  size_t       length;
};

#endif
