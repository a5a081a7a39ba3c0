/* What every file of core may use: memory, growable arrays, disjoint sets, access to pixels, progress and threads, the
 * reading of text.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_BASE_H
#define CELD_BASE_H

#include "celdepth.h"

#include <string.h>

#define CELD_PI      3.14159265358979323846
#define CELD_RADIANS (CELD_PI / 180) /* in a degree */

/* The inner product of two vectors of n numbers. */
static inline double
celd_dot (const double *a, const double *b, size_t n)
{
  double sum = 0;

  for (size_t i = 0; i < n; i++)
    sum += a[i] * b[i];
  return sum;
}

/* ------------------------------------------------------------------ memory.c */

/* All allocation in core goes through these and celd_reserve; NULL when count x size overflows or is
 * refused. */
void *celd_alloc (size_t count, size_t size);                 /* not cleared */
void *celd_alloc0 (size_t count, size_t size);                /* cleared */
void  celd_free (void *memory);                               /* accepts NULL */

/* New tight pictures (stride = width), owned by the caller, who frees .data with celd_free.  width and height > 0. */
CeldStatus celd_plane_new (int width, int height, CeldPlane *plane);       /* uninitialised */
CeldStatus celd_labels_new (int width, int height, CeldLabels *labels);    /* all 0 */
CeldStatus celd_mask_new (int width, int height, CeldMask *mask);          /* all 0 */

CeldStatus celd_ownership_new (int width, int height, CeldOwnership *own); /* labels 0, coverage uninitialised */
void       celd_ownership_clear (CeldOwnership *own);                      /* accepts a zeroed record */

/* Append one record.  Without a list of problems (NULL) nothing is to be reported, and the answer is CELD_OK. */
CeldStatus celd_problem_add (CeldProblems *problems, CeldProblem problem);
CeldStatus celd_problem_copy (const CeldProblems *from, size_t i, CeldProblems *to); /* with its paint */
CeldStatus celd_relation_add (CeldRelations *relations, CeldRelation relation);

/* Whether two ends of relations name the same colour or the same point of one drawing. */
static inline bool
celd_term_same (const CeldTerm *a, const CeldTerm *b)
{
  return a->by_colour == b->by_colour && !memcmp (a->colour, b->colour, 3) && a->x == b->x && a->y == b->y &&
         a->fragment == b->fragment && a->whole == b->whole;
}

/* ------------------------------------------------------------------ memory.c: growable arrays */

/* Items, their number and their capacity, which are members of one record or variables side by side.  All zero is an
 * empty array; the items end with celd_free.  Growth doubles the capacity, so that n appended items cost O(n).  Where a
 * capacity is not known, 0 is valid for an array of any length: the next item reallocates it then. */

/* Makes room for `count` items of a size; `items` is the address of the pointer to them.  False if memory is refused or
 * the size overflows: then all is as before. */
bool celd_reserve (void *items, size_t count, size_t *capacity, size_t size);

/* Makes room for one item more than n, of the type of the items. */
#define celd_reserve_one(items, n, capacity) \
  ((n) < (capacity) || celd_reserve (&(items), (n) + 1, &(capacity), sizeof *(items)))

/* Appends a value of the items' type and counts it: CELD_OK, or CELD_NO_MEMORY with all as before.  Evaluates its
 * arguments several times. */
#define celd_append(items, n, capacity, ...) \
  (celd_reserve_one (items, n, capacity) ? ((items)[(n)++] = __VA_ARGS__, CELD_OK) : CELD_NO_MEMORY)

/* For records that do not keep a capacity, as those of celdepth.h: each item reallocates them, so it is for rare
 * additions.  Never for an array whose capacity is kept, because it may shrink. */
#define celd_append_uncounted(items, n, ...) celd_append (items, n, (size_t) { 0 }, __VA_ARGS__)

/* ------------------------------------------------------------------ disjoint sets */

/* Sets of the numbers 0 .. n-1: union-find with path halving.  They are stored as one array, parent[k].  Of two joined
 * sets the smaller root becomes the root of both, so a root is the smallest number of its set, and parent[k] <= k. */

/* n sets of one number each. */
static inline void
celd_roots (uint32_t *parent, size_t n)
{
  for (size_t k = 0; k < n; k++)
    parent[k] = (uint32_t) k;
}

