"""What the user tied to hulls, or to their collection, outlives them."""

import bpy
import numpy as np
import pytest
from hand_made import activate, decompose_by_hand
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of

HULLS = {"max_hulls": 2, "max_error": 0.1}


@pytest.fixture
def owner(suzanne):
    """Suzanne with two hulls, which is not at the origin."""
    suzanne.location, suzanne.rotation_euler = (5, 0, 0), (1, 0, 0)
    suzanne.scale = (1, 2, 1)
    bpy.context.view_layer.update()
    bpy.ops.wcd.build_hulls(**HULLS)
    return suzanne


@pytest.fixture
def home(owner):
    return bpy.data.collections["Suzanne hulls"]


def child_of(hull, kind="OBJECT"):
    """Return something of the user's that a moved hull holds, and where it is."""
    hull.location.x += 2
    lamp = bpy.data.objects.new("Lamp", None)
    bpy.context.scene.collection.objects.link(lamp)
    lamp.parent, lamp.parent_type, lamp.location = hull, kind, (0, 0.5, 1)
    bpy.context.view_layer.update()
    return lamp, np.array(lamp.matrix_world)


def in_layer(collection):
    return bpy.context.view_layer.layer_collection.children[collection.name]


def build_again(**settings):
    bpy.ops.wcd.build_hulls(**{**HULLS, **settings})


def remove_one():
    bpy.ops.wcd.remove_hull(hull="Suzanne hull 01")


@pytest.mark.parametrize("kind", ["OBJECT", "VERTEX"])
@pytest.mark.parametrize(
    "remove", [build_again, bpy.ops.wcd.remove_hulls, bpy.ops.wcd.clear, remove_one]
)
def test_children_of_hulls_go_to_their_object_and_stay_in_place(owner, remove, kind):
    lamp, place = child_of(hulls_of(owner)[0], kind)
    location = lamp.location.copy()
    activate(owner)
    remove()
    bpy.context.view_layer.update()
    assert (lamp.parent, lamp.location) == (owner, location)
    assert np.array(lamp.matrix_world) == pytest.approx(place, abs=1e-5)


def test_children_of_lost_hulls_stay_in_place(owner):
    lamp, _ = child_of(hulls_of(owner)[0])
    bpy.data.objects.remove(owner)
    bpy.context.view_layer.update()
    place = np.array(lamp.matrix_world)
    bpy.ops.mesh.primitive_cube_add()
    bpy.ops.wcd.clear()
    bpy.context.view_layer.update()
    assert lamp.parent is None
    assert np.array(lamp.matrix_world) == pytest.approx(place, abs=1e-5)


def test_children_stay_in_place_where_the_parts_replace_the_object(owner):
    decompose_by_hand(owner, 2)
    lamp, place = child_of(hulls_of(owner)[0])
    activate(owner)
    bpy.ops.wcd.separate(original="REMOVE")
    bpy.context.view_layer.update()
    assert lamp.parent.name.startswith("Suzanne Part")
    assert np.array(lamp.matrix_world) == pytest.approx(place, abs=1e-5)


def test_hulls_built_again_are_in_the_same_collection(owner, home):
    instancer = bpy.data.objects.new("Many", None)
    bpy.context.scene.collection.objects.link(instancer)
    instancer.instance_type, instancer.instance_collection = "COLLECTION", home
    home.color_tag, home["mine"] = "COLOR_03", 1
    in_layer(home).exclude = True
    build_again(max_hulls=1)
    assert instancer.instance_collection == home
    assert home.objects[:] == hulls_of(owner)
    assert len(home.objects) == 1
    assert in_layer(home).exclude
    assert (home.color_tag, home["mine"]) == ("COLOR_03", 1)
    bpy.ops.wcd.remove_hulls()
    assert "Suzanne hulls" not in bpy.data.collections


@pytest.mark.parametrize("name", ["Head hulls", "Mine"])
def test_the_collection_follows_the_name_of_the_object(owner, home, name):
    if name == "Mine":
        home.name = name
    owner.name = "Head"
    build_again()
    assert bpy.data.collections[:] == [home]
    assert (home.name, home["wcd_hull"]) == (name, "Head")


def test_hulls_built_again_are_seen_in_the_present_scene(owner, home):
    scene = bpy.data.scenes.new("AA")
    scene.collection.objects.link(owner)
    with bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[0]):
        build_again()
    hulls = set(hulls_of(owner))
    assert hulls <= set(scene.objects)
    assert bpy.data.collections[:] == [home]


def test_hulls_of_a_copy_get_a_collection_of_their_own(owner, home):
    activate(owner)
    for hull in hulls_of(owner):
        hull.select_set(True)
    bpy.ops.object.duplicate()
    copy = bpy.data.objects["Suzanne.001"]
    assert len(home.objects) == 4
    activate(copy)
    build_again()
    assert home.objects[:] == hulls_of(owner)
    assert bpy.data.collections["Suzanne.001 hulls"].objects[:] == hulls_of(copy)


def test_another_shape_of_a_hull_leaves_what_the_user_gave_it(owner):
    hull = hulls_of(owner)[0]
    hull.constraints.new("COPY_SCALE").name = "mine"
    hull.driver_add("pass_index").driver.expression = "3"
    hull["mine"], hull.modifiers.new("mine", "BEVEL").width = 1, 0.2
    bpy.ops.wcd.refit_hull(hull=hull.name, shape="BOX")
    assert hull in hulls_of(owner)
    assert hull.constraints.keys() == hull.modifiers.keys() == ["mine"]
    assert hull["mine"] == len(hull.animation_data.drivers) == 1


@pytest.mark.parametrize("kind", ["VERTS", "FACES"])
def test_hulls_are_not_shown_at_each_vertex(suzanne, kind):
    suzanne.instance_type = kind
    with pytest.raises(RuntimeError, match="set Instancing to None first"):
        build_again()
    suzanne.instance_type = "NONE"
    build_again()
    suzanne.instance_type = kind  # afterwards: they can go
    bpy.ops.wcd.remove_hulls()
    assert bpy.data.objects[:] == [suzanne]
