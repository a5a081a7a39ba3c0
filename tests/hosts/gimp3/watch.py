# Writes the names of the layers of the open image to $CELDEPTH_OUT/state.txt, twice a second, until there is a file
# $CELDEPTH_OUT/stop; then the plug-in's parasites, those that would save a path of this folder in the image's file, and
# whether the layer Depth is white.  Other files of that folder ask for something, and are removed when it is done:
#
#   fill       has the name of a layer, which is made white in a step of undo; its lock goes for good
#   console    messages go to the Error Console, which opens
#   describe   gets all that there is to say of the image and its layers, with sums of their pixels, and becomes
#              description.txt
#
# Pixels are not read before that, because undo may remove a layer then, and GIMP kills a plug-in that reads pixels of a
# layer that is gone.  For tests with a screen and the Python interpreter of GIMP 3.
#
# SPDX-License-Identifier: LGPL-3.0-or-later
import hashlib
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


def kept(item):
    return [name for name in item.get_parasite_list() if name.startswith('celdepth-')]


def with_paths(image):
    parasites = [image.get_parasite(name) for name in image.get_parasite_list()]
    return [parasite.get_name() for parasite in parasites
            if parasite.is_persistent() and OUT.encode() in bytes(parasite.get_data())]


def find(layers, name):
    for layer in layers:
        found = find(layer.get_children(), name) if layer.is_group() else layer if layer.get_name() == name else None
        if found:
            return found
    return None


def asked(name):
    """What a file of this name has, which is removed; None: there is none."""
    path = os.path.join(OUT, name)
    if not os.path.exists(path):
        return None
    with open(path) as f:
        words = f.read().strip()
    os.remove(path)
    return words


def is_white(layer):
    data = layer.get_buffer().get(Gegl.Rectangle.new(0, 0, layer.get_width(), layer.get_height()), 1.0, "R'G'B' u8",
                                  Gegl.AbyssPolicy.NONE)
    return min(data) == 255


def parasites(item):
    """Those of the plug-in: GIMP keeps what was chosen in dialogs in others, whatever is undone."""
    return [(name, bytes(item.get_parasite(name).get_data())) for name in sorted(kept(item))]


def described(layers, depth=0):
    """A line for each layer."""
    for layer in layers:
        width, height = layer.get_width(), layer.get_height()
        data = layer.get_buffer().get(Gegl.Rectangle.new(0, 0, width, height), 1.0, None, Gegl.AbyssPolicy.NONE)
        yield ' '.join(map(str, (
            depth * ' ', layer.get_id(), repr(layer.get_name()), f'{width}x{height}', *layer.get_offsets()[1:],
            layer.get_opacity(), layer.get_mode().value_nick, layer.get_visible(), layer.get_lock_content(),
            layer.get_lock_position(), layer.get_lock_alpha(), layer.get_mask(), layer.get_filters(), parasites(layer),
            hashlib.sha256(data).hexdigest())))
        if layer.is_group():
            yield from described(layer.get_children(), depth + 1)


def describe(image):
    lines = [f'{image.get_width()}x{image.get_height()} {image.get_precision().value_nick} {parasites(image)}',
             f'selected: {[layer.get_name() for layer in image.get_selected_layers()]}',
             f'selection: {Gimp.Selection.bounds(image)[1:]}',
             f'channels and paths: {[one.get_name() for one in [*image.get_channels(), *image.get_paths()]]}']
    with open(os.path.join(OUT, 'describe'), 'w') as f:
        f.writelines(line + '\n' for line in [*lines, *described(image.get_layers())])
    os.replace(os.path.join(OUT, 'describe'), os.path.join(OUT, 'description.txt'))


def look(image, filled):
    """Does what is wanted, and writes the state; has Depth been filled?"""
    name = asked('fill')
    if name:
        layer = find(image.get_layers(), name)
        layer.set_lock_content(False)
        layer.edit_fill(Gimp.FillType.WHITE)
        filled = filled or name == 'Depth'
    if asked('console') is not None:
        Gimp.message_set_handler(Gimp.MessageHandlerType.ERROR_CONSOLE)
    depth = find(image.get_layers(), 'Depth')
    if os.path.exists(os.path.join(OUT, 'describe')):
        describe(image)
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
