"""The menus: all that buttons do is in them, so that F3 finds it."""

from types import SimpleNamespace

import bpy
import pytest
from hand_made import decompose_by_hand, in_mode
from stand_ins.layout import Layout, context
from weak_convex_decomposition import ui
from weak_convex_decomposition.ui.menus import WCD_MT_parts

# What buttons do for their place in the sidebar, or for one row of a list.
_OF_THE_SIDEBAR = {
    "cancel",
    "choose_part_count",
    "tell_quality",
    "use_preset",
    "refit_hull",
    "remove_hull",
}
# What only other operators of ours and timers call.
_OF_OTHERS = {"choose_part", "merge_next", "recut"}


class Menu(Layout):
    """Stands for the layout of a menu: keeps the operators and the menus below."""

    called: list[tuple[str, SimpleNamespace]]

    def operator(self, name, **look):
        super().operator(name, **look)
        self.called.append((name, SimpleNamespace()))
        return self.called[-1][1]

    def operator_menu_enum(self, name, choice, **look):
        self.operator(name, **look)
        assert choice in properties_of(name)

    def menu(self, name):
        cls = getattr(bpy.types, name)
        assert cls.bl_label
        cls.draw(SimpleNamespace(layout=self, _entries=cls._entries), context())


def properties_of(name):
    call = getattr(bpy.ops.wcd, name.removeprefix("wcd."))
    return set(call.get_rna_type().properties.keys())


def drawn_menu():
    layout = Menu()
    layout.called = []
    layout.menu(WCD_MT_parts.__name__)
    return layout


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_all_operators_are_in_the_menus(suzanne, mode):
    decompose_by_hand(suzanne, 3)
    in_mode(suzanne, mode)
    layout = drawn_menu()
    there = {name.removeprefix("wcd.") for name, _ in layout.called}
    assert there == set(dir(bpy.ops.wcd)) - _OF_THE_SIDEBAR - _OF_OTHERS
    for name, values in layout.called:
        assert vars(values).keys() <= properties_of(name), name
    assert {"Split Convex Parts by ψ", "Show All Convex Parts"} <= set(layout.texts())


def test_menus_are_registered_below_the_one_in_blenders_menus():
    menus = {each for each in ui.CLASSES if issubclass(each, bpy.types.Menu)}
    below = {name for name in WCD_MT_parts._entries if isinstance(name, str)}
    assert {each.__name__ for each in menus} - below == {"WCD_MT_parts", "WCD_MT_pick"}
