"""Mesh: Evaluated finds parts on what is seen, and writes them where they belong."""

import bpy
import numpy as np
import pytest
from edited import check_in_step, labels_of, notes_of, record_of
from hand_made import activate, build_hulls, face_values, in_mode, subdivided_suzanne
from mathutils import Matrix
from snapshot import snapshot
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.bridge.read.evaluated import read_as
from weak_convex_decomposition.operators.bridge.read.shape import read_shape
from weak_convex_decomposition.operators.bridge.read.shown_mesh import differs

FAST = {"samples": 200, "containers": "HOLLOW"}


def decompose(**settings):
    bpy.ops.wcd.decompose(**(FAST | settings), mesh="EVALUATED")
    return bpy.context.active_object


@pytest.fixture
def dumbbell():
    """Return two balls that a bar joins."""
    for x in (-2, 2):
        bpy.ops.mesh.primitive_uv_sphere_add(
            segments=12, ring_count=8, location=(x, 0, 0)
        )
    bpy.ops.mesh.primitive_cylinder_add(
        radius=0.2, depth=3, vertices=12, rotation=(0, np.pi / 2, 0)
    )
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.join()
    return bpy.context.active_object


def test_parts_of_finer_faces_come_back_to_the_faces_they_come_from(suzanne):
    suzanne.modifiers.new("Finer", "SUBSURF").levels = 1
    before = snapshot(suzanne)
    assert decompose(parts=5) == suzanne
    check_in_step(suzanne)
    record = record_of(suzanne)
    assert (record["mesh"], record["k"]) == ("EVALUATED", 5)
    n_seen, n_own = 1968, len(suzanne.data.polygons)
    assert f"{n_seen:,} faces that come from the {n_own} faces" in notes_of(suzanne)
    labels = labels_of(suzanne)
    bpy.ops.wcd.clear()
    assert snapshot(suzanne) == before
    finer = subdivided_suzanne(1)
    bpy.ops.wcd.decompose(**FAST, parts=5)
    counts = np.bincount(labels) / n_own
    assert np.allclose(counts, np.bincount(labels_of(finer)) / n_seen, atol=0.05)


def test_copies_that_share_a_face_agree_on_its_part(dumbbell):
    copies = dumbbell.modifiers.new("Copies", "ARRAY")
    copies.relative_offset_displace = (0, 2, 0)
    decompose(parts=6, samples=1200)  # with 200, balls fall apart on some machines
    check_in_step(dumbbell)
    assert record_of(dumbbell)["k"] == 3
    assert "seen in several parts" in notes_of(dumbbell)
    assert "3 parts got none" in notes_of(dumbbell)
    for shell in np.split(face_values(dumbbell.data, "wcd_part"), [96, 192]):
        assert (shell == np.bincount(shell).argmax()).mean() > 0.85


def test_other_faces_get_their_parts_on_a_new_object(dumbbell):
    dumbbell.modifiers.new("Remesh", "REMESH").voxel_size = 0.15
    dumbbell.scale = (1, 2, 1)
    before, objects = snapshot(dumbbell), bpy.data.objects[:]
    bpy.ops.ed.undo_push(message="before")
    carrier = decompose(parts=3)
    assert (carrier.name, carrier.parent) == (f"{dumbbell.name} parts", dumbbell)
    bpy.context.view_layer.update()
    assert carrier.matrix_world == dumbbell.matrix_world
    check_in_step(carrier)
    assert record_of(carrier)["mesh"] == "EVALUATED"
    assert f"{dumbbell.name} is hidden" in notes_of(carrier)
    assert (dumbbell.hide_get(), dumbbell.hide_render) == (True, True)
    bpy.ops.wcd.clear()
    assert bpy.data.objects[:] == objects
    assert bpy.context.active_object == dumbbell
    assert (dumbbell.hide_get(), dumbbell.hide_render) == (False, False)
    assert snapshot(dumbbell) == before
    assert [mesh.name for mesh in bpy.data.meshes if mesh.users] == [dumbbell.data.name]


def test_one_undo_takes_the_new_object_back(dumbbell):
    dumbbell.modifiers.new("Remesh", "REMESH").voxel_size = 0.15
    name = dumbbell.name
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.wcd.decompose("EXEC_DEFAULT", True, **FAST, mesh="EVALUATED", parts=3)
    bpy.ops.ed.undo()
    assert f"{name} parts" not in bpy.context.scene.objects
    assert bpy.data.objects[name].visible_get()


def pose(obj):
    """Bend an object by a shape key, and by the bone of an armature."""
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Longer")
    for point in key.data:
        point.co.x *= 3
    key.value = 1.0
    bpy.ops.object.armature_add()
    rig = bpy.context.active_object
    rig.pose.bones[0].matrix_basis = Matrix.Translation((0, 0, 2))
    obj.vertex_groups.new(name=rig.pose.bones[0].name).add(range(10), 1.0, "REPLACE")
    obj.modifiers.new("Rig", "ARMATURE").object = rig
    activate(obj)


def test_keys_and_poses_move_what_is_read(dumbbell):
    pose(dumbbell)
    seen = read_as("EVALUATED", dumbbell)
    assert (seen.origins == np.arange(len(dumbbell.data.polygons))).all()
    own = read_shape(dumbbell).vertices
    moved = seen.shape.vertices - own * (3, 1, 1)
    assert np.abs(moved[10:]).max() < 1e-5
    assert np.ptp(moved[:10], axis=0).max() < 1e-5 < np.linalg.norm(moved[0])
    assert read_as("ORIGINAL", dumbbell) is None
    decompose(parts=3)
    check_in_step(dumbbell)
    assert "Basis" not in notes_of(dumbbell)


