/* Functions that the files of the celdepth command share.
 *
 * Each sub-command is in a file of its name: popup, segment, order, expand, smooth, shade, enhance, stereo, wiggle,
 * relief, exact, layers, register, compose, propagate, deform, inbetween.  The other files:
 *
 *   cli.c       chooses the sub-command         pictures*.c reads and writes pictures
 *   options*.c  options of a sub-command        npy.c       reads and writes numpy files
 *   effects.c   options in vain                 outputs.c, endings.c  what may be written
 *   help.c      --help of a sub-command         streams.c   "-": standard input and output
 *   input.c     reads a drawing and its layers  text.c      relations as text, text files
 *   input-checks.c, picture-kinds.c  refuse what makes no sense
 *   session.c   sets a session's input          report.c    --report
 *   route.c     for popup and segment           messages.c  messages on stderr
 *   step.c      for order, expand, smooth,      run.c       progress, cancelling, timings
 *               relief                          threads.c   threads for loops of core
 *   scene.c     for stereo and wiggle           model.c     for relief
 *   uses.c      for popup                       maps.c      --maps, for shade and popup
 *   composition.c  for compose                  nearest-name.c  "Did you mean ...?"
 *   sequence.c  frames of a clip                clip.c      --clip
 *   clip-keys.c, clip-frame.c, review.c         for propagate; the first two also for inbetween
 *   pages.c     --output-dir: many pages        watch.c     --watch
 *   read-file.c, json.c  whole files
 *   fingerprint.c  what need not be made again  unfinished.c  files that are being written
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_CLI_H
#define CELDEPTH_CLI_H

#include "celdepth-io.h"
#include "celdepth.h"

#include <glib.h>

#include "presets.h"

/* Exit codes; part of the command's interface. */
enum { CLI_DONE = 0, CLI_FAILED = 1, CLI_USAGE = 2, CLI_CONTRADICTED = 3 };

/* ------------------------------------------------------------------ options.c */

typedef enum
{
  CLI_POPUP = 1, CLI_SEGMENT = 2, CLI_ORDER = 4, CLI_EXPAND = 8, CLI_SMOOTH = 16, CLI_SHADE = 32,
  CLI_EXACT = 64, CLI_ENHANCE = 128, CLI_LAYERS = 256, CLI_STEREO = 512, CLI_RELIEF = 1024, CLI_WIGGLE = 2048,
  CLI_REGISTER = 4096, CLI_COMPOSE = 8192, CLI_PROPAGATE = 16384,
  CLI_DEFORM = 32768, CLI_INBETWEEN = 65536
} CliSteps;

/* Where "-" stands for standard input or output; see streams.c. */
typedef struct
{
  char *folder, *output, *reader, *writer;
  bool  failed; /* standard input could not be read, or not kept: no wrong usage */
} CliStreams;

/* The values of all options.  Names of files, and texts, that are not given are NULL. */
typedef struct
{
  CliSteps     step;
  char        *input, *target, *clip;
  char        *drawing, *scribbles, *contours, *corrections, *hidden, *arrows, *depth_hint;
  char        *relations, *relations_file, *arrow_path;
  char        *labels, *closures, *suggestions, *suggested_arrows, *unexpanded, *levels, *depth, *normals, *shading, *report;
  char        *regions, *enhanced, *shadow, *view, *left, *right, *stereo, *sequence, *quilt, *wiggle;
  char        *colours, *output, *composed, *compositing, *layers;
  char        *source_levels, *displacement, *warped, *confidence;
  char        *second_scribbles, *second_arrows, *second_colours, *between; /* of inbetween */
  char        *handles, *handles_file, *handles_layer, *handle_keys, *deformed;
  char        *smooth_depth, *height, *mesh, *hints, *matcap, *shaded, *tone, *rim, *occlusion, *maps, *grid;
  char        *padding_text, *format;
  int          grid_columns, grid_rows, padding; /* of --grid and --padding */
  int          views, columns, frames, fps, size, jobs, part;
  char       **inputs, **keys, **key_scribbles, **key_arrows; /* of propagate */
  char       **command_line;  /* as it was given, without --emit-slurm */
  char        *labels_dir, *depth_dir, *emit_slurm, *review, *output_dir;
  bool         quiet, progress, directx, watch, help;
  CliStreams   streams;
  int          done_frames, frames_in_all; /* of a clip, for the progress bar; 0 in all: there is one input */
  bool         background_colour; /* whether a background colour was given */
  CeldSettings settings;
  GPtrArray   *offered;    /* the options that are settings, for options-settings.c */
  char        *preset_names; /* of --preset, as --help shows them */
  const CeldPreset *preset;  /* NULL: none was chosen */
} CliOptions;

