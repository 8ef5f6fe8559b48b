"""Shells of solids that touch, in each way that files hold them."""

from dataclasses import replace
from types import SimpleNamespace

import changes
import numpy as np
import pytest
import shapes
from computed import decompose, prepare, shells_of
from weak_convex_decomposition import Parameters, TriangleMesh
from weak_convex_decomposition.core.solids import shells


def merged(mesh):
    """Return the mesh with one vertex for each place, as after Merge by Distance."""
    vertices, rows = np.unique(np.round(mesh.vertices, 9), axis=0, return_inverse=True)
    return replace(mesh, vertices=vertices, triangles=rows.reshape(-1)[mesh.triangles])


def brick(x, z, divisions=2):
    return shapes.box((x, 0, z), (x + 1, 1, z + 1), divisions)


LAYOUTS = {"joined": lambda mesh: mesh, "merged": merged, "split": changes.split}
TOUCHING = {
    "tower": [(0, 0), (0, 1), (0, 2)],
    "wall": [(x, z) for x in range(3) for z in range(3)],
    "edge": [(0, 0), (1, 1)],
    "checks": [(x, z) for x in range(3) for z in range(3) if (x + z) % 2],
}


def assert_one_shell_each(mesh, n_solids):
    """Check that the solids, which have equal numbers of triangles, are the shells."""
    shells = shells_of(mesh)
    owners = np.arange(len(mesh.triangles)) // (len(mesh.triangles) // n_solids)
    assert (shells.of_triangle == owners).all()
    assert shells.closed.tolist() == [True] * n_solids


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("name", TOUCHING)
def test_solids_that_touch_are_shells_of_their_own(name, layout):
    solids = [brick(*place) for place in TOUCHING[name]]
    assert_one_shell_each(LAYOUTS[layout](shapes.joined(*solids)), len(solids))


@pytest.mark.parametrize("layout", LAYOUTS)
def test_they_are_also_if_all_faces_point_inwards(layout):
    wall = changes.inside_out(shapes.joined(*(brick(*p) for p in TOUCHING["wall"])))
    assert_one_shell_each(LAYOUTS[layout](wall), 9)
    assert "inside out" in prepare(LAYOUTS[layout](wall)).notes[0]


def test_joined_objects_stay_apart_if_one_is_inside_out():
    """The wall between them has two triangles of one winding at each place."""
    pair = shapes.joined(brick(0, 0), changes.inside_out(brick(0, 1)))
    assert_one_shell_each(pair, 2)


def test_the_layout_of_vertices_does_not_matter():
    """Two crossing bars, and a block that is flush with one and makes it longer."""
    scene = shapes.joined(
        shapes.box((0, 3, 0), (8, 5, 2), 4),
        shapes.box((3, 0, 0.1), (5, 8, 1.9), 4),
        shapes.box((8, 3, 0), (9, 5, 2), 4),
    )
    usual = decompose(scene, Parameters())
    for layout in (merged, changes.split):
        found = decompose(layout(scene), Parameters())
        assert found.n_parts == usual.n_parts == 2
        assert (found.labels == usual.labels).mean() > 0.98
        assert found.psi_before == pytest.approx(usual.psi_before, abs=0.02)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_shells_are_set_apart_as_a_whole(layout):
    """Each brick keeps its shape, and no two are at the same place."""
    wall = LAYOUTS[layout](shapes.joined(*(brick(*p) for p in TOUCHING["tower"])))
    targets = prepare(wall).targets
    assert len(targets.vertices) == 3 * len(np.unique(brick(0, 0).vertices, axis=0))
    sizes = [
        np.ptp(targets.vertices[np.unique(rows)], axis=0)
        for rows in np.split(targets.triangles, 3)
    ]
    sides = np.sort([size[0] for size in sizes]) * wall.diagonal
    assert sides == pytest.approx(1.0, abs=1e-3)
    assert np.unique(np.round(sides, 6)).size == 3
    assert sizes[0] == pytest.approx(sizes[0][0])


def test_a_wall_inside_a_box_belongs_to_neither_half():
    """Edges of three triangles have no pairs: which half is the solid?"""
    box = shapes.box(divisions=2)
    wall = [(0, 0, 0.5), (1, 0, 0.5), (1, 1, 0.5), (0, 1, 0.5), (0.5, 0.5, 0.5)]
    wall += [(0.5, 0, 0.5), (1, 0.5, 0.5), (0.5, 1, 0.5), (0, 0.5, 0.5)]
    around = [0, 5, 1, 6, 2, 7, 3, 8]
    faces = [(4, one, around[i - 7]) for i, one in enumerate(around)]
    shells = shells_of(merged(shapes.joined(box, shapes.mesh_of(wall, faces))))
    assert len(shells.closed) == 3
    assert not shells.closed.any()


def test_a_book_of_many_pages_takes_no_pairs():
    """Forty triangles that share an edge, and nothing more."""
    angles = np.arange(40) * np.pi / 20
    ends = np.stack([np.cos(angles), np.sin(angles), np.full(40, 0.5)], axis=1)
    vertices = np.concatenate([[(0, 0, 0), (0, 0, 1)], ends])
    pages = np.stack([np.zeros(40), np.ones(40), 2 + np.arange(40)], axis=1)
    pages[::2, :2] = 1, 0
    shells = shells_of(TriangleMesh(vertices, pages.astype(int), np.arange(40)))
    assert len(shells.closed) == 40


def with_loose(mesh, count):
    """Return the mesh with vertices of no triangle before, within and after its own."""
    loose = 100.0 + np.arange(3.0 * count).reshape(count, 3)
    middle = len(mesh.vertices) // 2
    parts = (
        loose,
        mesh.vertices[:middle],
        loose + 1,
        mesh.vertices[middle:],
        loose + 2,
    )
    rows = mesh.triangles + np.where(mesh.triangles < middle, count, 2 * count)
    return replace(mesh, vertices=np.concatenate(parts), triangles=rows)


def test_loose_vertices_change_nothing(monkeypatch):
    """Memory that nothing was written to must not count: here it is nonsense."""
    mesh = shapes.joined(*(brick(2 * x, 0) for x in range(3)))
    expected = prepare(mesh).targets

    def nonsense(shape, dtype=float):
        return np.full(shape, -(2**62) if np.issubdtype(dtype, np.integer) else np.nan)

    monkeypatch.setattr(
        shells, "np", SimpleNamespace(**{**vars(np), "empty": nonsense})
    )
    found = prepare(with_loose(mesh, 200)).targets
    assert (found.triangles == expected.triangles).all()
    assert (found.vertices == expected.vertices).all()
