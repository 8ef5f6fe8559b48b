"""What the computations return: plain values of NumPy arrays, each with its units."""

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
        Part of each polygon, or of each point of a cloud, counted from 0. Part 0 has
        the largest area.
    areas : (K,) float
        Area of each part, in the units of the shape squared.
    face_counts : (K,) int
        Number of polygons, or of points, of each part.
    ranks : (K,) float
        Convexity rank of each part (eq. 1), from 0 to 1.
    psi_before : float
        Psi of the whole shape as one part.
    psi : float
        Quality psi of the parts (eq. 5).
    psi_by_k : dict of int to float
        Psi for every number of parts k that was tried, before seams were cut.
    best_k : int
        The number of parts that the search chooses.
    notes : tuple of str
        Sentences to the user.
    normals : (P, 3) float or None
        Outward unit normals of the points of a cloud that had none, or wrong ones.
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

    @property
    def n_parts(self) -> int:
        """Number of parts K."""
        return len(self.areas)

    def __repr__(self) -> str:
        """Return the figures in a line."""
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
    """

    rank: float
    standard_error: float
    n_samples: int
    notes: tuple[str, ...]

    def __repr__(self) -> str:
        """Return the figures in a line."""
        error = f" ± {self.standard_error:.3f}" if self.standard_error else ""
        return f"Measurement(rank {self.rank:.3f}{error}, {self.n_samples} samples)"


@dataclass(frozen=True, eq=False, repr=False)
class HullDecomposition:
    """Collision shapes that together stand for a shape, in its units.

    Attributes
    ----------
    shapes : tuple of CollisionShape
        The largest first.
    errors : (K,) float
        CoACD's concavity of the convex hull of each piece. Half of the longest side of
        the shape is 1.
    parts : (K,) int
        Part that each shape belongs to, −1 where no parts were given.
    volume_ratio : float
        Sum of the volumes of the shapes over the volume of the solid, `inf` for a
        shape without an inside.
    notes : tuple of str
        Sentences to the user.
    """

    shapes: tuple[CollisionShape, ...]
    errors: NDArray[np.float64]
    parts: NDArray[np.int64]
    volume_ratio: float
    notes: tuple[str, ...]

    @property
    def n_hulls(self) -> int:
        """Number of shapes K."""
        return len(self.shapes)

    @property
    def has_parts(self) -> bool:
        """Whether each shape belongs to a part that was given."""
        return bool(self.parts.min() >= 0)

    def __repr__(self) -> str:
        """Return the figures in a line."""
        hulls = "1 hull" if self.n_hulls == 1 else f"{self.n_hulls} hulls"
        return f"HullDecomposition({hulls}, largest error {self.errors.max():.3f})"


@dataclass(frozen=True, eq=False, repr=False)
class View:
    """What a point of a surface sees, in the units of the shape.

    Attributes
    ----------
    point : (3,) float
    places : (N, 3) float
        Samples of the surface.
    normals : (N, 3) float
        Outward unit vectors at the samples.
    visible : (N,) bool
        Which samples are in line of sight of the point.
    """

    point: NDArray[np.float64]
    places: NDArray[np.float64]
    normals: NDArray[np.float64]
    visible: NDArray[np.bool_]

    def __repr__(self) -> str:
        """Return the figures in a line."""
        return f"View({self.visible.mean():.0%} of {len(self.visible)} samples visible)"


@dataclass(frozen=True, eq=False, repr=False)
class Picture:
    """A picture of what the parts come from.

    Attributes
    ----------
    pixels : (H, W, 3) float
        sRGB from 0 to 1. The first row is the upper one.
    notes : tuple of str
        Sentences to the user.
    """

    pixels: NDArray[np.float64]
    notes: tuple[str, ...] = ()

    def __repr__(self) -> str:
        """Return the size."""
        height, width, _ = self.pixels.shape
        return f"Picture({width} x {height} pixels)"
