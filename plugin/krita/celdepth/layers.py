"""Finds the layers of a document by their names, and writes them to files.

Layers are read from a copy of the document, so that nothing of the artist's changes: it is converted to sRGB if need
be, and what is hidden is shown.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import unicodedata
from typing import Dict, List, Optional

from krita import Document, Node
from PyQt5.QtGui import QImage

from .language import _
from .tables import LAYERS

MODEL, PROFILE = 'RGBA', 'sRGB built-in'
SAME_PROFILES = (PROFILE, 'sRGB-elle-V2-srgbtrc.icc')
NOT_LAYERS = ('transparencymask', 'filtermask', 'transformmask', 'selectionmask', 'colorizemask')
DRAWING = LAYERS[0]
FAST = 100  # the quality of a PNG file: not compressed, since it is read once


def fold(name: str) -> str:
    """Lower case without accents, spaces at the ends, and the ending of a file."""
    decomposed = unicodedata.normalize('NFKD', name).casefold()
    text = ''.join(c for c in decomposed if not unicodedata.combining(c))
    stem, dot, ending = text.rpartition('.')
    return (stem if dot and len(ending) <= 4 else text).strip()


def role_of(name: str) -> Optional[str]:
    """The role of a layer of this name."""
    folded = fold(name)
    return next((layer.role for layer in LAYERS if folded in layer.names), None)


def listed(parent: Node, but: Optional[Node] = None) -> List[Node]:
    """All layers below a node from the top to the bottom, without a group of results."""
    nodes = []
    for node in reversed(parent.childNodes()):
        if node.type() not in NOT_LAYERS and not (but and node.uniqueId() == but.uniqueId()):
            nodes += [node, *listed(node, but)]
    return nodes


def without_role(nodes: List[Node]) -> List[Node]:
    """The layers that could be the drawing: no groups."""
    return [node for node in nodes if not role_of(node.name()) and node.type() != 'grouplayer']


def find(document: Document, results: Optional[Node]) -> Dict[str, Node]:
    """The layers by their roles; the only layer that has none, and is no group, is the drawing."""
    nodes = listed(document.rootNode(), results)
    found: Dict[str, Node] = {}
    for node in nodes:
        role = role_of(node.name())
        if role:
            found.setdefault(role, node)
    others = without_role(nodes)
    if DRAWING.role not in found and len(others) == 1:
        found[DRAWING.role] = others[0]
    return found


def is_srgb(document: Document) -> bool:
    """Whether pixels are those of PNG files already, with 8 or 16 bits."""
    return (document.colorModel() == MODEL and document.colorDepth() in ('U8', 'U16')
            and document.colorProfile() in SAME_PROFILES)


def depth_of(document: Document) -> str:
    """The depth of pixels that are exchanged with the command."""
    return 'U8' if document.colorDepth() == 'U8' else 'U16'


def write_node(node: Node, width: int, height: int, path: str) -> None:
    """Writes what is seen of a layer, in the place of the document."""
    pixels = node.projectionPixelData(0, 0, width, height)
    if node.colorDepth() == 'U16':
        image = QImage(pixels, width, height, 8 * width, QImage.Format_RGBA64).rgbSwapped()  # Krita has blue first
    else:
        image = QImage(pixels, width, height, 4 * width, QImage.Format_ARGB32)
    if not image.save(path, 'PNG', FAST):
        raise OSError(_('Cannot write "{path}".').format(path=path))


def write(document: Document, results: Optional[Node], folder: str) -> Dict[str, str]:
    """Writes all layers that have a role, and returns their files."""
    document.waitForDone()
    copy = document.clone()
    try:
        found = find(copy, results)
        for node in found.values():
            shown: Optional[Node] = node
            while shown and shown.parentNode():
                shown.setVisible(True)
                shown = shown.parentNode()
        if not is_srgb(copy):
            copy.setColorSpace(MODEL, depth_of(copy), PROFILE)
        copy.refreshProjection()
        copy.waitForDone()
        paths = {role: os.path.join(folder, role + '.png') for role in found}
        for role, node in found.items():
            write_node(node, copy.width(), copy.height(), paths[role])
        return paths
    finally:
        copy.close()
