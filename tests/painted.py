"""Paints arrows with an unsteady hand, in every style.

A stroke bends, trembles, starts and ends thin or blunt, varies in width by a tenth; heads are askew, their barbs
unequal and bent; brushes are hard or soft.  Everything is drawn SAMPLES times as large and reduced.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import math

import numpy as np
from PIL import Image, ImageChops, ImageDraw
from scipy import ndimage

STYLES = ['open', 'filled', 'dot', 'fade', 'taper']      # of a stroke; the first two are the arrow style `head`
SAMPLES = 4
POINTS = 40


def style_of(kind):
    """The `--arrow-style` that reads strokes of a kind."""
    return 'head' if kind in ('open', 'filled') else kind


class Canvas:
    """The opacity of one stroke: a tile of the layer, finer than its pixels."""

    def __init__(self, points, margin):
        points = np.asarray(points)
        self.left, self.top = (int(v) for v in np.floor(points.min(0) - margin))
        size = np.ceil(points.max(0) + margin).astype(int) - (self.left, self.top)
        self.opacity = Image.new('L', (int(size[0]) * SAMPLES, int(size[1]) * SAMPLES))

    def place(self, points):
        return [((x - self.left) * SAMPLES, (y - self.top) * SAMPLES) for x, y in points]

    def polygon(self, points):
        ImageDraw.Draw(self.opacity).polygon(self.place(points), fill=255)

    def stroke(self, points, widths, opacities):
        """Discs along a line, and what lies between them; faint ones first where opacities fall."""
        mask = Image.new('L', self.opacity.size)
        draw = ImageDraw.Draw(mask)
        fades = max(opacities) > min(opacities)
        steps = []
        for i, (a, b) in enumerate(zip(points, points[1:])):
            n = max(1, math.ceil(math.dist(a, b))) if fades else 1
            t = np.arange(n + 1)[:, None] / n
            ends = np.array([[*a, widths[i], opacities[i]], [*b, widths[i + 1], opacities[i + 1]]])
            steps.extend(ends[0] + t * (ends[1] - ends[0]))
        steps = np.array(steps) * (SAMPLES, SAMPLES, SAMPLES / 2, 255) - (self.left * SAMPLES, self.top * SAMPLES, 0, 0)
        for k in np.argsort(steps[:, 3], kind='stable'):
            x, y, r, opacity = steps[k]
            draw.ellipse([x - r, y - r, x + r, y + r], fill=round(opacity))
            if k + 1 < len(steps):
                u, v, q, _ = steps[k + 1]
                length = max(math.hypot(u - x, v - y), 1e-9)
                i, j = (v - y) / length, (x - u) / length
                draw.polygon([(x + r * i, y + r * j), (u + q * i, v + q * j), (u - q * i, v - q * j),
                              (x - r * i, y - r * j)], fill=round(opacity))
        self.opacity = ImageChops.lighter(self.opacity, mask)

    def reduced(self):
        return np.asarray(self.opacity.reduce(SAMPLES), np.float32) / 255


def smooth_noise(rng, n, waves):
    """Random values of deviation 1 that change smoothly, 0 at both ends."""
    t = np.linspace(0, 1, n)
    return sum(rng.normal() * np.sin(math.pi * k * t) for k in range(1, waves + 1)) / math.sqrt(waves / 2)


def hand_line(rng, a, b, width):
    """From a to b: bent by up to a seventh of its length, and trembling."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    length = math.dist(a, b)
    normal = np.array([a[1] - b[1], b[0] - a[0]]) / length
    t = np.linspace(0, 1, POINTS)[:, None]
    bow = np.clip(rng.normal(0, 0.05), -0.14, 0.14) * length * np.sin(math.pi * t)
    tremble = min(0.12 * width, 0.02 * length) * smooth_noise(rng, POINTS, max(2, round(length / 25)))[:, None]
    return a + (b - a) * t + normal * (bow + tremble)


def barb(rng, tip, angle, length, width):
    """One line of a head, from the tip back; it may miss the tip by a little."""
    start = np.asarray(tip) + rng.normal(0, 0.08 * width, 2)
    end = start - length * np.array([math.cos(angle), math.sin(angle)])
    bend = rng.normal(0, 0.06) * length * np.array([math.sin(angle), -math.cos(angle)])
    return [tuple(start), tuple((start + end) / 2 + bend), tuple(end)]


