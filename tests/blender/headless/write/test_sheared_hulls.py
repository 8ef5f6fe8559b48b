"""Objects that their parents shear, and hulls, in formats that cannot tell it."""

import bpy
import numpy as np
import pytest
import trimesh
from hand_made import activate, build_hulls, in_scene, mesh_object
from headless.loading import load
from weak_convex_decomposition.core.parameters.bodies import BodyParameters
from weak_convex_decomposition.operators.bridge.hulls.listed import is_hull
from weak_convex_decomposition.operators.bridge.mesh.points import positions_of
from weak_convex_decomposition.operators.headless.read.known_hulls import adopt_hulls
from weak_convex_decomposition.operators.headless.shear import (
    shear_in_meshes,
    without_parents,
    without_shear,
)
from weak_convex_decomposition.operators.headless.write.hull_files import save_hulls
from weak_convex_decomposition.operators.headless.write.model_files import save
from weak_convex_decomposition.operators.headless.write.placed_meshes import (
    matrix_of,
    placed,
)

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
    found = in_scene(obj)
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


@pytest.mark.parametrize("ending", [".stl", ".obj", ".usd"])
@pytest.mark.parametrize("scale", [(3, 1, 1), (-3, 1, 1)])
def test_files_of_hulls_keep_shear_and_are_not_inside_out(tmp_path, ending, scale):
    cube = add_sheared("Box")
    cube.parent.scale = scale
    bpy.context.view_layer.update()
    (hull,) = build_hulls([cube], max_hulls=1)
    expected = places(hull)
    save_hulls(tmp_path / f"a{ending}", [hull], "Z", BodyParameters())
    (read,) = load(tmp_path / f"a{ending}", "Z")
    assert places(read) == pytest.approx(expected, abs=1e-3)
    vertices, triangles, _ = placed(read, matrix_of(read))
    assert trimesh.Trimesh(vertices, triangles).volume == pytest.approx(VOLUME)


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


@pytest.mark.parametrize("ending", [".ply", ".obj", ".usd"])
@pytest.mark.parametrize("scale", [(3, 1, 1), (-3, 1, 1)])
def test_models_keep_shear_and_are_not_inside_out(tmp_path, ending, scale):
    cube = add_sheared("Box")
    cube.parent.scale = scale
    cube.data.uv_layers.active.uv[1].vector = (3, 4)
    expected = places(cube)
    save(tmp_path / f"a{ending}", "Z")
    (read,) = load(tmp_path / f"a{ending}", "Z")
    assert places(read) == pytest.approx(expected, abs=1e-3)
    vertices, triangles, _ = placed(read, matrix_of(read))
    assert trimesh.Trimesh(vertices, triangles).volume == pytest.approx(VOLUME)
    assert sum(tuple(corner.vector) == (3, 4) for corner in read.data.uv_layers[0].uv)


def test_hulls_of_others_keep_their_shear():
    hull = add_sheared("UCX_Model_01")
    model = mesh_object("Model", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    model.location = 1, 2, 3
    before = places(hull)
    adopt_hulls()
    assert hull.parent == model
    assert places(hull) == pytest.approx(before, abs=1e-4)


def cube_below(parent, name, **values):
    """Return a cube that was put below a parent and stayed where it was (Ctrl P)."""
    bpy.ops.mesh.primitive_cube_add(location=(6, 0, 0), rotation=(0, 0.7, 0))
    cube = bpy.context.active_object
    bpy.context.view_layer.update()
    cube.name, cube.parent = name, parent
    cube.matrix_parent_inverse = parent.matrix_world.inverted()
    for key, value in values.items():
        setattr(cube, key, value)
    return cube


def add_hanging():
    """Add cubes whose matrices below their parents have shear, and most in the world.

    Return them, and one that hangs on a vertex.
    """
    bpy.ops.mesh.primitive_cube_add(rotation=(0, 0, 0.6))
    base = bpy.context.active_object
    base.scale = 1, 1, 3
    cube_below(base, "Kid").keyframe_insert("location", frame=1)
    held = cube_below(base, "Held")
    held.constraints.new("CHILD_OF").target = held.parent
    driven = cube_below(base, "Driven")
    driven.driver_add("location", 0).driver.expression = "frame + 5"
    both = cube_below(add_sheared("Above").parent, "Both", location=(0, 9, 0))
    both.parent.rotation_euler.y = 0.5
    both.parent.scale = 1, 2, 3
    cube_below(both, "Grandchild").matrix_parent_inverse.identity()
    corner = cube_below(base, "Corner", parent_type="VERTEX", parent_vertices=(3, 0, 0))
    corner.location = 0, 5, 0
    rig = armature()
    rig.scale, rig.rotation_euler = (1, 1, 3), (0, 0.3, 0)
    bpy.context.view_layer.update()
    boned = cube_below(rig, "Boned")
    boned.parent_type, boned.parent_bone = "BONE", rig.data.bones[0].name
    boned.matrix_parent_inverse = rig.matrix_world.inverted()
    cube_below(rig, "Posed", parent_type="ARMATURE")
    for data in (bpy.data.cameras.new("Cam"), bpy.data.lattices.new("Lattice")):
        holder = bpy.data.objects.new(data.name, data)
        bpy.context.collection.objects.link(holder)
        holder.rotation_euler.y, holder.scale.z = 0.4, 3
        cube_below(holder, f"{data.name}Kid").matrix_parent_inverse.identity()
    bpy.context.view_layer.update()
    return [each for each in bpy.data.objects if each.type == "MESH"]


@pytest.mark.parametrize("ending", [".glb", ".fbx"])
@pytest.mark.parametrize("with_hulls", [False, True])
def test_models_are_where_they_were_below_their_parents(tmp_path, ending, with_hulls):
    cubes = add_hanging()
    hulls = build_hulls(cubes, max_hulls=1) if with_hulls else []
    expected = {obj.name: places(obj) for obj in (*cubes, *hulls)}
    above = {obj.name: (obj.parent, obj.data) for obj in (*cubes, *hulls)}
    save(tmp_path / f"a{ending}", None, hulls)
    for obj in (*cubes, *hulls):
        assert places(obj) == pytest.approx(expected[obj.name], abs=2e-4), obj.name
        assert (obj.parent, obj.data) == above[obj.name]
    assert bpy.data.objects["Kid"].animation_data.action
    assert not bpy.data.objects["Held"].constraints[0].mute
    _read(tmp_path / f"a{ending}")
    for name, place in expected.items():
        written = name
        if ending == ".fbx" and "hull" in name:
            written = f"UCX_{name.replace(' hull', '')}".replace(" ", "_")
        found = places(bpy.data.objects[written])
        assert found == pytest.approx(place, abs=2e-3), name


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


if bpy.app.version >= (5, 0):  # earlier ones have no point clouds by default

    def test_point_clouds_hold_shear_too():
        cube = add_sheared("Cloud")
        activate(cube)
        expected = places(cube)
        bpy.ops.object.convert(target="POINTCLOUD")
        cloud = bpy.context.active_object
        bpy.context.view_layer.update()
        data = cloud.data
        with shear_in_meshes([cloud]):
            matrix = np.array(without_shear(cloud.matrix_world))
            moved = positions_of(cloud) @ matrix[:3, :3].T + matrix[:3, 3]
            assert np.unique(moved.round(4), axis=0) == pytest.approx(
                expected, abs=2e-4
            )
        assert cloud.data == data
        assert len(bpy.data.pointclouds) == 1
