/* For all test programs of core: CHECK and NEAR, pictures written as text, and hosts.
 *
 * A test program is a list of functions `static void name (void)` and a main that RUNs them and returns DONE.
 * After a failed CHECK, which prints its place, the test continues, so that one failure does not hide the next.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CHECK_H
#define CHECK_H

#include "celdepth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int check_failed, check_passed;
static const char *check_name = "";

#define CHECK(fact) \
  do \
    { \
      if (fact) \
        break; \
      check_bad = 1; \
      fprintf (stderr, "%s:%d: %s: %s\n", __FILE__, __LINE__, check_name, #fact); \
    } \
  while (0)
#define NEAR(value, wanted, error) \
  do \
    { \
      double check_v = (double) (value), check_w = (double) (wanted); \
      if (fabs (check_v - check_w) <= (double) (error)) \
        break; \
      check_bad = 1; \
      fprintf (stderr, "%s:%d: %s: %s is %.9g, not %.9g\n", __FILE__, __LINE__, check_name, #value, check_v, check_w); \
    } \
  while (0)
#define RUN(test) \
  do { check_bad = 0; check_name = #test; test (); if (check_bad) check_failed++; else check_passed++; } while (0)
#define DONE (printf ("%d passed, %d failed\n", check_passed, check_failed), check_failed || !check_passed)

static int check_bad;

/* Text art: rows of equal length, ended by NULL. */
static inline int
art_width (const char *const *rows)
{
  return (int) strlen (rows[0]);
}

static inline int
art_height (const char *const *rows)
{
  int n = 0;

  while (rows[n])
    n++;
  return n;
}

/* '#' is ink 0, '.' and ' ' are paper 1, '0'-'9' tenths. */
static inline CeldPlane
art_plane (const char *const *rows)
{
  int       w = art_width (rows), h = art_height (rows);
  CeldPlane p = { w, h, (size_t) w, malloc ((size_t) w * (size_t) h * sizeof (float)) };

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        char c = rows[y][x];

        p.data[y * w + x] = c == '#' ? 0.f : c >= '0' && c <= '9' ? (float) (c - '0') / 10.f : 1.f;
      }
  return p;
}

/* 'A' is label 1, 'B' label 2, ...; '0'-'9' the number itself; anything else 0. */
static inline CeldLabels
art_labels (const char *const *rows)
{
  int        w = art_width (rows), h = art_height (rows);
  CeldLabels l = { w, h, (size_t) w, malloc ((size_t) w * (size_t) h * sizeof (uint32_t)) };

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        char c = rows[y][x];

        l.data[y * w + x] = c >= 'A' && c <= 'Z' ? (uint32_t) (c - 'A' + 1)
                          : c >= '0' && c <= '9' ? (uint32_t) (c - '0') : 0;
      }
  return l;
}

/* A small generator of reproducible numbers: 0 .. n-1. */
static inline uint32_t
check_random (uint32_t *state, uint32_t n)
{
  *state = *state * 1664525u + 1013904223u;
  return (uint32_t) (((uint64_t) (*state >> 8) * n) >> 24);
}

/* A sum of four uniform numbers: nearly normal, deviation 1. */
static inline float
check_noise (uint32_t *state)
{
  float sum = 0;

  for (int i = 0; i < 4; i++)
    sum += (float) check_random (state, 10001) / 10000 - 0.5f;
  return sum * 1.732f;
}

/* ------------------------------------------------------------------ hosts */

/* Progress that cancels at once. */
static inline bool
check_refuse (void *host, double done)
{
  (void) host;
  (void) done;
  return false;
}

/* Progress that cancels after as many reports as the int `host` says. */
static inline bool
check_count_down (void *host, double done)
{
  int *left = host;

  CHECK (done >= 0 && done <= 1);
  return (*left)-- > 0;
}

/* Progress that never decreases; the double `host` is that of the last report. */
static inline bool
check_rising (void *host, double done)
{
  double *last = host;

  CHECK (done >= *last && done <= 1);
  *last = done;
  return true;
}

/* Jobs in another order. */
static inline void
check_backwards (void *host, int n, void (*body) (void *data, int i), void *data)
{
  (void) host;
  while (n--)
    body (data, n);
}

#endif
