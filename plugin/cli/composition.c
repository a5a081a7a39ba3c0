/* Reads the description of a composition, a JSON file.  Files that it names are relative to its folder.
 *
 * Whatever has no meaning is an error, so that a misspelt member does not go unnoticed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "composition.h"
#include "json.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* How a member of a fragment is read. */
typedef enum { NAME, FILE_NAME, TEXT, NUMBER, TRUTH } MemberKind;

#define OPTION(member)    offsetof (CliFragment, options) + offsetof (CliOptions, member)
#define PLACEMENT(member) offsetof (CliFragment, placement) + offsetof (CeldPlacement, member)

static const struct { const char *name; MemberKind kind; size_t offset; } members[] = {
  { "name", NAME, offsetof (CliFragment, name) },
  { "drawing", FILE_NAME, OPTION (input) },
  { "scribbles", FILE_NAME, OPTION (scribbles) },
  { "arrows", FILE_NAME, OPTION (arrows) },
  { "contours", FILE_NAME, OPTION (contours) },
  { "corrections", FILE_NAME, OPTION (corrections) },
  { "hidden", FILE_NAME, OPTION (hidden) },
  { "colours", FILE_NAME, OPTION (colours) },
  { "depth-hint", FILE_NAME, OPTION (depth_hint) },
  { "relations", TEXT, OPTION (relations) },
  { "relations-file", FILE_NAME, OPTION (relations_file) },
  { "arrow-path", TEXT, OPTION (arrow_path) },
  { "handles", TEXT, OPTION (handles) },
  { "handles-file", FILE_NAME, OPTION (handles_file) },
  { "handles-layer", FILE_NAME, OPTION (handles_layer) },
  { "x", NUMBER, PLACEMENT (x) },
  { "y", NUMBER, PLACEMENT (y) },
  { "scale", NUMBER, PLACEMENT (scale) },
  { "turn", NUMBER, PLACEMENT (turn) },
  { "flip", TRUTH, PLACEMENT (flip) },
};

/* ------------------------------------------------------------------ values */

static bool
holds (JsonNode *node, GType type)
{
  return JSON_NODE_HOLDS_VALUE (node) && json_node_get_value_type (node) == type;
}

static bool
read_number (JsonNode *node, double *number)
{
  if (!holds (node, G_TYPE_INT64) && !holds (node, G_TYPE_DOUBLE))
    return false;
  *number = holds (node, G_TYPE_INT64) ? (double) json_node_get_int (node) : json_node_get_double (node);
  return true;
}

static bool
read_truth (JsonNode *node, bool *truth)
{
  if (!holds (node, G_TYPE_BOOLEAN))
    return false;
  *truth = json_node_get_boolean (node);
  return true;
}

static bool
read_file_name (const CliComposition *c, JsonNode *node, char **name)
{
  const char *text = holds (node, G_TYPE_STRING) ? json_node_get_string (node) : "";
  char       *folder;

  if (!text[0])
    return false;
  folder = g_path_get_dirname (c->path);
  g_free (*name);
  *name = g_path_is_absolute (text) ? g_strdup (text) : g_build_filename (folder, text, NULL);
  g_free (folder);
  return true;
}

/* A text, or a list of texts, which become lines. */
static bool
read_text (JsonNode *node, char **text)
{
  GString *lines;
  bool     good = true;

  if (!JSON_NODE_HOLDS_ARRAY (node) && !holds (node, G_TYPE_STRING))
    return false;
  lines = g_string_new (JSON_NODE_HOLDS_ARRAY (node) ? NULL : json_node_get_string (node));
  for (guint i = 0; good && JSON_NODE_HOLDS_ARRAY (node) && i < json_array_get_length (json_node_get_array (node)); i++)
    {
      JsonNode *line = json_array_get_element (json_node_get_array (node), i);

      good = holds (line, G_TYPE_STRING);
      if (good)
        g_string_append_printf (lines, "%s\n", json_node_get_string (line));
    }
  g_free (*text);
  *text = g_string_free (lines, FALSE);
  return good;
}

