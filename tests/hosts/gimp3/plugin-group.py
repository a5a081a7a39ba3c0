# Runs Live group without a screen: the group shows Pop-up's depth, follows strokes, and is repaired after layers were
# resized and after its file was opened again.  For the Python interpreter of GIMP 3, with this folder in its path.
#
# SPDX-License-Identifier: LGPL-3.0-or-later
import gi
gi.require_version('Gegl', '0.4')
gi.require_version('Gimp', '3.0')
from gi.repository import Gegl, Gimp  # noqa: E402
import numpy as np  # noqa: E402
from people import (OUT, QUIET, add_path, all_layers, by_name, check, file, open_people, pixels, pop_up,  # noqa: E402
                    run)

NAMES = ['Drawing', 'Scribbles', 'Arrows']


def live_group(image):
    return run('plug-in-celdepth-live-group', image)


def effects(group):
    return [effect for effect in group.get_filters() if effect.get_operation_name() == 'celdepth:live-popup']


def uncover(group):
    """Lets nothing of the layers shine through."""
    effect, = effects(group)
    effect.set_opacity(1)
    effect.update()


def seen(image):
    """What the image shows, where all its layers are."""
    layer = Gimp.Layer.new_from_visible(image, image, 'seen')
    return pixels(layer, 'RGB float', np.float32, 3)


def depth_of_popup(image, **arguments):
    good, results, message = pop_up(image, ['depth'], **arguments)
    check(good, f'Pop-up runs {message}')
    depth = pixels(results.get_children()[0], 'RGB float', np.float32, 3)
    image.remove_layer(results)
    return depth


def shows_depth(image, what, **arguments):
    """Whether the image shows what Pop-up makes of its layers."""
    shown = seen(image)
    difference = np.abs(shown - depth_of_popup(image, **arguments)).max()
    check(difference <= 1e-5 and np.ptp(shown) > 0.5, f'{what}: the group shows depth, but for {difference:.2e}')


def paint(image, layer, box, colour):
    """Fills a rectangle of a layer, in the coordinates of the image."""
    Gimp.context_set_foreground(Gegl.Color.new(colour))
    image.select_rectangle(Gimp.ChannelOps.REPLACE, *box)
    layer.edit_fill(Gimp.FillType.FOREGROUND)
    Gimp.Selection.none(image)


def open_live(**arguments):
    image = open_people(32, **arguments)
    good, group, message = live_group(image)
    check(good, f'Live group runs {message}')
    return image, group


def a_group_is_made():
    image = open_people(32)
    run('plug-in-celdepth-set-up-layers', image)  # which locks the drawing
    image.select_rectangle(Gimp.ChannelOps.REPLACE, 100, 50, 80, 90)
    good, group, message = live_group(image)
    check(good, f'Live group runs {message}')
    layers = [layer.get_name() for layer in group.get_children()]
    check(layers == ['Arrows', 'Scribbles', 'Contours', 'Drawing'],
          f'it makes a group of the layers in their order: {layers}')
    check(group.get_mode() == Gimp.LayerMode.NORMAL and len(effects(group)) == 1, 'with one effect')
    check([layer.get_name() for layer in image.get_selected_layers()] == ['Scribbles'], 'Scribbles is selected')
    bounds = Gimp.Selection.bounds(image)
    check((bounds.x1, bounds.y1, bounds.x2, bounds.y2) == (100, 50, 180, 140), 'the selection stays')
    Gimp.Selection.none(image)
    through = seen(image)
    uncover(group)
    check(np.abs(through - seen(image)).max() > 0.2, 'the layers shine through a new effect')
    shows_depth(image, 'also where nothing was selected')
    image.delete()


def strokes_are_followed():
    image, group = open_live()
    uncover(group)
    before = seen(image)
    colour = 'rgb(1.0,0.05,0.05)'
    for name, box in (('Scribbles', (0, 0, 1024, 30)), ('Drawing', (0, 300, 1024, 4)), ('Arrows', (0, 0, 1024, 957))):
        if name == 'Arrows':
            by_name(image, name).edit_clear()
        else:
            paint(image, by_name(image, name), box, colour if name == 'Scribbles' else 'black')
        after = seen(image)
        check(np.abs(after - before).max() > 0.2, f'paint on {name} changes what is seen')
        shows_depth(image, f'after paint on {name}')
        before = after
    image.delete()


