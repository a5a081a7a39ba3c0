#!/usr/bin/python3
"""Layered files, unusual pictures, and bad ones: exit code 1, a message that names the cause, nothing written.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import io
import json
import os
import resource
import shutil
import struct
import subprocess
import unittest
import zlib

import numpy as np
from PIL import Image, ImageDraw, ImageOps, TiffImagePlugin

from pictures import (BLUE, COMMAND, GREEN, HEIGHT, IN_A, IN_B, IN_PAGE, RED, RELATIONS, WIDTH, Test, at, drawing, scribbles,
                      write_exr, write_ora, write_psd)


def layers():
    """Drawing and scribbles as layers that are smaller than the page, as editors store them."""
    strokes = scribbles()
    box = strokes.getbbox()
    page = drawing().convert('RGBA').crop((4, 4, WIDTH, HEIGHT))
    return [('Drawing', 4, 4, page), ('scribbles', box[0], box[1], strokes.crop(box))]


class Layers(Test):
    def same_labels(self, *words, reference='labels.npy'):
        self.celdepth('segment', *words, '--labels', 'again.npy')
        np.testing.assert_array_equal(np.load(self.path(reference)), np.load(self.path('again.npy')))

    def setUp(self):
        super().setUp()
        self.celdepth('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--labels', 'labels.npy')

    def test_psd(self):
        write_psd(self.path('page.psd'), (WIDTH, HEIGHT), layers())
        self.same_labels('page.psd')
        self.celdepth('popup', 'page.psd', '--relations', RELATIONS, '--depth', 'a.npy')
        self.popup('--relations', RELATIONS, '--depth', 'b.npy')
        np.testing.assert_allclose(np.load(self.path('a.npy')), np.load(self.path('b.npy')), atol=1e-5)

    def test_faint_strokes(self):
        """A scribble that can be seen and not read is told, with its place; the others are read as without it."""
        strokes = np.array(scribbles())
        strokes[28:33, 10:20] = (0, 120, 250, 38)
        Image.fromarray(strokes).save(self.path('faint.png'))
        text = self.celdepth('segment', 'drawing.png', '--scribbles', 'faint.png', '--labels', 'again.npy', '--report',
                             'report.json')
        np.testing.assert_array_equal(np.load(self.path('labels.npy')), np.load(self.path('again.npy')))
        with open(self.path('report.json')) as f:
            problem, = json.load(f)['problems']
        self.assertEqual((problem['kind'], problem['place']), ('stroke-faint', [10, 28]))
        self.assertIn(problem['text'], text)

    def test_names_in_other_languages(self):
        """Layers are known by the names that editors' plug-ins know, as PSD files have them and as OpenRaster has."""
        for names in (('Zeichnung', 'KRITZELEIEN'), ('Kresba', 'Čmáranice'), ('drawing.png', 'Tahy')):
            stack, entries = '', {}
            page = [(name, *layer[1:]) for name, layer in zip(names, layers())]
            for name, x, y, picture in page:
                data = io.BytesIO()
                picture.save(data, 'PNG')
                entries[f'data/{len(entries)}.png'] = data.getvalue()
                stack = f'<layer name="{name}" x="{x}" y="{y}" src="{list(entries)[-1]}"/>' + stack
            write_psd(self.path('page.psd'), (WIDTH, HEIGHT), page)
            write_ora(self.path('page.ora'), (WIDTH, HEIGHT), f'<stack>{stack}</stack>', entries)
            for file in ('page.psd', 'page.ora'):
                self.same_labels(file)

    def test_arrows_in_other_languages(self):
        arrow = Image.new('RGBA', (WIDTH, HEIGHT))
        ImageDraw.Draw(arrow).line([(70, 50), (24, 30)], fill=RED, width=2)
        ImageDraw.Draw(arrow).line([(31, 27), (24, 30), (29, 37)], fill=RED, width=2)
        for i, name in enumerate(('Arrows', 'Pfeile', 'Šipky')):
            write_psd(self.path('page.psd'), (WIDTH, HEIGHT), [*layers(), (name, 0, 0, arrow)])
            self.celdepth('popup', 'page.psd', '--levels', f'{i}.npy')
            levels = np.load(self.path(f'{i}.npy'))
            self.assertGreater(at(levels, IN_B), at(levels, IN_A), name)

    def test_name_of_two_languages(self):
        """The English name comes first, whatever the order of the layers is."""
        other = ('Kritzeleien', 0, 0, Image.new('RGBA', (5, 5), RED))
        for page in ([layers()[0], other, layers()[1]], [layers()[0], layers()[1], other]):
            write_psd(self.path('page.psd'), (WIDTH, HEIGHT), page)
            self.same_labels('page.psd')

    def test_two_layers_of_a_name(self):
        """The lowest one counts, and a message says so; a copy with a name of its own is none of them."""
        other = ('Scribbles', 0, 0, Image.new('RGBA', (5, 5), RED))
        words = 'segment', 'page.psd', '--labels', 'again.npy'
        says = '"page.psd" has 2 layers for scribbles: "scribbles", "Scribbles". Only the lowest "scribbles" is read'
        for page, said in ((layers() + [other], True), (layers() + [('Scribbles copy', *other[1:])], False)):
            write_psd(self.path('page.psd'), (WIDTH, HEIGHT), page)
            self.assertEqual(says in self.celdepth(*words), said)
            self.same_labels('page.psd', '--quiet')
        write_psd(self.path('page.psd'), (WIDTH, HEIGHT), layers()[:1] + layers())
        self.assertIn('has 2 layers for drawing: "Drawing", "Drawing"', self.celdepth(*words))
        self.assertEqual(self.celdepth(*words, '--quiet'), '')

    def test_option_before_layer(self):
        other = ('scribbles', 0, 0, Image.new('RGBA', (5, 5), RED))
        write_psd(self.path('page.psd'), (WIDTH, HEIGHT), [layers()[0], other])
        self.same_labels('page.psd', '--scribbles', 'scribbles.png')

    def test_missing_layers(self):
        write_psd(self.path('no-drawing.psd'), (WIDTH, HEIGHT), [('Lines', *layers()[0][1:]), layers()[1]])
        self.fails('popup', 'no-drawing.psd', '--depth', 'd.png',
                   naming='no layer named "drawing". Its layers are "Lines", "scribbles"')
        write_psd(self.path('no-scribbles.psd'), (WIDTH, HEIGHT), layers()[:1])
        self.fails('popup', 'no-scribbles.psd', '--depth', 'd.png', naming='no scribbles and no arrows')

    def test_unknown_names(self):
        """What layers there are, which names are looked for, and which one may be meant."""
        strokes = layers()[1][1:]
        says = '"page.psd" has no scribbles and no arrows: call a layer "scribbles" or "arrows", or give --scribbles or ' \
               '--arrows. Its layers are '
        words = 'popup', 'page.psd', '--depth', 'd.png'
        for name, names in (('Colours', '"Drawing", "Colours".'), ('Scribles', '"Drawing", "Scribles" (is it "scribbles"?).'),
                            ('Pfeille', '"Drawing", "Pfeille" (is it "pfeile"?).')):
            write_psd(self.path('page.psd'), (WIDTH, HEIGHT), [layers()[0], (name, *strokes)])
            self.fails(*words, naming=says + names)
        self.celdepth(*words, '--scribbles', 'scribbles.png')
        for name, meant in (('Corections', True), ('Colours', False), ('Scribbles copy', False)):
            write_psd(self.path('page.psd'), (WIDTH, HEIGHT), [*layers(), (name, *strokes)])
            self.assertEqual('"page.psd" has a layer "Corections", which is not read: call it "corrections" if it is that.'
                             in self.celdepth(*words), meant)
            self.assertEqual(self.celdepth(*words, '--quiet'), '')

    def test_layers_with_other_names(self):
        """A PSD with other layers is an ordinary picture: its merged one (white here)."""
        write_psd(self.path('plain.psd'), (WIDTH, HEIGHT), [('Layer 1', *layers()[0][1:])])
        self.fails('segment', 'plain.psd', '--scribbles', 'scribbles.png', '--labels', 'l.png',
                   naming='"plain.psd" has no lines')

    def test_exr_parts(self):
        """Linear light and premultiplied alpha."""
        drawing().convert('RGB').save(self.path('drawing.png'))
        parts = []
        for name, channels in (('drawing', 'R,G,B,A=1.0'), ('scribbles', 'R,G,B,A')):
            parts += [self.path(f'{name}.png'), '--ch', channels, '--colorconvert', 'sRGB', 'linear', '-d', 'float',
                      '--attrib', 'oiio:subimagename', name]
        subprocess.run(['oiiotool', *parts, '--siappendall', '-o', self.path('page.exr')], check=True)
        self.same_labels('page.exr')

    def test_jpeg(self):
        """Thin scribbles in a JPEG whose chroma has half the size: the colours that were painted, each in its place."""
        colours = [(200, 30, 40), (30, 60, 200), (20, 130, 50), (230, 180, 50), (180, 90, 200), (20, 20, 24)]
        page = Image.new('L', (300, 300), 255)
        for y in range(46, 250, 45):
            ImageDraw.Draw(page).line([(0, y), (299, y + 18)], fill=0, width=3)
        page.save(self.path('page.png'))
        layer = Image.new('RGB', (300, 300), 'white')
        for i, colour in enumerate(colours):
            ImageDraw.Draw(layer).line([(20, 25 + 45 * i), (280, 40 + 45 * i)], fill=colour, width=3)
        for quality in (75, 90):
            layer.save(self.path('scribbles.jpg'), quality=quality, subsampling='4:2:0')
            self.celdepth('segment', 'page.png', '--scribbles', 'scribbles.jpg', '--labels', 'regions.png')
            found = self.picture('regions.png')
            self.assertEqual(len(np.unique(found.reshape(-1, 4), axis=0)), len(colours))
            for i, colour in enumerate(colours):
                away = np.linalg.norm(found[32 + 45 * i, 150, :3].astype(float) - colour)
                self.assertLess(away, 40, f'{colour} at quality {quality}')

    def test_broad_scribbles_in_jpeg(self):
        """Broad strokes keep their colours in a JPEG of high quality; only the paper round them shows that it is one."""
        page = Image.new('L', (720, 540), 255)
        ImageDraw.Draw(page).rectangle([240, 80, 480, 460], outline=0, width=4)
        page.save(self.path('page.png'))
        layer = Image.new('RGB', (720, 540), 'white')
        for line, colour in (([(150, 180), (221, 331)], (255, 0, 0)), ([(320, 331), (420, 401)], (0, 0, 255)),
                             ([(30, 41), (690, 41)], (0, 255, 0))):
            ImageDraw.Draw(layer).line(line, fill=colour, width=18)
        for quality in (90, 95):
            layer.save(self.path('scribbles.jpg'), quality=quality)
            self.celdepth('segment', 'page.png', '--scribbles', 'scribbles.jpg', '--report', 'report.json')
            with open(self.path('report.json')) as file:
                self.assertEqual(len(json.load(file)['labels']), 3, f'quality {quality}')

    def test_unknown_colours(self):
        """A colour that no region has is named, with the nearest: those of a JPEG are not those that were painted."""
        words = 'segment', 'drawing.png', '--scribbles', 'scribbles.png', '--labels', 'again.npy'
        near = '#%02x%02x%02x' % (RED[0], RED[1] + 3, RED[2])
        nearest = 'The nearest colour is #%02x%02x%02x.' % RED[:3]
        self.assertIn(nearest, self.celdepth(*words, '--background', 'colour', '--background-colour', near))
        self.assertIn(nearest, self.celdepth('popup', *words[1:4], '--relations', f'{near} > 1,1', '--levels', 'l.npy'))

    def test_turned_photographs(self):
        """A picture of a turned camera, with scribbles as an editor shows them: upright."""
        turns = [Image.Transpose.FLIP_LEFT_RIGHT, Image.Transpose.ROTATE_180, Image.Transpose.FLIP_TOP_BOTTOM,
                 Image.Transpose.TRANSPOSE, Image.Transpose.ROTATE_90, Image.Transpose.TRANSVERSE,
                 Image.Transpose.ROTATE_270]
        page = drawing().convert('RGB')
        for orientation, turn in enumerate(turns, 2):
            noted = Image.Exif()
            noted[274] = orientation
            page.transpose(turn).save(self.path('page.tif'), tiffinfo={274: orientation})
            page.transpose(turn).save(self.path('page.png'), exif=noted)
            page.transpose(turn).save(self.path('page.webp'), exif=noted, lossless=True)
            for name in ('page.tif', 'page.png', 'page.webp')[:3 if orientation == 6 else 1]:
                shown = Image.open(self.path(name))
                if name != 'page.tif':  # Pillow turns those alone by itself
                    shown = ImageOps.exif_transpose(shown)
                self.assertEqual(shown.convert('RGB').tobytes(), page.tobytes(), f'{name}, orientation {orientation}')
                with self.subTest(name, orientation=orientation):
                    self.same_labels(name, '--scribbles', 'scribbles.png')

    def test_open_raster(self):
        """Layers in a stack of their own, hidden and half transparent, as artists keep their scribbles."""
        pages = {f'data/{name}.png': io.BytesIO() for name in ('drawing', 'scribbles')}
        drawing().save(pages['data/drawing.png'], 'PNG')
        box = scribbles().getbbox()
        scribbles().crop(box).save(pages['data/scribbles.png'], 'PNG')
        write_ora(self.path('page.ora'), (WIDTH, HEIGHT),
                  f'<stack><stack name="depth" visibility="hidden"><layer name="Scribbles" visibility="hidden" '
                  f'opacity="0.4" x="{box[0]}" y="{box[1]}" src="data/scribbles.png"/></stack><layer name="drawing" '
                  'src="data/drawing.png"/></stack>', {name: data.getvalue() for name, data in pages.items()})
        self.same_labels('page.ora')

    def test_krita(self):
        """What Krita saves, in its own format and as OpenRaster, and what MyPaint saves: the same regions, in the same
        colours."""
        self.celdepth('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--labels', 'wanted.png')
        saved = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'io', 'layered')
        for name in ('krita.kra', 'krita.ora', 'mypaint.ora'):
            shutil.copy(os.path.join(saved, name), self.folder)
            self.celdepth('segment', name, '--labels', 'found.png')
            np.testing.assert_array_equal(self.picture('found.png'), self.picture('wanted.png'), name)

    def test_merged_picture(self):
        """Where no layer has a known name, the merged picture is the drawing."""
        page = io.BytesIO()
        drawing().save(page, 'PNG')
        write_ora(self.path('page.ora'), (WIDTH, HEIGHT), '<stack><layer name="Ink" src="data/0.png"/></stack>',
                  {'data/0.png': b'', 'mergedimage.png': page.getvalue()})
        self.same_labels('page.ora', '--scribbles', 'scribbles.png')

    def test_tiff_pages(self):
        page_name = 285
        with TiffImagePlugin.AppendingTiffWriter(self.path('page.tif'), True) as file:
            for name, layer in (('scribbles', scribbles()), ('DRAWING', drawing())):
                layer.save(file, 'TIFF', tiffinfo={page_name: name})
                file.newFrame()
        self.same_labels('page.tif')
        self.assertEqual(self.celdepth('segment', 'page.tif', '--labels', 'again.npy'), '')

    def test_frames(self):
        """Of an animation, or of pages without names of layers, the first is read, and a message says so."""
        page, other, strokes = drawing().convert('RGB'), Image.new('RGB', (WIDTH, HEIGHT), 'red'), scribbles()
        words = '--labels', 'again.npy'
        for ending in ('gif', 'png', 'webp', 'tif'):
            page.save(self.path(f'one.{ending}'), lossless=True)
            page.save(self.path(f'all.{ending}'), save_all=True, append_images=[other], lossless=True)
            with self.subTest(ending):
                self.assertEqual(self.celdepth('segment', f'one.{ending}', '--scribbles', 'scribbles.png', *words), '')
                self.assertEqual(
                    self.celdepth('segment', f'all.{ending}', '--scribbles', 'scribbles.png', *words),
                    f'celdepth: "all.{ending}" has several frames or pages, of which only the first is read: save the one '
                    'that you mean as a picture of its own.\n')
        self.same_labels('all.tif', '--scribbles', 'scribbles.png', '--quiet')
        strokes.save(self.path('strokes.png'), save_all=True, append_images=[strokes])
        self.assertIn('"strokes.png" has several frames', self.celdepth('segment', 'drawing.png', '--scribbles',
                                                                       'strokes.png', *words))
        page.save(self.path('small.tif'), save_all=True, append_images=[page.resize((9, 6))])  # as a thumbnail
        self.assertEqual(self.celdepth('segment', 'small.tif', '--scribbles', 'scribbles.png', *words), '')

    def test_drawing_option(self):
        """The steps also read the drawing of a layered file."""
        write_psd(self.path('page.psd'), (WIDTH, HEIGHT), layers())
        np.save(self.path('levels.npy'), np.load(self.path('labels.npy')))
        self.celdepth('expand', 'levels.npy', '--drawing', 'page.psd', '--levels', 'a.npy')
        self.celdepth('expand', 'levels.npy', '--drawing', 'drawing.png', '--levels', 'b.npy')
        np.testing.assert_array_equal(np.load(self.path('a.npy')), np.load(self.path('b.npy')))


