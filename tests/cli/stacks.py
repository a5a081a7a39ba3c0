"""Reads stacks of layers by the specifications of their formats, and composites them, independently of celdepth.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import io
import os
import re
import subprocess
import xml.etree.ElementTree as ElementTree
import zipfile

import numpy as np
from PIL import Image


def canvas_of(pixels, x, y, width, height):
    canvas = np.zeros((height, width, 4))
    canvas[y:y + pixels.shape[0], x:x + pixels.shape[1]] = pixels
    return canvas


def picture(file):
    """R, G, B, A in [0,1], straight alpha."""
    with Image.open(file) as image:
        return np.array(image.convert('RGBA')) / 255


def read_open_raster(path):
    """([(name, canvas)] from back to front, merged picture)."""
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        image = ElementTree.fromstring(archive.read('stack.xml'))
        width, height = int(image.get('w')), int(image.get('h'))
        layers = [(layer.get('name'), canvas_of(picture(io.BytesIO(archive.read(layer.get('src')))),
                                                int(layer.get('x')), int(layer.get('y')), width, height))
                  for layer in image.find('stack')]
        return layers[::-1], picture(io.BytesIO(archive.read('mergedimage.png')))


def read_folder(path):
    return [(name, picture(os.path.join(path, name))) for name in sorted(os.listdir(path)) if name.endswith('.png')]


def read_psd(path):
    """([(name, canvas)] from back to front, merged picture), all premultiplied: names, boxes and the merged picture by
    Pillow, layers by oiiotool."""
    data = subprocess.run(['oiiotool', '-a', '--dumpdata', path], check=True, capture_output=True, text=True).stdout
    layers = []
    with Image.open(path) as image:
        merged = np.array(image.convert('RGBA')) / 255
        for (name, _, (left, top, right, bottom), *_), part in zip(image.layers, data.split(' subimage ')[2:]):
            pixels = np.array([numbers.split() for numbers in re.findall(r'\(([-0-9. e]+)\)$', part, re.M)], float)
            layers.append((name, canvas_of(pixels.reshape(bottom - top, right - left, 4), left, top, *image.size)))
    # The merged picture lies on white.
    return layers, np.concatenate([merged[..., :3] - (1 - merged[..., 3:]), merged[..., 3:]], 2)


def lengths_of_psd(path):
    """How many bytes the section of layers has, by its own number, and by those of its parts."""
    with open(path, 'rb') as file:
        data = file.read()
    at = 26
    for _ in range(2):
        at += 4 + int.from_bytes(data[at:at + 4], 'big')
    section, layers = (int.from_bytes(data[k:k + 4], 'big') for k in (at, at + 4))
    mask = int.from_bytes(data[at + 8 + layers:at + 12 + layers], 'big')
    return section, 4 + layers + 4 + mask


def read_exr(path, width, height):
    """([(name, canvas)] from back to front, premultiplied as they are in the file, and what oiiotool says of it)."""
    info = subprocess.run(['oiiotool', '--info', '-v', '-a', path], check=True, capture_output=True, text=True).stdout
    data = subprocess.run(['oiiotool', '-a', '--dumpdata', path], check=True, capture_output=True, text=True).stdout
    layers = []
    for name, part in zip(re.findall(r'oiio:subimagename: "(.*)"', info), data.split(' subimage ')[1:]):
        numbers = re.sub(r'Pixel \(|[,:)]', ' ', part).split('\n')[1:]
        pixels = np.array([line.split() for line in numbers if line.strip()], float)
        canvas = np.zeros((height, width, 4))
        canvas[pixels[:, 1].astype(int), pixels[:, 0].astype(int)] = pixels[:, 2:]
        layers.append((name, canvas))
    return layers, info


def premultiplied(rgba):
    return np.concatenate([rgba[..., :3] * rgba[..., 3:], rgba[..., 3:]], 2)


def composite(layers):
    """Each premultiplied canvas over those before it."""
    result = np.zeros_like(layers[0])
    for layer in layers:
        result = layer + (1 - layer[..., 3:]) * result
    return result


def decode(encoded):
    """sRGB to linear light."""
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def encode(linear):
    """Linear light to sRGB."""
    return np.where(linear <= 0.0031308, linear * 12.92, 1.055 * np.maximum(linear, 0) ** (1 / 2.4) - 0.055)
