/* Relief mesh: a model of the parts for 3D programs or for printing.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#include "on-demand.h"

#define ENDINGS N_ (".glb, .obj, .ply or .stl")

static gboolean
can_write (const char *path)
{
  return celd_io_mesh_kind (path) != CELD_IO_NO_MESH;
}

static gboolean
prepare (GimpImage *image, GimpProcedureConfig *config, gboolean *done, GError **error)
{
  char *path = celd_file_chosen (config, can_write, ENDINGS, error);

  (void) image;
  *done = FALSE;
  g_free (path);
  return path != NULL;
}

static gboolean
make (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config, CeldPipelineProgress progress,
      gpointer data, GError **error)
{
  char    *path = celd_file_chosen (config, can_write, ENDINGS, error);
  gboolean good = path && celd_pipeline_save_model (pipeline, path, progress, data, error);

  (void) image;
  g_free (path);
  return good;
}

static void
add_arguments (GimpProcedure *procedure)
{
  celd_file_add_argument (procedure, _ ("The file to write. The ending of its name is its kind: .glb (glTF) and .obj "
                                        "have parts with the drawing on them, .ply has coloured vertices, .stl is for "
                                        "printing"));
  celd_settings_add_arguments (procedure, CELD_FOR_MESH);
}

const CeldProcedure celd_mesh_procedure = {
  .name          = "plug-in-celdepth-relief-mesh",
  .menu_label    = N_ ("Relief _mesh..."),
  .blurb         = N_ ("Makes a model of rounded parts for 3D programs or for printing: glTF, OBJ, PLY or STL"),
  .help          = N_ ("Each part is inflated, and lies in front of those behind it; the drawing is on it. Layers are "
                       "found as by Pop-up."),
  .add_arguments = add_arguments,
  .run           = celd_run,
  .title         = N_ ("Relief mesh"),
  .file_ending   = "-relief.glb",
  .prepare       = prepare,
  .make          = make,
};
