"""What is known of a parameter besides its value."""

from __future__ import annotations

import math
from dataclasses import Field, dataclass, field, fields
from numbers import Integral, Real
from typing import Any

from ..errors import DecompositionError

# Blender keeps properties in single precision: a bound may come back this far off.
_FLOAT32_SLACK = 1e-6


@dataclass(frozen=True)
class Choice:
    """One value of an enumerated parameter."""

    identifier: str
    label: str
    help: str


@dataclass(frozen=True)
class ParameterInfo:
    """What the interface, the command line and the checks need of a parameter.

    Attributes
    ----------
    label, help : str
        Title Case name, and a sentence without a final full stop.
    low, high : float, optional
        Inclusive bounds of a number.
    usual : float, optional
        How far sliders go; more can be typed.
    choices : tuple of Choice
        Values of an enumeration; empty for numbers.
    subtype : str
        'ANGLE' (radians), 'FACTOR' or 'NONE', in Blender's vocabulary.
    advanced : bool
        Whether it belongs with the settings few users touch.
    affects_sight : bool
        Whether samples or lines of sight depend on it. If not, a new value needs no new
        rays.
    """

    label: str
    help: str
    low: float = -math.inf
    high: float = math.inf
    usual: float = math.inf
    choices: tuple[Choice, ...] = ()
    subtype: str = "NONE"
    advanced: bool = True
    affects_sight: bool = True


def parameter(default: Any, info: ParameterInfo) -> Any:
    """Return a dataclass field that carries its `ParameterInfo` as metadata."""
    return field(default=default, metadata={"info": info})


def info_of(parameter_field: Field[Any]) -> ParameterInfo:
    """Return the `ParameterInfo` of one of `dataclasses.fields(Parameters)`."""
    info: ParameterInfo = parameter_field.metadata["info"]
    return info


def settle(parameters: Any) -> None:
    """Check every field of a frozen dataclass of parameters, and make it plain.

    Scripts may pass NumPy's numbers; kept are Python's.
    """
    for parameter_field in fields(parameters):
        value = getattr(parameters, parameter_field.name)
        check(parameter_field, value)
        default: Any = parameter_field.default
        object.__setattr__(parameters, parameter_field.name, type(default)(value))


def check(parameter_field: Field[Any], value: Any) -> None:
    """Raise if `value` is not one that the field's info allows."""
    info = info_of(parameter_field)
    if info.choices:
        allowed = [choice.identifier for choice in info.choices]
        if value not in allowed:
            raise DecompositionError(
                f"{info.label} cannot be {value!r}; choose one of {', '.join(allowed)}."
            )
        return
    if isinstance(parameter_field.default, str):
        if not isinstance(value, str):
            raise DecompositionError(f"{info.label} must be a text, not {value!r}.")
        return
    whole = isinstance(parameter_field.default, int)
    number = isinstance(value, Integral if whole else Real)
    if not number or isinstance(value, bool) or not math.isfinite(value):
        kind = "a whole number" if whole else "a number"
        raise DecompositionError(f"{info.label} must be {kind}, not {value!r}.")
    slack = 0.0 if whole else _FLOAT32_SLACK * max(1.0, abs(value))
    if not info.low - slack <= value <= info.high + slack:
        raise DecompositionError(
            f"{info.label} is {value:g}; choose a value from {info.low:g}"
            f" to {info.high:g}."
        )
