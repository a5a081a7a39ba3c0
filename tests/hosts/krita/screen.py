"""Uses the panel of Krita's plug-in in a window, as an artist does, and keeps a picture of it.  A plug-in itself.

$CELDEPTH_OUT: has plugin-start.kra, layers of an example; gets plugin-screen.txt, a line for each check, and
dialog-krita.png.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import traceback
from typing import Callable, Iterator

from krita import Extension, Krita
from PyQt5.QtCore import QTimer, Qt
from PyQt5.QtTest import QTest
from PyQt5.QtWidgets import QApplication, QDockWidget

from celdepth.layers import listed

OUT = os.environ['CELDEPTH_OUT']
POLL, MOST = 200, 300  # milliseconds, polls
krita = Krita.instance()


class Checks(Extension):
    """Steps that wait for each other; Krita goes on in between."""

    def setup(self) -> None:
        self.log = open(os.path.join(OUT, 'plugin-screen.txt'), 'w', encoding='utf-8')
        self.steps = self.all_steps()
        self.wait: Callable[[], object] = lambda: krita.activeWindow()
        self.left = MOST
        QTimer.singleShot(POLL, self.step)

    def createActions(self, window) -> None:  # pylint: disable=invalid-name
        pass

    def check(self, fact, text) -> None:
        print('ok  ' if fact else 'FAIL', text, file=self.log, flush=True)

    def step(self) -> None:
        """Goes on as soon as what is waited for is there."""
        self.left -= 1
        try:
            if self.wait() or not self.left:
                self.check(self.left, 'it came in time')
                self.wait, self.left = next(self.steps), MOST
        except StopIteration:
            self.check(True, 'all checks were run')
            self.log.close()
            os._exit(0)  # unsaved documents would be asked about
        except Exception:  # pylint: disable=broad-except
            self.check(False, traceback.format_exc())
            self.log.close()
            os._exit(1)
        QTimer.singleShot(POLL, self.step)

    def all_steps(self) -> Iterator[Callable[[], object]]:
        window = krita.activeWindow()
        document = krita.openDocument(os.path.join(OUT, 'plugin-start.kra'))
        window.addView(document)
        docker = window.qwindow().findChild(QDockWidget, 'celdepth')
        window.qwindow().setGeometry(0, 0, 1400, 980)
        shown = [window.qwindow().findChild(QDockWidget, 'KisLayerBox'), docker]
        for other in krita.dockers():
            other.setVisible(other in shown)
        window.qwindow().resizeDocks(shown, [250, 650], Qt.Vertical)
        yield lambda: krita.activeDocument() and docker.button.isEnabled()
        names = ('celdepth_update', 'celdepth_set_up_layers')
        entries = [krita.action(name).text().replace('&', '') for name in names]
        self.check(entries == ['Cartoon Depth: update', 'Cartoon Depth: set up layers'], f'entries: {entries}')
        self.check(all(not krita.action(name).icon().pixmap(32).isNull() for name in names), 'which have an icon')
        krita.action('celdepth_update').trigger()
        self.check(docker.isVisible() and docker.run, 'the entry shows the panel and begins a run')
        yield lambda: not docker.run
        self.check(not docker.messages.toPlainText(), f'no message {docker.messages.toPlainText()}')
        group = document.nodeByName('Cartoon Depth')
        self.check([n.name() for n in group.childNodes()] == ['Regions', 'Depth', 'Lit drawing'],
                   'the group has results')
        document.setActiveNode(document.nodeByName('Arrows'))

        docker.ticks['normals'].setChecked(True)
        docker.fields['light-azimuth'].set(40.0)
        QTest.mouseClick(docker.button, Qt.LeftButton)
        self.check(docker.cancel_button.isEnabled() and not docker.button.isEnabled(), 'it can be cancelled')
        QTest.mouseClick(docker.cancel_button, Qt.LeftButton)
        yield lambda: not docker.run
        self.check(docker.messages.toPlainText() == 'Cancelled.', 'Cancel ends it')
        self.check(len(group.childNodes()) == 3, 'and nothing is changed')

        QTest.mouseClick(docker.button, Qt.LeftButton)
        ticks = []
        QTimer.singleShot(1, lambda: ticks.append(1))
        yield lambda: not docker.run
        self.check(ticks, 'Krita goes on meanwhile')
        self.check([n.name() for n in group.childNodes()] == ['Regions', 'Depth', 'Normal map', 'Lit drawing'],
                   'the group has the new picture')
        yield lambda: not QApplication.activeModalWidget()
        window.qwindow().grab().save(os.path.join(OUT, 'dialog-krita.png'))

        count = len(listed(document.rootNode()))
        krita.action('add_new_paint_layer').trigger()
        yield lambda: len(listed(document.rootNode())) == count + 1
        krita.action('edit_undo').trigger()
        yield lambda: len(listed(document.rootNode())) == count
        self.check(document.nodeByName('Cartoon Depth'), 'undo takes back what the artist did, and leaves the results')
        document.nodeByName('Scribbles').setName('paper')
        document.nodeByName('Arrows').setName('notes')
        QTest.mouseClick(docker.button, Qt.LeftButton)
        yield lambda: not docker.run
        self.check('Set up layers' in docker.messages.toPlainText(), 'what is missing is said in the panel')


krita.addExtension(Checks(krita))
