"""Solids of a few blocks, whose best hulls are known."""

from dataclasses import replace

import numpy as np
import pytest
import shapes
from computed import build_hulls
from scipy.spatial.transform import Rotation
from weak_convex_decomposition.core.hulls.cutting import close_pieces
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.steps.progress import Progress


@pytest.mark.parametrize(
    ("make", "fewest"),
    [
        (shapes.l_shape, 2),
        (lambda: shapes.l_prism(3.0), 2),
        (shapes.u_shape, 3),
        (shapes.plus, 3),
        (shapes.dumbbell, 3),
        (shapes.table, 5),
        (shapes.comb, 5),
    ],
    ids=["L", "L prism", "U", "plus", "dumbbell", "table", "comb"],
)
@pytest.mark.parametrize("max_error", [0.05, 0.01, 0.002])
def test_blocks_get_no_more_hulls_than_they_need(make, fewest, max_error):
    found = build_hulls(make(), HullParameters(max_error=max_error))
    assert found.n_hulls == fewest
    assert found.errors.max() <= max_error
    assert found.volume_ratio == pytest.approx(1, abs=0.005)


@pytest.mark.parametrize(("n_steps", "rise", "most"), [(10, 1, 13), (12, 2, 12)])
def test_stairs_are_cut_into_steps(n_steps, rise, most):
    """Thin slices of stairs seemed closer than steps: these got 32 and 26 hulls."""
    steps = [((k, k + 1), (0, 4), (0, rise * k + rise)) for k in range(n_steps)]
    mesh = shapes.blocks((n_steps, 4, rise * n_steps), *steps)
    found = build_hulls(mesh, HullParameters())
    assert found.n_hulls <= most
    assert found.errors.max() <= 0.05


@pytest.mark.parametrize("turn", [[0.3, -0.8, 0.5], [1.1, 0.2, -0.4]])
@pytest.mark.parametrize("kind", ["HULL", "BOX"])
@pytest.mark.parametrize(
    ("make", "fewest"),
    [
        (shapes.l_shape, 2),
        (shapes.u_shape, 3),
        (shapes.plus, 3),
        (shapes.dumbbell, 3),
    ],
    ids=["L", "U", "plus", "dumbbell"],
)
def test_how_blocks_are_turned_does_not_matter(make, fewest, kind, turn):
    mesh = make()
    turned = Rotation.from_rotvec(turn).apply(mesh.vertices)
    found = build_hulls(replace(mesh, vertices=turned), HullParameters(shape=kind))
    assert found.n_hulls == fewest
    assert found.volume_ratio == pytest.approx(1, abs=0.005)


@pytest.mark.parametrize("turn", [1, 4, 5])
def test_rounding_of_turned_blocks_does_not_matter(turn):
    outline = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)]
    vertices = np.array([(x, y, z) for z in (0, 1) for x, y in outline])
    turned = Rotation.random(random_state=turn).apply(vertices).astype(np.float32)
    sides = [(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6)]
    mesh = shapes.mesh_of(
        turned.astype(float), [(0, 5, 4, 3, 2, 1), range(6, 12), *sides]
    )
    assert build_hulls(mesh, HullParameters(max_error=0.002)).n_hulls == 2


@pytest.mark.parametrize("noise", [0, 1e-15])
def test_rounding_of_faces_on_evenly_spaced_planes_does_not_matter(noise):
    # Two tetrahedra; the plane between them is four fifths of the way along its normal.
    corners = np.array([(0, 0, 0), (5, 1, 0), (0, 2, 0), (1, 1, 0), (0, 1, 3)], float)
    corners += noise * np.random.default_rng(1).standard_normal((5, 3))
    faces = [(0, 3, 1), (1, 3, 2), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
    found = build_hulls(shapes.mesh_of(corners, faces), HullParameters())
    assert found.n_hulls == 2


def test_faces_halfway_are_cut_along():
    stem, bar = ((1, 2), (0, 1), (0, 2)), ((0, 4), (0, 1), (2, 4))
    t_shape = shapes.blocks((4, 1, 4), stem, bar)
    assert build_hulls(t_shape, HullParameters(shape="BOX")).n_hulls == 2


@pytest.mark.parametrize("stretch", [1, 2, 4, 7])
def test_boxes_are_exact_where_walls_are_flush_with_them(stretch):
    mesh = shapes.l_shape()
    mesh = replace(mesh, vertices=mesh.vertices * [1, stretch, 1])
    found = build_hulls(mesh, HullParameters(shape="BOX"))
    assert found.n_hulls == 2
    assert found.errors.max() < 0.03


def test_where_no_cut_is_found_the_note_says_so(monkeypatch):
    def no_cut(cell):
        yield Progress("Cutting", 0.0)

    monkeypatch.setattr(close_pieces, "best_cut", no_cut)
    found = build_hulls(shapes.chair(), HullParameters())
    assert found.n_hulls == 1
    (note,) = found.notes
    assert note.endswith(
        "Largest Error = 0.05, and no cuts into at most Most Hulls = 32 were found"
        " that make it smaller."
    )


def test_a_face_without_area_in_the_air_is_no_obstacle():
    far = [[9.0, 0, 0], [10, 0, 0], [11, 0, 0]]
    mesh = shapes.joined(shapes.l_prism(3.0), shapes.mesh_of(far, [(0, 1, 2)]))
    assert build_hulls(mesh, HullParameters()).n_hulls >= 2


def test_cuts_leave_no_films_on_faces():
    """Films of the plate, where it meets the wall, once were boxes of their own."""
    turns = np.arange(24) * np.pi / 12
    hole = 0.25 * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    rim = hole / np.abs(hole).max(axis=1, keepdims=True)
    rings = [(hole, 0), (rim, 0), (rim, 0.3), (hole, 0.3)]
    vertices = [(x, y, z) for ring, z in rings for x, y in ring]
    faces = [
        (k + 24 * i, k + 24 * j, (k + 1) % 24 + 24 * j, (k + 1) % 24 + 24 * i)
        for i, j in ((0, 1), (1, 2), (2, 3), (3, 0))
        for k in range(24)
    ]
    plate = shapes.mesh_of(vertices, faces)
    mesh = shapes.joined(plate, shapes.box((-1, -1, 0.3), (-0.7, 1, 3)))
    found = build_hulls(mesh, HullParameters(shape="BOX"))
    assert min(shape.sizes.min() for shape in found.shapes) > 0.01
    assert found.n_hulls < 13
    assert found.errors.max() <= 0.05
