import re
from dataclasses import replace

import changes
import numpy as np
import pytest
import shapes
from brute_caster import BruteCaster
from computed import build_hulls
from definitions import assert_convex, covered
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.hulls.build import build_hulls_in_steps
from weak_convex_decomposition.core.hulls.fitting import fit_for
from weak_convex_decomposition.core.hulls.notes import notes_on
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.steps.progress import Progress


def hulls_of(mesh, labels=None, **values):
    if labels is None:
        labels = np.zeros(mesh.n_polygons, dtype=np.int64)
    return build_hulls(mesh, HullParameters(**values), labels)


@pytest.mark.parametrize("make", [shapes.box, lambda: shapes.sphere(2)])
def test_a_convex_shape_is_one_hull(make):
    found = hulls_of(make(), max_vertices=1000)
    assert found.n_hulls == 1
    assert found.volume_ratio == pytest.approx(1, abs=0.02)
    assert found.notes == ()


@pytest.mark.parametrize("max_vertices", [64, 32])
def test_a_convex_shape_of_more_vertices_than_a_hull_may_have_is_cut(max_vertices):
    found = hulls_of(shapes.uv_sphere(8, 12), max_vertices=max_vertices)
    assert 2 <= found.n_hulls <= 8
    assert found.errors.max() <= 0.05
    assert found.notes == ()


@pytest.mark.parametrize(
    "make", [shapes.l_shape, shapes.u_shape, shapes.plus, shapes.table, shapes.dumbbell]
)
def test_hulls_are_within_the_error(make):
    mesh = make()
    found = hulls_of(mesh)
    assert 2 <= found.n_hulls <= 10
    assert found.errors.max() <= 0.05
    assert found.volume_ratio < 1.06
    assert covered(found.shapes, mesh.vertices).all()
    for shape in found.shapes:
        assert_convex(shape.hull)
        assert len(shape.hull.vertices) <= 64
    volumes = [round(shape.volume, 3) for shape in found.shapes]
    assert volumes == sorted(volumes, reverse=True)


def test_the_error_is_concavity():
    # One hull over a U: its gap is 4 wide and deep, half of the longest side is 4.
    found = hulls_of(shapes.u_shape(), max_hulls=1)
    gap, solid = 4 * 4 * 2, 8 * 2 * 2 + 2 * 4 * 2 * 2
    hausdorff = 2 / 4  # of the middle of the gap's lid from the legs
    volume = 0.3 * np.cbrt(3 * gap / 4**3 / (4 * np.pi))
    assert volume < hausdorff
    assert found.errors[0] == pytest.approx(hausdorff, abs=0.03)
    assert found.volume_ratio == pytest.approx(1 + gap / solid, rel=0.03)
    assert found.notes == (
        f"The error is {found.errors[0]:.3g}, above Largest Error = 0.05, after as many"
        " cuts as Most Hulls = 1 allows; raise Most Hulls for more.",
    )


def test_a_cup_stays_hollow():
    found = hulls_of(shapes.cup())
    assert found.n_hulls <= 32
    hollow = np.array([[0.5, 0.5, z] for z in (0.3, 0.5, 0.7, 0.9)])
    assert not covered(found.shapes, hollow).any()


@pytest.mark.parametrize(
    ("make", "depth"), [(shapes.bowl, 0.35), (shapes.mug, 0.3)], ids=["bowl", "mug"]
)
def test_vessels_stay_hollow(make, depth):
    mesh = make()
    found = hulls_of(mesh)
    assert found.n_hulls <= 32
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    # A ball on the floor, as large as the error leaves room for.
    turns = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    for share in np.linspace(depth, 1, 5):
        radius = 0.6 * np.sqrt(1 - (1 - share) ** 2)
        ring = np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=1) * radius
        ring[:, 2] = low[2] + share * (high - low)[2] - 0.01
        assert not covered(found.shapes, ring).any()
    assert covered(found.shapes, mesh.vertices).all()


def test_larger_errors_need_fewer_hulls():
    counts = [
        hulls_of(shapes.comb(), max_error=error).n_hulls for error in (0.05, 0.15, 1.0)
    ]
    assert counts == sorted(counts, reverse=True)
    assert counts[-1] == 1


def test_the_result_does_not_depend_on_units_and_place():
    # Unlike arms: among cuts that are alike, noise may choose.
    mesh = shapes.blocks((7, 5, 2), ((0, 7), (0, 2), (0, 2)), ((0, 2), (0, 5), (0, 2)))
    found = hulls_of(mesh)
    moved = hulls_of(changes.moved(mesh, scale=10.0, offset=(100, 0, 0)))
    assert moved.n_hulls == found.n_hulls
    assert sorted(moved.errors) == pytest.approx(sorted(found.errors), abs=0.01)
    for one, other in zip(found.shapes, moved.shapes, strict=True):
        assert other.volume == pytest.approx(1000 * one.volume, rel=0.01)
    assert moved.volume_ratio == pytest.approx(found.volume_ratio, rel=0.01)
    low = np.min([shape.hull.vertices.min(axis=0) for shape in moved.shapes], axis=0)
    assert low == pytest.approx([100, 0, 0], abs=0.1)


