/* Allocation with overflow checks; making, growing and clearing the records of celdepth.h.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifdef __linux__
#define _DEFAULT_SOURCE /* madvise */
#include <sys/mman.h>
#endif

#include "base/base.h"

#include <stdlib.h>

#define HUGE_PAGE ((uintptr_t) 2 << 20) /* bytes, of x86 and most ARM systems; on others it has less effect, or none */

/* Lets Linux use huge pages in a large block: each of the small ones costs a page fault when it is first used, an eighth
 * of the time of a pop-up of several megapixels in GEGL (measured).  Only those that are within the block, so that no
 * more memory is used than was asked for. */
static void *
advise_huge_pages (void *block, size_t bytes)
{
  uintptr_t first = ((uintptr_t) block + HUGE_PAGE - 1) & ~(HUGE_PAGE - 1);
  uintptr_t end   = ((uintptr_t) block + bytes) & ~(HUGE_PAGE - 1);

#ifdef MADV_HUGEPAGE
  if (block && first < end)
    (void) madvise ((void *) first, end - first, MADV_HUGEPAGE);
#else
  (void) first;
  (void) end;
#endif
  return block;
}

void *
celd_alloc (size_t count, size_t size)
{
  if (size && count > SIZE_MAX / size)
    return NULL;
  return advise_huge_pages (malloc (count && size ? count * size : 1), count * size);
}

void *
celd_alloc0 (size_t count, size_t size)
{
  if (size && count > SIZE_MAX / size)
    return NULL;
  return advise_huge_pages (calloc (count ? count : 1, size ? size : 1), count * size);
}

bool
celd_reserve (void *items, size_t count, size_t *capacity, size_t size)
{
  size_t room = 8;
  void  *grown;

  if (count <= *capacity)
    return true;
  while (room < count)
    {
      if (room > SIZE_MAX / 2)
        return false;
      room *= 2;
    }
  if (size && room > SIZE_MAX / size)
    return false;
  memcpy (&grown, items, sizeof grown); /* pointers to objects have one representation */
  grown = realloc (grown, room * size);
  if (!grown)
    return false;
  memcpy (items, &grown, sizeof grown);
  *capacity = room;
  return true;
}

void
celd_free (void *memory)
{
  free (memory);
}

CeldStatus
celd_plane_new (int width, int height, CeldPlane *plane)
{
  *plane = (CeldPlane) { width, height, (size_t) width, celd_alloc ((size_t) width * (size_t) height, sizeof (float)) };
  return plane->data ? CELD_OK : CELD_NO_MEMORY;
}

CeldStatus
celd_labels_new (int width, int height, CeldLabels *labels)
{
  *labels = (CeldLabels) {
    width, height, (size_t) width, celd_alloc0 ((size_t) width * (size_t) height, sizeof (uint32_t))
  };
  return labels->data ? CELD_OK : CELD_NO_MEMORY;
}

CeldStatus
celd_mask_new (int width, int height, CeldMask *mask)
{
  *mask = (CeldMask) { width, height, (size_t) width, celd_alloc0 ((size_t) width * (size_t) height, 1) };
  return mask->data ? CELD_OK : CELD_NO_MEMORY;
}

CeldStatus
celd_ownership_new (int width, int height, CeldOwnership *own)
{
  CeldOwnership made = { 0 };
  CeldStatus    status = celd_labels_new (width, height, &made.owner);

  if (status == CELD_OK)
    status = celd_labels_new (width, height, &made.under);
  if (status == CELD_OK)
    status = celd_plane_new (width, height, &made.coverage);
  if (status == CELD_OK)
    *own = made;
  else
    celd_ownership_clear (&made);
  return status;
}

void
celd_ownership_clear (CeldOwnership *own)
{
  celd_free (own->owner.data);
  celd_free (own->under.data);
  celd_free (own->coverage.data);
  *own = (CeldOwnership) { 0 };
}

CeldStatus
celd_problem_add (CeldProblems *problems, CeldProblem problem)
{
  if (!problems)
    return CELD_OK;
  return celd_append_uncounted (problems->item, problems->n, problem);
}

CeldStatus
celd_problem_copy (const CeldProblems *from, size_t i, CeldProblems *to)
{
  const CeldProblem *item = &from->item[i];
  CeldProblem        copy = *item;
  CeldStatus         status;

  if (!to)
    return CELD_OK;
  if (!celd_reserve (&to->run, to->n_runs + item->runs, &(size_t) { 0 }, sizeof *to->run))
    return CELD_NO_MEMORY;
  copy.first = to->n_runs;
  status     = celd_problem_add (to, copy);
  for (size_t k = 0; k < item->runs && status == CELD_OK; k++)
    to->run[to->n_runs++] = from->run[item->first + k];
  return status;
}

CeldStatus
celd_relation_add (CeldRelations *relations, CeldRelation relation)
{
  return celd_append_uncounted (relations->item, relations->n, relation);
}

void
celd_palette_clear (CeldPalette *palette)
{
  celd_free (palette->item);
  *palette = (CeldPalette) { 0 };
}

void
celd_relations_clear (CeldRelations *relations)
{
  celd_free (relations->item);
  *relations = (CeldRelations) { 0 };
}

void
celd_problems_clear (CeldProblems *problems)
{
  celd_free (problems->item);
  celd_free (problems->run);
  *problems = (CeldProblems) { 0 };
}

static void
clear_cycles (CeldCycle *cycle, size_t n_cycles, CeldScc *scc, size_t n_sccs)
{
  for (size_t i = 0; i < n_cycles; i++)
    celd_free (cycle[i].item);
  for (size_t i = 0; i < n_sccs; i++)
    {
      celd_free (scc[i].item);
      celd_free (scc[i].newest.item);
    }
  celd_free (cycle);
  celd_free (scc);
}

void
celd_order_clear (CeldOrder *order)
{
  clear_cycles (order->cycle, order->n_cycles, order->scc, order->n_sccs);
  celd_free (order->level);
  celd_free (order->height);
  celd_free (order->links.first);
  celd_free (order->links.end);
  celd_free (order->links.equal);
  *order = (CeldOrder) { 0 };
}

void
celd_exact_clear (CeldExact *exact)
{
  clear_cycles (exact->cycle, exact->n_cycles, exact->scc, exact->n_sccs);
  celd_free (exact->node);
  *exact = (CeldExact) { 0 };
}

void
celd_closures_clear (CeldClosures *closures)
{
  for (size_t i = 0; i < closures->n; i++)
    celd_free (closures->item[i].place);
  celd_free (closures->item);
  *closures = (CeldClosures) { 0 };
}
