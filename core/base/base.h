/* Memory, pixel access, and the progress and threads that the host lends: what every file of core uses.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_BASE_H
#define CELD_BASE_H

#include "celdepth.h"

#include <string.h>

#define CELD_PI 3.14159265358979323846

/* ------------------------------------------------------------------ memory.c */

/* All allocation in core goes through these and celd_reserve (vector.h); NULL when count x size overflows or is
 * refused. */
void *celd_alloc (size_t count, size_t size);                 /* not cleared */
void *celd_alloc0 (size_t count, size_t size);                /* cleared */
void  celd_free (void *memory);                               /* accepts NULL */

CeldStatus celd_plane_new (int width, int height, CeldPlane *plane);     /* not cleared; end with celd_free (data) */
CeldStatus celd_labels_new (int width, int height, CeldLabels *labels);  /* cleared */
CeldStatus celd_mask_new (int width, int height, CeldMask *mask);        /* cleared */

CeldStatus celd_ownership_new (int width, int height, CeldOwnership *own); /* labels cleared, coverage not */
void       celd_ownership_clear (CeldOwnership *own);                     /* also what was made by half */

CeldStatus celd_problem_add (CeldProblems *problems, CeldProblem problem); /* problems NULL: nothing to do */
CeldStatus celd_relation_add (CeldRelations *relations, CeldRelation relation);

static inline bool
celd_term_same (const CeldTerm *a, const CeldTerm *b)
{
  return a->by_colour == b->by_colour && !memcmp (a->colour, b->colour, 3) && a->x == b->x && a->y == b->y;
}

/* ------------------------------------------------------------------ views */

/* The pixel (x,y) of any view that has one element a pixel. */
#define CELD_AT(view, x, y) ((view)->data[(size_t) (y) * (view)->stride + (size_t) (x)])

/* First byte or float of the pixel (x,y) of a CeldPaint or CeldColours. */
#define CELD_RGBA(view, x, y) ((view)->data + 4 * ((size_t) (y) * (view)->stride + (size_t) (x)))

/* First float of the pixel (x,y) of a CeldVectors. */
#define CELD_XYZ(view, x, y) ((view)->data + 3 * ((size_t) (y) * (view)->stride + (size_t) (x)))

/* Are both views present, of a legal size, and equally large? */
#define CELD_SAME_SIZE(a, b) \
  ((a)->data && (b)->data && (a)->width == (b)->width && (a)->height == (b)->height && \
   (a)->width > 0 && (a)->height > 0 && (a)->width <= CELD_MAX_SIDE && (a)->height <= CELD_MAX_SIDE)

/* The smallest rectangle round both; one of width 0 is none. */
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

/* Before a static function, a plain loop over pixels: compiled for wider vectors too, and chosen when the library is
 * loaded.  Its name is unique in core, and it is called in its own file: clang makes the chosen one global under
 * another name.  The resolver runs before sanitizers are ready. */
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

/* Fetches what will be read soon. */
#if defined __GNUC__
#define CELD_PREFETCH(address) __builtin_prefetch (address)
#else
#define CELD_PREFETCH(address) ((void) (address))
#endif

/* The first of the bytes x .. n - 1 that has its top bit set; n if none has. */
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

/* ------------------------------------------------------------------ progress and threads (host.c) */

/* The part [from,to] of a longer run, as a run of its own: `part` must outlive it.  With from = to it reports no
 * progress, but cancels and lends threads: for short steps, of which several may share it. */
typedef struct { const CeldHost *whole; double from, to; } CeldHostPart;
CeldHost celd_host_part (CeldHostPart *part, const CeldHost *whole, double from, double to);

/* Reports progress; CELD_CANCELLED when the host wants to stop. */
CeldStatus celd_progress (const CeldHost *host, double done);

/* body (data, 0 .. n-1), on the host's threads if it lends any. */
void celd_parallel_for (const CeldHost *host, int n, void (*body) (void *data, int i), void *data);

/* n jobs in rounds of at most `at_once`, which is the part [from,to] of the run: body (data, i) is job *first + i. */
CeldStatus celd_parallel_rounds (const CeldHost *host, int n, int at_once, void (*body) (void *data, int i), void *data,
                                 int *first, double from, double to);

#endif