class Strokes(Test):
    """Painted arrows and virtual contours."""

    def layer(self, name, *strokes):
        """Strokes: (colour, points)."""
        layer = Image.new('RGBA', (WIDTH, HEIGHT))
        for colour, points in strokes:
            ImageDraw.Draw(layer).line(points, fill=colour, width=2)
        layer.save(self.path(name))

    def arrow(self):
        """From box B up to the page: its head points at the farther part."""
        orange = (255, 128, 0, 255)
        self.layer('arrows.png', (orange, [(70, 40), (70, 18)]), (orange, [(64, 24), (70, 18), (76, 24)]))

    def test_arrows_are_relations(self):
        self.arrow()
        self.popup('--arrows', 'arrows.png', '--levels', 'l.npy', '--report', 'r.json')
        with open(self.path('r.json'), encoding='utf-8') as file:
            relation, = json.load(file)['relations']
        self.assertEqual(relation['source'], 'arrow')
        levels = np.load(self.path('l.npy'))
        self.assertGreater(levels[45, 70], levels[18, 75])

    def test_blank_scribbles_beside_arrows(self):
        self.arrow()
        Image.new('RGB', (WIDTH, HEIGHT), 'white').save(self.path('blank.png'))
        words = 'popup', 'drawing.png', '--arrows', 'arrows.png', '--levels', 'l.npy', '--scribbles'
        self.assertIn('The scribbles "blank.png" are blank, so that only parts with arrows are regions',
                      self.celdepth(*words, 'blank.png'))
        self.assertNotIn('blank', self.celdepth(*words, 'blank.png', '--quiet'))
        self.assertNotIn('blank', self.celdepth(*words, 'scribbles.png'))

    def test_text_path_and_paint_together(self):
        self.arrow()
        self.popup('--arrows', 'arrows.png', '--relations', '20,20 > 1,1', '--arrow-path', 'M70,45 L 20,20',
                   '--levels', 'l.npy', '--report', 'r.json')
        with open(self.path('r.json'), encoding='utf-8') as file:
            relations = json.load(file)['relations']
        self.assertEqual([r['source'] for r in relations], ['text', 'path', 'arrow'])
        self.assertEqual((relations[1]['text'], relations[1]['column']), ('70,45 > 20,20', 1))
        levels = np.load(self.path('l.npy'))
        self.assertGreater(levels[45, 70], levels[20, 20])

    def test_arrows_alone(self):
        self.arrow()
        self.celdepth('popup', 'drawing.png', '--arrows', 'arrows.png', '--levels', 'l.npy')
        levels = np.load(self.path('l.npy'))
        self.assertGreater(levels[45, 70], levels[18, 75])

    def test_contours(self):
        """A red stroke divides box B into two regions."""
        page = scribbles()
        ImageDraw.Draw(page).line([(78, 30), (80, 53)], fill=(255, 0, 255, 255), width=3)
        page.save(self.path('scribbles.png'))
        self.layer('contours.png', ((255, 0, 0, 255), [(60, 24), (60, 58)]))
        self.layer('blank.png')
        ends = []
        for name in ('contours.png', 'blank.png'):
            self.popup('--contours', name, '--labels', 'l.png')
            ends.append((self.picture('l.png')[29:54, 42:83, :3] == (255, 0, 255)).all(2).sum(1).mean())
        self.assertAlmostEqual(ends[0], 83 - 60, delta=2)
        self.assertGreater(abs(ends[1] - ends[0]), 3)

    def test_contours_in_vain(self):
        """Those in another colour, and green ones on paper."""
        says = 'The contours "contours.png" change nothing: draw them in red or blue, or in green over ink.'
        words = 'segment', 'drawing.png', '--scribbles', 'scribbles.png', '--contours', 'contours.png', '--labels', 'l.png'
        for colour, line, vain in (((0, 0, 0), [(60, 24), (60, 58)], True), ((255, 220, 0), [(60, 24), (60, 58)], True),
                                   (RED, [(70, 36), (70, 50)], False), (GREEN, [(70, 36), (70, 50)], True),
                                   (GREEN, [(60, 24), (60, 58)], False), (BLUE, [(70, 36), (70, 50)], False)):
            self.layer('contours.png', (colour + (255,), line))
            self.assertEqual(says in self.celdepth(*words), vain, colour)
            self.assertNotIn(says, self.celdepth(*words, '--quiet'))
        for mode, colour in (('RGBA', (0, 0, 0, 0)), ('L', 255), ('L', 0)):
            Image.new(mode, (WIDTH, HEIGHT), colour).save(self.path('contours.png'))
            self.assertNotIn('contours', self.celdepth(*words))


