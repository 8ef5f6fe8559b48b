"""Point clouds as objects: read, decomposed, written to and cleared."""

import bmesh
import bpy
import clouds
import numpy as np
import pytest
import shapes
from edited import notes_of, record_of
from hand_made import activate, in_mode, mesh_object
from scipy.spatial import ConvexHull
from snapshot import snapshot
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.bridge.mesh.attributes import write_attribute
from weak_convex_decomposition.operators.bridge.mesh.points import is_cloud
from weak_convex_decomposition.operators.bridge.parts.read import part_labels
from weak_convex_decomposition.operators.bridge.read.shape import read_shape

FAST = {"samples": 200, "parts": 2}
POINTS, NORMALS = clouds.drawn(shapes.dumbbell(), 900)


def points_object(points=POINTS, normals=NORMALS, name="normal"):
    obj = mesh_object("points", points, [])
    if normals is not None:
        write_attribute(obj.data, name, "FLOAT_VECTOR", "POINT", normals)
    return obj


def cloud_object(**values):
    obj = points_object(**values)
    bpy.ops.object.convert(target="POINTCLOUD")
    return bpy.context.active_object or obj


# Blender 4.2 has no way to make a point cloud object of points.
MAKERS = [points_object]
if bpy.app.version >= (5, 0):
    MAKERS.append(cloud_object)


def values_of(obj, name, field="value", width=1):
    attribute = obj.data.attributes[name]
    values = np.empty(len(attribute.data) * width, dtype=np.float32)
    attribute.data.foreach_get(field, values)
    return values.reshape(-1, width) if width > 1 else values.astype(int)


@pytest.mark.parametrize("make", MAKERS)
@pytest.mark.parametrize("name", ["normal", "Normal"])
def test_points_and_normals_are_read(make, name):
    obj = make(name=name)
    assert is_cloud(obj)
    cloud = read_shape(obj)
    assert cloud.points == pytest.approx(POINTS, abs=1e-5)
    assert cloud.normals == pytest.approx(NORMALS, abs=1e-5)


@pytest.mark.parametrize("make", MAKERS)
def test_normals_may_come_as_an_attribute_for_each_axis(make):
    obj = make(normals=None)
    for name, column in zip(("nx", "ny", "nz"), NORMALS.T, strict=True):
        assert read_shape(obj).normals is None
        attribute = obj.data.attributes.new(name, "FLOAT", "POINT")
        attribute.data.foreach_set("value", column.astype(np.float32))
    assert read_shape(obj).normals == pytest.approx(NORMALS, abs=1e-5)


def test_points_without_normals_have_none():
    assert read_shape(points_object(normals=None)).normals is None


def test_a_stretched_cloud_is_read_as_it_looks():
    obj = points_object()
    obj.scale = (1, 1, 3)
    bpy.context.view_layer.update()
    cloud = read_shape(obj)
    factors = np.array([1, 1, 3]) / 3 ** (1 / 3)  # they keep the volume
    assert cloud.points == pytest.approx(POINTS * factors, abs=1e-5)
    steep = NORMALS / (1, 1, 3)
    steep /= np.linalg.norm(steep, axis=1, keepdims=True)
    assert cloud.normals == pytest.approx(steep, abs=1e-5)


@pytest.mark.parametrize("make", MAKERS)
def test_parts_are_written_to_points(make):
    obj = make()
    assert bpy.ops.wcd.decompose(**FAST) == {"FINISHED"}
    parts = values_of(obj, "wcd_part")
    left = obj.data.attributes["wcd_part"].domain == "POINT" and POINTS[:, 0] < 2.9
    assert np.bincount(parts[left]).max() > 0.97 * left.sum()
    assert set(parts) == {0, 1}
    colors = values_of(obj, "wcd_color", "color", 4)
    assert len(np.unique(colors, axis=0)) == 2
    assert len(np.unique(np.c_[parts, colors], axis=0)) == 2
    record = record_of(obj)
    assert [p["faces"] for p in record["parts"]] == np.bincount(parts).tolist()
    assert [p["name"] for p in record["parts"]] == ["Part 01", "Part 02"]
    material = obj.data.materials[0]
    nodes = [n for n in material.node_tree.nodes if n.type == "ATTRIBUTE"]
    assert [node.attribute_name for node in nodes] == ["wcd_color"]
    assert nodes[0].outputs["Color"].is_linked
    assert "wcd_normal" not in obj.data.attributes


def test_points_of_a_mesh_get_groups():
    obj = points_object()
    bpy.ops.wcd.decompose(**FAST)
    parts = values_of(obj, "wcd_part")
    assert [group.name for group in obj.vertex_groups] == ["Part 01", "Part 02"]
    groups = [[g.group for g in vertex.groups] for vertex in obj.data.vertices]
    assert groups == [[part] for part in parts]


@pytest.mark.parametrize("make", MAKERS)
@pytest.mark.parametrize("runs", [1, 2])
def test_clear_brings_the_points_back(make, runs):
    obj = make()
    before = _state(obj)
    for _ in range(runs):
        bpy.ops.wcd.decompose(**FAST)
    assert len(obj.data.materials) == 1
    bpy.ops.wcd.clear()
    assert _state(obj) == before


