// Writes meshes as binary PLY: vertices with normals, texture coordinates (v up) and colours; triangles.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mesh.hpp"

#include <algorithm>
#include <cmath>

// The colour of the art on white at a place, by bilinear interpolation.
static void
colour_at (const CeldColours &art, const float *place, unsigned char rgb[3])
{
  const float x = std::clamp (place[0] * float (art.width) - 0.5f, 0.f, float (art.width - 1));
  const float y = std::clamp (place[1] * float (art.height) - 0.5f, 0.f, float (art.height - 1));
  const int   left = int (x), top = int (y);
  float       sum[3] = { 0, 0, 0 };

  for (int k = 0; k < 4; k++)
    {
      const int    u = std::min (left + k % 2, art.width - 1), v = std::min (top + k / 2, art.height - 1);
      const float *from = art.data + 4 * (size_t (v) * art.stride + size_t (u));
      const float  across = x - float (left), down = y - float (top);
      const float  weight = (k % 2 ? across : 1 - across) * (k / 2 ? down : 1 - down);

      for (size_t i = 0; i < 3; i++)
        sum[i] += weight * (from[i] * from[3] + 1 - from[3]);
    }
  for (size_t i = 0; i < 3; i++)
    rgb[i] = static_cast<unsigned char> (std::lround (255 * std::clamp (sum[i], 0.f, 1.f)));
}

static void
put_vertices (Writer &writer, const CeldReliefMesh &mesh, const CeldColours *art)
{
  for (size_t i = 0; i < mesh.vertices; i++)
    {
      unsigned char rgb[3] = { 255, 255, 255 };

      for (size_t k = 0; k < 3; k++)
        writer.put (mesh.place[3 * i + k]);
      for (size_t k = 0; k < 3; k++)
        writer.put (mesh.normal[3 * i + k]);
      writer.put (mesh.art[2 * i]);
      writer.put (1 - mesh.art[2 * i + 1]);
      if (art)
        colour_at (*art, mesh.art + 2 * i, rgb);
      writer.put (rgb, sizeof rgb);
    }
}

// `first` is the number of the mesh's first vertex.
static void
put_faces (Writer &writer, const CeldReliefMesh &mesh, uint32_t first)
{
  for (size_t i = 0; i < mesh.triangles; i++)
    {
      const unsigned char three = 3;

      writer.put (&three, 1);
      for (size_t k = 0; k < 3; k++)
        writer.put (first + mesh.corner[3 * i + k]);
    }
}

void
write_ply (const std::string &path, const Meshes &meshes, const CeldColours *art)
{
  Writer       writer (path);
  const size_t vertices = count_vertices (meshes);
  uint32_t     first = 0;
  std::string  header = "ply\nformat binary_little_endian 1.0\ncomment celdepth: a relief in millimetres\n"
                        "element vertex " + std::to_string (vertices) + "\n";

  if (vertices > INT32_MAX)
    throw IoFailure (N_ ("PLY files cannot have so many vertices. Allow fewer vertices."));
  for (const char *name : { "x", "y", "z", "nx", "ny", "nz", "s", "t" })
    header += std::string ("property float ") + name + "\n";
  for (const char *name : { "red", "green", "blue" })
    header += std::string ("property uchar ") + name + "\n";
  header += "element face " + std::to_string (count_triangles (meshes)) + "\n";
  header += "property list uchar int vertex_indices\nend_header\n";
  writer.put (header);
  for (const CeldIoMesh &each : meshes)
    put_vertices (writer, *each.mesh, art);
  for (const CeldIoMesh &each : meshes)
    {
      put_faces (writer, *each.mesh, first);
      first += uint32_t (each.mesh->vertices);
    }
  writer.close ();
  writer.commit ();
}
