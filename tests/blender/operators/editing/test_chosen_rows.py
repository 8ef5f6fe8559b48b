"""Which rows of the table the buttons act on: ticked ones, or the highlighted one."""

import bpy
import pytest
from edited import parts_of
from weak_convex_decomposition.operators.bridge.parts.rows import (
    chosen_numbers,
    chosen_parts,
    look_left,
)


def ticked(obj):
    return [row.number for row in obj.wcd_parts if row.chosen]


@pytest.fixture
def table(monkey):
    """Four rows, of which none is ticked; the second is highlighted."""
    monkey.wcd_active_part = 3
    monkey.wcd_active_part = 1
    return monkey


def test_a_click_on_a_row_that_is_not_ticked_takes_old_ticks_away(monkey):
    assert chosen_numbers(monkey) == {1, 2}
    monkey.wcd_active_part = 2  # which is ticked
    assert chosen_numbers(monkey) == {1, 2}
    monkey.wcd_active_part = 3
    assert ticked(monkey) == []
    assert chosen_numbers(monkey) == {3}
    assert chosen_parts(monkey) == [3]
    assert not bpy.ops.wcd.merge_parts.poll()


def test_a_tick_counts_whichever_row_was_highlighted(table):
    table.wcd_parts[3].chosen = True
    assert (table.wcd_active_part, chosen_numbers(table)) == (3, {3})
    table.wcd_parts[0].chosen = True
    assert (table.wcd_active_part, chosen_numbers(table)) == (3, {0, 3})


def test_the_highlight_leaves_a_row_whose_tick_is_taken_away(monkey):
    monkey.wcd_parts[1].chosen = False
    assert (monkey.wcd_active_part, chosen_numbers(monkey)) == (2, {2})
    monkey.wcd_parts[2].chosen = False
    assert chosen_numbers(monkey) == {2}  # it is highlighted


def test_merged_parts_have_the_name_of_the_row_that_was_ticked_first(table):
    for row in (2, 0):
        table.wcd_parts[row].chosen = True
    bpy.ops.wcd.merge_parts()
    assert [name for name, _, _ in parts_of(table)] == ["Part 02", "Part 03", "Part 04"]


def test_a_click_is_looked_at_for_a_moment_and_a_run_is_no_click(table):
    assert look_left(table) > 1
    bpy.ops.wcd.refresh_parts()
    assert look_left(table) == 0
    bpy.ops.object.duplicate()
    table.wcd_active_part = 2
    assert 1 < look_left(table) < 2
    assert look_left(bpy.context.active_object) == 0


def test_ticks_and_the_highlight_outlast_a_run(monkey):
    before = ticked(monkey), monkey.wcd_active_part
    bpy.ops.wcd.refresh_parts()
    assert (ticked(monkey), monkey.wcd_active_part) == before


def test_undo_brings_ticks_back(monkey):
    bpy.ops.ed.undo_push(message="ticks")
    monkey.wcd_active_part = 3
    bpy.ops.ed.undo_push(message="click")
    bpy.ops.ed.undo()
    assert ticked(bpy.context.active_object) == [1, 2]