typedef struct
{
  const char *name;
  CliSteps    step;
  const char *input, *second; /* names of its arguments in --help; second NULL: there is one */
  const char *summary, *examples;
  const char *settings;    /* names of settings, with spaces between */
  const char *output;      /* the output option that messages give as an example */
  void      (*begin) (CliOptions *options);  /* sets its own defaults; may be NULL */
  bool      (*check) (CliOptions *options);  /* checks beyond ranges; false with a message; may be NULL */
  int       (*run) (const CliOptions *options);
} CliCommand;

/* CLI_DONE, or another exit code after a message; with options->help there is nothing to do.  NULL stands behind the
 * words, as behind those of main; they are moved.  The caller clears `options` in either case. */
int  cli_options_parse (const CliCommand *command, int argc, char **argv, CliOptions *options);
void cli_options_clear (CliOptions *options);

/* The ending that an output has by default, such as "png"; NULL: the command has no such output. */
const char *cli_files_ending (const CliCommand *command, const char *option);
/* Appends the names of the files that are read, which stay those of the options. */
void  cli_files_inputs  (const CliOptions *options, GPtrArray *names);
/* A file's name with a number in place of its #, or else before its ending; free with g_free. */
char *cli_file_numbered (const char *name, int number);

/* outputs.c: whether two names stand for the same file, also by links. */
bool  cli_same_file     (const char *a, const char *b);

/* streams.c: copies the file for standard output there, finished or not; removes all files.  False with a message. */
bool cli_streams_write (CliStreams *streams);
void cli_streams_clear (CliStreams *streams);

/* ------------------------------------------------------------------ messages.c */

/* Prints "celdepth: ..." on stderr. */
void cli_say (const char *format, ...) G_GNUC_PRINTF (1, 2);
/* As cli_say, but returns false, for `return cli_error (...)`. */
bool cli_error (const char *format, ...) G_GNUC_PRINTF (1, 2);
/* Keeps messages from here on, and then shows or discards what was kept, if anything was. */
void cli_say_keep (void);
void cli_say_kept (bool show);
/* Begins messages with what they are about; NULL: with nothing.  Borrows the text. */
void cli_say_about (const char *what);
/* Leaves a folder out of the names in messages, and the endings of names in it; NULL: none.  Borrows the name. */
void cli_say_without (const char *folder);
/* A text of core in the language of the locale, a CeldTranslate: what is said about drawings. */
const char *cli_in_language (const char *text);
/* Whether a status is CELD_OK; if not, prints its text. */
bool cli_check (CeldStatus status);
/* Prints the contradictions of an order. */
void cli_say_cycles   (const CliOptions *options, const CeldOrder *order, const CeldRelations *relations);
/* Prints the first problems that are no contradictions; those of relations with the text of the options that has them,
 * if there are options. */
void cli_say_problems (const CliOptions *options, const CeldProblems *problems, const CeldPalette *palette,
                       const CeldRelations *relations);

/* nearest-name.c: the name in a list that ends with NULL that is most like a word; NULL if none is like it. */
const char *cli_nearest_name (const char *word, const char *const *names);

/* ------------------------------------------------------------------ run.c, threads.c */

typedef struct CliThreads CliThreads;

typedef struct { const char *stage; double seconds; } CliTiming;

/* The command's CeldHost: a progress bar of the whole work on stderr, cancelling by SIGINT, SIGTERM and SIGHUP, and the time of
 * each stage. */
