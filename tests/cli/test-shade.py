#!/usr/bin/python3
"""celdepth shade: light on art and as layers, hints, and maps for game engines, of one sprite and of sheets.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import unittest

import numpy as np
from PIL import Image, ImageDraw

from pictures import Test, png_chunks

SIDE = 64
SPRITE = ('levels.npy', '--drawing', 'sprite.png')


def sprite(x, y, radius):
    """A ball with an outline on a transparent cell, and its levels."""
    cell = Image.new('RGBA', (4 * SIDE, 4 * SIDE))
    ImageDraw.Draw(cell).ellipse([4 * (x - radius), 4 * (y - radius), 4 * (x + radius), 4 * (y + radius)],
                                 fill=(255, 200, 100, 255), outline=(0, 0, 0, 255), width=12)
    cell = cell.resize((SIDE, SIDE), Image.BOX)
    return cell, (np.asarray(cell)[:, :, 3] > 127).astype(np.float32)


class Shade(Test):
    def setUp(self):
        super().setUp()
        self.sprite, self.levels = sprite(30, 34, 22)
        self.sprite.save(self.path('sprite.png'))
        np.save(self.path('levels.npy'), self.levels)

    def shade(self, *words, code=0):
        return self.celdepth('shade', *SPRITE, *words, code=code)

    def load(self, name):
        return np.load(self.path(name))

    def test_layers_are_the_shaded_art(self):
        """Art times tone, less so where light is bright, below the rim layer is the shaded art; the shading is the
        light itself."""
        Image.new('RGB', (SIDE, SIDE), (180, 90, 40)).save(self.path('art.png'))
        words = ('--specular', '0.5', '--rim-light', '0.5', '--light', 'point', '--light-height', '0.4',
                 '--shadow-size', '0.05')
        self.shade('--colours', 'art.png', '--shaded', 'a.npy', '--tone', 't.npy', '--rim', 'r.npy', '--shading', 's.npy',
                   '--occlusion', 'o.npy', *words)
        art, tone, rim, shading = (self.load(name) for name in ('a.npy', 't.npy', 'r.npy', 's.npy'))
        linear = ((np.array([180, 90, 40]) / 255 + 0.055) / 1.055) ** 2.4
        alpha = rim[:, :, 3:]
        bright = np.maximum(tone[:, :, :3] - 1, 0)
        toned = linear * (np.minimum(tone[:, :, :3], 1) + bright * (1 - linear))
        np.testing.assert_allclose(art[:, :, :3], (1 - alpha) * toned + alpha * rim[:, :, :3], atol=1e-5)
        np.testing.assert_allclose(art[0, 0, :3], linear, rtol=1e-6)   # the background
        self.assertGreater(tone.max(), 1.05)
        inside = self.levels > 0
        alone = (shading - alpha[:, :, 0]) / (1 - alpha[:, :, 0])
        self.assertGreater(np.corrcoef(alone[28:40, 24:36].ravel(), tone[28:40, 24:36, 0].ravel())[0, 1], 0.9)
        self.assertGreater(shading[inside].max() - shading[inside].min(), 0.5)
        self.assertGreater(alpha.max(), 0.4)
        occlusion = self.load('o.npy')
        self.assertLess(occlusion[34, 54], 0.9)
        self.assertGreater(occlusion[34, 30], 0.99)

    def test_toon_has_steps(self):
        self.shade('--shading', 's.npy', '--light-model', 'toon', '--toon-steps', '4', '--ambient', '0')
        bands = 3 * self.load('s.npy')[self.levels > 0] / np.sqrt(0.5)   # of what faces the viewer: 3
        steps = (np.abs(bands - np.round(bands)) < 1e-4) | (np.abs(bands - 3 * np.sqrt(2)) < 1e-4)
        self.assertGreater(steps.mean(), 0.85)
        self.assertEqual(set(np.round(bands)), {0, 1, 2, 3, 4})

    def test_odd_matcaps(self):
        """What is no lit ball on a square is warned of, once."""
        ball = np.zeros((32, 32, 3), np.uint8) + np.arange(0, 256, 8, np.uint8)[:, None, None]
        Image.fromarray(ball).save(self.path('ball.png'))
        Image.fromarray(ball[:, :20]).save(self.path('narrow.png'))
        Image.new('RGB', (32, 20), 'white').save(self.path('white.png'))
        Image.new('RGBA', (32, 32)).save(self.path('clear.png'))
        for name, says in (('ball.png', ''), ('narrow.png', '"narrow.png" has 20 x 32 pixels, but a matcap is'),
                           ('white.png', '"white.png" is blank, or of one colour'),
                           ('clear.png', '"clear.png" is blank')):
            said = self.shade('--shading', 's.png', '--matcap', name)
            self.assertIn(says, said)
            self.assertEqual(said.count('\n'), bool(says))
            self.assertEqual(self.shade('--shading', 's.png', '--matcap', name, '--quiet'), '')

    def test_matcap(self):
        """Grey art shaded with a matcap looks like the matcap, whose middle is as grey; the background does not."""
        u = (np.arange(256) + 0.5) / 256
        ball = np.stack(np.broadcast_arrays(u[None, :], 1 - u[:, None], 0.5), -1)
        ball[np.hypot(u[None, :] - 0.5, u[:, None] - 0.5) > 0.5] = (1, 0, 1)
        Image.fromarray(np.round(255 * ball).astype(np.uint8)).save(self.path('ball.png'))
        Image.new('RGB', (SIDE, SIDE), (128, 128, 128)).save(self.path('grey.png'))
        self.shade('--colours', 'grey.png', '--shaded', 's.npy', '--normals', 'n.npy', '--matcap', 'ball.png')
        place = 0.5 + 0.5 * self.load('n.npy')[:, :, :2]
        wanted = np.where(place <= 0.04045, place / 12.92, ((place + 0.055) / 1.055) ** 2.4)
        lit, (y, x) = self.load('s.npy'), np.mgrid[0:SIDE, 0:SIDE]
        inside = np.hypot(x - 30, y - 34) < 17
        dark = inside[:, :, None] & (place < 0.5) & (place > 0.02)
        np.testing.assert_allclose(lit[:, :, :2][dark], wanted[dark], atol=0.01)
        np.testing.assert_allclose(lit[inside][:, 2], lit[0, 0, 2], atol=2e-3)   # no magenta
        bright = inside[:, :, None] & (place > 0.6)
        self.assertTrue((lit[:, :, :2][bright] > lit[0, 0, 0] + 0.03).all())
        self.assertEqual(np.ptp(lit[self.levels == 0], axis=0).max(), 0)
        self.shade('--shading', 's.png', '--light-model', 'matcap', code=2)

    def test_light_on_the_background(self):
        """The background bends at a hint; light on it is an option."""
        Image.new('RGBA', (SIDE, SIDE), (128, 128, 128, 255)).save(self.path('hints.png'))
        Image.new('RGB', (SIDE, SIDE), (128, 128, 128)).save(self.path('grey.png'))
        outside = self.levels == 0
        for switch, varies in (('no', False), ('yes', True)):
            self.shade('--colours', 'grey.png', '--shaded', 's.npy', '--hints', 'hints.png', '--light-background', switch)
            self.assertEqual(np.ptp(self.load('s.npy')[outside], axis=0)[0] > 0.05, varies)

    def test_hints(self):
        """Black inside the outline at the right: there the ball does not bend; white outside: the paper does."""
        hints = Image.new('RGBA', (SIDE, SIDE))
        draw = ImageDraw.Draw(hints)
        draw.rectangle([30, 0, 63, 63], fill=(255, 255, 255, 255))
        draw.ellipse([8, 12, 52, 56], fill=(0, 0, 0, 255))
        hints.save(self.path('hints.png'))
        self.shade('--normals', 'n.npy', '--hints', 'hints.png')
        normals = self.load('n.npy')
        self.assertGreater(normals[34, 50, 2], 0.9)
        self.assertLess(normals[34, 54, 0], -0.7)

    def maps(self, *words):
        self.shade('--maps', 'hero.png', *words)
        return [self.picture(f'hero_{letter}.png').astype(float) for letter in 'nos']

    def test_maps(self):
        normal, occlusion, specular = self.maps('--padding', '5')
        self.assertFalse(os.path.exists(self.path('hero.png')))
        alpha = np.asarray(self.sprite)[:, :, 3]
        solid = alpha > 127
        for letter, stored in zip('nos', (normal, occlusion, specular)):
            with self.subTest(letter):
                self.assertEqual(stored.shape, (SIDE, SIDE, 4))
                np.testing.assert_array_equal(stored[:, :, 3], alpha)
                names, header = png_chunks(self.path(f'hero_{letter}.png'))
                self.assertEqual(header[2:4], (8, 6))
                self.assertNotIn('sRGB', names)
                y, x = np.mgrid[0:SIDE, 0:SIDE]
                inside = np.argwhere(solid)
                for py, px in np.argwhere(~solid)[::17]:
                    away = np.hypot(inside[:, 0] - py, inside[:, 1] - px)
                    if away.min() <= 5:
                        near = inside[np.abs(away - away.min()) < 1e-9]
                        self.assertTrue(any((stored[py, px, :3] == stored[v, u, :3]).all() for v, u in near))
        self.assertEqual(tuple(normal[0, 0]), (128, 128, 255, 0))
        length = np.linalg.norm(normal[solid][:, :3] / 127.5 - 1, axis=1)
        np.testing.assert_allclose(length, 1, atol=0.02)
        self.assertGreater(normal[14, 30, 1], 230)        # at the top green points up
        self.assertGreater(specular[34, 30, 0], 150)
        self.assertEqual(specular[0, 0, 0], 0)
        self.assertEqual(occlusion[34, 30, 0], 255)
        flipped = self.maps('--padding', '5', '--directx')[0]
        np.testing.assert_allclose(flipped[solid][:, 1], 255 - normal[solid][:, 1], atol=1)
        np.testing.assert_array_equal(flipped[solid][:, 0], normal[solid][:, 0])

    def test_cells_of_a_sheet_equal_single_sprites(self):
        """Balls that touch the edges of their cells: the maps of the sheet are those of its sprites."""
        sheet, levels, alone = Image.new('RGBA', (2 * SIDE, 2 * SIDE)), np.zeros((2 * SIDE, 2 * SIDE), np.float32), []
        for k, (x, y, radius) in enumerate(((42, 30, 22), (20, 30, 20), (30, 44, 20), (34, 20, 26))):
            cell, level = sprite(x, y, radius)
            left, top = k % 2 * SIDE, k // 2 * SIDE
            sheet.paste(cell, (left, top))
            levels[top:top + SIDE, left:left + SIDE] = level
            cell.save(self.path('sprite.png'))
            np.save(self.path('levels.npy'), level)
            self.shade('--maps', 'one.png', '--normals', 'one.npy', '--padding', '64')
            alone.append([left, top, self.load('one.npy'), *(self.picture(f'one_{c}.png') for c in 'nos')])
        sheet.save(self.path('sprite.png'))
        np.save(self.path('levels.npy'), levels)
        for grid in (('--grid', '2x2'), ()):
            self.shade('--maps', 'all.png', '--normals', 'all.npy', '--padding', '64', *grid)
            whole = [self.load('all.npy'), *(self.picture(f'all_{c}.png') for c in 'nos')]
            same = [np.array_equal(picture[top:top + SIDE, left:left + SIDE], part)
                    for left, top, *parts in alone for picture, part in zip(whole, parts)]
            self.assertEqual(all(same), bool(grid))

    def test_errors(self):
        self.fails('shade', *SPRITE, '--normals', 'n.npy', '--grid', '3x1', naming='3 x 1 equal cells')
        np.save(self.path('small.npy'), np.zeros((4, 4), np.float32))
        self.fails('shade', *SPRITE, '--normals', 'n.npy', '--smooth-depth', 'small.npy', naming='small.npy')
        for words, naming in ((('--grid', '3'), '--grid'), (('--grid', '0x2'), '--grid'),
                              (('--grid', '2x2x'), '--grid'),
                              (('--padding', '65'), '--padding'), (('--padding', 'x'), '--padding'),
                              (('--maps', 'hero.exr'), '--maps'), (('--toon-steps', '6'), '--toon-steps'),
                              (('--toon-steps', '3.5'), '--toon-steps'), (('--light', 'encoded'), '--light'),
                              (('--creases', '2'), '--creases')):
            with self.subTest(words):
                self.assertIn(naming, self.shade('--normals', 'n.npy', *words, code=2))
        os.rename(self.path('sprite.png'), self.path('hero_n.png'))
        self.assertIn('name the same file', self.celdepth('shade', 'levels.npy', '--drawing', 'hero_n.png', '--maps',
                                                          'hero.png', code=2))


if __name__ == '__main__':
    unittest.main()
