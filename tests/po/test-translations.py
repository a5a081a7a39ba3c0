#!/usr/bin/python3
"""Translations are complete: the template has the texts of the sources, each language has all of them, and layers that
are made with translated names are found by these.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import re
import subprocess
import sys
import tempfile
import unicodedata
import unittest

TOP = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..'))
PO = os.path.join(TOP, 'po')
TEMPLATE = os.path.join(PO, 'celdepth.pot')


def lines_of(*path):
    with open(os.path.join(TOP, *path), encoding='utf-8') as file:
        return file.read().splitlines()


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, check=True, cwd=TOP,
                          env=os.environ | {'LC_ALL': 'C.UTF-8'})


def texts_of(path):
    """msgid and msgstr of each entry of a .po file; of plural forms the singular."""
    entries = {}
    for entry in run('msgcat', '--no-wrap', path).stdout.split('\n\n'):
        parts = {'msgid': '', 'msgstr': ''}
        part = None
        for line in entry.splitlines():
            found = re.match(r'(msgid_plural|msgid|msgstr(?:\[[1-9]\])?)(?:\[0\])? (.*)', line)
            if found:
                part, line = found.groups()
            if part in parts and line.startswith('"'):
                parts[part] += line[1:-1].encode().decode('unicode_escape').encode('latin-1').decode()
        entries[parts['msgid']] = parts['msgstr']
    return {key: value for key, value in entries.items() if key}


LANGUAGES = [line for line in lines_of('po', 'LINGUAS') if line]


class Translations(unittest.TestCase):
    def test_template(self):
        with tempfile.TemporaryDirectory() as out:
            path = os.path.join(out, 'new.pot')
            run('xgettext', '--from-code=UTF-8', '-k_', '-kN_', '-kngettext:1,2', '-kg_dngettext:2,3', '-D', TOP, '-f', 'po/POTFILES',
                '-o', path)
            self.assertEqual(set(texts_of(TEMPLATE)), set(texts_of(path)), 'see po/README.md')

    def test_complete(self):
        for language in LANGUAGES:
            path = os.path.join(PO, language + '.po')
            statistics = run('msgfmt', '--check', '--statistics', '-o', '/dev/null', path).stderr
            self.assertRegex(statistics, r'^\d+ translated messages\.$', language)
            self.assertEqual(set(texts_of(TEMPLATE)), set(texts_of(path)), language)

    @unittest.skipUnless('KRITA_TABLES' in os.environ, 'built without the plug-in for Krita')
    def test_tables(self):
        """All texts of the tables of Krita's plug-in are translated."""
        folder = os.path.join(TOP, 'plugin', 'krita', 'celdepth')
        with open(os.environ['KRITA_TABLES'], encoding='utf-8') as file:
            source = file.read().replace('from .kinds', 'from kinds')
        tables = {}
        sys.path.insert(0, folder)
        exec(source, tables)  # pylint: disable=exec-used
        texts = [text for layer in tables['LAYERS'] for text in (layer.title, layer.help)]
        texts += [text for picture in tables['PICTURES'] for text in (picture.label, picture.help, picture.layer)]
        texts += [text for setting in tables['SETTINGS'] for text in (setting.heading, setting.label, setting.help)]
        texts += [label for setting in tables['SETTINGS'] for _, label in setting.choices]
        self.assertGreater(len(texts), 50)
        self.assertFalse(set(texts) - set(texts_of(TEMPLATE)))

    def test_form(self):
        """Mnemonics, the signs at the ends, and lines are those of the original."""
        for language in LANGUAGES:
            for text, translated in texts_of(os.path.join(PO, language + '.po')).items():
                for sign in ('_', '\n', '%', '<small>'):
                    self.assertEqual(text.count(sign), translated.count(sign), (language, text))
                text = text.replace('...', '…')
                for sign in ('.', ':', '…'):
                    self.assertEqual(text.endswith(sign), translated.endswith(sign), (language, text))

    def test_layer_names(self):
        """Names of layers are found by plugin/layer-names.c, which folds case and accents."""
        source = '\n'.join(lines_of('plugin', 'layer-names.c'))
        known = {role: re.findall('"([^"]+)"', names)
                 for role, names in re.findall(r'\[CELD_LAYER_(\w+)\]\s*= \{ ((?:"[^}]*))\}', source)}
        self.assertEqual(len(known), 6)
        for language in LANGUAGES:
            texts = texts_of(os.path.join(PO, language + '.po'))
            for role, names in known.items():
                translated = unicodedata.normalize('NFD', texts[role.capitalize()].lower())
                self.assertIn(''.join(c for c in translated if not unicodedata.combining(c)), names)


if __name__ == '__main__':
    unittest.main()
