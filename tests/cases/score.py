#!/usr/bin/python3
"""Scores a result on one case against its ground truth.

score.py CASE [--labels L.png] [--levels D] [--depth D]
  --labels  picture in the scribbles' colours (what segmentation gives)
  --levels  levels after depth expansion, larger = nearer (.npy, float .tif or 16-bit .png)
  --depth   smooth depth, larger = nearer (same formats)
Prints one 'name value' a line, each a share in [0,1], higher is better:
  segment   share of paper pixels of scribbled shapes that carry the right label
  iou       mean over shapes of intersection over union on paper pixels
  order     share of touching pairs whose nearer shape has the larger median level
  owner     share of contour pixels that lie at the level of the shape that owns the contour
  contested the same, only for contour pixels where two shapes meet (the hard ones)
  order-smooth  order, by smooth depth
  held      share of paper pixels whose smooth depth stays within a tenth of a level step of their shape's median
            (closed contours: depth must not leak through them)

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import argparse
import json
import os
import sys

import numpy as np
from PIL import Image
from scipy import ndimage

NO_SHAPE = 255  # in truth.png: ink, or too small to scribble on


def load(path):
    """One channel of a picture or array, as float64."""
    a = np.load(path) if path.endswith('.npy') else np.array(Image.open(path))
    return np.asarray(a[..., 0] if a.ndim == 3 else a, np.float64)


class Case:
    """The ground truth of one folder."""

    def __init__(self, folder):
        def grey(name):
            return np.array(Image.open(os.path.join(folder, name)))

        with open(os.path.join(folder, 'truth.json')) as f:
            self.facts = json.load(f)
        self.shapes = self.facts['shapes']
        self.truth, self.owner, self.ink = grey('truth.png'), grey('owner.png'), grey('ink.png') > 127

    def check_size(self, picture):
        if picture.shape[:2] != self.truth.shape:
            sys.exit(f'size {picture.shape[:2]} is not {self.truth.shape}')
        return picture

    def medians(self, depth):
        return {i: np.median(depth[self.truth == i]) for i in self.shapes if (self.truth == i).any()}

    def order(self, median):
        span = (max(median.values()) - min(median.values())) or 1.0
        pairs = [(a, b) for a, b in self.facts['nearer_farther'] if a in median and b in median]
        return np.mean([median[a] - median[b] > 1e-4 * span for a, b in pairs]) if pairs else None


def table(median):
    """Shape number -> median; NaN for shapes that are not scored."""
    values = np.full(256, np.nan)
    values[list(median)] = list(median.values())
    return values


def score_labels(case, path):
    labels = case.check_size(np.array(Image.open(path).convert('RGB')).astype(int))
    shape = np.full(case.truth.shape, -1)
    for i in case.shapes:
        shape[np.all(np.abs(labels - case.facts['colours'][str(i)]) <= 2, -1)] = i
    known = case.truth != NO_SHAPE
    iou = []
    for i in case.shapes:
        found, wanted = (shape == i) & known, case.truth == i
        if wanted.any():
            iou.append((found & wanted).sum() / (found | wanted).sum())
    return {'segment': (shape == case.truth)[known].mean(), 'iou': np.mean(iou)}


def contested(case, level_of, gap):
    """Contour pixels with paper of two different levels within twice the thickest contour."""
    reach = 2 * max(3, int(np.ceil(2 * ndimage.distance_transform_edt(case.ink).max())) + 1) + 1
    paper, level = case.truth != NO_SHAPE, level_of[np.minimum(case.truth, NO_SHAPE - 1)]
    highest = ndimage.maximum_filter(np.where(paper, level, -np.inf), reach)
    lowest = ndimage.minimum_filter(np.where(paper, level, np.inf), reach)
    return np.isfinite(highest) & np.isfinite(lowest) & (highest - lowest > 0.5 * gap)


def score_levels(case, path):
    levels = case.check_size(load(path))
    median = case.medians(levels)
    level_of = table(median)
    distinct = sorted(set(np.round(list(median.values()), 6)))
    gap = min(np.diff(distinct)) if len(distinct) > 1 else 1.0
    wanted = level_of[case.owner]
    scored = case.ink & ~np.isnan(wanted)
    right = np.abs(levels - wanted) < 0.5 * gap
    hard = scored & contested(case, level_of, gap)
    return {'order': case.order(median), 'owner': right[scored].mean(),
            'contested': right[hard].mean() if hard.any() else None}


def score_depth(case, path):
    depth = case.check_size(load(path))
    median = case.medians(depth)
    values = np.sort(list(median.values()))
    span = (values[-1] - values[0]) or 1.0
    steps = np.diff(values)
    steps = steps[steps > 1e-3 * span]
    gap = steps.min() if len(steps) else span
    known = np.isin(case.truth, list(median))
    held = np.abs(depth - table(median)[case.truth]) < 0.1 * gap
    return {'order-smooth': case.order(median), 'held': held[known].mean()}


def score(folder, labels=None, levels=None, depth=None):
    """The figures by name; None for one that this case cannot tell."""
    case, figures = Case(folder), {}
    if labels:
        figures.update(score_labels(case, labels))
    if levels:
        figures.update(score_levels(case, levels))
    if depth:
        figures.update(score_depth(case, depth))
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('case')
    for name in ('labels', 'levels', 'depth'):
        parser.add_argument('--' + name)
    arguments = parser.parse_args()
    for name, value in score(arguments.case, arguments.labels, arguments.levels, arguments.depth).items():
        if value is not None:
            print(f'{name} {value:.5f}')


if __name__ == '__main__':
    main()
