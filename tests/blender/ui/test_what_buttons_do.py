"""What buttons hand to their operators is what their texts say."""

from types import SimpleNamespace

import bpy
import pytest
from stand_ins.layout import EDGES, context, drawn
from weak_convex_decomposition.ui import menus
from weak_convex_decomposition.ui.edit_panel import WCD_PT_edit
from weak_convex_decomposition.ui.use_panel import WCD_PT_use


class Buttons:
    """Stands for a layout: keeps the buttons, with their looks and values."""

    def __init__(self):
        self.found = []

    def __getattr__(self, name):
        return lambda *_, **__: self

    def operator(self, name, text="", **look):
        values = SimpleNamespace()
        self.found.append((name, text, look, values))
        return values


def drawn_by(cls):
    """Return the buttons that a panel or a menu draws."""
    buttons = Buttons()
    owner = SimpleNamespace(layout=buttons, _entries=getattr(cls, "_entries", ()))
    cls.draw(owner, context())
    return buttons.found


def values_of(cls, operator, key):
    """Return the value that each button of an operator sets, by the button's text."""
    buttons = [b for b in drawn_by(cls) if b[0] == f"wcd.{operator}"]
    return {text: vars(values)[key] for _, text, _, values in buttons}


def test_buttons_that_edit_parts(monkey):
    directions = values_of(WCD_PT_edit, "mirror_parts", "direction")
    assert directions == {"-X": "TO_NEGATIVE", "+X": "TO_POSITIVE"}
    assert values_of(WCD_PT_edit, "split_parts", "parts") == {"In Two": 2, "By ψ": 0}
    hiding = values_of(WCD_PT_edit, "isolate_parts", "hide")
    assert hiding == {"Isolate 2 Parts": True, "Show All": False}


def test_directions_are_told_apart_in_a_narrow_sidebar(monkey):
    assert not {"-X", "+X", "Mirror to"} & {*drawn(WCD_PT_edit).cut_off(188 - EDGES)}


def test_menus_that_edit_and_show_parts(monkey):
    numbers = values_of(menus.WCD_MT_edit, "split_parts", "parts")
    split = "Split Convex Parts"
    assert numbers == {f"{split} in Two": 2, f"{split} by ψ": 0}
    hiding = values_of(menus.WCD_MT_view, "isolate_parts", "hide")
    assert hiding == {"": True, "Show All Convex Parts": False}


def test_the_pie_isolates_parts_or_shows_all_again(monkey):
    hiding = ("isolate_parts", "hide")
    assert values_of(menus.WCD_MT_pick, *hiding) == {"Isolate": True}
    bpy.ops.wcd.isolate_parts()
    assert values_of(menus.WCD_MT_pick, *hiding) == {"Show All": False}


@pytest.mark.parametrize("colors", ["MATERIALS", "OVERLAY"])
def test_the_pressed_button_tells_how_colors_are_shown(monkey, colors):
    bpy.ops.wcd.show_colors(colors=colors)
    buttons = [b for b in drawn_by(WCD_PT_use) if b[0] == "wcd.show_colors"]
    pressed = [values.colors for _, _, look, values in buttons if look["depress"]]
    assert pressed == [colors]


@pytest.mark.parametrize("name", ["VIEW3D_MT_object", "VIEW3D_MT_edit_mesh"])
def test_blenders_menus_are_as_before_without_the_extension(name):
    entries = getattr(bpy.types, name)._dyn_ui_initialize()
    assert entries.count(menus._draw_submenu) == 1
    menus.unregister()
    assert menus._draw_submenu not in entries
    menus.register()
