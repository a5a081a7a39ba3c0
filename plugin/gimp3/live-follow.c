/* Follows the layers of an image while the artist paints.
 *
 * GIMP does not tell plug-ins that pixels have changed, so layers are read and compared.  A buffer of GIMP's never
 * changes once it is there: each reading gets a new one.  Tiles are sent one by one, and libgimp ends a plug-in whose
 * layer is resized or removed meanwhile; so a copy is read, in an image that nobody else knows.  A copy is made at
 * once, and shares its tiles with the layer.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "live.h"

#include <string.h>

#define LOOK_AFTER 500000 /* microseconds between looks at names, settings and paths; chosen */
#define TURNS      3      /* readings of the selected layers until another one is read, too; chosen */

struct CeldLiveFollower
{
  GimpImage           *image;
  GimpProcedureConfig *config;
  GimpImage           *own;                   /* where copies belong, without a display; NULL: none yet */
  GimpLayer           *layer[CELD_N_LAYERS];  /* NULL: there is none */
  CeldLiveRequest     *seen;
  guint8              *pixels[CELD_N_LAYERS]; /* those of the buffers in `seen`, which own them */
  guint8              *spare;                 /* memory for the next layer that is read */
  gsize                spare_size;
  int                  turn;                  /* the role that was last read in turn */
  int                  readings;              /* of the selected layers since then */
  int                  left_out;              /* strokes of paths */
  gint64               looked;                /* when; 0: never, or it has to be done at once */
};

CeldLiveFollower *
celd_live_follower_new (GimpImage *image, GimpProcedureConfig *config)
{
  CeldLiveFollower *f = g_new0 (CeldLiveFollower, 1);

  f->image  = image;
  f->config = config;
  f->seen   = celd_live_request_new ();
  return f;
}

static void
forget_layer (CeldLiveFollower *f, int role)
{
  g_clear_object (&f->seen->input.layer[role].buffer);
  f->pixels[role] = NULL;
}

void
celd_live_follower_free (CeldLiveFollower *f)
{
  for (int role = 0; role < CELD_N_LAYERS; role++)
    g_clear_object (&f->layer[role]);
  if (f->own)
    gimp_image_delete (f->own);
  celd_live_request_free (f->seen);
  g_free (f->spare);
  g_free (f);
}

CeldLiveRequest *
celd_live_follower_request (const CeldLiveFollower *f)
{
  return celd_live_request_copy (f->seen);
}

GimpImage *
celd_live_follower_image (const CeldLiveFollower *f)
{
  return f->own;
}

int
celd_live_follower_left_out (const CeldLiveFollower *f)
{
  return f->left_out;
}

/* ------------------------------------------------------------------ pixels */

