"""Select, isolate and view parts of the active object, and mark their seams."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy
import numpy as np

from .bridge.mesh.corners import boundary_edges
from .bridge.mesh.seams import mark_seams, unmark_seams
from .bridge.mesh.selection import isolate_parts, select_edges, select_faces, show_all
from .bridge.parts.read import parts_on
from .bridge.parts.rows import chosen_numbers, chosen_parts
from .bridge.refusals import edit_refusal, faces_refusal, seams_refusal
from .bridge.views.isolating import end_isolation, isolate
from .bridge.work.in_step import bring_in_step
from .editing.edit_parts import in_scope, scope
from .running.on_objects import OnActive, OnEach
from .viewport.viewports import frame_points, no_viewport, points_of_parts

_EXTEND = bpy.props.BoolProperty(
    name="Extend", description="Keep the present selection", default=False
)


class _Show(OnActive, OnEach):
    """Half an operator on the faces of parts."""

    _refusal = staticmethod(faces_refusal)


def _members(obj: bpy.types.Object) -> np.ndarray:
    """Return which faces, or points, belong to the chosen parts."""
    return np.isin(parts_on(obj).labels, chosen_parts(obj))


class WCD_OT_select_parts(_Show, bpy.types.Operator):
    """Select the faces of the chosen parts."""

    bl_idname = "wcd.select_parts"
    bl_label = "Select Convex Parts"
    bl_description = (
        "Select the faces of the parts that are ticked in the list, or of the"
        " highlighted one. The selection shows in Edit Mode"
    )
    _waits = False

    def _work(self, obj: bpy.types.Object) -> None:
        select_faces(obj, _members(obj), self.extend)


WCD_OT_select_parts.__annotations__ = {"extend": _EXTEND}


class WCD_OT_isolate_parts(_Show, bpy.types.Operator):
    """Hide the faces of all other parts, or show them again."""

    bl_idname = "wcd.isolate_parts"
    bl_label = "Isolate Convex Parts"
    bl_description = (
        "Hide the faces of all other parts. Parts that are ticked in the list stay, or"
        " the highlighted one. In Object Mode a modifier hides them, in viewports only"
    )
    _waits = False

    @classmethod
    def description(
        cls, context: bpy.types.Context, properties: bpy.types.OperatorProperties
    ) -> str:
        """Return the tooltip of the button Isolate, or of Show All."""
        return cls.bl_description if properties.hide else "Show all hidden faces again"

    def _work(self, obj: bpy.types.Object) -> None:
        if obj.mode == "EDIT" and self.hide:
            isolate_parts(obj, parts_on(obj).labels, chosen_parts(obj))
        elif obj.mode == "EDIT":
            show_all(obj)
        elif self.hide:
            bring_in_step(obj)
            parts_on(obj)  # or an error
            isolate(obj, sorted(chosen_numbers(obj)))
        else:
            end_isolation(obj)


WCD_OT_isolate_parts.__annotations__ = {
    "hide": bpy.props.BoolProperty(
        name="Hide Others",
        description="Hide the other parts; otherwise show all faces",
        default=True,
    )
}


class WCD_OT_frame_parts(_Show, bpy.types.Operator):
    """Move the view to the chosen parts."""

    bl_idname = "wcd.frame_parts"
    bl_label = "Frame Convex Parts"
    bl_description = (
        "Move the view to the parts that are ticked in the list, or to the highlighted"
        " one"
    )
    bl_options: ClassVar[set[str]] = set()
    _waits = False
    _refusal = staticmethod(edit_refusal)

    @classmethod
    def _obstacle(cls, context: bpy.types.Context) -> str | None:
        """Return that there is no view to move, or why nothing can be done."""
        return no_viewport(context) or super()._obstacle(context)

    def _work(self, obj: bpy.types.Object) -> None:
        points = points_of_parts(obj, _members(obj))
        frame_points(bpy.context, points)


class WCD_OT_select_boundary(_Show, bpy.types.Operator):
    """Select the edges between parts."""

    bl_idname = "wcd.select_boundary"
    bl_label = "Select Boundary of Convex Parts"
    bl_description = "Select the edges where parts meet"
    _waits = False

    def _work(self, obj: bpy.types.Object) -> None:
        labels, chosen = parts_on(obj).labels, in_scope(obj, self.scope)
        select_edges(obj, boundary_edges(obj.data, labels, chosen), self.extend)


WCD_OT_select_boundary.__annotations__ = {"scope": scope("CHOSEN"), "extend": _EXTEND}


class WCD_OT_mark_seams(_Show, bpy.types.Operator):
    """Mark the edges between parts as seams, for unwrapping."""

    bl_idname = "wcd.mark_seams"
    bl_label = "Mark Seams of Convex Parts"
    bl_description = (
        "Mark the edges where parts meet as seams, for unwrapping, in place of those"
        " that were marked so before. Your own seams stay"
    )

    def _work(self, obj: bpy.types.Object) -> None:
        labels, chosen = parts_on(obj).labels, in_scope(obj, self.scope)
        mark_seams(obj.data, boundary_edges(obj.data, labels, chosen))


WCD_OT_mark_seams.__annotations__ = {"scope": scope("ALL")}


class WCD_OT_unmark_seams(_Show, bpy.types.Operator):
    """Take back the seams that were marked between parts."""

    bl_idname = "wcd.unmark_seams"
    bl_label = "Unmark Seams of Convex Parts"
    bl_description = (
        "Take back the seams that Mark Seams marked. Edges that were seams before stay"
    )

    _refusal = staticmethod(seams_refusal)

    def _work(self, obj: bpy.types.Object) -> None:
        unmark_seams(obj.data)


CLASSES: tuple[Any, ...] = (
    WCD_OT_select_parts,
    WCD_OT_isolate_parts,
    WCD_OT_frame_parts,
    WCD_OT_select_boundary,
    WCD_OT_mark_seams,
    WCD_OT_unmark_seams,
)
