/* Names of layers, and colours for scribbles.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layer-names.h"

#include <glib/gi18n.h>
#include <string.h>

/* Folded as celd_layer_name_fold does; English first, then German and Czech; ended by NULL. */
static const char *const names[CELD_N_LAYERS][8] = {
  [CELD_LAYER_DRAWING]     = { "drawing", "line art", "lineart", "zeichnung", "linien", "kresba", "linky" },
  [CELD_LAYER_SCRIBBLES]   = { "scribbles", "scribble", "kritzeleien", "kritzel", "striche", "cmaranice", "tahy" },
  [CELD_LAYER_ARROWS]      = { "arrows", "arrow", "pfeile", "pfeil", "sipky", "sipka" },
  [CELD_LAYER_CONTOURS]    = { "contours", "contour", "konturen", "umrisse", "kontury", "obrysy" },
  [CELD_LAYER_CORRECTIONS] = { "corrections", "correction", "korrekturen", "korrektur", "opravy", "oprava" },
  [CELD_LAYER_HIDDEN]      = { "hidden", "verdeckt", "verdecktes", "verborgen", "skryte", "zakryte" },
};

static const char *const titles[CELD_N_LAYERS] = {
  [CELD_LAYER_DRAWING]  = "Drawing",  [CELD_LAYER_SCRIBBLES]   = "Scribbles",   [CELD_LAYER_ARROWS] = "Arrows",
  [CELD_LAYER_CONTOURS] = "Contours", [CELD_LAYER_CORRECTIONS] = "Corrections", [CELD_LAYER_HIDDEN] = "Hidden",
};

/* Farthest points in L*a*b* among colours of six steps a channel: each is at least 33 from every other one, and from
 * white, grey and black.  Strong colours come first. */
const CeldLabelColour celd_label_colours[CELD_N_LABEL_COLOURS] = {
  { 0xff0000, N_ ("Red") }, { 0x0000ff, N_ ("Blue") }, { 0x00ff00, N_ ("Green") }, { 0xffff00, N_ ("Yellow") },
  { 0xff00ff, N_ ("Magenta") }, { 0x00ccff, N_ ("Sky") }, { 0xff9900, N_ ("Orange") }, { 0x990099, N_ ("Purple") },
  { 0x00ffcc, N_ ("Aquamarine") }, { 0x993300, N_ ("Brown") }, { 0xff6666, N_ ("Coral") }, { 0x006699, N_ ("Petrol") },
  { 0x669900, N_ ("Moss") }, { 0x6666ff, N_ ("Cornflower") }, { 0xffff99, N_ ("Cream") }, { 0xff0099, N_ ("Pink") },
  { 0x339966, N_ ("Sea green") }, { 0xcc9966, N_ ("Sand") }, { 0xcc99ff, N_ ("Lilac") }, { 0x990033, N_ ("Crimson") },
  { 0x0099ff, N_ ("Azure") }, { 0x99ff66, N_ ("Lime") }, { 0x003399, N_ ("Navy") }, { 0xcc6699, N_ ("Mallow") },
};

char *
celd_layer_name_fold (const char *name)
{
  char   *decomposed = g_utf8_normalize (name, -1, G_NORMALIZE_ALL);
  char   *lower = g_utf8_casefold (decomposed ? decomposed : "", -1);
  GString *folded = g_string_new (NULL);
  char   *dot;

  for (const char *c = lower; *c; c = g_utf8_next_char (c))
    if (!g_unichar_ismark (g_utf8_get_char (c)))
      g_string_append_unichar (folded, g_utf8_get_char (c));
  dot = strrchr (folded->str, '.');
  if (dot && strlen (dot) <= 5)
    *dot = 0;
  g_free (decomposed);
  g_free (lower);
  return g_strstrip (g_string_free (folded, FALSE));
}

CeldLayerRole
celd_layer_role_of_name (const char *name)
{
  char         *folded = celd_layer_name_fold (name);
  CeldLayerRole found = CELD_N_LAYERS;

  for (int role = 0; role < CELD_N_LAYERS; role++)
    for (int i = 0; names[role][i]; i++)
      if (!strcmp (folded, names[role][i]))
        found = (CeldLayerRole) role;
  g_free (folded);
  return found;
}

const char *const *
celd_layer_role_names (CeldLayerRole role)
{
  return names[role];
}

const char *
celd_layer_role_name (CeldLayerRole role)
{
  return titles[role];
}

int
celd_layer_roles_last (const CeldNamedLayer *layer, int n, const int found[CELD_N_LAYERS], int *others)
{
  int last = -1, count = 0;

  for (int i = 0; i < n; i++)
    {
      gboolean other = !layer[i].needs_name;

      for (int role = 0; role < CELD_N_LAYERS; role++)
        other = other && found[role] != i;
      last   = other ? i : last;
      count += other;
    }
  if (others)
    *others = count;
  return last;
}

void
celd_layer_roles_find (const CeldNamedLayer *layer, int n, int found[CELD_N_LAYERS])
{
  int last, others;

  for (int role = 0; role < CELD_N_LAYERS; role++)
    found[role] = -1;
  for (int i = 0; i < n; i++)
    {
      CeldLayerRole role = celd_layer_role_of_name (layer[i].name);

      if (role < CELD_N_LAYERS && found[role] < 0)
        found[role] = i;
    }
  last = celd_layer_roles_last (layer, n, found, &others);
  if (found[CELD_LAYER_DRAWING] < 0 && others == 1)
    found[CELD_LAYER_DRAWING] = last;
}
