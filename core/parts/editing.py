"""Parts changed by hand: labels in, labels out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..errors import DecompositionError
from ..geometry.face_graph import FaceGraph
from ..geometry.symmetry import Plane, side_of
from ..steps.progress import Steps

# Share of the polygons on one side that are images of the other, where parts can be
# mirrored.
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
    labels: NDArray[np.int64], graph: FaceGraph, middle: float, to_negative: bool
) -> Steps[Change]:
    """Copy the parts on one side of X to the other side, as `Side.copied` does.

    Parameters
    ----------
    labels : (P,) int
        Of the nodes of `graph`, in 0…K − 1.
    graph : FaceGraph
    middle : float
        X of the plane, in the space of `graph`.
    to_negative : bool
        Whether the parts at larger X are copied to smaller X, or the reverse.

    Returns
    -------
    Steps of Change

    Raises
    ------
    DecompositionError
        If the shape is not symmetric.
    """
    plane = Plane(np.array([1.0, 0.0, 0.0]), middle)
    side, share = yield from side_of(graph, plane, to_negative)
    if share < _SYMMETRIC:
        raise _not_symmetric()
    n_parts = int(labels.max()) + 1
    copied = side.copied(labels, graph)
    images = np.unique(copied[copied >= n_parts])
    return Change(
        copied,
        mirrored={int(image): int(image) - n_parts for image in images},
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
