"""What was found from a visibility, kept so that another number of parts is quick."""

from __future__ import annotations

from hashlib import blake2b
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..clusters.embedding import embed
from ..geometry.symmetry import Side, find_sides
from ..parameters.parts import Parameters
from ..sight.pairs import PairTally
from ..sight.visibility import Visibility
from ..steps.memo import Memo
from ..steps.progress import Steps

Labels: TypeAlias = NDArray[np.int64]

# Eigenvectors are computed in such numbers: a search with default settings needs 13.
_COORDINATES = 13


def digest(labels: Labels) -> bytes:
    """Return a key that tells labels from others."""
    return blake2b(labels.data).digest()


class Candidate(NamedTuple):
    """Parts before their seams are cut.

    Attributes
    ----------
    parts : (P,) int
        Part of each node.
    psi : float
        Their quality (eq. 5).
    even : bool
        Whether each part has its mirror image, in a shape that has a mirror plane.
    """

    parts: Labels
    psi: float
    even: bool = False


class CutMemo:
    """What was found for one choice of clusters, balance and smallest part.

    Attributes
    ----------
    candidates : Memo
        From a number of parts to its candidate.
    merged : Memo
        From a number of parts, and the largest number tried, to the better candidate.
    plain : Memo
        From a number of parts to k-means' clusters as parts.
    even : Memo
        From a side and the digest of parts to parts alike on both sides.
    searches : Memo
        From the first and last number tried to the candidate of each number.
    seams : Memo
        From a smoothness and the digest of parts to the parts with their seams cut.
    """

    def __init__(self) -> None:
        self.candidates: Memo[int, Candidate] = Memo()
        self.merged: Memo[tuple[int, int], Candidate] = Memo()
        self.plain: Memo[int, Labels] = Memo()
        self.even: Memo[tuple[int, bytes], Labels] = Memo(64)
        self.searches: Memo[tuple[int, int], dict[int, Candidate]] = Memo()
        self.seams: Memo[tuple[float, bytes], Labels] = Memo(32)


class PartMemo:
    """A visibility, and what was found from it.

    Results never depend on what is kept: it saves time alone.

    Parameters
    ----------
    visibility : Visibility

    Attributes
    ----------
    tallies : Memo
        From the digest and number of labels to the counts of pairs.
    pieces : Memo
        From a smallest area and the digest of labels to connected parts.
    moves : Memo
        From the digest of labels and alpha to the labels after all moves.
    """

    def __init__(self, visibility: Visibility) -> None:
        self.visibility = visibility
        self.tallies: Memo[tuple[bytes, int], PairTally] = Memo(256)
        self.pieces: Memo[tuple[float, bytes], Labels] = Memo(24)
        self.moves: Memo[tuple[bytes, float], Labels] = Memo(32)
        self._embeddings: Memo[tuple[int, bool], NDArray[np.float64]] = Memo(2)
        self._clusters: Memo[tuple[str, int], Memo[tuple[int, int], Labels]] = Memo(2)
        self._cuts: Memo[tuple[str, int, str, float, float], CutMemo] = Memo(3)
        self._sides: tuple[Side, ...] | None = None

    def clusters(self, parameters: Parameters) -> Memo[tuple[int, int], Labels]:
        """Return the memo of k-means' clusters of samples.

        From the numbers of clusters and coordinates to the labels.
        """
        return self._clusters.recall((parameters.normalization, parameters.seed), Memo)

    def cut(self, parameters: Parameters) -> CutMemo:
        """Return the memo of what these parameters give."""
        key = (
            parameters.normalization,
            parameters.seed,
            parameters.refinement,
            parameters.alpha,
            parameters.smallest_part,
        )
        return self._cuts.recall(key, CutMemo)

    def embedding(self, n_parts: int, parameters: Parameters) -> NDArray[np.float64]:
        """Return coordinates of the samples for a number of parts, (N, n) float.

        Eigenvectors differ a little by how many of them are computed. They come in
        fixed numbers, so that parts do not depend on how many more are tried.
        """
        n_coordinates = _COORDINATES * -(-n_parts // _COORDINATES)
        stochastic = parameters.normalization == "STOCHASTIC"
        return self._embeddings.recall(
            (n_coordinates, stochastic),
            lambda: embed(self.visibility.affinity, n_coordinates, stochastic),
        )

    def sides(self) -> Steps[tuple[Side, ...]]:
        """Return both sides of the shape's mirror plane, none if it has no plane."""
        if self._sides is None:
            self._sides = yield from find_sides(self.visibility.transfer.graph)
        return self._sides
