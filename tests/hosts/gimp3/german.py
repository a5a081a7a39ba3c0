# Runs Pop-up for an artist whose GIMP speaks German.  For the Python interpreter of GIMP 3, with this folder in its path.
#
# SPDX-License-Identifier: LGPL-3.0-or-later
import gi
gi.require_version('Gimp', '3.0')
from gi.repository import Gimp  # noqa: E402
from people import OUT, by_name, check, compare, file, open_people, pop_up, results, run  # noqa: E402

label = Gimp.get_pdb().lookup_procedure('plug-in-celdepth-popup').get_menu_label()
check(label == '_Pop-up …', f'in German the entry of the menu is {label}')
good, group, message = pop_up(open_people(16, ('Zeichnung', 'Kritzeleien', 'Pfeile')), ['depth', 'lit'])
check(good, f'in German Pop-up runs {message}')
if good:
    names = {name: layer.get_name() for name, layer in results(group).items()}
    check(names == {'lit': 'Beleuchtete Zeichnung', 'depth': 'Tiefe'}, f'in German the results are {names}')
    compare(group, 16, 'in German')
image = open_people(8, ('Zeichnung', 'Kritzeleien', 'Pfeile'))
good, group, message = pop_up(image, ['depth'], relations='12,20 > dort')
check(not good and 'Die Beziehungen sind nicht lesbar: Zeile 1, Spalte 9' in message and 'ein Punkt »x,y«' in message,
      f'in German relations that cannot be read are refused: {message}')
by_name(image, 'Pfeile').set_offsets(image.get_width() + 10, 0)
good, group, message = pop_up(image, ['depth'])
check(not good and 'Die Ebene mit »Pfeile« liegt außerhalb des Bildes' in message,
      f'in German a layer outside the image is refused: {message}')
good, layer, message = run('plug-in-celdepth-stereo', open_people(8, ('Zeichnung', 'Kritzeleien', 'Pfeile')),
                           stereo='two-layers', new_image=True)
names = [view.get_name() for view in layer.get_image().get_layers()] if good else []
check(names == ['Linke Ansicht', 'Rechte Ansicht'], f'in German the views of a new image are {names} {message}')
image = open_people(8, ('Zeichnung', 'Kritzeleien', 'Pfeile'))
good, _, message = run('plug-in-celdepth-relief-mesh', image, file=file(OUT, 'model.xyz'))
check(not good and '.glb, .obj, .ply oder .stl' in message, f'in German another kind of file is refused: {message}')
