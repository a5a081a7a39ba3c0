#!/usr/bin/python3
"""celdepth enhance: where shadows fall, over art, as a layer and over a view of depth.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import unittest

import numpy as np
from PIL import Image

from pictures import HEIGHT, IN_A, IN_B, IN_PAGE, RELATIONS, WIDTH, Test, at


def light(encoded):
    """Linear light of sRGB in [0,1]."""
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


class Enhance(Test):
    def setUp(self):
        super().setUp()
        self.popup('--relations', RELATIONS, '--levels', 'levels.npy', '--labels', 'labels.png')
        self.levels = np.load(self.path('levels.npy'))
        random = np.random.default_rng(1)
        self.art = random.integers(0, 256, (HEIGHT, WIDTH, 4), np.uint8)
        self.art[:, :, 3] = 255
        Image.fromarray(self.art).save(self.path('art.png'))

    def test_shadows_fall_on_farther_parts(self):
        self.celdepth('enhance', 'levels.npy', '--shadow', 'shadow.npy', '--shadow-size', '0.02')
        shadow = np.load(self.path('shadow.npy'))
        self.assertEqual(shadow.shape, (HEIGHT, WIDTH, 4))
        self.assertEqual(shadow[:, :, :3].max(), 0)
        alpha = shadow[:, :, 3]
        nearest = self.levels == self.levels.max()
        self.assertTrue(nearest[IN_B[1], IN_B[0]])
        self.assertLess(alpha[nearest].max(), 1e-6)
        self.assertGreater(alpha[IN_B[1], 87], 0.1)  # the page beside box B
        self.assertGreater(alpha[35, 38], 0.1)  # box A beside box B
        self.assertLess(at(alpha, IN_PAGE), 0.05)
        self.assertLess(at(alpha, IN_A), 0.05)

    def test_layer_over_art_is_the_enhanced_art(self):
        words = ('--shadow-offset', '0.03', '--light-azimuth', '120', '--shadow-range', '0.5')
        self.celdepth('enhance', 'levels.npy', '--colours', 'art.png', '--enhanced', 'a.npy', '--shadow', 's.npy', *words)
        alpha = np.load(self.path('s.npy'))[:, :, 3:]
        wanted = light(self.art[:, :, :3] / 255) * (1 - alpha)
        np.testing.assert_allclose(np.load(self.path('a.npy'))[:, :, :3], wanted, atol=1e-4)
        self.celdepth('enhance', 'levels.npy', '--colours', 'art.png', '--enhanced', 'a.exr', '--shadow', 's.tif', *words)
        np.testing.assert_allclose(self.channel('a.exr', 'R'), wanted[:, :, 0], atol=1e-4)

    def test_no_strength_leaves_the_art(self):
        self.art[:, :, 3] = np.arange(WIDTH)[None, :] * 2
        Image.fromarray(self.art).save(self.path('art.png'))
        for way in ('stack', 'darken', 'contrast'):
            with self.subTest(way):
                self.celdepth('enhance', 'levels.npy', '--colours', 'art.png', '--enhanced', 'a.png', '--enhance', way,
                              '--shadow-strength', '0')
                np.testing.assert_allclose(self.picture('a.png'), self.art, atol=1)

    def test_view(self):
        self.celdepth('enhance', 'levels.npy', '--view', 'view.npy')
        view = np.load(self.path('view.npy'))
        self.assertGreater(at(view, IN_B), at(view, IN_A))
        self.assertGreater(at(view, IN_A), at(view, IN_PAGE))
        self.assertGreater(at(view, IN_PAGE), 0.03)

    def test_failures(self):
        Image.new('RGB', (WIDTH + 1, HEIGHT)).save(self.path('wide.png'))
        self.fails('enhance', 'levels.npy', '--colours', 'wide.png', '--enhanced', 'a.png', naming='"wide.png" has 97 x 64')
        self.fails('enhance', 'missing.npy', '--view', 'a.png', naming='missing.npy')
        self.fails('enhance', 'levels.npy', '--colours', 'missing.png', '--enhanced', 'a.png', naming='missing.png')
        self.celdepth('enhance', 'levels.npy', '--view', 'a.png', '--shadow-size', '0', code=2)


if __name__ == '__main__':
    unittest.main()