/* The pixels of a buffer in its own format, in the spare memory; NULL: there is not enough. */
static guint8 *
read_pixels (CeldLiveFollower *f, GeglBuffer *buffer, gsize size)
{
  if (f->spare_size != size)
    {
      g_free (f->spare);
      f->spare      = g_try_malloc (size);
      f->spare_size = f->spare ? size : 0;
    }
  if (f->spare)
    gegl_buffer_get (buffer, NULL, 1, gegl_buffer_get_format (buffer), f->spare, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  return f->spare;
}

/* Whether the layer has become another one; then `seen` has it. */
static gboolean
take_pixels (CeldLiveFollower *f, int role, CeldPipelineLayer now)
{
  CeldPipelineLayer *seen = &f->seen->input.layer[role];
  GeglRectangle      extent;
  const Babl        *format;
  gsize              size;
  gboolean           same;

  extent = *gegl_buffer_get_extent (now.buffer);
  format = gegl_buffer_get_format (now.buffer);
  size   = (gsize) extent.width * (gsize) extent.height * (gsize) babl_format_get_bytes_per_pixel (format);
  same   = !read_pixels (f, now.buffer, size) ||
           (seen->buffer && gegl_rectangle_equal (&extent, gegl_buffer_get_extent (seen->buffer)) &&
            format == gegl_buffer_get_format (seen->buffer) && !memcmp (f->spare, f->pixels[role], size));
  if (same && now.x == seen->x && now.y == seen->y)
    return FALSE;
  if (!same)
    {
      forget_layer (f, role);
      seen->buffer    = gegl_buffer_linear_new_from_data (f->spare, format, &extent, GEGL_AUTO_ROWSTRIDE, g_free,
                                                          f->spare);
      f->pixels[role] = f->spare;
      f->spare        = NULL;
      f->spare_size   = 0;
    }
  seen->x = now.x;
  seen->y = now.y;
  return TRUE;
}

static gboolean
read_layer (CeldLiveFollower *f, int role)
{
  CeldPipelineLayer now = { NULL, 0, 0, 0 };
  GimpLayer        *copy = NULL;
  gboolean          changed;

  if (celd_layer_is_plain (f->layer[role]))
    {
      copy       = gimp_layer_new_from_drawable (GIMP_DRAWABLE (f->layer[role]), f->own);
      now.buffer = copy ? gimp_drawable_get_buffer (GIMP_DRAWABLE (copy)) : NULL;
      if (copy)
        gimp_drawable_get_offsets (GIMP_DRAWABLE (copy), &now.x, &now.y);
    }
  else
    now = celd_layer_seen (f->layer[role], f->own);
  changed = now.buffer && take_pixels (f, role, now);
  g_clear_object (&now.buffer);
  if (copy)
    gimp_item_delete (GIMP_ITEM (copy));
  return changed;
}

/* The layers that the artist may be painting on, as bits. */
static guint
selected_layers (const CeldLiveFollower *f)
{
  GimpLayer **selected = gimp_image_get_selected_layers (f->image);
  guint       roles = 0;

  for (int i = 0; selected && selected[i]; i++)
    for (int role = 0; role < CELD_N_LAYERS; role++)
      if (f->layer[role] == selected[i])
        roles |= 1u << role;
  g_free (selected);
  return roles;
}

/* The layer, as a bit, that is read beside the selected ones this time; 0: none. */
static guint
layer_in_turn (CeldLiveFollower *f, guint selected)
{
  if (++f->readings < TURNS && selected)
    return 0;
  f->readings = 0;
  for (int i = 0; i < CELD_N_LAYERS; i++)
    {
      f->turn = (f->turn + 1) % CELD_N_LAYERS;
      if (f->layer[f->turn] && !(selected & 1u << f->turn))
        return 1u << f->turn;
    }
  return 0;
}

static gboolean
read_layers (CeldLiveFollower *f)
{
  guint    wanted = selected_layers (f);
  gboolean changed = FALSE;

  wanted |= layer_in_turn (f, wanted);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (f->layer[role] && (wanted & 1u << role || !f->pixels[role]))
      changed |= read_layer (f, role);
  return changed;
}

/* ------------------------------------------------------------------ names, settings, paths */

static gboolean
same_settings (const CeldSettings *a, const CeldSettings *b)
{
  size_t                 n;
  const CeldSettingInfo *info = celd_setting_infos (&n);

  for (size_t i = 0; i < n; i++)
    if (celd_setting_get (&info[i], a) != celd_setting_get (&info[i], b))
      return FALSE;
  return TRUE;
}

/* Takes a text; whether it differs from the one before. */
static gboolean
replace (const char **seen, char *text)
{
  gboolean changed = g_strcmp0 (*seen, text) != 0;

  g_free ((char *) *seen);
  *seen = text;
  return changed;
}

static gboolean
take_layers (CeldLiveFollower *f, GimpLayer *const layer[CELD_N_LAYERS])
{
  gboolean changed = FALSE;

  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (f->layer[role] != layer[role])
      {
        g_set_object (&f->layer[role], layer[role]);
        forget_layer (f, role);
        f->seen->input.layer[role].id = layer[role] ? gimp_item_get_id (GIMP_ITEM (layer[role])) : 0;
        changed = TRUE;
      }
  return changed;
}

static gboolean
take_settings (CeldLiveFollower *f, const CeldPathArrows *paths)
{
  CeldPipelineInput *seen = &f->seen->input;
  CeldSettings       settings = celd_settings_chosen (f->config);
  int                width = gimp_image_get_width (f->image), height = gimp_image_get_height (f->image);
  gboolean           changed = !same_settings (&settings, &seen->settings) || width != seen->width ||
                               height != seen->height;
  char              *relations = NULL;

  g_object_get (f->config, "relations", &relations, NULL);
  changed       |= replace (&seen->relations, relations);
  changed       |= replace (&seen->arrow_path, g_strdup (paths->data));
  seen->settings = settings;
  seen->width    = width;
  seen->height   = height;
  f->left_out    = paths->left_out;
  return changed;
}

/* Copies would be converted if their image had another precision or another profile. */
static void
make_own_image (CeldLiveFollower *f)
{
  GimpPrecision     precision = gimp_image_get_precision (f->image);
  GimpColorProfile *profile = gimp_image_get_color_profile (f->image);
  GimpColorProfile *own = f->own ? gimp_image_get_color_profile (f->own) : NULL;

  if (!f->own || gimp_image_get_precision (f->own) != precision || !profile != !own ||
      (profile && !gimp_color_profile_is_equal (profile, own)))
    {
      if (f->own)
        gimp_image_delete (f->own);
      f->own = celd_image_like (f->image, 1, 1);
    }
  g_clear_object (&profile);
  g_clear_object (&own);
}

/* *changed is set to TRUE if anything has.  FALSE and *error: the image cannot be followed as it is. */
static gboolean
look (CeldLiveFollower *f, gboolean *changed, GError **error)
{
  CeldPathArrows paths;
  GimpLayer     *layer[CELD_N_LAYERS];
  gboolean       good;

  if (!celd_image_check (f->image, error))
    return FALSE;
  make_own_image (f);
  celd_settings_recall (f->image, f->config);
  celd_layers_chosen (f->config, layer);
  paths = celd_paths_read (f->image);
  good  = celd_layers_check (layer, &paths, f->config, error);
  if (good)
    {
      *changed |= take_layers (f, layer);
      *changed |= take_settings (f, &paths);
    }
  g_free (paths.data);
  return good;
}

/* ------------------------------------------------------------------ following */

static gboolean
has_lost_a_layer (const CeldLiveFollower *f)
{
  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (f->layer[role] && !gimp_item_is_valid (GIMP_ITEM (f->layer[role])))
      return TRUE;
  return FALSE;
}

CeldLiveNews
celd_live_follow (CeldLiveFollower *f, gboolean *looked, GError **error)
{
  gboolean changed = FALSE;
  gint64   now = g_get_monotonic_time ();

  if (!gimp_image_is_valid (f->image))
    return CELD_LIVE_CLOSED;
  *looked = !f->looked || now - f->looked > LOOK_AFTER || has_lost_a_layer (f);
  if (*looked)
    {
      f->looked = 0;
      if (!look (f, &changed, error))
        return CELD_LIVE_REFUSED;
      f->looked = now;
    }
  changed |= read_layers (f);
  return changed ? CELD_LIVE_CHANGED : CELD_LIVE_SAME;
}
