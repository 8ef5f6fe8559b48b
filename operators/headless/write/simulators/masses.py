"""What bodies weigh: from the solids of their objects, else from the hulls."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import bpy
import numpy as np

from ..... import core
from .....core.geometry.mesh import TriangleMesh
from .....core.solids.mass_properties import MassProperties, combined_mass
from .....core.steps.arrays import FloatArray
from ...current_file import some_of
from ..placed_meshes import matrix_of, placed

# MuJoCo refuses less, in kilograms, and in kilograms times squared meters.
_LEAST = 1e-15
# Hulls weigh more than what they are around, but for rounding and round shapes.
_HEAVIER = 1.1


def mass_of_objects(
    owned: Mapping[bpy.types.Object, Sequence[bpy.types.Object]],
    frame: FloatArray,
    density: float,
) -> tuple[MassProperties, list[str], list[str]]:
    """Return the mass properties of a body, and its objects that are no plain solids.

    Parameters
    ----------
    owned : mapping of Object to sequence of Object
        The hulls of each object.
    frame : (4, 4) float
        From the body's space to the world.
    density : float
        Mass of a cubed unit.

    Returns
    -------
    mass : MassProperties
        In the frame of the body.
    without_solid : list of str
        Names of the objects whose mass is that of their hulls.
    overlapping : list of str
        Names of the objects that weigh more than their hulls.
    """
    inverse = np.linalg.inv(frame)
    masses, without_solid, overlapping = [], [], []
    for obj, hulls in owned.items():
        mesh = TriangleMesh(*placed(obj, inverse @ matrix_of(obj)))
        mass = core.mass_of_mesh(mesh, density)
        of_hulls = []
        for hull in hulls:
            vertices, triangles, _ = placed(hull, inverse @ matrix_of(hull))
            of_hulls.append(core.mass_of_surface(vertices, triangles, density))
        solid_hulls = [each for each in of_hulls if each is not None]
        if mass is None:
            without_solid.append(obj.name)
            masses += solid_hulls
            continue
        masses.append(mass)
        if mass.mass > _HEAVIER * sum(each.mass for each in solid_hulls):
            overlapping.append(obj.name)
    none = MassProperties(0.0, np.zeros(3), np.zeros((3, 3)))  # of flat hulls
    return combined_mass(masses) if masses else none, without_solid, overlapping


def mass_notes(
    masses: Mapping[str, MassProperties],
    without_solid: Sequence[str],
    overlapping: Sequence[str],
) -> tuple[str, ...]:
    """Return sentences to the user about the masses of bodies, by name."""
    notes = []
    if without_solid:
        notes.append(
            f"Mass and inertia are those of the hulls where the surface is not closed,"
            f" or encloses nothing: {some_of(without_solid)}."
        )
    if overlapping:
        notes.append(
            "Mass and inertia are more than those of the hulls; if shells overlap,"
            f" they count twice, so unite them first: {some_of(overlapping)}."
        )
    for name, mass in masses.items():
        if min(mass.mass, *np.linalg.eigvalsh(mass.inertia)) < _LEAST:
            notes.append(
                f"{name} weighs {mass.mass:.3g} kg, too little for simulators; raise"
                " Density or make the model larger."
            )
            break
    return tuple(notes)
