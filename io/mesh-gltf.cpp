// Writes meshes as binary glTF 2.0 (ISO/IEC 12113): a chunk of JSON, and one of vertices, triangles and a PNG texture.
//
// In metres, y up, with the picture upright in front of the viewer.  The material is the art, without gloss.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "json.hpp"
#include "mesh.hpp"

#include <algorithm>
#include <memory>

constexpr uint32_t magic = 0x46546c67, version = 2, json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
constexpr gint64   float_numbers = 5126, unsigned_numbers = 5125, vertex_data = 34962, index_data = 34963;
constexpr gint64   linear = 9729, linear_mipmaps = 9987, clamp_to_edge = 33071;
constexpr float    metres = 0.001f; // a millimetre

// Offsets in the binary chunk, in bytes: all meshes' places, then all their normals, and so on.
struct Layout
{
  size_t place, normal, art, corner, texture, end;
};

static size_t
round_up (size_t n)
{
  return (n + 3) / 4 * 4;
}

static Layout
layout_of (const Meshes &meshes, size_t texture)
{
  const size_t vertices = count_vertices (meshes);
  Layout       l = { 0, 12 * vertices, 24 * vertices, 32 * vertices, 0, 0 };

  l.texture = l.corner + 12 * count_triangles (meshes);
  l.end     = round_up (l.texture + texture);
  return l;
}

static void
add_view (Json &json, size_t from, size_t end, gint64 target, size_t stride)
{
  json.object (nullptr, [&] {
    json.number ("buffer", 0);
    json.number ("byteOffset", gint64 (from));
    json.number ("byteLength", gint64 (end - from));
    if (stride)
      json.number ("byteStride", gint64 (stride));
    if (target)
      json.number ("target", target);
  });
}

static void
add_accessor (Json &json, gint64 view, size_t offset, gint64 component, size_t count, const char *type)
{
  json.number ("bufferView", view);
  json.number ("byteOffset", gint64 (offset));
  json.number ("componentType", component);
  json.number ("count", gint64 (count));
  json.text ("type", type);
}

// The bounding box of all vertices, in metres, with the rounding of the stored numbers.
static void
add_bounds (Json &json, const CeldReliefMesh &mesh)
{
  float low[3], high[3];

  for (size_t k = 0; k < 3; k++)
    {
      low[k] = high[k] = metres * mesh.place[k];
      for (size_t i = 1; i < mesh.vertices; i++)
        {
          low[k]  = std::min (low[k], metres * mesh.place[3 * i + k]);
          high[k] = std::max (high[k], metres * mesh.place[3 * i + k]);
        }
    }
  json.list ("min", [&] {
    for (float value : low)
      json.real (nullptr, double (value));
  });
  json.list ("max", [&] {
    for (float value : high)
      json.real (nullptr, double (value));
  });
}

// The accessors of a mesh whose first vertex and first triangle have these numbers.
static void
add_accessors (Json &json, const CeldReliefMesh &mesh, size_t vertex, size_t triangle)
{
  json.object (nullptr, [&] {
    add_accessor (json, 0, 12 * vertex, float_numbers, mesh.vertices, "VEC3");
    add_bounds (json, mesh);
  });
  json.object (nullptr, [&] { add_accessor (json, 1, 12 * vertex, float_numbers, mesh.vertices, "VEC3"); });
  json.object (nullptr, [&] { add_accessor (json, 2, 8 * vertex, float_numbers, mesh.vertices, "VEC2"); });
  json.object (nullptr,
               [&] { add_accessor (json, 3, 12 * triangle, unsigned_numbers, 3 * mesh.triangles, "SCALAR"); });
}

static void
add_buffers (Json &json, const Meshes &meshes, const Layout &l, size_t texture)
{
  json.list ("buffers", [&] { json.object (nullptr, [&] { json.number ("byteLength", gint64 (l.end)); }); });
  json.list ("bufferViews", [&] {
    add_view (json, l.place, l.normal, vertex_data, 12);
    add_view (json, l.normal, l.art, vertex_data, 12);
    add_view (json, l.art, l.corner, vertex_data, 8);
    add_view (json, l.corner, l.texture, index_data, 0);
    if (texture)
      add_view (json, l.texture, l.texture + texture, 0, 0);
  });
  json.list ("accessors", [&] {
    size_t vertex = 0, triangle = 0;

    for (const CeldIoMesh &each : meshes)
      {
        add_accessors (json, *each.mesh, vertex, triangle);
        vertex += each.mesh->vertices;
        triangle += each.mesh->triangles;
      }
  });
}

