"""The settings of a scene: whose they are, their sliders, and errors in both units."""

import json

import bpy
import numpy as np
import pytest
from edited import record_of
from hand_made import decompose_by_hand
from snapshot import snapshot
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of
from weak_convex_decomposition.operators.bridge.stored.record import noted_parameters
from weak_convex_decomposition.operators.recut import WCD_OT_recut
from weak_convex_decomposition.operators.settings import (
    hull_parameters_from,
    other_error,
)


@pytest.fixture
def settings():
    return bpy.context.scene.wcd


def test_settings_of_another_scene_change_nothing_here(suzanne, settings):
    bpy.ops.wcd.decompose(samples=200, parts=4)
    bpy.ops.wcd.build_hulls(max_hulls=1, max_error=1.0)
    before, (hull,) = snapshot(suzanne), hulls_of(suzanne)
    other = bpy.data.scenes.new("Other").wcd
    other.samples = settings.samples = 200
    other.live = True
    settings.parts = other.parts = 3
    other.look = "WIRE"
    assert snapshot(suzanne) == before
    assert hull.display_type == "TEXTURED"
    other.parts = 0
    other.auto_parts = False
    assert other.parts == 6 != len(suzanne.wcd_parts)  # not as many as there are here
    settings.look = "WIRE"
    assert hull.display_type == "WIRE"


def test_the_least_error_of_the_slider_can_be_used(settings):
    slider = settings.bl_rna.properties["max_error"]
    settings.max_error = slider.soft_min
    assert hull_parameters_from(settings).max_error == pytest.approx(0.001)
    with pytest.raises(DecompositionError, match="choose a value from"):
        HullParameters(max_error=slider.soft_min / 2)
    click = slider.step / 100
    assert slider.soft_min < click < slider.default
    settings.max_error = 1e-5  # by typing, as lengths may be
    settings.error_unit = "SCENE"
    assert hull_parameters_from(settings).max_error == 1e-5


@pytest.mark.parametrize("view", [None, "explode", "isolate_parts"])
@pytest.mark.parametrize("copies", [1, 5])
def test_errors_in_both_units_are_those_of_the_mesh_that_is_read(
    suzanne, settings, view, copies
):
    decompose_by_hand(suzanne, 2)
    suzanne.scale = (1, 2, 1)
    if copies > 1:
        suzanne.modifiers.new("Row", "ARRAY").count = copies
    if view:
        getattr(bpy.ops.wcd, view)()
    bpy.context.view_layer.update()
    own = np.ptp([vertex.co for vertex in suzanne.data.vertices], axis=0) * (1, 2, 1)
    assert shown(suzanne, settings) == pytest.approx(0.05 * own.max() / 2, rel=5e-3)
    settings.error_unit = "SCENE"
    settings.mesh = "EVALUATED"
    if copies > 1 and view:
        assert other_error(settings, suzanne) is None  # to know it takes long
    else:
        longest = max(own[0] * copies, own[1])
        expected = settings.max_error / (longest / 2)
        assert shown(suzanne, settings) == pytest.approx(expected, rel=5e-3)


def shown(obj, settings):
    """Return the number that the panel shows as the largest error in the other unit."""
    name, text = other_error(settings, obj)
    assert name.startswith("Error" if settings.error_unit == "RELATIVE" else "Relative")
    return float(text)


def test_errors_are_not_shown_of_what_has_no_size(settings):
    bpy.ops.object.empty_add()
    empty = bpy.context.active_object
    assert other_error(settings, empty) is None
    bare = bpy.data.objects.new("Bare", bpy.data.meshes.new("Bare"))
    bare.modifiers.new("Row", "ARRAY")
    assert other_error(settings, bare) is None


def test_errors_are_not_shown_where_nodes_may_make_instances(suzanne, settings):
    suzanne.modifiers.new("Nodes", "NODES")
    bpy.context.view_layer.update()
    assert other_error(settings, suzanne) is not None  # of the mesh itself
    settings.mesh = "EVALUATED"
    assert other_error(settings, suzanne) is None


def test_a_preset_replaces_live_parts_once(suzanne, settings, monkeypatch):
    decompose_by_hand(suzanne, 3)
    cuts = []
    monkeypatch.setattr(WCD_OT_recut, "_cut", lambda *_: cuts.append(1) or True)
    settings.live = True
    cuts.clear()
    bpy.ops.wcd.use_preset(preset="DEFAULT")
    assert len(cuts) == 1
    assert settings.live


def test_parameters_of_a_later_version_are_unknown_and_stop_nothing():
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.active_object
    decompose_by_hand(obj, 3)
    record = record_of(obj)
    record["parameters"]["sight"] = "TELEPATHY"
    obj["wcd"] = json.dumps(record)
    assert noted_parameters(obj) is None
    assert not bpy.ops.wcd.recut.poll()
    assert bpy.ops.wcd.decompose.poll()
