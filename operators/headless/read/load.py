"""Loads a file of any format into an empty scene."""

from __future__ import annotations

import re
from pathlib import Path

import bpy

from ....core.errors import DecompositionError
from ...bridge.mesh.points import is_cloud
from ..atomic import explaining
from ..current_file import mesh_objects, open_empty_file
from ..formats import USUAL_UP
from ..quiet import quiet_blender
from .damage_checks import check_file
from .finite_checks import check_finite
from .importers import IMPORTERS
from .known_hulls import adopt_hulls


def load(path: Path, up: str | None = None) -> list[bpy.types.Object]:
    """Load `path` into an empty scene and return its mesh objects, by name.

    Parameters
    ----------
    path : Path
        File with one of `READ_ENDINGS`.
    up : {'Y', 'Z'}, optional
        Axis that points up in the file, for formats that do not state it; None for
        the usual one.

    Raises
    ------
    DecompositionError
        If the file cannot be read, or has neither faces nor points.
    """
    with explaining(path, "read"):
        check_file(path)
        check_finite(path)
    ending = path.suffix.lower()
    open_empty_file()
    try:
        with quiet_blender():
            result = IMPORTERS[ending](path, up or USUAL_UP.get(ending, "Z"))
    except RuntimeError as error:  # every error of bpy.ops is one
        raise _unreadable(path, str(error)) from error
    if result != {"FINISHED"}:
        raise _unreadable(path, "the importer gave up")
    adopt_hulls()
    objects = mesh_objects()
    if not objects:
        raise DecompositionError(f"{path.name} has no meshes or point clouds.")
    if not any(is_cloud(obj) or obj.data.polygons for obj in objects):
        raise DecompositionError(
            f"{path.name} has edges but no faces; wires cannot be decomposed."
        )
    return objects


def _unreadable(path: Path, message: str) -> DecompositionError:
    """Return the error for a failed import, with the importer's reason."""
    lines = [line.strip() for line in message.splitlines() if line.strip()]
    # Tracebacks of importers in Python end with the place that called bpy.ops.
    lines = [line for line in lines if not line.startswith("Location:")]
    reason = lines[-1].removeprefix("Error: ").rstrip(".") if lines else "no reason"
    if path.name in reason:  # the reason itself follows the path
        reason = reason.rpartition(": ")[2].strip("'")
        reason = re.sub(rf"\S*{re.escape(path.name)}", f'"{path.name}', reason)
    return DecompositionError(
        f"{path.name} cannot be read as {path.suffix.lower()}: it is incomplete,"
        f" damaged or of another kind ({reason})."
    )
