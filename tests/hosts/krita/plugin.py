"""Runs the plug-in of Krita on documents of an example, without a window, and checks what it does.  For kritarunner.

$CELDEPTH_EXAMPLES: where the drawings are; $CELDEPTH_OUT: has people-PICTURE.npy and .png, which the command made, and
gets plugin.txt, a line for each check, plugin-people.kra, and plugin-start.kra for screen.py.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import traceback

import numpy as np
from krita import Krita
from PIL import Image
from PyQt5.QtCore import QByteArray, QEventLoop, QTimer
from PyQt5.QtWidgets import QApplication

from celdepth import docker, layers, popup, results

EXAMPLES, OUT = os.environ['CELDEPTH_EXAMPLES'], os.environ['CELDEPTH_OUT']
PICTURES = ['enhanced', 'lit', 'shading', 'normals', 'depth', 'levels', 'regions']
STRIP = ('drawing', 'scribbles', 'arrows')
TYPES = {'U8': (np.uint8, 255, 255), 'U16': (np.uint16, 65535, 65535), 'F32': (np.float32, 1, 65535)}
LINEAR = ('sRGB-elle-V2-g10.icc', 'scRGB (linear)')
CONVERTED = 2e-4  # colours that Krita's colour management made of linear light
LIMIT = 120000  # milliseconds of a run
krita = Krita.instance()
log = open(os.path.join(OUT, 'plugin.txt'), 'a', encoding='utf-8')


def check(fact, text):
    print('ok  ' if fact else 'FAIL', text, file=log, flush=True)


# ------------------------------------------------------------------ documents

def picture(path):
    """A file of 8 bits in [0,1], height x width x RGBA."""
    with Image.open(path) as image:
        return np.array(image.convert('RGBA')) / 255


def paint(node, values, x=0, y=0):
    """Writes RGBA in [0,1], as sRGB has it, into a layer."""
    kind, most, _ = TYPES[node.colorDepth()]
    values = values.copy()
    if node.colorProfile() in LINEAR:
        colour = values[..., :3]
        values[..., :3] = np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)
    if kind is np.float32:
        data = values.astype(kind)
    else:
        data = np.rint(values[..., [2, 1, 0, 3]] * most).astype(kind)
    node.setPixelData(QByteArray(data.tobytes()), x, y, data.shape[1], data.shape[0])


def pixels(node, width, height):
    """RGBA in [0,1] of a layer with 8 or 16 bits."""
    kind, most, _ = TYPES[node.colorDepth()]
    data = np.frombuffer(bytes(node.pixelData(0, 0, width, height)), kind)
    return data.reshape(height, width, 4)[..., [2, 1, 0, 3]] / most


def make_document(depth='U8', names=STRIP, profile=''):
    """The layers of the example people; of arrows a group, moved content, and what lies outside the page."""
    drawing = picture(os.path.join(EXAMPLES, 'people', 'drawing.png'))
    height, width = drawing.shape[:2]
    document = krita.createDocument(width, height, 'people', 'RGBA', depth, profile, 100.0)
    document.setBatchmode(True)
    root = document.rootNode()
    for child in root.childNodes():
        child.remove()
    for role, name in zip(STRIP, names):
        values = picture(os.path.join(EXAMPLES, 'people', role + '.png'))
        node = document.createNode(name, 'paintlayer')
        if role == 'arrows':
            group = document.createGroupLayer(name)
            root.addChildNode(group, None)
            group.addChildNode(node, None)
            node.setName('strokes')
        else:
            root.addChildNode(node, None)
        if role == 'scribbles':  # outside the page, and not in all of it
            wide = np.zeros((height, width + 40, 4))
            wide[:, 40:] = values
            wide[:, :20] = (0, 1, 0, 1)
            paint(node, wide, -40, 0)
            node.setVisible(False)
        else:
            paint(node, values)
    document.refreshProjection()
    document.waitForDone()
    document.setModified(False)
    return document


def by_name(document, name):
    return next(node for node in layers.listed(document.rootNode()) if node.name() == name)


def has_group(document):
    return any(node.name() == 'Cartoon Depth' for node in layers.listed(document.rootNode()))


def choose(*pictures, **settings):
    usual = popup.Choices.usual()
    return popup.Choices(list(pictures), {**usual.settings, **settings})


def run(document, choices, program='', cancel_after=None):
    """Runs to the end; whether there are results, what was said, and what was shown of the progress."""
    loop, said, shown = QEventLoop(), [], []
    one = popup.Popup(document, choices, program)
    one.ended.connect(lambda good, text: (said.append((good, text)), loop.quit()))
    one.progress.connect(lambda step, done: shown.append(done))
    QTimer.singleShot(LIMIT, loop.quit)
    one.start()
    if cancel_after is not None:
        QTimer.singleShot(cancel_after, one.cancel)
    if not said:
        loop.exec_()
    document.waitForDone()
    good, text = said[0] if said else (False, 'no end')
    return good, text, shown


# ------------------------------------------------------------------ checks

def reference(name):
    """What the command made, RGBA in [0,1], as its PNG files have it: light encoded as sRGB, depth as numbers."""
    if name == 'regions':
        return picture(os.path.join(OUT, 'people-regions.png'))
    values = np.atleast_3d(np.squeeze(np.load(os.path.join(OUT, f'people-{name}.npy')))).astype(float)
    if name == 'normals':
        values = 0.5 + 0.5 * values
    elif name in ('lit', 'enhanced', 'shading'):
        colour = np.clip(values[..., :3], 0, 1)
        values[..., :colour.shape[2]] = np.where(colour <= 0.0031308, 12.92 * colour,
                                                 1.055 * colour ** (1 / 2.4) - 0.055)
    if values.shape[2] == 1:
        values = np.repeat(values, 3, 2)
    return values if values.shape[2] == 4 else np.dstack([values, np.ones(values.shape[:2])])


def compare(document, what):
    """All pictures are those of the command."""
    width, height = document.width(), document.height()
    for name in PICTURES:
        node = results.Group(document).found[name]
        found, wanted = pixels(node, width, height), reference(name)
        difference = np.abs((found - wanted) * np.where(found[..., 3:] > 0, 1, [0, 0, 0, 1])).max()
        error = 1 / TYPES[node.colorDepth()][2]
        if document.colorProfile() in LINEAR and name in ('lit', 'enhanced'):
            error = CONVERTED
        check(difference <= error + 1e-9, f'{what}: {name} differs by {difference:.2e}')


def check_results(depth, profile='', names=STRIP):
    document = make_document(depth, names, profile)
    what = f'{depth} {document.colorProfile()}'
    before = [bytes(node.pixelData(0, 0, 300, 300)) for node in layers.listed(document.rootNode())]
    paths = layers.write(document, None, OUT)
    check(sorted(paths) == sorted(STRIP) and not document.modified(), f'{what}: reading does not mark the document')
    good, text, shown = run(document, choose(*PICTURES))
    check(good and not text, f'{what}: results without a message {text}')
    check(shown == sorted(shown) and shown and shown[-1] > 50, f'{what}: progress {shown[-3:]}')
    group = by_name(document, 'Cartoon Depth')
    check(document.topLevelNodes()[-1].name() == 'Cartoon Depth', f'{what}: the group is on top')
    check([node.name() for node in reversed(group.childNodes())] ==
          ['Drawing with shadows', 'Lit drawing', 'Shading', 'Normal map', 'Depth', 'Levels', 'Regions'],
          f'{what}: layers in their order')
    check([node.visible() for node in reversed(group.childNodes())] == [True] + 6 * [False],
          f'{what}: the top one is visible')
    after = [bytes(node.pixelData(0, 0, 300, 300)) for node in layers.listed(document.rootNode(), group)]
    check(after == before, f'{what}: the layers of the artist stay as they are')
    check(document.modified(), f'{what}: results mark the document')
    compare(document, what)
    return document


def check_again(document):
    """A second run, also in a file that was closed and opened."""
    group = by_name(document, 'Cartoon Depth')
    lit, depth = by_name(document, 'Lit drawing'), by_name(document, 'Depth')
    lit.setName('my light')
    lit.setOpacity(100)
    lit.setBlendingMode('multiply')
    own = document.createNode('own', 'paintlayer')
    group.addChildNode(own, lit)
    depth.setLocked(True)
    width, height = document.width(), document.height()
    old, kept = pixels(lit, width, height), results.identity(lit)
    good, text, _ = run(document, choose('lit', 'regions', **{'light-azimuth': 20.0, 'flats': 'no'}))
    check(good and not text, f'second run {text}')
    names = [node.name() for node in reversed(group.childNodes())]
    check(names == ['own', 'my light', 'Depth', 'Regions'],
          f'pictures that are no longer wanted go, locked and own layers stay: {names}')
    lit = by_name(document, 'my light')
    check((results.identity(lit), lit.opacity(), lit.blendingMode()) == (kept, 100, 'multiply'),
          'the layer is the same, with its opacity and mode')
    check(np.abs(pixels(lit, width, height) - old).max() > 0.05, 'and has the new light')
    path = os.path.join(OUT, 'plugin-people.kra')
    check(document.saveAs(path), 'saved')
    document.close()
    document = krita.openDocument(path)
    document.setBatchmode(True)
    good, text, _ = run(document, choose('lit', 'depth', 'regions'))
    lit = by_name(document, 'my light')
    check(good and results.identity(lit) == kept, f'found again in the file {text}')
    check(np.abs(pixels(lit, width, height) - old).max() == 0, 'and has the first light again')
    check(results.kept(document)['choices']['pictures'] == ['lit', 'depth', 'regions'], 'choices are kept')
    by_name(document, 'Cartoon Depth').setLocked(True)
    good, text, _ = run(document, choose('lit'))
    check(good and [n.name() for n in document.topLevelNodes()].count('Cartoon Depth') == 2,
          'a locked group stays, and a new one is made')
    document.close()


def check_bad_input():
    document = make_document()
    by_name(document, 'scribbles').setName('paper')
    by_name(document, 'arrows').setName('notes')
    for choices, program, naming in ((choose(), '', 'Tick'), (choose('depth'), '', 'Set up layers'),
                                     (choose('depth'), '/none/celdepth', '"/none/celdepth" is not found')):
        good, text, _ = run(document, choices, program)
        check(not good and naming in text, f'refused: {text}')
    by_name(document, 'paper').setName('SCRIBBLES')
    paint(by_name(document, 'drawing'), np.ones((document.height(), document.width(), 4)))
    QApplication.processEvents()  # in which Krita marks what was changed here
    document.setModified(False)
    good, text, _ = run(document, choose('depth'))
    check(not good and text.startswith('celdepth: "drawing.png" has no lines'), f'the words of the command: {text}')
    check(not has_group(document) and not document.modified(), 'nothing is changed')
    document.close()
    document = make_document()
    good, text, _ = run(document, choose(*PICTURES), cancel_after=150)
    check(not good and text == 'Cancelled.' and not has_group(document), f'cancelled: {text}')
    document.resizeImage(0, 0, document.width() + 8, document.height())
    good, text, _ = run(document, choose('depth'))
    check(good, f'a page that was made wider {text}')
    document.close()


def check_set_up():
    document = make_document()
    for name in ('scribbles', 'arrows'):
        by_name(document, name).remove()
    by_name(document, 'drawing').setName('Paint layer 1')
    made = [node.name() for node in popup.set_up(document)]
    names = [node.name() for node in document.topLevelNodes()]
    check(made == ['Scribbles', 'Contours', 'Arrows'] and names == ['Drawing', *made], f'set up: {names}')
    check(by_name(document, 'Drawing').locked(), 'the drawing is locked')
    check(popup.set_up(document) == [], 'nothing is made twice')
    paint(by_name(document, 'Scribbles'), picture(os.path.join(EXAMPLES, 'people', 'scribbles.png')))
    good, text, _ = run(document, choose('regions'))
    check(good, f'empty layers count as none {text}')
    document.close()


def keep_start():
    """Layers for the tests in a window."""
    document = make_document('U8', ('Drawing', 'Scribbles', 'Arrows'))
    by_name(document, 'Scribbles').setVisible(True)
    check(document.saveAs(os.path.join(OUT, 'plugin-start.kra')), 'layers are kept')
    document.close()


def check_names():
    for name, role in (('Drawing', 'drawing'), ('KRITZELEIEN', 'scribbles'), ('Čmáranice', 'scribbles'),
                       ('s\u030cipky', 'arrows'), (' Pfeile.png', 'arrows'), ('Obrysy', 'contours'),
                       ('Verdeckt', 'hidden'), ('Scribbles copy', None), ('Drawing with shadows', None), ('', None),
                       ('.png', None)):
        check(layers.role_of(name) == role, f'the name "{name}" is {role}')


def check_german():
    """Krita speaks German."""
    panel = docker.Docker()
    texts = [panel.button.text(), panel.ticks['depth'].text(), panel.fields['flats'].widget.itemText(0)]
    check(texts == ['Aktualisieren', '&Tiefe', 'Ja'], f'the panel in German: {texts}')
    document = make_document('U8', ('Zeichnung', 'Kritzeleien', 'Pfeile'))
    made = [node.name() for node in popup.set_up(document)]
    check(made == ['Konturen'], f'set up in German: {made}')
    good, text, _ = run(document, choose('lit', 'depth'))
    names = [node.name() for node in reversed(by_name(document, 'Cartoon Depth').childNodes())] if good else [text]
    check(names == ['Beleuchtete Zeichnung', 'Tiefe'], f'results in German: {names}')
    good, text, _ = run(document, choose())
    check(not good and text.startswith('Es ist nichts gewählt'), f'refused in German: {text}')
    paint(by_name(document, 'Zeichnung'), np.ones((document.height(), document.width(), 4)))
    good, text, _ = run(document, choose('depth'))
    check(not good and text.startswith('celdepth: »drawing.png« hat keine Linien'), f'the command in German: {text}')
    document.close()


def check_presets():
    """Each sets the fields, shows itself, and gives way to the artist's own settings."""
    panel = docker.Docker()
    panel.show_choices(popup.Choices.usual())
    check(panel.presets.currentText() == 'Everyday', f'the defaults are a preset: {panel.presets.currentText()}')
    texts = [panel.fields[name].widget.text() for name in ('ambient', 'shadow-size', 'light-azimuth', 'bulge')]
    check(texts == ['25 %', '1.20 %', '135°', '1.00'], f'numbers have their units: {texts}')
    for index in (2, 4, 1):
        panel.presets.setCurrentIndex(index)
        panel.presets.activated.emit(index)
        check(panel.presets.currentIndex() == index, f'{panel.presets.currentText()} stays chosen')
    words = panel.choices().words()
    check(words == ['--light-model=toon', '--toon-steps=2.0', '--ambient=0.5'], f'Cel animation: {words}')
    check(panel.ticks['enhanced'].isChecked(), 'Cut paper has ticked the picture that shows it')
    panel.fields['bulge'].set(0.5)
    check(panel.presets.currentText() == 'Own settings', 'a setting of a preset was changed')
    panel.fields['bulge'].set(1.0)
    check(panel.presets.currentText() == 'Cel animation', 'and set back')


