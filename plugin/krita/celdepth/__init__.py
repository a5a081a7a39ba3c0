"""Cartoon Depth for Krita: a panel, and two entries of Tools > Scripts.

  language.py   texts in the language of Krita
  kinds.py      rows of tables.py, which is made from the tables of all plug-ins
  layers.py     layers of a document by their names, written to files
  command.py    a run of the command celdepth
  results.py    the group with the results
  popup.py      one run, from layers to results; Set up layers
  docker.py     the panel

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os

from krita import DockWidgetFactory, DockWidgetFactoryBase, Extension, Krita
from PyQt5.QtGui import QIcon
from PyQt5.QtWidgets import QDockWidget

from .docker import Docker
from .language import _

DOCKER = 'celdepth'
MENU = 'tools/scripts'
ICON = os.path.join(os.path.dirname(__file__), 'celdepth.svg')


def show_docker() -> Docker:
    """The panel of the window in use, which is shown."""
    docker = Krita.instance().activeWindow().qwindow().findChild(QDockWidget, DOCKER)
    docker.setVisible(True)
    docker.raise_()
    return docker


class CartoonDepth(Extension):
    """The entries of the menu."""

    def setup(self) -> None:
        """Krita calls this when it starts."""

    def createActions(self, window) -> None:  # pylint: disable=invalid-name
        update = window.createAction('celdepth_update', _('Cartoon Depth: update'), MENU)
        update.triggered.connect(lambda: show_docker().start())
        layers = window.createAction('celdepth_set_up_layers', _('Cartoon Depth: set up layers'), MENU)
        layers.triggered.connect(lambda: show_docker().set_up_layers())
        for action in (update, layers):
            action.setIcon(QIcon(ICON))


Krita.instance().addExtension(CartoonDepth(Krita.instance()))
Krita.instance().addDockWidgetFactory(DockWidgetFactory(DOCKER, DockWidgetFactoryBase.DockRight, Docker))
