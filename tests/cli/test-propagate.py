#!/usr/bin/python3
"""celdepth propagate on a drawn clip whose regions are known: a body, an arm that swings across it, a ball behind.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import os
import random
import signal
import subprocess
import time
import unittest

import numpy as np
from PIL import Image, ImageDraw

from pictures import COMMAND, Test

SIDE, FRAMES = 200, 7
PAGE, BALL, BODY, ARM = range(4)
COLOURS = np.array([(230, 30, 30), (30, 200, 60), (40, 60, 220), (240, 180, 20)], np.uint8)
NAMES = ['#%02x%02x%02x' % tuple(colour) for colour in COLOURS]
ORDER = f'{NAMES[ARM]} > {NAMES[BODY]}; {NAMES[BODY]} > {NAMES[BALL]}'
SCRIBBLES = {PAGE: (5, 5, 195, 12), BALL: (133, 140, 139, 146), BODY: (90, 120, 98, 130), ARM: (101, 74, 105, 78)}


def regions(frame):
    """The true region of each pixel."""
    y, x = np.mgrid[:SIDE, :SIDE] + 0.5
    turn, shift = np.radians(10 + 12 * frame), 2 * frame
    out = np.full((SIDE, SIDE), PAGE)
    out[np.hypot(x - 128 - shift, y - 138) < 19] = BALL
    out[np.hypot((x - 98 - shift) / 28, (y - 104) / 48) < 1] = BODY
    along = np.clip(((x - 100 - shift) * np.sin(turn) + (y - 68) * np.cos(turn)) / 52, 0, 1)
    out[np.hypot(x - 100 - shift - 52 * along * np.sin(turn), y - 68 - 52 * along * np.cos(turn)) < 9] = ARM
    return out


def paper(label):
    inner = np.ones(label.shape, bool)
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            inner &= np.roll(label, (dy, dx), (0, 1)) == label
    return inner


class Propagate(Test):
    def setUp(self):
        super().setUp()
        for frame in range(FRAMES):
            inner = paper(regions(frame))
            Image.fromarray((255 * inner).astype(np.uint8)).save(self.path(f'walk_{frame:03d}.png'))
        self.scribble('scribbles.png', SCRIBBLES)

    def scribble(self, name, boxes):
        layer = Image.new('RGBA', (SIDE, SIDE))
        draw = ImageDraw.Draw(layer)
        for region, box in boxes.items():
            draw.rectangle(box, fill=tuple(COLOURS[region]) + (255,))
        layer.save(self.path(name))

    def words(self, *more, folder='clip'):
        return ['propagate', 'walk_###.png', '--key', '0', '--scribbles', 'scribbles.png', '--relations', ORDER,
                '--labels-dir', folder, *more]

    def share(self, frame, folder='clip'):
        """The share of paper with the right region."""
        true, found = regions(frame), self.picture(f'{folder}/labels_{frame:03d}.png')[..., :3]
        return (found == COLOURS[true]).all(2)[paper(true)].mean()

    def contents(self, folder):
        """All files of a clip but for dates in them."""
        out = {}
        for name in sorted(os.listdir(self.path(folder))):
            with open(self.path(f'{folder}/{name}'), 'rb') as file:
                out[name] = file.read()
        return out

    def changed(self, folder='clip'):
        """The times at which the labels of frames were written."""
        return [os.stat(self.path(f'{folder}/labels_{frame:03d}.png')).st_mtime_ns for frame in range(FRAMES)]

    def test_labels_follow_the_parts(self):
        self.celdepth(*self.words('--depth-dir', 'depth', '--report', 'review.json'))
        for frame in range(FRAMES):
            self.assertGreater(self.share(frame), 0.99, frame)
        with open(self.path('review.json'), encoding='utf-8') as file:
            review = json.load(file)
        self.assertEqual([frame['frame'] for frame in review['frames']], list(range(FRAMES)))
        self.assertFalse(any(frame['review'] for frame in review['frames']))
        self.assertFalse(os.path.exists(self.path('review.png')))

    def test_contradictions(self):
        """They are printed with their places in what was given, and reported, as those of other commands."""
        red, blue = NAMES[PAGE], NAMES[BODY]
        text = self.celdepth('propagate', 'walk_000.png', 'walk_001.png', '--key', '0', '--scribbles', 'scribbles.png',
                             '--relations', f'{red} > {blue}; {blue} > {red}', '--labels-dir', 'clip', '--report',
                             'review.json', code=3)
        self.assertIn('contradict each other', text)
        self.assertIn(f'{red} > {blue}  (--relations, line 1, column 1)', text)
        self.assertIn(f'{blue} > {red}  (--relations, line 1, column 20)', text)
        with open(self.path('review.json'), encoding='utf-8') as file:
            cycle, = json.load(file)['contradictions']
        self.assertEqual(sorted(cycle), sorted([f'{red} > {blue}', f'{blue} > {red}']))

    def test_depth_does_not_flicker(self):
        self.celdepth(*self.words('--depth-dir', 'depth'))
        depths = {region: set() for region in range(4)}
        for frame in range(FRAMES):
            away = self.channel(f'clip/levels_{frame:03d}.exr', 'Z')  # larger is farther
            true = regions(frame)
            for region, found in depths.items():
                inner = paper(true) & (true == region)
                found.add(round(float(np.median(away[inner])), 4))
                self.assertGreater((np.round(away[inner], 4) == min(found)).mean(), 0.99)
            self.assertEqual(self.channel(f'depth/depth_{frame:03d}.exr', 'Z').shape, (SIDE, SIDE))
        self.assertEqual([len(found) for found in depths.values()], [1] * 4)
        self.assertEqual(sorted(range(4), key=lambda region: -min(depths[region])), [PAGE, BALL, BODY, ARM])

    def test_an_interrupted_run_goes_on(self):
        self.celdepth(*self.words('--depth-dir', 'whole', folder='whole'))
        chance = random.Random(1)
        for _ in range(10):
            run = subprocess.Popen([COMMAND, *self.words('--depth-dir', 'parts', '--quiet', folder='parts')],
                                   cwd=self.folder, stdin=subprocess.DEVNULL)
            time.sleep(chance.uniform(0.02, 0.6))
            run.send_signal(signal.SIGKILL)
            run.wait()
        self.celdepth(*self.words('--depth-dir', 'parts', folder='parts'))
        whole, parts = self.contents('whole'), self.contents('parts')
        self.assertEqual({name: data for name, data in parts.items() if name != 'clip.json'},
                         {name: data for name, data in whole.items() if name != 'clip.json'})

    def test_files_of_a_killed_run_go(self):
        os.mkdir(self.path('clip'))
        left, other = ('labels_002.png.new-12', '.state_004.json.new-77', 'clip.json.new-5'), 'labels_002.png.mine'
        for name in (*left, other):
            with open(self.path(f'clip/{name}'), 'wb') as file:
                file.write(b'half')
        self.celdepth(*self.words())
        self.assertFalse(set(left) & set(os.listdir(self.path('clip'))))
        self.assertTrue(os.path.exists(self.path(f'clip/{other}')))

    KEYS = {3: {PAGE: (5, 5, 195, 12), BALL: (140, 141, 145, 147), BODY: (92, 126, 100, 136), ARM: (128, 90, 133, 94)},
            6: {PAGE: (5, 5, 195, 12), BALL: (148, 142, 152, 148), BODY: (98, 130, 106, 138), ARM: (146, 70, 152, 74)}}

    def with_keys(self, *more, keys=(3, 6), folder='clip'):
        words = []
        for key in keys:
            if not os.path.exists(self.path(f'{key}.png')):
                self.scribble(f'{key}.png', self.KEYS[key])
            words += ['--key', str(key), '--scribbles', f'{key}.png']
        return self.words(*words, *more, folder=folder)

    def test_a_corrected_key_changes_frames_near_it(self):
        """Those up to the keys beside it; what other keys say of these frames is kept."""
        self.celdepth(*self.with_keys())
        before, side = self.changed(), os.stat(self.path('clip/.labels_004_from_003.png')).st_mtime_ns
        for frame in range(FRAMES):
            self.assertGreater(self.share(frame), 0.99, frame)
        self.celdepth(*self.with_keys())
        self.assertEqual([a != b for a, b in zip(self.changed(), before)],
                         [key in (0, 3, 6) for key in range(FRAMES)])
        self.scribble('6.png', {**self.KEYS[6], PAGE: (5, 5, 190, 12)})
        self.celdepth(*self.with_keys())
        after = self.changed()
        self.assertEqual([after[frame] != before[frame] for frame in (1, 2, 4, 5)], [False, False, True, True])
        self.assertEqual(os.stat(self.path('clip/.labels_004_from_003.png')).st_mtime_ns, side)

    def test_a_part_that_appears_between_keys(self):
        """The ball comes up in frame 1, before the middle; the first key does not know it, the last one does."""
        true = regions(0)
        true[true == BALL] = PAGE
        Image.fromarray((255 * paper(true)).astype(np.uint8)).save(self.path('walk_000.png'))
        self.scribble('scribbles.png', {region: box for region, box in SCRIBBLES.items() if region != BALL})
        self.celdepth(*self.words()[:6], '--relations', ORDER.split(';')[0], '--labels-dir', 'one', '--quiet', code=0)
        self.celdepth(*self.with_keys(keys=(6,)))
        for frame in range(1, FRAMES):
            ball = paper(regions(frame)) & (regions(frame) == BALL)
            alone = self.picture(f'one/labels_{frame:03d}.png')[..., :3]
            self.assertLess((alone == COLOURS[BALL]).all(2)[ball].mean(), 0.1)
            self.assertGreater(self.share(frame), 0.99, frame)

    def test_an_interrupted_blend_goes_on(self):
        self.celdepth(*self.with_keys(keys=(6,), folder='whole'))
        chance = random.Random(2)
        for _ in range(10):
            run = subprocess.Popen([COMMAND, *self.with_keys('--quiet', keys=(6,), folder='parts')], cwd=self.folder,
                                   stdin=subprocess.DEVNULL)
            time.sleep(chance.uniform(0.02, 0.8))
            run.send_signal(signal.SIGKILL)
            run.wait()
        self.celdepth(*self.with_keys(keys=(6,), folder='parts'))
        whole, parts = self.contents('whole'), self.contents('parts')
        self.assertEqual({name: data for name, data in parts.items() if name != 'clip.json'},
                         {name: data for name, data in whole.items() if name != 'clip.json'})

    def test_a_stranger_is_to_be_reviewed(self):
        Image.fromarray(np.where(np.add.outer(np.arange(SIDE), np.arange(SIDE)) % 37 < 2, 0, 255)
                        .astype(np.uint8)).save(self.path('walk_003.png'))
        said = self.celdepth(*self.words('--report', 'review.json'))
        with open(self.path('review.json'), encoding='utf-8') as file:
            review = {frame['frame']: frame['review'] for frame in json.load(file)['frames']}
        self.assertTrue(review[3] and not review[2])
        self.assertIn('Look at', said)
        self.assertGreater(self.picture('review.png').shape[1], 100)

    def named(self, report):
        """The colours of regions that the review names in each frame, and whether it lists the frame."""
        with open(self.path(report), encoding='utf-8') as file:
            frames = json.load(file)['frames']
        return [({note['colour'] for note in frame['regions']}, frame['review']) for frame in frames]

    def test_a_lost_region_is_named_from_there_on(self):
        """The ball, 3 % of the page, is not drawn in two frames; nothing says that what comes back is the same."""
        for frame in (2, 3):
            true = regions(frame)
            true[true == BALL] = PAGE
            Image.fromarray((255 * paper(true)).astype(np.uint8)).save(self.path(f'walk_{frame:03d}.png'))
        self.celdepth(*self.words('--report', 'review.json'))
        named = self.named('review.json')
        self.assertEqual([(colours - {NAMES[PAGE]}, listed) for colours, listed in named],
                         [(set(), False)] * 2 + [({NAMES[BALL]}, True)] * (FRAMES - 2))

    def test_a_review_of_finished_frames(self):
        """It is that of a run from the beginning, and frames are not made anew for a run without."""
        self.celdepth(*self.words('--report', 'one.json', folder='one'))
        self.celdepth(*self.words(folder='two'))
        self.celdepth(*self.words('--report', 'two.json', folder='two'))
        self.assertEqual(self.named('one.json'), self.named('two.json'))
        one, two = self.contents('one'), self.contents('two')
        self.assertEqual({k: v for k, v in one.items() if k != 'clip.json'},
                         {k: v for k, v in two.items() if k != 'clip.json'})
        before = self.changed('two')
        self.celdepth(*self.words(folder='two'))
        self.assertEqual(self.changed('two')[1:], before[1:])

    def test_jobs_make_the_same(self):
        self.scribble('middle.png', {PAGE: (5, 5, 195, 12), BALL: (140, 141, 145, 147), BODY: (92, 126, 100, 136),
                                     ARM: (128, 90, 133, 94)})
        words = ['propagate', 'walk_###.png', '--key', '3', '--scribbles', 'middle.png', '--relations', ORDER]
        self.celdepth(*words, '--labels-dir', 'one', '--jobs', '1')
        self.celdepth(*words, '--labels-dir', 'two', '--jobs', '2')
        one, two = self.contents('one'), self.contents('two')
        self.assertEqual({k: v for k, v in one.items() if k != 'clip.json'},
                         {k: v for k, v in two.items() if k != 'clip.json'})
        for frame in range(FRAMES):
            self.assertGreater(self.share(frame, 'one'), 0.98, frame)

    def test_a_farm_makes_the_same(self):
        """With a stand-in for sbatch that runs what it is given at once."""
        self.celdepth(*self.with_keys(folder='whole'))
        self.celdepth(*self.with_keys('--emit-slurm', 'farm.sh', folder='farm'))
        self.assertEqual(os.listdir(self.path('farm')), [])
        os.mkdir(self.path('bin'))
        with open(self.path('bin/sbatch'), 'w', encoding='utf-8') as file:
            file.write('#!/bin/sh\nfor word; do case $before in --wrap) wrap=$word;; esac; before=$word\n'
                       'case $word in --array=1-*) n=${word#--array=1-};; esac; done\n'
                       'if [ "$n" ]; then for i in $(seq "$n"); do SLURM_ARRAY_TASK_ID=$i sh -c "$wrap" || exit; done\n'
                       'else sh -c "$wrap" || exit; fi\necho 17\n')
        os.chmod(self.path('bin/sbatch'), 0o755)
        subprocess.run(['sh', 'farm.sh'], cwd=self.folder, check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, 'PATH': self.path('bin') + ':' + os.environ['PATH']})
        whole, farm = self.contents('whole'), self.contents('farm')
        self.assertEqual({k: v for k, v in farm.items() if k != 'clip.json'},
                         {k: v for k, v in whole.items() if k != 'clip.json'})

    def test_other_commands_take_the_clip(self):
        self.celdepth(*self.words())
        self.assertEqual(self.celdepth('shade', '--clip', 'clip', '--shaded', 'lit.png'), '')
        self.assertIn('Frame 0, 1 of 7.', self.celdepth('shade', '--clip', 'clip', '--shaded', 'lit.png', '--progress'))
        self.celdepth('enhance', '--clip', 'clip', '--enhanced', 'e_##.png', '--quiet')
        self.celdepth('stereo', '--clip', 'clip', '--joined', 's.png', '--quiet')
        self.celdepth('layers', '--clip', 'clip', '--output', 'l.ora', '--quiet')
        self.celdepth('relief', '--clip', 'clip', '--height', 'h.exr', '--quiet')
        for frame in range(FRAMES):
            self.assertEqual(self.picture(f'lit_{frame:03d}.png').shape[:2], (SIDE, SIDE))
            for name in (f'e_{frame:02d}.png', f's_{frame:03d}.png', f'l_{frame:03d}.ora', f'h_{frame:03d}.exr'):
                self.assertTrue(os.path.exists(self.path(name)), name)
        lit = self.picture('lit_004.png')[..., 0]
        self.assertGreater(np.ptp(lit[paper(regions(4)) & (regions(4) == BODY)]), 20)

    def test_blank_frames(self):
        """They are said, also from a run that finds them made."""
        Image.new('L', (SIDE, SIDE), 255).save(self.path('walk_001.png'))
        for _ in range(2):
            self.assertIn('Frame 1: there are no lines', self.celdepth(*self.words()))
        self.assertEqual(self.celdepth(*self.words('--quiet')), '')

    def test_no_folders_after_mistakes(self):
        """Folders are made when there is something for them; a report may go there."""
        Image.new('L', (SIDE, SIDE), 255).save(self.path('blank_0.png'))
        words = self.words()[:-2]
        for wrong in ((*words[:3], '9', *words[4:]), (*words, '--part', '99'), ('propagate', 'blank_0.png', *words[2:])):
            self.fails(*wrong, '--labels-dir', 'new/clip', '--depth-dir', 'depth', naming='')
        self.celdepth(*self.words('--report', 'new/review.json', folder='new/clip'))

    def test_bad_input_is_named(self):
        for words, named in ((['--key', '9', '--scribbles', 'late.png'], '--key 9'),
                             (['--key', '0', '--scribbles', 'scribbles.png'], 'twice'),
                             (['--part', '99'], '--part')):
            self.assertIn(named, self.celdepth(*self.words(*words), code=1))
        for words, named in ((['--key', '2'], 'one --scribbles for each --key'), (['--jobs', '0'], '--jobs')):
            self.assertIn(named, self.celdepth(*self.words(*words), code=2))
        self.assertIn('--key', self.celdepth('propagate', 'walk_###.png', '--labels-dir', 'c', code=2))
        self.assertIn('walk_#.png', self.celdepth(*[w.replace('walk_###', 'walk_#') for w in self.words()], code=1))
        Image.new('L', (50, 60), 255).save(self.path('walk_005.png'))
        self.assertIn('walk_005.png', self.celdepth(*self.words(), code=1))
        with open(self.path('walk_004.png'), 'wb') as file:
            file.write(b'no picture')
        self.assertIn('walk_004.png', self.celdepth(*self.words(), code=1))
        self.assertIn('clip.json', self.celdepth('shade', '--clip', 'nowhere', '--shaded', 'x.png', code=1))
        with open(self.path('clip.json'), 'w', encoding='utf-8') as file:
            file.write('{"frames": [{"number": 1}]}')
        self.assertIn('damaged', self.celdepth('shade', '--clip', '.', '--shaded', 'x.png', code=1))


if __name__ == '__main__':
    unittest.main()
