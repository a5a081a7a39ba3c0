"""Shared by the measurements: drawings of tests/cases as pages of any size, one core, tables in results/.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import math
import os
import platform
import re
import subprocess
import sys

import numpy as np
from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
CASES = os.path.join(HERE, '..', 'cases')
NO_SHAPE = 255  # in truth.png


# ------------------------------------------------------------------ pages: what the programs read

def write_pam(path, pixels):
    height, width = pixels.shape[:2]
    depth = pixels.shape[2] if pixels.ndim == 3 else 1
    with open(path + '.new', 'wb') as f:
        f.write(f'P7\nWIDTH {width}\nHEIGHT {height}\nDEPTH {depth}\nMAXVAL 255\nENDHDR\n'.encode())
        f.write(np.ascontiguousarray(pixels, np.uint8).tobytes())
    os.replace(path + '.new', path)


def enlarged(picture, megapixels):
    scale = math.sqrt(1e6 * megapixels / (picture.width * picture.height))
    return picture.resize([round(scale * side) for side in picture.size], Image.LANCZOS)


def true_colours(case):
    """The right colour of every pixel; transparent where it is unknown."""
    shape = np.array(Image.open(os.path.join(case, 'truth.png')))
    with open(os.path.join(case, 'truth.json')) as f:
        facts = json.load(f)
    table = np.zeros((NO_SHAPE + 1, 4), np.uint8)
    for i in facts['shapes']:
        table[i] = [*facts['colours'][str(i)], 255]
    return table[shape]


def make_page(name, megapixels, folder):
    """Files of a case: the drawing enlarged, scribbles and truth as they are."""
    os.makedirs(folder, exist_ok=True)
    case = os.path.join(CASES, name)
    pages = {
        os.path.join(folder, f'{name}-{megapixels:g}.pam'):
            lambda: np.array(enlarged(Image.open(os.path.join(case, 'drawing.png')).convert('L'), megapixels)),
        os.path.join(folder, f'{name}-scribbles.pam'):
            lambda: np.array(Image.open(os.path.join(case, 'scribbles.png')).convert('RGBA')),
        os.path.join(folder, f'{name}-truth.pam'): lambda: true_colours(case)}
    for path, make in pages.items():
        if not os.path.exists(path):
            write_pam(path, make())
    return list(pages)


def make_relations(name, page, folder):
    """A file with a case's relations, at the size of the page."""
    with open(page, 'rb') as f:
        head = dict(line.split() for line in f.read(100).split(b'\n') if line.count(b' ') == 1)
    with Image.open(os.path.join(CASES, name, 'drawing.png')) as drawing:
        scale = int(head[b'WIDTH']) / drawing.width, int(head[b'HEIGHT']) / drawing.height
    path = os.path.join(folder, os.path.basename(page)[:-4] + '.txt')
    with open(os.path.join(CASES, name, 'arrows.txt')) as arrows, open(path, 'w') as relations:
        for line in filter(str.strip, arrows):
            x0, y0, x1, y1 = (float(v) * scale[k % 2] for k, v in enumerate(line.split()))
            relations.write(f'{x0:.2f},{y0:.2f} > {x1:.2f},{y1:.2f}\n')
    return path


# ------------------------------------------------------------------ runs

def pin():
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


def run(program, options, *arguments, one_core=True):
    """The JSON that a program prints."""
    command = [os.path.join(options.build, 'tests', 'bench', program), *map(str, arguments)]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, preexec_fn=pin if one_core else None)
    if done.returncode:
        sys.exit(f'{" ".join(command)}: exit status {done.returncode}')
    return json.loads(done.stdout)


# ------------------------------------------------------------------ tables

def milliseconds(*keys):
    return lambda r: sum(1000 * r[key] for key in keys) if all(key in r for key in keys) else None


def figure(key):
    return lambda r: r.get(key)


def row(name, cells):
    return f'{name:24}' + ''.join(f'{cell:>10}' for cell in cells)


def table(title, columns, results):
    yield title
    yield row('', [name for name, _, _ in columns])
    for size in sorted({r['megapixels'] for r in results}):
        for r in results:
            if r['megapixels'] == size:
                values = [(value(r), form) for _, form, value in columns]
                yield row(f'{r["case"]}, {size:g} MP', ['-' if v is None else format(v, form) for v, form in values])
    yield ''


def processor():
    with open('/proc/cpuinfo') as f:
        names = [line.split(':', 1)[1].strip() for line in f if line.startswith('model name')]
    return names[0] if names else platform.machine()


def version():
    with open(os.path.join(HERE, '..', '..', 'meson.build')) as f:
        return re.search(r"version: '([^']+)'", f.read()).group(1)


def save(lines, kind):
    """Prints the lines; `kind` (None: not kept) is the first part of the file's name."""
    print('\n'.join(lines))
    if kind:
        file = re.sub(r'[^A-Za-z0-9.]+', '-', f'{kind}-{version()}-{processor()}') + '.txt'
        with open(os.path.join(HERE, 'results', file), 'w') as f:
            f.write('\n'.join(lines).rstrip() + '\n')
