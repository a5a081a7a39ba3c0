# Runs the plug-in on layered images without a screen, and checks what it does.  For the Python interpreter of GIMP 3,
# with this folder in its path.
#
# $CELDEPTH_OUT gets plugin-people.xcf and plugin-large.xcf, the layers of an example for the tests with a screen.
#
# SPDX-License-Identifier: LGPL-3.0-or-later
import os
import re

import gi
gi.require_version('Gegl', '0.4')
gi.require_version('Gimp', '3.0')
from gi.repository import Gegl, Gimp, Gio  # noqa: E402
import numpy as np  # noqa: E402
from people import (ERRORS, EXAMPLES, OUT, PICTURES, PRECISIONS, QUIET, Image, all_layers, by_name, check,  # noqa: E402
                    compare, file, open_people, pixels, pop_up, reference, results, run)

# ------------------------------------------------------------------ the checks

def entries_of_the_menu_have_an_icon():
    """As GIMP keeps what it has asked the plug-in for, a line each."""
    with open(os.path.join(Gimp.directory(), 'pluginrc'), encoding='utf-8', errors='replace') as f:
        kept = f.read().split('(proc-def "')
    icon = re.compile(r'\(icon image-file -?\d+ "([^"]+)"\)')
    icons = [icon.search(entry) for entry in kept if entry.startswith('plug-in-celdepth-') and '(menu-path' in entry]
    found = {os.path.exists(Gio.File.new_for_uri(each[1]).get_path()) if each else False for each in icons}
    check(len(icons) == 9 and found == {True}, f'{len(icons)} entries have an icon')


def results_are_those_of_the_command():
    names = {8: ('Drawing', 'Scribbles', 'Arrows'), 16: ('zeichnung', 'KRITZELEIEN', 'Pfeile'),
             32: ('Kresba', 'Čmáranice', 'ŠIPKY')}
    for bits in PRECISIONS:
        image = open_people(bits, names[bits], small=bits != 8)
        if bits == 32:
            Gimp.file_save(QUIET, image, file(OUT, 'plugin-32.xcf'), None)
            image.delete()
            image = Gimp.file_load(QUIET, file(OUT, 'plugin-32.xcf'))
        image.select_rectangle(Gimp.ChannelOps.REPLACE, 100, 50, 80, 90)
        good, group, message = pop_up(image)
        check(good, f'{bits} bits: Pop-up runs {message}')
        if not good:
            continue
        compare(group, bits, ', '.join(names[bits]))
        check([layer.get_visible() for layer in group.get_children()] == [True] + 6 * [False],
              f'{bits} bits: the top result is visible, the others are there')
        check(list(results(group)) == PICTURES, f'{bits} bits: the results are in their order')
        bounds = Gimp.Selection.bounds(image)
        check((bounds.x1, bounds.y1, bounds.x2, bounds.y2) == (100, 50, 180, 140), f'{bits} bits: the selection stays')
        check([layer.get_name() for layer in image.get_selected_layers()] == [names[bits][1]],
              f'{bits} bits: the layer that the artist paints on stays selected')
        image.delete()


