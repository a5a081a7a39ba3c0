// Text in JSON, by json-glib.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELDEPTH_JSON_HPP
#define CELDEPTH_JSON_HPP

#include <json-glib/json-glib.h>

#include <string>

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
  end (bool readable = false)
  {
    JsonNode   *root;
    char       *written;
    std::string result;

    json_builder_end_object (builder);
    root    = json_builder_get_root (builder);
    written = json_to_string (root, readable);
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

#endif
