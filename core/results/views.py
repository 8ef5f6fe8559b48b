"""What one point sees, and pictures of matrices and of the embedding."""

from __future__ import annotations

from dataclasses import dataclass

from ..steps.arrays import BoolArray, FloatArray


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

    point: FloatArray
    places: FloatArray
    normals: FloatArray
    visible: BoolArray

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

    pixels: FloatArray
    notes: tuple[str, ...] = ()

    def __repr__(self) -> str:
        """Return the width and height in one line."""
        height, width, _ = self.pixels.shape
        return f"Picture({width} x {height} pixels)"
