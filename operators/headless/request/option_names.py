"""Names of options, and what they are called in messages."""

from __future__ import annotations

import re
from dataclasses import fields
from functools import cache

from ....core.parameters.bodies import BodyParameters
from ....core.parameters.hulls import HullParameters
from ....core.parameters.parameter import info_of
from ....core.parameters.parts import Parameters
from ...bridge.read.reading_notes import WHAT_IS_SEEN

# The kinds of settings that have an option each.
SETTINGS = (Parameters, HullParameters, BodyParameters)
# What a sentence has up to the ending of its last file, whose path may have any words.
_PATH = re.compile(r".*\.[^\W\d]\w*", re.DOTALL)


def option(name: str) -> str:
    """Return the option of a setting: hyphens for underscores."""
    return "--" + name.replace("_", "-")


def word(identifier: str) -> str:
    """Return an identifier such as ALL_PAIRS as the user types it: all-pairs."""
    return identifier.lower().replace("_", "-")


def with_options(text: str) -> str:
    """Add the options of the settings that a message names as Blender's window does.

    Parameters
    ----------
    text : str
        Such as "Detail is 11; choose a value from 0 to 10."

    Returns
    -------
    str
        The same, and "(Detail is --alpha.)". Options that have the words of the label
        are plain, so they are left out.
    """
    without_paths = _PATH.sub("", text)
    named = [
        f"{label} is {flag}"
        for label, flag in _options_of_labels().items()
        if re.search(rf"(?<![\w/\\]){label}\b(?![/\\])", without_paths)
    ]
    return f"{text} ({', '.join(named)}.)" if named else text


@cache
def _options_of_labels() -> dict[str, str]:
    """Return the options that differ from the labels of their settings, by label."""
    pairs = [
        (info_of(each).label, option(each.name))
        for kind in SETTINGS
        for each in fields(kind)
    ]
    differing = {
        label: flag
        for label, flag in pairs
        if option(label.lower().replace(" ", "_")) != flag
    }
    return {**differing, WHAT_IS_SEEN: option("apply_modifiers")}
