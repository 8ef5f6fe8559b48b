"""Choose, lock, rename and merge parts, as clicks in viewports or the pie menu do."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from ...core.errors import DecompositionError
from ..bridge.homes import objects_in
from ..bridge.parts.renaming import rename_parts
from ..bridge.parts.rows import active_row, chosen_numbers
from ..bridge.refusals import edit_refusal
from ..bridge.work.in_step import bring_in_step
from ..running.modal import is_free
from ..running.on_objects import OnActive, OnEach
from . import picking


def choose(obj: bpy.types.Object, number: int, extend: bool) -> None:
    """Highlight a part's row; `extend` adds the part to the chosen ones, or takes away.

    Chosen are the ticked parts, or the highlighted one. So without `extend` no part
    stays ticked. A part that came by a join gets a row before.
    """
    if all(row.number != number for row in obj.wcd_parts):
        bring_in_step(obj)
    chosen = {number}
    if extend:
        chosen = chosen_numbers(obj) ^ chosen or chosen
    for place, row in enumerate(obj.wcd_parts):
        row.chosen = len(chosen) > 1 and row.number in chosen
        if row.number == number if number in chosen else chosen == {row.number}:
            obj.wcd_active_part = place


def choose_too(obj: bpy.types.Object, number: int) -> None:
    """Add a part to the chosen ones; the highlighted part stays highlighted."""
    highlighted = active_row(obj).number
    choose(obj, number, extend=True)
    obj.wcd_active_part = [row.number for row in obj.wcd_parts].index(highlighted)


def make_active(context: bpy.types.Context, obj: bpy.types.Object) -> None:
    """Make an object the active one, as a click does; the mode stays."""
    layer = context.view_layer
    if layer.objects.active == obj:
        return
    if obj.mode == "OBJECT":
        for other in context.selected_objects:
            other.select_set(False)
        obj.select_set(True)
    layer.objects.active = obj


class _OnRows(OnActive, OnEach):
    """Half an operator on rows of the table."""

    _refusal = staticmethod(edit_refusal)


class WCD_OT_choose_part(bpy.types.Operator):
    """Highlight a part in the list, or add it to the ticked ones."""

    bl_idname = "wcd.choose_part"
    bl_label = "Choose Convex Part"
    bl_description = "Highlight a part in the list, or tick it besides others"
    bl_options: ClassVar[set[str]] = {"UNDO", "INTERNAL"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Choose the part, on the object that has it."""
        name, obj = self.object, context.active_object
        if name:
            obj = bpy.data.objects.get(name)
        lost = f"There is no object {name}" if name and obj is None else None
        try:
            if reason := lost or edit_refusal(obj) or _absence(context, obj):
                raise DecompositionError(f"{reason}.")
            make_active(context, obj)
            choose(obj, self.number, self.extend)
        except DecompositionError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


WCD_OT_choose_part.__annotations__ = {
    "object": bpy.props.StringProperty(
        name="Object", description="Its name; none means the active object"
    ),
    "number": bpy.props.IntProperty(
        name="Number", description="Number of the part, as its faces have it", min=0
    ),
    "extend": bpy.props.BoolProperty(
        name="Extend", description="Add the part to the chosen ones, or take it away"
    ),
}


class WCD_OT_lock_parts(_OnRows, bpy.types.Operator):
    """Lock the chosen parts, or unlock them."""

    bl_idname = "wcd.lock_parts"
    bl_label = "Lock Convex Parts"
    bl_description = (
        "Lock the parts that are ticked in the list, or the highlighted one; unlock"
        " them if all are locked. A new decomposition keeps locked parts"
    )

    def _work(self, obj: bpy.types.Object) -> None:
        chosen = chosen_numbers(obj)
        rows = [row for row in obj.wcd_parts if row.number in chosen]
        lock = not all(row.locked for row in rows)
        for row in rows:
            row.locked = lock


class WCD_OT_rename_part(_OnRows, bpy.types.Operator):
    """Rename the highlighted part."""

    bl_idname = "wcd.rename_part"
    bl_label = "Rename Convex Part"
    bl_description = "Rename the highlighted part, its vertex group and its material"
    _waits = False  # runs take names as they are at their end

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Ask for the name."""
        obj = context.active_object
        self.name = active_row(obj).name
        return context.window_manager.invoke_props_dialog(self)

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the name, ready to be typed."""
        self.layout.activate_init = True
        self.layout.prop(self, "name", text="")

    def _work(self, obj: bpy.types.Object) -> None:
        number = active_row(obj).number
        for reason in rename_parts(obj, {number: self.name.strip()}):
            self.report({"WARNING"}, f"{reason}.")


WCD_OT_rename_part.__annotations__ = {
    "name": bpy.props.StringProperty(name="Name", options={"SKIP_SAVE"})
}


class WCD_OT_merge_next(bpy.types.Operator):
    """Merge the chosen parts with the next one that is clicked."""

    bl_idname = "wcd.merge_next"
    bl_label = "Merge with Next Click"
    bl_description = "Merge the highlighted part with the part that you click next"
    bl_options: ClassVar[set[str]] = {"INTERNAL"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether parts are picked."""
        picked = picking.current is not None
        return is_free(cls, None if picked else "No parts are picked; press Pick Parts")

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Wait for the click."""
        if picking.current is not None:
            picking.current.merging = True
        picking.tell(context)
        return {"FINISHED"}


def _absence(context: bpy.types.Context, obj: bpy.types.Object) -> str | None:
    """Return why an object cannot become the active one."""
    if obj in objects_in(context.view_layer):
        return None
    return f"{obj.name} is not in the view layer; link it to a collection that is"


CLASSES: tuple[Any, ...] = (
    WCD_OT_choose_part,
    WCD_OT_lock_parts,
    WCD_OT_rename_part,
    WCD_OT_merge_next,
)
