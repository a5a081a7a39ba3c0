#!/usr/bin/python3
"""Inputs that the fuzz targets begin with: one folder for each target; the same each time.

  seeds.py FOLDER

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os
import random
import struct
import sys

RELATIONS = [
    '', '120,80 > 300,95', '#ff0000 > #00ff00', '40,40 = 200,50', '1,1 > 2,2 > 3,3; 4,4 < 5,5 = 6,6',
    '1.5,2 > 3,4 @2.5',
    '# a remark\n1,2 > 3,4 +0.25\n', '1,1 > 2,2 @1e300 +1e-300', '-1,-1 > 1e9,1', '1,1 > 2,2 anchor', '1,1 ~> 2,2',
    '#ffF > 1,1', '1,1 >', '> 1,1', '1,1 > 2,2 extra', '1,,1 > 2', '\t1 , 1\t>\r\n 2,2 ;;;\n', '\xe4 > \xf6',
]
PATHS = [
    '', 'M 5,5 L 30,30', 'M5 5l20 0M1 1V9H9Z', 'm1-1.5.5.5e1', 'M0 0C1 1 2 2 3 3S4 4 5 5Q6 6 7 7T8 8',
    'M0 0A1 1 0 0 1 5 5', 'M 1,1 L 2,2\nL 3;4', 'M1e400 0L0 0', 'M 1 1', 'L 1 1', 'MM', 'm 0 0 1 1 2 2',
]


def npy(descr='<f4', shape='(3, 4)', numbers=12, version=1):
    header = f"{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}"
    header += ' ' * (117 - len(header)) + '\n'
    return (b'\x93NUMPY' + bytes([version, 0]) + struct.pack('<H', len(header)) + header.encode() +
            struct.pack(f'<{numbers}f', *range(numbers)))


def random_bytes(seed, sizes, each):
    return [bytes(random.Random(f'{seed} {size} {i}').randbytes(size)) for size in sizes for i in range(each)]


SEEDS = {
    'relations': [text.encode() for text in RELATIONS],
    'arrow-path': [text.encode() for text in PATHS],
    'layers': random_bytes('layers', (10, 60, 200), 20),
    'session': random_bytes('session', (20, 80, 250), 30),
    'steps': random_bytes('steps', (30, 90, 200), 30),
    'npy': [npy(), npy(shape='(1, 1)', numbers=1), npy(shape='(20000, 20000)'), npy(shape='(2, 2, 3)'), npy('>f4'),
            npy('<f8'), npy(version=2), npy()[:90], b''],
}


def main():
    for target, seeds in SEEDS.items():
        folder = os.path.join(sys.argv[1], target)
        os.makedirs(folder, exist_ok=True)
        for number, seed in enumerate(seeds):
            with open(os.path.join(folder, f'seed-{number:03}'), 'wb') as file:
                file.write(seed)


if __name__ == '__main__':
    main()
