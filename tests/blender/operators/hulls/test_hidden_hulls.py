"""Rigid bodies of hidden hulls are made and removed; no half is left by an error."""

import bpy
import pytest
from hand_made import activate, decompose_by_hand
from weak_convex_decomposition.operators.bridge.hulls import rigid_bodies
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of

HULLS = {"pieces": "PARTS", "max_error": 0.5}


@pytest.fixture
def owner(suzanne):
    """Suzanne with two hulls, in a collection of her own."""
    home = bpy.data.collections.new("Home")
    bpy.context.scene.collection.children.link(home)
    home.objects.link(suzanne)
    for other in suzanne.users_collection:
        if other != home:
            other.objects.unlink(suzanne)
    activate(suzanne)
    decompose_by_hand(suzanne, 2)
    bpy.ops.wcd.build_hulls(**HULLS)
    return suzanne


def layer_of(name):
    """Return what the view layer says of a collection in "Home"."""
    home = bpy.context.view_layer.layer_collection.children["Home"]
    return home if name == "Home" else home.children[name]


def disable_owner(owner):
    owner.hide_viewport = True


def disable_hull(owner):
    hulls_of(owner)[1].hide_viewport = True


def hide_hull(owner):
    hulls_of(owner)[1].hide_set(True)


def disable_collection(owner):
    bpy.data.collections["Suzanne hulls"].hide_viewport = True


def disable_home(owner):
    bpy.data.collections["Home"].hide_viewport = True


def hide_collection(owner):
    layer_of("Suzanne hulls").hide_viewport = True


def exclude_collection(owner):
    layer_of("Suzanne hulls").exclude = True


WAYS = [
    disable_owner,
    disable_hull,
    hide_hull,
    disable_collection,
    disable_home,
    hide_collection,
]


def hide(owner, way):
    way(owner)
    bpy.context.view_layer.update()
    bpy.context.view_layer.objects.active = owner


def bodies(owner):
    return [each.rigid_body is not None for each in (owner, *hulls_of(owner))]


def check_none_left(owner):
    assert not any(bodies(owner))
    assert "wcd_rigid" not in owner
    assert bpy.context.scene.rigidbody_world is None


@pytest.mark.parametrize("way", WAYS)
def test_hidden_hulls_become_rigid_bodies_and_stay_hidden(owner, way):
    hide(owner, way)
    everything = (owner, *hulls_of(owner))
    before = [each.hide_viewport for each in everything]
    for _ in range(2):
        assert bpy.ops.wcd.make_rigid() == {"FINISHED"}
    assert bodies(owner) == [True] * 3
    assert [each.hide_viewport for each in everything] == before


@pytest.mark.parametrize("way", [*WAYS, exclude_collection])
@pytest.mark.parametrize("name", ["remove_hulls", "build_hulls", "clear"])
def test_their_rigid_bodies_are_taken_back(owner, way, name):
    bpy.ops.wcd.make_rigid()
    hide(owner, way)
    settings = HULLS if name == "build_hulls" else {}
    assert getattr(bpy.ops.wcd, name)(**settings) == {"FINISHED"}
    assert len(hulls_of(owner)) == (2 if settings else 0)
    assert owner.hide_viewport == (way == disable_owner)
    check_none_left(owner)


def test_objects_without_a_mesh_leave_no_half_of_a_rigid_body(owner):
    hull, empty = hulls_of(owner)[0], bpy.data.objects.new("empty", None)
    owner.users_collection[0].objects.link(empty)
    bpy.context.view_layer.update()
    with pytest.raises(RuntimeError, match="object_add"):
        rigid_bodies.make_rigid(owner, [hull, empty], "ACTIVE")
    check_none_left(owner)


def test_what_fails_on_the_way_back_can_be_tried_again(owner, monkeypatch):
    bpy.ops.wcd.make_rigid()

    def fail(body):
        raise RuntimeError(body.name)

    with monkeypatch.context() as broken:
        broken.setattr(rigid_bodies, "_scene_of", fail)
        with pytest.raises(RuntimeError):
            rigid_bodies.soften(owner, hulls_of(owner))
    assert "wcd_rigid" in owner
    rigid_bodies.soften(owner, hulls_of(owner))
    check_none_left(owner)
