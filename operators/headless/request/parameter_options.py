"""Options of the command line, made from infos."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from typing import Any

from ....core.parameters.parameter import ParameterInfo


def add_option(
    group: argparse._ArgumentGroup, name: str, info: ParameterInfo, default: Any
) -> None:
    """Add an option; unless it is given, the options have no such name."""
    if info.choices:
        convert: Callable[[str], Any] = _choice(info)
        metavar = "{" + ",".join(_word(c.identifier) for c in info.choices) + "}"
        shown = _word(default)
    elif info.subtype == "ANGLE":
        convert, metavar = _angle(info), "DEGREES"
        shown = f"{math.degrees(default):g}"
    elif isinstance(default, str):
        convert, metavar, shown = str, "TEXT", default
    else:
        convert = type(default)
        metavar = "N" if isinstance(default, int) else "X"
        shown = f"{default:g}"
    group.add_argument(
        "--" + name.replace("_", "-"),
        type=convert,
        default=argparse.SUPPRESS,
        metavar=metavar,
        help=f"{_explained(info)} (default: {shown})".replace("%", "%%"),
    )


def _explained(info: ParameterInfo) -> str:
    """Return the help of a info and of its choices."""
    choices = [
        f"{_word(c.identifier)}: {c.help[0].lower()}{c.help[1:]}" for c in info.choices
    ]
    return ". ".join([info.help, "; ".join(choices)] if choices else [info.help])


def _word(identifier: str) -> str:
    """Return how an identifier such as ALL_PAIRS is typed: all-pairs."""
    return identifier.lower().replace("_", "-")


def _choice(info: ParameterInfo) -> Callable[[str], str]:
    """Return a converter to one of a info's identifiers, in any case."""
    by_word = {_word(choice.identifier): choice.identifier for choice in info.choices}

    def convert(text: str) -> str:
        if _word(text) not in by_word:
            raise argparse.ArgumentTypeError(
                f"{text!r} is not one of {', '.join(by_word)}"
            )
        return by_word[_word(text)]

    return convert


def _angle(info: ParameterInfo) -> Callable[[str], float]:
    """Return a converter from degrees to radians that names bounds in degrees."""
    low, high = math.degrees(info.low), math.degrees(info.high)

    def convert(text: str) -> float:
        degrees = float(text)
        if not low <= degrees <= high:
            raise argparse.ArgumentTypeError(
                f"{text} is not from {low:g} to {high:g} degrees"
            )
        return math.radians(degrees)

    convert.__name__ = "angle"  # argparse: "invalid angle value"
    return convert
