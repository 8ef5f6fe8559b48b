"""Operators as buttons start them, in a stand-in for the window that wheels lack."""

import inspect
from contextlib import nullcontext
from types import SimpleNamespace

import bpy
import pytest
import weak_convex_decomposition as package
from hands import hand_curve
from snapshot import snapshot
from weak_convex_decomposition.operators.decompose import WCD_OT_decompose
from weak_convex_decomposition.operators.hulls import WCD_OT_build_hulls
from weak_convex_decomposition.operators.measure import WCD_OT_measure
from weak_convex_decomposition.operators.running import modal

OPERATORS = (WCD_OT_decompose, WCD_OT_measure, WCD_OT_build_hulls)
# What operators are given in place of their defaults.
FAST = {"samples": 300, "max_parts": 6, "max_hulls": 4}
TIMER = SimpleNamespace(type="TIMER", value="NOTHING")
MOUSE = SimpleNamespace(type="MOUSEMOVE", value="NOTHING")
ESC = SimpleNamespace(type="ESC", value="PRESS")


GONE = "The mesh was changed or deleted meanwhile; start again."


def cube_at(x):
    # Each of another shape: lines of sight of the latest are kept.
    bpy.ops.mesh.primitive_cube_add(location=(x, 0, 0), scale=(1, 1, 1 + x))
    return bpy.context.active_object


def select(*objects):
    for obj in objects:
        obj.select_set(True)


class Window:
    """Keeps what computations add to a window and its manager."""

    def __init__(self):
        self.timers, self.handlers, self.status = [], [], None
        self.windows = []

    def event_timer_add(self, pause, window):
        assert window is self
        self.timers.append(pause)
        return pause

    def event_timer_remove(self, timer):
        self.timers.remove(timer)

    def modal_handler_add(self, operator):
        self.handlers.append(operator)

    def status_text_set(self, text):
        self.status = text

    def is_clean(self):
        return not self.timers and self.status is None and modal.current is None


@pytest.fixture
def window(monkeypatch):
    window = Window()
    context = SimpleNamespace(
        window_manager=window, temp_override=lambda workspace: nullcontext()
    )
    data = SimpleNamespace(workspaces={"Layout": window})
    monkeypatch.setattr(modal, "bpy", SimpleNamespace(context=context, data=data))
    # One step at each event, however fast the machine is.
    monkeypatch.setattr(modal, "_SLICE", 0.0)
    yield window
    modal.stop()


def call_of(cls):
    return getattr(bpy.ops.wcd, cls.bl_idname.removeprefix("wcd."))


def values_of(cls):
    """Return the values of all properties of an operator."""
    rna = call_of(cls).get_rna_type().properties
    values = {name: rna[name].default for name in set(rna.keys()) - {"rna_type"}}
    return values | {name: FAST[name] for name in FAST.keys() & values.keys()}


class Pressed:
    """Stands for an instance of a registered operator, which Blender alone can make.

    All that is not a property is the operator's own, bound to this: its methods and
    those of the classes above it.
    """

    def __init__(self, cls):
        vars(self).update(values_of(cls), _cls=cls, reports=[])

    @property
    def __class__(self):  # for `super()` in the operator's methods
        return self._cls

    def __getattr__(self, name):
        found = inspect.getattr_static(self._cls, name)
        return found.__get__(self, self._cls) if hasattr(found, "__get__") else found

    def report(self, kind, text):
        self.reports.append((*kind, text))


def press(cls, window):
    """Return an operator that runs modally on the active object."""
    context = SimpleNamespace(
        active_object=bpy.context.active_object,
        selected_objects=bpy.context.selected_objects,
        objects_in_mode=bpy.context.objects_in_mode,
        scene=bpy.context.scene,
        window=window,
        window_manager=window,
        workspace=SimpleNamespace(name="Layout"),
    )
    pressed = Pressed(cls)
    assert cls.poll(context)
    assert pressed.invoke(context, MOUSE) == {"RUNNING_MODAL"}
    return pressed


def finish(pressed):
    """Send events of the timer until the operator ends; return how it does."""
    while (answer := pressed.modal(None, TIMER)) == {"PASS_THROUGH"}:
        pass
    return answer


def errors_of(pressed):
    return [text for kind, text in pressed.reports if kind == "ERROR"]


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
    assert errors_of(pressed) == []


def test_a_slice_of_time_has_as_many_steps_as_fit(window, monkeypatch):
    cube_at(0)
    pressed = press(WCD_OT_decompose, window)
    assert pressed.modal(None, TIMER) == {"PASS_THROUGH"}
    monkeypatch.setattr(modal, "_SLICE", 1e9)
    assert pressed.modal(None, TIMER) == {"FINISHED"}


