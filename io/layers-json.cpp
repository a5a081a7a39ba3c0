// Describes the layers of a folder as JSON, for programs that rig them: docs/layers.md.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "json.hpp"
#include "layers.hpp"

#include <glib.h>

constexpr gint64 format_version = 1; // increases when a member is removed or changes its meaning

static void
add_colour (Json &json, const CeldIoLayer &layer)
{
  char colour[8];

  if (!layer.colour[3])
    return;
  g_snprintf (colour, sizeof colour, "#%02x%02x%02x", layer.colour[0], layer.colour[1], layer.colour[2]);
  json.text ("colour", colour);
}

static void
add_layer (Json &json, const CeldIoStack &stack, size_t k, const std::vector<std::string> &file)
{
  const CeldIoLayer &layer = stack.layer[k];
  char              *name = g_utf8_make_valid (layer.name, -1);

  json.text ("file", file[k].c_str ());
  json.text ("name", name);
  add_colour (json, layer);
  json.number ("label", layer.label);
  json.number ("level", layer.level);
  json.truth ("background", layer.background);
  if (layer.joint.parent < stack.layers)
    json.text ("parent", file[layer.joint.parent].c_str ());
  json.list ("box", [&] {
    for (int side : { layer.box.x, layer.box.y, layer.box.width, layer.box.height })
      json.number (nullptr, side);
  });
  json.list ("pivot", [&] {
    json.real (nullptr, layer.joint.x);
    json.real (nullptr, layer.joint.y);
  });
  g_free (name);
}

std::string
layers_json (const CeldIoStack &stack, const std::vector<std::string> &file)
{
  Json json;

  json.text ("format", "celdepth-layers");
  json.number ("version", format_version);
  json.number ("width", stack.width);
  json.number ("height", stack.height);
  json.list ("layers", [&] {
    for (size_t k = 0; k < stack.layers; k++)
      json.object (nullptr, [&] { add_layer (json, stack, k, file); });
  });
  return json.end (true) + "\n";
}
