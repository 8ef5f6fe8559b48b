"""Replace the parts of the active object, as settings change or by the chart."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import Any, ClassVar

import bpy

from ..core.errors import DecompositionError
from ..core.parameters.parts import Parameters
from ..core.steps.job import Job
from ..core.steps.progress import Steps, run
from .bridge.read.evaluated import SeenMesh, read_as, which_mesh
from .bridge.read.target import Target
from .bridge.refusals import recut_refusal
from .bridge.stored.noted_parts import n_faces_of
from .bridge.stored.record import noted_mesh, noted_parameters, record_of
from .bridge.watching import start_timer, stop_timer
from .bridge.work.locking import decompose_unlocked
from .bridge.work.run_edit import Edited
from .running import ahead, modal, refine
from .running.computation import Replacement
from .running.modal import is_free
from .running.on_objects import active_object
from .settings import parameters_from, properties_for

# Seconds that a slider waits for parts, most and least; after that a modal run finds
# them. With writing them it may be somewhat more, as steps end up to 0.01 s late. To
# write takes time for each face, and for each face again by the number of parts.
_MOMENT = (0.08, 0.03)
_WITH_WRITING = 0.088
_WRITING = (1.45e-7, 0.35e-8)
# Seconds until the next try to start a modal run.
_RETRY = 0.02

# Parts that a slider did not wait for: what is wanted of which object, and the work.
_half_found: tuple[Any, Job[Edited]] | None = None
# The address of that slider's window, which may be closed before the run starts; 0 for
# no window, as where a script sets the slider.
_window = 0


class _Recut(Replacement):
    """Half an operator that replaces parts by those of the settings in the sidebar.

    In a window, parts that take long are a first look, which `refine` replaces.
    """

    _needs_seams = _rough = False

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Begin to find the parts while the window stays alive."""
        self._rough = active_object(context).mode == "OBJECT"
        return super().invoke(context, event)

    _refusal = staticmethod(recut_refusal)

    def _wanted(self, context: bpy.types.Context) -> Parameters:
        """Return the parameters of the new parts."""
        return parameters_from(context.scene.wcd)

    def _begin(self, obj: bpy.types.Object) -> Steps[Edited]:
        context = bpy.context
        rest = _taken(self._key(context, obj))
        if rest is not None:
            return rest
        seen, keep_edits = _seen(context, obj), context.scene.wcd.keep_edits
        wanted = self._wanted(context)
        steps = decompose_unlocked(obj, wanted, keep_edits, seen, self._rough)
        return ahead.after_rest((wanted, self._rough), steps)

    def _key(self, context: bpy.types.Context, obj: bpy.types.Object) -> Any:
        """Return what the parts depend on, but for changes of the mesh itself."""
        settings = context.scene.wcd
        return Target.of(obj), self._wanted(context), settings.mesh, settings.keep_edits

    def _commit(self, obj: bpy.types.Object, value: Edited) -> str:
        said = super()._commit(obj, value)
        ahead.start(value)
        if value.decomposition.rough:
            refine.start()
        return said


def _taken(key: Any) -> Steps[Edited] | None:
    """Return the rest of the work on what is half found; None if it has another key.

    Nothing is half found any more then.
    """
    global _half_found
    half, _half_found = _half_found, None
    return half[1].rest() if half is not None and half[0] == key else None


def _seen(context: bpy.types.Context, obj: bpy.types.Object) -> SeenMesh | None:
    """Return the mesh as it is seen, if that is read; raise if it has other faces."""
    seen = read_as(context.scene.wcd.mesh, obj)
    if seen is not None and not seen.corresponds:
        raise DecompositionError(
            f"The faces seen of {obj.name} do not come from those of its mesh; press"
            " Decompose to have parts on a new object."
        )
    return seen


