"""What operators share that compute: they run, report and take errors."""

from __future__ import annotations

import time
from typing import Any

import bpy

from ..core.errors import DecompositionError
from ..core.progress import Steps, run
from ..ui import running
from . import modal
from .bridge.target import Target
from .cursor import with_cursor


class Computation:
    """Half an operator that computes.

    The other half has `_refusal(obj)`, which returns why an object cannot be worked on;
    `_begin(context)`, which checks and reads the active object and returns the `Steps`
    to be done; and `_commit(obj, value)`, which writes what they return to the object
    and reports it.
    Buttons invoke it; scripts and Adjust Last Operation execute it.
    """

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether the active object can be worked on, and nothing else is."""
        reason = modal.busy() or cls._refusal(context.active_object)
        if reason:
            cls.poll_message_set(reason)
        return reason is None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Compute while Blender waits."""
        try:
            steps = with_cursor(context.window_manager, self._read(context))
            value = run(steps)
            self._commit(self._target.find(), value)
        except DecompositionError as error:
            return self._refuse(error)
        return {"FINISHED"}

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Begin to compute while the window stays alive."""
        try:
            steps = self._read(context)
        except DecompositionError as error:
            return self._refuse(error)
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
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            if not modal.advance(self._running):
                return {"PASS_THROUGH"}
            self._commit(self._changeable(), self._running.job.result())
        except DecompositionError as error:
            return self._refuse(error)
        return {"FINISHED"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Stop: Blender closes the window or loads another file."""
        modal.stop()

    def _read(self, context: bpy.types.Context) -> Steps[Any]:
        """Check and read the active object; return the work to be done."""
        self._target = Target.of(context.active_object)
        self._started = time.perf_counter()
        return self._begin(context)

    def _changeable(self) -> bpy.types.Object:
        """Return the object that was read, or raise if it must not be written to now.

        Modes may have changed since, and undo in a mode knows the objects in it alone.
        """
        obj = self._target.find()
        reason = self._refusal(obj)
        if reason is None and obj.mode == "OBJECT" != bpy.context.mode:
            reason = f"{obj.name} cannot be written to while another object is edited"
        if reason:
            raise DecompositionError(f"{reason}. Start again.")
        return obj

    def _refuse(self, error: DecompositionError) -> set[str]:
        self.report({"ERROR"}, str(error))
        return {"CANCELLED"}

    def _warn(self, notes: tuple[str, ...]) -> None:
        """Report what is worth knowing."""
        for note in notes:
            self.report({"WARNING"}, note)
