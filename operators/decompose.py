"""Decompose objects into convex parts, and clear what the extension added to them."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, ClassVar

import bpy

from ..core.errors import DecompositionError
from ..core.steps.progress import Steps
from .bridge.cuts.whole_mesh import bring_back, edited_since_cut, is_cut
from .bridge.hulls.hull_objects import erase_hulls, erase_lost_hulls
from .bridge.hulls.lost_hulls import hulls_to_clear
from .bridge.mesh.layers import let_undo_see_all
from .bridge.parts.erase import clear
from .bridge.read.carrier import (
    carrier_for,
    clear_carrier,
    placed_carrier,
    replaced_carriers,
)
from .bridge.read.evaluated import read_as
from .bridge.refusals import CONVERTIBLE, WORKED_ON, decompose_refusal, library_refusal
from .bridge.removal_refusals import clear_refusal
from .bridge.stored.names import CARRIER_TAG
from .bridge.stored.record import EVALUATED, check_records
from .bridge.stored.restore import has_parts, sharers
from .bridge.views.colors import show_colors_as
from .bridge.views.images import erase_images
from .bridge.views.node_modifiers import remove_views
from .bridge.work.computing import summary
from .bridge.work.locking import decompose_unlocked
from .bridge.work.run_edit import Edited
from .running import ahead
from .running.computation import Computation
from .running.on_objects import OnEach
from .settings import ADVANCED, FRONT, RUN, draw, parameters_from, properties_for


class WCD_OT_decompose(Computation, bpy.types.Operator):
    """Split objects into weakly convex parts, and show the parts on them."""

    bl_idname = "wcd.decompose"
    bl_label = "Decompose into Convex Parts"
    bl_description = (
        "Split the selected meshes into weakly convex parts, and show the parts on them"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO", "PRESET"}
    _needs_seams = False
    _settings = RUN
    _refusal = staticmethod(decompose_refusal)

    @classmethod
    def _chosen(cls, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Return the objects to work on; only the first of those that share a mesh.

        Those that share a curve get a mesh each.
        """
        firsts: dict[bpy.types.ID | None, bpy.types.Object] = {}
        for obj in super()._chosen(context):
            alone = obj is None or obj.type in CONVERTIBLE
            firsts.setdefault(obj if alone else obj.data, obj)
        return list(firsts.values())

    def _read(
        self, context: bpy.types.Context
    ) -> list[Steps[Any] | DecompositionError]:
        """Read the objects, and those of the same meshes that show other faces."""
        self._written: set[bpy.types.ID] = set()
        works = super()._read(context)
        if self.mesh == EVALUATED:
            firsts = self._chosen(context)
            for obj in super()._chosen(context):
                if obj not in firsts and self._gets_own_parts(obj):
                    works.append(self._begun(obj))
        return works

    def _gets_own_parts(self, obj: bpy.types.Object) -> bool:
        """Return whether an object does not get the parts of one with the same mesh."""
        if obj.data not in self._written:
            return True
        try:
            seen = read_as(self.mesh, obj)
        except DecompositionError:  # it will be reported as others
            return True
        return seen is not None and not seen.corresponds

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the settings; those at the front of the sidebar come first."""
        draw(self.layout, self, (*FRONT, "keep_edits", "mesh", "colors"))
        self.layout.separator()
        draw(self.layout, self, ADVANCED)

    def _begin(self, obj: bpy.types.Object) -> Steps[Edited]:
        parameters, seen = parameters_from(self), read_as(self.mesh, obj)
        target = carrier_for(obj, seen)
        self._written.add(target.data)
        return decompose_unlocked(target, parameters, self.keep_edits, seen)

    def _commit(self, obj: bpy.types.Object, value: Edited) -> str:
        for earlier in replaced_carriers(obj, value.seen):
            erase_hulls(earlier)
        carrier = placed_carrier(obj, value.seen)
        value.write(carrier)
        show_colors_as(carrier, self.colors)
        ahead.start(value)
        return summary(value.decomposition)


WCD_OT_decompose.__annotations__ = properties_for(RUN)


class WCD_OT_clear(OnEach, bpy.types.Operator):
    """Remove everything that the other operators added to objects."""

    bl_idname = "wcd.clear"
    bl_label = "Clear Convex Parts"
    bl_description = (
        "Remove the parts, the hulls and everything else that was added to the selected"
        " objects"
    )
    _needs_seams = False

    @classmethod
    def description(
        cls, context: bpy.types.Context, properties: bpy.types.OperatorProperties
    ) -> str:
        """Return the tooltip: it says beforehand which cuts would stay."""
        edited = [o.name for o in cls._chosen(context) if o and edited_since_cut(o)]
        return ". ".join([cls.bl_description, *map(_cuts_stay, edited)])

    @classmethod
    def _refusals(cls) -> Callable[[Any], str | None]:
        """Return the refusal, which looks for hulls once for all objects."""
        return partial(clear_refusal, has_hulls=hulls_to_clear())

    def _work(self, obj: bpy.types.Object) -> None:
        in_object_mode = obj.mode == "OBJECT"
        self._clear(obj)
        if in_object_mode and (n_lost := erase_lost_hulls()):
            self.report({"INFO"}, f"Hulls whose object is gone went, too: {n_lost}.")

    def _clear(self, obj: bpy.types.Object) -> None:
        """Remove everything of ours from an object."""
        check_records(obj)  # it raises before anything is removed
        erase_hulls(obj)
        is_editable = obj.type in WORKED_ON and obj.data.is_editable
        for each in sharers(obj) if is_editable else (obj,):
            remove_views(each)  # of the same parts, which go
            erase_images(each)
        clear(obj)
        if is_cut(obj) and is_editable and not bring_back(obj):
            self.report({"WARNING"}, f"{_cuts_stay(obj.name)}.")
        if has_parts(obj) and (reason := library_refusal(obj)):
            self.report({"WARNING"}, f"The parts stay. {reason}.")
        if CARRIER_TAG in obj:
            clear_carrier(obj)
        else:
            let_undo_see_all(obj)


def _cuts_stay(name: str) -> str:
    """Return what to say of an object whose faces were edited since they were cut."""
    return f"{name} was edited after its faces were cut, so the cuts stay"
