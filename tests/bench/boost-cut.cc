// celd_maxflow with Boost's solver: what a program has that takes the min-cut of the Boost Graph Library, as Krita
// once did.  Memory goes through malloc, so that it is counted like ours.
//
// Of the layouts that Boost offers, compressed_sparse_row_graph with vectors by the index of an edge takes half the
// time and memory of adjacency_list with vectors.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "bench.h"

#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>

#include <cstdlib>
#include <new>
#include <vector>

void *
operator new (std::size_t size)
{
  void *memory = std::malloc (size ? size : 1);

  if (!memory)
    throw std::bad_alloc ();
  return memory;
}

void
operator delete (void *memory) noexcept
{
  std::free (memory);
}

void
operator delete (void *memory, std::size_t) noexcept
{
  std::free (memory);
}

namespace
{
const uint32_t NO_NODE = UINT32_MAX;

// Rows of out-edges: that of a node by its number, then those of source and sink.
typedef boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property, boost::no_property,
                                           uint32_t, uint32_t> Graph;
typedef boost::graph_traits<Graph>::edge_descriptor Edge;
typedef boost::default_color_type Colour;

struct Arcs
{
  std::vector<std::pair<uint32_t, uint32_t>> ends;
  std::vector<int64_t> capacity; // the flow that Boost adds up has this type too
  std::vector<Edge>    back;     // the edge the other way

  void
  add (uint32_t from, uint32_t to, int64_t value)
  {
    ends.push_back ({ from, to });
    capacity.push_back (value);
    back.push_back (Edge ());
  }

  // The last edge is the way back of that with index k.
  void
  join (uint32_t k)
  {
    uint32_t last = (uint32_t) ends.size () - 1;

    back[last] = Edge (ends[k].first, k);
    back[k]    = Edge (ends[last].first, last);
  }
};

struct Grid
{
  int            width, height;
  const int32_t *east, *south, *terminal;

  // The pixels of the piece: those that have an edge.
  uint32_t
  number_nodes (std::vector<uint32_t> &node, size_t &n_arcs) const
  {
    size_t   w = (size_t) width, p = 0;
    uint32_t n = 0;

    for (int y = 0; y < height; y++)
      for (int x = 0; x < width; x++, p++)
        {
          size_t arcs = (size_t) ((x > 0 && east[p - 1]) + (x + 1 < width && east[p]) + (y > 0 && south[p - w]) +
                                  (y + 1 < height && south[p]) + 2 * (terminal[p] != 0));

          n_arcs += arcs;
          node[p] = arcs ? n++ : NO_NODE;
        }
    return n;
  }

  void
  list_arcs (const std::vector<uint32_t> &node, uint32_t n, Arcs &arcs) const
  {
    size_t                w = (size_t) width, p = 0;
    std::vector<uint32_t> above (w), ends[2]; // the edge down from the pixel above; edges to source and sink
    uint32_t              left = 0;

    for (int y = 0; y < height; y++)
      for (int x = 0; x < width; x++, p++)
        {
          uint32_t i = node[p];

          if (i == NO_NODE)
            continue;
          if (x > 0 && east[p - 1])
            {
              arcs.add (i, node[p - 1], east[p - 1]);
              arcs.join (left);
            }
          if (y > 0 && south[p - w])
            {
              arcs.add (i, node[p - w], south[p - w]);
              arcs.join (above[(size_t) x]);
            }
          left = (uint32_t) arcs.ends.size ();
          if (x + 1 < width && east[p])
            arcs.add (i, node[p + 1], east[p]);
          above[(size_t) x] = (uint32_t) arcs.ends.size ();
          if (y + 1 < height && south[p])
            arcs.add (i, node[p + w], south[p]);
          if (terminal[p])
            {
              bool sink = terminal[p] < 0;

              ends[sink].push_back ((uint32_t) arcs.ends.size ());
              arcs.add (i, n + sink, sink ? -(int64_t) terminal[p] : terminal[p]);
            }
        }
    for (uint32_t sink = 0; sink < 2; sink++)
      for (uint32_t k : ends[sink])
        {
          arcs.add (n + sink, arcs.ends[k].first, sink ? 0 : arcs.capacity[k]);
          arcs.join (k);
          if (!sink)
            arcs.capacity[k] = 0;
        }
  }
};

int64_t
cut (Arcs &arcs, uint32_t n, std::vector<Colour> &colour)
{
  Graph graph (boost::edges_are_sorted, arcs.ends.begin (), arcs.ends.end (), n + 2);
  arcs.ends = {};

  std::vector<int64_t> residual (arcs.capacity.size ());
  std::vector<Edge>    parent (n + 2);
  std::vector<long>    distance (n + 2);
  auto                 edges = get (boost::edge_index, graph);
  auto                 nodes = get (boost::vertex_index, graph);

  return boost::boykov_kolmogorov_max_flow (
    graph, boost::make_iterator_property_map (arcs.capacity.begin (), edges),
    boost::make_iterator_property_map (residual.begin (), edges),
    boost::make_iterator_property_map (arcs.back.begin (), edges),
    boost::make_iterator_property_map (parent.begin (), nodes),
    boost::make_iterator_property_map (colour.begin (), nodes),
    boost::make_iterator_property_map (distance.begin (), nodes), nodes, n, n + 1);
}
} // namespace

extern "C" CeldStatus
boost_maxflow (int width, int height, const int32_t *east, const int32_t *south, const int32_t *terminal, uint8_t *side,
               int64_t *flow)
{
  try
    {
      Grid                  grid = { width, height, east, south, terminal };
      std::vector<uint32_t> node ((size_t) width * (size_t) height);
      size_t                n_arcs = 0;
      uint32_t              n = grid.number_nodes (node, n_arcs);
      std::vector<Colour>   colour (n + 2);
      Arcs                  arcs;

      arcs.ends.reserve (n_arcs);
      arcs.capacity.reserve (n_arcs);
      arcs.back.reserve (n_arcs);
      grid.list_arcs (node, n, arcs);

      int64_t value = cut (arcs, n, colour);
      if (flow)
        *flow = value;
      for (size_t p = 0; p < node.size (); p++)
        side[p] = node[p] != NO_NODE && colour[node[p]] == boost::black_color;
      return CELD_OK;
    }
  catch (const std::bad_alloc &)
    {
      return CELD_NO_MEMORY;
    }
}
