"""Shared by the comparisons of hosts.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import os


def checks_of_plugin(out, *more):
    """What the tests of the plug-in found, without and with a screen, and in more files."""
    for name in ('plugin.txt', 'plugin-screen.txt', *more):
        path = os.path.join(out, name)
        lines = open(path, encoding='utf-8').read().splitlines() if os.path.exists(path) else []
        if not lines or lines[-1] != 'ok   all checks were run':
            lines.append(f'FAIL {name} ends early')
        for line in lines:
            print(line)
            yield not line.startswith('FAIL')
