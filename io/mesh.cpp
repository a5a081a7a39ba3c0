// Writes meshes in the format that the name's ending chooses.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mesh.hpp"

Bytes
encode_texture (const CeldColours &art)
{
  const size_t       w = size_t (art.width);
  std::vector<float> rgba (4 * w * size_t (art.height));

  for (size_t i = 0; i < rgba.size () / 4; i++)
    {
      const float *from = art.data + 4 * (i / w * art.stride + i % w);

      for (size_t k = 0; k < 3; k++)
        rgba[4 * i + k] = from[k] * from[3] + 1 - from[3];
      rgba[4 * i + 3] = 1;
    }
  return encode_png (art.width, art.height, rgba.data ());
}

size_t
count_vertices (const Meshes &meshes)
{
  size_t n = 0;

  for (const CeldIoMesh &each : meshes)
    n += each.mesh->vertices;
  return n;
}

size_t
count_triangles (const Meshes &meshes)
{
  size_t n = 0;

  for (const CeldIoMesh &each : meshes)
    n += each.mesh->triangles;
  return n;
}

static void
write_meshes (const std::string &path, const Meshes &meshes, const CeldColours *art)
{
  switch (celd_io_mesh_kind (path.c_str ()))
    {
    case CELD_IO_GLB:
      return write_gltf (path, meshes, art);
    case CELD_IO_OBJ:
      return write_obj (path, meshes, art);
    case CELD_IO_PLY:
      return write_ply (path, meshes, art);
    case CELD_IO_STL:
      return write_stl (path, meshes);
    case CELD_IO_NO_MESH:
      break;
    }
  throw IoFailure ("its name must end in .glb, .obj, .ply or .stl.");
}

// ------------------------------------------------------------------ the C functions

void
celd_io_mesh_files (const char *path, void (*take) (void *host, const char *name), void *host)
{
  CeldIoError ignored;

  take (host, path);
  guarded ("write", path, &ignored, [&] {
    if (celd_io_mesh_kind (path) == CELD_IO_OBJ)
      for (const std::string &beside : files_beside_obj (path))
        take (host, beside.c_str ());
  });
}

bool
celd_io_write_meshes (const char *path, const CeldIoMesh *mesh, size_t n, const CeldColours *art, CeldIoError *error)
{
  return guarded ("write", path, error, [&] { write_meshes (path, Meshes (mesh, mesh + n), art); });
}
