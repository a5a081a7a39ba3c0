/* What the fuzz targets share: numbers drawn from the input of a target, and how a target fails.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef FUZZ_H
#define FUZZ_H

#include "celdepth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput (const uint8_t *data, size_t size);

/* Ends the program, by which libFuzzer keeps the input. */
#define FUZZ_CHECK(what) \
  do \
    if (!(what)) \
      { \
        fprintf (stderr, "%s:%d: not true: %s\n", __FILE__, __LINE__, #what); \
        abort (); \
      } \
  while (0)

/* The input that is left; zeros follow its end. */
typedef struct { const uint8_t *next, *end; } FuzzInput;

static inline uint8_t
fuzz_byte (FuzzInput *input)
{
  return input->next < input->end ? *input->next++ : 0;
}

/* 0 .. n - 1, n at most 65536. */
static inline int
fuzz_below (FuzzInput *input, int n)
{
  int number = fuzz_byte (input);

  if (n > 256)
    number = 256 * number + fuzz_byte (input);
  return number % n;
}

/* Between the two, in 256 steps. */
static inline float
fuzz_between (FuzzInput *input, float least, float most)
{
  return least + (most - least) * (float) fuzz_byte (input) / 255;
}

/* A float that nobody expects, or one of [0,1]. */
static inline float
fuzz_odd (FuzzInput *input)
{
  static const float odd[] = {
    0, -0.f, 1, -1, NAN, INFINITY, -INFINITY, 3.4e38f, -3.4e38f, 1e20f, -1e20f, 1e-38f, 1e-45f, 16777216,
    2147483648.f, 7,
  };
  int which = fuzz_below (input, 48);

  return which < 16 ? odd[which] : (float) (which - 16) / 31;
}

/* As text that ends with 0; to be freed. */
static inline char *
fuzz_text (const uint8_t *data, size_t size)
{
  char *text = malloc (size + 1);

  memcpy (text, data, size);
  text[size] = 0;
  return text;
}

#endif
