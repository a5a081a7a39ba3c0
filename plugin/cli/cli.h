/* What the files of the celdepth command share.
 *
 * Each sub-command is a file of its name: popup, segment, order, expand, smooth, shade, enhance, stereo, wiggle,
 * relief, exact, layers.  What they share:
 *
 *   cli.c       which sub-command              pictures.c  pictures in and out, colours through babl
 *   options*.c  the options of a sub-command   npy.c       numpy files
 *   input.c     a drawing and its layers       report.c    --report
 *   session.c   the same for a session         messages.c  sentences on stderr
 *   route.c     popup and segment              run.c       progress, cancel, timings
 *   step.c      order, expand, smooth, relief  threads.c   the cores of the machine
 *   scene.c     stereo and wiggle
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_CLI_H
#define CELDEPTH_CLI_H

#include "celdepth-io.h"
#include "celdepth.h"

#include <glib.h>

/* Exit codes; part of the command's interface. */
enum { CLI_DONE = 0, CLI_FAILED = 1, CLI_USAGE = 2, CLI_CONTRADICTED = 3 };

/* ------------------------------------------------------------------ options.c */

typedef enum
{
  CLI_POPUP = 1, CLI_SEGMENT = 2, CLI_ORDER = 4, CLI_EXPAND = 8, CLI_SMOOTH = 16, CLI_SHADE = 32,
  CLI_EXACT = 64, CLI_ENHANCE = 128, CLI_LAYERS = 256, CLI_STEREO = 512, CLI_RELIEF = 1024, CLI_WIGGLE = 2048
} CliSteps;

/* File names are NULL where not given. */
typedef struct
{
  CliSteps     step;
  char        *input;
  char        *drawing, *scribbles, *contours, *corrections, *arrows, *anchors, *depth_hint;
  char        *relations, *relations_file, *arrow_path;
  char        *labels, *closures, *suggestions, *suggested_arrows, *order, *levels, *depth, *normals, *shading, *report;
  char        *regions, *art, *enhanced, *shadow, *view, *left, *right, *stereo, *sequence, *quilt, *wiggle;
  char        *colours, *output, *light;
  char        *smooth_depth, *height, *mesh, *hints, *matcap, *shaded, *tone, *rim, *occlusion, *maps, *grid;
  char        *padding_text;
  int          grid_columns, grid_rows, padding; /* of --grid and --padding */
  int          views, columns, frames, fps, size;
  bool         quiet, directx, background_colour; /* was a background colour given? */
  CeldSettings settings;
  GPtrArray   *offered;    /* of options-settings.c: the options that are settings */
} CliOptions;

typedef struct
{
  const char *name;
  CliSteps    step;
  const char *input;       /* what its argument is called */
  const char *summary, *examples;
  const char *settings;    /* by name, with spaces between; "option=name" offers one under another name, "+name" one
                            * that is switched on by its option alone */
  const char *output;      /* the option of the usual output */
  void      (*begin) (CliOptions *options);  /* defaults of its own; NULL: none */
  bool      (*check) (CliOptions *options);  /* what must hold beside ranges, or says what does not; NULL: nothing */
  int       (*run) (const CliOptions *options);
} CliCommand;

/* CLI_DONE, or the exit code of the mistake, which was said.  `options` must be cleared in every case. */
int  cli_options_parse (const CliCommand *command, int argc, char **argv, CliOptions *options);
void cli_options_clear (CliOptions *options);

/* ------------------------------------------------------------------ messages.c */

/* "celdepth: ..." on stderr. */
void cli_say (const char *format, ...) G_GNUC_PRINTF (1, 2);
/* The same; false, for `return cli_error (...)`. */
bool cli_error (const char *format, ...) G_GNUC_PRINTF (1, 2);
/* Says why a step failed, unless it did not; is it CELD_OK? */
bool cli_check (CeldStatus status);
/* "3,4 > #ff0000 @2 !crack" as the grammar has it; free with g_free. */
char *cli_relation_text (const CeldRelation *relation);
/* All but contradictions; a few of them if there are many. */
void cli_say_problems (const CeldProblems *problems, const CeldPalette *palette, const CeldRelations *relations);

/* ------------------------------------------------------------------ run.c, threads.c */

typedef struct CliThreads CliThreads;

typedef struct { const char *stage; double seconds; } CliTiming;