static bool
read_name (JsonNode *node, char **name)
{
  if (!holds (node, G_TYPE_STRING))
    return false;
  g_free (*name);
  *name = g_strdup (json_node_get_string (node));
  return true;
}

/* ------------------------------------------------------------------ a fragment */

static bool
read_member (const CliComposition *c, const CliFragment *fragment, const char *name, JsonNode *node)
{
  static const char *const wanted[] = { "a text", "the name of a file", "a text or a list of texts", "a number",
                                        "true or false" };
  size_t                   i = 0;
  void                    *value;
  bool                     good = false;

  while (i < G_N_ELEMENTS (members) && strcmp (members[i].name, name))
    i++;
  if (i == G_N_ELEMENTS (members))
    return cli_error ("\"%s\", fragment %d: \"%s\" is not a member of fragments.", c->path,
                      (int) (fragment - c->fragment) + 1, name);
  value = (char *) fragment + members[i].offset;
  switch (members[i].kind)
    {
    case NAME:      good = read_name (node, value); break;
    case FILE_NAME: good = read_file_name (c, node, value); break;
    case TEXT:      good = read_text (node, value); break;
    case NUMBER:    good = read_number (node, value); break;
    case TRUTH:     good = read_truth (node, value); break;
    }
  return good || cli_error ("\"%s\", fragment %d: \"%s\" must be %s.", c->path, (int) (fragment - c->fragment) + 1,
                            name, wanted[members[i].kind]);
}

/* The name of the drawing's file without folder and ending. */
static char *
name_of_file (const char *path)
{
  char *name = g_path_get_basename (path), *dot = strrchr (name, '.');

  if (dot && dot > name)
    *dot = 0;
  return name;
}

static bool
check_fragment (const CliComposition *c, CliFragment *f)
{
  const struct { const char *member; double value; } place[] = {
    { "x", f->placement.x }, { "y", f->placement.y }, { "turn", f->placement.turn } };
  int number = (int) (f - c->fragment) + 1;

  if (!f->options.input)
    return cli_error ("\"%s\", fragment %d: \"drawing\" is missing, the file with the drawing.", c->path, number);
  if (!f->name)
    f->name = name_of_file (f->options.input);
  if (!f->name[0] || strspn (f->name, G_CSET_A_2_Z G_CSET_a_2_z G_CSET_DIGITS "-_.") < strlen (f->name))
    return cli_error ("\"%s\", fragment %d: the name \"%s\" must consist of letters A to Z, digits, \"-\", \"_\" and "
                      "\".\"; give another \"name\".", c->path, number, f->name);
  for (const CliFragment *other = c->fragment; other < f; other++)
    if (!strcmp (other->name, f->name))
      return cli_error ("\"%s\": fragments %d and %d both have the name \"%s\"; give each its own \"name\".", c->path,
                        (int) (other - c->fragment) + 1, number, f->name);
  if (!(f->placement.scale >= CELD_LEAST_SCALE && f->placement.scale <= CELD_LARGEST_SCALE))
    return cli_error ("\"%s\", fragment %d (%s): \"scale\" must be from %g to %g.", c->path, number, f->name,
                      CELD_LEAST_SCALE, CELD_LARGEST_SCALE);
  for (size_t i = 0; i < G_N_ELEMENTS (place); i++)
    if (!(fabs (place[i].value) <= CELD_FARTHEST_PLACE))
      return cli_error ("\"%s\", fragment %d (%s): \"%s\" must be from %.0f to %.0f.", c->path, number, f->name,
                        place[i].member, -CELD_FARTHEST_PLACE, CELD_FARTHEST_PLACE);
  return !f->options.hidden || f->options.settings.complete ||
         cli_error ("\"%s\", fragment %d (%s): \"hidden\" needs --complete yes: other layers have nothing that is "
                    "hidden.", c->path, number, f->name);
}

