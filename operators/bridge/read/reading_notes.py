"""What the user is told about what was read of an object."""

from __future__ import annotations

import bpy
import numpy as np

from ..stored.long_names import carrier_name
from .carrier import is_waiting
from .shown_mesh import shown_modifiers, shows_keys

# How the window names the choice to read what is seen.
WHAT_IS_SEEN = "Mesh: Evaluated"
# Steps that are a larger share of the longest side change a shape.
_COARSE = 1e-3


def reading_notes(
    obj: bpy.types.Object, for_parts: bool = True, has_choice: bool = False
) -> tuple[str, ...]:
    """Return sentences to the user about what was read of an object.

    Parameters
    ----------
    obj : bpy.types.Object
    for_parts : bool, optional
        Whether it was read to write parts to it, which objects may share.
    has_choice : bool, optional
        Whether what is seen of the object could have been read in place of its mesh.
    """
    if is_waiting(obj):
        curve = obj.parent.name
        return (
            "Parts are on faces: they are on the new mesh object"
            f' "{carrier_name(curve)}", and {curve} is hidden.',
        )
    notes = []
    modifiers = [modifier.name for modifier in shown_modifiers(obj)]
    if modifiers:
        names = ", ".join(modifiers)
        notes.append(f"The mesh was read without its modifiers ({names}).")
    # A note of its own: panels show equal ones once. Point clouds have no such choice.
    if modifiers and has_choice and obj.type == "MESH":
        notes.append(f"To include modifiers, apply them, or choose {WHAT_IS_SEEN}.")
    if shows_keys(obj):
        notes.append("The mesh was read in its Basis shape, without shape keys.")
    step = _coarse_step(obj)
    if step:
        notes.append(
            "Its coordinates are so large that Blender rounds them to steps of"
            f" {step:.2g}; move the model to the origin in the program it comes from."
        )
    if for_parts and obj.data.users > 1:  # else not counted: files have thousands
        scenes = bpy.data.scenes
        shown = {other for scene in scenes for other in scene.objects}
        n_sharers = sum(other.data == obj.data for other in shown)
        if n_sharers > 1:
            notes.append(
                f"{n_sharers} objects share this mesh: the parts show on all of them."
            )
    return tuple(notes)


def _coarse_step(obj: bpy.types.Object) -> float | None:
    """Return to which steps single precision rounds coordinates, None if small ones."""
    corners = np.array(obj.bound_box, dtype=np.float32)
    with np.errstate(invalid="ignore"):  # refused later
        step = np.spacing(np.abs(corners).max())
        side = np.ptp(corners, axis=0).max()
    return float(step) if step > _COARSE * side > 0.0 else None