/* The command's CeldHost: a bar on stderr, cancelled by SIGINT, with the time that each stage took. */
typedef struct
{
  CeldHost    host;
  GArray     *timings;     /* CliTiming */
  gint64      began;       /* of the stage, in microseconds */
  gint64      drawn;       /* when the bar was drawn last; 0 = there is no bar on the screen */
  bool        visible;
  CliThreads *threads;
} CliRun;

void cli_run_begin (CliRun *run, bool quiet);
/* The next stage begins, the one before is over; NULL: all stages are over. */
void cli_run_stage (CliRun *run, const char *stage);
/* All stages are over: says why they failed, or that they were cancelled; is neither so? */
bool cli_run_finish (CliRun *run, CeldStatus status);
void cli_run_end   (CliRun *run);
bool cli_run_cancelled (void);

CliThreads *cli_threads_new  (void);                     /* NULL: there is one core only */
void        cli_threads_free (CliThreads *threads);      /* accepts NULL */
void        cli_threads_each (CliThreads *threads, int n, void (*body) (void *data, int i), void *data);

/* ------------------------------------------------------------------ pictures.c, npy.c */

bool cli_read_drawing (CeldIoFile *file, size_t part, CeldDrawing *drawing);
bool cli_read_paint   (CeldIoFile *file, size_t part, CeldPaint *paint);
/* Colours of a part, linear light or encoded as sRGB; and a picture's first part, in linear light.  Free data with
 * g_free. */
bool cli_read_part    (CeldIoFile *file, size_t part, bool linear, CeldColours *colours);
bool cli_read_colours (const char *path, CeldColours *colours);
bool cli_colours_new  (int width, int height, CeldColours *colours);
bool cli_read_levels  (const char *path, CeldPlane *levels);

bool cli_is_device     (const char *path); /* neither a file nor a folder: a terminal, a pipe, /dev/null */
bool cli_is_png        (const char *path);
bool cli_can_write     (const char *path);
bool cli_write_depth   (const char *path, const CeldPlane *depth, float nearest);
bool cli_write_labels  (const char *path, const CeldLabels *labels, const CeldPalette *palette);
bool cli_write_layer   (const char *path, const CeldPaint *layer);
bool cli_write_normals (const char *path, const CeldVectors *normals);
bool cli_write_shading (const char *path, const CeldPlane *shading);
bool cli_write_colours (const char *path, const CeldColours *colours);
bool cli_write_heights (const char *path, const CeldPlane *heights);
bool cli_write_mesh    (const char *path, const CeldReliefMesh *mesh, const CeldColours *art);
/* Numbers in [0,1], which no program should take for colours: of floats, or for a map in 8 bits with alpha. */
bool cli_write_values  (const char *path, const CeldPlane *values);
bool cli_write_map     (const char *path, const CeldColours *map);
/* n pixels from linear light to sRGB. */
void cli_encode        (const float *linear, int n, float *encoded);

bool cli_plane_new (int width, int height, CeldPlane *plane);   /* end with g_free (data) */
bool cli_labels_new (int width, int height, CeldLabels *labels);

bool cli_is_npy   (const char *path);
bool cli_npy_read (const char *path, CeldPlane *plane);
/* width x height x depth floats; depth 0: a plane without a third axis. */
bool cli_npy_write (const char *path, int width, int height, int depth, size_t row, const float *data);

/* ------------------------------------------------------------------ input.c */

typedef enum { CLI_DRAWING = 1, CLI_SCRIBBLES = 2, CLI_ARROWS = 4, CLI_CONTOURS = 8,
               CLI_CORRECTIONS = 16 } CliRoles;

/* data NULL where there is none. */
typedef struct
{
  int         width, height;
  CeldDrawing drawing;
  CeldPaint   scribbles, arrows, contours, corrections;
} CliLayers;

/* The layers of the wanted roles: from the files that the options name, else from the parts of `input` (may be NULL)
 * that bear the role's name.  All must be as large as the layers' width and height, where these are set before. */
bool cli_layers_read  (const char *input, const CliOptions *options, CliRoles wanted, CliLayers *layers);
void cli_layers_clear (CliLayers *layers);
/* Levels or depth of the size of the layers. */
bool cli_hint_read    (const char *path, const CliLayers *layers, CeldPlane *depth);
/* One picture: its part of that name, or else its first. */
bool cli_layer_read (const char *path, const char *role, CliLayers *layers, CeldPaint *paint);

