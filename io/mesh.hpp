// Shared by the formats of meshes: writing bytes to a file.
//
//   mesh-gltf.cpp   glTF 2.0, binary          mesh-ply.cpp   PLY, binary
//   mesh-obj.cpp    Wavefront OBJ and MTL     mesh-stl.cpp   STL, binary
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_MESH_HPP
#define CELDEPTH_MESH_HPP

#include "layers.hpp"

#include <cstdint>
#include <cstring>
#include <fstream>

// A file that is being written; numbers are written with the low byte first.
class Writer
{
public:
  explicit Writer (const std::string &path)
    : file (path), stream (file.name (), std::ios::binary)
  {
  }

  void
  put (const void *bytes, size_t n)
  {
    stream.write (static_cast<const char *> (bytes), std::streamsize (n));
  }

  void put (const std::string &text) { put (text.data (), text.size ()); }

  void
  put (uint32_t number)
  {
    const unsigned char bytes[4] = { static_cast<unsigned char> (number), static_cast<unsigned char> (number >> 8),
                                     static_cast<unsigned char> (number >> 16),
                                     static_cast<unsigned char> (number >> 24) };

    put (bytes, 4);
  }

  void
  put (float number)
  {
    uint32_t bits;

    std::memcpy (&bits, &number, sizeof bits);
    put (bits);
  }

  // Completes the file, which keeps its temporary name until commit ().
  void
  close ()
  {
    stream.close ();
    if (!stream)
      throw IoFailure (N_ ("there is not enough space for it."));
  }

  void commit () { file.commit (); }

private:
  NewFile       file;
  std::ofstream stream;
};

using Meshes = std::vector<CeldIoMesh>;

size_t count_vertices (const Meshes &meshes);
size_t count_triangles (const Meshes &meshes);

// Write a file of their format; art NULL: white, without a texture.
void write_gltf (const std::string &path, const Meshes &meshes, const CeldColours *art);
void write_obj (const std::string &path, const Meshes &meshes, const CeldColours *art);
void write_ply (const std::string &path, const Meshes &meshes, const CeldColours *art);
void write_stl (const std::string &path, const Meshes &meshes);

// The files that write_obj makes beside that of the path.
std::vector<std::string> files_beside_obj (const std::string &path);

// The art on white, as an opaque PNG.
Bytes encode_texture (const CeldColours &art);

#endif