/* The root of the set that k is in; shortens paths on the way. */
static inline uint32_t
celd_root (uint32_t *parent, uint32_t k)
{
  while (parent[k] != k)
    k = parent[k] = parent[parent[k]];
  return k;
}

/* Makes one set of those of a and b. */
static inline void
celd_join (uint32_t *parent, uint32_t a, uint32_t b)
{
  a = celd_root (parent, a);
  b = celd_root (parent, b);
  if (a < b)
    parent[b] = a;
  else
    parent[a] = b;
}

/* ------------------------------------------------------------------ pictures */

/* Pixel (x,y) of any picture with one element a pixel. */
#define CELD_AT(view, x, y) ((view)->data[(size_t) (y) * (view)->stride + (size_t) (x)])

/* Pointer to the four components of pixel (x,y) of a CeldPaint or CeldColours. */
#define CELD_RGBA(view, x, y) ((view)->data + 4 * ((size_t) (y) * (view)->stride + (size_t) (x)))

/* Pointer to the three components of pixel (x,y) of a CeldVectors. */
#define CELD_XYZ(view, x, y) ((view)->data + 3 * ((size_t) (y) * (view)->stride + (size_t) (x)))

/* Whether two pictures have data, equal sizes, and sides of 1 .. CELD_MAX_SIDE pixels. */
#define CELD_SAME_SIZE(a, b) \
  ((a)->data && (b)->data && (a)->width == (b)->width && (a)->height == (b)->height && \
   (a)->width > 0 && (a)->height > 0 && (a)->width <= CELD_MAX_SIDE && (a)->height <= CELD_MAX_SIDE)

/* The bounding box of two rectangles; one of width 0 is empty. */
static inline CeldRect
celd_rect_union (CeldRect a, CeldRect b)
{
  int left, top, right, bottom;

  if (!a.width || !b.width)
    return a.width ? a : b;
  left   = a.x < b.x ? a.x : b.x;
  top    = a.y < b.y ? a.y : b.y;
  right  = a.x + a.width > b.x + b.width ? a.x + a.width : b.x + b.width;
  bottom = a.y + a.height > b.y + b.height ? a.y + a.height : b.y + b.height;
  return (CeldRect) { left, top, right - left, bottom - top };
}

/* ------------------------------------------------------------------ vectors */

/* In front of a static function that is a plain loop over pixels: compiles it for wider vectors as well; the version is
 * chosen when the library is loaded.  The function's name must be unique in core, since clang makes a global symbol of
 * it, and it must be called in its own file only.  Off with sanitizers, which are not ready when the choice is made. */
#if defined __has_feature
#if __has_feature (address_sanitizer) || __has_feature (undefined_behavior_sanitizer) \
  || __has_feature (thread_sanitizer)
#define CELD_CLONES
#endif
#endif
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
#define CELD_CLONES
#endif
#ifndef CELD_CLONES
#if defined __x86_64__ && defined __ELF__ && defined __GNUC__
#define CELD_CLONES __attribute__ ((target_clones ("avx2", "default")))
#else
#define CELD_CLONES
#endif
#endif

/* A hint that memory will be read soon. */
#if defined __GNUC__
#define CELD_PREFETCH(address) __builtin_prefetch (address)
#else
#define CELD_PREFETCH(address) ((void) (address))
#endif

/* The index of the first of the bytes x .. n - 1 whose top bit is set; n if there is none. */
static inline int
celd_next_marked (int n, const uint8_t *byte, int x)
{
  uint64_t eight;

  for (; x + 8 <= n; x += 8)
    {
      memcpy (&eight, byte + x, sizeof eight);
      eight &= 0x8080808080808080;
      if (!eight)
        continue;
#if defined __GNUC__ && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
      return x + __builtin_ctzll (eight) / 8;
#else
      break;
#endif
    }
  while (x < n && byte[x] < 0x80)
    x++;
  return x;
}

/* ------------------------------------------------------------------ host.c: progress and threads */

/* A host for a step that is the part [from,to] of a longer work with the host `whole`: its progress 0 .. 1 is reported
 * as from .. to.  `part` is storage that must live as long as the host returned.  With from = to the step reports no
 * progress of its own, but can still be cancelled and use threads; several short steps may share such a host. */
