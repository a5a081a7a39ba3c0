#!/usr/bin/python3
"""The examples that build graphs, in C and in Python: whatever they read after a change of a layer equals what the
command makes of the changed layers from the start, and only what depends on the change was made again.

$GRAPHS   the programs, separated by colons
$CELDEPTH the command

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import functools
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

PEOPLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'examples', 'people')
CHAIN = 'lazybrush-segment depth-order depth-expand depth-smooth'
MADE = {'first': {'node': 'popup', 'chain': CHAIN}, 'again': {'node': 'nothing', 'chain': 'nothing'},
        'stroke': {'node': 'popup', 'chain': CHAIN},
        'relation': {'node': 'popup', 'chain': CHAIN.removeprefix('lazybrush-segment ')}}


def run(*words):
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0 and not done.stderr, f'{words} {done.returncode}: {done.stderr}'
    return done.stdout


@functools.lru_cache
def command_depth(scribbles, *options):
    """By the command from the start; `scribbles` are the bytes of the file."""
    with tempfile.TemporaryDirectory() as folder:
        path, strokes = os.path.join(folder, 'depth.npy'), os.path.join(folder, 'scribbles.png')
        pathlib.Path(strokes).write_bytes(scribbles)
        run(os.environ['CELDEPTH'], 'popup', f'{PEOPLE}/drawing.png', '--scribbles', strokes,
            '--arrows', f'{PEOPLE}/arrows.png', '--depth', path, *options)
        return np.load(path)


class Graphs(unittest.TestCase):
    def check(self, program):
        with tempfile.TemporaryDirectory() as out:
            lines = [line.split(maxsplit=4) for line in run(program, PEOPLE, out).splitlines()]
            painted = pathlib.Path(out, 'scribbles.png').read_bytes()
            wanted = {'first': command_depth(pathlib.Path(PEOPLE, 'scribbles.png').read_bytes()),
                      'stroke': command_depth(painted),
                      'relation': command_depth(painted, '--relations=#ff0d5e > #ff0daf')}
            wanted['again'] = wanted['first']
            made = {step: {} for step in MADE}
            for step, graph, _, _, operations in lines:
                made[step][graph] = operations
                depth = np.load(os.path.join(out, f'depth-{step}-{graph}.npy'))
                self.assertEqual(depth.shape, wanted[step].shape)
                self.assertLess(np.abs(depth - wanted[step]).max(), 1e-6, f'{step}, {graph}')
            self.assertEqual(made, MADE)
            # The right body (x, y) comes to its hair, then the left body in front of it.
            right, left, hair = (830, 760), (690, 130), (480, 930)
            self.assertLess(wanted['first'][right], wanted['first'][hair])
            self.assertEqual(wanted['stroke'][right], wanted['stroke'][hair])
            self.assertGreater(wanted['relation'][left], wanted['relation'][right])

    def test_programs(self):
        for program in os.environ['GRAPHS'].split(':'):
            with self.subTest(program):
                self.check(program)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