def paint_head(canvas, rng, line, width, filled):
    """At the last point of the line."""
    tip, length = line[-1], math.dist(line[0], line[-1])
    size = min(rng.uniform(3.2, 4.6) * width, 0.45 * length)
    back = next(p for p in line[::-1] if math.dist(p, tip) >= size)
    angle = math.atan2(tip[1] - back[1], tip[0] - back[0]) + rng.normal(0, 0.06)
    spread = rng.uniform(0.45, 0.68)
    lengths = size * rng.uniform(0.88, 1.12, 2)
    barbs = [barb(rng, tip, angle + s * (spread + rng.normal(0, 0.05)), l, width) for s, l in zip((1, -1), lengths)]
    if not filled:
        for points in barbs:
            canvas.stroke(points, [width, width, rng.uniform(0.7, 1) * width], [1, 1, 1])
        return line
    ahead = tip + 0.4 * width * np.array([math.cos(angle), math.sin(angle)])
    canvas.polygon([tuple(ahead), barbs[0][2], barbs[1][2]])
    outside = next(i for i in range(len(line) - 1, -1, -1) if math.dist(line[i], tip) > 0.5 * size)
    start, way = line[outside], line[outside + 1] - line[outside]
    inside = next(t for t in np.arange(0, 1.05, 0.05) if math.dist(start + t * way, tip) <= 0.5 * size)
    return np.concatenate([line[:outside + 1], [start + inside * way]])      # the head hides how the shaft ends


def paint_arrow(rng, line, width, kind):
    """One stroke along a line from a nearer to a farther place: (left, top, opacity)."""
    t = np.linspace(0, 1, POINTS)
    widths = width * (1 + 0.05 * smooth_noise(rng, POINTS, 5))
    canvas = Canvas(line, 6 * width + 6)
    opacity = np.ones(POINTS)
    if kind in ('open', 'filled'):
        pressure = np.clip(t / rng.uniform(0.02, 0.15), rng.uniform(0.6, 1), 1)    # pens may start thin
        shaft = paint_head(canvas, rng, line, width, kind == 'filled')
        canvas.stroke(shaft, (widths * pressure)[:len(shaft)], opacity[:len(shaft)])
    elif kind == 'dot':
        r = rng.uniform(1.2, 1.7) * width
        blob = [tuple(line[0] + r * rng.uniform(0.9, 1.1) * np.array([math.cos(a), math.sin(a)]))
                for a in np.linspace(0, 2 * math.pi, 12, endpoint=False)]
        canvas.polygon(blob)
        canvas.stroke(line, widths, opacity)
    elif kind == 'fade':
        opaque = rng.uniform(0, 0.3)
        opacity = 1 - np.clip((t - opaque) / (1 - opaque), 0, 1) * rng.uniform(0.82, 0.95)
        canvas.stroke(line, widths, opacity)
    else:
        canvas.stroke(line, widths * (1 - t * rng.uniform(0.65, 0.85)), opacity)
    alpha = canvas.reduced()
    if rng.random() < 0.5:
        alpha = ndimage.gaussian_filter(alpha, rng.uniform(0.2, 0.15 + 0.08 * width))  # a soft brush
    return canvas.left, canvas.top, alpha


class Layer:
    """An arrows layer: R'G'B' and alpha, each stroke above those before it."""

    def __init__(self, width, height):
        self.colour = np.zeros((height, width, 3))
        self.alpha = np.zeros((height, width))

    def box(self, stroke):
        """The part of a stroke's tile that lies in the layer: slices of the layer and of the tile."""
        left, top, alpha = stroke
        height, width = self.alpha.shape
        x0, y0 = max(0, left), max(0, top)
        x1, y1 = min(width, left + alpha.shape[1]), min(height, top + alpha.shape[0])
        return np.s_[y0:y1, x0:x1], np.s_[y0 - top:y1 - top, x0 - left:x1 - left]

    def add(self, stroke, colour):
        here, there = self.box(stroke)
        above = np.clip(stroke[2][there], 0, 1)
        below = self.alpha[here] * (1 - above)
        alpha = above + below
        share = np.divide(above, alpha, out=np.zeros_like(alpha), where=alpha > 0)[..., None]
        self.colour[here] += share * (np.asarray(colour) - self.colour[here])
        self.alpha[here] = alpha

    def picture(self, paper=None):
        """With alpha, or on paper without."""
        if paper is None:
            data = np.dstack([self.colour, 255 * self.alpha])
            return Image.fromarray(np.round(data).astype(np.uint8), 'RGBA')
        data = np.asarray(paper) + self.alpha[..., None] * (self.colour - np.asarray(paper))
        return Image.fromarray(np.round(data).astype(np.uint8), 'RGB')
