"""Stated errors: known ones, and dense measurements of others."""

from dataclasses import replace
from itertools import product

import changes
import numpy as np
import pytest
import shapes
from computed import build_hulls, solid_of
from definitions import heights_above_shape
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.hulls.convex_hull import THIN, convex_hull
from weak_convex_decomposition.core.hulls.cutting.cell import whole
from weak_convex_decomposition.core.hulls.fitting import fit_for
from weak_convex_decomposition.core.hulls.measure.error_bound import ErrorBound
from weak_convex_decomposition.core.hulls.measure.fragments import distances_to
from weak_convex_decomposition.core.hulls.measure.inside import inside_test
from weak_convex_decomposition.core.hulls.outline import fine_outline
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.steps.progress import run


def one_shape(mesh, **values):
    """Return the one shape around a mesh, as a part."""
    labels = np.zeros(mesh.n_polygons, dtype=np.int64)
    return build_hulls(mesh, HullParameters(pieces="PARTS", **values), labels)


def notched(width, depth):
    """Return a box of 2 x 2 x 2 with a narrow notch in its top."""
    half, floor = width / 2, 1 - depth
    outline = [(-1, -1), (1, -1), (1, 1), (half, 1), (half, floor)]
    outline += [(-half, floor), (-half, 1), (-1, 1)]
    vertices = [(x, y, z) for y in (1, -1) for x, z in outline]
    caps = [(0, 5, 6, 7), (1, 2, 3, 4), (0, 1, 4, 5)]
    quads = [[v + 8 for v in cap] for cap in caps] + [cap[::-1] for cap in caps]
    quads += [(i, (i + 1) % 8, (i + 1) % 8 + 8, i + 8) for i in range(8)]
    return shapes.mesh_of(
        vertices, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    )


@pytest.mark.parametrize(
    ("kind", "error"),
    [
        ("BOX", 0.0),
        ("HULL", 0.0),
        ("SPHERE", np.sqrt(3) - 1),  # the middle of a side of the cube
        ("CYLINDER", np.sqrt(2) - 1),
    ],
)
def test_errors_around_a_cube_are_known(kind, error):
    found = one_shape(shapes.box((-1, -1, -1), (1, 1, 1)), shape=kind)
    assert error <= found.errors[0] + 1e-9
    assert found.errors[0] <= error * 1.05 + 1e-9


def test_a_hull_over_a_gap_strays_to_its_middle():
    # The gap is 4 wide and 4 deep; half of the longest side is 4.
    found = one_shape(shapes.u_shape())
    assert 0.5 <= found.errors[0] <= 0.5 * 1.05


def test_a_notch_between_samples_is_seen():
    found = one_shape(notched(0.001, 0.8))
    assert 0.8 <= found.errors[0] <= 0.8 * 1.05


def test_a_shaft_beside_the_centers_of_patches_is_seen():
    # A thin slab across the shaft: its walls are hardly deep in it.
    full = np.ones((41, 41, 1), dtype=bool)
    full[20, 20] = False
    mesh = shapes.voxels(full)
    mesh = replace(mesh, vertices=mesh.vertices * [2 / 41, 2 / 41, 2] - 1)
    corners = np.array([*product((-1, 1), (-1, 1), (-0.002, 0.002))])
    solid, hull = solid_of(mesh), convex_hull(corners, THIN)
    shape = fit_for(mesh, HullParameters(), 1.0)[0].shape(hull)
    bound = ErrorBound(solid, shape, hull, 0.02)
    assert 1 / 41 <= bound.value <= 1.05 / 41


@pytest.mark.parametrize("margin", [0.2, -0.2])
def test_margins_are_part_of_the_error(margin):
    found = one_shape(shapes.box((-1, -1, -1), (1, 1, 1)), margin=margin)
    # Corners are the farthest, outside or uncovered.
    assert found.errors[0] == pytest.approx(0.2 * np.sqrt(3), rel=0.05)


def test_few_vertices_leave_some_uncovered():
    ball = shapes.sphere(3)
    fine, coarse = (one_shape(ball, max_vertices=n) for n in (1000, 8))
    assert fine.errors[0] == pytest.approx(0, abs=1e-6)
    corners = coarse.shapes[0].hull.corners
    away = [
        distances_to(np.tile(p, (len(corners), 1)), corners).min()
        for p in ball.vertices[coarse.shapes[0].heights(ball.vertices) > 1e-9]
    ]
    assert max(away) <= coarse.errors[0] <= 1.05 * max(away)


@pytest.mark.parametrize("seed", range(3))
def test_lengths_in_the_scene_are_the_same_errors(seed):
    mesh = changes.moved(shapes.l_shape(), scale=2.0**seed)
    half = np.ptp(mesh.bounds, axis=0).max() / 2
    relative = build_hulls(mesh, HullParameters(max_error=0.25))
    scene = HullParameters(max_error=0.25 * half, error_unit="SCENE")
    absolute = build_hulls(mesh, scene)
    assert absolute.n_hulls == relative.n_hulls
    assert absolute.errors == pytest.approx(relative.errors * half)
    assert absolute.errors_in("RELATIVE") == pytest.approx(relative.errors)
    assert relative.errors_in("SCENE") == pytest.approx(absolute.errors)
    with pytest.raises(DecompositionError, match="Error Unit cannot be 'scene'"):
        relative.errors_in("scene")