static void
add_material (Json &json, bool texture)
{
  json.list ("materials", [&] {
    json.object (nullptr, [&] {
      json.text ("name", "art");
      json.object ("pbrMetallicRoughness", [&] {
        if (texture)
          json.object ("baseColorTexture", [&] { json.number ("index", 0); });
        json.number ("metallicFactor", 0);
        json.number ("roughnessFactor", 1);
      });
      json.truth ("doubleSided", true);
    });
  });
  if (!texture)
    return;
  json.list ("textures", [&] {
    json.object (nullptr, [&] {
      json.number ("sampler", 0);
      json.number ("source", 0);
    });
  });
  json.list ("samplers", [&] {
    json.object (nullptr, [&] {
      json.number ("magFilter", linear);
      json.number ("minFilter", linear_mipmaps);
      json.number ("wrapS", clamp_to_edge);
      json.number ("wrapT", clamp_to_edge);
    });
  });
  json.list ("images", [&] {
    json.object (nullptr, [&] {
      json.number ("bufferView", 4);
      json.text ("mimeType", "image/png");
    });
  });
}

// A node for each mesh.
static void
add_nodes (Json &json, const Meshes &meshes)
{
  json.number ("scene", 0);
  json.list ("scenes", [&] {
    json.object (nullptr, [&] {
      json.list ("nodes", [&] {
        for (size_t k = 0; k < meshes.size (); k++)
          json.number (nullptr, gint64 (k));
      });
    });
  });
  json.list ("nodes", [&] {
    for (size_t k = 0; k < meshes.size (); k++)
      json.object (nullptr, [&] {
        json.text ("name", meshes[k].name);
        json.number ("mesh", gint64 (k));
      });
  });
}

static void
add_meshes (Json &json, const Meshes &meshes)
{
  json.list ("meshes", [&] {
    for (size_t k = 0; k < meshes.size (); k++)
      json.object (nullptr, [&] {
        json.text ("name", meshes[k].name);
        json.list ("primitives", [&] {
          json.object (nullptr, [&] {
            json.object ("attributes", [&] {
              json.number ("POSITION", gint64 (4 * k));
              json.number ("NORMAL", gint64 (4 * k + 1));
              json.number ("TEXCOORD_0", gint64 (4 * k + 2));
            });
            json.number ("indices", gint64 (4 * k + 3));
            json.number ("material", 0);
          });
        });
      });
  });
}

static std::string
describe (const Meshes &meshes, const Layout &l, size_t texture)
{
  Json json;

  json.object ("asset", [&] {
    json.text ("version", "2.0");
    json.text ("generator", "celdepth");
  });
  add_nodes (json, meshes);
  add_meshes (json, meshes);
  add_material (json, texture > 0);
  add_buffers (json, meshes, l, texture);
  return json.end ();
}

// ------------------------------------------------------------------ the file

static void
put_numbers (Writer &writer, const Meshes &meshes)
{
  for (const CeldIoMesh &each : meshes)
    for (size_t i = 0; i < 3 * each.mesh->vertices; i++)
      writer.put (metres * each.mesh->place[i]);
  for (const CeldIoMesh &each : meshes)
    for (size_t i = 0; i < 3 * each.mesh->vertices; i++)
      writer.put (each.mesh->normal[i]);
  for (const CeldIoMesh &each : meshes)
    for (size_t i = 0; i < 2 * each.mesh->vertices; i++)
      writer.put (each.mesh->art[i]);
  for (const CeldIoMesh &each : meshes)
    for (size_t i = 0; i < 3 * each.mesh->triangles; i++)
      writer.put (each.mesh->corner[i]);
}

void
write_gltf (const std::string &path, const Meshes &meshes, const CeldColours *art)
{
  const Bytes  texture = art ? encode_texture (*art) : Bytes ();
  const Layout l = layout_of (meshes, texture.size ());
  std::string  json = describe (meshes, l, texture.size ());
  Writer       writer (path);

  json.append (round_up (json.size ()) - json.size (), ' ');
  if (l.end > UINT32_MAX - json.size () - 28)
    throw IoFailure (N_ ("it would be larger than 4 GB. Allow fewer vertices."));
  for (uint32_t number : { magic, version, uint32_t (28 + json.size () + l.end), uint32_t (json.size ()), json_chunk })
    writer.put (number);
  writer.put (json);
  writer.put (uint32_t (l.end));
  writer.put (binary_chunk);
  put_numbers (writer, meshes);
  writer.put (texture.data (), texture.size ());
  writer.put (std::string (l.end - l.texture - texture.size (), '\0'));
  writer.close ();
  writer.commit ();
}
