"""Decompose the active mesh into convex parts."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, ClassVar

import bpy

from ..core.progress import Steps
from ..ui.properties import ADVANCED, FRONT, annotations, draw, parameters_from
from .bridge.computing import decompose_object, summary
from .bridge.converting import carrier_of
from .bridge.target import decompose_refusal
from .bridge.write import write_parts
from .computation import Computation

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ..core.decomposition import Decomposition


class WCD_OT_decompose(Computation, bpy.types.Operator):
    """Split the active mesh into weakly convex parts, and show them on it."""

    bl_idname = "wcd.decompose"
    bl_label = "Decompose into Convex Parts"
    bl_description = (
        "Split the active mesh into weakly convex parts, and show them on it"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO", "PRESET"}

    @staticmethod
    def _refusal(obj: bpy.types.Object | None) -> str | None:
        return decompose_refusal(obj)

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the settings, those of the sidebar's front first."""
        draw(self.layout, self, FRONT)
        self.layout.separator()
        draw(self.layout, self, ADVANCED)

    def _begin(self, context: bpy.types.Context) -> Steps[Decomposition]:
        self._parameters = parameters_from(self)
        return decompose_object(context.active_object, self._parameters)

    def _commit(self, obj: bpy.types.Object, value: Decomposition) -> None:
        write_parts(carrier_of(obj), value, self._parameters)
        self._warn(value.notes)
        seconds = time.perf_counter() - self._started
        self.report({"INFO"}, f"{summary(value)}, {seconds:.1f} s")


WCD_OT_decompose.__annotations__ = annotations()
