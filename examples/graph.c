/* Depth from a C program: two graphs of GEGL over the same layers, read again after each change of a layer.
 *
 *   cc graph.c -o graph $(pkg-config --cflags --libs gegl-0.4)
 *   ./graph people OUT     OUT gets depth-STEP-GRAPH.npy and the changed scribbles.png
 *
 * GEGL computes on demand: a graph is only a plan until pixels are read from one of its nodes.  A node keeps its result,
 * and one whose input has changed computes it again when it is next read.  So a program paints into a buffer, reads the
 * depth, and has only what depends on that buffer made again.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include <gegl.h>

/* Before GEGL 0.4.46 the function had another name. */
#if GEGL_MICRO_VERSION < 46
#define gegl_node_connect gegl_node_connect_to
#endif

/* What the artist makes. */
typedef struct { GeglBuffer *drawing, *scribbles, *arrows; } Layers;

/* One way from the layers to depth. */
typedef struct
{
  const char *name;
  GeglNode   *all;       /* owns the nodes */
  GeglNode   *relations; /* the node with the property "relations" */
  GeglNode   *depth;     /* the node to read depth from */
  GString    *made;      /* the operations that have computed since the last reading */
} Graph;

/* ------------------------------------------------------------------ files */

static GeglBuffer *
load (const char *folder, const char *name)
{
  GeglBuffer *buffer = NULL;
  char       *path = g_build_filename (folder, name, NULL);
  GeglNode   *all = gegl_node_new ();
  GeglNode   *file = gegl_node_new_child (all, "operation", "gegl:load", "path", path, NULL);
  GeglNode   *sink = gegl_node_new_child (all, "operation", "gegl:buffer-sink", "buffer", &buffer, NULL);

  gegl_node_connect (file, "output", sink, "input");
  gegl_node_process (sink);
  g_object_unref (all);
  g_free (path);
  return buffer;
}

/* The ending of the name chooses the format; .npy keeps floats as they are. */
static void
save (GeglBuffer *buffer, const char *folder, const char *name)
{
  char     *path = g_build_filename (folder, name, NULL);
  GeglNode *all = gegl_node_new ();
  GeglNode *source = gegl_node_new_child (all, "operation", "gegl:buffer-source", "buffer", buffer, NULL);
  GeglNode *file = gegl_node_new_child (all, "operation", "gegl:save", "path", path, NULL);

  gegl_node_connect (source, "output", file, "input");
  gegl_node_process (file);
  g_object_unref (all);
  g_free (path);
}

/* ------------------------------------------------------------------ graphs */

/* A node that gives the pixels of a buffer; when the buffer is painted on, it tells the nodes after it. */
static GeglNode *
source_node (Graph *graph, GeglBuffer *buffer)
{
  return gegl_node_new_child (graph->all, "operation", "gegl:buffer-source", "buffer", buffer, NULL);
}

/* Operations report progress while they compute, and 1 when they have their result. */
static void
note_operation (GeglNode *node, double progress, gpointer data)
{
  GString *made = data;

  if (progress >= 1)
    g_string_append_printf (made, " %s", gegl_node_get_operation (node) + strlen ("celdepth:"));
}

/* A node of celdepth, and the nodes for its pads; NULL leaves a pad open. */
static GeglNode *
depth_node (Graph *graph, const char *operation, GeglNode *input, GeglNode *aux, GeglNode *aux2)
{
  GeglNode *node = gegl_node_new_child (graph->all, "operation", operation, NULL);

  gegl_node_connect (input, "output", node, "input");
  if (aux)
    gegl_node_connect (aux, "output", node, "aux");
  if (aux2)
    gegl_node_connect (aux2, "output", node, "aux2");
  g_signal_connect (node, "progress", G_CALLBACK (note_operation), graph->made);
  return node;
}

/* The whole method in one node.  It also keeps results of its own steps, such as what it knows of the drawing. */
static Graph
one_node (const Layers *layers)
{
  Graph graph = { "node", gegl_node_new (), NULL, NULL, g_string_new (NULL) };

  graph.depth = depth_node (&graph, "celdepth:popup", source_node (&graph, layers->drawing),
                            source_node (&graph, layers->scribbles), source_node (&graph, layers->arrows));
  graph.relations = graph.depth;
  return graph;
}