def one_effect_keeps_its_settings():
    image, group = open_live()
    effect, = effects(group)
    effect.get_config().set_property('result', 'labels')
    effect.get_config().set_property('hardness', 0.25)
    effect.set_opacity(0.5)
    effect.update()
    shown = seen(image)
    effect.set_visible(False)
    image.set_selected_layers([by_name(image, 'Arrows')])
    n = len(list(all_layers(image.get_layers())))
    good, again, message = live_group(image)
    check(good and again.get_id() == group.get_id() and len(effects(group)) == 1 and
          len(list(all_layers(image.get_layers()))) == n, f'a second run leaves one effect {message}')
    effect, = effects(group)
    config = effect.get_config()
    check(config.get_property('result') == 'labels' and config.get_property('hardness') == 0.25 and
          effect.get_opacity() == 0.5 and not effect.get_visible(), 'which keeps its settings')
    effect.set_visible(True)
    group.update(0, 0, group.get_width(), group.get_height())  # which GIMP does not do by itself
    check(np.array_equal(shown, seen(image)), 'and shows the same')
    check([layer.get_name() for layer in image.get_selected_layers()] == ['Arrows'],
          'the selected layer stays selected')
    image.delete()


def layers_that_were_resized_are_connected_again():
    image, group = open_live(small=True)
    sizes = {(layer.get_width(), layer.get_height(), *layer.get_offsets()[1:]) for layer in group.get_children()}
    check(sizes == {(image.get_width(), image.get_height(), 0, 0)}, f'small layers get the size of the group: {sizes}')
    uncover(group)
    shows_depth(image, 'of small layers')
    layer = by_name(image, 'Scribbles')
    layer.resize(900, 800, -50, -60)
    live_group(image)
    shows_depth(image, 'a layer that became smaller')
    paint(image, layer, (0, 0, 1024, 30), 'rgb(1.0,0.05,0.05)')
    shows_depth(image, 'and was painted on')
    drawing = by_name(image, 'Drawing')
    drawing.set_lock_content(True)
    drawing.set_lock_position(True)
    layer.resize(image.get_width() + 40, image.get_height() + 40, 20, 20)
    live_group(image)
    shows_depth(image, 'a layer that became larger')
    check(drawing.get_lock_content() and drawing.get_lock_position() and drawing.get_width() == layer.get_width(),
          'a locked drawing stays locked')
    image.delete()


def a_file_is_connected_again():
    image, group = open_live()
    uncover(group)
    shown = seen(image)
    Gimp.file_save(QUIET, image, file(OUT, 'plugin-live.xcf'), None)
    image.delete()
    image = Gimp.file_load(QUIET, file(OUT, 'plugin-live.xcf'))
    group = by_name(image, 'Live group')
    check(len(effects(group)) == 1 and np.abs(seen(image) - shown).max() > 0.2,
          'a file forgets the layers of the effect')
    outside = Gimp.Layer.new(image, 'mine', 20, 20, Gimp.ImageType.RGBA_IMAGE, 100, Gimp.LayerMode.NORMAL)
    image.insert_layer(outside, None, 0)  # which is selected
    good, again, message = live_group(image)
    check(good and again.get_id() == group.get_id() and len(effects(group)) == 1 and
          np.array_equal(seen(image), shown), f'they are connected again {message}')
    paint(image, by_name(image, 'Scribbles'), (0, 0, 1024, 30), 'rgb(1.0,0.05,0.05)')
    shows_depth(image, 'in a file that was opened again')
    image.delete()


def a_selected_group_is_used():
    """A drawing of several layers is a group, too."""
    image = open_people(32)
    notes, drawing = by_name(image, 'notes'), by_name(image, 'Drawing')
    inner = Gimp.GroupLayer.new(image, 'Drawing')
    drawing.set_name('lines')
    drawing.resize(image.get_width() - 10, image.get_height() - 8, -5, -4)
    image.insert_layer(inner, notes, 2)
    image.reorder_item(drawing, inner, 0)
    image.set_selected_layers([notes])
    good, group, message = live_group(image)
    check(good and group.get_id() == notes.get_id(), f'the effect is put on the group that is selected {message}')
    uncover(group)
    shows_depth(image, 'of a group as drawing')
    paint(image, drawing, (0, 300, 1024, 4), 'black')
    shows_depth(image, 'painted on in it')
    image.delete()


