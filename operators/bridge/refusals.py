"""Why an operator cannot work on an object: every "why not", each in one sentence.

Each function returns None if the object can be worked on. The sentences say what is
wrong and what to do about it. They have no full stop: whoever shows them adds one.
"""

from __future__ import annotations

from collections.abc import Container, Iterable
from typing import Any, TypeAlias

from .hulls.listed import is_hull, owners_of_hulls
from .hulls.lost_hulls import has_more
from .mesh.points import count_points, is_cloud
from .mesh.seams import has_marked_seams
from .stored.names import LAYERS, LONGEST_NAME
from .stored.notes import or_not_ours
from .stored.record import is_rough, noted_parameters, record_of
from .stored.restore import has_parts, read_restore

# An object of Blender, or None if there is no active one.
Candidate: TypeAlias = Any

# Types of objects that Blender makes meshes of.
CONVERTIBLE = {"CURVE", "SURFACE", "META", "FONT"}
# Types of objects that are read and written as they are.
WORKED_ON = {"MESH", "POINTCLOUD"}

LEAVE_EDIT_MODE = "Edit Mode could not undo this; switch to Object Mode"
_ENTER_EDIT_MODE = "Faces are selected in Edit Mode; switch the mode"


def unless(fits: object, reason: str) -> str | None:
    """Return a reason, None if an object fits."""
    return None if fits else reason


def refusal(obj: Candidate, writes_mesh: bool = True) -> str | None:
    """Return why an object cannot be worked on at all."""
    if obj is None:
        return "There is no active object; select a mesh"
    if obj.type in CONVERTIBLE:
        return (
            f"{obj.name} is not a mesh; Decompose makes one beside it, or convert it"
            " (Object > Convert > Mesh)"
        )
    if obj.type not in WORKED_ON:
        return f"{obj.name} is not a mesh; select a mesh or a point cloud"
    reason = library_refusal(obj, writes_mesh)
    if reason:
        return reason
    if obj.mode not in {"OBJECT", "EDIT"}:
        return "Parts are made in Object or Edit Mode; switch the mode"
    if obj.mode == "EDIT" and is_cloud(obj):
        return (
            "Parts of points are made in Object Mode; leave Edit Mode"
            if count_points(obj) or obj.type == "POINTCLOUD"
            else f"{obj.name} has no faces yet; add some and leave Edit Mode"
        )
    if obj.mode != "EDIT" and obj.type == "MESH" and obj.data.is_editmode:
        return (
            f"The mesh of {obj.name} is edited on another object; leave Edit Mode there"
        )
    return None


def library_refusal(obj: Candidate, writes_mesh: bool = True) -> str | None:
    """Return why an object, or its mesh, cannot be changed."""
    changed = (obj, obj.data) if writes_mesh else (obj,)
    what = obj.name
    if not all(each.is_editable for each in changed):
        reason = "is linked from a library and cannot be changed"
        if obj.is_editable:
            what = f"The {'point cloud' if is_cloud(obj) else 'mesh'} of {what}"
    elif writes_mesh and any(each.override_library for each in changed):
        reason = "is an override of a library, which cannot keep parts"
    else:
        return None
    return f"{what} {reason}; make it local first (Object > Relations > Make Local)"


def measure_refusal(obj: Candidate) -> str | None:
    """Return why an object cannot be measured: its mesh is read, and not written."""
    return refusal(obj, writes_mesh=False)


def decompose_refusal(obj: Candidate) -> str | None:
    """Return why an object, or a mesh made of it, cannot be decomposed."""
    if obj is None or obj.type not in CONVERTIBLE:
        return refusal(obj) or _own_hull_refusal(obj)
    return library_refusal(obj, writes_mesh=False) or unless(
        obj.mode == "OBJECT",
        f"{obj.name} is decomposed in Object Mode; leave Edit Mode",
    )


def _own_hull_refusal(obj: Candidate) -> str | None:
    """Return why nothing is made for a hull, unless the user joined something to it."""
    if is_hull(obj) and not has_more(obj):
        return f"{obj.name} is a hull of {obj.parent.name}; select that"
    return None


def recut_refusal(obj: Candidate) -> str | None:
    """Return why the parts of an object cannot be replaced by others."""
    return refusal(obj) or unless(
        noted_parameters(obj), f"{obj.name} has no parts to replace; press Decompose"
    )


def selection_refusal(obj: Candidate) -> str | None:
    """Return why the selected faces of an object cannot be measured."""
    return measure_refusal(obj) or unless(obj.mode == "EDIT", _ENTER_EDIT_MODE)


