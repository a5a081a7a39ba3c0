/* Layered files whose layers have names that say nothing: which layers there are, and which names are looked for.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include "layer-names.h"

/* The layers that a name may be meant for.  Contours are none of them: colours, which many files have, are called
 * nearly so. */
static const struct { CeldLayerRole role; CliRoles wanted; const char *name; } roles[] = {
  { CELD_LAYER_SCRIBBLES, CLI_SCRIBBLES, "scribbles" }, { CELD_LAYER_ARROWS, CLI_ARROWS, "arrows" },
  { CELD_LAYER_CORRECTIONS, CLI_CORRECTIONS, "corrections" }, { CELD_LAYER_HIDDEN, CLI_HIDDEN, "hidden" },
};

static bool
is_given (const CliOptions *options, CliRoles role)
{
  return role == CLI_SCRIBBLES ? options->scribbles : role == CLI_ARROWS ? options->arrows
       : role == CLI_CORRECTIONS ? options->corrections : options->hidden;
}

/* All names of layers that are looked for and were not found, ended by NULL; free with g_ptr_array_unref. */
static GPtrArray *
missing_names (const CeldIoFile *file, const CliOptions *options, CliRoles wanted)
{
  GPtrArray *names = g_ptr_array_new ();

  for (size_t i = 0; i < G_N_ELEMENTS (roles); i++)
    if (wanted & roles[i].wanted && !is_given (options, roles[i].wanted) &&
        cli_find_part (file, roles[i].name) == CELD_NO_INDEX)
      for (const char *const *name = celd_layer_role_names (roles[i].role); *name; name++)
        g_ptr_array_add (names, (void *) *name);
  g_ptr_array_add (names, NULL);
  return names;
}

/* The missing name that a layer's is nearly; NULL: none, or the layer has a role. */
static const char *
name_meant (const CeldIoPart *part, const GPtrArray *missing)
{
  char       *folded = celd_layer_name_fold (part->name);
  const char *meant = celd_layer_role_of_name (part->name) < CELD_N_LAYERS
                        ? NULL : cli_nearest_name (folded, (const char *const *) missing->pdata);

  g_free (folded);
  return meant;
}

static void
say_meant (const CeldIoFile *file, const char *path, const GPtrArray *missing)
{
  for (size_t i = 0; i < celd_io_parts (file); i++)
    {
      const char *meant = name_meant (celd_io_part (file, i), missing);

      if (meant)
        cli_say ("\"%s\" has a layer \"%s\", which is not read: call it \"%s\" if it is that.", path,
                 celd_io_part (file, i)->name, meant);
    }
}

/* Always false. */
static bool
refuse (const CeldIoFile *file, const char *path, const GPtrArray *missing)
{
  GString *names = g_string_new (NULL);

  for (size_t i = 0; i < celd_io_parts (file); i++)
    {
      const CeldIoPart *part = celd_io_part (file, i);
      const char       *meant = name_meant (part, missing);

      if (part->name[0])
        g_string_append_printf (names, "%s\"%s\"", names->len ? ", " : "", part->name);
      if (meant)
        g_string_append_printf (names, " (is it \"%s\"?)", meant);
    }
  cli_error ("\"%s\" has no scribbles and no arrows: call a layer \"scribbles\" or \"arrows\", or give --scribbles or "
             "--arrows. Its layers are %s.", path, names->str);
  g_string_free (names, TRUE);
  return false;
}

static bool
has_names (const CeldIoFile *file)
{
  for (size_t i = 0; i < celd_io_parts (file); i++)
    if (celd_io_part (file, i)->name[0])
      return true;
  return false;
}

/* Whether regions need scribbles or arrows, and nothing else may make them. */
static bool
needs_strokes (const CeldIoFile *file, const CliOptions *options, CliRoles wanted)
{
  return wanted & CLI_SCRIBBLES && options->step != CLI_REGISTER && !options->settings.flats && !options->scribbles &&
         !options->arrows && !options->relations && !options->relations_file && !options->arrow_path &&
         cli_find_part (file, "scribbles") == CELD_NO_INDEX && cli_find_part (file, "arrows") == CELD_NO_INDEX;
}

bool
cli_check_layer_names (const CeldIoFile *file, const char *path, const CliOptions *options, CliRoles wanted)
{
  GPtrArray *missing;
  bool       good = true;

  if (!has_names (file))
    return true;
  missing = missing_names (file, options, wanted);
  if (needs_strokes (file, options, wanted))
    good = refuse (file, path, missing);
  else if (!options->quiet)
    say_meant (file, path, missing);
  g_ptr_array_unref (missing);
  return good;
}
