#!/usr/bin/python3
"""OpenRaster files and Krita documents: names and pixels of their layers; what is said about those that are damaged.

layered/krita.ora and krita.kra were saved by Krita 5.1.5 (the latter without profiles and preview, to be small),
layered/mypaint.ora by MyPaint 2.0.1: the page of tests/cli/pictures.py, with the scribbles in a group and half
transparent; Krita's group and MyPaint's scribbles are hidden.  Other files are written here.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import io
import os
import random
import re
import resource
import subprocess
import sys
import tempfile
import unittest
import zipfile

import numpy as np
from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path += [os.path.join(os.path.dirname(HERE), 'cli')]
from pictures import HEIGHT, WIDTH, drawing, scribbles, write_ora  # noqa: E402

READER = os.environ['READ_PICTURES']


def png(picture):
    data = io.BytesIO()
    picture.save(data, 'PNG')
    return data.getvalue()


def colour(size, rgba):
    return Image.new('RGBA', size, rgba)


def lzf(data):
    """Krita's compression: a copy for each run of one value, and literal bytes between them."""
    out, literal, place = bytearray(), bytearray(), 0

    def flush():
        for i in range(0, len(literal), 32):
            out.extend([len(literal[i:i + 32]) - 1])
            out.extend(literal[i:i + 32])
        literal.clear()

    while place < len(data):
        run = 1
        while place + run < len(data) and run < 264 and data[place + run] == data[place]:
            run += 1
        literal.append(data[place])
        place += 1
        if run > 3:
            flush()
            length = run - 3
            out.extend([length << 5, 0] if length < 7 else [0xe0, length - 7, 0])
            place += run - 1
    flush()
    return bytes(out)


def tile(x, y, pixels, packed):
    """64 x 64 pixels R,G,B,A."""
    bgra = pixels[..., [2, 1, 0, 3]]
    planes = np.moveaxis(bgra, 2, 0).tobytes()
    data = b'\1' + lzf(planes) if packed else b'\0' + bgra.tobytes()
    return f'{x},{y},LZF,{len(data)}\n'.encode() + data


def tiles(*list_of_tiles):
    return (f'VERSION 2\nTILEWIDTH 64\nTILEHEIGHT 64\nPIXELSIZE 4\nDATA {len(list_of_tiles)}\n'.encode() +
            b''.join(list_of_tiles))


def write_kra(path, size, layers, entries, name='page'):
    """Layers are attributes of XML elements, the front one first; entries are those of NAME/layers."""
    xml = (f'<?xml version="1.0"?><!DOCTYPE DOC PUBLIC "-//KDE//DTD krita 2.0//EN" "krita-2.0.dtd"><DOC><IMAGE '
           f'name="{name}" width="{size[0]}" height="{size[1]}" colorspacename="RGBA"><layers>{layers}</layers></IMAGE>'
           '</DOC>')
    with zipfile.ZipFile(path, 'w') as file:
        file.writestr('mimetype', 'application/x-krita')
        file.writestr('maindoc.xml', xml)
        for entry, data in entries.items():
            file.writestr(f'{name}/layers/{entry}', data)


def paint_layer(name, filename, more=''):
    return f'<layer name="{name}" nodetype="paintlayer" colorspacename="RGBA" filename="{filename}" {more}/>'


