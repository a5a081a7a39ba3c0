#!/usr/bin/python3
"""The pipeline of the plug-ins gives what the command gives, for layers that are smaller than the drawing.

$CELDEPTH: the command; $RUN_PIPELINE: the program that runs the pipeline

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'examples')
DRAWINGS = {'people': ['scribbles', 'arrows'], 'frog': ['scribbles', 'arrows'], 'armadillo': ['scribbles', 'contours']}
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
            for name in [*OPTIONS, 'regions', 'suggestions']}


def channels(picture):
    picture = np.atleast_3d(np.squeeze(picture))
    return np.repeat(picture, 3, 2) if picture.shape[2] == 1 else picture


def main():
    passed = failed = 0
    for drawing, layers in DRAWINGS.items():
        with tempfile.TemporaryDirectory() as out:
            files = {name: os.path.join(EXAMPLES, drawing, name + '.png') for name in ['drawing', *layers]}
            wanted = command(files, out)
            found = pipeline(files, out, wanted['depth'].shape[:2])
            for name, picture in wanted.items():
                picture = channels(picture)
                alpha = picture[..., 3:] if picture.shape[2] == 4 else np.ones(picture.shape[:2] + (1,))
                difference = np.abs((found[name][..., :picture.shape[2]] - picture) * (alpha > 0)).max()
                good = difference <= ERROR and np.array_equal(found[name][..., 3:] > 0, alpha > 0)
                passed, failed = passed + good, failed + (not good)
                print(f'{"ok  " if good else "FAIL"} {drawing} {name}: differs by {difference:.2e}')
    print(f'{passed} passed, {failed} failed')
    return failed > 0 or not passed


if __name__ == '__main__':
    sys.exit(main())
