/* --report: results as JSON; docs/report.md describes each member.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"
#include "json.h"

#include <sys/resource.h>

#define SCHEMA 1 /* increases when a member is removed or changes its meaning, but not when one is added */

static void
add_text (JsonBuilder *json, const char *name, const char *text)
{
  json_builder_set_member_name (json, name);
  json_builder_add_string_value (json, text);
}

static void
add_integer (JsonBuilder *json, const char *name, gint64 value)
{
  json_builder_set_member_name (json, name);
  json_builder_add_int_value (json, value);
}

static void
add_number (JsonBuilder *json, const char *name, double value)
{
  json_builder_set_member_name (json, name);
  json_builder_add_double_value (json, value);
}

static void
add_truth (JsonBuilder *json, const char *name, bool value)
{
  json_builder_set_member_name (json, name);
  json_builder_add_boolean_value (json, value);
}

static void
add_place (JsonBuilder *json, const char *name, double x, double y)
{
  json_builder_set_member_name (json, name);
  json_builder_begin_array (json);
  json_builder_add_double_value (json, x);
  json_builder_add_double_value (json, y);
  json_builder_end_array (json);
}

static void
begin_list (JsonBuilder *json, const char *name)
{
  json_builder_set_member_name (json, name);
  json_builder_begin_array (json);
}

/* ------------------------------------------------------------------ labels */

/* The layer of a label: its number from the farthest, and its box. */
static void
add_layer (JsonBuilder *json, const CeldLayers *layers, uint32_t label)
{
  for (size_t i = 0; i < celd_layers_count (layers); i++)
    if (celd_layers_item (layers, i)->label == label)
      {
        CeldRect box = celd_layers_item (layers, i)->box;

        add_integer (json, "layer", (gint64) i);
        begin_list (json, "box");
        json_builder_add_int_value (json, box.x);
        json_builder_add_int_value (json, box.y);
        json_builder_add_int_value (json, box.width);
        json_builder_add_int_value (json, box.height);
        json_builder_end_array (json);
      }
}

static void
add_label (JsonBuilder *json, const CliReport *report, size_t index)
{
  static const char  *origins[] = { "scribble", "arrow", "background" };
  const CeldRegion   *region = &report->palette->item[index];
  const uint8_t      *c = region->colour;
  char                colour[16];

  g_snprintf (colour, sizeof colour, c[3] ? "#%02x%02x%02x" : "transparent", c[0], c[1], c[2]);
  json_builder_begin_object (json);
  add_integer (json, "label", (gint64) index + 1);
  add_text (json, "colour", colour);
  add_text (json, "origin", origins[region->origin]);
  add_truth (json, "background", region->background);
  add_integer (json, "seeds", (gint64) region->seeds);
  add_integer (json, "area", (gint64) region->area);
  add_place (json, "place", region->x, region->y);
  if (report->order && index < report->order->n)
    {
      uint32_t level = report->order->level[index];

      add_integer (json, "level", level);
      add_number (json, "value", (double) celd_order_value (report->order, level, report->settings));
    }
  if (report->layers)
    add_layer (json, report->layers, (uint32_t) index + 1);
  json_builder_end_object (json);
}

/* ------------------------------------------------------------------ relations */

/* Why a relation with a problem of this kind was left out; NULL if it was not. */
static const char *
reason (CeldProblemKind kind)
{
  switch (kind)
    {
    case CELD_PROBLEM_OUTSIDE:        return "outside";
    case CELD_PROBLEM_UNKNOWN_COLOUR: return "unknown-colour";
    case CELD_PROBLEM_SAME_REGION:    return "same-region";
    case CELD_PROBLEM_CONTRADICTION:  return "contradiction";
    default:                          return NULL;
    }
}

static const char *const sources[] = {
  [CELD_SOURCE_TEXT] = "text", [CELD_SOURCE_ARROW] = "arrow", [CELD_SOURCE_PATH] = "path",
  [CELD_SOURCE_SUGGESTION] = "suggestion"
};

static void
add_relation (JsonBuilder *json, const CeldRelation *relation, const char *why)
{
  char *text = cli_relation_text (relation, NULL);

  json_builder_begin_object (json);
  add_text (json, "text", text);
  add_text (json, "source", sources[relation->source]);
  if (relation->line)
    {
      add_integer (json, "line", relation->line);
      add_integer (json, "column", relation->column);
    }
  add_truth (json, "equal", relation->equal);
  add_number (json, "weight", relation->weight);
  add_number (json, "gap", relation->gap);
  add_truth (json, "crack", relation->crack);
  add_truth (json, "anchor", relation->anchor);
  if (why)
    add_text (json, "left-out", why);
  json_builder_end_object (json);
  g_free (text);
}

