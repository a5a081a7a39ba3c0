#!/usr/bin/python3
"""Every result in every format, read by independent readers and by the single steps.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import unittest

import numpy as np
from PIL import Image, ImageDraw

from pictures import BLUE, GREEN, HEIGHT, IN_A, IN_B, IN_PAGE, RED, RELATIONS, WIDTH, Test, at, drawing, png_chunks

ENDINGS = ('png', 'exr', 'tif', 'npy')


class Formats(Test):
    def make(self, option, *words):
        """One result in all formats."""
        for ending in ENDINGS:
            self.popup('--relations', RELATIONS, f'--{option}', f'{option}.{ending}', *words)
        return np.load(self.path(f'{option}.npy'))

    def test_labels(self):
        numbers = self.make('labels')
        self.assertEqual(numbers.dtype, np.float32)
        self.assertEqual(len({at(numbers, p) for p in (IN_A, IN_B, IN_PAGE)} | set(np.unique(numbers))), 3)
        for ending in ('png', 'tif'):
            colours = self.picture(f'labels.{ending}')
            self.assertEqual(colours.shape, (HEIGHT, WIDTH, 4))
            for place, colour in ((IN_A, RED), (IN_B, BLUE), (IN_PAGE, GREEN)):
                self.assertEqual(tuple(at(colours, place)), colour + (255,))
        linear = ((160 / 255 + 0.055) / 1.055) ** 2.4
        self.assertAlmostEqual(at(self.channel('labels.exr', 'G'), IN_PAGE), linear, places=3)
        self.assertEqual(at(self.channel('labels.exr', 'B'), IN_B), 1)

    def test_transparent_background(self):
        """Where no scribble is the background, its label is transparent, and its colour is straight."""
        self.popup('--labels', 'labels.png', '--background', 'auto')
        self.assertEqual(png_chunks(self.path('labels.png'))[1][2:4], (8, 6))

    def check_planes(self, option, values):
        """Values in [0,1] in all formats."""
        stored = self.picture(f'{option}.png')
        names, header = png_chunks(self.path(f'{option}.png'))
        self.assertEqual(header[:4], (WIDTH, HEIGHT, 16, 0))
        for name in ('sRGB', 'gAMA', 'iCCP'):
            self.assertNotIn(name, names)
        np.testing.assert_allclose(stored / 65535, values, atol=0.51 / 65535)
        np.testing.assert_array_equal(self.picture(f'{option}.tif'), values)
        np.testing.assert_array_equal(self.channel(f'{option}.exr', 'depth.V'), values)
        np.testing.assert_allclose(self.channel(f'{option}.exr', 'Z'), 2 - values, atol=1e-6)

    def test_levels(self):
        values = self.make('levels')
        self.assertEqual([at(values, p) for p in (IN_PAGE, IN_A, IN_B)], [0, 0.5, 1])
        self.check_planes('levels', values)
        self.check_planes('unexpanded-levels', self.make('unexpanded-levels'))

    def test_depth(self):
        values = self.make('depth')
        self.assertLess(at(values, IN_PAGE), at(values, IN_A))
        self.assertLess(at(values, IN_A), at(values, IN_B))
        self.check_planes('depth', values)

    def test_ranks(self):
        """Ranks are stored as numbers in .npy and .tif; in others near is white, and steps read them as ranks."""
        ranks = self.make('unexpanded-levels', '--encoding', 'rank')
        self.assertEqual(sorted(set(ranks.flat)), [0, 1, 2])
        np.testing.assert_array_equal(self.picture('unexpanded-levels.tif'), ranks)
        np.testing.assert_allclose(self.picture('unexpanded-levels.png') / 65535, ranks / 2, atol=1e-5)
        np.testing.assert_array_equal(self.channel('unexpanded-levels.exr', 'depth.V'), ranks / 2)
        for ending in ENDINGS:
            with self.subTest(ending):
                self.celdepth('expand', f'unexpanded-levels.{ending}', '--drawing', 'drawing.png', '--levels', 'again.npy')
                again = np.load(self.path('again.npy'))
                np.testing.assert_allclose(again, np.round(again), atol=1e-4)
                self.assertEqual(at(again, IN_B), 2)

    def test_fixed_levels(self):
        self.popup('--relations', RELATIONS, '--levels', 'l.npy', '--encoding', 'fixed', '--near-level', '10',
                   '--far-level', '-10')
        levels = np.load(self.path('l.npy'))
        np.testing.assert_allclose([at(levels, p) for p in (IN_PAGE, IN_A, IN_B)], [0.5, 0.55, 0.6], atol=1e-6)
        words = ('popup', 'drawing.png', '--scribbles', 'scribbles.png', '--relations', RELATIONS, '--levels', 'l.png',
                 '--encoding', 'fixed', '--near-level')
        self.assertIn('--near-level to 2', self.celdepth(*words, '1'))
        self.assertEqual(self.celdepth(*words, '2', '--far-level', '-1'), '')

    def test_normals(self):
        normals = self.make('normals')
        self.assertEqual(normals.shape, (HEIGHT, WIDTH, 3))
        np.testing.assert_allclose(np.linalg.norm(normals, axis=2), 1, atol=1e-3)
        for i, name in enumerate(('N.X', 'N.Y', 'N.Z')):
            np.testing.assert_array_equal(self.channel('normals.exr', name), normals[:, :, i])
        names, header = png_chunks(self.path('normals.png'))
        self.assertEqual(header[:4], (WIDTH, HEIGHT, 16, 2))
        self.assertNotIn('sRGB', names)
        np.testing.assert_allclose(self.picture('normals.png') / 255, 0.5 + 0.5 * normals, atol=1.1 / 255)

    def test_shading(self):
        shading = self.make('shading')
        self.assertGreaterEqual(shading.min(), 0)
        np.testing.assert_array_equal(self.picture('shading.tif'), shading)
        np.testing.assert_array_equal(self.channel('shading.exr', 'Y'), shading)
        encoded = np.where(shading <= 0.0031308, 12.92 * shading, 1.055 * np.maximum(shading, 0) ** (1 / 2.4) - 0.055)
        np.testing.assert_allclose(self.picture('shading.png') / 65535, encoded, atol=2e-5)
        self.assertIn('sRGB', png_chunks(self.path('shading.png'))[0])

    def open_box(self):
        """A gap of ten pixels in the left side of box A."""
        page = drawing()
        ImageDraw.Draw(page).rectangle([8, 20, 14, 29], fill=255)
        page.save(self.path('drawing.png'))

    def report(self):
        with open(self.path('report.json'), encoding='utf-8') as file:
            return json.load(file)

    def test_closures(self):
        """A red line over the gap on a transparent layer, and the same line in the report."""
        self.open_box()
        values = self.make('closures', '--report', 'report.json')
        self.assertEqual(values.shape, (HEIGHT, WIDTH, 4))
        layer = self.picture('closures.png')
        np.testing.assert_allclose(values, layer / 255, atol=1e-6)
        painted = layer[:, :, 3] > 0
        rows, columns = np.nonzero(painted)
        self.assertTrue(set(range(21, 29)) <= set(rows))
        self.assertTrue(min(rows) >= 14 and max(rows) <= 35 and min(columns) >= 6 and max(columns) <= 16)
        self.assertGreater(layer[painted][:, 0].min(), 200)
        self.assertLess(layer[painted][:, 1:3].max(), 60)
        report = self.report()
        self.assertEqual(report['method'], 'basins')
        closure, = report['closures']
        colours = {report['labels'][k - 1]['colour'] for k in closure['labels']}
        self.assertEqual(colours, {'#ff0000', '#00a000'})
        ends = sorted((closure['line'][0], closure['line'][-1]), key=lambda place: place[1])
        for (x, y), (wanted_x, wanted_y) in zip(ends, ((11.5, 20), (11.5, 30))):
            self.assertAlmostEqual(x, wanted_x, delta=3)
            self.assertAlmostEqual(y, wanted_y, delta=3)

    def test_closures_used_as_contours_change_nothing(self):
        """Used as virtual contours they leave no gap to close, and regions as they are."""
        self.open_box()
        self.popup('--closures', 'closures.png', '--labels', 'a.png')
        self.popup('--contours', 'closures.png', '--labels', 'b.png', '--report', 'report.json')
        self.assertEqual(self.report()['closures'], [])
        self.assertLess((self.picture('a.png') != self.picture('b.png')).any(2).sum(), 20)

    def test_no_closures(self):
        self.open_box()
        for words in (('--method', 'exact'), ('--method', 'walker'), ('--close-gaps', 'no')):
            with self.subTest(words):
                self.celdepth('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--closures', 'c.png',
                              '--report', 'report.json', *words)
                self.assertEqual(self.picture('c.png').max(), 0)
                self.assertEqual(self.report()['closures'], [])
                self.assertEqual(self.report()['method'], words[1] if '--method' in words else 'basins')

    def test_suggestions(self):
        """As text, as arrows that can be read, in the report; they count only if they are enabled, and never against the
        artist."""
        words = ('--levels', 'levels.npy', '--report', 'report.json')
        self.popup(*words, '--suggestions', 'suggestions.txt', '--suggested-arrows', 'arrows.png')
        with open(self.path('suggestions.txt'), encoding='utf-8') as file:
            text = file.read()
        self.assertEqual(text.splitlines(), [s['text'] for s in self.report()['suggestions']])
        self.assertEqual(len(text.splitlines()), 3)
        self.assertEqual(self.report()['relations'], [])
        plain = np.load(self.path('levels.npy'))
        self.assertEqual(at(plain, IN_A), at(plain, IN_B))
        for asked in (('--suggest', 'fill-gaps'), ('--suggest', 'all'), ('--relations', text),
                      ('--arrows', 'arrows.png')):
            with self.subTest(asked):
                self.popup(*words, *asked)
                levels = np.load(self.path('levels.npy'))
                self.assertLess(at(levels, IN_A), at(levels, IN_B))
        self.popup(*words, '--suggest', 'all', '--relations', '#ff0000 > #0000ff')
        levels = np.load(self.path('levels.npy'))
        self.assertGreater(at(levels, IN_A), at(levels, IN_B))
        self.assertEqual([r['source'] for r in self.report()['relations']], ['text', 'suggestion', 'suggestion'])

    def suggested(self, flat):
        """The pairs of colours that suggestions.txt puts in order."""
        pairs = set()
        with open(self.path('suggestions.txt'), encoding='utf-8') as file:
            for line in file:
                points = [[float(v) for v in point.split(',')] for point in line.split(' @')[0].split(' > ')]
                pairs.add(tuple(tuple(flat[int(y), int(x)]) for x, y in points))
        return pairs

    def test_depth_hint(self):
        """A depth hint in any unit adds suggestions, which count only if they are enabled and never against the
        artist."""
        popup = ('popup', 'drawing.png', '--scribbles', 'scribbles.png')
        self.celdepth('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--labels', 'flat.png')
        flat = self.picture('flat.png')
        for nearer, farther in ((IN_A, IN_B), (IN_B, IN_A)):
            front, back = (tuple(at(flat, place)) for place in (nearer, farther))
            depth = np.where((flat == front).all(-1), 700, np.where((flat == back).all(-1), 300, 0))
            np.save(self.path('hint.npy'), depth.astype(np.float32))
            for arguments in (('order', 'flat.png'), popup):
                with self.subTest(arguments, nearer=nearer):
                    out = '--unexpanded-levels' if arguments[0] == 'order' else '--levels'
                    hinted = (*arguments, out, 'levels.npy', '--depth-hint', 'hint.npy')
                    self.celdepth(*hinted, '--suggestions', 'suggestions.txt')
                    self.assertIn((front, back), self.suggested(flat))
                    levels = np.load(self.path('levels.npy'))
                    self.assertEqual(at(levels, nearer), at(levels, farther))
                    self.celdepth(*hinted, '--suggest', 'all', '--relations', '{},{} < {},{}'.format(*nearer, *farther))
                    levels = np.load(self.path('levels.npy'))
                    self.assertLess(at(levels, nearer), at(levels, farther))
        np.save(self.path('hint.npy'), np.zeros((3, 3), np.float32))
        self.fails(*popup, '--levels', 'levels.npy', '--depth-hint', 'hint.npy', naming='hint.npy')

    def test_blue_arrows_are_cracks(self):
        """In other colours they are arrows without the flag."""
        for colour, crack in (((0, 60, 255), True), ((200, 60, 0), False)):
            with self.subTest(colour):
                layer = Image.new('RGBA', (WIDTH, HEIGHT))
                draw = ImageDraw.Draw(layer)
                draw.line([(18, 20), (68, 45)], fill=colour + (255,), width=3)
                draw.polygon([(72, 47), (67, 39), (62, 48)], fill=colour + (255,))
                layer.save(self.path('arrows.png'))
                self.popup('--arrows', 'arrows.png', '--levels', 'levels.npy', '--report', 'report.json')
                levels, relations = np.load(self.path('levels.npy')), self.report()['relations']
                self.assertGreater(at(levels, IN_A), at(levels, IN_B))
                self.assertEqual([(r['source'], r.get('crack', False)) for r in relations], [('arrow', crack)])

    def test_unclear_arrows_have_reasons(self):
        """In the report, and in what is said."""
        for style, head, reason in (('head', False, 'alike'), ('taper', True, 'head')):
            with self.subTest(reason):
                layer = Image.new('RGBA', (WIDTH, HEIGHT))
                draw = ImageDraw.Draw(layer)
                draw.line([(18, 20), (68, 45)], fill=(200, 60, 0, 255), width=3)
                if head:
                    draw.polygon([(72, 47), (67, 39), (62, 48)], fill=(200, 60, 0, 255))
                layer.save(self.path('arrows.png'))
                said = self.popup('--arrows', 'arrows.png', '--arrow-style', style, '--levels', 'levels.npy',
                                  '--report', 'report.json')
                problem, = self.report()['problems']
                self.assertEqual((problem['kind'], problem['reason']), ('arrow-unclear', reason))
                self.assertIn(problem['text'], said)

    def test_steps_equal_popup(self):
        """segment, order, expand, smooth and shade, one after the other, with files."""
        self.popup('--relations', RELATIONS, '--labels', 'a.png', '--unexpanded-levels', 'a-order.npy',
                   '--levels', 'a-levels.npy',
                   '--depth', 'a-depth.npy', '--normals', 'a-normals.npy', '--shading', 'a-shading.npy')
        page = ('--drawing', 'drawing.png')
        self.celdepth('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--labels', 'b.png')
        self.celdepth('order', 'b.png', *page, '--relations', RELATIONS, '--unexpanded-levels', 'b-order.npy')
        self.celdepth('expand', 'b-order.npy', *page, '--regions', 'b.png', '--levels', 'b-levels.npy')
        self.celdepth('smooth', 'b-levels.npy', *page, '--scribbles', 'scribbles.png', '--depth', 'b-depth.npy')
        self.celdepth('shade', 'b-levels.npy', *page, '--normals', 'b-normals.npy', '--shading', 'b-shading.npy')
        np.testing.assert_array_equal(self.picture('a.png'), self.picture('b.png'))
        for name in ('order', 'levels', 'depth', 'normals', 'shading'):
            a, b = (np.load(self.path(f'{run}-{name}.npy')) for run in 'ab')
            np.testing.assert_allclose(a, b, atol=1e-4)

    def test_parts_of_one_level(self):
        """Two boxes of one level meet in the middle of their common outline, by steps as by popup."""
        relations = ('--relations', '70,45 > 4,4; 20,20 > 4,4')
        self.popup(*relations, '--labels', 'a.png', '--unexpanded-levels', 'a-order.npy', '--levels', 'a-levels.npy')
        self.celdepth('expand', 'a-order.npy', '--drawing', 'drawing.png', '--regions', 'a.png', '--levels', 'b.npy')
        np.testing.assert_array_equal(np.load(self.path('a-levels.npy')), np.load(self.path('b.npy')))
        self.fails('expand', 'a-order.npy', '--drawing', 'drawing.png', '--regions', 'no.png', '--levels', 'c.npy',
                   naming='no.png')

    def test_order_reads_labels_of_segment(self):
        """order reads the labels that segment wrote."""
        for ending in ('png', 'exr', 'tif'):
            with self.subTest(ending):
                self.celdepth('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--labels', f'l.{ending}',
                              '--report', 's.json')
                self.celdepth('order', f'l.{ending}', '--relations', RELATIONS, '--unexpanded-levels', 'o.npy',
                              '--report', 'o.json')
                levels = np.load(self.path('o.npy'))
                self.assertEqual([at(levels, p) for p in (IN_PAGE, IN_A, IN_B)], [0, 0.5, 1])
                reports = []
                for name in ('s.json', 'o.json'):
                    with open(self.path(name), encoding='utf-8') as file:
                        reports.append(json.load(file))
                areas = [{l['colour']: l['area'] for l in report['labels']} for report in reports]
                self.assertEqual(areas[0], areas[1])

    def test_report(self):
        unfit = '; 20,20 > 22,22; 500,5 > 1,1; #123456 > 1,1 @2.5 !crack'
        self.popup('--relations', RELATIONS + unfit, '--seeds', 'scribbles', '--report', 'report.json')
        with open(self.path('report.json'), encoding='utf-8') as file:
            report = json.load(file)
        self.assertEqual([report[name] for name in ('schema', 'command', 'width', 'height')],
                         [1, 'popup', WIDTH, HEIGHT])
        self.assertEqual({l['colour']: l['level'] for l in report['labels']},
                         {'#0000ff': 2, '#ff0000': 1, '#00a000': 0})
        self.assertEqual(sum(l['area'] for l in report['labels']), WIDTH * HEIGHT)
        self.assertEqual([l['background'] for l in report['labels'] if l['colour'] == '#00a000'], [True])
        self.assertEqual([r.get('left-out') for r in report['relations']],
                         [None, None, 'same-region', 'outside', 'unknown-colour'])
        self.assertEqual(report['relations'][4]['text'], '#123456 > 1,1 @2.5 !crack')
        self.assertEqual((report['relations'][1]['line'], report['relations'][1]['column']), (1, 16))
        self.assertEqual({p['kind'] for p in report['problems']}, {'same-region', 'outside', 'unknown-colour'})
        self.assertEqual((report['levels'], report['cycles']), (3, []))
        self.assertGreater(report['seconds']['labels'], 0)
        self.assertGreater(report['peak-memory'], 1e6)


if __name__ == '__main__':
    unittest.main()