def test_lengths_that_are_too_small_for_a_shape_are_refused():
    mesh = shapes.box((0, 0, 0), (200, 1, 1))
    small = HullParameters(max_error=0.09, error_unit="SCENE")
    with pytest.raises(DecompositionError, match=r"choose at least 0\.1, a thousandth"):
        build_hulls(mesh, small)
    enough = HullParameters(max_error=0.1, error_unit="SCENE")
    assert build_hulls(mesh, enough).n_hulls == 1


def test_relative_errors_above_1_make_no_sense():
    with pytest.raises(DecompositionError, match="Error Unit = Scene"):
        HullParameters(max_error=2.0)
    assert HullParameters(max_error=2.0, error_unit="SCENE").max_error == 2


@pytest.mark.parametrize("limit", [0.1, 0.4, 0.6])
def test_a_bound_is_looked_for_up_to_a_limit(limit):
    # The gap is 4 wide and 4 deep; half of the longest side is 4.
    mesh = changes.moved(shapes.u_shape(), scale=1 / 4)
    piece = whole(solid_of(mesh), fit_for(mesh, HullParameters(), 1.0)[0])
    error = piece.bound.up_to(limit)
    assert error > limit if limit < 0.5 else 0.5 <= error <= 0.55
    # It goes on from there.
    assert 0.5 <= piece.bound.value <= 0.5 * 1.05


def strays(shape, mesh, most, is_inside=None):
    """Return whether any of 5,000 points on either surface is farther from the other.

    Points of the shape count only where they are outside the mesh.
    """
    rng = np.random.default_rng(0)
    corners = mesh.vertices[mesh.triangles]
    far = on_triangles(fine_outline(shape)[0], rng)
    for triangle in corners:
        far = far[distances_to(far, np.tile(triangle, (len(far), 1, 1))) > most]
    inside = is_inside(far) if is_inside else windings(corners, far) > 0.5
    depths = -heights_above_shape(shape, on_triangles(corners, rng))
    return not inside.all() or depths.max() > most


def on_triangles(corners, rng, count=5000):
    a, b, c = np.moveaxis(corners, 1, 0)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    rows = rng.choice(len(corners), count, p=areas / areas.sum())
    weights = rng.dirichlet([1, 1, 1], count)
    return np.einsum("nc,ncd->nd", weights, corners[rows])


def windings(corners, points):
    """Return how often a mesh winds around points: 1 inside, 0 outside."""
    total = np.zeros(len(points))
    for triangle in corners:
        a, b, c = (corner - points for corner in triangle)
        la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
        rise = np.einsum("nd,nd->n", a, np.cross(b, c))
        flat = la * lb * lc + (a * b).sum(1) * lc
        flat += (b * c).sum(1) * la + (a * c).sum(1) * lb
        total += 2 * np.arctan2(rise, flat)
    return total / (4 * np.pi)


@pytest.mark.parametrize("kind", ["HULL", "BOX", "SPHERE", "CYLINDER", "CAPSULE"])
@pytest.mark.parametrize("make", [shapes.plus, shapes.u_shape, shapes.table])
def test_no_measurement_is_above_the_stated_error(make, kind):
    mesh = changes.moved(make(), rotation=changes.any_rotation(1))
    found = build_hulls(mesh, HullParameters(shape=kind, max_error=0.4, max_hulls=4))
    half = np.ptp(mesh.bounds, axis=0).max() / 2
    for shape, stated in zip(found.shapes, found.errors, strict=True):
        assert not strays(shape, mesh, 1.05 * stated * half)


def test_holes_do_not_hide_what_is_outside():
    mesh = changes.moved(shapes.open_box(), rotation=changes.any_rotation(0))
    found = build_hulls(mesh, HullParameters(max_hulls=4))
    is_inside = run(inside_test(mesh.vertices[mesh.triangles], 3)).holds
    half = np.ptp(mesh.bounds, axis=0).max() / 2
    for shape, stated in zip(found.shapes, found.errors, strict=True):
        assert not strays(shape, mesh, 1.05 * stated * half, is_inside)


@pytest.mark.parametrize("seed", range(3))
def test_inside_an_open_mesh_is_where_it_winds_around_a_point(seed):
    rng = np.random.default_rng(seed)
    ball = shapes.sphere(2)
    corners = ball.vertices[ball.triangles]
    corners = corners[rng.random(len(corners)) > 0.25]
    points = rng.uniform(-1.1, 1.1, (2000, 3))
    winding = windings(corners, points)
    inside = run(inside_test(corners, 3)).holds(points)
    assert (inside == (winding > 0.5)).mean() > 0.9


@pytest.mark.parametrize("seed", range(3))
def test_regions_inside_an_open_mesh_have_no_sliver_outside(seed):
    rng = np.random.default_rng(seed)
    ball = shapes.sphere(2)
    corners = ball.vertices[ball.triangles]
    # Rays leave two shells: one hole alone is no way out.
    corners = np.concatenate([corners, 0.9 * corners])
    corners = corners[rng.random(len(corners)) > 0.1]
    centers, radii = rng.uniform(-0.5, 0.5, (20_000, 3)), rng.uniform(0, 0.03, 20_000)
    test = run(inside_test(corners, 3))
    inside, whole = test.holds_patches(centers, radii, radii < 0.03)
    # The surface is farther away than all radii: there is no other way out.
    sure = inside & whole
    assert 0.3 < sure.mean() < 1
    ways = rng.normal(size=(10, 20_000, 3))
    ways *= radii[:, None] / np.linalg.norm(ways, axis=2, keepdims=True)
    for way in ways:
        assert test.holds((centers + way)[sure]).all()
    # Small ones count as outside where the edge of a hole makes rays differ.
    assert not (inside & ~whole & (radii < 0.001)).any()
