import bpy
import numpy as np
import pytest
import shapes
from hand_made import activate, decompose_by_hand, in_mode, mesh_object
from snapshot import snapshot
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of


@pytest.fixture
def table():
    mesh = shapes.table()
    obj = mesh_object("table", mesh.vertices.tolist(), mesh.triangles.tolist())
    obj.location = (0, 0, 5)
    bpy.context.view_layer.update()
    return obj


def test_the_object_falls_as_its_hulls_do(table):
    bpy.ops.wcd.build_hulls()
    assert bpy.ops.wcd.make_rigid() == {"FINISHED"}
    assert table.rigid_body.collision_shape == "COMPOUND"
    hulls = hulls_of(table)
    assert len(hulls) >= 2
    assert {hull.rigid_body.collision_shape for hull in hulls} == {"CONVEX_HULL"}
    # A post between the legs, which only a table that is hollow below gets over.
    size = np.ptp([v.co for v in table.data.vertices], axis=0)
    middle = np.mean([v.co for v in table.data.vertices], axis=0)
    bpy.ops.mesh.primitive_plane_add(size=100)
    bpy.ops.rigidbody.object_add(type="PASSIVE")
    height = 0.4 * size[2]
    bpy.ops.mesh.primitive_cube_add(
        size=1, location=(*middle[:2], height / 2), scale=(0.5, 0.5, height)
    )
    bpy.ops.rigidbody.object_add(type="PASSIVE")
    scene = bpy.context.scene
    for frame in range(1, 80):
        scene.frame_set(frame)
    low = min(
        (
            table.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world
            @ v.co
        ).z
        for v in table.data.vertices
    )
    assert abs(low) < 0.1


def test_clear_takes_the_bodies_back(table):
    before = snapshot(table)
    collections = len(bpy.data.collections)
    bpy.ops.wcd.build_hulls(max_hulls=2, max_error=0.5)
    bpy.ops.wcd.make_rigid(kind="PASSIVE")
    bpy.ops.wcd.make_rigid(kind="ACTIVE")
    assert table.rigid_body.type == "ACTIVE"
    bpy.ops.wcd.build_hulls(max_hulls=2, max_error=0.5)
    assert table.rigid_body is None
    bpy.ops.wcd.make_rigid()
    bpy.ops.wcd.clear()
    assert table.rigid_body is None
    assert bpy.context.scene.rigidbody_world is None
    assert snapshot(table) == before
    assert len(bpy.data.collections) == collections


def test_the_users_simulation_stays(table):
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.active_object
    bpy.ops.rigidbody.object_add()
    activate(table)
    bpy.ops.wcd.build_hulls(max_hulls=2, max_error=0.5)
    bpy.ops.wcd.make_rigid()
    bpy.ops.wcd.clear()
    assert list(bpy.context.scene.rigidbody_world.collection.objects) == [cube]


def test_the_users_rigid_body_is_refused(table):
    bpy.ops.rigidbody.object_add()
    bpy.ops.wcd.build_hulls(max_hulls=2, max_error=0.5)
    with pytest.raises(RuntimeError, match="is a rigid body already"):
        bpy.ops.wcd.make_rigid()
    assert table.rigid_body.collision_shape == "CONVEX_HULL"
    bpy.ops.wcd.clear()
    assert table.rigid_body is not None


def test_hulls_and_object_mode_are_needed(table):
    with pytest.raises(RuntimeError, match="has no hulls"):
        bpy.ops.wcd.make_rigid()
    bpy.ops.wcd.build_hulls(max_hulls=1)
    in_mode(table, "EDIT")
    with pytest.raises(RuntimeError, match="Object Mode"):
        bpy.ops.wcd.make_rigid()


def test_hulls_and_pieces_of_a_rigid_body_are_beside_it_and_are_none(suzanne):
    home = bpy.data.collections.new("Walls")  # comes after "RigidBodyWorld"
    bpy.context.scene.collection.children.link(home)
    home.objects.link(suzanne)
    for other in suzanne.users_collection:
        if other != home:
            other.objects.unlink(suzanne)
    bpy.ops.rigidbody.object_add()
    decompose_by_hand(suzanne, 3)
    bpy.context.scene.wcd.samples = 100
    bpy.ops.wcd.build_hulls(pieces="PARTS")
    bpy.ops.wcd.separate()
    assert {each.name for each in home.children} == {"Suzanne hulls", "Suzanne parts"}
    for each in home.all_objects:
        assert each.name in bpy.context.view_layer.objects


def test_pieces_of_an_object_whose_hulls_are_a_rigid_body_are_none(suzanne):
    decompose_by_hand(suzanne, 3)
    bpy.context.scene.wcd.samples = 100
    bpy.ops.wcd.build_hulls(pieces="PARTS")
    bpy.ops.wcd.make_rigid()
    bpy.ops.wcd.separate()
    pieces = bpy.data.collections["Suzanne parts"].objects
    assert not any(piece.rigid_body or "wcd_rigid" in piece for piece in pieces)
    assert suzanne.rigid_body is not None


def test_another_scene_takes_the_bodies_back(table):
    bpy.ops.wcd.build_hulls(max_hulls=2, max_error=0.5)
    bpy.ops.wcd.make_rigid()
    scene, other = bpy.context.scene, bpy.data.scenes.new("other")
    other.collection.objects.link(table)
    with bpy.context.temp_override(scene=other, view_layer=other.view_layers[0]):
        activate(table)
        bpy.ops.wcd.remove_hulls()
    assert table.rigid_body is None
    assert scene.rigidbody_world is None
    assert list(bpy.data.objects) == [table]


def test_a_simulation_of_the_user_stays_that_has_no_bodies_yet(table):
    bpy.ops.rigidbody.world_add()
    world = bpy.context.scene.rigidbody_world
    world.collection = mine = bpy.data.collections.new("Mine")
    activate(table)
    bpy.ops.wcd.build_hulls(max_hulls=2, max_error=0.5)
    bpy.ops.wcd.make_rigid()
    bpy.ops.wcd.clear()
    assert bpy.context.scene.rigidbody_world.collection == mine


def test_the_object_falls_on_while_it_has_other_hulls(table):
    bpy.ops.wcd.build_hulls()
    bpy.ops.wcd.make_rigid()
    first, *others = hulls_of(table)
    bpy.ops.wcd.remove_hull(hull=first.name)
    assert others
    assert None not in [each.rigid_body for each in (table, *others)]


def test_a_body_that_the_user_put_in_place_of_ours_stays(table):
    bpy.ops.wcd.build_hulls()
    bpy.ops.wcd.make_rigid()
    bpy.ops.rigidbody.object_remove()
    bpy.ops.rigidbody.object_add(type="PASSIVE")
    table.rigid_body.collision_shape = "MESH"
    bpy.ops.wcd.clear()
    assert table.rigid_body.collision_shape == "MESH"
    assert "wcd_rigid" not in table


def test_an_override_that_cannot_be_edited_is_refused(table, tmp_path):
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, into):
        into.objects = ["table"]
    scene, layer = bpy.context.scene, bpy.context.view_layer
    scene.collection.objects.link(into.objects[0])
    table = into.objects[0].override_hierarchy_create(scene, layer)
    activate(table)
    bpy.ops.wcd.build_hulls(max_hulls=2, max_error=0.5)
    before = snapshot(table)
    with pytest.raises(RuntimeError, match="override of a library that cannot be"):
        bpy.ops.wcd.make_rigid()
    assert snapshot(table) == before
    table.override_library.is_system_override = False
    assert bpy.ops.wcd.make_rigid() == {"FINISHED"}
