"""Parts and convexity ranks: what `decompose` and `measure` give."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..steps.arrays import FloatArray, IntArray
from .psi import good_numbers


@dataclass(frozen=True, eq=False, repr=False)
class Decomposition:
    """The weakly convex parts of a shape. Its arrays are read-only.

    Attributes
    ----------
    labels : (P,) int
        Number of the part of each polygon, or of each point of a cloud. Part 0 has the
        largest area.
    areas : (K,) float
        Area of each part, in squared units of the shape.
    ranks : (K,) float
        Convexity rank of each part (eq. 1), from 0 to 1.
    psi_before : float
        Psi of the whole shape as one part.
    psi : float
        Quality of the parts: visible pairs of samples within parts, plus alpha times
        hidden pairs between parts, as a share of all pairs (eq. 5).
    psi_by_k : dict of int to float
        Psi for every number of parts k that was tried, before seams were cut.
    best_k : int
        The number of parts that the search chooses.
    notes : tuple of str
        Sentences to the user.
    normals : (P, 3) float or None
        Outward unit normals of a point cloud, if they had to be found or corrected.
    pairs_cast, pairs_inferred : int
        Pairs of samples that ranks and psi are counted from: those that rays were cast
        between, and those that took the answer of similar pairs. Only Blocks infers
        pairs. Those that do not face each other through the inside count in neither.
    pairs : tuple of (int, int)
        Parts that are mirror images across X: the one at larger X, then the other.
    rough : bool
        Whether these are a first look at the parts: found without a search for rivals
        and details. On a large mesh, their seams run along patches of faces.

    Examples
    --------
    >>> from weak_convex_decomposition import decompose
    >>> vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    >>> decompose(vertices, faces, samples=400).labels.tolist()
    [0, 0, 0, 0]
    """

    labels: IntArray
    areas: FloatArray
    ranks: FloatArray
    psi_before: float
    psi: float
    psi_by_k: dict[int, float]
    best_k: int
    notes: tuple[str, ...]
    normals: FloatArray | None = None
    pairs_cast: int = 0
    pairs_inferred: int = 0
    pairs: tuple[tuple[int, int], ...] = ()
    rough: bool = False

    def __post_init__(self) -> None:
        """Protect what the next result of the same shape may share."""
        for array in (self.labels, self.areas, self.ranks):
            array.flags.writeable = False
        if self.normals is not None:
            self.normals.flags.writeable = False
        object.__setattr__(self, "psi_by_k", dict(self.psi_by_k))

    @property
    def n_parts(self) -> int:
        """Number of parts K."""
        return len(self.areas)

    @property
    def face_counts(self) -> IntArray:
        """Number of polygons, or of points, of each part, (K,)."""
        return np.bincount(self.labels, minlength=self.n_parts)

    @property
    def good_k(self) -> tuple[int, ...]:
        """Up to three good numbers of parts: a coarse one, `best_k` and a fine one."""
        return good_numbers(self.psi_by_k, self.best_k)

    def pairs_at(self, places: IntArray) -> tuple[tuple[int, int], ...]:
        """Return `pairs` of parts that get other numbers.

        Parameters
        ----------
        places : (K,) int
            The new number of each part, -1 if it goes.
        """
        moved = [(int(places[one]), int(places[other])) for one, other in self.pairs]
        return tuple(pair for pair in moved if min(pair) >= 0)

    def __repr__(self) -> str:
        """Return the number of parts and psi in one line."""
        parts = "1 part" if self.n_parts == 1 else f"{self.n_parts} parts"
        return f"Decomposition({parts}, psi {self.psi_before:.2f} -> {self.psi:.2f})"


@dataclass(frozen=True, repr=False)
class Measurement:
    """The convexity rank of a shape (eq. 1).

    Attributes
    ----------
    rank : float
        Share of pairs of surface points that see each other, from 0 to 1.
    standard_error : float
        Standard error of `rank`, which is estimated from samples.
    n_samples : int
        Number of samples.
    notes : tuple of str
        Sentences to the user.
    pairs_cast : int
        Pairs of samples that rays were cast between. No answer is inferred.

    Examples
    --------
    >>> from weak_convex_decomposition import measure
    >>> vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    >>> measure(vertices, faces, samples=400)
    Measurement(rank 1.000, 400 samples)
    """

    rank: float
    standard_error: float
    n_samples: int
    notes: tuple[str, ...]
    pairs_cast: int = 0

    def __repr__(self) -> str:
        """Return the rank, its error and the number of samples in one line."""
        error = f" ± {self.standard_error:.3f}" if self.standard_error else ""
        return f"Measurement(rank {self.rank:.3f}{error}, {self.n_samples} samples)"
