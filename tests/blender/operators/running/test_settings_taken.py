"""Operators that are invoked take the settings of the scene that nobody else set."""

from types import SimpleNamespace

import bpy
import pytest
from stand_ins.presses import Pressed, call_of, finish, press
from weak_convex_decomposition.operators.decompose import WCD_OT_decompose
from weak_convex_decomposition.operators.hulls import WCD_OT_build_hulls
from weak_convex_decomposition.operators.measure import (
    WCD_OT_measure,
    WCD_OT_measure_selection,
)
from weak_convex_decomposition.operators.settings import take_over
from weak_convex_decomposition.operators.viewport.show_sight import WCD_OT_show_sight

# A setting of each, and a value that is not its default.
SETTINGS = pytest.mark.parametrize(
    ("cls", "name", "value"),
    [
        (WCD_OT_decompose, "parts", 3),
        (WCD_OT_decompose, "colors", "OVERLAY"),
        (WCD_OT_measure, "samples", 100),
        (WCD_OT_measure_selection, "samples", 100),
        (WCD_OT_build_hulls, "pieces", "PARTS"),
        (WCD_OT_build_hulls, "look", "WIRE"),
        (WCD_OT_show_sight, "samples", 100),
    ],
)


def sets(*names):
    """Return properties of which a shortcut sets some."""
    return SimpleNamespace(is_property_set=names.__contains__)


@SETTINGS
def test_what_nobody_sets_is_as_in_the_tab(cls, name, value):
    settings, operator = bpy.context.scene.wcd, Pressed(cls)
    setattr(settings, name, value)
    operator.properties = sets()
    take_over(settings, operator, cls._settings)
    taken = {each: getattr(operator, each) for each in cls._settings}
    assert taken == {each: getattr(settings, each) for each in cls._settings}
    assert taken[name] == value
    assert cls._settings == tuple(n for n in taken if n in properties_of(cls))


def properties_of(cls):
    return set(call_of(cls).get_rna_type().properties.keys())


@SETTINGS
def test_what_a_shortcut_sets_stays(cls, name, value):
    operator = Pressed(cls)
    setattr(operator, name, value)
    operator.properties = sets(name)
    take_over(bpy.context.scene.wcd, operator, cls._settings)
    assert getattr(operator, name) == value


def test_a_shortcut_decomposes_as_the_button_does_and_a_script_does_not(
    suzanne, window
):
    settings = bpy.context.scene.wcd
    settings.parts, settings.samples = 3, 300
    pressed = press(WCD_OT_decompose, window, properties=sets())
    assert finish(pressed) == {"FINISHED"}
    assert len(suzanne.wcd_parts) == 3
    pressed = press(WCD_OT_decompose, window, properties=sets("parts"), parts=4)
    assert finish(pressed) == {"FINISHED"}
    assert len(suzanne.wcd_parts) == 4
    assert bpy.ops.wcd.decompose(samples=300, parts=2) == {"FINISHED"}
    assert len(suzanne.wcd_parts) == 2
    bpy.ops.wcd.clear()
    bpy.ops.wcd.decompose(samples=300)
    assert len(suzanne.wcd_parts) != 3  # Auto