static bool
read_fragment (const CliComposition *c, const CliOptions *options, JsonNode *node, CliFragment *f)
{
  GList *names;
  bool   good = true;

  *f = (CliFragment) { .placement = { .scale = 1 },
                       .options = { .step = options->step, .settings = options->settings, .quiet = options->quiet } };
  if (!JSON_NODE_HOLDS_OBJECT (node))
    return cli_error ("\"%s\", fragment %d: it must be an object such as { \"drawing\": \"man.png\" }.", c->path,
                      (int) (f - c->fragment) + 1);
  names = json_object_get_members (json_node_get_object (node));
  for (GList *name = names; name && good; name = name->next)
    good = read_member (c, f, name->data, json_object_get_member (json_node_get_object (node), name->data));
  g_list_free (names);
  return good && check_fragment (c, f);
}

/* ------------------------------------------------------------------ the whole */

static bool
read_fragments (CliComposition *c, const CliOptions *options, JsonNode *node)
{
  JsonArray *list = JSON_NODE_HOLDS_ARRAY (node) ? json_node_get_array (node) : NULL;
  guint      n = list ? json_array_get_length (list) : 0;
  bool       good = n > 0;

  if (!good)
    return cli_error ("\"%s\": \"fragments\" must be a list of drawings such as [ { \"drawing\": \"man.png\" } ].",
                      c->path);
  c->fragment = g_new0 (CliFragment, n);
  for (guint i = 0; i < n && good; i++)
    {
      c->n = i + 1;
      good = read_fragment (c, options, json_array_get_element (list, i), &c->fragment[i]);
    }
  return good;
}

static bool
read_side (const CliComposition *c, const char *name, JsonNode *node, int *side)
{
  gint64 value = holds (node, G_TYPE_INT64) ? json_node_get_int (node) : 0;

  *side = value >= 1 && value <= CELD_MAX_SIDE ? (int) value : 0;
  return *side || cli_error ("\"%s\": \"%s\" must be a whole number from 1 to %d.", c->path, name, CELD_MAX_SIDE);
}

static bool
read_root (CliComposition *c, const CliOptions *options, JsonObject *root)
{
  GList *names = json_object_get_members (root);
  bool   good = true;

  for (GList *item = names; item && good; item = item->next)
    {
      const char *name = item->data;
      JsonNode   *node = json_object_get_member (root, name);

      if (!strcmp (name, "fragments"))
        good = read_fragments (c, options, node);
      else if (!strcmp (name, "width") || !strcmp (name, "height"))
        good = read_side (c, name, node, name[0] == 'w' ? &c->width : &c->height);
      else if (!strcmp (name, "relations"))
        good = read_text (node, &c->relations) ||
               cli_error ("\"%s\": \"relations\" must be a text or a list of texts.", c->path);
      else
        good = cli_error ("\"%s\": \"%s\" is not a member of compositions.", c->path, name);
    }
  g_list_free (names);
  if (good && !c->n)
    good = cli_error ("\"%s\": \"fragments\" is missing, the list of drawings.", c->path);
  return good && (!c->width == !c->height ||
                  cli_error ("\"%s\": give both \"width\" and \"height\", or neither.", c->path));
}

bool
cli_composition_read (const char *path, const CliOptions *options, CliComposition *c)
{
  JsonParser *parser = json_parser_new ();
  JsonNode   *root;
  bool        good;

  *c   = (CliComposition) { .path = path };
  good = cli_json_read (parser, path, false);
  root = good ? json_parser_get_root (parser) : NULL;
  if (good && (!root || !JSON_NODE_HOLDS_OBJECT (root)))
    good = cli_error ("\"%s\": a composition is an object such as { \"fragments\": [ { \"drawing\": \"man.png\" } ] }.",
                      path);
  good = good && read_root (c, options, json_node_get_object (root));
  g_object_unref (parser);
  return good;
}

void
cli_composition_clear (CliComposition *c)
{
  for (guint i = 0; i < c->n; i++)
    {
      g_free (c->fragment[i].name);
      cli_options_clear (&c->fragment[i].options);
    }
  g_free (c->fragment);
  g_free (c->relations);
  *c = (CliComposition) { 0 };
}
