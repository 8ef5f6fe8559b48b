"""The file that hulls are asked for in, and the options that only hulls use."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from ....core.errors import DecompositionError
from ..formats import HULL_FORMATS, SIMULATOR_ENDINGS
from .option_names import SETTINGS, option
from .outputs import STANDARD_STREAM, Targets


def hull_file(hulls: str | None, hulls_format: str | None) -> str | None:
    """Return the file for hulls, with the ending of --hulls-format added."""
    if hulls == str(STANDARD_STREAM):
        raise DecompositionError(
            "Hulls cannot be written to standard output; name a file."
        )
    if hulls_format is None:
        return hulls
    if hulls is None:
        raise DecompositionError("--hulls-format needs --hulls, which names the file.")
    ending = HULL_FORMATS[hulls_format]
    return hulls if hulls.lower().endswith(ending) else hulls + ending


def useless_options(given: Mapping[str, Any], targets: Targets) -> tuple[str, ...]:
    """Return a sentence for each kind of options that change nothing.

    Parameters
    ----------
    given : mapping
        The value of each option, by name; settings only if the user gives them.
    targets : Targets
        Those of any input.
    """
    found = []
    of_parts, of_hulls, of_bodies = (
        [each.name for each in fields(kind) if each.name in given] for kind in SETTINGS
    )
    if "preset" in given:
        of_parts.append("preset")
    if "seed" in of_parts:  # hulls use it, too
        of_parts.remove("seed")
    by_error = given.get("pieces") != "PARTS"
    if of_parts and by_error and not targets.show_parts:
        found.append(f"{_options(of_parts)} for hulls without --pieces parts.")
    if of_hulls and targets.hulls is None and not given["with_hulls"]:
        found.append(f"{_options(of_hulls)} without --hulls or --with-hulls.")
    if of_bodies and not _is_for_simulators(targets.hulls):
        found.append(f"{_options(of_bodies)} without --hulls FILE.urdf or FILE.xml.")
    if "template" in of_hulls and given.get("naming") != "TEMPLATE":
        found.append(f"{_options(['template'])} without --naming template.")
    return tuple(found)


def _is_for_simulators(hulls: Path | None) -> bool:
    """Return whether hulls go to a file that simulators read."""
    return hulls is not None and hulls.suffix.lower() in SIMULATOR_ENDINGS


def _options(names: Iterable[str]) -> str:
    """Return the beginning of a sentence: these options change nothing."""
    options = [option(name) for name in names]
    return f"{', '.join(options)} {'change' if len(options) > 1 else 'changes'} nothing"
