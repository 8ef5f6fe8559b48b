"""What panels draw: nothing is cut off at the sidebar's usual width, nothing is empty.

What has changed is said, and the star of the chart is on the best number of parts.
"""

from dataclasses import replace
from itertools import product
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from edited import FAST
from hand_made import bands, decompose_by_hand, decomposition_of
from stand_ins.layout import EDGES, ICON, SIDEBAR, Layout, context, drawn
from weak_convex_decomposition import ui
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.operators.bridge.parts.write import write_parts
from weak_convex_decomposition.operators.measure import WCD_OT_tell_quality
from weak_convex_decomposition.operators.settings import FRONT, is_used
from weak_convex_decomposition.ui.chart import WCD_PT_chart
from weak_convex_decomposition.ui.edit_panel import WCD_PT_edit, acted_on
from weak_convex_decomposition.ui.panels import WCD_PT_main, WCD_PT_parts, notes_of
from weak_convex_decomposition.ui.parts_table import WCD_UL_parts

# Of the edges of a list, in points.
_LIST = 12


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
            cut_off = list(layout.cut_off(SIDEBAR - EDGES))
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
    room = SIDEBAR - EDGES - _LIST - bar
    assert layout.natural() + 0.35 * ICON <= room  # and the color
    assert list(layout.cut_off(room)) == []
    assert any("." in text for text in layout.texts() if text != row.name)


@pytest.mark.parametrize(
    ("search", "inverted", "by_name", "expected"),
    [
        ("", False, False, ["Tail", "Leg.R", "leg 2 R", "Arm"]),
        ("", True, False, ["Tail", "Leg.R", "leg 2 R", "Arm"]),
        ("Leg*R", False, False, ["Leg.R", "leg 2 R"]),
        ("Leg*R", True, False, ["Tail", "Arm"]),
        ("", False, True, ["Arm", "leg 2 R", "Leg.R", "Tail"]),
        ("a", False, True, ["Arm", "Tail"]),
    ],
)
def test_the_table_is_searched_and_sorted(suzanne, search, inverted, by_name, expected):
    labels = bands(suzanne, 5)
    write_parts(suzanne, decomposition_of(labels), Parameters(**FAST))
    for row, name in zip(
        suzanne.wcd_parts, ("Tail", "Leg.R", "leg 2 R", "Gone.R", "Arm"), strict=True
    ):
        row.name = name
    layer = suzanne.data.attributes["wcd_part"].data
    layer.foreach_set("value", np.where(labels == 3, 4, labels).astype(np.int32))
    table = SimpleNamespace(
        filter_name=search,
        bitflag_filter_item=4,
        use_filter_invert=inverted,
        use_filter_sort_alpha=by_name,
    )
    flags, order = WCD_UL_parts.filter_items(table, bpy.context, suzanne, "wcd_parts")
    order = order or range(5)
    shown = [bool(flag & 4) != inverted for flag in flags]
    names = {order[n]: suzanne.wcd_parts[n].name for n in range(5) if shown[n]}
    assert [names[place] for place in sorted(names)] == expected


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


def test_what_is_out_of_date_says_so_until_it_is_refreshed(decomposed):
    assert "Refresh" not in drawn(WCD_PT_parts).texts()
    decomposed.data.vertices[0].co.x += 0.5
    texts = drawn(WCD_PT_parts).texts()
    assert "Out of date. The mesh has changed; press Refresh" in " ".join(texts)
    assert "Refresh" in texts
    assert "Quality" not in texts
    bpy.ops.wcd.refresh_parts()
    texts = drawn(WCD_PT_parts).texts()
    assert "Quality" in texts
    assert not {"Refresh", "Out of date."} & set(texts)


def test_the_switch_for_edits_comes_with_parts(decomposed):
    assert "Keep Edits" in drawn(WCD_PT_main).texts()
    bpy.ops.wcd.clear()
    assert "Keep Edits" not in drawn(WCD_PT_main).texts()


@pytest.mark.parametrize(
    ("best", "why"), [(7, None), (2, "2 is best: 7 gain only 4% more.")]
)
def test_the_star_is_on_the_best_number_and_says_why(suzanne, best, why):
    found = decomposition_of(bands(suzanne, 7))
    tried = {1: 0.5, 2: 0.74, 3: 0.55, 7: 0.75}
    write_parts(suzanne, replace(found, best_k=best, psi_by_k=tried), Parameters())
    layout = drawn(WCD_PT_chart)
    icons = {
        text: icon for text, icon in layout.icons() if text in {"1", "2", "3", "7"}
    }
    assert [text for text, icon in icons.items() if icon == "SOLO_ON"] == [str(best)]
    assert icons["1"] == icons["3"] == "NONE"
    assert why is None or why in " ".join(layout.texts())


def test_parts_split_by_hand_are_no_details(suzanne):
    result = decomposition_of(bands(suzanne, 4))
    result = replace(result, psi_by_k={1: 0.5, 3: 1.0}, best_k=3)
    write_parts(suzanne, result, Parameters(**FAST))
    text = "3 parts of the whole, and 1 more in their details."
    assert text in " ".join(drawn(WCD_PT_chart).texts())
    bpy.ops.wcd.split_parts()
    assert len(suzanne.wcd_parts) == 5
    assert "details" not in " ".join(drawn(WCD_PT_chart).texts())


def test_of_many_numbers_those_near_the_best_have_bars(suzanne):
    found = decomposition_of(bands(suzanne, 7))
    tried = {k: float(k) for k in range(1, 101)}
    write_parts(suzanne, replace(found, best_k=90, psi_by_k=tried), Parameters())
    shown = [int(text) for text in drawn(WCD_PT_chart).texts() if text.isdecimal()]
    assert shown == [*range(75, 101)]


def test_no_result_is_shown_where_there_is_nothing_to_say(suzanne):
    assert not WCD_PT_parts.poll(bpy.context)
    bpy.ops.wcd.build_hulls(shape="BOX", max_hulls=1, max_error=1.0)
    if WCD_PT_parts.poll(bpy.context):  # hulls came with a note
        assert list(drawn(WCD_PT_parts).texts())
    bpy.ops.wcd.measure(samples=100)
    assert WCD_PT_parts.poll(bpy.context)


@pytest.mark.parametrize("cause", ["removed", "joined"])
def test_lost_parts_are_told(decomposed, cause):
    attributes = decomposed.data.attributes
    if cause == "removed" or bpy.app.version < (5, 0):  # which drops none at a join
        attributes.remove(attributes["wcd_part"])
    else:
        bpy.ops.mesh.primitive_cube_add()
        bpy.context.object.vertex_groups.new(name="wcd_part")
        decomposed.select_set(True)
        bpy.context.view_layer.objects.active = decomposed
        bpy.ops.object.join()
    assert WCD_PT_parts.poll(bpy.context)
    assert notes_of(decomposed) == ["Suzanne has lost its parts; decompose it again."]


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
