#!/usr/bin/python3
"""A drawing as people bring it, instead of clean black lines on white.

brought.py CASE OUT KIND

coloured: dark brown lines over flat fills in strong colours;  tinted: each line in a darker shade of the part that it
outlines;  pastel: dark lines over pale fills;  photo: of a drawing on rough paper in uneven light, as a JPEG;  scan:
blurred and grainy, on yellowish paper;  chalk: grainy white lines on a dark board.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import colorsys
import io
import os
import sys
import zlib

import numpy as np
from PIL import Image
from scipy import ndimage

from cases.score import NO_SHAPE, Case

BROUGHT = ['coloured', 'tinted', 'pastel', 'photo', 'scan', 'chalk']


def fills_of(case, rng, saturation, value):
    """A colour for each pixel, below lines, too: that of the nearest shape's paper."""
    indices = ndimage.distance_transform_edt(case.truth == NO_SHAPE, return_distances=False, return_indices=True)
    shape = case.truth[tuple(indices)]
    colour = np.zeros((256, 3))
    for k in case.shapes:
        colour[k] = colorsys.hsv_to_rgb(rng.random(), rng.uniform(*saturation), rng.uniform(*value))
    if 0 in case.shapes:
        colour[0] = 0.97
    return colour, colour[shape]


def grain(rng, shape, radius):
    noise = ndimage.gaussian_filter(rng.normal(size=shape), radius)
    return noise / noise.std()


def uneven_light(shape):
    y, x = np.mgrid[0:1:shape[0] * 1j, 0:1:shape[1] * 1j]
    return 0.95 - 0.3 * (0.6 * x + 0.4 * y) - 0.1 * np.exp(-((x - 0.3) ** 2 + (y - 0.7) ** 2) / 0.08)


def as_jpeg(picture, quality):
    data = io.BytesIO()
    picture.save(data, 'JPEG', quality=quality)
    return Image.open(data).convert(picture.mode)


def brought_case(folder, kind):
    """The drawing of the case in a folder, as a picture."""
    case = Case(folder)
    cover = 1 - np.array(Image.open(os.path.join(folder, 'drawing.png')).convert('L')) / 255
    rng = np.random.default_rng(zlib.crc32(f'{os.path.basename(folder)}-{kind}-2'.encode()))
    if kind in ('coloured', 'tinted', 'pastel'):
        colour, fill = fills_of(case, rng, *(((0.12, 0.3), (0.88, 1)) if kind == 'pastel' else ((0.4, 0.8), (0.5, 0.9))))
        line = 0.4 * colour[case.owner] if kind == 'tinted' else np.array([0.24, 0.12, 0.08])
        picture = fill + cover[..., None] * (line - fill)
    elif kind == 'photo':
        paper = uneven_light(cover.shape) * (0.9 + 0.03 * grain(rng, cover.shape, 1) + 0.015 * grain(rng, cover.shape, 4))
        picture = paper * (1 - 0.85 * cover)
    elif kind == 'scan':
        grey = 1 - 0.85 * ndimage.gaussian_filter(cover, 0.8) + 0.012 * rng.normal(size=cover.shape)
        picture = grey[..., None] * (0.98, 0.95, 0.86)
    else:
        picture = 0.16 + 0.02 * grain(rng, cover.shape, 0.8) + \
            cover * np.clip(0.65 - 0.2 * np.abs(grain(rng, cover.shape, 0.9)), 0.15, 1)
    picture = Image.fromarray(np.uint8(np.round(255 * np.clip(picture, 0, 1))))
    return as_jpeg(picture, {'photo': 60, 'chalk': 85}[kind]) if kind in ('photo', 'chalk') else picture


if __name__ == '__main__':
    if len(sys.argv) != 4 or sys.argv[3] not in BROUGHT:
        sys.exit(__doc__)
    brought_case(sys.argv[1].rstrip('/'), sys.argv[3]).save(sys.argv[2])
