"""Runs the command celdepth, and says how far it is.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import re
from typing import List

from PyQt5.QtCore import QObject, QProcess, QProcessEnvironment, QStandardPaths, QTimer, pyqtSignal

from .language import _, languages

BAR = re.compile(r'([\w-]+) +\[.*\] +(\d+) %')
KILL_AFTER = 3000  # milliseconds that a cancelled run has to end
GOOD = (0, 3)      # 3: there are results, but relations contradict each other


def find(command: str) -> str:
    """The path of the command; FileNotFoundError says what to do."""
    wanted = os.path.expanduser(command) or 'celdepth'
    path = QStandardPaths.findExecutable(wanted)
    if not path:
        raise FileNotFoundError(_('The program "{program}" is not found. Install celdepth, or name the program under '
                                  '"Program" at the end of this panel.').format(program=wanted))
    return path


def environment() -> QProcessEnvironment:
    """That of Krita, whose language may be another one than that of the system."""
    own = QProcessEnvironment.systemEnvironment()
    own.insert('LANGUAGE', ':'.join(languages()) or 'en')
    return own


class Output:
    """Takes standard error apart: the bar, which is drawn again and again in a line, and messages."""

    def __init__(self) -> None:
        self.rest, self.messages = '', []  # type: str, List[str]
        self.step, self.done = '', 0

    def add(self, text: str) -> None:
        *lines, self.rest = re.split(r'[\r\n]', self.rest + text)
        for line in [*lines, self.rest]:
            bar = BAR.match(line)
            if bar:
                self.step, self.done = bar[1], int(bar[2])
        self.messages += [line.rstrip() for line in lines if line.strip() and not BAR.match(line)]

    def text(self) -> str:
        """All messages, when the command has ended."""
        self.add('\n')
        return '\n'.join(self.messages)


class Command(QObject):
    """One run of the command, beside Krita, which goes on."""
    progress = pyqtSignal(str, int)      # step, percentage of all
    ended = pyqtSignal(bool, str)        # whether there are results; messages

    def __init__(self, path: str, words: List[str], parent: QObject):
        super().__init__(parent)
        self.output, self.cancelled = Output(), False
        self.process = QProcess(self)
        self.process.setProcessEnvironment(environment())
        self.process.readyReadStandardError.connect(self.read)
        self.process.errorOccurred.connect(self.fail)
        self.process.finished.connect(self.finish)
        self.process.start(path, words)

    def read(self) -> None:
        self.output.add(bytes(self.process.readAllStandardError()).decode(errors='replace'))
        self.progress.emit(self.output.step, self.output.done)

    def fail(self, error: int) -> None:
        """What is killed also finishes; what does not start does not."""
        if error == QProcess.FailedToStart:
            self.ended.emit(False, _('The program "{program}" cannot be started: {reason}.').format(
                program=self.process.program(), reason=self.process.errorString()))

    def finish(self, code: int, status: int) -> None:
        self.read()
        text = self.output.text()
        if self.cancelled:
            text = _('Cancelled.')
        elif status != QProcess.NormalExit and not text:
            text = _('celdepth ended unexpectedly.')
        self.ended.emit(not self.cancelled and status == QProcess.NormalExit and code in GOOD, text)

    def cancel(self) -> None:
        """Asks the command to end, and ends it if it does not."""
        self.cancelled = True
        self.process.terminate()
        QTimer.singleShot(KILL_AFTER, self.process.kill)
