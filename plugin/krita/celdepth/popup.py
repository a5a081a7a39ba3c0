"""From the layers of a document to the group with the results.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import tempfile
from typing import Any, Dict, List, NamedTuple, Optional

from krita import Document, Krita, Node
from PyQt5.QtCore import QObject, pyqtSignal

from . import command, layers, results
from .kinds import Value
from .language import _
from .tables import LAYERS, PICTURES, SETTINGS


class Choices(NamedTuple):
    """What the artist chose."""
    pictures: List[str]
    settings: Dict[str, Value]

    @classmethod
    def usual(cls) -> 'Choices':
        return cls([p.name for p in PICTURES if p.usual], {s.name: s.usual for s in SETTINGS})

    @classmethod
    def read(cls, kept: Any) -> 'Choices':
        """Those that were kept, as far as they are known."""
        usual = cls.usual()
        if not isinstance(kept, dict) or not isinstance(kept.get('settings'), dict):
            return usual
        known = {s.name: kept['settings'][s.name] for s in SETTINGS if s.name in kept['settings']
                 and isinstance(kept['settings'][s.name], str) == isinstance(s.usual, str)}
        return cls([p.name for p in PICTURES if p.name in kept.get('pictures', ())], {**usual.settings, **known})

    def words(self) -> List[str]:
        """The options of the command for settings that are not the default."""
        return [f'--{s.name}={self.settings[s.name]}' for s in SETTINGS if self.settings[s.name] != s.usual]


class Problem(Exception):
    """A sentence for the artist."""


class Popup(QObject):
    """One run for a document; `ended` comes once, also if nothing can be started."""
    progress = pyqtSignal(str, int)
    ended = pyqtSignal(bool, str)

    def __init__(self, document: Document, choices: Choices, program: str, parent: Optional[QObject] = None):
        super().__init__(parent)
        self.document, self.choices, self.program = document, choices, program
        self.size = document.width(), document.height()
        self.folder: Optional[tempfile.TemporaryDirectory] = None
        self.command: Optional[command.Command] = None
        self.paths: Dict[str, str] = {}

    def start(self) -> None:
        try:
            path = command.find(self.program)
            self.folder = tempfile.TemporaryDirectory(prefix='celdepth-')
            words = self.prepare(self.folder.name)
        except (Problem, OSError) as error:
            self.end(False, str(error))
            return
        self.command = command.Command(path, words, self)
        self.command.progress.connect(self.progress)
        self.command.ended.connect(self.finish)

    def prepare(self, folder: str) -> List[str]:
        """Writes the layers, and returns the words of the command."""
        if not self.choices.pictures:
            raise Problem(_('Nothing is chosen that could be made. Tick at least one picture.'))
        found = layers.find(self.document, results.group_of(self.document))
        if 'drawing' not in found:
            raise Problem(_('There is no layer named "Drawing", and there are several that could be it. Name it.'))
        if not self.choices.settings['flats'] == 'yes' and not {'scribbles', 'arrows'} & set(found):
            raise Problem(_('There is no layer with scribbles or arrows. Make them with "Set up layers", and scribble '
                            'over each part in a colour of its own.'))
        inputs = layers.write(self.document, results.group_of(self.document), folder)
        words = ['popup', inputs.pop('drawing'), '--progress', *self.choices.words()]
        for role, path in inputs.items():
            words += ['--' + role, path]
        for picture in PICTURES:
            if picture.name in self.choices.pictures:
                self.paths[picture.name] = os.path.join(folder, f'made-{picture.name}.png')
                words += ['--' + picture.option, self.paths[picture.name]]
        return words

    def finish(self, good: bool, text: str) -> None:
        try:
            if good:
                self.check()
                results.write(self.document, self.paths, self.choices._asdict())
        except (Problem, OSError) as error:
            good, text = False, str(error)
        self.end(good, text)

    def check(self) -> None:
        """The artist went on meanwhile."""
        if not any(document == self.document for document in Krita.instance().documents()):
            raise Problem(_('The document was closed meanwhile.'))
        if (self.document.width(), self.document.height()) != self.size:
            raise Problem(_('The size of the document changed meanwhile. Update again.'))

    def end(self, good: bool, text: str) -> None:
        if self.folder:
            text = text.replace(self.folder.name + os.sep, '')  # the artist knows layers, not files
            self.folder.cleanup()
        self.ended.emit(good, text)

    def cancel(self) -> None:
        if self.command:
            self.command.cancel()


def set_up(document: Document) -> List[Node]:
    """Makes the layers for scribbles, contours and arrows that are missing, above the drawing, which is locked."""
    group = results.group_of(document)
    found = layers.find(document, group)
    others = layers.without_role(layers.listed(document.rootNode(), group))
    drawing = found.get('drawing') or (others[-1] if others else None)
    if not drawing:
        raise Problem(_('The document has no layer with a drawing. Put the drawing on a layer of it first.'))
    if layers.role_of(drawing.name()) != 'drawing':
        drawing.setName(_(layers.DRAWING.title))
    titles = {layer.role: _(layer.title) for layer in LAYERS}
    made, below = [], drawing
    for role in ('scribbles', 'contours', 'arrows'):
        if role not in found:
            node = document.createNode(titles[role], 'paintlayer')
            drawing.parentNode().addChildNode(node, below)
            made.append(node)
            below = node
    drawing.setLocked(True)
    document.setActiveNode(made[0] if made else found['scribbles'])
    document.refreshProjection()
    document.setModified(True)
    return made
