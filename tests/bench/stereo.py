#!/usr/bin/python3
"""Measures views from the side on one core; tests/bench/stereo builds and calls it.

Prints a table, and writes it to results/ under the version and the processor's name.  README.md says what the figures
are.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import argparse
import os

from pages import make_page, make_relations, milliseconds, processor, run, save, table, version


def measure(name, megapixels, options):
    folder = os.path.join(options.build, 'pages')
    drawing, scribbles, _ = make_page(name, megapixels, folder)
    figures = run('bench-stereo', options, drawing, scribbles, make_relations(name, drawing, folder), options.runs)
    return {'case': name, 'megapixels': megapixels, **figures}


COLUMNS = [
    ('layers', '.0f', lambda r: r['layers']),
    ('cut', '.0f', milliseconds('cut')),
    ('scene', '.0f', milliseconds('scene')),
    ('pair', '.0f', milliseconds('pair')),
    ('both ways', '.0f', milliseconds('both ways')),
    ('alone', '.0f', milliseconds('alone, scene')),
    ('pair', '.0f', milliseconds('alone, pair')),
    ('glasses', '.0f', milliseconds('glasses'))]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    names = lambda text: [name for name in text.split(',') if name]
    parser.add_argument('--build', default='build-bench', metavar='DIR', help=argparse.SUPPRESS)
    parser.add_argument('--cases', type=names, default=['frog', 'bee', 'caterpillar'], metavar='NAME,...',
                        help='of tests/cases')
    parser.add_argument('--sizes', type=lambda text: [float(s) for s in text.split(',')], default=[0.25, 1, 4],
                        metavar='MP,...', help='megapixels (0.25,1,4)')
    parser.add_argument('--runs', type=int, default=9, metavar='N', help='of which medians are taken (9)')
    parser.add_argument('--no-save', action='store_true', help='writes no file')
    options = parser.parse_args()

    results = [measure(name, size, options) for size in options.sizes for name in options.cases]
    lines = [f'celdepth {version()}, one core of {processor()}; medians of {options.runs} runs', '']
    lines += table('Milliseconds to cut layers, make a scene, and see it with two eyes', COLUMNS, results)
    save(lines, None if options.no_save else 'stereo')


if __name__ == '__main__':
    main()
