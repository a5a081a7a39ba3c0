#!/usr/bin/python3
"""Measures the solvers on one core, side by side; tests/bench/solvers builds and calls it.

Prints tables, and writes them to results/ under the version and the processor's name.  README.md says what the figures
are.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import argparse
import json
import os
import subprocess
import sys
import time

import cvxopt
import numpy as np
from scipy import sparse

from pages import figure, make_page, make_relations, milliseconds, processor, run, save, table, version

LAPLACE = ['frog', 'bee', 'caterpillar', 'bee-gappy', 'caterpillar-pencil']
PROGRAM = ['frog', 'bee', 'caterpillar', 'campfire']
SESSION = ['frog', 'bee', 'monkey-gappy']
SIDES = [48, 128, 256]  # of pictures for general solvers; drawings keep their shape
HIGHS = """
const fs = require('fs');
require(process.argv[1] + '/node_modules/highs')().then(highs => {
  const start = process.hrtime.bigint();
  const answer = highs.solve(fs.readFileSync(0, 'utf8'), {output_flag: false});
  const seconds = Number(process.hrtime.bigint() - start) / 1e9;
  console.log(JSON.stringify({seconds, energy: answer.ObjectiveValue, status: answer.Status}));
});
"""


# ------------------------------------------------------------------ pages and runs

def measure_laplace(name, megapixels, options):
    folder = os.path.join(options.build, 'pages')
    drawing, scribbles, _ = make_page(name, megapixels, folder)
    relations = make_relations(name, drawing, folder)
    cholmod = megapixels <= options.cholmod
    figures = run('bench-laplace', options, drawing, scribbles, relations, options.runs, int(cholmod),
                  options.iccg if cholmod else 0)
    return {'case': name, 'megapixels': megapixels, **figures}


def measure_distance(name, megapixels, options):
    drawing, _, _ = make_page(name, megapixels, os.path.join(options.build, 'pages'))
    return {'case': name, 'megapixels': megapixels, **run('bench-distance', options, drawing, options.runs)}


def measure_shade(name, megapixels, options):
    drawing, scribbles, _ = make_page(name, megapixels, os.path.join(options.build, 'pages'))
    relations = make_relations(name, drawing, os.path.join(options.build, 'pages'))
    return {'case': name, 'megapixels': megapixels,
            **run('bench-shade', options, drawing, scribbles, relations, options.runs)}


# ------------------------------------------------------------------ the exact program, for general solvers

def contracted(figures, prefix):
    """The matrix of eq. (2) with a row for each node and each free pixel, and their number."""
    width, height = figures['width'], figures['height']
    node = np.fromfile(prefix + 'node', np.uint32).astype(np.int64)
    free = node == 0
    row = np.where(free, int(figures['nodes']) + np.cumsum(free) - 1, node - 1)
    n = int(figures['nodes']) + int(free.sum())
    index = np.arange(width * height).reshape(height, width)
    edges = []
    for name, p, q in (('east', index[:, :-1], index[:, 1:]), ('south', index[:-1], index[1:])):
        weight = np.fromfile(prefix + name, np.float32).astype(float)
        edges.append((row[p.ravel()], row[q.ravel()], weight[p.ravel()]))
    a, b, w = (np.concatenate(parts) for parts in zip(*edges))
    matrix = sparse.coo_matrix((np.concatenate([w, w, -w, -w]),
                                (np.concatenate([a, b, a, b]), np.concatenate([a, b, b, a]))), (n, n)).tocoo()
    matrix.sum_duplicates()
    return matrix, n


def solve_cvxopt(matrix, n, inequalities):
    """Seconds, energy and largest violation by an interior-point method, all pixels as unknowns."""
    to = lambda m: cvxopt.spmatrix(m.data.tolist(), m.row.tolist(), m.col.tolist(), m.shape)
    count = len(inequalities)
    sides = sparse.coo_matrix((np.tile([-1., 1.], count), (np.repeat(np.arange(count), 2),
                               np.array([[a - 1, b - 1] for a, b, _ in inequalities]).ravel())), (count, n))
    gaps = np.array([float(gap) for _, _, gap in inequalities])
    pin = cvxopt.spmatrix([1.], [0], [0], (1, n))
    cvxopt.solvers.options.update(show_progress=False, abstol=1e-12, reltol=1e-10, feastol=1e-12)
    start = time.process_time()
    answer = cvxopt.solvers.qp(to(matrix), cvxopt.matrix(0., (n, 1)), to(sides), cvxopt.matrix(-gaps), pin,
                               cvxopt.matrix(0., (1, 1)))
    seconds = time.process_time() - start
    x = np.array(answer['x']).ravel()
    return seconds, 0.5 * x @ (matrix @ x), max(0, (sides @ x + gaps).max())


def solve_highs(matrix, n, inequalities, folder):
    """Seconds and energy by HiGHS's active set, from npm."""
    if not os.path.isdir(os.path.join(folder, 'node_modules', 'highs')):
        os.makedirs(folder, exist_ok=True)
        subprocess.run(['npm', 'install', '--silent', '--prefix', folder, 'highs'], check=True)
    terms = []
    for i, j, value in zip(matrix.row, matrix.col, matrix.data):
        if i <= j:
            terms.append(f'{value:+.17g} x{i} ^ 2' if i == j else f'{2 * value:+.17g} x{i} * x{j}')
    rows = [f' c{k}: x{a - 1} - x{b - 1} >= {gap}' for k, (a, b, gap) in enumerate(inequalities)]
    text = '\n'.join(['Minimize', ' obj: [', *terms, '] / 2', 'Subject To', *rows, ' pin: x0 = 0', 'Bounds',
                      *(f' x{i} free' for i in range(n)), 'End', ''])
    done = subprocess.run(['node', '-e', HIGHS, os.path.abspath(folder)], input=text, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f'HiGHS: {done.stderr}')
    answer = json.loads(done.stdout)
    return answer['seconds'], answer['energy']


