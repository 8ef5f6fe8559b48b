"""Blender properties made from the fields of the parameters."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import Field, fields
from typing import Any

import bpy
import numpy as np

from ..core.parameters.hulls import HullParameters
from ..core.parameters.parameter import ParameterInfo, info_of
from ..core.parameters.parts import Parameters
from ..core.parameters.presets import Preset

ALL = tuple(field.name for field in fields(Parameters))
FRONT = tuple(f.name for f in fields(Parameters) if not info_of(f).advanced)
ADVANCED = tuple(f.name for f in fields(Parameters) if info_of(f).advanced)
RECUT = tuple(f.name for f in fields(Parameters) if not info_of(f).affects_sight)
HULLS = tuple(field.name for field in fields(HullParameters))
_FIELDS = {f.name: f for kind in (Parameters, HullParameters) for f in fields(kind)}
MEASURE = ("sampling", "samples", "sight", "rays", "cone_angle", "seed")
SELECTION = ("samples", "seed")


def annotations(names: Iterable[str] = ALL) -> dict[str, Any]:
    """Return the annotations that give a Blender class these parameters."""
    return {name: _property(_FIELDS[name]) for name in names}


def _setting(name: str) -> Any:
    """Return the annotation of a parameter as a setting of the sidebar."""
    return _property(_FIELDS[name], **({"update": _recut} if name in RECUT else {}))


def _recut(settings: Any, context: bpy.types.Context) -> None:
    """Cut the parts of the active object anew if the settings are live."""
    if settings.live and bpy.ops.wcd.recut.poll():
        bpy.ops.wcd.recut()


def parameters_from(owner: Any, names: Iterable[str] = ALL) -> Parameters:
    """Return the `Parameters` that `owner`, of a class so annotated, holds."""
    return Parameters(**{name: _value(owner, _FIELDS[name]) for name in names})


def hull_parameters_from(owner: Any) -> HullParameters:
    """Return the `HullParameters` that `owner`, of a class so annotated, holds."""
    return HullParameters(**{name: _value(owner, _FIELDS[name]) for name in HULLS})


def is_used(owner: Any, name: str) -> bool:
    """Return whether the other settings leave a setting any effect."""
    if name in {"rays", "psi_pairs", "cone_angle"}:
        return owner.sight == "CONE"
    if name in {"min_parts", "max_parts"}:
        return owner.parts == 0
    if name == "samples":
        return owner.sampling == "AREA"
    if name == "max_error":
        return owner.pieces == "BY_ERROR"
    if name == "max_vertices":
        return owner.shape == "HULL"
    if name == "template":
        return owner.naming == "TEMPLATE"
    return True


def draw(layout: Any, owner: Any, names: Iterable[str]) -> None:
    """Draw settings one below another, those without effect greyed."""
    layout.use_property_split = True
    layout.use_property_decorate = False
    for name in names:
        row = layout.row()
        row.active = is_used(owner, name)
        row.prop(owner, name)


def _property(field: Field[Any], **more: Any) -> Any:
    info = info_of(field)
    described = {
        "name": info.label,
        "description": info.help,
        "default": field.default,
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
    step = 100 if info.subtype == "ANGLE" else 10
    return bpy.props.FloatProperty(
        subtype=info.subtype, precision=3, step=step, **described
    )


def _bounds(info: ParameterInfo, number: type) -> dict[str, Any]:
    bounds = {"min": info.low, "max": info.high, "soft_max": info.usual}
    return {name: number(v) for name, v in bounds.items() if math.isfinite(v)}


def _value(owner: Any, field: Field[Any]) -> Any:
    """Return a setting as it was meant before Blender rounded it to float32."""
    value = getattr(owner, field.name)
    if not isinstance(value, float):
        return value
    if value == float(np.float32(field.default)):
        return field.default
    return float(f"{value:.7g}")


def hand_over(settings: Any, button: Any, names: Iterable[str]) -> None:
    """Give a button's operator the scene's settings."""
    for name in names:
        setattr(button, name, getattr(settings, name))


def use_preset(settings: Any, chosen: Preset) -> None:
    """Set all settings of a scene to those of a preset."""
    parameters = chosen.parameters()
    live, settings.live = settings.live, False  # all at once, not one by one
    for name in ALL:
        setattr(settings, name, getattr(parameters, name))
    settings.live = live
    _recut(settings, bpy.context)


class WCD_PG_settings(bpy.types.PropertyGroup):
    """The settings of a scene, handed to the operators by the sidebar."""


WCD_PG_settings.__annotations__ = {name: _setting(name) for name in (*ALL, *HULLS)}
WCD_PG_settings.__annotations__["live"] = bpy.props.BoolProperty(
    name="Live",
    description=(
        "Cut the active object's parts anew as soon as their number, the balance or"
        " another setting changes that asks for no new lines of sight"
    ),
    update=_recut,
)
