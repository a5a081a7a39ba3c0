/* celdepth compose: puts regions of several drawings into one picture, in one order.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "composition.h"
#include "outputs.h"

#include <stdio.h>
#include <string.h>

/* One drawing, cut into layers. */
typedef struct
{
  CeldSession     *session;    /* it owns the labels, the palette, the order and the ink */
  CeldHandles      handles;    /* none: it is not deformed */
  CeldPoseReport   pose;
  CeldLayers      *layers;
  CeldLabels       labels;
  CeldPlane        ink;
  const CeldOrder *order;
} Drawing;

typedef struct
{
  const CliOptions *options;
  CliComposition    scene;
  CliRun            run;
  bool              linear;    /* are layers composited in linear light? */
  bool              stack;     /* are layers written? */
  Drawing          *drawing;
  char            **name;      /* of the drawings */
  CeldRelations     relations; /* between them */
  CeldProblems      problems;  /* of these */
  CeldComposition  *made;
  CeldColours       picture;
} Compose;

/* ------------------------------------------------------------------ the drawings */

/* Cuts a drawing that its handles deform. */
static CeldStatus
cut_deformed (const CeldColours *art, bool complete, CliRun *run, Drawing *d)
{
  CeldPuppet *puppet = NULL;
  CeldStatus  status = celd_session_puppet (d->session, art, &run->host, &puppet);

  cli_run_stage (run, "deformation");
  if (status == CELD_OK)
    status = celd_puppet_pose (puppet, d->handles.item, d->handles.n, &run->host, &d->pose);
  if (status == CELD_OK)
    status = celd_puppet_layers (puppet, complete, &run->host, &d->layers);
  celd_puppet_free (puppet);
  return status;
}

static CeldStatus
cut (const CeldColours *art, bool complete, CliRun *run, Drawing *d)
{
  CeldStatus status;

  cli_run_stage (run, "labels");
  status = celd_session_labels (d->session, &run->host, &d->labels, NULL);
  cli_run_stage (run, "order");
  if (status == CELD_OK)
    status = celd_session_order (d->session, &run->host, &d->order);
  cli_run_stage (run, "layers");
  if (status == CELD_OK)
    status = d->handles.n ? cut_deformed (art, complete, run, d)
                          : celd_session_layers (d->session, art, CELD_STORE_FLOAT, &run->host, &d->layers);
  if (status == CELD_OK)
    status = celd_session_ink (d->session, &run->host, &d->ink, NULL);
  return status;
}

/* Has messages say which drawing they are about, until cli_say_about (NULL).  Free the text then. */
static char *
begin_about (const Compose *c, const CliFragment *fragment)
{
  char *place = g_strdup_printf ("\"%s\", \"%s\"", c->scene.path, fragment->name);

  cli_say_about (place);
  return place;
}

static void
end_about (char *place)
{
  cli_say_about (NULL);
  g_free (place);
}

/* Reads the handles of a drawing; they cannot change its order. */
static bool
read_handles (Compose *c, const CliFragment *fragment, CliLayers *input, CeldHandles *handles)
{
  if (!cli_handles_read (&fragment->options, input, &c->run, handles))
    return false;
  for (size_t i = 0; i < handles->n; i++)
    if (handles->item[i].depth != 0)
      return cli_error ("Handles of a composition have no \"^\": relations say what is in front.");
  return true;
}

static bool
read_drawing (Compose *c, const CliFragment *fragment, Drawing *d)
{
  CliLayers   input = { 0 };
  CeldColours art = { 0 };
  char       *place = begin_about (c, fragment);
  bool        good;

  d->session = celd_session_new ();
  good = cli_check (d->session ? CELD_OK : CELD_NO_MEMORY) &&
         cli_session_load (d->session, &fragment->options, &input) &&
         read_handles (c, fragment, &input, &d->handles) &&
         cli_art_read (&fragment->options, fragment->options.input, fragment->options.colours, c->linear, &input, &art);
  cli_layers_clear (&input);
  good = good && cli_run_finish (&c->run, cut (&art, c->options->settings.complete, &c->run, d));
  g_free (art.data);
  end_about (place);
  return good;
}

