"""Shared by the tests of the command: a small drawing with its layers, and files to write and to read.

The readers are not ours: Pillow, numpy, and oiiotool for EXR.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import struct
import subprocess
import tempfile
import unittest
import zipfile

import numpy as np
from PIL import Image, ImageDraw

COMMAND = os.environ.get('CELDEPTH', 'celdepth')

WIDTH, HEIGHT = 96, 64
RED, BLUE, GREEN = (255, 0, 0), (0, 0, 255), (0, 160, 0)

# A point of each part of the page: box A, box B before it, and the page.
IN_A, IN_B, IN_PAGE = (20, 20), (70, 45), (4, 4)
RELATIONS = '70,45 > 20,20; 20,20 > 4,4'


def drawing():
    """Two boxes; the right one hides a corner of the left one."""
    page = Image.new('L', (WIDTH, HEIGHT), 255)
    draw = ImageDraw.Draw(page)
    draw.rectangle([10, 10, 60, 45], fill=255, outline=0, width=3)
    draw.rectangle([40, 25, 85, 57], fill=255, outline=0, width=3)
    return page


def scribbles():
    layer = Image.new('RGBA', (WIDTH, HEIGHT))
    draw = ImageDraw.Draw(layer)
    draw.line([(16, 20), (32, 22)], fill=RED + (255,), width=3)
    draw.line([(48, 40), (78, 48)], fill=BLUE + (255,), width=3)
    draw.line([(3, 3), (90, 4), (91, 60)], fill=GREEN + (255,), width=3)
    return layer


class Test(unittest.TestCase):
    """A test in a folder of its own with drawing.png and scribbles.png."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        drawing().save(self.path('drawing.png'))
        scribbles().save(self.path('scribbles.png'))

    def path(self, name):
        return os.path.join(self.folder, name)

    def celdepth(self, *words, code=0, **environment):
        """Runs the command in the folder; returns its messages."""
        result = subprocess.run([COMMAND, *words], cwd=self.folder, env={**os.environ, **environment},
                                stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=100)
        self.assertEqual(result.returncode, code, f'{words}: {result.stdout}{result.stderr}')
        if code == 0:
            self.assertNotIn('WARNING', result.stderr)
        return result.stdout + result.stderr

    def popup(self, *words, code=0, **environment):
        return self.celdepth('popup', 'drawing.png', '--scribbles', 'scribbles.png', *words, code=code, **environment)

    def fails(self, *words, naming):
        """Exit code 1, a message that names the cause, and nothing written."""
        before = set(os.listdir(self.folder))
        self.assertIn(naming, self.celdepth(*words, code=1))
        self.assertEqual(set(os.listdir(self.folder)), before)

    def picture(self, name):
        with Image.open(self.path(name)) as picture:
            return np.array(picture)

    def channel(self, name, channel):
        """One channel of an EXR, read by oiiotool."""
        tiff = self.path('channel.tif')
        subprocess.run(['oiiotool', self.path(name), '--ch', channel, '-d', 'float', '-o', tiff], check=True)
        values = self.picture('channel.tif')
        os.unlink(tiff)
        return values


def at(values, place):
    return values[place[1], place[0]]


def png_chunks(path):
    """The names of the chunks, and the header."""
    with open(path, 'rb') as file:
        data = file.read()
    names, place, header = [], 8, b''
    while place < len(data):
        length, name = struct.unpack('>I4s', data[place:place + 8])
        names.append(name.decode())
        header = header or data[place + 8:place + 8 + length]
        place += 12 + length
    return names, struct.unpack('>IIBBBBB', header)


def name_in_psd(name):
    """Padded Latin 1, with "?" for other letters, as Krita has it; of a name with accents also the Unicode."""
    short = name.encode('latin-1', 'replace')
    label = bytes([len(short)]) + short
    label += bytes(-len(label) % 4)
    if name.isascii():
        return label
    units = name.encode('utf-16-be')
    units = struct.pack('>I', len(units) // 2) + units
    units += bytes(-len(units) % 4)
    return label + b'8BIMluni' + struct.pack('>I', len(units)) + units


def write_exr(path, values):
    """A float EXR of height x width x R, G, B, A in linear light."""
    with tempfile.TemporaryDirectory() as folder:
        planes = [os.path.join(folder, name + '.tif') for name in 'RGBA']
        for k, plane in enumerate(planes):
            Image.fromarray(np.float32(values[..., k])).save(plane)
        subprocess.run(['oiiotool', planes[0], *(word for plane in planes[1:] for word in (plane, '--chappend')),
                        '--chnames', 'R,G,B,A', '-d', 'float', '-o', path], check=True)


def write_psd(path, size, layers):
    """A layered PSD: layers are (name, left, top, RGBA picture), the lowest first."""
    records, pixels = b'', b''
    for name, left, top, layer in layers:
        planes = [layer.getchannel(c).tobytes() for c in 'ARGB']
        records += struct.pack('>iiiiH', top, left, top + layer.height, left + layer.width, 4)
        for number, plane in zip((-1, 0, 1, 2), planes):
            records += struct.pack('>hI', number, len(plane) + 2)
            pixels += struct.pack('>H', 0) + plane
        extra = struct.pack('>II', 0, 0) + name_in_psd(name)
        records += b'8BIMnorm' + bytes([255, 0, 0, 0]) + struct.pack('>I', len(extra)) + extra
    info = struct.pack('>h', len(layers)) + records + pixels
    info += bytes(len(info) % 2)
    info = struct.pack('>I', len(info)) + info + struct.pack('>I', 0)
    merged = Image.new('RGB', size, 'white')
    with open(path, 'wb') as file:
        file.write(b'8BPS' + struct.pack('>H6xHIIHH', 1, 3, size[1], size[0], 8, 3))
        file.write(struct.pack('>III', 0, 0, len(info)) + info)
        file.write(struct.pack('>H', 0) + b''.join(merged.getchannel(c).tobytes() for c in 'RGB'))


def write_ora(path, size, stack, entries, sides=None, compressed=False):
    """An OpenRaster file: the XML of its stack, and its other entries; the same bytes each time.  `sides` are what it
    says about its size."""
    width, height = sides or size
    kind = zipfile.ZIP_DEFLATED if compressed else zipfile.ZIP_STORED
    entries = {'mimetype': 'image/openraster', 'stack.xml': f'<?xml version="1.0" encoding="UTF-8"?><image '
               f'version="0.0.3" w="{width}" h="{height}">{stack}</image>', **entries}
    with zipfile.ZipFile(path, 'w') as file:
        for name, data in entries.items():
            file.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_STORED if name == 'mimetype' else kind)
