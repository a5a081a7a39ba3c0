#!/usr/bin/python3
"""Models of drawings whose true shapes are known (tests/cases): outlines, and no hole from one side.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import os
import unittest

import numpy as np
from PIL import Image
from scipy import ndimage

from meshes import is_closed, read_mesh
from pictures import Test
from views import View, edges_of

CASES = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'cases')
SPECK = 8  # pixels of a hole, between two points of the renderer, or between pieces of a part


class Case:
    """A drawing with the true owner of each pixel and the true whole shapes."""

    def __init__(self, name):
        self.folder = os.path.join(CASES, name)
        with open(os.path.join(self.folder, 'truth.json'), encoding='utf-8') as file:
            self.colours = {'%02x%02x%02x' % tuple(v): int(k) for k, v in json.load(file)['colours'].items()}
        with Image.open(os.path.join(self.folder, 'owner.png')) as picture:
            self.owner = np.array(picture)
        self.height, self.width = self.owner.shape
        with np.load(os.path.join(self.folder, 'full.npz')) as full:
            self.whole = {int(k): np.unpackbits(mask, axis=1)[:, :self.width] > 0
                          for k, mask in zip(full['shapes'], full['masks'])}

    def words(self):
        with open(os.path.join(self.folder, 'arrows.txt'), encoding='utf-8') as file:
            rows = [line.split() for line in file if line.strip()]
        return [os.path.join(self.folder, 'drawing.png'), '--scribbles', os.path.join(self.folder, 'scribbles.png'),
                '--relations', ';'.join('%s,%s > %s,%s' % tuple(row) for row in rows)]

    def shape_of(self, part):
        """The number of the true shape of a part, or None."""
        shape = self.colours.get(part.split('-')[0])
        return shape if shape in self.whole else None

    def deviations(self, shape, x, y):
        """Distances of places from the true outline, where it is visible."""
        mask = self.whole[shape]
        signed = ndimage.distance_transform_edt(mask) - ndimage.distance_transform_edt(~mask)
        signed -= 0.5 * np.sign(signed)
        seen = ndimage.binary_dilation(self.owner == shape, np.ones((3, 3)))
        seen &= ~ndimage.binary_dilation(self.owner > shape, np.ones((5, 5)))
        inside = (x > 1) & (y > 1) & (x < self.width - 1) & (y < self.height - 1)
        x, y = x[inside], y[inside]
        far = abs(ndimage.map_coordinates(signed, [y - 0.5, x - 0.5], order=1))
        return far[seen[y.astype(int), x.astype(int)]]


class ModelCases(Test):
    def check(self, name):
        case = Case(name)
        self.celdepth('relief', *case.words(), '--mesh', 'a.glb')
        places, _, other = read_mesh(self.path('a.glb'))
        places = places * (max(case.width, case.height) / 0.1)
        x, y = case.width / 2 + places[:, 0], case.height / 2 - places[:, 1]
        far, holes, found = [], 0, 0
        for part, triangles in other['parts']:
            shape = case.shape_of(part)
            if shape is None:
                continue
            found += 1
            edges = edges_of(triangles)
            far.append(case.deviations(shape, x[edges[:, 0]], y[edges[:, 0]]))
            self.assertLess(np.hypot(*(v[edges[:, 0]] - v[edges[:, 1]] for v in (x, y))).max(), 1.5, part)
            if (ndimage.binary_fill_holes(case.whole[shape]) == case.whole[shape]).all():
                for degrees in (-35, 35):
                    seen = View(places, [(part, triangles)], other['art'], degrees, case.width // 2, case.height // 2,
                                2).part >= 0
                    hole = ndimage.binary_fill_holes(seen) & ~seen
                    self.assertLessEqual(hole.sum(), SPECK, f'{part} from {degrees} degrees')
        self.assertGreater(found, 0.8 * len(case.whole))
        self.assertLess(np.concatenate(far).mean(), 0.5)
        self.celdepth('relief', *case.words(), '--mesh', 'a.stl')
        self.assertTrue(is_closed(read_mesh(self.path('a.stl'))[1]))

    def test_frog(self):
        self.check('frog')

    def test_people(self):
        self.check('people')

    def test_house(self):
        self.check('house')


if __name__ == '__main__':
    unittest.main()
