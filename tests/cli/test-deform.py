#!/usr/bin/python3
"""celdepth deform: one box is moved over another one, and behind it.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import os
import unittest

import numpy as np
from PIL import Image, ImageDraw

from pictures import BLUE, GREEN, HEIGHT, IN_A, RED, RELATIONS, WIDTH, Test, at, drawing
from stacks import composite, premultiplied, read_open_raster, read_psd

PINS = '20,20; 14,40; 70,45; 80,50'


def coloured():
    """The drawing with box A red and box B blue inside."""
    page = drawing().convert('RGB')
    draw = ImageDraw.Draw(page)
    draw.rectangle([13, 13, 57, 42], fill=RED)
    draw.rectangle([40, 25, 85, 57], fill=BLUE, outline=0, width=3)
    return page


class Deform(Test):
    def setUp(self):
        super().setUp()
        coloured().save(self.path('art.png'))

    def deform(self, *words, code=0):
        return self.celdepth('deform', 'drawing.png', '--scribbles', 'scribbles.png', '--relations', RELATIONS,
                             '--colours', 'art.png', *words, code=code)

    def colour(self, name, place):
        return tuple(int(v) for v in at(self.picture(name), place)[:3])

    def test_pins_give_the_drawing_back(self):
        self.deform('--handles', PINS, '--output', 'out.png')
        given = np.array(coloured()).astype(int)
        self.assertLessEqual(np.abs(self.picture('out.png')[:, :, :3].astype(int) - given).max(), 1)

    def test_a_box_passes_in_front_or_behind(self):
        self.deform('--handles', '20,20; 14,40; 70,45 -> 45,45', '--output', 'front.png', '--levels', 'levels.npy')
        self.deform('--handles', '20,20; 14,40; 70,45 -> 45,45 ^-2', '--output', 'behind.png')
        self.assertEqual(self.colour('front.png', (30, 30)), BLUE)
        self.assertEqual(self.colour('behind.png', (30, 30)), RED)
        self.assertEqual(self.colour('front.png', IN_A), RED)
        levels = np.load(self.path('levels.npy'))
        self.assertGreater(levels[30, 30], levels[IN_A[1], IN_A[0]])

    def test_parts_without_handles_go_along(self):
        """Of a drawing with many parts: nothing is torn to pieces, and the amount of ink stays."""
        monkey = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'examples', 'monkey')
        page = os.path.join(monkey, 'drawing.png')
        self.celdepth('deform', page, '--scribbles', os.path.join(monkey, 'scribbles.png'), '--arrows',
                      os.path.join(monkey, 'arrows.png'), '--handles', '245,440 -> 300,380; 240,800; 770,900',
                      '--output', 'out.png')
        with Image.open(page) as given, Image.open(self.path('out.png')) as moved:
            white = Image.new('RGBA', moved.size, 'white')
            ink = [255 - np.array(picture.convert('L'), float) for picture in
                   (given, Image.alpha_composite(white, moved.convert('RGBA')))]
        self.assertGreater(np.abs(ink[1] - ink[0]).mean(), 1)
        self.assertLess(abs(ink[1].sum() / ink[0].sum() - 1), 0.1)

    def test_painted_handles(self):
        layer = Image.new('RGBA', (WIDTH, HEIGHT))
        draw = ImageDraw.Draw(layer)
        draw.ellipse([17, 17, 23, 23], fill=(0, 0, 0, 255))
        draw.ellipse([67, 42, 73, 48], fill=(0, 0, 0, 255))
        layer.save(self.path('dots.png'))
        self.deform('--handles-layer', 'dots.png', '--output', 'out.png')
        given = np.array(coloured()).astype(int)
        self.assertLessEqual(np.abs(self.picture('out.png')[:, :, :3].astype(int) - given).max(), 1)

    def test_a_motion_begins_at_rest_and_ends_at_its_handles(self):
        words = ('--handles', '20,20; 70,45 -> 75,45')
        self.deform(*words, '--frames', '5', '--output', 'frames')
        self.deform(*words, '--output', 'end.png')
        self.assertEqual(sorted(os.listdir(self.path('frames'))), [f'{k:03}.png' for k in range(5)])
        given = np.array(coloured()).astype(int)
        self.assertLessEqual(np.abs(self.picture('frames/000.png')[:, :, :3].astype(int) - given).max(), 1)
        np.testing.assert_allclose(self.picture('frames/004.png')[:, :, :3].astype(int),
                                   self.picture('end.png')[:, :, :3], atol=1)

    def test_layers_are_the_picture(self):
        """One for each region, in the order of depth, also where a handle has changed that; in either light."""
        for depth, order in ((0, [BLUE, RED]), (-2, [RED, BLUE])):
            words = ('--handles', f'20,20; 14,40; 70,45 -> 45,45 ^{depth}')
            self.deform(*words, '--output', 'out.png')
            for light in ('encoded', 'linear'):
                self.deform(*words, '--output', 'out.ora', '--compositing', light)
                layers, merged = read_open_raster(self.path('out.ora'))
                painted = [tuple(int(name[i:i + 2], 16) for i in (1, 3, 5)) for name, _ in layers]
                self.assertEqual(painted[::-1], order + [GREEN])
                if light == 'encoded':
                    np.testing.assert_allclose(composite([premultiplied(c) for _, c in layers]), premultiplied(merged),
                                               atol=2 / 255)
                np.testing.assert_allclose(merged[:, :, :3], self.picture('out.png')[:, :, :3] / 255,
                                           atol=1.5 / 255 if light == 'linear' else 0.35)
                self.assertGreater(layers[painted.index(BLUE)][1][30, 30, 3], 0.99)
                self.assertGreater(layers[painted.index(RED)][1][30, 30, 3], 0.99)   # whichever is hidden
        self.deform('--handles', '20,20; 70,45', '--output', 'out.psd')
        self.assertEqual([name for name, _ in read_psd(self.path('out.psd'))[0]], ['#00a000', '#ff0000', '#0000ff'])
        said = self.deform('--handles', '15,15 ^5; 55,15', '--output', 'out.ora')
        self.assertIn('Only part of #ff0000', said)

    def test_parts_come_apart_at_marked_cracks_only(self):
        """The boxes hang together unless the relation between them is marked."""
        handles = '20,20; 14,40; 70,45 -> 95,45'
        for relations, torn in ((RELATIONS, True), (RELATIONS + '; 20,20 > 2,2 !crack', False)):
            self.celdepth('deform', 'drawing.png', '--scribbles', 'scribbles.png', '--relations', relations, '--colours',
                          'art.png', '--handles', handles, '--output', 'out.png')
            self.assertEqual(self.colour('out.png', (62, 52)) == (255, 255, 255), torn)

    def test_keys_are_interpolated_and_each_frame_stands_alone(self):
        pins = [[20, 20], [14, 40]]
        keys = [{'frame': 0, 'handles': pins + [[70, 45]]}, {'frame': 4, 'handles': pins + [[70, 45, 90, 45]]},
                {'frame': 8, 'handles': pins + [[70, 45, 70, 45, 0]]}]
        with open(self.path('keys.json'), 'w', encoding='utf-8') as file:
            json.dump({'keys': keys}, file)
        self.deform('--keys', 'keys.json', '--frames', '9', '--output', 'frames')
        for there, back in ((0, 8), (1, 7), (3, 5)):
            np.testing.assert_array_equal(self.picture(f'frames/00{there}.png'), self.picture(f'frames/00{back}.png'))
        self.deform('--handles', '20,20; 14,40; 70,45 -> 80,45', '--output', 'half.png')
        np.testing.assert_allclose(self.picture('frames/002.png')[:, :, :3].astype(int),
                                   self.picture('half.png')[:, :, :3], atol=1)
        self.deform('--keys', 'keys.json', '--frames', '9', '--output', 'out.gif')
        with Image.open(self.path('out.gif')) as gif:
            self.assertEqual(gif.n_frames, 9)

    def test_messages(self):
        said = self.deform('--handles', '20,20; 70,45; 4,4', '--output', 'out.png')
        self.assertIn('outside all parts', said)
        said = self.deform('--handles', '20,20;\n70,45 -> 3', '--output', 'bad.png', code=2)
        self.assertIn('--handles, line 2, column 11', said)
        said = self.deform('--handles', '20,20 ^', '--output', 'bad.png', code=2)
        self.assertIn('number of levels', said)
        self.assertFalse(os.path.exists(self.path('bad.png')))

    def test_wrong_usage(self):
        self.assertIn('no handles', self.deform('--output', 'out.png', code=1))
        self.deform('--handles', PINS, '--keys', 'keys.json', '--output', 'out.png', code=2)
        self.deform('--handles', PINS, code=2)
        self.deform('--handles', PINS, '--output', 'out.mpo', code=2)

    def test_wrong_keys(self):
        handle = [20, 20, 30, 20]
        good = {'frame': 0, 'handles': [handle]}
        for wrong, naming in (({'keys': []}, 'at least one'), ({'keys': [good], 'fps': 3}, '"fps" is unknown'), ([], 'object'),
                              ({'keys': [{'frame': 0}]}, '"handles" is missing'), ({'keys': [3]}, 'key 1'),
                              ({'keys': [dict(good, ease=1)]}, '"ease" is unknown'),
                              ({'keys': [dict(good, frame=-1)]}, '"frame"'), ({'keys': [dict(good, frame=0.5)]}, '"frame"'),
                              ({'keys': [good, good]}, 'later'), ({'keys': [dict(good, handles=[[1, 2, 3]])]}, 'handle 1'),
                              ({'keys': [dict(good, handles=[[1, 2, 'a', 3]])]}, 'handle 1'),
                              ({'keys': [good, {'frame': 3, 'handles': []}]}, '0 handles'),
                              ({'keys': [good, {'frame': 3, 'handles': [[21, 20]]}]}, 'first two')):
            with open(self.path('keys.json'), 'w', encoding='utf-8') as file:
                json.dump(wrong, file)
            self.assertIn(naming, self.deform('--keys', 'keys.json', '--output', 'out.gif', code=1))
        with open(self.path('keys.json'), 'w', encoding='utf-8') as file:
            file.write('{"keys": [')
        self.assertIn('keys.json', self.deform('--keys', 'keys.json', '--output', 'out.gif', code=1))


if __name__ == '__main__':
    unittest.main()
