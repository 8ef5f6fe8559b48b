"""The rigid bodies that hulls and their objects make: frames, shapes and masses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import bpy
import numpy as np

from .....core.geometry.frames import area_vectors
from .....core.parameters.bodies import BodyParameters
from .....core.solids.mass_properties import MassProperties
from .....core.steps.arrays import FloatArray, IntArray
from ....bridge.hulls.placed import Primitive, primitive_of
from ....bridge.mesh.attributes import read_ints
from ....bridge.parts.palette import UNPAINTED, srgb_of
from ..names import hulls_by_owner, legal_names, names_of_hulls
from ..obj_files import write_obj
from ..placed_meshes import matrix_of, placed
from .masses import mass_notes, mass_of_objects

# Simulators take a body of this name for the ground, which does not move.
GROUND = "world"


@dataclass(frozen=True, eq=False)
class Geometry:
    """A shape of a body: for collisions, or to look at.

    Attributes
    ----------
    name : str
    file : str
        The .obj file of the mesh; none is written for a primitive.
    vertices, triangles : (V, 3) float, (T, 3) int
        The mesh, in the frame of the body.
    primitive : Primitive or None
        None for a mesh.
    color : (4,) tuple of float or None
        Red, green, blue in sRGB, and opacity; None for collisions.
    """

    name: str
    file: str
    vertices: FloatArray
    triangles: IntArray
    primitive: Primitive | None = None
    color: tuple[float, ...] | None = None


@dataclass(frozen=True, eq=False)
class Body:
    """A rigid body.

    Attributes
    ----------
    name : str
    frame : (4, 4) float
        From the body's space to the world; a rotation and a shift.
    mass : MassProperties
        In the frame of the body.
    collisions, visuals : tuple of Geometry
    """

    name: str
    frame: FloatArray
    mass: MassProperties
    collisions: tuple[Geometry, ...]
    visuals: tuple[Geometry, ...]


def bodies_of(
    hulls: Sequence[bpy.types.Object], name: str, parameters: BodyParameters
) -> tuple[list[Body], tuple[str, ...]]:
    """Return the bodies of hulls and of the objects that the hulls belong to.

    Parameters
    ----------
    hulls : sequence of Object
        Children of their objects.
    name : str
        Name of the body if there is one for all.
    parameters : BodyParameters

    Returns
    -------
    bodies : list of Body
    notes : tuple of str
        Sentences to the user.
    """
    owned, titles = hulls_by_owner(hulls), _titles(hulls, parameters)
    each = parameters.bodies == "EACH"
    groups = [[obj] for obj in owned] if each else [list(owned)]
    names = list(titles.values()) if each else legal_names([name], "xml", [GROUND])
    of_hulls = dict(zip(hulls, names_of_hulls(hulls, "xml", titles), strict=True))
    bodies, opened, overlapping = [], [], []
    for group, title in zip(groups, names, strict=True):
        frame = _frame_of(group[0]) if each else np.eye(4)
        parts = {obj: owned[obj] for obj in group}
        mass, open_ones, heavier = mass_of_objects(parts, frame, parameters.density)
        opened += open_ones
        overlapping += heavier
        own = [hull for its in parts.values() for hull in its]
        collisions = [_collision(hull, of_hulls[hull], frame) for hull in own]
        visuals = [p for obj in group for p in _visuals(obj, titles[obj.name], frame)]
        bodies.append(Body(title, frame, mass, tuple(collisions), tuple(visuals)))
    weights = {body.name: body.mass for body in bodies}
    return _named(bodies), mass_notes(weights, opened, overlapping)


def names_of_collisions(
    hulls: Sequence[bpy.types.Object], parameters: BodyParameters
) -> list[str]:
    """Return the names of hulls in files for simulators; see `names_of_hulls`.

    If each object is a body, the name of the body is in those of its hulls.
    """
    return names_of_hulls(hulls, "xml", _titles(hulls, parameters))


def _titles(
    hulls: Sequence[bpy.types.Object], parameters: BodyParameters
) -> dict[str, str]:
    """Return the legal names of the objects that hulls belong to, by their names."""
    names = [obj.name for obj in hulls_by_owner(hulls)]
    reserved = [GROUND] if parameters.bodies == "EACH" else []
    return dict(zip(names, legal_names(names, "xml", reserved), strict=True))


def write_meshes(folder: Path, bodies: Sequence[Body]) -> None:
    """Write the meshes of bodies to a folder, each to its file."""
    for body in bodies:
        for geometry in (*body.collisions, *body.visuals):
            if geometry.primitive is None:
                faces = geometry.triangles.tolist()
                mesh = (geometry.name, geometry.vertices, faces)
                write_obj(folder / geometry.file, [mesh])


def _frame_of(obj: bpy.types.Object) -> FloatArray:
    """Return the place and rotation of an object, without its scale, (4, 4)."""
    place, turn, _ = obj.matrix_world.decompose()
    frame = np.eye(4)
    frame[:3, :3] = turn.to_matrix()
    frame[:3, 3] = place
    return frame


def _collision(hull: bpy.types.Object, name: str, frame: FloatArray) -> Geometry:
    """Return a hull in the frame of its body."""
    matrix = np.linalg.inv(frame) @ matrix_of(hull)
    vertices, triangles, _ = placed(hull, matrix)
    return Geometry(name, "", vertices, triangles, primitive_of(hull, matrix))


def _visuals(obj: bpy.types.Object, name: str, frame: FloatArray) -> list[Geometry]:
    """Return the mesh of an object in the frame of its body, a piece for each color.

    Simulators take one color for a mesh; MuJoCo reads no materials of .obj files.
    """
    vertices, triangles, faces = placed(obj, np.linalg.inv(frame) @ matrix_of(obj))
    slots = read_ints(obj.data.polygons, "material_index")[faces]
    seen = area_vectors(vertices[triangles]).any(axis=1)  # the others have no area
    materials = list(obj.data.materials) or [None]
    pieces = []
    for slot, material in enumerate(materials):
        chosen = triangles[seen & (np.minimum(slots, len(materials) - 1) == slot)]
        if len(chosen) == 0:
            continue
        used, corners = np.unique(chosen, return_inverse=True)
        mesh = _four_vertices(vertices[used], corners.reshape(-1, 3))
        title = f"{name} {material.name if material else 'surface'}"
        pieces.append(Geometry(title, "", *mesh, color=_color_of(material)))
    return pieces


def _four_vertices(
    vertices: FloatArray, triangles: IntArray
) -> tuple[FloatArray, IntArray]:
    """Return a mesh with four vertices at least, which is what MuJoCo takes."""
    if len(vertices) > 3:
        return vertices, triangles
    a, b, c = triangles[0]
    split = np.array([(a, b, 3), (b, c, 3), (c, a, 3)])
    return np.concatenate([vertices, vertices.mean(axis=0)[None]]), split


def _color_of(material: bpy.types.Material | None) -> tuple[float, ...]:
    """Return the color of a material in the viewport, as screens show it."""
    color = material.diffuse_color if material else UNPAINTED
    return (*srgb_of(color), color[3])


def _named(bodies: Sequence[Body]) -> list[Body]:
    """Return bodies whose shapes have files of their own, and legal distinct names.

    Those of hulls are legal already, and stay.
    """
    shapes = [shape for body in bodies for shape in body.collisions]
    seen = [shape for body in bodies for shape in body.visuals]
    names = legal_names([shape.name for shape in (*shapes, *seen)], "xml")
    files = [f"{number:03d}.obj" for number in range(1, len(shapes) + 1)]
    files += [f"visual_{number:03d}.obj" for number in range(1, len(seen) + 1)]
    final = {
        shape: replace(shape, name=name, file=file)
        for shape, name, file in zip((*shapes, *seen), names, files, strict=True)
    }
    return [
        replace(
            body,
            collisions=tuple(final[shape] for shape in body.collisions),
            visuals=tuple(final[shape] for shape in body.visuals),
        )
        for body in bodies
    ]