def a_second_run_updates_in_place():
    image = open_people(8)
    by_name(image, 'Arrows').set_visible(False)
    image.select_rectangle(Gimp.ChannelOps.REPLACE, 100, 50, 80, 90)
    arrows = by_name(image, 'Arrows')
    offsets = arrows.get_offsets()
    arrows.set_offsets(offsets.offset_x + image.get_width(), offsets.offset_y)
    good, _, message = pop_up(image)
    check(not good and "'Arrows' lies outside the image" in message, f'a layer outside the image is refused: {message}')
    arrows.set_offsets(offsets.offset_x, offsets.offset_y)
    _, group, _ = pop_up(image, ['depth', 'levels', 'normals'])
    first = results(group)
    first['depth'].set_name('my depth')
    first['depth'].set_opacity(40)
    first['depth'].resize(100, 100, -20, -30)
    first['depth'].set_lock_alpha(True)
    first['normals'].fill(Gimp.FillType.WHITE)
    first['normals'].set_lock_content(True)
    kept = pixels(first['normals'], 'RGB float', np.float32, 3)
    outer = Gimp.GroupLayer.new(image, 'outer')
    image.insert_layer(outer, None, 0)
    image.reorder_item(group, outer, 0)
    own = Gimp.Layer.new(image, 'my own', 20, 20, Gimp.ImageType.RGBA_IMAGE, 100, Gimp.LayerMode.NORMAL)
    image.insert_layer(own, group, 1)
    own.fill(Gimp.FillType.WHITE)
    n = len(list(all_layers(image.get_layers())))
    _, again, _ = pop_up(image, ['depth', 'levels', 'lit', 'normals', 'regions'])
    ids = {layer.get_id() for layer in again.get_children()}
    check(again.get_id() == group.get_id() and again.get_parent().get_id() == outer.get_id(),
          'a second run finds the group where the artist has moved it')
    check({layer.get_id() for layer in first.values()} <= ids and own.get_id() in ids,
          'a second run keeps the layers of the group, and the artist\'s own in it')
    check(len(list(all_layers(image.get_layers()))) == n + 2, 'new pictures are added to it')
    depth = first['depth']
    check(depth.get_name() == 'my depth' and round(depth.get_opacity()) == 40 and depth.get_lock_alpha(),
          'name, opacity and lock of a layer stay')
    check(depth.get_width() == image.get_width() and np.array_equal(depth.get_offsets()[1:], [0, 0]) and
          np.abs(pixels(depth, "R'G'B' float", np.float32, 3) - reference('depth', 8)).max() <= ERRORS[8] + 1e-6,
          'a layer gets the new pixels, also beyond the selection and where it was cropped')
    check(np.array_equal(kept, pixels(first['normals'], 'RGB float', np.float32, 3)), 'a locked layer stays as it is')
    _, again, _ = pop_up(image, ['depth'])
    left = [layer.get_name() for layer in again.get_children()]
    check(sorted(left) == sorted(['my depth', 'Normal map', 'my own']), f'pictures that are not wanted go: {left}')
    image.delete()


def locks_are_kept():
    image = open_people(8)
    _, group, _ = pop_up(image, ['depth', 'levels', 'regions'])
    first = results(group)
    inner = Gimp.GroupLayer.new(image, 'inner')
    outer = Gimp.GroupLayer.new(image, 'outer')
    image.insert_layer(outer, None, 0)
    image.insert_layer(inner, outer, 0)
    image.reorder_item(group, inner, 0)
    boxes = {'depth': (300, 200, 120, 80), 'levels': (-40, 100, 500, 300)}
    for name, (x, y, width, height) in boxes.items():
        first[name].resize(width, height, -x, -y)
        first[name].set_lock_position(True)
        first[name].fill(Gimp.FillType.WHITE)
    pop_up(image, ['depth', 'levels', 'regions'])
    for name, (x, y, width, height) in boxes.items():
        layer = first[name]
        offsets = tuple(layer.get_offsets()[1:])
        check((*offsets, layer.get_width(), layer.get_height()) == (x, y, width, height),
              f'a layer whose place is locked keeps it: {offsets}, {layer.get_width()} x {layer.get_height()}')
        found = pixels(layer, "R'G'B' float", np.float32, 3)[max(-y, 0):, max(-x, 0):]
        wanted = reference(name, 8)[max(y, 0):y + height, max(x, 0):x + width]
        check(np.abs(found - wanted).max() <= ERRORS[8] + 1e-6, f'and gets the part of the picture on it: {name}')
    for layer in first.values():
        layer.set_lock_position(False)
    first['regions'].resize(50, 60, 0, 0)
    outer.set_lock_position(True)
    pop_up(image, ['depth', 'levels', 'regions'])
    check([layer.get_width() for layer in first.values()] == [120, 500, 50],
          'a group around the group of results locks the places of its layers')
    outer.set_lock_position(False)
    outer.set_lock_content(True)
    kept = {name: pixels(layer, 'RGB float', np.float32, 3) for name, layer in first.items()}
    good, again, message = pop_up(image, ['depth', 'lit'])
    check(good and again.get_id() != group.get_id() and sorted(results(again)) == ['depth', 'lit'],
          f'if a group around it locks pixels, another group is made {message}')
    compare(again, 8, 'beside a locked group')
    check(sorted(results(group)) == sorted(kept) and
          all(np.array_equal(kept[name], pixels(layer, 'RGB float', np.float32, 3)) for name, layer in first.items()),
          'and the locked one stays as it is')
    image.delete()


