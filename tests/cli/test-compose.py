#!/usr/bin/python3
"""celdepth compose: parts of one drawing between those of another, as a picture and as layers, and bad descriptions.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import os
import unittest

import numpy as np
from PIL import Image, ImageDraw

from pictures import BLUE, GREEN, HEIGHT, RED, RELATIONS, WIDTH, Test
from stacks import composite, encode, premultiplied, picture, read_exr, read_folder, read_open_raster

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../examples')
BAR = 20, 32, 80, 40  # the bar's outline: left, top, right, bottom


def text(colour):
    return '#%02x%02x%02x' % colour


class Compose(Test):
    """The page of two boxes, B (blue) before A (red), and a coloured bar across both."""

    def setUp(self):
        super().setUp()
        bar = Image.new('RGB', (WIDTH, HEIGHT), 'white')
        ImageDraw.Draw(bar).rectangle(BAR, fill='yellow', outline=0, width=2)
        bar.save(self.path('bar-art.png'))
        line = Image.new('L', (WIDTH, HEIGHT), 255)
        ImageDraw.Draw(line).rectangle(BAR, fill=255, outline=0, width=2)
        line.save(self.path('bar.png'))
        strokes = Image.new('RGBA', (WIDTH, HEIGHT))
        draw = ImageDraw.Draw(strokes)
        draw.line([(24, 36), (76, 36)], fill=RED + (255,), width=2)
        draw.line([(3, 3), (90, 4)], fill=GREEN + (255,), width=3)
        strokes.save(self.path('bar-strokes.png'))

    def write(self, name='scene.json', **scene):
        with open(self.path(name), 'w', encoding='utf-8') as file:
            json.dump(scene, file)

    def scene(self, *relations, boxes=None, bar=None, **more):
        self.write(fragments=[
            {'name': 'boxes', 'drawing': 'drawing.png', 'scribbles': 'scribbles.png', 'relations': RELATIONS,
             **(boxes or {})},
            {'drawing': 'bar.png', 'scribbles': 'bar-strokes.png', 'colours': 'bar-art.png', **(bar or {})}],
                   relations=list(relations), **more)

    def compose(self, *words, output='out.png', code=0):
        return self.celdepth('compose', 'scene.json', '--output', output, *words, code=code)

    def pixels(self, name='out.png'):
        """R, G, B, A in [0,1]; Pillow reads 16 bits of colour as 8."""
        return picture(self.path(name))

    # The middle of the bar on A alone, on B, and on the page.
    def colours_on(self, image):
        return [tuple(round(v) for v in image[y, x, :3]) for x, y in ((30, 36), (55, 36), (15, 36), (70, 36))]

    YELLOW, WHITE = (1, 1, 0), (1, 1, 1)

    def test_one_drawing_is_itself(self):
        for words in ((), ('--compositing', 'linear')):
            self.write(fragments=[{'drawing': 'drawing.png', 'scribbles': 'scribbles.png', 'relations': RELATIONS}])
            self.compose(*words)
            with Image.open(self.path('drawing.png')) as image:
                wanted = np.array(image.convert('RGBA')) / 255
            np.testing.assert_allclose(self.pixels(), wanted, atol=1 / 255 + 1e-9)

    def test_a_bar_between_two_boxes(self):
        self.scene()
        self.compose()
        self.assertEqual(self.colours_on(self.pixels()), [self.YELLOW, self.YELLOW, self.WHITE, self.YELLOW])
        for above in (f'boxes:{text(BLUE)} > bar:*', 'boxes:70,50 > bar:30,36', f'bar:{text(RED)} < boxes:70,50'):
            self.scene(above)
            self.compose()
            image = self.pixels()
            self.assertEqual(self.colours_on(image), [self.YELLOW, self.WHITE, self.WHITE, self.WHITE])
            # The outline of B is the drawing's own on the bar, too.
            with Image.open(self.path('drawing.png')) as drawn:
                own = np.array(drawn)[30:42, 40:86] / 255
            np.testing.assert_allclose(image[30:42, 40:86, 0], own, atol=1 / 255 + 1e-9)
        self.scene('boxes:* > bar:*')
        self.compose()
        self.assertEqual(self.colours_on(self.pixels()), [self.WHITE] * 4)

    def test_places(self):
        """Whole pixels exactly; half size; turned by a right angle; the size of the picture."""
        self.scene(bar={'x': 7, 'y': 20}, width=WIDTH + 10, height=HEIGHT + 20)
        self.compose()
        image = self.pixels()
        self.assertEqual(image.shape, (HEIGHT + 20, WIDTH + 10, 4))
        with Image.open(self.path('bar-art.png')) as art:
            wanted = np.array(art)[BAR[1]:BAR[3] + 1, BAR[0]:BAR[2] + 1] / 255
        np.testing.assert_allclose(image[BAR[1] + 20:BAR[3] + 21, BAR[0] + 7:BAR[2] + 8, :3], wanted, atol=1e-4)
        self.assertEqual(image[-1, -1, 3], 0)
        self.scene(bar={'scale': 0.5, 'x': 1.5})
        self.compose()
        np.testing.assert_allclose(self.pixels()[18, 14, :3], self.YELLOW, atol=1e-4)
        np.testing.assert_allclose(self.pixels()[18, 38, :3], self.YELLOW, atol=1e-4)
        self.scene(bar={'turn': 90})
        self.compose()
        # The bar's middle, (50.5, 36.5), goes clockwise round (48, 32) to (43.5, 34.5); its ends are above and below.
        for y in (10, 34, 59):
            np.testing.assert_allclose(self.pixels()[y, 43, :3], self.YELLOW, atol=1e-4)
        self.scene(bar={'turn': -720, 'flip': True})
        self.compose()
        np.testing.assert_allclose(self.pixels()[36, WIDTH - 1 - 75, :3], self.YELLOW, atol=1e-4)

    def test_layers_make_the_picture(self):
        self.scene(f'boxes:{text(BLUE)} > bar:*', bar={'x': -3.3, 'y': 2.7, 'scale': 0.9, 'turn': 8})
        self.compose()
        flat = premultiplied(self.pixels())
        self.compose(output='out.ora')
        layers, merged = read_open_raster(self.path('out.ora'))
        names = [name for name, _ in layers]
        self.assertEqual(names, [f'boxes {text(GREEN)}', f'boxes {text(RED)}', f'bar {text(RED)}',
                                 f'boxes {text(BLUE)}'])
        np.testing.assert_allclose(premultiplied(merged), flat, atol=1.01 / 255)
        np.testing.assert_allclose(composite([premultiplied(layer) for _, layer in layers]), flat, atol=2.01 / 255)
        self.compose('--complete', 'yes', output='folder')
        layers = read_folder(self.path('folder'))
        np.testing.assert_allclose(composite([premultiplied(layer) for _, layer in layers]), flat, atol=2.01 / 255)
        with open(self.path('folder/layers.json'), encoding='utf-8') as file:
            told = json.load(file)['layers']
        self.assertEqual([layer['name'] for layer in told], names)
        self.assertEqual([layer['level'] for layer in told], [0, 1, 2, 3])
        self.assertEqual(told[1]['parent'], told[3]['file'])  # of the blue box most is visible
        # The red box goes on behind the bar, and, as its sheet does, behind the blue box.
        self.assertEqual(layers[1][1][14:44, 14:38, 3].min(), 1)
        self.assertEqual(layers[1][1][29, 45, 3], 1)
        self.compose(output='out.exr')
        layers, _ = read_exr(self.path('out.exr'), WIDTH, HEIGHT)
        self.assertEqual([name for name, _ in layers], names)
        self.compose('--compositing', 'linear', output='linear.png')
        linear = composite([layer for _, layer in layers])
        np.testing.assert_allclose(encode(linear[..., :3]), self.pixels('linear.png')[..., :3], atol=1.5 / 255)

    def test_handles(self):
        """A pin changes nothing, and handles that all go down by ten pixels are another `y`; `^` has no meaning."""
        self.scene(f'boxes:{text(BLUE)} > bar:*')
        self.compose()
        rest = self.pixels()
        self.scene(f'boxes:{text(BLUE)} > bar:*', bar={'handles': '50,36'})
        self.compose()
        np.testing.assert_allclose(self.pixels(), rest, atol=1 / 255)
        self.scene(bar={'y': 10})
        self.compose()
        lower = self.pixels()
        self.scene(bar={'handles': ['24,36 -> 24,46', '76,36 -> 76,46']})
        self.compose()
        np.testing.assert_allclose(self.pixels(), lower, atol=1 / 255)
        self.scene(bar={'handles': '24,36 -> 24,46 ^1'})
        self.fails_with('"^"')

    def test_levels(self):
        self.scene(f'boxes:{text(BLUE)} > bar:*')
        self.celdepth('compose', 'scene.json', '--levels', 'levels.npy', '--encoding', 'rank')
        levels = np.load(self.path('levels.npy'))
        self.assertEqual([levels[y, x] for x, y in ((3, 3), (20, 20), (30, 36), (70, 45))], [0, 1, 2, 3])
        self.celdepth('compose', 'scene.json', '--levels', 'levels.exr')
        np.testing.assert_allclose(self.channel('levels.exr', 'depth.V'), levels / 3, atol=1e-6)

    def test_contradictions(self):
        self.scene(f'boxes:{text(RED)} > bar:*', f'bar:* > boxes:{text(BLUE)}')
        said = self.compose(code=3)
        self.assertIn(f'bar:* > boxes:{text(BLUE)}  (line 2, column 1)', said)
        self.assertIn(f'boxes:{text(RED)} > bar:*  (line 1, column 1)', said)
        self.assertEqual(self.colours_on(self.pixels()), [self.WHITE] * 4)
        self.scene(f'boxes:{text(RED)} > boxes:{text(BLUE)}')
        self.assertIn('the order of a drawing', self.compose(code=3))
        self.scene(boxes={'relations': RELATIONS + '; 20,20 > 70,45'})
        self.assertIn('"boxes"', self.compose(code=3))

    def test_ends_that_name_nothing(self):
        self.scene('boxes:#123456 > bar:*', 'boxes:500,3 > bar:*')
        said = self.compose()
        self.assertIn('The relation in line 1, column 1 names a colour', said)
        self.assertIn('The relation in line 2, column 1 names a point outside', said)

    def fails_with(self, naming, output='out.png'):
        self.fails('compose', 'scene.json', '--output', output, naming=naming)

    def test_bad_relations(self):
        for relation, naming in (('box:1,1 > bar:*', 'line 1, column 1: expected the name of one of the drawings'),
                                 ('boxes:1,1 > 3,3', 'line 1, column 13: expected the name of a drawing'),
                                 ('boxes:1,1', 'line 1, column 10: expected')):
            self.scene(relation)
            self.fails_with(naming)

    def test_bad_descriptions(self):
        good = {'drawing': 'drawing.png', 'scribbles': 'scribbles.png'}
        for scene, naming in (
                ({}, '"fragments" is missing'), ({'fragments': []}, '"fragments" must be a list'),
                ({'fragments': {}}, '"fragments" must be a list'), ({'fragments': [3]}, 'fragment 1: it must be'),
                ({'fragments': [good], 'layers': 1}, '"layers" is not a member'),
                ({'fragments': [{**good, 'angle': 1}]}, 'fragment 1: "angle" is not a member'),
                ({'fragments': [good, {'name': 'b'}]}, 'fragment 2: "drawing" is missing'),
                ({'fragments': [good, good]}, 'fragments 1 and 2 both have the name "drawing"'),
                ({'fragments': [{**good, 'name': 'a b'}]}, 'the name "a b"'),
                ({'fragments': [{**good, 'name': ''}]}, 'the name ""'),
                ({'fragments': [{**good, 'x': '3'}]}, '"x" must be a number'),
                ({'fragments': [{**good, 'x': 1e300}]}, '"x" must be from -1000000 to 1000000'),
                ({'fragments': [{**good, 'flip': 1}]}, '"flip" must be true or false'),
                ({'fragments': [{**good, 'scale': 0}]}, '"scale" must be from 0.001 to 1000'),
                ({'fragments': [{**good, 'relations': [1]}]}, '"relations" must be a text or a list'),
                ({'fragments': [{**good, 'hidden': 'h.png'}]}, '--complete yes'),
                ({'fragments': [{**good, 'drawing': 'missing.png'}]}, 'missing.png'),
                ({'fragments': [{**good, 'scribbles': 'bar.txt'}]}, 'bar.txt'),
                ({'fragments': [{'drawing': 'drawing.png'}]}, '"scene.json", "drawing": There are no scribbles'),
                ({'fragments': [good], 'width': 0, 'height': 9}, '"width" must be a whole number from 1 to 20000'),
                ({'fragments': [good], 'width': 9, 'height': 20001}, '"height" must be a whole number'),
                ({'fragments': [good], 'width': 9.5, 'height': 9}, '"width" must be'),
                ({'fragments': [good], 'width': 9}, 'both "width" and "height"')):
            with self.subTest(naming):
                self.write(**scene)
                self.fails_with(naming)
        with open(self.path('scene.json'), 'w', encoding='utf-8') as file:
            file.write('{ "fragments": [\n  { "drawing" "a.png" } ] }')
        self.fails_with('"scene.json": line 2 is no JSON')
        os.unlink(self.path('scene.json'))
        self.fails_with('scene.json')

    def test_usage(self):
        self.scene()
        self.assertIn('must end in', self.compose(output='out.jpg', code=2))
        self.assertIn('nothing to write', self.celdepth('compose', 'scene.json', code=2))
        self.assertIn('linear light', self.compose('--compositing', 'encoded', output='out.exr', code=2))
        self.assertIn('candle', self.compose('--compositing', 'candle', code=2))
        self.assertIn('overwrite', self.celdepth('compose', 'drawing.png', '--output', 'drawing.png', code=2))

    def test_examples(self):
        """A caterpillar behind the two people in front, and in front of the one behind."""
        self.celdepth('compose', os.path.join(EXAMPLES, 'people/composition.json'), '--output', 'out.png', '--quiet')
        image = self.pixels()[..., 0]
        with Image.open(os.path.join(EXAMPLES, 'people/drawing.png')) as people:
            drawn = np.array(people) / 255
        inside = ((251, 430), (772, 490), (271, 705), (786, 765), (160, 357), (902, 410))
        for x, y in inside:  # faces and bodies in front, and their hair, are as drawn
            np.testing.assert_allclose(image[y - 40:y + 41, x - 30:x + 31], drawn[y - 40:y + 41, x - 30:x + 31],
                                       atol=1 / 255 + 1e-9)
        self.assertGreater(np.abs(image[380:560, 450:570] - drawn[380:560, 450:570]).max(), 0.9)
        self.assertLess(image[380:560, 450:570].mean(), 0.97)


if __name__ == '__main__':
    unittest.main()