class Drawings(Test):
    """The same drawing in other formats has the same regions."""

    def same_labels(self, name, *words):
        self.celdepth('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--labels', 'labels.npy')
        self.celdepth('segment', name, '--scribbles', 'scribbles.png', '--labels', 'again.npy', *words)
        different = np.load(self.path('labels.npy')) != np.load(self.path('again.npy'))
        self.assertEqual(different.sum(), 0)

    def test_16_bit(self):
        Image.fromarray(np.array(drawing(), np.uint16) * 257).save(self.path('deep.png'))
        self.same_labels('deep.png')

    def test_float_with_nan(self):
        values = np.array(drawing(), np.float32) / 255
        values[2, 2] = np.nan
        Image.fromarray(values).save(self.path('float.tif'))
        self.same_labels('float.tif')

    def test_ink_in_alpha(self):
        ink = Image.new('RGBA', (WIDTH, HEIGHT))
        ink.putalpha(ImageOps.invert(drawing()))
        ink.save(self.path('ink.png'))
        self.same_labels('ink.png')
        self.same_labels('ink.png', '--ink', 'alpha')

    def test_chalk(self):
        ImageOps.invert(drawing()).save(self.path('chalk.png'))
        self.same_labels('chalk.png', '--ink', 'light')

    def test_coloured(self):
        """One coloured picture is drawing and art."""
        page = drawing().convert('RGB')
        for place, colour in ((IN_A, (250, 190, 60)), (IN_B, (90, 160, 70)), (IN_PAGE, (200, 225, 250))):
            ImageDraw.floodfill(page, place, colour)
        page.save(self.path('page.png'))
        self.same_labels('page.png')
        self.same_labels('page.png', '--ink', 'lines')
        page.convert('L').save(self.path('grey.png'))
        self.same_labels('grey.png', '--ink', 'lines')
        self.celdepth('popup', 'page.png', '--scribbles', 'scribbles.png', '--relations', RELATIONS, '--levels', 'l.npy')
        self.celdepth('shade', 'l.npy', '--drawing', 'page.png', '--shaded', 'lit.png')
        np.testing.assert_allclose(self.picture('lit.png')[IN_PAGE[::-1]][:3].astype(int), (200, 225, 250), atol=1)

    def test_flat_colours_are_regions(self):
        """A coloured drawing needs no scribbles: its fills are the regions, its lines none."""
        fills = {IN_A: (250, 190, 60), IN_B: (90, 160, 70), IN_PAGE: (200, 225, 250)}
        page = drawing().convert('RGB')
        for place, colour in fills.items():
            ImageDraw.floodfill(page, place, colour)
        page.save(self.path('page.png'))
        self.celdepth('popup', 'page.png', '--flats', '--relations', RELATIONS, '--labels', 'f.png', '--levels', 'l.npy')
        labels = self.picture('f.png')[..., :3]
        self.assertEqual({tuple(colour) for colour in labels.reshape(-1, 3)}, set(fills.values()))
        given, line = np.array(page), np.array(drawing()) < 255
        np.testing.assert_array_equal(labels[~line], given[~line])
        levels = np.load(self.path('l.npy'))
        self.assertGreater(levels[IN_B[::-1]], levels[IN_A[::-1]])
        self.celdepth('segment', 'page.png', '--scribbles', 'scribbles.png', '--flats', '--labels', 'given.npy')
        self.celdepth('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--flats', '--labels', 'lines.npy')
        np.testing.assert_array_equal(np.load(self.path('given.npy')), np.load(self.path('lines.npy')))

    def test_palette(self):
        drawing().convert('RGB').quantize(4).save(self.path('palette.png'))
        self.same_labels('palette.png')

    def test_web(self):
        """As chats and web pages store pictures."""
        drawing().convert('RGB').save(self.path('page.webp'), lossless=True)
        self.same_labels('page.webp')
        drawing().convert('RGB').save(self.path('page.gif'))
        self.same_labels('page.gif')
        scribbles().save(self.path('strokes.webp'), lossless=True)
        self.celdepth('segment', 'drawing.png', '--scribbles', 'strokes.webp', '--labels', 'l.png')
        self.assertEqual(tuple(at(self.picture('l.png'), IN_A)), RED + (255,))

    def test_odd_names(self):
        """Names that begin with a dash follow "--"; spaces, line breaks, question marks and bytes that are no UTF-8
        may be in names."""
        for name in ('-page.png', 'two words\n.png', os.fsdecode(b'page\xff.png'), 'who?.png', 'who?x=1.gif', '?.psd'):
            if name.endswith('psd'):
                write_psd(self.path(name), (WIDTH, HEIGHT), layers()[:1])
            else:
                drawing().save(self.path(name))
            words = '--scribbles', 'scribbles.png', '--labels', 'l.png', '--', name
            self.celdepth('segment', *words)
        self.celdepth('segment', *words[:3], 'l?.exr', '--', name)
        os.rename(self.path('l?.exr'), self.path('l.exr'))
        self.assertEqual(self.channel('l.exr', 'A').min(), 1)
        self.assertIn('The drawing is missing.', self.celdepth('segment', *words[:-1], code=2))

    def test_one_pixel_wide(self):
        Image.new('L', (1, 8), 255).save(self.path('line.png'))
        Image.new('RGBA', (1, 8), RED + (255,)).save(self.path('red.png'))
        self.celdepth('popup', 'line.png', '--scribbles', 'red.png', '--flats', '--labels', 'l.png', '--depth', 'd.npy',
                      '--normals', 'n.png')
        self.assertEqual(tuple(self.picture('l.png')[0, 0]), RED + (255,))