typedef struct
{
  CeldHost    host;
  GArray     *timings;     /* CliTiming */
  gint64      began;       /* time when the stage began, in microseconds */
  gint64      drawn;       /* time when the bar was last drawn, or 0 */
  bool        visible;
  const char *stage;       /* NULL: none */
  char      **plan, **next; /* all stages, and those that are still to come */
  double      planned, before, length; /* expected seconds: of all stages, of those before this one, of this one */
  double      most;        /* the largest fraction that was shown */
  int         done_frames, frames; /* of a clip */
  CliThreads *threads;
} CliRun;

/* Whether a person, or a program that asks for it, looks at how far the work is. */
bool cli_progress_wanted (const CliOptions *options);
/* `stages` are the names of the stages that may come, in their order, with spaces between; "views*24": it takes
 * 24 times as long as usual. */
void cli_run_begin (CliRun *run, const CliOptions *options, const char *stages);
/* Removes the bar from the screen, before something else is printed there. */
void cli_bar_hide  (void);
/* Ends the current stage and begins another one; NULL: none. */
void cli_run_stage (CliRun *run, const char *stage);
/* Ends the current stage.  True if the status is CELD_OK and the run was not cancelled; if not, prints why. */
bool cli_run_finish (CliRun *run, CeldStatus status);
void cli_run_end   (CliRun *run);
bool cli_run_cancelled (void);

/* The variable of the environment that limits threads. */
#define CLI_THREADS_VARIABLE "CELDEPTH_THREADS"

CliThreads *cli_threads_new  (void);                     /* NULL: one thread is enough */
void        cli_threads_free (CliThreads *threads);      /* accepts NULL */
void        cli_threads_each (CliThreads *threads, int n, void (*body) (void *data, int i), void *data);

/* ------------------------------------------------------------------ pictures.c, pictures-write.c, npy.c */

/* A photograph is refused, with a message about `path`, unless the options say what the lines are, or that there are
 * none.  `painted` gets the colours of a coloured drawing. */
bool cli_read_drawing (CeldIoFile *file, size_t part, const char *path, const CliOptions *options, CeldDrawing *drawing,
                       CeldPaint *painted);
bool cli_read_paint   (CeldIoFile *file, size_t part, const char *path, CeldPaint *paint);
/* Colours of a part, in linear light or encoded as sRGB; and of the first part of a file, in linear light.  Free data
 * with g_free. */
bool cli_read_part    (CeldIoFile *file, size_t part, bool linear, CeldColours *colours);
bool cli_read_colours (const char *path, CeldColours *colours);
bool cli_colours_new  (int width, int height, CeldColours *colours);
bool cli_read_levels  (const char *path, CeldPlane *levels);

/* The name under which a file is written, to be renamed when it is complete; free with g_free. */
char *cli_unfinished_name   (const char *path);
/* Gives an unfinished file or folder its name: at once, or at the end of the run if files are held.  False: it could
 * not be done, for the reason in errno. */
bool  cli_file_complete     (const char *unfinished, const char *path);
/* Whether this run has written the folder; it is then written again, but for what others have put into it. */
bool  cli_file_owns         (const char *folder);
/* From here on files that are written stay unfinished until cli_files_end, so that they appear together. */
void  cli_files_hold        (void);
/* Completes them if the exit code is that of success, and else removes them; returns the code, or CLI_FAILED with a
 * message. */
int   cli_files_end         (int code);
/* Removes what runs that were killed left of a file.  No other process may be writing it. */
void  cli_remove_unfinished (const char *path);

/* Converts rows without padding in place, between linear light and encoded colours. */
void cli_convert_light (bool from_linear, bool to_linear, int width, int height, float *rgba);

