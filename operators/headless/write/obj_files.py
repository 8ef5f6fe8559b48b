"""Writes .obj files whose coordinates have all their digits and whose names differ.

Blender's exporter writes six decimals, which leave nothing of a model of 1e-6, and
turns "A b" and "A_b" into one name.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from pathlib import Path

import bpy
import numpy as np

from ....core.steps.arrays import FloatArray
from .names import legal_names, names_of_hulls, names_of_objects
from .placed_meshes import digits_of, matrix_of, placed, turned_up

# Blender's exporter rounds to this, and computes in single precision.
_ROUNDING = 2e-6


def write_obj(
    path: Path, meshes: Sequence[tuple[str, FloatArray, Iterable[Sequence[int]]]]
) -> None:
    """Write meshes, each an object of its own.

    Parameters
    ----------
    path : Path
    meshes : sequence of (str, (V, 3) float, faces)
        Name, vertices and the vertices of each face, from 0; names are made legal and
        distinct.
    """
    lines, first = [], 1
    names = legal_names([name for name, _, _ in meshes], "obj")
    for name, (_, vertices, faces) in zip(names, meshes, strict=True):
        lines.append(f"o {name}")
        lines += [f"v {digits_of(vertex)}" for vertex in vertices]
        lines += ["f " + " ".join(str(v + first) for v in face) for face in faces]
        first += len(vertices)
    path.write_text("\n".join([*lines, ""]), encoding="utf-8", newline="\n")


def write_hulls_obj(path: Path, hulls: Sequence[bpy.types.Object], up: str) -> None:
    """Write hulls in world space, each an object, with `up` ('Y' or 'Z') up."""
    meshes = []
    for hull, name in zip(hulls, names_of_hulls(hulls, "obj"), strict=True):
        matrix = matrix_of(hull)
        vertices, _, _ = placed(hull, matrix)
        turn = -1 if np.linalg.det(matrix[:3, :3]) < 0 else 1
        faces = [list(face.vertices)[::turn] for face in hull.data.polygons]
        meshes.append((name, turned_up(vertices, up), faces))
    write_obj(path, meshes)


def restore_digits(path: Path, up: str) -> None:
    """Give a file of Blender's exporter, without modifiers, all digits and own names.

    Objects that are no meshes, such as curves, keep their six decimals.
    """
    # Names that are no valid UTF-8 stay as they are.
    text = path.read_text(encoding="utf-8", errors="surrogateescape")
    lines = text.split("\n")
    starts = [row for row, line in enumerate(lines) if line.startswith("o ")]
    blocks = [slice(*ends) for ends in pairwise([*starts, len(lines)])]
    old = [lines[row][2:] for row in starts]
    known, shapes = names_of_objects("obj"), _exported_meshes()
    own = old.copy()
    for place, (name, block) in enumerate(zip(old, blocks, strict=True)):
        rows = [
            n for n, line in enumerate(lines[block], block.start) if line[:2] == "v "
        ]
        if not (rows and shapes.get(name)):
            continue
        exported, vertices = shapes[name][0]
        vertices = turned_up(vertices, up)
        if _agree([lines[row] for row in rows], vertices):
            del shapes[name][0]
            own[place] = known.get(exported, name)  # hulls have their own
            for row, vertex in zip(rows, vertices, strict=True):
                lines[row] = f"v {digits_of(vertex)}"
    for name, new, block in zip(old, legal_names(own, "obj"), blocks, strict=True):
        if new != name:
            lines[block] = [_renamed(line, name, new) for line in lines[block]]
    path.write_text(
        "\n".join(lines), encoding="utf-8", errors="surrogateescape", newline="\n"
    )


def _renamed(line: str, old: str, new: str) -> str:
    """Return a line with another name, if it is that of an object or its group."""
    for head in (f"o {old}", f"g {old}"):
        if line.startswith(head):
            return head[:2] + new + line[len(head) :]
    return line


def _exported_meshes() -> dict[str, list[tuple[str, FloatArray]]]:
    """Return the names of visible meshes and their vertices in world space.

    They are sorted by their name in the file, where some have one name.
    """
    found: dict[str, list[tuple[str, FloatArray]]] = {}
    for instance in bpy.context.evaluated_depsgraph_get().object_instances:
        obj = instance.object.original
        if obj.type == "MESH":
            matrix = np.array(instance.matrix_world, dtype=np.float64)
            vertices, _, _ = placed(obj, matrix)
            in_file = obj.name.replace(" ", "_")
            found.setdefault(in_file, []).append((obj.name, vertices))
    return found


def _agree(lines: Sequence[str], vertices: FloatArray) -> bool:
    """Return whether lines of a file hold vertices, as far as their decimals go."""
    if len(lines) != len(vertices):
        return False
    rough = np.array([line.split()[1:4] for line in lines], dtype=np.float64)
    slack = _ROUNDING * (1 + np.abs(vertices).max(initial=0.0))
    return bool((np.abs(rough - vertices) <= slack).all())
