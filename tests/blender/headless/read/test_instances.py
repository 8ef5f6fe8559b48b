"""Linked copies and instances of all kinds become objects with hulls in place."""

import json

import bpy
import numpy as np
import pytest
from headless.command import run_wcd
from headless.instancing import (
    add,
    box,
    boxes,
    collection_with_rock,
    instance_of,
    mesh_of,
    rock,
    saved,
    scatter,
)
from headless.loading import load
from mathutils import Matrix
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.headless.read.load import load_file

QUICK = ["--samples", "60", "--parts", "1", "--pieces", "parts", "--quiet"]


def hulls_in(path):
    """Return the bounding box of each hull in an .obj file, in its order."""
    found = []
    for hull in f"\n{path.read_text()}".split("\no ")[1:]:
        rows = [line.split()[1:] for line in hull.splitlines() if line[:2] == "v "]
        points = np.round(np.array(rows, dtype=float), 3)
        found.append([*points.min(axis=0).tolist(), *points.max(axis=0).tolist()])
    return found


def run(path, *options):
    hulls, report = path.with_suffix(".hulls.obj"), path.with_suffix(".json")
    words = [path, "--hulls", hulls, "--report", report, "--up", "Z", *QUICK, *options]
    assert run_wcd(*words) == 0
    (entry,) = json.loads(report.read_text())["inputs"]
    return hulls, entry["objects"]


def test_linked_copies_in_gltf_get_hulls_each(tmp_path):
    mesh = rock()
    for number in range(3):
        add("Rock", mesh, (3 * number, 0, 0))
    bpy.data.objects["Rock.002"].scale = (-2, 2, 2)
    path = tmp_path / "a.glb"
    bpy.ops.export_scene.gltf(filepath=str(path))
    hulls, objects = run(path)
    places = [box(0, 0, 0), box(3, 0, 0), [4, 0, 0, 6, 2, 2]]
    assert hulls_in(hulls) == places
    assert [len(obj["hulls"]["hulls"]) for obj in objects] == [1, 1, 1]
    assert len({obj["hulls"]["hulls"][0]["name"] for obj in objects}) == 3


def test_a_file_of_collection_instances_only(tmp_path, capsys):
    rocks = collection_with_rock()
    for number in range(2):
        instance_of(rocks, "Spot", (3 * number, 0, 0))
    path, output = saved(tmp_path / "a.blend"), tmp_path / "out.blend"
    hulls, objects = run(path, "--output", output)
    assert [obj["name"] for obj in objects] == ["Spot Rock", "Spot.001 Rock"]
    assert hulls_in(hulls) == [box(0, 0, 5), box(3, 0, 5)]
    bpy.ops.wm.open_mainfile(filepath=str(output))
    first, second = (bpy.data.objects[obj["name"]] for obj in objects)
    assert first.data == second.data
    assert len(first.vertex_groups) == len(second.wcd_parts) == 1
    assert bpy.data.objects["Spot"].instance_type == "NONE"


def test_instances_of_instances_and_hidden_ones(tmp_path):
    inner, outer = collection_with_rock(), bpy.data.collections.new("Outer")
    instance_of(inner, "Inner", (0, 7, 0), outer)
    first, second = (
        instance_of(outer, name, (x, 0, 0)) for name, x in (("A", 0), ("B", 9))
    )
    first.hide_viewport = True
    bpy.context.view_layer.update()
    second.hide_set(True)
    objects = load(saved(tmp_path / "a.blend"))
    assert boxes(objects) == {"A Rock": box(0, 7, 5), "B Rock": box(9, 7, 5)}
    assert bpy.data.objects["A"].hide_viewport
    assert bpy.data.objects["B"].hide_get()


def test_what_is_excluded_from_the_view_layer_is_left_out(tmp_path):
    shown, excluded = collection_with_rock(), bpy.data.collections.new("Excluded")
    bpy.context.scene.collection.children.link(excluded)
    instance_of(shown, "A")
    instance_of(shown, "B", within=excluded)
    bpy.context.view_layer.layer_collection.children["Excluded"].exclude = True
    assert [o.name for o in load(saved(tmp_path / "a.blend"))] == ["A Rock"]


def test_shear_between_instancer_and_instance_is_kept(tmp_path):
    collection = collection_with_rock()
    collection.objects[0].rotation_euler.z = 0.5
    instance_of(collection, "A").scale = (3, 1, 1)
    (obj,) = load(saved(tmp_path / "a.blend"))
    expected = Matrix.Diagonal((3, 1, 1, 1)) @ Matrix.Translation((0, 0, 5))
    expected @= Matrix.Rotation(0.5, 4, "Z")
    assert np.allclose(obj.matrix_world, expected, atol=1e-5)


def test_linked_copies_in_fbx_are_counted_and_get_their_modifiers_applied(tmp_path):
    mesh = rock()
    for number in range(3):
        add("Rock", mesh, (3 * number, 0, 0))
    obj = bpy.data.objects["Rock"]
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Long").data[3].co.z = 4
    path = tmp_path / "a.fbx"
    bpy.ops.export_scene.fbx(filepath=str(path))
    assert {each.data.users for each in load(path)} == {3}
    assert len(run(path, "--apply-modifiers")[1]) == 3


@pytest.mark.parametrize("kind", ["VERTS", "FACES"])
def test_vertex_and_face_instancing(tmp_path, kind):
    triangle = mesh_of([(0, 0, 0), (6, 0, 0), (0, 6, 0)], [(0, 1, 2)], "Triangle")
    ground = add("Ground", triangle)
    ground.instance_type, ground.show_instancer_for_viewport = kind, False
    add("Rock", rock()).parent = ground
    found = boxes(load(saved(tmp_path / "a.blend")))
    places = [(0, 0), (6, 0), (0, 6)] if kind == "VERTS" else [(2, 2)]
    lows = [box[:2] for name, box in found.items() if name.startswith("Ground")]
    if kind == "VERTS":
        assert lows == [list(place) for place in places]
    assert len(lows) == len(places)
    assert set(found) == {"Rock", *(name for name in found if "Ground Rock" in name)}


