"""The meshes of USD files, as they are before Blender reads them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..quiet import quiet_blender


def meshes_of_usd(path: Path) -> Iterator[Any]:
    """Yield the meshes of a USD file, those of prototypes, too.

    There are none where the file or pxr cannot be opened.
    """
    try:
        from pxr import Tf, Usd, UsdGeom
    except ImportError:  # not in every Blender
        return
    try:
        with quiet_blender():  # what is missing is told by us
            stage = Usd.Stage.Open(str(path))
    except Tf.ErrorException:
        return  # the importer reports it
    for root in (stage.GetPseudoRoot(), *stage.GetPrototypes()):
        yield from filter(None, map(UsdGeom.Mesh, Usd.PrimRange(root)))


def mesh_without_its_points(path: Path) -> str | None:
    """Return the name of a mesh whose faces do not fit its points, None without."""
    for mesh in meshes_of_usd(path):
        corners = at_start(mesh.GetFaceVertexIndicesAttr())
        counts = at_start(mesh.GetFaceVertexCountsAttr())
        fits, _ = mesh.ValidateTopology(
            corners, counts, len(at_start(mesh.GetPointsAttr()))
        )
        if not fits or min(counts, default=0) < 0:
            return str(mesh.GetPrim().GetName())
    return None


def at_start(attribute: Any) -> Any:
    """Return the array of an attribute of USD where its animation begins.

    Blender does not read those of other types than meshes have.
    """
    from pxr import Usd, Vt

    value = attribute.Get(Usd.TimeCode.EarliestTime())
    return value if isinstance(value, (Vt.IntArray, Vt.Vec3fArray)) else ()
