"""Clips with ground truth, made from drawings of cases/ whose whole shapes are known: parts swing round their joints.

A part hangs on the part that it overlaps most, the largest being the root, and the joint is the middle of the overlap.
Parts swing like pendulums with a period of 8 frames, by up to 15 degrees a frame each, in addition to what they hang on;
small ones that lie wholly on another, such as eyes, by a third of that.  The root moves by up to 2 % of the page a frame.
What nearer parts hide gets an outline of the same width.  Frame 0 is the drawing.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import os

import numpy as np
from PIL import Image
from scipy import ndimage

SIDE = 720           # pixels of the page
FINE = 2             # pages are drawn so many times larger, and then reduced
MARGIN = 0.15        # of the page, at each side
FASTEST = np.radians(15)
LEAP = 4             # the frame that cannot be followed
UNKNOWN = 255        # in a truth: ink, or not scored


class Layers:
    """The drawing's layers from far to near: mask, grey values and truth of each, as (SIDE * FINE)^2 pages."""

    def __init__(self, folder):
        with open(os.path.join(folder, 'truth.json')) as file:
            self.facts = json.load(file)
        grey, truth = (np.array(Image.open(os.path.join(folder, name + '.png'))) for name in ('drawing', 'truth'))
        full = np.load(os.path.join(folder, 'full.npz'))
        masks = np.unpackbits(full['masks'], axis=2)[:, :, :grey.shape[1]] > 0
        order = np.argsort(full['shapes'])
        self.shapes = [int(full['shapes'][i]) for i in order]
        self.mask, self.grey, self.truth = [], [], []
        width, seen = pen_width(grey), np.zeros(grey.shape, bool)
        for i in order[::-1]:
            texture = self.texture(masks[i], grey, truth, int(full['shapes'][i]), seen, width)
            for layers, picture in zip((self.mask, self.grey, self.truth), texture):
                layers.insert(0, picture)
            seen |= masks[i]
        self.scale = SIDE * (1 - 2 * MARGIN) / max(grey.shape)
        self.offset = [(SIDE - side * self.scale) / 2 for side in grey.shape]
        self.rows, self.columns = ([(np.flatnonzero(mask.any(axis))[0], np.flatnonzero(mask.any(axis))[-1] + 1)
                                    for mask in self.mask] for axis in (1, 0))
        self.joints()

    @staticmethod
    def texture(mask, grey, truth, shape, nearer, width):
        """What of a layer is visible as it is drawn, the rest as white with an outline, without the nearer line's edge."""
        hidden = ndimage.binary_dilation(nearer, iterations=2) & mask
        band = mask & (ndimage.distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1] <= width)
        value = np.where(hidden, np.where(band, 0, 255), grey)
        label = np.where(hidden, np.where(band, UNKNOWN, shape), truth)
        outside = ndimage.distance_transform_edt(~mask, return_distances=False, return_indices=True)
        return mask, value[tuple(outside)].astype(np.float32), label.astype(np.uint8)

    def joints(self):
        """parent[k] of each layer, -1 of a root; and the joint as (y, x) of the drawing."""
        n = len(self.mask)
        wide = [ndimage.binary_dilation(mask, iterations=3) for mask in self.mask]
        common = np.array([[(wide[a] & wide[b]).sum() if a != b else 0 for b in range(n)] for a in range(n)])
        area = np.array([mask.sum() for mask in self.mask])
        self.parent, self.joint, self.small = [-1] * n, [None] * n, [False] * n
        self.order, left = [], set(range(n))
        while left:
            pairs = [(common[k, p], k, p) for k in left for p in self.order if common[k, p]]
            if pairs:
                _, k, self.parent[k] = max(pairs)
                at = np.argwhere(wide[k] & wide[self.parent[k]])
                self.small[k] = (self.mask[k] & self.mask[self.parent[k]]).sum() > 0.9 * area[k]
                self.small[k] &= area[k] < 0.1 * area[self.parent[k]]
            else:
                k = max(left, key=lambda k: area[k])
                at = np.argwhere(self.mask[k])
            self.joint[k] = at.mean(0)
            self.order.append(k)
            left.remove(k)


def pen_width(grey):
    """Of the lines: twice the median of the largest distances of ink to paper, in pixels."""
    inside = ndimage.distance_transform_edt(grey < 128)
    ridge = (inside == ndimage.maximum_filter(inside, 3)) & (inside > 0)
    return 2 * np.median(inside[ridge])


