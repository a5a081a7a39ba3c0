# Runs Pop-up for an artist whose GIMP speaks German.  For the Python interpreter of GIMP 3, with this folder in its path.
#
# SPDX-License-Identifier: LGPL-3.0-or-later
import gi
gi.require_version('Gimp', '3.0')
from gi.repository import Gimp  # noqa: E402
from people import check, compare, open_people, pop_up, results  # noqa: E402

label = Gimp.get_pdb().lookup_procedure('plug-in-celdepth-popup').get_menu_label()
check(label == '_Pop-up …', f'in German the entry of the menu is {label}')
good, group, message = pop_up(open_people(16, ('Zeichnung', 'Kritzeleien', 'Pfeile')), ['depth', 'lit'])
check(good, f'in German Pop-up runs {message}')
if good:
    names = {name: layer.get_name() for name, layer in results(group).items()}
    check(names == {'lit': 'Beleuchtete Zeichnung', 'depth': 'Tiefe'}, f'in German the results are {names}')
    compare(group, 16, 'in German')
