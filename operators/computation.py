"""What operators share that compute: they run, report and take errors."""

from __future__ import annotations

import bpy

from ..core.errors import DecompositionError
from ..core.progress import run
from .cursor import with_cursor


class Computation:
    """Half an operator that computes.

    The other half has `_begin(context)`, which checks and reads the active object and
    returns the `Steps` to be done, and `_commit(value)`, which writes and reports what
    they return.
    """

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Compute while Blender waits."""
        try:
            steps = with_cursor(context.window_manager, self._begin(context))
            self._commit(run(steps))
        except DecompositionError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}

    def _warn(self, notes: tuple[str, ...]) -> None:
        """Report what is worth knowing."""
        for note in notes:
            self.report({"WARNING"}, note)
