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

from PIL import Image

from pages import CASES, make_page, pin, processor, save, table, version

LAPLACE = ['frog', 'bee', 'caterpillar', 'bee-gappy', 'caterpillar-pencil']


# ------------------------------------------------------------------ pages and runs

def make_relations(name, page, folder):
    """A file with a case's relations, at the size of the page."""
    with open(page, 'rb') as f:
        head = dict(line.split() for line in f.read(100).split(b'\n') if line.count(b' ') == 1)
    with Image.open(os.path.join(CASES, name, 'drawing.png')) as drawing:
        scale = int(head[b'WIDTH']) / drawing.width, int(head[b'HEIGHT']) / drawing.height
    path = os.path.join(folder, os.path.basename(page)[:-4] + '.txt')
    with open(os.path.join(CASES, name, 'arrows.txt')) as arrows, open(path, 'w') as relations:
        for line in filter(str.strip, arrows):
            x0, y0, x1, y1 = (float(v) * scale[k % 2] for k, v in enumerate(line.split()))
            relations.write(f'{x0:.2f},{y0:.2f} > {x1:.2f},{y1:.2f}\n')
    return path


def run(program, options, *arguments, one_core=True):
    """The JSON that a program prints."""
    command = [os.path.join(options.build, 'tests', 'bench', program), *map(str, arguments)]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, preexec_fn=pin if one_core else None)
    if done.returncode:
        sys.exit(f'{" ".join(command)}: exit status {done.returncode}')
    return json.loads(done.stdout)


def measure_laplace(name, megapixels, options):
    folder = os.path.join(options.build, 'pages')
    drawing, scribbles, _ = make_page(name, megapixels, folder)
    relations = make_relations(name, drawing, folder)
    cholmod = megapixels <= options.cholmod
    figures = run('bench-laplace', options, drawing, scribbles, relations, options.runs, int(cholmod),
                  options.iccg if cholmod else 0)
    return {'case': name, 'megapixels': megapixels, **figures}


# ------------------------------------------------------------------ tables

def milliseconds(key):
    return lambda r: 1000 * r[key] if key in r else None


def by_megapixel(key):
    return lambda r: 1000 * r[key] / r['megapixels'] if key in r else None


def figure(key):
    return lambda r: r.get(key)


def times(slow, fast):
    return lambda r: r[slow] / r[fast] if slow in r and r.get(fast) else None


TABLES = [
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


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    names = lambda text: [name for name in text.split(',') if name]
    parser.add_argument('--build', default='build-bench', metavar='DIR', help=argparse.SUPPRESS)
    parser.add_argument('--cases', type=names, default=LAPLACE, metavar='NAME,...', help='of tests/cases')
    parser.add_argument('--sizes', type=lambda text: [float(s) for s in text.split(',')], default=[0.25, 1, 4],
                        metavar='MP,...', help='megapixels (0.25,1,4)')
    parser.add_argument('--runs', type=int, default=5, metavar='N', help='of which medians are taken (5)')
    parser.add_argument('--cholmod', type=float, default=1, metavar='MP',
                        help='larger systems CHOLMOD need not solve (1)')
    parser.add_argument('--iccg', type=float, default=30, metavar='SECONDS',
                        help='when IC-CG gives up (30); 0: not at all')
    parser.add_argument('--json', action='store_true', help='prints all figures in JSON instead, and writes no file')
    parser.add_argument('--no-save', action='store_true', help='writes no file')
    options = parser.parse_args()

    results = []
    for size in options.sizes:
        for name in options.cases:
            print(f'{name}, {size:g} MP', file=sys.stderr)
            results.append(measure_laplace(name, size, options))
    if options.json:
        print(json.dumps(results, indent=1))
        return
    lines = [f'celdepth {version()}, one core of {processor()}; medians of {options.runs} runs', '']
    for title, columns in TABLES:
        lines += table(title, columns, results)
    save(lines, None if options.no_save else 'solvers')


if __name__ == '__main__':
    main()
