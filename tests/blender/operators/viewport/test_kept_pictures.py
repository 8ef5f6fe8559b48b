"""Pictures stay with an object that is renamed, and go with it."""

import bpy
import pytest
from hand_made import activate, decompose_by_hand


@pytest.fixture
def pictured(monkey):
    """Return an object that was renamed after two pictures of it were made."""
    activate(monkey)
    decompose_by_hand(monkey, 3, samples=60)
    bpy.ops.wcd.show_picture(picture="SIGHT")
    bpy.ops.wcd.show_picture(picture="SCATTER")
    monkey["before"] = monkey.name
    monkey.name = "Hero"
    return monkey


def other(name):
    bpy.ops.mesh.primitive_cube_add(location=(5, 0, 0))
    cube = bpy.context.active_object
    cube.name = name
    decompose_by_hand(cube, 2, samples=60)
    return cube


def test_clear_of_another_object_leaves_them(pictured):
    other("Other")
    bpy.ops.wcd.clear()
    assert len(bpy.data.images) == 2


def test_clear_of_an_object_with_the_former_name_leaves_them(pictured):
    assert other(pictured["before"]).name == pictured["before"]
    bpy.ops.wcd.clear()
    assert len(bpy.data.images) == 2


def test_a_newer_picture_leaves_the_older_ones(pictured):
    bpy.ops.wcd.show_picture(picture="SIGHT")
    other("Other")
    bpy.ops.wcd.clear()
    assert len(bpy.data.images) == 3


def test_they_go_when_it_is_cleared(pictured):
    bpy.ops.wcd.clear()
    assert not bpy.data.images
    assert "wcd_picture" not in pictured


def test_they_go_once_it_is_deleted(pictured):
    bpy.ops.object.delete()
    assert "Hero" not in bpy.data.objects
    other("Other")
    bpy.ops.wcd.clear()
    assert not bpy.data.images


def test_clear_removes_pictures_of_renamed_objects_and_of_the_same_mesh(suzanne):
    decompose_by_hand(suzanne, 3, samples=60)
    bpy.ops.wcd.show_picture(picture="SIGHT")
    suzanne.name = "Monkey"
    twin = suzanne.copy()
    bpy.context.collection.objects.link(twin)
    bpy.ops.wcd.show_picture(picture="SIGHT")  # of both
    for each in (suzanne, twin):
        each.select_set(each == suzanne)
    assert len(bpy.data.images) == 3
    bpy.ops.wcd.clear()
    assert not bpy.data.images
