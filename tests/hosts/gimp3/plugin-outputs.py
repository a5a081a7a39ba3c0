# Runs what the plug-in has beside Pop-up, and arrows of paths, without a screen, and compares with the command.
# For the Python interpreter of GIMP 3, with this folder in its path.
#
# SPDX-License-Identifier: LGPL-3.0-or-later
import json
import os
import subprocess

import gi
gi.require_version('Gegl', '0.4')
gi.require_version('Gimp', '3.0')
from gi.repository import Gegl, Gimp  # noqa: E402
import numpy as np  # noqa: E402
from people import (ERRORS, EXAMPLES, OUT, PRECISIONS, QUIET, Image, add_path, all_layers, by_name,  # noqa: E402
                    check, encode, file, open_people, pixels, pop_up, results, run)

FOLDER = os.path.join(OUT, 'outputs')


def layers_of(image):
    return [layer.get_name() for layer in all_layers(image.get_layers())]


def load(name):
    return np.squeeze(np.load(os.path.join(OUT, name + '.npy'))).astype(float)


# ------------------------------------------------------------------ Export depth

def read_png(path):
    return np.array(Image.open(path)).astype(float) / 65535


def read_exr(path, channel):
    subprocess.run(['oiiotool', path, '--ch', channel, '-d', 'float', '-o', path + '.tif'], check=True)
    return np.array(Image.open(path + '.tif')).astype(float)


def export(image, name, run_mode=QUIET, **arguments):
    path = os.path.join(FOLDER, name)
    good, _, message = run('plug-in-celdepth-export-depth', image, run_mode, file=file(path), **arguments)
    return path, good, message


def near(found, wanted, error, what):
    difference = np.abs(found - wanted).max() if found.shape == wanted.shape else 1
    check(difference <= error, f'{what} differs by {difference:.2e}')


def exported_depth_is_that_of_the_command():
    for bits in (8, 32):  # the depth of the files does not depend on the image's
        image = open_people(bits)
        before = layers_of(image)
        path, good, message = export(image, f'anew-{bits}.png')
        check(good and layers_of(image) == before, f'Export depth runs and leaves the image as it is {message}')
        near(read_png(path), read_png(f'{OUT}/command-depth.png'), 1.01 / 65535, f'{bits} bits: depth in a PNG')
        path, good, message = export(image, f'anew-{bits}.exr')
        for channel in ('Z', 'depth.V'):
            near(read_exr(path, channel), read_exr(f'{OUT}/command-depth.exr', channel), 1 / 65535,
                 f'{bits} bits: channel {channel} of an EXR')
        path, good, message = export(image, f'levels-{bits}.png', picture='levels')
        near(read_png(path), read_png(f'{OUT}/command-levels.png'), 1.01 / 65535, f'{bits} bits: levels in a PNG')
        image.delete()


def layers_of_the_group_are_exported_as_they_are():
    for bits in PRECISIONS:
        image = open_people(bits)
        _, group, _ = pop_up(image, ['depth'])
        depth = results(group)['depth']
        path, good, message = export(image, f'layer-{bits}.png')
        stored, exported = pixels(depth, 'Y float', np.float32, 1)[..., 0], read_png(path)
        if bits == 8:  # which are encoded: the step below 1 is 2.3 / 255
            near(exported, stored, 0.6 / 255 * 2.3, f'8 bits: the layer Depth {message}')
        else:
            near(exported, stored, 1.01 / 65535, f'{bits} bits: the layer Depth {message}')
        depth.fill(Gimp.FillType.WHITE)
        depth.set_offsets(100, 50)
        path, _, _ = export(image, f'painted-{bits}.png')
        painted = read_png(path)
        check(painted[50:, 100:].min() > 1 - ERRORS[bits] and painted[:50].max() == 0 and painted[:, :100].max() == 0,
              f'{bits} bits: what the artist changed counts, at its place')
        if bits == 8:
            path, _, _ = export(image, 'anew-again.png', source='drawing')
            near(read_png(path), read_png(f'{OUT}/command-depth.png'), 1.01 / 65535, 'depth made anew')
            path, _, _ = export(image, 'levels-again.png', picture='levels')
            near(read_png(path), read_png(f'{OUT}/command-levels.png'), 1.01 / 65535, 'levels, no layer')
        image.delete()


