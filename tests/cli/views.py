"""Pictures of meshes from any side, by a z-buffer of points: triangles are filled so densely that no pixel is left out.

SPDX-License-Identifier: LGPL-3.0-or-later
"""
import numpy as np

DENSITY = 1.6  # points a pixel along the longest side of a triangle


def turned(places, degrees):
    """Turned round the upright axis, as if the viewer went to the right."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return places @ np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]]).T


def points_of(triangles, x, y):
    """Numbers of triangles, and shares of their three corners, of points that fill them."""
    corner = np.stack([x, y], 1)[triangles]
    longest = np.linalg.norm(corner - np.roll(corner, 1, 1), axis=2).max(1)
    steps = np.maximum(1, np.ceil(DENSITY * longest).astype(int))
    for n in np.unique(steps):
        i, j = (v.ravel() for v in np.mgrid[:n + 1, :n + 1])
        share = np.stack([i, j, n - i - j], 1)[i + j <= n] / n
        for which in np.array_split(np.flatnonzero(steps == n), 1 + (steps == n).sum() * len(share) // 2000000):
            yield np.repeat(which, len(share)), np.tile(share, (len(which), 1))


class View:
    """What an orthographic camera sees of a model; (0,0) of the places is in the middle of the picture.

    nearest   distance in front of the middle of each pixel, -inf where nothing is
    part      number of the part that is seen there; -1 for none
    art       its place in the texture
    """

    def __init__(self, places, parts, art, degrees, width, height, pixel):
        turn = turned(places, degrees)
        x, y, z = width / 2 + turn[:, 0] / pixel, height / 2 - turn[:, 1] / pixel, turn[:, 2] / pixel
        self.nearest = np.full(width * height, -np.inf)
        self.part = np.full(width * height, -1)
        self.art = np.zeros((width * height, 2))
        for number, (_, triangles) in enumerate(parts):
            for which, share in points_of(triangles, x, y):
                corner = triangles[which]
                column, row = (np.floor((share * v[corner]).sum(1)).astype(int) for v in (x, y))
                depth = (share * z[corner]).sum(1)
                seen = (column >= 0) & (row >= 0) & (column < width) & (row < height)
                pixels, depth, share, corner = (row * width + column)[seen], depth[seen], share[seen], corner[seen]
                order = np.lexsort((-depth, pixels))
                order = order[np.unique(pixels[order], return_index=True)[1]]
                order = order[depth[order] > self.nearest[pixels[order]]]
                place = pixels[order]
                self.nearest[place], self.part[place] = depth[order], number
                self.art[place] = np.einsum('ij,ijk->ik', share[order], art[corner[order]])
        for name in ('nearest', 'part', 'art'):
            setattr(self, name, getattr(self, name).reshape((height, width) + getattr(self, name).shape[1:]))

    def colours(self, texture):
        """The texture at each pixel."""
        x, y = ((self.art[:, :, k] * texture.shape[1 - k] - 0.5).clip(0, texture.shape[1 - k] - 1) for k in (0, 1))
        left, top = x.astype(int), y.astype(int)
        right, below = np.minimum(left + 1, texture.shape[1] - 1), np.minimum(top + 1, texture.shape[0] - 1)
        across, down = (x - left)[..., None], (y - top)[..., None]
        return ((1 - down) * ((1 - across) * texture[top, left] + across * texture[top, right]) +
                down * ((1 - across) * texture[below, left] + across * texture[below, right]))


def edges_of(triangles):
    """The edges of triangles that no other triangle shares, as pairs of vertices, in the triangles' direction."""
    ways = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).astype(np.int64)
    size = ways.max() + 1
    return ways[~np.isin(ways[:, 0] * size + ways[:, 1], ways[:, 1] * size + ways[:, 0])]


def loops_of(edges):
    """The number of closed loops that these edges make."""
    after, left = dict(edges.tolist()), set(edges[:, 0].tolist())
    loops = 0
    while left:
        loops += 1
        vertex = next(iter(left))
        while vertex in left:
            left.remove(vertex)
            vertex = after[vertex]
    return loops
