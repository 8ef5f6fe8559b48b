"""The surface of a point cloud, made of oriented splats (section 5)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..geometry.mesh import TriangleMesh
from ..geometry.point_cloud import PointCloud
from ..steps.arrays import FloatArray, IntArray
from ..steps.progress import Progress, Steps, within
from .normals import estimate_normals, face_inwards, seem_wrong
from .splats import nearest_points, smoothed, thinned_splats

_FLAT = (
    "The points lie in a plane, and no line of sight runs within it; add faces to have"
    " their outline cut into parts.",
)


@dataclass(frozen=True, eq=False)
class SplatSurface:
    """The splats of a cloud, thinned out if the cloud is large.

    Attributes
    ----------
    points, normals : (M, 3) float
        Smoothed points that became splats, and their outward unit normals.
    areas : (M,) float
        Surface area that each of these points stands for.
    mesh : TriangleMesh
        Triangle i is the splat of point i.
    nodes : (N,) int
        Splat of each point of the cloud.
    tilt : float
        Sine of the angle by which the normals may be off.
    notes : tuple of str
        Sentences to the user on the normals.
    found_normals : (N, 3) float or None
        Normals of all points of the cloud if it had none, or if they faced inwards.
    """

    points: FloatArray
    normals: FloatArray
    areas: FloatArray
    mesh: TriangleMesh
    nodes: IntArray
    tilt: float
    notes: tuple[str, ...]
    found_normals: FloatArray | None

    @property
    def size(self) -> float:
        """Side of the square that a splat stands for, on average."""
        return float(np.sqrt(self.areas.mean()))


def splat_surface(cloud: PointCloud) -> Steps[SplatSurface]:
    """Build the splats of a point cloud.

    Normals are estimated if the cloud has none, and flipped if they face inwards.
    Copies of a point have one splat.

    Parameters
    ----------
    cloud : PointCloud
        Centered at the origin.

    Returns
    -------
    Steps of SplatSurface
    """
    different, rows = cloud.distinct()
    found = yield from _surface_of(different)
    normals = found.found_normals
    return replace(
        found,
        nodes=found.nodes[rows],
        found_normals=None if normals is None else normals[rows],
    )


def _surface_of(cloud: PointCloud) -> Steps[SplatSurface]:
    """Build the splats of a cloud whose points are all different."""
    points, normals, tilt = cloud.points, cloud.normals, 0.0
    notes: tuple[str, ...] = ()
    plane = cloud.plane
    if normals is None:
        if plane is None:
            normals, tilt = yield from within(estimate_normals(points), 0.0, 0.6)
        else:
            normals = np.tile(plane, (len(points), 1))
        notes = ("The points have no normals; they were estimated.",)
    elif face_inwards(points, normals):
        normals = -normals
        notes = (
            "The normals of the points face inwards; they were flipped for this"
            " computation only.",
        )
    found = normals if notes else None
    if plane is not None:
        notes += _FLAT
    yield Progress("Splats", 0.6)
    points = smoothed(points, normals)
    kept, areas, mesh = thinned_splats(points, normals)
    if cloud.normals is not None and seem_wrong(cloud.points[kept], normals[kept]):
        notes += (
            "The normals of the points seem wrong, as many lean far from the surface or"
            " face away from those beside them; recompute them, or remove them to have"
            " them estimated.",
        )
    yield Progress("Splats", 0.8)
    nodes, everything = np.arange(len(points)), (points, normals)
    if len(kept) < len(points):
        points, normals = points[kept], normals[kept]
        nodes = nearest_points(points, normals, 1, everything)[:, 0]
    return SplatSurface(points, normals, areas, mesh, nodes, tilt, notes, found)
