"""Meshes of disks that stand for point clouds in pictures."""

from __future__ import annotations

import bpy
import numpy as np

from ...bridge.mesh.points import count_points, normals_of, positions_of, read_vectors
from ...bridge.parts.erase import NORMAL_LAYER, PART_LAYER
from ...bridge.parts.materials import part_materials
from ...bridge.stored.identity import usual_identities
from .blender_arrays import fill, read_labels


def splat_mesh(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return a new mesh with the splats of a point cloud, in the colors of its parts.

    The mesh is empty if the cloud was not decomposed.
    """
    # SciPy takes seconds to load; enabling the extension must not.
    from ....core.clouds.splats import thinned_splats

    points = positions_of(obj).astype(np.float64)
    normals = read_vectors(obj, NORMAL_LAYER)
    if normals is None:
        normals = normals_of(obj)
    mesh = bpy.data.meshes.new(obj.name)
    if normals is None or PART_LAYER not in obj.data.attributes:
        return mesh
    kept, _, targets = thinned_splats(points, normals.astype(np.float64))
    mesh.from_pydata(targets.vertices, [], targets.triangles.tolist())
    parts = read_labels(obj.data, PART_LAYER, "POINT", count_points(obj))
    for material in part_materials(usual_identities(int(parts.max()) + 1), []):
        mesh.materials.append(material)
    fill(mesh.polygons, "material_index", parts[kept])
    return mesh
