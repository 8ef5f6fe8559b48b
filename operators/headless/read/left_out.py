"""What of a file is left out, so that somebody says so: faces, layers, curves."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import bpy

from ...bridge.refusals import CONVERTIBLE
from ..current_file import objects_in_view_layers, some_of
from ..files.headers import read_header
from ..formats import READ_ENDINGS
from .off_files import n_faces_of_off
from .usd_meshes import at_start, meshes_of_usd

_USD_ENDINGS = tuple(each for each in READ_ENDINGS if each.startswith(".usd"))
# A line break is found sooner than the beginning of a line.
_OBJ_FACE = re.compile(rb"\n[ \t]*f[ \t]")


def faces_note(path: Path) -> str | None:
    """Return a sentence about faces that the import of a file has left out.

    None without, and for a format that does not state how many faces there are.
    """
    n_faces = _n_faces_in(path)
    n_left_out = n_faces - sum(len(mesh.polygons) for mesh in bpy.data.meshes)
    if n_left_out <= 0:
        return None
    return (
        f"{n_left_out:,} of {n_faces:,} faces were left out: they have fewer than three"
        " different corners, or those of another face."
    )


def _n_faces_in(path: Path) -> int:
    """Return how many faces an .obj, .ply or .off file has, 0 for others."""
    ending = path.suffix.lower()
    if ending == ".off":
        return n_faces_of_off(path)
    if ending == ".obj":
        return len(_OBJ_FACE.findall(b"\n" + path.read_bytes()))
    header = read_header(path.read_bytes()) if ending == ".ply" else None
    elements = header.elements if header else ()
    return sum(each.n_rows for each in elements if each.name == "face")


def layers_note(refers_to: Sequence[Path]) -> str | None:
    """Return a sentence about layers of USD that are missing; None if none is."""
    layers = [each for each in refers_to if each.suffix.lower() in _USD_ENDINGS]
    missing = [layer.name for layer in layers if not layer.exists()]
    if not missing:
        return None
    return (
        "What is in layers that are missing was left out; put them where the file"
        f" refers to them: {', '.join(missing)}."
    )


def usd_notes(path: Path) -> Iterator[str]:
    """Yield sentences about meshes and holes of USD that the import did not heed."""
    left_out, holed = [], []
    is_usd = path.suffix.lower() in _USD_ENDINGS
    for mesh in meshes_of_usd(path) if is_usd else ():
        name = mesh.GetPrim().GetName()
        is_seen = mesh.ComputeVisibility() != "invisible"
        if not is_seen or mesh.ComputePurpose() in ("guide", "proxy"):
            left_out.append(name)
        elif at_start(mesh.GetHoleIndicesAttr()):
            holed.append(name)
    if left_out:
        yield (
            "Meshes that are invisible, or guides or proxies, as hulls in USD are, were"
            f" left out: {some_of(sorted(left_out))}."
        )
    if holed:
        yield (
            "Faces that USD marks as holes were read as others; delete them first:"
            f" {some_of(sorted(holed))}."
        )


def convertible_note() -> str | None:
    """Return a sentence about curves, texts and their like with faces; None without.

    Paths and outlines are not seen, and what shapes other curves is there for these.
    """
    helpers = {
        each
        for curve in bpy.data.curves
        for each in (curve.bevel_object, curve.taper_object)
    }
    others = (obj for obj in objects_in_view_layers() if obj.type in CONVERTIBLE)
    number = sum(obj not in helpers and _has_faces(obj) for obj in others)
    if number == 0:
        return None
    which, what = f"{number:,} curves, texts or metaballs get", "them to meshes"
    if number == 1:
        which, what = "A curve, text or metaball gets", "it to a mesh"
    return (
        f"{which} neither parts nor hulls; convert {what} first"
        " (Object > Convert > Mesh)."
    )


def _has_faces(obj: bpy.types.Object) -> bool:
    """Return whether Blender shows faces of what is no mesh, or would if it were shown.

    What is hidden is not evaluated. Others may have no faces before, such as metaballs.
    """
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return any(_has_faces_now(each) for each in (obj, evaluated))


def _has_faces_now(obj: bpy.types.Object) -> bool:
    """Return whether an object, evaluated or not, has faces as a mesh."""
    mesh = obj.to_mesh()
    try:
        return bool(mesh and mesh.polygons)
    finally:
        obj.to_mesh_clear()
