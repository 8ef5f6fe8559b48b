"""A first look at the parts of a large mesh, and the parts that replace it."""

import bpy
import pytest
from snapshot import snapshot
from weak_convex_decomposition.core.parts import part_memo
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.operators.bridge.stored.record import (
    is_rough,
    noted_parameters,
    record_of,
)
from weak_convex_decomposition.operators.bridge.work.locking import decompose_unlocked
from weak_convex_decomposition.operators.running import refine
from weak_convex_decomposition.operators.settings import parameters_from

SETTINGS = {"samples": 200, "parts": 5}


@pytest.fixture
def rough(suzanne, monkeypatch):
    """Suzanne with a first look at five parts of hers."""
    monkeypatch.setattr(part_memo, "_MOST_NODES", 300)  # as if she had many more faces
    bpy.ops.wcd.decompose(samples=200, parts=4)
    look_first(suzanne, parts=5)
    return suzanne


def look_first(obj, **settings):
    """Write a first look, as a changed setting does in a window."""
    for name, value in {**SETTINGS, **settings}.items():
        setattr(bpy.context.scene.wcd, name, value)
    wanted = parameters_from(bpy.context.scene.wcd)
    run(decompose_unlocked(obj, wanted, rough=True)).write(obj)


def as_by_a_run(obj, **settings):
    """Return what a run leaves on an object."""
    bpy.ops.wcd.decompose(**{**SETTINGS, **settings})
    return snapshot(obj)


def refined(obj):
    for _ in range(10_000):
        if refine.go_on() is None:
            return snapshot(obj)
    raise AssertionError("the parts were never found")


def test_a_first_look_has_as_many_parts(rough):
    assert is_rough(rough)
    assert record_of(rough)["k"] == len(rough.wcd_parts) == 5
    assert noted_parameters(rough).parts == 5


@pytest.mark.parametrize("change", [{"parts": 6}, {"alpha": 1.0}, {"smoothness": 0.1}])
def test_it_becomes_what_a_run_gives(rough, change):
    looked = snapshot(rough)
    look_first(rough, **change)
    assert is_rough(rough)
    found = refined(rough)
    assert not is_rough(rough)
    assert found != looked
    assert found == as_by_a_run(rough, **change)


def test_without_a_number_it_has_the_best_of_those_tried_last(rough):
    as_by_a_run(rough, parts=0)
    known = len(rough.wcd_parts)
    for alpha, more in ((0.3, False), (9.0, True)):
        look_first(rough, parts=0, alpha=alpha)
        assert is_rough(rough)
        assert (record_of(rough)["k"] > known) == more
        assert refined(rough) == as_by_a_run(rough, parts=0, alpha=alpha)
        assert (len(rough.wcd_parts) > known) == more


@pytest.mark.parametrize("few", [300, 20_000])
def test_above_the_highest_number_tried_it_has_the_number_too(
    suzanne, monkeypatch, few
):
    monkeypatch.setattr(part_memo, "_MOST_NODES", few)
    bpy.ops.wcd.decompose(samples=200, parts=4)
    for parts in (18, 24):
        look_first(suzanne, parts=parts)
        assert is_rough(suzanne)
        assert record_of(suzanne)["k"] == parts
        assert refined(suzanne) == as_by_a_run(suzanne, parts=parts)
        look_first(suzanne, parts=parts)
        assert not is_rough(suzanne)  # they are known now


@pytest.mark.parametrize(("change", "n_parts"), [({"parts": 2}, 2), ({"parts": 0}, 5)])
def test_it_keeps_to_the_range_of_numbers(rough, change, n_parts):
    settings = bpy.context.scene.wcd
    settings.max_parts, settings.min_parts = 6, 5
    look_first(rough)
    refined(rough)  # five and six are tried
    look_first(rough, **change, alpha=2.0 if change["parts"] else 0.3)
    assert record_of(rough)["k"] == n_parts
    assert is_rough(rough)


def test_the_chart_keeps_its_numbers_meanwhile(rough):
    tried = record_of(rough)["psi_by_k"].keys()
    look_first(rough, alpha=1.0)
    assert is_rough(rough)
    assert record_of(rough)["psi_by_k"].keys() == tried


def test_files_never_keep_a_first_look(rough, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "rough.blend"))
    assert not is_rough(rough)
    assert snapshot(rough) == as_by_a_run(rough)


def test_a_mesh_that_was_changed_keeps_its_parts(rough):
    for vertex in rough.data.vertices:
        vertex.co.z *= 1.5
    rough.data.update()
    parts = [each.value for each in rough.data.attributes["wcd_part"].data]
    refined(rough)
    assert not is_rough(rough)
    assert [each.value for each in rough.data.attributes["wcd_part"].data] == parts


def test_it_waits_for_the_mode(rough):
    bpy.ops.object.mode_set(mode="SCULPT")
    assert refine.go_on() == refine._RETRY
    assert is_rough(rough)
    bpy.ops.object.mode_set(mode="OBJECT")
    refined(rough)
    assert not is_rough(rough)


def test_a_deleted_object_is_no_trouble(rough):
    refine.go_on()
    assert refine.working()
    bpy.data.objects.remove(rough)
    assert refine.go_on() is None
    assert not refine.working()


def test_other_buttons_wait_for_the_seams(rough):
    for use in (bpy.ops.wcd.explode, bpy.ops.wcd.separate, bpy.ops.wcd.merge_parts):
        assert not use.poll()
    assert bpy.ops.wcd.decompose.poll()
    assert bpy.ops.wcd.choose_part_count.poll()
    refined(rough)
    assert bpy.ops.wcd.explode.poll()


def test_undo_of_what_came_after_finds_the_parts_again(rough):
    bpy.ops.ed.undo_push(message="First look")
    name = rough.name
    refined(rough)
    bpy.ops.ed.undo_push(message="Parts")
    bpy.ops.ed.undo()
    assert not is_rough(bpy.data.objects[name])
