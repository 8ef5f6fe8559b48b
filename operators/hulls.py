"""Put convex hulls, or simpler shapes, around the active mesh."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import bpy

from ..core.steps.progress import Steps
from .bridge.hulls.hull_objects import hull_refusal, write_hulls
from .bridge.work.computing import build_hulls_of, hull_summary
from .running.computation import Computation
from .settings import HULLS, annotations, draw, hull_parameters_from, parameters_from

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ..core.hulls.build import HullDecomposition


class WCD_OT_build_hulls(Computation, bpy.types.Operator):
    """Put collision hulls around the active mesh, or around its parts."""

    bl_idname = "wcd.build_hulls"
    bl_label = "Build Collision Hulls"
    bl_description = (
        "Put collision hulls around the active mesh, as few as its error allows, or"
        " one for each part; it is decomposed for that if it has no parts"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO", "PRESET"}

    @staticmethod
    def _refusal(obj: bpy.types.Object | None) -> str | None:
        return hull_refusal(obj)

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the settings."""
        draw(self.layout, self, HULLS)

    def _begin(
        self, context: bpy.types.Context, obj: bpy.types.Object
    ) -> Steps[HullDecomposition]:
        self._parameters = hull_parameters_from(self)
        parameters = parameters_from(context.scene.wcd)
        return build_hulls_of(obj, parameters, self._parameters)

    def _commit(self, obj: bpy.types.Object, value: HullDecomposition) -> str:
        write_hulls(obj, value, self._parameters)
        return hull_summary(value)


WCD_OT_build_hulls.__annotations__ = annotations(HULLS)
