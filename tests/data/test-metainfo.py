#!/usr/bin/python3
"""What GIMP, Flatpak and software centres read of the plug-in: it is valid, and its parts agree with each other.

test-metainfo.py METAINFO VERSION

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

TOP = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..')
METAINFO, VERSION = sys.argv[1:]
ID = 'org.gimp.GIMP.Plugin.Celdepth'


def text_of(*path):
    with open(os.path.join(TOP, *path), encoding='utf-8') as file:
        return file.read()


class Metainfo(unittest.TestCase):
    root = ElementTree.parse(METAINFO).getroot()

    def test_valid(self):
        """Newer versions warn that there is no public page, which celdepth does not have yet."""
        said = subprocess.run(['appstreamcli', 'validate', '--no-net', '--no-color', METAINFO], capture_output=True,
                              text=True, check=False).stdout
        self.assertIn('alidation', said)
        self.assertEqual([line for line in said.splitlines()
                          if re.match(r'\s*[EW]:', line) and 'url-homepage-missing' not in line], [])

    def test_what_gimp_needs(self):
        """GIMP refuses an extension that lacks one of these, or is in a folder of another name."""
        self.assertEqual(os.path.basename(METAINFO), ID + '.metainfo.xml')
        self.assertEqual((self.root.get('type'), self.root.findtext('id'), self.root.findtext('extends')),
                         ('addon', ID, 'org.gimp.GIMP'))
        self.assertEqual(self.root.find('releases/release').get('version'), VERSION)
        self.assertEqual(self.root.findtext('requires/id'), 'org.gimp.GIMP')
        self.assertEqual([value.text for value in self.root.iter('value') if value.get('key') == 'GIMP::plug-in-path'],
                         ['celdepth'])

    def test_icon(self):
        self.assertEqual(self.root.findtext('icon'), 'celdepth')
        icon = ElementTree.fromstring(text_of('data', 'celdepth.svg'))
        self.assertEqual(icon.tag, '{http://www.w3.org/2000/svg}svg')
        self.assertEqual(icon.get('width'), icon.get('height'))


def has_package(name):
    return shutil.which('pkg-config') and not subprocess.run(['pkg-config', name], check=False).returncode


class Flatpak(unittest.TestCase):
    manifest = json.loads(text_of('data', ID + '.json'))
    prefix = manifest['build-options']['prefix']
    options = manifest['modules'][0]['config-opts']

    def test_extension(self):
        """An extension lives in the folder of the last word of its name, and GIMP merges the plug-ins of all.  The branch
        is the version of the extension point in the manifest of GIMP."""
        self.assertEqual((self.manifest['id'], self.manifest['branch']), (ID, '3'))
        self.assertEqual((self.manifest['runtime'], self.manifest['build-extension']), ('org.gimp.GIMP', True))
        self.assertEqual(self.prefix, '/app/extensions/' + ID.rsplit('.', 1)[1])

    def test_metainfo_is_composed(self):
        """By flatpak-builder itself: the program appstream-compose is gone since the SDK 24.08."""
        self.assertNotIn('appstream-compose', json.dumps(self.manifest))

    @unittest.skipUnless(has_package('gimp-3.0') and has_package('gimpui-3.0'), 'there is no GIMP 3')
    def test_where_files_go(self):
        """GIMP looks into /app/extensions/plug-ins, which has the plug-ins of all extensions; flatpak-builder, into the
        metainfo of the prefix; the plug-in, for its translations."""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(['meson', 'setup', folder, TOP, '--prefix', self.prefix, '--libdir', 'lib', *self.options],
                           check=True, stdout=subprocess.DEVNULL)
            installed = subprocess.run(['meson', 'introspect', '--installed', folder], check=True, capture_output=True,
                                       text=True).stdout
        places = set(json.loads(installed).values())
        for place in ('plug-ins/celdepth/celdepth', f'share/metainfo/{ID}.metainfo.xml',
                      'share/icons/hicolor/scalable/apps/celdepth.svg', 'share/locale/de/LC_MESSAGES/celdepth.mo'):
            self.assertIn(os.path.join(self.prefix, place), places)
        self.assertEqual([place for place in places if not place.startswith(self.prefix + '/')], [])
        self.assertEqual([place for place in places if 'krita' in place], [], 'GIMP has no use for it')

    def test_options_exist(self):
        known = set(re.findall(r"^option\('([^']+)'", text_of('meson_options.txt'), re.M))
        given = dict(word.removeprefix('-D').split('=', 1) for word in self.options)
        self.assertLessEqual(set(given), known)
        self.assertEqual(given['gimp3-plugin-dir'], self.prefix + '/plug-ins')

    def test_licence_exists(self):
        self.assertTrue(text_of('LICENSE'))


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