/* Prints contradictions and problems of a drawing; the exit code. */
static int
report_drawing (const Compose *c, const CliFragment *fragment, const Drawing *d)
{
  char  text[1000];
  char *place = begin_about (c, fragment);
  int   code = cli_finish (&fragment->options, &(CliReport) {
    .palette   = celd_session_palette (d->session),
    .relations = celd_session_relations (d->session),
    .order     = d->order,
    .problems  = celd_session_problems (d->session),
  });

  celd_pose_text (&d->pose, cli_in_language, text, sizeof text);
  if (text[0] && !fragment->options.quiet)
    cli_say ("%s", text);
  end_about (place);
  return code;
}

/* ------------------------------------------------------------------ the composition */

static bool
read_relations (Compose *c)
{
  CeldTextError error;
  char         *where = g_strdup_printf ("The relations of \"%s\"", c->scene.path);
  CeldStatus    status = celd_fragment_relations_parse (c->scene.relations ? c->scene.relations : "",
                                                        (const char *const *) c->name, c->scene.n, &c->relations,
                                                        &error);
  bool          good = cli_check_text (status, where, &error);

  g_free (where);
  return good;
}

static CeldStatus
compose (Compose *c, int width, int height)
{
  CeldFragment *fragment = g_new0 (CeldFragment, c->scene.n);
  CeldHost     *host = &c->run.host;
  CeldStatus    status;

  for (guint i = 0; i < c->scene.n; i++)
    {
      const Drawing     *d = &c->drawing[i];
      const CeldPalette *palette = celd_session_palette (d->session);

      fragment[i] = (CeldFragment) { d->layers, d->order, cli_page_of (palette), c->scene.fragment[i].placement,
                                     &d->labels, palette, d->handles.n ? NULL : &d->ink };
    }
  cli_run_stage (&c->run, "compose");
  status = celd_compose (fragment, c->scene.n, &c->relations, width, height, host, &c->problems, &c->made);
  cli_run_stage (&c->run, "picture");
  if (status == CELD_OK)
    status = celd_composition_flatten (c->made, host, &c->picture);
  g_free (fragment);
  return status;
}

/* ------------------------------------------------------------------ writing */

/* Are the colours of the layers' file linear light? */
static bool
is_exr (const Compose *c)
{
  return celd_io_stack_kind (c->options->composed) == CELD_IO_EXR_PARTS;
}

static bool
paint (void *host, size_t layer, float *rgba)
{
  Compose        *c = host;
  const CeldRect *box = &celd_composition_item (c->made, layer)->box;
  CeldHost        quiet = { NULL, c->run.host.each, c->run.host.data };

  if (celd_composition_paint (c->made, layer, &quiet, rgba) != CELD_OK)
    return false;
  cli_convert_light (c->linear, is_exr (c), box->width, box->height, rgba);
  return c->run.host.progress (c->run.host.data, (double) layer / (double) celd_composition_count (c->made));
}

/* The layer of a composition that a layer of a drawing is; CELD_NO_INDEX: none. */
static size_t
layer_of (const Compose *c, size_t fragment, size_t layer)
{
  for (size_t i = 0; i < celd_composition_count (c->made); i++)
    if (celd_composition_item (c->made, i)->fragment == fragment && celd_composition_item (c->made, i)->layer == layer)
      return i;
  return CELD_NO_INDEX;
}

static CeldJoint
place_joint (const Compose *c, size_t fragment, const CeldJoint *joint)
{
  double place[2];

  celd_composition_map (c->made, fragment, joint->x, joint->y, place);
  return (CeldJoint) { joint->parent == CELD_NO_INDEX ? CELD_NO_INDEX : layer_of (c, fragment, joint->parent),
                       place[0], place[1] };
}

/* Describes the layers of one drawing. */
static CeldStatus
describe (const Compose *c, size_t f, CeldIoLayer *item, char **name)
{
  const Drawing     *d = &c->drawing[f];
  const CeldPalette *palette = celd_session_palette (d->session);
  CeldJoint         *joint = g_new0 (CeldJoint, celd_layers_count (d->layers));
  CeldStatus         status = celd_layers_joints (d->layers, cli_page_of (palette), joint);

  for (size_t i = 0; i < celd_composition_count (c->made); i++)
    {
      const CeldComposedLayer *layer = celd_composition_item (c->made, i);
      const CeldRegion        *region = &palette->item[layer->label - 1];
      char                    *of_label;

      if (layer->fragment != f)
        continue;
      of_label = cli_layer_name (palette, layer->label);
      name[i]  = g_strdup_printf ("%s %s", c->name[f], of_label);
      item[i]  = (CeldIoLayer) { .name = name[i], .box = layer->box, .label = layer->label, .level = layer->level,
                                 .background = region->background, .joint = place_joint (c, f, &joint[layer->layer]) };
      memcpy (item[i].colour, region->colour, sizeof item[i].colour);
      g_free (of_label);
    }
  g_free (joint);
  return status;
}

