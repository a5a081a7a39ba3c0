#!/usr/bin/python3
"""Many pages in one command: names, what is kept, what is made again, pages that fail.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import io
import os
import signal
import subprocess
import time
import unittest

import numpy as np

from pictures import COMMAND, HEIGHT, RELATIONS, WIDTH, Test, drawing, scribbles, write_ora, write_psd


def png(picture):
    data = io.BytesIO()
    picture.save(data, 'PNG')
    return data.getvalue()


class Pages(Test):
    def page(self, name, scribbled=True, more=''):
        entries = {'d.png': png(drawing()), 's.png': png(scribbles())}
        strokes = '<layer name="scribbles" src="s.png"/>' * scribbled
        write_ora(self.path(name), (WIDTH, HEIGHT),
                  f'<stack>{more}{strokes}<layer name="drawing" src="d.png"/></stack>', entries)
        return name

    def times(self):
        folder = self.path('out')
        return {name: os.stat(os.path.join(folder, name)).st_mtime_ns for name in os.listdir(folder) if name[0] != '.'}

    def test_results(self):
        """Those of a single run, in files with the page's name; the formats that were asked for."""
        write_psd(self.path('b 2.psd'), (WIDTH, HEIGHT), [('drawing', 0, 0, drawing().convert('RGBA')),
                                                         ('scribbles', 0, 0, scribbles())])
        text = self.celdepth('popup', '--depth=npy', self.page('a.1.ora'), 'b 2.psd', '--labels', '--relations',
                             RELATIONS, '--output-dir', 'out', '--report')
        self.assertIn('2 pages: 2 made, 0 kept', text)
        self.assertEqual(sorted(self.times()), [f'{page}-{result}' for page in ('a.1', 'b 2')
                                                for result in ('depth.npy', 'labels.png', 'report.json')])
        self.popup('--relations', RELATIONS, '--depth', 'depth.npy', '--labels', 'labels.png')
        for page in ('a.1', 'b 2'):
            np.testing.assert_allclose(np.load(self.path(f'out/{page}-depth.npy')), np.load(self.path('depth.npy')),
                                       atol=1e-5)
            np.testing.assert_array_equal(self.picture(f'out/{page}-labels.png'), self.picture('labels.png'))

    def test_maps_and_animations(self):
        """Results of several files, and those whose usual format is not PNG; they are kept like others."""
        words = ('popup', self.page('a.ora'), '--relations', RELATIONS, '--output-dir', 'out', '--maps', '--wiggle',
                 '--frames', '2')
        self.celdepth(*words)
        self.assertEqual(sorted(self.times()), ['a-maps_n.png', 'a-maps_o.png', 'a-maps_s.png', 'a-wiggle.gif'])
        self.assertIn('1 page: 0 made, 1 kept', self.celdepth(*words))
        os.remove(self.path('out/a-maps_o.png'))
        self.assertIn('1 page: 1 made, 0 kept', self.celdepth(*words))

    def test_default(self):
        self.celdepth('popup', self.page('a.ora'), '--output-dir=out', '--relations', RELATIONS)
        self.assertEqual(sorted(self.times()), ['a-depth.png', 'a-shaded.png'])

    def test_no_folder(self):
        """A folder that cannot be made is a failure, as any other place where nothing can be written."""
        self.page('a.ora')
        self.fails('popup', 'a.ora', '--output-dir', 'drawing.png', naming='Cannot make the folder "drawing.png"')
        os.mkdir(self.path('closed'), 0o555)
        os.chmod(self.folder, 0o755)
        for folder, said in (('closed', 'write in'), ('closed/new', 'make')):
            done = subprocess.run([COMMAND, 'popup', 'a.ora', '--output-dir', folder], cwd=self.folder, check=False,
                                  capture_output=True, text=True, user=65534 if os.getuid() == 0 else None)
            self.assertEqual(done.stderr, f'celdepth: Cannot {said} the folder "{folder}": Permission denied.\n')
        text = self.celdepth('popup', 'a.ora', '--output-dir', 'out', '--depth=jpg', code=2)
        self.assertIn('--depth out/PAGE-depth.jpg: the name must end in', text)

    def test_resuming(self):
        """What is finished is kept, unless its page, the settings or the relations have changed or a result is gone."""
        def run(*more, made):
            before = self.times() if os.path.isdir(self.path('out')) else {}
            text = self.celdepth('popup', 'a.ora', 'b.ora', '--output-dir', 'out', '--levels', '--relations-file',
                                 'r.txt', *more)
            if '-q' not in more:
                self.assertIn(f'2 pages: {len(made)} made, {2 - len(made)} kept', text)
            now = self.times()
            self.assertEqual({name[0] for name in now if now[name] != before.get(name)}, set(made))

        for page in 'ab':
            self.page(f'{page}.ora')
        with open(self.path('r.txt'), 'w', encoding='utf-8') as file:
            file.write(RELATIONS)
        run(made='ab')
        run(made='')
        run('--jobs', '1', '-q', made='')
        self.page('a.ora', more='<layer name="new" src="s.png"/>')
        self.page('b.ora')
        run(made='a')
        os.unlink(self.path('out/b-levels.png'))
        run(made='b')
        open(self.path('out/a-levels.png'), 'wb').close()  # as a full disk, or a crash of the machine, leaves it
        run(made='a')
        run('--hardness', '0.5', made='ab')
        with open(self.path('r.txt'), 'w', encoding='utf-8') as file:
            file.write('20,20 > 70,45')
        run('--hardness', '0.5', made='ab')

    def test_leftovers(self):
        """What a run that was killed left is removed, and what it did not finish is made."""
        self.page('a.ora')
        os.mkdir(self.path('out'))
        for name in ('a-levels.png', 'a-levels.png.new-12', '.a.state.json', '.a.state.json.new-3'):
            with open(self.path(f'out/{name}'), 'wb') as file:
                file.write(b'half')
        self.celdepth('popup', 'a.ora', '--output-dir', 'out', '--levels', '--relations', RELATIONS)
        self.assertEqual(sorted(os.listdir(self.path('out'))), ['.a.state.json', 'a-levels.png'])
        self.assertEqual(self.picture('out/a-levels.png').shape, (HEIGHT, WIDTH))

    def test_failures(self):
        """A page that fails is named, the others are made, and the exit code says so; it is tried again."""
        with open(self.path('bad.psd'), 'wb') as file:
            file.write(b'8BPS')
        for made, kept in ((1, 0), (0, 1)):
            text = self.celdepth('popup', 'bad.psd', self.page('good.ora'), self.page('bare.ora', scribbled=False),
                                 'lost.ora', '--output-dir', 'out', '--levels', code=1)
            self.assertIn(f'4 pages: {made} made, {kept} kept from an earlier run, 3 failed', text)
            self.assertIn('bad.psd: Cannot read "bad.psd"', text)
            self.assertIn('bare.ora: ', text)
            self.assertIn('Cannot read "lost.ora"', text)
            self.assertEqual(list(self.times()), ['good-levels.png'])

    def test_nothing_made(self):
        """A new folder, and those above it, are not left without a page; one that was there is."""
        words = 'popup', self.page('bare.ora', scribbled=False), '--output-dir'
        for folder in ('out', 'new/out/'):
            self.fails(*words, folder, naming='1 page: 0 made, 0 kept from an earlier run, 1 failed')
        os.makedirs(self.path('new/out'))
        self.fails(*words, 'new/out', naming='1 failed')
        self.assertTrue(os.path.isdir(self.path('new/out')))

    def test_contradictions(self):
        """Exit code 3, also where the page was made earlier."""
        self.page('a.ora')
        for again in range(2):
            text = self.celdepth('popup', 'a.ora', '--output-dir', 'out', '--levels', '--relations',
                                 '70,45 > 20,20; 20,20 > 70,45', code=3)
            self.assertEqual('a.ora: These relations contradict each other' in text, not again)

    def test_usage(self):
        self.page('a.ora')
        os.mkdir(self.path('sub'))
        self.page('sub/a.ora')
        self.page('a-layers.ora')
        for words, naming in ((['a.ora', '--depth', 'depth.exr'], 'give --depth without a name'),
                              (['a.ora', '--depth=x/d.exr'], 'results are named after their pages'),
                              (['a.ora', '--depth='], 'results are named after their pages'),
                              (['a.ora', '--depth=gif'], 'must end in'),
                              (['a.ora', '--scribbles', 'scribbles.png'], 'leave out options that name layers'),
                              (['a.ora', 'sub/a.ora'], 'results of the same name'),
                              (['a.ora', '--hardness', '7'], '--hardness')):
            self.assertIn(naming, self.celdepth('popup', *words, '--output-dir', 'out', code=2))
        text = self.celdepth('popup', 'a.ora', 'a-layers.ora', '--layers', '--output-dir', '.', code=2)
        self.assertIn('would be overwritten', text)

    def test_interruption(self):
        """SIGINT ends it, with no half-written file."""
        pages = [self.page(f'{number}.ora') for number in range(12)]
        with subprocess.Popen([COMMAND, 'popup', *pages, '--output-dir', 'out', '--levels', '--jobs', '2'],
                              cwd=self.folder, stderr=subprocess.PIPE, text=True) as process:
            while not os.path.isdir(self.path('out')) or not self.times():
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(60), 1)
            self.assertNotIn('Cannot', process.stderr.read())
        made = [name for name in os.listdir(self.path('out')) if name.endswith('.png')]
        self.assertLess(len(made), 12)
        self.assertEqual([name for name in os.listdir(self.path('out')) if '.new-' in name], [])
        self.celdepth('popup', *pages, '--output-dir', 'out', '--levels')
        self.assertEqual(len(self.times()), 12)


if __name__ == '__main__':
    unittest.main()
