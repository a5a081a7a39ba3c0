#!/usr/bin/python3
"""Exit codes and messages of the command, its help, numbers in a comma locale.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import pty
import re
import shutil
import signal
import subprocess
import time
import unittest

import numpy as np
from PIL import Image

from pictures import COMMAND, RELATIONS, Test, drawing

STEPS = ('popup', 'segment', 'order', 'expand', 'smooth', 'shade', 'enhance', 'exact', 'stereo', 'wiggle', 'relief',
         'layers', 'register', 'compose', 'propagate', 'deform', 'inbetween')

# Names that mean the same in every command, in words of the command's own.
OWN_WORDS = {'output': 'what the command makes', 'frames': 'the number of pictures',
             'scribbles': 'of the drawing, or of each key', 'arrows': 'of the drawing, or of each key',
             'report': 'what was found, as JSON', 'jobs': 'how much is made at the same time'}


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
                self.assertRegex(self.celdepth(step, code=2), 'The .* (is|are) missing')
                self.wrong(step, 'a.png', '--nonsense', naming='--nonsense')
        self.wrong('popup', 'a.png', 'b.png', '--depth', 'c.png',
                   naming='"b.png" is one too many: give one drawing, or --output-dir for many pages.')
        self.wrong('shade', 'a.png', 'b.png', '--shaded', 'c.png', naming='"b.png" is one too many: give one file of levels.')
        self.wrong('register', 'a.png', 'b.png', 'c.png', '--warped', 'd.png', naming='"c.png" is one too many: give two drawings.')
        for option in ('-o', '--output', '--output=b.png'):
            self.wrong('segment', 'a.png', option, 'b.png', naming='each result has an option of its own, such as --labels.')
        self.wrong('popup', 'a.png', naming='nothing to write')
        self.wrong('segment', 'a.png', naming='such as --labels')
        self.wrong('enhance', 'a.npy', naming='such as --enhanced')
        self.wrong('enhance', 'a.npy', '--enhanced', 'b.png', naming='--colours')
        self.wrong('expand', 'a.npy', '--levels', 'b.npy', naming='--drawing is missing')
        self.wrong('smooth', 'a.npy', '--drawing', 'a.png', naming='--depth is missing')
        self.wrong('segment', 'a.png', '--labels', 'b.png', '--bulge', '1', naming='--bulge')

    def options(self, step):
        """Name, values and text of each option in a command's help."""
        options, text = {}, self.celdepth(step, '--help').split('\nExamples:')[0]
        for entry in re.split(r'\n(?=  -)', re.sub(r'\n\n[^\n]*:\n', '\n', text))[1:]:
            entry = re.sub(r'\|\n +', '|', entry)
            name, values, words = re.match(r' +(?:-., )?--([a-z-]+)(?:=(\S+))?\s(.*)', entry, re.S).groups()
            self.assertNotIn(name, options, f'{step} offers --{name} twice')
            options[name] = (values, ' '.join(words.split()))
        return options

    def test_lines_of_help(self):
        for words in [(step, '--help') for step in STEPS] + [('help',)]:
            for line in self.celdepth(*words).splitlines():
                self.assertLessEqual(len(line), 100, f'{words}: {line}')

    def test_each_name_has_one_meaning(self):
        meant = {}
        for step in STEPS:
            for name, (values, words) in self.options(step).items():
                if name in OWN_WORDS:
                    continue
                words = re.sub(r' \(default: [^)]*\)', '', words)
                first = meant.setdefault(name, (step, values, words))
                self.assertEqual((values, words), first[1:], f'--{name} of {step} and of {first[0]}')

    def test_defaults(self):
        """Each setting says its default, always in the same way."""
        for step in STEPS:
            for name, (values, words) in self.options(step).items():
                with self.subTest(step=step, name=name):
                    bare = re.sub(r'\(default: [^)]+\)', '', words)
                    self.assertNotIn('default', bare)
                    if values and ('|' in values or re.fullmatch(r'-?[0-9.]+(-|\.\.)[0-9.]+', values)):
                        self.assertIn(' (default: ', words + ('' if name != 'part' else ' (default: '))

    def test_no_option_takes_the_next(self):
        self.wrong('popup', 'a.png', '--depth', '--report', 'r.json', naming='but the option --report follows')
        self.wrong('popup', 'a.png', '--tolerance', '-q', naming='but the option -q follows')
        self.wrong('popup', 'a.png', '--depth', naming='--depth needs a value: --depth OUT')
        self.wrong('inbetween', 'a.png', 'b.png', '-n', '--output', 'c.png', naming='-n needs a value')
        self.popup('--relations', RELATIONS, '--shading', 'a.npy', '--light-azimuth', '-45', '--light-elevation', '-.5')
        self.popup('--relations', RELATIONS, '--shading', 'b.npy', '--light-azimuth=-45', '--light-elevation=-0.5')
        np.testing.assert_array_equal(np.load(self.path('a.npy')), np.load(self.path('b.npy')))

    def test_switches(self):
        page = drawing()
        page.paste(255, (8, 20, 15, 30)) # opens a box
        page.save(self.path('drawing.png'))
        closed = {}
        for value in ('yes', 'true', 'no', 'false', None):
            self.celdepth('segment', 'drawing.png', '--scribbles', 'scribbles.png', '--closures', 'closures.png',
                          '--close-gaps', *([value] if value else []))
            closed[value] = self.picture('closures.png').max() > 0
        self.assertEqual(closed, {'yes': True, 'true': True, 'no': False, 'false': False, None: True})

    def test_switches_that_are_no_settings(self):
        """They have the same values, but the word after one may be a page."""
        words = 'flat.npy', '--view', 'v.png'
        np.save(self.path('flat.npy'), np.full((64, 96), 2, np.float32))
        warned = self.celdepth('enhance', *words)
        self.assertIn('everywhere', warned)
        for value in ('--quiet=no', '--quiet=false', '--quiet no'):
            self.assertEqual(self.celdepth('enhance', *words, *value.split()), warned)
        for value in ('--quiet=yes', '--quiet=true', '--quiet yes', '--quiet', '-q'):
            self.assertEqual(self.celdepth('enhance', *value.split(), *words), '', value)
        self.popup('--depth', 'd.png', '--watch=no')
        levels = np.zeros((64, 96), np.float32)
        levels[10:46, 10:61], levels[25:58, 40:86] = 1, 2
        np.save(self.path('levels.npy'), levels)
        green = {}
        for value in ('--directx', '--directx yes', '--directx no', '--directx=false', ''):
            self.celdepth('shade', 'levels.npy', *value.split(), '--drawing', 'drawing.png', '--maps', 'm.png')
            green[value] = self.picture('m_n.png')[..., 1].tobytes()
        same = [value for value, picture in green.items() if picture == green['']]
        self.assertEqual(same, ['--directx no', '--directx=false', ''])
        self.wrong('enhance', *words, '--quiet=1', naming="--quiet must be yes, no, true or false, not '1'.")

    def test_given_twice(self):
        """Relations add up; of other options with one value the first would be lost in silence."""
        self.popup('--quiet', '--depth', 'd.png', '-q')
        first, second = RELATIONS.split('; ')
        self.popup('--relations', first, '--relations=' + second, '--levels', 'twice.npy')
        self.popup('--relations', RELATIONS, '--levels', 'once.npy')
        np.testing.assert_array_equal(np.load(self.path('twice.npy')), np.load(self.path('once.npy')))
        for words in (('--depth', 'c.png'), ('--depth=c.png',), ('--tolerance', '1e-4', '--tolerance=1e-3'),
                      ('--complete', '--complete', 'no'), ('--relations-file', 'a', '--relations-file', 'b')):
            name = words[0].split('=')[0]
            self.wrong('popup', 'a.png', '--depth', 'b.png', *words, naming=f'{name} is given twice.')

    def test_messages_about_values(self):
        for words, said in ((('--tolerance', '5'), "--tolerance must be a number between 0.0000001 and 0.1, not '5'."),
                            (('--ink', 'Dark'), "--ink must be auto, dark, light, alpha or lines, not 'Dark'."),
                            (('--close-gaps', '1x'), "--close-gaps must be yes, no, true or false, not '1x'."),
                            (('--toon-steps', '2.5'), "--toon-steps must be a whole number between 2 and 5, not '2.5'.")):
            self.wrong('popup', 'a.png', '--depth', 'b.png', *words, naming=said)
        self.wrong('stereo', 'a.png', '--views', '1', naming="--views must be a whole number between 2 and 1000, not '1'")

    def test_relations_from_two_places(self):
        """--relations come first; places in messages are those in the text where they stand."""
        with open(self.path('r.txt'), 'w', encoding='utf-8') as file:
            file.write('70,45 > 20,20\n70,45 > 1,1\n')
        self.popup('--relations', '20,20 > 1,1', '--relations-file', 'r.txt', '--levels', 'both.npy')
        self.popup('--relations', '20,20 > 1,1; 70,45 > 20,20', '--levels', 'one.npy')
        np.testing.assert_array_equal(np.load(self.path('both.npy')), np.load(self.path('one.npy')))
        self.wrong('popup', 'a.png', '--depth', 'b.png', '--relations', '1,1 > 2,2;\n1,', '--relations-file', 'r.txt',
                   naming='--relations, line 2')
        with open(self.path('r.txt'), 'a', encoding='utf-8') as file:
            file.write('70,45 >> 1,1\n')
        self.wrong('popup', 'drawing.png', '--depth', 'b.png', '--relations', '1,1 > 2,2;\n20,20 > 1,1',
                   '--relations-file', 'r.txt', naming='r.txt, line 3, column 8')

        with open(self.path('r.txt'), 'w', encoding='utf-8') as file:
            file.write('70,45 > 20,20\n#123456 > 1,1\n')
        os.mkfifo(self.path('pipe'))
        writer = subprocess.Popen(['sh', '-c', 'echo "20,20 > 1,1; 70,45 > 20,20" > pipe'], cwd=self.folder)
        self.popup('--relations-file', 'pipe', '--levels', 'piped.npy')
        self.assertEqual(writer.wait(10), 0)
        np.testing.assert_array_equal(np.load(self.path('piped.npy')), np.load(self.path('one.npy')))
        said = self.popup('--relations', '20,20 > 999,1', '--relations-file', 'r.txt', '--levels', 'both.npy')
        self.assertIn('celdepth: --relations: The relation in line 1, column 1 names a point outside', said)
        self.assertIn('celdepth: r.txt: The relation in line 2, column 1 names a colour', said)

    def test_standard_input_and_output(self):
        def run(*words, given):
            with open(self.path(given), 'rb') as file:
                return subprocess.run([COMMAND, *words], cwd=self.folder, stdin=file, capture_output=True, check=False)

        words = ('--scribbles', 'scribbles.png', '--relations', RELATIONS)
        self.popup('--relations', RELATIONS, '--depth', 'depth.png', '--layers', 'layers.ora', '--levels', 'levels.npy')
        before = set(os.listdir(self.folder))
        for output, name, more in (('--depth', 'depth.png', ()), ('--levels', 'levels.npy', ('--format', 'npy'))):
            done = run('popup', '-', *words, output, '-', *more, given='drawing.png')
            self.assertEqual((done.returncode, done.stderr), (0, b''))
            with open(self.path(name), 'rb') as file:
                self.assertEqual(done.stdout, file.read(), name)
        done = run('popup', '-', *words, '--layers', '-', given='drawing.png')
        self.assertEqual(done.stdout[:2], b'PK')
        done = run('popup', 'drawing.png', *words, '--report', '-', given='drawing.png')
        self.assertIn(b'"labels"', done.stdout)
        for words, said in ((('-', '--scribbles', '-', '--depth', 'd.png'),
                             'DRAWING|LAYERED and --scribbles cannot both be read from standard input'),
                            (('drawing.png', '--depth', '-', '--levels', '-'), 'cannot both be written'),
                            (('drawing.png', '--depth', '-', '--format', 'jpg'), '--format jpg: for --depth it must be .png, .exr,'),
                            (('drawing.png', '--depth', 'd.png', '--format', 'npy'), 'give an output the name "-"')):
            done = run('popup', *words, given='drawing.png')
            self.assertEqual((done.returncode, done.stdout), (2, b''))
            self.assertIn(said, done.stderr.decode())
        done = run('register', 'drawing.png', 'drawing.png', '--displacement', '-', given='drawing.png')
        self.assertEqual((done.returncode, done.stdout[:6]), (0, b'\x93NUMPY'), done.stderr)
        with open(self.path('nothing'), 'wb'):
            before.add('nothing')
        done = run('popup', '-', '--depth', 'd.png', given='nothing')
        self.assertEqual(done.returncode, 1)
        self.assertIn('"standard input"', done.stderr.decode())
        with open(self.path('drawing.png'), 'rb') as file, open(self.path('half'), 'wb') as half:
            half.write(file.read()[:120])
            before.add('half')
        done = run('popup', '-', '--depth', 'd.png', given='half')
        self.assertEqual((done.returncode, done.stderr.decode()[:45]), (1, 'celdepth: Cannot read "standard input": it is'))
        self.assertEqual(set(os.listdir(self.folder)), before)

    def test_closed_standard_files(self):
        """They are not mistaken for other files that get their numbers."""
        for words, code, said in (('popup - --depth d.png <&-', 1, 'Cannot read standard input: it is closed.'),
                                  ('popup - --depth d.png </', 1, 'Cannot read standard input: it is a folder.'),
                                  ('popup drawing.png --scribbles scribbles.png --depth - >&-', 1,
                                   'Cannot write standard output: it is closed.')):
            done = subprocess.run(['bash', '-c', f'{COMMAND} {words}'], cwd=self.folder, capture_output=True, text=True,
                                  timeout=60, check=False)
            self.assertEqual(done.returncode, code, words)
            self.assertIn(said, done.stderr)
            self.assertNotIn('shows its usage', done.stderr)
        for word in ('help', '--version', 'popup --help'):
            done = subprocess.run(['bash', '-c', f'{COMMAND} {word} >/dev/full'], capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 1, word)
            self.assertIn('Cannot write standard output: No space left on device.', done.stderr)

    def test_one_progress_bar(self):
        """It never goes back, over all stages, and is silent where it would only disturb."""
        page = Image.open(self.path('drawing.png')).resize((1500, 1000), Image.NEAREST)
        page.save(self.path('large.png'))
        Image.open(self.path('scribbles.png')).resize((1500, 1000), Image.NEAREST).save(self.path('strokes.png'))
        words = [COMMAND, 'popup', 'large.png', '--scribbles', 'strokes.png', '--relations-file', 'none.txt', '--depth',
                 'd.png', '--normals', 'n.png', '--layers', 'l.ora', '--joined', 'j.png']
        open(self.path('none.txt'), 'w', encoding='utf-8').close()
        shown = {}
        for more in ((), ('--quiet',)):
            screen, terminal = pty.openpty()
            with subprocess.Popen(words + list(more), cwd=self.folder, stderr=terminal) as process:
                os.close(terminal)
                text = b''
                try:
                    while piece := os.read(screen, 4096):
                        text += piece
                except OSError: # the other end is closed
                    pass
            os.close(screen)
            self.assertEqual(process.returncode, 0)
            shown[more] = text.decode()
        self.assertNotIn('%', shown[('--quiet',)])
        done = [int(number) for number in re.findall(r'(\d+) %', shown[()])]
        self.assertEqual(done, sorted(done))
        self.assertGreater(done[-1], 50)
        result = subprocess.run(words, cwd=self.folder, capture_output=True, check=True)
        self.assertNotIn(b'%', result.stderr)
        asked = subprocess.run([*words, '--progress'], cwd=self.folder, capture_output=True, check=True)
        done = [int(number) for number in re.findall(rb'(\d+) %', asked.stderr)]
        self.assertEqual(done, sorted(done))
        self.assertGreater(done[-1], 50)

    def test_completion(self):
        """Options and values are those of --help, also where a list of values takes two lines."""
        script = os.path.join(os.path.dirname(__file__), '..', '..', 'plugin', 'cli', 'completion.bash')
        ask = f'. {script}; COMP_WORDS=({COMMAND} %s); COMP_CWORD=%d; _celdepth {COMMAND}; echo "${{COMPREPLY[@]}}"'
        for words, last, expected in (('stereo --stereo ""', 3, {'left', 'columns', 'dubois'}),
                                      ('smooth --hold-', 2, {'--hold-gaps', '--hold-rest'})):
            found = subprocess.run(['bash', '-c', ask % (words, last)], capture_output=True, text=True, check=True)
            self.assertLessEqual(expected, set(found.stdout.split()), found)

    def test_help_of_a_command(self):
        self.assertEqual(self.celdepth('help', 'popup'), self.celdepth('popup', '--help'))
        self.assertEqual(self.celdepth('help', '--help'), self.celdepth('help'))
        self.wrong('help', 'popup', 'extra', naming='Give one command to help')
        self.assertIn('0 chooses one by the size of the picture (default: 0)',
                      ' '.join(self.celdepth('help', 'register').split()))
        self.assertIn("There is no command 'shad'. Did you mean 'shade'?", self.celdepth('help', 'shad', code=2))

    def test_did_you_mean(self):
        for words, meant in ((['popip'], "'popup'"), (['inbewteen'], "'inbetween'"),
                             (['popup', 'drawing.png', '--scribles', 'x.png'], '--scribbles'),
                             (['popup', 'drawing.png', '--colors=x.png'], '--colours'),
                             (['order', 'labels.png', '--levels', 'x.npy'], '--unexpanded-levels')):
            self.assertIn(f'Did you mean {meant}?', self.celdepth(*words, code=2))
        for words in (['dance'], ['popup', 'drawing.png', '--quixotic'], ['segment', 'drawing.png', '--depth', 'x.png'],
                      ['x' * 200], ['popup', '--' + 'y' * 200]):
            self.assertNotIn('Did you mean', self.celdepth(*words, code=2))

    def test_hints_about_values(self):
        for words, said in ((('--hardness', '0,07'), "not '0,07'. Numbers have a decimal point: 0.07."),
                            (('--light-azimuth', 'abc'), "must be a number between -360 and 360, not 'abc'."),
                            (('--ink', 'drak'), "not 'drak'. Did you mean dark?"),
                            (('--scribbles=',), '--scribbles needs a value: --scribbles PICTURE.'),
                            (('--relations-file', ''), '--relations-file needs a value: --relations-file FILE.')):
            self.wrong('popup', 'drawing.png', '--labels', 'l.png', *words, naming=said)
        self.wrong('popup', 'drawing.png', '--output-dir', 'out', '--levels', '-', naming='give --levels without "-".')
        self.wrong('propagate', 'a_1.png', '--key', '1', '--scribbles=', '--labels-dir', 'c', naming='--scribbles PICTURE')

    def test_wrong_values(self):
        for option, value in (('--hardness', '7'), ('--hardness', '0,5'), ('--hardness', 'nan'), ('--hardness', ''),
                              ('--ink', 'Dark'), ('--ink', 'dark|light'), ('--encoding', 'rank '),
                              ('--tolerance', '0'), ('--bulge', '1x'),
                              ('--method', 'pixels'), ('--close-gaps', '1'), ('--keep-necks', ''),
                              ('--background-colour', '#12345'), ('--background-colour', '#1234567')):
            with self.subTest(option=option, value=value):
                self.wrong('popup', 'a.png', '--depth', 'b.png', option, value, naming=f'{option} must be ')
        self.wrong('popup', 'a.png', '--depth', 'b.png', '--background', 'colour', naming='--background-colour')
        self.wrong('popup', 'a.png', '--depth', 'b.png', '--encoding', 'fixed', '--near-level', '2', '--far-level', '3',
                   naming='--near-level')

    def test_options_in_vain(self):
        """Those whose result or choice is missing."""
        words = 'popup', 'a.png', '--depth', 'b.png'
        for option, needed in (('--directx', '--maps or --normals'), ('--padding 3', '--maps'), ('--columns 3', '--quilt'),
                               ('--compositing linear', '--layers'), ('--views 4', '--quilt or --sequence'),
                               ('--frames 3', '--wiggle'), ('--fps 9', '--wiggle or --sequence'),
                               ('--size 99', '--wiggle or --sequence'), ('--jobs 2', '--output-dir'),
                               ('--near-level 2', '--encoding fixed'), ('--light-x 0.1', '--light point')):
            self.wrong(*words, *option.split(), naming=f'{option.split()[0]} has no effect without {needed}.')
        self.wrong('shade', 'l.npy', '--drawing', 'a.png', '--shaded', 's.png', '--padding', '3', naming='without --maps')
        self.wrong('stereo', 'a.png', '--left', 'l.png', '--views', '3', naming='without --quilt')

    def test_wrong_files(self):
        for name in ('depth.jpg', 'depth', 'png', '.npy'):
            with self.subTest(name):
                self.wrong('popup', 'a.png', '--depth', name, naming='must end in')
        for option, name, ending in (('--report', 'r.png', '.json'), ('--suggestions', 's.PNG', '.txt'),
                                     ('--report', 'r.glb', '.json'), ('--suggestions', 's.ora', '.txt')):
            self.wrong('popup', 'a.png', option, name, naming=f'{option} {name}: it is text, so the name must not be '
                                                              f'that of a picture. Let it end in {ending}.')
        self.wrong('propagate', 'a_1.png', '--key', '1', '--scribbles', 's.png', '--labels-dir', 'c', '--report', 'r.png',
                   naming='Let it end in .json')
        self.wrong('popup', 'a.png', '--depth', 'a.png', naming='overwrite')
        self.wrong('popup', 'a.png', '--depth', 'b.png', '--levels', './b.png', naming='same file')
        self.wrong('popup', 'a.png', '--scribbles', 's.png', '--depth', 's.png', naming='same file')
        self.wrong('popup', 'a.png', '--depth', 'b.png', '--relations', '1,1>2', naming='--relations, line 1')

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
        """A bar appears on a terminal; an interrupt ends the work, as when the terminal is closed, and nothing is left."""
        screen, terminal = pty.openpty()
        noise = np.random.default_rng(1).integers(0, 256, (1800, 1800), dtype=np.uint8)
        Image.fromarray(np.where(noise < 40, 0, 255).astype(np.uint8)).save(self.path('large.png'))
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
        os.mkdir(self.path('temporary'))
        before.add('temporary')
        with open(self.path('large.png'), 'rb') as file:
            process = subprocess.Popen([words[0], words[1], '-', *words[3:], '--progress'], cwd=self.folder, stdin=file,
                                       stderr=subprocess.PIPE, env={**os.environ, 'TMPDIR': self.path('temporary')},
                                       preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL)) # under nohup
        os.read(process.stderr.fileno(), 1000)
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(60), 1)
        process.stderr.close()
        self.assertEqual(set(os.listdir(self.folder)), before)
        self.assertEqual(os.listdir(self.path('temporary')), [])

    def test_module_for_files(self):
        """It is loaded by need, since OpenImageIO takes a third of a second; found beside the command, also through a
        link by its name alone; without it only files fail, and options are still answered."""
        needed = subprocess.run(['ldd', COMMAND], check=True, capture_output=True, text=True).stdout
        self.assertIn('libglib', needed)
        self.assertNotIn('OpenImageIO', needed)
        words = ['popup', 'drawing.png', '--scribbles', 'scribbles.png', '--relations', RELATIONS,
                 '--depth', 'depth.png']
        os.mkdir(self.path('bin'))
        os.symlink(os.path.abspath(COMMAND), self.path('bin/celdepth'))
        subprocess.run(['celdepth', *words], cwd=self.folder, check=True,
                       env={**os.environ, 'PATH': f'{self.path("bin")}:{os.environ["PATH"]}'})
        os.remove(self.path('depth.png'))
        os.remove(self.path('bin/celdepth'))
        copy = shutil.copy(COMMAND, self.path('bin'))
        with open(self.path('bin/celdepth-io.module'), 'w', encoding='utf-8') as module:
            module.write('not a module')
        library = os.path.join(os.path.dirname(os.path.abspath(COMMAND)), '../../core')
        for words, code, naming in ((words, 1, 'Files can be neither read nor written'),
                                    (['popup', 'drawing.png', '--nonsense'], 2, '--nonsense'),
                                    (['popup', '--help'], 0, 'Usage')):
            result = subprocess.run([copy, *words], cwd=self.folder, capture_output=True, text=True, check=False,
                                    env={**os.environ, 'LD_LIBRARY_PATH': library})
            self.assertEqual(result.returncode, code, result.stderr)
            self.assertIn(naming, result.stdout + result.stderr)
        self.assertFalse(os.path.exists(self.path('depth.png')))

    def test_huge_pages(self):
        """The setting of glibc that asks for them is added to what the user set, and kept if the user set it."""
        words = ['popup', '-', '--scribbles', 'scribbles.png', '--relations', RELATIONS, '--depth', 'depth.png']
        wanted, unwanted, other = 'glibc.malloc.hugetlb=1', 'glibc.malloc.hugetlb=0', 'glibc.malloc.perturb=1'
        for given, used in (('', wanted), (other, f'{other}:{wanted}'), (unwanted, unwanted)):
            process = subprocess.Popen([COMMAND, *words], cwd=self.folder, stdin=subprocess.PIPE, stderr=subprocess.PIPE,
                                       env={**os.environ, 'GLIBC_TUNABLES': given})
            for _ in range(100):
                with open(f'/proc/{process.pid}/environ', encoding='utf-8') as file:
                    settings = file.read().replace('\0', ':')  # glibc ends each setting where it stands
                if f'GLIBC_TUNABLES={used}:' in settings:
                    break
                time.sleep(0.1)
            with open(self.path('drawing.png'), 'rb') as file:
                messages = process.communicate(file.read(), timeout=100)[1]
            with self.subTest(given):
                self.assertIn(f'GLIBC_TUNABLES={used}:', settings)
                self.assertEqual((process.returncode, messages), (0, b''))

    def test_quiet(self):
        self.assertEqual(self.popup('--relations', RELATIONS, '--depth', 'depth.png', '--quiet'), '')


if __name__ == '__main__':
    unittest.main()
