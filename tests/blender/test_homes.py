"""Where objects are, told by themselves and not by their names."""

import bpy
import pytest
from edited import FAST
from hand_curves import hand_curve
from hand_made import activate, decompose_by_hand
from weak_convex_decomposition.operators.bridge.homes import objects_in
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of

HULLS = {"max_hulls": 1, "max_error": 1.0}


@pytest.fixture
def linked(suzanne, tmp_path):
    """Return an object of another file that has the name of one of this file."""
    path, name = str(tmp_path / "library.blend"), suzanne.name
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = [name]
    (obj,) = wanted.objects
    assert obj.library
    assert obj.name == name
    return obj


@pytest.mark.parametrize("both", [False, True])
def test_view_layers_have_objects_not_names(suzanne, linked, both):
    layer, collection = bpy.context.view_layer, bpy.context.scene.collection
    if both:
        collection.objects.link(linked)
    layer.update()
    assert suzanne in objects_in(layer)
    assert (linked in objects_in(layer)) == both


def test_parts_and_bodies_of_an_object_whose_name_a_linked_one_has(suzanne, linked):
    bpy.context.scene.collection.objects.link(linked)
    activate(suzanne)
    bpy.ops.wcd.decompose(**FAST)
    assert bpy.ops.wcd.choose_part(number=0) == {"FINISHED"}
    bpy.ops.wcd.build_hulls(pieces="PARTS", max_error=0.5)
    assert bpy.ops.wcd.make_rigid() == {"FINISHED"}
    assert suzanne.rigid_body
    assert linked.rigid_body is None


def hide_from_all(collection, layer):
    collection.hide_viewport = True


def hide_from_view(collection, layer):
    layer.layer_collection.children[collection.name].hide_viewport = True


def exclude(collection, layer):
    layer.layer_collection.children[collection.name].exclude = True


def have_in_another_scene(collection, layer):
    bpy.context.scene.collection.children.unlink(collection)
    bpy.data.scenes.new("AA").collection.children.link(collection)


@pytest.mark.parametrize(
    "hide", [hide_from_all, hide_from_view, exclude, have_in_another_scene]
)
def test_what_is_made_of_an_object_is_seen_where_it_is(suzanne, hide):
    scene, layer = bpy.context.scene, bpy.context.view_layer
    first, second = (bpy.data.collections.new(name) for name in "AB")
    for home in (first, second):
        scene.collection.children.link(home)
        home.objects.link(suzanne)
    scene.collection.objects.unlink(suzanne)
    hide(first, layer)
    activate(suzanne)
    decompose_by_hand(suzanne, 2)
    bpy.ops.wcd.build_hulls(**HULLS)
    assert all(hull.visible_get() for hull in hulls_of(suzanne))
    bpy.ops.wcd.separate(original="REMOVE")
    assert [each.visible_get() for each in scene.objects] == [True, True]


def override_of(obj, path):
    """Return an override of an object from another file, with its collection."""
    home = bpy.data.collections.new("Lib")
    bpy.context.scene.collection.children.link(home)
    home.objects.link(obj)
    bpy.context.scene.collection.objects.unlink(obj)
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.collections = ["Lib"]
    scene, (linked,) = bpy.context.scene, wanted.collections
    scene.collection.children.link(linked)
    overridden = linked.override_hierarchy_create(
        scene, bpy.context.view_layer, do_fully_editable=True
    )
    (found,) = overridden.objects
    activate(found)
    return found


@pytest.mark.parametrize("elsewhere", [False, True])
def test_hulls_of_an_override_are_beside_its_collection(suzanne, tmp_path, elsewhere):
    obj = override_of(suzanne, str(tmp_path / "library.blend"))
    if elsewhere:
        bpy.data.scenes.new("AA").collection.objects.link(obj)
    for _ in range(2):
        bpy.ops.wcd.build_hulls(**HULLS)
        (hull,) = hulls_of(obj)
        assert hull.visible_get()
    bpy.ops.wcd.remove_hulls()
    assert "Suzanne hulls" not in bpy.data.collections


@pytest.mark.parametrize("elsewhere", [False, True])
def test_parts_of_an_override_are_beside_its_collection(tmp_path, elsewhere):
    obj = override_of(hand_curve(), str(tmp_path / "library.blend"))
    if elsewhere:
        bpy.data.scenes.new("AA").collection.objects.link(obj)
    bpy.ops.wcd.decompose(samples=60, parts=2)
    placed = bpy.context.active_object
    assert placed.name == "Hand parts"
    assert placed.visible_get()
    assert len(placed.users_collection) == 1 + elsewhere
