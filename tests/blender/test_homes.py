"""Where objects are, told by themselves and not by their names."""

import bpy
import pytest
from edited import FAST
from hand_made import activate
from weak_convex_decomposition.operators.bridge.homes import objects_in


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
