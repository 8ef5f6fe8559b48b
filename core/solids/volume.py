"""The volume that a closed mesh encloses."""

from __future__ import annotations

import numpy as np

from ..geometry.frames import cross
from ..geometry.mesh import TriangleMesh
from ..steps.progress import Progress, Steps
from ..steps.rows import blocks


def signed_volume(mesh: TriangleMesh) -> Steps[float]:
    """Return the volume of the tetrahedra between a mesh's triangles and its center.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    Steps of float
        In cubed units of the mesh. What triangles seen from outside enclose counts as
        positive, what is inside out as negative.
    """
    volume = 0.0
    for rows in blocks(len(mesh.triangles)):
        yield Progress("Surface", rows.start / len(mesh.triangles))
        a, b, c = np.moveaxis(mesh.vertices[mesh.triangles[rows]] - mesh.center, 1, 0)
        volume += float(np.einsum("td,td->", a, cross(b, c))) / 6
    return volume
