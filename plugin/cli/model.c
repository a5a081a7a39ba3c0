/* Models for relief: names, settings and files.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"
#include "part-names.h"

/* ------------------------------------------------------------------ names */

char **
cli_model_names (const CeldPalette *palette)
{
  char **name = g_new0 (char *, palette->n + 1);

  for (size_t k = 0; k < palette->n; k++)
    name[k] = celd_part_name (palette, (uint32_t) k + 1);
  return name;
}

typedef struct { float level; uint32_t region; } LevelRegion;

static int
compare (gconstpointer first, gconstpointer second)
{
  const LevelRegion *a = first, *b = second;

  if (a->level != b->level)
    return a->level < b->level ? -1 : 1;
  return (a->region > b->region) - (a->region < b->region);
}

/* The regions of each level, in the order of celd_layers_of_levels. */
static GArray *
list_regions (const CeldPlane *levels, const CeldLabels *regions)
{
  GArray *list = g_array_new (FALSE, FALSE, sizeof (LevelRegion));
  guint   n = 0;

  for (size_t i = 0; i < (size_t) levels->width * (size_t) levels->height; i++)
    {
      LevelRegion found = { levels->data[i] == levels->data[i] ? levels->data[i] + 0.f : 0,
                            regions ? regions->data[i] : 0 };

      if (!list->len || compare (&found, &g_array_index (list, LevelRegion, list->len - 1)))
        g_array_append_val (list, found);
    }
  g_array_sort (list, compare);
  for (guint i = 0; i < list->len; i++)
    if (!n || compare (&g_array_index (list, LevelRegion, i), &g_array_index (list, LevelRegion, n - 1)))
      g_array_index (list, LevelRegion, n++) = g_array_index (list, LevelRegion, i);
  g_array_set_size (list, n);
  return list;
}

char **
cli_model_names_of_regions (const CeldPlane *levels, const CeldLabels *regions, const CeldPalette *palette)
{
  GArray *list = list_regions (levels, regions);
  char  **name = g_new0 (char *, (gsize) list->len + 1);

  for (guint k = 0; k < list->len; k++)
    {
      uint32_t region = g_array_index (list, LevelRegion, k).region;

      name[k] = region ? celd_part_name (palette, region) : g_strdup_printf ("level-%u", k + 1);
    }
  g_array_free (list, TRUE);
  return name;
}

/* ------------------------------------------------------------------ settings and files */

CeldSettings
cli_model_settings (const CliOptions *options)
{
  CeldSettings s = options->settings;

  if (s.mesh_kind == CELD_MESH_AUTO)
    s.mesh_kind = options->mesh && celd_io_mesh_kind (options->mesh) == CELD_IO_STL ? CELD_MESH_SOLID : CELD_MESH_SURFACE;
  return s;
}

bool
cli_model_write (const char *path, const CeldModel *model, char **name)
{
  CeldIoMesh *mesh = g_new (CeldIoMesh, model->n);
  bool        good;

  for (size_t i = 0; i < model->n; i++)
    mesh[i] = (CeldIoMesh) { name[model->part[i].label - 1], &model->part[i].mesh };
  good = cli_write_meshes (path, mesh, model->n, &model->atlas);
  g_free (mesh);
  g_strfreev (name);
  return good;
}
