#!/usr/bin/python3
"""celdepth stereo and wiggle: views, joined views, animations, and warnings.

Files of several pictures are read back by Pillow.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import os
import struct
import unittest

import numpy as np
from PIL import Image

from pictures import HEIGHT, IN_B, RELATIONS, WIDTH, Test


class Stereo(Test):
    def stereo(self, *words, code=0):
        relations = () if '--relations' in words else ('--relations', RELATIONS)
        return self.celdepth('stereo', 'drawing.png', '--scribbles', 'scribbles.png', *relations, *words,
                             code=code)

    def edge(self, name):
        """Where the right outline of box B, the nearest, is darkest in the middle of its height."""
        row = np.load(self.path(name))[IN_B[1], 70:, 0]
        dark = 1 - row
        return (dark * np.arange(70, WIDTH)).sum() / dark.sum()

    def test_near_parts_have_crossed_disparity(self):
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
        for name in ('left', 'right', 'side-by-side', 'half-side-by-side', 'crossed', 'over-under', 'half-over-under',
                     'interlaced', 'columns', 'grey', 'colour', 'half-colour', 'dubois'):
            with self.subTest(name):
                self.stereo('--joined', 'j.png', '--stereo', name)
                self.assertEqual(self.picture('j.png').shape[:2], sizes.get(name, (HEIGHT, WIDTH)))
        self.stereo('--joined', 'j.npy', '--stereo', 'dubois', '--disparity', '0')
        joined = np.load(self.path('j.npy'))
        self.assertGreater(joined[:3, :, :3].min(), 0.99)  # paper stays white

    def test_strain_is_reported(self):
        self.assertIn('disparity of 0.033', self.stereo('--left', 'l.npy', '--disparity', '0.05'))
        self.assertNotIn('disparity', self.stereo('--left', 'l.npy', '--disparity', '0.05', '--quiet'))
        self.assertNotIn('disparity', self.stereo('--left', 'l.npy'))

        self.assertIn('convergence of 1', self.stereo('--left', 'l.npy', '--convergence', '0', '--disparity', '0.03',
                                                      '--relations', '70,45 > 4,4; 4,4 > 20,20'))
        self.assertNotIn('apart', self.stereo('--left', 'l.npy', '--screen-width', '6000'))
        self.assertIn('apart', self.stereo('--left', 'l.npy', '--screen-width', '7000'))

    # ---------------------------------------------------------------- windows, reports

    def test_floating_window_hides_what_the_frame_cuts(self):
        """The page lies before box A and behind box B: the frame cuts it before the screen."""
        words = ('--disparity', '0.0625', '--convergence', '0', '--relations', '70,45 > 4,4; 4,4 > 20,20')
        self.stereo('--left', 'l.npy', '--right', 'r.npy', *words)
        self.stereo('--left', 'wl.npy', '--right', 'wr.npy', '--floating-window', 'yes', *words)
        left, right, window_left, window_right = (np.load(self.path(f + '.npy')) for f in ('l', 'r', 'wl', 'wr'))
        self.assertEqual(window_left[:, :3, :3].max(), 0)  # half of 0.0625 of 96 pixels
        self.assertEqual(window_right[:, -3:, :3].max(), 0)
        np.testing.assert_array_equal(window_left[:, 3:], left[:, 3:])
        np.testing.assert_array_equal(window_right[:, :-3], right[:, :-3])

    def test_report(self):
        self.stereo('--left', 'l.npy', '--report', 'r.json')
        with open(self.path('r.json')) as f:
            report = json.load(f)
        self.assertEqual(report['command'], 'stereo')
        self.assertIn('layers', report['seconds'])

    # ---------------------------------------------------------------- several pictures

    def encoded(self, name):
        """A view of linear light as 8 bits of sRGB."""
        linear = np.load(self.path(name))[:, :, :3]
        return np.round(255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055))

    def test_mpo(self):
        """Two JPEGs that readers of both kinds find: the left view is the first, and the only one for others."""
        self.stereo('--joined', 'j.mpo', '--left', 'l.npy', '--right', 'r.npy')
        with Image.open(self.path('j.mpo')) as mpo:
            self.assertEqual((mpo.format, mpo.n_frames), ('MPO', 2))
            for i, name in enumerate(('l.npy', 'r.npy')):
                mpo.seek(i)
                self.assertLess(np.abs(np.array(mpo.convert('RGB')) - self.encoded(name)).mean(), 1)
            index = mpo.mpinfo
        self.assertEqual(index[0xb000], b'0100')
        self.assertEqual({entry['Attribute']['MPType'] for entry in index[0xb002]}, {'Multi-Frame Image: (Disparity)'})
        with open(self.path('j.mpo'), 'rb') as f:
            data = f.read()
        self.assertEqual(sum(entry['Size'] for entry in index[0xb002]), len(data))
        head = data.index(b'MPF\0') + 4
        second = head + index[0xb002][1]['DataOffset']
        self.assertEqual(data[second:second + 2], b'\xff\xd8')
        self.assertEqual(data[second - 2:second], b'\xff\xd9')

    def test_mpo_numbers_its_views(self):
        self.stereo('--sequence', 's.mpo', '--views', '3')
        with open(self.path('s.mpo'), 'rb') as f:
            heads = f.read().split(b'MPF\0')[1:]
        for i, head in enumerate(heads):
            self.assertEqual(head[:8], b'II*\0\x08\0\0\0')
            at = 8
            if i == 0:  # the index, and behind it where the attributes are
                count, = struct.unpack_from('<H', head, at)
                at, = struct.unpack_from('<I', head, at + 2 + 12 * count)
            count, = struct.unpack_from('<H', head, at)
            fields = [struct.unpack_from('<HHII', head, at + 2 + 12 * k) for k in range(count)]
            self.assertEqual([f[0] for f in fields], sorted(f[0] for f in fields))
            self.assertIn((0xb101, 4, 1, i + 1), fields)
            for tag, _, _, value in fields:
                if tag in (0xb205, 0xb206):  # not known
                    self.assertEqual(head[value:value + 8], b'\xff' * 8)
        self.assertEqual(len(heads), 3)

    def test_views_lie_between_the_eyes(self):
        words = ('--disparity', '0.0625', '--convergence', '0')
        self.stereo('--sequence', 'views', '--views', '4', '--quilt', 'q.npy', '--columns', '3', '--left', 'l.npy',
                    '--right', 'r.npy', *words)
        self.assertEqual(sorted(os.listdir(self.path('views'))), [f'{i:03}.png' for i in range(4)])
        quilt = np.load(self.path('q.npy'))
        self.assertEqual(quilt.shape, (2 * HEIGHT, 3 * WIDTH, 4))
        tiles = [quilt[(1 - i // 3) * HEIGHT:, i % 3 * WIDTH:][:HEIGHT, :WIDTH] for i in range(5)]
        np.testing.assert_array_equal(tiles[0], np.load(self.path('l.npy')))
        np.testing.assert_array_equal(tiles[3], np.load(self.path('r.npy')))
        self.assertEqual(tiles[4].max(), 0)
        places = []
        for i in range(4):
            np.save(self.path('t.npy'), tiles[i])
            places.append(self.edge('t.npy'))
            self.assertLessEqual(np.abs(self.picture(f'views/{i:03}.png')[:, :, :3] - self.encoded('t.npy')).max(), 1)
        np.testing.assert_allclose(np.diff(places), -0.0625 * WIDTH / 3, atol=0.1)

    def wiggle(self, *words, code=0):
        return self.celdepth('wiggle', 'drawing.png', '--scribbles', 'scribbles.png', '--relations', RELATIONS, *words,
                             code=code)

    def test_wiggle(self):
        for path in ('sway', 'circle', 'turntable'):
            with self.subTest(path):
                self.wiggle('--output', path, '--frames', '5', '--path', path)
                frames = [self.picture(f'{path}/{i:03}.png').astype(int) for i in range(5)]
                self.assertEqual(len(os.listdir(self.path(path))), 5)
                for one, other in zip(frames, frames[1:]):
                    self.assertGreater(np.abs(one - other).max(), 100)
                self.assertEqual(min(frame[:, :, 3].min() for frame in frames), 255)
        drawing = self.picture('drawing.png').astype(int)
        self.assertLessEqual(np.abs(self.picture('sway/000.png')[:, :, 0] - drawing).max(), 1)

    def test_gif(self):
        self.wiggle('--output', 'w.gif', '--frames', '6', '--fps', '20')
        with Image.open(self.path('w.gif')) as gif:
            self.assertEqual((gif.n_frames, gif.size), (6, (WIDTH, HEIGHT)))
            self.assertEqual((gif.info['loop'], gif.info['duration']), (0, 50))
            frames = [np.array(gif.convert('RGB')).astype(int) for i in range(6) if not gif.seek(i)]
        drawing = self.picture('drawing.png').astype(int)
        self.assertLess(np.abs(frames[0][:, :, 0] - drawing).mean(), 2)
        self.assertGreater(np.abs(frames[1] - frames[4]).mean(), 2)
        self.wiggle('--output', 'small.gif', '--frames', '2', '--size', '48')
        with Image.open(self.path('small.gif')) as gif:
            self.assertEqual(gif.size, (WIDTH // 2, HEIGHT // 2))

    def test_failures(self):
        self.wiggle('--output', 'w.png', code=2)
        self.wiggle('--output', 'w.gif', '--frames', '1', code=2)
        self.wiggle('--output', 'w.gif', '--path', 'up', code=2)
        self.stereo('--quilt', 'q.png', '--views', 'many', code=2)
        self.stereo('--sequence', 's.tif', code=2)
        self.stereo('--left', 'l.mpo', code=2)
        self.stereo('--left', 'l.npy', '--screen-width', '-3', code=2)
        os.mkdir(self.path('full'))
        with open(self.path('full/x'), 'w'):
            pass
        self.fails('wiggle', 'drawing.png', '--scribbles', 'scribbles.png', '--output', 'full', naming='not empty')
        self.fails('stereo', 'drawing.png', '--scribbles', 'scribbles.png', '--quilt', 'q.png', '--views', '1000',
                   '--columns', '1000', naming='fewer views')
        self.celdepth('stereo', 'drawing.png', code=2)
        self.stereo('--left', 'l.npy', '--disparity', '0.3', code=2)
        self.stereo('--left', 'l.npy', '--stereo', 'magic', code=2)
        self.fails('stereo', 'drawing.png', '--left', 'l.png', naming='no scribbles and no arrows')
        self.fails('stereo', 'drawing.png', '--scribbles', 'scribbles.png', '--colours', 'none.png', '--left', 'l.png',
                   naming='none.png')


if __name__ == '__main__':
    unittest.main()
