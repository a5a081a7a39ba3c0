#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What must come out of the paper's situations (figures.py), by the command line.

test-figures.py CELDEPTH    prints 'N passed, N failed'
"""
import json
import os
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

import figures


class Result:
    """One run of `celdepth popup` on a figure: its pictures as arrays, indexed [y, x]."""

    def __init__(self, celdepth, folder, *options):
        def layer(name):
            return os.path.join(folder, name)
        command = [celdepth, 'popup', layer('drawing.png'), '--quiet',
                   '--report', layer('report.json'), '--labels', layer('labels.png'),
                   '--levels', layer('levels.npy'), '--depth', layer('depth.npy')]
        for option in 'scribbles', 'contours':
            if os.path.exists(layer(option + '.png')):
                command += ['--' + option, layer(option + '.png')]
        if os.path.exists(layer('relations.txt')):
            command += ['--relations-file', layer('relations.txt')]
        run = subprocess.run(command + list(options), capture_output=True, text=True)
        self.code, self.said = run.returncode, run.stderr
        if self.code not in (0, 3):
            raise RuntimeError(f'exit {self.code}: {self.said}')
        self.labels = np.array(Image.open(layer('labels.png')).convert('RGBA'))
        with open(layer('report.json')) as file:
            self.report = json.load(file)
        self.levels = np.load(layer('levels.npy'))
        self.depth = np.load(layer('depth.npy'))
        self.drawing = np.array(Image.open(layer('drawing.png')))
        self.owner = np.array(Image.open(layer('owner.png')))
        self.celdepth, self.layer = celdepth, layer

    def smoothed_again(self):
        """Smooth depth by `celdepth smooth`, from the levels of this run."""
        subprocess.run([self.celdepth, 'smooth', self.layer('levels.npy'), '--quiet',
                        '--drawing', self.layer('drawing.png'), '--contours', self.layer('contours.png'),
                        '--scribbles', self.layer('scribbles.png'), '--depth', self.layer('again.npy')], check=True)
        return np.load(self.layer('again.npy'))

    def level(self, x, y):
        return float(self.levels[y, x])

    def colour(self, x, y):
        return tuple(int(v) for v in self.labels[y, x, :3])


def largest_step(values):
    return float(np.abs(np.diff(values)).max())


def two_arrows(run):
    r = run()
    near, body, far, paper = r.level(70, 160), r.level(120, 70), r.level(172, 160), r.level(5, 190)
    yield 'exit code 0', r.code == 0
    yield 'order: near leg, body, far leg, background', near > body > far > paper
    yield 'the background is transparent', r.labels[190, 5, 3] == 0
    yield 'four labels', len(np.unique(r.labels.reshape(-1, 4), axis=0)) == 4
    way = np.concatenate([r.depth[160:60:-1, 70], r.depth[60, 70:120]])
    yield 'smooth where the near leg is open', largest_step(way) < 0.25 * (near - body)
    yield 'sharp along its contour', r.depth[112, 82] - r.depth[112, 98] > 0.4 * (near - body)
    yield 'sharp at the silhouette', r.depth[160, 70] - r.depth[160, 30] > 0.9 * (near - paper)


def thick(run):
    r = run()
    front, bar, paper = r.level(120, 100), r.level(50, 100), r.level(10, 60)
    yield 'order', front > bar > paper and r.code == 0
    yield 'both ends of the bar are one depth', r.level(50, 100) == r.level(190, 100)
    ink = (r.drawing < 64) & (r.owner != 255)
    right = np.where(r.owner == 2, r.levels == front, r.levels == bar)
    yield 'ink goes to the sheet that drew it', right[ink].mean() >= 0.95
    yield 'the outline of the front sheet is whole at the T-junction', (r.levels[78:122, 78:82] == front).mean() > 0.95
    yield 'the gap does not leak', r.colour(120, 190) == figures.C and r.colour(120, 145) == figures.A


def contours(run):
    r = run()
    a, b, c = r.level(40, 100), r.level(145, 100), r.level(195, 100)
    yield 'order', a > b > c > r.level(10, 190) and r.code == 0
    yield ('the wrinkle is no border',
           np.all(r.levels[50:150, 50:70] == a) and largest_step(r.depth[100, 40:80]) < 0.02 * (a - b))
    yield 'the red contour is a step', r.depth[100, 116] - r.depth[100, 124] > 0.9 * (a - b)
    yield 'the blue contour divides the labels', r.colour(150, 100) == figures.B and r.colour(190, 100) == figures.C
    yield 'the blue contour leaves no step', largest_step(r.depth[100, 126:212]) < 0.25 * (b - c)
    yield 'depth still falls across it', r.depth[100, 145] - r.depth[100, 195] > 0.9 * (b - c)


def two_characters(run):
    r = run()
    yield 'exit code 0', r.code == 0
    yield 'side by side before the background', r.level(60, 100) == r.level(175, 100) > r.level(5, 5)
    yield 'the background is transparent', r.labels[5, 5, 3] == 0 and r.labels[100, 115, 3] == 0


def frame(run):
    r = run()
    yield 'order', r.level(170, 60) > r.level(40, 180) > r.level(40, 20) and r.code == 0
    yield 'regions reach the frame', (r.colour(2, 197), r.colour(170, 0), r.colour(2, 2), r.colour(237, 2)) == \
        (figures.A, figures.B, figures.C, figures.C)
    yield 'nothing is transparent', np.all(r.labels[..., 3] == 255)


def limbs(run):
    r = run('--same-colour', 'separate')
    yield ('separate limbs: before and behind the body',
           r.level(60, 75) > r.level(120, 150) > r.level(190, 105) > r.level(10, 100))
    yield 'exit code 0', r.code == 0
    one = run()
    yield 'one colour is one depth', one.level(60, 75) == one.level(190, 105)
    yield 'so the arrows contradict each other', one.code == 3 and 'contradict' in one.said


def cycle(run):
    r = run()
    a, b, c = r.level(60, 60), r.level(180, 60), r.level(120, 160)
    yield 'exit code 3', r.code == 3
    yield 'the latest relation gives way, the rest is ordered', a > b > c
    yield 'all three are named', all(f'line {n}' in r.said for n in (1, 2, 3))


def broken(run):
    r = run()
    a, b = r.level(50, 60), r.level(50, 140)
    yield 'the gap holds depth: a step', largest_step(r.depth[90:110, 70]) > 0.5 * (a - b)
    yield 'the blue contour keeps the other gap smooth', largest_step(r.depth[70:130, 170]) < 0.25 * (a - b)
    yield 'the closed line is a step', largest_step(r.depth[90:110, 120]) > 0.5 * (a - b)
    yield 'the single step gives the same', np.array_equal(r.depth, r.smoothed_again())
    published = run('--hold-gaps', 'no')
    steps = [largest_step(published.depth[70:130, x]) for x in (70, 170)]
    yield 'as published both gaps are smooth', max(steps) < 0.25 * (a - b)
    yield 'labels and levels are the same', (np.array_equal(r.labels, published.labels) and
                                             np.array_equal(r.levels, published.levels))


def pinched(run):
    r = run()
    yield 'the half behind the neck is of the painted one', r.colour(190, 120) == r.colour(50, 120) == figures.A
    yield 'the gap is closed', r.colour(175, 30) == figures.B and r.colour(175, 55) == figures.A


def gap_beside_bay(run):
    r = run()
    yield 'the bay is the page', r.colour(105, 140) == r.colour(105, 125) == figures.B
    yield 'the box ends at its gap', r.colour(105, 97) == figures.A


def hairline_gaps(run):
    r = run()
    yield 'the tab belongs to its part', r.colour(173, 145) == r.colour(173, 120) == figures.B
    yield 'its gaps are closed', r.colour(140, 150) == r.colour(205, 140) == figures.C


def stubs(run):
    r = run()
    yield 'the frame is closed between the stubs', r.colour(120, 52) == r.colour(54, 100) == figures.A
    yield 'the page is outside', r.colour(120, 28) == r.colour(28, 100) == figures.B


def ring_round_bar(run):
    r = run()
    yield 'the ring is one room, above the bar and below', r.colour(150, 65) == r.colour(100, 65) == figures.A
    yield 'the page is outside', r.colour(50, 50) == figures.B


def bay_beside_stub(run):
    r = run()
    yield 'the gap is closed between the stubs', r.colour(43, 125) == figures.A
    yield 'the bay below is page', r.colour(43, 150) == r.colour(30, 150) == figures.B


def bay_below_gap(run):
    r = run()
    yield 'the gap is closed', r.colour(85, 74) == figures.A
    yield 'the bay is page', r.colour(95, 105) == figures.B


def rubbed_out_corner(run):
    r = run()
    yield 'the closure bends towards the corner', r.colour(120, 52) == figures.A
    yield 'the page is outside', r.colour(120, 25) == figures.B


def severed(run):
    r = run()
    yield 'what the stroke ran into keeps its colour', r.colour(190, 60) == r.colour(190, 140) == figures.B
    yield 'and so does where it came from', r.colour(60, 60) == figures.A


def close_up(run):
    r = run()
    yield 'exit code 0', r.code == 0
    yield 'the page is transparent', r.labels[5, 5, 3] == 0 and r.labels[180, 5, 3] == 0
    yield 'and behind all', r.level(150, 100) > r.level(200, 160) > r.level(10, 125) > r.level(5, 5)
    yield 'the figure reaches the frame', r.colour(237, 2) == r.colour(120, 197) == figures.A


def unreached(r):
    return [p['place'] for p in r.report['problems'] if p['kind'] == 'region-unreached']


def nearly_touches_frame(run):
    r = run('--close-gaps=no')
    yield 'the corners are the page', r.colour(10, 190) == r.colour(10, 10) == r.colour(190, 190) == figures.B
    yield 'the ring is not', r.colour(60, 115) == figures.A


def forgotten(run):
    places = unreached(run())
    yield 'the closed part is named', any(100 < x < 140 and 40 < y < 80 for x, y in places)
    yield 'so is the one behind a gap', any(160 < x < 220 and 40 < y < 100 for x, y in places)
    yield 'and no other', len(places) == 2


def cut_off(run):
    places = unreached(run())
    yield 'the closed room is named', any(x < 60 and 40 < y < 110 for x, y in places)
    yield 'so is the one behind a gap', any(x > 190 and y < 70 for x, y in places)
    yield 'and no other', len(places) == 2


def unpainted_page(run):
    places = unreached(run())
    yield 'the room in the figure is named, and no other', len(places) == 1 and 150 < places[0][0] < 190


def gap_on_unpainted_page(run):
    r = run()
    yield 'the gap is closed', r.colour(190, 100) == figures.A
    yield 'the page has no label', not r.labels[(100, 10, 190), (220, 10, 230), 3].any()


def stopped_short(run):
    places = unreached(run())
    yield 'the room behind the gap is named, and no other', len(places) == 1 and 120 < places[0][0] < 220


def no_room(run):
    yield 'no room is named', not unreached(run())


def hairline(run):
    r = run()
    y, x = np.mgrid[:200, :240] + 0.5
    ring = ((x - 120.3) / 80) ** 2 + ((y - 100.2) / 60) ** 2
    inside, outside = ring < 0.92, (ring > 1.08) & (abs(x - 120) < 95) & (abs(y - 100) < 75)
    yield 'inside the ring', (r.labels[inside][:, :3] == figures.A).all()
    yield 'between the ring and the box', (r.labels[outside][:, :3] == figures.B).all()


def stroke_on_contour(run):
    r = run()
    yield 'the order', r.level(120, 145) > r.level(60, 50) > r.level(210, 125)
    yield 'no ink above its outline, from y = 101 on, belongs to the nearer sheet', \
        (r.levels[:97] < r.level(120, 145)).all()


def soft_on_white(run):
    r = run()
    yield 'three regions, whatever tints a stroke has', len(np.unique(r.labels.reshape(-1, 4), axis=0)) == 3
    yield 'each a whole room', all((r.labels[40:160, x:x + 80] == r.labels[100, x + 40]).all() for x in (30, 130))
    yield 'nothing is said about them', not r.report['problems']


def cover(run):
    r = run()
    near, pages = r.level(120, 85), r.level(120, 145)
    ink = (r.drawing < 64) & (r.owner != 255)
    right = np.where(r.owner == 2, r.levels == near, r.levels == pages)
    yield 'order', near > pages > r.level(5, 5)
    yield 'each sheet has its own line', all(right[ink & (r.owner == k)].mean() >= 0.95 for k in (1, 2))


def drop(run):
    r = run()
    yield 'all of the ink belongs to the sheet', (r.levels[r.drawing < 64] == r.level(80, 100)).mean() > 0.99


def careless_ends(run):
    r = run()
    bold = r.drawing[40:-40, 20:40] < 64
    yield 'the bold outline is part of its sheet', (r.labels[40:-40, 20:40][bold] == r.labels[120, 60]).all()
    yield 'the small sheet is one', (r.labels[62:94, 84:156] == r.labels[80, 120]).all()


OUTCOMES = [two_arrows, thick, contours, two_characters, frame, limbs, cycle, broken, pinched, pinched,
            gap_beside_bay, hairline_gaps, stubs, ring_round_bar, bay_beside_stub, bay_below_gap, rubbed_out_corner,
            severed, close_up, nearly_touches_frame, forgotten, cut_off, unpainted_page, gap_on_unpainted_page,
            stopped_short, stopped_short, stopped_short, no_room, no_room, no_room, hairline, stroke_on_contour, hairline,
            hairline, cover, cover, drop, careless_ends, soft_on_white]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    counts = {True: 0, False: 0}
    with tempfile.TemporaryDirectory() as scratch:
        for make, outcome in zip(figures.FIGURES, OUTCOMES):
            folder = os.path.join(scratch, make.__name__)
            make().save(folder)
            for fact, holds in outcome(lambda *options: Result(sys.argv[1], folder, *options)):
                counts[bool(holds)] += 1
                if not holds:
                    print(f'{make.__name__}: not so: {fact}', file=sys.stderr)
    print(f'{counts[True]} passed, {counts[False]} failed')
    return 1 if counts[False] else 0


if __name__ == '__main__':
    sys.exit(main())
