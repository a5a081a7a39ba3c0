/* A procedure for Live alone: brings pixels into a layer, without a step of undo, in a process without a window.
 *
 * GIMP ends a plug-in that writes a tile which is not there any more, or may not be written.  Between any two messages
 * of a plug-in GIMP may do what the artist has asked for, and each tile is a message: so a layer can go, shrink or be
 * locked while it is written to, whatever was asked before.  GIMP has no other way of writing without a step of undo.
 * What it ends is this process, and Live goes on.
 *
 * It is the process in which Live was chosen: that has nothing else to do, and brings pixels in a few milliseconds.  If
 * it has been ended, one is started each time, which takes a third of a second.
 *
 * To have that seldom, pixels are written by rows of tiles, and the size of the layer is asked for before each.  Whole
 * tiles are written, also where they go beyond the layer, since GEGL would first read a tile that is written in part; a
 * layer that grows meanwhile may get them in a wrong place, until the next picture comes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#include <unistd.h>

/* The whole tiles of libgimp that have a pixel of the rectangle, also where they go beyond the layer. */
static GeglRectangle
whole_tiles (const GeglRectangle *rect)
{
  GeglRectangle tiles;

  gegl_rectangle_align (&tiles, rect,
                        GEGL_RECTANGLE (0, 0, (int) gimp_tile_width (), (int) gimp_tile_height ()),
                        GEGL_RECTANGLE_ALIGNMENT_SUPERSET);
  return tiles;
}

/* Writes whole tiles of the layer, if it still has the size of what they come from; whether it has.  The size is asked
 * for when the pixels are ready. */
static gboolean
send_row (GimpDrawable *drawable, GeglBuffer *source, const GeglRectangle *row)
{
  const Babl   *format = gegl_buffer_get_format (source);
  guint8       *pixels = g_try_malloc_n ((gsize) row->width * (gsize) row->height,
                                         (gsize) babl_format_get_bytes_per_pixel (format));
  GeglBuffer   *there = NULL;
  GeglRectangle extent;
  gboolean      good;

  if (pixels)
    {
      gegl_buffer_get (source, row, 1, format, pixels, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
      there = gimp_drawable_get_buffer (drawable);
    }
  good = there && gegl_rectangle_equal (gegl_buffer_get_extent (there), gegl_buffer_get_extent (source));
  if (good)
    {
      gegl_rectangle_bounding_box (&extent, gegl_buffer_get_extent (there), row);
      gegl_buffer_set_extent (there, &extent);
      gegl_buffer_set (there, row, 0, format, pixels, GEGL_AUTO_ROWSTRIDE);
      gegl_buffer_flush (there); /* which sends them */
    }
  g_clear_object (&there);
  g_free (pixels);
  return good;
}

/* Has GIMP draw what was written.  If the layer is resized, GIMP draws all of it. */
static void
send (GimpDrawable *drawable, GeglBuffer *source, const GeglRectangle *changed)
{
  GeglRectangle tiles = whole_tiles (changed), row = tiles;
  int           bottom = tiles.y + tiles.height, side = (int) gimp_tile_height ();

  while (row.y < bottom)
    {
      row.height = MIN (side, bottom - row.y);
      if (!send_row (drawable, source, &row))
        return;
      row.y += row.height;
    }
  gimp_drawable_update (drawable, changed->x, changed->y, changed->width, changed->height);
}

static GimpValueArray *
run (GimpProcedure *procedure, GimpProcedureConfig *config, gpointer run_data)
{
  GimpDrawable *layer, *copy;
  GeglBuffer   *source;
  GeglRectangle changed;

  (void) run_data;
  gimp_plug_in_set_pdb_error_handler (gimp_get_plug_in (), GIMP_PDB_ERROR_HANDLER_PLUGIN);
  gegl_init (NULL, NULL);
  g_object_get (config, "layer", &layer, "copy", &copy, "x", &changed.x, "y", &changed.y, "width", &changed.width,
                "height", &changed.height, NULL);
  source = copy ? gimp_drawable_get_buffer (copy) : NULL;
  if (layer && source)
    send (layer, source, &changed);
  g_clear_object (&source);
  g_clear_object (&copy);
  g_clear_object (&layer);
  return gimp_procedure_new_return_values (procedure, GIMP_PDB_SUCCESS, NULL);
}

/* Only Live calls it, and nobody reads its texts but in the Procedure Browser: they are not translated. */
static GimpProcedure *
create (GimpPlugIn *plug_in, const char *name, GimpPDBProcType type)
{
  GimpProcedure *procedure = gimp_procedure_new (plug_in, name, type, run, NULL, NULL);

  gimp_procedure_set_documentation (procedure, "A part of Live: brings pixels into a layer",
                                    "Copies a rectangle between layers of one size and format, without a step of undo.",
                                    NULL);
  gimp_procedure_set_attribution (procedure, "The authors of celdepth", "LGPL-3.0-or-later", "2026");
  gimp_procedure_add_layer_argument (procedure, "layer", "Layer", "That is written to", FALSE, G_PARAM_READWRITE);
  gimp_procedure_add_layer_argument (procedure, "copy", "Copy", "That has the pixels", FALSE, G_PARAM_READWRITE);
  gimp_procedure_add_int_argument (procedure, "x", "x", "Of the rectangle", 0, G_MAXINT, 0, G_PARAM_READWRITE);
  gimp_procedure_add_int_argument (procedure, "y", "y", "Of the rectangle", 0, G_MAXINT, 0, G_PARAM_READWRITE);
  gimp_procedure_add_int_argument (procedure, "width", "Width", "Of the rectangle", 1, G_MAXINT, 1, G_PARAM_READWRITE);
  gimp_procedure_add_int_argument (procedure, "height", "Height", "Of the rectangle", 1, G_MAXINT, 1,
                                   G_PARAM_READWRITE);
  return procedure;
}

GimpProcedure *
celd_live_send_create (GimpPlugIn *plug_in)
{
  return create (plug_in, CELD_LIVE_SEND, GIMP_PDB_PROC_TYPE_PLUGIN);
}

GimpProcedure *
celd_live_send_create_here (GimpPlugIn *plug_in)
{
  char          *name = g_strdup_printf (CELD_LIVE_SEND "-%d", (int) getpid ());
  GimpProcedure *procedure = create (plug_in, name, GIMP_PDB_PROC_TYPE_TEMPORARY);

  gimp_plug_in_add_temp_procedure (plug_in, procedure);
  g_free (name);
  return procedure;
}
