"""Operators as buttons start them: progress, Esc and Cancel."""

from types import SimpleNamespace

import bpy
import pytest
from snapshot import snapshot
from stand_ins.presses import (
    ESC,
    GONE,
    MOUSE,
    OPERATORS,
    TIMER,
    call_of,
    cube_at,
    finish,
    press,
    select,
    values_of,
)
from weak_convex_decomposition.core.steps.processes import Processes
from weak_convex_decomposition.operators.bridge.work import computing_hulls
from weak_convex_decomposition.operators.decompose import WCD_OT_decompose
from weak_convex_decomposition.operators.hulls import (
    WCD_OT_build_hulls,
    WCD_OT_refit_hull,
)
from weak_convex_decomposition.operators.measure import WCD_OT_measure
from weak_convex_decomposition.operators.running import modal


@pytest.mark.parametrize("cls", OPERATORS)
def test_a_button_gives_what_a_script_gives(suzanne, window, cls):
    bpy.context.scene.wcd.samples = 300
    before = snapshot(suzanne)
    assert call_of(cls)(**values_of(cls)) == {"FINISHED"}
    expected = snapshot(suzanne)
    bpy.ops.wcd.clear()
    assert snapshot(suzanne) == before
    pressed = press(cls, window)
    assert finish(pressed) == {"FINISHED"}
    assert snapshot(suzanne) == expected
    assert window.is_clean()
    assert window.handlers == [pressed]
    assert pressed.reports[-1][0] == "INFO"


def test_several_objects_have_one_progress_and_esc_leaves_all(window):
    objects = [cube_at(0), cube_at(5), cube_at(10)]
    select(*objects)
    before = [snapshot(obj) for obj in objects]
    pressed = press(WCD_OT_decompose, window)
    shares, stages = [], []
    for _ in range(3):
        pressed.modal(None, TIMER)
    assert pressed.modal(None, ESC) == {"CANCELLED"}
    assert [snapshot(obj) for obj in objects] == before
    pressed = press(WCD_OT_decompose, window)
    while pressed.modal(None, TIMER) == {"PASS_THROUGH"}:
        shares.append(modal.current.job.progress.fraction)
        stages.append(modal.current.job.progress.stage.partition(":")[0])
    assert shares == sorted(shares)
    assert set(stages) == {"Cube", "Cube.001", "Cube.002"}
    assert all("wcd_part" in obj.data.attributes for obj in objects)


def test_one_object_deleted_meanwhile_does_not_stop_the_others(window):
    kept, gone = cube_at(0), cube_at(5)
    select(kept, gone)
    pressed = press(WCD_OT_decompose, window)
    pressed.modal(None, TIMER)
    bpy.data.objects.remove(gone)
    assert finish(pressed) == {"FINISHED"}
    assert "wcd_part" in kept.data.attributes
    assert ("WARNING", "Cube.001: " + GONE) in pressed.reports
    assert "ERROR" not in dict(pressed.reports)


def test_a_slice_of_time_has_as_many_steps_as_fit(window, monkeypatch):
    cube_at(0)
    pressed = press(WCD_OT_decompose, window)
    assert pressed.modal(None, TIMER) == {"PASS_THROUGH"}
    monkeypatch.setattr(modal, "_SLICE", 1e9)
    assert pressed.modal(None, TIMER) == {"PASS_THROUGH"}
    assert modal.current.job.done
    assert pressed.modal(None, TIMER) == {"FINISHED"}  # writing is a step of its own


def test_progress_is_told_and_other_events_pass(suzanne, window, monkeypatch):
    monkeypatch.setattr(modal, "_LOOKS", (0.0, 0.0))
    pressed = press(WCD_OT_decompose, window)
    shares = []
    while pressed.modal(None, MOUSE) == pressed.modal(None, TIMER) == {"PASS_THROUGH"}:
        progress = modal.current.job.progress
        shares.append(progress.fraction)
        assert f"{progress.stage}, {progress.fraction:.0%}" in window.status
    assert shares == sorted(shares)
    assert len(shares) > 5


