#!/usr/bin/python3
"""celdepth inbetween: of two boxes the one in front moves over the other one.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import unittest

import numpy as np
from PIL import Image, ImageDraw

from pictures import BLUE, GREEN, RED, RELATIONS, HEIGHT, WIDTH, Test, at

AWAY = 24  # pixels that the box in front moves to the left and up by half of that


def page(share=0, art=False, front=True):
    """The page after a share of the motion, or a coloured version of it."""
    picture = Image.new('RGB', (WIDTH, HEIGHT), 'white')
    draw = ImageDraw.Draw(picture)
    x, y = round(share * AWAY), round(share * AWAY / 2)
    draw.rectangle([10, 10, 60, 45], fill=RED if art else 'white', outline=0, width=3)
    if front:
        draw.rectangle([50 - x, 28 - y, 85 - x, 57 - y], fill=BLUE if art else 'white', outline=0, width=3)
    return picture


def strokes(share=0, front=True):
    layer = Image.new('RGBA', (WIDTH, HEIGHT))
    draw = ImageDraw.Draw(layer)
    x, y = round(share * AWAY), round(share * AWAY / 2)
    draw.line([(16, 18), (24, 18)], fill=RED + (255,), width=3)
    if front:
        draw.line([(60 - x, 45 - y), (78 - x, 48 - y)], fill=BLUE + (255,), width=3)
    draw.line([(3, 3), (90, 4), (91, 60)], fill=GREEN + (255,), width=3)
    return layer


class Inbetween(Test):
    def setUp(self):
        super().setUp()
        for name, share in (('a', 0), ('b', 1)):
            page(share).save(self.path(f'{name}.png'))
            page(share, art=True).save(self.path(f'{name}-art.png'))
            strokes(share).save(self.path(f'{name}-strokes.png'))

    def inbetween(self, *words, code=0, scribbles_b=True):
        return self.celdepth('inbetween', 'a.png', 'b.png', '--scribbles', 'a-strokes.png', '--relations', RELATIONS,
                             *(('--scribbles-b', 'b-strokes.png') if scribbles_b else ()), *words, code=code)

    def coloured(self, *words, **more):
        return self.inbetween('--colours', 'a-art.png', '--colours-b', 'b-art.png', *words, **more)

    def differs(self, name, share):
        """The share of pixels off the edges, by 2 pixels, that differ from the page at this share of the way."""
        wanted = np.array(page(share, art=True)).astype(int)
        flat = np.ones(wanted.shape[:2], bool)
        for dy in range(-2, 3):
            for dx in range(-2, 3):
                flat &= (np.roll(wanted, (dy, dx), (0, 1)) == wanted).all(2)
        found = self.picture(name)[:, :, :3].astype(int)
        return (np.abs(found - wanted).max(2) > 8)[flat].mean()

    def test_frames_are_numbered_and_on_the_way(self):
        self.coloured('-n', '3', '--output', 'between_##.png')
        self.assertEqual(sorted(name for name in os.listdir(self.folder) if name.startswith('between')),
                         ['between_01.png', 'between_02.png', 'between_03.png'])
        for frame in (1, 2, 3):
            self.assertLess(self.differs(f'between_{frame:02}.png', frame / 4), 0.01)
        self.assertGreater(self.differs('between_02.png', 0), 0.05)

    def test_contradictions(self):
        """They are said where they stand in the text that was given."""
        text = self.celdepth('inbetween', 'a.png', 'b.png', '--scribbles', 'a-strokes.png', '--relations',
                             '#ff0000 > #0000ff; #0000ff > #ff0000', '--output', 'middle.png', code=3)
        self.assertIn('#0000ff > #ff0000  (--relations, line 1, column 20)', text)

    def test_one_frame_needs_no_number(self):
        self.coloured('--output', 'middle.png')
        self.assertLess(self.differs('middle.png', 0.5), 0.01)
        self.coloured('--frames', '2', '--output', 'out.png')
        self.assertTrue(os.path.exists(self.path('out_001.png')) and os.path.exists(self.path('out_002.png')))

    def test_lines_alone_stay_single(self):
        """Ink of the middle is as much as that of the page there; a cross-dissolve would have twice as many lines."""
        self.inbetween('--output', 'middle.png')
        ink, wanted = (1 - (picture / 255.0) ** 2.2 for picture in  # of light, in which pictures are resampled
                       (self.picture('middle.png')[:, :, 0], np.array(page(0.5).convert('L'))))
        self.assertLess(abs(ink.sum() / wanted.sum() - 1), 0.05)

    def test_regions_are_propagated(self):
        page(0.5).save(self.path('b.png'))
        page(0.5, art=True).save(self.path('b-art.png'))
        self.assertEqual(self.coloured('--output', 'middle.png', scribbles_b=False), '')
        self.assertLess(self.differs('middle.png', 0.25), 0.01)
        page(0, front=False).save(self.path('b.png'))
        self.assertRegex(self.coloured('--output', 'middle.png', scribbles_b=False),
                         r'#0000ff was not found; it was at \(\d+, \d+\) in "a.png"\.')

    def test_motions_have_the_keys(self):
        self.coloured('-n', '2', '--output', 'frames')
        self.assertEqual(sorted(os.listdir(self.path('frames'))), ['000.png', '001.png', '002.png', '003.png'])
        for name, share in (('000', 0), ('003', 1)):
            given = np.array(page(share, art=True)).astype(int)
            self.assertLessEqual(np.abs(self.picture(f'frames/{name}.png')[:, :, :3].astype(int) - given).max(), 1)
        self.coloured('-n', '2', '--output', 'frames.gif')
        with Image.open(self.path('frames.gif')) as gif:
            self.assertEqual(gif.n_frames, 4)

    def test_a_part_goes_behind_another(self):
        """The second drawing shows the front box alone: the other one is behind it in the end."""
        picture = Image.new('RGB', (WIDTH, HEIGHT), 'white')
        ImageDraw.Draw(picture).rectangle([4, 6, 70, 55], fill='white', outline=0, width=3)
        picture.save(self.path('b.png'))
        ImageDraw.Draw(picture).rectangle([7, 9, 67, 52], fill=BLUE)
        picture.save(self.path('b-art.png'))
        layer = Image.new('RGBA', (WIDTH, HEIGHT))
        draw = ImageDraw.Draw(layer)
        draw.line([(20, 30), (50, 30)], fill=BLUE + (255,), width=3)
        draw.line([(80, 4), (90, 60)], fill=GREEN + (255,), width=3)
        layer.save(self.path('b-strokes.png'))
        seen = []
        self.coloured('-n', '9', '--output', 'out_#.png')
        for frame in range(1, 10):
            found = self.picture(f'out_{frame}.png')[:, :, :3].astype(int)
            seen.append((np.abs(found - RED).max(2) < 8).sum())
        self.assertGreater(seen[0], 400)
        self.assertLess(seen[-1], seen[0] / 4)

    def test_wrong_input(self):
        self.assertIn('--arrows-b needs --scribbles-b',
                      self.inbetween('--arrows-b', 'b-strokes.png', '--output', 'x.png', scribbles_b=False, code=2))
        self.assertIn('must be a whole number between 1 and 10000', self.inbetween('-n', '0', '--output', 'x.png', code=2))
        self.assertIn('--output is missing', self.inbetween(code=2))
        self.assertIn('must end in', self.inbetween('--output', 'x.doc', code=2))
        self.assertIn('The second drawing is missing', self.celdepth('inbetween', 'a.png', '--output', 'x.png', code=2))
        Image.new('L', (30, 30), 255).save(self.path('small.png'))
        self.fails('inbetween', 'a.png', 'small.png', '--scribbles', 'a-strokes.png', '--output', 'x.png',
                   naming='pixels')


if __name__ == '__main__':
    unittest.main()