class Nonsense(Test):
    """Input that is something else than it was given for."""

    def test_blank_pages(self):
        for name, mode, colour in (('white', 'L', 255), ('black', 'L', 0), ('blue', 'RGB', (90, 120, 200)),
                                   ('clear', 'RGBA', (0, 0, 0, 0))):
            Image.new(mode, (WIDTH, HEIGHT), colour).save(self.path(f'{name}.png'))
            for command, *words in (('popup', '--depth', 'd.png'), ('layers', '--output', 'l.ora'),
                                    ('stereo', '--joined', 's.png')):
                self.fails(command, f'{name}.png', '--scribbles', 'scribbles.png', *words, naming='has no lines')
        noise = np.random.default_rng(1).normal(250, 1.5, (HEIGHT, WIDTH)).clip(0, 255)
        Image.fromarray(noise.astype(np.uint8)).save(self.path('scan.png'))
        self.fails('popup', 'scan.png', '--scribbles', 'scribbles.png', '--depth', 'd.png', naming='has no lines')

    def test_blank_pages_of_single_steps(self):
        self.popup('--labels', 'labels.png', '--levels', 'levels.npy', '--relations', RELATIONS)
        Image.new('L', (WIDTH, HEIGHT), 255).save(self.path('white.png'))
        for command, *words in (('expand', 'levels.npy', '--levels', 'l.png'), ('smooth', 'levels.npy', '--depth', 'd.png'),
                                ('shade', 'levels.npy', '--shading', 's.png'), ('relief', 'levels.npy', '--mesh', 'm.glb'),
                                ('order', 'labels.png', '--unexpanded-levels', 'u.npy')):
            self.fails(command, *words, '--drawing', 'white.png', naming='"white.png" has no lines')
        self.fails('inbetween', 'drawing.png', 'white.png', '--scribbles', 'scribbles.png', '--output', 'b.png',
                   naming='"white.png" has no lines')

    def test_numbers_as_regions(self):
        """Regions as segment writes them to numpy files are those of a picture; other numbers are refused."""
        self.popup('--labels', 'labels.npy', '--unexpanded-levels', 'whole.npy', '--relations', RELATIONS)
        self.popup('--labels', 'labels.png', '--levels', 'levels.npy', '--relations', RELATIONS)
        for kind in ('png', 'npy'):
            self.celdepth('order', f'labels.{kind}', '--relations', RELATIONS, '--drawing', 'drawing.png',
                          '--unexpanded-levels', f'order-{kind}.npy')
            self.celdepth('expand', 'whole.npy', '--regions', f'labels.{kind}', '--drawing', 'drawing.png', '--levels',
                          f'expand-{kind}.npy')
        for step in ('order', 'expand'):
            np.testing.assert_array_equal(np.load(self.path(f'{step}-png.npy')), np.load(self.path(f'{step}-npy.npy')))
        for value in (-1, 0.5, 1e9):
            numbers = np.load(self.path('labels.npy'))
            numbers[3, 3] = value
            np.save(self.path('wrong.npy'), numbers)
            self.fails('order', 'wrong.npy', '--unexpanded-levels', 'u.npy', naming='"wrong.npy" has the value')
        np.save(self.path('small.npy'), np.ones((5, 5), np.float32))
        self.fails('expand', 'whole.npy', '--regions', 'small.npy', '--drawing', 'drawing.png', '--levels', 'l.npy',
                   naming='"small.npy" has 5 x 5 pixels')
        self.fails('popup', 'drawing.png', '--scribbles', 'labels.npy', '--depth', 'd.png',
                   naming='"labels.npy" has numbers without colours')

    def test_lines_by_contours_alone(self):
        """A blank page with painted boundaries is a drawing."""
        contours = Image.new('RGBA', (WIDTH, HEIGHT))
        ImageDraw.Draw(contours).rectangle([30, 15, 85, 57], outline=RED + (255,), width=3)
        contours.save(self.path('contours.png'))
        Image.new('L', (WIDTH, HEIGHT), 255).save(self.path('white.png'))
        self.celdepth('segment', 'white.png', '--scribbles', 'scribbles.png', '--contours', 'contours.png', '--labels',
                      'l.png')

    def test_exchanged(self):
        self.fails('popup', 'scribbles.png', '--scribbles', 'drawing.png', '--depth', 'd.png', naming='exchange them')
        on_white = Image.new('RGB', (WIDTH, HEIGHT), 'white')
        on_white.paste(scribbles(), mask=scribbles())
        on_white.save(self.path('white-scribbles.png'))
        drawing().convert('RGBA').save(self.path('other.png'))
        self.fails('popup', 'white-scribbles.png', '--scribbles', 'other.png', '--depth', 'd.png', naming='exchange them')
        coloured = Image.new('RGB', (WIDTH, HEIGHT), (220, 235, 255))
        for box, fill in ([30, 15, 85, 57], (250, 230, 120)), ([60, 25, 100, 50], (170, 220, 150)):
            ImageDraw.Draw(coloured).rectangle(box, fill=fill, outline=(60, 30, 20), width=2)
        coloured.save(self.path('coloured.png'))
        self.fails('popup', 'scribbles.png', '--scribbles', 'coloured.png', '--depth', 'd.png', naming='exchange them')
        self.celdepth('segment', 'coloured.png', '--scribbles', 'scribbles.png', '--labels', 'l.png')
        grey = Image.new('RGBA', (WIDTH, HEIGHT))
        ImageDraw.Draw(grey).line([(16, 20), (32, 22)], fill=(90, 90, 90, 255), width=3)
        grey.save(self.path('grey.png'))
        self.celdepth('segment', 'drawing.png', '--scribbles', 'grey.png', '--labels', 'l.png')

    def test_copy_of_the_drawing(self):
        drawing().convert('RGBA').save(self.path('copy.png'))
        self.fails('popup', 'drawing.png', '--scribbles', 'copy.png', '--depth', 'd.png',
                   naming='"copy.png" is the same picture as the drawing "drawing.png"')

    def test_another_drawing_as_scribbles(self):
        """Such as that of the next frame, which has none of this drawing's lines; black scribbles are none."""
        other, strokes = Image.new('L', (WIDTH, HEIGHT), 255), Image.new('L', (WIDTH, HEIGHT), 255)
        for x in range(4, WIDTH, 24):
            for y in (4, 34):
                ImageDraw.Draw(other).rectangle([x, y, x + 18, y + 24], outline=0, width=2)
                ImageDraw.Draw(strokes).line([(x, y), (x + 18, y + 14)], fill=0, width=3)
        other.save(self.path('other.png'))
        strokes.save(self.path('strokes.png'))
        for command, *words in (('popup', '--depth', 'd.png'), ('layers', '--output', 'l.ora')):
            self.fails(command, 'drawing.png', '--scribbles', 'other.png', *words,
                       naming='"other.png" looks like a drawing: scribbles are strokes in clear colours')
        self.celdepth('segment', 'drawing.png', '--scribbles', 'strokes.png', '--labels', 'l.png')

    def test_scribbles_as_drawing(self):
        """A flattened copy of the layer, also stored with loss."""
        on_white = Image.new('RGB', (WIDTH, HEIGHT), 'white')
        on_white.paste(scribbles(), mask=scribbles())
        on_white.save(self.path('white.png'))
        on_white.save(self.path('white.jpg'), quality=95)
        for name in ('white.png', 'white.jpg'):
            self.fails('popup', name, '--scribbles', 'scribbles.png', '--depth', 'd.png',
                       naming=f'"{name}" has the strokes of the scribbles "scribbles.png", and no lines')

    def test_one_file_twice(self):
        twice = ['--scribbles', 'scribbles.png', '--arrows', os.path.join('.', 'scribbles.png')]
        self.fails('popup', 'drawing.png', *twice, '--depth', 'd.png', naming='given as --scribbles and as --arrows')
        self.fails('popup', 'drawing.png', '--scribbles', 'drawing.png', '--depth', 'd.png',
                   naming='given as the drawing and as --scribbles')
        self.popup('--levels', 'levels.png', '--relations', RELATIONS)
        self.fails('shade', 'levels.png', '--drawing', 'levels.png', '--shading', 's.png',
                   naming='given as the drawing and as the levels')
        self.celdepth('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--labels', 'flat.png')
        self.fails('order', 'flat.png', '--arrows', 'flat.png', '--unexpanded-levels', 'u.npy',
                   naming='given as the regions and as --arrows')
        for option in ('--hints', '--matcap'):
            self.fails('shade', 'levels.png', '--drawing', 'drawing.png', option, 'drawing.png', '--shading', 's.png',
                       naming=f'"drawing.png" is given as the drawing and as {option}')
        self.fails('deform', 'drawing.png', '--scribbles', 'scribbles.png', '--handles-layer', 'scribbles.png', '--output',
                   'd.png', naming='given as --scribbles and as --handles-layer')
        for command, *words in (('register', '--warped', 'w.png'), ('inbetween', '--output', 'b.png')):
            self.fails(command, 'drawing.png', 'scribbles.png', '--scribbles', 'scribbles.png', *words,
                       naming='given as --scribbles and as the second drawing')
            self.celdepth(command, 'drawing.png', 'drawing.png', '--scribbles', 'scribbles.png', *words)
        write_psd(self.path('page.psd'), (WIDTH, HEIGHT), layers())
        self.celdepth('segment', 'page.psd', '--scribbles', 'page.psd', '--labels', 'l.png')

    def test_one_sentence(self):
        """What is refused is not also warned about."""
        np.save(self.path('flat.npy'), np.full((HEIGHT, WIDTH), 2, np.float32))
        Image.new('L', (WIDTH, HEIGHT), 255).save(self.path('white.png'))
        for command, *words in (('shade', '--shading', 's.png'), ('smooth', '--depth', 'd.png')):
            self.assertEqual(self.celdepth(command, 'flat.npy', '--drawing', 'white.png', *words, code=1).count('\n'), 1)
            self.assertIn('everywhere', self.celdepth(command, 'flat.npy', '--drawing', 'drawing.png', *words))
        strokes = Image.new('RGBA', (WIDTH, HEIGHT))
        for y in range(6, 60, 12):
            ImageDraw.Draw(strokes).line([(8, y), (80, y + 4)], fill=RED + (255,), width=2)
        strokes.save(self.path('strokes.png'))
        said = self.celdepth('deform', 'drawing.png', '--scribbles', 'scribbles.png', '--handles-layer', 'strokes.png',
                             '--output', 'o.png', code=1)
        self.assertEqual((said.count('\n'), said[:54]), (1, 'celdepth: "strokes.png" has no handle that can be read'))

    def test_levels_as_a_drawing_or_strokes(self):
        """Levels and depth, in grey on black; with --ink they are believed to be a drawing."""
        self.popup('--relations', RELATIONS, '--levels', 'levels.png', '--depth', 'depth.png', '--labels', 'labels.png')
        self.popup('--relations', RELATIONS, '--levels', 'levels.npy')
        for name in ('levels.png', 'depth.png'):
            says = f'"{name}" looks like levels or depth: '
            for words in (('popup', name, '--scribbles', 'scribbles.png', '--depth', 'd.png'),
                          ('register', 'drawing.png', name, '--warped', 'w.png'),
                          ('order', 'labels.png', '--drawing', name, '--unexpanded-levels', 'u.png'),
                          ('shade', 'levels.npy', '--drawing', name, '--shading', 's.png'),
                          ('smooth', 'levels.npy', '--drawing', name, '--depth', 'd.png')):
                self.fails(*words, naming=says + 'give the line drawing')
            self.fails('popup', 'drawing.png', '--scribbles', name, '--depth', 'd.png',
                       naming=says + 'scribbles are strokes in clear colours')
            self.fails('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--arrows', name, '--labels', 'l.png',
                       naming=f'"{name}" is painted all over, as regions and levels are: what is given with --arrows')
        self.assertNotIn('levels', self.celdepth('segment', 'levels.png', '--scribbles', 'scribbles.png', '--labels', 'l.png',
                                                 '--ink', 'dark'))

    def test_regions_as_a_drawing_or_strokes(self):
        """As a drawing they may be art without outlines; as strokes they have no blank page, but what is hidden may be
        large."""
        self.celdepth('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--labels', 'labels.png')
        words = 'segment', 'labels.png', '--scribbles', 'scribbles.png', '--labels', 'l.png'
        self.assertIn('"labels.png" has flat colours without lines between them', self.celdepth(*words))
        for more in (('--quiet',), ('--ink', 'lines'), ('--flats',)):
            self.assertNotIn('without lines', self.celdepth(*words, *more))
        of_drawing = 'layers', 'drawing.png', '--scribbles', 'scribbles.png', '--output', 'l.ora'
        for option in ('arrows', 'contours', 'corrections'):
            self.fails(*of_drawing, f'--{option}', 'labels.png',
                       naming=f'"labels.png" is painted all over, as regions and levels are: what is given with --{option}')
        self.celdepth(*of_drawing, '--hidden', 'labels.png', '--complete', 'yes')
        self.celdepth('segment', 'drawing.png', '--scribbles', 'labels.png', '--labels', 'l.png')

    def test_drawing_of_another_page(self):
        """Levels and regions end at the lines of their own drawing, or where its colours change."""
        self.popup('--relations', RELATIONS, '--levels', 'levels.png', '--labels', 'labels.png')
        other = Image.new('L', (WIDTH, HEIGHT), 255)
        ImageDraw.Draw(other).rectangle([22, 17, 34, 38], outline=0, width=2)
        ImageDraw.Draw(other).ellipse([52, 34, 74, 50], outline=0, width=2)
        other.save(self.path('other.png'))
        Image.new('L', (WIDTH, HEIGHT), 255).save(self.path('white.png'))
        for command, name, *words in (('shade', 'levels.png', '--shading', 's.png'), ('smooth', 'levels.png', '--depth', 'd.png'),
                                      ('relief', 'levels.png', '--height', 'h.png'), ('expand', 'levels.png', '--levels', 'l.png'),
                                      ('order', 'labels.png', '--unexpanded-levels', 'u.png')):
            of = command, name, '--drawing'
            says = f'The parts of "{name}" do not end at the lines of "other.png"'
            self.assertIn(says, self.celdepth(*of, 'other.png', *words))
            self.assertEqual(self.celdepth(*of, 'other.png', *words, '--quiet'), '')
            self.assertNotIn('do not end', self.celdepth(*of, 'drawing.png', *words))
            self.assertNotIn('do not end', self.celdepth(*of, 'labels.png', *words) if command != 'order' else '')
            os.remove(self.path(words[1]))
            self.fails(*of, 'scribbles.png', *words, naming='"scribbles.png" looks like scribbles: give the line drawing')
            self.fails(*of, 'white.png', *words, naming='"white.png" has no lines')
        self.assertIn('The parts of "scribbles.png" do not end at the lines of "drawing.png"', self.celdepth(
            'expand', 'levels.png', '--drawing', 'drawing.png', '--regions', 'scribbles.png', '--levels', 'l.npy'))
        of_register = 'register', '--source-levels', 'levels.png', '--warped', 'w.png', 'other.png', 'drawing.png'
        self.assertIn('do not end at the lines of "other.png"', self.celdepth(*of_register))

    def test_scribbles_as_one_of_two_drawings(self):
        """A small figure in clear colours is none, beside line art or not."""
        page = Image.new('RGB', (200, 160), 'white')
        draw = ImageDraw.Draw(page)
        for box, fill in (((60, 50, 100, 90), (250, 60, 40)), ((100, 70, 140, 120), (60, 90, 240)),
                          ((70, 90, 100, 120), (60, 200, 70))):
            draw.rectangle(box, fill=fill, outline=(60, 20, 0), width=2)
        page.save(self.path('figure.png'))
        page.convert('L').point(lambda v: 0 if v < 40 else 255).save(self.path('lines.png'))
        self.celdepth('register', 'figure.png', 'lines.png', '--warped', 'w.png')
        os.remove(self.path('w.png'))
        for pair in (('scribbles.png', 'drawing.png'), ('drawing.png', 'scribbles.png')):
            self.fails('register', *pair, '--warped', 'w.png',
                       naming='"scribbles.png" looks like scribbles and "drawing.png" like a drawing: give two drawings')

    def test_art_that_shows_nothing(self):
        """It is only warned about: fills may be of any kind."""
        self.popup('--relations', RELATIONS, '--levels', 'levels.png', '--labels', 'labels.png')
        Image.new('RGBA', (WIDTH, HEIGHT)).save(self.path('blank.png'))
        self.shade()
        for command, *words in (('popup', 'drawing.png', '--scribbles', 'scribbles.png', '--shaded', 's.png'),
                                ('shade', 'levels.png', '--drawing', 'drawing.png', '--shaded', 's.png'),
                                ('layers', 'drawing.png', '--scribbles', 'scribbles.png', '--output', 'l.ora')):
            words = command, *words, '--colours'
            self.assertIn('"blank.png" is blank, or of one colour', self.celdepth(*words, 'blank.png'))
            self.assertEqual(self.celdepth(*words, 'blank.png', '--quiet'), '')
            if command != 'shade': # where it is the levels, too
                self.assertIn('"levels.png" looks like levels or depth', self.celdepth(*words, 'levels.png'))
            for name in ('labels.png', 'coloured.png', 'grey.png', 'drawing.png'):
                self.assertEqual(self.celdepth(*words, name), '', (command, name))

    def test_contours_with_the_drawing(self):
        """Lines that contours would hide; and one sentence alone."""
        self.shade()
        self.popup('--relations', RELATIONS, '--levels', 'levels.npy')
        for name in ('coloured.png', 'grey.png'):
            for words in (('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--labels', 'l.png'),
                          ('smooth', 'levels.npy', '--drawing', 'drawing.png', '--depth', 'd.png')):
                said = self.celdepth(*words, '--contours', name, code=1)
                self.assertEqual(said, f'celdepth: "{name}" has the lines of the drawing: give a layer with the strokes '
                                       'alone.\n')

    def test_colours_or_a_photograph_as_levels(self):
        self.popup('--labels', 'labels.png', '--relations', RELATIONS)
        self.popup('--labels', 'labels.exr', '--relations', RELATIONS)
        rough = np.random.default_rng(2).integers(0, 256, (HEIGHT, WIDTH, 3), dtype=np.uint8)
        Image.fromarray(rough).save(self.path('photo.png'))
        Image.fromarray(rough[..., 0]).save(self.path('grey.png'))
        for command, *words in (('expand', '--levels', 'l.png'), ('smooth', '--depth', 'd.png'),
                                ('shade', '--shading', 's.png')):
            for name in 'labels.png', 'photo.png':
                self.fails(command, name, '--drawing', 'drawing.png', *words, naming='is coloured')
            self.fails(command, 'grey.png', '--drawing', 'drawing.png', *words, naming='looks like a photograph')
        for name in ('labels.png', 'labels.exr'):
            self.fails('enhance', name, '--view', 'v.png', naming='is coloured')
        self.popup('--levels', 'levels.npy', '--depth', 'depth.png', '--relations', RELATIONS)
        for command, *words in (('shade', '--shading', 's.png'), ('relief', '--height', 'h.png')):
            words = command, 'levels.npy', '--drawing', 'drawing.png', '--smooth-depth', *words
            self.fails(*words[:5], 'grey.png', *words[5:], naming='"grey.png" looks like a photograph')
            self.fails(*words[:5], 'labels.exr', *words[5:], naming='"labels.exr" is coloured')
            self.celdepth(*words[:5], 'depth.png', *words[5:])
        self.fails('enhance', 'grey.png', '--view', 'v.png', naming='"grey.png" looks like a photograph')
        self.celdepth('enhance', 'depth.png', '--view', 'v.png')
        self.fails('order', 'photo.png', '--unexpanded-levels', 'l.png', naming='looks like a photograph')


    def shade(self):
        """A page with its drawing shaded and coloured: shaded.png, grey.png, coloured.png; and a copy of the drawing."""
        self.popup('--relations', RELATIONS, '--labels', 'labels.png', '--levels', 'levels.npy', '--shaded', 'shaded.png')
        ink = np.asarray(drawing(), float)[..., None] / 255
        coloured = ink * self.picture('labels.png')[..., :3]
        Image.fromarray(coloured.astype(np.uint8)).save(self.path('coloured.png'))
        Image.open(self.path('shaded.png')).convert('L').save(self.path('grey.png'))
        drawing().convert('RGB').save(self.path('copy.jpg'), quality=90)

    def test_drawings_as_layers(self):
        """The drawing itself, shaded or coloured, is no layer of strokes."""
        self.shade()
        for name in ('grey.png', 'coloured.png', 'copy.jpg'):
            for command, *words in (('popup', '--corrections', name, '--depth', 'd.png'),
                                    ('popup', '--arrows', name, '--depth', 'd.png'),
                                    ('layers', '--hidden', name, '--complete', 'yes', '--output', 'l.ora')):
                self.fails(command, 'drawing.png', '--scribbles', 'scribbles.png', *words,
                           naming=f'"{name}" has the lines of the drawing: give a layer with the strokes alone')
        self.fails('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--contours', 'grey.png', '--labels', 'l.png',
                   naming='"grey.png" has the lines of the drawing: give a layer with the strokes alone')
        words = 'segment', 'drawing.png', '--labels', 'l.png', '--scribbles'
        self.fails(*words, 'grey.png', naming='"grey.png" has the lines of the drawing, and no colours')
        self.assertIn('"coloured.png" has the lines of the drawing, too: ', self.celdepth(*words, 'coloured.png'))
        self.assertNotIn('lines', self.celdepth(*words, 'coloured.png', '--quiet'))

    def test_thin_strokes_on_a_drawing(self):
        """What takes less than a hundredth of the page is scribbles, too."""
        page = Image.new('RGB', (1000, 700), 'white')
        draw = ImageDraw.Draw(page)
        draw.rectangle([60, 60, 480, 640], outline='black', width=6)
        draw.rectangle([300, 200, 900, 500], outline='black', width=6)
        page.save(self.path('drawing.png'))
        draw.line([(90, 90), (450, 110)], fill=RED, width=3)
        draw.line([(520, 300), (850, 310)], fill=BLUE, width=3)
        page.save(self.path('on.png'))
        says = self.celdepth('segment', 'drawing.png', '--scribbles', 'on.png', '--labels', 'l.png')
        self.assertIn('"on.png" has the lines of the drawing, too: give the strokes alone', says)

    def test_broad_lines_in_a_layer(self):
        """Strokes on a copy of a drawing in lines of a fortieth of the page; strokes alone are none."""
        page = Image.new('RGB', (1000, 700), 'white')
        draw = ImageDraw.Draw(page)
        for box in ([60, 60, 480, 640], [540, 60, 940, 330], [540, 390, 940, 640]):
            draw.rectangle(box, outline='black', width=26)
        page.save(self.path('drawing.png'))
        alone = Image.new('RGB', page.size, 'white')
        for to in (page, alone):
            draw = ImageDraw.Draw(to)
            draw.line([(150, 200), (380, 500)], fill=RED, width=25)
            draw.line([(640, 200), (840, 210)], fill=BLUE, width=25)
            draw.line([(640, 500), (840, 510)], fill=GREEN, width=25)
        page.save(self.path('on.png'))
        alone.save(self.path('scribbles.png'))
        words = 'segment', 'drawing.png', '--labels', 'l.png', '--scribbles'
        says = self.celdepth(*words, 'on.png')
        self.assertIn('"on.png" has the lines of the drawing, too: ', says)
        self.assertEqual(self.celdepth(*words, 'scribbles.png'), '')
        os.remove(self.path('l.png'))
        self.fails('popup', 'drawing.png', '--scribbles', 'scribbles.png', '--arrows', 'on.png', '--depth', 'd.png',
                   naming='"on.png" has the lines of the drawing: give a layer with the strokes alone')

    def test_drawings_as_levels(self):
        """Those of single steps, and what is given beside them; expansion does not look at lines."""
        self.shade()
        of_drawing = '--drawing', 'drawing.png'
        for name in ('grey.png', 'copy.jpg'):
            says = f'"{name}" has the lines of "drawing.png": levels and depth'
            for command, *words in (('smooth', '--depth', 'd.png'), ('shade', '--shading', 's.png'),
                                    ('relief', '--height', 'h.png')):
                self.fails(command, name, *of_drawing, *words, naming=says)
            for command, *words in (('shade', '--shading', 's.png'), ('relief', '--height', 'h.png')):
                self.fails(command, 'levels.npy', *of_drawing, '--smooth-depth', name, *words, naming=says)
            self.fails('register', 'drawing.png', 'drawing.png', '--source-levels', name, '--displacement', 'o.npy',
                       naming=says)
            self.assertIn(f'"{name}" has the lines of "drawing.png", as if it were a drawing',
                          self.celdepth('expand', name, *of_drawing, '--levels', 'l.npy'))
        self.assertIn('"grey.png" has the lines of "drawing.png"', self.celdepth(
            'shade', 'levels.npy', *of_drawing, '--hints', 'grey.png', '--shading', 's.png'))
        np.save(self.path('photo.npy'), np.random.default_rng(2).random((HEIGHT, WIDTH), np.float32))
        self.fails('register', 'drawing.png', 'drawing.png', '--source-levels', 'photo.npy', '--displacement', 'o.npy',
                   naming='"photo.npy" looks like a photograph')

    def test_art_as_levels(self):
        """The art itself, a copy of it, and other pictures with its lines."""
        self.shade()
        words = '--enhanced', 'e.png', '--colours'
        drawing().save(self.path('art.tif'))
        self.fails('enhance', 'art.tif', *words, 'art.tif', naming='"art.tif" is the same picture as "art.tif"')
        self.fails('enhance', 'copy.jpg', *words, 'drawing.png', naming='"copy.jpg" is the same picture as "drawing.png"')
        self.fails('enhance', 'grey.png', *words, 'drawing.png', naming='"grey.png" has the lines of "drawing.png"')
        self.fails('enhance', 'drawing.png', *words, 'shaded.png', naming='"drawing.png" has the lines of "shaded.png"')
        for art in ('drawing.png', 'shaded.png', 'coloured.png'):
            self.assertEqual(self.celdepth('enhance', 'levels.npy', *words, art), '')

    def test_drawings_alone_as_levels(self):
        """Where no drawing is given, or the lines are those of another one; in ink and in chalk."""
        self.popup('--relations', RELATIONS, '--levels', 'levels.png', '--depth', 'depth.png')
        ImageOps.invert(drawing()).save(self.path('chalk.png'))
        Image.open(self.path('drawing.png')).transpose(Image.Transpose.FLIP_TOP_BOTTOM).save(self.path('other.png'))
        for name in ('drawing.png', 'chalk.png'):
            for output in ('--view', '--shadow'):
                self.fails('enhance', name, output, 'v.png', naming=f'"{name}" looks like a drawing: levels and depth')
            self.fails('enhance', name, '--colours', 'levels.png', '--enhanced', 'e.png',
                       naming=f'"{name}" looks like a drawing')
        for command, *words in (('shade', '--shading', 's.png'), ('smooth', '--depth', 'd.png'), ('relief', '--height', 'h.png')):
            self.fails(command, 'other.png', '--drawing', 'drawing.png', *words, naming='"other.png" looks like a drawing')
        for name in ('levels.png', 'depth.png'):
            self.assertEqual(self.celdepth('enhance', name, '--view', 'v.png'), '')

    def test_exchanged_levels(self):
        """Levels and drawing, ink or chalk, also where the lines of one are not those of the other."""
        self.shade()
        Image.open(self.path('drawing.png')).transpose(Image.Transpose.FLIP_TOP_BOTTOM).save(self.path('other.png'))
        ImageOps.invert(drawing()).save(self.path('chalk.png'))
        self.popup('--relations', RELATIONS, '--levels', 'levels.png')
        for command, *words in (('shade', '--shading', 's.png'), ('smooth', '--depth', 'd.png'),
                                ('expand', '--levels', 'l.png'), ('relief', '--height', 'h.png')):
            for name in ('drawing.png', 'other.png', 'chalk.png'):
                self.fails(command, name, '--drawing', 'levels.png', *words,
                           naming=f'"{name}" looks like a drawing and "levels.png" like levels: exchange them.')
        self.assertEqual(self.celdepth('shade', 'levels.png', '--drawing', 'chalk.png', '--shading', 's.png'), '')

    def test_drawings_as_regions(self):
        self.shade()
        for words in (('order', 'NAME', '--unexpanded-levels', 'l.npy'), ('expand', 'levels.npy', '--regions', 'NAME',
                                                                         '--levels', 'l.npy')):
            def with_name(name):
                return [name if word == 'NAME' else word for word in words] + ['--drawing', 'drawing.png']
            self.fails(*with_name('grey.png'), naming='"grey.png" has the lines of "drawing.png", and no colours')
            self.assertIn('"coloured.png" has the lines of "drawing.png", too', self.celdepth(*with_name('coloured.png')))
            self.assertEqual(self.celdepth(*with_name('labels.png')), '')

    def test_regions_without_a_drawing(self):
        """They may be anything, so that it is only warned of what looks like something else."""
        self.popup('--relations', RELATIONS, '--labels', 'labels.png', '--levels', 'levels.png')
        Image.new('L', (WIDTH, HEIGHT), 255).save(self.path('white.png'))
        Image.new('RGBA', (WIDTH, HEIGHT)).save(self.path('clear.png'))
        numbers = np.where(np.asarray(drawing().convert('L')) < 128, 255, 0).astype(np.uint8)
        numbers[20:40, 20:40][numbers[20:40, 20:40] == 0] = 3
        Image.fromarray(numbers).save(self.path('numbers.png'))
        for name, says in (('labels.png', ''), ('numbers.png', ''), ('white.png', 'is blank'), ('clear.png', 'is blank'),
                           ('drawing.png', 'looks like a drawing'), ('levels.png', 'looks like levels or depth'),
                           ('scribbles.png', 'looks like scribbles')):
            said = self.celdepth('order', name, '--unexpanded-levels', 'u.npy')
            self.assertIn(f'"{name}" {says}' if says else '', said)
            self.assertEqual(said.count('\n'), bool(says), said)
            self.assertEqual(self.celdepth('order', name, '--unexpanded-levels', 'u.npy', '--quiet'), '')

    def test_arrows_as_scribbles(self):
        """Two arrows or more, and hardly anything else."""
        def paint(name, arrows, lines):
            layer = Image.new('RGBA', (WIDTH, HEIGHT))
            draw = ImageDraw.Draw(layer)
            for i in range(arrows):
                x = 12 + 22 * i
                draw.line([(x, 50), (x, 14)], fill=(255, 128, 0, 255), width=2)
                draw.line([(x - 6, 21), (x, 14), (x + 6, 21)], fill=(255, 128, 0, 255), width=2)
            for i in range(lines):
                draw.line([(10, 58 + 4 * i), (80, 58 + 4 * i)], fill=BLUE + (255,), width=2)
            layer.save(self.path(name))

        says = '"arrows.png" looks like arrows: give it with --arrows'
        paint('arrows.png', 3, 1)
        self.fails('segment', 'drawing.png', '--scribbles', 'arrows.png', '--labels', 'l.png', naming=says)
        self.popup('--relations', RELATIONS, '--levels', 'levels.npy')
        self.fails('smooth', 'levels.npy', '--drawing', 'drawing.png', '--scribbles', 'arrows.png', '--depth', 'd.png',
                   naming=says)
        for arrows, lines in ((1, 0), (2, 1)):
            paint('arrows.png', arrows, lines)
            self.celdepth('segment', 'drawing.png', '--scribbles', 'arrows.png', '--labels', 'l.png')

    def test_blank_hints(self):
        words = 'segment', 'drawing.png', '--scribbles', 'scribbles.png', '--suggestions', 's.txt', '--depth-hint'
        Image.new('L', (WIDTH, HEIGHT), 99).save(self.path('flat.png'))
        unseen = np.zeros((HEIGHT, WIDTH, 4), np.uint8)
        unseen[..., :3] = np.arange(WIDTH)[None, :, None]
        Image.fromarray(unseen).save(self.path('unseen.png'))
        for name in ('flat.png', 'unseen.png'):
            self.fails(*words, name, naming=f'"{name}" is blank, so that it says nothing about depth')
        self.popup('--labels', 'labels.png')
        self.fails('order', 'labels.png', '--unexpanded-levels', 'l.npy', '--depth-hint', 'flat.png', naming='is blank')

    def test_odd_hints(self):
        """Estimators may find much, so that these are only warned about."""
        self.shade()
        words = 'segment', 'drawing.png', '--scribbles', 'scribbles.png', '--suggestions', 's.txt', '--depth-hint'
        Image.fromarray(np.random.default_rng(2).integers(0, 256, (HEIGHT, WIDTH), np.uint8)).save(self.path('photo.png'))
        self.assertIn('"photo.png" looks like a photograph', self.celdepth(*words, 'photo.png'))
        self.assertIn('"grey.png" has the lines of "drawing.png"', self.celdepth(*words, 'grey.png'))
        for name, *quiet in (('photo.png', '--quiet'), ('grey.png', '--quiet'), ('levels.npy',)):
            self.assertEqual(self.celdepth(*words, name, *quiet), '')

    def test_strokes_that_change_nothing(self):
        """Corrections and hidden strokes in colours of no region: a warning, with the place."""
        for name, colour in (('wrong.png', (200, 100, 7)), ('right.png', RED)):
            layer = Image.new('RGBA', (WIDTH, HEIGHT))
            ImageDraw.Draw(layer).line([(40, 20), (50, 20)], fill=colour + (255,), width=1)
            layer.save(self.path(name))
        Image.new('RGB', (WIDTH, HEIGHT), 'white').save(self.path('blank.png'))
        of_drawing = '--relations', RELATIONS, '--report', 'report.json'

        def problems(command, *words):
            text = self.celdepth(command, 'drawing.png', '--scribbles', 'scribbles.png', *of_drawing, *words)
            with open(self.path('report.json'), encoding='utf-8') as file:
                found = [problem for problem in json.load(file)['problems'] if problem['kind'] == 'stroke-unmatched']
            self.assertEqual('changes nothing' in text, bool(found))
            return [problem['place'] for problem in found]

        for role, *words in (('--corrections', 'popup', '--levels', 'l.npy'),
                             ('--hidden', 'layers', '--complete', 'yes', '--output', 'l.ora')):
            for name, places in (('wrong.png', [[40, 20]]), ('right.png', []), ('blank.png', [])):
                self.assertEqual(problems(*words, role, name), places, (role, name))

    def test_smooth_levels(self):
        """Levels with slopes, as painted with a soft brush or a gradient, also dithered, are no photographs."""
        random, (y, x) = np.random.default_rng(6), np.mgrid[:240, :320]
        levels = 40.0 + x / 3 + 60 * (np.hypot(x - 160, y - 120) < 70)
        Image.fromarray(np.floor(levels + random.random(levels.shape)).astype(np.uint8)).save(self.path('levels.png'))
        ring = Image.new('L', (320, 240), 255)
        ImageDraw.Draw(ring).ellipse((90, 50, 230, 190), outline=0, width=5)
        ring.save(self.path('ring.png'))
        for command, *words in (('expand', '--levels', 'l.npy'), ('smooth', '--depth', 'd.npy'), ('shade', '--shading', 's.npy'),
                                ('relief', '--height', 'h.npy')):
            self.assertEqual(self.celdepth(command, 'levels.png', '--drawing', 'ring.png', *words), '', command)
        self.assertEqual(self.celdepth('enhance', 'levels.png', '--view', 'v.png'), '')


