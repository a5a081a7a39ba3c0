#!/usr/bin/python3
"""Measures contour ownership on one core; tests/bench/ownership builds and calls it.

Prints tables, and writes them to results/ under the version and the processor's name.  README.md says what the figures
are.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import argparse
import json
import os
import sys

from pages import figure, make_page, make_relations, milliseconds, processor, run, save, table, version

CASES = ['folders', 'frog', 'bee', 'house', 'bee-pencil']


def measure(name, megapixels, options):
    folder = os.path.join(options.build, 'pages')
    drawing, scribbles, _ = make_page(name, megapixels, folder)
    relations = make_relations(name, drawing, folder)
    figures = run('bench-ownership', options, drawing, scribbles, relations, options.runs, options.edits)
    return {'case': name, 'megapixels': megapixels, **figures}


def by_megapixel(key):
    return lambda r: 1e9 * r[key] / r['pixels']


TABLES = [
    ('Milliseconds a megapixel, and bytes a pixel with the result', [
        ('regions', '.0f', figure('regions')),
        ('outlines', '.1f', by_megapixel('outlines')),
        ('thickness', '.1f', by_megapixel('thickness')),
        ('outl. peak', '.1f', figure('outlines peak')),
        ('thick peak', '.1f', figure('thickness peak')),
        ('kept', '.1f', figure('kept')),
        ('peak', '.1f', figure('peak'))]),
    ('Milliseconds after an edit in a session', [
        ('stroke', '.1f', milliseconds('stroke')),
        ('worst', '.1f', milliseconds('stroke worst')),
        ('relation', '.1f', milliseconds('relation')),
        ('worst', '.1f', milliseconds('relation worst')),
        ('correction', '.1f', milliseconds('correction')),
        ('worst', '.1f', milliseconds('correction worst'))]),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--build', default='build-bench', metavar='DIR', help=argparse.SUPPRESS)
    parser.add_argument('--cases', type=lambda text: text.split(','), default=CASES, metavar='NAME,...',
                        help='of tests/cases')
    parser.add_argument('--sizes', type=lambda text: [float(s) for s in text.split(',')], default=[1, 4, 8.3],
                        metavar='MP,...', help='megapixels (1,4,8.3)')
    parser.add_argument('--runs', type=int, default=5, metavar='N', help='of which medians are taken (5)')
    parser.add_argument('--edits', type=int, default=20, metavar='N', help='strokes, relations and corrections (20)')
    parser.add_argument('--json', action='store_true', help='prints all figures in JSON instead, and writes no file')
    parser.add_argument('--no-save', action='store_true', help='writes no file')
    options = parser.parse_args()

    results = []
    for size in options.sizes:
        for name in options.cases:
            print(f'{name}, {size:g} MP', file=sys.stderr)
            results.append(measure(name, size, options))
    if options.json:
        print(json.dumps(results, indent=1))
        return
    lines = [f'celdepth {version()}, one core of {processor()}; medians of {options.runs} runs, '
             f'{options.edits} edits of each kind', '']
    for title, columns in TABLES:
        lines += table(title, columns, results)
    save(lines, None if options.no_save else 'ownership')


if __name__ == '__main__':
    main()
