// Writes meshes as binary glTF 2.0 (ISO/IEC 12113): a chunk of JSON, and one of vertices, triangles and a PNG texture.
//
// In metres, y up, with the picture upright in front of the viewer.  The material is the art, without gloss.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mesh.hpp"

#include <json-glib/json-glib.h>

#include <algorithm>
#include <memory>

constexpr uint32_t magic = 0x46546c67, version = 2, json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
constexpr gint64   float_numbers = 5126, unsigned_numbers = 5125, vertex_data = 34962, index_data = 34963;
constexpr gint64   linear = 9729, linear_mipmaps = 9987, clamp_to_edge = 33071;
constexpr float    metres = 0.001f; // a millimetre

// Offsets in the binary chunk, in bytes.
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
layout_of (const CeldReliefMesh &mesh, size_t texture)
{
  Layout l = { 0, 12 * mesh.vertices, 24 * mesh.vertices, 32 * mesh.vertices, 0, 0 };

  l.texture = l.corner + 12 * mesh.triangles;
  l.end     = round_up (l.texture + texture);
  return l;
}

// ------------------------------------------------------------------ JSON

// Builds JSON; nested objects and lists are nested functions.
class Json
{
public:
  Json () : builder (json_builder_new ()) { json_builder_begin_object (builder); }
  ~Json () { g_object_unref (builder); }
  Json (const Json &) = delete;
  Json &operator= (const Json &) = delete;

  template <typename Body>
  void
  object (const char *name, Body body)
  {
    begin (name);
    json_builder_begin_object (builder);
    body ();
    json_builder_end_object (builder);
  }

  template <typename Body>
  void
  list (const char *name, Body body)
  {
    begin (name);
    json_builder_begin_array (builder);
    body ();
    json_builder_end_array (builder);
  }

  void
  number (const char *name, gint64 value)
  {
    begin (name);
    json_builder_add_int_value (builder, value);
  }

  void
  real (const char *name, double value)
  {
    begin (name);
    json_builder_add_double_value (builder, value);
  }

  void
  truth (const char *name, bool value)
  {
    begin (name);
    json_builder_add_boolean_value (builder, value);
  }

  void
  text (const char *name, const char *value)
  {
    begin (name);
    json_builder_add_string_value (builder, value);
  }

  std::string
  end ()
  {
    JsonNode   *root;
    char       *written;
    std::string result;

    json_builder_end_object (builder);
    root    = json_builder_get_root (builder);
    written = json_to_string (root, FALSE);
    result  = written;
    g_free (written);
    json_node_unref (root);
    return result;
  }

private:
  // Starts a member of an object, or an item of a list if the name is null.
  void
  begin (const char *name)
  {
    if (name)
      json_builder_set_member_name (builder, name);
  }

  JsonBuilder *builder;
};

static void
add_view (Json &json, size_t from, size_t end, gint64 target)
{
  json.object (nullptr, [&] {
    json.number ("buffer", 0);
    json.number ("byteOffset", gint64 (from));
    json.number ("byteLength", gint64 (end - from));
    if (target)
      json.number ("target", target);
  });
}

static void
add_accessor (Json &json, gint64 view, gint64 component, size_t count, const char *type)
{
  json.number ("bufferView", view);
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

static void
add_buffers (Json &json, const CeldReliefMesh &mesh, const Layout &l, size_t texture)
{
  json.list ("buffers", [&] { json.object (nullptr, [&] { json.number ("byteLength", gint64 (l.end)); }); });
  json.list ("bufferViews", [&] {
    add_view (json, l.place, l.normal, vertex_data);
    add_view (json, l.normal, l.art, vertex_data);
    add_view (json, l.art, l.corner, vertex_data);
    add_view (json, l.corner, l.texture, index_data);
    if (texture)
      add_view (json, l.texture, l.texture + texture, 0);
  });
  json.list ("accessors", [&] {
    json.object (nullptr, [&] {
      add_accessor (json, 0, float_numbers, mesh.vertices, "VEC3");
      add_bounds (json, mesh);
    });
    json.object (nullptr, [&] { add_accessor (json, 1, float_numbers, mesh.vertices, "VEC3"); });
    json.object (nullptr, [&] { add_accessor (json, 2, float_numbers, mesh.vertices, "VEC2"); });
    json.object (nullptr, [&] { add_accessor (json, 3, unsigned_numbers, 3 * mesh.triangles, "SCALAR"); });
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

static std::string
describe (const CeldReliefMesh &mesh, const Layout &l, size_t texture)
{
  Json json;

  json.object ("asset", [&] {
    json.text ("version", "2.0");
    json.text ("generator", "celdepth");
  });
  json.number ("scene", 0);
  json.list ("scenes", [&] {
    json.object (nullptr, [&] { json.list ("nodes", [&] { json.number (nullptr, 0); }); });
  });
  json.list ("nodes", [&] {
    json.object (nullptr, [&] {
      json.text ("name", "relief");
      json.number ("mesh", 0);
    });
  });
  json.list ("meshes", [&] {
    json.object (nullptr, [&] {
      json.list ("primitives", [&] {
        json.object (nullptr, [&] {
          json.object ("attributes", [&] {
            json.number ("POSITION", 0);
            json.number ("NORMAL", 1);
            json.number ("TEXCOORD_0", 2);
          });
          json.number ("indices", 3);
          json.number ("material", 0);
        });
      });
    });
  });
  add_material (json, texture > 0);
  add_buffers (json, mesh, l, texture);
  return json.end ();
}

// ------------------------------------------------------------------ the file

void
write_gltf (const std::string &path, const CeldReliefMesh &mesh, const CeldColours *art)
{
  const Bytes  texture = art ? encode_texture (*art) : Bytes ();
  const Layout l = layout_of (mesh, texture.size ());
  std::string  json = describe (mesh, l, texture.size ());
  Writer       writer (path);

  json.append (round_up (json.size ()) - json.size (), ' ');
  if (l.end > UINT32_MAX - json.size () - 28)
    throw IoFailure ("it would be larger than 4 GB. Allow fewer vertices.");
  for (uint32_t number : { magic, version, uint32_t (28 + json.size () + l.end), uint32_t (json.size ()), json_chunk })
    writer.put (number);
  writer.put (json);
  writer.put (uint32_t (l.end));
  writer.put (binary_chunk);
  for (size_t i = 0; i < 3 * mesh.vertices; i++)
    writer.put (metres * mesh.place[i]);
  for (size_t i = 0; i < 3 * mesh.vertices; i++)
    writer.put (mesh.normal[i]);
  for (size_t i = 0; i < 2 * mesh.vertices; i++)
    writer.put (mesh.art[i]);
  for (size_t i = 0; i < 3 * mesh.triangles; i++)
    writer.put (mesh.corner[i]);
  writer.put (texture.data (), texture.size ());
  writer.put (std::string (l.end - l.texture - texture.size (), '\0'));
  writer.close ();
  writer.commit ();
}