@pytest.mark.parametrize("ending", ["blend", "glb"])
def test_children_of_an_instancer_that_is_left_out_stay_in_place(tmp_path, ending):
    spots = add("Spots", mesh_of([(0, 0, 0), (6, 0, 0)], []), (0, 0, 10))
    spots.instance_type, spots.scale = "VERTS", (2, 1, 1)
    add("Rock", rock()).parent = spots
    turned = add("Turned", rock(), (0, 9, 0))
    turned.parent, turned.rotation_euler.z = spots, 0.5  # which shears it
    path = saved(tmp_path / "a.blend")
    before = {
        name: boxes([bpy.data.objects[name]])[name] for name in ("Rock", "Turned")
    }
    output = tmp_path / f"b.{ending}"
    assert run_wcd(path, "--output", output, *QUICK) == 0
    after = boxes(load(output))
    assert {name: after[name] for name in before} == before


def test_geometry_nodes_that_scatter_cubes(tmp_path):
    spots = mesh_of([(0, 0, 0), (9, 0, 0), (0, 9, 0)], [(0, 1, 2)], "Spots")
    scatter(add("Bare", spots))
    scatter(add("Floor", spots.copy(), (0, 0, 5)), joined=True)
    loaded = load_file(saved(tmp_path / "a.blend"), None, False)
    found = boxes(loaded.objects)
    cubes = [f"{name} Mesh {n}" for name in ("Bare", "Floor") for n in (1, 2, 3)]
    assert sorted(found) == sorted(["Floor", *cubes])
    assert found["Floor Mesh 2"] == box(8.5, -0.5, 4.5)
    assert len({obj.data for obj in loaded.objects if "Mesh" in obj.name}) == 1
    assert "1 faces became none" in loaded.notes["Bare"]
    assert "Its modifiers were applied" in loaded.notes["Floor"]
    assert not any(obj.modifiers for obj in loaded.objects)


def test_nodes_that_scatter_an_object_keep_its_mesh(tmp_path):
    source = add("Rock", rock(), (0, 0, 20))
    spots = mesh_of([(0, 0, 0), (9, 0, 0)], [], "Spots")
    scatter(add("Spots", spots), source=source)
    objects = load(saved(tmp_path / "a.blend"))
    shown = [obj for obj in objects if obj.data.polygons]
    assert list(boxes(shown)) == ["Rock", "Spots Rock 1", "Spots Rock 2"]
    assert len({obj.data for obj in shown}) == 1


def test_links_to_a_library_become_local_and_the_library_stays(tmp_path):
    collection_with_rock(in_scene=True)
    library = saved(tmp_path / "library.blend")
    before = library.read_bytes()
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with bpy.data.libraries.load(str(library), link=True) as (_, wanted):
        wanted.collections = ["Rocks"]
    rocks = bpy.data.collections["Rocks"]
    for number in range(2):
        instance_of(rocks, "Spot", (3 * number, 0, 0))
    bpy.context.scene.collection.objects.link(rocks.objects[0])
    path = saved(tmp_path / "a.blend")
    hulls, objects = run(path)
    names = ["Rock", "Spot Rock", "Spot.001 Rock"]
    assert [obj["name"] for obj in objects] == names
    places = [box(0, 0, 5), box(0, 0, 5), box(3, 0, 5)]
    assert sorted(hulls_in(hulls)) == places
    assert library.read_bytes() == before
    library.unlink()
    with pytest.raises(DecompositionError, match=r"links objects of library\.blend"):
        load(path)


def test_hulls_of_what_is_hidden_or_in_another_scene_are_written(tmp_path):
    rocks = collection_with_rock(in_scene=True)
    rocks.hide_viewport = True
    second = bpy.data.scenes.new("Second")
    second.collection.objects.link(bpy.data.objects.new("Other", rock()))
    hulls, _ = run(saved(tmp_path / "a.blend"))
    assert sorted(hulls_in(hulls)) == [box(0, 0, 0), box(0, 0, 5)]


def test_an_earlier_result_is_not_mistaken_for_that_of_an_instance(tmp_path):
    rocks = collection_with_rock(in_scene=True)
    bpy.context.view_layer.objects.active = rocks.objects[0]
    rocks.objects[0].select_set(True)
    bpy.context.view_layer.update()
    bpy.ops.wcd.decompose(samples=60, parts=1)
    bpy.ops.wcd.build_hulls(pieces="PARTS")
    instance_of(rocks, "Spot", (3, 0, 0))
    _, objects = run(saved(tmp_path / "a.blend"))
    assert [obj["name"] for obj in objects] == ["Rock", "Spot Rock"]
    (hull,) = objects[1]["hulls"]["hulls"]
    assert hull["name"].startswith("Spot_Rock")


def test_curves_texts_and_metaballs_are_no_models_nor_are_instances_of_them(tmp_path):
    rocks = collection_with_rock()
    bpy.ops.object.metaball_add()
    bpy.ops.object.text_add()
    bpy.ops.curve.primitive_bezier_circle_add()
    bpy.context.active_object.data.extrude = 1.0
    for obj in list(bpy.context.scene.collection.objects):
        rocks.objects.link(obj)
    instance_of(rocks, "Spot")
    assert [obj.name for obj in load(saved(tmp_path / "a.blend"))] == ["Spot Rock"]
