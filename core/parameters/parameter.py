"""Metadata of parameters, and the checks of their values."""

from __future__ import annotations

import math
from dataclasses import Field, dataclass, field, fields
from numbers import Integral, Real
from typing import Any

from ..errors import DecompositionError

# Blender stores properties in single precision: a value may exceed a bound by this
# share of the bound.
_FLOAT32_SLACK = 1e-6
# Messages write whole numbers from this on with an exponent.
_LONGEST_PLAIN = 1e15


@dataclass(frozen=True)
class Choice:
    """One value of an enumerated parameter.

    Attributes
    ----------
    identifier : str
        The value, in capital letters.
    label : str
        Title Case name in the interface.
    help : str
        Tooltip: a sentence without a final full stop.
    """

    identifier: str
    label: str
    help: str


@dataclass(frozen=True)
class ParameterInfo:
    """Metadata of a parameter for the interface, the command line and the checks.

    Attributes
    ----------
    label, help : str
        Title Case name, and tooltip: a sentence without a final full stop.
    low, high : float, optional
        Inclusive bounds of a number.
    usual : float, optional
        Upper end of the slider; values up to `high` can be typed.
    choices : tuple of Choice
        Values of an enumeration; empty for numbers and texts.
    subtype : str
        Blender's subtype of the property: 'ANGLE' (radians), 'FACTOR' or 'NONE'.
    advanced : bool
        Whether the sidebar shows it among the advanced settings of parts.
    affects_sight : bool
        Whether samples or lines of sight depend on it. If not, a new value needs no new
        rays.
    used_with : tuple of str and value, optional
        Another parameter, and the value that it must have. With others, this one has no
        effect.
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
    used_with: tuple[str, Any] | None = None


def parameter(default: Any, info: ParameterInfo) -> Any:
    """Return a dataclass field that carries its `ParameterInfo` as metadata.

    Parameters
    ----------
    default : int, float or str
        Its type is the type of the parameter. Angles are in radians.
    info : ParameterInfo

    Returns
    -------
    dataclasses.Field
    """
    return field(default=default, metadata={"info": info})


def info_of(parameter_field: Field[Any]) -> ParameterInfo:
    """Return the `ParameterInfo` of a field.

    Parameters
    ----------
    parameter_field : dataclasses.Field
        One of the fields of `Parameters`, `HullParameters` or `BodyParameters`.

    Returns
    -------
    ParameterInfo
    """
    return parameter_field.metadata["info"]


def field_of(kind: type, name: str) -> Field[Any]:
    """Return the field of a dataclass that has a name."""
    return next(each for each in fields(kind) if each.name == name)


def check_fields(parameters: Any) -> None:
    """Check every field of a dataclass, and convert values to Python's plain types.

    Parameters
    ----------
    parameters : Parameters, HullParameters or BodyParameters
        Changed in place, although it is frozen.

    Raises
    ------
    DecompositionError
        If a value is out of its bounds or not one of its choices.
    """
    for parameter_field in fields(parameters):
        value = getattr(parameters, parameter_field.name)
        check(parameter_field, value)
        default: Any = parameter_field.default
        # `str` would name a member of an Enum of texts, and not return its text.
        plain = str.__str__ if isinstance(default, str) else type(default)
        object.__setattr__(parameters, parameter_field.name, plain(value))


def check(parameter_field: Field[Any], value: Any) -> None:
    """Raise an error if a value is not allowed for a field.

    Parameters
    ----------
    parameter_field : dataclasses.Field
        One of the fields of `Parameters`, `HullParameters` or `BodyParameters`.
    value : object
        The value to check.

    Raises
    ------
    DecompositionError
        If the value has the wrong type, is out of bounds or not one of the choices.
    """
    info = info_of(parameter_field)
    if info.choices:
        allowed = [choice.identifier for choice in info.choices]
        if not isinstance(value, str) or value not in allowed:
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
    bounds = f"choose a value from {_written(info.low)} to {_written(info.high)}"
    try:
        finite = number and math.isfinite(value)
    except OverflowError as error:  # a whole number beyond all floats
        raise DecompositionError(f"{info.label} is out of range; {bounds}.") from error
    if not finite or isinstance(value, bool):
        kind = "a whole number" if whole else "a number"
        raise DecompositionError(f"{info.label} must be {kind}, not {value!r}.")
    if not is_within(value, info.low, info.high):
        raise DecompositionError(f"{info.label} is {_written(value)}; {bounds}.")


def is_within(value: float, low: float, high: float) -> bool:
    """Return whether a number is within bounds, but for rounding to single precision.

    Parameters
    ----------
    value : int or float
    low, high : float
        Inclusive bounds, which may be infinite.

    Returns
    -------
    bool
    """
    if isinstance(value, Integral):
        return low <= value <= high
    below, above = _FLOAT32_SLACK * abs(low), _FLOAT32_SLACK * abs(high)
    return low - below <= value <= high + above


def _written(number: float) -> str:
    """Return a number as text, without an exponent if it is whole and not huge."""
    plain = abs(number) < _LONGEST_PLAIN and number == round(number)
    return f"{number:.0f}" if plain else f"{number:g}"
