#!/usr/bin/python3
"""Strokes that say what is hidden: they change layers and views behind what hides it, and nothing that is visible.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import unittest

import numpy as np
from PIL import Image, ImageDraw

from pictures import BLUE, HEIGHT, RED, WIDTH, Test, drawing, scribbles, write_psd
from stacks import composite, premultiplied, read_open_raster

ORDER = '#{:02x}{:02x}{:02x} > #{:02x}{:02x}{:02x}'.format(*BLUE, *RED)
RED_NAME = '#{:02x}{:02x}{:02x}'.format(*RED)
BLACK = 0, 0, 0
# Behind the right box: far from the left one, and where that one goes on.
FAR, CORNER = (64, 46, 78, 50), (44, 29, 50, 36)


def strokes(*boxes):
    layer = Image.new('RGBA', (WIDTH, HEIGHT))
    draw = ImageDraw.Draw(layer)
    for box, colour in boxes:
        draw.rectangle(box, fill=colour + (255,))
    return layer


def inside(box):
    return slice(box[1], box[3] + 1), slice(box[0], box[2] + 1)


class Hidden(Test):
    def setUp(self):
        super().setUp()
        self.paint('hidden.png', (FAR, RED))

    def paint(self, name, *boxes):
        strokes(*boxes).save(self.path(name))

    def layers(self, *words, source=('drawing.png', '--scribbles', 'scribbles.png')):
        """Alpha of the left box's layer; all layers make the drawing."""
        self.celdepth('layers', *source, '--relations', ORDER, '--complete', 'yes', '--output', 'l.ora', *words)
        layers, _ = read_open_raster(self.path('l.ora'))
        merged = composite([premultiplied(canvas) for _, canvas in layers])
        page = np.asarray(drawing(), float)[..., None] / 255
        self.assertLessEqual(np.abs(merged[..., :3] - page).max(), 1 / 255)
        return dict(layers)[RED_NAME][..., 3]

    def test_strokes_add(self):
        plain, more = self.layers(), self.layers('--hidden', 'hidden.png')
        self.assertEqual(plain[inside(FAR)].max(), 0)
        self.assertEqual(more[inside(FAR)].min(), 1)

    def test_black_takes_away(self):
        self.paint('eraser.png', (CORNER, BLACK))
        plain, less = self.layers(), self.layers('--hidden', 'eraser.png')
        self.assertGreater(plain[inside(CORNER)].mean(), 0.95)
        self.assertEqual(less[inside(CORNER)].max(), 0)

    def test_visible_pixels_and_other_colours_do_not_matter(self):
        self.paint('nothing.png', ((14, 30, 34, 40), BLUE), (FAR, (255, 255, 255)), (CORNER, (200, 100, 7)))
        np.testing.assert_array_equal(self.layers(), self.layers('--hidden', 'nothing.png'))

    def test_layer_of_that_name(self):
        write_psd(self.path('page.psd'), (WIDTH, HEIGHT), [
            ('drawing', 0, 0, drawing().convert('RGBA')), ('scribbles', 0, 0, scribbles()),
            ('Hidden', 0, 0, strokes((FAR, RED)))])
        np.testing.assert_array_equal(self.layers(source=('page.psd',)), self.layers('--hidden', 'hidden.png'))

    def test_views_normals_and_models(self):
        """Where it is seen: in a view from far aside, in normals, and in a model."""
        of_drawing = 'drawing.png', '--scribbles', 'scribbles.png', '--relations', ORDER
        for command, output, words in (('stereo', 'v.npy', ('--disparity', '0.1', '--right')),
                                       ('relief', 'm.obj', ('--mesh',))):
            made = []
            self.paint('beside.png', ((70, 30, 84, 56), RED))
            for hidden in ((), ('--hidden', 'beside.png')):
                self.celdepth(command, *of_drawing, *hidden, *words, output)
                with open(self.path(output), 'rb') as file:
                    made.append(file.read())
            self.assertNotEqual(*made)
        self.popup('--relations', ORDER, '--hidden', 'hidden.png', '--normals', 'n.npy')
        self.celdepth('wiggle', *of_drawing, '--hidden', 'hidden.png', '--frames', '3', '--output', 'w.gif')

    def test_unsure(self):
        """A bar behind a wide board is named, unless nobody asks what is hidden, or a stroke says it."""
        size, bar, board = (300, 100), (5, 20, 294, 79), (60, 5, 239, 94)
        page, colours, hidden = Image.new('L', size, 255), Image.new('RGBA', size), Image.new('RGBA', size)
        for box in (bar, board):
            ImageDraw.Draw(page).rectangle(box, fill=255, outline=0, width=3)
        for line, colour in ((((15, 50), (40, 50)), RED), (((260, 50), (280, 50)), RED), (((90, 50), (200, 50)), BLUE),
                             (((2, 2), (297, 2)), (0, 160, 0))):
            ImageDraw.Draw(colours).line(line, fill=colour + (255,), width=3)
        ImageDraw.Draw(hidden).rectangle((50, 25, 250, 74), fill=RED + (255,))
        for picture, name in ((page, 'page.png'), (colours, 'colours.png'), (hidden, 'bar.png')):
            picture.save(self.path(name))

        def said(command, *words):
            text = self.celdepth(command, 'page.png', '--scribbles', 'colours.png', '--relations', ORDER, '--report',
                                 'r.json', *words)
            with open(self.path('r.json')) as file:
                report = json.load(file)
            problems = [p for p in report['problems'] if p['kind'] == 'hidden-unsure']
            self.assertEqual(len(problems), len(report['problems']))
            self.assertEqual('--hidden' in text, bool(problems) and '--quiet' not in words)
            for problem in problems:
                self.assertEqual(report['labels'][problem['label'] - 1]['colour'], RED_NAME)
                self.assertIn(RED_NAME, problem['text'])
                self.assertTrue(60 < problem['place'][0] < 240 and 20 < problem['place'][1] < 80)
            return len(problems)

        layers = 'layers', '--complete', 'yes', '--output', 'l.ora'
        self.assertEqual(said(*layers), 1)
        self.assertEqual(said(*layers, '--quiet'), 1)
        self.assertEqual(said(*layers, '--hidden', 'bar.png'), 0)
        self.assertEqual(said('layers', '--output', 'l.ora'), 0)
        self.assertEqual(said('popup', '--depth', 'd.npy'), 0)
        self.assertEqual(said('popup', '--depth', 'd.npy', '--shading', 's.npy'), 1)
        self.assertEqual(said('stereo', '--left', 'l.npy'), 1)
        self.assertEqual(said('relief', '--mesh', 'm.obj'), 1)

    def test_wrong_input(self):
        of_drawing = 'drawing.png', '--scribbles', 'scribbles.png'
        Image.new('RGBA', (5, 5)).save(self.path('small.png'))
        self.fails('stereo', *of_drawing, '--hidden', 'small.png', '--left', 'l.png', naming='has 5 x 5 pixels')
        self.fails('relief', *of_drawing, '--hidden', 'none.png', '--mesh', 'm.obj', naming='none.png')
        self.assertIn('--complete yes', self.celdepth('layers', *of_drawing, '--hidden', 'hidden.png', '--output',
                                                      'l.ora', code=2))
        self.assertIn('what is hidden', self.celdepth('relief', 'drawing.png', '--drawing', 'drawing.png', '--hidden',
                                                      'hidden.png', '--mesh', 'm.obj', code=2))


if __name__ == '__main__':
    unittest.main()
