"""Bad input: each its one sentence, and the object untouched."""

import bpy
import pytest
from edited import check_in_step, parts_of, record_of
from hand_made import activate, mesh_object
from snapshot import snapshot
from weak_convex_decomposition.operators.bridge.parts.rows import noted_refusal

FAST = {"samples": 300}


def refused(operator, match, **options):
    with pytest.raises(RuntimeError, match=match):
        operator(**options)


@pytest.mark.parametrize("name", ["decompose", "measure", "clear"])
def test_no_active_object(name):
    refused(getattr(bpy.ops.wcd, name), "There is no active object; select a mesh")


@pytest.mark.parametrize("name", ["decompose", "measure", "clear"])
def test_not_a_mesh(name):
    bpy.ops.object.light_add()
    refused(getattr(bpy.ops.wcd, name), "Point is not a mesh; select a mesh")


def test_nothing_to_clear(suzanne):
    refused(bpy.ops.wcd.clear, "Suzanne has no parts to clear")
    bpy.ops.object.text_add()
    refused(bpy.ops.wcd.clear, "Text is not a mesh and has no parts; select a mesh")


@pytest.mark.parametrize(
    ("name", "match"),
    [
        ("recut", "Suzanne has no parts to replace; press Decompose"),
        ("tell_quality", "There are no parts; press Decompose"),
        ("merge_next", "No parts are picked; press Pick Parts"),
    ],
)
def test_buttons_say_what_they_miss(suzanne, name, match):
    refused(getattr(bpy.ops.wcd, name), match)


def test_another_mode(suzanne):
    bpy.ops.object.mode_set(mode="SCULPT")
    refused(bpy.ops.wcd.decompose, "Object or Edit Mode")
    refused(bpy.ops.wcd.build_hulls, "Hulls are objects, which are made in Object Mode")


@pytest.mark.parametrize("name", ["decompose", "measure", "build_hulls"])
def test_an_empty_mesh_in_edit_mode(name):
    activate(mesh_object("Empty", [], []))
    bpy.ops.object.mode_set(mode="EDIT")
    refused(getattr(bpy.ops.wcd, name), "Empty has no faces yet; add some")


if bpy.app.version >= (5, 0):

    def test_points_without_any_in_edit_mode():
        cloud = bpy.data.pointclouds.new("Empty")
        empty = bpy.data.objects.new("Empty", cloud)
        bpy.context.collection.objects.link(empty)
        activate(empty)
        bpy.ops.object.mode_set(mode="EDIT")
        refused(bpy.ops.wcd.decompose, "made in Object Mode; leave Edit Mode")


TRIANGLE = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
BAD_MESHES = {
    "no faces": ([(0, 0, 0)], [], "no faces"),
    "not a number": ([(0, 0, float("nan")), *TRIANGLE[1:]], [(0, 1, 2)], "not finite"),
    "infinite": ([(0, 0, float("inf")), *TRIANGLE[1:]], [(0, 1, 2)], "not finite"),
    "a line": ([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)], "area|degenerate"),
    "a point": ([(1, 1, 1)] * 3, [(0, 1, 2)], "area|degenerate"),
}


@pytest.mark.parametrize("case", BAD_MESHES)
@pytest.mark.parametrize("name", ["decompose", "measure"])
def test_bad_meshes(case, name):
    vertices, faces, match = BAD_MESHES[case]
    obj = mesh_object("bad", vertices, faces)
    before = repr(snapshot(obj))  # NaN is not equal to itself
    refused(getattr(bpy.ops.wcd, name), match)
    assert repr(snapshot(obj)) == before


def test_parameters_that_contradict_each_other(suzanne):
    before = snapshot(suzanne)
    refused(bpy.ops.wcd.decompose, "Fewest Parts", min_parts=9, max_parts=3)
    refused(bpy.ops.wcd.decompose, "samples cannot make", samples=16, parts=20)
    assert snapshot(suzanne) == before


def test_bounds_hold_values_in(suzanne):
    bpy.ops.wcd.decompose(samples=1, parts=2, alpha=-3.0)
    parameters = record_of(suzanne)["parameters"]
    assert parameters["samples"] == 16
    assert parameters["alpha"] == 0.0


def test_an_attribute_of_the_users_is_refused_before_the_work(suzanne):
    suzanne.data.attributes.new("wcd_part", "FLOAT", "POINT")
    before = snapshot(suzanne)
    refused(bpy.ops.wcd.decompose, "does not come from decomposing")
    assert snapshot(suzanne) == before


def test_an_attribute_moved_elsewhere_is_the_users(suzanne):
    bpy.ops.wcd.decompose(**FAST)
    attributes = suzanne.data.attributes
    attributes.remove(attributes["wcd_part"])
    attributes.new("wcd_part", "INT", "EDGE")
    before = snapshot(suzanne)
    refused(bpy.ops.wcd.decompose, "does not come from decomposing")
    assert snapshot(suzanne) == before