def photographs():
    """Pictures like photographs: shaded things with grain, the same with a texture, a texture alone, clouds in colours."""
    random, (y, x) = np.random.default_rng(3), np.mgrid[:240, :320]

    def clouds(power):
        frequency = np.hypot(np.fft.fftfreq(240)[:, None], np.fft.rfftfreq(320)[None])
        frequency[0, 0] = 1
        made = np.fft.irfft2(np.fft.rfft2(random.standard_normal((240, 320))) / frequency**power, (240, 320))
        return ((made - made.min()) / np.ptp(made))[..., None]

    def thing(page, cx, cy, radius, colour):
        across, down = (x - cx) / radius, (y - cy) / radius
        inside = np.hypot(across, down) < 1
        light = 0.25 + 0.5 * (-0.5 * across - 0.4 * down + np.sqrt(np.clip(1 - across**2 - down**2, 0, 1)))
        page[inside] = light.clip(0.05, 1)[inside][:, None] * colour

    room = np.stack([0.5 + x / 1000, 0.6 - y / 1200, np.full(x.shape, 0.7)], -1)
    for _ in range(14):
        thing(room, random.uniform(0, 320), random.uniform(0, 240), random.uniform(20, 65), random.uniform(0.2, 1, 3))
    return {'shaded': room + random.normal(0, 0.02, room.shape), 'textured': room * (0.5 + 0.5 * clouds(1.0)),
            'texture': np.repeat(clouds(1.2), 3, 2), 'clouds': np.concatenate([clouds(1.5) for _ in range(3)], 2)}


