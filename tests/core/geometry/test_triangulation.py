import numpy as np
import pytest
from weak_convex_decomposition.core.geometry.cutting import triangulation
from weak_convex_decomposition.core.geometry.cutting.triangulation import triangulate
from weak_convex_decomposition.core.geometry.frames import cross


def toothed(n_teeth):
    """Return a saw with a tooth at every second corner of its upper side."""
    saw = [(x, x % 2 + 0.6 + np.sin(x * x) / 2) for x in range(2 * n_teeth)]
    return [(0, 0), (2 * n_teeth - 1, 0), *saw[::-1]]


def spiral(n_corners):
    """Return a band that winds around the origin four times."""
    turns = np.linspace(0, 8 * np.pi, n_corners)
    around = np.column_stack([np.cos(turns), np.sin(turns)])
    outer, inner = ((turns + start)[:, None] * around for start in (2.5, 1.0))
    return [*map(tuple, outer), *map(tuple, inner[::-1])]


# A hook, a comb with three teeth and a star: none has a corner that sees all of it.
OUTLINES = {
    "triangle": [(0, 0), (1, 0), (0, 1)],
    "square": [(0, 0), (1, 0), (1, 1), (0, 1)],
    "arrowhead": [(0, 0), (2, 1), (0, 2), (1, 1)],
    "l": [(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)],
    "hook": [
        *((0, 0), (5, 0), (5, 4), (2, 4), (2, 2), (3, 2), (3, 3), (4, 3), (4, 1)),
        *((1, 1), (1, 5), (0, 5)),
    ],
    "comb": [
        *((0, 0), (7, 0), (7, 3), (6, 3), (6, 1), (4, 1), (4, 3), (3, 3), (3, 1)),
        *((1, 1), (1, 3), (0, 3)),
    ],
    "star": [
        (np.cos(angle) * reach, np.sin(angle) * reach)
        for angle, reach in zip(np.arange(12) * np.pi / 6, [3.0, 0.5] * 6, strict=True)
    ],
    "frame": [  # with an edge to its hole, which it runs along twice
        *((0, 0), (4, 0), (4, 4), (0, 4), (0, 0)),
        *((1, 1), (1, 3), (3, 3), (3, 1), (1, 1)),
    ],
    "long comb": toothed(60),
    "saw": [(0, 0), (5, 0), (5, 1), (4, 0.1), (3, 1), (2, 0.1), (1, 1), (0, 0.1)],
    "spiral": spiral(50),
    "corners in a line": [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2)],
}


def area_2d(outline):
    x, y = np.asarray(outline, dtype=float).T
    return float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2)


def in_space(outline, seed=3):
    """Return an outline turned into some plane of space, and the plane's normal."""
    axes, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    axes *= np.sign(np.linalg.det(axes))
    flat = np.column_stack([np.asarray(outline, dtype=float), np.zeros(len(outline))])
    return flat @ axes.T + 5.0, axes[:, 2]


def signed_areas(vertices, triangles, normal):
    a, b, c = np.moveaxis(vertices[triangles], 1, 0)
    return np.cross(b - a, c - a) @ normal / 2


@pytest.mark.parametrize("name", OUTLINES)
@pytest.mark.parametrize("turns", [0, 1, 2, 5])
def test_triangles_fill_the_polygon_without_a_fold(name, turns):
    outline = OUTLINES[name]
    vertices, normal = in_space(outline)
    face = np.roll(np.arange(len(outline)), turns)
    triangles, polygons = triangulate(vertices, [face])
    areas = signed_areas(vertices, triangles, normal)
    assert len(triangles) == len(outline) - 2
    assert (polygons == 0).all()
    assert areas.min() > -1e-9
    assert areas.sum() == pytest.approx(area_2d(outline))


@pytest.mark.parametrize("name", OUTLINES)
def test_each_side_of_the_polygon_is_a_side_of_one_triangle(name):
    vertices, _ = in_space(OUTLINES[name])
    corners = np.arange(len(vertices))
    triangles, _ = triangulate(vertices, [corners])
    heads = np.roll(triangles, -1, axis=1)
    sides = list(zip(triangles.ravel(), heads.ravel(), strict=True))
    for corner in corners:
        assert sides.count((corner, (corner + 1) % len(corners))) == 1


def test_polygons_of_all_sizes_keep_their_order():
    outlines = [OUTLINES[name] for name in ("hook", "triangle", "square", "triangle")]
    sizes = [len(outline) for outline in outlines]
    vertices = np.concatenate([in_space(outline)[0] for outline in outlines])
    faces = np.split(np.arange(sum(sizes)), np.cumsum(sizes)[:-1])
    triangles, polygons = triangulate(vertices, faces)
    assert polygons.tolist() == [0] * 10 + [1] + [2] * 2 + [3]
    for number, face in enumerate(faces):
        assert set(triangles[polygons == number].ravel()) == set(face)


def test_a_polygon_that_crosses_itself_gets_as_many_triangles():
    vertices = np.array([(0, 0, 0), (2, 2, 0), (2, 0, 0), (0, 2, 0), (-1, 1, 0)], float)
    triangles, _ = triangulate(vertices, [np.arange(5)])
    assert triangles.shape == (3, 3)


@pytest.mark.parametrize("make", [toothed, spiral])
def test_work_grows_with_the_corners_not_with_their_square(make, monkeypatch):
    sizes = []

    def counted(a, b):
        sizes.append(a.size)
        return cross(a, b)

    monkeypatch.setattr(triangulation, "cross", counted)
    vertices, _ = in_space(make(300))
    triangulate(vertices, [np.arange(len(vertices))])
    assert sum(sizes) < 600 * len(vertices)


def test_no_polygons_give_no_triangles():
    triangles, polygons = triangulate(np.zeros((0, 3)), [])
    assert triangles.shape == (0, 3)
    assert polygons.shape == (0,)
