#!/usr/bin/python3
"""Moving GIFs: flat colours stay exactly, smooth ones are dithered, and all frames share one palette.

Pillow reads them back.  WRITE_FRAMES is the program that writes them.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import subprocess
import tempfile
import unittest

import numpy as np
from PIL import Image
from scipy import ndimage


def write(frames, per_second=20):
    """Frames as a GIF, read back: its frames, its loop and its delays in milliseconds."""
    frames = np.asarray(frames, np.uint8)
    n, height, width = frames.shape[:3]
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, 'page.gif')
        subprocess.run([os.environ['WRITE_FRAMES'], name, str(width), str(height), str(n), str(per_second)],
                       input=frames.tobytes(), check=True)
        with Image.open(name) as gif:
            read, delays = [], []
            for i in range(gif.n_frames):
                gif.seek(i)
                delays.append(gif.info['duration'])
                read.append(np.array(gif.convert('RGB')))
            return np.array(read), gif.info['loop'], delays


def codes(picture):
    return np.asarray(picture, int) @ [1 << 16, 1 << 8, 1]


def discs(rng, flat, width=200, height=150):
    """Antialiased discs of flat colours on white, from which hundreds of mixed colours arise."""
    page = np.full((height, width, 3), 255.0)
    y, x = np.mgrid[:height, :width]
    for colour in flat:
        radius = rng.uniform(6, 25)
        inside = np.clip(radius - np.hypot(x - rng.uniform(0, width), y - rng.uniform(0, height)) + 0.5, 0, 1)
        page += inside[..., None] * (colour - page)
    return np.rint(page)


class Gif(unittest.TestCase):
    def test_few_colours_are_exact(self):
        rng = np.random.default_rng(1)
        for n in (1, 3, 256):
            with self.subTest(n):
                palette = rng.permutation(1 << 24)[:n]
                palette = np.stack([palette >> 16, palette >> 8 & 255, palette & 255], -1)
                frames = palette[rng.integers(0, n, (3, 40, 50))]
                read, loop, delays = write(frames)
                np.testing.assert_array_equal(read, frames)
                self.assertEqual((loop, delays), (0, [50] * 3))

    def test_delays(self):
        frames = np.random.default_rng(2).integers(0, 2, (4, 5, 7, 1)).repeat(3, -1) * 255
        for per_second, delay in ((50, 20), (12, 80), (10, 100), (1, 1000)):
            self.assertEqual(write(frames, per_second)[2], [delay] * 4)

    def test_flat_art_is_not_dithered(self):
        """A colour that fills a thousandth of one frame stays where it was and appears nowhere else."""
        for seed in range(3):
            with self.subTest(seed):
                rng = np.random.default_rng(seed)
                flat = rng.integers(0, 256, (40, 3))
                frames = np.array([discs(rng, flat) for _ in range(5)])
                read = write(frames)[0]
                self.assertLessEqual(len(np.unique(codes(read))), 256)
                self.assertGreater(len(np.unique(codes(frames))), 1000)
                for one, other in zip(codes(frames), codes(read)):
                    for colour, pixels in zip(*np.unique(one, return_counts=True)):
                        if pixels >= 0.001 * one.size:
                            self.assertTrue((other[one == colour] == colour).all(), hex(colour))
                self.assertLess(np.abs(frames - read).max(), 64)
                self.assertLess(np.abs(frames - read).mean(), 0.7)

    def test_smooth_colours_have_no_bands(self):
        """The mean over a few pixels is that of the art."""
        y, x = np.mgrid[:120, :160] / 160
        frames = np.array([np.rint(255 * np.stack([(x + t) / 1.4, (y + x) / 1.8, 0.3 + 0.5 * y], -1))
                           for t in (0, 0.1, 0.2)])
        read = write(frames)[0].astype(float)
        blurred = [ndimage.gaussian_filter(a.astype(float), (0, 3, 3, 0)) for a in (frames, read)]
        inner = np.abs(blurred[0] - blurred[1])[:, 10:-10, 10:-10]
        self.assertLess(inner.mean(), 1)
        self.assertLess(np.percentile(inner, 99), 4)
        self.assertLess(np.abs(frames - read).mean(), 6)

    def test_more_flat_colours_than_entries(self):
        """The largest stay, and the others are near."""
        rng = np.random.default_rng(5)
        blocks = rng.integers(0, 256, (400, 3))
        page = blocks.reshape(20, 20, 3).repeat(8, 0).repeat(8, 1)
        page[:60] = (255, 250, 240)
        page[-40:] = (12, 13, 14)
        read = write([page, page])[0]
        for colour in ((255, 250, 240), (12, 13, 14)):
            self.assertTrue((read[0][(page == colour).all(-1)] == colour).all())
        self.assertLess(np.abs(read[0].astype(int) - page).mean(), 8)

    def test_others_may_read_it_as_any_file(self):
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, 'page.gif')
            subprocess.run([os.environ['WRITE_FRAMES'], name, '4', '4', '2', '20'], input=bytes(2 * 4 * 4 * 3),
                           umask=0o022, check=True)
            self.assertEqual(os.stat(name).st_mode & 0o777, 0o644)


if __name__ == '__main__':
    unittest.main()