RELATION = '300,770 > 700,830'  # with which the command made both-levels.npy


def levels_have_the_relation(group):
    difference = np.abs(pixels(results(group)['levels'], "R'G'B' float", np.float32, 3) - reference('both-levels', 8))
    return difference.max() <= ERRORS[8] + 1e-6


def relations_are_those_of_the_image():
    """GIMP fills in those of the last run, whichever image that was on."""
    last = os.path.join(Gimp.directory(), 'plug-in-settings', 'GimpProcedureConfigRun-plug-in-celdepth-popup.last')
    os.makedirs(os.path.dirname(last), exist_ok=True)
    with open(last, 'w', encoding='utf-8') as settings:
        settings.write('(levels yes)\n(relations "those of another image")\n')
    image = open_people(8)
    good, group, message = run('plug-in-celdepth-popup', image, Gimp.RunMode.WITH_LAST_VALS)
    check(good and 'levels' in results(group) and not levels_have_the_relation(group),
          f'relations of another image are left out {message}')
    _, group, _ = pop_up(image, ['levels'], relations=RELATION)
    check(levels_have_the_relation(group), 'relations count')
    good, group, message = run('plug-in-celdepth-popup', image, Gimp.RunMode.WITH_LAST_VALS)
    check(good and levels_have_the_relation(group), f'and stay with their image {message}')
    os.remove(last)
    image.delete()


def copies_are_the_artists():
    """Copies of results have the same marks: they are kept, and the originals below them updated."""
    image = open_people(8)
    _, group, _ = pop_up(image, ['lit', 'depth', 'regions'])
    made = results(group)
    whole = group.copy()
    image.insert_layer(whole, None, 0)
    own = made['depth'].copy()
    image.insert_layer(own, group, image.get_item_position(made['depth']))
    for layer in (own, *whole.get_children(), made['depth']):
        layer.fill(Gimp.FillType.WHITE)
    made['lit'].set_lock_content(True)
    _, again, _ = pop_up(image, ['shading', 'depth', 'regions'])
    check(again.get_id() == group.get_id(), 'a copy of the group above is not taken for the group')
    check(pixels(own, 'RGB float', np.float32, 3).min() == 1 and
          all(pixels(layer, 'RGB float', np.float32, 3).min() == 1 for layer in whole.get_children()),
          'copies of results stay as they are')
    check(pixels(made['depth'], 'RGB float', np.float32, 3).min() == 0, 'the original of a copy is updated')
    check([layer.get_name() for layer in again.get_children()][:2] == ['Lit drawing', 'Shading'],
          'a new picture comes below a locked one that lies above it')
    image.delete()


def input_without_sense_is_refused():
    def refused(image, words, **arguments):
        n = len(list(all_layers(image.get_layers())))
        good, _, message = pop_up(image, **arguments)
        check(not good and words in message and len(list(all_layers(image.get_layers()))) == n, f'refused: {message}')
        image.delete()

    image = open_people(8)
    image.convert_grayscale()
    refused(image, 'Image > Mode > RGB')
    image = open_people(8)
    for name in ('Scribbles', 'Arrows'):
        image.remove_layer(by_name(image, name))
    refused(image, 'Set up layers')
    refused(open_people(8, ('one', 'Scribbles', 'two')), 'no layer named "Drawing"')
    image = open_people(8)
    by_name(image, 'Drawing').fill(Gimp.FillType.WHITE)
    refused(image, 'has no lines')
    refused(open_people(8), 'Tick at least one', wanted=())
    refused(open_people(8), 'line 1, column 3', relations='5 > 7')
    other = open_people(8)
    refused(open_people(8), 'belongs to another image', scribbles=by_name(other, 'Scribbles'))
    image = other
    refused(image, 'chosen as', scribbles=by_name(image, 'Drawing'))


def empty_place(layer, channel, nothing):
    """A square without paint, in the coordinates of the layer."""
    side = 60
    paint = pixels(layer, channel, np.float32, 1)[..., 0] != nothing
    return next((x, y, side, side) for y in range(0, paint.shape[0] - side, 20)
                for x in range(0, paint.shape[1] - side, 20) if not paint[y:y + side, x:x + side].any())


