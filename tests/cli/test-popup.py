#!/usr/bin/python3
"""All results of popup in one run, of a coloured drawing that is drawing and art: those that single commands make.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import unittest

import numpy as np
from PIL import Image, ImageDraw

from pictures import HEIGHT, IN_A, IN_B, IN_PAGE, RELATIONS, WIDTH, Test, at, drawing
from stacks import read_exr, read_open_raster

FILLS = {IN_A: (250, 190, 60), IN_B: (90, 160, 70), IN_PAGE: (200, 225, 250)}
INPUT = ['page.png', '--scribbles', 'scribbles.png', '--relations', RELATIONS]


class OneRun(Test):
    def setUp(self):
        super().setUp()
        page = drawing().convert('RGB')
        for place, colour in FILLS.items():
            ImageDraw.floodfill(page, place, colour)
        page.save(self.path('page.png'))

    def same(self, one, other):
        """Pictures, but for rounding: babl chooses the way to convert colours by how fast it is just then."""
        np.testing.assert_allclose(self.picture(one).astype(int), self.picture(other), atol=1)

    def same_layers(self, ones, others, error):
        self.assertEqual([name for name, _ in ones], [name for name, _ in others])
        for (_, one), (_, other) in zip(ones, others):
            np.testing.assert_allclose(one, other, atol=error)

    def test_single_commands(self):
        self.celdepth('popup', *INPUT, '--levels', 'levels.npy', '--enhanced', 'enhanced.png', '--layers', 'page.ora',
                      '--left', 'left.png', '--right', 'right.png', '--joined', 'joined.png', '--report', 'report.json')
        self.celdepth('enhance', 'levels.npy', '--colours', 'page.png', '--enhanced', 'enhanced-alone.png')
        self.celdepth('layers', *INPUT, '--output', 'alone.ora')
        self.celdepth('stereo', *INPUT, '--left', 'left-alone.png', '--right', 'right-alone.png', '--joined',
                      'joined-alone.png')
        self.same_layers(read_open_raster(self.path('page.ora'))[0], read_open_raster(self.path('alone.ora'))[0],
                         1.01 / 255)
        for name in 'enhanced', 'left', 'right', 'joined':
            self.same(f'{name}.png', f'{name}-alone.png')
        self.celdepth('popup', *INPUT, '--encoding', 'rank', '--enhanced', 'enhanced-ranks.png', '--left',
                      'left-ranks.png')
        for name in 'enhanced', 'left':
            self.same(f'{name}-ranks.png', f'{name}.png')
        self.celdepth('popup', *INPUT, '--layers', 'linear.ora', '--compositing', 'linear')
        self.celdepth('layers', *INPUT, '--output', 'linear-alone.ora', '--compositing', 'linear')
        self.same_layers(read_open_raster(self.path('linear.ora'))[0],
                         read_open_raster(self.path('linear-alone.ora'))[0], 1.01 / 255)
        self.celdepth('popup', *INPUT, '--layers', 'linear.exr')
        self.celdepth('layers', *INPUT, '--output', 'alone.exr')
        self.same_layers(read_exr(self.path('linear.exr'), WIDTH, HEIGHT)[0],
                         read_exr(self.path('alone.exr'), WIDTH, HEIGHT)[0], 1e-4)

    def test_layers_of_light_and_models(self):
        """Those of shade, enhance and relief, also without the art, and whatever the numbers of levels are."""
        names = {'shade': ('tone', 'rim', 'occlusion'), 'enhance': ('shadow', 'view')}
        light = ['--rim-light', '0.5', '--specular', '0.3']
        self.celdepth('popup', *INPUT, *light, '--encoding', 'rank', '--height', 'height.npy', '--mesh', 'page.glb',
                      *(word for group in names.values() for name in group for word in (f'--{name}', f'{name}.png')))
        self.celdepth('popup', *INPUT, '--levels', 'levels.npy', '--mesh', 'page.stl')
        for command, *words in (('shade', '--drawing', 'page.png', *light), ('enhance',)):
            self.celdepth(command, 'levels.npy', *words,
                          *(word for name in names[command] for word in (f'--{name}', f'{name}-alone.png')))
            for name in names[command]:
                self.same(f'{name}.png', f'{name}-alone.png')
                self.assertGreater(np.ptp(np.atleast_3d(self.picture(f'{name}.png').astype(int)), (0, 1)).max(), 20)
        self.celdepth('relief', *INPUT, '--height', 'height-alone.npy', '--mesh', 'alone.glb')
        self.celdepth('relief', *INPUT, '--mesh', 'alone.stl')
        np.testing.assert_array_equal(np.load(self.path('height.npy')), np.load(self.path('height-alone.npy')))
        for name in 'glb', 'stl':
            with open(self.path(f'page.{name}'), 'rb') as one, open(self.path(f'alone.{name}'), 'rb') as other:
                self.assertEqual(one.read(), other.read())

    def test_maps(self):
        """Those of shade, also with green that points down, as in the normals beside them."""
        self.celdepth('popup', *INPUT, '--levels', 'levels.npy', '--maps', 'up.png', '--normals', 'up.npy')
        self.celdepth('popup', *INPUT, '--maps', 'down.png', '--normals', 'down.npy', '--directx', '--padding', '0')
        self.celdepth('shade', 'levels.npy', '--drawing', 'page.png', '--maps', 'shade.png')
        for letter in 'nos':
            self.same(f'up_{letter}.png', f'shade_{letter}.png')
        up, down = (np.load(self.path(f'{name}.npy')) for name in ('up', 'down'))
        np.testing.assert_array_equal(down, up * (1, -1, 1))
        self.assertGreater(np.abs(up[..., 1]).max(), 0.5)
        np.testing.assert_allclose(self.picture('down_n.png')[..., :3] / 255, 0.5 + 0.5 * down, atol=1 / 255)

    def test_many_views(self):
        """Those of stereo and wiggle; what moves shows twice the depth unless the artist says how much."""
        self.celdepth('popup', *INPUT, '--views', '3', '--quilt', 'quilt.png', '--sequence', 'views', '--wiggle',
                      'moving', '--frames', '4', '--left', 'left.png')
        self.celdepth('stereo', *INPUT, '--views', '3', '--quilt', 'quilt-alone.png', '--sequence', 'views-alone')
        self.celdepth('wiggle', *INPUT, '--frames', '4', '--output', 'moving-alone')
        self.celdepth('popup', *INPUT, '--wiggle', 'little', '--frames', '4', '--disparity', '0.02')
        self.celdepth('wiggle', *INPUT, '--frames', '4', '--disparity', '0.02', '--output', 'little-alone')
        self.same('quilt.png', 'quilt-alone.png')
        for folder, number in (('views', 3), ('moving', 4), ('little', 4)):
            names = sorted(os.listdir(self.path(folder)))
            self.assertEqual(len(names), number)
            self.assertEqual(names, sorted(os.listdir(self.path(f'{folder}-alone'))))
            for name in names:
                self.same(f'{folder}/{name}', f'{folder}-alone/{name}')
        self.same('views/' + sorted(os.listdir(self.path('views')))[0], 'left.png')
        self.assertFalse(np.array_equal(self.picture('moving/' + sorted(os.listdir(self.path('moving')))[1]),
                                        self.picture('little/' + sorted(os.listdir(self.path('little')))[1])))

    def test_light(self):
        """From the upper left: parts are lighter there than at the lower right, and the page is as it was."""
        self.celdepth('popup', *INPUT, '--shaded', 'lit.png', '--light-azimuth', '135')
        lit = self.picture('lit.png').astype(int)
        np.testing.assert_allclose(at(lit, IN_PAGE)[:3], FILLS[IN_PAGE], atol=1)
        self.assertGreater(lit[29, 44, 1], lit[53, 81, 1] + 30)
        self.celdepth('popup', *INPUT, '--shaded', 'flat.png', '--bulge', '0')
        for place, colour in FILLS.items():
            np.testing.assert_allclose(at(self.picture('flat.png'), place)[:3].astype(int), colour, atol=1)

    def test_presets(self):
        """The same as their settings one by one; those that are given count more, before and behind."""
        def lit(name, *words):
            self.celdepth('popup', *INPUT, '--shaded', name + '.png', '--enhanced', name + '-enhanced.png', *words)
            return self.picture(name + '.png').astype(int), self.picture(name + '-enhanced.png').astype(int)
        usual, cel = lit('usual'), lit('cel', '--preset', 'cel')
        np.testing.assert_array_equal(lit('everyday', '--preset=everyday'), usual)
        np.testing.assert_array_equal(
            lit('toon', '--light-model', 'toon', '--toon-steps', '2', '--ambient', '0.5'), cel)
        for ambient in '0.3', '0.25':  # the second is the default of the setting
            np.testing.assert_array_equal(lit('before', '--ambient', ambient, '--preset', 'cel'),
                                          lit('behind', '--preset', 'cel', '--ambient', ambient))
        changed = {name: [np.abs(made - was).max() for made, was in zip(lit(name, '--preset', name), usual)]
                   for name in ('cel', 'balloon', 'relief', 'paper')}
        self.assertTrue(all(lit_one > 30 for lit_one, _ in changed.values()), changed)
        self.assertGreater(changed['paper'][1], 30)
        self.assertIn("--preset must be everyday, cel, balloon, relief or paper, not 'nonsense'.",
                      self.celdepth('popup', *INPUT, '--shaded', 'no.png', '--preset', 'nonsense', code=2))

    def test_whose_line(self):
        """Lines that are darker shades of a part are that part's, in popup and in expand, although another is nearer."""
        shades = {place: tuple(2 * value // 5 for value in colour) for place, colour in FILLS.items()}

        def page(name, line_of_a, line_of_b):
            picture = Image.new('RGB', (WIDTH, HEIGHT), FILLS[IN_PAGE])
            draw = ImageDraw.Draw(picture)
            draw.rectangle([10, 10, 60, 45], fill=FILLS[IN_A], outline=line_of_a, width=4)
            draw.rectangle([40, 25, 85, 57], fill=FILLS[IN_B], outline=line_of_b, width=4)
            picture.save(self.path(name))

        page('shades.png', shades[IN_A], shades[IN_B])
        page('brown.png', (70, 40, 20), (70, 40, 20))
        for name in 'shades', 'brown':
            self.celdepth('popup', f'{name}.png', '--scribbles', 'scribbles.png', '--relations',
                          '4,4 > 20,20; 20,20 > 70,45', '--levels', f'{name}.npy', '--unexpanded-levels',
                          'flat.npy', '--labels', 'labels.png')
            self.celdepth('expand', 'flat.npy', '--drawing', f'{name}.png', '--regions', 'labels.png', '--levels',
                          f'{name}-alone.npy')
            np.testing.assert_array_equal(np.load(self.path(f'{name}.npy')), np.load(self.path(f'{name}-alone.npy')))
        a_at_page, b_at_a = (11, 30), (41, 35)
        for name, owners in ('shades', (IN_A, IN_B)), ('brown', (IN_PAGE, IN_A)):
            levels = np.load(self.path(f'{name}.npy'))
            self.assertEqual([at(levels, place) for place in (a_at_page, b_at_a)], [at(levels, place) for place in owners])

    def test_other_colours(self):
        """--colours is the art in place of the drawing."""
        drawing().save(self.path('lines.png'))
        words = ['--scribbles', 'scribbles.png', '--relations', RELATIONS, '--enhanced']
        self.celdepth('popup', 'lines.png', *words, 'other.png', '--colours', 'page.png')
        self.celdepth('popup', 'lines.png', *words, 'plain.png')
        other, plain = self.picture('other.png'), self.picture('plain.png')
        np.testing.assert_allclose(at(other, IN_B)[:3].astype(int), FILLS[IN_B], atol=1)
        np.testing.assert_allclose(at(plain, IN_B)[:3].astype(int), (255, 255, 255), atol=1)

    def test_bad_input(self):
        self.assertIn('celdepth shade with --matcap', self.celdepth('popup', *INPUT, '--shaded', 'lit.png',
                                                                    '--light-model', 'matcap', code=2))
        self.fails('popup', *INPUT, '--shaded', 'lit.png', '--colours', 'none.png', naming='"none.png"')
        self.assertIn('--layers page.jpg: the name must end in', self.celdepth('popup', *INPUT, '--layers', 'page.jpg',
                                                                              code=2))
        for words, message in ((('--compositing', 'linear', '--depth', 'd.png'), 'without --layers'),
                               (('--compositing', 'candle', '--layers', 'a.ora'), 'encoded or linear'),
                               (('--compositing', 'encoded', '--layers', 'a.exr'), 'linear light')):
            self.assertIn(message, self.celdepth('popup', *INPUT, *words, code=2))


if __name__ == '__main__':
    unittest.main()
