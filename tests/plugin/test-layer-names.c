/* Layers are known by their names in three languages; the colours offered for scribbles are told apart.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "layer-names.h"

static void
names_in_three_languages (void)
{
  static const struct { const char *name; CeldLayerRole role; } wanted[] = {
    { "Drawing", CELD_LAYER_DRAWING }, { "SCRIBBLES", CELD_LAYER_SCRIBBLES }, { "arrows", CELD_LAYER_ARROWS },
    { "Contours", CELD_LAYER_CONTOURS }, { "Corrections", CELD_LAYER_CORRECTIONS }, { "hidden", CELD_LAYER_HIDDEN },
    { "Zeichnung", CELD_LAYER_DRAWING }, { "KRITZELEIEN", CELD_LAYER_SCRIBBLES }, { "Pfeile", CELD_LAYER_ARROWS },
    { "Konturen", CELD_LAYER_CONTOURS }, { "Korrekturen", CELD_LAYER_CORRECTIONS }, { "Verdeckt", CELD_LAYER_HIDDEN },
    { "Kresba", CELD_LAYER_DRAWING }, { "\304\214m\303\241ranice", CELD_LAYER_SCRIBBLES },
    { "\305\240IPKY", CELD_LAYER_ARROWS }, { "sipky", CELD_LAYER_ARROWS }, { "S\314\214ipky", CELD_LAYER_ARROWS },
    { "Obrysy", CELD_LAYER_CONTOURS }, { "Opravy", CELD_LAYER_CORRECTIONS }, { "Skryt\303\251", CELD_LAYER_HIDDEN },
    { " Scribbles ", CELD_LAYER_SCRIBBLES }, { "scribbles.png", CELD_LAYER_SCRIBBLES }, { "Line Art", CELD_LAYER_DRAWING },
    { "Background", CELD_N_LAYERS }, { "", CELD_N_LAYERS }, { ".png", CELD_N_LAYERS }, { "Drawing with shadows", CELD_N_LAYERS },
    { "Scribbles copy", CELD_N_LAYERS }, { "\377", CELD_N_LAYERS },
  };

  for (size_t i = 0; i < G_N_ELEMENTS (wanted); i++)
    NEAR (celd_layer_role_of_name (wanted[i].name), wanted[i].role, 0);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    CHECK (celd_layer_role_of_name (celd_layer_role_name ((CeldLayerRole) role)) == (CeldLayerRole) role);
}

/* The first of two layers of a name counts; the drawing needs no name if it is the only other layer that is no group
 * and no result. */
static void
roles_by_names (void)
{
  static const CeldNamedLayer layer[] = {
    { "Notes", TRUE }, { "arrows", FALSE }, { "Kritzel", TRUE }, { "Scribbles", FALSE }, { "Ink", FALSE },
    { "Paper", FALSE },
  };
  int found[CELD_N_LAYERS], others;

  celd_layer_roles_find (layer, 5, found);
  NEAR (found[CELD_LAYER_ARROWS], 1, 0);
  NEAR (found[CELD_LAYER_SCRIBBLES], 2, 0);
  NEAR (found[CELD_LAYER_CONTOURS], -1, 0);
  NEAR (found[CELD_LAYER_DRAWING], -1, 0); /* "Scribbles" could be it */
  NEAR (celd_layer_roles_last (layer, 6, found, &others), 5, 0);
  NEAR (others, 3, 0);
  celd_layer_roles_find (layer + 3, 2, found);
  NEAR (found[CELD_LAYER_SCRIBBLES], 0, 0);
  NEAR (found[CELD_LAYER_DRAWING], 1, 0);
  celd_layer_roles_find (layer, 0, found);
  NEAR (found[CELD_LAYER_DRAWING], -1, 0);
  NEAR (celd_layer_roles_last (layer, 0, found, &others), -1, 0);
  NEAR (others, 0, 0);
}

/* A stroke of each colour with soft edges, on a transparent layer: each makes its own label, and nothing else does. */
static void
every_colour_is_a_label (void)
{
  enum { W = 26 * CELD_N_LABEL_COLOURS, H = 40 };
  uint8_t     *pixels = calloc (4 * W, H);
  uint32_t    *seeds = calloc (W, (size_t) H * sizeof *seeds);
  CeldPaint    paint = { W, H, W, pixels };
  CeldLabels   labels = { W, H, W, seeds };
  CeldPalette  palette = { 0 };
  CeldSettings settings = celd_settings ();

  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        uint32_t rgb = celd_label_colours[x / 26].rgb;
        double   away = hypot (x % 26 - 12.5, y - 19.5);
        uint8_t *p = pixels + 4 * (y * W + x);

        p[0] = (uint8_t) (rgb >> 16);
        p[1] = (uint8_t) (rgb >> 8);
        p[2] = (uint8_t) rgb;
        p[3] = (uint8_t) (255 * fmax (0, fmin (1, (10 - away) / 3)));
      }
  CHECK (celd_scribbles_read (&paint, &settings, NULL, &labels, &palette) == CELD_OK);
  NEAR (palette.n, CELD_N_LABEL_COLOURS, 0);
  for (size_t i = 0; i < palette.n; i++)
    {
      const uint8_t *c = palette.item[i].colour;
      bool           known = false;

      for (int k = 0; k < CELD_N_LABEL_COLOURS; k++)
        known = known || celd_label_colours[k].rgb == (uint32_t) (c[0] << 16 | c[1] << 8 | c[2]);
      CHECK (known);
    }
  celd_palette_clear (&palette);
  free (pixels);
  free (seeds);
}

int
main (void)
{
  RUN (names_in_three_languages);
  RUN (roles_by_names);
  RUN (every_colour_is_a_label);
  return DONE;
}