static bool
write_stack (Compose *c)
{
  size_t       n = celd_composition_count (c->made);
  CeldIoLayer *item = g_new0 (CeldIoLayer, n);
  char       **name = g_new0 (char *, n + 1);
  CeldIoStack  stack = { c->picture.width, c->picture.height, item, n, c->picture.data, paint, c };
  CeldIoError  error;
  CeldStatus   status = CELD_OK;
  bool         good;

  for (size_t f = 0; f < c->scene.n && status == CELD_OK; f++)
    status = describe (c, f, item, name);
  good = cli_check (status);
  cli_convert_light (c->linear, is_exr (c), c->picture.width, c->picture.height, c->picture.data);
  if (good && !celd_io_write_layers (c->options->composed, &stack, &error))
    good = error.text[0] ? cli_error ("%s", error.text)
                         : cli_check (cli_run_cancelled () ? CELD_CANCELLED : CELD_NO_MEMORY);
  g_strfreev (name);
  g_free (item);
  return good;
}

static bool
write_levels (Compose *c)
{
  const CeldSettings *s = &c->options->settings;
  CeldPlane           levels = { 0 };
  size_t              n = celd_composition_count (c->made), count = 1;
  bool                good = cli_plane_new (c->picture.width, c->picture.height, &levels) &&
                             cli_check (celd_composition_levels (c->made, &c->run.host, &levels));

  for (size_t i = 0; i < n; i++)
    count = MAX (count, celd_composition_item (c->made, i)->level + (size_t) 1);
  for (size_t p = 0; good && p < (size_t) levels.width * (size_t) levels.height; p++)
    levels.data[p] = celd_encode_level ((double) levels.data[p], (double) count, s);
  good = good && cli_write_depth (c->options->levels, &levels,
                                  s->encoding == CELD_ENCODING_RANK && count > 1 ? (float) (count - 1) : 1);
  g_free (levels.data);
  return good;
}

static bool
write_output (Compose *c)
{
  const char *output = c->options->composed;
  bool        good = true;

  cli_run_stage (&c->run, "writing");
  if (c->options->levels)
    good = write_levels (c);
  if (good && output && c->stack)
    good = write_stack (c);
  else if (good && output)
    {
      cli_convert_light (c->linear, true, c->picture.width, c->picture.height, c->picture.data);
      good = cli_write_colours (output, &c->picture);
    }
  cli_run_stage (&c->run, NULL);
  return good;
}

/* ------------------------------------------------------------------ the command */

static void
say_cycles (const Compose *c)
{
  size_t           n;
  const CeldCycle *cycle = celd_composition_cycles (c->made, &n);

  for (size_t i = 0; i < n; i++)
    {
      cli_say ("%s", cycle[i].n > 1
               ? "These relations contradict each other, or the order of a drawing; the first of them was left out:"
               : "This relation contradicts the order of a drawing, and was left out:");
      for (size_t k = 0; k < cycle[i].n; k++)
        {
          const CeldRelation *relation = &c->relations.item[cycle[i].item[k]];
          char               *text = cli_relation_text (relation, (const char *const *) c->name);

          fprintf (stderr, "    %s  (line %d, column %d)\n", text, relation->line, relation->column);
          g_free (text);
        }
    }
}

static int
finish (const Compose *c)
{
  int    code = CLI_DONE;
  size_t cycles;

  for (guint i = 0; i < c->scene.n; i++)
    {
      int of_drawing = report_drawing (c, &c->scene.fragment[i], &c->drawing[i]);

      code = MAX (code, of_drawing);
    }
  say_cycles (c);
  if (!c->options->quiet)
    cli_say_problems (NULL, &c->problems, NULL, &c->relations);
  celd_composition_cycles (c->made, &cycles);
  return cycles ? CLI_CONTRADICTED : code;
}

