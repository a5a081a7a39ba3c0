#!/usr/bin/python3
"""Compares what the plug-in of GIMP 2.10 made with the command, and counts the checks.

compare.py OUT

8 bits: within 1/255; 16 and 32 bits, which GIMP saves as 16: within 1/65535.  All but normals is light, depth too;
GIMP's files have it encoded, but linear if the image has 32 bits.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import subprocess
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from plugin_checks import checks_of_plugin  # noqa: E402

LAYERS = {'Drawing with shadows': 'enhanced', 'Lit drawing': 'lit', 'Shading': 'shading', 'Normal map': 'normals',
          'Depth': 'depth', 'Levels': 'levels', 'Regions': 'regions'}


def encode(linear):
    """Linear light to sRGB."""
    v = np.clip(linear, 0, 1)
    return np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)


def pixels(path, shape):
    """RGBA of a PNG file in [0,1]."""
    raw = subprocess.run(['convert', path, '-depth', '16', 'rgba:-'], check=True, capture_output=True).stdout
    return np.frombuffer(raw, '<u2').reshape(*shape, 4) / 65535


def decode(encoded):
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def reference(out, name, linear, shape):
    """What the command made: RGBA in [0,1]."""
    if name == 'regions':
        values = pixels(os.path.join(out, 'people-regions.png'), shape).copy()
        values[..., :3] = decode(values[..., :3]) if linear else values[..., :3]
        return values
    values = np.atleast_3d(np.squeeze(np.load(os.path.join(out, f'people-{name}.npy')))).astype(float)
    if name == 'normals':
        values = 0.5 + 0.5 * values
    elif not linear:
        values[..., :3] = encode(values[..., :3])
    if values.shape[2] == 1:
        values = np.repeat(values, 3, 2)
    return values if values.shape[2] == 4 else np.dstack([values, np.ones(values.shape[:2])])


def compare(out, bits, layer, name, part=(slice(None), slice(None))):
    """`part`: the rows and columns that the layer has."""
    shape = np.load(os.path.join(out, 'people-depth.npy')).squeeze().shape
    wanted = reference(out, name, bits == '32', shape)[part]
    found = pixels(os.path.join(out, f'{bits}-{layer}.png'), wanted.shape[:2])
    difference = np.abs((found - wanted) * np.where(found[..., 3:] > 0, 1, [0, 0, 0, 1])).max()
    good = difference <= (1 / 65535 if bits in ('16', '32') else 1 / 255) + 1e-9
    print(f'{"ok  " if good else "FAIL"} {bits:5} bits {layer:22} differs by {difference:.2e}')
    return good


def main():
    out = sys.argv[1]
    results = [compare(out, bits, layer, name) for bits in ('8', '16', '32') for layer, name in LAYERS.items()]
    results += [compare(out, what, 'Lit drawing', 'lit') for what in ('again', 'masked')]
    results.append(compare(out, 'part', 'Lit drawing', 'lit', (slice(150, 450), slice(200, 700))))
    results += checks_of_plugin(out, 'plugin-german.txt')
    print(f'{sum(results)} passed, {len(results) - sum(results)} failed')
    return 0 if all(results) else 1


if __name__ == '__main__':
    sys.exit(main())