/* The drawing of `input` in its colours; or if `path` is not NULL, the part "colours" of that file, or its first. */
bool cli_art_read (const char *input, const char *path, bool linear, CliLayers *layers, CeldColours *art);

/* The text of --relations or --relations-file; "" if neither is given, NULL if it cannot be read. */
char *cli_relations_text (const CliOptions *options);
/* What that text is called in messages. */
const char *cli_relations_name (const CliOptions *options);
/* Says where such a text, or an arrow path, cannot be read. */
bool cli_check_text (CeldStatus status, const char *name, const CeldTextError *error);

/* ------------------------------------------------------------------ report.c, messages.c */

/* What a sub-command found; NULL what it did not look for. */
typedef struct
{
  const char          *command;
  int                  width, height;
  const CeldPalette   *palette;
  const CeldRelations *relations, *suggestions;
  const CeldOrder     *order;
  const CeldProblems  *problems;
  const CeldClosures  *closures;
  const CeldLayers    *layers;
  const CeldExact     *exact;       /* with it, of `order` there are the cycles alone */
  const CeldSettings  *settings;
  const GArray        *timings;
} CliReport;

bool cli_report_write (const char *path, const CliReport *report);
/* Ends a sub-command that found an order: the report, if one is wanted, contradictions and remarks; the exit code. */
int  cli_tell (const CliOptions *options, const CliReport *report);

/* A text as a whole or not at all; to a device as it is. */
bool cli_write_text (const char *path, const char *text);
/* One relation a line. */
bool cli_write_relations (const char *path, const CeldRelations *relations);

/* ------------------------------------------------------------------ session.c, route.c */

/* Hands the input of the options over to the session, by way of the layers. */
bool cli_session_load (CeldSession *session, const CliOptions *options, CliLayers *layers);

/* Makes what the options ask for, up to the labels or as far as it goes; the exit code. */
int cli_run_route (const CliOptions *options, const char *command, bool whole_route);

/* ------------------------------------------------------------------ step.c */

/* Levels and the ink of their drawing. */
typedef struct
{
  CeldPlane levels, ink;
  CliLayers layers;
  CliRun    run;
} CliStep;

/* To be ended whatever it returns. */
bool cli_step_begin (const CliOptions *options, CliStep *step);
/* The exit code. */
int  cli_step_end   (CliStep *step, bool good);

/* Ink of the drawing for one purpose, with virtual contours; free data with g_free. */
bool  cli_make_ink (CliLayers *layers, CeldPurpose purpose, const CliOptions *options, CliRun *run, CeldPlane *ink);
/* The near end of levels whose encoding is not known: 1, or the largest rank. */
float cli_nearest_level (const CeldPlane *levels);

/* ------------------------------------------------------------------ shade.c */

#define CLI_MAPS 3
/* The file of a map for --maps: "hero_n.png" for "hero.png", then _o and _s; free with g_free. */
char *cli_map_name (const char *path, int map);

/* ------------------------------------------------------------------ scene.c */

/* A drawing to be seen from the side. */
typedef struct
{
  CeldSession        *session;
  CeldScene          *scene;
  CeldPlane           depth;       /* the session's, and so is the order */
  const CeldOrder    *order;
  const CeldSettings *settings;    /* borrowed from the options */
  CliRun             *run;
  int                 frames;
} CliScene;

/* To be cleared whatever it returns. */
bool cli_scene_new   (const CliOptions *options, CliRun *run, CliScene *s);
void cli_scene_clear (CliScene *s);
/* Views from the cameras of all frames, in a file or folder. */
bool cli_scene_write (const char *path, const CliScene *s, CeldCamera (*camera) (const CliScene *s, int frame),
                      int frames, const CliOptions *options);
/* The report and the remarks; the exit code. */
int  cli_scene_tell  (const CliOptions *options, const char *command, const CliScene *s);

/* ------------------------------------------------------------------ the sub-commands */

extern const CliCommand cli_popup_command, cli_segment_command, cli_order_command, cli_expand_command,
  cli_smooth_command, cli_shade_command, cli_enhance_command, cli_stereo_command, cli_wiggle_command,
  cli_relief_command, cli_exact_command, cli_layers_command;

#endif
