"""Winding of triangles: consistent, and outwards on closed shells."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .mesh import TriangleMesh
from .shells import Shells

# Greatest missing area of a solid open shell, as a share of its area. A cube without
# its lid misses 0.2.
_MOST_MISSING = 0.25


def oriented(
    mesh: TriangleMesh, shells: Shells
) -> tuple[TriangleMesh, tuple[str, ...]]:
    """Return `mesh` with its solid shells wound consistently and outwards.

    A shell is solid if it is closed, or if little of its area is missing in holes. A
    solid shell inside another one may be a cavity: it keeps its winding relative to the
    outer shell. Other shells have no known inside. They are only turned if more than
    half of the solid area has to be turned.

    Parameters
    ----------
    mesh : TriangleMesh
    shells : Shells
        Shells of `mesh`.

    Returns
    -------
    mesh : TriangleMesh
        The same object if no triangle had to be turned.
    notes : tuple of str
        A sentence to the user if triangles were turned.
    """
    solid = _solid(mesh, shells)
    turned = np.zeros(len(solid), dtype=bool)
    turned[list(_inverted(mesh, shells, solid))] = True
    areas = np.bincount(shells.of_triangle, mesh.areas)
    if areas[turned].sum() > areas[solid].sum() / 2:
        # The whole object is inside out, so its open shells are turned as well.
        turned |= ~solid
    flips = shells.against ^ turned[shells.of_triangle]
    if not flips.any():
        return mesh, ()
    triangles = np.where(flips[:, None], mesh.triangles[:, ::-1], mesh.triangles)
    kind = "inside out" if flips.all() else "wound inconsistently"
    return replace(mesh, triangles=triangles), (
        f"The faces are {kind}; they were turned for this computation only"
        " (Mesh > Normals > Recalculate Outside turns them for good).",
    )


def _solid(mesh: TriangleMesh, shells: Shells) -> NDArray[np.bool_]:
    """Return whether each shell is closed, or nearly so, (S,) bool.

    The area vectors of a closed surface sum to zero. The length of the sum is thus a
    lower bound of the missing area.
    """
    vectors = mesh.areas[:, None] * mesh.normals
    vectors = np.where(shells.against[:, None], -vectors, vectors)
    sums = np.stack(
        [np.bincount(shells.of_triangle, vectors[:, axis]) for axis in range(3)]
    )
    missing = np.linalg.norm(sums, axis=0)
    areas = np.bincount(shells.of_triangle, mesh.areas)
    return shells.closed | (shells.windable & (missing <= _MOST_MISSING * areas))


def _inverted(
    mesh: TriangleMesh,
    shells: Shells,
    solid: NDArray[np.bool_],
) -> set[int]:
    """Return the outermost inward-facing solid shells and all solid shells inside."""
    flips = shells.against
    corners = mesh.vertices[mesh.triangles]
    volumes = _volumes(corners, shells.of_triangle, flips)
    inward = np.flatnonzero(solid & (volumes < 0))
    if len(inward) == 0:
        return set()
    order = np.argsort(shells.of_triangle, kind="stable")
    members = np.split(order, np.cumsum(np.bincount(shells.of_triangle))[:-1])
    lows = np.array([corners[m].min(axis=(0, 1)) for m in members])
    highs = np.array([corners[m].max(axis=(0, 1)) for m in members])

    def encloses(outer: int, inner: int) -> bool:
        boxed = (lows[outer] < lows[inner]).all() and (
            highs[outer] > highs[inner]
        ).all()
        if outer == inner or not boxed:
            return False
        turned = np.where(flips[members[outer]], -1.0, 1.0)
        point = corners[members[inner][0], 0]
        return abs(_winding_number(point, corners[members[outer]], turned)) > 0.5

    candidates = np.flatnonzero(solid)
    inverted: set[int] = set()
    for shell in inward:
        if not any(encloses(outer, shell) for outer in candidates):
            # Inner shells turn along, so they stay a cavity or a core.
            inverted.add(int(shell))
            inverted |= {int(c) for c in candidates if encloses(shell, c)}
    return inverted


def _volumes(
    corners: NDArray[np.float64],
    shells: NDArray[np.int64],
    flips: NDArray[np.bool_],
) -> NDArray[np.float64]:
    """Return six times the signed volume of each shell, (S,), about its middle."""
    counts = np.bincount(shells)[:, None]
    centers = corners.mean(axis=1)
    sums = [np.bincount(shells, centers[:, axis]) for axis in range(3)]
    middles = np.stack(sums, axis=1) / counts
    a, b, c = np.moveaxis(corners - middles[shells][:, None], 1, 0)
    volumes = np.einsum("td,td->t", a, np.cross(b, c))
    signed = np.where(flips, -volumes, volumes)
    return np.bincount(shells, signed).astype(np.float64)


def _winding_number(
    point: NDArray[np.float64],
    corners: NDArray[np.float64],
    signs: NDArray[np.float64],
) -> float:
    """Return the winding number of triangles (T, 3, 3) around a point.

    A sum of solid angles, by the formula of Van Oosterom and Strackee (1983).
    """
    a, b, c = np.moveaxis(corners - point, 1, 0)
    la, lb, lc = (np.linalg.norm(edge, axis=1) for edge in (a, b, c))
    above = np.einsum("td,td->t", a, np.cross(b, c))
    below = (
        la * lb * lc
        + (a * b).sum(axis=1) * lc
        + (b * c).sum(axis=1) * la
        + (c * a).sum(axis=1) * lb
    )
    return float((signs * np.arctan2(above, below)).sum() / (2 * np.pi))
