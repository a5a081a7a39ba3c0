# Opens an example as a layered image in GIMP 3 with a screen, and then runs what the test asks for: the code in
# $CELDEPTH_OUT/live/do.py, whenever there is such a file, which is removed when it has been run; errors go to error.txt.
# For the Python interpreter of GIMP 3.
#
# SPDX-License-Identifier: LGPL-3.0-or-later
import os
import time
import traceback

import gi
gi.require_version('Gegl', '0.4')
gi.require_version('Gimp', '3.0')
from gi.repository import Gegl, Gimp, Gio  # noqa: E402

EXAMPLE, OUT = os.path.join(os.environ['CELDEPTH_EXAMPLES'], 'frog'), os.path.join(os.environ['CELDEPTH_OUT'], 'live')
QUIET = Gimp.RunMode.NONINTERACTIVE


def path(*parts):
    return Gio.File.new_for_path(os.path.join(*parts))


def export(name):
    """Writes the layer of this name, as large as the image, to a file of its name."""
    copy = Gimp.Image.new(image.get_width(), image.get_height(), Gimp.ImageBaseType.RGB)
    copy.insert_layer(Gimp.Layer.new_from_drawable(layer[name], copy), None, 0)
    Gimp.file_save(QUIET, copy, path(OUT, name + '.png'), None)
    copy.delete()


def tree():
    """The names of all layers."""
    def names(layers):
        return [[one.get_name(), *names(one.get_children())] if one.is_group() else one.get_name() for one in layers]
    return names(image.get_layers())


def pixels(one):
    return one.get_buffer().get(Gegl.Rectangle.new(0, 0, one.get_width(), one.get_height()), 1.0, "R'G'B'A u8",
                                Gegl.AbyssPolicy.NONE)


def answer(words):
    with open(os.path.join(OUT, 'answer.txt'), 'w', encoding='utf-8') as f:
        f.write(str(words))


Gegl.init(None)
image = Gimp.file_load(QUIET, path(EXAMPLE, 'drawing.png'))
if image.get_base_type() != Gimp.ImageBaseType.RGB:
    image.convert_rgb()
layer = {'Drawing': image.get_layers()[0]}
layer['Drawing'].set_name('Drawing')
for role in ('Scribbles', 'Arrows'):
    layer[role] = Gimp.file_load_layer(QUIET, image, path(EXAMPLE, role.lower() + '.png'))
    layer[role].set_name(role)
    image.insert_layer(layer[role], None, 0)
image.set_selected_layers([layer['Scribbles']])
image.set_file(path(OUT, 'frog.xcf'))
display = Gimp.Display.new(image)
while not os.path.exists(os.path.join(OUT, 'stop')):
    if os.path.exists(os.path.join(OUT, 'do.py')):
        try:
            exec(open(os.path.join(OUT, 'do.py'), encoding='utf-8').read())
        except Exception:
            with open(os.path.join(OUT, 'error.txt'), 'a', encoding='utf-8') as f:
                traceback.print_exc(file=f)
        os.remove(os.path.join(OUT, 'do.py'))
    time.sleep(0.05)
