"""The volume that a closed mesh encloses."""

from __future__ import annotations

import numpy as np

from ..geometry.frames import cross
from ..geometry.mesh import TriangleMesh
from ..steps.arrays import FloatArray
from ..steps.progress import Progress, Steps
from ..steps.rows import blocks


def signed_volume(mesh: TriangleMesh) -> Steps[float]:
    """Return the volume that a closed mesh encloses; below 0 if it is inside out.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    Steps of float
        In cubed units of the mesh.
    """
    return float((yield from volumes_of(mesh)).sum())


def volumes_of(mesh: TriangleMesh) -> Steps[FloatArray]:
    """Return the volumes of the tetrahedra between triangles and the mesh's center.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    Steps of (T,) float
        Below 0 where the center is in front of a triangle.
    """
    volumes = np.empty(len(mesh.triangles))
    for rows in blocks(len(volumes)):
        yield Progress("Surface", rows.start / len(volumes))
        a, b, c = np.moveaxis(mesh.vertices[mesh.triangles[rows]] - mesh.center, 1, 0)
        volumes[rows] = np.einsum("td,td->t", a, cross(b, c)) / 6
    return volumes