typedef struct { const CeldHost *whole; double from, to; } CeldHostPart;
CeldHost celd_host_part (CeldHostPart *part, const CeldHost *whole, double from, double to);

/* Reports that the fraction `done` in [0,1] is finished; CELD_CANCELLED if the host wants to stop, else CELD_OK. */
CeldStatus celd_progress (const CeldHost *host, double done);

/* Calls body (data, i) for all i = 0 .. n-1, in any order and on the host's threads if it lends any; returns when all
 * calls have. */
void celd_parallel_for (const CeldHost *host, int n, void (*body) (void *data, int i), void *data);

/* Runs n jobs in rounds of at most `at_once`, with a report of progress in [from,to] after each round; in a round,
 * body (data, i) is to do job *first + i.  CELD_CANCELLED as celd_progress. */
CeldStatus celd_parallel_rounds (const CeldHost *host, int n, int at_once, void (*body) (void *data, int i), void *data,
                                 int *first, double from, double to);

/* ------------------------------------------------------------------ messages.c: sentences for artists */

#define N_(text) text /* one that hosts translate, for xgettext */

/* The text in another language, for which `translate` may be NULL. */
const char *celd_in (CeldTranslate translate, const char *text) __attribute__ ((format_arg (2)));

/* ------------------------------------------------------------------ text.c: reading text */

/* The state of a reader. */
typedef struct
{
  const char    *at;           /* next byte of a text that ends with 0 */
  int            line, column; /* of that byte, both from 1 */
  CeldTextError *error;        /* may be NULL */
} CeldReader;

/* Steps over one byte, which must be ASCII and no line end.  Grammars are ASCII and reading stops at anything else, so
 * columns count characters. */
void celd_text_advance (CeldReader *r);

/* Line ends are \n, \r\n or \r.  The second function steps over one, which must be there. */
bool celd_text_at_line_end (const CeldReader *r);
void celd_text_skip_line_end (CeldReader *r);

/* Fills in *r->error, if not NULL, with the place, what was expected there and what stands there instead.  Returns
 * CELD_BAD_RELATION. */
CeldStatus celd_text_refuse (const CeldReader *r, const char *expected);

bool celd_text_is_digit (char c);
void celd_text_skip_blanks (CeldReader *r);               /* white space within a line */

/* Reads the number  [ "-" ] digits [ "." digits ],  where either group of digits may be missing but not both; with
 * `svg` also a "+" in front and an exponent behind, as in SVG path data.  The decimal point is "." in every locale.
 * CELD_BAD_RELATION, with `expected` in the error, if there is no number or its absolute value is 1e9 or more. */
CeldStatus celd_text_number (CeldReader *r, bool svg, const char *expected, double *number);

/* Reads items with `read_item (data, r)`, which stand in lines or between semicolons, up to the end of the text.
 * `expected` says what may follow an item. */
CeldStatus celd_text_items (const char *text, CeldStatus (*read_item) (void *data, CeldReader *r), void *data,
                            const char *expected, CeldTextError *error);

/* ------------------------------------------------------------------ stages of a session */

/* Each is made from earlier ones only, by session/stages.c; the table of settings names those that a setting
 * invalidates. */
typedef enum
{
  STAGE_RELATIONS,   /* all of the artist's in one list: text, path, painted arrows, single ones */
  STAGE_INK,         /* for segmentation, and for depth */
  STAGE_SCRIBBLES,   /* the seeds of the scribbles layer */
  STAGE_SEEDS,       /* with the single strokes over them */
  STAGE_LABELS,
  STAGE_SUGGESTIONS,
  STAGE_ORDER,
  STAGE_UNEXPANDED,  /* levels before expansion */
  STAGE_OWNERSHIP,
  STAGE_SHEETS,
  STAGE_LEVELS,      /* after expansion */
  STAGE_PREVIEW,     /* of smooth depth */
  STAGE_DEPTH,
  STAGE_NORMALS,
  STAGE_SHADING,
  STAGE_WEIGHTS,     /* of the exact program */
  STAGE_NODES,       /* of the exact program: the scribbles */
  STAGE_EXACT,
  N_STAGES
} CeldStage;

#endif
