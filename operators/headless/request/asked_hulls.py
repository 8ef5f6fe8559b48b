"""The file that hulls are asked for in, and the options that only hulls use."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ....core.errors import DecompositionError
from ..formats import HULL_FORMATS, SIMULATOR_ENDINGS
from .outputs import STANDARD_STREAM


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


def useless_options(
    of_hulls: Mapping[str, Any],
    of_bodies: Mapping[str, Any],
    hulls: str | None,
    within: bool,
) -> tuple[str, ...]:
    """Return a sentence for each kind of options that change nothing.

    Parameters
    ----------
    of_hulls, of_bodies : mapping
        The settings of hulls, and of bodies, that the user gives, by name.
    hulls : str or None
        The file for hulls.
    within : bool
        Whether hulls belong into the model's file.
    """
    found = []
    if of_hulls and hulls is None and not within:
        found.append(f"{_options(of_hulls)} without --hulls or --with-hulls.")
    if of_bodies and not (hulls or "").lower().endswith(SIMULATOR_ENDINGS):
        found.append(f"{_options(of_bodies)} without --hulls FILE.urdf or FILE.xml.")
    if "template" in of_hulls and of_hulls.get("naming") != "TEMPLATE":
        found.append(f"{_options(['template'])} without --naming template.")
    return tuple(found)


def _options(names: Iterable[str]) -> str:
    """Return the beginning of a sentence: these options change nothing."""
    options = ["--" + name.replace("_", "-") for name in names]
    return f"{', '.join(options)} {'change' if len(options) > 1 else 'changes'} nothing"
