#!/usr/bin/python3
"""Cases with ground truth that nobody has worked with yet: made from clip art that is drawn by lot.

new_cases.py SVGS OUT [--seed N] [--count N] [--known NAME,...]

SVGS is a folder of SVG files whose shapes have outlines, such as that of the Debian package openclipart-svg (public
domain).  Each shape with a fill and an outline is a sheet; the order in which they are painted is their order of depth,
and an outline belongs to the shape that it was painted with.  Shapes with one of the two only are left out, or lines
that belong to nobody.  Each visible piece that is large enough gets a stroke, pieces that touch get a relation.
Drawings whose sheets meet without a line between them are passed over.  Look at what is wrong, as

    tests/new_cases.py /usr/share/openclipart/svg new --seed 5 && tests/quality --cases new --kinds clean,tinted

Needs lxml, rsvg-convert and what tests/quality needs.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import argparse
import colorsys
import io
import json
import os
import random
import re
import subprocess

import numpy as np
from lxml import etree
from PIL import Image
from scipy import ndimage
from skimage.graph import route_through_array

from cases.score import NO_SHAPE

SIDE = 1024            # of the drawing, in pixels
SHAPES = range(5, 61)  # with fill and outline
PIECES = 60            # shapes that are seen, at most
LEAST_PIECE = 250      # pixels, to be worth a stroke
LEAST_ROOM = 7         # pixels from the middle of a piece to its edge, to have room for one
BARE = 15              # pixels of borders without a line, at most
LEAST_TOUCH = 6        # pixels along which shapes touch

SVG = '{http://www.w3.org/2000/svg}'
DRAWN = {SVG + name for name in ('path', 'rect', 'circle', 'ellipse', 'polygon', 'polyline')}
HIDDEN = {SVG + name for name in ('defs', 'clipPath', 'mask', 'pattern', 'symbol', 'marker')}
PAINT = ('fill', 'stroke', 'opacity', 'fill-opacity', 'stroke-opacity', 'filter', 'mask', 'display', 'stroke-dasharray')


class Unfit(Exception):
    """The drawing makes no case."""


def declared(element):
    """The properties of an element itself, as a dictionary."""
    found = {name: element.get(name) for name in PAINT if element.get(name)}
    for part in (element.get('style') or '').split(';'):
        name, colon, value = part.partition(':')
        if colon:
            found[name.strip()] = value.strip()
    return found


def is_painted(element):
    """Whether an element is filled, and whether it has an outline."""
    found = {'fill': 'black', 'stroke': 'none'}
    for ancestor in [*reversed(list(element.iterancestors())), element]:
        found.update(declared(ancestor))
        if ancestor.tag in HIDDEN or found.get('display') == 'none':
            return False, False
    return found['fill'] != 'none', found['stroke'] not in ('none', 'transparent')


def repaint(element, paint):
    """Replaces what an element says of its paint."""
    kept = {name: value for name, value in declared(element).items() if name not in PAINT}
    for name in PAINT:
        element.attrib.pop(name, None)
    element.set('style', ';'.join(f'{name}:{value}' for name, value in {**kept, **paint}.items()))


class Drawing:
    """The shapes of an SVG file, each to be painted alone."""

    def __init__(self, path):
        self.root = etree.parse(path, etree.XMLParser(huge_tree=True, recover=True)).getroot()
        if any(self.root.find(f'.//{SVG}{name}') is not None for name in ('use', 'image')):
            raise Unfit
        shapes = [(e, *is_painted(e)) for e in self.root.iter() if e.tag in DRAWN]
        self.all = [e for e, _, _ in shapes]
        self.outlined = [(e, filled) for e, filled, outlined in shapes if outlined]
        sheets = sum(filled for _, filled in self.outlined)
        if sheets not in SHAPES or 2 * sum(filled and not outlined for _, filled, outlined in shapes) > sheets:
            raise Unfit
        for text in list(self.root.iter(SVG + 'text')):
            text.getparent().remove(text)
        for group in self.root.iter(SVG + 'g'):
            repaint(group, {})
        self.frame()

    def frame(self):
        """Finds the page that holds all outlines, and its size in pixels."""
        box = [float(x) for x in re.findall(r'[-+.\deE]+', self.root.get('viewBox') or '')]
        if len(box) != 4:
            size = [re.match(r'[.\d]+', self.root.get(name) or '') for name in ('width', 'height')]
            if not all(size):
                raise Unfit
            box = [0, 0, *(float(s.group()) for s in size)]
        margin = 0.25 * max(box[2:])
        self.page = [box[0] - margin, box[1] - margin, box[2] + 2 * margin, box[3] + 2 * margin]
        self.scale = 600 / max(self.page[2:])
        rows, columns = np.nonzero(self.cover([e for e, _ in self.outlined], 'stroke') > 0)
        if not len(rows):
            raise Unfit
        left, right = (self.page[0] + x / self.scale for x in (columns.min(), columns.max() + 1))
        top, bottom = (self.page[1] + y / self.scale for y in (rows.min(), rows.max() + 1))
        margin = 0.03 * max(right - left, bottom - top)
        self.page = [left - margin, top - margin, right - left + 2 * margin, bottom - top + 2 * margin]
        self.scale = SIDE / max(self.page[2:])

    def cover(self, elements, what):
        """The cover of the fill or stroke of some elements, 0 to 1."""
        for e in self.all:
            other = 'stroke' if what == 'fill' else 'fill'
            repaint(e, {what: '#000', other: 'none'} if e in elements else {'display': 'none'})
        size = [max(round(self.scale * length), 1) for length in self.page[2:]]
        for name in ('width', 'height', 'preserveAspectRatio'):
            self.root.attrib.pop(name, None)
        self.root.set('viewBox', ' '.join(str(x) for x in [*self.page[:2], *(s / self.scale for s in size)]))
        png = subprocess.run(['rsvg-convert', '-w', str(size[0]), '-h', str(size[1]), '-b', 'white'],
                             input=etree.tostring(self.root), capture_output=True, timeout=60, check=True).stdout
        return 1 - np.array(Image.open(io.BytesIO(png)).convert('L')) / 255


def paint(drawing):
    """Paints all shapes: the picture, who owns each pixel, and where an outline is seen."""
    light = owner = ink = None
    n = 0
    for element, filled in drawing.outlined:
        line = drawing.cover([element], 'stroke')
        if light is None:
            light, owner, ink = np.ones(line.shape), np.zeros(line.shape, int), np.zeros(line.shape, bool)
        if filled:
            fill = drawing.cover([element], 'fill')
            n += 1
            light = light + fill * (1 - light)
            owner[(fill > 0.5) | (line > 0.5)] = n
            ink = (ink & (fill <= 0.5)) | (line > 0.5)
        light = light * (1 - line)
    picture = np.uint8(np.round(255 * light))
    bare = ndimage.minimum_filter(picture, 3) > 200
    borders = ((owner[1:] != owner[:-1]) & bare[1:]).sum() + ((owner[:, 1:] != owner[:, :-1]) & bare[:, 1:]).sum()
    if borders > BARE or not 0.002 < (picture < 128).mean() < 0.4:
        raise Unfit
    return picture, owner, ink


def stroke_in(piece):
    """A stroke along the middle of a piece, as a mask, and a point on it; None: there is no room."""
    room = ndimage.distance_transform_edt(np.pad(piece, 1))[1:-1, 1:-1]
    if room.max() < LEAST_ROOM or piece.sum() < LEAST_PIECE:
        return None
    radius = min(5, max(2.5, 0.35 * room.max()))
    parts, _ = ndimage.label(room > radius + 2)
    middle = np.unravel_index(room.argmax(), room.shape)
    inside = np.argwhere(parts == parts[middle])
    ends = [middle]
    for _ in range(2):
        ends.append(tuple(inside[np.hypot(*(inside - ends[-1]).T).argmax()]))
    costs = np.where(parts == parts[middle], 1 / np.maximum(room, 1) ** 1.5, 1e6)
    way, _ = route_through_array(costs, *ends[1:], fully_connected=True, geometric=True)
    way = way[len(way) // 8:len(way) - len(way) // 8] or way
    track = np.ones(piece.shape, bool)
    track[tuple(np.transpose(way))] = False
    return (ndimage.distance_transform_edt(track) <= radius) & piece, way[len(way) // 2]


def scribble(truth):
    """Strokes in the pieces of all shapes that have room for one.  What has none is struck from the truth."""
    layer, places, colours = np.zeros((*truth.shape, 4), np.uint8), {}, {}
    for shape in sorted(set(np.unique(truth)) - {NO_SHAPE}):
        n = len(colours)
        vivid = ((0.95, 1), (0.6, 0.72), (0.8, 0.85))[n % 3]
        colour = [round(255 * c) for c in colorsys.hsv_to_rgb(n * 0.61803 % 1, *vivid)]
        pieces, count = ndimage.label(truth == shape)
        largest = 0
        for k in range(1, count + 1):
            piece = pieces == k
            made = stroke_in(piece)
            if not made:
                truth[piece] = NO_SHAPE
                continue
            layer[made[0]] = [*colour, 255]
            if piece.sum() > largest:
                largest = piece.sum()
                places[int(shape)], colours[int(shape)] = made[1], colour
    return layer, places, colours


def touching(owner, shapes):
    """Pairs of shapes that touch, the nearer one first."""
    sides = [np.stack([np.maximum(a, b)[a != b], np.minimum(a, b)[a != b]], 1)
             for a, b in ((owner[1:], owner[:-1]), (owner[:, 1:], owner[:, :-1]))]
    pairs, counts = np.unique(np.concatenate(sides), axis=0, return_counts=True)
    return [(int(a), int(b)) for (a, b), n in zip(pairs, counts) if n >= LEAST_TOUCH and a in shapes and b in shapes]


def without_shortcuts(pairs):
    """The pairs that do not follow from others.  A farther shape has a lower number."""
    behind = {}
    for a, b in sorted(pairs):
        behind[a] = behind.get(a, set()) | {b} | behind.get(b, set())
    return [(a, b) for a, b in pairs if not any(x == a and b in behind.get(y, ()) for x, y in pairs)]


def make_case(path, out):
    picture, owner, ink = paint(Drawing(path))
    truth = np.where(picture >= 250, owner, NO_SHAPE)
    before = (truth != NO_SHAPE).sum()
    layer, places, colours = scribble(truth)
    pairs = touching(owner, set(places))
    if not 4 <= len(places) <= PIECES or len(pairs) < 3 or 10 * (truth != NO_SHAPE).sum() < 9 * before:
        raise Unfit
    arrows = without_shortcuts(pairs)
    os.makedirs(out)
    layers = {'drawing': picture, 'scribbles': layer, 'truth': truth, 'owner': owner, 'ink': 255 * ink}
    for name, pixels in layers.items():
        Image.fromarray(pixels.astype(np.uint8)).save(os.path.join(out, name + '.png'))
    with open(os.path.join(out, 'arrows.txt'), 'w') as f:
        for a, b in arrows:
            f.write('{1} {0} '.format(*places[a]) + '{1} {0}\n'.format(*places[b]))
    with open(os.path.join(out, 'truth.json'), 'w') as f:
        json.dump({'source': os.path.basename(path), 'width': truth.shape[1], 'height': truth.shape[0],
                   'shapes': sorted(places), 'colours': {str(k): c for k, c in colours.items()},
                   'nearer_farther': pairs, 'arrows': arrows}, f)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('svgs')
    parser.add_argument('out')
    parser.add_argument('--seed', type=int, default=0)
    parser.add_argument('--count', type=int, default=20)
    parser.add_argument('--known', default='', help='names of files to be passed over, without their endings')
    args = parser.parse_args()
    files = {}
    for folder, _, names in os.walk(args.svgs):
        for name in names:
            if name.endswith('.svg') and name[:-4] not in args.known.split(','):
                files.setdefault(name[:-4], os.path.join(folder, name))
    lots = sorted(files)
    random.Random(args.seed).shuffle(lots)
    made = 0
    for name in lots:
        if made == args.count:
            break
        if os.path.getsize(files[name]) > 300000:
            continue
        try:
            make_case(files[name], os.path.join(args.out, name.lower().replace('-', '_')))
        except (Unfit, etree.LxmlError, subprocess.SubprocessError, ValueError):
            continue
        made += 1
        print(name, flush=True)


if __name__ == '__main__':
    main()
