#!/usr/bin/python3
"""celdepth relief: heights in each format, and one mesh of all of them as other programs read it.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import unittest

import numpy as np
from PIL import Image

from meshes import is_closed, read_mesh, volume
from pictures import HEIGHT, IN_A, IN_B, IN_PAGE, RELATIONS, WIDTH, Test, at

KINDS = ['.glb', '.obj', '.ply', '.stl']


class Relief(Test):
    def setUp(self):
        super().setUp()
        self.popup('--relations', RELATIONS, '--levels', 'levels.npy', '--depth', 'depth.npy')
        random = np.random.default_rng(1)
        self.art = random.integers(0, 256, (HEIGHT, WIDTH, 4), np.uint8)
        self.art[:, :, 3] = 255
        Image.fromarray(self.art).save(self.path('art.png'))

    def relief(self, *words, code=0):
        return self.celdepth('relief', 'levels.npy', '--drawing', 'drawing.png', *words, code=code)

    def mesh(self, name, *words):
        self.relief('--mesh', name, '--mesh-kind', 'heightfield', *words)
        return read_mesh(self.path(name))

    # ------------------------------------------------------------------ heights

    def test_nearer_parts_are_higher(self):
        self.relief('--smooth-depth', 'depth.npy', '--height', 'h.npy')
        height = np.load(self.path('h.npy'))
        self.assertEqual(height.shape, (HEIGHT, WIDTH))
        self.assertAlmostEqual(at(height, IN_PAGE), 0, delta=0.01)
        self.assertGreater(at(height, IN_A), 5)
        self.assertGreater(at(height, IN_B), at(height, IN_A))
        levels = np.load(self.path('levels.npy'))
        self.assertGreater(height[levels == 1].min(), height[levels == 0.5].max() / 2)

    def test_formats_hold_the_same_heights(self):
        self.relief('--height', 'h.npy')
        height = np.load(self.path('h.npy'))
        for name in ('h.exr', 'h.tif', 'h.png'):
            self.relief('--height', name)
        np.testing.assert_allclose(self.channel('h.exr', 'Y'), height, atol=1e-5)
        np.testing.assert_allclose(self.picture('h.tif'), height, atol=1e-5)
        with Image.open(self.path('h.png')) as picture:
            low, high = (float(picture.text['celdepth:' + end]) for end in ('farthest', 'nearest'))
            shown = np.array(picture).astype(float) / 65535
        self.assertAlmostEqual(low, height.min(), places=3)
        self.assertAlmostEqual(high, height.max(), places=2)
        np.testing.assert_allclose(low + shown * (high - low), height, atol=(high - low) / 65535)

    def test_bulge_and_depth(self):
        self.relief('--height', 'flat.npy', '--relief-bulge', '0', '--smooth-depth', 'levels.npy', '--relief-depth', '0.5')
        levels = np.load(self.path('levels.npy'))
        np.testing.assert_allclose(np.load(self.path('flat.npy')), 0.5 * np.hypot(WIDTH, HEIGHT) * levels, atol=1e-3)
        self.relief('--height', 'n.npy', '--relief-from', 'normals')
        self.assertGreater(at(np.load(self.path('n.npy')), IN_B), 5)

    # ------------------------------------------------------------------ meshes

    def test_formats_hold_the_same_mesh(self):
        wanted, triangles, _ = self.mesh('a.ply')
        for kind, unit in (('.glb', 1000), ('.obj', 1)):
            with self.subTest(kind):
                places, found, other = self.mesh('a' + kind)
                np.testing.assert_allclose(unit * places, wanted, rtol=1e-5, atol=1e-4)
                np.testing.assert_array_equal(found, triangles)
                np.testing.assert_allclose(np.linalg.norm(other['normals'], axis=1), 1, atol=1e-5)

    def test_size(self):
        for size in (100, 250):
            places = self.mesh('a.ply', '--mesh-size', str(size))[0]
            np.testing.assert_allclose(np.ptp(places, 0)[:2], [size, size * HEIGHT / WIDTH], rtol=1e-5)
            np.testing.assert_allclose(places.min(0)[:2], -np.ptp(places, 0)[:2] / 2, rtol=1e-5)

    def test_heights_are_those_of_the_picture(self):
        """Where a vertex lies well inside a part, four pixels round it tell its height."""
        self.relief('--height', 'h.npy')
        height = np.load(self.path('h.npy')) * 100 / WIDTH
        places = self.mesh('a.ply', '--mesh-error', '0.01')[0]
        columns = np.rint(places[:, 0] * WIDTH / 100 + WIDTH / 2).astype(int)
        rows = np.rint(HEIGHT / 2 - places[:, 1] * WIDTH / 100).astype(int)
        near = (abs(columns - IN_B[0]) < 8) & (abs(rows - IN_B[1]) < 5)
        self.assertGreater(near.sum(), 20)
        for x, y, z in zip(columns[near], rows[near], places[near, 2]):
            self.assertAlmostEqual(z, height[y - 1:y + 1, x - 1:x + 1].mean(), places=3)

    def test_art_is_the_texture(self):
        for kind in ('.glb', '.obj'):
            with self.subTest(kind):
                other = self.mesh('a' + kind, '--colours', 'art.png')[2]
                np.testing.assert_array_equal(other['texture'][:, :, :3], self.art[:, :, :3])
        places, _, other = self.mesh('a.glb')
        drawing = self.picture('drawing.png')
        np.testing.assert_array_equal(other['texture'][:, :, 0], drawing)
        np.testing.assert_allclose(other['art'][:, 0] - 0.5, places[:, 0] / 0.1, atol=1e-5)      # to the right
        np.testing.assert_allclose(0.5 - other['art'][:, 1], places[:, 1] / 0.1 * WIDTH / HEIGHT, atol=1e-5)  # down
        places, _, other = self.mesh('a.ply')
        np.testing.assert_allclose(other['art'][:, 1] - 0.5, places[:, 1] / 100 * WIDTH / HEIGHT, atol=1e-5)  # up
        self.assertEqual(other['colours'].min(), 0)
        self.assertEqual(other['colours'].max(), 255)

    def test_stl_is_closed(self):
        for words in ([], ['--relief-from', 'normals'], ['--mesh-error', '20'], ['--relief-bulge', '4', '--relief-depth', '0']):
            with self.subTest(words):
                places, triangles, other = self.mesh('a.stl', '--mesh-plate', '3', *words)
                self.assertTrue(is_closed(triangles))
                self.assertGreater(volume(places, triangles), 3 * 100 * 100 * HEIGHT / WIDTH)
                self.assertEqual(np.isnan(other['facets']).sum(), 0)
        places, triangles, _ = self.mesh('a.ply')
        self.assertFalse(is_closed(triangles))

    def test_too_many_vertices(self):
        said = self.relief('--mesh', 'a.glb', '--mesh-kind', 'heightfield', '--mesh-error', '0.01',
                           '--most-vertices', '2000')
        self.assertIn('--most-vertices', said)
        self.assertLessEqual(len(read_mesh(self.path('a.glb'))[0]), 2000)

    def test_failures(self):
        Image.new('L', (WIDTH + 1, HEIGHT)).save(self.path('wide.png'))
        self.fails('relief', 'levels.npy', '--drawing', 'wide.png', '--height', 'a.npy', naming='97 x 64')
        self.fails('relief', 'levels.npy', '--drawing', 'drawing.png', '--smooth-depth', 'wide.png', '--height', 'a.npy',
                   naming='"wide.png" has 97 x 64')
        self.fails('relief', 'levels.npy', '--drawing', 'drawing.png', '--colours', 'missing.png', '--mesh', 'a.glb',
                   naming='missing.png')
        self.fails('relief', 'levels.npy', '--drawing', 'drawing.png', '--mesh', 'nowhere/a.glb', naming='nowhere')
        self.assertIn('.glb', self.relief('--mesh', 'a.fbx', code=2))
        self.assertIn('between 0.01 and 100', self.relief('--mesh', 'a.glb', '--mesh-error', '0', code=2))
        self.relief(code=2)
        self.assertEqual([name for name in os.listdir(self.folder) if name.endswith(tuple(KINDS))], [])


if __name__ == '__main__':
    unittest.main()
