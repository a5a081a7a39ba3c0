"""The group with the results: its layers are found again by their identities, whatever the artist calls them and
wherever the group is moved, and get new pixels in place, so that opacity, mode, masks and visibility stay.

Identities and choices are kept in the document, also in its file, as an annotation.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
from typing import Any, Dict, List, Optional

from krita import Document, Node
from PyQt5.QtCore import QByteArray
from PyQt5.QtGui import QImage

from . import layers
from .language import _
from .tables import GROUP_NAME, PICTURES

ANNOTATION = 'celdepth'


def kept(document: Document) -> Dict[str, Any]:
    """What is kept with the document."""
    if ANNOTATION not in document.annotationTypes():
        return {}
    try:
        found = json.loads(bytes(document.annotation(ANNOTATION)).decode())
    except ValueError:
        return {}
    return found if isinstance(found, dict) else {}


def keep(document: Document, **more: Any) -> None:
    """Keeps something with the document, beside what is kept already."""
    text = json.dumps({**kept(document), **more})
    document.setAnnotation(ANNOTATION, 'The choices and results of Cartoon Depth', QByteArray(text.encode()))


def identity(node: Node) -> str:
    return node.uniqueId().toString()


def group_of(document: Document) -> Optional[Node]:
    """The group with the results."""
    wanted = kept(document).get('group')
    return next((node for node in layers.listed(document.rootNode()) if wanted and identity(node) == wanted), None)


def pixels_of(path: str, depth: str) -> QByteArray:
    """The pixels of a file, as Krita has them: blue first."""
    image = QImage(path)
    if image.isNull():
        raise OSError(_('Cannot read "{path}".').format(path=path))
    if depth == 'U16':
        image = image.convertToFormat(QImage.Format_RGBA64).rgbSwapped()
    else:
        image = image.convertToFormat(QImage.Format_ARGB32)
    bits = image.constBits()
    bits.setsize(image.sizeInBytes())
    return QByteArray(bytes(bits))  # lines have no padding: a pixel has 4 or 8 bytes


def write_pixels(document: Document, node: Node, path: str) -> None:
    """Writes a picture into a layer, which has 8 or 16 bits in sRGB whatever the document has."""
    depth = layers.depth_of(document)
    same = node.colorProfile() in layers.SAME_PROFILES
    if not same or (node.colorModel(), node.colorDepth()) != (layers.MODEL, depth):
        node.setColorSpace(layers.MODEL, depth, layers.PROFILE)
    node.setPixelData(pixels_of(path, depth), 0, 0, document.width(), document.height())


class Group:
    """The group of a document, which is made if there is none, or if it is locked."""

    def __init__(self, document: Document):
        self.document = document
        group = group_of(document)
        self.fresh = group is None or group.locked()
        if self.fresh:
            self.group = document.createGroupLayer(GROUP_NAME)
            document.rootNode().addChildNode(self.group, None)
            self.found: Dict[str, Node] = {}
        else:
            self.group = group
            by_identity = {identity(node): node for node in layers.listed(group)}
            layer = kept(document).get('layers', {})
            self.found = {name: by_identity[wanted] for name, wanted in layer.items() if wanted in by_identity}

    def add(self, name: str, title: str, path: str, below: Optional[Node]) -> None:
        node = self.document.createNode(title, 'paintlayer')
        self.group.addChildNode(node, below)
        write_pixels(self.document, node, path)
        node.setVisible(False)
        self.found[name] = node

    def write(self, paths: Dict[str, str]) -> None:
        """Writes these pictures, and removes the layers of others; locked layers stay as they are."""
        below: Optional[Node] = None
        for picture in reversed(PICTURES):
            node, path = self.found.get(picture.name), paths.get(picture.name)
            if node and not node.locked():
                if path:
                    write_pixels(self.document, node, path)
                else:
                    node.remove()
                    del self.found[picture.name]
            elif path and not node:
                self.add(picture.name, _(picture.layer), path, below)
            if picture.name in self.found:
                node = self.found[picture.name]
                below = node if identity(node.parentNode()) == identity(self.group) else below
        top = self.top()
        if self.fresh and top:
            top.setVisible(True)
        keep(self.document, group=identity(self.group), layers={n: identity(node) for n, node in self.found.items()})

    def top(self) -> Optional[Node]:
        order: List[str] = [picture.name for picture in PICTURES if picture.name in self.found]
        return self.found[order[0]] if order else None


def write(document: Document, paths: Dict[str, str], choices: Dict[str, Any]) -> Node:
    """Puts pictures into the group, and returns it."""
    active = document.activeNode()
    group = Group(document)
    group.write(paths)
    keep(document, choices=choices)
    if active:
        document.setActiveNode(active)
    document.refreshProjection()
    document.setModified(True)
    return group.group