class Photographs(Test):
    def setUp(self):
        super().setUp()
        ring = Image.new('L', (320, 240), 255)
        ImageDraw.Draw(ring).ellipse((60, 40, 260, 200), outline=0, width=5)
        ring.save(self.path('ring.png'))
        strokes = Image.new('RGBA', (320, 240))
        ImageDraw.Draw(strokes).line([(120, 120), (200, 120)], fill=RED + (255,), width=6)
        strokes.save(self.path('strokes.png'))
        for name, picture in photographs().items():
            Image.fromarray((255 * picture.clip(0, 1)).astype(np.uint8)).save(self.path(f'{name}.png'))

    def test_as_drawing(self):
        for name in ('shaded', 'textured', 'texture', 'clouds'):
            with self.subTest(name):
                self.fails('popup', f'{name}.png', '--scribbles', 'strokes.png', '--depth', 'd.png',
                           naming=f'"{name}.png" looks like a photograph')

    def test_as_scribbles(self):
        for name in ('shaded', 'textured', 'clouds'):
            with self.subTest(name):
                self.fails('popup', 'ring.png', '--scribbles', f'{name}.png', '--depth', 'd.png',
                           naming=f'"{name}.png" looks like a photograph')

    def test_as_layers(self):
        """Whatever takes strokes; and grey ones as small as icons as scribbles."""
        of_ring = 'ring.png', '--scribbles', 'strokes.png'
        for name in ('shaded', 'textured', 'clouds'):
            says = f'"{name}.png" looks like a photograph: what is given with '
            for command, *words in (('popup', '--corrections'), ('popup', '--arrows'), ('popup', '--contours'),
                                    ('popup', '--hidden')):
                self.fails(command, *of_ring, '--normals', 'n.png', *words, f'{name}.png', naming=says + words[-1])
            self.fails('deform', *of_ring, '--handles-layer', f'{name}.png', '--output', 'd.png', naming=says)
        self.celdepth('popup', *of_ring, '--levels', 'levels.npy')
        self.fails('shade', 'levels.npy', '--drawing', 'ring.png', '--hints', 'textured.png', '--shading', 's.png',
                   naming=says[:-1].replace('clouds', 'textured'))
        ring = Image.open(self.path('ring.png'))
        ring.resize((52, 40)).save(self.path('icon.png'))
        for name in ('shaded', 'textured'):
            Image.open(self.path(f'{name}.png')).convert('L').resize((52, 40)).save(self.path('small.png'))
            self.fails('segment', 'icon.png', '--ink', 'dark', '--scribbles', 'small.png', '--labels', 'l.png',
                       naming='"small.png" looks like a photograph')

    def test_as_regions(self):
        """Also grey ones, which have few colours."""
        Image.open(self.path('textured.png')).convert('L').save(self.path('grey.png'))
        for name in ('textured.png', 'grey.png'):
            self.fails('order', name, '--unexpanded-levels', 'l.npy', naming=f'"{name}" looks like a photograph')

    def test_as_drawing_on_purpose(self):
        """Who says what the lines are is believed."""
        self.assertNotIn('photograph', self.celdepth('segment', 'textured.png', '--scribbles', 'strokes.png', '--ink',
                                                     'dark', '--labels', 'l.png'))

    def test_odd(self):
        """Faint lines in strong grain may be a drawing: a warning, and regions."""
        page = Image.open(self.path('ring.png'))
        for x in range(0, 400, 60):
            ImageDraw.Draw(page).line([(x, 0), (x - 80, 240)], fill=0, width=4)
        lines = np.asarray(page, float) / 255
        faint = 0.4 + 0.3 * lines + np.random.default_rng(5).normal(0, 0.11, lines.shape)
        Image.fromarray((255 * faint.clip(0, 1)).astype(np.uint8)).save(self.path('faint.png'))
        words = ('segment', 'faint.png', '--scribbles', 'strokes.png', '--labels', 'l.png')
        self.assertIn('"faint.png" hardly has clear lines', self.celdepth(*words))
        self.assertNotIn('hardly', self.celdepth(*words, '--quiet'))

    def test_no_false_alarm(self):
        """A drawing stays one with shadows on its paper, grain, JPEG, faint lines, light lines, fills and scribbles."""
        random = np.random.default_rng(4)
        page = Image.open(self.path('ring.png')).convert('RGB')
        ImageDraw.Draw(page).line([(10, 230), (310, 150)], fill='black', width=3)
        lines = np.asarray(page, float)[..., :1] / 255
        shadow = np.linspace(1, 0.6, 320)[None, :, None]
        fills = np.ones((240, 320, 3))
        fills[60:180, 90:230] = (0.9, 0.5, 0.3)
        fills[200:] = (0.4, 0.7, 0.9)
        for name, picture in (('shadow', lines * shadow + random.normal(0, 0.02, (240, 320, 3))),
                              ('faint', 0.75 + 0.2 * lines + random.normal(0, 0.01, (240, 320, 1)) + np.zeros(3)),
                              ('grain', 0.2 + 0.6 * lines + random.normal(0, 0.1, (240, 320, 1)) + np.zeros(3)),
                              ('chalk', 1 - lines + np.zeros(3)), ('fills', lines * fills)):
            Image.fromarray((255 * picture.clip(0, 1)).astype(np.uint8)).save(self.path(f'{name}.jpg'), quality=80)
            with self.subTest(name):
                said = self.celdepth('segment', f'{name}.jpg', '--scribbles', 'strokes.png', '--labels', 'l.png')
                self.assertNotIn('photograph', said)
                self.assertNotIn('hardly', said)


