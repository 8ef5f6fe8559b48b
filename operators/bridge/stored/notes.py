"""Notes in the user's file: JSON in custom properties."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import fields
from functools import cache, wraps
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

import bpy

from ....core.errors import DecompositionError
from ....core.parameters.hulls import HullParameters
from ....core.parameters.parts import Parameters

T = TypeVar("T", Parameters, HullParameters)
Given = ParamSpec("Given")

_MANIFEST = Path(__file__).parents[3] / "blender_manifest.toml"


@cache
def version() -> str:
    """Return the version of the extension."""
    manifest = tomllib.loads(_MANIFEST.read_text(encoding="utf-8"))
    return str(manifest["version"])


def parse_json(noted: object) -> dict[str, Any] | None:
    """Return the JSON object that a custom property holds, None if it holds none."""
    try:
        found = json.loads(noted) if isinstance(noted, str) else None
    except ValueError:
        return None
    return found if isinstance(found, dict) else None


def read_note(
    owner: bpy.types.ID,
    key: str,
    parse: Callable[[str], dict[str, Any] | None] = parse_json,
) -> dict[str, Any]:
    """Return one of our notes, empty if there is none; raise if it is not ours."""
    if key not in owner:
        return {}
    noted = parse(owner[key])
    if noted is None:
        raise not_ours(owner, key)
    return noted


def write_note(owner: bpy.types.ID, key: str, noted: dict[str, Any]) -> None:
    """Write one of our notes; an empty one removes it."""
    if noted:
        owner[key] = json.dumps(noted)
    elif key in owner:
        del owner[key]


def parameters_in(noted: Mapping[str, Any], kind: type[T]) -> T:
    """Return noted parameters; other versions of the extension have others."""
    known = {each.name for each in fields(kind)}
    return kind(**{name: noted[name] for name in known & noted.keys()})


def not_ours(owner: bpy.types.ID, key: str) -> DecompositionError:
    """Return the error for a property of the user's that has one of our names."""
    return DecompositionError(
        f"{owner.name} has a custom property {key} that this add-on did not write;"
        " rename or delete it."
    )


def or_not_ours(refusal: Callable[Given, str | None]) -> Callable[Given, str | None]:
    """Let a function that returns why not do so for notes that are not ours, too.

    Buttons and panels ask it all the time, and must not fail.
    """

    @wraps(refusal)
    def told(*args: Given.args, **kwargs: Given.kwargs) -> str | None:
        try:
            return refusal(*args, **kwargs)
        except DecompositionError as error:
            return str(error).removesuffix(".")

    return told
