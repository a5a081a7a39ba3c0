#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The paper's situations as small drawings of our own.

figures.py OUTDIR   writes one folder a figure: drawing.png and, where the figure has them, scribbles.png,
                    contours.png, relations.txt and owner.png (who drew each ink pixel, as grey level: the label's
                    index in the order below, 255 = paper).
What must come out of each is stated and asserted in test-figures.py.
"""
import math
import os
import sys

import numpy as np
from PIL import Image, ImageDraw, ImageFilter

SCALE = 4                                  # drawn this much larger, then reduced: antialiased ink
RED, BLUE, GREEN = (255, 0, 0), (0, 0, 255), (0, 160, 0)
A, B, C, D = (220, 60, 60), (60, 140, 220), (240, 180, 40), (120, 200, 80)      # scribble colours


class Figure:
    """A page of ink and its layers, in pixels of the finished picture."""

    def __init__(self, width=240, height=200):
        self.size = width, height
        self.page = Image.new('L', (width * SCALE, height * SCALE), 255)
        self.ink = ImageDraw.Draw(self.page)
        self.owner = Image.new('L', self.size, 255)
        self.layers = {}
        self.relations = None

    def line(self, points, width=4):
        """An ink line with round ends."""
        big = [(x * SCALE, y * SCALE) for x, y in points]
        r = width * SCALE / 2
        self.ink.line(big, 0, int(width * SCALE))
        for x, y in big:
            self.ink.ellipse((x - r, y - r, x + r, y + r), 0)

    def shape(self, points, width=4, index=None):
        """A white sheet with an ink outline: hides what is below it."""
        self.ink.polygon([(x * SCALE, y * SCALE) for x, y in points], 255)
        if index is not None:                  # the sheet hides older ink; its outline is its own
            mask = ImageDraw.Draw(self.owner)
            mask.polygon(points, 255)
            mask.line(points + points[:2], index, width + 2, joint='curve')
        self.line(points + points[:1], width)

    def rub_out(self, left, top, right, bottom):
        """Makes an ellipse of paper in this box."""
        self.ink.ellipse([v * SCALE for v in (left, top, right, bottom)], 255)

    def stroke(self, layer, points, colour, width=5):
        """A hard-edged stroke on a layer that is transparent elsewhere."""
        picture = self.layers.setdefault(layer, Image.new('RGBA', self.size, (0, 0, 0, 0)))
        ImageDraw.Draw(picture).line(points, colour + (255,), width, joint='curve')

    def save(self, folder):
        os.makedirs(folder, exist_ok=True)
        self.page.resize(self.size, Image.BOX).save(os.path.join(folder, 'drawing.png'))
        self.owner.save(os.path.join(folder, 'owner.png'))
        for layer, picture in self.layers.items():
            picture.save(os.path.join(folder, layer + '.png'))
        if self.relations is not None:
            with open(os.path.join(folder, 'relations.txt'), 'w') as file:
                file.write(self.relations + '\n')


def box(left, top, right, bottom):
    return [(left, top), (right, top), (right, bottom), (left, bottom)]


def two_arrows():
    """Figure 2: two arrows only.  Two legs that are open at the top into the body, one before it and one behind it."""
    f = Figure()
    f.line([(30, 60), (60, 30), (180, 30), (210, 60), (210, 110), (190, 120)])
    f.line([(190, 120), (190, 180), (150, 180), (150, 80)])        # the far leg: its left side runs up into the body
    f.line([(150, 122), (90, 122)])
    f.line([(90, 80), (90, 180), (50, 180), (50, 80)])             # the near leg: both sides run up into the body
    f.line([(50, 120), (30, 110), (30, 60)])
    f.relations = '70,105 > 115,100\n125,100 > 172,150'         # each across the contour that tells
    return f


def thick():
    """Figure 3: thick contours, T-junctions and a small gap.  A bar runs behind a disc-like sheet."""
    f = Figure()
    f.shape(box(20, 80, 220, 120), 10, 1)
    f.shape(box(80, 40, 160, 160), 10, 2)
    f.rub_out(117, 152, 123, 168)   # a gap in the front sheet's lower side
    f.stroke('scribbles', [(100, 60), (140, 140)], A)
    f.stroke('scribbles', [(35, 100), (65, 100)], B)
    f.stroke('scribbles', [(175, 100), (205, 100)], B)
    f.stroke('scribbles', [(10, 15), (230, 15)], C)
    f.relations = '#dc3c3c > #3c8cdc; #3c8cdc > #f0b428'
    return f


def contours():
    """Figure 6: a wrinkle erased (green), a contour introduced (red), a cut for segmentation only (blue)."""
    f = Figure()
    f.shape(box(20, 30, 220, 170))
    f.line([(60, 30), (60, 168)])                                   # the wrinkle
    f.stroke('contours', [(60, 36), (60, 164)], GREEN, 9)
    f.stroke('contours', [(120, 30), (120, 170)], RED, 3)
    f.stroke('contours', [(170, 30), (170, 170)], BLUE, 3)
    f.stroke('scribbles', [(35, 60), (105, 60)], A, 6)
    f.stroke('scribbles', [(145, 60), (145, 140)], B, 6)
    f.stroke('scribbles', [(195, 60), (195, 140)], C, 6)
    f.stroke('scribbles', [(10, 10), (230, 10)], D, 6)
    f.relations = '#dc3c3c > #3c8cdc > #f0b428 > #78c850'
    return f


def two_characters():
    """Two characters that have nothing to do with each other, on a background without a scribble."""
    f = Figure()
    f.shape(box(30, 40, 90, 160))
    f.shape(box(140, 60, 210, 170))
    f.stroke('scribbles', [(50, 60), (70, 140)], A)
    f.stroke('scribbles', [(160, 80), (190, 150)], B)
    return f


def frame():
    """Shapes that are cut by the frame: a hill along the lower edge and a tree that leaves at the top."""
    f = Figure()
    f.line([(-10, 130), (60, 110), (150, 125), (250, 105)])
    f.shape([(150, -20), (190, -20), (190, 150), (150, 150)])
    f.stroke('scribbles', [(30, 160), (120, 170)], A)
    f.stroke('scribbles', [(170, 20), (170, 130)], B)
    f.stroke('scribbles', [(30, 30), (120, 60)], C)
    f.stroke('scribbles', [(205, 30), (225, 60)], C)
    f.relations = '#3c8cdc > #dc3c3c > #f0b428'
    return f


def limbs():
    """Limbs of one colour on both sides of a body, one before it and one behind it."""
    f = Figure()
    f.shape(box(130, 90, 220, 120))
    f.shape(box(80, 30, 160, 180))
    f.shape(box(20, 60, 110, 90))
    f.stroke('scribbles', [(35, 75), (95, 75)], A)
    f.stroke('scribbles', [(175, 105), (205, 105)], A)
    f.stroke('scribbles', [(120, 120), (120, 165)], B)
    f.stroke('scribbles', [(10, 15), (230, 15)], C)
    f.relations = '60,75 > 120,150 > 190,105 > 120,15'
    return f


def cycle():
    """Three leaves that overlap in a circle, each before the next."""
    f = Figure()
    f.shape(box(20, 20, 220, 180))
    f.line([(120, 100), (120, 20)])
    f.line([(120, 100), (20, 180)])
    f.line([(120, 100), (220, 180)])
    f.stroke('scribbles', [(45, 50), (85, 80)], A)
    f.stroke('scribbles', [(195, 50), (155, 80)], B)
    f.stroke('scribbles', [(100, 160), (140, 160)], C)
    f.relations = '60,60 > 180,60\n180,60 > 120,160\n120,160 > 60,60'
    return f


def broken():
    """An outline with a gap on each side of the line between two rooms; the right one is covered by a blue contour."""
    f = Figure()
    f.shape(box(20, 30, 220, 170))
    f.line([(30, 100), (210, 100)])
    for x in 70, 170:
        f.rub_out(x - 8, 92, x + 8, 108)
    f.stroke('contours', [(155, 100), (185, 100)], BLUE, 5)
    f.stroke('scribbles', [(35, 60), (205, 60)], A, 6)
    f.stroke('scribbles', [(35, 140), (205, 140)], B, 6)
    f.stroke('scribbles', [(10, 10), (230, 10)], C, 6)
    f.relations = '#dc3c3c > #3c8cdc > #f0b428'
    return f


def pinched(pinch, gap):
    """An hourglass whose right half is not painted: a neck of `pinch` pixels, a gap of so many stroke widths."""
    f = Figure()

    def depth(x):
        return (57.875 - pinch / 2) * math.exp(-((x - 120) / 22) ** 2)     # PIL's lines are a little thicker
    f.shape([(x, 40 + depth(x)) for x in range(20, 221)] + [(x, 160 - depth(x)) for x in range(220, 19, -1)])
    left = 175 - 2 * gap
    f.ink.rectangle([v * SCALE for v in (left, 36, 175 + 2 * gap, 44 + depth(left))], 255)
    f.stroke('scribbles', [(40, 60), (40, 140)], A)
    f.stroke('scribbles', [(10, 15), (230, 15)], B)
    f.stroke('scribbles', [(10, 185), (230, 185)], B)
    return f


def pinched_little():
    """A neck of a pixel, and a gap of one and a half stroke widths."""
    return pinched(1, 1.5)


def pinched_much():
    """A neck of three quarters of a pixel, and a gap of six stroke widths."""
    return pinched(0.75, 6)


def gap_beside_bay():
    """A box with a gap of one and a half stroke widths; the bay of the page behind the gap is nearly closed."""
    f = Figure()
    f.shape(box(30, 30, 210, 110), 16)
    f.line([(150, 110), (150, 170), (60, 170), (60, 134)], 16)
    f.ink.rectangle([v * SCALE for v in (93, 101, 117, 119)], 255)
    f.stroke('scribbles', [(50, 60), (190, 60)], A)
    f.stroke('scribbles', [(10, 15), (230, 15)], B)
    return f


def hairline_gaps():
    """A part in hairlines with a tab that has three gaps, beside a part with an outline ten times as broad."""
    f = Figure()
    f.shape(box(25, 25, 100, 175), 22)
    f.line([(111, 40), (225, 40), (225, 110), (195, 110), (190, 155), (157, 155), (150, 110), (111, 110)], 2)
    for x, y in (151, 116), (157, 155), (192, 137):
        f.rub_out(x - 2.5, y - 2.5, x + 2.5, y + 2.5)
    f.stroke('scribbles', [(45, 60), (80, 60)], A)
    f.stroke('scribbles', [(125, 75), (210, 75)], B)
    f.stroke('scribbles', [(5, 7), (235, 7)], C)
    return f


def stubs():
    """A broad frame with handles at its corners; of two sides only short stubs are left beside the handles."""
    f = Figure()
    f.line(box(40, 40, 200, 160) + [(40, 40)], 14)
    for x, y in box(40, 40, 200, 160):
        f.ink.rectangle([v * SCALE for v in (x - 15, y - 15, x + 15, y + 15)], 0)
    f.rub_out(63, -17, 177, 97)
    f.rub_out(4, 64, 76, 136)
    f.stroke('scribbles', [(150, 125), (180, 125)], A)
    f.stroke('scribbles', [(5, 193), (235, 193)], B)
    return f


def ring_round_bar():
    """A broad ring with a wide gap, and in it a bar that ends nearer to one end of the ring than the other one is."""
    f = Figure()
    around = [math.radians(i) for i in range(0, 361, 2)]
    f.line([(120 + 72 * math.cos(a), 100 + 72 * math.sin(a)) for a in around], 24)
    f.ink.rectangle([v * SCALE for v in (105, 88, 180, 112)], 0)
    f.rub_out(11, 18, 99, 106)
    f.stroke('scribbles', [(95, 140), (145, 140)], A)
    f.stroke('scribbles', [(10, 190), (230, 190)], B)
    return f


def bay_beside_stub():
    """In broad lines a part whose lower side has a gap between short stubs; below it another part stands aslant."""
    f = Figure()
    f.shape([(78, 134), (60, 160), (50, 188), (165, 188), (150, 150), (125, 120)], 11)
    f.shape([(66, 85), (36, 95), (22, 115), (12, 136), (78, 136)], 11)
    around = [math.radians(i) for i in range(0, 361, 2)]
    f.shape([(115 + 50 * math.cos(a), 99 + 50 * math.sin(a)) for a in around], 11)
    f.rub_out(24, 117, 62, 155)
    f.stroke('scribbles', [(40, 112), (52, 104)], A)
    f.stroke('scribbles', [(5, 195), (235, 195)], B)
    f.stroke('scribbles', [(90, 170), (130, 170)], C)
    f.stroke('scribbles', [(100, 90), (130, 90)], D)
    return f


def bay_below_gap():
    """A lamp on a post above a broad line, with a gap at its lower corner: the page reaches below it, as into a bay."""
    f = Figure()
    f.line([(-10, 135), (250, 135)], 14)
    f.line([(120, 80), (120, 135)], 8)
    around = [math.radians(i) for i in range(180, 361, 6)]
    f.shape([(120 + 50 * math.cos(a), 80 + 38 * math.sin(a)) for a in around], 6)
    f.rub_out(72, 70, 88, 86)
    f.stroke('scribbles', [(100, 62), (140, 62)], A)
    f.stroke('scribbles', [(5, 10), (235, 10)], B)
    f.stroke('scribbles', [(5, 180), (235, 180)], C)
    return f


def rubbed_out_corner():
    """A triangle whose upper corner is rubbed out: both lines still point to it."""
    f = Figure()
    f.shape([(120, 20), (200, 160), (40, 160)], 6)
    f.rub_out(78, -22, 162, 62)
    f.stroke('scribbles', [(90, 140), (150, 140)], A)
    f.stroke('scribbles', [(5, 190), (235, 190)], B)
    return f


def severed():
    """A stroke that runs over a contour and ends behind a later stroke of another colour, in a narrow part."""
    f = Figure()
    f.shape(box(20, 30, 110, 170))
    f.shape([(110, 30), (150, 30), (150, 90), (165, 90), (165, 30), (220, 30),
             (220, 170), (165, 170), (165, 110), (150, 110), (150, 170), (110, 170)])
    f.stroke('scribbles', [(35, 100), (205, 100)], A)
    f.stroke('scribbles', [(130, 50), (130, 150)], B, 11)
    f.stroke('scribbles', [(10, 15), (230, 15)], C)
    return f


def close_up():
    """A figure that fills most of the page, with a nose in front and a tail behind, on a page that is not painted."""
    f = Figure()
    f.shape([(-10, 120), (40, 90), (40, 150), (-10, 150)])
    f.shape([(70, -10), (260, -10), (260, 210), (20, 210), (30, 130)])
    f.shape(box(130, 80, 170, 120))
    f.stroke('scribbles', [(100, 40), (220, 40)], A)
    f.stroke('scribbles', [(140, 100), (160, 100)], B)
    f.stroke('scribbles', [(5, 130), (20, 130)], C)
    f.relations = '#3c8cdc > #dc3c3c > #f0b428'
    return f


def nearly_touches_frame():
    """A ring with a gap in it nearly touches the frame on all sides: the page's corners are as good as apart."""
    f = Figure(200, 200)
    around = [math.radians(i) for i in range(149, 482)]        # the gap is at the lower left
    f.line([(100 + 92 * math.cos(a), 100 + 92 * math.sin(a)) for a in around])
    f.stroke('scribbles', [(70, 70), (130, 120)], A)
    f.stroke('scribbles', [(180, 10), (190, 20)], B)
    return f


