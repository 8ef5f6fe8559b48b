"""Clear: in another view layer, beside other objects, or of points."""

import bpy
import pytest
from edited import FAST
from hand_curves import hand_curve
from hand_made import activate, decompose_by_hand
from weak_convex_decomposition.operators.bridge.parts.materials import is_ours

_TARGETS = bpy.ops.object.convert.get_rna_type().properties["target"].enum_items


def shown(obj):
    """Return whether an object is shown, by scene and view layer."""
    for scene in bpy.data.scenes:
        for layer in scene.view_layers:
            layer.update()
    return {
        (scene.name, layer.name): not obj.hide_get(view_layer=layer)
        for scene in bpy.data.scenes
        for layer in scene.view_layers
        if obj.name in layer.objects
    }


def clear_in(scene, layer, obj):
    layer.objects.active = obj
    with bpy.context.temp_override(
        scene=scene,
        view_layer=layer,
        object=obj,
        active_object=obj,
        selected_objects=[],
    ):
        bpy.ops.wcd.clear()


def override_of(obj, path):
    """Return an override of an object that is linked from another file."""
    bpy.data.libraries.write(path, {obj})
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = ["Suzanne"]
    override = wanted.objects[0].override_create(remap_local_usages=True)
    override.override_library.is_system_override = False
    bpy.context.scene.collection.objects.link(override)
    activate(override)
    return override


def test_what_a_library_has_stays_and_is_told_of(suzanne, tmp_path, capfd):
    decompose_by_hand(suzanne, 3, **FAST)
    bpy.ops.wcd.explode()
    override = override_of(suzanne, str(tmp_path / "library.blend"))
    bpy.ops.wcd.measure(samples=60)
    assert bpy.ops.wcd.clear() == {"FINISHED"}
    said = "The parts stay. The mesh of Suzanne is linked from a library and cannot be"
    assert said in capfd.readouterr().out
    assert '"measured":' not in override["wcd"]
    assert [each.name for each in override.modifiers] == ["Exploded View"]
    with pytest.raises(RuntimeError, match="Suzanne is linked from a library and"):
        bpy.ops.wcd.clear()


@pytest.mark.parametrize("how", ["appended", "made local"])
def test_what_came_from_a_library_and_is_local_goes(suzanne, tmp_path, how):
    decompose_by_hand(suzanne, 3, **FAST)
    bpy.ops.wcd.explode()
    bpy.ops.wcd.isolate_parts()
    path = str(tmp_path / "library.blend")
    bpy.data.libraries.write(path, {suzanne})
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path, link=how != "appended") as (_, wanted):
        wanted.objects = ["Suzanne"]
    bpy.context.scene.collection.objects.link(wanted.objects[0])
    activate(wanted.objects[0])
    if how != "appended":
        bpy.ops.object.make_local(type="ALL")
    assert len(bpy.context.active_object.modifiers) == 2
    bpy.ops.wcd.clear()
    assert not bpy.context.active_object.modifiers
    assert not bpy.data.node_groups


@pytest.mark.parametrize("where", ["layer", "scene"])
def test_the_curve_is_shown_again_where_it_was_hidden(where):
    hand = hand_curve()
    scene = here = bpy.context.scene
    if where == "scene":
        scene = bpy.data.scenes.new("Two")
        scene.collection.objects.link(hand)
    layer = scene.view_layers.new("Other")
    hand.hide_set(True, view_layer=layer)
    activate(hand)
    before = shown(hand)
    bpy.ops.wcd.decompose(samples=100, parts=2)
    parts = bpy.context.active_object
    assert parts != hand
    assert sum(shown(hand).values()) == sum(before.values()) - 1
    clear_in(scene, layer, parts)
    assert shown(hand) == before
    assert not hand.hide_render
    first = here.view_layers[0]
    assert first.objects.active == hand
    assert hand.select_get(view_layer=first)


def test_the_curve_is_shown_in_the_present_layer_if_the_other_is_gone():
    hand = hand_curve()
    bpy.ops.wcd.decompose(samples=100, parts=2)
    bpy.context.view_layer.name = "Renamed"
    bpy.ops.wcd.clear()
    assert not hand.hide_get()
    assert bpy.context.active_object == hand


def test_the_active_object_stays_active(suzanne):
    hand = hand_curve()
    for active in (suzanne, hand):
        activate(active)
        hand.select_set(True)
        suzanne.select_set(True)
        bpy.ops.wcd.decompose(samples=100, parts=2)
        (parts,) = hand.children
        assert bpy.context.active_object == (parts if active == hand else suzanne)
        assert parts.select_get()
        bpy.ops.wcd.clear()
        assert bpy.context.active_object == active
        assert hand.select_get()
        assert suzanne.select_get()


if "POINTCLOUD" in _TARGETS:  # since Blender 5

    @pytest.mark.parametrize("decomposed", [False, True])
    def test_points_made_of_a_mesh_with_parts_keep_nothing_of_them(suzanne, decomposed):
        skin = bpy.data.materials.new("Skin")
        suzanne.data.materials.append(skin)
        decompose_by_hand(suzanne, 3, **FAST)
        bpy.ops.object.convert(target="POINTCLOUD")
        cloud = bpy.context.active_object
        for mesh in bpy.data.meshes[:]:
            bpy.data.meshes.remove(mesh)  # Blender leaves it, without users
        assert sum(map(is_ours, cloud.data.materials)) == 3
        if decomposed:
            bpy.ops.wcd.decompose(**FAST)
            assert [is_ours(each) for each in cloud.data.materials] == [False, True]
            assert not cloud.data.attributes.get("Part 01")
        bpy.ops.wcd.clear()
        assert cloud.data.materials[:] == [skin]
        assert bpy.data.materials[:] == [skin]
        names = {each.name for each in cloud.data.attributes}
        assert not [n for n in names if n.startswith(("Part", "wcd"))]
        assert not cloud.wcd_parts
        assert "wcd" not in cloud
