import numpy as np
import pytest
import shapes
from weak_convex_decomposition.core.geometry.cutting.piece_labels import (
    labels_of_pieces,
)
from weak_convex_decomposition.core.geometry.cutting.planes import find_cuts
from weak_convex_decomposition.core.geometry.cutting.refined import refined
from weak_convex_decomposition.core.geometry.graphs.edges import sort_edges
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.core.steps.rows import RowsByNumber


@pytest.fixture(scope="module")
def fine_l():
    return refined(shapes.l_prism())


def sides_at_edges(mesh):
    """Return how many triangles meet at each edge."""
    edges = run(sort_edges(mesh))
    return np.diff([*edges.first, len(edges.sides)])


def test_a_refined_mesh_is_the_same_surface_without_a_gap(fine_l):
    whole, fine = shapes.l_prism(), fine_l.mesh
    assert (sides_at_edges(fine) == 2).all()
    sides = fine.vertices[fine.triangles] - fine.vertices[np.roll(fine.triangles, 1, 1)]
    assert np.linalg.norm(sides, axis=2).max() <= fine_l.size
    assert fine.n_polygons == len(fine.triangles) == len(fine_l.faces)
    areas = np.bincount(fine_l.faces, fine.areas)
    assert np.allclose(areas, np.bincount(whole.polygons, whole.areas))


def test_coinciding_vertices_are_refined_alike():
    whole = shapes.l_prism()
    apart = shapes.TriangleMesh(
        whole.vertices[whole.triangles].reshape(-1, 3),
        np.arange(whole.triangles.size).reshape(-1, 3),
        whole.polygons,
    )
    assert (sides_at_edges(refined(apart).mesh) == 2).all()


def test_small_faces_stay_whole():
    mesh = shapes.box(divisions=40)
    fine = refined(mesh)
    assert fine.mesh is mesh
    assert fine.faces.tolist() == list(range(mesh.n_polygons))


def test_a_plane_is_fitted_through_the_crease_and_cuts_the_faces_it_crosses(fine_l):
    centers, _ = fine_l.centers()
    ragged = 0.05 * np.sin(40 * centers[:, 0]) * (centers[:, 0] < 1)
    labels = (centers[:, 1] > 1 + ragged).astype(int)
    (cut,) = find_cuts(fine_l, labels)
    assert abs(cut.normal[1]) > 0.99
    assert abs((np.array([1, 1, 0.5]) - cut.point) @ cut.normal) < 0.05
    # Both caps, and the wall at x = 0.
    touched = {*np.flatnonzero(np.bincount(fine_l.faces, labels)).tolist()}
    touched -= {*np.flatnonzero(np.bincount(fine_l.faces, 1 - labels) == 0).tolist()}
    assert {*cut.faces.tolist()} == touched
    assert len(touched) == 3


def test_a_patch_within_a_face_is_crossed_by_a_plane_that_stands_upright(fine_l):
    centers, _ = fine_l.centers()
    near = np.linalg.norm(centers - (0.5, 2, 1), axis=1) < 0.3
    (cut,) = find_cuts(fine_l, near.astype(int))
    assert abs(cut.normal[2]) < 0.1


def test_rows_are_found_by_their_number():
    numbers = np.array([2, -1, 0, 2, 4, 0, -1])
    rows = RowsByNumber(numbers, 5)
    assert [rows.of(number).tolist() for number in range(5)] == [
        *([2, 5], [], [0, 3], [], [4]),
    ]


def test_one_part_needs_no_cut(fine_l):
    assert find_cuts(fine_l, np.zeros(len(fine_l.faces), dtype=int)) == []


def test_pieces_get_the_part_that_covers_them(fine_l):
    whole = shapes.l_prism()
    centers, _ = fine_l.centers()
    labels = (centers[:, 1] > 1).astype(int)
    # Each triangle is a piece of its face: none but those of the caps is in two parts.
    pieces = shapes.TriangleMesh(
        whole.vertices, whole.triangles, np.arange(len(whole.triangles))
    )
    found, of_polygons = labels_of_pieces(fine_l, labels, pieces, whole.polygons)
    middles = whole.vertices[whole.triangles].mean(axis=1)
    sure = np.abs(middles[:, 1] - 1) > 0.5
    assert (found == (middles[:, 1] > 1))[sure].all()
    assert set(of_polygons[labels != of_polygons].tolist()) <= {0, 1}
    assert (of_polygons == labels).mean() > 0.8
