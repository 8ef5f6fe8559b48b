"""Names: which are refused and why, and all of them at once."""

from types import SimpleNamespace

import bpy
import pytest
from edited import check_in_step, parts_of
from hand_made import decompose_by_hand
from snapshot import snapshot
from stand_ins.layout import Layout, drawn
from weak_convex_decomposition.operators.bridge.parts.rows import noted_refusal
from weak_convex_decomposition.operators.editing.rename_parts import WCD_OT_rename_parts
from weak_convex_decomposition.ui.hulls_panel import WCD_PT_hulls, endings
from weak_convex_decomposition.ui.sidebar import hull_rows_of

NAMES = ["Head", "Ear.L", "Ear.R", "Jaw"]
LONG = "an ear that is much too long for the name of a vertex group, as it is"


def names(obj):
    return [name for name, _, _ in parts_of(obj)]


@pytest.fixture
def pair(suzanne):
    """A head with a pair of ears, and a jaw."""
    decompose_by_hand(suzanne, 4)
    for row, name in zip(suzanne.wcd_parts, NAMES, strict=True):
        row.name = name
    return suzanne


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("Jaw", "Another part is called Jaw"),
        (" ", "needs a name"),
        ("wcd_part", "an attribute of the parts"),
        (LONG, "at most 63"),
    ],
)
def test_a_name_that_is_refused_says_so(pair, name, reason):
    pair.wcd_active_part = 0
    before = snapshot(pair)
    pair.wcd_parts[0].name = name
    assert snapshot(pair) == before
    assert reason in noted_refusal(pair)
    assert "still Head" in noted_refusal(pair)
    pair.wcd_active_part = 1
    assert noted_refusal(pair) is None  # it is about another row
    pair.wcd_active_part = 0
    pair.wcd_parts[0].name = "Skull"
    assert noted_refusal(pair) is None


def refuse(obj):
    """Ask for a name that another part has."""
    obj.wcd_active_part = 0
    obj.wcd_parts[0].name = "Jaw"
    assert "Another part is called Jaw" in noted_refusal(obj)


def clear_and_decompose(obj):
    bpy.ops.wcd.clear()
    decompose_by_hand(obj, 4)


@pytest.mark.parametrize(
    "change",
    [
        lambda obj: setattr(obj.wcd_parts[3], "name", "Chin"),
        lambda obj: bpy.ops.wcd.rename_parts(way="NUMBER", pattern="P#"),
        lambda obj: decompose_by_hand(obj, 4),
        clear_and_decompose,
    ],
)
def test_a_refusal_goes_with_its_reason(pair, change):
    refuse(pair)
    change(pair)
    pair.wcd_active_part = 0
    assert noted_refusal(pair) is None


def test_a_refusal_goes_with_undo(pair):
    bpy.ops.ed.undo_push(message="before")
    refuse(pair)
    bpy.ops.ed.undo_push(message="refused")
    bpy.ops.ed.undo()
    assert noted_refusal(bpy.context.active_object) is None


def test_each_dialog_says_which_parts_it_is_about():
    scopes = {}
    for name in ("rename_parts", "smooth_seams", "mark_seams"):
        rna = getattr(bpy.ops.wcd, name).get_rna_type()
        scopes[name] = rna.properties["scope"].name
    assert scopes.pop("rename_parts") == "Names Of"
    assert set(scopes.values()) == {"Seams Of"}


def test_a_name_that_the_users_group_has_gets_a_number_and_says_so(pair):
    pair.vertex_groups.new(name="Skull")
    pair.wcd_active_part = 0
    pair.wcd_parts[0].name = "Skull"
    assert pair.wcd_parts[0].name == "Skull.001"
    assert "this one is Skull.001" in noted_refusal(pair)
    check_in_step(pair)


def test_names_are_numbered_and_pairs_keep_one(pair):
    assert bpy.ops.wcd.rename_parts(way="NUMBER", pattern="P##") == {"FINISHED"}
    assert names(pair) == ["P01", "P02.L", "P02.R", "P03"]
    check_in_step(pair)


def test_a_text_is_replaced_in_all_names(pair):
    bpy.ops.wcd.rename_parts(way="REPLACE", find="a", replace="oo")
    assert names(pair) == ["Heood", "Eoor.L", "Eoor.R", "Joow"]
    check_in_step(pair)


def test_typed_names_may_take_each_others_place(pair):
    typed = [("Head", "Jaw"), ("Ear", "Horn"), ("Jaw", "Head")]
    table = [{"name": name, "new": new} for name, new in typed]
    bpy.ops.wcd.rename_parts(names=table)
    assert names(pair) == ["Jaw", "Horn.L", "Horn.R", "Head"]
    assert [row.name for row in pair.wcd_parts] == names(pair)
    check_in_step(pair)


def test_only_chosen_parts_are_renamed_and_partners_with_them(pair):
    pair.wcd_parts[2].chosen = True
    bpy.ops.wcd.rename_parts(way="NUMBER", pattern="Horn", scope="CHOSEN")
    assert names(pair) == ["Head", "Horn.L", "Horn.R", "Jaw"]
    check_in_step(pair)


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({"way": "NUMBER", "pattern": "Part"}, "no place for a number"),
        ({"way": "REPLACE", "find": "Head", "replace": "Jaw"}, "is called Jaw"),
        ({"way": "REPLACE", "find": "Jaw", "replace": ""}, "needs a name"),
        ({"way": "NUMBER", "pattern": LONG + "#"}, "at most 63"),
    ],
)
def test_all_names_stay_if_one_is_refused(pair, settings, sentence):
    before = snapshot(pair)
    with pytest.raises(RuntimeError, match=sentence):
        bpy.ops.wcd.rename_parts(**settings)
    assert snapshot(pair) == before


def test_renaming_all_is_one_undo_step(pair):
    before = snapshot(pair)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.wcd.rename_parts("EXEC_DEFAULT", True, way="NUMBER", pattern="P#")
    bpy.ops.ed.undo()
    assert snapshot(bpy.context.active_object) == before


def test_names_are_drawn_as_they_are_in_all_languages(pair):
    dialog, layout = WCD_OT_rename_parts, Layout()
    asked = SimpleNamespace(layout=layout, way="REPLACE", find="", replace="")
    asked.scope, asked.bl_rna = "ALL", bpy.ops.wcd.rename_parts.get_rna_type()
    asked._rows = lambda obj: dialog._rows(asked, obj)
    asked._bases = lambda rows: dialog._bases(asked, rows)
    dialog.draw(asked, bpy.context)
    assert layout.untranslated() == {"Head", "Ear", "Ear  .L .R", "Jaw"}
    bpy.context.scene.wcd.pieces = "PARTS"
    bpy.ops.wcd.build_hulls(pieces="PARTS", shape="BOX")
    hulls = set(endings([hull["name"] for hull in hull_rows_of(pair)]))
    assert {*NAMES, *hulls} <= drawn(WCD_PT_hulls).untranslated()
