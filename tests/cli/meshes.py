"""Readers of meshes by the specifications of their formats: glTF 2.0, PLY, OBJ, STL.

Each gives places (n x 3), triangles (n x 3, numbers of vertices) and a dictionary of what else there is: glTF and OBJ
have `parts`, pairs of the name and the triangles of each mesh.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import io
import json
import os
import struct

import numpy as np
from PIL import Image


def read_gltf(path):
    with open(path, 'rb') as file:
        data = file.read()
    magic, version, length, size, kind = struct.unpack('<4sIII4s', data[:20])
    assert (magic, version, length, kind) == (b'glTF', 2, len(data), b'JSON')
    scene = json.loads(data[20:20 + size])
    size, kind = struct.unpack('<I4s', data[20 + size:28 + size])
    assert kind == b'BIN\0'
    numbers = data[len(data) - size:]

    def view(index):
        about = scene['bufferViews'][index]
        start = about.get('byteOffset', 0)
        return numbers[start:start + about['byteLength']]

    def accessor(index):
        about = scene['accessors'][index]
        kind = {5126: '<f4', 5125: '<u4'}[about['componentType']]
        columns = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3}[about['type']]
        numbers = np.frombuffer(view(about['bufferView']), kind, about['count'] * columns, about.get('byteOffset', 0))
        return numbers.reshape(about['count'], columns)

    parts, first = [], 0
    values = {'POSITION': [], 'NORMAL': [], 'TEXCOORD_0': []}
    triangles = []
    for number in scene['scenes'][scene['scene']]['nodes']:
        node = scene['nodes'][number]
        part, = scene['meshes'][node['mesh']]['primitives']
        for name, index in part['attributes'].items():
            values[name].append(accessor(index))
        triangles.append(accessor(part['indices']).reshape(-1, 3) + first)
        parts.append((node['name'], triangles[-1]))
        first += len(values['POSITION'][-1])
    places, normals, art = (np.concatenate(values[name]) for name in ('POSITION', 'NORMAL', 'TEXCOORD_0'))
    other = {'normals': normals, 'art': art, 'scene': scene, 'parts': parts}
    if 'images' in scene:
        other['texture'] = np.array(Image.open(io.BytesIO(view(scene['images'][0]['bufferView']))))
    return places, np.concatenate(triangles), other


def read_ply(path):
    with open(path, 'rb') as file:
        data = file.read()
    header, body = data.split(b'end_header\n', 1)
    lines = [line.split() for line in header.decode().splitlines()]
    assert lines[:2] == [['ply'], ['format', 'binary_little_endian', '1.0']]
    count = {line[1]: int(line[2]) for line in lines if line[0] == 'element'}
    vertex = np.dtype([(name, {'float': '<f4', 'uchar': 'u1'}[kind])
                       for word, kind, name in (line for line in lines if line[0] == 'property' and line[1] != 'list')])
    face = np.dtype([('n', 'u1'), ('vertex', '<i4', 3)])
    vertices = np.frombuffer(body, vertex, count['vertex'])
    faces = np.frombuffer(body, face, count['face'], count['vertex'] * vertex.itemsize)
    assert len(body) == vertices.nbytes + faces.nbytes and (faces['n'] == 3).all()

    def columns(*names):
        return np.stack([vertices[name] for name in names], 1)

    return columns('x', 'y', 'z'), faces['vertex'], {'normals': columns('nx', 'ny', 'nz'), 'art': columns('s', 't'),
                                                    'colours': columns('red', 'green', 'blue')}


def lines_of(path):
    with open(path) as file:
        return file.read().splitlines()


def read_obj(path):
    rows = {'v': [], 'vt': [], 'vn': [], 'f': []}
    names, begins = {}, []
    for text in lines_of(path):
        word, *values = text.split()
        if word in rows:
            rows[word].append(values)
        elif word == 'o':
            begins.append((values[0], len(rows['f'])))
        else:
            names[word] = ' '.join(values)
    corners = np.array([[corner.split('/') for corner in face] for face in rows['f']]).astype(int) - 1
    assert (corners == corners[:, :, :1]).all()
    material = dict(text.split(None, 1) for text in lines_of(os.path.join(os.path.dirname(path), names['mtllib'])))
    ends = [begin for _, begin in begins[1:]] + [len(rows['f'])]
    return np.array(rows['v'], float), corners[:, :, 0], {
        'parts': [(name, corners[begin:end, :, 0]) for (name, begin), end in zip(begins, ends)],
        'normals': np.array(rows['vn'], float), 'art': np.array(rows['vt'], float),
        'texture': np.array(Image.open(os.path.join(os.path.dirname(path), material['map_Kd'])))}


def read_stl(path):
    """Joins vertices at the same place, since the format has no indices."""
    with open(path, 'rb') as file:
        data = file.read()
    assert not data.startswith(b'solid')
    facets = np.frombuffer(data, np.dtype([('normal', '<f4', 3), ('place', '<f4', (3, 3)), ('attribute', '<u2')]),
                           offset=84)
    assert struct.unpack('<I', data[80:84]) == (len(facets),)
    places, number = np.unique(facets['place'].reshape(-1, 3), axis=0, return_inverse=True)
    return places, number.reshape(-1, 3), {'facets': facets['normal']}


READERS = {'.glb': read_gltf, '.ply': read_ply, '.obj': read_obj, '.stl': read_stl}


def read_mesh(path):
    return READERS[os.path.splitext(path)[1]](path)


def is_closed(triangles):
    """Whether each edge belongs to two triangles, in opposite directions."""
    ways = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).astype(np.int64)
    size = ways.max() + 1
    there, back = ways[:, 0] * size + ways[:, 1], ways[:, 1] * size + ways[:, 0]
    return (ways[:, 0] != ways[:, 1]).all() and len(np.unique(there)) == len(there) and np.isin(there, back).all()


def volume(places, triangles):
    corners = places[triangles].astype(float)
    return np.einsum('ij,ij->i', corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