def a_layer_is_exported_without_what_made_it():
    image = open_people(8)
    _, group, _ = pop_up(image, ['depth'])
    stored = pixels(results(group)['depth'], 'Y float', np.float32, 1)[..., 0]
    for name in ('Scribbles', 'Arrows'):
        image.remove_layer(by_name(image, name))
    path, good, message = export(image, 'alone.png')
    near(read_png(path), stored, 1.01 / 65535, f'8 bits: the layer Depth alone {message}')
    image.delete()


def open_armadillo():
    """Across its blue contours depth has thousands of values."""
    image = Gimp.file_load(QUIET, file(EXAMPLES, 'armadillo', 'drawing.png'))
    if image.get_base_type() != Gimp.ImageBaseType.RGB:
        image.convert_rgb()
    image.get_layers()[0].set_name('Drawing')
    for name in ('scribbles', 'contours'):
        layer = Gimp.file_load_layer(QUIET, image, file(EXAMPLES, 'armadillo', name + '.png'))
        layer.set_name(name)
        image.insert_layer(layer, None, 0)
    with open(os.path.join(EXAMPLES, 'armadillo', 'relations.txt'), encoding='utf-8') as f:
        return image, {'relations': f.read()}


def few_bits_of_an_image_do_not_limit_what_is_exported():
    image, relations = open_armadillo()
    wanted = load('popup-contours')
    _, group, _ = pop_up(image, ['depth'], **relations)
    depth = results(group)['depth']
    steps = len(np.unique(pixels(depth, 'Y float', np.float32, 1)))
    path, good, message = export(image, 'armadillo.png', **relations)
    near(read_png(path), wanted, 1.01 / 65535, f'8 bits: depth {message}')
    check(steps <= 256 < len(np.unique(read_png(path))), f'has more than the {steps} steps of its layer')
    image.select_rectangle(Gimp.ChannelOps.REPLACE, 400, 200, 60, 40)
    Gimp.context_set_foreground(Gegl.Color.new('black'))
    depth.edit_fill(Gimp.FillType.FOREGROUND)
    Gimp.Selection.none(image)
    check(wanted[200:240, 400:460].min() > 0.1, 'a part is painted over')
    wanted[200:240, 400:460] = 0
    path, good, message = export(image, 'armadillo-painted.png', **relations)
    near(read_png(path), wanted, 1.01 / 65535, f'8 bits: depth with paint, which counts, {message}')
    image.delete()


def an_image_stays_clean_and_remembers_its_file():
    xcf = file(FOLDER, 'clean.xcf')
    image = open_people(16)
    Gimp.file_save(QUIET, image, xcf, None)
    image.delete()
    image = Gimp.file_load(QUIET, xcf)
    image.clean_all()
    path, good, _ = export(image, 'remembered.png', picture='levels')
    check(good and not image.is_dirty(), 'an export leaves nothing to be saved')
    first = read_png(path)
    os.remove(path)
    good, _, message = run('plug-in-celdepth-export-depth', image, Gimp.RunMode.WITH_LAST_VALS)
    check(good and os.path.exists(path) and np.array_equal(read_png(path), first),
          f'another run writes the same file again {message}')
    Gimp.file_save(QUIET, image, xcf, None)
    image.delete()
    image = Gimp.file_load(QUIET, xcf)
    check('plug-in-celdepth-export-depth' not in image.get_parasite_list(), 'no name of a file is in the image\'s own')
    good, _, message = run('plug-in-celdepth-export-depth', image, Gimp.RunMode.WITH_LAST_VALS)
    check(good and os.path.exists(os.path.join(FOLDER, 'clean-depth.exr')), f'the first name is the image\'s {message}')
    image.delete()