def mask_out(image, layer, box, colour):
    """Paints on a layer where its new mask hides it."""
    mask = layer.create_mask(Gimp.AddMaskType.WHITE)
    layer.add_mask(mask)
    offsets = layer.get_offsets()
    image.select_rectangle(Gimp.ChannelOps.REPLACE, box[0] + offsets.offset_x, box[1] + offsets.offset_y, *box[2:])
    Gimp.context_set_foreground(Gegl.Color.new('black'))
    mask.edit_fill(Gimp.FillType.FOREGROUND)
    Gimp.context_set_foreground(Gegl.Color.new(colour))
    (layer.get_children()[0] if layer.is_group() else layer).edit_fill(Gimp.FillType.FOREGROUND)
    Gimp.Selection.none(image)


def layers_are_read_as_they_are_seen():
    for bits in (8, 32):
        image = open_people(bits, small=True)
        drawing, scribbles, arrows = (by_name(image, name) for name in ('Drawing', 'Scribbles', 'Arrows'))
        arrows.set_name('strokes')
        group = Gimp.GroupLayer.new(image, 'Arrows')
        image.insert_layer(group, None, 0)
        image.reorder_item(arrows, group, 0)
        mask_out(image, drawing, empty_place(drawing, 'Y float', 1), 'black')
        mask_out(image, scribbles, empty_place(scribbles, 'A float', 0), 'rgb(1.0,0.0,1.0)')
        mask_out(image, group, empty_place(group, 'A float', 0), 'rgb(0.0,0.0,0.5)')
        scribbles.set_visible(False)
        scribbles.set_opacity(20)
        scribbles.set_show_mask(True)
        images, layers = len(Gimp.get_images()), len(list(all_layers(image.get_layers())))
        good, made, message = pop_up(image, ['regions', 'depth'])
        check(good, f'{bits} bits: layers with masks are read {message}')
        compare(made, bits, 'with masks')
        check(len(Gimp.get_images()) == images and len(list(all_layers(image.get_layers()))) == layers + 3,
              'and no copies are left')
        scribbles.set_apply_mask(False)
        _, made, _ = pop_up(image, ['regions'])
        found = pixels(results(made)['regions'], "R'G'B' u8", np.uint8, 3)
        check((found == (255, 0, 255)).all(2).any(), 'a mask that is not applied hides nothing')
        image.delete()
    image = open_people(8)
    effect = Gimp.DrawableFilter.new(by_name(image, 'Scribbles'), 'gegl:invert-gamma', 'negative')
    by_name(image, 'Scribbles').append_filter(effect)
    _, made, _ = pop_up(image, ['regions'])
    found = pixels(results(made)['regions'], "R'G'B' float", np.float32, 3)
    check(np.abs(1 - found - reference('regions', 8)).max() <= 1.01 / 255, 'effects are seen')
    effect.set_visible(False)
    _, made, _ = pop_up(image, ['regions'])
    compare(made, 8, 'an effect that is switched off')
    image.delete()


def flat_colours_are_scribbles_by_themselves():
    image = open_people(8)
    for name in ('Scribbles', 'Arrows'):
        image.remove_layer(by_name(image, name))
    good, group, message = pop_up(image, ['regions'], flats=True)
    check(good and list(results(group)) == ['regions'], f'a finished colouring needs no scribbles {message}')
    image.delete()


def layers_can_be_named_by_a_script():
    image = open_people(32, ('one', 'two', 'three'))
    good, group, message = pop_up(image, ['depth'], drawing=by_name(image, 'one'), scribbles=by_name(image, 'two'),
                                  arrows=by_name(image, 'three'))
    check(good, f'layers of any name can be given {message}')
    compare(group, 32, 'layers given')
    Gimp.file_save(QUIET, image, file(OUT, 'plugin-kept.xcf'), None)
    image.delete()
    image = Gimp.file_load(QUIET, file(OUT, 'plugin-kept.xcf'))
    kept = bytes(image.get_parasite('celdepth-popup').get_data()).decode()
    two = by_name(image, 'two')
    check(f'scribbles={two.get_tattoo()}\n' in kept and 'depth=true\n' in kept and 'lit=false\n' in kept,
          'settings and layers are kept in the file')
    good, again, message = run('plug-in-celdepth-popup', image, Gimp.RunMode.WITH_LAST_VALS)
    check(good and list(results(again)) == ['depth'], f'and used again, without names {message}')
    image.delete()


