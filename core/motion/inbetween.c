/* In-betweens of two keys.
 *
 *   1. each key as a puppet of completed layers; layers of one label are a part
 *   2. parts of both keys are matched: rigidly, then as rigidly as possible (part-match.c)
 *   3. parts of one key alone go behind others in the other key (part-hiding.c)
 *   4. between the keys the lattices are as rigid as possible (between-shape.c), and parts are drawn in the order of
 *      depth (between-draw.c)
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/inbetween.h"

/* Makes the parts: one for each label that has a layer in either key. */
static CeldStatus
list_parts (CeldInbetween *between)
{
  size_t most = between->key[0]->n + between->key[1]->n;

  between->part = celd_alloc0 (most, sizeof *between->part);
  for (int s = 0; s < 2; s++)
    {
      between->of_layer[s] = celd_alloc0 (between->key[s]->n, sizeof *between->of_layer[s]);
      between->flags[s]    = celd_alloc0 (between->key[s]->n, sizeof *between->flags[s]);
      if (!between->part || !between->of_layer[s] || !between->flags[s])
        return CELD_NO_MEMORY;
      for (size_t k = 0; k < between->key[s]->n; k++)
        {
          uint32_t label = between->key[s]->layer[k].label;
          size_t   p = 0;

          while (p < between->n && between->part[p].label != label)
            p++;
          if (p == between->n)
            between->part[between->n++] = (CeldBetweenPart) {
              .label = label, .layer = { CELD_NO_INDEX, CELD_NO_INDEX } };
          between->part[p].layer[s] = k;
          between->of_layer[s][k]   = &between->part[p];
        }
    }
  return CELD_OK;
}

/* Makes the puppets, and room for what is found of their vertices. */
static CeldStatus
make_puppets (CeldInbetween *between, const CeldKey key[2], const CeldSettings *settings, const CeldHost *host)
{
  CeldStatus status = CELD_OK;

  for (int s = 0; s < 2 && status == CELD_OK; s++)
    {
      CeldHostPart part;
      CeldHost     one = celd_host_part (&part, host, 0.5 * s, 0.5 * (s + 1));
      size_t       n;

      status = celd_puppet_new (key[s].layers, key[s].ink, NULL, key[s].background, NULL, settings, &one,
                                &between->key[s]);
      if (status != CELD_OK)
        break;
      n = between->key[s]->lattice.n_vertices;
      between->end[s]   = celd_alloc (n, 2 * sizeof *between->end[s]);
      between->known[s] = celd_alloc0 (n, sizeof *between->known[s]);
      if (!between->end[s] || !between->known[s])
        status = CELD_NO_MEMORY;
    }
  if (status == CELD_OK)
    {
      between->carrier = celd_alloc0 (between->key[1]->lattice.n_vertices, sizeof *between->carrier);
      status = between->carrier ? CELD_OK : CELD_NO_MEMORY;
    }
  return status;
}

CeldStatus
celd_inbetween_new (const CeldKey key[2], const CeldSettings *settings, const CeldHost *host, CeldInbetween **result)
{
  CeldInbetween *between;
  CeldHostPart   part[3];
  CeldHost       first = celd_host_part (&part[0], host, 0, 0.2), second = celd_host_part (&part[1], host, 0.2, 0.95);
  CeldHost       third = celd_host_part (&part[2], host, 0.95, 1);
  CeldStatus     status;

  if (key[0].layers->width != key[1].layers->width || key[0].layers->height != key[1].layers->height)
    return CELD_BAD_SIZE;
  between = celd_alloc0 (1, sizeof *between);
  if (!between)
    return CELD_NO_MEMORY;
  between->width  = key[0].layers->width;
  between->height = key[0].layers->height;
  status = make_puppets (between, key, settings, &first);
  if (status == CELD_OK)
    status = list_parts (between);
  if (status == CELD_OK)
    status = celd_parts_match (between, key, settings, &second);
  if (status == CELD_OK)
    status = celd_parts_hide (between, key, &third);
  if (status == CELD_OK)
    status = celd_between_flags (between);
  if (status == CELD_OK)
    status = celd_shaping_new (between);
  if (status == CELD_OK)
    status = celd_progress (host, 1);
  if (status == CELD_OK)
    *result = between;
  else
    celd_inbetween_free (between);
  return status;
}

void
celd_inbetween_free (CeldInbetween *between)
{
  if (!between)
    return;
  for (int s = 0; s < 2; s++)
    {
      for (size_t k = 0; between->flags[s] && k < between->key[s]->n; k++)
        celd_free (between->flags[s][k]);
      celd_free (between->flags[s]);
      celd_free (between->of_layer[s]);
      celd_free (between->end[s]);
      celd_free (between->known[s]);
      celd_puppet_free (between->key[s]);
    }
  celd_free (between->part);
  celd_free (between->rest);
  celd_free (between->carrier);
  celd_shaping_free (between->shaping);
  celd_free (between);
}
