# Writes the names of the layers of the open image to $CELDEPTH_OUT/state.txt, twice a second, until there is a file
# $CELDEPTH_OUT/stop; then the plug-in's parasites, those that would save a path of this folder in the image's file, and
# whether the layer Depth is white, which a file $CELDEPTH_OUT/fill makes it in a step of undo.  Its pixels are not read
# before, because undo may remove it then, and GIMP kills a plug-in that reads pixels of a layer that is gone.  For tests
# with a screen and the Python interpreter of GIMP 3.
#
# SPDX-License-Identifier: LGPL-3.0-or-later
import os
import time
import traceback

import gi
gi.require_version('Gegl', '0.4')
gi.require_version('Gimp', '3.0')
from gi.repository import Gegl, Gimp  # noqa: E402

OUT = os.environ['CELDEPTH_OUT']


def tree(layers):
    return [[layer.get_name(), *tree(layer.get_children())] if layer.is_group() else layer.get_name() for layer in layers]


def kept(image):
    return [name for name in image.get_parasite_list() if name.startswith('celdepth-')]


def with_paths(image):
    parasites = [image.get_parasite(name) for name in image.get_parasite_list()]
    return [parasite.get_name() for parasite in parasites
            if parasite.is_persistent() and OUT.encode() in bytes(parasite.get_data())]


def find_depth(layers):
    for layer in layers:
        found = find_depth(layer.get_children()) if layer.is_group() else layer if layer.get_name() == 'Depth' else None
        if found:
            return found
    return None


def is_white(layer):
    data = layer.get_buffer().get(Gegl.Rectangle.new(0, 0, layer.get_width(), layer.get_height()), 1.0, "R'G'B' u8",
                                  Gegl.AbyssPolicy.NONE)
    return min(data) == 255


def look(image, filled):
    """Fills the layer if it is wanted, and writes the state; has it been filled?"""
    depth = find_depth(image.get_layers())
    if os.path.exists(os.path.join(OUT, 'fill')):
        filled = depth.edit_fill(Gimp.FillType.WHITE)
        os.remove(os.path.join(OUT, 'fill'))
    white = ' white' if filled and depth and is_white(depth) else ''
    with open(os.path.join(OUT, 'state.new'), 'w') as f:
        print(f'{tree(image.get_layers())} {kept(image)} {with_paths(image)}{white}', file=f)
    os.replace(os.path.join(OUT, 'state.new'), os.path.join(OUT, 'state.txt'))
    return filled


Gegl.init(None)
is_filled = False
while not os.path.exists(os.path.join(OUT, 'stop')):
    images = Gimp.get_images()
    try:
        is_filled = look(images[0], is_filled) if images else False
    except (AttributeError, TypeError):  # an item was removed meanwhile: GIMP has no name of it, or no items in it
        traceback.print_exc()
    time.sleep(0.5)
