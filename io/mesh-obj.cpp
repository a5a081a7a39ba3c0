// Writes meshes as Wavefront OBJ, with material and texture in files beside it: page.obj, page.mtl, page-texture.png.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mesh.hpp"

#include <charconv>

// A line of a word and numbers, with a decimal point in every locale.
static std::string
line_of (const char *word, const float *numbers, size_t n)
{
  std::string line = word;

  for (size_t i = 0; i < n; i++)
    {
      char       text[32];
      const auto end = std::to_chars (text, text + sizeof text, numbers[i], std::chars_format::general, 7).ptr;

      line += " " + std::string (text, end);
    }
  return line + "\n";
}

// The name of a file that belongs to `path`, without spaces, which would end it in these formats.
static std::string
name_beside (const std::string &path, const char *ending)
{
  std::string name = std::filesystem::path (path).stem ().string () + ending;

  for (char &c : name)
    if (c == ' ' || c == '\t')
      c = '_';
  return name;
}

static std::string
place_of (const std::string &path, const std::string &name)
{
  return (std::filesystem::path (path).parent_path () / name).string ();
}

static void
put_vertices (Writer &writer, const CeldReliefMesh &mesh)
{
  for (size_t i = 0; i < mesh.vertices; i++)
    writer.put (line_of ("v", mesh.place + 3 * i, 3));
  for (size_t i = 0; i < mesh.vertices; i++)
    {
      const float art[2] = { mesh.art[2 * i], 1 - mesh.art[2 * i + 1] };

      writer.put (line_of ("vt", art, 2));
    }
  for (size_t i = 0; i < mesh.vertices; i++)
    writer.put (line_of ("vn", mesh.normal + 3 * i, 3));
}

// `first` is the number of the mesh's first vertex, from 1.
static void
put_faces (Writer &writer, const CeldReliefMesh &mesh, size_t first)
{
  for (size_t i = 0; i < mesh.triangles; i++)
    {
      std::string line = "f";

      for (size_t k = 0; k < 3; k++)
        {
          const std::string vertex = std::to_string (first + mesh.corner[3 * i + k]);

          line += " " + vertex + "/" + vertex + "/" + vertex;
        }
      writer.put (line + "\n");
    }
}

std::vector<std::string>
files_beside_obj (const std::string &path)
{
  return { place_of (path, name_beside (path, ".mtl")), place_of (path, name_beside (path, "-texture.png")) };
}

void
write_obj (const std::string &path, const Meshes &meshes, const CeldColours *art)
{
  const std::string material = name_beside (path, ".mtl"), texture = name_beside (path, "-texture.png");
  Writer            object (path), library (place_of (path, material)), picture (place_of (path, texture));
  size_t            first = 1;

  object.put ("# celdepth: a relief in millimetres\nmtllib " + material + "\nusemtl art\n");
  for (const CeldIoMesh &each : meshes)
    {
      object.put (std::string ("o ") + each.name + "\n");
      put_vertices (object, *each.mesh);
      put_faces (object, *each.mesh, first);
      first += each.mesh->vertices;
    }
  object.close ();
  library.put ("# celdepth\nnewmtl art\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\n");
  if (art)
    {
      const Bytes bytes = encode_texture (*art);

      library.put ("map_Kd " + texture + "\n");
      picture.put (bytes.data (), bytes.size ());
    }
  library.close ();
  picture.close ();
  library.commit ();
  if (art)
    picture.commit ();
  object.commit ();
}
