# Writes the names of the layers of the open image to $CELDEPTH_OUT/state.txt, twice a second, until there is a file
# $CELDEPTH_OUT/stop; for tests with a screen.  For the Python interpreter of GIMP 3.
#
# SPDX-License-Identifier: LGPL-3.0-or-later
import os
import time

import gi
gi.require_version('Gimp', '3.0')
from gi.repository import Gimp  # noqa: E402

OUT = os.environ['CELDEPTH_OUT']


def tree(layers):
    return [[layer.get_name(), *tree(layer.get_children())] if layer.is_group() else layer.get_name() for layer in layers]


while not os.path.exists(os.path.join(OUT, 'stop')):
    images = Gimp.get_images()
    if images:
        with open(os.path.join(OUT, 'state.new'), 'w') as f:
            kept = [name for name in images[0].get_parasite_list() if name.startswith('celdepth-')]
            print(tree(images[0].get_layers()), kept, file=f)
        os.replace(os.path.join(OUT, 'state.new'), os.path.join(OUT, 'state.txt'))
    time.sleep(0.5)
