#!/usr/bin/python3
"""Measures the segmentation of drawings with ground truth on one core; tests/bench/segmentation builds and calls it.

Prints tables, and writes them to results/ under the version and the processor's name.  README.md says what the figures
are.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import argparse
import json
import os
import sys

from pages import make_page, milliseconds, processor, run, save, table, version

CLEAN = ['frog', 'bee', 'monkey', 'house', 'caterpillar']
VARIANTS = [f'{name}-{kind}' for kind in ('gappy', 'wide', 'pencil') for name in ('bee', 'monkey', 'caterpillar')]
BOOST = ['frog', 'monkey-gappy', 'caterpillar-pencil']


# ------------------------------------------------------------------ runs

def measure(name, megapixels, options):
    """The program's figures, by name."""
    pages = make_page(name, megapixels, os.path.join(options.build, 'pages'))
    numbers = options.runs, options.strokes, options.exact_strokes, int(name in options.boost_cases)
    kept = []
    if options.keep:
        os.makedirs(options.keep, exist_ok=True)
        kept.append(os.path.join(options.keep, f'{name}-{megapixels:g}-'))
    return {'case': name, 'megapixels': megapixels, **run('bench-segmentation', options, *pages, *numbers, *kept)}


# ------------------------------------------------------------------ tables

def times(slow, fast):
    return lambda r: r[slow] / r[fast] if slow in r and r.get(fast) else None


def of(settings, figure, factor=1):
    return lambda r: factor * r[settings][figure] if settings in r else None


def share(settings, figure):
    """Of the disputed pixels, in percent."""
    def percentage(r):
        disputed = r.get(settings, {}).get('disputed')
        return 100 * r[settings][figure] / disputed if disputed else None
    return percentage


TABLES = [
    ('Times in milliseconds', [
        ('ink', '.0f', milliseconds('ink')),
        ('coloured', '.0f', milliseconds('coloured ink')),
        ('read', '.0f', milliseconds('engine read')),
        ('build', '.1f', milliseconds('build')),
        ('build/MP', '.1f', lambda r: 1000 * r['build'] / r['megapixels']),
        ('first', '.1f', milliseconds('engine first')),
        ('again', '.2f', milliseconds('engine again')),
        ('cuts', '.2f', milliseconds('engine again, partition')),
        ('stroke', '.2f', milliseconds('engine stroke')),
        ('worst', '.1f', lambda r: 1000 * r['engine worst stroke']['seconds'] if 'engine worst stroke' in r else None),
        ('removed', '.2f', milliseconds('engine stroke removed')),
        ('exact', '.0f', milliseconds('exact first')),
        ('+stroke', '.0f', milliseconds('exact stroke')),
        ('boost', '.0f', milliseconds('boost first')),
        ('x first', '.0f', times('boost first', 'engine first')),
        ('x stroke', '.0f', times('boost first', 'engine stroke'))]),
    ('Bytes a pixel beyond input and output', [
        ('kept', '.2f', lambda r: r['engine kept']),
        ('peak', '.2f', lambda r: r['engine peak']),
        ('stroke', '.2f', lambda r: r.get('engine stroke peak')),
        ('exact', '.1f', lambda r: r.get('exact peak')),
        ('boost', '.0f', lambda r: r.get('boost peak'))]),
    ('Energy as a multiple of exact cuts, white pixels that agree with them (%)', [
        ('E soft', '.4f', of('soft', 'ratio')),
        ('E hard', '.4f', of('hard', 'ratio')),
        ('E messy', '.4f', of('messy', 'ratio')),
        ('E m. hard', '.4f', of('messy-hard', 'ratio')),
        ('disobeyed', '.0f', lambda r: r['hard']['disobeyed'] + r.get('messy-hard', {}).get('disobeyed', 0)
         if 'hard' in r else None),
        ('soft', '.3f', of('soft', 'agreement', 100)),
        ('hard', '.3f', of('hard', 'agreement', 100)),
        ('messy', '.3f', of('messy', 'agreement', 100)),
        ('m. hard', '.3f', of('messy-hard', 'agreement', 100)),
        ('default', '.3f', of('default', 'agreement', 100))]),
    ('Scored pixels that are right (%), and who is right of those that differ (%)', [
        ('exact', '.3f', of('soft', 'exact segment', 100)),
        ('soft', '.3f', of('soft', 'segment', 100)),
        ('differ', '.0f', of('soft', 'disputed')),
        ('soft', '.0f', share('soft', 'engine right')),
        ('exact', '.0f', share('soft', 'exact right')),
        ('default', '.3f', of('default', 'segment', 100)),
        ('differ', '.0f', of('default', 'disputed')),
        ('default', '.0f', share('default', 'engine right')),
        ('exact', '.0f', share('default', 'exact right'))]),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    names = lambda text: [name for name in text.split(',') if name]
    parser.add_argument('--build', default='build-bench', metavar='DIR', help=argparse.SUPPRESS)
    parser.add_argument('--cases', type=names, default=CLEAN + VARIANTS, metavar='NAME,...', help='of tests/cases')
    parser.add_argument('--large-cases', type=names, metavar='NAME,...', help='those above 2 megapixels (all)')
    parser.add_argument('--boost-cases', type=names, default=BOOST, metavar='NAME,...',
                        help=f'those that Boost solves too ({",".join(BOOST)})')
    parser.add_argument('--sizes', type=lambda text: [float(s) for s in text.split(',')], default=[1, 4, 8.3],
                        metavar='MP,...', help='megapixels (1,4,8.3)')
    parser.add_argument('--runs', type=int, default=5, metavar='N', help='of ink, build and first labels (5)')
    parser.add_argument('--strokes', type=int, default=50, metavar='N', help='random strokes (50)')
    parser.add_argument('--exact-strokes', type=int, default=1, metavar='N',
                        help='the same with exact cuts (1); -1: the engine alone')
    parser.add_argument('--keep', metavar='DIR', help='keeps the labels of every method, as PAM')
    parser.add_argument('--json', action='store_true', help='prints all figures in JSON instead, and writes no file')
    parser.add_argument('--no-save', action='store_true', help='writes no file')
    options = parser.parse_args()

    results = []
    for size in options.sizes:
        for name in options.large_cases or options.cases if size > 2 else options.cases:
            print(f'{name}, {size:g} MP', file=sys.stderr)
            results.append(measure(name, size, options))
    if options.json:
        print(json.dumps(results, indent=1))
        return
    lines = [f'celdepth {version()}, one core of {processor()}; '
             f'medians of {options.runs} runs and of {options.strokes} strokes', '']
    for title, columns in TABLES:
        lines += table(title, columns, results)
    save(lines, None if options.no_save else 'segmentation')


if __name__ == '__main__':
    main()
