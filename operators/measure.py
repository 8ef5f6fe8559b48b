"""Measure how convex the active mesh is."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import TYPE_CHECKING, ClassVar

import bpy

from ..core.errors import DecompositionError
from ..core.progress import Steps, run
from ..ui.properties import MEASURE, annotations, draw, parameters_from
from .bridge.ray_caster import BvhRayCaster
from .bridge.read import read_shape, reading_notes
from .bridge.record import check_records, write_measurement
from .bridge.target import Target, refusal
from .cursor import with_cursor

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ..core.decomposition import Measurement


class WCD_OT_measure(bpy.types.Operator):
    """Measure the share of pairs of surface points that see each other."""

    bl_idname = "wcd.measure"
    bl_label = "Measure Convexity"
    bl_description = "Measure the share of pairs of surface points that see each other"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether the active object can be measured."""
        reason = refusal(context.active_object, writes_mesh=False)
        if reason:
            cls.poll_message_set(reason)
        return reason is None

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the settings."""
        draw(self.layout, self, MEASURE)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Measure while Blender waits."""
        try:
            steps = with_cursor(context.window_manager, self._begin(context))
            self._commit(run(steps))
        except DecompositionError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}

    def _begin(self, context: bpy.types.Context) -> Steps[Measurement]:
        """Check and read the active object; return the work to be done."""
        # Loads SciPy and scikit-learn: seconds that enabling the add-on must not take.
        from ..core.decomposition import measure

        obj = context.active_object
        self._parameters = parameters_from(self, MEASURE)
        check_records(obj)
        shape = read_shape(obj)
        self._notes = reading_notes(obj)
        self._target = Target.of(obj)
        return measure(shape, self._parameters, BvhRayCaster)

    def _commit(self, measurement: Measurement) -> None:
        """Note the result on the object and report it."""
        values = asdict(self._parameters)
        used = {name: values[name] for name in MEASURE}
        notes = (*self._notes, *measurement.notes)
        measurement = replace(measurement, notes=notes)
        write_measurement(self._target.find(), measurement, used)
        for note in notes:
            self.report({"WARNING"}, note)
        error = measurement.standard_error
        self.report(
            {"INFO"},
            f"Convexity rank {measurement.rank:.3f}"
            + (f" ± {error:.3f}" if error else "")
            + f" ({measurement.n_samples:,} samples)",
        )


WCD_OT_measure.__annotations__ = annotations(MEASURE)
