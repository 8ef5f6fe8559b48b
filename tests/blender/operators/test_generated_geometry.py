"""Mesh: Evaluated on what modifiers make: nodes, instances and mirror images."""

import bpy
import numpy as np
import pytest
from edited import check_in_step, labels_of, notes_of, record_of
from hand_made import activate, mesh_object
from headless.instancing import scatter
from snapshot import snapshot
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.bridge.read.evaluated import read_as
from weak_convex_decomposition.operators.bridge.views.node_modifiers import (
    new_node_group,
)


def decompose(**settings):
    options = {"samples": 200, "containers": "HOLLOW"} | settings
    bpy.ops.wcd.decompose(**options, mesh="EVALUATED")
    return bpy.context.active_object


def nodes_on(obj, wire):
    """Give an object a modifier; `wire(add, link, given)` returns its geometry."""
    group = new_node_group("Made", "made")
    add, link = group.nodes.new, group.links.new
    made = wire(add, link, add("NodeGroupInput").outputs[0])
    link(made, add("NodeGroupOutput").inputs[0])
    obj.modifiers.new("Nodes", "NODES").node_group = group


def ball_on_a_stick(add, link, given):
    """Return other faces than those that there are."""
    ball, stick = add("GeometryNodeMeshUVSphere"), add("GeometryNodeMeshCylinder")
    stick.inputs["Radius"].default_value, stick.inputs["Depth"].default_value = 0.3, 6
    joined = add("GeometryNodeJoinGeometry")
    for each in (ball, stick):
        link(each.outputs["Mesh"], joined.inputs[0])
    return joined.outputs[0]


def twice(add, link, given):
    """Return two instances of what is given."""
    line, both = add("GeometryNodeMeshLine"), add("GeometryNodeInstanceOnPoints")
    line.inputs["Count"].default_value = 2
    line.inputs["Offset"].default_value = (0, 4, 0)
    link(line.outputs["Mesh"], both.inputs["Points"])
    link(given, both.inputs["Instance"])
    return both.outputs["Instances"]


@pytest.fixture
def triangle():
    """Return a large triangle; cubes at its corners are apart from each other."""
    corners = [(0, 0, 0), (9, 0, 0), (0, 9, 0)]
    return mesh_object("Triangle", corners, [(0, 1, 2)])


@pytest.fixture
def cone():
    bpy.ops.mesh.primitive_cone_add(location=(0, 0, 2), vertices=12)
    return bpy.context.active_object


def check_new_object(obj, n_faces, k):
    """Decompose what is seen, and check that its parts are on a new object."""
    before, groups = snapshot(obj), bpy.data.node_groups[:]
    carrier = decompose()
    assert carrier.name == f"{obj.name} parts"
    assert (len(carrier.data.polygons), record_of(carrier)["k"]) == (n_faces, k)
    assert f"with {n_faces:,} faces that do not come from the" in notes_of(carrier)
    check_in_step(carrier)
    bpy.ops.wcd.clear()
    assert snapshot(obj) == before
    assert bpy.data.node_groups[:] == groups


def test_what_nodes_make_gets_its_parts_on_a_new_object(cone):
    nodes_on(cone, ball_on_a_stick)
    check_new_object(cone, 512 + 34, 2)


@pytest.mark.parametrize(("joined", "n_faces", "k"), [(False, 18, 3), (True, 19, 4)])
def test_instances_are_parts_of_what_is_seen(triangle, joined, n_faces, k):
    scatter(triangle, joined)
    check_new_object(triangle, n_faces, k)


def test_instances_of_an_object_with_parts_bring_none_of_them(triangle, monkey):
    activate(triangle)
    monkey_parts = snapshot(monkey)
    scatter(triangle, source=monkey)
    check_new_object(triangle, 3 * 500, 3)
    assert snapshot(monkey) == monkey_parts


def test_instances_of_the_mesh_itself_give_their_parts_to_its_faces(cone):
    nodes_on(cone, twice)
    assert decompose(parts=2) == cone
    assert "26 faces that come from the 13 faces" in notes_of(cone)
    assert set(labels_of(cone)) == {0}
    check_in_step(cone)


