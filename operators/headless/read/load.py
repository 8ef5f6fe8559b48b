"""Loads a file of any format into an empty scene."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import bpy

from ....core.errors import DecompositionError
from ..current_file import has_shape, mesh_objects, open_empty_file
from ..files.replacing import explaining, last_reason
from ..formats import up_in
from ..quiet import quiet_blender
from .damage_checks import check_file
from .evaluated import apply_modifiers
from .finite_checks import check_finite
from .importers import IMPORTERS
from .instances import check_libraries, make_all_local, realize_instances
from .known_hulls import adopt_hulls, hull_note
from .left_out import convertible_note, faces_note, layers_note, usd_notes
from .referred import referred_files


@dataclass(frozen=True)
class LoadedFile:
    """What a file holds.

    Attributes
    ----------
    objects : list of Object
        Its meshes and point clouds, by name.
    notes : dict of str
        What was done to an object so that it could be read, by its name.
    about : tuple of str
        What is said of the file as a whole: which objects in it are no models.
    refers_to : tuple of Path
        The files that it refers to, such as libraries and materials.
    """

    objects: list[bpy.types.Object]
    notes: dict[str, str]
    about: tuple[str, ...] = ()
    refers_to: tuple[Path, ...] = ()

    def notes_of(self, obj: bpy.types.Object) -> tuple[str, ...]:
        """Return what was done to an object so that it could be read, if anything."""
        return (self.notes[obj.name_full],) if obj.name_full in self.notes else ()


def load_file(path: Path, up: str | None, with_modifiers: bool) -> LoadedFile:
    """Load `path` into an empty scene; instances become objects, links local.

    Parameters
    ----------
    path : Path
        File with one of `READ_ENDINGS`.
    up : {'Y', 'Z'} or None
        Axis that points up in the file, for formats that do not state it; None for
        the usual one.
    with_modifiers : bool
        Apply the modifiers and shape keys of all objects.

    Raises
    ------
    DecompositionError
        If the file cannot be read, or has neither faces nor points.
    """
    with explaining(path, "read"):
        check_file(path)
    ending = path.suffix.lower()
    open_empty_file()
    try:
        with quiet_blender():
            result = IMPORTERS[ending](path, up_in(ending, up))
    except RuntimeError as error:  # every error of bpy.ops is one
        raise _unreadable(path, str(error)) from error
    if result != {"FINISHED"}:
        raise _unreadable(path, "the importer gave up")
    check_libraries(path)
    with explaining(path, "read"):
        check_finite(path)
        refers_to = referred_files(path)
    with quiet_blender():
        adopt_hulls()
        make_all_local()
        notes = realize_instances(with_modifiers)
        if with_modifiers:
            notes |= apply_modifiers(mesh_objects())
    said = (layers_note(refers_to), *usd_notes(path), convertible_note())
    others = tuple(filter(None, said))
    about = (*filter(None, (faces_note(path), hull_note())), *others)
    return LoadedFile(_objects_with_shape(path, others), notes, about, refers_to)


def _objects_with_shape(path: Path, others: Sequence[str]) -> list[bpy.types.Object]:
    """Return the objects of the file, or raise if none has faces or points.

    The error for a file without meshes ends with notes on what it has.
    """
    objects, more = mesh_objects(), " ".join(("", *others))
    if not objects:
        raise DecompositionError(f"{path} has no meshes or point clouds.{more}")
    if not any(map(has_shape, objects)):
        has_edges = any(getattr(obj.data, "edges", None) for obj in objects)
        raise DecompositionError(
            f"{path} has edges but no faces; wires cannot be decomposed."
            if has_edges
            else f"{path} has objects, but no faces or points in them.{more}"
        )
    return objects


def _unreadable(path: Path, message: str) -> DecompositionError:
    """Return the error for a failed import, with the importer's reason."""
    reason = last_reason(message).removesuffix(", see console for detail")
    if path.name in reason:  # the reason itself follows the path
        whole = "|".join(re.escape(str(each)) for each in (path.absolute(), path))
        named = rf"""(["']?)(?:{whole}|\S*{re.escape(path.name)})\1"""
        reason = re.sub(named, lambda _: f'"{path.name}"', reason)
        reason = reason.rpartition(": ")[2]
    ending = path.suffix.lower()
    or_else = ", or has faces of more than 255 corners" if ending == ".ply" else ""
    return DecompositionError(
        f"{path} cannot be read as {ending}: it is incomplete, damaged or of"
        f" another kind{or_else} ({reason})."
    )