# The parts of an object, to be used.


def decomposed_refusal(obj: Candidate) -> str | None:
    """Return why the parts of an object cannot be used."""
    return refusal(obj) or unless(
        has_parts(obj), f"{obj.name} has no parts; press Decompose first"
    )


def rough_refusal(obj: Candidate) -> str | None:
    """Return why parts cannot be used yet: `refine` will replace them."""
    if is_rough(obj):
        return f"The seams of {obj.name} are still being cut; wait a moment"
    return None


def picture_refusal(obj: Candidate) -> str | None:
    """Return why no picture of an object's parts can be made."""
    return decomposed_refusal(obj) or unless(obj.mode == "OBJECT", LEAVE_EDIT_MODE)


def parts_refusal(obj: Candidate) -> str | None:
    """Return why parts that consist of faces cannot be used."""
    return decomposed_refusal(obj) or unless(
        not is_cloud(obj), f"{obj.name} has no faces; give it a surface first"
    )


def object_mode_refusal(obj: Candidate) -> str | None:
    """Return why parts cannot be used for what undo in Edit Mode cannot take back."""
    return parts_refusal(obj) or unless(obj.mode == "OBJECT", LEAVE_EDIT_MODE)


# The parts of an object, to be edited by hand.


@or_not_ours
def edit_refusal(obj: Candidate) -> str | None:
    """Return why the parts of an object cannot be edited."""
    return refusal(obj) or unless(
        read_restore(obj.data) and record_of(obj).get("parts") and obj.wcd_parts,
        f"{obj.name} has no parts yet; press Decompose first",
    )


def merge_refusal(obj: Candidate, n_chosen: int) -> str | None:
    """Return why the chosen parts of an object cannot be merged."""
    return edit_refusal(obj) or unless(
        n_chosen >= 2, "Tick two or more parts in the list to merge them"
    )


def name_refusal(name: str, part: str, taken: Iterable[str]) -> str | None:
    """Return why a part cannot have a new name beside others that are taken."""
    if not name:
        return f"A part needs a name; this one is still {part}"
    if len(name.encode()) > LONGEST_NAME:
        return (
            f"A name has at most {LONGEST_NAME} letters, fewer with accents or of"
            f" other scripts; this part is still {part}"
        )
    if name in taken:
        return f"Another part is called {name}; this one is still {part}"
    if name in LAYERS:  # Blender drops attributes that have the name of a group
        return f"{name} is an attribute of the parts; this one is still {part}"
    return None


def faces_refusal(obj: Candidate) -> str | None:
    """Return why the faces of parts cannot be selected."""
    return edit_refusal(obj) or unless(
        not is_cloud(obj), f"{obj.name} has no faces, only points"
    )


def seams_refusal(obj: Candidate) -> str | None:
    """Return why there are no seams of ours to take back."""
    return faces_refusal(obj) or unless(
        has_marked_seams(obj.data), "No seams were marked here; press Mark first"
    )


def assign_refusal(obj: Candidate) -> str | None:
    """Return why selected faces cannot be given to a part."""
    return faces_refusal(obj) or unless(obj.mode == "EDIT", _ENTER_EDIT_MODE)


# Hulls.


def hull_refusal(obj: Candidate) -> str | None:
    """Return why hulls cannot be found for an object."""
    is_mesh = obj is not None and obj.type == "MESH" and not is_cloud(obj)
    if is_mesh and obj.mode != "OBJECT":
        return "Hulls are objects, which are made in Object Mode only; switch the mode"
    reason = refusal(obj, writes_mesh=False) or _own_hull_refusal(obj)
    if reason is None and is_cloud(obj):
        return f"Hulls need faces, and {obj.name} has none; give it a surface first"
    return reason


def build_hulls_refusal(obj: Candidate) -> str | None:
    """Return why an object cannot have hulls, which are its children."""
    return hull_refusal(obj) or unless(
        obj.instance_type not in {"VERTS", "FACES"},
        f"{obj.name} shows its children at its vertices or faces, and hulls are"
        " children; set Instancing to None first (Object properties)",
    )


def no_hulls_refusal(
    obj: Candidate, owners: Container[Candidate] | None = None
) -> str | None:
    """Return why the hulls of an object cannot be used; only `owners` have hulls."""
    return hull_refusal(obj) or unless(
        obj in (owners_of_hulls() if owners is None else owners),
        f"{obj.name} has no hulls; build them first",
    )
