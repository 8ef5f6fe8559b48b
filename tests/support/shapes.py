"""Shapes for tests, made without Blender: all closed and facing out unless said."""

from dataclasses import replace
from itertools import pairwise

import changes
import numpy as np
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh


def mesh_of(vertices, faces):
    """Return the mesh of polygons given as corner lists, fanned into triangles."""
    triangles, polygons = [], []
    for number, face in enumerate(faces):
        for second, third in pairwise(face[1:]):
            triangles.append((face[0], second, third))
            polygons.append(number)
    return TriangleMesh(np.asarray(vertices, dtype=float), triangles, polygons)


def joined(*meshes):
    """Return several meshes as one, each a shell of its own."""
    vertices = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    polygons = np.cumsum([0, *(mesh.n_polygons for mesh in meshes)])
    return TriangleMesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate(
            [m.triangles + n for m, n in zip(meshes, vertices, strict=False)]
        ),
        np.concatenate(
            [m.polygons + n for m, n in zip(meshes, polygons, strict=False)]
        ),
    )


def voxels(full, size=1.0):
    """Return the surface of the full cells of a boolean grid (X, Y, Z), in quads."""
    full = np.pad(np.asarray(full, dtype=bool), 1)
    quads = []
    for axis in range(3):
        step = np.eye(3, dtype=int)[axis]
        u, v = np.roll(step, 1), np.roll(step, 2)
        ahead = np.roll(full, -1, axis=axis)
        for cell in np.argwhere(full & ~ahead) + step:
            quads.append([cell, cell + u, cell + u + v, cell + v])
        for cell in np.argwhere(~full & ahead) + step:
            quads.append([cell, cell + v, cell + u + v, cell + u])
    corners = np.reshape(quads, (-1, 3))
    places, numbers = np.unique(corners, axis=0, return_inverse=True)
    return mesh_of((places - 1) * size, numbers.reshape(-1, 4))


def blocks(shape, *ranges):
    """Return the voxels of a grid that lie in any of the boxes ((x, X), (y, Y), …)."""
    full = np.zeros(shape, dtype=bool)
    for box_ranges in ranges:
        full[tuple(slice(low, high) for low, high in box_ranges)] = True
    return voxels(full)


def l_shape():
    """Return two arms of 7 × 2 × 2 that share a corner at the origin."""
    return blocks((7, 7, 2), ((0, 7), (0, 2), (0, 2)), ((0, 2), (0, 7), (0, 2)))


def u_shape():
    """Return a base along x with a leg up y at each end."""
    return blocks(
        (8, 6, 2),
        ((0, 8), (0, 2), (0, 2)),
        ((0, 2), (0, 6), (0, 2)),
        ((6, 8), (0, 6), (0, 2)),
    )


def plus():
    """Return two bars that cross at (4, 4)."""
    return blocks((8, 8, 2), ((0, 8), (3, 5), (0, 2)), ((3, 5), (0, 8), (0, 2)))


def dumbbell():
    """Return cubes at x < 3 and x > 6 with a thin bar between them."""
    return blocks(
        (9, 3, 3),
        ((0, 3), (0, 3), (0, 3)),
        ((6, 9), (0, 3), (0, 3)),
        ((3, 6), (1, 2), (1, 2)),
    )


def table():
    """Return a top at z > 3 on four legs in the corners."""
    legs = [((x, x + 1), (y, y + 1), (0, 3)) for x in (0, 4) for y in (0, 3)]
    return blocks((5, 4, 4), ((0, 5), (0, 4), (3, 4)), *legs)


def chair():
    """Return a seat at 4 < z < 5 on four legs, and a back above y = 5."""
    legs = [((x, x + 1), (y, y + 1), (0, 4)) for x in (0, 5) for y in (0, 5)]
    seat, back = ((0, 6), (0, 6), (4, 5)), ((0, 6), (5, 6), (5, 10))
    return blocks((6, 6, 10), seat, back, *legs)


def comb():
    """Return a palm at y < 3 with four fingers along y, like a hand."""
    fingers = [((x, x + 1), (3, 8), (0, 1)) for x in (0, 2, 4, 6)]
    return blocks((7, 8, 1), ((0, 7), (0, 3), (0, 1)), *fingers)


# Boxes and sheets.


def box(low=(0, 0, 0), high=(1, 1, 1), divisions=1):
    """Return a box of quads, each side divided as often as asked."""
    low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    unit = voxels(np.ones((divisions,) * 3))
    return replace(unit, vertices=low + unit.vertices / divisions * (high - low))


def l_prism(arm=4.0):
    """Return an L of 20 triangles: two hexagons and six quads."""
    outline = [(1, 1), (1, arm), (0, arm), (0, 0), (arm, 0), (arm, 1)]
    vertices = [(x, y, z) for z in (0, 1) for x, y in outline]
    sides = [(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6)]
    return mesh_of(vertices, [range(6, 12), (0, 5, 4, 3, 2, 1), *sides])


def sheet(divisions=6):
    """Return a unit square at z = 0 with a front alone: open and without thickness."""
    i, j = np.mgrid[: divisions + 1, : divisions + 1]
    vertices = np.stack([i, j, 0 * i], axis=-1).reshape(-1, 3) / divisions
    n = divisions + 1
    faces = [
        (a * n + b, (a + 1) * n + b, (a + 1) * n + b + 1, a * n + b + 1)
        for a in range(divisions)
        for b in range(divisions)
    ]
    return mesh_of(vertices, faces)