def forgotten():
    """Four parts of which only one is painted: one is closed, one open through a gap, and one is a speck."""
    f = Figure()
    f.shape(box(20, 40, 80, 100))
    f.shape(box(100, 40, 140, 80))
    f.shape(box(160, 40, 220, 100))
    f.ink.rectangle([v * SCALE for v in (185, 36, 195, 44)], 255)
    f.shape(box(30, 140, 36, 146))
    f.stroke('scribbles', [(40, 60), (60, 80)], A)
    f.stroke('scribbles', [(10, 15), (230, 15)], B)
    return f


def cut_off():
    """Rooms that the frame cuts off: one is painted, one is closed, one is open through a gap, and one is a speck."""
    f = Figure()
    f.shape([(-10, 150), (50, 150), (50, 210), (-10, 210)])
    f.shape([(-10, 40), (60, 40), (60, 110), (-10, 110)])
    f.shape([(190, -10), (190, 70), (250, 70), (250, -10)])
    f.ink.rectangle([v * SCALE for v in (186, 28, 194, 36)], 255)
    f.shape(box(150, 194, 156, 210))
    f.stroke('scribbles', [(10, 170), (30, 190)], A)
    f.stroke('scribbles', [(90, 20), (90, 180)], B)
    return f


def unpainted_page():
    """The page is not painted, in any of the parts into which a figure divides it, and a room in the figure is not."""
    f = Figure()
    f.shape([(-10, 70), (250, 50), (250, 150), (-10, 130)])
    f.shape(box(150, 80, 190, 120))
    f.stroke('scribbles', [(20, 100), (100, 100)], A)
    return f


