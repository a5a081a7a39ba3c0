/* Measures memory: the program is linked with --wrap, which calls the functions below instead of the C library's.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"

#include <malloc.h>
#include <stdlib.h>

void *__real_malloc (size_t size);
void *__real_calloc (size_t count, size_t size);
void *__real_realloc (void *memory, size_t size);
void  __real_free (void *memory);
void *__wrap_malloc (size_t size);
void *__wrap_calloc (size_t count, size_t size);
void *__wrap_realloc (void *memory, size_t size);
void  __wrap_free (void *memory);

static Memory memory;

static void *
taken (void *block)
{
  memory.live += malloc_usable_size (block);
  if (memory.live > memory.peak)
    memory.peak = memory.live;
  return block;
}

void *
__wrap_malloc (size_t size)
{
  return taken (__real_malloc (size));
}

void *
__wrap_calloc (size_t count, size_t size)
{
  return taken (__real_calloc (count, size));
}

void *
__wrap_realloc (void *block, size_t size)
{
  size_t before = malloc_usable_size (block);
  void  *grown = __real_realloc (block, size);

  if (grown)
    memory.live -= before;
  return grown ? taken (grown) : NULL;
}

void
__wrap_free (void *block)
{
  memory.live -= malloc_usable_size (block);
  __real_free (block);
}

void
memory_mark (void)
{
  memory.peak = memory.live;
}

Memory
memory_now (void)
{
  return memory;
}
