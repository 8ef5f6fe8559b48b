from dataclasses import replace

import changes
import numpy as np
import pytest
import shapes
from computed import normalized
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh

CORNERS = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


@pytest.mark.parametrize(
    ("vertices", "triangles", "polygons", "text"),
    [
        (CORNERS, np.zeros((0, 3)), [], "no faces"),
        (np.zeros((0, 3)), np.zeros((0, 3)), [], "no faces"),
        ([[0, 0, np.nan], *CORNERS[1:]], [[0, 1, 2]], [0], "not finite"),
        ([[0, 0, np.inf], *CORNERS[1:]], [[0, 1, 2]], [0], "not finite"),
        (CORNERS, [[0, 1, 3]], [0], "missing vertices"),
        (CORNERS, [[0, 1, -1]], [0], "missing vertices"),
        (CORNERS, [[0, 1, 2]], [0, 1], "one polygon number"),
        (CORNERS, [[0, 1, 2]], [-1], "one polygon number"),
    ],
)
def test_bad_arrays_are_refused_with_a_sentence(vertices, triangles, polygons, text):
    with pytest.raises(DecompositionError, match=text) as error:
        TriangleMesh(vertices, triangles, polygons)
    assert str(error.value).endswith(".")


def test_arrays_of_other_shapes_and_types_are_refused_not_reshaped():
    good = {"vertices": CORNERS, "triangles": [[0, 1, 2]], "polygons": [0]}
    for name, value, error, text in (
        ("vertices", np.ones((3, 4)), DecompositionError, r"\(N, 3\), not \(3, 4\)"),
        ("vertices", np.ones((3, 2)), DecompositionError, r"\(N, 3\), not \(3, 2\)"),
        ("vertices", np.ones(9), DecompositionError, r"\(N, 3\), not \(9,\)"),
        ("vertices", np.eye(3) + 0j, TypeError, "numbers, not an array of dtype compl"),
        ("vertices", [[0, 0, 0], [1]], TypeError, "not a list of rows of unequal len"),
        ("vertices", "abc", TypeError, "must be numbers, not a value of type str"),
        ("triangles", [[0, 1, 2, 0]], DecompositionError, r"not \(1, 4\)"),
        ("triangles", [[0, 1, 2.5]], TypeError, "whole numbers, not .* dtype float64"),
        ("triangles", None, TypeError, "whole numbers, not a value of type NoneType"),
        ("polygons", [[0]], DecompositionError, "one polygon number"),
        ("polygons", [0.5], TypeError, "Polygons must be whole numbers"),
        ("polygons", np.array([2**63], np.uint64), DecompositionError, "one polygon"),
    ):
        with pytest.raises(error, match=text) as caught:
            TriangleMesh(**good | {name: value})
        assert str(caught.value).endswith("."), name


def test_polygons_without_triangles_are_refused():
    for polygons in ([0, 1, 2, 7], [1, 1, 2, 3], [0, 1, 2, 10**7], [0, 1, 2, 10**12]):
        mesh = TriangleMesh(CORNERS, [[0, 1, 2]] * 4, polygons)
        with pytest.raises(DecompositionError, match=r"have gaps; .*\.$"):
            normalized(mesh)


def test_sizes_that_leave_double_precision_are_refused():
    for scale in (1e-307, 1e-160, 1e-52, 1e51, 1e160, 1e307):
        mesh = changes.moved(shapes.box((-9,) * 3, (9,) * 3), scale)
        with pytest.raises(DecompositionError, match=r"a diagonal of .*scale .*\.$"):
            normalized(mesh)
    for scale in (1e-45, 1e38):  # the ends of single precision
        assert normalized(changes.moved(shapes.box(), scale)).diagonal == (
            pytest.approx(1)
        )


@pytest.mark.parametrize(
    "vertices",
    [
        np.zeros((3, 3)),
        [[0, 0, 0], [1, 1, 1], [2, 2, 2]],
        [[5, 5, 5], [5, 5, 5], [6, 5, 5]],
    ],
)
def test_faces_without_area_are_refused(vertices):
    mesh = TriangleMesh(np.array(vertices, dtype=float), [[0, 1, 2]], [0])
    with pytest.raises(DecompositionError, match="no area"):
        normalized(mesh)


