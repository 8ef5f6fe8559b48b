"""Files of hulls: hulls are where their objects are, wherever these hang or are."""

import bpy
import numpy as np
import pytest
import trimesh
from hand_made import build_hulls, in_scene
from headless.command import run_wcd
from headless.loading import load
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parameters.bodies import BodyParameters
from weak_convex_decomposition.operators.headless.write import hull_files
from weak_convex_decomposition.operators.headless.write.collider_marks import mark_glb

FRAME = 11


def cube(name, x):
    bpy.ops.mesh.primitive_cube_add(location=(x, 0, 0))
    obj = bpy.context.active_object
    obj.name = name
    return obj


def keyed(obj, height):
    """Let an object rise to a height by `FRAME`."""
    obj.keyframe_insert("location", frame=1)
    obj.location.z = height
    obj.keyframe_insert("location", frame=FRAME)
    return obj


def add_armature():
    """Add an armature whose only bone is posed."""
    bpy.ops.object.armature_add(location=(20, 0, 0))
    rig = bpy.context.active_object
    rig.pose.bones[0].location = (0, 5, 3)
    rig.pose.bones[0].rotation_mode = "XYZ"
    rig.pose.bones[0].rotation_euler = (0.5, 0.2, 0)
    return rig


def add_moving():
    """Add cubes that keyframes, a driver, parents and a bone move."""
    keyed(cube("Keyed", 0), 5)
    driver = cube("Driven", 5).driver_add("location", 2).driver
    driver.expression = "frame * 1.0"
    empty = bpy.data.objects.new("Empty", None)
    bpy.context.collection.objects.link(empty)
    empty.scale = (1, 2, 3)
    keyed(empty, 7)
    child = cube("Child", 10)
    child.parent, child.rotation_euler.x = empty, 0.7
    rig, held = add_armature(), cube("Held", 1)
    held.parent, held.parent_type, held.parent_bone = rig, "BONE", "Bone"
    bpy.context.scene.frame_set(FRAME)
    bpy.context.view_layer.update()
    return [bpy.data.objects[name] for name in ("Keyed", "Driven", "Child", "Held")]


def boxes_in(path, words=()):
    """Return the boxes of the hulls that a run writes, by the names of the objects."""
    model = path.with_name("model.blend")
    assert run_wcd(model, f"--hulls={path}", "--quiet", *words) == 0
    found = {}
    for obj in load(path):
        places = in_scene(obj)
        ends = places.min(axis=0), places.max(axis=0)
        found[obj.name.replace("_", " ").partition(" ")[0]] = np.concatenate(ends)
    return found


def test_glb_has_hulls_where_the_objects_are(tmp_path):
    add_moving()
    another = bpy.data.scenes.new("Another")
    other = cube("Other", 30)
    bpy.context.scene.collection.objects.unlink(other)
    another.collection.objects.link(other)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "model.blend"), copy=True)
    found = boxes_in(tmp_path / "hulls.glb")
    expected = boxes_in(tmp_path / "hulls.obj")
    assert sorted(found) == ["Child", "Driven", "Held", "Keyed", "Other"]
    assert expected["Keyed"][2] == pytest.approx(4)
    for name, box in found.items():
        assert box == pytest.approx(expected[name], abs=1e-4), name


def box_of(obj):
    places = in_scene(obj)
    return np.concatenate([places.min(axis=0), places.max(axis=0)])


def test_glb_of_a_model_has_its_hulls_where_it_is(tmp_path):
    """One object hangs on a mesh of a collection that is left out."""
    names = sorted(obj.name for obj in add_moving())
    left_out = bpy.data.collections.new("Left out")
    bpy.context.scene.collection.children.link(left_out)
    above, below = cube("Above", 50), cube("Below", 3)
    bpy.context.scene.collection.objects.unlink(above)
    left_out.objects.link(above)
    below.parent = above
    bpy.context.view_layer.layer_collection.children["Left out"].exclude = True
    model = tmp_path / "model.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(model), copy=True)
    path = tmp_path / "both.glb"
    assert run_wcd(model, f"--output={path}", "--with-hulls", "--quiet") == 0
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(path))
    bpy.context.view_layer.update()
    objects = {obj.name: obj for obj in bpy.data.objects if obj.type == "MESH"}
    hulls = {name for name in objects if name.endswith(" hull 01")}
    assert {name.partition(" ")[0] for name in hulls} == {"Below", *names}
    for name in hulls:
        box = box_of(objects[name.partition(" ")[0]])
        assert box_of(objects[name]) == pytest.approx(box, abs=1e-4), name


def boxes_of_nodes(path):
    """Return the boxes of what is in a .glb file, by the first words of its names."""
    scene = trimesh.load(path)
    found = {}
    for name in scene.graph.nodes_geometry:
        matrix, mesh = scene.graph[name]
        solid = scene.geometry[mesh].copy().apply_transform(matrix)
        found[name.partition(" ")[0]] = solid.bounds
    return found


def test_glb_of_a_model_alone_is_where_its_hulls_are_in_another_file(tmp_path):
    names = sorted(obj.name for obj in add_moving())
    model = tmp_path / "model.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(model), copy=True)
    paths = tmp_path / "model.glb", tmp_path / "hulls.glb"
    words = [f"--output={paths[0]}", f"--hulls={paths[1]}", "--quiet"]
    assert run_wcd(model, *words) == 0
    found, expected = map(boxes_of_nodes, paths)
    assert sorted(found) == sorted(expected) == names
    for name, box in found.items():
        assert box == pytest.approx(expected[name], abs=1e-4), name


@pytest.mark.parametrize("words", [[], ["--with-hulls"]])
def test_glb_has_skins_at_rest_as_hulls_are_around_them(tmp_path, words):
    rig, skin = add_armature(), cube("Skin", 20)
    skin.modifiers.new("Armature", "ARMATURE").object = skin.parent = rig
    skin.vertex_groups.new(name="Bone").add(range(8), 1, "REPLACE")
    model, path = tmp_path / "model.blend", tmp_path / "model.glb"
    bpy.ops.wm.save_as_mainfile(filepath=str(model), copy=True)
    assert run_wcd(model, f"--output={path}", "--quiet", *words) == 0
    matrix, _ = trimesh.load(path).graph.get("Bone", "Armature")
    assert matrix == pytest.approx(np.eye(4), abs=1e-6)


def test_the_scene_is_as_before(tmp_path):
    hulls = build_hulls(add_moving(), max_hulls=1)
    bpy.context.scene.frame_set(FRAME, subframe=0.25)
    before = [(hull.parent, hull.matrix_world.copy()) for hull in hulls]
    hull_files.save_hulls(tmp_path / "a.glb", hulls, None, BodyParameters())
    assert bpy.context.scene.frame_current_final == FRAME + 0.25
    for hull, (parent, matrix) in zip(hulls, before, strict=True):
        assert hull.parent == parent
        assert hull.matrix_world == matrix


def test_hulls_that_are_left_out_are_an_error(tmp_path, monkeypatch):
    hulls = build_hulls([cube("A", 0), cube("B", 5)], max_hulls=1)
    path, select_only = tmp_path / "a.glb", hull_files.select_only
    hull_files.save_hulls(path, hulls, None, BodyParameters())
    with pytest.raises(DecompositionError, match="2 of 3 hulls"):
        mark_glb(path, 3)
    path.unlink()
    monkeypatch.setattr(hull_files, "select_only", lambda some: select_only(some[:1]))
    with pytest.raises(DecompositionError, match="1 of 2 hulls"):
        hull_files.save_hulls(path, hulls, None, BodyParameters())
    assert list(tmp_path.iterdir()) == []