def test_a_shared_mesh_works(suzanne):
    bpy.context.collection.objects.link(bpy.data.objects.new("twin", suzanne.data))
    assert bpy.ops.wcd.decompose(**FAST) == {"FINISHED"}
    assert "parts" in record_of(suzanne)


@pytest.fixture
def library(suzanne, tmp_path):
    path = tmp_path / "library.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return str(path)


def link(library, collection, name):
    with bpy.data.libraries.load(library, link=True) as (_, target):
        setattr(target, collection, [name])
    return getattr(target, collection)[0]


@pytest.mark.parametrize("name", ["decompose", "measure", "clear"])
def test_linked_objects_are_read_only(library, name):
    obj = link(library, "objects", "Suzanne")
    bpy.context.collection.objects.link(obj)
    activate(obj)
    refused(getattr(bpy.ops.wcd, name), r"poll\(\) Suzanne is linked from a library")
    assert not obj.keys()


def test_linked_meshes_are_read_only_but_can_be_measured(library):
    mesh = link(library, "meshes", "Suzanne")
    obj = bpy.data.objects.new("local", mesh)
    bpy.context.collection.objects.link(obj)
    activate(obj)
    refused(bpy.ops.wcd.decompose, "The mesh of local is linked from a library")
    assert bpy.ops.wcd.measure(**FAST) == {"FINISHED"}
    assert bpy.ops.wcd.clear() == {"FINISHED"}
    assert not obj.keys()


def test_parts_on_a_linked_mesh_stay_as_they_are(suzanne, tmp_path):
    bpy.ops.wcd.decompose(**FAST, parts=3)
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    obj = link(path, "objects", "Suzanne").make_local()
    bpy.context.collection.objects.link(obj)
    activate(obj)
    assert obj.data.library
    color, name = tuple(obj.wcd_parts[0].color), obj.wcd_parts[0].name
    obj.wcd_parts[0].color = (1.0, 0.0, 0.0)
    obj.wcd_parts[0].name = "Head"
    assert (tuple(obj.wcd_parts[0].color), obj.wcd_parts[0].name) == (color, name)
    assert "linked from a library" in noted_refusal(obj)
    refused(bpy.ops.wcd.clear, "linked from a library")
    assert bpy.ops.wcd.measure(**FAST) == {"FINISHED"}
    assert bpy.ops.wcd.clear() == {"FINISHED"}  # that is the object's own
    assert "measured" not in record_of(obj)
    check_in_step(obj)
    assert len(parts_of(obj)) == 3


def test_parts_that_came_with_a_joined_object_are_replaced(suzanne):
    bpy.ops.wcd.decompose(**FAST)
    bpy.ops.mesh.primitive_cube_add()
    suzanne.select_set(True)
    bpy.ops.object.join()
    assert bpy.ops.wcd.refresh_parts() == {"FINISHED"}
    check_in_step(bpy.context.active_object)
    assert bpy.ops.wcd.decompose(**FAST) == {"FINISHED"}
    check_in_step(bpy.context.active_object)
    bpy.ops.wcd.clear()
    assert not bpy.context.active_object.vertex_groups
    assert "wcd_part" not in bpy.context.active_object.data.attributes


def test_an_override_of_a_library_is_refused(tmp_path, suzanne):
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = ["Suzanne"]
    (linked,) = wanted.objects
    bpy.context.scene.collection.objects.link(linked)
    override = linked.override_create(remap_local_usages=True)
    override.data = linked.data.copy()
    activate(override)
    refused(bpy.ops.wcd.decompose, "Suzanne is an override of a library, which cannot")
    assert not override.vertex_groups
    override.select_set(True)
    bpy.ops.object.make_local(type="SELECT_OBDATA")
    bpy.ops.wcd.decompose(samples=100, parts=2)
    assert len(bpy.context.active_object.wcd_parts) == 2


@pytest.mark.parametrize("broken", ["{", 5, '{"parts": []}'])
@pytest.mark.parametrize("key", ["wcd", "wcd_restore"])
def test_a_note_that_cannot_be_read_is_told_of_until_it_is_gone(
    suzanne, capfd, broken, key
):
    bpy.ops.wcd.decompose(**FAST)
    owner = suzanne if key == "wcd" else suzanne.data
    owner[key] = broken
    for name in dir(bpy.ops.wcd):
        getattr(bpy.ops.wcd, name).poll()
    assert "Traceback" not in capfd.readouterr().err
    for name in ("split_parts", "select_parts", "clear"):
        refused(
            getattr(bpy.ops.wcd, name), f"{key} that this add-on did not write; ren"
        )
    del owner[key]
    bpy.ops.wcd.clear()
    assert "wcd_part" not in suzanne.data.attributes
