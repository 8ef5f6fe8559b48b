import bpy
import numpy as np
import pytest
from definitions import assert_convex
from edited import record_of
from hand_made import decompose_by_hand, in_mode, in_scene, mesh_object
from snapshot import snapshot
from weak_convex_decomposition.core.hulls.convex_hull import Hull
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of

QUICK = {"max_hulls": 4, "max_error": 0.2}


def build(**values):
    bpy.context.scene.wcd.samples = 100
    return bpy.ops.wcd.build_hulls(**{**QUICK, **values})


def polyhedron(obj):
    mesh = obj.data
    vertices = np.empty(len(mesh.vertices) * 3, dtype=np.float32)
    mesh.vertices.foreach_get("co", vertices)
    vertices = vertices.reshape(-1, 3).astype(float)
    mesh.calc_loop_triangles()
    triangles = np.array([list(each.vertices) for each in mesh.loop_triangles])
    a, b, c = np.moveaxis(vertices[triangles], 1, 0)
    volume = np.einsum("fd,fd->f", a, np.cross(b, c)).sum() / 6
    planes = np.column_stack([np.cross(b - a, c - a), np.zeros(len(a))])
    return Hull(vertices, triangles, planes, volume)


def test_hulls_are_objects_of_their_own(suzanne):
    suzanne.location, suzanne.scale = (5, 0, 0), (1, 2, 3)
    bpy.context.view_layer.update()
    before = snapshot(suzanne)["mesh"]
    assert build() == {"FINISHED"}
    assert snapshot(suzanne)["mesh"] == before
    collection = bpy.data.collections["Suzanne hulls"]
    hulls = hulls_of(suzanne)
    assert set(hulls) == set(collection.objects)
    assert [hull.name for hull in hulls] == [
        f"Suzanne hull {n:02d}" for n in range(1, len(hulls) + 1)
    ]
    bpy.context.view_layer.update()
    low, high = (getattr(in_scene(suzanne), name)(axis=0) for name in ("min", "max"))
    for hull in hulls:
        assert hull.parent == suzanne
        assert hull.matrix_world == suzanne.matrix_world
        assert_convex(polyhedron(hull), 1e-7)
        places = in_scene(hull)
        assert (places >= low - 1e-4).all()
        assert (places <= high + 1e-4).all()
    every = np.concatenate([in_scene(hull) for hull in hulls])
    assert every.min(axis=0) == pytest.approx(low, abs=0.05)


def test_the_record_tells_each_error(suzanne):
    bpy.ops.wcd.measure(samples=50)
    build(max_hulls=2)
    record = record_of(suzanne)
    hulls = record["hulls"]
    assert "measured" in record
    assert [entry["name"] for entry in hulls["hulls"]] == [
        "Suzanne hull 01",
        "Suzanne hull 02",
    ]
    errors = [entry["error"] for entry in hulls["hulls"]]
    assert hulls["largest_error"] == max(errors) > 0.2
    assert hulls["notes"][0].startswith("The error is")
    assert hulls["parameters"]["max_hulls"] == 2
    # Parts come and go without it, but are not those that the hulls are around.
    decompose_by_hand(suzanne, 3)
    for entry in hulls["hulls"]:
        entry["part"] = None
    assert record_of(suzanne)["hulls"] == hulls


def test_parts_lead_the_cuts(suzanne):
    decompose_by_hand(suzanne, 3)
    build(pieces="PARTS", max_hulls=10)
    hulls = hulls_of(suzanne)
    assert len(hulls) == 3
    colors = {hull.data.materials[0].name for hull in hulls}
    assert colors == {"Part 01", "Part 02", "Part 03"}


def test_running_again_replaces_and_clear_removes(suzanne):
    before = snapshot(suzanne)
    counts = [len(bpy.data.objects), len(bpy.data.meshes), len(bpy.data.collections)]
    build()
    build(max_hulls=2, naming="UNREAL")
    assert [hull.name for hull in hulls_of(suzanne)] == [
        "UCX_Suzanne_01",
        "UCX_Suzanne_02",
    ]
    assert len(bpy.data.objects) == 3
    bpy.ops.wcd.clear()
    assert snapshot(suzanne) == before
    assert counts == [
        len(bpy.data.objects),
        len(bpy.data.meshes),
        len(bpy.data.collections),
    ]


def test_the_users_own_objects_stay(suzanne):
    build()
    mine = bpy.data.objects.new("mine", None)
    bpy.data.collections["Suzanne hulls"].objects.link(mine)
    child = bpy.data.objects.new("child", None)
    child.parent = suzanne
    bpy.ops.wcd.clear()
    assert list(bpy.data.collections["Suzanne hulls"].objects) == [mine]
    assert child.parent == suzanne


