"""Show in the viewports what the points see that the user clicks on."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import bpy
import numpy as np
from mathutils import Vector

from ... import core
from ...core.errors import DecompositionError
from ...core.steps.progress import Steps
from ..bridge.mesh.points import vertices_now
from ..bridge.read.shape import stretch
from ..bridge.read.stretching import stretched
from ..bridge.read.target import Target
from ..bridge.refusals import measure_refusal
from ..bridge.watching import changed_objects
from ..bridge.work.computing import point_viewer_of
from ..running import modal
from ..running.computation import Computation
from ..running.modal import is_free
from ..running.on_objects import OnActive
from ..settings import SELECTION, parameters_from, properties_for
from . import sight_overlay
from .sight_overlay import Overlay
from .viewports import (
    CLICKED_MODES,
    navigates,
    ray_at,
    ray_within,
    shown_along,
    space_of,
    viewport_at,
)

_HINT = (
    "Click a point of the surface to see what it sees. Enter: keep, Esc or Right-Click:"
    " hide"
)


class WCD_OT_show_sight(OnActive, Computation, bpy.types.Operator):
    """Show which samples a point sees that the user clicks on."""

    bl_idname = "wcd.show_sight"
    bl_label = "Show Lines of Sight"
    bl_description = (
        "Click points of the active object to see what they see. Samples in line of"
        " sight are green, others are blue. Nothing is written to the object"
    )
    bl_options: ClassVar[set[str]] = set()

    _viewer: Any = None  # the `core.PointViewer`, once it is made

    _settings = SELECTION
    _refusal = staticmethod(measure_refusal)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Show what the middle of a face sees."""
        if self.face < 0:
            self.report(
                {"ERROR"},
                "Points are clicked on in a 3D viewport; scripts name a face instead,"
                " such as face=0.",
            )
            return {"CANCELLED"}
        return super().execute(context)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Make the object ready; then show what each clicked point sees."""
        if self._viewer is None:
            answer = super().modal(context, event)
            if answer != {"FINISHED"}:
                return answer
            modal.show_hint(self._overlay.workspace, _HINT)
            return {"RUNNING_MODAL"}
        if sight_overlay.current is not self._overlay:  # hidden, or replaced by another
            return {"FINISHED", "PASS_THROUGH"}
        if context.mode not in CLICKED_MODES:  # others take clicks; the picture stays
            modal.show_hint(self._overlay.workspace, None)
            return {"FINISHED", "PASS_THROUGH"}
        if event.value != "PRESS":
            return {"PASS_THROUGH"}
        return self._press(context, event)

    def cancel(self, context: bpy.types.Context) -> None:
        """Stop, and hide what is shown: nothing takes clicks any more."""
        super().cancel(context)
        stop()

    def _begin(self, obj: bpy.types.Object) -> Steps[core.PointViewer]:
        parameters = parameters_from(self, SELECTION)
        return point_viewer_of(obj, parameters)

    def _commit(self, obj: bpy.types.Object, value: core.PointViewer) -> str:
        ray = None if self.face < 0 else _above_face(obj, self.face)
        self._viewer = value
        self._target = Target.of(obj)
        self._overlay = Overlay(
            obj.session_uid, stretch(obj), bpy.context.workspace.name, vertices_now(obj)
        )
        sight_overlay.show(self._overlay)
        if ray is not None:
            self._show(*ray)
        return f"{len(value.views.samples):,} samples"

    def _press(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Take a pressed key or button; all that is not ours passes."""
        place = viewport_at(context, event.mouse_x, event.mouse_y)
        ours = place is not None and not navigates(event)
        if event.type == "ESC" or (event.type == "RIGHTMOUSE" and ours):
            stop()
            return {"FINISHED"}
        if event.type in {"RET", "NUMPAD_ENTER"}:
            modal.show_hint(self._overlay.workspace, None)
            return {"FINISHED"}
        if event.type != "LEFTMOUSE" or place is None or not ours:
            return {"PASS_THROUGH"}
        return self._clicked(context, *place)

    def _clicked(
        self, context: bpy.types.Context, region: bpy.types.Region, x: int, y: int
    ) -> set[str]:
        """Show what the point under the cursor sees."""
        try:
            obj = self._target.find()
        except DecompositionError as error:
            stop()
            self.report({"WARNING"}, str(error))
            return {"CANCELLED"}
        origin, direction = ray_at(region, x, y)
        space = space_of(context, region)
        near, far = shown_along(space, region.data, origin, direction)
        begin = ray_within(obj, origin + near * direction, direction)
        self._show(*begin, far - near)
        return {"RUNNING_MODAL"}

    def _show(self, origin: Vector, direction: Vector, reach: float = math.inf) -> None:
        """Show what the first point along a ray in object space sees.

        None is seen beyond a reach, in lengths of the direction.
        """
        ray = stretched(np.array([origin, direction]), self._overlay.stretch)
        view = self._viewer.look(*ray)
        if view is None:
            return
        along = (view.point - ray[0]) @ ray[1] / (ray[1] @ ray[1])
        if along <= reach:
            self._overlay.view = view
            sight_overlay.show(self._overlay)


WCD_OT_show_sight.__annotations__ = {
    **properties_for(SELECTION),
    "face": bpy.props.IntProperty(
        name="Face",
        description="For scripts: the face whose middle is looked from, -1 for none",
        default=-1,
        min=-1,
        options={"SKIP_SAVE"},
    ),
}


class WCD_OT_hide_sight(bpy.types.Operator):
    """Remove lines of sight from the viewports."""

    bl_idname = "wcd.hide_sight"
    bl_label = "Hide Lines of Sight"
    bl_description = "Remove the lines of sight from the viewports"
    bl_options: ClassVar[set[str]] = set()

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether any are shown."""
        shown = sight_overlay.current is not None
        return is_free(cls, None if shown else "No lines of sight are shown; show some")

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Hide them."""
        stop()
        return {"FINISHED"}


CLASSES = (WCD_OT_show_sight, WCD_OT_hide_sight)


def stop(*_: object) -> None:
    """Hide the overlay, and clear its text from the status bar."""
    overlay = sight_overlay.current
    sight_overlay.show(None)
    if overlay is not None:
        modal.show_hint(overlay.workspace, None)


def _stop_if_stale(_: bpy.types.Scene, graph: bpy.types.Depsgraph) -> None:
    """Hide the overlay if its object's vertices have moved."""
    overlay = sight_overlay.current
    if overlay is None:
        return
    for obj in changed_objects(graph):
        same = obj.session_uid == overlay.object_uid
        if same and not np.array_equal(vertices_now(obj), overlay.vertices):
            stop()
            return


HANDLERS = {"load_pre": stop, "depsgraph_update_post": _stop_if_stale}


def _above_face(obj: bpy.types.Object, face: int) -> tuple[Vector, Vector]:
    """Return a ray in object space that hits the middle of a face from outside."""
    polygons = obj.data.polygons
    if face >= len(polygons):
        raise DecompositionError(
            f"{obj.name} has no face {face}; it has {len(polygons)}, counted from 0."
        )
    normal = polygons[face].normal
    height = 1e-4 * float(np.ptp(vertices_now(obj), axis=0).max())
    return polygons[face].center + height * normal, -normal
