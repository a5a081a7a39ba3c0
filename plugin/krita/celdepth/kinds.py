"""Rows of the tables.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
from typing import Dict, List, NamedTuple, Tuple, Union

Value = Union[float, str]   # of a setting, as the command takes it


class Layer(NamedTuple):
    """A layer that the artist paints."""
    role: str               # also the option of the command: "scribbles"
    title: str              # its English name
    help: str
    names: List[str]        # in lower case and without accents, in all languages


class Picture(NamedTuple):
    """What can be made."""
    name: str
    option: str             # of the command
    label: str              # _ is before the mnemonic
    help: str
    layer: str              # the name of its layer
    usual: bool             # made by default


class Setting(NamedTuple):
    """An option of the command that is not a file."""
    name: str
    heading: str
    label: str
    help: str
    usual: Value
    least: float
    most: float
    step: float
    factor: float           # by which the panel shows more, with these digits and this unit
    digits: int
    unit: str
    choices: List[Tuple[str, str]]  # value and label; none: it is a number


class Preset(NamedTuple):
    """Settings that go together."""
    name: str
    label: str
    help: str
    picture: str                # the name of the one that shows it; empty: those made by default do
    settings: Dict[str, Value]  # all that are in some preset
