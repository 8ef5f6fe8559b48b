"""Winding of triangles: consistent, and outwards on closed shells."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace

import numpy as np
from scipy.spatial import cKDTree

from ..geometry.frames import cross
from ..geometry.mesh import TriangleMesh
from ..steps.arrays import BoolArray, FloatArray, IntArray
from ..steps.progress import Progress, Steps, within
from ..steps.rows import blocks
from .shells import Shells
from .slivers import are_thin

# Greatest missing area of a solid open shell, as a share of its area. A cube without
# its lid misses 0.2.
_MOST_MISSING = 0.25
# A volume below this, in cubed diagonals, is rounding: that of a sheet with two sides.
_NO_VOLUME = 1e-12 / 6
# Boxes of shells that are compared with all others in one step.
_BOXES = 256


def oriented(
    mesh: TriangleMesh, shells: Shells
) -> Steps[tuple[TriangleMesh, tuple[str, ...]]]:
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
        A sentence to the user if triangles with an area were turned.
    """
    areas, missing, volumes = yield from _measured(mesh, shells)
    # The area vectors of a closed surface sum to zero. The length of the sum is thus a
    # lower bound of the missing area.
    nearly = shells.windable & (missing <= _MOST_MISSING * areas)
    solid = shells.closed | nearly
    turned = np.zeros(len(solid), dtype=bool)
    inward = np.flatnonzero(solid & (volumes < -_NO_VOLUME * mesh.diagonal**3))
    if len(inward):
        yield Progress("Surface", 0.6)
        inverted = yield from _inverted(mesh, shells, solid, inward)
        turned[inverted] = True
    if areas[turned].sum() > areas[solid].sum() / 2:
        # The whole object is inside out, so its open shells are turned as well.
        turned |= ~solid
    flips = shells.against ^ turned[shells.of_triangle]
    if not flips.any():
        return mesh, ()
    triangles = np.where(flips[:, None], mesh.triangles[:, ::-1], mesh.triangles)
    outward = replace(mesh, triangles=triangles)
    if (yield from within(are_thin(mesh, np.flatnonzero(flips)), 0.9, 1.0)):
        return outward, ()  # nobody sees how those are wound
    all_flipped = yield from within(are_thin(mesh, np.flatnonzero(~flips)), 1.0, 1.0)
    kind = "inside out" if all_flipped else "wound inconsistently"
    return outward, (
        f"The faces are {kind}; they were flipped for this computation only"
        " (Mesh > Normals > Recalculate Outside flips them permanently).",
    )


def _measured(
    mesh: TriangleMesh, shells: Shells
) -> Steps[tuple[FloatArray, FloatArray, FloatArray]]:
    """Return the area of each shell (S,), its missing area, and its volume.

    Triangles are taken as wound consistently.
    """
    # Number of triangles, their area, area vectors and centers, and three times the
    # volume about 0.
    sums = np.zeros((9, len(shells.closed)))
    for rows in blocks(len(mesh.triangles)):
        yield Progress("Surface", 0.6 * rows.start / len(mesh.triangles))
        areas, corners = mesh.areas[rows], mesh.vertices[mesh.triangles[rows]]
        signs = np.where(shells.against[rows], -areas, areas)
        vectors, centers = signs[:, None] * mesh.normals[rows], corners.mean(axis=1)
        tripled = np.einsum("td,td->t", centers, vectors)
        columns = [np.ones_like(areas), areas, *vectors.T, *centers.T, tripled]
        for total, column in zip(sums, columns, strict=True):
            np.add.at(total, shells.of_triangle[rows], column)
    # The volume of an open shell depends on the point it is measured about.
    middles = sums[5:8] / sums[0]
    volumes = (sums[8] - (middles * sums[2:5]).sum(axis=0)) / 3
    return sums[1], np.linalg.norm(sums[2:5], axis=0), volumes


def _inverted(
    mesh: TriangleMesh, shells: Shells, solid: BoolArray, inward: IntArray
) -> Steps[IntArray]:
    """Return the outermost inward-facing solid shells and all solid shells inside."""
    members = shells.members

    def encloses(outer: int, inner: int) -> bool:
        rows = members[outer]
        turned = np.where(shells.against[rows], -1.0, 1.0)
        point = mesh.vertices[mesh.triangles[members[inner][0], 0]]
        around = mesh.vertices[mesh.triangles[rows]]
        return abs(_winding_number(point, around, turned)) > 0.5

    around, inside = yield from _nested_boxes(
        *shells.bounds(mesh), np.flatnonzero(solid)
    )
    inverted: set[int] = set()
    for shell in inward.tolist():
        yield Progress("Surface", 0.6)
        if not any(encloses(other, shell) for other in around[shell]):
            # Inner shells turn along, so they stay a cavity or a core.
            inverted.add(shell)
            inverted |= {other for other in inside[shell] if encloses(shell, other)}
    return np.array(sorted(inverted), dtype=np.int64)


def _nested_boxes(
    lows: FloatArray, highs: FloatArray, chosen: IntArray
) -> Steps[tuple[dict[int, list[int]], dict[int, list[int]]]]:
    """Return which of the chosen boxes are around each, and which are inside each.

    Boxes without one have no key, but an empty list.
    """
    # The middle of a box inside is in the ball around the outer one.
    middles, radii = (lows + highs)[chosen] / 2, (highs - lows)[chosen] / 2
    tree, reach = cKDTree(middles), np.linalg.norm(radii, axis=1)
    around, inside = (
        defaultdict[int, list[int]](list),
        defaultdict[int, list[int]](list),
    )
    for some in blocks(len(chosen), _BOXES):
        yield Progress("Surface", 0.6)
        near = tree.query_ball_point(middles[some], reach[some])
        outer = np.repeat(chosen[some], [len(each) for each in near])
        inner = chosen[np.concatenate(near).astype(np.int64)]
        within = (lows[outer] < lows[inner]).all(axis=1)
        within &= (highs[outer] > highs[inner]).all(axis=1)
        for one, other in np.stack([outer, inner], axis=1)[within].tolist():
            around[other].append(one)
            inside[one].append(other)
    return around, inside


def _winding_number(point: FloatArray, corners: FloatArray, signs: FloatArray) -> float:
    """Return how often triangles (T, 3, 3) wind around a point (3,).

    `signs` (T,) are -1 for triangles to be turned. A sum of solid angles, by the
    formula of Van Oosterom and Strackee (1983).
    """
    a, b, c = np.moveaxis(corners - point, 1, 0)
    la, lb, lc = (np.linalg.norm(edge, axis=1) for edge in (a, b, c))
    above = np.einsum("td,td->t", a, cross(b, c))
    below = (
        la * lb * lc
        + (a * b).sum(axis=1) * lc
        + (b * c).sum(axis=1) * la
        + (c * a).sum(axis=1) * lb
    )
    return float((signs * np.arctan2(above, below)).sum() / (2 * np.pi))
