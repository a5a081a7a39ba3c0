#!/usr/bin/python3
"""Depth from a Python program: two graphs of GEGL over the same layers, read again after each change of a layer.

graph.py people OUT     OUT gets depth-STEP-GRAPH.npy and the changed scribbles.png

Needs python3-gi and gir1.2-gegl-0.4.  GEGL computes on demand: a graph is only a plan until pixels are read from one of
its nodes.  A node keeps its result, and one whose input has changed computes it again when it is next read.  So a program
paints into a buffer, reads the depth, and has only what depends on that buffer made again.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import sys
import time

import gi

gi.require_version('Gegl', '0.4')
from gi.repository import Gegl, GObject  # noqa: E402


def node(graph, operation, **properties):
    """A new node of a graph."""
    made = graph.create_child(operation)
    for name, value in properties.items():
        made.set_property(name, value)
    return made


def load(path):
    """A buffer with the picture of a file."""
    if not os.path.exists(path):
        sys.exit(f'graph.py: there is no {path}')
    graph = Gegl.Node()
    file = node(graph, 'gegl:load', path=path)
    box = file.get_bounding_box()
    buffer = Gegl.Buffer.new("R'G'B'A u8", box.x, box.y, box.width, box.height)
    file.blit_buffer(buffer, box, 0, Gegl.AbyssPolicy.NONE)
    return buffer


def save(buffer, path):
    """The ending of the name chooses the format; .npy keeps floats as they are."""
    graph = Gegl.Node()
    source = node(graph, 'gegl:buffer-source', buffer=buffer)
    file = node(graph, 'gegl:save', path=path)
    source.connect_to('output', file, 'input')
    file.process()


class Graph:
    """One way from the layers to depth: `relations` is the node with that property, `depth` the node to read."""

    def __init__(self, drawing, scribbles, arrows):
        self.all = Gegl.Node()  # owns the nodes
        self.made = []          # the operations that have computed since the last reading
        self.build(*(node(self.all, 'gegl:buffer-source', buffer=layer) for layer in (drawing, scribbles, arrows)))

    def add(self, operation, **pads):
        """A node of celdepth, and the nodes for its pads."""
        made = node(self.all, operation)
        for pad, source in pads.items():
            source.connect_to('output', made, pad)
        GObject.Object.connect(made, 'progress', self.note_operation)  # newer nodes have their own connect
        return made

    def note_operation(self, operation, progress):
        """Operations report progress while they compute, and 1 when they have their result."""
        if progress >= 1:
            self.made.append(operation.get_operation().removeprefix('celdepth:'))

    def read_depth(self, step, out):
        """Depth is linear and between 0 and 1, 1 is nearest: read it as "Y float", whatever the drawing's format."""
        box = self.depth.get_bounding_box()
        depth = Gegl.Buffer.new('Y float', box.x, box.y, box.width, box.height)
        start = time.monotonic()
        self.depth.blit_buffer(depth, box, 0, Gegl.AbyssPolicy.NONE)
        print(f'{step:9} {self.name:6} {time.monotonic() - start:5.2f} s:  {" ".join(self.made) or "nothing"}')
        self.made = []
        save(depth, os.path.join(out, f'depth-{step}-{self.name}.npy'))


class OneNode(Graph):
    """The whole method in one node.  It also keeps results of its own steps, such as what it knows of the drawing."""
    name = 'node'

    def build(self, drawing, scribbles, arrows):
        self.depth = self.relations = self.add('celdepth:popup', input=drawing, aux=scribbles, aux2=arrows)


class Chain(Graph):
    """A node for each step, so that a program can read, change or replace what is between them."""
    name = 'chain'

    def build(self, drawing, scribbles, arrows):
        regions = self.add('celdepth:lazybrush-segment', input=drawing, aux=scribbles, aux2=arrows)
        self.relations = self.add('celdepth:depth-order', input=regions, aux=arrows, aux2=drawing)
        levels = self.add('celdepth:depth-expand', input=self.relations, aux=drawing, aux2=regions)
        self.depth = self.add('celdepth:depth-smooth', input=levels, aux=drawing, aux2=scribbles)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder, out = sys.argv[1:]
    Gegl.init(None)  # before anything else of Gegl
    if not Gegl.has_operation('celdepth:popup'):  # GEGL would pass pictures through instead, with a warning
        sys.exit('graph.py: GEGL does not find celdepth; docs/operations.md says where it looks')
    layers = [load(os.path.join(folder, name)) for name in ('drawing.png', 'scribbles.png', 'arrows.png')]
    graphs = [OneNode(*layers), Chain(*layers)]

    for graph in graphs:
        graph.read_depth('first', out)
        graph.read_depth('again', out)  # nothing has changed

    # A stroke in the colour of another part makes both one part, with one depth; both graphs notice.
    scribbles = layers[1]
    scribbles.set_color(Gegl.Rectangle.new(640, 815, 250, 30), Gegl.Color.new('#ff0daf'))
    save(scribbles, os.path.join(out, 'scribbles.png'))
    for graph in graphs:
        graph.read_depth('stroke', out)

    for graph in graphs:
        graph.relations.set_property('relations', '#ff0d5e > #ff0daf')  # nearer > farther
        graph.read_depth('relation', out)


main()