def measure_program(name, megapixels, options, rivals):
    folder = os.path.join(options.build, 'pages')
    drawing, scribbles, _ = make_page(name, megapixels, folder)
    prefix = os.path.join(folder, 'program-')
    figures = run('bench-program', options, drawing, scribbles, make_relations(name, drawing, folder), options.runs,
                  1e-6 if rivals else 1e-3, prefix)
    result = {'case': name, 'megapixels': megapixels, **figures}
    if rivals:
        matrix, n = contracted(figures, prefix)
        result['cvxopt'], energy, result['cvxopt violation'] = solve_cvxopt(matrix, n, figures['inequalities'])
        result['energy excess'] = figures['energy'] / energy - 1
        if options.highs and megapixels < 0.003:
            result['highs'], energy = solve_highs(matrix, n, figures['inequalities'],
                                                  os.path.join(options.build, 'highs'))
            result['highs excess'] = figures['energy'] / energy - 1
    return result


def measure_session(name, megapixels, options):
    folder = os.path.join(options.build, 'pages')
    drawing, scribbles, _ = make_page(name, megapixels, folder)
    relations = make_relations(name, drawing, folder)
    return {'case': name, 'megapixels': megapixels,
            **run('bench-session', options, drawing, scribbles, relations, options.strokes)}


# ------------------------------------------------------------------ tables

def by_megapixel(key):
    return lambda r: 1000 * r[key] / r['megapixels'] if key in r else None


def times(slow, fast):
    return lambda r: r[slow] / r[fast] if slow in r and r.get(fast) else None


LAPLACE_TABLES = [
    ('Equation (3): milliseconds a megapixel with set-up, true errors as a share of the range', [
        ('set-up', '.1f', by_megapixel('set-up 1e-3')),
        ('1e-3', '.1f', by_megapixel('ours 1e-3')),
        ('rounds', '.0f', figure('iterations 1e-3')),
        ('error', '.0e', figure('error 1e-3')),
        ('1/65535', '.1f', by_megapixel('ours 1/65535')),
        ('rounds', '.0f', figure('iterations 1/65535')),
        ('error', '.0e', figure('error 1/65535')),
        ('x threads', '.2f', times('two threads', 'one thread'))]),
    ('The same: milliseconds in all, and how many times longer than ours others take to the same error', [
        ('ours 1e-3', '.0f', milliseconds('ours 1e-3')),
        ('IC-CG', '.0f', milliseconds('iccg 1e-3')),
        ('x', '.0f', times('iccg 1e-3', 'ours 1e-3')),
        ('1/65535', '.0f', milliseconds('ours 1/65535')),
        ('IC-CG', '.0f', milliseconds('iccg 1/65535')),
        ('x', '.0f', times('iccg 1/65535', 'ours 1/65535')),
        ('CHOLMOD', '.0f', milliseconds('cholmod')),
        ('x 1e-3', '.0f', times('cholmod', 'ours 1e-3')),
        ('x 1/65535', '.0f', times('cholmod', 'ours 1/65535'))]),
]

DISTANCE_TABLES = [
    ('Distances: milliseconds a megapixel to the ink, and to one pixel', [
        ('near', '.1f', figure('near, ours')),
        ('textbook', '.1f', figure('near, textbook')),
        ('far', '.1f', figure('far, ours')),
        ('textbook', '.1f', figure('far, textbook')),
        ('different', '.0f', lambda r: r['near, different pixels'] + r['far, different pixels'])]),
]

SHADE_TABLES = [
    ('Normals and shading: milliseconds a megapixel', [
        ('normals', '.1f', figure('normals')),
        ('shading', '.1f', figure('shading'))]),
]

