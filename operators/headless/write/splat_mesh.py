"""Meshes that stand for point clouds where points cannot be seen or written."""

from __future__ import annotations

import bpy
import numpy as np

from ...bridge.mesh.points import count_points, normals_of, positions_of, read_vectors
from ...bridge.parts.materials import part_materials
from ...bridge.stored.identity import usual_identities
from ...bridge.stored.names import NORMAL_LAYER, PART_LAYER


def splat_mesh(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return a new mesh of the splats of a cloud, with a material for each part."""
    # Loads SciPy: seconds that enabling the add-on must not take.
    from ....core.clouds.splats import thinned_splats

    points = positions_of(obj).astype(np.float64)
    normals = read_vectors(obj, NORMAL_LAYER)
    if normals is None:
        normals = normals_of(obj)
    mesh = bpy.data.meshes.new(obj.name)
    if normals is None or PART_LAYER not in obj.data.attributes:
        return mesh  # it was not decomposed
    kept, _, targets = thinned_splats(points, normals.astype(np.float64))
    mesh.from_pydata(targets.vertices, [], targets.triangles.tolist())
    parts = np.empty(count_points(obj), dtype=np.int32)
    obj.data.attributes[PART_LAYER].data.foreach_get("value", parts)
    for material in part_materials(usual_identities(int(parts.max()) + 1), []):
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", parts[kept])
    return mesh
