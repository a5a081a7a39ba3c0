#!/usr/bin/python3
"""Compares what GIMP made of the layers with the command line.

compare.py OUT

8 bits: within 1/255 of the encoded value; 32 bits: within 1e-4 of the linear one.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import sys

import numpy as np
from PIL import Image

RESULTS = ['labels', 'order', 'levels', 'depth', 'normals', 'shading']
WANTED = {name: name for name in RESULTS}
WANTED.update({'popup-' + name: name for name in RESULTS})
WANTED.update({name: name for name in ('contours-segmentation', 'contours-depth', 'popup-contours', 'popup-problems')})


def encode(linear):
    """Linear light to sRGB."""
    v = np.clip(linear, 0, 1)
    return np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)


def decode(encoded):
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def reference(out, name):
    """Linear values, three a pixel."""
    if name == 'labels':
        return decode(np.array(Image.open(os.path.join(out, 'labels.png')).convert('RGB')) / 255)
    if name == 'normals':
        return 0.5 + 0.5 * np.load(os.path.join(out, 'normals.npy'))
    values = np.atleast_3d(np.squeeze(np.load(os.path.join(out, name + '.npy')))).astype(float)
    return np.repeat(values, 3, 2) if values.shape[2] == 1 else values


def compare(out, bits, name, wanted):
    found = np.load(os.path.join(out, f'{bits}-{name}.npy')).astype(float)
    if bits == 8:
        difference, error = np.abs(found / 255 - encode(wanted)).max(), 1 / 255
    else:
        difference, error = np.abs(found - wanted).max(), 1e-4
    good = difference <= error + 1e-7
    print(f'{"ok  " if good else "FAIL"} {bits:2} bits {name:22} differs by {difference:.2e}')
    return good


def main():
    out = sys.argv[1]
    results = [compare(out, bits, name, reference(out, wanted)) for name, wanted in WANTED.items() for bits in (8, 32)]
    print(f'{sum(results)} passed, {len(results) - sum(results)} failed')
    return 0 if all(results) else 1


if __name__ == '__main__':
    sys.exit(main())
