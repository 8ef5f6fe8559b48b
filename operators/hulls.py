"""Put collision hulls around objects, and make rigid bodies of objects with hulls."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, ClassVar

import bpy

from ..core.results.hulls import HullDecomposition
from ..core.steps.progress import Steps
from .bridge.hulls.hull_objects import erase_hulls, write_hulls
from .bridge.hulls.listed import hulls_of, owners_of_hulls
from .bridge.hulls.looks import look_like
from .bridge.hulls.one_hull import refit, remove_hull, write_refit
from .bridge.hulls.rigid_bodies import make_rigid
from .bridge.read.evaluated import read_as
from .bridge.refusals import build_hulls_refusal, no_hulls_refusal
from .bridge.removal_refusals import remove_hulls_refusal
from .bridge.stored.noted_hulls import forget_hulls, note_mesh_of_hulls
from .bridge.stored.record import record_of
from .bridge.work.computing_hulls import build_hulls_of, hull_summary
from .running.computation import Computation
from .running.on_objects import OnActive, OnEach
from .settings import (
    HULL_RUN,
    draw,
    hull_parameters_from,
    parameters_from,
    properties_for,
)


class WCD_OT_build_hulls(Computation, bpy.types.Operator):
    """Put collision hulls around objects, or around their parts."""

    bl_idname = "wcd.build_hulls"
    bl_label = "Build Collision Hulls"
    bl_description = (
        "Put collision hulls around the selected meshes: as few as the error allows, or"
        " one for each part. For the latter, a mesh without parts is decomposed first"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO", "PRESET"}
    _settings = HULL_RUN
    _needs_shape = True
    _refusal = staticmethod(build_hulls_refusal)

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the settings."""
        draw(self.layout, self, HULL_RUN)

    def _begin(self, obj: bpy.types.Object) -> Steps[HullDecomposition]:
        self._parameters = hull_parameters_from(self)
        parameters = parameters_from(bpy.context.scene.wcd)
        seen = read_as(self.mesh, obj)
        return build_hulls_of(
            obj, parameters, self._parameters, seen, in_window=self._in_window
        )

    def _commit(self, obj: bpy.types.Object, value: HullDecomposition) -> str:
        hulls = write_hulls(obj, value, self._parameters, to_be_edited=True)
        note_mesh_of_hulls(obj, self.mesh)
        look_like(hulls, self.look)
        return hull_summary(value)


WCD_OT_build_hulls.__annotations__ = properties_for(HULL_RUN)


class _OnHulls(OnEach):
    """Half an operator on objects with hulls."""

    _refusal: ClassVar[Callable[..., str | None]] = staticmethod(no_hulls_refusal)

    @classmethod
    def _refusals(cls) -> Callable[[Any], str | None]:
        """Return the refusal, which looks for hulls once for all objects."""
        return partial(cls._refusal, owners=owners_of_hulls())


class WCD_OT_make_rigid(_OnHulls, bpy.types.Operator):
    """Make rigid bodies of objects with hulls."""

    bl_idname = "wcd.make_rigid"
    bl_label = "Rigid Body of Hulls"
    bl_description = (
        "Make the object a rigid body in the shape of its hulls, for Blender's own"
        " simulation. Clear removes it"
    )

    def _work(self, obj: bpy.types.Object) -> None:
        make_rigid(obj, hulls_of(obj), self.kind)


WCD_OT_make_rigid.__annotations__ = {
    "kind": bpy.props.EnumProperty(
        name="Type",
        description="How the object moves in the simulation",
        items=(
            ("ACTIVE", "Active", "It falls, and other bodies push it"),
            ("PASSIVE", "Passive", "It stays where it is, or follows its animation"),
        ),
    )
}


class WCD_OT_remove_hulls(_OnHulls, bpy.types.Operator):
    """Remove the hulls of objects."""

    bl_idname = "wcd.remove_hulls"
    bl_label = "Remove Collision Hulls"
    bl_description = "Remove the hulls that were built; the parts stay"
    _refusal = staticmethod(remove_hulls_refusal)

    def _work(self, obj: bpy.types.Object) -> None:
        record_of(obj)  # it raises before anything is removed
        erase_hulls(obj)
        forget_hulls(obj)


class WCD_OT_show_hulls(_OnHulls, bpy.types.Operator):
    """Show hulls as transparent or opaque solids, or as wires."""

    bl_idname = "wcd.show_hulls"
    bl_label = "Display of Collision Hulls"
    bl_description = "Show hulls as transparent or opaque solids, or as wires"
    _waits = False

    def _work(self, obj: bpy.types.Object) -> None:
        look_like(hulls_of(obj), self.look)


WCD_OT_show_hulls.__annotations__ = properties_for(("look",))

_NAME = bpy.props.StringProperty(name="Hull", description="Name of the hull")


class WCD_OT_remove_hull(OnActive, _OnHulls, bpy.types.Operator):
    """Remove one hull of the active object."""

    bl_idname = "wcd.remove_hull"
    bl_label = "Remove This Hull"
    bl_description = "Remove this hull; the others stay"

    def _work(self, obj: bpy.types.Object) -> None:
        remove_hull(obj, self.hull)


WCD_OT_remove_hull.__annotations__ = {"hull": _NAME}


class WCD_OT_refit_hull(OnActive, Computation, bpy.types.Operator):
    """Give one hull of the active object another shape."""

    bl_idname = "wcd.refit_hull"
    bl_label = "Shape of This Hull"
    bl_description = "Fit another shape to what this hull is around; the others stay"
    _needs_shape = True
    _refusal = staticmethod(no_hulls_refusal)

    def _begin(self, obj: bpy.types.Object) -> Steps[HullDecomposition]:
        return refit(obj, self.hull, self.shape, self._in_window)

    def _commit(self, obj: bpy.types.Object, value: HullDecomposition) -> str:
        hull = write_refit(obj, self.hull, value)
        return f"{hull.name}, error {value.errors[0]:.3g}"


WCD_OT_refit_hull.__annotations__ = {"hull": _NAME, **properties_for(("shape",))}

CLASSES = (
    WCD_OT_build_hulls,
    WCD_OT_make_rigid,
    WCD_OT_remove_hulls,
    WCD_OT_show_hulls,
    WCD_OT_remove_hull,
    WCD_OT_refit_hull,
)
