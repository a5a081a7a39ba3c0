// Writes meshes as binary STL: triangles with their normals, in millimetres, z up.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mesh.hpp"

#include <cmath>

static void
put_normal (Writer &writer, const float *const place[3])
{
  float u[3], v[3], normal[3];

  for (size_t k = 0; k < 3; k++)
    {
      u[k] = place[1][k] - place[0][k];
      v[k] = place[2][k] - place[0][k];
    }
  for (size_t k = 0; k < 3; k++)
    normal[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];

  const float length = std::hypot (normal[0], normal[1], normal[2]);

  for (size_t k = 0; k < 3; k++)
    writer.put (length > 0 ? normal[k] / length : 0.f);
}

static void
put_triangles (Writer &writer, const CeldReliefMesh &mesh)
{
  const char attributes[2] = { 0, 0 };

  for (size_t i = 0; i < mesh.triangles; i++)
    {
      const float *place[3];

      for (size_t k = 0; k < 3; k++)
        place[k] = mesh.place + 3 * size_t (mesh.corner[3 * i + k]);
      put_normal (writer, place);
      for (const float *p : place)
        for (size_t k = 0; k < 3; k++)
          writer.put (p[k]);
      writer.put (attributes, sizeof attributes);
    }
}

void
write_stl (const std::string &path, const Meshes &meshes)
{
  Writer       writer (path);
  char         header[80] = "celdepth: binary STL, millimetres"; // must not begin with "solid"
  const size_t triangles = count_triangles (meshes);

  if (triangles > UINT32_MAX)
    throw IoFailure (N_ ("STL files cannot have so many triangles. Allow fewer vertices."));
  writer.put (header, sizeof header);
  writer.put (uint32_t (triangles));
  for (const CeldIoMesh &each : meshes)
    put_triangles (writer, *each.mesh);
  writer.close ();
  writer.commit ();
}
