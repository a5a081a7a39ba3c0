/* The keys of a clip: frames with scribbles.  One palette and one order hold for the whole clip, so that the depth of a
 * region does not flicker.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "fingerprint.h"
#include "propagate.h"

#include <string.h>

/* ------------------------------------------------------------------ fingerprints */

/* Of the program, the settings and the files that a key is made from. */
static bool
take_fingerprint (const CliMotion *motion, const char *relations, CliKey *key)
{
  GChecksum *sum = cli_fingerprint_new (&motion->options->settings);

  g_checksum_update (sum, (const guchar *) relations, -1);
  key->fingerprint = cli_fingerprint_end (sum, cli_fingerprint_add_file (sum, motion->frames.frame[key->frame].path) &&
                                               cli_fingerprint_add_file (sum, key->scribbles) &&
                                               cli_fingerprint_add_file (sum, key->arrows));
  return key->fingerprint != NULL;
}

/* ------------------------------------------------------------------ labels and ink */

/* The label of the background; 0: there is none. */
static uint32_t
background_of (const CeldPalette *palette)
{
  for (size_t k = 0; k < palette->n; k++)
    if (palette->item[k].background)
      return (uint32_t) k + 1;
  return 0;
}

static CeldStatus
take_labels (CliMotion *motion, const CeldLabels *labels, const CeldPalette *palette, CliKey *key)
{
  CeldStatus status = cli_labels_new (labels->width, labels->height, &key->labels) ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_join_labels (labels, palette, &motion->palette, &key->labels);
  motion->background = background_of (&motion->palette);
  return status;
}

static bool
take_ink (const CeldPlane *ink, CliKey *key)
{
  bool good = cli_plane_new (ink->width, ink->height, &key->ink);

  for (int y = 0; good && y < ink->height; y++)
    memcpy (key->ink.data + (size_t) y * key->ink.stride, ink->data + (size_t) y * ink->stride,
            (size_t) ink->width * sizeof *ink->data);
  return good;
}

/* ------------------------------------------------------------------ relations */

/* Appends the relations of a key that are not there yet, one on each line, and to `list`. */
static void
take_relations (const CliMotion *motion, const CliKey *key, const CeldRelations *relations, GString *all, GArray *list)
{
  for (size_t i = 0; i < relations->n; i++)
    {
      CeldRelation relation = relations->item[i];
      char        *text, *line;

      if (!celd_relation_by_colour (&key->labels, &motion->palette, &relation))
        continue;
      text = cli_relation_text (&relation, NULL);
      line = g_strdup_printf ("%s\n", text);
      if (!strstr (all->str, line))
        {
          g_string_append (all, line);
          g_array_append_val (list, relation);
        }
      g_free (text);
      g_free (line);
    }
}

/* Orders the regions by the relations of all keys, as they stand in the text; `from` are those of the keys. */
static CeldStatus
make_order (CliMotion *motion, CliRun *run, const GArray *from)
{
  CeldStatus status = celd_relations_parse (motion->relations, &motion->list, NULL);

  if (status == CELD_OK)
    status = celd_order (&motion->key[0].labels, &motion->palette, &motion->list, NULL, &motion->options->settings,
                         &run->host, &motion->order, NULL);
  for (size_t i = 0; i < MIN (motion->list.n, from->len); i++)
    {
      const CeldRelation *relation = &g_array_index (from, CeldRelation, i);

      motion->list.item[i].source = relation->source;
      motion->list.item[i].line   = relation->line;
      motion->list.item[i].column = relation->column;
    }
  return status;
}

/* ------------------------------------------------------------------ reading */

static CeldStatus
make_key (CliMotion *motion, CeldSession *session, CliRun *run, CliKey *key, GString *relations, GArray *list)
{
  CeldLabels       labels;
  CeldPlane        ink;
  const CeldOrder *order;
  CeldStatus       status = celd_session_ink (session, &run->host, &ink, NULL);

  if (status == CELD_OK && !take_ink (&ink, key))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_session_labels (session, &run->host, &labels, NULL);
  if (status == CELD_OK)
    status = take_labels (motion, &labels, celd_session_palette (session), key);
  if (status == CELD_OK)
    status = celd_session_order (session, &run->host, &order);
  if (status == CELD_OK)
    take_relations (motion, key, celd_session_relations (session), relations, list);
  return status;
}

static bool
read_key (CliMotion *motion, CliRun *run, CliKey *key, GString *relations, GArray *list)
{
  CliOptions   options = *motion->options;
  CeldSession *session = celd_session_new ();
  CliLayers    layers = { .width = motion->width, .height = motion->height };
  bool         good;

  options.input     = motion->frames.frame[key->frame].path;
  options.scribbles = key->scribbles;
  options.arrows    = key->arrows;
  if (key->bare)
    options.relations = options.relations_file = NULL;
  good = cli_check (session ? CELD_OK : CELD_NO_MEMORY) && cli_session_load (session, &options, &layers);
  if (good)
    {
      motion->width  = layers.width;
      motion->height = layers.height;
    }
  cli_layers_clear (&layers);
  if (good)
    cli_run_stage (run, "keys");
  good = good && cli_run_finish (run, make_key (motion, session, run, key, relations, list));
  if (good)
    cli_say_problems (&options, celd_session_problems (session), celd_session_palette (session),
                      celd_session_relations (session));
  celd_session_free (session);
  return good;
}

bool
cli_keys_read (CliMotion *motion, CliRun *run)
{
  GString *relations = g_string_new (NULL);
  GArray  *list = g_array_new (FALSE, FALSE, sizeof (CeldRelation));
  bool     good = true;

  for (size_t i = 0; i < motion->n_keys && good; i++)
    good = read_key (motion, run, &motion->key[i], relations, list);
  motion->relations = g_string_free (relations, FALSE);
  for (size_t i = 0; i < motion->n_keys && good; i++)
    good = take_fingerprint (motion, motion->relations, &motion->key[i]);
  good = good && cli_check (make_order (motion, run, list));
  g_array_free (list, TRUE);
  return good;
}

void
cli_keys_clear (CliMotion *motion)
{
  for (size_t i = 0; i < motion->n_keys; i++)
    {
      g_free (motion->key[i].labels.data);
      g_free (motion->key[i].ink.data);
      g_free (motion->key[i].fingerprint);
    }
  g_free (motion->key);
  celd_palette_clear (&motion->palette);
  g_free (motion->relations);
  celd_relations_clear (&motion->list);
  celd_order_clear (&motion->order);
}
