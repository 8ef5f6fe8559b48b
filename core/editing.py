"""Parts changed by hand: labels in, labels out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from .errors import DecompositionError
from .surface import Surface

# A polygon's mirror image is within this distance of a polygon, in diagonals, ...
_MIRRORED_WITHIN = 0.03
# ... that of at least this share of them, where a shape is symmetric.
_SYMMETRIC = 0.5


@dataclass(frozen=True, eq=False)
class Change:
    """Parts after an edit.

    Attributes
    ----------
    labels : (P,) int
        Numbers below K are the parts there were; others are new.
    ranks : dict of int to float
        Convexity ranks of new parts that are known better than the whole shape's
        samples tell.
    mirrored : dict of int to int
        The part that each mirror image is of.
    side : str
        Where the latter are: "L" at positive X, "R" at negative X.
    """

    labels: NDArray[np.int64]
    ranks: dict[int, float] = field(default_factory=dict)
    mirrored: dict[int, int] = field(default_factory=dict)
    side: str = "L"


def merge(labels: NDArray[np.int64], chosen: Sequence[int], into: int) -> Change:
    """Make one part of several: `chosen` become `into`."""
    return Change(np.where(np.isin(labels, chosen), into, labels))


def give(labels: NDArray[np.int64], faces: NDArray[np.bool_], part: int) -> Change:
    """Give polygons to a part."""
    return Change(np.where(faces, part, labels))


def mirror(
    labels: NDArray[np.int64], surface: Surface, middle: float, to_negative: bool
) -> Change:
    """Copy the parts on one side of X to the other side.

    Parameters
    ----------
    labels : (P,) int
        Of the nodes of `surface`, in 0…K − 1.
    surface : Surface
    middle : float
        X of the plane, in the space of `surface`.
    to_negative : bool
        Whether the parts at larger X are copied to smaller X, or the reverse.

    Returns
    -------
    Change
        A part that crosses the plane goes on on the other side; the mirror image of one
        that does not is a part of its own.

    Raises
    ------
    DecompositionError
        If the shape is not symmetric.
    """
    side = np.sign(surface.centers[:, 0] - middle) * (1 if to_negative else -1)
    sources, targets = np.flatnonzero(side >= 0), np.flatnonzero(side < 0)
    images = surface.centers[targets] * [-1, 1, 1] + [2 * middle, 0, 0]
    if len(sources) == 0 or len(targets) == 0:
        raise _not_symmetric()
    distances, nearest = cKDTree(surface.centers[sources]).query(images)
    found = distances <= _MIRRORED_WITHIN
    if found.mean() < _SYMMETRIC:
        raise _not_symmetric()
    labels = labels.copy()
    n_parts = int(labels.max()) + 1
    targets = targets[found]
    labels[targets] = n_parts + labels[sources[nearest[found]]]
    one, other = labels[surface.neighbors].T
    # A part and its mirror image that touch are one.
    crossing = np.unique(np.minimum(one, other)[np.abs(one - other) == n_parts])
    joined = np.isin(labels, crossing + n_parts)
    labels[joined] -= n_parts
    images_left = np.unique(labels[labels >= n_parts])
    return Change(
        labels,
        mirrored={int(image): int(image) - n_parts for image in images_left},
        side="L" if to_negative else "R",
    )


def _not_symmetric() -> DecompositionError:
    return DecompositionError(
        "The shape is not symmetric: most faces have no mirror image across X; move"
        " it so that X = 0 is its middle."
    )


def compacted(
    labels: NDArray[np.int64],
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return labels 0…K − 1, each used, and the former label of each, (K,)."""
    former, labels = np.unique(labels, return_inverse=True)
    return labels.reshape(-1).astype(np.int64), former