def layers_found_by_name_are_found_again():
    image = open_people(32)
    pop_up(image, ['depth'])
    good, again, message = run('plug-in-celdepth-popup', image, Gimp.RunMode.WITH_LAST_VALS)
    check(good and list(results(again)) == ['depth'], f'a run by a script can be repeated by hand {message}')
    image.delete()


def presets_are_those_of_the_command():
    image = open_people(8)
    good, group, message = pop_up(image, ['lit'], preset='cel', ambient=0.4)
    check(good, f'a script can name a preset {message}')
    found = pixels(results(group)['lit'], "R'G'B' float", np.float32, 3)
    wanted = np.array(Image.open(os.path.join(OUT, 'cel-lit.png')).convert('RGB')) / 255
    difference = np.abs(found - wanted).max()
    check(difference <= ERRORS[8] + 1e-6, f'lit by a preset differs by {difference:.2e}')
    kept = bytes(image.get_parasite('celdepth-popup').get_data()).decode()
    check('light-model=toon\n' in kept and 'ambient=0.4' in kept, 'its settings are kept, and those that count more')
    good, group, message = pop_up(image, ['lit'], preset='paper')
    check(good and sorted(results(group)) == ['enhanced', 'lit'], f'Cut paper also makes what shows it {message}')
    image.delete()


def colour(rgb):
    return '#%02x%02x%02x' % tuple(rgb)


def layers_are_the_drawing_again():
    image = open_people(8)
    labels = np.array(Image.open(os.path.join(OUT, 'labels.png')).convert('RGB'))
    for complete in (False, True):
        good, group, message = run('plug-in-celdepth-split-into-layers', image, complete=complete)
        check(good, f'Split into layers runs {message}')
        names = ['#' + layer.get_name().split('#')[1][:6] for layer in group.get_children()]
        check(sorted(names) == sorted(set(map(colour, labels.reshape(-1, 3)))) and names[-1] == colour(labels[0, 0]),
              f'there is a layer for each part, the background last: {names}')
        seen = pixels(group, "R'G'B' float", np.float32, 3)
        wanted = np.array(Image.open(os.path.join(EXAMPLES, 'people', 'drawing.png')).convert('RGB')) / 255
        difference = np.abs(seen - wanted).max()
        check(difference <= 1 / 255 + 1e-6, f'layers over each other differ from the drawing by {difference:.2e}')
    alpha = [(pixels(layer, 'A float', np.float32, 1) > 0).sum() for layer in group.get_children()]
    other = next(layer for layer in image.get_layers() if layer.get_name() == 'Layers')
    check(other.get_id() != group.get_id(), 'another run makes another group')
    check(sum(alpha) > sum((pixels(layer, 'A float', np.float32, 1) > 0).sum() for layer in other.get_children()),
          'completed layers have what is hidden')
    image.delete()


def suggestions_are_arrows():
    image = open_people(8)
    good, layer, message = run('plug-in-celdepth-suggest-order', image)
    check(good and layer.get_name() == 'Suggested arrows', f'Suggest order runs {message}')
    arrows = by_name(image, 'Arrows')
    check(layer.get_parent().get_id() == arrows.get_parent().get_id() and
          image.get_item_position(layer) + 1 == image.get_item_position(arrows), 'suggestions lie above the arrows')
    wanted = np.array(Image.open(os.path.join(OUT, 'suggestions.png')).convert('RGBA')) / 255
    found = pixels(layer, "R'G'B'A float", np.float32, 4)
    check(np.abs((found - wanted) * (wanted[..., 3:] > 0)).max() <= 1 / 255 + 1e-6 and
          np.array_equal(found[..., 3] > 0, wanted[..., 3] > 0), 'they are those of the command')
    n = len(list(all_layers(image.get_layers())))
    run('plug-in-celdepth-suggest-order', image)
    check(len(list(all_layers(image.get_layers()))) == n, 'another run replaces the layer')
    image.remove_layer(by_name(image, 'Suggested arrows'))
    image.remove_layer(arrows)
    good, layer, _ = run('plug-in-celdepth-suggest-order', image)
    check(good and layer.get_name() == 'Arrows', 'without a layer of arrows it is that layer')
    good, _, message = pop_up(image, ['depth'])
    check(good, f'which Pop-up reads {message}')
    image.delete()


