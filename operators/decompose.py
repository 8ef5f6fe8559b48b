"""Decompose the active mesh into convex parts."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar

import bpy

from ..core.errors import DecompositionError
from ..core.progress import Steps, run
from ..ui.properties import ADVANCED, FRONT, annotations, draw, parameters_from
from .bridge.ray_caster import BvhRayCaster
from .bridge.read import read_shape, reading_notes
from .bridge.target import Target, refusal
from .bridge.write import check_writable, write_parts
from .cursor import with_cursor

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ..core.decomposition import Decomposition


class WCD_OT_decompose(bpy.types.Operator):
    """Split the active mesh into weakly convex parts, and show them on it."""

    bl_idname = "wcd.decompose"
    bl_label = "Decompose into Convex Parts"
    bl_description = (
        "Split the active mesh into weakly convex parts, and show them on it"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO", "PRESET"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether the active object can be decomposed."""
        reason = refusal(context.active_object)
        if reason:
            cls.poll_message_set(reason)
        return reason is None

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the settings, those of the sidebar's front first."""
        draw(self.layout, self, FRONT)
        self.layout.separator()
        draw(self.layout, self, ADVANCED)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Decompose while Blender waits."""
        try:
            steps = with_cursor(context.window_manager, self._begin(context))
            self._commit(run(steps))
        except DecompositionError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}

    def _begin(self, context: bpy.types.Context) -> Steps[Decomposition]:
        """Check and read the active object; return the work to be done."""
        # Loads SciPy and scikit-learn: seconds that enabling the add-on must not take.
        from ..core.decomposition import decompose

        obj = context.active_object
        self._parameters = parameters_from(self)
        check_writable(obj)
        shape = read_shape(obj)
        self._notes = reading_notes(obj)
        self._target = Target.of(obj)
        self._started = time.perf_counter()
        return decompose(shape, self._parameters, BvhRayCaster)

    def _commit(self, decomposition: Decomposition) -> None:
        """Write the result to the object and report it."""
        notes = (*self._notes, *decomposition.notes)
        decomposition = replace(decomposition, notes=notes)
        write_parts(self._target.find(), decomposition, self._parameters)
        for note in notes:
            self.report({"WARNING"}, note)
        n_parts = decomposition.n_parts
        self.report(
            {"INFO"},
            f"{n_parts} {'part' if n_parts == 1 else 'parts'},"
            f" psi {decomposition.psi_before:.3f} → {decomposition.psi:.3f},"
            f" mean convexity rank {decomposition.ranks.mean():.3f},"
            f" {time.perf_counter() - self._started:.1f} s",
        )


WCD_OT_decompose.__annotations__ = annotations()
