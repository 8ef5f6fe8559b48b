"""Faces within a solid, as Merge by Distance leaves where boxes touch."""

from dataclasses import replace

import changes
import numpy as np
import pytest
import shapes
from brute_caster import BruteCaster
from computed import build_hulls, decompose, measure, prepare
from weak_convex_decomposition import DecompositionError, HullParameters, Parameters
from weak_convex_decomposition.core.sight.prepared import prepare_in_steps

# Places of unit boxes that touch, and the number of faces between them.
TOUCHING = {
    "pair": ([(0, 0, 0), (1, 0, 0)], 1),
    "L": ([(0, 0, 0), (1, 0, 0), (0, 0, 1)], 2),
    "eight": (list(np.ndindex(2, 2, 2)), 12),
    "deep": (list(np.ndindex(4, 4, 4)), 144),
}


def by_distance(mesh):
    """Return the mesh with places merged, and one of faces at the same place."""
    vertices, rows = np.unique(np.round(mesh.vertices, 9), axis=0, return_inverse=True)
    triangles = rows.reshape(-1)[mesh.triangles]
    _, kept = np.unique(np.sort(triangles, axis=1), axis=0, return_index=True)
    kept.sort()
    polygons = np.unique(mesh.polygons[kept], return_inverse=True)[1]
    return replace(
        mesh, vertices=vertices, triangles=triangles[kept], polygons=polygons
    )


def boxes_at(places):
    return shapes.joined(*(shapes.box(p, np.add(p, 1)) for p in places))


@pytest.mark.parametrize("turned", [False, True], ids=["outwards", "inside out"])
@pytest.mark.parametrize("name", TOUCHING)
def test_faces_between_boxes_bound_nothing(name, turned):
    places, n_walls = TOUCHING[name]
    mesh = by_distance(boxes_at(places))
    shape = prepare(changes.inside_out(mesh) if turned else mesh)
    assert len(shape.solid.triangles) == len(mesh.triangles) - 2 * n_walls
    assert shape.marcher.closed.all()
    assert shape.convex == (name != "L")
    assert f"{n_walls} face" in shape.notes[-1]
    assert shape.n_nodes == mesh.n_polygons


@pytest.mark.parametrize("name", TOUCHING)
def test_progress_never_goes_back(name):
    places = TOUCHING[name][0]
    doubled = shapes.joined(*[by_distance(boxes_at(places))] * 2)
    shares = [step.fraction for step in prepare_in_steps(doubled, BruteCaster)]
    assert shares == sorted(shares)


def test_boxes_wound_against_each_other_may_be_merged():
    pair = shapes.joined(
        shapes.box(), changes.inside_out(shapes.box((1, 0, 0), (2, 1, 1)))
    )
    assert prepare(by_distance(pair)).convex


def test_hulls_know_nothing_of_inner_faces():
    found = build_hulls(by_distance(boxes_at(TOUCHING["L"][0])), HullParameters())
    assert found.n_hulls == 2
    assert found.errors.max() < 0.05
    assert found.volume_ratio == pytest.approx(1.0, abs=0.01)
    assert "2 faces lie within" in found.notes[0]


def test_one_inner_face_is_said_in_the_singular():
    mesh = by_distance(boxes_at(TOUCHING["L"][0]))
    single = replace(mesh, polygons=0 * mesh.polygons)
    (note,) = prepare(single).notes
    assert note.startswith("1 face lies within the solid and bounds nothing;")


def test_inner_faces_have_parts_as_all_others():
    mesh = by_distance(boxes_at(TOUCHING["L"][0]))
    found = decompose(mesh, Parameters(parts=2, samples=300))
    assert len(found.labels) == mesh.n_polygons
    assert found.n_parts == 2


def test_parts_of_inner_faces_alone_get_no_hull_and_no_rank():
    mesh = by_distance(boxes_at(TOUCHING["L"][0]))
    outside = prepare(mesh).solid.polygons
    inner = ~np.isin(np.arange(mesh.n_polygons), outside)
    assert inner.sum() == 2
    parameters = HullParameters(pieces="PARTS")
    assert build_hulls(mesh, parameters, inner.astype(int)).parts.tolist() == [0]
    halves = (np.arange(mesh.n_polygons) % 2).astype(int)
    assert build_hulls(mesh, parameters, halves).n_hulls == 2
    with pytest.raises(DecompositionError, match="lie within the solid"):
        measure(mesh, Parameters(samples=100), inner)


@pytest.mark.parametrize("place", [(0.5, 0.5, 1.5), (2.5, 2.5, 2.5)])
def test_a_box_within_or_beside_a_box_stays(place):
    pair = shapes.joined(shapes.box((0, 0, 0), (2, 2, 2)), shapes.box(place, (3, 3, 3)))
    assert prepare(pair).notes == ()


def test_fins_and_open_boxes_keep_all_faces():
    """A fin on an edge, and a box without a lid with a wall across it."""
    box = shapes.box()
    fin = shapes.mesh_of([(0, 0, 1), (1, 0, 1), (1, -1, 2), (0, -1, 2)], [(0, 1, 2, 3)])
    assert len(prepare(by_distance(shapes.joined(box, fin))).solid.triangles) == 14
    crates = boxes_at(TOUCHING["pair"][0])
    crates = by_distance(changes.without(crates, lambda c: c[:, 2] > 0.999))
    assert len(prepare(crates).solid.triangles) == len(crates.triangles)
