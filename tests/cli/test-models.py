#!/usr/bin/python3
"""Models of celdepth relief: a mesh for each part, on its whole silhouette.

The drawing has a face with an eye before a bar, which is cut off by the frame, so that every outline is known.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import unittest

import numpy as np
from PIL import Image, ImageDraw
from scipy import ndimage

from meshes import is_closed, read_mesh, volume
from pictures import BLUE, GREEN, RED, Test
from views import View, edges_of, loops_of

WIDE, HIGH, FINE = 260, 200, 8
FACE, EYE = (120, 95, 72, 62), (146, 78, 15, 15)  # centre and radii, with the line
BAR = (18, 118, WIDE, 168)
LINE = 4
RELATIONS = '146,78 > 100,80; 100,80 > 230,140; 230,140 > 5,5'
YELLOW = (220, 200, 40)
NAMES = {'ff0000': FACE, '0000ff': EYE, '00a000': BAR}


def whole(size, shape, line=0):
    """A picture of a shape, FINE times as large; without its line."""
    picture = Image.new('1', size)
    x, y, a, b = shape
    box = shape if shape is BAR else (x - a, y - b, x + a, y + b)
    box = [FINE * (v + d * line) for v, d in zip(box, (1, 1, -1 if box[2] < WIDE else 0, -1))]
    draw = ImageDraw.Draw(picture)
    (draw.rectangle if shape is BAR else draw.ellipse)((box[0], box[1], box[2] - 1, box[3] - 1), fill=1)
    return np.array(picture)


def paint():
    """The drawing in grey and in colours, antialiased."""
    size = (FINE * WIDE, FINE * HIGH)
    grey, art = np.full(size[::-1], 255.0), np.full(size[::-1] + (3,), 255.0)
    for shape, colour in ((BAR, GREEN), (FACE, RED), (EYE, BLUE)):
        inked, inside = whole(size, shape), whole(size, shape, LINE)
        grey[inked], art[inked] = 0, 0
        grey[inside], art[inside] = 255, colour
    mean = [v.reshape((HIGH, FINE, WIDE, FINE) + v.shape[2:]).mean((1, 3)) for v in (grey, art)]
    return [Image.fromarray((v + 0.5).astype(np.uint8)) for v in mean]


def scribbles():
    layer = Image.new('RGBA', (WIDE, HIGH))
    draw = ImageDraw.Draw(layer)
    for line, colour in (((80, 90, 110, 60), RED), ((142, 78, 152, 78), BLUE), ((220, 140, 245, 145), GREEN),
                         ((4, 4, 250, 8), YELLOW)):
        draw.line(line, fill=colour + (255,), width=3)
    return layer


def distance_from(shape, x, y):
    """How far places are from the outline of a face or an eye, to first order."""
    u, v = (x - shape[0]) / shape[2], (y - shape[1]) / shape[3]
    r = np.hypot(u, v)
    return abs(r - 1) * r / np.hypot(u / shape[2], v / shape[3])


class Models(Test):
    def setUp(self):
        super().setUp()
        drawing, art = paint()
        drawing.save(self.path('drawing.png'))
        art.save(self.path('art.png'))
        scribbles().save(self.path('scribbles.png'))

    def relief(self, *words, code=0):
        return self.celdepth('relief', 'drawing.png', '--scribbles', 'scribbles.png', '--relations', RELATIONS,
                             '--colours', 'art.png', *words, code=code)

    def model(self, name='a.glb', *words):
        self.relief('--mesh', name, *words)
        places, triangles, other = read_mesh(self.path(name))
        unit = 0.1 / WIDE if name.endswith('.glb') else 100 / WIDE
        return places.astype(float) / unit, triangles, other

    def node(self, other, colour):
        """The number and the triangles of the part in that colour."""
        (number, triangles), = [(k, t) for k, (name, t) in enumerate(other['parts']) if name.startswith(colour + '-')]
        return number, triangles

    # ------------------------------------------------------------------ parts

    def test_one_mesh_for_each_region(self):
        _, _, other = self.model()
        names = [name for name, _ in other['parts']]
        self.assertEqual(sorted(name.split('-')[0] for name in names), sorted([*NAMES, 'dcc828']))
        self.assertEqual(sorted(int(name.split('-')[1]) for name in names), [1, 2, 3, 4])
        self.assertEqual([name.split('-')[0] for name in names][0], 'dcc828')  # from back to front
        _, _, of_obj = self.model('a.obj')
        self.assertEqual([name for name, _ in of_obj['parts']], names)

    def test_levels_and_regions_give_the_same_parts(self):
        self.popup('--relations', RELATIONS, '--labels', 'labels.png', '--levels', 'levels.npy')
        wanted = [name.split('-')[0] for name, _ in self.model()[2]['parts']]
        self.celdepth('relief', 'levels.npy', '--drawing', 'drawing.png', '--regions', 'labels.png', '--mesh', 'l.glb')
        self.assertEqual([name.split('-')[0] for name, _ in read_mesh(self.path('l.glb'))[2]['parts']], wanted)
        self.celdepth('relief', 'levels.npy', '--drawing', 'drawing.png', '--mesh', 'l.glb')
        self.assertEqual([name for name, _ in read_mesh(self.path('l.glb'))[2]['parts']],
                         ['level-1', 'level-2', 'level-3', 'level-4'])

    def test_one_surface_on_request(self):
        _, _, other = self.model('a.glb', '--mesh-kind', 'heightfield')
        self.assertEqual([name for name, _ in other['parts']], ['relief'])

    # ------------------------------------------------------------------ outlines

    def test_outlines_are_those_of_the_shapes(self):
        places, _, other = self.model()
        x, y = WIDE / 2 + places[:, 0], HIGH / 2 - places[:, 1]
        for colour in ('ff0000', '0000ff'):
            with self.subTest(colour):
                edges = edges_of(self.node(other, colour)[1])
                self.assertEqual(loops_of(edges), 1)  # the eye leaves no hole in the face
                far = distance_from(NAMES[colour], x[edges[:, 0]], y[edges[:, 0]])
                self.assertLess(far.mean(), 0.2)
                self.assertLess(far.max(), 1)
                steps = np.hypot(*(v[edges[:, 0]] - v[edges[:, 1]] for v in (x, y)))
                self.assertLess(steps.max(), 1.5)

    def test_ink_on_a_transparent_layer_is_as_good(self):
        with Image.open(self.path('drawing.png')) as drawing:
            ink = np.array(drawing)
        page = np.zeros((HIGH, WIDE, 4), np.uint8)
        page[:, :, 3] = 255 - ink
        Image.fromarray(page).save(self.path('ink.png'))
        self.celdepth('relief', 'ink.png', '--scribbles', 'scribbles.png', '--relations', RELATIONS, '--mesh', 'i.ply')
        self.celdepth('relief', 'drawing.png', '--scribbles', 'scribbles.png', '--relations', RELATIONS,
                      '--mesh', 'd.ply')
        found, wanted = (read_mesh(self.path(name)) for name in ('i.ply', 'd.ply'))
        np.testing.assert_array_equal(found[1], wanted[1])
        np.testing.assert_allclose(found[0], wanted[0], atol=1e-3)
        differing = abs(found[2]['colours'].astype(int) - wanted[2]['colours']).max(1) > 3
        self.assertLess(differing.mean(), 0.08)  # hidden lines

    def test_a_part_ends_at_the_frame(self):
        places, _, other = self.model()
        bar = places[np.unique(self.node(other, '00a000')[1])]
        self.assertAlmostEqual(bar[:, 0].max(), WIDE / 2, places=3)
        self.assertAlmostEqual(bar[:, 0].min(), BAR[0] - WIDE / 2, delta=1)

    # ------------------------------------------------------------------ depth

    def view(self, model, degrees, parts=None):
        places, _, other = model
        return View(places, parts or other['parts'], other['art'], degrees, 2 * WIDE, 2 * HIGH, 0.5)

    def test_the_front_is_the_drawing(self):
        model = self.model()
        other = model[2]
        view = self.view(model, 0)
        for k, (name, _) in enumerate(other['parts']):
            if name.split('-')[0] in NAMES:
                nearer = {'00a000': ('ff0000',), 'ff0000': ('0000ff',)}.get(name.split('-')[0], ())
                wanted = whole((FINE * WIDE, FINE * HIGH), NAMES[name.split('-')[0]])
                for other_name in nearer:
                    wanted &= ~whole((FINE * WIDE, FINE * HIGH), NAMES[other_name])
                wanted = wanted[FINE // 4::FINE // 2, FINE // 4::FINE // 2]
                self.assertLess(((view.part == k) != wanted).sum(), 0.03 * wanted.sum() + 60, name)
        seen = view.colours(other['texture'][:, :, :3].astype(float))
        with Image.open(self.path('art.png')) as art:
            wanted = np.array(art.resize((2 * WIDE, 2 * HIGH), Image.Resampling.BILINEAR)).astype(float)
        self.assertLess(abs(seen - wanted)[4:-4, 4:-4].mean(), 3)

    def test_the_eye_sits_on_the_face(self):
        places, _, other = model = self.model()
        face = self.view(model, 0, [other['parts'][self.node(other, 'ff0000')[0]]])
        eye = places[edges_of(self.node(other, '0000ff')[1])[:, 0]]
        column, row = (np.floor(v).astype(int) for v in (WIDE + 2 * eye[:, 0], HIGH - 2 * eye[:, 1]))
        before = eye[:, 2] - 0.5 * face.nearest[row, column]
        self.assertGreater(before.min(), -0.5)
        self.assertLess(before.max(), 6)

    def test_no_hole_from_either_side(self):
        model = self.model()
        other = model[2]
        for degrees in (-35, 35):
            for name, triangles in other['parts']:
                with self.subTest(degrees=degrees, part=name):
                    seen = self.view(model, degrees, [(name, triangles)]).part >= 0
                    self.assertGreater(seen.sum(), 500)
                    self.assertEqual((ndimage.binary_fill_holes(seen) & ~seen).sum(), 0)
            seen = self.view(model, degrees).part
            page = self.node(other, 'dcc828')[0]
            behind = ndimage.binary_fill_holes(seen != page) & (seen == page)
            self.assertEqual(behind.sum(), 0)

    def test_bulge_and_depth(self):
        def rise(*words):
            places, _, other = self.model('a.glb', *words)
            triangles = self.node(other, 'ff0000')[1]
            rim = places[edges_of(triangles)[:, 0]]
            free = rim[HIGH / 2 - rim[:, 1] < BAR[1] - 20]  # not on the bar
            return places[np.unique(triangles), 2].max() - np.median(free[:, 2])
        a, b = FACE[2] - LINE, FACE[3] - LINE
        top = np.sqrt(2 * a * a * b * b / (a * a + b * b))
        self.assertAlmostEqual(rise('--relief-bulge', '1') / top, 1, delta=0.1)
        self.assertAlmostEqual(rise() / top, 0.6, delta=0.06)
        self.assertLess(rise('--relief-bulge', '0'), 3)

    # ------------------------------------------------------------------ solids

    def test_stl_is_closed(self):
        for words in ([], ['--relief-bulge', '0'], ['--relief-bulge', '4', '--mesh-plate', '0.1'], ['--mesh-error', '20']):
            with self.subTest(words):
                places, triangles, other = self.model('a.stl', *words)
                self.assertTrue(is_closed(triangles))
                self.assertGreater(volume(places, triangles), 0)
                self.assertEqual(np.isnan(other['facets']).sum(), 0)
        places, _, other = self.model('a.glb', '--mesh-kind', 'solid')
        bottom = places[:, 2].min()
        for name, triangles in other['parts']:
            self.assertTrue(is_closed(triangles), name)
            self.assertGreater(volume(places, triangles), 0, name)
            self.assertLess(places[np.unique(triangles), 2].min(), bottom + 2.01 * WIDE / 100)  # it stands in the plate

    def test_formats_hold_the_same_mesh(self):
        wanted, triangles, _ = self.model('a.ply')
        for name in ('a.glb', 'a.obj'):
            with self.subTest(name):
                places, found, other = self.model(name)
                np.testing.assert_allclose(places, wanted, rtol=1e-5, atol=1e-3)
                np.testing.assert_array_equal(found, triangles)
                np.testing.assert_allclose(np.linalg.norm(other['normals'], axis=1), 1, atol=1e-5)
        places, found, _ = self.model('a.stl', '--mesh-kind', 'surface')
        self.assertEqual(len(found), len(triangles))

    def test_too_many_vertices(self):
        fine = len(self.model('a.ply', '--mesh-error', '0.05')[0])
        most = int(0.7 * fine)
        said = self.relief('--mesh', 'a.ply', '--mesh-error', '0.05', '--most-vertices', str(most))
        self.assertIn('--most-vertices', said)
        self.assertLessEqual(len(read_mesh(self.path('a.ply'))[0]), most)
        self.assertIn('outlines alone', self.relief('--mesh', 'b.ply', '--most-vertices', '1000', code=1))

    def test_no_room_in_the_texture(self):
        long = np.full((40, 20000), 255, np.uint8)
        long[[10, 30], 5:19990] = long[10:30, 5] = long[10:30, 19989] = 0
        Image.fromarray(long).save(self.path('long.png'))
        strokes = np.zeros((40, 20000, 4), np.uint8)
        strokes[20:23, 50:60] = (255, 0, 0, 255)
        Image.fromarray(strokes).save(self.path('strokes.png'))
        self.fails('relief', 'long.png', '--scribbles', 'strokes.png', '--mesh', 'm.glb', naming='Make the drawing smaller.')

    def test_failures(self):
        self.assertIn('--drawing', self.relief('--drawing', 'drawing.png', '--mesh', 'a.glb', code=2))
        self.assertIn('levels', self.relief('--regions', 'art.png', '--mesh', 'a.glb', code=2))


if __name__ == '__main__':
    unittest.main()
