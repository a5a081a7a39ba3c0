"""The cases with ground truth, by kind.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os

from brought import BROUGHT

VARIANTS = ['gappy', 'wide', 'crop', 'pencil']
MADE = ['sloppy', 'soft', 'pixel', *BROUGHT] # of the clean drawings, when they are asked for
KINDS = ['clean', *VARIANTS, *MADE]

# A few of every kind that are quickly made, for `tests/run` and `tests/same --quick`.
QUICK = ['bee', 'campfire', 'folders', 'monkey', 'people', 'bee-gappy', 'monkey-wide', 'bee-crop',
         'caterpillar-crop', 'house-crop', 'caterpillar-pencil', 'armadillo-sloppy', 'frog-sloppy',
         'people-sloppy', 'bee-soft', 'people-soft', 'bee-pixel', 'house-pixel', 'lemonade-pixel',
         'palette-pixel', 'bee-coloured', 'house-coloured', 'fly-tinted', 'folders-pastel', 'bee-photo',
         'campfire-scan', 'people-chalk']


def cases_in(folder, kinds):
    """(name, kind, folder) of every case of these kinds; one that is made has the folder of its clean drawing."""
    for name in sorted(os.listdir(folder)):
        path = os.path.join(folder, name)
        if os.path.exists(os.path.join(path, 'truth.json')):
            variant = name.rsplit('-', 1)[-1]
            kind = variant if variant in VARIANTS else 'clean'
            if kind in kinds:
                yield name, kind, path
            for made in MADE:
                if kind == 'clean' and made in kinds:
                    yield f'{name}-{made}', made, path


def relations_of(path):
    """A case's arrows in the grammar of relations."""
    with open(os.path.join(path, 'arrows.txt')) as f:
        return ''.join('{},{} > {},{}\n'.format(*line.split()) for line in f if line.strip())
