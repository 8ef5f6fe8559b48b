"""Hulls that would have the names of others: they differ, or a sentence says why."""

import bpy
import pytest
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of


def build(obj, **settings):
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    bpy.ops.wcd.build_hulls(max_hulls=1, **settings)
    return [hull.name for hull in hulls_of(obj)]


@pytest.mark.parametrize("naming", ["PLAIN", "GODOT", "TEMPLATE"])
def test_all_of_them_get_hulls(naming):
    settings = {"naming": naming, "template": "{name}{name} {n}"}
    objects = []
    for ending in "abc":
        bpy.ops.mesh.primitive_cube_add()
        objects.append(bpy.context.active_object)
        longest = type(objects[0]).bl_rna.properties["name"].length_max - 1
        objects[-1].name = "é" * ((longest - 1) // 2) + ending
        assert objects[-1].name.endswith(ending)
    first = [build(obj, **settings) for obj in objects]
    again = [build(obj, **settings) for obj in reversed(objects)]
    assert again == first[::-1]
    names = {name for (name,) in first}
    assert len(names) == 3
    assert max(len(name.encode()) for name in names) <= longest
    assert {bool(name.count(" 2")) for name in names} == {True, False}


@pytest.mark.parametrize(
    ("settings", "remedy"),
    [
        ({}, "rename it"),
        ({"naming": "TEMPLATE", "template": "{name!s} {n}"}, "rename it"),
        ({"naming": "TEMPLATE", "template": "x{n}"}, "put {name} into Template,"),
    ],
)
def test_a_name_that_another_hull_has_is_blamed_on_its_cause(settings, remedy):
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.active_object
    build(cube, **settings)
    copy = cube.copy()
    bpy.context.collection.objects.link(copy)
    cube.name, copy.name = "Renamed", "Cube"
    with pytest.raises(RuntimeError, match=f"{remedy} or choose another Naming"):
        build(copy, **settings)


def test_a_hull_without_a_parent_is_no_hull_of_another_object():
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.active_object
    build(cube)
    (hull,) = hulls_of(cube)
    hull.parent = None
    with pytest.raises(RuntimeError, match="There is an object Cube hull 01 already"):
        build(cube)