def test_the_same_input_gives_the_same_hulls():
    one, other = hulls_of(shapes.plus()), hulls_of(shapes.plus())
    for first, second in zip(one.shapes, other.shapes, strict=True):
        assert (first.hull.vertices == second.hull.vertices).all()


def test_fewer_hulls_than_connected_pieces():
    mesh = shapes.joined(
        *(shapes.box((2 * i, 0, 0), (2 * i + 1, 1, 1)) for i in range(4))
    )
    for most in (1, 2, 3):
        found = hulls_of(mesh, max_hulls=most)
        assert found.n_hulls == most
        assert covered(found.shapes, mesh.vertices).all()
        assert len(found.notes) == 1


@pytest.mark.parametrize(
    "make",
    [
        shapes.sheet,
        shapes.open_box,
        lambda: changes.inside_out(shapes.box()),
        lambda: shapes.mesh_of([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]),
    ],
    ids=["sheet", "open", "inside out", "triangle"],
)
def test_shapes_that_are_no_solids_have_hulls(make):
    mesh = make()
    found = hulls_of(mesh, max_hulls=8)
    assert 1 <= found.n_hulls <= 8
    for shape in found.shapes:
        assert_convex(shape.hull)
    assert covered(found.shapes, mesh.vertices[mesh.triangles].reshape(-1, 3)).all()


@pytest.mark.parametrize("seed", range(3))
def test_sheets_with_two_sides_have_no_volume(seed):
    """Rounding leaves a little, beside which no error counted any more."""
    sheet = shapes.open_box()
    mesh = changes.moved(
        shapes.joined(sheet, changes.inside_out(sheet)),
        rotation=changes.any_rotation(seed),
    )
    found = hulls_of(mesh, max_hulls=16)
    assert found.volume_ratio == np.inf
    assert found.errors.max() < 0.1


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_flat_meshes_are_one_hull_however_they_are_turned_and_rounded(dtype):
    turned = changes.moved(shapes.sheet(6), rotation=changes.any_rotation(0))
    mesh = replace(turned, vertices=turned.vertices.astype(dtype))
    found = hulls_of(mesh)
    assert found.n_hulls == 1
    assert found.errors.max() < 0.05
    assert found.notes == ()


def test_loose_vertices_get_no_hull():
    cube = shapes.box()
    mesh = replace(cube, vertices=np.concatenate([cube.vertices, [[5, 5, 5]]]))
    found = hulls_of(mesh)
    assert [round(shape.volume, 6) for shape in found.shapes] == [1]


def test_points_have_no_hull():
    flat = shapes.mesh_of([(0, 0, 0)] * 3, [(0, 1, 2)])
    with pytest.raises(DecompositionError, match="no area"):
        hulls_of(flat)


def test_progress_rises():
    cache = ShapeCache(BruteCaster)
    steps = build_hulls_in_steps(shapes.comb(), HullParameters(), cache)
    fractions = [p.fraction for p in steps if isinstance(p, Progress)]
    assert len(fractions) > 5
    assert fractions == sorted(fractions)
    assert fractions[-1] <= 1


@pytest.mark.parametrize("error", [0.0500001, 0.06, 0.12343472])
def test_an_error_is_told_from_the_largest_however_near_it_is(error):
    most = min(error - 1e-8, 0.1234347)
    parameters = HullParameters(max_error=most, max_hulls=1)
    fit, _ = fit_for(shapes.box(), parameters, 1.0)
    (shape,) = hulls_of(shapes.box()).shapes
    (note,) = notes_on([shape], [shape.hull], np.array([error]), fit)
    numbers = [float(text) for text in re.findall(r"0\.\d+", note)]
    assert numbers == pytest.approx([error, most], rel=1e-3)
    assert numbers[0] > numbers[1]


def test_parameters_are_checked():
    with pytest.raises(DecompositionError, match="Most Vertices is 3"):
        HullParameters(max_vertices=3)
    with pytest.raises(DecompositionError, match="Shape cannot be 'CONE'"):
        HullParameters(shape="CONE")


def test_thin_solids_get_hulls_as_large_as_they_are():
    for thickness in (1e-3, 1e-4, 1e-5):
        slab = shapes.box((0, 0, 0), (2, 2, thickness))
        found = hulls_of(slab)
        assert len(found.shapes) == 1
        assert found.volume_ratio == pytest.approx(1, rel=1e-3)
        assert found.errors[0] < 1e-3


def test_the_error_holds_the_added_volume_whatever_is_allowed():
    """A flat square gets a thin hull, which is all outside of it."""
    for most in (0.05, 0.1, 1.0):
        found = hulls_of(shapes.sheet(1), max_error=most)
        added = found.shapes[0].volume / 0.5**3  # where half of the longest side is 1
        radius = np.cbrt(3 * added / (4 * np.pi))
        assert found.errors[0] >= 0.3 * radius * 0.99
