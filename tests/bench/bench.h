/* Shared by the benchmarks, mostly by that of segmentation.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef BENCH_H
#define BENCH_H

#include "celdepth.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------ segmentation.c */

typedef struct
{
  CeldDrawing drawing;
  CeldPaint   scribbles, truth;
  int         width, height;
  size_t      n;
  int         runs, strokes, exact_strokes;
  bool        boost;
  const char *prefix;
} Case;

/* Labels and what they are about. */
typedef struct { uint32_t *label; CeldPalette palette; } Answer;

/* ------------------------------------------------------------------ memory.c */

/* Bytes that are allocated, as the C library rounds them, and the most there have been since memory_mark. */
typedef struct { size_t live, peak; } Memory;
void   memory_mark (void);
Memory memory_now (void);

/* ------------------------------------------------------------------ watch.c: calls within core */

/* Steps within core whose time is taken. */
typedef enum
{
  PART_READ,      /* scribbles as painted -> seeds */
  PART_BUILD,     /* basins */
  PART_SPILLS,
  PART_BACKGROUND,
  PART_GRAPH,
  PART_PARTITION, /* of PART_GRAPH, and wherever else a graph is parted */
  PART_WINDOWS,
  PART_CLOSURES,
  PART_PAINTING,
  PART_REPORT,
  N_PARTS
} Part;

extern const char *const part_name[N_PARTS];
extern double            part_seconds[N_PARTS];  /* since parts_reset */
void parts_reset (void);

/* The problem that method=exact last handed to celd_multiway, kept while `keep_problem`. */
typedef struct
{
  int       width, height;
  int32_t  *east, *south, *vote;
  uint32_t *seed, *order;
  size_t    n_labels;
} Problem;

extern bool    keep_problem;
extern Problem problem;
void problem_clear (void);

extern bool    use_boost;                 /* celd_maxflow is Boost's */

/* ------------------------------------------------------------------ figures.c */

double seconds (void);                    /* of processor time that the process has had */
void   must (CeldStatus status);          /* ends the program if something failed */
double median (double *value, int n);     /* sorts them */

/* Members of the JSON object that is printed.  Memory: bytes a pixel beyond the labels, kept and at most. */
void print_number (const char *name, double value);
void print_memory (const char *method, const Case *c, Memory before, Memory after);

/* ------------------------------------------------------------------ boost-cut.cc */

/* celd_maxflow, solved by Boost; *flow may be NULL. */
CeldStatus boost_maxflow (int width, int height, const int32_t *east, const int32_t *south, const int32_t *terminal,
                          uint8_t *side, int64_t *flow);

/* ------------------------------------------------------------------ pictures.c */

/* A file in the format PAM, one or four bytes a pixel, enlarged without blending; ends the program if it cannot. */
CeldPlane read_grey (const char *path);
CeldPaint read_colours (const char *path, int width, int height);
char     *read_text (const char *path);   /* a file of less than a megabyte; end with free */

/* ------------------------------------------------------------------ strokes.c */

typedef struct { int x, y; CeldMask mask; uint8_t colour[3]; double length; } Stroke;

/* Mean width of strokes: twice their area over their outline. */
double brush_width (const CeldPaint *scribbles);

/* 100 to 400 pixels along a slightly bent line from a random place, in a scribble's colour of the palette: always the
 * same ones after random_start.  End with celd_free (mask.data). */
void   random_start (void);
Stroke random_stroke (int width, int height, const CeldPalette *palette, double brush);

/* ------------------------------------------------------------------ energy.c */

/* The energy of a labelling, from the smoothness costs and the problem's seeds and data costs.  Hard seeds are not part
 * of it; *disobeyed is the number of those with another label. */
typedef struct { int32_t *east, *south; } Costs;
Costs   costs_of (const CeldPlane *ink, float threshold);
int64_t energy_of (const Costs *costs, const Problem *problem, const uint32_t *label, size_t *disobeyed);

/* ------------------------------------------------------------------ compare.c */

/* Whether the problem has these costs. */
void compare_costs (const Costs *costs);

/* Energies of two answers to the last problem, on how much white they agree, and who is right where they do not. */
void compare_print (const Case *c, const char *name, const CeldPlane *ink, const Costs *costs, const Answer *engine,
                    const Answer *exact);

void answer_keep (const Case *c, const char *name, const Answer *answer);  /* in a file, if the case wants that */
void answer_clear (Answer *answer);

#ifdef __cplusplus
}
#endif

#endif