def gap_on_unpainted_page():
    """A figure whose outline has a gap many stroke widths wide, with a part in front of it; the page is not painted."""
    f = Figure()
    f.shape(box(30, 40, 200, 170))
    f.shape(box(60, 120, 110, 170))
    f.rub_out(188, 88, 212, 112)
    f.stroke('scribbles', [(60, 70), (160, 70)], A)
    f.stroke('scribbles', [(75, 145), (95, 145)], B)
    return f


def stopped_short(gap, x=120, width=4, outline=4):
    """A box whose left part is painted.  The wall at x stops so many stroke widths short of the upper side."""
    f = Figure()
    f.shape(box(20, 30, 220, 170), outline)
    f.line([(x, 170), (x, 30 + outline / 2 + 4 * gap + width / 2)], width)
    f.stroke('scribbles', [(40, 60), (80, 140)], A)
    f.stroke('scribbles', [(10, 15), (230, 15)], B)
    return f


def stopped_near():
    return stopped_short(1.5)


def stopped_farther():
    return stopped_short(3)


def stopped_far():
    return stopped_short(5.5)


def open_bay():
    """What is behind the wall is as wide as its mouth."""
    return stopped_short(5, 196)


def vein():
    """The wall is a quarter as wide as the outline, as the veins of a leaf may be."""
    return stopped_short(3, 120, 2, 8)


