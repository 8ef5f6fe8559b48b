"""Measure how convex the active mesh is."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, ClassVar

import bpy

from ..core.progress import Steps
from ..ui.properties import MEASURE, annotations, draw, parameters_from
from .bridge.computing import measure_object
from .bridge.record import write_measurement
from .bridge.target import refusal
from .computation import Computation

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ..core.decomposition import Measurement


class WCD_OT_measure(Computation, bpy.types.Operator):
    """Measure the share of pairs of surface points that see each other."""

    bl_idname = "wcd.measure"
    bl_label = "Measure Convexity"
    bl_description = "Measure the share of pairs of surface points that see each other"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @staticmethod
    def _refusal(obj: bpy.types.Object | None) -> str | None:
        return refusal(obj, writes_mesh=False)

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the settings."""
        draw(self.layout, self, MEASURE)

    def _begin(
        self, context: bpy.types.Context, obj: bpy.types.Object
    ) -> Steps[Measurement]:
        self._parameters = parameters_from(self, MEASURE)
        return measure_object(obj, self._parameters)

    def _commit(self, obj: bpy.types.Object, value: Measurement) -> str:
        values = asdict(self._parameters)
        used = {name: values[name] for name in MEASURE}
        write_measurement(obj, value, used)
        error = value.standard_error
        return (
            f"Convexity rank {value.rank:.3f}"
            + (f" ± {error:.3f}" if error else "")
            + f" ({value.n_samples:,} samples)"
        )


WCD_OT_measure.__annotations__ = annotations(MEASURE)
