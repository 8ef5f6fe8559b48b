"""Meshes of disks that stand for point clouds in pictures."""

from __future__ import annotations

import bpy
import numpy as np

from .... import core
from ...bridge.mesh.attributes import read_labels, write_ints
from ...bridge.mesh.points import count_points, normals_of, positions_of, read_vectors
from ...bridge.parts.materials import part_materials
from ...bridge.stored.identity import usual_identities
from ...bridge.stored.names import NORMAL_LAYER, PART_LAYER


def splat_mesh(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return a new mesh with the splats of a point cloud, in the colors of its parts.

    The mesh is empty if the cloud was not decomposed.
    """
    points = positions_of(obj).astype(np.float64)
    normals = read_vectors(obj, NORMAL_LAYER)
    if normals is None:
        normals = normals_of(obj)
    mesh = bpy.data.meshes.new(obj.name)
    if normals is None or PART_LAYER not in obj.data.attributes:
        return mesh
    kept, _, targets = core.thinned_splats(points, normals.astype(np.float64))
    mesh.from_pydata(targets.vertices, [], targets.triangles.tolist())
    parts = read_labels(obj.data, PART_LAYER, "POINT", count_points(obj))
    for material in part_materials(usual_identities(int(parts.max()) + 1), []):
        mesh.materials.append(material)
    write_ints(mesh.polygons, "material_index", parts[kept])
    return mesh