def test_progress_is_told_and_other_events_pass(suzanne, window, monkeypatch):
    monkeypatch.setattr(modal, "_LOOK", 0.0)
    pressed = press(WCD_OT_decompose, window)
    shares = []
    while pressed.modal(None, MOUSE) == pressed.modal(None, TIMER) == {"PASS_THROUGH"}:
        progress = modal.current.job.progress
        shares.append(progress.fraction)
        assert f"{progress.stage}, {progress.fraction:.0%}" in window.status
    assert shares == sorted(shares)
    assert len(shares) > 5


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


def test_the_cancel_button_stops(suzanne, window):
    assert not bpy.ops.wcd.cancel.poll()
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


def delete():
    bpy.ops.object.delete()


def subdivide():
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide()
    bpy.context.active_object.update_from_editmode()


def load_another_mesh():
    bpy.context.active_object.data = bpy.data.meshes.new("Other")


def edit_another_object():
    bpy.ops.mesh.primitive_cube_add()
    bpy.ops.object.mode_set(mode="EDIT")


def sculpt():
    bpy.ops.object.mode_set(mode="SCULPT")


@pytest.mark.parametrize("cls", OPERATORS)
@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (delete, "changed or deleted meanwhile; start again"),
        (subdivide, "changed or deleted meanwhile; start again"),
        (load_another_mesh, "changed or deleted meanwhile; start again"),
        (edit_another_object, "while another object is edited. Start again"),
        (sculpt, "switch the mode. Start again"),
    ],
)
def test_what_changed_meanwhile_is_left_alone(suzanne, window, cls, change, sentence):
    pressed = press(cls, window)
    pressed.modal(None, TIMER)
    change()
    there = [(obj.name, snapshot(obj)) for obj in bpy.data.objects]
    assert finish(pressed) == {"CANCELLED"}
    (error,) = errors_of(pressed)
    assert sentence in error or "Object Mode only; switch the mode" in error
    assert [(obj.name, snapshot(obj)) for obj in bpy.data.objects] == there
    assert window.is_clean()


def test_a_curve_gets_its_mesh_at_the_end_and_esc_leaves_none(window):
    hand = hand_curve()
    before = [obj.name for obj in bpy.data.objects], len(bpy.data.meshes)
    pressed = press(WCD_OT_decompose, window)
    pressed.modal(None, TIMER)
    assert pressed.modal(None, ESC) == {"CANCELLED"}
    assert ([obj.name for obj in bpy.data.objects], len(bpy.data.meshes)) == before
    pressed = press(WCD_OT_decompose, window)
    assert finish(pressed) == {"FINISHED"}
    (carrier,) = hand.children
    assert carrier.name in bpy.context.scene.objects
    assert len(bpy.data.meshes) == before[1] + 1
    pressed = press(WCD_OT_decompose, window)
    assert bpy.ops.wcd.cancel() == {"FINISHED"}
    assert "CANCELLED" in pressed.modal(None, MOUSE)
    assert hand.children == (carrier,)


def test_undo_meanwhile_is_noticed(suzanne, window):
    bpy.ops.ed.undo_push(message="Suzanne")
    bpy.ops.mesh.primitive_cube_add()
    bpy.ops.ed.undo_push(message="Cube")
    pressed = press(WCD_OT_decompose, window)
    bpy.ops.ed.undo()
    assert finish(pressed) == {"CANCELLED"}
    assert "deleted meanwhile" in errors_of(pressed)[0]
    assert "wcd" not in bpy.context.active_object


def test_edit_mode_may_be_entered_meanwhile(suzanne, window):
    pressed = press(WCD_OT_decompose, window)
    bpy.ops.object.mode_set(mode="EDIT")
    assert finish(pressed) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert suzanne.data.attributes["wcd_part"]


def test_another_file_or_a_closed_window_ends_it(suzanne, window):
    pressed = press(WCD_OT_decompose, window)
    pressed.cancel(None)  # as Blender does
    assert window.is_clean()


def test_unregistering_ends_it(suzanne, window):
    press(WCD_OT_decompose, window)
    package.unregister()
    assert window.is_clean()
    package.register()


def test_bad_input_is_told_before_anything_is_started(window):
    bpy.ops.object.add(type="MESH")
    with pytest.raises(AssertionError, match="CANCELLED"):
        press(WCD_OT_decompose, window)
    assert window.is_clean()


def test_our_bugs_leave_nothing_behind(suzanne, window):
    def broken(context):
        yield from ()
        raise ZeroDivisionError

    pressed = press(WCD_OT_measure, window)
    modal.stop()
    context = SimpleNamespace(
        window=window,
        window_manager=window,
        workspace=SimpleNamespace(name="Layout"),
    )
    pressed._running = modal.start(context, "Broken", broken(context))
    with pytest.raises(ZeroDivisionError):
        pressed.modal(None, TIMER)
    assert window.is_clean()