PROGRAM_TABLES = [
    ('The exact program: milliseconds from line art to depth, and after another gap for one relation', [
        ('nodes', '.0f', figure('nodes')),
        ('cold', '.0f', milliseconds('cold')),
        ('cold/MP', '.0f', by_megapixel('cold')),
        ('edit', '.2f', milliseconds('edit')),
        ('edit/MP', '.2f', by_megapixel('edit')),
        ('violation', '.0e', figure('violation')),
        ('cvxopt', '.0f', milliseconds('cvxopt')),
        ('x', '.0f', times('cvxopt', 'cold')),
        ('rounds', '.0f', figure('rounds')),
        ('error', '.0e', figure('error')),
        ('x edit', '.0f', times('cvxopt', 'edit')),
        ('excess', '.0e', figure('energy excess')),
        ('HiGHS', '.0f', milliseconds('highs')),
        ('x', '.0f', times('highs', 'cold')),
        ('excess', '.0e', figure('highs excess'))]),
]

SESSION_TABLES = [
    ('A session: milliseconds from an edit on, and to the exact depth', [
        ('preview', '.0f', milliseconds('depth preview')),
        ('worst', '.0f', milliseconds('depth preview, worst')),
        ('depth', '.0f', milliseconds('depth')),
        ('worst', '.0f', milliseconds('depth, worst')),
        ('exact pre', '.0f', milliseconds('exact preview')),
        ('exact', '.0f', milliseconds('exact, after it')),
        ('edit', '.1f', milliseconds('exact edit')),
        ('worst', '.1f', milliseconds('exact edit, worst'))]),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    names = lambda text: [name for name in text.split(',') if name]
    parser.add_argument('--build', default='build-bench', metavar='DIR', help=argparse.SUPPRESS)
    parser.add_argument('--cases', type=names, default=LAPLACE, metavar='NAME,...', help='of tests/cases')
    parser.add_argument('--sizes', type=lambda text: [float(s) for s in text.split(',')], default=[0.25, 1, 4],
                        metavar='MP,...', help='megapixels (0.25,1,4)')
    parser.add_argument('--programs', type=names, default=PROGRAM, metavar='NAME,...', help='for the exact program')
    parser.add_argument('--sides', type=lambda text: [int(s) for s in text.split(',') if s], default=SIDES,
                        metavar='PIXELS,...', help='of pictures for general solvers (48,128,256)')
    parser.add_argument('--session-sizes', type=lambda text: [float(s) for s in text.split(',') if s], default=[1, 8.3],
                        metavar='MP,...', help='of the pages that sessions are measured on (1,8.3)')
    parser.add_argument('--strokes', type=int, default=10, metavar='N', help='random ones in a session (10)')
    parser.add_argument('--highs', action='store_true', help="HiGHS's active set too, at 48 x 48; needs npm")
    parser.add_argument('--runs', type=int, default=5, metavar='N', help='of which medians are taken (5)')
    parser.add_argument('--cholmod', type=float, default=1, metavar='MP',
                        help='larger systems CHOLMOD need not solve (1)')
    parser.add_argument('--iccg', type=float, default=30, metavar='SECONDS',
                        help='when IC-CG gives up (30); 0: not at all')
    parser.add_argument('--json', action='store_true', help='prints all figures in JSON instead, and writes no file')
    parser.add_argument('--no-save', action='store_true', help='writes no file')
    options = parser.parse_args()

    systems, programs, distances, shades = [], [], [], []
    for size in options.sizes:
        for name in options.cases:
            print(f'{name}, {size:g} MP', file=sys.stderr)
            systems.append(measure_laplace(name, size, options))
            distances.append(measure_distance(name, size, options))
            shades.append(measure_shade(name, size, options))
    pages = [(side * side / 1e6, True) for side in options.sides] + [(size, False) for size in options.sizes]
    for size, rivals in pages:
        for name in options.programs:
            print(f'{name}, exact program, {size:g} MP', file=sys.stderr)
            programs.append(measure_program(name, size, options, rivals))
    sessions = []
    for size in options.session_sizes:
        for name in SESSION:
            print(f'{name}, session, {size:g} MP', file=sys.stderr)
            sessions.append(measure_session(name, size, options))
    if options.json:
        print(json.dumps({'systems': systems, 'distances': distances, 'shades': shades,
                          'programs': programs, 'sessions': sessions}, indent=1))
        return
    lines = [f'celdepth {version()}, one core of {processor()}; medians of {options.runs} runs', '']
    for tables, results in (LAPLACE_TABLES, systems), (DISTANCE_TABLES, distances), (SHADE_TABLES, shades), \
            (PROGRAM_TABLES, programs), (SESSION_TABLES, sessions):
        for title, columns in tables:
            lines += table(title, columns, results)
    save(lines, None if options.no_save else 'solvers')


if __name__ == '__main__':
    main()
