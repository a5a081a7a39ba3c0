"""Run by GIMP 3: Pop-up on a layered file gives the depth of the command, in the language that was asked for.

/out/depth.npy is the command's; /out/LOCALE.txt gets what went wrong, or `passed`.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import array
import os
import traceback

import gi

gi.require_version('Gegl', '0.4')
from gi.repository import Gegl, Gimp, Gio  # noqa: E402

LOCALE = os.environ['LC_ALL']
NAME, MENU = {'C.UTF-8': ('Depth', '_Pop-up...'), 'de_DE.UTF-8': ('Tiefe', '_Pop-up …')}[LOCALE]


def read_npy(path):
    with open(path, 'rb') as file:
        data = file.read()
    return array.array('f', data[10 + int.from_bytes(data[8:10], 'little'):])


def check():
    image = Gimp.file_load(Gimp.RunMode.NONINTERACTIVE, Gio.File.new_for_path('/out/monkey/monkey.psd'))
    image.convert_precision(Gimp.Precision.FLOAT_LINEAR)
    procedure = Gimp.get_pdb().lookup_procedure('plug-in-celdepth-popup')
    assert procedure.get_menu_label() == MENU, procedure.get_menu_label()
    config = procedure.create_config()
    config.set_property('image', image)
    config.set_property('depth', True)
    group = procedure.run(config).index(1)
    layers = {layer.get_name(): layer for layer in group.get_children()}
    assert NAME in layers, layers.keys()
    buffer = layers[NAME].get_buffer()
    made = array.array('f', buffer.get(buffer.get_extent(), 1.0, 'Y float', Gegl.AbyssPolicy.NONE))
    wanted = read_npy('/out/depth.npy')
    assert len(made) == len(wanted), (len(made), len(wanted))
    error = max(abs(a - b) for a, b in zip(made, wanted))
    assert error <= 1 / 65535, error


try:
    check()
    RESULT = 'passed'
except BaseException:
    RESULT = traceback.format_exc()
with open(f'/out/{LOCALE}.txt', 'w', encoding='utf-8') as OUT:
    OUT.write(RESULT + '\n')
print(RESULT)