def test_exploded_views_are_not_part_of_what_is_seen(dumbbell):
    decompose(parts=3)
    bpy.ops.wcd.explode(distance=1.0)
    assert not differs(dumbbell)
    dumbbell.modifiers.new("Finer", "SUBSURF").levels = 1
    dumbbell.modifiers.move(1, 0)
    seen = read_as("EVALUATED", dumbbell)
    assert np.ptp(seen.shape.vertices[:, 0]) < 6.1
    assert dumbbell.modifiers["Exploded View"].show_viewport


def test_locked_parts_stay_where_they_are(dumbbell):
    decompose(parts=3)
    part = face_values(dumbbell.data, "wcd_part")
    row = dumbbell.wcd_parts[0]
    row.locked, number = True, row.number
    dumbbell.modifiers.new("Finer", "SUBSURF").levels = 1
    decompose(parts=4)
    check_in_step(dumbbell)
    now = face_values(dumbbell.data, "wcd_part")
    assert ((part == number) == (now == number)).all()
    assert record_of(dumbbell)["mesh"] == "EVALUATED"


def test_live_takes_the_mesh_that_is_set(dumbbell):
    dumbbell.modifiers.new("Finer", "SUBSURF").levels = 1
    settings = bpy.context.scene.wcd
    for name, value in FAST.items():
        setattr(settings, name, value)
    bpy.ops.wcd.decompose(**FAST, parts=3)
    assert record_of(dumbbell)["mesh"] == "ORIGINAL"
    settings.parts = 3
    settings.live = True
    settings.mesh = "EVALUATED"
    assert record_of(dumbbell)["mesh"] == "EVALUATED"
    dumbbell.modifiers.new("Remesh", "REMESH").voxel_size = 0.15
    with pytest.raises(RuntimeError, match="press Decompose to have parts on a new"):
        bpy.ops.wcd.choose_part_count(parts=4)
    settings.property_unset("mesh")


def test_figures_are_out_of_date_once_the_mesh_changes(dumbbell):
    dumbbell.modifiers.new("Finer", "SUBSURF").levels = 1
    decompose(parts=3)
    dumbbell.data.transform(Matrix.Diagonal((1, 2, 1, 1)))
    bpy.ops.wcd.refresh_parts()
    check_in_step(dumbbell)
    assert record_of(dumbbell)["mesh"] == "EVALUATED"  # where they were found


def test_an_edit_keeps_the_mesh_that_the_parts_were_found_on(dumbbell):
    dumbbell.modifiers.new("Finer", "SUBSURF").levels = 1
    decompose(parts=3)
    for row in dumbbell.wcd_parts[:2]:
        row.chosen = True
    bpy.ops.wcd.merge_parts()
    record = record_of(dumbbell)
    assert (record["k"], record["mesh"]) == (2, "EVALUATED")
    bpy.ops.wcd.decompose(**FAST, parts=3)
    assert record_of(dumbbell)["mesh"] == "ORIGINAL"


def test_hulls_go_around_what_is_seen(dumbbell):
    dumbbell.modifiers.new("Copies", "ARRAY").relative_offset_displace = (0, 2, 0)
    hulls = build_hulls([dumbbell], mesh="EVALUATED", max_error=0.2)
    reach = [max(v.co.y for v in hull.data.vertices) for hull in hulls]
    assert max(reach) > 4
    assert record_of(dumbbell)["hulls"]["mesh"] == "EVALUATED"
    n_faces = 2 * len(dumbbell.data.polygons)
    told = f"The evaluated mesh was read, with {n_faces} faces."
    assert told in record_of(dumbbell)["hulls"]["notes"]
    name, error = hulls[0].name, record_of(dumbbell)["hulls"]["hulls"][0]["error"]
    bpy.ops.wcd.refit_hull(hull=name, shape="HULL")
    again = record_of(dumbbell)["hulls"]["hulls"][0]["error"]
    assert again == pytest.approx(error, rel=0.1)


def test_faces_of_a_linked_mesh_are_known(dumbbell, tmp_path):
    path, name = str(tmp_path / "library.blend"), dumbbell.name
    bpy.data.libraries.write(path, {dumbbell})
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = [name]
    obj = wanted.objects[0].copy()
    bpy.context.collection.objects.link(obj)
    obj.modifiers.new("Finer", "SUBSURF").levels = 1
    mesh = obj.data
    assert read_as("EVALUATED", obj).corresponds
    assert (obj.data, bpy.data.meshes[:]) == (mesh, [mesh])


@pytest.mark.parametrize("obstacle", ["EDIT", "hidden", "nothing"])
def test_what_cannot_be_read_leaves_all_as_it_was(dumbbell, obstacle):
    dumbbell.modifiers.new("Finer", "SUBSURF")
    if obstacle == "nothing":
        mask, group = dumbbell.modifiers.new("None", "MASK"), "all"
        dumbbell.vertex_groups.new(name=group).add(range(999), 1.0, "REPLACE")
        mask.vertex_group, mask.invert_vertex_group = group, True
    dumbbell.hide_set(obstacle == "hidden")
    in_mode(dumbbell, "EDIT" if obstacle == "EDIT" else "OBJECT")
    in_mode(dumbbell, "OBJECT")
    before = snapshot(dumbbell)
    in_mode(dumbbell, "EDIT" if obstacle == "EDIT" else "OBJECT")
    with pytest.raises(DecompositionError, match="set Mesh to Original"):
        read_as("EVALUATED", dumbbell)
    in_mode(dumbbell, "OBJECT")
    assert snapshot(dumbbell) == before
