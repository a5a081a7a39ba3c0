/* The keys of an animation: the handles of some frames, as JSON.
 *
 *   { "keys": [ { "frame": 0, "handles": [ [x, y, to x, to y, depth], ... ] }, ... ] }
 *
 * Depth may be left out, and so may the place that a pin is taken to.  All keys have the same handles, which hold the
 * same places of the drawing.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"
#include "json.h"

#include <math.h>
#include <stdlib.h>

#define MOST_FRAME 10000

/* ------------------------------------------------------------------ JSON */

/* Whether an object has these members and no others. */
static bool
check_members (const char *path, JsonObject *object, const char *const *names)
{
  GList *members = json_object_get_members (object);
  bool   good = true;

  for (size_t i = 0; good && names[i]; i++)
    good = json_object_has_member (object, names[i]) || cli_error ("%s: \"%s\" is missing.", path, names[i]);
  for (GList *m = members; good && m; m = m->next)
    good = g_strv_contains (names, m->data) || cli_error ("%s: \"%s\" is unknown.", path, (const char *) m->data);
  g_list_free (members);
  return good;
}

static bool
read_number (JsonNode *node, double *number)
{
  if (!JSON_NODE_HOLDS_VALUE (node) || (json_node_get_value_type (node) != G_TYPE_INT64 &&
                                        json_node_get_value_type (node) != G_TYPE_DOUBLE))
    return false;
  *number = json_node_get_double (node);
  return isfinite (*number);
}

/* Reads [x, y], [x, y, to x, to y] or [x, y, to x, to y, depth]. */
static bool
read_handle (JsonNode *node, CeldHandle *handle)
{
  JsonArray *array = JSON_NODE_HOLDS_ARRAY (node) ? json_node_get_array (node) : NULL;
  guint      n = array ? json_array_get_length (array) : 0;
  double     number[5] = { 0 };

  if (n != 2 && n != 4 && n != 5)
    return false;
  for (guint i = 0; i < n; i++)
    if (!read_number (json_array_get_element (array, i), &number[i]))
      return false;
  *handle = (CeldHandle) { number[0], number[1], number[n > 2 ? 2 : 0], number[n > 2 ? 3 : 1], number[4] };
  return true;
}

static bool
read_handles (const char *path, size_t key, JsonNode *node, CeldHandles *handles)
{
  JsonArray *array = JSON_NODE_HOLDS_ARRAY (node) ? json_node_get_array (node) : NULL;
  guint      n = array ? json_array_get_length (array) : 0;

  if (!array)
    return cli_error ("%s, key %zu: \"handles\" must be an array.", path, key + 1);
  handles->item = n ? calloc (n, sizeof *handles->item) : NULL;
  if (n && !handles->item)
    return cli_check (CELD_NO_MEMORY);
  for (; handles->n < n; handles->n++)
    if (!read_handle (json_array_get_element (array, (guint) handles->n), &handles->item[handles->n]))
      return cli_error ("%s, key %zu, handle %zu: it must be [x, y], [x, y, to x, to y] or [x, y, to x, to y, depth].",
                        path, key + 1, handles->n + 1);
  return true;
}

static bool
read_key (const char *path, size_t k, JsonNode *node, CeldHandleKey *key)
{
  static const char *const members[] = { "frame", "handles", NULL };
  JsonObject              *object = JSON_NODE_HOLDS_OBJECT (node) ? json_node_get_object (node) : NULL;
  double                   frame = 0;

  if (!object)
    return cli_error ("%s, key %zu: it must be an object.", path, k + 1);
  if (!check_members (path, object, members))
    return false;
  if (!read_number (json_object_get_member (object, "frame"), &frame) || frame != floor (frame) || frame < 0 ||
      frame > MOST_FRAME)
    return cli_error ("%s, key %zu: \"frame\" must be a whole number from 0 to %d.", path, k + 1, MOST_FRAME);
  key->frame = (int) frame;
  return read_handles (path, k, json_object_get_member (object, "handles"), &key->handles);
}

/* Whether a key follows on the one before it: later, with handles of the same places. */
static bool
check_next (const char *path, size_t k, const CeldHandleKey *key)
{
  const CeldHandles *a = &key[-1].handles, *b = &key->handles;

  if (key->frame <= key[-1].frame)
    return cli_error ("%s, key %zu: its frame must be later than that of the key before it.", path, k + 1);
  if (a->n != b->n)
    return cli_error ("%s, key %zu: it has %zu handles, but the key before it has %zu.", path, k + 1, b->n, a->n);
  for (size_t i = 0; i < a->n; i++)
    if (a->item[i].x != b->item[i].x || a->item[i].y != b->item[i].y)
      return cli_error ("%s, key %zu, handle %zu: its first two numbers must be those of the key before it.", path,
                        k + 1, i + 1);
  return true;
}

static bool
read_root (const char *path, JsonNode *root, CliHandleKeys *keys)
{
  static const char *const members[] = { "keys", NULL };
  JsonArray               *array;
  guint                    n;

  if (!root || !JSON_NODE_HOLDS_OBJECT (root))
    return cli_error ("%s: it must be an object with \"keys\".", path);
  if (!check_members (path, json_node_get_object (root), members))
    return false;
  root  = json_object_get_member (json_node_get_object (root), "keys");
  array = JSON_NODE_HOLDS_ARRAY (root) ? json_node_get_array (root) : NULL;
  n     = array ? json_array_get_length (array) : 0;
  if (!n)
    return cli_error ("%s: \"keys\" must be an array of at least one key.", path);
  keys->item = g_new0 (CeldHandleKey, n);
  for (guint k = 0; k < n; k++)
    {
      keys->n++;
      if (!read_key (path, k, json_array_get_element (array, k), &keys->item[k]) ||
          (k && !check_next (path, k, &keys->item[k])))
        return false;
    }
  return true;
}

bool
cli_handle_keys_read (const char *path, CliHandleKeys *keys)
{
  JsonParser *parser = json_parser_new ();
  bool        good = cli_json_read (parser, path, false) && read_root (path, json_parser_get_root (parser), keys);

  g_object_unref (parser);
  return good;
}

void
cli_handle_keys_clear (CliHandleKeys *keys)
{
  for (size_t k = 0; k < keys->n; k++)
    celd_handles_clear (&keys->item[k].handles);
  g_free (keys->item);
  *keys = (CliHandleKeys) { 0 };
}
