"""Make objects of hulls, in a collection of their own, and remove them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import bpy
import numpy as np

from .... import core
from ....core.errors import DecompositionError
from ....core.geometry.frames import moved
from ....core.geometry.primitives import CollisionShape
from ....core.parameters.hulls import HullParameters
from ....core.results.hulls import HullDecomposition
from ..homes import hand_over, within_parent
from ..mesh.attributes import vertex_positions
from ..parts.materials import discard, hull_material, none_missing
from ..parts.read import FoundParts, find_parts_on, materials_of
from ..read.shape import stretch
from ..read.stretching import unstretched
from ..stored.names import CORNERS_TAG, HULL_TAG, MARGIN_TAG, PIECE_TAG
from ..stored.noted_hulls import write_hull_record
from .fitting_names import names_that_fit
from .hull_collections import collection_for, own_collection, remove_empty_collections
from .listed import hulls_of, is_hull
from .lost_hulls import has_more, leave_to_user, lost_hulls, noted_by
from .placed import moved_pose, pose_of
from .rigid_bodies import remove_simulation, soften


def write_hulls(
    obj: bpy.types.Object,
    found: HullDecomposition,
    parameters: HullParameters,
    meshes: Sequence[bpy.types.Mesh] | None = None,
    to_be_edited: bool = False,
) -> list[bpy.types.Object]:
    """Make objects of the hulls of an object, in place of earlier ones; return them.

    Parameters
    ----------
    obj : bpy.types.Object
    found : HullDecomposition
    parameters : HullParameters
    meshes : sequence of Mesh, optional
        Those of equal hulls around an object of the same scale, to be shared.
    to_be_edited : bool
        Whether hulls keep the piece that they are around, for other shapes.

    Raises
    ------
    DecompositionError
        If another object has a name that a hull needs, or a name cannot be given.
        Nothing is changed then.
    """
    kinds = [shape.kind for shape in found.shapes]
    names = names_that_fit(obj, parameters.naming, parameters.template, kinds)
    _check_free(names, obj, parameters)
    former = own_collection(obj)
    erase_hulls(obj, kept=former)
    collection = collection_for(obj, former)
    parts = find_parts_on(obj) if found.has_parts else None
    materials, scale = _materials(obj, found, parts), stretch(obj)
    hulls, noted = [], []
    each_hull = zip(names, found.shapes, materials, strict=True)
    for row, (name, shape, material) in enumerate(each_hull):
        mesh = meshes[row] if meshes else hull_mesh(name, shape, scale, material)
        hull = _hull_object(name, mesh, material)
        figures = figures_of_hull(found, row, parts)
        noted.append({"name": hull.name, **figures})
        tag_hull(hull, figures, shape, scale)
        if to_be_edited and shape.kind != "HULL":
            keep_piece(hull, unstretched(shape.hull.vertices, scale), has_margin=False)
        hull.parent = obj
        collection.objects.link(hull)
        hulls.append(hull)
    write_hull_record(obj, found, parameters, noted)
    return hulls


def tag_hull(
    hull: bpy.types.Object,
    figures: dict[str, Any],
    shape: CollisionShape,
    scale: np.ndarray,
) -> None:
    """Note on a hull its figures, and its pose in its own space."""
    pose = moved_pose(pose_of(shape, scale), _into(hull))
    hull[HULL_TAG] = json.dumps(figures | pose)


def keep_piece(hull: bpy.types.Object, points: np.ndarray, has_margin: bool) -> None:
    """Keep the points of the piece that a hull is around, (N, 3).

    They are in the space of its object, and kept in the hull's own.
    """
    hull[PIECE_TAG] = moved(points, _into(hull)).ravel().tolist()
    hull[CORNERS_TAG] = vertex_positions(hull.data).ravel().tolist()
    if has_margin:
        hull[MARGIN_TAG] = True


def _into(hull: bpy.types.Object) -> np.ndarray:
    """Return the matrix, (4, 4), from the space of a hull's object to its own."""
    return np.array(within_parent(hull).inverted_safe())


