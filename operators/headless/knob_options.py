"""Options of the command line, made from knobs."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from typing import Any

from ...core.knobs import Knob


def add_option(
    group: argparse._ArgumentGroup, name: str, knob: Knob, default: Any
) -> None:
    """Add an option; unless it is given, the options have no such name."""
    if knob.choices:
        convert: Callable[[str], Any] = _choice(knob)
        metavar = "{" + ",".join(_word(c.identifier) for c in knob.choices) + "}"
        shown = _word(default)
    elif knob.subtype == "ANGLE":
        convert, metavar = _angle(knob), "DEGREES"
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
        help=f"{_explained(knob)} (default: {shown})".replace("%", "%%"),
    )


def _explained(knob: Knob) -> str:
    """Return the help of a knob and of its choices."""
    choices = [
        f"{_word(c.identifier)}: {c.help[0].lower()}{c.help[1:]}" for c in knob.choices
    ]
    return ". ".join([knob.help, "; ".join(choices)] if choices else [knob.help])


def _word(identifier: str) -> str:
    """Return how an identifier such as ALL_PAIRS is typed: all-pairs."""
    return identifier.lower().replace("_", "-")


def _choice(knob: Knob) -> Callable[[str], str]:
    """Return a converter to one of a knob's identifiers, in any case."""
    by_word = {_word(choice.identifier): choice.identifier for choice in knob.choices}

    def convert(text: str) -> str:
        if _word(text) not in by_word:
            raise argparse.ArgumentTypeError(
                f"{text!r} is not one of {', '.join(by_word)}"
            )
        return by_word[_word(text)]

    return convert


def _angle(knob: Knob) -> Callable[[str], float]:
    """Return a converter from degrees to radians that names bounds in degrees."""
    low, high = math.degrees(knob.low), math.degrees(knob.high)

    def convert(text: str) -> float:
        degrees = float(text)
        if not low <= degrees <= high:
            raise argparse.ArgumentTypeError(
                f"{text} is not from {low:g} to {high:g} degrees"
            )
        return math.radians(degrees)

    convert.__name__ = "angle"  # argparse: "invalid angle value"
    return convert
