import changes
import numpy as np
import pytest
import shapes
from computed import apart, marcher_of

X = np.array([[1.0, 0.0, 0.0]])


def scene_of(mesh):
    return marcher_of(mesh)


def march(mesh, origin, reach=100.0):
    scene, origins = scene_of(mesh), np.array([origin], dtype=float)
    around = scene.shells_around(origins, [np.array([[-0.36, 0.48, 0.8]])] * 3)
    exits, distances, depths = scene.march(origins, X, np.array([reach]), around)
    return exits[0], distances[0], depths[0]


BOX = shapes.box()
OVERLAP = shapes.joined(BOX, shapes.box((0.5, 0.1, 0.1), (2, 0.9, 0.9)))
ROW = shapes.joined(*(shapes.box((x, 0, 0), (x + 1, 1, 1)) for x in (0, 2, 4)))
INSIDE = (0.25, 0.4, 0.45)


def test_a_ray_leaves_where_the_last_shell_ends():
    triangle, distance, depth = march(BOX, INSIDE)
    assert distance == pytest.approx(0.75)
    assert BOX.normals[triangle].tolist() == [1, 0, 0]
    assert depth == 0
    triangle, distance, depth = march(OVERLAP, INSIDE)
    assert distance == pytest.approx(1.75, abs=1e-4)
    assert triangle >= 12
    assert depth == 0


def test_a_ray_that_ends_inside_does_not_leave():
    assert march(BOX, INSIDE, reach=0.7) == (-1, np.inf, 1)
    assert march(OVERLAP, INSIDE, reach=0.6) == (-1, np.inf, 2)
    assert march(OVERLAP, INSIDE, reach=1.0) == (-1, np.inf, 1)


def test_a_ray_out_of_a_hole_does_not_leave_through_a_triangle():
    hole = changes.without(BOX, lambda centers: centers[:, 0] > 0.99)
    assert march(hole, INSIDE) == (-1, np.inf, 0)


def test_the_given_depths_are_not_changed():
    depths = np.array([1])
    scene_of(BOX).march(np.array([INSIDE]), X, np.array([9.0]), depths)
    assert depths[0] == 1


@pytest.mark.parametrize("copies", [2, 200])
def test_coincident_faces_come_to_an_end(copies):
    _, distance, _ = march(shapes.joined(*[BOX] * copies), INSIDE)
    assert distance == pytest.approx(0.75)


def test_two_solids_that_share_a_wall_are_alike_in_either_order():
    """A ray from one into the other either passes or ends at the wall."""
    other = shapes.box((1, 0, 0), (2, 1, 1))
    beyond = shapes.box((3, 0, 0), (4, 1, 1))
    ends = [
        march(apart(shapes.joined(*order)), INSIDE)[1]
        for order in ((BOX, other, beyond), (other, BOX, beyond))
    ]
    assert ends[0] == pytest.approx(ends[1], abs=1e-4)
    assert ends[0] < 2


def test_surfaces_along_a_ray_are_those_it_leaves_through():
    found = list(scene_of(ROW).surfaces_along(np.array([INSIDE]), X, np.array([1])))
    assert [rays.tolist() for rays, _, _ in found] == [[0], [0], [0]]
    assert [points[0, 0] for _, points, _ in found] == pytest.approx(
        [1, 3, 5], abs=1e-3
    )
    assert [int(triangles[0]) // 12 for _, _, triangles in found] == [0, 1, 2]


def test_surfaces_along_keep_track_of_which_ray_is_which():
    origins = np.array([INSIDE, (4.5, 0.4, 0.45), (2.5, 0.4, 0.45)])
    directions, depths = np.repeat(X, 3, axis=0), np.ones(3, dtype=int)
    found = list(scene_of(ROW).surfaces_along(origins, directions, depths))
    assert [rays.tolist() for rays, _, _ in found] == [[0, 1, 2], [0, 2], [0]]
    assert found[1][1][:, 0] == pytest.approx([3, 5], abs=1e-3)


@pytest.mark.parametrize(
    ("point", "count"), [((-1, 0.4, 0.45), 0), (INSIDE, 1), ((0.75, 0.4, 0.45), 2)]
)
@pytest.mark.parametrize("direction", [(1, 0, 0), (-0.6, 0, 0.8), (0.36, 0.48, 0.8)])
def test_shells_around_a_point_are_counted(point, count, direction):
    counts = scene_of(OVERLAP).shells_around(
        np.array([point], dtype=float), [np.array([direction], dtype=float)] * 3
    )
    assert counts.tolist() == [count]


@pytest.mark.parametrize("slips", [0, 1, 2])
def test_one_ray_that_slips_through_does_not_count(slips):
    points, directions = np.array([INSIDE] * 2), [np.repeat(-X, 2, axis=0)] * 3
    directions[slips] = np.array([(0.0, 0.0, 1.0), (0.0, 1.0, 0.0)])
    marcher = marcher_of(BOX)
    top = marcher.normals[:, 2] > 0.5
    marcher.closed[top] = False  # as if rays upwards slipped through
    assert marcher.shells_around(points, directions).tolist() == [1, 1]
