"""Seams that turn inside a face: joining pieces keeps each bend and each part."""

import bpy
import numpy as np
import pytest
from edited import check_in_step, labels_of
from hand_made import areas, mesh_object
from mathutils.geometry import intersect_point_line
from random_work.checks import bone
from random_work.low_poly import low_poly
from snapshot import snapshot
from weak_convex_decomposition.core.geometry.cutting.refined import Cut
from weak_convex_decomposition.operators.bridge.cuts.cut_mesh import CutMesh

FAST = {"samples": 40, "containers": "HOLLOW", "max_parts": 4, "parts": 6}


def areas_by_part(made, n_parts):
    return np.bincount(made.parts(), made.areas(), n_parts)


def needless_vertices(obj, before):
    """Return the vertices that are not among those before, and bend no edge."""
    places = [vertex.co.copy() for vertex in obj.data.vertices]
    near = 1e-6 * max(abs(x) for place in places for x in place)
    ends = [[] for _ in places]
    for edge in obj.data.edges:
        one, other = edge.vertices
        ends[one].append(other)
        ends[other].append(one)
    old = {tuple(place) for place in before}
    needless = []
    for place, others in zip(places, ends, strict=True):
        if len(others) == 2 and tuple(place) not in old:
            line = (places[other] for other in others)
            if (place - intersect_point_line(place, *line)[0]).length < near:
                needless.append(place)
    return needless


@pytest.fixture
def kept(monkeypatch):
    """Note the area of each part before and after each time that pieces are joined."""
    noted, join = [], CutMesh.join

    def noting(self, parts):
        parts = list(parts)
        n_parts = max(parts) + 1
        before = np.bincount(parts, self.areas(), n_parts)
        join(self, parts)
        noted.append((before, areas_by_part(self, n_parts)))

    monkeypatch.setattr(CutMesh, "join", noting)
    return noted


@pytest.mark.parametrize("far", [0, 1000])
@pytest.mark.parametrize(
    ("quarters", "n_corners"),
    [([1, 0, 0, 0], [4, 6]), ([1, 1, 0, 0], [4, 4]), ([1, 0, 1, 0], [4, 4])],
)
def test_bends_of_a_seam_stay_and_straight_seams_get_none(quarters, n_corners, far):
    places = [(x + far, y, 0) for x, y in ((0, 0), (4, 0.3), (3.7, 4.3), (-0.3, 4))]
    mesh = mesh_object("Square", places, [(0, 1, 2, 3)]).data
    middle = np.array([1.9 + far, 2.1, 0.0])
    normals = np.array([[0.96, 0.28, 0.0], [-0.28, 0.96, 0.0]])
    with CutMesh(mesh, np.eye(3)) as made:
        made.cut([Cut(middle, each, np.array([0])) for each in normals], 1e-3)
        shape = made.triangles()
        inside = np.zeros((4, 3))  # a point of each piece
        inside[shape.polygons] = shape.vertices[shape.triangles].mean(axis=1)
        parts = np.array(quarters)[((inside - middle) @ normals.T > 0) @ [1, 2]]
        before = np.bincount(parts, made.areas(), 2)
        made.join(parts.tolist())
        assert areas_by_part(made, 2) == pytest.approx(before, rel=1e-4)
        made.write(mesh)
    assert sorted(len(polygon.vertices) for polygon in mesh.polygons) == n_corners


@pytest.mark.parametrize("scale", [(1, 1, 1), (1, -1, 1), (-1, -1, -1)])
def test_a_small_part_in_the_corner_of_a_face_is_not_lost(scale, kept):
    obj = bone()
    obj.scale = scale
    bpy.context.view_layer.update()
    before = snapshot(obj)
    assert bpy.ops.wcd.decompose(seams="CUT", **FAST) == {"FINISHED"}
    assert len(kept) > 1
    for pieces, joined in kept:
        assert joined == pytest.approx(pieces, rel=1e-5)
    check_in_step(obj)
    assert np.bincount(labels_of(obj), areas(obj.data)).min() > 0
    bpy.ops.wcd.clear()
    assert snapshot(obj) == before


@pytest.mark.parametrize("seed", [0, 2, 4, 12, 15])
def test_parts_keep_their_areas_and_no_vertex_is_needless(seed, kept):
    obj = low_poly(seed)
    before, places = snapshot(obj), [v.co.copy() for v in obj.data.vertices]
    bpy.ops.wcd.decompose(seams="CUT", **{**FAST, "samples": 200, "parts": 5})
    assert kept
    for pieces, joined in kept:
        assert joined == pytest.approx(pieces, rel=1e-5)
    assert not needless_vertices(obj, places)
    bpy.ops.wcd.clear()
    assert snapshot(obj) == before


def test_parts_that_joining_pieces_loses_are_left_out(monkeypatch):
    join = CutMesh.join
    monkeypatch.setattr(
        CutMesh, "join", lambda self, parts: join(self, [min(p, 2) for p in parts])
    )
    obj = bone()
    assert bpy.ops.wcd.decompose(seams="CUT", **FAST) == {"FINISHED"}
    assert len(obj.wcd_parts) == 3
    check_in_step(obj)
