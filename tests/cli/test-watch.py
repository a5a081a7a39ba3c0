#!/usr/bin/python3
"""--watch: a page that is saved in the ways of painting programs is made again, and only what changed.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import io
import json
import os
import shutil
import signal
import subprocess
import threading
import time
import unittest

import numpy as np
from PIL import Image, ImageDraw

from pictures import BLUE, COMMAND, HEIGHT, IN_B, WIDTH, Test, at, drawing, scribbles, write_ora

CASES = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'cases')
LONGEST = 60  # seconds until something must have happened, on a machine that is busy


class Watch(Test):
    def setUp(self):
        super().setUp()
        self.write('page.ora')
        self.process = None
        self.addCleanup(self.end)

    def end(self):
        if self.process:
            self.process.kill()
            self.process.wait()
            self.reader.join()
            self.process.stderr.close()

    def write(self, name, colour=BLUE, side=1):
        """A page whose box B has this colour."""
        strokes = scribbles().resize((side * WIDTH, side * HEIGHT), Image.NEAREST)
        ImageDraw.Draw(strokes).line([(48 * side, 40 * side), (78 * side, 48 * side)], fill=colour + (255,), width=3)
        entries = {}
        for entry, picture in (('d.png', drawing().resize(strokes.size, Image.NEAREST)), ('s.png', strokes)):
            data = io.BytesIO()
            picture.save(data, 'PNG')
            entries[entry] = data.getvalue()
        write_ora(self.path(name), strokes.size, '<stack><layer name="scribbles" src="s.png"/><layer name="drawing" '
                                                 'src="d.png"/></stack>', entries)

    def start(self, *words):
        self.process = subprocess.Popen([COMMAND, *words, '--watch'], cwd=self.folder, stderr=subprocess.PIPE,
                                        text=True)
        self.lines = []
        self.reader = threading.Thread(target=lambda: self.lines.extend(iter(self.process.stderr.readline, '')))
        self.reader.start()
        self.wait_for('Made in', 1)

    def lines_with(self, text):
        return [line for line in self.lines if text in line]

    def wait_for(self, text, times):
        end = time.monotonic() + LONGEST
        while len(self.lines_with(text)) < times:
            self.assertLess(time.monotonic(), end, f'{text}: {self.lines}')
            self.assertIsNone(self.process.poll(), self.lines)
            time.sleep(0.02)

    def wait_for_colour(self, colour):
        """Until box B has this colour."""
        end = time.monotonic() + LONGEST
        while tuple(at(self.picture('labels.png'), IN_B))[:3] != colour:
            self.assertLess(time.monotonic(), end, self.lines)
            time.sleep(0.02)

    def ends(self):
        self.process.send_signal(signal.SIGINT)
        self.assertEqual(self.process.wait(LONGEST), 0)

    def test_saving(self):
        """By renaming, in place, and by deleting the old file first."""
        self.start('segment', 'page.ora', '--labels', 'labels.png')
        self.wait_for_colour(BLUE)
        self.write('new.ora', (200, 0, 200))
        os.replace(self.path('new.ora'), self.path('page.ora'))
        self.wait_for_colour((200, 0, 200))
        self.write('page.ora', (0, 200, 200))
        self.wait_for_colour((0, 200, 200))
        os.rename(self.path('page.ora'), self.path('page.ora~'))
        time.sleep(0.5)
        self.write('page.ora', (90, 20, 10))
        self.wait_for_colour((90, 20, 10))
        self.ends()
        self.assertEqual(self.lines_with('Cannot read'), [])

    def test_half_saved(self):
        """It waits for the rest, and is patient with a pause."""
        self.start('segment', 'page.ora', '--labels', 'labels.png')
        self.write('new.ora', (200, 0, 200))
        with open(self.path('new.ora'), 'rb') as file:
            data = file.read()
        with open(self.path('page.ora'), 'wb') as file:
            for part in (data[:100], data[100:300], data[300:-20], data[-20:]):
                file.write(part)
                file.flush()
                time.sleep(0.6)
        self.wait_for_colour((200, 0, 200))
        self.ends()
        self.assertEqual(self.lines_with('Cannot read'), [])

    def test_damaged(self):
        """A file that stays damaged is reported, once, and does not end it."""
        self.start('segment', 'page.ora', '--labels', 'labels.png')
        with open(self.path('page.ora'), 'wb') as file:
            file.write(b'PK\3\4 and no more')
        self.wait_for('Cannot read "page.ora"', 1)
        self.wait_for_colour(BLUE)
        self.write('page.ora', (200, 0, 200))
        self.wait_for_colour((200, 0, 200))
        self.ends()
        self.assertEqual(len(self.lines_with('Cannot read')), 1)

    def test_remarks_return(self):
        """A page that is as it was before has the same remarks, also if one in between could not be used."""
        page = {}
        for name in ('drawing', 'scribbles'):
            with open(os.path.join(CASES, 'caterpillar', name + '.png'), 'rb') as file:
                page[name] = file.read()
        with Image.open(io.BytesIO(page['drawing'])) as picture:
            size = picture.size
        blank = io.BytesIO()
        Image.new('L', size, 255).save(blank, 'PNG')
        for name, lines in (('good.ora', page['drawing']), ('blank.ora', blank.getvalue())):
            write_ora(self.path(name), size, '<stack><layer name="scribbles" src="s.png"/><layer name="drawing" '
                                             'src="d.png"/></stack>', {'d.png': lines, 's.png': page['scribbles']})
        shutil.copy(self.path('good.ora'), self.path('page.ora'))
        self.start('segment', 'page.ora', '--labels', 'labels.png')
        first = self.lines[:]
        shutil.copy(self.path('blank.ora'), self.path('page.ora'))
        self.wait_for('Nothing was made', 1)
        middle = len(self.lines)
        shutil.copy(self.path('good.ora'), self.path('page.ora'))
        self.wait_for('Made in', 2)
        self.ends()
        self.assertGreater(len(first), 1)
        self.assertEqual(self.lines[middle:middle + len(first) - 1], first[:-1])

    def test_folders(self):
        """A folder that this run wrote is written again, but for what others put there; another's is refused."""
        self.start('popup', 'page.ora', '--layers', 'layers', '--wiggle', 'moving', '--frames', '2')
        with open(self.path('layers/mine.txt'), 'w', encoding='utf-8') as file:
            file.write('mine')
        self.write('new.ora', (200, 0, 200))
        os.replace(self.path('new.ora'), self.path('page.ora'))
        self.wait_for('Made in', 2)
        self.ends()
        self.assertEqual(sorted(name.split('-')[-1] for name in os.listdir(self.path('layers'))),
                         ['00a000.png', 'c800c8.png', 'ff0000.png', 'layers.json', 'mine.txt'])
        self.assertEqual(sorted(os.listdir(self.path('moving'))), ['000.png', '001.png'])
        self.assertIn('not empty', self.celdepth('popup', 'page.ora', '--layers', 'layers', '--watch', code=1))
        self.assertEqual([name for name in os.listdir(self.folder) if '.new-' in name], [])

    def test_own_results(self):
        """Results beside the page, and other files, do not make it run again."""
        self.start('segment', 'page.ora', '--labels', 'labels.png', '--report', 'report.json')
        for number in range(3):
            with open(self.path(f'other{number}'), 'wb') as file:
                file.write(b'x')
            time.sleep(0.4)
        self.ends()
        self.assertEqual(len(self.lines_with('Made in')), 1)

    def test_only_what_changed(self):
        """New relations leave the regions as they are; results are those of a run of its own."""
        self.write('page.ora', side=12)
        near, far = f'{70 * 12},{45 * 12} > {20 * 12},{20 * 12}', f'{20 * 12},{20 * 12} > {70 * 12},{45 * 12}'
        with open(self.path('r.txt'), 'w', encoding='utf-8') as file:
            file.write(near)
        self.start('popup', 'page.ora', '--relations-file', 'r.txt', '--levels', 'levels.npy', '--report',
                   'report.json')

        def seconds():
            with open(self.path('report.json'), encoding='utf-8') as file:
                return json.load(file)['seconds']

        first = seconds()
        with open(self.path('r.txt'), 'w', encoding='utf-8') as file:
            file.write(far)
        self.wait_for('Made in', 2)
        self.assertLess(seconds()['labels'], first['labels'] / 4)
        self.ends()
        self.celdepth('popup', 'page.ora', '--relations-file', 'r.txt', '--levels', 'again.npy')
        np.testing.assert_array_equal(np.load(self.path('levels.npy')), np.load(self.path('again.npy')))

    def test_many_pages(self):
        text = self.celdepth('popup', 'page.ora', '--watch', '--output-dir', 'out', code=2)
        self.assertIn('--watch shows one page', text)

    def test_vanished_layer(self):
        """A layer that is deleted is gone."""
        self.start('segment', 'page.ora', '--labels', 'labels.png')
        data = io.BytesIO()
        drawing().save(data, 'PNG')
        write_ora(self.path('new.ora'), (WIDTH, HEIGHT), '<stack><layer name="drawing" src="d.png"/></stack>',
                  {'d.png': data.getvalue()})
        os.replace(self.path('new.ora'), self.path('page.ora'))
        self.wait_for('no scribbles and no arrows', 1)
        self.ends()


if __name__ == '__main__':
    unittest.main()