RELATION = '660,265 > 460,215'
STROKE, OTHER = [(300, 770), (500, 900), (700, 830)], [(388, 240), (700, 830)]


def open_chosen():
    """An image with layers of other names, the arguments that say which they are, and a layer Scribbles that is none of
    them."""
    image = open_people(32, ('one', 'two', 'three'))
    decoy = Gimp.Layer.new_from_drawable(by_name(image, 'three'), image)
    decoy.set_name('Scribbles')
    decoy.set_visible(False)
    image.insert_layer(decoy, by_name(image, 'notes'), 0)
    return image, {role: by_name(image, name)
                   for role, name in (('drawing', 'one'), ('scribbles', 'two'), ('arrows', 'three'))}


def add_corrections(image, scribbles):
    """Gives lines in the middle to the first part that is painted."""
    layer = Gimp.Layer.new(image, 'Corrections', image.get_width(), image.get_height(), Gimp.ImageType.RGBA_IMAGE, 100,
                           Gimp.LayerMode.NORMAL)
    image.insert_layer(layer, None, 0)
    painted = pixels(scribbles, "R'G'B'A u8", np.uint8, 4).astype(int)
    paint(image, layer, (300, 200, 400, 500), '#%02x%02x%02x' % tuple(painted[painted[..., 3] == 255][0, :3]))


def what_popup_reads_counts():
    """Paths, corrections, relations and settings, each of which changes depth; and layers that were chosen."""
    image, arguments = open_chosen()
    depth = [depth_of_popup(image, **arguments)]
    add_path(image, 'Arrows', STROKE)
    depth.append(depth_of_popup(image, **arguments))
    add_corrections(image, arguments['scribbles'])
    depth.append(depth_of_popup(image, **arguments))
    arguments['relations'] = RELATION
    depth.append(depth_of_popup(image, **arguments))
    arguments.update({'expansion': 'thickness', 'hardness': 0.3})
    depth.append(depth_of_popup(image, **arguments))
    changes = [np.abs(a - b).max() for a, b in zip(depth, depth[1:])]
    check(min(changes) > 0.05, f'each input changes depth: {changes}')
    image.set_selected_layers([arguments['drawing']])
    good, group, message = live_group(image)
    names = sorted(layer.get_name() for layer in group.get_children()) if good else []
    check(names == ['Corrections', 'one', 'three', 'two'], f'the layers are those that were chosen: {names} {message}')
    uncover(group)
    difference = np.abs(seen(image) - depth[-1]).max()
    check(difference <= 1e-5, f'the group shows the depth of Pop-up, but for {difference:.2e}')
    image.delete()


def places_count_from_the_corner_of_the_group():
    image, arguments = open_chosen()
    arguments['relations'] = RELATION
    add_path(image, 'Arrows', STROKE)
    arguments['scribbles'].resize(image.get_width() + 90, image.get_height() + 70, 60, 50)
    depth_of_popup(image, **arguments)
    image.set_selected_layers([arguments['drawing']])
    _, group, message = live_group(image)
    effect, = effects(group)
    places = [effect.get_config().get_property(name) for name in ('relations', 'arrow-path')]
    check(places == ['720,315 > 520,265', 'M 360.0000 820.0000 L 760.0000 880.0000'],
          f'places are moved: {places} {message}')
    uncover(group)
    image.resize(group.get_width(), group.get_height(), 60, 50)  # moves the path, too
    arguments['relations'] = places[0]
    shows_depth(image, 'of an image that becomes as large as its group', **arguments)
    image.delete()


