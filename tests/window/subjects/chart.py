"""A click on the chart of psi chooses a number of parts; undo takes it back."""

import bpy
from edited import record_of
from leftovers import leftovers
from weak_convex_decomposition.operators.running import modal as running


def record():
    return record_of(bpy.context.active_object)


def steps(hands):
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    bpy.context.scene.wcd.samples = 300
    yield from hands.parted_suzanne(1, samples=300)
    first = record()
    chosen = 3 if first["k"] != 3 else 4
    wanted = f"wcd.choose_part_count(parts={chosen})"
    place = yield from hands.find(wanted, columns=(0.12,))
    yield from hands.click(place)
    yield lambda: record()["k"] == chosen
    yield lambda: running.current is None
    assert bpy.context.scene.wcd.parts == chosen
    assert record()["psi_by_k"] == first["psi_by_k"]
    assert len(record()["parts"]) == chosen
    assert leftovers() == []
    yield 0.5
    hands.picture("chosen")
    yield from hands.undo()
    yield lambda: record() == first
    assert bpy.context.scene.wcd.parts == 0
