#!/usr/bin/python3
"""celdepth exact: what it writes, its report, contradictions.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import unittest

import numpy as np

from pictures import HEIGHT, IN_A, IN_B, IN_PAGE, RELATIONS, WIDTH, Test


def at(plane, place):
    return plane[place[1], place[0]]


class Exact(Test):
    def exact(self, *words, code=0):
        return self.celdepth('exact', 'drawing.png', '--scribbles', 'scribbles.png', *words, code=code)

    def report(self):
        with open(self.path('report.json'), encoding='utf-8') as file:
            return json.load(file)

    def test_ranks(self):
        self.exact('--relations', '70,45 > 20,20 +1.5', '--depth', 'depth.npy', '--encoding', 'rank')
        depth = np.load(self.path('depth.npy'))
        self.assertEqual(depth.shape, (HEIGHT, WIDTH))
        np.testing.assert_allclose([at(depth, place) for place in (IN_PAGE, IN_A, IN_B)], [0, 1, 2.5], atol=1e-3)

    def test_formats(self):
        for name in ('depth.npy', 'depth.png', 'depth.exr', 'depth.tif'):
            self.exact('--relations', RELATIONS, '--depth', name)
        depth = np.load(self.path('depth.npy'))
        self.assertEqual((depth.min(), depth.max()), (0, 1))
        np.testing.assert_allclose(self.picture('depth.png') / 65535, depth, atol=0.51 / 65535)
        np.testing.assert_array_equal(self.channel('depth.exr', 'depth.V'), depth)

    def test_report(self):
        self.exact('--relations', RELATIONS + '; 20,30 > 25,40; 500,5 > 1,1', '--depth', 'depth.npy', '--report',
                   'report.json')
        report = self.report()
        self.assertEqual([report[name] for name in ('schema', 'command', 'width', 'height', 'cycles')],
                         [1, 'exact', WIDTH, HEIGHT, []])
        self.assertNotIn('levels', report)
        self.assertEqual({label['colour'] for label in report['labels'] if label['background']}, {'#00a000'})
        exact = report['exact']
        self.assertGreater(exact['sigma'], 0)
        self.assertGreater(exact['energy'], 0)
        self.assertLessEqual(abs(exact['gap']), 1e-9 * exact['energy'])
        self.assertLessEqual(exact['violation'], 1e-12)
        self.assertLessEqual(exact['error'], 1e-4)
        self.assertGreaterEqual(exact['inequalities'], exact['active'])
        self.assertEqual(len(exact['nodes']), 5)
        self.assertEqual([node['place'] for node in exact['nodes'] if 'label' not in node], [[20, 30], [25, 40]])
        self.assertEqual(min(node['depth'] for node in exact['nodes']), 0)
        self.assertEqual([r.get('left-out') for r in report['relations']], [None, None, None, 'outside'])

    def test_contradiction(self):
        said = self.exact('--relations', '#ff0000 > #0000ff; #0000ff > #ff0000 @0.5', '--depth', 'depth.npy',
                          '--report', 'report.json', code=3)
        self.assertIn('#0000ff > #ff0000', said)
        self.assertEqual(self.report()['cycles'], [[1, 0]])

    def test_separate_strokes(self):
        self.exact('--relations', '70,45 > 20,20; 20,20 > 70,40', '--depth', 'depth.npy', '--same-colour', 'separate')

    def test_wrong_values(self):
        for option, value in (('--contrast', '0'), ('--weight-floor', '0'), ('--weight-floor', '2')):
            with self.subTest(option=option):
                self.assertIn(option, self.exact('--depth', 'depth.npy', option, value, code=2))
        self.assertIn('--depth is missing', self.exact(code=2))


if __name__ == '__main__':
    unittest.main()
