import clouds
import numpy as np
import pytest
import shapes
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.geometry.point_cloud import PointCloud

POINTS, NORMALS = clouds.drawn(shapes.sphere(), 50)


BAD = {
    "empty": (np.zeros((0, 3)), None, "too few points .*, 0"),
    "one point": (POINTS[:1], None, "too few points .*, 1"),
    "coincident": (np.ones((50, 3)), None, "at one place"),
    "collinear": (POINTS * (1, 0, 0), None, "in a line"),
    "NaN": (clouds.changed(POINTS, 3, np.nan), None, "not finite"),
    "infinite": (clouds.changed(POINTS, 3, np.inf), None, "not finite"),
    "zero normal": (POINTS, clouds.changed(NORMALS, 3, 0.0), "zero or not finite"),
    "NaN normal": (POINTS, clouds.changed(NORMALS, 3, np.nan), "zero or not finite"),
    "normals of others": (POINTS, NORMALS[:-1], "50 points but 49 normals"),
    "two columns": (POINTS[:, :2], None, r"shape \(N, 3\), not \(50, 2\)"),
    "four columns": (np.ones((60, 4)), None, r"shape \(N, 3\), not \(60, 4\)"),
    "columns of normals": (POINTS, NORMALS.T, r"Normals must .* not \(3, 50\)"),
    "too far apart": (POINTS * 1e160, None, "a diagonal of"),
    "too near": (POINTS * 1e-200, None, "a diagonal of"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_clouds_have_their_sentence(case):
    points, normals, match = BAD[case]
    with pytest.raises(DecompositionError, match=match) as error:
        PointCloud(points, normals)
    assert str(error.value).endswith(".")


def test_what_is_no_number_is_refused():
    for points, normals, text in (
        (POINTS + 0j, None, "Points must be numbers, not an array of dtype complex128"),
        ("cloud", None, "Points must be numbers, not a value of type str"),
        (None, None, "Points must be numbers, not a value of type NoneType"),
        (
            POINTS,
            [["x", "y", "z"]] * 50,
            "Normals must be numbers, not a list .* strings",
        ),
    ):
        with pytest.raises(TypeError, match=text) as error:
            PointCloud(points, normals)
        assert str(error.value).endswith(".")


def test_a_slanted_line_is_one_wherever_it_lies():
    line = np.linspace(0, 1, 50)[:, None] * (1, 2, 3) + 1000
    with pytest.raises(DecompositionError, match="in a line"):
        PointCloud(line)


@pytest.mark.parametrize("away", [3e3, 1e4, 1e6, 1e12])
@pytest.mark.parametrize("n_strays", [1, 5])
def test_a_shape_that_strays_make_too_small_to_see_is_no_line(away, n_strays):
    strays = POINTS[:n_strays] * away
    with pytest.raises(DecompositionError, match="Half of the points lie within") as e:
        PointCloud(np.concatenate([POINTS, strays]))
    assert "delete stray points" in str(e.value)


def test_a_few_stray_points_or_many_copies_are_no_reason_to_refuse():
    strays = POINTS[:5] * 300
    assert len(PointCloud(np.concatenate([POINTS, strays]))) == 55
    assert len(PointCloud(np.concatenate([POINTS, np.full((70, 3), 5.0)]))) == 120


def test_two_pieces_far_from_each_other_are_no_line():
    with pytest.raises(DecompositionError, match="an object of each far piece"):
        PointCloud(np.concatenate([POINTS, POINTS + 1e5]))


def test_the_arrays_are_copies_that_cannot_be_written():
    points, normals = POINTS.copy(), 3 * NORMALS
    cloud = PointCloud(points, normals)
    points[0] = normals[0] = 9
    assert cloud.points == pytest.approx(POINTS)
    assert cloud.normals == pytest.approx(NORMALS)
    for array in (cloud.points, cloud.normals):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_normalized_is_centered_and_of_diagonal_one():
    cloud = PointCloud(POINTS * 7 + (1, 2, 3), NORMALS).normalized()
    assert cloud.diagonal == pytest.approx(1)
    assert cloud.points.min(axis=0) == pytest.approx(-cloud.points.max(axis=0))


def test_copies_are_taken_out_and_told_where_they_are():
    alone = PointCloud(POINTS, NORMALS)
    assert alone.distinct()[0] is alone
    order = np.random.default_rng(0).permutation(np.repeat(np.arange(50), 3))
    for normals in (None, NORMALS):
        cloud = PointCloud(POINTS[order], None if normals is None else normals[order])
        different, rows = cloud.distinct()
        assert len(different) == 50
        assert (different.points[rows] == cloud.points).all()
    both_sides = PointCloud(
        np.tile(POINTS, (2, 1)), np.concatenate([NORMALS, -NORMALS])
    )
    assert both_sides.distinct()[0] is both_sides
    with pytest.raises(DecompositionError, match=r"few points .*, 15; .* 16 differ"):
        PointCloud(np.repeat(POINTS[:15], 9, axis=0)).distinct()


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("length", [1e-310, 1e-200, 1e-7, 1e200])
def test_normals_may_have_any_length_but_0(length):
    cloud = PointCloud(POINTS, NORMALS * length)
    assert cloud.normals == pytest.approx(NORMALS, abs=1e-9)
