"""Mass, center of mass and inertia tensor of solids of uniform density.

The integrals over a polyhedron are sums over tetrahedra between its triangles and one
point: F. Tonon, "Explicit Exact Formulas for the 3-D Tetrahedron Inertia Tensor in
Terms of its Vertex Coordinates", J. of Mathematics and Statistics 1(1), 2005.
"""

from __future__ import annotations

import numpy as np

from ..geometry.frames import area_vectors, cross
from ..geometry.mesh import TriangleMesh
from ..steps.arrays import FloatArray, IntArray
from ..steps.progress import run
from .mass_properties import MassProperties
from .orientation import oriented
from .shells import find_shells

# Most volume that rounding gives a sheet with two sides, in area times diagonal.
_ROUNDING = 1e-12


def mass_of_surface(
    vertices: FloatArray, triangles: IntArray, density: float
) -> MassProperties | None:
    """Return the mass properties of what a closed surface encloses.

    Parameters
    ----------
    vertices : (V, 3) float
    triangles : (T, 3) int
        Wound consistently. It does not matter which way.
    density : float
        Mass of a cubed unit.

    Returns
    -------
    MassProperties or None
        None if the surface encloses nothing.
    """
    corners = vertices[triangles]
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    # Small numbers: a model far from the origin loses no digits.
    middle = (low + high) / 2
    corners = corners - middle
    weights = np.einsum("td,td->t", corners[:, 0], cross(corners[:, 1], corners[:, 2]))
    volume = float(weights.sum()) / 6
    area = float(np.linalg.norm(area_vectors(corners), axis=1).sum()) / 2
    if abs(volume) <= _ROUNDING * area * float(np.linalg.norm(high - low)):
        return None
    weights = weights / volume  # positive sums, inside out or not
    sums = corners.sum(axis=1)
    center = np.einsum("t,ti->i", weights, sums) / 24  # the same with any threads
    # Mean of x x^T over the solid.
    moments = np.einsum("t,ti,tj->ij", weights, sums, sums)
    moments += np.einsum("t,tci,tcj->ij", weights, corners, corners)
    spread = moments / 120 - np.outer(center, center)
    mass = density * abs(volume)
    inertia = mass * (np.trace(spread) * np.eye(3) - spread)
    return MassProperties(mass, center + middle, inertia)


def mass_of_mesh(mesh: TriangleMesh, density: float) -> MassProperties | None:
    """Return the mass properties of the solid that a mesh bounds.

    Parameters
    ----------
    mesh : TriangleMesh
        Shells that face the wrong way are turned. Cavities count as empty. Where two
        shells overlap, both count.
    density : float
        Mass of a cubed unit.

    Returns
    -------
    MassProperties or None
        None if the mesh is not closed, or encloses nothing.
    """
    turned, _ = run(oriented(mesh, run(find_shells(mesh))))
    if not _is_balanced(turned):
        return None
    return mass_of_surface(turned.vertices, turned.triangles, density)


def _is_balanced(mesh: TriangleMesh) -> bool:
    """Return whether as many triangles run along each edge one way as the other way.

    Then the integrals do not depend on the point of the tetrahedra. Solids that touch
    along faces or edges are balanced, and so are triangles without area.
    """
    tails = mesh.welded_triangles.astype(np.int64)
    heads = np.roll(tails, -1, axis=1)
    one_way, other_way = (
        np.sort((some * (tails.max() + 1) + others).ravel())
        for some, others in ((tails, heads), (heads, tails))
    )
    return np.array_equal(one_way, other_way)
