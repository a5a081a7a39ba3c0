#!/usr/bin/python3
"""Damaged files of every format: the reader does not crash, its memory is limited, and an error names the file.

  test-damaged.py [COPIES [SEED]]     damaged copies of each file; the same seed makes the same ones

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import zipfile

from PIL import Image

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path += [os.path.join(TOP, 'cli'), os.path.join(TOP, 'fuzz')]
from damage import damaged  # noqa: E402
from pictures import HEIGHT, WIDTH, drawing, scribbles, write_psd  # noqa: E402

READER = os.environ['READ_PICTURES']
MOST_MEMORY = float(os.environ['MOST_MEMORY'])  # MB of a process: 1024 for opening, 256 for reading, the program itself
REASON = r'(?!.*error)(?:it|its|there) .+\.'  # in our words, none of a library's
MOST_SECONDS = 200  # for one file, on a machine that is busy


def oiiotool(*words):
    subprocess.run(['oiiotool', *words], check=True)


def good_files(folder):
    """One file of each kind and way of storing; a list of paths."""
    def path(name):
        return os.path.join(folder, name)

    strokes, box, turned = scribbles(), scribbles().getbbox(), Image.Exif()
    page = drawing().convert('RGBA').crop((4, 4, WIDTH, HEIGHT))
    write_psd(path('layers.psd'), (WIDTH, HEIGHT),
              [('drawing', 4, 4, page), ('Čmáranice', box[0], box[1], strokes.crop(box))])
    strokes.save(path('plain.png'))
    strokes.quantize(8).save(path('palette.png'))
    drawing().convert('RGB').save(path('plain.jpg'))
    drawing().convert('RGB').save(path('progressive.jpg'), progressive=True)
    for name in ('plain.webp', 'plain.bmp'):
        drawing().convert('RGB').save(path(name))
    turned[274] = 3
    drawing().convert('RGB').save(path('turned.webp'), exif=turned)
    drawing().save(path('moving.gif'), save_all=True, append_images=[Image.new('L', (WIDTH, HEIGHT), 9)])
    for kind in ('tiff_lzw', 'tiff_deflate', 'packbits', 'raw'):
        strokes.save(path(f'{kind}.tif'), compression=kind)
    drawing().convert('1').save(path('fax.tif'), compression='group4')
    oiiotool(path('plain.png'), '--tile', '16', '16', '-o', path('tiled.tif'))
    for kind in ('zip', 'piz', 'b44', 'dwaa', 'rle'):
        oiiotool(path('plain.png'), '-d', 'half', '--compression', kind, '-o', path(f'{kind}.exr'))
    oiiotool(path('plain.png'), '--tile', '16', '16', '-o', path('tiled.exr'))
    oiiotool(path('plain.png'), '--attrib', 'oiio:subimagename', 'drawing', path('plain.png'), '--attrib',
             'oiio:subimagename', 'scribbles', '--siappendall', '-o', path('parts.exr'))
    for name in ('krita.ora', 'mypaint.ora', 'krita.kra'):
        shutil.copy(os.path.join(TOP, 'io', 'layered', name), folder)
    unpacked_krita(path('krita.kra'))
    return sorted(os.path.join(folder, name) for name in os.listdir(folder))


def unpacked_krita(path):
    """Makes Krita's document one of paint layers alone, stored so that damage reaches the layers, not the zip's own
    checksums."""
    with zipfile.ZipFile(path) as file:
        entries = {name: file.read(name) for name in file.namelist()}
    entries['maindoc.xml'] = re.sub(rb'<layer [^>]*nodetype="shapelayer"[^>]*/>', b'', entries['maindoc.xml'])
    with zipfile.ZipFile(path, 'w', zipfile.ZIP_STORED) as file:
        for name, data in entries.items():
            file.writestr(name, data)


class Watch(threading.Thread):
    """The most memory that a process of the reader ever took, in MB."""

    def __init__(self):
        super().__init__(daemon=True)
        self.most = 0

    def run(self):
        name = os.path.basename(READER)[:15]
        while True:
            for process in filter(str.isdigit, os.listdir('/proc')):
                try:
                    with open(f'/proc/{process}/status', encoding='utf-8', errors='replace') as file:
                        text = file.read()
                except OSError:
                    continue
                peak = re.search(r'VmHWM:\s*(\d+) kB', text)
                if text.split('\n', 1)[0].split('\t')[1] == name and peak:
                    self.most = max(self.most, int(peak[1]) // 1024)
            time.sleep(0.02)


def main():
    copies, seed = (int(word) for word in (sys.argv[1:] + ['20', '1'][len(sys.argv) - 1:]))
    failures, told = [], {'good': 0, 'bad': 0, 'crashed': 0}
    watch = Watch()
    watch.start()
    with tempfile.TemporaryDirectory() as folder, subprocess.Popen(
            [READER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, errors='replace') as reader:

        def answer(path):
            begin = time.monotonic()
            reader.stdin.write(path + '\n')
            reader.stdin.flush()
            line = reader.stdout.readline()
            if time.monotonic() - begin > MOST_SECONDS:
                failures.append(f'{path} took {time.monotonic() - begin:.0f} s')
            return line.rstrip('\n')

        files = good_files(folder)
        for path in files:
            if not answer(path).startswith(f'good {WIDTH} {HEIGHT} '):
                failures.append(f'{path} is good, but: {answer(path)}')
        for path in files:
            with open(path, 'rb') as file:
                data = file.read()
            for number in range(copies):
                name = os.path.join(folder, 'damaged' + os.path.splitext(path)[1])
                with open(name, 'wb') as file:
                    file.write(damaged(data, random.Random(f'{seed} {os.path.basename(path)} {number}')))
                line = answer(name)
                if line.startswith('good '):
                    told['good'] += 1
                elif re.fullmatch(f'Cannot read "{re.escape(name)}": {REASON}', line):
                    told['crashed' if 'decoding it crashed' in line else 'bad'] += 1
                else:
                    failures.append(f'{os.path.basename(path)}, copy {number} of seed {seed}: {line!r}')
                    if not line:
                        break
        # The reader lives, and reads good files after all that.
        if not answer(files[0]).startswith('good'):
            failures.append('a good file after damaged ones was not read')
        reader.stdin.close()
        if reader.wait() != 0:
            failures.append(f'the reader ended with {reader.returncode}')
    if watch.most > MOST_MEMORY:
        failures.append(f'{watch.most} MB of memory')
    print(f'{told}, {watch.most} MB at most')
    for failure in failures:
        print('FAILED:', failure)
    print(f'{sum(told.values())} passed, {len(failures)} failed')
    return bool(failures)


if __name__ == '__main__':
    sys.exit(main())