bool cli_is_device     (const char *path); /* not a file or folder, but a terminal, a pipe, /dev/null */
bool cli_is_png        (const char *path);
bool cli_can_write     (const char *path);
bool cli_is_motion     (const char *path); /* a .gif, or a folder of frames */
bool cli_write_depth   (const char *path, const CeldPlane *depth, float nearest);
bool cli_write_labels  (const char *path, const CeldLabels *labels, const CeldPalette *palette);
bool cli_write_layer   (const char *path, const CeldPaint *layer);
bool cli_write_normals (const char *path, const CeldVectors *normals);
bool cli_write_shading (const char *path, const CeldPlane *shading);
bool cli_write_colours (const char *path, const CeldColours *colours);
/* Shifts in pixels, as two channels X and Y. */
bool cli_write_shifts  (const char *path, const CeldShifts *shifts);
bool cli_write_heights (const char *path, const CeldPlane *heights);
bool cli_write_meshes  (const char *path, const CeldIoMesh *mesh, size_t n, const CeldColours *art);
/* Numbers in [0,1] that are no colours: in .png 16 bits; maps in 8 bits with alpha. */
bool cli_write_values  (const char *path, const CeldPlane *values);
bool cli_write_map     (const char *path, const CeldColours *map);
/* Converts n pixels R,G,B,A from linear light to sRGB. */
void cli_encode        (const float *linear, int n, float *encoded);

/* New pictures; free data with g_free.  False, with a message, if there is no memory. */
bool cli_plane_new (int width, int height, CeldPlane *plane);
bool cli_labels_new (int width, int height, CeldLabels *labels);

bool cli_is_npy   (const char *path);
bool cli_npy_read (const char *path, CeldPlane *plane);
/* width x height x depth floats; depth 0: a plane without a third axis. */
bool cli_npy_write (const char *path, int width, int height, int depth, size_t row, const float *data);

/* ------------------------------------------------------------------ input.c */

typedef enum { CLI_DRAWING = 1, CLI_SCRIBBLES = 2, CLI_ARROWS = 4, CLI_CONTOURS = 8,
               CLI_CORRECTIONS = 16, CLI_HIDDEN = 32 } CliRoles;

/* data NULL where there is none. */
typedef struct
{
  int         width, height;
  CeldDrawing drawing;
  CeldPaint   colours; /* that the drawing was painted in; data NULL: it is grey */
  CeldPaint   scribbles, arrows, contours, corrections, hidden;
} CliLayers;

/* Reads the layers of the wanted roles, from the files that the options name, or else from the parts of `input` (may be
 * NULL) with the name of the role.  All must have the layers' width and height, if these are set before. */
bool cli_layers_read  (const char *input, const CliOptions *options, CliRoles wanted, CliLayers *layers);
void cli_layers_clear (CliLayers *layers);
/* Reads levels or depth of the size of the layers. */
bool cli_hint_read    (const char *path, const CliLayers *layers, CeldPlane *depth);
/* unknown-layers.c: false, with a message, if the regions come from layers of this file and it has none for them; says
 * which layers have nearly the name of one that is missing. */
bool cli_check_layer_names (const CeldIoFile *file, const char *path, const CliOptions *options, CliRoles wanted);
/* The part that is called so; of a layer that the artist paints, in German or Czech, too (layer-names.h).
 * CELD_NO_INDEX: there is none. */
size_t cli_find_part (const CeldIoFile *file, const char *name);
/* Reads one layer: the part with the role's name, or else the first part of the file. */
bool cli_layer_read (const char *path, const char *role, CliLayers *layers, CeldPaint *paint);

/* Reads the colours of the drawing in `input`, or if `path` is not NULL the part "colours" of that file, or else its
 * first part, and warns of such that show nothing. */
bool cli_art_read (const CliOptions *options, const char *input, const char *path, bool linear, CliLayers *layers,
                   CeldColours *art);

/* ------------------------------------------------------------------ input-checks.c, picture-kinds.c */