class Test(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def parts(self, path, size=(WIDTH, HEIGHT)):
        """The parts of a file as (name, pixels in [0,255]) or (error, None)."""
        with tempfile.TemporaryDirectory() as out:
            lines = subprocess.run([READER, path, out], check=True, capture_output=True, text=True,
                                   timeout=200).stdout.split('\n')[:-1]
            found = []
            for number, line in enumerate(lines):
                name = os.path.join(out, str(number))
                pixels = np.fromfile(name, np.float32).reshape(size[1], size[0], 4) * 255 \
                    if os.path.exists(name) else None
                found.append((line, pixels))
        return found

    def part(self, path, name, size=(WIDTH, HEIGHT)):
        found = [pixels for part, pixels in self.parts(path, size) if part == name]
        self.assertEqual(len(found), 1, f'{name} in {self.parts(path, size)}')
        return found[0]

    def same(self, found, wanted, off=0.51):
        """Alpha is the same, and so is colour where there is any."""
        wanted = np.asarray(wanted, float)
        np.testing.assert_allclose(found[..., 3], wanted[..., 3], atol=off)
        seen = wanted[..., 3] > 0
        np.testing.assert_allclose(found[seen], wanted[seen], atol=off)

    def refused(self, path, message):
        """One sentence, that names the file."""
        lines = [line for line, pixels in self.parts(path) if pixels is None]
        self.assertEqual(len(lines), 1, lines)
        self.assertRegex(lines[0], f'^Cannot read "{re.escape(path)}": {message}')


class SavedByPrograms(Test):
    def check(self, name, names):
        path = os.path.join(HERE, 'layered', name)
        self.assertEqual([part for part, pixels in self.parts(path) if pixels is not None], names)
        self.same(self.part(path, 'drawing'), drawing().convert('RGBA'))
        self.same(self.part(path, 'scribbles'), scribbles())

    def test_krita_ora(self):
        self.check('krita.ora', ['', 'drawing', 'lettering', 'depth', 'scribbles'])

    def test_krita_kra(self):
        self.check('krita.kra', ['', 'drawing', 'depth', 'scribbles'])
        path = os.path.join(HERE, 'layered', 'krita.kra')
        self.refused(path, 'its layer "lettering": it is no paint layer; convert it to one, or save the page as ORA or '
                           'PSD')

    def test_mypaint_ora(self):
        self.check('mypaint.ora', ['', 'background', 'depth', 'scribbles', 'drawing'])

    def test_merged_picture(self):
        """The drawing alone is visible in Krita's file."""
        for name in ('krita.ora', 'krita.kra'):
            self.same(self.part(os.path.join(HERE, 'layered', name), ''), drawing().convert('RGBA'))


def over(below, above, opacity=1, multiply=False):
    """Premultiplied in [0,1]; both W3C's formulae, written out for straight colours."""
    a, b = above[..., 3:] * opacity, below[..., 3:]
    source = np.divide(above[..., :3], above[..., 3:], out=np.zeros_like(above[..., :3]), where=above[..., 3:] > 0)
    behind = np.divide(below[..., :3], b, out=np.zeros_like(below[..., :3]), where=b > 0)
    mixed = (1 - b) * source + b * (source * behind if multiply else source)
    alpha = a + b * (1 - a)
    return np.concatenate([a * mixed + (1 - a) * b * behind, alpha], 2)


def premultiplied(picture, x=0, y=0):
    page = Image.new('RGBA', (WIDTH, HEIGHT))
    page.paste(picture, (x, y))
    values = np.asarray(page, float) / 255
    values[..., :3] *= values[..., 3:]
    return values


def straight(values):
    colours = np.divide(values[..., :3], values[..., 3:], out=np.zeros_like(values[..., :3]),
                        where=values[..., 3:] > 0)
    return 255 * np.concatenate([colours, values[..., 3:]], 2)


class OpenRaster(Test):
    red, blue = colour((30, 20), (255, 0, 0, 255)), colour((40, 30), (40, 90, 255, 128))

    def write(self, xml, entries, name='page.ora', **more):
        write_ora(self.path(name), (WIDTH, HEIGHT), xml, {key: png(picture) if isinstance(picture, Image.Image)
                                                          else picture for key, picture in entries.items()}, **more)
        return self.path(name)

    def test_offsets(self):
        """Layers that are smaller than the page, or larger, in stacks with offsets of their own."""
        path = self.write('<stack><stack name="a" x="10" y="-5"><stack name="b" x="3"><layer name="inner" '
                          'src="data/0.png" x="2" y="1"/></stack></stack><layer name="large" src="data/1.png" x="-7" y="-9"/><layer '
                          'name="gone" src="data/0.png" x="500" y="2"/></stack>',
                          {'data/0.png': self.red, 'data/1.png': colour((200, 150), (1, 2, 3, 255))})
        self.same(self.part(path, 'inner'), straight(premultiplied(self.red, 15, -4)))
        self.same(self.part(path, 'a'), straight(premultiplied(self.red, 15, -4)))
        self.same(self.part(path, 'large'), colour((WIDTH, HEIGHT), (1, 2, 3, 255)))
        self.assertEqual(self.part(path, 'gone').any(), False)

    def test_composites(self):
        """A group shows what is visible in it; so does a page without a merged picture.  A layer of its own is what was
        painted."""
        grey = colour((50, 50), (200, 100, 50, 255))
        path = self.write('<stack><layer name="hidden" visibility="hidden" src="data/2.png"/><stack name="group" '
                          'opacity="0.5"><layer name="top" composite-op="svg:multiply" src="data/1.png" x="5" y="6" '
                          'opacity="0.25"/><layer name="bottom" src="data/0.png"/></stack><layer name="page" '
                          'src="data/2.png" x="20"/></stack>',
                          {'data/0.png': self.red, 'data/1.png': self.blue, 'data/2.png': grey})
        group = over(premultiplied(self.red), premultiplied(self.blue, 5, 6), 0.25, multiply=True)
        self.same(self.part(path, 'group'), straight(group))
        self.same(self.part(path, ''), straight(over(premultiplied(grey, 20), group, 0.5)))
        self.same(self.part(path, 'top'), straight(premultiplied(self.blue, 5, 6)))
        self.same(self.part(path, 'hidden'), straight(premultiplied(grey)))

    def test_grey_layers(self):
        path = self.write('<stack><layer name="drawing" src="d.png"/></stack>', {'d.png': drawing()})
        self.same(self.part(path, 'drawing'), drawing().convert('RGBA'))

    def test_names(self):
        """Entities and other alphabets; the zip's other entries do not matter."""
        path = self.write('<stack><layer name="a &amp; b &#x416; ß" src="data/ß.png"/></stack>',
                          {'data/ß.png': self.red, '../evil': b'x'})
        self.same(self.part(path, 'a & b Ж ß'), straight(premultiplied(self.red)))

    def test_layers_that_cannot_be_read(self):
        """They are in nobody's way unless they are wanted."""
        for attributes, message in (('src="data/9.png"', 'the file has no data/9.png'),
                                    ('src="data/0.svg"', 'it is stored as "data/0.svg", and only PNG can be read'),
                                    ('', 'it is stored as "", and only PNG can be read'),
                                    ('src="data/bad.png"', 'it is damaged, or no PNG')):
            path = self.write(f'<stack><layer name="bad" {attributes}/><layer name="drawing" src="data/0.png"/>'
                              '</stack>',
                              {'data/0.png': self.red, 'data/0.svg': b'<svg/>', 'data/bad.png': b'GIF89a',
                               'mergedimage.png': self.red})
            self.same(self.part(path, 'drawing'), straight(premultiplied(self.red)))
            self.refused(path, f'its layer "bad": {re.escape(message)}')

    def test_damaged_descriptions(self):
        layer = '<layer name="drawing" src="data/0.png"/>'
        for xml, message in (('<stack>' + layer, r'its stack.xml is damaged, in line [0-9]'),
                             ('<pile/>', 'its stack.xml has no layers'),
                             ('<stack>' * 500 + layer + '</stack>' * 500, 'its stack.xml is damaged .*nested too deep'),
                             ('<stack>' + ' ' * (5 << 20) + layer + '</stack>', 'its stack.xml is too large')):
            self.refused(self.write(xml, {'data/0.png': self.red}), message)
        for width, height in ((0, 5), (-3, 5), (20001, 5), ('1e300', 5), ('nan', 'x'), ('', '')):
            path = self.write(f'<stack>{layer}</stack>', {'data/0.png': self.red}, sides=(width, height))
            self.refused(path, r'it has -?\d+ x -?\d+ pixels; width and height must be from 1 to 20000')
        path = self.write('<stack><layer name="far" src="data/0.png" x="1e12"/></stack>',
                          {'data/0.png': self.red, 'mergedimage.png': self.red})
        self.refused(path, 'its layer "far": it is too large or too far outside')

    def test_other_zips(self):
        with zipfile.ZipFile(self.path('text.zip'), 'w') as file:
            file.writestr('a.txt', 'text')
        self.refused(self.path('text.zip'), 'it is a zip file, but neither OpenRaster')
        path = self.write('<stack/>', {})
        with open(path, 'rb') as file:
            data = file.read()
        with open(path, 'wb') as file:
            file.write(data[:-30])
        self.refused(path, 'it is a damaged or truncated zip file')

    def test_zip_bomb(self):
        """A hundred megabytes of zeros where a layer should be, or after its pixels, need neither memory nor time."""
        bomb = bytes(100 << 20)
        path = self.write('<stack><layer name="zeros" src="data/0.png"/></stack>',
                          {'data/0.png': bomb, 'mergedimage.png': png(self.red) + bomb}, compressed=True)
        del bomb
        self.same(self.part(path, ''), straight(premultiplied(self.red)))
        self.refused(path, 'its layer "zeros": it is damaged, or no PNG')


class Krita(Test):
    def test_tiles(self):
        """Tiles that are packed or not, beyond the edges of the page, moved with the layer; elsewhere the layer's own
        colour."""
        noise = np.random.default_rng(1).integers(0, 256, (64, 64, 4), np.uint8)
        flat = np.full((64, 64, 4), (9, 8, 7, 255), np.uint8)
        half = flat.copy()
        half[20:, ::3] = (1, 2, 3, 4)
        layer = paint_layer('drawing', 'layer2', 'x="5" y="-3" visible="0"')
        write_kra(self.path('page.kra'), (WIDTH, HEIGHT), layer, {
            'layer2': tiles(tile(0, 0, noise, False), tile(64, 0, half, True), tile(-64, 0, flat, True),
                            tile(640, -640, noise, False)),
            'layer2.defaultpixel': bytes([30, 20, 10, 255])})
        wanted = np.empty((HEIGHT, WIDTH, 4))
        wanted[:] = (10, 20, 30, 255)
        wanted[:61, 5:69] = noise[3:]
        wanted[:61, 69:] = half[3:, :WIDTH - 69]
        wanted[:61, :5] = flat[3:, -5:]
        found = self.part(self.path('page.kra'), 'drawing')
        np.testing.assert_allclose(found, wanted, atol=0.01)
        self.assertEqual(self.part(self.path('page.kra'), '').any(), False)  # it is hidden, and there is no other

    def test_layers_that_cannot_be_read(self):
        other = '<layer name="deep" nodetype="paintlayer" colorspacename="RGBA16" filename="a"/>'
        for layer, entries, message in (
                (other, {}, 'its layer "deep": it has other colours than RGB in 8 bits; save the page as ORA or PSD'),
                (paint_layer('lost', 'a'), {}, 'its layer "lost": the file has no page/layers/a'),
                (paint_layer('old', 'a'), {'a': b'VERSION 1\n'}, 'its layer "old": it is stored in an unknown way')):
            write_kra(self.path('page.kra'), (WIDTH, HEIGHT), layer, {'b': tiles(), **entries})
            self.assertIn(message, '\n'.join(line for line, pixels in self.parts(self.path('page.kra'))))

    def test_damaged_tiles(self):
        """Random bytes, and tiles whose sizes or places are absurd."""
        good = tiles(tile(0, 0, np.full((64, 64, 4), 7, np.uint8), True))
        chance = random.Random(5)
        cases = [good[:-1], good.replace(b'DATA 1', b'DATA 2'), good.replace(b'DATA 1', b'DATA 99999999'),
                 good.replace(b'LZF,', b'LZF,9999999'), good.replace(b'\n0,0,', b'\nx,0,')]
        for i in range(60):
            data = bytearray(good)
            for k in range(chance.randint(1, 4)):
                data[chance.randrange(good.index(b'LZF') + 8, len(data))] = chance.randrange(256)
            cases.append(bytes(data))
        for number, data in enumerate(cases):
            write_kra(self.path(f'{number}.kra'), (WIDTH, HEIGHT), paint_layer('bad', 'a'), {'a': data})
        answers = subprocess.run([READER], check=True, capture_output=True, text=True, timeout=200,
                                 input=''.join(self.path(f'{i}.kra') + '\n' for i in range(len(cases)))).stdout
        answers = answers.splitlines()
        self.assertEqual(len(answers), len(cases))
        for number, answer in enumerate(answers):
            self.assertTrue(answer.endswith('its layer "bad": it is damaged or truncated.') or
                            number >= 5 and answer == f'good {WIDTH} {HEIGHT} 2', f'{number}: {answer}')


if __name__ == '__main__':
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    unittest.main()
