from dataclasses import replace

import changes
import numpy as np
import pytest
import shapes
from computed import normalized
from weak_convex_decomposition.core.solids.convexity import is_convex
from weak_convex_decomposition.core.solids.shells import find_shells
from weak_convex_decomposition.core.steps.progress import run


def convex(mesh):
    """Return whether a mesh is convex, once it is normalized."""
    mesh = normalized(mesh)
    return run(is_convex(mesh, run(find_shells(mesh))))


def dented(mesh, depth, row=0):
    """Return a mesh with one vertex moved towards the center by a share."""
    vertices = mesh.vertices.copy()
    middle = (mesh.bounds[0] + mesh.bounds[1]) / 2
    vertices[row] += depth * (middle - vertices[row])
    return replace(mesh, vertices=vertices)


def bent(n_slices, bow):
    """Return a square bar of length 1 along x, bowed along y."""
    bar = shapes.box((0, 0, 0), (1, 0.2, 0.2), n_slices)
    x, y, z = bar.vertices.T
    return replace(bar, vertices=np.stack([x, y + bow * np.sin(np.pi * x), z], axis=1))


@pytest.mark.parametrize(
    "mesh",
    [
        shapes.box(),
        shapes.box(high=(1, 1, 0.01), divisions=5),
        shapes.sphere(3),
        shapes.uv_sphere(),
        shapes.turned([0, 1, 0], [0, 0, 2], 16),
        changes.moved(shapes.box(divisions=3), 1e-3, offset=(5e-3, -2e-3, 1e-3)),
    ],
    ids=["box", "slab", "sphere", "rings", "cone", "away"],
)
@pytest.mark.parametrize("single", [False, True], ids=["double", "single"])
def test_convex_shapes_are_found(mesh, single):
    vertices = mesh.vertices.astype(np.float32) if single else mesh.vertices
    assert convex(replace(mesh, vertices=vertices))
    turned = changes.moved(mesh, rotation=changes.any_rotation(3)).vertices
    assert convex(replace(mesh, vertices=turned.astype(vertices.dtype)))


@pytest.mark.parametrize(
    "mesh",
    [
        shapes.l_prism(),
        shapes.cup(),
        shapes.open_box(),
        shapes.hollow_sphere(),
        shapes.joined(shapes.box(), shapes.box((2, 0, 0), (3, 1, 1))),
        shapes.joined(shapes.box(), shapes.box()),
        changes.inside_out(shapes.box()),
        shapes.voxels(np.eye(2)[:, :, None]),
        shapes.sheet(),
        bent(6, 0.2),
        bent(60, 0.01),
    ],
    ids=[
        "L",
        "cup",
        "open",
        "hollow",
        "two",
        "twice",
        "inside_out",
        "edge",
        "sheet",
        "bent",
        "slightly",
    ],
)
def test_others_are_not_convex(mesh):
    assert not convex(mesh)


@pytest.mark.parametrize("depth", [1e-5, 1e-3, 0.5])
def test_a_small_dent_is_seen(depth):
    ball = shapes.sphere(3)
    assert not convex(dented(ball, 0.02 + depth))
    box = shapes.box(divisions=4)
    middle = int(np.abs(box.vertices - (0.5, 0.5, 1)).sum(axis=1).argmin())
    assert not convex(dented(box, depth, middle))


def prism(outline, height=1.0):
    """Return a polygon of the plane, counter-clockwise, as a solid along z."""
    n = len(outline)
    vertices = [(*corner, z) for z in (0, height) for corner in outline]
    walls = [(i, (i + 1) % n, (i + 1) % n + n, i + n) for i in range(n)]
    return shapes.mesh_of(vertices, [range(n - 1, -1, -1), range(n, 2 * n), *walls])


def bowed(depth, bow, n=1000):
    """Return a block of length 1 and some depth whose front is bowed in, finely."""
    x = np.linspace(0, 1, n + 1)
    front = np.stack([x, bow * np.sin(np.pi * x)], axis=1)
    vertices = np.concatenate([front, [(1, depth), (0, depth)]])
    block = [(*corner, z) for z in (0, 1) for corner in vertices]
    m = len(vertices)
    walls = [(i, (i + 1) % m, (i + 1) % m + m, i + m) for i in range(m)]
    fans = [(n + 2, i + 1, i) for i in range(n + 1)]
    lids = [(m + a, m + c, m + b) for a, b, c in fans]
    return shapes.mesh_of(block, [*walls, *fans, *lids])


def test_many_edges_that_are_flat_but_for_rounding_may_be_a_bow():
    """Its volume tells."""
    assert not convex(bowed(0.1, 0.002))
    assert convex(bowed(0.1, 0.0))
    assert convex(bowed(0.1, -0.002))


@pytest.mark.parametrize(("depth", "flat"), [(3e-5, False), (3e-6, True)])
def test_a_shallow_dish_in_a_deep_block_is_seen(depth, flat):
    """Only its vertices tell, which lie below the hull."""
    block = shapes.box(high=(1, 10, 1), divisions=8)
    x, y, z = block.vertices.T
    sunk = (y == 0) * depth * np.sin(np.pi * x) * np.sin(np.pi * z)
    dish = replace(block, vertices=np.stack([x, y + sunk, z], axis=1))
    assert convex(dish) == flat


def test_a_saw_cut_is_seen():
    """Its vertices lie on the hull, and it has nearly no volume."""
    notch = [(0.5 + 4e-6, 1), (0.5, 0.5), (0.5 - 4e-6, 1)]
    assert not convex(prism([(0, 0), (1, 0), (1, 1), *notch, (0, 1)]))
    assert convex(prism([(0, 0), (1, 0), (1, 1), (0.5, 1), (0, 1)]))


def test_a_surface_that_goes_around_twice_is_not_convex():
    """A star's outline turned around: every edge is convex, and it crosses itself."""
    turns = 2 * np.pi * 2 * np.arange(5) / 5
    outline = np.stack([np.cos(turns), np.sin(turns)], axis=1)
    vertices = [(*p, z) for z in (0, 1) for p in outline]
    top, bottom = (0, 0, 1.5), (0, 0, -0.5)
    walls = [(i, (i + 1) % 5, (i + 1) % 5 + 5, i + 5) for i in range(5)]
    roofs = [(10, i + 5, (i + 1) % 5 + 5) for i in range(5)]
    floors = [(11, (i + 1) % 5, i) for i in range(5)]
    star = shapes.mesh_of([*vertices, top, bottom], [*walls, *roofs, *floors])
    assert not convex(star)