def test_nodes_make_faces_where_the_mesh_has_none():
    scatter(mesh_object("Points", [(0, 0, 0), (9, 0, 0)], []))
    carrier = decompose()
    assert (carrier.name, record_of(carrier)["k"]) == ("Points parts", 2)
    check_in_step(carrier)


def test_instances_of_pinned_modifiers_count_and_all_stays_as_it_was(triangle):
    scatter(triangle)
    triangle.modifiers[0].use_pin_to_last = True
    triangle.modifiers.active = triangle.modifiers.new("Before", "TRIANGULATE")
    before = snapshot(triangle)
    assert len(read_as("EVALUATED", triangle).areas) == 18
    assert triangle.modifiers.active.name == "Before"
    assert snapshot(triangle) == before


def test_instances_of_other_objects_are_told_of(cone):
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.active_object.parent = cone
    cone.instance_type = "VERTS"
    activate(cone)
    cone.modifiers.new("Finer", "SUBSURF").levels = 1
    decompose(parts=2)
    n_vertices = 13 + 13 + 24  # of vertices, faces and edges
    assert f"{n_vertices} instances of other objects" in notes_of(cone)
    assert "Make Instances Real" in notes_of(cone)


def test_a_modifier_without_nodes_shows_the_mesh_itself(cone):
    cone.modifiers.new("Empty", "NODES")
    decompose(parts=2)
    assert [each.name for each in cone.modifiers] == ["Empty"]
    assert len(cone.wcd_parts) == 2


def test_a_tree_that_makes_no_faces_is_refused(cone):
    nodes_on(cone, lambda add, link, given: add("GeometryNodeMeshLine").outputs[0])
    before = snapshot(cone)
    with pytest.raises(DecompositionError, match="No faces of Cone are seen"):
        read_as("EVALUATED", cone)
    assert snapshot(cone) == before


def test_a_mirrored_half_has_the_parts_of_both_halves():
    bpy.ops.mesh.primitive_uv_sphere_add(segments=12, ring_count=8, location=(2, 0, 0))
    ball = bpy.context.active_object
    bpy.ops.mesh.primitive_cylinder_add(
        radius=0.2,
        depth=1.4,
        vertices=12,
        end_fill_type="NOTHING",
        location=(0.7, 0, 0),
        rotation=(0, np.pi / 2, 0),
    )
    ball.select_set(True)
    bpy.ops.object.join()
    bpy.ops.object.transform_apply()
    obj = bpy.context.active_object
    obj.modifiers.new("Mirror", "MIRROR")
    assert decompose(parts=3, samples=600) == obj
    n_own = len(obj.data.polygons)
    assert f"{2 * n_own} faces that come from the {n_own} faces" in notes_of(obj)
    assert "seen in several parts" in notes_of(obj)
    on_ball = [polygon.center.x > 1.5 for polygon in obj.data.polygons]
    check_in_step(obj)
    assert len(set(labels_of(obj)[on_ball])) == 1


def twin_of(obj):
    """Return an object with the same data, selected beside another."""
    twin = obj.copy()
    bpy.context.collection.objects.link(twin)
    activate(obj)
    twin.select_set(True)
    return twin


def test_objects_of_one_mesh_have_parts_of_their_own_faces(monkey):
    twin, plain = twin_of(monkey), twin_of(monkey)
    twin.select_set(True)
    for obj, size in ((monkey, 0.5), (twin, 0.3)):
        obj.modifiers.new("Remesh", "REMESH").voxel_size = size
    decompose(parts=2, samples=60)
    assert [len(obj.children) for obj in (monkey, twin, plain)] == [1, 1, 0]
    assert record_of(plain)["k"] == 2


def test_parts_on_a_shared_mesh_are_found_once(cone):
    twin = twin_of(cone)
    for obj, levels in ((cone, 1), (twin, 2)):
        obj.modifiers.new("Finer", "SUBSURF").levels = levels
    decompose(parts=2, samples=60)
    assert "with 48 faces that come from the 13 faces" in notes_of(twin)


def test_texts_that_share_letters_get_a_mesh_each():
    bpy.ops.object.text_add()
    text = bpy.context.active_object
    twin = twin_of(text)
    bpy.ops.wcd.decompose(samples=60, parts=2)
    assert [len(obj.children) for obj in (text, twin)] == [1, 1]
