"""Shared by the scripts that run the plug-in: an example as a layered image, procedures, and results of the command.

$CELDEPTH_EXAMPLES: where the drawings are; $CELDEPTH_OUT: has what the command made (reference); gets plugin.txt, a
line for each check.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import functools
import os

import gi
gi.require_version('Gegl', '0.4')
gi.require_version('Gimp', '3.0')
from gi.repository import Gegl, Gimp, Gio  # noqa: E402
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402

EXAMPLES, OUT = os.environ['CELDEPTH_EXAMPLES'], os.environ['CELDEPTH_OUT']
QUIET = Gimp.RunMode.NONINTERACTIVE
PRECISIONS = {8: Gimp.Precision.U8_NON_LINEAR, 16: Gimp.Precision.U16_NON_LINEAR, 32: Gimp.Precision.FLOAT_LINEAR}
ERRORS = {8: 1 / 255, 16: 1 / 65535, 32: 1 / 65535}
PICTURES = ['enhanced', 'lit', 'shading', 'normals', 'depth', 'levels', 'regions']
log = open(os.path.join(OUT, 'plugin.txt'), 'a')


def check(fact, text):
    print('ok  ' if fact else 'FAIL', text, file=log, flush=True)


def file(*path):
    return Gio.File.new_for_path(os.path.join(*path))


# ------------------------------------------------------------------ images

def crop(layer):
    """Makes a layer as small as what is painted on it, which moves its corner."""
    width, height = layer.get_width(), layer.get_height()
    data = layer.get_buffer().get(Gegl.Rectangle.new(0, 0, width, height), 1.0, "A u8", Gegl.AbyssPolicy.NONE)
    y, x = np.nonzero(np.frombuffer(data, np.uint8).reshape(height, width))
    layer.resize(int(np.ptp(x)) + 1, int(np.ptp(y)) + 1, -int(x.min()), -int(y.min()))


@functools.cache
def read_people():
    """The pictures of an example, as an image of three layers: reading each again starts a program of GIMP."""
    image = Gimp.file_load(QUIET, file(EXAMPLES, 'people', 'drawing.png'))
    if image.get_base_type() != Gimp.ImageBaseType.RGB:
        image.convert_rgb()
    for name in ('scribbles', 'arrows'):
        image.insert_layer(Gimp.file_load_layer(QUIET, image, file(EXAMPLES, 'people', name + '.png')), None, 0)
    return image


def open_people(bits, names=('Drawing', 'Scribbles', 'Arrows'), small=False):
    """The layers of an example, as an artist may have them: in a group, cropped, with a selection."""
    image = read_people().duplicate()
    if image.get_precision() != PRECISIONS[bits]:
        image.convert_precision(PRECISIONS[bits])
    layers = image.get_layers()[::-1]
    group = Gimp.GroupLayer.new(image, 'notes')
    image.insert_layer(group, None, 0)
    for name, layer in zip(names, layers):
        layer.set_name(name)
    for layer in layers[1:]:
        image.reorder_item(layer, group, 0)
        if small:
            crop(layer)
    image.set_selected_layers([by_name(image, names[1])])
    return image


def add_path(image, name, *strokes, closed=False):
    """Each stroke is a curve through its points, with handles that lead astray."""
    path = Gimp.Path.new(image, name)
    image.insert_path(path, None, 0)
    for points in strokes:
        numbers = [number for x, y in points for number in (x - 40, y + 9, x, y, x + 40, y - 9)]
        path.stroke_new_from_points(Gimp.PathStrokeType.BEZIER, numbers, closed)
    return path


def all_layers(layers):
    for layer in layers:
        yield layer
        if layer.is_group():
            yield from all_layers(layer.get_children())


def by_name(image, name):
    return next(layer for layer in all_layers(image.get_layers()) if layer.get_name() == name)


def pixels(layer, pixel_format, kind, channels):
    width, height = layer.get_width(), layer.get_height()
    data = layer.get_buffer().get(Gegl.Rectangle.new(0, 0, width, height), 1.0, pixel_format, Gegl.AbyssPolicy.NONE)
    return np.frombuffer(data, kind).reshape(height, width, channels).astype(float)


# ------------------------------------------------------------------ procedures

def run(name, image, run_mode=QUIET, **arguments):
    """The status, the second result or None, and the message of an error."""
    procedure = Gimp.get_pdb().lookup_procedure(name)
    config = procedure.create_config()
    config.set_property('run-mode', run_mode)
    config.set_property('image', image)
    for argument, value in arguments.items():
        config.set_property(argument.replace('_', '-'), value)
    result = procedure.run(config)
    values = [result.index(i) for i in range(result.length())]
    good = values[0] == Gimp.PDBStatusType.SUCCESS
    return good, values[1] if good and len(values) > 1 else None, '' if good else Gimp.get_pdb().get_last_error()


def pop_up(image, wanted=tuple(PICTURES), **arguments):
    return run('plug-in-celdepth-popup', image, **{name: name in wanted for name in PICTURES}, **arguments)


def results(group):
    """The layers of the group by the names of their pictures."""
    return {bytes(layer.get_parasite('celdepth-picture').get_data()).rstrip(b'\0').decode(): layer
            for layer in group.get_children()}


# ------------------------------------------------------------------ comparing

def encode(linear):
    v = np.clip(linear, 0, 1)
    return np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)


def reference(name, bits):
    """What the command made, as the numbers that an image of these bits has: encoded, or linear with 32 bits."""
    if name == 'regions':
        encoded = np.array(Image.open(os.path.join(OUT, 'labels.png')).convert('RGB')) / 255
        return encoded if bits < 32 else np.where(encoded <= 0.04045, encoded / 12.92,
                                                  ((encoded + 0.055) / 1.055) ** 2.4)
    if name == 'normals':  # numbers, not colours
        return 0.5 + 0.5 * np.load(os.path.join(OUT, 'popup-normals.npy'))
    file_name = {'shading': 'popup-shading'}.get(name, name)
    values = np.atleast_3d(np.squeeze(np.load(os.path.join(OUT, file_name + '.npy')))).astype(float)
    values = np.repeat(values, 3, 2) if values.shape[2] == 1 else values[..., :3]
    return values if bits == 32 else encode(values)


def compare(group, bits, what):
    for name, layer in results(group).items():
        found = pixels(layer, 'RGB float' if bits == 32 else "R'G'B' float", np.float32, 3)
        wanted = reference(name, bits)
        same_size = found.shape == wanted.shape
        difference = np.abs(found - wanted).max() if same_size else 1
        check(difference <= ERRORS[bits] + 1e-6, f'{what}, {bits} bits: {name} differs by {difference:.2e}')
