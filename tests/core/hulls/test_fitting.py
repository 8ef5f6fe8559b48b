import changes
import numpy as np
import pytest
import shapes
from definitions import assert_convex, heights_above_shape
from weak_convex_decomposition.core.hulls.convex_hull import convex_hull
from weak_convex_decomposition.core.hulls.fitting import Fit
from weak_convex_decomposition.core.hulls.outline import outline_of
from weak_convex_decomposition.core.parameters.hulls import HullParameters

KINDS = ["BOX", "SPHERE", "CYLINDER", "CAPSULE"]
TURN = changes.any_rotation(3)
BAR = shapes.box((0, 0, 0), (6, 2, 1)).vertices


def around(points, kind, **values):
    hull = convex_hull(np.asarray(points), 1e-3)
    return Fit(HullParameters(shape=kind, **values), 1.0, 0.05).shape(hull)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(5))
def test_shapes_contain_their_part(kind, seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(60, 3)) * rng.random(3)
    shape = around(points, kind)
    assert heights_above_shape(shape, points).max() < 1e-9
    assert np.linalg.det(shape.axes) == pytest.approx(1)
    # Tight: a trifle smaller, and something is out of it.
    smaller = around(points, kind, margin=-0.01)
    assert heights_above_shape(smaller, points).max() > 0.005


@pytest.mark.parametrize("seed", range(5))
def test_a_box_is_the_smallest_flush_with_a_face(seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(40, 3)) * (0.2 + rng.random(3))
    shape = around(points, "BOX")
    # The smallest rectangle around an outline is flush with one of its edges.
    corners = shape.hull.corners
    edges = (np.roll(corners, 1, axis=1) - corners).reshape(-1, 3)
    sizes = []
    for normal in shape.hull.planes[:, :3]:
        first = np.cross(normal, edges)
        first /= np.linalg.norm(first, axis=1, keepdims=True)
        widths = [
            np.ptp(points @ axes.T, axis=0) for axes in (first, np.cross(normal, first))
        ]
        sizes.append(np.prod(widths, axis=0).min() * np.ptp(points @ normal))
    assert shape.volume == pytest.approx(min(sizes), rel=1e-6)


@pytest.mark.parametrize(
    ("kind", "volume"),
    [
        ("BOX", 12),
        ("SPHERE", 4 / 3 * np.pi * (41 / 4) ** 1.5),
        ("CYLINDER", 6 * np.pi * 5 / 4),
    ],
)
def test_volumes_around_a_turned_bar(kind, volume):
    shape = around(BAR @ TURN.T + 7, kind)
    assert shape.volume == pytest.approx(volume, rel=0.01)


def test_a_capsule_around_a_capsule():
    ball = shapes.sphere(3).vertices
    points = np.concatenate([ball - [0, 0, 3], ball + np.array([0, 0, 3])]) @ TURN.T
    shape = around(points, "CAPSULE")
    assert shape.volume == pytest.approx(np.pi * 6 + 4 / 3 * np.pi, rel=0.03)
    assert abs(shape.axes[2] @ TURN[:, 2]) == pytest.approx(1, abs=1e-3)


@pytest.mark.parametrize("kind", [*KINDS, "HULL"])
def test_outlines_are_convex_and_as_large(kind):
    shape = around(BAR @ TURN.T + 7, kind)
    outline = outline_of(shape)
    assert_convex(outline)
    assert outline.volume == pytest.approx(shape.volume, rel=0.05)
    assert heights_above_shape(shape, outline.vertices).max() < 1e-6


@pytest.mark.parametrize("kind", [*KINDS, "HULL"])
@pytest.mark.parametrize("points", [[[0, 0, 0]], [[0, 0, 0], [1, 0, 0], [0, 1, 0]]])
def test_flat_parts_have_thin_shapes(kind, points):
    shape = around(np.array(points, dtype=float), kind)
    assert shape.volume > 0
    assert heights_above_shape(shape, np.array(points)).max() < 1e-9
    assert outline_of(shape).volume > 0


@pytest.mark.parametrize("kind", [*KINDS, "HULL"])
def test_shapes_move_with_their_part(kind):
    shape = around(BAR, kind)
    moved = shape.moved(2.0, np.array([1.0, 2.0, 3.0]))
    points = np.random.default_rng(0).normal(size=(100, 3)) * 5
    heights = heights_above_shape(moved, points * 2 + [1, 2, 3])
    assert heights == pytest.approx(2 * heights_above_shape(shape, points))
    assert moved.volume == pytest.approx(8 * shape.volume)


@pytest.mark.parametrize("kind", [*KINDS, "HULL"])
def test_arrays_of_shapes_cannot_be_written(kind):
    shape = around(BAR, kind).moved(2.0, np.ones(3))
    hull = shape.hull
    arrays = [shape.center, shape.axes, shape.sizes, hull.vertices, hull.facets]
    for array in (*arrays, hull.planes, hull.triangles, hull.corners, hull.bounds):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_margins_move_faces_outwards():
    assert around(BAR, "HULL", margin=0.5).volume == pytest.approx(7 * 3 * 2)
    assert around(BAR, "BOX", margin=0.5).volume == pytest.approx(7 * 3 * 2)
    thin, thick = (around(BAR, "CAPSULE", margin=margin).sizes for margin in (0, 0.5))
    assert thick == pytest.approx(np.add(thin, (0.5, 0.5, 0)))
    inside = around(BAR, "BOX", margin=-10)
    assert 0 < inside.volume < 1e-6


@pytest.mark.parametrize("kind", ["BOX", "CYLINDER"])
def test_thin_shapes_are_as_thin_as_what_is_in_them(kind):
    slab = shapes.box((-1, -1, 0), (1, 1, 1e-3)).vertices
    shape = Fit(HullParameters(shape=kind), 1.0, 0.05).shape(convex_hull(slab, 1e-5))
    around_it = {"BOX": 4, "CYLINDER": 2 * np.pi}[kind]
    assert shape.volume == pytest.approx(around_it * 1e-3, rel=0.01)
