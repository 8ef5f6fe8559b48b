"""What operators that compute share: they read, run, write and report."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

import bpy

from ...core.errors import DecompositionError
from ...core.steps.progress import Progress, Steps, T, in_turn, mapped, run
from ..bridge.read.carrier import discard_waiting
from ..bridge.read.target import Target
from ..bridge.work.computing import summary
from ..bridge.work.run_edit import Edited
from ..settings import take_over
from . import modal
from .on_objects import OnActive, OnObjects

_ENDS = {"FINISHED", "CANCELLED"}


class Computation(OnObjects):
    """Half an operator that computes.

    The other half has three methods. `_refusal(obj)` returns why an object cannot be
    worked on. `_begin(obj)` checks and reads an object, and returns the `Steps` to be
    done. `_commit(obj, value)` writes the value of the steps to the object, and returns
    the figures in a line.

    Buttons, menus and shortcuts invoke the operator; it takes the settings of the scene
    then, but for those that a shortcut sets. Scripts and Adjust Last Operation execute
    it. All results are written at the end. If an object fails, it is reported and left
    out.
    """

    # Whether `invoke` reports at once that nothing can be done: what a timer invokes
    # has no window to report to until it runs.
    _reports_at_once = True
    # Whether what is found fits no other shape, as hulls do; parts still do if vertices
    # have moved.
    _needs_shape = False
    # The names of the settings that it takes from the scene.
    _settings: tuple[str, ...] = ()
    # Whether it runs in a window, which stays alive.
    _in_window = False

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Compute while Blender waits."""
        try:
            steps = in_turn(self._read(context), self._names)
            outcomes = run(with_cursor(context.window_manager, steps))
            return self._write(outcomes)
        finally:
            discard_waiting()

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Begin to compute while the window stays alive."""
        self._in_window = True
        take_over(context.scene.wcd, self, self._settings)
        works = self._read(context)
        errors = [work for work in works if isinstance(work, DecompositionError)]
        if self._reports_at_once and len(errors) == len(works):
            discard_waiting()
            return self._write(errors)
        steps = in_turn(works, self._names)
        self._running = modal.start(context, self.bl_label, steps)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Compute a little more at each event of the timer; Esc cancels."""
        answer = self._go_on(event)
        if answer & _ENDS:
            discard_waiting()
        return answer

    def cancel(self, context: bpy.types.Context) -> None:
        """Stop: Blender closes the window or loads another file."""
        modal.stop()

    def _go_on(self, event: bpy.types.Event) -> set[str]:
        """Take an event; write the results once all is computed."""
        if modal.current is not self._running:  # the button Cancel was pressed
            return {"CANCELLED", "PASS_THROUGH"}
        if event.type == "ESC" and event.value == "PRESS":
            modal.stop()
            return {"CANCELLED"}
        if event.type != "TIMER" or not modal.advance(self._running):
            return {"PASS_THROUGH"}
        return self._write(self._running.job.result(), late=True)

    def _read(
        self, context: bpy.types.Context
    ) -> list[Steps[Any] | DecompositionError]:
        """Check and read the objects; return the work to be done on each."""
        self._started = time.perf_counter()
        self._names: list[str] = []
        self._targets: list[Any] = []  # of `Target`, None where that fails
        return [self._begun(obj) for obj in self._chosen(context)]

    def _begun(self, obj: bpy.types.Object) -> Steps[Any] | DecompositionError:
        """Return the work to be done on an object, or why there is none."""
        self._names.append(obj.name)
        self._targets.append(None)
        try:
            self._targets[-1] = Target.of(obj, self._needs_shape)
            steps: Steps[Any] = self._begin(obj)
        except DecompositionError as error:
            return error
        return steps

    def _write(self, outcomes: Sequence[Any], late: bool = False) -> set[str]:
        """Write the results; report them and the failures.

        If it is `late`, the user has gone on, and objects may not be as they were.
        """
        failures = []
        for target, name, outcome in zip(
            self._targets, self._names, outcomes, strict=True
        ):
            title = f"{name}: " if outcomes[1:] else ""
            try:
                if isinstance(outcome, DecompositionError):
                    raise outcome
                obj = self._changeable(target) if late else target.find()
                figures = self._commit(obj, outcome)
            except DecompositionError as error:
                failures.append((name, str(error)))
                continue
            for note in outcome.notes:
                self.report({"WARNING"}, f"{title}{note}")
            seconds = time.perf_counter() - self._started
            self.report({"INFO"}, f"{title}{figures}, {seconds:.1f} s")
        return self._conclude(failures, len(outcomes), late)

    def _changeable(self, target: Target) -> bpy.types.Object:
        """Return the object that was read, or raise if it must not be written to now.

        The mode may have changed since, and undo in Edit Mode takes back only changes
        of the objects in it.
        """
        obj = target.find()
        reason = self._refusal(obj)
        if reason is None and obj.mode == "OBJECT" != bpy.context.mode:
            reason = f"{obj.name} cannot be written to while another object is edited"
        if reason:
            raise DecompositionError(f"{reason}. Start again.")
        return obj


class Replacement(OnActive, Computation):
    """Half an operator that replaces the parts of the active object.

    Its `_begin` returns the work of an `Edited`. It takes one object, because the table
    shows the parts of one, and because the lines of sight of one are kept.
    """

    def _commit(self, obj: bpy.types.Object, value: Edited) -> str:
        value.write(obj)
        return summary(value.decomposition)


def with_cursor(window_manager: bpy.types.WindowManager, steps: Steps[T]) -> Steps[T]:
    """Run `steps`; show their progress at the mouse cursor, if there is a window."""
    if bpy.app.background:
        return (yield from steps)

    def show(progress: Progress) -> Progress:
        window_manager.progress_update(round(progress.fraction * 100))
        return progress

    window_manager.progress_begin(0, 100)
    try:
        return (yield from mapped(steps, show))
    finally:
        window_manager.progress_end()
