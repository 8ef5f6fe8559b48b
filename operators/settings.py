"""Settings as Blender properties, made of the fields of the parameters."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import Field, fields
from typing import Any, cast

import bpy
import numpy as np

from ..core.parameters.hulls import RELATIVE_ERRORS, HullParameters
from ..core.parameters.parameter import ParameterInfo, info_of
from ..core.parameters.parts import Parameters
from .bridge.hulls import looks
from .bridge.read.extents import half_side_of
from .bridge.stored.record import MESHES
from .bridge.views import colors

ALL = tuple(field.name for field in fields(Parameters))
FRONT = tuple(f.name for f in fields(Parameters) if not info_of(f).advanced)
ADVANCED = tuple(f.name for f in fields(Parameters) if info_of(f).advanced)
RECUT = tuple(f.name for f in fields(Parameters) if not info_of(f).affects_sight)
HULLS = tuple(field.name for field in fields(HullParameters))
_FIELDS = {f.name: f for kind in (Parameters, HullParameters) for f in fields(kind)}
# Settings of runs on objects of Blender; the core does not know of them.
_OF_RUNS = ("keep_edits", "mesh", "colors")
_OF_HULLS = ("mesh", "look")
_CHOICES = {
    "colors": ("Colors", "How runs show the colors of the parts", colors.CHOICES),
    "mesh": ("Mesh", "Mesh of the object that is read", MESHES),
    "look": ("Display", "How hulls are seen in the viewport", looks.CHOICES),
}
# What sliders have of their own. A click of an arrow changes the value by a hundredth
# of the step; lengths in the scene below the smallest relative error can be typed.
_SLIDERS = {"max_error": {"step": 1, "soft_min": RELATIVE_ERRORS[0]}}
RUN = (*ALL, *_OF_RUNS)
HULL_RUN = (*HULLS, *_OF_HULLS)
MEASURE = ("sampling", "samples", "sight", "rays", "cone_angle", "seed")
SELECTION = ("samples", "seed")


def properties_for(names: Iterable[str]) -> dict[str, Any]:
    """Return settings as Blender properties, for the annotations of a class."""
    return {name: property_for(name) for name in names}


def property_for(name: str, **more: Any) -> Any:
    """Return a setting as a Blender property; `more` is given to Blender as it is."""
    if name in _FIELDS:
        return _property(_FIELDS[name], **more)
    if name == "keep_edits":
        return bpy.props.BoolProperty(
            name="Keep Edits",
            description=(
                "A new run keeps what was done by hand: merged and split parts, and the"
                " faces that were assigned. Locked parts are kept in any case"
            ),
            default=True,
            **more,
        )
    label, text, choices = _CHOICES[name]
    return bpy.props.EnumProperty(name=label, description=text, items=choices, **more)


def parameters_from(owner: Any, names: Iterable[str] = ALL) -> Parameters:
    """Return the `Parameters` of an object whose class has these properties."""
    return Parameters(**{name: _value(owner, _FIELDS[name]) for name in names})


def hull_parameters_from(owner: Any) -> HullParameters:
    """Return the `HullParameters` of an object whose class has these properties."""
    return HullParameters(**{name: _value(owner, _FIELDS[name]) for name in HULLS})


def is_used(owner: Any, name: str) -> bool:
    """Return whether a setting has an effect, given the other settings."""
    needed = info_of(_FIELDS[name]).used_with if name in _FIELDS else None
    if needed is None:
        return True
    other, value = needed
    return bool(getattr(owner, other) == value)


def other_error(settings: Any, obj: bpy.types.Object) -> tuple[str, str] | None:
    """Return the largest error of hulls in the other unit, with its name, as text."""
    if settings.pieces != "BY_ERROR":
        return None
    half = half_side_of(obj, settings.mesh)
    if not half:
        return None
    if settings.error_unit == "SCENE":
        return "Relative Error", f"{settings.max_error / half:.3g}"
    return "Error in Scene", f"{settings.max_error * half:.3g}"


def draw(layout: Any, owner: Any, names: Iterable[str]) -> None:
    """Draw settings in a column; those without effect are greyed out."""
    layout.use_property_split = True
    layout.use_property_decorate = False
    for name in names:
        row = layout.row()
        row.active = is_used(owner, name)
        row.prop(owner, name)


def _property(field: Field[Any], **more: Any) -> Any:
    """Return the Blender property of a parameter."""
    info = info_of(field)
    described = {
        "name": info.label,
        "description": info.help,
        "default": field.default,
        **_SLIDERS.get(field.name, {}),
        **more,
    }
    if info.choices:
        items = [(c.identifier, c.label, c.help) for c in info.choices]
        return bpy.props.EnumProperty(items=items, **described)
    if isinstance(field.default, str):
        return bpy.props.StringProperty(**described)
    whole = isinstance(field.default, int)
    described |= _bounds(info, int if whole else float)
    if whole:
        return bpy.props.IntProperty(**described)
    described.setdefault("step", 100 if info.subtype == "ANGLE" else 10)
    return bpy.props.FloatProperty(subtype=info.subtype, precision=3, **described)


def _bounds(info: ParameterInfo, number: type) -> dict[str, Any]:
    """Return the bounds of a parameter that are finite."""
    bounds = {"min": info.low, "max": info.high, "soft_max": info.usual}
    return {name: number(v) for name, v in bounds.items() if math.isfinite(v)}


def _value(owner: Any, field: Field[Any]) -> Any:
    """Return a setting as the user typed it, before Blender rounded it to float32."""
    value, default = getattr(owner, field.name), cast(Any, field.default)
    if not isinstance(value, float):
        return value
    if value == float(np.float32(default)):
        return default
    return float(f"{value:.7g}")


def take_over(settings: Any, operator: Any, names: Iterable[str]) -> None:
    """Give an operator those settings of a scene that its caller has not set."""
    for name in names:
        if not operator.properties.is_property_set(name):
            setattr(operator, name, getattr(settings, name))
