"""Use the parts: as objects, exploded views, face sets and colors."""

from __future__ import annotations

import bpy

from .bridge.homes import objects_in
from .bridge.parts.read import parts_on
from .bridge.parts.separating import separate
from .bridge.refusals import object_mode_refusal, parts_refusal
from .bridge.views.colors import CHOICES, show_colors_as
from .bridge.views.exploding import DISTANCE_HELP, FARTHEST, explode, has_view, implode
from .bridge.views.face_sets_and_colors import write_colors, write_face_sets
from .bridge.work.in_step import bring_in_step
from .running.on_objects import OnEach, active_object
from .settings import properties_for


class _OnParts(OnEach):
    """Half an operator on objects with parts, usually in Object Mode."""

    _refusal = staticmethod(object_mode_refusal)


class WCD_OT_separate(_OnParts, bpy.types.Operator):
    """Make an object of each part."""

    bl_idname = "wcd.separate"
    bl_label = "Separate Convex Parts"
    bl_description = (
        "Make an object of each part, in a new collection. Modifiers, groups,"
        " attributes and materials are kept"
    )

    def _work(self, obj: bpy.types.Object) -> None:
        was_active = active_object(bpy.context) == obj
        stays = self.original == "HIDE"
        pieces = separate(obj, stays)
        if stays:
            obj.select_set(False)
            obj.hide_set(True)
            obj.hide_render = True
        layer = bpy.context.view_layer
        layer.update()
        shown = objects_in(layer)
        there = [piece for piece in pieces if piece in shown]
        for piece in there:
            piece.select_set(True)
        if there and (was_active or layer.objects.active is None):  # or a hull was
            layer.objects.active = there[0]


WCD_OT_separate.__annotations__ = {
    "original": bpy.props.EnumProperty(
        name="Original",
        description="What happens to the object that is separated",
        items=(
            ("HIDE", "Hide", "It stays as it is, hidden in viewports and renders"),
            (
                "REMOVE",
                "Remove",
                "It is deleted with its hulls; its other children go to the largest"
                " part",
            ),
        ),
    )
}


class WCD_OT_explode(_OnParts, bpy.types.Operator):
    """Move the parts apart."""

    bl_idname = "wcd.explode"
    bl_label = "Exploded View of Convex Parts"
    bl_description = (
        "Move the parts away from the center with a modifier. The mesh itself does not"
        " change"
    )
    _waits = False

    def _work(self, obj: bpy.types.Object) -> None:
        bring_in_step(obj)
        parts_on(obj)  # or an error
        explode(obj, self.distance)


WCD_OT_explode.__annotations__ = {
    "distance": bpy.props.FloatProperty(
        name="Distance",
        description=DISTANCE_HELP,
        default=0.5,
        min=0.0,
        soft_max=FARTHEST,
        subtype="FACTOR",
    )
}


class WCD_OT_implode(_OnParts, bpy.types.Operator):
    """Remove exploded views."""

    bl_idname = "wcd.implode"
    bl_label = "End Exploded View"
    bl_description = "Remove the modifier of the exploded view"
    _waits = False
    _work = staticmethod(implode)

    @classmethod
    def _obstacle(cls, context: bpy.types.Context) -> str | None:
        """Return why there is no exploded view to end."""
        reason = super()._obstacle(context)
        there = {*cls._candidates(context), active_object(context)} - {None}
        exploded = {obj for obj in there if reason is None and has_view(obj)}
        if exploded and not exploded.isdisjoint(cls._chosen(context)):
            return None
        return reason or "There is no exploded view; press Exploded View first"


class WCD_OT_face_sets(_OnParts, bpy.types.Operator):
    """Make face sets of the parts."""

    bl_idname = "wcd.face_sets"
    bl_label = "Face Sets from Convex Parts"
    bl_description = (
        "Make a face set of each part, for Sculpt Mode. Clear restores the former face"
        " sets"
    )
    _refusal = staticmethod(parts_refusal)
    _work = staticmethod(write_face_sets)


class WCD_OT_color_attribute(_OnParts, bpy.types.Operator):
    """Write the colors of the parts to the mesh."""

    bl_idname = "wcd.color_attribute"
    bl_label = "Color Attribute from Convex Parts"
    bl_description = (
        "Write the colors of the parts to the color attribute wcd_color, for Vertex"
        " Paint, shaders and export"
    )
    _refusal = staticmethod(parts_refusal)
    _work = staticmethod(write_colors)


class WCD_OT_show_colors(_OnParts, bpy.types.Operator):
    """Show the colors of the parts by materials, or as an overlay."""

    bl_idname = "wcd.show_colors"
    bl_label = "Show Colors of Convex Parts"
    bl_description = (
        "Show the colors of the parts by materials, or over the faces in the viewports"
        " without touching slots and materials"
    )

    @classmethod
    def description(
        cls, context: bpy.types.Context, properties: bpy.types.OperatorProperties
    ) -> str:
        """Return the tooltip of the button of a choice."""
        return next(help for name, _, help in CHOICES if name == properties.colors)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Show them as a button does."""
        self.from_now_on = True
        return self.execute(context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Show them; let later runs do the same if a button was pressed.

        Adjust Last Operation takes that back, and calls this again.
        """
        if self.from_now_on:
            context.scene.wcd.colors = self.colors
        return super().execute(context)

    def _work(self, obj: bpy.types.Object) -> None:
        bring_in_step(obj)
        show_colors_as(obj, self.colors)


WCD_OT_show_colors.__annotations__ = {
    **properties_for(("colors",)),
    "from_now_on": bpy.props.BoolProperty(options={"HIDDEN", "SKIP_SAVE"}),
}

CLASSES = (
    WCD_OT_separate,
    WCD_OT_explode,
    WCD_OT_implode,
    WCD_OT_face_sets,
    WCD_OT_color_attribute,
    WCD_OT_show_colors,
)
