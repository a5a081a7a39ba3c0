#!/usr/bin/python3
"""What a run writes never replaces what it reads, however the files are named: wrong usage, and nothing is changed.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import os
import shutil
import unittest

import numpy as np

from pictures import RELATIONS, Test, drawing, scribbles


class Overwriting(Test):
    def contents(self):
        out = {}
        for folder, _, names in os.walk(self.folder):
            for name in names:
                with open(os.path.join(folder, name), 'rb') as file:
                    out[os.path.join(folder, name)] = file.read()
        return out

    def refused(self, *words, naming):
        before = self.contents()
        self.assertIn(naming, self.celdepth(*words, code=2))
        self.assertEqual(self.contents(), before)

    def test_links(self):
        """A folder or a file by another name, also for files that are not there yet."""
        os.mkdir(self.path('pages'))
        shutil.move(self.path('drawing.png'), self.path('pages'))
        os.symlink('pages', self.path('linked'))
        os.symlink('scribbles.png', self.path('link.png'))
        os.link(self.path('scribbles.png'), self.path('hard.png'))
        words = 'popup', 'pages/drawing.png', '--scribbles', 'scribbles.png', '--relations', RELATIONS
        self.refused(*words, '--depth', 'linked/drawing.png', naming='--depth would overwrite "linked/drawing.png"')
        for name in ('link.png', 'hard.png', './linked/../scribbles.png'):
            self.refused(*words, '--shaded', name, naming=f'--shaded and --scribbles name the same file, "{name}"')
        self.refused(*words, '--shaded', 'linked/new.png', '--depth', 'pages/new.png',
                     naming='name the same file, "linked/new.png"')
        self.celdepth(*words, '--shaded', 'pages/new.png')

    def test_one_file_as_two_layers(self):
        os.symlink('scribbles.png', self.path('link.png'))
        os.link(self.path('scribbles.png'), self.path('hard.png'))
        for name in ('link.png', 'hard.png'):
            self.fails('popup', 'drawing.png', '--scribbles', 'scribbles.png', '--arrows', name, '--depth', 'd.png',
                       naming=f'"{name}" is given as --scribbles and as --arrows')

    def test_drawings_of_a_composition(self):
        with open(self.path('scene.json'), 'w', encoding='utf-8') as file:
            json.dump({'fragments': [{'drawing': 'drawing.png', 'scribbles': 'scribbles.png'}]}, file)
        self.refused('compose', 'scene.json', '--output', 'drawing.png', naming='--output would overwrite "drawing.png"')
        self.refused('compose', 'scene.json', '--output', 'a.png', '--levels', 'scribbles.png',
                     naming='--levels and --scribbles name the same file')

    def test_numbers(self):
        for name in ('b_1.png', 'b_2.png'):
            drawing().save(self.path(name))
        words = 'inbetween', 'b_1.png', 'b_2.png', '--scribbles', 'scribbles.png', '--output'
        self.refused(*words, 'b_#.png', '-n', '2', naming='--output would overwrite "b_1.png"')
        self.refused(*words, 'b.png', '-n', '2', '--scribbles-b', 'b_002.png',
                     naming='--output and --scribbles-b name the same file, "b_002.png"')

    def test_files_beside_others(self):
        drawing().save(self.path('m-texture.png'))
        self.refused('relief', 'm-texture.png', '--scribbles', 'scribbles.png', '--mesh', 'm.obj',
                     naming='--mesh would overwrite "m-texture.png"')
        np.save(self.path('levels.npy'), np.zeros((64, 96), np.float32))
        for name in ('hero_n.png', 'hero_o.png'):
            drawing().save(self.path(name))
            self.refused('shade', 'levels.npy', '--drawing', name, '--maps', 'hero.png', naming=f'"{name}"')
            self.refused('shade', 'levels.npy', '--drawing', 'drawing.png', '--shaded', name, '--maps', 'hero.png',
                         naming=f'"{name}"')

    def test_frames(self):
        """Results of a clip have names of their own, which frames, keys, relations and the report's picture may have."""
        os.mkdir(self.path('clip'))
        for frame in range(2):
            drawing().save(self.path(f'clip/labels_{frame:03d}.png'))
            drawing().save(self.path(f'f_{frame}.png'))
        scribbles().save(self.path('clip/levels_001.png'))
        with open(self.path('clip/relations.txt'), 'w', encoding='utf-8') as file:
            file.write(RELATIONS)
        os.symlink('clip', self.path('link'))
        key = '--key', '0', '--scribbles', 'scribbles.png'
        self.refused('propagate', 'link/labels_###.png', *key, '--labels-dir', 'clip',
                     naming='--labels-dir would overwrite "clip/labels_000.png"')
        words = 'propagate', 'f_#.png', '--labels-dir', 'clip'
        self.refused(*words, *key, '--relations-file', 'link/relations.txt',
                     naming='--labels-dir and --relations-file name the same file, "clip/relations.txt"')
        self.refused(*words, '--key', '0', '--scribbles', 'clip/labels_001.png',
                     naming='--labels-dir and --scribbles name the same file')
        shutil.copy(self.path('f_0.png'), self.path('r.png'))
        self.refused(*words, *key, '--arrows', 'r.png', '--report', 'r.json',
                     naming='--report and --arrows name the same file, "r.png"')

    def test_results_of_a_clip(self):
        for frame in range(2):
            drawing().save(self.path(f'f_{frame}.png'))
        self.celdepth('propagate', 'f_#.png', '--key', '0', '--scribbles', 'scribbles.png', '--labels-dir', 'clip')
        for output in ('f_#.png', 'clip/labels_###.png'):
            self.refused('shade', '--clip', 'clip', '--shaded', output, naming='--shaded would overwrite "')
        self.refused('shade', '--clip', 'clip', '--shaded', 'one_0.png', '--rim', 'one_0.png', naming='the same file')

    def test_pages(self):
        os.mkdir(self.path('out'))
        os.symlink('out', self.path('link'))
        with open(self.path('out/page-depth.png'), 'w', encoding='utf-8') as file:
            file.write('1,1 > 2,2')
        self.refused('popup', 'page.ora', '--output-dir', 'out', '--relations-file', 'link/page-depth.png',
                     naming='"out/page-depth.png" would be overwritten by a result of "page.ora"')
        self.refused('popup', 'page.ora', 'link/page-depth.png', '--output-dir', 'out', naming='would be overwritten')


if __name__ == '__main__':
    unittest.main()
