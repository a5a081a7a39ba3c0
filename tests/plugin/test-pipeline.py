#!/usr/bin/python3
"""The pipeline of the plug-ins gives what the command gives, for layers that are smaller than the drawing.

$CELDEPTH: the command; $RUN_PIPELINE: the program that runs the pipeline

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import os
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image, ImageDraw

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'examples')
DRAWINGS = {'people': ['scribbles', 'arrows'], 'frog': ['scribbles', 'arrows'], 'armadillo': ['scribbles', 'contours'],
            'all layers': []}
OPTIONS = {'levels': 'levels', 'depth': 'depth', 'normals': 'normals', 'shading': 'shading', 'lit': 'shaded',
           'enhanced': 'enhanced'}
ERROR = 1 / 65535


def decode(encoded):
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def command(files, out):
    """Every picture by the command, in linear light."""
    options = [word for name in files if name != 'drawing' for word in ('--' + name, files[name])]
    outputs = [word for name, option in OPTIONS.items() for word in ('--' + option, f'{out}/{name}.npy')]
    subprocess.run([os.environ['CELDEPTH'], 'popup', files['drawing'], '--quiet', *options, *outputs,
                    '--labels', f'{out}/regions.png', '--suggested-arrows', f'{out}/suggestions.png'], check=True)
    results = {name: np.load(f'{out}/{name}.npy').astype(float) for name in OPTIONS}
    results['normals'] = 0.5 + 0.5 * results['normals']
    subprocess.run([os.environ['CELDEPTH'], 'stereo', files['drawing'], '--quiet', *options,
                    '--left', f'{out}/left.npy', '--right', f'{out}/right.npy'], check=True)
    results.update({name: np.load(f'{out}/{name}.npy').astype(float) for name in ('left', 'right')})
    for name in ('regions', 'suggestions'):
        rgba = np.array(Image.open(f'{out}/{name}.png').convert('RGBA')) / 255
        results[name] = np.dstack([decode(rgba[..., :3]), rgba[..., 3]])
    return results


def pipeline(files, out, shape):
    # GEGL's loaders leave leaks of libraries that are unloaded before the end; test-pipeline finds those of the pipeline.
    sanitizer = {'ASAN_OPTIONS': os.environ.get('ASAN_OPTIONS', '') + ':detect_leaks=0'}
    subprocess.run([os.environ['RUN_PIPELINE'], out, *(f'{name}={path}' for name, path in files.items())], check=True,
                   env=os.environ | sanitizer)
    return {name: np.fromfile(f'{out}/{name}.raw', np.float32).reshape(*shape, 4).astype(float)
            for name in [*OPTIONS, 'regions', 'suggestions', 'left', 'right']}


def all_layers(out):
    """A drawing with every kind of layer, as files."""
    files = {name: f'{out}/{name}.png' for name in ('drawing', 'scribbles', 'arrows', 'contours', 'corrections', 'hidden')}
    for name in ('drawing', 'scribbles', 'arrows'):
        picture = Image.open(os.path.join(EXAMPLES, 'people', name + '.png')).convert('RGBA')
        picture.save(files[name])
    red, middle = (255, 0, 0), (111, 184, 9) # the colour of the body in the middle, which the left one hides
    strokes = {'contours': ((30, 720, 480, 720), red), 'corrections': ((370, 560, 420, 610), middle),
               'hidden': ((330, 650, 440, 650), middle)}
    for name, (line, colour) in strokes.items():
        layer = Image.new('RGBA', picture.size)
        ImageDraw.Draw(layer).line(line, colour, 11)
        layer.save(files[name])
    return files


def counts(name, files, wanted, out):
    """Whether the command makes something else without a layer."""
    options = [word for other in files if other not in ('drawing', name) for word in ('--' + other, files[other])]
    pictures = {'levels': 'levels', 'lit': 'shaded', 'right': 'right'}
    outputs = [word for picture, option in pictures.items() for word in ('--' + option, f'{out}/{picture}.npy')]
    subprocess.run([os.environ['CELDEPTH'], 'popup', files['drawing'], '--quiet', *options, *outputs], check=True)
    return any(np.abs(np.load(f'{out}/{picture}.npy') - wanted[picture]).max() > ERROR for picture in pictures)


def same_bytes(found, wanted):
    return found == wanted


def same_triangles(found, wanted):
    """Of two binary STL files, within a ten thousandth of a millimetre."""
    found, wanted = (np.frombuffer(data[84:], np.dtype([('corners', '<f4', 12), ('zero', '<u2')]))['corners'][:, 3:]
                     for data in (found, wanted))
    return found.shape == wanted.shape and np.abs(found - wanted).max() < 1e-4


def same_parts(found, wanted):
    """Of two GLB files the names of the parts and the numbers of their vertices and triangles."""
    found, wanted = (json.loads(data[20:20 + int.from_bytes(data[12:16], 'little')]) for data in (found, wanted))
    return [part.get('name') for part in found['meshes']] == [part.get('name') for part in wanted['meshes']] and \
        [part['count'] for part in found['accessors']] == [part['count'] for part in wanted['accessors']]


FILES = {'saved.exr': (same_bytes, 'popup', '--levels'), 'saved.png': (same_bytes, 'popup', '--depth'),
         'parts.glb': (same_parts, 'relief', '--mesh'), 'parts.stl': (same_triangles, 'relief', '--mesh'),
         'surface.obj': (same_bytes, 'relief', '--mesh-kind', 'heightfield', '--mesh')}


def same_files(files, out):
    """Whether each file that the pipeline wrote is that of the command."""
    options = [word for name in files if name != 'drawing' for word in ('--' + name, files[name])]
    os.mkdir(f'{out}/command')
    for name, (same, command_name, *words) in FILES.items():
        subprocess.run([os.environ['CELDEPTH'], command_name, files['drawing'], '--quiet', *options, *words,
                        f'{out}/command/{name}'], check=True)
        with open(f'{out}/{name}', 'rb') as found, open(f'{out}/command/{name}', 'rb') as wanted:
            yield name, same(found.read(), wanted.read())


def channels(picture):
    picture = np.atleast_3d(np.squeeze(picture))
    return np.repeat(picture, 3, 2) if picture.shape[2] == 1 else picture


def main():
    passed = failed = 0
    for drawing, layers in DRAWINGS.items():
        with tempfile.TemporaryDirectory() as out:
            files = {name: os.path.join(EXAMPLES, drawing, name + '.png') for name in ['drawing', *layers]} if layers \
                else all_layers(out)
            wanted = command(files, out)
            for name in () if layers else files.keys() - {'drawing', 'scribbles'}:
                good = counts(name, files, wanted, out)
                passed, failed = passed + good, failed + (not good)
                print(f'{"ok  " if good else "FAIL"} the layer with {name} counts')
            found = pipeline(files, out, wanted['depth'].shape[:2])
            for name, picture in wanted.items():
                picture = channels(picture)
                alpha = picture[..., 3:] if picture.shape[2] == 4 else np.ones(picture.shape[:2] + (1,))
                difference = np.abs((found[name][..., :picture.shape[2]] - picture) * (alpha > 0)).max()
                good = difference <= ERROR and np.array_equal(found[name][..., 3:] > 0, alpha > 0)
                passed, failed = passed + good, failed + (not good)
                print(f'{"ok  " if good else "FAIL"} {drawing} {name}: differs by {difference:.2e}')
            if drawing == 'people':
                for name, good in same_files(files, out):
                    passed, failed = passed + good, failed + (not good)
                    print(f'{"ok  " if good else "FAIL"} {drawing} {name} is the file of the command')
    print(f'{passed} passed, {failed} failed')
    return failed > 0 or not passed


if __name__ == '__main__':
    sys.exit(main())
