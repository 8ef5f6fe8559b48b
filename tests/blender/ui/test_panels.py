"""What panels draw: nothing is cut off at the sidebar's usual width, nothing is empty.

The layout is made up: it keeps what is drawn, and knows how Blender shares width out.
"""

from itertools import product
from types import SimpleNamespace

import blf
import bpy
import pytest
from edited import FAST
from hand_made import decompose_by_hand
from weak_convex_decomposition import ui
from weak_convex_decomposition.operators.measure import WCD_OT_tell_quality
from weak_convex_decomposition.operators.settings import FRONT, is_used
from weak_convex_decomposition.ui.edit_panel import WCD_PT_edit, acted_on
from weak_convex_decomposition.ui.panels import WCD_PT_main, WCD_PT_parts
from weak_convex_decomposition.ui.parts_table import WCD_UL_parts

# Of Blender's sidebar at interface scale 1, in points, with tabs and margins; of what
# an icon and the edges of a button take; of a list's edges; of a unit.
_SIDEBAR, _EDGES = 280, 53
_ICON, _BUTTON, _LIST, _UNIT = 20, 16, 12, 20
# Share of the width of a setting's name.
_NAMES = 0.4


class Layout:
    """Stands for a layout: its parts are layouts, or texts with their edges."""

    def __init__(self, kind="column", parent=None, factor=None):
        self.kind, self.factor, self.parts = kind, factor, []
        self.use_property_split = bool(parent and parent.use_property_split)
        self.ui_units_x = 0.0

    def _child(self, kind, factor=None):
        self.parts.append(Layout(kind, self, factor))
        return self.parts[-1]

    def row(self, align=False, heading=""):
        return self._child("row")

    def column(self, align=False):
        return self._child("column")

    def box(self):
        return self._child("column")

    def split(self, factor=0.5, align=False):
        return self._child("split", factor)

    def _text(self, text, icon, edges=_BUTTON):
        blf.size(0, 11.0)
        width = blf.dimensions(0, text)[0] + edges if text else 0.0
        self.parts.append((text, width + (icon != "NONE") * _ICON))
        return SimpleNamespace()

    def label(self, text="", icon="NONE"):
        self._text(text, icon, 4)

    def operator(self, name, text="", icon="NONE", **look):
        return self._text(text, icon)

    def operator_menu_enum(self, name, choice, text="", icon="NONE"):
        return self._text(text, icon)

    def progress(self, factor, text):
        self._text(text, "NONE")

    def prop(self, owner, name, text=None, icon="NONE", **look):
        info = owner.bl_rna.properties[name]
        shown = info.name if text is None else text
        if self.use_property_split and text is None and info.type != "BOOLEAN":
            split = self._child("split", _NAMES)
            split._text(shown, "NONE", 4)
            value = getattr(owner, name)
            items = info.enum_items if info.type == "ENUM" else {}
            split._text(items[value].name if value in items else "2.000", "NONE", 32)
        elif info.type == "STRING":
            self._text(getattr(owner, name), "NONE", 6)
        else:
            self._text("" if info.subtype == "COLOR" else shown, icon)

    def template_list(self, *names, **look):
        pass

    def separator(self):
        pass

    def natural(self):
        """Return the width that nothing is cut off at."""
        widths = [p[1] if isinstance(p, tuple) else p.natural() for p in self.parts]
        width = (sum if self.kind in {"row", "split"} else max)(widths or [0.0])
        return self.ui_units_x * _UNIT or width

    def cut_off(self, room):
        """Return the texts that are too long for this width."""
        room = self.ui_units_x * _UNIT or room
        total = max(self.natural(), 1.0)
        for turn, part in enumerate(self.parts):
            share = 1.0
            if self.kind == "split":
                rest = (1 - self.factor) / max(len(self.parts) - 1, 1)
                share = rest if turn else self.factor
            if isinstance(part, tuple):
                width = part[1] if self.kind != "row" else part[1] / total * room
                if part[0] and min(width, room * share) < part[1] - 0.5:
                    yield part[0]
            else:
                own = part.natural() / total if self.kind == "row" else share
                yield from part.cut_off(room * own)

    def texts(self):
        for part in self.parts:
            yield from [part[0]] if isinstance(part, tuple) else part.texts()


def context(scale=1.0):
    return SimpleNamespace(
        active_object=bpy.context.active_object,
        scene=bpy.context.scene,
        mode=bpy.context.mode,
        region=SimpleNamespace(width=int(_SIDEBAR * scale)),
        preferences=SimpleNamespace(system=SimpleNamespace(ui_scale=scale)),
    )


def drawn(panel, scale=1.0):
    layout = Layout()
    panel.draw(SimpleNamespace(layout=layout), context(scale))
    return layout


@pytest.fixture
def decomposed(suzanne):
    """Seven parts, one of them with a long name."""
    decompose_by_hand(suzanne, 7, **FAST)
    suzanne.wcd_parts[3].name = "The Left Ear of Suzanne the Monkey"
    return suzanne