static void
add_relations (JsonBuilder *json, const CliReport *report)
{
  const CeldRelations *relations = report->relations;
  const CeldProblems  *problems = report->problems;
  const char         **why = g_new0 (const char *, relations->n);

  for (size_t i = 0; problems && i < problems->n; i++)
    if (problems->item[i].relation < relations->n && reason (problems->item[i].kind))
      why[problems->item[i].relation] = reason (problems->item[i].kind);
  begin_list (json, "relations");
  for (size_t i = 0; i < relations->n; i++)
    add_relation (json, &relations->item[i], why[i]);
  json_builder_end_array (json);
  g_free (why);
}

static void
add_indices (JsonBuilder *json, const size_t *item, size_t n)
{
  json_builder_begin_array (json);
  for (size_t i = 0; i < n; i++)
    json_builder_add_int_value (json, (gint64) item[i]);
  json_builder_end_array (json);
}

static void
add_one_colour (JsonBuilder *json, size_t index, const CeldCycle *cycle)
{
  json_builder_begin_object (json);
  add_integer (json, "cycle", (gint64) index);
  add_integer (json, "label", cycle->label);
  begin_list (json, "places");
  for (int i = 0; i < 2; i++)
    {
      json_builder_begin_array (json);
      json_builder_add_double_value (json, cycle->x[i]);
      json_builder_add_double_value (json, cycle->y[i]);
      json_builder_end_array (json);
    }
  json_builder_end_array (json);
  json_builder_end_object (json);
}

static void
add_scc (JsonBuilder *json, const CeldScc *scc)
{
  json_builder_begin_object (json);
  json_builder_set_member_name (json, "relations");
  add_indices (json, scc->item, scc->n);
  json_builder_set_member_name (json, "newest");
  add_indices (json, scc->newest.item, scc->newest.n);
  json_builder_end_object (json);
}

/* ------------------------------------------------------------------ closures, problems, cost */

static void
add_closure (JsonBuilder *json, const CeldClosure *closure)
{
  json_builder_begin_object (json);
  begin_list (json, "labels");
  json_builder_add_int_value (json, closure->label);
  json_builder_add_int_value (json, closure->other);
  json_builder_end_array (json);
  begin_list (json, "line");
  for (size_t i = 0; i < closure->n; i++)
    {
      json_builder_begin_array (json);
      json_builder_add_double_value (json, closure->place[i].x);
      json_builder_add_double_value (json, closure->place[i].y);
      json_builder_end_array (json);
    }
  json_builder_end_array (json);
  json_builder_end_object (json);
}

/* The method of segmentation, and the gaps that it closed. */
static void
add_segmentation (JsonBuilder *json, const CliReport *report)
{
  add_text (json, "method", celd_setting_find ("method")->choice[report->settings->method].nick);
  begin_list (json, "closures");
  for (size_t i = 0; i < report->closures->n; i++)
    add_closure (json, &report->closures->item[i]);
  json_builder_end_array (json);
}

static void
add_problem (JsonBuilder *json, const CliReport *report, const CeldProblem *problem)
{
  static const char *kinds[] = {
    "stroke-overruled", "region-unreached", "colour-lost", "arrow-unclear", "outside", "unknown-colour", "same-region",
    "contradiction", "not-converged", "region-split", "hidden-unsure", "stroke-faint",
    "stroke-unmatched",
  };
  static const char *reasons[] = {
    [CELD_REASON_SHORT] = "short", [CELD_REASON_ALIKE] = "alike", [CELD_REASON_HEAD] = "head",
    [CELD_REASON_UNEVEN] = "uneven", [CELD_REASON_MEETING] = "meeting", [CELD_REASON_PIECE] = "piece",
    [CELD_REASON_HIDDEN] = "hidden", [CELD_REASON_FRAME] = "frame",
  };
  char               text[400];

  celd_problem_text (problem, report->palette, report->relations, NULL, text, sizeof text);
  json_builder_begin_object (json);
  add_text (json, "kind", kinds[problem->kind]);
  add_text (json, "text", text);
  if (problem->reason)
    add_text (json, "reason", reasons[problem->reason]);
  if (problem->x >= 0 && problem->y >= 0)
    add_place (json, "place", problem->x, problem->y);
  if (problem->label)
    add_integer (json, "label", problem->label);
  if (problem->relation != CELD_NO_INDEX)
    add_integer (json, "relation", (gint64) problem->relation);
  json_builder_end_object (json);
}

