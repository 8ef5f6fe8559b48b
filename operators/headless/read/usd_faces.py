"""Finds meshes of USD files whose faces do not fit their points.

Blender leaves such faces out without a word, reads other memory or crashes.
"""

from __future__ import annotations

from pathlib import Path


def mesh_without_its_points(path: Path) -> str | None:
    """Return the name of a mesh whose faces do not fit its points, None without.

    Prototypes of instances are among them. What cannot be opened has none.
    """
    try:
        from pxr import Tf, Usd, UsdGeom
    except ImportError:  # not in every Blender
        return None
    try:
        stage = Usd.Stage.Open(str(path))
    except Tf.ErrorException:
        return None  # the importer reports it
    now = Usd.TimeCode.EarliestTime()
    for root in (stage.GetPseudoRoot(), *stage.GetPrototypes()):
        for mesh in filter(None, map(UsdGeom.Mesh, Usd.PrimRange(root))):
            corners = mesh.GetFaceVertexIndicesAttr().Get(now) or ()
            counts = mesh.GetFaceVertexCountsAttr().Get(now) or ()
            n_points = len(mesh.GetPointsAttr().Get(now) or ())
            fits, _ = mesh.ValidateTopology(corners, counts, n_points)
            if not fits or min(counts, default=0) < 0:
                return str(mesh.GetPrim().GetName())
    return None