def files_that_cannot_be_written_are_refused():
    def refused(image, words, procedure='export-depth', **arguments):
        before, files = layers_of(image), sorted(os.listdir(FOLDER))
        good, _, message = run('plug-in-celdepth-' + procedure, image, **arguments)
        check(not good and words in message and layers_of(image) == before and sorted(os.listdir(FOLDER)) == files,
              f'refused: {message}')

    image = open_people(8)
    refused(image, 'No file is chosen')
    refused(image, 'must end in .exr, .png or .tif', file=file(FOLDER, 'depth.jpg'))
    refused(image, 'no folder', file=file(FOLDER, 'nowhere', 'depth.png'))
    os.makedirs(os.path.join(FOLDER, 'folder.png'), exist_ok=True)
    refused(image, '', file=file(FOLDER, 'folder.png'))  # by GIMP itself
    refused(image, 'must end in .glb', 'relief-mesh', file=file(FOLDER, 'mesh.exr'))
    refused(image, 'no folder', 'relief-mesh', file=file(FOLDER, 'nowhere', 'mesh.glb'))
    refused(image, 'Allow more vertices', 'relief-mesh', file=file(FOLDER, 'mesh.glb'), most_vertices=1000)
    for name in ('Scribbles', 'Arrows'):
        image.remove_layer(by_name(image, name))
    refused(image, 'Set up layers', file=file(FOLDER, 'depth.png'))
    refused(image, 'Set up layers', 'relief-mesh', file=file(FOLDER, 'mesh.glb'))
    refused(image, 'Set up layers', 'stereo')
    image.delete()


# ------------------------------------------------------------------ Stereo

def same_view(layer, name, bits):
    wanted = load('command-' + name)
    found = pixels(layer, 'RGBA float' if bits == 32 else "R'G'B'A float", np.float32, 4)
    colours = wanted[..., :3] if bits == 32 else encode(wanted[..., :3])
    near(found[..., :3] * (wanted[..., 3:] > 0), colours * (wanted[..., 3:] > 0), ERRORS[bits] + 1e-6,
         f'{bits} bits: {name}')


def views_are_those_of_the_command():
    for bits in PRECISIONS:
        image = open_people(bits)
        before = layers_of(image)
        good, layer, message = run('plug-in-celdepth-stereo', image)
        check(good and layers_of(image) == ['Cartoon Depth', 'Stereo', *before], f'Stereo makes a layer {message}')
        same_view(layer, 'dubois', bits)
        layer.set_opacity(40)
        _, again, _ = run('plug-in-celdepth-stereo', image, disparity=0.0)
        check(again.get_id() == layer.get_id() and round(again.get_opacity()) == 40, 'a second run keeps the layer')
        good, left, _ = run('plug-in-celdepth-stereo', image, stereo='two-layers')
        views = results(left.get_parent())
        check(sorted(views) == ['stereo-left', 'stereo-right'] and left.get_id() == views['stereo-left'].get_id(),
              f'two layers take its place: {sorted(views)}')
        same_view(views['stereo-left'], 'left', bits)
        same_view(views['stereo-right'], 'right', bits)
        _, group, _ = pop_up(image, ['depth'])
        check(sorted(results(group)) == ['depth', 'stereo-left', 'stereo-right'], 'Pop-up leaves the views alone')
        image.delete()


def large_views_are_a_new_image():
    image = open_people(16)
    before = layers_of(image)
    good, layer, message = run('plug-in-celdepth-stereo', image, stereo='side-by-side', disparity=0.03,
                               convergence=0.25)
    made = layer.get_image() if good else None
    check(good and made.get_id() != image.get_id() and layers_of(image) == before,
          f'views side by side are a new image {message}')
    check((made.get_width(), made.get_height()) == (2 * image.get_width(), image.get_height()), 'as wide as both')
    same_view(layer, 'side-by-side', 16)
    made.delete()
    good, layer, _ = run('plug-in-celdepth-stereo', image, stereo='two-layers', new_image=True)
    made = layer.get_image()
    check(layers_of(made) == ['Left view', 'Right view'] and made.get_precision() == image.get_precision(),
          f'layers of a new image: {layers_of(made)}')
    same_view(layer, 'left', 16)
    made.delete()
    image.delete()


# ------------------------------------------------------------------ Relief mesh

def read_glb(path):
    with open(path, 'rb') as f:
        data = f.read()
    content = json.loads(data[20:20 + int.from_bytes(data[12:16], 'little')])
    return [mesh.get('name') for mesh in content['meshes']], [a['count'] for a in content['accessors']]


def read_stl(path):
    with open(path, 'rb') as f:
        data = f.read()
    return np.frombuffer(data[84:], np.dtype([('corners', '<f4', 12), ('zero', '<u2')]))['corners'][:, 3:].astype(float)


