"""Writes .usd files as text: the model with its parts, and hulls as colliders.

Blender's exporter orders the prims of a file anew in every run, and before Blender
4.4 Python has no USD modules to mark colliders with. Text needs neither.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ...bridge.mesh.attributes import (
    corner_vertices,
    read_floats,
    read_ints,
    vertex_positions,
)
from ...bridge.mesh.points import is_cloud, positions_of
from ...bridge.views.face_sets_and_colors import point_colors
from ..shear import has_shear, shear_in_meshes, without_shear
from .names import legal_names, names_of_hulls, names_of_objects
from .placed_meshes import digits_of

_ROOT = "/root"
_MATERIALS = "_materials"
_HEAD = """\
#usda 1.0
(
    defaultPrim = "root"
    metersPerUnit = 1
    upAxis = "Z"
)

def Xform "root"
{"""
_COLLIDER = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"]


def write_usd(
    path: Path, objects: Sequence[bpy.types.Object], hulls: Sequence[bpy.types.Object]
) -> None:
    """Write meshes and point clouds with the colors of their parts, and hulls.

    Each is a prim below one root, with the place of its object. Hulls are colliders
    that are their own convex hull (UsdPhysics); beside objects, they are not rendered.
    """
    materials: list[bpy.types.Material] = []
    for obj in objects:
        slots = [] if is_cloud(obj) else obj.data.materials
        materials += [m for m in slots if m and m not in materials]
    labels = legal_names([material.name for material in materials], "usd")
    paths = {
        m: f"{_ROOT}/{_MATERIALS}/{n}" for m, n in zip(materials, labels, strict=True)
    }
    own = names_of_objects("usd")
    names = [*(own[obj.name] for obj in objects), *names_of_hulls(hulls, "usd")]
    names = legal_names(names, "usd", reserved=[_MATERIALS])
    lines = [_HEAD]
    # Not all programs read shear in the matrix of a prim; Blender does not.
    with shear_in_meshes([*objects, *hulls]):
        for obj, name in zip(objects, names, strict=False):
            if is_cloud(obj):
                lines += _points(obj, name)
            else:
                lines += _model(obj, name, paths)
        for hull, name in zip(hulls, names[len(objects) :], strict=True):
            lines += _hull(hull, name, bool(objects))
    if materials:
        lines += _material_scope(materials, labels)
    path.write_text("\n".join([*lines, "}", ""]), encoding="utf-8", newline="\n")


def _hull(hull: bpy.types.Object, name: str, beside_objects: bool) -> list[str]:
    """Return the lines of a hull."""
    extra = ['uniform token physics:approximation = "convexHull"']
    if beside_objects:
        extra.append('uniform token purpose = "guide"')
    return _prim("Mesh", hull, name, _COLLIDER, [*_surface(hull.data), *extra])


def _prim(
    kind: str,
    obj: bpy.types.Object,
    name: str,
    schemas: Sequence[str],
    content: Sequence[str],
) -> list[str]:
    """Return the lines of a prim in the place of an object."""
    place = obj.matrix_world
    if has_shear(place):
        place = without_shear(place)
    # USD multiplies rows by matrices: theirs are the transpose of ours.
    rows = ", ".join(_tuples(np.array(place, dtype=np.float64).T))
    content = [
        *content,
        f"matrix4d xformOp:transform = ( {rows} )",
        'uniform token[] xformOpOrder = ["xformOp:transform"]',
    ]
    about = []
    if schemas:
        about.append(f"prepend apiSchemas = [{', '.join(map(_text, schemas))}]")
    if name != obj.name:
        about.append(f"displayName = {_text(obj.name)}")
    head = [f'def {kind} "{name}" (', *_inside(about), ")"] if about else []
    return _inside([*(head or [f'def {kind} "{name}"']), "{", *_inside(content), "}"])


def _model(
    obj: bpy.types.Object, name: str, paths: dict[bpy.types.Material, str]
) -> list[str]:
    """Return the lines of a mesh with its UV map, normals and materials."""
    mesh = obj.data
    content = _surface(mesh)
    if mesh.uv_layers.active:
        uv = read_floats(mesh.uv_layers.active.uv, "vector", 2)
        content += _primvar("texCoord2f[] primvars:st", uv, "faceVarying")
    if read_ints(mesh.polygons, "use_smooth").any():
        normals = read_floats(mesh.corner_normals, "vector", 3)
        content += _primvar("normal3f[] normals", normals, "faceVarying")
    slots = read_ints(mesh.polygons, "material_index")
    slots = np.minimum(slots, max(len(mesh.materials) - 1, 0))
    used = [n for n, m in enumerate(mesh.materials) if m and (slots == n).any()]
    labels = legal_names([mesh.materials[n].name for n in used], "usd")
    if used:
        content.append(
            'uniform token subsetFamily:materialBind:familyType = "nonOverlapping"'
        )
    for number, label in zip(used, labels, strict=True):
        faces = ", ".join(map(str, np.flatnonzero(slots == number)))
        content += [
            f'def GeomSubset "{label}" (',
            '    prepend apiSchemas = ["MaterialBindingAPI"]',
            ")",
            "{",
            '    uniform token elementType = "face"',
            '    uniform token familyName = "materialBind"',
            f"    int[] indices = [{faces}]",
            f"    rel material:binding = <{paths[mesh.materials[number]]}>",
            "}",
        ]
    return _prim("Mesh", obj, name, [], content)


def _surface(mesh: bpy.types.Mesh) -> list[str]:
    """Return the lines of the vertices and faces of a mesh."""
    counts = ", ".join(map(str, read_ints(mesh.polygons, "loop_total")))
    corners = ", ".join(map(str, corner_vertices(mesh)))
    return [
        *_places(vertex_positions(mesh)),
        f"int[] faceVertexCounts = [{counts}]",
        f"int[] faceVertexIndices = [{corners}]",
        'uniform token orientation = "rightHanded"',
        'uniform token subdivisionScheme = "none"',
    ]


def _points(obj: bpy.types.Object, name: str) -> list[str]:
    """Return the lines of a point cloud in the colors of its parts."""
    content = _places(positions_of(obj))
    colors = point_colors(obj)[:, :3]
    content += _primvar("color3f[] primvars:displayColor", colors, "vertex")
    return _prim("Points", obj, name, [], content)


def _places(points: NDArray[np.floating[Any]]) -> list[str]:
    """Return the lines of points (N, 3) and their bounds."""
    lines = [f"point3f[] points = [{', '.join(_tuples(points))}]"]
    if len(points):
        ends = np.stack([points.min(axis=0), points.max(axis=0)])
        lines.append(f"float3[] extent = [{', '.join(_tuples(ends))}]")
    return lines


def _primvar(
    name: str, values: NDArray[np.floating[Any]], interpolation: str
) -> list[str]:
    """Return the lines of values (N, 2 or 3) on vertices or corners."""
    return [
        f"{name} = [{', '.join(_tuples(values))}] (",
        f'    interpolation = "{interpolation}"',
        ")",
    ]


def _material_scope(
    materials: Sequence[bpy.types.Material], names: Sequence[str]
) -> list[str]:
    """Return the lines of the materials, each of one color."""
    lines = []
    for material, name in zip(materials, names, strict=True):
        shader = f"{_ROOT}/{_MATERIALS}/{name}/Shader.outputs:surface"
        color = _tuples(np.array([material.diffuse_color[:3]]))[0]
        lines += [
            f'def Material "{name}"',
            "{",
            f"    token outputs:surface.connect = <{shader}>",
            '    def Shader "Shader"',
            "    {",
            '        uniform token info:id = "UsdPreviewSurface"',
            f"        color3f inputs:diffuseColor = {color}",
            "        token outputs:surface",
            "    }",
            "}",
        ]
    return _inside([f'def Scope "{_MATERIALS}"', "{", *_inside(lines), "}"])


def _tuples(rows: NDArray[np.floating[Any]]) -> list[str]:
    """Return rows of numbers as tuples of USD."""
    return [f"({digits_of(row).replace(' ', ', ')})" for row in rows]


def _text(text: str) -> str:
    """Return a text in quotes."""
    plain = legal_names([text], "xml")[0]
    return f'"{plain}"'


def _inside(lines: Sequence[str]) -> list[str]:
    """Return lines that are one step further to the right."""
    return [f"    {line}" for line in lines]