class NoNumbers(Test):
    """Float pictures with values that are infinite or no number (NaN)."""

    def float_scribbles(self, name, *values):
        """The scribbles as EXR, with some pixels set: (x, y, R, G, B, A)."""
        paint = np.array(scribbles(), np.float32) / 255
        paint[..., :3] = np.where(paint[..., :3] <= 0.04045, paint[..., :3] / 12.92, ((paint[..., :3] + 0.055) / 1.055)**2.4)
        for x, y, *value in values:
            paint[y, x] = value
        write_exr(self.path(name), paint)

    def test_scribbles(self):
        nan, infinite = float('nan'), float('inf')
        for i, pixel in enumerate([(nan, nan, nan, 1), (1, infinite, 0, 1), (1, 0, 0, nan)]):
            name = f'{i}.exr'
            self.float_scribbles(name, (30, 50, *pixel))
            self.fails('segment', 'drawing.png', '--scribbles', name, '--labels', 'l.png',
                       naming=f'"{name}" has a pixel at 30, 50 whose value is infinite or no number')

    def test_unseen_scribbles(self):
        """Where colours were divided by an alpha of 0 there is no paint."""
        nan = float('nan')
        self.float_scribbles('divided.exr', (30, 50, nan, nan, nan, 0), (31, 50, nan, nan, nan, 0))
        self.celdepth('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--labels', 'a.npy')
        self.celdepth('segment', 'drawing.png', '--scribbles', 'divided.exr', '--labels', 'b.npy')
        np.testing.assert_array_equal(np.load(self.path('a.npy')), np.load(self.path('b.npy')))

    def test_levels_and_depth(self):
        self.popup('--relations', RELATIONS, '--levels', 'levels.npy')
        for i, value in enumerate([np.nan, np.inf, -np.inf]):
            levels = np.load(self.path('levels.npy'))
            levels[20, 30] = value
            for name in (f'{i}.npy', f'{i}.tif'):
                if name.endswith('npy'):
                    np.save(self.path(name), levels)
                else:
                    Image.fromarray(levels).save(self.path(name))
                says = f'"{name}" has a pixel at 30, 20 whose value is infinite or no number'
                for command, *words in (('expand', '--levels', 'l.png'), ('smooth', '--depth', 'd.png'),
                                        ('relief', '--height', 'h.png'), ('shade', '--shading', 's.png')):
                    self.fails(command, name, '--drawing', 'drawing.png', *words, naming=says)
                self.fails('enhance', name, '--view', 'v.png', naming=says)
                self.fails('relief', 'levels.npy', '--drawing', 'drawing.png', '--smooth-depth', name, '--height', 'h.png',
                           naming=says)
                self.fails('shade', 'levels.npy', '--drawing', 'drawing.png', '--smooth-depth', name, '--shading', 's.png',
                           naming=says)

    def test_nothing_but_nan(self):
        np.save(self.path('nan.npy'), np.full((HEIGHT, WIDTH), np.nan, np.float32))
        self.fails('shade', 'nan.npy', '--drawing', 'drawing.png', '--shading', 's.png', naming='"nan.npy" has a pixel at 0, 0')

    def test_flat_levels(self):
        """May be meant, for one part alone, so that it is a warning."""
        np.save(self.path('flat.npy'), np.full((HEIGHT, WIDTH), 2, np.float32))
        for command, *words in (('expand', '--levels', 'l.png'), ('smooth', '--depth', 'd.png'),
                                ('shade', '--shading', 's.png')):
            words = [command, 'flat.npy', '--drawing', 'drawing.png', *words]
            self.assertIn('"flat.npy" has the same value everywhere', self.celdepth(*words))
            self.assertNotIn('everywhere', self.celdepth(*words, '--quiet'))
        self.assertIn('"flat.npy" has the same value everywhere', self.celdepth('enhance', 'flat.npy', '--view', 'v.png'))


