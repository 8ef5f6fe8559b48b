"""Vertex groups that have the name of one of ours, and are the user's.

The user may remove the group of a part and make another of that name.
"""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from ....core.steps.arrays import BoolArray, Int32Array, IntArray
from ..mesh.attributes import corner_vertices
from ..mesh.known import corner_faces
from ..mesh.layers import flush_edits, layers_of
from ..mesh.points import is_cloud
from .names import PART_LAYER, RESTORE
from .noted_parts import identities_of
from .record import record_of
from .restore import Restore

# Vertices that are looked up to tell whose a group is: to look up all takes long.
_PICKED = 64


def users_groups(obj: bpy.types.Object, restore: Restore) -> set[str]:
    """Return the names of groups that the user made in place of ours.

    Their members are not the vertices of the part. Groups of objects to which faces
    came, or that lost some, cannot be told apart.
    """
    flush_edits(obj)
    mesh, record = obj.data, record_of(obj)
    numbers = sorted(each.number for each in identities_of(record))
    values = layers_of(obj).faces(PART_LAYER)
    if values is None or not numbers or len(numbers) != len(restore.groups):
        return set()
    if RESTORE not in mesh:  # it is guessed, and the order of the groups is not known
        return set()
    n_rows = len(mesh.vertices if is_cloud(obj) else mesh.polygons)
    if len(values) != n_rows or not _has_faces_of(record, values):
        return set()
    if is_cloud(obj):
        vertices, of_part = np.arange(n_rows), values
    else:
        vertices, of_part = corner_vertices(mesh), values[corner_faces(mesh)]
    found = set()
    for number, name in zip(numbers, restore.groups, strict=True):
        inside = np.zeros(len(mesh.vertices), dtype=bool)
        inside[vertices[of_part == number]] = True
        group = obj.vertex_groups.get(name)
        if group is not None and not _is_group_of(obj, group.index, inside):
            found.add(name)
    return found


def _has_faces_of(record: dict[str, Any], values: Int32Array) -> bool:
    """Return whether each part has as many faces, or points, as a record says."""
    noted = {part["number"]: part["faces"] for part in record["parts"]}
    numbers, counts = np.unique(values, return_counts=True)
    return dict(zip(numbers.tolist(), counts.tolist(), strict=True)) == noted


def _is_group_of(obj: bpy.types.Object, group: int, inside: BoolArray) -> bool:
    """Return whether half of what a group and a part have, or more, is in both.

    `inside` are the vertices of the part. Some vertices tell of all.
    """

    def n_members(vertices: IntArray) -> float:
        picked = vertices[:: len(vertices) // _PICKED + 1].tolist()
        held = [[g.group for g in obj.data.vertices[v].groups] for v in picked]
        return sum(group in each for each in held) / max(len(held), 1) * len(vertices)

    own, others = np.flatnonzero(inside), np.flatnonzero(~inside)
    return 2.0 * n_members(own) >= len(own) + n_members(others)
