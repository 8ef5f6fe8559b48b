"""Cut triangles into small ones, and tell how far points are from triangles."""

from __future__ import annotations

import numpy as np

from ...geometry.cutting.halving import edge_lengths, halved
from ...steps.arrays import FloatArray, IntArray

# Cutting stops at so many triangles more, however long their edges still are.
_MOST_MORE = 200_000


def fragments_of(corners: FloatArray, longest: float) -> tuple[FloatArray, IntArray]:
    """Halve triangles until no edge is longer than allowed.

    Whether an edge is halved depends on nothing but its length, so that neighbors that
    fit together still do, until there are very many.

    Parameters
    ----------
    corners : (T, 3, 3) float
    longest : float
        Longest edge of a small triangle.

    Returns
    -------
    fragments : (N, 3, 3) float
        With the same winding.
    origins : (N,) int
        Triangle that each is a piece of.
    """
    done = [corners[:0]]
    rows = [np.zeros(0, dtype=np.int64)]
    triangles, n_done = np.arange(len(corners)), 0
    most = len(corners) + _MOST_MORE
    while len(corners):
        lengths = edge_lengths(corners)
        ready = lengths.max(axis=1) <= longest
        if n_done + len(corners) > most:
            ready[:] = True
        done.append(corners[ready])
        rows.append(triangles[ready])
        n_done += int(ready.sum())
        corners = halved(corners[~ready], lengths[~ready])
        triangles = np.tile(triangles[~ready], 2)
    return np.concatenate(done), np.concatenate(rows)


def reach_of(corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the centers of triangles (T, 3), and how far corners are from them, (T,).

    Parameters
    ----------
    corners : (T, 3, 3) float
    """
    centers = corners.mean(axis=1)
    arms = corners - centers[:, None]
    return centers, np.sqrt(np.einsum("tcd,tcd->tc", arms, arms).max(axis=1))


def distances_to(points: FloatArray, corners: FloatArray) -> FloatArray:
    """Return the distance of each point from a triangle of its own.

    Parameters
    ----------
    points : (N, 3) float
    corners : (N, 3, 3) float
        Triangles, which may be flat: then they are segments or points.

    Returns
    -------
    (N,) float
    """
    a = corners[:, 0]
    ab, ac, ap = corners[:, 1] - a, corners[:, 2] - a, points - a
    bb, cc, bc = _dot(ab, ab), _dot(ac, ac), _dot(ab, ac)
    bp, cp, pp = _dot(ab, ap), _dot(ac, ap), _dot(ap, ap)
    # Squared distances from the three edges: a to b, a to c and b to c.
    along_bc = bb + cc - 2 * bc
    from_b = pp + bb - 2 * bp
    to_c = cp - bp - bc + bb
    squared = np.minimum(
        np.minimum(_from_segment(pp, bp, bb), _from_segment(pp, cp, cc)),
        _from_segment(from_b, to_c, along_bc),
    )
    # Above the inside of the triangle, the plane is nearer than any edge.
    area = bb * cc - bc * bc
    v, w = cc * bp - bc * cp, bb * cp - bc * bp
    above = (v > 0) & (w > 0) & (v + w < area) & (area > 1e-14 * bb * cc)
    fall = np.divide(v * bp + w * cp, area, out=np.zeros(len(area)), where=above)
    squared = np.where(above, np.minimum(squared, pp - fall), squared)
    # The difference of products above is not exact: no distance is said too small.
    noise = 1e-15 * (pp + bb + cc)
    return np.sqrt(np.maximum(squared, 0.0) + noise)


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the dot products of vectors (N, 3), (N,)."""
    return np.einsum("nd,nd->n", a, b)


def _from_segment(
    square: FloatArray, along: FloatArray, length: FloatArray
) -> FloatArray:
    """Return squared distances from segments, (N,).

    `square` is the squared distance from the start, `along` the dot product with the
    segment, `length` its squared length.
    """
    share = np.divide(along, length, out=np.zeros(len(along)), where=length > 0)
    share = np.clip(share, 0.0, 1.0)
    return square - share * (2 * along - share * length)
