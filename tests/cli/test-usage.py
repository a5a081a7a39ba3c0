#!/usr/bin/python3
"""Exit codes and messages of the command, its help, numbers in a comma locale.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import pty
import signal
import subprocess
import unittest

import numpy as np
from PIL import Image

from pictures import COMMAND, RELATIONS, Test

STEPS = ('popup', 'segment', 'order', 'expand', 'smooth', 'shade', 'enhance', 'exact', 'stereo', 'wiggle', 'register',
         'compose', 'deform', 'inbetween')


class Usage(Test):
    def wrong(self, *words, naming):
        self.assertIn(naming, self.celdepth(*words, code=2))

    def test_help_and_version(self):
        self.assertIn('popup', self.celdepth('--help'))
        self.assertRegex(self.celdepth('--version'), r'^celdepth \d+\.\d+\.\d+\n$')
        for step in STEPS:
            with self.subTest(step):
                text = self.celdepth(step, '--help')
                self.assertIn('Examples:', text)
                self.assertIn(f'celdepth {step} ', text)

    def test_wrong_words(self):
        self.wrong(naming='Usage')
        self.wrong('draw', naming="'draw'")
        for step in STEPS:
            with self.subTest(step):
                self.wrong(step, naming='is missing')
                self.wrong(step, 'a.png', '--nonsense', naming='--nonsense')
        self.wrong('popup', 'a.png', 'b.png', '--depth', 'c.png', naming='more than one')
        self.wrong('popup', 'a.png', naming='nothing to write')
        self.wrong('segment', 'a.png', naming='such as --labels')
        self.wrong('enhance', 'a.npy', naming='such as --enhanced')
        self.wrong('enhance', 'a.npy', '--enhanced', 'b.png', naming='--art')
        self.wrong('expand', 'a.npy', '--levels', 'b.npy', naming='--drawing is missing')
        self.wrong('smooth', 'a.npy', '--drawing', 'a.png', naming='--depth is missing')
        self.wrong('segment', 'a.png', '--labels', 'b.png', '--bulge', '1', naming='--bulge')

    def test_help_of_a_command(self):
        self.assertEqual(self.celdepth('help', 'popup'), self.celdepth('popup', '--help'))
        self.assertIn("There is no command 'shad'. Did you mean 'shade'?", self.celdepth('help', 'shad', code=2))

    def test_did_you_mean(self):
        for words, meant in ((['popip'], "'popup'"), (['inbewteen'], "'inbetween'"),
                             (['popup', 'drawing.png', '--scribles', 'x.png'], '--scribbles'),
                             (['popup', 'drawing.png', '--colors=x.png'], '--colours')):
            self.assertIn(f'Did you mean {meant}?', self.celdepth(*words, code=2))
        for words in (['dance'], ['popup', 'drawing.png', '--quixotic'], ['x' * 200], ['popup', '--' + 'y' * 200]):
            self.assertNotIn('Did you mean', self.celdepth(*words, code=2))

    def test_wrong_values(self):
        for option, value in (('--hardness', '7'), ('--hardness', '0,5'), ('--hardness', 'nan'), ('--hardness', ''),
                              ('--ink', 'Dark'), ('--ink', 'dark|light'), ('--encoding', 'rank '),
                              ('--tolerance', '0'), ('--bulge', '1x'),
                              ('--method', 'pixels'), ('--close-gaps', '1'), ('--keep-necks', ''),
                              ('--background-colour', '#12345'), ('--background-colour', '#1234567')):
            with self.subTest(option=option, value=value):
                self.wrong('popup', 'a.png', '--depth', 'b.png', option, value, naming=f"{option} cannot be '{value}'")
        self.wrong('popup', 'a.png', '--depth', 'b.png', '--background', 'colour', naming='--background-colour')
        self.wrong('popup', 'a.png', '--depth', 'b.png', '--encoding', 'fixed', '--near-level', '2', '--far-level', '3',
                   naming='--near-level')

    def test_wrong_files(self):
        for name in ('depth.jpg', 'depth', 'png', '.npy'):
            with self.subTest(name):
                self.wrong('popup', 'a.png', '--depth', name, naming='must end in')
        self.wrong('popup', 'a.png', '--depth', 'a.png', naming='overwrite')
        self.wrong('popup', 'a.png', '--depth', 'b.png', '--levels', './b.png', naming='same file')
        self.wrong('popup', 'a.png', '--scribbles', 's.png', '--depth', 's.png', naming='same file')
        self.wrong('popup', 'a.png', '--depth', 'b.png', '--relations', '1,1>2,2', '--relations-file', 'r.txt',
                   naming='either --relations or')

    def test_comma_locale(self):
        localedef = ['localedef', '-i', 'de_DE', '-f', 'UTF-8', self.path('de_DE.UTF-8')]
        subprocess.run(localedef, check=True, capture_output=True)
        words = ('--relations', RELATIONS + ' @0.5', '--hardness', '0.25', '--tolerance', '1e-4', '--depth')
        self.popup(*words, 'plain.npy', '--levels', 'plain.exr')
        self.popup(*words, 'comma.npy', '--levels', 'comma.exr', '--report', 'comma.json', LC_ALL='de_DE.UTF-8',
                   LOCPATH=self.folder)
        np.testing.assert_array_equal(np.load(self.path('plain.npy')), np.load(self.path('comma.npy')))
        np.testing.assert_array_equal(self.channel('plain.exr', 'Z'), self.channel('comma.exr', 'Z'))
        with open(self.path('comma.json'), encoding='utf-8') as file:
            self.assertIn('0.5', file.read())

    def test_interrupt(self):
        """A bar appears on a terminal; an interrupt ends the work, and nothing is left."""
        screen, terminal = pty.openpty()
        noise = np.random.default_rng(1).integers(0, 256, (1800, 1800), dtype=np.uint8)
        Image.fromarray(noise).save(self.path('large.png'))
        strokes = np.zeros((1800, 1800, 4), np.uint8)
        strokes[10:900, 10:60] = (255, 0, 0, 255)
        strokes[900:1700, 1500:1600] = (0, 0, 255, 255)
        Image.fromarray(strokes).save(self.path('strokes.png'))
        before = set(os.listdir(self.folder))
        words = [COMMAND, 'popup', 'large.png', '--scribbles', 'strokes.png', '--depth', 'depth.png']
        process = subprocess.Popen(words, cwd=self.folder, stderr=terminal)
        shown = os.read(screen, 1000)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), 1)
        os.set_blocking(screen, False)
        rest = os.read(screen, 10000)
        os.close(terminal)
        os.close(screen)
        self.assertIn(b'%', shown)
        self.assertIn(b'Cancelled', rest)
        self.assertEqual(set(os.listdir(self.folder)), before)

    def test_quiet(self):
        self.assertEqual(self.popup('--relations', RELATIONS, '--depth', 'depth.png', '--quiet'), '')


if __name__ == '__main__':
    unittest.main()
