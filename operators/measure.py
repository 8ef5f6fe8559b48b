"""Measure how convex the selected meshes, or faces, are; tell the quality of parts."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from ..core.errors import DecompositionError
from ..core.results.parts import Measurement
from ..core.steps.progress import Steps
from .bridge.mesh.layers import let_undo_see_all
from .bridge.mesh.selection import selected_faces
from .bridge.refusals import measure_refusal, selection_refusal
from .bridge.stored.record import record_if_ours, write_measurement
from .bridge.work.computing import measure_object
from .running.computation import Computation
from .running.modal import is_free
from .settings import MEASURE, SELECTION, draw, parameters_from, properties_for


class _Measure(Computation):
    """Half an operator that measures objects, or the selected faces of each."""

    _of_selection = False
    _needs_shape = True

    def _read(
        self, context: bpy.types.Context
    ) -> list[Steps[Any] | DecompositionError]:
        # For the end, when the selection may differ.
        self._n_faces: dict[int, int] = {}
        return super()._read(context)

    def _begin(self, obj: bpy.types.Object) -> Steps[Measurement]:
        self._parameters = parameters_from(self, self._settings)
        steps = measure_object(obj, self._parameters, self._of_selection)
        if self._of_selection:
            self._n_faces[obj.session_uid] = int(selected_faces(obj).sum())
        return steps

    def _commit(self, obj: bpy.types.Object, value: Measurement) -> str:
        used = {name: getattr(self._parameters, name) for name in self._settings}
        n_faces = self._n_faces.get(obj.session_uid)
        write_measurement(obj, value, used, n_faces)
        let_undo_see_all(obj)
        return _figures(value) + (f" of {n_faces:,} faces" if n_faces else "")


class WCD_OT_measure(_Measure, bpy.types.Operator):
    """Measure which share of the pairs of surface points see each other."""

    bl_idname = "wcd.measure"
    bl_label = "Measure Convexity"
    bl_description = "Measure the share of pairs of surface points that see each other"
    _settings = MEASURE
    _refusal = staticmethod(measure_refusal)

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the settings."""
        draw(self.layout, self, MEASURE)


WCD_OT_measure.__annotations__ = properties_for(MEASURE)


class WCD_OT_measure_selection(_Measure, bpy.types.Operator):
    """Measure the same for points on the selected faces."""

    bl_idname = "wcd.measure_selection"
    bl_label = "Measure Convexity of Selection"
    bl_description = (
        "Measure the share of pairs of points on the selected faces that see each"
        " other, as if the faces were a part"
    )
    _settings = SELECTION
    _of_selection = True
    _refusal = staticmethod(selection_refusal)


WCD_OT_measure_selection.__annotations__ = properties_for(SELECTION)


class WCD_OT_tell_quality(bpy.types.Operator):
    """Tell the psi that the word for the quality of the parts stands for."""

    bl_idname = "wcd.tell_quality"
    bl_label = "Tell Quality of Convex Parts"
    bl_options: ClassVar[set[str]] = {"INTERNAL"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether the active object has parts that were found."""
        found = record_if_ours(context.active_object).get("psi") is not None
        return is_free(cls, None if found else "There are no parts; press Decompose")

    @classmethod
    def description(
        cls, context: bpy.types.Context, properties: bpy.types.OperatorProperties
    ) -> str:
        """Return the tooltip of the word."""
        noted = record_if_ours(context.active_object)
        return (
            f"ψ = {noted['psi']:.3f}, and {noted['psi_before']:.3f} as one part. It"
            " rises when points of one part see each other, and when points of"
            " different parts do not. The word says how near it is to the largest ψ"
            " that the shape allows"
        )

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Say in the status bar what the tooltip says."""
        self.report({"INFO"}, self.description(context, self.properties))
        return {"FINISHED"}


def _figures(value: Measurement) -> str:
    """Return the figures of a measurement in a line."""
    error = value.standard_error
    return (
        f"Convexity rank {value.rank:.3f}"
        + (f" ± {error:.3f}" if error else "")
        + f" ({value.n_samples:,} samples)"
    )


CLASSES = (WCD_OT_measure, WCD_OT_measure_selection, WCD_OT_tell_quality)