def check_arrow_style():
    """How arrows are drawn is chosen in the panel.  Arrows with heads do not fade, so that all parts have one level."""
    panel = docker.Docker()
    panel.show_choices(popup.Choices.usual())
    panel.fields['arrow-style'].set('fade')
    document = make_document()
    good, text, _ = run(document, panel.choices()._replace(pictures=['levels']))
    levels = pixels(by_name(document, 'Levels'), document.width(), document.height()) if good else np.zeros((1, 1, 4))
    check(good and np.unique(levels[..., 0]).tolist() == [0, 1], f'arrows with heads are read as arrows that fade {text}')
    document.close()


def german(_arguments=None):
    try:
        check_german()
    except Exception:  # pylint: disable=broad-except
        check(False, traceback.format_exc())
    log.close()
    os._exit(0)


def main(_arguments=None):
    try:
        check_names()
        check_again(check_results('U8'))
        check_results('U16', names=('Zeichnung', 'Čmáranice', 'PFEILE')).close()
        check_results('U16', 'sRGB-elle-V2-srgbtrc.icc').close()
        check_results('F32').close()
        check_results('U8', 'sRGB-elle-V2-srgbtrc.icc').close()
        check_bad_input()
        check_set_up()
        check_presets()
        check_arrow_style()
        keep_start()
        check(True, 'all checks were run')
    except Exception:  # pylint: disable=broad-except
        check(False, traceback.format_exc())
    log.close()
    os._exit(0)  # some threads of Krita outlive its application, and abort
