"""The file that hulls are asked for in, and the options that change nothing."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

from ....core.errors import DecompositionError
from ....core.parameters.parameter import info_of
from ..formats import HULL_FORMATS, SIMULATOR_ENDINGS, USUAL_UP
from .option_names import SETTINGS, option, word
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


def useless_options(
    given: Mapping[str, Any],
    inputs: Sequence[Path],
    targets: Targets,
    settings: Sequence[Any],
) -> tuple[str, ...]:
    """Return a sentence for each kind of options that change nothing.

    Parameters
    ----------
    given : mapping
        The value of each option, by name; settings only if the user gives them.
    inputs : sequence of Path
    targets : Targets
        Those of any input.
    settings : sequence
        All settings, one of each kind of `SETTINGS`.
    """
    values = {name: value for kind in settings for name, value in vars(kind).items()}
    of_parts, of_hulls, of_bodies = (
        [each.name for each in fields(kind) if each.name in given] for kind in SETTINGS
    )
    of_parts += ["preset"] if "preset" in given else []
    # Hulls use the seed, too.
    of_parts_alone = [name for name in of_parts if name != "seed"]
    of_hulls += ["processes"] if "processes" in given else []
    of_axes = ["up"] if given["up"] else []
    hulls_alone = not targets.show_parts and values["pieces"] != "PARTS"
    no_hulls = targets.hulls is None and not given["with_hulls"]
    no_axes = not any(
        file and file.suffix.lower() in USUAL_UP
        for file in (*inputs, targets.output, targets.hulls)
    )
    rules = (
        (hulls_alone, of_parts_alone, "for hulls without --pieces parts"),
        (no_hulls, of_hulls, "without --hulls or --with-hulls"),
        (
            not _is_for_simulators(targets.hulls),
            of_bodies,
            "without --hulls FILE.urdf or FILE.xml",
        ),
        (no_axes, of_axes, f"without a file in {' '.join(USUAL_UP)}"),
    )
    useless = [(names, without) for is_so, names, without in rules if is_so and names]
    named = {name for names, _ in useless for name in names}
    if values["pieces"] == "PARTS" and ".blend" in (i.suffix.lower() for i in inputs):
        named.add("max_vertices")  # parts there may have shapes of their own
    useless += _without_another(given.keys() - named, values)
    return tuple(f"{_options(names)} {without}." for names, without in useless)


def _without_another(
    given: Collection[str], values: Mapping[str, Any]
) -> list[tuple[list[str], str]]:
    """Return the settings given that need another value of a setting; and that."""
    found: dict[str, list[str]] = {}
    for each in (each for kind in SETTINGS for each in fields(kind)):
        needed = info_of(each).used_with
        if needed and each.name in given and values[needed[0]] != needed[1]:
            needs = f"without {option(needed[0])} {word(str(needed[1]))}"
            found.setdefault(needs, []).append(each.name)
    return [(names, needs) for needs, names in found.items()]


def _is_for_simulators(hulls: Path | None) -> bool:
    """Return whether hulls go to a file that simulators read."""
    return hulls is not None and hulls.suffix.lower() in SIMULATOR_ENDINGS


def _options(names: Iterable[str]) -> str:
    """Return the beginning of a sentence: these options change nothing."""
    options = [option(name) for name in names]
    return f"{', '.join(options)} {'change' if len(options) > 1 else 'changes'} nothing"