def test_arrays_are_read_only_copies():
    vertices = np.array(CORNERS, dtype=np.float32)
    mesh = TriangleMesh(vertices, [[0, 1, 2]], [0])
    vertices[0] = 9
    assert mesh.vertices[0].tolist() == [0, 0, 0]
    assert mesh.vertices.dtype == np.float64
    assert mesh.triangles.dtype == np.int64
    found = mesh.areas, mesh.normals
    for array in (mesh.vertices, mesh.triangles, mesh.polygons, *found):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_areas_and_normals():
    mesh = TriangleMesh(
        [*CORNERS, [2, 0, 0]], [[0, 1, 2], [0, 2, 1], [0, 1, 3]], [0] * 3
    )
    assert mesh.areas.tolist() == [0.5, 0.5, 0]
    assert mesh.normals.tolist() == [[0, 0, 1], [0, 0, -1], [0, 0, 0]]
    assert mesh.n_polygons == 1


@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e12])
def test_normalized_is_centered_with_a_diagonal_of_one(scale):
    mesh = changes.moved(
        shapes.box(), scale, changes.any_rotation(1), (3e3 * scale,) * 3
    )
    normal = normalized(mesh)
    assert normal.diagonal == pytest.approx(1.0)
    extremes = normal.vertices.max(axis=0) + normal.vertices.min(axis=0)
    assert extremes == pytest.approx(np.zeros(3), abs=1e-9)


def test_loose_vertices_do_not_count():
    box = shapes.box()
    loose = TriangleMesh([*box.vertices, [1e6, 0, 0]], box.triangles, box.polygons)
    assert loose.diagonal == pytest.approx(np.sqrt(3))
    used = normalized(loose).vertices[:-1]
    assert used == pytest.approx(normalized(box).vertices)


def test_welded_corners_are_equal_where_vertices_coincide():
    box = shapes.box()
    welded = changes.split(box).welded_triangles
    assert len(np.unique(welded)) == 8
    same = box.triangles.ravel()[:, None] == box.triangles.ravel()
    assert ((welded.ravel()[:, None] == welded.ravel()) == same).all()


def test_welding_ignores_the_sign_of_zero():
    mesh = TriangleMesh([*CORNERS, [-0.0, 0, 0]], [[0, 1, 2], [3, 2, 1]], [0, 1])
    assert mesh.welded_triangles[0, 0] == mesh.welded_triangles[1, 0]


@pytest.mark.filterwarnings("error")
def test_loose_vertices_far_away_are_welded_with_nothing():
    box = shapes.box()
    far = [[1e300, 0, 0], [-1e300, 1.7e308, 0]]
    loose = TriangleMesh([*box.vertices, *far], box.triangles, box.polygons)
    assert (loose.welded_triangles == box.welded_triangles + 1).all()


@pytest.mark.parametrize("seed", range(10))
def test_vertices_that_differ_by_rounding_are_welded_wherever_they_are(seed):
    rng = np.random.default_rng(seed)
    split = changes.split(shapes.sphere(2))
    noise = rng.uniform(-6e-8, 6e-8, split.vertices.shape)
    shift = rng.uniform(0, 5, 3)
    mesh = replace(split, vertices=split.vertices + noise + shift)
    whole = len(shapes.sphere(2).vertices)
    assert len(np.unique(mesh.welded_triangles)) == whole
    assert mesh.welded_triangles.max() == whole - 1


def test_vertices_a_cell_apart_are_not_welded():
    fan = [(0, 0, 0), *((2e-6 * i, 1, 0) for i in range(200))]
    triangles = [(0, i + 1, i) for i in range(1, 200)]
    mesh = TriangleMesh(fan, triangles, range(199))
    assert len(np.unique(mesh.welded_triangles)) == 201


def test_other_numbers_of_polygons_keep_what_is_known():
    box = shapes.box()
    normals = box.normals
    other = box.with_polygons(np.zeros(12, dtype=int))
    assert other.n_polygons == 1
    assert other.normals is normals
    assert other.areas is box.areas