/* All print why and what to do instead if they are false. */
bool cli_check_different_files (const CliOptions *options);                  /* each layer has its own file */
bool cli_check_not_mixed_up    (const CliOptions *options, CliLayers *layers); /* the drawing and the scribbles */
bool cli_check_lines           (const char *path, const CeldPlane *ink);     /* there is ink, and paper */
bool cli_check_drawing         (const char *path, const CeldDrawing *drawing, bool quiet); /* no photograph */
bool cli_check_parts           (const char *path, const CeldPaint *art, bool quiet); /* the drawing is no levels */
bool cli_check_scribbles       (const char *path, const CeldPaint *scribbles); /* no photograph, arrows, levels */
bool cli_check_strokes         (const char *path, const char *role, const CeldPaint *paint); /* nor regions */
bool cli_check_no_drawings     (const CliOptions *options, const CliLayers *layers, const CeldPlane *ink);
bool cli_check_numbers         (const char *path, const CeldPlane *values);  /* all are finite */
bool cli_check_colours         (const char *path, int width, int height, const float *rgba); /* where they are seen */

/* ------------------------------------------------------------------ level-checks.c */

/* These, too. */
bool cli_check_grey     (const char *path);                           /* of depth or levels */
bool cli_check_levels   (const char *path, const CeldPlane *levels);  /* no photograph */
bool cli_check_depth    (const char *path, const CeldPlane *depth);   /* no photograph */
bool cli_check_regions  (const char *path, const CeldLabels *regions, const CeldPalette *palette); /* no photograph */
/* Warns of regions that are one colour, or look like something else, where there is no drawing to compare them with. */
bool cli_warn_of_regions (const char *path, const CeldLabels *regions);
/* That regions are not the drawing; warns of those that have its lines, too. */
bool cli_check_regions_of (const char *path, const CeldLabels *regions, const CeldPalette *palette, const char *drawing,
                           const CeldPlane *ink, bool quiet);
/* Rounds colours to bytes; free data, NULL if there is no memory, with g_free. */
CeldPaint cli_paint_of (const CeldColours *picture);
/* Whether a drawing is scribbles; false if there is no memory. */
bool cli_find_scribbles (const CliLayers *layers, bool *are);
/* That of two drawings not just one is scribbles. */
bool cli_check_alike (const CliOptions *options, const CliLayers *first, const CliLayers *second);
/* That contours have not the lines of the drawing, before they are drawn into it; warns of some that change nothing. */
bool cli_check_contours (const char *path, const CliOptions *options, const CliLayers *layers);
/* Warns of art that is blank, or levels; false if there is no memory. */
bool cli_warn_of_art (const char *path, const CeldColours *art, bool linear);
/* Warns of a file for scribbles that is blank beside arrows. */
void cli_warn_of_blank_scribbles (const CliOptions *options, const CliLayers *layers);
/* Warns of a matcap that is blank, or no square. */
bool cli_warn_of_matcap (const char *path, const CeldColours *matcap);
/* That the drawing of levels, or of regions, is no scribbles; warns if it is that of another page. */
bool cli_check_region_steps (const char *path, const CeldLabels *regions, const CliOptions *options,
                             const CliLayers *layers, const char *drawing, const CeldPlane *ink);
bool cli_check_steps (const char *path, const CeldPlane *levels, const CliOptions *options, const CliLayers *layers,
                      const char *drawing, const CeldPlane *ink);
/* That levels or depth are no drawing, whichever. */
bool cli_check_not_drawn (const char *path, const CeldPlane *levels);
/* The same, and that they have not the lines of this drawing, by its ink or brightness; the second one only warns of
 * these. */
bool cli_check_no_lines (const char *path, const CeldPlane *levels, const char *drawing, const CeldPlane *ink);
bool cli_warn_of_lines  (const char *path, const CeldPlane *levels, const char *drawing, const CeldPlane *ink);
bool cli_check_not_exchanged (const CliOptions *options, const CeldPlane *levels, CliLayers *layers); /* with the drawing */
bool cli_check_not_art  (const char *path, const char *art);          /* that levels are no copy of the art */
bool cli_check_hint     (const char *path, const CeldPlane *depth, bool quiet); /* not blank; warns of photographs */
void cli_warn_if_flat   (const char *path, const CeldPlane *levels);  /* that all levels are the same */

/* ------------------------------------------------------------------ read-file.c */

