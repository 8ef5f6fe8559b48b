"""Warnings stay readable after the run: in the record, and so in the sidebar."""

import json

import bpy
import pytest
from edited import record_of
from weak_convex_decomposition.ui.panels import notes_of, result_of

FAST = {"samples": 300}


@pytest.fixture
def mirrored(suzanne):
    suzanne.modifiers.new("Mirror", "MIRROR")
    return suzanne


def test_notes_on_reading_and_on_the_result_are_recorded(mirrored):
    bpy.ops.wcd.decompose(samples=16, parts=16, smallest_part=0.5)
    reading, choosing, counting = record_of(mirrored)["notes"]
    assert "without its modifiers (Mirror)" in reading
    assert "choose Mesh: Evaluated" in choosing
    assert "of the 16 parts could be made" in counting


def test_notes_go_when_their_cause_is_gone(mirrored):
    bpy.ops.wcd.decompose(**FAST)
    mirrored.modifiers.clear()
    bpy.ops.wcd.decompose(**FAST)
    assert record_of(mirrored)["notes"] == []


def test_the_sidebar_gets_each_note_once(mirrored):
    bpy.ops.wcd.measure(**FAST)
    assert len(notes_of(mirrored)) == 1
    bpy.ops.wcd.decompose(**FAST)
    note, advice = notes_of(mirrored)
    assert note.startswith("The mesh was read without its modifiers")
    assert advice.startswith("To include modifiers")


@pytest.mark.parametrize("work", ["measure", "merge_parts", "seams"])
def test_what_is_seen_is_not_advised_where_it_cannot_be_read(mirrored, work):
    if work == "seams":
        bpy.ops.wcd.decompose(**FAST, seams="CUT")
    elif work == "measure":
        bpy.ops.wcd.measure(**FAST)
    else:
        bpy.ops.wcd.decompose(**FAST, parts=3)
        for row in mirrored.wcd_parts[:2]:
            row.chosen = True
        bpy.ops.wcd.merge_parts()
    notes = " ".join(notes_of(mirrored))
    assert "without its modifiers (Mirror)" in notes
    assert "Evaluated" not in notes


def test_a_record_without_notes_is_read(suzanne):
    bpy.ops.wcd.measure(**FAST)
    record = record_of(suzanne)
    del record["measured"]["notes"]
    suzanne["wcd"] = json.dumps(record)
    assert notes_of(suzanne) == []


@pytest.mark.parametrize("value", ["not JSON", 3, "[1]", '{"parts": [{}]}'])
def test_the_sidebar_shows_nothing_of_a_users_property(suzanne, value):
    suzanne["wcd"] = value
    assert result_of(suzanne) == {}
