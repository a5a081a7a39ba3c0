"""The panel "Cartoon Depth": what to make, how, and what the command says.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import json
from itertools import groupby
from typing import Callable, Dict, List, Optional

from krita import DockWidget, Document, Krita
from PyQt5.QtCore import Qt, pyqtBoundSignal
from PyQt5.QtWidgets import (QCheckBox, QComboBox, QDoubleSpinBox, QFormLayout, QGridLayout, QGroupBox, QHBoxLayout,
                             QLineEdit, QPlainTextEdit, QProgressBar, QPushButton, QScrollArea, QVBoxLayout, QWidget)

from . import results
from .kinds import Setting, Value
from .language import _
from .popup import Choices, Popup, Problem, set_up
from .tables import OWN_LABEL, PICTURES, PRESETS, SETTINGS

# Of the command, as it calls them.
STEPS = {'reading': _('reading'), 'ink': _('ink'), 'labels': _('labels'), 'order': _('order'), 'levels': _('levels'),
         'depth': _('depth'), 'normals': _('normals'), 'light': _('light'), 'shade': _('shade'),
         'shadows': _('shadows'), 'writing': _('writing')}
DIGITS = 6  # of a setting, more than any is shown with
OWN_SETTINGS, PROGRAM, CHOICES = 'celdepth', 'program', 'choices'  # in Krita's configuration


class Field:
    """The widget of a setting."""

    def __init__(self, setting: Setting):
        self.setting = setting
        self.get: Callable[[], Value]
        self.set: Callable[[Value], None]
        self.changed: pyqtBoundSignal
        if setting.choices:
            self.make_box(QComboBox())
        else:
            self.make_number(QDoubleSpinBox())
        self.widget.setToolTip(_(setting.help) + '.')
        self.widget.setObjectName(setting.name)

    def make_box(self, box: QComboBox) -> None:
        for value, label in self.setting.choices:
            box.addItem(_(label), value)
        self.widget, self.get = box, box.currentData
        self.set = lambda value: box.setCurrentIndex(max(box.findData(value), 0))
        self.changed = box.currentIndexChanged

    def make_number(self, box: QDoubleSpinBox) -> None:
        setting, factor = self.setting, self.setting.factor
        box.setDecimals(setting.digits)
        box.setRange(factor * setting.least, factor * setting.most)
        box.setSingleStep(factor * max(setting.step, (setting.most - setting.least) / 20))
        box.setSuffix(setting.unit if setting.unit in ('', '°') else ' ' + setting.unit)
        self.widget = box
        self.get = lambda: round(box.value() / factor, DIGITS)
        self.set = lambda value: box.setValue(factor * value)
        self.changed = box.valueChanged


class Docker(DockWidget):
    """The panel; one in each window of Krita."""

    def __init__(self) -> None:
        super().__init__()
        self.setWindowTitle('Cartoon Depth')
        self.run: Optional[Popup] = None
        self.document: Optional[Document] = None
        self.ticks: Dict[str, QCheckBox] = {}
        self.fields: Dict[str, Field] = {}
        inner = QWidget()
        column = QVBoxLayout(inner)
        column.addLayout(self.make_buttons())
        column.addWidget(self.make_pictures())
        column.addWidget(self.make_presets())
        for heading, settings in groupby(SETTINGS, lambda setting: setting.heading):
            column.addWidget(self.make_settings(heading, list(settings)))
        column.addWidget(self.make_program())
        column.addStretch(1)
        area = QScrollArea()
        area.setWidgetResizable(True)
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarAlwaysOff)
        area.setWidget(inner)
        area.setMinimumWidth(inner.minimumSizeHint().width() + area.verticalScrollBar().sizeHint().width())
        self.setWidget(area)
        self.show_choices(self.kept_choices())

    # ------------------------------------------------------------------ widgets

    def make_buttons(self) -> QVBoxLayout:
        self.button, self.cancel_button = QPushButton(_('Update')), QPushButton(_('Cancel'))
        self.set_up_button = QPushButton(_('Set up layers'))
        self.set_up_button.setToolTip(_('Makes layers for scribbles, contours and arrows, and locks the drawing.'))
        self.button.setToolTip(_('Makes the pictures that are ticked, in the group "Cartoon Depth".'))
        self.button.clicked.connect(self.start)
        self.cancel_button.clicked.connect(self.cancel)
        self.set_up_button.clicked.connect(self.set_up_layers)
        self.bar, self.messages = QProgressBar(), QPlainTextEdit()
        self.messages.setReadOnly(True)
        self.messages.setMaximumHeight(100)
        row = QHBoxLayout()
        row.addWidget(self.button)
        row.addWidget(self.cancel_button)
        column = QVBoxLayout()
        column.addWidget(self.set_up_button)
        column.addLayout(row)
        column.addWidget(self.bar)
        column.addWidget(self.messages)
        self.show_idle('')
        return column

    def make_pictures(self) -> QGroupBox:
        box = QGroupBox(_('Make'))
        grid = QGridLayout(box)
        for i, picture in enumerate(PICTURES):
            tick = self.ticks[picture.name] = QCheckBox(_(picture.label).replace('_', '&'))
            tick.setToolTip(_(picture.help) + '.')
            tick.setObjectName(picture.name)
            grid.addWidget(tick, i // 2, i % 2)
        return box

    def make_presets(self) -> QGroupBox:
        box = QGroupBox(_('Look'))
        form = QVBoxLayout(box)
        self.presets = QComboBox()
        for preset in PRESETS:
            self.presets.addItem(_(preset.label))
        self.presets.addItem(_(OWN_LABEL))
        self.presets.setToolTip(_('Settings of light and shadows that go together, and may be changed below') + '.')
        self.presets.activated.connect(self.choose_preset)
        form.addWidget(self.presets)
        return box

    def make_settings(self, heading: str, settings: List[Setting]) -> QGroupBox:
        box = QGroupBox(_(heading))
        form = QFormLayout(box)
        form.setFieldGrowthPolicy(QFormLayout.AllNonFixedFieldsGrow)
        form.setRowWrapPolicy(QFormLayout.WrapLongRows)
        for setting in settings:
            field = self.fields[setting.name] = Field(setting)
            field.widget.setMinimumWidth(60)
            field.changed.connect(self.show_preset)
            form.addRow(_(setting.label), field.widget)
        return box

    def make_program(self) -> QGroupBox:
        box = QGroupBox(_('Program'))
        form = QFormLayout(box)
        self.program = QLineEdit(Krita.instance().readSetting(OWN_SETTINGS, PROGRAM, ''))
        self.program.setPlaceholderText('celdepth')
        self.program.setToolTip(_('Where the program celdepth is; empty: where programs are looked for.'))
        form.addRow('celdepth', self.program)
        return box

    # ------------------------------------------------------------------ choices

    def choose_preset(self, index: int) -> None:
        if index < len(PRESETS):
            preset = PRESETS[index]
            for name, value in preset.settings.items():
                self.fields[name].set(value)
            if preset.picture:
                self.ticks[preset.picture].setChecked(True)

    def show_preset(self, *_value: object) -> None:
        """The one that the settings are, or that they are the artist's own."""
        own = {name: field.get() for name, field in self.fields.items()}
        fits = [all(own.get(name) == value for name, value in preset.settings.items()) for preset in PRESETS]
        self.presets.setCurrentIndex((fits + [True]).index(True))

    def choices(self) -> Choices:
        return Choices([p.name for p in PICTURES if self.ticks[p.name].isChecked()],
                       {name: field.get() for name, field in self.fields.items()})

    def show_choices(self, choices: Choices) -> None:
        for name, tick in self.ticks.items():
            tick.setChecked(name in choices.pictures)
        for name, field in self.fields.items():
            field.set(choices.settings[name])
        self.show_preset()

    def kept_choices(self) -> Choices:
        """Those of the last run in any document."""
        try:
            return Choices.read(json.loads(Krita.instance().readSetting(OWN_SETTINGS, CHOICES, 'null')))
        except ValueError:
            return Choices.usual()

    def keep_choices(self) -> None:
        Krita.instance().writeSetting(OWN_SETTINGS, CHOICES, json.dumps(self.choices()._asdict()))
        Krita.instance().writeSetting(OWN_SETTINGS, PROGRAM, self.program.text())

    def canvasChanged(self, canvas) -> None:  # pylint: disable=invalid-name
        """Krita shows another document: the choices are those that were made for it."""
        document = Krita.instance().activeDocument() if canvas else None
        self.button.setEnabled(bool(document) and not self.run)
        self.set_up_button.setEnabled(bool(document) and not self.run)
        if document and not (self.document and document == self.document):
            kept = results.kept(document).get('choices')
            if kept:
                self.show_choices(Choices.read(kept))
        self.document = document

    # ------------------------------------------------------------------ runs

    def show_idle(self, text: str) -> None:
        self.button.setEnabled(True)
        self.set_up_button.setEnabled(True)
        self.cancel_button.setEnabled(False)
        self.bar.setVisible(False)
        self.messages.setPlainText(text)
        self.messages.setVisible(bool(text))

    def start(self) -> None:
        """Makes the pictures of the document that is shown."""
        document = Krita.instance().activeDocument()
        if self.run or not document:
            return
        self.keep_choices()
        self.show_idle('')
        self.button.setEnabled(False)
        self.set_up_button.setEnabled(False)
        self.cancel_button.setEnabled(True)
        self.bar.setVisible(True)
        self.show_progress('reading', 0)
        self.run = Popup(document, self.choices(), self.program.text(), self)
        self.run.progress.connect(self.show_progress)
        self.run.ended.connect(self.end)
        self.run.start()

    def show_progress(self, step: str, done: int) -> None:
        self.bar.setValue(done)
        self.bar.setFormat(f'{STEPS.get(step, step)} %p %')

    def end(self, _good: bool, text: str) -> None:
        if self.run:
            self.run.deleteLater()
        self.run = None
        self.show_idle(text)

    def cancel(self) -> None:
        if self.run:
            self.run.cancel()

    def set_up_layers(self) -> None:
        document = Krita.instance().activeDocument()
        if not document or self.run:
            return
        try:
            set_up(document)
            self.show_idle('')
        except Problem as problem:
            self.show_idle(str(problem))