#define CLI_MOST_TEXT ((gsize) 64 << 20) /* bytes of a text file (chosen) */

/* All bytes of a file, at most so many, with a NUL behind them; NULL with a message, unless `quiet`.  Free with
 * g_free. */
char *cli_file_read (const char *path, gsize most, bool quiet, gsize *length);
/* What an errno says of a file, mostly in words of the system; and why a file or folder cannot be read. */
const char *cli_file_reason (int code);
const char *cli_file_problem (const char *path);

/* ------------------------------------------------------------------ text.c, texts that are given */

/* The text of the file, or if `path` is NULL `given`; "" if neither is given, NULL, with a message, if it cannot be
 * read. */
char *cli_text_or_file (const char *given, const char *path);
/* The text of --relations, and below it that of --relations-file; "" if neither is given, NULL, with a message, if it
 * cannot be read. */
char *cli_relations_text (const CliOptions *options);
/* The name of what a line of that text is in, and the number of the line there. */
const char *cli_relations_place (const CliOptions *options, int *line);
/* Whether a status is CELD_OK; if not, prints where the text, or the arrow path, cannot be read; for relations also in
 * which text. */
bool cli_check_text (CeldStatus status, const char *name, const CeldTextError *error);
bool cli_check_relations (CeldStatus status, const CliOptions *options, const CeldTextError *error);
/* Whether relations, the arrow path and handles can be understood; texts that cannot be read are left for later. */
bool cli_texts_check (const CliOptions *options);

/* ------------------------------------------------------------------ report.c, messages.c */

/* The results of a sub-command; NULL: it does not make them. */
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
  const CeldExact     *exact;       /* if it is there, `order` has cycles only */
  const CeldSettings  *settings;
  const GArray        *timings;
} CliReport;

bool cli_report_write (const char *path, const CliReport *report);
/* Writes the report if --report is given, prints contradictions and problems, and returns the exit code. */
int  cli_finish (const CliOptions *options, const CliReport *report);

/* ------------------------------------------------------------------ text.c, texts that are written */

/* A relation in the grammar of docs/relations.md, such as "3,4 > #ff0000 @2 !crack", with the names of the drawings
 * that its ends are in (NULL: none); free with g_free. */
char *cli_relation_text (const CeldRelation *relation, const char *const *names);
/* Writes a text file completely or not at all; a device may get a part of it. */
bool cli_write_text (const char *path, const char *text);
/* Writes one relation on each line. */
bool cli_write_relations (const char *path, const CeldRelations *relations);

/* ------------------------------------------------------------------ session.c, route.c */

/* Reads the input that the options name, and sets it in the session.  The caller clears `layers`. */
bool cli_session_load (CeldSession *session, const CliOptions *options, CliLayers *layers);

/* Makes and writes the results that the options ask for: labels, or with whole_route all of them.  The exit code. */
int cli_run_route (const CliOptions *options, const char *command, bool whole_route);

/* ------------------------------------------------------------------ step.c */

/* A run over levels, with the ink of their drawing. */
typedef struct
{
  CeldPlane levels, ink, borders; /* borders: see cli_step_borders */
  CliLayers layers;
  CliRun    run;
} CliStep;

/* Reads levels and drawing, and makes ink.  The caller calls cli_step_end in either case. */
bool cli_step_begin (const CliOptions *options, CliStep *step);
/* The ink for segmentation, which tells where blue contours keep depth smooth; NULL without contours. */
const CeldPlane *cli_step_borders (const CliStep *step);
/* The colours that the drawing was painted in; NULL if it is grey. */
const CeldPaint *cli_step_colours (const CliStep *step);
/* Reads the regions that the options name; free data with g_free. */
bool cli_step_regions (const CliOptions *options, CliStep *step, CeldLabels *regions, CeldPalette *palette);
/* The exit code. */
int  cli_step_end   (CliStep *step, bool good);

