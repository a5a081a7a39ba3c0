/* Reading and writing JSON.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CLI_JSON_H
#define CLI_JSON_H

#include <json-glib/json-glib.h>
#include <stdbool.h>

/* Writes what was built, indented, as cli_write_text does, and frees the builder. */
bool cli_write_json (const char *path, JsonBuilder *json);

/* Reads a file into the parser; false with a message, unless `quiet`. */
bool cli_json_read (JsonParser *parser, const char *path, bool quiet);

#endif
