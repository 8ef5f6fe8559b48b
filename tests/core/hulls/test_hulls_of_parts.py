"""Collision shapes by parts: one around each, of a kind of its own if asked for."""

import numpy as np
import shapes
from computed import build_hulls
from definitions import assert_convex, covered
from weak_convex_decomposition.core.cache import ShapeCache, no_rays
from weak_convex_decomposition.core.hulls.build import build_hulls_in_steps
from weak_convex_decomposition.core.hulls.outline import outline_of
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.steps.progress import run


def hulls_of(mesh, labels=None, **values):
    return build_hulls(mesh, HullParameters(**values), labels)


def test_one_shape_for_each_part():
    mesh = shapes.joined(shapes.box(), shapes.box((2, 0, 0), (4, 1, 1)))
    labels = np.repeat([1, 0], 6)
    found = hulls_of(mesh, labels, pieces="PARTS", max_error=0.001)
    assert [round(shape.volume, 3) for shape in found.shapes] == [2, 1]
    boxes = hulls_of(mesh, labels, pieces="PARTS", shape="BOX")
    assert [round(shape.volume, 3) for shape in boxes.shapes] == [2, 1]
    assert not found.notes + boxes.notes
    assert hulls_of(mesh, labels, pieces="PARTS", max_hulls=1).n_hulls == 1


def test_parts_that_share_hulls_are_told():
    starts = (0, 2, 4)
    mesh = shapes.joined(*(shapes.box((x, 0, 0), (x + 1, 1, 1)) for x in starts))
    found = hulls_of(mesh, np.repeat([0, 1, 2], 6), pieces="PARTS", max_hulls=2)
    assert found.n_hulls == 2
    assert found.notes == (
        "3 parts share 2 hulls, as Most Hulls = 2 allows no more; raise it for one"
        " each.",
    )


def test_parts_may_have_any_numbers():
    mesh = shapes.joined(shapes.box(), shapes.box((2, 0, 0), (4, 1, 1)))
    labels = np.repeat([10**12, 7], 6)
    for pieces in ("PARTS", "BY_ERROR"):
        found = hulls_of(mesh, labels, pieces=pieces)
        assert found.parts.tolist() == [7, 10**12]


def test_parts_that_are_no_solids_have_hulls():
    flat = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    line = [(5, 0, 0), (6, 0, 0), (7, 0, 0)]
    mesh = shapes.joined(
        shapes.mesh_of(flat, [(0, 1, 2)]),
        shapes.mesh_of(line, [(0, 1, 2)]),
        shapes.mesh_of([(9, 9, 9)] * 3, [(0, 1, 2)]),
        shapes.sheet(),
    )
    labels = np.minimum(np.arange(mesh.n_polygons), 3)
    for shape in ("HULL", "BOX", "SPHERE", "CYLINDER", "CAPSULE"):
        found = hulls_of(mesh, labels, pieces="PARTS", shape=shape)
        assert found.n_hulls == 4
        assert all(each.volume > 0 for each in found.shapes)
        assert covered(found.shapes, mesh.vertices).all()
        for each in found.shapes:
            assert_convex(outline_of(each))


def test_hulls_that_a_margin_would_make_vanish_are_told():
    mesh = shapes.joined(shapes.box(), shapes.box((2, 0, 0), (5, 3, 3)))
    volumes, notes = {}, {}
    for margin in (0.0, -0.4, -0.6):
        found = hulls_of(mesh, margin=margin)
        volumes[margin] = [round(each.volume, 3) for each in found.shapes]
        notes[margin] = found.notes
    assert volumes == {0.0: [27, 1], -0.4: [10.648, 0.008], -0.6: [5.832, 1]}
    assert notes[0.0] == ()
    (above,) = notes[-0.4]
    assert above.endswith(
        "Largest Error = 0.05, because Margin = -0.4 alone uses up Largest Error;"
        " choose a margin nearer to 0."
    )
    (above, _) = notes[-0.6]
    assert "uses up" in above
    assert notes[-0.6][1:] == (
        "Margin = -0.6 would make 1 of 2 hulls vanish, which keep their size; choose a"
        " value nearer to 0.",
    )
    (above, _) = hulls_of(mesh, margin=-10, max_hulls=1).notes
    assert "Margin" not in above
    assert "as many cuts as Most Hulls = 1 allows" in above
    boxes = hulls_of(mesh, margin=-0.6, shape="BOX")
    assert not any("vanish" in note for note in boxes.notes)


def test_shapes_are_those_of_their_parts_whatever_else_is_within():
    """Most of the surface within a hull may be that of another part."""
    ball = shapes.sphere(3)
    corners = [(x, y) for x in (-1.2, 1.1) for y in (-1.2, 1.1)]
    posts = [shapes.box((x, y, -1.2), (x + 0.1, y + 0.1, 1.2)) for x, y in corners]
    mesh = shapes.joined(ball, *posts)
    labels = (np.arange(mesh.n_polygons) >= ball.n_polygons).astype(np.int64)
    found = hulls_of(mesh, labels, pieces="PARTS")
    assert found.parts.tolist() == [1, 0]  # the largest comes first
    joined = hulls_of(mesh, labels, pieces="PARTS", max_hulls=1)
    assert joined.parts.tolist() == [1]


def test_a_margin_makes_hulls_alone_vanish_whatever_the_others_are():
    mesh = shapes.joined(shapes.box(), shapes.box((2, 0, 0), (3, 1, 1)))
    labels = np.repeat([0, 1], 6)
    vanishing = {}
    for one in ("HULL", "BOX"):
        for other in ("HULL", "BOX"):
            found = run(
                build_hulls_in_steps(
                    mesh,
                    HullParameters(pieces="PARTS", margin=-0.6, shape=one),
                    ShapeCache(no_rays),
                    labels,
                    kinds={1: other},
                )
            )
            vanishing[one, other] = found.notes
    assert vanishing.pop(("BOX", "BOX")) == ()
    for kinds, (note,) in vanishing.items():
        number = kinds.count("HULL")
        assert f"would make {number} of {number} hulls vanish" in note