def settings_are_those_of_the_artist():
    """In the effect, if they were changed there; else those of the last Pop-up, whenever Live group is chosen again."""
    def has(group, what, **wanted):
        config = effects(group)[0].get_config()
        found = {name: config.get_property(name.replace('_', '-')) for name in wanted}
        found.update({name: round(value, 6) for name, value in found.items() if isinstance(value, float)})
        check(len(effects(group)) == 1 and found == wanted, f'{what}: {found}')

    image = open_people(32)
    path = add_path(image, 'Arrows', STROKE)
    depth_of_popup(image, expansion='thickness', hardness=0.3, relations=RELATION)
    _, group, _ = live_group(image)
    has(group, 'a new effect has settings of Pop-up', expansion='thickness', hardness=0.3, relations=RELATION,
        arrow_path='M 300.0000 770.0000 L 700.0000 830.0000')
    effect, = effects(group)
    effect.get_config().set_property('hardness', 0.25)
    effect.get_config().set_property('close-gaps', False)
    effect.update()
    depth_of_popup(image, hardness=0.7, ambient=0.1)
    image.remove_path(path)
    add_path(image, 'Arrows', OTHER)
    live_group(image)
    has(group, 'changes of the artist stay', expansion='outlines', hardness=0.25, close_gaps=False, relations='',
        ambient=0.1, arrow_path='M 388.0000 240.0000 L 700.0000 830.0000')
    effect, = effects(group)
    effect.get_config().set_property('relations', '1,2 > 3,4')
    effect.update()
    Gimp.file_save(QUIET, image, file(OUT, 'plugin-live.xcf'), None)
    image.delete()
    image = Gimp.file_load(QUIET, file(OUT, 'plugin-live.xcf'))
    for path in image.get_paths():
        image.remove_path(path)
    depth_of_popup(image, hardness=0.7, ambient=0.15, suggest='all', relations=RELATION)
    _, group, _ = live_group(image)
    has(group, 'also those before the file was closed', hardness=0.25, close_gaps=False, relations='1,2 > 3,4',
        ambient=0.15, suggest='all', arrow_path='')
    image.delete()


def layers_outside_a_group_stay_there():
    image, arguments = open_chosen()
    notes = by_name(image, 'notes')
    image.reorder_item(arguments['drawing'], notes, 3)
    image.reorder_item(by_name(image, 'Scribbles'), None, 0)
    image.set_selected_layers([notes])
    wanted = depth_of_popup(image, **arguments)
    good, group, message = live_group(image)
    check(good and group.get_id() == notes.get_id(), f'chosen layers in a group that is selected are used {message}')
    uncover(group)
    difference = np.abs(seen(image) - wanted).max()
    check(difference <= 1e-5, f'for the depth of Pop-up, but for {difference:.2e}')
    image.reorder_item(arguments['scribbles'], None, 0)
    image.set_selected_layers([notes])
    good, _, message = live_group(image)
    check(not good and 'no layer named "Scribbles"' in message, f'a chosen one outside of it is missed: {message}')
    image.delete()


def what_cannot_work_is_refused():
    def refused(image, words):
        n = len(list(all_layers(image.get_layers())))
        good, _, message = live_group(image)
        check(not good and words in message and len(list(all_layers(image.get_layers()))) == n, f'refused: {message}')
        image.delete()

    image, group = open_live()
    group.set_mode(Gimp.LayerMode.PASS_THROUGH)
    refused(image, 'Set the mode of the group to Normal')
    image = open_people(32)
    image.remove_layer(by_name(image, 'Scribbles'))
    refused(image, 'no layer named "Scribbles"')
    refused(open_people(32, ('one', 'Scribbles', 'two')), 'no layer named "Drawing"')
    image = open_people(32)
    image.set_selected_layers([by_name(image, 'notes')])
    refused(image, 'The group "notes" has no layer named "Drawing"')
    image = open_people(8)
    image.convert_grayscale()
    refused(image, 'Image > Mode > RGB')


Gegl.init(None)
a_group_is_made()
strokes_are_followed()
one_effect_keeps_its_settings()
layers_that_were_resized_are_connected_again()
a_file_is_connected_again()
a_selected_group_is_used()
what_popup_reads_counts()
places_count_from_the_corner_of_the_group()
settings_are_those_of_the_artist()
layers_outside_a_group_stay_there()
what_cannot_work_is_refused()
