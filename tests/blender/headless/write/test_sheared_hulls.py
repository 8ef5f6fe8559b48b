"""Hulls of objects that their parents shear, in formats that cannot tell it."""

import bpy
import numpy as np
import pytest
import trimesh
from hand_made import build_hulls, mesh_object
from weak_convex_decomposition.core.parameters.bodies import BodyParameters
from weak_convex_decomposition.operators.bridge.hulls.listed import is_hull
from weak_convex_decomposition.operators.headless.read.known_hulls import adopt_hulls
from weak_convex_decomposition.operators.headless.shear import without_parents
from weak_convex_decomposition.operators.headless.write.hull_files import save_hulls
from weak_convex_decomposition.operators.headless.write.model_files import save

VOLUME = 24.0  # that of a cube with a side of 2, three times as long along x


def add_sheared(name):
    """Return a cube that is turned within a parent which is longer along x."""
    parent = bpy.data.objects.new(f"{name} parent", None)
    bpy.context.collection.objects.link(parent)
    parent.scale = 3, 1, 1
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.active_object
    cube.name, cube.parent, cube.rotation_euler.z = name, parent, 0.7
    bpy.context.view_layer.update()
    return cube


def places(obj):
    """Return the vertices of an object in the world, sorted."""
    bpy.context.view_layer.update()
    found = np.array([obj.matrix_world @ v.co for v in obj.data.vertices])
    return np.unique(found.round(4), axis=0)


def solid(points):
    return trimesh.convex.convex_hull(points)


def test_glb_of_hulls_has_their_shape(tmp_path):
    (hull,) = build_hulls([add_sheared("Box")], max_hulls=1)
    mesh, expected = hull.data, places(hull)
    save_hulls(tmp_path / "hulls.glb", [hull], None, BodyParameters())
    read = trimesh.load(tmp_path / "hulls.glb").to_geometry()
    x, y, z = expected.T
    assert read.bounds.T.ravel() == pytest.approx(
        [x.min(), x.max(), z.min(), z.max(), (-y).min(), (-y).max()], abs=1e-4
    )
    assert solid(read.vertices).volume == pytest.approx(VOLUME, rel=1e-4)
    assert hull.data == mesh
    assert len(bpy.data.meshes) == 2


@pytest.mark.parametrize("ending", [".fbx", ".glb", ".blend"])
def test_models_with_hulls_have_their_shape(tmp_path, ending):
    (hull,) = build_hulls([add_sheared("Box")], max_hulls=1)
    mesh, expected = hull.data, places(hull)
    path = tmp_path / f"both{ending}"
    save(path, None, [hull])
    assert hull.data == mesh
    assert places(hull) == pytest.approx(expected)
    _read(path)
    (found,) = (obj for obj in bpy.data.objects if "Box_01" in obj.name or is_hull(obj))
    assert solid(places(found)).volume == pytest.approx(VOLUME, rel=1e-3)
    assert places(found) == pytest.approx(expected, abs=1e-3)


def _read(path):
    """Read a file by Blender's own importers."""
    if path.suffix == ".blend":
        bpy.ops.wm.open_mainfile(filepath=str(path))
        return
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    if path.suffix == ".fbx":
        bpy.ops.import_scene.fbx(filepath=str(path))
    else:
        bpy.ops.import_scene.gltf(filepath=str(path))


def test_hulls_of_others_keep_their_shear():
    hull = add_sheared("UCX_Model_01")
    model = mesh_object("Model", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    model.location = 1, 2, 3
    before = places(hull)
    adopt_hulls()
    assert hull.parent == model
    assert places(hull) == pytest.approx(before, abs=1e-4)


def armature():
    """Return an armature with a bone that points up and begins at z = 5."""
    bpy.ops.object.armature_add(enter_editmode=True)
    obj = bpy.context.active_object
    (bone,) = obj.data.edit_bones
    bone.head, bone.tail = (0, 0, 5), (0, 0, 7)
    bpy.ops.object.mode_set(mode="OBJECT")
    return obj


@pytest.mark.parametrize("kind", ["OBJECT", "BONE", "VERTEX", "VERTEX_3"])
def test_objects_hang_on_their_parents_again(kind):
    cube = mesh_object("Cube", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    above = [(0, 0, 5), (1, 0, 5), (0, 2, 5)]
    parent = armature() if kind == "BONE" else mesh_object("Above", above, [(0, 1, 2)])
    cube.parent, cube.parent_type, cube.location.x = parent, kind, 3
    if kind == "BONE":
        cube.parent_bone = parent.data.bones[0].name
    cube.parent_vertices = (1, 2, 0)
    bpy.context.view_layer.update()
    before = places(cube)
    assert kind == "OBJECT" or before[0, 2] >= 4
    with without_parents([cube]):
        assert cube.parent is None
        assert places(cube) == pytest.approx(before, abs=1e-5)
    assert (cube.parent, cube.parent_type) == (parent, kind)
    assert cube.parent_vertices[:] == (1, 2, 0)
    assert places(cube) == pytest.approx(before, abs=1e-5)
