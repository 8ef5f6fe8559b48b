"""Decompose the active mesh into convex parts."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import bpy

from ..core.steps.progress import Steps
from .bridge.read.converting import carrier_of
from .bridge.read.target import decompose_refusal
from .bridge.work.computing import summary
from .bridge.work.locking import decompose_unlocked
from .running.computation import Computation
from .settings import ADVANCED, FRONT, annotations, draw, parameters_from

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from .bridge.work.editing import Edited


class WCD_OT_decompose(Computation, bpy.types.Operator):
    """Split the active mesh into weakly convex parts, and show them on it."""

    bl_idname = "wcd.decompose"
    bl_label = "Decompose into Convex Parts"
    bl_description = (
        "Split the selected meshes into weakly convex parts, and show them on them"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO", "PRESET"}

    @staticmethod
    def _refusal(obj: bpy.types.Object | None) -> str | None:
        return decompose_refusal(obj)

    @classmethod
    def _chosen(cls, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Return the objects to work on, one of those that share a mesh."""
        firsts: dict[bpy.types.ID | None, bpy.types.Object] = {}
        for obj in super()._chosen(context):
            firsts.setdefault(obj and obj.data, obj)
        return list(firsts.values())

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the settings, those of the sidebar's front first."""
        draw(self.layout, self, FRONT)
        self.layout.separator()
        draw(self.layout, self, ADVANCED)

    def _begin(
        self, context: bpy.types.Context, obj: bpy.types.Object
    ) -> Steps[Edited]:
        return decompose_unlocked(obj, parameters_from(self))

    def _commit(self, obj: bpy.types.Object, value: Edited) -> str:
        value.write(carrier_of(obj))
        return summary(value.decomposition)


WCD_OT_decompose.__annotations__ = annotations()