class BadInput(Test):
    def test_kinds_that_cannot_be_read(self):
        """What to do is said of each."""
        for start, says in ((b'', 'it is empty.'), (b'gimp xcf v011\0', 'it is an XCF, which cannot be read. Save it as ORA'),
                            (b'CSFCHUNK\0\0', 'it is a document of Clip Studio Paint, which cannot be read. Save it as PSD.'),
                            (b'%PDF-1.7\n\xff', 'it is a PDF'), (b'\0\0\0\x18ftypheic\0\0', 'it is damaged, or a HEIC'),
                            (b'<?xml version="1.0"?>\n<svg/>', 'it is an SVG'), (b'120,80 > 300,95\n', 'it is a text and no'),
                            (b'120\0', 'it is damaged, or of a format that cannot be read. PNG,'),
                            (b'\0\0\0\x18', 'it is damaged, or of a format')):
            with open(self.path('page.png'), 'wb') as file:
                file.write(start)
            self.fails('popup', 'page.png', '--depth', 'd.png', naming='celdepth: Cannot read "page.png": ' + says)

    def test_missing_and_unreadable_files(self):
        os.mkdir(self.path('folder.png'))
        self.fails('popup', 'none.png', '--depth', 'd.png', naming='"none.png": there is no such file')
        self.fails('popup', 'folder.png', '--depth', 'd.png', naming='"folder.png": it is a folder')
        self.fails('popup', '', '--depth', 'd.png', naming='"": its name is empty')
        self.fails('popup', 'drawing.png', '--scribbles', 'none.png', '--depth', 'd.png', naming='none.png')
        with open(self.path('text.png'), 'w', encoding='ascii') as file:
            file.write('this is no picture')
        self.fails('popup', 'text.png', '--depth', 'd.png', naming='text.png')
        open(self.path('empty.png'), 'wb').close()
        self.fails('popup', 'empty.png', '--depth', 'd.png', naming='empty.png')

    def test_plain_reasons(self):
        """A path and a reason in words of the system, not the text of a library."""
        for name, content in (('bad.json', '{ "fragments": [\n1 2 ] }'), ('list.json', '[1]')):
            with open(self.path(name), 'w', encoding='ascii') as file:
                file.write(content)
        os.mkdir(self.path('folder'))
        deform = 'deform', 'drawing.png', '--scribbles', 'scribbles.png', '--output', 'o.gif', '--keys'
        order = 'order', 'none.npy', '--unexpanded-levels', 'u.npy'
        for words, said in ((('compose', 'none.json', '--output', 'o.png'), '"none.json": No such file or directory.'),
                            (('compose', 'folder', '--output', 'o.png'), '"folder": it is a folder.'),
                            (('compose', 'bad.json', '--output', 'o.png'), '"bad.json": line 2 is no JSON.'),
                            (('compose', 'drawing.png', '--output', 'o.png'), '"drawing.png": it is not a text file.'),
                            ((*order, '--drawing', 'drawing.png'), '"none.npy": No such file or directory.'),
                            (('popup', 'drawing.png', '--relations-file', 'none.txt', '--depth', 'd.png'),
                             '"none.txt": No such file or directory.')):
            self.assertEqual(self.celdepth(*words, code=1), f'celdepth: Cannot read {said}\n')
        write_ora(self.path('bad.ora'), (WIDTH, HEIGHT), '<stack>\n<layer name="a" /></stak>', {})
        self.assertEqual(self.celdepth('popup', 'bad.ora', '--depth', 'd.png', code=1),
                         'celdepth: Cannot read "bad.ora": its stack.xml is damaged, in line 2.\n')
        self.assertIn('Cannot read "bad.json": line 2 is no JSON.', self.celdepth(*deform, 'bad.json', code=1))

    def test_closed_files(self):
        """One that may not be read is not damaged; one that may not be written, or finds no space, is said in plain words."""
        def run(*words, prepare):
            done = subprocess.run([COMMAND, *words], cwd=self.folder, capture_output=True, text=True, check=False,
                                  preexec_fn=prepare, restore_signals=False)
            self.assertEqual(done.returncode, 1, f'{words}: {done.stderr}')
            return done.stderr

        def as_nobody():
            if os.getuid() == 0:
                os.setgid(65534)
                os.setuid(65534)

        def small(size=100):
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        os.chmod(self.folder, 0o755)
        words = 'popup', 'drawing.png', '--scribbles', 'scribbles.png'
        before = sorted(os.listdir(self.folder))
        for output in ('--depth d.png', '--depth d.exr', '--depth d.tif', '--depth d.npy', '--layers l.ora', '--layers l.exr',
                       '--layers l', '--joined j.mpo'):
            said = run(*words, *output.split(), prepare=small)
            self.assertRegex(said, r'Cannot write "[a-z.]+": File too large\.\n$')
        self.assertIn('File too large', run(*words, '--depth', 'd.png', prepare=lambda: small(0)))
        for late in ('--wiggle w.gif', '--mesh m.obj', '--report r.json'):  # earlier results are not left
            said = run(*words, '--labels', 'l.png', '--suggestions', 's.txt', '--layers', 'l', *late.split(),
                       prepare=lambda: small(1500))
            self.assertRegex(said, r'Cannot write "(w.gif|m.obj|r.json)": ')
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        os.chmod(self.path('drawing.png'), 0)
        self.assertEqual(run(*words, '--depth', '/tmp/none/d.png', prepare=as_nobody).count('\n'), 1)
        os.mkdir(self.path('open'))
        os.chmod(self.path('open'), 0o777)
        self.assertEqual(run(*words, '--depth', 'open/d.png', prepare=as_nobody),
                         'celdepth: Cannot read "drawing.png": it cannot be opened: Permission denied.\n')

    def test_layers_compressed_by_zip(self):
        write_psd(self.path('page.psd'), (WIDTH, HEIGHT), layers())
        with open(self.path('page.psd'), 'rb') as file:
            data = bytearray(file.read())
        plane = layers()[0][3].getchannel('A').tobytes()
        place = data.index(b'\0\0' + plane)
        data[place + 1] = 2
        with open(self.path('zip.psd'), 'wb') as file:
            file.write(data)
        self.fails('popup', 'zip.psd', '--depth', 'd.png', naming='"zip.psd": its layers are compressed by ZIP, which')

    def test_truncated_files(self):
        noise = np.random.default_rng(1).integers(0, 256, (64, 64, 3), dtype=np.uint8)
        picture = Image.fromarray(noise)
        picture.save(self.path('whole.png'))
        picture.save(self.path('whole.tif'))
        write_psd(self.path('whole.psd'), (64, 64), [('drawing', 0, 0, picture.convert('RGBA'))])
        subprocess.run(['oiiotool', self.path('whole.png'), '-o', self.path('whole.exr')], check=True)
        np.save(self.path('whole.npy'), noise[:, :, 0].astype(np.float32))
        for ending in ('png', 'tif', 'psd', 'exr', 'npy'):
            with open(self.path(f'whole.{ending}'), 'rb') as file:
                data = file.read()
            for share in (0.001, 0.01, 0.3, 0.5):
                name = f'cut.{ending}'
                with open(self.path(name), 'wb') as file:
                    file.write(data[:max(int(share * len(data)), 1)])
                with self.subTest(ending=ending, share=share):
                    if ending == 'npy':
                        self.fails('smooth', name, '--drawing', 'whole.png', '--depth', 'd.png', naming=name)
                    else:
                        self.fails('popup', name, '--depth', 'd.png', naming=name)

    def test_endless_files(self):
        """Memory is not what ends their reading."""
        def refuses(*words):
            done = subprocess.run([COMMAND, *words], cwd=self.folder, check=False, capture_output=True, text=True,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30)))
            self.assertEqual((done.returncode, done.stderr), (1, 'celdepth: Cannot read "/dev/zero": it is larger than '
                                                                 '64 MiB.\n'))

        input_files = 'drawing.png', '--scribbles', 'scribbles.png'
        refuses('popup', *input_files, '--relations-file', '/dev/zero', '--depth', 'd.png')
        refuses('deform', *input_files, '--handles-file', '/dev/zero', '--output', 'd.png')
        refuses('deform', *input_files, '--keys', '/dev/zero', '--output', 'd.gif')
        refuses('compose', '/dev/zero', '--output', 'd.png')
        self.celdepth('popup', *input_files, '--relations-file', '/dev/null', '--depth', 'd.png')
        with open('/dev/zero', 'rb') as endless:
            done = subprocess.run([COMMAND, 'popup', '-', *input_files[1:], '--depth', 'd.png'], cwd=self.folder, stdin=endless,
                                  capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (1, 'celdepth: Cannot read standard input: it is too large.\n'))
        write_ora(self.path('page.ora'), (WIDTH, HEIGHT), '<stack/>', {})
        self.assertIn('"/dev/zero": it is not an ordinary file', self.celdepth(
            'popup', 'page.ora', '--relations-file', '/dev/zero', '--output-dir', 'out', code=1))

    def test_deep_json(self):
        """Wherever JSON is read, what is nested without end is refused; as the state of a page it is out of date."""
        os.makedirs(self.path('clip'))
        for name in ('s.json', 'clip/clip.json'):
            with open(self.path(name), 'w', encoding='ascii') as file:
                file.write('["]]\\"]",\n' * 100000)
        input_files = 'drawing.png', '--scribbles', 'scribbles.png'
        for words in (('compose', 's.json', '--output', 'o.png'),
                      ('deform', *input_files, '--keys', 's.json', '--output', 'o.gif'),
                      ('shade', '--clip', 'clip', '--shaded', 'o.png')):
            self.fails(*words, naming='.json": line 101 has more than 100 arrays and objects in each other.')
        write_psd(self.path('p1.psd'), (WIDTH, HEIGHT), [('drawing', 0, 0, drawing().convert('RGBA')),
                                                        ('scribbles', 0, 0, scribbles())])
        os.mkdir(self.path('out'))
        shutil.copy(self.path('s.json'), self.path('out/.p1.state.json'))
        self.assertIn('1 made', self.celdepth('popup', 'p1.psd', '--output-dir', 'out', '--labels'))

    def test_sizes_out_of_range(self):
        for width, height in ((30000, 10), (10, 30000), (20000, 20000), (2 ** 31 - 1, 2 ** 31 - 1)):
            header = struct.pack('>IIBBBBB', width, height, 8, 0, 0, 0, 0)
            chunks = b''
            for name, data in ((b'IHDR', header), (b'IDAT', zlib.compress(b'\0' * 100)), (b'IEND', b'')):
                chunks += struct.pack('>I', len(data)) + name + data + struct.pack('>I', zlib.crc32(name + data))
            with open(self.path('absurd.png'), 'wb') as file:
                file.write(b'\x89PNG\r\n\x1a\n' + chunks)
            with self.subTest(width=width, height=height):
                self.fails('popup', 'absurd.png', '--depth', 'd.png', naming='absurd.png')

    def test_sizes_that_differ(self):
        scribbles().resize((50, 40)).save(self.path('small.png'))
        self.fails('popup', 'drawing.png', '--scribbles', 'small.png', '--depth', 'd.png',
                   naming='"small.png" has 50 x 40 pixels, but 96 x 64')
        np.save(self.path('small.npy'), np.zeros((5, 5), np.float32))
        self.fails('smooth', 'small.npy', '--drawing', 'drawing.png', '--depth', 'd.png', naming='96 x 64')

    def test_neither_scribbles_nor_arrows(self):
        Image.new('RGBA', (WIDTH, HEIGHT)).save(self.path('blank.png'))
        self.fails('popup', 'drawing.png', '--depth', 'd.png', naming='no scribbles and no arrows')
        self.fails('popup', 'drawing.png', '--scribbles', 'blank.png', '--depth', 'd.png', naming='no scribbles and no arrows')

    def test_unreadable_arrow_path(self):
        text = self.popup('--arrow-path', 'M 1,1 L 2,2\nL 3;4', '--depth', 'd.png', code=2)
        self.assertRegex(text, '--arrow-path, line 2, column 4: expected a number for y, but found ";"')

    def test_unreadable_relations(self):
        text = self.popup('--relations', '1,1 > 2,2;\n3,3 ? 4,4', '--depth', 'd.png', code=2)
        self.assertRegex(text, 'line 2, column 5: expected .*found')
        with open(self.path('relations.txt'), 'wb') as file:
            file.write(b'1,1 > 2,\n')
        text = self.popup('--relations-file', 'relations.txt', '--depth', 'd.png', code=2)
        self.assertIn('relations.txt, line', text)
        for content in (b'1,1 > 2,2\0 and more', '1,1 > 2,2'.encode('utf-16')):
            with open(self.path('relations.txt'), 'wb') as file:
                file.write(content)
            self.assertIn('not a text file', self.popup('--relations-file', 'relations.txt', '--depth', 'd.png', code=1))
        self.fails('popup', 'drawing.png', '--scribbles', 'scribbles.png', '--relations-file', 'drawing.png', '--depth',
                   'd.png', naming='Cannot read "drawing.png": it is not a text file.')

    def test_contradictions(self):
        """Code 3, both relations are listed, and the others are ordered."""
        text = self.popup('--relations', '70,45 > 20,20 @2\n20,20 > 70,45', '--levels', 'l.npy', '--quiet', code=3)
        self.assertIn('70,45 > 20,20 @2  (--relations, line 1, column 1)', text)
        self.assertIn('20,20 > 70,45  (--relations, line 2, column 1)', text)
        levels = np.load(self.path('l.npy'))
        self.assertGreater(levels[45, 70], levels[20, 20])

    def test_numbers_of_three_axes(self):
        """Normals are refused as levels."""
        np.save(self.path('normals.npy'), np.zeros((HEIGHT, WIDTH, 3), np.float32))
        self.fails('smooth', 'normals.npy', '--drawing', 'drawing.png', '--depth', 'd.png', naming='not an array')

    def test_colours_above_their_alpha(self):
        """Premultiplied colours above their alpha are clipped to full brightness."""
        strokes = np.array(scribbles())
        strokes[strokes[:, :, 3] > 0, 3] = 200
        Image.fromarray(strokes).save(self.path('s.tif'))
        with open(self.path('s.tif'), 'rb+') as file:
            straight, data = struct.pack('<HHIHH', TiffImagePlugin.EXTRASAMPLES, 3, 1, 2, 0), file.read()
            self.assertEqual(data.count(straight), 1)
            file.seek(data.index(straight) + 8)
            file.write(b'\1')
        self.celdepth('segment', 'drawing.png', '--scribbles', 's.tif', '--labels', 'l.png')
        self.assertEqual(tuple(at(self.picture('l.png'), IN_A)), RED + (255,))

    def test_devices(self):
        """A report may be written to a device, a picture may not."""
        os.symlink('/dev/full', self.path('full.json'))
        self.assertIn('full.json', self.popup('--report', 'full.json', code=1))
        self.assertTrue(os.path.islink(self.path('full.json')))
        self.assertEqual(json.loads(self.popup('--report', '/dev/stdout'))['width'], WIDTH)
        for name in ('full.png', 'full.npy'):
            os.symlink('/dev/full', self.path(name))
            self.assertIn('not an ordinary file', self.popup('--depth', name, code=1))
            self.assertTrue(os.path.islink(self.path(name)))

    def test_unwritable(self):
        for output in ('nowhere/d.png', 'nowhere/d.npy', 'nowhere/d.exr'):
            self.assertIn(output, self.popup('--depth', output, code=1))
        os.mkdir(self.path('taken.png'))
        self.assertIn('taken.png', self.popup('--depth', 'taken.png', code=1))
        self.assertIn('r.json', self.popup('--report', 'nowhere/r.json', code=1))

    def test_replaces_a_file(self):
        for name in ('d.png', 'd.npy', 'd.exr', 'd.tif'):
            with open(self.path(name), 'wb') as file:
                file.write(b'old')
            self.popup('--relations', RELATIONS, '--depth', name)
            self.assertGreater(os.path.getsize(self.path(name)), 100)
        self.assertFalse([name for name in os.listdir(self.folder) if '.new-' in name])


if __name__ == '__main__':
    unittest.main()
