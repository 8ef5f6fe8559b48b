"""Mirror planes of shapes, and parts that are alike on both sides of them."""

import numpy as np
import pytest
import shapes
from computed import decompose, graph_of, normalized
from scipy.spatial.transform import Rotation
from weak_convex_decomposition.core.geometry.graphs.pieces import whole_polygons
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.geometry.symmetry import (
    Plane,
    find_plane,
    find_sides,
    side_of,
)
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.steps.progress import run

TURN = Rotation.from_rotvec([0.3, -0.8, 0.5])


def stand():
    """Return a wide plate on two legs, symmetric to x = 4.5 and to nothing else."""
    return shapes.blocks(
        (9, 6, 3), ((0, 9), (4, 6), (0, 2)), ((1, 3), (0, 4), (0, 1)),
        ((6, 8), (0, 4), (0, 1)), ((2, 7), (4, 6), (2, 3)),
    )  # fmt: skip


def tripod():
    """Return arms of three lengths, which no mirror image is like."""
    return shapes.blocks(
        (5, 4, 3), ((0, 5), (0, 1), (0, 1)), ((0, 1), (0, 4), (0, 1)),
        ((0, 1), (0, 1), (0, 3)),
    )  # fmt: skip


def turned(mesh):
    vertices = TURN.apply(mesh.vertices) + np.array([0.5, 2.0, -1.0])
    return TriangleMesh(vertices, mesh.triangles, mesh.polygons)


def sides_of(surface):
    """Return the two sides of a shape's mirror plane."""
    surface = whole_polygons(surface)
    return run(find_sides(surface, run(find_plane(surface))))


@pytest.mark.parametrize("turn", [lambda mesh: mesh, turned])
def test_both_sides_of_a_symmetric_shape_are_found_however_it_lies(turn):
    mesh = stand()
    surface = graph_of(normalized(turn(mesh)))
    upright = graph_of(mesh).centers
    one, other = sides_of(surface)
    beside = np.flatnonzero(abs(upright[:, 0] - 4.5) > 1e-6)
    assert sorted([*one.images, *other.images]) == beside.tolist()
    for side in (one, other):
        mirrored = upright[side.sources] * [-1, 1, 1] + np.array([9, 0, 0])
        assert mirrored == pytest.approx(upright[side.images])


def test_a_shape_without_a_mirror_plane_has_no_sides():
    assert sides_of(graph_of(normalized(tripod()))) == ()


def test_large_faces_need_no_faces_for_mirror_images():
    mesh = stand()  # diagonals of all squares run the same way
    mesh = TriangleMesh(mesh.vertices, mesh.triangles, np.arange(len(mesh.triangles)))
    assert sides_of(graph_of(normalized(mesh))) == ()
    parameters = Parameters(samples=300, containers="HOLLOW")
    assert len(decompose(mesh, parameters).pairs) == 1


def test_labels_are_copied_and_parts_across_the_plane_go_on():
    surface = graph_of(stand())
    x, y = surface.centers[:, 0], surface.centers[:, 1]
    plane = Plane(np.array([1.0, 0, 0]), 4.5)
    side, share = run(side_of(whole_polygons(surface), plane, True))
    assert share == 1.0
    labels = np.where((y < 4) & (x > 4.5), 1, 0)
    labels[(y > 5) & (x < 4)] = 2  # on the side that is written over
    copied = side.copied(labels, surface)
    assert set(copied[y > 4]) == {0}
    assert set(copied[(y < 4) & (x > 4.5)]) == {1}
    (image,) = set(copied[(y < 4) & (x < 4.5)])
    assert image == 3 + 1


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("turn", [lambda mesh: mesh, turned])
def test_parts_of_a_symmetric_shape_are_symmetric(turn, seed):
    mesh = turn(stand())
    parameters = Parameters(samples=150, max_parts=6, containers="HOLLOW", seed=seed)
    found = decompose(mesh, parameters)
    side, _ = sides_of(graph_of(normalized(mesh)))
    ends = found.labels[side.sources], found.labels[side.images]
    images = set(zip(*(end.tolist() for end in ends), strict=True))
    # Each part has one image, another one or itself.
    assert len(images) == found.n_parts - sum(a != b for a, b in images)
    assert found.n_parts > 1
