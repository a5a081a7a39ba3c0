/* celdepth: depth for hand-drawn cartoons, for batches and scripts.  Chooses the sub-command.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <locale.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <stdio.h>
#include <string.h>

static const CliCommand commands[] = {
  { "popup", CLI_POPUP, "DRAWING|LAYERED", "The whole route: regions, order, depth, normals and shading of a drawing.",
    "  celdepth popup bee.png --scribbles strokes.png --arrows arrows.png --depth depth.exr\n"
    "  celdepth popup bee.png --scribbles strokes.png --relations '#ff0000 > #0000ff' \\\n"
    "      --labels flat.png --levels levels.png --shading shading.png --report report.json\n"
    "  celdepth popup page.psd --depth depth.png     (layers: drawing, scribbles, arrows, contours)",
    cli_popup },
  { "segment", CLI_SEGMENT, "DRAWING|LAYERED", "Gives every pixel of a drawing to one of the scribbles.",
    "  celdepth segment bee.png --scribbles strokes.png --labels flat.png\n"
    "  celdepth segment bee.png --scribbles strokes.png --closures closures.png\n"
    "  celdepth segment bee.png --scribbles strokes.png --contours closures.png --labels flat.png", cli_segment },
  { "order", CLI_ORDER, "LABELS", "Orders regions by depth; contours still belong to whoever segmentation gave them.",
    "  celdepth order flat.png --arrows arrows.png --drawing bee.png --levels flat-levels.npy\n"
    "  celdepth order flat.png --relations '120,80 > 300,90; 300,90 > 10,10' --levels flat-levels.npy", cli_order },
  { "expand", CLI_EXPAND, "LEVELS", "Gives each contour to the region that drew it.",
    "  celdepth expand flat-levels.npy --drawing bee.png --regions flat.png --levels levels.npy", cli_expand },
  { "smooth", CLI_SMOOTH, "LEVELS", "Makes depth smooth except across contours between levels.",
    "  celdepth smooth levels.npy --drawing bee.png --anchors strokes.png --depth depth.exr", cli_smooth },
  { "shade", CLI_SHADE, "LEVELS", "Bends normals at the contours of expanded levels, and shades them.",
    "  celdepth shade levels.npy --drawing bee.png --normals normals.png --shading shading.png \\\n"
    "      --light-azimuth 45\n"
    "  celdepth shade levels.npy --drawing bee.png --art colours.png --shaded bee-lit.png --light-model toon \\\n"
    "      --specular 0.4 --rim-light 0.3\n"
    "  celdepth shade levels.npy --drawing walk.png --maps walk.png --grid 8x1", cli_shade },
  { "enhance", CLI_ENHANCE, "LEVELS", "Sets parts off against what is behind them, by soft shadows.",
    "  celdepth enhance levels.npy --art bee.png --enhanced popup.png\n"
    "  celdepth enhance levels.npy --shadow shadow.png --shadow-offset 0.01 --light-azimuth 45\n"
    "  celdepth enhance levels.npy --view view.png", cli_enhance },
  { "stereo", CLI_STEREO, "DRAWING|LAYERED", "The drawing as two eyes see it, from its layers and their depth.",
    "  celdepth stereo bee.png --scribbles strokes.png --arrows arrows.png --joined bee.png --stereo dubois\n"
    "  celdepth stereo bee.png --scribbles strokes.png --colours art.png --left left.png --right right.png \\\n"
    "      --disparity 0.03\n"
    "  celdepth stereo page.psd --joined page.mpo\n"
    "  celdepth stereo page.psd --views 45 --columns 5 --quilt page_qs5x9a0.75.png", cli_stereo },
  { "wiggle", CLI_WIGGLE, "DRAWING|LAYERED",
    "The camera moves before the drawing: depth at a glance, as GIF or PNG files.",
    "  celdepth wiggle bee.png --scribbles strokes.png --arrows arrows.png --output bee.gif\n"
    "  celdepth wiggle page.psd --path circle --frames 48 --output frames      (a folder of PNG files)", cli_wiggle },
  { "relief", CLI_RELIEF, "LEVELS", "Rounds the parts of a drawing, as heights or as a mesh to look at or to print.",
    "  celdepth relief levels.npy --drawing bee.png --depth depth.npy --height height.exr\n"
    "  celdepth relief levels.npy --drawing bee.png --colours art.png --mesh bee.glb\n"
    "  celdepth relief levels.npy --drawing bee.png --mesh bee.stl --bulge 0.3 --mesh-size 80", cli_relief },
  { "exact", CLI_EXACT, "DRAWING|LAYERED",
    "The smoothest depth that keeps every relation exactly, by the paper's quadratic program.",
    "  celdepth exact bee.png --scribbles strokes.png --arrows arrows.png --depth depth.exr\n"
    "  celdepth exact bee.png --relations '120,80 > 300,90 +2; 300,90 = 10,10' --depth depth.npy \\\n"
    "      --encoding rank --report report.json", cli_exact },
  { "layers", CLI_LAYERS, "DRAWING|LAYERED", "Cuts a drawing into one layer a region, each with its own ink, in order.",
    "  celdepth layers bee.png --scribbles strokes.png --arrows arrows.png --output bee.ora\n"
    "  celdepth layers bee.png --scribbles strokes.png --relations '120,80 > 300,90' --complete yes \\\n"
    "      --colours painted.png --output bee.exr --report report.json\n"
    "  celdepth layers page.psd --output layers      (a folder of PNG files)", cli_layers },
};

static void
print_help (FILE *where)
{
  fputs ("Usage: celdepth COMMAND ...\n\n"
         "Depth for hand-drawn cartoons from scribbles and arrows.\n\n"
         "Commands:\n", where);
  for (size_t i = 0; i < G_N_ELEMENTS (commands); i++)
    fprintf (where, "  %-8s %s\n", commands[i].name, commands[i].summary);
  fprintf (where, "\n'celdepth COMMAND --help' shows the options and examples of a command.\n"
                  "Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but relations contradicted each other.\n");
}

static int
run_command (const CliCommand *command, int argc, char **argv)
{
  CliOptions options;
  int        code = cli_options_parse (command, argc, argv, &options);

  if (code == CLI_DONE)
    code = command->run (&options);
  cli_options_clear (&options);
  return code;
}

int
main (int argc, char **argv)
{
  const char *word = argc > 1 ? argv[1] : "";

#ifdef __GLIBC__
  /* Pictures go back to the system when they are freed.  By itself glibc begins to keep large blocks, with holes
   * between them: 50 bytes a pixel. */
  mallopt (M_MMAP_THRESHOLD, 1 << 20);
#endif
  /* For file names only: numbers keep their point whatever the language. */
  setlocale (LC_CTYPE, "");
  if (!strcmp (word, "--help") || !strcmp (word, "-h") || !strcmp (word, "help"))
    {
      print_help (stdout);
      return CLI_DONE;
    }
  if (!strcmp (word, "--version"))
    {
      puts ("celdepth " CELDEPTH_VERSION);
      return CLI_DONE;
    }
  for (size_t i = 0; i < G_N_ELEMENTS (commands); i++)
    if (!strcmp (word, commands[i].name))
      {
        celd_io_fork_reader (); /* before there are threads */
        return run_command (&commands[i], argc - 1, argv + 1);
      }
  if (word[0])
    cli_say ("There is no command '%s'.", word);
  print_help (stderr);
  return CLI_USAGE;
}