class WCD_OT_recut(_Recut, bpy.types.Operator):
    """Replace the parts by those of the sidebar's settings."""

    bl_idname = "wcd.recut"
    bl_label = "Re-cut Convex Parts"
    bl_description = "Replace the parts by those of the settings in the sidebar"
    bl_options: ClassVar[set[str]] = {"UNDO", "INTERNAL"}

    _reports_at_once = False

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether the active object has parts, also while something runs."""
        return is_free(cls, cls._refusal(active_object(context)))

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Replace the parts at once if that is quick, else start a modal run.

        If it is done at once, the parts belong to the undo step of the setting. Without
        a window it is always done at once.
        """
        try:
            if modal.busy() is None and self._cut(context):
                return {"FINISHED"}
        except DecompositionError:
            pass  # the modal run fails, too, and reports it
        if not bpy.app.background:
            global _window
            _window = context.window.as_pointer() if context.window else 0
            start_timer(_invoke)
        return {"CANCELLED"}

    def _cut(self, context: bpy.types.Context) -> bool:
        """Replace the parts if they differ; return False if that takes too long."""
        global _half_found
        obj, parameters = active_object(context), self._wanted(context)
        _half_found = None  # settings have changed since
        mesh = which_mesh(context.scene.wcd.mesh, obj)
        if (noted_parameters(obj), noted_mesh(obj)) == (parameters, mesh):
            return True
        if bpy.app.background:
            self._commit(obj, run(self._begin(obj)))
            return True
        began = time.perf_counter()
        self._rough = obj.mode == "OBJECT"
        key, job = self._key(context, obj), Job(self._begin(obj))
        if job.advance(began + _moment(obj, parameters) - time.perf_counter()):
            self._commit(obj, job.result())
        else:
            _half_found = key, job
        return job.done


def _moment(obj: bpy.types.Object, wanted: Parameters) -> float:
    """Return for how many seconds a slider waits for the parts of an object."""
    record, (each_face, each_part) = record_of(obj), _WRITING
    n_parts = max(len(record.get("parts", ())), wanted.parts)
    writing = n_faces_of(record) * (each_face + each_part * n_parts)
    return max(min(_WITH_WRITING - writing, _MOMENT[0]), _MOMENT[1])


def _invoke() -> float | None:
    """Start a modal run as soon as nothing else runs; return when to try again."""
    global _half_found
    if modal.busy():
        _half_found = None  # the object may be another one after what runs
        return _RETRY
    windows = list(bpy.context.window_manager.windows)
    asked = [each for each in windows if each.as_pointer() == _window]
    for window in asked if _window else windows[:1]:  # none if it was closed
        with bpy.context.temp_override(window=window):
            if bpy.ops.wcd.recut.poll():
                bpy.ops.wcd.recut("INVOKE_DEFAULT")
    return None


def stop(*_: object) -> None:
    """Forget a modal run that waits to be started. Blender passes arguments."""
    global _half_found
    _half_found = None
    stop_timer(_invoke)


HANDLERS = {"load_pre": stop}


class WCD_OT_choose_part_count(_Recut, bpy.types.Operator):
    """Replace the parts by a number of parts."""

    bl_idname = "wcd.choose_part_count"
    bl_label = "Choose Number of Parts"
    bl_description = (
        "Cut the object into this number of parts. The bar is their gain in psi as a"
        " share of the largest; the star marks the best number"
    )

    def _wanted(self, context: bpy.types.Context) -> Parameters:
        return replace(super()._wanted(context), parts=self.parts)

    def _begin(self, obj: bpy.types.Object) -> Steps[Edited]:
        self._scene = bpy.context.scene.name  # the user may look at another one soon
        return super()._begin(obj)

    def _commit(self, obj: bpy.types.Object, value: Edited) -> str:
        said = super()._commit(obj, value)
        scene = bpy.data.scenes.get(self._scene)
        if scene is not None:
            # Last: with Live on, this asks for parts that the object has by now.
            scene.wcd.parts = self.parts
        return said


WCD_OT_choose_part_count.__annotations__ = properties_for(("parts",))
