/* --maps, for game engines: a picture each of normals, of occlusion, and of how bright highlights are.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <string.h>

static const char *const suffixes[CLI_MAPS] = { "_n", "_o", "_s" };

char *
cli_map_name (const char *path, int map)
{
  const char *ending = strrchr (path, '.'), *slash = strrchr (path, '/');
  int         stem = ending && (!slash || ending > slash) ? (int) (ending - path) : (int) strlen (path);

  return g_strdup_printf ("%.*s%s%s", stem, path, suffixes[map], path + stem);
}

/* ------------------------------------------------------------------ options */

bool
cli_number_read (const char **text, int least, int most, int *number)
{
  char  *end = NULL;
  gint64 read = g_ascii_isdigit (**text) ? g_ascii_strtoll (*text, &end, 10) : -1;

  *text   = end ? end : *text;
  *number = (int) CLAMP (read, 0, CELD_MAX_SIDE);
  return read >= least && read <= most;
}

bool
cli_maps_check (CliOptions *options)
{
  const char *padding = options->padding_text;

  options->padding = 4;
  if (padding && !(cli_number_read (&padding, 0, 64, &options->padding) && !*padding))
    return cli_error ("--padding cannot be '%s': the value must be 0-64.", options->padding_text);
  return !options->maps || cli_is_png (options->maps) || /* other formats premultiply colours, or have no 8 bits */
         cli_error ("--maps %s: the name must end in .png.", options->maps);
}

/* ------------------------------------------------------------------ making */

bool
cli_maps_new (int width, int height, CliMaps *maps)
{
  bool good = true;

  for (int m = 0; m < CLI_MAPS; m++)
    good = good && cli_colours_new (width, height, &maps->map[m]);
  return good;
}

void
cli_maps_clear (CliMaps *maps)
{
  for (int m = 0; m < CLI_MAPS; m++)
    g_free (maps->map[m].data);
}

bool
cli_normals_copy (const CeldVectors *normals, CeldVectors *copy)
{
  size_t row = 3 * (size_t) normals->width;

  *copy = (CeldVectors) { normals->width, normals->height, (size_t) normals->width,
                          g_try_new (float, row * (gsize) normals->height) };
  for (int y = 0; copy->data && y < normals->height; y++)
    memcpy (copy->data + row * (size_t) y, normals->data + 3 * normals->stride * (size_t) y, row * sizeof *copy->data);
  return copy->data != NULL;
}

void
cli_normals_down (CeldVectors *normals)
{
  for (int y = 0; y < normals->height; y++)
    for (int x = 0; x < normals->width; x++)
      normals->data[3 * ((size_t) y * normals->stride + (size_t) x) + 1] *= -1;
}

/* Fills the maps: normals as 0.5 + 0.5 n; occlusion; and the luma of the art, which engines use for highlights.  Each
 * has the alpha of the art.  encoded: memory for a row. */
static void
fill (const CeldColours *art, const CeldVectors *normals, const CeldPlane *occlusion, float *encoded, CliMaps *maps)
{
  for (int y = 0; y < art->height; y++)
    {
      const float *colour = art->data + 4 * (size_t) y * art->stride;
      const float *n = normals->data + 3 * (size_t) y * normals->stride;
      const float *open = occlusion->data + (size_t) y * occlusion->stride;
      float       *to[CLI_MAPS];

      for (int m = 0; m < CLI_MAPS; m++)
        to[m] = maps->map[m].data + 4 * (size_t) y * maps->map[m].stride;
      cli_encode (colour, art->width, encoded);
      for (size_t x = 0; x < (size_t) art->width; x++)
        {
          for (size_t c = 0; c < 3; c++)
            {
              to[0][4 * x + c] = 0.5f + 0.5f * n[3 * x + c];
              to[1][4 * x + c] = open[x];
              celd_luma (encoded + 4 * x, 1, &to[2][4 * x + c], NULL);
            }
          for (int m = 0; m < CLI_MAPS; m++)
            to[m][4 * x + 3] = colour[4 * x + 3];
        }
    }
}

CeldStatus
cli_maps_make (const CliOptions *options, const CeldColours *art, const CeldVectors *normals, const CeldPlane *occlusion,
               const CeldHost *host, CliMaps *maps)
{
  static const float blank[CLI_MAPS][3] = { { 0.5f, 0.5f, 1 }, { 1, 1, 1 }, { 0, 0, 0 } };
  float             *row = g_try_new (float, 4 * (gsize) art->width);
  CeldStatus         status = row ? CELD_OK : CELD_NO_MEMORY;

  if (row)
    fill (art, normals, occlusion, row, maps);
  g_free (row);
  for (int m = 0; m < CLI_MAPS && status == CELD_OK; m++)
    status = celd_pad_colours (options->padding, blank[m], host, &maps->map[m]);
  return status;
}

bool
cli_maps_write (const char *path, const CliMaps *maps)
{
  bool good = true;

  for (int m = 0; m < CLI_MAPS && good; m++)
    {
      char *name = cli_map_name (path, m);

      good = cli_write_map (name, &maps->map[m]);
      g_free (name);
    }
  return good;
}
