#!/usr/bin/python3
"""A case as pixel art: redrawn at 128 pixels with lines one pixel wide, not antialiased.

pixel.py CASE OUT
Lines are thinned [Zhang and Suen 1984] and each pixel that they pass is black.  Truth and owner of a pixel are those of
most of what it covers; ink that no shape owns is not scored, nor are shapes that keep no scribble or too few pixels.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import os
import sys

import numpy as np
from PIL import Image

from cases.score import NO_SHAPE, Case

SIDE = 128   # pixels of the longer side
SMALLEST = 8 # pixels of a shape that is scored


def thin(ink):
    """The lines of a mask, one pixel wide and connected by 8 neighbours."""
    stride = ink.shape[1] + 2
    flat = np.pad(ink, 1).ravel()
    ring = np.array([-stride, 1 - stride, 1, 1 + stride, stride, stride - 1, -1, -1 - stride]) # clockwise from above
    at, removed = np.flatnonzero(flat), 1
    while removed:
        removed = 0
        for sides in ((0, 2, 4), (2, 4, 6)), ((0, 2, 6), (0, 4, 6)):
            around = flat[at[:, None] + ring]
            count = around.sum(1)
            once = (~around & np.roll(around, -1, 1)).sum(1) == 1
            gone = once & (count >= 2) & (count <= 6) & ~np.any([around[:, s].all(1) for s in sides], 0)
            flat[at[gone]] = False
            at, removed = at[~gone], removed + gone.sum()
    return flat.reshape(-1, stride)[1:-1, 1:-1]


class Grid:
    """The pixels of the small picture, and which of them each pixel of the large one lies in."""

    def __init__(self, height, width):
        self.scale = max(height, width) / SIDE
        self.shape = tuple(int(np.ceil(n / self.scale)) for n in (height, width))
        rows, columns = ((np.arange(n) / self.scale).astype(int) for n in (height, width))
        self.cell = rows[:, None] * self.shape[1] + columns

    def any(self, mask):
        return np.bincount(self.cell[mask], minlength=np.prod(self.shape)).reshape(self.shape) > 0

    def most(self, values, mask, none):
        """The most frequent value under the mask in each small pixel."""
        counts = np.bincount(self.cell[mask] * 256 + values[mask], minlength=256 * np.prod(self.shape))
        counts = counts.reshape(*self.shape, 256)
        return np.where(counts.any(-1), counts.argmax(-1), none)


def arrows_of(folder, case, truth, scale):
    """The arrows between shapes that are left, their ends on the nearest pixels of these."""
    with open(os.path.join(folder, 'arrows.txt')) as f:
        for line in f:
            ends = np.array([float(v) for v in line.split()]).reshape(2, 2)
            shapes = [case.truth[int(y), int(x)] for x, y in ends]
            places = [np.argwhere(truth == shape)[:, ::-1] + 0.5 for shape in shapes]
            if all(map(len, places)):
                yield [p[((p - end / scale) ** 2).sum(1).argmin()] for p, end in zip(places, ends)]


def pixel_case(folder, out):
    """Writes the case in `folder` as pixel art to the folder `out`."""
    case = Case(folder)
    grey = np.array(Image.open(os.path.join(folder, 'drawing.png')).convert('L'))
    large = np.array(Image.open(os.path.join(folder, 'scribbles.png')).convert('RGBA'))
    grid = Grid(*grey.shape)
    ink = grid.any(thin(grey < 128))
    truth = np.where(ink, NO_SHAPE, grid.most(case.truth, case.truth != NO_SHAPE, NO_SHAPE))
    scribbles = np.zeros((*grid.shape, 4), np.uint8)
    for shape in case.shapes:
        colour = case.facts['colours'][str(shape)]
        stroke = grid.any(thin((large[..., 3] > 0) & np.all(large[..., :3] == colour, -1))) & (truth == shape)
        if stroke.any() and (truth == shape).sum() >= SMALLEST:
            scribbles[stroke] = (*colour, 255)
        else:
            truth[truth == shape] = NO_SHAPE
    left = [shape for shape in case.shapes if (truth == shape).any()]
    facts = dict(case.facts, width=grid.shape[1], height=grid.shape[0], shapes=left,
                 nearer_farther=[p for p in case.facts['nearer_farther'] if set(p) <= set(left)])
    pictures = {'drawing': np.where(ink, 0, 255), 'truth': truth, 'owner': grid.most(case.owner, case.ink, 0),
                'ink': np.where(ink & grid.any(case.ink), 255, 0), 'scribbles': scribbles}
    os.makedirs(out, exist_ok=True)
    for name, picture in pictures.items():
        Image.fromarray(picture.astype(np.uint8)).save(os.path.join(out, name + '.png'))
    with open(os.path.join(out, 'truth.json'), 'w') as f:
        json.dump(facts, f)
    with open(os.path.join(out, 'arrows.txt'), 'w') as f:
        for (a, b), (c, d) in arrows_of(folder, case, truth, grid.scale):
            f.write(f'{a} {b} {c} {d}\n')


if __name__ == '__main__':
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    pixel_case(*sys.argv[1:])