def test_no_text_is_cut_off_in_the_usual_sidebar(decomposed):
    bpy.ops.wcd.build_hulls(pieces="PARTS", shape="BOX")
    panels = [each for each in ui.CLASSES if issubclass(each, bpy.types.Panel)]
    for scale, row, parts in product((1.0, 1.5), (0, 3), (0, 120)):
        decomposed.wcd_active_part, bpy.context.scene.wcd.parts = row, parts
        shown = [p for p in panels if not hasattr(p, "poll") or p.poll(context())]
        assert len(shown) >= 7
        for panel in shown:
            layout = drawn(panel, scale)
            assert list(layout.texts())
            cut_off = list(layout.cut_off(_SIDEBAR - _EDGES))
            assert cut_off == [], (panel, scale, row, parts)


@pytest.mark.parametrize(("n_parts", "hulls"), [(2, True), (7, False), (12, False)])
def test_columns_go_before_figures_are_cut(suzanne, n_parts, hulls):
    decompose_by_hand(suzanne, n_parts, **FAST)
    suzanne.wcd_parts[0].name = "Part 04.R"
    if hulls:
        bpy.ops.wcd.build_hulls(pieces="PARTS", shape="BOX")
    layout = Layout()
    row = suzanne.wcd_parts[0]
    WCD_UL_parts.draw_item(
        None, context(), layout, suzanne, row, 0, suzanne, "wcd_active_part", 0
    )
    bar = 20 if n_parts > 9 else 0
    room = _SIDEBAR - _EDGES - _LIST - bar
    assert layout.natural() + 0.35 * _ICON <= room  # and the color
    assert list(layout.cut_off(room)) == []
    assert any("." in text for text in layout.texts() if text != row.name)


def test_usual_names_have_room_on_buttons(decomposed):
    decomposed.wcd_parts[1].name = "Part 04.R"
    decomposed.wcd_active_part = 1
    texts = list(drawn(WCD_PT_edit).texts())
    assert sum(text.endswith(" Part 04.R") for text in texts) == 6
    assert not any("…" in text for text in texts)


def test_buttons_say_what_they_act_on(decomposed):
    decomposed.wcd_active_part = 0
    assert {"Isolate Part 01", "Frame Part 01"} <= set(drawn(WCD_PT_edit).texts())
    for row in (1, 2, 4):
        decomposed.wcd_parts[row].chosen = True
    assert {"Merge 3 Parts", "Select 3 Parts"} <= set(drawn(WCD_PT_edit).texts())
    decomposed.wcd_active_part = 5
    assert acted_on(decomposed) == ["Part 06"]
    assert "Select Part 06" in drawn(WCD_PT_edit).texts()


def test_quality_is_a_word_and_psi_is_in_its_tooltip(decomposed, capfd):
    texts = list(drawn(WCD_PT_parts).texts())
    assert texts[texts.index("Quality") + 1] == "Poor"  # 0.75 of 1.5
    tooltip = WCD_OT_tell_quality.description(bpy.context, None)
    assert tooltip.startswith("ψ = 0.750, and 0.500 as one part.")
    assert bpy.ops.wcd.tell_quality() == {"FINISHED"}
    assert tooltip in capfd.readouterr().out


def test_a_refused_name_is_told_below_the_table(decomposed):
    decomposed.wcd_active_part = 1
    decomposed.wcd_parts[1].name = "Part 01"
    assert "Another part is called" in " ".join(drawn(WCD_PT_parts).texts())


def test_no_result_is_shown_where_there_is_nothing_to_say(suzanne):
    assert not WCD_PT_parts.poll(bpy.context)
    bpy.ops.wcd.build_hulls(shape="BOX", max_hulls=1, max_error=1.0)
    if WCD_PT_parts.poll(bpy.context):  # hulls came with a note
        assert list(drawn(WCD_PT_parts).texts())
    bpy.ops.wcd.measure(samples=100)
    assert WCD_PT_parts.poll(bpy.context)


def test_the_number_of_parts_is_auto_or_a_number(decomposed):
    settings = bpy.context.scene.wcd
    assert "Auto" in drawn(WCD_PT_main).texts()
    assert settings.auto_parts
    settings.auto_parts = False
    assert settings.parts == 7  # as many as there are
    settings.auto_parts = True
    assert settings.parts == 0


@pytest.mark.parametrize("sight", ["BLOCKS", "ALL_PAIRS", "CONE"])
def test_parts_rays_and_detail_are_in_front_and_never_gray(sight):
    settings = bpy.context.scene.wcd
    settings.sight = sight
    assert FRONT == ("parts", "rays", "alpha")
    assert all(is_used(settings, name) for name in FRONT)
    labels = [settings.bl_rna.properties[name].name for name in FRONT]
    assert labels == ["Parts", "Rays", "Detail"]
    for name, symbol in zip(FRONT, ("(k)", "(r)", "(α)"), strict=True):
        assert symbol in settings.bl_rna.properties[name].description
