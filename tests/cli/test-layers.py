#!/usr/bin/python3
"""celdepth layers: the layers composite to the drawing, in each format and for unusual drawings.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import os
import subprocess
import unittest
import unittest.mock
import zipfile

import numpy as np
from PIL import Image, ImageDraw

from pictures import Test
from stacks import composite, decode, encode, lengths_of_psd, picture, premultiplied, read_exr, \
    read_folder, read_open_raster, read_psd

SIZE = WIDTH, HEIGHT = 160, 120
CASES = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../cases')
RED, BLUE, GREEN = '#ff0000', '#0000ff', '#00a000'
ORDER = f'{BLUE} > {RED} > {GREEN}'
# A place of the red disc behind the blue one.
HIDDEN = 85, 60


def smooth(mode, background, paint):
    """A picture drawn four times as large: antialiased."""
    large = Image.new(mode, (4 * WIDTH, 4 * HEIGHT), background)
    paint(ImageDraw.Draw(large), lambda *box: [4 * v for v in box])
    return large.resize(SIZE, Image.BOX)


def discs(colours):
    def paint(draw, scaled):
        for box, fill in zip([(20, 20, 100, 100), (72, 25, 142, 95)], colours):
            draw.ellipse(scaled(*box), fill=fill, outline='black', width=14)
    return paint


class Layers(Test):
    def setUp(self):
        super().setUp()
        smooth('RGB', 'white', discs(['white', 'white'])).save(self.path('drawing.png'))
        smooth('RGB', (255, 240, 200), discs([(220, 90, 80), (90, 120, 230)])).save(self.path('painted.png'))
        scribbles = Image.new('RGBA', SIZE)
        draw = ImageDraw.Draw(scribbles)
        draw.line([(35, 50), (55, 75)], fill=RED, width=4)
        draw.line([(90, 55), (125, 70)], fill=BLUE, width=4)
        draw.line([(4, 4), (150, 5), (154, 112)], fill=GREEN, width=4)
        scribbles.save(self.path('scribbles.png'))

    def layers(self, *words, code=0, drawing='drawing.png'):
        return self.celdepth('layers', drawing, '--scribbles', 'scribbles.png', '--relations', ORDER, *words, code=code)

    def open_raster(self, name, wanted='drawing.png'):
        """The layers by name; they make the picture again."""
        layers, merged = read_open_raster(self.path(name))
        wanted = premultiplied(picture(self.path(wanted)))
        self.assertLessEqual(np.abs(composite([premultiplied(c) for _, c in layers]) - wanted).max(), 1 / 255)
        np.testing.assert_allclose(premultiplied(merged), wanted, atol=1e-6)
        return dict(layers)

    def test_open_raster(self):
        self.layers('--output', 'layers.ora', '--report', 'report.json')
        layers = self.open_raster('layers.ora')
        self.assertEqual(list(layers), [GREEN, RED, BLUE])
        with zipfile.ZipFile(self.path('layers.ora')) as archive:
            first = archive.infolist()[0]
            self.assertEqual((first.filename, first.compress_type), ('mimetype', zipfile.ZIP_STORED))
            self.assertLessEqual(max(picture(archive.open('Thumbnails/thumbnail.png')).shape), 256)
        with open(self.path('layers.ora'), 'rb') as file:
            self.assertEqual(file.read(54)[30:], b'mimetypeimage/openraster')
        with open(self.path('report.json'), encoding='utf-8') as file:
            report = json.load(file)
        self.assertEqual(report['command'], 'layers')
        by_colour = {label['colour']: label for label in report['labels']}
        self.assertEqual([by_colour[c]['layer'] for c in (GREEN, RED, BLUE)], [0, 1, 2])
        for colour, canvas in layers.items():
            x, y, w, h = by_colour[colour]['box']
            self.assertAlmostEqual(canvas[..., 3].sum(), canvas[y:y + h, x:x + w, 3].sum())

    def test_each_region_has_its_ink_antialiased(self):
        self.layers('--output', 'layers.ora')
        layers = self.open_raster('layers.ora')
        blue = layers[BLUE]
        partly = (blue[..., 3] > 0.2) & (blue[..., 3] < 0.8)
        self.assertGreater(partly.sum(), 50)
        self.assertLess(np.median(blue[partly][:, :3]), 0.1)      # ink stays ink
        y, x = np.nonzero(blue[..., 3] == 1)
        self.assertAlmostEqual((x.max() + x.min()) / 2, 106.5, delta=1)
        self.assertAlmostEqual((x.max() - x.min()), 69, delta=2)  # with all of its line

    def test_complete_layers_fill_hidden_parts(self):
        self.layers('--output', 'plain.ora')
        self.layers('--output', 'complete.ora', '--complete', 'yes')
        plain, complete = self.open_raster('plain.ora'), self.open_raster('complete.ora')
        np.testing.assert_array_equal(composite([premultiplied(c) for c in plain.values()]),
                                      composite([premultiplied(c) for c in complete.values()]))
        self.assertEqual(plain[RED][HIDDEN[::-1]][3], 0)
        np.testing.assert_array_equal(complete[RED][HIDDEN[::-1]], [1, 1, 1, 1])
        y, x = np.mgrid[0:HEIGHT, 0:WIDTH] + 0.5
        disc = np.hypot(x - 60, y - 60) < 40
        both = (complete[RED][..., 3] > 0.5) & disc
        either = (complete[RED][..., 3] > 0.5) | disc
        self.assertGreater(both.sum() / either.sum(), 0.97)
        line = np.abs(np.hypot(x - 60, y - 60) - 38.5) < 0.7
        self.assertGreater((complete[RED][line][:, 0] < 0.3).mean(), 0.9)
        self.assertEqual(complete[GREEN][..., 3].min(), 1)

    def test_linear_layers_composite_to_the_drawing(self):
        self.layers('--output', 'layers.ora', '--colours', 'painted.png', '--compositing', 'linear')
        layers, merged = read_open_raster(self.path('layers.ora'))
        made = composite([premultiplied(np.concatenate([decode(c[..., :3]), c[..., 3:]], 2)) for _, c in layers])
        wanted = picture(self.path('painted.png'))
        self.assertLessEqual(np.abs(encode(made[..., :3]) - wanted[..., :3]).max(), 1 / 255)
        np.testing.assert_allclose(merged, wanted, atol=1e-6)
        self.assertIn('encoded', self.layers('--output', 'layers.exr', '--compositing', 'encoded', code=2))
        self.assertIn('encoded or linear', self.layers('--output', 'layers.ora', '--compositing', 'candle', code=2))

    def test_colours(self):
        self.layers('--output', 'layers.ora', '--colours', 'painted.png', '--complete', 'yes')
        layers = self.open_raster('layers.ora', 'painted.png')
        np.testing.assert_allclose(layers[RED][HIDDEN[::-1]], np.array([220, 90, 80, 255]) / 255, atol=2 / 255)

    def test_completed_layers_of_real_drawings(self):
        for case in 'frog', 'people', 'campfire', 'bee':
            folder = os.path.join(CASES, case)
            with Image.open(os.path.join(folder, 'drawing.png')) as image:
                ink = image.convert('L')
            half = ink.width // 2, ink.height // 2
            ink = ink.resize(half, Image.BOX)
            with Image.open(os.path.join(folder, 'scribbles.png')) as image:
                image.convert('RGBA').resize(half, Image.NEAREST).save(self.path('marks.png'))
            with open(os.path.join(folder, 'arrows.txt'), encoding='ascii') as file:
                places = [[float(v) / 2 for v in line.split()[:4]] for line in file if line.strip()]
            relations = ';'.join('{:.1f},{:.1f} > {:.1f},{:.1f}'.format(*place) for place in places)
            # Opaque with smooth colours, and ink and translucent paint on nothing.
            x, y = np.meshgrid(np.linspace(0.3, 1, half[0]), np.linspace(0.4, 1, half[1]))
            line = np.array(ink) / 255
            opaque = np.dstack([line * x, line * y, line * (1.3 - x), np.ones_like(x)])
            clear = np.dstack([line * x, line * y, line * 0, 1 - line * (1 - 0.5 * y)])
            for name, art in ('opaque.png', opaque), ('clear.png', clear):
                Image.fromarray(np.round(255 * art).astype(np.uint8)).save(self.path(name))
                ink.save(self.path('ink.png'))
                self.celdepth('layers', 'ink.png', '--scribbles', 'marks.png', '--relations', relations, '--complete',
                              'yes', '--colours', name, '--output', 'real.ora')
                self.open_raster('real.ora', name)

    def test_transparent_drawing(self):
        ink = smooth('L', 255, discs([255, 255]))
        Image.merge('LA', [Image.new('L', SIZE, 30), Image.eval(ink, lambda v: 255 - v)]).save(self.path('ink.png'))
        for complete in ('no', 'yes'):
            self.layers('--output', complete + '.ora', '--complete', complete, drawing='ink.png')
            self.open_raster(complete + '.ora', 'ink.png')

    def test_exr(self):
        for words in ([], ['--complete', 'yes']):
            self.layers('--output', 'layers.exr', '--colours', 'painted.png', *words)
            layers, info = read_exr(self.path('layers.exr'), WIDTH, HEIGHT)
            self.assertEqual([name for name, _ in layers], [GREEN, RED, BLUE])
            wanted = picture(self.path('painted.png'))
            wanted[..., :3] = decode(wanted[..., :3])
            np.testing.assert_allclose(composite([c for _, c in layers]), wanted, atol=1e-4)
        self.assertIn('pixel data origin: x=72, y=2', info)
        # Our own reader takes the first part.
        self.layers('--output', 'plain.exr', '--colours', 'painted.png')
        self.layers('--output', 'again.ora', '--colours', 'plain.exr')
        page = read_exr(self.path('plain.exr'), WIDTH, HEIGHT)[0][0][1]
        again = read_open_raster(self.path('again.ora'))[1]
        self.assertLess(page[..., 3].mean(), 0.7)
        np.testing.assert_allclose(again[..., 3], page[..., 3], atol=0.51 / 255)
        np.testing.assert_allclose(premultiplied(decode(again)), page, atol=0.01)

    def test_folder(self):
        os.mkdir(self.path('there'))
        for folder in ('new', 'slash/', 'there'):
            self.layers('--output', folder)
            layers = read_folder(self.path(folder))
            self.assertEqual([name for name, _ in layers], ['00-00a000.png', '01-ff0000.png', '02-0000ff.png'])
            self.assertLessEqual(np.abs(composite([premultiplied(c) for _, c in layers])
                                        - picture(self.path('drawing.png'))).max(), 1 / 255)

    def test_folder_is_described(self):
        # A neck and a head behind it, an ear before that; the page; a stone by itself.
        parts = {'#ff0000': (60, 60, 79, 99), '#0000ff': (50, 20, 89, 59), '#ffff00': (90, 30, 99, 39),
                 '#00a000': (120, 90, 139, 99)}
        flats = Image.new('RGBA', SIZE, '#808080')
        art = Image.new('RGB', SIZE, 'white')
        for colour, box in parts.items():
            ImageDraw.Draw(flats).rectangle(box, fill=colour)
            ImageDraw.Draw(art).rectangle(box, fill=colour)
        flats.save(self.path('flats.png'))
        art.save(self.path('art.png'))
        Image.new('L', SIZE, 255).save(self.path('paper.png'))
        self.celdepth('layers', 'paper.png', '--scribbles', 'flats.png', '--flats', '--relations',
                      '#ffff00 > #0000ff; #0000ff > #808080; #ff0000 > #0000ff; #00a000 > #808080',
                      '--colours', 'art.png', '--output', 'parts', '--report', 'report.json')
        with open(self.path('parts/layers.json'), encoding='utf-8') as file:
            made = json.load(file)
        with open(self.path('report.json'), encoding='utf-8') as file:
            labels = {label['colour']: label for label in json.load(file)['labels']}
        self.assertEqual([made[k] for k in ('format', 'version', 'width', 'height')],
                         ['celdepth-layers', 1, WIDTH, HEIGHT])
        layers = {layer['colour']: layer for layer in made['layers']}
        self.assertEqual([layer['file'] for layer in made['layers']],
                         [name for name, _ in read_folder(self.path('parts'))])
        self.assertEqual({c: layer['level'] for c, layer in layers.items()},
                         {'#808080': 0, '#0000ff': 1, '#00a000': 1, '#ffff00': 2, '#ff0000': 2})
        for colour, layer in layers.items():
            self.assertEqual((layer['name'], layer['label']), (colour, labels[colour]['label']))
            self.assertEqual(layer['background'], colour == '#808080')
            canvas = picture(self.path('parts/' + layer['file']))
            y, x = np.nonzero(canvas[..., 3])
            self.assertEqual(layer['box'], [x.min(), y.min(), x.max() - x.min() + 1, y.max() - y.min() + 1])
        head = layers['#0000ff']
        self.assertEqual(head['box'], [50, 20, 40, 40])
        self.assertEqual({c: layer.get('parent') for c, layer in layers.items()},
                         {'#808080': None, '#0000ff': None, '#00a000': None, '#ffff00': head['file'],
                          '#ff0000': head['file']})
        for colour, pivot in (('#ff0000', (70, 60)), ('#ffff00', (90, 35)), ('#0000ff', (70, 40)),
                              ('#00a000', (130, 95))):
            np.testing.assert_allclose(layers[colour]['pivot'], pivot, atol=1e-9)

    @unittest.skipUnless(os.environ.get('PSD') == 'yes', 'built without ImageMagick')
    def test_psd(self):
        smooth('RGBA', (0, 0, 0, 0), discs([(220, 90, 80, 255), (90, 120, 230, 128)])).save(self.path('clear.png'))
        for art, words in (('drawing.png', []), ('painted.png', ['--colours', 'painted.png']),
                           ('clear.png', ['--colours', 'clear.png', '--complete', 'yes'])):
            self.layers('--output', 'layers.psd', *words)
            self.layers('--output', 'layers.ora', *words)
            layers, merged = read_psd(self.path('layers.psd'))
            expected = self.open_raster('layers.ora', art)
            self.assertEqual([name for name, _ in layers], list(expected))
            for name, canvas in layers:
                np.testing.assert_allclose(canvas, premultiplied(expected[name]), atol=1.01 / 255)
            np.testing.assert_allclose(merged, premultiplied(picture(self.path(art))), atol=1.01 / 255)
            # Another reader, OpenImageIO's: the names of layers, and the merged picture.
            info = subprocess.run(['oiiotool', '--info', '-v', '-a', self.path('layers.psd')], check=True,
                                  capture_output=True, text=True).stdout
            self.assertEqual([line.split('"')[1] for line in info.split('\n') if 'oiio:subimagename' in line],
                             list(expected))
            self.layers('--output', 'again.ora', '--colours', 'layers.psd')
            again = read_open_raster(self.path('again.ora'))[1]
            np.testing.assert_allclose(premultiplied(again), premultiplied(picture(self.path(art))), atol=2.01 / 255)

    @unittest.skipUnless(os.environ.get('PSD') == 'yes', 'built without ImageMagick')
    def test_psd_of_any_length_is_consistent(self):
        lengths = []
        for width in range(155, 161):
            for name in 'drawing.png', 'scribbles.png':
                with Image.open(self.path(name)) as whole:
                    whole.crop((0, 0, width, HEIGHT)).save(self.path('cut-' + name))
            self.celdepth('layers', 'cut-drawing.png', '--scribbles', 'cut-scribbles.png', '--output', 'cut.psd')
            section, parts = lengths_of_psd(self.path('cut.psd'))
            self.assertEqual(section, parts)
            lengths.append(section % 2)
        self.assertEqual(lengths, [0] * len(lengths))

    @unittest.skipUnless(os.environ.get('PSD') == 'yes', 'built without ImageMagick')
    def test_psd_beyond_the_limits_of_imagemagick(self):
        """It would end the program."""
        with unittest.mock.patch.dict(os.environ, MAGICK_WIDTH_LIMIT='100'):
            self.fails('layers', 'drawing.png', '--scribbles', 'scribbles.png', '--output', 'layers.psd',
                       naming='allows no more than 100 x')

    @unittest.skipUnless(os.environ.get('PSD') == 'no', 'built with ImageMagick')
    def test_no_psd(self):
        self.fails('layers', 'drawing.png', '--scribbles', 'scribbles.png', '--output', 'layers.psd',
                   naming='ImageMagick')

    def test_same_input_makes_the_same_file(self):
        self.layers('--output', 'one.ora')
        self.layers('--output', 'two.ora')
        with open(self.path('one.ora'), 'rb') as one, open(self.path('two.ora'), 'rb') as two:
            self.assertEqual(one.read(), two.read())

    def test_failures_leave_nothing_behind(self):
        os.mkdir(self.path('full'))
        smooth('L', 255, discs([255, 255])).save(self.path('full/mine.png'))
        words = ['layers', 'drawing.png', '--scribbles', 'scribbles.png', '--output']
        self.fails(*words, 'full', naming='not empty')
        self.assertEqual(os.listdir(self.path('full')), ['mine.png'])
        self.fails(*words, 'nowhere/layers.ora', naming='nowhere')
        self.fails(*words, 'full/mine.png/layers', naming='mine.png')
        self.fails(*words, '/proc/layers.ora', naming='/proc')
        self.fails(*words, '/dev/null', naming='ordinary')
        self.fails('layers', 'drawing.png', '--output', 'layers.ora', naming='scribble')
        self.assertIn('.ora', self.layers('--output', 'layers.xcf', code=2))
        self.assertIn('missing', self.layers(code=2))
        self.fails(*words, 'layers.ora', '--colours', 'full/none.png', naming='none.png')

    def test_one_region(self):
        self.celdepth('layers', 'drawing.png', '--scribbles', 'scribbles.png', '--background', 'none', '--seeds',
                      'scribbles', '--output', 'three.ora')
        self.assertEqual(len(self.open_raster('three.ora')), 3)
        Image.new('RGBA', SIZE, RED).save(self.path('scribbles.png'))
        self.celdepth('layers', 'drawing.png', '--scribbles', 'scribbles.png', '--flats', '--output', 'one.ora')
        self.assertEqual(list(self.open_raster('one.ora')), [RED])

    def test_two_hundred_regions(self):
        flats = Image.new('RGBA', SIZE)
        draw = ImageDraw.Draw(flats)
        for i in range(200):
            x, y = i % 20 * 8, i // 20 * 12
            draw.rectangle([x, y, x + 7, y + 11], fill=(55 + i, 255 - i, (i * 37) % 256, 255))
        flats.save(self.path('scribbles.png'))
        for name in ('many.ora', 'many.exr'):
            self.celdepth('layers', 'drawing.png', '--scribbles', 'scribbles.png', '--flats', '--output', name,
                          '--complete', 'yes')
        self.assertEqual(len(self.open_raster('many.ora')), 200)
        info = subprocess.run(['oiiotool', '--info', '-a', self.path('many.exr')], check=True, capture_output=True,
                              text=True).stdout
        self.assertEqual(info.count('subimage '), 200)

    def test_regions_of_one_colour(self):
        def paint(draw, scaled):
            for box in (20, 20, 70, 100), (90, 20, 140, 100):
                draw.ellipse(scaled(*box), fill='white', outline='black', width=14)

        smooth('L', 255, paint).save(self.path('drawing.png'))
        scribbles = Image.new('RGBA', SIZE)
        draw = ImageDraw.Draw(scribbles)
        draw.line([(35, 50), (55, 75)], fill=RED, width=4)
        draw.line([(112, 55), (125, 70)], fill=RED, width=4)
        draw.line([(4, 4), (150, 5)], fill=GREEN, width=4)
        scribbles.save(self.path('scribbles.png'))
        for name in ('layers.ora', 'layers.exr'):
            self.celdepth('layers', 'drawing.png', '--scribbles', 'scribbles.png', '--same-colour', 'separate',
                          '--relations', '115,60 > 40,55', '--output', name)
        names = list(self.open_raster('layers.ora'))
        self.assertEqual(len(set(names)), 3)
        self.assertEqual(sum(name.startswith(RED) for name in names), 2)

    def test_unusual_names(self):
        self.layers('--output', 'o"dd & <ä> \n.ora')
        self.open_raster('o"dd & <ä> \n.ora')
        names = ['a & b', '<layer name="x"/>', '"quoted" \'too\'', 'ä ö 日本 🙂', '', 'x' * 3000, '../../etc/passwd',
                 '-']
        bad = [b'tab\tand\nline', b'bell \x07 \x1b', b'broken \xff\xfe utf-8']
        program = os.environ['WRITE_STACK']
        subprocess.run([program, self.path('names.ora'), *names, *bad], check=True)
        found = [name for name, _ in read_open_raster(self.path('names.ora'))[0]]
        self.assertEqual(found[:len(names)], names)
        self.assertEqual(found[len(names):], ['tab and line', 'bell    ', 'broken \ufffd\ufffd utf-8'])
        _, pixels = read_open_raster(self.path('names.ora'))[0][0]
        self.assertEqual(np.argwhere(pixels[..., 3]).tolist(), [[1, 19999]])
        subprocess.run([program, self.path('names'), *names, *bad], check=True)
        files = sorted(os.listdir(self.path('names')))
        self.assertEqual(files.pop(), 'layers.json')
        self.assertEqual(len(files), len(names) + len(bad))
        self.assertTrue(all(name.replace('-', '').replace('.', '').isalnum() for name in files))
        with open(self.path('names/layers.json'), encoding='utf-8') as file:
            layers = json.load(file)['layers']
        self.assertEqual([layer['file'] for layer in layers], files)
        self.assertEqual([layer['name'] for layer in layers][:len(names)], names)
        self.assertEqual(layers[0]['box'], [19999, 1, 1, 1])
        self.assertFalse('parent' in layers[0] or 'colour' in layers[0])


if __name__ == '__main__':
    unittest.main()