/* Reads regions as flat colours, as segment writes them; free data with g_free. */
bool cli_regions_read (const char *path, CliLayers *layers, CeldLabels *regions, CeldPalette *palette);
/* Makes the ink of the drawing for one purpose, with virtual contours; free data with g_free. */
bool  cli_make_ink (CliLayers *layers, CeldPurpose purpose, const CliOptions *options, CliRun *run, CeldPlane *ink);
/* The nearest level if the encoding is unknown: 1, or the largest level if that is more. */
float cli_nearest_level (const CeldPlane *levels);

/* ------------------------------------------------------------------ layers.c */

/* The label of the background; 0: there is none. */
uint32_t cli_page_of (const CeldPalette *palette);

/* ------------------------------------------------------------------ maps.c */

#define CLI_MAPS 3

/* Maps of normals, occlusion and highlights. */
typedef struct { CeldColours map[CLI_MAPS]; } CliMaps;

/* The name of a map for --maps: "hero_n.png", "hero_o.png", "hero_s.png" for "hero.png"; free with g_free. */
char *cli_map_name (const char *path, int map);

/* Reads a whole number at *text, and moves *text after it; false if there is none from `least` to `most`. */
bool cli_number_read (const char **text, int least, int most, int *number);

/* Whether --maps and --padding have values that make sense; if not, prints why. */
bool cli_maps_check (CliOptions *options);

/* Copies normals; free data with g_free. */
bool cli_normals_copy (const CeldVectors *normals, CeldVectors *copy);
/* Lets green in normals point down (--directx). */
void cli_normals_down (CeldVectors *normals);

/* Maps of a picture, or of one cell of it, from its art in linear light, normals and occlusion.  The caller clears them
 * in any case. */
bool       cli_maps_new   (int width, int height, CliMaps *maps);
CeldStatus cli_maps_make  (const CliOptions *options, const CeldColours *art, const CeldVectors *normals,
                           const CeldPlane *occlusion, const CeldHost *host, CliMaps *maps);
bool       cli_maps_write (const char *path, const CliMaps *maps);
void       cli_maps_clear (CliMaps *maps);

/* ------------------------------------------------------------------ layers.c */

/* The name of a label's layer: its colour, and its number if several labels have that colour; free with g_free. */
char *cli_layer_name (const CeldPalette *palette, uint32_t label);
/* Whether --compositing has a value that fits the output; if not, prints why. */
bool  cli_compositing_check (CliOptions *options);
/* Whether a file of layers gets linear light: `compositing` is the value of --compositing, or NULL. */
bool  cli_layers_are_linear (const char *path, const char *compositing);
/* Makes the layers of a session with art in that light, and writes them.  Converts the art, and the caller frees
 * *layers, in either case. */
bool  cli_layers_write (const char *path, CeldSession *session, bool linear, CeldColours *art, CliRun *run,
                        CeldLayers **layers);

/* ------------------------------------------------------------------ scene.c */

/* A drawing that can be viewed from other places. */
typedef struct
{
  CeldSession        *session;
  CeldLayers         *layers;
  CeldScene          *scene;       /* of the layers */
  CeldPlane           depth;       /* a copy, since the session's pictures are dropped */
  const CeldOrder     *order;      /* the session's */
  const CeldRelations *relations;
  const CeldProblems  *problems;
  const CeldSettings *settings;    /* borrowed from the options */
  CliRun             *run;
  int                 frames;
} CliScene;

/* Makes a scene of the input that the options name.  The caller clears it in either case. */
bool cli_scene_new   (const CliOptions *options, CliRun *run, CliScene *s);
/* The same of a session that makes completed layers, with the settings and the run that the record has.  Frees the data
 * of the art, in linear light, as soon as the layers have it. */
bool cli_scene_make  (CeldColours *art, CliScene *s);
void cli_scene_clear (CliScene *s);
/* Frees what views are made from; there can be no others. */
void cli_scene_release (CliScene *s);
/* Writes the view of each frame's camera to a file or folder. */
bool cli_scene_write (const char *path, const CliScene *s, CeldCamera (*camera) (const CliScene *s, int frame),
                      int frames, const CliOptions *options);
