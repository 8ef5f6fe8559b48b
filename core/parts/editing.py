"""Edits of parts by hand: functions from labels to changed labels."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..errors import DecompositionError
from ..geometry.graphs.face_graph import FaceGraph
from ..geometry.graphs.pieces import whole_polygons
from ..geometry.symmetry import Plane, side_of
from ..steps.arrays import BoolArray, IntArray
from ..steps.progress import Steps
from .part_psi import count_parts

# Smallest share of the polygons on one side with a mirror image on the other side, for
# which parts are mirrored.
_SYMMETRIC = 0.5


@dataclass(frozen=True, eq=False)
class Change:
    """Parts after an edit.

    Attributes
    ----------
    labels : (P,) int
        Part of each polygon or node. Labels below the former number of parts K are
        former parts; other labels are new parts.
    ranks : dict of int to float
        Convexity ranks of new parts, where samples on the part alone gave a more
        precise rank than the samples of the whole shape.
    mirrored : dict of int to int
        The label of each new mirror image, and the label of the part it mirrors.
    side : str
        Side of the parts that were mirrored: "L" for positive X, "R" for negative X.
    by_hand : (P,) bool or None
        The polygons whose part the user settled; a new run keeps them in it.
    notes : tuple of str
        Sentences to the user.
    """

    labels: IntArray
    ranks: dict[int, float] = field(default_factory=dict)
    mirrored: dict[int, int] = field(default_factory=dict)
    side: str = "L"
    by_hand: BoolArray | None = None
    notes: tuple[str, ...] = ()


def give(labels: IntArray, faces: BoolArray, part: int) -> Change:
    """Assign polygons to a part.

    Parameters
    ----------
    labels : (P,) int
    faces : (P,) bool
        The polygons to assign.
    part : int
        Label of the part.

    Returns
    -------
    Change
    """
    return Change(np.where(faces, part, labels), by_hand=faces)


def mirror(
    labels: IntArray, graph: FaceGraph, middle: float, to_negative: bool
) -> Steps[Change]:
    """Copy the parts on one side of a plane of constant X to the other side.

    A part that crosses the plane continues on the other side. The mirror image of any
    other part is a new part.

    Parameters
    ----------
    labels : (P,) int
        Part of each node of `graph`, in 0…K − 1.
    graph : FaceGraph
    middle : float
        X of the plane, in the space of `graph`.
    to_negative : bool
        If true, copy from larger X to smaller X; if false, the other way.

    Returns
    -------
    Steps of Change

    Raises
    ------
    DecompositionError
        If the shape is not symmetric.
    """
    plane = Plane(np.array([1.0, 0.0, 0.0]), middle)
    side, share = yield from side_of(whole_polygons(graph), plane, to_negative)
    if share < _SYMMETRIC:
        raise DecompositionError(
            "The shape is not symmetric: most faces have no mirror image across X; move"
            " it so that X = 0 is its middle."
        )
    n_parts = count_parts(labels)
    copied = side.copied(labels, graph)
    images = np.unique(copied[copied >= n_parts])
    return Change(
        copied,
        mirrored={int(image): int(image) - n_parts for image in images},
        side="L" if to_negative else "R",
    )


def compacted(labels: IntArray) -> tuple[IntArray, IntArray]:
    """Renumber labels without gaps, in their former order.

    Parameters
    ----------
    labels : (P,) int

    Returns
    -------
    labels : (P,) int
        In 0…K − 1, each used.
    former : (K,) int
        Former label of each new one, ascending.
    """
    former, labels = np.unique(labels, return_inverse=True)
    return labels.astype(np.int64), former
