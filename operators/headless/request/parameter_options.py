"""One option for each parameter of the method and of hulls."""

from __future__ import annotations

import argparse
import math
import textwrap
from collections.abc import Callable, Iterable
from contextlib import suppress
from typing import Any, TypeVar

from ....core.parameters.parameter import ParameterInfo
from .option_names import option, word

_Number = TypeVar("_Number", int, float)


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
        metavar = "{" + ",".join(word(c.identifier) for c in info.choices) + "}"
        shown = word(default)
    elif info.subtype == "ANGLE":
        convert, metavar = _angle(info), "DEGREES"
        shown = f"{math.degrees(default):g}"
    elif isinstance(default, str):
        convert, metavar, shown = str, "TEXT", default
    else:
        convert = _whole_number if isinstance(default, int) else _number
        metavar = "N" if isinstance(default, int) else "X"
        shown = f"{default:g}"
    group.add_argument(
        option(name),
        type=convert,
        default=argparse.SUPPRESS,
        metavar=metavar,
        help=_help(info, shown).replace("%", "%%"),  # argparse formats with %
    )


def with_negative_numbers(words: Iterable[str]) -> list[str]:
    """Join each option with the negative number after it, as in --margin=-1e-3.

    Before Python 3.14, argparse takes -1e-3 for an option.
    """
    found: list[str] = []
    for each in words:
        takes_value = found and found[-1][2:] and found[-1].startswith("--")
        if takes_value and "=" not in found[-1] and each.startswith("-"):
            with suppress(ValueError):
                float(each)
                found[-1] += f"={each}"
                continue
        found.append(each)
    return found


def _help(info: ParameterInfo, default: str) -> str:
    """Return the help of a parameter, and a line for each choice."""
    choices = [
        f"{word(c.identifier)}: {c.help[0].lower()}{c.help[1:]}" for c in info.choices
    ]
    return "\n".join([f"{info.help} (default: {default})", *choices])


def _whole_number(text: str) -> int:
    """Return the whole number in an option."""
    return _written_plainly(text, int, "a whole number")


def _number(text: str) -> float:
    """Return the number in an option."""
    return _written_plainly(text, float, "a number")


def _written_plainly(text: str, kind: type[_Number], meaning: str) -> _Number:
    """Return a number; Python alone would read 1_0, and digits of other scripts."""
    with suppress(ValueError):
        if text.isascii() and "_" not in text:
            return kind(text)
    raise argparse.ArgumentTypeError(f"{text!r} is not {meaning}")


def count(text: str) -> int:
    """Return the number of things in an option, of which there is at least one."""
    number = _whole_number(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text} is less than 1; choose 1 or more")
    return number


def _choice(info: ParameterInfo) -> Callable[[str], str]:
    """Return a converter of words to identifiers; upper and lower case are the same."""
    by_word = {word(choice.identifier): choice.identifier for choice in info.choices}

    def convert(text: str) -> str:
        if word(text) not in by_word:
            raise argparse.ArgumentTypeError(
                f"{text!r} is not one of {', '.join(by_word)}"
            )
        return by_word[word(text)]

    return convert


def _angle(info: ParameterInfo) -> Callable[[str], float]:
    """Return a converter of degrees to radians; its errors are in degrees, too."""
    low, high = math.degrees(info.low), math.degrees(info.high)

    def convert(text: str) -> float:
        degrees = _number(text)
        if not low <= degrees <= high:
            raise argparse.ArgumentTypeError(
                f"{text} is not from {low:g} to {high:g} degrees"
            )
        return math.radians(degrees)

    return convert