/* Writes the report, prints messages, and returns the exit code. */
int  cli_scene_finish  (const CliOptions *options, const char *command, const CliScene *s);

/* ------------------------------------------------------------------ stereo.c */

/* Writes the views that the options name: of two eyes, as a quilt, as a sequence. */
bool cli_views_write (const CliOptions *options, CliScene *s);
/* Whether there are such options; and the stages of a run that makes them, or an animation, of a scene; free with
 * g_free. */
bool  cli_views_wanted (const CliOptions *options);
char *cli_views_stages (const CliOptions *options);

/* ------------------------------------------------------------------ wiggle.c */

#define CLI_WIGGLE_DISPARITY 0.05f /* of the width; more than in stereo, since motion alone has to show depth (chosen) */

/* Writes the animation that the options name, of a scene with that disparity. */
bool cli_wiggle_write (const CliOptions *options, CliScene *s);

/* ------------------------------------------------------------------ shade.c, enhance.c */

/* Write what the options name: --shaded, --tone and --rim; --enhanced, --shadow and --view.  The art, in linear light,
 * changes; its data may be missing if it is not wanted. */
bool cli_light_write   (const CliOptions *options, const CeldColours *tone, const CeldPlane *gloss, CeldColours *art);
bool cli_shadows_write (const CliOptions *options, const CeldPlane *levels, const CeldPlane *change, CeldColours *art);

/* ------------------------------------------------------------------ relief.c */

/* Writes --height and --mesh of a session with the settings of a model; a mesh needs the art, in encoded colours. */
bool cli_relief_write (CeldSession *session, const CliOptions *options, const CeldColours *art, CliRun *run);

/* ------------------------------------------------------------------ uses.c */

/* Writes the light, the shadows, the layers, the model and the views that the options name.  `art`, in linear light,
 * stays as it is, and has data only if a result needs it; the session's settings change. */
bool cli_uses_write (CeldSession *session, const CliOptions *options, const CeldColours *art, CliRun *run);

/* ------------------------------------------------------------------ deform-handles.c, deform-keys.c */

typedef struct { CeldHandleKey *item; size_t n; } CliHandleKeys;

/* Reads the handles that the options name: from text, a text file, a painted layer of the size of `layers`. */
bool cli_handles_read (const CliOptions *options, CliLayers *layers, CliRun *run, CeldHandles *handles);
/* Reads --keys. */
bool cli_handle_keys_read  (const char *path, CliHandleKeys *keys);
void cli_handle_keys_clear (CliHandleKeys *keys);

/* ------------------------------------------------------------------ deform-layers.c */

/* Writes a puppet in its pose, whose picture this is, as a file with one layer for each region; with `encode` colours
 * are converted from linear light, `picture` in place. */
bool cli_deformed_layers_write (const char *path, CeldPuppet *puppet, const CeldPalette *palette, bool encode,
                                CeldColours *picture, CliRun *run);

/* ------------------------------------------------------------------ model.c, relief.c */

/* The names of the meshes of labels 1 .. n, by colour and number; and of the labels of celd_layers_of_levels, with
 * regions (may be NULL: then by number) in their colours. */
char       **cli_model_names (const CeldPalette *palette);
char       **cli_model_names_of_regions (const CeldPlane *levels, const CeldLabels *regions, const CeldPalette *palette);
/* The settings with the kind of mesh that the file needs: solid parts for STL, for printing, and else surfaces. */
CeldSettings cli_model_settings (const CliOptions *options);
/* Takes over the names. */
bool         cli_model_write (const char *path, const CeldModel *model, char **name);

/* ------------------------------------------------------------------ the sub-commands */

extern const CliCommand cli_popup_command, cli_segment_command, cli_order_command, cli_expand_command,
  cli_smooth_command, cli_shade_command, cli_enhance_command, cli_stereo_command, cli_wiggle_command,
  cli_relief_command, cli_exact_command, cli_layers_command, cli_register_command, cli_compose_command,
  cli_propagate_command, cli_deform_command, cli_inbetween_command;

#endif
