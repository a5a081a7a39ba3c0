"""Texts in the language of Krita, from the catalogue of all plug-ins, `celdepth.mo`.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import gettext
import os
from itertools import takewhile
from typing import List

from PyQt5.QtCore import QLocale, QStandardPaths

DOMAIN = 'celdepth'


def languages() -> List[str]:
    """Those that Krita shows, the best one first, as gettext writes them, up to English, which needs no catalogue."""
    names = [name.replace('-', '_') for name in QLocale().uiLanguages()]
    return list(takewhile(lambda name: name.split('_')[0] not in ('en', 'C'), names))


def folders() -> List[str]:
    """Where catalogues may be: in share/locale if this is share/krita/pykrita/celdepth, or where data are."""
    share = os.path.abspath(os.path.join(os.path.dirname(__file__), '..', '..', '..'))
    return [os.path.join(share, 'locale'),
            *QStandardPaths.locateAll(QStandardPaths.GenericDataLocation, 'locale', QStandardPaths.LocateDirectory)]


def load() -> gettext.NullTranslations:
    """The first catalogue of one of the languages, or none."""
    wanted = languages()
    folder = next((folder for folder in folders() if wanted and gettext.find(DOMAIN, folder, wanted)), None)
    return gettext.translation(DOMAIN, folder, wanted, fallback=True) if folder else gettext.NullTranslations()


_ = load().gettext
