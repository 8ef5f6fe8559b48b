"""Types of all results: frozen dataclasses of NumPy arrays, with their units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .geometry.primitives import CollisionShape


@dataclass(frozen=True, eq=False, repr=False)
class Decomposition:
    """The weakly convex parts of a shape.

    Attributes
    ----------
    labels : (P,) int
        Number of the part of each polygon, or of each point of a cloud. Part 0 has the
        largest area.
    areas : (K,) float
        Area of each part, in squared units of the shape.
    face_counts : (K,) int
        Number of polygons, or of points, of each part.
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
    good_k : tuple of int
        Up to three good numbers of parts: a coarse one, `best_k` and a fine one.

    Examples
    --------
    >>> from weak_convex_decomposition import decompose
    >>> vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    >>> decompose(vertices, faces, samples=400).labels.tolist()
    [0, 0, 0, 0]
    """

    labels: NDArray[np.int64]
    areas: NDArray[np.float64]
    face_counts: NDArray[np.int64]
    ranks: NDArray[np.float64]
    psi_before: float
    psi: float
    psi_by_k: dict[int, float]
    best_k: int
    notes: tuple[str, ...]
    normals: NDArray[np.float64] | None = None
    pairs_cast: int = 0
    pairs_inferred: int = 0
    pairs: tuple[tuple[int, int], ...] = ()
    good_k: tuple[int, ...] = ()

    @property
    def n_parts(self) -> int:
        """Number of parts K."""
        return len(self.areas)

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


@dataclass(frozen=True, eq=False, repr=False)
class HullDecomposition:
    """Convex collision shapes that together approximate a shape, in its units.

    Attributes
    ----------
    shapes : tuple of CollisionShape
        Sorted, the largest first.
    errors : (K,) float
        Error of each shape as it is written, with its kind, margin and vertices, in
        `error_unit`: an upper bound, seldom more than a few percent above the error.
        The error is the largest of

        - R_v of CoACD: 0.3 times the radius of a ball that has the volume of the shape
          outside the solid;
        - the distance of any point on the shape, if it is outside the solid, from the
          surface of the solid within the shape;
        - the depth below the surface of the shape of any point on the surface of the
          solid within the shape;
        - the distance from the shape of any point of its piece, which margins below 0
          and `max_vertices` may leave uncovered.
    parts : (K,) int
        Number of the part of each collision shape, −1 if no parts were given.
    volume_ratio : float
        Sum of the volumes of the collision shapes, divided by that of the solid; `inf`
        for a shape without an inside.
    notes : tuple of str
        Sentences to the user.
    error_unit : str
        'RELATIVE', where 1 is half of the longest side of the shape, or 'SCENE', for
        lengths.
    half_side : float
        Half of the longest side of the shape, as a length in the scene.

    Examples
    --------
    >>> from weak_convex_decomposition import build_hulls
    >>> vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    >>> hulls = build_hulls(vertices, faces)
    >>> round(hulls.shapes[0].volume, 3)
    0.167
    """

    shapes: tuple[CollisionShape, ...]
    errors: NDArray[np.float64]
    parts: NDArray[np.int64]
    volume_ratio: float
    notes: tuple[str, ...]
    error_unit: str = "RELATIVE"
    half_side: float = 1.0

    def errors_in(self, unit: str) -> NDArray[np.float64]:
        """Return the errors in a unit, (K,) float.

        Parameters
        ----------
        unit : str
            'RELATIVE' or 'SCENE'.
        """
        if unit == self.error_unit:
            return self.errors
        factor = self.half_side if unit == "SCENE" else 1 / self.half_side
        return self.errors * factor

    @property
    def n_hulls(self) -> int:
        """Number of collision shapes K."""
        return len(self.shapes)

    @property
    def has_parts(self) -> bool:
        """Whether parts were given, so that each collision shape belongs to one."""
        return bool(self.parts.min() >= 0)

    def __repr__(self) -> str:
        """Return the number of hulls and the largest error in one line."""
        hulls = "1 hull" if self.n_hulls == 1 else f"{self.n_hulls} hulls"
        return f"HullDecomposition({hulls}, largest error {self.errors.max():.3f})"


@dataclass(frozen=True, eq=False, repr=False)
class View:
    """The samples of a surface that one of its points sees, in units of the shape.

    Attributes
    ----------
    point : (3,) float
        The point that looks.
    places : (N, 3) float
        Positions of the samples.
    normals : (N, 3) float
        Outward unit normals at the samples.
    visible : (N,) bool
        Whether each sample is in line of sight of the point.
    """

    point: NDArray[np.float64]
    places: NDArray[np.float64]
    normals: NDArray[np.float64]
    visible: NDArray[np.bool_]

    def __repr__(self) -> str:
        """Return the share of visible samples in one line."""
        return f"View({self.visible.mean():.0%} of {len(self.visible)} samples visible)"


@dataclass(frozen=True, eq=False, repr=False)
class Picture:
    """A diagram of a decomposition, such as its LoS matrix sorted by part.

    Attributes
    ----------
    pixels : (H, W, 3) float
        sRGB from 0 to 1. The first row is the top one.
    notes : tuple of str
        Sentences to the user.
    """

    pixels: NDArray[np.float64]
    notes: tuple[str, ...] = ()

    def __repr__(self) -> str:
        """Return the width and height in one line."""
        height, width, _ = self.pixels.shape
        return f"Picture({width} x {height} pixels)"
