# Opens every stack of layers in GIMP 3 and keeps what is seen.  For the Python interpreter of GIMP 3.
#
# $CELDEPTH_OUT: has layers-DRAWING.ora; gets layers-DRAWING.npy, 8 bits as GIMP shows them, and layers-DRAWING.txt with
# the names, the front layer first.
#
# SPDX-License-Identifier: LGPL-3.0-or-later
import os

import gi
gi.require_version('Gegl', '0.4')
gi.require_version('Gimp', '3.0')
from gi.repository import Gegl, Gimp, Gio  # noqa: E402
import numpy as np  # noqa: E402

OUT = os.environ['CELDEPTH_OUT']


def keep(path):
    image = Gimp.file_load(Gimp.RunMode.NONINTERACTIVE, Gio.File.new_for_path(path + '.ora'))
    with open(path + '.txt', 'w') as f:
        f.writelines(layer.get_name() + '\n' for layer in image.get_layers())
    seen = Gimp.Layer.new_from_visible(image, image, 'seen')
    image.insert_layer(seen, None, 0)
    width, height = image.get_width(), image.get_height()
    data = seen.get_buffer().get(Gegl.Rectangle.new(0, 0, width, height), 1.0, "R'G'B'A u8", Gegl.AbyssPolicy.NONE)
    np.save(path + '.npy', np.frombuffer(data, np.uint8).reshape(height, width, 4))
    image.delete()


Gegl.init(None)
for name in sorted(os.listdir(OUT)):
    if name.startswith('layers-') and name.endswith('.ora'):
        keep(os.path.join(OUT, name[:-len('.ora')]))