def meshes_are_those_of_the_command():
    image = open_people(8)
    before = layers_of(image)
    path = os.path.join(FOLDER, 'relief.glb')
    good, _, message = run('plug-in-celdepth-relief-mesh', image, file=file(path))
    check(good and read_glb(path) == read_glb(f'{OUT}/command-relief.glb'),
          f'a GLB has the parts of the command\'s {message}')
    path = os.path.join(FOLDER, 'relief.stl')
    good, _, message = run('plug-in-celdepth-relief-mesh', image, file=file(path), mesh_size=50.0)
    near(read_stl(path), read_stl(f'{OUT}/command-relief.stl'), 1e-4, f'triangles of an STL, in mm, {message}')
    path = os.path.join(FOLDER, 'surface.obj')
    good, _, message = run('plug-in-celdepth-relief-mesh', image, file=file(path), mesh_kind='heightfield')
    check(good and {'surface.obj', 'surface.mtl', 'surface-texture.png'} <= set(os.listdir(FOLDER)),
          f'an OBJ has its texture beside it {message}')
    check(layers_of(image) == before, 'and the image is as it was')
    image.delete()


# ------------------------------------------------------------------ arrows of paths

ARROWS = [[(400, 150), (430, 100), (460, 215)], [(388, 327), (388, 240)], [(415, 650), (470, 580)],
          [(660, 265), (745, 278)]]


def paths_are_arrows():
    def depth_is(image, name, what):
        good, group, message = pop_up(image, ['depth'])
        near(pixels(results(group)['depth'], 'Y float', np.float32, 1)[..., 0] if good else np.zeros(1), load(name),
             ERRORS[32], f'{what}: depth {message}')

    for name, other in (('Arrows', 'Arrows'), ('šipky', 'PFEILE')):
        image = open_people(32)
        image.remove_layer(by_name(image, 'Arrows'))
        add_path(image, name, *ARROWS[:2])
        add_path(image, other, *ARROWS[2:])
        add_path(image, 'sketch', [(300, 770), (700, 830)])
        names = [path.get_name() for path in image.get_paths()]
        depth_is(image, 'path-depth', f'paths {names}')
        image.delete()
    image = open_people(32)
    image.remove_layer(by_name(image, 'Arrows'))
    add_path(image, 'Arrows', *ARROWS)
    add_path(image, 'arrows', ARROWS[0], closed=True)
    add_path(image, 'arrow', [(5, 5)], [(7, 7), (9, 20), (7, 7)])
    depth_is(image, 'path-depth', 'with strokes that are no arrows')
    for path in image.get_paths():
        image.remove_path(path)
    add_path(image, 'Arrows', *[stroke[::-1] for stroke in ARROWS])
    _, group, _ = pop_up(image, ['depth'])
    turned = pixels(results(group)['depth'], 'Y float', np.float32, 1)[..., 0]
    check(np.abs(turned - load('path-depth')).max() > 0.1, 'the direction of a path counts')
    image.delete()
    image = open_people(32)
    add_path(image, 'Arrows', [(300, 770), (700, 830)])
    _, group, _ = pop_up(image, ['levels'])
    near(pixels(results(group)['levels'], 'Y float', np.float32, 1)[..., 0], load('both-levels'), ERRORS[32],
         'paths and painted arrows together: levels')
    check(np.abs(load('both-levels') - load('levels')).max() > 0.01, 'and the path adds to them')
    image.delete()
    image = open_people(8)
    for name in ('Scribbles', 'Arrows'):
        image.remove_layer(by_name(image, name))
    add_path(image, 'Arrows', *ARROWS)
    good, _, message = pop_up(image, ['depth'])
    check(good, f'paths alone are enough {message}')
    image.delete()


Gegl.init(None)
os.makedirs(FOLDER, exist_ok=True)
exported_depth_is_that_of_the_command()
layers_of_the_group_are_exported_as_they_are()
a_layer_is_exported_without_what_made_it()
few_bits_of_an_image_do_not_limit_what_is_exported()
an_image_stays_clean_and_remembers_its_file()
files_that_cannot_be_written_are_refused()
views_are_those_of_the_command()
large_views_are_a_new_image()
meshes_are_those_of_the_command()
paths_are_arrows()
