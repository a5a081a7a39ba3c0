#!/usr/bin/python3
"""The exact program against cvxopt's interior-point method on the whole program, eq. (2) with a variable a pixel.

Usage: test-exact-program.py SOLVE-EXACT

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import subprocess
import sys
import unittest

import numpy as np
from cvxopt import matrix, solvers, spmatrix

TRIALS = 130


def random_scene(random):
    """(floor, ink, label, relations): lines across a page, dabs of paint, relations that a hidden depth obeys."""
    w, h = random.integers(6, 17, 2) if random.random() < 0.9 else (24, 24)
    ink = np.ones((h, w))
    for _ in range(random.integers(1, 4)):
        if random.random() < 0.5:
            ink[:, random.integers(w)] = random.choice([0, 0, 0.3])
        else:
            ink[random.integers(h), :] = random.choice([0, 0, 0.3])
    ink = np.where(random.random((h, w)) < 0.05, 1, ink)
    if random.random() < 0.3:
        ink = np.clip(ink + 0.05 * random.standard_normal((h, w)), 0, 1)
    label = np.zeros((h, w), int)
    for k in range(random.integers(1, 6)):
        y, x = random.integers(h), random.integers(w)
        label[y:y + random.integers(1, 4), x:x + random.integers(1, 4)] = k + 1
    hidden = random.permutation(w * h).reshape(h, w)
    # What a scribble or a point stands for is told by C's answer; here every pixel of a scribble has one hidden depth.
    for k in range(1, label.max() + 1):
        hidden[label == k] = random.integers(w * h)
    relations = []
    paper = np.argwhere((ink >= 0.5) | (label > 0))
    for _ in range(random.integers(1, 12)):
        (y0, x0), (y1, x1) = paper[random.integers(len(paper), size=2)]
        if hidden[y0, x0] < hidden[y1, x1]:
            y0, x0, y1, x1 = y1, x1, y0, x0
        if hidden[y0, x0] > hidden[y1, x1]:
            relations.append((x0, y0, x1, y1, random.choice([1, 1, 2, 0.25])))
    return 10.0 ** -random.integers(2, 7), ink, label, relations


def as_text(scene):
    floor, ink, label, relations = scene
    h, w = ink.shape
    return '\n'.join([f'{w} {h} {float(floor)!r}', ' '.join(map(repr, ink.ravel().tolist())),
                      ' '.join(map(str, label.ravel())), str(len(relations)),
                      *(f'{x0 + .5} {y0 + .5} {x1 + .5} {y1 + .5} {gap}' for x0, y0, x1, y1, gap in relations)])


class Answer:
    def __init__(self, line, shape):
        number = np.array(line.split(), float)
        n = shape[0] * shape[1]
        self.status, self.energy, self.gap, self.violation = number[:4]
        self.east, self.south = number[4:4 + n].reshape(shape), number[4 + n:4 + 2 * n].reshape(shape)
        count = int(number[4 + 2 * n])
        self.nodes = number[5 + 2 * n:5 + 2 * n + 3 * count].reshape(count, 3)
        self.depth = number[5 + 2 * n + 3 * count:].reshape(shape)


def laplacian(east, south):
    """Dense; east and south: weights of the edges."""
    h, w = east.shape
    index = np.arange(h * w).reshape(h, w)
    result = np.zeros((h * w, h * w))
    for p, q, weight in ((index[:, :-1], index[:, 1:], east[:, :-1]), (index[:-1], index[1:], south[:-1])):
        result[p, q] -= weight
        result[q, p] -= weight
    np.fill_diagonal(result, -result.sum(axis=1))
    return result


def least_energy(l, label, relations):
    """By cvxopt: (lower, upper bound, depth of each pixel), None when it is not sure."""
    h, w = label.shape
    variable = np.zeros(h * w, int)
    painted = sorted(set(label[label > 0]))
    flat = label.ravel()
    variable[flat > 0] = np.searchsorted(painted, flat[flat > 0])
    variable[flat == 0] = len(painted) + np.arange((flat == 0).sum())
    n = variable.max() + 1
    to_pixels = np.zeros((h * w, n))
    to_pixels[np.arange(h * w), variable] = 1
    reduced = to_pixels.T @ l @ to_pixels
    rows, columns, values, bound = [], [], [], []
    for i, (x0, y0, x1, y1, gap) in enumerate(relations):
        for x, y, sign in ((x0, y0, -1.0), (x1, y1, 1.0)):
            if variable[y * w + x]:
                rows.append(i)
                columns.append(int(variable[y * w + x]) - 1)
                values.append(sign)
        bound.append(-float(gap))
    answer = solvers.qp(matrix(reduced[1:, 1:]), matrix(np.zeros(n - 1)),
                        spmatrix(values, rows, columns, (len(bound), n - 1)), matrix(bound))
    if answer['status'] != 'optimal':
        return None
    depth = to_pixels @ np.concatenate([[0], np.array(answer['x']).ravel()])
    return answer['dual objective'], answer['primal objective'], depth.reshape(h, w)


class Exact(unittest.TestCase):
    def test_least_energy(self):
        solvers.options.update(show_progress=False, abstol=1e-13, reltol=1e-11, feastol=1e-12, maxiters=100)
        random = np.random.default_rng(7)
        scenes = [scene for scene in (random_scene(random) for _ in range(TRIALS)) if scene[3]]
        answers = subprocess.run(sys.argv[1:2], input='\n'.join(map(as_text, scenes)), capture_output=True, text=True,
                                 check=True).stdout.splitlines()
        self.assertEqual(len(answers), len(scenes))
        judged = 0
        for trial, (scene, line) in enumerate(zip(scenes, answers)):
            with self.subTest(trial):
                floor, ink, label, relations = scene
                ours = Answer(line, ink.shape)
                self.assertEqual(ours.status, 0)
                self.assertLessEqual(ours.violation, 1e-12)
                self.assertLessEqual(abs(ours.gap), 1e-10 * ours.energy)
                at = {(int(x), int(y)): depth for x, y, depth in ours.nodes}
                for k in range(1, label.max() + 1):
                    for y, x in np.argwhere(label == k):
                        at[x, y] = ours.nodes[k - 1][2]
                for x0, y0, x1, y1, gap in relations:
                    self.assertGreaterEqual(at[x0, y0] - at[x1, y1], gap - 1e-12)
                l = laplacian(ours.east, ours.south)
                self.assertLessEqual(abs(ours.depth.ravel() @ l @ ours.depth.ravel() / 2 - ours.energy),
                                     1e-4 * ours.energy)
                theirs = least_energy(l, label, relations)
                if theirs:
                    lower, upper, depth = theirs
                    if upper - lower > 1e-9 * upper:
                        continue
                    judged += 1
                    # Bases are floats: where neighbours hold firmly, their last digit costs 1e-16 or so an edge.
                    self.assertLessEqual(ours.energy, upper * (1 + 1e-8) + 1e-14)
                    self.assertGreaterEqual(ours.energy, lower * (1 - 1e-8))
                    off = (ours.depth - depth) - np.median(ours.depth - depth)
                    self.assertLessEqual(abs(off).max(), 1e-4)
        self.assertGreaterEqual(judged, 100)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