def results_are_not_the_drawing():
    image = open_people(8, ('ink on paper', 'Scribbles', 'Arrows'))
    names = [layer.get_name() for layer in all_layers(image.get_layers())]
    run('plug-in-celdepth-suggest-order', image)
    good, _, message = run('plug-in-celdepth-split-into-layers', image)
    check(good, f'beside suggested arrows the drawing needs no name {message}')
    good, group, message = pop_up(image, ['depth'])
    check(good, f'nor beside layers that were split {message}')
    image.insert_layer(results(group)['depth'].copy(), None, 0)
    good, _, message = run('plug-in-celdepth-set-up-layers', image)
    renamed = [layer.get_name() for layer in all_layers(image.get_layers())]
    check(good and names[-1] == 'ink on paper' and renamed[-1] == 'Drawing', f'nor beside a copy of depth {message}')
    image.delete()


def set_up_layers_makes_what_is_missing():
    image = Gimp.file_load(QUIET, file(EXAMPLES, 'people', 'drawing.png'))
    if image.get_base_type() == Gimp.ImageBaseType.RGB:
        image.convert_grayscale()
    good, _, message = run('plug-in-celdepth-set-up-layers', image)
    names = [layer.get_name() for layer in image.get_layers()]
    check(good and names == ['Arrows', 'Contours', 'Scribbles', 'Drawing'], f'layers are made: {names} {message}')
    check(image.get_base_type() == Gimp.ImageBaseType.RGB, 'a grey image gets colours')
    drawing = by_name(image, 'Drawing')
    check(drawing.get_lock_content() and drawing.get_lock_position(), 'the drawing is locked')
    check([layer.get_name() for layer in image.get_selected_layers()] == ['Scribbles'], 'Scribbles is selected')
    check(all(layer.get_width() == image.get_width() and layer.has_alpha() for layer in image.get_layers()[:3]),
          'the layers are transparent and have the size of the image')
    palette = Gimp.Palette.get_by_name('Cartoon Depth')
    colours = {tuple(c.get_rgba()) for c in palette.get_colors()}
    check(len(colours) == 24, 'there is a palette of 24 colours')
    check(Gimp.context_get_foreground().get_rgba()[:3] == (1, 0, 0), 'the first of them is the foreground')
    run('plug-in-celdepth-set-up-layers', image)
    check(len(image.get_layers()) == 4 and len(Gimp.Palette.get_by_name('Cartoon Depth').get_colors()) == 24,
          'a second time nothing is missing')
    drawing.set_lock_content(False)
    image.select_rectangle(Gimp.ChannelOps.REPLACE, 100, 50, 80, 90)
    Gimp.Selection.float(image, [drawing], 0, 0)
    image.remove_layer(by_name(image, 'Contours'))
    n = len(image.get_layers())
    good, _, message = run('plug-in-celdepth-set-up-layers', image)
    check(not good and 'There is a floating selection' in message and len(image.get_layers()) == n,
          f'refused: {message}')
    image.delete()


Gegl.init(None)
entries_of_the_menu_have_an_icon()
results_are_those_of_the_command()
a_second_run_updates_in_place()
locks_are_kept()
relations_are_those_of_the_image()
copies_are_the_artists()
input_without_sense_is_refused()
layers_are_read_as_they_are_seen()
flat_colours_are_scribbles_by_themselves()
layers_can_be_named_by_a_script()
layers_found_by_name_are_found_again()
presets_are_those_of_the_command()
layers_are_the_drawing_again()
suggestions_are_arrows()
results_are_not_the_drawing()
set_up_layers_makes_what_is_missing()
image = open_people(8, small=True)
Gimp.file_save(QUIET, image, file(OUT, 'plugin-people.xcf'), None)
image.scale(4 * image.get_width(), 4 * image.get_height())
Gimp.file_save(QUIET, image, file(OUT, 'plugin-large.xcf'), None)