static bool
make (Compose *c)
{
  bool good = true;
  int  width, height;

  for (guint i = 0; i < c->scene.n && good; i++)
    good = read_drawing (c, &c->scene.fragment[i], &c->drawing[i]);
  if (!good)
    return false;
  width  = c->scene.width ? c->scene.width : c->drawing[0].labels.width;
  height = c->scene.height ? c->scene.height : c->drawing[0].labels.height;
  return cli_colours_new (width, height, &c->picture) && cli_run_finish (&c->run, compose (c, width, height));
}

/* Whether an output would replace a file of a drawing. */
static bool
check_outputs (const Compose *c)
{
  CliTouched touched;
  bool       good;

  cli_touched_begin (&touched);
  cli_touched_reads_all (&touched, c->options);
  for (guint i = 0; i < c->scene.n; i++)
    cli_touched_reads_all (&touched, &c->scene.fragment[i].options);
  good = cli_touched_writes_all (&touched, c->options);
  cli_touched_end (&touched);
  return good;
}

static int
run_compose (const CliOptions *options)
{
  CeldIoStackKind kind = options->composed ? celd_io_stack_kind (options->composed) : CELD_IO_NO_STACK;
  Compose         c = { .options = options, .stack = kind != CELD_IO_NO_STACK };
  int             code = CLI_FAILED;
  GString        *stages = g_string_new (NULL);
  bool            good = cli_composition_read (options->input, options, &c.scene);

  if (good && !check_outputs (&c))
    {
      good = false;
      code = CLI_USAGE;
    }
  c.linear  = kind == CELD_IO_EXR_PARTS || (options->compositing && !strcmp (options->compositing, "linear"));
  c.drawing = g_new0 (Drawing, c.scene.n);
  c.name    = g_new0 (char *, c.scene.n + 1);
  for (guint i = 0; i < c.scene.n; i++)
    c.name[i] = c.scene.fragment[i].name;
  for (guint i = 0; i < c.scene.n; i++)
    g_string_append (stages, "labels order layers ");
  g_string_append (stages, "compose picture writing");
  cli_run_begin (&c.run, options, stages->str);
  g_string_free (stages, TRUE);
  if (good && read_relations (&c) && make (&c) && write_output (&c))
    code = finish (&c);
  cli_run_end (&c.run);
  celd_composition_free (c.made);
  for (guint i = 0; i < c.scene.n; i++)
    {
      celd_handles_clear (&c.drawing[i].handles);
      celd_layers_free (c.drawing[i].layers);
      celd_session_free (c.drawing[i].session);
    }
  celd_relations_clear (&c.relations);
  celd_problems_clear (&c.problems);
  g_free (c.picture.data);
  g_free (c.drawing);
  g_free (c.name);
  cli_composition_clear (&c.scene);
  return code;
}

const CliCommand cli_compose_command = {
  .name     = "compose",
  .step     = CLI_COMPOSE,
  .input    = "SCENE.json",
  .summary  = "Puts drawings into one picture, where a part of one can lie between parts of another.",
  .examples = "  celdepth compose scene.json --output picture.png\n"
              "  celdepth compose scene.json --output scene.ora --complete yes --levels levels.exr\n"
              "  scene.json:\n"
              "      { \"fragments\": [\n"
              "          { \"name\": \"man\", \"drawing\": \"man.png\", \"scribbles\": \"man-strokes.png\",\n"
              "            \"arrows\": \"man-arrows.png\" },\n"
              "          { \"name\": \"rope\", \"drawing\": \"rope.png\", \"scribbles\": \"rope-strokes.png\",\n"
              "            \"x\": 120, \"y\": 40, \"scale\": 0.5, \"turn\": 10, \"flip\": false,\n"
              "            \"handles\": \"20,60; 90,60 -> 90,40\" } ],\n"
              "        \"relations\": [ \"man:#ff0000 > rope:*\", \"rope:20,60 > man:#0000ff\" ] }",
  .settings = CLI_SETTINGS_OF_LABELS " on-cycle suggest expansion complete cell-size encoding near-level far-level",
  .output   = "output",
  .check    = cli_compositing_check,
  .run      = run_compose,
};