@pytest.mark.parametrize(("drawing", "seconds"), [(0.001, 0.5), (0.1, 2.0), (0.8, 5.0)])
def test_progress_is_drawn_less_often_where_that_takes_long(
    suzanne, window, monkeypatch, drawing, seconds
):
    now = 100.0
    monkeypatch.setattr(modal, "time", SimpleNamespace(perf_counter=lambda: now))
    pressed = press(WCD_OT_decompose, window)
    assert not window.status  # a quick run shows nothing
    now = began = 100.6
    pressed.modal(None, TIMER)
    assert window.status
    now += drawing
    pressed.modal(None, TIMER)
    for late, drawn in ((0.99, False), (1.01, True)):
        window.status = ""
        now = began + late * seconds
        pressed.modal(None, TIMER)
        assert bool(window.status) == drawn


@pytest.mark.parametrize("cls", OPERATORS)
def test_esc_leaves_everything_as_it_was(suzanne, window, cls):
    before = snapshot(suzanne)
    pressed = press(cls, window)
    pressed.modal(None, TIMER)
    assert not window.is_clean()
    assert pressed.modal(None, ESC) == {"CANCELLED"}
    assert window.is_clean()
    assert snapshot(suzanne) == before
    assert bpy.ops.wcd.measure(samples=100) == {"FINISHED"}  # nothing in the way


def test_esc_that_is_let_go_stops_nothing(suzanne, window):
    pressed = press(WCD_OT_decompose, window)
    let_go = SimpleNamespace(type="ESC", value="RELEASE")
    assert pressed.modal(None, let_go) == {"PASS_THROUGH"}
    assert not window.is_clean()


def test_the_cancel_button_stops(suzanne, window):
    assert not bpy.ops.wcd.cancel.poll()
    with pytest.raises(RuntimeError, match="Nothing is running"):
        bpy.ops.wcd.cancel()
    before = snapshot(suzanne)
    pressed = press(WCD_OT_decompose, window)
    assert bpy.ops.wcd.cancel() == {"FINISHED"}
    assert window.is_clean()
    assert "CANCELLED" in pressed.modal(None, MOUSE)
    assert snapshot(suzanne) == before


@pytest.mark.parametrize("name", ["decompose", "measure", "build_hulls"])
def test_one_at_a_time(suzanne, window, name):
    pressed = press(WCD_OT_measure, window)
    with pytest.raises(RuntimeError, match="Measure Convexity is running; wait"):
        getattr(bpy.ops.wcd, name)()
    assert finish(pressed) == {"FINISHED"}


@pytest.fixture
def started(monkeypatch):
    """All processes that are started; every mesh counts as a large one."""
    made = []

    def noted(count):
        made.append(Processes(count))
        return made[-1]

    monkeypatch.setattr(computing_hulls, "_MANY", 0)
    monkeypatch.setattr(computing_hulls, "Processes", noted)
    yield made
    for processes in made:
        processes.close()


def test_another_process_builds_hulls_of_large_meshes(suzanne, window, started):
    assert bpy.ops.wcd.build_hulls(**values_of(WCD_OT_build_hulls)) == {"FINISHED"}
    expected = snapshot(suzanne)
    assert not started  # a script waits anyway
    bpy.ops.wcd.remove_hulls()
    pressed, shares = press(WCD_OT_build_hulls, window), set()
    while pressed.modal(None, TIMER) == {"PASS_THROUGH"}:
        shares.add(modal.current.job.progress.fraction)
    assert snapshot(suzanne) == expected
    assert len(shares) > 3  # the process tells how far it is
    (processes,) = started
    assert [one.poll() is None for one in processes._started] == [False]


def test_esc_ends_the_process_that_builds_hulls(suzanne, window, started):
    before = snapshot(suzanne)
    pressed = press(WCD_OT_build_hulls, window)
    while not (started and started[0]._started):
        pressed.modal(None, TIMER)
    assert pressed.modal(None, ESC) == {"CANCELLED"}
    assert snapshot(suzanne) == before
    assert window.is_clean()
    assert [one.poll() is None for one in started[0]._started] == [False]


def test_a_hull_of_a_large_mesh_gets_another_shape_in_another_process(
    suzanne, window, started
):
    bpy.ops.wcd.build_hulls(max_hulls=2)
    values = {"hull": suzanne.children[0].name, "shape": "BOX"}
    pressed = press(WCD_OT_refit_hull, window, **values)
    assert finish(pressed) == {"FINISHED"}
    assert len(started) == 1
    assert 8 in [len(hull.data.vertices) for hull in suzanne.children]
