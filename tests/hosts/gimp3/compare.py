#!/usr/bin/python3
"""Compares what GIMP made of the layers with the command line.

compare.py OUT

8 bits: within 1/255 of the encoded value; 32 bits: within 1/65535 of the linear one.  What levels or depth of 8 bits
make coarse is compared at 32 bits only.  Layers together are the drawing.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import os
import sys

import numpy as np
from PIL import Image

EXAMPLES = os.environ['CELDEPTH_EXAMPLES']
WANTED = {'popup-' + name: name for name in ('labels', 'order', 'levels', 'depth')}
WANTED.update({name: name for name in ('labels', 'propagated', 'order', 'levels', 'depth', 'normals', 'shading', 'tone',
                                       'occlusion', 'popup-normals', 'popup-shading', 'popup-problems',
                                       'popup-contours', 'contours-segmentation', 'contours-depth', 'exact',
                                       'popup-suggestions', 'segment-closures', 'segment-problems', 'deformed',
                                       'deformed-levels', 'propagated-scribbles', 'propagated-levels',
                                       'propagated-depth', 'propagated-confidence', 'enhanced-art', 'enhanced-view',
                                       'enhanced-layer')})
WANTED['popup-moved'] = 'levels'  # a layer that was moved counts as if it were not
EXACT_ONLY = ('relief', 'stereo', 'compose', 'composed-levels', 'displacement', 'warped', 'confidence',
              'expanded-layer', 'expanded-matte', 'lumo-art', 'rim')


def encode(linear):
    """Linear light to sRGB."""
    v = np.clip(linear, 0, 1)
    return np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)


def decode(encoded):
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def reference(out, name):
    """Linear values, three a pixel."""
    if name in ('labels', 'propagated'):
        return decode(np.array(Image.open(os.path.join(out, name + '.png')).convert('RGB')) / 255)
    if name.endswith('normals'):
        return 0.5 + 0.5 * np.load(os.path.join(out, name + '.npy'))
    values = np.atleast_3d(np.squeeze(np.load(os.path.join(out, name + '.npy')))).astype(float)
    if name == 'enhanced-layer':  # black, with shadows as its alpha
        values = values[..., 3:]
    if name == 'relief':
        values = (values - values.min()) / np.ptp(values)
    return np.repeat(values, 3, 2) if values.shape[2] == 1 else values[:, :, :3]


def compare(out, bits, name, wanted):
    found = np.load(os.path.join(out, f'{bits}-{name}.npy')).astype(float)
    if bits == 8:
        numbers = wanted if name == 'enhanced-layer' else encode(wanted)  # alpha is not encoded
        difference, error = np.abs(found / 255 - numbers).max(), 1 / 255
    else:
        difference, error = np.abs(found - wanted).max(), 1 / 65535
    good = difference <= error + 1e-7
    print(f'{"ok  " if good else "FAIL"} {bits:2} bits {name:22} differs by {difference:.2e}')
    return good


def compare_layers(out, drawing):
    """GIMP shows the drawing within 1/255, in a layer a label, the front one first."""
    path = os.path.join(out, 'layers-' + drawing)
    wanted = np.array(Image.open(os.path.join(EXAMPLES, drawing, 'drawing.png')).convert('RGBA')).astype(int)
    with open(path + '.json') as report, open(path + '.txt') as names:
        labels = sorted((label['layer'], label['colour']) for label in json.load(report)['labels'])
        found = names.read().split()
    difference = np.abs(np.load(path + '.npy').astype(int) - wanted).max()
    good = difference <= 1 and found[::-1] == [c.replace('transparent', 'background') for _, c in labels]
    print(f'{"ok  " if good else "FAIL"} {len(found)} layers of {drawing} differ by {difference}/255')
    return good


def checks_of_plugin(out):
    """What the tests of the plug-in found, without and with a screen."""
    for name in ('plugin.txt', 'plugin-screen.txt', 'live.txt', 'live-group.txt'):
        with open(os.path.join(out, name)) as checks:
            for line in checks:
                print(line.rstrip())
                yield line.startswith('ok')


def main():
    out = sys.argv[1]
    results = [compare(out, bits, name, reference(out, wanted)) for name, wanted in WANTED.items() for bits in (8, 32)]
    results += [compare(out, 32, name, reference(out, name)) for name in EXACT_ONLY]
    results += [compare_layers(out, drawing) for drawing in ('people', 'monkey', 'frog')]
    results += checks_of_plugin(out)
    print(f'{sum(results)} passed, {len(results) - sum(results)} failed')
    return 0 if all(results) else 1


if __name__ == '__main__':
    sys.exit(main())
