#!/usr/bin/python3
"""celdepth stereo: views of a flat page, in front of each other, joined, and what strains the eyes.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import unittest

import numpy as np

from pictures import HEIGHT, IN_B, RELATIONS, WIDTH, Test


class Stereo(Test):
    def stereo(self, *words, code=0):
        return self.celdepth('stereo', 'drawing.png', '--scribbles', 'scribbles.png', '--relations', RELATIONS, *words,
                             code=code)

    def edge(self, name):
        """Where the right outline of box B, the nearest, is darkest in the middle of its height."""
        row = np.load(self.path(name))[IN_B[1], 70:, 0]
        dark = 1 - row
        return (dark * np.arange(70, WIDTH)).sum() / dark.sum()

    def test_what_is_near_is_crossed(self):
        self.stereo('--left', 'l.npy', '--right', 'r.npy', '--disparity', '0.0625', '--convergence', '0')
        self.assertAlmostEqual(self.edge('l.npy') - self.edge('r.npy'), 0.0625 * WIDTH, delta=0.1)
        self.stereo('--left', 'l.npy', '--right', 'r.npy', '--disparity', '0.0625', '--convergence', '1')
        self.assertAlmostEqual(self.edge('l.npy') - self.edge('r.npy'), 0, delta=0.1)

    def test_views_have_no_holes(self):
        self.stereo('--left', 'l.npy', '--right', 'r.npy', '--disparity', '0.1')
        for name in ('l.npy', 'r.npy'):
            self.assertGreater(np.load(self.path(name))[:, :, 3].min(), 0.999)

    def test_no_disparity_gives_the_drawing(self):
        self.stereo('--left', 'l.png', '--disparity', '0')
        drawing = self.picture('drawing.png')
        self.assertLessEqual(np.abs(self.picture('l.png')[:, :, :3].astype(int) - drawing[:, :, None]).max(), 1)

    def test_formats(self):
        sizes = {'side-by-side': (HEIGHT, 2 * WIDTH), 'crossed': (HEIGHT, 2 * WIDTH), 'over-under': (2 * HEIGHT, WIDTH)}
        for name in ('left', 'right', 'side-by-side', 'half-side-by-side', 'crossed', 'over-under', 'interlaced',
                     'grey', 'colour', 'half-colour', 'dubois'):
            with self.subTest(name):
                self.stereo('--joined', 'j.png', '--stereo', name)
                self.assertEqual(self.picture('j.png').shape[:2], sizes.get(name, (HEIGHT, WIDTH)))
        self.stereo('--joined', 'j.npy', '--stereo', 'dubois', '--disparity', '0')
        joined = np.load(self.path('j.npy'))
        self.assertGreater(joined[:3, :, :3].min(), 0.99)  # paper stays white

    def test_strain_is_told(self):
        self.assertIn('disparity of 0.033', self.stereo('--left', 'l.npy', '--disparity', '0.05'))
        self.assertNotIn('disparity', self.stereo('--left', 'l.npy', '--disparity', '0.05', '--quiet'))
        self.assertNotIn('disparity', self.stereo('--left', 'l.npy'))

    def test_failures(self):
        self.celdepth('stereo', 'drawing.png', code=2)
        self.stereo('--left', 'l.npy', '--disparity', '0.3', code=2)
        self.stereo('--left', 'l.npy', '--stereo', 'magic', code=2)
        self.fails('stereo', 'drawing.png', '--left', 'l.png', naming='nothing to go by')
        self.fails('stereo', 'drawing.png', '--scribbles', 'scribbles.png', '--colours', 'none.png', '--left', 'l.png',
                   naming='none.png')


if __name__ == '__main__':
    unittest.main()