/* A node for each step, so that a program can read, change or replace what is between them. */
static Graph
chain (const Layers *layers)
{
  Graph     graph = { "chain", gegl_node_new (), NULL, NULL, g_string_new (NULL) };
  GeglNode *drawing = source_node (&graph, layers->drawing);
  GeglNode *scribbles = source_node (&graph, layers->scribbles), *arrows = source_node (&graph, layers->arrows);
  GeglNode *regions, *levels;

  regions         = depth_node (&graph, "celdepth:lazybrush-segment", drawing, scribbles, arrows);
  graph.relations = depth_node (&graph, "celdepth:depth-order", regions, arrows, drawing);
  levels          = depth_node (&graph, "celdepth:depth-expand", graph.relations, drawing, regions);
  graph.depth     = depth_node (&graph, "celdepth:depth-smooth", levels, drawing, scribbles);
  return graph;
}

/* Depth is linear and between 0 and 1, 1 is nearest: read it as "Y float", whatever the format of the drawing. */
static void
read_depth (Graph *graph, const char *step, const char *out)
{
  GeglRectangle box = gegl_node_get_bounding_box (graph->depth);
  GeglBuffer   *depth = gegl_buffer_new (&box, babl_format ("Y float"));
  char         *name = g_strdup_printf ("depth-%s-%s.npy", step, graph->name);
  gint64        start = g_get_monotonic_time ();

  gegl_node_blit_buffer (graph->depth, depth, &box, 0, GEGL_ABYSS_NONE);
  g_print ("%-9s %-6s %5.2f s: %s\n", step, graph->name, (double) (g_get_monotonic_time () - start) / 1e6,
           graph->made->len ? graph->made->str : " nothing");
  g_string_truncate (graph->made, 0);
  save (depth, out, name);
  g_object_unref (depth);
  g_free (name);
}

/* ------------------------------------------------------------------ an artist's session */

/* A stroke in the colour of another part makes both one part, with one depth. */
static void
paint_stroke (GeglBuffer *scribbles)
{
  GeglColor *hair = gegl_color_new ("#ff0daf");

  gegl_buffer_set_color (scribbles, GEGL_RECTANGLE (640, 815, 250, 30), hair);
  g_object_unref (hair);
}

int
main (int n, char **words)
{
  gegl_init (&n, &words);
  if (n != 3)
    {
      g_printerr ("usage: graph FOLDER OUT\n");
      return 2;
    }
  if (!gegl_has_operation ("celdepth:popup")) /* GEGL would pass pictures through instead, with a warning */
    {
      g_printerr ("graph: GEGL does not find celdepth; docs/operations.md says where it looks\n");
      return 1;
    }

  const char *folder = words[1], *out = words[2];
  Layers      layers = { load (folder, "drawing.png"), load (folder, "scribbles.png"), load (folder, "arrows.png") };

  if (!layers.drawing || !layers.scribbles || !layers.arrows)
    {
      g_printerr ("graph: %s lacks drawing.png, scribbles.png or arrows.png\n", folder);
      return 1;
    }

  Graph graphs[] = { one_node (&layers), chain (&layers) };

  for (int i = 0; i < 2; i++)
    {
      read_depth (&graphs[i], "first", out);
      read_depth (&graphs[i], "again", out); /* nothing has changed */
    }

  paint_stroke (layers.scribbles); /* both graphs notice */
  save (layers.scribbles, out, "scribbles.png");
  for (int i = 0; i < 2; i++)
    read_depth (&graphs[i], "stroke", out);

  for (int i = 0; i < 2; i++)
    {
      gegl_node_set (graphs[i].relations, "relations", "#ff0d5e > #ff0daf", NULL); /* nearer > farther */
      read_depth (&graphs[i], "relation", out);
      g_object_unref (graphs[i].all);
      g_string_free (graphs[i].made, TRUE);
    }

  g_object_unref (layers.drawing);
  g_object_unref (layers.scribbles);
  g_object_unref (layers.arrows);
  gegl_exit ();
  return 0;
}
