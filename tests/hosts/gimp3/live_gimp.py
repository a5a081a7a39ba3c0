"""GIMP 3 with the example frog on a screen of its own, its menu, the window of Live, and strokes with the mouse.

$CELDEPTH_EXAMPLES: where the drawings are; $CELDEPTH_OUT gets the folder live.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import shutil
import subprocess
import time

import numpy as np
from PIL import Image, ImageGrab

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLE = os.path.join(os.environ['CELDEPTH_EXAMPLES'], 'frog')
OUT = os.path.join(os.environ['CELDEPTH_OUT'], 'live')
SCREEN = (3400, 1300)
MAIN = (1350, 1150)         # the size of GIMP's window, which lies in the upper left corner
ENTRIES = {'Live group': 2, 'Live...': 3} # places in the menu Cartoon Depth, which is the third from the right
PATIENCE = 60               # seconds


def wait_for(fact, seconds=PATIENCE, pause=0.05):
    """What `fact` returns, as soon as that is true, or in the end."""
    end = time.monotonic() + seconds
    while True:
        found = fact()
        if found or time.monotonic() > end:
            return found
        time.sleep(pause)


def xdotool(*words):
    return subprocess.run(['xdotool', *map(str, words)], capture_output=True, text=True, check=False).stdout.split()


def processes():
    """The words of /proc/PID/stat of all processes."""
    for name in filter(str.isdigit, os.listdir('/proc')):
        try:
            with open(f'/proc/{name}/stat', encoding='utf-8') as stat:
                yield stat.read().split()
        except OSError:
            pass


def seconds_of(name):
    """The processor time of the processes of this name."""
    ticks = sum(int(words[13]) + int(words[14]) for words in processes() if words[1] == f'({name})')
    return ticks / os.sysconf('SC_CLK_TCK')


class Gimp:
    """Opens GIMP; `with` closes it."""

    def __init__(self):
        shutil.rmtree(OUT, ignore_errors=True)
        os.makedirs(OUT)
        self.display, self.started = None, []

    def __enter__(self):
        read, write = os.pipe()
        self.start('Xvfb', '-noreset', '-displayfd', write, '-screen', '0', '%dx%dx24' % SCREEN, pass_fds=[write])
        self.display = ':' + os.read(read, 20).decode().strip()
        os.environ['DISPLAY'] = self.display
        self.start('openbox')
        self.gimp = self.start('gimp-3.0', '--new-instance', '--no-splash', '--batch-interpreter', 'python-fu-eval', '-b',
                               f"exec(open('{HERE}/live-host.py').read())")
        self.main = self.window('frog.xcf', 4 * PATIENCE) # a user's first GIMP looks at all of its plug-ins
        self.tell('pass')
        time.sleep(2)
        for welcome in xdotool('search', '--onlyvisible', '--name', '^Welcome'):
            xdotool('windowclose', welcome)
        xdotool('windowmove', self.main, 0, 0, 'windowsize', self.main, *MAIN)
        time.sleep(1)
        return self

    def __exit__(self, *error):
        self.stop_host()
        for process in reversed(self.started):
            process.kill()
            process.wait()

    def start(self, *words, **options):
        with open(os.path.join(OUT, words[0] + '.log'), 'w') as log:
            process = subprocess.Popen([str(word) for word in words], stdout=log, stderr=log, **options)
        self.started.append(process)
        return process

    # -------------------------------------------------------------- the host

    def stop_host(self):
        """Ends what tell() talks to."""
        open(os.path.join(OUT, 'stop'), 'w').close()

    def window(self, name, patience=PATIENCE):
        """Waits for a window of this name."""
        found = wait_for(lambda: xdotool('search', '--onlyvisible', '--name', name), patience, pause=0.5)
        if not found:
            raise RuntimeError(f'there is no window "{name}"')
        return found[-1]

    def tell(self, code, patience=PATIENCE):
        """Runs code in GIMP's Python; returns what it gave to answer()."""
        for name in ('answer.txt', 'error.txt'):
            if os.path.exists(os.path.join(OUT, name)):
                os.remove(os.path.join(OUT, name))
        with open(os.path.join(OUT, 'do.new'), 'w', encoding='utf-8') as file:
            file.write(code)
        os.rename(os.path.join(OUT, 'do.new'), os.path.join(OUT, 'do.py'))
        if not wait_for(lambda: not os.path.exists(os.path.join(OUT, 'do.py')), patience, pause=0.02):
            raise RuntimeError('GIMP does not answer')
        if os.path.exists(os.path.join(OUT, 'error.txt')):
            raise RuntimeError(open(os.path.join(OUT, 'error.txt'), encoding='utf-8').read())
        path = os.path.join(OUT, 'answer.txt')
        return open(path, encoding='utf-8').read() if os.path.exists(path) else ''

    # -------------------------------------------------------------- the window

    def choose_entry(self, name):
        """Chooses an entry of the menu Cartoon Depth."""
        xdotool('windowactivate', '--sync', self.main, 'mousemove', MAIN[0] - 50, MAIN[1] - 10, 'key', 'F10')
        time.sleep(1)
        xdotool('key', 'Left', 'Left', 'Left')
        time.sleep(1)
        xdotool('key', *['Down'] * ENTRIES[name], 'Return')

    def open_live(self, x, y, width, height):
        self.choose_entry('Live...')
        self.live = self.window('^Live')
        self.move_live(x, y, width, height)
        return self.live

    def close_live(self):
        xdotool('windowactivate', '--sync', self.live, 'key', 'alt+F4')
        if not wait_for(lambda: not self.runs()):
            raise RuntimeError('Live does not close')
        xdotool('windowactivate', '--sync', self.main)

    def move_live(self, x, y, width, height):
        xdotool('windowmove', self.live, x, y, 'windowsize', self.live, width, height)
        time.sleep(1)
        words = dict(word.split('=') for word in xdotool('getwindowgeometry', '--shell', self.live))
        x, y = int(words['X']), int(words['Y'])
        self.box = (x, y, x + int(words['WIDTH']), y + int(words['HEIGHT']))

    def grab(self, box=None):
        return np.asarray(ImageGrab.grab(bbox=box or self.box, xdisplay=self.display).convert('RGB')).astype(int)

    def has_colour(self, colour, n=20):
        """Whether this colour is seen in the window, and not only in a message."""
        return (np.abs(self.grab() - colour).sum(2) == 0).sum() >= n

    def runs(self):
        """Whether the plug-in does; what has ended may wait for its parent."""
        return any(words[1] == '(celdepth)' and words[2] != 'Z' for words in processes())

    # -------------------------------------------------------------- painting

    def prepare_to_paint(self, colour):
        """Takes the paintbrush, hard and thin, and finds the image on the canvas: its white paper."""
        self.tell("Gimp.context_set_brush(Gimp.Brush.get_by_name('2. Hardness 100'))\nGimp.context_set_brush_size(9)")
        self.colour(colour)
        xdotool('windowactivate', '--sync', self.main, 'mousemove', MAIN[0] // 2, MAIN[1] - 60, 'key', 'p')
        time.sleep(1)
        white = (self.grab((250, 250, 1100, MAIN[1] - 50)) == 255).all(2)
        rows, columns = white.mean(1) > 0.5, white.mean(0) > 0.5
        self.canvas = (250 + int(columns.argmax()), 250 + int(rows.argmax()),
                       250 + len(columns) - int(columns[::-1].argmax()), 250 + len(rows) - int(rows[::-1].argmax()))

    def colour(self, colour):
        self.tell(f"Gimp.context_set_foreground(Gegl.Color.new('{colour}'))")

    def place(self, x, y):
        """A place of the image, as a fraction of its size, on the screen."""
        x0, y0, x1, y1 = self.canvas
        return round(x0 + x * (x1 - x0)), round(y0 + y * (y1 - y0))

    def stroke(self, start, end, steps=12, press=True, release=True):
        """Paints from one place of the screen to another, as the words for xdotool; press and release the button."""
        words = ['mousemove', *start, *(['mousedown', 1] if press else [])]
        for i in range(1, steps + 1):
            words += ['mousemove', *(round(a + (b - a) * i / steps) for a, b in zip(start, end)), 'sleep', 0.012]
        return words + (['mouseup', 1] if release else [])

    def paint(self, start, end, **how):
        xdotool(*self.stroke(start, end, **how))

    def undo(self):
        xdotool('windowactivate', '--sync', self.main, 'key', 'ctrl+z')


def picture(name):
    return np.array(Image.open(os.path.join(OUT, name)).convert('RGB')).astype(int)
