#!/usr/bin/python3
"""Soft scribbles for a case: sprayed with one brush, running on until they cross a stroke of another colour.

soft.py CASE OUT OPACITY HARDNESS RADIUS PAPER
PAPER: alpha (a transparent layer), white (flattened on it), or the quality of a JPEG (flattened, stored, read again).
OPACITY and HARDNESS lie between 0 and 1; within HARDNESS of its RADIUS, in pixels, the brush has its full opacity, from
there on less and less.  A stroke runs on from both of its ends, over the first stroke of another colour that it meets,
unless it would stain more than a third of the right paint of a region there.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import io
import sys
import zlib

import numpy as np
from PIL import Image
from scipy import ndimage

from cases.score import Case
from pixel import thin
from sloppy import MARGIN, ends_of, regions_of, strokes_in, tail

BEYOND = 8       # pixels that a stroke runs on beyond the one that it crosses
BRUSHES = [(0.3, 0.9, 4), (0.3, 0.5, 8), (0.5, 0, 12), (0.6, 0.75, 6), (0.8, 0.3, 8), (1, 0, 10), (1, 0.9, 5)]
LONGEST = 200    # pixels that a stroke may run on


def paths_of(truth, scribbles, colours):
    """(colour, path): the middle of every stroke, one pixel wide; at both ends it may run on over another colour."""
    regions = regions_of(truth)
    size = truth.shape[::-1]
    painted = scribbles[..., 3] > 127
    right, strokes = strokes_in(truth, regions, scribbles, colours)
    foreign = np.zeros(len(right))
    for shape, colour, stroke in strokes:
        others = painted & ~np.all(scribbles[..., :3] == colour, -1)
        width = max(2, round(2 * ndimage.distance_transform_edt(stroke).max()) - 1)
        path = thin(stroke)
        for end, direction in ends_of(stroke):
            for length in range(10, LONGEST, 5):
                added = tail(size, end, direction, width, length)
                if not (added & others).any():
                    continue
                longer = tail(size, end, direction, width, length + 2 * width + BEYOND) & ~stroke
                stained = np.bincount(regions[longer & (truth != shape)], minlength=len(right))
                stained[0] = 0
                if np.all(right >= MARGIN * (foreign + stained)):
                    foreign += stained
                    path |= tail(size, end, direction, 1, length + 2 * width + BEYOND)
                break
        yield colour, path


def sprayed(size, paths, opacity, hardness, radius):
    """The layer that strokes of one brush give: colours premultiplied by alpha, and alpha; all from 0 to 1."""
    paint, alpha = np.zeros((*size, 3)), np.zeros(size)
    for colour, path in paths:
        away = ndimage.distance_transform_edt(~path) / radius
        cover = opacity * np.clip((1 - away) / max(1 - hardness, 1 / radius), 0, 1)
        paint = paint * (1 - cover[..., None]) + cover[..., None] * np.array(colour) / 255
        alpha = alpha * (1 - cover) + cover
    return paint, alpha


def brush_of(name):
    """Opacity, hardness and radius of the brush that the case of a name gets."""
    return BRUSHES[zlib.crc32(name.encode()) % len(BRUSHES)]


def soft_case(folder, opacity, hardness, radius, paper):
    """The soft scribbles of the case in a folder, as a picture."""
    case = Case(folder)
    scribbles = np.array(Image.open(f'{folder}/scribbles.png').convert('RGBA'))
    colours = [(i, tuple(case.facts['colours'][str(i)])) for i in case.shapes]
    paths = paths_of(case.truth, scribbles, colours)
    paint, alpha = sprayed(case.truth.shape, paths, opacity, hardness, radius)
    if paper == 'alpha':
        pure = paint / np.maximum(alpha, 1e-6)[..., None]
        return Image.fromarray(np.round(255 * np.concatenate([pure, alpha[..., None]], -1)).astype(np.uint8))
    flat = Image.fromarray(np.round(255 * (paint + (1 - alpha[..., None]))).astype(np.uint8))
    if paper == 'white':
        return flat
    stored = io.BytesIO()
    flat.save(stored, 'JPEG', quality=int(paper))
    return Image.open(stored).convert('RGB')


if __name__ == '__main__':
    if len(sys.argv) != 7:
        sys.exit(__doc__)
    soft_case(sys.argv[1], *map(float, sys.argv[3:6]), sys.argv[6]).save(sys.argv[2])
