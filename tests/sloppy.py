#!/usr/bin/python3
"""Sloppy scribbles for a case: strokes that spill through a contour onto the paper behind it.

sloppy.py CASE OUT.png
Every stroke goes on from both of its ends, in the direction in which it ends, until the foreign paper that it stains
would be more than a third of the right paint in any region: soft scribbles obey the majority of paint, so a
segmentation that is not disturbed by them exists.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import sys

import numpy as np
from PIL import Image, ImageDraw
from scipy import ndimage

from cases.score import NO_SHAPE, Case

MARGIN = 3.2     # right paint over foreign paint, in every region
LOOK_BACK = 12   # pixels of a stroke that tell its direction
LONGEST = 60     # pixels that a stroke may run on


def regions_of(truth):
    """Numbers the connected pieces of paper of every shape from 1; 0 where nothing is scored."""
    regions, n = np.zeros(truth.shape, int), 0
    for shape in np.unique(truth[truth != NO_SHAPE]):
        piece, count = ndimage.label(truth == shape)
        regions[piece > 0] = piece[piece > 0] + n
        n += count
    return regions


def ends_of(stroke):
    """Both ends of a stroke and the unit directions that point out of them."""
    points = np.argwhere(stroke)[:, ::-1].astype(float)
    start = points[np.argmax(((points - points.mean(0)) ** 2).sum(1))]
    for end in (start, points[np.argmax(((points - start) ** 2).sum(1))]):
        distance = np.hypot(*(points - end).T)
        body = points[(distance > LOOK_BACK / 2) & (distance < LOOK_BACK)]
        if len(body):
            direction = end - body.mean(0)
            yield end, direction / np.hypot(*direction)


def tail(size, end, direction, width, length):
    """Mask of a straight stroke from an end."""
    picture = Image.new('L', size)
    far = end + direction * length
    ImageDraw.Draw(picture).line([tuple(end), tuple(far)], fill=255, width=width)
    return np.array(picture) > 0


def strokes_in(truth, regions, scribbles, colours):
    """Pixels of right paint by region, and (shape, colour, mask) of every stroke."""
    right, strokes = np.zeros(regions.max() + 1), []
    for shape, colour in colours:
        own = (scribbles[..., 3] > 127) & np.all(scribbles[..., :3] == colour, -1)
        right += np.bincount(regions[own & (truth == shape)], minlength=len(right))
        pieces, n = ndimage.label(own, np.ones((3, 3)))
        strokes += [(shape, colour, pieces == k) for k in range(1, n + 1)]
    return right, strokes


def sloppy(truth, scribbles, colours):
    """scribbles with tails; colours is a list of (shape, (r, g, b))."""
    regions, result = regions_of(truth), scribbles.copy()
    painted = scribbles[..., 3] > 127
    right, strokes = strokes_in(truth, regions, scribbles, colours)
    foreign = np.zeros(len(right))
    for shape, colour, stroke in strokes:
        width = max(2, round(2 * ndimage.distance_transform_edt(stroke).max()) - 1)
        for end, direction in ends_of(stroke):
            for length in range(LONGEST, 9, -5):
                added = tail(truth.shape[::-1], end, direction, width, length) & ~painted
                outside = added & (truth != shape)
                stained = np.bincount(regions[outside], minlength=len(right))
                stained[0] = 0
                more = np.bincount(regions[added & ~outside], minlength=len(right))
                if stained.any() and np.all(right + more >= MARGIN * (foreign + stained)):
                    right, foreign, painted = right + more, foreign + stained, painted | added
                    result[added] = (*colour, 255)
                    break
    return result


def sloppy_case(folder):
    """The sloppy scribbles of the case in a folder, as a picture."""
    case = Case(folder)
    scribbles = np.array(Image.open(os.path.join(folder, 'scribbles.png')).convert('RGBA'))
    colours = [(i, tuple(case.facts['colours'][str(i)])) for i in case.shapes]
    return Image.fromarray(sloppy(case.truth, scribbles, colours))


if __name__ == '__main__':
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sloppy_case(sys.argv[1]).save(sys.argv[2], optimize=True)
