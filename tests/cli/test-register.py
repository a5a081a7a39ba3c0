#!/usr/bin/python3
"""celdepth register: a page whose boxes have moved.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import unittest

import numpy as np
from PIL import Image, ImageDraw

from pictures import BLUE, HEIGHT, IN_A, IN_B, IN_PAGE, RED, RELATIONS, WIDTH, Test, at

BY_A, BY_B = (-4, 3), (3, -2)


def boxes(by_a=(0, 0), by_b=(0, 0), size=3):
    """Two boxes with marks inside, moved by some pixels; three times the size of drawing(), so that lines are thin."""
    page = Image.new('L', (size * WIDTH, size * HEIGHT), 255)
    draw = ImageDraw.Draw(page)
    for (left, top, right, bottom), (dx, dy) in (((10, 10, 60, 45), by_a), ((40, 25, 85, 50), by_b)):
        dx, dy = size * dx, size * dy
        x0, y0, x1, y1 = (size * v for v in (left, top, right, bottom))
        draw.rectangle([x0 + dx, y0 + dy, x1 + dx, y1 + dy], fill=255, outline=0, width=3)
        draw.ellipse([x0 + 21 + dx, y0 + 12 + dy, x0 + 51 + dx, y0 + 36 + dy], outline=0, width=3)
    return page


def strokes():
    layer = Image.new('RGBA', (3 * WIDTH, 3 * HEIGHT))
    draw = ImageDraw.Draw(layer)
    for line, colour in (((40, 60, 60, 130), RED), ((130, 120, 230, 140), BLUE), ((9, 9, 270, 12), (0, 160, 0)),
                         ((63, 52, 72, 56), RED), ((150, 94, 165, 100), BLUE)):
        draw.line(line, fill=colour + (255,), width=4)
    return layer


class Register(Test):
    def setUp(self):
        super().setUp()
        boxes().save(self.path('one.png'))
        boxes(BY_A, BY_B).save(self.path('two.png'))
        strokes().save(self.path('strokes.png'))
        self.relations = '; '.join('%s > %s' % tuple(','.join(str(3 * int(v)) for v in end.split(','))
                                                      for end in relation.split('>'))
                                   for relation in RELATIONS.split(';'))

    def register(self, *words, code=0):
        return self.celdepth('register', 'one.png', 'two.png', *words, code=code)

    def moved(self, name, x, y):
        return np.load(self.path(name))[3 * y, 3 * x] / 3

    def test_parts_move_on_their_own(self):
        self.register('--scribbles', 'strokes.png', '--relations', self.relations, '--displacement', 'd.npy',
                      '--confidence', 'c.npy', '--warped', 'w.png')
        displacement = np.load(self.path('d.npy'))
        self.assertEqual((displacement.shape, displacement.dtype), ((3 * HEIGHT, 3 * WIDTH, 2), np.float32))
        np.testing.assert_allclose(self.moved('d.npy', *IN_A), BY_A, atol=0.7)
        np.testing.assert_allclose(self.moved('d.npy', *IN_B), BY_B, atol=0.7)
        np.testing.assert_array_equal(self.moved('d.npy', *IN_PAGE), (0, 0))
        confidence = np.load(self.path('c.npy'))
        self.assertEqual(confidence[3 * IN_PAGE[1], 3 * IN_PAGE[0]], 0)
        self.assertGreater(confidence[60, 31], 0.6)
        warped, two = self.picture('w.png'), self.picture('two.png')
        self.assertEqual(at(warped, (3 * IN_PAGE[0], 3 * IN_PAGE[1]))[3], 0)
        shown = warped[:, :, 3] == 255
        same = np.abs(warped[:, :, 0].astype(int) - two) < 100
        self.assertGreater(same[shown].mean(), 0.96)

    def test_levels_instead_of_scribbles(self):
        self.celdepth('popup', 'one.png', '--scribbles', 'strokes.png', '--relations', self.relations, '--levels',
                      'levels.npy')
        self.register('--source-levels', 'levels.npy', '--displacement', 'd.npy')
        np.testing.assert_allclose(self.moved('d.npy', *IN_A), BY_A, atol=0.7)
        np.testing.assert_allclose(self.moved('d.npy', *IN_B), BY_B, atol=0.7)

    def test_without_parts_all_moves_as_one(self):
        boxes(BY_B, BY_B).save(self.path('two.png'))
        self.register('--displacement', 'd.npy')
        np.testing.assert_allclose(self.moved('d.npy', *IN_A), BY_B, atol=0.7)
        np.testing.assert_allclose(self.moved('d.npy', *IN_B), BY_B, atol=0.7)

    def test_formats_hold_the_same_numbers(self):
        for name in ('d.npy', 'd.exr'):
            self.register('--displacement', name)
        displacement = np.load(self.path('d.npy'))
        for channel, name in enumerate('XY'):
            np.testing.assert_array_equal(self.channel('d.exr', name), displacement[:, :, channel])

    def test_wrong_input(self):
        self.register('--displacement', 'd.png', code=2)
        self.register(code=2)
        self.assertIn('overwrite', self.register('--warped', 'two.png', code=2))
        self.assertIn('"three.png" is one too many: give two drawings.', self.celdepth(
            'register', 'one.png', 'two.png', 'three.png', '--warped', 'w.png', code=2))
        self.fails('register', 'one.png', 'drawing.png', '--warped', 'w.png', naming='pixels')
        self.fails('register', 'one.png', 'none.png', '--warped', 'w.png', naming='none.png')
        Image.new('L', (3 * WIDTH, 3 * HEIGHT), 255).save(self.path('two.png'))
        self.fails('register', 'one.png', 'two.png', '--warped', 'w.png', naming='"two.png" has no lines')
        self.fails('register', 'two.png', 'one.png', '--warped', 'w.png', naming='"two.png" ')


if __name__ == '__main__':
    unittest.main()