def _state(obj):
    if obj.type == "MESH":
        return snapshot(obj)
    names = [(a.name, a.data_type, a.domain) for a in obj.data.attributes]
    return names, list(obj.keys()), len(obj.data.materials), len(bpy.data.materials)


def test_estimated_normals_are_offered_as_an_attribute():
    obj = points_object(normals=None)
    bpy.ops.wcd.decompose(**FAST)
    found = values_of(obj, "wcd_normal", "vector", 3)
    assert ((found * NORMALS).sum(axis=1) > 0).mean() > 0.97
    assert "estimated" in record_of(obj)["notes"][0]


def test_inward_normals_stay_as_they_are_and_turned_ones_are_offered():
    obj = points_object(normals=-NORMALS)
    bpy.ops.wcd.decompose(**FAST)
    assert values_of(obj, "normal", "vector", 3) == pytest.approx(-NORMALS, abs=1e-6)
    assert values_of(obj, "wcd_normal", "vector", 3) == pytest.approx(NORMALS, abs=1e-6)
    assert "face inwards" in record_of(obj)["notes"][0]


def test_measuring_points_leaves_only_the_record():
    obj = MAKERS[-1]()
    assert bpy.ops.wcd.measure(samples=200) == {"FINISHED"}
    assert record_of(obj)["measured"]["convexity_rank"] < 0.6
    assert "wcd_part" not in obj.data.attributes


BAD = {
    "empty": (np.zeros((0, 3)), None, "too few points"),
    "one point": (POINTS[:1], None, "too few points"),
    "coincident": (np.ones((50, 3)), None, "at one place"),
    "collinear": (POINTS * (1, 0, 0), None, "in a line"),
    "NaN": (clouds.changed(POINTS, 5, np.nan), None, "not finite"),
    "zero normals": (POINTS, 0 * NORMALS, "zero or not finite"),
}


@pytest.mark.parametrize("case", BAD)
@pytest.mark.parametrize("name", ["decompose", "measure"])
def test_bad_points_have_their_sentence_and_stay(case, name):
    points, normals, match = BAD[case]
    obj = points_object(points, normals)
    before = repr(snapshot(obj))
    with pytest.raises(RuntimeError, match=match):
        getattr(bpy.ops.wcd, name)()
    assert repr(snapshot(obj)) == before


if bpy.app.version >= (5, 0):

    def test_a_cloud_with_modifiers_is_told_of_no_choice_that_it_lacks():
        obj = cloud_object()
        obj.modifiers.new("Nodes", "NODES")
        bpy.ops.wcd.decompose(**FAST)
        notes = notes_of(obj)
        assert "without its modifiers (Nodes)" in notes
        assert "Mesh: Evaluated" not in notes


def test_an_attribute_of_the_users_is_refused():
    obj = points_object()
    write_attribute(obj.data, "wcd_color", "FLOAT_COLOR", "POINT", np.ones((900, 4)))
    before = snapshot(obj)
    with pytest.raises(RuntimeError, match="wcd_color that does not come from"):
        bpy.ops.wcd.decompose(**FAST)
    assert snapshot(obj) == before


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_points_that_get_faces_are_decomposed_anew(mode):
    obj = points_object()
    before = [attribute.name for attribute in obj.data.attributes]
    bpy.ops.wcd.decompose(**FAST)
    hull = ConvexHull(POINTS)
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    for corners in hull.simplices:
        bm.faces.new([bm.verts[corner] for corner in corners])
    bm.to_mesh(obj.data)
    bm.free()
    assert part_labels(obj) is None
    in_mode(obj, mode)
    bpy.ops.wcd.decompose(samples=200, parts=3)
    in_mode(obj, "OBJECT")
    assert obj.data.attributes["wcd_part"].domain == "FACE"
    assert set(part_labels(obj)) == {0, 1, 2}
    assert "wcd_color" not in obj.data.attributes
    bpy.ops.wcd.clear()
    left = [attribute.name for attribute in obj.data.attributes]
    assert not [name for name in left if name.startswith("wcd")]
    assert set(before) <= set(left)


def test_points_are_not_decomposed_in_edit_mode():
    points_object()
    bpy.ops.object.mode_set(mode="EDIT")
    with pytest.raises(RuntimeError, match="leave Edit Mode"):
        bpy.ops.wcd.decompose(**FAST)


def test_wires_are_no_clouds():
    mesh = bpy.data.meshes.new("wire")
    mesh.from_pydata(POINTS.tolist(), [(0, 1), (1, 2)], [])
    obj = bpy.data.objects.new("wire", mesh)
    bpy.context.collection.objects.link(obj)
    activate(obj)
    assert not is_cloud(obj)
    with pytest.raises(DecompositionError, match="no faces"):
        read_shape(obj)


@pytest.mark.parametrize("make", MAKERS)
def test_hulls_of_points_are_refused(make):
    activate(make())
    with pytest.raises(RuntimeError, match="Hulls need faces"):
        bpy.ops.wcd.build_hulls()
