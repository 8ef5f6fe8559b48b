"""Arrays that scripts hand over: which numbers are read, and which are refused."""

from fractions import Fraction

import numpy as np
import pytest
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.geometry.array_checks import (
    real_numbers,
    rows_of_three,
)
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.geometry.point_cloud import PointCloud
from weak_convex_decomposition.core.geometry.shape import check_members, checked_labels
from weak_convex_decomposition.operators.bridge.read.arrays import shape_of

CORNERS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
FACES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
HUGE = [[0, 2, 2**70], *FACES[1:]]


@pytest.mark.parametrize(
    ("values", "kind"),
    [
        ([[1, 2, 3]], "i"),
        ([[1, np.uint8(2), 3]], "i"),
        ([[1, 2.5, 3]], "f"),
        ([[1.0, np.float32(2), float("nan")]], "f"),
        ([], "i"),
    ],
)
def test_plain_numbers_in_an_array_of_objects_are_read(values, kind):
    found = real_numbers(np.array(values, dtype=object))
    assert found.dtype.kind == kind
    assert np.array_equal(found, np.array(values, dtype=float), equal_nan=True)


@pytest.mark.parametrize("value", [True, None, "1", Fraction(1, 3), 1j, np.True_])
def test_other_objects_are_refused_with_a_hint(value):
    values = np.array([[value, 0, 0]], dtype=object)
    with pytest.raises(TypeError, match=r"dtype object .* with `\.astype\(float\)`"):
        rows_of_three(values, "Vertices")


def test_a_mesh_of_arrays_of_objects_is_that_of_plain_ones():
    plain = shape_of(CORNERS, FACES)
    quads = [[0, 2, 1], [0, 1, 3], [0, 3, 2, 1]]
    rows = np.empty(len(quads), dtype=object)
    rows[:] = [np.array(face, dtype=object) for face in quads]
    objects = np.array(CORNERS, dtype=object)
    of_objects = shape_of(objects, np.array(FACES, dtype=object))
    assert np.array_equal(plain.vertices, of_objects.vertices)
    assert np.array_equal(plain.triangles, of_objects.triangles)
    assert shape_of(objects, rows).n_polygons == 3


@pytest.mark.parametrize(
    "call",
    [
        lambda: shape_of(CORNERS, HUGE),
        lambda: shape_of(CORNERS, [*HUGE, [0, 1, 2, 3]]),
        lambda: shape_of(CORNERS, np.array(HUGE, dtype=object)),
        lambda: TriangleMesh(CORNERS, HUGE, range(4)),
    ],
)
def test_numbers_of_vertices_that_are_too_large_are_told(call):
    with pytest.raises(DecompositionError, match=r"too large: numbers of vertices"):
        call()


def masked(values):
    """Return values of which the last row is masked."""
    rows = np.ma.array(values)
    rows[-1] = np.ma.masked
    return rows


@pytest.mark.parametrize(
    "call",
    [
        lambda: shape_of(masked(CORNERS * 8), None),
        lambda: shape_of(masked(CORNERS), FACES),
        lambda: shape_of(CORNERS, masked(FACES)),
        lambda: shape_of(CORNERS, [*FACES[:3], masked([1, 2, 3, 0])]),
        lambda: TriangleMesh(CORNERS, FACES, masked(range(4))),
        lambda: PointCloud(np.eye(20, 3), masked(np.ones((20, 3)))),
        lambda: checked_labels(masked(range(4)), shape_of(CORNERS, FACES), True),
        lambda: check_members(masked([True] * 4), shape_of(CORNERS, FACES)),
    ],
)
def test_masked_numbers_are_refused(call):
    with pytest.raises(DecompositionError, match="masked"):
        call()


def test_arrays_that_could_have_a_mask_are_read():
    assert shape_of(np.ma.array(CORNERS), np.ma.array(FACES)).n_polygons == 4
