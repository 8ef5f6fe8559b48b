"""What operators share that compute: they run, report and take errors."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

import bpy

from ...core.errors import DecompositionError
from ...core.steps.progress import Steps, in_turn, run
from ..bridge.read.target import Target
from . import current as running
from . import modal
from .cursor import with_cursor
from .on_objects import OnObjects


class Computation(OnObjects):
    """Half an operator that computes.

    The other half has `_refusal(obj)`; `_begin(context, obj)`, which checks and reads
    an object and returns the `Steps` to be done; and `_commit(obj, value)`, which
    writes what they return to the object and returns the figures in a line.
    Buttons invoke it; scripts and Adjust Last Operation execute it. All is written at
    the end; where there are several objects, those that fail are told of and left out.
    """

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Compute while Blender waits."""
        steps = in_turn(self._read(context), self._names)
        return self._write(run(with_cursor(context.window_manager, steps)), Target.find)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Begin to compute while the window stays alive."""
        works = self._read(context)
        if all(isinstance(work, DecompositionError) for work in works):
            return self._write(works, Target.find)
        steps = in_turn(works, self._names)
        self._running = modal.start(context, self.bl_label, steps)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Compute a little more at each event of the timer; Esc cancels."""
        if running.current is not self._running:  # the button Cancel was pressed
            return {"CANCELLED", "PASS_THROUGH"}
        if event.type == "ESC" and event.value == "PRESS":
            modal.stop()
            return {"CANCELLED"}
        if event.type != "TIMER" or not modal.advance(self._running):
            return {"PASS_THROUGH"}
        return self._write(self._running.job.result(), self._changeable)

    def cancel(self, context: bpy.types.Context) -> None:
        """Stop: Blender closes the window or loads another file."""
        modal.stop()

    @classmethod
    def _obstacle(cls, context: bpy.types.Context) -> str | None:
        """Return what else is running, or why nothing can be done."""
        return modal.busy() or super()._obstacle(context)

    def _read(
        self, context: bpy.types.Context
    ) -> list[Steps[Any] | DecompositionError]:
        """Check and read the objects; return the work to be done on each."""
        self._started = time.perf_counter()
        self._names, self._targets = [], []
        return [self._begun(context, obj) for obj in self._chosen(context)]

    def _begun(
        self, context: bpy.types.Context, obj: bpy.types.Object
    ) -> Steps[Any] | DecompositionError:
        self._names.append(obj.name)
        self._targets.append(None)
        try:
            self._targets[-1] = Target.of(obj)
            return self._begin(context, obj)
        except DecompositionError as error:
            return error

    def _write(
        self, outcomes: Sequence[Any], find: Callable[[Target], bpy.types.Object]
    ) -> set[str]:
        """Write what was computed to the objects, and report it and what failed."""
        failures = []
        for target, name, outcome in zip(
            self._targets, self._names, outcomes, strict=True
        ):
            self._title = f"{name}: " if outcomes[1:] else ""
            try:
                if isinstance(outcome, DecompositionError):
                    raise outcome
                figures = self._commit(find(target), outcome)
            except DecompositionError as error:
                failures.append(f"{self._title}{error}")
                continue
            self._warn(outcome.notes)
            seconds = time.perf_counter() - self._started
            self.report({"INFO"}, f"{self._title}{figures}, {seconds:.1f} s")
        return self._conclude(failures, len(outcomes))

    def _changeable(self, target: Target) -> bpy.types.Object:
        """Return the object that was read, or raise if it must not be written to now.

        Modes may have changed since, and undo in a mode knows the objects in it alone.
        """
        obj = target.find()
        reason = self._refusal(obj)
        if reason is None and obj.mode == "OBJECT" != bpy.context.mode:
            reason = f"{obj.name} cannot be written to while another object is edited"
        if reason:
            raise DecompositionError(f"{reason}. Start again.")
        return obj

    def _warn(self, notes: Sequence[str]) -> None:
        """Report what is worth knowing."""
        for note in notes:
            self.report({"WARNING"}, f"{self._title}{note}")