class Swing:
    """Angles and places of all layers by time, from a seed."""

    def __init__(self, layers, seed):
        random = np.random.default_rng(seed)
        n = len(layers.mask)
        self.layers, self.rate = layers, 2 * np.pi / 8
        self.most = FASTEST / self.rate * random.uniform(0.5, 1, n)
        self.most[[parent < 0 for parent in layers.parent]] *= 0.2
        self.most[np.array(layers.small)] /= 3
        self.phase = random.uniform(0, 2 * np.pi, n)
        self.drift = random.uniform(-1, 1, (n, 2)) * 0.02 / np.sqrt(2) * max(layers.grey[0].shape)

    def angle(self, k, frame):
        return self.most[k] * (np.sin(self.rate * frame + self.phase[k]) - np.sin(self.phase[k]))

    def poses(self, frame):
        """For each layer a matrix and a shift that take (y, x) of the drawing to where it is."""
        poses = [None] * len(self.layers.mask)
        for k in self.layers.order:
            c, s = np.cos(self.angle(k, frame)), np.sin(self.angle(k, frame))
            turn, joint, parent = np.array([[c, s], [-s, c]]), self.layers.joint[k], self.layers.parent[k]
            shift = joint - turn @ joint
            if parent < 0:
                poses[k] = turn, shift + self.drift[k] * frame
            else:
                poses[k] = poses[parent][0] @ turn, poses[parent][0] @ shift + poses[parent][1]
        return poses


class Leap(Swing):
    """A swing in which one part, the largest that hangs on another, turns by 60 degrees before frame LEAP."""

    def angle(self, k, frame):
        hanging = [k for k in self.layers.order if self.layers.parent[k] >= 0]
        leaps = frame >= LEAP and k == max(hanging, key=lambda k: self.layers.mask[k].sum())
        return super().angle(k, frame) + leaps * np.radians(60)


class Stranger(Swing):
    """A swing whose frame LEAP is as good as another drawing: parts turned by a right angle and scattered."""

    def poses(self, frame):
        poses = super().poses(frame)
        if frame != LEAP:
            return poses
        middle, turn = np.array(self.layers.grey[0].shape) / 2, np.array([[0, 1], [-1, 0]])
        return [(matrix @ turn, matrix @ (joint - turn @ joint) + shift + 2 * (middle - joint))
                for (matrix, shift), joint in zip(poses, self.layers.joint)]


def draw(layers, poses):
    """The page, 8-bit grey, and its truth."""
    side, scale = SIDE * FINE, layers.scale * FINE
    page = np.full((side, side), 255, np.float32)
    truth = np.zeros((side, side), np.uint8)
    for k, (turn, shift) in enumerate(poses):
        start = FINE * np.array(layers.offset) + scale * shift
        corners = [start + scale * turn @ [y, x] for y in layers.rows[k] for x in layers.columns[k]]
        first = np.clip(np.min(corners, 0).astype(int) - 2, 0, side)
        last = np.clip(np.max(corners, 0).astype(int) + 3, first, side)
        back = turn.T / scale
        origin = back @ (first + 0.5 - start) - 0.5

        def moved(picture, order):
            return ndimage.affine_transform(picture, back, origin, tuple(last - first), np.float32, order, cval=0)

        if (last > first).all():
            box = slice(first[0], last[0]), slice(first[1], last[1])
            there = moved(layers.mask[k].astype(np.float32), 1) > 0.5
            page[box][there] = moved(layers.grey[k], 1)[there]
            truth[box][there] = moved(layers.truth[k], 0)[there]
    grey = page.reshape(SIDE, FINE, SIDE, FINE).mean((1, 3)).round().astype(np.uint8)
    blocks = truth.reshape(SIDE, FINE, SIDE, FINE)
    same = (blocks.max((1, 3)) == blocks.min((1, 3))) & (grey >= 250)
    return grey, np.where(same, blocks[:, 0, :, 0], UNKNOWN).astype(np.uint8)


def make(case, folder, frames, seed, motion=Swing):
    """Writes frame_NNN.png, truth_NNN.png and truth.json as in clips/README.md, and arrows.txt of the case."""
    layers = Layers(case)
    swing = motion(layers, seed)
    for frame in range(frames):
        for name, picture in zip(('frame', 'truth'), draw(layers, swing.poses(frame))):
            Image.fromarray(picture).save(os.path.join(folder, f'{name}_{frame:03d}.png'))
    if motion is Stranger:
        nothing = np.full((SIDE, SIDE), UNKNOWN, np.uint8)
        Image.fromarray(nothing).save(os.path.join(folder, f'truth_{LEAP:03d}.png'))
    facts = {name: layers.facts[name] for name in ('shapes', 'colours', 'nearer_farther')}
    with open(os.path.join(folder, 'truth.json'), 'w') as file:
        json.dump({**facts, 'frames': frames}, file)
