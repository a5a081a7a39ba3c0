"""Damaged copies of files: the same seed makes the same damage.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import struct

HEAD = 4096  # bytes; most of what decides about a file is said at its beginning
NUMBERS = [0, 1, 2, 0x7f, 0x80, 0xff, 0x7fff, 0x8000, 0xffff, 0x10000, 0x7fffffff, 0x80000000, 0xfffffff0, 0xffffffff]


def place(data, rng, size=1):
    """A place for `size` bytes; every other one near the beginning."""
    end = max(len(data) - size, 0)
    return rng.randint(0, min(end, HEAD) if rng.random() < 0.5 else end)


def flip_bits(data, rng):
    at = place(data, rng)
    data[at] ^= 1 << rng.randrange(8)


def set_byte(data, rng):
    data[place(data, rng)] = rng.choice([0, 1, 0x7f, 0x80, 0xff, rng.randrange(256)])


def set_number(data, rng):
    form = rng.choice(['<H', '>H', '<I', '>I'])
    number = rng.choice(NUMBERS) & (0xffff if form[1] == 'H' else 0xffffffff)
    at = place(data, rng, struct.calcsize(form))
    data[at:at + struct.calcsize(form)] = struct.pack(form, number)


def cut(data, rng):
    del data[max(place(data, rng), 1):]


def leave_out(data, rng):
    at = place(data, rng)
    del data[at:at + rng.randint(1, 64)]


def repeat(data, rng):
    at = place(data, rng)
    data[at:at] = data[at:at + rng.randint(1, 64)]


def copy_over(data, rng):
    size = rng.randint(1, 64)
    source, target = place(data, rng, size), place(data, rng, size)
    data[target:target + size] = data[source:source + size]


WAYS = [flip_bits, set_byte, set_number, set_number, cut, leave_out, repeat, copy_over]


def damaged(data, rng):
    """A copy with one to eight kinds of damage; never empty."""
    data = bytearray(data)
    for _ in range(1 << rng.randrange(4)):
        rng.choice(WAYS)(data, rng)
        data = data or bytearray(1)
    return bytes(data)