def open_box(divisions=4):
    """Return a unit box without its top: a surface with a hole."""
    return changes.without(
        box(divisions=divisions), lambda centers: centers[:, 2] > 1 - 1e-6
    )


# Spheres.


def cup(wall=0.1):
    """Return an open cup of 1 × 1 × 1, walls and bottom of one thickness, in quads."""
    ring = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    inner = wall + (1 - 2 * wall) * ring
    levels = ((ring, 0), (ring, 1), (inner, 1), (inner, wall))
    vertices = [(*corner, z) for corners, z in levels for corner in corners]
    faces = [(3, 2, 1, 0), (12, 13, 14, 15)]
    for low in (0, 4, 8):
        faces += [
            (low + i, low + j, low + 4 + j, low + 4 + i)
            for i, j in ((0, 1), (1, 2), (2, 3), (3, 0))
        ]
    return mesh_of(vertices, faces)


def turned(radii, heights, around=32):
    """Return what a line from the z axis back to it sweeps, the inside on its left."""
    turns = 2 * np.pi * np.arange(around) / around
    rows = [
        (r * np.cos(turn), r * np.sin(turn), z)
        for r, z in zip(radii[1:-1], heights[1:-1], strict=True)
        for turn in turns
    ]
    ends = [(0, 0, heights[0]), (0, 0, heights[-1])]
    faces = []
    for s in range(around):
        t = (s + 1) % around
        last = len(rows) - around
        faces += [(len(rows), t, s), (len(rows) + 1, last + s, last + t)]
        faces += [
            (low + s, low + t, low + around + t, low + around + s)
            for low in range(0, last, around)
        ]
    return mesh_of([*rows, *ends], faces)


def bowl(wall=0.08):
    """Return half a hollow ball of radius 1, open above; its floor is at `wall`."""
    out, back = np.linspace(0, np.pi / 2, 9), np.linspace(np.pi / 2, 0, 9)
    radii = [*np.sin(out), *(1 - wall) * np.sin(back)]
    return turned(radii, [*1 - np.cos(out), *1 - (1 - wall) * np.cos(back)])


def mug(wall=0.12):
    """Return a mug of radius and height 1 and 2, its handle at x > 1."""
    inner = 1 - wall
    body = turned([0, 1, 1, inner, inner, 0], [0, 0, 2, 2, wall, wall])
    bars = [
        box((0.95, -0.1, 0.4), (1.5, 0.1, 0.6)),
        box((0.95, -0.1, 1.4), (1.5, 0.1, 1.6)),
        box((1.4, -0.1, 0.4), (1.6, 0.1, 1.6)),
    ]
    return joined(body, *bars)


def sphere(subdivisions=2, radius=1.0, center=(0, 0, 0)):
    """Return an icosahedron, each face halved and pushed out so often."""
    golden = (1 + np.sqrt(5)) / 2
    corners = [(0, a, b * golden) for a in (-1, 1) for b in (-1, 1)]
    corners = np.array([np.roll(c, turn) for turn in range(3) for c in corners])
    nearest = np.sort(np.linalg.norm(corners[:, None] - corners, axis=2), axis=1)
    near = np.linalg.norm(corners[:, None] - corners, axis=2) < nearest[0, 1] * 1.01
    faces = [
        (i, j, k) if np.linalg.det(corners[[i, j, k]]) > 0 else (i, k, j)
        for i in range(12)
        for j in range(i + 1, 12)
        for k in range(j + 1, 12)
        if near[i, j] and near[j, k] and near[i, k]
    ]
    mesh = mesh_of(corners, faces)
    for _ in range(subdivisions):
        mesh = changes.refined(mesh)
        mesh = replace(mesh, polygons=np.arange(len(mesh.triangles)))
    unit = mesh.vertices / np.linalg.norm(mesh.vertices, axis=1, keepdims=True)
    return replace(mesh, vertices=np.asarray(center) + radius * unit)


def uv_sphere(n_rings=8, n_segments=12):
    """Return a unit sphere of quads between two fans of triangles."""
    polar = np.arange(1, n_rings) * np.pi / n_rings
    around = np.arange(n_segments) * 2 * np.pi / n_segments
    p, a = np.meshgrid(polar, around, indexing="ij")
    rows = np.stack([np.sin(p) * np.cos(a), np.sin(p) * np.sin(a), np.cos(p)], axis=-1)
    vertices = np.concatenate([rows.reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]])
    north, south = len(vertices) - 2, len(vertices) - 1
    last = (n_rings - 2) * n_segments
    faces = []
    for s in range(n_segments):
        t = (s + 1) % n_segments
        faces += [(north, s, t), (south, last + t, last + s)]
        for upper in range(0, last, n_segments):
            lower = upper + n_segments
            faces.append((upper + s, lower + s, lower + t, upper + t))
    return mesh_of(vertices, faces)


def hollow_sphere(inner=0.5, subdivisions=2):
    """Return a unit sphere around a cavity of radius `inner`."""
    return joined(sphere(subdivisions), changes.inside_out(sphere(subdivisions, inner)))
