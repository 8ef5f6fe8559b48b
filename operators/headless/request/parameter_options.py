"""One option for each parameter of the method and of hulls."""

from __future__ import annotations

import argparse
import math
import textwrap
from collections.abc import Callable
from typing import Any

from ....core.parameters.parameter import ParameterInfo
from .option_names import option


class HelpFormatter(argparse.RawDescriptionHelpFormatter):
    """Puts each choice of an option on a line of its own."""

    def _split_lines(self, text: str, width: int) -> list[str]:
        """Wrap the first line of a help text, and the indented lines after it."""
        first, *choices = text.splitlines()
        lines = textwrap.wrap(first, width)
        for choice in choices:
            lines += textwrap.wrap(
                choice, width, initial_indent="  ", subsequent_indent="    "
            )
        return lines


def add_option(
    group: argparse._ArgumentGroup, name: str, info: ParameterInfo, default: Any
) -> None:
    """Add the option of a parameter.

    The parsed arguments have the parameter only if the user gives the option.

    Parameters
    ----------
    group : argument group
    name : str
        Name of the parameter; the option has hyphens for underscores.
    info : ParameterInfo
    default : str, int or float
        In radians for angles; the option takes degrees.
    """
    convert: Callable[[str], Any]
    if info.choices:
        convert = _choice(info)
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
        option(name),
        type=convert,
        default=argparse.SUPPRESS,
        metavar=metavar,
        help=_help(info, shown).replace("%", "%%"),  # argparse formats with %
    )


def _help(info: ParameterInfo, default: str) -> str:
    """Return the help of a parameter, and a line for each choice."""
    choices = [
        f"{_word(c.identifier)}: {c.help[0].lower()}{c.help[1:]}" for c in info.choices
    ]
    return "\n".join([f"{info.help} (default: {default})", *choices])


def _word(identifier: str) -> str:
    """Return an identifier such as ALL_PAIRS as the user types it: all-pairs."""
    return identifier.lower().replace("_", "-")


def _choice(info: ParameterInfo) -> Callable[[str], str]:
    """Return a converter of words to identifiers; upper and lower case are the same."""
    by_word = {_word(choice.identifier): choice.identifier for choice in info.choices}

    def convert(text: str) -> str:
        if _word(text) not in by_word:
            raise argparse.ArgumentTypeError(
                f"{text!r} is not one of {', '.join(by_word)}"
            )
        return by_word[_word(text)]

    return convert


def _angle(info: ParameterInfo) -> Callable[[str], float]:
    """Return a converter of degrees to radians; its errors are in degrees, too."""
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