@pytest.mark.parametrize(
    ("naming", "shape", "name"),
    [
        ("UNREAL", "HULL", "UCX_Suzanne_01"),
        ("UNREAL", "BOX", "UBX_Suzanne_01"),
        ("UNREAL", "SPHERE", "USP_Suzanne_01"),
        ("UNREAL", "CAPSULE", "UCP_Suzanne_01"),
        ("UNREAL", "CYLINDER", "UCX_Suzanne_01"),
        ("UNITY", "HULL", "Suzanne_collider_01"),
        ("GODOT", "HULL", "Suzanne_01-convcolonly"),
        ("TEMPLATE", "BOX", "box7_001"),
    ],
)
def test_naming(suzanne, naming, shape, name):
    build(naming=naming, shape=shape, template="{kind}7_{n:03d}", max_hulls=1)
    (hull,) = hulls_of(suzanne)
    assert hull.name == name
    assert_convex(polyhedron(hull), 1e-7)


@pytest.mark.parametrize(
    ("template", "message"),
    [
        ("{name}", "gives all hulls one name"),
        ("{number}", "cannot be filled in"),
        ("{n:zz}", "cannot be filled in"),
        ("{n", "cannot be filled in"),
        ("{}", "cannot be filled in"),
    ],
)
def test_bad_templates(suzanne, template, message):
    with pytest.raises(RuntimeError, match=message):
        build(naming="TEMPLATE", template=template)


def test_a_name_that_is_taken_changes_nothing(suzanne):
    build(max_hulls=2)
    hulls = hulls_of(suzanne)
    bpy.data.objects.new("UCX_Suzanne_02", None)
    with pytest.raises(RuntimeError, match="There is an object UCX_Suzanne_02"):
        build(max_hulls=2, naming="UNREAL")
    assert hulls_of(suzanne) == hulls


def test_long_names_keep_their_numbers(suzanne):
    """Blender would cut them off."""
    suzanne.name = "é" * 200
    most = len(suzanne.name.encode())  # fewer in Blender 4.2
    build(max_hulls=2)
    names = [hull.name for hull in hulls_of(suzanne)]
    assert [name.strip("é") for name in names] == [" hull 01", " hull 02"]
    assert most - 1 <= len(names[0].encode()) <= most + 1
    with pytest.raises(RuntimeError, match=rf"have {most + 7} bytes.* by 6, or"):
        build(max_hulls=2, naming="UNREAL")
    assert [hull.name for hull in hulls_of(suzanne)] == names


def test_edit_mode_is_refused(suzanne):
    in_mode(suzanne, "EDIT")
    with pytest.raises(RuntimeError, match="switch the mode"):
        build()
    in_mode(suzanne, "OBJECT")
    build(max_hulls=1)
    in_mode(suzanne, "EDIT")
    with pytest.raises(RuntimeError, match="Object Mode"):
        bpy.ops.wcd.clear()
    assert len(hulls_of(suzanne)) == 1


def test_a_mesh_without_faces_is_refused():
    obj = mesh_object("wire", [(0, 0, 0), (1, 0, 0)], [])
    bpy.context.view_layer.objects.active = obj
    with pytest.raises(RuntimeError, match="need faces"):
        build()


def test_a_flat_mesh_has_a_thin_hull(capfd):
    obj = mesh_object("flat", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    bpy.context.view_layer.objects.active = obj
    build()
    (hull,) = hulls_of(obj)
    assert_convex(polyhedron(hull), 1e-7)
    assert "no volume inside" in capfd.readouterr().out


def test_undo_takes_hulls_back(suzanne):
    bpy.ops.ed.undo_push(message="before")
    build(max_hulls=2)
    bpy.ops.ed.undo_push(message="hulls")
    assert len(bpy.data.objects) == 3
    bpy.ops.ed.undo()
    assert [obj.name for obj in bpy.data.objects] == ["Suzanne"]
    assert "wcd" not in bpy.data.objects["Suzanne"]
    assert len(bpy.data.collections) == 0


@pytest.mark.parametrize("scale", [(2, 2, 2), (1, 2, 1)])
def test_errors_in_the_scene_count_the_scale(scale):
    bpy.ops.mesh.primitive_cube_add(size=4)
    cube = bpy.context.object
    cube.scale = scale
    bpy.context.view_layer.update()
    bpy.ops.wcd.build_hulls(pieces="PARTS", shape="SPHERE", error_unit="SCENE")
    noted = record_of(cube)["hulls"]
    sides = 2 * np.array(scale)
    # From the middle of a largest side to the sphere.
    expected = np.linalg.norm(sides) - sides.min()
    assert noted["hulls"][0]["error_unit"] == "SCENE"
    assert noted["largest_error"] == pytest.approx(expected, rel=0.05)


@pytest.mark.parametrize("last", [0.01, 0.0101])
def test_margins_are_lengths_of_the_mesh_where_a_scale_is_nearly_uniform(last):
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.active_object
    cube.scale = 0.01, 0.01, last
    bpy.context.view_layer.update()
    bpy.ops.wcd.build_hulls(margin=0.1)
    (hull,) = hulls_of(cube)
    assert hull.dimensions.x == pytest.approx(0.022, rel=0.01)


def test_another_shape_of_a_hull_has_its_margin_once():
    bpy.ops.mesh.primitive_cube_add(size=2)
    build(max_hulls=1, margin=0.1)
    (hull,) = hulls_of(bpy.context.active_object)
    bpy.ops.wcd.refit_hull(hull=hull.name, shape="BOX")
    assert np.ptp(in_scene(hull), axis=0) == pytest.approx([2.2] * 3, abs=1e-3)
