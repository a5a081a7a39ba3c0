#!/usr/bin/python3
"""The quadratic program against cvxopt's interior-point method, which shares nothing with it.

Usage: test-quadratic.py SOLVE-QUADRATIC

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import subprocess
import sys
import unittest

import numpy as np
from cvxopt import matrix, solvers

TRIALS = 160


def springs(random, n, kind):
    """Weights between n nodes: even, spread over some powers of ten, or few of them over a weak floor."""
    weight = random.random((n, n))
    if kind == 1:
        weight = 10 ** random.uniform(-2, 2, (n, n))
    if kind == 2:
        weight = np.where(random.random((n, n)) < 4 / n, 10 ** random.uniform(-1, 1, (n, n)), 0.01 * weight)
    weight = np.tril(weight, -1)
    return weight + weight.T


def reduced_drawing(random, n):
    """A drawing's K: pixels of a small grid with walls, all eliminated but n."""
    side = 12
    wall = random.random((side, side)) < 0.25
    laplacian = np.zeros((side * side, side * side))
    for y in range(side):
        for x in range(side):
            for v, u in ((y, x + 1), (y + 1, x)):
                if v < side and u < side:
                    p, q = y * side + x, v * side + u
                    w = 1e-3 if wall[y, x] != wall[v, u] else 1.0
                    laplacian[p, q] = laplacian[q, p] = -w
    np.fill_diagonal(laplacian, -laplacian.sum(axis=1))
    pixels = random.permutation(side * side)
    keep, free = pixels[:n], pixels[n:]
    return laplacian[np.ix_(keep, keep)] - laplacian[np.ix_(keep, free)] @ np.linalg.solve(
        laplacian[np.ix_(free, free)], laplacian[np.ix_(free, keep)])


def inequalities(random, n, m):
    """m of them that a hidden order obeys: (a, b, gap)."""
    rank = random.permutation(n)
    pairs = [random.choice(n, 2, replace=False) for _ in range(m)]
    gap = random.choice([1.0, 1.0, 2.0, 0.5], m)
    return [(int(a), int(b), g) if rank[a] > rank[b] else (int(b), int(a), g) for (a, b), g in zip(pairs, gap)]


def energies_by_cvxopt(k, asked):
    """The least energy lies between the two: of the dual and of the primal point; also whether it is sure of that."""
    n = len(k)
    scale = abs(k).max()
    rows = np.zeros((len(asked), n))
    for i, (a, b, _) in enumerate(asked):
        rows[i, a], rows[i, b] = -1, 1
    answer = solvers.qp(matrix(k[1:, 1:] / scale), matrix(np.zeros(n - 1)), matrix(rows[:, 1:]),
                        matrix([-gap for _, _, gap in asked]))
    return answer['dual objective'] * scale, answer['primal objective'] * scale, answer['status'] == 'optimal'


class Quadratic(unittest.TestCase):
    def test_least_energy(self):
        solvers.options.update(show_progress=False, abstol=1e-13, reltol=1e-11, feastol=1e-12, maxiters=100)
        random = np.random.default_rng(3)
        problems = []
        for trial in range(TRIALS):
            n = int(random.integers(3, 26))
            if trial % 4 == 3:
                k = reduced_drawing(random, n)
            else:
                weight = springs(random, n, trial % 4)
                k = np.diag(weight.sum(axis=1)) - weight
            problems.append((k, inequalities(random, n, int(random.integers(1, 3 * n)))))
        text = '\n'.join('\n'.join([f'{len(k)} {len(asked)}', ' '.join(map(repr, k.ravel().tolist()))] +
                                   [f'{a} {b} {float(gap)!r}' for a, b, gap in asked]) for k, asked in problems)
        answers = subprocess.run(sys.argv[1:2], input=text, capture_output=True, text=True, check=True).stdout
        answers = [list(map(float, line.split())) for line in answers.splitlines()]
        self.assertEqual(len(answers), TRIALS)
        judged = 0
        for trial, ((k, asked), (status, energy, gap, violation, *u)) in enumerate(zip(problems, answers)):
            with self.subTest(trial):
                u = np.array(u)
                self.assertEqual(status, 0)
                for a, b, least in asked:
                    self.assertGreaterEqual(u[a] - u[b], least * (1 - 1e-12))
                self.assertLessEqual(violation, 1e-12)
                self.assertLessEqual(abs(u @ k @ u / 2 - energy), 1e-10 * energy)
                self.assertLessEqual(abs(gap), 1e-10 * energy)
                lower, upper, sure = energies_by_cvxopt(k, asked)
                if sure:
                    judged += 1
                    self.assertLessEqual(energy, upper * (1 + 1e-8))
                    self.assertGreaterEqual(energy, lower * (1 - 1e-8))
                    self.assertLessEqual(upper - lower, 1e-8 * energy)
        self.assertGreaterEqual(judged, 100)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
