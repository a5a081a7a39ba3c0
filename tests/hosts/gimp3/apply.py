# Applies every operation to the layers of an XCF, with 8 and with 32 bits.  For the Python interpreter of GIMP 3.
#
# $CELDEPTH_EXAMPLES: where the drawings are; $CELDEPTH_OUT: gets drawing-BITS.xcf and BITS-RESULT.npy, values as GIMP
# has them (8 bits: encoded, 0..255; 32 bits: linear floats).
#
# SPDX-License-Identifier: LGPL-3.0-or-later
import os

import gi
gi.require_version('Gegl', '0.4')
gi.require_version('Gimp', '3.0')
from gi.repository import Gegl, Gimp, Gio  # noqa: E402
import numpy as np  # noqa: E402

EXAMPLES, OUT = os.environ['CELDEPTH_EXAMPLES'], os.environ['CELDEPTH_OUT']
QUIET = Gimp.RunMode.NONINTERACTIVE
PRECISIONS = {8: Gimp.Precision.U8_NON_LINEAR, 32: Gimp.Precision.FLOAT_LINEAR}
FORMATS = {8: ("R'G'B' u8", np.uint8), 32: ('RGB float', np.float32)}
RIM = {'rim-light': 0.8, 'specular': 0.5}
ALPHA = {8: ('A u8', np.uint8), 32: ('A float', np.float32)}


def file(*path):
    return Gio.File.new_for_path(os.path.join(*path))


def open_layers(name, layers, bits):
    """The layers of an example by name, from an XCF that is written and read back."""
    image = Gimp.file_load(QUIET, file(EXAMPLES, name, 'drawing.png'))
    image.convert_rgb()
    if image.get_precision() != PRECISIONS[bits]:
        image.convert_precision(PRECISIONS[bits])
    drawing, = image.get_layers()
    drawing.set_name('drawing')
    for layer in layers:
        painted = Gimp.file_load_layer(QUIET, image, file(EXAMPLES, name, layer + '.png'))
        painted.set_name(layer)
        image.insert_layer(painted, None, 0)
    image.set_selected_layers([drawing])
    xcf = file(OUT, f'{"drawing" if name == "people" else name}-{bits}.xcf')
    Gimp.file_save(QUIET, image, xcf, None)
    image.delete()
    image = Gimp.file_load(QUIET, xcf)
    return image, {layer.get_name(): layer for layer in image.get_layers()}


def apply(image, layer, operation, pads, **properties):
    """A copy of the layer with the operation merged into it; without alpha GIMP takes the colours alone."""
    layer = layer.copy()
    image.insert_layer(layer, None, 0)
    if properties.get('result') == 'layer':
        layer.add_alpha()
    effect = Gimp.DrawableFilter.new(layer, 'celdepth:' + operation, operation)
    for name, value in properties.items():
        effect.get_config().set_property(name, value)
    for pad, other in pads.items():
        effect.set_aux_input(pad, other)
    effect.update()
    layer.merge_filter(effect)
    return layer


def keep(layer, bits, name, formats=None):
    """The colours of a layer, or its alpha alone."""
    pixels, kind = (formats or FORMATS)[bits]
    width, height = layer.get_width(), layer.get_height()
    data = layer.get_buffer().get(Gegl.Rectangle.new(0, 0, width, height), 1.0, pixels, Gegl.AbyssPolicy.NONE)
    np.save(os.path.join(OUT, f'{bits}-{name}.npy'), np.frombuffer(data, kind).reshape(height, width, -1))
    return layer