def notch():
    """In place of the wall, the corner of two lines."""
    f = Figure()
    f.shape(box(20, 30, 220, 170))
    f.line([(109, 170), (120, 44), (131, 170)])
    f.stroke('scribbles', [(40, 60), (80, 140)], A)
    f.stroke('scribbles', [(116, 166), (124, 166)], C)
    f.stroke('scribbles', [(10, 15), (230, 15)], B)
    return f


def hairline():
    """A ring half a pixel wide, nowhere darker than half of the ink, inside a box with a thick outline."""
    f = Figure()
    f.shape(box(20, 20, 220, 180), 6)
    around = [2 * math.pi * i / 200 for i in range(201)]
    ring = [(120.3 + 80 * math.cos(a), 100.2 + 60 * math.sin(a)) for a in around]
    f.ink.line([(x * SCALE, y * SCALE) for x, y in ring], 0, SCALE // 2)
    f.stroke('scribbles', [(100, 95), (140, 105)], A)
    f.stroke('scribbles', [(30, 30), (210, 30)], B)
    f.stroke('scribbles', [(8, 10), (8, 190)], C)
    return f


def stroke_on_contour():
    """A stroke inside a sheet ends on the sheet's contour, behind which a nearer sheet begins."""
    f = Figure()
    f.line([(20, 150), (220, 40)], 12)
    f.line([(92, 10), (108, 100)], 12)
    around = [2 * math.pi * i / 80 for i in range(80)]
    f.shape([(120 + 60 * math.cos(a), 142 + 36 * math.sin(a)) for a in around], 10)
    f.stroke('scribbles', [(40, 40), (80, 60)], A)
    f.stroke('scribbles', [(140, 30), (170, 30)], A)
    f.stroke('scribbles', [(200, 150), (220, 100)], B)
    f.stroke('scribbles', [(20, 180), (50, 180)], B)
    f.stroke('scribbles', [(100, 145), (140, 145)], C)
    f.relations = '120,145 > 60,50\n60,50 > 210,125'
    return f


def pencil(grey, noise):
    """A ring of a pixel and a fifth in a hard pencil, on grainy paper, inside a box of black ink."""
    f = Figure()
    f.shape(box(20, 20, 220, 180), 6)
    around = [2 * math.pi * i / 200 for i in range(201)]
    ring = [((120 + 80 * math.cos(a)) * SCALE, (100 + 60 * math.sin(a)) * SCALE) for a in around]
    f.ink.line(ring, grey, round(1.2 * SCALE))
    clean = np.asarray(f.page.resize(f.size, Image.BOX), float)
    grain = np.random.default_rng(grey).normal(0, 255 * noise, clean.shape)
    page = Image.fromarray(np.clip(0.96 * clean + grain, 0, 255).round().astype(np.uint8))
    f.page = page.resize(f.page.size, Image.NEAREST)
    f.stroke('scribbles', [(100, 95), (140, 105)], A)
    f.stroke('scribbles', [(30, 30), (210, 30)], B)
    f.stroke('scribbles', [(8, 10), (8, 190)], C)
    return f


def pencil_on_smooth_paper():
    return pencil(190, 0.005)


def pencil_on_rough_paper():
    return pencil(165, 0.01)


def cover(pen):
    """The cover of a book in a pen of 3 pixels; its lower edge lies on the outline of the pages, in a thick pen."""
    f = Figure()
    f.shape(box(60, 120, 180, 170), pen, 1)
    f.shape(box(60, 50, 180, 120), 3, 2)
    mask = ImageDraw.Draw(f.owner)
    for index, width in (1, 5), (2, 3):        # what is left of the thick outline beside the thin line is the pages'
        mask.line([(60, 120), (180, 120)], index, width)
    f.stroke('scribbles', [(80, 85), (160, 85)], A)
    f.stroke('scribbles', [(80, 145), (160, 145)], B)
    f.stroke('scribbles', [(10, 15), (230, 15)], C)
    f.relations = '#dc3c3c > #3c8cdc > #f0b428'
    return f


def cover_on_thick():
    return cover(8)


def cover_on_thicker():
    return cover(12)


def drop():
    """A sheet drawn in a thick pen that runs out into a solid tip, as a drop or the end of a leaf does."""
    f = Figure()
    x, y, paper, pen, tip = 80, 100, 40, 20, 110
    f.shape([(x + paper * math.cos(t), y + paper * math.sin(t)) for t in np.linspace(0, 2 * math.pi, 60)], pen)
    edge = paper + pen / 2
    tangent = math.acos(edge / tip)
    sides = [(x + edge * math.cos(t), y + edge * math.sin(t)) for t in (tangent, -tangent)]
    solid = [sides[0], (x + tip, y), sides[1], (x + paper, y)]
    f.ink.polygon([(px * SCALE, py * SCALE) for px, py in solid], 0)
    f.stroke('scribbles', [(65, 90), (95, 110)], A)
    f.stroke('scribbles', [(10, 15), (230, 15)], C)
    f.relations = '#dc3c3c > #f0b428'
    return f


def careless_ends():
    """A sheet in a bold outline and a small one on it, whose stroke runs on into that outline."""
    f = Figure()
    f.shape(box(30, 30, 210, 170), 36)
    for y in range(104, 146, 6):
        f.line([(60, y), (180, y)], 1.5)
    f.shape(box(80, 60, 160, 96), 1.5)
    f.stroke('scribbles', [(150, 90), (90, 70), (90, 34)], A)
    f.stroke('scribbles', [(60, 56), (60, 142), (180, 142)], B)
    f.stroke('scribbles', [(5, 5), (235, 5)], C)
    f.relations = '#dc3c3c > #3c8cdc; #3c8cdc > #f0b428'
    return f


def soft_on_white():
    """Strokes of a soft brush of half opacity, flattened on white."""
    f = Figure()
    f.shape(box(20, 30, 220, 170))
    f.line([(120, 30), (120, 170)])
    white = Image.new('RGB', f.size, 'white')
    for points, colour in ([(40, 60), (100, 140)], A), ([(140, 60), (200, 140)], B), ([(15, 14), (225, 14)], C):
        brush = Image.new('L', f.size)
        ImageDraw.Draw(brush).line(points, 128, 12)
        white.paste(colour, mask=brush.filter(ImageFilter.GaussianBlur(3)))
    f.layers['scribbles'] = white
    return f


FIGURES = [two_arrows, thick, contours, two_characters, frame, limbs, cycle, broken, pinched_little, pinched_much,
           gap_beside_bay, hairline_gaps, stubs, ring_round_bar, bay_beside_stub, bay_below_gap, rubbed_out_corner,
           severed, close_up, nearly_touches_frame, forgotten, cut_off, unpainted_page, gap_on_unpainted_page,
           stopped_near, stopped_farther, stopped_far, open_bay, vein, notch, hairline, stroke_on_contour,
           pencil_on_smooth_paper, pencil_on_rough_paper, cover_on_thick, cover_on_thicker, drop, careless_ends,
           soft_on_white]


if __name__ == '__main__':
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for make in FIGURES:
        make().save(os.path.join(sys.argv[1], make.__name__.replace('_', '-')))