def erase_hulls(
    obj: bpy.types.Object,
    chosen: Sequence[bpy.types.Object] | None = None,
    kept: bpy.types.Collection | None = None,
) -> None:
    """Remove an object's hulls, and our collections if nothing is left in them.

    Parameters
    ----------
    obj : Object
    chosen : sequence of Object, optional
        The hulls to remove; the others stay.
    kept : Collection, optional
        Ours, which stays although nothing is left in it.
    """
    all_of_it = hulls_of(obj)
    hulls = all_of_it if chosen is None else chosen
    if not hulls and not noted_by(obj):  # files have thousands of collections
        return
    if hulls and obj.mode != "OBJECT":
        raise DecompositionError(
            "Hulls are objects, which Edit Mode cannot bring back on undo; switch to"
            " Object Mode first."
        )
    if len(hulls) == len(all_of_it):
        soften(obj, hulls)
    if obj.mode == "OBJECT":
        if chosen is None:
            leave_to_user(obj)
        _remove([hull for hull in hulls if HULL_TAG in hull], kept)


def erase_lost_hulls() -> int:
    """Remove the hulls whose object is gone; return their number."""
    hulls = lost_hulls()
    _remove(hulls)
    remove_simulation()
    return len(hulls)


def _remove(
    hulls: Sequence[bpy.types.Object], kept: bpy.types.Collection | None = None
) -> None:
    """Remove hulls with their meshes and materials, and our empty collections.

    What the user gave them as children goes to their object.
    """
    removed = set(hulls)
    for child in bpy.data.objects if removed else ():
        if child.parent in removed and HULL_TAG not in child:
            hand_over(child, child.parent.parent, within_parent(child.parent))
    discard(hulls)
    remove_empty_collections(kept)


def _materials(
    obj: bpy.types.Object, found: HullDecomposition, parts: FoundParts | None
) -> list[bpy.types.Material]:
    """Return the material of each hull: that of its part, or one for hulls alone."""
    if parts is not None:
        own = none_missing(parts.identities, materials_of(obj, parts))
        return [own[part] for part in found.parts]
    rows = found.parts.tolist() if found.has_parts else range(found.n_hulls)
    return [hull_material(row) for row in rows]


def _check_free(
    names: Sequence[str], obj: bpy.types.Object, parameters: HullParameters
) -> None:
    """Raise if an object that is no hull of `obj` has a name that a hull needs."""
    # All names at once: Blender looks through all objects for each that is asked for.
    local = {each.name for each in bpy.data.objects if each.library is None}
    taken = local.intersection(names)
    own = hulls_of(obj) if taken else []
    taken -= {hull.name for hull in own if not has_more(hull)}
    if taken:
        first = min(taken)
        holder = bpy.data.objects[first, None]
        another_has_it = is_hull(holder) and holder not in own
        nameless = "{name" not in parameters.template
        remedy = "rename it"
        if another_has_it and parameters.naming == "TEMPLATE" and nameless:
            remedy = "put {name} into Template,"
        raise DecompositionError(
            f"{'Another object has a hull' if another_has_it else 'There is an object'}"
            f" {first} already; {remedy} or choose another Naming."
        )


def hull_mesh(
    name: str,
    shape: CollisionShape,
    scale: np.ndarray,
    material: bpy.types.Material | None,
) -> bpy.types.Mesh:
    """Return the mesh of a shape, with a material or without."""
    vertices, faces = core.faces_of(shape)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(unstretched(vertices, scale).tolist(), [], faces.tolist())
    if material is not None:
        mesh.materials.append(material)
    return mesh


def _hull_object(
    name: str, mesh: bpy.types.Mesh, material: bpy.types.Material
) -> bpy.types.Object:
    """Return an object with the mesh of a hull."""
    hull = bpy.data.objects.new(name, mesh)
    hull.color = material.diffuse_color
    hull.show_wire = True
    hull.hide_render = True
    return hull


def figures_of_hull(
    found: HullDecomposition, row: int, parts: FoundParts | None = None
) -> dict[str, Any]:
    """Return the figures of a hull, to be noted.

    Its part is a place. Those that an object has are noted by number, which stays.
    """
    shape = found.shapes[row]
    part = int(found.parts[row]) if found.has_parts else None
    if parts is not None and part is not None:
        part = parts.identities[part].number
    return {
        "kind": shape.kind,
        "error": float(found.errors[row]),
        "error_unit": found.error_unit,
        "volume": float(shape.volume),
        "part": part,
        "vertices": len(core.outline_of(shape).vertices),
    }