def people(bits):
    """The chain, step by step, each on the layer that the step before made; and every result of the one node."""
    image, by_name = open_layers('people', ['scribbles', 'arrows'], bits)
    drawing, scribbles, arrows = (by_name[name] for name in ('drawing', 'scribbles', 'arrows'))

    def step(layer, operation, name, pads, **properties):
        return keep(apply(image, layer, operation, pads, **properties), bits, name)

    labels = step(drawing, 'lazybrush-segment', 'labels', {'aux': scribbles, 'aux2': arrows})
    order = step(labels, 'depth-order', 'order', {'aux': arrows, 'aux2': drawing})
    levels = step(order, 'depth-expand', 'levels', {'aux': drawing, 'aux2': labels})
    depth = step(levels, 'depth-smooth', 'depth', {'aux': drawing, 'aux2': scribbles})
    if bits == 32:  # depth of 8 bits moves by other parts of a pixel
        step(drawing, 'stereo', 'stereo', {'aux': depth, 'aux2': levels})
        for name, result in (('compose', 'art'), ('composed-levels', 'levels')):
            step(drawing, 'compose', name, {'aux': levels, 'aux2': scribbles}, result=result, between=0.5, scale=0.7)
        for result in ('displacement', 'warped', 'confidence'):
            step(drawing, 'arap-register', result, {'aux': drawing, 'aux2': levels}, result=result)
        for result in ('layer', 'matte'):
            step(order, 'depth-expand', 'expanded-' + result, {'aux': drawing, 'aux2': labels}, result=result)
        step(levels, 'lumo-shade', 'lumo-art', {'aux': drawing}, result='art')
        step(levels, 'lumo-shade', 'rim', {'aux': drawing}, result='rim', **RIM)
    step(drawing, 'arap-deform', 'deformed', {'aux4': scribbles, 'aux5': arrows}, handles='200,150 -> 210,140')
    step(drawing, 'arap-deform', 'deformed-levels', {'aux4': scribbles, 'aux5': arrows}, handles='200,150 -> 210,140',
         result='levels')
    for name, result in (('propagated', 'labels'), ('propagated-scribbles', 'scribbles'),
                         ('propagated-depth', 'depth'), ('propagated-confidence', 'confidence')):
        step(drawing, 'depth-propagate', name, {'aux': drawing, 'aux2': scribbles, 'aux4': arrows}, result=result)
    for result in ('closures', 'problems'):
        step(drawing, 'lazybrush-segment', 'segment-' + result, {'aux': scribbles}, result=result)
    step(drawing, 'depth-propagate', 'propagated-levels', {'aux': drawing, 'aux2': labels, 'aux3': levels},
         result='levels', flats=True)
    step(levels, 'relief', 'relief', {'aux': drawing, 'aux2': depth})
    for result in ('art', 'view'):
        step(drawing, 'depth-enhance', 'enhanced-' + result, {'aux': levels}, result=result)
    keep(apply(image, drawing, 'depth-enhance', {'aux': levels}, result='layer'), bits, 'enhanced-layer', ALPHA)
    for result in ('shading', 'normals', 'occlusion'):
        step(levels, 'lumo-shade', result, {'aux': drawing}, result=result)
    step(levels, 'lumo-shade', 'tone', {'aux': drawing}, result='tone', **{'light-model': 'half-lambert'})
    step(drawing, 'depth-exact', 'exact', {'aux': scribbles, 'aux2': arrows}, tolerance=1e-6)
    for result in ('labels', 'order', 'levels', 'depth', 'normals', 'shading', 'problems', 'suggestions'):
        step(drawing, 'popup', 'popup-' + result, {'aux': scribbles, 'aux2': arrows}, result=result)
    arrows.set_offsets(70, -40)  # which filters do not read
    step(drawing, 'popup', 'popup-moved', {'aux': scribbles, 'aux2': arrows}, result='levels')
    image.delete()


def armadillo(bits):
    """Virtual contours, and relations as text."""
    image, by_name = open_layers('armadillo', ['scribbles', 'contours'], bits)
    drawing, scribbles, contours = (by_name[name] for name in ('drawing', 'scribbles', 'contours'))
    with open(os.path.join(EXAMPLES, 'armadillo', 'relations.txt')) as f:
        relations = f.read()
    for purpose in ('segmentation', 'depth'):
        keep(apply(image, drawing, 'virtual-contours', {'aux': contours}, result=purpose), bits, 'contours-' + purpose)
    keep(apply(image, drawing, 'popup', {'aux': scribbles, 'aux3': contours}, result='depth', relations=relations),
         bits, 'popup-contours')
    image.delete()


Gegl.init(None)
for bits in PRECISIONS:
    people(bits)
    armadillo(bits)