static void
add_cost (JsonBuilder *json, const GArray *timings)
{
  struct rusage usage;

  json_builder_set_member_name (json, "seconds");
  json_builder_begin_object (json);
  for (guint i = 0; i < timings->len; i++)
    {
      const CliTiming *timing = &g_array_index (timings, CliTiming, i);

      add_number (json, timing->stage, timing->seconds);
    }
  json_builder_end_object (json);
  if (!getrusage (RUSAGE_SELF, &usage))
    add_integer (json, "peak-memory", (gint64) usage.ru_maxrss * 1024);
}

/* ------------------------------------------------------------------ the exact program */

static void
add_node (JsonBuilder *json, const CeldNode *node)
{
  json_builder_begin_object (json);
  if (node->label)
    add_integer (json, "label", node->label);
  if (node->x >= 0)
    add_place (json, "place", node->x, node->y);
  add_number (json, "depth", node->depth);
  json_builder_end_object (json);
}

static void
add_exact (JsonBuilder *json, const CeldExact *exact)
{
  json_builder_set_member_name (json, "exact");
  json_builder_begin_object (json);
  add_number (json, "sigma", exact->sigma);
  add_number (json, "energy", exact->energy);
  add_number (json, "gap", exact->gap);
  add_number (json, "violation", exact->violation);
  add_integer (json, "inequalities", (gint64) exact->inequalities);
  add_integer (json, "active", (gint64) exact->active);
  add_integer (json, "steps", exact->steps);
  add_integer (json, "iterations", exact->solve.iterations);
  add_number (json, "error", exact->solve.error);
  begin_list (json, "nodes");
  for (size_t i = 0; i < exact->n; i++)
    add_node (json, &exact->node[i]);
  json_builder_end_array (json);
  json_builder_end_object (json);
}

/* ------------------------------------------------------------------ the report */

static void
add_suggestions (JsonBuilder *json, const CeldRelations *suggestions)
{
  begin_list (json, "suggestions");
  for (size_t i = 0; i < suggestions->n; i++)
    add_relation (json, &suggestions->item[i], NULL);
  json_builder_end_array (json);
}

static void
add_order (JsonBuilder *json, const CliReport *report)
{
  if (!report->exact)
    add_integer (json, "levels", report->order->levels);
  begin_list (json, "cycles");
  for (size_t i = 0; i < report->order->n_cycles; i++)
    add_indices (json, report->order->cycle[i].item, report->order->cycle[i].n);
  json_builder_end_array (json);
  begin_list (json, "one-colour");
  for (size_t i = 0; i < report->order->n_cycles; i++)
    if (report->order->cycle[i].label)
      add_one_colour (json, i, &report->order->cycle[i]);
  json_builder_end_array (json);
  begin_list (json, "strong-components");
  for (size_t i = 0; i < report->order->n_sccs; i++)
    add_scc (json, &report->order->scc[i]);
  json_builder_end_array (json);
}

static JsonBuilder *
build (const CliReport *report)
{
  JsonBuilder *json = json_builder_new ();

  json_builder_begin_object (json);
  add_text (json, "celdepth", CELDEPTH_VERSION);
  add_integer (json, "schema", SCHEMA);
  add_text (json, "command", report->command);
  add_integer (json, "width", report->width);
  add_integer (json, "height", report->height);
  begin_list (json, "labels");
  for (size_t i = 0; i < report->palette->n; i++)
    add_label (json, report, i);
  json_builder_end_array (json);
  if (report->closures)
    add_segmentation (json, report);
  add_relations (json, report);
  if (report->suggestions)
    add_suggestions (json, report->suggestions);
  if (report->order)
    add_order (json, report);
  if (report->exact)
    add_exact (json, report->exact);
  begin_list (json, "problems");
  for (size_t i = 0; report->problems && i < report->problems->n; i++)
    add_problem (json, report, &report->problems->item[i]);
  json_builder_end_array (json);
  add_cost (json, report->timings);
  json_builder_end_object (json);
  return json;
}

bool
cli_report_write (const char *path, const CliReport *report)
{
  return cli_write_json (path, build (report));
}
