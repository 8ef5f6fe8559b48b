"""Change the parts of the active object by hand."""

from __future__ import annotations

from typing import Any

import bpy

from ...core.errors import DecompositionError
from ...core.parameters.parameter import field_of, info_of
from ...core.parameters.parts import Parameters
from ...core.steps.progress import Steps
from ..bridge.mesh.selection import selected_faces
from ..bridge.parts.read import part_identities
from ..bridge.parts.rows import active_part, chosen_numbers, chosen_parts
from ..bridge.refusals import (
    assign_refusal,
    decomposed_refusal,
    edit_refusal,
    merge_refusal,
)
from ..bridge.work import edits
from ..bridge.work.run_edit import Edited, MakeChange, edit_object
from ..running.computation import Replacement
from ..settings import properties_for


def scope(
    default: str,
    name: str = "Seams Of",
    description: str = "The parts whose seams are meant",
) -> Any:
    """Return the property that says which parts are meant, "CHOSEN" or "ALL"."""
    return bpy.props.EnumProperty(
        name=name,
        description=description,
        items=(
            ("CHOSEN", "Chosen Parts", "The ticked parts, or the highlighted one"),
            ("ALL", "All Parts", "All parts of the object"),
        ),
        default=default,
    )


def in_scope(obj: bpy.types.Object, scope: str) -> list[int]:
    """Return the parts that a `scope` means."""
    return (
        chosen_parts(obj)
        if scope == "CHOSEN"
        else list(range(len(part_identities(obj))))
    )


class _Edit(Replacement):
    """Half an operator that edits parts: its `_change(obj)` returns the edit."""

    _refusal = staticmethod(edit_refusal)

    def _begin(self, obj: bpy.types.Object) -> Steps[Edited]:
        return edit_object(obj, self._change(obj))


class WCD_OT_merge_parts(_Edit, bpy.types.Operator):
    """Make one part of the ticked parts."""

    bl_idname = "wcd.merge_parts"
    bl_label = "Merge Convex Parts"
    bl_description = (
        "Make one part of the parts that are ticked in the list. It keeps the name and"
        " color of the highlighted part if that is ticked, else of the first"
    )

    @staticmethod
    def _refusal(obj: bpy.types.Object | None) -> str | None:
        return merge_refusal(obj, len(chosen_numbers(obj)) if obj else 0)

    def _change(self, obj: bpy.types.Object) -> MakeChange:
        chosen, into = chosen_parts(obj), active_part(obj)
        reason = merge_refusal(obj, len(chosen))  # other ticked parts have no faces
        if reason:
            raise DecompositionError(f"{reason}.")
        return edits.merging(chosen, into if into in chosen else chosen[0])


class WCD_OT_split_parts(_Edit, bpy.types.Operator):
    """Decompose single parts again."""

    bl_idname = "wcd.split_parts"
    bl_label = "Split Convex Parts"
    bl_description = (
        "Decompose the chosen parts again, each by itself. All samples are on one part,"
        " so that small details come apart, such as the fingers of a hand"
    )

    def _change(self, obj: bpy.types.Object) -> MakeChange:
        if self.parts == 1:
            raise DecompositionError(
                "One part is no split; choose 2 or more, or 0 to find the number."
            )
        return edits.splitting(chosen_parts(obj), self.parts)


WCD_OT_split_parts.__annotations__ = {
    "parts": bpy.props.IntProperty(
        name="Parts",
        description="Number of parts that each is split into; 0 lets psi choose the"
        " number",
        default=2,
        min=0,
        max=int(info_of(field_of(Parameters, "parts")).high),
    )
}


class WCD_OT_assign_faces(_Edit, bpy.types.Operator):
    """Give the selected faces to the highlighted part."""

    bl_idname = "wcd.assign_faces"
    bl_label = "Assign Faces to Convex Part"
    bl_description = "Give the selected faces to the highlighted part"

    _refusal = staticmethod(assign_refusal)

    def _change(self, obj: bpy.types.Object) -> MakeChange:
        return edits.giving(selected_faces(obj), active_part(obj))


class WCD_OT_smooth_seams(_Edit, bpy.types.Operator):
    """Make the seams of parts short and smooth."""

    bl_idname = "wcd.smooth_seams"
    bl_label = "Smooth Seams of Convex Parts"
    bl_description = (
        "Make the seams of parts shorter and smoother. They stay near where they are,"
        " and follow creases"
    )

    def _change(self, obj: bpy.types.Object) -> MakeChange:
        return edits.smoothing(in_scope(obj, self.scope), self.smoothness)


WCD_OT_smooth_seams.__annotations__ = {
    "scope": scope("CHOSEN"),
    **properties_for(["smoothness"]),
}


class WCD_OT_mirror_parts(_Edit, bpy.types.Operator):
    """Copy the parts of one side to the other."""

    bl_idname = "wcd.mirror_parts"
    bl_label = "Mirror Convex Parts"
    bl_description = (
        "Copy the parts on one side of the object's X axis to the other. Each face gets"
        " the part of its mirror image. Parts that lie on one side are named .L and .R"
    )

    def _change(self, obj: bpy.types.Object) -> MakeChange:
        return edits.mirroring(self.direction == "TO_NEGATIVE")


WCD_OT_mirror_parts.__annotations__ = {
    "direction": bpy.props.EnumProperty(
        name="Direction",
        description="The side whose parts are copied",
        items=(
            ("TO_NEGATIVE", "+X to -X", "Copy the parts at positive X"),
            ("TO_POSITIVE", "-X to +X", "Copy the parts at negative X"),
        ),
    )
}


class WCD_OT_refresh_parts(_Edit, bpy.types.Operator):
    """Bring the table up to date with the mesh."""

    bl_idname = "wcd.refresh_parts"
    bl_label = "Refresh Convex Parts"
    bl_description = (
        "List the parts that are on the mesh now, and measure them again. Parts of an"
        " object that was joined to this one get names, groups and materials here"
    )

    _refusal = staticmethod(decomposed_refusal)

    def _change(self, obj: bpy.types.Object) -> MakeChange:
        return edits.refreshing()


CLASSES: tuple[Any, ...] = (
    WCD_OT_merge_parts,
    WCD_OT_split_parts,
    WCD_OT_assign_faces,
    WCD_OT_smooth_seams,
    WCD_OT_mirror_parts,
    WCD_OT_refresh_parts,
)
