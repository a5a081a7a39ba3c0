#!/usr/bin/python3
"""Compares what Krita made of layers with their drawings: within 1/255; and counts the checks of the plug-in.

compare.py EXAMPLES OUT

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import sys

import numpy as np
from PIL import Image

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from plugin_checks import checks_of_plugin  # noqa: E402


def pixels(*path):
    return np.array(Image.open(os.path.join(*path)).convert('RGBA')).astype(int)


def compare(examples, out, drawing):
    difference = np.abs(pixels(out, drawing + '.png') - pixels(examples, drawing, 'drawing.png')).max()
    print(f'{"ok  " if difference <= 1 else "FAIL"} layers of {drawing} differ by {difference}/255')
    return difference <= 1


def main():
    examples, out = sys.argv[1:]
    results = [compare(examples, out, drawing) for drawing in ('people', 'monkey', 'frog')]
    results += checks_of_plugin(out)
    print(f'{sum(results)} passed, {len(results) - sum(results)} failed')
    return 0 if all(results) else 1


if __name__ == '__main__':
    sys.exit(main())
