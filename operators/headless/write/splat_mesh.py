"""Meshes of disks that stand for point clouds in pictures."""

from __future__ import annotations

import bpy
import numpy as np

from .... import core
from ...bridge.mesh.attributes import write_ints
from ...bridge.mesh.points import normals_of, positions_of, read_vectors
from ...bridge.parts.materials import own_materials
from ...bridge.parts.read import find_parts_on
from ...bridge.stored.names import NORMAL_LAYER


def splat_mesh(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return a new mesh with the splats of a point cloud, in the colors of its parts.

    The mesh is empty if the cloud was not decomposed.
    """
    points = positions_of(obj).astype(np.float64)
    normals = read_vectors(obj, NORMAL_LAYER)
    if normals is None:
        normals = normals_of(obj)
    mesh = bpy.data.meshes.new(obj.name)
    found = find_parts_on(obj)
    if normals is None or found is None:
        return mesh
    kept, _, targets = core.thinned_splats(points, normals.astype(np.float64))
    mesh.from_pydata(targets.vertices, [], targets.triangles.tolist())
    for material in own_materials(found.identities, [None] * len(found.identities)):
        mesh.materials.append(material)
    write_ints(mesh.polygons, "material_index", found.labels[kept])
    return mesh
