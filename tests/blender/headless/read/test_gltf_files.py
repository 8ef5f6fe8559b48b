"""What Blender's importer of glTF leaves out or adds."""

import json

import bpy
import pytest
from headless.loading import load
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.headless.formats import GLTF, enable


@pytest.fixture
def written(tmp_path):
    """Return a function that writes the scene as .gltf; it returns path and content."""

    def write():
        enable(GLTF)
        path = tmp_path / "a.gltf"
        bpy.ops.export_scene.gltf(filepath=str(path), export_format="GLTF_SEPARATE")
        return path, json.loads(path.read_text())

    return write


@pytest.mark.parametrize("first", [0, 1, None])
def test_objects_of_all_scenes_are_read_and_those_of_none(written, first):
    for place in range(3):
        bpy.ops.mesh.primitive_cube_add(location=(3 * place, 0, 0))
    path, content = written()
    content["scenes"] = [{"name": "A", "nodes": [0]}, {"name": "B", "nodes": [1]}]
    content["scene"] = first
    if first is None:
        del content["scene"]
    path.write_text(json.dumps(content))
    names = [node["name"] for node in content["nodes"]]
    assert [obj.name for obj in load(path)] == sorted(names)


def test_bones_bring_no_models(written):
    bpy.ops.object.armature_add()
    rig = bpy.context.active_object
    bpy.ops.mesh.primitive_cube_add()
    skin = bpy.context.active_object
    skin.name, skin.parent = "Skin", rig
    skin.modifiers.new("Armature", "ARMATURE").object = rig
    skin.vertex_groups.new(name="Bone").add(range(8), 1, "REPLACE")
    path, content = written()
    assert len(content["skins"]) == 1
    assert [obj.name for obj in load(path)] == ["Skin"]


def test_animated_nodes_are_where_their_animation_begins(written):
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.active_object
    for frame, place in ((0, 0), (24, 24)):
        cube.location.x = place
        cube.keyframe_insert("location", frame=frame)
    path, content = written()
    assert len(content["animations"]) == 1
    (obj,) = load(path)
    assert obj.matrix_world.translation.x == 0


@pytest.mark.parametrize("mesh", [1, -1])
def test_nodes_whose_mesh_is_missing_are_refused(written, mesh):
    bpy.ops.mesh.primitive_cube_add()
    path, content = written()
    content["nodes"].append({"mesh": mesh})
    content["scenes"][0]["nodes"].append(1)
    path.write_text(json.dumps(content))
    with pytest.raises(DecompositionError, match="a node whose mesh is missing"):
        load(path)
